//! The interpreter against the Rust functions that a shader repeats, and against shaders that do not behave.

use hashed_alpha::shader::interpreter::{Column, DeviceModel, Program, Values};
use hashed_alpha::threshold::emulated::{
    Arithmetic, CoarseSine, Emulated, FlushToZero, Fused, Half, ReducedSine, Single,
};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::{Cell, Hash, HashKind};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::two_scale::Variant;
use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};

const LISTINGS: &str = include_str!("shader/listings.wgsl");

fn compile(source: &str, function: &str) -> Program {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    let info = naga::valid::Validator::new(Default::default(), Default::default())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    Program::compile(&module, &info, function).unwrap_or_else(|e| panic!("{}", e.in_source(source)))
}

/// Footprints of every size and direction: positions in [-10, 10]^3, derivatives over 20 octaves.
fn columns(count: usize, seed: u64) -> Vec<Vec<f32>> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut columns = vec![Vec::new(); 9];
    for _ in 0..count {
        let size = libm::exp2(rng.random_range(-16.0..4.0));
        for (index, column) in columns.iter_mut().enumerate() {
            let value =
                if index < 3 { rng.random_range(-10.0..10.0) } else { rng.random_range(-1.0..1.0) * size };
            column.push(value as f32);
        }
    }
    columns
}

fn footprint<R: Real>(columns: &[Vec<f32>], index: usize) -> Footprint<R> {
    let vector = |first: usize| {
        R::Vec3::from([0, 1, 2].map(|axis| R::from_f64(f64::from(columns[first + axis][index]))))
    };
    Footprint { position: vector(0), dpdx: vector(3), dpdy: vector(6) }
}

fn thresholds(function: &str, columns: &[Vec<f32>], model: &DeviceModel) -> Vec<f32> {
    let program = compile(LISTINGS, function);
    let mut inputs: Vec<_> = columns.iter().map(|column| Column::F32(column)).collect();
    inputs.push(Column::F32(&[1.0]));
    let result = program.run(&inputs, columns[0].len(), model).expect("the listing ends");
    let [Values::F32(values)] = <[Values; 1]>::try_from(result).expect("one scalar") else {
        panic!("a float")
    };
    values
}

/// Same bits, or both NaN: IEEE 754 leaves the bits of a NaN open.
fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

#[test]
fn both_listings_give_the_bits_of_their_rust_twins() {
    let columns = columns(600_000, 1);
    for (variant, name) in [(Variant::Isotropic, "isotropic"), (Variant::Anisotropic, "anisotropic")] {
        let listing = HashedAlpha::listing(variant);
        let values = thresholds(name, &columns, &DeviceModel::ACCURATE);
        for (index, &value) in values.iter().enumerate() {
            let expected = listing.threshold(&footprint::<f32>(&columns, index));
            assert!(same(value, expected), "{name} {index}: {value} is not {expected}");
        }
    }
}

#[test]
fn every_device_model_gives_the_bits_of_the_emulated_listing() {
    fn agrees<A: Arithmetic>(model: &DeviceModel, columns: &[Vec<f32>]) {
        assert_eq!(model.name(), A::NAME);
        for (variant, name) in [(Variant::Isotropic, "isotropic"), (Variant::Anisotropic, "anisotropic")] {
            let listing = HashedAlpha::listing(variant);
            let values = thresholds(name, columns, model);
            assert!(
                values
                    .iter()
                    .zip(thresholds(name, columns, &DeviceModel::of::<A>()))
                    .all(|(&a, b)| same(a, b))
            );
            for (index, &value) in values.iter().enumerate() {
                let expected = listing.threshold(&footprint::<Emulated<A>>(columns, index)).to_f64() as f32;
                assert!(same(value, expected), "{} {name} {index}: {value} is not {expected}", A::NAME);
            }
        }
    }
    let columns = columns(60_000, 2);
    agrees::<Single>(&DeviceModel::ACCURATE, &columns);
    agrees::<CoarseSine>(&DeviceModel::COARSE_SINE, &columns);
    agrees::<ReducedSine>(&DeviceModel::REDUCED_SINE, &columns);
    agrees::<Half>(&DeviceModel::HALF, &columns);
    agrees::<FlushToZero>(&DeviceModel::FLUSH_TO_ZERO, &columns);
    agrees::<Fused>(&DeviceModel::FUSED, &columns);
}

#[test]
fn device_models_differ_from_the_reference() {
    let columns = columns(2_000, 3);
    let reference = thresholds("isotropic", &columns, &DeviceModel::ACCURATE);
    for model in &DeviceModel::ALL[1..] {
        let values = thresholds("isotropic", &columns, model);
        let different = reference.iter().zip(&values).filter(|(a, b)| !same(**a, **b)).count();
        // Subnormal numbers do not occur here.
        assert_eq!(different == 0, model.name() == "flush to zero", "{}: {different}", model.name());
    }
}

