//! Plans the macro calls for a feature, the path that they make, and their results.

use super::macros::{self, FAST, MEASURE, SEARCH};
use crate::control::ResultOutput;
use crate::control::edition::Edition;
use crate::control::native_run::executed_path::{self, path_of_moves};
use crate::control::native_run::machine::{Alarm, Machine};
use crate::control::native_run::{
    ContactQuery, CycleLinking, NativeRequest, NativeRun, Rejections, degrees_of, refused,
};
use crate::formula::{Draft, Formula, OffsetCorrection, Role, SingleTouch};
use crate::geom::{Plane, Vec3};
use crate::path::{
    Bore, CallBlock, CallSequence, Corner, Feature, Feed, Feeds, FieldValue, Guard, Off, Pairs,
    ParameterValue, Path, Point, ProbeTable, Quantity, STATED_RAPID, Stored, Surface, Touch,
    TwoCircles,
};
use crate::text::{Text, text, words};

/// First variable that saves a result: the macros use none below #116.
const FIRST_KEPT: usize = 101;

/// Last variable that saves a result.
const LAST_KEPT: usize = 115;

/// Smallest distance from the start of a touch to its contact, mm: below it the macro reports a contact at the start.
const LEAST_CLEARANCE: f64 = 0.2;

/// Tolerance for equal directions and positions.
const NEAR: f64 = 1e-6;

/// Path of the macros for a job's feature, with the calls.
pub fn plan_calls(
    request: &NativeRequest<'_>,
    meets: ContactQuery<'_>,
) -> Result<Path, Rejections> {
    let mut program = CallPlan::of(request)?;
    match &request.path.feature {
        Feature::Surface(point) => program.surface(point)?,
        Feature::Bore(bore) => program.bore(bore)?,
        Feature::Pairs(pairs) => program.pairs(pairs)?,
        Feature::Corner(corner) => program.corner(corner)?,
        Feature::TwoCircles(circles) => program.two_circles(circles)?,
        Feature::Wall(_) => return program.wall(meets),
        Feature::Unmoving | Feature::Several => return program.switch(),
    }
    program.finish(meets)
}

/// Runs the calls of a path with other contacts: the executed moves, up to the alarm.
pub fn rerun(own: &CallSequence, radius: f64, meets: ContactQuery<'_>) -> NativeRun {
    executed_path::rerun(own, (radius, radius), run, meets)
}

/// Runs a block; `None` if the block does not move.
fn run(block: &CallBlock, _: ProbeTable, machine: &mut Machine<'_>) -> Option<Result<(), Alarm>> {
    let CallBlock::Call(number, letters) = block else {
        return None;
    };
    let letters: Vec<(char, f64)> = letters
        .iter()
        .map(|(letter, quantity)| (*letter, quantity.value()))
        .collect();
    // Each call states how far it searches.
    macros::run(*number, &letters, Edition::Unknown, machine)
}

/// Link moves between two cycles are protected moves; results that the next macro overwrites are saved.
pub const LINKING: CycleLinking = CycleLinking {
    way: protected,
    links_itself: false,
    computes: true,
    activates: None,
    saved_variables: (FIRST_KEPT, LAST_KEPT),
};

/// A protected move to a position along these axes. Heights are those of the stylus tip.
fn protected(to: Vec3, axes: [bool; 3], radius: f64, (_, rate): (Feed, f64)) -> CallBlock {
    let place = [to.x, to.y, to.z - radius];
    let letters = (0..3)
        .filter(|axis| axes[*axis])
        .map(|axis| (['X', 'Y', 'Z'][axis], Quantity::Length(place[axis])));
    CallBlock::Call(9810, letters.chain([('F', Quantity::Feed(rate))]).collect())
}

/// A program under construction.
struct CallPlan<'a> {
    request: &'a NativeRequest<'a>,
    radius: f64,
    /// End of the first move.
    first: Vec3,
    at: Vec3,
    blocks: Vec<CallBlock>,
    stored: Vec<(&'static str, Stored)>,
    guards: Vec<Guard>,
    /// Feed of each protected move, in order.
    feeds: Vec<Feed>,
    kept: usize,
}

