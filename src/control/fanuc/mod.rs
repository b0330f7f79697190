//! Fanuc 30i and its kin, and Haas NGC: plain moves with the skip function G31.
//!
//! Sources, as far as anything of this has one: posts for G31 inspection on Mazak, Fanuc and Haas, and what the Renishaw macros do. G31 moves
//! until the skip signal, or to its end; #5061… hold the ball centre at the skip, or the end where there was none. So every probing move is
//! followed by a comparison of the two: a touch must have ended before its end, a positioning move must not. On a Haas M78 and M79 in the
//! block of G31 raise the alarm in the control itself; the comparison follows, too.
//! #5043 and #5063 have the length of the tool in them, but for Fanucs with parameter 6014 bit 4 set: so the program takes the length from the
//! tool table, and the first move whose end it knows in Z shows which of the two it is. A macro statement is evaluated while the motion
//! before it still runs: a block stands between the two.
//!
//! Ours, and marked [I] in the docs: that comparison with 0.05 mm, the lift before the alarm, the check of the length. Recalled and not
//! verified on a control, [R]: the modal values #4006, #4011 and #4016 for units, scaling and rotation, #5221… as the origin that a program may write.

mod read;

use crate::control::iso::print::{self, Notation};
use crate::control::iso::registers::Registers;
use crate::control::iso::writer::{Dialect, Writer, highest, upwards};
use crate::control::moves::{self, Kept, Moves, Step, each_piece};
use crate::control::{
    Form, PostDef, Program, Request, check_plain_moves, check_rotary, check_write, feed_rate, offset_line, safety, written,
};
use crate::form::Checker;
use crate::formula::{Coordinate, Datum, Formula, Node, NodeId, Op};
use crate::geom::{Plane, Vec3};
use crate::num::{Digits, count, decimal, push_count};
use crate::path::{Move, Purpose, RAPID_RATE, Subject, Touch};
use crate::text::{text, words};

/// Fanuc 30i, 31i, 32i, 0i-F.
pub static FANUC: PostDef = PostDef {
    key: "fanuc",
    title: "Fanuc 30i / 0i-F",
    about: "moves with the skip function G31, each compared with its end; a contact lifts before the alarm; results in common variables, the origin written at the end. Not verified on a control.",
    extension: "nc",
    work_offsets: 6,
    work_offset_word: |n| format!("G{}", 53 + n),
    cannot: &[],
    emit: |request| emit(request, &PLAIN),
    read: Some(read::fanuc),
    ..BASE
};

/// Haas Next Generation Control.
pub static HAAS: PostDef = PostDef {
    key: "haas",
    title: "Haas NGC",
    about: "the same with M78 and M79, which raise the alarm in the control itself. Not verified on a control.",
    extension: "nc",
    work_offsets: 99,
    work_offset_word: |n| if n <= 6 { format!("G{}", 53 + n) } else { format!("G154 P{}", n - 6) },
    cannot: &[
        (
            safety::CONTACT_LIFTS,
            words!("M78 raises the alarm in the control itself, where the ball stands: nothing after it runs"),
        ),
        (
            safety::MISS_LIFTS,
            words!("M79 raises the alarm in the control itself, where the ball stands: nothing after it runs"),
        ),
    ],
    rate: |request, _, step| rate(request, step, WITH_ALARMS.rapid),
    check: |request, checker| {
        check(request, checker);
        check_haas_feeds(request, checker);
    },
    emit: |request| emit(request, &WITH_ALARMS),
    read: Some(read::haas),
    ..BASE
};

const BASE: PostDef = PostDef {
    key: "",
    title: "",
    about: "",
    extension: "",
    work_offsets: 0,
    work_offset_word: |_| String::new(),
    no_work_offset: "",
    first_length: false,
    computes: true,
    watches: true,
    shortest_probe: SHORTEST_PROBE,
    constant_error: 2e-8,
    dialect: Some(&DIALECT),
    cannot: &[],
    name: |name| crate::control::comment_text(name).to_ascii_uppercase(),
    rate: |request, _, step| rate(request, step, PLAIN.rapid),
    serves,
    check,
    emit: |request| emit(request, &PLAIN),
    read: None,
};

static DIALECT: Dialect = Dialect {
    decimals_mm: 4,
    decimals_inch: 5,
    comment: ("(", ")"),
    // Ours: what is longer is hard to read on the screen of the control.
    comment_width: 80,
    longest_block: 255,
    points: true,
    capitals: true,
    units: ("G21", "G20"),
    modes: "G40 G80 G90",
    arcs: "",
};

