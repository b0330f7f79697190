//! The moves of the control's measuring cycles, by the places of their arguments.
//!
//! Read [S]: a groove, a web and a rectangle are touched twice an axis, the positive direction first, the second axis from the centre that was found (manual 03/2009);
//! over a web out at the height of the start, down, a touch inwards, up (a generator's picture). Ours [I]: a hole and a shaft likewise, each touch from the
//! measuring path in front of its contact to as far behind it, and back.

use crate::control::own::machine::{Alarm, Kind, Machine};
use crate::geom::Vec3;

/// The arguments of a call by their places: lengths in mm, angles in degrees; none where one is left out, or not known.
pub trait Arguments {
    fn get(&self, place: u16) -> Option<f64>;
}

impl Arguments for [(u16, f64)] {
    fn get(&self, place: u16) -> Option<f64> {
        self.iter().find(|(known, _)| *known == place).map(|(_, value)| *value)
    }
}

/// Runs a cycle: none of one that is not known here, or whose arguments are not.
pub fn run(number: u16, arguments: &(impl Arguments + ?Sized), machine: &mut Machine<'_>) -> Option<Result<(), Alarm>> {
    match number {
        977 => Feature::of(arguments).map(|feature| feature.run(machine)),
        978 => surface(arguments, machine),
        _ => None,
    }
}

/// What CYCLE977 is called for.
struct Feature {
    inside: bool,
    /// Directions that are measured along, and how large it is there.
    sides: Vec<(Vec3, f64)>,
    /// How far a touch begins in front of its contact, and searches behind it.
    path: f64,
    /// Down to the touches, where it goes out at the height of the start.
    down: Option<f64>,
}

impl Feature {
    fn of(arguments: &(impl Arguments + ?Sized)) -> Option<Self> {
        let variant = arguments.get(1)?;
        let kind = (variant % 10.0) as u8;
        let (inside, zone) = (kind % 2 == 1, variant >= 1000.0);
        let angle = arguments.get(10).unwrap_or(0.0);
        let along = |degrees: f64| {
            let (sin, cos) = (degrees + angle).to_radians().sin_cos();
            Vec3::new(cos, sin, 0.0)
        };
        let sides = match kind {
            1 | 2 => vec![(along(0.0), arguments.get(5)?), (along(90.0), arguments.get(5)?)],
            3 | 4 => vec![(along(if arguments.get(14)? == 2.0 { 90.0 } else { 0.0 }), arguments.get(5)?)],
            5 | 6 => vec![(along(0.0), arguments.get(6)?), (along(90.0), arguments.get(7)?)],
            _ => return None,
        };
        let down = if zone || !inside { Some(arguments.get(11)?) } else { None };
        Some(Feature { inside, sides, path: arguments.get(8)?, down })
    }

    fn run(&self, m: &mut Machine<'_>) -> Result<(), Alarm> {
        let mut center = m.at;
        for (along, size) in &self.sides {
            let (half, start) = (size / 2.0, center);
            let mut found = 0.0;
            for side in [1.0, -1.0] {
                let out = *along * side;
                let (contact, begin) = if self.inside {
                    (half - m.radius, (half - m.radius - self.path).max(0.0))
                } else {
                    (half + m.radius, half + m.radius + self.path)
                };
                goes(m, start + out * begin)?;
                if let Some(down) = self.down {
                    goes(m, m.at - Vec3::Z * down)?;
                }
                let towards = if self.inside { out } else { -out };
                let met = touches(m, m.at + out * (contact - begin), towards, self.path)?;
                found += (met - start).dot(*along) / 2.0;
                goes(m, m.at.with_z(start.z))?;
                goes(m, start)?;
            }
            center = start + *along * found;
            goes(m, center)?;
        }
        Ok(())
    }
}

fn goes(m: &mut Machine<'_>, to: Vec3) -> Result<(), Alarm> {
    if to.distance(m.at) < 1e-9 {
        m.skip();
        return Ok(());
    }
    m.watched(to, None, Alarm::Unexpected)
}

/// A touch, and back to where it began.
fn touches(m: &mut Machine<'_>, contact: Vec3, towards: Vec3, behind: f64) -> Result<Vec3, Alarm> {
    let start = m.at;
    let met = m.touch(contact + towards * behind, contact, Kind::Once, None)?;
    m.plain(start, Kind::Back, None)?;
    Ok(met)
}

fn surface(arguments: &(impl Arguments + ?Sized), m: &mut Machine<'_>) -> Option<Result<(), Alarm>> {
    let axis = arguments.get(8).filter(|axis| [1.0, 2.0, 3.0].contains(axis))? as usize - 1;
    let (place, path) = (arguments.get(5)?, arguments.get(6)?);
    let mut towards = Vec3::ZERO;
    towards[axis] = if arguments.get(9)? == 1.0 { 1.0 } else { -1.0 };
    let start = m.at;
    let mut contact = start;
    contact[axis] = place - towards[axis] * m.radius;
    Some(goes(m, contact - towards * path).and_then(|()| touches(m, contact, towards, path)).and_then(|_| goes(m, start)))
}
