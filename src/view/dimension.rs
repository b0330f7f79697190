//! Dimensions of a feature as on a drawing: field, ends, and side of the line.

use crate::geom::Vec3;
use crate::path::{
    Bore, Corner, Feature, Feed, FieldValue, MovePurpose, Pairs, Path, Point, Surface, Top,
    WallFeature,
};

/// A dimension of the nominal part, in the work coordinate system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimension {
    /// Path of the job field with its value.
    pub field: &'static str,
    /// First end, mm.
    pub from: Vec3,
    /// Second end, mm; the length is the field's value.
    pub to: Vec3,
    /// Side of its line, a unit vector perpendicular to it.
    pub aside: Vec3,
    /// Whether it is drawn only while its field has the focus.
    pub on_demand: bool,
}

/// An angle of the nominal part, between two directions at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    /// Path of the job field with its value.
    pub field: &'static str,
    /// Its vertex, mm.
    pub at: Vec3,
    /// The directions of its two sides, unit vectors.
    pub sides: [Vec3; 2],
    /// Distance from its vertex to the nearest touch, mm: its arc and its name end before that.
    pub room: f64,
}

/// Angles of a path's feature: between the walls of a corner, and elevation of a surface's target vector. Empty if the touches were picked.
pub fn angles(path: &Path) -> Vec<Angle> {
    let frame = path.frame;
    let (field, at, sides) = match &path.feature {
        _ if path.picked => return Vec::new(),
        Feature::Corner(corner) => {
            // Wall 1 runs along the ordinate of the frame, wall 2 on the side of its abscissa.
            let (sin, cos) = corner.angle.value.to_radians().sin_cos();
            (
                corner.angle.field,
                frame.origin,
                [frame.v, frame.u * sin + frame.v * cos],
            )
        }
        Feature::Surface(point) => {
            let Some(touch) = path.touches.first() else {
                return Vec::new();
            };
            (point.elevation, touch.point, [frame.u, touch.vector])
        }
        Feature::Unmoving
        | Feature::Bore(_)
        | Feature::Pairs(_)
        | Feature::TwoCircles(_)
        | Feature::Wall(_)
        | Feature::Several => {
            return Vec::new();
        }
    };
    // A target vector in the plane has no arc.
    if sides[0].distance(sides[1]) < 1e-6 {
        return Vec::new();
    }
    let touches = path
        .touches
        .iter()
        .map(|touch| touch.point.distance(at))
        .filter(|far| *far > 1e-6);
    let room = touches.fold(f64::INFINITY, f64::min);
    vec![Angle {
        field,
        at,
        sides,
        room,
    }]
}

/// Dimensions of a path's feature; empty if the touches were picked, since then they do not position it.
pub fn dimensions(path: &Path) -> Vec<Dimension> {
    if path.picked {
        return Vec::new();
    }
    let mut all = match &path.feature {
        Feature::Unmoving | Feature::Several => Vec::new(),
        Feature::Surface(point) => surface(path, point),
        Feature::Bore(bore) => round(path, bore),
        Feature::Pairs(pairs) => opposite(path, pairs),
        Feature::Corner(corner) => cornered(path, corner),
        Feature::TwoCircles(circles) => two_circles(path, circles.diameters),
        Feature::Wall(wall) => straight(path, wall),
    };
    all.extend(lift(path));
    all
}

/// Height of the last lift, straight up from the start of the path; there is no such move if the distance is 0.
fn lift(path: &Path) -> Option<Dimension> {
    let (field, [.., before, last]) = (path.lift_field?, path.moves.as_slice()) else {
        return None;
    };
    let lifts =
        last.feed == Feed::Return && (last.to - before.to).cross(path.frame.w).length() < 1e-9;
    lifts.then_some(Dimension {
        field,
        from: before.to,
        to: last.to,
        aside: path.frame.u,
        on_demand: true,
    })
}

/// Ball centre at the start of a touch.
fn begin_of(path: &Path, touch: usize) -> Option<Vec3> {
    let i = path
        .moves
        .iter()
        .position(|step| step.purpose == MovePurpose::Touch(touch))?;
    Some(path.moves[i.checked_sub(1)?].to)
}

