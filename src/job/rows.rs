//! What goes out: a plan as plain rows, in the job's units.

use serde::{Serialize, Serializer};

use crate::control::prove::Proof;
use crate::control::safety::Verdict;
use crate::form::Finding;
use crate::formula::Unit;
use crate::geom::Vec3;
use crate::job::Job;
use crate::num::{decimal, tidy};
use crate::part;
use crate::path::{self, Accessor, Feed, Feeds, Path, Purpose};
use crate::text::{Text, text};

/// X, Y, Z of the work coordinate system: a point in the job's units, or a vector of length one.
pub type Triple = [f64; 3];

/// Everything that follows from a job. Lengths in the job's units, angles in degrees.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Plan {
    /// The nominal touches, on the surface.
    pub touches: Vec<TouchPoint>,
    /// The moves, of the ball centre.
    pub moves: Vec<Move>,
    /// The names of the cycles of a set-up, in their order; empty for a job of one cycle.
    pub cycles: Vec<String>,
    /// The names of the relations of a set-up, in their order.
    pub relations: Vec<String>,
    /// Of a set-up, what can be written into each axis of a work offset and into its rotation, and what is; empty for a job of one cycle.
    pub datum: Vec<DatumRow>,
    /// Length of the whole path: from where the job says the ball is, else from where the first move ends.
    pub length: f64,
    /// Minutes for the same. Rapids run at 5000 mm/min, or at the feed that the control's program states for them.
    pub time: f64,
    /// The program, for the control of the job.
    pub program: ProgramText,
    /// The cycle's parameters as its source numbers them.
    pub table: Vec<ParameterRow>,
    /// Results the control will store, for the virtual part.
    pub results: Vec<ResultRow>,
    /// Ball centre at the trigger of each touch on the virtual part; null where it is not met in time.
    pub triggers: Vec<Option<Triple>>,
    /// Warnings and notes; with an error there is no plan.
    pub findings: Vec<Finding>,
    /// For each safety rule, whether the program keeps it.
    pub safety: Vec<SafetyRow>,
}

/// What can be written into an axis of a work offset, or into its rotation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DatumRow {
    /// `x`, `y`, `z` or `rotation`: abscissa, ordinate, tool axis.
    pub axis: &'static str,
    /// The result that is written, `BORE.center.x`, or would be if a work offset were chosen; null where none is.
    pub from: Option<String>,
    /// Every result that can be.
    pub choices: Vec<String>,
}

/// Whether the program keeps a safety rule.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SafetyRow {
    /// The name of the rule.
    pub rule: &'static str,
    /// Null where this control cannot hold it, or its own cycle answers for it.
    pub holds: Option<bool>,
    /// What the rule asks, what is wrong, or why the control cannot.
    pub message: String,
    /// The same as a template and its values.
    pub said: Text,
    /// The 0-based lines that break it.
    pub lines: Vec<usize>,
    /// The 0-based lines that it was asked of, whether they keep or break it; those of the native cycle where that answers for it.
    pub about: Vec<usize>,
}

/// What was proven of a program of moves: read back, it is the path.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProofRow {
    /// How many moves of the path it makes, each where and how it should.
    pub moves: usize,
    /// How many of them are touches.
    pub touches: usize,
    /// Whether the program computes the results itself, and the right ones.
    pub arithmetic: bool,
}

impl ProofRow {
    pub(super) fn of(proof: Proof) -> Self {
        ProofRow {
            moves: proof.moves(),
            touches: proof.touches(),
            arithmetic: proof.arithmetic(),
        }
    }
}

/// Where the ball is to touch the nominal part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TouchPoint {
    /// The point that is touched, on the surface.
    pub point: Triple,
    /// Target vector: outward normal of the surface, of length one.
    pub vector: Triple,
    /// Which wall or circle it is on, from 0.
    pub group: usize,
    /// Index of its cycle in a set-up; 0 for a job of one cycle.
    pub cycle: usize,
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
    /// Step of the cycle's documented list, from 1; 0 on the way between two cycles. Where native cycles make it: which line makes it, from that of the first move on.
    pub step: u8,
    /// Index of the touch that it makes or comes back from; null for positioning.
    pub touch: Option<usize>,
    /// The arc it runs along; null is a straight line.
    pub arc: Option<Arc>,
    /// Index of its cycle in a set-up, or of the one that it leads to; 0 for a job of one cycle.
    pub cycle: usize,
}

/// An arc about the tool axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Arc {
    /// Its centre, at the height of the move.
    pub center: Triple,
    /// Degrees, counter-clockwise positive seen against the tool axis; less than a whole turn.
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
    /// Its lines, each ended by a line feed.
    pub text: String,
    /// For each move the 0-based line that makes it; −1 where the native cycle makes it.
    pub move_lines: Vec<i32>,
    /// What it writes, in its own blocks or by the cycle that it calls. Of the work offset: axes in the order `X`, `Y`, `Z`, then `rotation`. Of the active preset: `preset X` …, then
    /// `basic rotation` or `table offset`. Empty where it measures only.
    pub writes: Vec<&'static str>,
    /// What it does with offsets and presets, in one sentence: `writes G54 X Y`, `measures only`.
    pub does: String,
    /// The same as a template and its values.
    pub said: Text,
    /// What was proven of it; null in the form `cycle`.
    pub proof: Option<ProofRow>,
    /// Whether the moves of the plan are those that native cycles make, which the program calls.
    pub own: bool,
}

