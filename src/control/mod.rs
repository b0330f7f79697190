//! Programs for controls. "Adding a control" in `CONTRIBUTING.md` lists the steps for a new one.
//!
//! A post takes a checked path and prints it; it is independent of cycles. Every move of the path is printed, one block each, and every touch continues past
//! its nominal contact by the overtravel.

pub mod corrections;
pub mod edition;
mod fanuc;
mod grbl;
pub mod header;
pub mod heidenhain;
pub mod inside;
pub mod iso;
mod linuxcnc;
mod macro_controls;
mod moves;
pub mod native;
pub mod native_run;
mod number;
mod offsets;
pub mod prove;
mod prove_calls;
mod prove_corrections;
pub mod release;
pub mod renishaw;
pub mod rules;
pub mod safety;
pub mod shop;
pub mod sinumerik;
pub mod trace;
mod write_summary;

use std::cell::OnceCell;

use crate::control::corrections::{ToolOffsets, ToolTable};
use crate::control::edition::Edition;
use crate::control::iso::codes::Family;
use crate::control::iso::registers::{ComputeTiming, Registers};
use crate::control::iso::script::{ReadError, Script};
use crate::control::iso::writer::{Dialect, PLAIN};
use crate::form::{Checker, PlacedLines, Value};
use crate::formula::{Limits, OffsetCorrection, ResultCheck, ResultDef};
use crate::geom::{AXIS_NAMES, Plane, Vec3};
use crate::num::decimal;
use crate::path::{
    CallSequence, FeatureKind, Feeds, Move, MovePurpose, Path, ProbeSettings, STATED_RAPID,
};
use crate::text::{Text, text};

/// Every control, in the order of the form.
pub const POSTS: &[&PostDef] = &[
    &linuxcnc::DEF,
    &grbl::DEF,
    &grbl::GRBLHAL,
    &grbl::FLUIDNC,
    &sinumerik::DEF,
    &heidenhain::DEF,
    &fanuc::FANUC,
    &fanuc::HAAS,
    &macro_controls::MAZAK,
    &macro_controls::BROTHER,
    &macro_controls::HURCO,
    &macro_controls::OKUMA,
];

/// Form of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProgramForm {
    /// Plain moves and touches, one block each.
    Moves,
    /// Native cycles.
    Cycle,
}

impl ProgramForm {
    pub const ALL: [ProgramForm; 2] = [ProgramForm::Moves, ProgramForm::Cycle];

    /// `control.form` in the job.
    pub const fn word(self) -> &'static str {
        match self {
            ProgramForm::Moves => "moves",
            ProgramForm::Cycle => "cycle",
        }
    }

    /// The form with this word; moves for any other word.
    pub fn named(word: &str) -> ProgramForm {
        if word == ProgramForm::Cycle.word() {
            ProgramForm::Cycle
        } else {
            ProgramForm::Moves
        }
    }

    pub const fn other(self) -> ProgramForm {
        match self {
            ProgramForm::Moves => ProgramForm::Cycle,
            ProgramForm::Cycle => ProgramForm::Moves,
        }
    }
}

/// Detail of a program's header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeaderDetail {
    /// All values of the job.
    Full,
    /// No values: only the version and the hash over the blocks.
    Short,
}

impl HeaderDetail {
    /// `control.header` in the job.
    pub const fn word(self) -> &'static str {
        match self {
            HeaderDetail::Full => "full",
            HeaderDetail::Short => "short",
        }
    }

    /// The header with this word; the full one for any other word.
    pub fn named(word: &str) -> HeaderDetail {
        if word == HeaderDetail::Short.word() {
            HeaderDetail::Short
        } else {
            HeaderDetail::Full
        }
    }
}

/// Output of the results before the program ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResultOutput {
    /// On the screen of the control.
    Screen,
    /// A file, or the control's printing interface.
    Log,
    /// None: results stay in variables.
    None,
}

impl ResultOutput {
    /// `control.report` in the job.
    pub const fn word(self) -> &'static str {
        match self {
            ResultOutput::Screen => "screen",
            ResultOutput::Log => "log",
            ResultOutput::None => "none",
        }
    }

    /// The output with this word; `Screen` for any other word.
    pub fn named(word: &str) -> ResultOutput {
        [ResultOutput::Log, ResultOutput::None]
            .into_iter()
            .find(|report| report.word() == word)
            .unwrap_or(ResultOutput::Screen)
    }
}

