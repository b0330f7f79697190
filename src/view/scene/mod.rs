//! What is seen, as data: lines, walls and discs in mm on the picture plane. No colours, no pixels.

mod build;
pub mod program;
pub mod stylus;
pub mod tops;
mod walls;

pub use build::{Actual, build};

use crate::geom::{AXIS_NAMES, Plane, Vec3};
use crate::path::Path;
use crate::view::dimension::{Angle, Dimension, angles, dimensions};
use crate::view::flat::{Spot, cross, distance, dot, length, sub, width};
use crate::view::material::{Material, WallShape};
use crate::view::scene::tops::Top;

/// Where the scene is looked at from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// Against the tool axis.
    Top,
    /// Along the ordinate: abscissa to the right, tool axis up.
    Front,
    /// Against the abscissa: ordinate to the right, tool axis up.
    Side,
    /// Isometric, from abscissa plus, ordinate minus and above.
    Isometric,
}

impl Projection {
    /// The projection with this name: `top`, `front`, `side` or `isometric`.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "top" => Some(Projection::Top),
            "front" => Some(Projection::Front),
            "side" => Some(Projection::Side),
            "isometric" => Some(Projection::Isometric),
            _ => None,
        }
    }

    /// The picture's right and up as directions of (abscissa, ordinate, tool axis).
    fn axes(self) -> [Vec3; 2] {
        match self {
            Projection::Top => [Vec3::X, Vec3::Y],
            Projection::Front => [Vec3::X, Vec3::Z],
            Projection::Side => [Vec3::Y, Vec3::Z],
            Projection::Isometric => [Vec3::new(1.0, 1.0, 0.0) / 2f64.sqrt(), Vec3::new(-1.0, 1.0, 2.0) / 6f64.sqrt()],
        }
    }

    /// The direction towards who looks, in the work coordinate system.
    fn towards(self, plane: Plane) -> Vec3 {
        let [right, up] = self.axes();
        let [a, o, w] = plane.basis();
        let local = right.cross(up);
        a * local.x + o * local.y + w * local.z
    }

    /// Where a point of the work coordinate system is seen.
    pub fn spot(self, plane: Plane, p: Vec3) -> Spot {
        let [a, o, w] = plane.axes();
        let local = Vec3::new(p[a], p[o], p[w]);
        self.axes().map(|axis| axis.dot(local))
    }
}

/// What a line of the path is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stroke {
    /// Approach, retract and return.
    Position,
    /// Long links, the ways back among them.
    Link,
    /// A touch up to its nominal contact.
    Touch,
    /// The search past the contact.
    Overtravel,
}

/// One line of the path.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// From here.
    pub from: Spot,
    /// To here.
    pub to: Spot,
    /// What it is.
    pub stroke: Stroke,
    /// Whether it is a rapid.
    pub rapid: bool,
    /// Whether it is the way back from a touch.
    pub back: bool,
    /// What stands before it: that with this top side.
    pub behind: Option<usize>,
    /// The move it shows.
    pub index: usize,
}

/// One touch.
#[derive(Clone, Debug, PartialEq)]
pub struct TouchShape {
    /// The nominal contact on the surface.
    pub contact: Spot,
    /// The ball centre there.
    pub ball: Spot,
    /// The ball centre at the trigger on the actual part.
    pub trigger: Option<Spot>,
    /// Where its number stands: a direction away from the material.
    pub inward: Spot,
    /// The move that makes it.
    pub index: Option<usize>,
    /// What stands before its ball: that with this top side.
    pub behind: Option<usize>,
}

/// A dimension in the picture plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The path of the job's field that says it.
    pub field: &'static str,
    /// Its ends on the part.
    pub ends: [Spot; 2],
    /// The side on which its line stands.
    pub aside: Spot,
    /// Whether the other side is as good.
    pub either: bool,
    /// Its length, mm.
    pub length: f64,
    /// Whether it is drawn only while its field has the focus.
    pub on_demand: bool,
    /// About how wide what it says is, pixels.
    pub wide: f64,
}

/// An angle in the picture plane, in its true size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnAngle {
    /// The path of the job's field that says it.
    pub field: &'static str,
    /// Its vertex.
    pub at: Spot,
    /// From the abscissa of the picture to its first side, and from there to its second, radians, counter-clockwise positive.
    pub turns: [f64; 2],
    /// How far from its vertex the nearest touch is, mm.
    pub room: f64,
    /// About how wide what it says is, pixels.
    pub wide: f64,
}

