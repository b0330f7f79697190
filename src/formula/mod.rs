//! What a control computes from the touches, written once.
//!
//! A cycle states its arithmetic as a list of named assignments. A post prints it in its control's language, and the
//! virtual part evaluates the very same list, with the derivative by each touch beside it. So what the page shows as the
//! control's result is what the program computes, and the uncertainty comes from the same fit. Circles are fitted
//! geometrically, as a control's own cycle does it; where a program has to do it in plain arithmetic, both use
//! [`Formula::plain`].
//!
//! Angles are in degrees here, as controls take them.

mod circle;
mod name;

pub use circle::{CircleFit, fit_circle};
pub use name::Name;

use std::ops::{Add, Div, Mul, Sub};

use crate::geom::{Vec2, Vec3};
use crate::num::tidy;
use crate::text::Text;

/// An expression over the triggers of the touches.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// A pure number.
    Number(f64),
    /// A length in mm.
    Length(f64),
    /// The value of an earlier assignment, by its index.
    Variable(usize),
    /// Coordinate `axis` (0 = X) of the ball centre at the trigger of a sample: a touch, or the mean of repeated ones.
    Trigger {
        /// Index of the sample.
        touch: usize,
        /// 0, 1, 2 for X, Y, Z.
        axis: usize,
    },
    /// Two operands.
    Binary(Op, Box<Expr>, Box<Expr>),
    /// A function of one operand.
    Call(Function, Box<Expr>),
    /// A part of the circle fitted to some samples: geometric least squares, exact for three.
    Circle {
        /// Index of the first sample.
        first: usize,
        /// How many samples.
        count: usize,
        /// Axes of abscissa and ordinate.
        axes: (usize, usize),
        /// Which part.
        part: CirclePart,
    },
    /// The angle in degrees whose tangent is the first by the second, in the right quadrant.
    Atan2(Box<Expr>, Box<Expr>),
}

/// An operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Op {
    /// +
    Add,
    /// −
    Subtract,
    /// ×
    Multiply,
    /// ÷
    Divide,
}

/// A part of a fitted circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CirclePart {
    /// Abscissa of its centre.
    Abscissa,
    /// Ordinate of its centre.
    Ordinate,
    /// Its radius.
    Radius,
}

/// A function of one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// Sine of degrees.
    Sin,
    /// Cosine of degrees.
    Cos,
    /// Square root.
    Sqrt,
}

/// One assignment.
#[derive(Clone, Debug)]
pub struct Assignment {
    /// Its name.
    pub name: Name,
    /// Its value.
    pub expr: Expr,
}

/// How a result behaves when the part is shifted, turned or resized, and with it its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Abscissa of a point, a length. The ordinate follows as the next result.
    Abscissa,
    /// Ordinate of a point, a length.
    Ordinate,
    /// A length of the part itself.
    Size,
    /// An angle of the part itself, degrees.
    Angle,
    /// A direction, degrees: turns with the part.
    Direction,
    /// A coordinate along the tool axis, a length; not probed.
    Height,
    /// A coordinate along the tool axis that is probed: it moves with the part.
    Level,
    /// A coordinate that is read along a single direction: what a shifted or turned part does to it depends on the surface.
    Reading,
    /// A length that says how far something is off, or what is written.
    Shift,
    /// The same as an angle, degrees.
    Turn,
}

impl Role {
    /// Whether the result is an angle; else a length.
    pub fn is_angle(self) -> bool {
        match self {
            Role::Angle | Role::Direction | Role::Turn => true,
            Role::Abscissa | Role::Ordinate | Role::Size | Role::Height | Role::Level | Role::Reading | Role::Shift => false,
        }
    }
}

/// One result that the control stores.
#[derive(Clone, Debug)]
pub struct ResultDef {
    /// Its code, `center.x`.
    pub code: &'static str,
    /// What it is.
    pub meaning: &'static str,
    /// How it behaves, and its unit.
    pub role: Role,
    /// What it is on the nominal part; mm or degrees.
    pub nominal: f64,
    /// What its deviation is measured from, where that is not the nominal value: the middle of a tolerance zone.
    pub reference: f64,
    /// The assignment that holds it; none where these touches cannot give it.
    pub variable: Option<usize>,
}

