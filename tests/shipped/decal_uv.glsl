#version 330 core
#define FRAGMENT_SHADER

// Decals (leaves on the ground, torn posters). Their position is reconstructed from depth, so dFdx() of it is garbage at
// silhouettes; the uv's derivative isn't. The projector is square, u_unitsPerUv is the length of its edge.

uniform sampler2D u_decalColor;
uniform sampler2D u_decalNormal;
uniform sampler2D u_depth;

uniform mat4 u_clipToDecal;
uniform vec2 u_invViewport;
uniform vec3 u_ambient;
uniform vec3 u_sun;
uniform vec3 u_sunDir;
uniform float u_unitsPerUv;
uniform float u_hashScale;
uniform int u_frameIndex;

out vec4 o_color;

float hash2(vec2 s)
{
    return fract(1.0e4 * sin(17.0 * s.x + 0.1 * s.y) * (0.1 + abs(sin(13.0 * s.y + s.x))));
}
float hash3(vec3 s) { return hash2(vec2(hash2(s.xy), s.z)); }

vec3 decalPosition(vec2 fragCoord)
{
    vec2 ndc = fragCoord * u_invViewport * 2.0 - 1.0;
    float depth = texelFetch(u_depth, ivec2(fragCoord), 0).r * 2.0 - 1.0;
    vec4 h = u_clipToDecal * vec4(ndc, depth, 1.0);
    return h.xyz / h.w;
}

float decalThreshold(vec3 objPos, vec2 uv)
{
    float uvDeriv = max(length(dFdx(uv)), length(dFdy(uv)));
    float pixScale = 1.0 / (u_hashScale * u_unitsPerUv * uvDeriv);
    float l = log2(pixScale);

    vec2 scales = vec2(exp2(floor(l)), exp2(ceil(l)));
    vec2 h = vec2(hash3(floor(scales.x * objPos)), hash3(floor(scales.y * objPos)));

    float t = fract(l);
    float x = dot(h, vec2(1.0 - t, t));
    float a = min(t, 1.0 - t);

    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)));

    float tau = x < a ? cases[0] : cases[1];
    tau = x < 1.0 - a ? tau : cases[2];
    return clamp(tau, 1.0e-6, 1.0);
}

void main()
{
    vec3 p = decalPosition(gl_FragCoord.xy);
    bool outside = any(greaterThan(abs(p), vec3(0.5 * u_unitsPerUv)));   // no discard yet, there are derivatives ahead

    vec2 uv = p.xy / u_unitsPerUv + 0.5;
    vec4 c = texture(u_decalColor, uv);

    // it's a decal: fade where the surface turns away
    vec3 n = texture(u_decalNormal, uv).xyz * 2.0 - 1.0;
    c.a *= 1.0 - smoothstep(0.4, 0.5, abs(p.z) / u_unitsPerUv);

    float tau = decalThreshold(p, uv);
    if (outside || c.a < tau)
        discard;

    o_color = vec4(c.rgb * (u_ambient + u_sun * max(dot(n, u_sunDir), 0.0)), 1.0);
}
