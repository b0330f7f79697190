//! Builds the moves of a path one after the other.

use crate::geom::Vec3;
use crate::path::{Arc, Feed, Move, MovePurpose, ProbeSettings, Touch, ZERO_LENGTH};

/// Builds a path move by move and leaves out moves without length.
#[derive(Debug)]
pub struct Tracer {
    at: Option<Vec3>,
    radius: f64,
    moves: Vec<Move>,
}

impl Tracer {
    /// Starts at an unknown position: the first move is always kept.
    pub fn new(setup: &ProbeSettings) -> Self {
        Tracer {
            at: None,
            radius: setup.radius,
            moves: Vec::new(),
        }
    }

    /// Starts at a known ball centre.
    pub fn starting_at(setup: &ProbeSettings, start: Vec3) -> Self {
        Tracer {
            at: Some(start),
            ..Tracer::new(setup)
        }
    }

    pub fn position(&mut self, to: Vec3, feed: Feed, step: u8) {
        self.push(Move {
            to,
            feed,
            purpose: MovePurpose::Position,
            step,
            arc: None,
        });
    }

    /// A positioning move along an arc.
    pub fn arc(&mut self, to: Vec3, arc: Arc, feed: Feed, step: u8) {
        self.push(Move {
            to,
            feed,
            purpose: MovePurpose::Position,
            step,
            arc: Some(arc),
        });
    }

    /// Current ball centre; `None` before the first move.
    pub fn place(&self) -> Option<Vec3> {
        self.at
    }

    /// The touch with this index from the current position and its retract, as one step.
    pub fn touch(&mut self, index: usize, touch: &Touch, back: Feed, step: u8) {
        self.touch_in_steps(index, touch, back, [step, step]);
    }

    /// The touch and its retract as two steps.
    pub fn touch_in_steps(&mut self, index: usize, touch: &Touch, back: Feed, steps: [u8; 2]) {
        let from = self.at.expect("a touch starts at a known place");
        let to = touch.contact(self.radius);
        self.push(Move {
            to,
            feed: Feed::Work,
            purpose: MovePurpose::Touch(index),
            step: steps[0],
            arc: None,
        });
        self.push(Move {
            to: from,
            feed: back,
            purpose: MovePurpose::Retract(index),
            step: steps[1],
            arc: None,
        });
    }

    pub fn moves(self) -> Vec<Move> {
        self.moves
    }

    /// Touches and retracts are kept even without length: the check of the whole path reports them.
    fn push(&mut self, next: Move) {
        if next.purpose != MovePurpose::Position
            || self.at.is_none_or(|at| at.distance(next.to) > ZERO_LENGTH)
        {
            self.at = Some(next.to);
            self.moves.push(next);
        }
    }
}
