/* SPDX-FileCopyrightText: 2026 Nobody
 *
 * SPDX-License-Identifier: GPL-2.0-or-later */

/**
 * Depth of surfaces that are transparent by chance: no blending, one sample a pixel.
 * Noise converges over the samples of the film.
 */

#include "infos/eevee_material_infos.hh"

FRAGMENT_SHADER_CREATE_INFO(eevee_clip_plane)
FRAGMENT_SHADER_CREATE_INFO(eevee_surf_depth)

#include "draw_view_lib.glsl"
#include "eevee_nodetree_lib.glsl"
#include "eevee_sampling_lib.glsl"
#include "eevee_surf_lib.glsl"
#include "eevee_velocity_lib.glsl"
#include "gpu_shader_math_base_lib.glsl"

/* From the paper "Hashed Alpha Testing" by Chris Wyman and Morgan McGuire. */
float hash(vec2 a)
{
  return fract(1e4f * sin(17.0f * a.x + 0.1f * a.y) * (0.1f + abs(sin(13.0f * a.y + a.x))));
}

float hash3d(vec3 a)
{
  return hash(vec2(hash(a.xy), a.z));
}

float hashed_alpha_threshold(float hash_scale, float hash_offset, vec3 P)
{
  /* Find the discretized derivatives of our coordinates. */
  vec3 max_deriv = max(abs(dFdx(P)), abs(dFdy(P)));

  vec3 pix_scale = vec3(0.707f) / (hash_scale * max_deriv);
  /* Find two nearest log-discretized noise scales. */
  vec3 scale_floor = exp2(floor(log2(pix_scale)));
  vec3 scale_ceil = exp2(ceil(log2(pix_scale)));
  /* Compute alpha thresholds at our two noise scales. */
  vec2 alpha = vec2(hash3d(floor(scale_floor * P)), hash3d(floor(scale_ceil * P)));
  /* Factor to interpolate lerp with. */
  vec3 fract_loc = fract(log2(pix_scale));
  vec2 to_corners = vec2(length(fract_loc), length(vec3(1.0f) - fract_loc));
  float fac = to_corners.x / (to_corners.x + to_corners.y);
  /* Interpolate alpha threshold from noise at two scales. */
  float x = mix(alpha.x, alpha.y, fac);
  /* Pass into CDF to compute uniformly distributed threshold. */
  float a = min(fac, 1.0f - fac);
  float one_a = 1.0f - a;
  float denom = 1.0f / (2.0f * a * one_a);
  float one_x = 1.0f - x;
  vec3 cases = vec3((x * x) * denom, (x - 0.5f * a) / one_a, 1.0f - (one_x * one_x * denom));
  /* Find our final, uniformly distributed alpha threshold. */
  float threshold = (x < one_a) ? ((x < a) ? cases.x : cases.y) : cases.z;

  /* Jitter the threshold for TAA accumulation. */
  threshold = fract(threshold + hash_offset);

  /* Avoids threshold == 0. */
  return clamp(threshold, 1.0e-6f, 1.0f);
}

vec4 closure_to_rgba(Closure cl)
{
  return vec4(0.0f);
}

void main()
{
#ifdef MAT_TRANSPARENT
  init_globals();

  nodetree_surface(0.0f);

#  ifdef MAT_CLIP_PLANE
  if (clip_interp.clip_distance > 0.0f) {
    discard;
    return;
  }
#  endif

  float noise_offset = sampling_rng_1D_get(SAMPLING_TRANSPARENCY);
  float threshold = hashed_alpha_threshold(pipeline_buf.alpha_hash_scale, noise_offset, g_data.P);

  float transparency = average(g_transmittance);
  if (transparency > threshold) {
    discard;
    return;
  }
#endif

#ifdef MAT_VELOCITY
  out_velocity = velocity_surface(interp.P + motion.prev, interp.P, interp.P + motion.next);
  out_velocity = velocity_pack(out_velocity);
#endif
}
