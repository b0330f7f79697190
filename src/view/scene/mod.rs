//! What is seen, as data: lines, walls and discs in mm on the picture plane. No colours, no pixels.

pub mod program;
pub mod stylus;
pub mod tops;

use crate::geom::{AXIS_NAMES, Plane, Vec3};
use crate::part::Run;
use crate::path::{Feed, Feeds, Path, Purpose, Round, Setup, Surface, Wall};
use crate::view::dimension::{Angle, Dimension, angles, dimensions};
use crate::view::flat::{Spot, cross, distance, length, sub, width};
use crate::view::material::{Material, WallShape, material};
use crate::view::scene::tops::{Backs, Top, breaks, topped, tops};

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
#[derive(Clone, Debug, PartialEq)]
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

/// What the actual part adds.
#[derive(Debug)]
pub struct Actual<'a> {
    /// Its surfaces.
    pub surfaces: &'a [Surface],
    /// What happens there.
    pub run: &'a Run,
    /// Where the feature's origin really lies.
    pub origin: Vec3,
    /// Where its first direction really points.
    pub direction: Vec3,
    /// Where the path's line really lies.
    pub line: Option<[Vec3; 2]>,
    /// How many times larger than it is it is drawn how the part deviates.
    pub magnify: f64,
}

/// A spot so many times as far from where it should be.
pub fn stretched(nominal: Spot, real: Spot, times: f64) -> Spot {
    [0, 1].map(|i| nominal[i] + (real[i] - nominal[i]) * times)
}

