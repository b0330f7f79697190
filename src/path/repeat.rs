//! Repeated touches of one point.

use crate::geom::Vec3;
use crate::path::{Move, MovePurpose, Path, Touch};

impl Path {
    /// The path with every touch made `times` times, each after the retract from the previous one. The formula computes with the means. The touches of one
    /// point may differ by no more than `limit`, mm.
    pub fn repeated(mut self, times: usize, limit: Option<f64>) -> Path {
        let directions = self.directions();
        self.formula = self.formula.repeated(times, &directions, limit);
        let nth = |k: usize, n: usize| times * k + n;
        let again = |touch: &Touch| {
            (0..times)
                .map(|n| Touch {
                    sample: nth(touch.sample, n),
                    ..*touch
                })
                .collect::<Vec<_>>()
        };
        self.touches = self.touches.iter().flat_map(again).collect();
        let moves = std::mem::take(&mut self.moves);
        for (index, step) in moves.iter().enumerate() {
            match step.purpose {
                MovePurpose::Position => self.moves.push(*step),
                // The touch with its retract.
                MovePurpose::Touch(k) => {
                    let back = moves
                        .get(index + 1)
                        .filter(|next| next.purpose == MovePurpose::Retract(k));
                    for n in 0..times {
                        self.moves.push(Move {
                            purpose: MovePurpose::Touch(nth(k, n)),
                            ..*step
                        });
                        self.moves.extend(back.map(|back| Move {
                            purpose: MovePurpose::Retract(nth(k, n)),
                            ..*back
                        }));
                    }
                }
                // Retracts are copied with their touches. Searches belong to native cycles, which repeat nothing.
                MovePurpose::Retract(_) | MovePurpose::Search(_) => {}
            }
        }
        self
    }

    /// The probing direction of each sample.
    fn directions(&self) -> Vec<Vec3> {
        let count = self
            .touches
            .iter()
            .map(|touch| touch.sample + 1)
            .max()
            .unwrap_or(0);
        let mut directions = vec![Vec3::ZERO; count];
        self.touches
            .iter()
            .for_each(|touch| directions[touch.sample] = touch.vector);
        directions
    }
}
