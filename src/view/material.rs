//! Material behind edges, as a section shows it: filled and hatched. Air stays empty.

use crate::geom::{Frame, Vec2, Vec3};
use crate::path::{Surface, Wall};
use crate::view::camera::Camera;
use crate::view::walls::{area, shape, strips};

/// Material behind a wall seen edge-on, or around or within one seen as a circle. On the picture plane, mm.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// Behind a wall seen edge-on.
    Behind {
        edge: Edge,
        /// Ends that meet another line: there the material continues past the end, so that no corner is missing.
        meets: [bool; 2],
        /// Other lines of the same body, each as a point and the direction into the material, which is behind all of them.
        bounds: Vec<(Vec2, Vec2)>,
        /// Depth to which other walls continue behind it: it is filled at least that far.
        least: f64,
    },
    /// A surface that is seen face on, with nothing beside it.
    Face { corners: [Vec2; 4] },
    /// Around a hole, to the radius of its plate.
    Around {
        center: Vec2,
        radius: f64,
        /// From the middle to the end of the plate.
        reach: f64,
    },
    /// A stock, with the outlines of its openings.
    Body {
        outline: Vec<Vec2>,
        open: Vec<Vec<Vec2>>,
    },
    /// A stud.
    Within { center: Vec2, radius: f64 },
}

/// Longer than any part, mm: a body bounded on two opposite sides is filled from one to the other.
const FAR: f64 = 1e6;

/// Number of corners of a drawn circle.
const CORNERS: usize = 120;

/// A wall seen edge-on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    pub ends: [Vec2; 2],
    /// Direction into the material, a unit vector.
    pub into: Vec2,
    /// The body that it bounds, with the kind of surface: only flat surfaces can bound the same body.
    pub body: (usize, usize),
    /// Depth of the material behind it.
    pub reach: f64,
}

/// Material of the surfaces. `spot` projects a position; `circles` tells whether round walls are seen as circles.
pub fn material(
    surfaces: &[Surface],
    frame: &Frame,
    spot: impl Fn(Vec3) -> Vec2,
    circles: bool,
) -> Vec<Material> {
    let shape = |wall: &Wall| shape(wall, frame.w, &spot);
    let mut all = Vec::new();
    let mut edges: Vec<Edge> = Vec::new();
    let mut add = |wall: &Wall, body, reach| {
        if let Some(ends) = shape(wall).edge {
            edges.push(Edge {
                ends,
                into: spot(-wall.normal),
                body,
                reach,
            });
        }
    };
    for (k, surface) in surfaces.iter().enumerate() {
        match surface {
            Surface::Flat(wall) => add(wall, (0, wall.body), f64::INFINITY),
            Surface::Round(round) if circles => {
                let (center, radius) = (spot(round.center), round.radius);
                all.push(if round.hole {
                    Material::Around {
                        center,
                        radius,
                        reach: round.plate.unwrap_or(f64::INFINITY),
                    }
                } else {
                    Material::Within { center, radius }
                });
            }
            // The two sides of a hole bound nothing together; those of a stud do.
            Surface::Round(round) => {
                for (side, wall) in strips(round, frame).iter().enumerate() {
                    let reach = (round.plate.unwrap_or(f64::INFINITY) - round.radius).max(0.0);
                    if round.hole {
                        add(wall, (k + 1, side), reach)
                    } else {
                        add(wall, (k + 1, 0), f64::INFINITY)
                    }
                }
            }
            Surface::Unknown => {}
        }
    }
    let flat = surfaces.iter().filter_map(|surface| {
        if let Surface::Flat(wall) = surface {
            Some(shape(wall).corners)
        } else {
            None
        }
    });
    let corners: Vec<[Vec2; 4]> = flat.collect();
    if edges.is_empty() && all.is_empty() {
        return corners
            .into_iter()
            .map(|corners| Material::Face { corners })
            .collect();
    }
    let behind = edges.iter().enumerate().map(|(k, own)| {
        let others = || {
            edges
                .iter()
                .enumerate()
                .filter(move |(j, _)| *j != k)
                .map(|(_, other)| other)
        };
        // A line in the same direction makes no corner.
        let meets = |end| {
            let ends = |other: &Edge| other.ends.iter().any(|at| at.abs_diff_eq(end, 1e-6));
            others().any(|other| own.into.dot(other.into).abs() < 0.999 && ends(other))
        };
        Material::Behind {
            edge: *own,
            meets: own.ends.map(meets),
            bounds: others()
                .filter(|other| other.body == own.body)
                .map(|other| (other.ends[0], other.into))
                .collect(),
            least: corners
                .iter()
                .flatten()
                .map(|at| depth(*at, own.ends[0], own.into))
                .fold(0.0, f64::max),
        }
    });
    all.extend(behind);
    all
}

