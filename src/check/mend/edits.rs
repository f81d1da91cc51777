//! Small changes of a text that may mend it: what ports by hand get wrong, turned round.

use super::change::{Change, Edit};
use super::syntax::{Expr, Function, Kind, Role, Scalar, Statement, Syntax, Type};
use crate::threshold::two_scale::Variant;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Functions that are taken for each other.
const NAMESAKES: [&[&str]; 7] = [
    &["min", "max"],
    &["floor", "ceil", "round", "trunc", "roundEven", "fract"],
    &["log2", "log", "log10"],
    &["exp2", "exp"],
    &["dFdx", "dFdy", "fwidth"],
    &["dpdx", "dpdy", "fwidth"],
    &["length", "abs", "sqrt"],
];

/// Operators that are taken for each other.
const OPERATORS: [&[&str]; 5] =
    [&["+", "-", "*", "/"], &["<", ">", "<=", ">="], &["&", "|", "^"], &["^", "+"], &["<<", ">>"]];

/// Numbers of the listings, as they are written.
const FLOATS: [&str; 6] = ["0.0", "0.5", "1.0", "2.0", "0.707", "1.0e-6"];

/// Those of hashes.
const OF_HASHES: [&str; 5] = ["1.0e4", "16777216.0", "4294967296.0", "17.0", "13.0"];

/// Whole numbers of octaves and cells.
const INTS: [&str; 3] = ["0", "1", "2"];
/// Those of shifts and masks.
const UINTS: [&str; 5] = ["0u", "1u", "8u", "16u", "0xffffffffu"];

/// Statements at the end of a function in which Eq. 2 may stand.
const LAST: usize = 3;

/// How the paper's hash begins.
pub(super) const SINE: &str = "fract(1.0e4 * sin(17.0 * ";

/// The paper's hash of two numbers.
fn sine_hash(x: &str, y: &str) -> String {
    format!("{SINE}{x} + 0.1 * {y}) * (0.1 + abs(sin(13.0 * {y} + {x}))))")
}

/// A text on trial, and what its names mean.
pub(super) struct Sheet<'t> {
    pub text: &'t str,
    pub syntax: &'t Syntax,
    /// Name of the function on trial.
    pub function: &'t str,
    pub variant: Variant,
    /// What it calls the position, its derivatives along x and y, and the size of the noise.
    pub position: Option<String>,
    pub derivatives: Option<[String; 2]>,
    pub hash_scale: Option<String>,
    /// Whether the function reads a size of the noise, under whatever name.
    pub has_hash_scale: bool,
    /// The steps in which something is wrong.
    pub wrong: Steps,
}

/// Steps of a threshold.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Steps {
    /// From derivatives to the logarithm of a scale.
    pub scale: bool,
    /// From a place to a number, by its cell.
    pub hash: bool,
    /// From two numbers to the threshold.
    pub join: bool,
}

impl Steps {
    /// All of them.
    pub const ALL: Self = Self { scale: true, hash: true, join: true };
}

/// What can stand at a place.
struct Scope {
    /// Names and members by type, in the order of their declaration.
    atoms: HashMap<Type, Vec<String>>,
    names: Vec<(String, Option<Type>)>,
    /// Expressions of the two derivatives.
    derivatives: Option<[String; 2]>,
    /// Names of logarithms.
    logs: Vec<String>,
    /// Numbers that are taken from 1, or are the fraction of something: weights and the smaller one of two.
    weights: Vec<String>,
    /// Numbers that are neither and come behind the logarithm: hashes and what is made of them.
    values: Vec<String>,
}

impl Scope {
    fn of(&self, of: Type) -> &[String] {
        self.atoms.get(&of).map_or(&[], Vec::as_slice)
    }

    /// Numbers that are no coordinates.
    fn numbers(&self) -> Vec<String> {
        let is_coordinate = |number: &str| {
            number.split_once('.').is_some_and(|(base, _)| {
                let of = self.names.iter().find(|(name, _)| name == base).and_then(|(_, of)| *of);
                of.is_some_and(|of| of.size > 2)
            })
        };
        self.of(Type::FLOAT).iter().filter(|number| !is_coordinate(number)).cloned().collect()
    }
}

/// Changes of a text, the same text once.
struct Changes<'t> {
    text: &'t str,
    all: Vec<Change>,
    seen: BTreeSet<Vec<(usize, usize, String)>>,
}

