//! Follows the program after an unexpected contact, a miss or a deflected probe: to an error exit, or onward.

use super::{BlockEffect, Machine, Run, State};
use crate::control::iso::script::{BlockKind, Motion, ReadError, Script};
use crate::control::trace::{Place, ProbeConsequence};

/// Largest number of blocks followed after the unexpected outcome of a probing move: an exit is short.
const LONGEST_EXIT: usize = 200;

/// Largest number of motions in an exit.
const MOST_LIFTS: usize = 3;

/// State of the probe while a consequence is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Probe {
    /// It answers as at the last probing move.
    Free,
    /// It is deflected from the start.
    Deflected,
    /// It is still deflected from an unwatched motion: the next motion belongs to the exit.
    StillDeflected,
}

/// Consequence for a program that starts with a deflected probe: followed to its first probing move and from there on.
pub fn deflected(script: &Script<'_>, run: Run) -> Result<ProbeConsequence, ReadError> {
    let mut machine = Machine::new(
        script,
        Run {
            deflected: true,
            ..run
        },
    );
    machine.ending(
        usize::MAX,
        20 * script.blocks.len() + LONGEST_EXIT,
        Probe::Deflected,
    )
}

/// An exit computes fewer values than this. The expected results of a foreign program are unknown: an alarm after their computation does not belong to the
/// move.
const COMPUTES: usize = 2;

impl Machine<'_, '_> {
    /// Consequence of a probing move with this outcome, without making the move.
    pub(super) fn other_way(
        &mut self,
        to: Place,
        met: Option<(Place, Place)>,
        scratch: &mut State,
    ) -> Result<ProbeConsequence, ReadError> {
        scratch.copy_from(&self.state);
        let written = self.slots.mark();
        self.arrive(to, met);
        let ending = self.ending(MOST_LIFTS, LONGEST_EXIT, Probe::Free);
        std::mem::swap(&mut self.state, scratch);
        self.slots.back(written);
        ending
    }

    /// Consequence from the last motion on, which was not watched, if the probe is still deflected.
    pub(super) fn still_deflected(&mut self) -> Result<ProbeConsequence, ReadError> {
        let written = self.unwatched.1.written;
        let redo = self.slots.undo(written);
        std::mem::swap(&mut self.state, &mut self.unwatched.1);
        self.state.deflected = true;
        let ending = self.ending(MOST_LIFTS, LONGEST_EXIT, Probe::StillDeflected);
        std::mem::swap(&mut self.state, &mut self.unwatched.1);
        self.slots.back(written);
        self.slots.redo(redo);
        ending
    }

    /// Whether the probe is triggered here. A probing move that starts triggered is an alarm.
    fn in_contact(&self) -> bool {
        self.script.begins_free && self.state.contact
    }

    /// Follows the program until it stops, or until it clearly continues.
    fn ending(
        &mut self,
        most_moves: usize,
        most_blocks: usize,
        probe: Probe,
    ) -> Result<ProbeConsequence, ReadError> {
        let (mut lifts, mut strays, mut writes, mut moves) = (false, false, false, 0);
        let (deflected, mut probes) = (probe != Probe::Free, 0);
        let mut computed = 0;
        for _ in 0..most_blocks {
            let Some(block) = self.script.blocks.get(self.state.pc) else {
                break;
            };
            let line = block.line;
            if let BlockKind::Set(_, value) = block.kind {
                computed += usize::from(self.script.number(value).is_none());
            }
            let flow = match self.step() {
                // A refused block may continue: the control does not stop.
                Err(_) if self.refused.take() => return Ok(ProbeConsequence::Continues),
                flow => flow?,
            };
            match flow {
                BlockEffect::Next | BlockEffect::Pause | BlockEffect::Output(..) => {}
                BlockEffect::Wrote(..) => writes = true,
                // The program ends before another move.
                BlockEffect::End if self.in_contact() && moves == 0 => {
                    return Ok(ProbeConsequence::ControlStops);
                }
                BlockEffect::Native | BlockEffect::End => return Ok(ProbeConsequence::Continues),
                BlockEffect::Alarm if !self.run.strict && computed >= COMPUTES => {
                    return Ok(ProbeConsequence::Continues);
                }
                BlockEffect::Alarm => {
                    return Ok(ProbeConsequence::Exit {
                        line,
                        lifts,
                        moves_sideways: strays,
                        writes,
                    });
                }
                BlockEffect::Moved(words, motion) => {
                    let from = self.state.at;
                    // An exit moves in the modes of the program.
                    strays |= self.first.is_some_and(|first| first != self.state.modes);
                    let step = self.motion(line, words, motion)?;
                    if self.refused.take() {
                        return Ok(ProbeConsequence::Continues);
                    }
                    let up = self.tool_axis();
                    self.state.ahead = self.runs_on(motion);
                    match motion {
                        Motion::MustTouch | Motion::MustBeFree if deflected && probes == 0 => {
                            return Ok(ProbeConsequence::ControlStops);
                        }
                        Motion::MayTouch if deflected && self.script.begins_free => {
                            return Ok(ProbeConsequence::ControlStops);
                        }
                        Motion::MustTouch | Motion::MayTouch if self.in_contact() && moves == 0 => {
                            return Ok(ProbeConsequence::ControlStops);
                        }
                        // A deflected probe ends every probing move at its start, or is not noticed: then the move is made.
                        Motion::MayTouch
                            if deflected && probes < MOST_LIFTS && !self.script.sees_edges =>
                        {
                            self.arrive(from, Some((from, from)));
                            probes += 1;
                        }
                        Motion::MustTouch | Motion::MustBeFree | Motion::MayTouch => {
                            return Ok(ProbeConsequence::Continues);
                        }
                        Motion::Rapid | Motion::Straight | Motion::Clockwise | Motion::Counter => {
                            moves += 1;
                            let across =
                                (0..3).any(|axis| axis != up && step.to[axis] != from[axis]);
                            let rises = step.to[up] > from[up];
                            // From the start to the first probing move the program behaves as with a free probe.
                            if probe != Probe::Deflected || probes > 0 {
                                lifts |= rises && !across;
                                strays |= across
                                    || step.to[up] < from[up]
                                    || step.to[up] > self.run.highest;
                            }
                            if moves > most_moves {
                                return Ok(ProbeConsequence::Continues);
                            }
                            self.state.at = step.to;
                        }
                    }
                }
            }
        }
        Ok(ProbeConsequence::Continues)
    }
}
