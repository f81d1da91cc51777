#pragma once

#include <array>
#include <string_view>

#include "gfx/Program.hpp"

namespace arbor::gfx {

/// Uniform slots, in the order of the shader's declarations
enum class FoliageSlot : unsigned { Albedo = 0, HashScale, Sun, Count };

inline constexpr std::string_view kFoliageVertex = R"glsl(#version 450 core
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec2 aUv;
layout(location = 0) out vec3 vModel;
layout(location = 1) out vec2 vUv;
uniform mat4 uMvp;
void main() { vModel = aPosition; vUv = aUv; gl_Position = uMvp * vec4(aPosition, 1.0); }
)glsl";

inline constexpr std::string_view kFoliageFragment = R"glsl(#version 450 core
layout(location = 0) in vec3 vModel;
layout(location = 1) in vec2 vUv;
layout(location = 0) out vec4 oColour;

layout(binding = 0) uniform sampler2D uAlbedo;
uniform float uHashScale;
uniform vec3 uSun;

// what a fragment brings along and what is known of it afterwards
struct Coverage {
    vec3 position;
    float alpha;
    float threshold;
    bool hidden;
};

float hash(vec2 v) {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash(vec3 v) {
    return hash(vec2(hash(v.xy), v.z));
}

// Anisotropic: each axis has its own pair of octaves
void resolveCoverage(inout Coverage c) {
    vec3 axis = max(abs(dFdx(c.position)), abs(dFdy(c.position)));
    vec3 level = log2(vec3(0.707) / (uHashScale * axis));
    vec3 octave[2];
    octave[0] = exp2(floor(level));
    octave[1] = exp2(ceil(level));
    float noise[2];
    for (int i = 0; i < 2; ++i) {
        noise[i] = hash(floor(octave[i] * c.position));
    }
    vec3 part = fract(level);
    float near = length(part);
    float far = length(1.0 - part);
    float f = near / (near + far);
    float x = mix(noise[0], noise[1], f);
    float a = min(f, 1.0 - f);
    float q = 2.0 * a * (1.0 - a);
    vec3 cases = vec3(x * x / q, (x - 0.5 * a) / (1.0 - a), 1.0 - (1.0 - x) * (1.0 - x) / q);
    float t = x < 1.0 - a ? (x < a ? cases.x : cases.y) : cases.z;
    c.threshold = clamp(t, 1.0e-6, 1.0);
    c.hidden = c.alpha < c.threshold;
}

void main() {
    vec4 albedo = texture(uAlbedo, vUv);
    Coverage c = Coverage(vModel, albedo.a, 0.5, false);
    resolveCoverage(c);
    if (c.hidden) discard;
    oColour = vec4(albedo.rgb * (0.4 + 0.6 * max(uSun.y, 0.0)), 1.0);
}
)glsl";

class FoliageProgram final : public Program {
public:
    FoliageProgram() : Program{kFoliageVertex, kFoliageFragment} {}
    void setHashScale(float scale) { set(slot(FoliageSlot::HashScale), scale); }

private:
    static constexpr unsigned slot(FoliageSlot s) { return static_cast<unsigned>(s); }
    std::array<int, static_cast<unsigned>(FoliageSlot::Count)> locations_{};
};

}  // namespace arbor::gfx
