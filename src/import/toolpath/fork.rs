//! Both ways of a condition that is not known: each is read from where they part, and where they meet a place is known only if both say the same.

use crate::import::toolpath::block::Fork;
use crate::import::toolpath::frames::{Frames, Position};
use crate::import::toolpath::reader::Reader;

/// So many ways may be open: whoever jumps over more ends has an end.
const MOST_FORKS: usize = 200;

/// What two ways agree on; NaN is not known.
fn agreed(
    (place, frames): (Position, &Frames),
    (other, others): (Position, Frames),
) -> (Position, Frames) {
    let agreed = [0, 1, 2].map(|axis| {
        if place[axis] == other[axis] {
            place[axis]
        } else {
            f64::NAN
        }
    });
    let mut all = others;
    all.agree(frames);
    (agreed, all)
}

impl Reader {
    /// A condition that is not known: its lines are run, or not. `until` is where a jump leads to.
    pub(super) fn parts(&mut self, until: Option<usize>) {
        let own = (self.place, &self.frames);
        let known = self
            .forks
            .iter_mut()
            .find(|fork| until.is_some() && fork.until == until);
        if let Some(fork) = known {
            // Another way leads there.
            let place = std::mem::take(&mut fork.place);
            let frames = fork.frames.clone();
            (fork.place, fork.frames) = agreed(own, (place, frames));
            return;
        }
        if self.run.is_some() && self.forks.len() < MOST_FORKS {
            self.forks.push(Fork {
                place: self.place,
                frames: self.frames.clone(),
                ends: None,
                until,
                otherwise: false,
            });
        }
    }

    /// The next way of the same condition, in any case if none before it was run.
    pub(super) fn other_way(&mut self, otherwise: bool) {
        let Some(fork) = self
            .forks
            .iter_mut()
            .rev()
            .find(|fork| fork.until.is_none())
        else {
            return;
        };
        let own = (self.place, self.frames.clone());
        fork.ends = Some(match fork.ends.take() {
            Some(ends) => agreed((ends.0, &ends.1), own),
            None => own,
        });
        fork.otherwise |= otherwise;
        let begins = (fork.place, fork.frames.clone());
        self.continues_from(begins);
    }

    /// The ways of the innermost condition meet, or those of a jump to this line.
    pub(super) fn meet(&mut self, line: Option<usize>) {
        while let Some(at) = self.forks.iter().rposition(|fork| fork.until == line) {
            let fork = self.forks.swap_remove(at);
            let mut ends = (self.place, self.frames.clone());
            if let Some((place, frames)) = &fork.ends {
                ends = agreed((*place, frames), ends);
            }
            if !fork.otherwise {
                ends = agreed((fork.place, &fork.frames), ends);
            }
            self.continues_from(ends);
            if line.is_none() {
                return;
            }
        }
    }

    /// The next move begins here, and not where the one before ended.
    fn continues_from(&mut self, (place, frames): (Position, Frames)) {
        let same = |axis: usize| {
            place[axis] == self.place[axis] || place[axis].is_nan() && self.place[axis].is_nan()
        };
        self.resumes |= !(0..3).all(same);
        (self.place, self.frames) = (place, frames);
    }
}
