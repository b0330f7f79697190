//! Write of a set-up: the result for each axis of the work offset and its rotation, and the resulting shift.

use crate::form::{Checker, Section, Value};
use crate::formula::Role;
use crate::geom::AXIS_NAMES;
use crate::job::cycles::DATUM;
use crate::job::planned::PlannedJob;
use crate::job::rows::{DatumRow, ResultRow, ResultWords};
use crate::num::tidy;
use crate::path::{DatumSource, Path, ResultSource};
use crate::text::{Text, text, words};

/// A result that an axis of the work offset, or its rotation, can be written from.
struct Candidate {
    /// The cycle or relation that measures it.
    of: usize,
    /// Its name: `BORE.center.x`.
    named: String,
    /// Index of the result.
    result: usize,
}

/// Sources of the written axes: as the job states. By default the first cycle that measures the axis, for abscissa and ordinate one that measures both. A
/// rotation is written on request only. `only_last`: whether no other cycle can write.
pub fn read(
    checker: &mut Checker,
    value: &Value,
    path: &Path,
    only_last: bool,
) -> Option<DatumSource> {
    let given = value.given("datum");
    checker.object(given, "datum")?;
    Section::new(checker, given, "datum").only(&[], &DATUM);
    let mut written = DatumSource::default();
    let last = path.cycles.len() - 1;
    for (axis, key) in DATUM.into_iter().enumerate() {
        let path_of = format!("datum.{key}");
        let said = given.and_then(|datum| datum.get(key));
        if said.is_none() && axis < 3 {
            written.place[axis] = proposed(
                path,
                axis,
                if only_last {
                    last..last + 1
                } else {
                    0..last + 1
                },
            );
            continue;
        }
        let found = match said {
            None | Some(Value::Null) => continue,
            Some(said) => checker.text(said, &path_of).and_then(|text| {
                let mut all = candidates(path, axis);
                let at = all
                    .iter()
                    .position(|known| known.named.eq_ignore_ascii_case(text));
                if at.is_none() {
                    checker.error("datum-unknown", &*path_of, unknown_datum(text, axis, &all));
                }
                at.map(|at| all.swap_remove(at))
            }),
        };
        match axis {
            3 => written.rotation = found.map(|found| found.result),
            _ => written.place[axis] = found.map(|found| found.of),
        }
    }
    let name = |of: usize| {
        path.measuring()
            .nth(of)
            .map_or_else(String::new, |own| own.name.to_owned())
    };
    if written.rotation.is_some() && written.place[0] != written.place[1] {
        let source = |axis: usize| written.place[axis].map_or_else(|| "-".to_owned(), name);
        let message = text!(
            "With a rotation, X and Y must come from the same point: take both from one cycle, not from {one} and {other}",
            source(0),
            source(1)
        );
        checker.error("datum-apart", "datum", message);
    }
    (!checker.failed()).then_some(written)
}

/// Checks the write of native cycles: each writes immediately after measuring, and everything that it measures. `only_last`: whether no other cycle can write.
pub fn check_own(
    checker: &mut Checker,
    (path, members): (&Path, &[PlannedJob]),
    written: &DatumSource,
    only_last: bool,
) -> Option<()> {
    let moves = members[0].job.post.moves();
    let name = |member: usize| path.cycles[member].name.clone();
    let early = written
        .place
        .iter()
        .flatten()
        .find(|member| only_last && **member + 1 < members.len());
    if let Some(early) = early {
        let early = name(*early);
        let message = match moves {
            true => text!(
                "Native cycles write right after measuring: the write of {early} would shift everything that is measured after it. Only the last cycle of a set-up may write: put it last, or use the form \"moves\"",
                early
            ),
            false => text!(
                "Native cycles write right after measuring: the write of {early} would shift everything that is measured after it. Only the last cycle of a set-up may write: put it last",
                early
            ),
        };
        checker.error("set-up-unsupported", "datum", message);
    }
    // A macro writes measured less nominal, and takes the position that it follows for the nominal one.
    let last = path.cycles.len() - 1;
    let followed = written.place.iter().enumerate().find(|(i, of)| {
        let axis = members[0].job.setup.plane.axes()[*i];
        only_last && **of == Some(last) && path.cycles[last].placing.follows_axis(axis)
    });
    if let Some((i, _)) = followed {
        let axis = AXIS_NAMES[members[0].job.setup.plane.axes()[i]];
        let message = text!(
            "{cycle} follows a result along {axis} and writes it: its macro would write the deviation from the followed position. Let it follow nothing along that axis, or write nothing",
            name(last),
            axis
        );
        checker.error("place-of-result", "datum", message);
    }
    // Such a cycle writes everything that it measures, whatever the job states.
    let axes = members[0].job.setup.plane.axes();
    for (m, planned) in members.iter().enumerate() {
        if !(written.place.contains(&Some(m)) || only_last && m + 1 == members.len()) {
            continue;
        }
        let datum = planned.path.formula.datum.as_ref();
        let measured = datum.map_or([false; 3], |datum| datum.measured());
        let unwanted: Vec<&str> = (0..3)
            .filter(|i| measured[*i] && written.place[*i] != Some(m))
            .map(|i| AXIS_NAMES[axes[i]])
            .collect();
        if unwanted.is_empty() {
            continue;
        }
        let (name, axes) = (name(m), unwanted.join(", "));
        let message = match moves {
            true => text!(
                "The native cycle of {name} writes everything that it measures, {axes} too: let it write them, choose no work offset, or use the form \"moves\"",
                name,
                axes
            ),
            false => text!(
                "The native cycle of {name} writes everything that it measures, {axes} too: let it write them, or choose no work offset",
                name,
                axes
            ),
        };
        checker.error("set-up-unsupported", "datum", message);
    }
    if written.rotation.is_some() {
        let message = match moves {
            true => {
                text!(
                    "Native cycles write no rotation that another cycle has measured: use the form \"moves\""
                )
            }
            false => {
                text!("Native cycles write no rotation that another cycle has measured")
            }
        };
        checker.error("set-up-unsupported", "datum.rotation", message);
    }
    (!checker.failed()).then_some(())
}

