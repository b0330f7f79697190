//! First contact of a ball that moves in a straight line with a part. Exact for flat walls, their edges and corners.

use crate::geom::Vec3;
use crate::path::{Round, Surface};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Fraction of the move at the contact, 0 to 1.
    pub fraction: f64,
    /// Ball centre at the contact.
    pub center: Vec3,
    /// Index of the touched surface.
    pub surface: usize,
    /// Whether the contact is at an edge, a corner or a rim instead of a face.
    pub edge: bool,
}

/// A ball up to this deep in a wall still counts as touching it from outside: rounding, not a collision; mm.
pub(super) const SKIN: f64 = 1e-7;

/// Obstacles for a ball. Flat walls bound convex bodies; a single wall is unlimited. A wall with a top ends there, with a flat top side behind the edge.
#[derive(Debug)]
pub struct Obstacles<'s> {
    up: Vec3,
    bodies: Vec<Body>,
    /// Round walls with the indices of their surfaces.
    rounds: Vec<(usize, &'s Round)>,
}

impl<'s> Obstacles<'s> {
    /// Obstacles from these surfaces. `up` is the tool axis.
    pub fn of(surfaces: &'s [Surface], up: Vec3) -> Self {
        let round = |(i, surface): (usize, &'s Surface)| match surface {
            Surface::Round(round) => Some((i, round)),
            Surface::Flat(_) | Surface::Unknown => None,
        };
        Obstacles {
            up,
            bodies: (0..surfaces.len())
                .filter_map(|first| Body::beginning(surfaces, up, first))
                .collect(),
            rounds: surfaces.iter().enumerate().filter_map(round).collect(),
        }
    }

    /// First contact of a ball (radius in mm, 0 is a point) that moves from `from` to `to`, both ball centres. A ball that moves away from a surface it touches
    /// has no contact with it.
    ///
    /// Against round surfaces a move that is neither level nor upright counts as low as its lower end all the way.
    pub fn first_contact(&self, radius: f64, from: Vec3, to: Vec3) -> Option<Contact> {
        let flat = self
            .bodies
            .iter()
            .filter_map(|body| body.meet(radius, from, to));
        let round = self.rounds.iter().filter_map(|(surface, round)| {
            let fraction = meet_round(round, self.up, radius, from, to)?;
            let height = (from + (to - from) * fraction - round.center).dot(self.up);
            Some((fraction, *surface, height > SKIN))
        });
        let (fraction, surface, edge) = flat.chain(round).min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Contact {
            fraction,
            center: from + (to - from) * fraction,
            surface,
            edge,
        })
    }
}

/// Fraction of the move at which the ball contacts a hole or a stud. There is material around a hole up to the radius of its plate; beyond that nothing is
/// known.
fn meet_round(round: &Round, up: Vec3, radius: f64, from: Vec3, to: Vec3) -> Option<f64> {
    let flat = |v: Vec3| v - up * v.dot(up);
    let (start, way) = (flat(from - round.center), flat(to - from));
    let (h0, h1) = ((from - round.center).dot(up), (to - round.center).dot(up));
    // Distance in front of the wall: from inside for a hole, from outside otherwise.
    let inside = round.hole && start.length() <= round.radius + SKIN;
    let front = if inside {
        round.radius - start.length()
    } else {
        start.length() - round.radius
    };
    let material = !inside
        && round
            .plate
            .is_some_and(|reach| start.length() < reach - 10.0 * SKIN);
    if material && h0.min(h1) < radius - SKIN {
        // Above the plate, or in it: the ball touches its top side on the way down.
        return if h0 < radius - SKIN {
            Some(0.0)
        } else {
            (h1 < h0).then(|| crate::num::within((h0 - radius) / (h0 - h1), 0.0, 1.0))
        };
    }
    // Smallest distance of the ball centre at a height: the radius below the top, less above it, then none.
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
        // On the free side the ball touches the edge, on the material side the top side.
        let free = front > 0.0 && (inside || !round.hole);
        let stop = if free {
            (radius * radius - front * front).sqrt()
        } else {
            radius
        };
        return if h0 < stop - SKIN {
            Some(0.0)
        } else {
            (h1 < stop).then(|| crate::num::within((h0 - stop) / (h0 - h1), 0.0, 1.0))
        };
    }
    let near = reach(h0.min(h1))?;
    let gap = front - near;
    // The contact is where |start + t·way| equals `limit`: outwards in a hole, inwards from outside.
    let limit = if inside {
        round.radius - near
    } else {
        round.radius + near
    };
    let (a, b, c) = (
        way.dot(way),
        start.dot(way),
        start.dot(start) - limit * limit,
    );
    if gap < -SKIN || (gap <= SKIN && !inside && b < 0.0) {
        return Some(0.0);
    }
    let root = b * b - a * c;
    if inside {
        // From inside there is one way out. A ball at the wall makes contact only if it moves outwards.
        let t = (-b + root.max(0.0).sqrt()) / a;
        return (t <= 1.0 && (gap > SKIN || t <= SKIN || b > 0.0)).then_some(t.max(0.0));
    }
    let t = (-b - root.max(0.0).sqrt()) / a;
    (b < 0.0 && root > 2.0 * limit * SKIN * a && (0.0..=1.0).contains(&t)).then_some(t)
}

