//! The program after its motions: its end with other results than the measured ones, and a restart in its middle.

use super::slots::{VariableStore, WriteMark};
use super::{BlockEffect, Machine, Run, State};
use crate::control::iso::script::{BlockKind, Motion, Part, Script, Slot};
use crate::control::trace::{Place, Trace};

/// State of a program when its results have their values, and its variables at its end.
#[derive(Clone, Debug, Default)]
pub struct ResultCheckpoint {
    /// Whether none of the marked variables had a value before.
    begun: bool,
    state: State,
    /// Values of its variables there; `None` while the run can still return there.
    values: Option<Vec<f64>>,
    end: Vec<f64>,
    /// Values of its variables each time it waits for the operator.
    paused: Vec<Vec<f64>>,
}

/// Outcome of the end of a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TailOutcome {
    /// Whether it stops with an alarm.
    pub stops: bool,
    /// Whether it reaches its end.
    pub ends: bool,
    /// Whether it writes a work offset or a tool.
    pub writes: bool,
    /// Whether it waits for the operator before it writes.
    pub asks: bool,
}

impl ResultCheckpoint {
    pub(super) fn keep(&mut self, state: &State, written: WriteMark) {
        self.begun = true;
        self.state.copy_from(state);
        self.state.written = written;
        self.values = None;
    }

    /// A motion was made: if results come before it, the tail begins after it.
    pub(super) fn moved(&mut self, state: &State, written: WriteMark) {
        if self.begun {
            self.keep(state, written);
        }
    }

    /// The run returns to an earlier state.
    pub(super) fn before(&mut self, written: WriteMark, slots: &mut VariableStore) {
        if self.begun && self.values.is_none() && written < self.state.written {
            self.values = Some(slots.at(self.state.written));
        }
    }

    pub(super) fn end(&mut self, slots: &mut VariableStore) {
        self.end = slots.values().to_vec();
        if self.begun && self.values.is_none() {
            self.values = Some(slots.at(self.state.written));
        }
    }

    /// The program waits for the operator.
    pub(super) fn paused(&mut self, slots: &mut VariableStore) {
        const MOST: usize = 20;
        if self.paused.len() < MOST {
            self.paused.push(slots.values().to_vec());
        }
    }

    /// Values of the variables each time the program waits for the operator.
    pub fn paused_values(&self) -> &[Vec<f64>] {
        &self.paused
    }

    /// Values of the variables at the end of the program.
    pub fn last_values(&self) -> &[f64] {
        &self.end
    }

    /// Runner for the end of the program; `None` if the program never reached its results.
    pub fn ending<'s, 't>(
        &'s self,
        script: &'s Script<'t>,
        run: Run,
    ) -> Option<TailRunner<'s, 't>> {
        let values = self.values.as_ref().filter(|_| self.begun)?;
        let mut machine = Machine::new(script, run);
        machine.slots = VariableStore::of(values.clone());
        Some(TailRunner {
            begin: &self.state,
            machine,
        })
    }
}

/// Runs the end of a program repeatedly.
pub struct TailRunner<'s, 't> {
    begin: &'s State,
    machine: Machine<'s, 't>,
}

impl TailRunner<'_, '_> {
    /// Outcome of the end of the program with these values of variables.
    pub fn outcome(&mut self, values: impl Iterator<Item = (Slot, f64)>) -> TailOutcome {
        let TailRunner { begin, machine } = self;
        let written = machine.slots.mark();
        machine.state.copy_from(begin);
        machine.budget_left.set(super::BUDGET);
        values.for_each(|(slot, value)| machine.slots.set(slot as usize, value));
        let outcome = machine.finished();
        machine.slots.back(written);
        outcome
    }

