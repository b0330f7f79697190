//! Proof that a program of moves makes its path: the program is read back and traced move by move, and its arithmetic is compared with the formula.

use crate::control::iso::machine::{self, ProbeOutcome, ResultCheckpoint, Run};
use crate::control::iso::script::{Script, Slot};
use crate::control::rules::LOW_START;
use crate::control::trace::{Kind, Place, Step, Trace, WrittenValue};
use crate::control::{ProgramForm, Request, prove_calls, prove_corrections};
use crate::formula::{CheckKind, Dual, Formula, Node, ResultCheck, Role, Variable};
use crate::geom::Vec3;
use crate::path::{Arc, Dependency, LINK_STEP, Move, MovePurpose, Path, ShiftTerm, Shifts, Touch};
use crate::text::{Text, text, words};

/// Result of a proof. Only [`prove`] creates one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Proof {
    moves: usize,
    touches: usize,
    arithmetic: bool,
}

impl Proof {
    /// Number of moves of the path that the program makes, each with the right position, kind, feed and line.
    pub fn moves(self) -> usize {
        self.moves
    }

    /// Number of touches among them.
    pub fn touches(self) -> usize {
        self.touches
    }

    /// Whether the program computes the results, and they are right.
    pub fn arithmetic(self) -> bool {
        self.arithmetic
    }
}

/// A difference between program and path.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// 0-based line, if the fault belongs to one.
    pub line: Option<usize>,
    pub message: Text,
    /// Whether its line was understood.
    pub understood: bool,
}

impl Fault {
    fn at(line: usize, message: Text) -> Self {
        Fault {
            line: Some(line),
            message,
            understood: true,
        }
    }

    fn of(message: Text) -> Self {
        Fault {
            line: None,
            message,
            understood: true,
        }
    }
}

/// Assumed start of the stylus above and beside its first position, mm: along abscissa, ordinate and tool axis.
const AWAY: [f64; 3] = [17.0, -23.0, 31.0];

/// A program that was read back and traced.
#[derive(Clone, Debug)]
pub struct Followed<'t> {
    pub script: Script<'t>,
    /// Start of the run.
    pub run_start: Run,
    /// Trace from above the first position to the end.
    pub trace: Trace,
    /// Program state when the results have their values, to run the end again with others.
    pub tail: ResultCheckpoint,
    /// Motions from a start below the first position, or below the start in the job, up to the first position. Empty if nothing moves, or the control cannot
    /// check the start.
    pub from_below: Vec<Step>,
    /// Triggers of the touches, in order.
    triggers: Vec<Vec3>,
    /// Expected trace, from the path.
    expected: Expected,
    /// Triggers and values, if cycles follow results.
    triggered: Option<SimulatedTouches>,
}

impl Followed<'_> {
    /// Shift of a move of the path in this trace, mm.
    pub fn shift(&self, index: usize) -> Vec3 {
        self.expected.shift(index)
    }

    /// Whether the program stops without writing before it moves to a cycle, if a result that the cycle follows deviates by `off`, mm or degrees. Only
    /// deviations that a real part can have are tried.
    pub fn stops_before(
        &self,
        request: &Request<'_>,
        member: usize,
        (result, off, limit): (usize, f64, f64),
    ) -> bool {
        let path = request.path;
        if request.form == ProgramForm::Cycle {
            let traced = (&self.script, self.run_start, &self.trace);
            let near = |at: Place, place: Vec3| self.expected.near(at, self.expected.place(place));
            return prove_calls::stops_before(request, traced, &near, (member, result, off));
        }
        let follow = path.cycles[member]
            .placing
            .follows
            .iter()
            .find(|follow| follow.result == result);
        let Some((follow, own)) = follow.zip(self.triggered.as_ref()) else {
            return false;
        };
        // A value that does not depend on the part never deviates.
        let Some(displaced) = own.displaced(request, follow, off, member) else {
            return true;
        };
        // No part has a direction that is a turn off, or a size many times its nominal one: no touches give that.
        let reached = (off - displaced.off(request, result)).abs() <= 0.01 * off.abs();
        if !reached && off.abs() > 2.0 * limit {
            return true;
        }
        let expected = Expected::of(request, displaced.shifted(path));
        let triggers = &displaced.triggers;
        let made = request.path.cycles[member].moves.start;
        let ways = request.path.moves[..made]
            .iter()
            .rev()
            .take_while(|step| step.step == LINK_STEP)
            .count();
        let mut next = 0;
        let stop = machine::until_alarm(&self.script, self.run_start, &mut |step: &Step| {
            expected.next(step, triggers, &mut next)
        });
        let before = expected
            .touches
            .iter()
            .filter(|(k, _)| request.path.member_of_touch(*k) < Some(member))
            .count();
        let Some(last) = (made - ways).checked_sub(1) else {
            return false;
        };
        let stands = expected.place(request.path.moves[last].to + expected.shift(last));
        // The moves of the previous cycle after its last touch lead nowhere else; the last touch itself may miss. A displacement for one result may also
        // violate the limit of another one that is checked earlier.
        let moves = request.path.moves[..=last].iter().rev();
        let own = moves
            .take_while(|step| !matches!(step.purpose, MovePurpose::Touch(_)))
            .count();
        let in_time = |stop: machine::AlarmState| {
            stop.touches < before
                || stop.touches == before && (stop.since <= own || expected.near(stop.at, stands))
        };
        stop.is_some_and(|stop| !stop.writes && in_time(stop))
    }
}

