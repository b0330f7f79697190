//! Runs a program as a control would: motions, jumps, arithmetic, and both outcomes of every probing move.

mod exits;
mod slots;
mod tail;
mod values;

pub use exits::deflected;
use slots::{VariableStore, WriteMark};
pub use tail::{ResultCheckpoint, TailOutcome, TailRunner, restarted};

use std::cell::{Cell, OnceCell};

use crate::control::iso::script::{
    Block, BlockKind, LookAhead, Modes, Motion, NodeId, Part, ReadError, Script, Slot, Words,
};
use crate::control::trace::{Kind, Place, ProbeConsequence, Step, Trace, Written};
use crate::geom::Plane;
use crate::text::{Text, text};

/// Step budget of one program: blocks, the numbers and operators of their formulas, and copies of its variables at its motions. About a second.
pub const BUDGET: usize = 20_000_000;

/// Steps for one stored motion.
const MOTION: usize = 20;

/// Steps for a write to a variable: at most 40 MB of them are stored.
const WRITE: usize = 8;

/// Largest number of stored motions in other modes than the first one.
const MOST_CHANGES: usize = 20;

/// Outcome of a probing move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProbeOutcome {
    /// A contact: the stop position of the axes, and the trigger that the control reads.
    Contact(Place, Place),
    /// No contact.
    Nothing,
    /// Unknown: the outcome that the program does not treat as a fault.
    Unknown,
}

/// Answers the probing moves of a run.
pub type ContactModel<'w> = dyn FnMut(&Step) -> ProbeOutcome + 'w;

/// Start and end conditions of a run.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    pub start: Place,
    /// Whether the probe is deflected from the start.
    pub deflected: bool,
    /// Ends the run when the ball is this close to a position.
    pub until: Option<(Place, f64)>,
    /// Whether the program may stop with an alarm before anything moves, which ends the run.
    pub may_stop: bool,
    /// Whether the program knows the position of the ball, as if its blocks had named it.
    pub known: bool,
    /// Highest lift of an exit along the tool axis, in units of the program.
    pub highest: f64,
    /// Whether the run is refused where the program depends on chance: variables without a value in a condition, values that are read before the ball has
    /// arrived.
    pub strict: bool,
}

#[derive(Clone, Debug, Default)]
struct State {
    pc: usize,
    /// Position in the log of variable writes.
    written: WriteMark,
    stack: Vec<CallFrame>,
    at: Place,
    /// Axes that a block has named.
    stated: [bool; 3],
    trigger: Place,
    contact: bool,
    deflected: bool,
    feed: Option<f64>,
    modes: Modes,
    origins: Vec<(Part, f64)>,
    reading: Option<[Option<f64>; 3]>,
    warned: bool,
    /// Whether the program waits for the operator, and its control may read on.
    waits: bool,
    /// Whether a motion may still be running when the next block is evaluated.
    ahead: bool,
    /// Number of native cycles made.
    natives: usize,
}

impl State {
    /// Copies another state. Allocated memory is reused: this runs at every probing move.
    fn copy_from(&mut self, other: &State) {
        let Self {
            pc,
            written,
            stack,
            at,
            stated,
            trigger,
            contact,
            deflected,
            feed,
            modes,
            origins,
            reading,
            warned,
            ahead,
            waits,
            natives,
        } = self;
        stack.clone_from(&other.stack);
        origins.clone_from(&other.origins);
        (*pc, *written, *at, *stated, *trigger) = (
            other.pc,
            other.written,
            other.at,
            other.stated,
            other.trigger,
        );
        (*contact, *deflected, *feed, *modes) =
            (other.contact, other.deflected, other.feed, other.modes);
        (*reading, *warned, *ahead) = (other.reading, other.warned, other.ahead);
        (*waits, *natives) = (other.waits, other.natives);
    }
}

/// An active subroutine.
#[derive(Clone, Debug)]
struct CallFrame {
    /// Block at which the run continues afterwards.
    back: usize,
    /// Line of the outermost call.
    line: usize,
    /// Arguments of the caller.
    arguments: Vec<(usize, f64)>,
}

