//! `stats::histogram`.

use hashed_alpha::stats::histogram::*;

#[test]
fn ends_fall_in_the_first_and_last_bin() {
    let mut h = Histogram::new(4);
    h.extend([0.0, -0.0, 0.25, 0.5, 0.75, 1.0, 1.0_f64.next_down()]);
    assert_eq!(h.counts(), [2, 1, 1, 3]);
    assert_eq!((h.total(), h.outside), (7, 0));
}

#[test]
fn what_is_not_in_the_interval_is_counted_apart() {
    let mut h = Histogram::new(2);
    h.extend([f64::NAN, -1e-300, 1.0_f64.next_up(), f64::INFINITY, 0.1]);
    assert_eq!((h.total(), h.outside), (1, 4));
}

#[test]
fn parts_merge_to_the_whole() {
    let values: Vec<f64> = (0..100).map(|i| f64::from(i) / 90.0).collect();
    let mut whole = Histogram::new(7);
    whole.extend(values.iter().copied());
    let (mut left, mut right) = (Histogram::new(7), Histogram::new(7));
    left.extend(values[..33].iter().copied());
    right.extend(values[33..].iter().copied());
    left.merge(&right);
    assert_eq!(left, whole);
}
