//! Prints an expression in the notation of a control, with its brackets and names; angles in degrees.

use crate::formula::{Formula, Function, Name, Node, NodeId, Op, Variable};
use crate::num::{push_count, push_decimal};
use crate::path::ShiftTerm;

/// Notation of expressions.
pub trait Notation {
    /// Grouping brackets.
    const BRACKETS: (char, char);
    /// Writes the value of an assignment of `formula`, by its index.
    fn variable(&self, formula: &Formula, index: usize, out: &mut String);
    /// Writes coordinate `axis` of a sample's trigger.
    fn trigger(&self, sample: usize, axis: usize, out: &mut String);
    /// Texts before, between and after the two operands of the angle of the vector (x, y), y first.
    const ATAN: [&'static str; 3];
    /// Largest number of decimals of a constant: with 12, half a turn of a 10 m part moves by less than 1e-8 mm.
    fn decimals(&self, _x: f64) -> usize {
        12
    }
}

/// Appends a node of `formula` to a text. `scale` is mm in a unit of the program.
pub fn print_to<N: Notation>(
    text: &mut String,
    notation: &N,
    formula: &Formula,
    node: NodeId,
    scale: f64,
) {
    Printer {
        notation,
        formula,
        scale,
    }
    .put(node, 0, text);
}

/// Name of an assignment's value in the notation of a control.
pub fn variable<N: Notation>(notation: &N, formula: &Formula, variable: Variable) -> String {
    let mut text = String::new();
    notation.variable(formula, variable.index(), &mut text);
    text
}

/// Largest number of decimals of such a factor: a block must not be longer than controls read, and the multiplied value is small.
const SHIFT_DECIMALS: usize = 10;

/// Term that shifts a position: `+#<bore_shift_x>`, `-0.5*R13`. `scale` is mm in a unit of the program.
pub fn shift<N: Notation>(
    notation: &N,
    formula: &Formula,
    terms: &[ShiftTerm],
    scale: f64,
) -> String {
    let mut text = String::new();
    for ShiftTerm {
        by, factor, length, ..
    } in terms
    {
        text.push(if *factor < 0.0 { '-' } else { '+' });
        let size = factor.abs() / if *length { scale } else { 1.0 };
        if size != 1.0 || *length {
            push_decimal(&mut text, size, notation.decimals(size).min(SHIFT_DECIMALS));
            text.push('*');
        }
        notation.variable(formula, by.index(), &mut text);
    }
    text
}

/// The RS274 family: square brackets, named parameters.
#[derive(Debug)]
pub struct Rs274;

/// `ATAN[y]/[x]`.
pub const ATAN_OF_TWO: [&str; 3] = ["ATAN[", "]/[", "]"];

impl Notation for Rs274 {
    const BRACKETS: (char, char) = ('[', ']');
    const ATAN: [&'static str; 3] = ATAN_OF_TWO;

    fn variable(&self, formula: &Formula, index: usize, out: &mut String) {
        out.push_str("#<");
        formula.push_name(index, out);
        out.push('>');
    }

    fn trigger(&self, sample: usize, axis: usize, out: &mut String) {
        out.push_str("#<");
        out.push_str(AXES[axis]);
        push_count(out, sample + 1);
        out.push('>');
    }
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// Name of the parameter with coordinate `axis` of a sample's trigger.
pub fn trigger_name(sample: usize, axis: usize) -> Name {
    Name::new(AXES[axis], sample + 1)
}

struct Printer<'a, N> {
    notation: &'a N,
    formula: &'a Formula,
    scale: f64,
}

impl<N: Notation> Printer<'_, N> {
    /// `binding` is the binding strength of the context: 0 none, 1 a sum, 2 a product, 3 an operand after − or /.
    fn put(&self, node: NodeId, binding: u8, out: &mut String) {
        match self.formula.node(node) {
            Node::Number(x) => self.constant(x, binding, out),
            Node::Length(x) => self.constant(x / self.scale, binding, out),
            Node::Variable(variable) => self.notation.variable(self.formula, variable.index(), out),
            Node::Trigger { sample, axis } => {
                self.notation
                    .trigger(usize::from(sample), usize::from(axis), out)
            }
            Node::Call(function, a) => {
                out.push_str(match function {
                    Function::Sin => "SIN",
                    Function::Cos => "COS",
                    Function::Sqrt => "SQRT",
                    Function::Abs => "ABS",
                });
                out.push(N::BRACKETS.0);
                self.put(a, 0, out);
                out.push(N::BRACKETS.1);
            }
            Node::Circle(..) => unreachable!("programs get the plain formula"),
            Node::Atan2(y, x) => {
                out.push_str(N::ATAN[0]);
                self.put(y, 0, out);
                out.push_str(N::ATAN[1]);
                self.put(x, 0, out);
                out.push_str(N::ATAN[2]);
            }
            Node::Binary(op, a, b) => {
                let (sign, own, right) = match op {
                    Op::Add => ('+', 1, 1),
                    Op::Subtract => ('-', 1, 2),
                    Op::Multiply => ('*', 2, 2),
                    Op::Divide => ('/', 2, 3),
                };
                let bracket = own < binding;
                if bracket {
                    out.push(N::BRACKETS.0);
                }
                self.put(a, own, out);
                out.push(sign);
                self.put(b, right, out);
                if bracket {
                    out.push(N::BRACKETS.1);
                }
            }
        }
    }

    /// A constant, in brackets if it has a sign after another sign.
    fn constant(&self, x: f64, binding: u8, out: &mut String) {
        let begin = out.len();
        push_decimal(out, x, self.notation.decimals(x));
        if binding > 0 && out[begin..].starts_with('-') {
            out.insert(begin, N::BRACKETS.0);
            out.push(N::BRACKETS.1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Draft;

    #[test]
    fn brackets_only_where_they_are_needed() {
        let f = Draft::default();
        let a = f.set("a", f.trigger(0, 0));
        let b = f.set("b", f.trigger(1, 2));
        let expressions = [
            (a + b) / f.number(2.0),
            a - (b - f.length(25.4)),
            a * f.number(-0.5),
            a / (b * a),
            (a.atan2(b) / f.number(2.0)).sin(),
        ];
        for expr in expressions {
            f.set("shown", expr);
        }
        let formula = f.finish(None);
        let mut texts = Vec::new();
        for assignment in &formula.assignments[1..] {
            texts.push(String::new());
            print_to(
                texts.last_mut().unwrap(),
                &Rs274,
                &formula,
                assignment.node,
                25.4,
            );
        }
        let expected = [
            "#<z2>",
            "[#<a>+#<b>]/2",
            "#<a>-[#<b>-1]",
            "#<a>*[-0.5]",
            "#<a>/[#<b>*#<a>]",
            "SIN[ATAN[#<a>]/[#<b>]/2]",
        ];
        assert_eq!(texts, expected);
    }
}
