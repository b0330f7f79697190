//! Moves of HEIDENHAIN's probing cycles: those that the writer uses.
//!
//! The touch probe table is unknown: SET_UP is assumed 0, and a touch searches 10 mm past its contact \[I\].

use crate::control::heidenhain::cycles;
use crate::control::native::{self, Unit};
use crate::import::toolpath::reader::Reader;
use crate::path::ProbeTable;

/// Search distance past the contact, mm: DIST of the table, which is unknown.
const REACH: ProbeTable = ProbeTable {
    set_up: 0.0,
    overtravel: 10.0,
};

/// Makes the moves of a cycle; false if they are unknown, or a parameter is missing.
pub fn makes(number: &str, given: &[(u32, f64)], reader: &mut Reader) -> bool {
    let Ok(cycle) = number.parse::<u16>() else {
        return false;
    };
    if reader.place[2].is_nan() {
        return false;
    }
    let inch = if reader.path.metric == Some(false) {
        25.4
    } else {
        1.0
    };
    let call = native::find(&format!("TCH PROBE {number}"));
    let is_length = |q: u32| {
        call.and_then(|call| call.argument(&format!("Q{q}")))
            .is_some_and(|argument| argument.unit == Unit::Length)
    };
    let value = |(q, x): &(u32, f64)| {
        let number = u16::try_from(*q).ok().filter(|_| x.is_finite())?;
        Some((number, if is_length(*q) { x * inch } else { *x }))
    };
    let parameters: Vec<(u16, f64)> = given.iter().filter_map(value).collect();
    reader.makes_own(Some(|reader| &mut reader.own_cycles), false, |machine| {
        cycles::run(cycle, &parameters, REACH, machine)
    })
}
