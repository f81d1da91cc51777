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

// The offset and the step by which the n samples of a fragment, n below 65,536, take the strata: one pair for all of
// them. Eq. 9, with a step that is drawn from the numbers coprime to n, which are the odd ones for a power of two.
fn permutation(xi: vec2<f32>, n: u32) -> vec2<u32> {
    let offset = chosen_part(xi.x, n);
    if (n & (n - 1u)) == 0u {
        return vec2<u32>(offset, 2u * chosen_part(xi.y, max(n / 2u, 1u)) + 1u);
    }
    var count = 0u;
    for (var candidate = 1u; candidate <= n; candidate++) {
        if is_coprime(candidate, n) {
            count++;
        }
    }
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
    return vec2<u32>(offset, step_size);
}

// The stratum of sample i of n: a permutation for every n and every xi in [0, 1].
fn decorrelated(xi: vec2<f32>, i: u32, n: u32) -> u32 {
    let order = permutation(xi, n);
    return (order.x + (i % n) * order.y) % n;
}
