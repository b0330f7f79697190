//! The picture as data: lines, walls and discs in mm on the picture plane, without colours and pixels.

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

/// Viewing direction of the scene.
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

    /// Right and up of the picture as directions of (abscissa, ordinate, tool axis).
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

    /// Direction to the viewer, in the work coordinate system.
    fn towards(self, plane: Plane) -> Vec3 {
        let [right, up] = self.axes();
        let [a, o, w] = plane.basis();
        let local = right.cross(up);
        a * local.x + o * local.y + w * local.z
    }

    /// Projection of a point of the work coordinate system.
    pub fn place(self, plane: Plane, p: Vec3) -> Vec2 {
        let [a, o, w] = plane.axes();
        let local = Vec3::new(p[a], p[o], p[w]);
        self.axes().map(|axis| axis.dot(local)).into()
    }
}

/// Kind of a line of the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stroke {
    /// Approach, retract and return.
    Position,
    /// Long links, and retracts at that feed.
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
    /// Whether it is a retract.
    pub back: bool,
    /// Top side of the body that hides it.
    pub occluder: Option<usize>,
    /// Whether it is drawn pale: seen from the top it is high above the part, or it belongs to a cycle that is not active.
    pub pale: bool,
    /// Index of the move in the path.
    pub index: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub struct TouchShape {
    /// Nominal contact on the surface.
    pub contact: Vec2,
    /// Ball centre at that contact.
    pub ball: Vec2,
    /// Ball centre at the trigger on the actual part.
    pub trigger: Option<Vec2>,
    /// Number in its cycle, from 1.
    pub number: usize,
    /// Name of its cycle, at the first touch of each cycle in a set-up.
    pub named: Option<String>,
    /// Whether it is drawn pale: it belongs to a cycle that is not active.
    pub pale: bool,
    /// Direction away from the material, in which its number is placed.
    pub inward: Vec2,
    /// Index of its move.
    pub index: Option<usize>,
    /// Top side of the body that hides its ball.
    pub behind: Option<usize>,
}

/// Nominal distance between the two positions of a relation.
#[derive(Clone, Debug, PartialEq)]
pub struct Distance {
    /// Name of the relation.
    pub name: String,
    pub ends: [Vec2; 2],
    /// In mm.
    pub length: f64,
}

/// A dimension in the picture plane.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnDimension {
    /// Path of the job field with its value.
    pub field: &'static str,
    /// Ends on the part.
    pub ends: [Vec2; 2],
    /// Side of its line.
    pub line_side: Vec2,
    /// Whether the other side is as good.
    pub either: bool,
    /// Length, mm.
    pub length: f64,
    /// Whether it is drawn only while its field has the focus.
    pub on_demand: bool,
    /// Approximate width of its text, pixels.
    pub wide: f64,
}

/// An angle in the picture plane, in true size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnAngle {
    /// Path of the job field with its value.
    pub field: &'static str,
    /// Its vertex.
    pub at: Vec2,
    /// From the abscissa of the picture to its first side, and from there to its second, radians, counter-clockwise positive.
    pub turns: [f64; 2],
    /// Distance from its vertex to the nearest touch, mm.
    pub room: f64,
    /// Approximate width of its text, pixels.
    pub wide: f64,
}

