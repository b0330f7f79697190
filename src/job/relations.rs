//! Reads the relations of a set-up: results computed from results of its cycles.

use crate::form::{Checker, Section, Value, printable};
use crate::formula::{self, Formula, Operand, Relation, RelationDef, ResultDef};
use crate::job::cycles::{LONGEST_NAME, MOST_CYCLES, RELATIONS, is_name};
use crate::job::judge::{judge, report_judged};
use crate::job::planned::PlannedJob;
use crate::job::rows::{ResultRow, result_row};
use crate::num::tidy;
use crate::path::{Path, ResultSource};
use crate::text::{Text, text};

/// Possible operands: the cycles and relations known so far, in the joined formula.
#[derive(Debug)]
struct Operands<'a> {
    formula: &'a Formula,
    measuring: Vec<ResultSource<'a>>,
    /// Whether the job has one cycle, whose name may be left out.
    alone: bool,
}

/// The relations of a set-up while its cycles are read. Each is added to the path once.
#[derive(Debug)]
pub struct Relations<'v> {
    list: &'v [Value],
    /// The names of all cycles.
    cycles: &'v [String],
    added: Vec<bool>,
    /// Relations that a cycle follows, and their operands: they are added as soon as they can be computed.
    early: Vec<bool>,
}

impl<'v> Relations<'v> {
    /// Reads the list of a job in which cycles follow these names. Reports a value that is not a list.
    pub fn of(
        checker: &mut Checker,
        value: &'v Value,
        cycles: &'v [String],
        followed: &[&str],
    ) -> Self {
        let list = checker
            .list(value.given(RELATIONS), RELATIONS)
            .unwrap_or_default();
        if list.len() > MOST_CYCLES {
            let message = text!(
                "A set-up has at most {most} relations, not {count}",
                MOST_CYCLES,
                list.len()
            );
            checker.error("wrong-count", RELATIONS, message);
        }
        let list = if list.len() > MOST_CYCLES { &[] } else { list };
        let mut early = vec![false; list.len()];
        for name in followed {
            named(list, name)
                .into_iter()
                .for_each(|index| early[index] = true);
        }
        // A relation has only earlier ones as operands: going backwards meets each before its operands.
        for index in (0..list.len()).rev() {
            if early[index] {
                heads(&list[index])
                    .filter_map(|head| named(&list[..index], head))
                    .for_each(|earlier| early[earlier] = true);
            }
        }
        Relations {
            list,
            cycles,
            added: vec![false; list.len()],
            early,
        }
    }

    /// Adds the relations that cycles follow, if all their operands are measured.
    pub fn add_early(&mut self, path: &mut Path) {
        for index in 0..self.list.len() {
            if self.early[index] && self.is_ready(path, index) {
                self.add(&mut Checker::default(), path, index);
            }
        }
    }

    /// Adds all remaining relations and reports their errors.
    pub fn add_all(&mut self, checker: &mut Checker, path: &mut Path) {
        for index in 0..self.list.len() {
            self.add(checker, path, index);
        }
    }

    /// Reports that a program does not compute them.
    pub fn report_not_computed(&self, checker: &mut Checker) {
        if !self.list.is_empty() {
            let message = text!(
                "The program does not compute the relations. They are computed here once its results are entered as measured values"
            );
            checker.info("relation-not-computed", RELATIONS, message);
        }
    }

    /// The path with every computable relation, whether a cycle follows it or not.
    pub fn with_all_ready(&self, path: &Path) -> Path {
        let mut path = path.clone();
        let mut all = Relations {
            list: self.list,
            cycles: self.cycles,
            added: self.added.clone(),
            early: Vec::new(),
        };
        for index in 0..all.list.len() {
            if all.is_ready(&path, index) {
                all.add(&mut Checker::default(), &mut path, index);
            }
        }
        path
    }

