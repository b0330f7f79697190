//! HEIDENHAIN: Klartext programs with native cycles, 1411 and 1493 of a TNC7, 408 to 427 of any TNC; what has no cycle in our sources by single touches.
//!
//! The block head, the order of parameters and their comments follow the manual's example to the letter (`TRANSER POSITION` too); `S50` in the tool call comes
//! from real programs. Recalled and not verified on a control [R]: that values with a tolerance are printed as `QS1116="10H7"`, the parameters of 1493, `INCH`
//! in `BEGIN PGM`, and the tool axes Y and X in `TOOL CALL`.

mod blocks;
pub mod cycles;
mod functions;
mod plan_calls;
pub mod read;

use std::ops::Range;

use crate::control::iso::codes::Family;
use crate::control::iso::writer::{Dialect, PLAIN, Writer, stated_start};
use crate::control::moves::{self, MoveContext, Moves};
use crate::control::shop::place;
use crate::control::{
    Ask, BASE, ORIENT, PostDef, Program, ProgramForm, Request, check_orientation, write_summary,
};
use crate::form::Checker;
use crate::geom::Plane;
use crate::num::decimal;
use crate::path::{FeatureKind, Move, ParameterValue, Setting, Touch};
use crate::text::{text, words};

pub static DEF: PostDef = PostDef {
    key: "heidenhain",
    title: "HEIDENHAIN TNC7 (Klartext)",
    about: "a Klartext program with the control's own cycles: 1411, tolerances, semi-automatic and given positions included; 408 to 427 for surfaces, circles, rectangles, webs and grooves along the axes, which measure only or write a row of the preset table; corners and the angle of a wall by single touches of cycle 427, measuring only. Not verified on a control.",
    extension: "h",
    work_offsets: 99,
    cycle_sets_preset: |subject| subject == FeatureKind::TwoCircles,
    work_offset_word: |n| format!("preset row {n}"),
    computes: false,
    unsupported_rules: &[(
        ORIENT,
        words!(
            "the cycles orient the probe themselves, depending on the probe table (TRACK): the orientation of the job is not used"
        ),
    )],
    watches_positioning: false,
    family: Family::Heidenhain,
    dialect: &Dialect {
        comment: ("; ", ""),
        comment_width: 72,
        numbered: true,
        ..PLAIN
    },
    unused: &["orient", "number", "probeInput", "toolOffsets", "edition"],
    uses_tool: |_| true,
    unused_by_cycles: &[
        "control.protection",
        "feeds.approach",
        "feeds.longLink",
        "feeds.work",
        "feeds.retract",
        "feeds.return",
    ],
    name: program_name,
    rate: |request, _, step| request.feeds.rate(step.feed),
    supports: serves,
    check,
    emit,
    own: Some(&plan_calls::CYCLES),
    // Read in public programs.
    usual_lines: &[("head", &["L M140 MB MAX"]), ("foot", &["L M140 MB MAX"])],
    inside: None,
    ..BASE
};

fn serves(subject: FeatureKind, form: ProgramForm) -> Result<(), &'static str> {
    match (subject, form) {
        (FeatureKind::Switch | FeatureKind::Action, _) => Err("the control has no cycle for it"),
        (_, ProgramForm::Moves) => Err(
            "our sources do not document the control's low-level probing blocks well enough to write these moves",
        ),
        (FeatureKind::CornerOutside, ProgramForm::Cycle) => Err(
            "cycle 427 goes from wall to wall above the part, and the cycle does not give its height",
        ),
        (_, ProgramForm::Cycle) => Ok(()),
    }
}

/// A program name that the control accepts: letters, digits, `_` and `-`.
fn program_name(name: &str) -> String {
    let safe: String = name
        .chars()
        .take(32)
        .map(|c| {
            if c.is_ascii_alphanumeric() || c == '-' {
                c
            } else {
                '_'
            }
        })
        .collect();
    if safe.is_empty() {
        "PROBE".to_owned()
    } else {
        safe
    }
}

fn emit(request: &Request<'_>) -> Program {
    if let Some(own) = &request.path.calls {
        return plan_calls::emit(request, own, &program_name(request.name));
    }
    moves::write(
        request,
        &mut Klartext {
            request,
            name: program_name(request.name),
        },
    )
}

/// The program of one request.
struct Klartext<'a> {
    request: &'a Request<'a>,
    name: String,
}

impl Klartext<'_> {
    /// First and last block.
    fn frame(&self, w: &mut Writer<'_>, word: &str) {
        w.parts(&[
            word,
            " PGM ",
            &self.name,
            if self.request.scale == 1.0 {
                " MM"
            } else {
                " INCH"
            },
        ]);
    }
}

