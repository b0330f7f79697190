//! Probing two circles: HEIDENHAIN cycle 1411, optionally with extrusion probing (1493) before it.
//!
//! Parameters, meanings and results follow the control's manual. Our own choices, which the manual leaves open, are in one place each: [`TwoCircles::angles`]
//! (positions of the touches), [`planner`] (moves between touches) and [`verdicts`] (good, rework or scrap).

mod form;
mod formula;
mod planner;
mod q_parameters;
mod rules;
mod verdicts;

use crate::cycle::heidenhain::two_circles::form::{EXTRUSION, Extrusion, Form, PROBE, Probe};
use crate::cycle::heidenhain::two_circles::q_parameters::rows;
use crate::cycle::{Cycle, CycleDef, REPEAT};
use crate::form::Checker;
use crate::formula::{Formula, ResultRow};
use crate::geom::{Frame, Vec3};
use crate::path::{
    self, DatumSource, Feature, FeatureKind, Feeds, Parameter, ParameterValue, Path, ProbeSettings,
    Round, SHORTEST_TOUCH, Setting, Spread, Surface, Touch,
};
use crate::text::words;
use crate::tolerance::Nominal;

pub static DEF: CycleDef = CycleDef {
    key: "probing-two-circles",
    title: "Probing two circles",
    summary: "Two bores or studs: the line through their centres gives the rotation of the part.",
    search_words: "two holes bores studs rings bolt circle alignment angle skew rotation",
    name: "CIRCLES",
    source: "HEIDENHAIN cycle 1411",
    probes: FeatureKind::TwoCircles,
    own_feeds: true,
    number: None,
    most_touches: 2 * 8 * 99,
    place: None,
    fields: Form::FIELDS,
    sections: &[PROBE, EXTRUSION, REPEAT],
    default_control: ("heidenhain", "cycle"),
    steps: &[
        "At rapid, with positioning logic, to centre 1",
        "Positioning logic: from below the clearance height first up to it, then in the plane; from above in the plane, then down",
        "At rapid to the set-up clearance before the first touch: Q320, SET_UP and the ball radius together",
        "At the probing feed down to the measuring height, and touch the first hole or stud",
        "If the clearance height mode requires it, back to the clearance height",
        "To centre 2",
        "At the probing feed down to the measuring height, and touch the second hole or stud",
        "If the clearance height mode requires it, back to the clearance height; the results are stored",
    ],
    interpretations: &[
        "The English dialog texts, the forms of tolerances, the meaning of Q1120 = 3, the parameters of 1493, that PREDEF stands for a value \
         of GLOBAL DEF, and that Q1125 of 1 or 2 does not count for a semi-automatic object are recalled from the control's manuals and \
         not seen in print; they are not verified on a control.",
        "Heights are of the ball centre. Touch points lie at Q325 + k·Q1119/Q423 for a full circle, else at Q325 + \
         k·Q1119/(Q423 - 1); a negative Q1119 runs clockwise.",
        "Between the points of one object the ball goes over the clearance height with Q1125 = 2, else along the arc of the \
         stand-off radius at measuring height. Between the objects it goes over the clearance height with Q1125 of 1 or 2, else \
         straight at measuring height to the second object's first touch. The source's steps name its centre as a stop there: it is left out.",
        "The source adds Q320 to SET_UP and the ball radius in every direction, and says of Q320 itself that it acts only where the tool axis \
         is probed, which this cycle never does. It is taken to act.",
        "Nothing is measured along the tool axis: Q952, Q955, Q982 and Q985 are the nominal heights, with the deviation 0.",
        "Q964 is the measured angle less the nominal one, counter-clockwise positive. With Q1121 = 2 the table's offset is that with its sign turned.",
        "The source prints +9999.9999 as the upper limit of Q1101 to Q1105: it is taken to be +99999.9999, as the lower one is -99999.9999.",
        "Step 7 of the source calls Q1105 a clearance height: it is read as the measuring height of the second object, as Q1102 is that of \
         the first.",
        "The range of Q1119 has 360 and not -360: there is no full circle clockwise, and -359.999 is spread as an arc.",
        "With Q1125 = -1 the ball never goes to the clearance height: it crosses at the height where the stylus stands straight to \
         before the first touch, goes down at the probing feed, and the cycle ends where its last touch began.",
        "DIST is the longest way of a touch, counted from where it begins.",
        "A hole too small for the set-up clearance is touched from its centre; the reachable clearance is D/2 less the ball radius.",
        "How high the material reaches is not known. For the check against collisions it is taken to reach half-way from the highest touch \
         to a ball radius below the clearance height, or below the stylus before the cycle where that is lower. Around a hole there is \
         material as far as the other object.",
        "The stylus is taken to be at `start` before the cycle: no block moves it there.",
        "With 1493 the ball goes deeper along the extrusion at the probing feed, and up at rapid.",
        "An extrusion along the main or minor axis is refused: repeated touches would run off a round object.",
        "Three points give the exact circle, more the one of geometric least squares.",
        "Deviations are measured from the middle of the tolerance zone. Q183: in the zone, limits included, is good; a hole too \
         small or a stud too big is rework; a hole too big, a stud too small or a position out of its zone is scrap; the worst \
         counts.",
        "Q980 to Q985 are deviations from that middle. What Q1120 transfers is the measured place less the nominal one, as the source has \
         it, and not less the middle of the zone.",
        "No basic rotation is taken to be active, so Q994 = Q964; the table has to turn the other way, so Q965 = -Q964.",
        "With 1493 each touch is repeated along the extrusion and the mean goes into the fit; Q970, Q971, Q973, Q974 are the \
         largest deviations of the circles fitted at the single places.",
    ],
    read: |_, section| {
        let form = Form::read(section);
        let probe = section
            .sub(&PROBE, Probe::read)
            .expect("the probe is never left out");
        let extrusion = section.sub(&EXTRUSION, Extrusion::read);
        Box::new(
            TwoCircles {
                form,
                probe,
                extrusion,
            }
            .with_stand_ins(),
        )
    },
};

