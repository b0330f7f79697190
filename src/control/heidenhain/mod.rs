//! HEIDENHAIN TNC7: Klartext programs with the control's own cycles 1411 and 1493.
//!
//! The block head, the order of parameters and their comments are those of the manual's example, letter by letter
//! (`TRANSER POSITION` too); `S50` in the tool call is that of real programs. Recalled and not verified on a control: that values with a
//! tolerance go out as `QS1116="10H7"`, the parameters of 1493, `INCH` in `BEGIN PGM`, and the tool axes Y and X in `TOOL CALL`.

pub mod read;

use crate::control::iso::writer::{Dialect, PLAIN, stated_start, wrapped};
use crate::control::{BASE, Form, PostDef, Program, Request, check_orientation, does, header};
use crate::form::Checker;
use crate::geom::{AXIS_NAMES, Plane};
use crate::num::decimal;
use crate::path::{ParameterValue, Subject};
use crate::text::{text, words};

pub static DEF: PostDef = PostDef {
    key: "heidenhain",
    title: "HEIDENHAIN TNC7 (Klartext)",
    about: "a Klartext program with the control's own cycle 1411, tolerances, semi-automatic and given positions included. Not verified on a control.",
    extension: "h",
    no_work_offset: words!("cycle 1411 corrects the active preset itself, as Q1120 and Q1121 say: leave the work offset empty"),
    computes: false,
    orients: Err(words!(
        "cycle 1411 orients the probe itself, as the probe table says (TRACK): the orientation of the job is not used"
    )),
    watches: false,
    dialect: &Dialect { decimals_inch: 4, comment: ("; ", ""), ..PLAIN },
    unused: &["orient", "report", "number"],
    name: program_name,
    rate: |request, _, step| request.feeds.rate(step.feed),
    serves,
    check,
    emit,
    ..BASE
};

fn serves(subject: Subject, form: Form) -> Result<(), &'static str> {
    match (subject, form) {
        (Subject::TwoCircles, Form::Cycle) => Ok(()),
        (Subject::TwoCircles, Form::Moves) => Err(
            "our sources do not document the control's low-level probing blocks well enough to write these moves: use its own cycle",
        ),
        _ => Err(
            "no documented cycle of the control takes exactly these points and approaches, and plain moves are not supported",
        ),
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
    let mut text = format!("0 BEGIN PGM {name} {unit}\n");
    let mut number = 1;
    for comment in comments(request, &name, axis) {
        text.push_str(&format!("{number} ; {comment}\n"));
        number += 1;
    }
    if let Some(tool) = request.tool {
        text.push_str(&format!("{number} TOOL CALL {tool} {axis} S50\n"));
        number += 1;
    }
    let circles = request.path.feature.two_circles();
    let blocks = circles.map(|c| [("1493 EXTRUSION PROBING", &c.extrusion), ("1411 PROBING TWO CIRCLES", &c.settings)]);
    for (head, settings) in blocks.into_iter().flatten() {
        if settings.is_empty() {
            continue;
        }
        text.push_str(&format!("{number} TCH PROBE {head}"));
        for setting in settings {
            text.push_str(&format!(" ~\n    {} ;{}", word(setting.number, &setting.value, request.scale), setting.dialog));
        }
        text.push('\n');
        number += 1;
    }
    text.push_str(&format!("{number} END PGM {name} {unit}\n"));
    header::seal(&mut text);
    // The control makes every move by itself.
    Program { text, move_lines: vec![None; request.path.moves.len()] }
}

/// The most characters of a comment: a whole line stays below 80.
const COMMENT_WIDTH: usize = 70;

/// What will happen, as comments. None ends in the sign that continues a block.
fn comments(request: &Request<'_>, name: &str, axis: &str) -> Vec<String> {
    let places = if request.scale == 1.0 { 4 } else { 5 };
    let number = |mm: f64| decimal(mm / request.scale, places);
    let mut lines = vec![
        format!("Job: {name}"),
        format!("{}: {}", request.source, request.title),
        format!(
            "Units {}, plane {}, stylus ball diameter {}",
            if request.scale == 1.0 { "mm" } else { "inch" },
            request.plane.word(),
            number(2.0 * request.setup.radius)
        ),
    ];
    lines.push(does::line(request, ""));
    match request.tool {
        Some(tool) => lines.push(format!("Before the start: tool {tool} is the probe, it is called")),
        None => {
            lines.push(format!("Before the start: the probe is in the spindle and active, tool axis {axis}. No tool is called"))
        }
    }
    if let Some(start) = request.path.start {
        let place: Vec<String> = (0..3).map(|i| format!("{}{}", AXIS_NAMES[i], number(start[i]))).collect();
        lines.push(format!("{} The control moves from there by itself", stated_start(request, &place.join(" "))));
    }
    lines.push(
        "Reset every coordinate transformation first, such as cycles 8, 11, 26 and TRANS MIRROR; FUNCTION MODE MILL only"
            .to_owned(),
    );
    lines.push("Not verified on a control: run it with a hand on the feed override".to_owned());
    lines.extend(header::lines(request, COMMENT_WIDTH, false));
    lines.iter().flat_map(|line| wrapped(line, COMMENT_WIDTH)).collect()
}

/// Angles have three decimals on the control.
fn check(request: &Request<'_>, checker: &mut Checker) {
    check_orientation(request, checker);
    for (code, path) in [(325, "cycle.startingAngle"), (1119, "cycle.angularLength")] {
        let settings = request.path.feature.two_circles().map_or(&[][..], |c| &c.settings);
        if let Some(ParameterValue::Number(angle)) = settings.iter().find(|s| s.number == code).map(|s| &s.value)
            && (angle * 1e3 - (angle * 1e3).round()).abs() > 1e-6
        {
            let message = text!("The control takes three decimals: Q{code} is written as {angle}", code, decimal(*angle, 3));
            checker.info("angle-rounded", path, message);
        }
    }
}

/// `Q1116=+10`, or `QS1116="10H7"`.
fn word(code: i32, value: &ParameterValue, scale: f64) -> String {
    let places = if scale == 1.0 { 4 } else { 5 };
    // Q325 and Q1119 have three decimals.
    let places = if matches!(value, ParameterValue::Number(_)) { 3 } else { places };
    let signed = |x: f64| {
        let text = decimal(x, places);
        if text.starts_with('-') { text } else { format!("+{text}") }
    };
    match value {
        ParameterValue::Length(mm) => format!("Q{code}={}", signed(mm / scale)),
        ParameterValue::Number(x) => format!("Q{code}={}", signed(*x)),
        ParameterValue::Whole(n) => format!("Q{code}={}", signed(f64::from(*n))),
        ParameterValue::Flag(on) => format!("Q{code}={}", signed(f64::from(u8::from(*on)))),
        ParameterValue::Word(word) => format!("Q{code}={word}"),
        ParameterValue::Text(text) => format!("QS{code}=\"{}\"", text.replace(',', ".")),
    }
}
