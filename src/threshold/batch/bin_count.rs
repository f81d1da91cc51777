//! The loop that counts thresholds in equal bins.

use super::block::BLOCK;
use super::isa::Job;
use super::lane::Kernel;

pub(super) struct Count<'a, R> {
    pub values: &'a [R],
    /// One more than there are bins.
    pub counts: &'a mut [u64],
}

impl<R: Kernel> Job for Count<'_, R> {
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let Self { values, counts } = self;
        let bins = counts.len() - 1;
        let [zero, one] = [0.0, 1.0].map(R::from_f64);
        let (scale, last) = (R::from_f64(bins as f64), R::from_f64(bins as f64 - 1.0));
        let mut index = [0_u32; BLOCK];
        for values in values.chunks(BLOCK) {
            for (index, &value) in index.iter_mut().zip(values) {
                let inside = (value >= zero) & (value <= one);
                let bin = R::min((value * scale).lane_floor::<FUSED>(), last).small_word();
                *index = if inside { bin } else { bins as u32 };
            }
            for &index in &index[..values.len()] {
                counts[index as usize] += 1;
            }
        }
    }
}
