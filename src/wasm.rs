//! The same for JavaScript. JavaScript sees plain objects only; the only module that names `wasm_bindgen` besides the canvas.
//!
//! Jobs come in through a walk that survives anything JavaScript can hand over: cycles, getters that throw, lists of any
//! length. A refused job is thrown as an `Error` named `JobError` with its `findings`; the package makes a class of it.

use js_sys::{Array, Float64Array, Int32Array, Object, Reflect, Uint8Array};
use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::job::{self, JobError, Move};
use crate::spec::{Finding, Level, Value};
use crate::tool_length;
use crate::view::camera::Camera;
use crate::view::canvas::{ARM, Painter, Theme, spread_handles};
use crate::view::scene::{self, Actual, Projection, Scene, Spot};

/// The most values a job may hold, and how deep they may lie. A job has about a hundred.
const MOST_VALUES: usize = 20_000;
const DEEPEST: usize = 16;

/// Everything a form needs.
#[wasm_bindgen]
pub fn catalog() -> Result<JsValue, JsValue> {
    to_js(&job::catalog())
}

/// A complete, valid job of a type.
#[wasm_bindgen(js_name = defaultJob)]
pub fn default_job(kind: &JsValue) -> Result<JsValue, JsValue> {
    let key = kind.as_string().unwrap_or_default();
    job::default_job(&key).map(|value| value_to_js(&value)).ok_or_else(|| {
        let message = "There is no cycle of this type; catalog() lists them";
        thrown(&[Finding::new(Level::Error, "unknown-value", "cycle.type", message)], message)
    })
}

/// Everything that is wrong, unusual or worth knowing.
#[wasm_bindgen]
pub fn check(job: &JsValue) -> Result<JsValue, JsValue> {
    to_js(&job::check(&from_js(job)))
}

/// The whole plan; throws where the job has an error.
#[wasm_bindgen]
pub fn plan(job: &JsValue) -> Result<JsValue, JsValue> {
    to_js(&job::plan(&from_js(job)).map_err(refused)?)
}

/// The results from points that a machine really measured.
#[wasm_bindgen]
pub fn evaluate(job: &JsValue, measured: &JsValue) -> Result<JsValue, JsValue> {
    to_js(&job::evaluate(&from_js(job), &from_js(measured)).map_err(refused)?)
}

/// A job from text: job JSON or a program. Gives `{ job, findings }`; throws where no job can be made of it.
#[wasm_bindgen(js_name = importJob)]
pub fn import_job(text: &JsValue) -> Result<JsValue, JsValue> {
    let text = text.as_string().unwrap_or_default();
    let (job, findings) = match js_sys::JSON::parse(&text) {
        // What JSON says is a job is taken as it is: nothing of a user's work is dropped, the check will speak.
        Ok(job) if job.is_object() => {
            let findings = job::check(&from_js(&job));
            (job, findings)
        }
        _ => {
            let imported = job::import(&text).map_err(refused)?;
            (value_to_js(&imported.job), imported.findings)
        }
    };
    let result = Object::new();
    set(&result, "job", &job);
    set(&result, "findings", &to_js(&findings)?);
    Ok(result.into())
}

/// The moves as columns: `to` (three numbers a move), `step`, `touch` (−1 is none), and `feed` and `kind` as indices into
/// `feeds` and `kinds`.
#[wasm_bindgen(js_name = moveColumns)]
pub fn move_columns(job: &JsValue) -> Result<JsValue, JsValue> {
    const FEEDS: [&str; 6] = ["approach", "longLink", "work", "retract", "return", "rapid"];
    const KINDS: [&str; 3] = ["position", "touch", "back"];
    let moves = job::plan(&from_js(job)).map_err(refused)?.moves;
    let index = |names: &[&str], name: &str| names.iter().position(|n| *n == name).map_or(u8::MAX, |i| i as u8);
    let bytes = |f: &dyn Fn(&Move) -> u8| Uint8Array::from(moves.iter().map(f).collect::<Vec<u8>>().as_slice());
    let to: Vec<f64> = moves.iter().flat_map(|m| m.to).collect();
    let touch: Vec<i32> = moves.iter().map(|m| m.touch.map_or(-1, |k| k as i32)).collect();
    let columns = Object::new();
    set(&columns, "to", &Float64Array::from(to.as_slice()));
    set(&columns, "feed", &bytes(&|m| index(&FEEDS, m.feed)));
    set(&columns, "kind", &bytes(&|m| index(&KINDS, m.kind)));
    set(&columns, "step", &bytes(&|m| m.step));
    set(&columns, "touch", &Int32Array::from(touch.as_slice()));
    set(&columns, "feeds", &names(&FEEDS));
    set(&columns, "kinds", &names(&KINDS));
    Ok(columns.into())
}