#[test]
fn integer_hashes_give_the_bits_of_their_rust_twins() {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(4);
    let count = 600_000;
    let mut coordinate =
        || -> Vec<f32> { (0..count).map(|_| f32::floor(rng.random_range(-1.0e6_f32..1.0e6))).collect() };
    let cell = [coordinate(), coordinate(), coordinate()];
    let octaves: Vec<i32> = (0..count).map(|_| rng.random_range(-30..30)).collect();
    let kinds = [(HashKind::Mm4, "mm4"), (HashKind::Xxhash32, "xxhash32"), (HashKind::Pcg3d, "pcg3d")];
    for (kind, name) in kinds {
        let [x, y, z] = &cell;
        let columns = [Column::F32(x), Column::F32(y), Column::F32(z), Column::I32(&octaves)];
        let result = compile(LISTINGS, name).run(&columns, count, &DeviceModel::ACCURATE).expect("it ends");
        let Values::F32(values) = &result[0] else { panic!("a float") };
        for (i, value) in values.iter().enumerate() {
            let cell = Cell { index: glam::vec3(x[i], y[i], z[i]), octave: octaves[i] as u32 };
            let expected: f32 = kind.hash(&cell);
            assert_eq!(value.to_bits(), expected.to_bits(), "{name} {cell:?}");
        }
    }
}

/// Random shaders against a scalar evaluation of the same tree, one lane at a time.
mod random {
    use super::{Column, DeviceModel, Values, compile};
    use proptest::prelude::*;
    use std::fmt::Write;

    /// Expressions over four variables and an array of four, all `u32`.
    #[derive(Clone, Debug)]
    enum Expr {
        Lane,
        Variable(usize),
        Constant(u32),
        Element(Box<Expr>),
        Binary(&'static str, Box<Expr>, Box<Expr>),
        Select(Box<Expr>, Box<Expr>, Box<Expr>),
        Call(Box<Expr>, Box<Expr>),
    }

    #[derive(Clone, Debug)]
    enum Stmt {
        Assign(usize, Expr),
        AssignElement(Expr, Expr),
        If(Expr, Vec<Stmt>, Vec<Stmt>),
        /// At most so many rounds; the expression ends it earlier where it is odd.
        Loop(u32, Vec<Stmt>, Expr),
        Switch(Expr, Vec<Vec<Stmt>>),
        BreakIf(Expr),
        ContinueIf(Expr),
        ReturnIf(Expr, Expr),
    }

    const OPERATORS: [&str; 10] = ["+", "-", "*", "/", "%", "&", "|", "^", "<<", ">>"];

    fn expr() -> impl Strategy<Value = Expr> {
        let leaf = prop_oneof![
            Just(Expr::Lane),
            (0..4_usize).prop_map(Expr::Variable),
            prop_oneof![0..6_u32, any::<u32>()].prop_map(Expr::Constant),
        ];
        leaf.prop_recursive(3, 12, 3, |inner| {
            let inner = inner.prop_map(Box::new).boxed();
            prop_oneof![
                4 => (proptest::sample::select(&OPERATORS[..]), inner.clone(), inner.clone())
                    .prop_map(|(op, a, b)| Expr::Binary(op, a, b)),
                1 => inner.clone().prop_map(Expr::Element),
                1 => (inner.clone(), inner.clone(), inner.clone()).prop_map(|(c, a, b)| Expr::Select(c, a, b)),
                1 => (inner.clone(), inner).prop_map(|(a, b)| Expr::Call(a, b)),
            ]
        })
    }

    fn block() -> impl Strategy<Value = Vec<Stmt>> {
        let leaf = prop_oneof![
            4 => (0..4_usize, expr()).prop_map(|(to, value)| Stmt::Assign(to, value)),
            2 => (expr(), expr()).prop_map(|(index, value)| Stmt::AssignElement(index, value)),
            1 => expr().prop_map(Stmt::BreakIf),
            1 => expr().prop_map(Stmt::ContinueIf),
            1 => (expr(), expr()).prop_map(|(condition, value)| Stmt::ReturnIf(condition, value)),
        ];
        let statement = leaf.prop_recursive(4, 40, 4, |inner| {
            let body = prop::collection::vec(inner, 0..4).boxed();
            prop_oneof![
                (expr(), body.clone(), body.clone()).prop_map(|(c, a, b)| Stmt::If(c, a, b)),
                (0..5_u32, body.clone(), expr())
                    .prop_map(|(rounds, body, end)| Stmt::Loop(rounds, body, end)),
                (expr(), prop::collection::vec(body, 3))
                    .prop_map(|(selector, cases)| Stmt::Switch(selector, cases)),
            ]
        });
        prop::collection::vec(statement, 1..8)
    }

