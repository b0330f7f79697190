//! The state of the control after some lines of the shop.

use super::place::{BEFORE_WRITE, FOOT, Place};
use crate::control::Request;
use crate::control::iso::codes::Family;
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
}

/// The state after some lines of a place.
#[derive(Debug)]
pub struct State<'a> {
    pub request: &'a Request<'a>,
    place: &'a Place,
    /// Index of the current line.
    pub index: usize,
    /// Whether a line has moved along the tool axis in machine coordinates.
    raised: bool,
    /// Whether positions differ from those of the program: by another tool, length or work offset.
    changed: bool,
    /// Whether a line may have moved in the plane.
    across: bool,
    /// Modes that differ from those of the program, with the index of the line and its code.
    pub left: Vec<(Mode, usize, String)>,
}

/// Whether a line is understood, or why it cannot be there.
pub type Judged = Result<bool, Text>;

impl<'a> State<'a> {
    pub fn new(request: &'a Request<'a>, place: &'a Place) -> Self {
        State {
            request,
            place,
            index: 0,
            raised: false,
            changed: false,
            across: false,
            left: Vec::new(),
        }
    }

    /// Sets a mode: to that of the program, or to another one.
    pub fn mode(&mut self, mode: Mode, is_own: bool, code: &str) {
        self.left.retain(|(known, ..)| *known != mode);
        if !is_own {
            self.left.push((mode, self.index, code.to_owned()));
        }
    }

    /// The program's code of a mode.
    pub fn own_code(&self, mode: Mode) -> String {
        let dialect = self.request.post.dialect;
        let code = match mode {
            Mode::Distance => "G90",
            Mode::Feed => "G94",
            Mode::Plane => self.request.plane.word(),
            Mode::Units if self.request.scale == 1.0 => dialect.units.0,
            Mode::Units => dialect.units.1,
            Mode::Length if self.request.post.family == Family::Sinumerik => "D1",
            Mode::Length => "G43",
        };
        code.to_owned()
    }

    fn has_left(&self, mode: Mode) -> bool {
        self.left.iter().any(|(known, ..)| *known == mode)
    }

    pub fn is_incremental(&self) -> bool {
        self.has_left(Mode::Distance)
    }

    /// Whether anything may move here.
    pub fn may_move(&self) -> Result<(), Text> {
        if !self.place.moves {
            return Err(text!(
                "Nothing may move before an alarm: the stylus may touch the part"
            ));
        }
        if self.place.before && self.request.path.start.is_some() {
            return Err(text!(
                "The job states the start of the stylus: these lines must not move it"
            ));
        }
        Ok(())
    }

    /// A straight move to these axis words, NaN for a computed one. Only a move to the top of the tool axis, or up, is understood.
    pub fn moves(
        &mut self,
        axes: [Option<f64>; 3],
        incremental: bool,
        coordinates: Coordinates,
    ) -> Judged {
        self.may_move()?;
        let [a, o, tool] = self.request.plane.axes();
        let across = axes[a].is_some() || axes[o].is_some();
        if coordinates == Coordinates::Work {
            return self.moves_in_work(axes[tool], across, incremental);
        }
        let at_zero = axes.iter().flatten().all(|x| *x == 0.0);
        if coordinates == Coordinates::Home && axes == [None; 3] {
            return Err(text!("Without an axis word, this code moves every axis"));
        }
        if coordinates == Coordinates::Home && !(incremental && at_zero) {
            return Err(text!(
                "This code moves to the stated position first. Use it with G91 and 0 for the axis, then G90"
            ));
        }
        if coordinates == Coordinates::Machine && incremental {
            return Err(text!("A position in machine coordinates needs G90"));
        }
        if across && !self.raised {
            return Err(text!(
                "Move along the tool axis in machine coordinates first, in a line above"
            ));
        }
        self.raised |= axes[tool].is_some();
        self.across |= across;
        Ok(!across && at_zero)
    }

    /// A retract along the tool axis to the end of travel.
    pub fn retracts(&mut self) -> Judged {
        self.may_move()?;
        self.raised = true;
        Ok(true)
    }

    /// A move in work coordinates: up by a distance, or after the touches to the clearance or higher.
    fn moves_in_work(&self, to: Option<f64>, across: bool, incremental: bool) -> Judged {
        // Before the first move the stylus may be over the part.
        let changed =
            self.place.before || self.changed || self.across || self.has_left(Mode::Units);
        let lowest = crate::num::read(&height(self.request)).unwrap_or(f64::INFINITY);
        let is_high = match to {
            Some(x) if incremental => x > 0.0,
            Some(x) => !changed && x >= lowest && !self.request.path.moves.is_empty(),
            None => false,
        };
        if is_high && !across {
            return Ok(true);
        }
        Err(text!(
            "In work coordinates only a move along the tool axis is possible: up with G91, or after the touches to {height} and higher",
            height(self.request)
        ))
    }

    /// A tool change, with the number of the tool if it is known.
    pub fn tool(&mut self, tool: Option<f64>) -> Result<(), Text> {
        if !self.place.tool {
            return Err(text!(
                "A tool change must be at the top, at \"probe on\" or at the end"
            ));
        }
        self.changed = true;
        match (tool, self.request.tool) {
            (Some(own), Some(tool)) if self.place.before && own != f64::from(tool) => {
                Err(self.other_tool())
            }
            _ => Ok(()),
        }
    }

    /// Refusal of another tool than the probe.
    pub fn other_tool(&self) -> Text {
        text!(
            "The tool of the probe is {tool}, not this one",
            self.request
                .tool
                .map_or_else(String::new, |tool| tool.to_string())
        )
    }

    /// Selects a work offset.
    pub fn offset(&mut self) -> Result<(), Text> {
        self.changed = true;
        if self.place.offset {
            return Ok(());
        }
        Err(text!(
            "A work offset must be selected at the top, at \"probe on\" or at the end"
        ))
    }

    /// Whether M5 changes nothing that the program relies on.
    pub fn may_release_spindle(&self) -> bool {
        self.request.orient.is_none() || self.place.tool
    }

    /// Whether these lines are between the last touch and the write.
    pub fn is_before_write(&self) -> bool {
        self.place.key == BEFORE_WRITE.key
    }

    /// Activates or deactivates the tool length: before the program's checks, or after its last move.
    pub fn length(&mut self, on: bool, code: &str) -> Result<(), Text> {
        if !self.place.tool {
            return Err(text!(
                "The tool length must not change after the program has checked it"
            ));
        }
        self.changed = true;
        let is_last = self.place.key == FOOT.key;
        self.mode(Mode::Length, on || is_last, code);
        Ok(())
    }
}

pub fn decides() -> Text {
    text!(
        "Jumps, conditions, labels, block numbers, skipped blocks and program ends cannot be here"
    )
}

pub fn assigns() -> Text {
    text!("An assignment here could change the results of the program")
}

pub fn spindle() -> Text {
    text!("The spindle must not turn with the probe in it")
}

pub fn writes() -> Text {
    text!("This line writes to a table of the control")
}

pub fn transforms() -> Text {
    text!("This line changes the coordinate system")
}

pub fn moves_otherwise() -> Text {
    text!("Only straight moves are possible here: no probing, no arcs, no cycles")
}

/// The highest position of the program along the tool axis, in its units.
pub fn height(request: &Request<'_>) -> String {
    let [_, _, tool] = request.plane.axes();
    number(request, request.highest()[tool]).to_string()
}
