//! A program of moves, walked once: whatever differs between controls is a hook of [`Moves`].

use crate::control::iso::registers::{When, needed_touches};
use crate::control::iso::writer::{Writer, comes_from_anywhere, pieces};
use crate::control::{Program, Request};
use crate::formula::{Datum, Formula, Question, Used};
use crate::geom::Vec3;
use crate::num::count;
use crate::path::{Move, Path, Purpose, Touch};

/// A move of the path, and its place in it.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// From 0.
    pub index: usize,
    /// The move.
    pub step: &'a Move,
    /// Where the ball is before it, once that is known.
    pub from: Option<Vec3>,
}

/// What a control writes of its own. The hooks are called in the order of the program.
pub trait Moves {
    /// Everything before the first move: the header, checks of the control's state, modes.
    fn begin(&mut self, w: &mut Writer<'_>);

    /// To the first place, from wherever the stylus stands.
    fn approach(&mut self, w: &mut Writer<'_>, first: &Move);

    /// A positioning move from a known place.
    fn position(&mut self, w: &mut Writer<'_>, step: Step<'_>);

    /// A touch, and what a miss leads to.
    fn touch(&mut self, w: &mut Writer<'_>, step: Step<'_>, touch: &Touch);

    /// How the control keeps the coordinate `axis` of a sample, and what it is called there: put into the empty texts of `kept`. False
    /// where it keeps none.
    fn keeps(&self, sample: usize, axis: usize, kept: &mut Kept) -> bool;

    /// The way back from a touch.
    fn back(&mut self, w: &mut Writer<'_>, step: Step<'_>);

    /// One assignment of the formula.
    fn assign(&mut self, w: &mut Writer<'_>, formula: &Formula, index: usize);

    /// Brings the results where they are read.
    fn results(&mut self, w: &mut Writer<'_>, formula: &Formula);

    /// Asks whether a result is plausible: where it is not, a program that writes stops with an alarm, any other says so.
    fn ask(&mut self, w: &mut Writer<'_>, formula: &Formula, question: &Question);

    /// The one write of a work offset.
    fn write(&mut self, w: &mut Writer<'_>, formula: &Formula, number: i32, datum: &Datum);

    /// Shows the results to whoever stands at the control.
    fn report(&mut self, w: &mut Writer<'_>, formula: &Formula);

    /// The end, and the exits after it.
    fn end(&mut self, w: &mut Writer<'_>);
}

/// Where a control keeps a coordinate of a trigger.
#[derive(Clone, Debug, Default)]
pub struct Kept {
    /// The variable it is kept in.
    pub variable: String,
    /// What the control has it in after a touch.
    pub source: String,
    /// What stands around a sum that is divided.
    pub group: (&'static str, &'static str),
    /// What stands around a value of more than one term.
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
    let mut kept = Kept::default();
    hooks.begin(&mut w);
    let needed = if request.post.when == When::AtOnce { needed_touches(path) } else { Vec::new() };
    let (mut made, mut computed) = (0, 0);
    let mut from = path.start;
    for (index, step) in path.moves.iter().enumerate() {
        let place = Step { index, step, from };
        match step.purpose {
            Purpose::Position if comes_from_anywhere(request, index, step) => hooks.approach(&mut w, step),
            Purpose::Position => hooks.position(&mut w, place),
            Purpose::Touch(k) => {
                hooks.touch(&mut w, place, &path.touches[k]);
                latch(&mut w, path, hooks, (k, &used), &mut kept);
                made += 1;
                while needed.get(computed).is_some_and(|needed| *needed <= made) {
                    hooks.assign(&mut w, formula, computed);
                    computed += 1;
                }
            }
            Purpose::Back(_) => hooks.back(&mut w, place),
        }
        from = Some(step.to);
    }
    for index in computed..formula.assignments.len() {
        hooks.assign(&mut w, formula, index);
    }
    hooks.results(&mut w, formula);
    for question in &request.questions() {
        hooks.ask(&mut w, formula, question);
    }
    if let (Some(number), Some(datum)) = (request.work_offset, &formula.datum)
        && datum.writes()
    {
        hooks.write(&mut w, formula, number, datum);
    }
    hooks.report(&mut w, formula);
    hooks.end(&mut w);
    w.finish()
}

/// Keeps what the formula needs of a touch. Repeated touches of a sample are added up, and divided after the last one.
fn latch(w: &mut Writer<'_>, path: &Path, hooks: &dyn Moves, (k, used): (usize, &Used), kept: &mut Kept) {
    let sample = path.samples(k);
    for axis in (0..3).filter(|&axis| used.has(sample.index, axis)) {
        [&mut kept.variable, &mut kept.source, &mut kept.comment].into_iter().for_each(|text| text.clear());
        if !hooks.keeps(sample.index, axis, kept) {
            continue;
        }
        let Kept { variable, source, group: (left, right), whole: (open, close), comment } = &*kept;
        match (sample.first, sample.last) {
            (true, _) => w.parts(&[variable, "=", source, comment]),
            (false, false) => w.parts(&[variable, "=", open, variable, "+", source, close]),
            (false, true) => {
                w.parts(&[variable, "=", open, left, variable, "+", source, right, "/", &count(sample.count), close]);
            }
        }
    }
}

/// The straight pieces of a positioning move, each with where it begins.
pub fn each_piece(request: &Request<'_>, place: Step<'_>, mut piece: impl FnMut(Option<Vec3>, Vec3)) {
    let mut from = place.from;
    for to in pieces(request, place.step, place.from) {
        piece(from, to);
        from = Some(to);
    }
}
