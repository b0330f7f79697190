//! Arithmetic of a program between native cycles: relations between results, and the shifts of cycles that follow results.

use crate::control::Request;
use crate::control::native_run::CycleLinking;
use crate::formula::{CheckKind, Node, ResultCheck, ResultDef, ToleranceAction};
use crate::path::{CallBlock, CallSequence, Computed, Path, Stored};

/// Why a program cannot compute a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lack {
    /// It needs this many variables.
    Variables(usize),
    /// No call stores what a cycle follows: the index of the cycle.
    Followed(usize),
}

/// Gives a variable to every value that the program of a set-up computes: those of relations, of shifts, and what leads to them. Variables after the saved
/// results are free. Returns the relations that it cannot compute, since no call stores their operands.
pub fn allocate(path: &mut Path, several: CycleLinking) -> Result<Vec<usize>, Lack> {
    let room = several.saved_variables;
    let Some(own) = &path.calls else {
        return Ok(Vec::new());
    };
    let saved = own.blocks.iter().filter_map(|(block, _)| match block {
        CallBlock::SaveResult(variable, _) => Some(variable + 1),
        _ => None,
    });
    let free = saved.max().unwrap_or(room.0);
    let known = known(path);
    let shifts = |m: usize| path.cycles[m].placing.shift_variables();
    let not_known = |m: &usize| shifts(*m).any(|variable| !known.computes[variable.index()]);
    if let Some(m) = (0..path.cycles.len()).find(not_known) {
        return Err(Lack::Followed(m));
    }
    let mut wanted = vec![false; path.formula.assignments.len()];
    for variable in (0..path.cycles.len()).flat_map(shifts) {
        wanted[variable.index()] = true;
    }
    let mut lacking = Vec::new();
    let relations = path.relations.iter().enumerate();
    for (index, relation) in relations.filter(|_| several.computes) {
        let results = &path.formula.results[relation.results.clone()];
        let variables = results.iter().filter_map(|result| result.variable);
        if variables
            .clone()
            .all(|variable| known.computes[variable.index()])
        {
            variables.for_each(|variable| wanted[variable.index()] = true);
        } else {
            lacking.push(index);
        }
    }
    for variable in computed_results(path).filter_map(|result| result.variable) {
        wanted[variable.index()] |= known.computes[variable.index()];
    }
    let (computed, last) = registers(path, &known, &wanted, free);
    if last > room.1 {
        return Err(Lack::Variables(last + 1 - room.0));
    }
    if let Some(own) = &mut path.calls {
        own.computed = computed;
    }
    Ok(lacking)
}

/// Results of the cycles that measure by single touches.
fn computed_results(path: &Path) -> impl Iterator<Item = &ResultDef> {
    let computes = |path: &Path| path.calls.iter().any(|own| !own.measured.is_empty());
    let alone = path.cycles.is_empty() && computes(path);
    let members = path.cycles.iter().filter(move |own| computes(&own.path));
    let of_members = members.flat_map(|own| &path.formula.results[own.results.clone()]);
    let alone = path.formula.results.iter().filter(move |_| alone);
    alone.chain(of_members)
}

/// Adds the variables of the computed results to those that the calls of a cycle store. `first` is the index of its first result in the joined formula.
pub fn store_results(own: &mut Path, whole: &Path, first: usize) {
    let (Some(calls), Some(computing)) = (&mut own.calls, &whole.calls) else {
        return;
    };
    if calls.measured.is_empty() {
        return;
    }
    let results = own.formula.results.iter().enumerate();
    let stored = results.filter_map(|(i, result)| {
        let variable = whole.formula.results[first + i].variable?;
        Some((result.code, computing.stored_value(variable.index())?))
    });
    calls.stored = stored.collect();
}

/// Values that a program knows.
struct Known {
    /// Place of each value that a call stores, by assignment.
    stored: Vec<Option<Stored>>,
    /// Whether each value is stored, or follows from stored ones.
    computes: Vec<bool>,
}

fn known(path: &Path) -> Known {
    let formula = &path.formula;
    let mut stored = vec![None; formula.assignments.len()];
    for (assignment, place) in path.measured_values() {
        stored[assignment] = Some(place);
    }
    for (result, place) in path.kept() {
        if let Some(variable) = formula.results[result].variable {
            stored[variable.index()] = Some(place);
        }
    }
    let mut computes: Vec<bool> = Vec::with_capacity(stored.len());
    for (assignment, stored) in formula.assignments.iter().zip(&stored) {
        let mut all = true;
        formula.each(assignment.node, &mut |node| {
            all &= match node {
                Node::Trigger { .. } | Node::Circle(..) => false,
                Node::Variable(earlier) => computes[earlier.index()],
                _ => true,
            }
        });
        computes.push(all || stored.is_some());
    }
    Known { stored, computes }
}

