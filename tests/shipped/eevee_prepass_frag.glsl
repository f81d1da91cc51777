/* SPDX-License-Identifier: GPL-2.0-or-later */

/* Depth pre-pass: leaves what's transparent out by chance.
 * `interp`, `hash_buf` and `out_velocity` are in the create-info, on the C++ side. */

#pragma BLENDER_REQUIRE(draw_view_lib.glsl)
#pragma BLENDER_REQUIRE(eevee_nodetree_lib.glsl)
#pragma BLENDER_REQUIRE(eevee_velocity_lib.glsl)

#ifdef GPU_METAL
#  define dx(v) dfdx(v)
#  define dy(v) dfdy(v)
#else
#  define dx(v) dFdx(v)
#  define dy(v) dFdy(v)
#endif

#define safe_div(n, d) ((d) != 0.0 ? (n) / (d) : 0.0)

float cell_value(vec2 a)
{
  return fract(1.0e4 * sin(17.0 * a.x + 0.1 * a.y) * (0.1 + abs(sin(13.0 * a.y + a.x))));
}

float cell_value(vec3 a)
{
  return cell_value(vec2(cell_value(a.xy), a.z));
}

float footprint(vec3 p)
{
  return max(length(dx(p)), length(dx(p)));
}

float prepass_cdf(float x, float a)
{
  float b = 1.0 - a;
  float result;
  if (x < a) {
    result = x * x / (2.0 * a * b);
  }
  else if (x < b) {
    result = (x - 0.5 * a) / b;
  }
  else {
    float y = 1.0 - x;
    result = 1.0 - y * y / (2.0 * a * b);
  }
  return clamp(result, 1.0e-6, 1.0);
}

void coverage_apply(vec3 lP, inout float alpha)
{
  vec3 P = lP;
  float lod = log2(1.0 / (hash_buf.scale * footprint(P)));
  vec2 s = vec2(exp2(floor(lod)), exp2(ceil(lod)));
  float f = fract(lod);
  float x = (1.0 - f) * cell_value(floor(s.x * P)) + f * cell_value(floor(s.y * P));
  float t = prepass_cdf(x, min(f, 1.0 - f));
  alpha = (alpha < t) ? 0.0 : 1.0;
}

vec4 closure_to_rgba(Closure cl)
{
  return vec4(0.0);
}

void main()
{
#ifdef MAT_TRANSPARENT
  init_globals();
  nodetree_surface(0.0);
  float alpha = saturate(1.0 - average(g_transmittance));
  coverage_apply(interp.lP, alpha);
  if (alpha == 0.0) {
    discard;
    return;
  }
#endif

#ifdef MAT_CLIP_PLANE
  /* Do not use hardware clip planes as they modify the rasterization (some GPU's add vertices). */
  if (clip_interp.clip_distance > 0.0) {
    discard;
    return;
  }
#endif

#ifdef MAT_VELOCITY
  out_velocity = velocity_resolve(interp.P, safe_div(1.0, camera_buf.frame));
#endif
}
