//! The relations of a set-up: what is computed of the results of its cycles.

use std::ops::Range;

use crate::form::{Checker, Value, printable};
use crate::formula::{self, Datum, Formula, Operand, Relation, ResultDef};
use crate::job::cycles::{LONGEST_NAME, MOST_CYCLES, RELATIONS, is_name};
use crate::job::judge::{judge, report_judged};
use crate::job::planned::Planned;
use crate::job::rows::{ResultRow, result_row};
use crate::num::tidy;
use crate::path::{Measuring, Path};
use crate::text::{Text, text};

/// Nominal places this near to each other have no direction, mm.
const APART: f64 = 0.1;

/// What can be related: the cycles and relations that are known so far, in the formula of all.
#[derive(Debug)]
struct Known<'a> {
    formula: &'a Formula,
    measuring: Vec<Measuring<'a>>,
    /// Whether the job has one cycle: its name may be left out.
    alone: bool,
}

/// The relations of a job, each of which is added to the path once.
#[derive(Debug)]
pub struct Relations<'v> {
    list: &'v [Value],
    /// The names of the cycles.
    cycles: &'v [String],
    added: Vec<bool>,
    /// Of those that a cycle follows, and of what these are of, the last cycle that each needs.
    due: Vec<Option<usize>>,
}

impl<'v> Relations<'v> {
    /// The list of a job; what is no list is reported.
    pub fn of(checker: &mut Checker, value: &'v Value, cycles: &'v [String]) -> Self {
        let list = match value.get(RELATIONS) {
            None | Some(Value::Null) => &[],
            Some(Value::List(list)) => list.as_slice(),
            Some(other) => {
                let message = text!("relations must be a list, not {given}", other.noun());
                checker.error("wrong-type", RELATIONS, message);
                &[]
            }
        };
        if list.len() > MOST_CYCLES {
            let message = text!("A set-up has at most {most} relations, not {count}", MOST_CYCLES, list.len());
            checker.error("wrong-count", RELATIONS, message);
        }
        let list = if list.len() > MOST_CYCLES { &[] } else { list };
        Relations { list, cycles, added: vec![false; list.len()], due: vec![None; list.len()] }
    }

    /// These relations lead cycles: each is added early, and all that it is of.
    pub fn lead(&mut self, followed: impl Iterator<Item = usize>) {
        let mut needed = vec![false; self.list.len()];
        followed.for_each(|index| needed.get_mut(index).into_iter().for_each(|needed| *needed = true));
        for index in (0..self.list.len()).rev() {
            let of = heads(&self.list[index]).filter(|_| needed[index]).collect::<Vec<_>>();
            let earlier = of.into_iter().filter_map(|head| named(&self.list[..index], head));
            earlier.for_each(|earlier| needed[earlier] = true);
        }
        for (index, needed) in needed.into_iter().enumerate() {
            let last = |head: &str| match self.cycles.iter().position(|name| name.eq_ignore_ascii_case(head)) {
                Some(cycle) => Some(cycle),
                None => self.due[named(&self.list[..index], head)?],
            };
            let last = heads(&self.list[index]).map(last).try_fold(0, |last, own| Some(own?.max(last)));
            self.due[index] = last.filter(|_| needed);
        }
    }

    /// Adds the relations that lead cycles, and for which this cycle is the last that they need.
    pub fn add_early(&mut self, path: &mut Path, cycle: usize) {
        for index in 0..self.list.len() {
            if self.due[index] == Some(cycle) {
                self.add(&mut Checker::default(), path, index);
            }
        }
    }

    /// Adds all that were not added early. Reports what is wrong with them. `computes`: whether the program computes with the results.
    pub fn add_all(mut self, checker: &mut Checker, path: &mut Path, computes: bool) {
        for index in 0..self.list.len() {
            self.add(checker, path, index);
        }
        if !computes && !self.list.is_empty() {
            let message = text!(
                "The program does not compute the relations. They are computed here once its results are entered as measured values"
            );
            checker.info("relation-not-computed", RELATIONS, message);
        }
    }

