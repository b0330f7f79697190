//! Makes the plan of a checked job, and converts it to the job's units.

use std::cell::OnceCell;

use crate::control::native_run::CorrectsTools;
use crate::control::release::{Refusal, release};
use crate::control::rules::{NO_LOW_RAPID, WATCHED};
use crate::control::safety::Verdict;
use crate::control::shop;
use crate::control::{Ask, HeaderDetail, ProgramForm, Request, ResultOutput};
use crate::form::{Checker, Finding, Value};
use crate::formula::{self, Role};
use crate::geom::Vec3;
use crate::job::cycles::is_set_up;
use crate::job::defaults::{is_default, overlay};
use crate::job::inertia::report_inertia;
use crate::job::judge::{judge, report_judged};
use crate::job::planned::{PlannedJob, judge_touches};
use crate::job::rows::{
    Move, Plan, ProgramText, ProofRow, ResultRow, SafetyRow, TouchPoint, move_row, result_rows,
    triple,
};
use crate::job::sections::{ASK, EDITION};
use crate::job::stylus::{purpose, report_stylus, report_unknown};
use crate::job::{
    Job, JobError, datum, dependencies, relations, resolved, set_up, stock, tolerances, wear,
};
use crate::num::{decimal, tidy};
use crate::part;
use crate::path::{
    Feature, Feeds, MOST_ASKEW, MovePurpose, Path, RAPID_RATE, SHORTEST_TOUCH, TouchError,
};
use crate::text::{Text, text};

/// Reads a job and plans its path, or those of its cycles. Reports everything; `None` if anything is an error.
pub fn read(checker: &mut Checker, value: &Value) -> Option<PlannedJob> {
    let planned = read_in_its_form(checker, value);
    if checker.has_at("form-unsupported", "control.form") && is_taken_in(value, ProgramForm::Cycle)
    {
        checker.info(
            "other-form",
            "control.form",
            text!("The control supports this job in the form \"cycle\""),
        );
    }
    planned
}

fn read_in_its_form(checker: &mut Checker, value: &Value) -> Option<PlannedJob> {
    let read = if is_set_up(value) {
        set_up::read(checker, value)
    } else {
        Job::read(checker, value).map(PlannedJob::alone)
    };
    let mut planned = read?;
    tolerances::read(checker, value, &mut planned);
    report_unused(&planned.job, value, checker);
    (!checker.failed()).then_some(planned)
}

/// Reports given values that a program for this control, or of this form, does not use.
fn report_unused(job: &Job, value: &Value, checker: &mut Checker) {
    let post = job.post;
    // The program number has a separate finding.
    let of_control = post
        .unused
        .iter()
        .filter(|key| **key != "number")
        .map(|key| {
            let section = if *key == EDITION {
                "machine"
            } else {
                "control"
            };
            (section, *key)
        });
    let of_moves = (job.form == ProgramForm::Moves && !post.unused.contains(&EDITION))
        .then_some(("machine", EDITION));
    let of_cycles = post
        .unused_by_cycles
        .iter()
        .filter(|_| job.form == ProgramForm::Cycle)
        .filter_map(|path| path.split_once('.'));
    for (section, key) in of_control.chain(of_cycles).chain(of_moves) {
        let Some(given) = value.get(section).and_then(|entries| entries.get(key)) else {
            continue;
        };
        let fields = super::section(section).map_or(&[][..], |form| form.fields);
        let Some(field) = fields
            .iter()
            .find(|field| field.key == key)
            .filter(|field| !is_default(field, given))
        else {
            continue;
        };
        let message = if post.unused.contains(&key) {
            text!(
                "Programs for {title} do not use \"{field}\": it has no effect",
                post.title.to_owned(),
                Text::words(field.label)
            )
        } else if job.form == ProgramForm::Moves {
            text!(
                "Programs of moves do not use \"{field}\": it has no effect",
                Text::words(field.label)
            )
        } else {
            text!(
                "Native cycles do not use \"{field}\": it has no effect",
                Text::words(field.label)
            )
        };
        checker.info("field-unused", format!("{section}.{key}"), message);
    }
}

/// Whether the control supports a job in this form.
fn is_taken_in(value: &Value, form: ProgramForm) -> bool {
    let mut value = value.clone();
    let form = Value::Map(vec![(
        "form".to_owned(),
        Value::Text(form.word().to_owned()),
    )]);
    overlay(&mut value, &Value::Map(vec![("control".to_owned(), form)]));
    let planned = read_in_its_form(&mut Checker::default(), &value);
    planned.is_some_and(|planned| {
        planned.native_rejections.is_empty()
            && planned
                .members
                .iter()
                .all(|cycle| cycle.native_rejections.is_empty())
    })
}

