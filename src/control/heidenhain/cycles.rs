//! The moves of the control's 4xx cycles, by their Q parameters.
//!
//! Read in the control's own pages for 413, 421, 423, 424, 425 and 427 [S]: points in the order of the angle, on an arc between them or over the clearance
//! height, the first touch of 425 towards plus, all touches from the middle where there is no room, the end at the clearance height. Positioning logic,
//! 411, 412, 417 and 419 follow a simulator that was written from the manual [S]. Ours [I]: 408, 409, 410 and 426 like the related cycles, the sides of a
//! rectangle counter-clockwise from the first axis' plus side, a ridge from its plus side.

use crate::control::own::machine::{Alarm, Machine};
use crate::control::own::{direction_at, value};
use crate::geom::Vec3;
use crate::path::{Arc, Reach};

/// Runs a cycle by its Q parameters, lengths in mm and angles in degrees: `None` if the cycle or one of its parameters is not known here.
pub fn run(number: u16, parameters: &[(u16, f64)], reach: Reach, machine: &mut Machine<'_>) -> Option<Result<(), Alarm>> {
    let mut cycle = Cycle { parameters, reach, high: f64::NAN, machine };
    let known = match number {
        412 | 421 => cycle.circle(true),
        413 | 422 => cycle.circle(false),
        410 | 423 => cycle.rectangle(true),
        411 | 424 => cycle.rectangle(false),
        408 => cycle.slot(),
        425 => cycle.width(),
        409 => cycle.ridge(),
        426 => cycle.ridge_by_points(),
        417 => cycle.down(294),
        427 if cycle.get(272) == Some(3.0) => cycle.down(261),
        419 | 427 => cycle.coordinate(),
        _ => None,
    }?;
    Some(known)
}

/// What became of a cycle whose parameters are known.
type Run = Option<Result<(), Alarm>>;

struct Cycle<'c, 'w> {
    parameters: &'c [(u16, f64)],
    reach: Reach,
    /// The clearance height.
    high: f64,
    machine: &'c mut Machine<'w>,
}

impl Cycle<'_, '_> {
    fn get(&self, number: u16) -> Option<f64> {
        value(self.parameters, number)
    }

    /// From a surface to the ball's centre where its touch begins.
    fn aside(&self) -> f64 {
        self.machine.radius + self.reach.set_up + self.get(320).unwrap_or(0.0)
    }

    /// The positioning logic: below the clearance height up to it first, then in the plane, then down.
    fn comes(&mut self, to: Vec3) -> Result<(), Alarm> {
        let high = self.machine.at.z.max(self.high);
        let up = self.machine.at.with_z(high);
        self.machine.goes(up)?;
        self.machine.goes(to.with_z(high))?;
        self.machine.goes(to)
    }

    /// A touch towards where the contact should be, and back.
    fn touches(&mut self, contact: Vec3) -> Result<(), Alarm> {
        let towards = (contact - self.machine.at).normalize_or_zero();
        self.machine.touches_once(contact, towards, self.reach.behind).map(|_| ())
    }

    fn ends(&mut self) -> Result<(), Alarm> {
        let up = self.machine.at.with_z(self.high);
        self.machine.goes(up)
    }

    /// The centre of a feature, at the measuring height; takes the clearance height, too.
    fn center(&mut self) -> Option<Vec3> {
        let [x, y] = [self.get(321).or(self.get(273))?, self.get(322).or(self.get(274))?];
        self.high = self.get(260)?;
        Some(Vec3::new(x, y, self.get(261)?))
    }

    /// Touch by touch from the angle of the first on.
    fn circle(&mut self, inside: bool) -> Run {
        let center = self.center()?;
        let half = self.get(262)? / 2.0;
        let (start, step) = (self.get(325).unwrap_or(0.0), self.get(247).unwrap_or(90.0));
        let count = self.get(423).unwrap_or(4.0);
        let sign = if inside { -1.0 } else { 1.0 };
        let off = (half + sign * self.aside()).max(0.0);
        // From the middle nothing lies between the touches.
        let lifts = self.get(301) == Some(1.0) && off > 0.0;
        let arc = self.get(365).unwrap_or(1.0) == 1.0 && off > 0.0;
        Some((0..(count as usize).clamp(1, 8)).try_for_each(|k| {
            let towards = direction_at(start + step * k as f64);
            let place = center + towards * off;
            match k {
                0 => self.comes(place)?,
                _ if lifts => self.comes(place)?,
                _ if arc => self.machine.along(Arc { center, sweep: step.to_radians() }, Alarm::Unexpected)?,
                _ => self.machine.goes(place)?,
            }
            self.touches(center + towards * (half + sign * self.machine.radius))
        }))
        .map(|run| run.and_then(|()| self.ends()))
    }

