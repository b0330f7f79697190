//! Corners of three walls, each touched once: one plane each, in any direction of space.

use crate::cycle::ency::picked_touches::{self, NEAR, Pick};
use crate::cycle::ency::shape::corner::{self, ANGLE, CornerAngle, WALLS, sides_rule};
use crate::cycle::ency::shape::{
    PlacedShape, Probed, Shape, TouchLayout, begin, clearance_rule, constant, level_rules, lift,
};
use crate::form::Checker;
use crate::formula::{Coordinate, Draft, Formula, Name, OffsetCorrection, Role};
use crate::geom::{Frame, Plane, Vec3};
use crate::path::{
    Corner, Feature, Feed, FieldValue, ProbeSettings, Surface, Top, Tracer, Wall, WallTouch,
};
use crate::text::{Text, text, words};

/// A corner of two walls and a floor, or of two walls and a top side.
#[derive(Clone, Copy, Debug)]
pub struct Triple {
    /// Angle between the first two walls.
    pub angle: CornerAngle,
    /// From each surface to the ball centre where its touch begins, mm.
    pub clearances: [f64; 3],
    /// Additional dimensions of an external corner; `None` is an internal corner.
    pub outside: Option<Outside>,
}

/// Touch positions of an external corner.
#[derive(Clone, Copy, Debug)]
pub struct Outside {
    /// From the top side down to the touches of the walls, mm.
    pub depth: f64,
    /// From the corner along each wall to its touch, mm.
    pub distances: [f64; 2],
    /// From each wall inwards to the touch on the top side, mm.
    pub inwards: [f64; 2],
}

impl Triple {
    pub fn sizes(&mut self) -> Vec<(&'static str, &mut f64)> {
        let mut sizes = vec![(ANGLE, &mut self.angle.degrees)];
        if let Some(Outside {
            depth,
            distances: [first, second],
            inwards: [top1, top2],
        }) = &mut self.outside
        {
            let outside = [
                ("cycle.depth", depth),
                ("cycle.distance1", first),
                ("cycle.distance2", second),
                ("cycle.topDistance1", top1),
                ("cycle.topDistance2", top2),
            ];
            sizes.extend(outside);
        }
        sizes
    }

    fn internal(&self) -> bool {
        self.outside.is_none()
    }

    /// The start in the plane, and the two walls.
    fn walls(&self) -> ([corner::Side; 2], (f64, f64)) {
        corner::walls(
            self.internal(),
            self.angle,
            [self.clearances[0], self.clearances[1]],
            self.outside.map(|o| o.distances),
        )
    }

    /// Intersection of the planes of three touches.
    fn meeting(picks: &[Pick]) -> Option<Vec3> {
        let n = [0, 1, 2].map(|k| picks[k].vector);
        let det = n[0].dot(n[1].cross(n[2]));
        if det.abs() < 1e-6 {
            return None;
        }
        let q = [0, 1, 2].map(|k| picks[k].vector.dot(picks[k].point));
        Some((n[1].cross(n[2]) * q[0] + n[2].cross(n[0]) * q[1] + n[0].cross(n[1]) * q[2]) / det)
    }
}

impl Probed for Triple {
    fn touches(&self, frame: &Frame) -> Vec<(Vec3, Vec3, usize)> {
        let (sides, (u, v)) = self.walls();
        let normals = sides.map(|s| frame.direction(s.normal.0, s.normal.1));
        match self.outside {
            None => {
                // From the start straight to each surface.
                let start = frame.point(u, v, self.clearances[2]);
                let surfaces = [normals[0], normals[1], frame.w];
                (0..3)
                    .map(|k| (start - surfaces[k] * self.clearances[k], surfaces[k], k))
                    .collect()
            }
            Some(outside) => {
                let mut touches: Vec<(Vec3, Vec3, usize)> = (0..2)
                    .map(|k| {
                        let along = frame.direction(sides[k].along.0, sides[k].along.1);
                        let point =
                            frame.origin + along * outside.distances[k] - frame.w * outside.depth;
                        (point, normals[k], k)
                    })
                    .collect();
                // Behind both walls by these distances: the start of an internal corner with these clearances.
                let (_, (u, v)) = corner::walls(true, self.angle, outside.inwards, None);
                touches.push((frame.point(u, v, 0.0), frame.w, 2));
                touches
            }
        }
    }

    fn name(&self, k: usize) -> Text {
        match (k, self.internal()) {
            (0, _) => text!("First wall"),
            (1, _) => text!("Second wall"),
            (_, true) => text!("Third wall"),
            (_, false) => text!("Top side"),
        }
    }

