//! Checks that the path stays clear of the stock.

use crate::form::Checker;
use crate::job::Job;
use crate::job::dependencies;
use crate::job::planned::PlannedJob;
use crate::job::stylus::purpose;
use crate::part::{self, DisplacedRun, Hit, Stock, StylusPart};
use crate::path::Path;
use crate::text::text;

/// Reports the first position where the ball or the stylus is in the stock and no feature is open: on the nominal part as an error, else on the displaced one
/// as a warning.
pub fn report(planned: &PlannedJob, checker: &mut Checker) {
    let PlannedJob { job, path, .. } = planned;
    let Some(stock) = &job.stock else { return };
    if let Some(hit) = nominal_hit(job, path, stock) {
        return report_hit(path, hit, true, checker);
    }
    if job.placement.nominal {
        return;
    }
    let run = &planned.run;
    let shifted = dependencies::actual(planned);
    let ran = run
        .shifted_path
        .as_deref()
        .or(shifted.as_ref())
        .unwrap_or(path);
    let reached = run
        .stopped_before
        .map_or(path.moves.len(), |(m, _)| path.cycles[m].moves.start);
    let displaced = DisplacedRun {
        rigid: &job.placement.rigid,
        triggers: &run.triggers,
        moves: run
            .collision
            .map_or(reached, |(index, _)| index.min(reached)),
    };
    let radius = job.setup.radius;
    let openings = part::openings(path, &planned.sized_surfaces(), radius);
    if let Some(hit) = part::hit(ran, Some(displaced), openings, stock, &job.shape, radius) {
        report_hit(path, hit, false, checker);
    }
}

/// The first position on the nominal part where the ball or the stylus is in the stock and no feature is open.
pub fn nominal_hit(job: &Job, path: &Path, stock: &Stock) -> Option<Hit> {
    let radius = job.setup.radius;
    let openings = part::openings(path, &path.surfaces, radius);
    part::hit(path, None, openings, stock, &job.shape, radius)
}

fn report_hit(path: &Path, hit: Hit, nominal: bool, checker: &mut Checker) {
    let step = &path.moves[hit.index];
    let what = match hit.part {
        None => text!("the ball"),
        Some(StylusPart::Shank) => text!("the shank"),
        Some(StylusPart::Body) => text!("the probe body"),
    };
    let message = text!(
        "Move {move} ({purpose}): {part} hits the stock with the ball centre at {place}. Inside the stock the ball must be in a hole, pocket, groove or inside corner of the job",
        hit.index + 1,
        purpose(step.purpose),
        what,
        checker.position(hit.center)
    );
    let code = match hit.part {
        None => "collision",
        Some(_) => "shank-collision",
    };
    if nominal {
        return checker.error(code, "stock", message);
    }
    let message = text!(
        "{message}. This happens on the displaced part only",
        message
    );
    checker.warning(code, "part", message);
}