/// A convex body: the intersection of the half-spaces of its faces.
#[derive(Debug)]
pub(super) struct Body {
    /// Outward normal of each face, distance of its plane, and index of its surface.
    faces: [(Vec3, f64, usize); MOST_FACES],
    count: usize,
}

/// Four walls with the same top, or three of a corner with a separate top.
const MOST_FACES: usize = 8;

/// Distance of a point from a body (negative inside), and the outward direction there.
struct Gap {
    distance: f64,
    direction: Vec3,
    surface: usize,
    /// Whether the nearest point is inside a face.
    face: bool,
}

impl Body {
    /// The body that begins with this wall; `None` if an earlier wall begins it.
    pub(super) fn beginning(surfaces: &[Surface], up: Vec3, first: usize) -> Option<Self> {
        let Surface::Flat(begin) = &surfaces[first] else {
            return None;
        };
        let mut body = Body {
            faces: [(Vec3::ZERO, 0.0, 0); MOST_FACES],
            count: 0,
        };
        let mut topped = false;
        for (index, surface) in surfaces.iter().enumerate() {
            let Surface::Flat(wall) = surface else {
                continue;
            };
            if wall.body != begin.body {
                continue;
            }
            if index < first {
                return None;
            }
            body.add(wall.normal, wall.point, index);
            // The walls of a body have their tops at one level.
            if wall.has_top && !topped {
                body.add(up, wall.point, index);
                topped = true;
            }
        }
        Some(body)
    }

    /// A block parallel to the axes, from its lowest to its highest corner, without a lower side: a ball below it has its stylus in the block.
    pub(super) fn block([low, high]: [Vec3; 2], up: Vec3) -> Self {
        let mut body = Body {
            faces: [(Vec3::ZERO, 0.0, 0); MOST_FACES],
            count: 0,
        };
        for axis in Vec3::AXES {
            body.add(axis, high, 0);
            if axis != up {
                body.add(-axis, low, 0);
            }
        }
        body
    }

    fn add(&mut self, normal: Vec3, point: Vec3, surface: usize) {
        self.put(normal, normal.dot(point), surface);
    }

    fn put(&mut self, normal: Vec3, value: f64, surface: usize) {
        if self.count < MOST_FACES {
            self.faces[self.count] = (normal, value, surface);
            self.count += 1;
        }
    }

    /// Cross-section at a height, as an unlimited prism along `up`, and the height at which the body ends. `None` if only level faces bound it.
    pub(super) fn cut(&self, up: Vec3, height: f64) -> Option<(Body, Option<f64>)> {
        let mut prism = Body {
            faces: [(Vec3::ZERO, 0.0, 0); MOST_FACES],
            count: 0,
        };
        let mut top: Option<f64> = None;
        for &(normal, value, surface) in &self.faces[..self.count] {
            let lift = normal.dot(up);
            let flat = normal - up * lift;
            let size = flat.length();
            if size < 1e-9 {
                top = Some(top.map_or(value, |top| top.min(value)));
            } else {
                prism.put(flat / size, (value - lift * height) / size, surface);
            }
        }
        (prism.count > 0).then_some((prism, top))
    }

