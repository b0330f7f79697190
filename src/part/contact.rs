//! Where a ball that moves in a straight line first meets a wall. Exact for flat walls and their straight top edges.

use crate::geom::Vec3;
use crate::path::{Round, Surface, Wall};

/// A contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Which part of the way is done, 0 to 1.
    pub fraction: f64,
    /// The ball centre there.
    pub center: Vec3,
    /// Index of the surface that is met.
    pub surface: usize,
}

/// A ball that stands this deep in a wall still counts as touching it from outside: rounding, not a collision. mm.
const SKIN: f64 = 1e-7;

/// The first contact of a ball (radius in mm, 0 is a point) on its way from `from` to `to`, both ball centres. `up` is the
/// tool axis. A ball that moves away from a surface it touches does not meet it.
///
/// A flat wall goes on along its length. A surface ends at its top where it has one, and behind the edge lies a flat top side.
/// Against round surfaces a move that is neither level nor upright is taken to run at its lower end's height all the way.
pub fn first_contact(surfaces: &[Surface], up: Vec3, radius: f64, from: Vec3, to: Vec3) -> Option<Contact> {
    let meetings = surfaces.iter().enumerate().filter_map(|(i, surface)| {
        let fraction = match surface {
            Surface::Flat(wall) => meet(wall, up, radius, from, to),
            Surface::Round(round) => meet_round(round, up, radius, from, to),
            Surface::Unknown => None,
        };
        Some((fraction?, i))
    });
    let (fraction, surface) = meetings.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Contact { fraction, center: from + (to - from) * fraction, surface })
}

/// The fraction of the way at which the ball meets a hole or a stud. Of a hole only the wall and its rim are known, not how
/// far the material goes around it: a second hole lies there, or nothing.
fn meet_round(round: &Round, up: Vec3, radius: f64, from: Vec3, to: Vec3) -> Option<f64> {
    let flat = |v: Vec3| v - up * v.dot(up);
    let (start, way) = (flat(from - round.center), flat(to - from));
    let (h0, h1) = ((from - round.center).dot(up), (to - round.center).dot(up));
    // Distance in front of the wall: from inside a hole, from outside otherwise.
    let inside = round.hole && start.length() <= round.radius;
    let front = if inside { round.radius - start.length() } else { start.length() - round.radius };
    // How near the ball's centre may come at a height: below the top its radius, above it less, then as near as it likes.
    let reach = |h: f64| {
        if h <= 0.0 {
            Some(radius)
        } else if h < radius - SKIN {
            Some((radius * radius - h * h).sqrt())
        } else {
            None
        }
    };
    if way.length() < 1e-12 {
        if front >= radius - SKIN {
            return None;
        }
        // Over the free side the edge is met, over the material its top side.
        let free = front > 0.0 && (inside || !round.hole);
        let stop = if free { (radius * radius - front * front).sqrt() } else { radius };
        return if h0 < stop - SKIN { Some(0.0) } else { (h1 < stop).then(|| ((h0 - stop) / (h0 - h1)).clamp(0.0, 1.0)) };
    }
    let near = reach(h0.min(h1))?;
    let gap = front - near;
    // The way is met where |start + t·way| is `limit`: going out of a hole's middle, or coming in from outside.
    let limit = if inside { round.radius - near } else { round.radius + near };
    let (a, b, c) = (way.dot(way), start.dot(way), start.dot(start) - limit * limit);
    if gap < -SKIN || (gap <= SKIN && !inside && b < 0.0) {
        return Some(0.0);
    }
    let root = b * b - a * c;
    if inside {
        // From inside there is one way out. A ball that stands at the wall meets it only if it goes outwards.
        let t = (-b + root.max(0.0).sqrt()) / a;
        return (t <= 1.0 && (gap > SKIN || t <= SKIN || b > 0.0)).then_some(t.max(0.0));
    }
    let t = (-b - root.max(0.0).sqrt()) / a;
    (b < 0.0 && root > 2.0 * limit * SKIN * a && (0.0..=1.0).contains(&t)).then_some(t)
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
        first_contact(&[Surface::Flat(wall(has_top))], Vec3::Z, radius, from, to).map(|c| c.center.distance(from))
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

    fn round(hole: bool, from: [f64; 3], to: [f64; 3]) -> Option<f64> {
        // Diameter 20 about the tool axis, top at z = 0, ball radius 3.
        let surface = Surface::Round(Round { center: Vec3::ZERO, radius: 10.0, hole, drawn_depth: 5.0 });
        let (from, to) = (Vec3::from_array(from), Vec3::from_array(to));
        first_contact(&[surface], Vec3::Z, 3.0, from, to).map(|c| c.center.distance(from))
    }

    #[test]
    fn a_hole_is_met_from_inside() {
        assert_eq!(round(true, [0.0, 0.0, -5.0], [20.0, 0.0, -5.0]), Some(7.0));
        assert_eq!(round(true, [0.0, 0.0, -5.0], [6.9, 0.0, -5.0]), None);
        // Off the middle by 4.2: 7² = 4.2² + 5.6².
        let met = round(true, [0.0, 4.2, -5.0], [20.0, 4.2, -5.0]).unwrap();
        assert!((met - 5.6).abs() < 1e-12);
        assert_eq!(round(true, [7.0, 0.0, -5.0], [0.0, 0.0, -5.0]), None, "leaving the wall");
        assert_eq!(round(true, [0.0, 0.0, 3.0], [40.0, 0.0, 3.0]), None, "over the top");
        assert_eq!(round(true, [0.0, 0.0, 20.0], [0.0, 0.0, -20.0]), None, "down the middle");
        assert_eq!(round(true, [12.0, 0.0, 20.0], [12.0, 0.0, -20.0]), Some(17.0), "down on the top side at the rim");
        assert_eq!(round(true, [20.0, 0.0, -5.0], [0.0, 0.0, -5.0]), Some(7.0), "through the wall from outside");
        assert_eq!(round(true, [30.0, 0.0, 20.0], [30.0, 0.0, -20.0]), None, "far outside nothing is known");
    }

    #[test]
    fn a_stud_is_met_from_outside() {
        assert_eq!(round(false, [20.0, 0.0, -5.0], [0.0, 0.0, -5.0]), Some(7.0));
        // Past it at a distance of 13 is free; at 12 it is met where 13² = 12² + 5².
        assert_eq!(round(false, [-20.0, 13.0, -5.0], [20.0, 13.0, -5.0]), None);
        assert_eq!(round(false, [-20.0, 12.0, -5.0], [20.0, 12.0, -5.0]), Some(15.0));
        assert_eq!(round(false, [13.0, 0.0, -5.0], [20.0, 0.0, -5.0]), None, "leaving it");
        assert_eq!(round(false, [13.0, 0.0, -5.0], [12.0, 0.0, -5.0]), Some(0.0));
        // Over it, 1.8 above its edge, a ball of 3 is met 2.4 before the edge; over the top it is free.
        let met = round(false, [20.0, 0.0, 1.8], [0.0, 0.0, 1.8]).unwrap();
        assert!((met - 7.6).abs() < 1e-12);
        assert_eq!(round(false, [20.0, 0.0, 3.0], [-20.0, 0.0, 3.0]), None);
        assert_eq!(round(false, [0.0, 0.0, 20.0], [0.0, 0.0, 0.0]), Some(17.0));
    }
}
