//! Fewer operations and fewer registers: copies that are read in place, values that nobody reads, columns used again.
//!
//! A compiled function gives every value a column of its own, 512 bytes; a shader of some hundred lines then has more of them than
//! the first-level cache holds. Most values live within one run of operations. Those take turns in a few columns here.

use super::super::op::{Block, Op, Register, Step, Unary};
use std::collections::HashMap;

/// Rewrites a body. Returns where each register went that occurs in more than one run of operations or is `kept`, which is asked of
/// those that are read or written from outside, or by an offset that is found while the function runs (they stay in their order,
/// those of an array side by side), and how many registers there are now.
pub(super) fn reuse(
    body: &mut Block,
    registers: u32,
    kept: impl Fn(Register) -> bool,
) -> (Vec<Register>, u32) {
    let mut places = vec![Seen::Nowhere; registers as usize];
    note_all(body, &mut 0, &mut places);
    for register in 0..registers {
        if kept(register) {
            places[register as usize] = Seen::Several;
        }
    }
    let is_local = |register: Register| matches!(places[register as usize], Seen::Within(_));
    let mut renamed = vec![Register::MAX; registers as usize];
    let mut next = 0;
    for register in (0..registers).filter(|&register| places[register as usize] == Seen::Several) {
        renamed[register as usize] = next;
        next += 1;
    }
    let mut columns = 0;
    each_compute(body, &mut |ops| {
        read_in_place(ops, &is_local);
        drop_unread(ops, &is_local);
        columns = columns.max(take_turns(ops, &is_local, &renamed, next));
    });
    each_test(body, &mut |register| *register = renamed[*register as usize]);
    (renamed, next + columns)
}

/// Where a register is read or written.
#[derive(Clone, Copy, PartialEq)]
enum Seen {
    Nowhere,
    /// In this run of operations alone, written there once, on all lanes, and not read before.
    Within(usize),
    Several,
}

/// Notes where every register of a block occurs; runs of operations are counted.
fn note_all(block: &mut Block, run: &mut usize, places: &mut [Seen]) {
    each_test(block, &mut |register| places[*register as usize] = Seen::Several);
    each_compute(block, &mut |ops| {
        *run += 1;
        for op in ops {
            reads(op, |register| {
                let place = &mut places[*register as usize];
                if *place != Seen::Within(*run) {
                    *place = Seen::Several;
                }
            });
            let on_all_lanes = !matches!(op, Op::Store { .. } | Op::Scatter { .. });
            if let Some(&mut register) = written(op) {
                let place = &mut places[register as usize];
                let is_first = on_all_lanes && *place == Seen::Nowhere;
                // A register that is written twice is a variable.
                *place = if is_first { Seen::Within(*run) } else { Seen::Several };
            }
        }
    });
}

/// Lets readers of a copy read what was copied, as long as that stays what it was.
fn read_in_place(ops: &mut [Op], is_local: &impl Fn(Register) -> bool) {
    let mut last_read = HashMap::new();
    for (at, op) in ops.iter_mut().enumerate() {
        reads(op, |register| {
            last_read.insert(*register, at);
        });
    }
    // From behind: where a register is written next, and which arrays have an element written that is found while it runs.
    let (mut next_write, mut scattered) = (HashMap::new(), Vec::new());
    let mut instead = HashMap::new();
    for (at, op) in ops.iter_mut().enumerate().rev() {
        if let Op::Unary { function: Unary::Copy, to, from } = *op
            && is_local(to)
        {
            let last = last_read.get(&to).copied().unwrap_or(at);
            let is_written = next_write.get(&from).is_some_and(|&write| write < last)
                || scattered.iter().any(|&(first, write)| from >= first && write < last);
            if !is_written {
                instead.insert(to, from);
                let of_from = last_read.entry(from).or_insert(last);
                *of_from = last.max(*of_from);
            }
        }
        if let Op::Scatter { first, .. } = *op {
            scattered.push((first, at));
        }
        if let Some(&mut register) = written(op) {
            next_write.insert(register, at);
        }
    }
    for op in ops {
        reads(op, |register| {
            while let Some(&from) = instead.get(register) {
                *register = from;
            }
        });
    }
}

