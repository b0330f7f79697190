//! Builds a formula with operators on copyable handles.

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Sub};

use crate::formula::node::{Samples, Variable};
use crate::formula::{
    Assignment, CirclePart, Formula, Function, MOST_SAMPLES, Name, Node, NodeId, OffsetCorrection,
    Op, ResultDef, Role,
};
use crate::num::tidy;

/// A formula under construction. Its expressions add their nodes to it.
#[derive(Debug, Default)]
pub struct Draft(RefCell<Formula>);

/// An expression of a draft.
#[derive(Clone, Copy, Debug)]
pub struct Expr<'f> {
    draft: &'f Draft,
    pub(super) node: NodeId,
}

/// A named value of a draft, returned by [`Draft::set`].
#[derive(Clone, Copy, Debug)]
pub struct Value<'f> {
    draft: &'f Draft,
    pub variable: Variable,
}

impl Draft {
    /// An empty draft with capacity for the usual number of nodes for so many touches.
    pub fn with_room_for(touches: usize) -> Self {
        let (nodes, assignments) = (
            Vec::with_capacity(64 * touches + 16),
            Vec::with_capacity(10 * touches + 8),
        );
        Draft(RefCell::new(Formula {
            nodes,
            assignments,
            ..Formula::default()
        }))
    }

    /// A draft that continues an existing formula.
    pub(super) fn continuing(formula: Formula) -> Self {
        Draft(RefCell::new(formula))
    }

