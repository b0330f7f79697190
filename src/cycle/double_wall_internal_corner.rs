//! Double wall internal corner: ENCY / SprutCAM type 13.
//!
//! Both walls of an inside corner, each touched once or more, from one start point inside. Everything stays at the level
//! of the touches between the first and the last move. The steps and codes are the source's; that the last lift uses the
//! return feed is our reading, since the source names no feed there.

use crate::cycle::ency::{Table, clearance_rule, touch_count_rule};
use crate::cycle::{Cycle, CycleDef};
use crate::formula::{Datum, Expr, Formula, Role, project};
use crate::geom::{Frame, Vec3};
use crate::path::{Feed, Path, Setup, Surface, Touch, Tracer, Wall};
use crate::spec::{Checker, Field, form};

pub static DEF: CycleDef = CycleDef {
    key: "double-wall-internal-corner",
    title: "Double wall internal corner",
    source: "ENCY/SprutCAM type 13",
    doc: "docs/cycles/double-wall-internal-corner.md",
    fields: Form::FIELDS,
    sections: &[],
    home: ("linuxcnc", "moves"),
    steps: &[
        "To the feed distance above the start, then down to the start: clearance 1 from wall 1 and clearance 2 from wall 2",
        "Touch the first point of wall 1, and back",
        "Where wall 1 has more points: to clearance 1 before the next one, touch, and back",
        "Step 3 until every point of wall 1 is touched",
        "Back to the start",
        "Touch the first point of wall 2, and back",
        "Where wall 2 has more points: to clearance 2 before the next one, touch, and back",
        "Step 7 until every point of wall 2 is touched",
        "Back to the start",
        "Up by the feed distance",
    ],
    readings: &[
        "Clearances are measured from the wall to the ball centre, heights are of the ball centre.",
        "The target vector is the outward normal of the wall: from the material into free space.",
        "The last lift uses the return feed: the source names no feed there.",
        "Seen along the tool axis with rotation 0, wall 1 runs from the corner along the ordinate, and wall 2 the corner angle \
         clockwise from it.",
        "A wall with two touches or more is the line of total least squares through the ball centres, offset by the ball radius \
         along its own normal; a wall with one touch keeps its nominal direction, and what needs its angle is not given.",
        "`rotation` is how far wall 1 is turned from its nominal direction, counter-clockwise positive.",
    ],
    read: |section| Box::new(Form::read(section)),
};

const COUNT_REASON: &str =
    "the parameter table holds 16 touch points (the 17th would run into the -200 block), and the other wall needs one";

form! {
    /// The form of type 13.
    pub struct Form {
        /// The corner, at the level of the touches.
        origin: Vec3 = Field::point("origin", "Corner at touch level").group("Place"),
        /// How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive.
        rotation: f64 = Field::angle("rotation", "Rotation", 0.0).group("Place"),
        /// Between the walls, inside the corner.
        angle: f64 = Field::angle("angle", "Corner angle", 90.0).range(20.0, 160.0).group("Size").size(),
        /// From wall 1 to the ball centre where its touches begin.
        clearance1: f64 = Field::length("clearance1", "Clearance 1", 15.0).above(0.0, 1000.0).usual(1.0, 200.0).code("CmdPrm.Flt[-56]").group("Clearances"),
        /// From wall 2 to the ball centre where its touches begin.
        clearance2: f64 = Field::length("clearance2", "Clearance 2", 15.0).above(0.0, 1000.0).usual(1.0, 200.0).code("CmdPrm.Flt[-57]").group("Clearances"),
        /// How far above the start the cycle begins and ends.
        feed_distance: f64 = Field::length("feedDistance", "Feed distance", 20.0).range(0.0, 1000.0).usual(1.0, 500.0).code("CmdPrm.Flt[-50]").group("Clearances"),
        /// How many touches wall 1 gets. Two or more measure its own angle.
        count1: i32 = Field::count("count1", "First wall measure count", 2, 1, 15).because(COUNT_REASON).code("CmdPrm.Int[-63]").group("Touches"),
        /// From touch to touch along wall 1, away from the corner.
        step1: f64 = Field::length("step1", "Step 1", 20.0).above(0.0, 1000.0).usual(2.0, 500.0).code("CmdPrm.Flt[-65]").group("Touches"),
        /// How many touches wall 2 gets. Two or more measure its own angle.
        count2: i32 = Field::count("count2", "Second wall measure count", 2, 1, 15).because(COUNT_REASON).code("CmdPrm.Int[-64]").group("Touches"),
        /// From touch to touch along wall 2, away from the corner.
        step2: f64 = Field::length("step2", "Step 2", 20.0).above(0.0, 1000.0).usual(2.0, 500.0).code("CmdPrm.Flt[-67]").group("Touches"),
        /// A free number for the postprocessor.
        sub_code: i32 = Field::count("subCode", "SubCode", 0, -1_000_000, 1_000_000).code("CmdPrm.Int[-2]").group("Postprocessor"),
    }
}

