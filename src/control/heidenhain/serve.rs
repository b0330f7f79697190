//! Which 4xx cycles a feature needs, and the path that they make of it: the ones that measure only, or those that write a row of the preset table.

use super::{blocks, cycles};
use crate::control::iso::writer::Writer;
use crate::control::own::machine::{Alarm, Machine};
use crate::control::own::made::{self, Drafted};
use crate::control::own::{Meets, OwnCycles, OwnRequest, Refused, Several, degrees_of};
use crate::control::{Program, Report, Request, check_write, does, own};
use crate::form::Checker;
use crate::geom::{Plane, Vec3};
use crate::num::{decimal, wrap_degrees};
use crate::path::{Bore, Entry, Feature, Guard, Off, Own, OwnBlock, Pairs, Path, Point, Quantity, Reach, Stored};
use crate::text::{Text, text};

/// How nearly directions and places must agree.
const NEAR: f64 = 1e-6;

pub static CYCLES: OwnCycles = OwnCycles {
    plan: serve,
    rerun: |own, radius, meets| made::rerun(own, (radius, 0.0), call, meets),
    followed: false,
    offset: f64::from,
    word: |number, q| format!("{number} Q{q}"),
    name: |stored| match stored {
        Stored::Output(q) | Stored::Kept(q) => format!("Q{q}"),
    },
    corrects_tools: false,
    several: Several { way: |to, _, _, (feed, _)| OwnBlock::Goes(to, feed), comes_itself: true, kept: FREE },
};

/// The Q parameters that the manuals leave to programs [S: TNC 620, TNC 640]: none of them is a cycle's.
const FREE: (usize, usize) = (1600, 1999);

/// The path that the cycles make of a job's feature, with the calls. 1411 is the documented path itself.
fn serve(request: &OwnRequest<'_>, meets: Meets<'_>) -> Result<Path, Refused> {
    let path = request.path;
    if path.feature.two_circles().is_some() {
        return Ok(path.clone());
    }
    if request.setup.plane != Plane::G17 {
        let message = text!("No source we have shows how these cycles take the tool axis of a plane other than G17");
        return Err(own::refused("cycle-plane", "plane", message));
    }
    if path.picked {
        let message = text!("The control's own cycles choose their touch points: picked ones cannot be used");
        return Err(own::refused("cycle-chooses-points", "cycle.touches", message));
    }
    let mut program = Plan { request, blocks: Vec::new(), stored: Vec::new(), guards: Vec::new(), first: Vec3::ZERO };
    match &path.feature {
        Feature::Surface(point) => program.surface(point)?,
        Feature::Bore(bore) => program.bore(bore)?,
        Feature::Pairs(pairs) => program.pairs(pairs)?,
        Feature::Corner(_) | Feature::TwoCircles(_) | Feature::Unmoving | Feature::Wall(_) | Feature::Several => {
            return Ok(path.clone());
        }
    }
    program.finish(meets)
}

/// Runs a block; `None` if the block does not move.
fn call(block: &OwnBlock, reach: Reach, machine: &mut Machine<'_>) -> Option<Result<(), Alarm>> {
    let OwnBlock::Cycle(number, parameters) = block else { return None };
    let values: Vec<(u16, f64)> = parameters.iter().map(|(q, quantity)| (*q, quantity.value())).collect();
    cycles::run(*number, &values, reach, machine)
}

/// A program while it is put together.
struct Plan<'a> {
    request: &'a OwnRequest<'a>,
    blocks: Vec<OwnBlock>,
    stored: Vec<(&'static str, Stored)>,
    guards: Vec<Guard>,
    first: Vec3,
}

use Quantity::{Angle, Length, Plain};