/// What differs between the two.
#[derive(Debug)]
struct Flavour {
    /// The length of the active tool.
    length: &'static str,
    /// What a rapid runs at where it is watched, mm/min.
    rapid: f64,
    /// After a positioning move, in its block.
    free: &'static str,
    /// After a touch, in its block.
    touch: &'static str,
    /// A block that keeps the control from evaluating what stands after it until the motion before it is done.
    halt: &'static str,
    /// The block that lets it read ahead again, at the end.
    free_again: Option<&'static str>,
    /// Whether the end of the program may clear the common variables.
    forgets: bool,
    /// What the program refuses to move in, in words.
    refuses: &'static str,
    /// States in which nothing moves, beside other units.
    states: &'static [&'static str],
}

static PLAIN: Flavour = Flavour {
    length: "#[2000+#4111]+#[2200+#4111]",
    rapid: RAPID_RATE,
    free: "",
    touch: "",
    halt: "G53",
    free_again: None,
    forgets: true,
    refuses: "Nothing moves in other units, without G43 and an H from 1 to 200, in polar coordinates, under a rotation, a tilted plane, a scale or a mirror",
    // The two tables of lengths have 200 places each.
    states: &[
        "#4008 NE 43",
        "#4111 LT 1",
        "#4111 GT 200",
        "#4017 EQ 16",
        "#4016 EQ 68",
        "#4016 EQ 68.2",
        "#4016 EQ 68.3",
        "#4016 EQ 68.4",
        "#4011 EQ 51",
        "#4022 EQ 51.1",
    ],
};
static WITH_ALARMS: Flavour = Flavour {
    length: "#5083",
    rapid: 2400.0,
    free: " M78",
    touch: " M79",
    halt: "G103 P1",
    free_again: Some("G103"),
    forgets: false,
    refuses: "Nothing moves in other units, without G43, under a rotation or a scale. A mirror, G254 and G268 are not asked: switch them off",
    states: &["#4008 NE 43", "#4016 EQ 68", "#4011 EQ 51"],
};

/// What a move may end off its end, or a touch before its end, mm: less is no contact. Ours.
const IN_POSITION: f64 = 0.05;

/// The shortest probing move, mm: of a shorter one a contact could not be distinguished from its end, and positioning is plain. Ours.
const SHORTEST_PROBE: f64 = 0.2;

/// The least that a touch searches, and that it begins before its contact, mm: in less its contact cannot be distinguished from its end, or
/// from its beginning.
const SHORTEST_SEARCH: f64 = 0.2;

/// The feed that a G31 of a Haas must stay below, mm/min, in programs in mm and in inch: its manual says so, since more may damage the probe.
const HAAS_LIMITS: [f64; 2] = [2500.0, 2540.0];

/// Variables: 100 is the length, those after it hold results and what is needed on the way, 148 is a place aside, 149 the move.
const FIRST: usize = 100;
const LAST: usize = 147;

/// Labels. The exits stand after the end.
const FREE: &str = "9001";
const MISSED: &str = "9002";
const BLOCKED: &str = "9003";
const STATE: &str = "9004";
const ELSEWHERE: &str = "9005";

fn serves(_subject: Subject, form: Form) -> Result<(), &'static str> {
    match form {
        Form::Moves => Ok(()),
        Form::Cycle => Err("it has no probing cycles of its own; calls of installed macros (P98xx) are not printed"),
    }
}

/// What the value of an assignment changes by in a full turn, degrees, where it is an angle or half of one.
fn full_turn(formula: &Formula, node: NodeId) -> Option<i32> {
    let is_angle = |node: NodeId| matches!(formula.node(node), Node::Atan2(..));
    match formula.node(node) {
        Node::Atan2(..) => Some(360),
        Node::Binary(Op::Divide, angle, two) if is_angle(angle) && formula.node(two) == Node::Number(2.0) => Some(180),
        _ => None,
    }
}

fn variable(n: usize) -> String {
    let mut text = String::new();
    push_variable(&mut text, n);
    text
}

fn push_variable(text: &mut String, n: usize) {
    text.push('#');
    push_count(text, FIRST + n);
}

/// The feed of a move, mm/min: all but the shortest are watched.
fn rate(request: &Request<'_>, step: &Move, rapid: f64) -> Option<f64> {
    request.feeds.rate(step.feed).or_else(|| feed_rate(request, None, step).map(|_| rapid))
}

