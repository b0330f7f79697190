//! Internal rectangle, protected: ENCY / SprutCAM type 7.
//!
//! Four touches from inside, one a wall, each entered from above, so that an island in the middle is not met. The steps
//! and codes are the source's; that sideways returns use the long link feed and the last lift the return feed is our
//! reading, since the source names no feed there.

use crate::cycle::ency::{Table, clearance_rule};
use crate::cycle::{Cycle, CycleDef};
use crate::formula::{Datum, Expr, Formula, Role, project};
use crate::geom::{Frame, Vec3};
use crate::path::{Feed, Path, Setup, Surface, Touch, Tracer, Wall};
use crate::spec::{Checker, Field, form};

pub static DEF: CycleDef = CycleDef {
    key: "internal-rectangle-protected",
    title: "Internal rectangle, protected",
    source: "ENCY/SprutCAM type 7",
    doc: "docs/cycles/internal-rectangle-protected.md",
    fields: Form::FIELDS,
    sections: &[],
    home: ("linuxcnc", "moves"),
    steps: &[
        "To the feed distance above the start, then down to the start: the centre, top clearance above the top side",
        "Over the place the side clearance away from the touch point, at the height of the start",
        "Down by top clearance and depth",
        "Touch, and back to where the touch began",
        "Up by top clearance and depth",
        "Back to the start",
        "Steps 2 to 6 three times more, once for each touch point that is left",
        "Up by the feed distance",
    ],
    readings: &[
        "Clearances are measured from the wall to the ball centre, heights are of the ball centre.",
        "The target vector is the outward normal of the wall: from the material into free space.",
        "Sideways returns use the long link feed and the last lift the return feed: the source names no feed there.",
        "With *Compensate dimensions* on, the points from code -100 are ball-centre positions; the source only says \"toolpath \
         shift with tool compensation\". The points from code -200 never move.",
        "Touch point 1 is the wall in the first direction, 2 its opposite, 3 the wall a quarter turn counter-clockwise from 1, \
         4 its opposite.",
        "The control adds the ball radius along the probing direction, so a turned pocket reads too wide: by (W - d)(1/cos t - 1) \
         for a width W, a ball diameter d and a turn t.",
    ],
    read: |section| Box::new(Form::read(section)),
};

form! {
    /// The form of type 7.
    pub struct Form {
        /// Centre of the rectangle, on its top side.
        origin: Vec3 = Field::point("origin", "Centre on the top side").group("Place"),
        /// How the rectangle is turned about the tool axis; counter-clockwise positive.
        rotation: f64 = Field::angle("rotation", "Rotation", 0.0).group("Place"),
        /// From touch point 1 to touch point 2, along the first direction of the rectangle.
        width1: f64 = Field::length("width1", "Width 1", 80.0).above(0.0, 10_000.0).usual(5.0, 2000.0).code("CmdPrm.Flt[-53]").group("Size").size(),
        /// From touch point 3 to touch point 4, along the second direction.
        width2: f64 = Field::length("width2", "Width 2", 50.0).above(0.0, 10_000.0).usual(5.0, 2000.0).code("CmdPrm.Flt[-54]").group("Size").size(),
        /// From the top side down to the ball centre at the touches.
        depth: f64 = Field::length("depth", "Depth", 10.0).above(0.0, 1000.0).usual(0.5, 200.0).code("CmdPrm.Flt[-51]").group("Size"),
        /// How far above the top side the ball centre crosses from wall to wall.
        top_clearance: f64 = Field::length("topClearance", "Top clearance", 10.0).above(0.0, 1000.0).usual(1.0, 200.0).code("CmdPrm.Flt[-55]").group("Clearances"),
        /// From the wall to the ball centre where touches 1 and 2 begin.
        side_clearance1: f64 = Field::length("sideClearance1", "Side clearance 1", 8.0).above(0.0, 1000.0).usual(1.0, 100.0).code("CmdPrm.Flt[-56]").group("Clearances"),
        /// From the wall to the ball centre where touches 3 and 4 begin.
        side_clearance2: f64 = Field::length("sideClearance2", "Side clearance 2", 8.0).above(0.0, 1000.0).usual(1.0, 100.0).code("CmdPrm.Flt[-57]").group("Clearances"),
        /// How far above the start the cycle begins and ends.
        feed_distance: f64 = Field::length("feedDistance", "Feed distance", 20.0).range(0.0, 1000.0).usual(1.0, 500.0).code("CmdPrm.Flt[-50]").group("Clearances"),
        /// On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same.
        compensate_dimensions: bool = Field::flag("compensateDimensions", "Compensate dimensions", false).code("CmdPrm.Flt[-66]").group("Postprocessor"),
        /// A free number for the postprocessor.
        sub_code: i32 = Field::count("subCode", "SubCode", 0, -1_000_000, 1_000_000).code("CmdPrm.Int[-2]").group("Postprocessor"),
    }
}

