//! Corners of two walls, each touched once or more.
//!
//! In the frame (u, v) wall 1 runs from the corner along +v, wall 2 along (sin A, cos A). A is the angle between them: inside an internal corner, in the
//! material of an external one. Picked touches may name the walls in the opposite order; then the corner is mirrored at the u axis.

use crate::cycle::ency::picked_touches::{self, NEAR, Pick};
use crate::cycle::ency::shape::{
    PlacedShape, Probed, Shape, TouchLayout, begin, clearance_rule, constant, flat, lift,
    touch_count_rule,
};
use crate::form::Checker;
use crate::formula::{Draft, Expr, Formula, Name, OffsetCorrection, Role, Value};
use crate::geom::{Frame, Plane, Vec3};
use crate::path::{
    self, Feature, Feed, FieldValue, ProbeSettings, Surface, Tracer, Wall, WallTouch,
};
use crate::text::{Text, text, words};

pub const ANGLE: &str = "cycle.angle";

/// The fields of the two walls.
pub const WALLS: [WallTouch; 2] = [
    WallTouch {
        clearance: "cycle.clearance1",
        step: Some("cycle.step1"),
        distance: Some("cycle.distance1"),
    },
    WallTouch {
        clearance: "cycle.clearance2",
        step: Some("cycle.step2"),
        distance: Some("cycle.distance2"),
    },
];

/// Angle between two walls: inside an internal corner, in the material of an external one.
#[derive(Clone, Copy, Debug)]
pub struct CornerAngle {
    /// Degrees, above 0 and below 180.
    pub degrees: f64,
    /// Whether the walls are named in the opposite order.
    pub mirrored: bool,
}

impl CornerAngle {
    /// The angle of a form.
    pub fn of(degrees: f64) -> Self {
        CornerAngle {
            degrees,
            mirrored: false,
        }
    }

    /// Degrees from wall 1 to wall 2, clockwise positive.
    pub fn signed(self) -> f64 {
        if self.mirrored {
            -self.degrees
        } else {
            self.degrees
        }
    }
}

/// A corner of two walls. Arrays are indexed by wall.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    /// Whether the material is outside the corner.
    pub internal: bool,
    pub angle: CornerAngle,
    /// From the wall to the ball centre where its touches begin, mm.
    pub clearances: [f64; 2],
    /// Touches on each wall.
    pub counts: [usize; 2],
    /// From touch to touch, mm.
    pub steps: [f64; 2],
    /// From the corner to the first touch, mm; `None` if the first touch is opposite to the start.
    pub distances: Option<[f64; 2]>,
}

/// One wall, in the frame (u, v).
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// Along the wall, away from the corner.
    pub along: (f64, f64),
    /// Outward normal.
    pub normal: (f64, f64),
    /// From the corner to its first touch.
    pub first: f64,
}

/// Directions of the two walls and the start at `clearances` from both. With wall 1 on the v axis the start of an inside corner is u = c1, v = (c2 + c1·cos A)
/// / sin A. By symmetry its foot on wall 2 is (c1 + c2·cos A) / sin A from the corner. For an outside corner the start is mirrored at the corner.
pub fn walls(
    internal: bool,
    angle: CornerAngle,
    clearances: [f64; 2],
    distances: Option<[f64; 2]>,
) -> ([Side; 2], (f64, f64)) {
    let (sin, cos) = angle.signed().to_radians().sin_cos();
    let [c1, c2] = clearances;
    let side = if internal { 1.0 } else { -1.0 };
    let hand = sin.signum();
    let feet = [(c2 + c1 * cos) / sin, (c1 + c2 * cos) / sin];
    let first = distances.unwrap_or(feet.map(|foot| foot * hand));
    let sides = [
        Side {
            along: (0.0, hand),
            normal: (side, 0.0),
            first: first[0],
        },
        Side {
            along: (sin * hand, cos * hand),
            normal: (-cos * side, sin * side),
            first: first[1],
        },
    ];
    (sides, (c1 * side, feet[0] * side))
}

