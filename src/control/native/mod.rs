//! Probing cycles of controls and probe makers, with the meaning of each argument. Reader, explanation and docs use this table.
//!
//! Facts are marked: sourced (read in a maker's manual, a maker's macro or a post that a maker publishes) or recalled (not verified on a control). Lengths are
//! in the program's units, angles in degrees.

pub mod heidenhain;
mod renishaw;
pub mod rows;
pub mod siemens;
mod small;
mod writes;

use crate::control::edition::Edition;

pub use writes::tool_name;

/// Meaning of a word with the tool that a measuring call corrects.
pub const CORRECTED: &str = "tool offset that is corrected";

/// Unit of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    Length,
    Angle,
    Feed,
    /// A number, a choice, a register.
    None,
}

impl Unit {
    pub fn word(self) -> &'static str {
        match self {
            Unit::Length => "length",
            Unit::Angle => "angle",
            Unit::Feed => "feed",
            Unit::None => "none",
        }
    }
}

/// How well a call is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    Sourced,
    Recalled,
}

impl Mark {
    pub fn word(self) -> &'static str {
        match self {
            Mark::Sourced => "sourced",
            Mark::Recalled => "recalled",
        }
    }
}

/// An argument of a call.
#[derive(Clone, Copy, Debug)]
pub struct Argument {
    /// Letter, Q number, or position between the commas, from 1.
    pub name: &'static str,
    pub meaning: &'static str,
    pub unit: Unit,
    /// The smallest and largest value that the control accepts, where known. Without a largest value the smallest itself is excluded.
    pub range: Option<(f64, f64)>,
}

impl Argument {
    const fn within(self, low: f64, high: f64) -> Argument {
        Argument {
            range: Some((low, high)),
            ..self
        }
    }

    /// More than 0.
    const fn positive(self) -> Argument {
        self.within(0.0, f64::INFINITY)
    }

    /// Whether the control accepts a value.
    pub fn takes(&self, value: f64) -> bool {
        self.range.is_none_or(|(low, high)| {
            (low..=high).contains(&value) && (high.is_finite() || value > low)
        })
    }

    /// Its range in words.
    pub fn range_words(&self) -> Option<String> {
        let (low, high) = self.range?;
        let low = crate::num::decimal(low, 3);
        Some(if high.is_finite() {
            format!("{low} to {}", crate::num::decimal(high, 3))
        } else {
            format!("more than {low}")
        })
    }
}

const fn feed(name: &'static str, meaning: &'static str) -> Argument {
    Argument {
        name,
        meaning,
        unit: Unit::Feed,
        range: None,
    }
}

const fn length(name: &'static str, meaning: &'static str) -> Argument {
    Argument {
        name,
        meaning,
        unit: Unit::Length,
        range: None,
    }
}

const fn angle(name: &'static str, meaning: &'static str) -> Argument {
    Argument {
        name,
        meaning,
        unit: Unit::Angle,
        range: None,
    }
}

const fn plain(name: &'static str, meaning: &'static str) -> Argument {
    Argument {
        name,
        meaning,
        unit: Unit::None,
        range: None,
    }
}

/// A call.
#[derive(Clone, Copy, Debug)]
pub struct Call {
    /// Notation in programs: `G65 P9814`, `TCH PROBE 412`, `CYCLE977`.
    pub name: &'static str,
    /// Its measurement or effect, in a few words.
    pub title: &'static str,
    /// Its own arguments.
    pub arguments: &'static [Argument],
    /// Arguments that it shares with other calls of its set.
    pub shared: &'static [Argument],
    /// Arguments without which the control refuses it; of a list in one entry (`X Y Z`) one is needed.
    pub needs: &'static [&'static str],
    /// Pairs that exclude each other.
    pub excludes: &'static [(&'static str, &'static str)],
    pub mark: Mark,
    /// Source of the facts.
    pub source: &'static str,
}

impl Call {
    /// An argument by its name.
    pub fn argument(&self, name: &str) -> Option<&'static Argument> {
        self.arguments
            .iter()
            .chain(self.shared)
            .find(|argument| argument.name == name)
    }
}

/// Sets whose calls have the numbers of another set.
const ON_MAZAK: &str = "Mazak: Renishaw's macros of the edition A-4013-0113, where they differ";
const CENTROID: &str =
    "Centroid CNC12: the macros that are shipped with it (numbers of Renishaw's, other meanings)";

/// The sets of calls.
pub static SETS: [(&str, &[Call]); 9] = [
    (
        "Renishaw's macros: Fanuc and its kin, Haas, Mazak, Hurco (P98xx), Brother (P88xx)",
        &renishaw::CALLS,
    ),
    (ON_MAZAK, &renishaw::MAZAK),
    ("Haas: the macros of its probing screens", &renishaw::HAAS),
    ("HEIDENHAIN: touch probe cycles", &heidenhain::CALLS),
    ("SINUMERIK: measuring cycles", &siemens::CALLS),
    ("LNC: the macros of the maker", &small::LNC),
    ("RepRapFirmware with MillenniumOS", &small::MILLENNIUM),
    ("Carvera, community firmware", &small::CARVERA),
    (CENTROID, &small::CENTROID),
];

