//! The ways of a run that part and meet where a condition is not known.

use crate::import::toolpath::frames::Axes;

/// What a condition or a loop that is not known does to the ways of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    /// A condition begins: its lines are run, or not.
    Begins,
    /// Its next branch, in any case if none before it was run.
    Branches {
        otherwise: bool,
    },
    Ends,
    LoopBegins,
    /// The loop was run once. The positions of these axes were computed, and may differ in the next round.
    LoopEnds(Axes),
    /// A loop that was run ends, of which it is not known how often it runs.
    LoopLeft(Axes),
}