/// Checks of the whole path that apply to every cycle.
fn check_path(job: &Job, path: &Path, checker: &mut Checker) {
    // Repetitions of a touch are skipped: only the first touch of a point is used.
    for (k, fault) in path
        .touch_faults(job.setup.radius)
        .into_iter()
        .filter(|(k, _)| k % job.times() == 0)
    {
        let field = picked(job, path, k);
        let n = k + 1;
        let (code, message) = match fault {
            TouchError::Missing => (
                "touch-missing",
                text!(
                    "Touch {touch} must be in the path exactly once, to assign its trigger",
                    n
                ),
            ),
            TouchError::Short(way) => (
                "touch-too-short",
                text!(
                    "Touch {touch} begins {way} before its nominal contact: at least {least} is needed, or the ball begins in contact",
                    n,
                    checker.length(way),
                    checker.length(SHORTEST_TOUCH)
                ),
            ),
            TouchError::Askew(angle) => (
                "touch-askew",
                text!(
                    "Touch {touch} would run {angle}° off its inverted target vector: at most {most}° is allowed",
                    n,
                    decimal(angle, 2),
                    decimal(MOST_ASKEW, 1)
                ),
            ),
        };
        checker.error(code, field, message);
    }
    if !checker.failed() {
        report_close(job, path, checker);
        report_passes(job, path, checker);
    }
    job.cycle.review_path(&job.setup, path, checker);
}

/// Usual displacement of a part, mm.
const NEAR: f64 = 0.5;

/// Reports a touch that begins close to its nominal contact: on a part displaced by that much, the move before it makes contact.
fn report_close(job: &Job, path: &Path, checker: &mut Checker) {
    // A touch scatters by six sigma at most.
    let least = NEAR.max(6.0 * job.repeatability);
    let ways = path
        .searches()
        .filter_map(|(k, from, step)| Some((k, from?.distance(step.to))));
    let Some((k, way)) = ways
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .filter(|(_, way)| *way < least - 1e-9)
    else {
        return;
    };
    let (n, far) = (k + 1, checker.length(way));
    let message = if way < NEAR - 1e-9 {
        text!(
            "Touch {touch} begins only {way} before its nominal contact: on a part displaced by that much, the move before it makes contact",
            n,
            far
        )
    } else {
        text!(
            "Touch {touch} begins only {way} before its nominal contact: that is less than six times the repeatability",
            n,
            far
        )
    };
    checker.warning("touch-close", picked(job, path, k), message);
}

/// Path of the value that gives a touch: its pick, or the cycle.
fn picked(job: &Job, path: &Path, k: usize) -> String {
    if path.picked {
        format!("cycle.touches[{}]", k / job.times())
    } else {
        "cycle".to_owned()
    }
}

/// Reports a positioning move that passes close to the nominal part: on a part displaced by that much, it makes contact.
fn report_passes(job: &Job, path: &Path, checker: &mut Checker) {
    let Some((index, gap)) =
        part::closest_pass(path, &path.surfaces, job.setup.radius, NEAR - 1e-9)
    else {
        return;
    };
    let message = text!(
        "Move {move} passes the part at a distance of only {gap}: on a part displaced by that much, it makes contact",
        index + 1,
        checker.length(gap)
    );
    checker.warning("passes-close", "cycle", message);
}

/// Reports safety rules that the job's own settings break, if no other finding does.
fn report_rules(job: &Job, verdicts: &[Verdict], checker: &mut Checker) {
    let broken = |rule: &str| {
        verdicts
            .iter()
            .any(|verdict| verdict.rule == rule && verdict.holds == Some(false))
    };
    if job.protected && broken(WATCHED) {
        let message = text!(
            "Some positioning moves are too short to be watched: a contact there goes unnoticed"
        );
        checker.warning("positioning-not-watched", "control.protection", message);
    }
    if broken(NO_LOW_RAPID) {
        let message = text!(
            "A rapid moves down or across below the clearance plane without watching the probe"
        );
        checker.warning("low-rapid", "feeds", message);
    }
}

