//! Surroundings of the drawing: handles, the work origin and its axes, the scale.

use super::{AXIS_NAME, BOLD, HANDLE, Painter, axes_corner, spread_handles, turning};
use crate::geom::Vec2;
use crate::view::camera::{BAR_REACH, Camera, DOWNWARDS};
use crate::view::layout::Layout;
use crate::view::scene::{Distance, Scene};
use crate::view::style::Colour;
use crate::view::style::screen::{ARM, SPREAD};

impl Painter {
    /// The handles: angles of the touches, and the virtual part.
    pub(super) fn handles(&self, scene: &Scene, camera: &Camera) {
        if let (Some([start, sweep]), Some((center, ..))) =
            (spread_handles(scene, camera), scene.spread)
        {
            let center = camera.pixel(center);
            for (handle, width) in [(start, 2.0), (sweep, 1.0)] {
                self.dashes(center, handle, &SPREAD);
                // Squares, since circles are balls.
                self.grip(handle, HANDLE * 0.8, Colour::Ball, width);
            }
        }
        if let Some((origin, direction)) = scene.handle {
            self.handle(camera.pixel(origin), direction);
        }
    }

    /// Rotation of the feature: from the abscissa to its first direction.
    pub(super) fn turn(&self, scene: &Scene, camera: &Camera) {
        let Some((origin, direction)) = scene.turn else {
            return;
        };
        let at = camera.pixel(origin);
        let (far, angle) = (72.0, direction.to_angle());
        self.segment(at, at + Vec2::X * far, Colour::Highlight, 1.0);
        let end = at + direction * DOWNWARDS * far;
        self.segment(at, end, Colour::Highlight, 3.0);
        self.head(end, direction * DOWNWARDS, 12.0, Colour::Highlight);
        self.context.begin_path();
        let _ =
            self.context
                .arc_with_anticlockwise(at.x, at.y, far * 0.7, 0.0, -angle, angle > 0.0);
        self.stroke(Colour::Highlight, 2.0);
    }

    /// A square handle.
    fn grip(&self, at: Vec2, half: f64, colour: Colour, width: f64) {
        self.plate(
            at,
            Vec2::splat(half),
            Colour::Background,
            Some((colour, width)),
        );
    }

    fn handle(&self, at: Vec2, direction: Vec2) {
        let end = turning(at, direction);
        self.dashes(at, end, &ARM);
        self.disc(end, HANDLE, Colour::Background);
        self.circle(end, HANDLE, Colour::Actual, 2.0);
        self.grip(at, HANDLE, Colour::Actual, 2.0);
    }

    /// The work origin as a quartered disc with the name of its offset, or an arrow to it at the edge of the picture.
    fn origin(&self, scene: &Scene, camera: &Camera, name: &str, layout: &Layout<'_>) {
        let c = &self.context;
        let o = camera.pixel(scene.origin);
        let edge = Vec2::splat(14.0);
        let inside = o.min((camera.size - edge).max(edge)).max(edge);
        c.set_text_align("left");
        if let Some(away) = (o - inside).try_normalize() {
            self.head(inside, away, 12.0, Colour::Text);
            self.label(
                name,
                inside.min(camera.size - Vec2::new(100.0, 30.0)) + Vec2::new(10.0, 16.0),
            );
            c.set_text_align("center");
            return;
        }
        self.disc(o, 6.0, Colour::Background);
        for quarter in [0.0, std::f64::consts::PI] {
            c.begin_path();
            c.move_to(o.x, o.y);
            let _ = c.arc(
                o.x,
                o.y,
                6.0,
                quarter,
                quarter + std::f64::consts::FRAC_PI_2,
            );
            self.fill(Colour::Text);
        }
        self.circle(o, 6.0, Colour::Text, 1.5);
        c.set_text_align("center");
        if name.is_empty() {
            return;
        }
        // On its own background.
        let half = Vec2::new(
            c.measure_text(name).map_or(20.0, |m| m.width() / 2.0) + 3.0,
            8.0,
        );
        let middle = layout.origin(o, half).middle;
        self.plate(middle, half, Colour::Background, None);
        c.set_fill_style_str(self.theme.colour(Colour::Text));
        let _ = c.fill_text(name, middle.x, middle.y);
    }

    /// The work axes as arrows in the corner, and the work origin.
    pub(super) fn axes(&self, scene: &Scene, camera: &Camera, name: &str, layout: &Layout<'_>) {
        // `G54 X0 Y0`: with the visible axes.
        let mut place = name.to_owned();
        for (axis, direction) in scene.axes {
            if direction.length() >= 0.1 {
                if !place.is_empty() {
                    place.push(' ');
                }
                place.push_str(axis);
                place.push('0');
            }
        }
        self.origin(scene, camera, &place, layout);
        let corner = axes_corner(camera);
        for (name, direction) in scene.axes {
            if direction.length() < 0.1 {
                continue;
            }
            let tip = |far: f64| corner + direction * DOWNWARDS * far;
            self.segment(corner, tip(20.0), Colour::Text, 1.5);
            self.label(name, tip(AXIS_NAME));
        }
    }

    /// Names the distances that relations measure, where the view shows their true length. `unit`: mm per unit of the job.
    pub(super) fn distances(
        &self,
        scene: &Scene,
        camera: &Camera,
        (unit, comma): (f64, bool),
        layout: &Layout<'_>,
    ) {
        self.font(BOLD);
        let places = if unit == 1.0 { 3 } else { 4 };
        for Distance { name, ends, length } in &scene.distances {
            let is_true = (ends[0].distance(ends[1]) - length).abs() < 1e-3 * length;
            let text = format!("{name} {}", number(length / unit, places, comma));
            let half = Vec2::new(3.6 * text.len() as f64, 8.0);
            let ends = ends.map(|end| camera.pixel(end));
            if !is_true || ends[0].distance(ends[1]) < 2.0 * half.x {
                continue;
            }
            if let Some(middle) = layout.distance(ends, half) {
                self.label(&text, middle);
            }
        }
    }

    /// A bar with a round length as a scale. `unit` is mm in a unit.
    pub(super) fn scale_bar(&self, camera: &Camera, unit: f64, comma: bool, layout: &Layout<'_>) {
        let length = camera.bar(unit);
        let half = Vec2::new(
            (length * unit * camera.scale).max(48.0) / 2.0,
            BAR_REACH / 2.0,
        );
        let Some(middle) = layout.bar(camera, half) else {
            return;
        };
        let right = middle + Vec2::new(length * unit * camera.scale / 2.0, half.y - 4.0);
        let left = right - Vec2::X * (length * unit * camera.scale);
        let up = Vec2::Y * 4.0;
        for (a, b) in [
            (left, right),
            (left - up, left + up),
            (right - up, right + up),
        ] {
            self.segment(a, b, Colour::Text, 1.0);
        }
        let name = if unit == 1.0 { "mm" } else { "inch" };
        self.label(
            &format!("{} {name}", number(length, 6, comma)),
            (left + right) / 2.0 - Vec2::Y * 10.0,
        );
    }
}

/// A number with at most `places` decimals, in the notation of the page's language.
fn number(value: f64, places: usize, comma: bool) -> String {
    let number = crate::num::decimal(value, places);
    if comma {
        number.replace('.', ",")
    } else {
        number
    }
}
