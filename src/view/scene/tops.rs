//! Top sides: isometric, what stands is seen whole, with its top and without its far walls.

use crate::geom::Vec3;
use crate::path::{Surface, Wall};
use crate::view::scene::{Scene, Spot, WallShape, strips};

/// A top side, isometric.
#[derive(Clone, Debug, PartialEq)]
pub struct Top {
    /// The first of the surfaces below it.
    pub of: usize,
    /// Its corners, in order.
    pub corners: Vec<Spot>,
}

/// A wall or a top side.
#[derive(Clone, Copy, Debug)]
pub enum Face<'a> {
    /// A wall.
    Wall(&'a WallShape),
    /// A top side.
    Top(&'a Top),
}

/// Of what is seen whole, and so has a top side, the first surface: of a stud itself, of flat walls the first of a body that has two which face
/// away from each other, and a top side between them.
pub(super) fn topped(surfaces: &[Surface], k: usize, up: Vec3) -> Option<usize> {
    let wall = match &surfaces[k] {
        Surface::Round(round) => return (!round.hole).then_some(k),
        Surface::Flat(wall) => wall,
        Surface::Unknown => return None,
    };
    let upright = |wall: &Wall| wall.normal.dot(up).abs() < 1e-6;
    let walls = || {
        surfaces.iter().enumerate().filter_map(|(k, surface)| match surface {
            Surface::Flat(other) if other.body == wall.body && upright(other) => Some((k, other)),
            _ => None,
        })
    };
    let whole = walls().all(|(_, wall)| wall.has_top)
        && walls().any(|(_, one)| walls().any(|(_, other)| one.normal.dot(other.normal) < -0.999));
    if whole && upright(wall) { walls().map(|(k, _)| k).next() } else { None }
}

/// The top sides of what is seen whole. `spot` is where a place is seen.
pub(super) fn tops(surfaces: &[Surface], up: Vec3, u: Vec3, spot: impl Fn(Vec3) -> Spot) -> Vec<Top> {
    let ends = |wall: &Wall| [wall.extent.0, wall.extent.1].map(|at| wall.point + wall.along * at);
    let whole = |of: usize| {
        let around: Vec<Vec3> = match &surfaces[of] {
            Surface::Round(round) => strips(round, up, u).iter().map(|strip| ends(strip)[0]).collect(),
            _ => {
                let walls = surfaces.iter().enumerate().filter(|(k, _)| topped(surfaces, *k, up) == Some(of));
                let corners =
                    walls.filter_map(|(_, surface)| if let Surface::Flat(wall) = surface { Some(ends(wall)) } else { None });
                in_order(corners.flatten(), up.cross(u), u)
            }
        };
        Top { of, corners: around.into_iter().map(&spot).collect() }
    };
    (0..surfaces.len()).filter(|k| topped(surfaces, *k, up) == Some(*k)).map(whole).collect()
}

/// The corners of a convex polygon, in order about its middle.
fn in_order(corners: impl Iterator<Item = Vec3>, v: Vec3, u: Vec3) -> Vec<Vec3> {
    let corners: Vec<Vec3> = corners.collect();
    let middle = corners.iter().fold(Vec3::ZERO, |sum, corner| sum + *corner) / corners.len() as f64;
    let turn = |p: Vec3| (p - middle).dot(v).atan2((p - middle).dot(u));
    let mut around: Vec<Vec3> = Vec::with_capacity(corners.len());
    for corner in corners {
        around.insert(around.partition_point(|other| turn(*other) < turn(corner)), corner);
    }
    around
}

impl Scene {
    /// What is drawn of walls and top sides, in this order: each top side after the walls below it, and the virtual part above all of them.
    pub fn faces(&self, deviates: bool) -> Vec<Face<'_>> {
        let above = |wall: &WallShape| wall.actual && !self.tops.is_empty();
        let after = |top: &Top| self.walls.iter().rposition(|wall| wall.top == Some(top.of));
        let tops: Vec<(Option<usize>, &Top)> = self.tops.iter().map(|top| (after(top), top)).collect();
        let mut faces = Vec::new();
        for (k, wall) in self.walls.iter().enumerate().filter(|(_, wall)| !above(wall)) {
            if deviates || !wall.actual {
                faces.push(Face::Wall(wall));
            }
            faces.extend(tops.iter().filter(|(after, _)| *after == Some(k)).map(|(_, top)| Face::Top(top)));
        }
        faces.extend(self.walls.iter().filter(|wall| deviates && above(wall)).map(Face::Wall));
        faces
    }
}
