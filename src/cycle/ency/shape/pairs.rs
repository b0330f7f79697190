//! Opposite walls: rectangles, webs, grooves.

use crate::cycle::ency::picked_touches::{self, NEAR, Pick};
use crate::cycle::ency::shape::{
    PlacedShape, Probed, Shape, TouchLayout, begin, clearance_rule, flat, from_middle, level_rules,
    lift, protected,
};
use crate::form::Checker;
use crate::formula::{Coordinate, Draft, Formula, Name, OffsetCorrection, Role};
use crate::geom::{Frame, Plane, Vec3};
use crate::path::{
    self, Feature, Feed, FieldValue, ProbeSettings, SHORTEST_TOUCH, Surface, Touch, Tracer, Wall,
};
use crate::text::{Text, text, words};

/// One pair of walls.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// From wall to wall, mm.
    pub width: f64,
    /// From the wall to the ball centre where a touch begins, mm; `None` if touches begin in the middle.
    pub clearance: Option<f64>,
}

/// Labels and paths of the fields of a pair of walls.
struct Names {
    width: (&'static str, &'static str),
    clearance: (&'static str, &'static str),
}

/// Names of a single pair.
const ONE: [Names; 1] = [Names {
    width: ("Width", "cycle.width"),
    clearance: ("Side clearance", "cycle.sideClearance"),
}];

/// Names of the two pairs of a rectangle.
const TWO: [Names; 2] = [
    Names {
        width: ("Width 1", "cycle.width1"),
        clearance: ("Side clearance 1", "cycle.sideClearance1"),
    },
    Names {
        width: ("Width 2", "cycle.width2"),
        clearance: ("Side clearance 2", "cycle.sideClearance2"),
    },
];

/// One or two pairs of walls, the first along the first direction of the frame.
#[derive(Clone, Debug)]
pub struct Pairs {
    /// Whether the material is outside the walls.
    pub internal: bool,
    pub sides: Vec<Side>,
    /// From the top side down to the touches, mm.
    pub depth: f64,
    /// Height above the top side at which the ball crosses or enters; `None` is not checked.
    pub top: Option<f64>,
    /// Clearance of a third touch on the middle of the top: a web with three points.
    pub middle: Option<f64>,
}

const ORDINALS: [&str; 4] = [
    words!("First"),
    words!("Second"),
    words!("Third"),
    words!("Fourth"),
];
const THREE: [&str; 3] = [words!("Left"), words!("Right"), words!("Middle")];

impl Pairs {
    pub fn sizes(&mut self) -> Vec<(&'static str, &mut f64)> {
        let names = self.names();
        let mut sizes: Vec<_> = names
            .iter()
            .zip(&mut self.sides)
            .map(|(names, side)| (names.width.1, &mut side.width))
            .collect();
        if self.middle.is_some() {
            sizes.push(("cycle.depth", &mut self.depth));
        }
        sizes
    }

    fn names(&self) -> &'static [Names] {
        if self.sides.len() == 2 { &TWO } else { &ONE }
    }

    fn protected(&self) -> bool {
        self.sides[0].clearance.is_some()
    }

    /// Height above the top side at which the ball crosses. If the middle is touched, this is its clearance, which has its own rule.
    fn crossing(&self) -> Option<f64> {
        self.top
            .filter(|_| self.protected() && self.middle.is_none())
    }

    /// 1 for walls that face outwards, −1 for walls that face the middle.
    fn sign(&self) -> f64 {
        if self.internal { -1.0 } else { 1.0 }
    }

    /// Outward directions of the walls. The left touch of a web with three points is against the first direction.
    fn directions(&self) -> [(f64, f64); 4] {
        if self.middle.is_some() {
            [(-1.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.0, -1.0)]
        } else {
            [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)]
        }
    }

    fn walls(&self) -> usize {
        2 * self.sides.len()
    }
}

impl Probed for Pairs {
    fn touches(&self, frame: &Frame) -> Vec<(Vec3, Vec3, usize)> {
        let mut touches = Vec::new();
        for (k, (u, v)) in self.directions().into_iter().take(self.walls()).enumerate() {
            let outwards = frame.direction(u, v);
            let point =
                frame.origin + outwards * (self.sides[k / 2].width / 2.0) - frame.w * self.depth;
            touches.push((point, outwards * self.sign(), k));
        }
        if self.middle.is_some() {
            touches.push((frame.origin, frame.w, 2));
        }
        touches
    }

