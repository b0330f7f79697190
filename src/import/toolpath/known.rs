//! Inputs of a run beyond the text of a program, and the values that it asks for.

use std::rc::Rc;

use crate::form::{Checker, Level, Value, printable};
use crate::geom::Vec3;
use crate::import::toolpath::{DIALECTS, PROGRAM_POSTS};
use crate::job::{FORMAT, JobError, PlannedJob};
#[cfg(target_arch = "wasm32")]
use crate::job::{Picture, Projection};
use crate::text::{text, words};

/// Trigger of a probing move, as a fraction of its length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum TriggerAt {
    /// Unknown.
    #[default]
    Unknown,
    /// At this fraction, 0 to 1.
    At(f64),
    /// No contact: the move reaches its end.
    Never,
}

/// The virtual part of a job, as an obstacle for probing moves.
#[derive(Clone, Debug)]
pub struct Feature(Rc<PlannedJob>);

impl Feature {
    /// The part of a job; `None` for a job with errors.
    pub fn of(job: &Value) -> Option<Self> {
        crate::job::planned(job).map(|planned| Feature(Rc::new(planned)))
    }

    /// Its picture, nominal and displaced.
    #[cfg(target_arch = "wasm32")]
    pub fn picture(&self, view: Projection) -> Picture {
        self.0.picture(view, 1.0, None)
    }

    /// Whether it is displaced, or has other sizes than the nominal part.
    #[cfg(target_arch = "wasm32")]
    pub fn deviates(&self) -> bool {
        !self.0.job.placement.nominal
    }

    /// The radius of the job's ball, mm.
    pub(super) fn radius(&self) -> f64 {
        self.0.job.setup.radius
    }

    /// Fraction of a straight move, in mm, at which the job's ball contacts it.
    pub(super) fn contact(&self, from: Vec3, to: Vec3) -> Option<f64> {
        let PlannedJob {
            job,
            path,
            surfaces,
            ..
        } = &*self.0;
        crate::part::first_contact(surfaces, path.frame.w, job.setup.radius, from, to)
    }
}

/// Inputs of a run.
#[derive(Clone, Debug, Default)]
pub struct RunInputs<'t> {
    /// One of [`super::DIALECTS`]; `None` recognises it from the text.
    pub dialect: Option<&'static str>,
    /// The control, one of [`super::PROGRAM_POSTS`]; `None` recognises it from the text.
    pub post: Option<&'static str>,
    /// Whether every work offset, shift and tool length that was never set is 0; else they are unknown.
    pub zero: bool,
    /// Values of variables, by their names in the text: `#3014`, `#<_name>`, `R1`, `Q1`.
    pub set: Vec<(&'t str, f64)>,
    /// Position of the stylus before the first block, in the program's first units; NaN is unknown.
    pub start: Option<[f64; 3]>,
    /// Trigger of touches.
    pub touch: TriggerAt,
    /// Trigger of watched positioning moves.
    pub positioning: TriggerAt,
    /// Part that probing moves contact; replaces both triggers.
    pub feature: Option<Feature>,
    /// Texts with subprograms, by their names.
    pub files: Vec<(&'t str, &'t str)>,
}

/// A value that a program reads without setting it.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct UnsetVariable {
    /// Its name in the text: `#3014`, `#<_name>`, `R1`.
    pub name: String,
    /// The 0-based lines that read it.
    pub lines: Vec<u32>,
}

impl<'t> RunInputs<'t> {
    /// Reads the inputs of a caller: an object with `dialect`, `set`, `start`, `part` and `files`, all optional.
    pub fn of(value: &'t Value) -> Result<Self, JobError> {
        let mut checker = Checker::default();
        let mut known = RunInputs::default();
        checker.whole = words!("the inputs of a program");
        let given = Some(value).filter(|value| !is_unset(value));
        let entries = checker.object(given, "").unwrap_or_default();
        for (key, value) in entries {
            match (key.as_str(), value) {
                (_, value) if is_unset(value) => {}
                ("dialect", name) => {
                    known.dialect = one_of(&DIALECTS, name, |list| {
                        let message = text!("The dialect must be one of {list}", list);
                        checker.error("unknown-value", "dialect", message);
                    });
                }
                ("post", name) => {
                    known.post = one_of(&PROGRAM_POSTS, name, |list| {
                        let message = text!("The control must be one of {list}", list);
                        checker.error("unknown-value", "post", message);
                    });
                }
                ("offsets", Value::Number(0.0)) => known.zero = true,
                ("offsets", _) => {
                    checker.error(
                        "out-of-range",
                        "offsets",
                        text!("offsets can only be 0: others are given by their variables, in set"),
                    );
                }
                ("set", set) => known.set = numbers(set, &mut checker),
                ("start", place) => known.start = start(place, &mut checker),
                ("part", job) if job.get("cycle").is_some() => {
                    known.feature = feature(job, &mut checker)
                }
                ("part", value) if value.get("cycles").is_some() => {
                    let message = text!(
                        "The part of a run is a job with one cycle: where the walls and top sides of several features end is not known"
                    );
                    checker.error("set-up-unsupported", "part.cycles", message);
                }
                ("part", value) => {
                    checker.object(Some(value), "part");
                    known.touch = trip(value.get("at"), "part.at", &mut checker);
                    known.positioning =
                        trip(value.get("positioning"), "part.positioning", &mut checker);
                }
                ("files", files) => known.files = texts(files, &mut checker),
                _ => {
                    let message = text!("{path} is unknown", printable(key));
                    checker.error("unknown-key", printable(key), message);
                }
            }
        }
        if checker.failed() {
            Err(JobError {
                findings: checker.findings(),
            })
        } else {
            Ok(known)
        }
    }
}

