//! Safety rules for foreign programs, by their runs. They are the rules for our own programs, as far as a run without the control can answer: null is
//! "unknown", with the reason.

use serde::Serialize;

use crate::control::rules::{NO_LOW_RAPID, ONE_WRITE, PLAUSIBLE, WATCHED, WRITE_LAST};
use crate::import::toolpath::frames::Axes;
use crate::import::toolpath::writes::{OFFSET, SHIFT, Write};
use crate::import::toolpath::{DIALECTS, PROBE, RAPID, Toolpath};
use crate::part::Machine as Inertia;
use crate::text::{Text, text};

/// Events of a run beside its moves, each with the number of moves before it.
#[derive(Debug, Default)]
pub(super) struct Log {
    /// Probing moves.
    pub touches: Vec<Touch>,
    /// The spindle is started (true) or stopped.
    pub spindle: Vec<(usize, usize, bool)>,
    /// Lines in which an unknown condition starts it.
    pub may_spin: Vec<(usize, usize)>,
    /// Lasting writes.
    pub writes: Vec<Write>,
    /// Lines with possible events that are not seen.
    pub unread: Vec<u32>,
    /// Line of the alarm that ends the run.
    pub stopped: Option<u32>,
    /// The text is a subprogram: its caller may state what it needs.
    pub returns: bool,
    /// Conditions that do not check a contact.
    pub conditions: Vec<(usize, usize)>,
    /// Dwells without a time.
    pub endless_waits: Vec<usize>,
    /// Moves that native macros make: from, up to.
    pub own: Vec<(usize, usize)>,
    /// Whether units, plane, absolute or incremental positions and the kind of feed were stated before the first motion, and its line.
    pub stated: Option<(usize, [bool; 3])>,
    /// Whether positions are distances at the end.
    pub left_incremental: bool,
    /// A call since then may have changed that.
    pub maybe_changed: bool,
    /// They are distances at the end of some branches, and positions at the end of others.
    pub left_unsure: bool,
    /// Whether the program reached its own end.
    pub ends: bool,
    /// Clearance heights of HEIDENHAIN cycles: nothing is in the way there.
    pub clearances: Vec<(usize, f64)>,
    /// Moves with the tool axis at the machine's zero or home position, which is assumed above every part \[I\].
    pub up: Vec<usize>,
}

impl Log {
    /// Whether a native macro makes a move and is responsible for it.
    fn is_own(&self, index: usize) -> bool {
        let at = self.own.partition_point(|(_, end)| *end <= index);
        self.own.get(at).is_some_and(|(begin, _)| *begin <= index)
    }

    /// Whether the next move continues along the same axes, and the program checks that one for a contact: it begins where this one ends.
    fn is_chained(&self, touch: &Touch) -> bool {
        let at = self
            .touches
            .partition_point(|other| other.index <= touch.index);
        let next = self.touches.get(at);
        next.is_some_and(|next| {
            next.index == touch.index + 1 && next.axes == touch.axes && next.watched
        })
    }

    /// Whether a move stays at or above the clearance height of the next cycle, or at the top of the machine.
    fn is_clear(&self, path: &Toolpath, index: usize) -> bool {
        if self.up.binary_search(&index).is_ok() {
            return true;
        }
        let next = self
            .clearances
            .partition_point(|(moves, _)| *moves <= index);
        let tool = path.plane.axes()[2];
        let lowest = path.begin(index)[tool].min(path.end(index)[tool]);
        self.clearances
            .get(next)
            .is_some_and(|(_, height)| lowest >= height - 1e-6)
    }
}

/// A probing move of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    pub index: usize,
    pub line: usize,
    /// Axes that its block names.
    pub axes: Axes,
    /// Whether a miss is an alarm of the control.
    pub stops: bool,
    /// Whether the program checks afterwards for a contact.
    pub asked: bool,
    /// Whether a contact leads away: watched positioning.
    pub watched: bool,
    /// Whether it is a positioning move: a contact leads away, or the program ignores its end.
    pub positions: bool,
    /// Whether it is unknown if the program checks.
    pub may_ask: bool,
    /// Feed in the units of the path; NaN is unknown.
    pub feed: f64,
    /// Whether the program has stated a feed before or in its block.
    pub states_feed: bool,
}

