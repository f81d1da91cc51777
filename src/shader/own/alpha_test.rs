//! A test of an alpha in the text of a function, and what the alpha is compared with there: that is the threshold. A function that
//! discards, that returns whether to keep, that writes an alpha, or a whole `main`, becomes one that returns it; of its
//! statements only those stay from which the threshold comes.

use super::directives::Directive;
use super::error::Fault;
use super::items::{Item, reached};
use super::mapping::is_alpha;
use super::options::{ALPHA, Options};
use super::scan::Token;
use super::sources::Put;
use super::statements::{Body, Kind, Statement, is_name};
use core::ops::Range;
use std::collections::{BTreeSet, HashSet};

/// How functions and conditions are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dialect {
    Wgsl,
    Glsl,
    Hlsl,
}

/// A text, cut into words and items.
#[derive(Clone, Copy)]
pub(super) struct File<'a, 't> {
    pub text: &'t str,
    pub tokens: &'a [Token],
    pub directives: &'a [Directive<'t>],
    pub in_directive: &'a [bool],
    pub items: &'a [Item<'t>],
    pub dialect: Dialect,
}

impl<'t> File<'_, 't> {
    pub fn word(&self, at: usize) -> &'t str {
        self.tokens.get(at).map_or("", |token| &self.text[token.at.clone()])
    }
}

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
}

/// Words by which a texture is read.
const SAMPLES: [&str; 17] = [
    "texture",
    "texture2D",
    "texture2DLod",
    "textureLod",
    "textureGrad",
    "textureProj",
    "texelFetch",
    "textureSample",
    "textureLoad",
    "textureSampleLevel",
    "textureSampleBias",
    "Sample",
    "SampleBias",
    "SampleLevel",
    "SampleGrad",
    "tex2D",
    "Load",
];

/// Words by which something depends on the size of a pixel, or is cut into cells.
const DERIVATIVES: [&str; 21] = [
    "dFdx",
    "dFdy",
    "fwidth",
    "dFdxFine",
    "dFdyFine",
    "fwidthFine",
    "dFdxCoarse",
    "dFdyCoarse",
    "fwidthCoarse",
    "dpdx",
    "dpdy",
    "dpdxFine",
    "dpdyFine",
    "dpdxCoarse",
    "dpdyCoarse",
    "ddx",
    "ddy",
    "ddx_fine",
    "ddy_fine",
    "ddx_coarse",
    "ddy_coarse",
];
const CELLS: [&str; 3] = ["floor", "fract", "frac"];

/// Finds the test in the function that is asked for; nothing where it has none, and where it returns a number without one.
///
/// # Errors
///
/// A test that discards what is above the threshold.
pub(super) fn rewritten(file: &File<'_, '_>, asked: &Options) -> Result<Option<Rewritten>, Fault> {
    let is_asked = |item: &&Item<'_>| item.function.is_some_and(|name| file.word(name) == asked.function);
    for item in file.items.iter().filter(is_asked) {
        let Some(head) = Head::of(file, item) else { continue };
        let is_wgsl = file.dialect == Dialect::Wgsl;
        let body = Body::of(file.text, file.tokens, file.in_directive, head.name, is_wgsl);
        // What is written through a pointer to a variable is not followed.
        let is_pointed_to = |at: usize| {
            is_wgsl && body.word(at) == "=" && body.word(at + 1) == "&" && is_name(body.word(at + 2))
        };
        if (0..body.at.len()).any(is_pointed_to) {
            continue;
        }
        let statements = body.statements();
        let mut search = Search {
            file,
            asked,
            body: &body,
            head: &head,
            guards: Vec::new(),
            path: Vec::new(),
            found: None,
        };
        search.within(&statements)?;
        if let Some(test) = search.found {
            let others = others(&body, &statements, &test);
            // A function of an alpha alone is tried as a whole.
            if !others.is_empty() && head.alpha(asked).is_some() {
                continue;
            }
            return Ok(Some(Rewritten { others, ..test.rewrite(file, asked, &body, &head, item) }));
        }
    }
    Ok(None)
}

