//! The look of a picture, for the canvas and for the SVG: its colours and its lines.

use crate::view::scene::Stroke;

/// A colour of a picture.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(
    not(target_arch = "wasm32"),
    allow(dead_code, reason = "some are the canvas' alone")
)]
pub enum Colour {
    /// Of what lies beneath everything.
    Background,
    /// Of axes, scale and work origin.
    Text,
    /// Of nominal walls and material.
    Wall,
    /// Of the virtual part.
    Actual,
    /// Of positioning moves.
    Position,
    /// Of long links.
    Link,
    /// Of touches, contacts and their numbers.
    Touch,
    /// Of balls and dimensions.
    Ball,
    /// Of the move that is pointed at.
    Highlight,
}

/// Of each, in that order: its name in a theme, what it is on a canvas that has no theme, and in an SVG, whose background is white.
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

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Pen {
    pub colour: Colour,
    /// Its width on a canvas, pixels, and in an SVG, whose units are smaller on paper.
    pub widths: [f64; 2],
    /// Lengths of its dashes and of the gaps between them; none if it has no gaps.
    pub dash: &'static [f64],
}

const fn pen(colour: Colour, widths: [f64; 2], dash: &'static [f64]) -> Pen {
    Pen {
        colour,
        widths,
        dash,
    }
}

/// Walls that are seen edge-on: nominal, and of the virtual part.
pub const EDGES: [Pen; 2] = [
    pen(Colour::Wall, [2.0; 2], &[]),
    pen(Colour::Actual, [1.5; 2], &[7.0, 4.0]),
];

/// Center line of a cycle or relation: nominal, actual.
pub const CENTRE_LINES: [Pen; 2] = [
    pen(Colour::Wall, [1.0; 2], &[10.0, 4.0, 2.0, 4.0]),
    pen(Colour::Actual, [1.0; 2], &[10.0, 4.0, 2.0, 4.0]),
];

/// The pen of a move. Its dashes say what it is; the colour only repeats it.
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

/// What the canvas draws, and an SVG does not.
#[cfg(target_arch = "wasm32")]
pub mod screen {
    use super::{Colour, Pen, pen};

    /// From the middle of a circle to the handles of its touches.
    pub const SPREAD: Pen = pen(Colour::Ball, [1.0; 2], &[2.0, 4.0]);
    /// From the handle that shifts the part to the one that turns it.
    pub const ARM: Pen = pen(Colour::Actual, [1.0; 2], &[3.0, 3.0]);
    /// Of each kind of arrow in the picture of the tool lengths, in their order.
    pub const ARROWS: [Pen; 3] = [
        pen(Colour::Text, [1.5; 2], &[]),
        pen(Colour::Link, [1.0; 2], &[5.0, 4.0]),
        pen(Colour::Touch, [4.0; 2], &[]),
    ];
}
