//! Decimal numbers as controls write them, and tidy numbers for people.

mod read;
mod whole;

pub use read::{read, read_digits};

use std::ops::Deref;

use whole::Whole;

/// A number with at most `places` decimals: rounded, trailing zeros dropped, never an exponent, never `-0`.
///
/// `decimal(12.5, 4)` is `12.5`, `decimal(-0.00001, 4)` is `0`. The value must be finite.
pub fn decimal(value: f64, places: usize) -> String {
    let mut text = String::new();
    push_decimal(&mut text, value, places);
    text
}

/// Appends a number as [`decimal`] formats it.
pub fn push_decimal(text: &mut String, value: f64, places: usize) {
    text.push_str(&Digits::of(value, places));
}

/// A formatted number: [`decimal`] without an allocation, since a program has thousands of numbers.
#[derive(Clone, Debug)]
pub enum Digits {
    /// Almost every number: the last `len` bytes.
    Short {
        /// ASCII.
        bytes: [u8; Digits::MOST],
        /// Number of used bytes, counted from the end.
        len: u8,
    },
    /// A number that is too long, or that only exact arithmetic rounds correctly.
    Long(Box<str>),
}

impl Digits {
    /// A sign, a zero before the point, twenty-two decimals, and some spare bytes.
    const MOST: usize = 28;

    /// Empty: no number yet.
    pub const NONE: Digits = Digits::Short {
        bytes: [0; Digits::MOST],
        len: 0,
    };

    /// A number with at most `places` decimals: see [`decimal`].
    pub fn of(value: f64, places: usize) -> Self {
        debug_assert!(value.is_finite(), "only checked numbers are written");
        match whole(value, places) {
            Some(whole) => Digits::of_whole(value < 0.0 && whole != 0, whole, places),
            None => Digits::Long(exactly(value, places).into()),
        }
    }

    /// Appends a point to a number that has none.
    pub fn pointed(self) -> Self {
        if self.contains('.') {
            return self;
        }
        match self {
            Digits::Short { mut bytes, len } => {
                bytes.rotate_left(1);
                bytes[Digits::MOST - 1] = b'.';
                Digits::Short {
                    bytes,
                    len: len + 1,
                }
            }
            Digits::Long(text) => Digits::Long(format!("{text}.").into()),
        }
    }

    fn bytes(&self) -> &[u8] {
        match self {
            Digits::Short { bytes, len } => &bytes[Digits::MOST - usize::from(*len)..],
            Digits::Long(text) => text.as_bytes(),
        }
    }

    fn of_whole(negative: bool, mut whole: u64, mut places: usize) -> Self {
        while places > 0 && whole.is_multiple_of(10) {
            (whole, places) = (whole / 10, places - 1);
        }
        // From the last digit on.
        let mut bytes = [0u8; Digits::MOST];
        let mut at = bytes.len();
        let mut written = 0;
        while whole > 0 || written <= places {
            if written == places && places > 0 {
                at -= 1;
                bytes[at] = b'.';
            }
            at -= 1;
            bytes[at] = b'0' + (whole % 10) as u8;
            whole /= 10;
            written += 1;
        }
        if negative {
            at -= 1;
            bytes[at] = b'-';
        }
        Digits::Short {
            bytes,
            len: (Digits::MOST - at) as u8,
        }
    }
}

/// Compares the texts, however they are stored: near a tie the text is [`Digits::Long`].
impl PartialEq for Digits {
    fn eq(&self, other: &Self) -> bool {
        self.bytes() == other.bytes()
    }
}

impl Deref for Digits {
    type Target = str;

    fn deref(&self) -> &str {
        match self {
            Digits::Short { .. } => std::str::from_utf8(self.bytes()).unwrap_or_default(),
            Digits::Long(text) => text,
        }
    }
}

impl std::fmt::Display for Digits {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self)
    }
}

/// Appends a whole number to a text; most of them are small.
pub fn push_count(text: &mut String, number: usize) {
    match number {
        0..10 => text.push((b'0' + number as u8) as char),
        10..100 => {
            text.push((b'0' + (number / 10) as u8) as char);
            text.push((b'0' + (number % 10) as u8) as char);
        }
        _ => text.push_str(&format_count(number)),
    }
}

