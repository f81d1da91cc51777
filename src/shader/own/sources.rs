//! A text made of parts: the user's file, files that it includes, and what is put in; each byte knows where it comes from.

use super::error::Place;
use core::ops::Range;

/// Where the bytes of a text come from.
#[derive(Clone, Debug, Default)]
pub(super) struct Sources {
    /// Names and texts of the files, the user's first.
    files: Vec<(String, String)>,
    parts: Vec<Part>,
}

/// Bytes that follow each other in a file; or what was put in, which has one place.
#[derive(Clone, Copy, Debug)]
struct Part {
    length: usize,
    file: usize,
    at: usize,
    is_put_in: bool,
}

/// What goes into the place of a range.
pub(super) enum Put {
    /// Words that no file has.
    Words(String),
    /// A text of its own, from files of its own.
    Text(String, Sources),
}

impl Sources {
    pub fn of(file: &str, text: &str) -> Self {
        let part = Part { length: text.len(), file: 0, at: 0, is_put_in: false };
        Self { files: vec![(file.to_owned(), text.to_owned())], parts: vec![part] }
    }

    /// The file that a byte comes from, and its place there; nothing where no file has a text.
    pub fn locate(&self, offset: usize) -> Option<(&str, Place)> {
        let mut start = 0;
        let mut last = None;
        for part in &self.parts {
            last = Some((part, offset.saturating_sub(start).min(part.length)));
            start += part.length;
            if offset < start {
                break;
            }
        }
        let (part, behind) = last?;
        let (name, text) = self.files.get(part.file)?;
        Some((name, Place::of(text, if part.is_put_in { part.at } else { part.at + behind })))
    }

    /// Exchanges parts of a text; the ranges follow each other and do not overlap.
    pub fn exchange(&mut self, text: &str, edits: Vec<(Range<usize>, Put)>) -> String {
        let mut made = String::with_capacity(text.len());
        let mut parts = Vec::new();
        let mut from = 0;
        for (range, put) in edits {
            made.push_str(&text[from..range.start]);
            parts.extend(self.cut(from..range.start));
            from = range.end;
            match put {
                Put::Words(words) => {
                    let place = self.cut(range.start..range.start + 1).first().copied();
                    let (file, at) = place.map_or((0, 0), |part| (part.file, part.at));
                    parts.push(Part { length: words.len(), file, at, is_put_in: true });
                    made.push_str(&words);
                }
                Put::Text(text, sources) => {
                    let first = self.files.len();
                    self.files.extend(sources.files);
                    parts.extend(
                        sources.parts.into_iter().map(|part| Part { file: part.file + first, ..part }),
                    );
                    made.push_str(&text);
                }
            }
        }
        made.push_str(&text[from..]);
        parts.extend(self.cut(from..text.len()));
        self.parts = parts;
        made
    }

    /// The parts of a range of bytes.
    fn cut(&self, range: Range<usize>) -> Vec<Part> {
        let mut start = 0;
        let mut found = Vec::new();
        for part in &self.parts {
            let (from, to) = (range.start.max(start), range.end.min(start + part.length));
            if from < to {
                let at = if part.is_put_in { part.at } else { part.at + from - start };
                found.push(Part { length: to - from, at, ..*part });
            }
            start += part.length;
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_keep_their_place_whatever_is_exchanged() {
        let text = "one\ntwo three\n";
        let mut sources = Sources::of("a", text);
        let other = Sources::of("b", "x\ny\n");
        let edits =
            vec![(4..7, Put::Words("2222".to_owned())), (8..8, Put::Text("x\ny\n".to_owned(), other))];
        let made = sources.exchange(text, edits);
        assert_eq!(made, "one\n2222 x\ny\nthree\n");
        let at = |offset: usize| {
            let (file, Place { line, column }) = sources.locate(offset).unwrap();
            format!("{file}:{line}:{column}")
        };
        assert_eq!([at(0), at(5), at(8), at(9), at(11)], ["a:1:1", "a:2:1", "a:2:4", "b:1:1", "b:2:1"]);
        assert_eq!(at(made.find("three").unwrap()), "a:2:5");
        assert_eq!(at(999), "a:3:1");
        let made = sources.exchange(&made, vec![(0..4, Put::Words(String::new()))]);
        assert_eq!(sources.locate(made.find("three").unwrap()).unwrap().1, Place { line: 2, column: 5 });
        assert_eq!(Sources::default().locate(3), None);
    }
}
