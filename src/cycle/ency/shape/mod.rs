//! Shapes of features: opposite walls, circle, corner of two or three walls, wall, point; with the steps and rules that they share.

mod corner;
mod pairs;
mod point;
mod round;
mod triple;
mod unmoving;
mod wall;

pub use corner::{Corner, CornerAngle};
pub use pairs::{Pairs, Side};
pub use point::Point;
pub use round::{Circle, Variant};
pub use triple::{Outside, Triple};
pub use wall::TwoTouches;

use unmoving::Unmoving;

use crate::cycle::ency::Pick;
use crate::form::Checker;
use crate::formula::{Draft, Expr, Formula};
use crate::geom::{Frame, Plane, Vec3};
use crate::path::{
    Feature, Feed, MAX_TOUCHES, ProbeSettings, SHORTEST_TOUCH, Surface, Touch, Tracer,
};
use crate::text::{Text, text};

/// A feature with its dimensions and its kind of probing.
#[derive(Clone, Debug, Default)]
pub enum Shape {
    /// No touch and no move.
    #[default]
    Unmoving,
    /// A point of a surface.
    Point(Point),
    /// A hole or a boss.
    Circle(Circle),
    /// One or two pairs of opposite walls.
    Pairs(Pairs),
    /// A corner of two walls.
    Corner(Corner),
    /// A corner of three walls.
    Triple(Triple),
    /// A wall, touched twice.
    Wall(TwoTouches),
}

impl Shape {
    /// Sizes that picked touches give, by the paths of their fields: mm, degrees.
    pub fn sizes(&mut self) -> Vec<(&'static str, &mut f64)> {
        match self {
            Shape::Unmoving => Vec::new(),
            Shape::Point(point) => point.sizes(),
            Shape::Circle(circle) => circle.sizes(),
            Shape::Pairs(pairs) => pairs.sizes(),
            Shape::Corner(corner) => corner.sizes(),
            Shape::Triple(triple) => triple.sizes(),
            Shape::Wall(wall) => wall.sizes(),
        }
    }
}

impl std::ops::Deref for Shape {
    type Target = dyn Probed;

    fn deref(&self) -> &Self::Target {
        match self {
            Shape::Unmoving => &Unmoving,
            Shape::Point(point) => point,
            Shape::Circle(circle) => circle,
            Shape::Pairs(pairs) => pairs,
            Shape::Corner(corner) => corner,
            Shape::Triple(triple) => triple,
            Shape::Wall(wall) => wall,
        }
    }
}

/// Operations of every shape.
pub trait Probed {
    /// Touches from the dimensions: point, target vector, index of the surface.
    fn touches(&self, frame: &Frame) -> Vec<(Vec3, Vec3, usize)>;

    /// Name of a touch in the parameter table.
    fn name(&self, k: usize) -> Text;

    /// Reports dimensions that contradict each other.
    fn rules(&self, setup: &ProbeSettings, checker: &mut Checker);

    /// Reports faults of picked touches.
    fn check(&self, picks: &[Pick], plane: Plane, checker: &mut Checker);

    /// The shape with the sizes and the position that valid picks give.
    fn place(&self, picks: &[Pick], plane: Plane) -> PlacedShape;

