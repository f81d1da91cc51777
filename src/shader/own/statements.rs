//! The statements of a function by its words and signs: enough to follow a value back to where it comes from.

use super::scan::Token;
use core::ops::Range;
use std::collections::{BTreeMap, BTreeSet};

/// The words and signs of one body, directives left out, by their place in it.
pub(super) struct Body<'t> {
    text: &'t str,
    tokens: &'t [Token],
    /// The index of each in `tokens`.
    pub at: Vec<usize>,
    /// Functions of the file that may write what they are handed.
    writers: BTreeSet<&'t str>,
    /// What functions of the file may write by themselves, in those that they call, too.
    effects: BTreeMap<&'t str, BTreeSet<&'t str>>,
    is_wgsl: bool,
}

/// A statement, as a range of the words and signs of its [`Body`].
pub(super) struct Statement {
    pub at: Range<usize>,
    pub kind: Kind,
}

/// What a statement is.
pub(super) enum Kind {
    /// Up to a semicolon.
    Simple,
    /// In braces.
    Block(Vec<Statement>),
    /// With its condition, without the brackets around it.
    If { condition: Range<usize>, accept: Box<Statement>, reject: Option<Box<Statement>> },
    /// A loop or a switch, which stays or goes as a whole.
    Whole,
}

impl<'t> Body<'t> {
    /// The body of the function whose name is the token `name`, its braces included; empty where the function is declared only.
    pub fn of(text: &'t str, tokens: &'t [Token], in_directive: &[bool], name: usize, is_wgsl: bool) -> Self {
        let is_within = |&index: &usize| tokens[index].function == Some(name) && !in_directive[index];
        let mut at: Vec<_> = (0..tokens.len()).filter(is_within).collect();
        // The brace that closes it stands outside of it.
        at.extend(at.last().map(|last| last + 1).filter(|&close| close < tokens.len()));
        let effects = effects(text, tokens, in_directive, is_wgsl);
        Self { text, tokens, at, writers: writers(text, tokens), effects, is_wgsl }
    }