impl Changes<'_> {
    fn push(&mut self, edits: Vec<Edit>) {
        let Some(change) = Change::new(self.text, edits) else { return };
        let key = change.edits.iter().map(|edit| (edit.at.start, edit.at.end, edit.with.clone())).collect();
        if self.seen.insert(key) {
            self.all.push(change);
        }
    }
}

/// Returns small changes of a text: one place each, or one thing at all places of a function.
pub(super) fn changes(sheet: &Sheet<'_>) -> Vec<Change> {
    let reached = sheet.syntax.reached(sheet.function);
    let mut all = Changes { text: sheet.text, all: Vec::new(), seen: BTreeSet::new() };
    let is_wrong = |function: usize| {
        let is_hash =
            sheet.syntax.is_hash(function) && sheet.syntax.functions[function].name != sheet.function;
        reached.contains(&function) && (if is_hash { sheet.wrong.hash } else { true })
    };
    let is_reached = |statement: &&Statement| statement.function.is_none_or(is_wrong);
    let [scale, join] = sheet.topics();
    let is_topic = |statement: &&Statement| {
        let at = statement.at.start;
        sheet.wrong.hash
            || statement.role == Role::Macro
            || statement.function.is_none()
            || sheet.wrong.scale && scale.contains(&at)
            || sheet.wrong.join && join.contains(&at)
    };
    for statement in sheet.syntax.statements.iter().filter(is_reached).filter(is_topic) {
        let scope = sheet.scope(statement);
        let mut places = Vec::new();
        places_of(&statement.value, true, &mut places);
        for (place, (expr, is_free)) in places.iter().enumerate() {
            let is_value = place == 0;
            let replacements = sheet.replacements(statement, &scope, expr, *is_free, is_value);
            let same = sheet.same(statement, expr);
            for with in replacements {
                let edit = |at: &Expr| Edit { at: at.at.clone(), with: with.clone() };
                if same.len() > 1 && !with.contains('\n') {
                    all.push(same.iter().map(|expr| edit(expr)).collect());
                }
                all.push(vec![edit(expr)]);
            }
        }
        sheet.compared(statement, &scope, &mut all);
        if statement.role == Role::Assigns {
            all.push(vec![Edit { at: whole_lines(sheet.text, statement.at.clone()), with: String::new() }]);
        }
        sheet.lines(statement, &scope, &mut all);
    }
    all.all
}

/// The same with the root of one half as the listing rounds it, 0.707; nothing where it is so.
pub(super) fn with_listed_root(syntax: &Syntax, text: &str) -> Option<Change> {
    let numbers = syntax.statements.iter().flat_map(|statement| statement.value.all());
    let is_root = |expr: &&Expr| {
        let written = text[expr.at.clone()].trim_end_matches(['f', 'F']);
        matches!(expr.kind, Kind::Number)
            && written.parse().is_ok_and(|x: f64| (0.7065..0.7075).contains(&x) && x != 0.707)
    };
    let edit = |expr: &Expr| Edit { at: expr.at.clone(), with: "0.707".to_owned() };
    Change::new(text, numbers.filter(is_root).map(edit).collect())
}

/// Expressions, and whether what stands in their place needs no brackets.
fn places_of<'e>(expr: &'e Expr, is_free: bool, all: &mut Vec<(&'e Expr, bool)>) {
    all.push((expr, is_free));
    let frees = matches!(expr.kind, Kind::Call(..) | Kind::Parens(_) | Kind::Index(..));
    for part in expr.parts() {
        places_of(part, frees, all);
    }
}

/// The lines in which a statement stands, where nothing else does.
fn whole_lines(text: &str, at: core::ops::Range<usize>) -> core::ops::Range<usize> {
    let start = text[..at.start].rfind('\n').map_or(0, |newline| newline + 1);
    let end = text[at.end..].find('\n').map_or(text.len(), |newline| at.end + newline + 1);
    let is_alone = text[start..at.start].trim().is_empty()
        && (text[at.end..end].trim().is_empty() || text[at.end..end].trim().starts_with("//"));
    if is_alone { start..end } else { at }
}

