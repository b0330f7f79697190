//! The dimensions of a feature as a drawing has them: whose field it is, from where to where, and on which side its line stands.

use crate::geom::Vec3;
use crate::path::{Bore, Feature, Feed, Pair, Path, Protection, Purpose, Rectangle, Surface};

/// A dimension of the nominal part, in the work coordinate system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimension {
    /// The path of the job's field that says it.
    pub field: &'static str,
    /// Where it begins, mm.
    pub from: Vec3,
    /// Where it ends, mm; its length is the field's value.
    pub to: Vec3,
    /// The side on which its line stands, a unit vector square to it.
    pub aside: Vec3,
    /// Whether it is drawn only while its field has the focus.
    pub on_demand: bool,
}

/// An angle of the nominal part: between two directions at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    /// The path of the job's field that says it.
    pub field: &'static str,
    /// Its vertex, mm.
    pub at: Vec3,
    /// The directions of its two sides, unit vectors.
    pub sides: [Vec3; 2],
    /// How far from its vertex the nearest touch is, mm: its arc and its name end before that.
    pub room: f64,
}

/// The angles of what a path probes: between the walls of a corner, and of a surface's target vector up from the plane. None where the touches
/// were picked.
pub fn angles(path: &Path) -> Vec<Angle> {
    let frame = path.frame;
    let (field, at, sides) = match &path.feature {
        feature if feature.picked() => return Vec::new(),
        Feature::Corner(corner) | Feature::Triple(corner) => {
            // Wall 1 runs along the ordinate of the frame, wall 2 on the side of its abscissa.
            let (sin, cos) = corner.angle.to_radians().sin_cos();
            ("cycle.angle", frame.origin, [frame.v, frame.u * sin + frame.v * cos])
        }
        Feature::Surface { .. } => {
            let Some(touch) = path.touches.first() else { return Vec::new() };
            ("cycle.elevation", touch.point, [frame.u, touch.vector])
        }
        _ => return Vec::new(),
    };
    // A target vector in the plane has no arc.
    if sides[0].distance(sides[1]) < 1e-6 {
        return Vec::new();
    }
    let touches = path.touches.iter().map(|touch| touch.point.distance(at)).filter(|far| *far > 1e-6);
    let room = touches.fold(f64::INFINITY, f64::min);
    vec![Angle { field, at, sides, room }]
}

/// The dimensions of what a path probes; none where the touches were picked, since then they say nothing of where it lies.
pub fn dimensions(path: &Path) -> Vec<Dimension> {
    if path.feature.picked() {
        return Vec::new();
    }
    let frame = path.frame;
    let (u, v, w) = (frame.u, frame.v, frame.w);
    let top = path.top.unwrap_or(frame.origin.dot(w));
    let center = frame.origin + w * (top - frame.origin.dot(w));
    let across = |field, along: Vec3, width: f64, edge: Vec3, aside: Vec3| {
        let half = along * (width / 2.0);
        Dimension { field, from: center - half + edge, to: center + half + edge, aside, on_demand: false }
    };
    let deep = |depth: f64, out: Vec3| {
        let edge = center + out;
        Dimension { field: "cycle.depth", from: edge, to: edge - w * depth, aside: out.normalize_or(u), on_demand: false }
    };
    let mut all = Vec::new();
    match &path.feature {
        Feature::Hole(bore) | Feature::Boss(bore) => {
            let Bore { diameter, depth, protected, .. } = *bore;
            all.push(across("cycle.diameter", u, diameter, Vec3::ZERO, -v));
            all.push(deep(depth, u * (diameter / 2.0)));
            clearances(path, protected, &["cycle.sideClearance"], &mut all);
        }
        Feature::Pocket(rectangle) | Feature::Block(rectangle) => {
            let Rectangle { widths: [first, second], depth, protected, .. } = *rectangle;
            all.push(across("cycle.width1", u, first, v * (-second / 2.0), -v));
            all.push(across("cycle.width2", v, second, u * (-first / 2.0), -u));
            all.push(deep(depth, u * (first / 2.0)));
            clearances(path, protected, &["cycle.sideClearance1", "cycle.sideClearance2"], &mut all);
        }
        Feature::Web(pair) | Feature::Groove(pair) => {
            let Pair { width, depth, protected, .. } = *pair;
            let far = path.surfaces.iter().filter_map(|s| match s {
                Surface::Flat(wall) => Some(wall.extent.0.abs().max(wall.extent.1.abs())),
                _ => None,
            });
            let far = far.fold(0.0, f64::max);
            all.push(across("cycle.width", u, width, v * -far, -v));
            all.push(deep(depth, u * (width / 2.0)));
            clearances(path, protected, &["cycle.sideClearance"], &mut all);
        }
        Feature::Corner(corner) => walls(path, &CLEARANCES[..2], corner.outside, &mut all),
        Feature::Triple(corner) if corner.outside => {
            walls(path, &CLEARANCES[..2], true, &mut all);
            on_top(path, &mut all);
        }
        Feature::Triple(_) => walls(path, &CLEARANCES, false, &mut all),
        Feature::TwoCircles(_) => {
            for (surface, field) in path.surfaces.iter().zip(["cycle.diameter1", "cycle.diameter2"]) {
                if let Surface::Round(round) = surface {
                    let half = u * round.radius;
                    let (from, to) = (round.center - half, round.center + half);
                    all.push(Dimension { field, from, to, aside: -v, on_demand: false });
                }
            }
        }
        Feature::Surface { .. } => {
            if let (Some(touch), Some(start)) = (path.touches.first(), begin_of(path, 0)) {
                let aside = (w - touch.vector * w.dot(touch.vector)).try_normalize().unwrap_or(v);
                all.push(Dimension { field: "cycle.clearance", from: touch.point, to: start, aside, on_demand: false });
            }
        }
        Feature::Still => {}
    }
    // The last move, up from the start; there is none where the distance is 0.
    if let [.., before, last] = path.moves.as_slice()
        && path.feature.two_circles().is_none()
    {
        let lifts = last.feed == Feed::Return && (last.to - before.to).cross(w).length() < 1e-9;
        if lifts {
            let (from, to) = (before.to, last.to);
            all.push(Dimension { field: "cycle.feedDistance", from, to, aside: u, on_demand: true });
        }
    }
    all
}

