//! The picture: a scene in mm, a camera, and (in a browser) the canvas they are drawn on.

pub mod camera;
pub mod dimension;
pub mod lengths;
pub mod material;
pub mod scene;
mod svg;

pub use svg::{Legend, svg};

#[cfg(target_arch = "wasm32")]
pub(crate) mod canvas;
