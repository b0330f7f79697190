//! Turns a call of a native cycle into a job, if it is one of the documented cycles: from its arguments and the stylus position.
//!
//! Values that a call does not give have the form's defaults; the order of the touches is that of the documented cycle, not the control's. Renishaw's Q counts
//! from the nominal surface to the ball centre, so the overtravel is Q plus the ball radius; R counts from the surface of the ball. Both follow from the macros
//! \[I\].

use crate::control::ProgramForm;
use crate::control::edition::Edition;
use crate::control::native::heidenhain::row;
use crate::control::native::rows::{Probed, Shape};
use crate::control::sinumerik::cycles::called;
use crate::form::{Level, Value};
use crate::geom::Vec3;
use crate::import::set;
use crate::job::{Units, check, default_job_in, job_name};

/// The parts of a call that a job needs.
pub(super) struct CallContext<'a> {
    pub name: &'a str,
    /// Control of the call, if its name tells: it supports the call and no plain moves.
    pub post: Option<&'static str>,
    /// Edition of the macros that its program is for.
    pub edition: Edition,
    /// Names and values of its arguments; NaN is unknown.
    pub arguments: &'a [(String, f64)],
    /// Position of the stylus in the program's units; NaN is unknown.
    pub place: [f64; 3],
    pub metric: bool,
}

/// Values for a job from a call.
struct JobFromCall {
    cycle: &'static str,
    fields: Vec<(&'static str, f64)>,
    origin: [f64; 3],
    overtravel: Option<f64>,
    post: Option<&'static str>,
    offset: Option<f64>,
}

impl CallContext<'_> {
    fn get(&self, name: &str) -> Option<f64> {
        self.arguments
            .iter()
            .find(|(known, value)| known == name && value.is_finite())
            .map(|(_, value)| *value)
    }

    /// The job; `None` if the call is not a documented cycle, or gives too little for one without errors.
    pub fn job(&self) -> Option<Value> {
        let units = if self.metric { Units::Mm } else { Units::Inch };
        let inch = if self.metric { 1.0 } else { 25.4 };
        // Ball radius and depth of the form.
        let (radius, depth) = (3.0 / inch, 10.0 / inch);
        let said = match self.name.strip_prefix("G65 P") {
            Some(number) => self.renishaw(number, radius, depth)?,
            None => match self.name.strip_prefix("TCH PROBE ") {
                Some(number) => self.heidenhain(number, radius, depth)?,
                None => self.sinumerik(self.name.strip_prefix("CYCLE")?, radius, depth)?,
            },
        };
        said.origin.iter().all(|x| x.is_finite()).then_some(())?;
        let mut job = default_job_in(said.cycle, units)?;
        set(&mut job, "units", Value::Text(units.word().to_owned()));
        set(
            &mut job,
            "cycle.origin",
            Value::List(said.origin.map(Value::Number).to_vec()),
        );
        for (key, value) in said.fields {
            set(&mut job, &format!("cycle.{key}"), Value::Number(value));
        }
        if let Some(overtravel) = said.overtravel {
            set(&mut job, "overtravel", Value::Number(overtravel));
        }
        if let Some(post) = self.post.or(said.post) {
            set(&mut job, "control.post", Value::Text(post.to_owned()));
        }
        // For controls that support native cycles only.
        if self.post.is_some() || said.post == Some("heidenhain") {
            set(
                &mut job,
                "control.form",
                Value::Text(ProgramForm::Cycle.word().to_owned()),
            );
        }
        if self.edition != Edition::Unknown {
            let edition = Value::Text(self.edition.word().to_owned());
            set(&mut job, "machine.edition", edition);
        }
        if let Some(offset) = said.offset {
            set(&mut job, "control.workOffset", Value::Number(offset));
        }
        let name = job_name(&job);
        set(&mut job, "name", Value::Text(name));
        check(&job)
            .iter()
            .all(|finding| finding.level != Level::Error)
            .then_some(job)
    }

