//! From a checked job to a whole plan, and back into the job's units.

use serde::Serialize;

use crate::control::prove::{self, Fault, Proof};
use crate::control::safety::{self, Verdict};
use crate::control::{Form, Header, Program, Request};
use crate::form::{Checker, Finding, Value};
use crate::formula::Unit;
use crate::geom::{AXIS_NAMES, Vec3};
use crate::job::{Job, JobError, resolved};
use crate::num::{decimal, tidy};
use crate::part;
use crate::path::{self, Accessor, Feed, Feeds, MOST_ASKEW, Path, Purpose, RAPID_RATE, SHORTEST_TOUCH, Surface, TouchFault};

/// A point or vector as a list.
pub type Triple = [f64; 3];

/// Everything that follows from a job. Lengths in the job's units, angles in degrees.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Plan {
    /// The nominal touches, on the surface.
    pub touches: Vec<TouchPoint>,
    /// The moves, of the ball centre.
    pub moves: Vec<Move>,
    /// Length of the whole path: from where the job says the ball is, else from where the first move ends.
    pub length: f64,
    /// Minutes for the same, rapids at 5000 mm/min.
    pub time: f64,
    /// The program.
    pub program: ProgramText,
    /// The source's parameter table.
    pub table: Vec<ParameterRow>,
    /// What the control will have stored, for the virtual part.
    pub results: Vec<ResultRow>,
    /// Ball centre at the trigger of each touch on the virtual part; null where it is not met in time.
    pub triggers: Vec<Option<Triple>>,
    /// Warnings and notes.
    pub findings: Vec<Finding>,
    /// What each safety rule says of the program.
    pub safety: Vec<SafetyRow>,
}

/// What a safety rule says of the program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SafetyRow {
    /// The name of the rule.
    pub rule: &'static str,
    /// Null where this control cannot hold it, or its own cycle answers for it.
    pub holds: Option<bool>,
    /// What the rule asks, what is wrong, or why the control cannot.
    pub message: String,
    /// The 0-based lines that break it.
    pub lines: Vec<usize>,
}

/// What was proven of a program of moves: read back, it is the path.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProofRow {
    /// How many moves.
    pub moves: usize,
    /// How many of them are touches.
    pub touches: usize,
    /// Whether the program computes the results itself, and the right ones.
    pub arithmetic: bool,
}

impl From<Proof> for ProofRow {
    fn from(proof: Proof) -> Self {
        ProofRow { moves: proof.moves(), touches: proof.touches(), arithmetic: proof.arithmetic() }
    }
}

/// One nominal touch.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TouchPoint {
    /// On the surface.
    pub point: Triple,
    /// Target vector: outward normal of the surface.
    pub vector: Triple,
    /// Wall or circle, from 0.
    pub group: usize,
}

/// One move of the ball centre.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Move {
    /// Where it ends; a touch at its nominal contact.
    pub to: Triple,
    /// `approach`, `longLink`, `work`, `retract`, `return` or `rapid`.
    pub feed: &'static str,
    /// `position`, `touch` or `back`.
    pub kind: &'static str,
    /// Step of the cycle's documented list, from 1.
    pub step: u8,
    /// The touch it belongs to.
    pub touch: Option<usize>,
    /// The arc it runs along; null is a straight line.
    pub arc: Option<Arc>,
}

/// An arc about the tool axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Arc {
    /// Its centre.
    pub center: Triple,
    /// Degrees, counter-clockwise positive.
    pub sweep: f64,
}

/// The program as text.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ProgramText {
    /// Which control it is for.
    pub post: &'static str,
    /// The usual file extension, without the dot.
    pub extension: &'static str,
    /// The lines.
    pub text: String,
    /// For each move the 0-based line that makes it.
    pub move_lines: Vec<i32>,
    /// What was proven of it; null in the form `cycle`.
    pub proof: Option<ProofRow>,
}