fn unknown_datum(text: &str, axis: usize, all: &[Candidate]) -> Text {
    let shown: String = text.chars().take(40).collect();
    let known: Vec<&str> = all.iter().map(|known| known.named.as_str()).collect();
    let what = Text::words(
        [
            words!("X"),
            words!("Y"),
            words!("Z"),
            words!("the rotation"),
        ][axis],
    );
    match known.is_empty() {
        true => text!(
            "No result of this set-up can be written into {axis}, including \"{name}\"",
            what,
            shown
        ),
        false => text!(
            "\"{name}\" cannot be written into {axis}: possible are {known}",
            shown,
            what,
            known.join(", ")
        ),
    }
}

/// Results that an axis of the work offset, or its rotation, can be written from.
fn candidates(path: &Path, axis: usize) -> Vec<Candidate> {
    let of = |(of, own): (usize, ResultSource<'_>)| {
        let measured = own
            .datum
            .and_then(|datum| datum.place.get(axis).copied().flatten()?.measured);
        let fits = move |index: &usize| {
            let result = &path.formula.results[*index];
            match axis {
                3 => result.role == Role::Direction && result.variable.is_some(),
                _ => measured.is_some() && result.variable == measured,
            }
        };
        let found = own.results.filter(fits).map(|index| {
            let result = &path.formula.results[index];
            Candidate {
                of,
                named: format!("{}.{}", own.name, result.code),
                result: index,
            }
        });
        found.collect::<Vec<_>>()
    };
    // Native cycles write what they measure, but no relation.
    let first = path.cycles.first();
    let count = if first.is_some_and(|own| own.path.calls.is_some()) {
        path.cycles.len()
    } else {
        usize::MAX
    };
    path.measuring()
        .take(count)
        .enumerate()
        .flat_map(of)
        .collect()
}

/// Default source of an axis: the first of these cycles that measures both axes of the plane, else the first that measures the axis.
fn proposed(path: &Path, axis: usize, of: std::ops::Range<usize>) -> Option<usize> {
    let all: Vec<[bool; 3]> = path
        .measuring()
        .map(|own| {
            own.datum
                .as_ref()
                .map_or([false; 3], crate::formula::OffsetCorrection::measured)
        })
        .collect();
    let both = || of.clone().find(|i| all[*i][0] && all[*i][1]);
    let first = || of.clone().find(|i| all[*i][axis]);
    let found = if axis < 2 {
        both().or_else(first)
    } else {
        first()
    };
    found.filter(|i| all[*i][axis])
}

