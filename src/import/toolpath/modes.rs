//! Modes that stay active from block to block.

use crate::control::iso::script::Motion;
use crate::geom::Plane;

/// Meaning of axis words, until a motion.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Given {
    /// Target of a move.
    Place,
    /// Position of a cycle, from G81 on; G80 ends it, too.
    Cycle,
    /// Control points of a spline; its end ends them, too.
    Control,
}

/// Unknown modes: two branches of the program left them different.
#[derive(Clone, Copy, Default, PartialEq)]
pub(super) struct Unsure {
    /// Motion, until a block names one.
    pub motion: bool,
    /// Whether axis words are positions, until G90 or G91.
    pub distance: bool,
}

/// Modes that stay active from block to block.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Modes {
    pub unsure: Unsure,
    pub motion: Motion,
    /// That motion is a curve, treated as straight.
    pub curve: bool,
    pub given: Given,
    pub absolute: bool,
    /// Whether the program states it.
    pub stated: bool,
    /// Whether a call since then, outside this text, may have changed it.
    pub maybe_changed: bool,
    pub centers_absolute: bool,
    pub plane: Option<Plane>,
    /// Units of the path in a current unit of the program.
    pub scale: f64,
    /// Feeds are not per minute: G93, G95.
    pub by_other: bool,
    /// X is a diameter: G7.
    pub diameter: bool,
    /// Positions are polar, a distance from a pole and an angle: G16.
    pub polar: bool,
}

impl Default for Modes {
    fn default() -> Self {
        Modes {
            unsure: Unsure::default(),
            motion: Motion::Rapid,
            curve: false,
            given: Given::Place,
            absolute: true,
            stated: false,
            maybe_changed: false,
            centers_absolute: false,
            plane: None,
            scale: 1.0,
            by_other: false,
            diameter: false,
            polar: false,
        }
    }
}