/// A whole number as text.
pub fn format_count(number: usize) -> Digits {
    Digits::of_whole(false, number as u64, 0)
}

/// Exact powers of ten.
const POWERS: [f64; 23] = [
    1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Absolute value in units of the last decimal, rounded; `None` if the rounding of the product could decide between two values.
fn whole(value: f64, places: usize) -> Option<u64> {
    let scaled = value.abs() * POWERS.get(places)?;
    // The error of the product is at most half of its last binary digit: a relative 1.2e-16.
    let unsure = 5e-16 * scaled + 1e-12;
    // Ties are unsure, so both kinds of rounding agree: this one is a single instruction of WebAssembly.
    let rounded = scaled.round_ties_even();
    (scaled < 1e15 && 0.5 - (scaled - rounded).abs() > unsure).then_some(rounded as u64)
}

/// Appends a number with as few digits as read back as the same number; very large and very small ones with an exponent, as `{:?}` formats them.
pub fn push_in_full(text: &mut String, value: f64) {
    push_shortest(text, value, true);
}

/// A number without exponent and with as few digits as read back, as `{}` formats it.
pub fn in_full(value: f64) -> String {
    let mut text = String::new();
    push_shortest(&mut text, value, false);
    text
}

fn push_shortest(text: &mut String, value: f64, exponents: bool) {
    if !value.is_finite() {
        return text.push_str(not_finite(value));
    }
    let size = value.abs();
    let usual = size == 0.0 || (1e-4..1e16).contains(&size);
    // Numbers typed by people have few decimals.
    if usual && size < 1e9 {
        let few = (0..7)
            .map(|places| Digits::of(value, places))
            .find(|digits| read(digits) == Some(value));
        if let Some(digits) = few {
            return text.push_str(&digits);
        }
    }
    text.push_str(if value < 0.0 { "-" } else { "" });
    // All its digits: those of a value below one come after the point.
    let places = if usual {
        60
    } else {
        340 * usize::from(size < 1.0)
    };
    let digits = scaled(size, places).digits();
    // Position of the first digit.
    let power = digits.len() as i32 - 1 - places as i32;
    let short = |(count, up): (usize, bool)| {
        let rounded = rounded(&digits, count, up);
        let power = power + (rounded.len() - count) as i32;
        placed(rounded.trim_end_matches('0'), power, usual || !exponents)
    };
    // Above a power of two the next number is twice as far as below it: then the digits above may read back, and the nearer ones below not.
    let tries = (1..18).flat_map(|count| [(count, false), (count, true)]);
    text.push_str(
        &tries
            .map(short)
            .find(|text| read(text) == Some(size))
            .unwrap_or_default(),
    );
}

/// Digits with the first at a power of ten: with a point, or with an exponent.
fn placed(digits: &str, power: i32, plain: bool) -> String {
    let (first, rest) = digits.split_at(1);
    let whole = power.max(0) as usize + 1;
    match (plain, power) {
        (false, _) if rest.is_empty() => format!("{first}e{power}"),
        (false, _) => format!("{first}.{rest}e{power}"),
        (true, ..0) => format!(
            "0.{digits:0>width$}",
            width = digits.len() - 1 + power.unsigned_abs() as usize
        ),
        (true, _) if digits.len() <= whole => format!("{digits:0<whole$}"),
        (true, _) => format!("{}.{}", &digits[..whole], &digits[whole..]),
    }
}

/// The first digits of a number, rounded half up or always up; one more digit after a carry.
fn rounded(digits: &str, count: usize, up: bool) -> String {
    let mut first: Vec<u8> = digits
        .bytes()
        .chain(std::iter::repeat(b'0'))
        .take(count)
        .collect();
    if up
        || digits
            .as_bytes()
            .get(count)
            .is_some_and(|next| *next >= b'5')
    {
        let nines = first.iter().rev().take_while(|b| **b == b'9').count();
        first.iter_mut().rev().take(nines).for_each(|b| *b = b'0');
        match count.checked_sub(nines + 1) {
            Some(last) => first[last] += 1,
            None => first.insert(0, b'1'),
        }
    }
    first.into_iter().map(char::from).collect()
}

/// A non-negative number times a power of ten, as the nearest integer; ties to even.
fn scaled(value: f64, power: usize) -> Whole {
    let bits = value.to_bits();
    let (exponent, fraction) = ((bits >> 52) as i32, bits & ((1 << 52) - 1));
    let (mantissa, exponent) = if exponent == 0 {
        (fraction, -1074)
    } else {
        (fraction | 1 << 52, exponent - 1075)
    };
    let mut whole = Whole::of(mantissa, exponent.max(0) as usize);
    (0..power).for_each(|_| whole.times_and(10, 0));
    whole.without((-exponent).max(0) as usize)
}

/// Text of a value that is not finite: never a number in its place.
fn not_finite(value: f64) -> &'static str {
    if value.is_nan() {
        return "NaN";
    }
    if value > 0.0 { "inf" } else { "-inf" }
}

