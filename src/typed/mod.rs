//! A job with types: every field may be left out, and has the catalog's default then.
//!
//! ```
//! use touchpath::typed::{Control, Hole, Job, Post};
//!
//! let job = Job {
//!     cycle: Hole { diameter: Some(40.0), depth: Some(8.0), ..Hole::default() }.into(),
//!     control: Some(Control { post: Some(Post::Fanuc), work_offset: Some(Some(1)), ..Control::default() }),
//!     ..Job::default()
//! };
//! let plan = touchpath::job::plan(&job.into())?;
//! assert_eq!(plan.program.writes, ["X", "Y"]);
//! # Ok::<(), touchpath::job::JobError>(())
//! ```
//!
//! Lengths are in the job's units, feeds in units a minute, angles in degrees, counter-clockwise positive. `Some(None)` is `null`: what that means
//! is written at the field. A wrong number is found by [`job::check`](crate::job::check), as in a job from JSON.

#[rustfmt::skip]
mod forms;

pub use forms::*;

use std::collections::BTreeMap;

use crate::form::Value;

/// A number, or text: `10H7`, `10m`, `10+0.01-0.015`, `?`, `?10`, `10@10.02`.
#[derive(Clone, Debug, PartialEq)]
pub enum Nominal {
    /// A length in the job's units.
    Number(f64),
    /// A length with its tolerance, or one that the operator finds.
    Text(String),
}

impl From<f64> for Nominal {
    fn from(x: f64) -> Self {
        Nominal::Number(x)
    }
}

impl From<&str> for Nominal {
    fn from(text: &str) -> Self {
        Nominal::Text(text.to_owned())
    }
}

/// A touch that was picked.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PickedTouch {
    /// On the surface, in the job's units.
    pub point: [f64; 3],
    /// Outward normal of the surface, of length 1.
    pub vector: [f64; 3],
}

/// A code of the user's own: it goes through as it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CustomCode {
    /// `CmdPrm.Int[code]`.
    Int(i32, i32),
    /// `CmdPrm.Flt[code]`.
    Flt(i32, f64),
    /// `CmdPrm.Bol[code]`.
    Bol(i32, bool),
}

/// An axis of the work coordinate system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "an axis is an axis")]
pub enum Axis {
    X,
    Y,
    Z,
}

/// A step of the active frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrameStep {
    /// A turn about an axis, degrees.
    Turn(Axis, f64),
    /// A mirror across the plane that is square to an axis.
    Mirror(Axis),
}

/// What a loose job has in place of a typed value.
trait Given {
    fn given(&self) -> Value;
}

fn of<T: Given>(field: &Option<T>) -> Option<Value> {
    field.as_ref().map(Given::given)
}

fn map<const N: usize>(entries: [(&str, Option<Value>); N]) -> Value {
    Value::Map(entries.into_iter().filter_map(|(key, value)| Some((key.to_owned(), value?))).collect())
}

impl Given for f64 {
    fn given(&self) -> Value {
        Value::Number(*self)
    }
}

impl Given for i32 {
    fn given(&self) -> Value {
        Value::Number(f64::from(*self))
    }
}

impl Given for bool {
    fn given(&self) -> Value {
        Value::Flag(*self)
    }
}

impl Given for String {
    fn given(&self) -> Value {
        Value::Text(self.clone())
    }
}

impl<T: Given> Given for Option<T> {
    fn given(&self) -> Value {
        self.as_ref().map_or(Value::Null, Given::given)
    }
}

impl<T: Given> Given for [T; 3] {
    fn given(&self) -> Value {
        Value::List(self.iter().map(Given::given).collect())
    }
}

impl<T: Given> Given for Vec<T> {
    fn given(&self) -> Value {
        Value::List(self.iter().map(Given::given).collect())
    }
}

impl Given for BTreeMap<String, f64> {
    fn given(&self) -> Value {
        Value::Map(self.iter().map(|(key, x)| (key.clone(), x.given())).collect())
    }
}

impl Given for Nominal {
    fn given(&self) -> Value {
        match self {
            Nominal::Number(x) => x.given(),
            Nominal::Text(text) => text.given(),
        }
    }
}

impl Given for PickedTouch {
    fn given(&self) -> Value {
        map([("point", Some(self.point.given())), ("vector", Some(self.vector.given()))])
    }
}

impl Given for CustomCode {
    fn given(&self) -> Value {
        let (code, kind, value) = match self {
            CustomCode::Int(code, n) => (code, "Int", n.given()),
            CustomCode::Flt(code, x) => (code, "Flt", x.given()),
            CustomCode::Bol(code, on) => (code, "Bol", on.given()),
        };
        map([("code", Some(code.given())), ("type", Some(kind.to_owned().given())), ("value", Some(value))])
    }
}

impl Given for FrameStep {
    fn given(&self) -> Value {
        let named = |axis: &Axis| Some(format!("{axis:?}").given());
        match self {
            FrameStep::Turn(axis, degrees) => map([("rot", named(axis)), ("angle", Some(degrees.given()))]),
            FrameStep::Mirror(axis) => map([("mirror", named(axis))]),
        }
    }
}

impl From<Job> for Value {
    fn from(job: Job) -> Value {
        Value::from(&job)
    }
}

impl From<&Job> for Value {
    fn from(job: &Job) -> Value {
        job.given()
    }
}
