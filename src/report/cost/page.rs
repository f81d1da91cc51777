//! Tables within a page that people write: between two marks, so that one table is written anew and the rest stays.

/// Returns a page with `text` between its marks `<!-- NAME -->` and `<!-- end of NAME -->`; `None` where it does not have them.
#[must_use]
pub fn replaced(page: &str, name: &str, text: &str) -> Option<String> {
    let [begin, end] = [format!("<!-- {name} -->\n"), format!("<!-- end of {name} -->")];
    let (before, rest) = page.split_once(&begin)?;
    let (_, after) = rest.split_once(&end)?;
    Some(format!("{before}{begin}{text}{end}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_between_the_marks_is_exchanged_and_nothing_else() {
        let page = |text: &str| format!("before\n<!-- a -->\n{text}<!-- end of a -->\nafter\n");
        assert_eq!(replaced(&page("old\n"), "a", "new\n"), Some(page("new\n")));
        assert_eq!(replaced(&page("old\n"), "b", "new\n"), None);
        assert_eq!(replaced("<!-- a -->\n", "a", "new\n"), None);
    }
}