/// Whether a program waits for the operator before it writes a work offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ask {
    Never,
    Always,
    /// Only if a result is out of its tolerance.
    Outside,
}

impl Ask {
    /// `control.ask` in the job.
    pub const fn word(self) -> &'static str {
        match self {
            Ask::Never => "never",
            Ask::Always => "always",
            Ask::Outside => "outside",
        }
    }

    /// The choice with this word; `Never` for any other word.
    pub fn named(word: &str) -> Ask {
        [Ask::Always, Ask::Outside]
            .into_iter()
            .find(|ask| ask.word() == word)
            .unwrap_or(Ask::Never)
    }
}

/// Definition of a control.
#[derive(Clone, Copy, Debug)]
pub struct PostDef {
    /// `control.post` in the job.
    pub key: &'static str,
    pub title: &'static str,
    /// One or two sentences about its programs, for docs/controls.md.
    #[cfg_attr(
        not(test),
        allow(dead_code, reason = "the documents are generated from it")
    )]
    pub about: &'static str,
    /// The usual file extension, without the dot.
    pub extension: &'static str,
    /// Highest number of a work offset; 0 if a program cannot write one.
    pub work_offsets: i32,
    /// Whether its native cycle corrects the active preset; no work offset is chosen then.
    pub cycle_sets_preset: fn(FeatureKind) -> bool,
    /// Word of a work offset, by its number.
    pub work_offset_word: fn(i32) -> String,
    /// Whether a work offset has a rotation that its program can write.
    pub offset_has_rotation: bool,
    /// Fields of the job's sections `control` and `machine` that change nothing on it.
    pub unused: &'static [&'static str],
    /// Fields that a program of native cycles ignores, as paths of the job.
    pub unused_by_cycles: &'static [&'static str],
    /// Whether its programs of this form call the tool of the probe, or check that it is in the spindle.
    pub uses_tool: fn(ProgramForm) -> bool,
    /// Whether plane and tool decide which of the tool's lengths acts along the tool axis, so that it has to be the first.
    pub first_length: bool,
    /// Whether its program computes the results: in plain arithmetic, with circles by normal equations instead of geometric least squares.
    pub computes: bool,
    /// Time at which its program computes them.
    pub when: ComputeTiming,
    /// Smallest distance from its start at which a touch may trigger, mm, as a sum over the axes. A closer trigger counts as a probe that is still deflected.
    pub nearest_trigger: f64,
    /// Whether its program watches positioning moves with the probe, if the job asks for it.
    pub watches_positioning: bool,
    /// Whether the approach to the first position is watched as well.
    pub watches_first: bool,
    /// Shortest probing move, mm. Shorter positioning moves are plain.
    pub shortest_probe: f64,
    /// Largest relative error of a printed constant.
    pub constant_error: f64,
    /// Notation of its blocks.
    pub dialect: &'static Dialect,
    /// Family of its codes.
    pub family: Family,
    /// What its programs cannot do, and why: [`ORIENT`], [`WRITE_OFFSET`], or the name of a safety rule. [`PostDef::why_not`] reads it.
    pub unsupported_rules: &'static [(&'static str, &'static str)],
    /// Name of a program, from the name of the job.
    pub name: fn(&str) -> String,
    /// Registers of its tools, if a program of moves can correct them.
    pub tools: Option<&'static ToolTable>,
    /// Rate of a move from the current ball centre, mm/min; `None` is the rapid rate.
    pub rate: fn(&Request<'_>, Option<Vec3>, &Move) -> Option<f64>,
    /// Whether a program in a form can probe this feature, and why not: its row of the support matrix.
    pub supports: fn(FeatureKind, ProgramForm) -> Result<(), &'static str>,
    /// Reports what it cannot do for this request, and notes for the user.
    pub check: fn(&Request<'_>, &mut Checker),
    pub emit: fn(&Request<'_>) -> Program,
    /// Reads a program of moves back.
    pub read: Option<Reader>,
    /// Its native cycles, if their path is known.
    pub own: Option<&'static native_run::NativeCycles>,
    /// How its program is inserted into another one; `None` if that is not possible.
    pub inside: Option<inside::Inside>,
    /// Usual lines of the shop, offered for a new machine.
    pub usual_lines: shop::place::Usual,
    /// For controls whose programs cannot write a work offset although the user can: the block to type at the end of the program, from the measured datum
    /// (abscissa, ordinate and tool axis, mm) and the number of the work offset.
    pub manual_offset_block: Option<TypedWrite>,
}

/// Orienting the spindle to an angle.
pub const ORIENT: &str = "orient";

/// Writing a work offset.
pub const WRITE_OFFSET: &str = "write-offset";

/// Defaults of all controls. A control is one const based on it, or on that of related controls: `PostDef { key: "…", …, ..BASE }`. Entries that every control
/// must state (key, title, `about`, extension, `serves`, `emit`) are empty here; a test checks that every control states them.
pub const BASE: PostDef = PostDef {
    key: "",
    title: "",
    about: "",
    extension: "",
    work_offsets: 0,
    cycle_sets_preset: |_| false,
    work_offset_word: |_| String::new(),
    offset_has_rotation: true,
    unused: &[],
    unused_by_cycles: &["control.protection", "feeds.work", "feeds.retract"],
    uses_tool: |_| false,
    first_length: false,
    computes: true,
    when: ComputeTiming::AtTheEnd,
    nearest_trigger: 0.0,
    watches_positioning: true,
    watches_first: true,
    shortest_probe: 0.0,
    constant_error: 1e-12,
    dialect: &PLAIN,
    family: Family::Iso,
    unsupported_rules: &[],
    name: comment_text,
    tools: None,
    rate: feed_rate,
    supports: |_, _| Err(""),
    check: |_, _| {},
    emit: |_| Program {
        text: String::new(),
        move_lines: Vec::new(),
        too_long: None,
    },
    read: None,
    own: None,
    inside: Some(inside::PLAIN),
    usual_lines: &[],
    manual_offset_block: None,
};

/// See [`PostDef::manual_offset_block`].
pub type TypedWrite = fn(&Request<'_>, [Option<f64>; 3], u8) -> Option<String>;

/// Reads a program. Lists every line that is not understood.
pub type Reader = for<'t> fn(&'t str) -> Result<Script<'t>, Vec<ReadError>>;

impl PostDef {
    /// Whether a job can have the form of moves: those programs are read back.
    pub fn moves(&self) -> bool {
        self.read.is_some()
    }

    /// Why its programs cannot do something; `None` if they can.
    pub fn why_not(&self, what: &str) -> Option<&'static str> {
        let known = self
            .unsupported_rules
            .iter()
            .find(|(known, _)| *known == what);
        known.map(|(_, why)| *why)
    }

    /// A text about the control, with its name in place of `{control}`.
    pub fn control_text(&self, words: &'static str) -> Text {
        let mut text = Text::words(words);
        if words.contains("{control}") {
            text.fill(self.title.to_owned());
        }
        text
    }

    /// Decimals of lengths and feeds in a program. `scale` is mm in its unit.
    pub fn decimals(&self, scale: f64) -> usize {
        if scale == 1.0 {
            self.dialect.decimals_mm
        } else {
            self.dialect.decimals_inch
        }
    }

    /// Half of the last digit of a position or feed, in units of the program: the largest rounding error.
    pub fn half_digit(&self, scale: f64) -> f64 {
        0.5 * 10f64.powi(-(self.decimals(scale) as i32)) * (1.0 + 1e-6)
    }
}

/// A program to print.
#[derive(Debug)]
pub struct Request<'a> {
    pub post: &'static PostDef,
    /// Name of the job, safe for a comment.
    pub name: &'a str,
    /// The cycle's title.
    pub title: &'a str,
    /// Source of the cycle.
    pub source: &'a str,
    pub form: ProgramForm,
    /// Millimetres in a unit of the program.
    pub scale: f64,
    pub plane: Plane,
    /// Ball and overtravel.
    pub setup: &'a ProbeSettings,
    /// Feeds in mm/min; `None` is a rapid.
    pub feeds: &'a Feeds,
    /// Tool number of the probe, for programs that call it; `None` if the probe is in the spindle.
    pub tool: Option<i32>,
    /// Whether positioning is to be watched by the probe, if the control can.
    pub protected: bool,
    /// Height of a dry run above the path, mm. A dry run measures and writes nothing.
    pub dry: Option<f64>,
    /// Work offset to write, 1 = G54; `None` only measures.
    pub work_offset: Option<i32>,
    /// Limits of results, beyond which the program stops without writing.
    pub limits: Limits,
    /// Angle to which the spindle is oriented first, degrees; `None` does not orient it.
    pub orient: Option<f64>,
    /// The probe input of the control, from 1.
    pub probe_input: usize,
    pub report: ResultOutput,
    pub ask: Ask,
    pub tool_offsets: ToolOffsets,
    /// Edition of the macros that the program calls.
    pub edition: Edition,
    /// Number of the program on controls whose programs have one; `None` takes that of the name.
    pub number: Option<i32>,
    pub path: &'a Path,
    /// Lines of the shop.
    pub shop: &'a PlacedLines,
    /// The job with every value, for the header.
    pub job: Option<&'a Value>,
    pub header: HeaderDetail,
    /// See [`Request::registers`].
    pub numbered: OnceCell<Registers>,
}

