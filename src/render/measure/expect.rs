//! What a scene must show, in a form that a machine checks.

use super::study::Take;
use crate::render::scene_file::schema::Expectation;
use crate::render::scene_file::suggest::likely;

/// An expectation and what came out.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// What was expected and what was found, in a line.
    pub text: String,
    /// Whether it came out.
    pub holds: bool,
}

/// Finds what is wrong with an expectation before anything is drawn: its key, and what. `takes` are the names of the takes,
/// if they are known.
pub(in crate::render) fn check_words(
    expectation: &Expectation,
    takes: Option<&[String]>,
) -> Result<(), (&'static str, String)> {
    let Expectation { take, than, at_least, at_most, .. } = expectation;
    let named = [("take", Some(take)), ("than", than.as_ref())];
    for (key, name) in named.into_iter().filter_map(|(key, name)| Some((key, name?))) {
        if let Some(takes) = takes.filter(|takes| !takes.contains(name)) {
            let known: Vec<&str> = takes.iter().map(String::as_str).collect();
            let likely = likely(name, &known);
            return Err((key, format!("no take is called `{name}`.{likely} Takes are {}", known.join(", "))));
        }
    }
    match (at_least, at_most) {
        (None, None) => Err(("metric", "there is no bound: add `at_least`, `at_most` or both".to_owned())),
        (Some(low), Some(high)) if low > high => {
            Err(("at_least", format!("nothing is at least {low} and at most {high}")))
        }
        _ => Ok(()),
    }
}

/// Checks an expectation. A take or a number that does not exist fails it.
#[must_use]
pub fn check(expectation: &Expectation, takes: &[Take]) -> Checked {
    let Expectation { take, metric, than, at_least, at_most } = expectation;
    let find = |name: &str| takes.iter().find(|take| take.plan.name == name)?.metrics.get(metric).copied();
    let (Some(found), Some(unit)) = (find(take), than.as_deref().map_or(Some(1.0), find)) else {
        let known: Vec<&str> = takes.iter().map(|take| take.plan.name.as_str()).collect();
        let measured = takes.iter().find(|of| of.plan.name == *take).or(takes.first());
        let numbers = measured.map(|take| take.metrics.keys().cloned().collect::<Vec<_>>().join(", "));
        let text = format!(
            "{take}: {metric} was not measured; takes are {}; numbers are {}",
            known.join(", "),
            numbers.unwrap_or_default()
        );
        return Checked { text, holds: false };
    };
    let value = found / unit;
    let of = than.as_ref().map_or_else(String::new, |than| format!(" times that of {than}"));
    let bounds = match (at_least, at_most) {
        (Some(low), Some(high)) => format!("from {low} to {high}"),
        (Some(low), None) => format!("at least {low}"),
        (None, Some(high)) => format!("at most {high}"),
        (None, None) => "any number".to_owned(),
    };
    let holds = at_least.is_none_or(|low| value >= low) && at_most.is_none_or(|high| value <= high);
    Checked {
        text: format!("{take}: {metric} is {value:.4}{of}; {bounds} expected"),
        holds: holds && value.is_finite(),
    }
}
