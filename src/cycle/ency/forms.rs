//! The forms of the family and the dimensions that they give. Two cycles share a form if they probe the same shape from inside and from outside.

use crate::cycle::ency::{
    Circle, Corner, CornerAngle, Dimensions, Outside, Pairs, Point, Shape, Side, Triple,
    TwoTouches, Variant, field,
};
use crate::form::{BestView, Field, form};
use crate::geom::Vec3;

form! {
    /// Holes and bosses; the stylus enters from above for each touch.
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
    /// Dimensions of the feature. `internal`: whether the material is outside.
    pub fn dimensions(&self, internal: bool) -> Dimensions {
        let shape = Shape::Circle(Circle {
            internal,
            diameter: self.diameter,
            variant: Variant::of(
                self.variant,
                self.start_angle,
                self.angular_step,
                self.step_count,
            ),
            depth: self.depth,
            top: Some(self.top_clearance),
            clearance: Some(self.side_clearance),
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}

form! {
    /// Rectangles; the stylus enters from above for each touch.
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
    /// Dimensions of the feature. `internal`: whether the material is outside.
    pub fn dimensions(&self, internal: bool) -> Dimensions {
        let shape = Shape::Pairs(Pairs {
            internal,
            sides: vec![
                Side {
                    width: self.width1,
                    clearance: Some(self.side_clearance1),
                },
                Side {
                    width: self.width2,
                    clearance: Some(self.side_clearance2),
                },
            ],
            depth: self.depth,
            top: Some(self.top_clearance),
            middle: None,
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}

form! {
    /// Webs and grooves; the stylus enters from above for each touch.
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
    /// Dimensions of the feature. `internal`: whether the material is outside.
    pub fn dimensions(&self, internal: bool) -> Dimensions {
        let shape = Shape::Pairs(Pairs {
            internal,
            sides: vec![Side {
                width: self.width,
                clearance: Some(self.side_clearance),
            }],
            depth: self.depth,
            top: Some(self.top_clearance),
            middle: None,
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}

form! {
    /// The form of type 1.
    pub struct NcAction {
        sub_code: i32 = field::sub_code(),
    }
}

form! {
    /// The form of type 0.
    pub struct ProbeOnOff {
        /// Whether the probe is switched on or off.
        on: bool = Field::flag("on", "On", true).code("CmdPrm.Bol[-3]").group("Postprocessor"),
    }
}

form! {
    /// The form of type 2.
    pub struct Surface {
        /// The touch point, on the surface.
        origin: Vec3 = field::origin("Touch point"),
        /// Where the target vector points in the plane; counter-clockwise positive.
        rotation: f64 = field::rotation(),
        /// How steeply the target vector points up from the plane: 90 is a top side, 0 a wall.
        elevation: f64 = Field::angle("elevation", "Elevation", 90.0).range(0.0, 90.0).group("Position"),
        /// From the surface to the ball centre where the touch begins.
        clearance: f64 = field::clearance("clearance", "Clearance", 10.0, "CmdPrm.Flt[-56]"),
        feed_distance: f64 = field::feed_distance(),
        compensate_dimensions: bool = field::compensate(),
        sub_code: i32 = field::sub_code(),
    }
}

impl Surface {
    pub fn dimensions(&self) -> Dimensions {
        let shape = Shape::Point(Point {
            clearance: self.clearance,
            elevation: self.elevation,
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}

form! {
    /// The form of type 3.
    pub struct Hole {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        diameter: f64 = field::diameter(),
        depth: f64 = field::depth(),
        variant: i32 = field::variant(),
        start_angle: f64 = field::start_angle(),
        angular_step: f64 = field::angular_step(),
        step_count: i32 = field::step_count(),
        top_clearance: Option<f64> = field::entry_clearance(),
        feed_distance: f64 = field::feed_distance(),
        sub_code: i32 = field::sub_code(),
    }
}

impl Hole {
    pub fn dimensions(&self) -> Dimensions {
        let shape = Shape::Circle(Circle {
            internal: true,
            diameter: self.diameter,
            variant: Variant::of(
                self.variant,
                self.start_angle,
                self.angular_step,
                self.step_count,
            ),
            depth: self.depth,
            top: self.top_clearance,
            clearance: None,
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}

form! {
    /// The form of type 6.
    pub struct InternalRectangle {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        /// From touch point 1 to touch point 2, along the first direction of the rectangle.
        width1: f64 = field::width("width1", "Width 1", 80.0, "CmdPrm.Flt[-53]"),
        /// From touch point 3 to touch point 4, along the second direction.
        width2: f64 = field::width("width2", "Width 2", 50.0, "CmdPrm.Flt[-54]"),
        depth: f64 = field::depth(),
        top_clearance: Option<f64> = field::entry_clearance(),
        feed_distance: f64 = field::feed_distance(),
        sub_code: i32 = field::sub_code(),
    }
}

impl InternalRectangle {
    pub fn dimensions(&self) -> Dimensions {
        let shape = Shape::Pairs(Pairs {
            internal: true,
            sides: [self.width1, self.width2]
                .map(|width| Side {
                    width,
                    clearance: None,
                })
                .into(),
            depth: self.depth,
            top: self.top_clearance,
            middle: None,
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}

form! {
    /// The form of type 10.
    pub struct WebThreePoints {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        /// From the left touch point to the right one.
        width: f64 = field::width("width", "Width", 30.0, "CmdPrm.Flt[-53]"),
        /// From the top side down to the ball centre at the left and the right touch.
        depth: f64 = field::depth(),
        /// From the wall to the ball centre where the left and the right touch begin.
        side_clearance: f64 = field::clearance("sideClearance", "Side clearance", 8.0, "CmdPrm.Flt[-56]"),
        /// From the top side to the ball centre where the middle touch begins, and where the ball crosses.
        middle_clearance: f64 = field::clearance("middleClearance", "Middle clearance", 10.0, "CmdPrm.Flt[-57]").seen(BestView::Height),
        feed_distance: f64 = field::feed_distance(),
        compensate_dimensions: bool = field::compensate(),
        sub_code: i32 = field::sub_code(),
    }
}

impl WebThreePoints {
    pub fn dimensions(&self) -> Dimensions {
        let shape = Shape::Pairs(Pairs {
            internal: false,
            sides: vec![Side {
                width: self.width,
                clearance: Some(self.side_clearance),
            }],
            depth: self.depth,
            top: Some(self.middle_clearance),
            middle: Some(self.middle_clearance),
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}

form! {
    /// The form of type 11.
    pub struct Groove {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        /// From touch point 1 to touch point 2.
        width: f64 = field::width("width", "Width", 30.0, "CmdPrm.Flt[-53]"),
        depth: f64 = field::depth(),
        top_clearance: Option<f64> = field::entry_clearance(),
        feed_distance: f64 = field::feed_distance(),
        sub_code: i32 = field::sub_code(),
    }
}

impl Groove {
    pub fn dimensions(&self) -> Dimensions {
        let shape = Shape::Pairs(Pairs {
            internal: true,
            sides: vec![Side {
                width: self.width,
                clearance: None,
            }],
            depth: self.depth,
            top: self.top_clearance,
            middle: None,
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}

form! {
    /// The form of type 13.
    pub struct DoubleWallInternalCorner {
        /// The corner, at the level of the touches.
        origin: Vec3 = field::origin("Corner at touch level"),
        /// How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive.
        rotation: f64 = field::rotation(),
        /// Between the walls, inside the corner.
        angle: f64 = field::angle(),
        /// From wall 1 to the ball centre where its touches begin.
        clearance1: f64 = field::clearance("clearance1", "Clearance 1", 15.0, "CmdPrm.Flt[-56]"),
        /// From wall 2 to the ball centre where its touches begin.
        clearance2: f64 = field::clearance("clearance2", "Clearance 2", 15.0, "CmdPrm.Flt[-57]"),
        /// How many touches wall 1 has.
        count1: i32 = field::count("count1", "First wall measure count", 2, "CmdPrm.Int[-63]"),
        /// How many touches wall 2 has.
        count2: i32 = field::count("count2", "Second wall measure count", 2, "CmdPrm.Int[-64]"),
        /// Between the touches of wall 1, along it, away from the corner.
        step1: f64 = field::distance("step1", "Step 1", 20.0).code("CmdPrm.Flt[-65]"),
        /// Between the touches of wall 2, along it, away from the corner.
        step2: f64 = field::distance("step2", "Step 2", 20.0).code("CmdPrm.Flt[-67]"),
        feed_distance: f64 = field::feed_distance(),
        sub_code: i32 = field::sub_code(),
    }
}

impl DoubleWallInternalCorner {
    pub fn dimensions(&self) -> Dimensions {
        let shape = Shape::Corner(Corner {
            internal: true,
            angle: CornerAngle::of(self.angle),
            clearances: [self.clearance1, self.clearance2],
            counts: [self.count1.max(1) as usize, self.count2.max(1) as usize],
            steps: [self.step1, self.step2],
            distances: None,
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}

form! {
    /// The form of type 14.
    pub struct DoubleWallExternalCorner {
        /// The corner, at the level of the touches.
        origin: Vec3 = field::origin("Corner at touch level"),
        /// How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive.
        rotation: f64 = field::rotation(),
        /// Between the walls, in the material.
        angle: f64 = field::angle(),
        /// From wall 1 to the ball centre where its touches begin.
        clearance1: f64 = field::clearance("clearance1", "Clearance 1", 15.0, "CmdPrm.Flt[-56]"),
        /// From wall 2 to the ball centre where its touches begin.
        clearance2: f64 = field::clearance("clearance2", "Clearance 2", 15.0, "CmdPrm.Flt[-57]"),
        /// From the corner along wall 1 to its first touch.
        distance1: f64 = field::distance("distance1", "Distance 1", 15.0),
        /// From the corner along wall 2 to its first touch.
        distance2: f64 = field::distance("distance2", "Distance 2", 15.0),
        /// How many touches wall 1 has.
        count1: i32 = field::count("count1", "First wall measure count", 2, "CmdPrm.Int[-63]"),
        /// How many touches wall 2 has.
        count2: i32 = field::count("count2", "Second wall measure count", 2, "CmdPrm.Int[-64]"),
        /// Between the touches of wall 1, along it, away from the corner.
        step1: f64 = field::distance("step1", "Step 1", 20.0).code("CmdPrm.Flt[-65]"),
        /// Between the touches of wall 2, along it, away from the corner.
        step2: f64 = field::distance("step2", "Step 2", 20.0).code("CmdPrm.Flt[-67]"),
        feed_distance: f64 = field::feed_distance(),
        compensate_dimensions: bool = field::compensate(),
        sub_code: i32 = field::sub_code(),
    }
}

impl DoubleWallExternalCorner {
    pub fn dimensions(&self) -> Dimensions {
        let shape = Shape::Corner(Corner {
            internal: false,
            angle: CornerAngle::of(self.angle),
            clearances: [self.clearance1, self.clearance2],
            counts: [self.count1.max(1) as usize, self.count2.max(1) as usize],
            steps: [self.step1, self.step2],
            distances: Some([self.distance1, self.distance2]),
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}

form! {
    /// The form of type 15.
    pub struct TripleWallInternalCorner {
        /// The corner, where the walls meet the floor.
        origin: Vec3 = field::origin("Corner on the floor"),
        /// How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive.
        rotation: f64 = field::rotation(),
        /// Between the walls, inside the corner.
        angle: f64 = field::angle(),
        /// From wall 1 to the ball centre where its touch begins.
        clearance1: f64 = field::clearance("clearance1", "Clearance 1", 15.0, "CmdPrm.Flt[-56]"),
        /// From wall 2 to the ball centre where its touch begins.
        clearance2: f64 = field::clearance("clearance2", "Clearance 2", 15.0, "CmdPrm.Flt[-57]"),
        /// From the floor to the ball centre where its touch begins.
        clearance3: f64 = field::clearance("clearance3", "Clearance 3", 15.0, "CmdPrm.Flt[-58]"),
        feed_distance: f64 = field::feed_distance(),
        sub_code: i32 = field::sub_code(),
    }
}

impl TripleWallInternalCorner {
    pub fn dimensions(&self) -> Dimensions {
        let shape = Shape::Triple(Triple {
            angle: CornerAngle::of(self.angle),
            clearances: [self.clearance1, self.clearance2, self.clearance3],
            outside: None,
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}

form! {
    /// The form of type 16.
    pub struct TripleWallExternalCorner {
        /// The corner, on the top side.
        origin: Vec3 = field::origin("Corner on the top side"),
        /// How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive.
        rotation: f64 = field::rotation(),
        /// Between the walls, in the material.
        angle: f64 = field::angle(),
        /// From the top side down to the ball centre at the touches of the walls.
        depth: f64 = field::depth(),
        /// From wall 1 to the ball centre where its touch begins.
        clearance1: f64 = field::clearance("clearance1", "Clearance 1", 15.0, "CmdPrm.Flt[-56]"),
        /// From wall 2 to the ball centre where its touch begins.
        clearance2: f64 = field::clearance("clearance2", "Clearance 2", 15.0, "CmdPrm.Flt[-57]"),
        /// From the top side to the ball centre where its touch begins, and where the ball crosses.
        top_clearance: f64 = field::clearance("topClearance", "Top clearance", 10.0, "CmdPrm.Flt[-58]").seen(BestView::Height),
        /// From the corner along wall 1 to its touch.
        distance1: f64 = field::distance("distance1", "Distance 1", 15.0),
        /// From the corner along wall 2 to its touch.
        distance2: f64 = field::distance("distance2", "Distance 2", 15.0),
        /// From wall 1 inwards to the touch on the top side.
        top_distance1: f64 = field::distance("topDistance1", "Top distance 1", 15.0),
        /// From wall 2 inwards to the touch on the top side.
        top_distance2: f64 = field::distance("topDistance2", "Top distance 2", 15.0),
        feed_distance: f64 = field::feed_distance(),
        sub_code: i32 = field::sub_code(),
    }
}

impl TripleWallExternalCorner {
    pub fn dimensions(&self) -> Dimensions {
        let outside = Outside {
            depth: self.depth,
            distances: [self.distance1, self.distance2],
            inwards: [self.top_distance1, self.top_distance2],
        };
        let shape = Shape::Triple(Triple {
            angle: CornerAngle::of(self.angle),
            clearances: [self.clearance1, self.clearance2, self.top_clearance],
            outside: Some(outside),
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}

form! {
    /// The form of the angle of a wall.
    pub struct WallAngle {
        /// The middle between the touches, on the wall, at their height.
        origin: Vec3 = field::origin("Middle of the wall"),
        /// Where the target vector points in the plane, out of the wall; counter-clockwise positive.
        rotation: f64 = field::rotation(),
        /// From the first touch to the second, along the wall. The longer, the smaller ± is.
        distance: f64 = Field::length("distance", "Distance of the touches", 60.0).range(0.1, 10_000.0).usual(5.0, 2000.0).group("Touches"),
        /// From the wall to the ball centre where a touch begins.
        clearance: f64 = field::clearance("clearance", "Clearance", 10.0, ""),
        /// How far above its start the cycle begins, and how far it is lifted at its end.
        feed_distance: f64 = Field::length("feedDistance", "Feed distance", 20.0).range(0.0, 1000.0).usual(1.0, 500.0).group("Clearances"),
    }
}

impl WallAngle {
    pub fn dimensions(&self) -> Dimensions {
        let shape = Shape::Wall(TwoTouches {
            distance: self.distance,
            clearance: self.clearance,
        });
        Dimensions::of(
            self,
            (self.origin, self.rotation),
            self.feed_distance,
            shape,
        )
    }
}