/// The part on which a program is traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The part of the path: its touches trigger anywhere along their search, and no other move makes contact.
    Path,
    /// An unknown part: a probing move makes contact if the program does not treat that as a fault.
    Unknown,
}

/// Reads a program for the control of a request and traces it.
pub fn read_and_trace<'t>(
    request: &Request<'_>,
    text: &'t str,
    part: Part,
) -> Result<Followed<'t>, Vec<Fault>> {
    let read = request.post.read.ok_or_else(|| {
        vec![Fault::of(text!(
            "programs of this control are not read back"
        ))]
    })?;
    let faults = |troubles: Vec<crate::control::iso::script::ReadError>| -> Vec<Fault> {
        troubles
            .into_iter()
            .map(|t| Fault {
                line: Some(t.line),
                message: t.message,
                understood: t.understood,
            })
            .collect()
    };
    let mut script = read(text).map_err(faults)?;
    // Errors of earlier parts: the next one corrects the tool.
    for correction in request.corrections() {
        let values = [f64::from(correction.parts - 1), 0.0];
        for (name, value) in correction.kept.iter().zip(values) {
            script
                .kept
                .extend(script.find(name.as_bytes()).map(|slot| (slot, value)));
        }
    }
    let mut triggers = vec![Vec3::ZERO; request.path.touches.len()];
    for (k, from, step) in request.path.searches() {
        triggers[k] = trigger(
            request,
            k,
            from.map_or(0.0, |from| from.distance(step.to)),
            1.0,
        );
    }
    script.measured = prove_calls::measured(request, &script);
    // The results of native cycles are nominal, and so are the positions that follow them.
    let follows = request.form == ProgramForm::Moves && !request.path.shifts.is_empty();
    let triggered = if follows {
        Some(SimulatedTouches::of(request, triggers.clone())?)
    } else {
        None
    };
    let shifts = triggered
        .as_ref()
        .map_or_else(ShiftedMoves::default, |triggered| {
            triggered.shifted(request.path)
        });
    if let Some(triggered) = &triggered {
        triggers.clone_from(&triggered.triggers);
    }
    // If nothing is written and no tolerance is checked, the end of the program does not depend on its results.
    let asks = request.writes_tables()
        || request
            .questions()
            .iter()
            .any(|question| question.asked != CheckKind::Plausibility);
    let marks: Vec<Slot> = if asks {
        script.outputs().map(|(_, slot)| slot).collect()
    } else {
        Vec::new()
    };
    let expected = Expected::of(request, shifts);
    let first = request
        .path
        .moves
        .first()
        .map_or(Vec3::ZERO, |step| step.to);
    let [a, o, w] = request.plane.basis();
    let away = |up: f64| expected.place(first + a * AWAY[0] + o * AWAY[1] + w * up);
    // The program of a job with a start begins there.
    let stated = request.path.start.map(|start| expected.written(start));
    let start = stated.unwrap_or_else(|| away(AWAY[2]));
    let highest = expected.place(request.highest())[request.plane.axes()[2]] + 2.0 * expected.digit;
    let run = Run {
        start,
        deflected: false,
        until: None,
        may_stop: false,
        known: stated.is_some(),
        highest,
        strict: true,
    };
    let mut next = 0;
    let (trace, tail) = machine::run_marked(
        &script,
        run,
        &mut |step: &Step| {
            if part == Part::Unknown {
                return expected
                    .meets(step, &triggers, &mut next)
                    .unwrap_or(ProbeOutcome::Unknown);
            }
            expected.next(step, &triggers, &mut next)
        },
        &marks,
    )
    .map_err(|t| faults(vec![t]))?;
    let asks = request.post.why_not(LOW_START).is_none();
    let below = match request.path.moves.first().filter(|_| asks) {
        Some(step) => {
            let start = request.path.start.map_or(away(-AWAY[2]), |start| {
                expected.written(start - w * AWAY[2])
            });
            let until = Some((expected.place(step.to), expected.digit));
            let run = Run {
                start,
                may_stop: true,
                until,
                known: false,
                ..run
            };
            let mut meets = |_: &Step| {
                if part == Part::Path {
                    ProbeOutcome::Nothing
                } else {
                    ProbeOutcome::Unknown
                }
            };
            machine::run(&script, run, &mut meets)
                .map_err(|trouble| faults(vec![trouble]))?
                .steps
        }
        None => Vec::new(),
    };
    Ok(Followed {
        run_start: run,
        script,
        trace,
        tail,
        from_below: below,
        triggers,
        expected,
        triggered,
    })
}

