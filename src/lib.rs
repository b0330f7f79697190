//! Touch-probe cycles that you can see before the machine moves.
//!
//! One JSON form goes in, one plan comes out: the job is [checked](form), its cycle becomes a path, and from the path follow
//! the program, the parameter table, what the control will have measured on a part that lies a little off, and the picture. [`job`] joins these; it is
//! what a Rust user calls.
//!
//! | module | what a user of the crate finds there |
//! |---|---|
//! | [`job`] | a job from JSON, its check, its plan, its picture, its results from measured points |
//! | [`config`] | what a portal allows: rules that jobs are filled in and judged by |
//! | [`describe`] | what forms and readers need: the catalog, the JSON Schema, the parameter table as text |
//! | [`import`](mod@import) | dumps and programs into jobs; the moves of any program |
//! | [`tool_length`] | SINUMERIK's LENTOAX |
//! | [`form`] | values, findings and the list of their codes |
//! | [`text`](mod@text) | what is said, as templates with their values, for other languages |
//!
//! Every public name is listed in `tests/snapshots/public.txt`; a change is noted in the changelog. The rest (cycles,
//! controls, paths, formulas, the virtual part, pictures, geometry) is the crate's own, and its tests are modules of the crate.
//!
//! Inside the crate everything is millimetres and radians (degrees where a name says so, and in formulas, as controls take
//! them); the job's units are converted once on the way in and once on the way out. All frames are right-handed; angles
//! count counter-clockwise seen against the tool axis.
//!
//! What this is not: a simulator of a machine. It knows the feature that is probed, not fixtures, axis limits or spindles; of the
//! stylus it knows what the job says; and no program made here has been run on a machine by its authors.

pub mod config;
pub mod describe;
pub mod form;
pub mod import;
pub mod job;
pub mod text;
pub mod tool_length;

#[cfg(any(test, target_arch = "wasm32"))]
mod border;
mod control;
mod cycle;
mod formula;
mod geom;
mod num;
mod part;
mod path;
mod tolerance;
#[cfg_attr(
    not(target_arch = "wasm32"),
    allow(dead_code, reason = "most of it is drawn on the canvas of a page")
)]
mod view;

/// Runs the examples of the README as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// What JavaScript calls: the npm package is its documentation.
#[cfg(target_arch = "wasm32")]
#[doc(hidden)]
pub mod wasm;

// The tests are modules of the crate, so that they can use all of it.
#[cfg(all(test, not(target_arch = "wasm32")))]
extern crate self as touchpath;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[path = "../tests/common/mod.rs"]
mod common;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[path = "../tests/all/main.rs"]
mod tests;
