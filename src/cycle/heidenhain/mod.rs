//! Cycles of HEIDENHAIN controls.

pub mod two_circles;