/// One row of the parameter table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterRow {
    /// `CmdPrm.Flt[-53]`.
    pub code: String,
    /// The type column of the source.
    #[serde(rename = "type")]
    pub type_name: &'static str,
    /// The value, lengths in the job's units.
    pub value: ParameterValue,
    /// What it means.
    pub meaning: String,
    /// Path of the job's field it comes from.
    pub field: Option<String>,
    /// The touch it comes from.
    pub touch: Option<usize>,
}

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ParameterValue {
    /// A whole number.
    Whole(i32),
    /// True or false.
    Flag(bool),
    /// Any other number.
    Number(f64),
    /// Text, as it was given.
    Text(String),
}

/// One result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ResultRow {
    /// `center.x`.
    pub code: String,
    /// What it is.
    pub meaning: String,
    /// `mm`, `inch` or `deg`.
    pub unit: &'static str,
    /// On the nominal part.
    pub nominal: Option<f64>,
    /// What the control computes.
    pub value: Option<f64>,
    /// Value less nominal.
    pub deviation: Option<f64>,
    /// One sigma of the value.
    pub uncertainty: Option<f64>,
    /// Good, rework or scrap, where a tolerance is given.
    pub verdict: Option<String>,
    /// What is true of the virtual part, where there is one.
    pub truth: Option<f64>,
    /// Why the value is not the truth, where it is not.
    pub note: Option<String>,
}

/// The surfaces of the actual part where it really lies.
pub fn actual_surfaces(job: &Job) -> Vec<Surface> {
    let cycle = job.actual.as_deref().unwrap_or(&*job.cycle);
    part::place(&cycle.surfaces(&job.setup), &job.lie)
}

/// The path, with the formula as the control computes it.
fn planned(job: &Job) -> Path {
    let mut path = job.cycle.plan(&job.setup);
    if job.post.computes {
        path.formula = path.formula.plain();
    }
    path
}

/// Where a job's path runs, and what happens on the actual part. Lengths in mm.
#[derive(Debug)]
pub struct Planned {
    /// The checked job.
    pub job: Job,
    /// Its path.
    pub path: Path,
    /// The surfaces of the actual part.
    pub surfaces: Vec<Surface>,
    /// What happens there.
    pub run: part::Run,
}

impl Planned {
    /// Plans the path of a checked job and runs it.
    pub fn of(job: Job) -> Self {
        let path = planned(&job);
        let surfaces = actual_surfaces(&job);
        let run = part::run(&path, &surfaces, &job.setup);
        Planned { job, path, surfaces, run }
    }
}

/// What the whole path must hold, whatever cycle it is of.
fn check_path(job: &Job, path: &Path, checker: &mut Checker) {
    for (k, fault) in path.touch_faults(job.setup.radius) {
        let field = if path.feature.picked() { format!("cycle.touches[{k}]") } else { "cycle".to_owned() };
        let n = k + 1;
        let (code, message) = match fault {
            TouchFault::Missing => {
                ("touch-missing", format!("Touch {n} is not in the path once: nothing would assign its trigger"))
            }
            TouchFault::Short(way) => (
                "touch-too-short",
                format!(
                    "Touch {n} begins {} before its nominal contact: at least {} are needed, or the ball begins in contact",
                    checker.length(way),
                    checker.length(SHORTEST_TOUCH)
                ),
            ),
            TouchFault::Askew(angle) => (
                "touch-askew",
                format!(
                    "Touch {n} would run askew by {}° of its inverted target vector: at most {MOST_ASKEW}° are taken",
                    decimal(angle, 2)
                ),
            ),
        };
        checker.error(code, field, message);
    }
    job.cycle.review(&job.setup, path, checker);
}