    /// The word or sign at a place; empty behind the last.
    pub fn word(&self, place: usize) -> &'t str {
        self.at.get(place).map_or("", |&index| &self.text[self.tokens[index].at.clone()])
    }

    /// The bytes of a range of words.
    pub fn bytes(&self, range: &Range<usize>) -> Range<usize> {
        self.tokens[self.at[range.start]].at.start..self.tokens[self.at[range.end - 1]].at.end
    }

    /// What stands in a range, as it was written.
    pub fn written(&self, range: &Range<usize>) -> &'t str {
        &self.text[self.bytes(range)]
    }

    /// Cuts the body into its statements.
    pub fn statements(&self) -> Vec<Statement> {
        match self.statement(0).kind {
            Kind::Block(statements) => statements,
            Kind::Simple | Kind::If { .. } | Kind::Whole => Vec::new(),
        }
    }

    fn statement(&self, start: usize) -> Statement {
        let count = self.at.len();
        let to = |end: usize, kind| Statement { at: start..end.clamp(start + 1, count.max(start + 1)), kind };
        match self.word(start) {
            "{" => {
                let close = self.closing(start);
                let mut statements = Vec::new();
                let mut next = start + 1;
                while next < close {
                    let statement = self.statement(next);
                    next = statement.at.end;
                    statements.push(statement);
                }
                to(close + 1, Kind::Block(statements))
            }
            // An attribute of HLSL, as `[branch]`.
            "[" => {
                let statement = self.statement((self.closing(start) + 1).min(count));
                to(statement.at.end, statement.kind)
            }
            "if" => {
                let (condition, behind) = if self.is_wgsl {
                    let brace = (start + 1..count).find(|&at| self.word(at) == "{").unwrap_or(count);
                    (start + 1..brace, brace)
                } else {
                    let close = self.closing(start + 1);
                    (start + 2..close, close + 1)
                };
                if behind >= count || condition.is_empty() {
                    return to(count, Kind::Whole);
                }
                let accept = Box::new(self.statement(behind));
                let mut end = accept.at.end;
                let reject = (self.word(end) == "else" && end + 1 < count).then(|| {
                    let reject = Box::new(self.statement(end + 1));
                    end = reject.at.end;
                    reject
                });
                to(end, Kind::If { condition, accept, reject })
            }
            "for" | "while" | "switch" | "loop" => {
                let head = (start + 1..count).find(|&at| matches!(self.word(at), "(" | "{"));
                let Some(mut body) = head else { return to(count, Kind::Whole) };
                if self.word(body) == "(" {
                    body = self.closing(body) + 1;
                }
                let end = if body < count { self.statement(body).at.end } else { count };
                to(end, Kind::Whole)
            }
            "do" => {
                let body = self.statement((start + 1).min(count - 1));
                to(self.end_of_simple(body.at.end), Kind::Whole)
            }
            _ => to(self.end_of_simple(start), Kind::Simple),
        }
    }

    fn end_of_simple(&self, start: usize) -> usize {
        let mut at = start;
        while at < self.at.len() {
            match self.word(at) {
                ";" => return at + 1,
                "(" | "[" | "{" => at = self.closing(at) + 1,
                "}" => return at.max(start + 1),
                _ => at += 1,
            }
        }
        at
    }

    /// The bracket that closes one; the last word where none does.
    pub fn closing(&self, open: usize) -> usize {
        let mut depth = 0_usize;
        for at in open..self.at.len() {
            match self.word(at) {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => {
                    depth = depth.saturating_sub(1);
                    if depth == 0 {
                        return at;
                    }
                }
                _ => {}
            }
        }
        self.at.len().saturating_sub(1)
    }

    /// The names in a range; those of members are left out.
    pub fn names(&self, range: Range<usize>) -> impl Iterator<Item = &'t str> + '_ {
        range
            .filter(|&at| is_name(self.word(at)) && (at == 0 || self.word(at - 1) != "."))
            .map(|at| self.word(at))
    }

    /// The same, and those of methods, as `Sample` in HLSL.
    pub fn all_names(&self, range: Range<usize>) -> impl Iterator<Item = &'t str> + '_ {
        let is_called = |at: usize| at == 0 || self.word(at - 1) != "." || self.word(at + 1) == "(";
        range.filter(move |&at| is_name(self.word(at)) && is_called(at)).map(|at| self.word(at))
    }

    /// What the variable at a place was given as it was declared, where it is never given another value.
    pub fn given(&self, place: usize) -> Option<Range<usize>> {
        let name = self.word(place);
        let is_it = |at: &usize| self.word(*at) == name && (*at == 0 || self.word(at - 1) != ".");
        let mut all = (0..self.at.len()).filter(is_it).filter(|&at| self.assigned(at..at + 1).contains(name));
        let first = all.next().filter(|&first| is_name(name) && first < place && all.next().is_none())?;
        // `bool keep = ...`, `let keep: bool = ...`.
        let sign = if self.is_wgsl && self.word(first + 1) == ":" { first + 3 } else { first + 1 };
        if self.word(sign) != "=" || first == 0 || !is_name(self.word(first - 1)) {
            return None;
        }
        let value = sign + 1..self.end_of_simple(sign) - 1;
        (!value.is_empty()).then_some(value)
    }

    /// The names that a range may give a value to.
    pub fn assigned(&self, range: Range<usize>) -> BTreeSet<&'t str> {
        let mut found = BTreeSet::new();
        for at in range.clone() {
            let word = self.word(at);
            let before = at.checked_sub(1).map_or("", |before| self.word(before));
            if self.word(at + 1) == "("
                && let Some(written) = self.effects.get(word)
            {
                found.extend(written);
            }
            if self.writers.contains(word) && self.word(at + 1) == "(" {
                found.extend(self.names(at + 2..self.closing(at + 1)));
            }
            let is_type = self.is_wgsl && before == ":";
            if !is_name(word) || before == "." || is_type {
                continue;
            }
            let mut next = at + 1;
            loop {
                match self.word(next) {
                    "." => next += 2,
                    "[" => next = self.closing(next) + 1,
                    _ => break,
                }
            }
            let (sign, second) = (self.word(next), self.word(next + 1));
            let is_operator = matches!(sign, "+" | "-" | "*" | "/" | "%" | "|" | "&" | "^");
            let is_assigned = sign == "=" && second != "="
                || is_operator && second == "="
                || matches!(sign, "+" | "-") && sign == second;
            let is_declared = matches!(before, "let" | "var" | "const")
                || is_name(before) && matches!(sign, ";" | "," | "=");
            let is_listed =
                before == "," && self.tokens[self.at[at]].parentheses == 0 && matches!(sign, ";" | "," | "=");
            let is_stepped =
                matches!(before, "+" | "-") && at.checked_sub(2).is_some_and(|two| self.word(two) == before);
            let is_handed_out = self.is_wgsl
                && before == "&"
                && at.checked_sub(2).is_some_and(|two| matches!(self.word(two), "(" | ","));
            if (is_assigned || is_declared || is_listed || is_stepped || is_handed_out) && before != "return"
            {
                found.insert(word);
            }
        }
        found
    }
}

/// The names that a value comes from, and the statements that make it.
pub(super) fn slice<'t>(
    body: &Body<'t>,
    path: &[(&[Statement], usize)],
    value: &Range<usize>,
) -> (BTreeSet<&'t str>, Vec<Range<usize>>) {
    let mut needed: BTreeSet<_> = body.names(value.clone()).collect();
    let mut kept = Vec::new();
    for &(list, index) in path.iter().rev() {
        for statement in list[..index].iter().rev() {
            if !body.assigned(statement.at.clone()).is_disjoint(&needed) {
                needed.extend(body.all_names(statement.at.clone()));
                kept.push(statement.at.clone());
            }
        }
    }
    (needed, kept)
}

/// How many brackets are open at a place, counted from another.
pub(super) fn depth(body: &Body<'_>, from: usize, at: usize) -> usize {
    (from..at).fold(0_usize, |depth, at| match body.word(at) {
        "(" | "[" | "{" => depth + 1,
        ")" | "]" | "}" => depth.saturating_sub(1),
        _ => depth,
    })
}

