//! Touches picked one by one, as in the Job Assignment.

use crate::form::{Checker, Field, Section, Value};
use crate::geom::{Plane, Vec3};
use crate::path::{MAX_TOUCHES, ONE_LEVEL};
use crate::text::{text, words};

/// Tolerance of the length of a target vector, and of a picked touch against the values that it has to match (mm, or as a sine).
pub const NEAR: f64 = 1e-3;

/// Smallest depth that a form may have, mm.
const SMALLEST: f64 = 0.001;

/// A picked touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// On the surface, mm.
    pub point: Vec3,
    /// Outward normal, a unit vector.
    pub vector: Vec3,
}

/// Position of a feature by its picks.
#[derive(Clone, Debug)]
pub struct Placement {
    /// `origin` of the form, mm.
    pub origin: Vec3,
    /// `rotation` of the form, degrees.
    pub rotation: f64,
    /// Sizes by key: mm, degrees.
    pub sizes: Vec<(&'static str, f64)>,
}

/// Position of a touch, as a field.
pub const POINT: Field = Field::point("point", "Touch point");
/// Largest component of a target vector. Whether it is a unit vector is checked by its length.
pub const LONGEST_VECTOR: i32 = 2;

/// Reads `touches`; `None` if the job has none. Reports every problem.
pub fn read(section: &mut Section<'_, '_>) -> Option<Vec<Pick>> {
    let place = section.at("touches");
    let items = match section.get("touches")? {
        Value::Null => return None,
        Value::List(items) => items,
        other => {
            let message = text!(
                "touches must be a list of { point, vector } or null, not {given}",
                other.noun()
            );
            section.checker.error("wrong-type", place, message);
            return None;
        }
    };
    if items.is_empty() {
        let message = text!(
            "touches is empty: give every touch of the path, or null to compute them from the dimensions"
        );
        section.checker.error("wrong-count", place, message);
        return None;
    }
    if items.len() > MAX_TOUCHES {
        let message = text!(
            "{count} touches are given; the parameter table holds 1 to {most}: touch {touch} would start at code {code} and run into the \
             -200 block of original points",
            items.len(),
            MAX_TOUCHES,
            MAX_TOUCHES + 1,
            -100 - 6 * MAX_TOUCHES as i32
        );
        section.checker.error("too-many-touches", place, message);
        return None;
    }
    let picks: Vec<Pick> = items
        .iter()
        .enumerate()
        .map(|(k, item)| {
            let path = format!("{place}[{k}]");
            if let Value::Map(entries) = item {
                for (key, _) in entries.iter().filter(|(key, _)| key != "point" && key != "vector") {
                    let message = text!("A touch has a point and a vector, and no \"{key}\"", crate::form::printable(key));
                    section.checker.error("unknown-key", format!("{path}.{}", crate::form::printable(key)), message);
                }
            }
            let at = format!("{path}.point");
            let point = triple(section, item.get("point"), POINT.label, &at, |section, value, path| {
                section.number(value, &POINT, path)
            });
            let vector = triple(section, item.get("vector"), words!("Target vector"), &format!("{path}.vector"), component);
            let length = vector.length();
            if section.checker.is_clean(&[&path]) && (length - 1.0).abs() > NEAR {
                let message = text!("The target vector of touch {touch} has the length {length}: it must be a unit vector (1 ± 0.001)", k + 1, crate::num::decimal(length, 4));
                section.checker.error("vector-not-unit", format!("{path}.vector"), message);
            }
            Pick { point, vector: vector.normalize_or(Vec3::Z) }
        })
        .collect();
    Some(picks)
}

/// Reports surfaces that the ball cannot reach from above and leave upwards.
pub fn none_overhangs(picks: &[Pick], plane: Plane, checker: &mut Checker) {
    for (k, _) in picks
        .iter()
        .enumerate()
        .filter(|(_, pick)| pick.vector.dot(plane.basis()[2]) < -NEAR)
    {
        let message = text!(
            "The target vector must not point down: the ball cannot touch from below and retract upwards"
        );
        checker.error(
            "vector-wrong-way",
            format!("cycle.touches[{k}].vector"),
            message,
        );
    }
}

/// A component of a target vector, without unit.
fn component(section: &mut Section<'_, '_>, value: &Value, path: &str) -> Option<f64> {
    match *value {
        Value::Number(x) if x.abs() <= f64::from(LONGEST_VECTOR) => return Some(x),
        Value::Number(_) => {
            let message = text!(
                "A number of a target vector must be from -{most} to {most}",
                LONGEST_VECTOR
            );
            section.checker.error("out-of-range", path, message);
        }
        _ => {
            let message = text!(
                "A target vector must be three numbers, not {given}",
                value.noun()
            );
            section.checker.error("wrong-type", path, message);
        }
    }
    None
}

fn triple(
    section: &mut Section<'_, '_>,
    value: Option<&Value>,
    label: &'static str,
    path: &str,
    read: impl Fn(&mut Section<'_, '_>, &Value, &str) -> Option<f64>,
) -> Vec3 {
    match value {
        Some(Value::List(items)) if items.len() == 3 => {
            let mut v = Vec3::ZERO;
            for (i, item) in items.iter().enumerate() {
                v[i] = read(section, item, &format!("{path}[{i}]")).unwrap_or(0.0);
            }
            v
        }
        _ => {
            section.checker.error(
                "wrong-type",
                path,
                text!("{label} must be a list of three numbers", label),
            );
            Vec3::ZERO
        }
    }
}

/// Checks the number of touches.
pub fn counted(picks: &[Pick], count: usize, checker: &mut Checker) -> bool {
    if picks.len() != count {
        let message = text!(
            "By its form this cycle has {count} touches, but {given} are given",
            count,
            picks.len()
        );
        checker.error("wrong-count", "cycle.touches", message);
    }
    picks.len() == count
}

/// Reports vectors that are not in the plane (`level`) or not along the tool axis.
pub fn levelled(picks: &[Pick], touches: &[usize], plane: Plane, checker: &mut Checker) {
    let up = plane.basis()[2];
    for &k in touches {
        if picks[k].vector.dot(up).abs() > NEAR {
            let message = text!(
                "The target vector of touch {touch} must lie in the plane {plane}",
                k + 1,
                plane.word()
            );
            checker.error(
                "vector-not-in-plane",
                format!("cycle.touches[{k}].vector"),
                message,
            );
        }
    }
}

/// Reports touches of one body at different levels: the ball would cross at one height and go down at another, and only one touch would give the top side.
pub fn one_level(picks: &[Pick], touches: &[usize], plane: Plane, checker: &mut Checker) {
    let up = plane.basis()[2];
    let [first, rest @ ..] = touches else { return };
    let level = picks[*first].point.dot(up);
    for &k in rest {
        let off = picks[k].point.dot(up) - level;
        if off.abs() > ONE_LEVEL {
            let message = text!(
                "Touch {touch} is {way} {below} touch {first}: the touches of one feature must be at one level",
                k + 1,
                checker.length(off.abs()),
                if off > 0.0 {
                    words!("above")
                } else {
                    words!("below")
                },
                first + 1
            );
            checker.error(
                "touches-not-level",
                format!("cycle.touches[{k}].point"),
                message,
            );
        }
    }
}

/// Reports touches that are not below the touch of the top side.
pub fn below_top(
    picks: &[Pick],
    touches: &[usize],
    top: usize,
    plane: Plane,
    checker: &mut Checker,
) {
    let up = plane.basis()[2];
    for &k in touches {
        if (picks[top].point - picks[k].point).dot(up) < SMALLEST / 2.0 {
            let message = text!(
                "Touch {touch} must be below touch {top}, which is on the top side",
                k + 1,
                top + 1
            );
            checker.error(
                "touch-above-top",
                format!("cycle.touches[{k}].point"),
                message,
            );
        }
    }
}

/// Reports a touch that is not straight in front of its start: the ball would not move along the inverted vector.
pub fn in_front(picks: &[Pick], start: Vec3, checker: &mut Checker) {
    for (k, pick) in picks.iter().enumerate() {
        let away = start - pick.point;
        let aside = (away - pick.vector * away.dot(pick.vector)).length();
        if aside > NEAR * (1.0 + 2.0 * away.length()) {
            let message = text!(
                "Touch {touch} is {aside} off the line through the centre from which this cycle probes. Use a protected cycle for such touches",
                k + 1,
                checker.length(aside)
            );
            checker.error("touch-aside", format!("cycle.touches[{k}].point"), message);
        }
    }
}

/// Reports a vector that points into the material: a wrong sign.
pub fn turned_inwards(k: usize, internal: bool, checker: &mut Checker) {
    let (kind, where_to) = if internal {
        (words!("internal"), words!("into the feature"))
    } else {
        (words!("external"), words!("away from it"))
    };
    let message = text!(
        "The target vector of touch {touch} points the wrong way: it is the outward normal of the surface, and of an {kind} feature it \
         points {where_to}",
        k + 1,
        kind,
        where_to
    );
    checker.error(
        "vector-wrong-way",
        format!("cycle.touches[{k}].vector"),
        message,
    );
}

/// Reports a corner whose first touches and clearances give different starts. `farthest` is the largest of the clearances, mm.
pub fn one_start(readings: &[(usize, Vec3)], farthest: f64, checker: &mut Checker) {
    let place = |p: Vec3, checker: &Checker| {
        format!("[{}]", p.to_array().map(|x| checker.number(x)).join(", "))
    };
    // A vector may be off by a thousandth: over the clearances this is the resulting distance.
    let near = NEAR * (1.0 + 2.0 * farthest);
    if let Some((k, other)) = readings
        .iter()
        .find(|(_, p)| p.distance(readings[0].1) > near)
    {
        let message = text!(
            "The start position is ambiguous: touch {first} and its clearance give {place}, touch {other} and its clearance give {place2}",
            readings[0].0 + 1,
            place(readings[0].1, checker),
            k + 1,
            place(*other, checker)
        );
        checker.error("starts-disagree", "cycle.touches", message);
    }
}

/// Angle of a direction in the plane, degrees.
pub fn heading(plane: Plane, v: Vec3) -> f64 {
    let [a, o, _] = plane.axes();
    v[o].atan2(v[a]).to_degrees()
}
