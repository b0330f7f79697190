//! Nominal values of HEIDENHAIN's 14xx cycles: numbers, tolerances, unknown and given positions.
//!
//! The forms are recalled from the control's manuals, not read in print [R]: `10H7` (ISO 286), `10m` (ISO 2768-1), `10+0.01-0.015` (signed limits), `?` and
//! `?10` (semi-automatic), `10@10.02` (given). A missing limit is 0 [I].

mod iso286;
mod result;

use result::canonical;
pub use result::{RESULT_FORMS, convert_of_result, of_result, plain_of_result};

use crate::num::decimal;
use crate::text::{Text, text};
use iso286::{GRADES, HOLE_J, MAIN_BANDS, NONE, SHAFT_J, SHAFT_K, SHAFTS, SUB_BANDS};

/// Maximum length of a tolerance, or of a size with a tolerance, in characters.
pub const LONGEST: usize = 64;

/// Valid forms of a value, for messages.
pub const FORMS: &str = "10, 10H7, 10m, 10+0.01-0.015, +8-2-1, ?, ?10, 10@10.02";

/// A parsed value. Lengths are in the units of the text until [`Nominal::scaled`].
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Nominal {
    /// Nominal value; `None` for a bare `?`.
    pub nominal: Option<f64>,
    /// Lower and upper limit of the value itself (not of its deviation), if there is a tolerance.
    pub limits: Option<(f64, f64)>,
    /// Whether the position is unknown: semi-automatic.
    pub unknown: bool,
    /// Actual value, if it is given and not probed.
    pub actual: Option<f64>,
    /// Original text, with points for decimal commas; `None` for a plain number.
    pub text: Option<String>,
}

impl Nominal {
    /// A number without a tolerance.
    pub fn number(x: f64) -> Self {
        Nominal {
            nominal: Some(x),
            ..Nominal::default()
        }
    }

    /// Value from which deviations are counted: the middle of the tolerance, or nominal.
    pub fn reference(&self) -> Option<f64> {
        self.limits
            .map(|(low, high)| (low + high) / 2.0)
            .or(self.nominal)
    }

    /// Multiplies all lengths by a factor.
    pub fn scaled(mut self, factor: f64) -> Self {
        self.nominal = self.nominal.map(|x| x * factor);
        self.limits = self.limits.map(|(low, high)| (low * factor, high * factor));
        self.actual = self.actual.map(|x| x * factor);
        self
    }
}

/// Reads a value. `to_mm` is millimetres in its unit. The error says in plain words what is wrong.
pub fn parse(text: &str, to_mm: f64) -> Result<Nominal, Text> {
    // The given value after @ is a number.
    let (place, given) = text
        .trim()
        .split_once('@')
        .map_or((text.trim(), String::new()), |(left, right)| {
            (left, format!("@{right}"))
        });
    let whole = format!("{}{given}", canonical(place));
    let whole = whole.as_str();
    let wrong = || {
        text!(
            "\"{value}\" is not a value: the forms are {forms}",
            shown(whole),
            FORMS.to_owned()
        )
    };
    let mut value = Nominal {
        text: Some(whole.replace(',', ".")),
        ..Nominal::default()
    };
    let (rest, actual) = match whole.split_once('@') {
        Some((left, right)) => (left, Some(right)),
        None => (whole, None),
    };
    if let Some(actual) = actual {
        value.actual = Some(number(actual).ok_or_else(wrong)?);
    }
    let rest = match rest.strip_prefix('?') {
        Some(after) => {
            value.unknown = true;
            after
        }
        None => rest,
    };
    if value.unknown && (value.actual.is_some() || rest.is_empty()) {
        return if value.actual.is_some() {
            Err(wrong())
        } else {
            Ok(value)
        };
    }
    let split = end_of_number(rest).ok_or_else(wrong)?;
    let nominal = number(&rest[..split]).ok_or_else(wrong)?;
    value.nominal = Some(nominal);
    let tolerance = &rest[split..];
    if tolerance.is_empty() {
        if actual.is_none() && !value.unknown {
            value.text = None;
        }
        return Ok(value);
    }
    let (low, high) = if tolerance.starts_with(['+', '-']) {
        signed(tolerance).ok_or_else(wrong)?
    } else {
        let (low, high) = standard(tolerance, nominal * to_mm)
            .map_err(|why| text!("\"{value}\": {why}", shown(whole), why))?;
        (low / to_mm, high / to_mm)
    };
    value.limits = Some((nominal + low, nominal + high));
    Ok(value)
}