    /// Reason why the relation with this name cannot be computed from this path; `None` if there is no such relation.
    pub fn lacks(&self, path: &Path, name: &str) -> Option<Text> {
        let mut own = Checker::default();
        self.read(&mut own, path, named(self.list, name)?);
        own.findings()
            .into_iter()
            .next()
            .map(|finding| finding.said)
    }

    /// Whether all operands of a relation are measured.
    fn is_ready(&self, path: &Path, index: usize) -> bool {
        heads(&self.list[index]).all(|head| {
            path.measuring_before(index)
                .any(|own| own.name.eq_ignore_ascii_case(head))
        })
    }

    fn add(&mut self, checker: &mut Checker, path: &mut Path, index: usize) {
        if self.added[index] {
            return;
        }
        if let Some((name, related)) = self.read(checker, path, index) {
            path.relate(index, name, related);
            self.added[index] = true;
        }
    }

    fn read(
        &self,
        checker: &mut Checker,
        path: &Path,
        index: usize,
    ) -> Option<(String, formula::RelationTerm)> {
        let measuring = path.measuring_before(index).collect();
        let known = Operands {
            formula: &path.formula,
            measuring,
            alone: self.cycles.len() == 1,
        };
        read_one(checker, (self.list, index), self.cycles, &known)
    }
}

/// Names of the cycles and relations in the operands of a relation: `BORE` for `BORE.diameter`. An operand that gives none ends the list with an empty name.
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

/// The relation with this name.
fn named(list: &[Value], name: &str) -> Option<usize> {
    list.iter().position(|other| matches!(other.get("name"), Some(Value::Text(own)) if own.eq_ignore_ascii_case(name)))
}

/// Reads a relation: name, kind and operands. Reports its errors.
fn read_one(
    checker: &mut Checker,
    (list, i): (&[Value], usize),
    cycles: &[String],
    known: &Operands<'_>,
) -> Option<(String, formula::RelationTerm)> {
    let given = &list[i];
    let path = format!("{RELATIONS}[{i}]");
    let mut section = Section::new(checker, Some(given), &path);
    section.only(&[], &["name", "type", "of"]);
    section.value()?;
    let taken = list[..i]
        .iter()
        .filter_map(|other| match other.get("name") {
            Some(Value::Text(name)) => Some(name),
            _ => None,
        });
    let taken: Vec<&String> = cycles.iter().chain(taken).collect();
    let name = read_name(checker, given, &taken, i);
    let relation = read_type(checker, given, i);
    let (name, relation) = (name?, relation?);
    let of = read_of(checker, given, known, (i, relation))?;
    let heights = of
        .iter()
        .all(|operand| matches!(*operand, Operand::Result(index) if known.is_height(index)));
    Some((
        name,
        formula::RelationTerm {
            relation,
            of,
            heights,
        },
    ))
}

fn read_name(checker: &mut Checker, given: &Value, taken: &[&String], i: usize) -> Option<String> {
    let at = format!("{RELATIONS}[{i}].name");
    let Some(name) = given.get("name") else {
        let message = text!("A relation needs a name, the prefix of its results");
        checker.error("missing", at, message);
        return None;
    };
    let name = checker.text(name, &at)?;
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
        let message = text!(
            "Another cycle or relation has the name {name}, too",
            name.to_owned()
        );
        checker.error("cycle-name", at, message);
        return None;
    }
    Some(name.to_owned())
}

fn read_type(checker: &mut Checker, given: &Value, i: usize) -> Option<Relation> {
    let at = format!("{RELATIONS}[{i}].type");
    let known = || {
        formula::RELATIONS
            .each_ref()
            .map(|def| format!("\"{}\"", def.key))
            .join(", ")
    };
    let (code, found) = match given.get("type") {
        Some(word) => ("unknown-value", RelationDef::find(checker.text(word, &at)?)),
        None => ("missing", None),
    };
    if found.is_none() {
        let message = text!("The type of a relation must be one of {known}", known());
        checker.error(code, at, message);
    }
    found
}

