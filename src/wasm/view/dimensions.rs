//! The dimensions of a picture: from where they are seen, where they stand, what is written at a pixel.

use js_sys::Array;
use wasm_bindgen::prelude::*;

use super::View;
use crate::geom::Vec2;
use crate::view::layout::Placed;
use crate::view::plate::Plate;
use crate::view::scene::{Projection, Scene};

#[wasm_bindgen]
impl View {
    /// The view that shows a field's dimension in true length, or the position, height or turn that it gives: the present view where that does;
    /// nothing for any other field.
    #[wasm_bindgen(js_name = lookFor)]
    pub fn look_for(&self, field: &str) -> Option<String> {
        let planned = &self.held()?.last.planned;
        let names = ["top", "front", "side"];
        let now = names.into_iter().find(|name| Projection::named(name) == Some(self.projection));
        let found =
            now.into_iter().chain(names).find(|name| Projection::named(name).is_some_and(|view| planned.shows(field, view)));
        found.map(str::to_owned)
    }

    /// The path of the field whose dimension or angle is written at a pixel.
    #[wasm_bindgen(js_name = dimensionAt)]
    pub fn dimension_at(&self, x: f64, y: f64) -> Option<String> {
        let scene = &self.shown.as_ref()?.scene;
        let layout = self.camera.layout(scene, self.field.as_deref());
        let near = |plate: &Plate| plate.covers(Vec2::new(x, y), 2.0);
        let dimension = layout.dimensions.iter().find(|placed| near(&placed.name)).map(|placed| placed.drawn.field);
        let angle = || layout.arcs.iter().find(|arc| arc.name.as_ref().is_some_and(near)).map(|arc| arc.angle.field);
        dimension.or_else(angle).map(str::to_owned)
    }

    /// The lines of the dimensions that are drawn: a list each, of its field's path and the pixels of its two ends, `[field, x, y, x, y]`.
    #[wasm_bindgen(js_name = dimensionLines)]
    pub fn dimension_lines(&self) -> Array {
        self.shown.as_ref().map_or_else(Array::new, |shown| self.lines_of(&shown.scene))
    }

    /// The same of another coded job, as it would be seen here: where they would move to. Nothing for a job with errors.
    #[wasm_bindgen(js_name = dimensionLinesCoded)]
    pub fn dimension_lines_of(&self, codes: &[f64], text: &str) -> Array {
        let other = crate::wasm::planned(codes, text).map(|last| self.build(last));
        other.map_or_else(Array::new, |other| self.lines_of(&other.scene))
    }
}

impl View {
    fn lines_of(&self, scene: &Scene) -> Array {
        let list = |placed: Placed<'_>| {
            let list = Array::of1(&JsValue::from_str(placed.drawn.field));
            for x in placed.line.iter().flat_map(|end| end.to_array()) {
                list.push(&JsValue::from_f64(x));
            }
            list
        };
        self.camera.layout(scene, self.field.as_deref()).dimensions.into_iter().map(list).collect()
    }
}
