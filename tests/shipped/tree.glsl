//------------------------------------------------------------------------------
//  Shader code for the forest sample: instanced trees with hashed cut-outs.
//------------------------------------------------------------------------------
@header const m = @import("../math.zig")
@ctype mat4 m.Mat4
@ctype vec3 m.Vec3

@block noise
float hash2(vec2 p) {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hash3(vec3 p) {
    return hash2(vec2(hash2(p.xy), p.z));
}
@end

@block lighting
vec3 hemisphere(vec3 n, vec3 sky, vec3 ground) {
    return mix(ground, sky, 0.5 + 0.5 * n.y);
}

vec3 gamma(vec3 c) {
    float p = 1.0 / 2.2;
    return pow(c, vec3(p, p, p));
}
@end

@vs vs
layout(binding=0) uniform vs_params {
    mat4 mvp;
    mat4 model;
    float time;
};

in vec4 position;
in vec3 normal;
in vec2 texcoord;
in vec4 inst_pos;

out vec3 obj_pos;
out vec3 world_normal;
out vec2 uv;

void main() {
    vec4 pos = vec4(position.xyz + inst_pos.xyz, 1.0);
    pos.x += sin(time + inst_pos.x) * 0.1 * position.y;
    gl_Position = mvp * pos;
    obj_pos = position.xyz;
    world_normal = (model * vec4(normal, 0.0)).xyz;
    uv = texcoord;
}
@end

@fs fs
@include_block noise
@include_block lighting

layout(binding=1) uniform fs_params {
    vec3 light_dir;
    vec3 light_color;
    vec3 sky;
    vec3 ground;
    float hash_scale;
};

layout(binding=0) uniform texture2D tex;
layout(binding=0) uniform sampler smp;

in vec3 obj_pos;
in vec3 world_normal;
in vec2 uv;

out vec4 frag_color;

float alpha_threshold(vec3 p) {
    float deriv = max(length(dFdx(p)), length(dFdy(p)));
    float scale = 1.0 / (hash_scale * deriv);
    float s0 = exp2(floor(log2(scale)));
    float s1 = exp2(ceil(log2(scale)));
    float f = fract(log2(scale));
    float x = mix(hash3(floor(s0 * p)), hash3(floor(s1 * p)), f);
    float a = min(f, 1.0 - f);
    vec3 cases = vec3(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)));
    float t = (x < 1.0 - a) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}

void main() {
    vec4 color = texture(sampler2D(tex, smp), uv);
    if (color.a < alpha_threshold(obj_pos)) {
        discard;
    }
    vec3 n = normalize(world_normal);
    vec3 light = hemisphere(n, sky, ground) + max(dot(n, light_dir), 0.0) * light_color;
    frag_color = vec4(gamma(color.rgb * light), 1.0);
}
@end

@program tree vs fs
