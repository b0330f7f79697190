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
use crate::job::{self, JobError, Plan, Planned, Units};
use crate::text::{Part, Text, words};

/// The rules of a portal. Its own lengths are in its `units`; jobs may be in others.
#[derive(Debug)]
pub struct Config {
    /// Who asks, as findings call it.
    title: Option<String>,
    units: Units,
    allow: Allow,
    rules: Vec<Rule>,
    space: Space,
    /// What the portal itself has to say of the job.
    own: Vec<Finding>,
}

/// What is asked of one field.
#[derive(Debug)]
struct Rule {
    /// Its path in a job of one cycle.
    path: String,
    /// The value of a job that leaves the field out.
    value: Option<Value>,
    /// Whether it must have that value.
    locked: bool,
    /// What it must lie between, in the config's units.
    least: Option<f64>,
    most: Option<f64>,
    /// The reason in the portal's words; may be empty.
    reason: String,
}

impl Config {
    /// Reads a config.
    ///
    /// # Errors
    ///
    /// Everything that is wrong with it; the paths of the findings begin with `config.`.
    pub fn read(value: &Value) -> Result<Config, JobError> {
        read::read(value)
    }

    /// Fills in what the job leaves out: the values of the config's fields, and the first choice that is allowed where the default is not.
    pub fn fill(&self, job: &Value) -> Value {
        fill::fill(self, job)
    }

    /// What the config refuses of a job that was filled in, and what the portal says itself. What is wrong with the job is left to the check.
    pub fn judge(&self, job: &Value) -> Vec<Finding> {
        self.judge_planned(job, job::planned(job).as_ref())
    }

    /// The same, where the path is known; without one only what the job says is judged.
    pub(crate) fn judge_planned(&self, job: &Value, planned: Option<&Planned>) -> Vec<Finding> {
        judge::judge(self, job, planned)
    }

    /// Everything that is wrong, unusual or worth knowing about a job under this config. The job is filled in first.
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
    /// All findings, where the job has an error or the config refuses it.
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

    /// Who asks, at the head of a sentence.
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
