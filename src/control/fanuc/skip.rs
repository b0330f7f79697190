//! Writes the program: every probing move is a G31 that is compared with its end.

use std::borrow::Cow;

use super::flavour::Flavour;
use super::{CHANGES, FIRST, SHORTEST_PROBE, origin, rate};
use crate::control::corrections::{Blocks, ToolCorrection};
use crate::control::iso::print::{self, Notation};
use crate::control::iso::registers::Registers;
use crate::control::iso::writer::{Writer, upwards};
use crate::control::moves::{self, MoveContext, Moves, StoredCoordinate, WrittenDatum, each_piece};
use crate::control::shop::place;
use crate::control::{
    FROM_THE_TOP, Program, Request, ResultOutput, number, orientation_line, write_summary,
};
use crate::formula::{CheckKind, Coordinate, Formula, OffsetCorrection, ResultCheck};
use crate::geom::Vec3;
use crate::num::{Digits, decimal, format_count, push_count};
use crate::path::{Move, ShiftTerm, Touch};

/// In-position tolerance, mm: a move that stops closer than this to its end had no contact. Our choice.
pub(super) const IN_POSITION: f64 = 0.05;

/// Labels of the exits after the end of the program.
const FREE: &str = "9001";
const MISSED: &str = "9002";
const BLOCKED: &str = "9003";
const WRONG_START: &str = "9005";
const INCOMPLETE: &str = "9006";

/// First label of the states in which nothing moves, and the number of their first alarm.
const STATES: (usize, usize) = (9031, 11);

fn variable(n: usize) -> String {
    let mut text = String::new();
    push_variable(&mut text, n);
    text
}

fn push_variable(text: &mut String, n: usize) {
    text.push('#');
    push_count(text, FIRST + n);
}

/// Writes the program of a request in the flavour of a Fanuc or a Haas.
pub(super) fn emit(request: &Request<'_>, flavour: &'static Flavour) -> Program {
    let skip = &mut SkipWriter {
        request,
        flavour,
        registers: request.registers(),
        labels: 0,
        may_still_move: false,
        implausible: Vec::new(),
    };
    moves::write(request, skip)
}

/// The program of one request.
struct SkipWriter<'a> {
    request: &'a Request<'a>,
    flavour: &'static Flavour,
    registers: &'a Registers,
    labels: usize,
    /// Whether the control may reach the next block while the ball still moves: the move before it was not a probing move.
    may_still_move: bool,
    /// Texts of the alarms for implausible results, in the order of their labels.
    implausible: Vec<String>,
}

/// Prints expressions over these variables.
struct Variables<'a>(&'a Registers);

impl Notation for Variables<'_> {
    const BRACKETS: (char, char) = ('[', ']');
    const ATAN: [&'static str; 3] = print::ATAN_OF_TWO;

    fn variable(&self, _: &Formula, index: usize, out: &mut String) {
        push_variable(out, self.0.variables[index]);
    }

    fn trigger(&self, sample: usize, axis: usize, out: &mut String) {
        push_variable(out, self.0.trigger(sample, axis));
    }

    fn decimals(&self, x: f64) -> usize {
        number::decimals(x)
    }
}

/// Variables with the stop position of the last G31 along each axis.
const STOPPED_AT: [&str; 3] = ["#5061", "#5062", "#5063"];

