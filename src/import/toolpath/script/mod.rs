//! Languages of programs that compute and jump. One machine runs them; their differences are rows of a grammar, and their own words.

pub mod expression;
pub mod grammar;
mod heidenhain;
mod index;
mod machine;
mod macros;
mod nested;
mod reprap;
mod sinumerik;
mod statement;
pub mod variables;

pub(in crate::import::toolpath) use index::Index;
pub(in crate::import::toolpath) use machine::Machine;
pub(in crate::import::toolpath) use macros::is_macro;
pub(in crate::import::toolpath) use statement::Turn;
