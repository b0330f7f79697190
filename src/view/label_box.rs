//! Space in a picture: boxes of names, and everything that they must avoid.

use crate::geom::Vec2;
use crate::num::within;
use crate::view::camera::{AXES_CORNER, AXES_REACH, BAR_CORNER, BAR_REACH, Camera};
use crate::view::scene::{Scene, Stroke};

/// A box for a text, pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LabelBox {
    pub middle: Vec2,
    /// Reading direction, a unit vector.
    pub along: Vec2,
    /// Half its length along, and half its height.
    pub half: Vec2,
}

impl LabelBox {
    /// A position relative to the middle of the plate, along and across it.
    fn own(&self, at: Vec2) -> Vec2 {
        let off = at - self.middle;
        Vec2::new(self.along.dot(off), self.along.perp_dot(off))
    }

    /// Whether it may overlap something that reaches this far from a position. A quick check that excludes most of a picture.
    pub fn is_near(&self, at: Vec2, reach: f64) -> bool {
        (at - self.middle).abs().max_element() <= self.half.x + self.half.y + reach
    }

    /// Distance from its middle beyond which it meets no other plate.
    pub fn reach(&self) -> f64 {
        self.half.x + 2.0 * self.half.y
    }

    /// Whether it overlaps a disc; with radius 0, whether it contains a position.
    pub fn covers(&self, disc: Vec2, radius: f64) -> bool {
        if !self.is_near(disc, radius) {
            return false;
        }
        (self.own(disc).abs() - self.half).max(Vec2::ZERO).length() <= radius
    }

    /// Whether a straight line comes closer to it than this, pixels.
    #[inline(never)]
    pub fn crosses(&self, ends: [Vec2; 2], near: f64) -> bool {
        let half = self.half + near;
        within_box(ends.map(|end| self.own(end)), [-half, half]).is_some()
    }

    /// Whether two plates overlap: compares with the middle line of the other one, as thick as its height.
    pub fn meets(&self, other: &LabelBox) -> bool {
        if !self.is_near(other.middle, other.reach()) {
            return false;
        }
        let far = other.along * (other.half.x - other.half.y).max(0.0);
        self.crosses([other.middle - far, other.middle + far], other.half.y)
    }

    /// Its smallest and largest pixel.
    pub fn bounds(&self) -> [Vec2; 2] {
        let along = self.along.abs();
        let reach = along * self.half.x + Vec2::new(along.y, along.x) * self.half.y;
        [self.middle - reach, self.middle + reach]
    }
}

/// Clips a segment to an axis-aligned box; returns the parameter range, 0 to 1.
pub fn within_box([from, to]: [Vec2; 2], [low, high]: [Vec2; 2]) -> Option<[f64; 2]> {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for i in [0, 1] {
        let way = to[i] - from[i];
        if way.abs() < 1e-9 {
            if from[i] < low[i] || from[i] > high[i] {
                return None;
            }
            continue;
        }
        let ends = [low[i], high[i]].map(|side| (side - from[i]) / way);
        enters = enters.max(ends[0].min(ends[1]));
        leaves = leaves.min(ends[0].max(ends[1]));
    }
    (enters <= leaves).then_some([enters, leaves])
}

/// Cost of a plate that the edge of the picture cuts off.
pub const CUT_OFF: f64 = 600.0;

/// Depth of the material shown behind an edge, pixels.
pub const BAND: f64 = 36.0;

/// Largest number of lines of a program that are considered: a frame must not wait for more.
const MOST: usize = 2000;

/// Everything else in a picture, pixels.
#[derive(Clone, Debug, Default)]
pub struct OccupiedSpace {
    /// The moves without the search past a contact, and the extent of the ball on both sides.
    lines: Vec<([Vec2; 2], f64)>,
    /// Balls and other round items.
    discs: Vec<(Vec2, f64)>,
    /// Outlines of the nominal walls, and the width of the material drawn beside them.
    walls: Vec<[Vec2; 4]>,
    beside: f64,
    /// Work axes and scale bar.
    corners: Vec<LabelBox>,
    /// Placed texts.
    pub plates: Vec<LabelBox>,
    size: Vec2,
}

