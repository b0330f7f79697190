//! SINUMERIK 840D sl and compatible controls: plain moves with MEAS, or native cycles CYCLE977 and CYCLE978.
//!
//! Plain moves. Every positioning move is `MEAS=1 G1` and is followed by a check that nothing was touched. A contact jumps to one exit that names the move,
//! lifts (except where the contact was on the way up) and stops. Only the retract from a touch runs without MEAS: the probe is deflected when it starts, and
//! the ball moves back on its own path. MEAS waits for the rising edge of the signal; no source shows its behaviour with a probe that is already deflected. So
//! after an unwatched move the program checks before the next MEAS block whether the probe is free. Results are in the first R parameters; intermediate values
//! follow. `G70` and `G71` do not affect feeds and system variables, which stay in the control's basic system (function manual G2, 7.3), so the program first
//! checks that the two agree. MEAS records the positions of the axes that its block names (a converter's specification that cites the programming manual
//! 03/2006, 5.7), so a touch names all three.
//!
//! Recalled and not verified on a control [R]: that MEAS ends a move at the contact, the states of `$AC_MEA`, `$A_PROBE`, `$AA_MW` as the ball centre in the
//! workpiece system, `$AA_IW` as the position in it, the values of `$MN_SCALING_SYSTEM_IS_METRIC`, R0 to R99 by default (MD28050), that `TRANS` switches
//! programmable frames off, components of `$P_UIFR`, `$P_PFRAME`, `$P_TOOLFRAME` and `$P_WPFRAME`, that `$P_TOOL` is the active D number, `DIAMOF`, and
//! `SETAL(65000)`.

pub mod cycles;
mod plan_calls;
mod read;

use std::borrow::Cow;
use std::ops::Range;

use crate::control::corrections::{Blocks, ToolCorrection, ToolTable};
use crate::control::inside::{self, Inside, Labels};
use crate::control::iso::codes::Family;
use crate::control::iso::print::{self, Notation};
use crate::control::iso::registers::Registers;
use crate::control::iso::writer::{
    Dialect, PLAIN, Writer, across_from_stated, lower_than, start_unknown, upwards,
};
use crate::control::moves::{self, MoveContext, Moves, StoredCoordinate, WrittenDatum, each_piece};
use crate::control::native_run::compute;
use crate::control::shop::place;
use crate::control::{
    BASE, FROM_THE_TOP, PostDef, Program, ProgramForm, Request, ResultOutput, check_plain_moves,
    check_rotary, check_watched, check_write, feed_rate, orientation_line, write_summary,
};
use crate::form::Checker;
use crate::formula::{CheckKind, Coordinate, Formula, OffsetCorrection, ResultCheck, Variable};
use crate::geom::{AXIS_NAMES, Plane, Vec3};
use crate::num::{decimal, format_count, push_count};
use crate::path::{
    CallBlock, CallSequence, FeatureKind, Feed, Move, STATED_RAPID, ShiftTerm, Touch,
};
use crate::text::text;

pub static DEF: PostDef = PostDef {
    key: "sinumerik",
    title: "SINUMERIK 840D sl / 828D",
    about: "watched moves with MEAS, each with its check and one exit that names the move; results in R parameters, the frame written at the end. The tool section of the job says on which axis the probe's length acts. Not verified on a control.",
    extension: "mpf",
    work_offsets: 99,
    work_offset_word: |n| {
        if n <= 4 {
            format!("G{}", 53 + n)
        } else {
            format!("G{}", 500 + n)
        }
    },
    first_length: true,
    family: Family::Sinumerik,
    dialect: &DIALECT,
    unused: &["number", "setUp", "toolOffsets", "edition"],
    uses_tool: |_| true,
    unused_by_cycles: &["feeds.work", "feeds.retract"],
    supports: serves,
    check,
    emit,
    read: Some(read::read),
    tools: Some(&ToolTable {
        tables: |_| Some([12, 15, 999]),
        register: |register| format!("$TC_DP{}[{},1]", register.table, register.tool),
        kept: |number| format!("R{number}"),
        keeps: (1, 98),
    }),
    own: Some(&plan_calls::CYCLES),
    // SUPA with D0 is read in public programs; 0 as the top of the axis is recalled [R].
    usual_lines: &[
        ("head", &["SUPA G0 {axis}0 D0", "T{tool}", "M6", "D1"]),
        ("foot", &["SUPA G0 {axis}0 D0"]),
    ],
    inside: Some(Inside {
        jump: Some(("GOTOF TP_END", "TP_END:")),
        declares: "DEF ",
        labels: Labels::Names,
        ..inside::PLAIN
    }),
    ..BASE
};

const DIALECT: Dialect = Dialect {
    comment: ("; ", ""),
    comment_width: 120,
    // Recalled: a block has at most 512 characters.
    longest_block: 512,
    units: ("G71", "G70"),
    modes: "G40 G60 G90",
    shifted: ("=", ""),
    ..PLAIN
};

/// R parameters beyond this number are not on every control. Recalled: MD28050 has 100 of them, R0 to R99, by default.
const LAST_REGISTER: usize = 99;

/// Registers of a program that writes, after those of its results, counted from the last of them: number of touches made; rotation of the frame before and
/// after; abscissa and ordinate, measured and nominal; and the change of each part of the frame.
const TOUCHES: usize = 1;
const TURNS: [usize; 2] = [2, 3];
const MEASURED: [usize; 2] = [4, 5];
const NOMINAL: [usize; 2] = [6, 7];
const CHANGES: [usize; 4] = [8, 9, 10, 11];

