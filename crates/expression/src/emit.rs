//! Instructions put together one after another, constants folded on the way.
//!
//! What is bound at once and what is left open and bound later go through here, so that both become the same program, to
//! the last bit.

use crate::expression::{Binary, Call, Node};
use crate::program::{Instruction, Program, STACK};
use crate::{Expression, Reference};
use crate::{Formula, Function};

/// Largest constant exponent that is a whole power.
const WHOLE: f64 = 64.0;

#[derive(Default)]
pub(crate) struct Emitter {
    pub code: Vec<Instruction>,
    /// Where the instructions of each operand begin.
    begins: Vec<usize>,
}

/// What became of an operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Folded {
    /// It stays an instruction.
    No,
    /// It was one of constants and is a constant now.
    Finite,
    /// The same, but finite numbers gave one that is not.
    NotFinite,
}

impl Emitter {
    /// An operand by itself.
    pub fn push(&mut self, instruction: Instruction) {
        self.begins.push(self.code.len());
        self.code.push(instruction);
    }

    /// An operand that is a program.
    pub fn push_all(&mut self, program: Program) {
        self.begins.push(self.code.len());
        self.code.extend(program.instructions);
    }

    /// Applies an instruction to the last `count` operands; folds it when they are constant.
    pub fn apply(&mut self, instruction: Instruction, count: usize) -> Folded {
        let keep = self.begins.len().saturating_sub(count);
        let begin = self.begins.get(keep).copied().unwrap_or(0);
        self.begins.truncate(keep);
        self.begins.push(begin);
        let inputs = self.code.len() - begin;
        let mut finite = true;
        let constant = self.code[begin..].iter().all(|old| match old {
            Instruction::Constant(value) => {
                finite &= value.is_finite();
                true
            }
            _ => false,
        });
        self.code.push(instruction);
        if !constant || inputs > 2 {
            return Folded::No;
        }
        let program = Program { instructions: self.code.split_off(begin) };
        let value = program.run(0.0, &[]);
        self.code.push(Instruction::Constant(value));
        if finite && !value.is_finite() { Folded::NotFinite } else { Folded::Finite }
    }

    /// The last operand, where it is a constant.
    pub fn constant(&self) -> Option<f64> {
        match (self.begins.last(), self.code.last()) {
            (Some(begin), Some(Instruction::Constant(value))) if begin + 1 == self.code.len() => Some(*value),
            _ => None,
        }
    }

    /// The last operand but one to the power of the last.
    pub fn power(&mut self) -> Folded {
        match self.constant() {
            Some(power) if power.fract() == 0.0 && power.abs() <= WHOLE => {
                self.code.pop();
                self.begins.pop();
                self.apply(Instruction::WholePower(power as i32), 1)
            }
            _ => self.apply(Instruction::Binary(Binary::Power), 2),
        }
    }

    /// f of the last `count` operands, as f(a, f(b, c)), which is the same for all that take more than two.
    pub fn call(&mut self, call: Call, count: usize) -> Folded {
        if count == 1 {
            return self.apply(Instruction::Call1(call), 1);
        }
        let mut folded = Folded::No;
        for _ in 1..count {
            let one = self.apply(Instruction::Call2(call), 2);
            if folded != Folded::NotFinite {
                folded = one;
            }
        }
        folded
    }

    pub fn program(self) -> Program {
        Program { instructions: self.code }
    }
}

/// What a reference is while parameters are left open.
pub enum Open {
    /// The variable of a function.
    Variable,
    /// A slot.
    Slot(usize),
    /// A number in SI units.
    Value(f64),
}

impl Expression {
    /// The same with slots in place of some references. Dimensions are not looked at: [`Expression::lower`] did that. None
    /// where `open` knows a reference not, or the expression holds too much at once.
    pub fn open(&self, open: &mut dyn FnMut(&Reference) -> Option<Open>) -> Option<Function> {
        let mut emitter = Emitter::default();
        for item in &self.items {
            match &item.node {
                Node::Number(value, _) => emitter.push(Instruction::Constant(*value)),
                Node::Reference(reference) => emitter.push(match open(reference)? {
                    Open::Variable => Instruction::Variable,
                    Open::Slot(slot) => Instruction::Slot(slot),
                    Open::Value(value) => Instruction::Constant(value),
                }),
                Node::Negate => {
                    emitter.apply(Instruction::Negate, 1);
                }
                Node::Binary(Binary::Power) => {
                    emitter.power();
                }
                Node::Binary(binary) => {
                    emitter.apply(Instruction::Binary(*binary), 2);
                }
                Node::Call(call, count) => {
                    emitter.call(*call, *count);
                }
            }
        }
        let program = emitter.program();
        (program.depth() <= STACK).then(|| Function { text: self.text.clone(), program })
    }
}

impl Program {
    /// The same with numbers in place of the slots.
    pub(crate) fn bound(&self, slots: &[f64]) -> Program {
        let mut emitter = Emitter::default();
        for instruction in &self.instructions {
            match *instruction {
                Instruction::Slot(slot) => {
                    emitter.push(Instruction::Constant(slots.get(slot).copied().unwrap_or(f64::NAN)));
                }
                Instruction::Constant(_) | Instruction::Variable => emitter.push(*instruction),
                Instruction::Negate | Instruction::WholePower(_) | Instruction::Call1(_) => {
                    emitter.apply(*instruction, 1);
                }
                Instruction::Binary(Binary::Power) => {
                    emitter.power();
                }
                Instruction::Binary(_) | Instruction::Call2(_) => {
                    emitter.apply(*instruction, 2);
                }
            }
        }
        emitter.program()
    }
}

impl Function {
    /// The same with numbers in place of its slots.
    pub fn bound(&self, slots: &[f64]) -> Function {
        Function { text: self.text.clone(), program: self.program.bound(slots) }
    }

    /// Itself as a formula over its slots; where its variable stands, the formula has no value.
    pub fn formula(self) -> Formula {
        let instructions = self.program.instructions.into_iter().map(|instruction| match instruction {
            Instruction::Variable => Instruction::Constant(f64::NAN),
            other => other,
        });
        Formula { text: self.text, program: Program { instructions: instructions.collect() } }
    }

    /// The numbers of its slots, each as often as it stands there.
    pub fn slots(&self) -> impl Iterator<Item = usize> + '_ {
        self.program.slots()
    }
}
