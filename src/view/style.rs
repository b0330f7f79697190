//! Style of a picture, for canvas and SVG: colours and lines.

use crate::view::scene::Stroke;

/// A colour of a picture.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(
    not(target_arch = "wasm32"),
    allow(dead_code, reason = "some are the canvas' alone")
)]
pub enum Colour {
    /// Background.
    Background,
    /// Axes, scale and work origin.
    Text,
    /// Nominal walls and material.
    Wall,
    /// Virtual part.
    Actual,
    /// Positioning moves.
    Position,
    /// Long links.
    Link,
    /// Touches, contacts and their numbers.
    Touch,
    /// Balls and dimensions.
    Ball,
    /// Highlighted move.
    Highlight,
}

/// For each colour in that order: name in a theme, default on a canvas without a theme, and colour in an SVG with a white background.
pub const COLOURS: [(&str, &str, &str); 9] = [
    ("background", "#ffffff", "#fff"),
    ("text", "#1c2430", "#46535f"),
    ("wall", "#4a5565", "#8a94a3"),
    ("actual", "#b45309", "#b45309"),
    ("position", "#15803d", "#15803d"),
    ("link", "#7b8794", "#6b7280"),
    ("touch", "#dc2626", "#cf2a20"),
    ("ball", "#2563eb", "#2563eb"),
    ("highlight", "#2563eb", "#2563eb"),
];

impl Colour {
    /// The colour in an SVG.
    pub fn on_paper(self) -> &'static str {
        COLOURS[self as usize].2
    }
}

/// Style of a line.
#[derive(Clone, Copy, Debug)]
pub struct Pen {
    pub colour: Colour,
    /// Width on a canvas, pixels, and in an SVG, whose units are smaller on paper.
    pub widths: [f64; 2],
    /// Lengths of its dashes and gaps; empty for a solid line.
    pub dash: &'static [f64],
}

const fn pen(colour: Colour, widths: [f64; 2], dash: &'static [f64]) -> Pen {
    Pen {
        colour,
        widths,
        dash,
    }
}

/// Walls seen edge-on: nominal, and of the virtual part.
pub const EDGES: [Pen; 2] = [
    pen(Colour::Wall, [2.0; 2], &[]),
    pen(Colour::Actual, [1.5; 2], &[7.0, 4.0]),
];

/// Center line of a cycle or relation: nominal, actual.
pub const CENTRE_LINES: [Pen; 2] = [
    pen(Colour::Wall, [1.0; 2], &[10.0, 4.0, 2.0, 4.0]),
    pen(Colour::Actual, [1.0; 2], &[10.0, 4.0, 2.0, 4.0]),
];

/// Pen of a move. Its dashes tell its kind; the colour only repeats it.
pub const fn of(stroke: Stroke, rapid: bool) -> &'static Pen {
    const RAPID: Pen = pen(Colour::Position, [1.0, 1.5], &[12.0, 5.0]);
    const POSITION: Pen = pen(Colour::Position, [1.5, 2.0], &[9.0, 4.0, 2.0, 4.0]);
    const LINK: Pen = pen(Colour::Link, [1.5, 1.6], &[6.0, 4.0]);
    const TOUCH: Pen = pen(Colour::Touch, [2.5, 2.0], &[]);
    const OVERTRAVEL: Pen = pen(Colour::Touch, [1.5, 0.9], &[1.5, 3.5]);
    match stroke {
        _ if rapid => &RAPID,
        Stroke::Position => &POSITION,
        Stroke::Link => &LINK,
        Stroke::Touch => &TOUCH,
        Stroke::Overtravel => &OVERTRAVEL,
    }
}

/// Pens of the canvas that an SVG does not use.
#[cfg(target_arch = "wasm32")]
pub mod screen {
    use super::{Colour, Pen, pen};

    /// From the middle of a circle to the handles of its touches.
    pub const SPREAD: Pen = pen(Colour::Ball, [1.0; 2], &[2.0, 4.0]);
    /// From the handle that shifts the part to the one that turns it.
    pub const ARM: Pen = pen(Colour::Actual, [1.0; 2], &[3.0, 3.0]);
    /// Pens of the arrows in a tool-length picture, by kind.
    pub const ARROWS: [Pen; 3] = [
        pen(Colour::Text, [1.5; 2], &[]),
        pen(Colour::Link, [1.0; 2], &[5.0, 4.0]),
        pen(Colour::Touch, [4.0; 2], &[]),
    ];
}