/// Reports a rotation that is measured but not written.
fn report_rotation(job: &Job, path: &Path, checker: &mut Checker) {
    let measured = path
        .formula
        .results
        .iter()
        .any(|result| result.role == Role::Direction && result.variable.is_some());
    let written = path
        .formula
        .datum
        .as_ref()
        .filter(|datum| datum.writes())
        .is_none_or(|datum| datum.rotation.is_some());
    if job.work_offset.is_some() && measured && !written {
        let message = text!(
            "The measured rotation is not written: the work offset is correct at the measured position only"
        );
        checker.info("rotation-not-written", "control.workOffset", message);
    }
}

/// Reports a touch that triggers so close to its start that the program treats the probe as still deflected.
fn report_at_start(job: &Job, path: &Path, run: &part::PartRun, checker: &mut Checker) {
    let near = |k: usize, from: Vec3| {
        let way = (run.triggers[k]? - from).abs();
        (way.x + way.y + way.z <= job.post.nearest_trigger).then_some(way.length())
    };
    let found = run
        .shifted_path
        .as_deref()
        .unwrap_or(path)
        .searches()
        .find_map(|(k, from, _)| Some((k, near(k, from?)?)));
    let Some((k, way)) = found.filter(|_| job.form == ProgramForm::Moves) else {
        return;
    };
    let message = text!(
        "Touch {touch} triggers {way} after its start: the program treats a contact within {least} of the start as a probe that is still deflected, and stops with an alarm",
        k + 1,
        checker.length(way),
        checker.length(job.post.nearest_trigger)
    );
    checker.warning(
        "contact-at-start",
        if job.placement.nominal {
            "cycle"
        } else {
            "part"
        },
        message,
    );
}

/// Reports that the shown path is that of native cycles, and that an offset is written in parts.
fn report_own(path: &Path, checker: &mut Checker) {
    let Some(own) = path.calls.as_ref().filter(|_| !path.moves.is_empty()) else {
        return;
    };
    let calls = own
        .blocks
        .iter()
        .filter(|(block, _)| block.measures())
        .count();
    let writes = own
        .blocks
        .iter()
        .filter(|(block, _)| block.writes())
        .count();
    let twice = path
        .moves
        .iter()
        .any(|step| matches!(step.purpose, MovePurpose::Search(_)));
    let message = if twice {
        text!(
            "The moves shown are those of the native cycles (measuring calls: {calls}): they watch positioning, touch twice, and choose the order and their feeds",
            calls
        )
    } else {
        text!(
            "The moves shown are those of the native cycles (measuring calls: {calls}): they choose the order and their feeds",
            calls
        )
    };
    checker.info("own-path", "control.form", message);
    if writes > 1 {
        let message = text!(
            "Each call writes its axes of the work offset right after measuring: an alarm in a later call leaves the offset partly updated"
        );
        checker.warning("offset-in-parts", "control.workOffset", message);
    }
}

/// Reports a cycle that consists of table rows: its program does not carry out their requests.
fn report_still(path: &Path, checker: &mut Checker) {
    if matches!(path.feature, Feature::Unmoving) && path.calls.is_none() {
        let message = text!(
            "This program switches and moves nothing: it states its modes and ends. The settings of the cycle are only in the parameter table, for a postprocessor"
        );
        checker.warning("nothing-switched", "cycle", message);
    }
}

/// Reports fields whose values the control has.
fn report_predefined(job: &Job, checker: &mut Checker) {
    for (field, label) in job.cycle.predefined_fields() {
        let what = text!(
            "The {label} is PREDEF: its value is in the control's GLOBAL DEF and unknown here",
            label
        );
        if job.form == ProgramForm::Moves {
            let message = text!(
                "{what}. A program of moves needs the value: clear the flag and give it",
                what
            );
            checker.error("not-known", field, message);
        } else {
            let message = text!(
                "{what}. Moves, triggers and collisions are shown with the form's number in its place",
                what
            );
            checker.warning("predefined", field, message);
        }
    }
}