impl SkipWriter<'_> {
    /// A number as a value: with its point, and in brackets if it is negative.
    fn number(w: &Writer<'_>, mm: f64) -> String {
        let text = w.number(mm);
        if text.starts_with('-') {
            format!("[{text}]")
        } else {
            text.to_string()
        }
    }

    /// Distance of the stop position from the end of a move, as a sum over the known axes.
    fn deviation_sum(w: &Writer<'_>, to: Vec3, axes: &[usize]) -> String {
        Self::off_place(w, to, axes, |axis| w.shift(axis))
    }

    /// Distance of the stop position from the start of a move.
    fn off_begin(w: &Writer<'_>, from: Vec3) -> String {
        Self::off_place(w, from, &[0, 1, 2], |axis| w.begin_shift(axis))
    }

    fn off_place<'w>(
        w: &'w Writer<'_>,
        to: Vec3,
        axes: &[usize],
        shift: impl Fn(usize) -> &'w str,
    ) -> String {
        let mut sum = String::with_capacity(80);
        for &axis in axes {
            sum.push_str(if sum.is_empty() { "ABS[" } else { "+ABS[" });
            sum.push_str(STOPPED_AT[axis]);
            if axis == 2 {
                sum.push('-');
                push_variable(&mut sum, 0);
            }
            let place = Self::number(w, to[axis]);
            if place != "0." {
                sum.push('-');
                sum.push_str(&place);
            }
            // The signs in the sum are inverted. No name and no number in it contains a sign.
            sum.extend(shift(axis).chars().map(|c| match c {
                '+' => '-',
                '-' => '+',
                other => other,
            }));
            sum.push(']');
        }
        sum
    }

    fn in_position(w: &Writer<'_>) -> Digits {
        w.number(IN_POSITION)
    }

    /// A probing move, and the block that stops the look-ahead.
    fn probe(&mut self, w: &mut Writer<'_>, words: &str, rate: f64, alarm: &str) {
        let feed = w.number(rate);
        w.parts(&["G31", words, " F", &feed, alarm]);
        self.halt(w);
    }

    /// Stops the look-ahead.
    fn halt(&mut self, w: &mut Writer<'_>) {
        w.line(self.flavour.halt);
        self.may_still_move = false;
    }

    /// A plain move.
    fn moves(&mut self, w: &mut Writer<'_>, to: Vec3, step: &Move) {
        w.straight("G1", to, true, Some(self.rate(step)));
        self.may_still_move = true;
    }

    /// A watched move and its check on the axes with known positions.
    fn watched_move(
        &mut self,
        w: &mut Writer<'_>,
        words: &str,
        to: Vec3,
        step: &Move,
        axes: &[usize],
        exit: &str,
    ) {
        let rate = self.rate(step);
        self.probe(w, words, rate, self.flavour.positioning_suffix);
        if !axes.is_empty() {
            let (off, near) = (Self::deviation_sum(w, to, axes), Self::in_position(w));
            w.parts(&["IF [", &off, " GT ", &near, "] GOTO ", exit]);
        }
    }

    /// Feed of a move, mm/min.
    fn rate(&self, step: &Move) -> f64 {
        rate(self.request, step, self.flavour.rapid).unwrap_or(self.flavour.rapid)
    }

    fn label(&mut self) -> String {
        self.labels += 1;
        self.labels.to_string()
    }

    /// Checks whether #5043 includes the tool length, at a known height: the difference must be the length or 0. Any other value means a contact on the way or
    /// a stylus elsewhere.
    fn check_tool_length(&mut self, w: &mut Writer<'_>, height: f64, exit: &str) {
        let (near, good) = (Self::in_position(w), self.label());
        let set = format!("#148=#5043-{}", Self::number(w, height));
        w.line(&set);
        w.line(&format!("IF [ABS[#148] LE {near}] GOTO {good}"));
        w.line(&format!(
            "IF [ABS[#148-{}] GT {near}] GOTO {exit}",
            variable(0)
        ));
        w.line(&format!("N{good}"));
        w.line(&format!("{}=#148", variable(0)));
    }

    /// Variable that counts the touches. If the program writes, the variables with the change of each axis of the origin follow.
    fn count(&self) -> usize {
        self.registers.last + 1
    }

    fn change(&self, i: usize) -> usize {
        self.count() + 1 + i
    }

    /// Variables of a correction: new number and sum of the errors, and the change of the tool.
    fn correction(&self, i: usize) -> [usize; 3] {
        [0, 1, 2].map(|k| self.change(CHANGES) + 3 * i + k)
    }

    /// States in which nothing moves, each with the text of its alarm.
    fn states(&self) -> impl Iterator<Item = (Cow<'static, str>, &'static str)> {
        let other_units = match self.request.scale == 1.0 {
            true => ("#4006 EQ 20", "SET THE UNITS TO MM"),
            false => ("#4006 EQ 21", "SET THE UNITS TO INCH"),
        };
        let other_tool = self.request.checked_tool().map(|tool| {
            (
                Cow::Owned(format!("{} NE {tool}", self.flavour.tool)),
                OTHER_TOOL,
            )
        });
        std::iter::once(other_units)
            .chain(self.flavour.states.iter().copied())
            .map(|(check, says)| (Cow::Borrowed(check), says))
            .chain(other_tool)
    }

    /// Texts of the alarms of these states, each once.
    fn state_alarms(&self) -> Vec<&'static str> {
        let mut alarms: Vec<&str> = self.states().map(|(_, says)| says).collect();
        alarms.dedup();
        alarms
    }

    /// Index of an alarm in `state_alarms`.
    fn alarm_of(&self, says: &str) -> usize {
        self.state_alarms()
            .iter()
            .position(|alarm| *alarm == says)
            .unwrap_or(0)
    }

    fn moving(&self) -> bool {
        !self.request.path.moves.is_empty()
    }
}

