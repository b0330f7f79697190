//! Moves of native cycles, if they are known, in a run with a known stylus position: Renishaw's macros, measuring cycles of a SINUMERIK.

use crate::control::native::{self, Unit};
use crate::control::native_run::machine::{
    Alarm, BallContact, ExecutedMove, IN_POSITION, Machine, MoveKind,
};
use crate::control::renishaw::macros::{self, FAST};
use crate::control::sinumerik::cycles;
use crate::geom::{Plane, Vec3};
use crate::import::toolpath::count::{Count, count};
use crate::import::toolpath::key::Key;
use crate::import::toolpath::known::TriggerAt;
use crate::import::toolpath::reader::Reader;
use crate::import::toolpath::rules::Touch;
use crate::import::toolpath::script::Machine as Interpreter;
use crate::import::toolpath::script::variables::Value;
use crate::import::toolpath::{FEED, PROBE, RAPID};
use crate::path::Stored;

/// Assumed ball radius, mm.
const RADIUS: f64 = 3.0;

/// First variable that Renishaw's macros use: read in the macros.
const FIRST_OF_MACROS: i32 = 116;

impl Reader {
    /// Variables after a macro. One of Renishaw's leaves those below its own unchanged, and sets its outputs.
    #[cold]
    pub(super) fn ends_macro(&mut self, macros: &mut Interpreter) {
        if !self.renishaw {
            self.outputs.clear();
            return macros.forget_shared();
        }
        macros.variables.forget_from(FIRST_OF_MACROS);
        let unit = self.modes.scale * self.inch();
        for (output, value) in &self.outputs {
            let output = Stored::Output(usize::from(*output));
            let name = self.output_name.map(|name| name(output));
            if let Some(key) = name.and_then(|name| Key::named(&name)) {
                macros.variables.set(key, Value::of(value / unit));
            }
        }
    }

    /// Makes the moves of a macro by its number and letters, in the program's units; false if they are unknown.
    #[cold]
    pub(super) fn makes_macro(&mut self, number: u32, arguments: &[(String, f64)]) -> bool {
        let number = if (8800..8900).contains(&number) {
            number + 1000
        } else {
            number
        };
        // A protected move goes to a position that may be known along some axes only.
        let goes = number == 9810;
        let unknown = arguments.iter().any(|(_, x)| x.is_nan());
        if !macros::KNOWN.contains(&number)
            || self.path.centroid
            || unknown
            || !goes && !self.knows_place()
        {
            return false;
        }
        let scale = self.inch() * self.modes.scale;
        let lengths = "CDFHIJKMQRUVXYZ";
        // C of 9823 and 9819 is an angle.
        let is_length =
            |letter: char| lengths.contains(letter) && !(letter == 'C' && number == 9823);
        let letters = arguments
            .iter()
            .filter_map(|(name, x)| Some((name.chars().next()?, *x)));
        let letters: Vec<(char, f64)> = letters
            .map(|(letter, x)| (letter, if is_length(letter) { x * scale } else { x }))
            .collect();
        let edition = self.path.edition;
        let counted: fn(&mut Self) -> &mut Count = |reader| &mut reader.own_moves;
        let made = self.makes_own((!goes).then_some(counted), true, |machine| {
            macros::run(number, &letters, edition, machine)
        });
        if made {
            self.feed = FAST / self.inch();
        }
        made
    }

    /// Makes the moves of a SINUMERIK's measuring cycle by its number and arguments; false if they are unknown.
    #[cold]
    pub(super) fn makes_measuring_cycle(
        &mut self,
        name: &str,
        arguments: &[(String, f64)],
    ) -> bool {
        let Some(number) = name
            .to_ascii_uppercase()
            .strip_prefix("CYCLE")
            .and_then(|number| number.parse().ok())
        else {
            return false;
        };
        if !self.knows_place() {
            return false;
        }
        let scale = self.inch() * self.modes.scale;
        let call = native::find(name);
        let is_length = |place: &str| {
            call.and_then(|call| call.argument(place))
                .is_some_and(|known| known.unit == Unit::Length)
        };
        let value = |(place, x): &(String, f64)| {
            let number = place.parse().ok().filter(|_| x.is_finite())?;
            Some((number, if is_length(place) { x * scale } else { *x }))
        };
        let places: Vec<(u16, f64)> = arguments.iter().filter_map(value).collect();
        self.makes_own(
            Some(|reader| &mut reader.measuring_cycles),
            false,
            |machine| cycles::run(number, &places, machine),
        )
    }

    /// Whether the position of the stylus is known.
    fn knows_place(&self) -> bool {
        !self.place.iter().any(|x| x.is_nan())
    }

    /// Millimetres in a unit of stored positions.
    pub(super) fn inch(&self) -> f64 {
        if self.path.metric == Some(false) {
            25.4
        } else {
            1.0
        }
    }

