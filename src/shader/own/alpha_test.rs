//! A test of an alpha in the text of a function, and what the alpha is compared with there: that is the threshold. It is looked for in
//! functions that discard, that return whether to keep, that write an alpha, and in a whole `main`.

use super::comparisons::{Comparison, comparisons, only_minus};
use super::error::Fault;
use super::head::{Dialect, File, Head};
use super::items::{Item, reached};
use super::options::{ALPHA, Options};
use super::rewriting::{Rewritten, Test};
use super::statements::{Body, Kind, Statement, depth, is_name, slice};
use super::usual::is_alpha;
use core::ops::Range;
use std::collections::HashSet;

/// Words by which a fragment, or a hit of a ray, goes.
const DISCARDS: [&str; 5] =
    ["discard", "demote", "terminateInvocation", "IgnoreHit", "ignoreIntersectionEXT"];

/// Words by which a texture is read.
const SAMPLES: [&str; 23] = [
    "Texel",
    "tex2Dlod",
    "tex2Dbias",
    "tex2Dgrad",
    "SAMPLE_TEXTURE2D",
    "SAMPLE_TEXTURE2D_LOD",
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

/// The statements that one stands in, from the outermost.
type Path<'s> = Vec<(&'s [Statement], usize)>;

/// A condition behind which statements stand.
#[derive(Clone)]
struct Guard<'s> {
    condition: Range<usize>,
    /// Whether they are reached where it fails.
    fails: bool,
    path: Path<'s>,
}

struct Search<'a, 's, 't> {
    file: &'a File<'a, 't>,
    asked: &'a Options,
    body: &'a Body<'t>,
    head: &'a Head<'t>,
    guards: Vec<Guard<'s>>,
    path: Path<'s>,
    found: Option<Test<'s>>,
}

impl<'s> Search<'_, 's, '_> {
    fn within(&mut self, list: &'s [Statement]) -> Result<(), Fault> {
        let open = self.guards.len();
        for (index, statement) in list.iter().enumerate() {
            if self.found.is_some() {
                return Ok(());
            }
            self.path.push((list, index));
            match &statement.kind {
                Kind::Block(inner) => self.within(inner)?,
                Kind::If { condition, accept, reject } => {
                    let mut guard =
                        Guard { condition: condition.clone(), fails: false, path: self.path.clone() };
                    self.guards.push(guard.clone());
                    self.within(core::slice::from_ref(accept))?;
                    self.guards.pop();
                    guard.fails = true;
                    if let Some(reject) = reject {
                        self.guards.push(guard);
                        self.within(core::slice::from_ref(reject))?;
                        self.guards.pop();
                    } else if returns(self.body, accept) {
                        // What follows is reached where the condition fails.
                        self.guards.push(guard);
                    }
                }
                Kind::Simple => self.simple(&statement.at)?,
                Kind::Whole => {}
            }
            self.path.pop();
        }
        self.guards.truncate(open);
        Ok(())
    }