/// The nominal size of a text that reads as a size with a tolerance, also as drawings write it: `25H7`, `25 h6`, `25+0.021`, `25 ±0.02`, `25 +0,021/0`.
/// `None` for any other text, such as a number, a fraction or a sum: `25+1` is a sum, `25 ±1` is not.
pub fn toleranced(text: &str) -> Option<f64> {
    let plain = text
        .trim()
        .trim_start_matches(['Ø', 'ø', '⌀'])
        .trim_start()
        .replace('\u{2212}', "-");
    let end = end_of_number(&plain)?;
    let nominal = number(&plain[..end])?;
    let rest = plain[end..].trim();
    // `40x6` is a fit, `40x2` a product.
    if let Some(Ok(grade)) = rest
        .strip_prefix(['x', 'X'])
        .map(|of| of.trim().parse::<u32>())
        && !(4..=18).contains(&grade)
    {
        return None;
    }
    let signs = |c: char| "+-±/() ".contains(c);
    // These cannot be sums: `±1`, `+1/-0.5`, `+1 0`.
    let drawn = rest.contains(['±', '/', ' ']) && result::are_deviations(rest);
    let deviations = || {
        let mut terms = rest.split(signs).filter(|term| !term.is_empty()).peekable();
        // `1/0` is a fraction.
        rest.contains(signs)
            && !rest.starts_with('/')
            && terms.peek().is_some()
            && terms.all(|term| number(term).is_some_and(|x| x < 1.0))
    };
    (is_class(rest) || drawn || deviations()).then_some(nominal)
}

/// Nominal, smallest and largest size of a text with a tolerance, in the units of the text. `to_mm` is millimetres per unit; `None` for an angle, which has no
/// classes. `None` if the text contains no tolerance.
pub fn size(text: &str, to_mm: Option<f64>) -> Option<Result<(f64, [f64; 2]), Text>> {
    let nominal = toleranced(text)?;
    let limits = of_result(text, nominal, to_mm).map(|(limits, _)| limits);
    Some(limits.and_then(|limits| {
        if to_mm.is_some() && limits[0] <= 0.0 {
            return Err(text!("\"{value}\" allows a size of 0 or less", shown(text)));
        }
        Ok((nominal, limits))
    }))
}

/// Multiplies every length of a size with a tolerance by `by`. Separates the deviations if the result would otherwise be a sum, such as `50.8+1.27`.
pub fn convert_size(text: &str, by: impl Fn(f64) -> f64) -> String {
    let converted = convert_of_result(text, by);
    if toleranced(&converted).is_some() {
        return converted;
    }
    let signs: Vec<usize> = converted
        .match_indices(['+', '-'])
        .map(|(at, _)| at)
        .collect();
    match signs[..] {
        [one] => {
            let (size, off) = converted.split_at(one);
            format!("{} {off}/0", size.trim_end())
        }
        [one, other] => {
            let (size, off) = converted.split_at(one);
            let (first, second) = off.split_at(other - one);
            format!("{} {}/{second}", size.trim_end(), first.trim_end())
        }
        _ => converted,
    }
}

/// The tolerance class in a size: `H7` in `25 H7`.
pub fn class_of(text: &str) -> Option<&str> {
    let class = text
        .trim_start_matches(|c: char| !c.is_ascii_alphabetic())
        .trim_end();
    (toleranced(text).is_some() && is_class(class) && !class.contains('/')).then_some(class)
}

/// Whether a text is one or two letters and one or two digits, such as `H7`, by itself or before a slash as in `H7/g6`.
fn is_class(text: &str) -> bool {
    let class = text.split('/').next().unwrap_or(text).trim();
    let letters = class.bytes().take_while(u8::is_ascii_alphabetic).count();
    let grade = &class[letters..];
    (1..=2).contains(&letters)
        && (1..=2).contains(&grade.len())
        && grade.bytes().all(|b| b.is_ascii_digit())
}