/// Verdict of a rule on a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunRule {
    /// The name of the rule.
    pub rule: &'static str,
    /// Whether the rule holds; null if an unknown decides.
    pub holds: Option<bool>,
    /// Finding, and the remedy.
    pub message: String,
    /// `message` as a template and its values.
    pub said: Text,
    /// The 0-based lines that break it, or are unknown.
    pub lines: Vec<u32>,
}

impl Log {
    /// Touches after whose contact the axes travel more than a millimetre: their lines, and the distance of the fastest, in mm, with its feed in mm/min.
    pub fn fast_touches(&self, machine: &Inertia, inch: f64) -> Option<(Vec<u32>, f64, f64)> {
        const FAR: f64 = 1.0;
        let ways: Vec<(u32, f64)> = self
            .touches
            .iter()
            .filter(|touch| !touch.positions && touch.feed.is_finite())
            .map(|touch| (touch.line as u32, touch.feed * inch))
            .filter(|(_, feed)| machine.stopping_way(*feed) > FAR)
            .collect();
        let fastest = ways.iter().map(|(_, feed)| *feed).reduce(f64::max)?;
        let mut lines: Vec<u32> = ways.into_iter().map(|(line, _)| line).collect();
        lines.sort_unstable();
        lines.dedup();
        Some((lines, machine.stopping_way(fastest), fastest))
    }
}

/// Names of the rules for any program, in order.
pub const RUN_RULES: [&str; 11] = [
    "modes-stated",
    "spindle-off",
    WATCHED,
    "missed-touch-stops",
    "feeds-stated",
    NO_LOW_RAPID,
    WRITE_LAST,
    ONE_WRITE,
    PLAUSIBLE,
    "waits-stated",
    "modes-left",
];

/// Checks every rule on a run that probes; a run without a touch is not checked.
pub(super) fn checks_contact(path: &Toolpath, log: &mut Log) -> Vec<RunRule> {
    log.writes.sort_by_key(|write| (write.moves, write.line));
    // A program that ignores all contacts has touches nevertheless.
    let all = log.touches.iter().all(|touch| touch.positions);
    let touches: Vec<&Touch> = log
        .touches
        .iter()
        .filter(|touch| all || !touch.positions)
        .collect();
    let (Some(first), Some(last)) = (touches.first(), touches.last()) else {
        return Vec::new();
    };
    let (first, last) = (first.index, last.index);
    // An unchecked probing move may be a touch.
    let last_probing = log
        .touches
        .iter()
        .filter(|touch| !touch.watched)
        .map(|touch| touch.index)
        .max()
        .map_or(last, |index| index.max(last));
    for write in &mut log.writes {
        let touched = log
            .touches
            .iter()
            .rfind(|touch| !touch.watched && touch.index < write.moves);
        let behind = touched.map_or(0, |touch| touch.index + 1);
        let asked = log
            .conditions
            .iter()
            .any(|(before, _)| (behind..=write.moves).contains(before));
        write.guarded = if asked { None } else { Some(false) };
    }
    let log = &*log;
    let rows = [
        modes(path, log),
        spindle(log, last),
        watched(path, log, last),
        missed(path, log, &touches, last),
        feeds(&touches),
        rapids(path, log, first, last),
        writes(log, first, last_probing),
        one_write(log),
        plausible(log, first, last),
        waits(log),
        left(log),
    ];
    debug_assert!(
        rows.iter().map(|row| row.rule).eq(RUN_RULES),
        "in their order"
    );
    rows.into()
}

fn row(rule: &'static str, holds: Option<bool>, message: Text, mut lines: Vec<usize>) -> RunRule {
    lines.sort_unstable();
    lines.dedup();
    let lines = lines.into_iter().map(|line| line as u32).collect();
    RunRule {
        rule,
        holds,
        message: message.english(),
        said: message,
        lines,
    }
}