const ORDINALS: [&str; 4] = ["First", "Second", "Third", "Fourth"];

impl Form {
    fn frame(&self, setup: &Setup) -> Frame {
        Frame::new(setup.plane, self.origin, self.rotation.to_radians())
    }

    fn touches(&self, frame: &Frame, setup: &Setup) -> [Touch; 4] {
        let wall = |u: f64, v: f64, width: f64, group: usize| {
            let outwards = frame.direction(u, v);
            let point = frame.origin + outwards * (width / 2.0) - frame.w * self.depth;
            Touch { point, vector: -outwards, group, search: setup.overtravel, sample: group }
        };
        [
            wall(1.0, 0.0, self.width1, 0),
            wall(-1.0, 0.0, self.width1, 1),
            wall(0.0, 1.0, self.width2, 2),
            wall(0.0, -1.0, self.width2, 3),
        ]
    }

    /// The control adds the ball radius along the probing direction, halves each pair, and takes the differences as widths.
    fn formula(&self, setup: &Setup) -> Formula {
        let [a, o, _] = setup.plane.axes();
        let (sin, cos) = self.rotation.to_radians().sin_cos();
        let mut formula = Formula::default();
        let mut pair = |first: usize, along: (f64, f64), names: [&str; 2]| {
            let mut wall = |touch: usize, radius: f64| {
                let place = project(Expr::trigger(touch, a), Expr::trigger(touch, o), along);
                formula.set(format!("wall{}", touch + 1), place + Expr::Length(radius))
            };
            let (plus, minus) = (wall(first, setup.radius), wall(first + 1, -setup.radius));
            let width = formula.set(names[0], plus.clone() - minus.clone());
            let middle = formula.set(names[1], (plus + minus) / Expr::Number(2.0));
            (width, middle)
        };
        let (width1, u) = pair(0, (cos, sin), ["width1", "middle_u"]);
        let (width2, v) = pair(2, (-sin, cos), ["width2", "middle_v"]);
        let x = formula.set("center_x", project(u.clone(), v.clone(), (cos, -sin)));
        let y = formula.set("center_y", project(u, v, (sin, cos)));
        formula.result("center.x", Role::Abscissa, "Centre, abscissa", self.origin[a], Some(&x));
        formula.result("center.y", Role::Ordinate, "Centre, ordinate", self.origin[o], Some(&y));
        formula.datum = Some(Datum::point((x, self.origin[a]), (y, self.origin[o])));
        formula.result("width1", Role::Size, "Width 1", self.width1, Some(&width1));
        formula.result("width2", Role::Size, "Width 2", self.width2, Some(&width2));
        formula.result("rotation", Role::Direction, "Rotation: one touch a wall gives no angle", 0.0, None);
        formula
    }

    fn parameters(&self, setup: &Setup, touches: &[Touch]) -> Table {
        let mut table = Table::default();
        table.int(-1, 7, "Probing cycle type: 7 = internal rectangle probing protected", Some("cycle.type"));
        table.int(-2, self.sub_code, "SubCode for the postprocessor", Some("cycle.subCode"));
        table.length(-50, self.feed_distance, "Feed distance, to the start position of the cycle", "cycle.feedDistance");
        table.length(-51, self.depth, "Depth, from the top side to the centre of the touch points", "cycle.depth");
        table.length(-53, self.width1, "Width 1, from touch point 1 to touch point 2", "cycle.width1");
        table.length(-54, self.width2, "Width 2, from touch point 3 to touch point 4", "cycle.width2");
        table.length(-55, self.top_clearance, "Top clearance, distance from the top side", "cycle.topClearance");
        table.length(-56, self.side_clearance1, "Side clearance 1, approach to touch points 1 and 2", "cycle.sideClearance1");
        table.length(-57, self.side_clearance2, "Side clearance 2, approach to touch points 3 and 4", "cycle.sideClearance2");
        let shift = if self.compensate_dimensions { setup.radius } else { 0.0 };
        table.touches(touches, shift, |k| ORDINALS[k].to_owned());
        table.compensate(self.compensate_dimensions);
        table
    }
}