/// Multiplies every length in the value by `by`; `None` for an invalid text. Letters and signs stay.
pub fn convert(text: &str, by: impl Fn(f64) -> f64) -> Option<String> {
    // Only the form of the text matters here, not whether the class exists for its size.
    let text = &canonical(text);
    let mut rest = text.trim();
    let mut out = String::new();
    let digit = |text: &str| text.starts_with(|c: char| c.is_ascii_digit() || c == '.' || c == ',');
    while let Some(first) = rest.chars().next() {
        // The grade of a class is not a length.
        if first.is_ascii_alphabetic() {
            let end = rest
                .find(|c: char| !c.is_ascii_alphanumeric())
                .unwrap_or(rest.len());
            out.push_str(&rest[..end]);
            rest = &rest[end..];
        } else if digit(rest) || (matches!(first, '+' | '-') && digit(&rest[1..])) {
            let end = end_of_number(rest)?;
            let converted = decimal(by(number(&rest[..end])?), 9);
            if first == '+' && !converted.starts_with('-') {
                out.push('+');
            }
            // A deviation that becomes 0 keeps its sign.
            if first == '-' && !converted.starts_with('-') {
                out.push('-');
            }
            out.push_str(&converted);
            rest = &rest[end..];
        } else if matches!(first, '?' | '@') {
            out.push(first);
            rest = &rest[1..];
        } else {
            return None;
        }
    }
    let has_form = out == "?" || out.contains(|c: char| c.is_ascii_digit());
    let starts_well = !text.trim().starts_with(|c: char| c.is_ascii_alphabetic());
    (has_form && starts_well).then_some(out)
}

/// One or two signed deviations; a missing one is 0.
fn signed(text: &str) -> Option<(f64, f64)> {
    let split = end_of_number(text)?;
    let first = number(&text[..split])?;
    let second = match &text[split..] {
        "" => 0.0,
        rest if rest.starts_with(['+', '-']) => number(rest)?,
        _ => return None,
    };
    Some((first.min(second), first.max(second)))
}

/// Lower and upper deviation in mm of a letter class.
fn standard(text: &str, nominal: f64) -> Result<(f64, f64), Text> {
    let letters = text.len()
        - text
            .trim_start_matches(|c: char| c.is_ascii_alphabetic())
            .len();
    let (class, grade) = text.split_at(letters);
    if grade.is_empty() && ["f", "m", "c", "v"].contains(&class) {
        return general(class, nominal.abs());
    }
    if class.is_empty() || grade.is_empty() || !grade.bytes().all(|b| b.is_ascii_digit()) {
        return Err(text!(
            "\"{text}\" is neither an ISO 286 class such as H7 nor an ISO 2768 letter f, m, c, v",
            shown(text)
        ));
    }
    iso_286(class, grade, nominal)
}

/// Sizes that exceed the end of a band by less count as the end itself, mm: 10 mm are 0.393701 inch, which are 10.0000054 mm.
const AT_BAND_END: f64 = 2e-5;

/// ISO 2768-1, linear sizes.
fn general(class: &str, size: f64) -> Result<(f64, f64), Text> {
    const BANDS: [f64; 8] = [3.0, 6.0, 30.0, 120.0, 400.0, 1000.0, 2000.0, 4000.0];
    const NO: f64 = f64::NAN;
    let row = match class {
        "f" => [0.05, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, NO],
        "m" => [0.1, 0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 2.0],
        "c" => [0.2, 0.3, 0.5, 0.8, 1.2, 2.0, 3.0, 4.0],
        _ => [NO, 0.5, 1.0, 1.5, 2.5, 4.0, 6.0, 8.0],
    };
    let band = BANDS
        .iter()
        .position(|upper| size <= *upper + AT_BAND_END)
        .filter(|_| size >= 0.5 - AT_BAND_END);
    match band.map(|b| row[b]).filter(|t| t.is_finite()) {
        Some(t) => Ok((-t, t)),
        None => Err(text!(
            "ISO 2768-1 gives no {class} for a size of {size} mm",
            class.to_owned(),
            decimal(size, 4)
        )),
    }
}

/// The grade; IT01 is −1. IT01 and IT0 exist only for H, h, JS and js.
fn grade_of(class: &str, text: &str) -> Option<i32> {
    let grade = match text {
        "01" => -1,
        "0" => 0,
        g if g.starts_with('0') => return None,
        g => g.parse::<i32>().ok().filter(|g| (1..=18).contains(g))?,
    };
    (grade >= 1 || matches!(class, "H" | "h" | "JS" | "js")).then_some(grade)
}