/// Direction along a wall, away from the corner, from its outward normal.
fn along(internal: bool, mirrored: bool, wall: usize, normal: (f64, f64)) -> (f64, f64) {
    // Inside: counter-clockwise from the normal of wall 1, clockwise from that of wall 2. Outside or mirrored: the opposite.
    if (internal == (wall == 0)) != mirrored {
        (-normal.1, normal.0)
    } else {
        (normal.1, -normal.0)
    }
}

/// Direction (degrees) and angle of a corner from the normals of its walls.
pub fn from_normals(internal: bool, plane: Plane, normals: [Vec3; 2]) -> (f64, CornerAngle) {
    let side = if internal { 1.0 } else { -1.0 };
    let [n1, n2] = normals.map(|n| {
        let (a, o) = flat(plane, n);
        (a * side, o * side)
    });
    let rotation = n1.1.atan2(n1.0).to_degrees();
    // n2 = (−cos A, sin A) if n1 is the first direction.
    let (x, y) = (n2.0 * n1.0 + n2.1 * n1.1, n2.1 * n1.0 - n2.0 * n1.1);
    let degrees = y.atan2(-x).to_degrees();
    (
        rotation,
        CornerAngle {
            degrees: degrees.abs(),
            mirrored: degrees < 0.0,
        },
    )
}

/// Intersection of two walls at the level of the first touch.
pub fn meeting(plane: Plane, one: &Pick, two: &Pick) -> Option<Vec3> {
    let [a, o, _] = plane.axes();
    let ((a1, o1), (a2, o2)) = (flat(plane, one.vector), flat(plane, two.vector));
    let q = |pick: &Pick, n: (f64, f64)| pick.point[a] * n.0 + pick.point[o] * n.1;
    let (q1, q2) = (q(one, (a1, o1)), q(two, (a2, o2)));
    let det = a1 * o2 - o1 * a2;
    if det.abs() < 1e-6 {
        return None;
    }
    let mut corner = one.point;
    (corner[a], corner[o]) = ((q1 * o2 - q2 * o1) / det, (a1 * q2 - a2 * q1) / det);
    Some(corner)
}

/// Reports walls on the wrong side of each other: each is in front of the other inside a corner, behind it outside.
pub fn sides_rule(internal: bool, firsts: &[(usize, Pick)], checker: &mut Checker) {
    for (k, pick) in firsts {
        let wrong = firsts.iter().filter(|(j, _)| j != k).any(|(_, other)| {
            let front = (other.point - pick.point).dot(pick.vector);
            if internal { front <= 0.0 } else { front >= 0.0 }
        });
        if wrong {
            picked_touches::turned_inwards(*k, internal, checker);
        }
    }
}

impl Corner {
    pub fn sizes(&mut self) -> Vec<(&'static str, &mut f64)> {
        let mut sizes = vec![(ANGLE, &mut self.angle.degrees)];
        if let Some([first, second]) = &mut self.distances {
            sizes.extend([("cycle.distance1", first), ("cycle.distance2", second)]);
        }
        // A single touch has no step.
        let steps = ["cycle.step1", "cycle.step2"]
            .into_iter()
            .zip(&mut self.steps);
        sizes.extend(
            steps
                .zip(self.counts)
                .filter(|(_, count)| *count > 1)
                .map(|(step, _)| step),
        );
        sizes
    }

    fn sides(&self) -> ([Side; 2], (f64, f64)) {
        walls(self.internal, self.angle, self.clearances, self.distances)
    }

    fn wall_of(&self, k: usize) -> usize {
        usize::from(k >= self.counts[0])
    }
}

impl Probed for Corner {
    fn touches(&self, frame: &Frame) -> Vec<(Vec3, Vec3, usize)> {
        let (sides, _) = self.sides();
        let mut touches = Vec::new();
        for (wall, side) in sides.iter().enumerate() {
            let direction = frame.direction(side.along.0, side.along.1);
            let vector = frame.direction(side.normal.0, side.normal.1);
            for i in 0..self.counts[wall] {
                touches.push((
                    frame.origin + direction * (side.first + i as f64 * self.steps[wall]),
                    vector,
                    wall,
                ));
            }
        }
        touches
    }