/// The fastest G31 of a Haas.
fn check_haas_feeds(request: &Request<'_>, checker: &mut Checker) {
    let feeds = request.path.moves.iter().filter_map(|step| match step.purpose {
        Purpose::Touch(_) => Some(request.feeds.work),
        Purpose::Position => request.feeds.rate(step.feed),
        Purpose::Back(_) => None,
    });
    let fastest = feeds.fold(0.0, f64::max);
    let limit = HAAS_LIMITS[usize::from(request.scale != 1.0)];
    if fastest >= limit {
        let message = text!(
            "G31 runs at up to {feed}/min here: the manual of the Classic control asks for less than {limit}/min, since more may damage the probe",
            checker.length(fastest),
            checker.length(limit)
        );
        checker.warning("probing-too-fast", "feeds", message);
    }
}

fn check(request: &Request<'_>, checker: &mut Checker) {
    let unverified = text!(
        "G31, the skip positions and the origins of work offsets are written as posts and macros in use have them; nothing of it \
                      was run on a control: try it without a part, feed hold at hand. G31 may ignore the feed override"
    );
    checker.info("not-verified", "control.post", unverified);
    let rapid = request.path.moves.iter().find(|m| request.feeds.rate(m.feed).is_none());
    if let Some(rate) = rapid.filter(|_| request.protected).and_then(|m| (request.post.rate)(request, None, m)) {
        let message = text!("G31 moves at a stated feed: rapids run as watched moves at {rate}/min", checker.length(rate));
        checker.info("rapid-at-feed", "feeds", message);
    }
    if !request.protected && !request.path.moves.is_empty() {
        let message = text!(
            "Without watched positioning a probe that is deflected from the start would be taken for a touch: this control takes watched \
                       programs only"
        );
        checker.error("protection-unsupported", "control.protection", message);
    }
    check_plain_moves(request, checker);
    check_rotary(request, checker, text!("The program does not know the rotary axis of the machine"));
    check_write(request, checker);
    if request.plane != Plane::G17 && !request.path.moves.is_empty() {
        let message =
            text!("The length of the tool is taken to act along Z: programs for another plane than G17 are not printed");
        checker.error("plane-unsupported", "plane", message);
    }
    let datum = request.path.formula.datum.as_ref().filter(|_| request.work_offset.is_some());
    if datum.is_some_and(|d| d.rotation.is_some()) {
        let message = text!("A work offset of this control has no rotation: none can be written");
        checker.error("rotation-unsupported", "cycle.confirmRotation", message);
    }
    if let Some(k) = request.path.touches.iter().position(|touch| touch.search < SHORTEST_SEARCH) {
        let message = text!(
            "Touch {touch} searches {search} past its nominal contact: at least {least} are needed, so that its contact differs from its end",
            k + 1,
            checker.length(request.path.touches[k].search),
            checker.length(SHORTEST_SEARCH)
        );
        checker.error("search-too-short", "overtravel", message);
    }
    check_starts(request, checker);
    check_digits(request, checker);
    let last = FIRST + request.registers().last;
    if last > LAST {
        let message = text!(
            "The program would need #{first} to #{last}; a control has common variables up to #149 unless it was set up for more: take fewer \
             touches",
            FIRST,
            last
        );
        checker.error("too-many-registers", "control.post", message);
    }
}

/// No place needs more digits than a number may have.
fn check_digits(request: &Request<'_>, checker: &mut Checker) {
    let decimals = if request.scale == 1.0 { DIALECT.decimals_mm } else { DIALECT.decimals_inch };
    let limit = 10f64.powi(DIGITS as i32 - decimals as i32) * request.scale;
    let touches = request.path.touches.iter().map(|touch| touch.contact(request.setup.radius) - touch.vector * touch.search);
    let places = request.path.moves.iter().map(|step| step.to).chain(touches);
    let farthest = places.map(|place| place.abs().max_element()).fold(0.0, f64::max);
    if farthest >= limit {
        let message = text!(
            "A place is {far} from the origin: places must be within {limit}, since a number has {digits} digits at most on some controls",
            checker.length(farthest),
            checker.length(limit),
            DIGITS
        );
        checker.error("too-many-digits", "cycle", message);
    }
}

