//! What is probed, resolved: the one place from which a native cycle is printed.

use crate::geom::Vec3;
use crate::path::ParameterValue;

/// Which kind of feature a cycle probes, before its form is filled in. What a control does of it is a row of its matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// Nothing: the probe is switched.
    Switch,
    /// Nothing: a line for the control.
    Action,
    /// A point of a surface.
    Surface,
    /// A hole from its middle.
    Hole,
    /// A hole, each touch entered from above.
    HoleProtected,
    Boss,
    /// A rectangle from its middle.
    Pocket,
    /// A rectangle from inside, each touch entered from above.
    PocketProtected,
    /// A rectangle from outside.
    Block,
    /// Two walls that face outwards.
    Web,
    /// The same and the middle of its top.
    WebTop,
    /// Two walls that face each other, from their middle.
    Groove,
    /// The same, each touch entered from above.
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

/// The probed feature with its dimensions and their fields in the job. Its frame is in [`crate::path::Path::frame`].
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
    Wall(Straight),
    /// Those of the cycles of a set-up: [`crate::path::Path::members`] has them.
    Several,
}

/// A dimension, and the path of the job's field that says it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Such as `cycle.width1`.
    pub field: &'static str,
    /// mm; of an angle degrees.
    pub value: f64,
}

/// A point of a surface, by the fields that say how it is touched: the path has the values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// From the surface to the ball centre where the touch begins.
    pub clearance: &'static str,
    /// How steeply the target vector points up from the plane.
    pub elevation: &'static str,
}

/// A wall, touched twice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Straight {
    /// From touch to touch.
    pub distance: Entry,
    /// The field of how far from the wall a touch begins.
    pub clearance: &'static str,
}

/// A circle about the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bore {
    pub diameter: Entry,
    /// From the top side down to the touches.
    pub depth: Entry,
    /// From the wall to the ball centre where a touch begins; `None` if touches begin in the middle.
    pub clearance: Option<Entry>,
    /// How far above the top side the ball crosses; `None` if it does not.
    pub crossing: Option<Entry>,
}

/// Opposite walls: one pair, square to the first direction of the frame, or two, square to each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Pairs {
    /// Whether the material lies around it.
    pub internal: bool,
    pub sides: Vec<Side>,
    /// From the top side down to the touches.
    pub depth: Entry,
    /// How far above the top side the ball crosses; `None` if it does not, or where another field says it.
    pub crossing: Option<Entry>,
}

/// Two opposite walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// From wall to wall.
    pub width: Entry,
    /// From the wall to the ball centre where a touch begins; `None` if touches begin in the middle.
    pub clearance: Option<Entry>,
}

/// A corner of two or three walls.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    /// Whether it is touched from outside.
    pub outside: bool,
    /// Between the first two walls.
    pub angle: Entry,
    /// The walls, but for a top side.
    pub walls: Vec<Touched>,
    /// The top side, where it is touched, too.
    pub top: Option<Top>,
}

/// A wall of a corner, by the fields that say where it is touched: the path has the values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touched {
    /// From the wall to the ball centre where a touch begins.
    pub clearance: &'static str,
    /// From touch to touch, where there are two.
    pub step: Option<&'static str>,
    /// From the corner to the first touch, of a corner from outside: else that is the foot of the start.
    pub distance: Option<&'static str>,
}

/// The top side of a corner, by the fields that say where it is touched: the path has the values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Top {
    /// From the top side down to the touches of the walls.
    pub depth: &'static str,
    /// From the top side to the ball centre where its touch begins.
    pub clearance: &'static str,
    /// From each of the two walls inwards to its touch.
    pub inwards: [&'static str; 2],
}

/// Two holes or studs, and the control's own way to probe them.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoCircles {
    /// The fields that say the two diameters.
    pub diameters: [&'static str; 2],
    /// The line between the two nominal centres, where both are known.
    pub line: Option<[Vec3; 2]>,
    /// How the touches are spread over the first circle.
    pub spread: Option<Spread>,
    /// The settings of the cycle, in the order of its block.
    pub settings: Vec<Setting>,
    /// The settings of the extrusion (1493) in front of it; empty without one.
    pub extrusion: Vec<Setting>,
    /// Whether the operator has to bring the probe to an object.
    pub semi_automatic: bool,
    /// Whether the control stops, or shows something, where a tolerance does not hold.
    pub reacts: bool,
    /// Whether a value has a tolerance.
    pub toleranced: bool,
    /// Whether a rotary table is to be turned, or its offset to be set.
    pub turns_table: bool,
}

/// One setting of a cycle that the control has itself, by the number of its Q parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The number of the Q parameter.
    pub number: i32,
    /// The control's dialog text.
    pub dialog: String,
    pub value: ParameterValue,
}

/// How touches are spread over a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Centre of the circle.
    pub center: Vec3,
    /// Its radius, mm.
    pub radius: f64,
    /// Angle of the first touch from the abscissa, radians.
    pub start: f64,
    /// Over which angle the touches are spread, counter-clockwise positive, radians.
    pub sweep: f64,
    /// The paths of the job's fields that say these two angles.
    pub fields: [&'static str; 2],
}

impl Feature {
    /// The two circles, where that is what is probed.
    pub fn two_circles(&self) -> Option<&TwoCircles> {
        match self {
            Feature::TwoCircles(circles) => Some(circles),
            _ => None,
        }
    }
}