    fn name(&self, k: usize) -> Text {
        Text::words(if self.middle.is_some() {
            THREE[k]
        } else {
            ORDINALS[k]
        })
    }

    fn rules(&self, setup: &ProbeSettings, checker: &mut Checker) {
        for (side, names) in self.sides.iter().zip(self.names()) {
            let ((label, width_path), (clearance_label, clearance_path)) =
                (names.width, names.clearance);
            if let Some(clearance) = side.clearance {
                clearance_rule(checker, setup, clearance_label, clearance, clearance_path);
            }
            if !self.internal {
                continue;
            }
            if checker.is_clean(&[width_path, "stylus.diameter"])
                && side.width < 2.0 * (setup.radius + SHORTEST_TOUCH) - 1e-6
            {
                let message = text!(
                    "{label} ({width}) must be at least {least}: {room} more than the ball ({ball}), so that a touch begins clear of the wall",
                    label,
                    checker.length(side.width),
                    checker.length(2.0 * (setup.radius + SHORTEST_TOUCH)),
                    checker.length(2.0 * SHORTEST_TOUCH),
                    checker.length(2.0 * setup.radius)
                );
                checker.error("ball-too-wide", width_path, message);
            } else if let Some(clearance) = side.clearance
                && checker.is_clean(&[width_path, clearance_path, "stylus.diameter"])
                && clearance + setup.radius >= side.width
            {
                let message = text!(
                    "{clearance_label} ({clearance}) puts the ball into the opposite wall: with {label} of {width} it must be less than {limit}",
                    clearance_label,
                    checker.length(clearance),
                    label,
                    checker.length(side.width),
                    checker.length(side.width - setup.radius)
                );
                checker.error("approach-beyond-wall", clearance_path, message);
            }
        }
        level_rules(checker, setup, self.depth, self.crossing(), !self.internal);
        if let Some(middle) = self.middle {
            clearance_rule(
                checker,
                setup,
                "Middle clearance",
                middle,
                "cycle.middleClearance",
            );
        }
    }

    fn check(&self, picks: &[Pick], plane: Plane, checker: &mut Checker) {
        let walls = self.walls();
        if !picked_touches::counted(picks, walls + usize::from(self.middle.is_some()), checker) {
            return;
        }
        let sides: Vec<usize> = (0..walls).collect();
        picked_touches::levelled(picks, &sides, plane, checker);
        picked_touches::one_level(picks, &sides, plane, checker);
        if self.middle.is_some() {
            picked_touches::below_top(picks, &sides, walls, plane, checker);
        }
        for (i, pair) in picks[..walls].chunks(2).enumerate() {
            let (first, second) = (2 * i, 2 * i + 1);
            if (pair[0].vector + pair[1].vector).length() > NEAR {
                let message = text!(
                    "Touches {first} and {second} must be opposite: their target vectors are not",
                    first + 1,
                    second + 1
                );
                checker.error(
                    "vectors-not-opposite",
                    format!("cycle.touches[{second}].vector"),
                    message,
                );
                continue;
            }
            if (pair[0].point - pair[1].point).dot(pair[0].vector) * self.sign() <= 0.0 {
                picked_touches::turned_inwards(first, self.internal, checker);
                picked_touches::turned_inwards(second, self.internal, checker);
            }
        }
        if walls == 4 && picks[0].vector.dot(picks[2].vector).abs() > NEAR {
            let message = text!(
                "The two pairs of a rectangle must be square to each other: the target vectors of touches 1 and 3 are not"
            );
            checker.error("pairs-not-square", "cycle.touches[2].vector", message);
        }
        if !self.protected() && checker.is_clean(&["cycle.touches"]) {
            let origin = self.place(picks, plane).origin;
            picked_touches::in_front(picks, origin - plane.basis()[2] * self.depth, checker);
        }
        if self.middle.is_some() && (picks[2].vector - plane.basis()[2]).length() > NEAR {
            let message = text!(
                "The middle touch is on the top side: its target vector must be along the tool axis"
            );
            checker.error("vector-not-upwards", "cycle.touches[2].vector", message);
        }
    }

