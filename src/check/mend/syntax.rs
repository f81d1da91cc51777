//! A shader's text as statements and expressions, with their places: as much grammar as it takes to change one of them. Types are
//! guessed from declarations; what the language makes of a change is asked of its parser.

use crate::shader::own::{self, Token};
use core::ops::Range;
use std::collections::{BTreeSet, HashMap};

/// What one number of a value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Scalar {
    Float,
    Int,
    UInt,
    Bool,
}

/// A scalar or a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Type {
    pub scalar: Scalar,
    pub size: u8,
}

impl Type {
    pub const FLOAT: Self = Self { scalar: Scalar::Float, size: 1 };
    pub const VEC3: Self = Self { scalar: Scalar::Float, size: 3 };
    pub const UINT: Self = Self { scalar: Scalar::UInt, size: 1 };
    pub const BOOL: Self = Self { scalar: Scalar::Bool, size: 1 };

    /// The type of a name in either language, without spaces.
    fn of(name: &str) -> Option<Self> {
        let scalar = |scalar| Some(Self { scalar, size: 1 });
        match name {
            "float" | "f32" => return scalar(Scalar::Float),
            "int" | "i32" => return scalar(Scalar::Int),
            "uint" | "u32" => return scalar(Scalar::UInt),
            "bool" => return scalar(Scalar::Bool),
            _ => {}
        }
        let (kind, rest) = name.split_once("vec")?;
        let size = rest.bytes().next().filter(u8::is_ascii_digit)? - b'0';
        let scalar = match (kind, &rest[1..]) {
            ("", "" | "f" | "<f32>") => Scalar::Float,
            ("i", "") | ("", "i" | "<i32>") => Scalar::Int,
            ("u", "") | ("", "u" | "<u32>") => Scalar::UInt,
            ("b", "") | ("", "<bool>") => Scalar::Bool,
            _ => return None,
        };
        Some(Self { scalar, size })
    }

    fn element(self) -> Self {
        Self { size: 1, ..self }
    }
}

/// An expression and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Expr {
    pub at: Range<usize>,
    pub kind: Kind,
    /// Nothing where it is not guessed.
    pub of: Option<Type>,
}

#[derive(Clone, Debug)]
pub(super) enum Kind {
    Number,
    Name(String),
    /// The name of what is called, or of the type that is made.
    Call(String, Range<usize>, Vec<Expr>),
    Member(Box<Expr>),
    Index(Box<Expr>, Box<Expr>),
    Parens(Box<Expr>),
    Unary(Box<Expr>),
    /// The operator and its place.
    Binary(String, Range<usize>, Box<[Expr; 2]>),
    Choice(Box<[Expr; 3]>),
}

impl Expr {
    /// The expressions of which this one is made.
    pub fn parts(&self) -> Vec<&Self> {
        match &self.kind {
            Kind::Number | Kind::Name(_) => Vec::new(),
            Kind::Call(_, _, parts) => parts.iter().collect(),
            Kind::Member(part) | Kind::Parens(part) | Kind::Unary(part) => vec![part],
            Kind::Index(base, index) => vec![base, index],
            Kind::Binary(_, _, parts) => parts.iter().collect(),
            Kind::Choice(parts) => parts.iter().collect(),
        }
    }

    /// This one and all in it, the outer ones first.
    pub fn all(&self) -> Vec<&Self> {
        let mut all = vec![self];
        let mut next = 0;
        while next < all.len() {
            all.extend(all[next].parts());
            next += 1;
        }
        all
    }
}

/// What a statement does with its value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// Gives it to a new variable.
    Declares(String),
    /// Gives it to what is there, whole or in part.
    Assigns,
    Returns,
    /// Branches on it.
    Branches,
    /// Stands for it: the body of a macro.
    Macro,
}

/// A statement with a value, or the initial value of a declaration.
#[derive(Clone, Debug)]
pub(super) struct Statement {
    pub role: Role,
    /// The function that it stands in; nothing outside of all.
    pub function: Option<usize>,
    /// From its first word to its semicolon.
    pub at: Range<usize>,
    pub value: Expr,
    /// The type of what takes the value.
    pub of: Option<Type>,
    /// Names that can be read here: how many of those of the function are declared before.
    pub before: usize,
}

