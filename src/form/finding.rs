//! Findings as data: errors, warnings and notes about a job.

use serde::Serialize;

use crate::form::codes::is_listed;
use crate::text::Text;

/// Weight of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// Prevents a plan.
    Error,
    /// Allows a plan that should be looked at before use.
    Warning,
    /// Allows a plan; nothing needs to be changed.
    Info,
}

/// An error, warning or note.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Weight; an error prevents the plan.
    pub level: Level,
    /// A stable, kebab-case name for programs to switch on, one of [`CODES`](crate::form::CODES).
    pub code: String,
    /// Position in the job: `cycle.sideClearance1`, `feeds.work`; empty for the whole job.
    pub path: String,
    /// Message in plain words, with numbers in the units of the job.
    pub message: String,
    /// The message as a template and its values: with a list of words it can be translated.
    pub said: Text,
}

impl Finding {
    /// Creates a finding. Its English `message` is made from `said`.
    pub fn new(level: Level, code: &str, path: impl Into<String>, said: Text) -> Self {
        debug_assert!(is_listed(code), "the code {code} stands in form/codes.rs");
        Finding {
            level,
            code: code.to_owned(),
            path: path.into(),
            message: said.english(),
            said,
        }
    }
}
