//! Joins the layers: a job in, a plan out. This is what a Rust user calls.
//!
//! ```
//! let job = touchpath::job::from_json(r#"{ "format": 1, "cycle": { "type": "internal-rectangle-protected" } }"#)?;
//! let plan = touchpath::job::plan(&job)?;
//! assert_eq!(plan.touches.len(), 4);
//! # Ok::<(), touchpath::job::JobError>(())
//! ```

mod calls;
mod corrections;
mod cycles;
mod datum;
mod defaults;
mod dependencies;
mod examine;
mod inertia;
mod judge;
mod lentoax;
mod measure;
#[cfg(any(test, target_arch = "wasm32"))]
mod misfit;
mod naming;
#[cfg(any(test, target_arch = "wasm32"))]
mod number_field;
mod picture;
mod plan;
mod planned;
#[cfg(any(test, target_arch = "wasm32"))]
mod proposed_stock;
mod relations;
mod rows;
mod sections;
mod set_up;
mod sized;
mod stock;
mod stylus;
mod tolerances;
mod units;
mod wear;

pub use calls::calls;
pub use defaults::{default_job, new_job};
pub use lentoax::lentoax_query;
pub use measure::Measurement;
pub use naming::job_name;
pub use picture::svg;
pub use rows::{
    Arc, DatumRow, Move, ParameterRow, ParameterValue, Plan, ProgramText, ProofRow, RESULT_CODES,
    ResultRow, ResultWords, SafetyRow, TouchPoint, Triple,
};
pub use sections::{FORMAT, Units};
pub use units::convert_units;

/// Viewing direction of a picture.
pub use crate::view::scene::Projection;

pub(crate) use cycles::{
    CLEAR, DATUM, LONGEST_NAME, MOST_CYCLES, RELATIONS, SET_UP_FORMAT, is_set_up, single_cycle_job,
};
pub(crate) use defaults::{default_job_in, resolved, section_defaults_in, typed_in_inch};
pub(crate) use dependencies::LONGEST_PLACE;
pub(crate) use examine::check_program;
#[cfg(test)]
pub(crate) use examine::{proves, released};
pub(crate) use lentoax::{MOST_STEPS, STEP_ANGLE};
#[cfg(target_arch = "wasm32")]
pub(crate) use measure::points;
#[cfg(target_arch = "wasm32")]
pub(crate) use misfit::form_problem;
#[cfg(target_arch = "wasm32")]
pub(crate) use number_field::{NumberField, with_number};
#[cfg(target_arch = "wasm32")]
pub(crate) use picture::Picture;
#[cfg(any(test, target_arch = "wasm32"))]
pub(crate) use plan::minutes;
pub(crate) use plan::{plan_with_path, planned, writes_any};
pub(crate) use planned::PlannedJob;
#[cfg(any(test, target_arch = "wasm32"))]
pub(crate) use proposed_stock::proposed_stock;
pub(crate) use sections::{Job, SECTIONS, STOCK, TOLERANCES, UNITS, section, size_reach};
#[cfg(target_arch = "wasm32")]
pub(crate) use units::known_units;
pub(crate) use wear::WEAR;

/// For `npm run bench` and the fuzzer. Not part of the stable interface.
#[doc(hidden)]
pub use examine::{reads_same_with_cache, stages};

use crate::form::{Checker, Finding, Value};

/// Longest text that is read, in UTF-16 units. Longer texts are refused: a truncated program is a different program.
pub const LONGEST_TEXT: usize = 2_000_000;

/// Longest program whose moves are read, in UTF-16 units.
pub const LONGEST_PROGRAM: usize = 20_000_000;

/// A job without a plan, with all its findings.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}", first_error(.findings))]
pub struct JobError {
    /// All findings: errors and the rest.
    pub findings: Vec<Finding>,
}

fn first_error(findings: &[Finding]) -> String {
    let errors: Vec<&Finding> = findings
        .iter()
        .filter(|f| f.level == crate::form::Level::Error)
        .collect();
    match errors.as_slice() {
        [] => "the job has no error".to_owned(),
        [one] => one.message.clone(),
        [first, rest @ ..] => format!("{} (and {} more)", first.message, rest.len()),
    }
}

/// All findings of a job: errors, warnings and notes.
pub fn check(value: &Value) -> Vec<Finding> {
    match plan_with_path(value) {
        Ok((_, plan)) => plan.findings,
        Err(error) => error.findings,
    }
}

/// The whole plan of a job, in the job's units.
pub fn plan(value: &Value) -> Result<Plan, JobError> {
    let (planned, mut plan) = plan_with_path(value)?;
    plan.table = planned.table();
    Ok(plan)
}

/// Results from values measured on a real machine: those of [`measure`], without its other answers.
pub fn evaluate(value: &Value, measured: &Value) -> Result<Vec<ResultRow>, JobError> {
    measure(value, measured).map(|measurement| measurement.results)
}

/// Results from values measured on a real machine: a list of ball centres `[X, Y, Z]`, one for each touch, in the job's units; or a text. A text contains
/// - one point a line, X, Y, Z, or LinuxCNC's PROBEOPEN log;
/// - or results as programs print them, one `center.x=1.2345` a line;
/// - or the log of a sender with grbl's `[PRB:…]`, and the work offset.
pub fn measure(value: &Value, measured: &Value) -> Result<Measurement, JobError> {
    let mut checker = Checker::default();
    let Some(planned) = plan::read(&mut checker, value) else {
        return Err(JobError {
            findings: checker.findings(),
        });
    };
    measure::of(&planned, measured, checker)
}

/// A loose job from JSON text.
pub fn from_json(text: &str) -> Result<Value, JobError> {
    match serde_json::from_str::<serde_json::Value>(text) {
        Ok(json) => Ok(Value::from(&json)),
        Err(error) => {
            let finding = Finding::new(
                crate::form::Level::Error,
                "not-json",
                "",
                crate::text::text!("This is not JSON: {error}", error.to_string()),
            );
            Err(JobError {
                findings: vec![finding],
            })
        }
    }
}
