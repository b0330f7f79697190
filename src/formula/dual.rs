//! Evaluates a formula on trigger points, with the derivative of each value by each touch.

use crate::formula::node::Samples;
use crate::formula::{CirclePart, Formula, Function, MOST_SAMPLES, Node, NodeId, Op, fit_circle};
use crate::geom::{Vec2, Vec3};

/// A number and its derivative by each touch.
#[derive(Clone, Debug, PartialEq)]
pub struct Dual {
    pub value: f64,
    /// Index of the sample of the first entry of `by_touch`.
    first: u16,
    /// Derivatives by the samples from `first` on, for a unit shift of each trigger along its probing direction.
    by_touch: [f64; MOST_SAMPLES],
    /// Derivatives by further samples: repeated touches, or those of other cycles.
    others: Vec<(u16, [f64; MOST_SAMPLES])>,
}

impl Dual {
    /// A number that is independent of all touches.
    pub const fn constant(value: f64) -> Self {
        Dual {
            value,
            first: 0,
            by_touch: [0.0; MOST_SAMPLES],
            others: Vec::new(),
        }
    }

    /// Derivatives in groups: index of the first sample, and the derivatives by it and the following ones.
    pub fn by_samples(&self) -> impl Iterator<Item = (usize, &[f64; MOST_SAMPLES])> {
        let others = self
            .others
            .iter()
            .map(|(first, by_touch)| (usize::from(*first), by_touch));
        std::iter::once((usize::from(self.first), &self.by_touch)).chain(others)
    }

    /// All derivatives.
    fn slopes(&self) -> impl Iterator<Item = f64> {
        self.by_samples()
            .flat_map(|(_, by_touch)| by_touch.iter().copied())
    }

    /// Sum of the absolute derivatives: the largest change of the number if each touch changes by 1.
    pub fn reach(&self) -> f64 {
        self.slopes().map(f64::abs).sum()
    }

    /// Whether the number is independent of all touches.
    fn is_constant(&self) -> bool {
        self.others.is_empty() && self.by_touch.iter().all(|slope| *slope == 0.0)
    }

    /// Standard deviation of the number if every touch scatters independently by `sigma`: linear propagation.
    pub fn uncertainty(&self, sigma: f64) -> f64 {
        sigma * self.slopes().map(|d| d * d).sum::<f64>().sqrt()
    }

    /// Replaces the number by a function of it, by the chain rule.
    fn map(&mut self, value: f64, slope: f64) {
        self.value = value;
        self.by_touch
            .iter_mut()
            .chain(self.others.iter_mut().flat_map(|(_, slopes)| slopes))
            .for_each(|d| *d *= slope);
    }

    /// Replaces the number by a function of it and another number, by the chain rule.
    fn join(&mut self, other: &Dual, (value, slope, other_slope): Joined) {
        if self.first == other.first && self.others.is_empty() && other.others.is_empty() {
            self.value = value;
            for (d, o) in self.by_touch.iter_mut().zip(&other.by_touch) {
                *d = *d * slope + o * other_slope;
            }
            return;
        }
        // A constant can take over any samples.
        if self.is_constant() {
            *self = other.clone();
            return self.map(value, other_slope);
        }
        self.map(value, slope);
        if other.is_constant() {
            return;
        }
        for (first, slopes) in other.by_samples() {
            let own = if usize::from(self.first) == first {
                &mut self.by_touch
            } else {
                let at = self
                    .others
                    .iter()
                    .position(|(known, _)| usize::from(*known) == first)
                    .unwrap_or_else(|| {
                        self.others.push((first as u16, [0.0; MOST_SAMPLES]));
                        self.others.len() - 1
                    });
                &mut self.others[at].1
            };
            own.iter_mut()
                .zip(slopes)
                .for_each(|(d, o)| *d += o * other_slope);
        }
    }

    /// A function of two numbers, by the chain rule.
    fn of(a: &Dual, b: &Dual, joined: Joined) -> Dual {
        let (value, by_a, by_b) = joined;
        if a.first == b.first && a.others.is_empty() && b.others.is_empty() {
            let by_touch = std::array::from_fn(|k| a.by_touch[k] * by_a + b.by_touch[k] * by_b);
            return Dual {
                value,
                first: a.first,
                by_touch,
                others: Vec::new(),
            };
        }
        let mut both = a.clone();
        both.join(b, joined);
        both
    }
}