/// The whole computation.
#[derive(Clone, Debug, Default)]
pub struct Formula {
    /// In order; each refers to earlier ones only.
    pub assignments: Vec<Assignment>,
    /// What comes out.
    pub results: Vec<ResultDef>,
    /// What a work offset is corrected by.
    pub datum: Option<Datum>,
}

/// What a program corrects a work offset by.
#[derive(Clone, Debug)]
pub struct Datum {
    /// The measured place along abscissa, ordinate and tool axis, and the nominal place it gets, mm; none leaves the origin
    /// alone. Abscissa and ordinate come together; one that was not measured is the constant of its nominal place.
    pub place: [Option<(Expr, f64)>; 3],
    /// By how many degrees the system is turned; none leaves its rotation alone.
    pub rotation: Option<Expr>,
    /// Whether the results say themselves what is written.
    pub told: bool,
}

impl Datum {
    /// A point in the plane: abscissa and ordinate, each as measured and as nominal.
    pub fn point(abscissa: (impl Into<Expr>, f64), ordinate: (impl Into<Expr>, f64)) -> Self {
        let place = [Some((abscissa.0.into(), abscissa.1)), Some((ordinate.0.into(), ordinate.1)), None];
        Datum { place, rotation: None, told: false }
    }

    /// Which of abscissa, ordinate and tool axis were measured.
    pub fn measured(&self) -> [bool; 3] {
        [0, 1, 2].map(|i| matches!(&self.place[i], Some((expr, _)) if !matches!(expr, Expr::Length(_))))
    }
}

/// One result as it comes out. Lengths in mm, angles in degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultRow {
    /// Its code, `center.x`.
    pub code: String,
    /// What it is.
    pub meaning: Text,
    /// Its unit.
    pub unit: Unit,
    /// What it is on the nominal part.
    pub nominal: Option<f64>,
    /// What the control computes; none where these triggers cannot give it.
    pub value: Option<f64>,
    /// Value less nominal, or less the middle of the tolerance zone.
    pub deviation: Option<f64>,
    /// One sigma of the value, from the repeatability of a touch.
    pub uncertainty: Option<f64>,
    /// Lower and upper limit, where a tolerance is given.
    pub limits: Option<(f64, f64)>,
    /// Good, rework, scrap, where a tolerance is given.
    pub verdict: Option<Text>,
    /// What it is on the actual part, where that is known.
    pub truth: Option<f64>,
}

/// The unit of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Millimetres.
    Length,
    /// Degrees.
    Angle,
    /// None.
    None,
}

/// A named value of a formula: what [`Formula::set`] gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Value(usize);

impl From<Value> for Expr {
    fn from(value: Value) -> Expr {
        Expr::Variable(value.0)
    }
}

impl Value {
    /// Sine of degrees.
    pub fn sin(self) -> Expr {
        Expr::from(self).sin()
    }

    /// Cosine of degrees.
    pub fn cos(self) -> Expr {
        Expr::from(self).cos()
    }

    /// The angle of the vector (x, self), degrees.
    pub fn atan2(self, x: impl Into<Expr>) -> Expr {
        Expr::from(self).atan2(x)
    }
}

impl Formula {
    /// Names a value and gives its handle.
    pub fn set(&mut self, name: impl Into<Name>, expr: impl Into<Expr>) -> Value {
        self.assignments.push(Assignment { name: name.into(), expr: expr.into() });
        Value(self.assignments.len() - 1)
    }

    /// States a result; none where these touches cannot give it.
    pub fn result(&mut self, code: &'static str, role: Role, meaning: &'static str, nominal: f64, value: Option<Value>) {
        let variable = value.map(|value| value.0);
        let nominal = tidy(nominal);
        self.results.push(ResultDef { code, meaning, role, nominal, reference: nominal, variable });
    }

    /// The deviation of the last result is measured from here.
    pub fn referred_to(&mut self, reference: f64) {
        if let Some(last) = self.results.last_mut() {
            last.reference = reference;
        }
    }

