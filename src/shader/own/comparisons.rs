//! The comparisons that a condition is made of, whatever the way in which it is written.

use super::statements::{Body, depth, is_name};
use core::ops::Range;

/// Two sides that are compared.
pub(super) struct Comparison {
    pub left: Range<usize>,
    pub right: Range<usize>,
    /// Whether what it says is true where the left side is the smaller one.
    pub holds_below: bool,
}

/// The comparisons that a condition or a value is made of.
pub(super) fn comparisons(body: &Body<'_>, range: Range<usize>) -> Vec<Comparison> {
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
    if range.is_empty() || level > DEEPEST {
        return;
    }
    let (start, end) = (range.start, range.end);
    let inner = |range, is_negated, found: &mut Vec<_>| compare(body, range, is_negated, level + 1, found);
    let open = |at| body.word(at) == "(" && body.closing(at) + 1 == end;
    // A variable stands for what it was given.
    if range.len() == 1 {
        return body.given(start).into_iter().for_each(|value| inner(value, is_negated, found));
    }
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
    let is_alone = |at: usize| at + 1 == end || open(at + 1);
    if body.word(start) == "!" && (open(start + 1) || is_name(body.word(start + 1)) && is_alone(start + 1)) {
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
    let meant = |range: &Range<usize>| {
        body.given(range.start).filter(|_| range.len() == 1).unwrap_or_else(|| range.clone())
    };
    let has_step = |range: Range<usize>| range.clone().any(|at| body.word(at) == "step");
    if let Some(sign) = top(&is_comparison) {
        let behind = if body.word(sign + 1) == "=" { sign + 2 } else { sign + 1 };
        let is_less = body.word(sign) == "<";
        let (left, right) = (start..sign, behind.min(end)..end);
        // `step(t, a) < 0.5` is 0 there.
        let value = meant(&left);
        if is_number(&right) && has_step(value.clone()) {
            if body.word(value.start) == "step" && body.closing(value.start + 1) + 1 == value.end {
                inner(value, is_negated != is_less, found);
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
        let is_sign = at > start && matches!(body.word(at), "=" | "!") && body.word(at + 1) == "=";
        is_sign && has_step(meant(&(start..at)))
    };
    if let Some(sign) = top(&is_equality) {
        let right = (sign + 2).min(end)..end;
        let is_of_zero = is_zero(&right);
        return inner(meant(&(start..sign)), is_negated != ((body.word(sign) == "=") == is_of_zero), found);
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
pub(super) fn only_minus(body: &Body<'_>, range: &Range<usize>) -> Option<usize> {
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