fn serves(subject: FeatureKind, form: ProgramForm) -> Result<(), &'static str> {
    match (subject, form) {
        (_, ProgramForm::Moves) => Ok(()),
        (
            FeatureKind::CornerInside
            | FeatureKind::CornerOutside
            | FeatureKind::TripleInside
            | FeatureKind::TripleOutside,
            _,
        ) => Err(
            "its corner cycle is CYCLE961, and no source we have proves the order of its arguments: a wrong one would move the probe elsewhere",
        ),
        (FeatureKind::Wall, _) => {
            Err("its cycle for the angle of a wall, CYCLE998, is read and not written")
        }
        (FeatureKind::TwoCircles, _) => Err("it has no native cycle for two circles"),
        (FeatureKind::Switch | FeatureKind::Action, _) => Err("it has no measuring cycle for it"),
        _ => Ok(()),
    }
}

fn check(request: &Request<'_>, checker: &mut Checker) {
    let unverified = text!(
        "That MEAS ends a move at the contact, and what $A_PROBE and $AA_IW hold, is recalled and not verified; $AC_MEA and $AA_MW follow the description of a converter, CYCLE977 working programs. None of it was run on a control: keep a hand on the feed override. Without a part a program ends at the first touch, but for the dry run of moves"
    );
    checker.info("not-verified", "control.post", unverified);
    if request
        .path
        .calls
        .as_ref()
        .is_some_and(|own| !own.guards.is_empty())
    {
        let message = text!(
            "A position that deviates by more than the safe range (TSA) of its call is an alarm of the cycle; which steps the alarm skips is recalled, not read"
        );
        checker.info("limit-stops", "limits.position", message);
    }
    // A measuring cycle has its own rapids.
    let own = request.path.calls.is_some();
    let rapid = |m: &Move| request.feeds.rate(m.feed).is_none() && !(own && m.feed == Feed::Rapid);
    if request.protected && request.path.moves.iter().any(rapid) {
        let message = text!(
            "A move is watched by MEAS only at a stated feed: rapids run as watched moves at {rate}/min",
            checker.length(STATED_RAPID)
        );
        checker.info("rapid-at-feed", "feeds", message);
    }
    check_watched(request, checker);
    if request.form == ProgramForm::Cycle {
        return plan_calls::check(request, checker);
    }
    check_plain_moves(request, checker);
    check_rotary(
        request,
        checker,
        text!("The program does not know the rotary axis of the machine"),
    );
    check_write(request, checker);
    let registers = request.registers();
    let last = registers.last + frame_registers(request);
    for correction in request.corrections() {
        if correction.store <= last as i32 {
            let message = text!(
                "The program uses R1 to R{last}: the mean needs two later R parameters",
                last
            );
            let formula = &request.path.formula;
            let code = formula.code(&formula.results[correction.check.result]);
            checker.error(
                "wear-unsupported",
                format!("tolerances.{code}.wear.store"),
                message,
            );
        }
    }
    if last > LAST_REGISTER {
        let message = text!(
            "The program would need R1 to R{last}; a control has R parameters up to R{limit} unless it was set up for more: take \
             fewer touches",
            last,
            LAST_REGISTER
        );
        checker.error("too-many-registers", "control.post", message);
    }
}

/// Number of registers for the write of the frame and the corrections of tools.
fn frame_registers(request: &Request<'_>) -> usize {
    if request.writes_tables() {
        CHANGES[3] + 3 * request.corrections().len()
    } else {
        0
    }
}

/// Changed parts of the frame: abscissa, ordinate, tool axis, rotation.
fn changes(datum: &OffsetCorrection) -> [bool; 4] {
    let plane = datum.place[0].is_some() && datum.place[1].is_some();
    [
        plane,
        plane,
        datum.place[2].is_some(),
        datum.rotation.is_some(),
    ]
}

/// Feed of a move: a rapid without a number runs at the stated rate.
fn rate_of(request: &Request<'_>, step: &Move) -> f64 {
    feed_rate(request, None, step).unwrap_or(STATED_RAPID)
}

fn emit(request: &Request<'_>) -> Program {
    moves::write(
        request,
        &mut Sinumerik {
            request,
            registers: request.registers(),
            unwatched: false,
            asked: 0,
        },
    )
}

/// The program of one request.
struct Sinumerik<'a> {
    request: &'a Request<'a>,
    registers: &'a Registers,
    /// Whether an unwatched move was made since the probe was last known to be free.
    unwatched: bool,
    /// Number of checked results.
    asked: usize,
}

