//! What stands around what is drawn: handles, the work origin and its axes, the scale.

use super::{ARM, AXIS_NAME, HANDLE, Painter, axes_corner, spread_handles};
use crate::view::camera::{BAR_CORNER, Camera};
use crate::view::flat::Spot;
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
    fn grip(&self, [x, y]: Spot, half: f64, colour: &str, width: f64) {
        let c = &self.context;
        c.set_fill_style_str(&self.theme.background);
        c.fill_rect(x - half, y - half, 2.0 * half, 2.0 * half);
        c.set_stroke_style_str(colour);
        c.set_line_width(width);
        self.dash(&[]);
        c.stroke_rect(x - half, y - half, 2.0 * half, 2.0 * half);
    }

    fn handle(&self, at: Spot, direction: Spot) {
        let end = [at[0] + direction[0] * ARM, at[1] - direction[1] * ARM];
        self.segment(at, end, &self.theme.actual, 1.0, &[3.0, 3.0]);
        self.disc(end, HANDLE, &self.theme.background);
        self.circle(end, HANDLE, &self.theme.actual, 2.0);
        self.grip(at, HANDLE, &self.theme.actual, 2.0);
    }

    /// The work origin as a quartered disc with the name of its offset, or at the edge of the picture an arrow to it.
    fn origin(&self, scene: &Scene, camera: &Camera, name: &str, layout: &Layout<'_>) {
        let c = &self.context;
        let [width, height] = camera.size;
        let o = camera.pixel(scene.origin);
        let within = |x: f64, size: f64| crate::num::within(x, 14.0, (size - 14.0).max(14.0));
        let inside = [within(o[0], width), within(o[1], height)];
        let (dx, dy) = (o[0] - inside[0], o[1] - inside[1]);
        let away = dx.hypot(dy);
        c.set_text_align("left");
        if away > 0.0 {
            self.head(inside, [dx / away, dy / away], 12.0, &self.theme.text);
            self.label(name, [inside[0].min(width - 100.0) + 10.0, inside[1].min(height - 30.0) + 16.0]);
            c.set_text_align("center");
            return;
        }
        self.disc(o, 6.0, &self.theme.background);
        c.set_fill_style_str(&self.theme.text);
        for quarter in [0.0, std::f64::consts::PI] {
            c.begin_path();
            c.move_to(o[0], o[1]);
            let _ = c.arc(o[0], o[1], 6.0, quarter, quarter + std::f64::consts::FRAC_PI_2);
            c.fill();
        }
        self.circle(o, 6.0, &self.theme.text, 1.5);
        c.set_text_align("center");
        if name.is_empty() {
            return;
        }
        // On its own ground.
        let half = [c.measure_text(name).map_or(20.0, |m| m.width() / 2.0) + 3.0, 8.0];
        let [x, y] = layout.origin(o, half).middle;
        c.set_fill_style_str(&self.theme.background);
        c.fill_rect(x - half[0], y - half[1], 2.0 * half[0], 2.0 * half[1]);
        c.set_fill_style_str(&self.theme.text);
        let _ = c.fill_text(name, x, y);
    }

    /// The work axes as arrows in the corner, and the work origin.
    pub(super) fn axes(&self, scene: &Scene, camera: &Camera, name: &str, layout: &Layout<'_>) {
        // `G54 X0 Y0`: of the axes that are seen.
        let mut place = name.to_owned();
        for (axis, direction) in scene.axes {
            if direction[0].hypot(direction[1]) >= 0.1 {
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
            if direction[0].hypot(direction[1]) < 0.1 {
                continue;
            }
            let tip = |far: f64| [corner[0] + direction[0] * far, corner[1] - direction[1] * far];
            self.segment(corner, tip(20.0), &self.theme.text, 1.5, &[]);
            self.label(name, tip(AXIS_NAME));
        }
    }

    /// A bar of a round length in units of so many millimetres, so that sizes can be judged.
    pub(super) fn scale_bar(&self, camera: &Camera, unit: f64, comma: bool) {
        let length = camera.bar(unit);
        let right = camera.size[0] - BAR_CORNER;
        let left = right - length * unit * camera.scale;
        let y = camera.size[1] - BAR_CORNER;
        for (a, b) in [([left, y], [right, y]), ([left, y - 4.0], [left, y + 4.0]), ([right, y - 4.0], [right, y + 4.0])] {
            self.segment(a, b, &self.theme.text, 1.0, &[]);
        }
        let name = if unit == 1.0 { "mm" } else { "inch" };
        let number = crate::num::decimal(length, 6);
        let number = if comma { number.replace('.', ",") } else { number };
        self.label(&format!("{number} {name}"), [(left + right) / 2.0, y - 10.0]);
    }
}
