//! A run depends on its seed, not on the number of threads.

use hashed_alpha::check::{Budget, Draw, Results, Subject, Suite, claims, run_claims};

/// Every number of every outcome, to the last bit, and the text that is made of them.
fn everything_said(subject: &Subject<'_>, threads: usize) -> String {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started");
    let draw = Draw { budget: Budget::Quick, ..Draw::default() };
    let outcomes = pool.install(|| run_claims(claims::ALL, core::slice::from_ref(subject), &draw, || {}));
    let numbers = format!("{outcomes:?}");
    numbers + &Results::new(outcomes, Suite::All).to_string()
}

#[test]
fn one_thread_and_two_say_the_same() {
    let subject = &Subject::paper()[0];
    let [one, two] = [1, 2].map(|threads| everything_said(subject, threads));
    assert!(one.len() > 10_000);
    // No diff: the text has a hundred thousand characters.
    assert!(one == two, "the outcomes of two threads differ from those of one");
}