fn modes(path: &Toolpath, log: &Log) -> RunRule {
    if path.dialect == DIALECTS[2] {
        let message = text!(
            "The first block states the units, TOOL CALL the tool axis, and each value whether it is a distance"
        );
        return row("modes-stated", Some(true), message, Vec::new());
    }
    let Some((line, [units, plane, distance])) = log.stated else {
        return row("modes-stated", None, text!("Nothing moves"), Vec::new());
    };
    let is_sinumerik = path.dialect == DIALECTS[1];
    let missing: Vec<&str> = [
        (units, if is_sinumerik { "G71" } else { "G21" }),
        (plane, "G17"),
        (distance, "G90"),
    ]
    .into_iter()
    .filter(|(stated, _)| !stated)
    .map(|(_, word)| word)
    .collect();
    match missing.as_slice() {
        [] => row(
            "modes-stated",
            Some(true),
            text!("Units, plane and absolute mode are stated before the first motion"),
            Vec::new(),
        ),
        _ if log.returns => row(
            "modes-stated",
            None,
            text!("A subprogram: units, plane and absolute mode are stated where it is called"),
            vec![line],
        ),
        missing => {
            let words = missing.join(" ");
            let message = text!(
                "Not stated before the first motion, so left over from another program: write {words} first, or what you need of each",
                words
            );
            row("modes-stated", Some(false), message, vec![line])
        }
    }
}

fn spindle(log: &Log, last: usize) -> RunRule {
    const RULE: &str = "spindle-off";
    let before = log.spindle.iter().filter(|(moves, ..)| *moves <= last);
    let on: Vec<usize> = before
        .clone()
        .filter(|(.., on)| *on)
        .map(|(_, line, _)| *line)
        .collect();
    // Stopped before the first motion, and not started again.
    let off_first = log
        .spindle
        .first()
        .is_some_and(|(moves, _, on)| *moves == 0 && !on);
    let may: Vec<usize> = log
        .may_spin
        .iter()
        .filter(|(moves, _)| *moves <= last)
        .map(|(_, line)| *line)
        .collect();
    match (on.is_empty(), off_first) {
        (true, _) if !may.is_empty() => row(
            RULE,
            None,
            text!("Unknown conditions start the spindle before the last touch"),
            may,
        ),
        (false, _) => row(
            RULE,
            Some(false),
            text!(
                "The spindle is started before the last touch: write M5 before the first motion, and no M3 or M4 before the end"
            ),
            on,
        ),
        (true, true) => row(
            RULE,
            Some(true),
            text!("The spindle is stopped before the first motion"),
            Vec::new(),
        ),
        (true, false) => row(
            RULE,
            None,
            text!(
                "The program neither starts nor stops the spindle before it moves: write M5 before the first motion"
            ),
            Vec::new(),
        ),
    }
}

/// Whether a move is a retract or goes straight up; `None` if that is unknown.
fn is_free(path: &Toolpath, index: usize) -> Option<bool> {
    let to = path.end(index);
    let from = path.begin(index);
    let way = to - from;
    if way.is_nan() || from.is_nan() {
        return None;
    }
    let [a, o, tool] = path.plane.axes();
    let up = way[a].abs() < 1e-6 && way[o].abs() < 1e-6 && way[tool] > 0.0;
    if up || way.length() < 1e-9 {
        return Some(true);
    }
    if index == 0 || path.kind[index - 1] != PROBE {
        return Some(false);
    }
    let touch = path.end(index - 1) - path.begin(index - 1);
    let back = || {
        way.dot(touch) < 0.0 && way.cross(touch).length() <= 1e-3 * way.length() * touch.length()
    };
    (!touch.is_nan()).then(back)
}

/// Rise of a move along the tool axis.
fn rise(path: &Toolpath, index: usize) -> f64 {
    let way = path.end(index) - path.begin(index);
    way[path.plane.axes()[2]]
}

/// Whether the move is the first of two touches in one direction with a retract between them; `None` if that is unknown.
fn is_first_of_two(path: &Toolpath, index: usize) -> Option<bool> {
    if index + 2 >= path.len() || [1, 2].map(|i| path.kind[index + i] == PROBE) != [false, true] {
        return Some(false);
    }
    let [way, again] = [0, 2].map(|i| path.end(index + i) - path.begin(index + i));
    if way.is_nan() || again.is_nan() {
        return None;
    }
    let is_same = way.dot(again) > 0.999 * way.length() * again.length();
    is_free(path, index + 1).map(|back| back && is_same)
}