    fn rules(&self, setup: &ProbeSettings, checker: &mut Checker) {
        let third = if self.internal() {
            ("Clearance 3", "cycle.clearance3")
        } else {
            ("Top clearance", "cycle.topClearance")
        };
        let names = [
            ("Clearance 1", "cycle.clearance1"),
            ("Clearance 2", "cycle.clearance2"),
            third,
        ];
        for ((label, path), clearance) in names.into_iter().zip(self.clearances) {
            clearance_rule(checker, setup, label, clearance, path);
        }
        if let Some(outside) = self.outside {
            level_rules(checker, setup, outside.depth, None, true);
            return;
        }
        if !checker.is_clean(&[
            "cycle.clearance1",
            "cycle.clearance2",
            "cycle.angle",
            "stylus.diameter",
        ]) {
            return;
        }
        let cos = self.angle.signed().to_radians().cos();
        for (n, other) in [(0, 1), (1, 0)] {
            let free = self.clearances[other] + (self.clearances[n] - setup.radius) * cos;
            if free <= setup.radius {
                let message = text!(
                    "In the touch of wall {n} the ball would contact wall {other} first: at {angle}° clearance {other2} must be larger than {least}",
                    n + 1,
                    other + 1,
                    crate::num::decimal(self.angle.signed(), 4),
                    other + 1,
                    checker.length(setup.radius - (self.clearances[n] - setup.radius) * cos)
                );
                checker.error(
                    "touch-beyond-corner",
                    format!("cycle.clearance{}", other + 1),
                    message,
                );
            }
        }
    }

    fn check(&self, picks: &[Pick], plane: Plane, checker: &mut Checker) {
        if !picked_touches::counted(picks, 3, checker) {
            return;
        }
        if Self::meeting(picks).is_none() {
            checker.error(
                "walls-parallel",
                "cycle.touches",
                text!("The three surfaces do not meet in one point: they form no corner"),
            );
            return;
        }
        let firsts: Vec<(usize, Pick)> = picks.iter().copied().enumerate().collect();
        sides_rule(self.internal(), &firsts, checker);
        if !checker.is_clean(&["cycle.touches"]) {
            return;
        }
        let up = plane.basis()[2];
        if self.internal() {
            picked_touches::none_overhangs(picks, plane, checker);
            let readings: Vec<(usize, Vec3)> = (0..3)
                .map(|k| (k, picks[k].point + picks[k].vector * self.clearances[k]))
                .collect();
            picked_touches::one_start(
                &readings,
                self.clearances.iter().copied().fold(0.0, f64::max),
                checker,
            );
        } else {
            picked_touches::levelled(picks, &[0, 1], plane, checker);
            picked_touches::one_level(picks, &[0, 1], plane, checker);
            picked_touches::below_top(picks, &[0, 1], 2, plane, checker);
            if (picks[2].vector - up).length() > NEAR {
                let message = text!(
                    "The third touch is on the top side: its target vector must be along the tool axis"
                );
                checker.error("vector-not-upwards", "cycle.touches[2].vector", message);
            }
        }
    }

    fn place(&self, picks: &[Pick], plane: Plane) -> PlacedShape {
        let origin = Self::meeting(picks).unwrap_or(picks[0].point);
        let (rotation, angle) =
            corner::from_normals(self.internal(), plane, [picks[0].vector, picks[1].vector]);
        let outside = self.outside.map(|_| {
            let up = plane.basis()[2];
            let in_plane = |pick: &Pick| {
                let away = pick.point - origin;
                (away - up * away.dot(up)).length()
            };
            Outside {
                depth: (picks[2].point - picks[0].point).dot(up),
                distances: [in_plane(&picks[0]), in_plane(&picks[1])],
                inwards: [0, 1].map(|k| -(picks[2].point - origin).dot(picks[k].vector)),
            }
        });
        PlacedShape {
            origin,
            rotation,
            shape: Shape::Triple(Triple {
                angle,
                outside,
                ..*self
            }),
        }
    }

    fn plan_steps(&self, on: &TouchLayout<'_>, tracer: &mut Tracer) {
        let (_, (u, v)) = self.walls();
        let start = if self.internal() {
            on.touches[0].point + on.touches[0].vector * self.clearances[0]
        } else {
            on.frame.point(u, v, self.clearances[2])
        };
        begin(on, tracer, start, 1);
        for (k, touch) in on.touches.iter().enumerate() {
            if self.internal() {
                tracer.touch(k, touch, Feed::LongLink, k as u8 + 2);
                continue;
            }
            let step = 2 * k as u8 + 2;
            tracer.position(
                touch.point + touch.vector * self.clearances[k],
                Feed::LongLink,
                step,
            );
            tracer.touch(k, touch, Feed::LongLink, step);
            tracer.position(start, Feed::LongLink, step + 1);
        }
        let last = if self.internal() { 5 } else { 8 };
        lift(on, tracer, start, last);
    }