/// Proves that a traced program makes the path of the request. `lines`: line of each move, as reported by the writer.
pub fn prove(
    request: &Request<'_>,
    followed: &Followed<'_>,
    lines: &[Option<usize>],
) -> Result<Proof, Vec<Fault>> {
    debug_assert!(
        request.form == ProgramForm::Moves,
        "a control's own cycle is not proven"
    );
    let mut faults = Vec::new();
    let expected = &followed.expected;
    if let Err(fault) = expected.path(request, &followed.trace, lines) {
        faults.push(fault);
    }
    let arithmetic = request.post.computes;
    if let Err(fault) = results(request, followed) {
        faults.push(fault);
    }
    let traced = (&followed.script, followed.run_start, &followed.tail);
    if let Err((line, message)) = prove_corrections::corrections(request, &followed.trace, traced) {
        let understood = true;
        faults.push(Fault {
            line,
            message,
            understood,
        });
    }
    if !followed.trace.ends {
        faults.push(Fault::of(text!("the program has no end")));
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    Ok(Proof {
        moves: request.path.moves.len(),
        touches: request.path.touches.len(),
        arithmetic,
    })
}

/// Trigger of touch `k` in the proof: somewhere along its search and a little aside, different for each touch, but not before half of its `way` to the nominal
/// contact. `share` reduces the distance from there, for results that must stay within a limit.
fn trigger(request: &Request<'_>, k: usize, way: f64, share: f64) -> Vec3 {
    let touch = &request.path.touches[k];
    let along = (touch.search * (0.55 * spread(k) - 0.05)).max(-way / 2.0) * share;
    touch.contact(request.setup.radius) - touch.vector * along + aside(k) * share
}

/// Simulated touches for set-ups whose cycles follow results: triggers, and the values that the formula gives for them.
#[derive(Clone, Debug)]
struct SimulatedTouches {
    triggers: Vec<Vec3>,
    samples: Vec<Option<Vec3>>,
    directions: Vec<Vec3>,
    values: Vec<Dual>,
}

impl SimulatedTouches {
    /// Moves the triggers with their cycles. Touches of followed cycles stay so close to nominal that their results are within the limits.
    fn of(request: &Request<'_>, triggers: Vec<Vec3>) -> Result<Self, Vec<Fault>> {
        let (samples, directions) = sampled(request, &triggers);
        let path = request.path;
        let mut own = SimulatedTouches {
            triggers,
            samples,
            directions,
            values: Vec::new(),
        };
        let begin = path.computed_by(0).start;
        let mut fault = Vec::new();
        // The deviation of a result shifts the next cycle by as much, or by more through a lever, which may exceed the limits there: then all triggers begin
        // closer to nominal.
        for first in [0, 1, 2, 4, 8, 16] {
            own.values = Vec::with_capacity(path.formula.assignments.len());
            path.formula
                .evaluate_on(&mut own.values, begin, &own.samples, &own.directions);
            match (0..path.cycles.len()).try_for_each(|member| own.touch(request, member, first)) {
                Ok(()) => return Ok(own),
                Err(found) => fault = found,
            }
        }
        Err(fault)
    }

    /// Sets the triggers of a member with known shifts. If a later cycle follows its results, the triggers are moved towards the nominal contacts until those
    /// results are within the limits. `first`: smallest number of halvings.
    fn touch(
        &mut self,
        request: &Request<'_>,
        member: usize,
        first: i32,
    ) -> Result<(), Vec<Fault>> {
        /// After so many halvings a trigger is nominal to the last digit.
        const HALVED: i32 = 24;
        let path = request.path;
        let follows = path.cycles[member + 1..]
            .iter()
            .flat_map(|later| &later.placing.follows);
        let followed = follows
            .filter_map(|follow| Some((follow.result, path.is_known_by(follow.result, member)?)));
        let led: Vec<(usize, bool)> = followed.collect();
        let first = if led.is_empty() { 0 } else { first };
        // Results that depend on a later cycle, too, are known only there.
        let known = led.into_iter().filter(|(_, known)| *known);
        let questions: Vec<ResultCheck> = known
            .filter_map(|(result, _)| path.formula.leads(result, &request.limits))
            .collect();
        for halved in first..HALVED {
            for (k, from, index) in searches_of(path, member) {
                let way = from.map_or(0.0, |from| from.distance(path.moves[index].to));
                let by = self
                    .shift(&path.shifts_at(index, path.touches[k].contact(request.setup.radius)));
                self.triggers[k] = trigger(request, k, way, 0.5f64.powi(halved)) + by;
            }
            self.compute(request, member);
            if questions
                .iter()
                .all(|question| self.off(request, question.result).abs() < 0.9 * question.limit)
            {
                return Ok(());
            }
        }
        Err(vec![Fault::of(text!(
            "the limits of what a cycle follows are too small to be proven: raise them, or let fewer cycles follow each other"
        ))])
    }

    /// Computes the values that depend on the touches of a member.
    fn compute(&mut self, request: &Request<'_>, member: usize) {
        let path = request.path;
        let touches = &path.touches[path.cycles[member].touches.clone()];
        let triggers = &self.triggers[path.cycles[member].touches.clone()];
        for touch in touches {
            let same = touches
                .iter()
                .zip(triggers)
                .filter(|(other, _)| other.sample == touch.sample);
            let (sum, count) = same.fold((Vec3::ZERO, 0.0), |(sum, count), (_, trigger)| {
                (sum + *trigger, count + 1.0)
            });
            self.samples[touch.sample] = Some(sum / count);
        }
        let assignments = path.computed_by(member);
        self.values.truncate(assignments.start);
        path.formula.evaluate_on(
            &mut self.values,
            assignments.end,
            &self.samples,
            &self.directions,
        );
    }

    /// Deviation of a result from nominal.
    fn off(&self, request: &Request<'_>, result: usize) -> f64 {
        let def = &request.path.formula.results[result];
        def.variable.map_or(0.0, |variable| {
            self.values[variable.index()].value - def.nominal
        })
    }

    /// Shift of a position by these values, mm.
    fn shift(&self, shifts: &Shifts) -> Vec3 {
        let value = |term: &ShiftTerm| {
            self.values
                .get(term.by.index())
                .map_or(0.0, |value| term.factor * value.value)
        };
        Vec3::from_array(shifts.each_ref().map(|terms| terms.iter().map(value).sum()))
    }

    /// Simulated touches with the touches of one cycle displaced, so that a result deviates by a given amount: for a position all touches along its axis, for a
    /// size or direction each touch by its influence. The cycles up to a member follow. `None` if the displacement does not change the result.
    fn displaced(
        &self,
        request: &Request<'_>,
        Dependency { result, axis, .. }: &Dependency,
        off: f64,
        until: usize,
    ) -> Option<Self> {
        /// Smaller derivatives, in mm per mm, belong to walls across another axis.
        const STILL: f64 = 1e-6;
        /// A direction is not linear in the positions of its touches.
        const ROUNDS: usize = 8;
        let (path, result) = (request.path, *result);
        let sources = path.sources(result);
        let (begin, end) = (*sources.first()?, *sources.last()?);
        let mut own = self.clone();
        let touches: Vec<usize> = sources
            .iter()
            .flat_map(|source| path.cycles[*source].touches.clone())
            .collect();
        let ways: Vec<Vec3> = match axis {
            Some(axis) => vec![Vec3::AXES[*axis]; touches.len()],
            None => own.slopes(request, result, &touches),
        };
        let move_by = |own: &mut Self, far: f64| {
            touches
                .iter()
                .zip(&ways)
                .for_each(|(k, way)| own.triggers[*k] += *way * far);
            (begin..=end).for_each(|member| own.compute(request, member));
        };
        // A trial displacement gives the slope.
        let before = own.off(request, result);
        move_by(&mut own, 1.0);
        let each = own.off(request, result) - before;
        if each.abs() < STILL {
            return None;
        }
        // Secant method: the corner of two walls at an acute angle is far from linear in the positions of its touches.
        let mut left = off - before - each;
        let mut far = left / each;
        for _ in 0..ROUNDS {
            move_by(&mut own, far);
            let after = off - own.off(request, result);
            if after.abs() < 1e-9 || after == left {
                break;
            }
            far *= after / (left - after);
            left = after;
        }
        for member in begin..until {
            if sources.contains(&member) {
                own.compute(request, member);
            } else {
                // If another result then exceeds its limit whatever these touches are, the program may stop for that one.
                let _ = own.touch(request, member, 0);
            }
        }
        Some(own)
    }

    /// Displacements of these touches that change a result by one unit if all are scaled to 1 mm: along the probing direction of each touch, by its influence
    /// on the result.
    fn slopes(&self, request: &Request<'_>, result: usize, touches: &[usize]) -> Vec<Vec3> {
        let Some(variable) = request.path.formula.results[result].variable else {
            return vec![Vec3::ZERO; touches.len()];
        };
        let slope = |sample: usize| {
            let by = self.values[variable.index()].by_samples();
            by.filter_map(|(first, slopes)| slopes.get(sample.checked_sub(first)?))
                .sum::<f64>()
        };
        let touches = touches.iter().map(|k| &request.path.touches[*k]);
        let own: Vec<(Vec3, f64)> = touches
            .map(|touch| (touch.vector, slope(touch.sample)))
            .collect();
        let square: f64 = own.iter().map(|(_, slope)| slope * slope).sum();
        own.iter()
            .map(|(vector, slope)| {
                if square > 0.0 {
                    *vector * (slope / square)
                } else {
                    Vec3::ZERO
                }
            })
            .collect()
    }

    /// Shift of each move.
    fn shifted(&self, path: &Path) -> ShiftedMoves {
        let reach = |term: &ShiftTerm| {
            self.values
                .get(term.by.index())
                .map_or(0.0, |value| term.factor.abs() * value.reach())
        };
        let of = |i: usize| {
            path.shifts(i)
                .iter()
                .map(move |terms| terms.iter().map(reach).sum::<f64>())
        };
        let reach = (0..path.moves.len()).flat_map(of).fold(0.0, f64::max);
        ShiftedMoves {
            by: (0..path.moves.len())
                .map(|i| self.shift(path.shifts(i)))
                .collect(),
            reach,
        }
    }
}

/// Touches of a member: index of the touch, start, and index of the move.
fn searches_of(path: &Path, member: usize) -> impl Iterator<Item = (usize, Option<Vec3>, usize)> {
    let moves = path.cycles[member].moves.clone();
    moves.filter_map(|i| match path.moves[i].purpose {
        MovePurpose::Touch(k) => Some((
            k,
            i.checked_sub(1)
                .map_or(path.start, |i| Some(path.moves[i].to)),
            i,
        )),
        MovePurpose::Position | MovePurpose::Search(_) | MovePurpose::Retract(_) => None,
    })
}

/// Sideways offset of the trigger of touch `k` from the stop position: no coordinate is a round number, so that no term of a formula vanishes by chance.
fn aside(k: usize) -> Vec3 {
    Vec3::new(spread(3 * k + 7), spread(3 * k + 8), spread(3 * k + 9)) * 1e-3
}

/// The golden ratio spreads evenly over 0 to 1: the fractional parts of its multiples never repeat.
fn spread(n: usize) -> f64 {
    ((n as f64 + 1.0) * 0.618_033_988_749_895).fract()
}

/// Expected trace of a program, in its units.
#[derive(Clone, Debug)]
struct Expected {
    scale: f64,
    /// Half of the last digit of a position and of a feed.
    digit: f64,
    /// Number of last digits in a unit.
    steps: f64,
    /// Largest distance of a touch from the origin, mm.
    far: f64,
    /// Largest effect of rounded constants on a position as far from the origin as the touches, mm.
    size: f64,
    /// Touches in the order of the path: index, and start and end of the probing move.
    touches: Vec<(usize, (Place, Place))>,
    /// Shift of each move, mm; empty without shifts.
    shifts: Vec<Vec3>,
    /// Largest effect of rounded constants on a shifted position, in units of the program.
    slack: f64,
}

/// Shifts of a program's moves, with their accuracy.
#[derive(Debug, Default)]
struct ShiftedMoves {
    /// Shift of each move, mm.
    by: Vec<Vec3>,
    /// Factor by which errors of the triggers are multiplied.
    reach: f64,
}

impl Expected {
    fn of(request: &Request<'_>, ShiftedMoves { by: shifts, reach }: ShiftedMoves) -> Self {
        let path = request.path;
        let far = path
            .touches
            .iter()
            .map(|touch| touch.point.length())
            .fold(100.0, f64::max);
        let size = 1e-9 + 10.0 * request.post.constant_error * far;
        let digit = request.post.half_digit(request.scale);
        let steps = 10f64.powi(request.post.decimals(request.scale) as i32);
        let slack = if shifts.is_empty() {
            0.0
        } else {
            size * (1.0 + reach) / request.scale
        };
        let mut expected = Expected {
            scale: request.scale,
            digit,
            steps,
            far,
            size,
            touches: Vec::new(),
            shifts,
            slack,
        };
        let mut from = path.start;
        for (i, step) in path.moves.iter().enumerate() {
            let shift = expected.shift(i);
            if let MovePurpose::Touch(k) = step.purpose {
                let end = expected.place(search_end(step, &path.touches[k]) + shift);
                let begin = i
                    .checked_sub(1)
                    .map_or(shift, |before| expected.shift(before));
                expected.touches.push((
                    k,
                    (
                        expected.place(from.map_or(Vec3::NAN, |from| from + begin)),
                        end,
                    ),
                ));
            }
            from = Some(step.to);
        }
        expected
    }

    fn shift(&self, index: usize) -> Vec3 {
        self.shifts.get(index).copied().unwrap_or(Vec3::ZERO)
    }

    /// Contact of a motion if it is the next touch. `next` counts the touches.
    fn next(&self, step: &Step, triggers: &[Vec3], next: &mut usize) -> ProbeOutcome {
        let Some((k, (begin, end))) = self.touches.get(*next) else {
            return ProbeOutcome::Nothing;
        };
        if !(self.near(step.to, *end) && self.near(step.from, *begin)) {
            return ProbeOutcome::Nothing;
        }
        *next += 1;
        self.contact(step, triggers[*k])
    }

    fn place(&self, place: Vec3) -> Place {
        (place / self.scale).to_array()
    }

    /// Contact of a motion in a program that may not match the path, if it is one of the touches. Of several touches at the same position, to the last digit,
    /// the next one counts.
    fn meets(&self, step: &Step, triggers: &[Vec3], next: &mut usize) -> Option<ProbeOutcome> {
        let own = |touch: &(usize, (Place, Place))| {
            self.near(step.to, touch.1.1) && self.near(step.from, touch.1.0)
        };
        let later = self
            .touches
            .iter()
            .skip(*next)
            .position(own)
            .map(|i| *next + i);
        let found = later.or_else(|| self.touches.iter().position(own))?;
        *next = found + 1;
        Some(self.contact(step, triggers[self.touches[found].0]))
    }

    /// A contact: the axes stop on the commanded line, rounded like it.
    fn contact(&self, step: &Step, trigger: Vec3) -> ProbeOutcome {
        let (from, to) = (Vec3::from_array(step.from), Vec3::from_array(step.to));
        let (trigger, way) = (trigger / self.scale, (to - from).normalize_or_zero());
        ProbeOutcome::Contact(
            (from + way * (trigger - from).dot(way)).to_array(),
            trigger.to_array(),
        )
    }

    /// The position as the program prints it, to the last digit.
    fn written(&self, place: Vec3) -> Place {
        let steps = self.steps;
        self.place(place).map(|x| (x * steps).round() / steps)
    }

    /// Whether two positions are equal but for the last digit.
    fn near(&self, a: Place, b: Place) -> bool {
        // A number of a million has no more digits after the decimal point.
        (0..3).all(|axis| {
            (a[axis] - b[axis]).abs() <= self.digit + self.slack + 1e-12 * b[axis].abs()
        })
    }

    /// Checks that every move of the path is in the program, in order, and that there is no other.
    fn path(
        &self,
        request: &Request<'_>,
        trace: &Trace,
        lines: &[Option<usize>],
    ) -> Result<(), Fault> {
        let mut steps = trace.steps.iter();
        let mut from = request.path.start;
        for (i, step) in request.path.moves.iter().enumerate() {
            let nominal = match step.purpose {
                MovePurpose::Touch(k) | MovePurpose::Search(k) => {
                    search_end(step, &request.path.touches[k])
                }
                MovePurpose::Position | MovePurpose::Retract(_) => step.to,
            };
            let arc = step.arc.map(|arc| Arc {
                center: arc.center + self.shift(i),
                ..arc
            });
            let wanted = self.place(nominal + self.shift(i));
            let mut first = None;
            // The first position is reached in steps, and an arc may consist of straight pieces; any other move is one motion.
            let last = loop {
                let made = steps
                    .next()
                    .ok_or_else(|| Fault::of(text!("move {number} is missing", i + 1)))?;
                first = first.or(Some(made.line));
                let there = self.near(made.to, wanted);
                match (arc, from) {
                    _ if there => {}
                    (_, None) => {}
                    (Some(arc), Some(_)) => self.on_arc(i, &arc, made)?,
                    (None, Some(_)) => {
                        return Err(Fault::at(
                            made.line,
                            text!("move {number} ends elsewhere than in the path", i + 1),
                        ));
                    }
                }
                self.step(request, (i, step), from, made)?;
                if there {
                    break made.line;
                }
            };
            let line = if from.is_none() { Some(last) } else { first };
            if lines.get(i).copied().flatten() != line {
                return Err(Fault::at(
                    last,
                    text!("the header places move {number} on another line", i + 1),
                ));
            }
            from = Some(step.to);
        }
        match steps.next() {
            Some(more) => Err(Fault::at(more.line, text!("this move is not in the path"))),
            None => Ok(()),
        }
    }

    /// Checks kind and feed of a motion that makes a move or a piece of it.
    fn step(
        &self,
        request: &Request<'_>,
        (i, step): (usize, &Move),
        from: Option<Vec3>,
        made: &Step,
    ) -> Result<(), Fault> {
        let number = i + 1;
        let rate = match step.purpose {
            MovePurpose::Touch(_) | MovePurpose::Search(_) => Some(request.feeds.work),
            MovePurpose::Position | MovePurpose::Retract(_) => {
                (request.post.rate)(request, from, step)
            }
        };
        let way = (0..3)
            .map(|axis| (made.to[axis] - made.from[axis]).powi(2))
            .sum::<f64>()
            .sqrt()
            * self.scale;
        // A result shifts the length of the link moves to a cycle that is placed above the previous one.
        let nominal = from.map_or(f64::INFINITY, |from| from.distance(step.to));
        let plain = if made.feed.is_some() {
            Kind::Feed
        } else {
            Kind::Rapid
        };
        let wanted = match step.purpose {
            MovePurpose::Touch(_) | MovePurpose::Search(_) => Kind::Touch,
            MovePurpose::Retract(_) => plain,
            MovePurpose::Position if !(request.protected && request.post.watches_positioning) => {
                plain
            }
            MovePurpose::Position if from.is_none() && !request.post.watches_first => plain,
            // Too short for a probe move.
            MovePurpose::Position
                if made.kind == plain && way.min(nominal) < request.shortest_watched() =>
            {
                plain
            }
            MovePurpose::Position => Kind::Watched,
        };
        if made.kind != wanted {
            return Err(Fault::at(
                made.line,
                text!(
                    "move {number} is {kind}, not {wanted}",
                    number,
                    words(made.kind),
                    words(wanted)
                ),
            ));
        }
        // The approach to the first position goes down at a feed if a rapid would not be watched there.
        let careful =
            from.is_none() && wanted != Kind::Watched && rate.is_none() && made.feed.is_some();
        let rate = if careful {
            Some(request.feeds.work)
        } else {
            rate
        };
        if !self.same_feed(made.feed, rate) {
            return Err(Fault::at(
                made.line,
                text!("move {number} has another feed than in the path", number),
            ));
        }
        match (step.arc, made.arc) {
            (Some(arc), Some((center, clockwise))) => {
                if clockwise != (arc.sweep < 0.0)
                    || !self.near_arc(center, self.place(arc.center + self.shift(i)))
                {
                    return Err(Fault::at(
                        made.line,
                        text!("move {number} is another arc than in the path", number),
                    ));
                }
            }
            (None, Some(_)) => {
                return Err(Fault::at(
                    made.line,
                    text!("move {number} is an arc, and straight in the path", number),
                ));
            }
            (_, None) => {}
        }
        Ok(())
    }

    fn same_feed(&self, made: Option<f64>, wanted: Option<f64>) -> bool {
        match (made, wanted) {
            (Some(made), Some(wanted)) => {
                (made - wanted / self.scale).abs() <= self.digit + 1e-12 * made
            }
            (None, None) => true,
            (Some(_), None) | (None, Some(_)) => false,
        }
    }

    /// A centre is counted from the start of the arc, which is rounded itself.
    fn near_arc(&self, a: Place, b: Place) -> bool {
        (0..3).all(|axis| {
            (a[axis] - b[axis]).abs() <= 2.0 * self.digit + self.slack + 1e-12 * b[axis].abs()
        })
    }

    /// A straight piece of an arc ends on the arc, and deviates from it by no more than chords may.
    fn on_arc(&self, i: usize, arc: &Arc, made: &Step) -> Result<(), Fault> {
        let center = self.place(arc.center);
        let out = |place: Place| {
            (0..3)
                .map(|axis| (place[axis] - center[axis]).powi(2))
                .sum::<f64>()
                .sqrt()
        };
        let middle = [0, 1, 2].map(|axis| (made.from[axis] + made.to[axis]) / 2.0);
        let radius = out(made.to);
        let begin = out(made.from);
        let sag = crate::control::CHORD_SAG / self.scale;
        let rounded = 4.0 * (self.digit + self.slack);
        if (radius - begin).abs() > rounded || radius - out(middle) > sag + rounded {
            return Err(Fault::at(
                made.line,
                text!("move {number} leaves its arc", i + 1),
            ));
        }
        Ok(())
    }
}

fn search_end(step: &Move, touch: &Touch) -> Vec3 {
    step.to - touch.vector * touch.search
}

fn words(kind: Kind) -> &'static str {
    match kind {
        Kind::Rapid => words!("a rapid that is not watched"),
        Kind::Feed => words!("a move that is not watched"),
        Kind::Watched => words!("watched"),
        Kind::Touch => words!("a touch"),
        Kind::Unchecked => words!("a probing move without a check"),
    }
}