    /// Distance from the body. Outside, the nearest point is on a face, on an edge of two faces, or at a corner of three: where the direction to the point is a
    /// combination of their normals without negative parts, and the nearest point is behind every other face.
    fn gap(&self, p: Vec3) -> Gap {
        let faces = &self.faces[..self.count];
        let behind = |q: Vec3| faces.iter().all(|(n, d, _)| n.dot(q) - d <= 1e-9);
        let over = |i: usize| faces[i].0.dot(p) - faces[i].1;
        let nearest = (0..self.count)
            .max_by(|&i, &j| over(i).total_cmp(&over(j)))
            .unwrap_or(0);
        let gap = |way: Vec3, surface: usize| Gap {
            distance: way.length(),
            direction: way.normalize_or_zero(),
            surface,
            face: false,
        };
        if over(nearest) <= 0.0 || behind(p - faces[nearest].0 * over(nearest)) {
            return Gap {
                distance: over(nearest),
                direction: faces[nearest].0,
                surface: faces[nearest].2,
                face: true,
            };
        }
        let mut found: Option<Gap> = None;
        let mut take = |way: Vec3, surface: usize| {
            if behind(p - way) && found.as_ref().is_none_or(|f| way.length() < f.distance) {
                found = Some(gap(way, surface));
            }
        };
        for i in 0..self.count {
            if over(i) > 0.0 {
                take(faces[i].0 * over(i), faces[i].2);
            }
            for j in i + 1..self.count {
                let (n1, n2) = (faces[i].0, faces[j].0);
                let g = n1.dot(n2);
                let det = 1.0 - g * g;
                if det < 1e-9 {
                    continue;
                }
                let (a, b) = ((over(i) - g * over(j)) / det, (over(j) - g * over(i)) / det);
                if a >= 0.0 && b >= 0.0 {
                    take(n1 * a + n2 * b, if a > b { faces[i].2 } else { faces[j].2 });
                }
                for k in j + 1..self.count {
                    let n3 = faces[k].0;
                    let det = n1.dot(n2.cross(n3));
                    if det.abs() < 1e-9 {
                        continue;
                    }
                    // The corner: intersection of the three planes.
                    let corner = (n2.cross(n3) * faces[i].1
                        + n3.cross(n1) * faces[j].1
                        + n1.cross(n2) * faces[k].1)
                        / det;
                    let way = p - corner;
                    let parts = [
                        n2.cross(n3).dot(way),
                        n3.cross(n1).dot(way),
                        n1.cross(n2).dot(way),
                    ]
                    .map(|x| x / det);
                    if parts.iter().all(|x| *x >= 0.0) {
                        take(way, faces[i].2);
                    }
                }
            }
        }
        found.unwrap_or(Gap {
            distance: over(nearest),
            direction: faces[nearest].0,
            surface: faces[nearest].2,
            face: true,
        })
    }

