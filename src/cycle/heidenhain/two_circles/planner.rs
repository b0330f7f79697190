//! Moves of the ball from touch to touch in 1411.

use std::f64::consts::TAU;

use crate::cycle::heidenhain::two_circles::{Object, PositionSource, TwoCircles};
use crate::geom::{Frame, Vec3};
use crate::path::{Arc, Feed, Move, ProbeSettings, Touch, Tracer};

/// Arcs with a smaller radius or chord, in mm, become straight moves.
const SMALLEST_ARC: f64 = 0.02;

/// A start point of the ball before a touch.
struct TouchStart {
    /// Ball centre before the touch, at measuring height.
    at: Vec3,
    /// Angle of the touch about the centre, radians.
    angle: f64,
    /// The touches from this start, each with its shift along the extrusion.
    touches: Vec<(Vec3, Touch)>,
}

/// Plans the path of both objects.
pub struct Planner<'a> {
    cycle: &'a TwoCircles,
    setup: &'a ProbeSettings,
    frame: Frame,
    tracer: Tracer,
    touches: Vec<Touch>,
    samples: usize,
}

impl<'a> Planner<'a> {
    pub fn new(cycle: &'a TwoCircles, setup: &'a ProbeSettings) -> Self {
        Planner {
            cycle,
            setup,
            frame: TwoCircles::frame(setup),
            tracer: Tracer::starting_at(setup, cycle.form.start),
            touches: Vec::new(),
            samples: 0,
        }
    }

    /// The touches and the moves.
    pub fn run(mut self) -> (Vec<Touch>, Vec<Move>) {
        let mode = self.cycle.form.clearance_height_mode;
        let objects = self.cycle.objects();
        let probed: Vec<&Object> = objects
            .iter()
            .filter(|o| o.state == PositionSource::Probed)
            .collect();
        for (i, object) in probed.iter().enumerate() {
            let stands = self.placed_at(object);
            let [to_centre, probing, back] = if object.number == 1 {
                [1, 4, 5]
            } else {
                [6, 7, 8]
            };
            let over = i == 0 || mode >= 1;
            if i == 0 && mode < 0 {
                self.go_to_first_stand(stands[0].at, to_centre);
            } else if i == 0 {
                self.go_to_first_centre(object, to_centre);
            } else if over {
                self.across(self.centre(object), to_centre);
            }
            let set_up = if object.number == 1 { 3 } else { to_centre };
            if over {
                self.across(stands[0].at, set_up);
            } else {
                // Without a retract: directly to the first touch of the second object, at the current height.
                let level = self.level(
                    self.tracer.place().expect("the first object was touched"),
                    stands[0].at,
                );
                self.tracer.position(level, Feed::Rapid, to_centre);
            }
            self.tracer.position(stands[0].at, Feed::Work, probing);
            self.probe(object, &stands, probing);
            let last = i + 1 == probed.len();
            if mode < 1 && !last {
                // To the next object at the measuring height, not at the end of the extrusion.
                self.along(stands.last().expect("a circle has touches").at, back);
            }
            if mode >= 1 || (mode == 0 && last) {
                self.up(if last && object.number == 1 { 8 } else { back });
            }
        }
        (self.touches, self.tracer.moves())
    }

    /// Probes one object: every touch from its start point, with the moves between start points.
    fn probe(&mut self, object: &Object, stands: &[TouchStart], step: u8) {
        let mode = self.cycle.form.clearance_height_mode;
        for (k, stand) in stands.iter().enumerate() {
            if k > 0 {
                if mode == 2 {
                    self.up(step);
                    self.across(stand.at, step);
                    self.tracer.position(stand.at, Feed::Work, step);
                } else {
                    self.around(object, &stands[k - 1], stand, step);
                }
            }
            for (at, touch) in &stand.touches {
                self.along(*at, step);
                self.tracer
                    .touch(self.touches.len(), touch, Feed::Rapid, step);
                self.touches.push(*touch);
            }
        }
    }

    /// Moves along the tool axis beside the object: down at the probing feed, up at rapid.
    fn along(&mut self, to: Vec3, step: u8) {
        let at = self.tracer.place().expect("the cycle has begun");
        let down = to.dot(self.frame.w) < at.dot(self.frame.w) - 1e-9;
        self.tracer
            .position(to, if down { Feed::Work } else { Feed::Rapid }, step);
    }

