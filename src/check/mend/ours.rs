//! Our own threshold in the place of the body of a function: its name, its parameters and its other functions stay.

use super::edits::Sheet;
use crate::shader::assemble::{HashScale, ShaderOptions};
use crate::shader::export::{Exported, Language, export};
use crate::threshold::pipeline::Pipeline;
use std::collections::BTreeSet;

/// What ours is called in the text of somebody else.
const NAME: &str = "hashed_alpha_of_the_paper";

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).filter(|word| !word.is_empty())
}

/// The text whose function calls the listing of its variant; nothing where a name is taken, or where the function has no position or no
/// derivatives.
pub(super) fn replaced(sheet: &Sheet<'_>) -> Option<String> {
    let Sheet { text, syntax, function, .. } = *sheet;
    let (position, [dpdx, dpdy]) = (sheet.position.as_ref()?, sheet.derivatives_of_function()?);
    // A size that has no name in the text would be lost.
    if sheet.has_hash_scale && sheet.hash_scale.is_none() {
        return None;
    }
    let hash_scale = if sheet.hash_scale.is_some() { HashScale::Parameter } else { HashScale::Written };
    let pipeline = Pipeline::listing(sheet.variant);
    let language = if syntax.is_wgsl { Language::Wgsl } else { Language::Glsl };
    let Exported::Text(ours) = export(ShaderOptions { pipeline, hash_scale }, language).ok()? else {
        return None;
    };
    let ours: String =
        ours.lines().filter(|line| !line.starts_with("#version")).map(|line| format!("{line}\n")).collect();
    let ours = ours.replace("threshold(", &format!("{NAME}("));
    // Names of types and functions stand in front of a bracket.
    let taken: BTreeSet<&str> = words(text).collect();
    let names = ours.lines().filter(|line| !line.starts_with([' ', '/', '}']) && line.contains(['(', '{']));
    let mut names = names.filter_map(|line| line.split(['(', '{']).next()?.split_whitespace().last());
    if names.any(|name| taken.contains(name)) {
        return None;
    }
    let head = syntax.head(function, text)?;
    let mut given = vec![position.clone(), dpdx, dpdy];
    given.extend(sheet.hash_scale.clone());
    let line = text[..head.start].rfind('\n').map_or(0, |newline| newline + 1);
    let body = format!("{{\n    return {NAME}({});\n}}", given.join(", "));
    Some(
        [&text[..line], ours.trim_end(), "\n\n", &text[line..head.end.start], &body, &text[head.end.end..]]
            .concat(),
    )
}