/// Everything in a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Walls; the actual ones first, so that they are behind.
    pub walls: Vec<WallShape>,
    /// Isometric: top sides of bodies drawn whole.
    pub tops: Vec<Top>,
    /// Isometric: faces of the nominal material around inner features, in drawing order.
    pub blocks: Vec<Block>,
    /// Nominal material behind walls seen edge-on.
    pub material: Vec<Material>,
    /// The path.
    pub lines: Vec<Line>,
    pub touches: Vec<TouchShape>,
    /// Ends of the moves.
    pub ends: Vec<Vec2>,
    /// Further points that must be visible: arcs beyond their ends.
    pub beyond: Vec<Vec2>,
    /// Millimetres in a unit of the job or program, for the scale bar; `None` if a program does not state its units.
    pub unit: Option<f64>,
    /// Radius of the ball, mm.
    pub radius: f64,
    /// The stylus above its ball, about the ball centre.
    pub stylus: Vec<[Vec2; 4]>,
    /// The work origin.
    pub origin: Vec2,
    /// Names of the axes and their directions in the picture.
    pub axes: [(&'static str, Vec2); 3],
    /// Centre line of the cycle: nominal and actual.
    pub centre_lines: Option<[[Vec2; 2]; 2]>,
    /// Lines of the relations of a set-up, on the nominal part.
    pub related: Vec<[Vec2; 2]>,
    /// Distances that relations measure.
    pub distances: Vec<Distance>,
    /// Centre of the circle with spread touches, its radius (mm), and the angles of first touch and spread (radians). Only from the top.
    pub spread: Option<(Vec2, f64, f64, f64)>,
    /// Move that collides with the part, and ball centre there: later moves are not reached.
    pub collision: Option<(usize, Vec2)>,
    /// Dimensions of the nominal part that are visible in true length.
    pub dimensions: Vec<DrawnDimension>,
    /// Angles that are visible in true size.
    pub angles: Vec<DrawnAngle>,
    /// Origin of the nominal feature, and its first direction. Only from the top.
    pub turn: Option<(Vec2, Vec2)>,
    /// Origin of the actual feature, and its first direction: handles to move the part. Only from the top.
    pub handle: Option<(Vec2, Vec2)>,
    /// Number of cycles of a set-up that were added.
    pub cycles: usize,
}

/// Dimensions that a view along an axis shows in true length; a shortened one would mislead.
pub fn drawn(path: &Path, plane: Plane, view: Projection) -> Vec<DrawnDimension> {
    let seen = |d: Dimension| {
        let long = d.from.distance(d.to);
        let ends = [d.from, d.to].map(|p| view.place(plane, p));
        let along = ends[1] - ends[0];
        if along.length() < long * 0.999 || long < 1e-6 {
            return None;
        }
        // A side along this projection is replaced by the one perpendicular to the dimension.
        let side = view.place(plane, d.aside);
        let size = side.length();
        let either = size <= 0.5;
        let aside = if either {
            along.perp() / long
        } else {
            side / size
        };
        Some(DrawnDimension {
            field: d.field,
            ends,
            line_side: aside,
            either,
            length: long,
            on_demand: d.on_demand,
            wide: 0.0,
        })
    };
    dimensions(path).into_iter().filter_map(seen).collect()
}

/// Dimensions of a path in an isometric view, along the part as in an isometric drawing. Those that appear with the focus are omitted.
fn tilted(path: &Path, plane: Plane, view: Projection) -> Vec<DrawnDimension> {
    let seen = |d: Dimension| {
        let ends = [d.from, d.to].map(|p| view.place(plane, p));
        let (along, side) = (
            (ends[1] - ends[0]).normalize_or(Vec2::X),
            view.place(plane, d.aside).normalize_or(Vec2::Y),
        );
        // A line almost along the dimension would have no offset.
        let aside = if along.perp_dot(side).abs() < 0.4 {
            along.perp()
        } else {
            side
        };
        DrawnDimension {
            field: d.field,
            ends,
            line_side: aside,
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

/// Angles of a path that a view along an axis shows in true size.
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

/// Distance of a position from a segment.
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

/// Approximate width of a name with its margin, pixels: pictures are also laid out where text cannot be measured.
fn width(name: &str) -> f64 {
    // Chinese characters are as wide as high.
    name.chars()
        .map(|c| if c > '\u{1100}' { 13.5 } else { 8.2 })
        .sum::<f64>()
        + 18.0
}

impl Scene {
    /// Only the work origin and the axes in a plane.
    fn about(plane: Plane, view: Projection) -> Self {
        let spot = |p: Vec3| view.place(plane, p);
        let (basis, names) = (plane.basis(), plane.axes().map(|axis| AXIS_NAMES[axis]));
        Scene {
            origin: spot(Vec3::ZERO),
            axes: [0, 1, 2].map(|i| (names[i], spot(basis[i]))),
            ..Scene::default()
        }
    }

    /// Adds the scene of a set-up's cycle with this name, whose first move has this index; `pale` if it is not active. Dimensions, angles and handles come with
    /// the active cycle only.
    pub fn take(&mut self, own: Scene, name: &str, first_move: usize, pale: bool) {
        // Top sides are identified by their surfaces; no cycle has this many.
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
            occluder: apart(line.occluder),
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

    /// Reserves room for the texts of its dimensions and angles, by the paths of their fields.
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

    /// Ball centre after a fraction of a move, 0 to 1. The search past a nominal contact does not belong to the move.
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

    /// Smallest and largest point of everything that must be visible.
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
            // In this order, since an unknown position is NaN.
            .fold(start, |[low, high], place| {
                [place.min(low), place.max(high)]
            });
        // A cycle without a path has only its origin.
        if bounds[0].x.is_finite() {
            bounds
        } else {
            [Vec2::splat(-50.0), Vec2::splat(50.0)]
        }
    }

    /// The move whose line is closest to `at`, if one is within `reach` (both mm). Of coinciding lines a touch has priority over its retract.
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
