//! The travel of the machine and its keep-out zones.

use crate::geom::Vec3;
use crate::part::StylusShape;
use crate::path::{MovePurpose, Path, most};

/// The travel of the machine and its keep-out zones, in the work coordinate system, mm.
#[derive(Debug)]
pub struct Space {
    /// Range of the ball centre; `None` if it is unknown.
    pub travel: Option<Zone>,
    pub keep_out: Vec<Zone>,
}

/// A box parallel to the axes.
#[derive(Debug)]
pub struct Zone {
    pub name: String,
    pub min: Vec3,
    pub max: Vec3,
}

/// A straight piece of the path that the ball centre can take.
#[derive(Clone, Copy, Debug)]
pub struct PathPiece {
    from: Vec3,
    to: Vec3,
    /// Largest shift along each axis by a followed result, mm.
    shift: Vec3,
    /// Index of the move.
    index: usize,
    /// Whether it is the search past the nominal contact.
    search: bool,
}

/// A position beyond the travel.
#[derive(Clone, Copy, Debug)]
pub struct TravelViolation {
    pub axis: usize,
    pub place: f64,
    pub limit: f64,
    /// Index of the move, and whether only its search reaches the position.
    pub index: usize,
    pub search: bool,
}

/// Part of the probe that enters a zone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProbePart {
    Ball,
    Shank,
    Body,
}

/// Smaller overlaps with a zone are not reported, mm: rounding.
const SKIN: f64 = 1e-6;

/// Angle of the pieces of an arc, degrees: the middle of a piece of a 100 mm arc is off by 0.004 mm.
const PIECE: f64 = 1.0;

/// All straight pieces of the path, including the searches past the nominal contacts.
pub fn pieces(path: &Path) -> Vec<PathPiece> {
    let mut found = Vec::new();
    let mut at = path.start.or(path.moves.first().map(|step| step.to));
    for (index, step) in path.moves.iter().enumerate() {
        let Some(mut from) = at else { break };
        // The start may be shifted farther than the end.
        let begin = index
            .checked_sub(1)
            .map_or(Vec3::ZERO, |before| most(path.shifts(before)));
        let shift = most(path.shifts(index)).max(begin);
        for to in step.pieces(from, path.frame.w, PIECE) {
            found.push(PathPiece {
                from,
                to,
                shift,
                index,
                search: false,
            });
            from = to;
        }
        if let MovePurpose::Touch(touch) = step.purpose {
            let touch = &path.touches[touch];
            found.push(PathPiece {
                from,
                to: from - touch.vector * touch.search,
                shift,
                index,
                search: true,
            });
        }
        at = Some(step.to);
    }
    found
}

/// The farthest positions beyond the travel, in each direction.
pub fn beyond(pieces: &[PathPiece], travel: &Zone) -> Vec<TravelViolation> {
    let mut found = Vec::new();
    for axis in 0..3 {
        for (side, limit) in [(-1.0, travel.min[axis]), (1.0, travel.max[axis])] {
            let far = |piece: &PathPiece| side * piece.to[axis] + piece.shift[axis];
            let Some(piece) = pieces.iter().max_by(|a, b| far(a).total_cmp(&far(b))) else {
                continue;
            };
            let place = side * far(piece);
            if side * (place - limit) > SKIN {
                found.push(TravelViolation {
                    axis,
                    place,
                    limit,
                    index: piece.index,
                    search: piece.search,
                });
            }
        }
    }
    found
}

