float hash(vec2 n) {
    return fract(1.0e4 * sin(17.0 * n.x + 0.1 * n.y) * (0.1 + abs(sin(13.0 * n.y + n.x))));
}

float hash3D(vec3 n) {
    return hash(vec2(hash(n.xy), n.z));
}

struct Octaves {
    float lower;
    float upper;
    float weight;
};

Octaves octavesOf(float scale) {
    float l = log2(scale);
    Octaves o;
    o.lower = exp2(floor(l));
    o.upper = exp2(ceil(l));
    o.weight = fract(l);
    return o;
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy) {
    // square root of the longer of the two, squared
    float longest = sqrt(max(dot(dpdx, dpdx), dot(dpdy, dpdy)));
    Octaves o = octavesOf(1.0 / longest);

    float x = (1.0 - o.weight) * hash3D(floor(o.lower * position))
            + o.weight * hash3D(floor(o.upper * position));

    float a = min(o.weight, 1.0 - o.weight);
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
