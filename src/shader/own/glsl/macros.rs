//! What the macros of a GLSL text come to, without expanding them: a few lines of `#define` can stand for more text than
//! a machine can hold.

use super::super::directives::Directive;
use super::super::error::Fault;
use super::super::nesting::Nesting;
use super::super::scan::Token;
use std::collections::HashMap;

/// The most words and signs that all macros of a text may come to.
const MOST_WORDS: usize = 1 << 19;
/// How deeply macros may stand in macros and in their arguments.
const DEEPEST: usize = 100;

/// A word or a sign, and where it stands.
#[derive(Clone, Copy)]
struct Word<'t> {
    text: &'t str,
    start: usize,
}

struct Macro<'t> {
    /// Names of the parameters; none for a macro that is not called.
    parameters: Option<Vec<&'t str>>,
    body: Vec<Word<'t>>,
}

/// A macro that is being read.
struct Call<'s, 't> {
    name: &'t str,
    parameters: &'s [&'t str],
    arguments: Vec<&'s [Word<'t>]>,
    from: Within<'s, 't>,
}

/// What the words that are being read come from.
#[derive(Clone, Copy)]
struct Within<'s, 't> {
    call: Option<&'s Call<'s, 't>>,
    depth: usize,
}

impl Within<'_, '_> {
    /// Whether a macro stands in itself; it is not expanded then.
    fn is_expanding(&self, name: &str) -> bool {
        let mut at = self.call;
        while let Some(call) = at {
            if call.name == name {
                return true;
            }
            at = call.from.call;
        }
        false
    }
}

