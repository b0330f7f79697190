//! Forms that two cycles share: what is probed from inside, and the same from outside.

use crate::cycle::ency::{Circle, Dimensions, Pairs, Shape, Side, Variant, field};
use crate::form::form;
use crate::geom::Vec3;

form! {
    /// Holes and bosses, each touch entered from above.
    pub struct RoundProtected {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        diameter: f64 = field::diameter(),
        depth: f64 = field::depth(),
        variant: i32 = field::variant(),
        start_angle: f64 = field::start_angle(),
        angular_step: f64 = field::angular_step(),
        step_count: i32 = field::step_count(),
        top_clearance: f64 = field::top_clearance(),
        /// From the wall to the ball centre where touches begin.
        side_clearance: f64 = field::clearance("sideClearance", "Side clearance", 8.0, "CmdPrm.Flt[-56]"),
        feed_distance: f64 = field::feed_distance(),
        compensate_dimensions: bool = field::compensate(),
        sub_code: i32 = field::sub_code(),
    }
}

impl RoundProtected {
    /// What it says of the feature; `internal` is whether the material lies around it.
    pub fn dimensions(&self, internal: bool) -> Dimensions {
        let shape = Shape::Circle(Circle {
            internal,
            diameter: self.diameter,
            variant: Variant::of(self.variant, self.start_angle, self.angular_step, self.step_count),
            depth: self.depth,
            top: Some(self.top_clearance),
            clearance: Some(self.side_clearance),
        });
        Dimensions::of(self, (self.origin, self.rotation), self.feed_distance, shape)
    }
}

form! {
    /// Rectangles, each touch entered from above.
    pub struct RectangleProtected {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        /// From touch point 1 to touch point 2, along the first direction of the rectangle.
        width1: f64 = field::width("width1", "Width 1", 80.0, "CmdPrm.Flt[-53]"),
        /// From touch point 3 to touch point 4, along the second direction.
        width2: f64 = field::width("width2", "Width 2", 50.0, "CmdPrm.Flt[-54]"),
        depth: f64 = field::depth(),
        top_clearance: f64 = field::top_clearance(),
        /// From the wall to the ball centre where touches 1 and 2 begin.
        side_clearance1: f64 = field::clearance("sideClearance1", "Side clearance 1", 8.0, "CmdPrm.Flt[-56]"),
        /// From the wall to the ball centre where touches 3 and 4 begin.
        side_clearance2: f64 = field::clearance("sideClearance2", "Side clearance 2", 8.0, "CmdPrm.Flt[-57]"),
        feed_distance: f64 = field::feed_distance(),
        compensate_dimensions: bool = field::compensate(),
        sub_code: i32 = field::sub_code(),
    }
}

impl RectangleProtected {
    /// What it says of the feature; `internal` is whether the material lies around it.
    pub fn dimensions(&self, internal: bool) -> Dimensions {
        let shape = Shape::Pairs(Pairs {
            internal,
            sides: vec![
                Side { width: self.width1, clearance: Some(self.side_clearance1) },
                Side { width: self.width2, clearance: Some(self.side_clearance2) },
            ],
            depth: self.depth,
            top: Some(self.top_clearance),
            middle: None,
        });
        Dimensions::of(self, (self.origin, self.rotation), self.feed_distance, shape)
    }
}

form! {
    /// Webs and grooves, each touch entered from above.
    pub struct PairProtected {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        /// From touch point 1 to touch point 2.
        width: f64 = field::width("width", "Width", 30.0, "CmdPrm.Flt[-53]"),
        depth: f64 = field::depth(),
        top_clearance: f64 = field::top_clearance(),
        /// From the wall to the ball centre where touches begin.
        side_clearance: f64 = field::clearance("sideClearance", "Side clearance", 8.0, "CmdPrm.Flt[-56]"),
        feed_distance: f64 = field::feed_distance(),
        compensate_dimensions: bool = field::compensate(),
        sub_code: i32 = field::sub_code(),
    }
}

impl PairProtected {
    /// What it says of the feature; `internal` is whether the material lies around it.
    pub fn dimensions(&self, internal: bool) -> Dimensions {
        let shape = Shape::Pairs(Pairs {
            internal,
            sides: vec![Side { width: self.width, clearance: Some(self.side_clearance) }],
            depth: self.depth,
            top: Some(self.top_clearance),
            middle: None,
        });
        Dimensions::of(self, (self.origin, self.rotation), self.feed_distance, shape)
    }
}
