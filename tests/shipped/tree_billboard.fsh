#version 300 es
/*
 * Billboards of the far tree ring.
 *   ALPHA_HASHED   noise test, no sorting needed
 *   ALPHA_CUTOUT   the old one
 *   ALPHA_COVERAGE MSAA only
 */
precision highp float;
precision highp int;
precision mediump sampler2DArray;

in highp vec3 v_localPos;
in highp vec3 v_viewPos;
in mediump vec3 v_normal;
in mediump vec2 v_uv;
flat in lowp int v_species;
in lowp float v_snow;

layout(std140) uniform FrameBlock
{
    mat4 u_view;
    mat4 u_proj;
    vec4 u_sunDirection;    // w: intensity
    vec4 u_skyColor;
    vec4 u_fogParams;       // start, end, density, unused
    uint u_frameCounter;    // for the TAA jitter, the trees don't look at it
};

uniform sampler2DArray u_atlas;
uniform float u_cutoff;
uniform float u_noisePixels;

layout(location = 0) out mediump vec4 o_color;

float hash(vec2 q)
{
    return fract(1.0e4 * sin(17.0 * q.x + 0.1 * q.y) * (0.1 + abs(sin(13.0 * q.y + q.x))));
}

#define HASH3(q) hash(vec2(hash((q).xy), (q).z))

mediump vec3 filmic(mediump vec3 c)
{
    c = max(vec3(0.0), c - 0.004);
    return (c * (6.2 * c + 0.5)) / (c * (6.2 * c + 1.7) + 0.06);
}

float fogAmount(float dist)
{
    return clamp((dist - u_fogParams.x) / (u_fogParams.y - u_fogParams.x), 0.0, 1.0) * u_fogParams.z;
}

void main()
{
    vec4 color = texture(u_atlas, vec3(v_uv, float(v_species)));
    color.rgb = mix(color.rgb, vec3(0.9, 0.94, 1.0), v_snow * smoothstep(0.3, 0.8, v_normal.y));

#if defined(ALPHA_HASHED)
    {
        vec3 dx = dFdx(v_localPos), dy = dFdy(v_localPos);
        float maxDeriv = max(length(dx), length(dy));
        float pixScale = 1.0 / (u_noisePixels * maxDeriv);

        // the two powers of two around the scale that we'd like to have
        vec2 pixScales = exp2(vec2(floor(log2(pixScale)), ceil(log2(pixScale))));
        vec2 alpha = vec2(HASH3(floor(pixScales.x * v_localPos)),
                          HASH3(floor(pixScales.y * v_localPos)));
        float lerpFactor = fract(log2(pixScale));
        float x = (1.0 - lerpFactor) * alpha.x + lerpFactor * alpha.y;

        float a = min(lerpFactor, 1.0 - lerpFactor);
        vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                          (x - 0.5 * a) / (1.0 - a),
                          1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
        float threshold = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
        threshold = clamp(threshold, 1.0e-6, 1.0);

        if (color.a < threshold) discard;
        color.a = 1.0;
    }
#elif defined(ALPHA_COVERAGE)
    color.a = clamp((color.a - u_cutoff) / max(fwidth(color.a), 1.0e-4) + 0.5, 0.0, 1.0);
    if (color.a <= 0.0) discard;
#elif defined(ALPHA_CUTOUT)
    if (color.a < u_cutoff) discard;
#endif

    mediump vec3 n = normalize(v_normal);
    mediump float ndl = max(dot(n, u_sunDirection.xyz), 0.0) * u_sunDirection.w;
    mediump float hemi = n.y * 0.5 + 0.5;
    mediump vec3 lit = color.rgb * (ndl + u_skyColor.rgb * hemi);

    lit = mix(lit, u_skyColor.rgb, fogAmount(length(v_viewPos)));
    o_color = vec4(filmic(lit), color.a);
}