/// Relative error left where sums of squares cancel, as a root: some digits of a double, for the largest position.
const CANCELLED: f64 = 1e-7;

/// Checks the program's own arithmetic and its write on the triggers of the proof.
fn results(request: &Request<'_>, followed: &Followed<'_>) -> Result<(), Fault> {
    let (path, trace, expected) = (request.path, &followed.trace, &followed.expected);
    if !request.post.computes {
        let silent = trace.outputs.is_empty() && trace.writes.is_empty();
        return if silent {
            Ok(())
        } else {
            Err(Fault::of(text!(
                "this control computes nothing, and the program does"
            )))
        };
    }
    let (samples, directions) = sampled(request, &followed.triggers);
    let values = path.formula.evaluate(&samples, &directions);
    let wanted = path
        .formula
        .results
        .iter()
        .filter_map(|result| Some((result, &values[result.variable?.index()])));
    let mut given = trace.outputs.iter();
    let residuals = of_residuals(&path.formula);
    for (result, value) in wanted {
        let unit = request.unit_of(result);
        // A root mean square changes no more than its positions; at 0 its derivative would not show that.
        let off_by_roots = expected.size + CANCELLED * expected.far;
        let is_of_residuals = result.variable.is_some_and(|own| residuals[own.index()]);
        let same = |x: f64| {
            let off = (x - value.value / unit).abs();
            match result.role {
                Role::Residual if value.value.is_finite() => off <= off_by_roots,
                // A relation of two residuals.
                _ if is_of_residuals && off <= 2.0 * off_by_roots => true,
                _ => equal(x, value, unit, expected.size),
            }
        };
        match given.next() {
            Some((code, x))
                if code.eq_ignore_ascii_case(&path.formula.code(result)) && same(*x) => {}
            Some((code, _)) if code.eq_ignore_ascii_case(&path.formula.code(result)) => {
                return Err(Fault::of(text!(
                    "the program's {code} differs from the formula's",
                    code.clone()
                )));
            }
            _ => {
                return Err(Fault::of(text!(
                    "the program does not give {code}",
                    path.formula.code(result).into_owned()
                )));
            }
        }
    }
    if let Some((code, _)) = given.next() {
        return Err(Fault::of(text!(
            "the program gives {code}, which is not a result",
            code.clone()
        )));
    }
    write(request, trace, &values, expected)
}