    fn place(&self, picks: &[Pick], plane: Plane) -> PlacedShape {
        let up = plane.basis()[2];
        let outwards = picks[0].vector * self.sign();
        let mut origin = (picks[0].point + picks[1].point) / 2.0;
        if self.sides.len() == 2 {
            let across = picks[2].vector;
            let other = (picks[2].point + picks[3].point) / 2.0;
            origin += across * (other - origin).dot(across);
        }
        // The top side: above the first touch by the depth, or at its own touch.
        let level = if self.middle.is_some() {
            picks[2].point.dot(up)
        } else {
            picks[0].point.dot(up) + self.depth
        };
        origin += up * (level - origin.dot(up));
        let widths = picks[..self.walls()]
            .chunks(2)
            .map(|p| (p[0].point - p[1].point).dot(p[0].vector).abs());
        let mut pairs = self.clone();
        for (side, width) in pairs.sides.iter_mut().zip(widths) {
            side.width = width;
        }
        if self.middle.is_some() {
            pairs.depth = (picks[2].point - picks[0].point).dot(up);
        }
        let rotation = picked_touches::heading(plane, outwards * self.directions()[0].0);
        PlacedShape {
            origin,
            rotation,
            shape: Shape::Pairs(pairs),
        }
    }

    fn plan_steps(&self, on: &TouchLayout<'_>, tracer: &mut Tracer) {
        if !self.protected() {
            return from_middle(on, tracer, self.depth, self.top);
        }
        let start = match self.middle {
            Some(clearance) => on.touches[2].point + on.touches[2].vector * clearance,
            None => on.frame.point(0.0, 0.0, self.top.unwrap_or(0.0)),
        };
        begin(on, tracer, start, 1);
        for k in 0..self.walls() {
            protected(
                on,
                tracer,
                k,
                start,
                self.sides[k / 2].clearance.unwrap_or(0.0),
            );
        }
        let mut last = 8;
        if self.middle.is_some() {
            tracer.touch(2, &on.touches[2], Feed::LongLink, 8);
            last = 9;
        }
        lift(on, tracer, start, last);
    }

    /// The control adds the ball radius along the probing direction, halves each pair, and takes the differences as widths. A single pair does not measure the
    /// position along its walls: the nominal position is used.
    fn formula(&self, on: &TouchLayout<'_>) -> Formula {
        let plane = on.setup.plane;
        let [a, o, w] = plane.axes();
        let origin = on.frame.origin;
        let f = Draft::with_room_for(on.touches.len());
        let pair = |first: usize, names: [&'static str; 2]| {
            let along = flat(plane, on.touches[first].vector * self.sign());
            let wall = |touch: usize, side: f64| {
                let place = f.project(f.trigger(touch, a), f.trigger(touch, o), along);
                let radius = f.length(-side * self.sign() * on.setup.radius);
                f.set(Name::new("wall", touch + 1), place + radius)
            };
            let (plus, minus) = (wall(first, 1.0), wall(first + 1, -1.0));
            let width = f.set(names[0], plus - minus);
            let middle = f.set(names[1], (plus + minus) / f.number(2.0));
            (along, width, middle)
        };
        if self.sides.len() == 2 {
            let (along, width1, u) = pair(0, ["width1", "middle_u"]);
            let (across, width2, v) = pair(2, ["width2", "middle_v"]);
            let x = f.set("center_x", f.project(u, v, (along.0, across.0)));
            let y = f.set("center_y", f.project(u, v, (along.1, across.1)));
            f.result(
                "center.x",
                Role::Abscissa,
                words!("Centre, abscissa"),
                origin[a],
                Some(x),
            );
            f.result(
                "center.y",
                Role::Ordinate,
                words!("Centre, ordinate"),
                origin[o],
                Some(y),
            );
            f.result(
                "width1",
                Role::Size,
                words!("Width 1"),
                self.sides[0].width,
                Some(width1),
            );
            f.result(
                "width2",
                Role::Size,
                words!("Width 2"),
                self.sides[1].width,
                Some(width2),
            );
            f.result(
                "rotation",
                Role::Direction,
                words!("Rotation: one touch a wall gives no angle"),
                0.0,
                None,
            );
            let datum = OffsetCorrection::point((x, origin[a]), (y, origin[o]));
            return f.finish(Some(datum));
        }
        let (along, width, u) = pair(0, ["width", "middle"]);
        // Along the walls the middle keeps its nominal position.
        let across = (-along.1, along.0);
        let rest = origin[a] * across.0 + origin[o] * across.1;
        let place = |name: &'static str,
                     code: &'static str,
                     meaning: &'static str,
                     nominal: f64,
                     c: f64,
                     s: f64| {
            if crate::num::tidy(c) == 0.0 {
                return Coordinate {
                    measured: None,
                    nominal,
                };
            }
            let along = f.project(u, f.number(0.0), (c, 0.0));
            let value = f.set(name, along + f.length(s * rest));
            f.result(code, Role::Reading, meaning, nominal, Some(value));
            Coordinate::measured(value, nominal)
        };
        let x = place(
            "center_x",
            "center.x",
            words!("Middle, abscissa"),
            origin[a],
            along.0,
            across.0,
        );
        let y = place(
            "center_y",
            "center.y",
            words!("Middle, ordinate"),
            origin[o],
            along.1,
            across.1,
        );
        f.result(
            "width",
            Role::Size,
            words!("Width"),
            self.sides[0].width,
            Some(width),
        );
        let mut datum = OffsetCorrection::of([Some(x), Some(y), None]);
        if self.middle.is_some() {
            let top = f.set("top", f.trigger(2, w) - f.length(on.setup.radius));
            f.result(
                "height",
                Role::Level,
                words!("Height of the top side"),
                on.touches[2].point[w],
                Some(top),
            );
            datum.place[2] = Some(Coordinate::measured(top, on.touches[2].point[w]));
        }
        f.finish(Some(datum))
    }

