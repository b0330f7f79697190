//! The names of safety rules that a control may be unable to hold, or that the proof must know of.

/// Positioning is watched.
pub const WATCHED: &str = "positioning-watched";
/// A contact in positioning lifts.
pub const CONTACT_LIFTS: &str = "contact-lifts";
/// A missed touch lifts.
pub const MISS_LIFTS: &str = "missed-touch-lifts";
/// A low stylus goes up first.
pub const LOW_START: &str = "low-start-goes-up";
/// No rapid is low.
pub const NO_LOW_RAPID: &str = "no-low-rapid";
/// A work offset is written once.
pub const ONE_WRITE: &str = "one-write";
/// Results are plausible before a work offset is written.
pub const PLAUSIBLE: &str = "plausible-before-write";
/// What follows from a result that is out of its tolerance.
pub const TOLERANCE: &str = "tolerance-obeyed";
/// A cycle that follows a result goes no farther than the limit of that.
pub const PLACE: &str = "place-within-limit";
/// A restart in the middle writes nothing.
pub const RESTART: &str = "restart-writes-nothing";
/// A work offset is written last.
pub const WRITE_LAST: &str = "offset-after-touches";
