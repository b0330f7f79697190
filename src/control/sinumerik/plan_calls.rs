//! Plans the measuring cycles for a feature, their arguments, and the path that they make.
//!
//! Positions and fixed values are those of working generators and their calls [S], and so is the positive infeed: two of them, which copy the control's own
//! editor, ask for one without a sign. Open, and stated in the program: that a rectangle accepts both coordinates of the centre, that argument 10 rotates a
//! feature other than a hole, and, in inches, the unit of the measuring path.

use std::ops::Range;

use super::cycles;
use crate::control::iso::writer::Writer;
use crate::control::native::rows::{Asked, Found, Is, Probed, Shape, fitting};
use crate::control::native::siemens::ROWS;
use crate::control::native_run::CorrectsTools;
use crate::control::native_run::executed_path::{self, CallDraft};
use crate::control::native_run::machine::{Alarm, Machine};
use crate::control::native_run::{
    ContactQuery, CycleLinking, NativeCycles, NativeRequest, Rejections, degrees_of, refused,
};
use crate::control::sinumerik::LAST_REGISTER;
use crate::control::{Request, check_write};
use crate::form::Checker;
use crate::geom::{Plane, Vec3};
use crate::num::{decimal, wrap_degrees};
use crate::path::{
    Bore, CallBlock, Feature, Feed, FieldValue, Guard, Off, Pairs, Path, Point, ProbeTable,
    Quantity, ShiftTerm, Stored, Touch,
};
use crate::text::text;

use Quantity::{Angle, Length, Plain};

/// Shortest measuring path of a call, mm.
const SHORTEST_PATH: f64 = 0.1;

/// Codes of a centre.
const CENTER: [&str; 2] = ["center.x", "center.y"];

/// Tolerance for equal directions and positions.
const NEAR: f64 = 1e-6;

pub static CYCLES: NativeCycles = NativeCycles {
    plan: plan_calls,
    rerun: |own, radius, meets| executed_path::rerun(own, (radius, 0.0), run, meets),
    followed: true,
    word: |number, place| format!("CYCLE{number} {place}"),
    offset: |n| 10_000.0 + f64::from(n),
    name: |stored| match stored {
        Stored::Output(entry) => format!("_OVR[{entry}]"),
        Stored::Kept(register) => format!("R{register}"),
    },
    corrects_tools: CorrectsTools::Never,
    measures_first: false,
    several: CycleLinking {
        way: |to, _, _, (feed, _)| CallBlock::MoveTo(to, feed),
        links_itself: false,
        computes: true,
        activates: None,
        saved_variables: (1, LAST_REGISTER),
    },
};

/// Path of the measuring cycles for a job's feature, with the calls.
fn plan_calls(request: &NativeRequest<'_>, meets: ContactQuery<'_>) -> Result<Path, Rejections> {
    let path = request.path;
    if path.picked {
        let message = text!(
            "The measuring cycles choose their own touch points{advice}",
            request.advice()
        );
        return Err(refused("cycle-chooses-points", "cycle.touches", message));
    }
    if request.setup.plane != Plane::G17 {
        let message = text!(
            "No source at hand shows how a measuring cycle selects another plane than G17: it could probe in the wrong one{advice}",
            request.advice()
        );
        return Err(refused("cycle-plane", "plane", message));
    }
    let first = path.moves.first().map_or(Vec3::ZERO, |step| step.to);
    let mut program = Plan {
        request,
        radius: request.setup.radius,
        first,
        at: first,
        blocks: Vec::new(),
        stored: Vec::new(),
        guards: Vec::new(),
        kept: 0,
    };
    match &path.feature {
        Feature::Surface(point) => program.surface(point)?,
        Feature::Bore(bore) => program.bore(bore)?,
        Feature::Pairs(pairs) => program.pairs(pairs)?,
        Feature::Corner(_)
        | Feature::TwoCircles(_)
        | Feature::Unmoving
        | Feature::Wall(_)
        | Feature::Several => {
            return Ok(path.clone());
        }
    }
    program.finish(meets)
}