impl OccupiedSpace {
    /// Moves, balls at their contacts, origin, and in their corners the work axes and the scale bar.
    pub fn of(scene: &Scene, camera: &Camera) -> Self {
        let Vec2 {
            x: width,
            y: height,
        } = camera.size;
        let unit = scene.unit.unwrap_or(1.0);
        let corner = |x: f64, wide: f64, high: f64| {
            let half = Vec2::new(wide, high) / 2.0;
            LabelBox {
                middle: Vec2::new(x + half.x, height - half.y),
                along: Vec2::X,
                half,
            }
        };
        let axes = AXES_CORNER + AXES_REACH;
        let bar = camera.bar(unit) * unit * camera.scale + 2.0 * BAR_CORNER;
        let corners = vec![corner(0.0, axes, axes), corner(width - bar, bar, BAR_REACH)];
        let beside = if scene.material.is_empty() { 1.0 } else { BAND };
        let mut crowd = OccupiedSpace {
            size: camera.size,
            corners,
            beside,
            ..OccupiedSpace::default()
        };
        let radius = scene.radius * camera.scale;
        for line in scene
            .lines
            .iter()
            .take(MOST)
            .filter(|line| line.stroke != Stroke::Overtravel)
        {
            let reach = if line.stroke == Stroke::Position {
                0.0
            } else {
                radius
            };
            crowd
                .lines
                .push(([camera.pixel(line.from), camera.pixel(line.to)], reach));
        }
        crowd.discs.extend(
            scene
                .touches
                .iter()
                .map(|touch| (camera.pixel(touch.ball), radius)),
        );
        crowd.discs.push((camera.pixel(scene.origin), 7.0));
        let walls = scene.walls.iter().filter(|wall| !wall.actual);
        crowd
            .walls
            .extend(walls.map(|wall| wall.corners.map(|corner| camera.pixel(corner))));
        crowd
    }

    /// Whether a position is in the picture.
    pub fn sees(&self, at: &Vec2) -> bool {
        at.cmpge(Vec2::ZERO).all() && at.cmple(self.size).all()
    }

    /// Whether a plate covers nothing but the axes' corner.
    pub fn leaves(&self, plate: &LabelBox) -> bool {
        let edges = |wall: &[Vec2; 4]| {
            (0..4).any(|k| plate.crosses([wall[k], wall[(k + 1) % 4]], self.beside))
        };
        !self.plates.iter().any(|other| plate.meets(other))
            && !self.corners.iter().take(1).any(|axes| plate.meets(axes))
            && !self
                .discs
                .iter()
                .any(|(at, radius)| plate.covers(*at, *radius))
            && !self.lines.iter().any(|(line, _)| plate.crosses(*line, 1.0))
            && !self.walls.iter().any(edges)
    }

    /// Cost of what a plate covers: another plate, or the picture's edge, is worst, a move least.
    pub fn cost(&self, plate: &LabelBox) -> f64 {
        let count = |many: usize, each: f64| many as f64 * each;
        let met = |others: &[LabelBox]| others.iter().filter(|other| plate.meets(other)).count();
        count(
            usize::from(!plate.bounds().iter().all(|at| self.sees(at))),
            CUT_OFF,
        ) + count(met(&self.plates), 1000.0)
            + count(met(&self.corners), 200.0)
            + count(
                self.discs
                    .iter()
                    .filter(|(at, radius)| plate.covers(*at, *radius))
                    .count(),
                30.0,
            )
            + count(
                self.lines
                    .iter()
                    .filter(|(line, _)| plate.crosses(*line, 1.0))
                    .count(),
                8.0,
            )
    }

    /// Extent on one side of a line of the walls at its ends, the walls between its ends, and everything between them.
    pub fn beside(&self, [from, to]: [Vec2; 2], aside: Vec2) -> [f64; 3] {
        let way = to - from;
        let long = way.length().max(1e-9);
        // Along the line, and away from it.
        let own = |at: Vec2| Vec2::new((at - from).dot(way) / long, (at - from).dot(aside));
        let (mut ends, all) = (0.0_f64, std::cell::Cell::new(0.0_f64));
        // The part of a line with this thickness between the ends.
        let between = |a: Vec2, b: Vec2, thick: f64| {
            for side in [-thick, long + thick] {
                let part = if (b.x - a.x).abs() < 1e-9 {
                    0.0
                } else {
                    within((side - a.x) / (b.x - a.x), 0.0, 1.0)
                };
                let at = a.lerp_monotonic(b, part);
                if at.x > -thick - 1e-6 && at.x < long + thick + 1e-6 {
                    all.set(all.get().max(at.y + thick));
                }
            }
        };
        for wall in &self.walls {
            let corners = wall.map(own);
            for k in 0..4 {
                between(corners[k], corners[(k + 1) % 4], 0.0);
                let Vec2 { x: along, y: away } = corners[k];
                if along.abs() < 1.0 || (along - long).abs() < 1.0 {
                    ends = ends.max(away);
                }
            }
        }
        let walls = all.get();
        self.discs
            .iter()
            .for_each(|(at, radius)| between(own(*at), own(*at), *radius));
        for ([from, to], reach) in &self.lines {
            between(own(*from), own(*to), *reach);
        }
        [ends, walls, all.get()]
    }
}
