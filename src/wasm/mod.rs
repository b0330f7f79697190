//! The crate for JavaScript, which sees plain objects only. Besides the canvas, only this module uses `wasm_bindgen`.
//!
//! A value comes in as numbers and one string, encoded by a walk that survives anything a caller can pass (`www/core/coded.ts`), and a plan goes out as numbers
//! and one string (`www/core/plan.ts`): one transfer instead of a call for each value. Small or rare answers are objects. A refused job is thrown as an `Error`
//! named `JobError` with its `findings`; the package makes a class of it.

mod sink;
mod view;
mod whole;

pub use sink::Sink;
pub use view::View;
pub use whole::{import_job, job_schema, lentoax, lentoax_words, read_program, run_program};

use std::cell::RefCell;
use std::rc::Rc;

use js_sys::{Array, Object, Reflect};
use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::border::coded::decoded;
use crate::border::packed;
use crate::config::Config;
use crate::describe;
use crate::form::{Finding, Level, Value};
use crate::job::{self, JobError, PlannedJob};
use crate::text::text;
use crate::view::scene::Projection;
use crate::wasm::sink::text_of;

/// Everything a form needs.
#[wasm_bindgen]
pub fn catalog() -> Result<JsValue, JsValue> {
    to_js(&describe::catalog())
}

/// A complete, valid job of a type, in mm or in inch; by default in mm.
#[wasm_bindgen(js_name = defaultJob)]
pub fn default_job(kind: &JsValue, units: &JsValue) -> Result<JsValue, JsValue> {
    let key = text_of(kind, 100).unwrap_or_default();
    let word = if units.is_undefined() {
        Some("mm".to_owned())
    } else {
        text_of(units, 100)
    };
    let units = job::known_units(&word.unwrap_or_default()).map_err(refused)?;
    job::new_job(&key, units)
        .map(|value| value_to_js(&value))
        .ok_or_else(|| {
            let message = text!("There is no cycle of this type; catalog() lists them");
            thrown(&[Finding::new(
                Level::Error,
                "unknown-value",
                "cycle.type",
                message,
            )])
        })
}

/// Default name of a job: the measured feature, and its main sizes.
#[wasm_bindgen(js_name = jobName)]
pub fn job_name(codes: &[f64], text: &str) -> String {
    job::job_name(&decoded(codes, text))
}

/// Stock that fits the features of a job. Null if no stock fits.
#[wasm_bindgen(js_name = proposedStock)]
pub fn proposed_stock(codes: &[f64], text: &str) -> JsValue {
    let mut job = decoded(codes, text);
    // The present stock does not count, nor do errors in it.
    if let Value::Map(entries) = &mut job {
        entries.retain(|(key, _)| key != job::STOCK.key);
    }
    job::planned(&job)
        .and_then(|planned| job::proposed_stock(&planned))
        .map_or(JsValue::NULL, |stock| value_to_js(&stock))
}

/// Reason why the form cannot show a job; null if it can.
#[wasm_bindgen]
pub fn misfit(codes: &[f64], text: &str) -> Result<JsValue, JsValue> {
    to_js(&job::form_problem(&decoded(codes, text)))
}

/// All findings: errors, warnings and notes.
#[wasm_bindgen]
pub fn check(codes: &[f64], text: &str) -> Result<JsValue, JsValue> {
    to_js(&job::check(&decoded(codes, text)))
}

/// The whole plan without its table; throws if the job has an error.
#[wasm_bindgen]
pub fn plan(codes: &[f64], text: &str, sink: &Sink) -> Result<(), JsValue> {
    let (planned, plan) = job::plan_with_path(&decoded(codes, text)).map_err(refused)?;
    keep(codes, text, planned);
    sink.give(&packed::plan(&plan));
    Ok(())
}

