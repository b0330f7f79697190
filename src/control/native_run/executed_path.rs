//! Turns the executed moves of native cycles into a path.

use super::machine::{Alarm, ExecutedMove, Machine, MoveKind};
use super::{ContactQuery, NativeRequest, NativeRun};
use crate::formula::Role;
use crate::geom::Vec3;
use crate::path::{
    CallBlock, CallSequence, Feed, Guard, Move, MovePurpose, Path, ProbeTable, Stored, Touch,
};

/// Tolerance for equal directions.
const NEAR: f64 = 1e-6;

/// Whether a direction is parallel to an axis. The sine is compared: a cosine that is off by 1e-6 is an angle of 0.08°.
pub fn is_along(direction: Vec3, axis: usize) -> bool {
    (0..3).all(|other| other == axis || direction[other].abs() < NEAR)
}

/// Path of the executed moves. Its touches are in the order of the documented ones, by which the formula counts, or in their own order. `feeds` has, for each
/// move, the feed if it belongs to the program, and the step; `search` is the rate of the first of two touches. `None` if other surfaces than the documented
/// ones are touched.
pub fn path_of_moves(
    path: &Path,
    own_order: bool,
    made: &[ExecutedMove],
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
        purpose: MovePurpose::Position,
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
            MoveKind::Watched if search.is_some() && made.rate == search && feed.is_none() => {
                push(made.to, Feed::Search, MovePurpose::Position)
            }
            MoveKind::Watched => push(
                made.to,
                feed.unwrap_or(Feed::Retract),
                MovePurpose::Position,
            ),
            MoveKind::Rapid => push(made.to, Feed::Rapid, MovePurpose::Position),
            MoveKind::Retract => push(made.to, Feed::Retract, MovePurpose::Retract(now)),
            MoveKind::Search | MoveKind::SingleTouch => {
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
                    MoveKind::Search => push(met.center, Feed::Search, MovePurpose::Search(now)),
                    _ => push(met.center, Feed::Work, MovePurpose::Touch(now)),
                }
            }
            MoveKind::Measure => push(made.met?.center, Feed::Work, MovePurpose::Touch(now)),
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
pub type BlockRunner = fn(&CallBlock, ProbeTable, &mut Machine<'_>) -> Option<Result<(), Alarm>>;

/// A program of cycles under construction.
#[derive(Debug)]
pub struct CallDraft {
    pub blocks: Vec<CallBlock>,
    pub stored: Vec<(&'static str, Stored)>,
    /// Where the first move comes to.
    /// What the calls stop for.
    pub guards: Vec<Guard>,
    pub first: Vec3,
    pub reach: ProbeTable,
}

/// Path of a program on the nominal part, its touches in the order of the documented ones. Otherwise the alarm that stops it, or `None` if it touches other
/// surfaces than the documented cycle.
pub fn planned(
    request: &NativeRequest<'_>,
    drafted: CallDraft,
    runs: BlockRunner,
    meets: ContactQuery<'_>,
) -> Result<Path, Option<Alarm>> {
    let CallDraft {
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
        let feed = if let CallBlock::MoveTo(_, feed) = block {
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
        path_of_moves(&path, false, &made, &feeds, first, (radius, None)).ok_or(None)?;
    path.start = None;
    path.formula
        .results
        .retain(|result| result.role != Role::Residual);
    path.calls = Some(Box::new(CallSequence {
        counts: made.iter().map(|made| made.ordinal).collect(),
        first,
        blocks: blocks.into_iter().zip(counted).collect(),
        stored,
        guards,
        reach,
        ..CallSequence::default()
    }));
    Ok(path)
}

/// Runs a program on another part. `tip` is the height of the ball centre above the programmed heights.
pub fn rerun(
    own: &CallSequence,
    (radius, tip): (f64, f64),
    runs: BlockRunner,
    meets: ContactQuery<'_>,
) -> NativeRun {
    let mut answer = |from, to, _: Option<Vec3>| meets(from, to);
    let mut machine = Machine::new(own.first, radius, tip, &mut answer);
    let alarm = own
        .blocks
        .iter()
        .find_map(|(block, _)| runs(block, own.reach, &mut machine)?.err());
    (machine.made, alarm)
}