/// Every touch begins far enough before its contact.
fn check_starts(request: &Request<'_>, checker: &mut Checker) {
    let radius = request.setup.radius;
    let mut ways =
        request.path.searches().filter_map(|(k, from, _)| Some((k, from?.distance(request.path.touches[k].contact(radius)))));
    if let Some((k, way)) = ways.find(|(_, way)| *way < SHORTEST_SEARCH) {
        let message = text!(
            "Touch {touch} begins {way} before its nominal contact: at least {least} are needed, so that its contact differs from its beginning",
            k + 1,
            checker.length(way),
            checker.length(SHORTEST_SEARCH)
        );
        checker.error("touch-too-short", "cycle", message);
    }
}

fn emit(request: &Request<'_>, flavour: &'static Flavour) -> Program {
    moves::write(request, &DIALECT, &mut Skip { request, flavour, registers: request.registers(), labels: 0 })
}

/// The program of one request.
struct Skip<'a> {
    request: &'a Request<'a>,
    flavour: &'static Flavour,
    registers: &'a Registers,
    labels: usize,
}

/// Writes expressions over these variables.
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
        decimals(x)
    }
}

/// A constant has at most eight digits, the zero in front of the point too.
fn decimals(x: f64) -> usize {
    let whole = x.abs().max(1.0).log10().floor() as usize + 1;
    DIGITS.saturating_sub(whole)
}

/// The digits of a constant: more is an alarm on some controls.
const DIGITS: usize = 8;

/// Where the ball stopped in the last G31, along each axis.
const STOPPED_AT: [&str; 3] = ["#5061", "#5062", "#5063"];

impl Skip<'_> {
    /// A number of the program, as a value: with its point, and in brackets where it is negative.
    fn number(w: &Writer<'_>, mm: f64) -> String {
        let text = w.number(mm);
        if text.starts_with('-') { format!("[{text}]") } else { text.to_string() }
    }

    /// How far the ball stopped off a place, along the axes that are known, as a sum.
    fn off(w: &Writer<'_>, to: Vec3, axes: &[usize]) -> String {
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
            sum.push(']');
        }
        sum
    }

    fn in_position(w: &Writer<'_>) -> Digits {
        w.number(IN_POSITION)
    }

    /// A probing move, and the block that keeps the control from reading ahead.
    fn probe(&self, w: &mut Writer<'_>, words: &str, rate: f64, alarm: &str) {
        let feed = w.number(rate);
        w.parts(&["G31", words, " F", &feed, alarm]);
        w.line(self.flavour.halt);
    }

    /// A watched move, and its check on the axes whose places are known.
    fn goes(&self, w: &mut Writer<'_>, words: &str, to: Vec3, step: &Move, axes: &[usize], exit: &str) {
        let rate = self.rate(step);
        self.probe(w, words, rate, self.flavour.free);
        if !axes.is_empty() {
            let (off, near) = (Self::off(w, to, axes), Self::in_position(w));
            w.parts(&["IF [", &off, " GT ", &near, "] GOTO ", exit]);
        }
    }

    /// The feed of a move, mm/min.
    fn rate(&self, step: &Move) -> f64 {
        rate(self.request, step, self.flavour.rapid).unwrap_or(self.flavour.rapid)
    }

    fn label(&mut self) -> String {
        self.labels += 1;
        self.labels.to_string()
    }

    /// After a move, or at a place, whose height is known: what #5043 reads more than that is the length of the tool or nothing. Anything
    /// else is a contact on the way, or a stylus elsewhere.
    fn settle(&mut self, w: &mut Writer<'_>, height: f64, exit: &str) {
        let (near, good) = (Self::in_position(w), self.label());
        let set = format!("#148=#5043-{}", Self::number(w, height));
        w.line(&set);
        w.line(&format!("IF [ABS[#148] LE {near}] GOTO {good}"));
        w.line(&format!("IF [ABS[#148-{}] GT {near}] GOTO {exit}", variable(0)));
        w.line(&format!("N{good}"));
        w.line(&format!("{}=#148", variable(0)));
    }

    fn moving(&self) -> bool {
        !self.request.path.moves.is_empty()
    }
}

