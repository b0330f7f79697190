//! Holes and bosses.

use crate::cycle::ency::picked_touches::{self, NEAR, Pick};
use crate::cycle::ency::shape::{
    PlacedShape, Probed, Shape, TouchLayout, begin, clearance_rule, from_middle, level_rules, lift,
    protected,
};
use crate::form::Checker;
use crate::formula::{CirclePart, Draft, Formula, OffsetCorrection, Role, fit_circle};
use crate::geom::{Frame, Plane, Vec2, Vec3};
use crate::path::{
    Bore, Feature, FieldValue, ProbeSettings, Round, SHORTEST_TOUCH, Surface, Tracer,
};
use crate::text::{Text, text, words};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Variant {
    /// Four touches: two opposite pairs, the second a quarter turn counter-clockwise from the first.
    Rectangular,
    /// A number of touches from a start angle on, with a step (degrees, counter-clockwise).
    Angular {
        /// Angle of the first touch from the abscissa.
        start: f64,
        /// Angle from each touch to the next.
        step: f64,
        count: usize,
    },
}

impl Variant {
    /// By the number of the variant in the form.
    pub fn of(number: i32, start: f64, step: f64, count: i32) -> Self {
        match number {
            0 => Variant::Rectangular,
            _ => Variant::Angular {
                start,
                step,
                count: count.max(1) as usize,
            },
        }
    }
}

/// A circle about the tool axis.
#[derive(Clone, Copy, Debug)]
pub struct Circle {
    /// Whether it is a hole.
    pub internal: bool,
    /// In mm.
    pub diameter: f64,
    pub variant: Variant,
    /// From the top side down to the touches, mm.
    pub depth: f64,
    /// Height above the top side at which the ball crosses or enters; `None` is not checked.
    pub top: Option<f64>,
    /// From the surface to the ball centre where a touch begins; `None` if touches begin in the middle.
    pub clearance: Option<f64>,
}

impl Circle {
    pub fn sizes(&mut self) -> Vec<(&'static str, &mut f64)> {
        let mut sizes = vec![("cycle.diameter", &mut self.diameter)];
        if let Variant::Angular {
            step, count: 2.., ..
        } = &mut self.variant
        {
            sizes.push(("cycle.angularStep", step));
        }
        sizes
    }

    fn angles(&self) -> Vec<f64> {
        match self.variant {
            Variant::Rectangular => vec![0.0, 180.0, 90.0, 270.0],
            Variant::Angular { start, step, count } => {
                (0..count).map(|k| start + k as f64 * step).collect()
            }
        }
    }

    fn sign(&self) -> f64 {
        if self.internal { -1.0 } else { 1.0 }
    }
}

/// Whether these outward directions belong to at least three separate touches: fewer give no circle.
fn gives_circle(directions: impl Iterator<Item = Vec3>) -> bool {
    let mut apart: Vec<Vec3> = Vec::new();
    for direction in directions {
        // Half a degree.
        if apart.iter().all(|d| d.distance(direction) > 0.0087) {
            apart.push(direction);
        }
    }
    apart.len() >= 3
}

impl Probed for Circle {
    fn touches(&self, frame: &Frame) -> Vec<(Vec3, Vec3, usize)> {
        let touch = |degrees: f64| {
            // Quarter turns are exact.
            let (sin, cos) = match degrees.rem_euclid(360.0) {
                0.0 => (0.0, 1.0),
                90.0 => (1.0, 0.0),
                180.0 => (0.0, -1.0),
                270.0 => (-1.0, 0.0),
                angle => angle.to_radians().sin_cos(),
            };
            let outwards = frame.direction(cos, sin);
            (
                frame.origin + outwards * (self.diameter / 2.0) - frame.w * self.depth,
                outwards * self.sign(),
                0,
            )
        };
        self.angles().into_iter().map(touch).collect()
    }

    fn name(&self, k: usize) -> Text {
        text!("Point {number}", k + 1)
    }

