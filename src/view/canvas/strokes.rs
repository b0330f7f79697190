//! The strokes of a picture: lines, circles, arrow heads, dimensions with their names.

use super::{BOLD, LABEL, Painter};
use crate::geom::Vec2;
use crate::view::halves;
use crate::view::layout::{Arc, Placed};
use crate::view::plate::Plate;

/// Pixels between what a dimension is called and its value.
const NAME_GAP: f64 = 7.0;

/// What a dimension or an angle says, and where.
#[derive(Clone, Copy)]
pub(super) struct Name<'a> {
    pub said: &'a str,
    pub plate: Plate,
    pub lit: bool,
}

impl Painter {
    /// A filled arrow head with its tip at a place.
    pub(super) fn head(&self, tip: Vec2, way: Vec2, size: f64, colour: &str) {
        let c = &self.context;
        let (back, half) = (tip - way * size, way.perp() * size * 0.42);
        c.begin_path();
        self.outline(&[tip, back + half, back - half]);
        c.set_fill_style_str(colour);
        c.fill();
    }

    /// A dimension: extension lines, and its line with arrow heads.
    pub(super) fn dimension(&self, placed: &Placed<'_>, lit: bool) {
        let colour = &self.theme.ball;
        for (near, line) in placed.ends.into_iter().zip(placed.line.map(Vec2::from)) {
            let beyond = (line - near) / near.distance(line).max(1e-9) * 5.0;
            self.segment(near, line + beyond, colour, 0.75, &[]);
        }
        self.segment(placed.reach[0], placed.reach[1], colour, if lit { 2.0 } else { 1.0 }, &[]);
        for (tip, way) in placed.heads() {
            self.head(tip, way, 8.0, colour);
        }
    }

    /// An angle: its sides, and its arc with arrow heads.
    pub(super) fn angle(&self, arc: &Arc<'_>, lit: bool) {
        let c = &self.context;
        let colour = &self.theme.ball;
        let [first, turn] = arc.angle.turns;
        arc.sides.into_iter().for_each(|side| self.segment(arc.at, side, colour, 0.75, &[]));
        c.begin_path();
        let _ = c.arc_with_anticlockwise(arc.at.x, arc.at.y, arc.radius, -first, -first - turn, turn > 0.0);
        c.set_stroke_style_str(colour);
        c.set_line_width(if lit { 2.0 } else { 1.0 });
        self.dash(&[]);
        c.stroke();
        for (tip, direction) in arc.heads.into_iter().flatten() {
            self.head(tip, direction, 8.0, colour);
        }
    }

    /// What dimensions and angles say, each in its box. All values, then all labels: the font is set three times, however many there are.
    pub(super) fn names(&self, names: &[Name<'_>]) {
        let c = &self.context;
        let colour = &self.theme.ball;
        let wide = |text: &str| c.measure_text(text).map_or(60.0, |m| m.width());
        let placed = |name: &Name<'_>, draw: &dyn Fn()| {
            c.save();
            let Plate { middle, along, .. } = name.plate;
            let _ = c.transform(along.x, along.y, -along.y, along.x, middle.x, middle.y);
            draw();
            c.restore();
        };
        self.font(LABEL);
        let labels: Vec<f64> = names.iter().map(|name| wide(halves(name.said).0) + NAME_GAP).collect();
        self.font(BOLD);
        let values: Vec<f64> = names.iter().map(|name| wide(halves(name.said).1)).collect();
        for ((name, label), value) in names.iter().zip(&labels).zip(&values) {
            placed(name, &|| {
                let width = label + value + 12.0;
                c.set_fill_style_str(if name.lit { colour } else { &self.theme.background });
                c.fill_rect(-width / 2.0, -10.0, width, 20.0);
                c.set_stroke_style_str(colour);
                c.set_line_width(1.0);
                self.dash(&[]);
                c.stroke_rect(-width / 2.0, -10.0, width, 20.0);
                c.set_fill_style_str(if name.lit { &self.theme.background } else { &self.theme.text });
                let _ = c.fill_text(halves(name.said).1, label / 2.0, 0.0);
            });
        }
        self.font(LABEL);
        for (name, value) in names.iter().zip(&values) {
            placed(name, &|| {
                c.set_fill_style_str(if name.lit { &self.theme.background } else { &self.theme.wall });
                let _ = c.fill_text(halves(name.said).0, -(value + NAME_GAP) / 2.0, 0.0);
            });
        }
    }

    pub(super) fn label(&self, text: &str, at: Vec2) {
        let c = &self.context;
        c.set_line_width(3.0);
        c.set_stroke_style_str(&self.theme.background);
        self.dash(&[]);
        let _ = c.stroke_text(text, at.x, at.y);
        c.set_fill_style_str(&self.theme.text);
        let _ = c.fill_text(text, at.x, at.y);
    }

    /// A straight line. Dashes lie where they lie on every other line along the same one: there and back they fill no gap.
    pub(super) fn segment(&self, from: Vec2, to: Vec2, colour: &str, width: f64, dash: &[f64]) {
        let c = &self.context;
        let (from, to) = crate::view::forwards(from, to);
        if !dash.is_empty() {
            c.set_line_dash_offset(from.dot((to - from).normalize_or_zero()));
        }
        c.begin_path();
        c.move_to(from.x, from.y);
        c.line_to(to.x, to.y);
        c.set_stroke_style_str(colour);
        c.set_line_width(width);
        self.dash(dash);
        c.stroke();
    }

    pub(super) fn circle(&self, at: Vec2, radius: f64, colour: &str, width: f64) {
        let c = &self.context;
        c.begin_path();
        let _ = c.arc(at.x, at.y, radius, 0.0, std::f64::consts::TAU);
        c.set_stroke_style_str(colour);
        c.set_line_width(width);
        self.dash(&[]);
        c.stroke();
    }

    pub(super) fn disc(&self, at: Vec2, radius: f64, colour: &str) {
        let c = &self.context;
        c.begin_path();
        let _ = c.arc(at.x, at.y, radius, 0.0, std::f64::consts::TAU);
        c.set_fill_style_str(colour);
        c.fill();
    }

    pub(super) fn dash(&self, lengths: &[f64]) {
        let list: js_sys::Array = lengths.iter().map(|l| wasm_bindgen::JsValue::from_f64(*l)).collect();
        let _ = self.context.set_line_dash(&list);
    }
}