fn watched(path: &Toolpath, log: &Log, last: usize) -> RunRule {
    let tool = path.plane.axes()[2];
    let (mut bad, mut unknown) = (Vec::new(), Vec::new());
    let mut called: Vec<usize> = Vec::new();
    // A contact stops such a move, and the program continues from there.
    let unasked = |touch: &&Touch| touch.index < last && touch.positions && !touch.asked;
    for touch in log.touches.iter().filter(unasked) {
        match is_first_of_two(path, touch.index) {
            _ if log.is_chained(touch) || log.is_clear(path, touch.index) => {}
            _ if touch.may_ask => called.push(touch.line),
            Some(true) => {}
            _ if touch.axes == 1 << tool => match rise(path, touch.index) {
                rise if rise > 0.0 => {}
                rise if rise.is_nan() => unknown.push(touch.line),
                _ => bad.push(touch.line),
            },
            Some(false) => bad.push(touch.line),
            None => unknown.push(touch.line),
        }
    }
    for index in (0..last).filter(|index| path.kind[*index] != PROBE && !log.is_own(*index)) {
        match is_free(path, index) {
            Some(true) => {}
            _ if log.is_clear(path, index) => {}
            Some(false) => bad.push(path.line[index] as usize),
            None => unknown.push(path.line[index] as usize),
        }
    }
    let instead = match path.dialect {
        dialect if dialect == DIALECTS[1] => "MEAS=1 G1 … / STOPRE / IF $AC_MEA[1]<>0 GOTOF …",
        _ if path.by_g38 => "G38.3 … / o1 if [#5070 NE 0] … (ABORT, …)",
        _ => "G31 … / IF [ABS[#5061-…] GT 0.05] GOTO …",
    };
    match (bad.is_empty(), unknown.is_empty()) {
        (false, _) if path.dialect == DIALECTS[2] => {
            let message = text!(
                "Positioning moves below the clearance height of the next cycle are not watched: a contact in them goes unnoticed. Move there at Q260 or above"
            );
            row(WATCHED, Some(false), message, bad)
        }
        (false, _) => {
            let message = text!(
                "Positioning moves before the last touch are not watched: a contact in them goes unnoticed. Write {instead}",
                instead.to_owned()
            );
            row(WATCHED, Some(false), message, bad)
        }
        (true, _) if !called.is_empty() => row(WATCHED, None, may_be_asked(), called),
        (true, false) => row(
            WATCHED,
            None,
            text!(
                "Whether these moves only go up or retract from a touch is unknown, because their positions are"
            ),
            unknown,
        ),
        (true, true) => row(
            WATCHED,
            Some(true),
            text!("Every positioning move is watched, moves straight up, or retracts from a touch"),
            Vec::new(),
        ),
    }
}

fn may_be_asked() -> Text {
    text!("Whether the program checks for contact after these moves is unknown")
}

fn missed(path: &Toolpath, log: &Log, touches: &[&Touch], last: usize) -> RunRule {
    const RULE: &str = "missed-touch-stops";
    // A move without travel reads the position.
    let is_still =
        |touch: &Touch| (path.end(touch.index) - path.begin(touch.index)).length() < 1e-3;
    // The fault of an unchecked positioning move is that a contact goes unnoticed.
    let is_touch = |touch: &&&Touch| {
        (!touch.positions || !path.by_g38 && touch.index >= last) && !is_still(touch)
    };
    // If the touches are in a subprogram outside the text, this may be a positioning move.
    let may_ask = |touch: &&&Touch| {
        touch.may_ask || is_touch(touch) && touch.positions && !log.unread.is_empty()
    };
    let is_asked = |touch: &Touch| touch.stops || touch.asked;
    let bad: Vec<usize> = touches
        .iter()
        .filter(is_touch)
        .filter(|touch| !is_asked(touch) && !may_ask(touch))
        .map(|touch| touch.line)
        .collect();
    let is_open = |touch: &&&Touch| !is_asked(touch) && may_ask(touch);
    let open = touches.iter().filter(is_open).map(|touch| touch.line);
    let open: Vec<usize> = open.collect();
    if bad.is_empty() && !open.is_empty() {
        return row(RULE, None, may_be_asked(), open);
    }
    if bad.is_empty() {
        return row(
            RULE,
            Some(true),
            text!("Every touch is checked for contact, or stops the program without one"),
            bad,
        );
    }
    let instead = match path.dialect {
        dialect if dialect == DIALECTS[1] => "STOPRE / IF $AC_MEA[1]==0 GOTOF …",
        _ if path.by_g38 => "G38.2",
        _ => "IF [ABS[#5061-…] LE 0.05] GOTO …",
    };
    let message = text!(
        "After these touches the program continues although there was no contact: write {instead} to end it with an alarm",
        instead.to_owned()
    );
    row(RULE, Some(false), message, bad)
}

