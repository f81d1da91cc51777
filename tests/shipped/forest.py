#!/usr/bin/env python3
"""A forest of billboards, drawn without sorting (moderngl + pyglet)."""
import math

import moderngl
import numpy as np

from engine.window import Window
from engine.assets import load_texture

VERTEX = """
#version 330

uniform mat4 mvp;
in vec3 in_position;
in vec2 in_uv;
out vec3 v_object;
out vec2 v_uv;

void main() {
    v_object = in_position;
    v_uv = in_uv;
    gl_Position = mvp * vec4(in_position, 1.0);
}
"""

FRAGMENT = """
#version 330

uniform sampler2D tree;
uniform float hash_scale;
uniform vec3 fog_colour;

in vec3 v_object;
in vec2 v_uv;
out vec4 f_colour;

float hash(vec2 p) {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hash3(vec3 p) {
    return hash(vec2(hash(p.xy), p.z));
}

float alpha_threshold(vec3 obj) {
    float deriv = max(length(dFdx(obj)), length(dFdy(obj)));
    float level = log2(1.0 / (hash_scale * deriv));
    float n0 = hash3(floor(obj * exp2(floor(level))));
    float n1 = hash3(floor(obj * exp2(ceil(level))));
    float f = fract(level);
    float x = mix(n0, n1, f);
    float a = min(f, 1.0 - f);
    float t;
    if (x < a)
        t = x * x / (2.0 * a * (1.0 - a));
    else if (x < 1.0 - a)
        t = (x - 0.5 * a) / (1.0 - a);
    else
        t = 1.0 - x * x / (2.0 * a * (1.0 - a));
    return clamp(t, 1.0e-6, 1.0);
}

void main() {
    vec4 c = texture(tree, v_uv);
    if (c.a < alpha_threshold(v_object))
        discard;
    float fog = exp(-0.02 / gl_FragCoord.w);
    f_colour = vec4(mix(fog_colour, c.rgb, fog), 1.0);
}
"""


class Forest(Window):
    title = "Forest: it's not sorted"

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.prog = self.ctx.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
        self.prog["hash_scale"].value = 1.0
        self.prog["fog_colour"].value = (0.7, 0.8, 0.9)
        self.texture = load_texture(self.ctx, "fir.png", mipmaps=True)
        rng = np.random.default_rng(7)
        places = rng.uniform(-40.0, 40.0, size=(500, 2))
        self.vbo = self.ctx.buffer(self.quads(places).astype("f4").tobytes())
        self.vao = self.ctx.vertex_array(self.prog, [(self.vbo, "3f 2f", "in_position", "in_uv")])

    @staticmethod
    def quads(places):
        corners = [(-1, 0, 0, 0), (1, 0, 1, 0), (1, 3, 1, 1), (-1, 0, 0, 0), (1, 3, 1, 1), (-1, 3, 0, 1)]
        return np.array([[x + dx, dy, z, u, v] for x, z in places for dx, dy, u, v in corners])

    def render(self, time, frametime):
        self.ctx.clear(0.7, 0.8, 0.9)
        self.ctx.enable(moderngl.DEPTH_TEST)
        angle = math.radians(10.0 * time)
        self.prog["mvp"].write(self.camera.matrix(angle).astype("f4").tobytes())
        self.texture.use(0)
        self.vao.render()


if __name__ == "__main__":
    Forest.run()
