// Generated from the crate's one list of fields: `UPDATE=1 cargo test --lib generated` writes it.

use std::collections::BTreeMap;

use super::{CustomCode, FrameStep, Given, Nominal, PickedTouch, map, of};
use crate::form::Value;

/// What cycles have as `properties`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Properties {
    /// 0 global, 1 one work offset, 2 parametrical (G10), 3 local (G52). `Some(None)`: not set.
    pub wcs_mode: Option<Option<i32>>,
    /// Number of the coordinate system, in modes 1 and 2. `Some(None)`: not set.
    pub wcs_number: Option<Option<i32>>,
    /// Whose offset is set. `Some(None)`: not set.
    pub offset_tool: Option<Option<i32>>,
    /// Its first corrector. `Some(None)`: not set.
    pub offset_corrector1: Option<Option<i32>>,
    /// Its second corrector. `Some(None)`: not set.
    pub offset_corrector2: Option<Option<i32>>,
    /// Which tool is checked. `Some(None)`: not set.
    pub broken_tool: Option<Option<i32>>,
    /// Its first corrector. `Some(None)`: not set.
    pub broken_corrector1: Option<Option<i32>>,
    /// Its second corrector. `Some(None)`: not set.
    pub broken_corrector2: Option<Option<i32>>,
    /// Number of the tool probe. `Some(None)`: not set.
    pub tool_probe: Option<Option<i32>>,
    /// Its first corrector. `Some(None)`: not set.
    pub tool_probe_corrector1: Option<Option<i32>>,
    /// Its second corrector. `Some(None)`: not set.
    pub tool_probe_corrector2: Option<Option<i32>>,
    /// Number of the part probe. `Some(None)`: not set.
    pub part_probe: Option<Option<i32>>,
    /// Its first corrector. `Some(None)`: not set.
    pub part_probe_corrector1: Option<Option<i32>>,
    /// Its second corrector. `Some(None)`: not set.
    pub part_probe_corrector2: Option<Option<i32>>,
    /// The component it is reported under. `Some(None)`: not set.
    pub report_component: Option<Option<i32>>,
    /// The feature it is reported under. `Some(None)`: not set.
    pub report_feature: Option<Option<i32>>,
}

impl Given for Properties {
    fn given(&self) -> Value { map([("wcsMode", of(&self.wcs_mode)), ("wcsNumber", of(&self.wcs_number)), ("offsetTool", of(&self.offset_tool)), ("offsetCorrector1", of(&self.offset_corrector1)), ("offsetCorrector2", of(&self.offset_corrector2)), ("brokenTool", of(&self.broken_tool)), ("brokenCorrector1", of(&self.broken_corrector1)), ("brokenCorrector2", of(&self.broken_corrector2)), ("toolProbe", of(&self.tool_probe)), ("toolProbeCorrector1", of(&self.tool_probe_corrector1)), ("toolProbeCorrector2", of(&self.tool_probe_corrector2)), ("partProbe", of(&self.part_probe)), ("partProbeCorrector1", of(&self.part_probe_corrector1)), ("partProbeCorrector2", of(&self.part_probe_corrector2)), ("reportComponent", of(&self.report_component)), ("reportFeature", of(&self.report_feature))]) }
}

/// What cycles have as `repeat`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Repeat {
    /// How often each point is touched. The mean of these touches counts.
    pub times: Option<i32>,
    /// Largest distance between touches of the same point. Beyond it the program writes nothing and stops; a program that only measures says so. Empty: no limit. `Some(None)`: no limit.
    pub spread: Option<Option<f64>>,
}

impl Given for Repeat {
    fn given(&self) -> Value { map([("times", of(&self.times)), ("spread", of(&self.spread))]) }
}

