//! What a program of native cycles does with the results of its calls: each call returns those of the nominal part, or one of them too far off.

use crate::control::Request;
use crate::control::iso::machine::{self, CallsState, Run};
use crate::control::iso::script::{Script, Slot};
use crate::control::native_run::NativeCycles;
use crate::control::trace::{Place, Step, Trace};
use crate::geom::Vec3;
use crate::path::{CallBlock, CallSequence, LINK_STEP, Path, Stored};

/// Results of the native cycles on the nominal part, by the calls of a program, in its units.
pub fn measured(request: &Request<'_>, script: &Script<'_>) -> Vec<Vec<(Slot, f64)>> {
    match (&request.path.calls, request.post.own) {
        (Some(calls), Some(own)) => measured_by(request, script, (calls, own)),
        _ => Vec::new(),
    }
}

#[inline(never)]
fn measured_by(
    request: &Request<'_>,
    script: &Script<'_>,
    (calls, own): (&CallSequence, &NativeCycles),
) -> Vec<Vec<(Slot, f64)>> {
    let path = request.path;
    // For each call the variables in which its outputs are saved.
    let mut saved: Vec<Vec<(Stored, Stored)>> = Vec::new();
    for (block, _) in &calls.blocks {
        match block {
            CallBlock::Cycle(..) => saved.push(Vec::new()),
            CallBlock::SaveResult(variable, entry) => {
                let one = (Stored::Kept(*variable), Stored::Output(*entry));
                saved.last_mut().into_iter().for_each(|own| own.push(one));
            }
            _ => {}
        }
    }
    let kept = path.kept();
    let last = saved.len();
    let of_call = |(call, saved): (usize, &Vec<(Stored, Stored)>)| {
        let given = kept.iter().filter_map(|(result, stored)| {
            let output = match stored {
                Stored::Output(_) => (call + 1 == last).then_some(*stored),
                Stored::Kept(_) => saved
                    .iter()
                    .find(|(kept, _)| kept == stored)
                    .map(|(_, output)| *output),
            };
            let slot = script.find((own.name)(output?).as_bytes())?;
            Some((slot, nominal(request, *result)))
        });
        given.collect()
    };
    saved.iter().enumerate().map(of_call).collect()
}

/// Nominal value of a result, in units of the program.
fn nominal(request: &Request<'_>, result: usize) -> f64 {
    let def = &request.path.formula.results[result];
    def.nominal / request.unit_of(def)
}

/// Whether a program stops without writing before it moves to a cycle of a set-up, if a result that the cycle follows deviates by `off`, mm or degrees. The
/// outputs of the earlier calls are changed one after the other until the result deviates so far. `near` compares a position of the program with one of the path.
#[inline(never)]
pub fn stops_before(
    request: &Request<'_>,
    (script, run_start, trace): (&Script<'_>, Run, &Trace),
    near: &dyn Fn(Place, Vec3) -> bool,
    (member, result, off): (usize, usize, f64),
) -> bool {
    /// A value of a relation is not linear in its operands.
    const ROUNDS: usize = 8;
    /// Smaller slopes belong to outputs that the result does not depend on.
    const STILL: f64 = 1e-6;
    let path = request.path;
    let Some(slot) = slot_of(request, script, result) else {
        return false;
    };
    let (wanted, off) = (
        nominal(request, result),
        off / request.unit_of(&path.formula.results[result]),
    );
    let mut tried = script.clone();
    let mut run = |(call, output): (usize, usize), by: f64| -> CallsState {
        let before = tried.measured[call][output].1;
        tried.measured[call][output].1 += by;
        let state = machine::after_calls(&tried, run_start, slot);
        tried.measured[call][output].1 = before;
        state
    };
    let calls = calls_before(path, member);
    let motions = motions_to_stand(path, member, trace.after_native(calls), near);
    let outputs = script.measured.iter().take(calls).enumerate();
    let outputs = outputs.flat_map(|(call, own)| (0..own.len()).map(move |output| (call, output)));
    let mut asked = false;
    for output in outputs {
        let each = (run(output, 1e-3 * off).value - wanted) / (1e-3 * off);
        if each.is_nan() || each.abs() < STILL {
            continue;
        }
        let mut by = off / each;
        for _ in 0..ROUNDS {
            let reached = run(output, by).value - wanted;
            if !reached.is_finite() || (reached - off).abs() < 1e-9 {
                break;
            }
            by *= off / reached;
        }
        let state = run(output, by);
        if (state.value - wanted - off).abs() > 0.01 * off.abs() {
            continue;
        }
        asked = true;
        let in_time = state.calls < calls || state.calls == calls && state.motions <= motions;
        if !(state.alarm && !state.writes && in_time) {
            return false;
        }
    }
    asked
}

/// Variable of a result.
fn slot_of(request: &Request<'_>, script: &Script<'_>, result: usize) -> Option<Slot> {
    let (own, calls) = (request.post.own?, request.path.calls.as_ref()?);
    let variable = request.path.formula.results[result].variable?;
    let stored = calls.stored_value(variable.index())?;
    script.find((own.name)(stored).as_bytes())
}

/// Number of motions after the last call before a member, up to the position at which its cycle ends.
fn motions_to_stand<'a>(
    path: &Path,
    member: usize,
    steps: impl Iterator<Item = &'a Step>,
    near: &dyn Fn(Place, Vec3) -> bool,
) -> usize {
    let made = path.cycles[member].moves.start;
    let mut moves = path.moves[..made].iter().rev();
    let Some(last) = moves.find(|step| step.step != LINK_STEP) else {
        return 0;
    };
    // The last of the motions there may have no length.
    let mut there = false;
    let motions = steps.take_while(|step| {
        let near = near(step.to, last.to);
        let leaves = there && !near;
        there |= near;
        !leaves
    });
    motions.count()
}

/// Number of calls before a member.
fn calls_before(path: &Path, member: usize) -> usize {
    let members = path.cycles[..member].iter();
    let blocks = members.flat_map(|own| own.path.calls.iter().flat_map(|own| &own.blocks));
    blocks
        .filter(|(block, _)| matches!(block, CallBlock::Cycle(..)))
        .count()
}
