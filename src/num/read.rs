//! Reads numbers from text with exact rounding, like the standard library but without its tables: these are 10 kB of incompressible WebAssembly.

use crate::num::whole::Whole;

/// A decimal number: sign, digits with an optional point, exponent. Rounded to the nearest, ties to even; too large a number is infinite. `None` for any other
/// text, including infinities and NaN.
pub fn read(text: &str) -> Option<f64> {
    let (negative, unsigned) = match text.as_bytes() {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        rest => (false, rest),
    };
    let end = unsigned
        .iter()
        .position(|b| !(b.is_ascii_digit() || *b == b'.'))
        .unwrap_or(unsigned.len());
    let (digits, rest) = unsigned.split_at(end);
    let mut exponent = match rest {
        [] => 0,
        [b'e' | b'E', rest @ ..] => exponent(rest)?,
        _ => return None,
    };
    let mut mantissa: u64 = 0;
    // More than nineteen digits may not fit; leading zeros do not count.
    let mut significant = 0;
    let mut point = None;
    for (at, digit) in digits.iter().enumerate() {
        if *digit == b'.' {
            if point.replace(at).is_some() {
                return None;
            }
            continue;
        }
        significant += usize::from(significant > 0 || *digit != b'0');
        if significant <= 19 {
            mantissa = mantissa * 10 + u64::from(digit - b'0');
        }
    }
    if digits.len() == usize::from(point.is_some()) {
        return None;
    }
    exponent -= point.map_or(0, |at| digits.len() - at - 1) as i64;
    // Both sides are exact, so their quotient or product is rounded once.
    let value = match (
        significant <= 19 && mantissa < 1 << 53,
        usize::try_from(exponent.unsigned_abs()),
    ) {
        (true, Ok(power)) if power < super::POWERS.len() => {
            if exponent < 0 {
                mantissa as f64 / super::POWERS[power]
            } else {
                mantissa as f64 * super::POWERS[power]
            }
        }
        _ => exactly(digits, exponent),
    };
    Some(if negative { -value } else { value })
}

/// The number at the start of a text, without sign and exponent, and its length in bytes: digits with at most one point. `None` if there are no digits, or the
/// number is infinite. Inlined: a call would cost as much as the digits.
#[inline(always)]
pub fn read_digits(text: &[u8]) -> Option<(f64, usize)> {
    let mut mantissa = 0u64;
    // The digits from a position on, and their end. If there are too many, they are read again below.
    let mut run = |from: usize| {
        let mut at = from;
        while let Some(digit) = text
            .get(at)
            .map(|b| b.wrapping_sub(b'0'))
            .filter(|digit| *digit < 10)
        {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
            at += 1;
        }
        at
    };
    let whole = run(0);
    let length = if text.get(whole) == Some(&b'.') {
        run(whole + 1)
    } else {
        whole
    };
    let decimals = (length - whole).saturating_sub(1);
    match whole + decimals {
        0 => None,
        // Both are exact up to here, so their quotient is rounded once.
        1..=15 => {
            // From a signed number: processors convert these faster.
            let number = mantissa as i64 as f64;
            Some((
                if decimals == 0 {
                    number
                } else {
                    number / super::POWERS[decimals]
                },
                length,
            ))
        }
        _ => Some((
            read(std::str::from_utf8(&text[..length]).ok()?).filter(|x| x.is_finite())?,
            length,
        )),
    }
}

/// The digits after an E, within the relevant range.
fn exponent(text: &[u8]) -> Option<i64> {
    let (negative, digits) = match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        rest => (false, rest),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let size = digits.iter().fold(0i64, |sum, digit| {
        (sum * 10 + i64::from(digit - b'0')).min(1 << 40)
    });
    Some(if negative { -size } else { size })
}

/// Digits with an optional point, times a power of ten, with big integers.
fn exactly(digits: &[u8], mut exponent: i64) -> f64 {
    // Later digits only matter as being non-zero.
    const MOST: usize = 800;
    let mut digits: Vec<u8> = digits
        .iter()
        .copied()
        .filter(|b| *b != b'.')
        .skip_while(|b| *b == b'0')
        .collect();
    if digits.len() > MOST {
        exponent += (digits.len() - MOST) as i64;
        let more = digits[MOST..].iter().any(|b| *b != b'0');
        digits.truncate(MOST);
        digits[MOST - 1] += u8::from(more && digits[MOST - 1] == b'0');
    }
    let place = digits.len() as i64 + exponent;
    if digits.is_empty() || place < -330 {
        return 0.0;
    }
    if place > 310 {
        return f64::INFINITY;
    }
    let mut whole = Whole::ZERO;
    digits
        .iter()
        .for_each(|digit| whole.times_and(10, u32::from(digit - b'0')));
    (0..exponent).for_each(|_| whole.times_and(10, 0));
    // Shifted so far that the quotient has more bits than a double: 64 and the 3.33 of each division.
    let parts = if exponent < 0 {
        (64 + exponent.unsigned_abs() as usize * 107 / 32) / 32 + 1
    } else {
        0
    };
    whole.shift(parts);
    let left = (exponent..0).fold(false, |left, _| whole.divide(10) > 0 || left);
    // The highest bit has the value 2 to this power. A double has 53 bits from there, and no bit below the 1074th after the point.
    let power = whole.bits() - 1 - parts as i64 * 32;
    let lowest = (power - 52).max(-1074);
    let low = lowest + parts as i64 * 32;
    let (mut bits, below) = whole.bits_above(low.max(0));
    if low > 0 {
        let (half, less) = (whole.bit(low - 1), left || whole.bits_above(low - 1).1);
        debug_assert!(below || !half, "a half is something");
        bits += u64::from(half && (less || bits & 1 == 1));
    } else {
        bits <<= -low;
    }
    // Exact: `bits` has at most 54 bits, and both factors are powers of two.
    let half = lowest / 2;
    bits as f64 * 2f64.powi(half as i32) * 2f64.powi((lowest - half) as i32)
}