    /// Whether `break` and `continue` have something to leave.
    #[derive(Clone, Copy)]
    struct Inside {
        breakable: bool,
        loops: usize,
    }

    fn write_expr(out: &mut String, expr: &Expr) {
        match expr {
            Expr::Lane => out.push_str("lane"),
            Expr::Variable(i) => write!(out, "x{i}_").expect("a string"),
            Expr::Constant(value) => write!(out, "{value}u").expect("a string"),
            Expr::Element(index) => {
                out.push_str("m[id(");
                write_expr(out, index);
                out.push_str(")]");
            }
            Expr::Binary(op, a, b) => {
                // By way of a function, since naga refuses overflow that it can see.
                out.push_str("(id(");
                write_expr(out, a);
                write!(out, ") {op} id(").expect("a string");
                write_expr(out, b);
                out.push_str("))");
            }
            Expr::Select(c, a, b) => {
                out.push_str("select(");
                write_expr(out, b);
                out.push_str(", ");
                write_expr(out, a);
                out.push_str(", odd(");
                write_expr(out, c);
                out.push_str("))");
            }
            Expr::Call(a, b) => {
                out.push_str("mixed(");
                write_expr(out, a);
                out.push_str(", ");
                write_expr(out, b);
                out.push(')');
            }
        }
    }

    fn text(expr: &Expr) -> String {
        let mut out = String::new();
        write_expr(&mut out, expr);
        out
    }

    fn write_block(out: &mut String, block: &[Stmt], inside: Inside) {
        for statement in block {
            match statement {
                Stmt::Assign(to, value) => writeln!(out, "x{to}_ = {};", text(value)),
                Stmt::AssignElement(index, value) => {
                    writeln!(out, "m[id({})] = {};", text(index), text(value))
                }
                Stmt::If(condition, accept, reject) => {
                    writeln!(out, "if odd({}) {{", text(condition)).expect("a string");
                    write_block(out, accept, inside);
                    out.push_str("} else {\n");
                    write_block(out, reject, inside);
                    writeln!(out, "}}")
                }
                Stmt::Loop(rounds, body, end) => {
                    let counter = format!("n{}_", inside.loops);
                    writeln!(out, "{{ var {counter} = 0u; loop {{ if {counter} >= {rounds}u {{ break; }}")
                        .expect("a string");
                    write_block(out, body, Inside { breakable: true, loops: inside.loops + 1 });
                    writeln!(out, "continuing {{ {counter}++; break if odd({}); }} }} }}", text(end))
                }
                Stmt::Switch(selector, cases) => {
                    writeln!(out, "switch ({}) % 4u {{", text(selector)).expect("a string");
                    for (label, case) in ["case 0u", "case 1u, 3u", "default"].into_iter().zip(cases) {
                        writeln!(out, "{label}: {{").expect("a string");
                        write_block(out, case, Inside { breakable: true, ..inside });
                        out.push_str("}\n");
                    }
                    writeln!(out, "}}")
                }
                Stmt::BreakIf(condition) if inside.breakable => {
                    writeln!(out, "if odd({}) {{ break; }}", text(condition))
                }
                Stmt::ContinueIf(condition) if inside.loops > 0 => {
                    writeln!(out, "if odd({}) {{ continue; }}", text(condition))
                }
                Stmt::BreakIf(_) | Stmt::ContinueIf(_) => Ok(()),
                Stmt::ReturnIf(condition, value) => {
                    writeln!(out, "if odd({}) {{ return {}; }}", text(condition), text(value))
                }
            }
            .expect("a string");
        }
    }