    fn name(&self, k: usize) -> Text {
        match self.wall_of(k) {
            0 => text!("Point {number} on the first side", k + 1),
            _ => text!("Point {number} on the second side", k - self.counts[0] + 1),
        }
    }

    fn rules(&self, setup: &ProbeSettings, checker: &mut Checker) {
        clearance_rule(
            checker,
            setup,
            "Clearance 1",
            self.clearances[0],
            "cycle.clearance1",
        );
        clearance_rule(
            checker,
            setup,
            "Clearance 2",
            self.clearances[1],
            "cycle.clearance2",
        );
        if checker.is_clean(&["cycle.count1", "cycle.count2"]) {
            let path = if self.counts[0] >= self.counts[1] {
                "cycle.count1"
            } else {
                "cycle.count2"
            };
            touch_count_rule(checker, self.counts[0] + self.counts[1], path);
        }
        let paths = [
            "cycle.clearance1",
            "cycle.clearance2",
            "cycle.angle",
            "stylus.diameter",
        ];
        if !self.internal || !checker.is_clean(&paths) {
            return;
        }
        // The first touch of a wall is opposite to a point at `first` from the corner. The ball in contact there is c_other + (c − r)·cos A from the other
        // wall.
        let cos = self.angle.signed().to_radians().cos();
        let (sides, _) = self.sides();
        for (n, other) in [(0, 1), (1, 0)] {
            let free = self.clearances[other] + (self.clearances[n] - setup.radius) * cos;
            let angle = crate::num::decimal(self.angle.signed(), 4);
            let (first, n1, other1) = (sides[n].first, n + 1, other + 1);
            let message = if first <= 0.0 {
                text!(
                    "The first touch of wall {wall} would be {way} past the corner: at {angle}° clearance {other} must be larger than {least}",
                    n1,
                    checker.length(-first),
                    angle,
                    other1,
                    checker.length(-self.clearances[n] * cos)
                )
            } else if free <= setup.radius {
                text!(
                    "In the first touch of wall {wall} the ball would contact wall {other} first: at {angle}° clearance {other} must be larger than {least}",
                    n1,
                    other1,
                    angle,
                    checker.length(setup.radius - (self.clearances[n] - setup.radius) * cos)
                )
            } else {
                continue;
            };
            checker.error(
                "touch-beyond-corner",
                format!("cycle.clearance{other1}"),
                message,
            );
        }
    }

    fn check(&self, picks: &[Pick], plane: Plane, checker: &mut Checker) {
        if !picked_touches::counted(picks, self.counts[0] + self.counts[1], checker) {
            return;
        }
        let all: Vec<usize> = (0..picks.len()).collect();
        picked_touches::levelled(picks, &all, plane, checker);
        picked_touches::one_level(picks, &all, plane, checker);
        let firsts = [0, self.counts[0]];
        for (k, pick) in picks.iter().enumerate() {
            let first = &picks[firsts[self.wall_of(k)]];
            let away = pick.point - first.point;
            // A vector may be off by a thousandth: over a distance this is the resulting offset.
            let off = away.dot(first.vector).abs();
            let same = (pick.vector - first.vector).length() <= 2.0 * NEAR
                && off <= NEAR * (1.0 + 2.0 * away.length());
            if same
                && picks[firsts[self.wall_of(k)]..k]
                    .iter()
                    .any(|p| p.point.distance(pick.point) < NEAR / 2.0)
            {
                let message = text!(
                    "Touch {touch} coincides with another of its wall: only touches apart give its direction",
                    k + 1
                );
                checker.error("touches-coincide", format!("cycle.touches[{k}]"), message);
            }
            if !same {
                let message = text!(
                    "Touch {touch} is not on the same wall as touch {other}",
                    k + 1,
                    firsts[self.wall_of(k)] + 1
                );
                checker.error("not-on-one-wall", format!("cycle.touches[{k}]"), message);
            }
        }
        if !checker.is_clean(&["cycle.touches"]) {
            return;
        }
        let [one, two] = firsts.map(|k| picks[k]);
        if meeting(plane, &one, &two).is_none() {
            checker.error(
                "walls-parallel",
                "cycle.touches",
                text!("The two walls are parallel: they make no corner"),
            );
            return;
        }
        sides_rule(
            self.internal,
            &[(firsts[0], one), (firsts[1], two)],
            checker,
        );
        if self.internal && checker.is_clean(&["cycle.touches"]) {
            let reading = |i: usize| {
                (
                    firsts[i],
                    picks[firsts[i]].point + picks[firsts[i]].vector * self.clearances[i],
                )
            };
            picked_touches::one_start(
                &[reading(0), reading(1)],
                self.clearances[0].max(self.clearances[1]),
                checker,
            );
        }
    }