    /// The same computation in plain arithmetic: every circle is fitted by its normal equations, which are closed. They give
    /// the same circle where the points lie on one, and differ from the geometric fit by the square of their scatter.
    pub fn plain(self) -> Formula {
        let mut circles = false;
        self.assignments.iter().for_each(|a| a.expr.each(&mut |node| circles |= matches!(node, Expr::Circle { .. })));
        if !circles {
            return self;
        }
        let mut plain = Formula::default();
        let mut places: Vec<Value> = Vec::with_capacity(self.assignments.len());
        let mut circles: Vec<(usize, [Value; 3])> = Vec::new();
        for assignment in self.assignments {
            let mut expr = assignment.expr;
            expr.replace(&mut |inner| match inner {
                Expr::Variable(index) => Some(places[*index].into()),
                Expr::Circle { first, count, axes, part } => {
                    let known = circles.iter().position(|(f, _)| f == first).unwrap_or_else(|| {
                        let number = circles.len() + 1;
                        circles.push((*first, plain.circle(number, *first, *count, *axes)));
                        circles.len() - 1
                    });
                    let [x, y, r] = circles[known].1;
                    Some(Expr::from(match part {
                        CirclePart::Abscissa => x,
                        CirclePart::Ordinate => y,
                        CirclePart::Radius => r,
                    }))
                }
                _ => None,
            });
            places.push(plain.set(assignment.name, expr));
        }
        let moved = |e: &Expr| match e {
            Expr::Variable(index) => places[*index].into(),
            other => other.clone(),
        };
        plain.results = self.results;
        for result in &mut plain.results {
            result.variable = result.variable.map(|index| places[index].0);
        }
        plain.datum = self.datum.as_ref().map(|d| Datum {
            place: d.place.each_ref().map(|p| p.as_ref().map(|(e, n)| (moved(e), *n))),
            rotation: d.rotation.as_ref().map(moved),
            told: d.told,
        });
        plain
    }

    /// Which coordinates of the triggers are used at all.
    pub fn used(&self) -> Used {
        let mut used = Used::default();
        for assignment in &self.assignments {
            assignment.expr.each(&mut |node| match node {
                Expr::Trigger { touch, axis } => used.0[*touch] |= 1 << axis,
                Expr::Circle { first, count, axes, .. } => {
                    used.0[*first..first + count].iter_mut().for_each(|own| *own |= 1 << axes.0 | 1 << axes.1);
                }
                _ => {}
            });
        }
        used
    }

    /// Evaluates every assignment for ball centres at these triggers. A missing trigger makes everything that needs it NaN.
    /// `directions` are the probing directions: the derivative of touch k is by a shift of its trigger along direction k.
    pub fn evaluate(&self, triggers: &[Option<Vec3>], directions: &[Vec3]) -> Vec<Dual> {
        let mut values: Vec<Dual> = Vec::with_capacity(self.assignments.len());
        for assignment in &self.assignments {
            let mut value = Dual::constant(0.0);
            assignment.expr.evaluate(&Given { values: &values, triggers, directions }, &mut value);
            values.push(value);
        }
        values
    }
}

/// The most samples that a formula computes with: a derivative is kept for each.
pub const MOST_SAMPLES: usize = 16;

/// The coordinates of the triggers that a formula reads: a bit an axis.
#[derive(Clone, Copy, Debug, Default)]
pub struct Used([u8; MOST_SAMPLES]);

impl Used {
    /// Whether coordinate `axis` of a sample is read.
    pub fn has(&self, sample: usize, axis: usize) -> bool {
        self.0.get(sample).is_some_and(|axes| axes & (1 << axis) != 0)
    }
}

/// A number and its derivative by each touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual {
    /// The number.
    pub value: f64,
    /// Its change for a unit shift of each trigger along its probing direction.
    pub by_touch: [f64; MOST_SAMPLES],
}

impl Dual {
    /// A number that depends on no touch.
    pub const fn constant(value: f64) -> Self {
        Dual { value, by_touch: [0.0; MOST_SAMPLES] }
    }

