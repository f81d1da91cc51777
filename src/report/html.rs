//! The outcomes as one page: no scripts, nothing from elsewhere, pictures in files beside it.

use super::cause::sentences;
use super::sampled;
use super::text::{number, probability, remark, summary};
use crate::check::diagnosis::Diagnosis;
use crate::check::outcome::worst;
use crate::check::{Outcome, Standing};
use minijinja::value::Serde;
use minijinja::{Environment, context};
use serde::Serialize;

/// What was run, for the head of the page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// The command line as it was typed.
    pub command: String,
    /// The seed of all random inputs.
    pub seed: u64,
    /// The version of this crate.
    pub version: String,
}

/// Where the template comes from: a name that ends in `html` turns escaping on.
const TEMPLATE: &str = "page.html";

/// An outcome as the page shows it.
#[derive(Serialize)]
struct Shown<'a> {
    id: String,
    check: &'a str,
    anchor: &'a str,
    statement: &'a str,
    subject: &'a str,
    precision: &'a str,
    verdict: &'static str,
    class: &'static str,
    #[serde(skip)]
    standing: Standing,
    remark: Option<String>,
    n: u64,
    statistic: String,
    statistic_name: &'a str,
    p: String,
    p_holm: String,
    effect: String,
    effect_name: &'a str,
    detectable: String,
    domain: Option<String>,
    picture: Option<&'a str>,
    alt: String,
}

/// A row of the overview: one claim, and for each subject a link to its answer.
#[derive(Serialize)]
struct OverviewRow<'a> {
    check: &'a str,
    cells: Vec<Option<OverviewCell>>,
}

/// An answer in the overview.
#[derive(Serialize)]
struct OverviewCell {
    id: String,
    class: &'static str,
    verdict: &'static str,
    sign: &'static str,
}

/// Returns the names of the subjects, and the claims in rows over them; nothing where one subject makes a table enough.
fn overview<'a>(claims: &[Shown<'a>]) -> (Vec<String>, Vec<OverviewRow<'a>>) {
    let name = |claim: &Shown<'a>| format!("{} {}", claim.subject, claim.precision);
    let mut subjects: Vec<String> = Vec::new();
    let mut rows: Vec<OverviewRow<'a>> = Vec::new();
    for claim in claims {
        let name = name(claim);
        if !subjects.contains(&name) {
            subjects.push(name);
        }
        if !rows.iter().any(|row| row.check == claim.check) {
            rows.push(OverviewRow { check: claim.check, cells: Vec::new() });
        }
    }
    for row in &mut rows {
        let of = |subject: &String| claims.iter().find(|c| c.check == row.check && name(c) == *subject);
        row.cells = subjects.iter().map(|subject| of(subject).map(cell)).collect();
    }
    if subjects.len() > 1 { (subjects, rows) } else { (Vec::new(), Vec::new()) }
}

fn cell(claim: &Shown<'_>) -> OverviewCell {
    let sign = match claim.standing {
        Standing::AsExpected => "✓",
        Standing::Against => "✗",
        Standing::Known => "(✗)",
        Standing::Unanswered => "?",
        Standing::NotApplicable => "–",
    };
    OverviewCell { id: claim.id.clone(), class: claim.class, verdict: claim.verdict, sign }
}

/// Returns the page.
///
/// `pictures` holds one file name an outcome, relative to the page, or `None` where there is no picture.
///
/// # Errors
///
/// Those of the template engine; the template is part of the crate and its tests render it.
pub fn page(
    outcomes: &[Outcome],
    pictures: &[Option<String>],
    diagnoses: &[Diagnosis],
    run: &Run,
) -> Result<String, minijinja::Error> {
    let mut environment = Environment::new();
    environment.add_template(TEMPLATE, include_str!("page.html"))?;
    let pictures = pictures.iter().map(Option::as_deref).chain(std::iter::repeat(None));
    let claims: Vec<_> =
        outcomes.iter().zip(pictures).enumerate().map(|(i, (o, p))| claim(i, o, p)).collect();
    let (subjects, rows) = overview(&claims);
    let mut listed: Vec<&Shown<'_>> = claims.iter().collect();
    // What needs a reader comes first.
    listed.sort_by_key(|claim| claim.standing.min(Standing::AsExpected));
    let (headline, standing) = headline(outcomes);
    environment.get_template(TEMPLATE)?.render(context! {
        headline,
        class => class(standing),
        summary => summary(outcomes),
        command => run.command.as_str(),
        // As text: a template engine may hold numbers as `f64`.
        seed => run.seed.to_string(),
        version => run.version.as_str(),
        subjects,
        rows => Serde(&rows),
        claims => Serde(&listed),
        sampled => sampled::rows(outcomes),
        sampled_headings => sampled::HEADINGS,
        causes => Serde(&causes(diagnoses)),
    })
}

