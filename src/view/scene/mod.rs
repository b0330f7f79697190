//! What is seen, as data: lines, walls and discs in mm on the picture plane. No colours, no pixels.

pub mod blocks;
mod build;
pub mod program;
mod stock;
pub mod stylus;
pub mod top_faces;

pub use build::{Actual, between, build};

use crate::geom::{AXIS_NAMES, Plane, Vec2, Vec3};
use crate::path::Path;
use crate::view::dimension::{Angle, Dimension, angles, dimensions};
use crate::view::material::Material;
use crate::view::scene::blocks::Block;
use crate::view::scene::top_faces::Top;
use crate::view::walls::WallShape;

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
            Projection::Isometric => [
                Vec3::new(1.0, 1.0, 0.0) / 2f64.sqrt(),
                Vec3::new(-1.0, 1.0, 2.0) / 6f64.sqrt(),
            ],
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
    pub fn place(self, plane: Plane, p: Vec3) -> Vec2 {
        let [a, o, w] = plane.axes();
        let local = Vec3::new(p[a], p[o], p[w]);
        self.axes().map(|axis| axis.dot(local)).into()
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
    pub from: Vec2,
    pub to: Vec2,
    pub stroke: Stroke,
    pub rapid: bool,
    /// Whether it is the way back from a touch.
    pub back: bool,
    /// Top side of the body that hides it.
    pub behind: Option<usize>,
    /// Whether it is drawn pale: from the top it runs so high that nothing of the part is near it, or belongs to a cycle that is not active.
    pub pale: bool,
    /// Index of the move in the path.
    pub index: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub struct TouchShape {
    /// The nominal contact on the surface.
    pub contact: Vec2,
    /// The ball centre there.
    pub ball: Vec2,
    /// The ball centre at the trigger on the actual part.
    pub trigger: Option<Vec2>,
    /// Its number in its cycle, from 1.
    pub number: usize,
    /// The name of its cycle, at the first touch of each in a set-up.
    pub named: Option<String>,
    /// Whether it is drawn pale: it belongs to a cycle that is not active.
    pub pale: bool,
    /// Direction away from the material, in which its number is placed.
    pub inward: Vec2,
    /// Index of the move that makes it.
    pub index: Option<usize>,
    /// Top side of the body that hides its ball.
    pub behind: Option<usize>,
}

/// The nominal distance between the two places of a relation.
#[derive(Clone, Debug, PartialEq)]
pub struct Distance {
    /// The name of the relation.
    pub name: String,
    pub ends: [Vec2; 2],
    /// mm.
    pub length: f64,
}

/// A dimension in the picture plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The path of the job's field that says it.
    pub field: &'static str,
    /// Its ends on the part.
    pub ends: [Vec2; 2],
    /// The side of its line.
    pub aside: Vec2,
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
    pub at: Vec2,
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
    /// Isometric, the faces of the nominal material around what lies inside the part, in the order in which they are drawn.
    pub blocks: Vec<Block>,
    /// The nominal material behind the walls that are seen edge-on.
    pub material: Vec<Material>,
    /// The path.
    pub lines: Vec<Line>,
    pub touches: Vec<TouchShape>,
    /// Where each move ends.
    pub ends: Vec<Vec2>,
    /// What else must be in sight: arcs beyond their ends.
    pub beyond: Vec<Vec2>,
    /// Millimetres in a unit of the job or program, whose scale is drawn; `None` if a program does not say its units.
    pub unit: Option<f64>,
    /// Radius of the ball, mm.
    pub radius: f64,
    /// The stylus above its ball, about the ball centre.
    pub stylus: Vec<[Vec2; 4]>,
    /// The work origin.
    pub origin: Vec2,
    /// Names of the axes and where they point in the picture.
    pub axes: [(&'static str, Vec2); 3],
    /// The line the cycle is about: nominal, and as it really lies.
    pub centre_lines: Option<[[Vec2; 2]; 2]>,
    /// Lines of the relations of a set-up, on the nominal part.
    pub related: Vec<[Vec2; 2]>,
    /// Distances that relations measure.
    pub distances: Vec<Distance>,
    /// Centre of the circle whose touches are spread, its radius (mm), and the angles of first touch and spread (radians).
    /// Only seen from the top.
    pub spread: Option<(Vec2, f64, f64, f64)>,
    /// The move that meets the part where it must not, and where the ball is then: what comes after it is not reached.
    pub collision: Option<(usize, Vec2)>,
    /// The dimensions of the nominal part that are seen in their true length.
    pub dimensions: Vec<Drawn>,
    /// The angles that are seen in their true size.
    pub angles: Vec<DrawnAngle>,
    /// The origin of the nominal feature, and its first direction. Only seen from the top.
    pub turn: Option<(Vec2, Vec2)>,
    /// The origin of the actual feature, and its first direction: handles to move the part by. Only seen from the top.
    pub handle: Option<(Vec2, Vec2)>,
    /// Of how many cycles of a set-up it has the scenes.
    pub cycles: usize,
}

/// The dimensions that a view along an axis shows in their true length; one that it shows shorter would mislead.
pub fn drawn(path: &Path, plane: Plane, view: Projection) -> Vec<Drawn> {
    let seen = |d: Dimension| {
        let long = d.from.distance(d.to);
        let ends = [d.from, d.to].map(|p| view.place(plane, p));
        let along = ends[1] - ends[0];
        if along.length() < long * 0.999 || long < 1e-6 {
            return None;
        }
        // A side that this projection looks along is replaced by the one square to the dimension.
        let side = view.place(plane, d.aside);
        let size = side.length();
        let either = size <= 0.5;
        let aside = if either {
            along.perp() / long
        } else {
            side / size
        };
        Some(Drawn {
            field: d.field,
            ends,
            aside,
            either,
            length: long,
            on_demand: d.on_demand,
            wide: 0.0,
        })
    };
    dimensions(path).into_iter().filter_map(seen).collect()
}

/// The dimensions of a path where the part is seen at an angle: along the part, as an isometric drawing has them. What comes with the focus is left out.
fn tilted(path: &Path, plane: Plane, view: Projection) -> Vec<Drawn> {
    let seen = |d: Dimension| {
        let ends = [d.from, d.to].map(|p| view.place(plane, p));
        let (along, side) = (
            (ends[1] - ends[0]).normalize_or(Vec2::X),
            view.place(plane, d.aside).normalize_or(Vec2::Y),
        );
        // A line that stood almost along the dimension would be nowhere.
        let aside = if along.perp_dot(side).abs() < 0.4 {
            along.perp()
        } else {
            side
        };
        Drawn {
            field: d.field,
            ends,
            aside,
            either: true,
            length: d.from.distance(d.to),
            on_demand: false,
            wide: 0.0,
        }
    };
    dimensions(path)
        .into_iter()
        .filter(|d| !d.on_demand && d.from.distance(d.to) > 1e-6)
        .map(seen)
        .collect()
}

/// The angles of a path that a view along an axis shows in their true size.
pub fn drawn_angles(path: &Path, plane: Plane, view: Projection) -> Vec<DrawnAngle> {
    let seen = |angle: Angle| {
        let [first, second] = angle.sides.map(|side| view.place(plane, side));
        if first.length() < 0.999 || second.length() < 0.999 {
            return None;
        }
        let turns = [
            first.to_angle(),
            first.perp_dot(second).atan2(first.dot(second)),
        ];
        Some(DrawnAngle {
            field: angle.field,
            at: view.place(plane, angle.at),
            turns,
            room: angle.room,
            wide: 0.0,
        })
    };
    angles(path).into_iter().filter_map(seen).collect()
}

/// Distance of a place from a segment.
fn distance(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let (ab, ap) = (b - a, p - a);
    let square = ab.length_squared();
    let t = if square == 0.0 {
        0.0
    } else {
        crate::num::within(ap.dot(ab) / square, 0.0, 1.0)
    };
    (ap - ab * t).length()
}

/// About how many pixels a name takes with the room around it: the picture is laid out where nothing can be measured, too.
fn width(name: &str) -> f64 {
    // Signs of Chinese are as wide as they are high.
    name.chars()
        .map(|c| if c > '\u{1100}' { 13.5 } else { 8.2 })
        .sum::<f64>()
        + 18.0
}

impl Scene {
    /// The work origin and the axes in a plane, and nothing else.
    fn about(plane: Plane, view: Projection) -> Self {
        let spot = |p: Vec3| view.place(plane, p);
        let (basis, names) = (plane.basis(), plane.axes().map(|axis| AXIS_NAMES[axis]));
        Scene {
            origin: spot(Vec3::ZERO),
            axes: [0, 1, 2].map(|i| (names[i], spot(basis[i]))),
            ..Scene::default()
        }
    }

    /// Takes in the scene of a cycle of a set-up with this name, whose first move has this index; `pale` where it is not the one in hand. Its dimensions, its angles and its
    /// handles come with the one in hand alone.
    pub fn take(&mut self, own: Scene, name: &str, first_move: usize, pale: bool) {
        // Top sides are known by their surfaces, of which no cycle has so many.
        const APART: usize = 1000;
        self.cycles += 1;
        let apart = |top: Option<usize>| top.map(|top| top + APART * self.cycles);
        self.walls
            .extend(own.walls.into_iter().map(|wall| WallShape {
                top: apart(wall.top),
                ..wall
            }));
        self.tops.extend(own.tops.into_iter().map(|top| Top {
            of: top.of + APART * self.cycles,
            ..top
        }));
        self.blocks.extend(own.blocks);
        self.material.extend(own.material);
        let line = |line: Line| Line {
            behind: apart(line.behind),
            index: line.index + first_move,
            pale: line.pale || pale,
            ..line
        };
        self.lines.extend(own.lines.into_iter().map(line));
        self.touches.extend(
            own.touches
                .into_iter()
                .enumerate()
                .map(|(k, touch)| TouchShape {
                    named: (k == 0).then(|| name.to_owned()),
                    behind: apart(touch.behind),
                    index: touch.index.map(|index| index + first_move),
                    pale,
                    ..touch
                }),
        );
        self.radius = own.radius;
        if pale {
            return;
        }
        (self.dimensions, self.angles, self.spread) = (own.dimensions, own.angles, own.spread);
        (self.turn, self.handle, self.centre_lines) = (own.turn, own.handle, own.centre_lines);
    }

    /// Makes room for what is said of its dimensions and angles, by their fields' paths.
    pub fn name(&mut self, names: &[(&'static str, String)]) {
        let dimensions = self
            .dimensions
            .iter_mut()
            .map(|drawn| (drawn.field, &mut drawn.wide));
        for (own, wide) in dimensions.chain(
            self.angles
                .iter_mut()
                .map(|angle| (angle.field, &mut angle.wide)),
        ) {
            *wide = names
                .iter()
                .find(|(field, _)| *field == own)
                .map_or(0.0, |(_, name)| width(name));
        }
    }

    /// Where the ball is when such a part of a move is done, 0 to 1. The way past a nominal contact is no part of it.
    pub fn ball(&self, index: usize, part: f64) -> Option<Vec2> {
        let pieces: Vec<&Line> = self
            .lines
            .iter()
            .filter(|l| l.index == index && l.stroke != Stroke::Overtravel)
            .collect();
        let whole: f64 = pieces.iter().map(|l| l.from.distance(l.to)).sum();
        let mut rest = whole * part;
        for line in &pieces {
            let way = line.from.distance(line.to);
            if rest <= way && way > 0.0 {
                return Some(line.from.lerp_monotonic(line.to, rest / way));
            }
            rest -= way;
        }
        self.ends.get(index).copied()
    }

    /// The smallest and largest spot of everything that must be seen.
    pub fn bounds(&self) -> [Vec2; 2] {
        let balls = self.touches.iter().flat_map(|t| [t.contact, t.ball]);
        let ends = self
            .ends
            .iter()
            .flat_map(|end| [*end - self.radius, *end + self.radius]);
        let walls = self.walls.iter().flat_map(|w| w.corners);
        let start = [Vec2::INFINITY, Vec2::NEG_INFINITY];
        let bounds = balls
            .chain(ends)
            .chain(walls)
            .chain(
                self.blocks
                    .iter()
                    .flat_map(|block| block.corners.iter().copied()),
            )
            .chain(self.beyond.iter().copied())
            .chain(self.related.iter().flatten().copied())
            // In this order, since a place that is not known is no number.
            .fold(start, |[low, high], place| {
                [place.min(low), place.max(high)]
            });
        // A cycle without a path has nothing to show but its origin.
        if bounds[0].x.is_finite() {
            bounds
        } else {
            [Vec2::splat(-50.0), Vec2::splat(50.0)]
        }
    }

    /// The move whose line is nearest to `at`, if one is within `reach` (both mm). Of lines that lie on each other a touch
    /// wins over the way back.
    pub fn pick(&self, at: Vec2, reach: f64) -> Option<usize> {
        let rank = |stroke: Stroke| match stroke {
            Stroke::Touch => 0.0,
            Stroke::Overtravel => 1.0,
            Stroke::Position => 2.0,
            Stroke::Link => 3.0,
        };
        self.lines
            .iter()
            .map(|line| {
                (
                    distance(at, line.from, line.to) + rank(line.stroke) * reach * 0.05,
                    line,
                )
            })
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
            assert_eq!(Projection::Top.place(plane, a), Vec2::X);
            assert_eq!(Projection::Top.place(plane, o), Vec2::Y);
            assert_eq!(Projection::Front.place(plane, w), Vec2::Y);
            assert_eq!(Projection::Side.place(plane, o), Vec2::X);
        }
    }

    #[test]
    fn isometric_axes_have_equal_lengths_and_up_is_up() {
        let lengths: Vec<f64> = Plane::G17
            .basis()
            .iter()
            .map(|&e| Projection::Isometric.place(Plane::G17, e).length())
            .collect();
        assert!(
            lengths
                .iter()
                .all(|l| (l - (2f64 / 3.0).sqrt()).abs() < 1e-12),
            "{lengths:?}"
        );
        let up = Projection::Isometric.place(Plane::G17, Vec3::Z);
        assert!(up.x.abs() < 1e-12 && up.y > 0.0);
    }

    #[test]
    fn distance_to_a_segment_by_hand() {
        assert_eq!(
            distance(Vec2::new(5.0, 3.0), Vec2::ZERO, Vec2::X * 10.0),
            3.0
        );
        assert_eq!(
            distance(Vec2::new(13.0, 4.0), Vec2::ZERO, Vec2::X * 10.0),
            5.0
        );
        assert_eq!(distance(Vec2::new(3.0, 4.0), Vec2::ZERO, Vec2::ZERO), 5.0);
    }
}
