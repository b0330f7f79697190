//! Moves of each macro, from its arguments and the stylus position: behaviour of the macros, version 3.11 for Haas NGC [S]; their feeds and the back-off
//! between the two touches are settings of an installation [I: those of that edition].

use crate::control::edition::Edition;
use crate::control::native_run::machine::{Alarm, Machine, MoveKind};
use crate::control::native_run::{direction_at, value};
use crate::geom::Vec3;

/// Feeds of the macros, mm/min: positioning, descent and first touch, second touch.
pub const FAST: f64 = 5000.0;
pub const SEARCH: f64 = 0.6 * FAST;
pub const MEASURE: f64 = 102.0;

/// Back-off from the first contact to the start of the second touch, mm: 8 mm times a factor of the calibration, by default 0.2.
pub const BACK_OFF: f64 = 1.6;

/// Default R: distance of the start from the surface of the ball, mm.
const R: f64 = 5.0;
/// Default Q of 9843.
const Q_ANGLE: f64 = 10.0;

/// Numbers of the macros with known moves.
pub const KNOWN: [u32; 10] = [9810, 9811, 9812, 9814, 9815, 9816, 9821, 9822, 9823, 9843];

/// Runs a macro by its letters, lengths in mm and angles in degrees; `None` for an unknown number.
pub fn run(
    number: u32,
    letters: &[(char, f64)],
    edition: Edition,
    m: &mut Machine<'_>,
) -> Option<Result<(), Alarm>> {
    let [down, aside] = edition.searches();
    let search = match number {
        9811 if value(letters, 'Z').is_some() => down,
        9843 => Q_ANGLE,
        _ => aside,
    };
    let call = Call {
        letters,
        q: value(letters, 'Q').unwrap_or(search),
    };
    Some(match number {
        9810 => call.protected(m),
        9811 => call.surface(m),
        9812 => call.width(m),
        9814 => call.round(m),
        9815 => call.inside_corner(m),
        9816 => call.outside_corner(m),
        9821 => call.turned_surface(m),
        9822 => call.turned_width(m),
        9823 => call.three_points(m),
        9843 => call.wall_angle(m),
        _ => return None,
    })
}

/// Outputs of a macro after X, Y and Z: the size.
const SIZE: u16 = 3;

impl Machine<'_> {
    /// Stores a measured position as X, Y and Z. The height is that of the tip.
    fn stores_place(&mut self, center: Vec3) {
        let place = center - Vec3::Z * self.tip;
        let outputs = (0..3).map(|axis| (axis as u16, place[axis]));
        self.outputs.extend(outputs);
    }

    /// Both touches towards a position, up to `q` past it, and the retract. Returns the ball centre at the second contact. The contact is expected `before` the
    /// position: by a radius if the position is on the surface.
    pub fn measure(&mut self, place: Vec3, q: f64, before: f64) -> Result<Vec3, Alarm> {
        let start = self.at;
        let way = place - start;
        if way.length() < 1e-9 {
            return Err(Alarm::Unexpected);
        }
        let along = way.normalize();
        let (end, expected) = (place + along * q, place - along * before);
        let first = self.touch(end, expected, MoveKind::Search, Some(SEARCH))?;
        self.plain(first - along * BACK_OFF, MoveKind::Retract, Some(FAST))?;
        let contact = self.touch(end, expected, MoveKind::Measure, Some(MEASURE))?;
        self.plain(start, MoveKind::Retract, Some(FAST))?;
        Ok(contact)
    }
}

struct Call<'l> {
    letters: &'l [(char, f64)],
    q: f64,
}

/// First angle at which 9822 touches; the order changes at A = 90.
pub fn first_probe_angle(a: f64, outside: bool) -> f64 {
    let inside = if a < 90.0 { a + 90.0 } else { a - 90.0 };
    if outside { inside + 180.0 } else { inside }
}