fn claim<'a>(index: usize, outcome: &'a Outcome, picture: Option<&'a str>) -> Shown<'a> {
    let (verdict, standing) = (outcome.answer(), outcome.standing());
    Shown {
        id: format!("claim-{}", index + 1),
        check: outcome.check,
        anchor: outcome.anchor,
        statement: outcome.statement,
        subject: &outcome.subject,
        precision: outcome.precision.name(),
        verdict,
        class: class(standing),
        standing,
        remark: remark(outcome),
        n: outcome.n,
        statistic: number(outcome.statistic),
        statistic_name: &outcome.statistic_name,
        p: probability(outcome.p),
        p_holm: probability(outcome.p_holm),
        effect: number(outcome.effect),
        effect_name: outcome.effect_name,
        detectable: number(outcome.detectable),
        domain: (outcome.domain.n > 0).then(|| outcome.domain.to_string()),
        picture,
        alt: format!(
            "Evidence of {} on {} in {}, which is {verdict}",
            outcome.check, outcome.subject, outcome.precision
        ),
    }
}

/// Why a subject is rejected.
#[derive(Serialize)]
struct Cause {
    subject: String,
    sentences: Vec<String>,
}

fn causes(diagnoses: &[Diagnosis]) -> Vec<Cause> {
    let of_subject = |diagnosis: &Diagnosis| Cause {
        subject: format!("{}, {}", diagnosis.subject, diagnosis.precision),
        sentences: sentences(diagnosis),
    };
    diagnoses.iter().map(of_subject).collect()
}

/// The style of a badge.
const fn class(standing: Standing) -> &'static str {
    match standing {
        Standing::Against => "bad",
        Standing::Unanswered => "open",
        Standing::Known => "known",
        Standing::AsExpected => "good",
        Standing::NotApplicable => "idle",
    }
}

/// Returns the answer in one sentence, and what it is worth.
fn headline(outcomes: &[Outcome]) -> (String, Standing) {
    let of = |wanted: Standing| outcomes.iter().filter(|outcome| outcome.standing() == wanted).count();
    let all = outcomes.len();
    let worst = worst(outcomes);
    let text = match worst {
        Standing::Against => {
            let bad = of(worst);
            format!("{bad} of {all} claims {} not as expected", if bad == 1 { "is" } else { "are" })
        }
        Standing::Unanswered => format!("There is no verdict on {} of {all} claims", of(worst)),
        Standing::Known => format!("All {all} claims are as expected, {} of them known findings", of(worst)),
        Standing::AsExpected if of(worst) == 1 => "1 claim is as expected".to_owned(),
        Standing::AsExpected => format!("All {} claims are as expected", of(worst)),
        Standing::NotApplicable => "Nothing was tried".to_owned(),
    };
    (text, worst)
}

#[cfg(test)]
mod tests {
    use super::super::example;
    use super::*;
    use crate::check::Verdict;
    use crate::check::diagnosis::diagnoses;

    fn run() -> Run {
        Run { command: "hashed-alpha check '<b>'".to_owned(), seed: u64::MAX, version: "0.1.0".to_owned() }
    }

    fn rendered() -> String {
        let outcomes = example::outcomes();
        let pictures: Vec<_> =
            outcomes.iter().enumerate().map(|(i, _)| (i < 3).then(|| format!("{i}.svg"))).collect();
        page(&outcomes, &pictures, &[], &run()).unwrap()
    }

    #[test]
    fn what_comes_from_outside_is_escaped() {
        let page = rendered();
        assert!(!page.contains("<script") && !page.contains("<b>"));
        assert!(page.contains("&lt;script&gt;alert(1)") && page.contains("&amp; co"));
    }

    #[test]
    fn page_says_what_was_run_and_what_came_out() {
        let page = rendered();
        for text in [
            "2 of 7 claims are not as expected",
            "18446744073709551615",
            "0.1.0",
            "rejected, as it must be",
            "no adapter",
            "§5.4.2, Eq. 2",
            "src=\"1.svg\"",
            "href=\"#claim-2\"",
            "id=\"claim-2\"",
            "lang=\"en\"",
        ] {
            assert!(page.contains(text), "{text}");
        }
        assert_eq!(page.matches("<img").count(), 3);
        assert_eq!(page.matches(" alt=\"").count(), 3);
        assert_eq!(page, rendered());
    }

    #[test]
    fn a_rejected_subject_is_told_what_it_looks_like() {
        let outcome = Outcome {
            check: "uniform.without_cdf",
            verdict: Verdict::Consistent,
            expected: Verdict::Rejected,
            ..example::consistent()
        };
        let outcomes = [outcome];
        let rejected = page(&outcomes, &[], &diagnoses(&outcomes, &[]), &run()).unwrap();
        assert!(rejected.contains("<h2>Cause</h2>") && rejected.contains("it looks like"));
        assert!(!page(&[example::consistent()], &[], &[], &run()).unwrap().contains("Cause"));
    }

    #[test]
    fn page_needs_nothing_from_elsewhere() {
        let page = rendered();
        for outside in ["http:", "https:", "//", "<link", "@import", "url("] {
            assert!(!page.contains(outside), "{outside}");
        }
    }

    #[test]
    fn headline_names_the_worst() {
        let all = example::outcomes();
        assert_eq!(headline(&all[..1]), ("1 claim is as expected".to_owned(), Standing::AsExpected));
        assert_eq!(
            headline(&all[4..]),
            ("There is no verdict on 2 of 3 claims".to_owned(), Standing::Unanswered)
        );
        assert_eq!(headline(&all[1..2]), ("1 of 1 claims is not as expected".to_owned(), Standing::Against));
        assert_eq!(headline(&all[6..]), ("Nothing was tried".to_owned(), Standing::NotApplicable));
    }
}