/// Everything that is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// The walls; the actual ones first, so that they lie behind.
    pub walls: Vec<WallShape>,
    /// Isometric, the top sides of what is seen whole.
    pub tops: Vec<Top>,
    /// The nominal material behind the walls that are seen edge-on.
    pub material: Vec<Material>,
    /// The path.
    pub lines: Vec<Line>,
    /// The touches.
    pub touches: Vec<TouchShape>,
    /// Where each move ends.
    pub ends: Vec<Spot>,
    /// What else must be in sight: arcs beyond their ends.
    pub beyond: Vec<Spot>,
    /// Millimetres in a unit of the job or program, whose scale is drawn; none where a program does not say its units.
    pub unit: Option<f64>,
    /// Radius of the ball, mm.
    pub radius: f64,
    /// The stylus above its ball, about the ball centre.
    pub stylus: Vec<[Spot; 4]>,
    /// The work origin.
    pub origin: Spot,
    /// Names of the axes and where they point in the picture.
    pub axes: [(&'static str, Spot); 3],
    /// The line the cycle is about: nominal, and as it really lies.
    pub centre_lines: Option<[[Spot; 2]; 2]>,
    /// Centre of the circle whose touches are spread, its radius (mm), and the angles of first touch and spread (radians).
    /// Only seen from the top.
    pub spread: Option<(Spot, f64, f64, f64)>,
    /// The move that meets the part where it must not, and where the ball is then: what comes after it is not reached.
    pub collision: Option<(usize, Spot)>,
    /// The dimensions of the nominal part that are seen in their true length.
    pub dimensions: Vec<Drawn>,
    /// The angles that are seen in their true size.
    pub angles: Vec<DrawnAngle>,
    /// The origin of the actual feature, and its first direction: handles to move the part by. Only seen from the top.
    pub handle: Option<(Spot, Spot)>,
}

/// A spot so many times as far from where it should be.
pub fn stretched(nominal: Spot, real: Spot, times: f64) -> Spot {
    [0, 1].map(|i| nominal[i] + (real[i] - nominal[i]) * times)
}

/// The dimensions that a view along an axis shows in their true length; one that it shows shorter would mislead.
pub fn drawn(path: &Path, plane: Plane, view: Projection) -> Vec<Drawn> {
    let seen = |d: Dimension| {
        let long = d.from.distance(d.to);
        let ends = [d.from, d.to].map(|p| view.spot(plane, p));
        let along = sub(ends[1], ends[0]);
        if length(along) < long * 0.999 || long < 1e-6 {
            return None;
        }
        // A side that this projection looks along is replaced by the one square to the dimension.
        let side = view.spot(plane, d.aside);
        let size = length(side);
        let square = [-along[1] / long, along[0] / long];
        let either = size <= 0.5;
        let aside = if either { square } else { [side[0] / size, side[1] / size] };
        Some(Drawn { field: d.field, ends, aside, either, length: long, on_demand: d.on_demand, wide: 0.0 })
    };
    dimensions(path).into_iter().filter_map(seen).collect()
}

/// The angles of a path that a view along an axis shows in their true size.
pub fn drawn_angles(path: &Path, plane: Plane, view: Projection) -> Vec<DrawnAngle> {
    let seen = |angle: Angle| {
        let [first, second] = angle.sides.map(|side| view.spot(plane, side));
        if length(first) < 0.999 || length(second) < 0.999 {
            return None;
        }
        let turn = cross(first, second).atan2(dot(first, second));
        let turns = [first[1].atan2(first[0]), turn];
        Some(DrawnAngle { field: angle.field, at: view.spot(plane, angle.at), turns, room: angle.room, wide: 0.0 })
    };
    angles(path).into_iter().filter_map(seen).collect()
}

impl Scene {
    /// The work origin and the axes in a plane, and nothing else.
    fn about(plane: Plane, view: Projection) -> Self {
        let spot = |p: Vec3| view.spot(plane, p);
        let (basis, names) = (plane.basis(), plane.axes().map(|axis| AXIS_NAMES[axis]));
        Scene { origin: spot(Vec3::ZERO), axes: [0, 1, 2].map(|i| (names[i], spot(basis[i]))), ..Scene::default() }
    }

    /// Makes room for what is said of its dimensions and angles, by their fields' paths.
    pub fn name(&mut self, names: &[(&'static str, String)]) {
        let dimensions = self.dimensions.iter_mut().map(|drawn| (drawn.field, &mut drawn.wide));
        for (own, wide) in dimensions.chain(self.angles.iter_mut().map(|angle| (angle.field, &mut angle.wide))) {
            *wide = names.iter().find(|(field, _)| *field == own).map_or(0.0, |(_, name)| width(name));
        }
    }

    /// Where the ball is when such a part of a move is done, 0 to 1. The way past a nominal contact is no part of it.
    pub fn ball(&self, index: usize, part: f64) -> Option<Spot> {
        let pieces: Vec<&Line> = self.lines.iter().filter(|l| l.index == index && l.stroke != Stroke::Overtravel).collect();
        let whole: f64 = pieces.iter().map(|l| length(sub(l.to, l.from))).sum();
        let mut rest = whole * part;
        for line in &pieces {
            let way = length(sub(line.to, line.from));
            if rest <= way && way > 0.0 {
                let t = rest / way;
                return Some([line.from[0] + (line.to[0] - line.from[0]) * t, line.from[1] + (line.to[1] - line.from[1]) * t]);
            }
            rest -= way;
        }
        self.ends.get(index).copied()
    }

    /// The smallest and largest spot of everything that must be seen.
    pub fn bounds(&self) -> [Spot; 2] {
        let balls = self.touches.iter().flat_map(|t| [t.contact, t.ball]);
        let ends = self.ends.iter().flat_map(|e| {
            let r = self.radius;
            [[e[0] - r, e[1] - r], [e[0] + r, e[1] + r]]
        });
        let walls = self.walls.iter().flat_map(|w| w.corners);
        let start = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        let bounds = balls
            .chain(ends)
            .chain(walls)
            .chain(self.beyond.iter().copied())
            .fold(start, |[low, high], p| [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]]);
        // A cycle without a path has nothing to show but its origin.
        if bounds[0][0].is_finite() { bounds } else { [[-50.0, -50.0], [50.0, 50.0]] }
    }

    /// The move whose line is nearest to `at`, if one is within `reach` (both mm). Of lines that lie on each other a touch
    /// wins over the way back.
    pub fn pick(&self, at: Spot, reach: f64) -> Option<usize> {
        let rank = |stroke: Stroke| match stroke {
            Stroke::Touch => 0.0,
            Stroke::Overtravel => 1.0,
            Stroke::Position => 2.0,
            Stroke::Link => 3.0,
        };
        self.lines
            .iter()
            .map(|line| (distance(at, line.from, line.to) + rank(line.stroke) * reach * 0.05, line))
            .filter(|(far, _)| *far <= reach)
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, line)| line.index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seen_from_the_top_the_abscissa_goes_right_in_every_plane() {
        for plane in [Plane::G17, Plane::G18, Plane::G19] {
            let [a, o, w] = plane.basis();
            assert_eq!(Projection::Top.spot(plane, a), [1.0, 0.0]);
            assert_eq!(Projection::Top.spot(plane, o), [0.0, 1.0]);
            assert_eq!(Projection::Front.spot(plane, w), [0.0, 1.0]);
            assert_eq!(Projection::Side.spot(plane, o), [1.0, 0.0]);
        }
    }

    #[test]
    fn isometric_axes_have_equal_lengths_and_up_is_up() {
        let lengths: Vec<f64> = Plane::G17.basis().iter().map(|&e| length(Projection::Isometric.spot(Plane::G17, e))).collect();
        assert!(lengths.iter().all(|l| (l - (2f64 / 3.0).sqrt()).abs() < 1e-12), "{lengths:?}");
        let up = Projection::Isometric.spot(Plane::G17, Vec3::Z);
        assert!(up[0].abs() < 1e-12 && up[1] > 0.0);
    }

    #[test]
    fn distance_to_a_segment_by_hand() {
        assert_eq!(distance([5.0, 3.0], [0.0, 0.0], [10.0, 0.0]), 3.0);
        assert_eq!(distance([13.0, 4.0], [0.0, 0.0], [10.0, 0.0]), 5.0);
        assert_eq!(distance([3.0, 4.0], [0.0, 0.0], [0.0, 0.0]), 5.0);
    }
}
