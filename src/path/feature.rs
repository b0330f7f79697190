//! The probed feature with all its values. Native calls are printed from it alone.

use crate::geom::Vec3;
use crate::path::ParameterValue;

/// Kind of feature that a cycle probes, known before its form is filled in. Each control has a row for it in its support matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeatureKind {
    /// Switches the probe; touches nothing.
    Switch,
    /// Emits a line for the control; touches nothing.
    Action,
    /// A point of a surface.
    Surface,
    /// A hole, touched from its centre.
    Hole,
    /// A hole; the stylus enters from above for each touch.
    HoleProtected,
    Boss,
    /// A rectangle, touched from its centre.
    Pocket,
    /// A rectangle from inside; the stylus enters from above for each touch.
    PocketProtected,
    /// A rectangle from outside.
    Block,
    /// Two outward walls.
    Web,
    /// Two outward walls and the middle of the top.
    WebTop,
    /// Two facing walls, from the middle between them.
    Groove,
    /// Two facing walls; the stylus enters from above for each touch.
    GrooveProtected,
    /// A corner of two walls from inside.
    CornerInside,
    /// A corner of two walls from outside.
    CornerOutside,
    /// A corner of three surfaces from inside.
    TripleInside,
    /// A corner of three surfaces from outside.
    TripleOutside,
    /// A wall, touched twice.
    Wall,
    /// Two holes or studs.
    TwoCircles,
}

impl FeatureKind {
    /// Change of a milling cutter's radius for an error of 1 in a width or diameter that it has cut: what is too large inside needs a larger radius, so that the
    /// tool stays farther away; outside a smaller one. `None` for features without a size.
    pub fn tool_sense(self) -> Option<f64> {
        match self {
            FeatureKind::Hole
            | FeatureKind::HoleProtected
            | FeatureKind::Pocket
            | FeatureKind::PocketProtected
            | FeatureKind::Groove
            | FeatureKind::GrooveProtected => Some(0.5),
            FeatureKind::Boss | FeatureKind::Block | FeatureKind::Web | FeatureKind::WebTop => {
                Some(-0.5)
            }
            FeatureKind::Switch
            | FeatureKind::Action
            | FeatureKind::Surface
            | FeatureKind::CornerInside
            | FeatureKind::CornerOutside
            | FeatureKind::TripleInside
            | FeatureKind::TripleOutside
            | FeatureKind::Wall
            | FeatureKind::TwoCircles => None,
        }
    }
}

/// The probed feature with its dimensions and the job fields that give them. [`crate::path::Path::frame`] has its frame.
#[derive(Clone, Debug, PartialEq)]
pub enum Feature {
    /// Nothing is probed.
    Unmoving,
    /// A point of a surface.
    Surface(Point),
    /// A hole or a boss.
    Bore(Bore),
    /// One or two pairs of opposite walls.
    Pairs(Pairs),
    /// A corner of two or three walls.
    Corner(Corner),
    /// Two holes or studs.
    TwoCircles(Box<TwoCircles>),
    /// A wall, touched twice.
    Wall(WallFeature),
    /// The features of a set-up, in [`crate::path::Path::cycles`].
    Several,
}

/// A dimension and the path of the job field that gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldValue {
    /// Such as `cycle.width1`.
    pub field: &'static str,
    /// In mm; an angle in degrees.
    pub value: f64,
}

/// A point of a surface, by the job fields of its touch. The path has the values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// From the surface to the ball centre where the touch begins.
    pub clearance: &'static str,
    /// Elevation of the target vector above the plane.
    pub elevation: &'static str,
}

/// A wall, touched twice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallFeature {
    /// From touch to touch.
    pub distance: FieldValue,
    /// Field with the distance from the wall to the ball centre where a touch begins.
    pub clearance: &'static str,
}

/// A circle about the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bore {
    pub diameter: FieldValue,
    /// From the top side down to the touches.
    pub depth: FieldValue,
    /// From the wall to the ball centre where a touch begins; `None` if touches begin at the centre.
    pub clearance: Option<FieldValue>,
    /// Height above the top side at which the ball crosses the feature; `None` if it does not cross.
    pub crossing: Option<FieldValue>,
}

/// Opposite walls. One pair is perpendicular to the first direction of the frame; a second pair is perpendicular to the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Pairs {
    /// Whether the material is outside the walls.
    pub internal: bool,
    pub sides: Vec<Side>,
    /// From the top side down to the touches.
    pub depth: FieldValue,
    /// Height above the top side at which the ball crosses; `None` if it does not cross, or if another field gives the height.
    pub crossing: Option<FieldValue>,
}

/// Two opposite walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// From wall to wall.
    pub width: FieldValue,
    /// From the wall to the ball centre where a touch begins; `None` if touches begin at the centre.
    pub clearance: Option<FieldValue>,
}

/// A corner of two or three walls.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    /// Whether it is touched from outside.
    pub outside: bool,
    /// Between the first two walls.
    pub angle: FieldValue,
    /// The walls, without a top side.
    pub walls: Vec<WallTouch>,
    /// The top side, if it is touched.
    pub top: Option<Top>,
}

/// A wall of a corner, by the job fields of its touches. The path has the values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallTouch {
    /// From the wall to the ball centre where a touch begins.
    pub clearance: &'static str,
    /// From touch to touch, if there are two.
    pub step: Option<&'static str>,
    /// From the corner to the first touch, for a corner from outside. An inside corner touches where the start projects onto the wall.
    pub distance: Option<&'static str>,
}

/// The top side of a corner, by the job fields of its touch. The path has the values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Top {
    /// From the top side down to the touches of the walls.
    pub depth: &'static str,
    /// From the top side to the ball centre where its touch begins.
    pub clearance: &'static str,
    /// Inwards from each of the two walls to the touch.
    pub inwards: [&'static str; 2],
}

/// Two holes or studs, with the settings of the native cycle for them.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoCircles {
    /// Fields with the two diameters.
    pub diameters: [&'static str; 2],
    /// The line between the two nominal centres, if both are known.
    pub line: Option<[Vec3; 2]>,
    /// Distribution of the touches over the first circle.
    pub spread: Option<Spread>,
    /// Settings of the cycle, in the order of its block.
    pub settings: Vec<Setting>,
    /// Settings of the extrusion (1493) before the cycle; empty without one.
    pub extrusion: Vec<Setting>,
    /// Whether the operator has to position the probe at an object.
    pub semi_automatic: bool,
    /// Whether the control stops or shows a message when a tolerance is exceeded.
    pub reacts: bool,
    /// Whether a value has a tolerance.
    pub toleranced: bool,
    /// Whether the cycle turns a rotary table or sets its offset.
    pub turns_table: bool,
}

/// One setting of a native cycle, by the number of its Q parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The number of the Q parameter.
    pub number: i32,
    /// The control's dialog text.
    pub dialog: String,
    pub value: ParameterValue,
}

/// Distribution of touches over a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Centre of the circle.
    pub center: Vec3,
    /// Its radius, mm.
    pub radius: f64,
    /// Angle of the first touch from the abscissa, radians.
    pub start: f64,
    /// Angle over which the touches are spread, radians, counter-clockwise positive.
    pub sweep: f64,
    /// Paths of the job fields that give these two angles.
    pub fields: [&'static str; 2],
}

impl Feature {
    /// The two circles, if the cycle probes them.
    pub fn two_circles(&self) -> Option<&TwoCircles> {
        match self {
            Feature::TwoCircles(circles) => Some(circles),
            _ => None,
        }
    }
}
