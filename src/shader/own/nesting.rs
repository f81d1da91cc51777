//! How deeply a text nests: parsers and what follows them descend once for each level, on a stack that has an end.

/// The deepest nesting of brackets, and the longest run of signs in front of a value.
const DEEPEST: usize = 200;
/// The most `else` of a text, since each may nest in the one before.
const MOST_ELSE: usize = 1000;
/// The most operators of a statement, since each may take all that stands before it.
const MOST_OPERATORS: usize = 10_000;
/// The most `&&`, `||` and `?` of a statement (the first two count twice): each is a branch within a branch.
const MOST_CHOICES: usize = 400;

/// The most words and signs of a function, brackets and commas apart: the time that naga takes grows with the square.
const MOST_WORDS: usize = 80_000;

/// What is open, and how much a statement has had so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Nesting {
    open: usize,
    prefixes: usize,
    elses: usize,
    operators: usize,
    choices: usize,
    /// Words of the function so far, where they are counted.
    words: Option<usize>,
}

impl Nesting {
    /// Counts what a function comes to, too.
    pub fn of_functions() -> Self {
        Self { words: Some(0), ..Self::default() }
    }

    /// Takes the next word or sign.
    ///
    /// # Errors
    ///
    /// What there is too much of.
    pub fn see(&mut self, word: &str) -> Result<(), String> {
        match word {
            "(" | "[" | "{" => self.open += 1,
            ")" | "]" | "}" => self.open = self.open.saturating_sub(1),
            "else" => self.elses += 1,
            "&" | "|" | "?" => self.choices += 1,
            _ => {}
        }
        self.words = self.words.map(|words| match word {
            _ if self.open == 0 => 0,
            "(" | ")" | "[" | "]" | "{" | "}" | "," | ";" => words,
            _ => words + 1,
        });
        let is_prefix = matches!(word, "-" | "!" | "~" | "&" | "*" | "+" | "<" | "=");
        self.prefixes = if is_prefix { self.prefixes + 1 } else { 0 };
        match word {
            ";" | "{" | "}" | "#" => (self.operators, self.choices) = (0, 0),
            "," | "(" | ")" => {}
            _ if word.bytes().all(|byte| byte.is_ascii_punctuation() && byte != b'_') => self.operators += 1,
            _ => {}
        }
        if self.open > DEEPEST || self.prefixes > DEEPEST || self.elses > MOST_ELSE {
            Err(format!("nested too deeply: more than {DEEPEST} brackets or {MOST_ELSE} `else`"))
        } else if self.operators > MOST_OPERATORS {
            Err(format!("more than {MOST_OPERATORS} operators in one statement"))
        } else if self.choices > MOST_CHOICES {
            Err(format!("more than {} `&&`, `||` or `?` in one statement", MOST_CHOICES / 2))
        } else if self.words > Some(MOST_WORDS) {
            Err(format!("more than {MOST_WORDS} words and signs in one function"))
        } else {
            Ok(())
        }
    }
}
