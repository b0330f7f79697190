//! Values of expressions, and the effect of writes to a work offset.

use super::Machine;
use crate::control::iso::script::{Binary, LookAhead, Node, NodeId, Part, System, Unary};
use crate::control::trace::{OffsetEffect, Place, Trace, WrittenValue};
use crate::geom::Plane;

/// Assumed length of the tool along the tool axis, in units of the program: any number but 0.
const TOOL_LENGTH: f64 = 97.25;

/// Assumed wear of every tool: any number but 0.
const WEAR: f64 = 0.375;

/// Assumed work offset before the program writes it: any origin but 0, rotated if the control can.
const ORIGIN: Place = [311.5, -207.25, 43.75];
const TURN: f64 = 25.0;

impl Machine<'_, '_> {
    pub(super) fn part(&self, part: Part) -> f64 {
        if let Part::Turn(_, axis) = part
            && axis != self.tool_axis()
        {
            return 0.0;
        }
        let known = self.state.origins.iter().find(|(known, _)| *known == part);
        known.map_or_else(
            || before(part, self.script.offsets_lack_rotation),
            |(_, value)| *value,
        )
    }

    pub(super) fn set_part(&mut self, part: Part, value: f64) {
        match self
            .state
            .origins
            .iter_mut()
            .find(|(known, _)| *known == part)
        {
            Some((_, place)) => *place = value,
            None => self.state.origins.push((part, value)),
        }
    }

    /// Whether a work offset or a tool has changed, or reads a position differently. NaN stops the control.
    pub(super) fn changed(&self) -> bool {
        let moved = |(part, value): &(Part, f64)| {
            (value - before(*part, self.script.offsets_lack_rotation)).abs() > 1e-9
        };
        self.state.origins.iter().any(moved)
            || self
                .state
                .reading
                .is_some_and(|reading| reading.iter().flatten().all(|x| x.is_finite()))
    }

    /// Effect of the writes to the work offset, for the current ball centre.
    pub(super) fn written(&self, trace: &Trace) -> Option<OffsetEffect> {
        let number = trace.writes.iter().find_map(|write| match write.what {
            WrittenValue::Offset(number, _) => Some(number),
            WrittenValue::Tool(_) => None,
        })?;
        let plane = self.state.modes.plane.unwrap_or(Plane::G17);
        let [a, o, tool] = plane.axes();
        let turn = Part::Turn(number, tool);
        let before = |part: Part| before(part, self.script.offsets_lack_rotation);
        let (was, is) = (before(turn), self.part(turn));
        let place = self.state.at;
        // From machine coordinates to the current system.
        let turned = |degrees: f64, x: f64, y: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            (x * cos - y * sin, x * sin + y * cos)
        };
        let shift = |axis: usize| {
            before(Part::Origin(number, axis)) - self.part(Part::Origin(number, axis))
        };
        let (x, y) = turned(was, place[a], place[o]);
        let mut reading = place;
        (reading[a], reading[o]) = turned(-is, x + shift(a), y + shift(o));
        reading[tool] += shift(tool);
        if let Some(stated) = self.state.reading {
            for axis in 0..3 {
                reading[axis] = stated[axis].unwrap_or(reading[axis]);
            }
        }
        Some(OffsetEffect {
            place,
            reading,
            turn: is - was,
        })
    }

    pub(super) fn value(&self, node: NodeId) -> f64 {
        self.spend(1);
        match self.script.node(node) {
            Node::Number(x) => x,
            Node::Slot(slot) => self.slots.get(slot as usize),
            Node::System(system) => self.system(system),
            Node::Unary(unary, inner) => {
                let x = self.value(inner);
                match unary {
                    Unary::Minus => -x,
                    Unary::Abs => x.abs(),
                    Unary::Sin => x.to_radians().sin(),
                    Unary::Cos => x.to_radians().cos(),
                    Unary::Sqrt => x.sqrt(),
                }
            }
            Node::Binary(binary, left, right) => {
                let (x, y) = (self.value(left), self.value(right));
                let unknown = self.run.strict && (x.is_nan() || y.is_nan());
                let truth = |is: bool| {
                    if unknown {
                        f64::NAN
                    } else {
                        f64::from(u8::from(is))
                    }
                };
                match binary {
                    Binary::Add => x + y,
                    Binary::Subtract => x - y,
                    Binary::Multiply => x * y,
                    Binary::Divide => x / y,
                    Binary::Atan => {
                        let angle = x.atan2(y).to_degrees();
                        if self.script.full_circle {
                            angle.rem_euclid(360.0)
                        } else {
                            angle
                        }
                    }
                    Binary::Equal => truth(x == y),
                    Binary::Unequal => truth(x != y),
                    Binary::Less => truth(x < y),
                    Binary::AtMost => truth(x <= y),
                    Binary::Greater => truth(x > y),
                    Binary::AtLeast => truth(x >= y),
                    Binary::And => truth(x != 0.0 && y != 0.0),
                    Binary::Or => truth(x != 0.0 || y != 0.0),
                }
            }
        }
    }

    fn system(&self, system: System) -> f64 {
        let length = |axis: usize| {
            if axis == self.tool_axis() {
                TOOL_LENGTH
            } else {
                0.0
            }
        };
        let truth = |is: bool| f64::from(u8::from(is));
        let tells_of_the_ball = match system {
            System::Place(_)
            | System::Trigger(_)
            | System::PlaceWithLength(_)
            | System::TriggerWithLength(_) => true,
            System::Contact | System::Deflected => true,
            System::Length
            | System::Metric
            | System::UnitsCode
            | System::Tool
            | System::Fixed(_)
            | System::Offset(_) => false,
        };
        if self.run.strict
            && tells_of_the_ball
            && self.state.ahead
            && matches!(
                self.script.ahead,
                LookAhead::Reads | LookAhead::ReadsAndActs
            )
        {
            self.refused.set(true);
        }
        match system {
            System::Place(axis) => self.state.at[axis],
            System::Trigger(axis) => self.state.trigger[axis],
            System::PlaceWithLength(axis) => self.state.at[axis] + length(axis),
            System::TriggerWithLength(axis) => self.state.trigger[axis] + length(axis),
            System::Length => TOOL_LENGTH,
            System::Contact => truth(self.state.contact),
            System::Deflected => truth(self.state.deflected),
            System::Metric => self.metric,
            System::UnitsCode => 20.0 + self.metric,
            System::Tool => self.script.tool.unwrap_or(f64::NAN),
            System::Fixed(x) => x,
            System::Offset(part) => self.part(part),
        }
    }
}

/// A part of a work offset or a tool before the program.
fn before(part: Part, straight: bool) -> f64 {
    match part {
        Part::Tool(_) => WEAR,
        Part::Origin(_, axis) => ORIGIN[axis],
        Part::Turn(..) if straight => 0.0,
        Part::Turn(..) => TURN,
    }
}
