//! The TOML list of known findings.

use super::failure::Failure;
use hashed_alpha::check::expectation::Expectation;
use hashed_alpha::check::subject::Precision;
use hashed_alpha::check::{Outcome, claims};
use serde::de::Error;
use serde::{Deserialize, Deserializer};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// A list as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    #[serde(default)]
    finding: Vec<Finding>,
}

/// One finding as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Finding {
    #[serde(deserialize_with = "claim")]
    check: String,
    subject: String,
    #[serde(deserialize_with = "precision")]
    precision: String,
    #[serde(deserialize_with = "reason")]
    reason: String,
}

/// The known findings, each with the reason why it is accepted.
#[derive(Debug, Default, PartialEq)]
pub struct Known {
    /// The findings.
    pub expectations: Vec<Expectation>,
    /// A reason for each of them.
    pub reasons: Vec<String>,
}

impl Known {
    /// Returns the reason why an outcome is accepted; empty for one that is not on the list.
    pub fn reason(&self, outcome: &Outcome) -> &str {
        let is_listed = |known: &Expectation| {
            known.check == outcome.check
                && known.subject == outcome.subject
                && known.precision == outcome.precision
        };
        self.expectations.iter().position(is_listed).map_or("", |index| &self.reasons[index])
    }
}

/// The longest list that is read, in bytes: a device file must not fill the memory.
const LONGEST_LIST: u64 = 1 << 20;

/// Reads a list from a file.
pub fn read(file: &Path) -> Result<Known, Failure> {
    let place = file.display().to_string();
    let mut text = String::new();
    let read = File::open(file).and_then(|list| list.take(LONGEST_LIST + 1).read_to_string(&mut text));
    match read {
        Ok(length) if length as u64 > LONGEST_LIST => Err(Failure::Usage(format!(
            "{place}: longer than {LONGEST_LIST} bytes, which no list of findings is"
        ))),
        Ok(_) => {
            parse(&text).map_err(|error| Failure::Usage(format!("{place}: {}", error.to_string().trim_end())))
        }
        Err(source) => Err(Failure::File { action: "read", place, source }),
    }
}

fn parse(text: &str) -> Result<Known, toml::de::Error> {
    let list: List = toml::from_str(text)?;
    let mut known = Known::default();
    for Finding { check, subject, precision, reason } in list.finding {
        known.expectations.push(Expectation { check, subject, precision });
        known.reasons.push(reason);
    }
    Ok(known)
}

fn claim<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    one_of(&claims::ALL.iter().map(|claim| claim.id).collect::<Vec<_>>(), deserializer)
}

fn precision<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    one_of(&Precision::ALL.map(Precision::name), deserializer)
}

fn reason<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    let reason = String::deserialize(deserializer)?;
    if reason.trim().is_empty() {
        Err(D::Error::custom("write down why this is accepted"))
    } else {
        Ok(reason)
    }
}

/// Reads a word that must be in a list.
fn one_of<'de, D: Deserializer<'de>>(list: &[&str], deserializer: D) -> Result<String, D::Error> {
    let word = String::deserialize(deserializer)?;
    if list.contains(&word.as_str()) {
        Ok(word)
    } else {
        Err(D::Error::custom(format_args!("unknown name `{word}`; known are {}", list.join(", "))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: &str = r#"
[[finding]]
check = "uniform.constant_z"
subject = "paper:isotropic"
precision = "f32"
reason = "all cells of one z share a bias"
"#;

    #[test]
    fn a_list_is_read() {
        let known = parse(LIST).unwrap();
        assert_eq!(known.expectations[0].check, "uniform.constant_z");
        assert_eq!(known.reasons, ["all cells of one z share a bias"]);
        assert_eq!(parse("# nothing is known"), Ok(Known::default()));
    }

    #[test]
    fn a_mistake_is_shown_in_its_line() {
        for (right, wrong, message) in [
            ("check", "chek", "line 3, column 1"),
            ("uniform.constant_z", "uniform.constant", "line 3, column 9"),
            ("f32", "f23", "unknown name `f23`; known are f32, f64"),
            ("all cells of one z share a bias", " ", "write down why"),
            ("reason", "# reason", "missing field `reason`"),
            ("[[finding]]", "[[findings]]", "unknown field `findings`"),
        ] {
            let error = parse(&LIST.replacen(right, wrong, 1)).unwrap_err().to_string();
            assert!(error.contains(message) && error.contains('^'), "{error}");
        }
    }
}
