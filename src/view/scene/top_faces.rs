//! Top sides: in the isometric view a stud is drawn whole, with its top and without its far walls.

use crate::geom::{Vec2, Vec3};
use crate::path::{Path, Surface, Wall};
use crate::view::scene::Scene;
use crate::view::walls::{WallShape, strips};

/// A top side, isometric.
#[derive(Clone, Debug, PartialEq)]
pub struct Top {
    /// First of the surfaces below it.
    pub of: usize,
    /// Corners in order.
    pub corners: Vec<Vec2>,
}

#[derive(Clone, Copy, Debug)]
pub enum Face<'a> {
    /// Position of the lines and touches behind this top side, which hides them.
    Behind(usize),
    Wall(&'a WallShape),
    Top(&'a Top),
}

/// First surface of a body that is drawn whole, with a top side: a stud itself, or the first wall of a body with at least two walls and a top side between
/// them.
pub(super) fn body_with_top(path: &Path, k: usize) -> Option<usize> {
    match &path.surfaces[k] {
        Surface::Round(round) => (!round.hole).then_some(k),
        Surface::Flat(wall) => {
            let mut walls = upright(path, wall.body).map(|(k, _)| k);
            walls
                .next()
                .filter(|_| walls.next().is_some() && is_upright(wall, path.frame.w))
        }
        Surface::Unknown => None,
    }
}

pub(super) fn is_upright(wall: &Wall, up: Vec3) -> bool {
    wall.normal.dot(up).abs() < 1e-6
}

/// Upright walls of a body.
fn upright(path: &Path, body: usize) -> impl Iterator<Item = (usize, &Wall)> {
    path.surfaces
        .iter()
        .enumerate()
        .filter_map(move |(k, surface)| match surface {
            Surface::Flat(wall) if wall.body == body && is_upright(wall, path.frame.w) => {
                Some((k, wall))
            }
            _ => None,
        })
}

/// Corners of the top side between the walls of a body, in order: for two walls that meet, the parallelogram that they span.
#[inline(never)]
fn top_of(path: &Path, body: usize) -> Vec<Vec3> {
    let (up, u) = (path.frame.w, path.frame.u);
    let mut corners: Vec<Vec3> = Vec::new();
    for (_, wall) in upright(path, body) {
        // A wall without a top extends as far above its point as below.
        let raised = if wall.has_top {
            Vec3::ZERO
        } else {
            up * wall.drawn_depth
        };
        for at in [wall.extent.0, wall.extent.1] {
            let end = wall.point + wall.along * at + raised;
            match corners.iter().position(|other| other.distance(end) < 1e-6) {
                None => corners.push(end),
                // If only two walls meet, the fourth corner is opposite.
                Some(meet) => corners.rotate_left(meet),
            }
        }
    }
    if let [meet, one, other] = corners[..] {
        corners.push(one + other - meet);
    }
    in_order(corners, up.cross(u), u)
}

/// Top sides of bodies that are drawn whole. `spot` projects a position.
pub(super) fn tops(path: &Path, spot: impl Fn(Vec3) -> Vec2) -> Vec<Top> {
    let whole = |of: usize| {
        let around: Vec<Vec3> = match &path.surfaces[of] {
            Surface::Round(round) => {
                let strips = strips(round, &path.frame);
                strips
                    .iter()
                    .map(|strip| strip.point + strip.along * strip.extent.0)
                    .collect()
            }
            Surface::Flat(wall) => top_of(path, wall.body),
            Surface::Unknown => Vec::new(),
        };
        Top {
            of,
            corners: around.into_iter().map(&spot).collect(),
        }
    };
    (0..path.surfaces.len())
        .filter(|k| body_with_top(path, *k) == Some(*k))
        .map(whole)
        .collect()
}

/// Breaks of a body, from the end of one of its walls to the end of another, as walls of it.
#[inline(never)]
pub(super) fn breaks(path: &Path, of: usize) -> Vec<Wall> {
    let Surface::Flat(first) = &path.surfaces[of] else {
        return Vec::new();
    };
    let (up, u) = (path.frame.w, path.frame.u);
    let corners = top_of(path, first.body);
    let depth = if first.has_top {
        first.drawn_depth
    } else {
        2.0 * first.drawn_depth
    };
    let side = |k: usize| {
        let (from, way) = (corners[k], corners[(k + 1) % corners.len()] - corners[k]);
        let (along, long) = (way.normalize_or(u), way.length());
        let normal = along.cross(up);
        let own = |wall: &Wall| {
            wall.normal.dot(normal) > 0.999 && (wall.point - from).dot(normal).abs() < 1e-6
        };
        let broken = !upright(path, first.body).any(|(_, wall)| own(wall));
        broken.then_some(Wall {
            point: from,
            normal,
            along,
            extent: (0.0, long),
            drawn_depth: depth,
            has_top: true,
            body: first.body,
        })
    };
    (0..corners.len()).filter_map(side).collect()
}

/// Corners of a convex polygon, in order about its middle.
fn in_order(corners: Vec<Vec3>, v: Vec3, u: Vec3) -> Vec<Vec3> {
    let middle =
        corners.iter().fold(Vec3::ZERO, |sum, corner| sum + *corner) / corners.len() as f64;
    let turn = |p: Vec3| (p - middle).dot(v).atan2((p - middle).dot(u));
    let mut around: Vec<Vec3> = Vec::with_capacity(corners.len());
    for corner in corners {
        around.insert(
            around.partition_point(|other| turn(*other) < turn(corner)),
            corner,
        );
    }
    around
}

/// Far sides of bodies that are drawn whole, each as a point, the outward direction, and the first surface of its body.
#[derive(Default)]
pub(super) struct FarSides(Vec<(Vec3, Vec3, usize)>);

impl FarSides {
    #[inline(never)]
    pub(super) fn of(path: &Path, towards: Vec3) -> Self {
        let mut backs = Vec::new();
        for (k, surface) in path.surfaces.iter().enumerate() {
            let Some(of) = body_with_top(path, k) else {
                continue;
            };
            let mut add = |wall: &Wall| {
                if wall.normal.dot(towards) < -1e-6 {
                    backs.push((wall.point, wall.normal, of));
                }
            };
            match surface {
                Surface::Flat(wall) => add(wall),
                Surface::Round(round) => strips(round, &path.frame).iter().for_each(add),
                Surface::Unknown => {}
            }
        }
        FarSides(backs)
    }

    /// Body in front of a line: one wholly beyond a far side hides nothing of it.
    pub(super) fn before(&self, ends: [Vec3; 2]) -> Option<usize> {
        let beyond = |(point, out, _): &&(Vec3, Vec3, usize)| {
            ends.iter().all(|at| (*at - *point).dot(*out) > -1e-6)
        };
        self.0.iter().find(beyond).map(|(_, _, of)| *of)
    }
}

/// Whether two faces are strips of one round wall, to be drawn together.
pub fn together(one: &Face<'_>, other: &Face<'_>) -> bool {
    match (one, other) {
        (Face::Wall(a), Face::Wall(b)) => {
            a.strip && b.strip && (a.actual, a.faces, a.top) == (b.actual, b.faces, b.top)
        }
        (Face::Wall(_) | Face::Top(_) | Face::Behind(_), _) => false,
    }
}

impl Scene {
    /// Walls and top sides in drawing order: each top side after the walls below it, and the virtual part above everything.
    pub fn faces(&self, deviates: bool) -> Vec<Face<'_>> {
        let above = |wall: &WallShape| wall.actual && !self.tops.is_empty();
        let after = |top: &Top| self.walls.iter().rposition(|wall| wall.top == Some(top.of));
        let tops: Vec<(Option<usize>, &Top)> =
            self.tops.iter().map(|top| (after(top), top)).collect();
        let mut faces = Vec::new();
        let mut begun = Vec::new();
        for (k, wall) in self
            .walls
            .iter()
            .enumerate()
            .filter(|(_, wall)| !above(wall))
        {
            if let Some(of) = wall.top.filter(|of| !begun.contains(of)) {
                begun.push(of);
                faces.push(Face::Behind(of));
            }
            if deviates || !wall.actual {
                faces.push(Face::Wall(wall));
            }
            faces.extend(
                tops.iter()
                    .filter(|(after, _)| *after == Some(k))
                    .map(|(_, top)| Face::Top(top)),
            );
        }
        faces.extend(
            self.walls
                .iter()
                .filter(|wall| deviates && above(wall))
                .map(Face::Wall),
        );
        faces
    }
}