/// Dimensions of a surface: distance of the start of its touch.
fn surface(path: &Path, point: &Point) -> Vec<Dimension> {
    let (Some(touch), Some(to)) = (path.touches.first(), begin_of(path, 0)) else {
        return Vec::new();
    };
    let w = path.frame.w;
    let aside = (w - touch.vector * w.dot(touch.vector))
        .try_normalize()
        .unwrap_or(path.frame.v);
    vec![Dimension {
        field: point.clearance,
        from: touch.point,
        to,
        aside,
        on_demand: false,
    }]
}

/// Dimensions of a wall: from touch to touch, and distance of the start of a touch.
fn straight(path: &Path, wall: &WallFeature) -> Vec<Dimension> {
    let [first, second] = path.touches.as_slice() else {
        return Vec::new();
    };
    let Some(to) = begin_of(path, 0) else {
        return Vec::new();
    };
    let (u, v) = (path.frame.u, path.frame.v);
    vec![
        Dimension {
            field: wall.distance.field,
            from: first.point,
            to: second.point,
            aside: -u,
            on_demand: false,
        },
        Dimension {
            field: wall.clearance,
            from: first.point,
            to,
            aside: -v,
            on_demand: false,
        },
    ]
}

/// Middle of a feature, on its top side.
fn middle(path: &Path) -> Vec3 {
    let (origin, w) = (path.frame.origin, path.frame.w);
    origin + w * (path.top.unwrap_or(origin.dot(w)) - origin.dot(w))
}

/// Dimension across the middle, offset by `aside`.
fn across(path: &Path, width: FieldValue, along: Vec3, aside: Vec3, far: f64) -> Dimension {
    let (center, half, edge) = (middle(path), along * (width.value / 2.0), aside * far);
    Dimension {
        field: width.field,
        from: center - half + edge,
        to: center + half + edge,
        aside,
        on_demand: false,
    }
}

/// Dimension from the top side down to the touches, at distance `far` from the middle.
fn deep(path: &Path, depth: FieldValue, far: f64) -> Dimension {
    let (u, w) = (path.frame.u, path.frame.w);
    let out = u * far;
    let from = middle(path) + out;
    Dimension {
        field: depth.field,
        from,
        to: from - w * depth.value,
        aside: out.normalize_or(u),
        on_demand: false,
    }
}

/// Dimensions of a hole or a boss.
fn round(path: &Path, bore: &Bore) -> Vec<Dimension> {
    let mut all = vec![
        across(path, bore.diameter, path.frame.u, -path.frame.v, 0.0),
        deep(path, bore.depth, bore.diameter.value / 2.0),
    ];
    all.extend(
        bore.clearance
            .and_then(|clearance| before(path, clearance, 0)),
    );
    all.extend(bore.crossing.and_then(|crossing| above(path, crossing)));
    all
}

/// Dimensions of opposite walls: each width at the end of its walls, next to the other pair if there is one.
fn opposite(path: &Path, pairs: &Pairs) -> Vec<Dimension> {
    let (u, v) = (path.frame.u, path.frame.v);
    let directions = [(u, -v), (v, -u)];
    let ends = path.surfaces.iter().filter_map(|surface| match surface {
        Surface::Flat(wall) => Some(wall.extent.0.abs().max(wall.extent.1.abs())),
        Surface::Round(_) | Surface::Unknown => None,
    });
    let far = ends.fold(0.0, f64::max);
    let mut all = Vec::new();
    for (side, (along, aside)) in pairs.sides.iter().zip(directions) {
        let other = pairs
            .sides
            .iter()
            .find(|other| other.width.field != side.width.field);
        all.push(across(
            path,
            side.width,
            along,
            aside,
            other.map_or(far, |other| other.width.value / 2.0),
        ));
    }
    all.extend(
        pairs
            .sides
            .first()
            .map(|first| deep(path, pairs.depth, first.width.value / 2.0)),
    );
    // At the first touch of each pair.
    let clearances = pairs
        .sides
        .iter()
        .enumerate()
        .filter_map(|(i, side)| before(path, side.clearance?, 2 * i));
    all.extend(clearances);
    all.extend(pairs.crossing.and_then(|crossing| above(path, crossing)));
    all
}

/// Dimension from a wall to the start of its touch.
fn before(path: &Path, clearance: FieldValue, touch: usize) -> Option<Dimension> {
    let touch = path.touches.get(touch)?;
    let to = touch.point + touch.vector * clearance.value;
    let aside = path.frame.w.cross(touch.vector);
    Some(Dimension {
        field: clearance.field,
        from: touch.point,
        to,
        aside,
        on_demand: true,
    })
}

