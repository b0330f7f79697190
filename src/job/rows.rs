//! Answers: a plan as plain rows, in the job's units.

use serde::{Serialize, Serializer};

use crate::control::prove::Proof;
use crate::control::safety::Verdict;
use crate::form::Finding;
use crate::formula::Unit;
use crate::geom::Vec3;
use crate::job::Job;
use crate::num::{decimal, tidy};
use crate::part;
use crate::path::{self, Accessor, Feed, Feeds, MovePurpose, Path};
use crate::text::{Text, text};

/// X, Y, Z in the work coordinate system: a point in the job's units, or a unit vector.
pub type Triple = [f64; 3];

/// The plan of a job. Lengths in the job's units, angles in degrees.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Plan {
    /// Nominal touches, on the surface.
    pub touches: Vec<TouchPoint>,
    /// Moves of the ball centre.
    pub moves: Vec<Move>,
    /// Names of the cycles of a set-up, in order; empty for a job with one cycle.
    pub cycles: Vec<String>,
    /// Names of the relations of a set-up, in order.
    pub relations: Vec<String>,
    /// For a set-up, the possible sources of each axis of a work offset and its rotation, and the used ones; empty for a job with one cycle.
    pub datum: Vec<DatumRow>,
    /// Length of the whole path: from the start in the job, else from the end of the first move.
    pub length: f64,
    /// Time of the path, minutes. Rapids run at 5000 mm/min, or at the feed that the control's program states for them.
    pub time: f64,
    /// The program for the control of the job.
    pub program: ProgramText,
    /// Parameters of the cycle with the numbers of its source.
    pub table: Vec<ParameterRow>,
    /// Results that the control will store on the virtual part.
    pub results: Vec<ResultRow>,
    /// Ball centre at the trigger of each touch on the virtual part; null without a contact within the search.
    pub triggers: Vec<Option<Triple>>,
    /// Warnings and notes; with an error there is no plan.
    pub findings: Vec<Finding>,
    /// Whether the program keeps each safety rule.
    pub safety: Vec<SafetyRow>,
}

/// Sources of an axis of a work offset, or of its rotation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DatumRow {
    /// `x`, `y`, `z` or `rotation`: abscissa, ordinate, tool axis.
    pub axis: &'static str,
    /// Result for the work offset, for example `BORE.center.x`, also if no offset is chosen yet. Null if no result can be written.
    pub from: Option<String>,
    /// Every possible result.
    pub choices: Vec<String>,
}

/// Verdict of a safety rule.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SafetyRow {
    /// The name of the rule.
    pub rule: &'static str,
    /// Null if this control cannot guarantee it, or its native cycle is responsible for it.
    pub holds: Option<bool>,
    /// The requirement, the fault, or the reason why the control cannot guarantee it.
    pub message: String,
    /// `message` as a template and its values.
    pub said: Text,
    /// The 0-based lines that break it.
    pub lines: Vec<usize>,
    /// The 0-based lines that the rule concerns, whether they keep or break it; those of the native cycle if that is responsible for it.
    pub about: Vec<usize>,
}

/// Proof of a program of moves: read back, it is the path.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProofRow {
    /// Number of moves of the path that the program makes, each with the right position, kind and feed.
    pub moves: usize,
    /// Number of touches among them.
    pub touches: usize,
    /// Whether the program computes the results, and they are right.
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

/// A touch of the nominal part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TouchPoint {
    /// Touched point, on the surface.
    pub point: Triple,
    /// Target vector: unit outward normal of the surface.
    pub vector: Triple,
    /// Index of the touched surface, from 0.
    pub group: usize,
    /// Index of its cycle in a set-up; 0 for a job of one cycle.
    pub cycle: usize,
}

/// One move of the ball centre.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Move {
    /// End of the move; of a touch its nominal contact.
    pub to: Triple,
    /// `approach`, `longLink`, `work`, `retract`, `return` or `rapid`.
    pub feed: &'static str,
    /// `position`, `touch` or `back`.
    pub kind: &'static str,
    /// Step in the cycle's documented list, from 1; 0 for a link move between two cycles. With native cycles: the line that makes it, counted from that of the
    /// first move.
    pub step: u8,
    /// Index of its touch, for touches and retracts; null for positioning.
    pub touch: Option<usize>,
    /// The arc of the move; null is a straight line.
    pub arc: Option<Arc>,
    /// Index of its cycle in a set-up, or of the cycle that a link move leads to; 0 for a job with one cycle.
    pub cycle: usize,
}