/// Results that the control will store on the virtual part. A run with a collision ends before the results: nothing is stored. `writes`: whether an implausible
/// result keeps the program from writing; `None` if the program stops before its checks.
fn predicted(
    planned: &PlannedJob,
    writes: Option<bool>,
    checker: &mut Checker,
) -> Vec<formula::ResultRow> {
    let PlannedJob { job, path, run, .. } = planned;
    let mut rows = part::evaluate(path, &run.triggers, job.scatter());
    let actual_formula = job.actual.as_deref().map(|cycle| cycle.formula(&job.setup));
    part::add_true_values(
        &mut rows,
        actual_formula.as_ref().unwrap_or(&path.formula),
        job.setup.plane,
        path.frame.origin,
        &job.placement,
    );
    // The macros judge by their own letters.
    if path.calls.is_none() {
        judge_touches(job, path, &run.triggers, &mut rows);
    }
    if run.collision.is_none() && run.stopped_before.is_none() {
        let off = judge(job, path, &mut rows);
        // If the program stops before a dependent cycle, it makes no further checks.
        if writes.is_some() {
            report_judged(planned, &rows, &off, writes == Some(true), checker);
            match (job.form, job.post.tools) {
                (ProgramForm::Cycle, _) => {
                    let own = job
                        .post
                        .own
                        .map_or(CorrectsTools::Never, |own| own.corrects_tools);
                    wear::report_macros(path, &rows, (own, job.limits.size), checker);
                }
                (ProgramForm::Moves, Some(table)) => {
                    let settings = (table, job.tool_offsets, &job.limits);
                    wear::report_means(path, &rows, settings, checker);
                }
                (ProgramForm::Moves, None) => {}
            }
        }
        report_at_start(job, path, run, checker);
    } else {
        rows.iter_mut().for_each(unknown);
        // Their limits are known nevertheless.
        judge(job, path, &mut rows);
    }
    rows
}

/// Reports faults of the path of one cycle, and of its run.
fn report_path(planned: &PlannedJob, checker: &mut Checker) {
    let PlannedJob { job, path, .. } = planned;
    report_predefined(job, checker);
    for (code, field, message) in &planned.native_rejections {
        checker.error(code, field.clone(), message.clone());
    }
    let feeds = path.feeds.unwrap_or(job.feeds);
    check_path(job, path, checker);
    let runs = !checker.failed();
    report_inertia(job, &request(planned, &feeds, None), checker);
    if runs {
        report_run(planned, checker);
    }
}

/// Reports notes about the results of one cycle.
fn report_results(planned: &PlannedJob, results: &[ResultRow], checker: &mut Checker) {
    report_untrue(&planned.job, results, checker);
    report_uncertain(&planned.job, results, checker);
    report_rotation(&planned.job, &planned.path, checker);
    report_still(&planned.path, checker);
    report_own(&planned.path, checker);
}

/// Checks the path of a job, and of each cycle of a set-up, and predicts the results.
fn results_of(planned: &PlannedJob, checker: &mut Checker) -> Result<Vec<ResultRow>, JobError> {
    let PlannedJob {
        job, path, members, ..
    } = planned;
    if members.is_empty() {
        report_path(planned, checker);
        stock::report(planned, checker);
        if checker.failed() {
            return Err(JobError {
                findings: std::mem::take(checker).findings(),
            });
        }
        let asks = planned.dry.is_none().then(|| planned.writes());
        let mut rows = predicted(planned, asks, checker);
        if planned.dry.is_some() {
            rows.iter_mut().for_each(unknown);
        }
        let results = result_rows(job, path, rows);
        if planned.dry.is_none() {
            report_results(planned, &results, checker);
        }
        return Ok(results);
    }
    let names: Vec<String> = path
        .cycles
        .iter()
        .map(|member| member.name.clone())
        .collect();
    let mut merged = set_up::MergedFindings::new(&names);
    let mut own: Vec<Checker> = Vec::with_capacity(members.len());
    for member in members {
        let mut checker = Checker::in_units(job.scale, job.unit);
        report_path(member, &mut checker);
        own.push(checker);
    }
    set_up::check(planned, checker);
    set_up::report_crossing(planned, checker);
    stock::report(planned, checker);
    let failed = checker.failed() || own.iter().any(Checker::failed);
    // If the program stops in a cycle, or before one, the earlier cycles have measured.
    let collides = planned
        .run
        .collision
        .map(|(index, _)| path.member_of_move(index).unwrap_or(0));
    let measured = match (planned.run.stopped_before, collides) {
        _ if planned.dry.is_some() => 0,
        (Some((before, _)), within) => before.min(within.unwrap_or(before)),
        (None, within) => within.unwrap_or(members.len()),
    };
    let stopped = measured < members.len();
    let mut results = Vec::new();
    for (i, (member, mut checker)) in members.iter().zip(own).enumerate() {
        if !failed {
            let asks = (planned.run.stopped_before.is_none() && planned.dry.is_none())
                .then(|| planned.writes());
            let mut rows = predicted(member, asks, &mut checker);
            if i >= measured {
                rows.iter_mut().for_each(unknown);
            }
            let own = result_rows(&member.job, &member.path, rows);
            if planned.dry.is_none() {
                report_results(member, &own, &mut checker);
            }
            let feeds = member.path.feeds.unwrap_or(member.job.feeds);
            (job.post.check)(&request(member, &feeds, None), &mut checker);
            results.extend(set_up::cycle_rows(i, own));
        }
        merged.take(i, checker.findings());
    }
    // Each cycle has reported these already; report only what the joined path adds.
    let feeds = path.feeds.unwrap_or(job.feeds);
    let mut whole = Checker::in_units(job.scale, job.unit);
    if !failed {
        (job.post.check)(&request(planned, &feeds, None), &mut whole);
    }
    let said: Vec<Finding> = whole
        .findings()
        .into_iter()
        .filter(|finding| !merged.has(&finding.code))
        .collect();
    merged.give(checker);
    said.into_iter()
        .for_each(|finding| checker.adopt(set_up::program_finding(finding)));
    if planned.dry.is_none() {
        report_rotation(job, path, checker);
        dependencies::report(planned, checker);
    }
    if checker.failed() {
        return Err(JobError {
            findings: std::mem::take(checker).findings(),
        });
    }
    if !path.relations.is_empty() {
        let mut rows = part::evaluate(path, &planned.run.triggers, job.scatter());
        if stopped {
            rows.iter_mut().for_each(unknown);
        }
        relations::add_rows(planned, rows, &mut results, Some(checker));
    }
    if planned.dry.is_none() {
        let written = datum::written_rows(planned, &results);
        results.extend(
            written
                .into_iter()
                .map(|row| if stopped { row.without_value() } else { row }),
        );
    }
    Ok(results)
}

