//! The same for JavaScript. JavaScript sees plain objects only; the only module that names `wasm_bindgen` besides the canvas.
//!
//! Jobs come in through a walk that survives anything JavaScript can hand over: cycles, getters that throw, lists of any
//! length. A refused job is thrown as an `Error` named `JobError` with its `findings`; the package makes a class of it.

mod input;
mod view;

pub use view::View;

use std::cell::RefCell;
use std::rc::Rc;

use js_sys::{Array, Float64Array, Int32Array, Object, Reflect, Uint8Array};
use serde::Serialize;
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;

use crate::describe;
use crate::form::{Finding, Level, Value};
use crate::import;
use crate::job::{self, JobError, Move, Planned};
use crate::tool_length;
use crate::wasm::input::from_js;

/// Everything a form needs.
#[wasm_bindgen]
pub fn catalog() -> Result<JsValue, JsValue> {
    to_js(&describe::catalog())
}

/// A complete, valid job of a type.
#[wasm_bindgen(js_name = defaultJob)]
pub fn default_job(kind: &JsValue) -> Result<JsValue, JsValue> {
    let key = input::text_of(kind, 100).unwrap_or_default();
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
    let value = from_js(job);
    let (planned, plan) = job::plan_with_path(&value).map_err(refused)?;
    LAST.with_borrow_mut(|last| *last = Some(Rc::new((value, planned))));
    to_js(&plan)
}

thread_local! {
    /// The job that was planned last, and its path: its picture needs no second plan.
    static LAST: RefCell<Option<Rc<(Value, Planned)>>> = const { RefCell::new(None) };
}

/// The path of a job: of the last plan where it is the same job, else planned now. None for a job with errors.
fn planned(job: &JsValue) -> Option<Rc<(Value, Planned)>> {
    let value = from_js(job);
    if let Some(last) = LAST.with_borrow(|last| last.clone()).filter(|last| last.0 == value) {
        return Some(last);
    }
    let planned = job::planned(&value)?;
    Some(Rc::new((value, planned)))
}

/// The same job in other units, `mm` or `inch`: lengths, feeds, and values with tolerances. What is no value stays as it is.
#[wasm_bindgen(js_name = convertUnits)]
pub fn convert_units(job: &JsValue, units: &JsValue) -> Result<JsValue, JsValue> {
    let units = input::text_of(units, 100).unwrap_or_default();
    job::convert_units(&from_js(job), &units).map(|job| value_to_js(&job)).map_err(refused)
}

/// The results from points that a machine really measured.
#[wasm_bindgen]
pub fn evaluate(job: &JsValue, measured: &JsValue) -> Result<JsValue, JsValue> {
    to_js(&job::evaluate(&from_js(job), &from_js(measured)).map_err(refused)?)
}

/// The parameter table as text: `csv`, `json` or `text`.
#[wasm_bindgen(js_name = exportTable)]
pub fn export_table(job: &JsValue, format: &JsValue) -> Result<String, JsValue> {
    let plan = job::plan(&from_js(job)).map_err(refused)?;
    describe::export_table(&plan, &input::text_of(format, 100).unwrap_or_default()).map_err(refused)
}

/// JSON Schema (2020-12) of a job.
#[wasm_bindgen(js_name = jobSchema)]
pub fn job_schema() -> JsValue {
    value_to_js(&describe::job_schema())
}

/// A job from text: job JSON, a dump of CmdPrm codes (text, CSV, a JSON list) or a program. Gives `{ job, findings }`; of a program
/// of moves that says no job `{ job: null, trace, findings }`. Throws where neither can be made of it.
#[wasm_bindgen(js_name = importJob)]
pub fn import_job(text: &JsValue) -> Result<JsValue, JsValue> {
    let length = text.dyn_ref::<js_sys::JsString>().map_or(0, |text| text.length() as usize);
    if length > job::LONGEST_TEXT {
        // Not even copied.
        return Err(refused(import::too_long(length)));
    }
    let text = text.as_string().unwrap_or_default();
    let parsed = js_sys::JSON::parse(text.trim_start_matches('\u{feff}')).ok();
    let value = parsed.as_ref().map(from_js);
    let imported = import::import_with(&text, value.as_ref()).map_err(refused)?;
    // A job in JSON is given back as it is, also where it holds more than a job can.
    let same = value.as_ref() == Some(&imported.job);
    let job = parsed.filter(|_| same).unwrap_or_else(|| value_to_js(&imported.job));
    let findings = imported.findings;
    let result = Object::new();
    set(&result, "job", &job);
    if let Some(trace) = &imported.trace {
        set(&result, "trace", &to_js(trace)?);
    }
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
            // No value of a job stands under this name; set, it would change the object itself.
            for (key, value) in entries.iter().filter(|(key, _)| key != "__proto__") {
                set(&object, key, &value_to_js(value));
            }
            object.into()
        }
    }
}
