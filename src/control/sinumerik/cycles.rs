//! Moves of the control's measuring cycles, by the positions of their arguments.
//!
//! Read [S]: a groove, a web and a rectangle are touched twice for each axis, the positive direction first, the second axis from the measured centre (manual
//! 03/2009); over a web out at the height of the start, down, a touch inwards, up (a generator's picture). Ours [I]: a hole and a shaft likewise, each touch
//! from the measuring path before its contact to the same distance past it, and back.

use crate::control::native::rows::{Probed, Shape};
use crate::control::native::siemens::ROWS;
use crate::control::native_run::machine::{Alarm, Machine};
use crate::control::native_run::{direction_at, value};
use crate::geom::Vec3;

/// Runs a cycle by the positions of its arguments, lengths in mm and angles in degrees. `None` if the cycle or one of its arguments is unknown.
pub fn run(
    number: u16,
    arguments: &[(u16, f64)],
    machine: &mut Machine<'_>,
) -> Option<Result<(), Alarm>> {
    let of = called(number, machine.at, |place| value(arguments, place))?;
    let path = of.set_up?;
    match of.shape {
        Shape::Surface => Some(surface(&of, path, machine)),
        _ => {
            let aside = of.lifts || !of.inside;
            let down = if aside { Some(of.down?) } else { None };
            Some(feature(&of, (path, down), machine))
        }
    }
}

/// The feature of a call. `at` is the ball centre at the call: at the height of the touches, or above them if the cycle goes down.
pub fn called(number: u16, at: Vec3, get: impl Fn(u16) -> Option<f64>) -> Option<Probed> {
    let mut rows = ROWS.iter().filter(|row| row.number == number);
    rows.find_map(|row| row.probed(at, &get))
}

/// A hole, shaft, groove, web or rectangle. `path` is the distance of the start of a touch before its contact, and of its search past it.
fn feature(
    of: &Probed,
    (path, down): (f64, Option<f64>),
    m: &mut Machine<'_>,
) -> Result<(), Alarm> {
    let along = |degrees: f64| direction_at(degrees + of.turn);
    let [one, two] = of.sizes;
    let sides = match of.shape {
        Shape::Width => vec![(along(90.0 * of.axis as f64), one)],
        Shape::Rectangle => vec![(along(0.0), one), (along(90.0), two)],
        _ => vec![(along(0.0), one), (along(90.0), one)],
    };
    let mut center = m.at;
    for (along, size) in sides {
        let (half, start) = (size / 2.0, center);
        let mut found = 0.0;
        for side in [1.0, -1.0] {
            let out = along * side;
            let (contact, begin) = if of.inside {
                (half - m.radius, (half - m.radius - path).max(0.0))
            } else {
                (half + m.radius, half + m.radius + path)
            };
            m.goes(start + out * begin)?;
            if let Some(down) = down {
                m.goes(m.at - Vec3::Z * down)?;
            }
            let towards = if of.inside { out } else { -out };
            let met = m.touches_once(m.at + out * (contact - begin), towards, path)?;
            found += (met - start).dot(along) / 2.0;
            m.goes(m.at.with_z(start.z))?;
            m.goes(start)?;
        }
        center = start + along * found;
        m.goes(center)?;
    }
    Ok(())
}

fn surface(of: &Probed, path: f64, m: &mut Machine<'_>) -> Result<(), Alarm> {
    let (start, towards) = (m.at, of.along() * of.towards);
    let contact = of.center - towards * m.radius;
    m.goes(contact - towards * path)?;
    m.touches_once(contact, towards, path)?;
    m.goes(start)
}
