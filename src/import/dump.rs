//! Turns a dump of CmdPrm codes, exported here or copied from a log, into a job.
//!
//! [`codes`](crate::import::codes) finds the codes.

use std::collections::BinaryHeap;

use crate::cycle::{CYCLES, CycleDef, Pick, code_of, only_angular};
use crate::form::{Checker, Field, Kind, Section, Value};
use crate::geom::{Plane, Vec3};
use crate::import::codes::{Entry, entries};
use crate::import::{Imported, set};
use crate::job::JobError;
use crate::job::{default_job, job_name};
use crate::path::{Accessor, MAX_TOUCHES};
use crate::text::text;

/// Tolerance for touches of the dimensions and of the dump to be equal, mm.
const SAME: f64 = 1e-6;

/// Whether a text has a cycle type by its code.
pub fn recognises(text: &str) -> bool {
    crate::import::fits(text, crate::job::LONGEST_TEXT)
        && entries(text).iter().any(|e| e.code == -1)
}

/// Codes of each cycle in a text. If the last code of all is -1, every -1 ends a cycle; else every -1 begins one, and the text before the first belongs to it.
/// A SubCode before a -1 belongs to the -1 that follows.
fn cycles(all: &[Entry]) -> Vec<Vec<Entry>> {
    let ends = all.last().is_some_and(|e| e.code == -1);
    let mut blocks: Vec<Vec<Entry>> = vec![Vec::new()];
    let mut typed = false;
    for entry in all {
        let block = blocks.last_mut().expect("there is a block");
        let next = typed && (ends || entry.code == -1);
        if next {
            let mut begun = Vec::new();
            if !ends
                && block.last().is_some_and(|e| {
                    e.code == -2 && block.iter().filter(|o| o.code == -2).count() > 1
                })
            {
                begun.extend(block.pop());
            }
            blocks.push(begun);
            typed = false;
        }
        typed |= entry.code == -1;
        blocks.last_mut().expect("there is a block").push(*entry);
    }
    blocks.retain(|block| block.iter().any(|e| e.code == -1));
    blocks
}

