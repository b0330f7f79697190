//! The state of the control after some lines of the shop.

use super::place::{FOOT, Place};
use crate::control::Request;
use crate::control::iso::writer::number;
use crate::text::{Text, text};

/// System of coordinates of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coordinates {
    Machine,
    /// A stored position of the machine, over the stated one.
    Home,
    /// The work coordinate system.
    Work,
}

/// A mode that the lines may change if they restore it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    Distance,
    Feed,
    Plane,
    Units,
    Length,
    Spindle,
}

/// The state after some lines of a place.
#[derive(Debug)]
pub struct State<'a> {
    pub request: &'a Request<'a>,
    pub place: &'a Place,
    /// Whether a line has moved along the tool axis in machine coordinates.
    pub raised: bool,
    /// Modes that differ from those of the program, with the index of the line and its code.
    pub left: Vec<(Mode, usize, String)>,
}

/// Whether a line is understood, or why it cannot be there.
pub type Judged = Result<bool, Text>;

impl State<'_> {
    /// Sets a mode: to that of the program, or to another one.
    pub fn mode(&mut self, mode: Mode, index: usize, is_own: bool, code: &str) {
        self.left.retain(|(known, ..)| *known != mode);
        if !is_own {
            self.left.push((mode, index, code.to_owned()));
        }
    }

    pub fn is_incremental(&self) -> bool {
        self.left.iter().any(|(mode, ..)| *mode == Mode::Distance)
    }

    /// A straight move to these axis words.
    pub fn moves(
        &mut self,
        axes: [Option<f64>; 3],
        incremental: bool,
        coordinates: Coordinates,
    ) -> Judged {
        let Request { plane, path, .. } = self.request;
        if !self.place.moves {
            return Err(text!("Nothing may move here"));
        }
        if self.place.before && path.start.is_some() {
            return Err(text!(
                "The job states the start of the stylus: these lines must not move it"
            ));
        }
        let [a, o, tool] = plane.axes();
        let across = axes[a].is_some() || axes[o].is_some();
        match coordinates {
            Coordinates::Home if !incremental || axes.iter().flatten().any(|x| *x != 0.0) => {
                return Err(text!(
                    "This code moves to the stated position first. Use it with G91 and 0 for the axis, then G90"
                ));
            }
            Coordinates::Work => {
                let lowest = crate::num::read(&height(self.request)).unwrap_or(f64::INFINITY);
                let high = match axes[tool] {
                    Some(x) if incremental => x > 0.0,
                    Some(x) => x >= lowest && !path.moves.is_empty(),
                    None => false,
                };
                return if high && !across {
                    Ok(true)
                } else {
                    Err(text!(
                        "A move in the work coordinate system must be along the tool axis only, to {height} or higher",
                        height(self.request)
                    ))
                };
            }
            Coordinates::Machine | Coordinates::Home => {}
        }
        if across && !self.raised {
            return Err(text!(
                "Move along the tool axis in machine coordinates first, in a line above"
            ));
        }
        self.raised |= axes[tool].is_some();
        Ok(true)
    }

    /// A tool change.
    pub fn tool(&self) -> Judged {
        if self.place.tool {
            Ok(true)
        } else {
            Err(text!(
                "A tool change must be at the top, at \"probe on\" or at the end"
            ))
        }
    }
}

pub fn decides() -> Text {
    text!("Jumps, conditions, labels, block numbers and program ends cannot be here")
}

pub fn assigns() -> Text {
    text!("An assignment here could change the results of the program")
}

pub fn transforms() -> Text {
    text!("This line writes to a table of the control or changes the coordinate system")
}

impl State<'_> {
    /// Activates or deactivates the tool length. After the last move it may stay off.
    pub fn length(&mut self, index: usize, on: bool, code: &str) {
        let is_last = self.place.key == FOOT.key;
        self.mode(Mode::Length, index, on || is_last, code);
    }
}

/// The highest position of the program along the tool axis, in its units.
pub fn height(request: &Request<'_>) -> String {
    let [_, _, tool] = request.plane.axes();
    number(request, request.highest()[tool]).to_string()
}