impl Call<'_> {
    fn get(&self, letter: char) -> Option<f64> {
        value(self.letters, letter)
    }

    fn need(&self, letter: char) -> Result<f64, Alarm> {
        self.get(letter).ok_or(Alarm::Arguments)
    }

    /// Z and R of a macro that goes down beside the feature: height of the ball centre, and clearance from its surface.
    fn depth_and_clearance(&self, m: &Machine<'_>) -> Option<(f64, f64)> {
        Some((m.height(self.get('Z')?), self.get('R').unwrap_or(R)))
    }

    fn protected(&self, m: &mut Machine<'_>) -> Result<(), Alarm> {
        let mut to = m.at;
        to.x = self.get('X').unwrap_or(to.x);
        to.y = self.get('Y').unwrap_or(to.y);
        to.z = self.get('Z').map_or(to.z, |tip| m.height(tip));
        m.watched(to, self.get('F').or(Some(FAST)), Alarm::Obstructed)
    }

    fn surface(&self, m: &mut Machine<'_>) -> Result<(), Alarm> {
        let given = [
            self.get('X'),
            self.get('Y'),
            self.get('Z').map(|tip| m.height(tip)),
        ];
        let axis = given
            .iter()
            .position(Option::is_some)
            .filter(|_| given.iter().flatten().count() == 1);
        let (axis, mut surface) = (axis.ok_or(Alarm::Arguments)?, m.at);
        surface[axis] = given[axis].unwrap_or(surface[axis]);
        let before = if axis == 2 { 0.0 } else { m.radius };
        let start = m.at;
        let contact = m.measure(surface, self.q, before)?;
        m.stores_place(contact + (surface - start).normalize() * before);
        Ok(())
    }

    /// Minus side first, then plus; both end at the start. Returns the middle and the measured size.
    fn along(&self, m: &mut Machine<'_>, axis: usize, size: f64) -> Result<[f64; 2], Alarm> {
        let start = m.at;
        let (at, beside) = (
            |off: f64, height: f64| {
                let mut place = start;
                (place[axis], place.z) = (start[axis] + off, height);
                place
            },
            self.depth_and_clearance(m),
        );
        let (mut sum, mut apart) = (0.0, 0.0);
        for side in [-1.0, 1.0] {
            if let Some((height, clearance)) = beside {
                let radius = if clearance > 0.0 { m.radius } else { -m.radius };
                let off = side * (size / 2.0 + radius + clearance);
                m.watched(at(off, start.z), Some(FAST), Alarm::Unexpected)?;
                m.watched(at(off, height), Some(SEARCH), Alarm::Unexpected)?;
            }
            let height = m.at.z;
            let contact = m.measure(at(side * size / 2.0, height), self.q, m.radius)?[axis];
            (sum, apart) = (sum + contact, apart + side * contact);
            let up = Vec3::new(m.at.x, m.at.y, start.z);
            m.plain(up, MoveKind::Rapid, None)?;
            // After the first side straight back over the middle, after the second at the very end.
            if side < 0.0 {
                m.plain(start, MoveKind::Rapid, None)?;
            }
        }
        m.plain(start, MoveKind::Rapid, None)?;
        let outside = self.get('Z').is_some() && self.get('R').is_none_or(|r| r >= 0.0);
        let balls = if outside { -2.0 } else { 2.0 } * m.radius;
        Ok([sum / 2.0, apart + balls])
    }

    fn width(&self, m: &mut Machine<'_>) -> Result<(), Alarm> {
        let (axis, size) = match (self.get('X'), self.get('Y')) {
            (Some(x), None) => (0, x),
            (None, Some(y)) => (1, y),
            _ => return Err(Alarm::Arguments),
        };
        let [middle, measured] = self.along(m, axis, size)?;
        let mut center = m.at;
        center[axis] = middle;
        m.stores_place(center);
        m.outputs.push((SIZE, measured));
        Ok(())
    }

    /// Y first, then X through the measured middle.
    fn round(&self, m: &mut Machine<'_>) -> Result<(), Alarm> {
        let (size, start) = (self.need('D')?, m.at);
        let [y, _] = self.along(m, 1, size)?;
        m.plain(Vec3::new(start.x, y, start.z), MoveKind::Rapid, None)?;
        let [x, measured] = self.along(m, 0, size)?;
        m.stores_place(Vec3::new(x, y, start.z));
        m.outputs.push((SIZE, measured));
        m.plain(start, MoveKind::Rapid, None)
    }

    /// First touch of a wall at the start, or at `first`; with a step a second one, away from the corner.
    fn wall(
        &self,
        m: &mut Machine<'_>,
        (axis, place): (usize, f64),
        step: Option<f64>,
        first: Option<f64>,
    ) -> Result<(), Alarm> {
        let (start, across) = (m.at, 1 - axis);
        let mut at = start;
        if let Some(first) = first {
            at[across] = first;
            m.watched(at, Some(FAST), Alarm::Unexpected)?;
        }
        let touch = |m: &mut Machine<'_>| {
            let mut surface = m.at;
            surface[axis] = place;
            m.measure(surface, self.q, m.radius)
        };
        touch(m)?;
        if let Some(step) = step {
            at[across] += step;
            m.watched(at, Some(FAST), Alarm::Unexpected)?;
            touch(m)?;
        }
        m.plain(start, MoveKind::Retract, Some(FAST))
    }

    fn corner(&self, m: &mut Machine<'_>, outside: bool) -> Result<(), Alarm> {
        let (x, y, start) = (self.need('X')?, self.need('Y')?, m.at);
        let (first_x, first_y) = (2.0 * x - start.x, 2.0 * y - start.y);
        // From inside, away from the corner is the side of the start; from outside the opposite side.
        let sign = |wall: f64, start: f64| if (start > wall) == outside { -1.0 } else { 1.0 };
        let step = |letter: char, wall: f64, start: f64| {
            self.get(letter).map(|step| step.abs() * sign(wall, start))
        };
        self.wall(m, (0, x), step('J', y, start.y), outside.then_some(first_y))?;
        self.wall(m, (1, y), step('I', x, start.x), outside.then_some(first_x))
    }

    fn inside_corner(&self, m: &mut Machine<'_>) -> Result<(), Alarm> {
        self.corner(m, false)
    }

    fn outside_corner(&self, m: &mut Machine<'_>) -> Result<(), Alarm> {
        self.corner(m, true)
    }

    fn turned_surface(&self, m: &mut Machine<'_>) -> Result<(), Alarm> {
        let (a, d) = (self.need('A')?, self.need('D')?);
        let contact = m.measure(m.at + direction_at(a) * d, self.q, m.radius)?;
        m.stores_place(contact + direction_at(a) * m.radius);
        Ok(())
    }

    /// Out to a side, down, touch, up and back. Beside a feature Q counts from the nominal ball centre at the contact, not from the surface.
    fn side(&self, m: &mut Machine<'_>, a: f64, size: f64) -> Result<(), Alarm> {
        let start = m.at;
        let (mut towards, mut way, mut before) = (direction_at(a), size / 2.0, m.radius);
        if let Some((height, clearance)) = self.depth_and_clearance(m) {
            let radius = if clearance < 0.0 { -m.radius } else { m.radius };
            let aside = start + towards * (size / 2.0 + radius + clearance);
            m.watched(aside, Some(FAST), Alarm::Unexpected)?;
            m.watched(aside.with_z(height), Some(SEARCH), Alarm::Unexpected)?;
            (way, before) = (clearance.abs(), 0.0);
            if clearance >= 0.0 {
                towards = -towards;
            }
        }
        m.measure(m.at + towards * way, self.q, before)?;
        m.plain(m.at.with_z(start.z), MoveKind::Retract, Some(FAST))?;
        m.plain(start, MoveKind::Retract, Some(FAST))
    }

    fn turned_width(&self, m: &mut Machine<'_>) -> Result<(), Alarm> {
        let (a, size) = (self.need('A')?, self.need('D')?);
        let outside = self.get('Z').is_some() && self.get('R').is_none_or(|r| r >= 0.0);
        let first = first_probe_angle(a, outside);
        self.side(m, first, size)?;
        self.side(m, first + 180.0, size)
    }

    fn three_points(&self, m: &mut Machine<'_>) -> Result<(), Alarm> {
        let size = self.need('D')?;
        for letter in ['A', 'B', 'C'] {
            self.side(m, self.need(letter)?, size)?;
        }
        Ok(())
    }

    /// Plus side first, along the nominal wall, then minus.
    fn wall_angle(&self, m: &mut Machine<'_>) -> Result<(), Alarm> {
        let (start, half) = (m.at, self.need('D')? / 2.0);
        let (axis, place) = match (self.get('X'), self.get('Y')) {
            (Some(x), None) => (0, x),
            (None, Some(y)) => (1, y),
            _ => return Err(Alarm::Arguments),
        };
        let a = self.get('A').unwrap_or([90.0, 0.0][axis]);
        let slope = if axis == 0 {
            (90.0 - a).to_radians().tan()
        } else {
            a.to_radians().tan()
        };
        for side in [1.0, -1.0] {
            let mut off = Vec3::ZERO;
            (off[axis], off[1 - axis]) = (side * slope * half, side * half);
            m.watched(start + off, Some(FAST), Alarm::Obstructed)?;
            let mut surface = start + off;
            surface[axis] = place + off[axis];
            m.measure(surface, self.q, m.radius)?;
        }
        m.plain(start, MoveKind::Rapid, None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::native_run::machine::BallContact;

    /// Moves of a call with given contacts, by hand: kind, position, contact.
    fn made(
        number: u32,
        letters: &[(char, f64)],
        at: [f64; 3],
        mut answers: impl FnMut(Vec3, Vec3) -> Option<Vec3>,
    ) -> Vec<String> {
        let mut meets = |from, to, _: Option<Vec3>| {
            answers(from, to).map(|center| BallContact {
                center,
                surface: 0,
                edge: false,
            })
        };
        let mut m = Machine::new(at.into(), 3.0, 3.0, &mut meets);
        let end = run(number, letters, Edition::Unknown, &mut m).expect("known");
        let place = |v: Vec3| {
            v.to_array()
                .map(|x| format!("{}", (x * 1e3).round() / 1e3 + 0.0))
                .join(" ")
        };
        let row = |made: &crate::control::native_run::machine::ExecutedMove| {
            let contact = made
                .met
                .map_or_else(String::new, |met| format!(" at {}", place(met.center)));
            format!("{:?} {}{contact}", made.kind, place(made.to))
        };
        let rows = m.made.iter().map(row);
        let alarm = end.err().map(|alarm| format!("{alarm:?}"));
        rows.chain(alarm).collect()
    }

    /// A wall across X: the ball centre reaches `limit` from below.
    fn wall(limit: f64) -> impl Fn(Vec3, Vec3) -> Option<Vec3> {
        move |from: Vec3, to: Vec3| {
            let part = (limit - from.x) / (to.x - from.x);
            (from.x < limit - 1e-9 && to.x > limit).then(|| from + (to - from) * part)
        }
    }

    /// P9811 X40 Q2 from X30 with a ball of 6: the search ends with the ball centre 2 past the surface; contact at 37; back-off 1.6; second touch.
    #[test]
    fn a_surface_is_touched_twice() {
        let rows = made(
            9811,
            &[('X', 40.0), ('Q', 2.0)],
            [30.0, 5.0, -4.0],
            wall(37.0),
        );
        assert_eq!(
            rows,
            [
                "Search 42 5 -4 at 37 5 -4",
                "Retract 35.4 5 -4",
                "Measure 42 5 -4 at 37 5 -4",
                "Retract 30 5 -4",
            ]
        );
        assert_eq!(
            made(
                9811,
                &[('X', 40.0), ('Q', 2.0)],
                [30.0, 5.0, -4.0],
                |_, _| None
            )
            .last()
            .unwrap(),
            "NotFound"
        );
        assert_eq!(
            made(9811, &[('X', 40.0)], [36.96, 5.0, -4.0], wall(37.0))
                .last()
                .unwrap(),
            "Unexpected"
        );
        assert_eq!(
            made(9811, &[('X', 40.0), ('Y', 1.0)], [0.0; 3], |_, _| None),
            ["Arguments"]
        );
    }

    /// A web of 30 along Y, from 12 above: out by 15 + 3 + 4, down to the tip's Z−8 (ball centre at −5), in, up, over, the other side.
    #[test]
    fn a_web_is_gone_down_beside() {
        let faces = |from: Vec3, to: Vec3| {
            let side = from.y.signum();
            (to.z < 0.0 && (to.y * side) < 18.0 && from.y.abs() > 18.0 + 1e-9).then(|| {
                from + (to - from) * ((18.0 - from.y.abs()) / (to.y * side - from.y.abs()))
            })
        };
        let rows = made(
            9812,
            &[('Y', 30.0), ('Z', -8.0), ('R', 4.0), ('Q', 1.0)],
            [2.0, 0.0, 12.0],
            faces,
        );
        assert_eq!(
            rows,
            [
                "Watched 2 -22 12",
                "Watched 2 -22 -5",
                "Search 2 -14 -5 at 2 -18 -5",
                "Retract 2 -19.6 -5",
                "Measure 2 -14 -5 at 2 -18 -5",
                "Retract 2 -22 -5",
                "Rapid 2 -22 12",
                "Rapid 2 0 12",
                "Watched 2 22 12",
                "Watched 2 22 -5",
                "Search 2 14 -5 at 2 18 -5",
                "Retract 2 19.6 -5",
                "Measure 2 14 -5 at 2 18 -5",
                "Retract 2 22 -5",
                "Rapid 2 22 12",
                "Rapid 2 0 12",
            ]
        );
    }

    /// A hole of 20 with its middle at Y+1: Y first, then X through the measured middle.
    #[test]
    fn the_second_pair_of_a_hole_runs_through_the_found_middle() {
        // The ball centre stays within a circle of 7 about (0, 1).
        let circle = |from: Vec3, to: Vec3| {
            let (a, b) = (from - Vec3::new(0.0, 1.0, from.z), to - from);
            let (aa, ab, bb) = (a.dot(a) - 49.0, a.dot(b), b.dot(b));
            let t = (-ab + (ab * ab - aa * bb).sqrt()) / bb;
            (bb > 0.0 && (0.0..1.0).contains(&t)).then(|| from + b * t)
        };
        let rows = made(9814, &[('D', 20.0), ('Q', 3.0)], [0.0, 0.0, -5.0], circle);
        let contacts: Vec<&String> = rows
            .iter()
            .filter(|row| row.starts_with("Measure"))
            .collect();
        assert_eq!(
            contacts,
            [
                "Measure 0 -13 -5 at 0 -6 -5",
                "Measure 0 13 -5 at 0 8 -5",
                "Measure -13 1 -5 at -7 1 -5",
                "Measure 13 1 -5 at 7 1 -5"
            ]
        );
        assert_eq!(rows.last().unwrap(), "Rapid 0 0 -5");
    }

    /// Inside corner at (10, 20), start at (30, 35): X first, the second touch at a distance of J; an outside corner begins past the mirrored start.
    #[test]
    fn corners_step_away_from_the_corner() {
        // The ball centre reaches these positions across the walls, from either side.
        let contact = |planes: [f64; 2]| {
            move |from: Vec3, to: Vec3| {
                let axis = (0..2).find(|&axis| {
                    (from[axis] - planes[axis]) * (to[axis] - planes[axis]) < -1e-9
                })?;
                Some(from + (to - from) * ((planes[axis] - from[axis]) / (to[axis] - from[axis])))
            }
        };
        let touches = |number: u32, at: [f64; 3], planes: [f64; 2]| {
            let rows = made(
                number,
                &[('X', 10.0), ('Y', 20.0), ('I', 7.0), ('J', 8.0), ('Q', 1.0)],
                at,
                contact(planes),
            );
            rows.into_iter()
                .filter(|row| row.starts_with("Search"))
                .map(|row| row.split(" at").next().unwrap().to_owned())
                .collect::<Vec<_>>()
        };
        assert_eq!(
            touches(9815, [30.0, 35.0, 0.0], [13.0, 23.0]),
            [
                "Search 9 35 0",
                "Search 9 43 0",
                "Search 30 19 0",
                "Search 37 19 0"
            ]
        );
        // From outside, left of and below the corner: the first touches are as far behind the corner as the start is in front of it.
        let planes = |from: Vec3, to: Vec3| {
            // Free along X above the corner, along Y right of it.
            let free = from.y.max(to.y) < 17.0 || from.x.max(to.x) < 7.0;
            (!free).then(|| contact([7.0, 17.0])(from, to)).flatten()
        };
        let rows = made(
            9816,
            &[('X', 10.0), ('Y', 20.0), ('I', 7.0), ('J', 8.0), ('Q', 1.0)],
            [-7.0, 5.0, 0.0],
            planes,
        );
        let own: Vec<&str> = rows
            .iter()
            .filter(|row| !row.starts_with("Retract") && !row.starts_with("Measure"))
            .map(|row| row.split(" at").next().unwrap())
            .collect();
        assert_eq!(
            own,
            [
                "Watched -7 35 0",
                "Search 11 35 0",
                "Watched -7 43 0",
                "Search 11 43 0",
                "Watched 27 5 0",
                "Search 27 21 0",
                "Watched 34 5 0",
                "Search 34 21 0"
            ]
        );
    }

    /// A wall at 30 degrees: A < 90 touches at 120 first, from 90 on at A − 90; the opposite beside a web.
    #[test]
    fn the_order_of_a_turned_width_changes_at_90() {
        assert_eq!(
            [
                first_probe_angle(30.0, false),
                first_probe_angle(89.999, false),
                first_probe_angle(90.0, false)
            ],
            [120.0, 179.999, 0.0]
        );
        assert_eq!(first_probe_angle(30.0, true), 300.0);
        let rows = made(
            9822,
            &[('A', 0.0), ('D', 10.0), ('Q', 2.0)],
            [0.0; 3],
            |from: Vec3, to: Vec3| {
                (to.y.abs() > 2.0 && from.y.abs() < 2.0)
                    .then(|| Vec3::new(0.0, 2.0 * to.y.signum(), 0.0))
            },
        );
        assert_eq!(rows[0], "Search 0 7 0 at 0 2 0");
        // With Z and R inside, Q counts from the ball centre at the contact: 5 − 3 − 1 = 1 out, 1 to the contact at 2, 2 more.
        let rows = made(
            9822,
            &[
                ('A', 0.0),
                ('D', 10.0),
                ('Q', 2.0),
                ('Z', -9.0),
                ('R', -1.0),
            ],
            [0.0; 3],
            |_, _| None,
        );
        assert_eq!(
            rows[..3],
            ["Watched 0 1 0", "Watched 0 1 -6", "Search 0 4 -6"]
        );
    }

    /// A wall across X at 90 − atan(0.1): the second touches begin a step aside along it.
    #[test]
    fn a_wall_angle_begins_on_the_plus_side() {
        let rows = made(
            9843,
            &[('Y', 10.0), ('D', 20.0), ('Q', 3.0), ('A', 45.0)],
            [0.0; 3],
            |_, to: Vec3| (to.y > 8.0).then(|| Vec3::new(to.x, 7.0, 0.0)),
        );
        assert_eq!(rows[..2], ["Watched 10 10 0 at 10 7 0", "Obstructed"]);
        let rows = made(
            9843,
            &[('Y', 10.0), ('D', 20.0), ('Q', 3.0)],
            [0.0; 3],
            |_, to: Vec3| (to.y > 8.0).then(|| Vec3::new(to.x, 7.0, 0.0)),
        );
        let watched: Vec<&String> = rows
            .iter()
            .filter(|row| row.starts_with("Watched") || row.starts_with("Search"))
            .collect();
        assert_eq!(
            watched,
            [
                "Watched 10 0 0",
                "Search 10 13 0 at 10 7 0",
                "Watched -10 0 0",
                "Search -10 13 0 at -10 7 0"
            ]
        );
    }
}