    fn add(&mut self, checker: &mut Checker, path: &mut Path, index: usize) {
        if self.added[index] {
            return;
        }
        let measuring = path.measuring_before(index).collect();
        let known = Known { formula: &path.formula, measuring, alone: self.cycles.len() == 1 };
        if let Some((name, related)) = read_one(checker, (self.list, index), self.cycles, &known) {
            path.relate(index, name, related);
            self.added[index] = true;
        }
    }
}

/// The names of what a relation is of: of `BORE.diameter` it is `BORE`. Ends with an empty one where that is not said.
fn heads(relation: &Value) -> impl Iterator<Item = &str> {
    let of = match relation.get("of") {
        Some(Value::List(of)) => of.as_slice(),
        _ => &[Value::Null],
    };
    of.iter().map(|of| match of {
        Value::Text(of) => of.split('.').next().unwrap_or_default(),
        _ => "",
    })
}

/// The relation of this name.
fn named(list: &[Value], name: &str) -> Option<usize> {
    list.iter().position(|other| matches!(other.get("name"), Some(Value::Text(own)) if own.eq_ignore_ascii_case(name)))
}

/// A relation that can be computed of the first cycles of a set-up, and what it has on the nominal part.
#[derive(Debug)]
pub struct Ahead {
    /// Its place in the list.
    pub index: usize,
    pub name: String,
    pub results: Vec<ResultDef>,
    pub datum: Option<Datum>,
}

/// The relations that can be computed of some cycles alone.
#[derive(Debug, Default)]
pub struct AllAhead<'v> {
    list: &'v [Value],
    names: &'v [String],
    formula: Formula,
    measured: Vec<(String, Range<usize>, Option<Datum>)>,
    pub all: Vec<Ahead>,
}

impl<'v> AllAhead<'v> {
    /// `names` are those of all cycles, `cycles` the formulas of the first of them.
    pub fn of(list: Option<&'v Value>, names: &'v [String], cycles: &[Formula]) -> Self {
        let Some(Value::List(list)) = list.filter(|list| matches!(list, Value::List(list) if list.len() <= MOST_CYCLES)) else {
            return Self::default();
        };
        let mut own = AllAhead { list, names, ..Self::default() };
        for (name, cycle) in names.iter().zip(cycles) {
            let begin = own.formula.results.len();
            let later = own.formula.join(name, cycle, 0);
            let datum = cycle.datum.map(|datum| datum.later_by(later));
            own.measured.push((name.clone(), begin..own.formula.results.len(), datum));
        }
        for (index, given) in list.iter().enumerate() {
            let is = |head: &str| own.measured.iter().any(|(name, ..)| name.eq_ignore_ascii_case(head));
            if !heads(given).all(is) {
                continue;
            }
            let Some((name, related)) = own.read(&mut Checker::default(), index) else { continue };
            let begin = own.formula.results.len();
            let datum = own.formula.relate(&name, &related);
            let results = begin..own.formula.results.len();
            own.all.push(Ahead { index, name: name.clone(), results: own.formula.results[results.clone()].to_vec(), datum });
            own.measured.push((name, results, datum));
        }
        own
    }

    fn read(&self, checker: &mut Checker, index: usize) -> Option<(String, formula::Relating)> {
        let measured = self.measured.iter();
        let measuring = measured.map(|(name, results, datum)| Measuring { name, results: results.clone(), datum: *datum });
        let known = Known { formula: &self.formula, measuring: measuring.collect(), alone: self.names.len() == 1 };
        read_one(checker, (self.list, index), self.names, &known)
    }

    /// Why the relation of this name is not among them; none where there is no such relation.
    pub fn lacks(&self, name: &str) -> Option<Text> {
        let mut own = Checker::default();
        self.read(&mut own, named(self.list, name)?);
        own.findings().into_iter().next().map(|finding| finding.said)
    }

