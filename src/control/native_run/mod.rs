//! Native cycles with known paths: their planning, and their simulation on another part.

pub mod compute;
pub mod executed_path;
pub mod machine;

use self::machine::{Alarm, BallContact, ExecutedMove};
use crate::control::ResultOutput;
use crate::control::edition::Edition;
use crate::formula::{Limits, Wear};
use crate::geom::Vec3;
use crate::num::{decimal, tidy};
use crate::path::{CallBlock, CallSequence, Feed, Feeds, Path, ProbeSettings, Stored};
use crate::text::{Text, words};

/// Input for planning native cycles.
#[derive(Debug)]
pub struct NativeRequest<'a> {
    /// Documented path of the cycle.
    pub path: &'a Path,
    pub setup: &'a ProbeSettings,
    pub feeds: &'a Feeds,
    /// Millimetres in a unit of the job.
    pub scale: f64,
    /// Work offset to write, 1 = G54; `None` only measures.
    pub work_offset: Option<i32>,
    /// Number of a work offset in the calls.
    pub offset: fn(i32) -> f64,
    pub limits: Limits,
    /// For a job that switches the probe: whether on.
    pub switches_on: bool,
    pub report: ResultOutput,
    /// Clearance that the probe table adds, mm.
    pub set_up: f64,
    /// Height between the cycles of a set-up, if native cycles make the link moves; else `None`.
    pub clear: Option<f64>,
    /// Corrected tools, by the codes of the results.
    pub wear: &'a [(String, Wear)],
    /// Edition of the called macros.
    pub edition: Edition,
    /// Whether the program measures and shows its results before the calls that write.
    pub measures_first: bool,
    /// Whether the control supports the job as a program of moves.
    pub takes_moves: bool,
}

/// Reasons for refusing a job: code, field, text.
pub type Rejections = Vec<(&'static str, String, Text)>;

/// First contact of the ball centre on a straight move.
pub type ContactQuery<'a> = &'a dyn Fn(Vec3, Vec3) -> Option<BallContact>;

/// The executed moves with their contacts, and the alarm that ended them, if any.
pub type NativeRun = (Vec<ExecutedMove>, Option<Alarm>);

/// How native cycles correct a tool by the error of a size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CorrectsTools {
    Never,
    /// By the whole error of a diameter or a width.
    WholeError,
    /// By a share of it, beyond a dead band, or by the mean of several parts.
    AsAsked,
}

/// Hooks of a control's native cycles: planning, simulation, naming.
#[derive(Clone, Copy, Debug)]
pub struct NativeCycles {
    /// Plans the calls and their path on the nominal part.
    pub plan: for<'a> fn(&NativeRequest<'a>, ContactQuery<'_>) -> Result<Path, Rejections>,
    /// Runs the calls on another part.
    pub rerun: fn(&CallSequence, f64, ContactQuery<'_>) -> NativeRun,
    /// Whether a program of calls is read back and traced: its own moves before, between and after them.
    pub followed: bool,
    /// Number of a work offset in the calls.
    pub offset: fn(i32) -> f64,
    /// Notation of a word of a call in a manual: `P9814 D`, `412 Q262`.
    pub word: fn(u32, &str) -> String,
    /// The control's name of a result.
    pub name: fn(Stored) -> String,
    /// How they correct a tool offset from a measured size.
    pub corrects_tools: CorrectsTools,
    /// Whether a program can measure without a write first, show the results, and then measure again and write.
    pub measures_first: bool,
    /// Linking of several cycles in one program.
    pub several: CycleLinking,
}

/// Blocks of a program between two of several cycles.
#[derive(Clone, Copy, Debug)]
pub struct CycleLinking {
    /// Block of a link move between two cycles: to a position, along these axes, for a ball of this radius, at a feed with this rate (mm/min).
    pub way: fn(Vec3, [bool; 3], f64, (Feed, f64)) -> CallBlock,
    /// Whether each cycle moves to the next one at its clearance height, so that the program needs no block for the link move.
    pub links_itself: bool,
    /// Whether the program computes with the results between the cycles: relations, and positions and sizes that follow them.
    pub computes: bool,
    /// Block at the end that activates a row of a table. Each cycle may write into it, since it becomes active only then; if `None`, only the last cycle writes.
    pub activates: Option<fn(i32) -> CallBlock>,
    /// First and last of the variables that save results before the next cycle overwrites them.
    pub saved_variables: (usize, usize),
}

impl NativeRequest<'_> {
    /// Advice if its native cycles do not support a job.
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

/// Value of a call by its letter or parameter number: lengths in mm, angles in degrees.
pub fn value<K: PartialEq>(values: &[(K, f64)], key: K) -> Option<f64> {
    values
        .iter()
        .find(|(known, _)| *known == key)
        .map(|(_, value)| *value)
}

/// Angle of a direction in the plane XY, degrees from X towards Y.
pub fn degrees_of(direction: Vec3) -> f64 {
    tidy(direction.y.atan2(direction.x).to_degrees())
}

/// Direction in the plane XY at an angle, degrees from X towards Y.
pub fn direction_at(degrees: f64) -> Vec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Vec3::new(cos, sin, 0.0)
}

/// Refuses a job: code, field, words.
pub fn refused(code: &'static str, field: &str, message: Text) -> Rejections {
    vec![(code, field.to_owned(), message)]
}