    fn place(&self, picks: &[Pick], plane: Plane) -> PlacedShape {
        let [one, two] = [picks[0], picks[self.counts[0].min(picks.len() - 1)]];
        let origin = meeting(plane, &one, &two).unwrap_or(one.point);
        let (rotation, angle) = from_normals(self.internal, plane, [one.vector, two.vector]);
        let distances = self.distances.map(|_| {
            let level = plane.basis()[2];
            let away = two.point - origin;
            [
                (one.point - origin).length(),
                (away - level * away.dot(level)).length(),
            ]
        });
        let mut steps = self.steps;
        let (first, second) = picks.split_at(self.counts[0].min(picks.len()));
        for (step, touches) in steps.iter_mut().zip([first, second]) {
            if let [a, b, ..] = touches {
                *step = a.point.distance(b.point);
            }
        }
        PlacedShape {
            origin,
            rotation,
            shape: Shape::Corner(Corner {
                angle,
                distances,
                steps,
                ..*self
            }),
        }
    }

    fn plan_steps(&self, on: &TouchLayout<'_>, tracer: &mut Tracer) {
        let (_, (u, v)) = self.sides();
        let start = on.frame.point(u, v, 0.0);
        begin(on, tracer, start, 1);
        // Step numbers of each side: first touch, further touches, back to the start.
        for (wall, [first, further, back]) in [[2, 3, 5], [6, 7, 9]].into_iter().enumerate() {
            let touches = on
                .touches
                .iter()
                .enumerate()
                .filter(|(_, t)| t.group == wall);
            for (i, (k, touch)) in touches.enumerate() {
                let step = if i == 0 { first } else { further };
                if i > 0 || !self.internal {
                    tracer.position(
                        touch.point + touch.vector * self.clearances[wall],
                        Feed::LongLink,
                        step,
                    );
                }
                tracer.touch(k, touch, Feed::LongLink, step);
            }
            tracer.position(start, Feed::LongLink, back);
        }
        lift(on, tracer, start, 10);
    }

    /// Each wall is a line through the mean of the ball centres, along their total-least-squares direction if there are two or more touches, else along the
    /// nominal direction; then it is offset by the ball radius along its normal. The corner is the intersection.
    fn formula(&self, on: &TouchLayout<'_>) -> Formula {
        let plane = on.setup.plane;
        let [a, o, _] = plane.axes();
        let origin = on.frame.origin;
        let f = Draft::with_room_for(on.touches.len());
        let firsts = [0, self.counts[0]];
        let [one, two] = [0, 1].map(|i| {
            let normal = flat(plane, on.touches[firsts[i]].vector);
            let line = Line {
                number: i + 1,
                first: firsts[i],
                count: self.counts[i],
                along: along(self.internal, self.angle.mirrored, i, normal),
                normal,
            };
            line.fit(&f, (a, o), on.setup.radius)
        });
        // Cramer's rule on n1·p = q1, n2·p = q2.
        let det = f.set(
            "det",
            one.normal.0 * two.normal.1 - one.normal.1 * two.normal.0,
        );
        let x = (one.offset * two.normal.1 - two.offset * one.normal.1) / det;
        let y = (two.offset * one.normal.0 - one.offset * two.normal.0) / det;
        let x = f.set("corner_x", x);
        let y = f.set("corner_y", y);
        // A positive tilt rotates a wall towards its free side: both make the angle smaller inside, larger outside. Inside, wall 1 has its free side to the
        // right of its direction and rotates clockwise; outside or mirrored, the opposite.
        let tilts = one.tilt.zip(two.tilt);
        let clockwise = self.internal != self.angle.mirrored;
        let rotation = one.tilt.map(|tilt| {
            f.set(
                "rotation",
                if clockwise {
                    f.number(0.0) - tilt
                } else {
                    tilt.into()
                },
            )
        });
        let nominal = self.angle.degrees;
        let angle = tilts.map(|(t1, t2)| {
            let sum = if self.internal {
                f.number(nominal) - t1 - t2
            } else {
                f.number(nominal) + t1 + t2
            };
            f.set("angle", sum)
        });
        f.result(
            "corner.x",
            Role::Abscissa,
            words!("Corner, abscissa"),
            origin[a],
            Some(x),
        );
        f.result(
            "corner.y",
            Role::Ordinate,
            words!("Corner, ordinate"),
            origin[o],
            Some(y),
        );
        f.result(
            "angle",
            Role::Angle,
            words!("Angle between the walls"),
            nominal,
            angle,
        );
        f.result(
            "rotation",
            Role::Direction,
            words!("Wall 1 against its nominal direction"),
            0.0,
            rotation,
        );
        for (residual, code, meaning) in [
            (
                one.residual,
                "residual1",
                words!("Residual of wall 1, root mean square"),
            ),
            (
                two.residual,
                "residual2",
                words!("Residual of wall 2, root mean square"),
            ),
        ] {
            if residual.is_some() {
                f.result(code, Role::Residual, meaning, 0.0, residual);
            }
        }
        let datum = OffsetCorrection::point((x, origin[a]), (y, origin[o]));
        f.finish(Some(datum))
    }