/// Reports what a program of native cycles needs to ask before it writes, and that it measures twice.
#[inline(never)]
fn report_measured_twice(request: &Request<'_>, checker: &mut Checker) {
    if request.ask == Ask::Outside {
        checker.error(
            "ask-unsupported",
            "control.ask",
            text!("A program of native cycles always asks: set control.ask to \"always\""),
        );
    } else if request.report != ResultOutput::Screen {
        checker.error(
            "ask-unsupported",
            "control.ask",
            text!("A program that asks shows its results on the screen: set control.report to \"screen\""),
        );
    } else {
        checker.info(
            "measured-twice",
            "control.ask",
            text!("The program makes its moves twice: it measures and shows the results, and after cycle start it measures again and writes"),
        );
    }
}

/// Makes the plan, without its table. `value` is the given job, `checker` has the findings of the check.
pub fn make(planned: &PlannedJob, value: &Value, mut checker: Checker) -> Result<Plan, JobError> {
    let PlannedJob { job, path, run, .. } = planned;
    let feeds = path.feeds.unwrap_or(job.feeds);
    let results = results_of(planned, &mut checker)?;
    let whole = if job.header == HeaderDetail::Full {
        resolved(value)
    } else {
        None
    };
    let request = request(planned, &feeds, whole.as_ref());
    if planned.members.is_empty() {
        (job.post.check)(&request, &mut checker);
    }
    shop::check(&request, &mut checker);
    let asks = request.writes_tables() || request.measures_first() || request.corrects_preset();
    if request.measures_first() {
        report_measured_twice(&request, &mut checker);
    }
    if request.ask != Ask::Never && !asks && !request.post.unused.contains(&ASK) {
        checker.info(
            "ask-unused",
            "control.ask",
            text!("The program writes nothing: it does not ask"),
        );
    }
    if request.asks() && request.ask == Ask::Outside && request.ask_checks().is_empty() {
        checker.error(
            "ask-unsupported",
            "control.ask",
            text!("No result has a tolerance: set control.ask to \"always\""),
        );
    }
    if checker.failed() {
        return Err(JobError {
            findings: checker.findings(),
        });
    }
    let released = release(&request, (job.post.emit)(&request)).map_err(|refusal| {
        report_refusal(refusal, &mut checker);
        JobError {
            findings: std::mem::take(&mut checker).findings(),
        }
    })?;
    let (program, proof, verdicts) = released.into_parts();
    report_rules(job, &verdicts, &mut checker);
    let (length, time) = length_and_time(job, &request);
    let does = request.does();
    Ok(Plan {
        touches: path
            .touches
            .iter()
            .enumerate()
            .map(|(k, t)| TouchPoint {
                point: triple(t.point, job.scale),
                vector: triple(t.vector, 1.0),
                group: t.group,
                cycle: path.member_of_touch(k).unwrap_or(0),
            })
            .collect(),
        moves: path
            .moves
            .iter()
            .enumerate()
            .map(|(i, m)| Move {
                cycle: path.member_of_move(i).unwrap_or(0),
                ..move_row(job, &feeds, m)
            })
            .collect(),
        cycles: path
            .cycles
            .iter()
            .map(|member| member.name.clone())
            .collect(),
        datum: datum::datum_rows(planned),
        relations: path
            .relations
            .iter()
            .map(|relation| relation.name.clone())
            .collect(),
        length,
        time,
        program: ProgramText {
            post: job.post.key,
            extension: job.post.extension,
            text: program.text,
            move_lines: program
                .move_lines
                .iter()
                .map(|line| line.map_or(-1, |n| n as i32))
                .collect(),
            writes: request.writes(),
            does: does.english(),
            said: does,
            proof: proof.map(ProofRow::of),
            own: path.calls.is_some(),
        },
        safety: verdicts.into_iter().map(SafetyRow::of).collect(),
        table: Vec::new(),
        results,
        triggers: run
            .triggers
            .iter()
            .map(|t| t.map(|t| triple(t, job.scale)))
            .collect(),
        findings: checker.findings(),
    })
}