    /// Handle of a value that already has a name.
    pub(super) fn known(&self, variable: Variable) -> Value<'_> {
        Value {
            draft: self,
            variable,
        }
    }

    /// A result that was stated before.
    pub(super) fn result_at(&self, index: usize) -> ResultDef {
        self.0.borrow().results[index].clone()
    }

    /// Adds a node. Not inlined: it has many callers, and inlining made the module larger.
    #[inline(never)]
    pub(super) fn push(&self, node: Node) -> Expr<'_> {
        let nodes = &mut self.0.borrow_mut().nodes;
        nodes.push(node);
        Expr {
            draft: self,
            node: NodeId(nodes.len() as u32 - 1),
        }
    }

    /// A number without a unit.
    pub fn number(&self, number: f64) -> Expr<'_> {
        self.push(Node::Number(number))
    }

    /// A length in mm.
    pub fn length(&self, mm: f64) -> Expr<'_> {
        self.push(Node::Length(mm))
    }

    /// Coordinate `axis` of the trigger point of a sample.
    pub fn trigger(&self, sample: usize, axis: usize) -> Expr<'_> {
        debug_assert!(axis < 3, "axis {axis}");
        self.push(Node::Trigger {
            sample: sample as u16,
            axis: axis as u8,
        })
    }

    /// A part of the circle fitted to `count` samples from `first` on, in the plane of these axes.
    pub fn circle(
        &self,
        (first, count): (usize, usize),
        axes: (usize, usize),
        part: CirclePart,
    ) -> Expr<'_> {
        debug_assert!(
            first + count <= MOST_SAMPLES,
            "samples {first} and {count} more"
        );
        let samples = Samples {
            first: first as u16,
            count: count as u8,
            axes: (axes.0 as u8, axes.1 as u8),
        };
        self.push(Node::Circle(samples, part))
    }

    /// Sum of the expressions in order; 0 for an empty list.
    pub fn sum<'f, T: Into<Expr<'f>>>(&'f self, parts: impl Iterator<Item = T>) -> Expr<'f> {
        parts
            .map(Into::into)
            .reduce(|sum, part| sum + part)
            .unwrap_or_else(|| self.number(0.0))
    }

    /// Component of the point (a, o) along a constant direction: `a · along.0 + o · along.1`, with ±1 and 0 simplified.
    pub fn project<'f>(
        &'f self,
        a: impl Into<Expr<'f>>,
        o: impl Into<Expr<'f>>,
        along: (f64, f64),
    ) -> Expr<'f> {
        let [a, o] = [(a.into(), tidy(along.0)), (o.into(), tidy(along.1))];
        let ((first, c1), (second, c2)) = if a.1 < 0.0 { (o, a) } else { (a, o) };
        let begin = if c1 == 0.0 && c2 < 0.0 {
            self.length(0.0)
        } else {
            first * self.number(c1)
        };
        let rest = second * self.number(c2.abs());
        if c2 < 0.0 { begin - rest } else { begin + rest }
    }

    /// Names a value and returns its handle.
    pub fn set<'f>(&'f self, name: impl Into<Name>, expr: impl Into<Expr<'f>>) -> Value<'f> {
        self.assign(name.into(), expr.into().node)
    }

    pub(super) fn assign(&self, name: Name, node: NodeId) -> Value<'_> {
        let assignments = &mut self.0.borrow_mut().assignments;
        assignments.push(Assignment {
            name,
            cycle: 0,
            node,
        });
        Value {
            draft: self,
            variable: Variable(assignments.len() as u32 - 1),
        }
    }

    /// States a result. Its value is `None` if these touches cannot give it.
    pub fn result(
        &self,
        code: &'static str,
        role: Role,
        meaning: &'static str,
        nominal: f64,
        value: Option<Value<'_>>,
    ) {
        let (variable, nominal) = (value.map(|value| value.variable), tidy(nominal));
        self.0.borrow_mut().results.push(ResultDef {
            code,
            cycle: 0,
            meaning,
            role,
            nominal,
            reference: nominal,
            variable,
            tolerance: None,
            limit: None,
        });
    }

    /// Sets the value from which the deviation of the last result is counted.
    pub fn referred_to(&self, reference: f64) {
        if let Some(last) = self.0.borrow_mut().results.last_mut() {
            last.reference = reference;
        }
    }

    /// Gives the last result its own limit, mm.
    pub fn limited(&self, limit: Option<f64>) {
        if let Some(last) = self.0.borrow_mut().results.last_mut() {
            last.limit = limit;
        }
    }

    /// Finishes the formula. `datum` corrects a work offset.
    pub fn finish(self, datum: Option<OffsetCorrection>) -> Formula {
        Formula {
            datum,
            ..self.0.into_inner()
        }
    }

    /// Combines two expressions. Constants are folded (0 · x, 1 · x, x + 0), so that the formula of an unrotated feature is as short as one written by hand.
    fn binary(&self, op: Op, left: NodeId, right: NodeId) -> Expr<'_> {
        let is = |node: Node, number: f64| matches!(node, Node::Number(x) | Node::Length(x) if x == number);
        let [a, b] = [left, right].map(|id| self.0.borrow().node(id));
        match (op, a, b) {
            (Op::Add | Op::Subtract, _, b) if is(b, 0.0) => self.of(left),
            (Op::Add, a, _) if is(a, 0.0) => self.of(right),
            (Op::Add | Op::Subtract, Node::Length(a), Node::Length(b)) => self.length(op.of(a, b)),
            (Op::Add, _, Node::Length(b)) if b < 0.0 => {
                self.binary(Op::Subtract, left, self.length(-b).node)
            }
            (Op::Subtract, _, Node::Length(b)) if b < 0.0 => {
                self.binary(Op::Add, left, self.length(-b).node)
            }
            (Op::Multiply, a, b) if is(a, 0.0) || is(b, 1.0) => self.of(left),
            (Op::Multiply, a, b) if is(b, 0.0) || is(a, 1.0) => self.of(right),
            (Op::Multiply, Node::Number(a), Node::Number(b)) => self.number(a * b),
            (Op::Divide, _, b) if is(b, 1.0) => self.of(left),
            _ => self.push(Node::Binary(op, left, right)),
        }
    }

    fn of(&self, node: NodeId) -> Expr<'_> {
        Expr { draft: self, node }
    }
}

impl<'f> From<Value<'f>> for Expr<'f> {
    fn from(value: Value<'f>) -> Expr<'f> {
        value.draft.push(Node::Variable(value.variable))
    }
}