impl Moves for Skip<'_> {
    fn begin(&mut self, w: &mut Writer<'_>) {
        let request = self.request;
        let formula = &request.path.formula;
        w.line("%");
        w.line("O1000");
        let write = written(request, formula.datum.as_ref());
        w.header(&offset_line(request, request.post.work_offset_word, &write));
        w.comment("The number O1000 is any: give it a free one");
        if let (Some(first), None) = (request.path.moves.first(), request.path.start) {
            let (height, place) = (w.height_word(first.to), w.place_words(first.to));
            w.comment(&format!(
                "The stylus must stand at {height} or higher, else nothing moves. It goes in the plane, then down to {place}: that way must be free"
            ));
        }
        w.comment(
            "Not verified on a control: run it without a part first, feed hold at hand. G31 may ignore the feed override",
        );
        if self.moving() {
            w.comment(
                "Watched moves are G31 with a check that they come to their end; touches the same, the other way round. #149 is the move",
            );
        }
        for line in self.registers.lines(formula, 0, DIALECT.comment_width - 2, variable) {
            w.comment(&line);
        }
        w.says_job();
        if self.moving() {
            w.comment(self.flavour.refuses);
            let other_units = if request.scale == 1.0 { "#4006 EQ 20" } else { "#4006 EQ 21" };
            for check in [other_units].iter().chain(self.flavour.states) {
                w.line(&format!("IF [{check}] GOTO {STATE}"));
            }
        }
        w.modes();
        w.line("M5");
        w.line("M9");
        if !self.moving() {
            return;
        }
        if let Some(n) = request.work_offset {
            w.line(&(request.post.work_offset_word)(n));
        }
        w.line(self.flavour.halt);
        w.line(&format!("{}={}", variable(0), self.flavour.length));
        if let Some(start) = request.path.start {
            self.settle(w, start.z, ELSEWHERE);
        }
    }

    fn approach(&mut self, w: &mut Writer<'_>, first: &Move) {
        w.line("#149=1");
        // Whether #5043 has the length in it is not known yet: the stylus must stand high enough either way, the first for a length above
        // zero, the second for one below, as tables with machine heights have. Sums of lengths and heights are rounded, and a control reads
        // its axes in its own steps.
        let height = Self::number(w, first.to.z - IN_POSITION);
        w.line(&format!("IF [#5043-{} LT {height}] GOTO {ELSEWHERE}", variable(0)));
        w.line(&format!("IF [#5043 LT {height}] GOTO {ELSEWHERE}"));
        // The stylus is above all that the program knows of, but not by how much: a contact does not lift, since a lift to a stated height
        // could go down.
        let across = w.plane_words(first.to);
        self.goes(w, &across, first.to, first, &[0, 1], BLOCKED);
        w.makes_move();
        let down = w.tool_word(first.to);
        self.goes(w, &down, first.to, first, &[], BLOCKED);
        self.settle(w, first.to.z, BLOCKED);
    }

    fn position(&mut self, w: &mut Writer<'_>, step: Step<'_>) {
        w.parts(&["#149=", &count(step.index + 1)]);
        w.makes_move();
        each_piece(self.request, step, |from, to| {
            if from.is_some_and(|from| from.distance(to) < SHORTEST_PROBE) {
                w.straight("G1", to, true, Some(self.rate(step.step)));
                return;
            }
            let exit = if upwards(self.request, from, to) > 0 { BLOCKED } else { FREE };
            let words = w.place(to, true);
            self.goes(w, &words, to, step.step, &[0, 1, 2], exit);
        });
    }

    fn touch(&mut self, w: &mut Writer<'_>, step: Step<'_>, touch: &Touch) {
        w.parts(&["#149=", &count(step.index + 1)]);
        w.makes_move();
        let end = step.step.to - touch.vector * touch.search;
        let words = w.all_words(end);
        self.probe(w, &words, self.request.feeds.work, self.flavour.touch);
        let near = Self::in_position(w);
        // A probe that has not settled since the move before would have the start taken for the wall.
        if let Some(start) = step.from {
            w.parts(&["IF [", &Self::off(w, start, &[0, 1, 2]), " LE ", &near, "] GOTO ", FREE]);
        }
        w.parts(&["IF [", &Self::off(w, end, &[0, 1, 2]), " LE ", &near, "] GOTO ", MISSED]);
    }

    fn keeps(&self, sample: usize, axis: usize, kept: &mut Kept) -> bool {
        push_variable(&mut kept.variable, self.registers.trigger(sample, axis));
        kept.source.push_str(STOPPED_AT[axis]);
        if axis == 2 {
            kept.source.push('-');
            push_variable(&mut kept.source, 0);
        }
        (kept.group, kept.whole) = (("[", "]"), ("[", "]"));
        true
    }

    fn back(&mut self, w: &mut Writer<'_>, step: Step<'_>) {
        w.makes_move();
        w.straight("G1", step.step.to, true, Some(self.rate(step.step)));
    }

    fn assign(&mut self, w: &mut Writer<'_>, formula: &Formula, index: usize) {
        w.build(|text| {
            push_variable(text, self.registers.variables[index]);
            text.push('=');
            print::print_to(text, &Variables(self.registers), formula, formula.assignments[index].node, self.request.scale);
        });
        // ATAN gives 0 to 360 or -180 to 180 degrees, as a parameter of the control says (6004 bit 0): the formula means the latter.
        if let Some(turn) = full_turn(formula, formula.assignments[index].node) {
            let angle = variable(self.registers.variables[index]);
            w.line(&format!("IF [{angle} GT {}] THEN {angle}={angle}-{turn}", turn / 2));
        }
    }

    fn results(&mut self, w: &mut Writer<'_>, _formula: &Formula) {
        for &(copy, index) in &self.registers.copies {
            w.line(&format!("{}={}", variable(copy), variable(self.registers.variables[index])));
        }
    }

    /// The origin moves by what was measured less what is nominal: a work offset has no rotation.
    fn write(&mut self, w: &mut Writer<'_>, formula: &Formula, number: i32, datum: &Datum) {
        w.line(self.flavour.halt);
        w.comment("One write, at the very end: the origin moves by what was measured less what is nominal");
        let axes = self.request.plane.axes();
        for (i, place) in datum.place.iter().enumerate() {
            let Some(Coordinate { measured: Some(measured), nominal }) = *place else { continue };
            let value = print::variable(&Variables(self.registers), formula, measured);
            let nominal = nominal / self.request.scale;
            let nominal = match decimal(nominal, decimals(nominal)).as_str() {
                "0" => String::new(),
                text if text.starts_with('-') => format!("-[{text}]"),
                text => format!("-{text}"),
            };
            let origin = format!("#{}", origin(number) + axes[i]);
            w.line(&format!("{origin}={origin}+{value}{nominal}"));
        }
        w.line(&(self.request.post.work_offset_word)(number));
    }

    fn end(&mut self, w: &mut Writer<'_>) {
        if let Some(end) = self.flavour.free_again.filter(|_| self.moving()) {
            w.line(end);
        }
        let formula = &self.request.path.formula;
        let measures = formula.results.iter().any(|result| result.variable.is_some());
        let writes = self.request.work_offset.is_some() && formula.datum.as_ref().is_some_and(Datum::writes);
        if self.flavour.forgets && measures && !writes {
            w.comment("Read the results now: M30 may clear #100 to #149");
            w.line("M0");
        }
        w.line("M30");
        if let Some(first) = self.request.path.moves.first() {
            self.exits(w, first);
        }
        w.line("%");
    }
}

