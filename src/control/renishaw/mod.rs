//! Renishaw's macros for Fanuc and its kin: what they do, and the programs that call them.

pub mod machine;
pub mod macros;