/// Clears a result that the control never stores.
fn unknown(row: &mut crate::formula::ResultRow) {
    (row.value, row.deviation, row.uncertainty, row.verdict) = (None, None, None, None);
}

/// Reports why a program is refused, with a limited number of errors.
fn report_refusal(refusal: Refusal, checker: &mut Checker) {
    const MOST: usize = 5;
    match refusal {
        Refusal::NotProven(faults) => {
            for fault in faults.iter().take(MOST) {
                let fault_text = fault.message.clone();
                let message = match fault.line {
                    Some(line) => text!(
                        "The program is refused: read back, it differs from the path. Line {line}: {fault}",
                        line + 1,
                        fault_text
                    ),
                    None => text!(
                        "The program is refused: read back, it differs from the path. {fault}",
                        fault_text
                    ),
                };
                checker.error("not-proven", "control.post", message);
            }
        }
        Refusal::TooLong(most) => {
            let message = text!(
                "A block of the program would have more than {most} characters, which the control does not read: use shorter names of cycles",
                most
            );
            checker.error("block-too-long", "control.post", message);
        }
        Refusal::Broken(verdicts) => {
            for verdict in verdicts.iter().take(MOST) {
                let message = text!(
                    "The program breaks the rule {rule}: {message}",
                    verdict.rule.to_owned(),
                    verdict.message.clone()
                );
                checker.error("rule-broken", "control.post", message);
            }
        }
    }
}

/// The plan of a job with its path, and without the table, which [`PlannedJob::table`] makes when it is read.
pub fn plan_with_path(value: &Value) -> Result<(PlannedJob, Plan), JobError> {
    let mut checker = Checker::default();
    let Some(planned) = read(&mut checker, value) else {
        return Err(JobError {
            findings: checker.findings(),
        });
    };
    let plan = make(&planned, value, checker)?;
    Ok((planned, plan))
}

/// The path of a job and its run on the actual part, in mm; `None` for a job with errors.
pub fn planned(value: &Value) -> Option<PlannedJob> {
    read(&mut Checker::default(), value)
}

/// Whether the program of a job writes a work offset or a preset in any way.
pub fn writes_any(planned: &PlannedJob) -> bool {
    let feeds = planned.path.feeds.unwrap_or(planned.job.feeds);
    !request(planned, &feeds, None).writes().is_empty()
}

/// Request for the program of a planned job.
pub(super) fn request<'a>(
    planned: &'a PlannedJob,
    feeds: &'a Feeds,
    whole: Option<&'a Value>,
) -> Request<'a> {
    let PlannedJob { job, path, dry, .. } = planned;
    let measures = dry.is_none();
    Request {
        post: job.post,
        tool: job.tool,
        name: &job.name,
        title: job.def.title,
        source: job.def.source,
        number: job.number,
        form: job.form,
        scale: job.scale,
        plane: job.setup.plane,
        setup: &job.setup,
        feeds,
        work_offset: job.work_offset,
        limits: job.limits,
        orient: job.orient,
        probe_input: job.probe_input,
        report: job.report,
        ask: job.ask,
        tool_offsets: job.tool_offsets,
        edition: job.edition,
        path: dry.as_ref().unwrap_or(path),
        shop: &job.shop,
        protected: job.protected || !measures,
        dry: job.dry,
        job: whole,
        header: job.header,
        numbered: OnceCell::new(),
    }
}

