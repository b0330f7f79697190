//! grbl 1.1 and compatible controls: programs of moves without results.
//!
//! Sources: grbl's motion control and its interface document. grbl has no variables and no arithmetic: after each touch it reports `[PRB:x,y,z:1]` in machine
//! coordinates, and the sender has to do the rest.
//!
//! Watched positioning is a chain of `G38.3`: each ends at a contact, and the next probing move finds the probe triggered and raises alarm 4, whichever of the
//! four it is. A program needs no condition for that. A probing move without travel is error 33. The program does not know the start of the stylus, so the
//! approach to the first position is not watched. The proof refuses the rare job with a move that rounds to no travel.

mod read;
mod write;

use crate::control::inside::{self, Inside};
use crate::control::iso::writer::{Dialect, PLAIN, Writer, upwards};
use crate::control::moves::{self, MoveContext, Moves, each_piece};
use crate::control::rules;
use crate::control::shop::place;
use crate::control::{
    BASE, ORIENT, PostDef, Program, ProgramForm, Request, WRITE_OFFSET, check_length_axis,
    check_orientation, check_plain_moves, check_watched, orientation_line, write_summary,
};
use crate::form::Checker;
use crate::geom::Vec3;
use crate::num::decimal;
use crate::path::{Move, MovePurpose, STATED_RAPID, Touch};
use crate::text::{text, words};

pub static DEF: PostDef = GRBL_BASE;

/// grblHAL. Whether it has variables depends on its build; they are not used.
pub static GRBLHAL: PostDef = PostDef {
    key: "grblhal",
    title: "grblHAL",
    about: "the moves of grbl, in longer lines. Its variables depend on how it was built, and are not used.",
    ..LONG_LINE_BASE
};

/// FluidNC. Its variables hold machine coordinates; they are not used.
pub static FLUIDNC: PostDef = PostDef {
    key: "fluidnc",
    title: "FluidNC",
    about: "the moves of grbl, in longer lines. Its variables hold machine coordinates, and are not used.",
    ..LONG_LINE_BASE
};

/// Base of the grbl-compatible controls (grblHAL, FluidNC): the program of grbl with longer lines.
const LONG_LINE_BASE: PostDef = PostDef {
    dialect: &LONG,
    unsupported_rules: &[
        (
            WRITE_OFFSET,
            words!(
                "the program is that of grbl and uses no variables: let the sender read the [PRB:] reports and write the offset"
            ),
        ),
        (
            ORIENT,
            words!("the program is that of grbl and does not turn the spindle: turn it by hand"),
        ),
        (rules::CONTACT_LIFTS, CONTACT_STAYS),
        (place::ON_ALARM.key, CONTACT_STAYS),
        (
            rules::MISS_LIFTS,
            words!("G38.2 raises alarm 5 and stops at the current position: nothing after it runs"),
        ),
        (
            rules::LOW_START,
            words!(
                "the program is that of grbl and does not read the stylus position: it must be above the first position, as stated in the header"
            ),
        ),
        (rules::ONE_WRITE, WRITTEN_BY_THE_SENDER),
        (
            rules::PLAUSIBLE,
            words!(
                "the program is that of grbl and uses no variables: the operator must judge the results"
            ),
        ),
        (
            rules::TOLERANCE,
            words!(
                "the program is that of grbl and uses no variables: the operator must judge the results"
            ),
        ),
        (rules::RESTART, WRITTEN_BY_THE_SENDER),
        (rules::WRITE_LAST, WRITTEN_BY_THE_SENDER),
    ],
    ..GRBL_BASE
};

const CONTACT_STAYS: &str = words!(
    "after a contact the next probing move raises alarm 4, and the control stops at the current position: nothing after it runs"
);

const WRITTEN_BY_THE_SENDER: &str =
    words!("the program is that of grbl and uses no variables: the sender writes the work offset");