/// A call by its name without blanks; P88xx is P98xx of a Brother, CALL O98xx that of an Okuma.
pub fn find(name: &str) -> Option<&'static Call> {
    find_in(name, |set| set != CENTROID && set != ON_MAZAK)
}

/// A call by its name in a program for an edition of Renishaw's macros.
pub fn find_of(edition: Edition, name: &str) -> Option<&'static Call> {
    let own = (edition == Edition::Mazak).then(|| find_in(name, |set| set == ON_MAZAK));
    own.flatten().or_else(|| find(name))
}

/// A call by its name in a program of a Centroid.
pub fn find_centroid(name: &str) -> Option<&'static Call> {
    find_in(name, |set| set == CENTROID)
}

fn find_in(name: &str, is_searched: fn(&str) -> bool) -> Option<&'static Call> {
    let plain: String = name
        .chars()
        .filter(|c| !c.is_whitespace())
        .map(|c| c.to_ascii_uppercase())
        .collect();
    let plain = plain
        .replace("G65P88", "G65P98")
        .replace("CALLO98", "G65P98");
    let same = |call: &&Call| call.name.bytes().filter(|b| *b != b' ').eq(plain.bytes());
    SETS.iter()
        .filter(|(set, _)| is_searched(set))
        .flat_map(|(_, calls)| calls.iter())
        .find(same)
}

#[cfg(test)]
mod tests {
    use super::rows::{Asked, Probed};
    use super::*;
    use crate::path::Quantity;

    /// The table of words has the meanings of the rows: all of HEIDENHAIN's, and those of a SINUMERIK that the table has.
    #[test]
    fn words_of_rows_count_in_the_units_of_the_table() {
        let sets = [
            ("TCH PROBE ", "Q", heidenhain::ROWS.as_slice()),
            ("CYCLE", "", &siemens::ROWS),
        ];
        let mut asked = 0;
        for (call, letter, row) in sets
            .iter()
            .flat_map(|(call, letter, rows)| rows.iter().map(move |row| (call, letter, row)))
        {
            let called = find(&format!("{call}{}", row.number)).expect("a call of the table");
            let everything = Probed {
                lifts: true,
                down: Some(1.0),
                row: Some(1.0),
                ..Probed::unknown(row.shape, row.inside)
            };
            for (number, is) in row.words() {
                let argument = called.argument(&format!("{letter}{number}"));
                assert!(
                    argument.is_some() || letter.is_empty(),
                    "{} Q{number}",
                    row.number
                );
                // Without a zone the control's editor writes 1.
                let (Some(argument), false) = (argument, matches!(is, rows::Is::Zone(_))) else {
                    continue;
                };
                let unit = match is
                    .value(&everything, &Asked::default())
                    .expect("a word of every call")
                {
                    Quantity::Length(_) => Unit::Length,
                    Quantity::Angle(_) => Unit::Angle,
                    Quantity::Feed(_) => Unit::Feed,
                    Quantity::Plain(_) => Unit::None,
                };
                assert_eq!(unit, argument.unit, "{} {number}", row.number);
                asked += 1;
            }
            let mut numbers: Vec<u16> = row.words().map(|(number, _)| number).collect();
            numbers.sort_unstable();
            numbers.dedup();
            assert_eq!(numbers.len(), row.words().count(), "{}", row.number);
        }
        assert!(asked > 200, "{asked}");
    }

    #[test]
    fn every_call_is_found_by_its_name_and_says_each_letter_once() {
        for (set, call) in SETS
            .iter()
            .flat_map(|(set, calls)| calls.iter().map(move |call| (*set, call)))
        {
            let found = match set {
                CENTROID => find_centroid(call.name),
                ON_MAZAK => find_of(Edition::Mazak, call.name),
                _ => find(call.name),
            };
            assert!(
                std::ptr::eq(found.unwrap(), call),
                "{} is there twice",
                call.name
            );
            let mut names: Vec<&str> = call
                .arguments
                .iter()
                .map(|argument| argument.name)
                .collect();
            names.sort_unstable();
            let all = names.len();
            names.dedup();
            assert_eq!(names.len(), all, "{}", call.name);
            let known = |name: &str| name.split(' ').all(|name| call.argument(name).is_some());
            assert!(call.needs.iter().all(|name| known(name)), "{}", call.name);
            assert!(
                call.excludes.iter().all(|(a, b)| known(a) && known(b)),
                "{}",
                call.name
            );
            assert!(!call.source.is_empty() && !call.title.is_empty());
        }
        assert_eq!(find("g65p8814").unwrap().name, "G65 P9814");
        assert_eq!(find("call O9814").unwrap().name, "G65 P9814");
        assert!(find("G65 P1").is_none());
    }
}