    fn rules(&self, setup: &ProbeSettings, checker: &mut Checker) {
        if let Some(clearance) = self.clearance {
            clearance_rule(
                checker,
                setup,
                "Side clearance",
                clearance,
                "cycle.sideClearance",
            );
        }
        if self.internal && checker.is_clean(&["cycle.diameter", "stylus.diameter"]) {
            let ball = 2.0 * setup.radius;
            if self.diameter < ball + 2.0 * SHORTEST_TOUCH - 1e-6 {
                let message = text!(
                    "Diameter ({diameter}) must be at least {least}: {room} more than the ball ({ball}), so that a touch begins clear of the wall",
                    checker.length(self.diameter),
                    checker.length(ball + 2.0 * SHORTEST_TOUCH),
                    checker.length(2.0 * SHORTEST_TOUCH),
                    checker.length(ball)
                );
                checker.error("ball-too-wide", "cycle.diameter", message);
            } else if let Some(clearance) = self.clearance
                && checker.is_clean(&["cycle.sideClearance"])
                && clearance + setup.radius >= self.diameter
            {
                let message = text!(
                    "Side clearance ({clearance}) puts the ball into the opposite wall: with a diameter of {diameter} it must be less than {limit}",
                    checker.length(clearance),
                    checker.length(self.diameter),
                    checker.length(self.diameter - setup.radius)
                );
                checker.error("approach-beyond-wall", "cycle.sideClearance", message);
            }
        }
        level_rules(
            checker,
            setup,
            self.depth,
            self.top.filter(|_| self.clearance.is_some()),
            !self.internal,
        );
        let apart =
            |degrees: f64| Vec3::new(degrees.to_radians().cos(), degrees.to_radians().sin(), 0.0);
        if checker.is_clean(&["cycle.stepCount", "cycle.angularStep"])
            && !gives_circle(self.angles().into_iter().map(apart))
        {
            let message = text!(
                "Fewer than three distinct touches define no circle: centre and diameter are unknown"
            );
            checker.warning("no-circle", "cycle.stepCount", message);
        }
    }

    fn check(&self, picks: &[Pick], plane: Plane, checker: &mut Checker) {
        if !picked_touches::counted(picks, self.angles().len(), checker) {
            return;
        }
        let all: Vec<usize> = (0..picks.len()).collect();
        picked_touches::levelled(picks, &all, plane, checker);
        picked_touches::one_level(picks, &all, plane, checker);
        if !checker.is_clean(&["cycle.touches"]) {
            return;
        }
        if self.variant == Variant::Rectangular {
            let up = plane.basis()[2];
            let (first, third) = (picks[0].vector, up.cross(picks[0].vector));
            let wanted = [first, -first, third, -third];
            if let Some(k) = (0..4).find(|&k| (picks[k].vector - wanted[k]).length() > 2.0 * NEAR) {
                let message = text!(
                    "In the rectangular variant touch 2 is opposite touch 1, touch 3 is 90° counter-clockwise from touch 1, and touch 4 opposite touch 3: touch {touch} is not. The angular variant supports any touches",
                    k + 1
                );
                checker.error(
                    "not-rectangular",
                    format!("cycle.touches[{k}].vector"),
                    message,
                );
                return;
            }
        }
        // Signs are checked first: with three or more touches the centre follows from the points alone.
        let center = self.center(picks, plane);
        for (k, pick) in picks.iter().enumerate() {
            let mut out = pick.point - center;
            out -= plane.basis()[2] * out.dot(plane.basis()[2]);
            if out.dot(pick.vector) * self.sign() <= 0.0 {
                picked_touches::turned_inwards(k, self.internal, checker);
                continue;
            }
            let radius = self.radius(picks, center, plane);
            let aside = (out.normalize_or_zero() * self.sign() - pick.vector).length();
            if (out.length() - radius).abs() > NEAR || aside > NEAR * 10.0 {
                let message = text!(
                    "Touch {touch} is not on the circle of the others, or not square to it",
                    k + 1
                );
                checker.error("not-on-one-circle", format!("cycle.touches[{k}]"), message);
            }
        }
        if self.clearance.is_none() && checker.is_clean(&["cycle.touches"]) {
            let up = plane.basis()[2];
            picked_touches::in_front(
                picks,
                center + up * (picks[0].point - center).dot(up),
                checker,
            );
        }
    }

    fn place(&self, picks: &[Pick], plane: Plane) -> PlacedShape {
        let up = plane.basis()[2];
        let center = self.center(picks, plane);
        let origin = center + up * (picks[0].point.dot(up) + self.depth - center.dot(up));
        let start = if let Variant::Angular { start, .. } = self.variant {
            start
        } else {
            0.0
        };
        let rotation = crate::num::wrap_degrees(
            picked_touches::heading(plane, picks[0].vector * self.sign()) - start,
        );
        let mut circle = Circle {
            diameter: 2.0 * self.radius(picks, center, plane),
            ..*self
        };
        if let (Variant::Angular { step, .. }, [first, second, ..]) = (&mut circle.variant, picks) {
            // Of the equivalent angles of the direction, the one closest to the form's value.
            let turn = picked_touches::heading(plane, second.vector)
                - picked_touches::heading(plane, first.vector);
            *step += crate::num::wrap_degrees(turn - *step);
        }
        PlacedShape {
            origin,
            rotation,
            shape: Shape::Circle(circle),
        }
    }