/// Bytes at which the alpha of a test is compared with something else.
fn others(body: &Body<'_>, statements: &[Statement], test: &Test<'_>) -> Vec<usize> {
    let alpha = body.written(&test.alpha);
    let is_same = |side: &Range<usize>| !side.is_empty() && body.written(side) == alpha;
    let mut asked = Vec::new();
    conditions(body, statements, &mut asked);
    let all = asked.into_iter().flat_map(|condition| comparisons(body, condition));
    let both = all.map(|comparison| [comparison.left, comparison.right]);
    // An alpha of 0 or 1 is on one side of every threshold.
    let is_end =
        |side: &Range<usize>| side.len() == 1 && matches!(body.word(side.start), "0" | "0.0" | "1" | "1.0");
    let sides = both.filter(|sides| !sides.iter().any(is_end)).flatten();
    sides.filter(|side| is_same(side) && *side != test.alpha).map(|side| body.bytes(&side).start).collect()
}

/// The conditions of statements, and what they return.
fn conditions(body: &Body<'_>, list: &[Statement], found: &mut Vec<Range<usize>>) {
    for Statement { at, kind } in list {
        match kind {
            Kind::Block(inner) => conditions(body, inner, found),
            Kind::If { condition, accept, reject } => {
                found.push(condition.clone());
                conditions(body, core::slice::from_ref(accept), found);
                if let Some(reject) = reject {
                    conditions(body, core::slice::from_ref(reject), found);
                }
            }
            Kind::Simple if body.word(at.start) == "return" => found.push(at.start + 1..at.end - 1),
            Kind::Simple | Kind::Whole => {}
        }
    }
}

/// What stands before the body of a function.
struct Head<'t> {
    /// The token of the name.
    name: usize,
    /// The bracket behind the parameters.
    close: usize,
    /// The brace of the body.
    brace: usize,
    parameters: Vec<Parameter<'t>>,
    result: &'t str,
}

struct Parameter<'t> {
    name: &'t str,
    tokens: Range<usize>,
    is_written: bool,
}

impl<'t> Head<'t> {
    fn of(file: &File<'_, 't>, item: &Item<'t>) -> Option<Self> {
        let name = item.function?;
        let end = item.tokens.end;
        let close = (name + 1..end).find(|&at| file.word(at) == ")" && file.tokens[at].parentheses == 0)?;
        let brace = (close..end).find(|&at| file.word(at) == "{")?;
        let inside: Vec<usize> = (name + 2..close).collect();
        let parts = inside.split(|&at| file.word(at) == "," && is_between(file, at));
        let parameters = parts.filter_map(|part| {
            let (first, last) = (*part.first()?, *part.last()?);
            let name = match file.dialect {
                Dialect::Wgsl => {
                    let colon = (first..=last)
                        .find(|&at| file.word(at) == ":" && file.tokens[at].parentheses == 1)?;
                    colon - 1
                }
                Dialect::Glsl | Dialect::Hlsl => {
                    let stop = (first..=last).find(|&at| matches!(file.word(at), ":" | "=" | "["));
                    stop.map_or(last, |stop| stop.saturating_sub(1)).max(first)
                }
            };
            let is_written = (first..=last).any(|at| matches!(file.word(at), "inout" | "out" | "ptr"));
            is_name(file.word(name)).then(|| Parameter {
                name: file.word(name),
                tokens: first..last + 1,
                is_written,
            })
        });
        let result = match file.dialect {
            Dialect::Wgsl => {
                (close..brace).rev().map(|at| file.word(at)).find(|word| is_name(word)).unwrap_or("void")
            }
            Dialect::Glsl | Dialect::Hlsl => name.checked_sub(1).map_or("void", |at| file.word(at)),
        };
        let parameters: Vec<_> = parameters.filter(|parameter| parameter.name != "void").collect();
        Some(Self { name, close, brace, parameters, result })
    }

    /// The parameter that holds the alpha, as a number or in a colour.
    fn alpha(&self, asked: &Options) -> Option<&'t str> {
        let is_it = |parameter: &&Parameter<'t>| match asked.map.get(ALPHA) {
            Some(name) => name.split('.').next() == Some(parameter.name),
            None => is_alpha(parameter.name) && !asked.settings.contains_key(parameter.name),
        };
        self.parameters.iter().find(is_it).map(|parameter| parameter.name)
    }
}

/// Whether a comma stands between two parameters, and not in a type.
fn is_between(file: &File<'_, '_>, at: usize) -> bool {
    // `vec3<f32>` has no comma, `ptr<function, f32>` has.
    file.tokens[at].parentheses == 1
        && !(file.dialect == Dialect::Wgsl && matches!(file.word(at - 1), "function" | "private"))
}

