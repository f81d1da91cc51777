//! The TOML list of known findings.

use super::failure::Failure;
use hashed_alpha::check::claims;
use hashed_alpha::check::known::Known;
use hashed_alpha::check::subject::Precision;
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
    finding: Vec<Written>,
}

/// One known finding as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(deserialize_with = "claim")]
    check: String,
    subject: String,
    #[serde(deserialize_with = "precision")]
    precision: Precision,
    #[serde(deserialize_with = "reason")]
    reason: String,
    /// Size of the effect; a fifth more is no longer known.
    size: Option<f64>,
}

impl From<Written> for Known {
    fn from(Written { check, subject, precision, reason, size }: Written) -> Self {
        Self::of_subject(check, subject, precision, reason).with_size(size)
    }
}

/// The longest list that is read, in bytes: a device file must not fill the memory.
const LONGEST_LIST: u64 = 1 << 20;

/// Reads a list from a file.
pub fn read(file: &Path) -> Result<Vec<Known>, Failure> {
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

fn parse(text: &str) -> Result<Vec<Known>, toml::de::Error> {
    toml::from_str(text).map(|list: List| list.finding.into_iter().map(Known::from).collect())
}

fn claim<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    one_of(&claims::ALL.iter().map(|claim| claim.id).collect::<Vec<_>>(), deserializer)
}

fn precision<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Precision, D::Error> {
    let name = one_of(&Precision::ALL.map(Precision::name), deserializer)?;
    Ok(if name == Precision::F64.name() { Precision::F64 } else { Precision::F32 })
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
        let [check, subject, reason] =
            ["uniform.constant_z", "paper:isotropic", "all cells of one z share a bias"].map(str::to_owned);
        let expected = Known::of_subject(check, subject, Precision::F32, reason);
        assert_eq!(known, std::slice::from_ref(&expected));
        assert_eq!(parse(&format!("{LIST}size = 2e-3")).unwrap(), [expected.with_size(Some(2e-3))]);
        assert_eq!(parse("# nothing is known"), Ok(Vec::new()));
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