/// Fields with the two diameters.
const DIAMETERS: [&str; 2] = ["cycle.diameter1", "cycle.diameter2"];

/// The checked cycle.
#[derive(Clone, Debug)]
pub struct TwoCircles {
    form: Form,
    probe: Probe,
    extrusion: Option<Extrusion>,
}

/// Source of an object's position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PositionSource {
    Probed,
    /// Unknown: the operator moves the probe to the object.
    SemiAutomatic,
    /// Given: the object is not probed.
    Entered,
}

/// One hole or stud.
#[derive(Clone, Debug)]
struct Object {
    /// 1 or 2.
    number: usize,
    /// Main axis, minor axis, tool axis.
    point: [Nominal; 3],
    diameter: Nominal,
    hole: bool,
    state: PositionSource,
}

impl Object {
    /// Nominal position, if it is known, as (main, minor, tool axis).
    fn place(&self) -> Option<[f64; 3]> {
        let [a, o, w] = &self.point;
        Some([a.nominal?, o.nominal?, w.nominal?])
    }

    /// Value from which the deviation of a coordinate is counted. The tool axis of a probed object is not measured: its value is nominal, and its deviation is
    /// 0.
    fn reference(&self, axis: usize) -> Option<f64> {
        if self.measures(axis) {
            self.point[axis].reference()
        } else {
            self.point[axis].nominal
        }
    }

    /// Whether a coordinate is measured or given.
    fn measures(&self, axis: usize) -> bool {
        axis < 2 || self.state == PositionSource::Entered
    }

    fn nominal_diameter(&self) -> f64 {
        self.diameter.nominal.unwrap_or(0.0)
    }

    /// +1 for a hole (touches outwards), −1 for a stud: direction of the touch, and sign of the ball radius in the diameter.
    fn outward(&self) -> f64 {
        if self.hole { 1.0 } else { -1.0 }
    }
}

impl TwoCircles {
    fn objects(&self) -> [Object; 2] {
        let form = &self.form;
        let holes = [
            matches!(form.geometry_type, 0 | 2),
            matches!(form.geometry_type, 0 | 3),
        ];
        let object = |number: usize, point: &[Nominal; 3], diameter: &Nominal| {
            let state = if point.iter().any(|v| v.unknown) {
                PositionSource::SemiAutomatic
            } else if point.iter().any(|v| v.actual.is_some()) {
                PositionSource::Entered
            } else {
                PositionSource::Probed
            };
            Object {
                number,
                point: point.clone(),
                diameter: diameter.clone(),
                hole: holes[number - 1],
                state,
            }
        };
        [
            object(1, &form.point1, &form.diameter1),
            object(2, &form.point2, &form.diameter2),
        ]
    }

