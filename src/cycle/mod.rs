//! The cycles. What adding one takes, step by step: "Adding a cycle" in `CONTRIBUTING.md`.

mod ency;
mod heidenhain;
mod repeat;

pub use repeat::{REPEAT, Repeat};

pub use ency::{
    CODE_GROUPS, HIGHEST_CODE, LONGEST_VECTOR, MOST_CODES, POINT, Pick, Placement, code_of,
    only_angular,
};

use crate::form::{Checker, Field, Section, SubForm};
use crate::formula::{Formula, ResultRow};
use crate::geom::{Plane, Vec3};
use crate::path::{Parameter, Path, Setup, Subject, Surface, Touch};

/// Every cycle, in the order of the gallery.
pub static CYCLES: &[&CycleDef] = &[
    &ency::types::INTERNAL_RECTANGLE_PROTECTED,
    &ency::types::DOUBLE_WALL_INTERNAL_CORNER,
    &heidenhain::two_circles::DEF,
    &ency::types::SURFACE,
    &ency::types::WALL_ANGLE,
    &ency::types::HOLE,
    &ency::types::HOLE_PROTECTED,
    &ency::types::BOSS,
    &ency::types::INTERNAL_RECTANGLE,
    &ency::types::EXTERNAL_RECTANGLE,
    &ency::types::WEB,
    &ency::types::WEB_THREE_POINTS,
    &ency::types::GROOVE,
    &ency::types::GROOVE_PROTECTED,
    &ency::types::DOUBLE_WALL_EXTERNAL_CORNER,
    &ency::types::TRIPLE_WALL_INTERNAL_CORNER,
    &ency::types::TRIPLE_WALL_EXTERNAL_CORNER,
    &ency::types::PROBE_ON_OFF,
    &ency::types::NC_ACTION,
];

/// What is known of no cycle: what stands for several of them begins with it.
pub const NONE: CycleDef = ency::BASE;

/// What is known of a cycle before its form is filled in.
#[derive(Debug)]
pub struct CycleDef {
    /// `cycle.type` in the job.
    pub key: &'static str,
    /// Its documented name.
    pub title: &'static str,
    /// What it measures, in a sentence, as a setter says it.
    pub says: &'static str,
    /// More search words: those in neither its name nor its sentence.
    pub also: &'static str,
    /// What the name of a job begins with that has none of its own.
    pub name: &'static str,
    /// Whose cycle it is, and its number there.
    pub source: &'static str,
    /// What it probes: by this a control says whether it takes the cycle.
    pub probes: Subject,
    /// Whether it has feeds and a search length of its own, and does not use the job's.
    pub own_feeds: bool,
    /// Its type number in the source's parameter table (code −1), where it has one.
    pub number: Option<i32>,
    /// The most touches it can have.
    pub most_touches: usize,
    pub fields: &'static [Field],
    /// Forms inside its form.
    pub sections: &'static [SubForm],
    /// The control and form its default job is for.
    pub home: (&'static str, &'static str),
    /// The steps of its documented list, in our words; index 0 is step 1.
    pub steps: &'static [&'static str],
    /// What is our reading and not the source's word, for the manual.
    #[cfg_attr(
        not(test),
        allow(dead_code, reason = "the documents are generated from it")
    )]
    pub readings: &'static [&'static str],
    /// Where touches that are picked one by one put it, given its loose form; `None` if its touches cannot be picked.
    pub place: Option<PlaceBy>,
    pub read: fn(&'static CycleDef, &mut Section<'_, '_>) -> Box<dyn Cycle>,
}

impl CycleDef {
    /// Its page of the manual.
    pub fn doc(&self) -> String {
        format!("docs/cycles/{}.md", self.key)
    }
}

/// Reads a loose form and says where picked touches put the feature, and which touches its dimensions give there; `None` if they do
/// not make one.
pub type PlaceBy = fn(&mut Section<'_, '_>, &[Pick], Plane) -> Option<(Placement, Vec<Pick>)>;

/// A cycle with checked dimensions. All lengths in mm, angles in degrees as in the form.
pub trait Cycle {
    /// Reports what single fields cannot know: dimensions that do not go together. Paths start with `cycle.`.
    fn rules(&self, setup: &Setup, checker: &mut Checker);

    /// The whole path. Total on every cycle that passed its rules.
    fn plan(&self, setup: &Setup) -> Path;

    /// What the control computes, as [`Cycle::plan`] gives it.
    fn formula(&self, setup: &Setup) -> Formula;

    /// The source's parameter table: what goes out, and nothing that anything is computed from. `touches` are those of the path.
    fn parameters(&self, setup: &Setup, touches: &[Touch]) -> Vec<Parameter>;

    /// Reports what only the whole path shows: where it begins and ends against the feature. Paths start with `cycle.`.
    fn review(&self, _setup: &Setup, _path: &Path, _checker: &mut Checker) {}

    /// The fields whose value the control itself has (path, label): the moves are made with what the form shows instead.
    fn set_on_the_control(&self) -> Vec<(&'static str, &'static str)> {
        Vec::new()
    }

    /// The surfaces of the feature alone, as [`Cycle::plan`] gives them.
    fn surfaces(&self, setup: &Setup) -> Vec<Surface>;

    /// The same cycle with `delta` (mm or degrees) added to the size named `key`; `None` if there is no such size, or
    /// where nothing of the feature would be left.
    fn resized(&self, setup: &Setup, key: &str, delta: f64) -> Option<Box<dyn Cycle>>;

    /// Adds what is more than arithmetic: verdicts, and rows that single touches give. `triggers` has one entry a touch.
    fn judge(
        &self,
        _setup: &Setup,
        _path: &Path,
        _triggers: &[Option<Vec3>],
        _rows: &mut Vec<ResultRow>,
    ) {
    }

    /// Why the control's value of this result is off on a turned part, where it is.
    fn turned_error(&self, code: &str) -> Option<&'static str>;
}

/// In place of a supertrait, which would keep every field of every form printable: in WebAssembly that is 4 kB of unused code.
impl std::fmt::Debug for dyn Cycle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Cycle")
    }
}

/// The cycle with this `type`.
pub fn find(key: &str) -> Option<&'static CycleDef> {
    CYCLES.iter().copied().find(|c| c.key == key)
}
