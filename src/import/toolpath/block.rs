//! What one block of a program says.

use crate::control::iso::codes::Shift;
use crate::control::iso::script::Motion;
use crate::import::toolpath::count::Count;
use crate::import::toolpath::frames::{Axes, Frames, Position};
use crate::import::toolpath::modes::Modes;

/// A call of a subprogram.
#[derive(Clone, Copy)]
pub(super) struct Call {
    /// Whether its lines begin at a block number, and not at a program's.
    pub local: bool,
    pub number: u32,
    pub times: u32,
}

/// What becomes of the modes.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum ModeChange {
    Keep { of_subprogram: bool },
    Forget,
    GiveBack,
}

/// What the length of the tool becomes.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Length {
    /// That of the tool table.
    Table,
    Nothing,
    /// The numbers of the block, or so much more.
    Given {
        added: bool,
    },
}

/// What a block says of a code that makes no place of its axis words.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub(super) enum Foreign {
    No,
    /// The code sets or stores something: nothing moves.
    Sets,
    /// The control computes the code, as `G#3` that restores a mode.
    Computed,
    /// Nothing is known of the code: it may move anything.
    Unknown,
}

/// A value of a word.
#[derive(Clone, Copy)]
pub(super) enum Word {
    Number(f64),
    /// A place (true) or a distance, whatever the mode: `AC(5)`, `IC(5)`.
    Placed(f64, bool),
    /// What the control would compute.
    Computed,
}

impl Word {
    /// NaN where the control would compute it.
    pub fn number(self) -> f64 {
        if let Word::Number(x) = self {
            x
        } else {
            f64::NAN
        }
    }
}

/// What a block says.
pub(super) struct Block {
    /// X, Y, Z, where they are given.
    pub places: [f64; 3],
    pub given: Axes,
    /// Those of them that the control would compute.
    pub computed: Axes,
    /// Those of them that are places, and those that are distances, whatever the mode.
    pub placed: Axes,
    pub moved: Axes,
    /// I, J, K from where the arc begins, or as places.
    pub center: [f64; 3],
    pub centered: Axes,
    pub radius: Option<f64>,
    /// A motion for this block alone.
    pub once: Option<Motion>,
    /// That motion is a curve, straight here.
    pub curve: bool,
    /// It names one of the motions that stay: G0 to G3, G38.n.
    pub motion: bool,
    /// Its axis words are no place to go to: G10, G92, a native cycle.
    pub elsewhere: bool,
    /// It waits. Its axis words are its time, unless it names a motion or its time by P, too.
    pub dwells: bool,
    /// It writes settings, G10: which by L.
    pub writes: bool,
    /// It changes the length of the tool.
    pub lengthens: Option<Length>,
    /// It shifts every work offset.
    pub shift: Option<Shift>,
    /// It begins (true) or ends a rotation.
    pub turns: Option<bool>,
    /// It mirrors, scales or tilts the system, or makes something else of it that is not followed.
    pub distorts: bool,
    /// A Haas' M78 and M79: what a contact, or none, is an alarm of.
    pub contact: Option<Motion>,
    /// It starts (true) or stops the spindle.
    pub spindle: Option<bool>,
    /// It puts the tool of the last T into the spindle.
    pub changes: bool,
    /// M70 to M73.
    pub keeps: Option<ModeChange>,
    /// The work offset that it selects, 1 = G54.
    pub offset: Option<i32>,
    /// Whether its number is counted on from there, by P.
    pub counts: bool,
    /// L and P; NaN where the control would compute them.
    pub l: Option<f64>,
    pub p: Option<f64>,
    /// It moves axes other than X, Y and Z.
    pub others: bool,
    /// Its places are of the machine: where that is in the work system is not known.
    pub machine: bool,
    /// It goes to a place that the machine knows, whether or not it names axes.
    pub home: bool,
    pub feed: Option<f64>,
    /// Its F is no feed that stays: a time, or an argument of a macro.
    pub feedless: bool,
    /// It ends the program.
    pub ends: bool,
    /// It goes back to where the program was called from, M99, or to the number in its P.
    pub returns: bool,
    /// It names two motions, or an axis twice.
    pub twice: bool,
    /// Something in it is not a word.
    pub strange: bool,
    /// It jumps.
    pub jumps: bool,
    /// It names a code that makes no place of its axis words.
    pub foreign: Foreign,
    /// The block starts with an M code, and its axis words may belong to that code, unless it names a motion.
    pub led: Foreign,
    /// Where the name of that code begins and ends in its line.
    pub name: [usize; 2],
    /// Where the words begin, behind the block's number.
    pub begin: usize,
    /// It calls a macro, G65, by its number P.
    pub macros: bool,
    /// It calls a subprogram: 97, 98 or 198.
    pub calls: Option<u8>,
    /// Whether one of these is so, or an axis is a place or a distance by its own.
    pub special: bool,
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
    elsewhere: false,
    dwells: false,
    writes: false,
    lengthens: None,
    shift: None,
    turns: None,
    distorts: false,
    changes: false,
    spindle: None,
    contact: None,
    keeps: None,
    offset: None,
    counts: false,
    l: None,
    p: None,
    others: false,
    machine: false,
    home: false,
    feed: None,
    feedless: false,
    ends: false,
    returns: false,
    twice: false,
    strange: false,
    jumps: false,
    foreign: Foreign::No,
    led: Foreign::No,
    name: [0; 2],
    begin: 0,
    macros: false,
    calls: None,
    special: false,
};

impl Block {
    /// Takes all words out. Places and centres stay: nothing says that they are given.
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
        (self.motion, self.elsewhere, self.dwells, self.writes) = (false, false, false, false);
        (self.lengthens, self.feedless, self.keeps) = (None, false, None);
        (self.shift, self.turns, self.distorts) = (None, None, false);
        (
            self.curve,
            self.counts,
            self.changes,
            self.spindle,
            self.contact,
        ) = (false, false, false, None, None);
        (self.machine, self.home, self.others) = (false, false, false);
        (self.ends, self.strange, self.jumps) = (false, false, false);
        (self.returns, self.twice) = (false, false);
        if self.special {
            (self.foreign, self.led, self.calls, self.special) =
                (Foreign::No, Foreign::No, None, false);
            self.macros = false;
            (self.placed, self.moved) = (0, 0);
        }
    }
}

/// A code that is not followed.
pub(super) struct Named {
    pub name: String,
    pub foreign: Foreign,
    /// What it measures, where it is a native cycle.
    pub title: Option<&'static str>,
    pub count: Count,
}

/// Where the ways of a condition part.
pub(super) struct Fork {
    pub begins: State,
    /// Where the ways before this one ended.
    pub ends: Option<State>,
    /// The line at which they meet, where it was a jump; else a word says it.
    pub until: Option<usize>,
    /// Whether one of the ways is run in any case.
    pub otherwise: bool,
}

/// What a way of the program begins or ends with.
#[derive(Clone)]
pub(super) struct State {
    pub place: Position,
    pub frames: Frames,
    pub modes: Modes,
    pub feed: f64,
}