/// ISO 286-1: lower and upper deviation in mm of a class for a size in mm. Capital letters are holes.
fn iso_286(class: &str, grade_text: &str, size: f64) -> Result<(f64, f64), Text> {
    let unknown = || {
        text!(
            "ISO 286 has no {class}{grade_text} for a size of {size} mm",
            class.to_owned(),
            grade_text.to_owned(),
            decimal(size, 4)
        )
    };
    let grade = grade_of(class, grade_text).ok_or_else(unknown)?;
    if !(size > 0.0 && size <= 500.0 + AT_BAND_END) {
        return Err(text!(
            "ISO 286 tolerances are supported for sizes above 0 up to 500 mm, not for {size} mm",
            decimal(size, 4)
        ));
    }
    let main = MAIN_BANDS
        .iter()
        .position(|upper| size <= f64::from(*upper) + AT_BAND_END)
        .expect("the last band ends at 500");
    let sub = SUB_BANDS
        .iter()
        .position(|upper| size <= f64::from(*upper) + AT_BAND_END)
        .expect("the last band ends at 500");
    let it = |grade: i32| f64::from(GRADES[(grade + 1) as usize][main]) / 10.0;
    let width = it(grade);
    let hole = class.starts_with(|c: char| c.is_ascii_uppercase());
    let lower = class.to_ascii_lowercase();
    if class != lower && class != class.to_ascii_uppercase() {
        return Err(unknown());
    }
    let given = |value: i16| {
        if value == NONE {
            Err(unknown())
        } else {
            Ok(f64::from(value))
        }
    };
    let table = |rows: &[(i32, [i16; 25])]| match rows.iter().find(|(g, _)| *g == grade) {
        Some((_, row)) => given(row[sub]),
        None => Err(unknown()),
    };
    let shaft = |letter: &str| match letter {
        "k" if (4..=7).contains(&grade) => given(SHAFT_K[sub]),
        "k" => Ok(0.0),
        _ => SHAFTS
            .iter()
            .find(|(l, _)| *l == letter)
            .map_or_else(|| Err(unknown()), |(_, row)| given(row[sub])),
    };
    let early = matches!(
        lower.as_str(),
        "a" | "b" | "c" | "cd" | "d" | "e" | "ef" | "f" | "fg" | "g"
    );
    let above = |low: f64| (low, low + width);
    let below = |high: f64| (high - width, high);
    // Micrometres: lower and upper deviation.
    let (low, high) = match (lower.as_str(), hole) {
        ("js", _) => (-width / 2.0, width / 2.0),
        ("h", true) => (0.0, width),
        ("h", false) => (-width, 0.0),
        ("j", true) => below(table(&HOLE_J)?),
        ("j", false) => above(table(&SHAFT_J)?),
        (letter, true) if early => above(-shaft(letter)?),
        (letter, false) if early => below(shaft(letter)?),
        // The hole K has one ei for every grade up to 8, and above that it is not defined over 3 mm.
        ("k", true) if grade > 8 && size > 3.0 + AT_BAND_END => return Err(unknown()),
        ("k", true) => below(hole_upper(
            "k",
            grade,
            size,
            given(SHAFT_K[sub])?,
            width - it(grade - 1),
        )),
        (letter, true) => below(hole_upper(
            letter,
            grade,
            size,
            shaft(letter)?,
            width - it(grade - 1),
        )),
        (letter, false) => above(shaft(letter)?),
    };
    Ok((low / 1000.0, high / 1000.0))
}

/// ES of the holes K … ZC from the shaft's ei, micrometres; `delta` is IT(n) − IT(n − 1).
fn hole_upper(letter: &str, grade: i32, size: f64, shaft: f64, delta: f64) -> f64 {
    let middle = matches!(letter, "k" | "m" | "n");
    let over = |end: f64| size > end + AT_BAND_END;
    if letter == "m" && grade == 6 && over(250.0) && !over(315.0) {
        return -9.0;
    }
    if letter == "n" && grade > 8 && over(3.0) {
        return 0.0;
    }
    let finest = if middle { 8 } else { 7 };
    if over(3.0) && grade <= finest {
        -shaft + delta
    } else {
        -shaft
    }
}

/// A plain decimal number, sign allowed, no exponent.
fn number(text: &str) -> Option<f64> {
    let plain = text.replace(',', ".");
    let digits = plain.trim_start_matches(['+', '-']);
    let good = plain.len() - digits.len() <= 1
        && digits.bytes().all(|b| b.is_ascii_digit() || b == b'.')
        && digits.bytes().any(|b| b.is_ascii_digit())
        && digits.len() <= 20;
    good.then(|| crate::num::read(&plain))
        .flatten()
        .filter(|x| x.abs() <= 100_000.0)
}