struct Machine<'s, 't> {
    script: &'s Script<'t>,
    /// Variables that hold the arguments of a subroutine, if the program names them. Found at the first call: there may be none.
    arguments: OnceCell<[Option<Slot>; ARGUMENTS.len()]>,
    state: State,
    /// Values of its variables.
    slots: VariableStore,
    /// Whether the program is in millimetres, like the assumed basic system of the control: 1 or 0.
    metric: f64,
    /// Whether the last motion was unwatched, and the state after it.
    unwatched: (bool, State),
    /// Modes at the first motion.
    first: Option<Modes>,
    /// First block that switches the spindle on.
    spun: Option<usize>,
    run: Run,
    /// Whether the current block is refused because the run is strict: the program cannot rely on its outcome.
    refused: Cell<bool>,
    /// Remaining step budget: it ends a program that would run forever.
    budget_left: Cell<usize>,
}

/// Effect of a block.
enum BlockEffect<'s> {
    Next,
    Moved(&'s Words, Motion),
    Output(&'s str, f64),
    Pause,
    Wrote(Written),
    Native,
    Alarm,
    End,
}

/// The branch not taken at the last condition since the last motion.
#[derive(Default)]
struct UntakenBranch {
    open: bool,
    state: State,
}

impl UntakenBranch {
    fn opens(&mut self, state: &State, written: WriteMark, pc: usize) {
        self.open = true;
        self.state.copy_from(state);
        (self.state.pc, self.state.written) = (pc, written);
    }

    fn take(&mut self) -> &State {
        self.open = false;
        &self.state
    }
}

/// Runs a program to its end.
pub fn run(
    script: &Script<'_>,
    run: Run,
    world: &mut ContactModel<'_>,
) -> Result<Trace, ReadError> {
    run_marked(script, run, world, &[]).map(|(trace, _)| trace)
}

/// Runs a program to its end. Also returns the state at which the last marked variable has its value and the last motion is made.
pub fn run_marked(
    script: &Script<'_>,
    run: Run,
    world: &mut ContactModel<'_>,
    marks: &[Slot],
) -> Result<(Trace, ResultCheckpoint), ReadError> {
    let mut machine = Machine::new(script, run);
    let mut trace = Trace::default();
    let mut scratch = State::default();
    let mut tail = ResultCheckpoint::default();
    let mut fork = UntakenBranch::default();
    // The alarm after which the other branch was taken.
    let mut implausible: Option<usize> = None;
    while let Some(block) = script.blocks.get(machine.state.pc) {
        if matches!(block.kind, BlockKind::Words(_)) {
            machine.spend(MOTION + script.slots / 8);
        }
        let (line, at) = (machine.line(block.line), machine.state.pc);
        let flow = machine.step()?;
        match &block.kind {
            BlockKind::Set(slot, _) if marks.contains(slot) => {
                machine.spend(1 + script.slots / 8);
                tail.keep(&machine.state, machine.slots.mark());
            }
            BlockKind::JumpIf(_, target) | BlockKind::JumpUnless(_, target) => {
                machine.spend(1 + script.slots / 8);
                let other = if machine.state.pc == at + 1 {
                    *target
                } else {
                    at + 1
                };
                fork.opens(&machine.state, machine.slots.mark(), other);
            }
            _ => {}
        }
        match flow {
            BlockEffect::Next => {}
            BlockEffect::Pause => tail.paused(&mut machine.slots),
            BlockEffect::Output(code, value) => trace.outputs.push((code.to_owned(), value)),
            BlockEffect::Native => trace.natives.push(line),
            BlockEffect::Wrote(written) => trace.wrote(line, written),
            BlockEffect::Alarm if run.may_stop && trace.steps.is_empty() => {
                return Ok((trace, tail));
            }
            // The touches of this run belong to no good part: an alarm for an implausible result means nothing.
            BlockEffect::Alarm if fork.open && (!marks.is_empty() || !run.strict) => {
                machine.spend(MOTION + script.slots / 8);
                implausible.get_or_insert(line);
                machine.state.copy_from(fork.take());
                tail.before(machine.state.written, &mut machine.slots);
                machine.slots.back(machine.state.written);
            }
            BlockEffect::Alarm => return Err(trouble(line, stops())),
            BlockEffect::End => {
                trace.ends = true;
                break;
            }
            BlockEffect::Moved(words, motion) => {
                if let Some(line) = implausible.filter(|_| run.strict) {
                    return Err(trouble(line, stops()));
                }
                fork.open = false;
                let step = machine.moved(line, words, motion, &mut trace, world, &mut scratch)?;
                trace.steps.push(step);
                tail.moved(&machine.state, machine.slots.mark());
                if machine.is_there() {
                    return Ok((trace, tail));
                }
            }
        }
    }
    machine.finish(&mut trace);
    tail.end(&mut machine.slots);
    Ok((trace, tail))
}

/// State of a program that stops with an alarm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AlarmState {
    /// Ball centre.
    pub at: Place,
    pub touches: usize,
    /// Number of motions after the last of these lines.
    pub since: usize,
    /// Whether it has written a work offset or a tool.
    pub writes: bool,
}