    /// Each surface keeps its nominal direction n and is one ball radius behind its trigger: n·p = q. The corner is the intersection of the three planes: Σ
    /// q·(cross product of the other two normals) / triple product of the normals.
    fn formula(&self, on: &TouchLayout<'_>) -> Formula {
        let axes = on.setup.plane.axes();
        let n = [0, 1, 2].map(|k| on.touches[k].vector);
        let det = n[0].dot(n[1].cross(n[2]));
        let f = Draft::with_room_for(on.touches.len());
        let q = [0, 1, 2].map(|k| {
            let sum = f.sum(
                axes.iter()
                    .map(|&axis| f.trigger(k, axis) * constant(&f, n[k][axis])),
            );
            f.set(Name::new("q", k + 1), sum - f.length(on.setup.radius))
        });
        let weights = [
            n[1].cross(n[2]) / det,
            n[2].cross(n[0]) / det,
            n[0].cross(n[1]) / det,
        ];
        let nominal: Vec3 = (0..3)
            .map(|k| weights[k] * n[k].dot(on.touches[k].point))
            .sum();
        let codes = [
            (
                "corner.x",
                "corner_x",
                words!("Corner, abscissa"),
                Role::Abscissa,
            ),
            (
                "corner.y",
                "corner_y",
                words!("Corner, ordinate"),
                Role::Ordinate,
            ),
            (
                "corner.z",
                "corner_z",
                words!("Corner, along the tool axis"),
                Role::Level,
            ),
        ];
        let mut place = [None, None, None];
        for (i, (code, name, meaning, role)) in codes.into_iter().enumerate() {
            let axis = axes[i];
            let value = f.set(
                name,
                f.sum((0..3).map(|k| q[k] * constant(&f, weights[k][axis]))),
            );
            f.result(code, role, meaning, nominal[axis], Some(value));
            place[i] = Some(Coordinate::measured(value, crate::num::tidy(nominal[axis])));
        }
        f.finish(Some(OffsetCorrection::of(place)))
    }

    fn surfaces(&self, on: &TouchLayout<'_>) -> Vec<Surface> {
        let margin = 3.0 * on.setup.radius.max(2.0);
        let (sides, _) = self.walls();
        // All surfaces get the same length, so that they meet at their ends.
        let length = on
            .touches
            .iter()
            .map(|touch| touch.point.distance(on.frame.origin))
            .fold(0.0, f64::max)
            + margin;
        on.touches
            .iter()
            .enumerate()
            .map(|(k, touch)| {
                let level = k == 2;
                let [one, two] = sides.map(|s| on.frame.direction(s.along.0, s.along.1));
                let along = if k == 0 { one } else { two };
                // Drawn through the corner; contacts are found at the touch.
                let origin = on.frame.origin;
                let mut point = origin + touch.vector * (touch.point - origin).dot(touch.vector);
                let mut drawn_depth = self.outside.map_or(self.clearances[2], |o| o.depth) + margin;
                if level {
                    // From the corner along both walls: a level surface is drawn to both sides of its point.
                    drawn_depth = length / 2.0;
                    point += (one - touch.vector * one.dot(touch.vector)) * drawn_depth;
                } else if self.internal() {
                    // A wall without a top ends at the floor.
                    let across = touch.vector.cross(along).normalize_or(on.frame.w);
                    point += across
                        * (drawn_depth
                            * if across.dot(on.frame.w) < 0.0 {
                                -1.0
                            } else {
                                1.0
                            });
                }
                Surface::Flat(Wall {
                    point,
                    normal: touch.vector,
                    along,
                    extent: (0.0, length),
                    drawn_depth,
                    has_top: !self.internal() && !level,
                    body: if self.internal() { k } else { 0 },
                })
            })
            .collect()
    }

    fn feature(&self) -> Feature {
        let mut walls = WALLS.to_vec();
        if self.internal() {
            walls.push(WallTouch {
                clearance: "cycle.clearance3",
                step: None,
                distance: None,
            });
        }
        let top = self.outside.map(|_| Top {
            depth: "cycle.depth",
            clearance: "cycle.topClearance",
            inwards: ["cycle.topDistance1", "cycle.topDistance2"],
        });
        let angle = FieldValue {
            field: ANGLE,
            value: self.angle.degrees,
        };
        Feature::Corner(Corner {
            outside: !self.internal(),
            angle,
            walls,
            top,
        })
    }

    fn top(&self, on: &TouchLayout<'_>) -> Option<f64> {
        self.outside.map(|_| on.frame.origin.dot(on.frame.w))
    }

    fn turned_error(&self, code: &str) -> Option<&'static str> {
        code.starts_with("corner.")
            .then_some(words!("each surface is touched once and assumed to have its nominal direction, which is wrong on a rotated part"))
    }
}