/// Value of a function of two numbers, and its derivatives by both.
type Joined = (f64, f64, f64);

impl Op {
    /// Value of the operator.
    pub(super) fn of(self, a: f64, b: f64) -> f64 {
        match self {
            Op::Add => a + b,
            Op::Subtract => a - b,
            Op::Multiply => a * b,
            Op::Divide => a / b,
        }
    }

    /// Value of the operator, with its derivatives by both operands.
    fn joined(self, a: f64, b: f64) -> Joined {
        let value = self.of(a, b);
        match self {
            Op::Add => (value, 1.0, 1.0),
            Op::Subtract => (value, 1.0, -1.0),
            Op::Multiply => (value, b, a),
            Op::Divide => (value, 1.0 / b, -a / (b * b)),
        }
    }
}

impl Function {
    /// Value of the function; angles in degrees.
    fn of(self, x: f64) -> f64 {
        match self {
            Function::Sin => x.to_radians().sin(),
            Function::Cos => x.to_radians().cos(),
            Function::Sqrt => x.sqrt(),
            Function::Abs => x.abs(),
        }
    }

    /// Derivative at `x`; of sine and cosine by degrees.
    fn slope(self, x: f64) -> f64 {
        match self {
            Function::Sin => x.to_radians().cos().to_radians(),
            Function::Cos => -x.to_radians().sin().to_radians(),
            Function::Sqrt => 0.5 / x.sqrt(),
            Function::Abs => x.signum(),
        }
    }
}

impl Formula {
    /// Evaluates every assignment for ball centres at these triggers. A missing trigger makes all values that depend on it NaN. `directions` are the probing
    /// directions: the derivative by touch k is for a shift of its trigger along direction k.
    pub fn evaluate(&self, triggers: &[Option<Vec3>], directions: &[Vec3]) -> Vec<Dual> {
        let mut values = Vec::with_capacity(self.assignments.len());
        self.evaluate_on(&mut values, self.assignments.len(), triggers, directions);
        values
    }

    /// Evaluates the assignments in a range, given the values before it.
    pub fn evaluate_on(
        &self,
        known: &mut Vec<Dual>,
        until: usize,
        triggers: &[Option<Vec3>],
        directions: &[Vec3],
    ) {
        let values = std::mem::take(known);
        let begin = values.len();
        let mut run = Run {
            nodes: &self.nodes,
            values,
            triggers,
            directions,
            first: 0,
        };
        for assignment in &self.assignments[begin..until] {
            run.first = self
                .cycles
                .get(usize::from(assignment.cycle))
                .map_or(0, |cycle| cycle.first_sample);
            let mut value = Dual::constant(0.0);
            run.put(assignment.node, &mut value);
            run.values.push(value);
        }
        *known = run.values;
    }
}

/// State of an evaluation.
struct Run<'a> {
    nodes: &'a [Node],
    values: Vec<Dual>,
    triggers: &'a [Option<Vec3>],
    directions: &'a [Vec3],
    /// First sample of the evaluated cycle.
    first: usize,
}