    /// Four sides, one touch each.
    fn rectangle(&mut self, inside: bool) -> Run {
        let center = self.center()?;
        let halves = [self.get(323).or(self.get(282))? / 2.0, self.get(324).or(self.get(283))? / 2.0];
        let sign = if inside { -1.0 } else { 1.0 };
        let room = halves.iter().all(|half| half + sign * self.aside() >= 0.0);
        let off = halves.map(|half| if room { half + sign * self.aside() } else { 0.0 });
        let lifts = self.get(301) == Some(1.0) && room;
        let sides = [(Vec3::X, 0), (Vec3::Y, 1), (-Vec3::X, 0), (-Vec3::Y, 1)];
        Some(sides.iter().enumerate().try_for_each(|(k, (towards, axis))| {
            let place = center + *towards * off[*axis];
            if k == 0 || lifts {
                self.comes(place)?;
            } else {
                // Round the corner, along the axes.
                let before = sides[k - 1];
                self.machine.goes(place + before.0 * off[before.1])?;
                self.machine.goes(place)?;
            }
            self.touches(center + *towards * (halves[*axis] + sign * self.machine.radius))
        }))
        .map(|run| run.and_then(|()| self.ends()))
    }

    /// The axis that is measured along.
    fn axis(&self) -> Option<Vec3> {
        match self.get(272)? {
            1.0 => Some(Vec3::X),
            2.0 => Some(Vec3::Y),
            _ => None,
        }
    }

    fn slot(&mut self) -> Run {
        let (center, axis, half) = (self.center()?, self.axis()?, self.get(311)? / 2.0);
        let off = (half - self.aside()).max(0.0);
        let lifts = self.get(301) == Some(1.0) && off > 0.0;
        Some([1.0, -1.0].into_iter().try_for_each(|side| {
            let place = center + axis * side * off;
            if lifts || side > 0.0 {
                self.comes(place)?
            } else {
                self.machine.goes(place)?
            }
            self.touches(center + axis * side * (half - self.machine.radius))
        }))
        .map(|run| run.and_then(|()| self.ends()))
    }

    /// From where it stands to both sides.
    fn width(&mut self) -> Run {
        let start = Vec3::new(self.get(328)?, self.get(329)?, self.get(261)?);
        let (axis, half) = (self.axis()?, self.get(311)? / 2.0);
        self.high = self.get(260)?;
        let across = if axis == Vec3::X { Vec3::Y } else { Vec3::X };
        let second = start + across * self.get(310).unwrap_or(0.0);
        let contact = half - self.machine.radius;
        Some(
            self.comes(start)
                .and_then(|()| self.touches(start + axis * contact))
                .and_then(|()| self.machine.goes(second))
                .and_then(|()| self.touches(second - axis * contact))
                .and_then(|()| self.ends()),
        )
    }

    fn ridge(&mut self) -> Run {
        let (center, axis, half) = (self.center()?, self.axis()?, self.get(311)? / 2.0);
        Some(self.over_a_ridge(axis, [center + axis * half, center - axis * half]))
    }

    fn ridge_by_points(&mut self) -> Run {
        let height = self.get(261)?;
        self.high = self.get(260)?;
        let points = [Vec3::new(self.get(263)?, self.get(264)?, height), Vec3::new(self.get(265)?, self.get(266)?, height)];
        Some(self.over_a_ridge(self.axis()?, points))
    }

    /// One side, over the clearance height, the other side.
    fn over_a_ridge(&mut self, axis: Vec3, points: [Vec3; 2]) -> Result<(), Alarm> {
        // Towards the other side.
        let along = axis * (points[0] - points[1]).dot(axis).signum();
        for (point, out) in points.into_iter().zip([along, -along]) {
            self.comes(point + out * self.aside())?;
            self.touches(point + out * self.machine.radius)?;
        }
        self.ends()
    }

    /// Down onto a surface, whose height stands in a parameter.
    fn down(&mut self, height: u16) -> Run {
        let surface = Vec3::new(self.get(263)?, self.get(264)?, self.get(height)?);
        self.high = self.get(260)?;
        Some(
            self.comes(surface + Vec3::Z * self.aside())
                .and_then(|()| self.touches(surface + Vec3::Z * self.machine.radius))
                .and_then(|()| self.ends()),
        )
    }

    fn coordinate(&mut self) -> Run {
        let place = Vec3::new(self.get(263)?, self.get(264)?, self.get(261)?);
        self.high = self.get(260)?;
        let towards = self.axis()? * self.get(267)?.signum();
        Some(
            self.comes(place - towards * self.aside())
                .and_then(|()| self.touches(place - towards * self.machine.radius))
                .and_then(|()| self.ends()),
        )
    }
}