/// One side of the corner, in the feature frame (u, v).
struct Side {
    /// Along the wall, away from the corner.
    along: (f64, f64),
    /// Outward normal.
    normal: (f64, f64),
    /// Foot of the start point on the wall, from the corner.
    foot: f64,
    clearance: f64,
    count: usize,
    step: f64,
}

impl Form {
    fn frame(&self, setup: &Setup) -> Frame {
        Frame::new(setup.plane, self.origin, self.rotation.to_radians())
    }

    /// The start is `clearance1` from wall 1 and `clearance2` from wall 2. With wall 1 on the v axis that is
    /// u = c1, v = (c2 + c1·cos A) / sin A; by symmetry the foot on wall 2 is (c1 + c2·cos A) / sin A from the corner.
    fn sides(&self) -> [Side; 2] {
        let (sin, cos) = self.angle.to_radians().sin_cos();
        let (c1, c2) = (self.clearance1, self.clearance2);
        [
            Side {
                along: (0.0, 1.0),
                normal: (1.0, 0.0),
                foot: (c2 + c1 * cos) / sin,
                clearance: c1,
                count: self.count1.max(1) as usize,
                step: self.step1,
            },
            Side {
                along: (sin, cos),
                normal: (-cos, sin),
                foot: (c1 + c2 * cos) / sin,
                clearance: c2,
                count: self.count2.max(1) as usize,
                step: self.step2,
            },
        ]
    }

    fn touches(&self, frame: &Frame, setup: &Setup) -> Vec<Touch> {
        let mut touches = Vec::new();
        for (group, side) in self.sides().iter().enumerate() {
            let along = frame.direction(side.along.0, side.along.1);
            let vector = frame.direction(side.normal.0, side.normal.1);
            for i in 0..side.count {
                let point = frame.origin + along * (side.foot + i as f64 * side.step);
                touches.push(Touch { point, vector, group, search: setup.overtravel, sample: touches.len() });
            }
        }
        touches
    }

