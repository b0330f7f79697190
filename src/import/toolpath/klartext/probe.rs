//! The moves of a HEIDENHAIN's probing cycles, as far as they are documented: circles (412, 413, 421, 422), a surface across the tool axis (417), one coordinate
//! (419, 427).
//!
//! Positions and their order follow a simulator that was written from the control's manual [S]. Of the touch probe table nothing is known: SET_UP is taken for
//! 0, and a touch for one that searches 10 mm behind the contact [I].

use crate::geom::{Plane, Vec3};
use crate::import::toolpath::count::count;
use crate::import::toolpath::reader::Reader;
use crate::import::toolpath::{FEED, PROBE, RAPID};

/// How far a touch searches behind its contact, mm: DIST of the table, which is not known.
const BEHIND: f64 = 10.0;

/// The radius of a ball that nothing says, mm.
const RADIUS: f64 = 3.0;

/// Makes the moves of a cycle; false where they are not known, or a parameter is not.
pub fn makes(number: &str, given: &[(String, f64)], reader: &mut Reader) -> bool {
    let Some(run) = &reader.run else { return false };
    if reader.plane.unwrap_or_default() != Plane::G17 {
        return false;
    }
    let inch = if reader.path.metric == Some(false) { 25.4 } else { 1.0 };
    let at = Vec3::from_array(reader.place) * inch;
    let radius = run.feature.as_ref().map_or(RADIUS, |feature| feature.radius());
    let first = reader.path.len();
    let mut probe = Probe { given, inch, at, radius, high: f64::NAN, reader, done: false };
    let made = match number {
        "412" | "421" => probe.circle(true),
        "413" | "422" => probe.circle(false),
        "417" => probe.down(),
        "419" | "427" => probe.coordinate(),
        _ => None,
    };
    let (at, stopped) = (probe.at, probe.done);
    if made.is_none() && reader.path.len() == first {
        return false;
    }
    reader.place = (at / inch).to_array();
    if let Some(log) = &mut reader.log {
        log.own.push((first, reader.path.len()));
    }
    count(&mut reader.own_cycles, reader.line);
    if stopped {
        count(&mut reader.stopped, reader.line);
        reader.ended = true;
    }
    true
}

struct Probe<'r> {
    given: &'r [(String, f64)],
    /// Millimetres in a unit of the program.
    inch: f64,
    at: Vec3,
    radius: f64,
    /// The clearance height.
    high: f64,
    reader: &'r mut Reader,
    /// A touch met nothing: the control stops.
    done: bool,
}

impl Probe<'_> {
    /// A parameter as it stands; none where it is not given, or not known.
    fn get(&self, number: u16) -> Option<f64> {
        let name = format!("Q{number}");
        self.given.iter().find(|(known, value)| *known == name && value.is_finite()).map(|(_, value)| *value)
    }

    /// A length, mm.
    fn length(&self, number: u16) -> Option<f64> {
        Some(self.get(number)? * self.inch)
    }

    fn goes(&mut self, to: Vec3) {
        // From a place that is not known it moves, too.
        let stands = to.distance(self.at) < 1e-9;
        if !stands {
            self.reader.makes((RAPID, to, None, None), self.inch);
            self.at = to;
        }
    }

    /// To where a touch begins: never lower than the clearance height but at the end.
    fn comes(&mut self, to: Vec3) -> Option<()> {
        self.at.z.is_finite().then_some(())?;
        let high = self.at.z.max(self.high);
        self.goes(self.at.with_z(high));
        self.goes(to.with_z(high));
        self.goes(to);
        Some(())
    }

    /// A touch towards where the contact should be, and back; none where nothing is met.
    fn touches(&mut self, contact: Vec3) -> Option<()> {
        let start = self.at;
        let along = (contact - start).normalize_or_zero();
        let end = contact + along * BEHIND;
        let met = self.reader.answers()(start, end, contact);
        self.reader.makes((PROBE, end, met, None), self.inch);
        let Some(met) = met else {
            (self.at, self.done) = (end, true);
            return None;
        };
        self.at = met;
        self.goes(start);
        Some(())
    }

    /// Touch by touch from the start angle on; between them on an arc, straight, or over the clearance height.
    fn circle(&mut self, inside: bool) -> Option<()> {
        let [x, y] = [self.length(321).or(self.length(273))?, self.length(322).or(self.length(274))?];
        let (half, height) = (self.length(262)? / 2.0, self.length(261)?);
        let (start, step) = (self.get(325).unwrap_or(0.0), self.get(247).unwrap_or(90.0));
        let (aside, count) = (self.radius + self.length(320).unwrap_or(0.0), self.get(423).unwrap_or(4.0));
        self.high = self.length(260)?;
        let center = Vec3::new(x, y, height);
        let sign = if inside { -1.0 } else { 1.0 };
        // A hole with no room is touched from its middle.
        let off = (half + sign * aside).max(0.0);
        let direction = |k: f64| {
            let (sin, cos) = (start + step * k).to_radians().sin_cos();
            Vec3::new(cos, sin, 0.0)
        };
        let (lifts, on_arc) = (self.get(301) == Some(1.0), self.get(365).unwrap_or(1.0) == 1.0);
        for k in 0..(count as usize).clamp(1, 8) {
            let towards = direction(k as f64);
            let place = center + towards * off;
            match (k, lifts) {
                (0, _) | (_, true) => self.comes(place)?,
                (_, false) if on_arc && off > 0.0 => {
                    let index = self.reader.path.len() as f64;
                    let [cx, cy, cz] = (center / self.inch).to_array();
                    self.reader.path.arcs.push([index, cx, cy, cz, step, 17.0]);
                    self.reader.makes((FEED, place, None, None), self.inch);
                    self.at = place;
                }
                (_, false) => self.goes(place),
            }
            self.touches(center + towards * (half + sign * self.radius))?;
        }
        self.goes(self.at.with_z(self.high));
        Some(())
    }

    fn down(&mut self) -> Option<()> {
        let surface = Vec3::new(self.length(263)?, self.length(264)?, self.length(294)?);
        self.high = self.length(260)?;
        let aside = self.radius + self.length(320).unwrap_or(0.0);
        self.comes(surface + Vec3::Z * aside)?;
        self.touches(surface + Vec3::Z * self.radius)?;
        self.goes(self.at.with_z(self.high));
        Some(())
    }

    fn coordinate(&mut self) -> Option<()> {
        let place = Vec3::new(self.length(263)?, self.length(264)?, self.length(261)?);
        self.high = self.length(260)?;
        let aside = self.radius + self.length(320).unwrap_or(0.0);
        let towards = match self.get(272)? {
            1.0 => Vec3::X,
            2.0 => Vec3::Y,
            _ => return None,
        } * self.get(267)?.signum();
        self.comes(place - towards * aside)?;
        self.touches(place - towards * self.radius)?;
        self.goes(self.at.with_z(self.high));
        Some(())
    }
}