/// A function of the text.
#[derive(Clone, Debug)]
pub(super) struct Function {
    pub name: String,
    pub parameters: Vec<(String, String)>,
    pub returns: Option<Type>,
    /// Names that are declared in its body, in order.
    pub locals: Vec<(String, Option<Type>)>,
    /// Words of its body.
    words: BTreeSet<String>,
}

/// A text, as far as it was understood.
#[derive(Clone, Debug, Default)]
pub(super) struct Syntax {
    pub functions: Vec<Function>,
    pub statements: Vec<Statement>,
    /// Constants, uniforms and macros without parameters.
    pub globals: Vec<(String, Option<Type>)>,
    fields: HashMap<String, Option<Type>>,
    pub is_wgsl: bool,
}

/// Where a function stands.
pub(super) struct Head {
    /// Its first byte.
    pub start: usize,
    /// Its body.
    pub end: Range<usize>,
}

struct Reader<'t> {
    text: &'t str,
    /// Words and signs, with those of several characters put together.
    tokens: Vec<Range<usize>>,
    /// The function of each: the byte at which its name begins.
    function: Vec<Option<usize>>,
    at: usize,
    end: usize,
    syntax: Syntax,
    /// The function whose names are known.
    inside: Option<usize>,
    macro_parameters: Vec<String>,
}

/// Signs of several characters.
const LONG: [&str; 19] = [
    "<<=", ">>=", "<=", ">=", "==", "!=", "&&", "||", "<<", ">>", "+=", "-=", "*=", "/=", "|=", "&=", "^=",
    "++", "->",
];

/// Puts numbers and signs together that the scan has cut.
fn glued(text: &str, tokens: &[Token]) -> (Vec<Range<usize>>, Vec<Option<usize>>) {
    let mut all: Vec<Range<usize>> = Vec::new();
    let mut functions = Vec::new();
    let mut index = 0;
    while index < tokens.len() {
        let token = &tokens[index];
        let (start, mut end) = (token.at.start, token.at.end);
        let rest = &text[start..];
        let mut next = index + 1;
        let adjacent = |at: usize, end: usize| tokens.get(at).filter(|token| token.at.start == end);
        if rest.starts_with('.')
            && let Some(digits) = adjacent(next, end).filter(|t| text.as_bytes()[t.at.start].is_ascii_digit())
        {
            (end, next) = (digits.at.end, next + 1);
        }
        let word = &text[start..end];
        let is_number =
            word.starts_with(|c: char| c.is_ascii_digit()) || word.len() > 1 && word.starts_with('.');
        if is_number && !word.starts_with("0x") && word.ends_with(['e', 'E']) {
            for _ in 0..2 {
                if let Some(more) = adjacent(next, end) {
                    (end, next) = (more.at.end, next + 1);
                }
            }
        } else if let Some(long) = LONG.iter().find(|long| rest.starts_with(**long)) {
            (end, next) = (start + long.len(), index + long.len());
        }
        all.push(start..end);
        functions.push(token.function.map(|name| tokens[name].at.start));
        index = next;
    }
    (all, functions)
}

impl Syntax {
    /// Reads a text.
    pub fn of(text: &str, is_wgsl: bool) -> Self {
        let tokens = own::words(text);
        let (tokens, function) = glued(text, &tokens);
        let mut reader = Reader {
            text,
            end: tokens.len(),
            tokens,
            function,
            at: 0,
            syntax: Self { is_wgsl, ..Self::default() },
            inside: None,
            macro_parameters: Vec::new(),
        };
        reader.functions();
        reader.fields();
        reader.statements();
        reader.syntax
    }

    /// The functions that one of them comes to, itself first; by name.
    pub fn reached(&self, function: &str) -> Vec<usize> {
        let position = |name: &str| self.functions.iter().position(|function| function.name == name);
        let mut all: Vec<usize> = position(function).into_iter().collect();
        let mut next = 0;
        while next < all.len() {
            for word in &self.functions[all[next]].words {
                all.extend(position(word).filter(|found| !all.contains(found)));
            }
            next += 1;
        }
        all
    }

