#version 450
// Robust, without an interpolation: each coarse cell decides by a hash of its own when it splits, so there is no
// distribution to correct.

uint scramble(uint v) {
    uint state = v * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

ivec3 cellOf(vec3 p, int octave) {
    float edge = (octave & 1) == 0 ? 2.0 / 3.0 : 1.0 / 3.0;
    vec3 scaled = p * exp2(float(octave));
    vec3 whole = floor(scaled);
    return ivec3(whole) + ivec3(greaterThanEqual(scaled - whole, vec3(edge)));
}

float noiseOf(ivec3 cell, int octave, uint salt) {
    uint words[4] = uint[4](uint(octave) ^ salt, uint(cell.z), uint(cell.y), uint(cell.x));
    uint h = 0u;
    for (int i = 0; i < 4; ++i) {
        h = scramble(h + words[i]);
    }
    return float(2u * (h >> 9) + 1u) / 16777216.0;
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy, float hash_scale) {
    vec3 reach = abs(position);
    float side = max(hash_scale * max(length(dpdx), length(dpdy)), max(reach.x, max(reach.y, reach.z)) / 2097152.0);
    uint bits = floatBitsToUint(1.0 / clamp(side, 1.0e-18, 1.0e18));
    int octave = int(bits >> 23) - 127;
    float weight = log2(uintBitsToFloat((bits & 0x7fffffu) | 0x3f800000u));

    bool splits = weight > noiseOf(cellOf(position, octave), octave, 0x80000000u);
    octave += splits ? 1 : 0;
    return noiseOf(cellOf(position, octave), octave, 0u);
}
