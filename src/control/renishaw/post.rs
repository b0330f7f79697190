//! Programs of calls to Renishaw's macros.
//!
//! Sources: the macros themselves (version 3.11 for Haas NGC), the post that the CAM's maker publishes and those of another, shop programs [S]. Ours, and
//! marked [I] in the docs: Q as the overtravel less the ball radius, R as the side clearance less it, heights as those of the stylus tip, the variables #101
//! and following for results that the next call overwrites.

use crate::control::edition::Edition;
use crate::control::iso::print::{self, Notation};
use crate::control::iso::writer::Writer;
use crate::control::native_run::compute;
use crate::control::shop::place;
use crate::control::{
    Program, Request, ResultOutput, check_orientation, check_plain_moves, check_rotary,
    check_write, number, offsets, orientation_line, rotation_field, write_summary,
};
use crate::form::Checker;
use crate::formula::Formula;
use crate::num::decimal;
use crate::path::{CallBlock, CallSequence, Off, Quantity, STATED_RAPID, ShiftTerm, Stored};
use crate::text::text;

/// Notation of macro calls on a control.
#[derive(Debug)]
pub(in crate::control) struct Calls {
    /// Text before the number of a macro.
    pub call: &'static str,
    /// Difference of its numbers from those of the other controls.
    pub lower: u32,
    /// Text before a letter, and between the letter and its value.
    pub letter: (&'static str, &'static str),
    /// Whether macros switch the probe; otherwise the control does.
    pub switches: bool,
    /// First and last line of a program.
    pub tape: Option<&'static str>,
    /// Code at the end of a program.
    pub end: &'static str,
    /// Code that activates the length of the probe.
    pub length: &'static str,
    /// Words after M19 and before the angle, in the block that orients the spindle; `None` if M19 orients to the one angle set in the control.
    pub angle: Option<&'static str>,
    /// Whether a source gives the numbers of its alarms.
    pub numbered_alarms: bool,
    /// Macros that no source shows on this control. That it has them follows from its other numbers.
    pub not_seen: &'static [u32],
}

/// Notation on a Fanuc and most other controls.
pub(in crate::control) const CALLS: Calls = Calls {
    call: "G65 P",
    lower: 0,
    letter: ("", ""),
    switches: true,
    tape: Some("%"),
    end: "M30",
    length: "G43",
    angle: None,
    numbered_alarms: true,
    not_seen: &[],
};

impl Calls {
    /// Name of a macro on the control's screen and in its manual: `P9814`.
    fn name(&self, number: u32) -> String {
        format!(
            "{}{}",
            self.call.chars().next_back().unwrap_or('P'),
            number - self.lower
        )
    }

    /// The call that calibrates by directions.
    fn by_directions(&self, edition: Edition) -> String {
        match edition {
            Edition::Mazak => format!("{} K4", self.name(LENGTH)),
            Edition::Unknown | Edition::Haas => self.name(CALIBRATION),
        }
    }
}

/// Variable of a result, on a control with numbered ones.
pub(in crate::control) fn variable(base: usize, stored: Stored) -> String {
    let number = match stored {
        Stored::Output(output) => base + output,
        Stored::Kept(variable) => variable,
    };
    format!("#{number}")
}

/// Numbers of the macros: protected move, probe on and off, calibration by directions, calibration of the length.
const PROTECTED: u32 = 9810;
const ON: u32 = 9832;
const OFF: u32 = 9833;
const CALIBRATION: u32 = 9804;
const LENGTH: u32 = 9801;

/// Corrects a tool by the mean of several parts.
const MEAN: u32 = 9835;

/// Macros that need a calibration by directions.
const BY_DIRECTIONS: [u32; 3] = [9821, 9822, 9823];

/// Numbers of the macros that a program calls.
fn called(own: &CallSequence) -> impl Iterator<Item = u32> {
    own.blocks.iter().filter_map(|(block, _)| match block {
        CallBlock::Call(number, _) => Some(*number),
        CallBlock::Cycle(..)
        | CallBlock::MoveTo(..)
        | CallBlock::SaveResult(..)
        | CallBlock::Compute(_) => None,
    })
}