/// Faults of a portal's config: findings, empty if it is valid.
#[wasm_bindgen(js_name = configFaults)]
pub fn config_faults(codes: &[f64], text: &str) -> Result<JsValue, JsValue> {
    let faults = read_config(codes, text).err().map(|error| error.findings);
    to_js(&faults.unwrap_or_default())
}

/// A job filled in by a config; throws if the config has faults.
#[wasm_bindgen]
pub fn filled(
    codes: &[f64],
    text: &str,
    config: &[f64],
    config_text: &str,
) -> Result<JsValue, JsValue> {
    let config = read_config(config, config_text).map_err(refused)?;
    Ok(value_to_js(&config.fill(&decoded(codes, text))))
}

/// Refusals of a config for a job that was filled in; throws if the config has faults.
#[wasm_bindgen]
pub fn judged(
    codes: &[f64],
    text: &str,
    config: &[f64],
    config_text: &str,
) -> Result<JsValue, JsValue> {
    let config = read_config(config, config_text).map_err(refused)?;
    let last = planned(codes, text);
    to_js(&config.judge_planned(
        &decoded(codes, text),
        last.as_ref().map(|last| &last.planned),
    ))
}

thread_local! {
    /// The last config.
    static CONFIG: RefCell<Option<(Coded, Rc<Config>)>> = const { RefCell::new(None) };
}

/// A config: the last one if it is the same, since a page passes it at every keystroke.
fn read_config(codes: &[f64], text: &str) -> Result<Rc<Config>, JobError> {
    let last = CONFIG.with_borrow(|last| {
        last.as_ref()
            .filter(|(coded, _)| coded.is(codes, text))
            .map(|(_, config)| config.clone())
    });
    if let Some(config) = last {
        return Ok(config);
    }
    let config = Rc::new(Config::read(&decoded(codes, text))?);
    let coded = Coded {
        codes: codes.to_vec(),
        text: text.to_owned(),
    };
    CONFIG.with_borrow_mut(|place| *place = Some((coded, config.clone())));
    Ok(config)
}

/// The parameter table of a job with a plan.
#[wasm_bindgen]
pub fn table(codes: &[f64], text: &str, sink: &Sink) {
    if let Some(last) = planned(codes, text) {
        sink.give(&packed::table(&last.planned.table()));
    }
}

/// Meanings of the rows of that table, as texts for other languages.
#[wasm_bindgen]
pub fn meanings(codes: &[f64], text: &str, sink: &Sink) {
    if let Some(last) = planned(codes, text) {
        sink.give(&packed::meanings(&last.planned.table()));
    }
}

/// An encoded value.
#[derive(Debug)]
struct Coded {
    codes: Vec<f64>,
    text: String,
}

/// The last planned job.
#[derive(Debug)]
struct Last {
    job: Coded,
    planned: PlannedJob,
}

impl Coded {
    fn is(&self, codes: &[f64], text: &str) -> bool {
        // Compared as bits, so that NaN equals itself.
        let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
        self.text == text
            && self.codes.len() == codes.len()
            && self.codes.iter().zip(codes).all(same)
    }
}

impl Last {
    /// A path that is not kept: it belongs to no job.
    fn of_none(planned: PlannedJob) -> Rc<Last> {
        Rc::new(Last {
            job: Coded {
                codes: Vec::new(),
                text: String::new(),
            },
            planned,
        })
    }
}

thread_local! {
    /// The last planned job with its path: its picture and its table need no second plan.
    static LAST: RefCell<Option<Rc<Last>>> = const { RefCell::new(None) };
}

fn keep(codes: &[f64], text: &str, planned: PlannedJob) {
    let last = Last {
        job: Coded {
            codes: codes.to_vec(),
            text: text.to_owned(),
        },
        planned,
    };
    LAST.with_borrow_mut(|place| *place = Some(Rc::new(last)));
}

/// The path of a job: that of the last plan if it is the same job, else planned now. `None` for a job with errors.
fn planned(codes: &[f64], text: &str) -> Option<Rc<Last>> {
    if let Some(last) = LAST
        .with_borrow(|last| last.clone())
        .filter(|last| last.job.is(codes, text))
    {
        return Some(last);
    }
    let planned = job::planned(&decoded(codes, text))?;
    Some(Last::of_none(planned))
}

