//! Tolerances of results in the forms of drawings: deviations from nominal, or sizes with a tolerance.

use super::{end_of_number, number, shown, signed, standard};
use crate::num::decimal;
use crate::text::{Text, text};

/// Valid forms of the tolerance of a result, for messages.
pub const RESULT_FORMS: &str = "25H7, H7, ±0.02, +0.021/0, 0 -0.02, 25 ±0.02, 24.98..25.02";

/// A parsed tolerance of a result.
#[derive(Clone, Debug, PartialEq)]
enum Zone<'t> {
    /// Smallest and largest value.
    Ends([f64; 2]),
    /// Deviations, from the size before them if there is one.
    Off(Option<f64>, Deviations<'t>),
    /// Two signed numbers, with or without a blank: deviations, or a size and one deviation. The nominal value decides.
    Either([f64; 2]),
}

#[derive(Clone, Debug, PartialEq)]
enum Deviations<'t> {
    /// Lower and upper.
    Given([f64; 2]),
    /// `H7`, `m`.
    Class(&'t str),
}

impl<'t> Deviations<'t> {
    /// Reads `±0.02`, `+0.021/0`, `0 -0.1`, `+0.02-0.01`, `-0.2`, `H7`, `m`. `None` for any other text. Only 0 has no sign.
    fn read(text: &'t str) -> Option<Self> {
        let given =
            |one: f64, other: f64| Some(Deviations::Given([one.min(other), one.max(other)]));
        let signed_or_0 =
            |text: &str| number(text).filter(|x| *x == 0.0 || text.starts_with(['+', '-']));
        if let Some(off) = text.strip_prefix('±').or_else(|| text.strip_prefix("+/-")) {
            let off = number(off.trim()).filter(|off| *off > 0.0)?;
            return given(-off, off);
        }
        if let Some((one, other)) = text.split_once('/').or_else(|| text.split_once(' ')) {
            return given(signed_or_0(one.trim())?, signed_or_0(other.trim())?);
        }
        if text.starts_with(['+', '-']) {
            return signed(text).and_then(|(low, high)| given(low, high));
        }
        let class = text.starts_with(|c: char| c.is_ascii_alphabetic())
            && text.bytes().all(|b| b.is_ascii_alphanumeric());
        class.then_some(Deviations::Class(text))
    }

    /// Lower and upper deviation in the units of the size; `to_mm` is millimetres in one unit. An error if the class does not exist for the size.
    fn of(&self, size: f64, to_mm: Option<f64>) -> Option<Result<[f64; 2], Text>> {
        match *self {
            Deviations::Given(off) => Some(Ok(off)),
            Deviations::Class(class) => {
                let to_mm = to_mm?;
                Some(standard(class, size * to_mm).map(|(low, high)| [low / to_mm, high / to_mm]))
            }
        }
    }
}

/// Whether a text consists of one or two deviations, such as `±0.02` or `+0.021/0`.
pub fn are_deviations(text: &str) -> bool {
    matches!(Deviations::read(&tidied(text)), Some(Deviations::Given(_)))
}

