//! The virtual part: trigger of each touch on a displaced part, and the consequences for the moves.

mod contact;
mod evaluate;
mod inertia;
mod measured;
mod stock;
mod stylus;

pub use contact::Obstacles;
pub use evaluate::{
    UncertaintySources, add_true_values, datum, evaluate, numbers, stated, write_offset,
};
pub use inertia::Machine;
pub use measured::{EndState, MeasurementContext, check as check_measured, read as read_measured};
pub use stock::{DisplacedRun, Hit, Opening, Sides, Stock, hit, openings};
pub use stylus::{StylusCollision, StylusPart, StylusShape, stylus_collision};

use crate::geom::{Rigid, Vec3};
use crate::path::{
    CycleSegment, LINK_STEP, MovePurpose, Path, ProbeSettings, Round, Surface, Wall,
};

/// A contact this far past the end of a search still counts, mm: both are rounded.
const ROUNDING: f64 = 2e-7;

/// Position of the actual part.
#[derive(Clone, Debug)]
pub struct PartPlacement {
    /// Rotation and shift of the part.
    pub rigid: Rigid,
    /// The rotation in degrees, counter-clockwise seen against the tool axis.
    pub turn: f64,
    /// Whether it is the nominal part at its nominal position.
    pub nominal: bool,
    /// Whether the job states a displacement or a size. A size with a tolerance is at the middle of its tolerance without being stated.
    pub stated: bool,
}

/// Result of running a path on the actual part.
#[derive(Clone, Debug, Default)]
pub struct PartRun {
    /// Ball centre at the trigger of each touch; `None` without a contact within the search.
    pub triggers: Vec<Option<Vec3>>,
    /// Touches that contact another surface first, with its index.
    pub wrong_walls: Vec<(usize, usize)>,
    /// Touches that contact an edge, a corner or a rim: their trigger says little about their wall.
    pub edges: Vec<usize>,
    /// First move with an unexpected contact: index, and ball centre at the contact. The machine stops there, or breaks; later moves are not run.
    pub collision: Option<(usize, Vec3)>,
    /// Cycle before which the program stops because a result exceeds its limit: indices of the cycle and of the result. Later cycles are not reached.
    pub stopped_before: Option<(usize, usize)>,
    /// The path as it ran, if results of earlier cycles shift it.
    pub shifted_path: Option<Box<Path>>,
}

/// Surfaces of the actual part: `surfaces` of the resized feature at their displaced positions.
pub fn displace_surfaces(surfaces: &[Surface], placement: &PartPlacement) -> Vec<Surface> {
    surfaces
        .iter()
        .map(|surface| match surface {
            Surface::Flat(wall) => Surface::Flat(Wall {
                point: placement.rigid.point(wall.point),
                normal: placement.rigid.direction(wall.normal),
                along: placement.rigid.direction(wall.along),
                ..*wall
            }),
            Surface::Unknown => Surface::Unknown,
            Surface::Round(round) => Surface::Round(Round {
                center: placement.rigid.point(round.center),
                ..*round
            }),
        })
        .collect()
}

/// The positioning move that passes closest to the part, and its distance, mm; `None` if no move comes `within` that distance. The path must run clear of the
/// part.
pub fn closest_pass(
    path: &Path,
    surfaces: &[Surface],
    radius: f64,
    within: f64,
) -> Option<(usize, f64)> {
    let obstacles = Obstacles::of(surfaces, path.frame.w);
    let nearer_than = |gap: f64| {
        let mut at = path.start;
        path.moves.iter().position(|step| {
            let from = at.replace(step.to).unwrap_or(step.to);
            let mut stand = from;
            step.purpose == MovePurpose::Position
                && step
                    .pieces(from, path.frame.w, 1.0)
                    .into_iter()
                    .any(|way_point| {
                        let way = (std::mem::replace(&mut stand, way_point), way_point);
                        obstacles
                            .first_contact(radius + gap, way.0, way.1)
                            .is_some()
                    })
        })
    };
    let mut found = nearer_than(within)?;
    let (mut clear, mut near) = (0.0, within);
    // To a thousandth of `within`.
    for _ in 0..10 {
        let middle = (clear + near) / 2.0;
        match nearer_than(middle) {
            Some(index) => (found, near) = (index, middle),
            None => clear = middle,
        }
    }
    Some((found, near))
}

/// Fraction of a straight move at which the ball contacts these surfaces; `None` without a contact. `up` is the tool axis.
pub fn first_contact(
    surfaces: &[Surface],
    up: Vec3,
    radius: f64,
    from: Vec3,
    to: Vec3,
) -> Option<f64> {
    Obstacles::of(surfaces, up)
        .first_contact(radius, from, to)
        .map(|contact| contact.fraction)
}

/// First move of a set-up on which the ball contacts another cycle's feature, and the ball centre there. `meets` is called for each straight move, with the
/// cycle of the move; a link move belongs to none.
fn first_meeting(
    path: &Path,
    mut meets: impl FnMut(Option<usize>, Vec3, Vec3) -> Option<Vec3>,
) -> Option<(usize, Vec3)> {
    let mut at = path.start;
    path.moves.iter().enumerate().find_map(|(index, step)| {
        let from = at.replace(step.to).unwrap_or(step.to);
        let own = path
            .member_of_move(index)
            .filter(|_| step.step != LINK_STEP);
        let mut stand = from;
        let center = step
            .pieces(from, path.frame.w, 1.0)
            .into_iter()
            .find_map(|to| meets(own, std::mem::replace(&mut stand, to), to));
        Some((index, center?))
    })
}

