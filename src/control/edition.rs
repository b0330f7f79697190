//! Editions of Renishaw's macros. They share their numbers, but not every letter.
//!
//! Sources: the macros of the edition for Haas NGC, version 3.11 [S]; for Mazak's A-4013-0113 one shop's program that was written with the macros and the
//! maker's manual at hand [S, one source].

/// Edition that is installed on a machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Edition {
    #[default]
    Unknown,
    /// Version 3.11 for Haas NGC.
    Haas,
    /// A-4013-0113 for Mazak.
    Mazak,
}

impl Edition {
    /// `machine.edition` in the job.
    pub const fn word(self) -> &'static str {
        match self {
            Edition::Unknown => "unknown",
            Edition::Haas => "haas-ngc",
            Edition::Mazak => "mazak-a-4013-0113",
        }
    }

    /// The edition with this word; `Unknown` for any other word.
    pub fn named(word: &str) -> Edition {
        [Edition::Haas, Edition::Mazak]
            .into_iter()
            .find(|edition| edition.word() == word)
            .unwrap_or(Edition::Unknown)
    }

    /// Name for the operator; `None` if it is not stated.
    pub const fn name(self) -> Option<&'static str> {
        match self {
            Edition::Unknown => None,
            Edition::Haas => Some("3.11 for Haas NGC"),
            Edition::Mazak => Some("A-4013-0113 for Mazak"),
        }
    }

    /// Search distance of a macro without Q, mm: along the tool axis, and in the plane.
    pub const fn searches(self) -> [f64; 2] {
        match self {
            Edition::Unknown | Edition::Haas => [5.0, 5.0],
            Edition::Mazak => [5.0, 10.0],
        }
    }

    /// Pairs of letters that exclude each other in every measuring macro of this edition.
    pub const fn excludes(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Edition::Mazak => &[("S", "T"), ("T", "M"), ("S", "H")],
            Edition::Unknown | Edition::Haas => &[],
        }
    }
}