/// One row of the parameter table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterRow {
    /// `CmdPrm.Flt[-53]`, or `Q1116` for a HEIDENHAIN cycle.
    pub code: String,
    /// The type column of the source.
    #[serde(rename = "type")]
    pub type_name: &'static str,
    /// The value, lengths in the job's units.
    pub value: ParameterValue,
    /// What it means, in English; `meanings(job)` has it for other languages.
    #[serde(serialize_with = "in_english")]
    pub meaning: Text,
    /// Path of the job's field it comes from.
    pub field: Option<String>,
    /// Index of the touch it comes from; null if it concerns the whole cycle.
    pub touch: Option<usize>,
    /// Index of its cycle in a set-up; 0 for a job of one cycle.
    pub cycle: usize,
}

fn in_english<S: Serializer>(text: &Text, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&text.english())
}

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ParameterValue {
    /// A whole number: a count, a mode or the number of something.
    Whole(i32),
    /// Yes or no.
    Flag(bool),
    /// A length in the job's units, an angle in degrees, or a number without a unit.
    Number(f64),
    /// Text, as it was given.
    Text(String),
}

/// A value that the cycle measures: what the control computes, and what it should be.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ResultRow {
    /// A stable name, one of `RESULT_CODES`: `center.x`.
    pub code: String,
    /// What the value is, in English.
    pub meaning: String,
    /// `mm`, `inch` or `deg`; empty for a number without a unit.
    pub unit: &'static str,
    /// Its value on the nominal part; null where that is not known.
    pub nominal: Option<f64>,
    /// What the control computes; null where the triggers cannot give it.
    pub value: Option<f64>,
    /// Value less nominal, or less the middle of the tolerance zone.
    pub deviation: Option<f64>,
    /// One sigma of the value: scatter of the touches, and eccentricity of the ball.
    pub uncertainty: Option<f64>,
    /// How much of it comes from the ball's eccentricity: one sigma of that alone. Null where the job says none, or turns the spindle to the
    /// angle of calibration.
    pub uncertainty_runout: Option<f64>,
    /// Lower and upper limit, where a tolerance is given.
    pub limits: Option<[f64; 2]>,
    /// Good, rework or scrap, where a tolerance is given; implausible, where it is off by more than its limit.
    pub verdict: Option<String>,
    /// The true value on the virtual part, where there is one.
    pub truth: Option<f64>,
    /// Why the value is not the truth, where it is not.
    pub note: Option<String>,
    /// Where the control has it after its own cycles: `#135`. Null of a program of moves, whose header says it.
    pub stored: Option<String>,
    /// Index of its cycle in a set-up, or behind all cycles that of its relation; 0 for a job of one cycle.
    pub cycle: usize,
    /// Its words as templates and their values.
    pub said: ResultWords,
}

impl ResultRow {
    /// The same where the control never comes to store it.
    pub fn without_value(self) -> Self {
        let said = ResultWords {
            verdict: None,
            ..self.said
        };
        ResultRow {
            value: None,
            deviation: None,
            uncertainty: None,
            uncertainty_runout: None,
            verdict: None,
            said,
            ..self
        }
    }
}

/// The words of a result, to be put into other languages.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ResultWords {
    /// What the value is.
    pub meaning: Text,
    /// Good, rework or scrap, where a tolerance is given.
    pub verdict: Option<Text>,
    /// Why the value is not the truth, where it is not.
    pub note: Option<Text>,
}

impl SafetyRow {
    pub(crate) fn of(verdict: Verdict) -> Self {
        SafetyRow {
            rule: verdict.rule,
            holds: verdict.holds,
            message: verdict.message.english(),
            said: verdict.message,
            lines: verdict.lines,
            about: verdict.about,
        }
    }
}

/// Every code that a result may have.
#[rustfmt::skip]
pub const RESULT_CODES: &[&str] = &[
    "center.x", "center.y", "diameter", "residual", "width", "width1", "width2", "rotation", "height",
    "corner.x", "corner.y", "corner.z", "angle", "residual1", "residual2", "point.x", "point.y", "point.z", "deviation",
    "offset.x", "offset.y", "offset.z", "offset.rotation", "distance", "difference", "difference.angle", "mean", "mean.angle", "spread",
    "Q183", "Q950", "Q951", "Q952", "Q953", "Q954", "Q955", "Q964", "Q965", "Q966", "Q967", "Q970", "Q971", "Q973", "Q974",
    "Q980", "Q981", "Q982", "Q983", "Q984", "Q985", "Q994", "Q995", "Q996", "Q997", "form1", "form2",
    "preset.table", "preset.x", "preset.y", "preset.z", "preset.rotation", "table.turn",
];

