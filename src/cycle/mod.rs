//! The cycles. "Adding a cycle" in `CONTRIBUTING.md` lists the steps for a new one.

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
use crate::path::{FeatureKind, Parameter, Path, ProbeSettings, Surface, Touch};

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

/// Definition without a cycle, as a placeholder for set-ups.
pub const SET_UP_PLACEHOLDER: CycleDef = ency::BASE;

/// Definition of a cycle, known before its form is filled in.
#[derive(Debug)]
pub struct CycleDef {
    /// `cycle.type` in the job.
    pub key: &'static str,
    /// Documented name.
    pub title: &'static str,
    /// Sentence about its measurement, in a setter's words.
    pub summary: &'static str,
    /// Further search words, which are in neither the name nor the sentence.
    pub search_words: &'static str,
    /// Beginning of the default name of a job.
    pub name: &'static str,
    /// Source of the cycle, with its number there.
    pub source: &'static str,
    /// Kind of the probed feature. By it a control decides whether it supports the cycle.
    pub probes: FeatureKind,
    /// Whether it has its own feeds and search length, and does not use those of the job.
    pub own_feeds: bool,
    /// Type number in the source's parameter table (code −1), if it has one.
    pub number: Option<i32>,
    /// Largest number of touches.
    pub most_touches: usize,
    pub fields: &'static [Field],
    /// Forms inside its form.
    pub sections: &'static [SubForm],
    /// Control and form of its default job.
    pub default_control: (&'static str, &'static str),
    /// Steps of its documented list, in our words; index 0 is step 1.
    pub steps: &'static [&'static str],
    /// Our interpretations of the source, for the manual.
    #[cfg_attr(
        not(test),
        allow(dead_code, reason = "the documents are generated from it")
    )]
    pub interpretations: &'static [&'static str],
    /// Finds the position of the feature from picked touches and the loose form; `None` if its touches cannot be picked.
    pub place: Option<PlaceBy>,
    pub read: fn(&'static CycleDef, &mut Section<'_, '_>) -> Box<dyn Cycle>,
}

impl CycleDef {
    /// Its page of the manual.
    pub fn doc(&self) -> String {
        format!("docs/cycles/{}.md", self.key)
    }
}

/// Reads a loose form and returns the position of the feature by picked touches, and the touches that its dimensions give there; `None` if the picks do not
/// give a feature.
pub type PlaceBy = fn(&mut Section<'_, '_>, &[Pick], Plane) -> Option<(Placement, Vec<Pick>)>;

/// A cycle with checked dimensions. Lengths in mm, angles in degrees as in the form.
pub trait Cycle {
    /// Reports dimensions that contradict each other. Paths start with `cycle.`.
    fn rules(&self, setup: &ProbeSettings, checker: &mut Checker);

    /// Plans the whole path. Every cycle without errors has one.
    fn plan(&self, setup: &ProbeSettings) -> Path;

    /// The results that the control computes, as in [`Cycle::plan`].
    fn formula(&self, setup: &ProbeSettings) -> Formula;

    /// The source's parameter table. Nothing is computed from it. `touches` are those of the path.
    fn parameters(&self, setup: &ProbeSettings, touches: &[Touch]) -> Vec<Parameter>;

    /// Reports faults that only the whole path shows, such as its ends against the feature. Paths start with `cycle.`.
    fn review_path(&self, _setup: &ProbeSettings, _path: &Path, _checker: &mut Checker) {}

    /// Fields whose values the control has (path, label). The moves are planned with the form's values instead.
    fn predefined_fields(&self) -> Vec<(&'static str, &'static str)> {
        Vec::new()
    }

    /// The surfaces of the feature, as in [`Cycle::plan`].
    fn surfaces(&self, setup: &ProbeSettings) -> Vec<Surface>;

    /// The cycle with `delta` (mm or degrees) added to the size named `key`; `None` if there is no such size, or if nothing of the feature would remain.
    fn resized(&self, setup: &ProbeSettings, key: &str, delta: f64) -> Option<Box<dyn Cycle>>;

    /// Adds rows beyond arithmetic: verdicts, and rows for single touches. `triggers` has one entry for each touch.
    fn add_verdicts(
        &self,
        _setup: &ProbeSettings,
        _path: &Path,
        _triggers: &[Option<Vec3>],
        _rows: &mut Vec<ResultRow>,
    ) {
    }

    /// Reason why the control's value of this result is wrong on a rotated part, if it is.
    fn turned_error(&self, code: &str) -> Option<&'static str>;
}

/// Replaces a supertrait, which would keep every field of every form printable: 4 kB of unused code in WebAssembly.
impl std::fmt::Debug for dyn Cycle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Cycle")
    }
}

/// The cycle with this `type`.
pub fn find(key: &str) -> Option<&'static CycleDef> {
    CYCLES.iter().copied().find(|c| c.key == key)
}
