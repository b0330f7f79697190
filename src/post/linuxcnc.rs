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
use crate::post::{PostDef, Program, Request, check_plain_moves, expr, work_offset_word};
use crate::spec::Checker;

pub static DEF: PostDef = PostDef {
    key: "linuxcnc",
    title: "LinuxCNC",
    extension: "ngc",
    work_offsets: 9,
    no_work_offset: "",
    plain_arithmetic: true,
    supports: |_, form| match form {
        "moves" => Ok(()),
        _ => Err("LinuxCNC has no probing cycles of its own: its shipped macros choose their own points and touches"),
    },
    check,
    emit,
};

static DIALECT: Dialect = Dialect { decimals_mm: 4, decimals_inch: 5, probe: "G38.2" };

/// A line of LinuxCNC may have 255 characters.
const LINE_LIMIT: usize = 255;

fn check(request: &Request<'_>, checker: &mut Checker) {
    check_plain_moves(request, checker);
    let Some(datum) = request.path.formula.datum.as_ref() else { return };
    let rotary = request.path.formula.results.iter().any(|r| matches!(r.code, "preset.table" | "table.turn"));
    if rotary {
        let message =
            "LinuxCNC has no rotary table that a program could know of: Q1121 = 2 and Q1126 are for the control's own cycle";
        checker.error("rotary-unsupported", "cycle.confirmRotation", message);
    }
    if request.work_offset.is_some() {
        if datum.rotation.is_some() && request.plane != Plane::G17 {
            let message = "LinuxCNC turns a work offset about Z only: no rotation can be written in this plane";
            checker.error("rotation-unsupported", "cycle.confirmRotation", message);
        }
        if datum.point.is_none() && datum.rotation.is_none() {
            let message = "A work offset is chosen, but neither the transfer of a position (Q1120) nor a rotation (Q1121): nothing is written";
            checker.warning("nothing-to-write", "control.workOffset", message);
        }
    }
}

fn emit(request: &Request<'_>) -> Program {
    let [a, o, _] = request.plane.axes();
    let path = request.path;
    let formula = path.formula.plain();
    let mut w = Writer::new(request, &DIALECT);
    let (first, second) = (AXIS_NAMES[a.min(o)], AXIS_NAMES[a.max(o)]);
    let written = match formula.datum.as_ref().map(|d| (d.point.is_some(), d.rotation.is_some())) {
        Some((true, true)) => format!("its {first}, {second} and rotation are written once, at the very end"),
        Some((true, false)) => format!("its {first} and {second} are written once, at the very end"),
        Some((false, true)) => "its rotation is written once, at the very end".to_owned(),
        Some((false, false)) | None => "nothing of it is written".to_owned(),
    };
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
        let value = expr::print(&formula, &assignment.expr, request.scale);
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
    let touches = &request.path.touches;
    let sample = touches[k].sample;
    let count = touches.iter().filter(|t| t.sample == sample).count();
    let first = k == 0 || touches[k - 1].sample != sample;
    let last = touches.get(k + 1).is_none_or(|t| t.sample != sample);
    for axis in (0..3).filter(|&axis| formula.uses(sample, axis)) {
        let (name, source) = (expr::trigger_name(sample, axis), 5061 + axis);
        w.line(&match (first, last) {
            (true, _) => format!("#<{name}>=#{source}"),
            (false, false) => format!("#<{name}>=[#<{name}>+#{source}]"),
            (false, true) => format!("#<{name}>=[[#<{name}>+#{source}]/{count}]"),
        });
    }
}

/// The write at the end. G10 L20 makes the current position read what it would read if the measured point were at its nominal
/// place: right in any units and under any rotation. A rotation is set first (in degrees, on top of the one that is there);
/// it turns the axes in which the way from the measured point to the current position is told.
fn write_datum(w: &mut Writer<'_>, request: &Request<'_>, formula: &Formula, n: i32, datum: &Datum) {
    let [a, o, _] = request.plane.axes();
    let name = |e: &Expr| expr::print(formula, e, request.scale);
    let current = ["#<_x>", "#<_y>", "#<_z>"];
    if let Some(rotation) = &datum.rotation {
        if let Some([(x, _), (y, _)]) = &datum.point {
            w.line(&format!("#<away_a>=[{}-{}]", current[a], name(x)));
            w.line(&format!("#<away_o>=[{}-{}]", current[o], name(y)));
        }
        // Rotation of system n: #5230, #5250 ….
        w.line(&format!("G10 L2 P{n} R[#{}+{}]", 5210 + 20 * n, name(rotation)));
    }
    let Some([(x, nominal_x), (y, nominal_y)]) = &datum.point else { return };
    w.comment("The current position less what was measured plus what is nominal: right in any units and any rotation");
    let constant = |mm: f64| match decimal(mm / request.scale, 12).as_str() {
        "0" => String::new(),
        text if text.starts_with('-') => text.to_owned(),
        text => format!("+{text}"),
    };
    let (away_x, away_y) = match &datum.rotation {
        None => (format!("{}-{}", current[a], name(x)), format!("{}-{}", current[o], name(y))),
        Some(turn) => {
            let turn = name(turn);
            (format!("#<away_a>*COS[{turn}]+#<away_o>*SIN[{turn}]"), format!("#<away_o>*COS[{turn}]-#<away_a>*SIN[{turn}]"))
        }
    };
    let mut words = [String::new(), String::new(), String::new()];
    words[a] = format!(" {}[{away_x}{}]", AXIS_NAMES[a], constant(*nominal_x));
    words[o] = format!(" {}[{away_y}{}]", AXIS_NAMES[o], constant(*nominal_y));
    w.line(&format!("G10 L20 P{n}{}", words.concat()));
}