    /// Runs a call with the known inputs and takes over its moves; false if the call is unknown. Counts a note for its kind. `to_tip`: whether heights of the
    /// program are those of the stylus tip, otherwise of the ball centre.
    pub(super) fn makes_own(
        &mut self,
        counted: Option<fn(&mut Self) -> &mut Count>,
        to_tip: bool,
        run: impl FnOnce(&mut Machine<'_>) -> Option<Result<(), Alarm>>,
    ) -> bool {
        let in_plane = self.modes.plane.or(self.plane).unwrap_or_default() == Plane::G17;
        let Some(touching) = self
            .run
            .as_ref()
            .filter(|_| in_plane && !self.modes.diameter)
        else {
            return false;
        };
        let radius = touching
            .feature
            .as_ref()
            .map_or(RADIUS, |feature| feature.radius());
        let (inch, mut answers) = (self.inch(), self.answers());
        let tip = if to_tip { radius } else { 0.0 };
        let center = Vec3::from_array(self.place) * inch + Vec3::Z * tip;
        let mut machine = Machine::new(center, radius, tip, &mut answers);
        let Some(end) = run(&mut machine) else {
            return false;
        };
        // Contradictions in the call are reported for it.
        if end == Err(Alarm::Arguments) {
            return false;
        }
        let (mut made, at) = (machine.made, machine.at - Vec3::Z * tip);
        // A protected move leaves the outputs of the macro before.
        if counted.is_some() {
            self.outputs = machine.outputs;
        }
        let first = self.path.len();
        for made in &mut made {
            made.to.z -= tip;
            if let Some(met) = &mut made.met {
                met.center.z -= tip;
            }
            if let Some(arc) = &mut made.arc {
                arc.center.z -= tip;
            }
            self.own_move(made, inch);
        }
        self.place = (at / inch).to_array();
        if let Some(log) = &mut self.log {
            log.own.push((first, self.path.len()));
        }
        if let Some(counted) = counted {
            let line = self.line;
            count(counted(self), line);
        }
        if end.is_err() {
            count(&mut self.stopped, self.line);
            self.stops();
        }
        true
    }

    fn own_move(&mut self, made: &ExecutedMove, inch: f64) {
        let kind = match made.kind {
            MoveKind::Rapid => RAPID,
            // At the control's rapid rate.
            MoveKind::Watched | MoveKind::Retract if made.rate.is_none() && made.arc.is_none() => {
                RAPID
            }
            MoveKind::Watched | MoveKind::Retract => FEED,
            MoveKind::Search | MoveKind::Measure | MoveKind::SingleTouch => PROBE,
        };
        if let Some(arc) = made.arc {
            let [x, y, z] = (arc.center / inch).to_array();
            self.path.arcs.push([
                self.path.len() as f64,
                x,
                y,
                z,
                arc.sweep.to_degrees(),
                17.0,
            ]);
        }
        let met = made
            .met
            .map(|met| met.center)
            .filter(|center| center.distance(made.to) >= IN_POSITION);
        self.makes((kind, made.to, met, made.rate), inch);
    }

    /// Answers the moves of native cycles: ball centres, mm.
    fn answers(&self) -> impl FnMut(Vec3, Vec3, Option<Vec3>) -> Option<BallContact> + use<> {
        let run = self.run.as_ref();
        let known = run.map(|run| (run.feature.clone(), run.touch, run.positioning));
        let (frames, inch) = (self.frames.clone(), self.inch());
        let seen = move |p: Vec3| Vec3::from_array(frames.drawn((p / inch).to_array())) * inch;
        move |from: Vec3, to: Vec3, expected: Option<Vec3>| {
            let part = |trip: TriggerAt| match trip {
                TriggerAt::At(part) => Some(from + (to - from) * part),
                TriggerAt::Never => None,
                // At the feature's position in the call.
                TriggerAt::Unknown => expected,
            };
            let center = match &known {
                _ if from.is_nan() || to.is_nan() => None,
                Some((Some(feature), ..)) => feature
                    .contact(seen(from), seen(to))
                    .map(|part| from + (to - from) * part),
                Some((None, touch, _)) if expected.is_some() => part(*touch),
                Some((None, _, positioning)) => {
                    part(*positioning).filter(|_| *positioning != TriggerAt::Unknown)
                }
                None => expected,
            };
            center
                .filter(|center| !center.is_nan())
                .map(|center| BallContact {
                    center,
                    surface: 0,
                    edge: false,
                })
        }
    }

    /// Makes a move of a native cycle: kind, end, contact, feed; in mm.
    fn makes(&mut self, (kind, to, met, rate): (u8, Vec3, Option<Vec3>, Option<f64>), inch: f64) {
        self.notes_system();
        let index = self.path.len();
        self.path.to.extend((to / inch).to_array());
        self.path.kind.push(kind);
        self.path
            .feed
            .push(rate.map_or(f64::NAN, |rate| rate / inch));
        self.path.line.push(self.line as u32);
        if let Some(met) = met {
            let [x, y, z] = (met / inch).to_array();
            self.path.contacts.push([index as f64, x, y, z]);
        }
        if let Some(log) = self.log.as_mut().filter(|_| kind == PROBE) {
            log.touches.push(Touch {
                axes: 7,
                index,
                line: self.line,
                stops: true,
                asked: true,
                watched: false,
                may_ask: false,
                positions: false,
                feed: f64::NAN,
                states_feed: true,
            });
        }
    }
}