/// Largest deviation of straight watched moves from the arc that they replace, mm. It is also at most half of the free distance before the touches.
pub const CHORD_SAG: f64 = 0.02;

impl Request<'_> {
    /// Angle to which the program orients the spindle.
    pub fn orients_spindle(&self) -> Option<f64> {
        self.orient.filter(|_| self.post.why_not(ORIENT).is_none())
    }

    /// Number of the tool that the program checks.
    pub fn checked_tool(&self) -> Option<i32> {
        self.tool
            .filter(|_| (self.post.uses_tool)(self.form) && !self.path.moves.is_empty())
    }

    /// Highest position of the path.
    pub fn highest(&self) -> Vec3 {
        let w = self.path.frame.w;
        let ends = self.path.moves.iter().map(|m| m.to).chain(self.path.start);
        ends.max_by(|a, b| a.dot(w).total_cmp(&b.dot(w)))
            .unwrap_or(Vec3::ZERO)
    }

    /// Contents of numbered variables, on controls without named ones: checking and printing use the same.
    pub fn registers(&self) -> &Registers {
        self.numbered
            .get_or_init(|| Registers::allocate(self.path, self.when()))
    }

    /// Time at which the program computes: in a set-up as soon as possible, so that no variable is kept through all cycles.
    pub fn when(&self) -> ComputeTiming {
        if self.path.cycles.is_empty() {
            self.post.when
        } else {
            ComputeTiming::AtOnce
        }
    }

    /// Checks of the results in a program that computes.
    pub fn questions(&self) -> Vec<ResultCheck> {
        if self.post.computes && self.form == ProgramForm::Moves {
            self.path.formula.result_checks(&self.limits)
        } else {
            Vec::new()
        }
    }

    /// Whether the program may wait for the operator before it writes.
    pub fn asks(&self) -> bool {
        self.ask != Ask::Never && self.form == ProgramForm::Moves && self.writes_tables()
    }

    /// Whether a program of native cycles measures and shows its results first, and writes only when it measures again.
    pub fn measures_first(&self) -> bool {
        let writes = |own: &CallSequence| {
            own.blocks.iter().any(|(block, _)| block.writes()) || !own.tools().is_empty()
        };
        self.ask != Ask::Never
            && self.form == ProgramForm::Cycle
            && self.path.calls.as_deref().is_some_and(writes)
    }

    /// Whether it always waits.
    pub fn always_asks(&self) -> bool {
        self.asks() && self.ask == Ask::Always
    }

    /// Checks of the results: it waits if one of them fails. Empty if it always waits.
    pub fn ask_checks(&self) -> Vec<ResultCheck> {
        match self.ask {
            Ask::Outside => self.path.formula.tolerance_checks().collect(),
            Ask::Never | Ask::Always => Vec::new(),
        }
    }

    /// Whether the program is read back and traced. A program of native calls is, if the cycles allow it.
    pub fn is_followed(&self) -> bool {
        let calls =
            self.form == ProgramForm::Cycle && self.post.own.is_some_and(|own| !own.followed);
        self.post.read.is_some() && !calls
    }

    /// Whether the program itself writes a work offset.
    pub fn writes_offset(&self) -> bool {
        self.work_offset.is_some()
            && self
                .path
                .formula
                .datum
                .as_ref()
                .is_some_and(OffsetCorrection::writes)
    }

    /// Size of the unit in which the program holds a result: mm, or degrees.
    pub fn unit_of(&self, result: &ResultDef) -> f64 {
        match result.role.is_angle() {
            true => 1.0,
            false => self.scale,
        }
    }

    /// Shortest move that must be watched, mm. A shorter one is not a probe move. Rounding may move both of its ends.
    pub fn shortest_watched(&self) -> f64 {
        match self.post.shortest_probe {
            0.0 => 0.0,
            shortest => shortest + 4.0 * self.post.half_digit(self.scale) * self.scale,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// The text, lines ended by a line feed.
    pub text: String,
    /// The 0-based line of each move; `None` if the control makes the move without a block.
    pub move_lines: Vec<Option<usize>>,
    /// Longest block that the control reads, if one is longer.
    pub too_long: Option<usize>,
}

/// Number of the program for this number and name of a job; `None` if the control's programs have none.
pub fn program_number(post: &PostDef, number: Option<i32>, name: &str) -> Option<i32> {
    (!post.unused.contains(&"number")).then(|| number::number(number, name))
}

/// The control with this key.
pub fn find(key: &str) -> Option<&'static PostDef> {
    POSTS.iter().copied().find(|p| p.key == key)
}