impl Sinumerik<'_> {
    /// Register that counts the touches, if the program writes.
    fn count(&self) -> Option<usize> {
        let writes = self.request.form == ProgramForm::Moves && self.request.writes_tables();
        writes.then_some(self.registers.last + TOUCHES)
    }

    /// Waits for the operator. The count of touches is in a declared variable meanwhile, which a reset clears: a start after the wait then writes nothing.
    fn wait(&self, w: &mut Writer<'_>) {
        let count = self.count();
        if let Some(count) = count {
            w.line(&format!("TP_TOUCHES=R{count}"));
            w.line(&format!("R{count}=0"));
        }
        w.line("M0");
        if let Some(count) = count {
            // Nothing below is read before cycle start.
            w.line("STOPRE");
            w.line(&format!("R{count}=TP_TOUCHES"));
            w.line("TP_TOUCHES=0");
        }
    }

    /// Deviation of the result in this variable from its expected value, and its limit.
    fn deviation(&self, value: &str, check: &ResultCheck) -> (String, String) {
        let unit = if check.angle { 1.0 } else { self.request.scale };
        let [limit, wanted] = [check.limit, check.expected].map(|x| decimal(x / unit, 12));
        let off = match wanted.strip_prefix('-') {
            _ if wanted == "0" => value.to_owned(),
            Some(positive) => format!("{value}+{positive}"),
            None => format!("{value}-{wanted}"),
        };
        (off, limit)
    }

    /// Registers of a correction: new number and sum of the errors, and the change of the tool.
    fn correction(&self, i: usize) -> [usize; 3] {
        [1, 2, 3].map(|k| self.registers.last + CHANGES[3] + 3 * i + k)
    }

    /// Computes the change of a tool.
    #[inline(never)]
    fn compute(
        &mut self,
        w: &mut Writer<'_>,
        formula: &Formula,
        i: usize,
        correction: &ToolCorrection,
    ) {
        let value = format!("R{}", self.registers.checked(formula, &correction.check));
        let (off, _) = self.deviation(&value, &correction.check);
        let registers = self.correction(i).map(|register| format!("R{register}"));
        let scale = self.request.scale;
        w.comment(&correction.note());
        let mut blocks = Blocks {
            brackets: ('(', ')'),
            compares: ["<=", ">"],
            jump: &|condition, label| format!("IF {condition} GOTOF {label}"),
            label: &mut || {
                self.asked += 1;
                format!("TP_KEEP_{}", self.asked)
            },
            target: &|label| format!("{label}:"),
            number: &|x| decimal(x, 12),
        };
        let registers = registers.each_ref().map(String::as_str);
        for line in blocks.lines(correction, (&off, scale), registers, "TP_STORED") {
            w.line(&line);
        }
    }

    fn notation(&self) -> RParameters<'_> {
        RParameters {
            registers: self.registers,
        }
    }

    /// Computes what the native cycles so far give, and stops before cycle `m` if it follows a result that is beyond its limit.
    #[inline(never)]
    fn compute_before(&mut self, w: &mut Writer<'_>, formula: &Formula, m: usize) {
        let Some(own) = &self.request.path.calls else {
            return;
        };
        let (values, checks) = compute::before(self.request, own, m);
        for (index, register) in values {
            w.build(|text| {
                text.push('R');
                push_count(text, register);
                text.push('=');
                let node = formula.assignments[index].node;
                print::print_to(
                    text,
                    &CycleResults { own },
                    formula,
                    node,
                    self.request.scale,
                );
                text.push_str(" ; ");
                formula.push_name(index, text);
            });
        }
        for check in checks {
            let stored = own.stored_value(check.variable.index());
            let value = stored.map_or_else(String::new, plan_calls::CYCLES.name);
            self.check_value(w, formula, &check, ([&value, &value], true));
        }
    }

    /// Checks a value: beyond its limit the program shows `shown` and stops, or waits for the operator. `compared` is the same value.
    fn check_value(
        &mut self,
        w: &mut Writer<'_>,
        formula: &Formula,
        check: &ResultCheck,
        ([shown, compared], stops): ([&str; 2], bool),
    ) {
        self.asked += 1;
        let unit = if check.angle { 1.0 } else { self.request.scale };
        let (off, limit) = self.deviation(compared, check);
        let label = format!("TP_GOOD_{}", self.asked);
        w.line(&format!("IF ABS({off})<={limit} GOTOF {label}"));
        let code = formula.code(&formula.results[check.result]);
        let says = format!("{code} is \"<<{shown}<<\"{}", check.complaint(unit));
        let unwritten = match stops && self.request.writes_tables() {
            true => ". Nothing is written",
            false => "",
        };
        w.line(&format!("MSG(\"{says}{unwritten}\")"));
        if stops {
            w.line("GOTOF TP_STOP");
        } else if self.request.report == ResultOutput::Screen {
            self.wait(w);
        }
        w.line(&format!("{label}:"));
    }

    /// Checks before a MEAS block whether the probe is free, if the move before it was not watched.
    fn ask_probe(&mut self, w: &mut Writer<'_>) {
        if std::mem::take(&mut self.unwatched) {
            w.line("STOPRE");
            w.line(&format!(
                "IF $A_PROBE[{}]<>0 GOTOF TP_STUCK",
                self.request.probe_input
            ));
        }
    }
}

