#version 150

// Panda3D: render.setShader(Shader.load(Shader.SL_GLSL, "leaves.vert", "leaves.frag"))

uniform sampler2D p3d_Texture0;
uniform sampler2D p3d_Texture1;
uniform vec4 p3d_ColorScale;

uniform struct p3d_MaterialParameters {
  vec4 ambient;
  vec4 diffuse;
  vec3 specular;
  float shininess;
} p3d_Material;

uniform struct p3d_LightSourceParameters {
  vec4 color;
  vec4 position;
  sampler2DShadow shadowMap;
  mat4 shadowViewMatrix;
} p3d_LightSource[2];

uniform float osg_FrameTime;
uniform float hash_scale;

in vec2 texcoord;
in vec3 normal;
in vec4 vertex_view;
in vec3 vertex_model;

out vec4 p3d_FragColor;

float hash(vec2 p) {
  return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hash3(vec3 p) {
  return hash(vec2(hash(p.xy), p.z));
}

float uniformise(float x, float f) {
  float a = min(f, 1.0 - f);
  float lo = x * x / (2.0 * a * (1.0 - a));
  float mid = (x - 0.5 * a) / (1.0 - a);
  float hi = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
  return x < 1.0 - a ? (x < a ? lo : mid) : hi;
}

vec3 light(int i, vec3 n, vec3 albedo) {
  vec3 l = p3d_LightSource[i].position.xyz - vertex_view.xyz * p3d_LightSource[i].position.w;
  vec4 s = p3d_LightSource[i].shadowViewMatrix * vertex_view;
  float visible = textureProj(p3d_LightSource[i].shadowMap, s);
  return albedo * p3d_LightSource[i].color.rgb * max(dot(n, normalize(l)), 0.0) * visible;
}

void main() {
  vec4 albedo = texture(p3d_Texture0, texcoord) * p3d_ColorScale;

  // don't sort, hash
  float d = max(length(dFdx(vertex_model)), length(dFdy(vertex_model)));
  float level = log2(1.0 / (hash_scale * d));
  float coarse = hash3(floor(vertex_model * exp2(floor(level))));
  float fine = hash3(floor(vertex_model * exp2(ceil(level))));
  float f = fract(level);
  float t = uniformise(mix(fine, coarse, f), f);
  if (albedo.a < clamp(t, 1.0e-6, 1.0)) {
    discard;
  }

  vec3 n = normalize(normal);
  if (!gl_FrontFacing) n = -n;
  vec3 color = p3d_Material.ambient.rgb * albedo.rgb;
  for (int i = 0; i < p3d_LightSource.length(); ++i) {
    color += light(i, n, albedo.rgb * p3d_Material.diffuse.rgb);
  }
  p3d_FragColor = vec4(color, 1.0);
}
