//! Walls of a feature.

use crate::geom::Vec3;

/// A flat wall of the feature. The material is on the side opposite to `normal`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// A point of the wall: at the top side if there is one, else at the level of the touches.
    pub point: Vec3,
    /// Outward normal.
    pub normal: Vec3,
    /// Direction in which `extent` is counted.
    pub along: Vec3,
    /// Drawn range along `along` from `point`: from, to. Contacts treat the wall as unlimited.
    pub extent: (f64, f64),
    /// Drawn depth below `point`.
    pub drawn_depth: f64,
    /// Whether the wall ends at the level of `point` with a flat top side; otherwise it has no upper end.
    pub has_top: bool,
    /// Index of the body that the wall bounds. The material of a body is the intersection of the half-spaces of its walls.
    pub body: usize,
}

/// A round wall about the tool axis: a hole or a stud.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round {
    /// Centre of its top.
    pub center: Vec3,
    /// Its radius, mm.
    pub radius: f64,
    /// Whether it is a hole, with the material outside; otherwise a stud.
    pub hole: bool,
    /// Drawn depth below the top.
    pub drawn_depth: f64,
    /// Radius of the material around a hole, mm; infinite in a plate. `None`: unknown beyond the rim.
    pub plate: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    Flat(Wall),
    Round(Round),
    /// A surface at an unknown position. It is not drawn, and contacts with it are not found.
    Unknown,
}
