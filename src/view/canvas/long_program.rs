//! Draws the lines of a long program in few strokes, without those that cannot be seen.

use super::{DOT, Painter};
use crate::geom::Vec2;
use crate::view::camera::Camera;
use crate::view::label_box::within_box;
use crate::view::scene::{Line, Scene, Stroke};
use crate::view::style::{self, Colour};

/// A picture with more lines is drawn this way; no job has that many.
pub(super) const LONG: usize = 5_000;

/// Ends closer than this to the previous point are merged with the next line, pixels.
const NEAR: f64 = 0.7;

/// Distance beyond the window at which lines are still drawn, pixels: more than half their width.
const WIDE: f64 = 16.0;

/// Largest number of points in a stroke: one twice as long takes browsers longer than two.
const MOST: usize = 500;

/// Draws consecutive lines in one stroke.
struct Pen<'p> {
    painter: &'p Painter,
    /// Style of the stroke; `None` before the first.
    style: Option<(Stroke, bool)>,
    /// Its last point, and the end of its last line.
    ends: [Vec2; 2],
    points: usize,
}

impl Pen<'_> {
    fn line(&mut self, style: (Stroke, bool), [from, to]: [Vec2; 2]) {
        let c = &self.painter.context;
        if self.style != Some(style) || self.ends[1] != from || self.points == MOST {
            self.finish();
            c.begin_path();
            c.move_to(from.x, from.y);
            (self.style, self.ends, self.points) = (Some(style), [from; 2], 0);
        }
        self.ends[1] = to;
        if to.distance(self.ends[0]) >= NEAR {
            self.point(to);
        }
    }

    fn point(&mut self, to: Vec2) {
        self.painter.context.line_to(to.x, to.y);
        self.ends[0] = to;
        self.points += 1;
    }

    /// Ends the stroke. Feeds are solid here: most of their lines are shorter than a dash.
    fn finish(&mut self) {
        let Some((stroke, rapid)) = self.style.take() else {
            return;
        };
        if self.points == 0 || self.ends[0] != self.ends[1] {
            self.point(self.ends[1]);
        }
        let pen = style::of(stroke, rapid);
        if rapid {
            self.painter.dashed(pen)
        } else {
            self.painter.stroke(pen.colour, pen.widths[0])
        }
    }
}

/// Part of a line inside a window of this size, with a small margin. Far outside a browser would still compute every dash.
fn clipped([from, to]: [Vec2; 2], size: Vec2) -> Option<[Vec2; 2]> {
    let [low, high] = [Vec2::splat(-WIDE), size + WIDE];
    let inside = |p: Vec2| p.cmpge(low).all() && p.cmple(high).all();
    if inside(from) && inside(to) {
        return Some([from, to]);
    }
    let [first, last] = within_box([from, to], [low, high])?;
    let at = |part: f64| from.lerp_monotonic(to, part);
    // Ends inside are unchanged: the next line continues from there.
    Some([
        if first > 0.0 { at(first) } else { from },
        if last < 1.0 { at(last) } else { to },
    ])
}

/// Pixel of a point, counted from an origin outside every window.
fn pixel(spot: Vec2) -> [u64; 2] {
    spot.to_array().map(|x| (x.round() + 2.0 * WIDE) as u64)
}

/// Recently drawn lines by their pixels: one entry each, which a later line replaces.
struct Recent(Vec<u64>);

impl Default for Recent {
    fn default() -> Self {
        Recent(vec![0; 1 << Recent::PLACES])
    }
}

impl Recent {
    const PLACES: u32 = 16;

    /// Whether a line between these pixels is new. A line from long ago may count as new.
    fn is_new(&mut self, line: &Line, [[a, b], [c, d]]: [[u64; 2]; 2]) -> bool {
        // No window has more pixels than fifteen bits count.
        let line = [b, c, d, line.stroke as u64, u64::from(line.rapid)]
            .into_iter()
            .zip([15, 15, 15, 2, 1]);
        let key = 1 + line.fold(a, |key, (more, bits)| key << bits | more);
        let place = key.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> (u64::BITS - Self::PLACES);
        std::mem::replace(&mut self.0[place as usize], key) != key
    }
}

impl Painter {
    /// Draws touches that are seen along their direction over everything else: no browser strokes a line without length.
    pub(super) fn dots(&self, scene: &Scene, camera: &Camera) {
        let mut recent = Recent::default();
        for line in scene
            .lines
            .iter()
            .filter(|line| line.stroke == Stroke::Touch)
        {
            let [from, to] = [line.from, line.to].map(|spot| camera.pixel(spot));
            let along = from.distance(to) < 1.0;
            if along
                && clipped([to; 2], camera.size).is_some()
                && recent.is_new(line, [pixel(to); 2])
            {
                self.disc(to, DOT, Colour::Touch);
            }
        }
    }

    /// Draws the lines of a long program; touches last, as in any picture.
    pub(super) fn long(&self, scene: &Scene, camera: &Camera) {
        let touch = |line: &&Line| matches!(line.stroke, Stroke::Touch | Stroke::Overtravel);
        let mut recent = Recent::default();
        for touches in [false, true] {
            let mut pen = Pen {
                painter: self,
                style: None,
                ends: [Vec2::ZERO; 2],
                points: 0,
            };
            for line in scene.lines.iter().filter(|line| touch(line) == touches) {
                let ends = [line.from, line.to].map(|spot| camera.pixel(spot));
                let Some(ends) = clipped(ends, camera.size) else {
                    continue;
                };
                let pixels = ends.map(pixel);
                // A line of one kind between two pixels is drawn once, except within a pixel where it continues another one.
                let continues = pixels[0] == pixels[1] && pen.ends[1] == ends[0];
                if continues || recent.is_new(line, pixels) {
                    pen.line((line.stroke, line.rapid), ends);
                }
            }
            pen.finish();
        }
    }
}