/// End of the number at the start of a text; `None` if the text does not start with one.
fn end_of_number(text: &str) -> Option<usize> {
    let sign = usize::from(text.starts_with(['+', '-']));
    let length = text[sign..]
        .bytes()
        .take_while(|b| b.is_ascii_digit() || matches!(b, b'.' | b','))
        .count();
    (length > 0).then_some(sign + length)
}

fn shown(text: &str) -> String {
    text.chars()
        .take(30)
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits(text: &str) -> (f64, f64) {
        let value = parse(text, 1.0).unwrap_or_else(|e| panic!("{e}"));
        let (low, high) = value.limits.unwrap();
        let nominal = value.nominal.unwrap();
        (
            ((low - nominal) * 1000.0 * 1e6).round() / 1e6,
            ((high - nominal) * 1000.0 * 1e6).round() / 1e6,
        )
    }

    /// Limit deviations in micrometres as printed in handbooks' tables of ISO 286-2.
    #[test]
    fn printed_values_of_iso_286() {
        for (class, low, high) in [
            ("10H7", 0.0, 15.0),
            ("25H7", 0.0, 21.0),
            ("50H7", 0.0, 25.0),
            ("100H8", 0.0, 54.0),
            ("18H6", 0.0, 11.0),
            ("25h6", -13.0, 0.0),
            ("50h7", -25.0, 0.0),
            ("100h9", -87.0, 0.0),
            ("25g6", -20.0, -7.0),
            ("50g6", -25.0, -9.0),
            ("25f7", -41.0, -20.0),
            ("40f8", -64.0, -25.0),
            ("25F8", 20.0, 53.0),
            ("25G7", 7.0, 28.0),
            ("25e8", -73.0, -40.0),
            ("30d9", -117.0, -65.0),
            ("30D10", 65.0, 149.0),
            ("25js6", -6.5, 6.5),
            ("25JS7", -10.5, 10.5),
            ("25j6", -4.0, 9.0),
            ("25J7", -9.0, 12.0),
            ("25k6", 2.0, 15.0),
            ("50k6", 2.0, 18.0),
            ("25K7", -15.0, 6.0),
            ("25K8", -23.0, 10.0),
            ("25K6", -11.0, 2.0),
            ("25M8", -29.0, 4.0),
            ("25N8", -36.0, -3.0),
            ("50K7", -18.0, 7.0),
            ("25m6", 8.0, 21.0),
            ("25M7", -21.0, 0.0),
            ("50M7", -25.0, 0.0),
            ("25n6", 15.0, 28.0),
            ("25N7", -28.0, -7.0),
            ("25N9", -52.0, 0.0),
            ("25p6", 22.0, 35.0),
            ("25P7", -35.0, -14.0),
            ("50P7", -42.0, -17.0),
            ("25P9", -74.0, -22.0),
            ("25r6", 28.0, 41.0),
            ("25R7", -41.0, -20.0),
            ("25s6", 35.0, 48.0),
            ("25S7", -48.0, -27.0),
            ("50s6", 43.0, 59.0),
            ("80s6", 59.0, 78.0),
            ("25u6", 48.0, 61.0),
            ("300M6", -41.0, -9.0),
            ("3H7", 0.0, 10.0),
            ("3K7", -10.0, 0.0),
            ("3N7", -14.0, -4.0),
            ("3P7", -16.0, -6.0),
            ("10.5H7", 0.0, 18.0),
        ] {
            assert_eq!(limits(class), (low, high), "{class}");
        }
    }

    /// Checks every class of every letter, grade and band against the standard's own rules, if the tables have it.
    #[test]
    fn classes_keep_the_rules() {
        let letters = [
            "a", "b", "c", "cd", "d", "e", "ef", "f", "fg", "g", "h", "js", "j", "k", "m", "n",
            "p", "r", "s", "t", "u", "v", "x", "y", "z", "za", "zb", "zc",
        ];
        let mut classes = 0;
        for size in [
            1.0, 2.5, 3.0, 5.0, 6.0, 9.0, 12.0, 17.0, 22.0, 28.0, 35.0, 45.0, 60.0, 75.0, 90.0,
            110.0, 130.0, 150.0, 170.0, 190.0, 210.0, 240.0, 260.0, 300.0, 330.0, 380.0, 420.0,
            480.0, 500.0,
        ] {
            for grade in 1..=18 {
                let width = limits(&format!("{size}h{grade}")).0.abs();
                assert!(width > 0.0);
                for letter in letters {
                    let small = parse(&format!("{size}{letter}{grade}"), 1.0);
                    let capital = parse(
                        &format!("{size}{}{grade}", letter.to_ascii_uppercase()),
                        1.0,
                    );
                    for class in [&small, &capital].into_iter().flatten() {
                        let (low, high) = class.limits.unwrap();
                        assert!(
                            ((high - low) * 1000.0 - width).abs() < 1e-6,
                            "{class:?} is as wide as its grade"
                        );
                        classes += 1;
                    }
                    let (Ok(small), Ok(capital)) = (small, capital) else {
                        continue;
                    };
                    let (s, c) = (small.limits.unwrap(), capital.limits.unwrap());
                    // A … H mirror their shafts; so do coarse or small K … ZC.
                    let mirrored = letters.iter().position(|l| *l == letter) < Some(11)
                        || (size <= 3.0 && letter != "j");
                    if mirrored {
                        assert!(
                            (s.0 + c.1 - 2.0 * size).abs() < 1e-9
                                && (s.1 + c.0 - 2.0 * size).abs() < 1e-9,
                            "{small:?} {capital:?}"
                        );
                    }
                }
            }
        }
        assert!(classes > 1480, "{classes} classes");
    }

    #[test]
    fn iso_2768_and_signed_limits() {
        assert_eq!(limits("10m"), (-200.0, 200.0));
        assert_eq!(limits("3f"), (-50.0, 50.0));
        assert_eq!(limits("120c"), (-800.0, 800.0));
        assert_eq!(limits("121v"), (-2500.0, 2500.0));
        assert_eq!(limits("-10m"), (-200.0, 200.0));
        assert_eq!(limits("10+0.01-0.015"), (-15.0, 10.0));
        assert_eq!(limits("10-0.015+0.01"), (-15.0, 10.0));
        assert_eq!(limits("+8-2-1"), (-2000.0, -1000.0));
        assert_eq!(limits("10-0.2"), (-200.0, 0.0));
        assert_eq!(limits("10+0,2"), (0.0, 200.0));
        // Forms on drawings; the value for the control has the control's form.
        for (text, low, high, written) in [
            ("10 +0.021/0", 0.0, 21.0, "10+0.021+0"),
            ("10 0 -0.02", -20.0, 0.0, "10+0-0.02"),
            ("Ø10 ±0,05", -50.0, 50.0, "10+0.05-0.05"),
            ("10 H7", 0.0, 15.0, "10H7"),
        ] {
            assert_eq!(limits(text), (low, high), "{text}");
            assert_eq!(
                parse(text, 1.0).unwrap().text.as_deref(),
                Some(written),
                "{text}"
            );
            assert_eq!(
                convert(text, |x| 2.0 * x),
                convert(written, |x| 2.0 * x),
                "{text}"
            );
        }
    }

    #[test]
    fn a_tolerance_as_drawings_write_it_is_a_zone() {
        // ISO 286-2: H7 of 18 to 30 mm is +0.021/0, h6 of the same 0/-0.013, H7 of 0.9842 inch that of 25 mm.
        let near = |text: &str, to_mm: f64, [low, high]: [f64; 2]| {
            let (_, zone) = size(text, Some(to_mm)).unwrap().unwrap();
            assert!(
                (zone[0] - low).abs() < 1e-6 && (zone[1] - high).abs() < 1e-6,
                "{text}: {zone:?}"
            );
        };
        near("25H7", 1.0, [25.0, 25.021]);
        near("Ø25 h6", 1.0, [24.987, 25.0]);
        near("25 ±0,02", 1.0, [24.98, 25.02]);
        near("25+0.021", 1.0, [25.0, 25.021]);
        near("25 +0,021/0", 1.0, [25.0, 25.021]);
        near("1H7", 25.4, [1.0, 1.0 + 0.021 / 25.4]);
        near("25 0 -0.02", 1.0, [24.98, 25.0]);
        near("25 +0.021 0", 1.0, [25.0, 25.021]);
        near("25-0.02", 1.0, [24.98, 25.0]);
        // If a sum is excluded, a deviation may have any size.
        near("25 ±1", 1.0, [24.0, 26.0]);
        near("100 +1 0", 1.0, [100.0, 101.0]);
        near("100 +1/-2", 1.0, [98.0, 101.0]);
        near("100+/-3", 1.0, [97.0, 103.0]);
        for sum in ["25", "25+1", "25+1-0.5", "25 + 1 - 2", "25+1/2", "1 1/2"] {
            assert_eq!(size(sum, Some(1.0)), None, "{sum}");
        }
        for wrong in ["25Q99", "25 0.02 -0.01", "0.4 ±0.5"] {
            assert!(size(wrong, Some(1.0)).unwrap().is_err(), "{wrong}");
        }
        for (text, class) in [
            ("25 H7", Some("H7")),
            ("Ø25H7", Some("H7")),
            ("25 ±0.02", None),
        ] {
            assert_eq!(class_of(text), class, "{text}");
        }
    }

    /// 0.05 inch are 1.27 mm: `50.8+1.27` would be a sum.
    #[test]
    fn a_size_with_a_tolerance_stays_one_in_other_units() {
        for (inch, mm) in [
            ("2 ±0.05", "50.8 ±1.27"),
            ("2+0.05", "50.8 +1.27/0"),
            ("2 -0.05", "50.8 -1.27/0"),
            ("2+0.05-0.1", "50.8 +1.27/-2.54"),
            ("2 +0.05 0", "50.8 +1.27 0"),
            ("1+0.002", "25.4+0.0508"),
            ("1 H7", "25.4 H7"),
        ] {
            assert_eq!(convert_size(inch, |x| x * 25.4), mm);
            let zone = |text: &str, to_mm| size(text, Some(to_mm)).unwrap().unwrap().1;
            let [here, there] = [zone(inch, 25.4), zone(mm, 1.0)];
            assert!(
                (0..2).all(|i| (here[i] * 25.4 - there[i]).abs() < 1e-9),
                "{inch}: {here:?} {there:?}"
            );
        }
    }

    /// Middles of tolerances, as the reference prints them.
    #[test]
    fn deviations_count_from_the_middle_of_the_zone() {
        for (text, middle) in [
            ("10H7", 10.0075),
            ("10m", 10.0),
            ("10+0.01-0.015", 9.9975),
            ("+8-2-1", 6.5),
            ("10", 10.0),
        ] {
            assert!(
                (parse(text, 1.0).unwrap().reference().unwrap() - middle).abs() < 1e-12,
                "{text}"
            );
        }
    }

    #[test]
    fn unknown_and_given_places() {
        assert_eq!(
            parse("?", 1.0).unwrap(),
            Nominal {
                unknown: true,
                text: Some("?".into()),
                ..Nominal::default()
            }
        );
        let near = parse("?10", 1.0).unwrap();
        assert_eq!((near.nominal, near.unknown), (Some(10.0), true));
        let given = parse("10+0.02@10.0123", 1.0).unwrap();
        assert_eq!((given.nominal, given.actual), (Some(10.0), Some(10.0123)));
        assert_eq!(parse("-4.5", 1.0).unwrap(), Nominal::number(-4.5));
        assert_eq!(parse("-4,5@-4.6", 1.0).unwrap().actual, Some(-4.6));
    }

    #[test]
    fn what_is_no_value_is_refused_with_the_forms() {
        for text in [
            "",
            "10H",
            "10H99",
            "10H07",
            "?x",
            "10@",
            "@10",
            "?@1",
            "10h",
            "25K9",
            "25Y0",
            "25T0",
            "25P01",
            "10hh7",
            "10Hh7",
            "10+",
            "10+0.1+",
            "10+0.1-0.2-0.3",
            "10H7x",
            "x",
            "10M",
            "--1",
            "1.2.3",
            "600H7",
            "0H7",
            "0m",
            "1000000",
            "10w",
            "2v",
        ] {
            let error = parse(text, 1.0).expect_err(text);
            assert!(!error.english().is_empty());
        }
        assert!(parse("10H", 1.0).unwrap_err().english().contains("H7"));
        assert!(parse("?x", 1.0).unwrap_err().english().contains("?10"));
    }

    #[test]
    fn inches_take_the_class_of_their_size_in_mm() {
        // 1 inch is 25.4 mm: H7 is 21 µm.
        let value = parse("1H7", 25.4).unwrap();
        assert!((value.limits.unwrap().1 - (1.0 + 0.021 / 25.4)).abs() < 1e-12);
    }
}