/// Two sides that are compared.
struct Comparison {
    left: Range<usize>,
    right: Range<usize>,
    /// Whether what it says is true where the left side is the smaller one.
    holds_below: bool,
}

/// A test that was found.
struct Test<'s> {
    /// The statements with the one that leads to it, from the outermost.
    path: Vec<(&'s [Statement], usize)>,
    alpha: Range<usize>,
    threshold: Range<usize>,
}

struct Search<'a, 's, 't> {
    file: &'a File<'a, 't>,
    asked: &'a Options,
    body: &'a Body<'t>,
    head: &'a Head<'t>,
    /// Conditions that are open: where, whether this is the branch in which it fails, and the length of the path to it.
    guards: Vec<(Range<usize>, bool, usize)>,
    path: Vec<(&'s [Statement], usize)>,
    found: Option<Test<'s>>,
}

impl<'s> Search<'_, 's, '_> {
    fn within(&mut self, list: &'s [Statement]) -> Result<(), Fault> {
        for (index, statement) in list.iter().enumerate() {
            if self.found.is_some() {
                return Ok(());
            }
            self.path.push((list, index));
            match &statement.kind {
                Kind::Block(inner) => self.within(inner)?,
                Kind::If { condition, accept, reject } => {
                    let depth = self.path.len();
                    self.guards.push((condition.clone(), false, depth));
                    self.within(core::slice::from_ref(accept))?;
                    self.guards.pop();
                    if let Some(reject) = reject {
                        self.guards.push((condition.clone(), true, depth));
                        self.within(core::slice::from_ref(reject))?;
                        self.guards.pop();
                    }
                }
                Kind::Simple => self.simple(&statement.at)?,
                Kind::Whole => {}
            }
            self.path.pop();
        }
        Ok(())
    }

    fn simple(&mut self, at: &Range<usize>) -> Result<(), Fault> {
        let body = self.body;
        let here = self.path.len();
        let inside = at.start + 1..at.end.saturating_sub(1).max(at.start + 1);
        match body.word(at.start) {
            "discard" => self.guarded(true),
            "clip" => {
                let argument = at.start + 2..body.closing(at.start + 1);
                let Some(minus) = only_minus(body, &argument) else { return Ok(()) };
                let sides = Comparison {
                    left: argument.start..minus,
                    right: minus + 1..argument.end,
                    holds_below: true,
                };
                self.take(sides, Some(false), here)
            }
            "return" => {
                let is_test = match self.head.result {
                    "bool" => true,
                    "float" | "f32" | "half" | "int" | "min16float" => self.head.alpha(self.asked).is_some(),
                    _ => false,
                };
                if is_test { self.each(inside, here) } else { Ok(()) }
            }
            word => {
                if body.word(at.start + 1) == "(" {
                    return self.handed(at.start, here);
                }
                let is_output =
                    word == "ALPHA" || self.head.parameters.iter().any(|p| p.is_written && p.name == word);
                if !is_output {
                    return Ok(());
                }
                let equals = at.clone().find(|&at| body.word(at) == "=");
                let Some(equals) = equals else { return Ok(()) };
                self.each(equals + 1..inside.end, here)?;
                if self.found.is_none() && matches!(body.word(equals + 1), "0" | "0.0" | "0." | "0.0f") {
                    self.guarded(false)?;
                }
                Ok(())
            }
        }
    }