    /// Renishaw's macros. Z and a move beside the feature mean an outside feature, or entry from above if R is negative.
    fn renishaw(&self, number: &str, radius: f64, depth: f64) -> Option<JobFromCall> {
        let [x, y, z] = self.place;
        // A program of calls has the heights of the stylus tip, a job those of the ball centre.
        let tip = if self.post.is_some() { radius } else { 0.0 };
        let beside = self.get("Z");
        let protected = self.get("R").is_some_and(|r| r < 0.0);
        let (inside, lifts) = (beside.is_none() || protected, protected);
        let mut clearance = self.get("R").map_or(5.0 * radius / 3.0, f64::abs) + radius;
        // The touches are at the stylus position, or at Z.
        let center = Vec3::new(x, y, beside.unwrap_or(z) + tip);
        let high = beside.map(|_| z + tip);
        // For a surface across Z it counts from the contact.
        let mut counted = radius;
        let unknown = |shape| Probed {
            center,
            lifts,
            high,
            ..Probed::unknown(shape, inside)
        };
        let probed = match number {
            "9814" => Probed {
                sizes: [self.get("D")?, f64::NAN],
                ..unknown(Shape::Bore)
            },
            "9812" => {
                let (along_x, along_y) = (self.get("X"), self.get("Y"));
                let axis = usize::from(along_x.is_none());
                Probed {
                    sizes: [along_x.xor(along_y)?, f64::NAN],
                    axis,
                    ..unknown(Shape::Width)
                }
            }
            "9811" => {
                let axes = [self.get("X"), self.get("Y"), self.get("Z")];
                let axis = axes
                    .iter()
                    .position(Option::is_some)
                    .filter(|_| axes.iter().flatten().count() == 1)?;
                let surface = axes[axis]?;
                let away = self.place[axis] - surface + if axis == 2 { tip } else { 0.0 };
                counted = if axis == 2 { radius - tip } else { radius };
                clearance = away.abs();
                let mut center = Vec3::from_array(self.place);
                center[axis] = surface;
                Probed {
                    center,
                    axis,
                    towards: -away.signum(),
                    ..Probed::unknown(Shape::Surface, false)
                }
            }
            _ => return None,
        };
        // G54.1 P1 is 101, and work offset 7 of a job.
        let offset = self.get("S").and_then(|s| match s {
            _ if s.fract() != 0.0 => None,
            1.0..=6.0 => Some(s),
            101.0..=148.0 => Some(s - 94.0),
            _ => None,
        });
        let overtravel = self.get("Q").map(|q| q + counted);
        Some(JobFromCall {
            overtravel,
            post: Some("fanuc"),
            offset,
            ..JobFromCall::of(&probed, clearance, depth)?
        })
    }

    /// CYCLE977 and CYCLE978, as the control's own editor writes them: argument 8 of the first is the search distance before and past each wall; 11 is the
    /// distance down from the stylus position, if the cycle goes down.
    fn sinumerik(&self, number: &str, radius: f64, depth: f64) -> Option<JobFromCall> {
        self.get("1")?;
        let at = Vec3::from_array(self.place);
        let probed = called(number.parse().ok()?, at, |place| {
            self.get(&place.to_string())
        })?;
        let overtravel = probed.set_up;
        let row = probed.row.map(|n| n - 10_000.0);
        let offset = row.filter(|n| (1.0..=99.0).contains(n));
        let post = Some("sinumerik");
        if probed.shape == Shape::Surface {
            let away = (probed.center - at)[probed.axis] * probed.towards;
            let said = JobFromCall::of(&probed, away, depth)?;
            return Some(JobFromCall {
                overtravel,
                post,
                offset,
                ..said
            });
        }
        // Centre that the offset is corrected to, if the call gives one.
        let given = self.get("27") == Some(11.0);
        let mut center = at;
        if given {
            self.get("28")?;
            (probed.shape == Shape::Width || self.get("29").is_some()).then_some(())?;
            center = probed.center;
        }
        // Without a centre 0, 0 is assumed: a job has no other position than that of the feature.
        let offset = offset.filter(|_| given || [at.x, at.y] == [0.0; 2]);
        let aside = probed.lifts || !probed.inside;
        center.z -= if aside { probed.down? } else { 0.0 };
        let high = Some(at.z);
        let said = JobFromCall::of(
            &Probed {
                center,
                high,
                ..probed
            },
            overtravel? + radius,
            depth,
        )?;
        Some(JobFromCall {
            overtravel,
            post,
            offset,
            ..said
        })
    }

    /// HEIDENHAIN cycles with a row.
    fn heidenhain(&self, number: &str, radius: f64, depth: f64) -> Option<JobFromCall> {
        let probed =
            row(number.parse().ok()?)?.probed(Vec3::NAN, |q| self.get(&format!("Q{q}")))?;
        let clearance = probed
            .set_up
            .map_or(5.0 * radius / 3.0, |set_up| set_up + radius);
        let offset = probed
            .row
            .filter(|row| (1.0..=99.0).contains(row) && row.fract() == 0.0);
        Some(JobFromCall {
            post: Some("heidenhain"),
            offset,
            ..JobFromCall::of(&probed, clearance, depth)?
        })
    }
}