    fn source(block: &[Stmt]) -> String {
        let mut out = "fn id(x: u32) -> u32 { return x; }
fn odd(x: u32) -> bool { return (x & 1u) == 1u; }
fn mixed(a: u32, b: u32) -> u32 { if a < b { return a * 3u; } var c = b; while c > a / 2u + 7u { c /= 3u; } return c; }
fn f(lane: u32) -> u32 {
var x0_ = lane; var x1_ = lane / 3u; var x2_ = 7u; var x3_ = 0u; var m = array<u32, 4>(1u, 2u, 3u, 5u);
"
        .to_owned();
        write_block(&mut out, block, Inside { breakable: false, loops: 0 });
        out.push_str("return x0_ ^ (x1_ * 3u) ^ (x2_ * 5u) ^ (x3_ * 7u) ^ (m[0] + m[1] * 11u + m[2] * 13u + m[3] * 17u);\n}\n");
        out
    }

    struct State {
        lane: u32,
        x: [u32; 4],
        m: [u32; 4],
    }

    enum Flow {
        On,
        Break,
        Continue,
        Return(u32),
    }

    impl State {
        fn value(&self, expr: &Expr) -> u32 {
            match expr {
                Expr::Lane => self.lane,
                Expr::Variable(i) => self.x[*i],
                Expr::Constant(value) => *value,
                Expr::Element(index) => self.m[self.value(index).min(3) as usize],
                Expr::Binary(op, a, b) => {
                    let (a, b) = (self.value(a), self.value(b));
                    match *op {
                        "+" => a.wrapping_add(b),
                        "-" => a.wrapping_sub(b),
                        "*" => a.wrapping_mul(b),
                        "/" if b == 0 => a,
                        "/" => a / b,
                        "%" if b == 0 => 0,
                        "%" => a % b,
                        "&" => a & b,
                        "|" => a | b,
                        "^" => a ^ b,
                        "<<" => a << (b % 32),
                        _ => a >> (b % 32),
                    }
                }
                Expr::Select(c, a, b) => self.value(if self.value(c) % 2 == 1 { a } else { b }),
                Expr::Call(a, b) => {
                    let (a, b) = (self.value(a), self.value(b));
                    if a < b {
                        return a.wrapping_mul(3);
                    }
                    let mut c = b;
                    while c > a / 2 + 7 {
                        c /= 3;
                    }
                    c
                }
            }
        }

        fn run(&mut self, block: &[Stmt], inside: Inside) -> Flow {
            for statement in block {
                let odd = |state: &Self, condition: &Expr| state.value(condition) % 2 == 1;
                let flow = match statement {
                    Stmt::Assign(to, value) => {
                        self.x[*to] = self.value(value);
                        Flow::On
                    }
                    Stmt::AssignElement(index, value) => {
                        let index = self.value(index).min(3) as usize;
                        self.m[index] = self.value(value);
                        Flow::On
                    }
                    Stmt::If(condition, accept, reject) => {
                        let taken = if odd(self, condition) { accept } else { reject };
                        self.run(taken, inside)
                    }
                    Stmt::Loop(rounds, body, end) => {
                        let inside = Inside { breakable: true, loops: inside.loops + 1 };
                        let mut flow = Flow::On;
                        for _ in 0..*rounds {
                            match self.run(body, inside) {
                                Flow::Break => break,
                                Flow::Return(value) => {
                                    flow = Flow::Return(value);
                                    break;
                                }
                                Flow::On | Flow::Continue => {}
                            }
                            if odd(self, end) {
                                break;
                            }
                        }
                        flow
                    }
                    Stmt::Switch(selector, cases) => {
                        let case = [0, 1, 2, 1][(self.value(selector) % 4) as usize];
                        match self.run(&cases[case], Inside { breakable: true, ..inside }) {
                            Flow::Break => Flow::On,
                            flow => flow,
                        }
                    }
                    Stmt::BreakIf(condition) if inside.breakable && odd(self, condition) => Flow::Break,
                    Stmt::ContinueIf(condition) if inside.loops > 0 && odd(self, condition) => Flow::Continue,
                    Stmt::ReturnIf(condition, value) if odd(self, condition) => {
                        Flow::Return(self.value(value))
                    }
                    _ => Flow::On,
                };
                if !matches!(flow, Flow::On) {
                    return flow;
                }
            }
            Flow::On
        }
    }

    fn alone(block: &[Stmt], lane: u32) -> u32 {
        let mut state = State { lane, x: [lane, lane / 3, 7, 0], m: [1, 2, 3, 5] };
        if let Flow::Return(value) = state.run(block, Inside { breakable: false, loops: 0 }) {
            return value;
        }
        let ([a, b, c, d], [m, n, o, p]) = (state.x, state.m);
        let sum = |factors: [u32; 4]| {
            [m, n, o, p].iter().zip(factors).fold(0, |sum: u32, (x, k)| sum.wrapping_add(x.wrapping_mul(k)))
        };
        a ^ b.wrapping_mul(3) ^ c.wrapping_mul(5) ^ d.wrapping_mul(7) ^ sum([1, 11, 13, 17])
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

        #[test]
        fn every_lane_of_a_random_shader_runs_as_it_would_alone(block in block()) {
            let source = source(&block);
            let program = compile(&source, "f");
            let lanes: Vec<u32> = (0..150).map(|i| i * i / 2).collect();
            let result = program.run(&[Column::U32(&lanes)], lanes.len(), &DeviceModel::ACCURATE);
            let expected = lanes.iter().map(|&lane| alone(&block, lane)).collect();
            prop_assert_eq!(result, Ok(vec![Values::U32(expected)]), "{}", source);
        }
    }
}