/// Samples of the formula: means of the touches of each, and their probing directions.
fn sampled(request: &Request<'_>, triggers: &[Vec3]) -> (Vec<Option<Vec3>>, Vec<Vec3>) {
    let mut points: Vec<(Vec3, f64, Vec3)> = Vec::new();
    for (touch, trigger) in request.path.touches.iter().zip(triggers) {
        if touch.sample >= points.len() {
            points.resize(touch.sample + 1, (Vec3::ZERO, 0.0, touch.vector));
        }
        let point = &mut points[touch.sample];
        (point.0, point.1, point.2) = (point.0 + *trigger, point.1 + 1.0, touch.vector);
    }
    points
        .into_iter()
        .map(|(sum, count, vector)| (Some(sum / count), vector))
        .unzip()
}

/// Whether each assignment is a residual or is computed from one.
fn of_residuals(formula: &Formula) -> Vec<bool> {
    let mut all = vec![false; formula.assignments.len()];
    let residuals = formula
        .results
        .iter()
        .filter(|result| result.role == Role::Residual);
    for own in residuals.filter_map(|result| result.variable) {
        all[own.index()] = true;
    }
    for (i, assignment) in formula.assignments.iter().enumerate() {
        let mut reads = all[i];
        formula.each(assignment.node, &mut |node| {
            reads |= matches!(node, Node::Variable(own) if all[own.index()]);
        });
        all[i] = reads;
    }
    all
}