pub(super) fn result_rows(
    job: &Job,
    path: &Path,
    mut rows: Vec<crate::formula::ResultRow>,
) -> Vec<ResultRow> {
    if let Some(n) = job.work_offset {
        part::write_offset(
            &mut rows,
            &path.formula,
            job.setup.plane,
            &(job.post.work_offset_word)(n),
        );
    }
    let own = path.own.as_ref().zip(job.post.own);
    let stored = |code: &str| {
        let (own, cycles) = own?;
        own.stored
            .iter()
            .find(|(known, _)| *known == code)
            .map(|(_, stored)| (cycles.name)(*stored))
    };
    let note = |row: &crate::formula::ResultRow| {
        let off = row
            .value
            .zip(row.truth)
            .map(|(value, truth)| value - truth)
            .filter(|off| off.abs() > 1e-6)?;
        let reason = job
            .cycle
            .turned_error(&row.code)
            .filter(|_| job.placement.turn != 0.0)?;
        let sign = if off > 0.0 { "+" } else { "" };
        let off = format!("{sign}{} {}", decimal(off / job.scale, 5), job.unit);
        Some(text!("{off} from the truth: {reason}", off, reason))
    };
    rows.into_iter()
        .map(|row| {
            let (note, stored) = (note(&row), stored(&row.code));
            result_row(job, row, note, stored)
        })
        .collect()
}

/// One result, in the job's units.
pub(super) fn result_row(
    job: &Job,
    row: crate::formula::ResultRow,
    note: Option<Text>,
    stored: Option<String>,
) -> ResultRow {
    debug_assert!(
        RESULT_CODES.contains(&&*row.code),
        "{} is no code of RESULT_CODES",
        row.code
    );
    let (scale, unit) = match row.unit {
        Unit::Length => (job.scale, job.unit),
        Unit::Angle => (1.0, "deg"),
        Unit::None => (1.0, ""),
    };
    let convert = |x: Option<f64>| x.filter(|x| x.is_finite()).map(|x| tidy(x / scale));
    ResultRow {
        code: row.code,
        meaning: row.meaning.english(),
        unit,
        nominal: convert(row.nominal),
        value: convert(row.value),
        deviation: convert(row.deviation),
        uncertainty: convert(row.uncertainty),
        uncertainty_runout: convert(row.uncertainty_runout),
        limits: row
            .limits
            .map(|(low, high)| [low, high].map(|x| tidy(x / scale))),
        verdict: row.verdict.as_ref().map(Text::english),
        truth: convert(row.truth),
        note: note.as_ref().map(Text::english),
        stored,
        cycle: 0,
        said: ResultWords {
            meaning: row.meaning,
            verdict: row.verdict,
            note,
        },
    }
}

pub(super) fn move_row(job: &Job, feeds: &Feeds, step: &path::Move) -> Move {
    let (kind, touch) = match step.purpose {
        Purpose::Position => ("position", None),
        Purpose::Touch(k) | Purpose::Search(k) => ("touch", Some(k)),
        Purpose::Back(k) => ("back", Some(k)),
    };
    let feed = match step.feed {
        feed if feeds.is_rapid(feed) => "rapid",
        Feed::Rapid => "rapid",
        Feed::Approach => "approach",
        Feed::LongLink => "longLink",
        Feed::Work | Feed::Search => "work",
        Feed::Retract => "retract",
        Feed::Return => "return",
    };
    let arc = step.arc.map(|arc| Arc {
        center: triple(arc.center, job.scale),
        sweep: tidy(arc.sweep.to_degrees()),
    });
    Move {
        to: triple(step.to, job.scale),
        feed,
        kind,
        step: step.step,
        touch,
        arc,
        cycle: 0,
    }
}

pub(super) fn parameter_row(job: &Job, parameter: path::Parameter) -> ParameterRow {
    ParameterRow {
        code: match parameter.accessor {
            Accessor::Q => format!("Q{}", parameter.code),
            accessor => format!("CmdPrm.{}[{}]", accessor.word(), parameter.code),
        },
        type_name: parameter.type_name,
        value: match parameter.value {
            path::ParameterValue::Length(mm) => ParameterValue::Number(tidy(mm / job.scale)),
            path::ParameterValue::Number(x) => ParameterValue::Number(tidy(x)),
            path::ParameterValue::Whole(n) => ParameterValue::Whole(n),
            path::ParameterValue::Flag(on) => ParameterValue::Flag(on),
            path::ParameterValue::Text(text) => ParameterValue::Text(text),
            path::ParameterValue::Word(word) => ParameterValue::Text(word.to_owned()),
        },
        meaning: parameter.meaning,
        field: parameter.field,
        touch: parameter.touch,
        cycle: 0,
    }
}

pub(super) fn triple(v: Vec3, scale: f64) -> Triple {
    v.to_array().map(|x| tidy(x / scale))
}