/// Place of every value that leads to the wanted ones, and the last used variable. An intermediate value frees its variable after its last use.
fn registers(
    path: &Path,
    known: &Known,
    wanted: &[bool],
    free: usize,
) -> (Vec<Option<Computed>>, usize) {
    let formula = &path.formula;
    let node = |i: usize| formula.assignments[i].node;
    let mut needed = wanted.to_vec();
    for i in (0..needed.len())
        .rev()
        .filter(|i| known.stored[*i].is_none())
    {
        if needed[i] {
            formula.each(node(i), &mut |node| {
                if let Node::Variable(earlier) = node {
                    needed[earlier.index()] = true;
                }
            });
        }
    }
    let mut computed: Vec<Option<Computed>> = vec![None; needed.len()];
    for i in 0..needed.len() {
        // A copy of a stored value needs no variable.
        let copied = match formula.node(node(i)) {
            Node::Variable(earlier) if needed[i] => match computed[earlier.index()] {
                Some(Computed::Measured(stored)) => Some(stored),
                _ => None,
            },
            _ => None,
        };
        computed[i] = known.stored[i].or(copied).map(Computed::Measured);
    }
    let steps = steps(path);
    let computes = |i: &usize| needed[*i] && computed[*i].is_none();
    let mut order: Vec<usize> = (0..needed.len()).filter(computes).collect();
    order.sort_by_key(|i| (steps[*i], *i));
    // Place in the order of the last value that reads each one.
    let mut last_use = vec![0; needed.len()];
    for (at, i) in order.iter().enumerate() {
        formula.each(node(*i), &mut |node| {
            if let Node::Variable(earlier) = node {
                last_use[earlier.index()] = at;
            }
        });
    }
    let (mut spare, mut next): (Vec<usize>, usize) = (Vec::new(), free);
    for (at, i) in order.iter().enumerate() {
        let variable = spare.pop().unwrap_or_else(|| {
            next += 1;
            next - 1
        });
        computed[*i] = Some(Computed::Register {
            variable,
            before: steps[*i],
        });
        for earlier in &order[..at] {
            if let Some(Computed::Register { variable, .. }) = computed[*earlier]
                && last_use[*earlier] == at
                && !wanted[*earlier]
            {
                spare.push(variable);
            }
        }
    }
    (computed, next.max(1) - 1)
}

/// Cycle before which each value can be computed, by its index: a relation as soon as its operands are measured.
fn steps(path: &Path) -> Vec<usize> {
    let formula = &path.formula;
    let relations: Vec<u16> = path
        .relations
        .iter()
        .map(|own| formula.results[own.results.start].cycle)
        .collect();
    let after = |i: usize| (1..=path.cycles.len()).find(|m| path.computed_by(m - 1).contains(&i));
    let mut steps: Vec<usize> = Vec::with_capacity(formula.assignments.len());
    for (i, assignment) in formula.assignments.iter().enumerate() {
        let mut step = 1;
        if relations.contains(&assignment.cycle) {
            formula.each(assignment.node, &mut |node| {
                if let Node::Variable(earlier) = node {
                    step = step.max(steps[earlier.index()]);
                }
            });
        } else {
            step = after(i).unwrap_or(0);
        }
        steps.push(step);
    }
    steps
}

/// Values that a program computes before cycle `m`, in order, each with its variable; and its checks: of what that cycle follows, and of tolerances that stop.
pub fn before(
    request: &Request<'_>,
    own: &CallSequence,
    m: usize,
) -> (Vec<(usize, usize)>, Vec<ResultCheck>) {
    let path = request.path;
    let register = |i: usize| match own.computed.get(i).copied().flatten()? {
        Computed::Register { variable, before } if before == m => Some((i, variable)),
        _ => None,
    };
    let values = (0..own.computed.len()).filter_map(register).collect();
    if path.cycles.is_empty() {
        return (values, Vec::new());
    }
    let mut checks = match m < path.cycles.len() {
        true => path.asked_before(m, &request.limits),
        false => Vec::new(),
    };
    // A relation is known once it is computed, a result of a cycle after its calls.
    let is_known =
        |check: &ResultCheck| match own.computed.get(check.variable.index()).copied().flatten() {
            Some(Computed::Register { before, .. }) => before == m,
            Some(Computed::Measured(_)) => path.is_known_by(check.result, m - 1) == Some(true),
            None => false,
        };
    let stops = path.formula.tolerance_checks().filter(|check| {
        let tolerance = path.formula.results[check.result].tolerance;
        tolerance.is_some_and(|tolerance| tolerance.action == ToleranceAction::Stop)
            && is_known(check)
    });
    let asked = CheckKind::StopTolerance;
    checks.extend(stops.map(|check| ResultCheck { asked, ..check }));
    (values, checks)
}