    /// The standard deviation of this number if every touch scatters independently by `sigma`: linear propagation.
    pub fn uncertainty(&self, sigma: f64) -> f64 {
        sigma * self.by_touch.iter().map(|d| d * d).sum::<f64>().sqrt()
    }

    /// Becomes f of itself, by the chain rule.
    fn map(&mut self, value: f64, slope: f64) {
        self.value = value;
        self.by_touch.iter_mut().for_each(|d| *d *= slope);
    }

    /// Becomes f of itself and another number, by the chain rule.
    fn join(&mut self, other: &Dual, value: f64, slope: f64, other_slope: f64) {
        self.value = value;
        for (d, o) in self.by_touch.iter_mut().zip(other.by_touch) {
            *d = *d * slope + o * other_slope;
        }
    }
}

impl Expr {
    /// Coordinate `axis` of the trigger of a touch.
    pub fn trigger(touch: usize, axis: usize) -> Expr {
        Expr::Trigger { touch, axis }
    }

    /// The sum of these, in their order; 0 of none.
    pub fn sum<T: Into<Expr>>(parts: impl Iterator<Item = T>) -> Expr {
        parts.map(Into::into).reduce(|sum, part| sum + part).unwrap_or(Expr::Number(0.0))
    }

    /// Sine of degrees.
    pub fn sin(self) -> Expr {
        Expr::Call(Function::Sin, Box::new(self))
    }

    /// Cosine of degrees.
    pub fn cos(self) -> Expr {
        Expr::Call(Function::Cos, Box::new(self))
    }

    /// The angle of the vector (x, self), degrees.
    pub fn atan2(self, x: impl Into<Expr>) -> Expr {
        Expr::Atan2(Box::new(self), Box::new(x.into()))
    }

    /// Replaces every node for which `by` gives another, outermost first.
    fn replace(&mut self, by: &mut impl FnMut(&Expr) -> Option<Expr>) {
        if let Some(new) = by(self) {
            *self = new;
            return;
        }
        match self {
            Expr::Number(_) | Expr::Length(_) | Expr::Variable(_) | Expr::Trigger { .. } | Expr::Circle { .. } => {}
            Expr::Call(_, a) => a.replace(by),
            Expr::Binary(_, a, b) | Expr::Atan2(a, b) => {
                a.replace(by);
                b.replace(by);
            }
        }
    }

    /// Visits this node and everything in it.
    pub fn each(&self, visit: &mut impl FnMut(&Expr)) {
        visit(self);
        match self {
            Expr::Number(_) | Expr::Length(_) | Expr::Variable(_) | Expr::Trigger { .. } | Expr::Circle { .. } => {}
            Expr::Call(_, a) => a.each(visit),
            Expr::Binary(_, a, b) | Expr::Atan2(a, b) => {
                a.each(visit);
                b.each(visit);
            }
        }
    }

    fn is(&self, number: f64) -> bool {
        match self {
            Expr::Number(x) | Expr::Length(x) => *x == number,
            _ => false,
        }
    }

    /// Its value, where it is made of named values and constants alone.
    pub fn value(&self, values: &[Dual]) -> Dual {
        let mut value = Dual::constant(0.0);
        self.evaluate(&Given { values, triggers: &[], directions: &[] }, &mut value);
        value
    }

