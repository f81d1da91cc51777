/* SPDX-FileCopyrightText: 2023 The Kiln Authors
 *
 * SPDX-License-Identifier: GPL-2.0-or-later */

/**
 * Transparency by a hash of the surface's position.
 *
 * Resources come from `eevee_hashed_info.hh`: `pipeline_buf`, `rng_offset`. They're not declared here.
 */

#pragma BLENDER_REQUIRE(gpu_shader_math_base_lib.glsl)
#pragma BLENDER_REQUIRE(draw_object_infos_lib.glsl)

#define HASH_SCALE_MIN 0.01

/* -------------------------------------------------------------------- */
/** \name Hashes
 * \{ */

float hashed_rand(vec2 co)
{
  return fract(1e4 * sin(17.0 * co.x + 0.1 * co.y) * (0.1 + abs(sin(13.0 * co.y + co.x))));
}

float hashed_rand_3d(vec3 co)
{
  return hashed_rand(vec2(hashed_rand(co.xy), co.z));
}

/** \} */

/* -------------------------------------------------------------------- */
/** \name Threshold
 * \{ */

/* From "Hashed Alpha Testing", section 4; `lP` is in object space. */
float surface_hash_threshold(float hash_scale, vec3 lP)
{
  float max_deriv = max(length(dFdx(lP)), length(dFdy(lP)));
  float pix_scale = 1.0 / (max(hash_scale, HASH_SCALE_MIN) * max_deriv);
  /* Find two nearest log-discretized noise scales. */
  float pix_scale_log = log2(pix_scale);
  vec2 pix_scales;
  pix_scales.x = exp2(floor(pix_scale_log));
  pix_scales.y = exp2(ceil(pix_scale_log));
  /* Compute alpha thresholds at our two noise scales. */
  vec2 alpha;
  alpha.x = hashed_rand_3d(floor(pix_scales.x * lP));
  alpha.y = hashed_rand_3d(floor(pix_scales.y * lP));
  /* Factor to interpolate lerp with. */
  float fac = fract(pix_scale_log);
  /* Interpolate alpha threshold from noise at two scales. */
  float x = mix(alpha.x, alpha.y, fac);
  /* Pass into CDF to compute uniformly distributed threshold. */
  float a = min(fac, 1.0 - fac);
  float one_a = 1.0 - a;
  float denom = 1.0 / (2.0 * a * one_a);
  float one_x = 1.0 - x;
  vec3 cases = vec3((x * x) * denom, (x - 0.5 * a) / one_a, 1.0 - (one_x * one_x * denom));
  /* Find our final, uniformly distributed alpha threshold. */
  float threshold = (x < one_a) ? ((x < a) ? cases.x : cases.y) : cases.z;
  /* Jitter the threshold for each sample (a rotation keeps it uniform). */
  threshold = fract(threshold + rng_offset);
  /* Avoids threshold == 0. */
  return clamp(threshold, 1.0e-6, 1.0);
}

/** \} */

#if defined(MAT_TRANSPARENT)
void surface_write(Closure cl, float thickness)
{
  vec3 radiance = cl.emission * pipeline_buf.exposure;
  float transmit = saturate(average(cl.transmittance));
  out_radiance = vec4(radiance, transmit);
  out_thickness = thickness;
}
#endif
