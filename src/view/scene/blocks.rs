//! In the isometric view the material around inner features: a hole, a pocket, a groove, an inside corner. It is solid behind the far walls and cut open
//! towards the viewer, so that the touches are visible; the removed part is transparent.

use crate::geom::{Vec2, Vec3};
use crate::path::{Path, Surface, Wall};
use crate::view::scene::top_faces::{body_with_top, is_upright};
use crate::view::walls::strips;

/// Kind of a face of the material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// The top side.
    Top,
    /// A cut.
    Cut,
    /// Of the removed part.
    Away,
}

/// A face of the material.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    pub face: Face,
    /// Corners in order.
    pub corners: Vec<Vec2>,
}

/// Thickness of the drawn material, as a share of the longest wall.
const THICK: f64 = 0.16;
/// Ends closer than this coincide, mm.
const NEAR: f64 = 1e-6;

/// A piece of the top edge of a wall, and the depth of the material behind it.
struct Piece {
    inner: [Vec3; 2],
    outer: [Vec3; 2],
    /// From its top to its lower end.
    down: Vec3,
    /// Whether the wall is visible; otherwise the material is in front of it, and is removed.
    far: bool,
}

/// Material around the walls of a path that hide no whole body. `spot` projects a position, `towards` is the direction to the viewer.
pub(super) fn blocks(path: &Path, towards: Vec3, spot: impl Fn(Vec3) -> Vec2) -> Vec<Block> {
    let pieces = pieces(path, towards);
    let mut faces = Vec::new();
    let mut add = |face, corners: Vec<Vec3>| {
        faces.push(Block {
            face,
            corners: corners.into_iter().map(&spot).collect(),
        })
    };
    // The two walls of a groove belong together, at their drawn depth.
    if let [one, other] = &pieces[..]
        && one
            .inner
            .iter()
            .all(|at| other.inner.iter().all(|end| end.distance(*at) > NEAR))
    {
        add(
            Face::Away,
            one.inner
                .iter()
                .chain(&other.inner)
                .map(|at| *at + one.down)
                .collect(),
        );
    }
    for far in [true, false] {
        for run in runs(pieces.iter().filter(|piece| piece.far == far).collect()) {
            let (Some(first), Some(last)) = (run.first(), run.last()) else {
                continue;
            };
            let ends = |side: fn(&Piece) -> [Vec3; 2]| -> Vec<Vec3> {
                run.iter()
                    .map(|piece| side(piece)[0])
                    .chain([side(last)[1]])
                    .collect()
            };
            let (inner, outer) = (ends(|piece| piece.inner), ends(|piece| piece.outer));
            let around = |one: &[Vec3], other: &[Vec3]| {
                one.iter()
                    .chain(other.iter().rev())
                    .copied()
                    .collect::<Vec<_>>()
            };
            let lowered: Vec<Vec3> = outer.iter().map(|at| *at + first.down).collect();
            for (piece, end) in [(first, 0), (last, 1)] {
                let [at, behind] = [piece.inner[end], piece.outer[end]];
                let along = piece.inner[1 - end] - at;
                let normal = (behind - at).cross(piece.down);
                let out = if normal.dot(along) > 0.0 {
                    -normal
                } else {
                    normal
                };
                if out.dot(towards) > NEAR {
                    let face = if far { Face::Cut } else { Face::Away };
                    add(face, vec![at, behind, behind + piece.down, at + piece.down]);
                }
            }
            if !far {
                add(Face::Away, around(&outer, &lowered));
            }
            add(
                if far { Face::Top } else { Face::Away },
                around(&inner, &outer),
            );
        }
    }
    faces
}

/// Pieces that continue each other, in order.
fn runs(mut pieces: Vec<&Piece>) -> Vec<Vec<&Piece>> {
    let mut runs = Vec::new();
    while !pieces.is_empty() {
        let begins = |k: &usize| {
            !pieces
                .iter()
                .any(|other| other.inner[1].distance(pieces[*k].inner[0]) < NEAR)
        };
        let mut run = vec![pieces.swap_remove((0..pieces.len()).find(begins).unwrap_or(0))];
        while let Some(next) = run.last().and_then(|last| {
            pieces
                .iter()
                .position(|one| one.inner[0].distance(last.inner[1]) < NEAR)
        }) {
            run.push(pieces.swap_remove(next));
        }
        runs.push(run);
    }
    runs
}

fn pieces(path: &Path, towards: Vec3) -> Vec<Piece> {
    let inside = || {
        path.surfaces
            .iter()
            .enumerate()
            .filter(|(k, _)| body_with_top(path, *k).is_none())
            .map(|(_, surface)| surface)
    };
    let up = path.frame.w;
    let flat: Vec<Wall> = inside()
        .filter_map(|surface| {
            if let Surface::Flat(wall) = surface {
                Some(*wall)
            } else {
                None
            }
        })
        .filter(|wall| is_upright(wall, up))
        .collect();
    let long = |wall: &Wall| wall.extent.1 - wall.extent.0;
    let longest = flat.iter().map(long).fold(0.0, f64::max);
    // Two walls with a gap between them: thick enough to make a part of the gap.
    let facing = matches!(&flat[..], [one, other] if one.normal.dot(other.normal) < -0.999);
    let thick = THICK * if facing { 2.0 * longest } else { longest };
    let mut all: Vec<Piece> = flat
        .iter()
        .map(|wall| flat_piece(wall, &flat, thick, up, towards))
        .collect();
    for surface in inside() {
        let Surface::Round(round) = surface else {
            continue;
        };
        let thick = (2.0 * THICK * 2.0 * round.radius)
            .min(round.plate.unwrap_or(f64::INFINITY) - round.radius);
        if thick <= 0.0 {
            continue;
        }
        for strip in strips(round, &path.frame) {
            let inner = top_edge(&strip, up);
            let outer = inner.map(|at| at + (at - round.center) * (thick / round.radius));
            let far = strip.normal.dot(towards) > 0.0;
            all.push(Piece {
                inner,
                outer,
                down: -up * strip.drawn_depth,
                far,
            });
        }
    }
    all
}

/// Ends of the top edge of a wall, so that the air is on one side of every edge.
fn top_edge(wall: &Wall, up: Vec3) -> [Vec3; 2] {
    let raised = if wall.has_top {
        Vec3::ZERO
    } else {
        up * wall.drawn_depth
    };
    let ends = [wall.extent.0, wall.extent.1].map(|at| wall.point + wall.along * at + raised);
    let [from, to] = ends;
    if wall.along.dot(up.cross(wall.normal)) < 0.0 {
        [to, from]
    } else {
        ends
    }
}

fn flat_piece(wall: &Wall, all: &[Wall], thick: f64, up: Vec3, towards: Vec3) -> Piece {
    let inner = top_edge(wall, up);
    // Where two walls meet, the material behind them meets as well.
    let outer = inner.map(|at| {
        let meets = all.iter().find(|other| {
            other.normal.dot(wall.normal) < 0.999
                && top_edge(other, up)
                    .iter()
                    .any(|end| end.distance(at) < NEAR)
        });
        let way = meets.map_or(wall.normal, |other| {
            (wall.normal + other.normal) / (1.0 + wall.normal.dot(other.normal)).max(0.1)
        });
        at - way * thick
    });
    let depth = if wall.has_top {
        wall.drawn_depth
    } else {
        2.0 * wall.drawn_depth
    };
    Piece {
        inner,
        outer,
        down: -up * depth,
        far: wall.normal.dot(towards) > 0.0,
    }
}
