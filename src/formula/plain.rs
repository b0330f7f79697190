//! A formula written again in arithmetic that any control can do.

use crate::formula::node::{Samples, Variable};
use crate::formula::{CirclePart, Draft, Formula, Name, Node, NodeId, Value};

/// Writes the assignments of a formula, after those of the circles that they need. Where each of them stands now.
pub(super) fn write(formula: &Formula, draft: &Draft) -> Vec<Variable> {
    let mut plain = Plain { formula, draft, values: Vec::with_capacity(formula.assignments.len()), circles: Vec::new() };
    for assignment in &formula.assignments {
        let node = plain.node(assignment.node);
        plain.values.push(draft.assign(assignment.name, node));
    }
    plain.values.iter().map(|value| value.variable).collect()
}

struct Plain<'a, 'f> {
    formula: &'a Formula,
    draft: &'f Draft,
    /// The assignments so far.
    values: Vec<Value<'f>>,
    /// The circles so far: abscissa and ordinate of the centre, and radius.
    circles: Vec<(Samples, [Value<'f>; 3])>,
}

impl<'f> Plain<'_, 'f> {
    /// Writes a node and everything in it.
    fn node(&mut self, id: NodeId) -> NodeId {
        let node = match self.formula.node(id) {
            Node::Variable(variable) => Node::Variable(self.values[variable.index()].variable),
            Node::Circle(samples, part) => Node::Variable(self.part(samples, part).variable),
            leaf @ (Node::Number(_) | Node::Length(_) | Node::Trigger { .. }) => leaf,
            Node::Call(function, a) => Node::Call(function, self.node(a)),
            Node::Binary(op, a, b) => Node::Binary(op, self.node(a), self.node(b)),
            Node::Atan2(y, x) => Node::Atan2(self.node(y), self.node(x)),
        };
        self.draft.push(node).node
    }

    /// A part of a circle, which is written where it is needed first.
    fn part(&mut self, samples: Samples, part: CirclePart) -> Value<'f> {
        let known = self.circles.iter().find(|(known, _)| *known == samples).map(|(_, values)| *values);
        let [x, y, r] = known.unwrap_or_else(|| {
            let values = circle(self.draft, self.circles.len() + 1, samples);
            self.circles.push((samples, values));
            values
        });
        match part {
            CirclePart::Abscissa => x,
            CirclePart::Ordinate => y,
            CirclePart::Radius => r,
        }
    }
}

/// Kåsa's circle: minimises the sum of (x² + y² − 2ax − 2by − c)² about the mean of the points.
fn circle(f: &Draft, number: usize, samples: Samples) -> [Value<'_>; 3] {
    let own = |rest: &'static str| Name::new("c", number).and(rest);
    let [a, o] = [samples.axes.0, samples.axes.1].map(usize::from);
    let samples = samples.range();
    let n = f.number(samples.len() as f64);
    let mean = |axis: usize| f.sum(samples.clone().map(|k| f.trigger(k, axis))) / n;
    let mean_a = f.set(own("_mean_a"), mean(a));
    let mean_o = f.set(own("_mean_o"), mean(o));
    let mut sums: [Option<Value<'_>>; 5] = Default::default();
    for (i, k) in samples.enumerate() {
        let u = f.set(Name::new("u", k + 1), f.trigger(k, a) - mean_a);
        let v = f.set(Name::new("v", k + 1), f.trigger(k, o) - mean_o);
        let z = f.set(Name::new("w", k + 1), u * u + v * v);
        let terms = [u * u, v * v, u * v, u * z, v * z];
        let names = ["_uu_", "_vv_", "_uv_", "_uz_", "_vz_"];
        for ((sum, term), name) in sums.iter_mut().zip(terms).zip(names) {
            *sum = Some(f.set(own(name).at(i + 1), sum.map_or(term, |sum| sum + term)));
        }
    }
    let [uu, vv, uv, uz, vz] = sums.map(|sum| sum.expect("three points or more"));
    let det = f.set(own("_det"), (uu * vv - uv * uv) * f.number(2.0));
    let u = f.set(own("_u"), (vv * uz - uv * vz) / det);
    let v = f.set(own("_v"), (uu * vz - uv * uz) / det);
    let x = f.set(own("_a"), mean_a + u);
    let y = f.set(own("_o"), mean_o + v);
    let r = f.set(own("_r"), (u * u + v * v + (uu + vv) / n).sqrt());
    [x, y, r]
}