    /// Looks at a call of another function of the file that compares two of its parameters and discards.
    fn handed(&mut self, name: usize, path: usize) -> Result<(), Fault> {
        let (file, called) = (self.file, self.body.word(name));
        let is_called = |item: &&Item<'_>| item.function.is_some_and(|at| file.word(at) == called);
        let Some(head) = file.items.iter().find(is_called).and_then(|item| Head::of(file, item)) else {
            return Ok(());
        };
        let is_wgsl = file.dialect == Dialect::Wgsl;
        let theirs = Body::of(file.text, file.tokens, file.in_directive, head.name, is_wgsl);
        let mut arguments = Vec::new();
        let (mut start, close) = (name + 2, self.body.closing(name + 1));
        for at in name + 2..=close {
            let is_end = at == close || self.body.word(at) == "," && depth(self.body, name + 2, at) == 0;
            if is_end {
                arguments.push(start..at);
                start = at + 1;
            }
        }
        let mut guards = Vec::new();
        discarding(&theirs, &theirs.statements(), &mut guards);
        for (condition, fails) in guards {
            for Comparison { left, right, holds_below } in comparisons(&theirs, condition) {
                let handed = |side: &Range<usize>| {
                    let index = head.parameters.iter().position(|p| theirs.written(side) == p.name)?;
                    arguments.get(index).cloned()
                };
                let is_changed = |side: &Range<usize>| {
                    let written = theirs.assigned(0..theirs.at.len());
                    theirs.names(side.clone()).any(|name| written.contains(name))
                };
                if is_changed(&left) || is_changed(&right) {
                    continue;
                }
                if let (Some(left), Some(right)) = (handed(&left), handed(&right)) {
                    self.take(Comparison { left, right, holds_below }, Some(fails), path)?;
                }
            }
        }
        Ok(())
    }

    /// Looks at the conditions that a statement stands behind, the innermost first.
    fn guarded(&mut self, discards: bool) -> Result<(), Fault> {
        for (condition, fails, depth) in self.guards.clone().into_iter().rev() {
            for comparison in comparisons(self.body, condition) {
                self.take(comparison, discards.then_some(fails), depth)?;
            }
        }
        Ok(())
    }

    /// Looks at every comparison of a value.
    fn each(&mut self, range: Range<usize>, path: usize) -> Result<(), Fault> {
        comparisons(self.body, range).into_iter().try_for_each(|comparison| self.take(comparison, None, path))
    }

    /// Takes a comparison for the test if one side is an alpha and the other a threshold. `fails` says whether a fragment goes where
    /// the comparison fails, where that is known.
    fn take(&mut self, comparison: Comparison, fails: Option<bool>, path: usize) -> Result<(), Fault> {
        if self.found.is_some() || comparison.left.is_empty() || comparison.right.is_empty() {
            return Ok(());
        }
        // A number on one side is no alpha, and no hash.
        if [&comparison.left, &comparison.right]
            .into_iter()
            .any(|side| self.body.names(side.clone()).next().is_none())
        {
            return Ok(());
        }
        let Comparison { left, right, holds_below } = comparison;
        let path = self.path[..path].to_vec();
        let [a, b] = [&left, &right].map(|side| Side::of(self.file, self.body, &path, side, self.asked));
        let threshold_is_right = match (a.is_threshold(&b), b.is_threshold(&a)) {
            (false, true) => true,
            (true, false) => false,
            _ => return Ok(()),
        };
        let (alpha, threshold) = if threshold_is_right { (left, right) } else { (right, left) };
        // An alpha that is changed on the way has another threshold than what it is compared with.
        let is_said = self.asked.map.get(ALPHA).is_some_and(|name| name == self.body.written(&alpha));
        let parameter = self.head.alpha(self.asked).filter(|_| !is_said);
        if let Some(parameter) = parameter {
            // A threshold that depends on the alpha is another one for each.
            let needed = slice(self.body, &path, &threshold).0;
            if !self.is_as_given(&path, &alpha, parameter) || needed.contains(parameter) {
                return Ok(());
            }
        }
        // Of a difference it is not known how it follows the alpha.
        if alpha.clone().any(|at| self.body.word(at) == "-") {
            return Ok(());
        }
        if let Some(fails) = fails
            && (holds_below != fails) != threshold_is_right
        {
            let message = format!(
                "a fragment is discarded here where `{}` is above `{}`, and has to be where it is below: exchange the two sides",
                self.body.written(&alpha),
                self.body.written(&threshold)
            );
            return Err(Fault::new(message).at(Some(self.body.bytes(&alpha))));
        }
        self.found = Some(Test { path, alpha, threshold });
        Ok(())
    }
}

impl Search<'_, '_, '_> {
    /// Whether a side is a parameter or its fourth component, by that name or by one that it is given to.
    fn is_as_given(&self, path: &[(&[Statement], usize)], side: &Range<usize>, parameter: &str) -> bool {
        let is_plain = |written: &str| {
            let inner = written.trim_matches(|c: char| c == '(' || c == ')' || c.is_whitespace());
            let rest = inner.strip_prefix(parameter);
            rest.is_some_and(|rest| matches!(rest, "" | ".a" | ".w"))
        };
        let (_, kept) = slice(self.body, path, side);
        let mut names = self.body.names(side.clone());
        let (Some(name), None) = (names.next(), names.next()) else { return false };
        match &kept[..] {
            [] => is_plain(self.body.written(side)),
            [only] => {
                let written = self.body.written(only).trim_end_matches(';');
                let given = written.split_once('=').filter(|(before, _)| before.trim_end().ends_with(name));
                given.is_some_and(|(_, value)| is_plain(value)) && self.body.written(side).trim() == name
            }
            _ => false,
        }
    }
}