/// Takes out what is computed and read by nobody.
fn drop_unread(ops: &mut Vec<Op>, is_local: &impl Fn(Register) -> bool) {
    let mut is_read = std::collections::HashSet::new();
    let mut needed = vec![true; ops.len()];
    for (op, needed) in ops.iter_mut().zip(&mut needed).rev() {
        *needed = match written(op) {
            Some(&mut to) => !is_local(to) || is_read.contains(&to),
            None => true,
        };
        if *needed {
            reads(op, |register| {
                is_read.insert(*register);
            });
        }
    }
    let mut needed = needed.into_iter();
    ops.retain(|_| needed.next().unwrap_or(true));
}

/// Renames the registers of a run: those that are kept as `renamed` says, the others to columns from `first` on, each of which is
/// free again after its last reader. Returns how many columns it takes.
fn take_turns(
    ops: &mut [Op],
    is_local: &impl Fn(Register) -> bool,
    renamed: &[Register],
    first: Register,
) -> u32 {
    let mut last_read = HashMap::new();
    for (at, op) in ops.iter_mut().enumerate() {
        reads(op, |register| {
            last_read.insert(*register, at);
        });
    }
    let (mut column_of, mut free, mut columns) = (HashMap::new(), Vec::new(), 0);
    for (at, op) in ops.iter_mut().enumerate() {
        // Not the column of an argument: a loop over two columns that are one is not turned into vector instructions.
        if let Some(to) = written(op).filter(|to| is_local(**to)) {
            let column = free.pop().unwrap_or_else(|| {
                columns += 1;
                columns - 1
            });
            column_of.insert(*to, column);
        }
        let mut done = Vec::new();
        reads(op, |register| {
            if is_local(*register) {
                if last_read.get(register) == Some(&at) {
                    done.push(*register);
                }
                // It has a column: what is local is written before it is read, and gives its column back after the last reader.
                *register = first + column_of[register];
            } else {
                *register = renamed[*register as usize];
            }
        });
        free.extend(done.into_iter().filter_map(|register| column_of.remove(&register)));
        if let Some(to) = written(op) {
            let old = *to;
            *to = if is_local(old) { first + column_of[&old] } else { renamed[old as usize] };
        } else if let Op::Scatter { first: array, .. } = op {
            *array = renamed[*array as usize];
        }
    }
    columns
}

/// Every run of operations, in the order of the text.
fn each_compute(block: &mut Block, visit: &mut impl FnMut(&mut Vec<Op>)) {
    each_step(block, &mut |step| {
        if let Step::Compute(ops) = step {
            visit(ops);
        }
    });
}

/// Every register that a step other than a run of operations reads.
fn each_test(block: &mut Block, visit: &mut impl FnMut(&mut Register)) {
    each_step(block, &mut |step| match step {
        Step::If { condition, .. } => visit(condition),
        Step::Switch { selector, .. } => visit(selector),
        Step::Loop { break_if: Some(condition), .. } => visit(condition),
        Step::Compute(_)
        | Step::Loop { break_if: None, .. }
        | Step::Call { .. }
        | Step::Break
        | Step::Continue
        | Step::Return => {}
    });
}

/// Every step, outer ones first.
fn each_step(block: &mut Block, visit: &mut impl FnMut(&mut Step)) {
    for step in &mut block.0 {
        visit(step);
        match step {
            Step::If { accept, reject, .. } => {
                each_step(accept, visit);
                each_step(reject, visit);
            }
            Step::Switch { cases, .. } => {
                cases.iter_mut().for_each(|case| each_step(&mut case.body, visit));
            }
            Step::Loop { body, continuing, .. } => {
                each_step(body, visit);
                each_step(continuing, visit);
            }
            Step::Call { body } => each_step(body, visit),
            Step::Compute(_) | Step::Break | Step::Continue | Step::Return => {}
        }
    }
}

/// The register that an operation writes, if it is one that is known here.
fn written(op: &mut Op) -> Option<&mut Register> {
    match op {
        Op::Unary { to, .. }
        | Op::Binary { to, .. }
        | Op::Sum { to, .. }
        | Op::Fma { to, .. }
        | Op::Select { to, .. }
        | Op::Gather { to, .. }
        | Op::Store { to, .. } => Some(to),
        Op::Scatter { .. } | Op::Count { .. } => None,
    }
}