/// Makes a job from the codes of a dump. Of several cycles in a text the first that probes is taken.
pub fn import(all: &[Entry]) -> Result<Imported, JobError> {
    let mut checker = Checker::default();
    let blocks = cycles(all);
    let kind = |block: &[Entry]| {
        block
            .iter()
            .find(|e| e.code == -1)
            .map_or(-1.0, |e| e.value)
    };
    let def_of = |block: &[Entry]| {
        CYCLES
            .iter()
            .copied()
            .find(|c| c.number.is_some_and(|n| f64::from(n) == kind(block)))
    };
    for block in blocks.iter().filter(|b| def_of(b).is_none()) {
        let message = text!(
            "Type {block} is not a known cycle: it is ignored",
            crate::num::in_full(kind(block))
        );
        checker.warning("unknown-type", "cycle.type", message);
    }
    let known: Vec<(&Vec<Entry>, &'static CycleDef)> = blocks
        .iter()
        .filter_map(|b| Some((b, def_of(b)?)))
        .collect();
    let probing = known
        .iter()
        .find(|(_, def)| def.place.is_some())
        .or(known.first());
    let Some((block, def)) = probing else {
        checker.error(
            "nothing-to-import",
            "cycle.type",
            text!("This dump makes no job: it has no known cycle type"),
        );
        return Err(JobError {
            findings: checker.findings(),
        });
    };
    if known.len() > 1 {
        let message = text!(
            "The dump has {count} cycles: the first that probes, {title}, is used",
            known.len(),
            def.title
        );
        checker.warning("several-cycles", "", message);
    }
    Ok(build(block, def, checker))
}

/// Value of a code in a block; the last one if there are two.
fn find(block: &[Entry], code: i32) -> Option<f64> {
    block.iter().rev().find(|e| e.code == code).map(|e| e.value)
}

fn build(block: &[Entry], def: &'static CycleDef, mut checker: Checker) -> Imported {
    let mut job = default_job(def.key).expect("a registered cycle has a default job");
    let mut used: Vec<i32> = vec![-1];
    if def.number == Some(0) {
        used.push(-2);
    }
    for field in def.fields {
        let Some((_, code)) = code_of(field) else {
            continue;
        };
        used.push(code);
        let value = read_field(block, field, code, &mut checker);
        if let Some(value) = value {
            set(&mut job, &format!("cycle.{}", field.key), value);
        }
    }
    for section in def.sections {
        let mut any = false;
        for field in section.fields {
            let Some((_, code)) = code_of(field) else {
                continue;
            };
            used.push(code);
            if let Some(value) = find(block, code) {
                if !any {
                    let all = section
                        .fields
                        .iter()
                        .map(|f| (f.key.to_owned(), Value::Null))
                        .collect();
                    set(&mut job, &format!("cycle.{}", section.key), Value::Map(all));
                }
                any = true;
                set(
                    &mut job,
                    &format!("cycle.{}.{}", section.key, field.key),
                    Value::Number(value),
                );
            }
        }
    }
    keep_own_codes(block, &mut job, &mut checker);
    report_unknown(block, &used, &mut checker);
    if let Some(place) = def.place {
        place_touches(block, def, place, &mut job, &mut checker);
    }
    let name = job_name(&job);
    set(&mut job, "name", Value::Text(name));
    let silent = text!(
        "A dump does not give feeds, overtravel, units, control and program name: the defaults are used (mm)"
    );
    checker.info("not-in-dump", "feeds", silent);
    if !checker.has("stylus-from-dump") {
        let silent = text!("A dump does not give the stylus: the default ball is used");
        checker.info("not-in-dump", "stylus", silent);
    }
    Imported::Job {
        job,
        findings: checker.findings(),
    }
}

fn read_field(block: &[Entry], field: &Field, code: i32, checker: &mut Checker) -> Option<Value> {
    let path = format!("cycle.{}", field.key);
    let Some(value) = find(block, code) else {
        if field.null.is_some() {
            return Some(Value::Null);
        }
        let angular = only_angular(code, find(block, -59).unwrap_or(0.0));
        if field.kind != Kind::Flag && code != -2 && !angular {
            let message = text!(
                "The dump has no code {code} ({label}): the default is used",
                code,
                field.label
            );
            checker.warning("missing-code", path, message);
        }
        return None;
    };
    match field.kind {
        Kind::Flag if value == 0.0 || value == 1.0 => Some(Value::Flag(value == 1.0)),
        Kind::Flag => {
            let message = text!(
                "Code {code} ({label}) must be 0 or 1, not {value}: the default is used",
                code,
                field.label,
                crate::num::in_full(value)
            );
            checker.warning("not-a-flag", path, message);
            None
        }
        _ => Some(Value::Number(value)),
    }
}

/// Keeps custom codes, which are positive, unchanged: the last value of each, whatever its accessor was before.
fn keep_own_codes(block: &[Entry], job: &mut Value, checker: &mut Checker) {
    const MOST: usize = 200;
    let mut own: Vec<Entry> = Vec::new();
    let mut twice = 0;
    for entry in block.iter().filter(|e| e.code > 0 && e.code <= 1_000_000) {
        if let Some(known) = own.iter_mut().find(|e| e.code == entry.code) {
            twice += 1;
            *known = *entry;
        } else if own.len() < MOST {
            own.push(*entry);
        } else {
            let message = text!(
                "The dump has more than {most} custom codes: the first {most} are used",
                MOST
            );
            checker.warning("own-codes", "cycle.custom", message);
            break;
        }
    }
    if twice > 0 {
        let message = text!(
            "{twice} custom codes are given more than once: the last value of each is used",
            twice
        );
        checker.warning("own-codes", "cycle.custom", message);
    }
    if own.is_empty() {
        return;
    }
    let rows = own
        .iter()
        .map(|e| {
            // A fraction is not an Int, whatever the dump calls it.
            let whole = e.value.fract() == 0.0 && e.value.abs() <= f64::from(i32::MAX);
            let (accessor, value) = match e.accessor {
                Accessor::Bol => (Accessor::Bol, Value::Flag(e.value != 0.0)),
                Accessor::Int if whole => (Accessor::Int, Value::Number(e.value)),
                _ => (Accessor::Flt, Value::Number(e.value)),
            };
            Value::Map(vec![
                ("code".to_owned(), Value::Number(f64::from(e.code))),
                ("type".to_owned(), Value::Text(accessor.word().to_owned())),
                ("value".to_owned(), value),
            ])
        })
        .collect();
    set(job, "cycle.custom", Value::List(rows));
}

fn report_unknown(block: &[Entry], used: &[i32], checker: &mut Checker) {
    let touch = |code: i32| (-296..=-100).contains(&code);
    // The library's sort would be in the module for this list only, 4 kB of WebAssembly; a heap is there already.
    let unknown: BinaryHeap<i32> = block
        .iter()
        .map(|e| e.code)
        .filter(|c| *c <= 0 && !touch(*c) && !used.contains(c))
        .collect();
    let mut unknown = unknown.into_sorted_vec();
    unknown.dedup();
    if !unknown.is_empty() {
        let codes: Vec<String> = unknown.iter().rev().map(ToString::to_string).collect();
        let message = text!("This cycle has no code {codes}: ignored", codes.join(", "));
        checker.warning("unknown-code", "cycle", message);
    }
}

/// The touch with index `k` in the block that begins at `base`.
fn touch(block: &[Entry], base: i32, k: usize) -> Option<Pick> {
    let first = base - 6 * k as i32;
    let at = |i: i32| find(block, first - i);
    Some(Pick {
        point: Vec3::new(at(0)?, at(1)?, at(2)?),
        vector: Vec3::new(at(3)?, at(4)?, at(5)?),
    })
}

fn touches(block: &[Entry], base: i32) -> Vec<Pick> {
    (0..MAX_TOUCHES)
        .map_while(|k| touch(block, base, k))
        .collect()
}

/// Seven decimals, as in a form, whatever arithmetic the value has gone through.
fn tidy(x: f64) -> f64 {
    let rounded = (x * 1e7).round() / 1e7;
    if rounded == 0.0 { 0.0 } else { rounded }
}

fn triple(v: Vec3) -> Value {
    Value::List(v.to_array().map(Value::Number).to_vec())
}

/// Positions the feature by its touches. If its dimensions give exactly these touches, the job has only the dimensions; else the touches are kept as picked.
fn place_touches(
    block: &[Entry],
    def: &CycleDef,
    place: crate::cycle::PlaceBy,
    job: &mut Value,
    checker: &mut Checker,
) {
    let (used, original) = (touches(block, -100), touches(block, -200));
    if used.is_empty() && original.is_empty() {
        let message = text!(
            "The dump has no touch points (-100 or -200 and following): position and rotation of the feature are the defaults"
        );
        checker.warning("no-touches", "cycle.origin", message);
        return;
    }
    let has_code = def
        .fields
        .iter()
        .any(|f| code_of(f).is_some_and(|(_, code)| code == -66));
    let compensated = has_code && find(block, -66) == Some(1.0);
    let mut picks = on_the_surface(used, original, compensated, job, checker);
    let explicit = Value::List(picks.iter().map(pick_value).collect());
    for pick in &mut picks {
        if (pick.vector.length() - 1.0).abs() <= 1e-3 {
            pick.vector = pick.vector.normalize();
        }
    }
    let trials: Vec<Trial> = [Plane::G17, Plane::G18, Plane::G19]
        .into_iter()
        .filter_map(|plane| Trial::of(def, place, &picks, plane, job))
        .collect();
    report_plane(trials.iter().filter(|trial| trial.fits), checker);
    let possible = trials
        .iter()
        .find(|trial| trial.possible)
        .map(|trial| trial.plane);
    if let Some(fit) = trials.into_iter().find(|trial| trial.fits) {
        *job = fit.job;
        return;
    }
    set(job, "cycle.touches", explicit);
    match possible {
        Some(plane) => {
            set(job, "plane", Value::Text(plane.word().to_owned()));
            let message = text!(
                "The touch points do not follow from the dimensions alone: they stay as they were picked"
            );
            checker.info("touches-kept", "cycle.touches", message);
        }
        None => {
            let message = text!(
                "The touch points do not define this feature: see the other findings of the job"
            );
            checker.warning("touches-unsound", "cycle.touches", message);
        }
    }
}

/// Touches on the surface. Used points are ball centres if dimensions are compensated; the ball radius is the distance to the original points, else it is
/// unknown.
fn on_the_surface(
    used: Vec<Pick>,
    original: Vec<Pick>,
    compensated: bool,
    job: &mut Value,
    checker: &mut Checker,
) -> Vec<Pick> {
    let both = !used.is_empty() && original.len() == used.len();
    let radii: Vec<f64> = used
        .iter()
        .zip(&original)
        .map(|(u, o)| (u.point - o.point).dot(o.vector))
        .collect();
    let radius = tidy(radii.iter().sum::<f64>() / radii.len().max(1) as f64);
    let apart = used
        .iter()
        .zip(&original)
        .any(|(u, o)| (u.point - o.point - o.vector * radius).length() > 1e-3);
    if used.is_empty() {
        return original;
    }
    if compensated && both && radius >= 0.0 && !apart {
        // Both blocks: they differ by the ball radius only.
        set(job, "stylus.diameter", Value::Number(tidy(2.0 * radius)));
        checker.info(
            "stylus-from-dump",
            "stylus.diameter",
            text!("The ball diameter follows from the used and the original points"),
        );
        return original;
    }
    if compensated {
        let why = if both {
            text!(
                "The points are ball centres, and more than a ball away from the original ones (-200 and following)"
            )
        } else {
            text!(
                "The points are ball centres, and without the original ones (-200 and following) the dump does not specify the ball"
            )
        };
        // The job has the form's default ball if the dump gives none.
        let diameter = match job.get("stylus").and_then(|stylus| stylus.get("diameter")) {
            Some(Value::Number(diameter)) => *diameter,
            _ => 0.0,
        };
        let message = text!(
            "{why}: the used points are corrected for the default ball, {diameter}",
            why,
            format!("{} mm", crate::num::in_full(diameter))
        );
        checker.warning("ball-unknown", "stylus.diameter", message);
        return used
            .into_iter()
            .map(|pick| Pick {
                point: pick.point - pick.vector * (diameter / 2.0),
                ..pick
            })
            .collect();
    }
    if !original.is_empty()
        && original
            .iter()
            .zip(&used)
            .any(|(o, u)| o.point.distance(u.point) > SAME)
    {
        let message = text!(
            "The used points (-100 and following) differ from the original ones (-200): the used ones count"
        );
        checker.info("points-differ", "cycle.touches", message);
    }
    used
}

fn pick_value(pick: &Pick) -> Value {
    Value::Map(vec![
        ("point".to_owned(), triple(pick.point)),
        ("vector".to_owned(), triple(pick.vector)),
    ])
}

/// Trial of the touches in one plane.
struct Trial {
    plane: Plane,
    /// The job with its feature positioned by the touches.
    job: Value,
    /// Whether the dimensions give exactly these touches, and the job can express their position.
    fits: bool,
    /// Whether the sizes of the feature are allowed.
    possible: bool,
}

impl Trial {
    /// `None` if the touches do not make the feature.
    fn of(
        def: &CycleDef,
        place: crate::cycle::PlaceBy,
        picks: &[Pick],
        plane: Plane,
        job: &Value,
    ) -> Option<Trial> {
        let mut scratch = Checker::default();
        let mut section = Section::new(&mut scratch, job.get("cycle"), "cycle");
        let (placement, dimensioned) = place(&mut section, picks, plane)?;
        let near = |(t, p): (&Pick, &Pick)| {
            t.point.distance(p.point) < SAME && t.vector.distance(p.vector) < SAME
        };
        let same = dimensioned.len() == picks.len() && dimensioned.iter().zip(picks).all(near);
        let mut trial = job.clone();
        set(&mut trial, "plane", Value::Text(plane.word().to_owned()));
        set(
            &mut trial,
            "cycle.origin",
            triple(Vec3::from_array(placement.origin.to_array().map(tidy))),
        );
        set(
            &mut trial,
            "cycle.rotation",
            Value::Number(tidy(placement.rotation)),
        );
        // A job has every size and position within its range; others stay as they were picked.
        let field = |key: &str| def.fields.iter().find(|f| f.key == key);
        let within = |x: &f64| field("origin").is_none_or(|f| f.hard.holds(tidy(*x)));
        let mut sound = placement.origin.to_array().iter().all(within);
        for (key, size) in &placement.sizes {
            // A size with its own code is in the dump.
            if let Some(field) = field(key).filter(|f| f.code.is_empty()) {
                let size = field.hard.snapped(tidy(*size));
                sound &= field.hard.holds(size);
                set(&mut trial, &format!("cycle.{key}"), Value::Number(size));
            }
        }
        let allowed = |key: &str, x: f64| {
            field(key).is_none_or(|f| {
                f.hard
                    .nearly_holds(if key == "angle" { x.abs() } else { x })
            })
        };
        let possible = placement.sizes.iter().all(|(key, x)| allowed(key, *x));
        Some(Trial {
            plane,
            job: trial,
            fits: same && sound,
            possible,
        })
    }
}

/// Reports the plane in which the touches fit, if that is ambiguous.
fn report_plane<'a>(fits: impl Iterator<Item = &'a Trial>, checker: &mut Checker) {
    let planes: Vec<&str> = fits.map(|trial| trial.plane.word()).collect();
    match planes.as_slice() {
        [] | ["G17"] => {}
        [one] => {
            let message = text!(
                "The target vectors fit a feature in {one}: that plane is used",
                (*one).to_owned()
            );
            checker.info("plane-from-dump", "plane", message);
        }
        [first, ..] => {
            let message = text!(
                "The touches fit this feature in {planes}: {first} is used",
                planes.join(", "),
                first.to_owned()
            );
            checker.warning("plane-unknown", "plane", message);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cycle_of_a_text_has_its_own_codes() {
        // Two cycles, each with its type last.
        let ascending = "Flt[-53]=30\nInt[-1]=9\nFlt[-53]=44\nInt[-1]=9\n";
        let blocks = cycles(&entries(ascending));
        assert_eq!(
            (blocks.len(), blocks[0][0].value, blocks[1][0].value),
            (2, 30.0, 44.0)
        );
        let begun = "Int[-2]=1\nInt[-1]=9\nFlt[-53]=30\nInt[-2]=2\nInt[-1]=9\nFlt[-53]=44\n";
        let blocks = cycles(&entries(begun));
        let codes: Vec<Vec<(i32, f64)>> = blocks
            .iter()
            .map(|b| b.iter().map(|e| (e.code, e.value)).collect())
            .collect();
        assert_eq!(
            codes,
            [
                [(-2, 1.0), (-1, 9.0), (-53, 30.0)],
                [(-2, 2.0), (-1, 9.0), (-53, 44.0)]
            ]
        );
    }
}
