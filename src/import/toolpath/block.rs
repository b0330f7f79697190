//! Contents of one block of a program.

use crate::control::iso::codes::Shift;
use crate::control::iso::script::Motion;
use crate::import::toolpath::count::Count;
use crate::import::toolpath::frames::{Axes, Frames, Position};
use crate::import::toolpath::modes::Modes;

/// A call of a subprogram.
#[derive(Clone, Copy)]
pub(super) struct Call {
    /// Whether its lines begin at a block number instead of a program number.
    pub local: bool,
    pub number: u32,
    pub times: u32,
}

/// Change of the modes.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum ModeChange {
    Keep { of_subprogram: bool },
    Discard,
    Restore,
}

/// Change of the tool length.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Length {
    /// Length from the tool table.
    Table,
    Nothing,
    /// The numbers of the block, or added to the active length.
    AxisWords {
        added: bool,
    },
}

/// Effect of a code whose axis words are not a position.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub(super) enum UnfollowedCode {
    No,
    /// The code sets or stores something: nothing moves.
    Sets,
    /// The control computes the code, as `G#3` that restores a mode.
    Computed,
    /// The code is unknown: it may move anything.
    Unknown,
}

/// Value of a word.
#[derive(Clone, Copy)]
pub(super) enum Word {
    Number(f64),
    /// A position (true) or a distance, whatever the mode: `AC(5)`, `IC(5)`.
    Placed(f64, bool),
    /// A value that the control would compute.
    Computed,
}

impl Word {
    /// NaN if the control would compute it.
    pub fn number(self) -> f64 {
        if let Word::Number(x) = self {
            x
        } else {
            f64::NAN
        }
    }
}

/// Contents of a block.
pub(super) struct Block {
    /// X, Y, Z, if given.
    pub places: [f64; 3],
    pub given: Axes,
    /// Axes whose value the control would compute.
    pub computed: Axes,
    /// Axes given as positions, and axes given as distances, whatever the mode.
    pub placed: Axes,
    pub moved: Axes,
    /// I, J, K from the start of the arc, or as positions.
    pub center: [f64; 3],
    pub centered: Axes,
    pub radius: Option<f64>,
    /// A motion for this block only.
    pub once: Option<Motion>,
    /// That motion is a curve, treated as straight.
    pub curve: bool,
    /// It names a modal motion: G0 to G3, G38.n.
    pub motion: bool,
    /// Its axis words are not a target: G10, G92, a native cycle.
    pub axis_words_are_data: bool,
    /// A dwell. Its axis words give its time, unless it also names a motion or gives the time by P.
    pub dwells: bool,
    /// It writes settings (G10); L gives the kind.
    pub writes: bool,
    /// It changes the length of the tool.
    pub changes_tool_length: Option<Length>,
    /// It shifts every work offset.
    pub shift: Option<Shift>,
    /// It begins (true) or ends a rotation.
    pub turns: Option<bool>,
    /// It mirrors, scales or tilts the system, or changes it in another way that is not modelled.
    pub distorts: bool,
    /// M78 and M79 of a Haas: contact, or no contact, is an alarm.
    pub contact: Option<Motion>,
    /// It starts (true) or stops the spindle.
    pub spindle: Option<bool>,
    /// It puts the tool of the last T into the spindle.
    pub changes: bool,
    /// M70 to M73.
    pub mode_change: Option<ModeChange>,
    /// Selected work offset, 1 = G54.
    pub offset: Option<i32>,
    /// Whether its number is counted on from there, by P.
    pub counts: bool,
    /// L and P; NaN if the control would compute them.
    pub l: Option<f64>,
    pub p: Option<f64>,
    /// It moves axes other than X, Y and Z.
    pub others: bool,
    /// Its positions are machine coordinates, whose relation to the work system is unknown.
    pub machine: bool,
    /// It moves to a position stored in the machine, whether or not it names axes.
    pub home: bool,
    pub feed: Option<f64>,
    /// Its F is not a modal feed: a time, or an argument of a macro.
    pub f_is_not_feed: bool,
    /// It ends the program.
    pub ends: bool,
    /// It returns to the caller of the program (M99), or to the number in its P.
    pub returns: bool,
    /// It names two motions, or an axis twice.
    pub conflicting_words: bool,
    /// Something in it is not a word.
    pub has_unrecognised: bool,
    /// It jumps.
    pub jumps: bool,
    /// It names a code whose axis words are not a position.
    pub foreign: UnfollowedCode,
    /// The block starts with an M code, and its axis words may belong to that code, unless it names a motion.
    pub leading_m_code: UnfollowedCode,
    /// Start and end of that code's name in its line.
    pub name: [usize; 2],
    /// Start of the words, after the block's number.
    pub begin: usize,
    /// It calls a macro (G65) by its number P.
    pub macros: bool,
    /// It calls a subprogram: 97, 98 or 198.
    pub calls: Option<u8>,
    /// Whether one of these holds, or an axis is given explicitly as a position or a distance.
    pub needs_reset: bool,
}

