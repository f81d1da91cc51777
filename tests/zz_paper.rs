//! temporary
use hashed_alpha::check::{Draw, Subject, claims, run_claims};
#[test]
fn papers() {
    let mine: Vec<_> = claims::ALL.iter().copied().filter(|c| ["flips.", "frames.", "coordinates.", "determinism.", "symmetry.", "layers.quarter"].iter().any(|f| c.id.starts_with(f))).collect();
    for seed in 0..3 {
    let mut subjects: Vec<Subject<'static>> = Subject::paper();
    subjects.extend(Subject::all_repairs());
    for subject in subjects {
      for claim in &mine {
        let start = std::time::Instant::now();
        for o in run_claims(&[*claim], std::slice::from_ref(&subject), &Draw::seeded(seed), || {}) {
            println!("@ {seed} {} {} {} {} {:?} z {:?} eff {:?} det {:?} {:?}ms {}", o.subject, o.precision, o.check, o.verdict, o.rounds, o.statistic, o.effect, o.detectable, start.elapsed().as_millis(), if o.as_expected() { "" } else { o.finding.as_deref().unwrap_or("") });
        }
      }
    }}
}
