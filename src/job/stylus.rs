//! Checks whether shank and probe body clear the part, and reports what is unknown.

use crate::form::Checker;
use crate::job::Job;
use crate::part::{self, PartRun, StylusCollision, StylusPart};
use crate::path::{MovePurpose, Path, Surface};
use crate::text::{Text, text};

/// Reports a contact of the stylus above its ball with the nominal part, or else with the virtual one. `nominal` and `actual` are the runs of the ball on both;
/// the path may be shifted on the latter.
pub fn report_stylus(
    job: &Job,
    path: &Path,
    nominal: &PartRun,
    actual: Option<(&Path, &[Surface], &PartRun)>,
    checker: &mut Checker,
) {
    let struck = |path: &Path, surfaces: &[Surface], run: &PartRun| {
        part::stylus_collision(path, surfaces, &job.shape, job.setup.radius, run)
    };
    if let Some(struck) = struck(path, &path.surfaces, nominal) {
        let field = match struck.part {
            StylusPart::Shank => "stylus.shank",
            StylusPart::Body => "stylus.length",
        };
        return report_struck(job, path, &path.surfaces, struck, field, checker);
    }
    let Some((path, surfaces, run)) = actual else {
        return;
    };
    if let Some(struck) = struck(path, surfaces, run) {
        report_struck(job, path, surfaces, struck, "part", checker);
    }
}

/// Reports the move, the contacting part, and a remedy.
fn report_struck(
    job: &Job,
    path: &Path,
    surfaces: &[Surface],
    struck: StylusCollision,
    field: &str,
    checker: &mut Checker,
) {
    let step = &path.moves[struck.index];
    let [shank, length] =
        [job.shape.shank, job.shape.length].map(|x| checker.length(x.unwrap_or(0.0)));
    let (part, remedy) = match struck.part {
        StylusPart::Shank => (
            text!("the shank"),
            text!(
                "it is thicker ({shank}) than the ball ({ball})",
                shank,
                checker.length(2.0 * job.setup.radius)
            ),
        ),
        StylusPart::Body => (
            text!("the probe body"),
            text!(
                "this stylus reaches at most {length} below the top side with its ball centre, and the path goes {depth} below it",
                length,
                checker.rounded_up(highest(path, surfaces) - lowest(path))
            ),
        ),
    };
    let message = text!(
        "Move {move} (step {step}, {purpose}): {part} hits the part with the ball centre at {place}: {remedy}",
        struck.index + 1,
        step.step,
        purpose(step.purpose),
        part,
        checker.position(struck.center),
        remedy
    );
    checker.error("shank-collision", field, message);
}

/// Purpose of a move, in words.
pub fn purpose(purpose: MovePurpose) -> Text {
    match purpose {
        MovePurpose::Position => text!("positioning"),
        MovePurpose::Retract(k) => text!("back from touch {touch}", k + 1),
        MovePurpose::Touch(k) | MovePurpose::Search(k) => text!("touch {touch}", k + 1),
    }
}

/// Reports missing dimensions that prevent a check: one note, if the path goes deeper than a ball, or its depth is unknown.
pub fn report_unknown(job: &Job, path: &Path, checker: &mut Checker) {
    let shape = &job.shape;
    let known = shape.length.is_some() && shape.shank.is_some() && shape.body.is_some();
    if path.moves.is_empty() || !path.surfaces.iter().any(|surface| is_beside(path, surface)) {
        return;
    }
    let stock = job.stock.map(|stock| stock.top(path.frame.w));
    let message: Text = match (path.top.or(stock), shape.length) {
        (Some(top), _) => {
            let depth = top - lowest(path);
            if known || depth <= 2.0 * job.setup.radius {
                return;
            }
            text!(
                "The ball centre goes {depth} deep. Shank and body are checked against the part only with stylus length, shank diameter and body diameter given",
                checker.length(depth)
            )
        }
        (None, Some(length)) if known => text!(
            "The cycle does not give the height of the part: it must end less than {length} above the lowest ball centre, or the probe body hits it",
            checker.length(length)
        ),
        (None, _) => text!(
            "The cycle does not give the height of the part above the touches: whether the probe body clears it is not checked"
        ),
    };
    checker.info("stylus-not-known", "stylus.length", message);
}

/// Whether a surface is beside the stylus instead of below it.
fn is_beside(path: &Path, surface: &Surface) -> bool {
    match surface {
        Surface::Flat(wall) => wall.normal.dot(path.frame.w) < 0.999,
        Surface::Round(_) => true,
        Surface::Unknown => false,
    }
}

/// Height of the lowest ball centre of a path.
fn lowest(path: &Path) -> f64 {
    path.moves
        .iter()
        .map(|step| step.to.dot(path.frame.w))
        .fold(f64::INFINITY, f64::min)
}

/// Height of the highest top side.
fn highest(path: &Path, surfaces: &[Surface]) -> f64 {
    let tops = surfaces.iter().filter_map(|surface| match surface {
        Surface::Flat(wall) if wall.has_top => Some(wall.point.dot(path.frame.w)),
        Surface::Round(round) => Some(round.center.dot(path.frame.w)),
        Surface::Flat(_) | Surface::Unknown => None,
    });
    tops.fold(f64::NEG_INFINITY, f64::max)
}
