//! LinuxCNC: touches as G38.2, results computed in the program, one write of the work offset at the very end.
//!
//! Sources: LinuxCNC's g-code and overview documents, its interpreter and its motion control. #5061… are the ball centre at the trigger in the current work
//! system and the program's units. A contact in a move that is not a probe move does not always stop the machine: in automatic mode versions up to 2.8 only
//! report it in jogs and MDI commands (issues 368 and 371), and from 2.9 on only an edge counts, not a probe that is already tripped. So positioning consists
//! of G38.3, which stops at any contact without an error, and of a check of #5070 after it. Retracts stay plain: the probe is tripped when they start, and the
//! ball moves back on its own path. G38 is modal, so every block has its own word.
//! M70 saves the modes that the program states and M72 restores them, so that nothing leaks into the next program. Spindle and coolant are off before M70,
//! since M72 would start them again (issue 2764).

mod read;

use std::borrow::Cow;

use crate::control::inside::{self, Inside};
use crate::control::iso::print::{self, Notation};
use crate::control::iso::writer::{
    Dialect, PLAIN, Writer, across_from_stated, lower_than, upwards,
};
use crate::control::moves::{self, MoveContext, Moves, StoredCoordinate, WrittenDatum, each_piece};
use crate::control::rules;
use crate::control::shop::place;
use crate::control::{
    BASE, PostDef, Program, ProgramForm, Request, ResultOutput, check_length_axis,
    check_orientation, check_plain_moves, check_rotary, check_watched, check_write,
    orientation_line, rotation_field, work_offset_word, write_summary,
};
use crate::form::Checker;
use crate::formula::{Formula, OffsetCorrection, ResultCheck, Variable};
use crate::geom::{AXIS_NAMES, Plane, Vec3};
use crate::num::{Digits, decimal, format_count};
use crate::path::{Move, MovePurpose, STATED_RAPID, ShiftTerm, Touch};
use crate::text::{text, words};

pub static DEF: PostDef = PostDef {
    key: "linuxcnc",
    title: "LinuxCNC",
    about: "touches as G38.2, positioning watched by G38.3 and checked, results computed in the program and printed. Every program of the tests is run by LinuxCNC's own interpreter.",
    extension: "ngc",
    work_offsets: 9,
    work_offset_word,
    shortest_probe: SHORTEST_PROBE,
    dialect: &DIALECT,
    unused: &["number", "setUp", "probeInput", "toolOffsets", "edition"],
    uses_tool: |_| true,
    unsupported_rules: &[(
        rules::MISS_LIFTS,
        words!(
            "G38.2 itself stops the program with an error at the current position: nothing after it runs"
        ),
    )],
    rate,
    supports: |_, form| match form {
        ProgramForm::Moves => Ok(()),
        ProgramForm::Cycle => Err(
            "LinuxCNC has no native probing cycles: its shipped macros choose their own points and touches",
        ),
    },
    check,
    emit,
    read: Some(read::read),
    // 0 as the top of the axis is recalled [R].
    usual_lines: &[
        ("head", &["G53 G0 {axis}0", "T{tool} M6", "G43"]),
        ("foot", &["G53 G0 {axis}0"]),
    ],
    inside: Some(Inside {
        end: "M2",
        labels: inside::Labels::OWords,
        ..inside::PLAIN
    }),
    ..BASE
};

const DIALECT: Dialect = Dialect {
    // A line may have 252 characters; more than this is hard to read.
    comment_width: 160,
    // G8: X is a radius. Under G7, the diameters of a lathe, every X would be halved.
    modes: "G8 G40 G61 G80 G90",
    exact_stop: true,
    arcs: " G91.1",
    ..PLAIN
};

/// Shortest probe move, mm. The text of RS274/NGC, from which the interpreter comes, refuses less than 0.254 mm. The current interpreter accepts shorter ones,
/// and the age of the control is unknown. Shorter positioning moves are plain.
const SHORTEST_PROBE: f64 = 0.3;

