export const hashedAlpha = /* glsl */`
// hashed-alpha 0.1.0: Listing 1 with every repair (not in the paper), join inherit, hash lowbias-linear, noise of 1 pixels
// After C. Wyman and M. McGuire, "Improved Alpha Testing Using Hashed Sampling" (2017).
// Discard a fragment where its alpha is below threshold(position, dpdx, dpdy).
// Verify it: hashed-alpha check FILE --nested-phase --join inherit
//   position: position on the surface, object units
//   dpdx: its change to the next pixel on the right, object units per pixel
//   dpdy: its change to the next pixel along screen y, object units per pixel
// Written by naga out of WGSL.


struct Cell {
    vec3 index;
    uint octave;
};
struct Scales {
    ivec3 octave;
    vec3 fraction;
};
const float SMALLEST_SIDE = 7.888609e-31;
const float GREATEST_SIDE = 1.2676506e30;


uint octave_word(ivec3 octave) {
    uvec3 word_2 = uvec3(octave);
    return ((word_2.x + ((word_2.y - word_2.x) << 11u)) + ((word_2.z - word_2.x) << 21u));
}

uint to_word(float x) {
    bool local = false;
    bool local_1 = false;
    uint bits = floatBitsToUint(x);
    uint exponent = ((bits >> 23u) & 255u);
    if ((exponent < 158u)) {
        return uint(int(x));
    }
    bool negative = ((bits >> 31u) == 1u);
    uint mantissa = ((bits & 8388607u) | 8388608u);
    if ((exponent >= 190u)) {
        if ((exponent == 255u)) {
            local = (mantissa != 8388608u);
        } else {
            local = false;
        }
        bool is_nan = local;
        if (!(negative)) {
            local_1 = is_nan;
        } else {
            local_1 = true;
        }
        bool _e34 = local_1;
        return (_e34 ? 0u : 4294967295u);
    }
    uint places = (exponent - 150u);
    uint magnitude = ((places < 32u) ? (mantissa << (places & 31u)) : 0u);
    return (negative ? (0u - magnitude) : magnitude);
}

uvec4 words(Cell cell) {
    uint _e3 = to_word(cell.index.x);
    uint _e6 = to_word(cell.index.y);
    uint _e9 = to_word(cell.index.z);
    return uvec4(_e3, _e6, _e9, cell.octave);
}

float open_lattice(uint word) {
    return (float(((2u * (word >> 9u)) + 1u)) * 5.9604645e-8);
}

uint weighted_sum(uvec4 words_1, uvec4 weights) {
    uvec4 products = (words_1 * weights);
    return (((products.x + products.y) + products.z) + products.w);
}

uint linear_word(uvec4 words_2) {
    uint _e6 = weighted_sum(words_2, uvec4(3340703199u, 3532135253u, 1653663831u, 1783037519u));
    return _e6;
}

uint lowbias(uint word_1) {
    uint h = 0u;
    h = ((word_1 ^ (word_1 >> 16u)) * 2146121005u);
    uint _e7 = h;
    uint _e8 = h;
    h = ((_e7 ^ (_e8 >> 15u)) * 2221713035u);
    uint _e14 = h;
    uint _e15 = h;
    return (_e14 ^ (_e15 >> 16u));
}

float hash_cell(Cell cell_1) {
    uvec4 _e1 = words(cell_1);
    uint _e2 = linear_word(_e1);
    uint _e3 = lowbias(_e2);
    float _e4 = open_lattice(_e3);
    return _e4;
}

float largest_component(vec3 v) {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

vec3 floored(vec3 side, vec3 given_position) {
    float _e2 = largest_component(given_position);
    float coordinate = (_e2 * 4.7683716e-7);
    float _e5 = largest_component(side);
    float longest = clamp(max(_e5, coordinate), SMALLEST_SIDE, GREATEST_SIDE);
    float smallest = max((longest * 0.03125), min(coordinate, GREATEST_SIDE));
    return clamp(side, vec3(smallest), vec3(longest));
}

Scales by_exponent(vec3 pixel_scale) {
    uvec3 bits_1 = floatBitsToUint(pixel_scale);
    ivec3 octave_6 = (ivec3((bits_1 >> uvec3(23u))) - ivec3(127));
    vec3 mantissa_1 = uintBitsToFloat(((bits_1 & uvec3(8388607u)) | uvec3(1065353216u)));
    return Scales(octave_6, clamp(log2(mantissa_1), vec3(0.0), vec3(0.99999994)));
}

vec3 power_of_two(ivec3 octave_1) {
    return uintBitsToFloat((uvec3((octave_1 + ivec3(127))) << uvec3(23u)));
}

Cell nested_cell(vec3 given_position_1, ivec3 octave_2) {
    vec3 _e2 = power_of_two(octave_2);
    vec3 scaled = (_e2 * given_position_1);
    vec3 whole = floor(scaled);
    bvec3 is_even = equal((octave_2 & ivec3(1)), ivec3(0));
    vec3 boundary = mix(vec3(0.33333334), vec3(0.6666667), is_even);
    vec3 index_1 = mix(whole, (whole + vec3(1.0)), greaterThanEqual((scaled - whole), boundary));
    uint _e22 = octave_word(octave_2);
    return Cell(index_1, _e22);
}

float length_of(vec3 v_1) {
    return sqrt((((v_1.x * v_1.x) + (v_1.y * v_1.y)) + (v_1.z * v_1.z)));
}

float safe_length(vec3 v_2) {
    bool local_2 = false;
    float _e1 = length_of(v_2);
    if ((_e1 > 8.881784e-16)) {
        local_2 = (_e1 < 1.1529215e18);
    } else {
        local_2 = false;
    }
    bool _e9 = local_2;
    if (_e9) {
        return _e1;
    }
    float _e10 = largest_component(v_2);
    if ((_e10 == 0.0)) {
        return 0.0;
    }
    float _e16 = length_of((v_2 / vec3(_e10)));
    return (_e10 * _e16);
}

Scales robust_scales(vec3 given_position_2, vec3 given_dpdx, vec3 given_dpdy, float hash_scale) {
    float _e4 = safe_length(given_dpdx);
    float _e5 = safe_length(given_dpdy);
    float max_derivative = max(_e4, _e5);
    float bounded_scale = clamp(hash_scale, SMALLEST_SIDE, GREATEST_SIDE);
    vec3 side_1 = vec3((bounded_scale * min(max_derivative, GREATEST_SIDE)));
    vec3 _e14 = floored(side_1, given_position_2);
    Scales _e18 = by_exponent((vec3(1.0) / _e14));
    return _e18;
}

bool is_fine(vec3 given_position_3, Scales scales) {
    Cell coarse = Cell(vec3(0.0), 0u);
    Cell _e3 = nested_cell(given_position_3, scales.octave);
    coarse = _e3;
    uint _e7 = coarse.octave;
    coarse.octave = (_e7 ^ 1779033703u);
    Cell _e12 = coarse;
    float _e13 = hash_cell(_e12);
    return (scales.fraction.x > _e13);
}

uvec3 origin(ivec3 octave_3) {
    return (uvec3(1431655765u) << (uvec3(octave_3) & uvec3(1u)));
}

ivec3 ancestor(ivec3 index, uvec3 begin, uvec3 octaves) {
    uvec3 beyond = (begin & ((uvec3(1u) << octaves) - uvec3(1u)));
    return ((index + ivec3(beyond)) >> octaves);
}

uint pair(uvec3 counted) {
    return (((counted.x ^ counted.z) & 1u) | (((counted.y ^ counted.z) & 1u) << 1u));
}

uint order_of_pairs(uvec3 counted_1, int octave_4) {
    uint combined = (((counted_1.x & 2047u) | ((counted_1.y & 2047u) << 11u)) | (counted_1.z << 22u));
    uint turned = ((uint(octave_4) << 16u) | (uint(octave_4) >> 16u));
    uint mixed = (((combined ^ (combined >> 16u)) ^ turned) * 2146121005u);
    return ((mixed ^ (mixed >> 15u)) * 2221713035u);
}

bool keeps(uint order, uint of_pair) {
    return ((order >> 30u) == of_pair);
}

uint share_of_pair(uint order_1, uint of_pair_1) {
    uint turn = ((((order_1 >> 14u) & 65535u) * 3u) >> 16u);
    uint turned_1 = ((of_pair_1 ^ (order_1 >> 30u)) + turn);
    bool _e20 = keeps(order_1, of_pair_1);
    return (_e20 ? 0u : ((turned_1 > 3u) ? (turned_1 - 3u) : turned_1));
}

float of_share(uint share, bool upper, float hash) {
    float value = (upper ? ((hash < 0.5) ? (hash + 0.5) : (hash - 0.5)) : hash);
    float below = (((share == 3u) ? 2.0 : 0.0) + ((share == 2u) ? 1.0 : 0.0));
    return ((share == 0u) ? value : ((below + value) * 0.33333334));
}

float inherited(ivec3 cell_2, int octave_5) {
    uvec3 counted_2 = uvec3(0u);
    uint climbed = 0u;
    uint order_2 = 0u;
    bool local_3 = false;
    uvec3 _e3 = origin(ivec3(octave_5));
    counted_2 = (uvec3(cell_2) + _e3);
    uvec3 _e9 = counted_2;
    uint _e15 = order_of_pairs((_e9 >> uvec3(1u)), (octave_5 - 1));
    order_2 = _e15;
    while(true) {
        uint _e17 = climbed;
        if ((_e17 < 3u)) {
            uint _e22 = order_2;
            uvec3 _e23 = counted_2;
            uint _e24 = pair(_e23);
            bool _e25 = keeps(_e22, _e24);
            local_3 = _e25;
        } else {
            local_3 = false;
        }
        bool _e27 = local_3;
        if (_e27) {
        } else {
            break;
        }
        {
            uint _e28 = climbed;
            climbed = (_e28 + 1u);
            uvec3 _e31 = counted_2;
            counted_2 = (_e31 >> uvec3(1u));
            uvec3 _e35 = counted_2;
            uint _e41 = climbed;
            uint _e44 = order_of_pairs((_e35 >> uvec3(1u)), ((octave_5 - 1) - int(_e41)));
            order_2 = _e44;
        }
    }
    uint _e45 = climbed;
    ivec3 _e49 = ancestor(cell_2, _e3, uvec3((_e45 + 1u)));
    vec3 index_2 = vec3(_e49);
    uint _e53 = climbed;
    float _e58 = hash_cell(Cell(index_2, uint(((octave_5 - 1) - int(_e53)))));
    uint _e59 = order_2;
    uvec3 _e60 = counted_2;
    uint _e61 = pair(_e60);
    uint _e62 = share_of_pair(_e59, _e61);
    uint _e64 = counted_2.z;
    float _e69 = of_share(_e62, ((_e64 & 1u) == 1u), _e58);
    return _e69;
}

float joined(vec3 given_position_4, Scales scales_1) {
    bool _e3 = is_fine(given_position_4, scales_1);
    ivec3 octave_7 = (scales_1.octave + ivec3((_e3 ? 1 : 0)));
    Cell _e9 = nested_cell(given_position_4, octave_7);
    float _e13 = inherited(ivec3(_e9.index), octave_7.x);
    return _e13;
}

bool is_finite(float x_1) {
    return ((floatBitsToUint(x_1) & 2139095040u) != 2139095040u);
}

bool all_finite(vec3 v_3) {
    bool local_4 = false;
    bool local_5 = false;
    bool _e2 = is_finite(v_3.x);
    if (_e2) {
        bool _e6 = is_finite(v_3.y);
        local_4 = _e6;
    } else {
        local_4 = false;
    }
    bool _e8 = local_4;
    if (_e8) {
        bool _e12 = is_finite(v_3.z);
        local_5 = _e12;
    } else {
        local_5 = false;
    }
    bool _e14 = local_5;
    return _e14;
}

float robust(vec3 given_position_5, vec3 given_dpdx_1, vec3 given_dpdy_1, float hash_scale_1) {
    bool local_6 = false;
    bool local_7 = false;
    bool local_8 = false;
    bool local_9 = false;
    bool _e4 = all_finite(given_position_5);
    if (_e4) {
        bool _e7 = all_finite(given_dpdx_1);
        local_6 = _e7;
    } else {
        local_6 = false;
    }
    bool _e9 = local_6;
    if (_e9) {
        bool _e12 = all_finite(given_dpdy_1);
        local_7 = _e12;
    } else {
        local_7 = false;
    }
    bool has_footprint = local_7;
    if (has_footprint) {
        bool _e17 = is_finite(hash_scale_1);
        local_8 = _e17;
    } else {
        local_8 = false;
    }
    bool _e19 = local_8;
    if (_e19) {
        local_9 = (hash_scale_1 > 0.0);
    } else {
        local_9 = false;
    }
    bool _e25 = local_9;
    if (!(_e25)) {
        return 0.5;
    }
    Scales _e28 = robust_scales(given_position_5, given_dpdx_1, given_dpdy_1, hash_scale_1);
    float _e29 = joined(given_position_5, _e28);
    return clamp(_e29, 5.9604645e-8, 1.0);
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy) {
    float _e4 = robust(position, dpdx, dpdy, 1.0);
    return _e4;
}

void testHashedAlpha(float alpha, vec3 position) {
    if (alpha < threshold(position, dFdx(position), dFdy(position))) discard;
}
`;

export function useHashedAlpha(material) {
    material.onBeforeCompile = (shader) => {
        shader.vertexShader = 'varying vec3 vObject;\n' + shader.vertexShader
            .replace('#include <begin_vertex>', '#include <begin_vertex>\nvObject = position;');
        shader.fragmentShader = 'varying vec3 vObject;\n' + hashedAlpha + shader.fragmentShader
            .replace('#include <alphatest_fragment>', 'testHashedAlpha(diffuseColor.a, vObject);');
    };
    return material;
}