/// Reports requirements and effects of the macros in this program.
pub(in crate::control) fn check(request: &Request<'_>, calls: &Calls, checker: &mut Checker) {
    let Some(own) = &request.path.calls else {
        return;
    };
    let message = text!(
        "The program calls Renishaw's macros, which must be installed and calibrated: they choose touches, order and feeds. Nothing of it was run on a control: keep a hand on feed hold. Without a part it ends at the first touch"
    );
    checker.info("not-verified", "control.form", message);
    if called(own).any(|number| BY_DIRECTIONS.contains(&number)) {
        let message = text!(
            "Rotated features and three touches require a calibration by directions, {macro}",
            calls.by_directions(request.edition)
        );
        checker.warning("needs-calibration", "control.form", message);
    }
    if let Some(number) = called(own).find(|number| calls.not_seen.contains(number)) {
        let message = text!(
            "No source we have shows {macro} on this control: its number and letters follow from those of its other macros. Check that it is installed",
            calls.name(number)
        );
        checker.warning("macro-not-seen", "control.form", message);
    }
    if !own.guards.is_empty() {
        let message = text!(
            "A result that is off by more than its limit stops the macro with a message before it writes: who starts the program again lets it write"
        );
        checker.info("limit-stops", "limits", message);
    }
    // Each cycle of a set-up reports it for itself.
    if request.path.cycles.is_empty() && own.blocks.iter().any(|(block, _)| block.writes()) {
        check_asked(request, own, checker);
    }
    check_edition(request, own, checker);
    check_plain_moves(request, checker);
    check_rotary(
        request,
        checker,
        text!("The program does not know the rotary axis of the machine"),
    );
    let datum = request
        .path
        .formula
        .datum
        .as_ref()
        .filter(|_| request.work_offset.is_some());
    if datum.is_some_and(|d| d.rotation.is_some()) {
        let message =
            text!("Work offsets of this control have no rotation, so it cannot be written");
        checker.error("rotation-unsupported", rotation_field(request), message);
    }
    check_write(request, checker);
    check_orientation(request, checker);
    offsets::check_optional(request, checker);
    number::check_digits(request, checker);
}

/// Asks for the edition where a call has letters that one of them refuses. On other controls than a Mazak only one edition is known.
fn check_edition(request: &Request<'_>, own: &CallSequence, checker: &mut Checker) {
    if request.edition != Edition::Unknown || request.post.key != "mazak" {
        return;
    }
    let refused = own.blocks.iter().find_map(|(block, _)| {
        // P9835 needs T and M in every edition.
        let letters = match block {
            CallBlock::Call(number, letters) if *number != MEAN => letters,
            _ => return None,
        };
        let given = |name: &str| letters.iter().any(|(letter, _)| name.starts_with(*letter));
        let mut pairs = Edition::Mazak.excludes().iter();
        pairs.find(|(one, other)| given(one) && given(other))
    });
    if let Some((one, other)) = refused {
        let message = text!(
            "Edition A-4013-0113 of Renishaw's macros stops with an alarm for {one} beside {other}: state the edition on your machine",
            (*one).to_owned(),
            (*other).to_owned()
        );
        checker.warning("edition-not-stated", "machine.edition", message);
    }
}

/// Reports limits that a program does not check before it writes.
fn check_asked(request: &Request<'_>, own: &CallSequence, checker: &mut Checker) {
    let path = request.path;
    let of_walls = own.guards.iter().any(|guard| guard.off == Off::BothWalls);
    if of_walls {
        let message = text!(
            "The corner macros stop for an angle only where both walls are off: one tilted wall, or a chip on one, is written"
        );
        checker.warning("limits-not-asked", "limits.angle", message);
    }
    let is_asked = |code: &str| own.guards.iter().any(|guard| guard.codes.contains(&code));
    // A limit of the walls also limits the angle between them.
    let questions = path
        .formula
        .result_checks(&request.limits)
        .into_iter()
        .filter(|question| !(of_walls && question.angle));
    let results = questions
        .map(|question| path.formula.results[question.result].code)
        .filter(|code| !is_asked(code));
    let results: Vec<&str> = results.collect();
    if !results.is_empty() {
        let message = text!(
            "The macros write without asking whether these are within their limits: {results}",
            results.join(", ")
        );
        checker.warning("limits-not-asked", "limits", message);
    }
}

