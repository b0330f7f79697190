//! The path of a cycle: touches, moves, the nominal feature, and the results that the control computes from the touches.
//!
//! Lengths are in mm, angles in radians unless a name contains degrees. Points are ball centres in the work coordinate system unless their comment says "on the
//! surface". A path is independent of cycles, controls and units.

mod calls;
mod feature;
mod follow;
mod parameter;
mod repeat;
mod set_up;
mod shift;
mod surface;
mod tracer;

pub use calls::{CallBlock, CallSequence, Computed, Guard, Off, ProbeTable, Quantity, Stored};
pub use feature::{
    Bore, Corner, Feature, FeatureKind, FieldValue, Pairs, Point, Setting, Side, Spread, Top,
    TwoCircles, WallFeature, WallTouch,
};
pub use follow::{Dependencies, Dependency, DependencyLimits, FollowedValue, Sensitivity};
pub use parameter::{Accessor, Parameter, ParameterValue};
pub use set_up::{CycleSegment, DatumSource, LINK_STEP, LinkBlock, RelationSegment, ResultSource};
pub use shift::{ShiftTerm, Shifts, far_apart, most};
pub use surface::{Round, Surface, Wall};
pub use tracer::Tracer;

use crate::formula::Formula;
use crate::geom::{Frame, Plane, Vec3};

/// The most touches a path may have: touch 17 of a CAM parameter table would start at code −196 and run into the −200 block.
pub const MAX_TOUCHES: usize = 16;

// A CAM parameter table may have one sample for each touch.
const _: () = assert!(MAX_TOUCHES <= crate::formula::MOST_SAMPLES);

/// Assumed rate of rapids in stated times, mm/min. Machines differ; only the time estimate depends on it.
pub const RAPID_RATE: f64 = 5000.0;

/// Feed of a rapid that must state one (watched moves and arcs), mm/min. At this feed machines stop within the deflection that a stylus survives.
pub const STATED_RAPID: f64 = 2000.0;

/// Shorter moves are left out, mm.
pub const ZERO_LENGTH: f64 = 1e-9;

/// Shortest distance from the start of a touch to its nominal contact, mm. A clearance exceeds the ball radius by at least this. A smaller distance would
/// disappear in the last decimals of a program, and the touch would start in contact.
pub const SHORTEST_TOUCH: f64 = 0.01;

/// Largest angle between a touch and its inverted target vector, degrees.
pub const MOST_ASKEW: f64 = 1.0;

/// Touches whose heights differ by no more than this are at one level, mm: picks in a dump are rounded.
pub const ONE_LEVEL: f64 = 0.01;

/// Settings of the job that a cycle needs for its plan.
#[derive(Clone, Copy, Debug)]
pub struct ProbeSettings {
    pub plane: Plane,
    /// Radius of the stylus ball, mm; 0 is a point.
    pub radius: f64,
    /// Distance that a touch searches past its nominal contact, mm.
    pub overtravel: f64,
}

/// The feed that a move uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feed {
    /// From the feed distance to the start.
    Approach,
    /// Positioning inside the cycle.
    LongLink,
    /// The touch itself.
    Work,
    /// The retract from a touched surface.
    Retract,
    /// The last lift.
    Return,
    /// The first, fast touch of a native cycle that touches twice.
    Search,
    /// At the control's rapid rate, or at a stated one.
    Rapid,
}

/// Feeds of a path, mm/min; `None` is a rapid.
#[derive(Clone, Copy, Debug)]
pub struct Feeds {
    pub approach: Option<f64>,
    pub long_link: Option<f64>,
    /// Feed of touches; never a rapid.
    pub work: f64,
    pub retract: Option<f64>,
    pub return_: Option<f64>,
    /// Feed of the first touch of a native cycle.
    pub search: Option<f64>,
    /// Stated rapid rate; `None` is the control's own.
    pub rapid: Option<f64>,
}

impl Feeds {
    /// Rate of a move, mm/min; `None` is the control's rapid rate.
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

    /// Whether a move is a rapid, by its kind or because its feed is set to one.
    pub fn is_rapid(&self, feed: Feed) -> bool {
        feed == Feed::Rapid || self.rate(feed).is_none()
    }
}

/// Purpose of a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MovePurpose {
    /// Positioning; the stylus must not make contact.
    Position,
    /// The touch with this index. Ends at the nominal contact of the ball centre.
    Touch(usize),
    /// The first, fast touch of a native cycle that touches twice, for the touch with this index. It ends at the nominal contact. The second touch is measured.
    Search(usize),
    /// The retract from the touch with this index.
    Retract(usize),
}

/// An arc about the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Centre, at the height of the move.
    pub center: Vec3,
    /// Sweep, radians, counter-clockwise positive seen against the tool axis; less than a whole turn.
    pub sweep: f64,
}

impl Arc {
    /// Ends of about `count` straight pieces along the arc. `up` is its axis. A helix rises along it.
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
    pub purpose: MovePurpose,
    /// Number of the step in the cycle's documented list, from 1.
    pub step: u8,
    /// The arc of the move; `None` is straight. Only positioning moves are arcs.
    pub arc: Option<Arc>,
}

impl Move {
    /// Ends of the straight pieces by which this move is checked: its own end, or an arc in pieces of about `degrees`. `up` is the tool axis.
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
    /// Target vector: unit outward normal of the surface, from the material into free space.
    pub vector: Vec3,
    /// Index of the touched surface, from 0.
    pub group: usize,
    /// Search distance past the nominal contact, mm.
    pub search: f64,
    /// Index of the sample in the formula. Touches of one sample are averaged.
    pub sample: usize,
}

