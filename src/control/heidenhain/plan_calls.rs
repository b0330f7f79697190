//! Plans the 4xx cycles for a feature and the path that they make: cycles that only measure, or cycles that write a row of the preset table.

use super::functions::Functions;
use super::{blocks, cycles};
use crate::control::iso::writer::Writer;
use crate::control::native::heidenhain::{ROWS, row};
use crate::control::native::rows::{Asked, Found, Is, Probed, Shape, fitting};
use crate::control::native_run::executed_path::{self, CallDraft};
use crate::control::native_run::machine::{Alarm, Machine};
use crate::control::native_run::{
    ContactQuery, CorrectsTools, CycleLinking, NativeCycles, NativeRequest, Rejections, degrees_of,
};
use crate::control::shop::place;
use crate::control::{Program, Request, ResultOutput, check_write, native_run, write_summary};
use crate::form::Checker;
use crate::formula::SingleTouch;
use crate::geom::{Plane, Vec3};
use crate::num::{decimal, wrap_degrees};
use crate::path::{
    Bore, CallBlock, CallSequence, Feature, FieldValue, Guard, Off, Pairs, Path, Point, ProbeTable,
    Quantity, Stored, Touch,
};
use crate::text::{Text, text};

/// Tolerance for equal directions and positions.
const NEAR: f64 = 1e-6;

pub static CYCLES: NativeCycles = NativeCycles {
    plan: plan_calls,
    rerun: |own, radius, meets| executed_path::rerun(own, (radius, 0.0), call, meets),
    followed: false,
    offset: f64::from,
    word: |number, q| format!("{number} Q{q}"),
    name: |stored| match stored {
        Stored::Output(q) | Stored::Kept(q) => format!("Q{q}"),
    },
    corrects_tools: CorrectsTools::WholeError,
    measures_first: true,
    several: CycleLinking {
        way: |to, _, _, (feed, _)| CallBlock::MoveTo(to, feed),
        links_itself: true,
        computes: true,
        activates: Some(|row| activates(f64::from(row))),
        saved_variables: FREE,
    },
};

/// Q parameters that the manuals leave to programs [S: TNC 620, TNC 640]: no cycle uses them.
const FREE: (usize, usize) = (1600, 1979);

/// Block that activates a row of the preset table.
fn activates(row: f64) -> CallBlock {
    CallBlock::Cycle(247, vec![(339, Quantity::Plain(row))])
}

/// The path of native cycles for a job's feature, with the calls. 1411 is the documented path itself.
fn plan_calls(request: &NativeRequest<'_>, meets: ContactQuery<'_>) -> Result<Path, Rejections> {
    let path = request.path;
    if path.feature.two_circles().is_some() {
        return Ok(path.clone());
    }
    if request.setup.plane != Plane::G17 {
        let message = text!(
            "None of our sources shows how these cycles handle the tool axis of a plane other than G17"
        );
        return Err(native_run::refused("cycle-plane", "plane", message));
    }
    if path.picked {
        let message = text!("Native cycles choose their touch points: picked ones cannot be used");
        return Err(native_run::refused(
            "cycle-chooses-points",
            "cycle.touches",
            message,
        ));
    }
    let mut program = Plan {
        request,
        blocks: Vec::new(),
        stored: Vec::new(),
        guards: Vec::new(),
        first: Vec3::ZERO,
    };
    match &path.feature {
        Feature::Surface(point) => program.surface(point)?,
        Feature::Bore(bore) => program.bore(bore)?,
        Feature::Pairs(pairs) => program.pairs(pairs)?,
        Feature::Corner(_) | Feature::Wall(_) => return program.single_touches(meets),
        Feature::TwoCircles(_) | Feature::Unmoving | Feature::Several => {
            return Ok(path.clone());
        }
    }
    let mut path = program.finish(meets)?;
    if let Some(own) = path.calls.as_mut().filter(|_| request.measures_first) {
        let measuring = NativeRequest {
            work_offset: None,
            wear: &[],
            measures_first: false,
            ..*request
        };
        let measuring = plan_calls(&measuring, meets).map_err(|_| {
            let message = text!(
                "No cycle that only measures takes this feature as the job has it: the program cannot show the results before it writes"
            );
            native_run::refused("ask-unsupported", "control.ask", message)
        })?;
        own.measuring = measuring.calls.map_or_else(Vec::new, |own| own.blocks);
    }
    Ok(path)
}

