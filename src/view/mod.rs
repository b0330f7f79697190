//! The picture: a scene in mm, a camera, and (in a browser) the canvas they are drawn on.

pub mod camera;
pub mod dimension;
pub mod flat;
pub mod layout;
pub mod lengths;
pub mod material;
pub mod numbers;
pub mod plate;
pub mod scene;
mod svg;

pub use svg::{Legend, svg};

#[cfg(target_arch = "wasm32")]
pub(crate) mod canvas;

/// The ends of a line in one order, whichever way it is gone: so its dashes lie in the same places there and back.
fn forwards(from: flat::Spot, to: flat::Spot) -> (flat::Spot, flat::Spot) {
    if (from[0], from[1]) <= (to[0], to[1]) { (from, to) } else { (to, from) }
}

/// What a dimension is called, and its value: drawn apart, so that "Width 2" and 50 are not read as one number.
fn halves(name: &str) -> (&str, &str) {
    name.rsplit_once(' ').unwrap_or(("", name))
}
