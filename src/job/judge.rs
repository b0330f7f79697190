//! Verdicts of results: implausible, good, out of tolerance.

use crate::control::ProgramForm;
use crate::form::Checker;
use crate::formula::{self, CheckKind, ON_LIMIT, ResultCheck, Tolerance};
use crate::geom::Vec3;
use crate::job::Job;
use crate::job::planned::PlannedJob;
use crate::num::{decimal, tidy, wrap_degrees};
use crate::path::{Guard, Off, Path};
use crate::text::{Text, text};

/// Judges results by their tolerances and limits. Returns the failed checks of the program, implausible ones first.
pub fn judge(job: &Job, path: &Path, rows: &mut [formula::ResultRow]) -> Vec<ResultCheck> {
    by_tolerances(path, rows);
    let mut off = path.formula.result_checks(&job.limits);
    off.retain(|question| {
        // A cycle may have added rows after those of the formula.
        let row = rows.get_mut(question.result);
        let Some(row) = row.filter(|row| row.value.is_some_and(|value| !question.is_within(value)))
        else {
            return false;
        };
        if question.asked == CheckKind::Plausibility {
            row.verdict = Some(text!("implausible"));
        }
        true
    });
    off
}

/// Reports results on the virtual part that are out of a tolerance with an action.
fn report_tolerances(
    job: &Job,
    rows: &[formula::ResultRow],
    off: &[ResultCheck],
    writes: bool,
    checker: &mut Checker,
) {
    for question in off
        .iter()
        .filter(|question| question.asked != CheckKind::Plausibility)
    {
        let Some(row) = rows.get(question.result) else {
            continue;
        };
        let shown = |x: f64| {
            if question.angle {
                format!("{}°", decimal(x, 4))
            } else {
                checker.length(x)
            }
        };
        let what = text!(
            "{result} is {value}, not {low} to {high}",
            row.meaning.clone(),
            shown(row.value.unwrap_or(f64::NAN)),
            shown(tidy(question.expected - question.limit)),
            shown(tidy(question.expected + question.limit))
        );
        let message = match (question.stops(writes), writes) {
            (true, true) => text!(
                "On this part the program stops with an alarm and writes nothing: {what}",
                what
            ),
            (true, false) => text!("On this part the program stops with an alarm: {what}", what),
            (false, _) => text!(
                "On this part the program marks a result as out of tolerance: {what}",
                what
            ),
        };
        checker.warning(
            "out-of-tolerance",
            if job.placement.nominal {
                "tolerances"
            } else {
                "part"
            },
            message,
        );
        if question.stops(writes) {
            return;
        }
    }
}

/// Alarm of a native cycle on the virtual part, in its order of checks; `None` if it continues.
fn stops_for(
    path: &Path,
    triggers: &[Option<Vec3>],
    rows: &[formula::ResultRow],
    checker: &Checker,
) -> Option<Text> {
    let results = &path.formula.results;
    let of = |code: &str| results.iter().zip(rows).find(|(def, _)| def.code == code);
    let off = |code: &str| of(code).and_then(|(def, row)| Some(row.value? - def.nominal));
    let shown = |x: f64, angle: bool| {
        if angle {
            format!("{}°", decimal(x, 3))
        } else {
            checker.length(tidy(x))
        }
    };
    // Each cycle of a set-up is judged separately.
    let own = path.calls.iter().filter(|_| path.cycles.is_empty());
    own.flat_map(|own| &own.guards).find_map(
        |Guard {
             codes,
             off: compared,
             limit,
         }| match compared {
            Off::Each => codes.iter().find_map(|code| {
                let (def, row) =
                    of(code).filter(|_| off(code).is_some_and(|off| off.abs() >= *limit))?;
                let [value, limit, wanted] = [row.value.unwrap_or(f64::NAN), *limit, def.nominal]
                    .map(|x| shown(x, def.role.is_angle()));
                Some(text!(
                    "{result} is {value}, more than {limit} from {wanted}",
                    row.meaning.clone(),
                    value,
                    limit,
                    wanted
                ))
            }),
            Off::Place => {
                let far = codes
                    .iter()
                    .filter_map(|code| off(code))
                    .fold(0.0, f64::hypot);
                let what = || {
                    text!(
                        "the measured place is {far} off, more than {limit}",
                        shown(far, false),
                        shown(*limit, false)
                    )
                };
                (far >= *limit).then(what)
            }
            Off::BothWalls => {
                let turns = [0, 1].map(|group| wall_turn(path, triggers, group));
                let both = turns
                    .iter()
                    .all(|turn| turn.is_some_and(|turn| turn.abs() >= *limit));
                both.then(|| {
                    text!(
                        "the directions of both walls are more than {limit} off",
                        shown(*limit, true)
                    )
                })
            }
        },
    )
}

