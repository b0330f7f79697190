//! The path of a cycle: touches, moves, the nominal feature, and what the control computes from the touches.
//!
//! Lengths are in mm, angles in radians unless a name says degrees. Points are of the ball centre in the work coordinate
//! system unless they are said to be on the surface. A path knows nothing of cycles, controls or units.

mod feature;
mod follow;
mod own;
mod parameter;
mod repeat;
mod set_up;
mod surface;
mod tracer;

pub use feature::{
    Bore, Corner, Entry, Feature, Pairs, Point, Setting, Side, Spread, Straight, Subject, Top,
    Touched, TwoCircles,
};
pub use follow::{Along, Follow, Follows, Reaches, Shifts, Term, far_apart, most};
pub use own::{Guard, Off, Own, OwnBlock, Quantity, Reach, Stored};
pub use parameter::{Accessor, Parameter, ParameterValue};
pub use set_up::{DatumSource, Measuring, Member, Related, WAY, WayBlock};
pub use surface::{Round, Surface, Wall};
pub use tracer::Tracer;

use crate::formula::Formula;
use crate::geom::{Frame, Plane, Vec3};

/// The most touches a path may have: touch 17 of a CAM parameter table would start at code −196 and run into the −200 block.
pub const MAX_TOUCHES: usize = 16;

// Each touch of such a table may be a sample of its own.
const _: () = assert!(MAX_TOUCHES <= crate::formula::MOST_SAMPLES);

/// The rate that rapids are taken to have where a time is stated, mm/min. Machines differ; only the estimate depends on it.
pub const RAPID_RATE: f64 = 5000.0;

/// The feed of a rapid that needs a stated one, mm/min: watched moves do, and arcs. Slow enough for a machine to stop within what a stylus takes.
pub const STATED_RAPID: f64 = 2000.0;

/// Moves shorter than this, in mm, are none.
pub const ZERO_LENGTH: f64 = 1e-9;

/// The shortest way from where a touch begins to its nominal contact, mm: a clearance is at least so much more than the ball radius.
/// Less would be lost in a program's last decimals, and the ball would begin in contact.
pub const SHORTEST_TOUCH: f64 = 0.01;

/// How far a touch may run askew of its inverted target vector, degrees.
pub const MOST_ASKEW: f64 = 1.0;

/// Touches whose heights differ by no more than this, mm, are at one level: picks come rounded out of a dump.
pub const ONE_LEVEL: f64 = 0.01;

/// What a cycle needs to know of the job around it.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    pub plane: Plane,
    /// Radius of the stylus ball, mm; 0 is a point.
    pub radius: f64,
    /// How far past the nominal contact a touch searches, mm.
    pub overtravel: f64,
}

/// Which of the cycle's feeds a move uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feed {
    /// From the feed distance to the start.
    Approach,
    /// Positioning inside the cycle.
    LongLink,
    /// The touch itself.
    Work,
    /// Back from a surface touch.
    Retract,
    /// The last lift.
    Return,
    /// The first, fast touch of the two that a native cycle makes.
    Search,
    /// As fast as the control does it, or at a stated rapid rate.
    Rapid,
}

/// The feeds of a path in mm/min; none is rapid.
#[derive(Clone, Copy, Debug)]
pub struct Feeds {
    pub approach: Option<f64>,
    pub long_link: Option<f64>,
    /// Never rapid.
    pub work: f64,
    pub retract: Option<f64>,
    pub return_: Option<f64>,
    /// Of the first touch of a native cycle.
    pub search: Option<f64>,
    /// None is the control's own rate.
    pub rapid: Option<f64>,
}

impl Feeds {
    /// The rate of a move, mm/min; none is as fast as the control does it.
    pub fn rate(&self, feed: Feed) -> Option<f64> {
        match feed {
            Feed::Approach => self.approach,
            Feed::LongLink => self.long_link,
            Feed::Work => Some(self.work),
            Feed::Retract => self.retract,
            Feed::Return => self.return_,
            Feed::Search => self.search,
            Feed::Rapid => self.rapid,
        }
    }

    /// Whether a move is a rapid, by its own name or because its feed is set so.
    pub fn is_rapid(&self, feed: Feed) -> bool {
        feed == Feed::Rapid || self.rate(feed).is_none()
    }
}

