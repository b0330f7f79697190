//! Follows both branches of an unknown condition: each from the state where they part. Where they meet, a position, a mode and a feed are known only if both
//! agree.

use crate::import::toolpath::block::{Fork, State};
use crate::import::toolpath::modes::{Modes, Unsure};
use crate::import::toolpath::reader::Reader;

/// Largest number of branches that are open at the same time.
const MOST_FORKS: usize = 200;

/// Common knowledge of two branches; NaN is unknown.
fn agreed(own: State, mut other: State) -> State {
    let same = |a: f64, b: f64| if a == b { a } else { f64::NAN };
    other.frames.agree(&own.frames);
    State {
        place: [0, 1, 2].map(|axis| same(own.place[axis], other.place[axis])),
        frames: other.frames,
        modes: own.modes.agreed(other.modes),
        feed: same(own.feed, other.feed),
    }
}

impl Modes {
    /// The modes after one of two branches.
    fn agreed(self, other: Modes) -> Modes {
        let moves = |modes: Modes| (modes.motion, modes.curve, modes.given);
        let counts = |modes: Modes| (modes.absolute, modes.diameter, modes.polar);
        let unsure = Unsure {
            motion: self.unsure.motion || other.unsure.motion || moves(self) != moves(other),
            distance: self.unsure.distance
                || other.unsure.distance
                || counts(self) != counts(other),
        };
        Modes {
            unsure,
            stated: self.stated && other.stated,
            maybe_changed: self.maybe_changed || other.maybe_changed,
            plane: self.plane.filter(|plane| other.plane == Some(*plane)),
            scale: if self.scale == other.scale {
                self.scale
            } else {
                f64::NAN
            },
            by_other: self.by_other || other.by_other,
            ..self
        }
    }
}

impl Reader {
    fn state(&self) -> State {
        State {
            place: self.place,
            frames: self.frames.clone(),
            modes: self.modes,
            feed: self.feed,
        }
    }

    /// Begins an unknown condition: its lines run or not. `until` is the target of a jump.
    pub(super) fn begin_branch(&mut self, until: Option<usize>) {
        if self.run.is_none() {
            return;
        }
        let own = self.state();
        let known = self
            .forks
            .iter_mut()
            .find(|fork| until.is_some() && fork.until == until);
        if let Some(fork) = known {
            // Another branch leads there.
            fork.begins = agreed(own, fork.begins.clone());
        } else if self.forks.len() < MOST_FORKS {
            self.forks.push(Fork {
                begins: own,
                ends: None,
                until,
                otherwise: false,
            });
        }
    }

    /// Begins the next branch of the same condition; `otherwise`: it runs if no earlier one did.
    pub(super) fn next_branch(&mut self, otherwise: bool) {
        let own = self.state();
        let Some(fork) = self
            .forks
            .iter_mut()
            .rev()
            .find(|fork| fork.until.is_none())
        else {
            return;
        };
        fork.ends = Some(match fork.ends.take() {
            Some(ends) => agreed(ends, own),
            None => own,
        });
        fork.otherwise |= otherwise;
        let begins = fork.begins.clone();
        self.continues_from(begins);
    }

    /// Joins the branches of the innermost condition, or those of a jump to this line.
    pub(super) fn join_branches(&mut self, line: Option<usize>) {
        while let Some(at) = self.forks.iter().rposition(|fork| fork.until == line) {
            let fork = self.forks.swap_remove(at);
            let mut ends = self.state();
            if let Some(others) = fork.ends {
                ends = agreed(others, ends);
            }
            if !fork.otherwise {
                ends = agreed(fork.begins, ends);
            }
            self.continues_from(ends);
            if line.is_none() {
                return;
            }
        }
    }

    /// The next move begins here instead of at the end of the previous one.
    fn continues_from(&mut self, state: State) {
        let same = |axis: usize| {
            let (place, own) = (state.place[axis], self.place[axis]);
            place == own || place.is_nan() && own.is_nan()
        };
        self.resumes |= !(0..3).all(same);
        (self.place, self.frames) = (state.place, state.frames);
        (self.modes, self.feed) = (state.modes, state.feed);
    }
}
