//! Turns the executed moves of native cycles into a path.

use super::machine::{Alarm, Kind, Machine, Made};
use super::{Meets, Outcome, OwnRequest};
use crate::formula::Role;
use crate::geom::Vec3;
use crate::path::{Feed, Guard, Move, Own, OwnBlock, Path, Purpose, Reach, Stored, Touch};

/// Tolerance for equal directions.
const NEAR: f64 = 1e-6;

/// Whether a direction is parallel to an axis. The sine is compared: a cosine that is off by 1e-6 is an angle of 0.08°.
pub fn is_along(direction: Vec3, axis: usize) -> bool {
    (0..3).all(|other| other == axis || direction[other].abs() < NEAR)
}

/// Path of the executed moves. Its touches are in the order of the documented ones, by which the formula counts, or in their own order. `feeds` has, for each
/// move, the feed if it belongs to the program, and the step; `search` is the rate of the first of two touches. `None` if other surfaces than the documented
/// ones are touched.
pub fn moves_of(
    path: &Path,
    own_order: bool,
    made: &[Made],
    feeds: &[(Option<Feed>, u8)],
    first: Vec3,
    (radius, search): (f64, Option<f64>),
) -> Option<(Vec<Move>, Vec<Touch>)> {
    let mut touches: Vec<Option<Touch>> = if own_order {
        Vec::new()
    } else {
        vec![None; path.touches.len()]
    };
    let mut moves = vec![Move {
        to: first,
        feed: Feed::Approach,
        purpose: Purpose::Position,
        step: 1,
        arc: None,
    }];
    let mut now = 0;
    for (made, (feed, step)) in made.iter().zip(feeds) {
        let mut push = |to, feed, purpose| {
            moves.push(Move {
                to,
                feed,
                purpose,
                step: *step,
                arc: made.arc,
            })
        };
        match made.kind {
            Kind::Watched if search.is_some() && made.rate == search && feed.is_none() => {
                push(made.to, Feed::Search, Purpose::Position)
            }
            Kind::Watched => push(made.to, feed.unwrap_or(Feed::Retract), Purpose::Position),
            Kind::Rapid => push(made.to, Feed::Rapid, Purpose::Position),
            Kind::Back => push(made.to, Feed::Retract, Purpose::Back(now)),
            Kind::Search | Kind::Once => {
                let met = made.met?;
                let vector = (met.center - made.to).normalize_or_zero();
                let touch = Touch {
                    point: met.center - vector * radius,
                    vector,
                    group: met.surface,
                    search: made.to.distance(met.center),
                    sample: 0,
                };
                if own_order {
                    now = touches.len();
                    touches.push(None);
                } else {
                    let same = |k: &usize| {
                        let documented = &path.touches[*k];
                        touches[*k].is_none()
                            && documented.group == touch.group
                            && documented.vector.dot(vector) > 1.0 - NEAR
                    };
                    now = (0..path.touches.len()).find(same)?;
                }
                touches[now] = Some(Touch {
                    sample: now,
                    ..touch
                });
                match made.kind {
                    Kind::Search => push(met.center, Feed::Search, Purpose::Search(now)),
                    _ => push(met.center, Feed::Work, Purpose::Touch(now)),
                }
            }
            Kind::Measure => push(made.met?.center, Feed::Work, Purpose::Touch(now)),
        }
    }
    Some((moves, touches.into_iter().collect::<Option<Vec<Touch>>>()?))
}

/// Whether four directions, degrees, are a quarter turn apart.
pub fn are_quarters(angles: &[f64]) -> bool {
    let turns = angles.iter().map(|angle| (angle - angles[0]) / 90.0);
    let mut quarters: Vec<i64> = turns
        .filter(|turn| (turn - turn.round()).abs() < NEAR)
        .map(|turn| (turn.round() as i64).rem_euclid(4))
        .collect();
    quarters.sort_unstable();
    quarters == [0, 1, 2, 3]
}

/// Start of the first touch of a documented cycle.
pub fn begins(path: &Path) -> Option<Vec3> {
    path.searches().next().and_then(|(_, from, _)| from)
}

/// Position of a documented cycle after its first steps, before it moves elsewhere.
pub fn start(path: &Path) -> Option<Vec3> {
    path.moves
        .iter()
        .take_while(|step| step.step <= 1)
        .last()
        .map(|step| step.to)
}

/// Runs a block of a program; `None` if the block does not move.
pub type Runs = fn(&OwnBlock, Reach, &mut Machine<'_>) -> Option<Result<(), Alarm>>;

/// A program of cycles under construction.
#[derive(Debug)]
pub struct Drafted {
    pub blocks: Vec<OwnBlock>,
    pub stored: Vec<(&'static str, Stored)>,
    /// Where the first move comes to.
    /// What the calls stop for.
    pub guards: Vec<Guard>,
    pub first: Vec3,
    pub reach: Reach,
}

/// Path of a program on the nominal part, its touches in the order of the documented ones. Otherwise the alarm that stops it, or `None` if it touches other
/// surfaces than the documented cycle.
pub fn planned(
    request: &OwnRequest<'_>,
    drafted: Drafted,
    runs: Runs,
    meets: Meets<'_>,
) -> Result<Path, Option<Alarm>> {
    let Drafted {
        blocks,
        stored,
        guards,
        first,
        reach,
    } = drafted;
    let (mut path, radius) = (request.path.clone(), request.setup.radius);
    let mut answer = |from, to, _: Option<Vec3>| meets(from, to);
    let mut machine = Machine::new(first, radius, 0.0, &mut answer);
    let (mut counted, mut feeds) = (Vec::new(), Vec::new());
    for (step, block) in blocks.iter().enumerate() {
        let before = machine.made.len();
        if let Some(Err(alarm)) = runs(block, reach, &mut machine) {
            return Err(Some(alarm));
        }
        let feed = if let OwnBlock::Goes(_, feed) = block {
            *feed
        } else {
            Feed::Rapid
        };
        feeds.resize(
            machine.made.len(),
            (Some(feed), u8::try_from(step + 2).unwrap_or(u8::MAX)),
        );
        counted.push(machine.made.len() - before);
    }
    let made = machine.made;
    (path.moves, path.touches) =
        moves_of(&path, false, &made, &feeds, first, (radius, None)).ok_or(None)?;
    path.start = None;
    path.formula
        .results
        .retain(|result| result.role != Role::Residual);
    path.own = Some(Box::new(Own {
        counts: made.iter().map(|made| made.count).collect(),
        first,
        blocks: blocks.into_iter().zip(counted).collect(),
        stored,
        guards,
        reach,
    }));
    Ok(path)
}

/// Runs a program on another part. `tip` is the height of the ball centre above the programmed heights.
pub fn rerun(own: &Own, (radius, tip): (f64, f64), runs: Runs, meets: Meets<'_>) -> Outcome {
    let mut answer = |from, to, _: Option<Vec3>| meets(from, to);
    let mut machine = Machine::new(own.first, radius, tip, &mut answer);
    let alarm = own
        .blocks
        .iter()
        .find_map(|(block, _)| runs(block, own.reach, &mut machine)?.err());
    (machine.made, alarm)
}