/// Internal rectangle, protected: ENCY/SprutCAM type 7.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InternalRectangleProtected {
    /// Centre of the feature, on its top side.
    pub origin: Option<[f64; 3]>,
    /// How the feature is turned about the tool axis; counter-clockwise positive.
    pub rotation: Option<f64>,
    /// From touch point 1 to touch point 2, along the first direction of the rectangle.
    pub width1: Option<f64>,
    /// From touch point 3 to touch point 4, along the second direction.
    pub width2: Option<f64>,
    /// From the top side down to the ball centre at the touches.
    pub depth: Option<f64>,
    /// How far above the top side the ball centre crosses from touch to touch.
    pub top_clearance: Option<f64>,
    /// From the wall to the ball centre where touches 1 and 2 begin.
    pub side_clearance1: Option<f64>,
    /// From the wall to the ball centre where touches 3 and 4 begin.
    pub side_clearance2: Option<f64>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same.
    pub compensate_dimensions: Option<bool>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for InternalRectangleProtected {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("width1", of(&self.width1)), ("width2", of(&self.width2)), ("depth", of(&self.depth)), ("topClearance", of(&self.top_clearance)), ("sideClearance1", of(&self.side_clearance1)), ("sideClearance2", of(&self.side_clearance2)), ("feedDistance", of(&self.feed_distance)), ("compensateDimensions", of(&self.compensate_dimensions)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Double wall internal corner: ENCY/SprutCAM type 13.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DoubleWallInternalCorner {
    /// The corner, at the level of the touches.
    pub origin: Option<[f64; 3]>,
    /// How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive.
    pub rotation: Option<f64>,
    /// Between the walls, inside the corner.
    pub angle: Option<f64>,
    /// From wall 1 to the ball centre where its touches begin.
    pub clearance1: Option<f64>,
    /// From wall 2 to the ball centre where its touches begin.
    pub clearance2: Option<f64>,
    /// How many touches wall 1 has.
    pub count1: Option<i32>,
    /// How many touches wall 2 has.
    pub count2: Option<i32>,
    /// Between the touches of wall 1, along it, away from the corner.
    pub step1: Option<f64>,
    /// Between the touches of wall 2, along it, away from the corner.
    pub step2: Option<f64>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for DoubleWallInternalCorner {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("angle", of(&self.angle)), ("clearance1", of(&self.clearance1)), ("clearance2", of(&self.clearance2)), ("count1", of(&self.count1)), ("count2", of(&self.count2)), ("step1", of(&self.step1)), ("step2", of(&self.step2)), ("feedDistance", of(&self.feed_distance)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// What cycles have as `probe`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Probe {
    /// SET_UP of the touch probe table: added to the set-up clearance.
    pub set_up: Option<f64>,
    /// DIST of the touch probe table: the maximum travel of a touch.
    pub dist: Option<f64>,
    /// F of the touch probe table: the probing feed.
    pub feed: Option<f64>,
    /// FMAX of the touch probe table: the rapid for positioning. `Some(None)`: control's own.
    pub rapid: Option<Option<f64>>,
}

impl Given for Probe {
    fn given(&self) -> Value { map([("setUp", of(&self.set_up)), ("dist", of(&self.dist)), ("feed", of(&self.feed)), ("rapid", of(&self.rapid))]) }
}

/// What cycles have as `extrusion`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extrusion {
    /// Extrusion direction? Along which the touches are repeated.
    pub direction: Option<i32>,
    /// Number of extrusion points? Touches for each touch of 1411.
    pub points: Option<i32>,
    /// Length of extrusion? From the first to the last of them.
    pub length: Option<f64>,
    /// Extrusion probing: modal?
    pub modal: Option<i32>,
}

impl Given for Extrusion {
    fn given(&self) -> Value { map([("direction", of(&self.direction)), ("points", of(&self.points)), ("length", of(&self.length)), ("modal", of(&self.modal))]) }
}

/// Probing two circles: HEIDENHAIN cycle 1411.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ProbingTwoCircles {
    /// 1st noml. position of ref. axis? … of minor axis? … in tool axis? A number, or text with a tolerance, ? or @.
    pub point1: Option<[Nominal; 3]>,
    /// Diameter of 1st position? A number, or text with a tolerance.
    pub diameter1: Option<Nominal>,
    /// 2nd noml. position of ref. axis? … of minor axis? … in tool axis? As for the first point.
    pub point2: Option<[Nominal; 3]>,
    /// Diameter of 2nd position? A number, or text with a tolerance.
    pub diameter2: Option<Nominal>,
    /// Geometry type (0-3)? What is at each position.
    pub geometry_type: Option<i32>,
    /// Number of probe points? On each circle.
    pub probe_points: Option<i32>,
    /// Starting angle? From the main axis to the first touch.
    pub starting_angle: Option<f64>,
    /// Arc angular length? Over which the touches are spread; negative is clockwise.
    pub angular_length: Option<f64>,
    /// Set-up clearance? Added to SET_UP and the ball radius.
    pub set_up_clearance: Option<f64>,
    /// Clearance height? A height free of obstacles.
    pub clearance_height: Option<f64>,
    /// Q320=PREDEF: the control takes the set-up clearance from GLOBAL DEF. The number above is then only what the moves show.
    pub set_up_clearance_predef: Option<bool>,
    /// Q260=PREDEF: the control takes the clearance height from GLOBAL DEF. The number above is then only what the moves show.
    pub clearance_height_predef: Option<bool>,
    /// Traverse to clearance height? When the ball goes there.
    pub clearance_height_mode: Option<i32>,
    /// Reaction to tolerance error?
    pub error_reaction: Option<i32>,
    /// Align rotary axis? Only together with confirm rotation.
    pub align_rotary_axis: Option<i32>,
    /// Transfer position? Which point corrects the active preset.
    pub transfer_position: Option<i32>,
    /// Confirm rotation? What becomes of the measured misalignment.
    pub confirm_rotation: Option<i32>,
    /// Where the stylus is before the cycle.
    pub start: Option<[f64; 3]>,
    /// Left out: the defaults.
    pub probe: Option<Probe>,
    /// `Some(None)`: none.
    pub extrusion: Option<Option<Extrusion>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
}

impl Given for ProbingTwoCircles {
    fn given(&self) -> Value { map([("point1", of(&self.point1)), ("diameter1", of(&self.diameter1)), ("point2", of(&self.point2)), ("diameter2", of(&self.diameter2)), ("geometryType", of(&self.geometry_type)), ("probePoints", of(&self.probe_points)), ("startingAngle", of(&self.starting_angle)), ("angularLength", of(&self.angular_length)), ("setUpClearance", of(&self.set_up_clearance)), ("clearanceHeight", of(&self.clearance_height)), ("setUpClearancePredef", of(&self.set_up_clearance_predef)), ("clearanceHeightPredef", of(&self.clearance_height_predef)), ("clearanceHeightMode", of(&self.clearance_height_mode)), ("errorReaction", of(&self.error_reaction)), ("alignRotaryAxis", of(&self.align_rotary_axis)), ("transferPosition", of(&self.transfer_position)), ("confirmRotation", of(&self.confirm_rotation)), ("start", of(&self.start)), ("probe", of(&self.probe)), ("extrusion", of(&self.extrusion)), ("repeat", of(&self.repeat))]) }
}

/// Surface: ENCY/SprutCAM type 2.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// The touch point, on the surface.
    pub origin: Option<[f64; 3]>,
    /// Where the target vector points in the plane; counter-clockwise positive.
    pub rotation: Option<f64>,
    /// How steeply the target vector points up from the plane: 90 is a top side, 0 a wall.
    pub elevation: Option<f64>,
    /// From the surface to the ball centre where the touch begins.
    pub clearance: Option<f64>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same.
    pub compensate_dimensions: Option<bool>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for Surface {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("elevation", of(&self.elevation)), ("clearance", of(&self.clearance)), ("feedDistance", of(&self.feed_distance)), ("compensateDimensions", of(&self.compensate_dimensions)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Angle of a wall: Touchpath.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WallAngle {
    /// The middle between the touches, on the wall, at their height.
    pub origin: Option<[f64; 3]>,
    /// Where the target vector points in the plane, out of the wall; counter-clockwise positive.
    pub rotation: Option<f64>,
    /// From the first touch to the second, along the wall. The longer, the smaller ± is.
    pub distance: Option<f64>,
    /// From the wall to the ball centre where a touch begins.
    pub clearance: Option<f64>,
    /// How far above its start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
}

impl Given for WallAngle {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("distance", of(&self.distance)), ("clearance", of(&self.clearance)), ("feedDistance", of(&self.feed_distance)), ("repeat", of(&self.repeat))]) }
}

/// Hole: ENCY/SprutCAM type 3.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hole {
    /// Centre of the feature, on its top side.
    pub origin: Option<[f64; 3]>,
    /// How the feature is turned about the tool axis; counter-clockwise positive.
    pub rotation: Option<f64>,
    /// Diameter of the feature.
    pub diameter: Option<f64>,
    /// From the top side down to the ball centre at the touches.
    pub depth: Option<f64>,
    /// Rectangular: four touches, each pair opposite. Angular: from the start angle on, step by step.
    pub variant: Option<i32>,
    /// Angular variant: where the first touch is, counter-clockwise from the first direction.
    pub start_angle: Option<f64>,
    /// Angular variant: from one touch to the next, counter-clockwise positive.
    pub angular_step: Option<f64>,
    /// Angular variant: how many touches.
    pub step_count: Option<i32>,
    /// How far above the top side the ball centre is before it goes in. Not checked: it goes straight to the depth. `Some(None)`: not checked.
    pub top_clearance: Option<Option<f64>>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for Hole {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("diameter", of(&self.diameter)), ("depth", of(&self.depth)), ("variant", of(&self.variant)), ("startAngle", of(&self.start_angle)), ("angularStep", of(&self.angular_step)), ("stepCount", of(&self.step_count)), ("topClearance", of(&self.top_clearance)), ("feedDistance", of(&self.feed_distance)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Hole, protected: ENCY/SprutCAM type 4.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HoleProtected {
    /// Centre of the feature, on its top side.
    pub origin: Option<[f64; 3]>,
    /// How the feature is turned about the tool axis; counter-clockwise positive.
    pub rotation: Option<f64>,
    /// Diameter of the feature.
    pub diameter: Option<f64>,
    /// From the top side down to the ball centre at the touches.
    pub depth: Option<f64>,
    /// Rectangular: four touches, each pair opposite. Angular: from the start angle on, step by step.
    pub variant: Option<i32>,
    /// Angular variant: where the first touch is, counter-clockwise from the first direction.
    pub start_angle: Option<f64>,
    /// Angular variant: from one touch to the next, counter-clockwise positive.
    pub angular_step: Option<f64>,
    /// Angular variant: how many touches.
    pub step_count: Option<i32>,
    /// How far above the top side the ball centre crosses from touch to touch.
    pub top_clearance: Option<f64>,
    /// From the wall to the ball centre where touches begin.
    pub side_clearance: Option<f64>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same.
    pub compensate_dimensions: Option<bool>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for HoleProtected {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("diameter", of(&self.diameter)), ("depth", of(&self.depth)), ("variant", of(&self.variant)), ("startAngle", of(&self.start_angle)), ("angularStep", of(&self.angular_step)), ("stepCount", of(&self.step_count)), ("topClearance", of(&self.top_clearance)), ("sideClearance", of(&self.side_clearance)), ("feedDistance", of(&self.feed_distance)), ("compensateDimensions", of(&self.compensate_dimensions)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Boss: ENCY/SprutCAM type 5.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Boss {
    /// Centre of the feature, on its top side.
    pub origin: Option<[f64; 3]>,
    /// How the feature is turned about the tool axis; counter-clockwise positive.
    pub rotation: Option<f64>,
    /// Diameter of the feature.
    pub diameter: Option<f64>,
    /// From the top side down to the ball centre at the touches.
    pub depth: Option<f64>,
    /// Rectangular: four touches, each pair opposite. Angular: from the start angle on, step by step.
    pub variant: Option<i32>,
    /// Angular variant: where the first touch is, counter-clockwise from the first direction.
    pub start_angle: Option<f64>,
    /// Angular variant: from one touch to the next, counter-clockwise positive.
    pub angular_step: Option<f64>,
    /// Angular variant: how many touches.
    pub step_count: Option<i32>,
    /// How far above the top side the ball centre crosses from touch to touch.
    pub top_clearance: Option<f64>,
    /// From the wall to the ball centre where touches begin.
    pub side_clearance: Option<f64>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same.
    pub compensate_dimensions: Option<bool>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for Boss {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("diameter", of(&self.diameter)), ("depth", of(&self.depth)), ("variant", of(&self.variant)), ("startAngle", of(&self.start_angle)), ("angularStep", of(&self.angular_step)), ("stepCount", of(&self.step_count)), ("topClearance", of(&self.top_clearance)), ("sideClearance", of(&self.side_clearance)), ("feedDistance", of(&self.feed_distance)), ("compensateDimensions", of(&self.compensate_dimensions)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Internal rectangle: ENCY/SprutCAM type 6.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InternalRectangle {
    /// Centre of the feature, on its top side.
    pub origin: Option<[f64; 3]>,
    /// How the feature is turned about the tool axis; counter-clockwise positive.
    pub rotation: Option<f64>,
    /// From touch point 1 to touch point 2, along the first direction of the rectangle.
    pub width1: Option<f64>,
    /// From touch point 3 to touch point 4, along the second direction.
    pub width2: Option<f64>,
    /// From the top side down to the ball centre at the touches.
    pub depth: Option<f64>,
    /// How far above the top side the ball centre is before it goes in. Not checked: it goes straight to the depth. `Some(None)`: not checked.
    pub top_clearance: Option<Option<f64>>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for InternalRectangle {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("width1", of(&self.width1)), ("width2", of(&self.width2)), ("depth", of(&self.depth)), ("topClearance", of(&self.top_clearance)), ("feedDistance", of(&self.feed_distance)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// External rectangle: ENCY/SprutCAM type 8.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExternalRectangle {
    /// Centre of the feature, on its top side.
    pub origin: Option<[f64; 3]>,
    /// How the feature is turned about the tool axis; counter-clockwise positive.
    pub rotation: Option<f64>,
    /// From touch point 1 to touch point 2, along the first direction of the rectangle.
    pub width1: Option<f64>,
    /// From touch point 3 to touch point 4, along the second direction.
    pub width2: Option<f64>,
    /// From the top side down to the ball centre at the touches.
    pub depth: Option<f64>,
    /// How far above the top side the ball centre crosses from touch to touch.
    pub top_clearance: Option<f64>,
    /// From the wall to the ball centre where touches 1 and 2 begin.
    pub side_clearance1: Option<f64>,
    /// From the wall to the ball centre where touches 3 and 4 begin.
    pub side_clearance2: Option<f64>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same.
    pub compensate_dimensions: Option<bool>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for ExternalRectangle {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("width1", of(&self.width1)), ("width2", of(&self.width2)), ("depth", of(&self.depth)), ("topClearance", of(&self.top_clearance)), ("sideClearance1", of(&self.side_clearance1)), ("sideClearance2", of(&self.side_clearance2)), ("feedDistance", of(&self.feed_distance)), ("compensateDimensions", of(&self.compensate_dimensions)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Web: ENCY/SprutCAM type 9.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Web {
    /// Centre of the feature, on its top side.
    pub origin: Option<[f64; 3]>,
    /// How the feature is turned about the tool axis; counter-clockwise positive.
    pub rotation: Option<f64>,
    /// From touch point 1 to touch point 2.
    pub width: Option<f64>,
    /// From the top side down to the ball centre at the touches.
    pub depth: Option<f64>,
    /// How far above the top side the ball centre crosses from touch to touch.
    pub top_clearance: Option<f64>,
    /// From the wall to the ball centre where touches begin.
    pub side_clearance: Option<f64>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same.
    pub compensate_dimensions: Option<bool>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for Web {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("width", of(&self.width)), ("depth", of(&self.depth)), ("topClearance", of(&self.top_clearance)), ("sideClearance", of(&self.side_clearance)), ("feedDistance", of(&self.feed_distance)), ("compensateDimensions", of(&self.compensate_dimensions)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Web, three points: ENCY/SprutCAM type 10.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WebThreePoints {
    /// Centre of the feature, on its top side.
    pub origin: Option<[f64; 3]>,
    /// How the feature is turned about the tool axis; counter-clockwise positive.
    pub rotation: Option<f64>,
    /// From the left touch point to the right one.
    pub width: Option<f64>,
    /// From the top side down to the ball centre at the left and the right touch.
    pub depth: Option<f64>,
    /// From the wall to the ball centre where the left and the right touch begin.
    pub side_clearance: Option<f64>,
    /// From the top side to the ball centre where the middle touch begins, and where the ball crosses.
    pub middle_clearance: Option<f64>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same.
    pub compensate_dimensions: Option<bool>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for WebThreePoints {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("width", of(&self.width)), ("depth", of(&self.depth)), ("sideClearance", of(&self.side_clearance)), ("middleClearance", of(&self.middle_clearance)), ("feedDistance", of(&self.feed_distance)), ("compensateDimensions", of(&self.compensate_dimensions)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Groove: ENCY/SprutCAM type 11.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Groove {
    /// Centre of the feature, on its top side.
    pub origin: Option<[f64; 3]>,
    /// How the feature is turned about the tool axis; counter-clockwise positive.
    pub rotation: Option<f64>,
    /// From touch point 1 to touch point 2.
    pub width: Option<f64>,
    /// From the top side down to the ball centre at the touches.
    pub depth: Option<f64>,
    /// How far above the top side the ball centre is before it goes in. Not checked: it goes straight to the depth. `Some(None)`: not checked.
    pub top_clearance: Option<Option<f64>>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for Groove {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("width", of(&self.width)), ("depth", of(&self.depth)), ("topClearance", of(&self.top_clearance)), ("feedDistance", of(&self.feed_distance)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Groove, protected: ENCY/SprutCAM type 12.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GrooveProtected {
    /// Centre of the feature, on its top side.
    pub origin: Option<[f64; 3]>,
    /// How the feature is turned about the tool axis; counter-clockwise positive.
    pub rotation: Option<f64>,
    /// From touch point 1 to touch point 2.
    pub width: Option<f64>,
    /// From the top side down to the ball centre at the touches.
    pub depth: Option<f64>,
    /// How far above the top side the ball centre crosses from touch to touch.
    pub top_clearance: Option<f64>,
    /// From the wall to the ball centre where touches begin.
    pub side_clearance: Option<f64>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same.
    pub compensate_dimensions: Option<bool>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for GrooveProtected {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("width", of(&self.width)), ("depth", of(&self.depth)), ("topClearance", of(&self.top_clearance)), ("sideClearance", of(&self.side_clearance)), ("feedDistance", of(&self.feed_distance)), ("compensateDimensions", of(&self.compensate_dimensions)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Double wall external corner: ENCY/SprutCAM type 14.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DoubleWallExternalCorner {
    /// The corner, at the level of the touches.
    pub origin: Option<[f64; 3]>,
    /// How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive.
    pub rotation: Option<f64>,
    /// Between the walls, in the material.
    pub angle: Option<f64>,
    /// From wall 1 to the ball centre where its touches begin.
    pub clearance1: Option<f64>,
    /// From wall 2 to the ball centre where its touches begin.
    pub clearance2: Option<f64>,
    /// From the corner along wall 1 to its first touch.
    pub distance1: Option<f64>,
    /// From the corner along wall 2 to its first touch.
    pub distance2: Option<f64>,
    /// How many touches wall 1 has.
    pub count1: Option<i32>,
    /// How many touches wall 2 has.
    pub count2: Option<i32>,
    /// Between the touches of wall 1, along it, away from the corner.
    pub step1: Option<f64>,
    /// Between the touches of wall 2, along it, away from the corner.
    pub step2: Option<f64>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same.
    pub compensate_dimensions: Option<bool>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for DoubleWallExternalCorner {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("angle", of(&self.angle)), ("clearance1", of(&self.clearance1)), ("clearance2", of(&self.clearance2)), ("distance1", of(&self.distance1)), ("distance2", of(&self.distance2)), ("count1", of(&self.count1)), ("count2", of(&self.count2)), ("step1", of(&self.step1)), ("step2", of(&self.step2)), ("feedDistance", of(&self.feed_distance)), ("compensateDimensions", of(&self.compensate_dimensions)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Triple wall internal corner: ENCY/SprutCAM type 15.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TripleWallInternalCorner {
    /// The corner, where the walls meet the floor.
    pub origin: Option<[f64; 3]>,
    /// How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive.
    pub rotation: Option<f64>,
    /// Between the walls, inside the corner.
    pub angle: Option<f64>,
    /// From wall 1 to the ball centre where its touch begins.
    pub clearance1: Option<f64>,
    /// From wall 2 to the ball centre where its touch begins.
    pub clearance2: Option<f64>,
    /// From the floor to the ball centre where its touch begins.
    pub clearance3: Option<f64>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for TripleWallInternalCorner {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("angle", of(&self.angle)), ("clearance1", of(&self.clearance1)), ("clearance2", of(&self.clearance2)), ("clearance3", of(&self.clearance3)), ("feedDistance", of(&self.feed_distance)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Triple wall external corner: ENCY/SprutCAM type 16.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TripleWallExternalCorner {
    /// The corner, on the top side.
    pub origin: Option<[f64; 3]>,
    /// How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive.
    pub rotation: Option<f64>,
    /// Between the walls, in the material.
    pub angle: Option<f64>,
    /// From the top side down to the ball centre at the touches of the walls.
    pub depth: Option<f64>,
    /// From wall 1 to the ball centre where its touch begins.
    pub clearance1: Option<f64>,
    /// From wall 2 to the ball centre where its touch begins.
    pub clearance2: Option<f64>,
    /// From the top side to the ball centre where its touch begins, and where the ball crosses.
    pub top_clearance: Option<f64>,
    /// From the corner along wall 1 to its touch.
    pub distance1: Option<f64>,
    /// From the corner along wall 2 to its touch.
    pub distance2: Option<f64>,
    /// From wall 1 inwards to the touch on the top side.
    pub top_distance1: Option<f64>,
    /// From wall 2 inwards to the touch on the top side.
    pub top_distance2: Option<f64>,
    /// How far above the start the cycle begins, and how far it is lifted at its end.
    pub feed_distance: Option<f64>,
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// `Some(None)`: none.
    pub repeat: Option<Option<Repeat>>,
    /// The Job Assignment's own picks: they replace the points that the dimensions give.
    pub touches: Option<Vec<PickedTouch>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for TripleWallExternalCorner {
    fn given(&self) -> Value { map([("origin", of(&self.origin)), ("rotation", of(&self.rotation)), ("angle", of(&self.angle)), ("depth", of(&self.depth)), ("clearance1", of(&self.clearance1)), ("clearance2", of(&self.clearance2)), ("topClearance", of(&self.top_clearance)), ("distance1", of(&self.distance1)), ("distance2", of(&self.distance2)), ("topDistance1", of(&self.top_distance1)), ("topDistance2", of(&self.top_distance2)), ("feedDistance", of(&self.feed_distance)), ("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("repeat", of(&self.repeat)), ("touches", of(&self.touches)), ("custom", of(&self.custom))]) }
}

/// Probe on/off: ENCY/SprutCAM type 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ProbeOnOff {
    /// Whether the probe is switched on or off.
    pub on: Option<bool>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for ProbeOnOff {
    fn given(&self) -> Value { map([("on", of(&self.on)), ("custom", of(&self.custom))]) }
}

/// NC action: ENCY/SprutCAM type 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NcAction {
    /// A free number for the postprocessor. -500 is that of Probe On/Off.
    pub sub_code: Option<i32>,
    /// `Some(None)`: none.
    pub properties: Option<Option<Properties>>,
    /// Codes of the user's own.
    pub custom: Option<Vec<CustomCode>>,
}

impl Given for NcAction {
    fn given(&self) -> Value { map([("subCode", of(&self.sub_code)), ("properties", of(&self.properties)), ("custom", of(&self.custom))]) }
}

/// A cycle with its dimensions.
#[derive(Clone, Debug, PartialEq)]
pub enum Cycle {
    /// Internal rectangle, protected.
    InternalRectangleProtected(InternalRectangleProtected),
    /// Double wall internal corner.
    DoubleWallInternalCorner(DoubleWallInternalCorner),
    /// Probing two circles.
    ProbingTwoCircles(ProbingTwoCircles),
    /// Surface.
    Surface(Surface),
    /// Angle of a wall.
    WallAngle(WallAngle),
    /// Hole.
    Hole(Hole),
    /// Hole, protected.
    HoleProtected(HoleProtected),
    /// Boss.
    Boss(Boss),
    /// Internal rectangle.
    InternalRectangle(InternalRectangle),
    /// External rectangle.
    ExternalRectangle(ExternalRectangle),
    /// Web.
    Web(Web),
    /// Web, three points.
    WebThreePoints(WebThreePoints),
    /// Groove.
    Groove(Groove),
    /// Groove, protected.
    GrooveProtected(GrooveProtected),
    /// Double wall external corner.
    DoubleWallExternalCorner(DoubleWallExternalCorner),
    /// Triple wall internal corner.
    TripleWallInternalCorner(TripleWallInternalCorner),
    /// Triple wall external corner.
    TripleWallExternalCorner(TripleWallExternalCorner),
    /// Probe on/off.
    ProbeOnOff(ProbeOnOff),
    /// NC action.
    NcAction(NcAction),
}

impl Given for Cycle {
    fn given(&self) -> Value {
        let (key, mut value) = match self {
            Cycle::InternalRectangleProtected(cycle) => ("internal-rectangle-protected", cycle.given()),
            Cycle::DoubleWallInternalCorner(cycle) => ("double-wall-internal-corner", cycle.given()),
            Cycle::ProbingTwoCircles(cycle) => ("probing-two-circles", cycle.given()),
            Cycle::Surface(cycle) => ("surface", cycle.given()),
            Cycle::WallAngle(cycle) => ("wall-angle", cycle.given()),
            Cycle::Hole(cycle) => ("hole", cycle.given()),
            Cycle::HoleProtected(cycle) => ("hole-protected", cycle.given()),
            Cycle::Boss(cycle) => ("boss", cycle.given()),
            Cycle::InternalRectangle(cycle) => ("internal-rectangle", cycle.given()),
            Cycle::ExternalRectangle(cycle) => ("external-rectangle", cycle.given()),
            Cycle::Web(cycle) => ("web", cycle.given()),
            Cycle::WebThreePoints(cycle) => ("web-three-points", cycle.given()),
            Cycle::Groove(cycle) => ("groove", cycle.given()),
            Cycle::GrooveProtected(cycle) => ("groove-protected", cycle.given()),
            Cycle::DoubleWallExternalCorner(cycle) => ("double-wall-external-corner", cycle.given()),
            Cycle::TripleWallInternalCorner(cycle) => ("triple-wall-internal-corner", cycle.given()),
            Cycle::TripleWallExternalCorner(cycle) => ("triple-wall-external-corner", cycle.given()),
            Cycle::ProbeOnOff(cycle) => ("probe-on-off", cycle.given()),
            Cycle::NcAction(cycle) => ("nc-action", cycle.given()),
        };
        if let Value::Map(entries) = &mut value {
            entries.insert(0, ("type".to_owned(), Value::Text(key.to_owned())));
        }
        value
    }
}

impl From<InternalRectangleProtected> for Cycle {
    fn from(cycle: InternalRectangleProtected) -> Cycle { Cycle::InternalRectangleProtected(cycle) }
}

impl From<DoubleWallInternalCorner> for Cycle {
    fn from(cycle: DoubleWallInternalCorner) -> Cycle { Cycle::DoubleWallInternalCorner(cycle) }
}

impl From<ProbingTwoCircles> for Cycle {
    fn from(cycle: ProbingTwoCircles) -> Cycle { Cycle::ProbingTwoCircles(cycle) }
}

impl From<Surface> for Cycle {
    fn from(cycle: Surface) -> Cycle { Cycle::Surface(cycle) }
}

impl From<WallAngle> for Cycle {
    fn from(cycle: WallAngle) -> Cycle { Cycle::WallAngle(cycle) }
}

impl From<Hole> for Cycle {
    fn from(cycle: Hole) -> Cycle { Cycle::Hole(cycle) }
}

impl From<HoleProtected> for Cycle {
    fn from(cycle: HoleProtected) -> Cycle { Cycle::HoleProtected(cycle) }
}

impl From<Boss> for Cycle {
    fn from(cycle: Boss) -> Cycle { Cycle::Boss(cycle) }
}

impl From<InternalRectangle> for Cycle {
    fn from(cycle: InternalRectangle) -> Cycle { Cycle::InternalRectangle(cycle) }
}

impl From<ExternalRectangle> for Cycle {
    fn from(cycle: ExternalRectangle) -> Cycle { Cycle::ExternalRectangle(cycle) }
}

impl From<Web> for Cycle {
    fn from(cycle: Web) -> Cycle { Cycle::Web(cycle) }
}

impl From<WebThreePoints> for Cycle {
    fn from(cycle: WebThreePoints) -> Cycle { Cycle::WebThreePoints(cycle) }
}

impl From<Groove> for Cycle {
    fn from(cycle: Groove) -> Cycle { Cycle::Groove(cycle) }
}

impl From<GrooveProtected> for Cycle {
    fn from(cycle: GrooveProtected) -> Cycle { Cycle::GrooveProtected(cycle) }
}

impl From<DoubleWallExternalCorner> for Cycle {
    fn from(cycle: DoubleWallExternalCorner) -> Cycle { Cycle::DoubleWallExternalCorner(cycle) }
}

impl From<TripleWallInternalCorner> for Cycle {
    fn from(cycle: TripleWallInternalCorner) -> Cycle { Cycle::TripleWallInternalCorner(cycle) }
}

impl From<TripleWallExternalCorner> for Cycle {
    fn from(cycle: TripleWallExternalCorner) -> Cycle { Cycle::TripleWallExternalCorner(cycle) }
}

impl From<ProbeOnOff> for Cycle {
    fn from(cycle: ProbeOnOff) -> Cycle { Cycle::ProbeOnOff(cycle) }
}

impl From<NcAction> for Cycle {
    fn from(cycle: NcAction) -> Cycle { Cycle::NcAction(cycle) }
}

impl Default for Cycle {
    fn default() -> Cycle {
        Cycle::InternalRectangleProtected(InternalRectangleProtected::default())
    }
}

/// The section `stylus` of a job.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stylus {
    /// Effective diameter of the ball; 0 is a point.
    pub diameter: Option<f64>,
    /// One sigma of a single touch along its probing direction.
    pub repeatability: Option<f64>,
    /// From the ball centre up to the probe body. Empty: not known, and the probe body is not checked. `Some(None)`: not known.
    pub length: Option<Option<f64>>,
    /// Diameter of the stylus above the ball. Empty: not known. `Some(None)`: not known.
    pub shank: Option<Option<f64>>,
    /// Diameter of the probe body above the stylus. Empty: not known. `Some(None)`: not known.
    pub body: Option<Option<f64>>,
    /// Half of what a dial at the ball shows in a turn. Adds to the uncertainty of results unless the spindle is oriented. Empty: not known. `Some(None)`: not known.
    pub runout: Option<Option<f64>>,
}

impl Given for Stylus {
    fn given(&self) -> Value { map([("diameter", of(&self.diameter)), ("repeatability", of(&self.repeatability)), ("length", of(&self.length)), ("shank", of(&self.shank)), ("body", of(&self.body)), ("runout", of(&self.runout))]) }
}

/// The section `feeds` of a job.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Feeds {
    /// From the feed distance to the start of the cycle. `Some(None)`: rapid.
    pub approach: Option<Option<f64>>,
    /// Every positioning move inside the cycle. `Some(None)`: rapid.
    pub long_link: Option<Option<f64>>,
    /// The touches. Never rapid.
    pub work: Option<f64>,
    /// Back from a surface touch; only cycles with such a step use it. `Some(None)`: rapid.
    pub retract: Option<Option<f64>>,
    /// The last lift. `Some(None)`: rapid.
    pub return_: Option<Option<f64>>,
}

impl Given for Feeds {
    fn given(&self) -> Value { map([("approach", of(&self.approach)), ("longLink", of(&self.long_link)), ("work", of(&self.work)), ("retract", of(&self.retract)), ("return", of(&self.return_))]) }
}

/// The section `limits` of a job.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Limits {
    /// Largest distance of a measured position from its nominal one, along each axis. Empty: the part may lie anywhere within the search. `Some(None)`: no limit.
    pub position: Option<Option<f64>>,
    /// Largest deviation of a measured width, diameter or length. `Some(None)`: no limit.
    pub size: Option<Option<f64>>,
    /// Largest deviation of a measured angle or direction. `Some(None)`: no limit.
    pub angle: Option<Option<f64>>,
    /// Largest root mean square distance of the touches from the circle or wall that is fitted through them, where there are touches to spare. `Some(None)`: no limit.
    pub residual: Option<Option<f64>>,
}

impl Given for Limits {
    fn given(&self) -> Value { map([("position", of(&self.position)), ("size", of(&self.size)), ("angle", of(&self.angle)), ("residual", of(&self.residual))]) }
}

/// The section `machine` of a job.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Machine {
    /// How fast an axis slows down after the probe triggers. Hobby machines have 200 to 1000 mm/s², machining centres more.
    pub acceleration: Option<f64>,
    /// From the contact until the axes begin to slow down: probe, receiver and control.
    pub latency: Option<f64>,
    /// Travel that the stylus takes past contact without damage: 3 to 12 mm sideways, by the probe's data sheet.
    pub deflection: Option<f64>,
}

impl Given for Machine {
    fn given(&self) -> Value { map([("acceleration", of(&self.acceleration)), ("latency", of(&self.latency)), ("deflection", of(&self.deflection))]) }
}

/// The section `control` of a job.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Control {
    /// Which control the program is for.
    pub post: Option<Post>,
    /// Plain moves: every move written out, on the job's path. The control's own cycle: a few calls, on the cycle's own path, which is shown.
    pub form: Option<Form>,
    /// The work offset that the program writes at its end: 1 is G54. Empty: measure only. `Some(None)`: measure only.
    pub work_offset: Option<Option<i32>>,
    /// Whether positioning moves are watched by the probe, where the control can: a contact then stops the program.
    pub protection: Option<Protection>,
    /// A dry run makes the same moves without a part: a touch ends at its nominal contact, a contact anywhere stops it, and nothing is written.
    pub run: Option<Run>,
    /// How much higher along the tool axis the whole path of a dry run lies: above the part it can be run with the part in the machine.
    pub lift: Option<f64>,
    /// How much the comments at the top say: with the whole job the program can be opened here again.
    pub header: Option<Header>,
    /// Tool number of the probe, for controls whose programs call it: a call changes the tool. Empty: no call. `Some(None)`: in the spindle, not called.
    pub tool: Option<Option<i32>>,
    /// Angle that the spindle is turned to before the first move: the one at which the probe was calibrated. Empty: the program does not turn it. `Some(None)`: not oriented.
    pub orient: Option<Option<f64>>,
    /// Probe input of the control: the one that the probe in the spindle is connected to.
    pub probe_input: Option<i32>,
    /// Where the program shows its results before it ends.
    pub report: Option<Report>,
    /// SET_UP of the touch probe table: the control's own cycles add it to their set-up clearance.
    pub set_up: Option<f64>,
    /// Number of the program, on controls whose programs have one. Empty: the four digits that the program name ends in (O2201, BORE2201; not a size such as D1200), else 1000. `Some(None)`: from the name.
    pub number: Option<Option<i32>>,
}

impl Given for Control {
    fn given(&self) -> Value { map([("post", of(&self.post)), ("form", of(&self.form)), ("workOffset", of(&self.work_offset)), ("protection", of(&self.protection)), ("run", of(&self.run)), ("lift", of(&self.lift)), ("header", of(&self.header)), ("tool", of(&self.tool)), ("orient", of(&self.orient)), ("probeInput", of(&self.probe_input)), ("report", of(&self.report)), ("setUp", of(&self.set_up)), ("number", of(&self.number))]) }
}

/// The section `tool` of a job.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tool {
    /// The tool type's number: 710 is a 3D probe; 400 to 599 are turning and grinding tools.
    pub type_: Option<i32>,
    /// SD42900 $SC_MIRROR_TOOL_LENGTH: a mirrored axis changes the sign of the length.
    pub sd42900: Option<bool>,
    /// SD42940 $SC_TOOL_LENGTH_CONST: the assignment of this plane holds in every plane; 0 takes the active plane.
    pub sd42940: Option<i32>,
    /// SD42950 $SC_TOOL_LENGTH_TYPE: whether lengths act as for milling or as for turning.
    pub sd42950: Option<i32>,
    /// The active frame's steps, in order.
    pub frame: Option<Vec<FrameStep>>,
}

impl Given for Tool {
    fn given(&self) -> Value { map([("type", of(&self.type_)), ("sd42900", of(&self.sd42900)), ("sd42940", of(&self.sd42940)), ("sd42950", of(&self.sd42950)), ("frame", of(&self.frame))]) }
}

/// The section `part` of a job.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// How far the part is shifted.
    pub offset: Option<[f64; 3]>,
    /// How far the part is turned about the tool axis through the work origin, before the shift.
    pub rotation: Option<f64>,
    /// By how much a size of the part differs, by the field's key.
    pub sizes: Option<BTreeMap<String, f64>>,
}

impl Given for Part {
    fn given(&self) -> Value { map([("offset", of(&self.offset)), ("rotation", of(&self.rotation)), ("sizes", of(&self.sizes))]) }
}

/// A probing job.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Job {
    /// Name of the program.
    pub name: Option<String>,
    /// Unit of every length in the job, the program and the table.
    pub units: Option<Units>,
    /// The working plane; the tool axis is square to it.
    pub plane: Option<Plane>,
    /// How far past the nominal contact a touch searches before the control gives up.
    pub overtravel: Option<f64>,
    /// Left out: the defaults.
    pub stylus: Option<Stylus>,
    /// Left out: the defaults.
    pub feeds: Option<Feeds>,
    /// Left out: the defaults.
    pub limits: Option<Limits>,
    /// Left out: the defaults.
    pub machine: Option<Machine>,
    /// Left out: the defaults.
    pub control: Option<Control>,
    /// Left out: the defaults.
    pub tool: Option<Tool>,
    /// Left out: the defaults.
    pub part: Option<Part>,
    /// What is probed.
    pub cycle: Cycle,
}

impl Given for Job {
    fn given(&self) -> Value { map([("format", Some(1.given())), ("name", of(&self.name)), ("units", of(&self.units)), ("plane", of(&self.plane)), ("overtravel", of(&self.overtravel)), ("stylus", of(&self.stylus)), ("feeds", of(&self.feeds)), ("limits", of(&self.limits)), ("machine", of(&self.machine)), ("control", of(&self.control)), ("tool", of(&self.tool)), ("part", of(&self.part)), ("cycle", Some(self.cycle.given()))]) }
}

/// One of a fixed set of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `moves`.
    Moves,
    /// `cycle`.
    Cycle,
}

impl Given for Form {
    fn given(&self) -> Value { Value::Text(match self { Form::Moves => "moves", Form::Cycle => "cycle" }.to_owned()) }
}

/// One of a fixed set of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Header {
    /// `full`.
    Full,
    /// `short`.
    Short,
}

impl Given for Header {
    fn given(&self) -> Value { Value::Text(match self { Header::Full => "full", Header::Short => "short" }.to_owned()) }
}

/// One of a fixed set of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// `G17`.
    G17,
    /// `G18`.
    G18,
    /// `G19`.
    G19,
}

impl Given for Plane {
    fn given(&self) -> Value { Value::Text(match self { Plane::G17 => "G17", Plane::G18 => "G18", Plane::G19 => "G19" }.to_owned()) }
}

/// One of a fixed set of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Post {
    /// `linuxcnc`.
    Linuxcnc,
    /// `grbl`.
    Grbl,
    /// `grblhal`.
    Grblhal,
    /// `fluidnc`.
    Fluidnc,
    /// `sinumerik`.
    Sinumerik,
    /// `heidenhain`.
    Heidenhain,
    /// `fanuc`.
    Fanuc,
    /// `haas`.
    Haas,
    /// `mazak`.
    Mazak,
    /// `brother`.
    Brother,
    /// `hurco`.
    Hurco,
    /// `okuma`.
    Okuma,
}

impl Given for Post {
    fn given(&self) -> Value { Value::Text(match self { Post::Linuxcnc => "linuxcnc", Post::Grbl => "grbl", Post::Grblhal => "grblhal", Post::Fluidnc => "fluidnc", Post::Sinumerik => "sinumerik", Post::Heidenhain => "heidenhain", Post::Fanuc => "fanuc", Post::Haas => "haas", Post::Mazak => "mazak", Post::Brother => "brother", Post::Hurco => "hurco", Post::Okuma => "okuma" }.to_owned()) }
}

/// One of a fixed set of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Protection {
    /// `checked`.
    Checked,
    /// `none`.
    None,
}

impl Given for Protection {
    fn given(&self) -> Value { Value::Text(match self { Protection::Checked => "checked", Protection::None => "none" }.to_owned()) }
}

/// One of a fixed set of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Report {
    /// `screen`.
    Screen,
    /// `log`.
    Log,
    /// `none`.
    None,
}

impl Given for Report {
    fn given(&self) -> Value { Value::Text(match self { Report::Screen => "screen", Report::Log => "log", Report::None => "none" }.to_owned()) }
}

/// One of a fixed set of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Run {
    /// `normal`.
    Normal,
    /// `dry`.
    Dry,
}

impl Given for Run {
    fn given(&self) -> Value { Value::Text(match self { Run::Normal => "normal", Run::Dry => "dry" }.to_owned()) }
}

/// One of a fixed set of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Units {
    /// `mm`.
    Mm,
    /// `inch`.
    Inch,
}

impl Given for Units {
    fn given(&self) -> Value { Value::Text(match self { Units::Mm => "mm", Units::Inch => "inch" }.to_owned()) }
}
