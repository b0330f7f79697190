//! Branches of a run that part and meet at an unknown condition.

use crate::import::toolpath::frames::Axes;

/// Effect of an unknown condition or loop on the branches of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    /// A condition begins: its lines run or not.
    Begins,
    /// Its next branch; `otherwise`: it runs if no earlier one did.
    Branches {
        otherwise: bool,
    },
    Ends,
    LoopBegins,
    /// A loop ran once. The positions of these axes were computed, and may differ in the next round.
    LoopEnds(Axes),
    /// A loop with an unknown number of rounds ends.
    LoopLeft(Axes),
}