#[cfg(test)]
mod tests {
    use super::{read, read_digits};

    /// Compares bit for bit with the library.
    fn same(text: &str) {
        let library = text.parse::<f64>().ok();
        assert_eq!(
            read(text).map(f64::to_bits),
            library.map(f64::to_bits),
            "{text}"
        );
    }

    #[test]
    fn numbers_of_programs_and_jobs() {
        for text in [
            "0",
            "-0",
            "1",
            "12.5",
            "-.5",
            "5.",
            "+7",
            "0.707106781187",
            "1e3",
            "1E-3",
            "1.5e+2",
            "123456789012345678901234567890",
            "1e22",
            "1e23",
            "9007199254740993",
            "9007199254740992.5",
            "0.1",
            "0.30000000000000004",
            "1e308",
            "1.7976931348623159e308",
            "1e309",
            "5e-324",
            "2e-324",
            "2.4703282292062327e-324",
            "2.4703282292062328e-324",
            "2.2250738585072011e-308",
            "1e-400",
            "1e400",
            "0e999999999999999999999",
            "000.000",
            "179769313486231580793728971405301e276",
            "1e00000000000000000005",
        ] {
            same(text);
        }
        for text in [
            "", ".", "-", "+", "1e", "e5", "1.2.3", "1,5", " 1", "1 ", "--1", "0x10", "1_0", "e",
            ".e1", "٣",
        ] {
            same(text);
        }
        for text in ["inf", "NaN", "-infinity"] {
            assert_eq!(read(text), None, "{text}");
        }
    }

    /// Text after the digits is left; the digits are read as the library reads them.
    #[test]
    fn digits_at_the_beginning_of_a_text() {
        for (text, length) in [
            ("15 Y3", 2),
            ("0.707106781187*[", 14),
            (".5]", 2),
            ("5.", 2),
            ("7..5", 2),
            ("1.2.3", 3),
            ("12e3", 2),
            ("1234567890.123456", 17),
        ] {
            let number = text[..length].parse::<f64>().unwrap();
            assert_eq!(
                read_digits(text.as_bytes()),
                Some((number, length)),
                "{text}"
            );
        }
        let long = "9".repeat(400);
        for text in ["", ".", "-5", "+5", "e5", "X1", "..5", &long] {
            assert_eq!(read_digits(text.as_bytes()), None, "{text}");
        }
    }

    /// Half-way between two numbers, and one digit off, at all magnitudes: where rounding is hard.
    #[test]
    fn ties_and_their_neighbours() {
        let mut state = 0x2545_F491_4F6C_DD1Du64;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state
        };
        for _ in 0..400 {
            let number = f64::from_bits(random() & 0x7FEF_FFFF_FFFF_FFFF);
            same(&format!("{number:e}"));
            same(&format!("{number:?}"));
            // Exactly between this number and the next: the library prints as many digits as requested.
            let next = f64::from_bits(number.to_bits() + 1);
            if (1e-300..1e300).contains(&number) {
                let (exact, after) = (format!("{number:.1100}"), format!("{next:.1100}"));
                same(&exact);
                let tie = middle(&exact, &after);
                same(&tie);
                same(&format!("{tie}1"));
            }
            same(&format!(
                "{}.{}e{}",
                random() % 1_000_000,
                random(),
                (random() % 700) as i64 - 350
            ));
            same(&format!("{}", (random() % 1_000_000_000) as f64 / 1e6));
        }
    }

    /// Half the sum of two decimals of the same shape, digit by digit.
    fn middle(a: &str, b: &str) -> String {
        let point = b.find('.').unwrap();
        let digits = |text: &str| -> Vec<u32> {
            let padded = format!("{text:0>width$}", width = b.len());
            padded
                .bytes()
                .filter(|b| *b != b'.')
                .map(|b| u32::from(b - b'0'))
                .collect()
        };
        let (a, b) = (digits(a), digits(b));
        let mut sum = vec![0; a.len() + 1];
        for i in (0..a.len()).rev() {
            let whole = a[i] + b[i] + sum[i + 1];
            (sum[i + 1], sum[i]) = (whole % 10, whole / 10);
        }
        let (mut rest, mut text) = (0, String::new());
        for (i, digit) in sum.into_iter().enumerate() {
            if i == point + 1 {
                text.push('.');
            }
            let whole = rest * 10 + digit;
            text.push_str(&(whole / 2).to_string());
            rest = whole % 2;
        }
        if rest == 1 { format!("{text}5") } else { text }
    }
}