impl Moves for Sinumerik<'_> {
    fn own_cycles(&self) -> Vec<Range<usize>> {
        plan_calls::ranges(self.request)
    }

    fn call(&self, which: usize, w: &mut Writer<'_>) {
        let (formula, scale) = (&self.request.path.formula, self.request.scale);
        plan_calls::call(self.request, which, w, &|terms| {
            self.shift(formula, terms, scale)
        });
    }

    fn between(&mut self, w: &mut Writer<'_>, formula: &Formula, index: usize) {
        if self.request.form == ProgramForm::Cycle {
            for block in plan_calls::between(self.request, index) {
                match block {
                    CallBlock::SaveResult(register, entry) => {
                        w.line(&format!("R{register}=_OVR[{entry}]"));
                    }
                    CallBlock::Compute(m) => self.compute_before(w, formula, *m),
                    CallBlock::Call(..) | CallBlock::Cycle(..) | CallBlock::MoveTo(..) => {}
                }
            }
        }
    }

    fn begin(&mut self, w: &mut Writer<'_>) {
        if self.request.form == ProgramForm::Cycle {
            let notes = plan_calls::notes(self.request);
            let notes: Vec<&str> = notes.iter().map(String::as_str).collect();
            return begin(
                w,
                self.request,
                ": selected first, corrected by the cycle",
                &notes,
            );
        }
        let formula = &self.request.path.formula;
        let more = frame_registers(self.request);
        let lines = self.registers.lines(
            formula,
            more,
            self.request.post.dialect.comment_width - 2,
            |n| format!("R{n}"),
        );
        let notes: Vec<&str> = lines.iter().map(String::as_str).collect();
        begin(w, self.request, write_summary::ONCE, &notes);
        if let Some(count) = self.count() {
            w.line(&format!("R{count}=0"));
        }
    }

    fn rise(&mut self, w: &mut Writer<'_>) {
        if self.request.form == ProgramForm::Cycle {
            return;
        }
        if let Some((start, first)) = across_from_stated(self.request) {
            w.comment("Lower than stated the stylus goes straight up first");
            names_move(w, 0);
            rise(
                w,
                self.request,
                [lower_than(self.request, start), start],
                first,
            );
            self.unwatched = !self.request.protected;
        }
    }

    fn approach(&mut self, w: &mut Writer<'_>, first: &Move) {
        names_move(w, 0);
        approach(w, self.request, first);
        self.unwatched = !self.request.protected;
    }

    fn position(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>) {
        names_move(w, step.index);
        if self.request.protected && self.request.form == ProgramForm::Moves {
            self.ask_probe(w);
        }
        position(w, self.request, step);
        self.unwatched = !self.request.protected;
    }

    fn touch(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>, touch: &Touch) {
        names_move(w, step.index);
        self.ask_probe(w);
        // Counted before the touch: a program that is started after it counts one too few.
        if let Some(register) = self.count().map(format_count) {
            w.parts(&["R", &register, "=R", &register, "+1"]);
        }
        w.makes_move();
        // MEAS records the positions of the axes that its block names.
        let input = self.request.probe_input;
        let word = format!("MEAS={input} G1");
        w.straight_in_full(
            &word,
            step.planned.to - touch.vector * touch.search,
            self.request.feeds.work,
        );
        w.line("STOPRE");
        w.line(&format!("IF $AC_MEA[{input}]==0 GOTOF TP_MISSED"));
    }

    fn stores(&self, sample: usize, axis: usize, stored: &mut StoredCoordinate) -> bool {
        self.notation().trigger(sample, axis, &mut stored.variable);
        stored
            .source
            .push_str(["$AA_MW[X]", "$AA_MW[Y]", "$AA_MW[Z]"][axis]);
        stored.comment.push_str(" ; ");
        print::trigger_name(sample, axis).push_to(&mut stored.comment);
        (stored.group, stored.whole) = (("(", ")"), ("", ""));
        true
    }

    fn shift(&self, formula: &Formula, terms: &[ShiftTerm], scale: f64) -> String {
        match &self.request.path.calls {
            Some(own) => print::shift(&CycleResults { own }, formula, terms, scale),
            None => print::shift(&self.notation(), formula, terms, scale),
        }
    }

    fn retract(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>) {
        w.makes_move();
        w.straight(
            "G1",
            step.planned.to,
            false,
            Some(rate_of(self.request, step.planned)),
        );
        self.unwatched = true;
    }

    fn assign(&mut self, w: &mut Writer<'_>, formula: &Formula, index: usize) {
        let assignment = &formula.assignments[index];
        w.build(|text| {
            self.notation().variable(formula, index, text);
            text.push('=');
            print::print_to(
                text,
                &self.notation(),
                formula,
                assignment.node,
                self.request.scale,
            );
            text.push_str(" ; ");
            formula.push_name(index, text);
        });
    }

    fn results(&mut self, w: &mut Writer<'_>, _formula: &Formula) {
        for &(copy, variable) in &self.registers.copies {
            w.line(&format!("R{copy}=R{}", self.registers.variables[variable]));
        }
    }

    fn check_result(&mut self, w: &mut Writer<'_>, formula: &Formula, question: &ResultCheck) {
        let value = print::variable(&self.notation(), formula, question.variable);
        let compared = format!("R{}", self.registers.checked(formula, question));
        let stops = question.stops(self.request.writes_tables());
        self.check_value(w, formula, question, ([&value, &compared], stops));
    }

    fn ask(&mut self, w: &mut Writer<'_>, formula: &Formula, checks: &[ResultCheck]) {
        for check in checks {
            let value = format!("R{}", self.registers.checked(formula, check));
            let (off, limit) = self.deviation(&value, check);
            w.line(&format!("IF ABS({off})>{limit} GOTOF TP_ASK"));
        }
        if !checks.is_empty() {
            w.line("GOTOF TP_WRITE");
            w.line("TP_ASK:");
        }
        w.comment(self.request.asks_what());
        let messages = messages(results(formula));
        for (i, message) in messages.iter().enumerate() {
            let is_last = i + 1 == messages.len();
            let asks = if is_last { "<<\" - write?\"" } else { "" };
            w.line(&format!("MSG({message}{asks})"));
            self.wait(w);
        }
        if !checks.is_empty() {
            w.line("TP_WRITE:");
        }
    }

    fn write(&mut self, w: &mut Writer<'_>, formula: &Formula, datum: Option<WrittenDatum<'_>>) {
        if let Some((number, datum)) = datum {
            compute_frame(w, self.request, formula, self.registers, number, datum);
        }
        let corrections = self.request.corrections();
        for (i, correction) in corrections.iter().enumerate() {
            self.compute(w, formula, i, correction);
        }
        // A program that is started in its middle has no count and no changes, and writes nothing.
        let touches = self.registers.last + TOUCHES;
        w.line(&format!(
            "IF R{touches}<>{} GOTOF TP_INCOMPLETE",
            self.request.path.touches.len()
        ));
        w.line(&format!("R{touches}=0"));
        if let Some((number, datum)) = datum {
            write_frame(w, self.request, self.registers, number, datum);
        }
        for (i, correction) in corrections.iter().enumerate() {
            let [count, sum, change] = self.correction(i);
            let [kept, kept_sum] = &correction.kept;
            w.line(&format!("{kept}=R{count}"));
            w.line(&format!("{kept_sum}=R{sum}"));
            w.line(&format!("{0}={0}+R{change}", correction.name));
            w.line(&format!("R{change}=0"));
        }
        if let Some((number, _)) = datum {
            w.line(&(DEF.work_offset_word)(number));
        }
    }

    fn report(&mut self, w: &mut Writer<'_>, formula: &Formula) {
        if self.request.form == ProgramForm::Cycle {
            let stored = self.request.path.stored().into_iter();
            return report(
                w,
                self.request,
                stored.map(|(code, stored)| (code.into(), (plan_calls::CYCLES.name)(stored))),
            );
        }
        report(w, self.request, results(formula));
    }

    fn end(&mut self, w: &mut Writer<'_>) {
        end(w, self.request, self.count());
    }
}