    /// With mode −1: at the height of the stylus (but not below the measuring height) to a point above the first start, then down at the probing feed.
    fn go_to_first_stand(&mut self, stand: Vec3, step: u8) {
        let w = self.frame.w;
        let start = self.cycle.form.start;
        let raised = start + w * (stand.dot(w) - start.dot(w)).max(0.0);
        self.tracer.position(raised, Feed::Rapid, step);
        self.tracer
            .position(self.level(raised, stand), Feed::Rapid, step);
    }

    /// To centre 1 with positioning logic: from below the clearance height first up, then in the plane; from above first in the plane, then down.
    fn go_to_first_centre(&mut self, object: &Object, step: u8) {
        let w = self.frame.w;
        let form = &self.cycle.form;
        let centre = self.centre(object);
        let height = form.clearance_height;
        let start = form.start;
        let raised = start + w * (height - start.dot(w)).max(0.0);
        self.tracer.position(raised, Feed::Rapid, step);
        let over = self.level(raised, centre);
        self.tracer.position(over, Feed::Rapid, step);
        self.tracer
            .position(over - w * (over.dot(w) - height), Feed::Rapid, step);
    }

    /// In the plane to a position, at the current height.
    fn across(&mut self, place: Vec3, step: u8) {
        let at = self.tracer.place().expect("the cycle has begun");
        self.tracer
            .position(self.level(at, place), Feed::Rapid, step);
    }

    /// Up to the clearance height.
    fn up(&mut self, step: u8) {
        let w = self.frame.w;
        let at = self.tracer.place().expect("the cycle has begun");
        self.tracer.position(
            at + w * (self.cycle.form.clearance_height - at.dot(w)),
            Feed::Rapid,
            step,
        );
    }

    /// From one start to the next at measuring height, along the arc of the stand-off radius: a chord could cut a stud.
    fn around(&mut self, object: &Object, from: &TouchStart, to: &TouchStart, step: u8) {
        let w = self.frame.w;
        let at = self.tracer.place().expect("the cycle has begun");
        // The extrusion may have left the ball away from its start.
        if at.distance(from.at) > 1e-9 {
            self.along(from.at, step);
        }
        let centre = self.centre(object);
        let center = centre + w * (from.at.dot(w) - centre.dot(w));
        let sweep = to.angle - from.angle;
        // So small an arc could be printed without length or as a full turn. A straight move differs by less than the resolution.
        let small =
            from.at.distance(center) < SMALLEST_ARC || from.at.distance(to.at) < SMALLEST_ARC;
        if small || sweep.abs() >= TAU {
            self.tracer.position(to.at, Feed::Rapid, step);
        } else {
            self.tracer
                .arc(to.at, Arc { center, sweep }, Feed::Rapid, step);
        }
    }

    /// `place` at the height of `at`.
    fn level(&self, at: Vec3, place: Vec3) -> Vec3 {
        let w = self.frame.w;
        place + w * (at.dot(w) - place.dot(w))
    }

    fn centre(&self, object: &Object) -> Vec3 {
        let [a, o, w] = object.place().expect("a probed object has a place");
        self.frame.point(a, o, w)
    }

    fn placed_at(&mut self, object: &Object) -> Vec<TouchStart> {
        let (setup, cycle, frame) = (self.setup, self.cycle, self.frame);
        let centre = self.centre(object);
        let radius = object.nominal_diameter() / 2.0;
        // In a hole that is too small for the set-up clearance the touches begin at its centre.
        let stand_off = (radius - object.outward() * cycle.stand_off(setup)).max(0.0);
        let contact = radius - object.outward() * setup.radius;
        let way = (contact - stand_off).abs();
        let shifts: Vec<Vec3> = cycle
            .repeats()
            .iter()
            .map(|[a, o, w]| frame.point(*a, *o, *w))
            .collect();
        cycle
            .angles()
            .into_iter()
            .map(|angle| {
                let out = frame.direction(angle.cos(), angle.sin());
                let sample = self.samples;
                self.samples += 1;
                let touches = shifts.iter().map(|shift| {
                    let touch = Touch {
                        point: centre + out * radius + *shift,
                        vector: out * -object.outward(),
                        group: object.number - 1,
                        search: cycle.probe.dist - way,
                        sample,
                    };
                    (centre + out * stand_off + *shift, touch)
                });
                let touches: Vec<(Vec3, Touch)> = touches.collect();
                TouchStart {
                    at: touches[0].0,
                    angle,
                    touches,
                }
            })
            .collect()
    }
}