/// SINUMERIK's LENTOAX: `{ status, axind, matrix }`. Throws where the query itself is wrong.
#[wasm_bindgen]
pub fn lentoax(query: &JsValue) -> Result<JsValue, JsValue> {
    let query = job::lentoax_query(&from_js(query)).map_err(refused)?;
    let answer = tool_length::lentoax(&query);
    let result = Object::new();
    set(&result, "status", &JsValue::from(answer.status));
    let list = |row: &[f64; 3]| row.iter().map(|x| JsValue::from_f64(*x)).collect::<Array>();
    set(&result, "axind", &answer.axind.iter().map(|i| JsValue::from(*i)).collect::<Array>());
    set(&result, "matrix", &answer.matrix.iter().map(list).collect::<Array>());
    Ok(result.into())
}

/// The same in words: `{ meaning, sentence, program }`, the last being NC lines that ask the control itself.
#[wasm_bindgen(js_name = lentoaxWords)]
pub fn lentoax_words(query: &JsValue) -> Result<JsValue, JsValue> {
    let query = job::lentoax_query(&from_js(query)).map_err(refused)?;
    let answer = tool_length::lentoax(&query);
    let result = Object::new();
    set(&result, "meaning", &JsValue::from_str(tool_length::meaning(answer.status)));
    set(&result, "sentence", &JsValue::from_str(&tool_length::sentence(query.plane, &answer)));
    set(&result, "program", &JsValue::from_str(&tool_length::nc_block(&query.coord)));
    Ok(result.into())
}

/// The crate's version.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// A picture of a job on a canvas. Pixels are CSS pixels from the canvas' upper left corner.
#[wasm_bindgen]
#[derive(Debug)]
pub struct View {
    painter: Painter,
    projection: Projection,
    camera: Camera,
    shown: Option<Shown>,
    highlight: Option<usize>,
    /// Whether the user has zoomed or panned, so that a new job must not fit the picture again.
    moved: bool,
}

/// The job that is shown.
#[derive(Debug)]
struct Shown {
    value: Value,
    scene: Scene,
    deviates: bool,
    scale: f64,
    plane: crate::geom::Plane,
    offset: crate::geom::Vec3,
    turn: f64,
    origin: crate::geom::Vec3,
}

#[wasm_bindgen]
impl View {
    /// A view on a canvas.
    #[wasm_bindgen(constructor)]
    pub fn new(canvas: web_sys::HtmlCanvasElement) -> Result<View, JsValue> {
        let painter = Painter::new(canvas).ok_or_else(|| JsValue::from_str("this canvas has no 2D context"))?;
        let camera = Camera { scale: 1.0, middle: [0.0; 2], size: [300.0, 150.0] };
        Ok(View { painter, projection: Projection::Top, camera, shown: None, highlight: None, moved: false })
    }

    /// The canvas covers so many CSS pixels; `ratio` is the device's pixels in one.
    pub fn resize(&mut self, width: f64, height: f64, ratio: f64) {
        self.painter.resize(width, height, ratio);
        self.camera.size = [width, height];
        if !self.moved {
            self.fit();
        }
        self.draw();
    }

    /// Colours: `background`, `text`, `wall`, `actual`, `position`, `link`, `touch`, `ball`, `highlight`.
    #[wasm_bindgen(js_name = setTheme)]
    pub fn set_theme(&mut self, theme: JsValue) {
        if let Ok(theme) = serde_wasm_bindgen::from_value::<Theme>(theme) {
            self.painter.theme = theme;
        }
        self.draw();
    }

    /// Shows a job. One that has errors leaves the picture as it is and gives `false`.
    pub fn show(&mut self, job: &JsValue) -> bool {
        let Some(shown) = self.build(from_js(job)) else {
            return false;
        };
        self.shown = Some(shown);
        if !self.moved {
            self.fit();
        }
        self.draw();
        true
    }

    /// Shows the answer of a LENTOAX query: the axes of the coordinate system, the lengths as arrows, and, where the workpiece
    /// system is turned, the base axes. A wrong query leaves the picture as it is and gives `false`.
    #[wasm_bindgen(js_name = showLentoax)]
    pub fn show_lentoax(&mut self, query: &JsValue) -> bool {
        let Ok(query) = job::lentoax_query(&from_js(query)) else { return false };
        let arrows = scene::lengths(&query);
        self.shown = None;
        let camera = Camera::fit(self.camera.size, [[-1.35, -1.35], [1.35, 1.35]]);
        self.painter.draw_arrows(&arrows, &camera);
        true
    }

