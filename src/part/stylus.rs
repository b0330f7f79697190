//! The stylus above its ball: shank and probe body, cylinders along the tool axis, checked against the same bodies as the ball.
//!
//! No surface of a feature overhangs, so the material only gets narrower upwards. A cylinder therefore contacts it first with the disc at its lower end, and
//! its height does not matter: the shank contacts what its lower end contacts, at the height of the ball centre. A shank no thicker than the ball is inside the
//! ball there and has no further contacts.

use crate::geom::Vec3;
use crate::part::PartRun;
use crate::part::contact::{Body, SKIN};
use crate::path::{MovePurpose, Path, Round, Surface};

/// Stylus above its ball: diameters and length in mm, `None` if unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StylusShape {
    /// From the ball centre up to the probe body.
    pub length: Option<f64>,
    /// Diameter of the stylus above the ball.
    pub shank: Option<f64>,
    /// Diameter of the probe body above the stylus.
    pub body: Option<f64>,
}

/// Part above the ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StylusPart {
    /// The stylus itself, from the ball centre up.
    Shank,
    /// The probe body, from the end of the stylus up.
    Body,
}

/// Contact of the stylus above its ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StylusCollision {
    /// Index of the move in the path.
    pub index: usize,
    /// Ball centre at the contact.
    pub center: Vec3,
    pub part: StylusPart,
}

/// The lower end of a cylinder.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    pub(super) part: StylusPart,
    pub(super) radius: f64,
    /// Height above the ball centre.
    pub(super) rise: f64,
}

impl StylusShape {
    /// Parts that can contact a part that a ball of this radius does not, as far as they are known. The body is checked only against a known top side: a wall
    /// with an unknown end would always be in its way.
    pub(super) fn discs(&self, ball: f64, topped: bool) -> Vec<Disc> {
        let shank = self.shank.map(|shank| Disc {
            part: StylusPart::Shank,
            radius: shank / 2.0,
            rise: 0.0,
        });
        let body = self.body.zip(self.length).map(|(body, length)| Disc {
            part: StylusPart::Body,
            radius: body / 2.0,
            rise: length,
        });
        shank
            .filter(|shank| shank.radius > ball + SKIN)
            .into_iter()
            .chain(body.filter(|_| topped))
            .collect()
    }
}

/// First position where the stylus above the ball contacts the part, on the path that the ball (radius in mm) has run.
pub fn stylus_collision(
    path: &Path,
    surfaces: &[Surface],
    shape: &StylusShape,
    ball: f64,
    run: &PartRun,
) -> Option<StylusCollision> {
    let discs = shape.discs(ball, path.top.is_some());
    if discs.is_empty() {
        return None;
    }
    let up = path.frame.w;
    let bodies: Vec<Body> = (0..surfaces.len())
        .filter_map(|first| Body::beginning(surfaces, up, first))
        .collect();
    let rounds: Vec<&Round> = surfaces
        .iter()
        .filter_map(|s| {
            if let Surface::Round(round) = s {
                Some(round)
            } else {
                None
            }
        })
        .collect();
    let first = |disc: &Disc, from: Vec3, to: Vec3| {
        let [from, to] = [from, to].map(|p| p + up * disc.rise);
        let flat = bodies
            .iter()
            .filter_map(|body| meet_flat(body, up, disc.radius, from, to));
        let round = rounds
            .iter()
            .filter_map(|round| meet_round(round, up, disc.radius, from, to));
        flat.chain(round).min_by(f64::total_cmp)
    };
    let mut at = path.start;
    for (index, step) in path.moves.iter().enumerate() {
        if run.collision.is_some_and(|(collides, _)| collides == index) {
            return None;
        }
        let mut from = at.unwrap_or(step.to);
        let ends = match step.purpose {
            MovePurpose::Touch(k) | MovePurpose::Search(k) => {
                vec![
                    run.triggers[k]
                        .unwrap_or(step.to - path.touches[k].vector * path.touches[k].search),
                ]
            }
            MovePurpose::Position | MovePurpose::Retract(_) => step.pieces(from, up, 1.0),
        };
        for to in ends {
            let met = discs
                .iter()
                .filter_map(|disc| Some((first(disc, from, to)?, disc.part)));
            if let Some((fraction, part)) = met.min_by(|a, b| a.0.total_cmp(&b.0)) {
                return Some(StylusCollision {
                    index,
                    center: from + (to - from) * fraction,
                    part,
                });
            }
            from = to;
        }
        at = Some(from);
    }
    None
}

/// Fractions of a move between which it is below a height.
fn below(top: f64, [begin, end]: [f64; 2]) -> Option<[f64; 2]> {
    let limit = top - SKIN;
    let crossing = || (begin - limit) / (begin - end);
    match (begin < limit, end < limit) {
        (true, true) => Some([0.0, 1.0]),
        (true, false) => Some([0.0, crossing()]),
        (false, true) => Some([crossing(), 1.0]),
        (false, false) => None,
    }
}

/// Fraction of the move at which a level disc contacts a body with flat faces. Along slopes a move counts as low as its lower end, where the material is
/// widest.
pub(super) fn meet_flat(body: &Body, up: Vec3, radius: f64, from: Vec3, to: Vec3) -> Option<f64> {
    let heights = [from, to].map(|p| p.dot(up));
    let (prism, top) = body.cut(up, heights[0].min(heights[1]))?;
    let [begin, end] = top.map_or(Some([0.0, 1.0]), |top| below(top, heights))?;
    let [a, b] = [begin, end].map(|t| from + (to - from) * t);
    prism
        .meet(radius, a, b)
        .map(|(t, ..)| begin + (end - begin) * t)
}

/// Fraction of the move at which a level disc contacts a hole or a stud.
fn meet_round(round: &Round, up: Vec3, radius: f64, from: Vec3, to: Vec3) -> Option<f64> {
    let [begin, end] = below(round.center.dot(up), [from, to].map(|p| p.dot(up)))?;
    let flat = |t: f64| {
        let p = from + (to - from) * t - round.center;
        p - up * p.dot(up)
    };
    let (start, way) = (flat(begin), flat(end) - flat(begin));
    let free = round.radius - radius;
    let met = if !round.hole {
        enters(start, way, round.radius + radius)
    } else if start.length() <= free + SKIN {
        leaves(start, way, free)
    } else {
        // There is material around a hole up to the radius of its plate.
        enters(start, way, round.plate.unwrap_or(round.radius) + radius)
    };
    met.map(|t| begin + (end - begin) * t)
}

/// Fraction at which a point comes closer to the axis than `limit`.
fn enters(start: Vec3, way: Vec3, limit: f64) -> Option<f64> {
    let limit = limit - SKIN;
    if start.length() < limit {
        return Some(0.0);
    }
    let (a, b, c) = (
        way.dot(way),
        start.dot(way),
        start.dot(start) - limit * limit,
    );
    let root = b * b - a * c;
    let t = (-b - root.max(0.0).sqrt()) / a;
    (b < 0.0 && root > 0.0 && t <= 1.0).then_some(t)
}

/// Fraction at which a point gets farther from the axis than `limit`.
fn leaves(start: Vec3, way: Vec3, limit: f64) -> Option<f64> {
    if (start + way).length() <= limit + SKIN {
        return None;
    }
    let (a, b, c) = (
        way.dot(way),
        start.dot(way),
        start.dot(start) - limit * limit,
    );
    Some(crate::num::within(
        (-b + (b * b - a * c).max(0.0).sqrt()) / a,
        0.0,
        1.0,
    ))
}
