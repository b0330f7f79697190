//! Decimals as controls write them, and tidy numbers for people.

/// A number with at most `places` decimals: rounded, trailing zeros dropped, never an exponent, never `-0`.
///
/// `decimal(12.5, 4)` is `12.5`, `decimal(-0.00001, 4)` is `0`. The value must be finite.
pub fn decimal(value: f64, places: usize) -> String {
    debug_assert!(value.is_finite(), "only checked numbers are written");
    let mut text = format!("{value:.places$}");
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    }
    if text == "-0" {
        text.remove(0);
    }
    text
}

/// The same number without the noise of floating point: rounded to 12 decimals, and to zero where it is nothing else.
///
/// cos 90° comes out as 0 and not as 6e-17. Numbers beyond 1000 are left as they are.
pub fn tidy(value: f64) -> f64 {
    if value.abs() < 1e3 {
        let rounded = (value * 1e12).round() / 1e12;
        if rounded == 0.0 { 0.0 } else { rounded }
    } else {
        value
    }
}

/// An angle in degrees wrapped to (−180, 180].
pub fn wrap_degrees(angle: f64) -> f64 {
    let turned = angle.rem_euclid(360.0);
    if turned > 180.0 { turned - 360.0 } else { turned }
}

/// A label as it stands inside a sentence: `Width 1` as `width 1`. What begins with two capitals stays.
pub fn lowered(label: &str) -> String {
    let mut letters = label.chars();
    match (letters.next(), letters.next()) {
        (Some(_), Some(second)) if second.is_uppercase() => label.to_owned(),
        (Some(first), _) => first.to_lowercase().chain(label.chars().skip(1)).collect(),
        (None, _) => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
