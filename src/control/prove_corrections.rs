//! Proof that a program corrects tools as the job says: its end is run with numbers and sums of errors from earlier parts, and with results inside their limits.

use crate::control::Request;
use crate::control::corrections::ToolCorrection;
use crate::control::iso::machine::{ResultCheckpoint, Run};
use crate::control::iso::script::{Script, Slot};
use crate::control::trace::{Trace, WrittenValue};
use crate::formula::{ResultDef, ToleranceAction};
use crate::text::{Text, text};

/// Largest error of a change, in units of the program, besides that of its constants.
const EXACT: f64 = 1e-6;

/// Places of the tried results between their limits.
const PLACES: [f64; 6] = [0.02, 0.31, 0.49, 0.502, 0.77, 0.98];

/// Tried sums of errors, as shares of the largest.
const SUMS: [f64; 4] = [-0.9, 0.0, 0.2, 0.9];

/// A program that was traced: its script, the start of the run, and its state when the results have their values.
pub type Traced<'f, 't> = (&'f Script<'t>, Run, &'f ResultCheckpoint);

/// Checks every correction of a tool in a program, and that there are no others. A fault has its 0-based line, if it belongs to one.
pub fn corrections(
    request: &Request<'_>,
    trace: &Trace,
    traced: Traced<'_, '_>,
) -> Result<(), (Option<usize>, Text)> {
    let wanted = request.corrections();
    let known = |what: &WrittenValue| match what {
        WrittenValue::Offset(..) => true,
        WrittenValue::Tool(register) => wanted.iter().any(|own| own.register == *register),
    };
    if let Some(other) = trace.writes.iter().find(|own| !known(&own.what)) {
        return Err((
            Some(other.line),
            text!("this corrects a tool, and the job does not say so"),
        ));
    }
    for correction in &wanted {
        if correct(request, traced, correction).is_none() {
            let message = text!(
                "the program does not correct tool {tool} by the error of {code}",
                correction.wear.tool,
                request
                    .path
                    .formula
                    .code(&request.path.formula.results[correction.check.result])
                    .into_owned()
            );
            return Err((None, message));
        }
    }
    Ok(())
}

/// Smallest and largest value of a result that does not stop the program, in its units.
fn range(request: &Request<'_>, result: usize) -> [f64; 2] {
    let def = &request.path.formula.results[result];
    let unit = unit(request, def);
    let mut range = [f64::NEG_INFINITY, f64::INFINITY];
    for check in request.questions() {
        if check.result == result && check.stops(true) {
            range[0] = range[0].max((check.expected - check.limit) / unit);
            range[1] = range[1].min((check.expected + check.limit) / unit);
        }
    }
    range
}

fn unit(request: &Request<'_>, def: &ResultDef) -> f64 {
    match def.role.is_angle() {
        true => 1.0,
        false => request.scale,
    }
}

/// Checks one correction; `None` if it is another one. Most programs have none: their part of the module does not need it.
#[inline(never)]
fn correct(
    request: &Request<'_>,
    (script, run_start, tail): Traced<'_, '_>,
    correction: &ToolCorrection,
) -> Option<()> {
    let formula = &request.path.formula;
    let mut tail = tail.ending(script, run_start)?;
    let [kept, kept_sum] = correction
        .kept
        .each_ref()
        .map(|name| script.find(name.as_bytes()));
    let (kept, kept_sum) = (kept?, kept_sum?);
    let slot_of = |def: &ResultDef| {
        let code = formula.code(def);
        let mut outputs = script.outputs();
        outputs
            .find(|(own, _)| own.eq_ignore_ascii_case(&code))
            .map(|(_, slot)| slot)
    };
    // The other results are good, and their tools are not due.
    let mut values: Vec<(Slot, f64)> = Vec::new();
    for (result, def) in formula.results.iter().enumerate() {
        let Some(slot) = slot_of(def) else { continue };
        let [low, high] = range(request, result);
        let stops = def
            .tolerance
            .is_some_and(|own| own.action == ToleranceAction::Stop);
        let good = match stops {
            true => f64::midpoint(low, high),
            false => def.nominal / unit(request, def),
        };
        values.push((slot, good));
    }
    for other in request.corrections() {
        let [count, sum] = other
            .kept
            .each_ref()
            .map(|name| script.find(name.as_bytes()));
        values.extend([(count?, 0.0), (sum?, 0.0)]);
    }
    let own = slot_of(&formula.results[correction.check.result])?;
    let nominal = correction.check.expected / request.scale;
    let limit = correction.check.limit / request.scale;
    let band = correction.wear.dead_band / request.scale;
    let parts = f64::from(correction.parts);
    let [low, high] = range(request, correction.check.result);
    let mut run = |error: f64, [count, sum]: [f64; 2]| {
        let mut values = values.clone();
        values.extend([(own, nominal + error), (kept, count), (kept_sum, sum)]);
        tail.corrected(&values, correction.part(), [kept, kept_sum])
    };
    // The nominal value and the limits are rounded to the digits of a constant.
    let exact = EXACT + 2.0 * request.post.constant_error * nominal.abs();
    let near = |a: f64, b: f64| (a - b).abs() <= exact * (1.0 + b.abs());
    for before in [0.0, (parts - 2.0).max(0.0), parts - 1.0] {
        for (place, share) in PLACES.iter().flat_map(|place| SUMS.map(|sum| (place, sum))) {
            let error = low + (high - low) * place - nominal;
            let sum = before * limit * share;
            let mean = (sum + error) / parts;
            let due = before + 1.0 >= parts;
            if due && (mean.abs() - band).abs() < exact {
                continue;
            }
            let (change, [count, rest]) = run(error, [before, sum])?;
            let wanted = match due && mean.abs() > band {
                true => mean * correction.factor,
                false => 0.0,
            };
            let stored = match due {
                true => [0.0, 0.0],
                false => [before + 1.0, sum + error],
            };
            let right = near(change, wanted) && near(count, stored[0]) && near(rest, stored[1]);
            right.then_some(())?;
        }
    }
    // Values that the program does not store: it stops.
    let others = [
        [parts, 0.0],
        [parts + 3.0, limit],
        [0.0, 2.0 * limit],
        [1.0, -1.1 * limit - 1.0],
        [-1.0, 0.0],
    ];
    let middle = f64::midpoint(low, high) - nominal;
    others
        .iter()
        .all(|kept| run(middle, *kept).is_none())
        .then_some(())
}