impl Run<'_> {
    /// First sample of the group that a sample belongs to. Derivatives are kept in groups of the size that one cycle needs; repeated touches take several
    /// groups.
    fn first_beside(&self, sample: usize) -> usize {
        sample - (sample - self.first) % MOST_SAMPLES
    }

    /// Writes the value of a node to `out`.
    fn put(&self, node: NodeId, out: &mut Dual) {
        match self.nodes[node.0 as usize] {
            Node::Number(x) | Node::Length(x) => *out = Dual::constant(x),
            Node::Variable(variable) => *out = self.values[variable.index()].clone(),
            Node::Trigger { sample, axis } => {
                let (sample, axis) = (usize::from(sample), usize::from(axis));
                *out = Dual::constant(self.triggers[sample].map_or(f64::NAN, |t| t[axis]));
                let first = self.first_beside(sample);
                out.first = first as u16;
                out.by_touch[sample - first] = self.directions[sample][axis];
            }
            Node::Binary(op, left, right) => self.two(left, right, out, |a, b| op.joined(a, b)),
            Node::Call(function, a) => {
                self.put(a, out);
                out.map(function.of(out.value), function.slope(out.value));
            }
            Node::Circle(samples, part) => *out = self.circle(samples, part),
            Node::Atan2(y, x) => self.two(y, x, out, |y, x| {
                let square = x * x + y * y;
                (
                    y.atan2(x).to_degrees(),
                    (x / square).to_degrees(),
                    (-y / square).to_degrees(),
                )
            }),
        }
    }

    /// Writes a function of two operands to `out`. Most operands are named values and are read in place.
    fn two(&self, left: NodeId, right: NodeId, out: &mut Dual, f: impl Fn(f64, f64) -> Joined) {
        match (self.named(left), self.named(right)) {
            (Some(a), Some(b)) => *out = Dual::of(a, b, f(a.value, b.value)),
            (_, Some(b)) => {
                self.put(left, out);
                out.join(b, f(out.value, b.value));
            }
            _ => {
                let mut b = Dual::constant(0.0);
                self.put(left, out);
                self.put(right, &mut b);
                out.join(&b, f(out.value, b.value));
            }
        }
    }

    /// Value of a node that is a named value.
    fn named(&self, node: NodeId) -> Option<&Dual> {
        match self.nodes[node.0 as usize] {
            Node::Variable(variable) => self.values.get(variable.index()),
            _ => None,
        }
    }

    /// A part of the circle fitted to these samples.
    fn circle(&self, samples: Samples, part: CirclePart) -> Dual {
        let flat = |v: &Vec3| {
            Vec2::new(
                v[usize::from(samples.axes.0)],
                v[usize::from(samples.axes.1)],
            )
        };
        let points: Option<Vec<Vec2>> = self.triggers[samples.range()]
            .iter()
            .map(|t| t.as_ref().map(flat))
            .collect();
        let Some(fit) = points.as_deref().and_then(fit_circle) else {
            return Dual::constant(f64::NAN);
        };
        let row = match part {
            CirclePart::Abscissa => 0,
            CirclePart::Ordinate => 1,
            CirclePart::Radius => 2,
            CirclePart::Residual => return Dual::constant(fit.residual),
        };
        let mut dual = Dual {
            first: self.first as u16,
            ..Dual::constant(fit.center.extend(fit.radius)[row])
        };
        for (i, k) in samples.range().enumerate() {
            let d = flat(&self.directions[k]);
            let [by_first, by_second] = fit.by_point[i];
            dual.by_touch[k - self.first] = by_first[row] * d.x + by_second[row] * d.y;
        }
        dual
    }
}

#[cfg(test)]
mod tests {
    use crate::formula::{Draft, Dual};
    use crate::geom::Vec3;

    /// Compares the derivatives of atan2, products and functions with difference quotients.
    #[test]
    fn derivatives_agree_with_difference_quotients() {
        let f = Draft::default();
        let x = f.set("x", f.trigger(0, 0) * f.trigger(1, 1) / f.number(7.0));
        let y = f.set("y", f.trigger(0, 0) - f.trigger(1, 0));
        f.set("angle", y.atan2(x));
        f.set("wave", x.sin() * y.cos());
        f.set("root", (x * x + y * y).sqrt() / y);
        let formula = f.finish(None);
        let directions = [Vec3::X, Vec3::Y];
        let at = |a: f64, b: f64| {
            formula.evaluate(
                &[Some(Vec3::new(a, 2.0, 0.0)), Some(Vec3::new(1.0, b, 0.0))],
                &directions,
            )
        };
        let (a, b, h) = (3.0, 5.0, 1e-6);
        let [exact, right, left, up, down] =
            [(a, b), (a + h, b), (a - h, b), (a, b + h), (a, b - h)].map(|(a, b)| at(a, b));
        let slope =
            |high: &[Dual], low: &[Dual], i: usize| (high[i].value - low[i].value) / (2.0 * h);
        for (i, dual) in exact.iter().enumerate() {
            let by_quotient = [slope(&right, &left, i), slope(&up, &down, i)];
            for (touch, quotient) in by_quotient.iter().enumerate() {
                assert!(
                    (dual.by_touch[touch] - quotient).abs() < 1e-6,
                    "{i}: {} {quotient}",
                    dual.by_touch[touch]
                );
            }
        }
    }

    #[test]
    fn a_missing_trigger_reaches_only_what_needs_it() {
        let f = Draft::default();
        f.set("a", f.trigger(0, 0) + f.length(3.0));
        f.set("b", f.trigger(1, 0) + f.length(3.0));
        let values = f
            .finish(None)
            .evaluate(&[Some(Vec3::X), None], &[Vec3::X, Vec3::X]);
        assert_eq!(values[0].value, 4.0);
        assert!(values[1].value.is_nan());
    }
}
