//! How values and plans cross the border to JavaScript: numbers and one text, either way. Their layout is stated here once;
//! `www/core/layout.ts` is generated from it.

pub mod coded;
pub mod packed;
