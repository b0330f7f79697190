//! Rules of 1411 that concern several fields.

use crate::cycle::heidenhain::two_circles::{DIAMETERS, Object, PositionSource, TwoCircles};
use crate::form::Checker;
use crate::geom::Vec2;
use crate::path::{ProbeSettings, SHORTEST_TOUCH};
use crate::text::{text, words};

const POINTS: [&str; 2] = ["cycle.point1", "cycle.point2"];
const PLACES_AND_SIZES: &[&str] = &[
    "cycle.point1",
    "cycle.point2",
    "cycle.diameter1",
    "cycle.diameter2",
];

/// A rule, and the fields without which it cannot be checked.
type Rule = (
    &'static [&'static str],
    fn(&TwoCircles, &ProbeSettings, &mut Checker),
);

/// All rules, in the order of their findings.
const RULES: [Rule; 9] = [
    (&[], TwoCircles::objects_rule),
    (&[], TwoCircles::arc_rule),
    (
        &["cycle.angularLength", "cycle.probePoints"],
        TwoCircles::spread_rule,
    ),
    (&[], TwoCircles::alignment_rule),
    (&POINTS, TwoCircles::direction_rule),
    (PLACES_AND_SIZES, TwoCircles::containing_rule),
    (&POINTS, TwoCircles::given_direction_rule),
    (&[], TwoCircles::extrusion_rule),
    (&[], TwoCircles::height_rule),
];

/// Distance of two positions, as (main, minor, …), in the plane.
fn apart(p: &[f64], q: &[f64]) -> f64 {
    (p[0] - q[0]).hypot(p[1] - q[1])
}

impl TwoCircles {
    /// Reports every broken rule.
    pub(super) fn check(&self, setup: &ProbeSettings, checker: &mut Checker) {
        for (needs, rule) in RULES {
            if checker.is_clean(needs) {
                rule(self, setup, checker);
            }
        }
    }

    /// Rules for each object alone.
    fn objects_rule(&self, setup: &ProbeSettings, checker: &mut Checker) {
        for ((object, point), diameter) in self.objects().iter().zip(POINTS).zip(DIAMETERS) {
            object_rules(object, point, diameter, checker);
            if object.state == PositionSource::Probed
                && checker.is_clean(&[
                    diameter,
                    "stylus.diameter",
                    "cycle.probe",
                    "cycle.setUpClearance",
                ])
            {
                self.room_rules(object, diameter, setup, checker);
                if checker.is_clean(&[point, diameter, "cycle.setUpClearance", "cycle.probe"]) {
                    self.zone_rules(object, [point, diameter], setup, checker);
                }
            }
        }
    }

    fn arc_rule(&self, _setup: &ProbeSettings, checker: &mut Checker) {
        if self.form.angular_length == 0.0 {
            checker.error(
                "no-arc",
                "cycle.angularLength",
                text!("An angular length of 0° puts every touch on one spot"),
            );
        }
    }

    fn alignment_rule(&self, _setup: &ProbeSettings, checker: &mut Checker) {
        if self.form.align_rotary_axis != 0 && self.form.confirm_rotation == 0 {
            let message = text!(
                "Aligning the rotary axis (Q1126) needs the rotation confirmed (Q1121): the control shows an error otherwise"
            );
            checker.error("align-needs-confirm", "cycle.alignRotaryAxis", message);
        }
    }

    fn direction_rule(&self, _setup: &ProbeSettings, checker: &mut Checker) {
        let [one, two] = self.objects().map(|object| object.place());
        if one.zip(two).is_some_and(|(p, q)| apart(&p, &q) < 1e-6) {
            let message = text!(
                "Both circles are at the same position: the line through their centres has no direction"
            );
            checker.error("no-direction", "cycle.point2", message);
        }
    }

