//! From the picture plane to pixels: fit, zoom, pan. Pixels are CSS pixels, y downwards.

use std::iter::successors;

use crate::view::scene::{Drawn, DrawnAngle, Scene, Spot};

/// A window on the picture plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Pixels in a mm.
    pub scale: f64,
    /// The spot in the middle of the window.
    pub middle: Spot,
    /// Width and height of the window.
    pub size: Spot,
}

/// Room around a fitted scene, pixels: for axes and numbers, and in a small picture without them.
pub const MARGIN: f64 = 36.0;
/// The same where dimensions stand around the scene.
pub const DIMENSION_MARGIN: f64 = 84.0;
/// The same in a small picture.
pub const SMALL_MARGIN: f64 = 8.0;

/// How far a dimension's line stands from the part, pixels: one that is always drawn, and one that comes with the focus.
const STANDS_OFF: [f64; 2] = [46.0, 16.0];

/// Where the work axes are drawn, pixels from the lower left corner, and how far their names reach from there.
pub const AXES_CORNER: f64 = 34.0;
const AXES_REACH: f64 = 36.0;
/// How far the scale bar stands from the lower right corner, pixels, and how high it reaches with its length above it.
pub const BAR_CORNER: f64 = 16.0;
const BAR_REACH: f64 = 34.0;
/// Half the room that the name of a dimension takes, pixels.
const NAME: [f64; 2] = [58.0, 12.0];

/// The radius of an angle's arc, pixels, where there is room for it.
const ANGLE_RADIUS: f64 = 54.0;
/// How far from its vertex an angle's name stands, pixels: to the side farther than up or down, since a name is wider than it is high.
const ANGLE_NAME: [f64; 2] = [112.0, 76.0];
/// A name has room where the nearest touch is farther than this from the vertex, pixels.
const ROOM_FOR_NAME: f64 = 90.0;

/// An angle as it is drawn, pixels.
#[derive(Clone, Copy, Debug)]
pub struct Arc<'a> {
    /// The angle.
    pub angle: &'a DrawnAngle,
    /// Its vertex.
    pub at: Spot,
    /// The radius of its arc.
    pub radius: f64,
    /// The far ends of its two sides, a little beyond the arc.
    pub sides: [Spot; 2],
    /// The ends of the arc, each with the direction of its arrow head; none on an arc that is too short for them.
    pub heads: Option<[(Spot, Spot); 2]>,
    /// The ends of the arc.
    pub ends: [Spot; 2],
    /// The middle of its name; none where a name would cover touches.
    pub name: Option<Spot>,
}

/// The name of a dimension that comes with the focus stands beyond the end of a line that is shorter than this, pixels: on the line it would cover it
/// and what it measures. Those that are always drawn stand outside the part.
const SHORT: f64 = 70.0;

/// Whether the name of a dimension's line is written upright, as on a drawing.
pub fn is_upright([start, end]: [Spot; 2]) -> bool {
    (end[1] - start[1]).abs() > (end[0] - start[0]).abs()
}

/// The middle of a dimension's name: on its line, or beyond it.
pub fn middle_of_name(drawn: &Drawn, [start, end]: [Spot; 2]) -> Spot {
    let along = [end[0] - start[0], end[1] - start[1]];
    let length = along[0].hypot(along[1]);
    let beyond = if drawn.on_demand && length < SHORT { (length / 2.0 + NAME[0] + 8.0) / length.max(1e-9) } else { 0.0 };
    [0, 1].map(|i| (start[i] + end[i]) / 2.0 + along[i] * beyond)
}

/// The middle of a dimension's name, and half the room that it takes.
fn room_of_name(drawn: &Drawn, line: [Spot; 2]) -> [Spot; 2] {
    [middle_of_name(drawn, line), if is_upright(line) { [NAME[1], NAME[0]] } else { NAME }]
}