/// Runs a block; `None` if the block does not move.
fn call(
    block: &CallBlock,
    reach: ProbeTable,
    machine: &mut Machine<'_>,
) -> Option<Result<(), Alarm>> {
    let CallBlock::Cycle(number, parameters) = block else {
        return None;
    };
    let values: Vec<(u16, f64)> = parameters
        .iter()
        .map(|(q, quantity)| (*q, quantity.value()))
        .collect();
    cycles::run(*number, &values, reach, machine)
}

/// A program under construction.
struct Plan<'a> {
    request: &'a NativeRequest<'a>,
    blocks: Vec<CallBlock>,
    stored: Vec<(&'static str, Stored)>,
    guards: Vec<Guard>,
    first: Vec3,
}

/// Q parameter in which cycle 427 leaves the measured coordinate.
const COORDINATE: usize = 160;

/// Codes of a centre.
const CENTER: [&str; 2] = ["center.x", "center.y"];

impl Plan<'_> {
    /// Number of the preset row that is written; `None` only measures.
    fn row(&self) -> Option<f64> {
        self.request.work_offset.map(f64::from)
    }

    /// Clearance height of a cycle. In a set-up it is not below the link moves, which the cycles make themselves.
    fn clearance_height(&self, alone: f64) -> f64 {
        self.request.clear.map_or(alone, |clear| clear.max(alone))
    }

    /// Height at which the ball crosses between touches and at which the cycles end: as high as the documented path crosses or begins.
    fn high(&self) -> f64 {
        let path = self.request.path;
        let level = path
            .touches
            .iter()
            .map(|touch| touch.point.z)
            .fold(f64::NEG_INFINITY, f64::max);
        let crosses = executed_path::start(path).filter(|start| start.z > level + NEAR);
        self.clearance_height(
            crosses
                .or(path.moves.first().map(|step| step.to))
                .map_or(level, |place| place.z),
        )
    }

    fn begins_at(&mut self, place: Vec3, high: f64) {
        if self.blocks.is_empty() {
            self.first = place.with_z(high);
        }
    }

    /// Q320: a clearance from the wall to the ball centre, less the ball radius and SET_UP.
    fn set_up(&self, clearance: FieldValue) -> Result<f64, Rejections> {
        let left = clearance.value - self.request.setup.radius - self.request.set_up;
        if left < -NEAR {
            let message = text!(
                "The probe table's SET_UP ({set_up}) and the ball's radius ({radius}) are more than this clearance: a touch would begin farther away",
                self.request.length(self.request.set_up),
                self.request.length(self.request.setup.radius)
            );
            return Err(native_run::refused(
                "set-up-too-long",
                clearance.field,
                message,
            ));
        }
        Ok(left.max(0.0))
    }

    /// Q320 if the job gives no clearance: a touch begins as far before its contact as it searches past it.
    fn free_set_up(&self) -> f64 {
        (self.request.setup.overtravel - self.request.set_up).max(0.0)
    }

    /// Calls the cycle for a feature. `codes` are those of its results: centre and sizes.
    fn calls(&mut self, probed: &Probed, [places, sizes]: [&[&'static str]; 2]) {
        let Some(row) = fitting(&ROWS, probed) else {
            return;
        };
        let log = match self.request.report {
            // A coordinate that is no result.
            _ if places.contains(&"") => 0.0,
            ResultOutput::None => 0.0,
            ResultOutput::Log => 1.0,
            ResultOutput::Screen => 2.0,
        };
        let limits = self.request.limits;
        let mut wear = self.request.wear.iter();
        let tool = wear.find_map(|(code, wear)| {
            sizes
                .contains(&code.as_str())
                .then_some(f64::from(wear.tool))
        });
        self.blocks.push(CallBlock::Cycle(
            row.number,
            row.call(
                probed,
                &Asked {
                    limits,
                    log,
                    tool: tool.unwrap_or(0.0),
                    ..Asked::default()
                },
            ),
        ));
        let found = row.found(probed, places, sizes);
        let stored = |found: &Found| (found.code, Stored::Output(found.number));
        self.stored.extend(found.iter().map(stored));
        let [for_sizes, for_places] = row.stops();
        let stops = [
            (for_sizes, limits.size, true),
            (for_places, limits.position, false),
        ];
        for (_, limit, of_sizes) in stops.into_iter().filter(|(stops, ..)| *stops) {
            let is_size = |found: &&Found| matches!(found.is, Is::Size(_)) == of_sizes;
            let codes = found.iter().filter(is_size).map(|found| found.code);
            let codes: Vec<&'static str> = codes.collect();
            self.guards.extend(limit.map(|limit| Guard {
                codes,
                off: Off::Each,
                limit,
            }));
        }
    }

    /// A feature about the origin of the frame, touched at this height.
    fn probed(&self, shape: Shape, inside: bool, set_up: f64) -> Probed {
        let path = self.request.path;
        let height = path.touches.first().map_or(0.0, |touch| touch.point.z);
        Probed {
            center: path.frame.origin.with_z(height),
            set_up: Some(set_up),
            high: Some(self.high()),
            row: self.row(),
            ..Probed::unknown(shape, inside)
        }
    }

    /// Distance from a contact to the start of its touch.
    fn aside(&self, set_up: f64) -> f64 {
        set_up + self.request.set_up + self.request.setup.radius
    }

    fn surface(&mut self, point: &Point) -> Result<(), Rejections> {
        let path = self.request.path;
        let touch = &path.touches[0];
        let start = executed_path::begins(path).unwrap_or(touch.point);
        let entry = FieldValue {
            field: point.clearance,
            value: (start - touch.point).dot(touch.vector),
        };
        let set_up = self.set_up(entry)?;
        let high = self.clearance_height(path.moves.first().map_or(start.z, |step| step.to.z));
        self.touches_surface(
            touch,
            (set_up, high),
            (point.elevation, ["point.x", "point.y", "point.z"]),
        )
    }

    /// One touch of a surface across an axis. `codes` are those of its coordinates.
    fn touches_surface(
        &mut self,
        touch: &Touch,
        (set_up, high): (f64, f64),
        (field, codes): (&'static str, [&'static str; 3]),
    ) -> Result<(), Rejections> {
        let Some(axis) = (0..3).find(|axis| executed_path::is_along(touch.vector, *axis)) else {
            let message = text!(
                "Native cycles touch surfaces perpendicular to X, Y or Z: this one is rotated or sloped"
            );
            return Err(native_run::refused("cycle-not-parallel", field, message));
        };
        self.begins_at(touch.point + touch.vector * self.aside(set_up), high);
        let towards = -touch.vector[axis].signum();
        let probed = self.probed(Shape::Surface, false, set_up);
        self.calls(
            &Probed {
                center: touch.point,
                axis,
                towards,
                high: Some(high),
                ..probed
            },
            [&codes, &[]],
        );
        Ok(())
    }

    fn bore(&mut self, bore: &Bore) -> Result<(), Rejections> {
        let path = self.request.path;
        let (center, touches) = (path.frame.origin, &path.touches);
        let inside = touches
            .first()
            .is_some_and(|touch| (touch.point - center).dot(touch.vector) < 0.0);
        let mut angles: Vec<f64> = touches
            .iter()
            .map(|touch| degrees_of(touch.point - center))
            .collect();
        let start = angles[0];
        // By the angle of the first, counter-clockwise, or clockwise where they are documented so.
        let square = executed_path::are_quarters(&angles);
        let step = if square {
            90.0
        } else {
            wrap_degrees(angles.get(1).map_or(0.0, |second| second - start))
        };
        if square {
            angles = (0..4).map(|k| start + 90.0 * f64::from(k)).collect();
        }
        let even = angles
            .iter()
            .enumerate()
            .all(|(k, angle)| wrap_degrees(angle - start - step * k as f64).abs() < 1e-4);
        // In our sources the measuring cycles touch four times.
        let fewest = if self.row().is_some() { 3 } else { 4 };
        if !(fewest..=4).contains(&angles.len())
            || !even
            || !(5.0 - NEAR..=120.0 + NEAR).contains(&step.abs())
        {
            let message = text!(
                "Native cycles touch a circle four times, 5° to 120° apart (three times when they write a preset): not {count} times like this",
                angles.len()
            );
            return Err(native_run::refused(
                "cycle-chooses-points",
                "cycle.stepCount",
                message,
            ));
        }
        let set_up = bore
            .clearance
            .map_or(Ok(self.free_set_up()), |clearance| self.set_up(clearance))?;
        let sign = if inside { -1.0 } else { 1.0 };
        let towards = (touches[0].point - center).with_z(0.0).normalize_or_zero();
        let off = (bore.diameter.value / 2.0 + sign * self.aside(set_up)).max(0.0);
        self.begins_at(center + towards * off, self.high());
        let probed = Probed {
            sizes: [bore.diameter.value, f64::NAN],
            lifts: bore.clearance.is_some() || !inside,
            start,
            step,
            count: angles.len() as f64,
            ..self.probed(Shape::Bore, inside, set_up)
        };
        self.calls(&probed, [&CENTER, &["diameter"]]);
        Ok(())
    }

    fn pairs(&mut self, pairs: &Pairs) -> Result<(), Rejections> {
        let path = self.request.path;
        let Some(axis) = (0..2).find(|axis| executed_path::is_along(path.touches[0].vector, *axis))
        else {
            let message = text!("Native cycles support walls along X and Y: these are rotated");
            return Err(native_run::refused(
                "cycle-not-parallel",
                "cycle.rotation",
                message,
            ));
        };
        let clearances: Vec<FieldValue> = pairs
            .sides
            .iter()
            .filter_map(|side| side.clearance)
            .collect();
        if let [one, two] = clearances.as_slice()
            && (one.value - two.value).abs() > NEAR
        {
            let message = text!(
                "One set-up clearance holds for all sides of a rectangle: both side clearances must be the same"
            );
            return Err(native_run::refused("cycle-one-path", two.field, message));
        }
        let set_up = clearances
            .first()
            .map_or(Ok(self.free_set_up()), |clearance| self.set_up(*clearance))?;
        match pairs.sides.as_slice() {
            [one, two] => {
                self.rectangle(pairs, [one, two].map(|side| side.width.value), axis, set_up)
            }
            _ => return self.width(pairs, axis, set_up),
        }
        Ok(())
    }

    /// Sides along X and Y; the first pair of the job may lie along Y.
    fn rectangle(&mut self, pairs: &Pairs, mut sizes: [f64; 2], axis: usize, set_up: f64) {
        let mut codes = ["width1", "width2"];
        if axis == 1 {
            sizes.swap(0, 1);
            codes.swap(0, 1);
        }
        let off = if pairs.internal {
            -self.aside(set_up)
        } else {
            self.aside(set_up)
        };
        let room = sizes.iter().all(|side| side / 2.0 + off >= 0.0);
        let start = Vec3::X * if room { sizes[0] / 2.0 + off } else { 0.0 };
        self.begins_at(self.request.path.frame.origin + start, self.high());
        let lifts = !pairs.internal || pairs.sides[0].clearance.is_some();
        let probed = Probed {
            sizes,
            lifts,
            ..self.probed(Shape::Rectangle, pairs.internal, set_up)
        };
        self.calls(&probed, [&CENTER, &codes]);
    }

    fn width(&mut self, pairs: &Pairs, axis: usize, set_up: f64) -> Result<(), Rejections> {
        let path = self.request.path;
        let (side, writes) = (&pairs.sides[0], self.row().is_some());
        let lifts = side.clearance.is_some();
        if pairs.internal && lifts && !writes {
            let message = text!(
                "Only cycle 408 retracts between the walls of a groove, and it writes a preset; cycle 425, which only measures, moves straight across. Choose a work offset; in a set-up only the last cycle writes one"
            );
            return Err(native_run::refused(
                "cycle-no-lift",
                "control.workOffset",
                message,
            ));
        }
        let sizes = [side.width.value, f64::NAN];
        let probed = Probed {
            sizes,
            axis,
            towards: 1.0,
            lifts,
            ..self.probed(Shape::Width, pairs.internal, set_up)
        };
        let half = sizes[0] / 2.0;
        let off = match (pairs.internal, writes) {
            (true, true) => (half - self.aside(set_up)).max(0.0),
            // Touches on both sides of the current position.
            (true, false) => 0.0,
            (false, _) => half + self.aside(set_up),
        };
        self.begins_at(path.frame.origin + probed.along() * off, self.high());
        self.calls(&probed, [&CENTER, &["width"]]);
        let top = path.searches().find(|(k, ..)| *k == 2);
        if let Some((k, Some(from), _)) = top {
            let touch = &path.touches[k];
            let entry = FieldValue {
                field: "cycle.middleClearance",
                value: (from - touch.point).dot(touch.vector),
            };
            let set_up = self.set_up(entry)?;
            self.touches_surface(
                touch,
                (set_up, self.high()),
                ("cycle", ["point.x", "point.y", "height"]),
            )?;
        }
        Ok(())
    }

    /// A cycle that the control has not: each touch by cycle 427, and the results by the formula over the measured coordinates.
    fn single_touches(mut self, meets: ContactQuery<'_>) -> Result<Path, Rejections> {
        let path = self.request.path;
        if self.row().is_some() {
            let message = text!(
                "This feature is measured by single touches, which write nothing: leave the work offset empty"
            );
            let field = "control.workOffset";
            return Err(native_run::refused(
                "work-offset-unsupported",
                field,
                message,
            ));
        }
        let (radius, high) = (self.request.setup.radius, self.high());
        let mut touches: Vec<Option<SingleTouch>> = vec![None; path.touches.len()];
        let mut measured = Vec::new();
        for (k, from, _) in path.searches() {
            let touch = &path.touches[k];
            let entry = FieldValue {
                field: "cycle",
                value: from.map_or(0.0, |from| (from - touch.point).dot(touch.vector)),
            };
            let set_up = self.set_up(entry)?;
            self.touches_surface(touch, (set_up, high), ("cycle.rotation", [""; 3]))?;
            // The coordinate is a value of the formula, and no result.
            self.stored.clear();
            self.guards.clear();
            let variable = FREE.0 + measured.len();
            self.blocks
                .push(CallBlock::SaveResult(variable, COORDINATE));
            measured.push((k, Stored::Kept(variable)));
            let axis = (0..3).find(|axis| executed_path::is_along(touch.vector, *axis));
            let axis = axis.unwrap_or(0);
            touches[k] = Some(SingleTouch {
                axis,
                center: touch.contact(radius),
                ball: touch.vector[axis] * radius,
            });
        }
        let Some(touches) = touches.into_iter().collect::<Option<Vec<_>>>() else {
            return Ok(path.clone());
        };
        let mut path = self.finish(meets)?;
        path.formula = std::mem::take(&mut path.formula).over_single_touches(&touches);
        if let Some(own) = &mut path.calls {
            own.measured = measured;
        }
        Ok(path)
    }

    /// The path of the cycles on the nominal part.
    fn finish(mut self, meets: ContactQuery<'_>) -> Result<Path, Rejections> {
        // A set-up activates its row once, at the end.
        if self.request.clear.is_none() {
            self.blocks.extend(self.row().map(activates));
        }
        let Plan {
            request,
            blocks,
            stored,
            guards,
            first,
        } = self;
        let reach = ProbeTable {
            set_up: request.set_up,
            overtravel: request.setup.overtravel,
        };
        executed_path::planned(
            request,
            CallDraft {
                blocks,
                stored,
                guards,
                first,
                reach,
            },
            call,
            meets,
        )
        .map_err(|alarm| {
            let message = match alarm {
                Some(alarm) => text!(
                    "On the nominal part the native cycle would stop: {alarm}",
                    what(alarm)
                ),
                None => {
                    text!("The native cycle would touch other surfaces than the documented one")
                }
            };
            native_run::refused("cycle-stops", "cycle", message)
        })
    }
}

