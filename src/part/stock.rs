//! The stock: the block that the features are cut into. Ball, shank and probe body may be inside it only where a feature is open.

use crate::geom::{Rigid, Vec3};
use crate::part::contact::Body;
use crate::part::stylus::{StylusPart, StylusShape, meet_flat};
use crate::path::{Feature, MovePurpose, Path, Surface};

/// Depth by which the ball may be in the stock, mm: positions in inch have steps of 0.0001 in.
const TOLERANCE: f64 = 0.005;

/// A block, parallel to the axes of the work coordinate system, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stock {
    /// Corner with the smallest X, Y and Z.
    pub low: Vec3,
    /// Corner with the largest X, Y and Z.
    pub high: Vec3,
}

impl Stock {
    /// `origin` is the lowest corner, `size` is positive.
    pub fn new(origin: Vec3, size: Vec3) -> Self {
        Stock {
            low: origin,
            high: origin + size,
        }
    }

    /// Height of its top along the tool axis, mm.
    pub fn top(&self, up: Vec3) -> f64 {
        self.low.dot(up).max(self.high.dot(up))
    }
}

/// An opening of the stock by a feature: a prism along the tool axis, from its floor up.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    pub sides: Sides,
    /// Lowest point of the ball in this feature, as a height, mm.
    pub floor: f64,
}

/// Boundary of an opening across the tool axis.
#[derive(Clone, Debug, PartialEq)]
pub enum Sides {
    /// A hole.
    Round { center: Vec3, radius: f64 },
    /// Flat walls: a point of each and its normal, which points into the opening. A groove and a corner are open on the sides without a wall.
    Flat(Vec<(Vec3, Vec3)>),
}

/// Position at which the ball, the shank or the probe body hits the stock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the move in the path.
    pub index: usize,
    /// Ball centre at the hit.
    pub center: Vec3,
    /// `None` is the ball.
    pub part: Option<StylusPart>,
}

impl Opening {
    /// Whether a point lies between its walls. A corner has no facing walls: the extent of its floor is unknown.
    fn encloses(&self, point: Vec3, up: Vec3) -> bool {
        match &self.sides {
            Sides::Round { center, radius } => {
                let off = point - *center;
                (off - up * off.dot(up)).length() <= *radius
            }
            Sides::Flat(walls) => {
                let facing = |(_, normal): &(Vec3, Vec3)| normal.dot(walls[0].1) < -0.999;
                walls.iter().any(facing)
                    && walls
                        .iter()
                        .all(|(wall, normal)| (point - *wall).dot(*normal) >= 0.0)
            }
        }
    }
}

/// Run of a path on a displaced part.
#[derive(Clone, Copy, Debug)]
pub struct DisplacedRun<'a> {
    /// Displacement of the part.
    pub rigid: &'a Rigid,
    /// Ball centre at the trigger of each touch, in work coordinates, mm. The run ends at a touch without one.
    pub triggers: &'a [Option<Vec3>],
    /// Number of moves that are run.
    pub moves: usize,
}

/// Openings of the features that are cut into the stock; features that are touched from outside have none. A surface that is touched from above between the
/// walls of a hole, pocket or groove is its floor. `surfaces` are those of the path, or the same ones in the sizes of the actual part.
pub fn openings(path: &Path, surfaces: &[Surface], radius: f64) -> Vec<Opening> {
    let members = path
        .cycles
        .iter()
        .map(|member| (&member.path, &surfaces[member.surfaces.clone()]));
    let single = path.cycles.is_empty().then_some((path, surfaces));
    let mut all: Vec<Opening> = members
        .chain(single)
        .flat_map(|(path, surfaces)| openings_of(path, surfaces, radius))
        .collect();
    let up = path.frame.w;
    let floors = path
        .touches
        .iter()
        .filter(|touch| touch.vector.dot(up) > 0.999);
    for touch in floors {
        for opening in all
            .iter_mut()
            .filter(|opening| opening.encloses(touch.point, up))
        {
            opening.floor = opening.floor.min(touch.point.dot(up));
        }
    }
    all
}

