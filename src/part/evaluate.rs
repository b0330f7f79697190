//! Results of the control from the triggers: values, deviations, uncertainties.

use crate::formula::{Dual, Formula, ResultRow, Role, Unit, Variable};
use crate::geom::{Plane, Vec3};
use crate::num::{tidy, wrap_degrees};
use crate::part::PartPlacement;
use crate::path::Path;
use crate::text::{Text, text};

/// Sources of uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UncertaintySources {
    /// Standard deviation of each touch along its probing direction, mm.
    pub repeatability: f64,
    /// Eccentricity of the ball from the spindle axis, mm: at an unknown angle, the same for all touches of a program. `None` is ignored.
    pub runout: Option<f64>,
}

/// Results for ball centres at these triggers.
pub fn evaluate(
    path: &Path,
    triggers: &[Option<Vec3>],
    scatter: UncertaintySources,
) -> Vec<ResultRow> {
    let samples = samples(path, triggers);
    let values = values(path, &samples);
    path.formula
        .results
        .iter()
        .map(|def| {
            let dual = def
                .variable
                .map(|v| &values[v.index()])
                .filter(|d| d.value.is_finite());
            // They vanish on a good part, and no derivative describes their growth.
            let spread = dual.filter(|_| !matches!(def.role, Role::Residual | Role::Spread));
            let runout = spread
                .zip(scatter.runout)
                .map(|(d, runout)| runout * of_runout(path, &samples, d));
            let touches = spread.map(|d| d.uncertainty(scatter.repeatability));
            ResultRow {
                code: def.code.to_owned(),
                meaning: Text::words(def.meaning),
                unit: if def.role.is_angle() {
                    Unit::Angle
                } else {
                    Unit::Length
                },
                nominal: Some(def.nominal),
                value: dual.map(|d| tidy(d.value)),
                deviation: dual
                    .map(|d| tidy(d.value - def.reference))
                    .filter(|d| d.is_finite()),
                uncertainty: touches
                    .map(|touches| runout.map_or(touches, |runout| touches.hypot(runout))),
                uncertainty_runout: runout,
                limits: None,
                verdict: None,
                truth: None,
            }
        })
        .collect()
}

/// Standard deviation of a result for a ball centre 1 mm off the spindle axis, with all angles equally likely. With the ball at an angle φ, the machine is off
/// by (cos φ, sin φ) at every contact: the error of a touch along v is v·(cos φ, sin φ). All touches share the angle, so their contributions add up before they are
/// squared: the variance is half the sum of the squares along both axes of the plane.
fn of_runout(path: &Path, samples: &[Sample], result: &Dual) -> f64 {
    // The derivative is by the scatter of a mean; the eccentricity shifts all its touches equally.
    let slopes = result
        .by_samples()
        .flat_map(|(first, by_touch)| samples.iter().skip(first).zip(by_touch));
    let slopes: Vec<(&Sample, f64)> = slopes
        .map(|(sample, by_touch)| (sample, by_touch * (sample.count as f64).sqrt()))
        .collect();
    let along = |axis: Vec3| -> f64 {
        slopes
            .iter()
            .map(|(sample, whole)| whole * sample.direction.dot(axis))
            .sum()
    };
    tidy(along(path.frame.u).hypot(along(path.frame.v)) / std::f64::consts::SQRT_2)
}

/// Results that a control computed: `values` of the formula's results, mm or degrees, with the uncertainty of the touches on the nominal part.
pub fn stated(
    path: &Path,
    radius: f64,
    scatter: UncertaintySources,
    values: &[Option<f64>],
) -> Vec<ResultRow> {
    let nominal: Vec<Option<Vec3>> = path
        .touches
        .iter()
        .map(|touch| Some(touch.contact(radius)))
        .collect();
    let mut rows = evaluate(path, &nominal, scatter);
    for ((row, def), value) in rows.iter_mut().zip(&path.formula.results).zip(values) {
        row.value = value.map(tidy);
        row.deviation = value.map(|value| tidy(value - def.reference));
        row.uncertainty = row.uncertainty.filter(|_| value.is_some());
        row.uncertainty_runout = row.uncertainty_runout.filter(|_| value.is_some());
    }
    rows
}

/// Measured coordinates of the point that corrects a work offset: abscissa, ordinate and tool axis, mm; `None` if not measured.
pub fn datum(path: &Path, triggers: &[Option<Vec3>]) -> [Option<f64>; 3] {
    let Some(datum) = &path.formula.datum else {
        return [None; 3];
    };
    let values = values(path, &samples(path, triggers));
    let of =
        |variable: Variable| Some(values[variable.index()].value).filter(|value| value.is_finite());
    datum.place.map(|place| place?.measured.and_then(of))
}

