//! Is a formula a polynomial of some of its slots, and of which degree?

use crate::expression::Binary;
use crate::program::{Instruction, Program, STACK};

/// Higher degrees need not be told apart.
const MOST: u32 = 1_000;

impl Program {
    /// The degree in the slots that move, the others and the variable being constants; None where it is no polynomial.
    pub(crate) fn degree(&self, moving: &dyn Fn(usize) -> bool) -> Option<u32> {
        let mut stack = [0u32; STACK];
        let mut top = 0;
        for instruction in &self.instructions {
            match *instruction {
                Instruction::Constant(_) | Instruction::Variable => {
                    stack[top] = 0;
                    top += 1;
                }
                Instruction::Slot(slot) => {
                    stack[top] = u32::from(moving(slot));
                    top += 1;
                }
                Instruction::Negate => {}
                Instruction::WholePower(power) => match (stack[top - 1], u32::try_from(power)) {
                    (0, _) => {}
                    (degree, Ok(power)) => stack[top - 1] = (degree * power).min(MOST),
                    (_, Err(_)) => return None,
                },
                Instruction::Call1(_) if stack[top - 1] == 0 => {}
                Instruction::Call1(_) => return None,
                Instruction::Binary(binary) => {
                    top -= 1;
                    let (a, b) = (stack[top - 1], stack[top]);
                    stack[top - 1] = match binary {
                        Binary::Add | Binary::Subtract => a.max(b),
                        Binary::Multiply => (a + b).min(MOST),
                        Binary::Divide if b == 0 => a,
                        Binary::Power if a == 0 && b == 0 => 0,
                        Binary::Divide | Binary::Power => return None,
                    };
                }
                Instruction::Call2(_) => {
                    top -= 1;
                    if stack[top - 1] != 0 || stack[top] != 0 {
                        return None;
                    }
                }
            }
        }
        Some(stack[0])
    }
}