/// What one side of a comparison comes from.
struct Side {
    is_said_alpha: bool,
    looks_like_alpha: bool,
    takes_derivatives: bool,
    makes_cells: bool,
    reads_textures: bool,
}

impl Side {
    fn of(
        file: &File<'_, '_>,
        body: &Body<'_>,
        path: &[(&[Statement], usize)],
        side: &Range<usize>,
        asked: &Options,
    ) -> Self {
        let (needed, _) = slice(body, path, side);
        let reads_textures = needed.iter().any(|name| SAMPLES.contains(name))
            || body.all_names(side.clone()).any(|name| SAMPLES.contains(&name));
        let first: HashSet<_> = needed.iter().copied().collect();
        let all = reached(file.text, file.tokens, file.directives, file.items, first);
        let written = body.written(side);
        let said = asked
            .map
            .get(ALPHA)
            .map(|name| name == written || body.names(side.clone()).any(|own| own == name));
        Self {
            is_said_alpha: said == Some(true),
            looks_like_alpha: is_alpha(written),
            takes_derivatives: DERIVATIVES.iter().any(|word| all.contains(word)),
            makes_cells: CELLS.iter().any(|word| all.contains(word)),
            reads_textures,
        }
    }

    fn is_threshold(&self, other: &Self) -> bool {
        if self.is_said_alpha || other.is_said_alpha {
            return other.is_said_alpha && !self.is_said_alpha;
        }
        let is_made = self.takes_derivatives || self.makes_cells;
        is_made
            && (self.takes_derivatives && !other.takes_derivatives
                || !other.takes_derivatives
                    && (other.looks_like_alpha && !self.looks_like_alpha
                        || other.reads_textures && !self.reads_textures)
                || self.takes_derivatives && other.looks_like_alpha && !self.looks_like_alpha)
    }
}

/// The conditions behind which statements discard, each with whether that is where it fails.
fn discarding(body: &Body<'_>, list: &[Statement], found: &mut Vec<(Range<usize>, bool)>) {
    for statement in list {
        match &statement.kind {
            Kind::Block(inner) => discarding(body, inner, found),
            Kind::If { condition, accept, reject } => {
                let discards = |branch: &Statement| branch.at.clone().any(|at| body.word(at) == "discard");
                found.extend(discards(accept).then(|| (condition.clone(), false)));
                let otherwise = reject.as_ref().filter(|reject| discards(reject));
                found.extend(otherwise.map(|_| (condition.clone(), true)));
            }
            Kind::Simple | Kind::Whole => {}
        }
    }
}

/// The names that a value comes from, and the statements that make it.
fn slice<'t>(
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
fn depth(body: &Body<'_>, from: usize, at: usize) -> usize {
    (from..at).fold(0_usize, |depth, at| match body.word(at) {
        "(" | "[" | "{" => depth + 1,
        ")" | "]" | "}" => depth.saturating_sub(1),
        _ => depth,
    })
}

/// The comparisons that a condition or a value is made of.
fn comparisons(body: &Body<'_>, range: Range<usize>) -> Vec<Comparison> {
    let mut found = Vec::new();
    compare(body, range, false, 0, &mut found);
    found
}