    /// Whether a function makes a number of a cell, as far as its words tell: bits or a sine, itself or in what it calls, and nothing
    /// of how large a pixel is.
    pub fn is_hash(&self, function: usize) -> bool {
        let has = |function: usize, words: &[&str]| {
            words.iter().any(|word| self.functions[function].words.contains(*word))
        };
        let mixes = ["sin", "uint", "uvec3", "uvec4", "uvec2", "u32", ">>", "^", "bitcast"];
        let measures = ["log2", "log", "dFdx", "dpdx", "length", "fwidth"];
        !has(function, &measures)
            && self.reached(&self.functions[function].name).into_iter().any(|other| has(other, &mixes))
    }

    /// The names that a statement can read.
    pub fn scope(&self, statement: &Statement) -> Vec<(String, Option<Type>)> {
        let globals = self.globals.iter().cloned();
        let Some(function) = statement.function.map(|function| &self.functions[function]) else {
            return globals.collect();
        };
        let parameters = function.parameters.iter().map(|(name, of)| (name.clone(), Type::of(of)));
        parameters.chain(function.locals[..statement.before].iter().cloned()).chain(globals).collect()
    }

    /// Whether a function has a parameter of a name, or the text a variable outside of all functions.
    pub fn has(&self, function: &str, name: &str) -> bool {
        let function = self.functions.iter().find(|other| other.name == function);
        let is_parameter = function.is_some_and(|f| f.parameters.iter().any(|(other, _)| other == name));
        is_parameter || self.globals.iter().any(|(other, _)| other == name)
    }

    /// Where a function begins, and its body with its brackets.
    pub fn head(&self, function: &str, text: &str) -> Option<Head> {
        let tokens = own::words(text);
        let name = tokens
            .iter()
            .filter_map(|token| token.function)
            .find(|&name| &text[tokens[name].at.clone()] == function)?;
        let before = if self.is_wgsl { "fn" } else { "" };
        let start = tokens[..name]
            .iter()
            .rev()
            .find(|token| before.is_empty() || &text[token.at.clone()] == before)?;
        let open = tokens[name..].iter().position(|token| &text[token.at.clone()] == "{")? + name;
        let mut depth = 0;
        let close = tokens[open..].iter().find(|token| {
            match &text[token.at.clone()] {
                "{" => depth += 1,
                "}" => depth -= 1,
                _ => {}
            }
            depth == 0
        })?;
        Some(Head { start: start.at.start, end: tokens[open].at.start..close.at.end })
    }

    /// The constant that looks like the size of the noise.
    pub fn hash_scale(&self) -> Option<String> {
        let is_it = |name: &str| name.replace('_', "").to_ascii_lowercase().contains("hashscale");
        self.globals.iter().map(|(name, _)| name).find(|name| is_it(name)).cloned()
    }
}

