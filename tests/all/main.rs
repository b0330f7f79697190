//! The integration tests: one binary, a module a subject. `cargo test --test all safety` runs one of them.
#![cfg(not(target_arch = "wasm32"))]

#[path = "../common/mod.rs"]
mod common;

mod circles;
mod does;
mod edges;
mod family;
mod fanuc;
mod faults;
mod generated;
mod golden;
mod inertia;
mod iso286;
mod laws;
mod layers;
mod lentoax;
mod line_by_line;
mod linuxcnc;
mod naming;
mod own_codes;
mod part;
mod picture;
mod plausible;
mod problems;
mod reread;
mod runout;
mod safety;
mod sinumerik;
mod stylus;
mod table;
mod toolpath;
mod wayback;