/// The scene of a path.
pub fn build(path: &Path, setup: &Setup, feeds: &Feeds, actual: &Actual<'_>, view: Projection) -> Scene {
    let spot = |p: Vec3| view.spot(setup.plane, p);
    let towards = view.towards(setup.plane);
    let one = |wall: &Wall, actual: bool, strip: bool| {
        let shape = wall_shape(wall, path.frame.w, &spot, actual);
        (wall.point.dot(towards), WallShape { strip, faces: wall.normal.dot(towards) > 0.0, ..shape })
    };
    let shape = |surface: &Surface, actual: bool| match surface {
        Surface::Flat(wall) => vec![one(wall, actual, false)],
        Surface::Unknown => Vec::new(),
        // The strips of one stand together, to be drawn in one.
        Surface::Round(round) => {
            let far = round.center.dot(towards);
            strips(round, path.frame.w, path.frame.u).iter().map(|wall| (far, one(wall, actual, true).1)).collect()
        }
    };
    let stretch = |nominal: Spot, real: Spot| stretched(nominal, real, actual.magnify);
    // A surface of the actual part is that of the nominal one elsewhere: corner for corner.
    let displaced = |(surface, nominal): (&Surface, &Surface)| {
        let mut shapes = shape(surface, true);
        for ((_, real), (_, nominal)) in shapes.iter_mut().zip(shape(nominal, false)) {
            for (corner, from) in real.corners.iter_mut().zip(nominal.corners) {
                *corner = stretch(from, *corner);
            }
            if let (Some(ends), Some(from)) = (&mut real.edge, nominal.edge) {
                *ends = [0, 1].map(|i| stretch(from[i], ends[i]));
            }
        }
        shapes
    };
    let real = actual.surfaces.iter().zip(&path.surfaces).flat_map(displaced);
    let nominal = (0..path.surfaces.len()).flat_map(|k| {
        let top = if view == Projection::Isometric { topped(&path.surfaces, k, path.frame.w) } else { None };
        // The far side of what has a top is behind it.
        let seen = move |(_, shape): &(f64, WallShape)| top.is_none() || shape.faces;
        let mut walls = shape(&path.surfaces[k], false);
        if top == Some(k) {
            walls.extend(breaks(&path.surfaces, k, path.frame.w, path.frame.u).iter().map(|wall| one(wall, false, false)));
        }
        walls.into_iter().filter(seen).map(move |(far, shape)| (far, WallShape { top, ..shape }))
    });
    let all = real.chain(nominal);
    let mut walls: Vec<(f64, WallShape)> = Vec::new();
    for wall in all {
        // What is seen through comes last, so that it veils what lies behind it and hides nothing.
        let lies_behind =
            |other: &(f64, WallShape)| if other.1.faces == wall.1.faces { other.0 <= wall.0 } else { other.1.faces };
        let place = if view == Projection::Isometric { walls.partition_point(lies_behind) } else { walls.len() };
        walls.insert(place, wall);
    }
    let walls = walls.into_iter().map(|(_, shape)| shape);
    let tops = if view == Projection::Isometric { tops(&path.surfaces, path.frame.w, path.frame.u, spot) } else { Vec::new() };
    let backs = if view == Projection::Isometric { Backs::of(path, towards) } else { Backs::default() };
    let mut lines = Vec::new();
    let mut at = path.start;
    for (index, step) in path.moves.iter().enumerate() {
        let from = at.unwrap_or(step.to);
        let stroke = match (step.purpose, step.feed) {
            (Purpose::Touch(_), _) => Stroke::Touch,
            (Purpose::Position | Purpose::Back(_), Feed::Approach | Feed::Retract | Feed::Return | Feed::Rapid) => {
                Stroke::Position
            }
            (Purpose::Position | Purpose::Back(_), Feed::LongLink | Feed::Work) => Stroke::Link,
        };
        let mut start = from;
        for end in step.pieces(from, path.frame.w, 3.0) {
            let back = matches!(step.purpose, Purpose::Back(_));
            let behind = backs.before([start, end]);
            lines.push(Line {
                from: spot(start),
                to: spot(end),
                stroke,
                rapid: feeds.is_rapid(step.feed),
                back,
                behind,
                index,
            });
            start = end;
        }
        if let Purpose::Touch(k) = step.purpose {
            let end = step.to - path.touches[k].vector * path.touches[k].search;
            let behind = backs.before([step.to; 2]);
            let (from, to, stroke) = (spot(step.to), spot(end), Stroke::Overtravel);
            lines.push(Line { from, to, stroke, rapid: false, back: false, behind, index });
        }
        at = Some(step.to);
    }
    let touches = path.touches.iter().enumerate().map(|(k, touch)| TouchShape {
        contact: spot(touch.point),
        ball: spot(touch.contact(setup.radius)),
        trigger: actual.run.triggers[k].map(|p| stretch(spot(touch.contact(setup.radius)), spot(p))),
        inward: spot(touch.vector),
        index: path.moves.iter().position(|step| step.purpose == Purpose::Touch(k)),
        behind: backs.before([touch.contact(setup.radius); 2]),
    });
    let circles = path.feature.two_circles();
    let basis = setup.plane.basis();
    let names = setup.plane.axes().map(|axis| AXIS_NAMES[axis]);
    // Isometric, walls are seen as faces.
    let seen = if view == Projection::Isometric { &[][..] } else { &path.surfaces };
    let material = material(
        seen,
        spot,
        |wall| wall_shape(wall, path.frame.w, &spot, false),
        |round| strips(round, path.frame.w, path.frame.u),
        view == Projection::Top,
    );
    Scene {
        walls: walls.collect(),
        tops,
        material,
        lines,
        touches: touches.collect(),
        ends: path.moves.iter().map(|m| spot(m.to)).collect(),
        beyond: Vec::new(),
        unit: Some(1.0),
        radius: setup.radius,
        stylus: Vec::new(),
        origin: spot(Vec3::ZERO),
        axes: [0, 1, 2].map(|i| (names[i], spot(basis[i]))),
        centre_lines: circles.and_then(|c| c.line).zip(actual.line).map(|(nominal, real)| {
            let nominal = nominal.map(spot);
            [nominal, [0, 1].map(|i| stretch(nominal[i], spot(real[i])))]
        }),
        spread: circles
            .and_then(|c| c.spread)
            .filter(|_| view == Projection::Top)
            .map(|s| (spot(s.center), s.radius, s.start, s.sweep)),
        collision: actual.run.collision.map(|(index, center)| (index, spot(center))),
        dimensions: drawn(path, setup.plane, view),
        angles: drawn_angles(path, setup.plane, view),
        // What is drawn larger than it is cannot be dragged by it.
        handle: (view == Projection::Top && actual.magnify == 1.0 && !path.touches.is_empty())
            .then(|| (spot(actual.origin), spot(actual.direction))),
    }
}