    /// Reports what is wrong with relations, where `cycles` were all of them.
    pub fn report(&self, checker: &mut Checker) {
        for index in 0..self.list.len() {
            self.read(checker, index);
        }
    }
}

/// A relation of a list: its name, what it computes, and of what. Reports what is wrong with it.
fn read_one(
    checker: &mut Checker,
    (list, i): (&[Value], usize),
    cycles: &[String],
    known: &Known<'_>,
) -> Option<(String, formula::Relating)> {
    let given = &list[i];
    let Value::Map(entries) = given else {
        let message = text!("relations[{index}] must be an object, not {given}", i, given.noun());
        checker.error("wrong-type", format!("{RELATIONS}[{i}]"), message);
        return None;
    };
    for (key, _) in entries.iter().filter(|(key, _)| !["name", "type", "of"].contains(&key.as_str())) {
        let shown = printable(key);
        let message = text!("A relation has no \"{key}\"; it knows name, type and of", shown.clone());
        checker.error("unknown-key", format!("{RELATIONS}[{i}].{shown}"), message);
    }
    let taken = list[..i].iter().filter_map(|other| match other.get("name") {
        Some(Value::Text(name)) => Some(name),
        _ => None,
    });
    let taken: Vec<&String> = cycles.iter().chain(taken).collect();
    let name = read_name(checker, given, &taken, i);
    let relation = read_type(checker, given, i);
    let (name, relation) = (name?, relation?);
    let of = read_of(checker, given, known, (i, relation))?;
    let heights = of.iter().all(|operand| matches!(*operand, Operand::Result(index) if known.is_height(index)));
    Some((name, formula::Relating { relation, of, heights }))
}

fn read_name(checker: &mut Checker, given: &Value, taken: &[&String], i: usize) -> Option<String> {
    let at = format!("{RELATIONS}[{i}].name");
    let name = match given.get("name") {
        Some(Value::Text(name)) => name,
        Some(other) => {
            checker.error("wrong-type", at, text!("The name of a relation must be text, not {given}", other.noun()));
            return None;
        }
        None => {
            checker.error("missing", at, text!("A relation needs a name, which stands in front of its results"));
            return None;
        }
    };
    if !is_name(name) {
        let message = text!(
            "A relation cannot be called \"{name}\": a letter first, then letters and digits, {most} characters at most, since programs print it",
            name.chars().take(40).collect::<String>(),
            LONGEST_NAME
        );
        checker.error("cycle-name", at, message);
        return None;
    }
    if taken.iter().any(|other| other.eq_ignore_ascii_case(name)) {
        let message = text!("Another cycle or relation is called {name}, too", name.clone());
        checker.error("cycle-name", at, message);
        return None;
    }
    Some(name.clone())
}

fn read_type(checker: &mut Checker, given: &Value, i: usize) -> Option<Relation> {
    let at = format!("{RELATIONS}[{i}].type");
    let known = || Relation::ALL.map(|(word, _)| format!("\"{word}\"")).join(", ");
    match given.get("type") {
        Some(Value::Text(word)) => {
            let found = Relation::ALL.into_iter().find(|(known, _)| known == word).map(|(_, relation)| relation);
            if found.is_none() {
                checker.error("unknown-value", at, text!("The type of a relation must be one of {known}", known()));
            }
            found
        }
        Some(other) => {
            checker.error("wrong-type", at, text!("The type of a relation must be text, not {given}", other.noun()));
            None
        }
        None => {
            checker.error("missing", at, text!("The type of a relation must be one of {known}", known()));
            None
        }
    }
}