fn compare(
    body: &Body<'_>,
    range: Range<usize>,
    is_negated: bool,
    level: usize,
    found: &mut Vec<Comparison>,
) {
    const DEEPEST: usize = 40;
    if range.len() < 3 || level > DEEPEST {
        return;
    }
    let (start, end) = (range.start, range.end);
    let inner = |range, is_negated, found: &mut Vec<_>| compare(body, range, is_negated, level + 1, found);
    let open = |at| body.word(at) == "(" && body.closing(at) + 1 == end;
    if open(start) {
        return inner(start + 1..end - 1, is_negated, found);
    }
    let top =
        |wanted: &dyn Fn(usize) -> bool| (start..end).find(|&at| wanted(at) && depth(body, start, at) == 0);
    if let Some(mark) = top(&|at| body.word(at) == "?") {
        let is_reversed = matches!(body.word(mark + 1), "false" | "0" | "0.0")
            && matches!(body.word(mark + 3), "true" | "1" | "1.0");
        return inner(start..mark, is_negated != is_reversed, found);
    }
    if let Some(sign) = top(&|at| matches!(body.word(at), "&" | "|") && body.word(at + 1) == body.word(at)) {
        inner(start..sign, is_negated, found);
        return inner(sign + 2..end, is_negated, found);
    }
    if body.word(start) == "!" && (open(start + 1) || is_name(body.word(start + 1)) && open(start + 2)) {
        return inner(start + 1..end, !is_negated, found);
    }
    let is_comparison = |at: usize| {
        let (sign, before, next) = (body.word(at), body.word(at - 1), body.word(at + 1));
        let is_type = ["vec", "mat", "array", "bitcast", "ptr"].iter().any(|ty| before.starts_with(ty));
        let is_shift = next == sign || before == sign;
        // `vec3<f32>(` ends before a bracket.
        let ends_type =
            sign == ">" && next == "(" && matches!(before, "f32" | "u32" | "i32" | "f16" | "bool");
        at > start && matches!(sign, "<" | ">") && !is_type && !is_shift && !ends_type
    };
    let is_zero = |range: &Range<usize>| {
        range.len() == 1 && matches!(body.word(range.start), "0" | "0.0" | "0." | "0.0f" | "0.f" | ".0")
    };
    let is_number = |range: &Range<usize>| {
        range.len() == 1 && body.word(range.start).starts_with(|c: char| c.is_ascii_digit() || c == '.')
    };
    let has_step = |range: Range<usize>| range.clone().any(|at| body.word(at) == "step");
    if let Some(sign) = top(&is_comparison) {
        let behind = if body.word(sign + 1) == "=" { sign + 2 } else { sign + 1 };
        let is_less = body.word(sign) == "<";
        let (left, right) = (start..sign, behind.min(end)..end);
        // `step(t, a) < 0.5` is 0 there.
        if is_number(&right) && has_step(left.clone()) {
            if body.word(left.start) == "step" && body.closing(left.start + 1) + 1 == left.end {
                inner(left, is_negated != is_less, found);
            }
            return;
        }
        let holds_below = is_less != is_negated;
        let difference = |range: &Range<usize>| {
            only_minus(body, range).map(|minus| (range.start..minus, minus + 1..range.end))
        };
        found.push(match (difference(&left), difference(&right)) {
            // `a - b < 0.0`, and `0.0 < a - b`.
            (Some((left, minus)), _) if is_zero(&right) => Comparison { left, right: minus, holds_below },
            (_, Some((right, minus))) if is_zero(&left) => {
                Comparison { left: right, right: minus, holds_below: !holds_below }
            }
            _ => Comparison { left, right, holds_below },
        });
        return;
    }
    // `step(t, a) == 0.0`.
    let is_equality = |at: usize| {
        at > start && matches!(body.word(at), "=" | "!") && body.word(at + 1) == "=" && has_step(start..at)
    };
    if let Some(sign) = top(&is_equality) {
        let right = (sign + 2).min(end)..end;
        let is_of_zero = is_zero(&right);
        return inner(start..sign, is_negated != ((body.word(sign) == "=") == is_of_zero), found);
    }
    let step = (start..end).find(|&at| body.word(at) == "step" && body.word(at + 1) == "(");
    if let Some(step) = step {
        let close = body.closing(step + 1);
        let comma = (step + 2..close).find(|&at| body.word(at) == "," && depth(body, step + 2, at) == 0);
        if let Some(comma) = comma {
            found.push(Comparison {
                left: comma + 1..close,
                right: step + 2..comma,
                holds_below: is_negated,
            });
        }
        return;
    }
    if is_name(body.word(start)) && open(start + 1) {
        let comma = (start + 2..end).find(|&at| body.word(at) == "," && depth(body, start + 2, at) == 0);
        let is_less = match body.word(start) {
            "lessThan" | "lessThanEqual" => Some(true),
            "greaterThan" | "greaterThanEqual" => Some(false),
            _ => None,
        };
        if let (Some(is_less), Some(comma)) = (is_less, comma) {
            let (left, right) = (alone(body, start + 2..comma), alone(body, comma + 1..end - 1));
            found.push(Comparison { left, right, holds_below: is_less != is_negated });
            return;
        }
        let is_negated = is_negated != (body.word(start) == "not");
        // A conversion, or one of several values.
        let last =
            (start + 2..end - 1).rev().find(|&at| body.word(at) == "," && depth(body, start + 2, at) == 0);
        inner(last.map_or(start + 2, |comma| comma + 1)..end - 1, is_negated, found);
    }
}

