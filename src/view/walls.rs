//! Projected walls.

use crate::geom::{Frame, Vec2, Vec3};
use crate::path::{Round, Wall};

/// One flat wall, or one strip of a round one.
#[derive(Clone, Debug, PartialEq)]
pub struct WallShape {
    /// Corners in order.
    pub corners: [Vec2; 4],
    /// The line, if it is seen edge-on; else `None`.
    pub edge: Option<[Vec2; 2]>,
    /// Whether it belongs to the actual part instead of the nominal one.
    pub actual: bool,
    /// Whether it is one strip of a round wall, whose sides are not edges.
    pub strip: bool,
    /// Whether its air side is visible. Otherwise the material is in front of it, and it is transparent.
    pub faces: bool,
    /// Surface whose top side is above it.
    pub top: Option<usize>,
}

/// A round wall as flat strips.
#[inline(never)]
pub fn strips(round: &Round, frame: &Frame) -> Vec<Wall> {
    const COUNT: usize = 120;
    let (up, u) = (frame.w, frame.u);
    let v = up.cross(u);
    let half = round.radius * (std::f64::consts::PI / COUNT as f64).tan();
    (0..COUNT)
        .map(|i| {
            let (sin, cos) = (i as f64 * std::f64::consts::TAU / COUNT as f64).sin_cos();
            let out = u * cos + v * sin;
            Wall {
                point: round.center + out * round.radius,
                normal: if round.hole { -out } else { out },
                along: up.cross(out),
                extent: (-half, half),
                drawn_depth: round.drawn_depth,
                has_top: true,
                body: 0,
            }
        })
        .collect()
}

/// A wall, or a strip of a round one. `spot` projects a position.
pub fn shape(wall: &Wall, up: Vec3, spot: impl Fn(Vec3) -> Vec2) -> WallShape {
    let (start, end) = (
        wall.point + wall.along * wall.extent.0,
        wall.point + wall.along * wall.extent.1,
    );
    // Along the wall and across it; upwards if it rises at all.
    let across = wall.normal.cross(wall.along).normalize_or(up);
    let down = (if across.dot(up) < 0.0 {
        -across
    } else {
        across
    }) * wall.drawn_depth;
    let raised = if wall.has_top { Vec3::ZERO } else { down };
    let corners = [start + raised, end + raised, end - down, start - down].map(spot);
    let [a, b, c, _] = corners;
    let flat = area(&corners).abs() / 2.0 < 1e-6 * (1.0 + a.distance_squared(c));
    let edge = flat.then(|| {
        if a.distance(b) > b.distance(c) {
            [a, b]
        } else {
            [b, c]
        }
    });
    WallShape {
        corners,
        edge,
        actual: false,
        strip: false,
        faces: true,
        top: None,
    }
}

/// Twice the area, positive if the outline is counter-clockwise.
pub fn area(outline: &[Vec2]) -> f64 {
    (0..outline.len())
        .map(|k| outline[k].perp_dot(outline[(k + 1) % outline.len()]))
        .sum()
}