/// Whether an input is omitted.
fn is_unset(value: &Value) -> bool {
    matches!(value, Value::Null | Value::Other("undefined"))
}

/// The word of a list that a value contains. Reports the list if it contains another one.
fn one_of(
    list: &[&'static str],
    given: &Value,
    report: impl FnOnce(String),
) -> Option<&'static str> {
    let found = list
        .iter()
        .find(|word| matches!(given, Value::Text(name) if name == *word));
    if found.is_none() {
        report(list.join(", "));
    }
    found.copied()
}

/// The part of a job, which need not give its format.
fn feature(job: &Value, checker: &mut Checker) -> Option<Feature> {
    let mut job = job.clone();
    if let Value::Map(entries) = &mut job
        && entries.iter().all(|(key, _)| key != "format")
    {
        entries.push(("format".to_owned(), Value::Number(FORMAT)));
    }
    let feature = Feature::of(&job);
    if feature.is_none() {
        let errors = crate::job::check(&job)
            .into_iter()
            .filter(|finding| finding.level == Level::Error);
        errors.for_each(|finding| {
            checker.error(
                &finding.code,
                format!("part.{}", finding.path),
                finding.said,
            )
        });
    }
    feature
}

/// Three numbers, or null for unknown ones.
fn start(value: &Value, checker: &mut Checker) -> Option<[f64; 3]> {
    let axis = |value: &Value| match value {
        Value::Number(x) if x.is_finite() => Some(*x),
        Value::Null => Some(f64::NAN),
        _ => None,
    };
    let place = match value {
        Value::List(place) => place.iter().map(axis).collect::<Option<Vec<f64>>>(),
        _ => None,
    };
    let place = place.and_then(|place| <[f64; 3]>::try_from(place).ok());
    if place.is_none() {
        checker.error(
            "wrong-type",
            "start",
            text!("start must be three numbers, or null where it is unknown"),
        );
    }
    place
}

/// Values of variables by their names.
fn numbers<'t>(given: &'t Value, checker: &mut Checker) -> Vec<(&'t str, f64)> {
    let mut set = Vec::new();
    for (name, value) in checker.object(Some(given), "set").unwrap_or_default() {
        let path = format!("set.{}", printable(name));
        match value {
            Value::Number(x) if x.is_finite() && is_variable(name) => set.push((name.trim(), *x)),
            Value::Number(x) if x.is_finite() => {
                let message = text!(
                    "{name} is no variable: write #5, R1, Q1, or its name as in the program",
                    printable(name)
                );
                checker.error("unknown-value", path, message);
            }
            other => checker.error(
                "not-a-number",
                path,
                text!(
                    "{path} must be a number, not {given}",
                    printable(name),
                    other.noun()
                ),
            ),
        }
    }
    set
}

/// `#5`, `#<name>`, `R1`, `QL3`, a name.
fn is_variable(name: &str) -> bool {
    let name = name.trim();
    match name.strip_prefix('#') {
        Some(rest) => {
            rest.starts_with('<') && rest.ends_with('>')
                || !rest.is_empty() && rest.bytes().all(|b| b.is_ascii_digit())
        }
        None => name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_' || c == '$'),
    }
}

fn texts<'t>(given: &'t Value, checker: &mut Checker) -> Vec<(&'t str, &'t str)> {
    let entries = checker.object(Some(given), "files").unwrap_or_default();
    let mut files = Vec::new();
    for (name, value) in entries {
        let text = checker.text(value, &format!("files.{}", printable(name)));
        files.extend(text.map(|text| (name.as_str(), text)));
    }
    files
}

/// A fraction of a move; null: no contact; left out: unknown.
fn trip(value: Option<&Value>, path: &str, checker: &mut Checker) -> TriggerAt {
    match value {
        None | Some(Value::Other("undefined")) => TriggerAt::Unknown,
        Some(Value::Null) => TriggerAt::Never,
        Some(Value::Number(part)) if (0.0..=1.0).contains(part) => TriggerAt::At(*part),
        Some(_) => {
            checker.error(
                "out-of-range",
                path,
                text!(
                    "{path} must be from 0 to 1, the fraction of the way, or null for no contact",
                    path.to_owned()
                ),
            );
            TriggerAt::Unknown
        }
    }
}

/// Former name of [`RunInputs`].
#[deprecated(since = "0.3.0", note = "use `RunInputs`")]
pub type Known<'t> = RunInputs<'t>;

/// Former name of [`TriggerAt`].
#[deprecated(since = "0.3.0", note = "use `TriggerAt`")]
pub type Trip = TriggerAt;

/// Former name of [`UnsetVariable`].
#[deprecated(since = "0.3.0", note = "use `UnsetVariable`")]
pub type Ask = UnsetVariable;