/// The sign of a difference of two values; nothing where there are more terms.
fn only_minus(body: &Body<'_>, range: &Range<usize>) -> Option<usize> {
    let is_sign = |&at: &usize| matches!(body.word(at), "-" | "+") && depth(body, range.start, at) == 0;
    let mut signs = (range.start + 1..range.end).filter(is_sign);
    signs.next().filter(|&at| body.word(at) == "-" && signs.next().is_none())
}

/// What a constructor of a vector repeats, as in `vec2(x)`; any other value as it is.
fn alone(body: &Body<'_>, range: Range<usize>) -> Range<usize> {
    let is_whole = body.word(range.start + 1) == "(" && body.closing(range.start + 1) + 1 == range.end;
    let inner = range.start + 2..range.end.saturating_sub(1);
    let has_comma = inner.clone().any(|at| body.word(at) == "," && depth(body, inner.start, at) == 0);
    let is_vector = ["vec", "float", "half"].iter().any(|ty| body.word(range.start).starts_with(ty));
    if is_whole && is_vector && !has_comma && !inner.is_empty() { inner } else { range }
}

/// The name of what was `main`, which is another thing in GLSL.
const MAIN: &str = "main_threshold";

impl Test<'_> {
    fn rewrite(
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
        Rewritten { blank, edits, function, at: value.start, sides, others: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::directives::{directives, in_directives};
    use super::super::items::items;
    use super::super::scan::tokens;
    use super::super::sources::Sources;
    use super::*;

    fn made(
        text: &str,
        function: &str,
        dialect: Dialect,
        map: &[(&str, &str)],
    ) -> Result<Option<String>, String> {
        let tokens = tokens(text).unwrap();
        let directives = directives(text, &tokens);
        let in_directive = in_directives(&directives, tokens.len());
        let items = items(text, &tokens, &directives);
        let file = File {
            text,
            tokens: &tokens,
            directives: &directives,
            in_directive: &in_directive,
            items: &items,
            dialect,
        };
        let map = map.iter().map(|(key, name)| ((*key).to_owned(), (*name).to_owned())).collect();
        let asked = Options { function: function.to_owned(), map, ..Options::default() };
        let Some(test) = rewritten(&file, &asked).map_err(|fault| fault.message)? else { return Ok(None) };
        let mut bytes = text.as_bytes().to_vec();
        test.blank.into_iter().for_each(|range| bytes[range].fill(b' '));
        let blanked = String::from_utf8(bytes).unwrap();
        let made = Sources::of("", text).exchange(&blanked, test.edits);
        Ok(Some(made.split_whitespace().collect::<Vec<_>>().join(" ")))
    }

    fn glsl(text: &str, function: &str) -> String {
        made(text, function, Dialect::Glsl, &[]).unwrap().unwrap_or_else(|| panic!("{text}"))
    }

    const HASH: &str = "float h(vec3 p) { return fract(length(dFdx(p))); } ";

    #[test]
    fn what_discards_becomes_what_returns_the_threshold() {
        let of = |body: &str| {
            glsl(&format!("{HASH}void main() {{ {body} }}"), "main")
                .replace(HASH.trim(), "")
                .trim()
                .to_owned()
        };
        let wanted = "float main_threshold() { return (h(vPos)); }";
        assert_eq!(
            of("vec4 c = texture(map, uv); if (c.a < h(vPos)) discard; c.rgb *= 2.0; color = c;"),
            wanted
        );
        assert_eq!(of("vec4 c; if (h(vPos) >= c.a) { discard; }"), wanted);
        assert_eq!(of("vec4 c; if (!(c.a > h(vPos))) discard;"), wanted);
        assert_eq!(of("vec4 c; if (c.a < 0.01) discard; if (c.a < 0.9 && c.a < h(vPos)) discard;"), wanted);
        assert_eq!(of("vec4 c; if (c.a >= h(vPos)) { color = c; } else discard;"), wanted);
        let long = "vec4 c = texture(map, uv); vec3 q = vPos; q *= 2.0; c.a *= q.x; if (on) { float t = h(q); if (c.a < t) { discard; } } else { t = 1.0; }";
        assert_eq!(
            of(long),
            "float main_threshold() { vec3 q = vPos; q *= 2.0; { float t = h(q); return (t); } }"
        );
        assert_eq!(
            of("float a = texture(map, uv).a; float b = h(vPos); if (a < b) discard;"),
            "float main_threshold() { float b = h(vPos); return (b); }"
        );
    }

    #[test]
    fn other_ways_to_test_are_known() {
        let of = |text: &str, function: &str| {
            glsl(&format!("{HASH}{text}"), function).replace(HASH.trim(), "").trim().to_owned()
        };
        assert_eq!(
            of("bool keep(float alpha, vec3 p) { return alpha >= h(p); }", "keep"),
            "float keep( vec3 p) { return (h(p)); }"
        );
        assert_eq!(
            of(
                "bool drop(vec3 p, vec4 color) { float t = h(p); return (color.a < t) ? true : false; }",
                "drop"
            ),
            "float drop(vec3 p ) { float t = h(p); return (t); }"
        );
        assert_eq!(
            of("void f(inout float alpha, in vec3 p) { alpha = step(h(p), alpha); }", "f"),
            "float f( in vec3 p) { return (h(p)); }"
        );
        assert_eq!(
            of("void f(vec3 p, inout float alpha) { if (alpha < h(p)) alpha = 0.0; }", "f"),
            "float f(vec3 p ) { return (h(p)); }"
        );
        assert_eq!(
            of("float f(float alpha, vec3 p) { return alpha < h(p) ? 0.0 : 1.0; }", "f"),
            "float f( vec3 p) { return (h(p)); }"
        );
        assert_eq!(
            of("float f(float alpha, vec3 p) { return alpha * step(h(p), alpha); }", "f"),
            "float f( vec3 p) { return (h(p)); }"
        );
        let hlsl = "float h(float3 p) { return frac(length(ddx(p))); } float4 main(VSOut i, float3 p : TEXCOORD0) : SV_Target { float4 c = tex.Sample(s, i.uv); clip(c.a - h(p)); return c; }";
        let made_of = made(hlsl, "main", Dialect::Hlsl, &[]).unwrap().unwrap();
        assert!(made_of.ends_with("float main( float3 p ) { return (h(p)); }"), "{made_of}");
        let wgsl = "fn h(p: vec3f) -> f32 { return fract(length(dpdx(p))); } @fragment fn fs(@builtin(front_facing) f: bool, in: Varying) -> @location(0) vec4<f32> { let c = textureSample(t, s, in.uv); if c.a < h(in.pos) { discard; } return c; }";
        let made_of = made(wgsl, "fs", Dialect::Wgsl, &[]).unwrap().unwrap();
        assert!(made_of.ends_with("fn fs( in: Varying) -> f32 { return (h(in.pos)); }"), "{made_of}");
    }

    #[test]
    fn what_is_no_test_of_an_alpha_stays() {
        let of = |text: &str| made(&format!("{HASH}{text}"), "f", Dialect::Glsl, &[]).unwrap();
        assert_eq!(of("float f(vec3 p, float a) { float x = h(p); return x < a ? x * x : 1.0 - x; }"), None);
        assert_eq!(of("void f(float alpha) { if (alpha < 0.5) discard; }"), None);
        assert_eq!(of("bool f(vec3 p) { return p.x < 1.0; }"), None);
        let wrong = made(
            &format!("{HASH}void f(float alpha, vec3 p) {{ if (alpha > h(p)) discard; }}"),
            "f",
            Dialect::Glsl,
            &[],
        );
        assert!(wrong.unwrap_err().contains("`alpha` is above `h(p)`"));
        let said = made(
            &format!("{HASH}bool f(float k, vec3 p) {{ return k < h(p) * 1.5; }}"),
            "f",
            Dialect::Glsl,
            &[("alpha", "k")],
        );
        assert!(said.unwrap().unwrap().ends_with("return (h(p) * 1.5); }"));
    }
}
