//! The tests of the crate, a module a subject: `cargo test --lib safety` runs one of them.

mod border;
mod circles;
mod controls;
mod does;
mod edges;
mod family;
mod fanuc;
mod faults;
mod generated;
mod golden;
mod inertia;
mod iso286;

mod klartext_cycles;
mod laws;
mod layers;
mod lentoax;
mod line_by_line;
mod linuxcnc;
mod measuring_cycles;
mod naming;
mod own_codes;
mod own_cycles;
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
mod typed;
mod wayback;