    fn surfaces(&self, on: &TouchLayout<'_>) -> Vec<Surface> {
        let widths: Vec<f64> = self.sides.iter().map(|s| s.width).collect();
        // A single pair is drawn long enough to be visible.
        let half = crate::num::within(widths[0] / 2.0, 10.0, 40.0);
        // A wall of a rectangle extends between the walls of the other pair, at any touch point.
        let reach = |touch: &Touch, along: Vec3, k: usize| {
            let meets = |other: &Touch| {
                (other.point - touch.point).dot(other.vector) / along.dot(other.vector)
            };
            let [a, b] = if k < 2 { [2, 3] } else { [0, 1] }.map(|k| meets(&on.touches[k]));
            if (a - b).is_finite() {
                (a.min(b), a.max(b))
            } else {
                (-half, half)
            }
        };
        let top = on.frame.origin.dot(on.frame.w);
        on.touches
            .iter()
            .enumerate()
            .map(|(k, touch)| {
                let is_top = k == 2 && self.middle.is_some();
                let along = if is_top {
                    on.frame.u
                } else {
                    on.frame.w.cross(touch.vector)
                };
                let extent = match (is_top, widths.len()) {
                    (true, _) => (-widths[0] / 2.0, widths[0] / 2.0),
                    (false, 2) => reach(touch, along, k),
                    (false, _) => (-half, half),
                };
                Surface::Flat(Wall {
                    point: touch.point + on.frame.w * (top - touch.point.dot(on.frame.w)),
                    normal: touch.vector,
                    along,
                    extent,
                    drawn_depth: if is_top {
                        half
                    } else {
                        self.depth + on.setup.radius
                    },
                    has_top: !is_top,
                    body: if self.internal { k } else { 0 },
                })
            })
            .collect()
    }

    fn feature(&self) -> Feature {
        let entry = |field, value| FieldValue { field, value };
        let side = |(side, names): (&Side, &Names)| path::Side {
            width: entry(names.width.1, side.width),
            clearance: side
                .clearance
                .map(|clearance| entry(names.clearance.1, clearance)),
        };
        Feature::Pairs(path::Pairs {
            internal: self.internal,
            sides: self.sides.iter().zip(self.names()).map(side).collect(),
            depth: entry("cycle.depth", self.depth),
            crossing: self.crossing().map(|top| entry("cycle.topClearance", top)),
        })
    }

    fn top(&self, on: &TouchLayout<'_>) -> Option<f64> {
        Some(on.frame.origin.dot(on.frame.w))
    }

    fn turned_error(&self, code: &str) -> Option<&'static str> {
        match code {
            "width1" | "width2" | "width" if self.internal => Some(words!(
                "cosine error: the walls are turned against the probing direction, so the width reads (W - d)(1/cos - 1) too \
                 wide, d being the ball diameter"
            )),
            "width1" | "width2" | "width" => Some(words!(
                "cosine error: the walls are turned against the probing direction, so the width reads (W + d)(1/cos - 1) too \
                 wide, d being the ball diameter"
            )),
            "center.x" | "center.y" => Some(words!(
                "the walls are turned against the probing lines, which miss the shifted centre: the middle is found where a \
                 line crosses the turned middle"
            )),
            _ => None,
        }
    }
}