/// Message for an alarm in a cycle.
fn what(alarm: Alarm) -> Text {
    match alarm {
        Alarm::NotFound => text!("a touch makes no contact"),
        _ => text!("the probe collides on its path"),
    }
}

/// Reports where these cycles differ from the job.
pub(super) fn check(request: &Request<'_>, checker: &mut Checker) {
    let message = text!(
        "The program calls the control's own cycles: order, feeds and clearances are theirs and the probe table's. Blocks follow posted programs, moves the pages of the control's manual that we have. Nothing of it was run on a control"
    );
    checker.info("not-verified", "control.form", message);
    let farthest = reach(request);
    let message = text!(
        "The probe table's DIST must be at least {dist}, the distance to the farthest contact plus the overtravel: the control searches as far as DIST",
        checker.length(farthest)
    );
    checker.info("dist-needed", "overtravel", message);
    let lacks = |own: &CallSequence| own.measuring.is_empty();
    if request.measures_first() && request.path.calls.as_deref().is_some_and(lacks) {
        let message = text!(
            "In a set-up the cycles of this control cannot all measure before the first of them writes: it cannot ask first"
        );
        checker.error("ask-unsupported", "control.ask", message);
    }
    check_write(request, checker);
    let own = request.path.calls.iter();
    let own = own.flat_map(|own| own.measuring.iter().chain(&own.blocks));
    let unasked = own.filter_map(|(block, _)| match block {
        CallBlock::Cycle(number, _) => row(*number),
        _ => None,
    });
    // A writing cycle checks no limit at all; another finding reports that.
    let mut unasked = unasked.filter(|row| row.writes == Some(false) && !row.stops()[1]);
    if let Some(row) = unasked.next().filter(|_| request.limits.position.is_some()) {
        let message = text!(
            "Cycle {number} has no position tolerance: the position limit is not checked",
            usize::from(row.number)
        );
        checker.warning("limits-not-asked", "limits.position", message);
    }
    if let Some(row) = request.work_offset {
        let limited = request.limits.position.is_some() || request.limits.size.is_some();
        if limited && request.measures_first() {
            let message = text!(
                "The cycles that write a preset have no tolerances: only the first measurement is compared with the limits, not the second one, which is written. Beyond a limit the program stops, and who starts it again lets it write"
            );
            checker.warning("limits-not-asked", "limits", message);
        } else if limited {
            let message = text!(
                "The cycles that write a preset have no tolerances: they write their results without a check of the limits. Measure without a work offset first"
            );
            checker.warning("limits-not-asked", "limits", message);
        }
        let message = text!(
            "Preset row {row} is written and activated: its other axes and its rotation keep the values in the table",
            row
        );
        checker.warning("row-activated", "control.workOffset", message);
        if writes_early(request) {
            let message = text!(
                "Preset row {row} must not be active at the start: the next cycles would measure in the system that the first one moves",
                row
            );
            checker.warning("row-active", "control.workOffset", message);
        }
    }
}