pub(super) const EMPTY: Block = Block {
    places: [0.0; 3],
    given: 0,
    computed: 0,
    placed: 0,
    moved: 0,
    center: [0.0; 3],
    centered: 0,
    radius: None,
    once: None,
    curve: false,
    motion: false,
    axis_words_are_data: false,
    dwells: false,
    writes: false,
    changes_tool_length: None,
    shift: None,
    turns: None,
    distorts: false,
    changes: false,
    spindle: None,
    contact: None,
    mode_change: None,
    offset: None,
    counts: false,
    l: None,
    p: None,
    others: false,
    machine: false,
    home: false,
    feed: None,
    f_is_not_feed: false,
    ends: false,
    returns: false,
    conflicting_words: false,
    has_unrecognised: false,
    jumps: false,
    foreign: UnfollowedCode::No,
    leading_m_code: UnfollowedCode::No,
    name: [0; 2],
    begin: 0,
    macros: false,
    calls: None,
    needs_reset: false,
};

impl Block {
    /// Removes all words. Positions and centres stay: nothing marks them as given.
    pub fn empty(&mut self) {
        (self.given, self.computed, self.centered) = (0, 0, 0);
        (
            self.radius,
            self.once,
            self.feed,
            self.offset,
            self.l,
            self.p,
        ) = (None, None, None, None, None, None);
        (
            self.motion,
            self.axis_words_are_data,
            self.dwells,
            self.writes,
        ) = (false, false, false, false);
        (
            self.changes_tool_length,
            self.f_is_not_feed,
            self.mode_change,
        ) = (None, false, None);
        (self.shift, self.turns, self.distorts) = (None, None, false);
        (
            self.curve,
            self.counts,
            self.changes,
            self.spindle,
            self.contact,
        ) = (false, false, false, None, None);
        (self.machine, self.home, self.others) = (false, false, false);
        (self.ends, self.has_unrecognised, self.jumps) = (false, false, false);
        (self.returns, self.conflicting_words) = (false, false);
        if self.needs_reset {
            (
                self.foreign,
                self.leading_m_code,
                self.calls,
                self.needs_reset,
            ) = (UnfollowedCode::No, UnfollowedCode::No, None, false);
            self.macros = false;
            (self.placed, self.moved) = (0, 0);
        }
    }
}

/// A code that is not modelled.
pub(super) struct UnfollowedCount {
    pub name: String,
    pub foreign: UnfollowedCode,
    /// Its measurement, if it is a native cycle.
    pub title: Option<&'static str>,
    pub count: Count,
}

/// An unknown condition, from which two branches are followed.
pub(super) struct Fork {
    pub begins: State,
    /// Joined end of the earlier branches.
    pub ends: Option<State>,
    /// Line at which the branches meet, for a jump; else a word marks it.
    pub until: Option<usize>,
    /// Whether one of the branches runs in any case.
    pub otherwise: bool,
}

/// State at the start or end of a branch.
#[derive(Clone)]
pub(super) struct State {
    pub place: Position,
    pub frames: Frames,
    pub modes: Modes,
    pub feed: f64,
}