/// An arc about the tool axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Arc {
    /// Centre, at the height of the move.
    pub center: Triple,
    /// Sweep in degrees, counter-clockwise positive seen against the tool axis; less than a whole turn.
    pub sweep: f64,
}

/// The program as text.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ProgramText {
    /// Id of the control.
    pub post: &'static str,
    /// The usual file extension, without the dot.
    pub extension: &'static str,
    /// Lines, each ended by a line feed.
    pub text: String,
    /// The 0-based line of each move; −1 if the native cycle makes it.
    pub move_lines: Vec<i32>,
    /// Values that the program writes, in its own blocks or by the called cycle. For the work offset: axes in the order `X`, `Y`, `Z`, then `rotation`. For the
    /// active preset: `preset X` …, then `basic rotation` or `table offset`. Empty if it only measures.
    pub writes: Vec<&'static str>,
    /// Summary of its writes to offsets and presets, in one sentence: `writes G54 X Y`, `measures only`.
    pub does: String,
    /// `does` as a template and its values.
    pub said: Text,
    /// Proof of the program; null in the form `cycle`.
    pub proof: Option<ProofRow>,
    /// Whether the moves of the plan are those of native cycles that the program calls.
    pub own: bool,
}

/// One row of the parameter table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterRow {
    /// `CmdPrm.Flt[-53]`, or `Q1116` for a HEIDENHAIN cycle.
    pub code: String,
    /// Entry in the type column of the source.
    #[serde(rename = "type")]
    pub type_name: &'static str,
    /// Value; lengths in the job's units.
    pub value: ParameterValue,
    /// Meaning in English; `meanings(job)` has it for other languages.
    #[serde(serialize_with = "in_english")]
    pub meaning: Text,
    /// Path of the job field that gives the value.
    pub field: Option<String>,
    /// Index of the touch that gives the value; null if it concerns the whole cycle.
    pub touch: Option<usize>,
    /// Index of its cycle in a set-up; 0 for a job with one cycle.
    pub cycle: usize,
}

fn in_english<S: Serializer>(text: &Text, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&text.english())
}

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ParameterValue {
    /// A whole number: a count, a mode or a number of something.
    Whole(i32),
    /// Yes or no.
    Flag(bool),
    /// A length in the job's units, an angle in degrees, or a plain number.
    Number(f64),
    /// Text, as it was given.
    Text(String),
}

/// A measured value: computed by the control, with its nominal value.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ResultRow {
    /// A stable name, one of `RESULT_CODES`: `center.x`.
    pub code: String,
    /// Description of the value in English.
    pub meaning: String,
    /// `mm`, `inch` or `deg`; empty for a number without a unit.
    pub unit: &'static str,
    /// Value on the nominal part; null if it is unknown.
    pub nominal: Option<f64>,
    /// Value that the control computes; null if the triggers cannot give it.
    pub value: Option<f64>,
    /// Value minus nominal, or minus the middle of the tolerance.
    pub deviation: Option<f64>,
    /// Standard uncertainty of the value (one sigma): scatter of the touches, and eccentricity of the ball.
    pub uncertainty: Option<f64>,
    /// Part of the uncertainty that comes from the eccentricity of the ball (one sigma). Null if the job gives no eccentricity, or orients the spindle to the angle of
    /// calibration.
    pub uncertainty_runout: Option<f64>,
    /// Lower and upper limit, if there is a tolerance.
    pub limits: Option<[f64; 2]>,
    /// Good, rework or scrap, if there is a tolerance; implausible beyond the limit.
    pub verdict: Option<String>,
    /// True value on the virtual part, if there is one.
    pub truth: Option<f64>,
    /// Reason why the value differs from the true value, if it does.
    pub note: Option<String>,
    /// Storage in the control after its native cycles: `#135`. Null for a program of moves, whose header lists it.
    pub stored: Option<String>,
    /// Index of its cycle in a set-up, or, after all cycles, of its relation; 0 for a job with one cycle.
    pub cycle: usize,
    /// Its texts as templates and their values.
    pub said: ResultWords,
}

impl ResultRow {
    /// The row of a result that the control never stores.
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

/// Texts of a result, for translation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ResultWords {
    /// Description of the value.
    pub meaning: Text,
    /// Good, rework or scrap, if there is a tolerance.
    pub verdict: Option<Text>,
    /// Reason why the value differs from the true value, if it does.
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

/// All codes of results.
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
    let own = path.calls.as_ref().zip(job.post.own);
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
        MovePurpose::Position => ("position", None),
        MovePurpose::Touch(k) | MovePurpose::Search(k) => ("touch", Some(k)),
        MovePurpose::Retract(k) => ("back", Some(k)),
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