    fn given_direction_rule(&self, _setup: &ProbeSettings, checker: &mut Checker) {
        let [one, two] = self
            .objects()
            .map(|object| Some([object.point[0].actual?, object.point[1].actual?]));
        if one.zip(two).is_some_and(|(p, q)| apart(&p, &q) < 1e-6) {
            let message = text!(
                "Both circles have the same nominal position: the line through their centres has no direction"
            );
            checker.error("no-direction", "cycle.point2", message);
        }
    }

    /// No probed circle may lie wholly inside the other.
    fn containing_rule(&self, _setup: &ProbeSettings, checker: &mut Checker) {
        let [one, two] = self.objects();
        let (Some(p), Some(q), PositionSource::Probed, PositionSource::Probed) =
            (one.place(), two.place(), one.state, two.state)
        else {
            return;
        };
        for (outer, inner, path) in [(&one, &two, DIAMETERS[0]), (&two, &one, DIAMETERS[1])] {
            if apart(&p, &q) + inner.nominal_diameter() / 2.0 <= outer.nominal_diameter() / 2.0 {
                let message = text!(
                    "Circle {number} (diameter {nominal_diameter}) contains circle {number2} wholly: is a diameter in other units?",
                    outer.number,
                    checker.length(outer.nominal_diameter()),
                    inner.number
                );
                return checker.error("circle-in-circle", path, message);
            }
        }
    }

    fn extrusion_rule(&self, _setup: &ProbeSettings, checker: &mut Checker) {
        let Some(extrusion) = self
            .extrusion
            .as_ref()
            .filter(|extrusion| extrusion.points > 1)
        else {
            return;
        };
        if extrusion.length == 0.0 {
            let message = text!("An extrusion of length 0 repeats every touch on the same spot");
            checker.warning("no-extrusion", "cycle.extrusion.length", message);
        } else if extrusion.direction != 3 {
            let message = text!(
                "Along the main or minor axis repeated touches would run off a round object: only the tool axis (3) is planned"
            );
            checker.error("extrusion-direction", "cycle.extrusion.direction", message);
        }
    }

    /// Touches must be apart, and too short an arc makes the circle uncertain.
    fn spread_rule(&self, _setup: &ProbeSettings, checker: &mut Checker) {
        const NEAREST: f64 = 1.0;
        const DOUBTFUL: f64 = 5.0;
        if self.form.angular_length == 0.0 {
            return;
        }
        let angles = self.angles();
        let apart = |a: f64, b: f64| crate::num::wrap_degrees((a - b).to_degrees()).abs();
        let pairs = angles
            .iter()
            .enumerate()
            .flat_map(|(i, a)| angles[..i].iter().map(move |b| apart(*a, *b)));
        let nearest = pairs.fold(360.0, f64::min);
        if nearest < NEAREST {
            let message = text!(
                "Two touches of a circle would be {nearest}° apart: at least {least}° is needed to compute the circle",
                crate::num::decimal(nearest, 4),
                crate::num::decimal(NEAREST, 1)
            );
            checker.error("no-arc", "cycle.angularLength", message);
            return;
        }
        let points: Vec<Vec2> = angles.iter().map(|a| Vec2::from_angle(*a)).collect();
        let Some(fit) = crate::formula::fit_circle(&points) else {
            return;
        };
        let worth = |row: usize| {
            let each = fit
                .by_point
                .iter()
                .zip(&points)
                .map(|([x, y], p)| x[row] * p.x + y[row] * p.y);
            each.map(|d| d * d).sum::<f64>().sqrt()
        };
        let worst = worth(0).max(worth(1));
        if worst > DOUBTFUL {
            let message = text!(
                "On so short an arc the centre is {worst} times as uncertain as a single touch: spread the touches further",
                crate::num::decimal(worst, 0)
            );
            checker.warning("short-arc", "cycle.angularLength", message);
        }
    }

    /// Distance from the start of a touch to the nominal wall of an object.
    fn way(&self, object: &Object, setup: &ProbeSettings) -> f64 {
        let own = self.stand_off(setup) - setup.radius;
        if object.hole {
            own.min(object.nominal_diameter() / 2.0 - setup.radius)
        } else {
            own
        }
    }

