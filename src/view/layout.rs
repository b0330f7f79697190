//! Layout of dimensions and angles in a picture: in free areas if there are any.

use crate::geom::Vec2;
use crate::view::camera::{
    AXES_CORNER, AXES_REACH, BAR_CORNER, BAR_REACH, CUBE_CORNER, Camera, DIMENSION_MARGIN,
    DOWNWARDS, MARGIN, SMALL_MARGIN,
};
use crate::view::label_box::{CUT_OFF, LabelBox, OccupiedSpace};
use crate::view::numbers::Number;
use crate::view::scene::{DrawnAngle, DrawnDimension, Line, Scene, Stroke};

/// Distance of a dimension line that comes with the focus from the part, pixels.
const ON_DEMAND: f64 = 16.0;
/// Stands for the focused field: all heights are drawn.
const EVERY: &str = "*";
/// Its distance from anything else that extends beyond the part.
const CLEAR: f64 = 18.0;
/// Half the height of a name with its margin.
const HIGH: f64 = 12.0;
/// A line at least this long has its arrow heads between its ends; otherwise they point at them from outside.
const HEADS: f64 = 28.0;

/// Radius of an angle's arc, pixels, if there is room for it.
const ANGLE_RADIUS: f64 = 54.0;
/// A name has room if the nearest touch is farther than this from the vertex, pixels.
const ROOM_FOR_NAME: f64 = 90.0;

/// A laid-out dimension, pixels.
#[derive(Clone, Copy, Debug)]
pub struct PlacedDimension<'a> {
    pub drawn: &'a DrawnDimension,
    /// Start of its extension lines.
    pub ends: [Vec2; 2],
    /// Ends of its line.
    pub line: [Vec2; 2],
    /// Drawn ends of the line: beyond its ends to outer arrow heads and to its name.
    pub reach: [Vec2; 2],
    /// Whether its arrow heads are between its ends.
    pub within: bool,
    /// Position of its name.
    pub name: LabelBox,
}

/// A laid-out angle, pixels.
#[derive(Clone, Copy, Debug)]
pub struct AngleArc<'a> {
    pub angle: &'a DrawnAngle,
    /// Its vertex.
    pub at: Vec2,
    pub radius: f64,
    /// Far ends of its two sides, a little beyond the arc.
    pub sides: [Vec2; 2],
    /// Ends of the arc, each with the direction of its arrow head; `None` on an arc that is too short for them.
    pub heads: Option<[(Vec2, Vec2); 2]>,
    pub ends: [Vec2; 2],
    /// Its name; `None` if it would cover touches.
    pub name: Option<LabelBox>,
}

/// Contents of a picture beside the part and its path.
#[derive(Clone, Debug)]
pub struct Layout<'a> {
    pub numbers: Vec<Number>,
    /// The angles.
    pub arcs: Vec<AngleArc<'a>>,
    pub dimensions: Vec<PlacedDimension<'a>>,
    /// Everything in the picture.
    pub crowd: OccupiedSpace,
}

impl PlacedDimension<'_> {
    /// Tips of its arrow heads, and their directions.
    pub fn heads(&self) -> [(Vec2, Vec2); 2] {
        let [start, end] = self.line;
        let out =
            (end - start) / start.distance(end).max(1e-9) * if self.within { 1.0 } else { -1.0 };
        [(start, -out), (end, out)]
    }
}

/// Reading direction along a line: from below, or from the right.
fn readable(way: Vec2) -> Vec2 {
    if way.x < -1e-6 || (way.x < 1e-6 && way.y > 0.0) {
        -way
    } else {
        way
    }
}

