//! Verdicts of 1411, the rows for single touches, and the form error.

use crate::cycle::heidenhain::two_circles::{Object, PositionSource, TwoCircles};
use crate::formula::{CircleFit, ResultRow, Unit, fit_circle};
use crate::geom::{Vec2, Vec3};
use crate::path::{Path, ProbeSettings};
use crate::text::{Text, text, words};
use crate::tolerance::Nominal;

/// Adds verdicts, Q183, the deviations of the extrusion, and the form error of each circle (our addition).
pub fn judge(
    cycle: &TwoCircles,
    setup: &ProbeSettings,
    path: &Path,
    triggers: &[Option<Vec3>],
    rows: &mut Vec<ResultRow>,
) {
    let objects = cycle.objects();
    let mut worst: Option<i32> = None;
    // Whether every toleranced value was measured.
    let mut whole = true;
    for object in &objects {
        let codes = [["Q950", "Q951", "Q952"], ["Q953", "Q954", "Q955"]][object.number - 1];
        for (_, (code, value)) in codes
            .iter()
            .zip(&object.point)
            .enumerate()
            .filter(|(axis, _)| object.measures(*axis))
        {
            whole &= give(rows, code, value, false, object.hole, &mut worst);
        }
        if object.state != PositionSource::Entered {
            whole &= give(
                rows,
                ["Q966", "Q967"][object.number - 1],
                &object.diameter,
                true,
                object.hole,
                &mut worst,
            );
        }
    }
    rows.push(if whole {
        workpiece(worst, cycle.form.error_reaction)
    } else {
        unknown()
    });
    for object in objects.iter().filter(|o| o.state == PositionSource::Probed) {
        single_rows(cycle, object, setup, path, triggers, rows);
    }
}

/// Verdict of one value: 0 good, 1 rework, 2 scrap; a value at a limit is good. Returns whether all values for it are known.
fn give(
    rows: &mut [ResultRow],
    code: &str,
    value: &Nominal,
    size: bool,
    hole: bool,
    worst: &mut Option<i32>,
) -> bool {
    /// In mm. A value at the limit is good: the last decimals of the touches, magnified by a short arc, decide nothing. No control displays so little.
    const LIMIT: f64 = 1e-6;
    let Some((low, high)) = value.limits else {
        return true;
    };
    let Some(row) = rows.iter_mut().find(|r| r.code == code) else {
        return true;
    };
    row.limits = Some((low, high));
    let Some(measured) = row.value else {
        return false;
    };
    let verdict = if measured < low - LIMIT {
        if size && hole { 1 } else { 2 }
    } else if measured > high + LIMIT {
        if size && !hole { 1 } else { 2 }
    } else {
        0
    };
    row.verdict = Some(word(verdict));
    *worst = Some(worst.map_or(verdict, |w| w.max(verdict)));
    true
}

/// Q183 if a toleranced value was not measured.
fn unknown() -> ResultRow {
    let mut row = row("Q183", words!("Workpiece status"), Unit::None, 0.0);
    row.value = None;
    row.with_verdict(text!("unknown: a value with a tolerance was not measured"))
}

/// Q183 and the reaction by Q309.
fn workpiece(worst: Option<i32>, reaction: i32) -> ResultRow {
    let status = worst.unwrap_or(-1);
    let stops = match reaction {
        1 => status > 0,
        2 => status == 2,
        _ => false,
    };
    let verdict = if stops {
        text!(
            "{status}: the control stops and shows the results",
            word(status)
        )
    } else {
        text!("{status}: the program continues", word(status))
    };
    row(
        "Q183",
        words!("Workpiece status"),
        Unit::None,
        f64::from(status),
    )
    .with_verdict(verdict)
}

/// Word for a status.
fn word(status: i32) -> Text {
    match status {
        0 => text!("good"),
        1 => text!("rework"),
        2 => text!("scrap"),
        _ => text!("undefined"),
    }
}

/// Form error of one circle; with an extrusion also the largest deviations of its single circles.
fn single_rows(
    cycle: &TwoCircles,
    object: &Object,
    setup: &ProbeSettings,
    path: &Path,
    triggers: &[Option<Vec3>],
    rows: &mut Vec<ResultRow>,
) {
    let i = object.number - 1;
    let [a, o, _] = setup.plane.axes();
    let repeats = cycle.repeats().len();
    let own: Vec<Option<Vec3>> = path
        .touches
        .iter()
        .zip(triggers)
        .filter(|(t, _)| t.group == i)
        .map(|(_, trigger)| *trigger)
        .collect();
    // Circle j goes through the j-th touch of every sample.
    let circle = |j: usize| -> Option<(Vec<Vec2>, CircleFit)> {
        let points: Option<Vec<Vec2>> = own
            .iter()
            .skip(j)
            .step_by(repeats)
            .map(|t| t.map(|p| Vec2::new(p[a], p[o])))
            .collect();
        let points = points?;
        let fit = fit_circle(&points)?;
        Some((points, fit))
    };
    let circles: Option<Vec<_>> = (0..repeats).map(circle).collect();
    let form_error = circles.as_ref().map(|circles| {
        let spread = |(points, fit): &(Vec<Vec2>, CircleFit)| {
            let far: Vec<f64> = points.iter().map(|p| p.distance(fit.center)).collect();
            far.iter().copied().fold(f64::MIN, f64::max)
                - far.iter().copied().fold(f64::MAX, f64::min)
        };
        circles.iter().map(spread).fold(0.0, f64::max)
    });
    if cycle.extrusion.is_some() {
        let shifts = cycle.repeats();
        let place = object.place().unwrap_or_default();
        let largest = |f: &dyn Fn(usize, &CircleFit) -> f64| {
            circles.as_ref().map(|circles| {
                circles
                    .iter()
                    .enumerate()
                    .map(|(j, (_, fit))| f(j, fit))
                    .fold(0.0, f64::max)
            })
        };
        let off = largest(&|j, fit| {
            fit.center
                .distance(Vec2::new(place[0] + shifts[j][0], place[1] + shifts[j][1]))
        });
        let wide = largest(&|_, fit| {
            (2.0 * (fit.radius + object.outward() * setup.radius) - object.nominal_diameter()).abs()
        });
        let centre = [
            words!("Largest deviation from centre 1"),
            words!("Largest deviation from centre 2"),
        ][i];
        let diameter = [
            words!("Largest deviation from diameter 1"),
            words!("Largest deviation from diameter 2"),
        ][i];
        rows.push(maybe(["Q970", "Q971"][i], centre, off));
        rows.push(maybe(["Q973", "Q974"][i], diameter, wide));
    }
    let meaning = [
        words!("Form error of circle 1 (Touchpath's own)"),
        words!("Form error of circle 2 (Touchpath's own)"),
    ][i];
    rows.push(maybe(["form1", "form2"][i], meaning, form_error));
}

fn maybe(code: &str, meaning: &'static str, value: Option<f64>) -> ResultRow {
    let mut row = row(code, meaning, Unit::Length, 0.0);
    row.nominal = Some(0.0);
    row.value = value.map(crate::num::tidy);
    row.deviation = row.value;
    row
}

fn row(code: &str, meaning: &'static str, unit: Unit, value: f64) -> ResultRow {
    ResultRow {
        code: code.to_owned(),
        meaning: Text::words(meaning),
        unit,
        nominal: None,
        value: Some(value),
        deviation: None,
        uncertainty: None,
        uncertainty_runout: None,
        limits: None,
        verdict: None,
        truth: None,
    }
}

impl ResultRow {
    fn with_verdict(mut self, verdict: Text) -> Self {
        self.verdict = Some(verdict);
        self
    }
}
