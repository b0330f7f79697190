//! The languages of programs that compute and jump. One machine runs them; what they differ in is rows of a grammar, and the words of each.

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
