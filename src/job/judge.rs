//! What is said of a result: implausible, good, out of tolerance.

use crate::control::Form;
use crate::form::Checker;
use crate::formula::{self, Asked, ON_LIMIT, Question, Tolerance};
use crate::job::Job;
use crate::num::{decimal, tidy};
use crate::path::Path;
use crate::text::{Text, text};

/// Judges results by their tolerances and limits. Gives the questions of the program that they do not hold: implausible ones first.
pub fn judge(job: &Job, path: &Path, rows: &mut [formula::ResultRow]) -> Vec<Question> {
    by_tolerances(path, rows);
    let mut off = path.formula.questions(&job.limits);
    off.retain(|question| {
        // A cycle may have added rows behind those of the formula.
        let row = rows.get_mut(question.result);
        let Some(row) = row.filter(|row| row.value.is_some_and(|value| !question.holds(value))) else { return false };
        if question.asked == Asked::Plausible {
            row.verdict = Some(text!("implausible"));
        }
        true
    });
    off
}

/// Results that are out of a tolerance on which the program acts, run on the virtual part.
fn report_tolerances(job: &Job, rows: &[formula::ResultRow], off: &[Question], writes: bool, checker: &mut Checker) {
    for question in off.iter().filter(|question| question.asked != Asked::Plausible) {
        let Some(row) = rows.get(question.result) else { continue };
        let shown = |x: f64| {
            if question.angle { format!("{}°", decimal(x, 4)) } else { checker.length(x) }
        };
        let what = text!(
            "{result} is {value}, not {low} to {high}",
            row.meaning.clone(),
            shown(row.value.unwrap_or(f64::NAN)),
            shown(tidy(question.wanted - question.limit)),
            shown(tidy(question.wanted + question.limit))
        );
        let message = match (question.stops(writes), writes) {
            (true, true) => text!("On this part the program stops with an alarm and writes nothing: {what}", what),
            (true, false) => text!("On this part the program stops with an alarm: {what}", what),
            (false, _) => text!("On this part the program marks a result as out of tolerance: {what}", what),
        };
        checker.warning("out-of-tolerance", if job.placement.nominal { "tolerances" } else { "part" }, message);
        if question.stops(writes) {
            return;
        }
    }
}

/// What the program, run on the virtual part, makes of results that are implausible or out of tolerance. `off` is what [`judge`] gave.
pub fn report_judged(job: &Job, rows: &[formula::ResultRow], off: &[Question], writes: bool, checker: &mut Checker) {
    let Some(question) = off.first().filter(|question| question.asked == Asked::Plausible) else {
        return report_tolerances(job, rows, off, writes, checker);
    };
    let Some(row) = rows.get(question.result) else { return };
    let shown = |x: f64| {
        if question.angle { format!("{}°", decimal(x, 3)) } else { checker.length(x) }
    };
    let (value, wanted, limit) = (shown(row.value.unwrap_or(f64::NAN)), shown(question.wanted), shown(question.limit));
    let what = text!("{result} is {value}, more than {limit} from {wanted}", row.meaning.clone(), value, limit, wanted);
    let asks = job.post.computes && job.form == Form::Moves;
    let message = match (asks, writes) {
        (true, true) => text!("On this part the program stops with an alarm and writes nothing: {what}", what),
        (true, false) => text!("On this part the program reports an implausible result: {what}", what),
        (false, _) => text!("On this part a result is implausible, and the program does not ask: {what}", what),
    };
    checker.warning("implausible", if job.placement.nominal { "limits" } else { "part" }, message);
}

/// Judges results by their tolerances, with twice their uncertainty as guard band: what is that near to a limit is not known to be on its side of it.
fn by_tolerances(path: &Path, rows: &mut [formula::ResultRow]) {
    for (row, def) in rows.iter_mut().zip(&path.formula.results) {
        let Some(Tolerance { limits: [low, high], .. }) = def.tolerance else { continue };
        row.limits = Some((low, high));
        row.verdict = row.value.map(|value| verdict(value, [low, high], 2.0 * row.uncertainty.unwrap_or(0.0)));
    }
}

fn verdict(value: f64, [low, high]: [f64; 2], band: f64) -> Text {
    // How far the value is within the nearer limit.
    let within = (value - low).min(high - value) + ON_LIMIT;
    match (within >= 0.0, within.abs() >= band + ON_LIMIT) {
        (true, true) => text!("good"),
        (true, false) => text!("good within ±"),
        (false, false) => text!("out within ±"),
        (false, true) => text!("out"),
    }
}