/// Makes the plan; `value` is the job as it was given. `checker` holds what the check has found.
pub fn make(planned: &Planned, value: &Value, mut checker: Checker) -> Result<Plan, JobError> {
    let Planned { job, path, run, .. } = planned;
    for (field, label) in job.cycle.set_on_the_control() {
        let what = format!("The {label} is PREDEF: its value is in the control's GLOBAL DEF and not known here");
        if job.form == Form::Moves {
            let message = format!("{what}. A program of moves needs the value: clear the flag and give it");
            checker.error("not-known", field, message);
        } else {
            let message = format!("{what}. Moves, triggers and collisions are shown with the form's number in its place");
            checker.warning("predefined", field, message);
        }
    }
    check_path(job, path, &mut checker);
    if !checker.failed() {
        report_run(job, path, run, &mut checker);
    }
    if checker.failed() {
        return Err(JobError { findings: checker.findings() });
    }
    let mut rows = part::evaluate(path, &run.triggers, job.repeatability);
    let actual_formula = job.actual.as_deref().map(|cycle| cycle.plan(&job.setup).formula);
    part::add_truth(&mut rows, actual_formula.as_ref().unwrap_or(&path.formula), job.setup.plane, path.frame.origin, &job.lie);
    job.cycle.judge(&job.setup, path, &run.triggers, &mut rows);
    let results = result_rows(job, path, rows);
    report_untrue(job, &results, &mut checker);
    let feeds = path.feeds.unwrap_or(job.feeds);
    let whole = if job.header == Header::Full { resolved(value) } else { None };
    let request = request(planned, &feeds, whole.as_ref());
    (job.post.check)(&request, &mut checker);
    if checker.failed() {
        return Err(JobError { findings: checker.findings() });
    }
    let Some((program, proof, verdicts)) = handed_out(&request, (job.post.emit)(&request), &mut checker) else {
        return Err(JobError { findings: checker.findings() });
    };
    let (length, time) = length_and_time(job, &request);
    Ok(Plan {
        touches: path
            .touches
            .iter()
            .map(|t| TouchPoint { point: triple(t.point, job.scale), vector: triple(t.vector, 1.0), group: t.group })
            .collect(),
        moves: path.moves.iter().map(|m| move_row(job, &feeds, m)).collect(),
        length,
        time,
        program: ProgramText {
            post: job.post.key,
            extension: job.post.extension,
            text: program.text,
            move_lines: program.move_lines.iter().map(|line| line.map_or(-1, |n| n as i32)).collect(),
            proof: proof.map(ProofRow::from),
        },
        safety: verdicts.into_iter().map(safety_row).collect(),
        table: path.parameters.iter().map(|p| parameter_row(job, p)).collect(),
        results,
        triggers: run.triggers.iter().map(|t| t.map(|t| triple(t, job.scale))).collect(),
        findings: checker.findings(),
    })
}

/// What a program is to be written for.
fn request<'a>(planned: &'a Planned, feeds: &'a Feeds, whole: Option<&'a Value>) -> Request<'a> {
    let Planned { job, path, .. } = planned;
    Request {
        post: job.post,
        tool: job.tool,
        name: &job.name,
        title: job.def.title,
        source: job.def.source,
        form: job.form,
        scale: job.scale,
        plane: job.setup.plane,
        setup: &job.setup,
        feeds,
        work_offset: job.work_offset,
        path,
        protected: job.protected,
        job: whole,
        header: job.header,
    }
}

/// How many faults of a program are listed.
const MOST_FAULTS: usize = 5;

/// No program leaves without its proof: one of moves is read back and proven equal to its path, and every rule that must hold holds.
fn handed_out(
    request: &Request<'_>,
    program: Program,
    checker: &mut Checker,
) -> Option<(Program, Option<Proof>, Vec<Verdict>)> {
    let (proof, verdicts) = match (request.form, request.post.read) {
        (Form::Cycle, None) => (None, safety::not_followed()),
        _ => match judged(request, &program) {
            Ok(judged) => judged,
            Err(faults) => {
                faults
                    .iter()
                    .take(MOST_FAULTS)
                    .for_each(|fault| checker.error("not-proven", "control.post", not_proven(fault)));
                return None;
            }
        },
    };
    for verdict in verdicts.iter().filter(|verdict| verdict.holds == Some(false)) {
        if safety::RULES.iter().any(|rule| rule.name == verdict.rule && rule.must) {
            checker.error(
                "rule-broken",
                "control.post",
                format!("The program breaks the rule {}: {}", verdict.rule, verdict.message),
            );
        }
    }
    (!checker.failed()).then_some((program, proof, verdicts))
}

