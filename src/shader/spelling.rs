//! What somebody meant who typed another word.

/// Asks for the word that was likely meant, with a space in front; nothing where none is near.
#[must_use]
pub fn likely<S: AsRef<str>>(wrong: &str, known: &[S]) -> String {
    nearest(wrong, known).map_or_else(String::new, |near| format!(" Did you mean `{near}`?"))
}

/// The known word with the fewest edits, if they are fewer than half of its letters.
fn nearest<'a, S: AsRef<str>>(wrong: &str, known: &'a [S]) -> Option<&'a str> {
    let all = known.iter().map(AsRef::as_ref);
    let (edits, near) = all.map(|near| (strsim::levenshtein(wrong, near), near)).min()?;
    (2 * edits <= near.chars().count().max(2)).then_some(near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_near_word_is_proposed() {
        assert_eq!(nearest("hasht", &["fixed", "hashed"]), Some("hashed"));
        assert_eq!(nearest("zzz", &["fixed", "hashed"]), None);
    }
}
