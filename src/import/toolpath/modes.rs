//! The modes that stay in force from block to block.

use crate::control::iso::script::Motion;
use crate::geom::Plane;

/// What places are, until a motion.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Given {
    /// Where the axes go.
    Place,
    /// Where a cycle runs, from G81 on; G80 ends it, too.
    Cycle,
    /// Control points of a spline; its end ends them, too.
    Control,
}

/// Modes that are not known, for two ways of the program left them in different ways.
#[derive(Clone, Copy, Default, PartialEq)]
pub(super) struct Unsure {
    /// How the axes go, until a block names a motion.
    pub motion: bool,
    /// Whether axis words are positions, until G90 or G91.
    pub distance: bool,
}

/// What stays in force from block to block.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Modes {
    pub unsure: Unsure,
    pub motion: Motion,
    /// That motion is a curve, straight here.
    pub curve: bool,
    pub given: Given,
    pub absolute: bool,
    /// Whether the program says so.
    pub stated: bool,
    /// Whether what was called since, and is not in the text, may have changed it.
    pub maybe_changed: bool,
    pub centers_absolute: bool,
    pub plane: Option<Plane>,
    /// Units of the path in a unit that the program has now.
    pub scale: f64,
    /// Feeds are not by the minute: G93, G95.
    pub by_other: bool,
    /// X is a diameter: G7.
    pub diameter: bool,
    /// Positions are given by a distance from a pole and an angle: G16.
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
