//! From the picture plane to pixels: fit, zoom, pan. Pixels are CSS pixels, y downwards.

use crate::view::flat::Spot;

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

/// Where the work axes are drawn, pixels from the lower left corner.
pub const AXES_CORNER: f64 = 34.0;
/// How far the names of the work axes reach from their corner, pixels.
pub const AXES_REACH: f64 = 36.0;
/// How far the scale bar stands from the lower right corner, pixels.
pub const BAR_CORNER: f64 = 16.0;
/// How high the scale bar reaches with its length above it, pixels.
pub const BAR_REACH: f64 = 34.0;
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
