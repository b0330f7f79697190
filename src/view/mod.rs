//! The picture: a scene in mm, a camera, and (in a browser) the canvas they are drawn on.

pub mod camera;
pub mod dimension;
pub mod display;
pub mod label_box;
pub mod layout;
pub mod lengths;
pub mod material;
pub mod numbers;
pub mod scene;
pub mod style;
mod svg;
pub mod walls;

pub use svg::{Legend, svg};

use crate::geom::Vec2;

#[cfg(target_arch = "wasm32")]
pub(crate) mod canvas;

/// Ends of a line in a fixed order, whatever its direction: so its dashes have the same positions there and back.
fn forwards(from: Vec2, to: Vec2) -> (Vec2, Vec2) {
    if (from.x, from.y) <= (to.x, to.y) {
        (from, to)
    } else {
        (to, from)
    }
}

/// Name and value of a dimension: drawn separately, so that "Width 2" and 50 are not read as one number.
fn halves(name: &str) -> (&str, &str) {
    name.rsplit_once(' ').unwrap_or(("", name))
}
