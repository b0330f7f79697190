//! What the macros do, move by move: a machine whose probing moves something answers, the nominal part, the actual one, or what a run knows.
//!
//! Facts are those of the macros themselves, version 3.14 for Haas NGC [S]; their feeds and the way back between the two touches are settings of an
//! installation [I: those of that edition].

use crate::geom::Vec3;

/// What a ball meets on a straight way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// Its centre there.
    pub center: Vec3,
    /// Which surface it is; 0 where that does not matter.
    pub surface: usize,
    /// Whether it is an edge, a corner or a rim.
    pub edge: bool,
}

/// What stops a macro.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alarm {
    /// 86: a contact in a protected move.
    Obstructed,
    /// 91: its arguments contradict each other.
    Arguments,
    /// 92: a contact on the way, or at the start of a touch.
    Unexpected,
    /// 93: no contact.
    NotFound,
    /// A move that nothing watches meets something.
    Collision,
}

/// What a move is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Watched positioning: G31 with a comparison.
    Watched,
    /// Rapid, unwatched.
    Rapid,
    /// The first, fast touch of the two.
    Search,
    /// The second, slow one.
    Measure,
    /// Back from a touch, by a feed.
    Back,
}

/// A move that was made: of a touch, `to` is the end of its search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Made {
    pub kind: Kind,
    pub to: Vec3,
    pub met: Option<Met>,
    /// mm/min; none is a rapid.
    pub rate: Option<f64>,
    /// Which of the moves that the calls ask for it is, those of no length counted: the same on any part.
    pub count: usize,
}

/// Feeds of the macros, mm/min: positioning, going down and the first touch, the second touch.
pub const FAST: f64 = 5000.0;
pub const SEARCH: f64 = 0.6 * FAST;
pub const MEASURE: f64 = 102.0;

/// From the first contact back to where the second touch begins, mm: 8 mm times a factor of the calibration, 0.2 unless it was found.
pub const BACK_OFF: f64 = 1.6;

/// A stop so near to a place is at that place, mm.
pub const IN_POSITION: f64 = 0.05;

/// Answers a way of the ball's centre from one place to another: of a touch with the place where the call expects the contact.
pub type Answers<'w> = &'w mut dyn FnMut(Vec3, Vec3, Option<Vec3>) -> Option<Met>;

/// A machine that runs macros. Places are of the ball's centre, mm.
pub struct Machine<'w> {
    answers: Answers<'w>,
    pub at: Vec3,
    /// Radius of the ball, as calibrated.
    pub radius: f64,
    /// How far the ball's centre is above what a program's heights are of: its radius where the length of the probe ends at the tip, as P9801 sets it.
    tip: f64,
    pub made: Vec<Made>,
    count: usize,
}

impl<'w> Machine<'w> {
    pub fn new(at: Vec3, radius: f64, tip: f64, answers: Answers<'w>) -> Self {
        Machine { answers, at, radius, tip, made: Vec::new(), count: 0 }
    }

    fn push(&mut self, kind: Kind, to: Vec3, met: Option<Met>, rate: Option<f64>) {
        self.made.push(Made { kind, to, met, rate, count: self.count });
        self.count += 1;
    }

    /// The height of the ball's centre for a height of a program.
    pub fn height(&self, programmed: f64) -> f64 {
        programmed + self.tip
    }

    /// A watched move.
    pub fn watched(&mut self, to: Vec3, rate: f64, alarm: Alarm) -> Result<(), Alarm> {
        let met = (self.answers)(self.at, to, None);
        self.push(Kind::Watched, to, met, Some(rate));
        // A stop within the zone is no contact, as the macros compare.
        if let Some(met) = met.filter(|met| met.center.distance(to) >= IN_POSITION) {
            self.at = met.center;
            return Err(alarm);
        }
        self.at = to;
        Ok(())
    }

    /// A move that nothing watches.
    pub fn plain(&mut self, to: Vec3, kind: Kind) -> Result<(), Alarm> {
        let rate = if kind == Kind::Rapid { None } else { Some(FAST) };
        if to.distance(self.at) < 1e-9 {
            self.count += 1;
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

    /// The two touches towards a place, up to `q` behind it, and back: where the ball's centre was at the second contact. The contact is expected
    /// `before` the place: by a radius where that is a point of the surface.
    pub fn measure(&mut self, place: Vec3, q: f64, before: f64) -> Result<Vec3, Alarm> {
        let start = self.at;
        let way = place - start;
        if way.length() < 1e-9 {
            return Err(Alarm::Unexpected);
        }
        let along = way.normalize();
        let (end, expected) = (place + along * q, place - along * before);
        let first = self.touch(end, expected, Kind::Search, SEARCH)?;
        self.plain(first - along * BACK_OFF, Kind::Back)?;
        let contact = self.touch(end, expected, Kind::Measure, MEASURE)?;
        self.plain(start, Kind::Back)?;
        Ok(contact)
    }

    fn touch(&mut self, end: Vec3, expected: Vec3, kind: Kind, rate: f64) -> Result<Vec3, Alarm> {
        let start = self.at;
        let met = (self.answers)(start, end, Some(expected));
        self.push(kind, end, met, Some(rate));
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
