//! Cycles of a control's own whose path is known: who plans it, and who runs it on another part.

pub mod machine;
pub mod made;

use self::machine::{Alarm, Made, Met};
use crate::control::Report;
use crate::formula::{Limits, Wear};
use crate::geom::Vec3;
use crate::num::{decimal, tidy};
use crate::path::{Feed, Feeds, Own, OwnBlock, Path, Setup, Stored};
use crate::text::{Text, words};

/// What such a path is to be planned for.
#[derive(Debug)]
pub struct OwnRequest<'a> {
    /// The path as the cycle documents it.
    pub path: &'a Path,
    pub setup: &'a Setup,
    pub feeds: &'a Feeds,
    /// Millimetres in a unit of the job.
    pub scale: f64,
    /// The work offset to write, 1 = G54; none measures only.
    pub work_offset: Option<i32>,
    /// How the calls name it.
    pub offset: fn(i32) -> f64,
    pub limits: Limits,
    /// Of a job that switches the probe: whether on.
    pub switches_on: bool,
    pub report: Report,
    /// What the probe table adds to each clearance, mm.
    pub set_up: f64,
    /// The height between the cycles of a set-up, if native cycles make the ways between them; else `None`.
    pub clear: Option<f64>,
    /// The tools that are corrected, by the codes of the results.
    pub wear: &'a [(String, Wear)],
    /// Whether the control takes the job as a program of moves.
    pub takes_moves: bool,
}

/// Why a job is refused: code, field, words.
pub type Refused = Vec<(&'static str, String, Text)>;

/// What a ball's centre meets on a straight way.
pub type Meets<'a> = &'a dyn Fn(Vec3, Vec3) -> Option<Met>;

/// What each move met, up to the alarm that ended them.
pub type Outcome = (Vec<Made>, Option<Alarm>);

/// How native cycles are planned, run and named.
#[derive(Clone, Copy, Debug)]
pub struct OwnCycles {
    /// Plans the calls and their path on the nominal part.
    pub plan: for<'a> fn(&OwnRequest<'a>, Meets<'_>) -> Result<Path, Refused>,
    /// Runs the calls again on another part.
    pub rerun: fn(&Own, f64, Meets<'_>) -> Outcome,
    /// Whether a program of calls is read back and followed: what it does before, between and after them.
    pub followed: bool,
    /// How the calls name a work offset.
    pub offset: fn(i32) -> f64,
    /// How a manual calls a word of a call: `P9814 D`, `412 Q262`.
    pub word: fn(u32, &str) -> String,
    /// The control's name of a result.
    pub name: fn(Stored) -> String,
    /// Whether they can correct a tool offset from a measured size.
    pub corrects_tools: bool,
    /// How one program contains several of them.
    pub several: Several,
}

/// What a program of several cycles has between two of them.
#[derive(Clone, Copy, Debug)]
pub struct Several {
    /// The block of a way between two cycles: to a place, along these axes, for a ball of this radius, at a feed of this rate (mm/min).
    pub way: fn(Vec3, [bool; 3], f64, (Feed, f64)) -> OwnBlock,
    /// Whether each cycle moves to the next one at its clearance height: the program then has no block for that move.
    pub comes_itself: bool,
    /// The first and the last of the variables that keep what the next cycle empties.
    pub kept: (usize, usize),
}

impl OwnRequest<'_> {
    /// What else can be done where its own cycles do not take a job.
    pub fn advice(&self) -> Text {
        Text::words(if self.takes_moves {
            words!(". Use the form \"moves\"")
        } else {
            ""
        })
    }

    /// A length, mm, in the job's unit.
    pub fn length(&self, mm: f64) -> String {
        let unit = if self.scale == 1.0 { "mm" } else { "inch" };
        format!("{} {unit}", decimal(mm / self.scale, 4))
    }
}

/// A value of a call by its letter, or by the number of its parameter: lengths in mm, angles in degrees.
pub fn value<K: PartialEq>(values: &[(K, f64)], key: K) -> Option<f64> {
    values
        .iter()
        .find(|(known, _)| *known == key)
        .map(|(_, value)| *value)
}

/// The angle of a direction in the plane XY, degrees from X towards Y.
pub fn degrees_of(direction: Vec3) -> f64 {
    tidy(direction.y.atan2(direction.x).to_degrees())
}

/// The direction in the plane XY at an angle, degrees from X towards Y.
pub fn direction_at(degrees: f64) -> Vec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Vec3::new(cos, sin, 0.0)
}

/// Refuses a job: code, field, words.
pub fn refused(code: &'static str, field: &str, message: Text) -> Refused {
    vec![(code, field.to_owned(), message)]
}
