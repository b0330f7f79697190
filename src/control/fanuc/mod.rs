//! Fanuc 30i and compatible controls, and Haas NGC: plain moves with the skip function G31.
//!
//! Sources, where there are any: posts for G31 inspection on Mazak, Fanuc and Haas, and the behaviour of the Renishaw macros. G31 moves until the skip signal
//! or to its end. #5061… hold the ball centre at the skip or, if there was none, the end; this is derived from the posts' comparison and stated by the Classic
//! manual of a Haas. So every probing move is followed by a comparison of the two: a touch must have ended before its end, a positioning move must not. On a
//! Haas M78 and M79 in the block of G31 raise the alarm in the control; the comparison follows, too.
//! #5043 and #5063 include the tool length, except on Fanucs with parameter 6014 bit 4 set. So the program takes the length from the tool table, and the first
//! move with a known end in Z shows which case it is. A macro statement is evaluated while the motion before it still runs: a block separates the two.
//!
//! Ours, and marked [I] in the docs: the comparison with 0.05 mm, the lift before the alarm, the check of the length. Recalled and not verified on a control
//! [R]: the modal values #4006, #4011, #4016 and #4120 for units, scaling, rotation and the last T word, #3026 for the tool in the
//! spindle of a Haas, IF … THEN, common variables up to #149, #5221… as the origin that a program
//! may write.

mod check;
mod flavour;
mod read;
mod skip;

use self::check::{check, check_haas_feeds};
use self::flavour::{Flavour, PLAIN, WITH_ALARMS};
use self::skip::{IN_POSITION, emit};
use crate::control::corrections::{ToolOffsets, ToolTable};
use crate::control::inside;
use crate::control::iso::registers::ComputeTiming;
use crate::control::iso::writer::{self, Dialect};
use crate::control::native_run::NativeCycles;
use crate::control::renishaw::cycles;
use crate::control::renishaw::post::{self, CALLS, Calls, variable};
use crate::control::{
    BASE, PostDef, Program, ProgramForm, Request, feed_rate, number, offsets, rules,
};
use crate::form::Checker;
use crate::path::{FeatureKind, Move};
use crate::text::words;

/// Fanuc 30i, 31i, 32i, 0i-F.
pub static FANUC: PostDef = PostDef {
    key: "fanuc",
    title: "Fanuc 30i / 0i-F",
    about: "moves with the skip function G31, each checked against its end; after a contact the probe lifts before the alarm; results in common variables, the origin written at the end. Or calls of Renishaw's macros, with their own path. Not verified on a control.",
    // G54.1 P1 to P48 are an option of the control.
    work_offsets: offsets::STANDARD + offsets::MORE,
    work_offset_word: offsets::word,
    emit: |request| written(request, &PLAIN, &CALLS),
    read: Some(read::fanuc),
    // G28 to the top of the axis is recalled [R].
    usual_lines: &[
        (
            "head",
            &["G91 G28 {axis}0.", "G90", "T{tool} M6", "G43 H{tool}"],
        ),
        ("foot", &["G91 G28 {axis}0.", "G90"]),
    ],
    tools: Some(&ToolTable {
        tables: |offsets| match offsets {
            ToolOffsets::Unknown => None,
            ToolOffsets::Radius | ToolOffsets::Diameter => Some([10_000, 12_000, 999]),
            ToolOffsets::RadiusInMemoryA | ToolOffsets::DiameterInMemoryA => {
                Some([2000, 2000, 200])
            }
        },
        ..TOOLS
    }),
    own: Some(&OWN),
    ..KIN
};

/// Haas Next Generation Control.
pub static HAAS: PostDef = PostDef {
    key: "haas",
    title: "Haas NGC",
    about: "the same with M78 and M79, which raise the alarm in the control itself; Renishaw's macros likewise. Not verified on a control.",
    work_offsets: offsets::STANDARD + 99,
    work_offset_word: |n| match n {
        ..=offsets::STANDARD => offsets::word(n),
        _ => format!("G154 P{}", n - offsets::STANDARD),
    },
    unsupported_rules: &[
        (
            rules::CONTACT_LIFTS,
            words!(
                "M78 raises the alarm in the control itself, at the current position: nothing after it runs"
            ),
        ),
        (
            rules::MISS_LIFTS,
            words!(
                "M79 raises the alarm in the control itself, at the current position: nothing after it runs"
            ),
        ),
    ],
    rate: |request, _, step| rate(request, step, WITH_ALARMS.rapid),
    check: |request, checker| {
        checked(request, checker);
        if request.form == ProgramForm::Moves {
            check_haas_feeds(request, checker);
        }
    },
    emit: |request| written(request, &WITH_ALARMS, &HAAS_CALLS),
    read: Some(read::haas),
    // 0 as the top of the axis is recalled [R].
    usual_lines: &[
        ("head", &["G53 G0 {axis}0.", "T{tool} M6", "G43 H{tool}"]),
        ("foot", &["G53 G0 {axis}0."]),
    ],
    tools: Some(&ToolTable {
        tables: |offsets| match offsets {
            ToolOffsets::Radius | ToolOffsets::Diameter => Some([2200, 2600, 200]),
            _ => None,
        },
        ..TOOLS
    }),
    own: Some(&HAAS_OWN),
    ..KIN
};

