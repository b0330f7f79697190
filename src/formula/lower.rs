//! Rewrites a formula in arithmetic that every control has, and for repeated touches.

use crate::formula::node::{Samples, Variable};
use crate::formula::{CirclePart, Draft, Expr, Formula, Name, Node, NodeId, Value};
use crate::geom::Vec3;

/// Source of the coordinates of the touches in a rewritten formula.
pub(super) trait TriggerSource<'f> {
    /// Coordinate `axis` of a sample.
    fn trigger(&self, draft: &'f Draft, sample: usize, axis: usize) -> Expr<'f>;
}

/// Reads the touches directly.
pub(super) struct RawTriggers;

impl<'f> TriggerSource<'f> for RawTriggers {
    fn trigger(&self, draft: &'f Draft, sample: usize, axis: usize) -> Expr<'f> {
        draft.trigger(sample, axis)
    }
}

/// Reads single touches by the coordinate of the surface along an axis, which a control measures; the other coordinates are nominal.
pub(super) struct SingleTouches<'f, 't> {
    pub touches: &'t [SingleTouch],
    /// The measured coordinates, in the order of the touches.
    pub surfaces: Vec<Value<'f>>,
}

/// A touch along an axis.
#[derive(Clone, Copy, Debug)]
pub struct SingleTouch {
    pub axis: usize,
    /// Nominal ball centre at the contact.
    pub center: Vec3,
    /// Ball centre less surface, along the axis.
    pub ball: f64,
}

impl<'f> TriggerSource<'f> for SingleTouches<'f, '_> {
    fn trigger(&self, draft: &'f Draft, sample: usize, axis: usize) -> Expr<'f> {
        let touch = &self.touches[sample];
        if axis == touch.axis {
            self.surfaces[sample] + draft.length(touch.ball)
        } else {
            draft.length(touch.center[axis])
        }
    }
}

/// Writes the assignments of a formula after those of the touches and circles that they need. Returns the new index of each.
pub(super) fn write<'f>(
    formula: &Formula,
    draft: &'f Draft,
    source: &dyn TriggerSource<'f>,
) -> Vec<Variable> {
    let values = Vec::with_capacity(formula.assignments.len());
    let mut plain = Lowering {
        formula,
        draft,
        source,
        values,
        circles: Vec::new(),
    };
    for assignment in &formula.assignments {
        let node = plain.node(assignment.node);
        plain.values.push(draft.assign(assignment.name, node));
    }
    plain.values.iter().map(|value| value.variable).collect()
}

struct Lowering<'a, 'f> {
    formula: &'a Formula,
    draft: &'f Draft,
    source: &'a dyn TriggerSource<'f>,
    /// Assignments written so far.
    values: Vec<Value<'f>>,
    /// Circles written so far: abscissa and ordinate of the centre, radius and residual.
    circles: Vec<(Samples, [Value<'f>; 4])>,
}

impl<'f> Lowering<'_, 'f> {
    /// Writes a node and its operands.
    fn node(&mut self, id: NodeId) -> NodeId {
        let node = match self.formula.node(id) {
            Node::Variable(variable) => Node::Variable(self.values[variable.index()].variable),
            Node::Circle(samples, part) => Node::Variable(self.part(samples, part).variable),
            Node::Trigger { sample, axis } => {
                return self.trigger(usize::from(sample), usize::from(axis)).node;
            }
            leaf @ (Node::Number(_) | Node::Length(_)) => leaf,
            Node::Call(function, a) => Node::Call(function, self.node(a)),
            Node::Binary(op, a, b) => Node::Binary(op, self.node(a), self.node(b)),
            Node::Atan2(y, x) => Node::Atan2(self.node(y), self.node(x)),
        };
        self.draft.push(node).node
    }

    fn trigger(&self, sample: usize, axis: usize) -> Expr<'f> {
        self.source.trigger(self.draft, sample, axis)
    }