/// Longest text that MSG shows, characters, values included. Recalled: 124.
const LONGEST_MESSAGE: usize = 100;

/// Approximate length of a shown value, characters.
const VALUE: usize = 12;

/// Shows every result on the screen, as many as fit into a message, and waits; or writes them to a file in the control.
fn report<'f>(
    w: &mut Writer<'_>,
    request: &Request<'_>,
    each: impl Iterator<Item = (Cow<'f, str>, String)>,
) {
    match request.report {
        ResultOutput::None => {}
        ResultOutput::Log => {
            for (code, variable) in each {
                w.line(&format!(
                    "WRITE(TP_ERROR,\"_N_TOUCHPATH_MPF\",\"; {code}=\"<<{variable})"
                ));
            }
        }
        ResultOutput::Screen if request.always_asks() => {}
        ResultOutput::Screen => {
            for message in messages(each) {
                w.line(&format!("MSG({message})"));
                w.line("M0");
            }
        }
    }
}

/// Texts for MSG with every result, as many as fit into each.
fn messages<'f>(each: impl Iterator<Item = (Cow<'f, str>, String)>) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    let mut length = LONGEST_MESSAGE;
    for (code, variable) in each {
        let own = code.len() + 2 + VALUE;
        match all.last_mut().filter(|_| length + own <= LONGEST_MESSAGE) {
            Some(message) => {
                message.push_str(&format!("<<\" {code}=\"<<{variable}"));
                length += own;
            }
            None => {
                all.push(format!("\"{code}=\"<<{variable}"));
                length = own;
            }
        }
    }
    all
}

/// Results with their registers: they have the first ones, in order.
fn results(formula: &Formula) -> impl Iterator<Item = (Cow<'_, str>, String)> {
    let shown = formula
        .results
        .iter()
        .filter(|result| result.variable.is_some())
        .enumerate();
    shown.map(|(i, result)| (formula.code(result), format!("R{}", i + 1)))
}

/// Whether a program that writes waits for the operator before the write.
fn waits(request: &Request<'_>) -> bool {
    let marks = |check: &ResultCheck| check.asked == CheckKind::MarkTolerance;
    let shows = request.report == ResultOutput::Screen && request.questions().iter().any(marks);
    request.form == ProgramForm::Moves && request.writes_tables() && (shows || request.asks())
}

