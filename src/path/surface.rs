//! The walls of a feature.

use crate::geom::Vec3;

/// A flat wall of the feature. The material lies behind it, against `normal`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// A point on it: at the top side where it has one, else at the level of the touches.
    pub point: Vec3,
    /// Outward normal.
    pub normal: Vec3,
    /// The direction that `extent` is counted in.
    pub along: Vec3,
    /// How far it is drawn along `along` from `point`: from, to. Contacts treat it as going on.
    pub extent: (f64, f64),
    /// How deep below `point` it is drawn.
    pub drawn_depth: f64,
    /// Whether it ends at `point`'s level with a flat top side behind it; else it has no upper end.
    pub has_top: bool,
    /// Which body it bounds. Walls of one body bound it together: the material is what lies behind all of them.
    pub body: usize,
}

/// A round wall about the tool axis: a hole or a stud.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round {
    /// The middle of its top.
    pub center: Vec3,
    /// Its radius, mm.
    pub radius: f64,
    /// Whether the material lies outside (a hole) or inside (a stud).
    pub hole: bool,
    /// How deep below the top it is drawn.
    pub drawn_depth: f64,
    /// How far from the axis of a hole the material around it reaches, mm: infinity where it is in a plate. None: nothing is known
    /// beyond its rim.
    pub plate: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    Flat(Wall),
    Round(Round),
    /// Somewhere: its place is not known. It is not drawn, and no contact with it is found.
    Unknown,
}