/// What a move is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Positioning; the stylus must not meet anything.
    Position,
    /// The touch with this index. Ends at the nominal contact of the ball centre.
    Touch(usize),
    /// The first, fast touch of the two that a native cycle makes of the touch with this index. Ends likewise; what is measured is the second.
    Search(usize),
    /// The way back from the touch with this index.
    Back(usize),
}

/// An arc about the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Its centre, at the height of the move.
    pub center: Vec3,
    /// Radians, counter-clockwise positive seen against the tool axis; less than a whole turn.
    pub sweep: f64,
}

impl Arc {
    /// The ends of straight pieces along it, about as many as given. `up` is its axis; it may rise on its way, as a helix.
    pub fn pieces(self, from: Vec3, to: Vec3, up: Vec3, count: f64) -> Vec<Vec3> {
        let count = count.ceil().max(1.0) as usize;
        let out = from - self.center;
        let (flat, rise) = (out - up * out.dot(up), (to - from).dot(up));
        let across = up.cross(flat);
        let at = |i: usize| {
            let part = i as f64 / count as f64;
            let (sin, cos) = (self.sweep * part).sin_cos();
            self.center + up * (out.dot(up) + rise * part) + flat * cos + across * sin
        };
        (1..count).map(at).chain([to]).collect()
    }
}

/// One move of the ball centre, straight or along an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    pub to: Vec3,
    pub feed: Feed,
    pub purpose: Purpose,
    /// Number of the step in the cycle's documented list, from 1.
    pub step: u8,
    /// The arc it runs along; none is straight. Only positioning moves are arcs.
    pub arc: Option<Arc>,
}

impl Move {
    /// The ends of the straight pieces this move is looked at by: its own end, or an arc in pieces of about `degrees`. `up` is
    /// the tool axis.
    pub fn pieces(&self, from: Vec3, up: Vec3, degrees: f64) -> Vec<Vec3> {
        let Some(arc) = self.arc else {
            return vec![self.to];
        };
        let count = (arc.sweep.abs().to_degrees() / degrees).ceil().max(1.0) as usize;
        let (out, across) = (from - arc.center, up.cross(from - arc.center));
        let at = |i: usize| {
            let (sin, cos) = (arc.sweep * i as f64 / count as f64).sin_cos();
            arc.center + out * cos + across * sin
        };
        (1..count).map(at).chain([self.to]).collect()
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// The nominal point on the surface.
    pub point: Vec3,
    /// The target vector: outward normal of the surface, from the material into free space, a unit vector.
    pub vector: Vec3,
    /// Which wall or circle it belongs to, from 0: the index of its surface.
    pub group: usize,
    /// How far past the nominal contact it searches, mm.
    pub search: f64,
    /// Which of the formula's points it measures; several touches of one point are averaged.
    pub sample: usize,
}

impl Touch {
    /// The nominal contact of a ball's centre.
    pub fn contact(&self, radius: f64) -> Vec3 {
        self.point + self.vector * radius
    }
}

/// Everything a cycle says about itself.
#[derive(Clone, Debug)]
pub struct Path {
    pub touches: Vec<Touch>,
    pub moves: Vec<Move>,
    /// Where the ball is before the first move, where the job says so.
    pub start: Option<Vec3>,
    /// Height of the feature's top side along the tool axis, mm, where the source has one.
    pub top: Option<f64>,
    /// The walls of the nominal feature.
    pub surfaces: Vec<Surface>,
    /// Feeds of the cycle's own, where it does not use the job's.
    pub feeds: Option<Feeds>,
    /// The frame the feature's dimensions are given in.
    pub frame: Frame,
    /// What the control computes from the touches.
    pub formula: Formula,
    pub feature: Feature,
    /// Whether the touches were picked one by one, and do not follow from the dimensions.
    pub picked: bool,
    /// The field that says how far the last move lifts; `None` if the cycle ends otherwise.
    pub lift: Option<&'static str>,
    /// The calls that make this path, where native cycles do.
    pub own: Option<Box<Own>>,
    /// The cycles of a set-up; empty in a path of one cycle.
    pub members: Vec<Member>,
    /// What a set-up computes of the results of its cycles.
    pub relations: Vec<Related>,
    /// What a set-up writes.
    pub datum_source: DatumSource,
    /// What shifts the end of each move; empty where no cycle follows a result of another.
    pub shifts: Vec<Shifts>,
}

/// What is wrong with a touch of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TouchFault {
    /// It is not in the path, or more than once.
    Missing,
    /// Its way to the nominal contact is so short, mm.
    Short(f64),
    /// Its way is askew of the inverted target vector by so many degrees.
    Askew(f64),
}

