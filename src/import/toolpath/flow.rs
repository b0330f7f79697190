//! What runs a program's arithmetic and jumps in front of the reader.

use crate::import::toolpath::calls::Place;
use crate::import::toolpath::known::Ask;
use crate::import::toolpath::system::System;
use crate::import::toolpath::way::Way;
use crate::import::toolpath::writes::Variable;

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

/// Runs the arithmetic and the jumps of a text, line by line.
pub(super) trait Flow {
    /// What becomes of the line at `here`; `inside` is how many M98 calls are under way.
    fn step(&mut self, line: &[u8], here: Place, next: Place, inside: usize) -> Step;

    /// Nothing is known of any variable: something else may have set them.
    fn forget(&mut self);

    /// The same of those that calls share: a macro was called, which has locals of its own.
    fn forget_shared(&mut self) {
        self.forget();
    }

    /// The lines of a subprogram end without a way back, at the end of the text or at the next program.
    fn fall_out(&mut self, at_end: bool) -> Option<Place>;

    /// Whether a line ran where it was called.
    fn has_run(&self, line: usize) -> bool;

    /// Whether lines run because something called them.
    fn is_inside(&self) -> bool;

    /// What the control itself knows before the next block.
    fn sees(&mut self, system: System);

    /// What was read before anything set it.
    fn asks(&self) -> Vec<Ask>;

    /// The registers of the control that the last line has written as variables, with their values: NaN is not known.
    fn written(&mut self) -> Vec<(Variable, f64)> {
        Vec::new()
    }

    /// Lines in which a division by zero was asked for.
    fn divisions(&self) -> Vec<u32> {
        Vec::new()
    }

    /// The next subroutine that nothing calls: its name, and where it begins, from which it comes back to `end`.
    fn uncalled(&mut self, end: Place) -> Option<(String, Place)>;
}