/// Whether a word is a name or a keyword.
pub(super) fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

/// What the functions of a text give a value to, their own variables among it.
fn effects<'t>(
    text: &'t str,
    tokens: &'t [Token],
    in_directive: &[bool],
    is_wgsl: bool,
) -> BTreeMap<&'t str, BTreeSet<&'t str>> {
    let mut bodies: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (at, token) in tokens.iter().enumerate().filter(|&(at, _)| !in_directive[at]) {
        if let Some(name) = token.function {
            bodies.entry(name).or_default().push(at);
        }
    }
    let word = |at: usize| &text[tokens[at].at.clone()];
    let mut found: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    let mut called: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (name, at) in bodies {
        let body = Body { text, tokens, at, writers: BTreeSet::new(), effects: BTreeMap::new(), is_wgsl };
        let all = 0..body.at.len();
        found.entry(word(name)).or_default().extend(body.assigned(all.clone()));
        called.entry(word(name)).or_default().extend(body.names(all));
    }
    // What is written by what is called.
    loop {
        let mut grew = false;
        for (name, names) in &called {
            let theirs: BTreeSet<&str> =
                names.iter().filter_map(|called| found.get(called)).flatten().copied().collect();
            let own = found.entry(name).or_default();
            let before = own.len();
            own.extend(theirs);
            grew |= own.len() > before;
        }
        if !grew {
            return found;
        }
    }
}

/// The functions of a text that have a parameter which they may write.
fn writers<'t>(text: &'t str, tokens: &[Token]) -> BTreeSet<&'t str> {
    let word = |at: usize| &text[tokens[at].at.clone()];
    let mut last = None;
    let mut found = BTreeSet::new();
    for (at, token) in tokens.iter().enumerate() {
        if token.parentheses == 1 && word(at) == "(" && at > 0 {
            last = Some(word(at - 1));
        }
        if matches!(word(at), "inout" | "out" | "ptr") && token.parentheses > 0 {
            found.extend(last);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::scan::tokens;
    use super::*;

    fn with<T>(text: &str, look: impl Fn(&Body<'_>) -> T) -> T {
        let tokens = tokens(text).unwrap();
        let name = tokens.iter().find_map(|token| token.function).unwrap();
        let is_wgsl = text.starts_with("fn");
        look(&Body::of(text, &tokens, &vec![false; tokens.len()], name, is_wgsl))
    }

    fn kinds(text: &str) -> Vec<String> {
        fn said(body: &Body<'_>, statement: &Statement) -> String {
            match &statement.kind {
                Kind::Simple => body.written(&statement.at).to_owned(),
                Kind::Whole => "whole".to_owned(),
                Kind::Block(inner) => {
                    let inner: Vec<_> = inner.iter().map(|statement| said(body, statement)).collect();
                    format!("[{}]", inner.join(" "))
                }
                Kind::If { condition, accept, reject } => {
                    let reject = reject.as_ref().map_or(String::new(), |reject| said(body, reject));
                    format!("if {} {} {reject}", body.written(condition), said(body, accept))
                        .trim()
                        .to_owned()
                }
            }
        }
        with(text, |body| body.statements().iter().map(|statement| said(body, statement)).collect())
    }

    #[test]
    fn a_body_is_cut_into_statements() {
        let glsl = "void f(float a) { int b[2] = int[](1, 2); if (a < 1.0) discard; else { b = 1; } for (;;) { b; } c(); }";
        let wanted = ["int b[2] = int[](1, 2);", "if a < 1.0 discard; [b = 1;]", "whole", "c();"];
        assert_eq!(kinds(glsl), wanted);
        let wgsl = "fn f(a: f32) { let b = vec3<f32>(1.0); if (a) < b.x { discard; } loop { break; } }";
        assert_eq!(kinds(wgsl), ["let b = vec3<f32>(1.0);", "if (a) < b.x [discard;]", "whole"]);
        assert_eq!(kinds("void f() { do { a; } while (b); [branch] if (c) d; }"), ["whole", "if c d;"]);
        for broken in ["void f() { if ", "void f() { if (a", "void f() { for", "void f() {", "void f() { a"] {
            let _ = kinds(broken);
        }
    }

    #[test]
    fn what_a_statement_writes_is_known() {
        let assigned = |text: &str| {
            with(text, |body| {
                body.assigned(0..body.at.len()).into_iter().map(str::to_owned).collect::<Vec<_>>()
            })
        };
        assert_eq!(assigned("void f() { float a = b; c.xyz += d; e[1] = g; h++; }"), ["a", "c", "e", "h"]);
        assert_eq!(assigned("void f() { if (a == b || a <= c) return; }"), Vec::<String>::new());
        assert_eq!(assigned("void f() { vec3 a, b; } void g(inout float x) {}"), ["a", "b"]);
        assert_eq!(assigned("void f() { g(a.x, b); } void g(inout float x) {}"), ["a", "b"]);
        assert_eq!(assigned("fn f() { var a: f32; let b: f32 = c; g(&d, e); }"), ["a", "b", "d"]);
    }
}
