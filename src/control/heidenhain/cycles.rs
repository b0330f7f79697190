//! Moves of the control's 4xx cycles, by their Q parameters.
//!
//! From the control's own pages for 413, 421, 423, 424, 425 and 427 [S]: points in the order of the angle, on an arc between them or over the clearance height;
//! the first touch of 425 towards plus; all touches from the middle if there is no room; the end at the clearance height. Positioning logic, 411, 412, 417 and
//! 419 follow a simulator that was written from the manual [S]. Ours [I]: 408, 409, 410 and 426 like the related cycles, the sides of a rectangle
//! counter-clockwise from the plus side of the first axis, a ridge from its plus side.

use crate::control::native::heidenhain::row;
use crate::control::native::rows::{Is, Probed, Shape};
use crate::control::native_run::machine::{Alarm, ExecutedMove, Machine, MoveKind};
use crate::control::native_run::{direction_at, value};
use crate::formula::fit_circle;
use crate::geom::{Vec2, Vec3};
use crate::path::{Arc, ProbeTable};

/// Runs a cycle by its Q parameters, lengths in mm and angles in degrees. `None` if the cycle or one of its parameters is unknown.
pub fn run(
    number: u16,
    parameters: &[(u16, f64)],
    reach: ProbeTable,
    machine: &mut Machine<'_>,
) -> Option<Result<(), Alarm>> {
    let row = row(number)?;
    let of = row.probed(Vec3::NAN, |q| value(parameters, q))?;
    let before = machine.made.len();
    let mut cycle = Cycle {
        of,
        reach,
        high: of.high?,
        machine,
    };
    // No circle has more than a turn between two touches, and an arc of many turns would take as long to simulate.
    if of.step.abs() > 360.0 {
        return None;
    }
    let done = match (of.shape, of.inside) {
        (Shape::Bore, _) => cycle.circle(),
        (Shape::Rectangle, _) => cycle.rectangle(),
        // The writing cycle begins near each wall and may lift between them. The measuring cycle goes to both walls from the middle.
        (Shape::Width, true) if row.writes == Some(true) => cycle.slot(),
        (Shape::Width, true) => cycle.width(),
        (Shape::Width, false) => cycle.ridge(),
        (Shape::Surface, _) => cycle.surface(),
    };
    let done = done.and_then(|()| cycle.ends());
    if done.is_ok() {
        let contacts = contacts(&machine.made[before..]);
        let found = measured(&of, &contacts, machine.radius);
        let outputs = row.results.iter().filter_map(|(q, is)| {
            let value = match is {
                Is::Center(axis) => found.center[*axis],
                Is::Along => found.center[of.axis],
                Is::Size(n) => found.sizes[*n],
                _ => return None,
            };
            Some((*q, value))
        });
        machine.outputs.extend(outputs);
    }
    Some(done)
}

/// Ball centres at the touches.
fn contacts(made: &[ExecutedMove]) -> Vec<Vec3> {
    let touches = made
        .iter()
        .filter(|made| made.kind == MoveKind::SingleTouch);
    touches.filter_map(|made| Some(made.met?.center)).collect()
}

/// Centre and sizes of a feature from its touches, in their order. What they do not give stays as in the call.
fn measured(of: &Probed, contacts: &[Vec3], radius: f64) -> Probed {
    let mut found = *of;
    let balls = if of.inside { 2.0 } else { -2.0 } * radius;
    // Two opposite walls: the first on the plus side.
    let mut walls = |axis: usize, n: usize, [one, two]: [Vec3; 2]| {
        found.center[axis] = f64::midpoint(one[axis], two[axis]);
        found.sizes[n] = (one[axis] - two[axis]).abs() + balls;
    };
    match (of.shape, contacts) {
        (Shape::Surface, [one]) => {
            let axis = of.axis;
            let towards = if axis == 2 { -1.0 } else { of.towards };
            found.center[axis] = one[axis] + towards * radius;
        }
        (Shape::Width, [one, two]) => walls(of.axis, 0, [*one, *two]),
        (Shape::Rectangle, [x, y, opposite_x, opposite_y]) => {
            walls(0, 0, [*x, *opposite_x]);
            walls(1, 1, [*y, *opposite_y]);
        }
        (Shape::Bore, points) => {
            let plane: Vec<Vec2> = points.iter().map(|point| point.truncate()).collect();
            if let Some(fit) = fit_circle(&plane) {
                found.center = fit.center.extend(of.center.z);
                found.sizes[0] = 2.0 * fit.radius + balls;
            }
        }
        _ => {}
    }
    found
}

struct Cycle<'c, 'w> {
    of: Probed,
    reach: ProbeTable,
    /// Clearance height.
    high: f64,
    machine: &'c mut Machine<'w>,
}

impl Cycle<'_, '_> {
    /// Distance from a surface to the ball centre where its touch begins.
    fn aside(&self) -> f64 {
        self.machine.radius + self.reach.set_up + self.of.set_up.unwrap_or(0.0)
    }

