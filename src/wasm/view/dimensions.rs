//! Dimensions of a picture: their views, their positions, and the text at a pixel.

use js_sys::Array;
use wasm_bindgen::prelude::*;

use super::View;
use crate::border::coded::decoded;
use crate::form::Value;
use crate::geom::Vec2;
use crate::job::{self, NumberField};
use crate::view::label_box::LabelBox;
use crate::view::layout::PlacedDimension;
use crate::view::scene::{Projection, Scene};
use crate::wasm::Last;

#[wasm_bindgen]
impl View {
    /// View that shows a field's dimension in true length, or the position, height or rotation that it gives: the current view if it does; `undefined` for any
    /// other field.
    #[wasm_bindgen(js_name = viewOf)]
    pub fn view_of(&self, field: &str) -> Option<String> {
        let planned = self.held()?.last.planned.in_hand(self.active_cycle);
        let names = ["top", "front", "side"];
        let now = names
            .into_iter()
            .find(|name| Projection::named(name) == Some(self.projection));
        let found = now
            .into_iter()
            .chain(names)
            .find(|name| Projection::named(name).is_some_and(|view| planned.shows(field, view)));
        found.map(str::to_owned)
    }

    /// Path of the field whose dimension or angle is written at a pixel.
    #[wasm_bindgen(js_name = dimensionAt)]
    pub fn dimension_at(&self, x: f64, y: f64) -> Option<String> {
        let scene = &self.shown.as_ref()?.scene;
        let layout = self.camera.layout(scene, self.field.as_deref());
        let near = |plate: &LabelBox| plate.covers(Vec2::new(x, y), 2.0);
        let dimension = layout
            .dimensions
            .iter()
            .find(|placed| near(&placed.name))
            .map(|placed| placed.drawn.field);
        let angle = || {
            layout
                .arcs
                .iter()
                .find(|arc| arc.name.as_ref().is_some_and(near))
                .map(|arc| arc.angle.field)
        };
        dimension.or_else(angle).map(str::to_owned)
    }

    /// Lines of the drawn dimensions: for each a list of the path of its field and the pixels of its ends, `[field, x, y, x, y]`.
    #[wasm_bindgen(js_name = dimensionLines)]
    pub fn dimension_lines(&self) -> Array {
        self.shown
            .as_ref()
            .map_or_else(Array::new, |shown| self.lines_of(&shown.scene))
    }

    /// Grips an end, 0 or 1, of a dimension line at a pixel; the encoded job is the shown one. False if no drag moves it: of some dimensions only one end
    /// moves.
    #[wasm_bindgen(js_name = gripEndCoded)]
    pub fn grip_end(
        &mut self,
        codes: &[f64],
        text: &str,
        field: &str,
        end: usize,
        x: f64,
        y: f64,
    ) -> bool {
        self.end = self.end_of(&decoded(codes, text), field, end.min(1), Vec2::new(x, y));
        self.end.is_some()
    }

    /// Value of the gripped dimension's field with the end under a pixel, as exact as a pixel, in the job's units.
    #[wasm_bindgen(js_name = dragEnd)]
    pub fn drag_end(&self, x: f64, y: f64) -> Option<f64> {
        let End { field, at, slope } = self.end.as_ref()?;
        let change = (Vec2::new(x, y) - *at).dot(*slope) / slope.length_squared();
        Some(field.changed(change, slope.length()))
    }
}

/// The gripped end of a dimension line.
#[derive(Debug)]
pub(super) struct End {
    field: NumberField,
    /// Pixel at which it was gripped.
    at: Vec2,
    /// Movement of the end for a growing value, pixels per unit.
    slope: Vec2,
}

impl View {
    /// The end of a line, and its movement: the job itself determines how its dimensions depend on each other, so it is planned with a value a little larger,
    /// or smaller if that has errors.
    fn end_of(&self, job: &Value, path: &str, end: usize, at: Vec2) -> Option<End> {
        let field = NumberField::of(job, path, self.active_cycle)?;
        let line = |scene: &Scene| {
            let layout = self.camera.layout(scene, self.field.as_deref());
            layout
                .dimensions
                .iter()
                .find(|placed| placed.drawn.field == path)
                .map(|placed| placed.line)
        };
        let now = line(&self.shown.as_ref()?.scene)?;
        let moved = |change: f64| {
            let planned = job::planned(&job::with_number(
                job,
                path,
                self.active_cycle,
                field.value + change,
            ))?;
            let other = self.build(Last::of_none(planned));
            Some((line(&other.scene)?[end] - now[end]) / change)
        };
        let moved = moved(field.little()).or_else(|| moved(-field.little()))?;
        // Movement across its own direction only makes room for other lines.
        let slope = moved.project_onto(now[1] - now[0]);
        (slope.length() > 0.05).then_some(End { field, at, slope })
    }

    fn lines_of(&self, scene: &Scene) -> Array {
        let list = |placed: PlacedDimension<'_>| {
            let list = Array::of1(&JsValue::from_str(placed.drawn.field));
            for x in placed.line.iter().flat_map(|end| end.to_array()) {
                list.push(&JsValue::from_f64(x));
            }
            list
        };
        self.camera
            .layout(scene, self.field.as_deref())
            .dimensions
            .into_iter()
            .map(list)
            .collect()
    }
}