/// The dimensions that a projection shows in their true length; one that it shows shorter would mislead.
pub fn drawn(path: &Path, plane: Plane, view: Projection) -> Vec<Drawn> {
    let seen = |d: Dimension| {
        let length = d.from.distance(d.to);
        let ends = [d.from, d.to].map(|p| view.spot(plane, p));
        let along = sub(ends[1], ends[0]);
        if along[0].hypot(along[1]) < length * 0.999 || length < 1e-6 || view == Projection::Isometric {
            return None;
        }
        // A side that this projection looks along is replaced by the one square to the dimension.
        let side = view.spot(plane, d.aside);
        let size = side[0].hypot(side[1]);
        let square = [-along[1] / length, along[0] / length];
        let either = size <= 0.5;
        let aside = if either { square } else { [side[0] / size, side[1] / size] };
        Some(Drawn { field: d.field, ends, aside, either, length, on_demand: d.on_demand, wide: 0.0 })
    };
    dimensions(path).into_iter().filter_map(seen).collect()
}

/// The angles of a path that a view shows in their true size.
pub fn drawn_angles(path: &Path, plane: Plane, view: Projection) -> Vec<DrawnAngle> {
    let seen = |angle: Angle| {
        let [first, second] = angle.sides.map(|side| view.spot(plane, side));
        if [first, second].iter().any(|side| side[0].hypot(side[1]) < 0.999) || view == Projection::Isometric {
            return None;
        }
        let turn = (first[0] * second[1] - first[1] * second[0]).atan2(first[0] * second[0] + first[1] * second[1]);
        Some(DrawnAngle {
            field: angle.field,
            at: view.spot(plane, angle.at),
            turns: [first[1].atan2(first[0]), turn],
            room: angle.room,
            wide: 0.0,
        })
    };
    angles(path).into_iter().filter_map(seen).collect()
}

/// A round wall as flat strips.
#[inline(never)]
fn strips(round: &Round, up: Vec3, u: Vec3) -> Vec<Wall> {
    const COUNT: usize = 120;
    let v = up.cross(u);
    let half = round.radius * (std::f64::consts::PI / COUNT as f64).tan();
    (0..COUNT)
        .map(|i| {
            let (sin, cos) = (i as f64 * std::f64::consts::TAU / COUNT as f64).sin_cos();
            let out = u * cos + v * sin;
            Wall {
                point: round.center + out * round.radius,
                normal: if round.hole { -out } else { out },
                along: up.cross(out),
                extent: (-half, half),
                drawn_depth: round.drawn_depth,
                has_top: true,
                body: 0,
            }
        })
        .collect()
}

fn wall_shape(wall: &Wall, up: Vec3, spot: &impl Fn(Vec3) -> Spot, actual: bool) -> WallShape {
    let (start, end) = (wall.point + wall.along * wall.extent.0, wall.point + wall.along * wall.extent.1);
    // Along the wall and across it; upwards where it goes up at all.
    let across = wall.normal.cross(wall.along).normalize_or(up);
    let down = (if across.dot(up) < 0.0 { -across } else { across }) * wall.drawn_depth;
    let raised = if wall.has_top { Vec3::ZERO } else { down };
    let corners = [start + raised, end + raised, end - down, start - down].map(spot);
    let area: f64 = (0..4).map(|i| cross(corners[i], corners[(i + 1) % 4])).sum::<f64>().abs() / 2.0;
    let edge = (area < 1e-6 * (1.0 + length(sub(corners[0], corners[2])).powi(2))).then(|| {
        if length(sub(corners[0], corners[1])) > length(sub(corners[1], corners[2])) {
            [corners[0], corners[1]]
        } else {
            [corners[1], corners[2]]
        }
    });
    WallShape { corners, edge, actual, strip: false, faces: true, top: None }
}

impl Scene {
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
