//! Maps the picture plane to pixels: fit, zoom, pan. Pixels are CSS pixels, y downwards.

use crate::geom::Vec2;

/// A window on the picture plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Pixels per mm.
    pub scale: f64,
    /// Point of the picture plane in the middle of the window, mm.
    pub middle: Vec2,
    /// Width and height of the window.
    pub size: Vec2,
}

/// Margin around a fitted scene, pixels: for axes and numbers.
pub const MARGIN: f64 = 36.0;
/// Margin in a small drawing without them.
pub const SMALL_MARGIN: f64 = 8.0;
/// Margin for dimensions around the scene; less in a small picture.
pub const DIMENSION_MARGIN: f64 = 84.0;
/// Largest share of the picture's smaller side for this margin.
const SHARE: f64 = 0.14;
/// Distance of a dimension line from the part, pixels; less in a small picture.
const STANDS_OFF: f64 = 46.0;

/// Position of the work axes from the lower left corner, pixels.
pub const AXES_CORNER: f64 = 34.0;
/// Extent of the work axes with their names, pixels.
pub const AXES_REACH: f64 = 36.0;
/// Distance of the scale bar from the lower right corner, pixels.
pub const BAR_CORNER: f64 = 16.0;
/// Height of the scale bar with its length above it, pixels.
pub const BAR_REACH: f64 = 34.0;
/// Size of the upper right corner where pages put the view cube, pixels.
pub const CUBE_CORNER: f64 = 112.0;

/// Factor from directions on the picture plane to those in pixels and back: pixels grow downwards.
pub const DOWNWARDS: Vec2 = Vec2::new(1.0, -1.0);

impl Camera {
    /// A window that shows `bounds` with a margin in pixels.
    pub fn fit(size: Vec2, [low, high]: [Vec2; 2], margin: f64) -> Self {
        let room =
            (size - 2.0 * margin).max(Vec2::splat(20.0)) / (high - low).max(Vec2::splat(1e-3));
        Camera {
            scale: room.min_element(),
            middle: (low + high) / 2.0,
            size,
        }
    }

    /// Margin around a scene for its dimensions, pixels.
    pub fn dimension_margin(&self) -> f64 {
        crate::num::within(self.size.min_element() * SHARE, 30.0, DIMENSION_MARGIN)
    }

    /// Distance of a dimension line from the part, pixels.
    pub fn stands_off(&self) -> f64 {
        STANDS_OFF * self.dimension_margin() / DIMENSION_MARGIN
    }

    /// A round length for the scale bar in units of the job. `unit` is mm in a unit.
    pub fn bar(&self, unit: f64) -> f64 {
        let most = 110.0 / self.scale / unit;
        let power = 10f64.powi(most.log10().floor() as i32);
        [5.0, 2.0, 1.0]
            .iter()
            .map(|step| step * power)
            .find(|length| *length <= most)
            .unwrap_or(power)
    }

    /// Pixel of a point.
    pub fn pixel(&self, spot: Vec2) -> Vec2 {
        self.size / 2.0 + (spot - self.middle) * DOWNWARDS * self.scale
    }

    /// Point at a pixel.
    pub fn spot(&self, pixel: Vec2) -> Vec2 {
        self.middle + (pixel - self.size / 2.0) * DOWNWARDS / self.scale
    }

    /// Zooms in by `factor`; the point at `pixel` stays there.
    pub fn zoom(&mut self, factor: f64, pixel: Vec2) {
        let before = self.spot(pixel);
        self.scale = crate::num::within(self.scale * factor, 1e-4, 1e6);
        self.middle = self.middle + before - self.spot(pixel);
    }

    /// Drags the picture by pixels.
    pub fn pan(&mut self, by: Vec2) {
        self.middle -= by * DOWNWARDS / self.scale;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fitted_scene_lies_inside_and_zoom_keeps_the_spot_under_the_pointer() {
        let mut camera = Camera::fit(
            Vec2::new(400.0, 300.0),
            [Vec2::new(-40.0, -25.0), Vec2::new(40.0, 25.0)],
            MARGIN,
        );
        let corner = camera.pixel(Vec2::new(-40.0, 25.0));
        assert!(
            (corner.x - MARGIN).abs() < 1e-9 && corner.y >= MARGIN,
            "{corner:?}"
        );
        let pixel = Vec2::new(100.0, 50.0);
        let before = camera.spot(pixel);
        camera.zoom(3.0, pixel);
        assert!(before.distance(camera.spot(pixel)) < 1e-9);
        camera.pan(Vec2::new(10.0, -5.0));
        assert!(before.distance(camera.spot(Vec2::new(110.0, 45.0))) < 1e-9);
    }
}
