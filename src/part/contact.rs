//! Where a ball that moves in a straight line first meets a wall. Exact for flat walls and their straight top edges.

use crate::geom::Vec3;
use crate::path::Wall;

/// A contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Which part of the way is done, 0 to 1.
    pub fraction: f64,
    /// The ball centre there.
    pub center: Vec3,
    /// Index of the wall that is met.
    pub wall: usize,
}

/// A ball that stands this deep in a wall still counts as touching it from outside: rounding, not a collision. mm.
const SKIN: f64 = 1e-7;

/// The first contact of a ball (radius in mm, 0 is a point) on its way from `from` to `to`, both ball centres. `up` is the
/// tool axis. A ball that moves away from a wall it touches does not meet it.
///
/// A wall goes on along its length; it ends at its top where it has one, and behind the edge lies a flat top side.
pub fn first_contact(walls: &[Wall], up: Vec3, radius: f64, from: Vec3, to: Vec3) -> Option<Contact> {
    let meetings = walls.iter().enumerate().filter_map(|(i, wall)| Some((meet(wall, up, radius, from, to)?, i)));
    let (fraction, wall) = meetings.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Contact { fraction, center: from + (to - from) * fraction, wall })
}

/// The fraction of the way at which the ball meets one wall.
fn meet(wall: &Wall, up: Vec3, radius: f64, from: Vec3, to: Vec3) -> Option<f64> {
    // Distance in front of the wall and height above its top, at the start and their change over the whole way.
    let (d0, dd) = ((from - wall.point).dot(wall.normal), (to - from).dot(wall.normal));
    let (h0, dh) = if wall.has_top { ((from - wall.point).dot(up), (to - from).dot(up)) } else { (f64::NEG_INFINITY, 0.0) };
    let height = |t: f64| if wall.has_top { h0 + dh * t } else { h0 };
    // Gap between ball and material at the start: below the top the wall counts, behind it the top side, else the edge.
    let gap = if h0 <= 0.0 {
        d0
    } else if d0 <= 0.0 {
        h0
    } else {
        d0.hypot(h0)
    } - radius;
    let closing = if h0 <= 0.0 {
        dd
    } else if d0 <= 0.0 {
        dh
    } else {
        d0 * dd + h0 * dh
    };
    if gap < -SKIN || (gap <= SKIN && closing < 0.0) {
        return Some(0.0);
    }
    let way = |t: f64| (0.0..=1.0).contains(&t).then_some(t);
    let face = (dd < 0.0).then(|| (radius - d0) / dd).and_then(way).filter(|&t| height(t) <= 0.0);
    if !wall.has_top {
        return face;
    }
    let top = (dh < 0.0).then(|| (radius - h0) / dh).and_then(way).filter(|&t| d0 + dd * t <= 0.0);
    // The edge: d² + h² = r², going in. A ball that only grazes it goes on.
    let (a, b, c) = (dd * dd + dh * dh, d0 * dd + h0 * dh, d0 * d0 + h0 * h0 - radius * radius);
    let root = b * b - a * c;
    let edge = (a > 0.0 && b < 0.0 && root > 2.0 * radius * SKIN * a)
        .then(|| (-b - root.sqrt()) / a)
        .and_then(way)
        .filter(|&t| d0 + dd * t >= 0.0 && height(t) >= 0.0);
    [face, top, edge].into_iter().flatten().min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall(has_top: bool) -> Wall {
        // Material at x > 10, top at z = 0.
        Wall {
            point: Vec3::new(10.0, 0.0, 0.0),
            normal: -Vec3::X,
            along: Vec3::Y,
            extent: (-5.0, 5.0),
            drawn_depth: 5.0,
            has_top,
        }
    }

    fn meet(has_top: bool, radius: f64, from: [f64; 3], to: [f64; 3]) -> Option<f64> {
        let (from, to) = (Vec3::from_array(from), Vec3::from_array(to));
        first_contact(&[wall(has_top)], Vec3::Z, radius, from, to).map(|c| c.center.distance(from))
    }

    #[test]
    fn a_wall_is_met_a_radius_in_front_of_it() {
        assert_eq!(meet(true, 3.0, [0.0, 0.0, -5.0], [20.0, 0.0, -5.0]), Some(7.0));
        assert_eq!(meet(true, 0.0, [0.0, 0.0, -5.0], [20.0, 0.0, -5.0]), Some(10.0));
        assert_eq!(meet(true, 3.0, [0.0, 0.0, -5.0], [6.9, 0.0, -5.0]), None);
        // At 45° the ball is met when its centre is 3 in front: 7·√2 along the way.
        let diagonal = meet(false, 3.0, [0.0, 0.0, 0.0], [20.0, 20.0, 0.0]).unwrap();
        assert!((diagonal - 7.0 * 2f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn above_the_top_the_edge_counts_and_then_nothing() {
        // 1.8 above the edge a ball of 3 meets it 2.4 in front of the wall (3-4-5).
        let met = meet(true, 3.0, [0.0, 0.0, 1.8], [20.0, 0.0, 1.8]).unwrap();
        assert!((met - 7.6).abs() < 1e-12);
        assert_eq!(meet(true, 3.0, [0.0, 0.0, 3.0], [20.0, 0.0, 3.0]), None);
        assert_eq!(meet(false, 3.0, [0.0, 0.0, 300.0], [20.0, 0.0, 300.0]), Some(7.0));
    }

    #[test]
    fn going_down_meets_the_top_side_or_the_edge() {
        assert_eq!(meet(true, 3.0, [12.0, 0.0, 10.0], [12.0, 0.0, -10.0]), Some(7.0));
        // 2.4 in front of the wall, the edge is met 1.8 above it.
        let met = meet(true, 3.0, [7.6, 0.0, 10.0], [7.6, 0.0, -10.0]).unwrap();
        assert!((met - 8.2).abs() < 1e-12);
        assert_eq!(meet(true, 3.0, [7.0, 0.0, 10.0], [7.0, 0.0, -10.0]), None);
    }

    #[test]
    fn leaving_a_contact_is_no_contact_and_standing_inside_is() {
        assert_eq!(meet(true, 3.0, [7.0, 0.0, -5.0], [0.0, 0.0, -5.0]), None);
        assert_eq!(meet(true, 3.0, [7.0, 0.0, -5.0], [7.0, 9.0, -5.0]), None);
        assert_eq!(meet(true, 3.0, [7.0, 0.0, -5.0], [8.0, 0.0, -5.0]), Some(0.0));
        assert_eq!(meet(true, 3.0, [7.5, 0.0, -5.0], [0.0, 0.0, -5.0]), Some(0.0));
    }
}