/// Base of grbl, grblHAL and FluidNC.
const GRBL_BASE: PostDef = PostDef {
    key: "grbl",
    title: "grbl",
    about: "the same moves, positioning watched by G38.3. grbl has no variables, so a program cannot compute or write anything; the page and the program say so.",
    extension: "nc",
    computes: false,
    // The operator connects the probe. Our choice [I].
    usual_lines: &[("probeOn", &["M0"])],
    watches_first: false,
    dialect: &DIALECT,
    unused: &[
        "orient",
        "report",
        "ask",
        "number",
        "setUp",
        "probeInput",
        "toolOffsets",
        "edition",
    ],
    unsupported_rules: &[
        (
            WRITE_OFFSET,
            words!(
                "{control} has no variables, so the program cannot compute an offset: let the sender read the [PRB:] reports and write it"
            ),
        ),
        (
            ORIENT,
            words!("{control} cannot turn a spindle to an angle: turn it by hand"),
        ),
        (rules::CONTACT_LIFTS, CONTACT_STAYS),
        (place::ON_ALARM.key, CONTACT_STAYS),
        (
            rules::MISS_LIFTS,
            words!("G38.2 raises alarm 5 and stops at the current position: nothing after it runs"),
        ),
        (
            rules::LOW_START,
            words!(
                "{control} cannot read the stylus position: it must be above the first position, as stated in the header"
            ),
        ),
        (
            rules::ONE_WRITE,
            words!("{control} has no variables: the sender writes the work offset"),
        ),
        (
            rules::PLAUSIBLE,
            words!("{control} has no variables: the operator must judge the results"),
        ),
        (
            rules::TOLERANCE,
            words!("{control} has no variables: the operator must judge the results"),
        ),
        (
            rules::RESTART,
            words!("{control} has no variables: the sender writes the work offset"),
        ),
        (
            rules::WRITE_LAST,
            words!("{control} has no variables: the sender writes the work offset"),
        ),
    ],
    rate,
    supports: |_, form| {
        if form == ProgramForm::Moves {
            Ok(())
        } else {
            Err("it has no native probing cycles")
        }
    },
    check,
    emit,
    read: Some(read::read),
    manual_offset_block: Some(write::typed),
    offset_has_rotation: false,
    inside: Some(Inside {
        end: "M2",
        ..inside::PLAIN
    }),
    ..BASE
};

const DIALECT: Dialect = Dialect {
    // grbl 1.1 accepts about 80 characters a line, the others 256.
    comment_width: 78,
    longest_block: 78,
    modes: "G40 G61 G80 G90",
    exact_stop: true,
    arcs: " G91.1",
    ..PLAIN
};

/// Dialect with lines of up to 256 characters.
const LONG: Dialect = Dialect {
    comment_width: 120,
    longest_block: 250,
    ..DIALECT
};

fn check(request: &Request<'_>, checker: &mut Checker) {
    check_plain_moves(request, checker);
    check_length_axis(request, checker);
    check_orientation(request, checker);
    checker.info(
        "no-results-in-program",
        "control.post",
        text!("The program computes nothing: {control} reports [PRB:x,y,z:1] in machine coordinates after each touch; the results shown are what \
         those points give", request.post.title.to_owned()),
    );
    check_watched(request, checker);
    if request.protected && !request.path.moves.is_empty() && request.path.start.is_none() {
        let message = text!(
            "The probe is not watched on the way to the first position: {control} rejects a probing move with no travel, and the program does not know where the stylus starts",
            request.post.title.to_owned()
        );
        checker.info("approach-not-watched", "control.protection", message);
    }
    if !request.protected
        && request
            .path
            .moves
            .iter()
            .any(|m| request.feeds.rate(m.feed).is_none())
    {
        checker.info(
            "rapid-at-feed",
            "feeds",
            text!("Positioning is not watched: a rapid that moves down runs at the feed of the touches"),
        );
    }
}

/// Whether a move is watched: positioning from a known position.
fn is_watched(request: &Request<'_>, from: Option<Vec3>, step: &Move) -> bool {
    request.protected && step.purpose == MovePurpose::Position && from.is_some()
}