/// Equal within the rounding of constants. The factor for errors of the triggers also applies to rounding.
fn equal(given: f64, value: &Dual, unit: f64, size: f64) -> bool {
    let reach = 1.0 + value.reach();
    let off = (given - value.value / unit).abs();
    off <= size * reach || (given.is_nan() && value.value.is_nan())
}

/// Line and number of each work offset that is written.
fn offsets(trace: &Trace) -> impl Iterator<Item = (usize, i32)> {
    trace.writes.iter().filter_map(|write| match write.what {
        WrittenValue::Offset(number, _) => Some((write.line, number)),
        WrittenValue::Tool(_) => None,
    })
}

/// Checks the write: afterwards the measured point must read its nominal position, and the system must be rotated as measured.
fn write(
    request: &Request<'_>,
    trace: &Trace,
    values: &[Dual],
    expected: &Expected,
) -> Result<(), Fault> {
    let datum = request
        .path
        .formula
        .datum
        .as_ref()
        .filter(|_| request.work_offset.is_some());
    let Some(datum) = datum.filter(|datum| datum.writes()) else {
        return match offsets(trace).next() {
            None => Ok(()),
            Some((line, _)) => Err(Fault::at(
                line,
                text!("this writes a work offset, and nothing is to be written"),
            )),
        };
    };
    let Some(written) = trace.written else {
        return Err(Fault::of(text!("the work offset is not written")));
    };
    let other = offsets(trace).find(|(_, number)| Some(*number) != request.work_offset);
    if let Some((line, _)) = other {
        return Err(Fault::at(line, text!("this writes another work offset")));
    }
    let value = |variable: Variable| values[variable.index()].clone();
    let turn = datum.rotation.map_or(Dual::constant(0.0), value);
    if !equal(written.turn, &turn, 1.0, expected.size) {
        return Err(Fault::of(text!(
            "the work offset is turned by another angle than was measured"
        )));
    }
    // A position p reads n + R(−turn)(p − m) afterwards: m is measured, n nominal.
    let axes = request.plane.axes();
    let (sin, cos) = (-turn.value).to_radians().sin_cos();
    let part = |i: usize| {
        let place = datum.place[i]?;
        Some((
            place.measured.map_or(Dual::constant(place.nominal), value),
            place.nominal,
        ))
    };
    let away = |i: usize| {
        part(i).map_or(0.0, |(m, _)| {
            written.place[axes[i]] * expected.scale - m.value
        })
    };
    for (i, axis) in axes.into_iter().enumerate() {
        let Some((measured, nominal)) = part(i) else {
            continue;
        };
        let way = match i {
            0 => away(0) * cos - away(1) * sin,
            1 => away(0) * sin + away(1) * cos,
            _ => away(2),
        };
        let mut wanted = measured;
        wanted.value = nominal + way;
        if !equal(
            written.reading[axis],
            &wanted,
            expected.scale,
            expected.size,
        ) {
            let axis = crate::geom::AXIS_NAMES[axis];
            return Err(Fault::of(text!(
                "the written work offset does not bring {axis} to its nominal position",
                axis
            )));
        }
    }
    Ok(())
}