/// Runs a program to its alarm. `None` if it ends without one, or a block cannot be carried out.
pub fn until_alarm(
    script: &Script<'_>,
    run: Run,
    world: &mut ContactModel<'_>,
) -> Option<AlarmState> {
    let mut machine = Machine::new(script, run);
    let (mut trace, mut scratch) = (Trace::default(), State::default());
    let mut stopped = AlarmState::default();
    while let Some(block) = script.blocks.get(machine.state.pc) {
        let line = machine.line(block.line);
        if matches!(block.kind, BlockKind::Words(_)) {
            machine.spend(MOTION + script.slots / 8);
        }
        match machine.step().ok()? {
            BlockEffect::Next | BlockEffect::Pause | BlockEffect::Output(..) => {}
            BlockEffect::Wrote(..) => stopped.writes = true,
            BlockEffect::Alarm => {
                return Some(AlarmState {
                    at: machine.state.at,
                    ..stopped
                });
            }
            BlockEffect::Moved(words, motion) => {
                let step = machine
                    .moved(line, words, motion, &mut trace, world, &mut scratch)
                    .ok()?;
                let touch = step.kind == Kind::Touch;
                stopped.touches += usize::from(touch);
                stopped.since = if touch { 0 } else { stopped.since + 1 };
            }
            BlockEffect::End | BlockEffect::Native => return None,
        }
    }
    None
}

/// State of a program of native cycles that stops.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CallsState {
    /// Whether an alarm stopped it.
    pub alarm: bool,
    /// Whether it has written a work offset or a tool.
    pub writes: bool,
    /// Number of calls and of motions after the last one.
    pub calls: usize,
    pub motions: usize,
    /// Value of a variable.
    pub value: f64,
}

/// Runs a program of native cycles to its alarm or its end. Nothing is in the way.
pub fn after_calls(script: &Script<'_>, run: Run, slot: Slot) -> CallsState {
    let mut machine = Machine::new(script, run);
    let (mut trace, mut scratch) = (Trace::default(), State::default());
    let mut stopped = CallsState::default();
    while let Some(block) = script.blocks.get(machine.state.pc) {
        let line = machine.line(block.line);
        if matches!(block.kind, BlockKind::Words(_)) {
            machine.spend(MOTION + script.slots / 8);
        }
        match machine.step() {
            Ok(BlockEffect::Next | BlockEffect::Pause | BlockEffect::Output(..)) => {}
            Ok(BlockEffect::Wrote(..)) => stopped.writes = true,
            Ok(BlockEffect::Native) => (stopped.calls, stopped.motions) = (stopped.calls + 1, 0),
            Ok(BlockEffect::Moved(words, motion)) => {
                let free = &mut |_: &Step| ProbeOutcome::Nothing;
                let moved = machine.moved(line, words, motion, &mut trace, free, &mut scratch);
                if moved.is_err() {
                    break;
                }
                stopped.motions += 1;
            }
            Ok(BlockEffect::Alarm) => {
                stopped.alarm = true;
                break;
            }
            Ok(BlockEffect::End) | Err(_) => break,
        }
    }
    stopped.value = machine.slots.get(slot as usize);
    stopped
}

