// The normal quantile of a value in [0, 1], its tail cut at 2^-25: u - 1/2 times a polynomial in the logarithm of
// 4 u (1 - u), itself by exponent and polynomial.
fn normal_quantile(u: f32) -> f32 {
    let tail = max(min(u, 1.0 - u), 0x1p-25f);
    let bits = bitcast<u32>(tail * (1.0 - tail));
    let x = bitcast<f32>((bits & 0x007fffffu) | 0x3f800000u) - 1.0;
    var logarithm = 0.01512536 * x - 0.07806214;
    logarithm = logarithm * x + 0.19208957;
    logarithm = logarithm * x - 0.32425395;
    logarithm = logarithm * x + 0.47289795;
    logarithm = logarithm * x - 0.720453;
    logarithm = logarithm * x + 1.4426563;
    logarithm = logarithm * x + 2.7727484e-7;
    let y = f32(i32(bits >> 23u) - 119) + logarithm;
    var quantile = 7.8446813e-16 * y + 5.67188e-14;
    quantile = quantile * y + 1.5113797e-12;
    quantile = quantile * y + 1.3883683e-11;
    quantile = quantile * y - 1.3665863e-10;
    quantile = quantile * y - 4.388371e-9;
    quantile = quantile * y - 3.2685755e-8;
    quantile = quantile * y + 1.9958847e-7;
    quantile = quantile * y + 6.828448e-6;
    quantile = quantile * y + 6.9778645e-5;
    quantile = quantile * y + 1.2410663e-4;
    quantile = quantile * y - 0.009921332;
    quantile = quantile * y - 0.4431668;
    quantile = quantile * y + 5.3595233;
    return (u - 0.5) * quantile;
}

// The probability that a standard normal variable is at most z. The lower tail is two to the power of a polynomial in
// |z|, which is cut at 5.7: by exponent and polynomial.
fn normal_cdf(z: f32) -> f32 {
    let x = min(abs(z), 5.7);
    var logarithm = 1.0515464e-6 - 3.7520767e-8 * x;
    logarithm = logarithm * x - 1.2702291e-5;
    logarithm = logarithm * x + 8.4609404e-5;
    logarithm = logarithm * x - 3.011109e-4;
    logarithm = logarithm * x + 3.1558135e-5;
    logarithm = logarithm * x + 0.006922451;
    logarithm = logarithm * x - 0.0524329;
    logarithm = logarithm * x - 0.4592214;
    logarithm = logarithm * x - 1.1511043;
    logarithm = logarithm * x - 1.0;
    let whole = round(logarithm);
    let rest = logarithm - whole;
    var power = 1.5345812e-4 * rest + 0.0013399931;
    power = power * rest + 0.009618489;
    power = power * rest + 0.055503286;
    power = power * rest + 0.24022646;
    power = power * rest + 0.6931472;
    power = power * rest + 1.0;
    let tail = power * bitcast<f32>(u32(i32(whole) + 127) << 23u);
    return select(1.0 - tail, tail, z < 0.0);
}
