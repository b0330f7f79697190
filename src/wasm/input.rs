//! A walk over any JavaScript value. It never throws and always ends: cycles, getters that throw, lists of any length.

use js_sys::{JsString, Reflect};
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;

use crate::form::Value;
use crate::job::LONGEST_TEXT;

#[wasm_bindgen]
extern "C" {
    /// `Array.isArray`, which throws on a revoked proxy. An exception that passed through this module would leave it unusable.
    #[wasm_bindgen(catch, js_namespace = Array, js_name = isArray)]
    fn is_array(value: &JsValue) -> Result<bool, JsValue>;
}

/// The most values a job may hold, and how deep they may lie. A job has about a hundred.
const MOST_VALUES: usize = 20_000;
const DEEPEST: usize = 16;

/// How much of a value may still be read.
struct Budget {
    values: usize,
    /// UTF-16 units of all texts together.
    text: usize,
}

/// Any JavaScript value as a loose value. Never throws, always ends.
pub fn from_js(value: &JsValue) -> Value {
    walk(value, 0, &mut Budget { values: MOST_VALUES, text: LONGEST_TEXT })
}

/// A text that is not longer than `most` UTF-16 units; a longer one is not copied.
pub fn text_of(value: &JsValue, most: usize) -> Option<String> {
    let length = value.dyn_ref::<JsString>()?.length() as usize;
    if length <= most { value.as_string() } else { None }
}

fn walk(value: &JsValue, depth: usize, left: &mut Budget) -> Value {
    if let Some(b) = value.as_bool() {
        return Value::Flag(b);
    }
    if let Some(x) = value.as_f64() {
        return Value::Number(x);
    }
    if value.is_string() {
        let Some(text) = text_of(value, left.text) else { return Value::Other("more text than a job can hold") };
        left.text = left.text.saturating_sub(text.len());
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
    let take = |key: &JsValue, left: &mut Budget| {
        left.values = left.values.saturating_sub(1);
        match Reflect::get(value, key) {
            Ok(_) if left.values == 0 => Value::Other("more than a job can hold"),
            Ok(inner) => walk(&inner, depth + 1, left),
            Err(_) => Value::Other("something unreadable"),
        }
    };
    let Ok(list) = is_array(value) else { return Value::Other("something unreadable") };
    if list {
        let length = Reflect::get(value, &JsValue::from_str("length")).ok().and_then(|n| n.as_f64()).unwrap_or(0.0);
        if length > MOST_VALUES as f64 {
            return Value::Other("a list longer than a job can hold");
        }
        if length.is_nan() || length < 0.0 {
            return Value::Other("something unreadable");
        }
        return Value::List((0..length as u32).map(|i| take(&JsValue::from_f64(f64::from(i)), left)).collect());
    }
    let Ok(keys) = Reflect::own_keys(value) else {
        return Value::Other("something unreadable");
    };
    if keys.length() as usize > MOST_VALUES {
        return Value::Other("an object with more keys than a job can hold");
    }
    let mut entries = Vec::new();
    for key in keys.iter() {
        // Symbols are no keys of a job.
        if !key.is_string() {
            continue;
        }
        let Some(name) = text_of(&key, left.text) else { return Value::Other("more text than a job can hold") };
        left.text = left.text.saturating_sub(name.len());
        match take(&key, left) {
            // A key that is set to undefined is a key that is not there.
            Value::Other("undefined") => {}
            inner => entries.push((name, inner)),
        }
    }
    Value::Map(entries)
}