fn judged(request: &Request<'_>, program: &Program) -> Result<(Option<Proof>, Vec<Verdict>), Vec<Fault>> {
    let followed = prove::follow(request, &program.text, prove::Part::Path)?;
    let proof = match request.form {
        Form::Moves => Some(prove::prove(request, &followed, &program.move_lines)?),
        Form::Cycle => None,
    };
    Ok((proof, safety::check(request, &followed)))
}

fn not_proven(fault: &Fault) -> String {
    let what = "The program that was made is refused: read back, it is not the path";
    match fault.line {
        Some(line) => format!("{what}. Line {}: {}", line + 1, fault.message),
        None => format!("{what}: {}", fault.message),
    }
}

fn safety_row(verdict: Verdict) -> SafetyRow {
    SafetyRow { rule: verdict.rule, holds: verdict.holds, message: verdict.message, lines: verdict.lines }
}

/// What the safety rules say of a text that is to be the program of this job; none where the job has errors. Faults are the lines that
/// are not understood.
pub fn examine(value: &Value, text: &str) -> Option<Result<Vec<SafetyRow>, Vec<Fault>>> {
    let planned = Planned::of(Job::read(&mut Checker::default(), value)?);
    let feeds = planned.path.feeds.unwrap_or(planned.job.feeds);
    let request = request(&planned, &feeds, None);
    request.post.read?;
    let followed = prove::follow(&request, text, prove::Part::Unknown);
    Some(followed.map(|followed| safety::check(&request, &followed).into_iter().map(safety_row).collect()))
}