impl Touch {
    /// Ball centre at the nominal contact.
    pub fn contact(&self, radius: f64) -> Vec3 {
        self.point + self.vector * radius
    }
}

/// A planned cycle with its touches, moves and formula.
#[derive(Clone, Debug)]
pub struct Path {
    pub touches: Vec<Touch>,
    pub moves: Vec<Move>,
    /// Ball centre before the first move, if the job gives it.
    pub start: Option<Vec3>,
    /// Height of the feature's top side along the tool axis, mm, if the source has one.
    pub top: Option<f64>,
    /// The walls of the nominal feature.
    pub surfaces: Vec<Surface>,
    /// Feeds of the cycle, if it does not use those of the job.
    pub feeds: Option<Feeds>,
    /// Frame of the feature's dimensions.
    pub frame: Frame,
    /// Results that the control computes from the touches.
    pub formula: Formula,
    pub feature: Feature,
    /// Whether the touches were picked one by one and do not follow from the dimensions.
    pub picked: bool,
    /// Field with the height of the last lift; `None` if the cycle ends otherwise.
    pub lift_field: Option<&'static str>,
    /// Native calls that make this path, if the job asks for native cycles.
    pub calls: Option<Box<CallSequence>>,
    /// The cycles of a set-up; empty in a path of one cycle.
    pub cycles: Vec<CycleSegment>,
    /// Relations that a set-up computes from the results of its cycles.
    pub relations: Vec<RelationSegment>,
    /// Sources of the work offset that a set-up writes.
    pub datum_source: DatumSource,
    /// Shift of the end of each move; empty if no cycle follows a result.
    pub shifts: Vec<Shifts>,
}

/// Fault of a touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TouchError {
    /// The touch is missing in the path, or is there more than once.
    Missing,
    /// Its distance to the nominal contact is too short, mm.
    Short(f64),
    /// It runs askew of the inverted target vector, degrees.
    Askew(f64),
}

/// Position of a touch among the touches of one sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RepeatIndex {
    /// Index of the sample.
    pub index: usize,
    /// Number of touches of the sample.
    pub count: usize,
    /// Whether this is the first of them.
    pub first: bool,
    /// Whether this is the last.
    pub last: bool,
}

impl Path {
    /// The same moves for a run that measures nothing, raised by `lift` along the tool axis. Each touch becomes a positioning move to its nominal contact.
    pub fn dry(&self, lift: f64) -> Path {
        let up = self.frame.w * lift;
        let moves = self.moves.iter().map(|step| Move {
            to: step.to + up,
            purpose: MovePurpose::Position,
            arc: step.arc.map(|arc| Arc {
                center: arc.center + up,
                ..arc
            }),
            ..*step
        });
        let mut members = self.cycles.clone();
        members
            .iter_mut()
            .for_each(|member| member.placing = follow::CycleTransform::default());
        Path {
            touches: Vec::new(),
            moves: moves.collect(),
            formula: Formula::default(),
            cycles: members,
            calls: None,
            relations: Vec::new(),
            shifts: Vec::new(),
            ..self.clone()
        }
    }

    /// All touching moves in order: index of the touch, start of the move (`None` if unknown), and the move.
    pub fn searches(&self) -> impl Iterator<Item = (usize, Option<Vec3>, &Move)> {
        let begins = std::iter::once(self.start).chain(self.moves.iter().map(|step| Some(step.to)));
        self.moves
            .iter()
            .zip(begins)
            .filter_map(|(step, from)| match step.purpose {
                MovePurpose::Touch(k) => Some((k, from, step)),
                MovePurpose::Position | MovePurpose::Search(_) | MovePurpose::Retract(_) => None,
            })
    }

    /// Faults of the touches. Each touch must be in the path once, begin at a distance from its contact, and run along its inverted target vector.
    pub fn touch_faults(&self, radius: f64) -> Vec<(usize, TouchError)> {
        let mut ways: Vec<Option<Vec3>> = vec![None; self.touches.len()];
        let mut faults = Vec::new();
        for (k, from, _) in self.searches() {
            match (ways.get_mut(k), from) {
                (Some(way @ None), Some(from)) => {
                    *way = Some(self.touches[k].contact(radius) - from)
                }
                _ => faults.push((k, TouchError::Missing)),
            }
        }
        for (k, way) in ways.into_iter().enumerate() {
            let Some(way) = way else {
                faults.push((k, TouchError::Missing));
                continue;
            };
            let along = -way.dot(self.touches[k].vector);
            if along < SHORTEST_TOUCH - 1e-6 {
                faults.push((k, TouchError::Short(along)));
                continue;
            }
            let aside = (way + self.touches[k].vector * along).length();
            let askew = aside.atan2(along).to_degrees();
            if askew > MOST_ASKEW && aside > ONE_LEVEL {
                faults.push((k, TouchError::Askew(askew)));
            }
        }
        faults
    }

    /// Shortest distance from the start of a touch to its nominal contact, mm.
    pub fn shortest_approach(&self) -> f64 {
        let pairs = self
            .moves
            .windows(2)
            .filter(|pair| matches!(pair[1].purpose, MovePurpose::Touch(_)));
        pairs
            .map(|pair| pair[0].to.distance(pair[1].to))
            .fold(f64::INFINITY, f64::min)
    }

    /// Position of each touch in its sample.
    pub fn samples(&self) -> Vec<RepeatIndex> {
        let mut counts: Vec<usize> = Vec::new();
        let mut samples: Vec<RepeatIndex> = Vec::with_capacity(self.touches.len());
        for touch in &self.touches {
            let index = touch.sample;
            if counts.len() <= index {
                counts.resize(index + 1, 0);
            }
            samples.push(RepeatIndex {
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