    /// Fraction of the move at which a ball contacts the body, index of the surface, and whether it is an edge. The distance of a point that moves in a
    /// straight line from a convex body is a convex function of the fraction, so Newton's steps from the start never pass the first contact; on a face the
    /// first step is exact.
    pub(super) fn meet(&self, radius: f64, from: Vec3, to: Vec3) -> Option<(f64, usize, bool)> {
        let way = to - from;
        // If the plane of one face is out of reach, so is the body.
        let faces = self.faces[..self.count].iter();
        let apart = faces
            .map(|(normal, face, _)| normal.dot(from) - face)
            .fold(f64::NEG_INFINITY, f64::max);
        if apart - radius > way.length() + SKIN {
            return None;
        }
        let reach = |limit: f64| {
            let mut t = 0.0;
            for _ in 0..100 {
                let gap = self.gap(from + way * t);
                let left = gap.distance - limit;
                if left <= 1e-12 {
                    return Some((t, gap.surface, !gap.face));
                }
                let slope = gap.direction.dot(way);
                if slope >= 0.0 {
                    return None;
                }
                t -= left / slope;
                if t > 1.0 {
                    return None;
                }
            }
            let gap = self.gap(from + way * t);
            Some((t, gap.surface, !gap.face))
        };
        // A ball that only grazes the body does not touch it.
        reach(radius - SKIN)?;
        reach(radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::Wall;

    fn wall(has_top: bool) -> Wall {
        // Material at x > 10, top at z = 0.
        Wall {
            point: Vec3::new(10.0, 0.0, 0.0),
            normal: -Vec3::X,
            along: Vec3::Y,
            extent: (-5.0, 5.0),
            drawn_depth: 5.0,
            has_top,
            body: 0,
        }
    }

    fn meet(has_top: bool, radius: f64, from: [f64; 3], to: [f64; 3]) -> Option<f64> {
        let (from, to) = (Vec3::from_array(from), Vec3::from_array(to));
        Obstacles::of(&[Surface::Flat(wall(has_top))], Vec3::Z)
            .first_contact(radius, from, to)
            .map(|c| c.center.distance(from))
    }

    #[test]
    fn a_wall_is_met_a_radius_in_front_of_it() {
        assert_eq!(
            meet(true, 3.0, [0.0, 0.0, -5.0], [20.0, 0.0, -5.0]),
            Some(7.0)
        );
        assert_eq!(
            meet(true, 0.0, [0.0, 0.0, -5.0], [20.0, 0.0, -5.0]),
            Some(10.0)
        );
        assert_eq!(meet(true, 3.0, [0.0, 0.0, -5.0], [6.9, 0.0, -5.0]), None);
        // At 45° the ball touches with its centre 3 in front: 7·√2 along the move.
        let diagonal = meet(false, 3.0, [0.0, 0.0, 0.0], [20.0, 20.0, 0.0]).unwrap();
        assert!((diagonal - 7.0 * 2f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn above_the_top_the_edge_counts_and_then_nothing() {
        // 1.8 above the edge a ball of radius 3 touches it 2.4 in front of the wall (3-4-5).
        let met = meet(true, 3.0, [0.0, 0.0, 1.8], [20.0, 0.0, 1.8]).unwrap();
        assert!((met - 7.6).abs() < 1e-12);
        assert_eq!(meet(true, 3.0, [0.0, 0.0, 3.0], [20.0, 0.0, 3.0]), None);
        assert_eq!(
            meet(false, 3.0, [0.0, 0.0, 300.0], [20.0, 0.0, 300.0]),
            Some(7.0)
        );
    }

    #[test]
    fn going_down_meets_the_top_side_or_the_edge() {
        assert_eq!(
            meet(true, 3.0, [12.0, 0.0, 10.0], [12.0, 0.0, -10.0]),
            Some(7.0)
        );
        // 2.4 in front of the wall, the ball touches the edge 1.8 above it.
        let met = meet(true, 3.0, [7.6, 0.0, 10.0], [7.6, 0.0, -10.0]).unwrap();
        assert!((met - 8.2).abs() < 1e-12);
        assert_eq!(meet(true, 3.0, [7.0, 0.0, 10.0], [7.0, 0.0, -10.0]), None);
    }

    #[test]
    fn leaving_a_contact_is_no_contact_and_standing_inside_is() {
        assert_eq!(meet(true, 3.0, [7.0, 0.0, -5.0], [0.0, 0.0, -5.0]), None);
        assert_eq!(meet(true, 3.0, [7.0, 0.0, -5.0], [7.0, 9.0, -5.0]), None);
        assert_eq!(
            meet(true, 3.0, [7.0, 0.0, -5.0], [8.0, 0.0, -5.0]),
            Some(0.0)
        );
        assert_eq!(
            meet(true, 3.0, [7.5, 0.0, -5.0], [0.0, 0.0, -5.0]),
            Some(0.0)
        );
    }

    /// A block from 0 to 20 in X and Y, its top at z = 0: the walls of one body, numbered x+, x−, y+, y−.
    fn block(radius: f64, from: [f64; 3], to: [f64; 3]) -> Option<(f64, usize)> {
        let face = |point: [f64; 3], normal: Vec3, along: Vec3| {
            let point = Vec3::from_array(point);
            Surface::Flat(Wall {
                point,
                normal,
                along,
                extent: (0.0, 20.0),
                drawn_depth: 5.0,
                has_top: true,
                body: 0,
            })
        };
        let walls = [
            face([20.0, 0.0, 0.0], Vec3::X, Vec3::Y),
            face([0.0, 0.0, 0.0], -Vec3::X, Vec3::Y),
            face([0.0, 20.0, 0.0], Vec3::Y, Vec3::X),
            face([0.0, 0.0, 0.0], -Vec3::Y, Vec3::X),
        ];
        let (from, to) = (Vec3::from_array(from), Vec3::from_array(to));
        Obstacles::of(&walls, Vec3::Z)
            .first_contact(radius, from, to)
            .map(|c| (c.center.distance(from), c.surface))
    }

    #[test]
    fn a_block_is_met_at_faces_edges_and_corners() {
        // A face, and nothing beside the block: a point behind one wall only is free.
        assert_eq!(
            block(3.0, [40.0, 10.0, -5.0], [10.0, 10.0, -5.0]),
            Some((17.0, 0))
        );
        assert_eq!(
            block(3.0, [-40.0, 10.0, -5.0], [10.0, 10.0, -5.0]),
            Some((37.0, 1))
        );
        assert_eq!(block(3.0, [-10.0, 24.0, -5.0], [40.0, 24.0, -5.0]), None);
        assert_eq!(
            block(3.0, [10.0, 10.0, 30.0], [10.0, 10.0, -5.0]).map(|m| m.0),
            Some(27.0)
        );
        // The upright edge at (20, 20): 1.8 outside of one wall, the ball touches it 2.4 before the other (3-4-5).
        let (far, _) = block(3.0, [40.0, 21.8, -5.0], [-10.0, 21.8, -5.0]).unwrap();
        assert!((far - (20.0 - 2.4)).abs() < 1e-9, "{far}");
        // The top corner at (20, 20, 0): 1 beside, 2 above and 2 before it is at distance 3 (1-2-2-3).
        let (far, _) = block(3.0, [40.0, 21.0, 2.0], [-10.0, 21.0, 2.0]).unwrap();
        assert!((far - (20.0 - 2.0)).abs() < 1e-9, "{far}");
        // Past the corner at a distance above the radius there is no contact. Grazing is not a contact.
        assert_eq!(block(3.0, [40.0, 22.5, 2.5], [-10.0, 22.5, 2.5]), None);
        assert_eq!(block(3.0, [40.0, 23.0, -5.0], [-10.0, 23.0, -5.0]), None);
        // A point stylus touches the face itself; a ball inside has contact immediately.
        assert_eq!(
            block(0.0, [40.0, 10.0, -5.0], [10.0, 10.0, -5.0]),
            Some((20.0, 0))
        );
        assert_eq!(
            block(3.0, [10.0, 10.0, -5.0], [40.0, 10.0, -5.0]).map(|m| m.0),
            Some(0.0)
        );
    }

    /// A move that ends a micrometre past its contact has contact, and one that ends as much before has none: along a face's normal, askew to it, and towards
    /// an edge. The contacts are by hand, as above.
    #[test]
    fn the_last_of_a_way_counts() {
        let ways = [
            ([40.0, 10.0, -5.0], [-1.0, 0.0, 0.0], 17.0),
            // 3-4-5: the face is 17 away, and a move with 4 parts in 5 towards it is longer.
            ([40.0, 0.0, -5.0], [-0.8, 0.6, 0.0], 17.0 / 0.8),
            ([10.0, 10.0, 1000.0], [0.0, 0.0, -1.0], 997.0),
            ([40.0, 21.8, -5.0], [-1.0, 0.0, 0.0], 17.6),
            ([40.0, 21.0, 2.0], [-1.0, 0.0, 0.0], 18.0),
        ];
        for (from, direction, contact) in ways {
            let to = |far: f64| [0, 1, 2].map(|i| from[i] + direction[i] * far);
            let (met, _) = block(3.0, from, to(contact + 1e-3))
                .unwrap_or_else(|| panic!("{from:?} meets nothing"));
            assert!((met - contact).abs() < 1e-9, "{from:?}: {met}");
            assert_eq!(block(3.0, from, to(contact - 1e-3)), None, "{from:?}");
        }
    }

    fn round(hole: bool, from: [f64; 3], to: [f64; 3]) -> Option<f64> {
        // Diameter 20 about the tool axis, top at z = 0, ball radius 3.
        let surface = Surface::Round(Round {
            center: Vec3::ZERO,
            radius: 10.0,
            hole,
            drawn_depth: 5.0,
            plate: None,
        });
        let (from, to) = (Vec3::from_array(from), Vec3::from_array(to));
        Obstacles::of(&[surface], Vec3::Z)
            .first_contact(3.0, from, to)
            .map(|c| c.center.distance(from))
    }

    #[test]
    fn a_hole_is_met_from_inside() {
        assert_eq!(round(true, [0.0, 0.0, -5.0], [20.0, 0.0, -5.0]), Some(7.0));
        assert_eq!(round(true, [0.0, 0.0, -5.0], [6.9, 0.0, -5.0]), None);
        // Off the middle by 4.2: 7² = 4.2² + 5.6².
        let met = round(true, [0.0, 4.2, -5.0], [20.0, 4.2, -5.0]).unwrap();
        assert!((met - 5.6).abs() < 1e-12);
        assert_eq!(
            round(true, [7.0, 0.0, -5.0], [0.0, 0.0, -5.0]),
            None,
            "leaving the wall"
        );
        assert_eq!(
            round(true, [0.0, 0.0, 3.0], [40.0, 0.0, 3.0]),
            None,
            "over the top"
        );
        assert_eq!(
            round(true, [0.0, 0.0, 20.0], [0.0, 0.0, -20.0]),
            None,
            "down the middle"
        );
        assert_eq!(
            round(true, [12.0, 0.0, 20.0], [12.0, 0.0, -20.0]),
            Some(17.0),
            "down on the top side at the rim"
        );
        assert_eq!(
            round(true, [20.0, 0.0, -5.0], [0.0, 0.0, -5.0]),
            Some(7.0),
            "through the wall from outside"
        );
        assert_eq!(
            round(true, [30.0, 0.0, 20.0], [30.0, 0.0, -20.0]),
            None,
            "far outside nothing is known"
        );
    }

    #[test]
    fn a_stud_is_met_from_outside() {
        assert_eq!(round(false, [20.0, 0.0, -5.0], [0.0, 0.0, -5.0]), Some(7.0));
        // At a distance of 13 it passes; at 12 there is contact at 13² = 12² + 5².
        assert_eq!(round(false, [-20.0, 13.0, -5.0], [20.0, 13.0, -5.0]), None);
        assert_eq!(
            round(false, [-20.0, 12.0, -5.0], [20.0, 12.0, -5.0]),
            Some(15.0)
        );
        assert_eq!(
            round(false, [13.0, 0.0, -5.0], [20.0, 0.0, -5.0]),
            None,
            "leaving it"
        );
        assert_eq!(
            round(false, [13.0, 0.0, -5.0], [12.0, 0.0, -5.0]),
            Some(0.0)
        );
        // 1.8 above its edge a ball of radius 3 touches 2.4 before the edge; above the top it passes.
        let met = round(false, [20.0, 0.0, 1.8], [0.0, 0.0, 1.8]).unwrap();
        assert!((met - 7.6).abs() < 1e-12);
        assert_eq!(round(false, [20.0, 0.0, 3.0], [-20.0, 0.0, 3.0]), None);
        assert_eq!(round(false, [0.0, 0.0, 20.0], [0.0, 0.0, 0.0]), Some(17.0));
    }
}
