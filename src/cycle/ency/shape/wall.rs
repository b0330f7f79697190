//! A wall touched twice: its direction.

use crate::cycle::ency::picked_touches::{self, Pick};
use crate::cycle::ency::shape::{
    PlacedShape, Probed, Shape, TouchLayout, begin, clearance_rule, flat, lift,
};
use crate::form::Checker;
use crate::formula::{Draft, Formula, OffsetCorrection, Role};
use crate::geom::{Frame, Plane, Vec3};
use crate::path::{Feature, Feed, FieldValue, ProbeSettings, Surface, Tracer, Wall, WallFeature};
use crate::text::{Text, words};

const DISTANCE: &str = "cycle.distance";
const CLEARANCE: &str = "cycle.clearance";

/// A flat wall, parallel to the tool axis.
#[derive(Clone, Copy, Debug)]
pub struct TwoTouches {
    /// From touch to touch along the wall, mm.
    pub distance: f64,
    /// From the wall to the ball centre where a touch begins, mm.
    pub clearance: f64,
}

impl TwoTouches {
    pub fn sizes(&mut self) -> Vec<(&'static str, &mut f64)> {
        Vec::new()
    }

    /// Positions of the touches along the wall, from its middle: the second one counter-clockwise from the target vector.
    fn places(&self) -> [f64; 2] {
        [-self.distance / 2.0, self.distance / 2.0]
    }
}

impl Probed for TwoTouches {
    fn touches(&self, frame: &Frame) -> Vec<(Vec3, Vec3, usize)> {
        self.places()
            .map(|along| (frame.point(0.0, along, 0.0), frame.u, 0))
            .to_vec()
    }

    fn name(&self, k: usize) -> Text {
        Text::words(if k == 0 {
            words!("First")
        } else {
            words!("Second")
        })
    }

    fn rules(&self, setup: &ProbeSettings, checker: &mut Checker) {
        clearance_rule(checker, setup, "Clearance", self.clearance, CLEARANCE);
    }

    fn check(&self, picks: &[Pick], _plane: Plane, checker: &mut Checker) {
        picked_touches::counted(picks, 2, checker);
    }

    /// Its touches cannot be picked.
    fn place(&self, picks: &[Pick], _plane: Plane) -> PlacedShape {
        PlacedShape {
            origin: picks[0].point,
            rotation: 0.0,
            shape: Shape::Wall(*self),
        }
    }

    fn plan_steps(&self, on: &TouchLayout<'_>, tracer: &mut Tracer) {
        let at = |along: f64| on.frame.point(self.clearance, along, 0.0);
        begin(on, tracer, at(0.0), 1);
        for (k, along) in self.places().into_iter().enumerate() {
            tracer.position(at(along), Feed::LongLink, 2);
            tracer.touch(k, &on.touches[k], Feed::LongLink, 3);
        }
        tracer.position(at(0.0), Feed::LongLink, 4);
        lift(on, tracer, at(0.0), 5);
    }

    /// The line through both ball centres is parallel to the wall.
    fn formula(&self, on: &TouchLayout<'_>) -> Formula {
        let [a, o, _] = on.setup.plane.axes();
        let (normal, along) = (
            flat(on.setup.plane, on.frame.u),
            flat(on.setup.plane, on.frame.v),
        );
        let f = Draft::with_room_for(2);
        let place = |touch: usize, direction| {
            f.project(f.trigger(touch, a), f.trigger(touch, o), direction)
        };
        let [s1, s2] = [("s1", 0), ("s2", 1)].map(|(name, touch)| f.set(name, place(touch, along)));
        let [h1, h2] =
            [("h1", 0), ("h2", 1)].map(|(name, touch)| f.set(name, place(touch, normal)));
        // If the wall is rotated counter-clockwise, the second touch goes deeper.
        let turn = f.set("turn", ((h1 - h2) / (s2 - s1)).atan2(f.number(1.0)));
        let nominal = crate::num::wrap_degrees(
            on.frame
                .u
                .dot(on.setup.plane.basis()[1])
                .atan2(on.frame.u.dot(on.setup.plane.basis()[0]))
                .to_degrees(),
        );
        let rotation = f.set("rotation", turn + f.number(crate::num::tidy(nominal)));
        f.result(
            "rotation",
            Role::Direction,
            words!("Direction of the wall's target vector"),
            nominal,
            Some(rotation),
        );
        let datum = OffsetCorrection {
            rotation: Some(turn.variable),
            ..OffsetCorrection::of([None; 3])
        };
        f.finish(Some(datum))
    }

    fn surfaces(&self, on: &TouchLayout<'_>) -> Vec<Surface> {
        let reach = self.distance / 2.0 + 3.0 * on.setup.radius.max(2.0);
        vec![Surface::Flat(Wall {
            point: on.frame.origin,
            normal: on.frame.u,
            along: on.frame.v,
            extent: (-reach, reach),
            drawn_depth: 10.0,
            has_top: false,
            body: 0,
        })]
    }

    fn feature(&self) -> Feature {
        Feature::Wall(WallFeature {
            distance: FieldValue {
                field: DISTANCE,
                value: self.distance,
            },
            clearance: CLEARANCE,
        })
    }
}