    /// A part of a circle. The circle is written before its first use.
    fn part(&mut self, samples: Samples, part: CirclePart) -> Value<'f> {
        let known = self
            .circles
            .iter()
            .find(|(known, _)| *known == samples)
            .map(|(_, values)| *values);
        let [x, y, r, residual] = known.unwrap_or_else(|| {
            let [a, o] = [samples.axes.0, samples.axes.1].map(usize::from);
            let at = |k: usize, axis: usize| self.trigger(k, if axis == 0 { a } else { o });
            let values = circle(self.draft, self.circles.len() + 1, samples.range(), &at);
            self.circles.push((samples, values));
            values
        });
        match part {
            CirclePart::Abscissa => x,
            CirclePart::Ordinate => y,
            CirclePart::Radius => r,
            CirclePart::Residual => residual,
        }
    }
}

/// Kåsa's circle: minimises the sum of (u² + v² − 2au − 2bv − c)², u and v being counted from the first point. Its sums grow from touch to touch, so a control
/// need not store every point. With w = u² + v² and, for each pair, the central sum ⟨pq⟩ = Σpq − ΣpΣq/n,
/// 2a = (⟨vv⟩⟨uw⟩ − ⟨uv⟩⟨vw⟩) / (⟨uu⟩⟨vv⟩ − ⟨uv⟩²), 2b likewise, and the residual of Σ(w − 2au − 2bv − c)² is ⟨ww⟩ − 2a⟨uw⟩ − 2b⟨vw⟩. A point at distance e
/// from the circle of radius r adds nearly (2re)² to it.
///
/// `at` is abscissa (0) or ordinate (1) of a point.
pub(super) fn circle<'f>(
    f: &'f Draft,
    number: usize,
    samples: std::ops::Range<usize>,
    at: &dyn Fn(usize, usize) -> Expr<'f>,
) -> [Value<'f>; 4] {
    let own = |rest: &'static str| Name::new("c", number).and(rest);
    let count = samples.len();
    let n = || f.number(count as f64);
    let first = samples.start;
    let names = ["_u_", "_v_", "_uu_", "_vv_", "_uv_", "_uw_", "_vw_", "_ww_"];
    let mut sums: [Option<Value<'f>>; 8] = Default::default();
    // At the first point u and v are 0.
    for (i, k) in samples.enumerate().skip(1) {
        let u = f.set(Name::new("u", k + 1), at(k, 0) - at(first, 0));
        let v = f.set(Name::new("v", k + 1), at(k, 1) - at(first, 1));
        let w = f.set(Name::new("w", k + 1), u * u + v * v);
        let terms = [u.into(), v.into(), u * u, v * v, u * v, u * w, v * w, w * w];
        for ((sum, term), name) in sums.iter_mut().zip(terms).zip(names) {
            *sum = Some(f.set(own(name).at(i + 1), sum.map_or(term, |sum| sum + term)));
        }
    }
    let [u, v, uu, vv, uv, uw, vw, ww] = sums.map(|sum| sum.expect("three points or more"));
    let w = f.set(own("_w"), uu + vv);
    let central = |name: &'static str, sum: Value<'f>, p: Value<'f>, q: Value<'f>| {
        f.set(own(name), sum - p * q / n())
    };
    let (cuu, cvv, cuv) = (
        central("_cuu", uu, u, u),
        central("_cvv", vv, v, v),
        central("_cuv", uv, u, v),
    );
    let (cuw, cvw, cww) = (
        central("_cuw", uw, u, w),
        central("_cvw", vw, v, w),
        central("_cww", ww, w, w),
    );
    let det = f.set(own("_det"), cuu * cvv - cuv * cuv);
    let twice_a = f.set(own("_2a"), (cvv * cuw - cuv * cvw) / det);
    let twice_o = f.set(own("_2o"), (cuu * cvw - cuv * cuw) / det);
    let square = (w - twice_a * u - twice_o * v) / n()
        + (twice_a * twice_a + twice_o * twice_o) / f.number(4.0);
    let r = f.set(own("_r"), square.sqrt());
    let rest = f.set(own("_rest"), cww - twice_a * cuw - twice_o * cvw);
    // Rounding may make it negative.
    let residual = f.set(
        own("_residual"),
        (Expr::from(rest).abs() / n()).sqrt() / (f.number(2.0) * r),
    );
    let x = f.set(own("_a"), at(first, 0) + twice_a / f.number(2.0));
    let y = f.set(own("_o"), at(first, 1) + twice_o / f.number(2.0));
    [x, y, r, residual]
}