    /// Each wall is a line: through the mean of the ball centres, along their total-least-squares direction where there
    /// are two or more, else along the nominal one; then offset by the ball radius along its own normal. The corner is
    /// where the lines meet.
    fn formula(&self, setup: &Setup) -> Formula {
        let [a, o, _] = setup.plane.axes();
        let turn = self.rotation.to_radians();
        let in_plane = |(u, v): (f64, f64)| (u * turn.cos() - v * turn.sin(), u * turn.sin() + v * turn.cos());
        let mut formula = Formula::default();
        let mut first = 0;
        let lines = self.sides().map(|side| {
            let wall = Line {
                number: if first == 0 { 1 } else { 2 },
                first,
                count: side.count,
                along: in_plane(side.along),
                normal: in_plane(side.normal),
            };
            first += side.count;
            wall.fit(&mut formula, (a, o), setup.radius)
        });
        let [one, two] = lines;
        // Cramer's rule on n1·p = q1, n2·p = q2.
        let det = formula.set("det", one.normal.0.clone() * two.normal.1.clone() - one.normal.1.clone() * two.normal.0.clone());
        let x = (one.offset.clone() * two.normal.1.clone() - two.offset.clone() * one.normal.1.clone()) / det.clone();
        let y = (two.offset * one.normal.0.clone() - one.offset * two.normal.0) / det;
        let x = formula.set("corner_x", x);
        let y = formula.set("corner_y", y);
        // Wall 1 has its free side to the right of its direction and wall 2 to its left, so their angles in (along, normal)
        // count opposite ways.
        let rotation = one.tilt.clone().map(|tilt| formula.set("rotation", Expr::Number(0.0) - tilt));
        let angle = one.tilt.zip(two.tilt).map(|(t1, t2)| formula.set("angle", Expr::Number(self.angle) - t1 - t2));
        formula.result("corner.x", Role::Abscissa, "Corner, abscissa", self.origin[a], Some(&x));
        formula.result("corner.y", Role::Ordinate, "Corner, ordinate", self.origin[o], Some(&y));
        formula.datum = Some(Datum::point((x, self.origin[a]), (y, self.origin[o])));
        formula.result("angle", Role::Angle, "Angle between the walls", self.angle, angle.as_ref());
        formula.result("rotation", Role::Direction, "Wall 1 against its nominal direction", 0.0, rotation.as_ref());
        formula
    }

    fn parameters(&self, touches: &[Touch]) -> Table {
        let mut table = Table::default();
        table.int(-1, 13, "Probing cycle type: 13 = double wall internal corner probing", Some("cycle.type"));
        table.int(-2, self.sub_code, "SubCode for the postprocessor", Some("cycle.subCode"));
        table.length(-50, self.feed_distance, "Feed distance, to the start position of the cycle", "cycle.feedDistance");
        table.length(-56, self.clearance1, "Clearance 1, approach to the touch points on the first side", "cycle.clearance1");
        table.length(-57, self.clearance2, "Clearance 2, approach to the touch points on the second side", "cycle.clearance2");
        table.int(-63, self.count1, "First wall measure count, touch points on the first side", Some("cycle.count1"));
        table.int(-64, self.count2, "Second wall measure count, touch points on the second side", Some("cycle.count2"));
        table.length(-65, self.step1, "Step 1, between touch points on the first wall", "cycle.step1");
        table.length(-67, self.step2, "Step 2, between touch points on the second wall", "cycle.step2");
        let split = self.count1.max(1) as usize;
        table.touches(touches, 0.0, |k| {
            if k < split {
                format!("Point {} on the first side", k + 1)
            } else {
                format!("Point {} on the second side", k - split + 1)
            }
        });
        table
    }
}

/// A wall's touches and its nominal directions in the plane.
struct Line {
    number: usize,
    first: usize,
    count: usize,
    along: (f64, f64),
    normal: (f64, f64),
}

/// The fitted wall: normal · p = offset, both in the plane.
struct Fitted {
    normal: (Expr, Expr),
    offset: Expr,
    /// Its direction against the nominal one in (along, normal), degrees.
    tilt: Option<Expr>,
}