    fn plan_steps(&self, on: &TouchLayout<'_>, tracer: &mut Tracer) {
        let Some(clearance) = self.clearance else {
            return from_middle(on, tracer, self.depth, self.top);
        };
        let start = on.frame.point(0.0, 0.0, self.top.unwrap_or(0.0));
        begin(on, tracer, start, 1);
        for k in 0..on.touches.len() {
            protected(on, tracer, k, start, clearance);
        }
        lift(on, tracer, start, 8);
    }

    /// Least-squares circle through the ball centres, larger by the ball radius in a hole, smaller at a boss.
    fn formula(&self, on: &TouchLayout<'_>) -> Formula {
        let [a, o, _] = on.setup.plane.axes();
        let origin = on.frame.origin;
        let f = Draft::with_room_for(on.touches.len());
        let known = gives_circle(on.touches.iter().map(|t| t.vector));
        let part = |part| f.circle((0, on.touches.len()), (a, o), part);
        let value = |name: &'static str, expr| known.then(|| f.set(name, expr));
        let x = value("center_x", part(CirclePart::Abscissa));
        let y = value("center_y", part(CirclePart::Ordinate));
        let wall = part(CirclePart::Radius) + f.length(-self.sign() * on.setup.radius);
        let diameter = value("diameter", f.number(2.0) * wall);
        f.result(
            "center.x",
            Role::Abscissa,
            words!("Centre, abscissa"),
            origin[a],
            x,
        );
        f.result(
            "center.y",
            Role::Ordinate,
            words!("Centre, ordinate"),
            origin[o],
            y,
        );
        f.result(
            "diameter",
            Role::Size,
            words!("Diameter"),
            self.diameter,
            diameter,
        );
        if known && on.touches.len() > 3 {
            let residual = f.set("residual", part(CirclePart::Residual));
            f.result(
                "residual",
                Role::Residual,
                words!("Residual of the circle, root mean square"),
                0.0,
                Some(residual),
            );
        }
        let datum = x
            .zip(y)
            .map(|(x, y)| OffsetCorrection::point((x, origin[a]), (y, origin[o])));
        f.finish(datum)
    }

    fn surfaces(&self, on: &TouchLayout<'_>) -> Vec<Surface> {
        let drawn_depth = self.depth + on.setup.radius;
        vec![Surface::Round(Round {
            center: on.frame.origin,
            radius: self.diameter / 2.0,
            hole: self.internal,
            drawn_depth,
            plate: self.internal.then_some(f64::INFINITY),
        })]
    }

    fn feature(&self) -> Feature {
        let entry = |field, value| FieldValue { field, value };
        Feature::Bore(Bore {
            diameter: entry("cycle.diameter", self.diameter),
            depth: entry("cycle.depth", self.depth),
            clearance: self
                .clearance
                .map(|clearance| entry("cycle.sideClearance", clearance)),
            crossing: self
                .top
                .filter(|_| self.clearance.is_some())
                .map(|top| entry("cycle.topClearance", top)),
        })
    }

    fn top(&self, on: &TouchLayout<'_>) -> Option<f64> {
        Some(on.frame.origin.dot(on.frame.w))
    }
}

impl Circle {
    /// Centre at the level of the first touch: the middle of opposite touches, the fitted centre of three or more, else by the diameter along the first vector.
    fn center(&self, picks: &[Pick], plane: Plane) -> Vec3 {
        let [a, o, _] = plane.axes();
        let mut center = picks[0].point - picks[0].vector * (self.sign() * self.diameter / 2.0);
        let places: Vec<Vec2> = picks
            .iter()
            .map(|p| Vec2::new(p.point[a], p.point[o]))
            .collect();
        if self.variant == Variant::Rectangular {
            center = (picks[0].point + picks[1].point) / 2.0;
        } else if let Some(fit) =
            fit_circle(&places).filter(|_| gives_circle(picks.iter().map(|p| p.vector)))
        {
            (center[a], center[o]) = (fit.center.x, fit.center.y);
        }
        center
    }

    fn radius(&self, picks: &[Pick], center: Vec3, plane: Plane) -> f64 {
        let up = plane.basis()[2];
        let out = picks[0].point - center;
        (out - up * out.dot(up)).length()
    }
}
