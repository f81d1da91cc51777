local g3d = require "lib.g3d"
local Grass = {}
Grass.__index = Grass

local shaderCode = [[
varying vec3 modelPos;

#ifdef VERTEX
uniform mat4 projectionMatrix;
uniform mat4 viewMatrix;
uniform mat4 modelMatrix;

vec4 position(mat4 transform_projection, vec4 vertex_position)
{
    modelPos = vertex_position.xyz;
    return projectionMatrix * viewMatrix * modelMatrix * vertex_position;
}
#endif

#ifdef PIXEL
extern number hashScale;

number hash2(vec2 p)
{
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

number hash3(vec3 p)
{
    return hash2(vec2(hash2(p.xy), p.z));
}

vec4 effect(vec4 color, Image tex, vec2 texture_coords, vec2 screen_coords)
{
    vec4 texcolor = Texel(tex, texture_coords) * color;

    number maxDeriv = max(length(dFdx(modelPos)), length(dFdy(modelPos)));
    number pixScale = 1.0 / (hashScale * maxDeriv);
    vec2 pixScales = vec2(exp2(floor(log2(pixScale))), exp2(ceil(log2(pixScale))));
    vec2 noise = vec2(hash3(floor(pixScales.x * modelPos)), hash3(floor(pixScales.x * modelPos)));
    number f = fract(log2(pixScale));
    number x = mix(noise.x, noise.y, f);
    number a = min(f, 1.0 - f);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    number t = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
    if (texcolor.a < clamp(t, 1.0e-6, 1.0)) discard;
    return vec4(texcolor.rgb, 1.0);
}
#endif
]]

function Grass.new(model, texture)
    local self = setmetatable({}, Grass)
    self.model = g3d.newModel(model, texture)
    self.shader = love.graphics.newShader(shaderCode)
    self.shader:send("hashScale", 1.0)
    return self
end

function Grass:draw()
    love.graphics.setShader(self.shader)
    self.model:draw(self.shader)
    love.graphics.setShader()
end

return Grass