impl Line {
    fn fit(&self, formula: &mut Formula, (a, o): (usize, usize), radius: f64) -> Fitted {
        let n = self.number;
        let touches = self.first..self.first + self.count;
        let place = |touch: usize, direction| project(Expr::trigger(touch, a), Expr::trigger(touch, o), direction);
        if self.count == 1 {
            let height = place(self.first, self.normal) - Expr::Length(radius);
            let offset = formula.set(format!("q{n}"), height);
            let normal = (constant(self.normal.0), constant(self.normal.1));
            return Fitted { normal, offset, tilt: None };
        }
        let places: Vec<(Expr, Expr)> = touches
            .map(|touch| {
                let s = formula.set(format!("s{}", touch + 1), place(touch, self.along));
                let h = formula.set(format!("h{}", touch + 1), place(touch, self.normal));
                (s, h)
            })
            .collect();
        let count = Expr::Number(self.count as f64);
        let sum = |parts: Vec<Expr>| parts.into_iter().reduce(|sum, part| sum + part).expect("two touches or more");
        let mean_s = formula.set(format!("mean_s{n}"), sum(places.iter().map(|p| p.0.clone()).collect()) / count.clone());
        let mean_h = formula.set(format!("mean_h{n}"), sum(places.iter().map(|p| p.1.clone()).collect()) / count);
        let tilt = if let [(s1, h1), (s2, h2)] = places.as_slice() {
            ((h2.clone() - h1.clone()) / (s2.clone() - s1.clone())).atan2(Expr::Number(1.0))
        } else {
            self.least_squares(formula, places, &mean_s, &mean_h)
        };
        let tilt = formula.set(format!("tilt{n}"), tilt);
        let sin = formula.set(format!("sin{n}"), tilt.clone().sin());
        let cos = formula.set(format!("cos{n}"), tilt.clone().cos());
        let offset = mean_h * cos.clone() - mean_s * sin.clone() - Expr::Length(radius);
        let offset = formula.set(format!("q{n}"), offset);
        let mut turned = |name: &str, along: f64, normal: f64| {
            formula.set(format!("{name}{n}"), project(cos.clone(), sin.clone(), (normal, -along)))
        };
        let normal = (turned("na", self.along.0, self.normal.0), turned("no", self.along.1, self.normal.1));
        Fitted { normal, offset, tilt: Some(tilt) }
    }

    /// The direction against the nominal one along which the scatter is largest: tan 2t = 2·Ssh / (Sss − Shh).
    fn least_squares(&self, formula: &mut Formula, places: Vec<(Expr, Expr)>, mean_s: &Expr, mean_h: &Expr) -> Expr {
        let n = self.number;
        let (mut ss, mut hh, mut sh) = (Expr::Number(0.0), Expr::Number(0.0), Expr::Number(0.0));
        for (i, (s, h)) in places.into_iter().enumerate() {
            let touch = self.first + i + 1;
            let ds = formula.set(format!("ds{touch}"), s - mean_s.clone());
            let dh = formula.set(format!("dh{touch}"), h - mean_h.clone());
            ss = formula.set(format!("ss{n}_{}", i + 1), ss + ds.clone() * ds.clone());
            hh = formula.set(format!("hh{n}_{}", i + 1), hh + dh.clone() * dh.clone());
            sh = formula.set(format!("sh{n}_{}", i + 1), sh + ds * dh);
        }
        (Expr::Number(2.0) * sh).atan2(ss - hh) / Expr::Number(2.0)
    }
}

fn constant(x: f64) -> Expr {
    Expr::Number(crate::num::tidy(x))
}

