//! Points of the picture plane, and the little arithmetic with them.

/// A point on the picture plane, mm, y upwards.
pub type Spot = [f64; 2];

/// Distance of a spot from a segment.
pub fn distance(p: Spot, a: Spot, b: Spot) -> f64 {
    let (ab, ap) = (sub(b, a), sub(p, a));
    let square = ab[0] * ab[0] + ab[1] * ab[1];
    let t = if square == 0.0 { 0.0 } else { crate::num::within((ap[0] * ab[0] + ap[1] * ab[1]) / square, 0.0, 1.0) };
    length([ap[0] - ab[0] * t, ap[1] - ab[1] * t])
}

/// The way from the second to the first.
pub fn sub(a: Spot, b: Spot) -> Spot {
    [a[0] - b[0], a[1] - b[1]]
}

/// Positive where the second lies counter-clockwise of the first.
pub fn cross(a: Spot, b: Spot) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Of a way.
pub fn length(a: Spot) -> f64 {
    a[0].hypot(a[1])
}

/// Whether two spots are one, but for rounding.
pub fn same(a: Spot, b: Spot) -> bool {
    (a[0] - b[0]).abs() < 1e-6 && (a[1] - b[1]).abs() < 1e-6
}

/// The scalar product.
pub fn dot(a: Spot, b: Spot) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// About how many pixels a name takes with the room around it: the picture is laid out where nothing can be measured, too.
pub fn width(name: &str) -> f64 {
    // Signs of Chinese are as wide as they are high.
    name.chars().map(|c| if c > '\u{1100}' { 12.5 } else { 7.6 }).sum::<f64>() + 18.0
}
