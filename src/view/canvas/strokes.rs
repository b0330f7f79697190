//! Strokes of a picture: lines, circles, arrow heads, dimensions with their names.

use std::f64::consts::TAU;

use super::{BOLD, LABEL, Painter};
use crate::geom::Vec2;
use crate::view::halves;
use crate::view::label_box::LabelBox;
use crate::view::layout::{AngleArc, PlacedDimension};
use crate::view::style::{Colour, Pen};

/// Pixels between the name of a dimension and its value.
const NAME_GAP: f64 = 7.0;

/// Width of the line of a dimension or an angle, pixels.
fn wide(lit: bool) -> f64 {
    if lit { 2.0 } else { 1.0 }
}

/// Text of a dimension or an angle, and its position.
#[derive(Clone, Copy)]
pub(super) struct Name<'a> {
    pub said: &'a str,
    pub plate: LabelBox,
    pub lit: bool,
}

impl Painter {
    /// Sets the opacity of the following strokes, 0 to 1.
    pub(super) fn alpha(&self, alpha: f64) -> &Self {
        self.context.set_global_alpha(alpha);
        self
    }

    pub(super) fn fill(&self, colour: Colour) {
        self.context.set_fill_style_str(self.theme.colour(colour));
        self.context.fill();
    }

    /// Strokes the path with a solid line.
    pub(super) fn stroke(&self, colour: Colour, width: f64) {
        self.take(colour, width, &[]);
        self.context.stroke();
    }

    /// Strokes the path with the dashes of the pen, if it has any.
    pub(super) fn dashed(&self, pen: &Pen) {
        self.take(pen.colour, pen.widths[0], pen.dash);
        self.context.stroke();
    }

    fn take(&self, colour: Colour, width: f64, dash: &'static [f64]) {
        self.context.set_stroke_style_str(self.theme.colour(colour));
        self.context.set_line_width(width);
        self.dash(dash);
    }

    pub(super) fn dash(&self, lengths: &'static [f64]) {
        if self.dashes.replace(lengths) != lengths {
            let list: js_sys::Array = lengths
                .iter()
                .map(|length| wasm_bindgen::JsValue::from_f64(*length))
                .collect();
            let _ = self.context.set_line_dash(&list);
        }
    }

    /// A path of closed outlines, pixels.
    pub(super) fn outlines(&self, outlines: &[impl AsRef<[Vec2]>]) {
        self.context.begin_path();
        outlines
            .iter()
            .for_each(|outline| self.closed(outline.as_ref()));
    }

    fn closed(&self, outline: &[Vec2]) {
        self.points(outline);
        self.context.close_path();
    }

    /// Adds consecutive points to the path.
    pub(super) fn points(&self, points: &[Vec2]) {
        let c = &self.context;
        for (k, at) in points.iter().enumerate() {
            if k == 0 {
                c.move_to(at.x, at.y)
            } else {
                c.line_to(at.x, at.y)
            }
        }
    }

    /// A filled arrow head with its tip at a position.
    pub(super) fn head(&self, tip: Vec2, way: Vec2, size: f64, colour: Colour) {
        let (back, half) = (tip - way * size, way.perp() * size * 0.42);
        self.outlines(&[[tip, back + half, back - half]]);
        self.fill(colour);
    }

    /// A dimension: extension lines, and its line with arrow heads.
    pub(super) fn dimension(&self, placed: &PlacedDimension<'_>, lit: bool) {
        for (near, line) in placed.ends.into_iter().zip(placed.line) {
            let beyond = (line - near) / near.distance(line).max(1e-9) * 5.0;
            self.segment(near, line + beyond, Colour::Ball, 0.75);
        }
        self.segment(placed.reach[0], placed.reach[1], Colour::Ball, wide(lit));
        placed
            .heads()
            .into_iter()
            .for_each(|(tip, way)| self.head(tip, way, 8.0, Colour::Ball));
    }

    /// An angle: its sides, and its arc with arrow heads.
    pub(super) fn angle(&self, arc: &AngleArc<'_>, lit: bool) {
        let c = &self.context;
        let [first, turn] = arc.angle.turns;
        arc.sides
            .into_iter()
            .for_each(|side| self.segment(arc.at, side, Colour::Ball, 0.75));
        c.begin_path();
        let _ = c.arc_with_anticlockwise(
            arc.at.x,
            arc.at.y,
            arc.radius,
            -first,
            -first - turn,
            turn > 0.0,
        );
        self.stroke(Colour::Ball, wide(lit));
        arc.heads
            .into_iter()
            .flatten()
            .for_each(|(tip, way)| self.head(tip, way, 8.0, Colour::Ball));
    }