/// Index of a touch among those of the same point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Repeat {
    /// The point of the formula.
    pub index: usize,
    /// How many touches measure it.
    pub count: usize,
    /// Whether this is the first of them.
    pub first: bool,
    /// Whether this is the last.
    pub last: bool,
}

impl Path {
    /// The same moves for a run that measures nothing, so much higher along the tool axis: a touch is a positioning move to its nominal contact.
    pub fn dry(&self, lift: f64) -> Path {
        let up = self.frame.w * lift;
        let moves = self.moves.iter().map(|step| Move {
            to: step.to + up,
            purpose: Purpose::Position,
            arc: step.arc.map(|arc| Arc {
                center: arc.center + up,
                ..arc
            }),
            ..*step
        });
        let mut members = self.members.clone();
        members
            .iter_mut()
            .for_each(|member| member.placing = follow::Placing::default());
        Path {
            touches: Vec::new(),
            moves: moves.collect(),
            formula: Formula::default(),
            members,
            own: None,
            relations: Vec::new(),
            shifts: Vec::new(),
            ..self.clone()
        }
    }

    /// The moves that touch, in order: which touch, where the move begins (`None` if that is not known), and the move.
    pub fn searches(&self) -> impl Iterator<Item = (usize, Option<Vec3>, &Move)> {
        let begins = std::iter::once(self.start).chain(self.moves.iter().map(|step| Some(step.to)));
        self.moves
            .iter()
            .zip(begins)
            .filter_map(|(step, from)| match step.purpose {
                Purpose::Touch(k) => Some((k, from, step)),
                Purpose::Position | Purpose::Search(_) | Purpose::Back(_) => None,
            })
    }

    /// What is wrong with each touch: it must be in the path once, begin at a distance from its contact, and run along its inverted
    /// target vector.
    pub fn touch_faults(&self, radius: f64) -> Vec<(usize, TouchFault)> {
        let mut ways: Vec<Option<Vec3>> = vec![None; self.touches.len()];
        let mut faults = Vec::new();
        for (k, from, _) in self.searches() {
            match (ways.get_mut(k), from) {
                (Some(way @ None), Some(from)) => {
                    *way = Some(self.touches[k].contact(radius) - from)
                }
                _ => faults.push((k, TouchFault::Missing)),
            }
        }
        for (k, way) in ways.into_iter().enumerate() {
            let Some(way) = way else {
                faults.push((k, TouchFault::Missing));
                continue;
            };
            let along = -way.dot(self.touches[k].vector);
            if along < SHORTEST_TOUCH - 1e-6 {
                faults.push((k, TouchFault::Short(along)));
                continue;
            }
            let aside = (way + self.touches[k].vector * along).length();
            let askew = aside.atan2(along).to_degrees();
            if askew > MOST_ASKEW && aside > ONE_LEVEL {
                faults.push((k, TouchFault::Askew(askew)));
            }
        }
        faults
    }

    /// The shortest way from the begin of a touch to its nominal contact, mm.
    pub fn shortest_way(&self) -> f64 {
        let pairs = self
            .moves
            .windows(2)
            .filter(|pair| matches!(pair[1].purpose, Purpose::Touch(_)));
        pairs
            .map(|pair| pair[0].to.distance(pair[1].to))
            .fold(f64::INFINITY, f64::min)
    }

    /// Index of each touch in its sample.
    pub fn samples(&self) -> Vec<Repeat> {
        let mut counts: Vec<usize> = Vec::new();
        let mut samples: Vec<Repeat> = Vec::with_capacity(self.touches.len());
        for touch in &self.touches {
            let index = touch.sample;
            if counts.len() <= index {
                counts.resize(index + 1, 0);
            }
            samples.push(Repeat {
                index,
                count: 0,
                first: counts[index] == 0,
                last: false,
            });
            counts[index] += 1;
        }
        let mut left = counts.clone();
        for own in &mut samples {
            left[own.index] -= 1;
            (own.count, own.last) = (counts[own.index], left[own.index] == 0);
        }
        samples
    }
}