pub(in crate::control) fn emit(request: &Request<'_>, calls: &Calls) -> Program {
    let mut w = Writer::new(request);
    let Some(own) = &request.path.calls else {
        return w.finish();
    };
    begin(request, own, calls, &mut w);
    w.shop(&place::BEFORE_FIRST_MOVE);
    let probes = !request.path.moves.is_empty();
    let mut alarms = Vec::new();
    let names = results(request);
    if request.measures_first() {
        makes_calls(&mut w, (request, own, calls), Run::Before, &mut alarms);
        w.comment(&format!(
            "Read the results now: {}. Cycle start measures again and writes. RESET writes nothing: start at the top then",
            names.join(", ")
        ));
        w.line("M0");
        let up = w
            .number(request.highest().z - request.setup.radius)
            .to_string();
        w.line(&call(
            calls,
            PROTECTED,
            &[('Z', up), ('F', rate(request, &w))],
        ));
    }
    let run = if request.measures_first() {
        Run::Again
    } else {
        Run::Once
    };
    makes_calls(&mut w, (request, own, calls), run, &mut alarms);
    if probes && calls.switches {
        w.line(&call(calls, OFF, &[]));
    }
    let shows = request.report == ResultOutput::Screen && !request.measures_first();
    if probes && shows && !names.is_empty() {
        w.comment(&format!("Read the results now: {}", names.join(", ")));
        w.line("M0");
    }
    w.shop(&place::PROBE_OFF);
    w.shop(&place::FOOT);
    w.line(calls.end);
    for (i, says) in alarms.iter().enumerate() {
        w.line(&format!("N{}", number::RESULTS.0 + i));
        w.shop(&place::ON_ALARM);
        w.line(&format!("#3000={}({says})", number::RESULTS.1 + i));
    }
    if let Some(tape) = calls.tape {
        w.line(tape);
    }
    w.finish()
}

/// What the calls of a program are for.
#[derive(Clone, Copy, PartialEq)]
enum Run {
    /// They measure, and write if the job says so.
    Once,
    /// They measure and write nothing, before the operator is asked.
    Before,
    /// They measure again and write.
    Again,
}

impl Run {
    /// Whether a call has a letter. S writes a work offset, T corrects a tool, by F and beyond V.
    fn gives(self, number: u32, letter: char) -> bool {
        self != Run::Before || number == PROTECTED || !['S', 'T', 'F', 'V'].contains(&letter)
    }

    /// Whether it makes a call. 9835 only corrects a tool.
    fn makes(self, number: u32) -> bool {
        self != Run::Before || number != MEAN
    }
}

/// The calls from the approach to the last one.
fn makes_calls(
    w: &mut Writer<'_>,
    (request, own, calls): (&Request<'_>, &CallSequence, &Calls),
    run: Run,
    alarms: &mut Vec<String>,
) {
    // The moves of the path are those of the first run.
    let path = run != Run::Again;
    if !request.path.moves.is_empty() {
        w.names_cycle(0);
        if calls.switches && run != Run::Again {
            w.line(&call(calls, ON, &[]));
            // The macro orients the spindle itself, to the angle set in the control.
            orient(request, calls, w);
        }
        approach(request, own, calls, (w, path));
    }
    let mut made = 1;
    for (index, (block, moves)) in own.blocks.iter().enumerate() {
        if *moves > 0 {
            w.names_cycle(made);
            made += moves;
        }
        match block {
            CallBlock::Call(number, letters) => {
                for _ in 0..if path { *moves } else { 0 } {
                    // A protected move belongs to the program, the rest to the macro.
                    if *number == PROTECTED {
                        w.makes_move()
                    } else {
                        w.leaves_move()
                    }
                }
                if !run.makes(*number) {
                    continue;
                }
                let words: Vec<(char, String)> = letters
                    .iter()
                    .enumerate()
                    .filter(|(_, (letter, _))| run.gives(*number, *letter))
                    .map(|(i, (letter, quantity))| {
                        let value = word(w, *quantity);
                        (*letter, shifted(request, own, value, own.shifts(index, i)))
                    })
                    .collect();
                w.line(&call(calls, *number, &words));
            }
            CallBlock::Cycle(..) | CallBlock::MoveTo(..) => {}
            CallBlock::SaveResult(kept, output) => {
                let Some(cycles) = request.post.own else {
                    continue;
                };
                let [kept, output] =
                    [Stored::Kept(*kept), Stored::Output(*output)].map(cycles.name);
                w.parts(&[&kept, "=", &output]);
            }
            CallBlock::Compute(m) => computes(w, request, own, *m, alarms),
        }
    }
}

/// Prints expressions over the variables of results and computed values.
struct Variables<'a> {
    own: &'a CallSequence,
    name: fn(Stored) -> String,
}