fn check(request: &Request<'_>, checker: &mut Checker) {
    check_plain_moves(request, checker);
    check_length_axis(request, checker);
    check_watched(request, checker);
    check_rotary(
        request,
        checker,
        text!("LinuxCNC has no rotary table that a program could know of"),
    );
    check_write(request, checker);
    check_short(request, checker);
    check_orientation(request, checker);
    if request.protected
        && request
            .path
            .moves
            .iter()
            .any(|m| request.feeds.rate(m.feed).is_none())
    {
        let message = text!(
            "G38.3 moves at a stated feed: rapids run as watched moves at {rate}/min",
            checker.length(STATED_RAPID)
        );
        checker.info("rapid-at-feed", "feeds", message);
    }
    let Some(datum) = request.path.formula.datum.as_ref() else {
        return;
    };
    if request.work_offset.is_some() && datum.rotation.is_some() && request.plane != Plane::G17 {
        let message = text!(
            "LinuxCNC turns a work offset about Z only: no rotation can be written in this plane"
        );
        checker.error("rotation-unsupported", rotation_field(request), message);
    }
}

/// Reports a touch that is too short for a probe move.
fn check_short(request: &Request<'_>, checker: &mut Checker) {
    let path = request.path;
    let mut ways = path
        .searches()
        .filter_map(|(k, from, step)| Some((k, from?.distance(step.to) + path.touches[k].search)));
    if let Some((k, way)) = ways.find(|(_, way)| *way < SHORTEST_PROBE) {
        let message = text!(
            "Touch {touch} searches {way} in all: older interpreters refuse a probe move below {least}. Use a larger clearance or overtravel",
            k + 1,
            checker.length(way),
            checker.length(SHORTEST_PROBE)
        );
        checker.error("probe-move-too-short", "overtravel", message);
    }
}

/// Watched moves and arcs have a stated feed: a rapid without a number gets the stated feed of rapids, an unwatched arc the feed of the touches.
fn rate(request: &Request<'_>, _from: Option<Vec3>, step: &Move) -> Option<f64> {
    let stated = request.feeds.rate(step.feed);
    match (step.purpose, request.protected, step.arc) {
        (MovePurpose::Position, true, _) => Some(stated.unwrap_or(STATED_RAPID)),
        (_, false, Some(_)) => Some(stated.unwrap_or(request.feeds.work)),
        _ => stated,
    }
}

fn emit(request: &Request<'_>) -> Program {
    moves::write(
        request,
        &mut LinuxCnc {
            request,
            labels: Labels { next: FIRST_LABEL },
        },
    )
}

/// The program of one request.
struct LinuxCnc<'a> {
    request: &'a Request<'a>,
    labels: Labels,
}

