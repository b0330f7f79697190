//! Lasting writes of a call: register and axes.

use super::rows::{self, Is, Row, Shape};
use super::{CORRECTED, Call, heidenhain};

/// A lasting change by a call.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// `offset`, `length` or `wear`.
    pub kind: &'static str,
    /// Number of the work offset, 1 = G54, 0 the active one; `None` if unknown.
    pub number: Option<i32>,
    /// The written register, if it is not a numbered work offset.
    pub register: String,
    /// X, Y, Z: one bit each.
    pub axes: u8,
    /// False if an unknown argument decides whether the call writes at all.
    pub is_sure: bool,
}

impl Written {
    fn tool(kind: &'static str, tool: f64) -> Written {
        Written {
            kind,
            number: None,
            register: tool_name(tool),
            axes: 0,
            is_sure: !tool.is_nan(),
        }
    }
}

/// Start of the meaning of a letter with the probe's tool, whose length is written.
const PROBE: &str = "tool of the probe";

/// Start of the meaning of a letter with a work offset.
const OFFSET: &str = "work offset that is written";

/// X and Y.
const LEVEL: u8 = 3;

impl Call {
    /// The writes of a call, by its arguments; NaN is unknown.
    pub fn written(&self, arguments: &[(String, f64)]) -> Vec<Written> {
        let given = |name: &str| {
            arguments
                .iter()
                .find(|(known, _)| known == name)
                .map(|(_, value)| *value)
        };
        if let Some(cycle) = self.name.strip_prefix("TCH PROBE ") {
            let measures = cycle.starts_with("42") && cycle != "420";
            // 0 corrects none.
            let tool = given("Q330").filter(|tool| measures && *tool != 0.0);
            let tool = tool.map(|tool| Written::tool("wear", tool));
            return preset(cycle, given).into_iter().chain(tool).collect();
        }
        if self.name.starts_with("CYCLE9") {
            return corrected(self.name, given).into_iter().collect();
        }
        let axes = self.axes(arguments);
        let offset = self
            .arguments
            .iter()
            .chain(self.shared)
            .filter(|argument| argument.meaning.starts_with(OFFSET))
            .find_map(|argument| Some((argument.name, given(argument.name)?)));
        // T is the probe's tool where the length is calibrated, and a distance in a rectangle of the edition for Mazak.
        let kind = self.argument("T").and_then(|t| match t.meaning {
            meaning if meaning.starts_with(CORRECTED) => Some("wear"),
            meaning if meaning.starts_with(PROBE) => Some("length"),
            _ => None,
        });
        let tool = given("T").and_then(|tool| Some((kind?, tool)));
        let offset = offset.map(|(letter, value)| {
            let (number, register) = numbered(letter, value);
            Written {
                kind: "offset",
                number,
                register,
                axes,
                is_sure: !value.is_nan(),
            }
        });
        let tool = tool.map(|(kind, tool)| Written::tool(kind, tool));
        offset.into_iter().chain(tool).collect()
    }

    /// Axes along which one of Renishaw's macros, or a similar one, measures.
    fn axes(&self, arguments: &[(String, f64)]) -> u8 {
        let number = self.name.strip_prefix("G65 P98").unwrap_or_default();
        let given = |letter: &str| arguments.iter().any(|(name, _)| name == letter);
        match number {
            "14" | "19" | "21" | "22" | "23" | "43" => return LEVEL,
            // A rectangle has a side E; otherwise these two write a rotary axis.
            "17" if given("E") => return LEVEL,
            "17" | "18" => return 0,
            _ => {}
        }
        let named = arguments.iter().filter_map(|(name, _)| {
            ["X", "Y", "Z"]
                .iter()
                .position(|axis| axis == name)
                .map(|axis| 1 << axis)
        });
        match named.fold(0, |axes, axis: u8| axes | axis) {
            0 => 7,
            axes => axes,
        }
    }
}

/// A tool by its number, if that is known.
pub fn tool_name(number: f64) -> String {
    if number.is_nan() {
        return "tool".to_owned();
    }
    format!("tool {}", crate::num::decimal(number, 0))
}

/// The work offset with a number: 1 to 6, 54 to 59, or a further one.
fn numbered(letter: &str, value: f64) -> (Option<i32>, String) {
    let whole = value as i32;
    match whole {
        1..=6 => (Some(whole), String::new()),
        54..=59 => (Some(whole - 53), String::new()),
        // Renishaw's macros count G54.1 P1 as 101, up to P300 on a Mazak; G154 P1 of a Haas is 154.01.
        101..=400 if value.fract() == 0.0 => (Some(6 + 1000 * (whole - 100)), String::new()),
        154 => {
            let number = crate::num::decimal(value.fract() * 100.0, 0);
            (None, format!("G154 P{number}"))
        }
        _ if value.is_nan() => (None, letter.to_owned()),
        _ => (None, format!("{letter} {}", crate::num::decimal(value, 2))),
    }
}