/// Whether a cycle of a set-up measures after one that writes.
fn writes_early(request: &Request<'_>) -> bool {
    let own = request.path.calls.iter().flat_map(|own| &own.blocks);
    let mut measuring = own.filter(|(block, _)| block.measures());
    measuring.any(|(block, _)| block.writes()) && measuring.next().is_some()
}

/// Longest search of the path, mm: from the start of a touch to its end.
fn reach(request: &Request<'_>) -> f64 {
    let ways = request.path.searches().filter_map(|(k, from, step)| {
        Some(from?.distance(step.to) + request.path.touches[k].search)
    });
    ways.fold(0.0, f64::max)
}

pub(super) fn emit(request: &Request<'_>, own: &CallSequence, name: &str) -> Program {
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
    let how = match request.measures_first() {
        true => ": by the cycle, after the results were shown, then activated by cycle 247",
        false => ": by the cycle, then activated by cycle 247",
    };
    w.comment(&write_summary::line(request, how));
    if writes_early(request) {
        w.comment(
            "Another preset row must be active at the start: cycles measure after one that writes",
        );
    }
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
    let names: Vec<String> = stored
        .iter()
        .map(|(code, stored)| format!("{} {code}", (CYCLES.name)(*stored)))
        .collect();
    if !names.is_empty() {
        w.comment(&format!("Results: {}", names.join(", ")));
    }
    w.comment("Cycles 7, 8, 10, 11 and 26 must not be active; the cycle resets a basic rotation. FUNCTION MODE MILL only");
    w.comment("Not verified on a control: run it with a hand on the feed override");
    w.says_job();
    w.shop(&place::HEAD);
    if let Some(tool) = request.tool {
        w.line(&format!("TOOL CALL {tool} Z S50"));
    }
    w.shop(&place::PROBE_ON);
    w.shop(&place::BEFORE_FIRST_MOVE);
    // To the start of the first touch.
    w.names_cycle(0);
    w.leaves_move();
    let mut made = 1;
    let mut functions = Functions::of(request, own);
    if !own.measuring.is_empty() {
        w.comment(
            "First it measures and shows the results. Cycle start then measures again and writes",
        );
    }
    for (block, _) in &own.measuring {
        if let CallBlock::Cycle(number, parameters) = block {
            let none = vec![None; parameters.len()];
            blocks::write(&mut w, request, *number, (parameters, &none));
        }
    }
    for (index, (block, moves)) in own.blocks.iter().enumerate() {
        if *moves > 0 {
            w.names_cycle(made);
            made += moves;
        }
        for _ in 0..*moves {
            w.leaves_move();
        }
        match block {
            CallBlock::Cycle(number, parameters) => {
                let values = parameters.iter().map(|(_, value)| value.value());
                let values: Vec<f64> = values.map(|mm| mm / request.scale).collect();
                let shifted = functions.shift(&mut w, index, &values);
                blocks::write(&mut w, request, *number, (parameters, &shifted))
            }
            CallBlock::SaveResult(variable, output) => {
                w.line(&format!("FN 0: Q{variable} = +Q{output}"))
            }
            CallBlock::Compute(m) => functions.compute(&mut w, *m),
            // The next cycle moves there.
            CallBlock::MoveTo(..) | CallBlock::Call(..) => {}
        }
    }
    if request.report == ResultOutput::Screen && own.computes() {
        w.comment(&format!("Read the results now: {}", names.join(", ")));
        w.line("STOP");
    }
    w.shop(&place::PROBE_OFF);
    w.shop(&place::FOOT);
    functions.end(&mut w);
    w.parts(&["END PGM ", name, " ", unit]);
    w.finish()
}
