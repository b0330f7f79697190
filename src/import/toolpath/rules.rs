//! Safety rules asked of a program that someone else wrote, by what its run shows. They are those of the programs that are made here, as far as a run
//! without the control can answer: null is "not known", with the reason.

use serde::Serialize;

use crate::control::rules::{NO_LOW_RAPID, ONE_WRITE, PLAUSIBLE, WATCHED, WRITE_LAST};
use crate::import::toolpath::{DIALECTS, PROBE, RAPID, Toolpath};
use crate::text::{Text, text};

/// What happened in a run beside its moves, each with how many moves were made before.
#[derive(Debug, Default)]
pub(super) struct Log {
    /// Probing moves: the index of the move, and what is known of it.
    pub touches: Vec<Touch>,
    /// The spindle is started (true) or stopped.
    pub spindle: Vec<(usize, usize, bool)>,
    /// Work offsets are written.
    pub writes: Vec<(usize, usize)>,
    /// Conditions that ask for something else than a contact.
    pub conditions: Vec<(usize, usize)>,
    /// Waits that do not say how long.
    pub endless_waits: Vec<usize>,
    /// Moves that macros of the control's own make: from, up to.
    pub own: Vec<(usize, usize)>,
    /// Whether units, plane, absolute or incremental places and the kind of feed were stated before the first motion, and its line.
    pub stated: Option<(usize, [bool; 3])>,
    /// Whether places are distances at the end.
    pub left_incremental: bool,
    /// Whether the program came to an end of its own.
    pub ends: bool,
}

impl Log {
    /// Whether a macro of the control's own makes a move, and answers for it.
    fn is_own(&self, index: usize) -> bool {
        let at = self.own.partition_point(|(_, end)| *end <= index);
        self.own.get(at).is_some_and(|(begin, _)| *begin <= index)
    }
}

/// A probing move of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    pub index: usize,
    pub line: usize,
    /// A miss is an alarm of the control.
    pub stops: bool,
    /// The program asks behind it whether it met something.
    pub asked: bool,
    /// It is a positioning move: a contact leads away, or the program takes no notice of where it ended.
    pub positions: bool,
    /// Its block states a feed.
    pub own_feed: bool,
}

/// What a rule says of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunRule {
    /// The name of the rule.
    pub rule: &'static str,
    /// Null where an unknown decides.
    pub holds: Option<bool>,
    /// What was found, and what to write instead.
    pub message: String,
    /// The same as a template and its values.
    pub said: Text,
    /// The 0-based lines that break it, or that are not known.
    pub lines: Vec<u32>,
}

