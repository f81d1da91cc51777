//! Lines of a width.

/// Breaks a text between words; a word that is longer than the line is broken too.
pub(super) fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let pieces: Vec<char> = word.chars().filter(|c| !c.is_control()).collect();
        for piece in pieces.chunks(width) {
            let last = lines.last_mut().expect("there is a line");
            let used = last.chars().count();
            if used > 0 && used + 1 + piece.len() > width {
                lines.push(piece.iter().collect());
            } else {
                last.extend((used > 0).then_some(' ').into_iter().chain(piece.iter().copied()));
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_break_between_words_and_in_a_word_that_is_too_long() {
        assert_eq!(wrap("aaaa bb cc", 4), ["aaaa", "bb", "cc"]);
        assert_eq!(wrap("aaaaaa", 4), ["aaaa", "aa"]);
    }
}
