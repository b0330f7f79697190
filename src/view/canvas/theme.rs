//! The colours of a canvas.

use crate::view::style::{COLOURS, Colour};

/// CSS colours, in the order of [`Colour`].
#[derive(Clone, Debug)]
pub struct Theme([String; COLOURS.len()]);

impl Theme {
    /// The colours by their names; a missing one has its default.
    pub fn of(given: impl Fn(&str) -> Option<String>) -> Self {
        Theme(COLOURS.map(|(name, own, _)| given(name).unwrap_or_else(|| own.to_owned())))
    }

    pub(super) fn colour(&self, colour: Colour) -> &str {
        &self.0[colour as usize]
    }
}
