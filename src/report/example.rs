//! Outcomes of every kind, for the tests of this wing.

use crate::check::evidence::{ComparedShare, NamedHistogram};
use crate::check::subject::Precision;
use crate::check::{Domain, Evidence, Outcome, Verdict};
use crate::threshold::two_scale::Variant;

/// An outcome without remark.
pub fn consistent() -> Outcome {
    Outcome {
        check: "uniform.by_lerp_factor",
        anchor: "§5.4.2, Eq. 2",
        statement: "Thresholds are uniform for every lerp factor.",
        subject: "paper:isotropic".to_owned(),
        variant: Variant::Single,
        precision: Precision::F32,
        verdict: Verdict::Consistent,
        expected: Verdict::Consistent,
        statistic: Some(61.237),
        statistic_name: "chi-square, 63 dof".to_owned(),
        n: 1_048_576,
        p: Some(0.5386),
        p_holm: Some(1.0),
        effect: Some(5.84e-5),
        effect_name: "excess chi-square per sample",
        detectable: Some(1.6e-4),
        domain: Domain::default(),
        seed: 18_446_744_073_709_551_615,
        seen: None,
        known: None,
        listing: None,
        rounds: 1,
        evidence: Evidence::Histograms(vec![NamedHistogram {
            name: "all".to_owned(),
            counts: vec![9, 11, 10, 10],
        }]),
    }
}

/// One outcome of every kind.
pub fn outcomes() -> Vec<Outcome> {
    let seen = |text: &str| Some(text.to_owned());
    let shares = ["along x", "along y"].map(|series| ComparedShare {
        series: series.to_owned(),
        x: 0.25,
        measured: 0.37,
        predicted: 0.36,
        sigma: 0.003,
    });
    vec![
        consistent(),
        Outcome {
            check: "stability.translate",
            anchor: "§5",
            statement: "A sub-pixel shift changes the share of thresholds that the cell size says.",
            subject: "<script>alert(1)</script> & co".to_owned(),
            verdict: Verdict::Rejected,
            statistic: Some(f64::INFINITY),
            p: Some(0.0),
            p_holm: Some(0.0),
            seen: seen(
                "of 65536 thresholds 37 % change where 18 % are predicted: the derivative along screen y looks like \
                 the one along screen x, and the finer of the two scales is twice as fine as Listing 1 says",
            ),
            evidence: Evidence::Shares { abscissa: "shift [pixels]", points: shares.to_vec() },
            ..consistent()
        },
        Outcome {
            check: "independence.neighbours",
            subject: "specimen:raw-hash".to_owned(),
            verdict: Verdict::Rejected,
            expected: Verdict::Rejected,
            p_holm: Some(3.1e-200),
            seen: seen("neighbouring cells share a factor"),
            evidence: Evidence::Pairs { side: 2, counts: vec![90, 110, 100, 100] },
            ..consistent()
        },
        Outcome {
            check: "uniform.marginal",
            subject: "specimen:no-cdf".to_owned(),
            expected: Verdict::Rejected,
            evidence: Evidence::None,
            ..consistent()
        },
        Outcome {
            check: "range.finite",
            precision: Precision::F64,
            verdict: Verdict::Inconclusive,
            p: None,
            p_holm: None,
            statistic: None,
            effect: Some(f64::NAN),
            detectable: None,
            seen: seen("12 samples; 1000 are needed"),
            evidence: Evidence::None,
            ..consistent()
        },
        Outcome {
            check: "range.finite",
            subject: "gpu:paper".to_owned(),
            verdict: Verdict::Unavailable,
            n: 0,
            seen: seen("no adapter"),
            evidence: Evidence::None,
            ..consistent()
        },
        Outcome {
            check: "scale.zoom",
            subject: "fixed".to_owned(),
            verdict: Verdict::NotApplicable,
            evidence: Evidence::None,
            ..consistent()
        },
    ]
}
