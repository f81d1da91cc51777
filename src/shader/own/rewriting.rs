//! A function that tests an alpha, made into one that returns the threshold: of its statements only those stay from which the threshold
//! comes.

use super::head::{Dialect, File, Head, is_between};
use super::items::Item;
use super::options::Options;
use super::sources::Put;
use super::statements::{Body, Kind, Statement, slice};
use core::ops::Range;

/// What makes a function return the threshold of its test.
pub(super) struct Rewritten {
    /// Bytes that go.
    pub blank: Vec<Range<usize>>,
    /// What is put in, in order.
    pub edits: Vec<(Range<usize>, Put)>,
    /// The name of the function afterwards.
    pub function: String,
    /// A byte of the test.
    pub at: usize,
    /// What is compared, as it is written: the alpha and the threshold.
    pub sides: [String; 2],
    /// Bytes of further comparisons of the same alpha, which are left out.
    pub others: Vec<usize>,
    /// Conditions that the test stands behind, in words.
    pub behind: Vec<String>,
}

/// A test that was found.
pub(super) struct Test<'s> {
    /// The statements with the one that leads to it, from the outermost.
    pub path: Vec<(&'s [Statement], usize)>,
    pub alpha: Range<usize>,
    pub threshold: Range<usize>,
    /// Conditions that it stands behind, in words.
    pub behind: Vec<String>,
}

/// The name of what was `main`, which is another thing in GLSL.
const MAIN: &str = "main_threshold";

impl Test<'_> {
    /// The function of the test as one that returns what the alpha is compared with.
    pub fn rewrite(
        &self,
        file: &File<'_, '_>,
        asked: &Options,
        body: &Body<'_>,
        head: &Head<'_>,
        item: &Item<'_>,
    ) -> Rewritten {
        let (needed, kept) = slice(body, &self.path, &self.threshold);
        let mut stays = vec![false; body.at.len()];
        for range in kept.into_iter().chain([self.threshold.clone()]) {
            stays[range].fill(true);
        }
        // The braces on the way, those of the body among them.
        let blocks = self.path[..self.path.len() - 1].iter().map(|&(list, index)| &list[index]);
        let braces = blocks
            .filter(|statement| matches!(statement.kind, Kind::Block(_)))
            .map(|statement| statement.at.clone());
        let whole = 0..body.at.len();
        for block in braces.chain(core::iter::once(whole)) {
            stays[block.start] = true;
            stays[block.end - 1] = true;
        }
        let mut blank: Vec<_> = body
            .at
            .iter()
            .zip(&stays)
            .filter(|(_, stays)| !**stays)
            .map(|(&at, _)| file.tokens[at].at.clone())
            .collect();
        let byte = |token: usize| file.tokens[token].at.clone();
        let mut edits = Vec::new();
        let words = |text: &str| Put::Words(text.to_owned());
        // What stands before the name.
        let number = if file.dialect == Dialect::Wgsl { "f32" } else { "float" };
        match file.dialect {
            Dialect::Wgsl => {
                let keyword = (item.tokens.start..head.name)
                    .rev()
                    .find(|&at| file.word(at) == "fn")
                    .unwrap_or(head.name);
                blank.extend((item.tokens.start..keyword).map(byte));
            }
            Dialect::Glsl | Dialect::Hlsl => {
                blank.extend(
                    (item.tokens.start..head.name - 1).filter(|&at| !file.in_directive[at]).map(byte),
                );
                edits.push((byte(head.name - 1), words(number)));
            }
        }
        let is_main = file.dialect == Dialect::Glsl && file.word(head.name) == "main";
        if is_main {
            edits.push((byte(head.name), words(MAIN)));
        }
        // Parameters that the threshold needs.
        blank.extend(
            (head.name + 2..head.close).filter(|&at| file.word(at) == "," && is_between(file, at)).map(byte),
        );
        let mut is_first = true;
        for parameter in &head.parameters {
            let tokens = parameter.tokens.clone();
            if !needed.contains(parameter.name) {
                blank.extend(tokens.map(byte));
                continue;
            }
            let was_first = is_first;
            if !is_first {
                let start = byte(tokens.start).start;
                edits.push((start..start, words(", ")));
            }
            is_first = false;
            let is_out = tokens.clone().any(|at| file.word(at) == "out");
            if is_out && file.dialect != Dialect::Wgsl {
                // What only goes out is a variable of the function.
                let (first, last) = (file.tokens[tokens.start].at.start, file.tokens[tokens.end - 1].at.end);
                let declared =
                    file.text[first..last].split(':').next().unwrap_or_default().replacen("out ", "", 1);
                let brace = byte(head.brace).end;
                edits.push((brace..brace, words(&format!(" {declared};"))));
                blank.extend(tokens.map(byte));
                if let Some((_, Put::Words(comma))) =
                    edits.iter_mut().rev().find(|(range, _)| range.start == first)
                {
                    comma.clear();
                }
                is_first = was_first;
                continue;
            }
            let name = tokens.clone().find(|&at| file.word(at) == parameter.name).unwrap_or(tokens.start);
            let marks = tokens.clone().filter(|&at| matches!(file.word(at), "inout" | "out"));
            blank.extend(marks.map(byte));
            match file.dialect {
                Dialect::Wgsl => blank.extend((tokens.start..name).map(byte)),
                Dialect::Hlsl => {
                    blank.extend((name + 1..tokens.end).skip_while(|&at| file.word(at) != ":").map(byte))
                }
                Dialect::Glsl => {}
            }
        }
        // What stands behind them.
        blank.extend((head.close + 1..head.brace).filter(|&at| !file.in_directive[at]).map(byte));
        if file.dialect == Dialect::Wgsl {
            let brace = byte(head.brace).start;
            edits.push((brace..brace, words("-> f32 ")));
        }
        let value = body.bytes(&self.threshold);
        edits.push((value.start..value.start, words("return (")));
        edits.push((value.end..value.end, words(");")));
        edits.sort_by_key(|(range, _)| range.start);
        let plain =
            |range: &Range<usize>| body.written(range).split_whitespace().collect::<Vec<_>>().join(" ");
        let sides = [plain(&self.alpha), plain(&self.threshold)];
        let function = if is_main { MAIN.to_owned() } else { asked.function.clone() };
        Rewritten {
            blank,
            edits,
            function,
            at: value.start,
            sides,
            others: Vec::new(),
            behind: self.behind.clone(),
        }
    }
}