    fn simple(&mut self, at: &Range<usize>) -> Result<(), Fault> {
        let body = self.body;
        let here = &self.path.clone()[..];
        let inside = at.start + 1..at.end.saturating_sub(1).max(at.start + 1);
        match body.word(at.start) {
            word if DISCARDS.contains(&word) => self.guarded(true),
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
    fn handed(&mut self, name: usize, path: &[(&'s [Statement], usize)]) -> Result<(), Fault> {
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
        for Guard { condition, fails, path } in self.guards.clone().into_iter().rev() {
            for comparison in comparisons(self.body, condition) {
                self.take(comparison, discards.then_some(fails), &path)?;
            }
        }
        Ok(())
    }

    /// Looks at every comparison of a value.
    fn each(&mut self, range: Range<usize>, path: &[(&'s [Statement], usize)]) -> Result<(), Fault> {
        comparisons(self.body, range).into_iter().try_for_each(|comparison| self.take(comparison, None, path))
    }

    /// Takes a comparison for the test if one side is an alpha and the other a threshold. `fails` says whether a fragment goes where
    /// the comparison fails, where that is known.
    fn take(
        &mut self,
        comparison: Comparison,
        fails: Option<bool>,
        path: &[(&'s [Statement], usize)],
    ) -> Result<(), Fault> {
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
        let start = left.start;
        let path = &leading_to(path, left.start)[..];
        let [a, b] = [&left, &right].map(|side| Side::of(self.file, self.body, path, side, self.asked));
        let threshold_is_right = match (a.is_threshold(&b), b.is_threshold(&a)) {
            (false, true) => true,
            (true, false) => false,
            _ => return Ok(()),
        };
        let (alpha, threshold) = if threshold_is_right { (left, right) } else { (right, left) };
        let is_read = if threshold_is_right { a.reads_textures } else { b.reads_textures };
        // An alpha that is changed on the way has another threshold than what it is compared with.
        let is_said = self.asked.map.get(ALPHA).is_some_and(|name| name == self.body.written(&alpha));
        // What a texture has is no parameter.
        let parameter = self.head.alpha(self.asked).filter(|_| !is_said && !is_read);
        if let Some(parameter) = parameter {
            // A threshold that depends on the alpha is another one for each.
            let needed = slice(self.body, path, &threshold).0;
            if !self.is_as_given(path, &alpha, parameter) || needed.contains(parameter) {
                return Ok(());
            }
        }
        // Of a difference it is not known how it follows the alpha, and a transparency is one.
        let lower = self.body.written(&alpha).to_ascii_lowercase();
        let is_rest = ["transparen", "transmit"].iter().any(|part| lower.contains(part));
        if is_rest || alpha.clone().any(|at| self.body.word(at) == "-") {
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
        // A condition that the comparison is a part of is no other one, and a variable stands for one.
        let is_own = |guard: &&Guard<'_>| {
            let within = comparisons(self.body, guard.condition.clone());
            !within.iter().any(|part| part.left.start == start)
        };
        let said = |guard: &Guard<'_>| {
            let condition =
                self.body.written(&guard.condition).split_whitespace().collect::<Vec<_>>().join(" ");
            format!("`{condition}`{}", if guard.fails { " where it fails" } else { "" })
        };
        let behind = self.guards.iter().filter(is_own).map(said).collect();
        self.found = Some(Test { path: path.to_vec(), alpha, threshold, behind });
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

/// The path to the statement that holds a place: the one of a path, or one before it that gives a variable its value.
fn leading_to<'s>(path: &[(&'s [Statement], usize)], place: usize) -> Path<'s> {
    let before = path.iter().enumerate().find_map(|(level, &(list, index))| {
        let holding = list[..index].iter().position(|statement| statement.at.contains(&place))?;
        Some([&path[..level], &[(list, holding)]].concat())
    });
    before.unwrap_or_else(|| path.to_vec())
}

/// Whether a statement is a `return`, or ends in one.
fn returns(body: &Body<'_>, statement: &Statement) -> bool {
    match &statement.kind {
        Kind::Simple => body.word(statement.at.start) == "return",
        Kind::Block(inner) => inner.last().is_some_and(|last| returns(body, last)),
        Kind::If { .. } | Kind::Whole => false,
    }
}

/// The conditions behind which statements discard, each with whether that is where it fails.
fn discarding(body: &Body<'_>, list: &[Statement], found: &mut Vec<(Range<usize>, bool)>) {
    for statement in list {
        match &statement.kind {
            Kind::Block(inner) => discarding(body, inner, found),
            Kind::If { condition, accept, reject } => {
                let discards =
                    |branch: &Statement| branch.at.clone().any(|at| DISCARDS.contains(&body.word(at)));
                found.extend(discards(accept).then(|| (condition.clone(), false)));
                let otherwise = reject.as_ref().filter(|reject| discards(reject));
                found.extend(otherwise.map(|_| (condition.clone(), true)));
            }
            Kind::Simple | Kind::Whole => {}
        }
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
        assert_eq!(of("vec4 c; bool keep = c.a >= h(vPos); if (!keep) discard;"), wanted);
        assert_eq!(
            of(
                "vec4 c; bool on = fade, keep; bool gone = fade && c.a < h(vPos); c *= 2.0; if (gone) { discard; }"
            ),
            wanted
        );
        assert_eq!(of("vec4 c; if (c.a > h(vPos)) { color = c; return; } discard;"), wanted);
        assert_eq!(of("vec4 c; float k = step(h(vPos), c.a); if (k < 0.5) discard;"), wanted);
        let long = "vec4 c = texture(map, uv); vec3 q = vPos; q *= 2.0; c.a *= q.x; if (on) { float t = h(q); if (c.a < t) { discard; } } else { t = 1.0; }";
        assert_eq!(
            of(long),
            "float main_threshold() { vec3 q = vPos; q *= 2.0; { float t = h(q); return (t); } }"
        );
        assert_eq!(
            of("float a = texture(map, uv).a; float b = h(vPos); if (a < b) discard;"),
            "float main_threshold() { float b = h(vPos); return (b); }"
        );
        // What happens after the comparison changes nothing of it.
        assert_eq!(
            of(
                "float a = texture(map, uv).a; vec3 q = vPos; bool gone = a < h(q); q *= 2.0; if (gone) discard;"
            ),
            "float main_threshold() { vec3 q = vPos; return (h(q)); }"
        );
        let twice =
            "float a = texture(map, uv).a; bool gone = a < h(vPos); gone = gone || off; if (gone) discard;";
        assert_eq!(made(&format!("{HASH}void main() {{ {twice} }}"), "main", Dialect::Glsl, &[]), Ok(None));
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
