// The threshold of frame i, in [2^-24, 1], in the order of the van der Corput sequence to the letter: uneven strata for an n
// that is no power of two. Section 7.2.3.
fn van_der_corput_literal(chi: f32, i: u32) -> f32 {
    let sum = chi + radical_inverse(i);
    return clamp_last(select(sum, sum - 1.0, sum > 1.0));
}