/// The job in other units, `mm` or `inch`: lengths, feeds, and values with tolerances. Anything else is unchanged.
#[wasm_bindgen(js_name = convertUnits)]
pub fn convert_units(codes: &[f64], text: &str, units: &JsValue) -> Result<JsValue, JsValue> {
    let units = text_of(units, 100).unwrap_or_default();
    job::convert_units(&decoded(codes, text), &units)
        .map(|job| value_to_js(&job))
        .map_err(refused)
}

/// Results from values measured on a real machine: `{ results, points, block, findings }`.
#[wasm_bindgen]
pub fn measure(
    codes: &[f64],
    text: &str,
    measured: &[f64],
    measured_text: &str,
) -> Result<JsValue, JsValue> {
    to_js(&job::measure(&decoded(codes, text), &decoded(measured, measured_text)).map_err(refused)?)
}

/// The parameter table as text: `csv`, `json` or `text`.
#[wasm_bindgen(js_name = exportTable)]
pub fn export_table(codes: &[f64], text: &str, format: &JsValue) -> Result<String, JsValue> {
    let job = decoded(codes, text);
    let plan = job::plan(&job).map_err(refused)?;
    let calls = if plan.program.own {
        job::calls(&job)
    } else {
        None
    };
    describe::export_table_with_calls(
        &plan,
        calls.as_deref(),
        &text_of(format, 100).unwrap_or_default(),
    )
    .map_err(refused)
}

/// The picture of a job as an SVG, from `top`, `front`, `side` or `isometric`.
#[wasm_bindgen]
pub fn svg(codes: &[f64], text: &str, view: &JsValue) -> Result<String, JsValue> {
    let name = text_of(view, 100).unwrap_or_default();
    let Some(projection) = Projection::named(&name) else {
        let message = text!("The view must be top, front, side or isometric");
        return Err(thrown(&[Finding::new(
            Level::Error,
            "unknown-value",
            "view",
            message,
        )]));
    };
    let value = decoded(codes, text);
    job::svg(&value, projection).map_err(refused)
}

/// Lengths of the longest text that can become a job, and of the longest program whose moves are read, in UTF-16 units.
#[wasm_bindgen]
pub fn limits() -> Vec<u32> {
    [job::LONGEST_TEXT, job::LONGEST_PROGRAM]
        .map(|most| most as u32)
        .to_vec()
}

/// Version of the crate.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// Converts Rust values to plain objects: maps as objects, missing values as null.
fn to_js(value: &impl Serialize) -> Result<JsValue, JsValue> {
    value
        .serialize(&serde_wasm_bindgen::Serializer::json_compatible())
        .map_err(JsValue::from)
}

fn refused(error: JobError) -> JsValue {
    let message = error.to_string();
    thrown_as(&error.findings, &message)
}

/// A refusal with one finding, whose message becomes that of the error.
fn thrown(finding: &[Finding; 1]) -> JsValue {
    thrown_as(finding, &finding[0].message)
}

fn thrown_as(findings: &[Finding], message: &str) -> JsValue {
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

fn value_to_js(value: &Value) -> JsValue {
    match value {
        Value::Null | Value::Other(_) => JsValue::NULL,
        Value::Flag(b) => JsValue::from_bool(*b),
        Value::Number(x) => JsValue::from_f64(*x),
        Value::Text(text) => JsValue::from_str(text),
        Value::List(items) => items.iter().map(value_to_js).collect::<Array>().into(),
        Value::Map(entries) => {
            let object = Object::new();
            // No value of a job has this name; setting it would change the object itself.
            for (key, value) in entries.iter().filter(|(key, _)| key != "__proto__") {
                set(&object, key, &value_to_js(value));
            }
            object.into()
        }
    }
}
