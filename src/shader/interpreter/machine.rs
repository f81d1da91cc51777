//! Runs a compiled function on one block of lanes.
//!
//! A set of lanes is a `u128`, one bit a lane. A block of steps is given the lanes that enter and answers with those
//! that fall out of its end; lanes that leave a loop or a switch are collected on the way. Operations compute all
//! lanes, active or not: nothing that they can do traps, and no value of an inactive lane is ever read. Only what
//! outlives a choice, a variable, is written under the mask.

use super::kernel;
use super::lanes::{Column, LANES, Lanes};
use super::model::DeviceModel;
use super::op::{Block, Case, Op, Register, Step};
use crate::threshold::batch::{Isa, isa::Job};
use core::cell::Cell;
use core::sync::atomic::{AtomicU64, Ordering};
use naga::Span;

/// A loop that ran when the steps were used up: the one with the most rounds of those around that point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Endless {
    pub(super) span: Span,
    rounds: u64,
}

/// The registers of one thread and where its lanes are.
pub(super) struct Machine<'a> {
    pub(super) registers: Vec<Column>,
    model: &'a DeviceModel,
    /// How many lanes every undefined behaviour has been seen in, by all threads.
    counts: &'a [AtomicU64],
    /// The lanes that are asked for; those behind the last one repeat it.
    pub(super) wanted: Lanes,
    isa: Isa,
    broken: Lanes,
    continued: Lanes,
    steps_left: u64,
}

impl<'a> Machine<'a> {
    pub(super) fn new(registers: usize, model: &'a DeviceModel, counts: &'a [AtomicU64]) -> Self {
        let zero = [const { Cell::new(0) }; LANES];
        let registers = vec![zero; registers];
        let wanted = Lanes::MAX;
        Self { registers, model, counts, wanted, isa: Isa::best(), broken: 0, continued: 0, steps_left: 0 }
    }

    /// How many of the steps of the last run were not taken.
    pub(super) const fn steps_left(&self) -> u64 {
        self.steps_left
    }

    #[inline(always)]
    pub(super) fn column(&self, register: Register) -> &Column {
        &self.registers[register as usize]
    }

    /// Writes a constant to all lanes.
    pub(super) fn fill(&self, register: Register, word: u32) {
        for lane in self.column(register) {
            lane.set(word);
        }
    }

    /// Rounds floats that come from outside to what the device can hold.
    pub(super) fn round(&self, register: Register) {
        self.model.round(self.isa, self.column(register));
    }

    /// Runs a function body on all lanes, at most so many operations and rounds of loops.
    pub(super) fn run(&mut self, body: &Block, steps: u64) -> Result<(), Endless> {
        (self.broken, self.continued, self.steps_left) = (0, 0, steps);
        self.block(body, Lanes::MAX).map(|_| ())
    }

    fn block(&mut self, block: &Block, mut active: Lanes) -> Result<Lanes, Endless> {
        for step in &block.0 {
            if active == 0 {
                break;
            }
            active = match step {
                Step::Compute(ops) => {
                    self.steps_left = self.steps_left.saturating_sub(ops.len() as u64);
                    self.isa.run(Ops { machine: self, ops, active });
                    active
                }
                Step::If { condition, accept, reject } => {
                    let condition = kernel::lanes(self.column(*condition), |word| word);
                    let accepted = self.block(accept, active & condition)?;
                    accepted | self.block(reject, active & !condition)?
                }
                Step::Switch { selector, cases } => self.switch(*selector, cases, active)?,
                Step::Loop { body, continuing, break_if, span } => {
                    self.repeat(body, continuing, *break_if, *span, active)?
                }
                Step::Call { body } => {
                    self.block(body, active)?;
                    active
                }
                Step::Break => {
                    self.broken |= active;
                    0
                }
                Step::Continue => {
                    self.continued |= active;
                    0
                }
                Step::Return => 0,
            };
        }
        Ok(active)
    }