impl Layout<'_> {
    /// Texts of the angles and the dimensions, with the paths of their fields and their positions.
    pub fn names<'n>(
        &self,
        names: &'n [(&'static str, String)],
    ) -> Vec<(&'static str, &'n str, LabelBox)> {
        let mut said = Vec::new();
        let mut say = |own: &'static str, plate: LabelBox| {
            let name = names
                .iter()
                .find(|(field, _)| *field == own)
                .map_or("", |(_, name)| name.as_str());
            said.push((own, name, plate));
        };
        self.arcs.iter().for_each(|arc| {
            arc.name
                .into_iter()
                .for_each(|plate| say(arc.angle.field, plate))
        });
        self.dimensions
            .iter()
            .for_each(|placed| say(placed.drawn.field, placed.name));
        said
    }

    /// Free position of the scale bar, with this half size: in the lower right corner, else in another one; `None` if all are occupied. The upper right corner
    /// is kept free for the page's view cube.
    pub fn bar(&self, camera: &Camera, half: Vec2) -> Option<Vec2> {
        let far = camera.size - half - BAR_CORNER;
        let near = half + BAR_CORNER;
        let past = near.x + AXES_CORNER + AXES_REACH;
        let lines: Vec<[Vec2; 2]> = self.dimensions.iter().map(|placed| placed.reach).collect();
        let places = [far, Vec2::new(past, far.y), near];
        places.into_iter().find(|middle| {
            let plate = LabelBox {
                middle: *middle,
                along: Vec2::X,
                half,
            };
            self.crowd.leaves(&plate) && !lines.iter().any(|line| plate.crosses(*line, 1.0))
        })
    }

    /// Position for the name of a distance beside its line, where it covers nothing. `half`: half its size. `None` if every position is taken.
    pub fn distance(&self, [from, to]: [Vec2; 2], half: Vec2) -> Option<Vec2> {
        let aside = (to - from).perp().normalize_or_zero();
        let off = aside * (half.dot(aside.abs()) + 4.0);
        [0.5, 0.4, 0.6, 0.3, 0.7]
            .into_iter()
            .flat_map(|along| [off, -off].map(|off| from.lerp(to, along) + off))
            .find(|middle| {
                self.crowd.leaves(&LabelBox {
                    middle: *middle,
                    along: Vec2::X,
                    half,
                })
            })
    }

    /// Position for the name of the work origin: in the freest of the four corners about it. `half`: half its size.
    pub fn origin(&self, at: Vec2, half: Vec2) -> LabelBox {
        let plate = |x: f64, y: f64| LabelBox {
            middle: at + Vec2::new(x * (half.x + 11.0), y * 16.0),
            along: Vec2::X,
            half,
        };
        let corners = [
            plate(1.0, 1.0),
            plate(1.0, -1.0),
            plate(-1.0, 1.0),
            plate(-1.0, -1.0),
        ];
        let costs = corners.map(|corner| self.crowd.cost(&corner));
        corners[(1..4).fold(0, |best, k| if costs[k] < costs[best] { k } else { best })]
    }
}

impl Camera {
    /// A window of this size that shows a whole scene with its dimensions: the initial view of every picture.
    pub fn whole(size: Vec2, scene: &Scene) -> Self {
        let empty = Camera {
            scale: 1.0,
            middle: Vec2::ZERO,
            size,
        };
        let mut camera = Camera::fit(size, scene.bounds(), empty.margin(scene));
        camera.clear_corners(scene);
        camera
    }

    /// Margin around a fitted scene, pixels.
    pub fn margin(&self, scene: &Scene) -> f64 {
        if scene.dimensions.is_empty() {
            MARGIN
        } else {
            self.dimension_margin()
        }
    }

    /// Moves a fitted scene up where the names of its dimensions would lie on the axes or on the scale bar, and to the left where it would lie under the view
    /// cube, if there is room.
    fn clear_corners(&mut self, scene: &Scene) {
        let Vec2 {
            x: width,
            y: height,
        } = self.size;
        let axes = [AXES_CORNER + AXES_REACH, height - AXES_CORNER - AXES_REACH];
        let unit = scene.unit.unwrap_or(1.0);
        let bar = [
            width - 2.0 * BAR_CORNER - self.bar(unit) * unit * self.scale,
            height - BAR_REACH,
        ];
        let [low, high] = scene.bounds();
        let (corner, mut left) = (self.pixel(high), self.pixel(low).x);
        let (mut top, mut under) = (corner.y, 0.0_f64);
        for placed in self.layout(scene, None).dimensions {
            let [low, high] = placed.name.bounds();
            let ends = placed.line.iter();
            (left, top) = ends.fold((left.min(low.x), top.min(low.y)), |(left, top), end| {
                (left.min(end.x), top.min(end.y))
            });
            if low.x < axes[0] {
                under = under.max(high.y - axes[1]);
            }
            if high.x > bar[0] {
                under = under.max(high.y - bar[1]);
            }
        }
        let up = under.min((top - MARGIN).max(0.0));
        // Without covering the axes.
        let least = if self.pixel(low).y - up > axes[1] {
            axes[0]
        } else {
            SMALL_MARGIN
        };
        let across = if corner.y - up < CUBE_CORNER {
            let covered = corner.x - width + CUBE_CORNER;
            crate::num::within(covered, 0.0, (left - least).max(0.0))
        } else {
            0.0
        };
        self.pan(-Vec2::new(across, up));
    }

