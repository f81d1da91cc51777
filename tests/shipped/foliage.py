"""Forest of billboard trees with hashed alpha testing, for Panda3D."""

import math
import random

from direct.showbase.ShowBase import ShowBase
from direct.task import Task
from panda3d.core import (
    CardMaker,
    DirectionalLight,
    GeomNode,
    NodePath,
    SamplerState,
    Shader,
    TextureStage,
    Vec3,
    Vec4,
    loadPrcFileData,
)

loadPrcFileData("", "gl-version 3 3\nframebuffer-multisample 0\n")

VERTEX = """#version 330

uniform mat4 p3d_ModelViewProjectionMatrix;
uniform mat4 p3d_ModelViewMatrix;
uniform mat3 p3d_NormalMatrix;
uniform float osg_FrameTime;

in vec4 p3d_Vertex;
in vec3 p3d_Normal;
in vec2 p3d_MultiTexCoord0;

out vec2 texcoord;
out vec3 object_pos;
out vec3 view_pos;
out vec3 view_normal;

void main() {
    vec4 moved = p3d_Vertex;
    moved.x += sin(osg_FrameTime + p3d_Vertex.z) * 0.05 * p3d_Vertex.z;
    gl_Position = p3d_ModelViewProjectionMatrix * moved;
    object_pos = p3d_Vertex.xyz;
    view_pos = (p3d_ModelViewMatrix * moved).xyz;
    view_normal = p3d_NormalMatrix * p3d_Normal;
    texcoord = p3d_MultiTexCoord0;
}
"""

FRAGMENT = """#version 330

uniform sampler2D p3d_Texture0;
uniform vec4 p3d_ColorScale;
uniform float noise_size;

uniform struct {
    vec4 ambient;
} p3d_LightModel;

uniform struct p3d_LightSourceParameters {
    vec4 color;
    vec4 position;
    vec3 spotDirection;
    float spotCosCutoff;
    vec3 attenuation;
} p3d_LightSource[2];

in vec2 texcoord;
in vec3 object_pos;
in vec3 view_pos;
in vec3 view_normal;

out vec4 p3d_FragColor;

float hash(vec2 p) {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hash3(vec3 p) {
    return hash(vec2(hash(p.xy), p.z));
}

float stochastic_threshold(vec3 p) {
    float deriv = max(length(dFdx(p)), length(dFdy(p)));
    float scale = 1.0 / (noise_size * deriv);
    float level = floor(log2(scale));
    float coarse = hash3(floor(exp2(level) * p));
    float fine = hash3(floor(exp2(level + 1.0) * p));
    float f = log2(scale) - level;

    float x = mix(coarse, fine, f);
    float a = min(f, 1.0 - f);
    float t;
    if (x < a) {
        t = x * x / (2.0 * a * (1.0 - a));
    } else if (x < 1.0 - a) {
        t = (x - 0.5 * a) / (1.0 - a);
    } else {
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    }
    return clamp(t, 1.0e-6, 1.0);
}

void main() {
    vec4 base = texture(p3d_Texture0, texcoord) * p3d_ColorScale;
    if (base.a < stochastic_threshold(object_pos)) {
        discard;
    }

    vec3 n = normalize(gl_FrontFacing ? view_normal : -view_normal);
    vec3 light = p3d_LightModel.ambient.rgb;
    for (int i = 0; i < p3d_LightSource.length(); ++i) {
        vec3 diff = p3d_LightSource[i].position.xyz - view_pos * p3d_LightSource[i].position.w;
        light += p3d_LightSource[i].color.rgb * max(dot(n, normalize(diff)), 0.0);
    }
    p3d_FragColor = vec4(base.rgb * light, 1.0);
}
"""


class Forest(ShowBase):
    """A square kilometre of cards."""

    def __init__(self, trees: int = 4000) -> None:
        super().__init__()
        self.disable_mouse()
        self.shader = Shader.make(Shader.SL_GLSL, VERTEX, FRAGMENT)
        self.forest = self.render.attach_new_node("forest")
        card = CardMaker("tree")
        card.set_frame(-1.0, 1.0, 0.0, 3.0)
        texture = self.loader.load_texture("tree.png")
        texture.set_minfilter(SamplerState.FT_linear_mipmap_linear)
        for _ in range(trees):
            for angle in (0, 90):
                node = self.forest.attach_new_node(card.generate())
                node.set_pos(random.uniform(-500, 500), random.uniform(-500, 500), 0)
                node.set_h(angle)
                node.set_two_sided(True)
        self.forest.set_texture(texture)
        self.forest.set_shader(self.shader)
        self.forest.set_shader_input("noise_size", 1.0)
        sun = DirectionalLight("sun")
        sun.set_color(Vec4(0.9, 0.85, 0.7, 1))
        self.forest.set_light(self.render.attach_new_node(sun))
        self.task_mgr.add(self.orbit, "orbit")

    def orbit(self, task: Task) -> int:
        angle = math.radians(task.time * 6.0)
        self.camera.set_pos(20 * math.sin(angle), -20 * math.cos(angle), 3)
        self.camera.set_h(math.degrees(angle))
        return Task.cont


if __name__ == "__main__":
    Forest().run()