/// A user's text made safe for a comment on any control: printable ASCII without anything that could end a comment, start a block, or have a meaning for a
/// control. Everything else becomes `_`; a long text is cut.
pub fn comment_text(text: &str) -> String {
    const LONGEST: usize = 60;
    text.chars().take(LONGEST).map(comment_char).collect()
}

/// A character in a comment.
fn comment_char(c: char) -> char {
    match c {
        'A'..='Z'
        | 'a'..='z'
        | '0'..='9'
        | ' '
        | '.'
        | ','
        | '-'
        | '_'
        | '+'
        | '='
        | ':'
        | '\'' => c,
        _ => '_',
    }
}

/// Note for a control whose programs cannot ask along which axis the tool length acts.
fn check_length_axis(request: &Request<'_>, checker: &mut Checker) {
    if request.plane == Plane::G17 || request.path.moves.is_empty() {
        return;
    }
    let message = text!(
        "In {plane} the length of the probe must act along {axis}: this program does not check that it does",
        request.plane.word(),
        AXIS_NAMES[request.plane.axes()[2]]
    );
    checker.warning("tool-length-unchecked", "plane", message);
}

/// Reports what plain moves cannot do: wait for an operator who positions the probe, or judge tolerances.
fn check_plain_moves(request: &Request<'_>, checker: &mut Checker) {
    let Some(circles) = request.path.feature.two_circles() else {
        return;
    };
    if circles.semi_automatic {
        let message = text!(
            "A semi-automatic object (?) needs an operator and the native cycle, not plain moves"
        );
        checker.error("semi-automatic-unsupported", "control.post", message);
    }
    if circles.reacts && circles.toleranced {
        let message =
            text!("A program of plain moves checks no tolerances and ignores the error reaction");
        if request.work_offset.is_some() {
            let message = text!(
                "{message}, and would write the offset even from a scrap part: set the error reaction to never stop, or write no offset",
                message
            );
            checker.error("reaction-unsupported", "cycle.errorReaction", message);
        } else {
            checker.warning("reaction-unsupported", "cycle.errorReaction", message);
        }
    }
}

