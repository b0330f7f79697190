//! What a portal allows: which cycles, controls, units and work offsets its users may choose, which fields are fixed, hidden or filled in, where the
//! machine can travel. A job is filled in and judged by it; what a rule refuses is a finding with its reason.
//!
//! ```
//! use touchpath::config::Config;
//! use touchpath::job::from_json;
//!
//! let config = Config::read(&from_json(r#"{
//!     "format": 1,
//!     "title": "Hall 3",
//!     "allow": { "controls": ["fanuc"] },
//!     "fields": { "feeds.work": { "value": 100, "locked": true, "reason": "the probe was calibrated at it" } }
//! }"#)?)?;
//! let plan = config.plan(&from_json(r#"{ "format": 1, "cycle": { "type": "hole" } }"#)?)?;
//! assert_eq!(plan.program.post, "fanuc");
//! let faster = from_json(r#"{ "format": 1, "cycle": { "type": "hole" }, "feeds": { "work": 300 } }"#)?;
//! let error = config.plan(&faster).unwrap_err();
//! let refused = error.findings.iter().find(|finding| finding.code == "locked").expect("another feed");
//! assert_eq!(refused.message, "Hall 3 fixes Work feed at 100 mm/min: the probe was calibrated at it");
//! # Ok::<(), touchpath::job::JobError>(())
//! ```

mod allow;
mod fill;
mod judge;
mod list;
mod read;
mod space;

use crate::config::allow::Allow;
use crate::config::space::Space;
use crate::form::{Field, Finding, Level, Value};
use crate::job::{self, JobError, Plan, PlannedJob, Units};
use crate::text::{Part, Text, words};

/// Rules of a portal. Its lengths are in its own `units`; jobs may be in others.
#[derive(Debug)]
pub struct Config {
    /// Name of the portal, as in findings.
    title: Option<String>,
    units: Units,
    allow: Allow,
    rules: Vec<Rule>,
    space: Space,
    /// Findings that the portal itself adds to a job.
    own: Vec<Finding>,
}

/// Rule for one field.
#[derive(Debug)]
struct Rule {
    /// Path of the field in a job with one cycle.
    path: String,
    /// Value of a job that leaves the field out.
    value: Option<Value>,
    /// Whether the field must have that value.
    locked: bool,
    /// Lower limit, in the config's units.
    least: Option<f64>,
    most: Option<f64>,
    /// Reason in the portal's words; may be empty.
    reason: String,
}

impl Config {
    /// Reads a config.
    ///
    /// # Errors
    ///
    /// All problems of the config; the paths of the findings begin with `config.`.
    pub fn read(value: &Value) -> Result<Config, JobError> {
        read::read(value)
    }

    /// Fills in the values that the job leaves out: those of the config's fields, and the first allowed choice if the default is not allowed.
    pub fn fill(&self, job: &Value) -> Value {
        fill::fill(self, job)
    }

    /// Refusals of a job that was filled in, and the portal's own findings. Faults of the job itself are left to the check.
    pub fn judge(&self, job: &Value) -> Vec<Finding> {
        self.judge_planned(job, job::planned(job).as_ref())
    }

    /// Refusals of a job with a known path; without one only the values of the job are judged.
    pub(crate) fn judge_planned(&self, job: &Value, planned: Option<&PlannedJob>) -> Vec<Finding> {
        judge::judge(self, job, planned)
    }

    /// All findings of a job under this config. The job is filled in first.
    pub fn check(&self, job: &Value) -> Vec<Finding> {
        let job = self.fill(job);
        let mut findings = job::check(&job);
        findings.extend(self.judge(&job));
        findings
    }

    /// The plan of a job under this config. The job is filled in first.
    ///
    /// # Errors
    ///
    /// All findings, if the job has an error or the config refuses it.
    pub fn plan(&self, job: &Value) -> Result<Plan, JobError> {
        let job = self.fill(job);
        let judged = self.judge(&job);
        match job::plan(&job) {
            Ok(mut plan) => {
                plan.findings.extend(judged);
                let refused = plan
                    .findings
                    .iter()
                    .any(|finding| finding.level == Level::Error);
                if refused {
                    Err(JobError {
                        findings: plan.findings,
                    })
                } else {
                    Ok(plan)
                }
            }
            Err(mut error) => {
                error.findings.extend(judged);
                Err(error)
            }
        }
    }

    /// Name of the portal at the start of a sentence.
    fn who(&self) -> Part {
        match &self.title {
            Some(title) => title.clone().into(),
            None => Text::words(words!("This portal")).into(),
        }
    }
}

/// The field at a path of a job with one cycle of this type: `feeds.work`, `cycle.depth`, `cycle.probe.dist`.
fn field_at(path: &str, def: &'static crate::cycle::CycleDef) -> Option<&'static Field> {
    let (section, key) = path.rsplit_once('.').unwrap_or(("", path));
    let fields = match section.strip_prefix("cycle") {
        Some("") => def.fields,
        Some(inner) => {
            def.sections
                .iter()
                .find(|form| inner.strip_prefix('.') == Some(form.key))?
                .fields
        }
        None => job::section(section)?.fields,
    };
    fields.iter().find(|field| field.key == key)
}

/// The value at a path of a loose job.
fn at<'v>(job: &'v Value, path: &str) -> Option<&'v Value> {
    path.split('.').try_fold(job, |place, key| place.get(key))
}