    /// Looks from `top`, `front`, `side` or `isometric`.
    pub fn look(&mut self, from: &str) {
        let Some(projection) = Projection::named(from) else {
            return;
        };
        self.projection = projection;
        if let Some(shown) = self.shown.take() {
            self.shown = self.build(shown.value);
        }
        self.fit();
        self.draw();
    }

    /// Fits the whole scene into the canvas.
    pub fn fit(&mut self) {
        if let Some(shown) = &self.shown {
            self.camera = Camera::fit(self.camera.size, shown.scene.bounds());
        }
        self.moved = false;
        self.draw();
    }

    /// Closer by `factor` about a pixel.
    pub fn zoom(&mut self, factor: f64, x: f64, y: f64) {
        if factor.is_finite() && factor > 0.0 {
            self.camera.zoom(factor, [x, y]);
            self.moved = true;
            self.draw();
        }
    }

    /// Drags the picture.
    pub fn pan(&mut self, dx: f64, dy: f64) {
        self.camera.pan([dx, dy]);
        self.moved = true;
        self.draw();
    }

    /// The move at a pixel.
    pub fn pick(&self, x: f64, y: f64) -> Option<usize> {
        let shown = self.shown.as_ref()?;
        shown.scene.pick(self.camera.spot([x, y]), 8.0 / self.camera.scale)
    }

    /// Lights up a move, or none.
    pub fn highlight(&mut self, index: Option<usize>) {
        if self.highlight != index {
            self.highlight = index;
            self.draw();
        }
    }

    /// The handle at a pixel: `shift` or `turn` of the virtual part, `start` or `sweep` of the touches' angles, or nothing.
    #[wasm_bindgen(js_name = handleAt)]
    pub fn handle_at(&self, x: f64, y: f64) -> Option<String> {
        let scene = &self.shown.as_ref()?.scene;
        let near = |p: Spot| (p[0] - x).hypot(p[1] - y) <= 14.0;
        if let Some([start, sweep]) = spread_handles(scene, &self.camera) {
            if near(sweep) {
                return Some("sweep".to_owned());
            }
            if near(start) {
                return Some("start".to_owned());
            }
        }
        let (origin, direction) = scene.handle?;
        let at = self.camera.pixel(origin);
        if near(at) {
            Some("shift".to_owned())
        } else {
            near([at[0] + direction[0] * ARM, at[1] - direction[1] * ARM]).then(|| "turn".to_owned())
        }
    }

    /// The angle in whole degrees that a `start` or `sweep` handle says at a pixel. A spread keeps its sense.
    #[wasm_bindgen(js_name = dragAngle)]
    pub fn drag_angle(&self, handle: &str, x: f64, y: f64) -> Option<f64> {
        let (center, _, start, sweep) = self.shown.as_ref()?.scene.spread?;
        let spot = self.camera.spot([x, y]);
        let angle = (spot[1] - center[1]).atan2(spot[0] - center[0]).to_degrees();
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

    /// Where the virtual part lies if a handle is dragged to a pixel: `{ offset, rotation }` in the job's units. Turning
    /// keeps the feature's own origin where it is.
    #[wasm_bindgen(js_name = dragPart)]
    pub fn drag_part(&self, handle: &str, x: f64, y: f64) -> Result<JsValue, JsValue> {
        use crate::geom::{Rigid, Vec3};
        let Some(shown) = &self.shown else {
            return Ok(JsValue::NULL);
        };
        let spot = self.camera.spot([x, y]);
        let [a, o, _] = shown.plane.axes();
        let (mut offset, mut turn) = (shown.offset, shown.turn);
        let place = |offset: Vec3, turn: f64| Rigid::new(shown.plane, offset, turn.to_radians()).point(shown.origin);
        let now = place(offset, turn);
        if handle == "turn" {
            let nominal = shown.scene.handle.map_or(0.0, |(_, d)| d[1].atan2(d[0]).to_degrees()) - turn;
            let angle = (spot[1] - now[o]).atan2(spot[0] - now[a]).to_degrees();
            turn = crate::num::wrap_degrees(((angle - nominal) * 100.0).round() / 100.0);
            offset += now - place(offset, turn);
        } else {
            offset[a] += spot[0] - now[a];
            offset[o] += spot[1] - now[o];
        }
        let rounded = |mm: f64| (mm / shown.scale * 1000.0).round() / 1000.0;
        let result = Object::new();
        let list: Array = offset.to_array().iter().map(|mm| JsValue::from_f64(rounded(*mm))).collect();
        set(&result, "offset", &list);
        set(&result, "rotation", &JsValue::from_f64(turn));
        Ok(result.into())
    }
}

impl View {
    fn build(&self, value: Value) -> Option<Shown> {
        let (job, path, surfaces, run) = job::scene_parts(&value)?;
        let actual = Actual {
            surfaces: &surfaces,
            run: &run,
            origin: job.lie.rigid.point(path.frame.origin),
            direction: job.lie.rigid.direction(path.frame.u),
            line: path.line.map(|line| line.map(|p| job.lie.rigid.point(p))),
        };
        let feeds = path.feeds.unwrap_or(job.feeds);
        let scene = scene::build(&path, &job.setup, &feeds, &actual, self.projection);
        Some(Shown {
            scene,
            deviates: !job.lie.nominal,
            scale: job.scale,
            plane: job.setup.plane,
            offset: job.lie.rigid.point(crate::geom::Vec3::ZERO),
            turn: job.lie.turn,
            origin: path.frame.origin,
            value,
        })
    }