/// Alarm if another tool than the probe is in the spindle.
const OTHER_TOOL: &str = "THE PROBE IS ANOTHER TOOL";

impl Moves for SkipWriter<'_> {
    fn begin(&mut self, w: &mut Writer<'_>) {
        let request = self.request;
        let formula = &request.path.formula;
        w.line("%");
        w.line(&number::line(request));
        w.header(&write_summary::line(request, write_summary::ONCE));
        if number::chosen(request).is_none() {
            w.comment(number::NOT_CHOSEN);
        }
        self.head(w);
        let more = written_variables(request);
        for line in self.registers.lines(
            formula,
            more,
            request.post.dialect.comment_width - 2,
            variable,
        ) {
            w.comment(&line);
        }
        if self.waits() {
            w.comment("#1 holds the number of touches while the program waits");
        }
        w.says_job();
        w.shop(&place::HEAD);
        w.shop(&place::PROBE_ON);
        if self.moving() {
            w.comment(self.flavour.refuses);
            for (check, says) in self.states() {
                w.line(&format!(
                    "IF [{check}] GOTO {}",
                    STATES.0 + self.alarm_of(says)
                ));
            }
        }
        w.modes();
        w.line("M5");
        w.line("M9");
        if !self.moving() {
            return;
        }
        if let Some(angle) = request.orient {
            let point = if angle.fract() == 0.0 { "." } else { "" };
            let word = self
                .flavour
                .angle
                .map(|word| format!("{word}{}{point}", decimal(angle, 3)));
            w.parts(&["M19", &word.unwrap_or_default()]);
        }
        if let Some(n) = request.work_offset {
            w.line(&(request.post.work_offset_word)(n));
        }
        self.halt(w);
        w.line(&format!("{}={}", variable(0), self.flavour.length));
        if request.writes_tables() {
            w.line(&format!("{}=0", variable(self.count())));
        }
        if let Some(start) = request.path.start {
            self.check_tool_length(w, start.z, WRONG_START);
        }
    }

    fn approach(&mut self, w: &mut Writer<'_>, first: &Move) {
        w.line("#149=1");
        // Whether #5043 includes the length is not known yet: the stylus must be high enough in both cases, the first for a positive length, the second for a
        // negative one, as in tables with machine heights. Sums of lengths and heights are rounded, and a control reads its axes in its own steps.
        let height = Self::number(w, first.to.z - IN_POSITION);
        w.line(&format!(
            "IF [#5043-{} LT {height}] GOTO {WRONG_START}",
            variable(0)
        ));
        w.line(&format!("IF [#5043 LT {height}] GOTO {WRONG_START}"));
        // The stylus is above everything that the program knows, by an unknown distance: a contact does not lift, since a lift to a stated height could go
        // down.
        let across = w.goes_in_plane(first.to);
        self.watched_move(w, &across, first.to, first, &[0, 1], BLOCKED);
        w.makes_move();
        let down = w.goes_along_tool(first.to);
        self.watched_move(w, &down, first.to, first, &[], BLOCKED);
        self.check_tool_length(w, first.to.z, BLOCKED);
    }

    fn position(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>) {
        w.parts(&["#149=", &format_count(step.index + 1)]);
        w.makes_move();
        each_piece(self.request, step, |from, to| {
            if from.is_some_and(|from| from.distance(to) < SHORTEST_PROBE) {
                self.moves(w, to, step.planned);
                return;
            }
            let exit = if upwards(self.request, from, to) > 0 {
                BLOCKED
            } else {
                FREE
            };
            let words = w.goes_to(to, true);
            self.watched_move(w, &words, to, step.planned, &[0, 1, 2], exit);
        });
    }

    fn touch(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>, touch: &Touch) {
        w.parts(&["#149=", &format_count(step.index + 1)]);
        // Counted before the touch: a program that is started after it counts one too few.
        if self.request.writes_tables() {
            let count = variable(self.count());
            w.parts(&[&count, "=", &count, "+1"]);
        }
        w.makes_move();
        let end = step.planned.to - touch.vector * touch.search;
        let words = w.goes_to_all(end);
        self.probe(w, &words, self.request.feeds.work, self.flavour.touch);
        let near = Self::in_position(w);
        // A probe that has not settled since the previous move would take the start for the wall.
        if let Some(start) = step.from {
            w.parts(&[
                "IF [",
                &Self::off_begin(w, start),
                " LE ",
                &near,
                "] GOTO ",
                FREE,
            ]);
        }
        w.parts(&[
            "IF [",
            &Self::deviation_sum(w, end, &[0, 1, 2]),
            " LE ",
            &near,
            "] GOTO ",
            MISSED,
        ]);
    }

    fn stores(&self, sample: usize, axis: usize, stored: &mut StoredCoordinate) -> bool {
        push_variable(&mut stored.variable, self.registers.trigger(sample, axis));
        stored.source.push_str(STOPPED_AT[axis]);
        if axis == 2 {
            stored.source.push('-');
            push_variable(&mut stored.source, 0);
        }
        (stored.group, stored.whole) = (("[", "]"), ("[", "]"));
        true
    }

    fn shift(&self, formula: &Formula, terms: &[ShiftTerm], scale: f64) -> String {
        print::shift(&Variables(self.registers), formula, terms, scale)
    }

    fn retract(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>) {
        w.makes_move();
        self.moves(w, step.planned.to, step.planned);
    }

    fn assign(&mut self, w: &mut Writer<'_>, formula: &Formula, index: usize) {
        w.build(|text| {
            push_variable(text, self.registers.variables[index]);
            text.push('=');
            print::print_to(
                text,
                &Variables(self.registers),
                formula,
                formula.assignments[index].node,
                self.request.scale,
            );
        });
        // ATAN gives 0 to 360 or −180 to 180 degrees, by parameter 6004 bit 0: the formula needs the latter.
        if let Some(turn) = formula.full_turn(formula.assignments[index].node) {
            let angle = variable(self.registers.variables[index]);
            w.line(&format!(
                "IF [{angle} GT {}] THEN {angle}={angle}-{turn}",
                turn / 2
            ));
        }
    }

    fn results(&mut self, w: &mut Writer<'_>, _formula: &Formula) {
        if self.request.writes_tables() {
            self.halt(w);
        }
        for &(copy, index) in &self.registers.copies {
            w.line(&format!(
                "{}={}",
                variable(copy),
                variable(self.registers.variables[index])
            ));
        }
    }

    fn check_result(&mut self, w: &mut Writer<'_>, formula: &Formula, question: &ResultCheck) {
        let register = self.registers.variables[question.variable.index()];
        let (off, limit) = self.deviation(formula, question);
        let alarm = question.alarm(formula, &variable(register), number::LONGEST_ALARM);
        if question.stops(self.request.writes_tables()) {
            // An alarm would stop the ball on its way.
            if self.may_still_move {
                self.halt(w);
            }
            let label = number::RESULTS.0 + self.implausible.len();
            w.line(&format!("IF [ABS[{off}] GT {limit}] GOTO {label}"));
            self.implausible.push(alarm);
        } else {
            // A message and a wait, not an alarm.
            let good = self.label();
            w.line(&format!("IF [ABS[{off}] LE {limit}] GOTO {good}"));
            self.wait(w, &format!("#3006={}({alarm})", number::RESULTS.1));
            w.line(&format!("N{good}"));
        }
    }

    fn ask(&mut self, w: &mut Writer<'_>, formula: &Formula, checks: &[ResultCheck]) {
        let [shows, goes_on] = [self.label(), self.label()];
        for check in checks {
            let (off, limit) = self.deviation(formula, check);
            w.line(&format!("IF [ABS[{off}] GT {limit}] GOTO {shows}"));
        }
        if !checks.is_empty() {
            w.line(&format!("GOTO {goes_on}"));
            w.line(&format!("N{shows}"));
        }
        w.comment(&format!(
            "Read the results now: {}",
            self.result_names(formula)
        ));
        w.comment(self.request.asks_what());
        self.wait(w, "M0");
        if !checks.is_empty() {
            w.line(&format!("N{goes_on}"));
        }
    }

    /// Shifts the origin by measured minus nominal: a work offset has no rotation. Tools are corrected behind the same check.
    fn write(&mut self, w: &mut Writer<'_>, formula: &Formula, datum: Option<WrittenDatum<'_>>) {
        let changed = datum.map_or_else(Vec::new, |(_, datum)| self.changes(w, formula, datum));
        let corrections = self.request.corrections();
        let incomplete = number::RESULTS.0 + self.implausible.len();
        for (i, correction) in corrections.iter().enumerate() {
            self.compute(w, formula, (i, correction), incomplete + i);
        }
        // A program that is started in its middle has no count and no changes, and writes nothing.
        let count = variable(self.count());
        w.line(&format!(
            "IF [{count} NE {}] GOTO {INCOMPLETE}",
            self.request.path.touches.len()
        ));
        w.line(&format!("{count}=0"));
        if let Some((number, _)) = datum {
            for (axis, change) in &changed {
                let origin = format!("#{}", origin(number, self.flavour.more_origins) + axis);
                w.line(&format!("{origin}={origin}+{change}"));
                w.line(&format!("{change}=0"));
            }
        }
        for (i, correction) in corrections.iter().enumerate() {
            let [count, sum, change] = self.correction(i).map(variable);
            let [kept, kept_sum] = &correction.kept;
            w.line(&format!("{kept}={count}"));
            w.line(&format!("{kept_sum}={sum}"));
            w.line(&format!("{0}={0}+{change}", correction.name));
            w.line(&format!("{change}=0"));
        }
        if let Some((number, _)) = datum {
            w.line(&(self.request.post.work_offset_word)(number));
        }
    }

    fn report(&mut self, w: &mut Writer<'_>, formula: &Formula) {
        if let Some((turn, about)) = formula.turn {
            let [x, y] = about.map(|mm| w.number(mm));
            let turn = variable(self.registers.variables[turn.index()]);
            w.comment("A work offset has no rotation. What turns the system by the one measured:");
            w.comment(&format!("G68 X{x} Y{y} R{turn}"));
        }
        let mut results = shown(formula).peekable();
        if results.peek().is_none() {
            return;
        }
        match self.request.report {
            ResultOutput::None => {}
            ResultOutput::Screen if self.request.always_asks() => {}
            ResultOutput::Screen => {
                let forgets = if self.flavour.forgets {
                    ". M30 may clear them"
                } else {
                    ""
                };
                w.comment(&format!(
                    "Read the results now: {}{forgets}",
                    self.result_names(formula)
                ));
                w.line("M0");
            }
            ResultOutput::Log => {
                let digits = if self.request.scale == 1.0 {
                    "53"
                } else {
                    "44"
                };
                w.line("POPEN");
                for (variable, code) in results {
                    let name = code.to_ascii_uppercase().replace('.', "*");
                    w.parts(&["DPRNT[", &name, "*", &variable, "[", digits, "]]"]);
                }
                w.line("PCLOS");
            }
        }
    }

    fn end(&mut self, w: &mut Writer<'_>) {
        if let Some(end) = self.flavour.free_again.filter(|_| self.moving()) {
            w.line(end);
        }
        w.line("M30");
        if let Some(first) = self.request.path.moves.first() {
            self.exits(w, first);
        }
        w.line("%");
    }
}