/// How long printing, proof and rules take, for the bench: each with what it needs done before, `rounds` times.
#[doc(hidden)]
pub fn stages(value: &Value, rounds: u32, mut timed: impl FnMut(&'static str, &mut dyn FnMut())) {
    let Some(job) = Job::read(&mut Checker::default(), value) else { return };
    let planned = Planned::of(job);
    let feeds = planned.path.feeds.unwrap_or(planned.job.feeds);
    let whole = resolved(value);
    let request = request(&planned, &feeds, whole.as_ref());
    let program = (request.post.emit)(&request);
    let Ok(followed) = prove::follow(&request, &program.text, prove::Part::Path) else { return };
    timed("print", &mut || (0..rounds).for_each(|_| drop(std::hint::black_box((request.post.emit)(&request)))));
    timed("prove", &mut || {
        (0..rounds).for_each(|_| {
            let followed = prove::follow(&request, &program.text, prove::Part::Path);
            let _ = std::hint::black_box(followed.map(|f| prove::prove(&request, &f, &program.move_lines)));
        });
    });
    timed("rules", &mut || (0..rounds).for_each(|_| drop(std::hint::black_box(safety::check(&request, &followed)))));
}

/// Whether a text is proven to be the program of a job, its moves in these 0-based lines. None of a job with errors is.
pub fn proves(value: &Value, text: &str, lines: &[i32]) -> bool {
    let Some(job) = Job::read(&mut Checker::default(), value) else { return false };
    let planned = Planned::of(job);
    let feeds = planned.path.feeds.unwrap_or(planned.job.feeds);
    let request = request(&planned, &feeds, None);
    let lines: Vec<Option<usize>> = lines.iter().map(|line| usize::try_from(*line).ok()).collect();
    let followed = prove::follow(&request, text, prove::Part::Path);
    followed.is_ok_and(|followed| prove::prove(&request, &followed, &lines).is_ok())
}

/// The results from measured points.
pub fn evaluate(job: &Job, measured: &Value, mut checker: Checker) -> Result<Vec<ResultRow>, JobError> {
    let path = planned(job);
    let before = checker.count();
    let points = part::read_measured(&mut checker, measured);
    if checker.count() == before && points.len() != path.touches.len() {
        let message =
            format!("{} points are given for {} touches: one ball centre a touch, in order", points.len(), path.touches.len());
        checker.error("wrong-count", "measured", message);
    }
    for (k, (point, touch)) in points.iter().zip(&path.touches).enumerate() {
        let Some(point) = point else { continue };
        let contact = touch.contact(job.setup.radius);
        let away = *point - contact;
        // A part that lies nearer triggers anywhere on the way to the contact, from where the touch begins.
        let in_front = away.dot(touch.vector);
        let aside = (away - touch.vector * in_front).length();
        let reach = touch.search + 1e-6;
        if aside > reach || in_front < -reach || in_front > reach.max(way_to(&path, k) + 1e-6) {
            let message = format!(
                "Point {} lies {} from the nominal contact of its touch, more than it can reach (it searches {} past it): is it \
                 of this job, a ball centre, in order?",
                k + 1,
                checker.length(away.length()),
                checker.length(touch.search)
            );
            checker.error("too-far", format!("measured[{k}]"), message);
        }
    }
    if checker.failed() {
        return Err(JobError { findings: checker.findings() });
    }
    let mut rows = part::evaluate(&path, &points, job.repeatability);
    job.cycle.judge(&job.setup, &path, &points, &mut rows);
    Ok(result_rows(job, &path, rows))
}

/// How far a touch goes to its nominal contact, mm.
fn way_to(path: &Path, touch: usize) -> f64 {
    let Some(i) = path.moves.iter().position(|m| m.purpose == Purpose::Touch(touch)) else { return 0.0 };
    let from = if i > 0 { Some(path.moves[i - 1].to) } else { path.start };
    from.map_or(0.0, |from| from.distance(path.moves[i].to))
}

fn report_run(job: &Job, path: &Path, run: &part::Run, checker: &mut Checker) {
    let field = if job.lie.nominal { "cycle" } else { "part" };
    if let Some((index, center)) = run.collision {
        let step = &path.moves[index];
        let place: Vec<String> = (0..3).map(|i| format!("{} {}", AXIS_NAMES[i], checker.number(center[i]))).collect();
        let what = match step.purpose {
            Purpose::Position => "positioning".to_owned(),
            Purpose::Back(k) => format!("back from touch {}", k + 1),
            Purpose::Touch(k) => format!("touch {}", k + 1),
        };
        let message = format!(
            "Move {} (step {}, {what}) meets the part with the ball centre at {}",
            index + 1,
            step.step,
            place.join(", ")
        );
        checker.error("collision", field, message);
        return;
    }
    for (k, trigger) in run.triggers.iter().enumerate() {
        if trigger.is_none() {
            let message = format!(
                "Touch {} meets nothing within {} past its nominal contact: the control stops there, and \
                 what needs it is not known",
                k + 1,
                checker.length(path.touches[k].search)
            );
            checker.warning("no-contact", field, message);
        }
    }
    for &k in &run.edges {
        let message =
            format!("Touch {} meets an edge of the part, not the face of its wall: its trigger says little of the wall", k + 1);
        checker.warning("edge-contact", field, message);
    }
    for &(k, wall) in &run.strays {
        let message =
            format!("Touch {} is meant for wall {} and meets wall {} first", k + 1, path.touches[k].group + 1, wall + 1);
        checker.warning("wrong-wall", field, message);
    }
}

/// A stored result that differs from the truth of the part by more than is harmless.
fn report_untrue(job: &Job, results: &[ResultRow], checker: &mut Checker) {
    /// In mm, and in degrees.
    const MISLEADING: f64 = 0.05;
    let off = |row: &ResultRow| {
        let off = row.value? - row.truth?;
        let size = off.abs() * if row.unit == "deg" { 1.0 } else { job.scale };
        (size > MISLEADING).then_some((size, off))
    };
    let mut untrue: Vec<(&ResultRow, (f64, f64))> = results.iter().filter_map(|row| Some((row, off(row)?))).collect();
    untrue.sort_by(|a, b| b.1.0.total_cmp(&a.1.0));
    let Some((worst, (_, off))) = untrue.first() else { return };
    let unit = if worst.unit == "deg" { "°".to_owned() } else { format!(" {}", worst.unit) };
    let places = if job.scale == 1.0 { 3 } else { 4 };
    let others = match untrue.len() {
        1 => String::new(),
        n => format!(" ({} of the results are off by more than {})", n, checker.length(MISLEADING)),
    };
    let message = format!(
        "On this part the control stores {}{unit} as {}, and {}{unit} is true: off by {}{unit}{others}",
        decimal(worst.value.unwrap_or(0.0), places),
        worst.code,
        decimal(worst.truth.unwrap_or(0.0), places),
        decimal(*off, places),
    );
    checker.warning("result-untrue", "part", message);
}

fn result_rows(job: &Job, path: &Path, mut rows: Vec<crate::formula::ResultRow>) -> Vec<ResultRow> {
    if let Some(n) = job.work_offset {
        part::write_offset(&mut rows, &path.formula, job.setup.plane, &(job.post.work_offset_word)(n));
    }
    rows.into_iter()
        .map(|row| {
            let (scale, unit) = match row.unit {
                Unit::Length => (job.scale, job.unit),
                Unit::Angle => (1.0, "deg"),
                Unit::None => (1.0, ""),
            };
            let convert = |x: Option<f64>| x.filter(|x| x.is_finite()).map(|x| tidy(x / scale));
            let off = row.value.zip(row.truth).map(|(value, truth)| value - truth).filter(|off| off.abs() > 1e-6);
            let note = off.and_then(|off| {
                let reason = job.cycle.turned_error(&row.code).filter(|_| job.lie.turn != 0.0)?;
                let sign = if off > 0.0 { "+" } else { "" };
                Some(format!("{sign}{} {} from the truth: {reason}", decimal(off / scale, 5), job.unit))
            });
            ResultRow {
                code: row.code,
                meaning: row.meaning,
                unit,
                nominal: convert(row.nominal),
                value: convert(row.value),
                deviation: convert(row.deviation),
                uncertainty: convert(row.uncertainty),
                verdict: row.verdict,
                truth: convert(row.truth),
                note,
            }
        })
        .collect()
}

fn move_row(job: &Job, feeds: &Feeds, step: &path::Move) -> Move {
    let (kind, touch) = match step.purpose {
        Purpose::Position => ("position", None),
        Purpose::Touch(k) => ("touch", Some(k)),
        Purpose::Back(k) => ("back", Some(k)),
    };
    let feed = match step.feed {
        feed if feeds.is_rapid(feed) => "rapid",
        Feed::Rapid => "rapid",
        Feed::Approach => "approach",
        Feed::LongLink => "longLink",
        Feed::Work => "work",
        Feed::Retract => "retract",
        Feed::Return => "return",
    };
    let arc = step.arc.map(|arc| Arc { center: triple(arc.center, job.scale), sweep: tidy(arc.sweep.to_degrees()) });
    Move { to: triple(step.to, job.scale), feed, kind, step: step.step, touch, arc }
}

fn parameter_row(job: &Job, parameter: &path::Parameter) -> ParameterRow {
    ParameterRow {
        code: match parameter.accessor {
            Accessor::Q => format!("Q{}", parameter.code),
            accessor => format!("CmdPrm.{}[{}]", accessor.word(), parameter.code),
        },
        type_name: parameter.type_name,
        value: match &parameter.value {
            path::ParameterValue::Length(mm) => ParameterValue::Number(tidy(mm / job.scale)),
            path::ParameterValue::Number(x) => ParameterValue::Number(tidy(*x)),
            path::ParameterValue::Whole(n) => ParameterValue::Whole(*n),
            path::ParameterValue::Flag(on) => ParameterValue::Flag(*on),
            path::ParameterValue::Text(text) => ParameterValue::Text(text.clone()),
            path::ParameterValue::Word(word) => ParameterValue::Text((*word).to_owned()),
        },
        meaning: parameter.meaning.clone(),
        field: parameter.field.clone(),
        touch: parameter.touch,
    }
}

fn length_and_time(job: &Job, request: &Request<'_>) -> (f64, f64) {
    let mut length = 0.0;
    let mut time = 0.0;
    let mut at = request.path.start;
    for step in &request.path.moves {
        if let Some(from) = at {
            let way = match step.arc {
                Some(arc) => from.distance(arc.center) * arc.sweep.abs(),
                None => from.distance(step.to),
            };
            length += way;
            time += way / (job.post.rate)(request, at, step).unwrap_or(RAPID_RATE);
        }
        at = Some(step.to);
    }
    (tidy(length / job.scale), tidy(time))
}

fn triple(v: Vec3, scale: f64) -> Triple {
    v.to_array().map(|x| tidy(x / scale))
}
