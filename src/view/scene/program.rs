//! Scene of a program without a job: its moves.

use std::f64::consts::TAU;

use super::{Line, Projection, Scene, Stroke, TouchShape};
use crate::geom::{Plane, Vec2, Vec3};
use crate::path::{Arc, RAPID_RATE};

/// Kinds of rapids and of probing moves.
const RAPID: u8 = 0;
const PROBING: u8 = 2;

/// Programs with more touches have no numbers: these would cover the path.
const MOST_NUMBERED: usize = 50;

/// Moves of a program without a job.
#[derive(Clone, Copy, Debug)]
pub struct Moves<'a> {
    /// Start of the first move; NaN is unknown.
    pub start: [f64; 3],
    /// Ends, three numbers a move; NaN is unknown.
    pub to: &'a [f64],
    /// Kinds: 0 rapid, 1 at a feed, 2 probing.
    pub kind: &'a [u8],
    /// Feeds, units per minute; NaN is unknown.
    pub feed: &'a [f64],
    /// Arcs: index of the move, centre, degrees, and their plane: 17, 18 or 19.
    pub arcs: &'a [[f64; 6]],
    /// Contacts of probing moves: index of the move, and position. The next move begins there.
    pub contacts: &'a [[f64; 4]],
    /// Starts of moves that do not begin at the end of the previous one.
    pub resumes: &'a [[f64; 4]],
    /// Plane of the view.
    pub plane: Plane,
    /// Millimetres in a unit of the program, if it states its units.
    pub scale: Option<f64>,
}

/// A move of a program, mm; NaN is unknown.
struct Way {
    from: Vec3,
    /// End without a contact.
    end: Vec3,
    /// Contact, if there was one.
    contact: Option<Vec3>,
    /// Arc, and its axis.
    arc: Option<(Arc, Vec3)>,
}

impl Moves<'_> {
    fn ways(&self) -> impl Iterator<Item = Way> + '_ {
        let scale = self.scale.unwrap_or(1.0);
        let mut arcs = self.arcs.iter().peekable();
        let mut contacts = self.contacts.iter().peekable();
        let mut resumes = self.resumes.iter().peekable();
        let mut at = Vec3::from(self.start) * scale;
        let place = move |[_, x, y, z]: &[f64; 4]| Vec3::new(*x, *y, *z) * scale;
        self.to.chunks_exact(3).enumerate().map(move |(index, to)| {
            let here = |entry: &f64| *entry == index as f64;
            let from = resumes.next_if(|entry| here(&entry[0])).map_or(at, place);
            let arc = arcs
                .next_if(|entry| here(&entry[0]))
                .map(|[_, a, b, c, sweep, plane]| {
                    let plane = [Plane::G17, Plane::G18, Plane::G19]
                        [(*plane as usize).saturating_sub(17).min(2)];
                    let arc = Arc {
                        center: Vec3::new(*a, *b, *c) * scale,
                        sweep: sweep.to_radians(),
                    };
                    (arc, plane.basis()[2])
                });
            let end = Vec3::from_slice(to) * scale;
            let contact = contacts.next_if(|entry| here(&entry[0])).map(place);
            at = contact.unwrap_or(end);
            Way {
                from,
                end,
                contact,
                arc,
            }
        })
    }

    /// Time of each move, seconds: a rapid at the catalog's `rapidRate`. NaN if its feed, its length or the units are unknown.
    pub fn seconds(&self) -> Vec<f64> {
        let scale = self.scale.unwrap_or(f64::NAN);
        let seconds = |((way, kind), feed): ((Way, &u8), &f64)| {
            let length = match way.arc {
                Some((arc, up)) => {
                    let radius = (way.from - arc.center).reject_from_normalized(up).length();
                    (radius * arc.sweep).hypot((way.end - way.from).dot(up))
                }
                None => way.from.distance(way.contact.unwrap_or(way.end)),
            };
            let rate = if *kind == RAPID {
                RAPID_RATE
            } else {
                feed * scale
            };
            60.0 * length / rate
        };
        self.ways()
            .zip(self.kind)
            .zip(self.feed)
            .map(seconds)
            .collect()
    }
}

/// Scene of a program's moves: lines, and the numbers of its probing moves at their ends. A move from or to an unknown position is not drawn.
pub fn scene(moves: &Moves<'_>, view: Projection) -> Scene {
    let spot = |p: Vec3| view.place(moves.plane, p);
    let mut scene = Scene {
        unit: moves.scale,
        ..Scene::about(moves.plane, view)
    };
    scene.lines.reserve(moves.kind.len());
    scene.ends.reserve(moves.kind.len());
    // Sixty pieces to a circle; fewer if there are very many arcs.
    let most = (200_000 / moves.arcs.len().max(1)).clamp(3, 60);
    let numbered = moves.kind.iter().filter(|kind| **kind == PROBING).count() <= MOST_NUMBERED;
    let mut number = 0;
    for (index, (way, kind)) in moves.ways().zip(moves.kind).enumerate() {
        let Way { from, end, arc, .. } = way;
        if from.is_finite() && end.is_finite() {
            let stroke = match *kind {
                RAPID => Stroke::Position,
                PROBING => Stroke::Touch,
                _ => Stroke::Link,
            };
            let pieces = helix(from, end, arc, most);
            let mut from = spot(from);
            for piece in &pieces {
                let to = spot(*piece);
                scene.lines.push(Line {
                    from,
                    to,
                    stroke,
                    rapid: *kind == RAPID,
                    back: false,
                    occluder: None,
                    pale: false,
                    index,
                });
                from = to;
            }
            scene
                .beyond
                .extend(pieces[..pieces.len() - 1].iter().map(|p| spot(*p)));
        }
        scene.ends.push(if end.is_finite() {
            spot(end)
        } else {
            Vec2::NAN
        });
        if *kind != PROBING {
            continue;
        }
        number += 1;
        let stop = way.contact.unwrap_or(end);
        if numbered && from.is_finite() && stop.is_finite() {
            let at = spot(stop);
            scene.touches.push(TouchShape {
                contact: at,
                ball: at,
                trigger: None,
                number,
                named: None,
                pale: false,
                inward: (spot(from) - at).normalize_or_zero(),
                index: Some(index),
                behind: None,
            });
        }
    }
    scene
}