/// Runs a block; `None` if the block does not move.
fn run(block: &CallBlock, _: ProbeTable, machine: &mut Machine<'_>) -> Option<Result<(), Alarm>> {
    match block {
        CallBlock::Cycle(number, arguments) => {
            let values: Vec<(u16, f64)> = arguments
                .iter()
                .map(|(place, quantity)| (*place, quantity.value()))
                .collect();
            cycles::run(*number, &values, machine)
        }
        CallBlock::MoveTo(to, _) => Some(machine.watched(*to, None, Alarm::Obstructed)),
        CallBlock::Call(..) | CallBlock::SaveResult(..) | CallBlock::Compute(_) => None,
    }
}

/// A program under construction.
struct Plan<'a> {
    request: &'a NativeRequest<'a>,
    radius: f64,
    first: Vec3,
    at: Vec3,
    blocks: Vec<CallBlock>,
    stored: Vec<(&'static str, Stored)>,
    guards: Vec<Guard>,
    kept: usize,
}

impl Plan<'_> {
    /// A watched move of the program: after a cycle in any case, which ends at the feature that it found.
    fn goes(&mut self, to: Vec3, feed: Feed) {
        if to.distance(self.at) > NEAR
            || matches!(
                self.blocks.last(),
                Some(CallBlock::Cycle(..) | CallBlock::SaveResult(..))
            )
        {
            self.blocks.push(CallBlock::MoveTo(to, feed));
            self.at = to;
        }
    }

    /// Start of the first touch of the documented cycle, and the position before it.
    fn begins(&self) -> Vec3 {
        executed_path::begins(self.request.path).unwrap_or(self.first)
    }

    fn start(&self) -> Vec3 {
        executed_path::start(self.request.path).unwrap_or(self.first)
    }

    /// Down to the start of the cycle.
    fn down(&mut self, place: Vec3) {
        self.goes(self.start(), Feed::Approach);
        self.goes(place, Feed::LongLink);
    }

    fn up(&mut self) {
        let first = self.first;
        self.goes(self.at.with_z(first.z), Feed::Return);
    }

    /// Measuring path for a clearance from the wall to the ball centre. If the job touches from the middle it is the overtravel, but no more than the distance
    /// to the contact: no source shows the behaviour of the control without that room.
    fn path(&self, clearance: Option<FieldValue>, width: FieldValue) -> Result<f64, Rejections> {
        let room = FieldValue {
            field: width.field,
            value: self.radius
                + self
                    .request
                    .setup
                    .overtravel
                    .min(width.value / 2.0 - self.radius),
        };
        let clearance = clearance.unwrap_or(room);
        let path = clearance.value - self.radius;
        if path < SHORTEST_PATH {
            let message = text!(
                "The measuring path of the cycle (clearance minus ball radius, before and after each contact) would be {path}: at least {least} makes sense{advice}",
                self.request.length(path),
                self.request.length(SHORTEST_PATH),
                self.request.advice()
            );
            return Err(refused("cycle-path-short", clearance.field, message));
        }
        Ok(path)
    }

    /// Calls the cycle for a feature. `codes` are those of its results: centre and sizes.
    fn calls(&mut self, probed: &Probed, [places, sizes]: [&[&'static str]; 2]) {
        let Some(row) = fitting(&ROWS, probed) else {
            return;
        };
        let request = self.request;
        let asked = Asked {
            limits: request.limits,
            overtravel: request.setup.overtravel,
            radius: self.radius,
            ..Asked::default()
        };
        self.blocks
            .push(CallBlock::Cycle(row.number, row.call(probed, &asked)));
        // A centre along the measured axis is stored like that in the plane.
        let entry = |found: Found| {
            let later = if found.is == Is::Along {
                probed.axis
            } else {
                0
            };
            (found.code, found.number + later)
        };
        let found = row.found(probed, places, sizes);
        self.stores(&found.into_iter().map(entry).collect::<Vec<_>>());
    }

    /// A feature about the origin of the frame, rotated by these degrees; `down` is the distance to its touches.
    fn probed(&self, shape: Shape, inside: bool, path: f64, down: Option<f64>) -> Probed {
        let request = self.request;
        Probed {
            center: request.path.frame.origin,
            set_up: Some(path),
            lifts: down.is_some() && inside,
            down,
            row: request.work_offset.map(request.offset),
            ..Probed::unknown(shape, inside)
        }
    }

    fn stores(&mut self, results: &[(&'static str, usize)]) {
        self.stored.extend(
            results
                .iter()
                .map(|(code, entry)| (*code, Stored::Output(*entry))),
        );
        let places: Vec<&'static str> = results
            .iter()
            .map(|(code, _)| *code)
            .filter(|code| code.contains('.'))
            .collect();
        self.stops_for(&places);
    }

    /// The call stops if one of these results exceeds its safe range [R].
    fn stops_for(&mut self, codes: &[&'static str]) {
        let safe = self.blocks.iter().rev().find_map(|block| match block {
            CallBlock::Cycle(977, arguments) => arguments.iter().find(|(place, _)| *place == 9),
            CallBlock::Cycle(978, arguments) => arguments.iter().find(|(place, _)| *place == 7),
            _ => None,
        });
        let safe = safe.filter(|_| !codes.is_empty());
        self.guards.extend(safe.map(|(_, safe)| Guard {
            codes: codes.to_vec(),
            off: Off::Each,
            limit: safe.value(),
        }));
    }

    /// Saves the results of the last call before the next one overwrites them.
    fn keeps(&mut self) {
        for (_, stored) in &mut self.stored {
            if let Stored::Output(entry) = *stored {
                self.kept += 1;
                self.blocks.push(CallBlock::SaveResult(self.kept, entry));
                *stored = Stored::Kept(self.kept);
            }
        }
    }

    fn surface(&mut self, point: &Point) -> Result<(), Rejections> {
        let touch = &self.request.path.touches[0];
        let start = self.begins();
        let clearance = FieldValue {
            field: point.clearance,
            value: (start - touch.point).dot(touch.vector),
        };
        self.down(start);
        let codes = ["point.x", "point.y", "point.z"];
        self.touches_surface(touch, clearance, (point.elevation, codes))?;
        self.up();
        Ok(())
    }

    /// CYCLE978 from the stylus position. `codes` are those of the coordinates of the contact.
    fn touches_surface(
        &mut self,
        touch: &Touch,
        clearance: FieldValue,
        (field, codes): (&'static str, [&'static str; 3]),
    ) -> Result<(), Rejections> {
        let Touch { point, vector, .. } = *touch;
        let axis = (0..3)
            .find(|axis| executed_path::is_along(vector, *axis))
            .filter(|axis| *axis < 2 || vector.z > 0.0);
        let Some(axis) = axis else {
            let message = text!(
                "CYCLE978 touches along X and Y and downwards: this surface is turned or sloped{advice}",
                self.request.advice()
            );
            return Err(refused("cycle-not-parallel", field, message));
        };
        let path = self.path(Some(clearance), clearance)?;
        let probed = Probed {
            center: point,
            axis,
            towards: -vector[axis].signum(),
            ..self.probed(Shape::Surface, false, path, None)
        };
        self.calls(&probed, [&[], &[]]);
        self.stops_for(&[codes[axis]]);
        Ok(())
    }

    fn bore(&mut self, bore: &Bore) -> Result<(), Rejections> {
        let path = self.request.path;
        let (center, touches) = (path.frame.origin, &path.touches);
        let inside = touches
            .first()
            .is_some_and(|touch| (touch.point - center).dot(touch.vector) < 0.0);
        let angles: Vec<f64> = touches
            .iter()
            .map(|touch| degrees_of(touch.point - center))
            .collect();
        if !executed_path::are_quarters(&angles) {
            let message = text!(
                "CYCLE977 touches a circle at four points a quarter turn apart: not at {count} like these{advice}",
                angles.len(),
                self.request.advice()
            );
            return Err(refused("cycle-chooses-points", "cycle.stepCount", message));
        }
        let measuring = self.path(bore.clearance, bore.diameter)?;
        let start = if bore.clearance.is_some() {
            self.start()
        } else {
            self.begins()
        };
        let down = bore.clearance.map(|_| start.z - touches[0].point.z);
        let probed = Probed {
            sizes: [bore.diameter.value, f64::NAN],
            turn: angles[0],
            ..self.probed(Shape::Bore, inside, measuring, down)
        };
        self.check_zones(&probed, &[bore.clearance])?;
        self.down(start);
        self.calls(&probed, [&CENTER, &["diameter"]]);
        self.up();
        Ok(())
    }

    /// Checks whether the ball leaves room for a zone where it goes down between walls.
    fn check_zones(
        &self,
        probed: &Probed,
        clearances: &[Option<FieldValue>],
    ) -> Result<(), Rejections> {
        if !(probed.inside && probed.lifts) {
            return Ok(());
        }
        for (n, clearance) in clearances.iter().enumerate() {
            if let Some(clearance) = clearance
                && probed.zone(n, self.radius) <= 0.0
            {
                let message = text!(
                    "The points where the ball descends leave no room for a protection zone{advice}",
                    self.request.advice()
                );
                return Err(refused("cycle-no-zone", clearance.field, message));
            }
        }
        Ok(())
    }

    fn pairs(&mut self, pairs: &Pairs) -> Result<(), Rejections> {
        let path = self.request.path;
        let touches = &path.touches;
        let clearances: Vec<FieldValue> = pairs
            .sides
            .iter()
            .filter_map(|side| side.clearance)
            .collect();
        if let [one, two] = clearances.as_slice()
            && (one.value - two.value).abs() > NEAR
        {
            let message = text!(
                "CYCLE977 has one measuring path for all four walls: both side clearances must be the same{advice}",
                self.request.advice()
            );
            return Err(refused("cycle-one-path", two.field, message));
        }
        let narrowest = pairs
            .sides
            .iter()
            .map(|side| side.width)
            .min_by(|a, b| a.value.total_cmp(&b.value));
        let Some(narrowest) = narrowest else {
            return Ok(());
        };
        let measuring = self.path(clearances.first().copied(), narrowest)?;
        let beside = !clearances.is_empty();
        // Direction of the first pair, from −90 to 90.
        let mut angle = degrees_of(touches[0].vector);
        if angle <= -90.0 + NEAR || angle > 90.0 + NEAR {
            angle = wrap_degrees(angle + 180.0);
        }
        let along_y = (angle.abs() - 90.0).abs() < NEAR;
        let turned = !along_y && angle.abs() > NEAR;
        let start = if beside { self.start() } else { self.begins() };
        let down = beside.then_some(start.z - touches[0].point.z);
        let turn = if turned { angle } else { 0.0 };
        if let [one, two] = pairs.sides.as_slice() {
            let mut sides = [one, two];
            if along_y {
                sides.swap(0, 1);
            }
            let probed = Probed {
                sizes: sides.map(|side| side.width.value),
                turn,
                ..self.probed(Shape::Rectangle, pairs.internal, measuring, down)
            };
            self.check_zones(&probed, &sides.map(|side| side.clearance))?;
            self.down(start);
            self.calls(&probed, [&CENTER, &[]]);
        } else {
            let axis = usize::from(along_y);
            let probed = Probed {
                sizes: [narrowest.value, f64::NAN],
                axis,
                turn,
                ..self.probed(Shape::Width, pairs.internal, measuring, down)
            };
            self.check_zones(&probed, &[pairs.sides[0].clearance])?;
            if turned && self.request.work_offset.is_some() {
                let message = text!(
                    "No source documents how CYCLE977 corrects a work offset along a rotated groove or web: write no work offset{advice}",
                    self.request.advice()
                );
                return Err(refused("cycle-not-parallel", "control.workOffset", message));
            }
            self.down(start);
            let places: &[&str] = if turned { &[] } else { &CENTER };
            self.calls(&probed, [places, &["width"]]);
        }
        if let Some((k, Some(from), _)) = path
            .searches()
            .find(|(k, ..)| *k == 2 && pairs.sides.len() == 1)
        {
            let touch = &touches[k];
            self.keeps();
            self.goes(self.at.with_z(self.at.z.max(from.z)), Feed::LongLink);
            self.goes(from.with_z(self.at.z), Feed::LongLink);
            self.goes(from, Feed::LongLink);
            let clearance = FieldValue {
                field: "cycle.middleClearance",
                value: (from - touch.point).dot(touch.vector),
            };
            let codes = ["point.x", "point.y", "height"];
            self.touches_surface(touch, clearance, ("cycle", codes))?;
        }
        self.up();
        Ok(())
    }

    /// Path of the program on the nominal part.
    fn finish(self, meets: ContactQuery<'_>) -> Result<Path, Rejections> {
        let Plan {
            request,
            first,
            blocks,
            stored,
            guards,
            ..
        } = self;
        executed_path::planned(
            request,
            CallDraft {
                blocks,
                stored,
                guards,
                first,
                reach: ProbeTable::default(),
            },
            run,
            meets,
        )
        .map_err(|alarm| {
            let message = match alarm {
                Some(_) => {
                    text!(
                        "On the nominal part the cycle would collide on its path{advice}",
                        self.request.advice()
                    )
                }
                None => {
                    text!(
                        "The cycle would touch other surfaces than the documented one does{advice}",
                        self.request.advice()
                    )
                }
            };
            refused("cycle-stops", "cycle", message)
        })
    }
}

/// Argument of a call at a position.
fn argument(request: &Request<'_>, place: u16) -> Option<f64> {
    let own = request.path.calls.as_ref()?;
    own.blocks.iter().find_map(|(block, _)| match block {
        CallBlock::Cycle(977, arguments) => arguments
            .iter()
            .find(|(known, _)| *known == place)
            .map(|(_, x)| x.value()),
        _ => None,
    })
}

/// Reports where the cycles differ from the job.
pub fn check(request: &Request<'_>, checker: &mut Checker) {
    let Some(own) = &request.path.calls else {
        return;
    };
    check_write(request, checker);
    let paths = own.blocks.iter().filter_map(|(block, _)| match block {
        CallBlock::Cycle(number, arguments) => {
            let place = if *number == 977 { 8 } else { 6 };
            arguments
                .iter()
                .find(|(known, _)| *known == place)
                .map(|(_, path)| path.value())
        }
        _ => None,
    });
    let mut others: Vec<String> = paths
        .filter(|path| (path - request.setup.overtravel).abs() > NEAR)
        .map(|path| checker.length(path))
        .collect();
    others.dedup();
    if !others.is_empty() {
        let message = text!(
            "The cycle searches {path} before and after each contact instead of the job's overtravel, and measures at its own feed",
            others.join(" / ")
        );
        checker.warning("cycle-differs", "control.form", message);
    }
}

/// Notes about the cycles for the header.
pub fn notes(request: &Request<'_>) -> Vec<String> {
    let mut notes = Vec::new();
    let Some(own) = &request.path.calls else {
        return notes;
    };
    let stored = request.path.stored();
    let names: Vec<String> = stored
        .iter()
        .map(|(code, stored)| format!("{} {code}", (CYCLES.name)(*stored)))
        .collect();
    let results = if names.is_empty() {
        "_OVR of the measuring cycle".to_owned()
    } else {
        names.join(", ")
    };
    notes.push(format!(
        "Results: {results}; probe data set 1, the control's own measuring feed"
    ));
    if stored
        .iter()
        .any(|(_, stored)| matches!(stored, Stored::Output(4)))
        || own
            .blocks
            .iter()
            .any(|(block, _)| matches!(block, CallBlock::SaveResult(_, 4)))
    {
        notes.push("NOT VERIFIED: that _OVR[4] is the size".to_owned());
    }
    if argument(request, 7).is_some() {
        notes.push("NOT VERIFIED: that a rectangle takes both 28 and 29, the centre".to_owned());
    }
    if argument(request, 5).is_none_or(|_| argument(request, 14).is_some())
        && argument(request, 10).is_some_and(|angle| angle != 0.0)
    {
        notes.push("NOT VERIFIED: that argument 10 turns it".to_owned());
    }
    if request.scale != 1.0 {
        notes.push("NOT VERIFIED: the measuring path is written in inches; its forerunner _FA was in mm always".to_owned());
    }
    notes
}

/// The blocks, each with its index and its moves.
fn blocks<'a>(request: &Request<'a>) -> impl Iterator<Item = (usize, &'a CallBlock, Range<usize>)> {
    // The first move ends where the cycles count from.
    let mut at = 1;
    let own = request.path.calls.iter().flat_map(|own| &own.blocks);
    own.enumerate().map(move |(i, (block, moves))| {
        at += moves;
        (i, block, at - moves..at)
    })
}

/// The calls, each with its index among the blocks, and its moves.
fn calls<'a>(request: &Request<'a>) -> Vec<(usize, &'a CallBlock, Range<usize>)> {
    blocks(request)
        .filter(|(_, block, _)| matches!(block, CallBlock::Cycle(..)))
        .collect()
}

/// Blocks without a move, before this move.
pub fn between<'a>(request: &Request<'a>, index: usize) -> Vec<&'a CallBlock> {
    let still = move |(_, block, moves): (usize, &'a CallBlock, Range<usize>)| {
        let computes = matches!(block, CallBlock::SaveResult(..) | CallBlock::Compute(_));
        (computes && moves.start == index).then_some(block)
    };
    blocks(request).filter_map(still).collect()
}

