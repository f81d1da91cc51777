//! Where the keys of a scene file stand in its text, so that whatever is wrong with a value is told at its key.

use core::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The bytes of a text that a message is about.
pub(in crate::render) type Span = Range<usize>;

/// The keys of a text.
pub(in crate::render) struct Spans<'t> {
    text: &'t str,
    table: DeTable<'t>,
}

/// A number as it is written.
pub(in crate::render) struct Number<'t> {
    /// The path of its key without the numbers of tables in a list, as in `surface.card.size`.
    pub(in crate::render) key: String,
    /// Where that key stands.
    pub(in crate::render) span: Span,
    /// Its text.
    pub(in crate::render) text: &'t str,
    /// Its value.
    pub(in crate::render) value: f64,
}

impl<'t> Spans<'t> {
    /// Finds the keys of a text.
    pub(in crate::render) fn new(text: &'t str) -> Result<Self, toml::de::Error> {
        Ok(Self { text, table: DeTable::parse(text)?.into_inner() })
    }

    /// Returns where a key stands, or the last of its path that is there. A path has the number of a table in a list from 0,
    /// as in `surface.0.card.size`; where a single table stands for a list, the number is passed over.
    pub(in crate::render) fn key(&self, path: &str) -> Option<Span> {
        let mut steps = path.split('.');
        let (mut span, mut value) = entry(&self.table, steps.next()?)?;
        for step in steps {
            let found = match (value, step.parse::<usize>()) {
                (DeValue::Array(list), Ok(index)) => {
                    list.get(index).map(|next| (next.span(), next.get_ref()))
                }
                (DeValue::Table(_), Ok(_)) => Some((span.clone(), value)),
                (DeValue::Table(table), Err(_)) => entry(table, step),
                _ => None,
            };
            let Some(found) = found else { break };
            (span, value) = found;
        }
        Some(span)
    }

    /// Returns the innermost key whose value begins at or before a byte and ends behind it: its path without numbers, and
    /// where it stands.
    pub(in crate::render) fn around(&self, byte: usize) -> Option<(String, Span)> {
        let mut found = None;
        each(&self.table, "", &mut |path, span, value| {
            if value.span().contains(&byte) {
                found = Some((path.to_owned(), span));
            }
        });
        found
    }

    /// Returns every number.
    pub(in crate::render) fn numbers(&self) -> Vec<Number<'t>> {
        let mut found = Vec::new();
        each(&self.table, "", &mut |path, span, value| {
            let number = match value.get_ref() {
                // Whole numbers beyond every width are refused all the same, and by the same bounds.
                DeValue::Integer(number) => digits(number.as_str(), number.radix()),
                DeValue::Float(number) => number.as_str().parse().unwrap_or(f64::NAN),
                _ => return,
            };
            let text = self.text.get(value.span()).unwrap_or_default();
            found.push(Number { key: path.to_owned(), span, text, value: number });
        });
        found
    }
}

fn digits(text: &str, radix: u32) -> f64 {
    let whole = i128::from_str_radix(text, radix).map(|number| number as f64);
    whole.unwrap_or(if text.starts_with('-') { f64::NEG_INFINITY } else { f64::INFINITY })
}

fn entry<'a, 't>(table: &'a DeTable<'t>, name: &str) -> Option<(Span, &'a DeValue<'t>)> {
    let (key, value) = table.iter().find(|(key, _)| key.get_ref() == name)?;
    Some((key.span(), value.get_ref()))
}

/// Visits the values of a table, and of lists in it, with the paths and the places of their keys, outer ones first.
fn each<'t>(table: &DeTable<'t>, above: &str, visit: &mut impl FnMut(&str, Span, &Spanned<DeValue<'t>>)) {
    for (key, value) in table.iter() {
        let dot = if above.is_empty() { "" } else { "." };
        within(value, &format!("{above}{dot}{}", key.get_ref()), &key.span(), visit);
    }
}

fn within<'t>(
    value: &Spanned<DeValue<'t>>,
    path: &str,
    span: &Span,
    visit: &mut impl FnMut(&str, Span, &Spanned<DeValue<'t>>),
) {
    visit(path, span.clone(), value);
    match value.get_ref() {
        DeValue::Table(table) => each(table, path, visit),
        DeValue::Array(list) => list.iter().for_each(|item| within(item, path, span, visit)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "a = 1\n[[b]]\nc = [2, 0x10]\n[[b]]\nd = { e = -inf }\n[f.g]\nh = 9999999999999999999999999999999999999999\n";

    #[test]
    fn keys_are_found_by_their_path() {
        let spans = Spans::new(TEXT).unwrap();
        let at = |path: &str| spans.key(path).map(|span| &TEXT[span.start..span.start + 1]);
        assert_eq!([at("a"), at("b.0.c"), at("b.1.d.e"), at("f.g.h")], ["a", "c", "e", "h"].map(Some));
        // What is not there is told at what is around it, one table stands for a list of one.
        assert_eq!([at("b.1.d.x"), at("f.0.g"), at("x")], [Some("d"), Some("g"), None]);
        let around = |part: &str| spans.around(TEXT.find(part).unwrap()).map(|(path, _)| path);
        assert_eq!(around("-inf"), Some("b.d.e".to_owned()));
    }

    #[test]
    fn every_number_is_found_with_its_key() {
        let found: Vec<(String, f64)> =
            Spans::new(TEXT).unwrap().numbers().into_iter().map(|n| (n.key, n.value)).collect();
        let expected =
            [("a", 1.0), ("b.c", 2.0), ("b.c", 16.0), ("b.d.e", f64::NEG_INFINITY), ("f.g.h", f64::INFINITY)];
        assert_eq!(found, expected.map(|(key, value)| (key.to_owned(), value)));
    }
}
