//! Touch-probe cycles that you can see before the machine moves.
//!
//! One JSON form goes in, one plan comes out: the job is [checked](form), its cycle becomes a path, and from the path follow
//! the program, the parameter table, what the control will have measured on a part that lies a little off, and the picture. [`job`] joins these; it is
//! what a Rust user calls.
//!
//! | module | what a user of the crate finds there |
//! |---|---|
//! | [`job`] | a job from JSON, its check, its plan, its picture, its results from measured points |
//! | [`describe`] | what forms and readers need: the catalog, the JSON Schema, the parameter table as text |
//! | [`import`](mod@import) | dumps and programs into jobs; the moves of any program |
//! | [`tool_length`] | SINUMERIK's LENTOAX |
//! | [`form`] | values, findings and the list of their codes |
//! | [`text`](mod@text) | what is said, as templates with their values, for other languages |
//!
//! That is all of it: every public name stands in `tests/snapshots/public.txt`, and changes only with a word in the changelog. The rest (cycles,
//! controls, paths, formulas, the virtual part, pictures, geometry) is the crate's own. Its tests look into that with the feature `internals`, which
//! promises nothing.
//!
//! Inside the crate everything is millimetres and radians (degrees where a name says so, and in formulas, as controls take
//! them); the job's units are converted once on the way in and once on the way out. All frames are right-handed; angles
//! count counter-clockwise seen against the tool axis.
//!
//! What this is not: a simulator of a machine. It knows the feature that is probed, not fixtures, axis limits or spindles; of the
//! stylus it knows what the job says; and no program made here has been run on a machine by its authors.

// What only a test or the other target asks for is no dead code: with `internals` the compiler sees all of it as public.
#![cfg_attr(not(feature = "internals"), allow(dead_code, unused_imports))]

pub mod describe;
pub mod form;
pub mod import;
pub mod job;
pub mod text;
pub mod tool_length;

#[cfg(not(feature = "internals"))]
mod control;
#[cfg(feature = "internals")]
pub mod control;
#[cfg(not(feature = "internals"))]
mod cycle;
#[cfg(feature = "internals")]
pub mod cycle;
#[cfg(not(feature = "internals"))]
mod formula;
#[cfg(feature = "internals")]
pub mod formula;
#[cfg(not(feature = "internals"))]
mod geom;
#[cfg(feature = "internals")]
pub mod geom;
#[cfg(not(feature = "internals"))]
mod num;
#[cfg(feature = "internals")]
pub mod num;
#[cfg(not(feature = "internals"))]
mod part;
#[cfg(feature = "internals")]
pub mod part;
#[cfg(not(feature = "internals"))]
mod path;
#[cfg(feature = "internals")]
pub mod path;
#[cfg(not(feature = "internals"))]
mod tolerance;
#[cfg(feature = "internals")]
pub mod tolerance;
#[cfg(not(feature = "internals"))]
mod view;
#[cfg(feature = "internals")]
pub mod view;

/// What [`form`] was called up to 0.1.
#[doc(hidden)]
pub use form as spec;

/// The examples of the README, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(all(target_arch = "wasm32", not(feature = "internals")))]
mod wasm;
#[cfg(all(target_arch = "wasm32", feature = "internals"))]
pub mod wasm;
