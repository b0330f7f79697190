//! What runs a program's arithmetic and jumps in front of the reader.

use crate::import::toolpath::calls::Place;
use crate::import::toolpath::way::Way;

/// What becomes of a line.
pub(super) enum Step {
    /// It is read as it is written.
    AsWritten,
    /// This is read in its place.
    Read(Vec<u8>),
    /// It is done.
    Done,
    /// The program continues elsewhere.
    Go(Place),
    /// It continues there, in a subprogram.
    Enter(Place),
    /// It continues there, back from a subprogram.
    Leave(Place),
    /// Where it continues is not known, and no line below is sure to run.
    Astray,
    /// It is read as it is written, and the program may continue at that line below.
    MayJump(usize),
    /// It may go back to that line from a subprogram, or go on below.
    MayLeave(usize),
    /// A condition or a loop that is not known begins, goes on or ends.
    Way(Way),
    /// The same, in front of the line, which is stepped again.
    Again(Way),
    /// A branch whose condition is not known ends the program: it continues below, or there.
    BranchEnds(Option<Place>),
    /// The program ends here, by its own word.
    Ends,
    /// The program has run for too long.
    Stop,
}

impl Step {
    /// To a place, where there is one.
    pub fn to(place: Option<Place>) -> Step {
        place.map_or(Step::AsWritten, Step::Go)
    }
}