    fn draw(&self) {
        if let Some(shown) = &self.shown {
            self.painter.draw(&shown.scene, &self.camera, self.highlight, shown.deviates);
        }
    }
}

/// Rust to plain objects: maps as objects, missing as null.
fn to_js(value: &impl Serialize) -> Result<JsValue, JsValue> {
    value.serialize(&serde_wasm_bindgen::Serializer::json_compatible()).map_err(JsValue::from)
}

fn refused(error: JobError) -> JsValue {
    let message = error.to_string();
    thrown(&error.findings, &message)
}

fn thrown(findings: &[Finding], message: &str) -> JsValue {
    let error = js_sys::Error::new(message);
    error.set_name("JobError");
    match to_js(&findings) {
        Ok(list) => set(&error, "findings", &list),
        Err(error) => return error,
    }
    error.into()
}

fn set(object: &JsValue, key: &str, value: &JsValue) {
    let done = Reflect::set(object, &JsValue::from_str(key), value);
    debug_assert!(done.is_ok(), "a plain object takes any key");
}

fn names(list: &[&str]) -> Array {
    list.iter().map(|name| JsValue::from_str(name)).collect()
}

fn value_to_js(value: &Value) -> JsValue {
    match value {
        Value::Null | Value::Other(_) => JsValue::NULL,
        Value::Flag(b) => JsValue::from_bool(*b),
        Value::Number(x) => JsValue::from_f64(*x),
        Value::Text(text) => JsValue::from_str(text),
        Value::List(items) => items.iter().map(value_to_js).collect::<Array>().into(),
        Value::Map(entries) => {
            let object = Object::new();
            for (key, value) in entries {
                set(&object, key, &value_to_js(value));
            }
            object.into()
        }
    }
}

/// Any JavaScript value as a loose value. Never throws, always ends.
fn from_js(value: &JsValue) -> Value {
    walk(value, 0, &mut MOST_VALUES.clone())
}

fn walk(value: &JsValue, depth: usize, left: &mut usize) -> Value {
    if let Some(b) = value.as_bool() {
        return Value::Flag(b);
    }
    if let Some(x) = value.as_f64() {
        return Value::Number(x);
    }
    if let Some(text) = value.as_string() {
        return Value::Text(text);
    }
    if value.is_null() {
        return Value::Null;
    }
    if value.is_undefined() {
        return Value::Other("undefined");
    }
    if value.is_function() || !value.is_object() {
        return Value::Other("something that is no data");
    }
    if depth == DEEPEST {
        return Value::Other("something nested too deeply");
    }
    let mut take = |key: &JsValue| {
        *left = left.saturating_sub(1);
        match Reflect::get(value, key) {
            Ok(_) if *left == 0 => Value::Other("more than a job can hold"),
            Ok(inner) => walk(&inner, depth + 1, left),
            Err(_) => Value::Other("something unreadable"),
        }
    };
    if Array::is_array(value) {
        let length = Reflect::get(value, &JsValue::from_str("length")).ok().and_then(|n| n.as_f64()).unwrap_or(0.0);
        if length > MOST_VALUES as f64 {
            return Value::Other("a list longer than a job can hold");
        }
        return Value::List((0..length as u32).map(|i| take(&JsValue::from_f64(f64::from(i)))).collect());
    }
    let Ok(keys) = Reflect::own_keys(value) else {
        return Value::Other("something unreadable");
    };
    if keys.length() as usize > MOST_VALUES {
        return Value::Other("an object with more keys than a job can hold");
    }
    let mut entries = Vec::new();
    for key in keys.iter() {
        let Some(name) = key.as_string() else {
            continue;
        };
        match take(&key) {
            // A key that is set to undefined is a key that is not there.
            Value::Other("undefined") => {}
            inner => entries.push((name, inner)),
        }
    }
    Value::Map(entries)
}