/// Formats with big integers, which round the exact value.
fn exactly(value: f64, places: usize) -> String {
    if !value.is_finite() {
        return not_finite(value).to_owned();
    }
    let digits = scaled(value.abs(), places).digits();
    let negative = value < 0.0 && !digits.is_empty();
    let digits = format!("{digits:0>width$}", width = places + 1);
    let (whole, fraction) = digits.split_at(digits.len() - places);
    let fraction = fraction.trim_end_matches('0');
    let (sign, point) = (
        if negative { "-" } else { "" },
        if fraction.is_empty() { "" } else { "." },
    );
    format!("{sign}{whole}{point}{fraction}")
}

/// The number without floating-point noise: rounded to 12 decimals.
///
/// cos 90° is 0, not 6e-17. Numbers beyond 1000 are unchanged.
pub fn tidy(value: f64) -> f64 {
    if value.abs() < 1e3 {
        let rounded = (value * 1e12).round() / 1e12;
        if rounded == 0.0 { 0.0 } else { rounded }
    } else {
        value
    }
}

/// A number, or the nearer bound if it is outside; `low` must not exceed `high`. The library's `clamp` would add number formatting to the module, for a panic
/// that cannot happen.
pub fn within(x: f64, low: f64, high: f64) -> f64 {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}

/// An angle in degrees wrapped to (−180, 180].
pub fn wrap_degrees(angle: f64) -> f64 {
    let turned = angle.rem_euclid(360.0);
    if turned > 180.0 {
        turned - 360.0
    } else {
        turned
    }
}

