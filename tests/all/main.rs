//! The integration tests: one binary, a module a subject. `cargo test --test all safety` runs one of them.
#![cfg(not(target_arch = "wasm32"))]

#[path = "../common/mod.rs"]
mod common;

mod circles;
mod edges;
mod family;
mod fanuc;
mod faults;
mod generated;
mod golden;
mod iso286;
mod laws;
mod layers;
mod lentoax;
mod line_by_line;
mod linuxcnc;
mod own_codes;
mod part;
mod picture;
mod problems;
mod reread;
mod safety;
mod sinumerik;
mod table;
mod toolpath;
