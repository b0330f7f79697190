//! Writes a program of moves in one pass. [`Moves`] has a hook for every difference between controls.

use std::ops::Range;

use crate::control::iso::registers::{ComputeTiming, needed_touches};
use crate::control::iso::writer::{Writer, pieces, start_unknown};
use crate::control::shop::place;
use crate::control::{Program, Request};
use crate::formula::{Formula, OffsetCorrection, ResultCheck, UsedTriggers};
use crate::geom::Vec3;
use crate::num::format_count;
use crate::path::{Move, MovePurpose, RepeatIndex, ShiftTerm, Touch};

/// A move of the path, with its index and start.
#[derive(Clone, Copy, Debug)]
pub struct MoveContext<'a> {
    /// Index in the path, from 0.
    pub index: usize,
    pub planned: &'a Move,
    /// Ball centre before the move, if it is known.
    pub from: Option<Vec3>,
}

/// Hooks of a control, called in the order of the program.
pub trait Moves {
    /// Everything before the first move: the header, the shop's lines for the head and the probe, checks of the control's state, modes.
    fn begin(&mut self, w: &mut Writer<'_>);

    /// Moves up from below the stated start, if the first move goes across.
    fn rise(&mut self, _w: &mut Writer<'_>) {}

    /// Moves of each native cycle. Native cycles also compute and write the results.
    fn own_cycles(&self) -> Vec<Range<usize>> {
        Vec::new()
    }

    /// Blocks between native cycles that make no move, before this move or after the last one: saved results, arithmetic.
    fn between(&mut self, _w: &mut Writer<'_>, _formula: &Formula, _index: usize) {}

    /// Blocks that call a native cycle.
    fn call(&self, _which: usize, _w: &mut Writer<'_>) {}

    /// Approach to the first position from any position of the stylus.
    fn approach(&mut self, w: &mut Writer<'_>, first: &Move);

    /// A positioning move from a known position.
    fn position(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>);

    /// A touch, and the reaction to a miss.
    fn touch(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>, touch: &Touch);

    /// Storage of coordinate `axis` of a sample, and its name there, written into the empty texts of `stored`. False if the control stores nothing.
    fn stores(&self, _sample: usize, _axis: usize, _stored: &mut StoredCoordinate) -> bool {
        false
    }

    /// Term added to a position that these variables shift, on a control that computes. `scale` is mm in a unit of the program.
    fn shift(&self, _formula: &Formula, _terms: &[ShiftTerm], _scale: f64) -> String {
        String::new()
    }

    /// Emits the retract after a touch.
    fn retract(&mut self, w: &mut Writer<'_>, step: MoveContext<'_>);

    /// One assignment of the formula. This hook and those up to `report` do nothing on a control that cannot compute.
    fn assign(&mut self, _w: &mut Writer<'_>, _formula: &Formula, _index: usize) {}

    /// Copies the results to where they are read.
    fn results(&mut self, _w: &mut Writer<'_>, _formula: &Formula) {}

    /// Emits a plausibility check. If it fails, a program that writes stops with an alarm; any other one shows a message.
    fn check_result(&mut self, _w: &mut Writer<'_>, _formula: &Formula, _question: &ResultCheck) {}

    /// Shows the results and waits for the operator: if a check fails, or always without checks. Only on a control that can write a work offset.
    fn ask(&mut self, _w: &mut Writer<'_>, _formula: &Formula, _checks: &[ResultCheck]) {}

    /// The single write of a work offset, and the corrections of tools.
    fn write(&mut self, _w: &mut Writer<'_>, _formula: &Formula, _datum: Option<WrittenDatum<'_>>) {
    }

    /// Shows the results to the operator; after native cycles as well.
    fn report(&mut self, _w: &mut Writer<'_>, _formula: &Formula) {}

    /// The end of the program, and the exits after it.
    fn end(&mut self, w: &mut Writer<'_>);
}

/// Number of a work offset, and what it gets.
pub type WrittenDatum<'a> = (i32, &'a OffsetCorrection);

/// Storage of one coordinate of a trigger.
#[derive(Clone, Debug, Default)]
pub struct StoredCoordinate {
    /// Variable in which it is stored.
    pub variable: String,
    /// Variable of the control that holds it after a touch.
    pub source: String,
    /// Brackets around a sum that is divided.
    pub group: (&'static str, &'static str),
    /// Brackets around a value with several terms.
    pub whole: (&'static str, &'static str),
    /// A comment after the block.
    pub comment: String,
}

/// Writes the program of a path: header, moves, arithmetic, one write, end.
pub fn write(request: &Request<'_>, hooks: &mut dyn Moves) -> Program {
    let path = request.path;
    let formula = &path.formula;
    let mut w = Writer::new(request);
    let used = formula.used();
    let mut stored = StoredCoordinate::default();
    hooks.begin(&mut w);
    w.shop(&place::BEFORE_FIRST_MOVE);
    hooks.rise(&mut w);
    let own = hooks.own_cycles();
    let needed = if request.when() == ComputeTiming::AtOnce {
        needed_touches(path)
    } else {
        Vec::new()
    };
    let (mut made, mut computed) = (0, 0);
    let samples = path.samples();
    let mut from = path.start;
    for (index, step) in path.moves.iter().enumerate() {
        let place = MoveContext {
            index,
            planned: step,
            from,
        };
        w.names_cycle(index);
        hooks.between(&mut w, formula, index);
        if let Some(begins) = path.begins_member(index).filter(|_| own.is_empty()) {
            for question in path.asked_before(begins, &request.limits) {
                hooks.check_result(&mut w, formula, &question);
            }
        }
        if !path.shifts.is_empty() {
            w.shifts_by(
                path.shifts(index)
                    .each_ref()
                    .map(|terms| hooks.shift(formula, terms, request.scale)),
            );
        }
        match step.purpose {
            _ if own.iter().any(|own| own.contains(&index)) => {
                if let Some(which) = own.iter().position(|own| own.start == index) {
                    hooks.call(which, &mut w);
                }
                w.leaves_move();
                w.forgets_place();
            }
            MovePurpose::Position if start_unknown(request, index, step) => {
                hooks.approach(&mut w, step)
            }
            MovePurpose::Position => hooks.position(&mut w, place),
            MovePurpose::Touch(k) => {
                hooks.touch(&mut w, place, &path.touches[k]);
                latch(&mut w, hooks, (&samples[k], &used), &mut stored);
                made += 1;
                while needed.get(computed).is_some_and(|needed| *needed <= made) {
                    hooks.assign(&mut w, formula, computed);
                    computed += 1;
                }
            }
            // Only in native cycles.
            MovePurpose::Search(_) => w.leaves_move(),
            MovePurpose::Retract(_) => hooks.retract(&mut w, place),
        }
        from = Some(step.to);
    }
    match own.first() {
        None => conclude(&mut w, request, hooks, computed),
        Some(own) => {
            // If all points are given, a cycle computes without a move.
            if own.start == path.moves.len() {
                hooks.call(0, &mut w);
            }
            hooks.between(&mut w, formula, path.moves.len());
            hooks.report(&mut w, formula);
        }
    }
    w.shop(&place::PROBE_OFF);
    w.shop(&place::FOOT);
    hooks.end(&mut w);
    w.finish()
}

/// After the touches: the rest of the arithmetic, the checks, the single write, the results.
fn conclude(w: &mut Writer<'_>, request: &Request<'_>, hooks: &mut dyn Moves, computed: usize) {
    let formula = &request.path.formula;
    for index in computed..formula.assignments.len() {
        hooks.assign(w, formula, index);
    }
    hooks.results(w, formula);
    for question in &request.questions() {
        hooks.check_result(w, formula, question);
    }
    if request.writes_tables() {
        if request.asks() {
            hooks.ask(w, formula, &request.ask_checks());
        }
        w.shop(&place::BEFORE_WRITE);
        let datum = formula.datum.as_ref().filter(|_| request.writes_offset());
        hooks.write(w, formula, request.work_offset.zip(datum));
    }
    hooks.report(w, formula);
}

/// Stores the coordinates of a touch that the formula needs. Repeated touches of a sample are added up, and divided after the last one.
fn latch(
    w: &mut Writer<'_>,
    hooks: &dyn Moves,
    (sample, used): (&RepeatIndex, &UsedTriggers),
    stored: &mut StoredCoordinate,
) {
    for axis in (0..3).filter(|&axis| used.has(sample.index, axis)) {
        [
            &mut stored.variable,
            &mut stored.source,
            &mut stored.comment,
        ]
        .into_iter()
        .for_each(|text| text.clear());
        if !hooks.stores(sample.index, axis, stored) {
            continue;
        }
        let StoredCoordinate {
            variable,
            source,
            group: (left, right),
            whole: (open, close),
            comment,
        } = &*stored;
        match (sample.first, sample.last) {
            (true, _) => w.parts(&[variable, "=", source, comment]),
            (false, false) => w.parts(&[variable, "=", open, variable, "+", source, close]),
            (false, true) => {
                w.parts(&[
                    variable,
                    "=",
                    open,
                    left,
                    variable,
                    "+",
                    source,
                    right,
                    "/",
                    &format_count(sample.count),
                    close,
                ]);
            }
        }
    }
}

/// Straight pieces of a positioning move, each with its start.
pub fn each_piece(
    request: &Request<'_>,
    place: MoveContext<'_>,
    mut piece: impl FnMut(Option<Vec3>, Vec3),
) {
    let mut from = place.from;
    for to in pieces(request, place.planned, place.from) {
        piece(from, to);
        from = Some(to);
    }
}