    fn surfaces(&self, on: &TouchLayout<'_>) -> Vec<Surface> {
        let margin = 3.0 * on.setup.radius.max(2.0);
        let (sides, _) = self.sides();
        sides
            .iter()
            .enumerate()
            .map(|(wall, side)| {
                let last =
                    side.first.max(0.0) + (self.counts[wall].max(1) - 1) as f64 * self.steps[wall];
                Surface::Flat(Wall {
                    point: on.frame.origin,
                    normal: on.frame.direction(side.normal.0, side.normal.1),
                    along: on.frame.direction(side.along.0, side.along.1),
                    extent: (0.0, last + margin),
                    drawn_depth: 2.0 * on.setup.radius.max(1.0),
                    has_top: false,
                    body: if self.internal { wall } else { 0 },
                })
            })
            .collect()
    }

    fn feature(&self) -> Feature {
        let angle = FieldValue {
            field: ANGLE,
            value: self.angle.degrees,
        };
        Feature::Corner(path::Corner {
            outside: !self.internal,
            angle,
            walls: WALLS.to_vec(),
            top: None,
        })
    }

    fn top(&self, _on: &TouchLayout<'_>) -> Option<f64> {
        None
    }

    fn turned_error(&self, code: &str) -> Option<&'static str> {
        (self.counts.contains(&1) && code.starts_with("corner.")).then_some(words!(
            "a wall with one touch is assumed to have its nominal direction, which is wrong on a rotated part: add a second touch"
        ))
    }
}

/// The touches of a wall and its nominal directions in the plane.
struct Line {
    number: usize,
    first: usize,
    count: usize,
    along: (f64, f64),
    normal: (f64, f64),
}

/// The fitted wall: normal · p = offset, both in the plane.
struct FittedWall<'f> {
    normal: (Expr<'f>, Expr<'f>),
    offset: Value<'f>,
    /// Angle of its direction from nominal in (along, normal), degrees.
    tilt: Option<Value<'f>>,
    /// Root mean square distance of the touches from the wall, if there are more than two.
    residual: Option<Value<'f>>,
}