/// HEIDENHAIN cycles that set a datum, a basic rotation or a rotary axis.
fn preset(cycle: &str, given: impl Fn(&str) -> Option<f64>) -> Option<Written> {
    let number: u16 = cycle.parse().ok()?;
    let row = heidenhain::row(number);
    let axes = match number {
        _ if row.is_some_and(|row| row.writes != Some(true)) => return None,
        _ if row.is_some() => row.map_or(0, |row| measured_axes(row, &given)),
        400..=402 | 405 => 0,
        414..=416 | 418 => LEVEL,
        1411 if [given("Q1120"), given("Q1121")]
            .iter()
            .any(|q| q.is_some_and(|q| q != 0.0)) =>
        {
            LEVEL
        }
        _ => return None,
    };
    let top = if given("Q381") == Some(1.0) { 4 } else { 0 };
    let (row, register) = match (number, given("Q305")) {
        (400..=402 | 405, _) => (Some(0), "basic rotation".to_owned()),
        (_, Some(0.0) | None) => (Some(0), "active datum".to_owned()),
        (_, Some(row)) if row.is_nan() => (None, "row of the table".to_owned()),
        // It is active only after it is selected.
        (_, Some(row)) => (
            Some(row as i32),
            format!("row {}", crate::num::decimal(row, 0)),
        ),
    };
    Some(Written {
        kind: "offset",
        number: row,
        register,
        axes: axes | top,
        is_sure: true,
    })
}

/// Axes that the call of a row measures.
fn measured_axes(row: &Row, given: &impl Fn(&str) -> Option<f64>) -> u8 {
    if matches!(row.shape, Shape::Bore | Shape::Rectangle) {
        return LEVEL;
    }
    // Without a word for it, the tool axis.
    let Some((number, _)) = row.words().find(|(_, is)| *is == Is::Axis) else {
        return 4;
    };
    match given(&format!("Q{number}")).map(|axis| axis as i32) {
        Some(axis @ 1..=3) => 1 << (axis - 1),
        _ => 7,
    }
}

/// SINUMERIK's measuring cycles: the hundreds of the variant correct, the second argument is the register.
fn corrected(name: &str, given: impl Fn(&str) -> Option<f64>) -> Option<Written> {
    let variant = given("1")?;
    // An unknown variant may correct.
    let corrects = variant.is_nan() || rows::corrects(variant);
    corrects.then_some(())?;
    let (number, register) = match given("2") {
        Some(9000.0) => (Some(0), String::new()),
        Some(row) if (10_000.0..10_100.0).contains(&row) => {
            (Some(row as i32 - 10_000), String::new())
        }
        _ => (None, "work offset".to_owned()),
    };
    let axes = match (name, given("8").map(|axis| axis as i32)) {
        ("CYCLE978", Some(axis @ 1..=3)) => 1 << (axis - 1),
        ("CYCLE998", _) => 0,
        ("CYCLE977", _) => LEVEL,
        _ => 7,
    };
    Some(Written {
        kind: "offset",
        number,
        register,
        axes,
        is_sure: !variant.is_nan(),
    })
}

#[cfg(test)]
mod tests {
    use super::super::find;

    fn written(name: &str, arguments: &[(&str, f64)]) -> Vec<(String, Option<i32>, u8)> {
        let arguments: Vec<(String, f64)> = arguments
            .iter()
            .map(|(name, value)| ((*name).to_owned(), *value))
            .collect();
        let call = find(name).expect("a call of the table");
        let rows = call.written(&arguments);
        rows.into_iter()
            .map(|row| {
                (
                    format!("{} {}", row.kind, row.register).trim().to_owned(),
                    row.number,
                    row.axes,
                )
            })
            .collect()
    }

    /// By the words of the calls: S and T of Renishaw's macros, Q305 and the kind of a HEIDENHAIN cycle, the variant of a SINUMERIK.
    #[test]
    fn a_call_writes_what_its_words_say() {
        let one = |what: &str, number: Option<i32>, axes: u8| vec![(what.to_owned(), number, axes)];
        assert_eq!(written("G65 P9814", &[("D", 25.0)]), []);
        assert_eq!(
            written("G65 P9814", &[("D", 25.0), ("S", 1.0)]),
            one("offset", Some(1), 3)
        );
        assert_eq!(
            written("G65 P9811", &[("Z", 0.0), ("S", 103.0)]),
            one("offset", Some(3006), 4)
        );
        assert_eq!(
            written("G65 P9811", &[("X", 0.0), ("T", 5.0)]),
            one("wear tool 5", None, 0)
        );
        assert_eq!(
            written("TCH PROBE 412", &[("Q305", 0.0)]),
            one("offset active datum", Some(0), 3)
        );
        assert_eq!(
            written("TCH PROBE 417", &[("Q305", 3.0)]),
            one("offset row 3", Some(3), 4)
        );
        assert_eq!(
            written("TCH PROBE 408", &[("Q305", 0.0), ("Q272", 2.0)]),
            one("offset active datum", Some(0), 2)
        );
        assert_eq!(
            written("TCH PROBE 400", &[]),
            one("offset basic rotation", Some(0), 0)
        );
        assert_eq!(written("TCH PROBE 421", &[("Q262", 25.0)]), []);
        assert_eq!(
            written("CYCLE977", &[("1", 101.0), ("2", 10_002.0)]),
            one("offset", Some(2), 3)
        );
        assert_eq!(
            written("CYCLE978", &[("1", 100.0), ("2", 9000.0), ("8", 3.0)]),
            one("offset", Some(0), 4)
        );
        assert_eq!(written("CYCLE977", &[("1", 1.0)]), []);
    }
}
