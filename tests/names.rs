//! What a user may type is what we print.

use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::robust::{Join, Repair};
use hashed_alpha::threshold::two_scale::Variant;
use std::fmt::Display;
use std::str::FromStr;

/// Every value is read back from what it prints, padded or not; another word is refused with all that are known.
fn are_read_back<T: Copy + Display + FromStr<Err: Display> + PartialEq>(all: &[T]) {
    for value in all {
        let printed = value.to_string();
        assert!(!printed.is_empty() && printed.parse().is_ok_and(|read: T| read == *value), "{printed}");
        assert_eq!(format!("{value:>24}").trim_start(), printed);
    }
    let Err(refusal) = T::from_str("nonesuch").map(|_| ()) else { panic!("`nonesuch` is no name") };
    let refusal = refusal.to_string();
    assert!(all.iter().all(|value| refusal.contains(&value.to_string())), "{refusal}");
}

#[test]
fn names_are_read_back() {
    are_read_back(&Variant::ALL);
    are_read_back(&HashKind::ALL);
    are_read_back(&Join::ALL);
    are_read_back(&Repair::ALL);
    are_read_back(&CdfForm::ALL);
}
