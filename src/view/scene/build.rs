//! Builds the scene of a job's path, with one function for each layer.

use crate::formula::{Operand, RelationDrawing};
use crate::geom::{Plane, Vec2, Vec3};
use crate::part::{PartRun, Stock};
use crate::path::{
    Feed, Feeds, Move, MovePurpose, Path, ProbeSettings, RelationSegment, Surface, Touch, Wall,
};
use crate::view::material::material;
use crate::view::scene::blocks::blocks;
use crate::view::scene::top_faces::{FarSides, body_with_top, breaks, tops};
use crate::view::scene::{
    Distance, Line, Projection, Scene, Stroke, TouchShape, drawn, drawn_angles, tilted,
};
use crate::view::walls::{WallShape, shape, strips};

/// Additions for the actual part.
#[derive(Debug)]
pub struct Actual<'a> {
    pub surfaces: &'a [Surface],
    /// Run of the path on those surfaces.
    pub run: &'a PartRun,
    /// Actual origin of the feature.
    pub origin: Vec3,
    /// Actual first direction.
    pub direction: Vec3,
    /// Actual line of the path.
    pub line: Option<[Vec3; 2]>,
    /// Magnification of the deviations of the part.
    pub magnify: f64,
}

/// Scene of a path. The material of a feature that `stock` contains is drawn with the stock.
pub fn build(
    path: &Path,
    setup: &ProbeSettings,
    feeds: &Feeds,
    actual: &Actual<'_>,
    (view, stock): (Projection, Option<&Stock>),
) -> Scene {
    let look = ViewSetup {
        path,
        setup,
        actual,
        view,
        stock,
        towards: view.towards(setup.plane),
    };
    let spot = |p: Vec3| look.spot(p);
    let mut scene = Scene {
        ends: path.moves.iter().map(|step| spot(step.to)).collect(),
        unit: Some(1.0),
        radius: setup.radius,
        centre_lines: look.centre_lines(),
        collision: actual
            .run
            .collision
            .map(|(index, center)| (index, spot(center))),
        ..Scene::about(setup.plane, view)
    };
    let backs = if view == Projection::Isometric && stock.is_some() {
        scene.walls = nearest_last(look.walls(|_, _| None));
        scene.dimensions = tilted(path, setup.plane, view);
        FarSides::default()
    } else if view == Projection::Isometric {
        scene.walls = nearest_last(look.walls(body_with_top));
        scene.tops = tops(path, spot);
        scene.blocks = blocks(path, look.towards, spot);
        scene.dimensions = tilted(path, setup.plane, view);
        FarSides::of(path, look.towards)
    } else {
        // Walls are seen edge-on, and lengths along the picture in true size.
        scene.walls = look
            .walls(|_, _| None)
            .into_iter()
            .map(|(_, shape)| shape)
            .collect();
        if stock.is_none() {
            scene.material = material(&path.surfaces, &path.frame, spot, view == Projection::Top);
        }
        scene.dimensions = drawn(path, setup.plane, view);
        scene.angles = drawn_angles(path, setup.plane, view);
        FarSides::default()
    };
    scene.lines = look.lines(feeds, &backs);
    scene.touches = look.touches(&backs);
    if view == Projection::Top {
        let spread = path
            .feature
            .two_circles()
            .and_then(|circles| circles.spread);
        scene.spread = spread.map(|s| (spot(s.center), s.radius, s.start, s.sweep));
        scene.turn = Some((spot(path.frame.origin), spot(path.frame.u)));
        // A magnified part cannot be dragged.
        let dragged = actual.magnify == 1.0 && !path.touches.is_empty();
        scene.handle = dragged.then(|| (spot(actual.origin), spot(actual.direction)));
    }
    scene
}