fn openings_of(path: &Path, surfaces: &[Surface], radius: f64) -> Vec<Opening> {
    let up = path.frame.w;
    let lowest = path.moves.iter().map(|step| step.to.dot(up));
    let floor = lowest.fold(f64::INFINITY, f64::min) - radius;
    let inside = match &path.feature {
        Feature::Pairs(pairs) => pairs.internal,
        Feature::Corner(corner) => !corner.outside,
        _ => false,
    };
    let mut walls = Vec::new();
    let mut all = Vec::new();
    for surface in surfaces {
        match surface {
            Surface::Round(round) if round.hole => all.push(Sides::Round {
                center: round.center,
                radius: round.radius,
            }),
            Surface::Flat(wall) if inside && wall.normal.dot(up).abs() < 1e-6 => {
                walls.push((wall.point, wall.normal));
            }
            Surface::Flat(_) | Surface::Round(_) | Surface::Unknown => {}
        }
    }
    if !walls.is_empty() {
        all.push(Sides::Flat(walls));
    }
    all.into_iter()
        .map(|sides| Opening { sides, floor })
        .collect()
}

/// First position on a path where the ball, the shank or the probe body is in the stock outside all openings, on the nominal part or on a displaced one. The
/// depth of an opening on a displaced part is unknown: the path is checked against its walls only.
pub fn hit(
    path: &Path,
    displaced: Option<DisplacedRun<'_>>,
    mut openings: Vec<Opening>,
    stock: &Stock,
    shape: &StylusShape,
    radius: f64,
) -> Option<Hit> {
    let up = path.frame.w;
    if displaced.is_some() {
        for opening in &mut openings {
            opening.floor = f64::NEG_INFINITY;
        }
    }
    let check = Check {
        body: Body::block([stock.low, stock.high], up),
        openings,
        up,
        top: stock.top(up),
    };
    let in_stock = |at: Vec3| displaced.map_or(at, |run| run.rigid.nominal(at));
    let discs = shape.discs(radius, true);
    let mut at = path.start;
    let moves = displaced.map_or(path.moves.len(), |run| run.moves);
    for (index, step) in path.moves.iter().enumerate().take(moves) {
        let mut from = at.unwrap_or(step.to);
        let ends = match step.purpose {
            MovePurpose::Touch(k) | MovePurpose::Search(k) => match displaced {
                Some(run) => vec![run.triggers[k]?],
                None => vec![step.to],
            },
            MovePurpose::Position | MovePurpose::Retract(_) => step.pieces(from, up, 1.0),
        };
        at = ends.last().copied();
        for to in ends {
            let [start, end] = [from, to].map(in_stock);
            let ball = check.ball(radius, start, end).map(|t| (t, None));
            let above = discs.iter().filter_map(|disc| {
                let rise = up * disc.rise;
                let t = check.disc(disc.radius, start + rise, end + rise)?;
                Some((t, Some(disc.part)))
            });
            if let Some((t, part)) = ball
                .into_iter()
                .chain(above)
                .min_by(|a, b| a.0.total_cmp(&b.0))
            {
                return Some(Hit {
                    index,
                    center: from + (to - from) * t,
                    part,
                });
            }
            from = to;
        }
    }
    None
}

struct Check {
    body: Body,
    openings: Vec<Opening>,
    up: Vec3,
    top: f64,
}

impl Check {
    /// Fraction of the move at which the ball hits the stock. A move that is neither level nor upright counts as low as its lower end.
    fn ball(&self, radius: f64, from: Vec3, to: Vec3) -> Option<f64> {
        let radius = (radius - TOLERANCE).max(0.0);
        let meets = |from, to| Some(self.body.meet(radius, from, to)?.0);
        let above = from.dot(self.up).min(to.dot(self.up)) - self.top;
        // Largest radius of the ball below the top.
        let wide = if above > 0.0 {
            (radius * radius - above * above).max(0.0).sqrt()
        } else {
            radius
        };
        self.first(meets, [wide, radius], from, to)
    }