impl Line {
    fn fit<'f>(&self, f: &'f Draft, (a, o): (usize, usize), radius: f64) -> FittedWall<'f> {
        let n = self.number;
        let touches = self.first..self.first + self.count;
        let place = |touch: usize, direction| {
            f.project(f.trigger(touch, a), f.trigger(touch, o), direction)
        };
        if self.count == 1 {
            let height = place(self.first, self.normal) - f.length(radius);
            let offset = f.set(Name::new("q", n), height);
            let normal = (constant(f, self.normal.0), constant(f, self.normal.1));
            return FittedWall {
                normal,
                offset,
                tilt: None,
                residual: None,
            };
        }
        let places: Vec<(Value<'_>, Value<'_>)> = touches
            .map(|touch| {
                let s = f.set(Name::new("s", touch + 1), place(touch, self.along));
                let h = f.set(Name::new("h", touch + 1), place(touch, self.normal));
                (s, h)
            })
            .collect();
        let count = f.number(self.count as f64);
        let mean_s = f.set(
            Name::new("mean_s", n),
            f.sum(places.iter().map(|p| p.0)) / count,
        );
        let mean_h = f.set(
            Name::new("mean_h", n),
            f.sum(places.iter().map(|p| p.1)) / count,
        );
        let scatter = (self.count > 2).then(|| self.scatter(f, &places, (mean_s, mean_h)));
        let tilt = match (scatter, places.as_slice()) {
            (Some(scatter), _) => scatter.direction(f),
            (None, [(s1, h1), .., (s2, h2)]) => ((*h2 - *h1) / (*s2 - *s1)).atan2(f.number(1.0)),
            (None, _) => f.number(0.0),
        };
        let tilt = f.set(Name::new("tilt", n), tilt);
        let sin = f.set(Name::new("sin", n), tilt.sin());
        let cos = f.set(Name::new("cos", n), tilt.cos());
        let offset = mean_h * cos - mean_s * sin - f.length(radius);
        let offset = f.set(Name::new("q", n), offset);
        let turned = |name: &'static str, along: f64, normal: f64| {
            f.set(Name::new(name, n), f.project(cos, sin, (normal, -along)))
        };
        let normal = (
            turned("na", self.along.0, self.normal.0).into(),
            turned("no", self.along.1, self.normal.1).into(),
        );
        let residual = scatter.map(|scatter| {
            f.set(
                Name::new("residual", n),
                scatter.residual(f, (sin, cos), self.count),
            )
        });
        FittedWall {
            normal,
            offset,
            tilt: Some(tilt),
            residual,
        }
    }

    /// Scatter of positions about their mean.
    fn scatter<'f>(
        &self,
        f: &'f Draft,
        places: &[(Value<'f>, Value<'f>)],
        (mean_s, mean_h): (Value<'f>, Value<'f>),
    ) -> Scatter<'f> {
        let n = self.number;
        let (mut ss, mut hh, mut sh) = (f.number(0.0), f.number(0.0), f.number(0.0));
        for (i, &(s, h)) in places.iter().enumerate() {
            let touch = self.first + i + 1;
            let ds = f.set(Name::new("ds", touch), s - mean_s);
            let dh = f.set(Name::new("dh", touch), h - mean_h);
            ss = f
                .set(Name::new("ss", n).and("_").at(i + 1), ss + ds * ds)
                .into();
            hh = f
                .set(Name::new("hh", n).and("_").at(i + 1), hh + dh * dh)
                .into();
            sh = f
                .set(Name::new("sh", n).and("_").at(i + 1), sh + ds * dh)
                .into();
        }
        Scatter { ss, hh, sh }
    }
}

/// Sums of squares and products of positions along and across a wall, about their mean.
#[derive(Clone, Copy)]
struct Scatter<'f> {
    ss: Expr<'f>,
    hh: Expr<'f>,
    sh: Expr<'f>,
}

impl<'f> Scatter<'f> {
    /// Angle from nominal of the direction with the largest scatter: tan 2t = 2·Ssh / (Sss − Shh).
    fn direction(self, f: &'f Draft) -> Expr<'f> {
        (f.number(2.0) * self.sh).atan2(self.ss - self.hh) / f.number(2.0)
    }

    /// Root mean square distance from the line in a direction: the distance of a position is h·cos t − s·sin t.
    fn residual(self, f: &'f Draft, (sin, cos): (Value<'f>, Value<'f>), count: usize) -> Expr<'f> {
        let square =
            self.hh * cos * cos - f.number(2.0) * self.sh * sin * cos + self.ss * sin * sin;
        // Rounding may make it negative.
        (square.abs() / f.number(count as f64)).sqrt()
    }
}
