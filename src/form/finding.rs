//! Findings: what is wrong, unusual or worth knowing about a job, as data.

use serde::Serialize;

use crate::form::codes::is_listed;
use crate::text::Text;

/// How much a finding weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// No plan is made.
    Error,
    /// A plan is made; look at it before use.
    Warning,
    /// A plan is made; nothing needs to be changed.
    Info,
}

/// A problem, or something worth knowing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Whether it keeps the job from being planned.
    pub level: Level,
    /// A stable, kebab-case name for programs to switch on, one of [`CODES`](crate::form::CODES).
    pub code: String,
    /// The place in the job: `cycle.sideClearance1`, `feeds.work`; empty for the job as a whole.
    pub path: String,
    /// Plain words for a person, with numbers in the job's units.
    pub message: String,
    /// The message as a template and its values: with a list of words it can be said in another language.
    pub said: Text,
}

impl Finding {
    /// Its English `message` is made from `said`.
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
