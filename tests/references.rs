//! Every p-value function against references of high precision: `references/*.csv`, made by
//! `references/generate.py`.

use hashed_alpha::stats::chi_square::ChiSquare;
use hashed_alpha::stats::{beta, binomial, collisions, ecdf, fisher_g, normal, power, two_sample};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Relative error that is allowed, deep tails included.
const ALLOWED: f64 = 1e-10;

/// What the crate says for a row. `x` reads a parameter as a real number, `k` as a whole one.
fn ours(function: &str, parameters: &[&str]) -> f64 {
    let x = |i: usize| -> f64 { parameters[i].parse().expect("a number") };
    let k = |i: usize| -> u64 { parameters[i].parse().expect("a whole number") };
    match function {
        "normal.two_sided_p" => normal::two_sided_p(x(0)),
        "normal.upper_p" => normal::upper_p(x(0)),
        "normal.quantile" => normal::quantile(x(0)),
        "normal.minus_quantile" => -normal::quantile(x(0)),
        "binomial.upper_p" => binomial::upper_p(k(0), k(1), x(2)),
        "binomial.lower_p" => binomial::lower_p(k(0), k(1), x(2)),
        "binomial.poisson_upper_p" => binomial::poisson_upper_p(k(0), x(1)),
        "binomial.poisson_lower_p" => binomial::poisson_lower_p(k(0), x(1)),
        "binomial.clopper_pearson.low" => binomial::clopper_pearson(k(0), k(1), x(2)).0,
        "binomial.clopper_pearson.high" => binomial::clopper_pearson(k(0), k(1), x(2)).1,
        "chi_square.upper_p" => ChiSquare::new(x(0), k(1), 1).p,
        "chi_square.lower_p" => ChiSquare::new(x(0), k(1), 1).lower_p(),
        "beta.f_upper" => beta::f_tails(x(0), [k(1), k(2)]).upper,
        "beta.f_lower" => beta::f_tails(x(0), [k(1), k(2)]).lower,
        "beta.student_two_sided_p" => beta::student_two_sided_p(x(0), k(1)),
        "ecdf.upper_p" => ecdf::upper_p(x(0), k(1)),
        "ecdf.limit_upper_p" => ecdf::limit_upper_p(x(0)),
        "two_sample.upper_p" => two_sample::upper_p(k(0), [k(1), k(2)]),
        "fisher_g.upper_p" => fisher_g::upper_p(x(0), k(1)),
        "collisions.lower" => collisions::collisions(k(0), k(1), k(2)).tails.lower,
        "collisions.upper" => collisions::collisions(k(0), k(1), k(2)).tails.upper,
        "power.noncentrality" => power::noncentrality(k(0), x(1), x(2)),
        other => panic!("no function {other}"),
    }
}

#[test]
fn p_values_agree_with_references() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/references");
    let mut rows = 0;
    let mut worst: BTreeMap<String, (f64, String)> = BTreeMap::new();
    for file in fs::read_dir(folder).expect("the folder of references") {
        let path = file.expect("an entry").path();
        if path.extension().is_none_or(|extension| extension != "csv") {
            continue;
        }
        for row in fs::read_to_string(&path).expect("a table").lines().skip(1) {
            let cells: Vec<&str> = row.split(',').collect();
            let [function, parameters, reference] = cells[..] else { panic!("{path:?}: {row}") };
            let reference: f64 = reference.parse().expect("a reference");
            let ours = ours(function, &parameters.split(' ').collect::<Vec<_>>());
            let error = (ours / reference - 1.0).abs();
            let seen = worst.entry(function.to_owned()).or_default();
            if error.is_nan() || error > seen.0 {
                *seen = (error, format!("{row}: {ours:e}"));
            }
            rows += 1;
        }
    }
    assert!(rows > 1200, "{rows} rows");
    for (function, (error, row)) in worst {
        assert!(error <= ALLOWED, "{function} is off by a relative {error:e}: {row}");
    }
}
