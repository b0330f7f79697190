//! Prints an expression in the RS274 family's way: square brackets, named parameters, degrees.

use crate::formula::{Expr, Formula, Function, Op};
use crate::num::decimal;

/// Prints `expr` of `formula`. `scale` is the millimetres in a unit of the program.
pub fn print(formula: &Formula, expr: &Expr, scale: f64) -> String {
    let mut text = String::new();
    Printer { formula, scale }.put(expr, 0, &mut text);
    text
}

/// The name of the parameter that holds coordinate `axis` of a touch's trigger.
pub fn trigger_name(touch: usize, axis: usize) -> String {
    format!("{}{}", ["x", "y", "z"][axis], touch + 1)
}

struct Printer<'a> {
    formula: &'a Formula,
    scale: f64,
}

impl Printer<'_> {
    /// `binding` is how tightly the surroundings bind: 0 not at all, 1 as a sum, 2 as a product, 3 as what follows − or /.
    fn put(&self, expr: &Expr, binding: u8, out: &mut String) {
        match expr {
            Expr::Number(x) => self.constant(*x, binding, out),
            Expr::Length(x) => self.constant(x / self.scale, binding, out),
            Expr::Variable(index) => self.name(&self.formula.assignments[*index].name, out),
            Expr::Trigger { touch, axis } => self.name(&trigger_name(*touch, *axis), out),
            Expr::Call(function, a) => {
                out.push_str(match function {
                    Function::Sin => "SIN[",
                    Function::Cos => "COS[",
                    Function::Sqrt => "SQRT[",
                });
                self.put(a, 0, out);
                out.push(']');
            }
            Expr::Circle { .. } => unreachable!("programs get the plain formula"),
            Expr::Atan2(y, x) => {
                out.push_str("ATAN[");
                self.put(y, 0, out);
                out.push_str("]/[");
                self.put(x, 0, out);
                out.push(']');
            }
            Expr::Binary(op, a, b) => {
                let (sign, own, right) = match op {
                    Op::Add => ('+', 1, 1),
                    Op::Subtract => ('-', 1, 2),
                    Op::Multiply => ('*', 2, 2),
                    Op::Divide => ('/', 2, 3),
                };
                let bracket = own < binding;
                if bracket {
                    out.push('[');
                }
                self.put(a, own, out);
                out.push(sign);
                self.put(b, right, out);
                if bracket {
                    out.push(']');
                }
            }
        }
    }

    fn name(&self, name: &str, out: &mut String) {
        out.push_str("#<");
        out.push_str(name);
        out.push('>');
    }

    /// A constant with 12 decimals at most: half a turn of a 10 m part moves by less than 1e-8 mm.
    fn constant(&self, x: f64, binding: u8, out: &mut String) {
        let text = decimal(x, 12);
        if text.starts_with('-') && binding > 0 {
            out.push_str(&format!("[{text}]"));
        } else {
            out.push_str(&text);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_only_where_they_are_needed() {
        let mut f = Formula::default();
        let a = f.set("a", Expr::trigger(0, 0));
        let b = f.set("b", Expr::trigger(1, 2));
        let shown = |e: &Expr| print(&f, e, 25.4);
        assert_eq!(shown(&Expr::trigger(1, 2)), "#<z2>");
        assert_eq!(shown(&((a.clone() + b.clone()) / Expr::Number(2.0))), "[#<a>+#<b>]/2");
        assert_eq!(shown(&(a.clone() - (b.clone() - Expr::Length(25.4)))), "#<a>-[#<b>-1]");
        assert_eq!(shown(&(a.clone() * Expr::Number(-0.5))), "#<a>*[-0.5]");
        assert_eq!(shown(&(a.clone() / (b.clone() * a.clone()))), "#<a>/[#<b>*#<a>]");
        assert_eq!(shown(&(a.clone().atan2(b.clone()) / Expr::Number(2.0)).sin()), "SIN[ATAN[#<a>]/[#<b>]/2]");
    }
}