    /// Replaces values that the control takes from GLOBAL DEF by the numbers of the form, at a position that can be shown.
    fn with_stand_ins(mut self) -> Self {
        const ROOM: f64 = 10.0;
        if self.form.set_up_clearance_predef {
            let most = self.probe.dist - SHORTEST_TOUCH - self.probe.set_up;
            let least = SHORTEST_TOUCH - self.probe.set_up;
            self.form.set_up_clearance = self.form.set_up_clearance.min(most).max(least).max(0.0);
        }
        if self.form.clearance_height_predef {
            let extrusion = self
                .repeats()
                .iter()
                .fold(0f64, |most, shift| most.max(shift[2]));
            let touches = self
                .objects()
                .iter()
                .filter_map(Object::place)
                .map(|[_, _, w]| w + extrusion)
                .fold(f64::MIN, f64::max);
            if self.form.clearance_height <= touches {
                self.form.clearance_height = touches + ROOM;
            }
        }
        self
    }

    /// Stand-off in the probing direction, mm, from surface to ball centre.
    fn stand_off(&self, setup: &ProbeSettings) -> f64 {
        self.form.set_up_clearance + self.probe.set_up + setup.radius
    }

    fn frame(setup: &ProbeSettings) -> Frame {
        Frame::new(setup.plane, Vec3::ZERO, 0.0)
    }

    /// Height of the ball centre without contact: the clearance height. Mode −1 never uses it; then the height from which the stylus comes.
    fn free_height(&self, setup: &ProbeSettings) -> f64 {
        if self.form.clearance_height_mode >= 0 {
            return self.form.clearance_height;
        }
        let [_, _, w] = setup.plane.axes();
        self.objects()
            .iter()
            .filter_map(|o| o.place())
            .fold(self.form.start[w], |most, place| most.max(place[2]))
    }

    /// Angles of the touches of one circle, radians.
    fn angles(&self) -> Vec<f64> {
        let form = &self.form;
        let count = form.probe_points;
        let full = form.angular_length.abs() >= 360.0;
        let step = form.angular_length / f64::from(if full { count } else { count - 1 });
        (0..count)
            .map(|k| (form.starting_angle + step * f64::from(k)).to_radians())
            .collect()
    }

    /// Repetitions of a touch, as shifts along the extrusion in (main, minor, tool axis).
    fn repeats(&self) -> Vec<[f64; 3]> {
        let Some(extrusion) = &self.extrusion else {
            return vec![[0.0; 3]];
        };
        let n = extrusion.points;
        (0..n)
            .map(|j| {
                let mut shift = [0.0; 3];
                if n > 1 {
                    shift[(extrusion.direction - 1) as usize] =
                        extrusion.length * f64::from(j) / f64::from(n - 1);
                }
                shift
            })
            .collect()
    }

    /// Line from nominal centre to nominal centre.
    fn line(&self, setup: &ProbeSettings) -> Option<[Vec3; 2]> {
        let frame = Self::frame(setup);
        let [one, two] = self.objects();
        let ([a1, o1, w1], [a2, o2, w2]) = (one.place()?, two.place()?);
        Some([frame.point(a1, o1, w1), frame.point(a2, o2, w2)])
    }

    /// Angles of the touches, as the first probed circle shows them.
    fn spread(&self, setup: &ProbeSettings) -> Option<Spread> {
        let objects = self.objects();
        let object = objects.iter().find(|o| o.state == PositionSource::Probed)?;
        let [a, o, w] = object.place()?;
        Some(Spread {
            center: Self::frame(setup).point(a, o, w),
            radius: object.nominal_diameter() / 2.0,
            start: self.form.starting_angle.to_radians(),
            sweep: self.form.angular_length.to_radians(),
            fields: ["cycle.startingAngle", "cycle.angularLength"],
        })
    }

    /// The feature for a control that has the cycle itself.
    fn feature(&self, setup: &ProbeSettings) -> path::TwoCircles {
        let [extrusion, settings] = self.settings().map(|list| {
            list.into_iter()
                .map(|(setting, _)| setting)
                .collect::<Vec<Setting>>()
        });
        path::TwoCircles {
            diameters: DIAMETERS,
            line: self.line(setup),
            spread: self.spread(setup),
            semi_automatic: self
                .objects()
                .iter()
                .any(|o| o.state == PositionSource::SemiAutomatic),
            reacts: self.form.error_reaction != 0,
            toleranced: settings
                .iter()
                .any(|s| matches!(s.value, ParameterValue::Text(_))),
            turns_table: self.form.confirm_rotation == 2 || self.form.align_rotary_axis != 0,
            settings,
            extrusion,
        }
    }
}