impl Plan<'_> {
    /// The row that is written; none measures only.
    fn row(&self) -> Option<f64> {
        self.request.work_offset.map(f64::from)
    }

    /// The clearance height of a cycle that would be there alone: in a set-up no lower than the ways between the cycles, which they make themselves.
    fn clearance_height(&self, alone: f64) -> f64 {
        self.request.clear.map_or(alone, |clear| clear.max(alone))
    }

    /// Where the ball crosses between touches, and where the cycles end: as high as the documented path crosses, or begins.
    fn high(&self) -> f64 {
        let path = self.request.path;
        let level = path.touches.iter().map(|touch| touch.point.z).fold(f64::NEG_INFINITY, f64::max);
        let crosses = made::start(path).filter(|start| start.z > level + NEAR);
        self.clearance_height(crosses.or(path.moves.first().map(|step| step.to)).map_or(level, |place| place.z))
    }

    fn begins_at(&mut self, place: Vec3, high: f64) {
        if self.blocks.is_empty() {
            self.first = place.with_z(high);
        }
    }

    /// Q320: what is left of a clearance from the wall to the ball's centre.
    fn set_up(&self, clearance: Entry) -> Result<f64, Refused> {
        let left = clearance.value - self.request.setup.radius - self.request.set_up;
        if left < -NEAR {
            let message = text!(
                "The probe table's SET_UP ({set_up}) and the ball's radius ({radius}) are more than this clearance: a touch would begin farther away",
                self.request.length(self.request.set_up),
                self.request.length(self.request.setup.radius)
            );
            return Err(own::refused("set-up-too-long", clearance.field, message));
        }
        Ok(left.max(0.0))
    }

    /// Q320 where the job says no clearance: a touch begins as far in front of its contact as it searches behind.
    fn free_set_up(&self) -> f64 {
        (self.request.setup.overtravel - self.request.set_up).max(0.0)
    }

    /// The limits of a size; both 0 where it has none, which asks nothing.
    fn sizes(&self, largest: u16, smallest: u16, size: f64) -> [(u16, Quantity); 2] {
        let [high, low] = self.request.limits.size.map_or([0.0; 2], |off| [size + off, (size - off).max(0.0)]);
        [(largest, Length(high)), (smallest, Length(low))]
    }

    /// How far the centre may be off; 0 asks nothing.
    fn places(&self) -> [(u16, Quantity); 2] {
        let off = self.request.limits.position.unwrap_or(0.0);
        [(279, Length(off)), (280, Length(off))]
    }

    /// The log: none, a file, or the screen.
    fn log(&self) -> (u16, Quantity) {
        let log = match self.request.report {
            Report::None => 0.0,
            Report::Log => 1.0,
            Report::Screen => 2.0,
        };
        (281, Plain(log))
    }

    /// Whether it stops out of one of these limits; no tool is monitored.
    fn stops(&self, limits: &[Option<f64>]) -> [(u16, Quantity); 2] {
        [(309, flag(limits.iter().any(Option::is_some))), (330, Plain(0.0))]
    }

    /// The same behind the limits, as most cycles have it.
    fn verdict(&self, limits: &[Option<f64>]) -> [(u16, Quantity); 3] {
        let [stop, tool] = self.stops(limits);
        [self.log(), stop, tool]
    }

    /// What a cycle that writes ends with; the values are those that the measured place shall get.
    fn writes(&self, row: f64, values: &[(u16, f64)], parameters: &mut Vec<(u16, Quantity)>, tail: bool) {
        parameters.push((305, Plain(row)));
        parameters.extend(values.iter().map(|(q, value)| (*q, Length(*value))));
        parameters.push((303, Plain(1.0)));
        if tail {
            parameters.push((381, Plain(0.0)));
            parameters.extend([382, 383, 384, 333].map(|q| (q, Length(0.0))));
        }
    }

    fn calls(&mut self, number: u16, parameters: Vec<(u16, Quantity)>) {
        self.blocks.push(OwnBlock::Cycle(number, parameters));
    }

    fn stores(&mut self, results: &[(&'static str, usize)]) {
        self.stored.extend(results.iter().map(|(code, q)| (*code, Stored::Output(*q))));
    }

    /// It stops where one of these results is off by more than a limit: with tolerances and Q309.
    fn stops_for(&mut self, codes: &[&'static str], limit: Option<f64>) {
        self.guards.extend(limit.map(|limit| Guard { codes: codes.to_vec(), off: Off::Each, limit }));
    }

    fn surface(&mut self, point: &Point) -> Result<(), Refused> {
        let path = self.request.path;
        let touch = &path.touches[0];
        let start = made::begins(path).unwrap_or(touch.point);
        let entry = Entry { field: point.clearance, value: (start - touch.point).dot(touch.vector) };
        let set_up = self.set_up(entry)?;
        let high = self.clearance_height(path.moves.first().map_or(start.z, |step| step.to.z));
        self.touches_surface(touch.point, touch.vector, set_up, high, point.elevation)
    }

    /// One touch of a surface across an axis.
    fn touches_surface(
        &mut self,
        point: Vec3,
        vector: Vec3,
        set_up: f64,
        high: f64,
        field: &'static str,
    ) -> Result<(), Refused> {
        let Some(axis) = (0..3).find(|axis| made::is_along(vector, *axis)) else {
            let message = text!("The control's own cycles touch surfaces across X, Y or Z: this one is turned or sloped");
            return Err(own::refused("cycle-not-parallel", field, message));
        };
        let place = [(263, Length(point.x)), (264, Length(point.y))];
        let direction = [(272, Plain((axis + 1) as f64)), (267, Plain(-vector[axis].signum()))];
        let aside = vector * (set_up + self.request.set_up + self.request.setup.radius);
        self.begins_at(point + aside, high);
        let mut parameters = place.to_vec();
        let (set_up, high) = ((320, Length(set_up)), (260, Length(high)));
        match (self.row(), axis) {
            (Some(row), 2) => {
                parameters.extend([(294, Length(point.z)), set_up, high]);
                self.writes(row, &[(333, point.z)], &mut parameters, false);
                self.calls(417, parameters);
            }
            (Some(row), _) => {
                parameters.extend([(261, Length(point.z)), set_up, high]);
                parameters.extend(direction);
                self.writes(row, &[(333, point[axis])], &mut parameters, false);
                self.calls(419, parameters);
            }
            (None, _) => {
                parameters.extend([(261, Length(point.z)), set_up]);
                parameters.extend(direction);
                parameters.extend([high, self.log()]);
                let limit = self.request.limits.position;
                let [high, low] = limit.map_or([0.0; 2], |off| [point[axis] + off, point[axis] - off]);
                parameters.extend([(288, Length(high)), (289, Length(low))]);
                parameters.extend(self.stops(&[limit]));
                self.calls(427, parameters);
                let code = ["point.x", "point.y", "point.z"][axis];
                self.stores(&[(code, 160)]);
                self.stops_for(&[code], limit);
            }
        }
        Ok(())
    }

    fn bore(&mut self, bore: &Bore) -> Result<(), Refused> {
        let path = self.request.path;
        let (center, touches) = (path.frame.origin, &path.touches);
        let inside = touches.first().is_some_and(|touch| (touch.point - center).dot(touch.vector) < 0.0);
        let mut angles: Vec<f64> = touches.iter().map(|touch| degrees_of(touch.point - center)).collect();
        let first = angles[0];
        // By the angle of the first, counter-clockwise, or clockwise where they are documented so.
        let square = made::are_quarters(&angles);
        let step = if square { 90.0 } else { wrap_degrees(angles.get(1).map_or(0.0, |second| second - first)) };
        if square {
            angles = (0..4).map(|k| first + 90.0 * f64::from(k)).collect();
        }
        let even = angles.iter().enumerate().all(|(k, angle)| wrap_degrees(angle - first - step * k as f64).abs() < 1e-4);
        // As far as our sources go, those that measure only touch four times.
        let fewest = if self.row().is_some() { 3 } else { 4 };
        if !(fewest..=4).contains(&angles.len()) || !even || !(5.0 - NEAR..=120.0 + NEAR).contains(&step.abs()) {
            let message = text!(
                "The control's own cycles touch a circle four times, 5° to 120° apart (three times where they write a preset): not {count} times like this",
                angles.len()
            );
            return Err(own::refused("cycle-chooses-points", "cycle.stepCount", message));
        }
        let set_up = bore.clearance.map_or(Ok(self.free_set_up()), |clearance| self.set_up(clearance))?;
        let (height, high) = (touches[0].point.z, self.high());
        let lifts = bore.clearance.is_some() || !inside;
        let row = self.row();
        let (sign, off) = (if inside { -1.0 } else { 1.0 }, self.request.setup.radius + self.request.set_up + set_up);
        let towards = (touches[0].point - center).with_z(0.0).normalize_or_zero();
        self.begins_at(center + towards * (bore.diameter.value / 2.0 + sign * off).max(0.0), high);
        let [x, y] = if row.is_some() { [321, 322] } else { [273, 274] };
        let mut parameters = vec![
            (x, Length(center.x)),
            (y, Length(center.y)),
            (262, Length(bore.diameter.value)),
            (325, Angle(first)),
            (247, Angle(step)),
            (261, Length(height)),
            (320, Length(set_up)),
            (260, Length(high)),
            (301, flag(lifts)),
        ];
        match row {
            Some(row) => {
                self.writes(row, &[(331, center.x), (332, center.y)], &mut parameters, true);
                parameters.extend([(423, Plain(angles.len() as f64)), (365, Plain(1.0))]);
            }
            None => {
                let [largest, smallest] = if inside { [275, 276] } else { [277, 278] };
                parameters.extend(self.sizes(largest, smallest, bore.diameter.value));
                parameters.extend(self.places());
                parameters.extend(self.verdict(&[self.request.limits.size, self.request.limits.position]));
            }
        }
        self.calls([[421, 412], [422, 413]][usize::from(!inside)][usize::from(row.is_some())], parameters);
        self.stores(&[("center.x", 151), ("center.y", 152), ("diameter", 153)]);
        if row.is_none() {
            self.stops_for(&["diameter"], self.request.limits.size);
            self.stops_for(&["center.x", "center.y"], self.request.limits.position);
        }
        Ok(())
    }

    fn pairs(&mut self, pairs: &Pairs) -> Result<(), Refused> {
        let path = self.request.path;
        let Some(axis) = (0..2).find(|axis| made::is_along(path.touches[0].vector, *axis)) else {
            let message = text!("The control's own cycles take walls along X and Y: these are turned");
            return Err(own::refused("cycle-not-parallel", "cycle.rotation", message));
        };
        let clearances: Vec<Entry> = pairs.sides.iter().filter_map(|side| side.clearance).collect();
        if let [one, two] = clearances.as_slice()
            && (one.value - two.value).abs() > NEAR
        {
            let message =
                text!("One set-up clearance holds for all sides of a rectangle: both side clearances must be the same");
            return Err(own::refused("cycle-one-path", two.field, message));
        }
        let set_up = clearances.first().map_or(Ok(self.free_set_up()), |clearance| self.set_up(*clearance))?;
        if pairs.sides.len() == 2 { self.rectangle(pairs, axis, set_up) } else { self.width(pairs, axis, set_up) }
    }

    fn rectangle(&mut self, pairs: &Pairs, axis: usize, set_up: f64) -> Result<(), Refused> {
        let path = self.request.path;
        let (center, height, high) = (path.frame.origin, path.touches[0].point.z, self.high());
        // Sides along X and Y; the first of the job may lie along Y.
        let mut sides = [pairs.sides[0].width.value, pairs.sides[1].width.value];
        let mut codes = [("width1", 154), ("width2", 155)];
        if axis == 1 {
            sides.swap(0, 1);
            codes = [("width1", 155), ("width2", 154)];
        }
        let lifts = !pairs.internal || pairs.sides[0].clearance.is_some();
        let sign = if pairs.internal { -1.0 } else { 1.0 };
        let off = sign * (self.request.setup.radius + self.request.set_up + set_up);
        let room = sides.iter().all(|side| side / 2.0 + off >= 0.0);
        self.begins_at(center + Vec3::X * if room { sides[0] / 2.0 + off } else { 0.0 }, high);
        let row = self.row();
        let [x, y, one, two] = if row.is_some() { [321, 322, 323, 324] } else { [273, 274, 282, 283] };
        let mut parameters = vec![
            (x, Length(center.x)),
            (y, Length(center.y)),
            (one, Length(sides[0])),
            (two, Length(sides[1])),
            (261, Length(height)),
            (320, Length(set_up)),
            (260, Length(high)),
            (301, flag(lifts)),
        ];
        match row {
            Some(row) => self.writes(row, &[(331, center.x), (332, center.y)], &mut parameters, true),
            None => {
                parameters.extend(self.sizes(284, 285, sides[0]));
                parameters.extend(self.sizes(286, 287, sides[1]));
                parameters.extend(self.places());
                parameters.extend(self.verdict(&[self.request.limits.size, self.request.limits.position]));
            }
        }
        self.calls([[423, 410], [424, 411]][usize::from(!pairs.internal)][usize::from(row.is_some())], parameters);
        self.stores(&[("center.x", 151), ("center.y", 152), codes[0], codes[1]]);
        if row.is_none() {
            self.stops_for(&codes.map(|(code, _)| code), self.request.limits.size);
            self.stops_for(&["center.x", "center.y"], self.request.limits.position);
        }
        Ok(())
    }

    fn width(&mut self, pairs: &Pairs, axis: usize, set_up: f64) -> Result<(), Refused> {
        let path = self.request.path;
        let (center, height, side) = (path.frame.origin, path.touches[0].point.z, &pairs.sides[0]);
        let (high, width, row) = (self.high(), side.width.value, self.row());
        let along = [Vec3::X, Vec3::Y][axis];
        let lifts = side.clearance.is_some();
        if pairs.internal && lifts && row.is_none() {
            let message = text!(
                "Only cycle 408 lifts between the walls of a groove, and it writes a preset; 425, which measures only, goes straight across. Choose a work offset; in a set-up the last cycle alone writes one"
            );
            return Err(own::refused("cycle-no-lift", "control.workOffset", message));
        }
        let measuring = (272, Plain((axis + 1) as f64));
        let aside = self.request.setup.radius + self.request.set_up + set_up;
        let datum = [(321, Length(center.x)), (322, Length(center.y)), (311, Length(width)), measuring];
        let place = [(261, Length(height)), (320, Length(set_up)), (260, Length(high))];
        match (pairs.internal, row) {
            (true, Some(row)) => {
                self.begins_at(center + along * (width / 2.0 - aside).max(0.0), high);
                let mut parameters = [datum.as_slice(), &place, &[(301, flag(lifts))]].concat();
                self.writes(row, &[(405, center[axis])], &mut parameters, true);
                self.calls(408, parameters);
            }
            (true, None) => {
                self.begins_at(center, high);
                let mut parameters = vec![
                    (328, Length(center.x)),
                    (329, Length(center.y)),
                    (310, Length(0.0)),
                    measuring,
                    (261, Length(height)),
                    (260, Length(high)),
                    (311, Length(width)),
                ];
                parameters.extend(self.sizes(288, 289, width));
                parameters.extend(self.verdict(&[self.request.limits.size]));
                self.calls(425, parameters);
                self.stores(&[(["center.x", "center.y"][axis], 157), ("width", 156)]);
                self.stops_for(&["width"], self.request.limits.size);
            }
            (false, Some(row)) => {
                self.begins_at(center + along * (width / 2.0 + aside), high);
                let mut parameters = [datum.as_slice(), &place].concat();
                self.writes(row, &[(405, center[axis])], &mut parameters, true);
                self.calls(409, parameters);
            }
            (false, None) => {
                self.begins_at(center + along * (width / 2.0 + aside), high);
                let [one, two] = [center + along * (width / 2.0), center - along * (width / 2.0)];
                let mut parameters = vec![
                    (263, Length(one.x)),
                    (264, Length(one.y)),
                    (265, Length(two.x)),
                    (266, Length(two.y)),
                    measuring,
                    (261, Length(height)),
                    (320, Length(set_up)),
                    (260, Length(high)),
                    (311, Length(width)),
                ];
                parameters.extend(self.sizes(288, 289, width));
                parameters.extend(self.verdict(&[self.request.limits.size]));
                self.calls(426, parameters);
                self.stores(&[(["center.x", "center.y"][axis], 157), ("width", 156)]);
                self.stops_for(&["width"], self.request.limits.size);
            }
        }
        let top = path.searches().find(|(k, ..)| *k == 2);
        if let Some((k, Some(from), _)) = top {
            let touch = &path.touches[k];
            let entry = Entry { field: "cycle.middleClearance", value: (from - touch.point).dot(touch.vector) };
            let set_up = self.set_up(entry)?;
            self.touches_surface(touch.point, touch.vector, set_up, high, "cycle")?;
            // The code of the top is the height.
            self.stored.iter_mut().filter(|(code, _)| *code == "point.z").for_each(|(code, _)| *code = "height");
        }
        Ok(())
    }

    /// The path that the cycles make on the nominal part.
    fn finish(mut self, meets: Meets<'_>) -> Result<Path, Refused> {
        if let Some(row) = self.row() {
            self.blocks.push(OwnBlock::Cycle(247, vec![(339, Plain(row))]));
        }
        let Plan { request, blocks, stored, guards, first } = self;
        let reach = Reach { set_up: request.set_up, behind: request.setup.overtravel };
        made::planned(request, Drafted { blocks, stored, guards, first, reach }, call, meets).map_err(|alarm| {
            let message = match alarm {
                Some(alarm) => text!("On the nominal part the control's own cycle would stop: {alarm}", what(alarm)),
                None => text!("The control's own cycle would touch other surfaces than the documented one does"),
            };
            own::refused("cycle-stops", "cycle", message)
        })
    }
}

fn flag(on: bool) -> Quantity {
    Plain(f64::from(u8::from(on)))
}

/// What stops a cycle.
fn what(alarm: Alarm) -> Text {
    match alarm {
        Alarm::NotFound => text!("a touch makes no contact"),
        _ => text!("the probe touches something on its way"),
    }
}

/// What these cycles do otherwise than the job says.
pub(super) fn check(request: &Request<'_>, checker: &mut Checker) {
    let message = text!(
        "The program calls the control's own cycles: order, feeds and clearances are theirs and the probe table's. Blocks follow posted programs, moves the pages of the control's manual that we have. Nothing of it was run on a control"
    );
    checker.info("not-verified", "control.form", message);
    let farthest = reach(request);
    let message = text!(
        "The probe table's DIST must be at least {dist}, the way to the farthest contact plus the overtravel: the control searches as far as DIST says",
        checker.length(farthest)
    );
    checker.info("dist-needed", "overtravel", message);
    check_write(request, checker);
    let own = request.path.own.iter().flat_map(|own| &own.blocks);
    let width = own.clone().find_map(|(block, _)| match block {
        OwnBlock::Cycle(number @ (425 | 426), _) => Some(*number),
        _ => None,
    });
    if let Some(number) = width.filter(|_| request.limits.position.is_some()) {
        let message = text!("Cycle {number} has no position tolerance: the position limit is not checked", usize::from(number));
        checker.warning("limits-not-asked", "limits.position", message);
    }
    if let Some(row) = request.work_offset {
        if request.limits.position.is_some() || request.limits.size.is_some() {
            let message = text!(
                "The cycles that write a preset have no tolerances: what they measure is written without a check of the limits. Measure without a work offset first"
            );
            checker.warning("limits-not-asked", "limits", message);
        }
        let message = text!(
            "Preset row {row} is written and activated: its other axes and its rotation keep the values in the table",
            row
        );
        checker.warning("row-activated", "control.workOffset", message);
    }
}

/// The longest search of the path, mm: from where a touch begins to its end.
fn reach(request: &Request<'_>) -> f64 {
    let ways =
        request.path.searches().filter_map(|(k, from, step)| Some(from?.distance(step.to) + request.path.touches[k].search));
    ways.fold(0.0, f64::max)
}

pub(super) fn emit(request: &Request<'_>, own: &Own, name: &str) -> Program {
    let mut w = Writer::new(request);
    let unit = if request.scale == 1.0 { "MM" } else { "INCH" };
    let length = |mm: f64| decimal(mm / request.scale, request.post.decimals(request.scale));
    w.parts(&["BEGIN PGM ", name, " ", unit]);
    w.comment(&format!("Job: {name}"));
    w.comment(&format!("{}: {}", request.source, request.title));
    w.comment(&format!(
        "Units {}, stylus ball diameter {}, overtravel {}",
        unit.to_ascii_lowercase(),
        length(2.0 * request.setup.radius),
        length(request.setup.overtravel)
    ));
    w.comment(&does::line(request, ": by the cycle, then activated by cycle 247"));
    w.comment(&match request.tool {
        Some(tool) => format!("Before the start: tool {tool} is the probe, it is called"),
        None => "Before the start: the probe is in the spindle and active, tool axis Z. No tool is called".to_owned(),
    });
    w.comment(&format!(
        "Above Z{} the cycle goes in the plane first, below it up to there first. Then down to the measuring height",
        length(own.first.z)
    ));
    w.comment(&format!(
        "Probe table: SET_UP {} {1}, DIST at least {2} {1}. F and FMAX are those of the table",
        length(own.reach.set_up),
        unit.to_ascii_lowercase(),
        length(reach(request))
    ));
    let stored = request.path.stored();
    let names: Vec<String> = stored.iter().map(|(code, stored)| format!("{} {code}", (CYCLES.name)(*stored))).collect();
    if !names.is_empty() {
        w.comment(&format!("Results: {}", names.join(", ")));
    }
    w.comment("Cycles 7, 8, 10, 11 and 26 must not be active; the cycle resets a basic rotation. FUNCTION MODE MILL only");
    w.comment("Not verified on a control: run it with a hand on the feed override");
    w.says_job();
    if let Some(tool) = request.tool {
        w.line(&format!("TOOL CALL {tool} Z S50"));
    }
    // To where the first touch begins.
    w.names_cycle(0);
    w.leaves_move();
    let mut made = 1;
    for (block, moves) in &own.blocks {
        if *moves > 0 {
            w.names_cycle(made);
            made += moves;
        }
        for _ in 0..*moves {
            w.leaves_move();
        }
        match block {
            OwnBlock::Cycle(number, parameters) => blocks::write(&mut w, request, *number, parameters),
            OwnBlock::Keep(variable, output) => w.line(&format!("FN 0: Q{variable} = +Q{output}")),
            // The next cycle goes there by itself.
            OwnBlock::Goes(..) | OwnBlock::Call(..) => {}
        }
    }
    w.parts(&["END PGM ", name, " ", unit]);
    w.finish()
}
