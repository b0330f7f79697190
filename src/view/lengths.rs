//! Picture of the tool lengths: arrows from one origin.

use crate::geom::{AXIS_NAMES, Plane, Vec2, Vec3};
use crate::tool_length::{self, Query};
use crate::view::scene::Projection;

/// Kind of an arrow in a tool-length picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrow {
    /// An axis of the requested coordinate system.
    Axis,
    /// An axis of the base system, if the workpiece system is rotated against it.
    Base,
    /// L1, L2 or L3.
    Length,
}

/// Arrows of a tool-length picture, from the origin: kind, name, and tip in an isometric view.
pub fn arrows(query: &Query) -> Vec<(Arrow, String, Vec2)> {
    let spot = |v: Vec3| Projection::Isometric.place(Plane::G17, v);
    let mut all: Vec<(Arrow, String, Vec2)> = (0..3)
        .map(|i| {
            (
                Arrow::Axis,
                AXIS_NAMES[i].to_owned(),
                spot(Vec3::AXES[i] * 1.4),
            )
        })
        .collect();
    let answer = tool_length::lentoax(query);
    if answer.status < 0 {
        return all;
    }
    if query.coord.to_ascii_uppercase().starts_with('W') && !query.frame.is_empty() {
        // BCS = F · WCS, so a base axis seen from the workpiece is a row of F.
        let (frame, _) = tool_length::frame(&query.frame);
        for (axis, name) in AXIS_NAMES.into_iter().enumerate() {
            all.push((Arrow::Base, format!("{name}0"), spot(frame.row(axis) * 1.2)));
        }
    }
    for length in 0..3 {
        let mut tip = Vec3::ZERO;
        for (row, axis) in query.plane.axes().into_iter().enumerate() {
            tip[axis] = answer.matrix[row][length];
        }
        all.push((Arrow::Length, format!("L{}", length + 1), spot(tip)));
    }
    all
}