fn feeds(touches: &[&Touch]) -> RunRule {
    let bad: Vec<usize> = touches
        .iter()
        .filter(|touch| !touch.states_feed)
        .map(|touch| touch.line)
        .collect();
    match bad.is_empty() {
        true => row(
            "feeds-stated",
            Some(true),
            text!("A feed is stated before every touch, or in its block"),
            bad,
        ),
        false => row(
            "feeds-stated",
            Some(false),
            text!("No feed is stated for these touches: write F in their blocks"),
            bad,
        ),
    }
}

fn rapids(path: &Toolpath, log: &Log, first: usize, last: usize) -> RunRule {
    let tool = path.plane.axes()[2];
    // Anything as high as the approach to the first touch is above the part.
    let height = (0..=first)
        .map(|index| path.drawn(index, path.begin(index))[tool])
        .chain([path.drawn(first, path.end(first))[tool]])
        .fold(f64::NAN, f64::max);
    let (mut bad, mut unknown) = (Vec::new(), Vec::new());
    for index in (first..last).filter(|index| path.kind[*index] == RAPID && !log.is_own(*index)) {
        let line = path.line[index] as usize;
        match (
            is_free(path, index),
            path.drawn(index, path.end(index))[tool],
        ) {
            (Some(true), _) => {}
            _ if log.is_clear(path, index) => {}
            (Some(false), end) if end < height - 1e-6 => bad.push(line),
            (Some(false), _) if !height.is_nan() => {}
            _ => unknown.push(line),
        }
    }
    match (bad.is_empty(), unknown.is_empty()) {
        (false, _) if path.dialect == DIALECTS[2] => {
            let message = text!(
                "Rapids move down or across between the touches, below the clearance height of the next cycle: a rapid does not stop in time. Move there at Q260 or above"
            );
            row(NO_LOW_RAPID, Some(false), message, bad)
        }
        (false, _) => {
            let message = text!(
                "Rapids move down or across between the touches, lower than the program began: a rapid does not stop in time. Write G1 with a feed, watched"
            );
            row(NO_LOW_RAPID, Some(false), message, bad)
        }
        (true, false) => row(
            NO_LOW_RAPID,
            None,
            text!("The lowest position of these rapids is unknown"),
            unknown,
        ),
        (true, true) => row(
            NO_LOW_RAPID,
            Some(true),
            text!(
                "No rapid moves down or across between the touches, except at the height where the program began"
            ),
            Vec::new(),
        ),
    }
}

/// Lines of writes, each once for all its axes, and as often as it runs.
fn lines(writes: &[&Write]) -> Vec<usize> {
    let mut lines = Vec::new();
    let mut first: Option<&Write> = None;
    for write in writes {
        let same = first.is_some_and(|first| {
            (first.moves, first.line) == (write.moves, write.line)
                && (&first.register, first.axis) != (&write.register, write.axis)
        });
        if !same {
            lines.push(write.line as usize);
            first = Some(write);
        }
    }
    lines
}

/// The written registers in the control's notation: `G54 X Y, tool 7 Z`.
fn what(writes: &[&Write]) -> String {
    const MOST: usize = 4;
    let mut names: Vec<(&str, Vec<&str>)> = Vec::new();
    for write in writes {
        let known = names.iter().position(|(name, _)| *name == write.register);
        let at = known.unwrap_or_else(|| {
            names.push((&write.register, Vec::new()));
            names.len() - 1
        });
        let axes = &mut names[at].1;
        axes.extend(write.axis.filter(|axis| !axes.contains(axis)));
    }
    let more = if names.len() > MOST { ", …" } else { "" };
    let named = names.iter().take(MOST).map(|(name, axes)| {
        let words: Vec<&str> = std::iter::once(*name).chain(axes.iter().copied()).collect();
        words.join(" ")
    });
    named.collect::<Vec<_>>().join(", ") + more
}