    /// Puts its value into `out`.
    fn evaluate(&self, given: &Given<'_>, out: &mut Dual) {
        match self {
            Expr::Number(x) | Expr::Length(x) => *out = Dual::constant(*x),
            Expr::Variable(index) => *out = given.values[*index],
            Expr::Trigger { touch, axis } => {
                *out = Dual::constant(given.triggers[*touch].map_or(f64::NAN, |t| t[*axis]));
                out.by_touch[*touch] = given.directions[*touch][*axis];
            }
            Expr::Binary(op, left, right) => {
                left.evaluate(given, out);
                // Most operands have a name: they are read where they stand.
                let mut own = Dual::constant(0.0);
                let b = match &**right {
                    Expr::Variable(index) => &given.values[*index],
                    right => {
                        right.evaluate(given, &mut own);
                        &own
                    }
                };
                let a = out.value;
                match op {
                    Op::Add => out.join(b, a + b.value, 1.0, 1.0),
                    Op::Subtract => out.join(b, a - b.value, 1.0, -1.0),
                    Op::Multiply => out.join(b, a * b.value, b.value, a),
                    Op::Divide => out.join(b, a / b.value, 1.0 / b.value, -a / (b.value * b.value)),
                }
            }
            Expr::Call(function, a) => {
                a.evaluate(given, out);
                let (sin, cos) = out.value.to_radians().sin_cos();
                match function {
                    Function::Sin => out.map(sin, cos.to_radians()),
                    Function::Cos => out.map(cos, -sin.to_radians()),
                    Function::Sqrt => out.map(out.value.sqrt(), 0.5 / out.value.sqrt()),
                }
            }
            Expr::Circle { first, count, axes, part } => *out = circle(*first..first + count, *axes, *part, given),
            Expr::Atan2(y, x) => {
                y.evaluate(given, out);
                let mut by = Dual::constant(0.0);
                x.evaluate(given, &mut by);
                let (y, x) = (out.value, by.value);
                let square = x * x + y * y;
                out.join(&by, y.atan2(x).to_degrees(), (x / square).to_degrees(), (-y / square).to_degrees());
            }
        }
    }
}

/// What an expression is evaluated with: the values of earlier assignments, the triggers, and the probing directions.
struct Given<'a> {
    values: &'a [Dual],
    triggers: &'a [Option<Vec3>],
    directions: &'a [Vec3],
}

/// A part of the circle fitted to these samples.
fn circle(samples: std::ops::Range<usize>, axes: (usize, usize), part: CirclePart, given: &Given<'_>) -> Dual {
    let flat = |v: &Vec3| Vec2::new(v[axes.0], v[axes.1]);
    let points: Option<Vec<Vec2>> = given.triggers[samples.clone()].iter().map(|t| t.as_ref().map(flat)).collect();
    let Some(fit) = points.as_deref().and_then(fit_circle) else { return Dual::constant(f64::NAN) };
    let row = match part {
        CirclePart::Abscissa => 0,
        CirclePart::Ordinate => 1,
        CirclePart::Radius => 2,
    };
    let mut dual = Dual::constant(fit.center.extend(fit.radius)[row]);
    for (i, k) in samples.enumerate() {
        let d = flat(&given.directions[k]);
        let [by_first, by_second] = fit.by_point[i];
        dual.by_touch[k] = by_first[row] * d.x + by_second[row] * d.y;
    }
    dual
}

// The operators fold what is plain (0 · x, 1 · x, x + 0), so that an unturned feature reads as simply as by hand.

impl<R: Into<Expr>> Add<R> for Expr {
    type Output = Expr;
    fn add(self, other: R) -> Expr {
        let other = other.into();
        match (self, other) {
            (a, b) if b.is(0.0) => a,
            (a, b) if a.is(0.0) => b,
            (Expr::Length(a), Expr::Length(b)) => Expr::Length(a + b),
            (a, Expr::Length(b)) if b < 0.0 => a - Expr::Length(-b),
            (a, b) => Expr::Binary(Op::Add, Box::new(a), Box::new(b)),
        }
    }
}

impl<R: Into<Expr>> Sub<R> for Expr {
    type Output = Expr;
    fn sub(self, other: R) -> Expr {
        let other = other.into();
        match (self, other) {
            (a, b) if b.is(0.0) => a,
            (Expr::Length(a), Expr::Length(b)) => Expr::Length(a - b),
            (a, Expr::Length(b)) if b < 0.0 => a + Expr::Length(-b),
            (a, b) => Expr::Binary(Op::Subtract, Box::new(a), Box::new(b)),
        }
    }
}