/// Reports events on the part. A collision with the nominal part is an error: its program is useless. A collision with a displaced virtual part is a warning:
/// the program is correct for the nominal part.
fn report_run(planned: &PlannedJob, checker: &mut Checker) {
    let PlannedJob {
        job,
        path,
        surfaces,
        run,
        ..
    } = planned;
    let field = if job.placement.nominal {
        "cycle"
    } else {
        "part"
    };
    if job.placement.nominal {
        report_stylus(job, path, run, None, checker);
    } else {
        // A displaced part does not justify a path that collides with the nominal one.
        let nominal = part::run(path, &path.surfaces, &job.setup);
        if let Some(collision) = nominal.collision {
            report_collision(path, collision, &nominal.triggers, "cycle", checker);
        }
        let ran = run.shifted_path.as_deref().unwrap_or(path);
        // A cycle that the program does not reach cannot collide.
        let actual = Some((ran, surfaces.as_slice(), run)).filter(|_| run.stopped_before.is_none());
        report_stylus(job, path, &nominal, actual, checker);
    }
    report_unknown(job, path, checker);
    if run.stopped_before.is_some() {
        return;
    }
    if let Some(collision) = run.collision {
        report_collision(path, collision, &run.triggers, field, checker);
        return;
    }
    // A macro stops at the first touch without contact.
    let made = path.moves.iter().filter_map(|step| match step.purpose {
        MovePurpose::Search(k) => Some((k, run.triggers[k])),
        MovePurpose::Position | MovePurpose::Touch(_) | MovePurpose::Retract(_) => None,
    });
    match path.calls.is_some() {
        true => report_missed(
            path,
            made.filter(|(_, trigger)| trigger.is_none()).take(1),
            field,
            checker,
        ),
        false => report_missed(
            path,
            run.triggers.iter().copied().enumerate(),
            field,
            checker,
        ),
    }
    for &k in &run.edges {
        let message = text!(
            "Touch {touch} contacts an edge of the part, not the face of its wall: its trigger says little about the wall",
            k + 1
        );
        checker.warning("edge-contact", field, message);
    }
    for &(k, wall) in &run.wrong_walls {
        let message = text!(
            "Touch {touch} is meant for wall {wall} and contacts wall {other} first",
            k + 1,
            path.touches[k].group + 1,
            wall + 1
        );
        checker.warning("wrong-wall", field, message);
    }
}

/// Reports a collision, and earlier touches without contact: a control stops at the first of those.
fn report_collision(
    path: &Path,
    (index, center): (usize, Vec3),
    triggers: &[Option<Vec3>],
    field: &str,
    checker: &mut Checker,
) {
    let step = &path.moves[index];
    let message = text!(
        "Move {move} (step {step}, {purpose}) hits the part with the ball centre at {place}",
        index + 1,
        step.step,
        purpose(step.purpose),
        checker.position(center)
    );
    if field == "cycle" {
        checker.error("collision", field, message);
    } else {
        let message = text!(
            "{message}. The program is that of the nominal part; on this one the control stores no results",
            message
        );
        checker.warning("collision", field, message);
    }
    let made = path.moves[..index]
        .iter()
        .filter_map(|step| match step.purpose {
            MovePurpose::Touch(k) => Some(k),
            MovePurpose::Position | MovePurpose::Search(_) | MovePurpose::Retract(_) => None,
        });
    report_missed(path, made.map(|k| (k, triggers[k])), field, checker);
}

/// Reports touches without contact.
fn report_missed(
    path: &Path,
    triggers: impl Iterator<Item = (usize, Option<Vec3>)>,
    field: &str,
    checker: &mut Checker,
) {
    for (k, trigger) in triggers {
        if trigger.is_none() {
            let message = text!(
                "Touch {touch} makes no contact within {search} past its nominal contact: the control stops there, and results that need it are unknown",
                k + 1,
                checker.length(path.touches[k].search)
            );
            checker.warning("no-contact", field, message);
        }
    }
}

