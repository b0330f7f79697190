//! A single point on a surface.

use crate::cycle::ency::picked_touches::{self, Pick};
use crate::cycle::ency::shape::{
    PlacedShape, Probed, Shape, TouchLayout, begin, clearance_rule, constant, lift,
};
use crate::form::Checker;
use crate::formula::{Coordinate, Draft, Formula, OffsetCorrection, Role};
use crate::geom::{Frame, Plane, Vec3};
use crate::path::{self, Feature, Feed, ProbeSettings, Surface, Tracer, Wall};
use crate::text::{Text, text, words};

/// Field with the elevation of the target vector.
const ELEVATION: &str = "cycle.elevation";

/// A surface, touched once.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// From the surface to the ball centre where the touch begins, mm.
    pub clearance: f64,
    /// Elevation of the target vector above the plane, degrees: 90 is a top side, 0 a wall.
    pub elevation: f64,
}

impl Point {
    pub fn sizes(&mut self) -> Vec<(&'static str, &mut f64)> {
        vec![(ELEVATION, &mut self.elevation)]
    }
}

impl Probed for Point {
    fn touches(&self, frame: &Frame) -> Vec<(Vec3, Vec3, usize)> {
        let (sin, cos) = match self.elevation {
            90.0 => (1.0, 0.0),
            angle => angle.to_radians().sin_cos(),
        };
        vec![(frame.origin, (frame.u * cos + frame.w * sin).normalize(), 0)]
    }

    fn name(&self, _k: usize) -> Text {
        text!("Point")
    }

    fn rules(&self, setup: &ProbeSettings, checker: &mut Checker) {
        clearance_rule(
            checker,
            setup,
            "Clearance",
            self.clearance,
            "cycle.clearance",
        );
    }

    fn check(&self, picks: &[Pick], plane: Plane, checker: &mut Checker) {
        if picked_touches::counted(picks, 1, checker) {
            picked_touches::none_overhangs(picks, plane, checker);
        }
    }

    fn place(&self, picks: &[Pick], plane: Plane) -> PlacedShape {
        let vector = picks[0].vector;
        let elevation = crate::num::within(vector.dot(plane.basis()[2]), -1.0, 1.0)
            .asin()
            .to_degrees();
        let rotation = if elevation > 89.999_999 {
            0.0
        } else {
            picked_touches::heading(plane, vector)
        };
        let shape = Shape::Point(Point {
            elevation: elevation.max(0.0),
            ..*self
        });
        PlacedShape {
            origin: picks[0].point,
            rotation,
            shape,
        }
    }

    fn plan_steps(&self, on: &TouchLayout<'_>, tracer: &mut Tracer) {
        let touch = &on.touches[0];
        let start = touch.point + touch.vector * self.clearance;
        begin(on, tracer, start, 1);
        tracer.touch_in_steps(0, touch, Feed::Retract, [2, 3]);
        lift(on, tracer, start, 4);
    }

    /// The nominal point, shifted along the target vector by the measured displacement. Nothing is measured across the vector.
    fn formula(&self, on: &TouchLayout<'_>) -> Formula {
        let axes = on.setup.plane.axes();
        let touch = &on.touches[0];
        let (n, nominal) = (touch.vector, touch.contact(on.setup.radius));
        let f = Draft::with_room_for(on.touches.len());
        let reach = f.sum(
            axes.iter()
                .map(|&axis| constant(&f, n[axis]) * f.trigger(0, axis)),
        );
        let off = f.set("off", reach - f.length(n.dot(nominal)));
        let codes = [
            (
                "point.x",
                "point_x",
                words!("Point on the surface, abscissa"),
            ),
            (
                "point.y",
                "point_y",
                words!("Point on the surface, ordinate"),
            ),
            (
                "point.z",
                "point_z",
                words!("Point on the surface, along the tool axis"),
            ),
        ];
        let mut place = [None, None, None];
        for (i, (code, name, meaning)) in codes.into_iter().enumerate() {
            let (axis, at) = (axes[i], touch.point[axes[i]]);
            let measured = crate::num::tidy(n[axis]) != 0.0;
            let value = f.set(name, constant(&f, n[axis]) * off + f.length(at));
            f.result(code, Role::Reading, meaning, at, Some(value));
            place[i] = Some(Coordinate {
                measured: measured.then_some(value.variable),
                nominal: at,
            });
        }
        let nothing =
            |place: Option<Coordinate>| place.is_none_or(|place| place.measured.is_none());
        if nothing(place[2]) {
            place[2] = None;
        }
        if nothing(place[0]) && nothing(place[1]) {
            (place[0], place[1]) = (None, None);
        }
        f.result(
            "deviation",
            Role::Shift,
            words!("How far the surface is displaced along the target vector"),
            0.0,
            Some(off),
        );
        f.finish(Some(OffsetCorrection::of(place)))
    }

    fn surfaces(&self, on: &TouchLayout<'_>) -> Vec<Surface> {
        let (n, up) = (on.touches[0].vector, on.frame.w);
        let along = up.cross(n).normalize_or(on.frame.u);
        vec![Surface::Flat(Wall {
            point: on.touches[0].point,
            normal: n,
            along,
            extent: (-15.0, 15.0),
            drawn_depth: 10.0,
            has_top: false,
            body: 0,
        })]
    }

    /// A top side is its own top; the source gives no top of a wall or a slope.
    fn feature(&self) -> Feature {
        Feature::Surface(path::Point {
            clearance: "cycle.clearance",
            elevation: ELEVATION,
        })
    }

    fn top(&self, on: &TouchLayout<'_>) -> Option<f64> {
        let touch = &on.touches[0];
        (touch.vector.dot(on.frame.w) > 1.0 - 1e-6).then(|| touch.point.dot(on.frame.w))
    }
}