/// Verdict of a rule on writes if no known write breaks it: it holds only if every line was understood and the run reached its end.
fn if_all_is_seen(rule: &'static str, log: &Log, holds: Text) -> RunRule {
    if let Some(line) = log.stopped {
        let message = text!(
            "Unknown: an alarm ends the run in line {line}",
            line as usize + 1
        );
        return row(rule, None, message, vec![line as usize]);
    }
    if !log.unread.is_empty() {
        let message = text!(
            "Unknown: writes in lines that are not understood, and in programs that they call"
        );
        return row(
            rule,
            None,
            message,
            log.unread.iter().map(|line| *line as usize).collect(),
        );
    }
    row(rule, Some(true), holds, Vec::new())
}

fn writes(log: &Log, first: usize, last: usize) -> RunRule {
    // A tool length stated before any touch is not a result.
    let early: Vec<&Write> = log
        .writes
        .iter()
        .filter(|write| {
            let lasts = [OFFSET, SHIFT].contains(&write.kind);
            write.moves <= last && (lasts || write.moves > first)
        })
        .collect();
    match (log.writes.is_empty(), early.is_empty()) {
        (true, _) => if_all_is_seen(
            WRITE_LAST,
            log,
            text!("The program writes no work offset and no tool data"),
        ),
        (false, true) => if_all_is_seen(
            WRITE_LAST,
            log,
            text!("Every write is after the last touch"),
        ),
        (false, false) => row(
            WRITE_LAST,
            Some(false),
            text!(
                "{what} is written before the last touch has succeeded: store the values, and write once at the end",
                what(&early)
            ),
            lines(&early),
        ),
    }
}

fn one_write(log: &Log) -> RunRule {
    let mut lines = lines(&log.writes.iter().collect::<Vec<_>>());
    let all = lines.len();
    lines.sort_unstable();
    lines.dedup();
    match lines.len() == all {
        true => if_all_is_seen(ONE_WRITE, log, text!("No block writes twice")),
        false => row(
            ONE_WRITE,
            Some(false),
            text!("A block writes more than once: the second write corrects a second time"),
            lines,
        ),
    }
}

/// Whether a condition guards each write of a result. A run does not know what it compares.
fn plausible(log: &Log, first: usize, last: usize) -> RunRule {
    let mut measured = log
        .writes
        .iter()
        .filter(|write| write.moves > first)
        .peekable();
    let is_empty = measured.peek().is_none();
    let unasked: Vec<&Write> = measured
        .filter(|write| write.guarded == Some(false))
        .collect();
    match (is_empty, unasked.is_empty()) {
        (true, _) => if_all_is_seen(
            PLAUSIBLE,
            log,
            text!("The program writes no measured value"),
        ),
        (false, false) => row(
            PLAUSIBLE,
            Some(false),
            text!(
                "{what} is written for any measured value: compare the results with their nominal values first, and stop with an alarm if they deviate too much",
                what(&unasked)
            ),
            lines(&unasked),
        ),
        (false, true) => row(
            PLAUSIBLE,
            None,
            text!(
                "There are conditions between the last touch and the write: whether they compare the results is unknown"
            ),
            log.conditions
                .iter()
                .filter(|(moves, _)| *moves > last)
                .map(|(_, line)| *line)
                .collect(),
        ),
    }
}

fn waits(log: &Log) -> RunRule {
    let lines = log.endless_waits.clone();
    match lines.is_empty() {
        true => row(
            "waits-stated",
            Some(true),
            text!("Every wait states its time"),
            lines,
        ),
        false => row(
            "waits-stated",
            Some(false),
            text!(
                "These waits state no time: an alarm on one control, no wait on another. Write the time after G4"
            ),
            lines,
        ),
    }
}

fn left(log: &Log) -> RunRule {
    match (log.left_incremental, log.ends) {
        _ if log.left_unsure => row(
            "modes-left",
            None,
            text!(
                "Unknown: G91 is active at the end of some branches, which depend on unknown conditions"
            ),
            Vec::new(),
        ),
        _ if log.maybe_changed => row(
            "modes-left",
            None,
            text!("Unknown: a called program that is not in this text may change G90 and G91"),
            Vec::new(),
        ),
        (true, _) => row(
            "modes-left",
            Some(false),
            text!(
                "G91 is still active at the end: the next program moves by distances. Write G90 before the end"
            ),
            Vec::new(),
        ),
        (false, true) => row(
            "modes-left",
            Some(true),
            text!("Absolute mode is active at the end"),
            Vec::new(),
        ),
        (false, false) => row(
            "modes-left",
            None,
            text!("The run came to no end of the program"),
            Vec::new(),
        ),
    }
}
