//! Whether the path stays clear of the stock.

use crate::form::Checker;
use crate::job::planned::Planned;
use crate::job::stylus::purpose;
use crate::part::{self, Above};
use crate::text::text;

/// Reports the first position where the ball or the stylus is in the stock and no feature is open, on the nominal part.
pub fn report(planned: &Planned, checker: &mut Checker) {
    let Planned { job, path, .. } = planned;
    let Some(stock) = &job.stock else { return };
    let Some(hit) = part::hit(path, stock, &job.shape, job.setup.radius) else {
        return;
    };
    let step = &path.moves[hit.index];
    let what = match hit.part {
        None => text!("the ball"),
        Some(Above::Shank) => text!("the shank"),
        Some(Above::Body) => text!("the probe body"),
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
    checker.error(code, "stock", message);
}
