// hashed-alpha 0.1.0: Listing 1 with every repair (not in the paper), join inherit, hash lowbias-linear, noise of 1 pixels
// After C. Wyman and M. McGuire, "Improved Alpha Testing Using Hashed Sampling" (2017).
// Discard a fragment where its alpha is below threshold(position, dpdx, dpdy).
//   position: position on the surface, object units
//   dpdx: its change to the next pixel on the right, object units per pixel
//   dpdy: its change to the next pixel along screen y, object units per pixel
// Written by naga out of WGSL.

struct Cell {
    float3 index;
    uint octave;
};

struct Scales {
    int3 octave;
    int _pad1_0;
    float3 fraction;
    int _end_pad_0;
};

static const float SMALLEST_SIDE = 7.888609e-31;
static const float GREATEST_SIDE = 1.2676506e30;

uint octave_word(int3 octave)
{
    uint3 word_2 = asuint(octave);
    return ((word_2.x + ((word_2.y - word_2.x) << 11u)) + ((word_2.z - word_2.x) << 21u));
}

int naga_f2i32(float value) {
    return int(clamp(value, -2147483600.0, 2147483500.0));
}

uint to_word(float x)
{
    bool local = (bool)0;
    bool local_1 = (bool)0;

    uint bits = asuint(x);
    uint exponent = ((bits >> 23u) & 255u);
    if ((exponent < 158u)) {
        return asuint(naga_f2i32(x));
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

uint4 words(Cell cell)
{
    const uint _e3 = to_word(cell.index.x);
    const uint _e6 = to_word(cell.index.y);
    const uint _e9 = to_word(cell.index.z);
    return uint4(_e3, _e6, _e9, cell.octave);
}

float open_lattice(uint word)
{
    return (float(((2u * (word >> 9u)) + 1u)) * 5.9604645e-8);
}

uint weighted_sum(uint4 words_1, uint4 weights)
{
    uint4 products = (words_1 * weights);
    return (((products.x + products.y) + products.z) + products.w);
}

uint linear_word(uint4 words_2)
{
    const uint _e6 = weighted_sum(words_2, uint4(3340703199u, 3532135253u, 1653663831u, 1783037519u));
    return _e6;
}

uint lowbias(uint word_1)
{
    uint h = (uint)0;

    h = ((word_1 ^ (word_1 >> 16u)) * 2146121005u);
    uint _e7 = h;
    uint _e8 = h;
    h = ((_e7 ^ (_e8 >> 15u)) * 2221713035u);
    uint _e14 = h;
    uint _e15 = h;
    return (_e14 ^ (_e15 >> 16u));
}

float hash_cell(Cell cell_1)
{
    const uint4 _e1 = words(cell_1);
    const uint _e2 = linear_word(_e1);
    const uint _e3 = lowbias(_e2);
    const float _e4 = open_lattice(_e3);
    return _e4;
}

float largest_component(float3 v)
{
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

float3 floored(float3 side, float3 given_position)
{
    const float _e2 = largest_component(given_position);
    float coordinate = (_e2 * 4.7683716e-7);
    const float _e5 = largest_component(side);
    float longest = clamp(max(_e5, coordinate), SMALLEST_SIDE, GREATEST_SIDE);
    float smallest = max((longest * 0.03125), min(coordinate, GREATEST_SIDE));
    return clamp(side, (smallest).xxx, (longest).xxx);
}

Scales ConstructScales(int3 arg0, float3 arg1) {
    Scales ret = (Scales)0;
    ret.octave = arg0;
    ret.fraction = arg1;
    return ret;
}

Scales by_exponent(float3 pixel_scale)
{
    uint3 bits_1 = asuint(pixel_scale);
    int3 octave_6 = asint(asuint(asint((bits_1 >> (23u).xxx))) - asuint((int(127)).xxx));
    float3 mantissa_1 = asfloat(((bits_1 & (8388607u).xxx) | (1065353216u).xxx));
    const Scales scales_2 = ConstructScales(octave_6, clamp(log2(mantissa_1), (0.0).xxx, (0.99999994).xxx));
    return scales_2;
}

float3 power_of_two(int3 octave_1)
{
    return asfloat((asuint(asint(asuint(octave_1) + asuint((int(127)).xxx))) << (23u).xxx));
}

Cell ConstructCell(float3 arg0, uint arg1) {
    Cell ret = (Cell)0;
    ret.index = arg0;
    ret.octave = arg1;
    return ret;
}

Cell nested_cell(float3 given_position_1, int3 octave_2)
{
    const float3 _e2 = power_of_two(octave_2);
    float3 scaled = (_e2 * given_position_1);
    float3 whole = floor(scaled);
    bool3 is_even = ((octave_2 & (int(1)).xxx) == (int(0)).xxx);
    float3 boundary = (is_even ? (0.6666667).xxx : (0.33333334).xxx);
    float3 index_1 = (((scaled - whole) >= boundary) ? (whole + (1.0).xxx) : whole);
    const uint _e22 = octave_word(octave_2);
    const Cell cell_3 = ConstructCell(index_1, _e22);
    return cell_3;
}

float length_of(float3 v_1)
{
    return sqrt((((v_1.x * v_1.x) + (v_1.y * v_1.y)) + (v_1.z * v_1.z)));
}

float safe_length(float3 v_2)
{
    bool local_2 = (bool)0;

    const float _e1 = length_of(v_2);
    if ((_e1 > 8.881784e-16)) {
        local_2 = (_e1 < 1.1529215e18);
    } else {
        local_2 = false;
    }
    bool _e9 = local_2;
    if (_e9) {
        return _e1;
    }
    const float _e10 = largest_component(v_2);
    if ((_e10 == 0.0)) {
        return 0.0;
    }
    const float _e16 = length_of((v_2 / (_e10).xxx));
    return (_e10 * _e16);
}

Scales robust_scales(float3 given_position_2, float3 given_dpdx, float3 given_dpdy, float hash_scale)
{
    const float _e4 = safe_length(given_dpdx);
    const float _e5 = safe_length(given_dpdy);
    float max_derivative = max(_e4, _e5);
    float bounded_scale = clamp(hash_scale, SMALLEST_SIDE, GREATEST_SIDE);
    float3 side_1 = ((bounded_scale * min(max_derivative, GREATEST_SIDE))).xxx;
    const float3 _e14 = floored(side_1, given_position_2);
    const Scales _e18 = by_exponent(((1.0).xxx / _e14));
    const Scales scales_3 = _e18;
    return scales_3;
}

bool is_fine(float3 given_position_3, Scales scales)
{
    Cell coarse = (Cell)0;

    const Cell _e3 = nested_cell(given_position_3, scales.octave);
    coarse = _e3;
    uint _e7 = coarse.octave;
    coarse.octave = (_e7 ^ 1779033703u);
    Cell _e12 = coarse;
    const float _e13 = hash_cell(_e12);
    return (scales.fraction.x > _e13);
}

uint3 origin(int3 octave_3)
{
    return ((1431655765u).xxx << (asuint(octave_3) & (1u).xxx));
}

int3 ancestor(int3 index, uint3 begin, uint3 octaves)
{
    uint3 beyond = (begin & (((1u).xxx << octaves) - (1u).xxx));
    return (asint(asuint(index) + asuint(asint(beyond))) >> octaves);
}

uint pair(uint3 counted)
{
    return (((counted.x ^ counted.z) & 1u) | (((counted.y ^ counted.z) & 1u) << 1u));
}

uint order_of_pairs(uint3 counted_1, int octave_4)
{
    uint combined = (((counted_1.x & 2047u) | ((counted_1.y & 2047u) << 11u)) | (counted_1.z << 22u));
    uint turned = ((asuint(octave_4) << 16u) | (asuint(octave_4) >> 16u));
    uint mixed = (((combined ^ (combined >> 16u)) ^ turned) * 2146121005u);
    return ((mixed ^ (mixed >> 15u)) * 2221713035u);
}

bool keeps(uint order, uint of_pair)
{
    return ((order >> 30u) == of_pair);
}

uint share_of_pair(uint order_1, uint of_pair_1)
{
    uint turn = ((((order_1 >> 14u) & 65535u) * 3u) >> 16u);
    uint turned_1 = ((of_pair_1 ^ (order_1 >> 30u)) + turn);
    const bool _e20 = keeps(order_1, of_pair_1);
    return (_e20 ? 0u : ((turned_1 > 3u) ? (turned_1 - 3u) : turned_1));
}

float of_share(uint share, bool upper, float hash)
{
    float value = (upper ? ((hash < 0.5) ? (hash + 0.5) : (hash - 0.5)) : hash);
    float below = (((share == 3u) ? 2.0 : 0.0) + ((share == 2u) ? 1.0 : 0.0));
    return ((share == 0u) ? value : ((below + value) * 0.33333334));
}

float inherited(int3 cell_2, int octave_5)
{
    uint3 counted_2 = (uint3)0;
    uint climbed = 0u;
    uint order_2 = (uint)0;
    bool local_3 = (bool)0;

    const uint3 _e3 = origin((octave_5).xxx);
    counted_2 = (asuint(cell_2) + _e3);
    uint3 _e9 = counted_2;
    const uint _e15 = order_of_pairs((_e9 >> (1u).xxx), asint(asuint(octave_5) - asuint(int(1))));
    order_2 = _e15;
    while(true) {
        uint _e17 = climbed;
        if ((_e17 < 3u)) {
            uint _e22 = order_2;
            uint3 _e23 = counted_2;
            const uint _e24 = pair(_e23);
            const bool _e25 = keeps(_e22, _e24);
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
            uint3 _e31 = counted_2;
            counted_2 = (_e31 >> (1u).xxx);
            uint3 _e35 = counted_2;
            uint _e41 = climbed;
            const uint _e44 = order_of_pairs((_e35 >> (1u).xxx), asint(asuint(asint(asuint(octave_5) - asuint(int(1)))) - asuint(int(_e41))));
            order_2 = _e44;
        }
    }
    uint _e45 = climbed;
    const int3 _e49 = ancestor(cell_2, _e3, ((_e45 + 1u)).xxx);
    float3 index_2 = float3(_e49);
    uint _e53 = climbed;
    const float _e58 = hash_cell(ConstructCell(index_2, asuint(asint(asuint(asint(asuint(octave_5) - asuint(int(1)))) - asuint(int(_e53))))));
    uint _e59 = order_2;
    uint3 _e60 = counted_2;
    const uint _e61 = pair(_e60);
    const uint _e62 = share_of_pair(_e59, _e61);
    uint _e64 = counted_2.z;
    const float _e69 = of_share(_e62, ((_e64 & 1u) == 1u), _e58);
    return _e69;
}

int3 naga_f2i32(float3 value) {
    return int3(clamp(value, -2147483600.0, 2147483500.0));
}

float joined(float3 given_position_4, Scales scales_1)
{
    const bool _e3 = is_fine(given_position_4, scales_1);
    int3 octave_7 = asint(asuint(scales_1.octave) + asuint(((_e3 ? int(1) : int(0))).xxx));
    const Cell _e9 = nested_cell(given_position_4, octave_7);
    const float _e13 = inherited(naga_f2i32(_e9.index), octave_7.x);
    return _e13;
}

bool is_finite(float x_1)
{
    return ((asuint(x_1) & 2139095040u) != 2139095040u);
}

bool all_finite(float3 v_3)
{
    bool local_4 = (bool)0;
    bool local_5 = (bool)0;

    const bool _e2 = is_finite(v_3.x);
    if (_e2) {
        const bool _e6 = is_finite(v_3.y);
        local_4 = _e6;
    } else {
        local_4 = false;
    }
    bool _e8 = local_4;
    if (_e8) {
        const bool _e12 = is_finite(v_3.z);
        local_5 = _e12;
    } else {
        local_5 = false;
    }
    bool _e14 = local_5;
    return _e14;
}

float robust(float3 given_position_5, float3 given_dpdx_1, float3 given_dpdy_1, float hash_scale_1)
{
    bool local_6 = (bool)0;
    bool local_7 = (bool)0;
    bool local_8 = (bool)0;
    bool local_9 = (bool)0;

    const bool _e4 = all_finite(given_position_5);
    if (_e4) {
        const bool _e7 = all_finite(given_dpdx_1);
        local_6 = _e7;
    } else {
        local_6 = false;
    }
    bool _e9 = local_6;
    if (_e9) {
        const bool _e12 = all_finite(given_dpdy_1);
        local_7 = _e12;
    } else {
        local_7 = false;
    }
    bool has_footprint = local_7;
    if (has_footprint) {
        const bool _e17 = is_finite(hash_scale_1);
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
    const Scales _e28 = robust_scales(given_position_5, given_dpdx_1, given_dpdy_1, hash_scale_1);
    const float _e29 = joined(given_position_5, _e28);
    return clamp(_e29, 5.9604645e-8, 1.0);
}

float threshold(float3 position, float3 dpdx, float3 dpdy)
{
    const float _e4 = robust(position, dpdx, dpdy, 1.0);
    return _e4;
}

float HashedOpacityMask(float opacity, float3 localPosition)
{
    return opacity < threshold(localPosition, ddx(localPosition), ddy(localPosition)) ? 0.0 : 1.0;
}