impl Cycle for Form {
    fn rules(&self, setup: &Setup, checker: &mut Checker) {
        let sides = [
            (1, self.width1, "cycle.width1", self.side_clearance1, "cycle.sideClearance1"),
            (2, self.width2, "cycle.width2", self.side_clearance2, "cycle.sideClearance2"),
        ];
        for (n, width, width_path, clearance, clearance_path) in sides {
            clearance_rule(checker, setup, &format!("Side clearance {n}"), clearance, clearance_path);
            if checker.sound(&[width_path, "stylus.diameter"]) && width <= 2.0 * setup.radius {
                let message = format!(
                    "Width {n} ({}) must be larger than the ball ({}): the ball does not go in",
                    checker.length(width),
                    checker.length(2.0 * setup.radius)
                );
                checker.error("ball-too-wide", width_path, message);
            } else if checker.sound(&[width_path, clearance_path, "stylus.diameter"]) && clearance + setup.radius >= width {
                let message = format!(
                    "Side clearance {n} ({}) puts the ball into the opposite wall: with width {n} of {} it must be less than {}",
                    checker.length(clearance),
                    checker.length(width),
                    checker.length(width - setup.radius)
                );
                checker.error("approach-beyond-wall", clearance_path, message);
            }
        }
        if checker.sound(&["cycle.depth", "stylus.diameter"]) && self.depth < setup.radius {
            let message = format!(
                "At a depth of {} the ball (radius {}) stands out above the top side: an edge break or burr there is part of \
                 the touch",
                checker.length(self.depth),
                checker.length(setup.radius)
            );
            checker.warning("touch-near-edge", "cycle.depth", message);
        }
        if checker.sound(&["cycle.topClearance", "stylus.diameter"]) && self.top_clearance <= setup.radius {
            let message = format!(
                "With a top clearance of {} the ball (radius {}) crosses below the top side, since heights are of the ball \
                 centre: an island as high as the top side would be hit",
                checker.length(self.top_clearance),
                checker.length(setup.radius)
            );
            checker.warning("low-crossing", "cycle.topClearance", message);
        }
    }

    fn plan(&self, setup: &Setup) -> Path {
        let frame = self.frame(setup);
        let touches = self.touches(&frame, setup);
        let start = frame.point(0.0, 0.0, self.top_clearance);
        let drop = frame.w * (self.top_clearance + self.depth);
        let above = start + frame.w * self.feed_distance;
        let mut tracer = Tracer::new(setup);
        tracer.position(above, Feed::Approach, 1);
        tracer.position(start, Feed::Approach, 1);
        for (k, touch) in touches.iter().enumerate() {
            let clearance = if k < 2 { self.side_clearance1 } else { self.side_clearance2 };
            let approach = touch.point + touch.vector * clearance;
            tracer.position(approach + drop, Feed::LongLink, 2);
            tracer.position(approach, Feed::LongLink, 3);
            tracer.touch(k, touch, Feed::LongLink, 4);
            tracer.position(approach + drop, Feed::LongLink, 5);
            tracer.position(start, Feed::LongLink, 6);
        }
        tracer.position(above, Feed::Return, 8);
        Path {
            touches: touches.to_vec(),
            moves: tracer.moves(),
            surfaces: self.surfaces(setup),
            feeds: None,
            line: None,
            spread: None,
            frame,
            formula: self.formula(setup),
            parameters: self.parameters(setup, &touches).rows(),
            picked: false,
        }
    }

    fn surfaces(&self, setup: &Setup) -> Vec<Surface> {
        let frame = self.frame(setup);
        let halves = [self.width2 / 2.0, self.width2 / 2.0, self.width1 / 2.0, self.width1 / 2.0];
        self.touches(&frame, setup)
            .iter()
            .zip(halves)
            .map(|(touch, half)| {
                Surface::Flat(Wall {
                    point: touch.point + frame.w * self.depth,
                    normal: touch.vector,
                    along: frame.w.cross(touch.vector),
                    extent: (-half, half),
                    drawn_depth: self.depth + setup.radius,
                    has_top: true,
                })
            })
            .collect()
    }

    fn resized(&self, key: &str, delta: f64) -> Option<Box<dyn Cycle>> {
        let mut form = self.clone();
        let size = match key {
            "width1" => &mut form.width1,
            "width2" => &mut form.width2,
            _ => return None,
        };
        *size += delta;
        (*size > 0.0).then(|| Box::new(form) as Box<dyn Cycle>)
    }

    fn turned_error(&self, code: &str) -> Option<&'static str> {
        match code {
            "width1" | "width2" => Some(
                "cosine error: the walls are turned against the probing direction, so the width reads (W - d)(1/cos - 1) too \
                 wide, d being the ball diameter",
            ),
            "center.x" | "center.y" => Some(
                "the walls are turned against the probing lines, which miss the shifted centre: the middle is found where a \
                 line crosses the turned middle",
            ),
            _ => None,
        }
    }
}
