import { MaterialPluginBase, ShaderStore } from '@babylonjs/core';

ShaderStore.IncludesShadersStore['hashedAlpha'] = `
// hashed-alpha 0.1.0: Listing 1 with every repair (not in the paper), join interpolate, hash mm4, noise of 1 pixels
// After C. Wyman and M. McGuire, "Improved Alpha Testing Using Hashed Sampling" (2017).
// Discard a fragment where its alpha is below threshold(position, dpdx, dpdy).
// Verify it: hashed-alpha check FILE --nested-phase
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
    uvec3 word_3 = uvec3(octave);
    return ((word_3.x + ((word_3.y - word_3.x) << 11u)) + ((word_3.z - word_3.x) << 21u));
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
    uint places_1 = (exponent - 150u);
    uint magnitude = ((places_1 < 32u) ? (mantissa << (places_1 & 31u)) : 0u);
    return (negative ? (0u - magnitude) : magnitude);
}

float open_lattice(uint word) {
    return (float(((2u * (word >> 9u)) + 1u)) * 5.9604645e-8);
}

uint rotated_left(uint word_1, uint places) {
    return ((word_1 << places) | (word_1 >> (32u - places)));
}

uint murmur_step(uint state, uint word_2) {
    uint _e5 = rotated_left((word_2 * 3432918353u), 15u);
    uint mixed = (state ^ (_e5 * 461845907u));
    uint _e10 = rotated_left(mixed, 13u);
    return ((_e10 * 5u) + 3864292196u);
}

uint murmur_end(uint state_1) {
    uint h = 0u;
    h = (state_1 ^ 16u);
    uint _e4 = h;
    uint _e5 = h;
    h = ((_e4 ^ (_e5 >> 16u)) * 2246822507u);
    uint _e11 = h;
    uint _e12 = h;
    h = ((_e11 ^ (_e12 >> 13u)) * 3266489909u);
    uint _e18 = h;
    uint _e19 = h;
    return (_e18 ^ (_e19 >> 16u));
}

float hash_cell(Cell cell) {
    uint h_1 = 0u;
    uint _e4 = to_word(cell.index.x);
    uint _e5 = murmur_step(0u, _e4);
    h_1 = _e5;
    uint _e7 = h_1;
    uint _e10 = to_word(cell.index.y);
    uint _e11 = murmur_step(_e7, _e10);
    h_1 = _e11;
    uint _e12 = h_1;
    uint _e15 = to_word(cell.index.z);
    uint _e16 = murmur_step(_e12, _e15);
    h_1 = _e16;
    uint _e17 = h_1;
    uint _e19 = murmur_step(_e17, cell.octave);
    uint _e20 = murmur_end(_e19);
    float _e21 = open_lattice(_e20);
    return _e21;
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
    ivec3 octave_3 = (ivec3((bits_1 >> uvec3(23u))) - ivec3(127));
    vec3 mantissa_1 = uintBitsToFloat(((bits_1 & uvec3(8388607u)) | uvec3(1065353216u)));
    return Scales(octave_3, clamp(log2(mantissa_1), vec3(0.0), vec3(0.99999994)));
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
    vec3 index = mix(whole, (whole + vec3(1.0)), greaterThanEqual((scaled - whole), boundary));
    uint _e22 = octave_word(octave_2);
    return Cell(index, _e22);
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

float cdf(float x_1, float lerp_factor) {
    float a = min(lerp_factor, (1.0 - lerp_factor));
    float b = (1.0 - a);
    float from_top = (1.0 - x_1);
    if ((x_1 < a)) {
        return ((0.5 * x_1) * ((x_1 / a) / b));
    }
    if ((from_top < a)) {
        return (1.0 - ((0.5 * from_top) * ((from_top / a) / b)));
    }
    return ((x_1 - (0.5 * a)) / b);
}

float interpolated(vec3 given_position_3, Scales scales, float weight) {
    Cell _e4 = nested_cell(given_position_3, scales.octave);
    float _e5 = hash_cell(_e4);
    Cell _e10 = nested_cell(given_position_3, (scales.octave + ivec3(1)));
    float _e11 = hash_cell(_e10);
    float mixture = (((1.0 - weight) * _e5) + (weight * _e11));
    float _e17 = cdf(mixture, weight);
    return _e17;
}

float joined(vec3 given_position_4, Scales scales_1) {
    float _e4 = interpolated(given_position_4, scales_1, scales_1.fraction.x);
    return _e4;
}

bool is_finite(float x_2) {
    return ((floatBitsToUint(x_2) & 2139095040u) != 2139095040u);
}

bool all_finite(vec3 v_3) {
    bool local_3 = false;
    bool local_4 = false;
    bool _e2 = is_finite(v_3.x);
    if (_e2) {
        bool _e6 = is_finite(v_3.y);
        local_3 = _e6;
    } else {
        local_3 = false;
    }
    bool _e8 = local_3;
    if (_e8) {
        bool _e12 = is_finite(v_3.z);
        local_4 = _e12;
    } else {
        local_4 = false;
    }
    bool _e14 = local_4;
    return _e14;
}

float robust(vec3 given_position_5, vec3 given_dpdx_1, vec3 given_dpdy_1, float hash_scale_1) {
    bool local_5 = false;
    bool local_6 = false;
    bool local_7 = false;
    bool local_8 = false;
    bool _e4 = all_finite(given_position_5);
    if (_e4) {
        bool _e7 = all_finite(given_dpdx_1);
        local_5 = _e7;
    } else {
        local_5 = false;
    }
    bool _e9 = local_5;
    if (_e9) {
        bool _e12 = all_finite(given_dpdy_1);
        local_6 = _e12;
    } else {
        local_6 = false;
    }
    bool has_footprint = local_6;
    if (has_footprint) {
        bool _e17 = is_finite(hash_scale_1);
        local_7 = _e17;
    } else {
        local_7 = false;
    }
    bool _e19 = local_7;
    if (_e19) {
        local_8 = (hash_scale_1 > 0.0);
    } else {
        local_8 = false;
    }
    bool _e25 = local_8;
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

export class HashedAlphaPlugin extends MaterialPluginBase {
    constructor(material) {
        super(material, 'HashedAlpha', 200, {});
        this._enable(true);
    }
    getCustomCode(stage) {
        return stage === 'vertex'
            ? { CUSTOM_VERTEX_DEFINITIONS: 'varying vec3 vObject;', CUSTOM_VERTEX_UPDATE_POSITION: 'vObject = positionUpdated;' }
            : { CUSTOM_FRAGMENT_DEFINITIONS: 'varying vec3 vObject;\n#include<hashedAlpha>',
                CUSTOM_FRAGMENT_UPDATE_ALPHA: 'testHashedAlpha(alpha, vObject);' };
    }
}
