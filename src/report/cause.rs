//! Why a subject is rejected, in a few sentences.

use super::wrap::wrap;
use crate::check::diagnosis::Diagnosis;

/// What is said of a subject that has no thresholds.
const NO_THRESHOLD: &str = "nearly nothing that it answers is a threshold: NaN, or outside of (0, 1]; see `range`, before \
                            anything else";

/// Claims of the rest that are named.
const NAMED: usize = 4;

/// Returns the sentences, the most important first.
pub(super) fn sentences(diagnosis: &Diagnosis) -> Vec<String> {
    if diagnosis.is_no_threshold {
        return vec![NO_THRESHOLD.to_owned()];
    }
    let Diagnosis { examination, rejections, unexplained, guesses, strongest, .. } = diagnosis;
    let all = rejections.len();
    let rest = if unexplained.is_empty() {
        String::new()
    } else {
        let named: Vec<_> = unexplained.iter().take(NAMED).copied().collect();
        let more = unexplained.len() - named.len();
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        format!("; not those of {}{more}", named.join(", "))
    };
    let explained = all - unexplained.len();
    if !examination.found.is_empty() {
        let mut sentences: Vec<String> = examination.found.iter().map(ToString::to_string).collect();
        if explained > 0 {
            sentences.push(format!(
                "{explained} of {all} rejections are known of such a slip or of the paper's own listing{rest}"
            ));
        }
        return sentences;
    }
    if examination.follows && guesses.is_empty() {
        return vec![format!(
            "no slip is found: thresholds follow from those of their cells as the listing says; {explained} of {all} rejections \
             are known of the paper's own listing, and do not count with --suite paper{rest}"
        )];
    }
    if !guesses.is_empty() {
        let of_steps = if examination.follows {
            "its steps are those of the listing"
        } else {
            "no experiment shows a slip"
        };
        let looks = guesses.iter().enumerate().map(|(place, guess)| match place {
            0 => format!("{of_steps}; it looks like {guess}"),
            _ => format!("or like {guess}"),
        });
        return looks.collect();
    }
    let evidence = strongest.as_ref().map_or(String::new(), |(check, seen)| format!(": {check}, {seen}"));
    vec![format!(
        "no experiment shows a slip, and there is no clear likeness; the strongest evidence{evidence}"
    )]
}

/// Returns the sentences about every subject as lines of at most `width` characters, each with a line break; those that
/// follow the first of a subject are indented.
#[must_use]
pub fn causes(diagnoses: &[Diagnosis], width: usize) -> String {
    const INDENT: &str = "    ";
    let mut text = String::new();
    for diagnosis in diagnoses {
        for (place, sentence) in sentences(diagnosis).into_iter().enumerate() {
            let sentence = match place {
                0 => format!("cause of {} in {}: {sentence}", diagnosis.subject, diagnosis.precision),
                _ => sentence,
            };
            for (part, line) in wrap(&sentence, width - INDENT.len()).iter().enumerate() {
                let indent = if place == 0 && part == 0 { "" } else { INDENT };
                text.extend([indent, line.as_str(), "\n"]);
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::cause;
    use crate::check::subject::{Precision, Subject};
    use crate::threshold::footprint::Footprint;
    use crate::threshold::names::listing_1_f64;
    use crate::threshold::two_scale::Variant;

    fn diagnosis(of: fn(&Footprint<f64>) -> f64) -> Diagnosis {
        let subject = Subject::new("mine.glsl", Precision::F64, Variant::Isotropic, of);
        Diagnosis {
            subject: subject.name.clone(),
            precision: subject.precision,
            is_no_threshold: false,
            examination: cause::examine(&subject),
            rejections: vec!["range", "spectrum.anisotropy"],
            unexplained: vec!["range"],
            guesses: Vec::new(),
            strongest: Some(("range", "1 % is NaN".to_owned())),
        }
    }

    #[test]
    fn the_cause_comes_first_with_a_number_and_the_mend() {
        let found = diagnosis(|at| listing_1_f64(&Footprint { dpdy: at.dpdx, ..*at }, 1.0));
        let text = causes(&[found], 120);
        let first = "cause of mine.glsl in f64: dfdx-twice: the derivative along screen x stands in for the one along y (";
        assert!(text.starts_with(first), "{text}");
        let joined = text.replace("\n    ", " ");
        assert!(
            joined.contains("% of 384 points") && joined.contains("; take dFdy for the second derivative")
        );
        assert!(joined.ends_with(
            "1 of 2 rejections are known of such a slip or of the paper's own listing; not those of range\n"
        ));
        assert!(text.lines().all(|line| line.chars().count() <= 120), "{text}");
    }

    #[test]
    fn a_port_without_a_slip_and_what_nothing_explains_are_told_apart() {
        let sound = causes(&[diagnosis(|at| listing_1_f64(at, 1.0))], 1000);
        assert!(sound.contains("no slip is found: thresholds follow"), "{sound}");
        // Not a threshold of two scales at all.
        let other = |at: &Footprint<f64>| {
            let p = at.position;
            let wave =
                (p.x * 12.3 + p.y * 7.7 + p.z * 3.1 + at.dpdx.length() * 40.0 + at.dpdy.y * 91.0).abs();
            wave - wave.floor()
        };
        let unknown = causes(&[diagnosis(other)], 1000);
        assert!(unknown.contains("cause of mine.glsl in f64: "), "{unknown}");
        assert!(!unknown.contains("no slip is found"), "{unknown}");
    }
}