impl<'f> Value<'f> {
    /// Sine of degrees.
    pub fn sin(self) -> Expr<'f> {
        Expr::from(self).sin()
    }

    /// Cosine of degrees.
    pub fn cos(self) -> Expr<'f> {
        Expr::from(self).cos()
    }

    /// Angle of the vector (x, self), degrees.
    pub fn atan2(self, x: impl Into<Expr<'f>>) -> Expr<'f> {
        Expr::from(self).atan2(x)
    }
}

impl<'f> Expr<'f> {
    /// Sine of degrees.
    pub fn sin(self) -> Expr<'f> {
        self.call(Function::Sin)
    }

    /// Cosine of degrees.
    pub fn cos(self) -> Expr<'f> {
        self.call(Function::Cos)
    }

    pub fn abs(self) -> Expr<'f> {
        self.call(Function::Abs)
    }

    pub fn sqrt(self) -> Expr<'f> {
        self.call(Function::Sqrt)
    }

    /// Angle of the vector (x, self), degrees.
    pub fn atan2(self, x: impl Into<Expr<'f>>) -> Expr<'f> {
        self.draft.push(Node::Atan2(self.node, x.into().node))
    }

    fn call(self, function: Function) -> Expr<'f> {
        self.draft.push(Node::Call(function, self.node))
    }

    fn binary(self, op: Op, other: Expr<'f>) -> Expr<'f> {
        debug_assert!(
            std::ptr::eq(self.draft, other.draft),
            "an expression of another formula"
        );
        self.draft.binary(op, self.node, other.node)
    }
}

/// Implements an operator for expressions and named values.
macro_rules! operator {
    ($trait:ident, $method:ident, $op:expr) => {
        impl<'f, R: Into<Expr<'f>>> $trait<R> for Expr<'f> {
            type Output = Expr<'f>;
            fn $method(self, other: R) -> Expr<'f> {
                self.binary($op, other.into())
            }
        }

        impl<'f, R: Into<Expr<'f>>> $trait<R> for Value<'f> {
            type Output = Expr<'f>;
            fn $method(self, other: R) -> Expr<'f> {
                Expr::from(self).binary($op, other.into())
            }
        }
    };
}
operator!(Add, add, Op::Add);
operator!(Sub, sub, Op::Subtract);
operator!(Mul, mul, Op::Multiply);
operator!(Div, div, Op::Divide);

#[cfg(test)]
mod tests {
    use super::*;

    /// An expression as text in Polish notation.
    fn shown(draft: &Draft, id: NodeId) -> String {
        let node = draft.0.borrow().node(id);
        match node {
            Node::Binary(op, a, b) => format!("({op:?} {} {})", shown(draft, a), shown(draft, b)),
            Node::Trigger { sample, axis } => format!("t{sample}{axis}"),
            other => format!("{other:?}"),
        }
    }

    #[test]
    fn plain_terms_fold() {
        let f = Draft::default();
        let (a, o) = (f.trigger(0, 0), f.trigger(0, 1));
        for (expr, text) in [
            (f.project(a, o, (1.0, 6e-17)), "t00"),
            (f.project(a, o, (-1e-16, 1.0)), "t01"),
            (f.project(a, o, (-1.0, 0.0)), "(Subtract Length(0.0) t00)"),
            (
                f.project(a, o, (-0.6, 0.8)),
                "(Subtract (Multiply t01 Number(0.8)) (Multiply t00 Number(0.6)))",
            ),
            (a + f.length(-3.0), "(Subtract t00 Length(3.0))"),
            (a - f.length(-3.0), "(Add t00 Length(3.0))"),
            (a * f.number(1.0) / f.number(1.0), "t00"),
            (a * f.number(0.0) + o, "t01"),
            (f.length(2.0) + f.length(-3.0), "Length(-1.0)"),
            (f.number(0.0) - f.length(-3.0), "Length(3.0)"),
            (f.number(2.0) * f.number(-3.0), "Number(-6.0)"),
            // All other expressions are written unfolded, so that the program shows the arithmetic.
            (
                f.number(2.0) - f.number(3.0),
                "(Subtract Number(2.0) Number(3.0))",
            ),
        ] {
            assert_eq!(shown(&f, expr.node), text);
        }
    }
}
