//! Layout of values and plans at the border to JavaScript: numbers and one string in both directions. It is stated here once; `www/core/layout.ts` is generated
//! from it.

pub mod coded;
pub mod packed;