/// Rotation of a wall with two touches, degrees.
fn wall_turn(path: &Path, triggers: &[Option<Vec3>], group: usize) -> Option<f64> {
    let of: Vec<usize> = (0..path.touches.len())
        .filter(|k| path.touches[*k].group == group)
        .collect();
    let [first, .., last] = of[..] else {
        return None;
    };
    let direction = |from: Vec3, to: Vec3| (to.y - from.y).atan2(to.x - from.x).to_degrees();
    let measured = direction((*triggers.get(first)?)?, (*triggers.get(last)?)?);
    Some(wrap_degrees(
        measured - direction(path.touches[first].point, path.touches[last].point),
    ))
}

/// Reports the reaction of the program on the virtual part to results that are implausible or out of tolerance. `off` comes from [`judge`].
pub fn report_judged(
    planned: &PlannedJob,
    rows: &[formula::ResultRow],
    off: &[ResultCheck],
    writes: bool,
    checker: &mut Checker,
) {
    let PlannedJob { job, path, run, .. } = planned;
    let field = if job.placement.nominal {
        "limits"
    } else {
        "part"
    };
    // The limits of a native cycle that follows a result count from the followed value.
    let called = run.shifted_path.as_deref().unwrap_or(path);
    if let Some(what) = stops_for(called, &run.triggers, rows, checker) {
        let message = match writes {
            true => text!(
                "On this part the native cycle stops with a message before it writes: {what}",
                what
            ),
            false => text!(
                "On this part the native cycle stops with a message: {what}",
                what
            ),
        };
        return checker.warning("implausible", field, message);
    }
    let Some(question) = off
        .first()
        .filter(|question| question.asked == CheckKind::Plausibility)
    else {
        return report_tolerances(job, rows, off, writes, checker);
    };
    let Some(row) = rows.get(question.result) else {
        return;
    };
    let shown = |x: f64| {
        if question.angle {
            format!("{}°", decimal(x, 3))
        } else {
            checker.length(x)
        }
    };
    let (value, wanted, limit) = (
        shown(row.value.unwrap_or(f64::NAN)),
        shown(question.expected),
        shown(question.limit),
    );
    let what = text!(
        "{result} is {value}, more than {limit} from {wanted}",
        row.meaning.clone(),
        value,
        limit,
        wanted
    );
    let asks = job.post.computes && job.form == ProgramForm::Moves;
    let message = match (asks, writes) {
        (true, true) => text!(
            "On this part the program stops with an alarm and writes nothing: {what}",
            what
        ),
        (true, false) => text!(
            "On this part the program reports an implausible result: {what}",
            what
        ),
        (false, _) => text!(
            "On this part a result is implausible, and the program does not check it: {what}",
            what
        ),
    };
    checker.warning("implausible", field, message);
}

/// Judges results by their tolerances, with a guard band of twice their uncertainty: closer to a limit it is unknown on which side of it a value is.
fn by_tolerances(path: &Path, rows: &mut [formula::ResultRow]) {
    for (row, def) in rows.iter_mut().zip(&path.formula.results) {
        let Some(Tolerance {
            limits: [low, high],
            ..
        }) = def.tolerance
        else {
            continue;
        };
        row.limits = Some((low, high));
        row.verdict = row
            .value
            .map(|value| verdict(value, [low, high], 2.0 * row.uncertainty.unwrap_or(0.0)));
    }
}

fn verdict(value: f64, [low, high]: [f64; 2], band: f64) -> Text {
    // Distance of the value inside the nearer limit.
    let within = (value - low).min(high - value) + ON_LIMIT;
    match (within >= 0.0, within.abs() >= band + ON_LIMIT) {
        (true, true) => text!("good"),
        (true, false) => text!("good within ±"),
        (false, false) => text!("out within ±"),
        (false, true) => text!("out"),
    }
}