impl<R: Into<Expr>> Mul<R> for Expr {
    type Output = Expr;
    fn mul(self, other: R) -> Expr {
        let other = other.into();
        match (self, other) {
            (a, _) if a.is(0.0) => a,
            (_, b) if b.is(0.0) => b,
            (a, b) if b.is(1.0) => a,
            (a, b) if a.is(1.0) => b,
            (Expr::Number(a), Expr::Number(b)) => Expr::Number(a * b),
            (a, b) => Expr::Binary(Op::Multiply, Box::new(a), Box::new(b)),
        }
    }
}

impl<R: Into<Expr>> Div<R> for Expr {
    type Output = Expr;
    fn div(self, other: R) -> Expr {
        let other = other.into();
        if other.is(1.0) { self } else { Expr::Binary(Op::Divide, Box::new(self), Box::new(other)) }
    }
}

impl<R: Into<Expr>> Add<R> for Value {
    type Output = Expr;
    fn add(self, other: R) -> Expr {
        Expr::from(self) + other
    }
}

impl<R: Into<Expr>> Sub<R> for Value {
    type Output = Expr;
    fn sub(self, other: R) -> Expr {
        Expr::from(self) - other
    }
}

impl<R: Into<Expr>> Mul<R> for Value {
    type Output = Expr;
    fn mul(self, other: R) -> Expr {
        Expr::from(self) * other
    }
}

impl<R: Into<Expr>> Div<R> for Value {
    type Output = Expr;
    fn div(self, other: R) -> Expr {
        Expr::from(self) / other
    }
}

/// The component along a constant direction of the point (a, o): `a · along.0 + o · along.1`, with ±1 and 0 written plainly.
pub fn project(a: impl Into<Expr>, o: impl Into<Expr>, along: (f64, f64)) -> Expr {
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

    /// d(atan2(y, x)) and the product rule against a difference quotient.
    #[test]
    fn derivatives_agree_with_difference_quotients() {
        let mut formula = Formula::default();
        let x = formula.set("x", Expr::trigger(0, 0) * Expr::trigger(1, 1) / Expr::Number(7.0));
        let y = formula.set("y", Expr::trigger(0, 0) - Expr::trigger(1, 0));
        formula.set("angle", y.atan2(x));
        formula.set("wave", x.sin() * y.cos());
        let directions = [Vec3::X, Vec3::Y];
        let at = |a: f64, b: f64| formula.evaluate(&[Some(Vec3::new(a, 2.0, 0.0)), Some(Vec3::new(1.0, b, 0.0))], &directions);
        let (a, b, h) = (3.0, 5.0, 1e-6);
        let [exact, right, left, up, down] = [(a, b), (a + h, b), (a - h, b), (a, b + h), (a, b - h)].map(|(a, b)| at(a, b));
        let slope = |high: &[Dual], low: &[Dual], i: usize| (high[i].value - low[i].value) / (2.0 * h);
        for (i, dual) in exact.iter().enumerate() {
            let by_quotient = [slope(&right, &left, i), slope(&up, &down, i)];
            for (touch, quotient) in by_quotient.iter().enumerate() {
                assert!((dual.by_touch[touch] - quotient).abs() < 1e-6, "{i}: {} {quotient}", dual.by_touch[touch]);
            }
        }
    }

    #[test]
    fn a_missing_trigger_reaches_only_what_needs_it() {
        let mut formula = Formula::default();
        formula.set("a", Expr::trigger(0, 0) + Expr::Length(3.0));
        formula.set("b", Expr::trigger(1, 0) + Expr::Length(3.0));
        let values = formula.evaluate(&[Some(Vec3::X), None], &[Vec3::X, Vec3::X]);
        assert_eq!(values[0].value, 4.0);
        assert!(values[1].value.is_nan());
    }

    #[test]
    fn plain_terms_fold() {
        let (a, o) = (|| Expr::trigger(0, 0), || Expr::trigger(0, 1));
        assert_eq!(project(a(), o(), (1.0, 6e-17)), a());
        assert_eq!(project(a(), o(), (-1e-16, 1.0)), o());
        assert_eq!(project(a(), o(), (-1.0, 0.0)), Expr::Length(0.0) - a());
        assert_eq!(a() + Expr::Length(-3.0), a() - Expr::Length(3.0));
    }
}
