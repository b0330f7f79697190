//! The moves of the control's measuring cycles, by the places of their arguments.
//!
//! Read [S]: a groove, a web and a rectangle are touched twice an axis, the positive direction first, the second axis from the centre that was found (manual 03/2009);
//! over a web out at the height of the start, down, a touch inwards, up (a generator's picture). Ours [I]: a hole and a shaft likewise, each touch from the
//! measuring path in front of its contact to as far behind it, and back.

use crate::control::own::machine::{Alarm, Machine};
use crate::control::own::{direction_at, value};
use crate::geom::Vec3;

/// Runs a cycle by the places of its arguments, lengths in mm and angles in degrees: `None` if the cycle or one of its arguments is not known here.
pub fn run(
    number: u16,
    arguments: &[(u16, f64)],
    machine: &mut Machine<'_>,
) -> Option<Result<(), Alarm>> {
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
    fn of(arguments: &[(u16, f64)]) -> Option<Self> {
        let variant = value(arguments, 1)?;
        let kind = (variant % 10.0) as u8;
        let (inside, zone) = (kind % 2 == 1, variant >= 1000.0);
        let angle = value(arguments, 10).unwrap_or(0.0);
        let along = |degrees: f64| direction_at(degrees + angle);
        let sides = match kind {
            1 | 2 => vec![
                (along(0.0), value(arguments, 5)?),
                (along(90.0), value(arguments, 5)?),
            ],
            3 | 4 => vec![(
                along(if value(arguments, 14)? == 2.0 {
                    90.0
                } else {
                    0.0
                }),
                value(arguments, 5)?,
            )],
            5 | 6 => vec![
                (along(0.0), value(arguments, 6)?),
                (along(90.0), value(arguments, 7)?),
            ],
            _ => return None,
        };
        let down = if zone || !inside {
            Some(value(arguments, 11)?)
        } else {
            None
        };
        Some(Feature {
            inside,
            sides,
            path: value(arguments, 8)?,
            down,
        })
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
                m.goes(start + out * begin)?;
                if let Some(down) = self.down {
                    m.goes(m.at - Vec3::Z * down)?;
                }
                let towards = if self.inside { out } else { -out };
                let met = m.touches_once(m.at + out * (contact - begin), towards, self.path)?;
                found += (met - start).dot(*along) / 2.0;
                m.goes(m.at.with_z(start.z))?;
                m.goes(start)?;
            }
            center = start + *along * found;
            m.goes(center)?;
        }
        Ok(())
    }
}

fn surface(arguments: &[(u16, f64)], m: &mut Machine<'_>) -> Option<Result<(), Alarm>> {
    let axis = value(arguments, 8).filter(|axis| [1.0, 2.0, 3.0].contains(axis))? as usize - 1;
    let (place, path) = (value(arguments, 5)?, value(arguments, 6)?);
    let mut towards = Vec3::ZERO;
    towards[axis] = if value(arguments, 9)? == 1.0 {
        1.0
    } else {
        -1.0
    };
    let start = m.at;
    let mut contact = start;
    contact[axis] = place - towards[axis] * m.radius;
    Some(
        m.goes(contact - towards * path)
            .and_then(|()| m.touches_once(contact, towards, path))
            .and_then(|_| m.goes(start)),
    )
}