/// A text with single blanks and uniform signs.
fn tidied(text: &str) -> String {
    let plain = text.replace('\u{2212}', "-").replace('…', "..");
    let plain = plain.trim().trim_start_matches(['Ø', 'ø', '⌀']);
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

impl<'t> Zone<'t> {
    fn read(text: &'t str) -> Option<Self> {
        if let Some((low, high)) = text.split_once("..") {
            let ends = [
                number(low.trim())?,
                number(high.trim_start_matches('.').trim())?,
            ];
            return (ends[0] < ends[1]).then_some(Zone::Ends(ends));
        }
        let Some(end) = end_of_number(text).filter(|_| !text.starts_with("+/-")) else {
            return Deviations::read(text).map(|off| Zone::Off(None, off));
        };
        let (first, rest) = (number(&text[..end])?, text[end..].trim());
        // A size has no sign and is not 0: `+0.021/0`, `0/-0.02`, `+0.021 0`, `-0.2` are deviations.
        let relative = text.starts_with(['+', '-']) || first == 0.0;
        let one = |text: &str| end_of_number(text) == Some(text.len());
        match rest {
            "" | "0" if relative => Deviations::read(text).map(|off| Zone::Off(None, off)),
            _ if relative && rest.starts_with('/') => {
                Deviations::read(text).map(|off| Zone::Off(None, off))
            }
            _ if first == 0.0 && one(rest) => {
                Deviations::read(text).map(|off| Zone::Off(None, off))
            }
            _ if relative && rest.starts_with(['+', '-']) && one(rest) => {
                Some(Zone::Either([first, number(rest)?]))
            }
            _ => Deviations::read(rest).map(|off| Zone::Off(Some(first), off)),
        }
    }
}

/// Largest difference of a size in a text from nominal that counts as equal.
const SAME: f64 = 1e-9;
/// From this value on a first number is a size and not a deviation, in any unit.
const LARGEST_DEVIATION: f64 = 1.0;

/// The limits that two signed numbers give for a nominal value, and whether the first number is that value. `-35-0.2` for −35 is a size with a deviation,
/// `+0.02-0.02` for 0 and `-0.1-0.2` for 25 are deviations. An error with both readings if both are possible.
fn of_two(text: &str, [first, second]: [f64; 2], nominal: f64) -> Result<([f64; 2], bool), Text> {
    let sized = [first + second.min(0.0), first + second.max(0.0)];
    let about = [nominal + first.min(second), nominal + first.max(second)];
    let is_size = (first - nominal).abs() < SAME && nominal != 0.0;
    let small = first.abs() < LARGEST_DEVIATION;
    if is_size && !small {
        return Ok((sized, true));
    }
    if !is_size && (small || (first - nominal).abs() >= first.abs()) {
        return Ok((about, false));
    }
    let [one, other] =
        [sized, about].map(|[low, high]| format!("{} … {}", decimal(low, 6), decimal(high, 6)));
    Err(text!(
        "\"{value}\" can be read in two ways, {one} and {other}: write the deviations with a slash, such as +0.02/-0.01, or both ends, such as 24.98..25.02",
        shown(text),
        one,
        other
    ))
}

/// Converts a size with a tolerance from the form of drawings to that of 1411: `10+0.021+0` for `10 +0.021/0`. Any other text is unchanged.
pub fn canonical(text: &str) -> String {
    let drawn = text.contains([' ', '/', '±', 'Ø', 'ø', '⌀', '\u{2212}']);
    match Zone::read(&tidied(text)) {
        Some(Zone::Off(Some(_), _)) if drawn => plain_of_result(text),
        _ => text.to_owned(),
    }
}

/// Smallest and largest value that a tolerance of a result allows, and whether the text contains the nominal value. A text that begins with a sign, a letter or
/// 0 gives deviations: `±0.02`, `+0.021/0`, `0 -0.02`, `+0.021 0`, `-0.1-0.2`, `H7`. A text that begins with a number contains the nominal value: `25H7`, `25
/// ±0.02`, `24.98..25.02`; so does a negative number with two deviations, or one that equals nominal: `-35 ±0.1`, `-35+0.1-0.2`, `-35 -0.2`. Two signed numbers
/// that can be read both ways are an error. `to_mm` is millimetres in the unit; `None` for values without classes.
pub fn of_result(text: &str, nominal: f64, to_mm: Option<f64>) -> Result<([f64; 2], bool), Text> {
    let wrong = || {
        text!(
            "\"{value}\" is no tolerance: the forms are {forms}",
            shown(text),
            RESULT_FORMS.to_owned()
        )
    };
    let plain = tidied(text);
    let (size, off) = match Zone::read(&plain).ok_or_else(wrong)? {
        Zone::Ends(ends) => return Ok((ends, true)),
        Zone::Off(size, off) => (
            size,
            off.of(size.unwrap_or(nominal), to_mm).ok_or_else(wrong)??,
        ),
        Zone::Either(both) => {
            let (limits, says) = of_two(text, both, nominal)?;
            return if limits[0] < limits[1] {
                Ok((limits, says))
            } else {
                Err(wrong())
            };
        }
    };
    let [low, high] = off;
    if low >= high {
        return Err(wrong());
    }
    let middle = size.unwrap_or(nominal);
    Ok(([middle + low, middle + high], size.is_some()))
}

/// The tolerance in characters that a comment of any control accepts, without blanks and with the numbers as written: `+0.02-0.02` for `±0.02`, `..` for `…`.
pub fn plain_of_result(text: &str) -> String {
    let plain = tidied(text).replace(',', ".");
    let (size, off) = match Zone::read(&plain) {
        Some(Zone::Off(Some(_), Deviations::Given(_))) => {
            plain.split_at(end_of_number(&plain).unwrap_or(0))
        }
        Some(Zone::Off(None, Deviations::Given(_))) => ("", plain.as_str()),
        _ => return plain.replace(' ', ""),
    };
    let off = off.trim();
    let signed = |text: &str| {
        if text.starts_with(['+', '-']) {
            text.to_owned()
        } else {
            format!("+{text}")
        }
    };
    let both = if let Some(off) = off.strip_prefix('±').or_else(|| off.strip_prefix("+/-")) {
        format!("+{off}-{off}", off = off.trim())
    } else if let Some((one, other)) = off.split_once('/').or_else(|| off.split_once(' ')) {
        format!("{}{}", signed(one.trim()), signed(other.trim()))
    } else if !size.is_empty() && end_of_number(off) == Some(off.len()) {
        // After a negative size a single deviation would be read as one of two.
        format!("+0{}", signed(off))
    } else {
        off.to_owned()
    };
    format!("{size}{both}")
}

/// Multiplies every length in the tolerance by `by`; any other text is unchanged.
pub fn convert_of_result(text: &str, by: impl Fn(f64) -> f64) -> String {
    if Zone::read(&tidied(text)).is_none() {
        return text.to_owned();
    }
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let digits = rest
            .find(|c: char| !(c.is_ascii_digit() || c == '.' || c == ','))
            .unwrap_or(rest.len());
        // Two points separate the ends of a range.
        let digits = rest[..digits].find("..").unwrap_or(digits);
        if digits == 0 || out.ends_with('.') && first == '.' {
            out.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        }
        // The grade of a class is not a length.
        match number(&rest[..digits]).filter(|_| !out.ends_with(|c: char| c.is_ascii_alphabetic()))
        {
            Some(x) => out.push_str(&decimal(by(x), 9)),
            None => out.push_str(&rest[..digits]),
        }
        rest = &rest[digits..];
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tolerance_of_a_result_is_about_its_nominal_value_or_says_one() {
        // ISO 286-2: H7 of 25 mm is +0.021/0, F8 +0.053/+0.020; ISO 2768-1 m of 25 mm is ±0.2.
        for (text, nominal, limits, says) in [
            ("H7", 25.0, [25.0, 25.021], false),
            ("H7 ", 25.0, [25.0, 25.021], false),
            ("F8", 25.0, [25.02, 25.053], false),
            ("m", 25.0, [24.8, 25.2], false),
            ("±0.02", -35.0, [-35.02, -34.98], false),
            ("± 0.02", 25.0, [24.98, 25.02], false),
            ("+/-0,02", 25.0, [24.98, 25.02], false),
            ("+0.021/0", 25.0, [25.0, 25.021], false),
            ("+0.021 / 0", 25.0, [25.0, 25.021], false),
            ("+0.03-0.01", 25.0, [24.99, 25.03], false),
            ("-0.2", 25.0, [24.8, 25.0], false),
            ("-0.1-0.2", 25.0, [24.8, 24.9], false),
            ("-0.1/-0.2", 25.0, [24.8, 24.9], false),
            ("25H7", 25.0105, [25.0, 25.021], true),
            ("Ø25 H7", 25.0, [25.0, 25.021], true),
            ("Ø25 ±0.02", 25.0, [24.98, 25.02], true),
            ("25 0 -0.02", 25.0, [24.98, 25.0], true),
            ("25 0/-0.02", 25.0, [24.98, 25.0], true),
            ("25 +0.021", 25.0, [25.0, 25.021], true),
            ("35 -0.2", 35.0, [34.8, 35.0], true),
            // Negative nominal values: a blank, two deviations, or equality with nominal make the number a size.
            ("-35 ±0.1", -35.0, [-35.1, -34.9], true),
            ("-35±0.1", -35.0, [-35.1, -34.9], true),
            ("-35+0.1-0.2", -35.0, [-35.2, -34.9], true),
            ("-35 -0.2", -35.0, [-35.2, -35.0], true),
            ("-35 +0.1", -35.0, [-35.0, -34.9], true),
            // Fits as drawings and their tables write them: zeros, blanks, slashes, one side.
            ("+0.02 -0.02", 0.0, [-0.02, 0.02], false),
            ("+0.02-0.02", 0.0, [-0.02, 0.02], false),
            ("+0.02 -0.02", 25.0, [24.98, 25.02], false),
            ("0 -0.02", 25.0, [24.98, 25.0], false),
            ("0 -0.02", 0.0, [-0.02, 0.0], false),
            ("0/-0.02", 25.0, [24.98, 25.0], false),
            ("0 +0.02", 25.0, [25.0, 25.02], false),
            ("+0.021 0", 25.0, [25.0, 25.021], false),
            ("-0.02 0", 25.0, [24.98, 25.0], false),
            ("-0.1 -0.2", 25.0, [24.8, 24.9], false),
            ("25 +0.021 0", 25.0, [25.0, 25.021], true),
            ("-35 0/-0.2", -35.0, [-35.2, -35.0], true),
            ("-35-0.2", -35.0, [-35.2, -35.0], true),
            ("24.98..25.02", 25.0, [24.98, 25.02], true),
            ("-0.02 … 0.02", 0.0, [-0.02, 0.02], true),
        ] {
            let (found, own) =
                of_result(text, nominal, Some(1.0)).unwrap_or_else(|e| panic!("{text}: {e}"));
            assert!(
                (0..2).all(|i| (found[i] - limits[i]).abs() < 1e-9),
                "{text}: {found:?}"
            );
            assert_eq!(own, says, "{text}");
        }
        for text in [
            "",
            "25",
            "0.02",
            "±",
            "H",
            "H 7",
            "2 5H7",
            "25H 7",
            "25..25",
            "25.02..24.98",
            "±0",
            "q7",
            "25H7x",
            "±-1",
            "..",
            "+",
            "0.1/0.2",
            "25 0.02",
            "25 1/2",
            "0/-0.1/2",
            "-",
            "1 2 3",
        ] {
            assert!(
                of_result(text, 25.0, Some(1.0)).is_err(),
                "{text}: {:?}",
                of_result(text, 25.0, Some(1.0))
            );
        }
        // Two readings: −34.9 … −34.7 for nominal −35.1 as a size, −70.1 … −35.3 as deviations; or a nominal value as small as a deviation.
        for (text, nominal) in [("-35 -0.2", -35.1), ("-0.1-0.2", -0.1), ("+0.5 -0.02", 0.5)] {
            let error = of_result(text, nominal, Some(1.0)).unwrap_err();
            assert!(
                error.english().contains("two ways"),
                "{text}: {}",
                error.english()
            );
        }
        // An angle has no classes.
        assert!(of_result("H7", 25.0, None).is_err());
        assert_eq!(of_result("±0.5", 90.0, None).unwrap().0, [89.5, 90.5]);
        let inch = of_result("H7", 1.0, Some(25.4)).unwrap().0;
        assert!((inch[1] - 1.0 - 0.021 / 25.4).abs() < 1e-12);
    }

    #[test]
    fn the_tolerance_of_a_result_in_plain_characters_is_the_same_zone() {
        for text in [
            "H7",
            "25 H7",
            "±0.02",
            "+/-0,02",
            "+0.021/0",
            "-0.1/-0.2",
            "+0.1/+0.2",
            "Ø25 ±0.02",
            "25+0.03/-0.01",
            "24,98 … 25.02",
            "25 0 -0.02",
            "-35 -0.2",
            "-35 +0.1",
            "-35 ± 0.1",
            "± 0.007874015748031498",
            "+0.007874015748031498/-0.0012345678912345",
        ] {
            let plain = plain_of_result(text);
            assert!(
                plain
                    .chars()
                    .all(|c| c.is_ascii_alphanumeric() || ".+-".contains(c)),
                "{plain}"
            );
            assert_eq!(
                of_result(&plain, 25.0, Some(1.0)),
                of_result(text, 25.0, Some(1.0)),
                "{text}: {plain}"
            );
            assert!(of_result(text, 25.0, Some(1.0)).is_ok(), "{text}");
        }
    }

    #[test]
    fn the_tolerance_of_a_result_in_other_units_is_the_same_zone() {
        for (text, doubled) in [
            ("25H7", "50H7"),
            ("±0.02", "±0.04"),
            ("+.5/-.25", "+1/-0.5"),
            ("24.98..25.02", "49.96..50.04"),
            ("-1…2,5", "-2…5"),
            ("js6", "js6"),
            ("what", "what"),
        ] {
            assert_eq!(convert_of_result(text, |x| 2.0 * x), doubled);
        }
    }
}