/// What a relation is of: cycles that measure a place, or results.
fn read_of(checker: &mut Checker, given: &Value, known: &Known<'_>, (i, relation): (usize, Relation)) -> Option<Vec<Operand>> {
    let at = format!("{RELATIONS}[{i}].of");
    let list = match given.get("of") {
        Some(Value::List(list)) => list.as_slice(),
        None => &[],
        Some(other) => {
            checker.error("wrong-type", at.clone(), text!("{path} must be a list, not {given}", at, other.noun()));
            return None;
        }
    };
    let takes = relation.takes(MOST_CYCLES);
    if !takes.contains(&list.len()) {
        let message = match relation {
            Relation::Line | Relation::Difference => text!("This relation is of exactly two, not of {count}", list.len()),
            _ => text!("This relation is of at least {least}, not of {count}", *takes.start(), list.len()),
        };
        checker.error("wrong-count", at, message);
        return None;
    }
    let mut of = Vec::with_capacity(list.len());
    for (k, given) in list.iter().enumerate() {
        let at = format!("{at}[{k}]");
        let Value::Text(name) = given else {
            checker.error("wrong-type", at.clone(), text!("{path} must be text, not {given}", at, given.noun()));
            continue;
        };
        match if relation.takes_places() { known.place(name) } else { known.single(name) } {
            Some(operand) if of.contains(&operand) => {
                checker.error("relation-of", at, text!("{name} is named twice", name.clone()));
            }
            Some(operand) => of.push(operand),
            None => {
                let known = if relation.takes_places() { known.places() } else { known.results() };
                let message = match relation.takes_places() {
                    true => {
                        text!("\"{name}\" measures no place in the plane. These do: {known}", printable(name), known.join(", "))
                    }
                    false => {
                        text!("There is no measured result \"{name}\". There are {known}", printable(name), known.join(", "))
                    }
                };
                checker.error("relation-of", at, message);
            }
        }
    }
    if of.len() != list.len() {
        return None;
    }
    check_kinds(checker, known.formula, &of, relation, at).then_some(of)
}

/// Whether the operands give what the relation says.
fn check_kinds(checker: &mut Checker, formula: &Formula, of: &[Operand], relation: Relation, at: String) -> bool {
    let result = |index: usize| &formula.results[index];
    let point = |operand: &Operand| match *operand {
        Operand::Place(axes) => axes.map(|index| result(index).nominal),
        Operand::Result(index) => [result(index).nominal, 0.0],
    };
    let angle = |operand: &Operand| matches!(*operand, Operand::Result(index) if result(index).role.is_angle());
    let problem = match relation {
        Relation::Difference | Relation::Mean if of.iter().any(|one| angle(one) != angle(&of[0])) => {
            Some(text!("A length and an angle have neither a difference nor a mean"))
        }
        Relation::Line => {
            let (from, to) = (point(&of[0]), point(&of[1]));
            ((to[0] - from[0]).hypot(to[1] - from[1]) < APART)
                .then(|| text!("Both places are the same on the nominal part: no direction leads from one to the other"))
        }
        Relation::PitchCircle => {
            let places: Vec<_> = of.iter().map(point).map(|[x, y]| crate::geom::Vec2::new(x, y)).collect();
            let flat = |radius: f64| radius.is_nan() || radius > 10_000.0;
            let fit = formula::fit_circle(&places);
            fit.is_none_or(|fit| flat(fit.radius)).then(|| text!("These places lie on one line: they give no circle"))
        }
        _ => None,
    };
    let good = problem.is_none();
    if let Some(problem) = problem {
        checker.error("relation-of", at, problem);
    }
    good
}