impl Cycle for TwoCircles {
    fn rules(&self, setup: &ProbeSettings, checker: &mut Checker) {
        self.check(setup, checker);
    }

    fn predefined_fields(&self) -> Vec<(&'static str, &'static str)> {
        let set_up = self.form.set_up_clearance_predef.then_some((
            "cycle.setUpClearancePredef",
            words!("set-up clearance (Q320)"),
        ));
        let height = self.form.clearance_height_predef.then_some((
            "cycle.clearanceHeightPredef",
            words!("clearance height (Q260)"),
        ));
        set_up.into_iter().chain(height).collect()
    }

    fn plan(&self, setup: &ProbeSettings) -> Path {
        let (touches, moves) = planner::Planner::new(self, setup).run();
        Path {
            touches,
            start: (!moves.is_empty()).then_some(self.form.start),
            top: None,
            moves,
            surfaces: self.surfaces(setup),
            feeds: Some(Feeds {
                approach: None,
                long_link: None,
                work: self.probe.feed,
                retract: None,
                return_: None,
                search: None,
                rapid: self.probe.rapid,
            }),
            feature: Feature::TwoCircles(Box::new(self.feature(setup))),
            picked: false,
            calls: None,
            cycles: Vec::new(),
            relations: Vec::new(),
            datum_source: DatumSource::default(),
            shifts: Vec::new(),
            lift_field: None,
            frame: Self::frame(setup),
            formula: self.computed(setup),
        }
    }

    fn formula(&self, setup: &ProbeSettings) -> Formula {
        self.computed(setup)
    }

    fn parameters(&self, _setup: &ProbeSettings, _touches: &[Touch]) -> Vec<Parameter> {
        rows(self.settings())
    }

    fn surfaces(&self, setup: &ProbeSettings) -> Vec<Surface> {
        let frame = Self::frame(setup);
        // The position of the stylus before the cycle is free, too.
        let free = self
            .free_height(setup)
            .min(self.form.start[setup.plane.axes()[2]])
            - setup.radius;
        let highest = self
            .repeats()
            .iter()
            .fold(0f64, |most, shift| most.max(shift[2]));
        let objects = self.objects();
        let place = |object: &Object| {
            object
                .place()
                .filter(|_| object.state != PositionSource::SemiAutomatic)
        };
        let known = |object: &Object, other: &Object| {
            let Some([a, o, w]) = place(object) else {
                return Surface::Unknown;
            };
            let radius = object.nominal_diameter() / 2.0;
            // The top is unknown: assumed half-way between the highest touch and the height without contact.
            let touched = w + highest;
            let top = touched + ((free - touched) / 2.0).max(0.0);
            // There is material around a hole, but not at the other object, nor on the way of the ball around it, on a part displaced by up to the search
            // distance.
            let clear = if other.hole {
                0.0
            } else {
                self.stand_off(setup) + setup.radius + self.probe.dist
            };
            let reach = place(other).map_or(f64::INFINITY, |[oa, oo, _]| {
                (oa - a).hypot(oo - o) - other.nominal_diameter() / 2.0 - clear
            });
            Surface::Round(Round {
                center: frame.point(a, o, top),
                radius,
                hole: object.hole,
                drawn_depth: top - w + setup.radius,
                plate: object.hole.then_some(reach),
            })
        };
        let [one, two] = &objects;
        vec![known(one, two), known(two, one)]
    }

    fn resized(&self, _setup: &ProbeSettings, key: &str, delta: f64) -> Option<Box<dyn Cycle>> {
        let mut resized = self.clone();
        let size = match key {
            "diameter1" => &mut resized.form.diameter1,
            "diameter2" => &mut resized.form.diameter2,
            _ => return None,
        };
        let diameter = size.nominal? + delta;
        size.nominal = Some(diameter);
        (diameter > 0.0).then(|| Box::new(resized) as Box<dyn Cycle>)
    }

    fn add_verdicts(
        &self,
        setup: &ProbeSettings,
        path: &Path,
        triggers: &[Option<Vec3>],
        rows: &mut Vec<ResultRow>,
    ) {
        verdicts::judge(self, setup, path, triggers, rows);
    }

    fn turned_error(&self, _code: &str) -> Option<&'static str> {
        None
    }
}