/// Link moves between the cycles of a set-up, and ends of its moves: the scenes of its cycles are added to this one.
pub fn between(
    path: &Path,
    setup: &ProbeSettings,
    feeds: &Feeds,
    collision: Option<(usize, Vec3)>,
    view: Projection,
) -> Scene {
    let spot = |p: Vec3| view.place(setup.plane, p);
    let mut scene = Scene {
        ends: path.moves.iter().map(|step| spot(step.to)).collect(),
        unit: Some(1.0),
        radius: setup.radius,
        collision: collision.map(|(index, center)| (index, spot(center))),
        related: related(path, setup.plane)
            .map(|line| line.map(&spot))
            .collect(),
        distances: distances(path, setup.plane)
            .map(|(name, length, line)| Distance {
                name: name.to_owned(),
                ends: line.map(&spot),
                length,
            })
            .collect(),
        ..Scene::about(setup.plane, view)
    };
    for member in path.cycles.iter().skip(1) {
        // A cycle without a stated start moves to its first position.
        let own = usize::from(member.path.start.is_none());
        let first = path
            .cycles
            .iter()
            .map(|other| other.moves.end)
            .filter(|end| *end <= member.moves.start)
            .max()
            .unwrap_or(0);
        for index in first..member.moves.start + own {
            let (from, step) = (path.moves[index - 1].to, &path.moves[index]);
            let line = Line {
                from: spot(from),
                to: spot(step.to),
                stroke: stroke(step),
                rapid: feeds.is_rapid(step.feed),
                back: false,
                occluder: None,
                pale: true,
                index,
            };
            scene.lines.push(line);
        }
    }
    scene
}

/// Number of chords that draw a circle.
const CHORDS: usize = 72;

/// Greatest height of these cycles along the tool axis.
fn height(path: &Path, plane: Plane, members: &[usize]) -> f64 {
    let [.., w] = plane.basis();
    members
        .iter()
        .map(|member| path.cycles[*member].path.frame.origin.dot(w))
        .fold(f64::NEG_INFINITY, f64::max)
}

/// Positions that a relation uses, on the nominal part.
fn places(path: &Path, plane: Plane, relation: &RelationSegment) -> Vec<Vec3> {
    let [a, o, w] = plane.basis();
    let nominal = |result: usize| path.formula.results[result].nominal;
    let place = |operand: &Operand| match *operand {
        Operand::Place([x, y]) => {
            let height = height(path, plane, &path.sources(x));
            Some(a * nominal(x) + o * nominal(y) + w * height)
        }
        Operand::Result(_) => None,
    };
    relation.own.of.iter().filter_map(place).collect()
}

/// Name, length and line of each distance that a relation measures.
fn distances(path: &Path, plane: Plane) -> impl Iterator<Item = (&str, f64, [Vec3; 2])> {
    path.relations
        .iter()
        .filter(|relation| relation.own.relation.drawing == RelationDrawing::Line)
        .map(move |relation| {
            let places = places(path, plane, relation);
            let length = path.formula.results[relation.results.start].nominal;
            (relation.name.as_str(), length, [places[0], places[1]])
        })
}

/// Lines of the relations on the nominal part, at the height of the highest cycle that each one uses.
fn related(path: &Path, plane: Plane) -> impl Iterator<Item = [Vec3; 2]> {
    let [a, o, w] = plane.basis();
    let nominal = |result: usize| path.formula.results[result].nominal;
    path.relations.iter().flat_map(move |relation| {
        let places = places(path, plane, relation);
        let own = |k: usize| nominal(relation.results.start + k);
        let middle = || a * own(0) + o * own(1) + w * height(path, plane, &relation.sources);
        let lines: Vec<[Vec3; 2]> = match relation.own.relation.drawing {
            RelationDrawing::Line => vec![[places[0], places[1]]],
            RelationDrawing::Middle => places.iter().map(|place| [middle(), *place]).collect(),
            RelationDrawing::Circle => {
                let at = |k: usize| {
                    let (sin, cos) = (std::f64::consts::TAU * k as f64 / CHORDS as f64).sin_cos();
                    middle() + (a * cos + o * sin) * (own(2) / 2.0)
                };
                (0..CHORDS).map(|k| [at(k), at(k + 1)]).collect()
            }
            RelationDrawing::Nothing => Vec::new(),
        };
        lines
    })
}