/// Checks before the first move: nothing has moved if one of them fails.
fn begin(w: &mut Writer<'_>, request: &Request<'_>, written: &str, notes: &[&str]) {
    w.header(&write_summary::line(request, written));
    w.comment_approach();
    w.comment("Not verified on a control: run it with a hand on the feed override");
    let input = request.probe_input;
    w.comment(&match (request.protected, request.form) {
        (true, ProgramForm::Moves) => format!(
            "Watched moves are MEAS={input} G1 with a check; touches the same, the other way round"
        ),
        (true, ProgramForm::Cycle) => {
            format!("Watched moves are MEAS={input} G1 with a check; the cycle touches by itself")
        }
        (false, ProgramForm::Moves) => {
            format!("Touches are MEAS={input} G1 with a check. Positioning is NOT watched")
        }
        (false, ProgramForm::Cycle) => {
            "The cycle touches by itself. Positioning is NOT watched".to_owned()
        }
    });
    for note in notes {
        w.comment(note);
    }
    w.comment(&orientation_line(request));
    if request.form == ProgramForm::Moves && request.writes_tables() {
        w.comment(FROM_THE_TOP);
    }
    w.says_job();
    w.line("DEF INT TP_MOVE");
    if request.report == ResultOutput::Log {
        w.line("DEF INT TP_ERROR");
    }
    if waits(request) {
        w.line("DEF INT TP_TOUCHES");
    }
    w.shop(&place::HEAD);
    w.shop(&place::PROBE_ON);
    w.comment("Feeds and measured positions are in the basic system of the control: it must be this program's");
    w.line(&format!(
        "IF $MN_SCALING_SYSTEM_IS_METRIC=={} GOTOF TP_UNITS",
        if request.scale == 1.0 { 0 } else { 1 }
    ));
    w.line(&format!(
        "IF $A_PROBE[{}]<>0 GOTOF TP_DEFLECTED",
        request.probe_input
    ));
    w.line("IF $P_TOOL==0 GOTOF TP_TOOL");
    if let Some(tool) = request.checked_tool() {
        w.line(&format!("IF $P_TOOLNO<>{tool} GOTOF TP_PROBE"));
    }
    w.modes();
    if request.plane == Plane::G18 {
        // On a lathe X may be a diameter.
        w.line("DIAMOF");
    }
    w.line("M5 M9");
    if let Some(angle) = request.orient {
        w.line(&format!("SPOS={}", decimal(angle, 3)));
    }
    let [a, o, tool] = request.plane.axes().map(|axis| AXIS_NAMES[axis]);
    let any = |frame: &str, axes: &[&str], parts: &[(&str, u8)]| {
        let terms: Vec<String> = parts
            .iter()
            .flat_map(|(part, none)| {
                axes.iter()
                    .map(move |axis| format!("({frame}{axis},{part}]<>{none})"))
            })
            .collect();
        format!("IF {} GOTOF TP_FRAME", terms.join(" OR "))
    };
    let all = [a, o, tool];
    let Some(n) = request.work_offset else {
        w.comment("A programmed shift may be active, but no turn, mirror or scale");
        w.line(&any("$P_PFRAME[", &all, &[("RT", 0), ("MI", 0)]));
        w.line(&any("$P_PFRAME[", &all, &[("SC", 1)]));
        return;
    };
    w.line("TRANS");
    w.line(&(DEF.work_offset_word)(n));
    let offset = format!("$P_UIFR[{n},");
    if request.form == ProgramForm::Cycle {
        w.comment(
            "The cycle corrects the coarse part of the work offset: it must have no fine part",
        );
        let written = request.writes();
        return w.line(&any(
            &offset,
            &all.into_iter()
                .filter(|axis| written.contains(axis))
                .collect::<Vec<_>>(),
            &[("FI", 0)],
        ));
    }
    w.comment("The correction knows a turn about the tool axis only, and no frame behind the work offset: TOROT, CYCLE800");
    w.line(&any(&offset, &[a, o], &[("RT", 0)]));
    w.line(&any(&offset, &all, &[("MI", 0)]));
    w.line(&any(&offset, &all, &[("SC", 1)]));
    for frame in ["$P_TOOLFRAME[", "$P_WPFRAME["] {
        w.line(&any(frame, &all, &[("TR", 0), ("RT", 0)]));
    }
}

/// Stores the number of the next move for the messages of the exits.
fn names_move(w: &mut Writer<'_>, index: usize) {
    w.parts(&["TP_MOVE=", &format_count(index + 1)]);
}

/// A positioning move, straight or in short straight pieces, each watched and checked; or unwatched where it need not be.
fn position(w: &mut Writer<'_>, request: &Request<'_>, place: MoveContext<'_>) {
    if start_unknown(request, place.index, place.planned) {
        return approach(w, request, place.planned);
    }
    // Out of a bore the move is straight up first; what is left of it is across.
    let lifted = upwards(request, place.from, place.planned.to) > 0
        && plan_calls::starts_off_centre(request, place.index);
    if lifted {
        let up = w.goes_along_tool(place.planned.to);
        approach_block(w, request, place.planned, &up, "TP_BLOCKED");
    }
    w.makes_move();
    each_piece(request, place, |from, to| {
        if request.protected {
            // On the way up an exit that lifts would push against the contact.
            let exit = if !lifted && upwards(request, from, to) > 0 {
                "TP_BLOCKED"
            } else {
                "TP_CONTACT"
            };
            w.straight(
                &format!("MEAS={} G1", request.probe_input),
                to,
                false,
                Some(rate_of(request, place.planned)),
            );
            must_be_free(w, request, exit);
        } else {
            let rate = feed_rate(request, from, place.planned);
            w.straight(if rate.is_some() { "G1" } else { "G0" }, to, false, rate);
        }
    });
}

/// One block of the approach to the first position.
fn approach_block(
    w: &mut Writer<'_>,
    request: &Request<'_>,
    first: &Move,
    words: &str,
    exit: &str,
) {
    if request.protected {
        let feed = w.number(rate_of(request, first));
        w.parts(&[
            "MEAS=",
            &format_count(request.probe_input),
            " G1",
            words,
            " F",
            &feed,
        ]);
        must_be_free(w, request, exit);
    } else if let Some(rate) = feed_rate(request, None, first) {
        let feed = w.number(rate);
        w.parts(&["G1", words, " F", &feed]);
    } else {
        w.parts(&["G0", words]);
    }
}

