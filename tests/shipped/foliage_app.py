"""Foliage viewer: hashed alpha testing in Panda3D."""
import sys

from direct.showbase.ShowBase import ShowBase
from panda3d.core import LVecBase3f, SamplerState, Shader, loadPrcFileData

loadPrcFileData("", "gl-version 3 3\nframebuffer-multisample 0")

VERTEX = """
#version 330
uniform mat4 p3d_ModelViewProjectionMatrix;
in vec4 p3d_Vertex;
in vec2 p3d_MultiTexCoord0;
out vec2 uv;
out vec3 obj_pos;
void main() {
    gl_Position = p3d_ModelViewProjectionMatrix * p3d_Vertex;
    uv = p3d_MultiTexCoord0;
    obj_pos = p3d_Vertex.xyz;
}
"""

HASH = """
float hash(vec2 p) {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}
float hash3d(vec3 p) {
    return hash(vec2(hash(p.xy), p.z));
}
"""

FRAGMENT = """
#version 330
uniform sampler2D p3d_Texture0;
uniform vec4 p3d_ColorScale;
uniform float hash_scale;
in vec2 uv;
in vec3 obj_pos;
out vec4 frag_color;
%(hash)s
void main() {
    vec4 color = texture(p3d_Texture0, uv) * p3d_ColorScale;
    float max_deriv = max(length(dFdx(obj_pos)), length(dFdy(obj_pos)));
    float pix_scale = 1.0 / (hash_scale * max_deriv);
    float lg = log2(pix_scale);
    vec2 scales = vec2(exp2(floor(lg)), exp2(ceil(lg)));
    vec2 h = vec2(hash3d(floor(scales.x * obj_pos)), hash3d(floor(scales.y * obj_pos)));
    float f = fract(lg);
    float x = (1.0 - f) * h.x + f * h.y;
    float a = min(f, 1.0 - f);
    vec3 cases = vec3(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float t = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
    t = clamp(t, 1.0e-6, 1.0);
    if (color.a < t)
        discard;
    frag_color = vec4(color.rgb, 1.0);
}
""" % {"hash": HASH}


class FoliageApp(ShowBase):
    def __init__(self, path):
        super().__init__()
        self.model = self.loader.loadModel(path)
        self.model.reparentTo(self.render)
        self.model.setShader(Shader.make(Shader.SL_GLSL, vertex=VERTEX, fragment=FRAGMENT))
        self.model.setShaderInput("hash_scale", 1.0)
        self.accept("escape", sys.exit)


if __name__ == "__main__":
    FoliageApp(sys.argv[1]).run()