/// Registers of tools, without their tables: variables, numbered from that of the table; #500 to #999 keep their values.
const TOOLS: ToolTable = ToolTable {
    tables: |_| None,
    register: |register| format!("#{}", register.table + register.tool),
    kept: |number| format!("#{number}"),
    keeps: (500, 998),
};

/// Base of Fanuc and Haas.
const KIN: PostDef = PostDef {
    extension: "nc",
    unused: &["setUp", "probeInput"],
    unused_by_cycles: &[
        "control.protection",
        "control.toolOffsets",
        "feeds.work",
        "feeds.retract",
    ],
    uses_tool: |form| form == ProgramForm::Moves,
    when: ComputeTiming::AtOnce,
    nearest_trigger: IN_POSITION,
    shortest_probe: SHORTEST_PROBE,
    constant_error: 2e-8,
    dialect: &DIALECT,
    name: |name| crate::control::comment_text(name).to_ascii_uppercase(),
    rate: |request, _, step| rate(request, step, PLAIN.rapid),
    supports: serves,
    check: checked,
    emit: |request| emit(request, &PLAIN),
    offset_has_rotation: false,
    inside: Some(inside::NUMBERED),
    ..BASE
};

const DIALECT: Dialect = Dialect {
    points: true,
    capitals: true,
    ..writer::PLAIN
};

/// Shortest probing move, mm. In a shorter one a contact could not be distinguished from its end, so positioning is plain. Our choice.
const SHORTEST_PROBE: f64 = 0.2;

/// Reports what moves or macros cannot do for this request.
fn checked(request: &Request<'_>, checker: &mut Checker) {
    match request.form {
        ProgramForm::Moves => check(request, checker),
        ProgramForm::Cycle => {
            // A Haas uses the same names.
            post::check(request, &CALLS, checker);
            number::check(request, checker);
        }
    }
}

/// The program, in moves or with macros.
fn written(request: &Request<'_>, flavour: &'static Flavour, calls: &Calls) -> Program {
    if request.path.calls.is_some() {
        post::emit(request, calls)
    } else {
        emit(request, flavour)
    }
}

/// Work offsets and results of the macros: S154.01 for G154 P1 of a Haas [S].
static OWN: NativeCycles = cycles(offsets::letter, |stored| variable(135, stored));
static HAAS_OWN: NativeCycles = cycles(
    |n| {
        if n <= offsets::STANDARD {
            f64::from(n)
        } else {
            154.0 + f64::from(n - offsets::STANDARD) / 100.0
        }
    },
    |stored| variable(185, stored),
);
static HAAS_CALLS: Calls = Calls {
    angle: WITH_ALARMS.angle,
    ..CALLS
};

/// Variables: 100 is the length; results and intermediate values follow; 148 is a spare value, 149 the number of the move.
const FIRST: usize = 100;
const LAST: usize = 147;

/// Number of axes whose origin may change.
const CHANGES: usize = 3;

fn serves(subject: FeatureKind, form: ProgramForm) -> Result<(), &'static str> {
    match (subject, form) {
        (_, ProgramForm::Moves) => Ok(()),
        (FeatureKind::Action, ProgramForm::Cycle) => {
            Err("a line for the control is not a cycle: the moves form states the modes and ends")
        }
        _ => Ok(()),
    }
}

/// Feed of a move, mm/min. All moves but the shortest are watched.
fn rate(request: &Request<'_>, step: &Move, rapid: f64) -> Option<f64> {
    // The macros have their own feeds, and true rapids.
    if request.path.calls.is_some() {
        return request.feeds.rate(step.feed);
    }
    request
        .feeds
        .rate(step.feed)
        .or_else(|| feed_rate(request, None, step).map(|_| rapid))
}

/// Variable with the X origin of a work offset; Y and Z follow. Offsets are twenty apart: G54 to G59 from 5221 on, later ones from `more` on: G54.1 P1 of a
/// Fanuc from 7001 [R], G154 P1 of a Haas from 14001.
fn origin(number: i32, more: usize) -> usize {
    let (number, standard) = (
        usize::try_from(number).unwrap_or(1),
        offsets::STANDARD as usize,
    );
    if number <= standard {
        5201 + 20 * number
    } else {
        more + 20 * (number - standard - 1)
    }
}
