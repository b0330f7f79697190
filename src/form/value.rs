//! The loose value of a job, whatever format it came in.

use crate::text::{Text, text};

/// Any JSON-like value, including those that JavaScript can pass but JSON cannot express.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `null`, which differs from an absent key.
    Null,
    /// `true` or `false`.
    Flag(bool),
    /// A number; NaN and infinities too.
    Number(f64),
    /// A string.
    Text(String),
    /// An array.
    List(Vec<Value>),
    /// Keys and values in their original order.
    Map(Vec<(String, Value)>),
    /// A value that cannot be in a job (a function, a cyclic object), by its name.
    Other(&'static str),
}

impl Value {
    /// The value under `key`, if this is a map that has it. If a key occurs twice, the last value counts.
    pub fn get(&self, key: &str) -> Option<&Value> {
        match self {
            Value::Map(entries) => entries.iter().rev().find(|(k, _)| k == key).map(|(_, v)| v),
            _ => None,
        }
    }

    /// The value under `key`, if it is given: neither absent nor null.
    pub(crate) fn given(&self, key: &str) -> Option<&Value> {
        self.get(key).filter(|value| **value != Value::Null)
    }

    /// The value under `key`, mutable.
    pub(crate) fn get_mut(&mut self, key: &str) -> Option<&mut Value> {
        match self {
            Value::Map(entries) => entries
                .iter_mut()
                .rev()
                .find(|(k, _)| k == key)
                .map(|(_, v)| v),
            _ => None,
        }
    }

    /// Puts a value under `key` in place of the current one. Anything but a map stays unchanged.
    pub(crate) fn put(&mut self, key: &str, value: Value) {
        if let Some(place) = self.get_mut(key) {
            *place = value;
        } else if let Value::Map(entries) = self {
            entries.push((key.to_owned(), value));
        }
    }

    /// The kind of the value in a word, for messages.
    pub fn noun(&self) -> Text {
        match self {
            Value::Null => text!("null"),
            Value::Flag(_) => text!("true or false"),
            Value::Number(_) => text!("a number"),
            Value::Text(text) if text.trim().is_empty() => text!("an empty text"),
            Value::Text(_) => text!("text"),
            Value::List(_) => text!("a list"),
            Value::Map(_) => text!("an object"),
            Value::Other(name) => Text::words(name),
        }
    }
}

impl From<&serde_json::Value> for Value {
    fn from(json: &serde_json::Value) -> Self {
        use serde_json::Value as Json;
        match json {
            Json::Null => Value::Null,
            Json::Bool(b) => Value::Flag(*b),
            Json::Number(n) => Value::Number(n.as_f64().unwrap_or(f64::NAN)),
            Json::String(s) => Value::Text(s.clone()),
            Json::Array(items) => Value::List(items.iter().map(Value::from).collect()),
            Json::Object(map) => Value::Map(
                map.iter()
                    .map(|(k, v)| (k.clone(), Value::from(v)))
                    .collect(),
            ),
        }
    }
}