/// Input of the scene with the viewing direction.
struct ViewSetup<'a> {
    path: &'a Path,
    setup: &'a ProbeSettings,
    actual: &'a Actual<'a>,
    view: Projection,
    stock: Option<&'a Stock>,
    /// Direction to the viewer.
    towards: Vec3,
}

/// A wall and its distance towards the viewer.
type WallDepth = (f64, WallShape);

impl ViewSetup<'_> {
    fn spot(&self, p: Vec3) -> Vec2 {
        self.view.place(self.setup.plane, p)
    }

    fn stretch(&self, nominal: Vec2, real: Vec2) -> Vec2 {
        nominal.lerp_monotonic(real, self.actual.magnify)
    }

    fn shape(&self, wall: &Wall) -> WallShape {
        let faces = wall.normal.dot(self.towards) > 0.0;
        WallShape {
            faces,
            ..shape(&self.ended(*wall), self.path.frame.w, |p| self.spot(p))
        }
    }

    /// A wall for drawing. One without a known top is as high as the stock.
    fn ended(&self, wall: Wall) -> Wall {
        let up = self.path.frame.w;
        match self.stock {
            Some(stock) if !wall.has_top && wall.normal.dot(up).abs() < 1e-6 => Wall {
                point: wall.point + up * (stock.top(up) - wall.point.dot(up)),
                drawn_depth: (stock.high - stock.low).dot(up),
                has_top: true,
                ..wall
            },
            _ => wall,
        }
    }

    /// A projected surface. The strips of a round one stay together, to be drawn at once.
    fn surface(&self, surface: &Surface) -> Vec<WallDepth> {
        match surface {
            Surface::Flat(wall) => vec![(wall.point.dot(self.towards), self.shape(wall))],
            Surface::Unknown => Vec::new(),
            Surface::Round(round) => {
                let far = round.center.dot(self.towards);
                let strips = strips(round, &self.path.frame);
                strips
                    .iter()
                    .map(|wall| {
                        (
                            far,
                            WallShape {
                                strip: true,
                                ..self.shape(wall)
                            },
                        )
                    })
                    .collect()
            }
        }
    }

    /// Walls of the actual part, which are the displaced nominal ones, corner for corner; then the nominal ones. `topped` returns the surface whose top side is
    /// above a surface.
    fn walls(&self, topped: fn(&Path, usize) -> Option<usize>) -> Vec<WallDepth> {
        let nominal = &self.path.surfaces;
        let displaced = |(real, nominal): (&Surface, &Surface)| {
            let mut walls = self.surface(real);
            for ((_, real), (_, nominal)) in walls.iter_mut().zip(self.surface(nominal)) {
                real.actual = true;
                for (corner, from) in real.corners.iter_mut().zip(nominal.corners) {
                    *corner = self.stretch(from, *corner);
                }
                if let (Some(ends), Some(from)) = (&mut real.edge, nominal.edge) {
                    *ends = [0, 1].map(|i| self.stretch(from[i], ends[i]));
                }
            }
            walls
        };
        let below = |k: usize| {
            let top = topped(self.path, k);
            let mut walls = self.surface(&nominal[k]);
            if top == Some(k) {
                walls.extend(
                    breaks(self.path, k)
                        .iter()
                        .map(|wall| (wall.point.dot(self.towards), self.shape(wall))),
                );
            }
            // The far side of a body with a top is behind it.
            walls.retain(|(_, shape)| top.is_none() || shape.faces);
            walls.iter_mut().for_each(|(_, shape)| shape.top = top);
            walls
        };
        let mut walls: Vec<WallDepth> = self
            .actual
            .surfaces
            .iter()
            .zip(nominal)
            .flat_map(displaced)
            .collect();
        walls.extend((0..nominal.len()).flat_map(below));
        walls
    }

    /// The moves, and the search past each touch.
    fn lines(&self, feeds: &Feeds, backs: &FarSides) -> Vec<Line> {
        let mut lines = Vec::new();
        let mut at = self.path.start;
        let up = self.path.frame.w;
        let top = self
            .path
            .touches
            .iter()
            .map(|touch| touch.point.dot(up))
            .fold(f64::NEG_INFINITY, f64::max);
        // A long move at a clearance height, not one that crosses the part a little above its top.
        let clear = top + 30.0 * self.setup.radius.max(1.0);
        let high = |ends: [Vec3; 2]| {
            self.view == Projection::Top && ends.iter().all(|end| end.dot(up) > clear)
        };
        for (index, step) in self.path.moves.iter().enumerate() {
            let (rapid, back) = (
                feeds.is_rapid(step.feed),
                matches!(step.purpose, MovePurpose::Retract(_)),
            );
            let mut start = at.unwrap_or(step.to);
            for end in step.pieces(start, self.path.frame.w, 3.0) {
                let (from, to, behind) =
                    (self.spot(start), self.spot(end), backs.before([start, end]));
                let pale = high([start, end]);
                lines.push(Line {
                    from,
                    to,
                    stroke: stroke(step),
                    rapid,
                    back,
                    occluder: behind,
                    pale,
                    index,
                });
                start = end;
            }
            if let MovePurpose::Touch(k) = step.purpose {
                let end = step.to - self.path.touches[k].vector * self.path.touches[k].search;
                let (from, to, behind) = (
                    self.spot(step.to),
                    self.spot(end),
                    backs.before([step.to; 2]),
                );
                lines.push(Line {
                    from,
                    to,
                    stroke: Stroke::Overtravel,
                    rapid: false,
                    back: false,
                    occluder: behind,
                    pale: false,
                    index,
                });
            }
            at = Some(step.to);
        }
        lines
    }

    fn touches(&self, backs: &FarSides) -> Vec<TouchShape> {
        let shape = |(k, touch): (usize, &Touch)| {
            let center = touch.contact(self.setup.radius);
            let ball = self.spot(center);
            TouchShape {
                contact: self.spot(touch.point),
                ball,
                trigger: self.actual.run.triggers[k].map(|p| self.stretch(ball, self.spot(p))),
                number: k + 1,
                named: None,
                pale: false,
                inward: self.spot(touch.vector),
                index: self
                    .path
                    .moves
                    .iter()
                    .position(|step| step.purpose == MovePurpose::Touch(k)),
                behind: backs.before([center; 2]),
            }
        };
        self.path.touches.iter().enumerate().map(shape).collect()
    }

    fn centre_lines(&self) -> Option<[[Vec2; 2]; 2]> {
        let nominal = self.path.feature.two_circles()?.line?.map(|p| self.spot(p));
        let real = self.actual.line?.map(|p| self.spot(p));
        Some([nominal, [0, 1].map(|i| self.stretch(nominal[i], real[i]))])
    }
}

fn stroke(step: &Move) -> Stroke {
    match (step.purpose, step.feed) {
        (MovePurpose::Touch(_) | MovePurpose::Search(_), _) => Stroke::Touch,
        (
            MovePurpose::Position | MovePurpose::Retract(_),
            Feed::Approach | Feed::Retract | Feed::Return | Feed::Rapid,
        ) => Stroke::Position,
        (
            MovePurpose::Position | MovePurpose::Retract(_),
            Feed::LongLink | Feed::Work | Feed::Search,
        ) => Stroke::Link,
    }
}

/// Walls in drawing order, nearer ones later. Transparent ones come last: they veil what is behind them and hide nothing.
fn nearest_last(all: Vec<WallDepth>) -> Vec<WallShape> {
    let mut walls: Vec<WallDepth> = Vec::new();
    for wall in all {
        let lies_behind = |other: &WallDepth| {
            if other.1.faces == wall.1.faces {
                other.0 <= wall.0
            } else {
                other.1.faces
            }
        };
        walls.insert(walls.partition_point(lies_behind), wall);
    }
    walls.into_iter().map(|(_, shape)| shape).collect()
}
