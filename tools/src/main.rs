//! `bindings MODULE FOLDER`: writes the JavaScript bindings of a WebAssembly module for the web.
//!
//! It does what `wasm-bindgen --target web` does, and compiles in half the time: the command brings an HTTP server and a client for its test runner.

use std::path::PathBuf;

use anyhow::Context;
use wasm_bindgen_cli_support::Bindgen;

fn main() -> anyhow::Result<()> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let module = arguments.next().context("the module is missing")?;
    let folder = arguments.next().context("the folder is missing")?;
    // The bindings find the module beside themselves, and can put a new instance in the place of a broken one: www/core/instance.ts does so.
    Bindgen::new()
        .input_path(module)
        .web(true)?
        .typescript(true)
        .omit_default_module_path(false)
        .reset_state_function(true)
        .generate(folder)
}
