//! How a formula is written: with operators, on copies of a handle.

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Sub};

use crate::formula::node::{Fitted, Variable};
use crate::formula::{Assignment, CirclePart, Datum, Formula, Function, MOST_SAMPLES, Name, Node, NodeId, Op, ResultDef, Role};
use crate::num::tidy;

/// A formula that is being written. Its expressions put their nodes into it.
#[derive(Debug, Default)]
pub struct Draft(RefCell<Formula>);

/// An expression of a draft. Constants stand beside the list until something is made of them and a node.
#[derive(Clone, Copy, Debug)]
pub enum Expr<'f> {
    /// A pure number.
    Number(f64),
    /// A length in mm.
    Length(f64),
    /// Anything else.
    Node(&'f Draft, NodeId),
}

/// A named value of a draft: what [`Draft::set`] gives.
#[derive(Clone, Copy, Debug)]
pub struct Value<'f> {
    draft: &'f Draft,
    pub(super) node: NodeId,
    /// Which assignment it is.
    pub variable: Variable,
}

impl Draft {
    /// An empty one, with room for what is usually computed from so many touches.
    pub fn with_room_for(touches: usize) -> Self {
        let (nodes, assignments) = (Vec::with_capacity(48 * touches + 16), Vec::with_capacity(10 * touches + 8));
        Draft(RefCell::new(Formula { nodes, assignments, ..Formula::default() }))
    }

    pub(super) fn push(&self, node: Node) -> NodeId {
        let nodes = &mut self.0.borrow_mut().nodes;
        nodes.push(node);
        NodeId(nodes.len() as u32 - 1)
    }

    /// Coordinate `axis` of the trigger of a sample.
    pub fn trigger(&self, sample: usize, axis: usize) -> Expr<'_> {
        debug_assert!(sample < MOST_SAMPLES && axis < 3, "sample {sample}, axis {axis}");
        Expr::Node(self, self.push(Node::Trigger { sample: sample as u8, axis: axis as u8 }))
    }

    /// A part of the circle fitted to `count` samples from `first` on, in the plane of these axes.
    pub fn circle(&self, (first, count): (usize, usize), axes: (usize, usize), part: CirclePart) -> Expr<'_> {
        debug_assert!(first + count <= MOST_SAMPLES, "samples {first} and {count} more");
        let fitted = Fitted { first: first as u8, count: count as u8, axes: (axes.0 as u8, axes.1 as u8) };
        Expr::Node(self, self.push(Node::Circle(fitted, part)))
    }

    /// `a - b`, where that of two constants is to be written and not computed.
    pub fn difference<'f>(&'f self, a: Expr<'f>, b: Expr<'f>) -> Expr<'f> {
        if b.is(0.0) { a } else { Expr::Node(self, a.node(self)) - b }
    }

    /// Names a value and gives its handle.
    pub fn set<'f>(&'f self, name: impl Into<Name>, expr: impl Into<Expr<'f>>) -> Value<'f> {
        let node = expr.into().node(self);
        self.assign(name.into(), node)
    }

    pub(super) fn assign(&self, name: Name, node: NodeId) -> Value<'_> {
        let mut formula = self.0.borrow_mut();
        let (variable, own) = (Variable(formula.assignments.len() as u32), NodeId(formula.nodes.len() as u32));
        formula.assignments.push(Assignment { name, node });
        formula.nodes.push(Node::Variable(variable));
        Value { draft: self, node: own, variable }
    }

    /// States a result; none where these touches cannot give it.
    pub fn result(&self, code: &'static str, role: Role, meaning: &'static str, nominal: f64, value: Option<Value<'_>>) {
        let (variable, nominal) = (value.map(|value| value.variable), tidy(nominal));
        self.0.borrow_mut().results.push(ResultDef { code, meaning, role, nominal, reference: nominal, variable });
    }

    /// The deviation of the last result is measured from here.
    pub fn referred_to(&self, reference: f64) {
        if let Some(last) = self.0.borrow_mut().results.last_mut() {
            last.reference = reference;
        }
    }

    /// The formula, and what a work offset is corrected by.
    pub fn finish(self, datum: Option<Datum>) -> Formula {
        Formula { datum, ..self.0.into_inner() }
    }
}

