//! A change of a text: what stands in the place of some of its parts.

use core::ops::Range;

/// Words in the place of others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Edit {
    /// Where the others stand, in bytes.
    pub at: Range<usize>,
    /// The words.
    pub with: String,
}

/// Edits in the order of their places, none inside another.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Change {
    pub edits: Vec<Edit>,
    /// Lines that are another afterwards, before that or after it, whichever are more.
    pub lines: usize,
    /// Bytes that go and bytes that come.
    pub bytes: usize,
}

impl Change {
    /// Makes a change of edits; nothing where two of them meet, or where they change nothing.
    pub fn new(text: &str, mut edits: Vec<Edit>) -> Option<Self> {
        edits.sort_by_key(|edit| edit.at.start);
        edits.retain(|edit| text[edit.at.clone()] != edit.with);
        edits.dedup();
        let meet = edits.windows(2).any(|pair| pair[1].at.start < pair[0].at.end || pair[0].at == pair[1].at);
        if meet || edits.is_empty() {
            return None;
        }
        let bytes = edits.iter().map(|edit| differing(&text[edit.at.clone()], &edit.with)).sum();
        let line = |at: usize| text.as_bytes()[..at].iter().filter(|&&byte| byte == b'\n').count();
        let newlines = |text: &str| text.bytes().filter(|&byte| byte == b'\n').count();
        let mut lines = 0;
        let mut last = None;
        for edit in &edits {
            let old = &text[edit.at.clone()];
            // Whole lines that go.
            if edit.with.is_empty() && old.ends_with('\n') {
                lines += newlines(old);
                continue;
            }
            let first = line(edit.at.start);
            let more = newlines(old).max(newlines(&edit.with));
            lines += more + usize::from(last != Some(first));
            last = Some(line(edit.at.end));
        }
        Some(Self { edits, lines, bytes })
    }

    /// The text after the change.
    pub fn applied(&self, text: &str) -> String {
        let mut changed = String::with_capacity(text.len() + 64);
        let mut end = 0;
        for edit in &self.edits {
            changed += &text[end..edit.at.start];
            changed += &edit.with;
            end = edit.at.end;
        }
        changed + &text[end..]
    }

    /// What is smaller comes first.
    pub fn size(&self) -> (usize, usize) {
        (self.lines, self.bytes)
    }
}

/// The bytes of two texts without what both begin and end with.
fn differing(old: &str, new: &str) -> usize {
    let same = |pairs: &mut dyn Iterator<Item = (u8, u8)>| pairs.take_while(|(a, b)| a == b).count();
    let front = same(&mut old.bytes().zip(new.bytes()));
    let back = same(&mut old.bytes().rev().zip(new.bytes().rev())).min(old.len().min(new.len()) - front);
    old.len() + new.len() - 2 * (front + back)
}

/// How many lines are others: of each place the lines that go or those that come, whichever are more.
pub(super) fn lines_between(old: &str, new: &str) -> usize {
    let (old, new): (Vec<&str>, Vec<&str>) = (old.lines().collect(), new.lines().collect());
    // The longest common part of what is left from a line of each on.
    let mut common = vec![vec![0_usize; new.len() + 1]; old.len() + 1];
    for (i, a) in old.iter().enumerate().rev() {
        for (j, b) in new.iter().enumerate().rev() {
            common[i][j] =
                if a == b { common[i + 1][j + 1] + 1 } else { common[i + 1][j].max(common[i][j + 1]) };
        }
    }
    let (mut i, mut j, mut lines) = (0, 0, 0);
    let mut apart = [0_usize; 2];
    while i < old.len() || j < new.len() {
        if i < old.len() && j < new.len() && old[i] == new[j] {
            lines += apart[0].max(apart[1]);
            apart = [0; 2];
            (i, j) = (i + 1, j + 1);
        } else if j == new.len() || i < old.len() && common[i + 1][j] >= common[i][j + 1] {
            (apart[0], i) = (apart[0] + 1, i + 1);
        } else {
            (apart[1], j) = (apart[1] + 1, j + 1);
        }
    }
    lines + apart[0].max(apart[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_knows_its_size_and_what_comes_of_it() {
        let text = "a\nb = max(c, d);\ne\n";
        let edit = |at: Range<usize>, with: &str| Edit { at, with: with.to_owned() };
        let change = Change::new(text, vec![edit(6..9, "min")]).unwrap();
        assert_eq!(change.applied(text), "a\nb = min(c, d);\ne\n");
        assert_eq!(change.size(), (1, 4));
        let more = Change::new(text, vec![edit(17..18, "f"), edit(2..17, "")]).unwrap();
        assert_eq!((more.applied(text).as_str(), more.lines), ("a\nf\n", 2));
        let added = Change::new(text, vec![edit(2..2, "x;\n"), edit(6..9, "min")]).unwrap();
        assert_eq!((added.applied(text).as_str(), added.lines), ("a\nx;\nb = min(c, d);\ne\n", 2));
        assert_eq!(lines_between(text, &added.applied(text)), 2);
        assert_eq!(lines_between(text, &more.applied(text)), 2);
        assert!(Change::new(text, vec![edit(6..9, "max")]).is_none());
        assert!(Change::new(text, vec![edit(6..9, "min"), edit(8..9, "y")]).is_none());
    }
}