impl Material {
    /// Outlines of its filled area, at most `most` pixels deep, in pixels and all with the same sense, so that shared areas are filled once. The air within a
    /// hole has the opposite sense.
    fn outlines(&self, camera: &Camera, most: f64, out: &mut Vec<Vec<Vec2>>) {
        let deep = most / camera.scale;
        match self {
            Material::Around {
                center,
                radius,
                reach,
            } => {
                out.push(circle(*center, (radius + deep).min(*reach).max(*radius)));
                let mut within = circle(*center, *radius);
                within.reverse();
                out.push(within);
            }
            Material::Within { center, radius } => out.push(circle(*center, *radius)),
            Material::Body { outline, .. } => out.push(outline.clone()),
            Material::Face { corners } => out.push(corners.to_vec()),
            Material::Behind {
                edge: Edge {
                    ends, into, reach, ..
                },
                meets,
                bounds,
                least,
            } => {
                let whole = bounds.iter().any(|(_, other)| into.dot(*other) < -0.999);
                let [a, b] = *ends;
                let along = (b - a) / a.distance(b).max(1e-9);
                let at = |from: Vec2, by: f64, depth: f64| from + along * by + *into * depth;
                let [before, past] = meets.map(|meets| if meets { deep } else { 0.0 });
                let deep = if whole {
                    FAR
                } else {
                    deep.max(*least).min(*reach)
                };
                let mut outline = vec![
                    at(a, -before, 0.0),
                    at(b, past, 0.0),
                    at(b, past, deep),
                    at(a, -before, deep),
                ];
                for (point, way) in bounds {
                    outline = within(&outline, *point, *way);
                }
                if area(&outline) < 0.0 {
                    outline.reverse();
                }
                out.push(outline);
            }
        }
    }
}

/// Outlines of all material, in pixels, and those of the air in holes, which are cut out of other material.
pub fn outlines(all: &[Material], camera: &Camera, most: f64) -> [Vec<Vec<Vec2>>; 2] {
    let (mut filled, mut air) = (Vec::new(), Vec::new());
    for material in all {
        material.outlines(camera, most, &mut filled);
        match material {
            Material::Around { center, radius, .. } => air.push(circle(*center, *radius)),
            Material::Body { open, .. } => air.extend_from_slice(open),
            _ => {}
        }
    }
    for at in filled.iter_mut().chain(&mut air).flatten() {
        *at = camera.pixel(*at);
    }
    [filled, air]
}

/// Depth of a position behind a line, given by a point and the direction into the material.
fn depth(at: Vec2, point: Vec2, way: Vec2) -> f64 {
    way.dot(at - point)
}

/// The part of an outline behind a line, given by a point and the direction into the material.
pub(super) fn within(outline: &[Vec2], point: Vec2, way: Vec2) -> Vec<Vec2> {
    let depth = |at: Vec2| depth(at, point, way);
    let mut kept = Vec::with_capacity(outline.len() + 1);
    for (k, from) in outline.iter().enumerate() {
        let to = outline[(k + 1) % outline.len()];
        let (here, there) = (depth(*from), depth(to));
        if here >= 0.0 {
            kept.push(*from);
        }
        if (here >= 0.0) != (there >= 0.0) {
            kept.push(from.lerp_monotonic(to, here / (here - there)));
        }
    }
    kept
}

/// Counter-clockwise.
pub(super) fn circle(center: Vec2, radius: f64) -> Vec<Vec2> {
    let corner = |k: usize| {
        center + Vec2::from_angle(k as f64 * std::f64::consts::TAU / CORNERS as f64) * radius
    };
    (0..CORNERS).map(corner).collect()
}