    /// Fraction of the move at which a level disc with a cylinder above it hits the stock.
    fn disc(&self, radius: f64, from: Vec3, to: Vec3) -> Option<f64> {
        let radius = (radius - TOLERANCE).max(0.0);
        let meets = |from, to| meet_flat(&self.body, self.up, radius, from, to);
        self.first(meets, [radius, 0.0], from, to)
    }

    /// Fraction of the move at which a body is in the stock outside all openings. `wide` is its radius, `low` its extent below its centre.
    fn first(
        &self,
        meets: impl Fn(Vec3, Vec3) -> Option<f64>,
        [wide, low]: [f64; 2],
        from: Vec3,
        to: Vec3,
    ) -> Option<f64> {
        let mut at = meets(from, to)?;
        let end = meets(to, from).map_or(at, |back| 1.0 - back);
        let free: Vec<[f64; 2]> = self
            .openings
            .iter()
            .filter_map(|opening| self.free(opening, [wide, low], from, to))
            .collect();
        let step = TOLERANCE / from.distance(to).max(TOLERANCE);
        loop {
            let covers = |[begin, end]: &&[f64; 2]| *begin <= at + step && *end > at;
            let Some([_, next]) = free
                .iter()
                .filter(covers)
                .max_by(|a, b| a[1].total_cmp(&b[1]))
            else {
                return Some(at);
            };
            at = *next;
            if at >= end - step {
                return None;
            }
        }
    }

    /// Fractions of the move between which the body is within an opening.
    fn free(
        &self,
        opening: &Opening,
        [wide, low]: [f64; 2],
        from: Vec3,
        to: Vec3,
    ) -> Option<[f64; 2]> {
        let way = to - from;
        let height = |at: Vec3| at.dot(self.up) - low - opening.floor + TOLERANCE;
        let free = clip([0.0, 1.0], height(from), way.dot(self.up))?;
        match &opening.sides {
            Sides::Flat(walls) => walls.iter().try_fold(free, |free, (point, normal)| {
                let front = (from - *point).dot(*normal) - wide + TOLERANCE;
                clip(free, front, way.dot(*normal))
            }),
            Sides::Round { center, radius } => {
                let flat = |v: Vec3| v - self.up * v.dot(self.up);
                let limit = radius - wide + TOLERANCE;
                let (start, way) = (flat(from - *center), flat(way));
                let (a, b, c) = (
                    way.dot(way),
                    start.dot(way),
                    start.dot(start) - limit * limit,
                );
                if limit < 0.0 || (a < 1e-18 && c > 0.0) {
                    return None;
                }
                if a < 1e-18 {
                    return Some(free);
                }
                let root = (b * b - a * c).max(0.0).sqrt();
                let [enters, leaves] = [(-b - root) / a, (-b + root) / a];
                let free = [free[0].max(enters), free[1].min(leaves)];
                (b * b >= a * c && free[0] < free[1]).then_some(free)
            }
        }
    }
}