/// First move of a set-up through a contact point of another cycle, and the position. The path is that of the nominal part.
pub fn through_contacts(path: &Path, radius: f64) -> Option<(usize, Vec3)> {
    // A ball that touches the same wall at the same point is at a distance of its radius, apart from rounding.
    let within = (radius - 1e-3).max(radius / 2.0);
    let touched = |member: &CycleSegment| {
        path.touches[member.touches.clone()]
            .iter()
            .map(|touch| touch.point)
    };
    // Bounding box of ball centres near the touches of a cycle: most moves are far from most cycles.
    let boxes: Vec<(Vec3, Vec3)> = path
        .cycles
        .iter()
        .map(|member| {
            let low = touched(member).fold(Vec3::INFINITY, Vec3::min) - Vec3::splat(within);
            (
                low,
                touched(member).fold(Vec3::NEG_INFINITY, Vec3::max) + Vec3::splat(within),
            )
        })
        .collect();
    first_meeting(path, |own, from, to| {
        let way = to - from;
        let nearest = |point: Vec3| {
            let along = (point - from).dot(way) / way.length_squared().max(1e-12);
            from + way * along.clamp(0.0, 1.0)
        };
        let (least, most) = (from.min(to), from.max(to));
        let near = |(low, high): (Vec3, Vec3)| least.cmple(high).all() && most.cmpge(low).all();
        let others = path
            .cycles
            .iter()
            .zip(&boxes)
            .enumerate()
            .filter(|(i, (_, room))| Some(*i) != own && near(**room));
        let mut points = others.flat_map(|(_, (member, _))| touched(member));
        points
            .find(|point| point.distance_squared(nearest(*point)) < within * within)
            .map(nearest)
    })
}

/// First move of a set-up that hits the feature of another cycle, and the position: a stud, or a body with walls all around. The extent of the material around
/// a hole or behind a single wall is unknown.
pub fn crossing(path: &Path, surfaces: &[Surface], radius: f64) -> Option<(usize, Vec3)> {
    let standing: Vec<Vec<Surface>> = path
        .cycles
        .iter()
        .map(|member| standing(&surfaces[member.surfaces.clone()], path))
        .collect();
    let obstacles: Vec<(usize, Obstacles<'_>)> = standing
        .iter()
        .enumerate()
        .filter(|(_, surfaces)| !surfaces.is_empty())
        .map(|(member, surfaces)| (member, Obstacles::of(surfaces, path.frame.w)))
        .collect();
    first_meeting(path, |own, from, to| {
        let mut others = obstacles.iter().filter(|(member, _)| Some(*member) != own);
        others
            .find_map(|(_, obstacles)| obstacles.first_contact(radius, from, to))
            .map(|contact| contact.center)
    })
}

/// Surfaces that bound a body on all sides.
fn standing(surfaces: &[Surface], path: &Path) -> Vec<Surface> {
    let closed = |body: usize| {
        let normals = surfaces.iter().filter_map(|surface| match surface {
            Surface::Flat(wall) if wall.body == body && wall.has_top => Some(wall.normal),
            _ => None,
        });
        let angles: Vec<f64> = normals
            .map(|n| n.dot(path.frame.v).atan2(n.dot(path.frame.u)))
            .collect();
        // For each wall there is another one within half a turn.
        let next = |angle: f64| {
            let turns = angles
                .iter()
                .map(|other| (other - angle).rem_euclid(std::f64::consts::TAU));
            turns
                .filter(|turn| *turn > 1e-6)
                .fold(f64::INFINITY, f64::min)
        };
        !angles.is_empty()
            && angles
                .iter()
                .all(|angle| next(*angle) < std::f64::consts::PI - 1e-6)
    };
    let stands = |surface: &&Surface| match surface {
        Surface::Round(round) => !round.hole,
        Surface::Flat(wall) => closed(wall.body),
        Surface::Unknown => false,
    };
    surfaces.iter().filter(stands).copied().collect()
}

/// Runs the whole path on the actual surfaces. A touch starts at the current position and moves along the inverted target vector until it contacts a surface,
/// or until it is `search` past its nominal contact. The retract starts at the trigger.
pub fn run(path: &Path, surfaces: &[Surface], setup: &ProbeSettings) -> PartRun {
    let up = path.frame.w;
    let obstacles = Obstacles::of(surfaces, up);
    let mut triggers = vec![None; path.touches.len()];
    let (mut strays, mut edges) = (Vec::new(), Vec::new());
    let mut at: Option<Vec3> = path.start;
    for (index, step) in path.moves.iter().enumerate() {
        // Without a start in the job, only the first position itself is checked.
        let from = at.unwrap_or(step.to);
        match step.purpose {
            MovePurpose::Touch(k) | MovePurpose::Search(k) => {
                let along = path.touches[k].vector;
                let end = step.to - along * path.touches[k].search;
                // A contact at the very end of the search counts.
                let contact = obstacles.first_contact(setup.radius, from, end - along * ROUNDING);
                if let Some(contact) = contact.filter(|c| c.surface != path.touches[k].group) {
                    strays.push((k, contact.surface));
                }
                if contact.is_some_and(|c| c.edge) {
                    edges.push(k);
                }
                triggers[k] = contact.map(|c| c.center);
                at = Some(contact.map_or(end, |c| c.center));
            }
            MovePurpose::Position | MovePurpose::Retract(_) => {
                let mut stand = from;
                for way_point in step.pieces(from, up, 1.0) {
                    if let Some(contact) = obstacles.first_contact(setup.radius, stand, way_point) {
                        return PartRun {
                            triggers,
                            wrong_walls: strays,
                            edges,
                            collision: Some((index, contact.center)),
                            ..PartRun::default()
                        };
                    }
                    stand = way_point;
                }
                at = Some(step.to);
            }
        }
    }
    PartRun {
        triggers,
        wrong_walls: strays,
        edges,
        ..PartRun::default()
    }
}