    /// Positioning logic: from below the clearance height first up to it, then in the plane, then down.
    fn comes(&mut self, to: Vec3) -> Result<(), Alarm> {
        let high = self.machine.at.z.max(self.high);
        let up = self.machine.at.with_z(high);
        self.machine.goes(up)?;
        self.machine.goes(to.with_z(high))?;
        self.machine.goes(to)
    }

    /// A touch towards the expected contact, and its retract.
    fn touches(&mut self, contact: Vec3) -> Result<(), Alarm> {
        let towards = (contact - self.machine.at).normalize_or_zero();
        self.machine
            .touches_once(contact, towards, self.reach.overtravel)
            .map(|_| ())
    }

    fn ends(&mut self) -> Result<(), Alarm> {
        let up = self.machine.at.with_z(self.high);
        self.machine.goes(up)
    }

    /// +1 outwards from a feature, −1 into it.
    fn sign(&self) -> f64 {
        if self.of.inside { -1.0 } else { 1.0 }
    }

    /// Touches a circle in steps from the first angle on.
    fn circle(&mut self) -> Result<(), Alarm> {
        let Probed {
            center,
            sizes: [diameter, _],
            start,
            step,
            count,
            ..
        } = self.of;
        let (half, sign) = (diameter / 2.0, self.sign());
        let off = (half + sign * self.aside()).max(0.0);
        // From the middle nothing is between the touches.
        let lifts = self.of.lifts && off > 0.0;
        let arc = self.of.arcs && off > 0.0;
        (0..(count as usize).clamp(1, 8)).try_for_each(|k| {
            let towards = direction_at(start + step * k as f64);
            let place = center + towards * off;
            match k {
                0 => self.comes(place)?,
                _ if lifts => self.comes(place)?,
                _ if arc => self.machine.along(
                    Arc {
                        center,
                        sweep: step.to_radians(),
                    },
                    Alarm::Unexpected,
                )?,
                _ => self.machine.goes(place)?,
            }
            self.touches(center + towards * (half + sign * self.machine.radius))
        })
    }

    /// Four sides with one touch each.
    fn rectangle(&mut self) -> Result<(), Alarm> {
        let center = self.of.center;
        let (halves, sign) = (self.of.sizes.map(|size| size / 2.0), self.sign());
        let room = halves.iter().all(|half| half + sign * self.aside() >= 0.0);
        let off = halves.map(|half| {
            if room {
                half + sign * self.aside()
            } else {
                0.0
            }
        });
        let lifts = self.of.lifts && room;
        let sides = [(Vec3::X, 0), (Vec3::Y, 1), (-Vec3::X, 0), (-Vec3::Y, 1)];
        sides
            .iter()
            .enumerate()
            .try_for_each(|(k, (towards, axis))| {
                let place = center + *towards * off[*axis];
                if k == 0 || lifts {
                    self.comes(place)?;
                } else {
                    // Around the corner, along the axes.
                    let before = sides[k - 1];
                    self.machine.goes(place + before.0 * off[before.1])?;
                    self.machine.goes(place)?;
                }
                self.touches(center + *towards * (halves[*axis] + sign * self.machine.radius))
            })
    }

    fn slot(&mut self) -> Result<(), Alarm> {
        let (center, axis, half) = (self.of.center, self.of.along(), self.of.sizes[0] / 2.0);
        let off = (half - self.aside()).max(0.0);
        let lifts = self.of.lifts && off > 0.0;
        [1.0, -1.0].into_iter().try_for_each(|side| {
            let place = center + axis * side * off;
            if lifts || side > 0.0 {
                self.comes(place)?
            } else {
                self.machine.goes(place)?
            }
            self.touches(center + axis * side * (half - self.machine.radius))
        })
    }

    /// Touches on both sides of the current position.
    fn width(&mut self) -> Result<(), Alarm> {
        let (start, axis) = (self.of.center, self.of.along());
        let across = if axis == Vec3::X { Vec3::Y } else { Vec3::X };
        let second = start + across * self.of.beside;
        let contact = self.of.sizes[0] / 2.0 - self.machine.radius;
        self.comes(start)?;
        self.touches(start + axis * contact)?;
        self.machine.goes(second)?;
        self.touches(second - axis * contact)
    }

    /// One side, across at the clearance height, the other side.
    fn ridge(&mut self) -> Result<(), Alarm> {
        let (points, axis) = (self.of.walls(), self.of.along());
        // Towards the other side.
        let along = axis * (points[0] - points[1]).dot(axis).signum();
        for (point, out) in points.into_iter().zip([along, -along]) {
            self.comes(point + out * self.aside())?;
            self.touches(point + out * self.machine.radius)?;
        }
        Ok(())
    }

    /// One touch along an axis; along the tool axis downwards.
    fn surface(&mut self) -> Result<(), Alarm> {
        let Probed {
            center,
            axis,
            towards,
            ..
        } = self.of;
        let towards = self.of.along() * if axis == 2 { -1.0 } else { towards };
        self.comes(center - towards * self.aside())?;
        self.touches(center - towards * self.machine.radius)
    }
}
