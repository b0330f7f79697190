//! Simulated machine for native cycles. A callback answers each probing move: the nominal part, the actual part or the inputs of a run.

use crate::geom::Vec3;
use crate::path::{Arc, Feed, Move, MovePurpose};

/// A contact of the ball on a straight move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallContact {
    /// Ball centre at the contact.
    pub center: Vec3,
    /// Index of the surface; 0 if that does not matter.
    pub surface: usize,
    /// Whether it is an edge, a corner or a rim.
    pub edge: bool,
}

/// Alarm of a cycle. The numbers are those of Renishaw's macros.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alarm {
    /// 86: a contact in a protected move.
    Obstructed,
    /// 91: its arguments contradict each other.
    Arguments,
    /// 92: a contact before a touch, or at its start.
    Unexpected,
    /// 93: no contact.
    NotFound,
    /// A contact in an unwatched move.
    Collision,
}

/// Kind of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MoveKind {
    /// Watched positioning: G31 with a comparison.
    Watched,
    /// Rapid, unwatched.
    Rapid,
    /// The first, fast touch of the two.
    Search,
    /// The second, slow one.
    Measure,
    /// The touch of a cycle that touches once.
    SingleTouch,
    /// Retract from a touch, at a feed.
    Retract,
}

/// A simulated move. For a touch `to` is the end of its search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExecutedMove {
    pub kind: MoveKind,
    pub to: Vec3,
    pub met: Option<BallContact>,
    /// Feed, mm/min; `None` is a rapid, or unknown.
    pub rate: Option<f64>,
    /// Arc of the move; `None` is straight.
    pub arc: Option<Arc>,
    /// Ordinal among the moves that the calls make, including those without length: the same on any part.
    pub ordinal: usize,
}

/// A stop this close to a position counts as reaching it, mm.
pub const IN_POSITION: f64 = 0.05;

/// Angle of the pieces by which an arc is followed, degrees.
const PIECE: f64 = 3.0;

/// Answers a move of the ball centre between two positions. A touch also gives the expected contact.
pub type ContactSource<'w> = &'w mut dyn FnMut(Vec3, Vec3, Option<Vec3>) -> Option<BallContact>;

/// A machine that runs cycles. Positions are ball centres, mm.
pub struct Machine<'w> {
    answers: ContactSource<'w>,
    pub at: Vec3,
    /// Calibrated radius of the ball.
    pub radius: f64,
    /// Height of the ball centre above the programmed heights: the ball radius if the length ends at the tip.
    pub tip: f64,
    pub made: Vec<ExecutedMove>,
    /// Outputs of the cycles so far, by number: mm or degrees.
    pub outputs: Vec<(u16, f64)>,
    count: usize,
}

impl<'w> Machine<'w> {
    pub fn new(at: Vec3, radius: f64, tip: f64, answers: ContactSource<'w>) -> Self {
        Machine {
            answers,
            at,
            radius,
            tip,
            made: Vec::new(),
            outputs: Vec::new(),
            count: 0,
        }
    }

    fn push(&mut self, kind: MoveKind, to: Vec3, met: Option<BallContact>, rate: Option<f64>) {
        self.made.push(ExecutedMove {
            kind,
            to,
            met,
            rate,
            arc: None,
            ordinal: self.count,
        });
        self.count += 1;
    }

    /// Height of the ball centre for a programmed height.
    pub fn height(&self, programmed: f64) -> f64 {
        programmed + self.tip
    }

    /// A watched move.
    pub fn watched(&mut self, to: Vec3, rate: Option<f64>, alarm: Alarm) -> Result<(), Alarm> {
        let met = (self.answers)(self.at, to, None);
        self.push(MoveKind::Watched, to, met, rate);
        // A stop within the zone is no contact, as the macros compare.
        if let Some(met) = met.filter(|met| met.center.distance(to) >= IN_POSITION) {
            self.at = met.center;
            return Err(alarm);
        }
        self.at = to;
        Ok(())
    }

    /// Whether the ball is there already: such a move is counted but not made.
    fn is_at(&mut self, to: Vec3) -> bool {
        let there = to.distance(self.at) < 1e-9;
        self.count += usize::from(there);
        there
    }

    /// A watched move at the control's rapid rate; nothing if the ball is there already.
    pub fn goes(&mut self, to: Vec3) -> Result<(), Alarm> {
        if self.is_at(to) {
            Ok(())
        } else {
            self.watched(to, None, Alarm::Unexpected)
        }
    }

    /// One touch in a direction, searching `behind` past the expected contact, and its retract. Returns the ball centre at the contact.
    pub fn touches_once(
        &mut self,
        contact: Vec3,
        towards: Vec3,
        behind: f64,
    ) -> Result<Vec3, Alarm> {
        let start = self.at;
        let met = self.touch(
            contact + towards * behind,
            contact,
            MoveKind::SingleTouch,
            None,
        )?;
        self.plain(start, MoveKind::Retract, None)?;
        Ok(met)
    }

    /// An unwatched move.
    pub fn plain(&mut self, to: Vec3, kind: MoveKind, rate: Option<f64>) -> Result<(), Alarm> {
        if self.is_at(to) {
            return Ok(());
        }
        let met = (self.answers)(self.at, to, None);
        self.push(kind, to, met, rate);
        if let Some(met) = met {
            self.at = met.center;
            return Err(Alarm::Collision);
        }
        self.at = to;
        Ok(())
    }

    /// A watched move along an arc about Z.
    pub fn along(&mut self, arc: Arc, alarm: Alarm) -> Result<(), Alarm> {
        let arm = self.at - arc.center;
        let (sin, cos) = arc.sweep.sin_cos();
        let to =
            arc.center + Vec3::new(arm.x * cos - arm.y * sin, arm.x * sin + arm.y * cos, arm.z);
        let step = Move {
            to,
            feed: Feed::Rapid,
            purpose: MovePurpose::Position,
            step: 1,
            arc: Some(arc),
        };
        let (mut from, mut met) = (self.at, None);
        for end in step.pieces(self.at, Vec3::Z, PIECE) {
            met = (self.answers)(from, end, None);
            if met.is_some() {
                break;
            }
            from = end;
        }
        self.push(MoveKind::Watched, to, met, None);
        self.made
            .last_mut()
            .into_iter()
            .for_each(|made| made.arc = Some(arc));
        self.at = met.map_or(to, |met| met.center);
        if met.is_some() { Err(alarm) } else { Ok(()) }
    }

    /// A touch towards the end of its search, with the expected contact.
    pub fn touch(
        &mut self,
        end: Vec3,
        expected: Vec3,
        kind: MoveKind,
        rate: Option<f64>,
    ) -> Result<Vec3, Alarm> {
        let start = self.at;
        let met = (self.answers)(start, end, Some(expected));
        self.push(kind, end, met, rate);
        let Some(met) = met.filter(|met| met.center.distance(end) >= IN_POSITION) else {
            self.at = end;
            return Err(Alarm::NotFound);
        };
        self.at = met.center;
        if met.center.distance(start) < IN_POSITION {
            return Err(Alarm::Unexpected);
        }
        Ok(met.center)
    }
}
