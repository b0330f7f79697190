//! What a control's own cycles made, as a path.

use super::machine::{Kind, Made};
use crate::geom::Vec3;
use crate::path::{Feed, Move, Path, Purpose, Touch};

/// How nearly directions must agree.
const NEAR: f64 = 1e-6;

/// Moves and touches of what was made. Touches stand in the order of the documented ones, which the formula counts by; or in their own order.
/// `feeds` has of each the program's feed, where it is the program's own move, and the step; `search` is the rate of the first of two touches. None where
/// others than the documented surfaces are touched.
pub fn moves_of(
    path: &Path,
    own_order: bool,
    made: &[Made],
    feeds: &[(Option<Feed>, u8)],
    first: Vec3,
    (radius, search): (f64, Option<f64>),
) -> Option<(Vec<Move>, Vec<Touch>)> {
    let mut touches: Vec<Option<Touch>> = if own_order { Vec::new() } else { vec![None; path.touches.len()] };
    let mut moves = vec![Move { to: first, feed: Feed::Approach, purpose: Purpose::Position, step: 1, arc: None }];
    let mut now = 0;
    for (made, (feed, step)) in made.iter().zip(feeds) {
        let mut push = |to, feed, purpose| moves.push(Move { to, feed, purpose, step: *step, arc: made.arc });
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
                        touches[*k].is_none() && documented.group == touch.group && documented.vector.dot(vector) > 1.0 - NEAR
                    };
                    now = (0..path.touches.len()).find(same)?;
                }
                touches[now] = Some(Touch { sample: now, ..touch });
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
