//! Results from values measured on a real machine.

use serde::Serialize;

use crate::form::{Checker, Finding, Value};
use crate::formula::{CheckKind, Role};
use crate::geom::Vec3;
use crate::job::judge::judge;
use crate::job::plan::request;
use crate::job::planned::{PlannedJob, judge_touches};
use crate::job::rows::{ResultRow, Triple, result_rows, triple};
use crate::job::{Job, JobError, datum, dependencies, relations, set_up};
use crate::part::{self, EndState, MeasurementContext};
use crate::path::Path;
use crate::text::{Text, text};

/// Results from measured values. Lengths in the job's units, angles in degrees.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measurement {
    /// Results as in a plan, from measured values: `truth` is null.
    pub results: Vec<ResultRow>,
    /// Ball centre at each touch, in the work coordinate system; null without a contact. Empty if the text gives results instead of touches.
    pub points: Vec<Option<Triple>>,
    /// On grbl, which cannot write a work offset from a program: the block that the operator types before the next move. Null if nothing has to be typed; a finding gives the reason.
    pub block: Option<String>,
    /// Warnings and notes about the reading of the values, and about missing ones.
    pub findings: Vec<Finding>,
}

/// Results of a planned job. Findings of the `checker` about the job are returned with errors only.
pub fn of(planned: &PlannedJob, value: &Value, checker: Checker) -> Result<Measurement, JobError> {
    let PlannedJob { job, path, .. } = planned;
    let mut own = Checker::in_units(job.scale, job.unit);
    let measured = part::read_measured(&mut own, value, &expected(job, path));
    part::check_measured(&mut own, &measured, &expected(job, path));
    if own.failed() {
        let findings = checker.findings().into_iter().chain(own.findings());
        return Err(JobError {
            findings: findings.collect(),
        });
    }
    let points = match measured.results {
        Some(_) => vec![None; path.touches.len()],
        None => measured.points.clone(),
    };
    let (results, plausible) = evaluated(planned, path, &points, measured.results.as_deref());
    let block = measured
        .stand
        .as_ref()
        .and_then(|stand| block(planned, &points, stand, plausible, &mut own));
    Ok(Measurement {
        results,
        points: measured
            .points
            .iter()
            .map(|point| point.map(|point| triple(point, job.scale)))
            .collect(),
        block,
        findings: own.findings(),
    })
}

/// Results from touches, or those that a control computed, and whether all of them are plausible. `path` has the formula; for a cycle that follows a direction
/// it is rotated by the points.
fn evaluated(
    planned: &PlannedJob,
    path: &Path,
    points: &[Option<Vec3>],
    stated: Option<&[Option<f64>]>,
) -> (Vec<ResultRow>, bool) {
    let PlannedJob { job, members, .. } = planned;
    if members.is_empty() {
        let mut rows = match stated {
            Some(results) => part::stated(path, job.setup.radius, job.scatter(), results),
            None => part::evaluate(path, points, job.scatter()),
        };
        judge_touches(job, path, points, &mut rows);
        let plausible = judge(job, path, &mut rows)
            .iter()
            .all(|question| question.asked != CheckKind::Plausibility);
        return (result_rows(job, path, rows), plausible);
    }
    let (mut results, mut plausible) = (Vec::new(), true);
    for (i, (own, member)) in members.iter().zip(&path.cycles).enumerate() {
        let stated = stated.map(|results| &results[member.results.clone()]);
        let turned = dependencies::turned(planned, i, points);
        let path = turned.as_ref().unwrap_or(&own.path);
        let (rows, good) = evaluated(own, path, &points[member.touches.clone()], stated);
        plausible &= good;
        results.extend(set_up::cycle_rows(i, rows));
    }
    if !path.relations.is_empty() {
        let rows = match stated {
            Some(results) => part::stated(path, job.setup.radius, job.scatter(), results),
            None => part::evaluate(path, points, job.scatter()),
        };
        plausible &= relations::add_rows(planned, rows, &mut results, None);
    }
    results.extend(datum::written_rows(planned, &results));
    (results, plausible)
}

/// Ball centres of a text for the picture: each with its touch, in the job's units. Empty if the text cannot be read, or gives results.
#[cfg(target_arch = "wasm32")]
pub fn points(planned: &PlannedJob, text: &str) -> Vec<(usize, Vec3)> {
    let PlannedJob { job, path, .. } = planned;
    let mut checker = Checker::in_units(job.scale, job.unit);
    let measured = part::read_measured(
        &mut checker,
        &Value::Text(text.to_owned()),
        &expected(job, path),
    );
    if checker.failed() {
        return Vec::new();
    }
    let points = measured.points.into_iter().enumerate();
    points
        .filter_map(|(touch, point)| Some((touch, point? / job.scale)))
        .collect()
}

fn expected<'a>(job: &'a Job, path: &'a Path) -> MeasurementContext<'a> {
    let variable = |(result, stored)| Some(((job.post.own?.name)(stored), result));
    MeasurementContext {
        path,
        radius: job.setup.radius,
        names: [job.name.clone(), (job.post.name)(&job.name)],
        kept: path.kept().into_iter().filter_map(variable).collect(),
    }
}

/// The block to type, if the control's program cannot write a work offset and the log is sufficient; else the reason why the block is missing.
fn block(
    planned: &PlannedJob,
    points: &[Option<Vec3>],
    stand: &EndState,
    plausible: bool,
    checker: &mut Checker,
) -> Option<String> {
    let PlannedJob { job, path, .. } = planned;
    let typed = job.post.manual_offset_block?;
    let datum = path
        .formula
        .datum
        .as_ref()
        .filter(|datum| datum.measured() != [false; 3])?;
    let feeds = path.feeds.unwrap_or(job.feeds);
    let measured = part::datum(path, points);
    let missing = datum
        .measured()
        .iter()
        .zip(&measured)
        .any(|(wanted, value)| *wanted && value.is_none());
    let why = match (&stand.reason, stand.offset) {
        _ if missing => Err(text!("a result that it needs is unknown")),
        _ if !plausible => Err(text!("a result is off by more than its limit")),
        (Some(away), _) => Err(text!(
            "the machine may not be where the program ends ({reason})",
            away.clone()
        )),
        (None, None) => Err(text!(
            "the log does not state the work offset of the program. Write it as the first line: G54 … G59"
        )),
        (None, Some(offset)) => Ok(offset),
    };
    let no_block = |checker: &mut Checker, why: Text| {
        checker.warning(
            "no-block",
            "measured",
            text!(
                "There is no block to type for the work offset: {reason}",
                why
            ),
        );
    };
    let offset = match why {
        Ok(offset) => offset,
        Err(why) => {
            no_block(checker, why);
            return None;
        }
    };
    let block = typed(&request(planned, &feeds, None), measured, offset)?;
    let message = text!(
        "Type {block} after the program has ended and before anything else moves: it sets the displayed position, so that the measured position reads its nominal value",
        block.clone()
    );
    checker.info("block-to-type", "measured", message);
    let turned = path
        .formula
        .results
        .iter()
        .any(|result| result.role == Role::Direction && result.variable.is_some());
    if turned {
        let message = text!(
            "The measured rotation is not written, since {control} has no rotation: the work offset is correct at the measured position only",
            job.post.title
        );
        checker.info("rotation-not-written", "measured", message);
    }
    Some(block)
}
