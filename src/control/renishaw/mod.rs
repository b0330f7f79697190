//! Renishaw's macros for Fanuc and compatible controls: their moves, and the programs that call them.

pub mod macros;
mod plan_calls;
pub(super) mod post;

use crate::control::native_run::{CorrectsTools, NativeCycles};
use crate::path::Stored;

pub(super) use plan_calls::LINKING;

/// Native cycles of a control with this notation of work offsets and results.
pub const fn cycles(offset: fn(i32) -> f64, name: fn(Stored) -> String) -> NativeCycles {
    let word = |number, letter: &str| format!("P{number} {letter}");
    NativeCycles {
        plan: plan_calls::plan_calls,
        rerun: plan_calls::rerun,
        followed: false,
        offset,
        word,
        name,
        corrects_tools: CorrectsTools::AsAsked,
        measures_first: true,
        several: LINKING,
    }
}
