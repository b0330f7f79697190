//! Joins the formulas of the cycles of a set-up.

use std::borrow::Cow;

use crate::formula::node::{Samples, Variable};
use crate::formula::{
    Assignment, CycleSamples, Formula, Function, Node, NodeId, OffsetCorrection, Op, ResultDef,
};

impl Formula {
    /// Adds the formula of the next cycle with its name. Returns the shift of its variable indices.
    pub fn join(&mut self, name: &str, own: &Formula, first_sample: usize) -> u32 {
        let cycle = self.cycles.len() as u16;
        let (node, variable) = (self.nodes.len() as u32, self.assignments.len() as u32);
        let moved = |id: NodeId| NodeId(id.0 + node);
        self.nodes.extend(own.nodes.iter().map(|one| match *one {
            Node::Variable(earlier) => Node::Variable(earlier.later_by(variable)),
            Node::Trigger { sample, axis } => Node::Trigger {
                sample: sample + first_sample as u16,
                axis,
            },
            Node::Circle(samples, part) => Node::Circle(
                Samples {
                    first: samples.first + first_sample as u16,
                    ..samples
                },
                part,
            ),
            Node::Binary(op, a, b) => Node::Binary(op, moved(a), moved(b)),
            Node::Call(function, a) => Node::Call(function, moved(a)),
            Node::Atan2(y, x) => Node::Atan2(moved(y), moved(x)),
            constant @ (Node::Number(_) | Node::Length(_)) => constant,
        }));
        let assignments = own.assignments.iter();
        self.assignments.extend(assignments.map(|one| Assignment {
            cycle,
            node: moved(one.node),
            ..*one
        }));
        let later = |known: Option<Variable>| known.map(|known| known.later_by(variable));
        let results = own.results.iter().map(|one| ResultDef {
            cycle,
            variable: later(one.variable),
            ..one.clone()
        });
        self.results.extend(results);
        self.cycles.push(CycleSamples {
            name: name.to_owned(),
            first_sample,
        });
        variable
    }

    /// Adds the deviation of a result from nominal, by which the next cycle is shifted. `name` tells several shifts apart.
    pub fn shift(&mut self, result: usize, name: &'static str) -> Option<Variable> {
        let (measured, nominal) = (self.results[result].variable?, self.results[result].nominal);
        let own = self.push(Node::Variable(measured));
        let wanted = (nominal != 0.0).then(|| self.push(Node::Length(nominal)));
        let off = wanted.map_or(own, |wanted| {
            self.push(Node::Binary(Op::Subtract, own, wanted))
        });
        Some(self.assign(name, self.cycles.len() as u16, off))
    }

    /// Adds the deviation of a measured direction from nominal, degrees, by which a work offset can be rotated.
    pub fn turn(&mut self, direction: Variable, nominal: f64) -> Variable {
        let cycle = self.assignments[direction.index()].cycle;
        let off = self.off_direction(direction, nominal);
        if nominal.abs() <= 90.0 {
            return self.assign("turn", cycle, off);
        }
        let away = self.assign("turned", cycle, off);
        let turn = self.within_half_a_turn(away);
        self.assign("turn", cycle, turn)
    }

    /// Adds the rotation of the next cycle: the angle, its sine, and its cosine less 1.
    pub fn turns_next(&mut self, direction: Variable, nominal: f64) -> [Variable; 3] {
        let cycle = self.cycles.len() as u16;
        let off = self.off_direction(direction, nominal);
        let away = self.assign("away_by", cycle, off);
        let turn = self.within_half_a_turn(away);
        let angle = self.assign("turned_by", cycle, turn);
        let known = self.push(Node::Variable(angle));
        let [sine, cosine] =
            [Function::Sin, Function::Cos].map(|function| self.push(Node::Call(function, known)));
        let one = self.push(Node::Number(1.0));
        let less = self.push(Node::Binary(Op::Subtract, cosine, one));
        [
            angle,
            self.assign("sin", cycle, sine),
            self.assign("cos", cycle, less),
        ]
    }

    /// Deviation of a measured direction from nominal, degrees.
    fn off_direction(&mut self, direction: Variable, nominal: f64) -> NodeId {
        let [measured, wanted] =
            [Node::Variable(direction), Node::Number(nominal)].map(|node| self.push(node));
        if nominal == 0.0 {
            measured
        } else {
            self.push(Node::Binary(Op::Subtract, measured, wanted))
        }
    }

    /// Brings an angle into ±180°: near half a turn a control may return it a whole turn away.
    fn within_half_a_turn(&mut self, away: Variable) -> NodeId {
        let angle = self.push(Node::Variable(away));
        let [sine, cosine] =
            [Function::Sin, Function::Cos].map(|function| self.push(Node::Call(function, angle)));
        self.push(Node::Atan2(sine, cosine))
    }

    fn push(&mut self, node: Node) -> NodeId {
        self.nodes.push(node);
        NodeId(self.nodes.len() as u32 - 1)
    }

    fn assign(&mut self, name: &'static str, cycle: u16, node: NodeId) -> Variable {
        self.assignments.push(Assignment {
            name: name.into(),
            cycle,
            node,
        });
        Variable(self.assignments.len() as u32 - 1)
    }

    /// Name of a result in a text: `center.x`, in a set-up `BORE.center.x`.
    pub fn code(&self, result: &ResultDef) -> Cow<'static, str> {
        match self.cycles.get(usize::from(result.cycle)) {
            Some(cycle) if self.cycles.len() > 1 => {
                Cow::Owned(format!("{}.{}", cycle.name, result.code))
            }
            _ => Cow::Borrowed(result.code),
        }
    }

    /// Name of a result with that of its cycle, also if there is only one cycle.
    pub fn full_code(&self, result: &ResultDef) -> Cow<'static, str> {
        match self.cycles.get(usize::from(result.cycle)) {
            Some(cycle) => Cow::Owned(format!("{}.{}", cycle.name, result.code)),
            None => Cow::Borrowed(result.code),
        }
    }

    /// Whether a result has this name, in any case. The name of an only cycle may be left out.
    pub fn is_named(&self, result: &ResultDef, name: &str) -> bool {
        self.full_code(result).eq_ignore_ascii_case(name)
            || self.code(result).eq_ignore_ascii_case(name)
    }

    /// Appends the name of an assignment's value, by its index: `center_x`, in a set-up `bore_center_x`.
    pub fn push_name(&self, index: usize, text: &mut String) {
        let assignment = &self.assignments[index];
        if let Some(cycle) = self
            .cycles
            .get(usize::from(assignment.cycle))
            .filter(|_| self.cycles.len() > 1)
        {
            text.extend(cycle.name.chars().map(|c| c.to_ascii_lowercase()));
            text.push('_');
        }
        assignment.name.push_to(text);
    }
}

impl Variable {
    fn later_by(self, count: u32) -> Variable {
        Variable(self.0 + count)
    }
}

impl OffsetCorrection {
    /// The datum in the formula of a set-up, where variable indices are shifted by `count`.
    pub fn later_by(mut self, count: u32) -> OffsetCorrection {
        let later = |known: Option<Variable>| known.map(|known| known.later_by(count));
        for place in self.place.iter_mut().flatten() {
            place.measured = later(place.measured);
        }
        self.rotation = later(self.rotation);
        self
    }
}
