//! The stylus above its ball, seen from the side.

use crate::geom::{Plane, Vec2};
use crate::part::StylusShape;
use crate::view::scene::Projection;

/// Outlines of stylus and probe body about the ball centre, mm, as far as they are known. Empty from the top, where they would hide the ball. The body, which
/// has no end here, is drawn as high as wide.
pub fn outlines(shape: &StylusShape, ball: f64, plane: Plane, view: Projection) -> Vec<[Vec2; 4]> {
    let up = view.place(plane, plane.basis()[2]).y;
    let Some(length) = shape.length.filter(|_| view != Projection::Top) else {
        return Vec::new();
    };
    let outline = |diameter: f64, [from, to]: [f64; 2]| {
        let half = diameter / 2.0;
        [[-half, from], [half, from], [half, to], [-half, to]]
            .map(|[x, height]| Vec2::new(x, height * up))
    };
    let shank = shape.shank.map(|shank| {
        // From its exit out of the ball.
        let out = (ball * ball - shank * shank / 4.0).max(0.0).sqrt();
        outline(shank, [out.min(length), length])
    });
    let body = shape
        .body
        .map(|body| outline(body, [length, length + body]));
    shank.into_iter().chain(body).collect()
}