    /// Plans the documented steps.
    fn plan_steps(&self, on: &TouchLayout<'_>, tracer: &mut Tracer);

    /// The results that the control computes.
    fn formula(&self, on: &TouchLayout<'_>) -> Formula;

    /// The surfaces, one for each group of touches.
    fn surfaces(&self, on: &TouchLayout<'_>) -> Vec<Surface>;

    fn feature(&self) -> Feature;

    /// Height of the top side along the tool axis, mm, if the source has one.
    fn top(&self, _on: &TouchLayout<'_>) -> Option<f64> {
        None
    }

    /// Reason why the control's value of this result is wrong on a rotated part, if it is.
    fn turned_error(&self, _code: &str) -> Option<&'static str> {
        None
    }
}

/// A shape at the position that its form or its picks give.
#[derive(Clone, Debug, Default)]
pub struct PlacedShape {
    /// `origin` of the form, mm.
    pub origin: Vec3,
    /// `rotation` of the form, degrees.
    pub rotation: f64,
    pub shape: Shape,
}

impl PlacedShape {
    /// Frame of its dimensions.
    pub fn frame(&self, plane: Plane) -> Frame {
        Frame::new(plane, self.origin, self.rotation.to_radians())
    }
}

/// The touches of a shape with the settings of the job.
#[derive(Debug)]
pub struct TouchLayout<'a> {
    /// The frame of the shape's dimensions.
    pub frame: Frame,
    pub touches: Vec<Touch>,
    /// Settings of the job.
    pub setup: &'a ProbeSettings,
    /// Height above the start at which the path begins and ends, mm.
    pub feed_distance: f64,
}

/// To the feed distance above the start, then down to the start.
pub fn begin(on: &TouchLayout<'_>, tracer: &mut Tracer, start: Vec3, step: u8) {
    tracer.position(start + on.frame.w * on.feed_distance, Feed::Approach, step);
    tracer.position(start, Feed::Approach, step);
}

/// Up by the feed distance at the end.
pub fn lift(on: &TouchLayout<'_>, tracer: &mut Tracer, start: Vec3, step: u8) {
    tracer.position(start + on.frame.w * on.feed_distance, Feed::Return, step);
}

/// Documented steps 2 to 6 of a protected cycle: across to a point in front of the touch at the height of the start, down, touch and retract, up, back to the
/// start.
pub fn protected(on: &TouchLayout<'_>, tracer: &mut Tracer, k: usize, start: Vec3, clearance: f64) {
    let touch = &on.touches[k];
    let approach = touch.point + touch.vector * clearance;
    let over = approach + on.frame.w * (start - approach).dot(on.frame.w);
    tracer.position(over, Feed::LongLink, 2);
    tracer.position(approach, Feed::LongLink, 3);
    tracer.touch(k, touch, Feed::LongLink, 4);
    tracer.position(over, Feed::LongLink, 5);
    tracer.position(start, Feed::LongLink, 6);
}

/// Documented steps of a cycle that touches from the middle: in from above if the top clearance is checked, all touches from there, and out.
pub fn from_middle(on: &TouchLayout<'_>, tracer: &mut Tracer, depth: f64, top: Option<f64>) {
    let start = on.frame.point(0.0, 0.0, -depth);
    match top {
        Some(top) => {
            begin(on, tracer, on.frame.point(0.0, 0.0, top), 1);
            tracer.position(start, Feed::LongLink, 1);
        }
        None => begin(on, tracer, start, 2),
    }
    for (k, touch) in on.touches.iter().enumerate() {
        tracer.touch(k, touch, Feed::LongLink, 3);
    }
    let out = top.map_or(start, |top| on.frame.point(0.0, 0.0, top));
    tracer.position(out, Feed::LongLink, 4);
    lift(on, tracer, out, 5);
}

/// A component of a direction in the plane, as a factor in a formula.
pub fn constant(f: &Draft, x: f64) -> Expr<'_> {
    f.number(crate::num::tidy(x))
}

/// Abscissa and ordinate of a vector.
pub fn flat(plane: Plane, v: Vec3) -> (f64, f64) {
    let [a, o, _] = plane.axes();
    (v[a], v[o])
}

/// A clearance must be larger than the ball radius, or the ball is in contact before the touch. Lengths are from the surface to the ball centre.
pub fn clearance_rule(
    checker: &mut Checker,
    setup: &ProbeSettings,
    label: &'static str,
    clearance: f64,
    path: &str,
) {
    if checker.is_clean(&[path, "stylus.diameter"])
        && clearance < setup.radius + SHORTEST_TOUCH - 1e-6
    {
        let message = text!(
            "{label} ({clearance}) must be at least the ball radius ({radius}) plus {least}: it is measured from the surface to the ball centre, and the touch would begin in contact",
            label,
            checker.length(clearance),
            checker.length(setup.radius),
            checker.length(SHORTEST_TOUCH)
        );
        checker.error("clearance-too-small", path, message);
    }
}

/// Checks that the parameter table can hold all touches.
pub fn touch_count_rule(checker: &mut Checker, count: usize, path: &str) {
    if count > MAX_TOUCHES {
        let message = text!(
            "{count} touches are more than the {most} that the parameter table holds: touch {touch} would start at code {code} \
             and run into the -200 block of original points",
            count,
            MAX_TOUCHES,
            MAX_TOUCHES + 1,
            -100 - 6 * MAX_TOUCHES as i32
        );
        checker.error("too-many-touches", path, message);
    }
}

/// Checks for touches above the middle of the ball and for crossings that are too low. `outside`: whether the part itself is in the way.
pub fn level_rules(
    checker: &mut Checker,
    setup: &ProbeSettings,
    depth: f64,
    crossing: Option<f64>,
    outside: bool,
) {
    if checker.is_clean(&["cycle.depth", "stylus.diameter"]) && depth < setup.radius {
        let message = text!(
            "At a depth of {depth} part of the ball (radius {radius}) is still above the top side: an edge break or burr there is part of the touch",
            checker.length(depth),
            checker.length(setup.radius)
        );
        checker.warning("touch-near-edge", "cycle.depth", message);
    }
    let Some(top) = crossing else { return };
    if !checker.is_clean(&["cycle.topClearance", "stylus.diameter"]) || top > setup.radius {
        return;
    }
    let (clearance, radius) = (checker.length(top), checker.length(setup.radius));
    if outside {
        let message = text!(
            "With a top clearance of {clearance} the ball (radius {radius}) would hit the top side when it crosses, since heights are of the ball centre: it must be larger than the radius",
            clearance,
            radius
        );
        checker.error("crossing-too-low", "cycle.topClearance", message);
    } else {
        let message = text!(
            "With a top clearance of {clearance} the ball (radius {radius}) crosses below the top side, since heights are of the \
             ball centre: an island as high as the top side would be hit",
            clearance,
            radius
        );
        checker.warning("low-crossing", "cycle.topClearance", message);
    }
}
