//! What stands around what is drawn: handles, the work origin and its axes, the scale.

use super::{AXIS_NAME, HANDLE, Painter, axes_corner, spread_handles, turning};
use crate::geom::Vec2;
use crate::view::camera::{BAR_CORNER, Camera, DOWNWARDS};
use crate::view::layout::Layout;
use crate::view::scene::Scene;

impl Painter {
    /// What can be gripped: the angles of the touches, and the virtual part, faintly while it is not `held` to lie elsewhere.
    pub(super) fn handles(&self, scene: &Scene, camera: &Camera, held: bool) {
        if let (Some([start, sweep]), Some((center, ..))) = (spread_handles(scene, camera), scene.spread) {
            let center = camera.pixel(center);
            for (handle, width) in [(start, 2.0), (sweep, 1.0)] {
                self.segment(center, handle, &self.theme.ball, 1.0, &[2.0, 4.0]);
                // No circle: those are balls.
                self.grip(handle, HANDLE * 0.8, &self.theme.ball, width);
            }
        }
        if let Some((origin, direction)) = scene.handle {
            self.context.set_global_alpha(if held { 1.0 } else { 0.35 });
            self.handle(camera.pixel(origin), direction);
            self.context.set_global_alpha(1.0);
        }
    }

    /// A square to be gripped.
    fn grip(&self, at: Vec2, half: f64, colour: &str, width: f64) {
        let c = &self.context;
        c.set_fill_style_str(&self.theme.background);
        c.fill_rect(at.x - half, at.y - half, 2.0 * half, 2.0 * half);
        c.set_stroke_style_str(colour);
        c.set_line_width(width);
        self.dash(&[]);
        c.stroke_rect(at.x - half, at.y - half, 2.0 * half, 2.0 * half);
    }

    fn handle(&self, at: Vec2, direction: Vec2) {
        let end = turning(at, direction);
        self.segment(at, end, &self.theme.actual, 1.0, &[3.0, 3.0]);
        self.disc(end, HANDLE, &self.theme.background);
        self.circle(end, HANDLE, &self.theme.actual, 2.0);
        self.grip(at, HANDLE, &self.theme.actual, 2.0);
    }

    /// The work origin as a quartered disc with the name of its offset, or at the edge of the picture an arrow to it.
    fn origin(&self, scene: &Scene, camera: &Camera, name: &str, layout: &Layout<'_>) {
        let c = &self.context;
        let o = camera.pixel(scene.origin);
        let edge = Vec2::splat(14.0);
        let inside = o.min((camera.size - edge).max(edge)).max(edge);
        c.set_text_align("left");
        if let Some(away) = (o - inside).try_normalize() {
            self.head(inside, away, 12.0, &self.theme.text);
            self.label(name, inside.min(camera.size - Vec2::new(100.0, 30.0)) + Vec2::new(10.0, 16.0));
            c.set_text_align("center");
            return;
        }
        self.disc(o, 6.0, &self.theme.background);
        c.set_fill_style_str(&self.theme.text);
        for quarter in [0.0, std::f64::consts::PI] {
            c.begin_path();
            c.move_to(o.x, o.y);
            let _ = c.arc(o.x, o.y, 6.0, quarter, quarter + std::f64::consts::FRAC_PI_2);
            c.fill();
        }
        self.circle(o, 6.0, &self.theme.text, 1.5);
        c.set_text_align("center");
        if name.is_empty() {
            return;
        }
        // On its own ground.
        let half = Vec2::new(c.measure_text(name).map_or(20.0, |m| m.width() / 2.0) + 3.0, 8.0);
        let Vec2 { x, y } = layout.origin(o, half).middle;
        c.set_fill_style_str(&self.theme.background);
        c.fill_rect(x - half.x, y - half.y, 2.0 * half.x, 2.0 * half.y);
        c.set_fill_style_str(&self.theme.text);
        let _ = c.fill_text(name, x, y);
    }

    /// The work axes as arrows in the corner, and the work origin.
    pub(super) fn axes(&self, scene: &Scene, camera: &Camera, name: &str, layout: &Layout<'_>) {
        // `G54 X0 Y0`: of the axes that are seen.
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
            self.segment(corner, tip(20.0), &self.theme.text, 1.5, &[]);
            self.label(name, tip(AXIS_NAME));
        }
    }

    /// A bar of a round length in units of so many millimetres, so that sizes can be judged.
    pub(super) fn scale_bar(&self, camera: &Camera, unit: f64, comma: bool) {
        let length = camera.bar(unit);
        let right = camera.size - BAR_CORNER;
        let left = right - Vec2::X * (length * unit * camera.scale);
        let up = Vec2::Y * 4.0;
        for (a, b) in [(left, right), (left - up, left + up), (right - up, right + up)] {
            self.segment(a, b, &self.theme.text, 1.0, &[]);
        }
        let name = if unit == 1.0 { "mm" } else { "inch" };
        let number = crate::num::decimal(length, 6);
        let number = if comma { number.replace('.', ",") } else { number };
        self.label(&format!("{number} {name}"), (left + right) / 2.0 - Vec2::Y * 10.0);
    }
}
