// Cuts [0, 1] into n equal parts and returns the index of the one that holds xi.
fn chosen_part(xi: f32, n: u32) -> u32 {
    return min(u32(i32(floor(clamp(xi, 0.0, 1.0) * f32(n)))), n - 1u);
}

fn is_coprime(first: u32, second: u32) -> bool {
    var a = first;
    var b = second;
    while b != 0u {
        let rest = a % b;
        a = b;
        b = rest;
    }
    return a == 1u;
}

// The stratum of sample i of n, n below 65,536: a permutation for every n and every xi in [0, 1]. Eq. 9, with a step
// that is drawn from the numbers coprime to n.
fn decorrelated(xi: vec2<f32>, i: u32, n: u32) -> u32 {
    var count = 0u;
    for (var candidate = 1u; candidate <= n; candidate++) {
        if is_coprime(candidate, n) {
            count++;
        }
    }
    let offset = chosen_part(xi.x, n);
    var left = chosen_part(xi.y, count);
    var step_size = 1u;
    for (var candidate = 1u; candidate <= n; candidate++) {
        if is_coprime(candidate, n) {
            if left == 0u {
                step_size = candidate;
                break;
            }
            left--;
        }
    }
    return (offset + (i % n) * step_size) % n;
}
