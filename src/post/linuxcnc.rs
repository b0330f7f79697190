//! LinuxCNC: touches as G38.2, results computed in the program, one write of the work offset at the very end.
//!
//! Sources: LinuxCNC's g-code and overview documents and its interpreter. #5061… are the ball centre at the trigger in the
//! current work system and the program's units. A contact in any move that is not a probe move aborts ("Probe tripped
//! during non-probe move"), so positioning needs no words of its own. G38.2 stays modal: an explicit G1 or G0 follows.
//! M70 saves the modes that the program states and M72 gives them back, so that nothing leaks into the next program.

use crate::formula::Role;
use crate::geom::AXIS_NAMES;
use crate::num::decimal;
use crate::path::Purpose;
use crate::post::words::{Dialect, Writer};
use crate::post::{PostDef, Program, Request, expr, work_offset_word};

pub static DEF: PostDef = PostDef {
    key: "linuxcnc",
    title: "LinuxCNC",
    extension: "ngc",
    work_offsets: 9,
    no_work_offset: "",
    no_cycle_form: "LinuxCNC has no probing cycles of its own: its shipped macros choose their own points and touches",
    notes: |_| {},
    emit,
};

static DIALECT: Dialect = Dialect { decimals_mm: 4, decimals_inch: 5, probe: "G38.2" };

/// A line of LinuxCNC may have 255 characters.
const LINE_LIMIT: usize = 255;

fn emit(request: &Request<'_>) -> Program {
    let [a, o, _] = request.plane.axes();
    let path = request.path;
    let mut w = Writer::new(request, &DIALECT);
    let offset = match request.work_offset {
        Some(n) => format!(
            "Work offset: {} P{n} is selected first; its {} and {} are written once, at the very end",
            work_offset_word(n),
            AXIS_NAMES[a.min(o)],
            AXIS_NAMES[a.max(o)]
        ),
        None => "Measures only, in the work offset that is active: nothing is written".to_owned(),
    };
    w.header(&offset);
    w.comment("A contact in a move other than G38.2 stops LinuxCNC by itself");
    w.line("M70");
    w.line(if request.scale == 1.0 { "G21" } else { "G20" });
    w.line(&format!("{} G40 G61 G80 G90 G94", request.plane.word()));
    w.line("M5 M9");
    if let Some(n) = request.work_offset {
        w.line(&work_offset_word(n));
    }
    for step in &path.moves {
        w.motion(step);
        if let Purpose::Touch(k) = step.purpose {
            for axis in (0..3).filter(|&axis| path.formula.uses(k, axis)) {
                w.line(&format!("#<{}>=#{}", expr::trigger_name(k, axis), 5061 + axis));
            }
        }
    }
    for assignment in &path.formula.assignments {
        let value = expr::print(&path.formula, &assignment.expr, request.scale);
        let line = format!("#<{}>=[{value}]", assignment.name);
        debug_assert!(line.len() <= LINE_LIMIT, "{line}");
        w.line(&line);
    }
    for result in &path.formula.results {
        if let Some(variable) = result.variable {
            let name = &path.formula.assignments[variable].name;
            w.line(&format!("(PRINT,{}=#<{name}>)", result.code));
        }
    }
    if let Some(n) = request.work_offset {
        w.comment("The current position less what was measured plus what is nominal: right in any units and any rotation");
        let mut words = [String::new(), String::new(), String::new()];
        for result in &path.formula.results {
            let axis = match result.role {
                Role::Abscissa => a,
                Role::Ordinate => o,
                Role::Size | Role::Angle | Role::Direction => continue,
            };
            if let Some(variable) = result.variable {
                let measured = &path.formula.assignments[variable].name;
                let nominal = match decimal(result.nominal / request.scale, 12).as_str() {
                    "0" => String::new(),
                    text if text.starts_with('-') => text.to_owned(),
                    text => format!("+{text}"),
                };
                let current = ["#<_x>", "#<_y>", "#<_z>"][axis];
                words[axis] = format!(" {}[{current}-#<{measured}>{nominal}]", AXIS_NAMES[axis]);
            }
        }
        w.line(&format!("G10 L20 P{n}{}", words.concat()));
    }
    w.line("M72");
    w.line("M2");
    w.finish()
}
