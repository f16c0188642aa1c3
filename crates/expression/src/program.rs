//! The compiled form: instructions for a small stack machine, on numbers or on jets.

use crate::expression::{Binary, Call};
use crate::jet::Jet;

/// Deepest stack; keeps evaluation free of allocation.
pub(crate) const STACK: usize = 32;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Instruction {
    Constant(f64),
    Variable,
    Slot(usize),
    Negate,
    Binary(Binary),
    /// Power with a constant whole exponent.
    WholePower(i32),
    /// Of one argument.
    Call1(Call),
    /// Of two arguments.
    Call2(Call),
}

/// Values that programs compute with.
pub(crate) trait Number: Copy {
    fn constant(value: f64) -> Self;
    fn negate(self) -> Self;
    fn binary(binary: Binary, a: Self, b: Self) -> Self;
    fn whole_power(self, exponent: i32) -> Self;
    fn call1(call: Call, a: Self) -> Self;
    fn call2(call: Call, a: Self, b: Self) -> Self;
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    fn negate(self) -> Self {
        -self
    }

    fn binary(binary: Binary, a: f64, b: f64) -> f64 {
        match binary {
            Binary::Add => a + b,
            Binary::Subtract => a - b,
            Binary::Multiply => a * b,
            Binary::Divide => a / b,
            // As a constant exponent has it that is known beforehand.
            Binary::Power if b.fract() == 0.0 && b.abs() <= 64.0 => a.powi(b as i32),
            Binary::Power => a.powf(b),
        }
    }

    fn whole_power(self, exponent: i32) -> f64 {
        self.powi(exponent)
    }

    fn call1(call: Call, a: f64) -> f64 {
        match call {
            Call::Sin => a.sin(),
            Call::Cos => a.cos(),
            Call::Tan => a.tan(),
            Call::Asin => a.asin(),
            Call::Acos => a.acos(),
            Call::Atan => a.atan(),
            Call::Sinh => a.sinh(),
            Call::Cosh => a.cosh(),
            Call::Tanh => a.tanh(),
            Call::Exp => a.exp(),
            Call::Ln => a.ln(),
            Call::Log10 => a.log10(),
            Call::Sqrt => a.sqrt(),
            Call::Cbrt => a.cbrt(),
            Call::Abs => a.abs(),
            Call::Sign if a == 0.0 => 0.0,
            Call::Sign => a.signum(),
            Call::Atan2 | Call::Min | Call::Max | Call::Hypot => f64::NAN,
        }
    }

    fn call2(call: Call, a: f64, b: f64) -> f64 {
        match call {
            Call::Atan2 => a.atan2(b),
            // Unlike f64::min, a NaN is passed on.
            Call::Min => {
                if a.is_nan() || a < b {
                    a
                } else {
                    b
                }
            }
            Call::Max => {
                if a.is_nan() || a > b {
                    a
                } else {
                    b
                }
            }
            Call::Hypot => a.hypot(b),
            _ => f64::NAN,
        }
    }
}

/// A checked list of instructions that leaves one value on the stack.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Program {
    pub(crate) instructions: Vec<Instruction>,
}

impl Program {
    pub(crate) fn constant(value: f64) -> Self {
        Self { instructions: vec![Instruction::Constant(value)] }
    }

    pub(crate) fn as_constant(&self) -> Option<f64> {
        match self.instructions.as_slice() {
            [Instruction::Constant(value)] => Some(*value),
            _ => None,
        }
    }

    /// The slots, each as often as it stands there.
    pub(crate) fn slots(&self) -> impl Iterator<Item = usize> + '_ {
        self.instructions.iter().filter_map(|instruction| match instruction {
            Instruction::Slot(slot) => Some(*slot),
            _ => None,
        })
    }

    /// The greatest number of values on the stack.
    pub(crate) fn depth(&self) -> usize {
        let mut now = 0usize;
        let mut most = 0;
        for instruction in &self.instructions {
            match instruction {
                Instruction::Constant(_) | Instruction::Variable | Instruction::Slot(_) => now += 1,
                Instruction::Binary(_) | Instruction::Call2(_) => now = now.saturating_sub(1),
                Instruction::Negate | Instruction::WholePower(_) | Instruction::Call1(_) => {}
            }
            most = most.max(now);
        }
        most
    }

    pub(crate) fn run<T: Number>(&self, variable: T, slots: &[T]) -> T {
        if let [Instruction::Constant(value)] = self.instructions.as_slice() {
            return T::constant(*value);
        }
        let mut stack = [T::constant(0.0); STACK];
        let mut top = 0;
        for instruction in &self.instructions {
            match *instruction {
                Instruction::Constant(value) => {
                    stack[top] = T::constant(value);
                    top += 1;
                }
                Instruction::Variable => {
                    stack[top] = variable;
                    top += 1;
                }
                Instruction::Slot(slot) => {
                    stack[top] = slots.get(slot).copied().unwrap_or(T::constant(f64::NAN));
                    top += 1;
                }
                Instruction::Negate => stack[top - 1] = stack[top - 1].negate(),
                Instruction::WholePower(exponent) => stack[top - 1] = stack[top - 1].whole_power(exponent),
                Instruction::Call1(call) => stack[top - 1] = T::call1(call, stack[top - 1]),
                Instruction::Binary(binary) => {
                    top -= 1;
                    stack[top - 1] = T::binary(binary, stack[top - 1], stack[top]);
                }
                Instruction::Call2(call) => {
                    top -= 1;
                    stack[top - 1] = T::call2(call, stack[top - 1], stack[top]);
                }
            }
        }
        stack[0]
    }
}

impl Number for Jet {
    fn constant(value: f64) -> Self {
        Jet::constant(value)
    }

    fn negate(self) -> Self {
        self.scale(-1.0)
    }

    fn binary(binary: Binary, a: Self, b: Self) -> Self {
        match binary {
            Binary::Add => a.add(b),
            Binary::Subtract => a.add(b.scale(-1.0)),
            Binary::Multiply => a.multiply(b),
            Binary::Divide => a.divide(b),
            Binary::Power => a.power(b),
        }
    }

    fn whole_power(self, exponent: i32) -> Self {
        Jet::whole_power(self, exponent)
    }

    fn call1(call: Call, a: Self) -> Self {
        a.call1(call)
    }

    fn call2(call: Call, a: Self, b: Self) -> Self {
        a.call2(call, b)
    }
}