impl Sheet<'_> {
    /// Where the statements begin that come before the last logarithm of a function, and those that come behind the first; the
    /// logarithms belong to both, and so does all of a function without any.
    fn topics(&self) -> [BTreeSet<usize>; 2] {
        let mut topics = [BTreeSet::new(), BTreeSet::new()];
        for function in 0..self.syntax.functions.len() {
            let own = self.syntax.statements.iter().filter(|statement| statement.function == Some(function));
            let own: Vec<&Statement> = own.collect();
            let is_log = |statement: &&Statement| {
                statement
                    .value
                    .all()
                    .iter()
                    .any(|expr| matches!(&expr.kind, Kind::Call(name, ..) if name.starts_with("log")))
            };
            let first = own.iter().position(is_log).unwrap_or(0);
            let last = own.iter().rposition(is_log).unwrap_or(own.len().saturating_sub(1));
            topics[0].extend(own.iter().take(last + 1).map(|statement| statement.at.start));
            topics[1].extend(own.iter().skip(first).map(|statement| statement.at.start));
        }
        topics
    }

    fn written(&self, expr: &Expr) -> &str {
        &self.text[expr.at.clone()]
    }

    /// All places of a function with the same words.
    fn same<'s>(&'s self, statement: &Statement, expr: &Expr) -> Vec<&'s Expr> {
        let words = self.written(expr);
        if statement.function.is_none() || matches!(expr.kind, Kind::Number) {
            return Vec::new();
        }
        let of_function = self.syntax.statements.iter().filter(|other| other.function == statement.function);
        of_function.flat_map(|other| other.value.all()).filter(|other| self.written(other) == words).collect()
    }

    fn scope(&self, statement: &Statement) -> Scope {
        let names = self.syntax.scope(statement);
        let mut atoms: HashMap<Type, Vec<String>> = HashMap::new();
        let mut add = |of: Type, name: String| {
            let list = atoms.entry(of).or_default();
            if !list.contains(&name) {
                list.push(name);
            }
        };
        for (name, of) in &names {
            let Some(of) = *of else { continue };
            add(of, name.clone());
            if of.size > 1 && of.scalar != Scalar::Bool {
                let members = ["x", "y", "z", "w"].into_iter().take(usize::from(of.size));
                members.for_each(|member| add(Type { size: 1, ..of }, format!("{name}.{member}")));
            }
        }
        // Members of structures, as they are written elsewhere in the function.
        let of_function = self.syntax.statements.iter().filter(|other| other.function == statement.function);
        for expr in of_function.flat_map(|other| other.value.all()) {
            if let (Kind::Member(base), Some(of)) = (&expr.kind, expr.of)
                && let Kind::Name(base) = &base.kind
                && names.iter().any(|(name, of)| name == base && of.is_none())
            {
                add(of, self.written(expr).to_owned());
            }
        }
        let function = statement.function.map(|function| &self.syntax.functions[function]);
        let derivatives = function.and_then(|function| self.derivatives_in(function, &names));
        let mut scope =
            Scope { atoms, names, derivatives, logs: Vec::new(), weights: Vec::new(), values: Vec::new() };
        self.sort(statement, &mut scope);
        scope
    }

    /// Tells logarithms, weights and values of a function apart.
    fn sort(&self, statement: &Statement, scope: &mut Scope) {
        let of_function = self.syntax.statements.iter().filter(|other| other.function == statement.function);
        let of_function: Vec<&Statement> = of_function.collect();
        let calls = |statement: &Statement, names: &[&str]| {
            let is_one =
                |expr: &&Expr| matches!(&expr.kind, Kind::Call(name, ..) if names.contains(&name.as_str()));
            statement.value.all().iter().any(is_one)
        };
        let declares = |name: &str, calls: &dyn Fn(&Statement) -> bool| {
            of_function
                .iter()
                .any(|other| matches!(&other.role, Role::Declares(own) if own == name) && calls(other))
        };
        let is_log = |name: &str| {
            declares(name, &|other| {
                calls(other, &["log2", "log"]) && !calls(other, &["floor", "fract", "exp2", "ceil"])
            })
        };
        let of_logs = if self.variant == Variant::Anisotropic { Type::VEC3 } else { Type::FLOAT };
        let plain: Vec<String> =
            scope.of(of_logs).iter().filter(|name| !name.contains('.')).cloned().collect();
        scope.logs = plain.iter().filter(|name| is_log(name)).cloned().collect();
        if scope.logs.is_empty() {
            let parameters = statement.function.map(|function| &self.syntax.functions[function].parameters);
            let is_parameter =
                |name: &String| parameters.is_some_and(|all| all.iter().any(|(other, _)| other == name));
            scope.logs = plain.into_iter().filter(|name| is_parameter(name)).collect();
        }
        let mut from_one = BTreeSet::new();
        for expr in of_function.iter().flat_map(|other| other.value.all()) {
            match &expr.kind {
                Kind::Binary(operator, _, parts)
                    if operator == "-" && matches!(parts[0].kind, Kind::Number) =>
                {
                    from_one.insert(self.written(&parts[1]));
                }
                Kind::Call(name, _, parts) if name == "mix" && parts.len() == 3 => {
                    from_one.insert(self.written(&parts[2]));
                }
                _ => {}
            }
        }
        let is_fraction = |name: &str| {
            declares(name, &|other| {
                let is_rest = other
                    .value
                    .all()
                    .iter()
                    .any(|expr| matches!(&expr.kind, Kind::Binary(sign, ..) if sign == "-"));
                calls(other, &["fract", "min"])
                    || is_rest && calls(other, &["floor"])
                    || calls(other, &["length"])
            })
        };
        let [early, _] = self.topics();
        let is_early = |name: &str| {
            of_function.iter().any(|other| {
                matches!(&other.role, Role::Declares(own) if own == name) && early.contains(&other.at.start)
            })
        };
        let is_global = |name: &str| self.syntax.globals.iter().any(|(other, _)| other == name);
        let numbers = scope.numbers();
        let has_log = of_function.iter().any(|other| calls(other, &["log2", "log"]));
        for number in numbers {
            let is_weight = from_one.contains(number.as_str()) || is_fraction(&number);
            let is_early = has_log && is_early(&number) || is_global(&number) || scope.logs.contains(&number);
            if is_weight {
                scope.weights.push(number.clone());
            }
            if !is_early && !is_fraction(&number) {
                scope.values.push(number);
            }
        }
    }

    /// Expressions of the derivatives of the position in the function on trial.
    pub fn derivatives_of_function(&self) -> Option<[String; 2]> {
        let function = self.syntax.functions.iter().find(|function| function.name == self.function)?;
        self.derivatives_in(function, &self.syntax.globals)
    }

    /// Expressions of the derivatives of the position in a function.
    fn derivatives_in(&self, function: &Function, names: &[(String, Option<Type>)]) -> Option<[String; 2]> {
        let is_main = function.name == self.function;
        if let Some(derivatives) = self.derivatives.as_ref().filter(|_| is_main) {
            return Some(derivatives.clone());
        }
        let calls = if self.syntax.is_wgsl { ["dpdx", "dpdy"] } else { ["dFdx", "dFdy"] };
        let has = |name: &String| names.iter().any(|(other, _)| other == name);
        let its_own = function.parameters.iter().find(|(_, of)| of.contains("vec3")).map(|(name, _)| name);
        let position = self.position.as_ref().filter(|name| has(name)).or(its_own)?;
        Some(calls.map(|call| format!("{call}({position})")))
    }

    /// What may stand in the place of an expression.
    fn replacements(
        &self,
        statement: &Statement,
        scope: &Scope,
        expr: &Expr,
        is_free: bool,
        is_value: bool,
    ) -> Vec<String> {
        let mut all = Vec::new();
        let words = self.written(expr).to_owned();
        let closed = |text: String| if is_free { text } else { format!("({text})") };
        let is_sum = |expr: &Expr| matches!(expr.kind, Kind::Binary(..) | Kind::Choice(_) | Kind::Unary(_));
        let operand = |expr: &Expr| {
            let written = self.written(expr).to_owned();
            if is_sum(expr) { format!("({written})") } else { written }
        };
        // One of its parts.
        for part in expr.all().into_iter().skip(1) {
            let is_base = matches!(&expr.kind, Kind::Member(base) if base.at == part.at);
            if is_base || part.of == expr.of || part.of.is_none() || expr.of.is_none() {
                let written = self.written(part).to_owned();
                all.push(if is_sum(part) { closed(written) } else { written });
            }
        }
        match &expr.kind {
            Kind::Call(name, at, parts) => {
                let rest = &self.text[at.end..expr.at.end];
                for names in NAMESAKES.iter().filter(|names| names.contains(&name.as_str())) {
                    all.extend(
                        names.iter().filter(|other| *other != name).map(|other| format!("{other}{rest}")),
                    );
                }
                let is_symmetric = matches!(name.as_str(), "min" | "max" | "dot" | "cross");
                for first in (0..parts.len()).filter(|_| !is_symmetric) {
                    for second in first + 1..parts.len() {
                        all.push(self.exchanged(expr, &parts[first], &parts[second]));
                    }
                }
                if name.starts_with("dFd") || name.starts_with("dpd") || name == "fwidth" {
                    all.extend(parts.iter().filter_map(|part| match &part.kind {
                        Kind::Member(base) => Some(format!("{}({})", name, self.written(base))),
                        _ => None,
                    }));
                }
            }
            Kind::Binary(operator, sign, parts) => {
                let [left, right] = &**parts;
                if !matches!(operator.as_str(), "+" | "*" | "^" | "&" | "|" | "==" | "!=") {
                    all.push(self.exchanged(expr, left, right));
                }
                for operators in OPERATORS.iter().filter(|operators| operators.contains(&operator.as_str())) {
                    for other in operators.iter().filter(|other| *other != operator) {
                        let (before, after) =
                            (&self.text[expr.at.start..sign.start], &self.text[sign.end..expr.at.end]);
                        all.push(format!("{before}{other}{after}"));
                    }
                }
            }
            Kind::Choice(parts) => all.push(self.exchanged(expr, &parts[1], &parts[2])),
            Kind::Number => {
                let same: &[&str] = match expr.of.map(|of| of.scalar) {
                    Some(Scalar::Float) => &FLOATS,
                    Some(Scalar::UInt) => &UINTS,
                    _ => &INTS,
                };
                let of_hashes: &[&str] =
                    if self.wrong.hash && expr.of == Some(Type::FLOAT) { &OF_HASHES } else { &[] };
                all.extend(same.iter().chain(of_hashes).map(|number| (*number).to_owned()));
            }
            Kind::Name(_) | Kind::Member(..) | Kind::Index(..) | Kind::Parens(_) | Kind::Unary(_) => {}
        }
        let Some(of) = expr.of else { return all };
        let is_name = matches!(expr.kind, Kind::Name(_) | Kind::Member(..) | Kind::Index(..));
        if is_name || is_free && !matches!(expr.kind, Kind::Number) {
            let is_cell = self.wrong.hash || of != Type::FLOAT;
            all.extend(if is_cell { scope.of(of).to_vec() } else { scope.numbers() });
            let none: &[&str] = match of {
                Type { scalar: Scalar::Float, size: 1 } => &["0.0", "1.0", "0.5", "1.0e-6"],
                Type { scalar: Scalar::UInt, size: 1 } => &["0u"],
                _ => &[],
            };
            all.extend(none.iter().map(|number| (*number).to_owned()));
        }
        if of.scalar == Scalar::Int && of.size == 1 {
            all.push(closed(format!("{words} + 1")));
        }
        if of.scalar == Scalar::Float {
            let inner = operand(expr);
            if is_free && !matches!(expr.kind, Kind::Number) {
                let calls = ["floor", "fract", "abs", "sqrt", "log2", "exp2"];
                all.extend(calls.map(|call| format!("{call}({words})")));
                let around = [
                    ("1.0 - ", ""),
                    ("1.0 / ", ""),
                    ("2.0 * ", ""),
                    ("0.5 * ", ""),
                    ("", " + 1.0"),
                    ("-", ""),
                ];
                all.extend(around.map(|(before, after)| format!("{before}{inner}{after}")));
                if of.size > 1 {
                    all.push(format!("0.707 * {inner}"));
                }
                if let Some(size) = &self.hash_scale {
                    all.push(format!("{size} * {inner}"));
                }
            } else if is_name {
                all.push(format!("(1.0 - {inner})"));
            }
            if let Kind::Binary(operator, _, parts) = &expr.kind
                && of == Type::FLOAT
                && self.wrong.join
            {
                let [left, right] = &**parts;
                let [left, right] = [self.written(left), self.written(right)];
                if operator == "*" && left == right {
                    all.push(closed(format!("(1.0 - {left}) * (1.0 - {left})")));
                }
                if operator == "/" {
                    let shifted = scope
                        .numbers()
                        .into_iter()
                        .map(|a| closed(format!("({left} - 0.5 * {a}) / {right}")));
                    all.extend(shifted);
                }
            }
        }
        if is_free && of.scalar == Scalar::Float {
            self.templates(scope, expr, of, is_value, &mut |text| all.push(text));
        }
        if is_value && of.size == 1 && matches!(of.scalar, Scalar::UInt | Scalar::Int) {
            let to = if self.syntax.is_wgsl { "u32" } else { "uint" };
            let words = [Scalar::UInt, Scalar::Int].into_iter().flat_map(|scalar| {
                let axes = scope.of(Type { scalar, size: 3 });
                axes.iter().map(move |c| {
                    let [x, y, z] = ["x", "y", "z"].map(|axis| match scalar {
                        Scalar::UInt => format!("{c}.{axis}"),
                        _ => format!("{to}({c}.{axis})"),
                    });
                    format!("({x} * 0x9e3779b9u) ^ ({y} * 0x85ebca6bu) ^ ({z} * 0xc2b2ae35u)")
                })
            });
            all.extend(words);
        }
        if is_value && of == Type::FLOAT && statement.role == Role::Returns {
            let to = if self.syntax.is_wgsl { "f32" } else { "float" };
            all.extend(scope.of(Type::UINT).iter().map(|bits| format!("{to}({bits} >> 8u) / 16777216.0")));
            for part in expr.all().into_iter().filter(|part| part.of == Some(Type::UINT)) {
                all.push(format!("{to}({} >> 8u) / 16777216.0", operand(part)));
            }
        }
        all
    }

    /// Another name wherever a function compares one: the cases of Eq. 2 chosen by the wrong number.
    fn compared(&self, statement: &Statement, scope: &Scope, all: &mut Changes<'_>) {
        let of_function = self.syntax.statements.iter().filter(|other| other.function == statement.function);
        let mut places: BTreeMap<&str, Vec<&Expr>> = BTreeMap::new();
        for expr in of_function.flat_map(|other| other.value.all()) {
            if let Kind::Binary(operator, _, parts) = &expr.kind
                && operator.starts_with(['<', '>'])
            {
                let names = parts.iter().filter(|part| matches!(part.kind, Kind::Name(_) | Kind::Member(_)));
                names.for_each(|name| places.entry(self.written(name)).or_default().push(name));
            }
        }
        let is_first = |names: &Vec<&Expr>| statement.at.contains(&names[0].at.start);
        for names in places.values().filter(|names| names.len() > 1 && is_first(names)) {
            for other in scope.numbers() {
                let edit = |name: &&Expr| Edit { at: name.at.clone(), with: other.clone() };
                all.push(names.iter().map(edit).collect());
            }
        }
    }

    /// An expression with two of its parts in each other's place.
    fn exchanged(&self, expr: &Expr, first: &Expr, second: &Expr) -> String {
        let [before, between, after] =
            [expr.at.start..first.at.start, first.at.end..second.at.start, second.at.end..expr.at.end]
                .map(|at| &self.text[at]);
        let closed = |part: &Expr| {
            let is_whole = matches!(expr.kind, Kind::Call(..) | Kind::Choice(_));
            let is_sum = matches!(part.kind, Kind::Binary(..) | Kind::Choice(_));
            let written = self.written(part);
            if is_sum && !is_whole { format!("({written})") } else { written.to_owned() }
        };
        [before, &closed(second), between, &closed(first), after].concat()
    }

    /// Whole steps of a listing, in the names of the text.
    fn templates(&self, scope: &Scope, expr: &Expr, of: Type, is_value: bool, push: &mut dyn FnMut(String)) {
        let is_anisotropic = self.variant == Variant::Anisotropic;
        let logs = if is_anisotropic { Type::VEC3 } else { Type::FLOAT };
        if of == logs && (self.wrong.scale || self.wrong.join) {
            if self.wrong.scale
                && let Some([x, y]) = &scope.derivatives
            {
                let call = if is_anisotropic { "abs" } else { "length" };
                let size = format!("max({call}({x}), {call}({y}))");
                let numerator = if is_anisotropic { "0.707" } else { "1.0" };
                push(size.clone());
                push(format!("{numerator} / {size}"));
                if let Some(scale) = &self.hash_scale {
                    push(format!("{scale} * {size}"));
                    push(format!("{numerator} / ({scale} * {size})"));
                }
            }
            for l in &scope.logs {
                for text in [
                    "exp2(floor(#))",
                    "exp2(ceil(#))",
                    "floor(#)",
                    "ceil(#)",
                    "floor(#) + 1.0",
                    "# - floor(#)",
                    "fract(#)",
                ] {
                    push(text.replace('#', l));
                }
            }
        }
        if of != Type::FLOAT {
            return;
        }
        if !self.wrong.join {
            return;
        }
        let weights = &scope.weights;
        let fractions = scope.logs.iter().filter(|_| !is_anisotropic).map(|l| format!("fract({l})"));
        let weights = &weights.iter().cloned().chain(fractions).collect::<Vec<_>>();
        if is_anisotropic {
            for v in scope.of(Type::VEC3) {
                for loc in [v.clone(), format!("fract({v})")] {
                    push(format!("length({loc}) / (length({loc}) + length(1.0 - {loc}))"));
                }
            }
        }
        // Two numbers that are joined in another way.
        for part in expr.all() {
            let pair = match &part.kind {
                Kind::Binary(_, _, parts) => Some([&parts[0], &parts[1]]),
                Kind::Call(_, _, parts) if parts.len() >= 2 => Some([&parts[0], &parts[1]]),
                _ => None,
            };
            let is_value = |part: &&Expr| {
                let is_one =
                    matches!(part.kind, Kind::Name(_) | Kind::Member(..) | Kind::Call(..) | Kind::Index(..));
                part.of == Some(Type::FLOAT)
                    && is_one
                    && !scope.weights.iter().any(|w| w == self.written(part))
            };
            let Some(pair) = pair.filter(|pair| pair.iter().all(is_value)) else { continue };
            let [a, b] = pair.map(|part| self.written(part));
            for w in weights {
                push(format!("mix({a}, {b}, {w})"));
                push(format!("mix({b}, {a}, {w})"));
            }
        }
        if !is_value {
            return;
        }
        for pair in neighbours(scope) {
            let [a, b] = pair;
            for w in weights {
                push(format!("mix({a}, {b}, {w})"));
            }
        }
    }

    /// Changes of whole statements: Eq. 2, the last clamp, and hashes.
    fn lines(&self, statement: &Statement, scope: &Scope, all: &mut Changes<'_>) {
        let Some(function) = statement.function.map(|function| &self.syntax.functions[function]) else {
            return;
        };
        if statement.of != Some(Type::FLOAT) || statement.role == Role::Macro {
            return;
        }
        let value = &statement.value;
        let one = |at: &Expr, with: String| vec![Edit { at: at.at.clone(), with }];
        let is_main = function.name == self.function;
        // The places of Eq. 2: a value, or what is clamped, at the end of a function.
        let behind = self.syntax.statements.iter().filter(|other| {
            other.function == statement.function
                && other.of == Some(Type::FLOAT)
                && other.at.start > statement.at.start
        });
        let is_last = behind.count() < LAST;
        let clamped = match &value.kind {
            Kind::Call(name, _, parts) if name == "clamp" && !parts.is_empty() => Some(&parts[0]),
            _ => None,
        };
        for place in clamped.into_iter().chain([value]).filter(|_| self.wrong.join && is_last) {
            for x in &scope.values {
                for a in scope.weights.iter().filter(|a| *a != x) {
                    all.push(one(place, self.cases(x, a)));
                }
            }
        }
        let fresh = |wish: &str| {
            let is_known = |name: &str| {
                self.text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).any(|word| word == name)
            };
            let mut name = wish.to_owned();
            while is_known(&name) {
                name += "_of";
            }
            name
        };
        let declared = |name: &str, value: &str| {
            if self.syntax.is_wgsl {
                format!("let {name} = {value};")
            } else {
                format!("float {name} = {value};")
            }
        };
        let line = self.text[..statement.at.start].rfind('\n').map_or(0, |newline| newline + 1);
        let indent = &self.text[line..statement.at.start];
        if indent.trim().is_empty() && is_main && is_last && self.wrong.join {
            let x_name = fresh("blended");
            let a_name = fresh("minor");
            let mut weights = scope.weights.clone();
            if self.variant != Variant::Anisotropic {
                weights.extend(scope.logs.iter().map(|l| format!("fract({l})")));
            }
            for place in clamped.into_iter().chain([value]) {
                for w in &weights {
                    let minor = declared(&a_name, &format!("min({w}, 1.0 - {w})"));
                    for x in scope.values.iter().filter(|x| *x != w) {
                        all.push(vec![
                            Edit {
                                at: statement.at.start..statement.at.start,
                                with: format!("{minor}\n{indent}"),
                            },
                            Edit { at: place.at.clone(), with: self.cases(x, &a_name) },
                        ]);
                    }
                    for [first, second] in neighbours(scope) {
                        let x = declared(&x_name, &format!("mix({first}, {second}, {w})"));
                        let before = format!("{x}\n{indent}{minor}\n{indent}");
                        all.push(vec![
                            Edit { at: statement.at.start..statement.at.start, with: before },
                            Edit { at: place.at.clone(), with: self.cases(&x_name, &a_name) },
                        ]);
                    }
                }
            }
        }
        if is_main {
            for x in &scope.values {
                all.push(one(value, format!("clamp({x}, 1.0e-6, 1.0)")));
            }
            return;
        }
        if statement.role != Role::Returns || !self.wrong.hash {
            return;
        }
        // A hash: of two numbers, of a vector by one of two, or of a vector.
        let parameters: Vec<(&str, Option<Type>)> =
            function.parameters.iter().map(|(name, _)| (name.as_str(), self.type_of(scope, name))).collect();
        let vec2 = Type { scalar: Scalar::Float, size: 2 };
        for p in scope.of(vec2) {
            all.push(one(value, sine_hash(&format!("{p}.x"), &format!("{p}.y"))));
        }
        if let [(x, Some(Type::FLOAT)), (y, Some(Type::FLOAT))] = parameters[..] {
            all.push(one(value, sine_hash(x, y)));
        }
        let others = self.syntax.functions.iter().filter(|other| other.name != function.name);
        let others: Vec<&Function> = others.filter(|other| other.returns == Some(Type::FLOAT)).collect();
        let cast = if self.syntax.is_wgsl { ["vec2<f32>", "vec3<f32>"] } else { ["vec2", "vec3"] };
        let mut cells: Vec<String> = scope.of(Type::VEC3).to_vec();
        for scalar in [Scalar::Int, Scalar::UInt] {
            cells.extend(scope.of(Type { scalar, size: 3 }).iter().map(|c| format!("{}({c})", cast[1])));
        }
        for c in &cells {
            for other in &others {
                let name = &other.name;
                let kinds: Vec<&str> = other.parameters.iter().map(|(_, of)| of.as_str()).collect();
                match kinds[..] {
                    [of] if of.starts_with("vec2") => {
                        all.push(one(value, format!("{name}({0}({name}({c}.xy), {c}.z))", cast[0])));
                        all.push(one(
                            value,
                            format!("{name}({0}({name}(floor({c}.xy)), floor({c}.z)))", cast[0]),
                        ));
                    }
                    [of] if of.starts_with("vec3") => {
                        all.push(one(value, format!("{name}(floor({c}))")));
                    }
                    ["float" | "f32", "float" | "f32"] => {
                        all.push(one(value, format!("{name}({name}({c}.x, {c}.y), {c}.z)")));
                    }
                    _ => {}
                }
            }
            let hashed = fresh("hashed");
            let first = declared(&hashed, &sine_hash(&format!("{c}.x"), &format!("{c}.y")));
            let second = format!("return {};", sine_hash(&hashed, &format!("{c}.z")));
            all.push(vec![Edit { at: statement.at.clone(), with: format!("{first}\n{indent}{second}") }]);
        }
    }

    fn type_of(&self, scope: &Scope, name: &str) -> Option<Type> {
        scope.names.iter().find(|(other, _)| other == name).and_then(|(_, of)| *of)
    }

    /// Eq. 2 of a value `x`, where `a` is the smaller weight.
    fn cases(&self, x: &str, a: &str) -> String {
        let first = format!("{x} * {x} / (2.0 * {a} * (1.0 - {a}))");
        let middle = format!("({x} - 0.5 * {a}) / (1.0 - {a})");
        let last = format!("1.0 - (1.0 - {x}) * (1.0 - {x}) / (2.0 * {a} * (1.0 - {a}))");
        if self.syntax.is_wgsl {
            format!("select(select({last}, {middle}, {x} < 1.0 - {a}), {first}, {x} < {a})")
        } else {
            format!("{x} < {a} ? {first} : {x} < 1.0 - {a} ? {middle} : {last}")
        }
    }
}

/// Pairs of numbers that are declared side by side.
fn neighbours(scope: &Scope) -> Vec<[String; 2]> {
    let plain: Vec<&String> = scope.values.iter().filter(|name| !name.contains('.')).collect();
    let mut all = Vec::new();
    for pair in plain.windows(2) {
        all.push([pair[0].clone(), pair[1].clone()]);
        all.push([pair[1].clone(), pair[0].clone()]);
    }
    for (name, of) in &scope.names {
        if *of == Some(Type { scalar: Scalar::Float, size: 2 }) {
            all.push([format!("{name}.x"), format!("{name}.y")]);
            all.push([format!("{name}.y"), format!("{name}.x")]);
        }
    }
    all
}
