//! The block that the user types, since a program cannot write a work offset.
//!
//! Source: grbl 1.1's gcode.c. `G10 L20 P1 X…` sets G54 so that the current position reads X…, whatever G92 and the tool length are. P1 to P6 are G54 to G59
//! (grblHAL: P7 to P9 are G59.1 to G59.3). P0 is the active offset, which the end of a program sets to G54; so P names the offset. A number has up to eight
//! significant digits, a line about 80 characters. There is no rotation.

use crate::control::Request;
use crate::geom::AXIS_NAMES;
use crate::num::decimal;

/// Decimals of a position: grbl reports three in mm and four in inch.
const DECIMALS: usize = 4;

/// The block. After the program the ball is at the end of the path. The block makes that position read what it would if the measured point were at its nominal
/// position. `None` if the datum was not measured completely.
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