impl<'a> CallPlan<'a> {
    fn of(request: &'a NativeRequest<'a>) -> Result<Self, Rejections> {
        let NativeRequest { path, setup, .. } = request;
        if setup.plane != Plane::G17 {
            return Err(refused(
                "plane-unsupported",
                "plane",
                text!(
                    "The macros probe in the plane XY along Z: there are no programs for planes other than G17"
                ),
            ));
        }
        if path.picked {
            let message = text!(
                "The macros choose their own touch points{advice}",
                request.advice()
            );
            return Err(refused("cycle-chooses-points", "cycle.touches", message));
        }
        let first = path.moves.first().map_or(Vec3::ZERO, |step| step.to);
        Ok(CallPlan {
            request,
            radius: setup.radius,
            first,
            at: first,
            blocks: Vec::new(),
            stored: Vec::new(),
            guards: Vec::new(),
            feeds: Vec::new(),
            kept: 0,
        })
    }

    /// Start of the first touch of the documented cycle.
    fn first_touch_start(&self) -> Vec3 {
        executed_path::begins(self.request.path).unwrap_or(self.first)
    }

    /// Position of the documented cycle after its first steps, before it moves elsewhere.
    fn start(&self) -> Vec3 {
        executed_path::start(self.request.path).unwrap_or(self.first)
    }

    /// A protected move along these axes.
    fn goes(&mut self, to: Vec3, axes: &[usize], feed: Feed) {
        let moved: Vec<usize> = axes
            .iter()
            .copied()
            .filter(|axis| (to[*axis] - self.at[*axis]).abs() > NEAR)
            .collect();
        if moved.is_empty() {
            return;
        }
        let rate = self.request.feeds.rate(feed).unwrap_or(STATED_RAPID);
        for axis in axes {
            self.at[*axis] = to[*axis];
        }
        self.blocks.push(protected(
            to,
            [0, 1, 2].map(|axis| axes.contains(&axis)),
            self.radius,
            (feed, rate),
        ));
        self.feeds.push(feed);
    }

    /// From the height above down to a position, by way of another height.
    fn down(&mut self, over: Vec3, place: Vec3) {
        self.goes(over, &[2], Feed::Approach);
        self.goes(place, &[2], Feed::LongLink);
    }

    /// Up to the height from which the program came.
    fn up(&mut self) {
        let first = self.first;
        self.goes(self.at.with_z(first.z), &[2], Feed::Return);
    }

    /// Search distance of the ball centre past the surface, for the job's overtravel past the contact.
    fn q(&self) -> Result<Quantity, Rejections> {
        self.q_of(FieldValue {
            field: "overtravel",
            value: self.request.setup.overtravel,
        })
    }

    /// Q of a search this far past the contact.
    fn q_of(&self, overtravel: FieldValue) -> Result<Quantity, Rejections> {
        let q = overtravel.value - self.radius;
        if q <= 0.0 {
            let message = text!(
                "The macros count the search from the surface to the ball centre: an overtravel of {overtravel} ends before contact. More than the ball's radius, {radius}, is needed{advice}",
                self.request.length(overtravel.value),
                self.request.length(self.radius),
                self.request.advice()
            );
            return Err(refused("overtravel-too-short", overtravel.field, message));
        }
        Ok(Quantity::Length(q))
    }

    /// R, from the surface of the ball.
    fn r(&self, clearance: FieldValue, inside: bool) -> Result<Quantity, Rejections> {
        let r = clearance.value - self.radius;
        if r < LEAST_CLEARANCE {
            let message = text!(
                "The macros treat a contact close to the start of a touch as one during positioning: the side clearance must exceed the ball's radius by {least}",
                self.request.length(LEAST_CLEARANCE)
            );
            return Err(refused("touch-too-short", clearance.field, message));
        }
        Ok(Quantity::Length(if inside { -r } else { r }))
    }

    /// A measuring call: with the work offset if one is written, tolerances if there are limits, and the print-out if it is asked for.
    fn measures(&mut self, number: u32, letters: Vec<(char, Quantity)>) {
        self.calls(number, letters, self.request.work_offset);
    }