/// Rows for the write: deviations of the measured position and rotation from nominal.
pub fn written_rows(whole: &PlannedJob, results: &[ResultRow]) -> Vec<ResultRow> {
    let (job, path) = (&whole.job, &whole.path);
    let (Some(number), Some(datum)) = (job.work_offset, &path.formula.datum) else {
        return Vec::new();
    };
    let offset = (job.post.work_offset_word)(number);
    let row = |result: usize| {
        let def = &path.formula.results[result];
        results
            .iter()
            .find(|row| Some(row.cycle) == path.measured_by(def) && row.code == def.code)
    };
    let mut rows: Vec<ResultRow> = Vec::new();
    for (i, code) in ["offset.x", "offset.y", "offset.z"].into_iter().enumerate() {
        let Some(measured) = datum.place[i].and_then(|place| place.measured) else {
            continue;
        };
        let source = path
            .formula
            .results
            .iter()
            .position(|result| result.variable == Some(measured));
        let Some(source) = source.and_then(row) else {
            continue;
        };
        let axis = AXIS_NAMES[job.setup.plane.axes()[i]];
        rows.push(shift(
            source,
            code,
            text!(
                "Shift of {offset} in {axis} that the program writes",
                offset.clone(),
                axis
            ),
        ));
    }
    if datum.rotation.is_some()
        && let Some(source) = path.datum_source.rotation.and_then(row)
    {
        let turn = shift(
            source,
            "offset.rotation",
            text!("Rotation of {offset} that the program writes", offset),
        );
        let at = |code: &str| rows.iter().position(|row| row.code == code);
        if let (Some(x), Some(y)) = (at("offset.x"), at("offset.y")) {
            let place = [0, 1].map(|i| {
                let source = datum.place[i].and_then(|place| place.measured);
                let source = path
                    .formula
                    .results
                    .iter()
                    .position(|result| result.variable == source);
                source
                    .and_then(row)
                    .and_then(|row| row.nominal)
                    .unwrap_or(0.0)
            });
            for (i, at) in [x, y].into_iter().enumerate() {
                turned(&mut rows[at], i, place, &turn);
            }
        }
        rows.push(turn);
    }
    rows
}

/// Corrects the shift of the origin for a rotation that is written with it. The origin is measured minus nominal, rotated: the rotation moves an origin that is
/// far from the measured position.
fn turned(row: &mut ResultRow, axis: usize, [x, y]: [f64; 2], turn: &ResultRow) {
    // Movement of the nominal position by a rotation about the origin.
    let moved = |turn: f64| {
        let (sin, cos) = turn.to_radians().sin_cos();
        [x * cos - y * sin - x, x * sin + y * cos - y][axis]
    };
    let less = |value: Option<f64>, turn: Option<f64>| {
        value
            .zip(turn)
            .map(|(value, turn)| tidy(value - moved(turn)))
    };
    (row.value, row.truth) = (less(row.value, turn.value), less(row.truth, turn.truth));
    row.deviation = row.value;
    // Both scatter; from touches of one cycle they are correlated, which rows do not show.
    let arm = [y, x][axis].abs().to_radians();
    let apart = row.cycle != turn.cycle;
    row.uncertainty = match (row.uncertainty, turn.uncertainty) {
        (own, _) if arm == 0.0 => own,
        (Some(own), Some(turn)) if apart => Some(own.hypot(arm * turn)),
        _ => None,
    };
}

/// Deviation of a result from nominal, as a separate row.
fn shift(source: &ResultRow, code: &str, meaning: Text) -> ResultRow {
    let truth = source
        .truth
        .zip(source.nominal)
        .map(|(truth, nominal)| tidy(truth - nominal));
    // A tolerance limits the position, not the shift.
    let verdict = source
        .said
        .verdict
        .clone()
        .filter(|_| source.limits.is_none());
    ResultRow {
        code: code.to_owned(),
        meaning: meaning.english(),
        nominal: Some(0.0),
        value: source.deviation,
        truth,
        note: None,
        stored: None,
        limits: None,
        verdict: verdict.as_ref().map(Text::english),
        said: ResultWords {
            meaning,
            verdict,
            note: None,
        },
        ..source.clone()
    }
}

/// Possible sources of each axis, and the used one.
pub fn datum_rows(whole: &PlannedJob) -> Vec<DatumRow> {
    let (path, source) = (&whole.path, whole.path.datum_source);
    if path.cycles.is_empty() {
        return Vec::new();
    }
    let row = |(i, axis): (usize, &'static str)| {
        let all = candidates(path, i);
        let is = |known: &&Candidate| match i {
            3 => source.rotation == Some(known.result),
            _ => source.place[i] == Some(known.of),
        };
        let from = all.iter().find(is).map(|known| known.named.clone());
        DatumRow {
            axis,
            from,
            choices: all.into_iter().map(|known| known.named).collect(),
        }
    };
    DATUM.into_iter().enumerate().map(row).collect()
}