fn stops() -> Text {
    text!("the program stops here with an alarm though nothing is wrong")
}

fn not_in_a_proof(kind: &BlockKind) -> Text {
    match kind {
        BlockKind::SetOther(..) => text!("the control's own values must not be written"),
        _ => text!("this moves to a position in machine coordinates"),
    }
}

fn reads_ahead() -> Text {
    text!("the control reads ahead: it evaluates this before the ball has arrived")
}

fn trouble(line: usize, message: Text) -> ReadError {
    ReadError {
        line,
        message,
        understood: true,
    }
}

/// Whether two positions differ by no more than this along every axis.
pub fn near(a: Place, b: Place, off: f64) -> bool {
    (0..3).all(|axis| (a[axis] - b[axis]).abs() <= off)
}

impl<'s, 't> Machine<'s, 't> {
    fn new(script: &'s Script<'t>, run: Run) -> Self {
        let state = State {
            at: run.start,
            stated: [run.known; 3],
            trigger: [f64::NAN; 3],
            deflected: run.deflected,
            ..State::default()
        };
        let units = script.blocks.iter().find_map(|block| match &block.kind {
            BlockKind::Words(words) => words.modes.metric,
            _ => None,
        });
        let mut slots = vec![f64::NAN; script.slots];
        for (slot, value) in &script.kept {
            slots[*slot as usize] = *value;
        }
        Machine {
            script,
            arguments: OnceCell::new(),
            state,
            slots: VariableStore::of(slots),
            metric: units.map_or(f64::NAN, |metric| f64::from(u8::from(metric))),
            unwatched: Default::default(),
            first: None,
            spun: None,
            run,
            refused: Cell::new(false),
            budget_left: Cell::new(BUDGET),
        }
    }

    /// Makes a motion and records its modes.
    fn moved(
        &mut self,
        line: usize,
        words: &Words,
        motion: Motion,
        trace: &mut Trace,
        world: &mut ContactModel<'_>,
        scratch: &mut State,
    ) -> Result<Step, ReadError> {
        let modes = self.state.modes;
        let first = *self.first.get_or_insert(modes);
        trace.modes = first;
        if modes != first && trace.changed.len() < MOST_CHANGES {
            trace.changed.push((line, modes));
        }
        let mut step = self.motion(line, words, motion)?;
        if self.refused.take() {
            return Err(trouble(line, reads_ahead()));
        }
        self.go(&mut step, motion, world, scratch)?;
        Ok(step)
    }

    /// Whether the run has reached its end condition.
    fn is_there(&self) -> bool {
        self.run
            .until
            .is_some_and(|(place, off)| near(place, self.state.at, off))
    }

    /// Adds the values that are known at the end.
    fn finish(&mut self, trace: &mut Trace) {
        if trace.steps.is_empty() {
            trace.modes = self.state.modes;
        }
        trace.spindle_line = self.spun;
        trace.written = self.written(trace);
    }

    /// Line of a block; in a subroutine the line of the outermost call.
    fn line(&self, own: usize) -> usize {
        self.state.stack.first().map_or(own, |called| called.line)
    }

    fn tool_axis(&self) -> usize {
        self.state.modes.plane.unwrap_or(Plane::G17).axes()[2]
    }

    fn spend(&self, work: usize) {
        self.budget_left
            .set(self.budget_left.get().saturating_sub(work));
    }

