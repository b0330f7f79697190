//! The relations of a set-up: what is computed of the results of its cycles.

use crate::form::{Checker, Value, printable};
use crate::formula::{self, Operand, Relation, Role, related};
use crate::job::cycles::{LONGEST_NAME, MOST_CYCLES, RELATIONS, is_name};
use crate::job::judge::{judge, report_judged};
use crate::job::planned::Planned;
use crate::job::rows::{ResultRow, result_row};
use crate::num::tidy;
use crate::path::{Path, Related};
use crate::text::text;

/// Nominal places this near to each other have no direction, mm.
const APART: f64 = 0.1;

/// Reads the relations of a job and adds each to the path. `own`: whether the control's own cycles measure, whose results no program can compute with.
pub fn read(checker: &mut Checker, value: &Value, path: &mut Path, own: bool) {
    let list = match value.get(RELATIONS) {
        None | Some(Value::Null) => return,
        Some(Value::List(list)) => list,
        Some(other) => {
            let message = text!("relations must be a list, not {given}", other.noun());
            return checker.error("wrong-type", RELATIONS, message);
        }
    };
    if own && !list.is_empty() {
        let message = text!(
            "The control's own cycles keep their results in variables, and this program does not compute with those: use the form \"moves\" for relations"
        );
        return checker.error("set-up-unsupported", RELATIONS, message);
    }
    if list.len() > MOST_CYCLES {
        let message = text!("A set-up has at most {most} relations, not {count}", MOST_CYCLES, list.len());
        return checker.error("wrong-count", RELATIONS, message);
    }
    for (i, given) in list.iter().enumerate() {
        let Value::Map(entries) = given else {
            let message = text!("relations[{index}] must be an object, not {given}", i, given.noun());
            checker.error("wrong-type", format!("{RELATIONS}[{i}]"), message);
            continue;
        };
        for (key, _) in entries.iter().filter(|(key, _)| !["name", "type", "of"].contains(&key.as_str())) {
            let shown = printable(key);
            let message = text!("A relation has no \"{key}\"; it knows name, type and of", shown.clone());
            checker.error("unknown-key", format!("{RELATIONS}[{i}].{shown}"), message);
        }
        let name = read_name(checker, given, path, i);
        let relation = read_type(checker, given, i);
        let (Some(name), Some(relation)) = (name, relation) else { continue };
        if let Some(of) = read_of(checker, given, path, (i, relation)) {
            path.relate(name, relation, of);
        }
    }
}

fn read_name(checker: &mut Checker, given: &Value, path: &Path, i: usize) -> Option<String> {
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
    if path.measuring().any(|own| own.name.eq_ignore_ascii_case(name)) {
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
fn read_of(checker: &mut Checker, given: &Value, path: &Path, (i, relation): (usize, Relation)) -> Option<Vec<Operand>> {
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
        match if relation.takes_places() { place(path, name) } else { single(path, name) } {
            Some(operand) if of.contains(&operand) => {
                checker.error("relation-of", at, text!("{name} is named twice", name.clone()));
            }
            Some(operand) => of.push(operand),
            None => {
                let known = if relation.takes_places() { places(path) } else { results(path) };
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
    check_kinds(checker, path, &of, relation, at).then_some(of)
}

/// Whether the operands give what the relation says.
fn check_kinds(checker: &mut Checker, path: &Path, of: &[Operand], relation: Relation, at: String) -> bool {
    let result = |index: usize| &path.formula.results[index];
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

/// The place that a cycle or an earlier relation measures in the plane.
fn place(path: &Path, name: &str) -> Option<Operand> {
    let own = path.measuring().find(|own| own.name.eq_ignore_ascii_case(name))?;
    let place = own.datum?.place;
    let index = |axis: usize| {
        let measured = place[axis]?.measured;
        own.results.clone().find(|index| measured.is_some() && path.formula.results[*index].variable == measured)
    };
    Some(Operand::Place([index(0)?, index(1)?]))
}

/// A measured result by its name.
fn single(path: &Path, name: &str) -> Option<Operand> {
    let formula = &path.formula;
    let is = |result: &formula::ResultDef| result.variable.is_some() && formula.is_named(result, name);
    formula.results.iter().position(is).map(Operand::Result)
}

/// The names that a place can have.
fn places(path: &Path) -> Vec<String> {
    path.measuring().filter(|own| place(path, own.name).is_some()).map(|own| own.name.to_owned()).collect()
}

fn results(path: &Path) -> Vec<String> {
    let measured = path.formula.results.iter().filter(|result| result.variable.is_some());
    measured.map(|result| path.formula.full_code(result).into_owned()).collect()
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
    let first = relations.first().map_or(usize::MAX, |first| first.results.start);
    let off: Vec<_> = off.into_iter().filter(|question| question.result >= first).collect();
    if let Some(checker) = checker {
        report_judged(&whole.job, &evaluated, &off, whole.writes(), checker);
    }
    let mut rows = evaluated.into_iter().skip(first);
    for (i, relation) in relations.iter().enumerate() {
        let truths = truths(whole, relation, results);
        for (row, truth) in rows.by_ref().take(relation.results.len()).zip(truths) {
            let angle = row.unit == formula::Unit::Angle;
            let mut row = ResultRow { cycle: whole.members.len() + i, ..result_row(&whole.job, row, None, None) };
            // A direction may be said a whole turn farther.
            let turn = |truth: f64| row.value.map_or(truth, |value| truth + ((value - truth) / 360.0).round() * 360.0);
            row.truth = truth.map(|truth| tidy(if angle { turn(truth) } else { truth }));
            results.push(row);
        }
    }
    off.iter().all(|question| question.asked != formula::Asked::Plausible)
}

/// What a relation truly is on the virtual part, from what its cycles truly measure.
fn truths(whole: &Planned, relation: &Related, rows: &[ResultRow]) -> Vec<Option<f64>> {
    let truth = |index: usize| {
        let def = &whole.path.formula.results[index];
        let row = rows.iter().find(|row| row.cycle == usize::from(def.cycle) && row.code == def.code)?;
        let near = |truth: f64| match (def.role, row.nominal) {
            (Role::Direction, Some(nominal)) => truth + ((nominal - truth) / 360.0).round() * 360.0,
            _ => truth,
        };
        row.truth.map(near)
    };
    let place = |operand: &Operand| match *operand {
        Operand::Place([x, y]) => Some([truth(x)?, truth(y)?]),
        Operand::Result(index) => Some([truth(index)?, 0.0]),
    };
    match relation.of.iter().map(place).collect::<Option<Vec<_>>>() {
        Some(of) => {
            let is = |operand: &Operand| matches!(*operand, Operand::Result(index) if whole.path.formula.results[index].role == Role::Direction);
            related(relation.relation, &of, relation.of.iter().any(is))
        }
        None => vec![None; relation.results.len()],
    }
}
