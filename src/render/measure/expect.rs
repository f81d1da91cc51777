//! What a scene must show, in a form that a machine checks.

use super::metrics::Metrics;
use crate::render::scene_file::diagnostic::Diagnostic;
use crate::render::scene_file::schema::Expectation;
use crate::shader::spelling::likely;

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
) -> Result<(), Diagnostic> {
    let Expectation { take, than, at_least, at_most, .. } = expectation;
    let named = [("take", Some(take)), ("than", than.as_ref())];
    for (key, name) in named.into_iter().filter_map(|(key, name)| Some((key, name?))) {
        if let Some(takes) = takes.filter(|takes| !takes.contains(name)) {
            let known: Vec<&str> = takes.iter().map(String::as_str).collect();
            let likely = likely(name, &known);
            let message = format!("no take is called `{name}`.{likely} Takes are {}", known.join(", "));
            return Err(Diagnostic::new(key, message));
        }
    }
    match (at_least, at_most) {
        (None, None) => {
            Err(Diagnostic::new("metric", "there is no bound: add `at_least`, `at_most` or both"))
        }
        (Some(low), Some(high)) if low > high => {
            Err(Diagnostic::new("at_least", format!("nothing is at least {low} and at most {high}")))
        }
        (Some(_), _) | (_, Some(_)) => Ok(()),
    }
}

/// Checks an expectation against the names of takes and their numbers. A take or a number that does not exist fails it.
#[must_use]
pub fn check(expectation: &Expectation, takes: &[(&str, &Metrics)]) -> Checked {
    let Expectation { take, metric, than, at_least, at_most } = expectation;
    let metrics = |name: &str| takes.iter().find(|(known, _)| *known == name).map(|(_, metrics)| *metrics);
    let find = |name: &str| metrics(name)?.get(metric).copied();
    let (Some(found), Some(unit)) = (find(take), than.as_deref().map_or(Some(1.0), find)) else {
        let known: Vec<&str> = takes.iter().map(|(name, _)| *name).collect();
        let measured = metrics(take).or(takes.first().map(|(_, metrics)| *metrics));
        let numbers = measured.map(|metrics| metrics.keys().cloned().collect::<Vec<_>>().join(", "));
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