impl Notation for Variables<'_> {
    const BRACKETS: (char, char) = ('[', ']');
    const ATAN: [&'static str; 3] = print::ATAN_OF_TWO;

    fn variable(&self, _: &Formula, index: usize, out: &mut String) {
        out.extend(self.own.stored_value(index).map(self.name));
    }

    /// The macros keep no contacts.
    fn trigger(&self, _: usize, _: usize, _: &mut String) {}

    fn decimals(&self, x: f64) -> usize {
        number::decimals(x)
    }
}

impl<'a> Variables<'a> {
    fn of(request: &Request<'_>, own: &'a CallSequence) -> Option<Self> {
        let name = request.post.own?.name;
        Some(Variables { own, name })
    }

    fn named(&self, index: usize) -> String {
        self.own
            .stored_value(index)
            .map_or_else(String::new, self.name)
    }
}

/// Value of a word that these terms shift: `[60.+#110]`.
fn shifted(
    request: &Request<'_>,
    own: &CallSequence,
    value: String,
    terms: &[ShiftTerm],
) -> String {
    match Variables::of(request, own).filter(|_| !terms.is_empty()) {
        Some(variables) => {
            let terms = print::shift(&variables, &request.path.formula, terms, request.scale);
            format!("[{value}{terms}]")
        }
        None => value,
    }
}

/// Computes what the results so far give, and stops before cycle `m` if it follows a result that is beyond its limit.
fn computes(
    w: &mut Writer<'_>,
    request: &Request<'_>,
    own: &CallSequence,
    m: usize,
    alarms: &mut Vec<String>,
) {
    let Some(variables) = Variables::of(request, own) else {
        return;
    };
    let formula = &request.path.formula;
    let (values, checks) = compute::before(request, own, m);
    for (index, _) in values {
        let (variable, node) = (variables.named(index), formula.assignments[index].node);
        w.build(|text| {
            text.push_str(&variable);
            text.push('=');
            print::print_to(text, &variables, formula, node, request.scale);
        });
        // ATAN gives 0 to 360 or −180 to 180 degrees, by parameter 6004 bit 0: the formula needs the latter.
        if let Some(turn) = formula.full_turn(node) {
            let half = turn / 2;
            w.line(&format!(
                "IF [{variable} GT {half}] THEN {variable}={variable}-{turn}"
            ));
        }
    }
    for check in checks {
        let unit = if check.angle { 1.0 } else { request.scale };
        let variable = variables.named(check.variable.index());
        let (off, limit) = number::deviation(&variable, &check, unit);
        let label = number::RESULTS.0 + alarms.len();
        w.line(&format!("IF [ABS[{off}] GT {limit}] GOTO {label}"));
        alarms.push(check.alarm(formula, &variable, number::LONGEST_ALARM));
    }
}

/// Variables of the results: `#135 center.x`.
fn results(request: &Request<'_>) -> Vec<String> {
    let named = |(code, stored): &(String, Stored)| {
        Some(format!("{} {}", (request.post.own?.name)(*stored), code))
    };
    request.path.stored().iter().filter_map(named).collect()
}

/// A call as the control writes it.
fn call(calls: &Calls, number: u32, words: &[(char, String)]) -> String {
    let (before, between) = calls.letter;
    let words = words
        .iter()
        .map(|(letter, value)| format!(" {before}{letter}{between}{value}"));
    format!(
        "{}{}{}",
        calls.call,
        number - calls.lower,
        words.collect::<String>()
    )
}

/// Orients the spindle to the angle of the job.
fn orient(request: &Request<'_>, calls: &Calls, w: &mut Writer<'_>) {
    if let Some(angle) = request.orients_spindle() {
        let point = if request.post.dialect.points && angle.fract() == 0.0 {
            "."
        } else {
            ""
        };
        let word = calls
            .angle
            .map(|word| format!("{word}{}{point}", decimal(angle, 3)));
        w.parts(&["M19", &word.unwrap_or_default()]);
    }
}

/// Feed of the first moves.
fn rate(request: &Request<'_>, w: &Writer<'_>) -> String {
    w.number(request.feeds.approach.unwrap_or(STATED_RAPID))
        .to_string()
}