    /// Carries out a block, without its motion.
    fn step(&mut self) -> Result<BlockEffect<'s>, ReadError> {
        let script = self.script;
        let block = &script.blocks[self.state.pc];
        self.spend(1);
        if self.budget_left.get() == 0 {
            return Err(trouble(block.line, text!("the program does not end")));
        }
        self.state.pc += 1;
        let flow = self.carry_out(block)?;
        if self.refused.get() || (self.run.strict && self.acts_early(&flow)) {
            return Err(self.refuse(block.line, reads_ahead()));
        }
        Ok(flow)
    }

    /// Refusal of a strict run.
    fn refuse(&self, line: usize, message: Text) -> ReadError {
        self.refused.set(true);
        trouble(line, message)
    }

    /// Whether a block has an effect while a motion before it may still be running.
    fn acts_early(&self, flow: &BlockEffect<'_>) -> bool {
        let acts = match flow {
            BlockEffect::Alarm => matches!(
                self.script.ahead,
                LookAhead::Alarms | LookAhead::ReadsAndActs
            ),
            BlockEffect::Wrote(..) => self.script.ahead == LookAhead::ReadsAndActs,
            _ => false,
        };
        let written = matches!(flow, BlockEffect::Wrote(..));
        acts && self.state.ahead || written && self.state.waits
    }

    /// Whether a condition is true. One that depends on a variable without a value is unknown.
    fn holds(&self, condition: NodeId, line: usize) -> Result<bool, ReadError> {
        let value = self.value(condition);
        if value.is_nan() && self.run.strict {
            return Err(self.refuse(
                line,
                text!("this condition depends on a variable without a value"),
            ));
        }
        Ok(value != 0.0)
    }

    /// Effect of a block, whether or not it is allowed here.
    fn carry_out(&mut self, block: &'s Block) -> Result<BlockEffect<'s>, ReadError> {
        match &block.kind {
            BlockKind::Nothing => {}
            BlockKind::Pause => {
                self.state.waits = true;
                return Ok(BlockEffect::Pause);
            }
            BlockKind::Halt => (self.state.ahead, self.state.waits) = (false, false),
            BlockKind::Words(words) => {
                self.state.modes = self.state.modes.then(words.modes);
                if words.modes.spindle == Some(true) {
                    self.spun.get_or_insert(block.line);
                }
                if let Some(motion) = words.motion {
                    return Ok(BlockEffect::Moved(words, motion));
                }
            }
            BlockKind::Set(slot, node) => self.write(*slot, *node),
            BlockKind::SetOther(..) | BlockKind::Elsewhere(_) if self.run.strict => {
                return Err(self.refuse(block.line, not_in_a_proof(&block.kind)));
            }
            BlockKind::SetOther(slot, node) => self.write(*slot, *node),
            BlockKind::Elsewhere(axes) => {
                (0..3)
                    .filter(|axis| axes[*axis])
                    .for_each(|axis| self.state.stated[axis] = false);
            }
            BlockKind::SetOffset(part, node) => {
                let value = self.value(*node);
                self.set_part(*part, value);
                return Ok(BlockEffect::Wrote(Written::Part(*part)));
            }
            BlockKind::Jump(target) => self.state.pc = *target,
            BlockKind::JumpIf(node, target) => {
                if self.holds(*node, block.line)? {
                    self.state.pc = *target;
                }
            }
            BlockKind::JumpUnless(node, target) => {
                if !self.holds(*node, block.line)? {
                    self.state.pc = *target;
                }
            }
            BlockKind::Call(target, arguments) => self.call(block.line, *target, arguments)?,
            BlockKind::Return => self.give_back(block.line)?,
            BlockKind::Output(code, node) => {
                return Ok(BlockEffect::Output(code, self.value(*node)));
            }
            BlockKind::Reading(number, axes) => {
                self.state.reading = Some(axes.map(|node| node.map(|node| self.value(node))));
                return Ok(BlockEffect::Wrote(Written::Offset(
                    *number,
                    axes.map(|node| node.is_some()),
                    false,
                )));
            }
            BlockKind::Origin(number, axes, turn) => {
                self.set_origin(*number, axes, *turn);
                return Ok(BlockEffect::Wrote(Written::Offset(
                    *number,
                    axes.map(|node| node.is_some()),
                    turn.is_some(),
                )));
            }
            BlockKind::Alarm => return Ok(BlockEffect::Alarm),
            BlockKind::Warned => self.state.warned = true,
            BlockKind::Native => {
                let script = self.script;
                for (slot, value) in script
                    .measured
                    .get(self.state.natives)
                    .into_iter()
                    .flatten()
                {
                    self.spend(WRITE);
                    self.slots.set(*slot as usize, *value);
                }
                self.state.natives += 1;
                return Ok(BlockEffect::Native);
            }
            BlockKind::End if self.state.warned => return Ok(BlockEffect::Alarm),
            BlockKind::End => return Ok(BlockEffect::End),
        }
        Ok(BlockEffect::Next)
    }

    /// Gives a variable a value. The previous value is logged; the budget bounds the log of a program that would run forever.
    fn write(&mut self, slot: Slot, node: NodeId) {
        self.spend(WRITE);
        let value = self.value(node);
        self.slots.set(slot as usize, value);
    }

    /// Enters a subroutine with these arguments.
    fn call(&mut self, line: usize, target: usize, arguments: &[NodeId]) -> Result<(), ReadError> {
        let slots = *self
            .arguments
            .get_or_init(|| ARGUMENTS.map(|name| self.script.find(name)));
        let values: Vec<(usize, f64)> = arguments
            .iter()
            .enumerate()
            .filter_map(|(i, node)| Some(((*slots.get(i)?)? as usize, self.value(*node))))
            .collect();
        let before = values
            .iter()
            .map(|(slot, _)| (*slot, self.slots.get(*slot)))
            .collect();
        if self.state.stack.len() >= ARGUMENTS.len() {
            return Err(trouble(
                line,
                text!("subroutines call each other too deeply"),
            ));
        }
        let called = CallFrame {
            back: self.state.pc,
            line: self.line(line),
            arguments: before,
        };
        self.state.stack.push(called);
        values
            .into_iter()
            .for_each(|(slot, value)| self.slots.set(slot, value));
        self.state.pc = target;
        Ok(())
    }

    /// Returns from a subroutine.
    fn give_back(&mut self, line: usize) -> Result<(), ReadError> {
        let called = self
            .state
            .stack
            .pop()
            .ok_or_else(|| trouble(line, text!("a subroutine ends that was not called")))?;
        called
            .arguments
            .into_iter()
            .for_each(|(slot, value)| self.slots.set(slot, value));
        self.state.pc = called.back;
        Ok(())
    }

    /// Sets origin and rotation of a work offset.
    fn set_origin(&mut self, number: i32, axes: &[Option<NodeId>; 3], turn: Option<NodeId>) {
        for (axis, node) in axes.iter().enumerate() {
            if let Some(value) = node.map(|node| self.value(node)) {
                self.set_part(Part::Origin(number, axis), value);
            }
        }
        if let Some(value) = turn.map(|node| self.value(node)) {
            let axis = self.tool_axis();
            self.set_part(Part::Turn(number, axis), value);
        }
    }

    /// A motion from the current ball centre.
    fn motion(&mut self, line: usize, words: &Words, motion: Motion) -> Result<Step, ReadError> {
        let from = [0, 1, 2].map(|axis| {
            if self.state.stated[axis] {
                self.state.at[axis]
            } else {
                f64::NAN
            }
        });
        let mut to = self.state.at;
        for (axis, node) in words.to.iter().enumerate() {
            if let Some(node) = node {
                to[axis] = self.value(*node);
                self.state.stated[axis] = true;
            }
        }
        if to.iter().any(|x| !x.is_finite()) {
            return Err(trouble(
                line,
                text!("this motion has a position that is not a number"),
            ));
        }
        if let Some(node) = words.feed {
            self.state.feed = Some(self.value(node));
        }
        let feed = if motion == Motion::Rapid {
            None
        } else {
            self.state.feed
        };
        if feed.is_some_and(|feed| feed.is_nan() || feed <= 0.0) {
            return Err(trouble(line, text!("a feed must be more than 0")));
        }
        let arc = match motion {
            Motion::Clockwise | Motion::Counter => {
                let center = [0, 1, 2].map(|axis| {
                    self.state.at[axis] + words.center[axis].map_or(0.0, |node| self.value(node))
                });
                Some((center, motion == Motion::Clockwise))
            }
            _ => None,
        };
        let kind = if motion == Motion::Rapid {
            Kind::Rapid
        } else {
            Kind::Feed
        };
        let (contact, miss) = (ProbeConsequence::Continues, ProbeConsequence::Continues);
        let known = self.state.stated;
        Ok(Step {
            line,
            from,
            to,
            known,
            kind,
            feed,
            states_feed: words.feed.is_some(),
            arc,
            contact,
            miss,
            still_deflected: None,
        })
    }

    /// Makes a motion. For a probing one the other outcome is followed as well.
    fn go(
        &mut self,
        step: &mut Step,
        motion: Motion,
        world: &mut ContactModel<'_>,
        scratch: &mut State,
    ) -> Result<(), ReadError> {
        self.state.ahead = self.runs_on(motion);
        if !motion.probes() {
            self.state.at = step.to;
            self.unwatched.0 = true;
            self.unwatched.1.copy_from(&self.state);
            self.unwatched.1.written = self.slots.mark();
            return Ok(());
        }
        if std::mem::take(&mut self.unwatched.0) {
            // A block that no control could carry out stops it with an alarm.
            step.still_deflected = Some(
                self.still_deflected()
                    .unwrap_or(ProbeConsequence::ControlStops),
            );
        }
        let from = self.state.at;
        let half = [0, 1, 2].map(|axis| (from[axis] + step.to[axis]) / 2.0);
        let met = match (world(step), motion) {
            (ProbeOutcome::Contact(stops, reads), _) => Some((stops, reads)),
            (ProbeOutcome::Nothing, _) | (ProbeOutcome::Unknown, Motion::MustBeFree) => None,
            (ProbeOutcome::Unknown, Motion::MayTouch) => {
                let free = self
                    .other_way(step.to, Some((half, half)), scratch)?
                    .stops();
                (!free).then_some((half, half))
            }
            (ProbeOutcome::Unknown, _) => Some((half, half)),
        };
        let other = if met.is_some() {
            None
        } else {
            Some((half, half))
        };
        let ending = match (motion, other) {
            (Motion::MustTouch, None) | (Motion::MustBeFree, Some(_)) => {
                ProbeConsequence::ControlStops
            }
            _ => self.other_way(step.to, other, scratch)?,
        };
        (step.kind, step.contact, step.miss) = match (met, ending) {
            (_, ProbeConsequence::Continues) => (Kind::Unchecked, ending, ending),
            (Some(_), _) => (Kind::Touch, ProbeConsequence::Continues, ending),
            (None, _) => (Kind::Watched, ending, ProbeConsequence::Continues),
        };
        match (motion, met) {
            (Motion::MustTouch, None) => {
                return Err(trouble(step.line, text!("this touch makes no contact")));
            }
            (Motion::MustBeFree, Some(_)) => {
                return Err(trouble(step.line, text!("this move collides")));
            }
            _ => self.arrive(step.to, met),
        }
        Ok(())
    }

    /// Whether the control evaluates later blocks before a motion has ended.
    fn runs_on(&self, motion: Motion) -> bool {
        match self.script.ahead {
            LookAhead::Harmless => false,
            LookAhead::Alarms => !motion.probes(),
            LookAhead::Reads | LookAhead::ReadsAndActs => true,
        }
    }

    /// The ball stops at its contact, or at the end of the move.
    fn arrive(&mut self, to: Place, met: Option<(Place, Place)>) {
        (self.state.at, self.state.trigger) = met.unwrap_or((to, to));
        self.state.contact = met.is_some();
    }
}

/// Names of the arguments of a subroutine.
const ARGUMENTS: [&[u8]; 9] = [
    b"#1", b"#2", b"#3", b"#4", b"#5", b"#6", b"#7", b"#8", b"#9",
];
