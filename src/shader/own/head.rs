//! A text that is cut into words and items, and what stands before the body of a function in it.

use super::directives::Directive;
use super::items::Item;
use super::options::{ALPHA, Options};
use super::scan::Token;
use super::statements::is_name;
use super::usual::is_alpha;
use core::ops::Range;

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

/// What stands before the body of a function.
pub(super) struct Head<'t> {
    /// The token of the name.
    pub name: usize,
    /// The bracket behind the parameters.
    pub close: usize,
    /// The brace of the body.
    pub brace: usize,
    pub parameters: Vec<Parameter<'t>>,
    pub result: &'t str,
}

pub(super) struct Parameter<'t> {
    pub name: &'t str,
    pub tokens: Range<usize>,
    pub is_written: bool,
}

impl<'t> Head<'t> {
    pub fn of(file: &File<'_, 't>, item: &Item<'t>) -> Option<Self> {
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
    pub fn alpha(&self, asked: &Options) -> Option<&'t str> {
        let is_it = |parameter: &&Parameter<'t>| match asked.map.get(ALPHA) {
            Some(name) => name.split('.').next() == Some(parameter.name),
            None => is_alpha(parameter.name) && !asked.settings.contains_key(parameter.name),
        };
        self.parameters.iter().find(is_it).map(|parameter| parameter.name)
    }
}

/// Whether a comma stands between two parameters, and not in a type.
pub(super) fn is_between(file: &File<'_, '_>, at: usize) -> bool {
    // `vec3<f32>` has no comma, `ptr<function, f32>` has.
    file.tokens[at].parentheses == 1
        && !(file.dialect == Dialect::Wgsl && matches!(file.word(at - 1), "function" | "private"))
}