/// Moves of each cycle, in the order of the calls.
pub fn ranges(request: &Request<'_>) -> Vec<Range<usize>> {
    calls(request)
        .into_iter()
        .map(|(.., moves)| moves)
        .collect()
}

/// Whether a move starts at the end of a cycle that corrects nothing: in the measured middle, not in the nominal one.
pub fn starts_off_centre(request: &Request<'_>, index: usize) -> bool {
    calls(request)
        .iter()
        .any(|(_, block, moves)| moves.end == index && !block.writes())
}

/// Writes the call that makes these moves. `shift` prints the terms that shift a word.
pub fn call(
    request: &Request<'_>,
    which: usize,
    w: &mut Writer<'_>,
    shift: &dyn Fn(&[ShiftTerm]) -> String,
) {
    let own = request.path.calls.as_ref();
    let calls = calls(request);
    let (Some(own), Some((index, CallBlock::Cycle(number, arguments), _))) =
        (own, calls.get(which))
    else {
        return;
    };
    let last = arguments.iter().map(|(place, _)| *place).max().unwrap_or(0);
    // The name of a tool stays empty.
    let name = if *number == 977 { 16 } else { 11 };
    let text = |place: u16| {
        if place == name {
            return "\"\"".to_owned();
        }
        let Some(word) = arguments.iter().position(|(known, _)| *known == place) else {
            return String::new();
        };
        let value = match arguments[word].1 {
            Length(mm) | Quantity::Feed(mm) => w.number(mm).to_string(),
            Angle(x) => decimal(x, 4),
            Plain(x) => decimal(x, 0),
        };
        value + &shift(own.shifts(*index, word))
    };
    let block = format!(
        "CYCLE{number}({})",
        (1..=last).map(text).collect::<Vec<_>>().join(",")
    );
    w.line(&block);
}
