//! Touch-probe cycles that you can see before the machine moves.
//!
//! One JSON form goes in, one plan comes out: the job is [checked](form), its [cycle] becomes a [path], and from
//! the path follow the [program](control), the parameter table, what the control will have measured on a [part] that lies a
//! little off, and the [picture](view). [`job`] joins these; it is what a Rust user calls.
//!
//! | module | what a user of the crate finds there |
//! |---|---|
//! | [`job`] | a job from JSON, its check, its plan, its picture, its results from measured points |
//! | [`describe`] | what forms and readers need: the catalog, the JSON Schema, the parameter table as text |
//! | [`import`](mod@import) | dumps and programs into jobs; the moves of any program |
//! | [`tool_length`] | SINUMERIK's LENTOAX |
//! | [`form`] | values, fields, checks, findings and the list of their codes |
//! | [`cycle`], [`control`] | the lists of what is known: cycles, controls, their programs, proof and safety rules |
//! | [`path`], [`formula`], [`part`] | what a plan is made of: moves and features, results as expressions, the virtual part |
//! | [`view`] | the scene of a plan, its dimensions, an SVG |
//! | [`geom`], [`num`], [`tolerance`], [`text`](mod@text) | planes and frames, exact decimals, values with tolerances (ISO 286, ISO 2768), what is said |
//!
//! Every public name stands in `tests/snapshots/public.txt`. Up to version 1.0 those of the first four rows change only with a word in the
//! changelog; the others are open to readers and tests, and may change with any version.
//!
//! Inside the crate everything is millimetres and radians (degrees where a name says so, and in formulas, as controls take
//! them); the job's units are converted once on the way in and once on the way out. All frames are right-handed; angles
//! count counter-clockwise seen against the tool axis.
//!
//! What this is not: a simulator of a machine. It knows the feature that is probed, not fixtures, limits or spindles; the
//! stylus is a ball without a shaft; and no program made here has been run on a machine by its authors.

pub mod control;
pub mod cycle;
pub mod describe;
pub mod form;
pub mod formula;
pub mod geom;
pub mod import;
pub mod job;
pub mod num;
pub mod part;
pub mod path;
pub mod text;
pub mod tolerance;
pub mod tool_length;
pub mod view;

/// What [`control`] was called up to 0.1.
#[doc(hidden)]
pub use control as post;
/// What [`form`] was called up to 0.1.
#[doc(hidden)]
pub use form as spec;

/// The examples of the README, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(target_arch = "wasm32")]
pub mod wasm;
