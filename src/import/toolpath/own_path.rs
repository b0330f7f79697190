//! The moves of a macro of the control's own, where they are known: Renishaw's, in a run that knows where the stylus stands.

use crate::control::own::machine::{Alarm, IN_POSITION, Kind, Machine, Made, Met};
use crate::control::renishaw::macros::{self, FAST};
use crate::geom::{Plane, Vec3};
use crate::import::toolpath::count::count;
use crate::import::toolpath::known::Trip;
use crate::import::toolpath::reader::Reader;
use crate::import::toolpath::rules::Touch;
use crate::import::toolpath::{FEED, PROBE, RAPID};

/// The radius of a ball that nothing says, mm.
pub(super) const RADIUS: f64 = 3.0;

impl Reader {
    /// Makes the moves of a macro by its number and letters, in the program's units; false where they are not known.
    #[cold]
    pub(super) fn makes_own_moves(&mut self, number: u32, arguments: &[(String, f64)]) -> bool {
        let number = if (8800..8900).contains(&number) { number + 1000 } else { number };
        let in_plane = self.modes.plane.unwrap_or_default() == Plane::G17;
        let known = macros::KNOWN.contains(&number) && in_plane && !self.path.centroid;
        let Some(run) = self.run.as_ref().filter(|_| known && !self.modes.diameter) else { return false };
        let inch = if self.path.metric == Some(false) { 25.4 } else { 1.0 };
        let scale = inch * self.modes.scale;
        let at = Vec3::from_array(self.place) * inch;
        let letters: Vec<(char, f64)> = arguments.iter().filter_map(|(name, x)| Some((name.chars().next()?, *x))).collect();
        // A protected move goes to a place that may be known along some axes alone.
        let goes = number == 9810;
        let unknown = letters.iter().any(|(_, x)| x.is_nan());
        if unknown || at.is_nan() && !goes || self.stale != 0 && !goes {
            return false;
        }
        let lengths = "CDFHIJKMQRUVXYZ";
        // Of 9823 and 9819 C is an angle.
        let is_length = |letter: char| lengths.contains(letter) && !(letter == 'C' && number == 9823);
        let letters: Vec<(char, f64)> =
            letters.into_iter().map(|(letter, x)| (letter, if is_length(letter) { x * scale } else { x })).collect();
        let radius = run.feature.as_ref().map_or(RADIUS, |feature| feature.radius());
        let mut answers = self.answers();
        let mut machine = Machine::new(at, radius, 0.0, &mut answers);
        let Some(end) = macros::run(number, letters.as_slice(), &mut machine) else { return false };
        // What contradicts in the call is said of it.
        if end == Err(Alarm::Arguments) {
            return false;
        }
        let (made, at) = (machine.made, machine.at);
        let first = self.path.len();
        made.iter().for_each(|made| self.own_move(made, inch));
        self.place = (at / inch).to_array();
        self.feed = FAST / inch;
        if let Some(log) = &mut self.log {
            log.own.push((first, self.path.len()));
        }
        if !goes {
            count(&mut self.own_moves, self.line);
        }
        if end.is_err() {
            count(&mut self.stopped, self.line);
            self.ended = true;
        }
        true
    }

    pub(super) fn own_move(&mut self, made: &Made, inch: f64) {
        let kind = match made.kind {
            Kind::Rapid => RAPID,
            // As fast as the probe table says.
            Kind::Watched | Kind::Back if made.rate.is_none() && made.arc.is_none() => RAPID,
            Kind::Watched | Kind::Back => FEED,
            Kind::Search | Kind::Measure | Kind::Once => PROBE,
        };
        if let Some(arc) = made.arc {
            let [x, y, z] = (arc.center / inch).to_array();
            self.path.arcs.push([self.path.len() as f64, x, y, z, arc.sweep.to_degrees(), 17.0]);
        }
        let met = made.met.map(|met| met.center).filter(|center| center.distance(made.to) >= IN_POSITION);
        self.makes((kind, made.to, met, made.rate), inch);
    }

    /// What answers the moves of the control's own cycles: places of the ball's centre, mm.
    pub(super) fn answers(&self) -> impl FnMut(Vec3, Vec3, Option<Vec3>) -> Option<Met> + use<> {
        let run = self.run.as_ref();
        let known = run.map(|run| (run.feature.clone(), run.touch, run.positioning));
        move |from: Vec3, to: Vec3, expected: Option<Vec3>| {
            let part = |trip: Trip| match trip {
                Trip::At(part) => Some(from + (to - from) * part),
                Trip::Never => None,
                // Where the call says the feature is.
                Trip::Unknown => expected,
            };
            let center = match &known {
                _ if from.is_nan() || to.is_nan() => None,
                Some((Some(feature), ..)) => feature.contact(from, to).map(|part| from + (to - from) * part),
                Some((None, touch, _)) if expected.is_some() => part(*touch),
                Some((None, _, positioning)) => part(*positioning).filter(|_| *positioning != Trip::Unknown),
                None => expected,
            };
            center.filter(|center| !center.is_nan()).map(|center| Met { center, surface: 0, edge: false })
        }
    }

    /// Makes a move of a cycle of the control's own: kind, end, contact, feed; in mm.
    fn makes(&mut self, (kind, to, met, rate): (u8, Vec3, Option<Vec3>, Option<f64>), inch: f64) {
        let index = self.path.len();
        self.path.to.extend((to / inch).to_array());
        self.path.kind.push(kind);
        self.path.feed.push(rate.map_or(f64::NAN, |rate| rate / inch));
        self.path.line.push(self.line as u32);
        if let Some(met) = met {
            let [x, y, z] = (met / inch).to_array();
            self.path.contacts.push([index as f64, x, y, z]);
        }
        if let Some(log) = self.log.as_mut().filter(|_| kind == PROBE) {
            log.touches.push(Touch { index, line: self.line, stops: true, asked: true, positions: false, own_feed: true });
        }
    }
}
