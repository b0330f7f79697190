//! Controls whose programs consist of calls of Renishaw's macros: Mazak, Brother, Hurco, Okuma.
//!
//! Sources: the posts that Autodesk publishes for these controls, for Okuma a post derived from one [S]: calls with their letters, work offsets, outputs,
//! units, beginning and end of a program. Ours, and marked [I] in the docs: that the macros move like those for Haas, 9821, 9822 and 9834 on a Brother and an
//! Okuma, and the variables that save results.

use crate::control::inside::{self, Inside};
use crate::control::iso::writer::{self, Dialect};
use crate::control::native_run::{CycleLinking, NativeCycles};
use crate::control::renishaw::post::{self, CALLS, Calls, variable};
use crate::control::renishaw::{LINKING, cycles};
use crate::control::{BASE, ORIENT, PostDef, ProgramForm, Request, number, offsets};
use crate::form::Checker;
use crate::path::{FeatureKind, Stored};
use crate::text::{text, words};

/// Macros that no source shows on a Brother or an Okuma.
const NOT_SEEN: &[u32] = &[9821, 9822, 9834, 9835];

/// Mazak, programs in EIA/ISO.
pub(super) static MAZAK: PostDef = PostDef {
    key: "mazak",
    title: "Mazak (EIA/ISO)",
    about: "calls of Renishaw's macros P98xx, with their own path. Not verified on a control.",
    extension: "eia",
    emit: |request| post::emit(request, &CALLS),
    ..CALLER
};

/// Brother Speedio, CNC-C00 and related controls.
pub(super) static BROTHER: PostDef = PostDef {
    key: "brother",
    title: "Brother Speedio",
    about: "calls of Renishaw's macros, which have the numbers P88xx there. Its programs do not state units: the control must be set to those of the job. Not verified on a control.",
    unused: &["number", "setUp", "probeInput", "toolOffsets"],
    dialect: &Dialect {
        units: ("", ""),
        ..DIALECT
    },
    check: |request, checker| {
        post::check(request, &BROTHER_CALLS, checker);
        let unit = if request.scale == 1.0 { "mm" } else { "inch" };
        let message = text!(
            "Programs of this control do not state their units, which are a setting of the machine: it must be set to {unit}",
            unit.to_owned()
        );
        checker.warning("units-not-stated", "units", message);
    },
    emit: |request| post::emit(request, &BROTHER_CALLS),
    own: Some(&BROTHER_OWN),
    ..CALLER
};

/// Hurco WinMax, programs in ISNC.
pub(super) static HURCO: PostDef = PostDef {
    key: "hurco",
    title: "Hurco WinMax (ISNC)",
    about: "calls of Renishaw's macros P98xx; the control switches the probe automatically. Not verified on a control.",
    extension: "hnc",
    work_offsets: offsets::STANDARD,
    supports: |subject, form| match (subject, form) {
        (FeatureKind::Switch, ProgramForm::Cycle) => Err(words!(
            "the control switches the probe automatically at the tool change"
        )),
        _ => supports(subject, form),
    },
    emit: |request| post::emit(request, &HURCO_CALLS),
    own: Some(&HURCO_OWN),
    ..CALLER
};

/// Okuma OSP.
pub(super) static OKUMA: PostDef = PostDef {
    key: "okuma",
    title: "Okuma OSP",
    about: "calls of Renishaw's macros as CALL O98xx, with results in VS75 and following. Not verified on a control.",
    extension: "MIN",
    // Numbers that PS accepts.
    work_offsets: 100,
    work_offset_word: |n| format!("G15 H{n}"),
    supports: |subject, form| match (subject, form) {
        (FeatureKind::Wall, ProgramForm::Cycle) => Err(words!(
            "two single touches give the angle of a wall, and no source shows how this control computes beside these calls"
        )),
        _ => supports(subject, form),
    },
    check: |request, checker| checked(request, &OKUMA_CALLS, checker),
    emit: |request| post::emit(request, &OKUMA_CALLS),
    own: Some(&OKUMA_OWN),
    inside: Some(Inside {
        end: "M2",
        ..inside::PLAIN
    }),
    ..CALLER
};

/// Base of these controls.
const CALLER: PostDef = PostDef {
    extension: "NC",
    unused: &["setUp", "probeInput", "toolOffsets"],
    work_offsets: offsets::STANDARD + offsets::MORE,
    work_offset_word: offsets::word,
    computes: false,
    unsupported_rules: &[(
        ORIENT,
        words!(
            "no source says how a program of {control} turns the spindle to an angle: turn it before"
        ),
    )],
    dialect: &DIALECT,
    name: |name| crate::control::comment_text(name).to_ascii_uppercase(),
    rate: |request, _, step| request.feeds.rate(step.feed),
    supports,
    check: |request, checker| checked(request, &CALLS, checker),
    own: Some(&OWN),
    inside: Some(inside::NUMBERED),
    offset_has_rotation: false,
    ..BASE
};

const DIALECT: Dialect = Dialect {
    points: true,
    capitals: true,
    ..writer::PLAIN
};

static BROTHER_CALLS: Calls = Calls {
    lower: 1000,
    tape: None,
    not_seen: NOT_SEEN,
    ..CALLS
};
static HURCO_CALLS: Calls = Calls {
    switches: false,
    ..CALLS
};
static OKUMA_CALLS: Calls = Calls {
    call: "CALL O",
    letter: ("P", "="),
    tape: None,
    end: "M2",
    length: "G56",
    numbered_alarms: false,
    not_seen: NOT_SEEN,
    ..CALLS
};

static OWN: NativeCycles = cycles(offsets::letter, |stored| variable(135, stored));
static BROTHER_OWN: NativeCycles = NativeCycles {
    word: |number, letter| format!("P{} {letter}", number.saturating_sub(1000)),
    ..cycles(offsets::letter, |stored| variable(135, stored))
};
static HURCO_OWN: NativeCycles = cycles(offsets::letter, |stored| variable(185, stored));
static OKUMA_OWN: NativeCycles = NativeCycles {
    // No source shows its expressions and jumps beside these calls.
    several: CycleLinking {
        computes: false,
        ..LINKING
    },
    word: |number, letter| format!("O{number} P{letter}"),
    ..cycles(f64::from, |stored| match stored {
        Stored::Output(output) => format!("VS{}", 75 + output),
        Stored::Kept(variable) => format!("VC{variable}"),
    })
};

fn supports(subject: FeatureKind, form: ProgramForm) -> Result<(), &'static str> {
    match (subject, form) {
        (_, ProgramForm::Moves) => Err(words!(
            "no source documents how the control answers a program that reads modes, tool length and contacts"
        )),
        (FeatureKind::Action, ProgramForm::Cycle) => {
            Err(words!("a line for the control is not a cycle"))
        }
        _ => Ok(()),
    }
}

fn checked(request: &Request<'_>, calls: &Calls, checker: &mut Checker) {
    post::check(request, calls, checker);
    number::check_macros(request, checker);
}