    fn switch(&mut self, selector: Register, cases: &[Case], active: Lanes) -> Result<Lanes, Endless> {
        let outside = core::mem::take(&mut self.broken);
        let mut unmatched = active;
        let matches: Vec<Lanes> = cases
            .iter()
            .map(|case| {
                let Some(value) = case.value else { return 0 };
                let equal = |word| if word == value { u32::MAX } else { 0 };
                let found = unmatched & kernel::lanes(self.column(selector), equal);
                unmatched &= !found;
                found
            })
            .collect();
        let (mut left, mut falling) = (0, 0);
        for (case, found) in cases.iter().zip(matches) {
            let entering = if case.value.is_none() { unmatched } else { found };
            let fell = self.block(&case.body, entering | falling)?;
            (left, falling) = if case.falls_through { (left, fell) } else { (left | fell, 0) };
        }
        let left = left | falling | self.broken;
        self.broken = outside;
        Ok(left)
    }

    fn repeat(
        &mut self,
        body: &Block,
        continuing: &Block,
        break_if: Option<Register>,
        span: Span,
        mut active: Lanes,
    ) -> Result<Lanes, Endless> {
        let outside = (core::mem::take(&mut self.broken), core::mem::take(&mut self.continued));
        let mut rounds = 0;
        let most_rounds = |rounds, inner: Endless| {
            if inner.rounds > rounds { inner } else { Endless { span, rounds } }
        };
        while active != 0 {
            rounds += 1;
            self.steps_left = self.steps_left.saturating_sub(1);
            if self.steps_left == 0 {
                return Err(Endless { span, rounds });
            }
            let fell = self.block(body, active).map_err(|inner| most_rounds(rounds, inner))?;
            active = fell | core::mem::take(&mut self.continued);
            active = self.block(continuing, active).map_err(|inner| most_rounds(rounds, inner))?;
            if let Some(condition) = break_if {
                let leaving = active & kernel::lanes(self.column(condition), |word| word);
                self.broken |= leaving;
                active &= !leaving;
            }
        }
        let left = self.broken;
        (self.broken, self.continued) = outside;
        Ok(left)
    }

    #[inline(always)]
    fn compute<const FUSED: bool>(&self, op: &Op, active: Lanes) {
        let column = |register| self.column(register);
        let (model, isa) = (self.model, self.isa);
        match *op {
            Op::Unary { function, to, from } => {
                kernel::unary::<FUSED>(function, column(to), column(from), model, isa);
            }
            Op::Binary { function, to, left, right } => {
                kernel::binary(function, column(to), column(left), column(right), model, isa);
            }
            Op::Sum { contracted, to, .. } if model.contracts => {
                let [a, b] = contracted.product.factors.map(column);
                let signs = [contracted.product.negated, contracted.negate_addend];
                kernel::contracted_sum(column(to), [a, b, column(contracted.addend)], signs, model, isa);
            }
            Op::Sum { function, to, left, right, .. } => {
                kernel::binary(function, column(to), column(left), column(right), model, isa);
            }
            Op::Fma { to, arguments } => {
                kernel::contracted_sum(column(to), arguments.map(column), [false; 2], model, isa);
            }
            Op::Select { to, condition, accept, reject } => {
                kernel::select(column(to), column(condition), column(accept), column(reject));
            }
            Op::Gather { to, first, offset } => {
                for lane in 0..LANES {
                    let register = first + column(offset)[lane].get();
                    column(to)[lane].set(column(register)[lane].get());
                }
            }
            Op::Store { to, from } => kernel::store(column(to), column(from), active),
            Op::Scatter { first, offset, from } => {
                for lane in (0..LANES).filter(|lane| active >> lane & 1 == 1) {
                    let register = first + column(offset)[lane].get();
                    column(register)[lane].set(column(from)[lane].get());
                }
            }
            Op::Count { odd, met } => {
                let lanes = kernel::lanes(column(odd), |word| word) & active & self.wanted;
                if lanes != 0 {
                    self.counts[met].fetch_add(u64::from(lanes.count_ones()), Ordering::Relaxed);
                }
            }
        }
    }
}

/// A run of operations, compiled for the instructions of the machine.
struct Ops<'a, 'm> {
    machine: &'a Machine<'m>,
    ops: &'a [Op],
    active: Lanes,
}

impl Job for Ops<'_, '_> {
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        for op in self.ops {
            self.machine.compute::<FUSED>(op, self.active);
        }
    }
}