impl JobFromCall {
    fn new(cycle: &'static str, fields: Vec<(&'static str, f64)>, origin: [f64; 3]) -> JobFromCall {
        JobFromCall {
            cycle,
            fields,
            origin,
            overtravel: None,
            post: None,
            offset: None,
        }
    }

    /// A surface across an axis whose touch begins at this distance; `None` if it faces downwards.
    fn of_surface(probed: &Probed, clearance: f64) -> Option<JobFromCall> {
        let (center, tool) = (probed.center, probed.axis == 2);
        let mut fields = vec![
            ("elevation", if tool { 90.0 } else { 0.0 }),
            ("clearance", clearance),
        ];
        // The surface faces the touch.
        match (probed.axis, probed.towards > 0.0) {
            (0, true) => fields.push(("rotation", 180.0)),
            (0, false) => fields.push(("rotation", 0.0)),
            (1, _) => fields.push(("rotation", -90.0 * probed.towards)),
            (_, true) => return None,
            (_, false) => {}
        }
        // From the start of the touch up to the clearance height.
        let begins = center.z + if tool { clearance } else { 0.0 };
        let up = probed.high.map(|high| ("feedDistance", high - begins));
        fields.extend(up.filter(|(_, far)| *far >= 0.0));
        Some(JobFromCall::new("surface", fields, center.to_array()))
    }

    /// The feature as a documented cycle. `clearance` is the distance from a contact to the start of its touch, `depth` that from the top side down.
    fn of(probed: &Probed, clearance: f64, depth: f64) -> Option<JobFromCall> {
        let Probed {
            shape,
            inside,
            center,
            sizes,
            axis,
            high,
            lifts,
            turn,
            ..
        } = *probed;
        let mut fields = vec![("depth", depth)];
        let top = center.z + depth;
        let kinds =
            |inner: &'static str, over: &'static str, out: &'static str| match (inside, lifts) {
                (true, false) => inner,
                (true, true) => over,
                (false, _) => out,
            };
        let cycle = match shape {
            Shape::Surface => return JobFromCall::of_surface(probed, clearance),
            Shape::Bore => {
                fields.extend([("diameter", sizes[0]), ("rotation", turn)]);
                if probed.start != 0.0 || probed.step != 90.0 {
                    let (start, step, count) = (probed.start, probed.step, probed.count);
                    fields.extend([
                        ("variant", 1.0),
                        ("startAngle", start),
                        ("angularStep", step),
                        ("stepCount", count),
                    ]);
                }
                kinds("hole", "hole-protected", "boss")
            }
            Shape::Width => {
                fields.extend([
                    ("width", sizes[0]),
                    ("rotation", if axis == 1 { 90.0 } else { 0.0 } + turn),
                ]);
                kinds("groove", "groove-protected", "web")
            }
            Shape::Rectangle => {
                fields.extend([
                    ("width1", sizes[0]),
                    ("width2", sizes[1]),
                    ("rotation", turn),
                ]);
                kinds(
                    "internal-rectangle",
                    "internal-rectangle-protected",
                    "external-rectangle",
                )
            }
        };
        if let Some(high) = high.filter(|high| *high > top) {
            fields.push(("topClearance", high - top));
            // If it does not cross between touches it comes down directly.
            if inside && !lifts {
                fields.push(("feedDistance", 0.0));
            }
        }
        if !inside || lifts {
            let sides: &[&str] = if shape == Shape::Rectangle {
                &["sideClearance1", "sideClearance2"]
            } else {
                &["sideClearance"]
            };
            fields.extend(sides.iter().map(|side| (*side, clearance)));
        }
        Some(JobFromCall::new(cycle, fields, [center.x, center.y, top]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn job(name: &str, arguments: &[(&str, f64)], place: [f64; 3]) -> Option<Value> {
        let arguments: Vec<(String, f64)> = arguments
            .iter()
            .map(|(name, value)| ((*name).to_owned(), *value))
            .collect();
        CallContext {
            name,
            post: None,
            edition: Edition::Unknown,
            arguments: &arguments,
            place,
            metric: true,
        }
        .job()
    }

    fn touches(job: &Value) -> Vec<[f64; 3]> {
        let plan = crate::job::plan(job).unwrap();
        let round = |x: f64| (x * 1e6).round() / 1e6 + 0.0;
        plan.touches
            .iter()
            .map(|touch| touch.point.map(round))
            .collect()
    }

    /// By hand: a hole of 25 about (1, 2), touched at the stylus position; a web of 30 along Y; a wall from the right.
    #[test]
    fn a_call_touches_where_its_job_does() {
        let hole = job(
            "G65 P9814",
            &[("D", 25.0), ("Q", 4.0), ("S", 2.0)],
            [1.0, 2.0, -5.0],
        )
        .unwrap();
        assert_eq!(
            touches(&hole),
            [
                [13.5, 2.0, -5.0],
                [-11.5, 2.0, -5.0],
                [1.0, 14.5, -5.0],
                [1.0, -10.5, -5.0]
            ]
        );
        assert_eq!(hole.get("overtravel"), Some(&Value::Number(7.0)));
        // G54.1 P3 is the ninth work offset.
        let written = |s: f64| {
            let hole = job("G65 P9814", &[("D", 25.0), ("S", s)], [0.0; 3])?;
            hole.get("control")?.get("workOffset").cloned()
        };
        assert_eq!(written(103.0), Some(Value::Number(9.0)));
        assert_eq!(written(149.0), Some(Value::Null));
        assert_eq!(
            hole.get("control").and_then(|c| c.get("workOffset")),
            Some(&Value::Number(2.0))
        );
        let web = job(
            "G65 P9812",
            &[("Y", 30.0), ("Z", -8.0), ("R", 4.0)],
            [0.0, 5.0, 12.0],
        )
        .unwrap();
        assert_eq!(touches(&web), [[0.0, 20.0, -8.0], [0.0, -10.0, -8.0]]);
        let wall = job("G65 P9811", &[("X", 10.0)], [22.0, 3.0, -4.0]).unwrap();
        assert_eq!(touches(&wall), [[10.0, 3.0, -4.0]]);
        let top = job(
            "TCH PROBE 417",
            &[
                ("Q263", 7.0),
                ("Q264", -12.0),
                ("Q294", 0.0),
                ("Q320", 12.0),
            ],
            [f64::NAN; 3],
        )
        .unwrap();
        assert_eq!(touches(&top), [[7.0, -12.0, 0.0]]);
        let circle = [
            ("Q321", 5.0),
            ("Q322", 6.0),
            ("Q262", 40.0),
            ("Q261", -5.0),
            ("Q320", 4.0),
            ("Q260", 20.0),
            ("Q301", 0.0),
        ];
        let hole = job("TCH PROBE 412", &circle, [f64::NAN; 3]).unwrap();
        assert_eq!(touches(&hole)[0], [25.0, 6.0, -5.0]);
        // Example from a generator's own documents: hole of 32 with a zone of 5, 16 deep, rotated by 11, G54, centre at X−3 Y15.
        let call = [
            (1, 1101.0),
            (2, 10001.0),
            (4, 1.0),
            (5, 32.0),
            (8, 7.0),
            (9, 5.0),
            (10, 11.0),
            (11, 16.0),
            (12, 5.0),
            (27, 11.0),
            (28, -3.0),
            (29, 15.0),
        ];
        let named = call.map(|(place, value)| {
            (
                [
                    "", "1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "12",
                ]
                .get(place)
                .copied()
                .unwrap_or(["27", "28", "29"][place.max(27) - 27]),
                value,
            )
        });
        let hole = job("CYCLE977", &named, [0.0, 0.0, 5.0]).unwrap();
        let [x, y, z] = touches(&hole)[0];
        let eleven = 11f64.to_radians();
        assert!(
            (x - (-3.0 + 16.0 * eleven.cos())).abs() < 1e-5
                && (y - (15.0 + 16.0 * eleven.sin())).abs() < 1e-5
                && z == -11.0,
            "{x} {y} {z}"
        );
        assert_eq!(
            hole.get("control").and_then(|c| c.get("workOffset")),
            Some(&Value::Number(1.0))
        );
        // `CYCLE978(0,,,1,-55,15,5,1,2,…)`: the surface at X−55, towards minus.
        let wall = job(
            "CYCLE978",
            &[
                ("1", 0.0),
                ("4", 1.0),
                ("5", -55.0),
                ("6", 15.0),
                ("7", 5.0),
                ("8", 1.0),
                ("9", 2.0),
            ],
            [-45.0, 2.0, -3.0],
        )
        .unwrap();
        assert_eq!(touches(&wall), [[-55.0, 2.0, -3.0]]);
        assert_eq!(
            crate::job::plan(&wall).unwrap().touches[0].vector,
            [1.0, 0.0, 0.0]
        );
        // Unknown values, an undocumented cycle and a wrong call give no job.
        assert!(job("G65 P9814", &[("D", 25.0)], [f64::NAN, 2.0, 5.0]).is_none());
        assert!(job("G65 P9812", &[("X", 5.0), ("Y", 5.0)], [0.0; 3]).is_none());
        assert!(
            job("G65 P9834", &[], [0.0; 3]).is_none()
                && job("G65 P9814", &[("D", 1.0)], [0.0; 3]).is_none()
        );
    }
}