/// Reports a control that could watch positioning but is told not to.
fn check_watched(request: &Request<'_>, checker: &mut Checker) {
    if !request.protected && !request.path.moves.is_empty() {
        let message = text!(
            "Positioning moves are not watched because of the job's setting: a contact there goes unnoticed, and the probe breaks"
        );
        checker.warning("positioning-not-watched", "control.protection", message);
    }
}

/// Reports what plain moves cannot do with a rotary table, and why.
fn check_rotary(request: &Request<'_>, checker: &mut Checker, why: Text) {
    if request
        .path
        .feature
        .two_circles()
        .is_some_and(|circles| circles.turns_table)
    {
        let message = text!(
            "{why}: rotating or offsetting a rotary table requires the native cycle",
            why
        );
        checker.error("rotary-unsupported", "cycle.confirmRotation", message);
    }
}

/// Field that asks for the rotation to be written.
fn rotation_field(request: &Request<'_>) -> &'static str {
    if request.path.feature.two_circles().is_some() {
        "cycle.confirmRotation"
    } else {
        "control.workOffset"
    }
}

/// Reports a spindle angle that the control's program cannot set.
fn check_orientation(request: &Request<'_>, checker: &mut Checker) {
    if let (Some(_), Some(why)) = (request.orient, request.post.why_not(ORIENT)) {
        checker.warning(
            "orient-unsupported",
            "control.orient",
            request.post.control_text(why),
        );
    }
}

/// Header line about the spindle angle.
fn orientation_line(request: &Request<'_>) -> String {
    match request.orients_spindle() {
        Some(angle) => {
            format!("The spindle is turned to {} degrees first: the probe must be calibrated at that angle", decimal(angle, 3))
        }
        None => {
            "The program does not turn the spindle: it must stand at the angle at which the probe was calibrated".to_owned()
        }
    }
}

/// A reset keeps the variables. Touches of one part must not be combined with those of the next.
const FROM_THE_TOP: &str = "After RESET start at the top, NEVER in the middle: the touches made before it would still count";

/// Reports a chosen work offset that gets no value.
fn check_write(request: &Request<'_>, checker: &mut Checker) {
    let something = request
        .path
        .formula
        .datum
        .as_ref()
        .is_some_and(OffsetCorrection::writes);
    if request.work_offset.is_some() && !something {
        let message = if request.path.feature.two_circles().is_some() {
            text!(
                "A work offset is chosen, but this job measures nothing to write to it: neither a position (Q1120) nor a rotation (Q1121)"
            )
        } else {
            text!("A work offset is chosen, but this job measures nothing to write to it")
        };
        checker.warning("nothing-to-write", "control.workOffset", message);
    }
    let tool = AXIS_NAMES[request.plane.axes()[2]];
    if request.writes().contains(&tool)
        && request.setup.radius > 0.0
        && request.path.calls.is_none()
    {
        let message = text!(
            "{axis} is written for a tool length that ends at the ball centre: with a length to its tip, the work offset would be {radius} too low",
            tool.to_owned(),
            checker.length(request.setup.radius)
        );
        checker.info("length-to-centre", "control.workOffset", message);
    }
    let axes = request.path.formula.datum.as_ref().map_or(0, |datum| {
        datum.measured().iter().filter(|axis| **axis).count()
    });
    if request.work_offset.is_some() && axes > directions(request.path) {
        let message = text!(
            "Only the shift along the touches is measured: each axis of the work offset gets its share of it. A shift across the touches is not measured"
        );
        checker.warning("offset-one-direction", "control.workOffset", message);
    }
}

/// Number of independent directions in which a path touches.
fn directions(path: &Path) -> usize {
    let mut found: Vec<Vec3> = Vec::new();
    for touch in &path.touches {
        let rest = found
            .iter()
            .fold(touch.vector, |rest, known| rest - *known * rest.dot(*known));
        if rest.length() > 1e-6 {
            found.push(rest.normalize());
        }
    }
    found.len()
}

/// Feed of a move on controls whose watched moves need one, mm/min: watched moves have one, and so do the straight moves that make an arc.
fn feed_rate(request: &Request<'_>, _from: Option<Vec3>, step: &Move) -> Option<f64> {
    let stated = request.feeds.rate(step.feed);
    let needed = request.protected || step.arc.is_some() || step.purpose != MovePurpose::Position;
    stated.or(needed.then_some(STATED_RAPID))
}

/// Word of a work offset in the RS274 family: G54 … G59, G59.1 ….
fn work_offset_word(number: i32) -> String {
    match number {
        1..=6 => format!("G{}", 53 + number),
        _ => format!("G59.{}", number - 6),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_cannot_leave_its_comment() {
        assert_eq!(
            comment_text("A)\nG0 Z-100 (é;%#<x>"),
            "A__G0 Z-100 ______x_"
        );
        assert_eq!(comment_text("POCKET_80X50"), "POCKET_80X50");
        assert_eq!(comment_text(&"x".repeat(500)).len(), 60);
        assert!(
            comment_text("\u{0}\u{1b}\r\u{2028}\"\\/()[]{}~*")
                .chars()
                .all(|c| c == '_')
        );
    }

    #[test]
    fn work_offsets_by_their_words() {
        let words: Vec<String> = (1..=9).map(work_offset_word).collect();
        assert_eq!(
            words,
            [
                "G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"
            ]
        );
    }
}
