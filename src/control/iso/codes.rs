//! What G and M codes do, where dialects agree.

use crate::control::iso::parse::Code;
use crate::control::iso::script::{Modes, Motion};
use crate::geom::Plane;

const NONE: Modes = Modes::NONE;

/// The codes that every word-address control shares.
pub fn common(letter: u8, tenths: i32) -> Option<Code> {
    Some(match (letter, tenths) {
        (b'G', 0) => Code::Motion(Motion::Rapid),
        (b'G', 10) => Code::Motion(Motion::Straight),
        (b'G', 170) => Code::Mode(Modes { plane: Some(Plane::G17), ..NONE }),
        (b'G', 180) => Code::Mode(Modes { plane: Some(Plane::G18), ..NONE }),
        (b'G', 190) => Code::Mode(Modes { plane: Some(Plane::G19), ..NONE }),
        (b'G', 900) => Code::Mode(Modes { absolute: Some(true), ..NONE }),
        (b'G', 940) => Code::Mode(Modes { per_minute: Some(true), ..NONE }),
        (b'M', 50) => Code::Mode(Modes { spindle: Some(false), ..NONE }),
        (b'M', 30 | 40) => Code::Mode(Modes { spindle: Some(true), ..NONE }),
        (b'G', 400) | (b'M', 90) => Code::Nothing(""),
        (b'M', 300) => Code::End,
        _ => return None,
    })
}

/// The codes of the RS274 family: LinuxCNC, grbl and their kin.
pub fn rs274(letter: u8, tenths: i32) -> Option<Code> {
    Some(match (letter, tenths) {
        (b'G', 20) => Code::Motion(Motion::Clockwise),
        (b'G', 30) => Code::Motion(Motion::Counter),
        (b'G', 382) => Code::Motion(Motion::MustTouch),
        (b'G', 383) => Code::Motion(Motion::MayTouch),
        (b'G', 100) => Code::Setting,
        (b'G', 200) => Code::Mode(Modes { metric: Some(false), ..NONE }),
        (b'G', 210) => Code::Mode(Modes { metric: Some(true), ..NONE }),
        (b'G', 911) => Code::Mode(Modes { arcs_incremental: Some(true), ..NONE }),
        (b'G', 540 | 550 | 560 | 570 | 580 | 590) => Code::Mode(Modes { offset: Some(tenths / 10 - 53), ..NONE }),
        (b'G', 591..=593) => Code::Mode(Modes { offset: Some(tenths - 584), ..NONE }),
        (b'G', 490) => Code::Mode(Modes { length: Some(false), ..NONE }),
        (b'G', 610) => Code::Mode(Modes { exact: Some(true), ..NONE }),
        (b'G', 640) => Code::Mode(Modes { exact: Some(false), ..NONE }),
        (b'M', 720) => Code::Mode(Modes { restored: Some(true), ..NONE }),
        (b'G', 80 | 800) | (b'M', 700) => Code::Nothing(""),
        (b'M', 660) => Code::Halt("ELPQ"),
        (b'M', 20) => Code::End,
        _ => return common(letter, tenths),
    })
}
