--- Falling leaves drawn as 3D cards in LÖVE, with hashed cut-outs.
local Leaves = {}
Leaves.__index = Leaves

local lg = love.graphics

local format = {
    {"VertexPosition", "float", 3},
    {"VertexTexCoord", "float", 2},
    {"VertexNormal", "float", 3},
    {"VertexColor", "byte", 4},
}

local shaderSource = [[
varying vec3 localPosition;
varying vec3 worldNormal;

#ifdef VERTEX
uniform mat4 projectionMatrix;
uniform mat4 viewMatrix;
uniform mat4 modelMatrix;
attribute vec3 VertexNormal;

vec4 position(mat4 transform_projection, vec4 vertex_position) {
    localPosition = vertex_position.xyz;
    worldNormal = mat3(modelMatrix) * VertexNormal;
    vec4 p = projectionMatrix * viewMatrix * modelMatrix * vertex_position;
    p.y *= -1.0;
    return p;
}
#endif

#ifdef PIXEL
uniform float hashScale;
uniform vec3 sunDirection;
uniform vec3 sunColor;

float hash(vec2 p) {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hash3(vec3 p) {
    return hash(vec2(hash(p.xy), p.z));
}

float getThreshold(vec3 p) {
    float deriv = min(length(dFdx(p)), length(dFdy(p)));
    float scale = 1.0 / (hashScale * deriv);
    float level = log2(scale);
    float x = mix(hash3(floor(exp2(floor(level)) * p)), hash3(floor(exp2(ceil(level)) * p)), fract(level));
    float a = min(fract(level), 1.0 - fract(level));
    if (x < a)
        return max(1.0e-6, x * x / (2.0 * a * (1.0 - a)));
    if (x < 1.0 - a)
        return (x - 0.5 * a) / (1.0 - a);
    return 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
}

vec4 effect(vec4 color, Image tex, vec2 texture_coords, vec2 screen_coords) {
    vec4 texel = Texel(tex, texture_coords) * color;
    if (texel.a < getThreshold(localPosition)) {
        discard;
    }
    float light = 0.3 + 0.7 * abs(dot(normalize(worldNormal), sunDirection));
    return vec4(texel.rgb * light * sunColor, 1.0);
}
#endif
]]

function Leaves.new(texture, count)
    local self = setmetatable({}, Leaves)
    self.shader = lg.newShader(shaderSource)
    self.mesh = lg.newMesh(format, count * 6, "triangles", "stream")
    self.mesh:setTexture(texture)
    self.leaves = {}
    for i = 1, count do
        self.leaves[i] = {
            x = love.math.random(-20, 20),
            y = love.math.random(0, 30),
            z = love.math.random(-20, 20),
            spin = love.math.random() * math.pi * 2,
            fall = 0.5 + love.math.random(),
        }
    end
    return self
end

function Leaves:update(dt)
    for _, leaf in ipairs(self.leaves) do
        leaf.y = leaf.y - leaf.fall * dt
        leaf.spin = leaf.spin + dt
        if leaf.y < 0 then
            leaf.y = 30
        end
    end
end

function Leaves:draw(camera)
    lg.setShader(self.shader)
    lg.setDepthMode("lequal", true)
    self.shader:send("hashScale", 1.0)
    self.shader:send("sunDirection", {0.3, -0.8, 0.5})
    self.shader:send("sunColor", {1.0, 0.95, 0.8})
    self.shader:send("projectionMatrix", "column", camera.projection)
    self.shader:send("viewMatrix", "column", camera.view)
    lg.draw(self.mesh)
    lg.setShader()
end

return Leaves