/// Dimension from the top side, above the first touch, up to the crossing height.
fn above(path: &Path, crossing: FieldValue) -> Option<Dimension> {
    let (touch, height, w) = (path.touches.first()?, path.top?, path.frame.w);
    let from = touch.point + w * (height - touch.point.dot(w));
    Some(Dimension {
        field: crossing.field,
        from,
        to: from + w * crossing.value,
        aside: -touch.vector,
        on_demand: true,
    })
}

/// Dimensions of a corner's walls: from the first touch to its start, to the next touch, and, outside, from the corner at its level.
fn cornered(path: &Path, corner: &Corner) -> Vec<Dimension> {
    let (origin, w) = (path.frame.origin, path.frame.w);
    let mut all = Vec::new();
    for (group, wall) in corner.walls.iter().enumerate() {
        let mut touches = path
            .touches
            .iter()
            .enumerate()
            .filter(|(_, touch)| touch.group == group);
        let Some((k, first)) = touches.next() else {
            continue;
        };
        // Beside the corner, away from the other touches.
        let along = w
            .cross(first.vector)
            .try_normalize()
            .unwrap_or(path.frame.u);
        let aside = if along.dot(first.point - origin) > 0.0 {
            -along
        } else {
            along
        };
        let begin = begin_of(path, k);
        if let Some(to) = begin {
            all.push(Dimension {
                field: wall.clearance,
                from: first.point,
                to,
                aside,
                on_demand: true,
            });
        }
        // Behind the wall; for a corner from outside in front of the touches, since one wall is behind the other.
        let (aside, off) = if corner.outside {
            (
                first.vector,
                begin.map_or(Vec3::ZERO, |begin| begin - first.point),
            )
        } else {
            (-first.vector, Vec3::ZERO)
        };
        let beside = |field, from: Vec3, to: Vec3, on_demand| Dimension {
            field,
            from: from + off,
            to: to + off,
            aside,
            on_demand,
        };
        if let (Some((_, next)), Some(field)) = (touches.next(), wall.step) {
            all.push(beside(field, first.point, next.point, false));
        }
        if let Some(field) = wall.distance.filter(|_| corner.outside) {
            all.push(beside(
                field,
                origin + w * (first.point - origin).dot(w),
                first.point,
                true,
            ));
        }
    }
    if let Some(top) = &corner.top {
        on_top(path, top, &mut all);
    }
    all
}

/// Dimensions of a corner that is also touched on its top side: depth of the wall touches, and position of the top touch.
fn on_top(path: &Path, top: &Top, all: &mut Vec<Dimension>) {
    let [first, second, third] = path.touches.as_slice() else {
        return;
    };
    let (origin, w) = (path.frame.origin, path.frame.w);
    let level = w * (origin - first.point).dot(w);
    // Away from both walls, so that it is visible in front and side view.
    let aside = (first.vector + second.vector)
        .try_normalize()
        .unwrap_or(first.vector);
    let (from, to) = (first.point + level, first.point);
    all.push(Dimension {
        field: top.depth,
        from,
        to,
        aside,
        on_demand: false,
    });
    for (wall, field) in [first, second].into_iter().zip(top.inwards) {
        let from = third.point + wall.vector * (wall.point - third.point).dot(wall.vector);
        let aside = w.cross(wall.vector);
        all.push(Dimension {
            field,
            from,
            to: third.point,
            aside,
            on_demand: true,
        });
    }
    if let Some(to) = begin_of(path, 2) {
        all.push(Dimension {
            field: top.clearance,
            from: third.point,
            to,
            aside: first.vector,
            on_demand: true,
        });
    }
}

/// The diameters of two circles.
fn two_circles(path: &Path, diameters: [&'static str; 2]) -> Vec<Dimension> {
    let (u, aside) = (path.frame.u, -path.frame.v);
    let circles =
        path.surfaces
            .iter()
            .zip(diameters)
            .filter_map(|(surface, field)| match surface {
                Surface::Round(round) => {
                    let half = u * round.radius;
                    Some(Dimension {
                        field,
                        from: round.center - half,
                        to: round.center + half,
                        aside,
                        on_demand: false,
                    })
                }
                Surface::Flat(_) | Surface::Unknown => None,
            });
    circles.collect()
}