/// Straight up to the height of a position if the stylus is `below` another one; with the word of the first move.
fn rise(w: &mut Writer<'_>, request: &Request<'_>, [below, to]: [Vec3; 2], first: &Move) {
    let height = w.height_word(below);
    let (axis, level) = height.split_at(1);
    w.line(&format!("IF $AA_IW[{axis}]>={level} GOTOF TP_ABOVE"));
    let up = w.goes_along_tool(to);
    approach_block(w, request, first, &up, "TP_BLOCKED");
    w.line("TP_ABOVE:");
}

/// Approach to the first position from any position: up to its height if the stylus is lower, in the plane, then down.
fn approach(w: &mut Writer<'_>, request: &Request<'_>, step: &Move) {
    rise(w, request, [step.to; 2], step);
    let across = w.goes_in_plane(step.to);
    approach_block(w, request, step, &across, "TP_CONTACT");
    w.makes_move();
    let down = w.goes_along_tool(step.to);
    approach_block(w, request, step, &down, "TP_CONTACT");
}

/// Check after a move without contact, and the jump target for a contact.
fn must_be_free(w: &mut Writer<'_>, request: &Request<'_>, exit: &str) {
    w.line("STOPRE");
    w.parts(&[
        "IF $AC_MEA[",
        &format_count(request.probe_input),
        "]<>0 GOTOF ",
        exit,
    ]);
}

/// Computes the write at the end: shift and rotation of the frame, so that the measured point gets its nominal position. With the rotation a of the frame (about the
/// tool axis) before and b after, a point p of the work system lies at T + R(a)·p, so the new shift is T + R(a)·measured − R(b)·nominal.
fn compute_frame(
    w: &mut Writer<'_>,
    request: &Request<'_>,
    formula: &Formula,
    registers: &Registers,
    n: i32,
    datum: &OffsetCorrection,
) {
    let notation = RParameters { registers };
    let name = |variable: Variable| print::variable(&notation, formula, variable);
    let constant = |mm: f64| decimal(mm / request.scale, 12);
    let value = |place: &Coordinate| place.measured.map_or_else(|| constant(place.nominal), name);
    let tool = AXIS_NAMES[request.plane.axes()[2]];
    w.comment("One write, at the very end: the change of the frame that brings what was measured to its nominal place");
    let register = |k: usize| registers.last + k;
    let [ca, co, ct, turns] = CHANGES.map(register);
    if let [Some(x), Some(y), _] = &datum.place {
        let [before, after] = TURNS.map(register);
        let ([mx, my], [nominal_x, nominal_y]) = (MEASURED.map(register), NOMINAL.map(register));
        w.line(&format!("R{before}={}", frame(n, tool, "RT")));
        w.line(&match datum.rotation {
            Some(turn) => format!("R{after}=R{before}+{}", name(turn)),
            None => format!("R{after}=R{before}"),
        });
        let nominal = [
            (nominal_x, constant(x.nominal)),
            (nominal_y, constant(y.nominal)),
        ];
        for (register, text) in [(mx, value(x)), (my, value(y))].into_iter().chain(nominal) {
            w.line(&format!("R{register}={text}"));
        }
        w.line(&format!(
            "R{ca}=R{mx}*COS(R{before})-R{my}*SIN(R{before})-R{nominal_x}*COS(R{after})+R{nominal_y}*SIN(R{after})"
        ));
        w.line(&format!(
            "R{co}=R{mx}*SIN(R{before})+R{my}*COS(R{before})-R{nominal_x}*SIN(R{after})-R{nominal_y}*COS(R{after})"
        ));
    }
    if let Some(z) = &datum.place[2] {
        w.line(&format!("R{ct}={}-({})", value(z), constant(z.nominal)));
    }
    if let Some(turn) = datum.rotation {
        w.line(&format!("R{turns}={}", name(turn)));
    }
}

/// Writes the changes of the frame.
fn write_frame(
    w: &mut Writer<'_>,
    request: &Request<'_>,
    registers: &Registers,
    n: i32,
    datum: &OffsetCorrection,
) {
    let [a, o, tool] = request.plane.axes().map(|axis| AXIS_NAMES[axis]);
    let [ca, co, ct, turns] = CHANGES.map(|k| registers.last + k);
    let parts = [
        (ca, a, "TR"),
        (co, o, "TR"),
        (ct, tool, "TR"),
        (turns, tool, "RT"),
    ];
    let changed = parts
        .iter()
        .zip(changes(datum))
        .filter(|(_, changes)| *changes)
        .map(|(part, _)| *part);
    for (register, axis, part) in changed {
        w.line(&format!("{0}={0}+R{register}", frame(n, axis, part)));
        w.line(&format!("R{register}=0"));
    }
}

/// Name of a part of a work offset's frame.
fn frame(number: i32, axis: &str, part: &str) -> String {
    format!("$P_UIFR[{number},{axis},{part}]")
}

/// The end, and the exits after it. Whatever went wrong, the program itself has written nothing.
/// Stops with an alarm.
fn stop(w: &mut Writer<'_>) {
    for line in ["SETAL(65000)", "M0", "M30"] {
        w.line(line);
    }
}