/// Operands of a relation: cycles that measure a position, or results.
fn read_of(
    checker: &mut Checker,
    given: &Value,
    known: &Operands<'_>,
    (i, relation): (usize, Relation),
) -> Option<Vec<Operand>> {
    let at = format!("{RELATIONS}[{i}].of");
    let list = checker.list(given.get("of"), &at)?;
    let RelationDef { least, most, .. } = *relation;
    if !(least..=most.unwrap_or(MOST_CYCLES)).contains(&list.len()) {
        let message = match most {
            Some(most) if most == least => text!(
                "This relation needs exactly {wanted} operands, not {count}",
                most,
                list.len()
            ),
            _ => text!(
                "This relation needs at least {least} operands, not {count}",
                least,
                list.len()
            ),
        };
        checker.error("wrong-count", at, message);
        return None;
    }
    let mut of = Vec::with_capacity(list.len());
    for (k, given) in list.iter().enumerate() {
        let at = format!("{at}[{k}]");
        let Some(name) = checker.text(given, &at) else {
            continue;
        };
        match read_operand(name, known, relation.places) {
            Err(message) => checker.error("relation-of", at, message),
            Ok(operand) if of.contains(&operand) => {
                let message = text!("{name} is listed twice", name.to_owned());
                checker.error("relation-of", at, message);
            }
            Ok(operand) => of.push(operand),
        }
    }
    (of.len() == list.len() && check_kinds(checker, known.formula, &of, relation, at)).then_some(of)
}

/// The operand of a relation with this name, or the reason why the name cannot be used.
fn read_operand(name: &str, known: &Operands<'_>, places: bool) -> Result<Operand, Text> {
    let found = if places {
        known.place(name)
    } else {
        known.single(name)
    };
    found.ok_or_else(|| match places {
        true => text!(
            "\"{name}\" measures no position in the plane. These do: {known}",
            printable(name),
            known.places().join(", ")
        ),
        false => text!(
            "There is no measured result \"{name}\". Available: {known}",
            printable(name),
            known.results().join(", ")
        ),
    })
}

/// Checks whether the operands fit the relation.
fn check_kinds(
    checker: &mut Checker,
    formula: &Formula,
    of: &[Operand],
    relation: Relation,
    at: String,
) -> bool {
    let result = |index: usize| &formula.results[index];
    let nominal = |operand: &Operand| match *operand {
        Operand::Place(axes) => axes.map(|index| result(index).nominal),
        Operand::Result(index) => [result(index).nominal, 0.0],
    };
    let angle = |operand: &Operand| matches!(*operand, Operand::Result(index) if result(index).role.is_angle());
    let problem = match of.iter().any(|one| angle(one) != angle(&of[0])) {
        true => Some(text!(
            "A length and an angle have neither a difference nor a mean"
        )),
        false => relation.problem(&of.iter().map(nominal).collect::<Vec<_>>()),
    };
    let good = problem.is_none();
    if let Some(problem) = problem {
        checker.error("relation-of", at, problem);
    }
    good
}

impl Operands<'_> {
    /// The position that a cycle or an earlier relation measures in the plane.
    fn place(&self, name: &str) -> Option<Operand> {
        let own = self
            .measuring
            .iter()
            .find(|own| own.name.eq_ignore_ascii_case(name))?;
        let place = own.datum?.place;
        let index = |axis: usize| {
            let measured = place[axis]?.measured;
            own.results.clone().find(|index| {
                measured.is_some() && self.formula.results[*index].variable == measured
            })
        };
        Some(Operand::Place([index(0)?, index(1)?]))
    }

    /// A measured result by its name.
    fn single(&self, name: &str) -> Option<Operand> {
        let is = |result: &ResultDef| {
            self.formula.full_code(result).eq_ignore_ascii_case(name)
                || self.alone && result.code.eq_ignore_ascii_case(name)
        };
        self.measured()
            .find(|index| is(&self.formula.results[*index]))
            .map(Operand::Result)
    }

    /// Whether a result is a height from which a work offset could be written.
    fn is_height(&self, index: usize) -> bool {
        let own = self
            .measuring
            .iter()
            .find(|own| own.results.contains(&index));
        let height = own.and_then(|own| own.datum?.place[2]?.measured);
        height.is_some() && self.formula.results[index].variable == height
    }

    fn measured(&self) -> impl Iterator<Item = usize> {
        let all = self.measuring.iter().flat_map(|own| own.results.clone());
        all.filter(|index| self.formula.results[*index].variable.is_some())
    }

    /// Names of all positions.
    fn places(&self) -> Vec<String> {
        let names = self.measuring.iter().map(|own| own.name);
        names
            .filter(|name| self.place(name).is_some())
            .map(str::to_owned)
            .collect()
    }

    fn results(&self) -> Vec<String> {
        self.measured()
            .map(|index| {
                self.formula
                    .full_code(&self.formula.results[index])
                    .into_owned()
            })
            .collect()
    }
}

