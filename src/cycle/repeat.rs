//! Repeated touches of each point.

use crate::form::{Field, SubForm, form};

/// Largest number of touches of one point. HEIDENHAIN's controls also repeat a touch up to three times [R].
const MOST_TIMES: i32 = 3;

form! {
    /// Repeated touches of each point.
    pub struct Repeat {
        /// Number of touches of each point. The result uses their mean.
        times: i32 = Field::count("times", "Touches of each point", 2, 1, MOST_TIMES).group("Repeated touches"),
        /// Largest distance between touches of the same point. Beyond it the program writes nothing and stops; a program that only measures says so. Empty: no limit.
        spread: Option<f64> = Field::length("spread", "Largest spread", 0.01).in_inch(0.0004).range(0.0001, 10.0).usual(0.001, 0.1).null_means("no limit").group("Repeated touches"),
    }
}

/// Additional form of every cycle that touches.
pub const REPEAT: SubForm = SubForm {
    key: "repeat",
    fields: Repeat::FIELDS,
    optional: true,
};