    /// Texts of dimensions and angles, each in its box. All values, then all labels: the font is set three times, however many there are.
    pub(super) fn names(&self, names: &[Name<'_>]) {
        let c = &self.context;
        let wide = |text: &str| c.measure_text(text).map_or(60.0, |m| m.width());
        let placed = |name: &Name<'_>, draw: &dyn Fn()| {
            c.save();
            let LabelBox { middle, along, .. } = name.plate;
            let _ = c.transform(along.x, along.y, -along.y, along.x, middle.x, middle.y);
            draw();
            c.restore();
        };
        let text = |text: &str, x: f64, colour: Colour| {
            c.set_fill_style_str(self.theme.colour(colour));
            let _ = c.fill_text(text, x, 0.0);
        };
        self.font(LABEL);
        let labels: Vec<f64> = names
            .iter()
            .map(|name| wide(halves(name.said).0) + NAME_GAP)
            .collect();
        self.font(BOLD);
        let values: Vec<f64> = names.iter().map(|name| wide(halves(name.said).1)).collect();
        // To the state at the beginning of a picture, before restoring.
        self.dash(&[]);
        for ((name, label), value) in names.iter().zip(&labels).zip(&values) {
            let [ground, ink] = if name.lit {
                [Colour::Ball, Colour::Background]
            } else {
                [Colour::Background, Colour::Text]
            };
            placed(name, &|| {
                self.plate(
                    Vec2::ZERO,
                    Vec2::new((label + value) / 2.0 + 6.0, 10.0),
                    ground,
                    Some((Colour::Ball, 1.0)),
                );
                text(halves(name.said).1, label / 2.0, ink);
            });
        }
        self.font(LABEL);
        for (name, value) in names.iter().zip(&values) {
            let ink = if name.lit {
                Colour::Background
            } else {
                Colour::Wall
            };
            placed(name, &|| {
                text(halves(name.said).0, -(value + NAME_GAP) / 2.0, ink)
            });
        }
    }

    /// An upright rectangle around a point, with or without an edge.
    pub(super) fn plate(
        &self,
        middle: Vec2,
        half: Vec2,
        ground: Colour,
        edge: Option<(Colour, f64)>,
    ) {
        let (c, low, size) = (&self.context, middle - half, half * 2.0);
        c.set_fill_style_str(self.theme.colour(ground));
        c.fill_rect(low.x, low.y, size.x, size.y);
        if let Some((colour, width)) = edge {
            self.take(colour, width, &[]);
            c.stroke_rect(low.x, low.y, size.x, size.y);
        }
    }

    pub(super) fn label(&self, text: &str, at: Vec2) {
        let c = &self.context;
        self.take(Colour::Background, 3.0, &[]);
        let _ = c.stroke_text(text, at.x, at.y);
        c.set_fill_style_str(self.theme.colour(Colour::Text));
        let _ = c.fill_text(text, at.x, at.y);
    }

    /// A solid straight line.
    pub(super) fn segment(&self, from: Vec2, to: Vec2, colour: Colour, width: f64) {
        let (from, to) = crate::view::forwards(from, to);
        self.straight(from, to);
        self.stroke(colour, width);
    }

    /// A straight line. Dashes have the same positions on every line along it: there and back they fill no gap.
    pub(super) fn dashes(&self, from: Vec2, to: Vec2, pen: &Pen) {
        let (from, to) = crate::view::forwards(from, to);
        if !pen.dash.is_empty() {
            self.context
                .set_line_dash_offset(from.dot((to - from).normalize_or_zero()));
        }
        self.straight(from, to);
        self.dashed(pen);
    }

    fn straight(&self, from: Vec2, to: Vec2) {
        self.context.begin_path();
        self.context.move_to(from.x, from.y);
        self.context.line_to(to.x, to.y);
    }

    /// A path that is a circle.
    fn round(&self, at: Vec2, radius: f64) {
        self.context.begin_path();
        let _ = self.context.arc(at.x, at.y, radius, 0.0, TAU);
    }

    pub(super) fn circle(&self, at: Vec2, radius: f64, colour: Colour, width: f64) {
        self.round(at, radius);
        self.stroke(colour, width);
    }

    pub(super) fn disc(&self, at: Vec2, radius: f64, colour: Colour) {
        self.round(at, radius);
        self.fill(colour);
    }
}