impl Moves for LinuxCnc<'_> {
    fn begin(&mut self, w: &mut Writer<'_>) {
        begin(w, self.request);
        if let Some(tool) = self.request.checked_tool() {
            let label = self.labels.take();
            // The interpreter that draws a program may have no tool.
            w.parts(&[
                "o",
                &label,
                &format!(" if [[#<_task> EQ 1] AND [#5400 NE {tool}]]"),
            ]);
            w.line(&format!(
                "(ABORT,Tool #5400 is in the spindle, the probe is tool {tool})"
            ));
            w.parts(&["o", &label, " endif"]);
        }
    }

    fn rise(&mut self, w: &mut Writer<'_>) {
        if let Some((start, first)) = across_from_stated(self.request) {
            w.comment("Lower than stated the stylus goes straight up first");
            rise(
                w,
                self.request,
                [lower_than(self.request, start), start],
                first,
                &mut self.labels,
            );
        }
    }

    fn approach(&mut self, w: &mut Writer<'_>, first: &Move) {
        approach(w, self.request, first, &mut self.labels);
    }

    fn position(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>) {
        w.makes_move();
        if self.request.protected {
            watched(w, self.request, step, &mut self.labels);
        } else {
            plain(w, self.request, step);
        }
    }

    fn touch(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>, touch: &Touch) {
        w.makes_move();
        w.touch(
            "G38.2",
            step.planned,
            touch,
            self.request.protected,
            self.request.feeds.work,
        );
    }

    fn stores(&self, sample: usize, axis: usize, stored: &mut StoredCoordinate) -> bool {
        print::Rs274.trigger(sample, axis, &mut stored.variable);
        stored.source.push_str(["#5061", "#5062", "#5063"][axis]);
        (stored.group, stored.whole) = (("[", "]"), ("[", "]"));
        true
    }

    fn shift(&self, formula: &Formula, terms: &[ShiftTerm], scale: f64) -> String {
        print::shift(&print::Rs274, formula, terms, scale)
    }

    fn retract(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>) {
        w.makes_move();
        plain(w, self.request, step);
    }

    fn assign(&mut self, w: &mut Writer<'_>, formula: &Formula, index: usize) {
        let assignment = &formula.assignments[index];
        w.build(|text| {
            text.push_str("#<");
            formula.push_name(index, text);
            text.push_str(">=[");
            print::print_to(
                text,
                &print::Rs274,
                formula,
                assignment.node,
                self.request.scale,
            );
            text.push(']');
        });
    }

    fn results(&mut self, w: &mut Writer<'_>, formula: &Formula) {
        // MSG shows a text without values, and PRINT writes to the terminal: DEBUG shows values on the operator's screen.
        let word = match self.request.report {
            ResultOutput::Screen => "(DEBUG,",
            ResultOutput::Log => "(LOG,",
            ResultOutput::None => "(PRINT,",
        };
        let log = self.request.report == ResultOutput::Log
            && formula
                .results
                .iter()
                .any(|result| result.variable.is_some());
        if log {
            let name = log_name(self.request.name);
            w.line(&format!("(LOGAPPEND,{name}.txt)"));
            w.line(&format!("(LOG,{name})"));
        }
        let shown: Vec<(Cow<'_, str>, Variable)> = formula
            .results
            .iter()
            .filter_map(|result| Some((formula.code(result), result.variable?)))
            .collect();
        let crowded = self.request.report == ResultOutput::Screen && shown.len() > MOST_MESSAGES;
        let most = if crowded {
            shown.len().div_ceil(MOST_MESSAGES)
        } else {
            1
        };
        let mut rest = shown.as_slice();
        while !rest.is_empty() {
            w.build(|text| {
                let begin = text.len();
                text.push_str(word);
                for n in 0..most.min(rest.len()) {
                    let (code, variable) = &rest[0];
                    if n > 0 && text.len() - begin + code.len() > LONGEST_MESSAGE {
                        break;
                    }
                    text.push_str(if n > 0 { " " } else { "" });
                    text.push_str(code);
                    text.push('=');
                    print::Rs274.variable(formula, variable.index(), text);
                    rest = &rest[1..];
                }
                text.push(')');
            });
        }
        if log {
            w.line("(LOGCLOSE)");
        }
    }

    fn check_result(&mut self, w: &mut Writer<'_>, formula: &Formula, question: &ResultCheck) {
        let label = self.labels.take();
        let value = print::variable(&print::Rs274, formula, question.variable);
        let (off, limit) = deviation(self.request, formula, question);
        let writes = self.request.writes_offset();
        let stops = question.stops(writes);
        // The interpreter that draws a program when it is loaded ends each probing move at its target: no result is plausible there.
        let (on_machine, end) = if stops {
            ("[#<_task> EQ 1] AND [", "]")
        } else {
            ("", "")
        };
        w.parts(&[
            "o", &label, " if [", on_machine, "ABS[", &off, "] GT ", &limit, end, "]",
        ]);
        let code = formula.code(&formula.results[question.result]);
        let unit = if question.angle {
            1.0
        } else {
            self.request.scale
        };
        let says = format!("{code} is {value}{}", question.complaint(unit));
        if stops {
            w.shop(&place::ON_ALARM);
            // As in the exit: the last lift ends first.
            w.line("M66 E0 L0");
            w.line(&format!(
                "(ABORT,{says}{})",
                if writes { ". Nothing is written" } else { "" }
            ));
        } else {
            w.line(&format!("(DEBUG,{says})"));
        }
        w.parts(&["o", &label, " endif"]);
    }

    fn ask(&mut self, w: &mut Writer<'_>, formula: &Formula, checks: &[ResultCheck]) {
        let label = self.labels.take();
        let mut sum = "";
        for check in checks {
            let (off, limit) = deviation(self.request, formula, check);
            w.line(&format!("#<tp_out>=[{sum}[ABS[{off}] GT {limit}]]"));
            sum = "#<tp_out>+";
        }
        if !checks.is_empty() {
            w.parts(&["o", &label, " if [#<tp_out> GT 0]"]);
        }
        w.line("(DEBUG,Cycle start writes the work offset. Abort leaves it unchanged)");
        w.line("M0");
        // The interpreter reads on while M0 waits: M66 lets it write only after cycle start.
        w.line("M66 E0 L0");
        if !checks.is_empty() {
            w.parts(&["o", &label, " endif"]);
        }
    }

    fn write(&mut self, w: &mut Writer<'_>, formula: &Formula, datum: Option<WrittenDatum<'_>>) {
        if let Some((number, datum)) = datum {
            write_datum(w, self.request, formula, number, datum);
        }
    }

    fn report(&mut self, _w: &mut Writer<'_>, _formula: &Formula) {}

    fn end(&mut self, w: &mut Writer<'_>) {
        w.line("M72");
        w.line("M2");
    }
}

/// Number of messages with results. AXIS shows ten, and a further one removes the first [read in axis.py]: two are left for marked results.
const MOST_MESSAGES: usize = 8;

/// Length of a message after which no result is added: a block has at most 255 characters.
const LONGEST_MESSAGE: usize = 160;

/// Name of a log file: letters, digits, - and _.
fn log_name(name: &str) -> String {
    let safe = |c: char| {
        if c.is_ascii_alphanumeric() || c == '-' {
            c
        } else {
            '_'
        }
    };
    let safe: String = name.chars().take(40).map(safe).collect();
    if safe.is_empty() {
        "PROBE".to_owned()
    } else {
        safe
    }
}

/// Deviation of a result from its expected value, and its limit.
fn deviation(request: &Request<'_>, formula: &Formula, check: &ResultCheck) -> (String, String) {
    let unit = if check.angle { 1.0 } else { request.scale };
    let value = print::variable(&print::Rs274, formula, check.variable);
    let [limit, wanted] = [check.limit, check.expected].map(|x| decimal(x / unit, 12));
    (less(&value, &wanted), limit)
}

/// A value minus a constant, as a sum.
fn less(value: &str, constant: &str) -> String {
    match constant.strip_prefix('-') {
        _ if constant == "0" => value.to_owned(),
        Some(positive) => format!("{value}+{positive}"),
        None => format!("{value}-{constant}"),
    }
}

/// The header, and the checks and modes before the first move.
fn begin(w: &mut Writer<'_>, request: &Request<'_>) {
    let formula = &request.path.formula;
    w.header(&write_summary::line(request, write_summary::ONCE));
    w.comment_approach();
    if !request.path.moves.is_empty() {
        w.comment(if request.protected {
            "Positioning is G38.3 with a check of #5070: a contact lifts and stops. The first of them also looks whether the probe is tripped"
        } else {
            "Positioning is NOT watched by this program. LinuxCNC itself does not stop at every contact"
        });
    }
    if request.scale != 1.0 && !formula.results.is_empty() {
        w.comment(
            "PRINT shows a value below .0001 inch as 0; the named parameters hold it in full",
        );
    }
    if !request.path.moves.is_empty() {
        w.comment(&orientation_line(request));
        if request.orient.is_none() {
            w.comment("M5 releases the spindle from an M19 before it: control.orient turns it in the program");
        }
    }
    w.says_job();
    w.shop(&place::HEAD);
    w.shop(&place::PROBE_ON);
    if request.protected && !request.path.moves.is_empty() {
        exit(w, request);
    }
    w.line("M5 M9");
    if let Some(angle) = request.orient.filter(|_| !request.path.moves.is_empty()) {
        // Without a motor that can orient the spindle, M19 ends in an error after this time, in seconds.
        w.line(&format!("M19 R{} Q10", decimal(angle, 3)));
    }
    w.line("M70");
    w.modes();
    if let Some(n) = request.work_offset {
        w.line(&work_offset_word(n));
    }
}

/// Numbers of the O words in the body of a program. Its subroutines use 1 to 3.
struct Labels {
    next: usize,
}

const FIRST_LABEL: usize = 4;

impl Labels {
    fn take(&mut self) -> Digits {
        self.next += 1;
        format_count(self.next - 1)
    }
}

/// Variables with the ball centre along each axis, in the current work system.
const CURRENT: [&str; 3] = ["#<_x>", "#<_y>", "#<_z>"];

/// The single exit, and the approach to the first position.
fn exit(w: &mut Writer<'_>, request: &Request<'_>) {
    let tool = request.plane.axes()[2];
    let top = request.highest();
    let lift = request
        .path
        .moves
        .iter()
        .find_map(|m| request.feeds.rate(m.feed))
        .unwrap_or(STATED_RAPID);
    let height = w.height_word(top);
    let level = height[1..].to_owned();
    w.line("o<tp_exit> sub");
    w.comment("#1 is the move, #2 is 1 where up is free");
    w.line(&format!(
        "o1 if [[#2 EQ 1] AND [{} LT {level}]]",
        CURRENT[tool]
    ));
    let lift = w.number(lift);
    w.line(&format!("G1 {height} F{lift}"));
    w.line("o1 endif");
    w.shop(&place::ON_ALARM);
    // ABORT discards moves that are read but not made yet: M66 waits until the lift has ended.
    w.line("M66 E0 L0");
    w.line(match request.dry {
        Some(_) => "(ABORT,Dry run: something is in the way of move #1)",
        None => "(ABORT,Contact in move #1, which must be free. Nothing is written)",
    });
    w.line("M2");
    w.line("o<tp_exit> endsub");
    if request.path.start.is_some() && across_from_stated(request).is_none() {
        return;
    }
    let short = w.number(SHORTEST_PROBE);
    let near: Vec<String> = (0..3)
        .map(|i| format!("[ABS[#{}-{}] LT {short}]", i + 1, CURRENT[i]))
        .collect();
    w.line("o<tp_first> sub");
    w.comment("#1 #2 #3 are the place, #4 is the feed, #5 is 1 where up is free");
    w.line(&format!("o2 if [{}]", near.join(" AND ")));
    w.line("G1 X#1 Y#2 Z#3 F#4");
    w.line("o2 else");
    w.line("G38.3 X#1 Y#2 Z#3 F#4");
    w.line("o3 if [#5070 NE 0]");
    w.line("o<tp_exit> call [1] [#5]");
    w.line("o3 endif");
    w.line("o2 endif");
    w.line("o<tp_first> endsub");
}

/// A call of the approach to a position, along some axes: the others stay. `free` is 1 if upwards is free.
fn approach_block(
    w: &mut Writer<'_>,
    request: &Request<'_>,
    step: &Move,
    to: Vec3,
    moves: &dyn Fn(usize) -> bool,
    free: u8,
) {
    let rate = w.number(rate(request, None, step).unwrap_or(STATED_RAPID));
    let target = [0, 1, 2].map(|i| {
        if moves(i) {
            format!("[{}]", w.number(to[i]))
        } else {
            format!("[{}]", CURRENT[i])
        }
    });
    w.line(&format!(
        "o<tp_first> call {} [{rate}] [{free}]",
        target.join(" ")
    ));
}

/// Straight up to the height of a position if the stylus is `below` another one; with the word of the first move.
fn rise(
    w: &mut Writer<'_>,
    request: &Request<'_>,
    [below, to]: [Vec3; 2],
    first: &Move,
    labels: &mut Labels,
) {
    let tool = request.plane.axes()[2];
    let label = labels.take();
    let height = w.height_word(below);
    w.line(&format!(
        "o{label} if [{} LT {}]",
        CURRENT[tool],
        &height[1..]
    ));
    if request.protected {
        approach_block(w, request, first, to, &|i| i == tool, 0);
    } else {
        let (word, feed) = unwatched(w, request, first);
        let up = w.goes_along_tool(to);
        w.line(&format!("{word}{up}{feed}"));
    }
    w.line(&format!("o{label} endif"));
}

/// Word and feed of an unwatched approach to the first position.
fn unwatched(w: &Writer<'_>, request: &Request<'_>, first: &Move) -> (&'static str, String) {
    match request.feeds.rate(first.feed) {
        Some(rate) => ("G1", format!(" F{}", w.number(rate))),
        None => ("G0", String::new()),
    }
}

/// Approach to the first position from any position: up to its height if the stylus is lower, in the plane, then down.
fn approach(w: &mut Writer<'_>, request: &Request<'_>, step: &Move, labels: &mut Labels) {
    let tool = request.plane.axes()[2];
    rise(w, request, [step.to; 2], step, labels);
    if request.protected {
        approach_block(w, request, step, step.to, &|i| i != tool, 1);
        w.makes_move();
        approach_block(w, request, step, step.to, &|_| true, 1);
        w.stands_at(step.to);
        return;
    }
    let (word, feed) = unwatched(w, request, step);
    let across = w.goes_in_plane(step.to);
    w.line(&format!("{word}{across}{feed}"));
    w.makes_move();
    let down = w.goes_along_tool(step.to);
    w.line(&format!("{word}{down}{feed}"));
}

/// A positioning move, straight or in short straight pieces, each watched and checked.
fn watched(w: &mut Writer<'_>, request: &Request<'_>, place: MoveContext<'_>, labels: &mut Labels) {
    let rate = rate(request, place.from, place.planned);
    each_piece(request, place, |from, to| {
        if from.is_some_and(|from| from.distance(to) < SHORTEST_PROBE) {
            w.straight("G1", to, true, rate);
            return;
        }
        w.straight("G38.3", to, true, rate);
        let label = labels.take();
        // On the way up a lift would push against the contact.
        let free = if upwards(request, from, to) <= 0 {
            "1"
        } else {
            "0"
        };
        w.parts(&["o", &label, " if [#5070 NE 0]"]);
        w.parts(&[
            "o<tp_exit> call [",
            &format_count(place.index + 1),
            "] [",
            free,
            "]",
        ]);
        w.parts(&["o", &label, " endif"]);
    });
}

/// A plain move.
fn plain(
    w: &mut Writer<'_>,
    request: &Request<'_>,
    MoveContext {
        planned: step,
        from,
        ..
    }: MoveContext<'_>,
) {
    let rate = rate(request, from, step);
    if let (Some(arc), Some(from)) = (&step.arc, from) {
        return w.arc(from, step, arc, rate);
    }
    w.straight(
        if rate.is_some() { "G1" } else { "G0" },
        step.to,
        request.protected,
        rate,
    );
}

/// The write at the end. G10 L20 makes the current position read what it would read if the measured point were at its nominal position: correct in any units
/// and under any rotation, if both axes of the plane are named. A rotation is set first (in degrees, added to the present one); it rotates the axes in which
/// the distance from the measured point to the current position is counted.
fn write_datum(
    w: &mut Writer<'_>,
    request: &Request<'_>,
    formula: &Formula,
    n: i32,
    datum: &OffsetCorrection,
) {
    let axes = request.plane.axes();
    let name = |variable: Variable| print::variable(&print::Rs274, formula, variable);
    let current = axes.map(|axis| CURRENT[axis]);
    let turned = datum.rotation.map(name);
    if let Some(turn) = &turned {
        if let [Some(x), Some(y), _] = datum.place {
            for (away, current, place) in [("away_a", current[0], x), ("away_o", current[1], y)] {
                let measured = place.measured.map_or_else(
                    || format!("[{}]", decimal(place.nominal / request.scale, 12)),
                    name,
                );
                w.line(&format!("#<{away}>=[{current}-{measured}]"));
            }
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
        let Some(place) = place else { continue };
        let nominal = constant(place.nominal);
        let value = match (place.measured, &turned, i) {
            // Not measured: it keeps its reading.
            (None, ..) => current[i].to_owned(),
            (_, Some(turn), 0) => format!("#<away_a>*COS[{turn}]+#<away_o>*SIN[{turn}]{nominal}"),
            (_, Some(turn), 1) => format!("#<away_o>*COS[{turn}]-#<away_a>*SIN[{turn}]{nominal}"),
            (Some(measured), ..) => format!("{}-{}{nominal}", current[i], name(measured)),
        };
        words[axes[i]] = format!(" {}[{value}]", AXIS_NAMES[axes[i]]);
    }
    w.line(&format!("G10 L20 P{n}{}", words.concat()));
}
