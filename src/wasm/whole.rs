//! Functions for opening, reading and looking up, which a first visit does not need.

use js_sys::{Array, Float64Array, Object, Uint8Array, Uint32Array};
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;

use super::sink::text_of;
use super::{refused, set, thrown, to_js, value_to_js};
use crate::border::coded::decoded;
use crate::describe;
use crate::form::{Finding, Level};
use crate::import::toolpath::RunInputs;
use crate::import::{self, Imported, Toolpath, toolpath};
use crate::job;
use crate::text::text;
use crate::tool_length;

/// JSON Schema (2020-12) of a job.
#[wasm_bindgen(js_name = jobSchema)]
pub fn job_schema() -> JsValue {
    value_to_js(&describe::job_schema())
}

/// A job from text: job JSON, a dump of CmdPrm codes (text, CSV, a JSON list) or a program. Returns `{ kind: "job", job, findings }`; for a program of moves
/// without a job `{ kind: "moves", job: null, trace, findings }`. Throws if neither is possible. `codes` and `json` are the text parsed as JSON, with no codes
/// if it is not JSON; if the job is just that, `job` is left out.
#[wasm_bindgen(js_name = importJob)]
pub fn import_job(text: &JsValue, codes: &[f64], json: &str) -> Result<JsValue, JsValue> {
    let length = text
        .dyn_ref::<js_sys::JsString>()
        .map_or(0, |text| text.length() as usize);
    if length > job::LONGEST_TEXT {
        // It is not even copied.
        return Err(refused(import::too_long(length)));
    }
    let text = text.as_string().unwrap_or_default();
    let value = (!codes.is_empty()).then(|| decoded(codes, json));
    let imported = import::import_with(&text, value.as_ref()).map_err(refused)?;
    let result = Object::new();
    match &imported {
        Imported::Job { job, .. } => {
            set(&result, "kind", &JsValue::from_str("job"));
            // A job in JSON is returned unchanged, even if it has more than a job can have.
            if value.as_ref() != Some(job) {
                set(&result, "job", &value_to_js(job));
            }
        }
        Imported::Moves { trace, .. } => {
            set(&result, "kind", &JsValue::from_str("moves"));
            set(&result, "job", &JsValue::NULL);
            set(&result, "trace", &to_js(trace)?);
        }
    }
    set(&result, "findings", &to_js(&imported.findings())?);
    Ok(result.into())
}

/// A program with the program of a job in it: `{ text, line, first, count, places, findings }`. `line` is the 0-based line after which it is inserted; without one it goes
/// after the tool change of the probe.
#[wasm_bindgen(js_name = insertProgram)]
pub fn insert_program(
    codes: &[f64],
    text: &str,
    other: &[u8],
    length: usize,
    line: Option<usize>,
) -> Result<JsValue, JsValue> {
    if length > toolpath::LONGEST_PROGRAM {
        return Err(refused(toolpath::too_long(length)));
    }
    let job = decoded(codes, text);
    let insertion = import::insert::insert(&job, &utf8(other), line).map_err(refused)?;
    to_js(&insertion)
}

/// The moves of any program, as columns; throws if the text is too long or the dialect unknown. The text comes as UTF-8, which is several times as fast as a
/// string; for one that is too long only the length is passed.
#[wasm_bindgen(js_name = readProgram)]
pub fn read_program(text: &[u8], length: usize, dialect: &JsValue) -> Result<JsValue, JsValue> {
    if length > toolpath::LONGEST_PROGRAM {
        return Err(refused(toolpath::too_long(length)));
    }
    let wanted = text_of(dialect, 100);
    let known = wanted
        .as_ref()
        .and_then(|wanted| toolpath::DIALECTS.into_iter().find(|known| known == wanted));
    if known.is_none() && !dialect.is_undefined() {
        let message = text!(
            "The dialect must be one of {list}",
            toolpath::DIALECTS.join(", ")
        );
        return Err(thrown(&[Finding::new(
            Level::Error,
            "unknown-value",
            "dialect",
            message,
        )]));
    }
    columns(&toolpath::read_program(&utf8(text), known)).map(JsValue::from)
}

