//! What is probed, resolved: the one place from which a control's own cycle is printed.

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
    /// A boss.
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
    /// Two holes or studs.
    TwoCircles,
}

/// What is probed, with its dimensions: lengths in mm, angles in degrees. Its frame stands in [`crate::path::Path::frame`].
#[derive(Clone, Debug, PartialEq)]
pub enum Feature {
    /// Nothing.
    Still,
    /// A point of a surface.
    Surface {
        /// Whether its touch was picked, and does not follow from the dimensions.
        picked: bool,
    },
    /// A hole.
    Hole(Bore),
    /// A boss.
    Boss(Bore),
    /// A rectangle from inside.
    Pocket(Rectangle),
    /// A rectangle from outside.
    Block(Rectangle),
    /// Two walls that face outwards.
    Web(Pair),
    /// Two walls that face each other.
    Groove(Pair),
    /// A corner of two walls.
    Corner(Corner),
    /// A corner of three surfaces.
    Triple(Corner),
    /// Two holes or studs.
    TwoCircles(Box<TwoCircles>),
}

/// How each touch is entered from above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Protection {
    /// How far above the top side the ball crosses.
    pub top: f64,
    /// From the wall to the ball centre where a touch begins: of the first pair of walls, and of the second. A single one is in both.
    pub sides: [f64; 2],
}

/// A circle about the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bore {
    /// Its diameter.
    pub diameter: f64,
    /// From the top side down to the touches.
    pub depth: f64,
    /// None where touches begin in the middle.
    pub protected: Option<Protection>,
    /// Whether its touches were picked one by one, and do not follow from the dimensions.
    pub picked: bool,
}

/// Two pairs of walls, square to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Along the first direction of the frame, and along the second.
    pub widths: [f64; 2],
    /// From the top side down to the touches.
    pub depth: f64,
    /// None where touches begin in the middle.
    pub protected: Option<Protection>,
    /// Whether its touches were picked one by one, and do not follow from the dimensions.
    pub picked: bool,
}

/// Two opposite walls, square to the first direction of the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// From wall to wall.
    pub width: f64,
    /// From the top side down to the touches.
    pub depth: f64,
    /// None where touches begin in the middle.
    pub protected: Option<Protection>,
    /// Whether the middle of the top is touched, too.
    pub top_touched: bool,
    /// Whether its touches were picked one by one, and do not follow from the dimensions.
    pub picked: bool,
}

/// Walls that meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Whether it is touched from outside.
    pub outside: bool,
    /// Between the walls.
    pub angle: f64,
    /// Whether its touches were picked one by one, and do not follow from the dimensions.
    pub picked: bool,
}

/// Two holes or studs, and the control's own way to probe them.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoCircles {
    /// The line between the two nominal centres, where both are known.
    pub line: Option<[Vec3; 2]>,
    /// How the touches are spread over the first circle.
    pub spread: Option<Spread>,
    /// The settings of the cycle, in the order of its block.
    pub settings: Vec<Setting>,
    /// Those of the extrusion in front of it; empty where there is none.
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
    /// Its value.
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
    /// Whether the touches were picked one by one, and do not follow from the dimensions.
    pub fn picked(&self) -> bool {
        match self {
            Feature::Hole(bore) | Feature::Boss(bore) => bore.picked,
            Feature::Pocket(rectangle) | Feature::Block(rectangle) => rectangle.picked,
            Feature::Web(pair) | Feature::Groove(pair) => pair.picked,
            Feature::Corner(corner) | Feature::Triple(corner) => corner.picked,
            Feature::Surface { picked } => *picked,
            Feature::Still | Feature::TwoCircles(_) => false,
        }
    }

    /// The two circles, where that is what is probed.
    pub fn two_circles(&self) -> Option<&TwoCircles> {
        match self {
            Feature::TwoCircles(circles) => Some(circles),
            _ => None,
        }
    }
}
