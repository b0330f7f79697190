//! Data that goes out to JavaScript, and texts that come in.

use js_sys::JsString;
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;

use crate::border::packed::Packed;

#[wasm_bindgen]
extern "C" {
    /// Takes the outgoing data, and copies it before it returns.
    pub type Sink;

    #[wasm_bindgen(method)]
    fn take(this: &Sink, numbers: &[f64], text: &str);
}

impl Sink {
    pub fn give(&self, packed: &Packed) {
        self.take(&packed.numbers, &packed.text);
    }
}

/// A text of at most `most` UTF-16 units; a longer one is not copied.
pub fn text_of(value: &JsValue, most: usize) -> Option<String> {
    let length = value.dyn_ref::<JsString>()?.length() as usize;
    if length <= most {
        value.as_string()
    } else {
        None
    }
}