/// A label inside a sentence: `Width 1` becomes `width 1`. A label that begins with two capitals is unchanged. Labels are ASCII.
pub fn lowered(label: &str) -> String {
    let mut letters = label.chars();
    match (letters.next(), letters.next()) {
        (Some(_), Some(second)) if second.is_ascii_uppercase() => label.to_owned(),
        (Some(first), _) => format!(
            "{}{}",
            first.to_ascii_lowercase(),
            &label[first.len_utf8()..]
        ),
        (None, _) => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tie is rounded exactly and its neighbour is not; the texts are equal.
    #[test]
    fn equal_texts_are_equal() {
        let (tie, beside) = (Digits::of(0.0005, 3), Digits::of(0.000_500_000_000_01, 3));
        assert!(matches!(
            (&tie, &beside),
            (Digits::Long(_), Digits::Short { .. })
        ));
        assert_eq!((&*tie, &*beside), ("0.001", "0.001"));
        assert_eq!(tie, beside);
        assert_ne!(tie, Digits::of(0.002, 3));
    }

    #[test]
    fn decimals_as_a_control_takes_them() {
        assert_eq!(decimal(42.0, 4), "42");
        assert_eq!(decimal(37.5, 4), "37.5");
        assert_eq!(decimal(-0.00004, 4), "0");
        assert_eq!(decimal(-0.00006, 4), "-0.0001");
        assert_eq!(decimal(100.0, 0), "100");
        assert_eq!(decimal(1e-300, 4), "0");
        assert_eq!(decimal(123_456_789.123_46, 4), "123456789.1235");
        assert_eq!(decimal(0.1 + 0.2, 5), "0.3");
    }

    /// Compares bit for bit with the library: near ties, at powers of ten, huge, tiny, and random numbers.
    #[test]
    fn decimals_are_those_of_the_library() {
        let library = |value: f64, places: usize| {
            let mut exact = format!("{value:.places$}");
            if exact.contains('.') {
                exact.truncate(exact.trim_end_matches('0').trim_end_matches('.').len());
            }
            if exact == "-0" { "0".to_owned() } else { exact }
        };
        let mut state = 0x9E37_79B9_7F4A_7C15u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            state >> 11
        };
        let mut quick = 0;
        for round in 0..400_000u32 {
            let places = (random() % 14) as usize;
            let unit = random() as f64 / (1u64 << 53) as f64;
            let value = match round % 5 {
                0 => (unit - 0.5) * 2000.0,
                1 => (random() % 2_000_000) as f64 / 10f64.powi((random() % 8) as i32),
                // Half a digit, and its neighbours.
                2 => {
                    ((random() % 100_000) as f64 + 0.5) / 10f64.powi(places as i32)
                        * (1.0 + (random() % 5) as f64 * 1.1e-16)
                }
                3 => (unit - 0.5) * 10f64.powi((random() % 40) as i32 - 20),
                _ => f64::from(round) / 8.0,
            };
            assert_eq!(
                decimal(value, places),
                library(value, places),
                "{value:?} {places}"
            );
            assert_eq!(
                exactly(value, places),
                library(value, places),
                "{value:?} {places}"
            );
            quick += u32::from(whole(value, places).is_some());
        }
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(exactly(value, 4), library(value, 4), "NaN is printed");
        }
        for value in [
            0.0,
            -0.0,
            1.0,
            -1.0,
            0.1,
            9.999_99,
            99_999.999_95,
            1e15,
            1e22,
            5e-324,
            -0.000_05,
            0.5,
            1.5,
            2.5,
        ] {
            for places in 0..14 {
                assert_eq!(
                    decimal(value, places),
                    library(value, places),
                    "{value:?} {places}"
                );
                assert_eq!(
                    exactly(value, places),
                    library(value, places),
                    "{value:?} {places}"
                );
            }
        }
        assert!(quick > 200_000, "{quick}");
    }

    #[test]
    fn numbers_in_full_are_the_shortest_that_read_back() {
        let same = |value: f64| {
            let mut text = String::new();
            push_in_full(&mut text, value);
            let library = format!("{:?}", value + 0.0);
            assert_eq!(
                text,
                library.strip_suffix(".0").unwrap_or(&library),
                "{value:e}"
            );
            assert_eq!(in_full(value), format!("{}", value + 0.0), "{value:e}");
        };
        for value in [
            0.0,
            -0.0,
            1.0,
            80.5,
            0.001,
            -0.0005,
            25.4,
            1.0 / 3.0,
            1e-6,
            5e-7,
            9.995e-6,
            123_456_789.25,
            1e9,
            1e16,
            1e300,
        ] {
            same(value);
        }
        for value in [
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::MAX,
            f64::MIN_POSITIVE,
            5e-324,
            0.1 + 0.2,
            2.54e-5,
            9.5,
            99.95,
        ] {
            same(value);
        }
        let mut bits = 0x1234_5678_9ABC_DEF1u64;
        for round in 0..600 {
            bits = bits
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            same(f64::from_bits(bits));
            same((bits >> 40) as f64 / 25.4);
            // Powers of two have a nearer neighbour below than above.
            same(2f64.powi(round * 3 - 1000));
        }
    }

    #[test]
    fn tidy_takes_the_noise_away_and_nothing_else() {
        assert_eq!(tidy(90f64.to_radians().cos()), 0.0);
        assert!(tidy(-1e-15).is_sign_positive());
        assert_eq!(tidy(0.123_456_789_012), 0.123_456_789_012);
        assert_eq!(tidy(123_456.789_012_345_67), 123_456.789_012_345_67);
    }

    #[test]
    fn angles_wrap_to_the_half_open_turn() {
        assert_eq!(wrap_degrees(180.0), 180.0);
        assert_eq!(wrap_degrees(-180.0), 180.0);
        assert_eq!(wrap_degrees(359.0), -1.0);
        assert_eq!(wrap_degrees(-90.0), -90.0);
    }
}