/// The first move in which the ball, or the known part of the stylus above it, enters a zone. `up` is the tool axis.
pub fn enters(
    pieces: &[PathPiece],
    zone: &Zone,
    up: Vec3,
    radius: f64,
    shape: &StylusShape,
) -> Option<(usize, ProbePart)> {
    let axis = up.abs();
    let cylinders = [
        shape
            .shank
            .map(|shank| (ProbePart::Shank, shank / 2.0, 0.0, shape.length)),
        shape
            .body
            .zip(shape.length)
            .map(|(body, length)| (ProbePart::Body, body / 2.0, length, None)),
    ];
    let entering = |piece: &PathPiece| {
        // A piece that may be shifted is checked against a zone that is larger by the shift.
        let (min, max) = (zone.min - piece.shift, zone.max + piece.shift);
        if distance(piece.from, piece.to, min, max) < radius - SKIN {
            return Some(ProbePart::Ball);
        }
        let struck = |(part, radius, from, to): &(ProbePart, f64, f64, Option<f64>)| {
            // Where the cylinder and the zone overlap in height, their distance is checked in the plane.
            let (low, high) = (min.dot(axis) - to.unwrap_or(FAR), max.dot(axis) - from);
            let (begin, end) = (piece.from.dot(axis), piece.to.dot(axis));
            let (first, last) = within(begin, end, low + SKIN, high - SKIN)?;
            let at = |fraction: f64| piece.from + (piece.to - piece.from) * fraction;
            let near =
                distance(at(first), at(last), min - axis * FAR, max + axis * FAR) < radius - SKIN;
            near.then_some(*part)
        };
        cylinders.iter().flatten().find_map(struck)
    };
    pieces
        .iter()
        .find_map(|piece| Some((piece.index, entering(piece)?)))
}

/// Farther than any machine travels, mm.
const FAR: f64 = 1e7;

/// First and last fraction of a move from `begin` to `end` that is between two values.
fn within(begin: f64, end: f64, low: f64, high: f64) -> Option<(f64, f64)> {
    if low > high {
        return None;
    }
    let way = end - begin;
    if way.abs() < 1e-12 {
        return (low..=high).contains(&begin).then_some((0.0, 1.0));
    }
    let (a, b) = ((low - begin) / way, (high - begin) / way);
    let (first, last) = (a.min(b).max(0.0), a.max(b).min(1.0));
    (first <= last).then_some((first, last))
}

/// Shortest distance between a straight move and a box, mm. Between the points where the move crosses the planes of the box, the square of the distance is a
/// parabola: each piece is searched for its minimum.
fn distance(from: Vec3, to: Vec3, min: Vec3, max: Vec3) -> f64 {
    let way = to - from;
    let mut cuts = vec![0.0, 1.0];
    for axis in 0..3 {
        if way[axis] != 0.0 {
            cuts.extend(
                [min[axis], max[axis]]
                    .map(|plane| (plane - from[axis]) / way[axis])
                    .into_iter()
                    .filter(|t| (0.0..1.0).contains(t)),
            );
        }
    }
    cuts.sort_by(f64::total_cmp);
    let off = |t: f64| {
        let place = from + way * t;
        place - place.clamp(min, max)
    };
    let least = |(begin, end): (f64, f64)| {
        let middle = (begin + end) / 2.0;
        // Along an axis on which the position is inside the box, it adds no distance.
        let gap = off(middle);
        let moving =
            Vec3::from_array([0, 1, 2].map(|axis| if gap[axis] == 0.0 { 0.0 } else { way[axis] }));
        let bend = moving.length_squared();
        let t = if bend > 0.0 {
            middle - gap.dot(moving) / bend
        } else {
            middle
        };
        off(crate::num::within(t, begin, end)).length()
    };
    let pieces = cuts.windows(2).map(|pair| (pair[0], pair[1]));
    pieces
        .map(least)
        .fold(off(0.0).length().min(off(1.0).length()), f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_from_a_box_is_that_of_the_nearest_of_many_places() {
        let (min, max) = (Vec3::new(-1.0, -2.0, -3.0), Vec3::new(4.0, 5.0, 6.0));
        let mut seed = 1u64;
        let mut next = || {
            seed = seed
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (seed >> 40) as f64 / 16_777_216.0 * 30.0 - 14.0
        };
        let mut outside = 0;
        for _ in 0..300 {
            let (from, to) = (
                Vec3::new(next(), next(), next()),
                Vec3::new(next(), next(), next()),
            );
            let places = (0..=20_000).map(|i| from + (to - from) * (f64::from(i) / 20_000.0));
            let nearest = places
                .map(|p| (p - p.clamp(min, max)).length())
                .fold(f64::INFINITY, f64::min);
            let found = distance(from, to, min, max);
            assert!(
                found <= nearest + 1e-9 && found > nearest - 2e-3,
                "{from} {to}: {found}, not {nearest}"
            );
            outside += usize::from(nearest > 0.1);
        }
        assert!(outside > 100);
    }
}