/// Exits of watched moves and of touches.
fn exits(w: &mut Writer<'_>, request: &Request<'_>, count: Option<usize>) {
    let tool = request.plane.axes()[2];
    // A native cycle may have written before the last lift.
    let written = match (request.form, request.work_offset) {
        (ProgramForm::Cycle, Some(_)) => "The cycle may have corrected the work offset",
        _ => "Nothing is written",
    };
    // Reasons for a jump to an exit that lifts: a watched move, or a touch.
    let touches = request.form == ProgramForm::Moves;
    let computes = request.path.calls.as_ref().is_some_and(|own| own.checks());
    if let Some(first) = request
        .path
        .moves
        .first()
        .filter(|_| request.protected || touches || computes)
    {
        let contact = match request.dry {
            Some(_) => "MSG(\"Dry run: something is in the way of move \"<<TP_MOVE)".to_owned(),
            None => {
                format!("MSG(\"Contact in move \"<<TP_MOVE<<\", which must be free. {written}\")")
            }
        };
        // As high as the path; from above that, and from a contact on the way up, nothing moves any more.
        let (axis, height) = (AXIS_NAMES[tool], w.number(request.highest()[tool]));
        if request.protected {
            w.line("TP_BLOCKED:");
            w.line(&contact);
            w.line("GOTOF TP_STOP");
            w.line("TP_CONTACT:");
            w.line(&contact);
            w.line("GOTOF TP_EXIT");
        }
        if touches {
            w.line("TP_STUCK:");
            w.line(&format!(
                "MSG(\"The probe is deflected before move \"<<TP_MOVE<<\". {written}\")"
            ));
            w.line("GOTOF TP_EXIT");
            w.line("TP_MISSED:");
            w.line(&format!(
                "MSG(\"No contact in move \"<<TP_MOVE<<\", a touch. {written}\")"
            ));
        }
        if count.is_some() {
            w.line("GOTOF TP_EXIT");
            w.line("TP_INCOMPLETE:");
            w.line("MSG(\"Not every touch was made in this run. Start the program at its beginning. Nothing is written\")");
            w.line("GOTOF TP_STOP");
        }
        let corrections = request.corrections();
        if !corrections.is_empty() {
            let kept: Vec<&str> = corrections
                .iter()
                .flat_map(|own| own.kept.iter().map(String::as_str))
                .collect();
            w.line("TP_STORED:");
            w.line(&format!(
                "MSG(\"Set {} to 0: other values are in them. Nothing is written\")",
                kept.join(", ")
            ));
            w.line("GOTOF TP_STOP");
        }
        w.line("TP_EXIT:");
        w.line(&format!("IF $AA_IW[{axis}]>={height} GOTOF TP_STOP"));
        let lift = format!("G1 {axis}{height} F{}", w.number(rate_of(request, first)));
        w.line(&lift);
        w.line("TP_STOP:");
        if let Some(count) = count {
            w.line(&format!("R{count}=0"));
        }
        w.shop(&place::ON_ALARM);
        stop(w);
    }
}

fn end(w: &mut Writer<'_>, request: &Request<'_>, count: Option<usize>) {
    w.line("M30");
    exits(w, request, count);
    // Lines of the shop before the checks may have moved.
    let unmoved = match request.shop.0.is_empty() {
        true => ". Nothing has moved",
        false => "",
    };
    let mut exit = |label: &str, message: &str| {
        w.line(&format!("{label}:"));
        w.line(&format!("MSG(\"{message}{unmoved}\")"));
        stop(w);
    };
    exit(
        "TP_UNITS",
        "The basic system of the control has other units than this program",
    );
    exit("TP_DEFLECTED", "The probe is deflected before the start");
    exit(
        "TP_TOOL",
        "No tool offset is active (D0): the length of the probe is unknown",
    );
    if let Some(tool) = request.checked_tool() {
        let message = format!("Another tool is active: the probe is tool {tool}");
        exit("TP_PROBE", &message);
    }
    let frame = match (request.work_offset, request.form) {
        (None, _) => "A programmed turn, mirror or scale is active",
        (Some(_), ProgramForm::Moves) => {
            "The work offset is turned about another axis, mirrored or scaled, or a frame is active behind it"
        }
        (Some(_), ProgramForm::Cycle) => {
            "The work offset has a fine part, which the cycle does not correct"
        }
    };
    exit("TP_FRAME", frame);
}

/// Prints expressions over these registers.
#[derive(Debug)]
struct RParameters<'a> {
    registers: &'a Registers,
}

/// Prints expressions over the results of native cycles.
#[derive(Debug)]
struct CycleResults<'a> {
    own: &'a CallSequence,
}

impl Notation for CycleResults<'_> {
    const BRACKETS: (char, char) = ('(', ')');
    const ATAN: [&'static str; 3] = ["ATAN2(", ",", ")"];

    fn variable(&self, _: &Formula, index: usize, out: &mut String) {
        let stored = self.own.stored_value(index);
        out.push_str(&stored.map_or_else(String::new, plan_calls::CYCLES.name));
    }

    fn trigger(&self, _: usize, _: usize, _: &mut String) {
        unreachable!("the cycles keep no contacts")
    }
}

impl Notation for RParameters<'_> {
    const BRACKETS: (char, char) = ('(', ')');
    const ATAN: [&'static str; 3] = ["ATAN2(", ",", ")"];

    fn variable(&self, _: &Formula, index: usize, out: &mut String) {
        out.push('R');
        push_count(out, self.registers.variables[index]);
    }

    fn trigger(&self, sample: usize, axis: usize, out: &mut String) {
        out.push('R');
        push_count(out, self.registers.trigger(sample, axis));
    }
}