/// Reads the tokens of a text that are `kept`, as its parser would see them. Conditions are not evaluated: all that they may leave out is counted, and of
/// several macros of one name the longest.
///
/// # Errors
///
/// Macros that come to more than is read, or that nest too deeply.
pub(super) fn measure(
    text: &str,
    tokens: &[Token],
    directives: &[Directive<'_>],
    kept: impl Fn(&Token) -> bool,
) -> Result<(), Fault> {
    let (macros, words) = definitions(text, tokens, directives, kept);
    let nesting = Nesting::of_functions();
    let mut reader = Reader { macros: &macros, nesting, words_left: MOST_WORDS, start: 0 };
    reader
        .read(&words, Within { call: None, depth: 0 })
        .map_err(|message| Fault::new(message).at(Some(reader.start..reader.start + 1)))
}

/// Takes the lines of directives out of a text; returns the macros that they define, and what is left.
fn definitions<'t>(
    text: &'t str,
    tokens: &[Token],
    directives: &[Directive<'_>],
    kept: impl Fn(&Token) -> bool,
) -> (HashMap<&'t str, Macro<'t>>, Vec<Word<'t>>) {
    let word = |token: &Token| Word { text: &text[token.at.clone()], start: token.at.start };
    let (mut macros, mut left) = (HashMap::new(), Vec::new());
    let mut start = 0;
    for directive in directives {
        left.extend(tokens[start..directive.tokens.start].iter().filter(|token| kept(token)).map(word));
        start = directive.tokens.end;
        let line = tokens[directive.tokens.clone()].iter().map(word);
        let words: Vec<_> = line.filter(|word| word.text != "\\").collect();
        if let [_, Word { text: "define", .. }, name, body @ ..] = &words[..] {
            let is_called =
                body.first().is_some_and(|w| w.text == "(" && w.start == name.start + name.text.len());
            let close = body.iter().position(|word| word.text == ")").filter(|_| is_called);
            let parameters = close.map(|close| {
                body[1..close].iter().map(|word| word.text).filter(|&text| text != ",").collect()
            });
            let body = body[close.map_or(0, |close| close + 1)..].to_vec();
            let longest = macros.get(name.text).is_none_or(|known: &Macro<'_>| known.body.len() < body.len());
            if longest {
                macros.insert(name.text, Macro { parameters, body });
            }
        }
    }
    left.extend(tokens[start..].iter().filter(|token| kept(token)).map(word));
    (macros, left)
}

struct Reader<'m, 't> {
    macros: &'m HashMap<&'t str, Macro<'t>>,
    nesting: Nesting,
    words_left: usize,
    /// The byte of the text at which the reader is.
    start: usize,
}

impl<'t> Reader<'_, 't> {
    fn read(&mut self, words: &[Word<'t>], within: Within<'_, 't>) -> Result<(), String> {
        if within.depth > DEEPEST {
            return Err(format!("macros that nest more than {DEEPEST} deep"));
        }
        let depth = within.depth + 1;
        let macros = self.macros;
        let mut at = 0;
        while let Some(&Word { text, start }) = words.get(at) {
            at += 1;
            match within.call {
                None => self.start = start,
                Some(call) => {
                    self.words_left = self
                        .words_left
                        .checked_sub(1)
                        .ok_or(format!("macros that come to more than {MOST_WORDS} words"))?;
                    if let Some(index) = call.parameters.iter().position(|&name| name == text) {
                        let argument = call.arguments.get(index).copied().unwrap_or_default();
                        self.read(argument, Within { depth, ..call.from })?;
                        continue;
                    }
                }
            }
            let Some(Macro { parameters, body }) = macros.get(text).filter(|_| !within.is_expanding(text))
            else {
                self.nesting.see(text)?;
                continue;
            };
            let arguments = match parameters {
                None => Vec::new(),
                Some(_) => {
                    let (arguments, length) = arguments(&words[at..]);
                    at += length;
                    arguments
                }
            };
            let parameters = parameters.as_deref().unwrap_or_default();
            let call = Call { name: text, parameters, arguments, from: within };
            self.read(body, Within { call: Some(&call), depth })?;
        }
        Ok(())
    }
}

/// The arguments in round brackets at the beginning of `words`, and how many words these are; none where there is no
/// bracket.
fn arguments<'s, 't>(words: &'s [Word<'t>]) -> (Vec<&'s [Word<'t>]>, usize) {
    let (mut arguments, mut depth, mut start) = (Vec::new(), 0_usize, 1);
    for (at, word) in words.iter().enumerate() {
        match word.text {
            "(" => depth += 1,
            _ if depth == 0 => return (Vec::new(), 0),
            ")" => {
                depth -= 1;
                if depth == 0 {
                    arguments.push(&words[start..at]);
                    return (arguments, at + 1);
                }
            }
            "," if depth == 1 => {
                arguments.push(&words[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    (Vec::new(), 0)
}

#[cfg(test)]
mod tests {
    use super::super::super::directives::directives;
    use super::super::super::scan::tokens;
    use super::*;

    fn measured(text: &str) -> Result<(), String> {
        let tokens = tokens(text).unwrap();
        measure(text, &tokens, &directives(text, &tokens), |_| true)
            .map_err(|fault| format!("{} at {:?}", fault.message, fault.at))
    }

    #[test]
    fn macros_that_explode_are_refused_where_they_are_used() {
        let doubling = |first: &str, next: &dyn Fn(usize) -> String, last: &str| {
            let lines: String = (1..40).map(next).collect();
            format!("#define A0 {first}\n{lines}float threshold() {{ return {last}; }}\n")
        };
        let sums = doubling("1.0", &|i| format!("#define A{i} A{} + A{}\n", i - 1, i - 1), "A39");
        let commas = doubling("1.0", &|i| format!("#define A{i} A{} , A{}\n", i - 1, i - 1), "A39");
        let nothing = doubling("", &|i| format!("#define A{i} A{} A{}\n", i - 1, i - 1), "1.0 A39");
        let brackets =
            doubling("(", &|i| format!("#define A{i} A{}A{}\n", i - 1, i - 1).replace("A", " A"), "A39");
        let calls = "#define A0(x) x , x\n".to_owned()
            + &(1..8).map(|i| format!("#define A{i}(x) A{}(A{}(x))\n", i - 1, i - 1)).collect::<String>()
            + "float threshold() { return f(A7(1.0)); }";
        for (text, wanted) in [
            (sums, "operators in one statement"),
            (commas, "more than 80000 words and signs in one function"),
            (nothing, "more than 524288 words"),
            (brackets, "nested too deeply"),
            (calls, "nest more than 100 deep"),
        ] {
            let message = measured(&text).unwrap_err();
            let place = format!(" at Some({}..", text.rfind("A39").or(text.rfind("A7(")).unwrap());
            assert!(message.contains(wanted) && message.contains(&place), "{message}, not {wanted}{place}");
        }
    }

    #[test]
    fn macros_as_engines_write_them_are_read() {
        let text = "
#define saturate(a) clamp(a, 0.0, 1.0)
#define PI 3.14159
#ifdef X
#define mix3(a, b, \\
    c) a * (b + c)
#endif
#define self self + 1
#define F G
#define G(x) F(x)
float threshold() { return saturate(saturate(mix3(PI, (1, 2), 3))) + self + F(1) + G(G(2)) + G; }";
        assert_eq!(measured(text), Ok(()));
    }
}
