//! Handles of a picture: their positions, and the values that a drag gives.

use js_sys::{Array, Object};
use wasm_bindgen::prelude::*;

use super::{ShownScene, View};
use crate::geom::{Rigid, Vec2, Vec3};
use crate::job::PlannedJob;
use crate::view::canvas::{spread_handles, turning};
use crate::wasm::set;

#[wasm_bindgen]
impl View {
    /// The handle within `reach` pixels of a position (default 14): `shift` or `turn` of the virtual part, `start` or `sweep` of the touches' angles, or
    /// `undefined`.
    #[wasm_bindgen(js_name = handleAt)]
    pub fn handle_at(&self, x: f64, y: f64, reach: Option<f64>) -> Option<String> {
        let near = |at: Vec2| at.distance(Vec2::new(x, y)) <= reach.unwrap_or(14.0);
        self.handles()
            .into_iter()
            .find(|(_, at)| near(*at))
            .map(|(handle, _)| handle.to_owned())
    }

    /// Pixel of a handle, `[x, y]`: an offset at gripping is kept while dragging.
    #[wasm_bindgen(js_name = handleSpot)]
    pub fn handle_spot(&self, handle: &str) -> Option<Vec<f64>> {
        self.handles()
            .into_iter()
            .find(|(name, _)| *name == handle)
            .map(|(_, at)| at.to_array().to_vec())
    }

    /// Path of the job field that a `start` or `sweep` handle sets.
    #[wasm_bindgen(js_name = handleField)]
    pub fn handle_field(&self, handle: &str) -> Option<String> {
        let spread = self
            .held()?
            .last
            .planned
            .in_hand(self.active_cycle)
            .path
            .feature
            .two_circles()?
            .spread?;
        let [start, sweep] = spread.fields;
        match handle {
            "start" => Some(start.to_owned()),
            "sweep" => Some(sweep.to_owned()),
            _ => None,
        }
    }

    /// Angle in whole degrees for a `start` or `sweep` handle at a pixel. A spread keeps its sense.
    #[wasm_bindgen(js_name = dragAngle)]
    pub fn drag_angle(&self, handle: &str, x: f64, y: f64) -> Option<f64> {
        let (center, _, start, sweep) = self.shown.as_ref()?.scene.spread?;
        let angle = (self.camera.spot(Vec2::new(x, y)) - center)
            .to_angle()
            .to_degrees();
        if handle == "start" {
            return Some(crate::num::wrap_degrees(angle.round()));
        }
        let turn = (angle - start.to_degrees()).round().rem_euclid(360.0);
        Some(match (sweep > 0.0, turn == 0.0) {
            (true, true) => 360.0,
            (true, false) => turn,
            (false, true) => -359.0,
            (false, false) => turn - 360.0,
        })
    }

    /// Displacement of the virtual part for a handle at a pixel: `{ offset, rotation }` in the job's units. A rotation keeps the position of the feature's
    /// origin.
    #[wasm_bindgen(js_name = dragPart)]
    pub fn drag_part(&self, handle: &str, x: f64, y: f64) -> Result<JsValue, JsValue> {
        let Some(held) = self.held() else {
            return Ok(JsValue::NULL);
        };
        let spot = self.camera.spot(Vec2::new(x, y));
        let [a, o, _] = held.plane.axes();
        let PlannedJob { job, path, .. } = held.last.planned.in_hand(self.active_cycle);
        let (mut offset, mut turn) = (job.placement.rigid.point(Vec3::ZERO), job.placement.turn);
        let place = |offset: Vec3, turn: f64| {
            Rigid::new(held.plane, offset, turn.to_radians()).point(path.frame.origin)
        };
        let now = place(offset, turn);
        if handle == "turn" {
            let handle = self.shown.as_ref().and_then(|shown| shown.scene.handle);
            let nominal = handle.map_or(0.0, |(_, d)| d.to_angle().to_degrees()) - turn;
            let angle = (spot - Vec2::new(now[a], now[o])).to_angle().to_degrees();
            turn = crate::num::wrap_degrees(((angle - nominal) * 100.0).round() / 100.0);
            offset += now - place(offset, turn);
        } else {
            offset[a] += spot.x - now[a];
            offset[o] += spot.y - now[o];
        }
        let rounded = |mm: f64| (mm / job.scale * 1000.0).round() / 1000.0;
        let result = Object::new();
        let list: Array = offset
            .to_array()
            .iter()
            .map(|mm| JsValue::from_f64(rounded(*mm)))
            .collect();
        set(&result, "offset", &list);
        set(&result, "rotation", &JsValue::from_f64(turn));
        Ok(result.into())
    }
}

impl View {
    /// Handles and their pixels, upper ones first.
    fn handles(&self) -> Vec<(&'static str, Vec2)> {
        let mut handles = Vec::new();
        let Some(ShownScene { scene, .. }) = self.shown.as_ref().filter(|_| !self.painter.still)
        else {
            return handles;
        };
        if let Some([start, sweep]) = spread_handles(scene, &self.camera) {
            handles.extend([("sweep", sweep), ("start", start)]);
        }
        if let Some((origin, direction)) = scene.handle {
            let shift = self.camera.pixel(origin);
            handles.extend([("shift", shift), ("turn", turning(shift, direction))]);
        }
        handles
    }
}
