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
    let unit = request.unit_of(def);
    let mut range = [f64::NEG_INFINITY, f64::INFINITY];
    for check in request.questions() {
        if check.result == result && check.stops(true) {
            range[0] = range[0].max((check.expected - check.limit) / unit);
            range[1] = range[1].min((check.expected + check.limit) / unit);
        }
    }
    range
}

/// Checks one correction; `None` if it is another one. Most programs have none: their part of the module does not need it.
#[inline(never)]
fn correct(
    request: &Request<'_>,
    (script, run_start, tail): Traced<'_, '_>,
    correction: &ToolCorrection,
) -> Option<()> {
    let [count, sum] = kept(script, correction)?;
    let mut values = good_values(request, script);
    for other in request.corrections() {
        values.extend(kept(script, &other)?.map(|slot| (slot, 0.0)));
    }
    let own = slot_of(request, script, correction.check.result)?;
    let [low, high] = range(request, correction.check.result);
    let nominal = correction.check.expected / request.scale;
    let mut tail = tail.ending(script, run_start)?;
    let mut run = |error: f64, before: [f64; 2]| {
        let mut values = values.clone();
        values.extend([(own, nominal + error), (count, before[0]), (sum, before[1])]);
        tail.corrected(&values, correction.part(), [count, sum])
    };
    let expected = ExpectedCorrection::of(request, correction);
    for before in expected.tried() {
        for place in PLACES {
            let error = low + (high - low) * place - nominal;
            let Some(wanted) = expected.after(error, before) else {
                continue;
            };
            let (change, kept) = run(error, before)?;
            expected.agrees(wanted, (change, kept)).then_some(())?;
        }
    }
    let middle = f64::midpoint(low, high) - nominal;
    let stops = |kept: [f64; 2]| run(middle, kept).is_none();
    expected.foreign().into_iter().all(stops).then_some(())
}

/// Variables that keep number and sum of the errors.
fn kept(script: &Script<'_>, correction: &ToolCorrection) -> Option<[Slot; 2]> {
    let [count, sum] = &correction.kept;
    Some([script.find(count.as_bytes())?, script.find(sum.as_bytes())?])
}

/// Variable of a result.
fn slot_of(request: &Request<'_>, script: &Script<'_>, result: usize) -> Option<Slot> {
    let formula = &request.path.formula;
    let code = formula.code(&formula.results[result]);
    let mut outputs = script.outputs();
    outputs
        .find(|(own, _)| own.eq_ignore_ascii_case(&code))
        .map(|(_, slot)| slot)
}

/// Values with which no result stops the program.
fn good_values(request: &Request<'_>, script: &Script<'_>) -> Vec<(Slot, f64)> {
    let results = request.path.formula.results.iter().enumerate();
    let good = |(result, def): (usize, &ResultDef)| {
        let [low, high] = range(request, result);
        let stops = def
            .tolerance
            .is_some_and(|own| own.action == ToleranceAction::Stop);
        let value = match stops {
            true => f64::midpoint(low, high),
            false => def.nominal / request.unit_of(def),
        };
        Some((slot_of(request, script, result)?, value))
    };
    results.filter_map(good).collect()
}

/// What a correction gives, in units of the program.
struct ExpectedCorrection {
    limit: f64,
    band: f64,
    parts: f64,
    factor: f64,
    /// Largest error of a value: the nominal value and the limits are rounded to the digits of a constant.
    exact: f64,
}

impl ExpectedCorrection {
    fn of(request: &Request<'_>, correction: &ToolCorrection) -> Self {
        let nominal = correction.check.expected / request.scale;
        ExpectedCorrection {
            limit: correction.check.limit / request.scale,
            band: correction.wear.dead_band / request.scale,
            parts: f64::from(correction.parts),
            factor: correction.factor,
            exact: EXACT + 2.0 * request.post.constant_error * nominal.abs(),
        }
    }

    /// Numbers and sums of the errors of earlier parts.
    fn tried(&self) -> Vec<[f64; 2]> {
        let counts = [0.0, (self.parts - 2.0).max(0.0), self.parts - 1.0];
        let sums = |count: f64| SUMS.map(|share| [count, count * self.limit * share]);
        counts.into_iter().flat_map(sums).collect()
    }

    /// Values that the program does not store.
    fn foreign(&self) -> [[f64; 2]; 5] {
        [
            [self.parts, 0.0],
            [self.parts + 3.0, self.limit],
            [0.0, 2.0 * self.limit],
            [1.0, -1.1 * self.limit - 1.0],
            [-1.0, 0.0],
        ]
    }

    /// Change of the register, and the kept values, after a part with this error; `None` where rounding decides.
    fn after(&self, error: f64, [count, sum]: [f64; 2]) -> Option<(f64, [f64; 2])> {
        if count + 1.0 < self.parts {
            return Some((0.0, [count + 1.0, sum + error]));
        }
        let mean = (sum + error) / self.parts;
        if (mean.abs() - self.band).abs() < self.exact {
            return None;
        }
        let change = match mean.abs() > self.band {
            true => mean * self.factor,
            false => 0.0,
        };
        Some((change, [0.0, 0.0]))
    }

    fn agrees(&self, wanted: (f64, [f64; 2]), given: (f64, [f64; 2])) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= self.exact * (1.0 + b.abs());
        let [count, sum] = [0, 1].map(|i| near(given.1[i], wanted.1[i]));
        near(given.0, wanted.0) && count && sum
    }
}
