//! A shader's text as words and signs, enough to prepare it for the parser: no grammar, no macros.

use super::error::Fault;
use super::nesting::Nesting;
use core::ops::Range;

/// A word or a sign of the text, outside of comments.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// Where it stands, in bytes.
    pub at: Range<usize>,
    /// Round brackets that are open here.
    pub parentheses: usize,
    /// Braces that are open here.
    pub braces: usize,
    /// The function in whose body it stands: the index of the token of its name.
    pub function: Option<usize>,
}

/// Cuts a text into tokens: words (letters, digits, `_`), numbers and single signs.
///
/// # Errors
///
/// Nesting too deep for a parser that descends, and a comment that does not end.
pub(super) fn tokens(text: &str) -> Result<Vec<Token>, Fault> {
    let bytes = text.as_bytes();
    let is_word = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    let mut tokens: Vec<Token> = Vec::new();
    let (mut braces, mut parentheses) = (0_usize, 0_usize);
    let mut nesting = Nesting::default();
    let (mut named, mut function) = (None, None);
    // What is open where a condition of a preprocessor begins: each of its branches begins there.
    let mut conditions = Vec::new();
    let mut start = 0;
    while start < bytes.len() {
        let rest = &bytes[start..];
        let length = match rest[0] {
            b'/' if rest.starts_with(b"//") => {
                start += until(rest, b"\n");
                continue;
            }
            b'/' if rest.starts_with(b"/*") => {
                let length = 2 + until(&rest[2..], b"*/");
                if length == rest.len() {
                    return Err(Fault::new("a comment that does not end").at(Some(start..start + 2)));
                }
                start += length + 2;
                continue;
            }
            byte if byte.is_ascii_whitespace() => {
                start += 1;
                continue;
            }
            byte if byte.is_ascii_digit() => {
                rest.iter().take_while(|&&byte| is_word(byte) || byte == b'.').count()
            }
            byte if !byte.is_ascii() => text[start..].chars().next().map_or(1, char::len_utf8),
            byte if is_word(byte) => rest.iter().take_while(|&&byte| is_word(byte)).count(),
            _ => 1,
        };
        let at = start..start + length;
        match bytes[start] {
            b'(' => {
                if braces == 0 && parentheses == 0 {
                    let word = |at: usize| &text[tokens[at].at.clone()];
                    let is_name = |&name: &usize| {
                        // An attribute of WGSL stands behind a sign of its own.
                        let is_attribute = name > 0 && word(name - 1) == "@";
                        !is_attribute && !matches!(word(name), "layout" | "register" | "packoffset")
                    };
                    // The name stays where an attribute of the result follows.
                    let before = tokens.len().checked_sub(1);
                    named = before.map(|last| before_types(last, word)).filter(is_name).or(named);
                }
                parentheses += 1;
            }
            b')' => parentheses = parentheses.saturating_sub(1),
            b'{' => {
                if braces == 0 {
                    function = named.take();
                }
                braces += 1;
            }
            b'}' => {
                braces = braces.saturating_sub(1);
                if braces == 0 {
                    function = None;
                }
            }
            b';' if braces == 0 => named = None,
            _ => {}
        }
        if tokens.last().is_some_and(|last| &text[last.at.clone()] == "#") {
            match &text[at.clone()] {
                "if" | "ifdef" | "ifndef" => {
                    conditions.push(((braces, parentheses, named, function), false));
                }
                "elif" | "else" => {
                    if let Some((open, has_others)) = conditions.last_mut() {
                        (braces, parentheses, named, function) = *open;
                        *has_others = true;
                    }
                }
                "endif" => {
                    // Where there is one branch, the other one is empty.
                    if let Some((open, false)) = conditions.pop() {
                        (braces, parentheses, named, function) = open;
                    }
                }
                _ => {}
            }
        }
        nesting.see(&text[at.clone()]).map_err(|message| Fault::new(message).at(Some(at.clone())))?;
        tokens.push(Token { at, parentheses, braces, function });
        start += length;
    }
    Ok(tokens)
}

/// The place of a name behind which parameters of types may stand, as in `f<T>`; any other place stays.
fn before_types<'t>(last: usize, word: impl Fn(usize) -> &'t str) -> usize {
    if word(last) != ">" {
        return last;
    }
    let open =
        (0..last).rev().take_while(|&at| !matches!(word(at), ";" | "{" | "}")).find(|&at| word(at) == "<");
    open.and_then(|open| open.checked_sub(1)).unwrap_or(last)
}

/// The bytes up to the first `end`, or all.
fn until(bytes: &[u8], end: &[u8]) -> usize {
    bytes.windows(end.len()).position(|window| window == end).unwrap_or(bytes.len())
}

/// Says of a text that ends too early what is open at its end; nothing where all is closed.
pub(super) fn end_of_file(text: &str, tokens: &[Token]) -> Option<Fault> {
    let mut open = Vec::new();
    for token in tokens {
        match &text[token.at.clone()] {
            "(" | "[" | "{" => open.push(token.at.clone()),
            ")" | "]" | "}" => {
                open.pop();
            }
            _ => {}
        }
    }
    let at = open.pop()?;
    Some(Fault::new(format!("the file ends before this `{}` is closed", &text[at.clone()])).at(Some(at)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_know_their_function() {
        let text = "float a(vec3 p) { /* b( */ return f(p); } // c\nfloat d;";
        let tokens = tokens(text).unwrap();
        let word = |name: &str| tokens.iter().position(|token| &text[token.at.clone()] == name).unwrap();
        assert_eq!(tokens[word("return")].function, Some(word("a")));
        assert_eq!(tokens[word("d")].function, None);
        assert!(!tokens.iter().any(|token| matches!(&text[token.at.clone()], "*" | "/")));
        assert!(!tokens.iter().any(|token| matches!(&text[token.at.clone()], "b" | "c")));
    }

    #[test]
    fn branches_of_a_condition_begin_alike() {
        let text = "#ifdef A\nfloat a() {\n#else\nfloat b() {\n#endif\nreturn 1.0; }\nfloat c;";
        let tokens = tokens(text).unwrap();
        let last = tokens.last().unwrap();
        assert_eq!((&text[last.at.clone()], last.function), (";", None));
    }

    #[test]
    fn deep_nesting_is_refused() {
        for text in ["(".repeat(300), "- ".repeat(300), "else if (x) {} ".repeat(2000)] {
            assert!(tokens(&text).is_err());
        }
        assert!(tokens(&"()".repeat(300)).is_ok());
    }

    #[test]
    fn long_statements_are_refused_and_long_lists_are_not() {
        for text in ["x + ".repeat(20_000), ".xyz".repeat(20_000), "[0]".repeat(20_000), "x && ".repeat(300)]
        {
            assert!(tokens(&text).is_err());
        }
        assert!(tokens(&"vec2(-0.5, 0.25), ".repeat(9_000)).is_ok());
        assert!(tokens(&"x += 1.0 - y;".repeat(9_000)).is_ok());
        assert!(tokens(&"#define X (x + 1.0)\n".repeat(9_000)).is_ok());
    }

    #[test]
    fn what_is_open_at_the_end_is_named() {
        let at = |text: &str| end_of_file(text, &tokens(text).unwrap()).map(|fault| fault.at.unwrap());
        assert_eq!(at("f(a) { b[1]"), Some(5..6));
        assert_eq!(at("f(a) { b[1"), Some(8..9));
        assert_eq!(at("f(a) { b[1] }"), None);
    }

    #[test]
    fn a_comment_has_an_end() {
        assert_eq!(tokens("x /* y").unwrap_err().at, Some(2..4));
    }
}