/// The names of the rules that are asked of any program, in their order.
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
pub(super) fn asked(path: &Toolpath, log: &Log) -> Vec<RunRule> {
    // A program that takes no notice of any has touches all the same.
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
    let rows = [
        modes(path, log),
        spindle(log, last),
        watched(path, log, last),
        missed(path, &touches),
        feeds(&touches),
        rapids(path, log, first, last),
        writes(log, last),
        one_write(log),
        plausible(log, last),
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
    match (on.is_empty(), off_first) {
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

/// A move is a way back from a touch, or goes straight up; none where that is not known.
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

fn watched(path: &Toolpath, log: &Log, last: usize) -> RunRule {
    // A contact stops such a move, and the program continues from there.
    let unnoticed = log
        .touches
        .iter()
        .filter(|touch| touch.index < last && touch.positions && !touch.asked);
    let (mut bad, mut unknown): (Vec<usize>, Vec<usize>) =
        (unnoticed.map(|touch| touch.line).collect(), Vec::new());
    for index in (0..last).filter(|index| path.kind[*index] != PROBE && !log.is_own(*index)) {
        match is_free(path, index) {
            Some(true) => {}
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
        (false, _) => {
            let message = text!(
                "Positioning moves before the last touch are not watched: a contact in them goes unnoticed. Write {instead}",
                instead.to_owned()
            );
            row(WATCHED, Some(false), message, bad)
        }
        (true, false) => row(
            WATCHED,
            None,
            text!(
                "Whether these moves only go up or back from a touch is not known: their places are not"
            ),
            unknown,
        ),
        (true, true) => row(
            WATCHED,
            Some(true),
            text!("Every positioning move is watched, goes straight up, or goes back from a touch"),
            Vec::new(),
        ),
    }
}

fn missed(path: &Toolpath, touches: &[&Touch]) -> RunRule {
    const RULE: &str = "missed-touch-stops";
    let bad: Vec<usize> = touches
        .iter()
        .filter(|touch| !touch.stops && !touch.asked)
        .map(|touch| touch.line)
        .collect();
    if bad.is_empty() {
        return row(
            RULE,
            Some(true),
            text!("Every touch is asked for its contact, or stops the program without one"),
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
        .filter(|touch| !touch.own_feed)
        .map(|touch| touch.line)
        .collect();
    match bad.is_empty() {
        true => row(
            "feeds-stated",
            Some(true),
            text!("Every probing block states its own feed"),
            bad,
        ),
        false => row(
            "feeds-stated",
            Some(false),
            text!("These probing blocks take the feed of a block before: write F in each of them"),
            bad,
        ),
    }
}

fn rapids(path: &Toolpath, log: &Log, first: usize, last: usize) -> RunRule {
    let tool = path.plane.axes()[2];
    // What is as high as the way to the first touch is above the part.
    let height = (0..=first)
        .map(|index| path.begin(index)[tool])
        .chain([path.end(first)[tool]])
        .fold(f64::NAN, f64::max);
    let (mut bad, mut unknown) = (Vec::new(), Vec::new());
    for index in (first..last).filter(|index| path.kind[*index] == RAPID && !log.is_own(*index)) {
        let line = path.line[index] as usize;
        match (is_free(path, index), path.end(index)[tool]) {
            (Some(true), _) => {}
            (Some(false), end) if end < height - 1e-6 => bad.push(line),
            (Some(false), _) if !height.is_nan() => {}
            _ => unknown.push(line),
        }
    }
    match (bad.is_empty(), unknown.is_empty()) {
        (false, _) => {
            let message = text!(
                "Rapids go down or across between the touches, lower than the program began: a rapid does not stop in time. Write G1 with a feed, watched"
            );
            row(NO_LOW_RAPID, Some(false), message, bad)
        }
        (true, false) => row(
            NO_LOW_RAPID,
            None,
            text!("How low these rapids go is not known"),
            unknown,
        ),
        (true, true) => row(
            NO_LOW_RAPID,
            Some(true),
            text!(
                "No rapid goes down or across between the touches, but at the height where the program began"
            ),
            Vec::new(),
        ),
    }
}

fn writes(log: &Log, last: usize) -> RunRule {
    let early: Vec<usize> = log
        .writes
        .iter()
        .filter(|(moves, _)| *moves <= last)
        .map(|(_, line)| *line)
        .collect();
    match (log.writes.is_empty(), early.is_empty()) {
        (true, _) => row(
            WRITE_LAST,
            Some(true),
            text!("The program writes no work offset"),
            early,
        ),
        (false, true) => row(
            WRITE_LAST,
            Some(true),
            text!("The work offset is written after the last touch"),
            early,
        ),
        (false, false) => row(
            WRITE_LAST,
            Some(false),
            text!(
                "A work offset is written before the last touch has succeeded: keep the values, and write once at the end"
            ),
            early,
        ),
    }
}

fn one_write(log: &Log) -> RunRule {
    let mut lines: Vec<usize> = log.writes.iter().map(|(_, line)| *line).collect();
    let all = lines.len();
    lines.sort_unstable();
    lines.dedup();
    match lines.len() == all {
        true => row(
            ONE_WRITE,
            Some(true),
            text!("No block writes a work offset twice"),
            Vec::new(),
        ),
        false => row(
            ONE_WRITE,
            Some(false),
            text!(
                "A block writes a work offset more than once: a value written twice is corrected twice"
            ),
            lines,
        ),
    }
}

/// Whether something is asked between the last touch and the write: what, a run does not know.
fn plausible(log: &Log, last: usize) -> RunRule {
    let asked = |moves: usize| {
        log.conditions
            .iter()
            .any(|(before, _)| (last + 1..=moves).contains(before))
    };
    let unasked: Vec<usize> = log
        .writes
        .iter()
        .filter(|(moves, _)| !asked(*moves))
        .map(|(_, line)| *line)
        .collect();
    match (log.writes.is_empty(), unasked.is_empty()) {
        (true, _) => row(
            PLAUSIBLE,
            Some(true),
            text!("The program writes no work offset"),
            unasked,
        ),
        (false, false) => row(
            PLAUSIBLE,
            Some(false),
            text!(
                "A work offset is written whatever was measured: compare the results with what they should be before, and stop with an alarm where they are off by too much"
            ),
            unasked,
        ),
        (false, true) => row(
            PLAUSIBLE,
            None,
            text!(
                "Conditions stand between the last touch and the write: whether they compare the results is not known"
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
            text!("Every wait says how long"),
            lines,
        ),
        false => row(
            "waits-stated",
            Some(false),
            text!(
                "These waits do not say how long: an alarm on one control, none at all on the next. Write the time behind G4"
            ),
            lines,
        ),
    }
}

fn left(log: &Log) -> RunRule {
    match (log.left_incremental, log.ends) {
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
