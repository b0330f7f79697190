//! Checks whether measured points can belong to their touches.

use crate::form::Checker;
use crate::geom::Vec3;
use crate::part::measured::MeasurementContext;
use crate::path::{MovePurpose, Path};
use crate::text::text;

/// Reports points that their touches cannot have reached.
pub fn check(checker: &mut Checker, points: &[Option<Vec3>], expected: &MeasurementContext<'_>) {
    for (k, away) in out_of_reach(points, expected) {
        let message = text!(
            "Point {point} is {away} from the nominal contact of its touch, out of reach (it searches {search} past it): is it from this job, a ball centre, in order?",
            k + 1,
            checker.length(away.length()),
            checker.length(expected.path.touches[k].search)
        );
        checker.error("too-far", format!("measured[{k}]"), message);
    }
}

/// Points that their touches cannot have reached: index of the touch, and distance of the point from its nominal contact, mm.
pub fn out_of_reach<'a>(
    points: &'a [Option<Vec3>],
    expected: &'a MeasurementContext<'_>,
) -> impl Iterator<Item = (usize, Vec3)> + use<'a> {
    let path = expected.path;
    points
        .iter()
        .zip(&path.touches)
        .enumerate()
        .filter_map(move |(k, (point, touch))| {
            let away = (*point)? - touch.contact(expected.radius);
            // On a part that is closer, the touch triggers anywhere between its start and the nominal contact.
            let in_front = away.dot(touch.vector);
            let aside = (away - touch.vector * in_front).length();
            // A cycle that follows a result is shifted by up to its limit.
            let shift = path
                .moves
                .iter()
                .position(|m| m.purpose == MovePurpose::Touch(k))
                .map_or(0.0, |i| path.farthest_shift(i));
            let reach = touch.search + shift + 1e-6;
            let out = aside > reach
                || in_front < -reach
                || in_front > reach.max(way_to(path, k) + shift + 1e-6);
            out.then_some((k, away))
        })
}

/// Distance from the start of a touch to its nominal contact, mm.
fn way_to(path: &Path, touch: usize) -> f64 {
    let Some(i) = path
        .moves
        .iter()
        .position(|m| m.purpose == MovePurpose::Touch(touch))
    else {
        return 0.0;
    };
    let from = if i > 0 {
        Some(path.moves[i - 1].to)
    } else {
        path.start
    };
    from.map_or(0.0, |from| from.distance(path.moves[i].to))
}

/// Largest distance from its nominal contact at which any touch of a path can trigger, mm.
pub fn farthest(path: &Path) -> f64 {
    let shift = (0..path.moves.len())
        .map(|i| path.farthest_shift(i))
        .fold(0.0, f64::max);
    shift
        + (0..path.touches.len())
            .map(|k| way_to(path, k).max(path.touches[k].search))
            .fold(0.0, f64::max)
}