    /// An object within its tolerance must not reach into the descent of the ball, nor lie beyond the search: the path is planned for the nominal object.
    fn zone_rules(
        &self,
        object: &Object,
        [point, diameter]: [&'static str; 2],
        setup: &ProbeSettings,
        checker: &mut Checker,
    ) {
        let (number, way) = (object.number, self.way(object, setup));
        if let Some((low, _)) = object.diameter.limits.filter(|(low, _)| *low <= 0.0) {
            let message = text!(
                "The lower limit of diameter {number} ({low}) must be above 0",
                number,
                checker.length(low)
            );
            return checker.error("out-of-range", diameter, message);
        }
        // How much closer to the ball the wall is at a limit than nominal; for a position, on the side that comes closer.
        let nominal = object.nominal_diameter();
        let nearer = |limit: f64| object.outward() * (nominal - limit) / 2.0;
        let sizes = object
            .diameter
            .limits
            .map(|(low, high)| (diameter, [nearer(low), nearer(high)]));
        let places = object.point[..2].iter().filter_map(|value| {
            let ((low, high), nominal) = (value.limits?, value.nominal?);
            let [a, b] = [low - nominal, high - nominal];
            let least = if a <= 0.0 && b >= 0.0 {
                0.0
            } else {
                a.abs().min(b.abs())
            };
            Some((point, [least, a.abs().max(b.abs())]))
        });
        for (field, [a, b]) in sizes.into_iter().chain(places) {
            let farthest = if field == point { a.max(b) } else { -a.min(b) };
            if a.min(b) >= way {
                let message = text!(
                    "Even a part within tolerance is in the way: the ball descends onto object {number}",
                    number
                );
                checker.error("zone-beyond-clearance", field, message);
            } else if a.max(b) >= way {
                let message = text!(
                    "A good part can be in the way: at the limits of this tolerance object {number} reaches the point where the ball descends. A larger set-up clearance avoids it",
                    number
                );
                checker.warning("zone-beyond-clearance", field, message);
            } else if way + farthest > self.probe.dist {
                let message = text!(
                    "A good part can be missed: at the limits of this tolerance the way to object {number} is {way}, and DIST is {dist}",
                    number,
                    checker.length(way + farthest),
                    checker.length(self.probe.dist)
                );
                checker.warning("zone-beyond-dist", field, message);
            }
        }
    }

    /// Checks whether the ball fits, and whether a touch reaches the wall.
    fn room_rules(
        &self,
        object: &Object,
        diameter_path: &str,
        setup: &ProbeSettings,
        checker: &mut Checker,
    ) {
        let (number, diameter) = (object.number, object.nominal_diameter());
        if object.hole && diameter < 2.0 * (setup.radius + SHORTEST_TOUCH) - 1e-6 {
            let message = text!(
                "Hole {number} ({diameter}) must be at least {least}: {room} more than the ball ({ball}), so that a touch begins clear of the wall",
                number,
                checker.length(diameter),
                checker.length(2.0 * (setup.radius + SHORTEST_TOUCH)),
                checker.length(2.0 * SHORTEST_TOUCH),
                checker.length(2.0 * setup.radius)
            );
            checker.error("ball-too-wide", diameter_path, message);
            return;
        }
        if !object.hole && diameter <= 0.0 {
            checker.error(
                "out-of-range",
                diameter_path,
                text!("Stud {number} must have a diameter above 0", number),
            );
            return;
        }
        let reachable = diameter / 2.0 - setup.radius;
        let small = object.hole && diameter / 2.0 < self.stand_off(setup);
        if small {
            let message = text!(
                "Hole {number} is too small for the set-up clearance: the control shows a message, then continues from the centre with the reachable clearance of {reachable}",
                number,
                checker.length(reachable)
            );
            checker.warning("small-hole", diameter_path, message);
        }
        let way = self.way(object, setup);
        if way + 0.01 > self.probe.dist {
            let message = text!(
                "DIST ({dist}) must be longer than the way from the start of a touch to object {number} ({way}), or no touch reaches it",
                checker.length(self.probe.dist),
                number,
                checker.length(way)
            );
            checker.error("dist-too-short", "cycle.probe.dist", message);
        }
        if way < SHORTEST_TOUCH - 1e-6 {
            let message = text!(
                "Q320 and SET_UP together ({way}) must be at least {least}: the ball would be at the wall before the touch begins",
                checker.length(way),
                checker.length(SHORTEST_TOUCH)
            );
            checker.error("clearance-too-small", "cycle.setUpClearance", message);
        }
    }

    /// Checks the clearance height against the measuring heights, and gives the notice of the manual.
    fn height_rule(&self, setup: &ProbeSettings, checker: &mut Checker) {
        let mode = self.form.clearance_height_mode;
        let extrusion = self
            .repeats()
            .iter()
            .fold(0f64, |most, shift| most.max(shift[2]));
        for (object, path) in self.objects().iter().zip(POINTS) {
            let Some([_, _, height]) = object.place() else {
                continue;
            };
            if mode >= 0
                && object.state == PositionSource::Probed
                && checker.is_clean(&[path, "cycle.clearanceHeight"])
            {
                let highest = height + extrusion;
                if highest >= self.form.clearance_height {
                    let message = text!(
                        "The clearance height ({clearance_height}) must lie above the measuring height of object {number} ({highest})",
                        checker.length(self.form.clearance_height),
                        object.number,
                        checker.length(highest)
                    );
                    checker.error("clearance-height-too-low", "cycle.clearanceHeight", message);
                } else if self.form.clearance_height - highest
                    < (2.0 * setup.radius).max(5.0) - 1e-6
                {
                    let message = text!(
                        "The clearance height is {height} above the measuring height of object {number}: the cycle has no top side, and the ball crosses the object at that height",
                        checker.length(self.form.clearance_height - highest),
                        object.number
                    );
                    checker.warning("low-start", "cycle.clearanceHeight", message);
                }
            }
        }
        if mode < 2 {
            let what = if mode == 1 {
                words!("the touch points of an object")
            } else {
                words!("the objects and their touch points")
            };
            let message = text!(
                "Danger of collision: between {places} the probe is not retracted to the clearance height; the manual says always \
                 to do so",
                what
            );
            checker.warning("no-retract", "cycle.clearanceHeightMode", message);
        }
    }
}

/// Rules for the values of one object.
fn object_rules(object: &Object, point: &str, diameter: &str, checker: &mut Checker) {
    if !checker.is_clean(&[point, diameter]) {
        return;
    }
    let number = object.number;
    let given = object.point.iter().filter(|v| v.actual.is_some()).count();
    if given > 0 && given < 3 {
        let message = text!(
            "Point {number}: a given position (@) needs all three axes; {given} of 3 are given",
            number,
            given
        );
        checker.error("given-incomplete", point, message);
    }
    if object.diameter.unknown || object.diameter.actual.is_some() {
        let message = text!(
            "Diameter {number} takes a number or a tolerance, not ? or @",
            number
        );
        checker.error("not-a-value", diameter, message);
    }
    match object.state {
        PositionSource::SemiAutomatic => {
            let message = text!(
                "Object {number} is semi-automatic: the control stops there and the operator moves the probe to it. No path can be shown, and results that need the object are unknown. Clearance height modes 1 and 2 are not used for it",
                number
            );
            checker.info("semi-automatic", point, message);
        }
        PositionSource::Entered => {
            let message = text!(
                "The position of object {number} is given: it is not probed, and its diameter is not measured",
                number
            );
            checker.info("given-position", point, message);
        }
        PositionSource::Probed => {}
    }
}