impl Cycle for Form {
    fn rules(&self, setup: &Setup, checker: &mut Checker) {
        clearance_rule(checker, setup, "Clearance 1", self.clearance1, "cycle.clearance1");
        clearance_rule(checker, setup, "Clearance 2", self.clearance2, "cycle.clearance2");
        if checker.sound(&["cycle.count1", "cycle.count2"]) {
            let path = if self.count1 >= self.count2 { "cycle.count1" } else { "cycle.count2" };
            touch_count_rule(checker, (self.count1 + self.count2) as usize, path);
        }
        let paths = ["cycle.clearance1", "cycle.clearance2", "cycle.angle", "stylus.diameter"];
        if !checker.sound(&paths) {
            return;
        }
        // The first touch of a wall has its foot `foot` from the corner, and the ball in contact there stands
        // c_other + (c − r)·cos A from the other wall.
        let cos = self.angle.to_radians().cos();
        let sides = self.sides();
        let ways = [(1, 2, &sides[0], self.clearance2), (2, 1, &sides[1], self.clearance1)];
        for (n, other, side, other_clearance) in ways {
            let free = other_clearance + (side.clearance - setup.radius) * cos;
            let message = if side.foot <= 0.0 {
                format!(
                    "The first touch of wall {n} would fall {} beyond the corner: at {}° clearance {other} must be larger than {}",
                    checker.length(-side.foot),
                    crate::num::decimal(self.angle, 4),
                    checker.length(-side.clearance * cos)
                )
            } else if free <= setup.radius {
                format!(
                    "In the first touch of wall {n} the ball would meet wall {other} first: at {}° clearance {other} must be \
                     larger than {}",
                    crate::num::decimal(self.angle, 4),
                    checker.length(setup.radius - (side.clearance - setup.radius) * cos)
                )
            } else {
                continue;
            };
            checker.error("touch-beyond-corner", format!("cycle.clearance{other}"), message);
        }
    }

    fn plan(&self, setup: &Setup) -> Path {
        let frame = self.frame(setup);
        let touches = self.touches(&frame, setup);
        let sides = self.sides();
        let start = frame.point(self.clearance1, sides[0].foot, 0.0);
        let above = start + frame.w * self.feed_distance;
        let mut tracer = Tracer::new(setup);
        tracer.position(above, Feed::Approach, 1);
        tracer.position(start, Feed::Approach, 1);
        // Step numbers of each side: first touch, further touches, back to the start.
        let steps = [[2, 3, 5], [6, 7, 9]];
        let mut first = true;
        let mut group = 0;
        for (k, touch) in touches.iter().enumerate() {
            if touch.group != group {
                tracer.position(start, Feed::LongLink, steps[group][2]);
                group = touch.group;
                first = true;
            }
            let step = steps[group][usize::from(!first)];
            if !first {
                tracer.position(touch.point + touch.vector * sides[group].clearance, Feed::LongLink, step);
            }
            tracer.touch(k, touch, Feed::LongLink, step);
            first = false;
        }
        tracer.position(start, Feed::LongLink, steps[1][2]);
        tracer.position(above, Feed::Return, 10);
        let parameters = self.parameters(&touches).rows();
        Path {
            moves: tracer.moves(),
            surfaces: self.surfaces(setup),
            feeds: None,
            line: None,
            spread: None,
            frame,
            formula: self.formula(setup),
            parameters,
            picked: false,
            touches,
        }
    }

    fn surfaces(&self, setup: &Setup) -> Vec<Surface> {
        let frame = self.frame(setup);
        let margin = 3.0 * setup.radius.max(2.0);
        self.sides()
            .iter()
            .map(|side| {
                Surface::Flat(Wall {
                    point: frame.origin,
                    normal: frame.direction(side.normal.0, side.normal.1),
                    along: frame.direction(side.along.0, side.along.1),
                    extent: (0.0, side.foot.max(0.0) + (side.count - 1) as f64 * side.step + margin),
                    drawn_depth: 2.0 * setup.radius.max(1.0),
                    has_top: false,
                })
            })
            .collect()
    }

    fn resized(&self, key: &str, delta: f64) -> Option<Box<dyn Cycle>> {
        if key != "angle" {
            return None;
        }
        let mut form = self.clone();
        form.angle += delta;
        (form.angle > 0.0 && form.angle < 180.0).then(|| Box::new(form) as Box<dyn Cycle>)
    }

    fn turned_error(&self, code: &str) -> Option<&'static str> {
        let single = self.count1 == 1 || self.count2 == 1;
        (single && code.starts_with("corner.")).then_some(
            "a wall with one touch is taken to have its nominal direction, which a turned part has not: give it a second touch",
        )
    }
}
