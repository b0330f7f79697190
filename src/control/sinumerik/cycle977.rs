//! The control's own cycle for an inside rectangle with a protection zone: CYCLE977, 29 arguments by position.
//!
//! Positions, fixed values and the meaning of 27 to 29 are those of working generators and their calls. Three things stay open, and the
//! program says so: the sign of the infeed, on which sources disagree, that a rectangle takes both coordinates of the centre, and, in
//! inches, the unit of the measuring path. Argument 10, a rotation, is always 0.

use std::ops::Range;

use crate::control::Request;
use crate::control::iso::writer::Writer;
use crate::form::Checker;
use crate::path::{Entry, Feature};
use crate::text::{text, words};

/// The shortest measuring path that CYCLE977 is called with, mm.
const SHORTEST_PATH: f64 = 0.1;

/// What CYCLE977 needs of an internal rectangle, mm.
struct Rectangle {
    widths: [f64; 2],
    /// From the walls to the ball centre where touches begin.
    clearances: [Entry; 2],
    /// Measuring path: how far before and behind the nominal contact it searches.
    path: f64,
    /// Protection zone along abscissa and ordinate.
    zone: [f64; 2],
    /// From the height of the start down to the touches.
    infeed: f64,
}

impl Rectangle {
    /// None where something else is probed.
    fn of(request: &Request<'_>) -> Option<Self> {
        let Feature::Pairs(pairs) = &request.path.feature else { return None };
        let ([one, two], Some(crossing), true) = (pairs.sides.as_slice(), pairs.crossing, pairs.internal) else { return None };
        let clearances = [one.clearance?, two.clearance?];
        let widths = [one.width.value, two.width.value];
        let radius = request.setup.radius;
        // The zone is as large as the ball leaves free where it goes down.
        let zone = [0, 1].map(|i| widths[i] - 2.0 * (clearances[i].value + radius));
        Some(Rectangle {
            widths,
            clearances,
            path: clearances[0].value - radius,
            zone,
            infeed: pairs.depth.value + crossing.value,
        })
    }
}

/// Reports what CYCLE977 cannot do of this job.
pub fn check(request: &Request<'_>, checker: &mut Checker) {
    let Some(rectangle) = Rectangle::of(request) else { return };
    let [a, _, _] = request.plane.basis();
    let advice = words!(". Use the form \"moves\"");
    if request.path.frame.u.distance(a) > 1e-9 {
        let message = text!("The program calls CYCLE977 without a rotation, and this rectangle is turned{advice}", advice);
        checker.error("cycle-not-parallel", "cycle.rotation", message);
    }
    if request.path.picked {
        let message = text!("CYCLE977 chooses its own touch points{advice}", advice);
        checker.error("cycle-chooses-points", "cycle.touches", message);
    }
    if request.plane != crate::geom::Plane::G17 {
        let message = text!(
            "No source at hand shows how CYCLE977 selects another plane than G17: it could probe in the wrong one{advice}",
            advice
        );
        checker.error("cycle-plane", "plane", message);
    }
    if rectangle.path < SHORTEST_PATH {
        let message = text!(
            "The measuring path of CYCLE977 (side clearance less ball radius, before and behind each wall) would be {path}: at least {least} makes sense{advice}",
            checker.length(rectangle.path),
            checker.length(SHORTEST_PATH),
            advice
        );
        checker.error("cycle-path-short", rectangle.clearances[0].field, message);
    }
    let clearances = rectangle.widths.iter().zip(rectangle.zone).map(|(w, z)| (w - z) / 2.0).collect::<Vec<f64>>();
    if (clearances[0] - clearances[1]).abs() > 1e-9 {
        let message =
            text!("CYCLE977 has one measuring path for all four walls: both side clearances must be the same{advice}", advice);
        checker.error("cycle-one-path", rectangle.clearances[1].field, message);
    }
    for (clearance, zone) in rectangle.clearances.into_iter().zip(rectangle.zone) {
        if zone <= 0.0 {
            let message = text!("The points where the ball goes down leave no room for a protection zone{advice}", advice);
            checker.error("cycle-no-zone", clearance.field, message);
        }
    }
    let message = text!(
        "The cycle moves by itself: it searches {path} before and behind each wall (side clearance less ball radius), not the job's \
         overtravel, and measures at its own feed; the moves shown are the documented ones. That the infeed of {infeed} is written \
         positive is not verified: sources disagree on its sign",
        checker.length(rectangle.path),
        checker.length(rectangle.infeed)
    );
    checker.warning("cycle-differs", "control.form", message);
}

/// What the header says of it.
pub fn notes(request: &Request<'_>) -> Vec<&'static str> {
    let mut notes = vec![
        "Results: _OVR[4] and following of the measuring cycle; probe data set 1, the control's own measuring feed",
        "NOT VERIFIED: argument 11, the infeed, is written positive; sources disagree on its sign. A wrong one lifts instead",
        "NOT VERIFIED: that a rectangle takes both 28 and 29, the centre",
    ];
    if request.scale != 1.0 {
        notes.push("NOT VERIFIED: argument 8, the measuring path, is written in inches; its forerunner _FA was in mm always");
    }
    notes
}

/// The moves to the start are the program's, then the cycle does the rest, and the program lifts.
pub fn moves(request: &Request<'_>) -> Option<Range<usize>> {
    Rectangle::of(request)?;
    let moves = &request.path.moves;
    // The approach: every move before the first that leaves the start.
    let approach = moves.iter().take_while(|m| m.step <= 1).count();
    Some(approach..moves.len() - 1)
}

/// Writes the block that calls it.
pub fn call(request: &Request<'_>, w: &mut Writer<'_>) {
    if let Some(rectangle) = Rectangle::of(request) {
        let block = block(w, request, &rectangle);
        w.line(&block);
    }
}

/// The sign of the infeed, argument 11. Not settled: a generator for the control's own editor writes it positive, two others negative.
const INFEED_SIGN: f64 = 1.0;

/// CYCLE977 for an inside rectangle with a protection zone: 29 arguments, by position as in real calls.
fn block(w: &Writer<'_>, request: &Request<'_>, rectangle: &Rectangle) -> String {
    let [w1, w2] = rectangle.widths.map(|x| w.number(x));
    let [za, zo] = rectangle.zone.map(|x| w.number(x));
    let path = w.number(rectangle.path);
    // What it takes for plausible, argument 9: how far a wall may be off.
    let limit = request.limits.position.unwrap_or(f64::INFINITY);
    let safe = w.number(request.setup.overtravel.min(rectangle.path).min(limit));
    let infeed = w.number(INFEED_SIGN * rectangle.infeed);
    let [a, o, _] = request.plane.axes();
    let [x, y] = [a, o].map(|axis| w.number(request.path.frame.origin[axis]));
    // Thousands: with a protection zone. Hundreds: corrects the work offset. Units: rectangle inside.
    let (variant, offset) = match request.work_offset {
        Some(n) => (1105, (10_000 + n).to_string()),
        None => (1005, String::new()),
    };
    let tolerance = w.number(1.01);
    // 22 to 24 are empty where nothing is corrected. 27 = 11: the centre follows.
    let correction = if request.work_offset.is_some() { format!("{},1,0", w.number(0.34)) } else { ",,".to_owned() };
    format!(
        "CYCLE977({variant},{offset},,1,,{w1},{w2},{path},{safe},0,{infeed},{za},{zo},,1,\"\",,0,{tolerance},{tolerance},-{tolerance},\
         {correction},,1,11,{x},{y})"
    )
}