impl Reader<'_> {
    fn word(&self, index: usize) -> &str {
        self.tokens.get(index).filter(|_| index < self.end).map_or("", |at| &self.text[at.clone()])
    }

    fn now(&self) -> &str {
        self.word(self.at)
    }

    fn takes(&mut self, word: &str) -> bool {
        let is_it = self.now() == word;
        self.at += usize::from(is_it);
        is_it
    }

    /// The token behind the bracket that closes the one at `index`.
    fn behind(&self, index: usize) -> usize {
        let mut depth = 0_usize;
        for at in index..self.end {
            match self.word(at) {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => {
                    depth = depth.saturating_sub(1);
                    if depth == 0 {
                        return at + 1;
                    }
                }
                _ => {}
            }
        }
        self.end
    }

    /// A type as it stands at `index`, without spaces, and the token behind it.
    fn type_at(&self, index: usize) -> (String, usize) {
        let mut name = self.word(index).to_owned();
        let mut next = index + 1;
        if self.word(next) == "<" && self.syntax.is_wgsl {
            while next < self.end && self.word(next) != ">" {
                name += self.word(next);
                next += 1;
            }
            name += ">";
            next += 1;
        }
        (name, next)
    }

    /// Heads of functions.
    fn functions(&mut self) {
        let starts: BTreeSet<usize> = self.function.iter().flatten().copied().collect();
        for start in starts {
            let Some(name) = self.tokens.iter().position(|at| at.start == start) else { continue };
            let close = self.behind(name + 1);
            let mut parameters = Vec::new();
            let mut at = name + 2;
            while at < close.saturating_sub(1) {
                let mut words = Vec::new();
                let mut end = at;
                while end < close - 1 && self.word(end) != "," {
                    words.push(end);
                    end += if self.word(end + 1) == "<" { self.type_at(end).1 - end } else { 1 };
                }
                if self.syntax.is_wgsl {
                    let words: Vec<usize> =
                        words.into_iter().filter(|&word| !matches!(self.word(word), "@")).collect();
                    if let Some(colon) = words.iter().position(|&word| self.word(word) == ":")
                        && let (Some(&name), Some(&of)) =
                            (words.get(colon.wrapping_sub(1)), words.get(colon + 1))
                    {
                        parameters.push((self.word(name).to_owned(), self.type_at(of).0));
                    }
                } else if let [.., of, name] = words[..] {
                    parameters.push((self.word(name).to_owned(), self.word(of).to_owned()));
                }
                at = end + 1;
            }
            let returns = if self.syntax.is_wgsl {
                (self.word(close) == "->").then(|| self.type_at(close + 1).0)
            } else {
                name.checked_sub(1).map(|of| self.word(of).to_owned())
            };
            let body = (0..self.tokens.len()).filter(|&at| self.function[at] == Some(start));
            let words = body.map(|at| self.word(at).to_owned()).collect();
            self.syntax.functions.push(Function {
                name: self.word(name).to_owned(),
                parameters,
                returns: returns.and_then(|name| Type::of(&name)),
                locals: Vec::new(),
                words,
            });
        }
        // What stands in a macro is reached by whoever names it.
        let mut macros: HashMap<String, BTreeSet<String>> = HashMap::new();
        let defines = (0..self.end).filter(|&at| self.word(at) == "#" && self.word(at + 1) == "define");
        for at in defines.collect::<Vec<_>>() {
            let end = self.line_end(at);
            let words = (at + 3..end).map(|at| self.word(at).to_owned()).collect();
            macros.insert(self.word(at + 2).to_owned(), words);
        }
        for function in &mut self.syntax.functions {
            for _ in 0..4 {
                let more: Vec<String> =
                    function.words.iter().filter_map(|word| macros.get(word)).flatten().cloned().collect();
                function.words.extend(more);
            }
        }
    }

    /// The token behind the line of a directive.
    fn line_end(&self, index: usize) -> usize {
        let mut end = index + 1;
        while end < self.end {
            let between = &self.text[self.tokens[end - 1].end..self.tokens[end].start];
            let continued =
                between.trim_start_matches([' ', '\t']).starts_with('\\') || self.word(end - 1) == "\\";
            if between.contains('\n') && !continued {
                break;
            }
            end += 1;
        }
        end
    }

    /// Members of structures.
    fn fields(&mut self) {
        let structs: Vec<usize> = (0..self.end).filter(|&at| self.word(at) == "struct").collect();
        for at in structs {
            let Some(open) = (at..self.end).find(|&at| self.word(at) == "{") else { continue };
            for index in open..self.behind(open) {
                if self.syntax.is_wgsl && self.word(index) == ":" {
                    let of = self.type_at(index + 1).0;
                    self.syntax.fields.insert(self.word(index - 1).to_owned(), Type::of(&of));
                } else if !self.syntax.is_wgsl && matches!(self.word(index), ";" | ",") {
                    let of = (open..index).rev().find_map(|at| Type::of(self.word(at)));
                    self.syntax.fields.insert(self.word(index - 1).to_owned(), of);
                }
            }
        }
    }

    fn statements(&mut self) {
        let last = self.end;
        while self.at < last {
            self.end = last;
            let before = self.at;
            self.statement();
            self.at = self.at.max(before + 1);
        }
    }

    fn statement(&mut self) {
        let start = self.at;
        self.inside = self.function[start].and_then(|name| {
            let at = self.tokens.iter().position(|at| at.start == name)?;
            self.syntax
                .functions
                .iter()
                .position(|function| function.name == self.text[self.tokens[at].clone()])
        });
        match self.now() {
            "{" | "}" | ";" | "else" | "do" => self.at += 1,
            "#" => {
                let end = self.line_end(start);
                if self.word(start + 1) == "define" && end > start + 3 {
                    self.macro_body(start, end);
                }
                (self.at, self.end) = (end, self.tokens.len());
            }
            "for" | "while" | "switch" | "struct" | "layout" => {
                let open = if self.now() == "struct" { "{" } else { "(" };
                let found = (start..self.end).find(|&at| self.word(at) == open);
                self.at = found.map_or(start + 1, |open| self.behind(open));
            }
            "if" => {
                self.at += 1;
                if let Some(value) = self.expression() {
                    self.keep(Role::Branches, start, value, Some(Type::BOOL));
                }
            }
            "return" => {
                self.at += 1;
                let of = self.inside.and_then(|function| self.syntax.functions[function].returns);
                if let Some(value) = self.expression() {
                    self.keep(Role::Returns, start, value, of);
                }
                self.takes(";");
            }
            "let" | "var" | "const" | "override" if self.syntax.is_wgsl => self.declares_wgsl(start),
            _ => self.declares_or_assigns(start),
        }
    }

    fn macro_body(&mut self, start: usize, end: usize) {
        let name = self.word(start + 2).to_owned();
        self.end = end;
        self.at = start + 3;
        self.macro_parameters.clear();
        if self.now() == "(" && self.tokens[self.at].start == self.tokens[start + 2].end {
            let close = self.behind(self.at);
            self.macro_parameters = (self.at..close).map(|at| self.word(at).to_owned()).collect();
            self.at = close;
        }
        if let Some(value) = self.expression().filter(|_| self.at == end) {
            if self.macro_parameters.is_empty() {
                self.syntax.globals.push((name, value.of));
            }
            self.keep(Role::Macro, start, value, None);
        }
        self.macro_parameters.clear();
    }

    fn declares_wgsl(&mut self, start: usize) {
        self.at += 1;
        if self.now() == "<" {
            while self.at < self.end && !self.takes(">") {
                self.at += 1;
            }
        }
        let name = self.now().to_owned();
        self.at += 1;
        let mut of = None;
        if self.takes(":") {
            let (written, next) = self.type_at(self.at);
            (of, self.at) = (Type::of(&written), next);
        }
        self.initial(start, name, of);
        self.takes(";");
    }

    /// What may stand behind the name of a new variable, and the variable.
    fn initial(&mut self, start: usize, name: String, of: Option<Type>) {
        let mut of = of;
        if self.takes("=")
            && let Some(value) = self.expression()
        {
            of = of.or(value.of);
            self.keep(Role::Declares(name.clone()), start, value, of);
        }
        match self.inside {
            Some(function) => self.syntax.functions[function].locals.push((name, of)),
            None => self.syntax.globals.push((name, of)),
        }
    }

    fn declares_or_assigns(&mut self, start: usize) {
        const MARKS: [&str; 12] = [
            "const",
            "uniform",
            "in",
            "out",
            "inout",
            "varying",
            "attribute",
            "flat",
            "smooth",
            "highp",
            "mediump",
            "lowp",
        ];
        while MARKS.contains(&self.now()) {
            self.at += 1;
        }
        let is_word = |word: &str| word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
        if is_word(self.now()) && is_word(self.word(self.at + 1)) && !self.syntax.is_wgsl {
            let of = Type::of(self.now());
            self.at += 1;
            loop {
                let name = self.now().to_owned();
                self.at += 1;
                if self.now() == "(" {
                    // A function: its head is known, its body comes next.
                    self.at = self.behind(self.at);
                    return;
                }
                if self.now() == "[" {
                    self.at = self.behind(self.at);
                }
                self.initial(start, name, of);
                if !self.takes(",") {
                    break;
                }
            }
            self.takes(";");
            return;
        }
        if self.now() == "fn" {
            let open = (self.at..self.end).find(|&at| self.word(at) == "(");
            self.at = open.map_or(self.at + 1, |open| self.behind(open));
            while self.at < self.end && self.now() != "{" {
                self.at += 1;
            }
            return;
        }
        let target = self.postfix();
        let is_assignment = self.now() == "=" || self.now().len() > 1 && self.now().ends_with('=');
        if let Some(target) = target
            && is_assignment
        {
            self.at += 1;
            if let Some(value) = self.expression() {
                self.keep(Role::Assigns, start, value, target.of);
            }
        }
        while self.at < self.end && !matches!(self.now(), ";" | "{" | "}") {
            self.at += 1;
        }
        self.takes(";");
    }

    fn keep(&mut self, role: Role, start: usize, value: Expr, of: Option<Type>) {
        let end = if self.now() == ";" { self.tokens[self.at].end } else { self.tokens[self.at - 1].end };
        let before = self.inside.map_or(0, |function| self.syntax.functions[function].locals.len());
        let at = self.tokens[start].start..end;
        self.syntax.statements.push(Statement { role, function: self.inside, at, value, of, before });
    }

    fn expression(&mut self) -> Option<Expr> {
        let condition = self.binary(0)?;
        if !self.takes("?") {
            return Some(condition);
        }
        let first = self.expression()?;
        if !self.takes(":") {
            return None;
        }
        let second = self.expression()?;
        let (at, of) = (condition.at.start..second.at.end, first.of.or(second.of));
        Some(Expr { at, kind: Kind::Choice(Box::new([condition, first, second])), of })
    }

    fn binary(&mut self, least: usize) -> Option<Expr> {
        const LEVELS: [&[&str]; 10] = [
            &["||"],
            &["&&"],
            &["|"],
            &["^"],
            &["&"],
            &["==", "!="],
            &["<", ">", "<=", ">="],
            &["<<", ">>"],
            &["+", "-"],
            &["*", "/", "%"],
        ];
        if least == LEVELS.len() {
            return self.unary();
        }
        let mut left = self.binary(least + 1)?;
        while LEVELS[least].contains(&self.now()) {
            let (operator, sign) = (self.now().to_owned(), self.tokens[self.at].clone());
            self.at += 1;
            let right = self.binary(least + 1)?;
            let of = match (operator.as_str(), left.of, right.of) {
                ("<" | ">" | "<=" | ">=" | "==" | "!=" | "&&" | "||", ..) => Some(Type::BOOL),
                ("<<" | ">>", of, _) => of,
                (_, Some(left), Some(right)) => Some(if right.size > left.size { right } else { left }),
                (_, Some(left), None) if left.size > 1 => Some(left),
                (_, None, Some(right)) if right.size > 1 => Some(right),
                _ => None,
            };
            let at = left.at.start..right.at.end;
            left = Expr { at, kind: Kind::Binary(operator, sign, Box::new([left, right])), of };
        }
        Some(left)
    }

    fn unary(&mut self) -> Option<Expr> {
        if matches!(self.now(), "-" | "+" | "!" | "~" | "&" | "*" | "++") {
            let start = self.tokens[self.at].start;
            self.at += 1;
            let of = self.unary()?;
            return Some(Expr { at: start..of.at.end, of: of.of, kind: Kind::Unary(Box::new(of)) });
        }
        self.postfix()
    }

    fn postfix(&mut self) -> Option<Expr> {
        let mut base = self.primary()?;
        loop {
            if self.takes(".") {
                let (field, at) = (self.now().to_owned(), self.tokens.get(self.at)?.clone());
                self.at += 1;
                let is_swizzle = field.bytes().all(|c| b"xyzwrgbastpq".contains(&c)) && field.len() <= 4;
                let of = match base.of {
                    Some(of) if is_swizzle => Some(Type { size: field.len() as u8, ..of }),
                    _ => self.syntax.fields.get(&field).copied().flatten(),
                };
                base = Expr { at: base.at.start..at.end, kind: Kind::Member(Box::new(base)), of };
            } else if self.takes("[") {
                let index = self.expression()?;
                let end = self.tokens.get(self.at)?.end;
                if !self.takes("]") {
                    return None;
                }
                let of = base.of.map(Type::element);
                base =
                    Expr { at: base.at.start..end, of, kind: Kind::Index(Box::new(base), Box::new(index)) };
            } else {
                return Some(base);
            }
        }
    }

    fn primary(&mut self) -> Option<Expr> {
        let at = self.tokens.get(self.at).filter(|_| self.at < self.end)?.clone();
        let word = self.text[at.clone()].to_owned();
        let first = word.chars().next()?;
        if first == '(' {
            self.at += 1;
            let inner = self.expression()?;
            let end = self.tokens.get(self.at)?.end;
            if !self.takes(")") {
                return None;
            }
            return Some(Expr { at: at.start..end, of: inner.of, kind: Kind::Parens(Box::new(inner)) });
        }
        if first.is_ascii_digit() || first == '.' && word.len() > 1 {
            self.at += 1;
            let is_hexadecimal = word.starts_with("0x") || word.starts_with("0X");
            let of = if word.ends_with(['u', 'U']) {
                Type::UINT
            } else if !is_hexadecimal && word.contains(['.', 'e', 'f']) {
                Type::FLOAT
            } else {
                Type { scalar: Scalar::Int, size: 1 }
            };
            return Some(Expr { at, kind: Kind::Number, of: Some(of) });
        }
        if !(first.is_ascii_alphabetic() || first == '_') {
            return None;
        }
        let (name, next) = match self.type_at(self.at) {
            // A comparison and not a type with a part.
            (name, _) if name.contains('<') && !is_generic(&word) => (word.clone(), self.at + 1),
            other => other,
        };
        self.at = next;
        if self.now() != "(" {
            let of = self.known(&word);
            return Some(Expr { at, kind: Kind::Name(word), of });
        }
        self.at += 1;
        let mut parts = Vec::new();
        while self.now() != ")" {
            parts.push(self.expression()?);
            if !self.takes(",") && self.now() != ")" {
                return None;
            }
        }
        let end = self.tokens[self.at].end;
        self.at += 1;
        let of = self.returned(&name, &parts);
        let called = at.start..self.tokens[next - 1].end;
        Some(Expr { at: at.start..end, kind: Kind::Call(name, called, parts), of })
    }

    /// The type of a name that is read.
    fn known(&self, name: &str) -> Option<Type> {
        let function = self.inside.map(|function| &self.syntax.functions[function]);
        let local = function.and_then(|f| f.locals.iter().rev().find(|(local, _)| local == name));
        if let Some((_, of)) = local {
            return *of;
        }
        let parameter = function.and_then(|f| f.parameters.iter().find(|(parameter, _)| parameter == name));
        if let Some((_, of)) = parameter {
            return Type::of(of);
        }
        self.syntax.globals.iter().find(|(global, _)| global == name).and_then(|(_, of)| *of)
    }

    /// The type of a call.
    fn returned(&self, name: &str, parts: &[Expr]) -> Option<Type> {
        if let Some(function) = self.syntax.functions.iter().find(|function| function.name == name) {
            return function.returns;
        }
        let first = parts.first().and_then(|part| part.of);
        let widest = || {
            let known = parts.iter().filter_map(|part| part.of);
            known.max_by_key(|of| of.size)
        };
        match name {
            "length" | "dot" | "distance" => Some(Type::FLOAT),
            "uintBitsToFloat" | "intBitsToFloat" => first.map(|of| Type { scalar: Scalar::Float, ..of }),
            "floatBitsToUint" => first.map(|of| Type { scalar: Scalar::UInt, ..of }),
            "floatBitsToInt" => first.map(|of| Type { scalar: Scalar::Int, ..of }),
            "vec2" | "vec3" | "vec4" if self.syntax.is_wgsl => {
                first.map(|of| Type { size: name.as_bytes()[3] - b'0', ..of })
            }
            "mix" | "clamp" | "step" | "smoothstep" | "min" | "max" | "pow" | "select" | "mod" => widest(),
            _ if name.starts_with("bitcast<") => {
                Type::of(name.trim_start_matches("bitcast<").trim_end_matches('>')).or(first)
            }
            _ => Type::of(name).or_else(|| parts.first().and_then(|part| part.of)),
        }
    }
}

/// Whether a word of WGSL may have types behind it in angle brackets.
fn is_generic(word: &str) -> bool {
    matches!(word, "vec2" | "vec3" | "vec4" | "bitcast" | "array" | "ptr") || word.starts_with("mat")
}