impl Skip<'_> {
    /// What stands after the end: a contact that lifts, one that does not, a missed touch, a state that nothing may move in.
    fn exits(&self, w: &mut Writer<'_>, first: &Move) {
        let top = highest(self.request).z;
        let height = Self::number(w, top);
        let lift = format!("G1 Z{} F{}", w.number(top), w.number(self.rate(first)));
        let mut exit = |label: &str, lifts: Option<&str>, alarm: &str| {
            w.line(&format!("N{label}"));
            if let Some(stop) = lifts {
                w.line(&format!("IF [#5043-{} GE {height}] GOTO {stop}", variable(0)));
                w.line(&lift);
                w.line(self.flavour.halt);
                w.line(&format!("N{stop}"));
            }
            w.line(&format!("#3000={alarm}"));
        };
        exit(FREE, Some("9011"), "1(CONTACT IN MOVE #149)");
        exit(BLOCKED, None, "1(CONTACT IN MOVE #149)");
        exit(MISSED, Some("9012"), "2(NO CONTACT IN TOUCH #149)");
        exit(STATE, None, "3(WRONG STATE, SEE HEADER)");
        let start =
            if self.request.path.start.is_some() { "4(STYLUS NOT AT STATED START)" } else { "4(STYLUS TOO LOW TO START)" };
        exit(ELSEWHERE, None, start);
    }
}

/// The variable of the origin of a work offset along X; Y and Z are the next. Twenty apart: G54 to G59 from 5221 on, G154 P1 on from 14001.
pub fn origin(number: i32) -> usize {
    let number = usize::try_from(number).unwrap_or(1);
    if number <= 6 { 5201 + 20 * number } else { 14_001 + 20 * (number - 7) }
}