/// Feed of a move. Watched moves have one. An unwatched rapid downwards runs at the feed of the touches; so does an arc, which needs a feed.
fn rate(request: &Request<'_>, from: Option<Vec3>, step: &Move) -> Option<f64> {
    let stated = request.feeds.rate(step.feed);
    if is_watched(request, from, step) {
        return Some(stated.unwrap_or(STATED_RAPID));
    }
    let careful = step.arc.is_some() || upwards(request, from, step.to) < 0;
    stated.or(careful.then_some(request.feeds.work))
}

fn emit(request: &Request<'_>) -> Program {
    moves::write(request, &mut Grbl { request })
}

/// The program of one request.
struct Grbl<'a> {
    request: &'a Request<'a>,
}

impl Moves for Grbl<'_> {
    fn begin(&mut self, w: &mut Writer<'_>) {
        let path = self.request.path;
        let reported = if path.touches.is_empty() {
            ""
        } else {
            ": each touch is reported as PRB in machine coordinates"
        };
        w.header(&format!(
            "{}{reported}",
            write_summary::sentence(self.request)
        ));
        if let (Some(first), None) = (path.moves.first(), path.start) {
            let (height, place) = (w.height_word(first.to), w.place_words(first.to));
            w.comment(&format!("The stylus must stand at {height} or higher before the start: the first block moves in the plane at that height, the second \
                 down to {place}. That way must be free"));
        }
        w.comment(match (self.request.protected, path.start) {
            (false, _) => "Positioning moves are NOT watched: a contact there goes unnoticed",
            (true, None) => {
                "Positioning is G38.3: a contact ends the move, and the next probing move raises alarm 4. Only the way to the first place is NOT watched"
            }
            (true, Some(_)) => "Positioning is G38.3: a contact ends the move, and the next probing move raises alarm 4",
        });
        w.comment(&match self.request.orient {
            Some(angle) => format!(
                "Turn the spindle to {} degrees by hand first: the probe must be calibrated at that angle",
                decimal(angle, 3)
            ),
            None => orientation_line(self.request),
        });
        w.says_job();
        w.shop(&place::HEAD);
        w.shop(&place::PROBE_ON);
        w.modes();
        w.line("M5 M9");
    }

    fn approach(&mut self, w: &mut Writer<'_>, first: &Move) {
        approach(w, self.request, first);
    }

    fn position(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>) {
        w.makes_move();
        if !is_watched(self.request, step.from, step.planned) {
            return plain(w, self.request, step);
        }
        let rate = rate(self.request, step.from, step.planned);
        each_piece(self.request, step, |_, to| {
            w.straight("G38.3", to, false, rate)
        });
    }

    fn touch(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>, touch: &Touch) {
        w.makes_move();
        w.touch("G38.2", step.planned, touch, false, self.request.feeds.work);
    }

    fn retract(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>) {
        w.makes_move();
        plain(w, self.request, step);
    }

    fn end(&mut self, w: &mut Writer<'_>) {
        w.line("M2");
    }
}

/// Approach to the first position: in the plane at the current height, then down. grbl cannot read that height.
fn approach(w: &mut Writer<'_>, request: &Request<'_>, step: &Move) {
    let stated = request.feeds.rate(step.feed);
    let feed = |w: &Writer<'_>, rate: Option<f64>| match rate {
        Some(rate) => ("G1", format!(" F{}", w.number(rate))),
        None => ("G0", String::new()),
    };
    let (word, rate) = feed(w, stated);
    let across = w.goes_in_plane(step.to);
    w.line(&format!("{word}{across}{rate}"));
    w.makes_move();
    let (word, rate) = feed(w, stated.or(Some(request.feeds.work)));
    let down = w.goes_along_tool(step.to);
    w.line(&format!("{word}{down}{rate}"));
}

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
        false,
        rate,
    );
}