/// Reports a stored result that differs from the true value by more than a harmless amount.
fn report_untrue(job: &Job, results: &[ResultRow], checker: &mut Checker) {
    /// In mm and in degrees.
    const MISLEADING: f64 = 0.05;
    let off = |row: &ResultRow| {
        let off = row.value? - row.truth?;
        let size = off.abs() * if row.unit == "deg" { 1.0 } else { job.scale };
        (size > MISLEADING).then_some((size, off))
    };
    let untrue: Vec<(&ResultRow, (f64, f64))> = results
        .iter()
        .filter_map(|row| Some((row, off(row)?)))
        .collect();
    // The first of the largest errors.
    let worse = |a: &(f64, f64), b: &(f64, f64)| a.0 > b.0;
    let Some((worst, (_, off))) = untrue
        .iter()
        .reduce(|worst, row| if worse(&row.1, &worst.1) { row } else { worst })
    else {
        return;
    };
    let unit = if worst.unit == "deg" {
        "°".to_owned()
    } else {
        format!(" {}", worst.unit)
    };
    let places = if job.scale == 1.0 { 3 } else { 4 };
    let shown = |x: f64| format!("{}{unit}", decimal(x, places));
    let others = match untrue.len() {
        1 => Text::words(""),
        n => text!(
            " ({count} of the results are off by more than {limit})",
            n,
            checker.length(MISLEADING)
        ),
    };
    let message = text!(
        "On this part the control stores {value} as {result} (true: {truth}): off by {off}{others}",
        shown(worst.value.unwrap_or(0.0)),
        worst.said.meaning.clone(),
        shown(worst.truth.unwrap_or(0.0)),
        shown(*off),
        others
    );
    checker.warning("result-untrue", "part", message);
}

/// Reports a length that scatters far more than a single touch: the touches are too close to each other, or too far from the computed point.
fn report_uncertain(job: &Job, results: &[ResultRow], checker: &mut Checker) {
    /// Factor over the scatter of a single touch.
    const DOUBTFUL: f64 = 20.0;
    let single = job.repeatability / job.scale;
    // Of the touches only, without the eccentricity of the ball.
    let sigma = |row: &ResultRow| {
        let [whole, runout] = [row.uncertainty, row.uncertainty_runout].map(|x| x.unwrap_or(0.0));
        (whole * whole - runout * runout).max(0.0).sqrt()
    };
    let times = |row: &ResultRow| {
        if row.unit == "deg" {
            0.0
        } else {
            sigma(row) / single
        }
    };
    let worst = results.iter().max_by(|a, b| times(a).total_cmp(&times(b)));
    let Some(worst) = worst.filter(|row| single > 0.0 && times(row) > DOUBTFUL) else {
        return;
    };
    // The short arc is reported already.
    if checker.has("short-arc") {
        return;
    }
    let message = text!(
        "{result} is {times} times as uncertain as a single touch (one sigma {sigma}): the touches are too close to each other, or too far from it",
        worst.said.meaning.clone(),
        decimal(times(worst), 0),
        checker.length(sigma(worst) * job.scale)
    );
    checker.warning("uncertain-result", "cycle", message);
}

fn length_and_time(job: &Job, request: &Request<'_>) -> (f64, f64) {
    let (mut length, mut time) = (0.0, 0.0);
    for (way, minutes) in ways(job, request) {
        length += way;
        time += minutes;
    }
    let times = if request.measures_first() { 2.0 } else { 1.0 };
    (tidy(times * length / job.scale), tidy(times * time))
}

/// Time of each move, minutes; their sum is the plan's time.
#[cfg(any(test, target_arch = "wasm32"))]
pub fn minutes(planned: &PlannedJob) -> Vec<f64> {
    let feeds = planned.path.feeds.unwrap_or(planned.job.feeds);
    let request = request(planned, &feeds, None);
    ways(&planned.job, &request)
        .map(|(_, minutes)| minutes)
        .collect()
}

/// Length of each move, mm, and its time, minutes. A first move from an unknown position counts 0.
fn ways<'a>(job: &'a Job, request: &'a Request<'_>) -> impl Iterator<Item = (f64, f64)> + 'a {
    let mut at = request.path.start;
    request.path.moves.iter().map(move |step| {
        let Some(from) = at.replace(step.to) else {
            return (0.0, 0.0);
        };
        let way = match step.arc {
            Some(arc) => from.distance(arc.center) * arc.sweep.abs(),
            None => from.distance(step.to),
        };
        (
            way,
            way / (job.post.rate)(request, Some(from), step).unwrap_or(RAPID_RATE),
        )
    })
}