    /// Change of a tool by the end of the program with these values of variables, and the values of some variables afterwards. `None` if the program does not
    /// reach its end.
    pub fn corrected<const N: usize>(
        &mut self,
        values: &[(Slot, f64)],
        tool: Part,
        after: [Slot; N],
    ) -> Option<(f64, [f64; N])> {
        let TailRunner { begin, machine } = self;
        let written = machine.slots.mark();
        machine.state.copy_from(begin);
        machine.budget_left.set(super::BUDGET);
        for (slot, value) in values {
            machine.slots.set(*slot as usize, *value);
        }
        let before = machine.part(tool);
        let ends = machine.finished().ends;
        let change = machine.part(tool) - before;
        let after = after.map(|slot| machine.slots.get(slot as usize));
        machine.slots.back(written);
        ends.then_some((change, after))
    }
}

impl Machine<'_, '_> {
    fn finished(&mut self) -> TailOutcome {
        let machine = self;
        let mut outcome = TailOutcome::default();
        while machine.script.blocks.get(machine.state.pc).is_some() {
            match machine.step() {
                Ok(BlockEffect::Next | BlockEffect::Output(..)) => {}
                Ok(BlockEffect::Pause) => outcome.asks |= !outcome.writes,
                Ok(BlockEffect::Wrote(..)) => outcome.writes = true,
                Ok(BlockEffect::Alarm) => {
                    return TailOutcome {
                        stops: true,
                        ..outcome
                    };
                }
                Ok(BlockEffect::End) => {
                    return TailOutcome {
                        ends: true,
                        ..outcome
                    };
                }
                // Results come after every motion.
                Ok(BlockEffect::Moved(..) | BlockEffect::Native) | Err(_) => return outcome,
            }
        }
        outcome
    }
}

/// Whether a program that is restarted at a block, with these values in its variables, changes a work offset or a tool although not all of its touches were made in this
/// run. All restarts share the step budget `left`. `trace` belongs to the whole program; its touches, in these lines in order, touch here, too.
pub fn restarted(
    script: &Script<'_>,
    run: Run,
    (trace, touch_lines): (&Trace, &[usize]),
    (block, values): (usize, &[f64]),
    left: &mut usize,
) -> bool {
    let mut machine = Machine::new(
        script,
        Run {
            strict: true,
            known: true,
            ..run
        },
    );
    machine.slots = VariableStore::of(values.to_vec());
    machine.state.pc = block;
    machine.state.modes = trace.modes;
    machine.budget_left.set(*left);
    let writes = machine.writes_too_early(touch_lines);
    *left = machine
        .budget_left
        .get()
        .saturating_sub(1 + script.slots / 8);
    writes
}

impl Machine<'_, '_> {
    /// Continues to the end, or to a change of a work offset or a tool before this number of touches.
    fn writes_too_early(&mut self, touch_lines: &[usize]) -> bool {
        let script = self.script;
        let machine = self;
        let wanted = touch_lines.len();
        let mut touched = 0;
        while let Some(own) = script.blocks.get(machine.state.pc) {
            let line = machine.line(own.line);
            let flow = machine.step();
            // A variable that was never set is an error if the control does not keep variables.
            if let BlockKind::Set(slot, _) = own.kind
                && script.unset_value.is_none()
                && machine.slots.get(slot as usize).is_nan()
            {
                return false;
            }
            match flow {
                Ok(BlockEffect::Next | BlockEffect::Pause | BlockEffect::Output(..)) => {}
                Ok(BlockEffect::Wrote(..)) if touched < wanted && machine.changed() => return true,
                Ok(BlockEffect::Wrote(..)) => {}
                Ok(BlockEffect::Moved(words, motion)) => {
                    let Ok(step) = machine.motion(line, words, motion) else {
                        return false;
                    };
                    let touches = motion.probes() && touch_lines.binary_search(&line).is_ok();
                    touched += usize::from(touches);
                    let middle: Place =
                        [0, 1, 2].map(|axis| (machine.state.at[axis] + step.to[axis]) / 2.0);
                    let met = (touches && motion != Motion::MustBeFree).then_some((middle, middle));
                    machine.arrive(step.to, met);
                }
                // The control or the program stops.
                Ok(BlockEffect::Alarm | BlockEffect::End | BlockEffect::Native) | Err(_) => {
                    return false;
                }
            }
        }
        false
    }
}