impl Known<'_> {
    /// The place that a cycle or an earlier relation measures in the plane.
    fn place(&self, name: &str) -> Option<Operand> {
        let own = self.measuring.iter().find(|own| own.name.eq_ignore_ascii_case(name))?;
        let place = own.datum?.place;
        let index = |axis: usize| {
            let measured = place[axis]?.measured;
            own.results.clone().find(|index| measured.is_some() && self.formula.results[*index].variable == measured)
        };
        Some(Operand::Place([index(0)?, index(1)?]))
    }

    /// A measured result by its name.
    fn single(&self, name: &str) -> Option<Operand> {
        let is = |result: &ResultDef| {
            self.formula.full_code(result).eq_ignore_ascii_case(name) || self.alone && result.code.eq_ignore_ascii_case(name)
        };
        self.measured().find(|index| is(&self.formula.results[*index])).map(Operand::Result)
    }

    /// Whether a result is a height that a work offset could be written from.
    fn is_height(&self, index: usize) -> bool {
        let own = self.measuring.iter().find(|own| own.results.contains(&index));
        let height = own.and_then(|own| own.datum?.place[2]?.measured);
        height.is_some() && self.formula.results[index].variable == height
    }

    fn measured(&self) -> impl Iterator<Item = usize> {
        let all = self.measuring.iter().flat_map(|own| own.results.clone());
        all.filter(|index| self.formula.results[*index].variable.is_some())
    }

    /// The names that a place can have.
    fn places(&self) -> Vec<String> {
        let names = self.measuring.iter().map(|own| own.name);
        names.filter(|name| self.place(name).is_some()).map(str::to_owned).collect()
    }

    fn results(&self) -> Vec<String> {
        self.measured().map(|index| self.formula.full_code(&self.formula.results[index]).into_owned()).collect()
    }
}

/// Pitch circles whose places are on none on the nominal part: their diameter is of another circle than the drawing's, and the program always stops there.
pub fn check_circles(checker: &mut Checker, whole: &Planned) {
    let (path, Some(limit)) = (&whole.path, whole.job.limits.residual) else { return };
    for relation in path.relations.iter().filter(|relation| relation.own.relation == Relation::PitchCircle) {
        let nominal = |index: usize| Some(path.formula.results[index].nominal);
        let Some(off) = path.related(relation, nominal).pop().flatten().filter(|off| *off > limit) else { continue };
        let message = text!(
            "The nominal places are {off} off one circle, more than limits.residual, {limit}",
            checker.length(off),
            checker.length(limit)
        );
        checker.error("relation-of", format!("relations[{}].of", relation.index), message);
    }
}

/// Adds the rows of all relations to those of the cycles. `evaluated` are the rows of the whole formula.
pub fn add_rows(
    whole: &Planned,
    mut evaluated: Vec<formula::ResultRow>,
    results: &mut Vec<ResultRow>,
    checker: Option<&mut Checker>,
) -> bool {
    let off = judge(&whole.job, &whole.path, &mut evaluated);
    let relations = &whole.path.relations;
    let of_relations = |result: usize| relations.iter().any(|relation| relation.results.contains(&result));
    let off: Vec<_> = off.into_iter().filter(|question| of_relations(question.result)).collect();
    if let Some(checker) = checker {
        report_judged(whole, &evaluated, &off, whole.writes(), checker);
    }
    for (i, relation) in relations.iter().enumerate() {
        let truth = |index: usize| {
            let def = &whole.path.formula.results[index];
            let of = whole.path.measured_by(def);
            results.iter().find(|row| Some(row.cycle) == of && row.code == def.code)?.truth
        };
        let truths = whole.path.related(relation, truth);
        for (row, truth) in evaluated[relation.results.clone()].iter().cloned().zip(truths) {
            let angle = row.unit == formula::Unit::Angle;
            let mut row = ResultRow { cycle: whole.members.len() + i, ..result_row(&whole.job, row, None, None) };
            // A direction may be said a whole turn farther.
            let turn = |truth: f64| row.value.map_or(truth, |value| truth + ((value - truth) / 360.0).round() * 360.0);
            // How far true places are from their circle is not what touches are off it.
            let truth = truth.filter(|_| row.code != "residual");
            row.truth = truth.map(|truth| tidy(if angle { turn(truth) } else { truth }));
            results.push(row);
        }
    }
    off.iter().all(|question| question.asked != formula::Asked::Plausible)
}