/// The moves of a program that is run with these inputs, an object as for `runProgram` of the package.
#[wasm_bindgen(js_name = runProgram)]
pub fn run_program(
    text: &[u8],
    length: usize,
    codes: &[f64],
    known: &str,
) -> Result<JsValue, JsValue> {
    if length > toolpath::LONGEST_PROGRAM {
        return Err(refused(toolpath::too_long(length)));
    }
    let value = decoded(codes, known);
    let text = utf8(text);
    let run = toolpath::run_program(&text, &RunInputs::of(&value).map_err(refused)?);
    let result = columns(&run)?;
    set(&result, "file", &Uint32Array::from(run.file.as_slice()));
    set(
        &result,
        "contacts",
        &Float64Array::from(run.contacts.concat().as_slice()),
    );
    set(
        &result,
        "resumes",
        &Float64Array::from(run.resumes.concat().as_slice()),
    );
    set(
        &result,
        "systems",
        &Float64Array::from(run.systems.concat().as_slice()),
    );
    set(&result, "writes", &to_js(&run.writes)?);
    let findings: Array = result_findings(&run)?;
    set(&result, "findings", &findings);
    set(&result, "asks", &to_js(&run.asks)?);
    let calls: Array = run
        .calls
        .iter()
        .map(|call| {
            let row = to_js(call)?;
            set(
                &row,
                "job",
                &call.job.as_ref().map_or(JsValue::NULL, value_to_js),
            );
            Ok::<JsValue, JsValue>(row)
        })
        .collect::<Result<Array, JsValue>>()?;
    set(&result, "calls", &calls);
    set(&result, "rules", &to_js(&run.rules)?);
    set(&result, "outline", &to_js(&toolpath::outline(&text))?);
    Ok(result.into())
}

/// JavaScript writes only UTF-8; this check confirms it immediately.
fn utf8(text: &[u8]) -> std::borrow::Cow<'_, str> {
    match std::str::from_utf8(text) {
        Ok(text) => text.into(),
        Err(_) => String::from_utf8_lossy(text),
    }
}

/// Findings of a run, each with its lines.
fn result_findings(run: &Toolpath) -> Result<Array, JsValue> {
    let with_lines = |(finding, lines): (&Finding, &Vec<u32>)| {
        let finding = to_js(finding)?;
        set(&finding, "lines", &to_js(lines)?);
        Ok(finding)
    };
    run.findings
        .iter()
        .zip(&run.finding_lines)
        .map(with_lines)
        .collect()
}

fn columns(path: &Toolpath) -> Result<Object, JsValue> {
    let columns = Object::new();
    set(&columns, "dialect", &JsValue::from_str(path.dialect));
    let post = path.post.map_or(JsValue::NULL, JsValue::from_str);
    set(&columns, "post", &post);
    let units = path
        .metric
        .map(|metric| JsValue::from_str(if metric { "mm" } else { "inch" }));
    set(&columns, "units", &units.unwrap_or(JsValue::NULL));
    set(&columns, "plane", &JsValue::from_str(path.plane.word()));
    set(&columns, "to", &Float64Array::from(path.to.as_slice()));
    set(&columns, "kind", &Uint8Array::from(path.kind.as_slice()));
    set(&columns, "feed", &Float64Array::from(path.feed.as_slice()));
    set(&columns, "line", &Uint32Array::from(path.line.as_slice()));
    set(
        &columns,
        "arcs",
        &Float64Array::from(path.arcs.concat().as_slice()),
    );
    set(&columns, "findings", &to_js(&path.findings)?);
    Ok(columns)
}

/// SINUMERIK's LENTOAX: `{ status, axind, matrix }`. Throws if the query has faults.
#[wasm_bindgen]
pub fn lentoax(codes: &[f64], text: &str) -> Result<JsValue, JsValue> {
    let query = job::lentoax_query(&decoded(codes, text)).map_err(refused)?;
    let answer = tool_length::lentoax(&query);
    let result = Object::new();
    set(&result, "status", &JsValue::from(answer.status));
    let list = |row: &[f64; 3]| row.iter().map(|x| JsValue::from_f64(*x)).collect::<Array>();
    set(
        &result,
        "axind",
        &answer
            .axind
            .iter()
            .map(|i| JsValue::from(*i))
            .collect::<Array>(),
    );
    set(
        &result,
        "matrix",
        &answer.matrix.iter().map(list).collect::<Array>(),
    );
    Ok(result.into())
}

/// The answer in words: `{ meaning, sentence, program }`; `program` are NC lines that ask the control itself.
#[wasm_bindgen(js_name = lentoaxWords)]
pub fn lentoax_words(codes: &[f64], text: &str) -> Result<JsValue, JsValue> {
    let query = job::lentoax_query(&decoded(codes, text)).map_err(refused)?;
    let answer = tool_length::lentoax(&query);
    let result = Object::new();
    set(
        &result,
        "meaning",
        &JsValue::from_str(tool_length::meaning(answer.status)),
    );
    let sentence = tool_length::sentence(query.plane, &answer);
    set(&result, "sentence", &JsValue::from_str(&sentence.english()));
    set(&result, "said", &to_js(&sentence)?);
    set(
        &result,
        "program",
        &JsValue::from_str(&tool_length::nc_block(&query)),
    );
    Ok(result.into())
}