/// The registers that an operation reads; the first of an array stands for all of it.
fn reads(op: &mut Op, mut visit: impl FnMut(&mut Register)) {
    match op {
        Op::Unary { from, .. } | Op::Store { from, .. } => visit(from),
        Op::Binary { left, right, .. } => [left, right].into_iter().for_each(visit),
        Op::Sum { left, right, contracted, .. } => {
            let [a, b] = &mut contracted.product.factors;
            [left, right, a, b, &mut contracted.addend].into_iter().for_each(visit);
        }
        Op::Fma { arguments, .. } => arguments.iter_mut().for_each(visit),
        Op::Select { condition, accept, reject, .. } => {
            [condition, accept, reject].into_iter().for_each(visit);
        }
        Op::Gather { first, offset, .. } => [first, offset].into_iter().for_each(visit),
        Op::Scatter { offset, from, .. } => [offset, from].into_iter().for_each(visit),
        Op::Count { odd, .. } => visit(odd),
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::{Column, DeviceModel, Program, Values};

    fn program(source: &str) -> Program {
        let module = naga::front::wgsl::parse_str(source).unwrap();
        let info =
            naga::valid::Validator::new(Default::default(), Default::default()).validate(&module).unwrap();
        Program::compile(&module, &info, "f").unwrap()
    }

    fn run(source: &str, x: &[f32]) -> Vec<f32> {
        match program(source).run(&[Column::F32(x)], x.len(), &DeviceModel::ACCURATE).unwrap().pop() {
            Some(Values::F32(values)) => values,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_copy_keeps_what_it_was_when_the_variable_changes() {
        let source = "fn f(x: f32) -> f32 {
            var a = x;
            let before = a;
            a = a + 1.0;
            let between = a;
            a = a * 2.0;
            return 100.0 * before + 10.0 * between + a;
        }";
        assert_eq!(run(source, &[1.0, 2.0]), [124.0, 236.0]);
        let chained = "fn f(x: f32) -> f32 {
            var a = x;
            var b = a;
            a = 5.0;
            var c = b;
            b = 7.0;
            return c + 10.0 * b + 100.0 * a;
        }";
        assert_eq!(run(chained, &[3.0]), [573.0]);
    }

    #[test]
    fn elements_that_are_chosen_by_an_index_stay_where_they_are() {
        let source = "fn f(x: f32) -> f32 {
            var a = array<f32, 4>(x, 2.0 * x, 3.0 * x, 4.0 * x);
            let i = i32(x);
            let before = a[1];
            a[i] = 50.0;
            let m = mat2x2<f32>(x, 1.0, 2.0, 3.0);
            return before + a[i] + a[3 - i] + 1000.0 * m[i % 2][1];
        }";
        let expected = |x: f32, third: f32, m: f32| 2.0 * x + 50.0 + third + 1000.0 * m;
        assert_eq!(run(source, &[1.0, 2.0]), [expected(1.0, 3.0, 3.0), expected(2.0, 4.0, 1.0)]);
    }

    #[test]
    fn values_of_a_loop_take_turns() {
        let source = "fn f(x: f32) -> f32 {
            var sum = 0.0;
            for (var i = 0; i < 8; i++) {
                let y = x * f32(i);
                let z = y * y + x;
                sum += z * z - y;
            }
            return sum;
        }";
        let of = |x: f32| {
            (0..8_u8).fold(0.0, |sum: f32, i| {
                let y = x * f32::from(i);
                let z = y * y + x;
                sum + (z * z - y)
            })
        };
        assert_eq!(run(source, &[0.5, 3.0]), [of(0.5), of(3.0)]);
    }

    #[test]
    fn a_long_expression_needs_few_columns() {
        let terms: Vec<String> = (0..200).map(|i| format!("sin(x * {i}.0) * cos(x + {i}.0)")).collect();
        let source = format!("fn f(x: f32) -> f32 {{ return {}; }}", terms.join(" + "));
        let program = program(&source);
        let constants = program.constants.len();
        assert!(program.registers < constants + 12, "{} beside {constants} constants", program.registers);
    }
}