/// Number of variables for the writes of a program, after those of its results: the count of touches, changes of the origin, corrections of tools.
pub(super) fn written_variables(request: &Request<'_>) -> usize {
    match request.writes_tables() {
        true => 1 + CHANGES + 3 * request.corrections().len(),
        false => 0,
    }
}

/// Variables of the results, with their codes.
fn shown(formula: &Formula) -> impl Iterator<Item = (String, Cow<'_, str>)> {
    let results = formula
        .results
        .iter()
        .filter(|result| result.variable.is_some())
        .enumerate();
    results.map(|(i, result)| (variable(i + 1), formula.code(result)))
}

impl SkipWriter<'_> {
    /// `#101=center.x, #102=center.y`
    fn result_names(&self, formula: &Formula) -> String {
        let names: Vec<String> = shown(formula)
            .map(|(variable, code)| format!("{variable}={code}"))
            .collect();
        names.join(", ")
    }

    /// Deviation of a result from its expected value, and its limit.
    fn deviation(&self, formula: &Formula, check: &ResultCheck) -> (String, String) {
        let unit = if check.angle { 1.0 } else { self.request.scale };
        let register = self.registers.checked(formula, check);
        number::deviation(&variable(register), check, unit)
    }

    /// Computes the changes of the origin. Returns each axis with its variable.
    fn changes(
        &self,
        w: &mut Writer<'_>,
        formula: &Formula,
        datum: &OffsetCorrection,
    ) -> Vec<(usize, String)> {
        w.comment("One write, at the very end: the origin moves by what was measured less what is nominal");
        let axes = self.request.plane.axes();
        let mut changed = Vec::new();
        for (i, place) in datum.place.iter().enumerate() {
            let Some(Coordinate {
                measured: Some(measured),
                nominal,
            }) = *place
            else {
                continue;
            };
            let value = print::variable(&Variables(self.registers), formula, measured);
            let nominal = nominal / self.request.scale;
            let nominal = match decimal(nominal, number::decimals(nominal)).as_str() {
                "0" => String::new(),
                text if text.starts_with('-') => format!("-[{text}]"),
                text => format!("-{text}"),
            };
            let change = variable(self.change(i));
            w.line(&format!("{change}={value}{nominal}"));
            changed.push((axes[i], change));
        }
        changed
    }

    /// Computes the change of a tool.
    #[inline(never)]
    fn compute(
        &mut self,
        w: &mut Writer<'_>,
        formula: &Formula,
        (i, correction): (usize, &ToolCorrection),
        other: usize,
    ) {
        let (off, _) = self.deviation(formula, &correction.check);
        let variables = self.correction(i).map(variable);
        let scale = self.request.scale;
        let [count, sum] = &correction.kept;
        self.implausible.push(format!("RESET {count} AND {sum}"));
        w.comment(&correction.note());
        let mut blocks = Blocks {
            brackets: ('[', ']'),
            compares: [" LE ", " GT "],
            jump: &|condition, label| format!("IF [{condition}] GOTO {label}"),
            label: &mut || self.label(),
            target: &|label| format!("N{label}"),
            number: &|x| decimal(x, number::decimals(x)),
        };
        let variables = variables.each_ref().map(String::as_str);
        for line in blocks.lines(correction, (&off, scale), variables, &other.to_string()) {
            w.line(&line);
        }
    }

    /// Whether a program that writes waits for the operator before the write.
    fn waits(&self) -> bool {
        let marks = |check: &ResultCheck| check.asked == CheckKind::MarkTolerance;
        let request = self.request;
        request.writes_tables() && (request.asks() || request.questions().iter().any(marks))
    }

    /// Waits for the operator. The count of touches is in a local variable meanwhile, which a reset clears: a start after the wait then writes nothing.
    fn wait(&self, w: &mut Writer<'_>, block: &str) {
        let count = variable(self.count());
        let writes = self.request.writes_tables();
        if writes {
            w.line(&format!("#1={count}"));
            w.line(&format!("{count}=0"));
        }
        w.line(block);
        if writes {
            // Nothing below is read before cycle start.
            w.line(self.flavour.halt);
            w.line(&format!("{count}=#1"));
            w.line("#1=0");
        }
    }

    /// Notes for the operator before the run.
    fn head(&self, w: &mut Writer<'_>) {
        let request = self.request;
        if let (Some(first), None) = (request.path.moves.first(), request.path.start) {
            let (height, place) = (w.height_word(first.to), w.place_words(first.to));
            w.comment(&format!(
                "The stylus must stand at {height} or higher, else nothing moves. It goes in the plane, then down to {place}: that way must be free"
            ));
        }
        w.comment(
            match request.dry {
                Some(_) => "Not verified on a control: feed hold at hand. G31 may ignore the feed override",
                None => "Not verified on a control: make the dry run of the job first, feed hold at hand. G31 may ignore the feed override",
            },
        );
        if self.moving() {
            w.comment(
                "Watched moves are G31 with a check that they come to their end; touches the same, the other way round. #149 is the move",
            );
        }
        if self.moving() {
            w.comment(&match self.request.orient {
                Some(_) if self.flavour.angle.is_none() => {
                    "M19 turns the spindle to the angle that is set in the control: the probe must be calibrated at that one"
                        .to_owned()
                }
                _ => orientation_line(request),
            });
            w.comment("Run it from memory: GOTO does not work in DNC operation. No shift by G52 or G92 may be active");
            if self.request.writes_tables() {
                w.comment(FROM_THE_TOP);
            }
        }
    }

    /// The exits after the end of the program: a contact with a retract, one without, a missed touch, and a state in which nothing may move.
    fn exits(&self, w: &mut Writer<'_>, first: &Move) {
        let top = self.request.highest().z;
        let height = Self::number(w, top);
        let lift = format!("G1 Z{} F{}", w.number(top), w.number(self.rate(first)));
        // Earlier touches no longer count.
        let forget = self
            .request
            .writes_offset()
            .then(|| format!("{}=0", variable(self.count())));
        let mut exit =
            |label: &str, lifts: Option<&str>, forget: Option<&String>, moved, alarm: &str| {
                w.line(&format!("N{label}"));
                if let Some(stop) = lifts {
                    w.line(&format!(
                        "IF [#5043-{} GE {height}] GOTO {stop}",
                        variable(0)
                    ));
                    w.line(&lift);
                    w.line(self.flavour.halt);
                    w.line(&format!("N{stop}"));
                }
                forget.into_iter().for_each(|forget| w.line(forget));
                if moved {
                    w.shop(&place::ON_ALARM);
                }
                w.line(&format!("#3000={alarm}"));
            };
        let contact = if self.request.dry.is_some() {
            "1(DRY RUN: IN THE WAY, #149)"
        } else {
            "1(CONTACT IN MOVE #149)"
        };
        exit(FREE, Some("9011"), forget.as_ref(), true, contact);
        exit(BLOCKED, None, forget.as_ref(), true, contact);
        exit(
            MISSED,
            Some("9012"),
            forget.as_ref(),
            true,
            "2(NO CONTACT IN TOUCH #149)",
        );
        let start = if self.request.path.start.is_some() {
            "4(STYLUS NOT AT STATED START)"
        } else {
            "4(STYLUS TOO LOW TO START)"
        };
        exit(WRONG_START, None, None, false, start);
        if self.request.writes_tables() {
            exit(
                INCOMPLETE,
                None,
                forget.as_ref(),
                true,
                "5(TOUCHES MISSING, RESTART)",
            );
        }
        for (i, says) in self.state_alarms().iter().enumerate() {
            exit(
                &(STATES.0 + i).to_string(),
                None,
                None,
                false,
                &format!("{}({says})", STATES.1 + i),
            );
        }
        for (i, says) in self.implausible.iter().enumerate() {
            exit(
                &(number::RESULTS.0 + i).to_string(),
                None,
                forget.as_ref(),
                true,
                &format!("{}({says})", number::RESULTS.1 + i),
            );
        }
    }
}
