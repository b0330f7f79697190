//! The block that a user types, since a program cannot write a work offset.
//!
//! Source: grbl 1.1's gcode.c. `G10 L20 P1 X…` sets G54 so that the present position reads X…, whatever G92 and the tool length are; P1 to P6 are G54
//! to G59 (grblHAL: P7 to P9 are G59.1 to G59.3), and P0 is the active one, which the end of a program makes G54: so P names it. A number counts up to
//! eight digits, a line up to about 80 characters. There is no rotation.

use crate::control::Request;
use crate::geom::AXIS_NAMES;
use crate::num::decimal;

/// Decimals of a place: grbl itself reports three in mm and four in inch.
const DECIMALS: usize = 4;

/// The block. Where the program has ended the ball is at the end of the path: that place is to read what it would if the measured point were at
/// its nominal place. `None` if the datum was not measured, or not all of it.
pub fn typed(request: &Request<'_>, measured: [Option<f64>; 3], offset: u8) -> Option<String> {
    let datum = request.path.formula.datum.as_ref()?;
    let end = request.path.moves.last()?.to;
    let axes = request.plane.axes();
    let mut words = [String::new(), String::new(), String::new()];
    for (i, place) in datum.place.iter().enumerate() {
        let Some(place) = place.filter(|place| place.measured.is_some()) else {
            continue;
        };
        let reads = end[axes[i]] - measured[i]? + place.nominal;
        words[axes[i]] = format!(
            " {}{}",
            AXIS_NAMES[axes[i]],
            decimal(reads / request.scale, DECIMALS)
        );
    }
    let units = if request.scale == 1.0 { "G21" } else { "G20" };
    let words = words.concat();
    (!words.is_empty()).then(|| format!("{units} G10 L20 P{offset}{words}"))
}
