//! LinuxCNC: touches as G38.2, results computed in the program, one write of the work offset at the very end.
//!
//! Sources: LinuxCNC's g-code and overview documents and its interpreter. #5061… are the ball centre at the trigger in the
//! current work system and the program's units. A contact in any move that is not a probe move aborts ("Probe tripped
//! during non-probe move"), so positioning needs no words of its own. G38.2 stays modal: an explicit G1 or G0 follows.
//! M70 saves the modes that the program states and M72 gives them back, so that nothing leaks into the next program.

use crate::formula::{Datum, Expr, Formula};
use crate::geom::{AXIS_NAMES, Plane};
use crate::num::decimal;
use crate::path::Purpose;
use crate::post::words::{Dialect, Writer};
use crate::post::{PostDef, Program, Request, check_plain_moves, check_rotary, check_write, expr, work_offset_word, written};
use crate::spec::Checker;

pub static DEF: PostDef = PostDef {
    key: "linuxcnc",
    title: "LinuxCNC",
    extension: "ngc",
    work_offsets: 9,
    work_offset_word,
    no_work_offset: "",
    first_length: false,
    plain_arithmetic: true,
    arcs_as_rapids: false,
    supports: |_, form| match form {
        "moves" => Ok(()),
        _ => Err("LinuxCNC has no probing cycles of its own: its shipped macros choose their own points and touches"),
    },
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

/// A line of LinuxCNC may have 255 characters.
const LINE_LIMIT: usize = 255;

fn check(request: &Request<'_>, checker: &mut Checker) {
    check_plain_moves(request, checker);
    check_rotary(request, checker, "LinuxCNC has no rotary table that a program could know of");
    check_write(request, checker);
    let Some(datum) = request.path.formula.datum.as_ref() else { return };
    if request.work_offset.is_some() && datum.rotation.is_some() && request.plane != Plane::G17 {
        let message = "LinuxCNC turns a work offset about Z only: no rotation can be written in this plane";
        checker.error("rotation-unsupported", "cycle.confirmRotation", message);
    }
}

fn emit(request: &Request<'_>) -> Program {
    let path = request.path;
    let formula = path.formula.plain();
    let mut w = Writer::new(request, &DIALECT);
    let written = written(request, formula.datum.as_ref());
    let offset = match request.work_offset {
        Some(n) => format!("Work offset: {} P{n} is selected first; {written}", work_offset_word(n)),
        None => "Measures only, in the work offset that is active: nothing is written".to_owned(),
    };
    w.header(&offset);
    w.comment("A contact in a move other than G38.2 stops LinuxCNC by itself");
    w.line("M70");
    w.modes();
    if let Some(n) = request.work_offset {
        w.line(&work_offset_word(n));
    }
    for step in &path.moves {
        w.motion(step);
        if let Purpose::Touch(k) = step.purpose {
            latch(&mut w, request, &formula, k);
        }
    }
    for assignment in &formula.assignments {
        let value = expr::print(&expr::Rs274, &formula, &assignment.expr, request.scale);
        let line = format!("#<{}>=[{value}]", assignment.name);
        debug_assert!(line.len() <= LINE_LIMIT, "{line}");
        w.line(&line);
    }
    for result in &formula.results {
        if let Some(variable) = result.variable {
            let name = &formula.assignments[variable].name;
            w.line(&format!("(PRINT,{}=#<{name}>)", result.code));
        }
    }
    if let (Some(n), Some(datum)) = (request.work_offset, &formula.datum) {
        write_datum(&mut w, request, &formula, n, datum);
    }
    w.line("M72");
    w.line("M2");
    w.finish()
}

/// Keeps what the formula needs of a touch. Repeated touches of a sample are added up, and divided after the last one.
fn latch(w: &mut Writer<'_>, request: &Request<'_>, formula: &Formula, k: usize) {
    let sample = request.path.samples(k);
    for axis in (0..3).filter(|&axis| formula.uses(sample.index, axis)) {
        let (name, source) = (expr::trigger_name(sample.index, axis), 5061 + axis);
        w.line(&match (sample.first, sample.last) {
            (true, _) => format!("#<{name}>=#{source}"),
            (false, false) => format!("#<{name}>=[#<{name}>+#{source}]"),
            (false, true) => format!("#<{name}>=[[#<{name}>+#{source}]/{}]", sample.count),
        });
    }
}

/// The write at the end. G10 L20 makes the current position read what it would read if the measured point were at its nominal
/// place: right in any units and under any rotation, as long as both axes of the plane are named. A rotation is set first (in
/// degrees, on top of the one that is there); it turns the axes in which the way from the measured point to the current position
/// is told.
fn write_datum(w: &mut Writer<'_>, request: &Request<'_>, formula: &Formula, n: i32, datum: &Datum) {
    let axes = request.plane.axes();
    let name = |e: &Expr| expr::print(&expr::Rs274, formula, e, request.scale);
    let current = axes.map(|axis| ["#<_x>", "#<_y>", "#<_z>"][axis]);
    let turned = datum.rotation.as_ref().map(name);
    if let Some(turn) = &turned {
        if let [Some((x, _)), Some((y, _)), _] = &datum.place {
            w.line(&format!("#<away_a>=[{}-{}]", current[0], name(x)));
            w.line(&format!("#<away_o>=[{}-{}]", current[1], name(y)));
        }
        // Rotation of system n: #5230, #5250 ….
        w.line(&format!("G10 L2 P{n} R[#{}+{turn}]", 5210 + 20 * n));
    }
    if datum.measured() == [false; 3] {
        return;
    }
    w.comment("The current position less what was measured plus what is nominal: right in any units and any rotation");
    let constant = |mm: f64| match decimal(mm / request.scale, 12).as_str() {
        "0" => String::new(),
        text if text.starts_with('-') => text.to_owned(),
        text => format!("+{text}"),
    };
    let mut words = [String::new(), String::new(), String::new()];
    for (i, place) in datum.place.iter().enumerate() {
        let Some((measured, nominal)) = place else { continue };
        let value = match (measured, &turned, i) {
            // Not measured: it reads on as it does.
            (Expr::Length(_), ..) => current[i].to_owned(),
            (_, Some(turn), 0) => format!("#<away_a>*COS[{turn}]+#<away_o>*SIN[{turn}]{}", constant(*nominal)),
            (_, Some(turn), 1) => format!("#<away_o>*COS[{turn}]-#<away_a>*SIN[{turn}]{}", constant(*nominal)),
            _ => format!("{}-{}{}", current[i], name(measured), constant(*nominal)),
        };
        words[axes[i]] = format!(" {}[{value}]", AXIS_NAMES[axes[i]]);
    }
    w.line(&format!("G10 L20 P{n}{}", words.concat()));
}