/// Part of an interval in which `start + t · slope` is not negative.
fn clip([begin, end]: [f64; 2], start: f64, slope: f64) -> Option<[f64; 2]> {
    let free = if slope.abs() < 1e-12 {
        [begin, if start >= 0.0 { end } else { begin }]
    } else if slope > 0.0 {
        [begin.max(-start / slope), end]
    } else {
        [begin, end.min(-start / slope)]
    };
    (free[0] < free[1]).then_some(free)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block of 100 × 100 × 20 with its top at Z0, and a hole of diameter 20 and a slot of width 10 along X that begins at Z −12.
    fn check() -> Check {
        let stock = Stock::new(
            Vec3::new(-50.0, -50.0, -20.0),
            Vec3::new(100.0, 100.0, 20.0),
        );
        let hole = Opening {
            sides: Sides::Round {
                center: Vec3::ZERO,
                radius: 10.0,
            },
            floor: -15.0,
        };
        let slot = Opening {
            sides: Sides::Flat(vec![
                (Vec3::new(0.0, 25.0, 0.0), Vec3::Y),
                (Vec3::new(0.0, 35.0, 0.0), Vec3::NEG_Y),
            ]),
            floor: -12.0,
        };
        Check {
            body: Body::block([stock.low, stock.high], Vec3::Z),
            openings: vec![hole, slot],
            up: Vec3::Z,
            top: stock.top(Vec3::Z),
        }
    }

    /// Distance that a ball of radius 3 travels before it hits the stock.
    fn far(from: [f64; 3], to: [f64; 3]) -> Option<f64> {
        let (from, to) = (Vec3::from_array(from), Vec3::from_array(to));
        let t = check().ball(3.0, from, to)?;
        Some((t * from.distance(to) * 100.0).round() / 100.0)
    }

    #[test]
    fn a_ball_is_free_above_the_stock_beside_it_and_where_a_feature_is_open() {
        for (from, to) in [
            ([-40.0, 0.0, 3.0], [40.0, 0.0, 3.0]),
            ([-53.0, 0.0, 10.0], [-53.0, 0.0, -30.0]),
            // To the floor of the hole, from wall to wall, up again.
            ([0.0, 0.0, 10.0], [0.0, 0.0, -12.0]),
            ([-7.0, 0.0, -12.0], [7.0, 0.0, -12.0]),
            // Along the slot, from outside.
            ([-80.0, 30.0, -9.0], [80.0, 30.0, -9.0]),
        ] {
            assert_eq!(far(from, to), None, "{from:?}");
        }
    }

    #[test]
    fn a_ball_hits_the_stock_at_its_faces_walls_and_floors() {
        // From 10 mm above the top, and from 10 mm beside the block, the centre travels 7 mm. Every distance is longer by the tolerance.
        assert_eq!(far([20.0, 0.0, 10.0], [20.0, 0.0, -5.0]), Some(7.01));
        assert_eq!(far([-60.0, 0.0, -5.0], [0.0, 0.0, -5.0]), Some(7.01));
        // The hole: its wall at 10, its floor at −15.
        assert_eq!(far([0.0, 0.0, -5.0], [20.0, 0.0, -5.0]), Some(7.01));
        assert_eq!(far([0.0, 0.0, 10.0], [0.0, 0.0, -14.0]), Some(22.01));
        // Over the rim: 1.8 above the top the ball is 2.4 wide (3-4-5).
        assert_eq!(far([0.0, 0.0, 1.8], [20.0, 0.0, 1.8]), Some(7.61));
        // There is material between the hole and the slot.
        assert_eq!(far([0.0, 0.0, -9.0], [0.0, 30.0, -9.0]), Some(7.01));
        // The floor of the slot is at −12: the hole is deeper.
        assert_eq!(far([0.0, 30.0, 10.0], [0.0, 30.0, -12.0]), Some(19.01));
    }

    #[test]
    fn a_disc_hits_the_stock_with_its_lower_end() {
        let far = |radius: f64, from: Vec3, to: Vec3| {
            let t = check().disc(radius, from, to)?;
            Some((t * from.distance(to) * 100.0).round() / 100.0)
        };
        let down = [Vec3::new(0.0, 0.0, 10.0), Vec3::new(0.0, 0.0, -5.0)];
        assert_eq!(far(9.9, down[0], down[1]), None);
        assert_eq!(far(12.0, down[0], down[1]), Some(10.0));
        let across = [Vec3::new(-80.0, 0.0, -1.0), Vec3::new(0.0, 0.0, -1.0)];
        assert_eq!(far(12.0, across[0], across[1]), Some(18.01));
    }
}
