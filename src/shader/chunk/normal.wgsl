// The normal quantile of a value in [0, 1], cut to [2^-25, 1 - 2^-25]: Wichura's PPND7 (AS 241, 1988).
fn normal_quantile(probability: f32) -> f32 {
    let centred = probability - 0.5;
    if abs(centred) <= 0.425 {
        let r = 0.180625 - centred * centred;
        let numerator = ((59.109375 * r + 159.29113) * r + 50.434273) * r + 3.3871328;
        let denominator = ((67.18756 * r + 78.75776) * r + 17.895170) * r + 1.0;
        return centred * numerator / denominator;
    }
    let tail = max(min(probability, 1.0 - probability), 0x1p-25f);
    let r = sqrt(-log(tail)) - 1.6;
    let numerator = ((0.17023821 * r + 1.3067285) * r + 2.7568154) * r + 1.4234373;
    let denominator = (0.12021133 * r + 0.73700166) * r + 1.0;
    let deviation = numerator / denominator;
    return select(deviation, -deviation, centred < 0.0);
}

// The probability that a standard normal variable is at most z, for |z| up to 5.8. The upper tail is exp(-z^2 / 2)
// times a polynomial in 1 / (1 + 0.28 z) that was fitted to relative error 2.4e-8.
fn normal_cdf(z: f32) -> f32 {
    let t = 1.0 / (1.0 + 0.28 * abs(z));
    var polynomial = 0.038207315 * t - 0.20934212;
    polynomial = polynomial * t + 0.38090846;
    polynomial = polynomial * t - 0.23205458;
    polynomial = polynomial * t + 0.23424561;
    polynomial = polynomial * t + 0.057432927;
    polynomial = polynomial * t + 0.11946711;
    polynomial = polynomial * t + 0.11113527;
    let tail = exp(-0.5 * z * z) * (polynomial * t);
    return select(1.0 - tail, tail, z < 0.0);
}