impl Moves for Klartext<'_> {
    fn begin(&mut self, w: &mut Writer<'_>) {
        let request = self.request;
        let axis = match request.plane {
            Plane::G17 => "Z",
            Plane::G18 => "Y",
            Plane::G19 => "X",
        };
        self.frame(w, "BEGIN");
        w.comment(&format!("Job: {}", self.name));
        w.comment(&format!("{}: {}", request.source, request.title));
        w.comment(&format!(
            "Units {}, plane {}, stylus ball diameter {}",
            if request.scale == 1.0 { "mm" } else { "inch" },
            request.plane.word(),
            w.number(2.0 * request.setup.radius)
        ));
        w.comment(&write_summary::line(request, ""));
        w.comment(&match request.tool {
            Some(tool) => format!("Before the start: tool {tool} is the probe, it is called"),
            None => format!("Before the start: the probe is in the spindle and active, tool axis {axis}. No tool is called"),
        });
        if let Some(start) = request.path.start {
            let text = stated_start(request, &w.place_words(start));
            w.comment(&format!("{text} The control moves from there by itself"));
        }
        w.comment(
            "Reset every coordinate transformation first, such as cycles 8, 11, 26 and TRANS MIRROR; FUNCTION MODE MILL only",
        );
        if let Some(circles) = request.path.feature.two_circles() {
            w.comment(
                "In a tilted plane that fits the rotary axes a basic rotation is one of the input system, else of the workpiece system",
            );
            if write_summary::code(circles, 1126) != 0 {
                w.comment(
                    "Only a rotary TABLE axis can be aligned: the first one from the part, if it can make up for the rotation",
                );
            }
        }
        w.comment("Not verified on a control: run it with a hand on the feed override");
        w.says_job();
        w.shop(&place::HEAD);
        if let Some(tool) = request.tool {
            w.line(&format!("TOOL CALL {tool} {axis} S50"));
        }
        w.shop(&place::PROBE_ON);
    }

    fn own_cycles(&self) -> Vec<Range<usize>> {
        std::iter::once(0..self.request.path.moves.len()).collect()
    }

    fn call(&self, _: usize, w: &mut Writer<'_>) {
        let Some(circles) = self.request.path.feature.two_circles() else {
            return;
        };
        for (head, settings) in [
            ("1493 EXTRUSION PROBING", &circles.extrusion),
            ("1411 PROBING TWO CIRCLES", &circles.settings),
        ] {
            if settings.is_empty() {
                continue;
            }
            w.parts(&["TCH PROBE ", head, " ~"]);
            for (
                i,
                Setting {
                    number,
                    value,
                    dialog,
                },
            ) in settings.iter().enumerate()
            {
                let continues = if i + 1 < settings.len() { " ~" } else { "" };
                w.continued(&format!(
                    "    {} ;{dialog}{continues}",
                    word(*number, value, w)
                ));
            }
        }
    }

    // The cycle makes every move.

    fn approach(&mut self, _: &mut Writer<'_>, _: &Move) {}

    fn position(&mut self, _: &mut Writer<'_>, _: MoveContext<'_>) {}

    fn touch(&mut self, _: &mut Writer<'_>, _: MoveContext<'_>, _: &Touch) {}

    fn retract(&mut self, _: &mut Writer<'_>, _: MoveContext<'_>) {}

    fn end(&mut self, w: &mut Writer<'_>) {
        self.frame(w, "END");
    }
}

/// Checks angles: the control has three decimals.
fn check(request: &Request<'_>, checker: &mut Checker) {
    check_orientation(request, checker);
    if request.path.calls.is_some() {
        return plan_calls::check(request, checker);
    }
    if request.work_offset.is_some() {
        let message = text!(
            "cycle 1411 corrects the active preset itself, depending on Q1120 and Q1121: leave the work offset empty"
        );
        checker.error("work-offset-unsupported", "control.workOffset", message);
    }
    if request.ask != Ask::Never && request.corrects_preset() {
        let message =
            text!("The native cycle measures and writes in one block: it cannot ask first");
        checker.error("ask-unsupported", "control.ask", message);
    }
    for (code, path) in [(325, "cycle.startingAngle"), (1119, "cycle.angularLength")] {
        let settings = request
            .path
            .feature
            .two_circles()
            .map_or(&[][..], |c| &c.settings);
        if let Some(ParameterValue::Number(angle)) =
            settings.iter().find(|s| s.number == code).map(|s| &s.value)
            && (angle * 1e3 - (angle * 1e3).round()).abs() > 1e-6
        {
            let message = text!(
                "The control takes three decimals: Q{code} is written as {angle}",
                code,
                decimal(*angle, 3)
            );
            checker.info("angle-rounded", path, message);
        }
    }
}

/// `Q1116=+10`, or `QS1116="10H7"`.
fn word(code: i32, value: &ParameterValue, w: &Writer<'_>) -> String {
    let signed = |text: &str| {
        format!(
            "Q{code}={}{text}",
            if text.starts_with('-') { "" } else { "+" }
        )
    };
    match value {
        ParameterValue::Length(mm) => signed(&w.number(*mm)),
        // Q325 and Q1119 have three decimals.
        ParameterValue::Number(x) => signed(&decimal(*x, 3)),
        ParameterValue::Whole(n) => signed(&n.to_string()),
        ParameterValue::Flag(on) => signed(if *on { "1" } else { "0" }),
        ParameterValue::Word(word) => format!("Q{code}={word}"),
        ParameterValue::Text(text) => format!("QS{code}=\"{}\"", text.replace(',', ".")),
    }
}