/// The position of the stylus is unknown: in the plane first, at the current height, then down. `path`: whether these are the moves of the path.
fn approach(
    request: &Request<'_>,
    own: &CallSequence,
    calls: &Calls,
    (w, path): (&mut Writer<'_>, bool),
) {
    let (first, feed) = (own.first, rate(request, w));
    let [x, y, z] =
        [first.x, first.y, first.z - request.setup.radius].map(|value| w.number(value).to_string());
    w.line(&call(
        calls,
        PROTECTED,
        &[('X', x), ('Y', y), ('F', feed.clone())],
    ));
    if path {
        w.makes_move();
    }
    w.line(&call(calls, PROTECTED, &[('Z', z), ('F', feed)]));
}

fn word(w: &Writer<'_>, quantity: Quantity) -> String {
    match quantity {
        Quantity::Length(mm) | Quantity::Feed(mm) => w.number(mm).to_string(),
        Quantity::Angle(x) | Quantity::Plain(x) => {
            let text = decimal(x, 4);
            if text.contains('.') {
                text
            } else {
                format!("{text}.")
            }
        }
    }
}

fn begin(request: &Request<'_>, own: &CallSequence, calls: &Calls, w: &mut Writer<'_>) {
    let numbered = !request.post.unused.contains(&"number");
    if let Some(tape) = calls.tape {
        w.line(tape);
    }
    if numbered {
        w.line(&number::line(request));
    }
    let how = match request.measures_first() {
        true => ": by the macro that measures it, after the results were shown",
        false => ": by the macro that measures it",
    };
    w.header(&write_summary::line(request, how));
    if numbered && number::chosen(request).is_none() {
        w.comment(number::NOT_CHOSEN);
    }
    if request.post.dialect.units == ("", "") {
        let unit = if request.scale == 1.0 { "mm" } else { "inch" };
        w.comment(&format!(
            "SET THE CONTROL TO {unit} FIRST: the program does not state its units, a place in others is far off"
        ));
    }
    let length = calls.name(LENGTH);
    w.comment(&format!(
        "Calls the macros {} of Renishaw: they must be installed, and the probe calibrated, its length by {length}",
        calls.name(PROTECTED).replace("10", "xx")
    ));
    if let Some(edition) = request.edition.name() {
        w.comment(&format!("Edition of the macros: {edition}"));
    }
    w.comment(&format!("Heights are of the stylus TIP, as {length} sets the length: the ball centre is one radius above"));
    w.comment(if calls.numbered_alarms {
        "Alarms: 86 path obstructed, 92 unexpected surface, 93 surface not found, 89 no tool length, 101 probe does not start, 106 and 107 \
         calibrate again, 80 a rotation, mirror or scale is active, 91 letters that contradict each other"
    } else {
        "Alarms: path obstructed, unexpected surface, surface not found, no tool length, probe does not start, calibrate again, a rotation, \
         mirror or scale is active"
    });
    if called(own).any(|number| BY_DIRECTIONS.contains(&number)) {
        let [one, two, three] = BY_DIRECTIONS.map(|number| calls.name(number));
        w.comment(&format!(
            "{one}, {two} and {three} ask for a calibration by directions: {}",
            calls.by_directions(request.edition)
        ));
    }
    if !calls.switches {
        w.comment("The control switches the probe by itself at the tool change");
    }
    if request.path.moves.is_empty() {
        w.says_job();
        w.shop(&place::HEAD);
        w.shop(&place::PROBE_ON);
        return w.modes();
    }
    let z = w.height_word(own.first - request.path.frame.w * request.setup.radius);
    w.comment(&format!(
        "Before the start: probe in the spindle, {} active, the stylus above {z}: it goes there in the plane first",
        calls.length
    ));
    match request.orients_spindle() {
        None if calls.switches => w.comment(&format!(
            "{} may turn the spindle by M19, as one edition of it does: the probe must be calibrated at that angle",
            calls.name(ON)
        )),
        _ => w.comment(&orientation_line(request)),
    }
    let names = results(request);
    if !names.is_empty() {
        w.comment(&format!("Results: {}", names.join(", ")));
    }
    w.comment("Not verified on a control: without a part it ends at the first touch. Keep a hand on feed hold");
    w.says_job();
    w.shop(&place::HEAD);
    w.shop(&place::PROBE_ON);
    w.modes();
    w.line("M5");
    w.line("M9");
    if !calls.switches {
        orient(request, calls, w);
    }
    if let Some(n) = request.work_offset {
        w.line(&(request.post.work_offset_word)(n));
    }
}
