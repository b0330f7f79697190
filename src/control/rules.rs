//! Names of safety rules that a control may be unable to guarantee, or that the proof refers to.

/// Positioning is watched.
pub const WATCHED: &str = "positioning-watched";
/// A contact in positioning leads to a lift.
pub const CONTACT_LIFTS: &str = "contact-lifts";
/// A missed touch leads to a lift.
pub const MISS_LIFTS: &str = "missed-touch-lifts";
/// A start below the path goes up first.
pub const LOW_START: &str = "low-start-goes-up";
/// No rapid is below the clearance plane.
pub const NO_LOW_RAPID: &str = "no-low-rapid";
/// A work offset is written once.
pub const ONE_WRITE: &str = "one-write";
/// Results are checked before a work offset is written.
pub const PLAUSIBLE: &str = "plausible-before-write";
/// Results out of tolerance have the action of the job.
pub const TOLERANCE: &str = "tolerance-obeyed";
/// A cycle that follows a result is shifted no farther than the limit of that result.
pub const PLACE: &str = "place-within-limit";
/// The operator is asked before a work offset is written.
pub const ASKED: &str = "asked-before-write";
/// A restart in the middle writes nothing.
pub const RESTART: &str = "restart-writes-nothing";
/// A work offset is written last.
pub const WRITE_LAST: &str = "offset-after-touches";