impl Camera {
    /// A window that shows `bounds` with so many pixels around.
    pub fn fit(size: Spot, [low, high]: [Spot; 2], margin: f64) -> Self {
        let room = |i: usize| (size[i] - 2.0 * margin).max(20.0) / (high[i] - low[i]).max(1e-3);
        let middle = [(low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0];
        Camera { scale: room(0).min(room(1)), middle, size }
    }

    /// A round length for the scale bar, in units of so many millimetres.
    pub fn bar(&self, unit: f64) -> f64 {
        let most = 110.0 / self.scale / unit;
        let power = 10f64.powi(most.log10().floor() as i32);
        [5.0, 2.0, 1.0].iter().map(|step| step * power).find(|length| *length <= most).unwrap_or(power)
    }

    /// Moves a fitted scene up where the names of its dimensions would lie on the axes or on the scale bar, as far as there is room above it.
    pub fn clear_corners(&mut self, scene: &Scene) {
        let [width, height] = self.size;
        let axes = [AXES_CORNER + AXES_REACH, height - AXES_CORNER - AXES_REACH];
        let unit = scene.unit.unwrap_or(1.0);
        let bar = [width - 2.0 * BAR_CORNER - self.bar(unit) * unit * self.scale, height - BAR_REACH];
        let (mut top, mut under) = (self.pixel(scene.bounds()[1])[1], 0.0_f64);
        for (drawn, [.., start, end]) in self.dimensions(scene, None) {
            let [[x, y], half] = room_of_name(drawn, [start, end]);
            top = top.min(y - half[1]).min(start[1]).min(end[1]);
            if x - half[0] < axes[0] {
                under = under.max(y + half[1] - axes[1]);
            }
            if x + half[0] > bar[0] {
                under = under.max(y + half[1] - bar[1]);
            }
        }
        self.pan([0.0, -under.min((top - MARGIN).max(0.0))]);
    }

    /// Where a spot is seen.
    pub fn pixel(&self, spot: Spot) -> Spot {
        [
            self.size[0] / 2.0 + (spot[0] - self.middle[0]) * self.scale,
            self.size[1] / 2.0 - (spot[1] - self.middle[1]) * self.scale,
        ]
    }

    /// The spot seen at a pixel.
    pub fn spot(&self, pixel: Spot) -> Spot {
        [
            self.middle[0] + (pixel[0] - self.size[0] / 2.0) / self.scale,
            self.middle[1] - (pixel[1] - self.size[1] / 2.0) / self.scale,
        ]
    }

    /// The dimensions that are drawn while a field has the focus, or none: each with its ends on the part and the ends of its line, pixels.
    pub fn dimensions<'a>(&self, scene: &'a Scene, focus: Option<&str>) -> Vec<(&'a Drawn, [Spot; 4])> {
        let mut shown: Vec<(&Drawn, [Spot; 4])> = Vec::new();
        let mut names: Vec<[Spot; 2]> = Vec::new();
        let all = |on_demand: bool| scene.dimensions.iter().filter(move |d| d.on_demand == on_demand);
        // One that comes with the focus moves none of those that are there.
        for d in all(false).chain(all(true).filter(|d| focus == Some(d.field))) {
            let [from, to] = d.ends.map(|spot| self.pixel(spot));
            let far = d.aside.1 * self.scale + STANDS_OFF[usize::from(d.on_demand)];
            let line_at = |far: f64| [from, to].map(|p| [p[0] + d.aside.0[0] * far, p[1] - d.aside.0[1] * far]);
            let clear = |far: &f64| {
                let name = room_of_name(d, line_at(*far));
                names.iter().all(|other| (0..2).any(|i| (name[0][i] - other[0][i]).abs() >= name[1][i] + other[1][i]))
            };
            let seen = |far: f64| {
                let [middle, half] = room_of_name(d, line_at(far));
                (0..2).all(|i| middle[i] >= half[i] && middle[i] + half[i] <= self.size[i])
            };
            // A name that would lie on another one stands further out, but not out of the picture.
            let mut places = successors(Some(far), |far| Some(far + 2.0 * NAME[1] + 4.0)).take(1 + 2 * names.len());
            let line = line_at(places.find(|place| clear(place) && (seen(*place) || !seen(far))).unwrap_or(far));
            names.push(room_of_name(d, line));
            shown.push((d, [from, to, line[0], line[1]]));
        }
        shown
    }

    /// The angles that are drawn; one whose field has the focus has its name in any case.
    pub fn angles<'a>(&self, scene: &'a Scene, focus: Option<&'a str>) -> impl Iterator<Item = Arc<'a>> {
        let camera = *self;
        scene.angles.iter().map(move |angle| {
            let at = camera.pixel(angle.at);
            let room = angle.room * camera.scale;
            let radius = ANGLE_RADIUS.min(room * 0.6);
            let [first, turn] = angle.turns;
            let along = |radians: f64, [wide, high]: [f64; 2]| {
                let (sin, cos) = radians.sin_cos();
                [at[0] + wide * cos, at[1] - high * sin]
            };
            let sides = [first, first + turn];
            let ends = sides.map(|side| along(side, [radius; 2]));
            // Along the arc, away from its middle.
            let head = |end: usize, sense: f64| (ends[end], [-sense * sides[end].sin(), -sense * sides[end].cos()]);
            let named = room > ROOM_FOR_NAME || focus == Some(angle.field);
            Arc {
                angle,
                at,
                radius,
                sides: sides.map(|side| along(side, [radius + 8.0; 2])),
                heads: (turn.abs() * radius > 22.0).then(|| [head(0, -turn.signum()), head(1, turn.signum())]),
                ends,
                name: named.then(|| along(first + turn / 2.0, ANGLE_NAME)),
            }
        })
    }

    /// Closer by `factor`; the spot at `pixel` stays there.
    pub fn zoom(&mut self, factor: f64, pixel: Spot) {
        let before = self.spot(pixel);
        self.scale = crate::num::within(self.scale * factor, 1e-4, 1e6);
        let after = self.spot(pixel);
        self.middle = [self.middle[0] + before[0] - after[0], self.middle[1] + before[1] - after[1]];
    }

    /// The picture is dragged by so many pixels.
    pub fn pan(&mut self, by: Spot) {
        self.middle = [self.middle[0] - by[0] / self.scale, self.middle[1] + by[1] / self.scale];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fitted_scene_lies_inside_and_zoom_keeps_the_spot_under_the_pointer() {
        let mut camera = Camera::fit([400.0, 300.0], [[-40.0, -25.0], [40.0, 25.0]], MARGIN);
        let corner = camera.pixel([-40.0, 25.0]);
        assert!((corner[0] - MARGIN).abs() < 1e-9 && corner[1] >= MARGIN, "{corner:?}");
        let pixel = [100.0, 50.0];
        let before = camera.spot(pixel);
        camera.zoom(3.0, pixel);
        let after = camera.spot(pixel);
        assert!((before[0] - after[0]).abs() < 1e-9 && (before[1] - after[1]).abs() < 1e-9);
        camera.pan([10.0, -5.0]);
        let dragged = camera.spot([110.0, 45.0]);
        assert!((before[0] - dragged[0]).abs() < 1e-9 && (before[1] - dragged[1]).abs() < 1e-9);
    }
}
