//! Result of running a program's arithmetic and jumps before the reader.

use crate::import::toolpath::calls::Place;
use crate::import::toolpath::way::Way;

/// Treatment of a line.
pub(super) enum LineAction {
    /// Read as written.
    AsWritten,
    /// This text is read instead.
    Read(Vec<u8>),
    /// Done; nothing is read.
    Skip,
    /// The program continues at this line.
    JumpTo(Place),
    /// It continues at this line, in a subprogram.
    Enter(Place),
    /// It continues at this line, after a subprogram.
    Leave(Place),
    /// The next line is unknown, and no line below is certain to run.
    Astray,
    /// Read as written, and the program may continue at that line below.
    MayJump(usize),
    /// It may return to that line from a subprogram, or continue below.
    MayLeave(usize),
    /// An unknown condition or loop begins, continues or ends.
    Way(Way),
    /// An unknown condition or loop changes before the line, which is then treated again.
    Again(Way),
    /// A branch with an unknown condition ends the program: it continues below, or at this line.
    BranchEnds(Option<Place>),
    /// The program ends here explicitly.
    Ends,
    /// The run is too long.
    Stop,
}

impl LineAction {
    /// To a line, if there is one.
    pub fn to(place: Option<Place>) -> LineAction {
        place.map_or(LineAction::AsWritten, LineAction::JumpTo)
    }
}
