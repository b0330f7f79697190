//! HEIDENHAIN TNC7: Klartext programs with the control's own cycles 1411 and 1493.
//!
//! The block head, the order of parameters and their comments are those of the manual's example, letter by letter
//! (`TRANSER POSITION` too). That values with a tolerance go out as `QS1116="10H7"`, and the parameters of 1493, are recalled
//! and not verified on a control.

use crate::geom::Plane;
use crate::num::decimal;
use crate::path::ParameterValue;
use crate::post::{PostDef, Program, Request};

pub static DEF: PostDef = PostDef {
    key: "heidenhain",
    title: "HEIDENHAIN TNC7 (Klartext)",
    extension: "h",
    work_offsets: 0,
    work_offset_word: |_| String::new(),
    no_work_offset: "cycle 1411 corrects the active preset itself, as Q1120 and Q1121 say: leave the work offset empty",
    first_length: false,
    plain_arithmetic: false,
    arcs_as_rapids: false,
    supports,
    check: |_, _| {},
    emit,
};

fn supports(cycle: &str, form: &str) -> Result<(), &'static str> {
    match (cycle, form) {
        ("probing-two-circles", "cycle") => Ok(()),
        ("probing-two-circles", _) => Err(
            "the control's low-level probing blocks are not documented well enough in what we have to print these moves: use its \
             own cycle",
        ),
        _ => {
            Err("no documented cycle of the control takes exactly these points and approaches, and plain moves are not printed")
        }
    }
}

/// A program name that the control takes: letters, digits, `_` and `-`.
fn program_name(name: &str) -> String {
    let safe: String = name.chars().take(32).map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' }).collect();
    if safe.is_empty() { "PROBE".to_owned() } else { safe }
}

fn emit(request: &Request<'_>) -> Program {
    let unit = if request.scale == 1.0 { "MM" } else { "INCH" };
    let name = program_name(request.name);
    let axis = match request.plane {
        Plane::G17 => "Z",
        Plane::G18 => "Y",
        Plane::G19 => "X",
    };
    let mut text = format!("0 BEGIN PGM {name} {unit}\n1 TOOL CALL {} {axis} S50\n", request.tool);
    let mut number = 2;
    let extrusion = |code: i32| matches!(code, 1140 | 1145 | 1146 | 1149);
    let (before, block): (Vec<_>, Vec<_>) = request.path.parameters.iter().partition(|p| extrusion(p.code));
    for (head, parameters) in [("1493 EXTRUSION PROBING", before), ("1411 PROBING TWO CIRCLES", block)] {
        if parameters.is_empty() {
            continue;
        }
        text.push_str(&format!("{number} TCH PROBE {head}"));
        for parameter in parameters {
            text.push_str(&format!(" ~\n    {} ;{}", word(parameter.code, &parameter.value, request.scale), parameter.meaning));
        }
        text.push('\n');
        number += 1;
    }
    text.push_str(&format!("{number} END PGM {name} {unit}\n"));
    // The control makes every move by itself.
    Program { text, move_lines: vec![None; request.path.moves.len()] }
}

/// `Q1116=+10`, or `QS1116="10H7"`.
fn word(code: i32, value: &ParameterValue, scale: f64) -> String {
    let places = if scale == 1.0 { 4 } else { 5 };
    let signed = |x: f64| {
        let text = decimal(x, places);
        if text.starts_with('-') { text } else { format!("+{text}") }
    };
    match value {
        ParameterValue::Length(mm) => format!("Q{code}={}", signed(mm / scale)),
        ParameterValue::Number(x) => format!("Q{code}={}", signed(*x)),
        ParameterValue::Whole(n) => format!("Q{code}={}", signed(f64::from(*n))),
        ParameterValue::Flag(on) => format!("Q{code}={}", signed(f64::from(u8::from(*on)))),
        ParameterValue::Text(text) => format!("QS{code}=\"{}\"", text.replace(',', ".")),
    }
}