    /// A measuring call for a size, which may correct a tool; with its results.
    fn measures_size(
        &mut self,
        number: u32,
        mut letters: Vec<(char, Quantity)>,
        results: &[(&'static str, usize)],
    ) {
        let wear = results
            .iter()
            .find_map(|(code, _)| self.request.wear.iter().find(|(known, _)| known == code));
        let Some((_, wear)) = wear else {
            self.measures(number, letters);
            return self.stores(results);
        };
        let mut correction = vec![('T', Quantity::Plain(f64::from(wear.tool)))];
        if let Some((parts, store)) = wear.mean {
            correction.extend(
                [('M', store), ('C', parts)]
                    .map(|(letter, x)| (letter, Quantity::Plain(f64::from(x)))),
            );
        }
        if wear.share < 1.0 {
            correction.push(('F', Quantity::Plain(wear.share)));
        }
        if wear.dead_band > 0.0 {
            // The measuring macros compare V with half of the size's error, O9835 with the whole error (read in Renishaw's macros).
            let compared = if wear.mean.is_none() { 0.5 } else { 1.0 };
            correction.push(('V', Quantity::Length(compared * wear.dead_band)));
        }
        if wear.mean.is_none() {
            letters.extend(correction);
            self.measures(number, letters);
            return self.stores(results);
        }
        self.measures(number, letters);
        self.stores(results);
        // No source tells which results the next macro keeps.
        self.keeps();
        self.blocks.push(CallBlock::Call(9835, correction));
    }

    /// A measuring call that writes this work offset.
    fn calls(&mut self, number: u32, mut letters: Vec<(char, Quantity)>, work_offset: Option<i32>) {
        let limits = &self.request.limits;
        // One touch on each wall gives no angle.
        let angle = limits
            .angle
            .filter(|_| letters.iter().any(|(letter, _)| *letter == 'J'));
        let corrects = letters.iter().any(|(letter, _)| *letter == 'T');
        let mut tolerance = |letter, value: Option<f64>, quantity: fn(f64) -> Quantity| {
            if let Some(value) = value {
                letters.push((letter, quantity(value)));
            }
        };
        let edition = self.request.edition;
        let excluded = |one, other| edition.excludes().contains(&(one, other));
        // H is not allowed with S in a single surface, and never in a corner.
        let sized = matches!(number, 9812 | 9814 | 9822 | 9823);
        if sized && !(work_offset.is_some() && excluded("S", "H")) {
            tolerance('H', limits.size, Quantity::Length);
        }
        if matches!(number, 9815 | 9816) {
            tolerance('B', angle, Quantity::Angle);
        }
        // The whole zone: the alarm comes at half of it.
        if !(corrects && excluded("T", "M")) {
            tolerance('M', limits.position.map(|x| 2.0 * x), Quantity::Length);
        }
        if let Some(n) = work_offset {
            letters.push(('S', Quantity::Plain((self.request.offset)(n))));
        }
        if self.request.report == ResultOutput::Log {
            letters.push(('W', Quantity::Plain(1.0)));
        }
        self.blocks.push(CallBlock::Call(number, letters));
    }

    /// Records where these results are: in the output of this call, which stops for them by its letters.
    fn stores(&mut self, results: &[(&'static str, usize)]) {
        self.stored.extend(
            results
                .iter()
                .map(|(code, output)| (*code, Stored::Output(*output))),
        );
        let Some(CallBlock::Call(number, letters)) = self.blocks.last() else {
            return;
        };
        let letter = |wanted: char| {
            letters
                .iter()
                .find(|(letter, _)| *letter == wanted)
                .map(|(_, value)| value.value())
        };
        let of = |outputs: &[usize]| -> Vec<&'static str> {
            results
                .iter()
                .filter(|(_, output)| outputs.contains(output))
                .map(|(code, _)| *code)
                .collect()
        };
        // H is compared with the size, M with twice the deviation of the position, B with both walls.
        let guards = [
            (of(&[3]), Off::Each, letter('H')),
            (
                of(&[0, 1, 2]),
                Off::Place,
                letter('M').map(|zone| zone / 2.0),
            ),
            (
                of(&[8, 9]),
                if *number == 9834 {
                    Off::Each
                } else {
                    Off::BothWalls
                },
                letter('B'),
            ),
        ];
        let stops = guards.into_iter().filter(|(codes, ..)| !codes.is_empty());
        self.guards.extend(stops.filter_map(|(codes, off, limit)| {
            Some(Guard {
                codes,
                off,
                limit: limit?,
            })
        }));
    }

    /// Saves the results of the last call before the next one overwrites them.
    fn keeps(&mut self) {
        for (_, stored) in &mut self.stored {
            if let Stored::Output(output) = *stored {
                let variable = FIRST_KEPT + self.kept;
                self.kept += 1;
                self.blocks.push(CallBlock::SaveResult(variable, output));
                *stored = Stored::Kept(variable);
            }
        }
    }

    fn surface(&mut self, point: &Point) -> Result<(), Rejections> {
        let touch = &self.request.path.touches[0];
        let (vector, start) = (touch.vector, self.first_touch_start());
        self.down(start, start);
        if vector.z > 0.0 && executed_path::is_along(vector, 2) {
            // With a length to the tip the surface itself is measured: Q counts from the contact.
            let q = Quantity::Length(self.request.setup.overtravel);
            self.measures(9811, vec![('Z', Quantity::Length(touch.point.z)), ('Q', q)]);
            self.stores(&[("point.x", 0), ("point.y", 1), ("point.z", 2)]);
        } else if vector.z.abs() < NEAR {
            let q = self.q()?;
            match axis_of(vector) {
                Some(axis) => {
                    self.measures(
                        9811,
                        vec![
                            (['X', 'Y'][axis], Quantity::Length(touch.point[axis])),
                            ('Q', q),
                        ],
                    );
                    self.stores(&[("point.x", 0), ("point.y", 1)]);
                }
                None => {
                    let a = degrees_of(-vector);
                    let d = (start - touch.point).dot(vector);
                    self.measures(
                        9821,
                        vec![
                            ('A', Quantity::Angle(a)),
                            ('D', Quantity::Length(d)),
                            ('Q', q),
                        ],
                    );
                    self.stores(&[("point.x", 0), ("point.y", 1)]);
                }
            }
        } else {
            let message = text!(
                "No macro touches a sloped surface{advice}",
                self.request.advice()
            );
            return Err(refused("cycle-not-parallel", point.elevation, message));
        }
        self.up();
        Ok(())
    }

    /// The angle of a wall: each touch by P9811, and the angle by the formula over the measured coordinates.
    fn wall(mut self, meets: ContactQuery<'_>) -> Result<Path, Rejections> {
        let path = self.request.path;
        if self.request.work_offset.is_some() {
            let message = text!(
                "This feature is measured by single touches, which write nothing: leave the work offset empty"
            );
            let field = "control.workOffset";
            return Err(refused("work-offset-unsupported", field, message));
        }
        let q = self.q()?;
        let (mut touches, mut measured) = (Vec::new(), Vec::new());
        for (k, from, _) in path.searches() {
            let touch = &path.touches[k];
            let Some(axis) = axis_of(touch.vector) else {
                let message = text!(
                    "P9811 touches along X and Y: this wall is turned{advice}",
                    self.request.advice()
                );
                return Err(refused("cycle-not-parallel", "cycle.rotation", message));
            };
            let from = from.unwrap_or(self.first);
            self.goes(from, &[0, 1], Feed::LongLink);
            if measured.is_empty() {
                self.down(from, from);
            }
            let mut letters = vec![
                (['X', 'Y'][axis], Quantity::Length(touch.point[axis])),
                ('Q', q),
            ];
            if self.request.report == ResultOutput::Log {
                letters.push(('W', Quantity::Plain(1.0)));
            }
            self.blocks.push(CallBlock::Call(9811, letters));
            // The coordinate is a value of the formula, and no result.
            let variable = FIRST_KEPT + measured.len();
            self.blocks.push(CallBlock::SaveResult(variable, axis));
            measured.push((k, Stored::Kept(variable)));
            touches.push(SingleTouch {
                axis,
                center: touch.contact(self.radius),
                ball: touch.vector[axis] * self.radius,
            });
        }
        self.up();
        let mut path = self.finish(meets)?;
        path.formula = std::mem::take(&mut path.formula).over_single_touches(&touches);
        if let Some(own) = &mut path.calls {
            own.measured = measured;
        }
        Ok(path)
    }

    fn bore(&mut self, bore: &Bore) -> Result<(), Rejections> {
        let path = self.request.path;
        let inside = path
            .touches
            .first()
            .is_some_and(|touch| (touch.point - path.frame.origin).dot(touch.vector) < 0.0);
        let angles: Vec<f64> = path
            .touches
            .iter()
            .map(|touch| degrees_of(if inside { -touch.vector } else { touch.vector }))
            .collect();
        let square = executed_path::are_quarters;
        if square(&angles) && (angles[0] / 90.0 - (angles[0] / 90.0).round()).abs() > NEAR {
            let message = text!(
                "P9814 touches along X and Y: these four touches are turned{advice}",
                self.request.advice()
            );
            return Err(refused("cycle-not-parallel", "cycle.rotation", message));
        }
        let mut letters = vec![('D', Quantity::Length(bore.diameter.value))];
        let beside = bore.clearance.is_some();
        let start = if beside {
            self.start()
        } else {
            self.first_touch_start()
        };
        match (square(&angles), angles.as_slice()) {
            (true, _) => letters.push(('Q', self.q()?)),
            (false, [a, b, c]) => {
                letters.splice(
                    0..0,
                    [('A', *a), ('B', *b), ('C', *c)]
                        .map(|(letter, angle)| (letter, Quantity::Angle(angle))),
                );
                // Beside a feature this macro counts Q from the contact.
                letters.push((
                    'Q',
                    if beside {
                        Quantity::Length(self.request.setup.overtravel)
                    } else {
                        self.q()?
                    },
                ));
            }
            _ => {
                let message = text!(
                    "The macros touch a circle at four points a quarter turn apart, or at three: not at {count} like these{advice}",
                    angles.len(),
                    self.request.advice()
                );
                return Err(refused("cycle-chooses-points", "cycle.stepCount", message));
            }
        }
        if let Some(clearance) = bore.clearance {
            let r = self.r(clearance, inside)?;
            letters.extend([
                ('Z', Quantity::Length(path.touches[0].point.z - self.radius)),
                ('R', r),
            ]);
        }
        self.down(self.start(), start);
        let results = [("center.x", 0), ("center.y", 1), ("diameter", 3)];
        self.measures_size(if square(&angles) { 9814 } else { 9823 }, letters, &results);
        self.up();
        Ok(())
    }

    fn pairs(&mut self, pairs: &Pairs) -> Result<(), Rejections> {
        let path = self.request.path;
        let inside = pairs.internal;
        let beside = pairs.sides.iter().any(|side| side.clearance.is_some());
        let turned = axis_of(path.touches[0].vector).is_none();
        if turned && pairs.sides.len() == 2 && self.request.work_offset.is_some() {
            let message = text!(
                "Both macros of a turned rectangle write X and Y, and the second would measure in the system that the first has moved: write no work offset{advice}",
                self.request.advice()
            );
            return Err(refused(
                "offset-measured-again",
                "control.workOffset",
                message,
            ));
        }
        let start = if beside {
            self.start()
        } else {
            self.first_touch_start()
        };
        self.down(self.start(), start);
        let measured = [
            [("center.x", 0), ("width1", 3)],
            [("center.y", 1), ("width2", 3)],
        ];
        let single = pairs.sides.len() == 1;
        for (i, side) in pairs.sides.iter().enumerate() {
            if i > 0 {
                self.keeps();
            }
            let touch = &path.touches[2 * i];
            let mut letters = match axis_of(touch.vector) {
                Some(axis) => vec![(['X', 'Y'][axis], Quantity::Length(side.width.value))],
                None => {
                    // Angle of the wall, not of the touch.
                    let wall = (degrees_of(touch.vector) + 90.0).rem_euclid(180.0);
                    vec![
                        ('A', Quantity::Angle(wall)),
                        ('D', Quantity::Length(side.width.value)),
                    ]
                }
            };
            // Beside a feature the macro for rotated walls counts Q from the contact.
            let from_contact = turned && side.clearance.is_some();
            letters.push((
                'Q',
                if from_contact {
                    Quantity::Length(self.request.setup.overtravel)
                } else {
                    self.q()?
                },
            ));
            if let Some(clearance) = side.clearance {
                letters.extend([
                    ('Z', Quantity::Length(touch.point.z - self.radius)),
                    ('R', self.r(clearance, inside)?),
                ]);
            }
            let results: &[(&'static str, usize)] = match (single, turned, axis_of(touch.vector)) {
                (true, true, _) => &[("center.x", 0), ("center.y", 1), ("width", 3)],
                (true, false, Some(0)) => &[("center.x", 0), ("width", 3)],
                (true, false, _) => &[("center.y", 1), ("width", 3)],
                (false, true, _) => &measured[i][1..],
                // The pair along the first direction may lie along Y.
                (false, false, Some(0)) => &[("center.x", 0), measured[i][1]],
                (false, false, _) => &[("center.y", 1), measured[i][1]],
            };
            self.measures_size(if turned { 9822 } else { 9812 }, letters, results);
        }
        if single && let Some(top) = path.touches.get(2) {
            self.keeps();
            let q = Quantity::Length(self.request.setup.overtravel);
            self.measures(9811, vec![('Z', Quantity::Length(top.point.z)), ('Q', q)]);
            self.stores(&[("height", 2)]);
        }
        self.up();
        Ok(())
    }

    fn corner(&mut self, corner: &Corner) -> Result<(), Rejections> {
        let path = self.request.path;
        let of = |group: usize| {
            path.touches
                .iter()
                .filter(|touch| touch.group == group)
                .collect::<Vec<&Touch>>()
        };
        let [one, two] = [of(0), of(1)];
        let (Some(a), Some(b)) = (axis_of(one[0].vector), axis_of(two[0].vector)) else {
            let message = text!(
                "The corner macros support walls along X and Y, square to each other: these are rotated{advice}",
                self.request.advice()
            );
            return Err(refused("cycle-not-parallel", "cycle.rotation", message));
        };
        if a == b || (corner.angle.value - 90.0).abs() > NEAR {
            let message = text!(
                "The corner macros support walls that are square to each other{advice}",
                self.request.advice()
            );
            return Err(refused("cycle-not-square", corner.angle.field, message));
        }
        if one.len() > 2 || two.len() > 2 || one.len() != two.len() {
            let message = text!(
                "The corner macros touch each wall once, or each wall twice: not {first} and {second} times{advice}",
                one.len(),
                two.len(),
                self.request.advice()
            );
            return Err(refused("cycle-chooses-points", "cycle.count1", message));
        }
        let (x_wall, y_wall) = if a == 0 { (&one, &two) } else { (&two, &one) };
        let (x, y) = (x_wall[0].point.x, y_wall[0].point.y);
        let level = x_wall[0].point.z;
        // Inside, the first touches are beside the start; outside as far behind the corner as the start is in front of it.
        let foot = Vec3::new(y_wall[0].point.x, x_wall[0].point.y, level);
        let start = if corner.outside {
            Vec3::new(2.0 * x - foot.x, 2.0 * y - foot.y, level)
        } else {
            foot
        };
        self.first = start.with_z(self.first.z);
        self.at = self.first;
        let over = start.with_z(self.start().z.max(level));
        self.down(over, start);
        let mut letters = vec![('X', Quantity::Length(x)), ('Y', Quantity::Length(y))];
        if let ([first, second], [third, fourth]) = (y_wall.as_slice(), x_wall.as_slice()) {
            letters.push((
                'I',
                Quantity::Length((second.point.x - first.point.x).abs()),
            ));
            letters.push((
                'J',
                Quantity::Length((fourth.point.y - third.point.y).abs()),
            ));
        }
        letters.push(('Q', self.q()?));
        self.measures(if corner.outside { 9816 } else { 9815 }, letters);
        // Deviations of the walls: output 8 for the one across X, 9 for the one across Y.
        let turn = if a == 0 { 8 } else { 9 };
        self.stores(&[("corner.x", 0), ("corner.y", 1)]);
        if one.len() == 2 {
            self.stores(&[("rotation", turn)]);
        }
        for (k, from, _) in path.searches() {
            let touch = &path.touches[k];
            if touch.group < 2 {
                continue;
            }
            let Some(from) =
                from.filter(|_| touch.vector.z > 0.0 && executed_path::is_along(touch.vector, 2))
            else {
                let message = text!(
                    "The third surface must be perpendicular to Z{advice}",
                    self.request.advice()
                );
                return Err(refused("cycle-not-parallel", "cycle", message));
            };
            if path
                .touches
                .iter()
                .filter(|other| other.group == touch.group)
                .count()
                > 1
            {
                let message = text!(
                    "A surface is touched once by a macro{advice}",
                    self.request.advice()
                );
                return Err(refused("cycle-chooses-points", "cycle", message));
            }
            self.keeps();
            // Up first, across, then down.
            let high = self.at.z.max(from.z);
            self.goes(self.at.with_z(high), &[2], Feed::LongLink);
            self.goes(from.with_z(high), &[0, 1], Feed::LongLink);
            self.goes(from, &[2], Feed::LongLink);
            let q = Quantity::Length(self.request.setup.overtravel);
            self.measures(9811, vec![('Z', Quantity::Length(touch.point.z)), ('Q', q)]);
            self.stores(&[("corner.z", 2), ("height", 2)]);
        }
        self.up();
        Ok(())
    }

    /// Hole or stud, move to the other feature, that feature, and the relation between them.
    fn two_circles(&mut self, circles: &TwoCircles) -> Result<(), Rejections> {
        let path = self.request.path;
        let setting = |number: i32| match circles
            .settings
            .iter()
            .find(|setting| setting.number == number)
            .map(|s| &s.value)
        {
            Some(ParameterValue::Whole(n)) => *n,
            _ => 0,
        };
        let of = |group: usize| {
            path.touches
                .iter()
                .filter(|touch| touch.group == group)
                .collect::<Vec<&Touch>>()
        };
        let full = circles
            .spread
            .is_some_and(|spread| (spread.sweep.abs().to_degrees() - 360.0).abs() < NEAR);
        if [0, 1].iter().any(|group| of(*group).len() != 4)
            || !full
            || !circles.extrusion.is_empty()
        {
            return Err(four_points(self.request));
        }
        let (transfer, line) = (setting(1120), circles.line.unwrap_or([Vec3::ZERO; 2]));
        if self.request.work_offset.is_some() && matches!(transfer, 1 | 3) {
            let message = text!(
                "The work offset can be written by the second circle alone (Q1120 = 2): after the first the second would be measured in the system that it has moved{advice}",
                self.request.advice()
            );
            return Err(refused(
                "offset-measured-again",
                "cycle.transferPosition",
                message,
            ));
        }
        if self.request.work_offset.is_some()
            && transfer == 2
            && self.request.limits.angle.is_some()
        {
            let message = text!(
                "P9834 checks the angle after the second circle has written the work offset: leave \"Angle limit\" empty, or write no work offset"
            );
            return Err(refused("limits-not-asked", "limits.angle", message));
        }
        let up = path
            .moves
            .iter()
            .map(|step| step.to.z)
            .fold(f64::NEG_INFINITY, f64::max);
        self.first = line[0].with_z(up);
        self.at = self.first;
        for (i, center) in line.into_iter().enumerate() {
            let (touches, codes) = (
                of(i),
                [["Q950", "Q951", "Q966"], ["Q953", "Q954", "Q967"]][i],
            );
            let k = path
                .touches
                .iter()
                .position(|touch| touch.group == i)
                .unwrap_or(0);
            let from = path
                .searches()
                .find(|(touch, ..)| *touch == k)
                .and_then(|(_, from, _)| from)
                .unwrap_or(center);
            let round = match &path.surfaces[i] {
                Surface::Round(round) => *round,
                _ => return Err(four_points(self.request)),
            };
            self.goes(center.with_z(up), &[0, 1], Feed::LongLink);
            let q = self.q_of(FieldValue {
                field: "cycle.probe.dist",
                value: touches[0].search,
            })?;
            let mut letters = vec![('D', Quantity::Length(2.0 * round.radius)), ('Q', q)];
            if round.hole {
                self.goes(center.with_z(touches[0].point.z), &[2], Feed::LongLink);
            } else {
                let clearance = FieldValue {
                    field: "cycle.setUpClearance",
                    value: from.distance(touches[0].point),
                };
                letters.extend([
                    ('Z', Quantity::Length(touches[0].point.z - self.radius)),
                    ('R', self.r(clearance, false)?),
                ]);
            }
            self.calls(
                9814,
                letters,
                self.request.work_offset.filter(|_| i == 1 && transfer == 2),
            );
            self.stores(&[(codes[0], 0), (codes[1], 1), (codes[2], 3)]);
            self.keeps();
            if i == 0 {
                self.blocks.push(CallBlock::Call(9834, Vec::new()));
                self.up();
            }
        }
        let [dx, dy] = [line[1].x - line[0].x, line[1].y - line[0].y];
        let mut letters = vec![('X', Quantity::Length(dx)), ('Y', Quantity::Length(dy))];
        letters.extend(
            self.request
                .limits
                .angle
                .map(|angle| ('B', Quantity::Angle(angle))),
        );
        self.blocks.push(CallBlock::Call(9834, letters));
        self.stores(&[("Q964", 9)]);
        self.up();
        Ok(())
    }

    /// Switches the probe on or off without a move.
    fn switch(self) -> Result<Path, Rejections> {
        let mut path = self.request.path.clone();
        let number = if self.request.switches_on { 9832 } else { 9833 };
        let blocks = vec![(CallBlock::Call(number, Vec::new()), 0)];
        path.calls = Some(Box::new(CallSequence {
            blocks,
            ..CallSequence::default()
        }));
        Ok(path)
    }

    /// Runs the calls on the nominal part: the path, its touches in the order of the documented ones.
    fn finish(self, meets: ContactQuery<'_>) -> Result<Path, Rejections> {
        let CallPlan {
            request,
            radius,
            first,
            blocks,
            stored,
            guards,
            feeds,
            ..
        } = self;
        let mut path = request.path.clone();
        let mut answer = |from, to, _: Option<Vec3>| meets(from, to);
        let mut machine = Machine::new(first, radius, radius, &mut answer);
        let mut counted = Vec::new();
        let mut own_feeds: Vec<(Option<Feed>, u8)> = Vec::new();
        let mut protected = feeds.iter();
        for (step, block) in blocks.iter().enumerate() {
            let before = machine.made.len();
            if let CallBlock::Call(number, _) = block {
                if let Some(Err(alarm)) = run(block, ProbeTable::default(), &mut machine) {
                    let message = text!(
                        "On the nominal part P{number} would stop: {alarm}{advice}",
                        *number as usize,
                        words_of(alarm),
                        self.request.advice()
                    );
                    return Err(refused("cycle-stops", "cycle", message));
                }
                let feed = if *number == 9810 {
                    protected.next().copied()
                } else {
                    None
                };
                own_feeds.resize(
                    machine.made.len(),
                    (feed, u8::try_from(step + 2).unwrap_or(u8::MAX)),
                );
            }
            counted.push(machine.made.len() - before);
        }
        let made = machine.made;
        // The touches of a circle begin with Y, and continue from the measured middle.
        let own_order = match path.feature {
            Feature::Bore(_) => path.touches.len() != 3,
            Feature::TwoCircles(_) => true,
            _ => false,
        };
        let Some((moves, touches)) = path_of_moves(
            &path,
            own_order,
            &made,
            &own_feeds,
            first,
            (radius, Some(SEARCH)),
        ) else {
            let message = text!(
                "The macros would touch other surfaces than the cycle does{advice}",
                self.request.advice()
            );
            return Err(refused("cycle-stops", "cycle", message));
        };
        (path.moves, path.touches) = (moves, touches);
        if let Feature::Bore(bore) = &path.feature
            && path.touches.len() == 4
        {
            path.formula = round_formula(&path, radius, bore.diameter.value);
        }
        // The macros fit nothing, and for two circles they give the wanted results.
        let two = matches!(path.feature, Feature::TwoCircles(_));
        let said = |code: &str| {
            stored.iter().any(|(known, _)| *known == code) || code.starts_with("preset")
        };
        path.formula
            .results
            .retain(|result| result.role != Role::Residual && (!two || said(result.code)));
        let job = request.feeds;
        path.feeds = Some(Feeds {
            approach: Some(job.approach.unwrap_or(STATED_RAPID)),
            long_link: Some(job.long_link.unwrap_or(STATED_RAPID)),
            work: MEASURE,
            retract: Some(FAST),
            return_: Some(job.return_.unwrap_or(STATED_RAPID)),
            search: Some(SEARCH),
            rapid: None,
        });
        path.start = None;
        path.calls = Some(Box::new(CallSequence {
            counts: made.iter().map(|made| made.ordinal).collect(),
            first,
            blocks: blocks.into_iter().zip(counted).collect(),
            stored,
            guards,
            ..CallSequence::default()
        }));
        Ok(path)
    }
}

/// Axis of the plane that a direction is parallel to; `None` if it is rotated.
fn axis_of(vector: Vec3) -> Option<usize> {
    (0..2).find(|axis| executed_path::is_along(vector, *axis))
}

/// Requirements of the macros for two circles.
fn four_points(request: &NativeRequest<'_>) -> Rejections {
    let message = text!(
        "The macros touch each circle at four points a quarter turn apart, at one height{advice}",
        request.advice()
    );
    refused("cycle-chooses-points", "cycle.probePoints", message)
}

fn words_of(alarm: Alarm) -> Text {
    match alarm {
        Alarm::Obstructed => text!("alarm 86: a contact in a protected move"),
        Alarm::Arguments => text!("alarm 91: its arguments contradict each other"),
        Alarm::Unexpected => text!("alarm 92: a contact on the way, or at the start of a touch"),
        Alarm::NotFound => text!("alarm 93: no contact"),
        Alarm::Collision => text!("a collision"),
    }
}

/// Middle of each pair of touches, and the diameter from the second pair: Y minus, Y plus, X minus, X plus.
fn round_formula(path: &Path, radius: f64, diameter: f64) -> Formula {
    let (origin, f) = (path.frame.origin, Draft::with_room_for(4));
    let inside = path
        .touches
        .iter()
        .all(|touch| (touch.point - origin).dot(touch.vector) < 0.0);
    let middle = |first: usize, axis: usize| {
        (f.trigger(first, axis) + f.trigger(first + 1, axis)) / f.number(2.0)
    };
    let (x, y) = (
        f.set("center_x", middle(2, 0)),
        f.set("center_y", middle(0, 1)),
    );
    let balls = f.length(if inside { 2.0 * radius } else { -2.0 * radius });
    let size = f.set("diameter", f.trigger(3, 0) - f.trigger(2, 0) + balls);
    f.result(
        "center.x",
        Role::Abscissa,
        words!("Centre, abscissa"),
        origin.x,
        Some(x),
    );
    f.result(
        "center.y",
        Role::Ordinate,
        words!("Centre, ordinate"),
        origin.y,
        Some(y),
    );
    f.result(
        "diameter",
        Role::Size,
        words!("Diameter"),
        diameter,
        Some(size),
    );
    let datum = OffsetCorrection::point((x, origin.x), (y, origin.y));
    f.finish(Some(datum))
}