impl<'f> From<Value<'f>> for Expr<'f> {
    fn from(value: Value<'f>) -> Expr<'f> {
        Expr::Node(value.draft, value.node)
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

    /// The angle of the vector (x, self), degrees.
    pub fn atan2(self, x: impl Into<Expr<'f>>) -> Expr<'f> {
        Expr::from(self).atan2(x)
    }
}

impl<'f> Expr<'f> {
    /// The sum of these, in their order; 0 of none.
    pub fn sum<T: Into<Expr<'f>>>(parts: impl Iterator<Item = T>) -> Expr<'f> {
        parts.map(Into::into).reduce(|sum, part| sum + part).unwrap_or(Expr::Number(0.0))
    }

    /// Sine of degrees.
    pub fn sin(self) -> Expr<'f> {
        self.call(Function::Sin)
    }

    /// Cosine of degrees.
    pub fn cos(self) -> Expr<'f> {
        self.call(Function::Cos)
    }

    /// Square root.
    pub fn sqrt(self) -> Expr<'f> {
        self.call(Function::Sqrt)
    }

    /// The angle of the vector (x, self), degrees.
    pub fn atan2(self, x: impl Into<Expr<'f>>) -> Expr<'f> {
        let x = x.into();
        match (self.draft().or(x.draft()), self.constant(), x.constant()) {
            (Some(draft), ..) => Expr::Node(draft, draft.push(Node::Atan2(self.node(draft), x.node(draft)))),
            (None, y, x) => Expr::Number(y.atan2(x).to_degrees()),
        }
    }

    fn call(self, function: Function) -> Expr<'f> {
        match self {
            Expr::Node(draft, node) => Expr::Node(draft, draft.push(Node::Call(function, node))),
            Expr::Number(x) | Expr::Length(x) => Expr::Number(function.of(x)),
        }
    }

    fn binary(self, op: Op, other: Expr<'f>) -> Expr<'f> {
        match self.draft().or(other.draft()) {
            Some(draft) => Expr::Node(draft, draft.push(Node::Binary(op, self.node(draft), other.node(draft)))),
            None => {
                let value = op.of(self.constant(), other.constant());
                let lengths = [self, other].iter().filter(|part| matches!(part, Expr::Length(_))).count();
                if lengths == 1 || lengths == 2 && op != Op::Divide { Expr::Length(value) } else { Expr::Number(value) }
            }
        }
    }

    fn draft(self) -> Option<&'f Draft> {
        match self {
            Expr::Node(draft, _) => Some(draft),
            Expr::Number(_) | Expr::Length(_) => None,
        }
    }

    /// What a constant is; of anything else nothing is known here.
    fn constant(self) -> f64 {
        match self {
            Expr::Number(x) | Expr::Length(x) => x,
            Expr::Node(..) => f64::NAN,
        }
    }

    fn is(self, number: f64) -> bool {
        self.constant() == number
    }

    /// Its node in the draft that everything here is of.
    fn node(self, draft: &Draft) -> NodeId {
        match self {
            Expr::Number(x) => draft.push(Node::Number(x)),
            Expr::Length(x) => draft.push(Node::Length(x)),
            Expr::Node(own, node) => {
                debug_assert!(std::ptr::eq(own, draft), "an expression of another formula");
                node
            }
        }
    }
}

// The operators fold what is plain (0 · x, 1 · x, x + 0), so that an unturned feature reads as simply as by hand.

impl<'f, R: Into<Expr<'f>>> Add<R> for Expr<'f> {
    type Output = Expr<'f>;
    fn add(self, other: R) -> Expr<'f> {
        match (self, other.into()) {
            (a, b) if b.is(0.0) => a,
            (a, b) if a.is(0.0) => b,
            (a @ Expr::Node(..), Expr::Length(b)) if b < 0.0 => a.binary(Op::Subtract, Expr::Length(-b)),
            (a, b) => a.binary(Op::Add, b),
        }
    }
}

impl<'f, R: Into<Expr<'f>>> Sub<R> for Expr<'f> {
    type Output = Expr<'f>;
    fn sub(self, other: R) -> Expr<'f> {
        match (self, other.into()) {
            (a, b) if b.is(0.0) => a,
            (a @ Expr::Node(..), Expr::Length(b)) if b < 0.0 => a.binary(Op::Add, Expr::Length(-b)),
            (a, b) => a.binary(Op::Subtract, b),
        }
    }
}

impl<'f, R: Into<Expr<'f>>> Mul<R> for Expr<'f> {
    type Output = Expr<'f>;
    fn mul(self, other: R) -> Expr<'f> {
        match (self, other.into()) {
            (a, _) if a.is(0.0) => a,
            (_, b) if b.is(0.0) => b,
            (a, b) if b.is(1.0) => a,
            (a, b) if a.is(1.0) => b,
            (a, b) => a.binary(Op::Multiply, b),
        }
    }
}