/// Where the ball is when a touch begins.
fn begin_of(path: &Path, touch: usize) -> Option<Vec3> {
    let i = path.moves.iter().position(|step| step.purpose == Purpose::Touch(touch))?;
    Some(path.moves[i.checked_sub(1)?].to)
}

/// Of a corner that is touched from outside on its top side, too: how deep its walls are touched, and where the top side is.
fn on_top(path: &Path, all: &mut Vec<Dimension>) {
    let [first, second, third] = path.touches.as_slice() else { return };
    let (origin, w) = (path.frame.origin, path.frame.w);
    let level = w * (origin - first.point).dot(w);
    // Away from both walls, so that it stands free from the front and from the side.
    let aside = (first.vector + second.vector).try_normalize().unwrap_or(first.vector);
    let (from, to) = (first.point + level, first.point);
    all.push(Dimension { field: "cycle.depth", from, to, aside, on_demand: false });
    for (wall, field) in [(first, "cycle.topDistance1"), (second, "cycle.topDistance2")] {
        let from = third.point + wall.vector * (wall.point - third.point).dot(wall.vector);
        let aside = w.cross(wall.vector);
        all.push(Dimension { field, from, to: third.point, aside, on_demand: true });
    }
    if let Some(to) = begin_of(path, 2) {
        let from = third.point;
        all.push(Dimension { field: "cycle.topClearance", from, to, aside: first.vector, on_demand: true });
    }
}

/// The fields that say how far before a wall its touch begins.
const CLEARANCES: [&str; 3] = ["cycle.clearance1", "cycle.clearance2", "cycle.clearance3"];

/// Of the walls of a corner: from the first touch to where it begins, to the next touch, and, outside, from the corner at its level.
fn walls(path: &Path, clearances: &[&'static str], outside: bool, all: &mut Vec<Dimension>) {
    const STEPS: [&str; 2] = ["cycle.step1", "cycle.step2"];
    const DISTANCES: [&str; 2] = ["cycle.distance1", "cycle.distance2"];
    for (wall, field) in clearances.iter().enumerate() {
        let mut touches = path.touches.iter().enumerate().filter(|(_, touch)| touch.group == wall);
        let Some((k, first)) = touches.next() else { continue };
        // Beside the corner, where no other touch is.
        let along = path.frame.w.cross(first.vector).try_normalize().unwrap_or(path.frame.u);
        let aside = if along.dot(first.point - path.frame.origin) > 0.0 { -along } else { along };
        let begin = begin_of(path, k);
        if let Some(to) = begin {
            let from = first.point;
            all.push(Dimension { field, from, to, aside, on_demand: true });
        }
        // Behind the wall; of a corner from outside in front of the touches, since behind one wall stands the other.
        let (aside, off) = if outside {
            (first.vector, begin.map_or(Vec3::ZERO, |begin| begin - first.point))
        } else {
            (-first.vector, Vec3::ZERO)
        };
        let beside =
            |field, from: Vec3, to: Vec3, on_demand| Dimension { field, from: from + off, to: to + off, aside, on_demand };
        if let (Some((_, next)), Some(field)) = (touches.next(), STEPS.get(wall)) {
            all.push(beside(field, first.point, next.point, false));
        }
        if let Some(field) = DISTANCES.get(wall).filter(|_| outside) {
            let (origin, w) = (path.frame.origin, path.frame.w);
            all.push(beside(field, origin + w * (first.point - origin).dot(w), first.point, true));
        }
    }
}

/// From a wall to where its touch begins, and from the top side up to where the ball crosses.
fn clearances(path: &Path, protection: Option<Protection>, sides: &[&'static str], all: &mut Vec<Dimension>) {
    let Some(Protection { top, sides: clear }) = protection else { return };
    let w = path.frame.w;
    for (i, field) in sides.iter().enumerate() {
        // The first touch of each pair of walls.
        if let Some(touch) = path.touches.get(2 * i) {
            let (from, to) = (touch.point, touch.point + touch.vector * clear[i]);
            let aside = w.cross(touch.vector);
            all.push(Dimension { field, from, to, aside, on_demand: true });
        }
    }
    if let (Some(touch), Some(height)) = (path.touches.first(), path.top) {
        let from = touch.point + w * (height - touch.point.dot(w));
        let aside = -touch.vector;
        all.push(Dimension { field: "cycle.topClearance", from, to: from + w * top, aside, on_demand: true });
    }
}
