//! The program of calls to Renishaw's macros.
//!
//! Sources: the macros themselves (version 3.14 for Haas NGC), the post that the CAM's maker publishes and those of another, shop programs [S].
//! Ours, and marked [I] in the docs: Q as the overtravel less the ball's radius, R as the side clearance less it, heights as those of the stylus tip, the
//! variables #101 and following for what the next call empties.

use super::check::{check_digits, check_optional_offset};
use super::flavour::Flavour;
use super::{STANDARD_OFFSETS, number};
use crate::control::iso::writer::Writer;
use crate::control::own::OwnCycles;
use crate::control::renishaw::cycles;
use crate::control::{Program, Request, check_plain_moves, check_rotary, check_write, does, orientation_line};
use crate::form::Checker;
use crate::num::{decimal, format_count};
use crate::path::{Own, OwnBlock, Quantity, STATED_RAPID, Stored};
use crate::text::text;

/// S1 to S6 for G54 to G59; S101 and following for G54.1 P1, S154.01 for G154 P1 [S].
pub(super) static FANUC: OwnCycles =
    cycles(|n| f64::from(if n <= STANDARD_OFFSETS { n } else { 100 + n - STANDARD_OFFSETS }), |stored| variable(135, stored));
pub(super) static HAAS: OwnCycles = cycles(
    |n| if n <= STANDARD_OFFSETS { f64::from(n) } else { 154.0 + f64::from(n - STANDARD_OFFSETS) / 100.0 },
    |stored| variable(185, stored),
);

/// The variable that a result is in.
fn variable(base: usize, stored: Stored) -> String {
    let number = match stored {
        Stored::Output(output) => base + output,
        Stored::Kept(variable) => variable,
    };
    format!("#{number}")
}

/// The macros that ask for a calibration by directions.
const BY_DIRECTIONS: [u32; 3] = [9821, 9822, 9823];

/// What the macros of this program ask for and do.
pub(super) fn check(request: &Request<'_>, checker: &mut Checker) {
    let Some(own) = &request.path.own else { return };
    let message = text!(
        "The program calls Renishaw's macros, which must be installed and calibrated: they choose touches, order and feeds. Nothing of it was run on a control: try it without a part, with a hand on feed hold"
    );
    checker.info("not-verified", "control.form", message);
    let directions =
        own.blocks.iter().any(|(block, _)| matches!(block, OwnBlock::Call(number, _) if BY_DIRECTIONS.contains(number)));
    if directions {
        let message = text!("Turned features and three touches ask for a calibration by directions, P9804");
        checker.warning("needs-calibration", "control.form", message);
    }
    if request.limits.position.is_some() || request.limits.size.is_some() {
        let message = text!(
            "A result that is off by more than its limit stops the macro with a message before it writes: who starts the program again lets it write"
        );
        checker.info("limit-stops", "limits", message);
    }
    check_plain_moves(request, checker);
    check_rotary(request, checker, text!("The program does not know the rotary axis of the machine"));
    let datum = request.path.formula.datum.as_ref().filter(|_| request.work_offset.is_some());
    if datum.is_some_and(|d| d.rotation.is_some()) {
        let message = text!("A work offset of this control has no rotation: none can be written");
        checker.error("rotation-unsupported", "cycle.confirmRotation", message);
    }
    check_write(request, checker);
    check_optional_offset(request, checker);
    number::check(request, checker);
    check_digits(request, checker);
}

pub(super) fn emit(request: &Request<'_>, flavour: &'static Flavour) -> Program {
    let mut w = Writer::new(request);
    let Some(own) = &request.path.own else { return w.finish() };
    begin(request, own, flavour, &mut w);
    let probes = !request.path.moves.is_empty();
    if probes {
        approach(request, own, &mut w);
    }
    for (block, moves) in &own.blocks {
        match block {
            OwnBlock::Call(number, letters) => {
                for _ in 0..*moves {
                    // A protected move is the program's, the rest is the macro's.
                    if *number == 9810 { w.makes_move() } else { w.leaves_move() }
                }
                let words: Vec<String> =
                    letters.iter().map(|(letter, quantity)| format!(" {letter}{}", word(&w, *quantity))).collect();
                w.line(&format!("G65 P{number}{}", words.concat()));
            }
            OwnBlock::Keep(kept, output) => {
                let name = request.post.own.map_or_else(String::new, |cycles| (cycles.name)(Stored::Output(*output)));
                w.line(&format!("#{}={name}", format_count(*kept)));
            }
        }
    }
    if probes {
        w.line("G65 P9833");
    }
    w.line("M30");
    w.line("%");
    w.finish()
}

/// Where the stylus stands is not known: in the plane first, at whatever height, then down.
fn approach(request: &Request<'_>, own: &Own, w: &mut Writer<'_>) {
    w.line("G65 P9832");
    let (first, rate) = (own.first, request.feeds.approach.unwrap_or(STATED_RAPID));
    let [x, y, z] = [first.x, first.y, first.z - request.setup.radius].map(|mm| w.number(mm));
    let feed = w.number(rate);
    w.parts(&["G65 P9810 X", &x, " Y", &y, " F", &feed]);
    w.makes_move();
    w.parts(&["G65 P9810 Z", &z, " F", &feed]);
}

fn word(w: &Writer<'_>, quantity: Quantity) -> String {
    match quantity {
        Quantity::Length(mm) | Quantity::Feed(mm) => w.number(mm).to_string(),
        Quantity::Angle(x) | Quantity::Plain(x) => {
            let text = decimal(x, 4);
            if text.contains('.') { text } else { format!("{text}.") }
        }
    }
}

fn begin(request: &Request<'_>, own: &Own, flavour: &'static Flavour, w: &mut Writer<'_>) {
    w.line("%");
    w.line(&number::line(request));
    w.header(&does::line(request, ": by the macro that measures it"));
    if number::chosen(request).is_none() {
        w.comment("No number was chosen: this may replace a program O1000 of the control");
    }
    w.comment("Calls Renishaw's macros P98xx: they must be installed, and the probe calibrated, its length by P9801");
    w.comment("Heights are of the stylus TIP, as P9801 sets the length: the ball centre is one radius above");
    w.comment(
        "Alarms: 86 path obstructed, 92 unexpected surface, 93 surface not found, 89 no tool length, 101 probe does not start",
    );
    if own.blocks.iter().any(|(block, _)| matches!(block, OwnBlock::Call(number, _) if BY_DIRECTIONS.contains(number))) {
        w.comment("P9821, P9822 and P9823 ask for a calibration by directions: P9804");
    }
    if request.path.moves.is_empty() {
        w.says_job();
        return w.modes();
    }
    let z = w.height_word(own.first - request.path.frame.w * request.setup.radius);
    w.comment(&format!(
        "Before the start: probe in the spindle, G43 active, the stylus above {z}: it goes there in the plane first"
    ));
    w.comment(&orientation_line(request));
    let names: Vec<String> = own
        .stored
        .iter()
        .filter_map(|(code, stored)| Some(format!("{} {}", (request.post.own?.name)(*stored), code)))
        .collect();
    if !names.is_empty() {
        w.comment(&format!("Results: {}", names.join(", ")));
    }
    w.comment("Not verified on a control: try it without a part first");
    w.says_job();
    w.modes();
    w.line("M5");
    w.line("M9");
    if let Some(angle) = request.orient {
        let word = flavour.angle.map(|word| format!("{word}{}", decimal(angle, 3)));
        w.parts(&["M19", &word.unwrap_or_default()]);
    }
    if let Some(n) = request.work_offset {
        w.line(&(request.post.work_offset_word)(n));
    }
}
