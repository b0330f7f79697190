//! grbl 1.1 and its kin: the moves alone.
//!
//! Sources: grbl's motion control and its interface document. grbl has no variables and no arithmetic: after each touch it
//! reports `[PRB:x,y,z:1]` in machine coordinates, and the sender has to do the rest. It does not watch the probe during
//! positioning moves.

use crate::path::Purpose;
use crate::post::words::{Dialect, Writer};
use crate::post::{PostDef, Program, Request, check_plain_moves};
use crate::spec::Checker;

pub static DEF: PostDef = PostDef {
    key: "grbl",
    title: "grbl",
    extension: "nc",
    work_offsets: 0,
    work_offset_word: |_| String::new(),
    no_work_offset: "grbl has no variables, so the program cannot compute an offset: let the sender read the [PRB:] reports and write it",
    first_length: false,
    plain_arithmetic: false,
    arcs_as_rapids: false,
    supports: |_, form| if form == "moves" { Ok(()) } else { Err("grbl has no probing cycles of its own") },
    check,
    emit,
};

static DIALECT: Dialect = Dialect {
    decimals_mm: 4,
    decimals_inch: 5,
    probe: "G38.2",
    comment: ("(", ")"),
    units: ("G21", "G20"),
    modes: "G40 G61 G80 G90",
    arcs: " G91.1",
};

fn check(request: &Request<'_>, checker: &mut Checker) {
    check_plain_moves(request, checker);
    checker.info(
        "no-results-in-program",
        "control.post",
        "grbl computes nothing: it reports [PRB:x,y,z:1] in machine coordinates after each touch; the results shown are what \
         those points give",
    );
    checker.info(
        "positioning-not-watched",
        "control.post",
        "grbl does not watch the probe in positioning moves: a contact there goes unnoticed",
    );
}

fn emit(request: &Request<'_>) -> Program {
    let mut w = Writer::new(request, &DIALECT);
    w.header("Measures only: each touch is reported as PRB in machine coordinates");
    w.comment("Positioning moves are NOT watched: a contact there goes unnoticed");
    w.modes();
    for step in &request.path.moves {
        match step.purpose {
            Purpose::Position | Purpose::Touch(_) | Purpose::Back(_) => w.motion(step),
        }
    }
    w.line("M2");
    w.finish()
}