/// Values of all assignments, mm or degrees; NaN if a necessary touch made no contact.
pub fn numbers(path: &Path, triggers: &[Option<Vec3>]) -> Vec<f64> {
    values(path, &samples(path, triggers))
        .into_iter()
        .map(|value| value.value)
        .collect()
}

/// Value of every assignment of the formula.
fn values(path: &Path, samples: &[Sample]) -> Vec<Dual> {
    let points: Vec<Option<Vec3>> = samples.iter().map(|s| s.point).collect();
    // The mean of n touches scatters by 1/√n of a single touch.
    let directions: Vec<Vec3> = samples
        .iter()
        .map(|s| s.direction / (s.count as f64).sqrt())
        .collect();
    path.formula.evaluate(&points, &directions)
}

/// One sample of the formula.
struct Sample {
    point: Option<Vec3>,
    direction: Vec3,
    count: usize,
}

/// Means of the touches of each sample; `None` if a touch is missing.
fn samples(path: &Path, triggers: &[Option<Vec3>]) -> Vec<Sample> {
    let mut samples: Vec<Sample> = Vec::new();
    for (touch, trigger) in path.touches.iter().zip(triggers) {
        if touch.sample == samples.len() {
            samples.push(Sample {
                point: Some(Vec3::ZERO),
                direction: touch.vector,
                count: 0,
            });
        }
        let sample = &mut samples[touch.sample];
        sample.point = sample.point.zip(*trigger).map(|(sum, p)| sum + p);
        sample.count += 1;
    }
    for sample in &mut samples {
        sample.point = sample.point.map(|sum| sum / sample.count as f64);
    }
    samples
}

/// Adds the true values of the actual part to the rows. `actual` is the formula of the resized feature at its nominal position, so that its nominal values only
/// have to be moved with the part.
pub fn add_true_values(
    rows: &mut [ResultRow],
    actual: &Formula,
    plane: Plane,
    place: Vec3,
    placement: &PartPlacement,
) {
    let [a, o, w] = plane.axes();
    let mut point = place;
    for (i, (row, def)) in rows.iter_mut().zip(&actual.results).enumerate() {
        let truth = match def.role {
            Role::Abscissa => {
                // The ordinate of the same point follows.
                let mut nominal = Vec3::ZERO;
                nominal[a] = def.nominal;
                nominal[o] = actual.results[i..]
                    .iter()
                    .find(|r| r.role == Role::Ordinate)
                    .map_or(0.0, |r| r.nominal);
                nominal[w] = place[w];
                point = placement.rigid.point(nominal);
                point[a]
            }
            Role::Ordinate => point[o],
            Role::Size | Role::Angle => def.nominal,
            // A control may give a direction a whole turn away.
            Role::Direction => {
                let truth = wrap_degrees(def.nominal + placement.turn);
                row.value.map_or(truth, |value| {
                    truth + ((value - truth) / 360.0).round() * 360.0
                })
            }
            Role::Level => {
                let mut nominal = place;
                nominal[w] = def.nominal;
                placement.rigid.point(nominal)[w]
            }
            Role::Height
            | Role::Reading
            | Role::Shift
            | Role::Turn
            | Role::Residual
            | Role::Spread => continue,
        };
        row.truth = Some(tidy(truth));
    }
}

/// Adds rows for the shift of the work offset that the program would write: measured minus nominal.
pub fn write_offset(rows: &mut Vec<ResultRow>, formula: &Formula, plane: Plane, name: &str) {
    let Some(datum) = formula.datum.as_ref().filter(|datum| !datum.in_results) else {
        return;
    };
    let axes = plane.axes();
    for (i, code) in ["offset.x", "offset.y", "offset.z"].into_iter().enumerate() {
        let Some(variable) = datum.place[i].and_then(|place| place.measured) else {
            continue;
        };
        let Some(at) = formula
            .results
            .iter()
            .position(|r| r.variable == Some(variable))
        else {
            continue;
        };
        let (row, nominal) = (&rows[at], formula.results[at].nominal);
        let meaning = text!(
            "Shift of {offset} in {axis} that the program writes",
            name.to_owned(),
            crate::geom::AXIS_NAMES[axes[i]]
        );
        let row = ResultRow {
            code: code.to_owned(),
            meaning,
            nominal: Some(0.0),
            value: row.deviation,
            truth: row.truth.map(|t| tidy(t - nominal)),
            // A tolerance limits the position, not the shift.
            limits: None,
            verdict: row.verdict.clone().filter(|_| row.limits.is_none()),
            ..row.clone()
        };
        rows.push(row);
    }
}
