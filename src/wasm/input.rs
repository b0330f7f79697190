//! A walk over any JavaScript value. It never throws and always ends: cycles, getters that throw, lists of any length.

use js_sys::{Array, Reflect};
use wasm_bindgen::prelude::*;

use crate::spec::Value;

/// The most values a job may hold, and how deep they may lie. A job has about a hundred.
const MOST_VALUES: usize = 20_000;
const DEEPEST: usize = 16;

/// Any JavaScript value as a loose value. Never throws, always ends.
pub fn from_js(value: &JsValue) -> Value {
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