    /// Arrow head of a line: tip, direction and size. For a touch at its contact, for any other move along it, if it is long enough for one in each direction.
    /// The retract along a touch has none.
    pub fn head(&self, line: &Line) -> Option<(Vec2, Vec2, f64)> {
        let (start, end) = (self.pixel(line.from), self.pixel(line.to));
        let far = start.distance(end);
        let (least, tip) = match line.stroke {
            Stroke::Touch => (1.0, far),
            Stroke::Position | Stroke::Link => (40.0, (0.62 * far).max(far / 2.0 + 14.0)),
            Stroke::Overtravel => return None,
        };
        let way = (end - start) / far;
        (far >= least && !line.back)
            .then(|| (start + way * tip, way, if far < 12.0 { 7.0 } else { 9.0 }))
    }

    /// Lays out the picture with an optional focused field. A dimension that appears with the focus moves nothing else.
    pub fn layout<'a>(&self, scene: &'a Scene, focus: Option<&str>) -> Layout<'a> {
        let (crowd, numbers) = (OccupiedSpace::of(scene, self), self.numbers(scene));
        let mut layout = Layout {
            numbers,
            arcs: Vec::new(),
            dimensions: Vec::new(),
            crowd,
        };
        let crowd = &mut layout.crowd;
        crowd
            .plates
            .extend(layout.numbers.iter().map(|number| number.plate));
        for angle in &scene.angles {
            let arc = self.arc(angle, focus, crowd);
            crowd.plates.extend(arc.name);
            layout.arcs.push(arc);
        }
        let all = |on_demand: bool| {
            scene
                .dimensions
                .iter()
                .filter(move |d| d.on_demand == on_demand)
        };
        let upright = |d: &DrawnDimension| (d.ends[1].y - d.ends[0].y).abs() > 0.999 * d.length;
        let asked =
            |d: &DrawnDimension| focus == Some(d.field) || (focus == Some(EVERY) && upright(d));
        for drawn in all(false).chain(all(true).filter(|d| asked(d))) {
            let placed = self.dimension(drawn, crowd);
            crowd.plates.push(placed.name);
            layout.dimensions.push(placed);
        }
        layout
    }

    /// Position of a dimension and its name: the first one that covers nothing, else the one that covers least. The name is on the line if there is room
    /// between the arrow heads; else beyond one of the ends, or beside the line.
    fn dimension<'a>(
        &self,
        drawn: &'a DrawnDimension,
        crowd: &OccupiedSpace,
    ) -> PlacedDimension<'a> {
        let ends = drawn.ends.map(|spot| self.pixel(spot));
        let long = ends[0].distance(ends[1]).max(1e-9);
        let way = (ends[1] - ends[0]) / long;
        let within = long > HEADS;
        let tail = if within { 0.0 } else { 16.0 };
        let half = Vec2::new(drawn.wide / 2.0, HIGH);
        let along = readable(way);
        // Distance of the name from the middle of the line, along and across, and length of the line to it beyond each end.
        let off = half.x + f64::max(tail, 10.0);
        let (beyond, beside) = (off + long / 2.0, HIGH + 2.0);
        let beside_it = [
            [beyond, 0.0, 0.0, off],
            [-beyond, 0.0, off, 0.0],
            [0.0, beside, 0.0, 0.0],
            [0.0, -beside, 0.0, 0.0],
        ];
        // Between its arrow heads, with a little of the line visible: in the middle, or beside other names.
        let off_middle = ((long - drawn.wide) / 2.0 - 12.0).min(long / 4.0);
        let on_it = [
            [0.0; 4],
            [off_middle, 0.0, 0.0, 0.0],
            [-off_middle, 0.0, 0.0, 0.0],
        ];
        let on_line = match drawn.wide + 24.0 <= long {
            true if off_middle > HIGH => 3,
            true => 1,
            false => 0,
        };
        // Beside the line only if every position on it covers more than a few moves.
        let off_line = if on_line > 0 { 100.0 } else { 0.0 };
        let ranked = |k: usize| 4.0 * k as f64;
        let places: Vec<([f64; 4], f64)> = (on_it
            .into_iter()
            .take(on_line)
            .enumerate()
            .map(|(k, place)| (place, ranked(k))))
        .chain(
            beside_it
                .into_iter()
                .enumerate()
                .map(|(k, place)| (place, off_line + ranked(k))),
        )
        .collect();
        let placed = |side: Vec2, begin: f64, far: f64, [over, across, before, past]: [f64; 4]| {
            let line = ends.map(|end| end + side * far);
            let middle = line[0] + way * (long / 2.0 + over) + way.perp() * across;
            PlacedDimension {
                drawn,
                ends: ends.map(|end| end + side * begin),
                line,
                reach: [
                    line[0] - way * f64::max(tail, before),
                    line[1] + way * f64::max(tail, past),
                ],
                within,
                name: LabelBox {
                    middle,
                    along,
                    half,
                },
            }
        };
        let own = drawn.line_side * DOWNWARDS;
        let stands_off = self.stands_off();
        let clear = CLEAR * self.dimension_margin() / DIMENSION_MARGIN;
        let first = places[0].0;
        let mut best = placed(own, 0.0, stands_off, first);
        let mut least = f64::INFINITY;
        // A dimension that appears with the focus changes sides only if there is no room on its own side.
        let other = if drawn.either { 0.1 } else { 100.0 };
        let sides = [(own, 0.0), (-own, other)];
        let mut tries = |places: &[([f64; 4], f64)]| {
            for (side, rank_of_side) in sides.into_iter().take(if drawn.either || drawn.on_demand {
                2
            } else {
                1
            }) {
                let [begins, walls, all] = crowd.beside(ends, side);
                // Extension lines begin at the end of the part.
                let (begin, near) = if drawn.on_demand {
                    (0.0, ON_DEMAND)
                } else {
                    let (close, clear) = (walls + stands_off, all + clear + HIGH);
                    // Clear of everything that extends beyond the part, if that is still in the picture.
                    let seen = placed(side, begins, clear, first)
                        .name
                        .bounds()
                        .iter()
                        .all(|at| crowd.sees(at));
                    (begins, if seen { close.max(clear) } else { close })
                };
                for step in 0..6 {
                    let far = near + f64::from(step) * (2.0 * HIGH + 4.0);
                    for (place, rank) in places {
                        // What it covers can only add to this.
                        let own = rank + rank_of_side + (far - begin) / 20.0;
                        if own >= least {
                            continue;
                        }
                        let one = placed(side, begin, far, *place);
                        // A name on the line, and a line that cannot be seen.
                        let line = one.line;
                        let struck = crowd
                            .plates
                            .iter()
                            .filter(|other| other.crosses(line, 2.0))
                            .count()
                            + 2 * line.iter().filter(|end| !crowd.sees(end)).count();
                        let cost = crowd.cost(&one.name) + 300.0 * struck as f64 + own;
                        if cost < least {
                            (least, best) = (cost, one);
                        }
                    }
                }
            }
            least
        };
        // If each of these is cut off by the edge or covers another name: beside the line, away from its middle.
        if tries(&places) >= CUT_OFF {
            // Up to the ends of the line, or just clear of a number in its middle.
            let shifts = [(long - drawn.wide).max(0.0) / 2.0, half.x + 2.0 * HIGH];
            let shifts = shifts.map(|shift| [shift, -shift]).concat();
            let aside = shifts
                .iter()
                .flat_map(|over| [beside, -beside].map(|across| [*over, across, 0.0, 0.0]));
            tries(&aside.map(|place| (place, off_line)).collect::<Vec<_>>());
        }
        best
    }

    /// An angle; the focused field always has its name.
    fn arc<'a>(
        &self,
        angle: &'a DrawnAngle,
        focus: Option<&str>,
        crowd: &OccupiedSpace,
    ) -> AngleArc<'a> {
        let at = self.pixel(angle.at);
        let room = angle.room * self.scale;
        let radius = ANGLE_RADIUS.min(room * 0.6);
        let [first, turn] = angle.turns;
        let way = |radians: f64| Vec2::from_angle(radians) * DOWNWARDS;
        let sides = [first, first + turn];
        let ends = sides.map(|side| at + way(side) * radius);
        // Along the arc, away from its middle.
        let head = |end: usize, sense: f64| (ends[end], way(sides[end]).perp() * -sense);
        let named = room > ROOM_FOR_NAME || focus == Some(angle.field);
        // Beyond the arc, as close as possible with the least covered.
        let plate = |far: f64| LabelBox {
            middle: at + way(first + turn / 2.0) * far,
            along: Vec2::X,
            half: Vec2::new(angle.wide / 2.0, HIGH),
        };
        let places = (0..24)
            .map(|k| radius + 8.0 * f64::from(k))
            .filter(|far| !plate(*far).covers(at, radius + 6.0));
        let cost = |far: f64| crowd.cost(&plate(far)) + far / 10.0;
        let best = places.fold(DIMENSION_MARGIN, |best, far| {
            if best == DIMENSION_MARGIN || cost(far) < cost(best) {
                far
            } else {
                best
            }
        });
        AngleArc {
            angle,
            at,
            radius,
            sides: sides.map(|side| at + way(side) * (radius + 8.0)),
            heads: (turn.abs() * radius > 22.0)
                .then(|| [head(0, -turn.signum()), head(1, turn.signum())]),
            ends,
            name: named.then(|| plate(best)),
        }
    }
}