/// Reports relations with a residual on the nominal part, such as a pitch circle whose positions are not on a circle: its diameter differs from the drawing's,
/// and the program always stops there.
pub fn check_circles(checker: &mut Checker, whole: &PlannedJob) {
    let (path, Some(limit)) = (&whole.path, whole.job.limits.residual) else {
        return;
    };
    for relation in &path.relations {
        let nominal = |index: usize| Some(path.formula.results[index].nominal);
        let Some(residual) = relation
            .own
            .relation
            .results
            .iter()
            .position(|code| *code == "residual")
        else {
            continue;
        };
        let Some(off) = path.related(relation, nominal)[residual].filter(|off| *off > limit) else {
            continue;
        };
        let message = text!(
            "The nominal positions deviate by {off} from one circle, more than \"Residual limit\", {limit}",
            checker.length(off),
            checker.length(limit)
        );
        checker.error(
            "relation-of",
            format!("relations[{}].of", relation.index),
            message,
        );
    }
}

/// Adds the rows of all relations to those of the cycles. `evaluated` are the rows of the joined formula.
pub fn add_rows(
    whole: &PlannedJob,
    mut evaluated: Vec<formula::ResultRow>,
    results: &mut Vec<ResultRow>,
    checker: Option<&mut Checker>,
) -> bool {
    let off = judge(&whole.job, &whole.path, &mut evaluated);
    let relations = &whole.path.relations;
    let of_relations = |result: usize| {
        relations
            .iter()
            .any(|relation| relation.results.contains(&result))
    };
    let off: Vec<_> = off
        .into_iter()
        .filter(|question| of_relations(question.result))
        .collect();
    if let Some(checker) = checker {
        report_judged(whole, &evaluated, &off, whole.writes(), checker);
    }
    let kept = whole.path.kept();
    let stored = |index: usize| {
        let (_, stored) = kept.iter().find(|(known, _)| *known == index)?;
        Some((whole.job.post.own?.name)(*stored))
    };
    for (i, relation) in relations.iter().enumerate() {
        let truth = |index: usize| {
            let def = &whole.path.formula.results[index];
            let of = whole.path.measured_by(def);
            results
                .iter()
                .find(|row| Some(row.cycle) == of && row.code == def.code)?
                .truth
        };
        let truths = whole.path.related(relation, truth);
        for (index, truth) in relation.results.clone().zip(truths) {
            let row = evaluated[index].clone();
            let angle = row.unit == formula::Unit::Angle;
            let mut row = ResultRow {
                cycle: whole.members.len() + i,
                ..result_row(&whole.job, row, None, stored(index))
            };
            // A control may give a direction a whole turn away.
            let turn = |truth: f64| {
                row.value.map_or(truth, |value| {
                    truth + ((value - truth) / 360.0).round() * 360.0
                })
            };
            // The distance of true positions from their circle is not the residual of the touches.
            let truth = truth.filter(|_| row.code != "residual");
            row.truth = truth.map(|truth| tidy(if angle { turn(truth) } else { truth }));
            results.push(row);
        }
    }
    off.iter()
        .all(|question| question.asked != formula::CheckKind::Plausibility)
}