impl<'f, R: Into<Expr<'f>>> Div<R> for Expr<'f> {
    type Output = Expr<'f>;
    fn div(self, other: R) -> Expr<'f> {
        let other = other.into();
        if other.is(1.0) { self } else { self.binary(Op::Divide, other) }
    }
}

impl<'f, R: Into<Expr<'f>>> Add<R> for Value<'f> {
    type Output = Expr<'f>;
    fn add(self, other: R) -> Expr<'f> {
        Expr::from(self) + other
    }
}

impl<'f, R: Into<Expr<'f>>> Sub<R> for Value<'f> {
    type Output = Expr<'f>;
    fn sub(self, other: R) -> Expr<'f> {
        Expr::from(self) - other
    }
}

impl<'f, R: Into<Expr<'f>>> Mul<R> for Value<'f> {
    type Output = Expr<'f>;
    fn mul(self, other: R) -> Expr<'f> {
        Expr::from(self) * other
    }
}

impl<'f, R: Into<Expr<'f>>> Div<R> for Value<'f> {
    type Output = Expr<'f>;
    fn div(self, other: R) -> Expr<'f> {
        Expr::from(self) / other
    }
}

/// The component along a constant direction of the point (a, o): `a · along.0 + o · along.1`, with ±1 and 0 written plainly.
pub fn project<'f>(a: impl Into<Expr<'f>>, o: impl Into<Expr<'f>>, along: (f64, f64)) -> Expr<'f> {
    let (a, o) = (a.into(), o.into());
    let (ca, co) = (tidy(along.0), tidy(along.1));
    match (ca == 0.0, co == 0.0) {
        (false, true) if ca < 0.0 => Expr::Length(0.0) - a * Expr::Number(-ca),
        (true, false) if co < 0.0 => Expr::Length(0.0) - o * Expr::Number(-co),
        _ if ca < 0.0 => o * Expr::Number(co) - a * Expr::Number(-ca),
        _ if co < 0.0 => a * Expr::Number(ca) - o * Expr::Number(-co),
        _ => a * Expr::Number(ca) + o * Expr::Number(co),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An expression as a text, in Polish notation.
    fn shown(expr: Expr<'_>) -> String {
        fn node(formula: &Formula, id: NodeId) -> String {
            match formula.node(id) {
                Node::Binary(op, a, b) => format!("({op:?} {} {})", node(formula, a), node(formula, b)),
                Node::Trigger { sample, axis } => format!("t{sample}{axis}"),
                other => format!("{other:?}"),
            }
        }
        match expr {
            Expr::Node(draft, id) => node(&draft.0.borrow(), id),
            constant => format!("{constant:?}"),
        }
    }

    #[test]
    fn plain_terms_fold() {
        let f = Draft::default();
        let (a, o) = (f.trigger(0, 0), f.trigger(0, 1));
        for (expr, text) in [
            (project(a, o, (1.0, 6e-17)), "t00"),
            (project(a, o, (-1e-16, 1.0)), "t01"),
            (project(a, o, (-1.0, 0.0)), "(Subtract Length(0.0) t00)"),
            (project(a, o, (-0.6, 0.8)), "(Subtract (Multiply t01 Number(0.8)) (Multiply t00 Number(0.6)))"),
            (a + Expr::Length(-3.0), "(Subtract t00 Length(3.0))"),
            (a - Expr::Length(-3.0), "(Add t00 Length(3.0))"),
            (a * Expr::Number(1.0) / Expr::Number(1.0), "t00"),
            (a * Expr::Number(0.0) + o, "t01"),
        ] {
            assert_eq!(shown(expr), text);
        }
    }

    /// Without a touch there is no list that a node could stand in: constants are computed at once.
    #[test]
    fn constants_are_computed() {
        let (two, six) = (Expr::Number(2.0), Expr::Length(6.0));
        for (expr, text) in [
            (six / two, "Length(3.0)"),
            (six / six, "Number(1.0)"),
            (two * six, "Length(12.0)"),
            (two - Expr::Number(5.0), "Number(-3.0)"),
            (six + Expr::Length(-8.0), "Length(-2.0)"),
            (Expr::Number(90.0).sin(), "Number(1.0)"),
            (Expr::Number(9.0).sqrt(), "Number(3.0)"),
            (Expr::Length(0.0).atan2(Expr::Length(-4.0)), "Number(180.0)"),
        ] {
            assert_eq!(shown(expr), text);
        }
    }
}