/// Ends of the straight pieces of a move: an arc about its axis, or a helix, with at most `most` pieces to a turn.
fn helix(from: Vec3, end: Vec3, arc: Option<(Arc, Vec3)>, most: usize) -> Vec<Vec3> {
    match arc {
        None => vec![end],
        Some((arc, up)) => arc.pieces(from, end, up, arc.sweep.abs() / TAU * most as f64),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a circle of one inch, as a helix: through its top, rising. Unknown parts are not drawn.
    #[test]
    fn a_program_in_inch_is_seen_in_millimetres() {
        let to = [
            0.0,
            0.0,
            0.0,
            2.0,
            0.0,
            1.0,
            f64::NAN,
            5.0,
            5.0,
            0.0,
            0.0,
            0.0,
        ];
        let arcs = [[1.0, 1.0, 0.0, 1.0, -180.0, 17.0]];
        let moves = Moves {
            start: [f64::NAN; 3],
            to: &to,
            kind: &[0, 1, 0, 2],
            feed: &[f64::NAN, 100.0, f64::NAN, f64::NAN],
            arcs: &arcs,
            contacts: &[],
            resumes: &[],
            plane: Plane::G17,
            scale: Some(25.4),
        };
        // Half a circle of radius 1 in that rises by 1 in, at 100 in/min.
        let half = std::f64::consts::PI.hypot(1.0) / 100.0 * 60.0;
        assert!((moves.seconds()[1] - half).abs() < 1e-9);
        let near = |a: Vec2, b: [f64; 2]| a.abs_diff_eq(b.into(), 1e-9);
        let top = scene(&moves, Projection::Top);
        assert!(
            top.unit == Some(25.4) && near(top.lines[14].to, [25.4, 25.4]),
            "{:?}",
            top.lines[14]
        );
        let front = scene(&moves, Projection::Front);
        assert!(
            near(front.lines[14].to, [25.4, 12.7]) && near(front.lines[29].to, [50.8, 25.4]),
            "{:?}",
            front.lines[14]
        );
        assert_eq!(
            front.lines.len(),
            30,
            "neither to nor from a place that is not known"
        );
        assert!(
            scene(
                &Moves {
                    scale: None,
                    ..moves
                },
                Projection::Top
            )
            .unit
            .is_none()
        );
    }

    /// A touch is drawn to the end of its search; the retract begins at its contact. The first move begins at the stated start.
    #[test]
    fn a_move_begins_where_the_touch_before_it_ended() {
        let to = [0.0, 0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 4.0, 0.0];
        let moves = Moves {
            start: [0.0, 0.0, 5.0],
            to: &to,
            kind: &[0, 2, 1],
            feed: &[f64::NAN, 120.0, 240.0],
            arcs: &[],
            contacts: &[[1.0, 6.0, 0.0, 0.0]],
            resumes: &[],
            plane: Plane::G17,
            scale: Some(1.0),
        };
        // 5 mm at the rapid rate, 6 mm to the contact at F120, √52 mm back at F240.
        let near = |(seconds, hand): (&f64, f64)| (seconds - hand).abs() < 1e-9;
        let hand = [60.0 * 5.0 / RAPID_RATE, 3.0, 52.0_f64.sqrt() / 4.0];
        assert!(
            moves.seconds().iter().zip(hand).all(near),
            "{:?}",
            moves.seconds()
        );
        let without_units = Moves {
            scale: None,
            ..moves
        };
        assert!(without_units.seconds()[1].is_nan());
        let unknown = Moves {
            start: [0.0, 0.0, f64::NAN],
            ..moves
        };
        assert_eq!(scene(&unknown, Projection::Top).lines.len(), 2);
        let Scene { lines, touches, .. } = scene(&moves, Projection::Top);
        let numbered = touches
            .iter()
            .map(|touch| (touch.number, touch.contact.to_array(), touch.index));
        assert_eq!(numbered.collect::<Vec<_>>(), [(1, [6.0, 0.0], Some(1))]);
        assert_eq!(
            [lines[1].to, lines[2].from, lines[2].to].map(|at| at.to_array()),
            [[10.0, 0.0], [6.0, 0.0], [0.0, 4.0]]
        );
    }
}
