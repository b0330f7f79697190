//! The scene of a program without a job: its moves, and nothing else.

use std::f64::consts::TAU;

use super::{Line, Projection, Scene, Stroke, TouchShape};
use crate::geom::{Plane, Vec2, Vec3};
use crate::path::Arc;

/// The kind of a probing move.
const PROBING: u8 = 2;

/// The touches of a program with more of them have no numbers: these would cover the path.
const MOST_NUMBERED: usize = 50;

/// The moves of a program that nothing else is known of.
#[derive(Clone, Copy, Debug)]
pub struct Moves<'a> {
    /// Where the first one begins; NaN is not known.
    pub start: [f64; 3],
    /// Where each ends, three numbers a move; NaN is not known.
    pub to: &'a [f64],
    /// What each is: 0 rapid, 1 at a feed, 2 probing.
    pub kind: &'a [u8],
    /// The arcs: index of the move, centre, degrees, and their plane: 17, 18 or 19.
    pub arcs: &'a [[f64; 6]],
    /// Where probing moves met something: index of the move, and the place. The next move begins there.
    pub contacts: &'a [[f64; 4]],
    /// Where moves begin that do not begin where the one before ended.
    pub resumes: &'a [[f64; 4]],
    /// The plane that it is seen in.
    pub plane: Plane,
    /// Millimetres in a unit of the program, where it says its units.
    pub scale: Option<f64>,
}

/// The scene of a program's moves: lines, and the numbers of its probing moves where these end. A move to or from a place that is not known is not seen.
pub fn scene(moves: &Moves<'_>, view: Projection) -> Scene {
    let spot = |p: Vec3| view.place(moves.plane, p);
    let mut scene = Scene {
        unit: moves.scale,
        ..Scene::about(moves.plane, view)
    };
    scene.lines.reserve(moves.kind.len());
    scene.ends.reserve(moves.kind.len());
    // Sixty to a circle; fewer where there are very many.
    let most = (200_000 / moves.arcs.len().max(1)).clamp(3, 60);
    let scale = moves.scale.unwrap_or(1.0);
    let mut arcs = moves.arcs.iter().peekable();
    let mut contacts = moves.contacts.iter().peekable();
    let mut resumes = moves.resumes.iter().peekable();
    let mut from = Vec3::from(moves.start) * scale;
    let numbered = moves.kind.iter().filter(|kind| **kind == PROBING).count() <= MOST_NUMBERED;
    let mut number = 0;
    for (index, (to, kind)) in moves.to.chunks_exact(3).zip(moves.kind).enumerate() {
        let end = Vec3::from_slice(to) * scale;
        if let Some([_, x, y, z]) = resumes.next_if(|place| place[0] == index as f64) {
            from = Vec3::new(*x, *y, *z) * scale;
        }
        let arc = arcs
            .next_if(|arc| arc[0] == index as f64)
            .map(|[_, a, b, c, sweep, plane]| {
                let plane = [Plane::G17, Plane::G18, Plane::G19]
                    [(*plane as usize).saturating_sub(17).min(2)];
                let center = Vec3::new(*a, *b, *c) * scale;
                (
                    Arc {
                        center,
                        sweep: sweep.to_radians(),
                    },
                    plane.basis()[2],
                )
            });
        if from.is_finite() && end.is_finite() {
            let stroke = match *kind {
                0 => Stroke::Position,
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
                    rapid: *kind == 0,
                    back: false,
                    behind: None,
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
        let contact = contacts.next_if(|contact| contact[0] == index as f64);
        let begin = from;
        from = contact.map_or(end, |[_, x, y, z]| Vec3::new(*x, *y, *z) * scale);
        if *kind != PROBING {
            continue;
        }
        number += 1;
        if numbered && begin.is_finite() && from.is_finite() {
            let at = spot(from);
            scene.touches.push(TouchShape {
                contact: at,
                ball: at,
                trigger: None,
                number,
                named: None,
                pale: false,
                inward: (spot(begin) - at).normalize_or_zero(),
                index: Some(index),
                behind: None,
            });
        }
    }
    scene
}

/// The ends of the straight pieces of a move: an arc about its axis, or a helix, of which a whole turn has at most so many.
fn helix(from: Vec3, end: Vec3, arc: Option<(Arc, Vec3)>, most: usize) -> Vec<Vec3> {
    match arc {
        None => vec![end],
        Some((arc, up)) => arc.pieces(from, end, up, arc.sweep.abs() / TAU * most as f64),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a circle of one inch, as a helix: through its top, and up as it goes. What is not known is not seen.
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
            arcs: &arcs,
            contacts: &[],
            resumes: &[],
            plane: Plane::G17,
            scale: Some(25.4),
        };
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

    /// A touch is drawn to where it would search; the way back begins where it met something. The first move begins where the program is said to start.
    #[test]
    fn a_move_begins_where_the_touch_before_it_ended() {
        let to = [0.0, 0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 4.0, 0.0];
        let moves = Moves {
            start: [0.0, 0.0, 5.0],
            to: &to,
            kind: &[0, 2, 1],
            arcs: &[],
            contacts: &[[1.0, 6.0, 0.0, 0.0]],
            resumes: &[],
            plane: Plane::G17,
            scale: Some(1.0),
        };
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
