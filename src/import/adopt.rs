//! A call of a control's own cycle as a job, where it is one of the documented cycles: from its arguments and from where the stylus stands.
//!
//! What a call does not say has the form's default; the order of the touches is the documented cycle's, not the control's. That Renishaw's Q is counted by the ball's centre behind the nominal surface, so that the overtravel is Q
//! and the ball's radius, and R from the ball's surface, follows from the macros [I].

use crate::form::{Level, Value};
use crate::import::set;
use crate::job::{Units, check, default_job_in, job_name};

/// A call, as far as a job needs it.
pub(super) struct Called<'a> {
    pub name: &'a str,
    /// Names and values of its arguments; NaN is not known.
    pub arguments: &'a [(String, f64)],
    /// Where the stylus stands, in the program's units; NaN is not known.
    pub place: [f64; 3],
    pub metric: bool,
}

/// What a call says of a job.
struct Said {
    cycle: &'static str,
    fields: Vec<(&'static str, f64)>,
    origin: [f64; 3],
    overtravel: Option<f64>,
    post: Option<&'static str>,
    offset: Option<f64>,
}

impl Called<'_> {
    fn get(&self, name: &str) -> Option<f64> {
        self.arguments.iter().find(|(known, value)| known == name && value.is_finite()).map(|(_, value)| *value)
    }

    /// The job; none where the call is none of the documented cycles, or does not say enough for one without errors.
    pub fn job(&self) -> Option<Value> {
        let units = if self.metric { Units::Mm } else { Units::Inch };
        let inch = if self.metric { 1.0 } else { 25.4 };
        // The ball and the depth of the form.
        let (radius, depth) = (3.0 / inch, 10.0 / inch);
        let said = match self.name.strip_prefix("G65 P") {
            Some(number) => self.renishaw(number, radius, depth)?,
            None => self.heidenhain(self.name.strip_prefix("TCH PROBE ")?, radius, depth)?,
        };
        said.origin.iter().all(|x| x.is_finite()).then_some(())?;
        let mut job = default_job_in(said.cycle, units)?;
        set(&mut job, "units", Value::Text(units.word().to_owned()));
        set(&mut job, "cycle.origin", Value::List(said.origin.map(Value::Number).to_vec()));
        for (key, value) in said.fields {
            set(&mut job, &format!("cycle.{key}"), Value::Number(value));
        }
        if let Some(overtravel) = said.overtravel {
            set(&mut job, "overtravel", Value::Number(overtravel));
        }
        if let Some(post) = said.post {
            set(&mut job, "control.post", Value::Text(post.to_owned()));
        }
        if let Some(offset) = said.offset {
            set(&mut job, "control.workOffset", Value::Number(offset));
        }
        let name = job_name(&job);
        set(&mut job, "name", Value::Text(name));
        check(&job).iter().all(|finding| finding.level != Level::Error).then_some(job)
    }

    fn renishaw(&self, number: &str, radius: f64, depth: f64) -> Option<Said> {
        let [x, y, z] = self.place;
        let protected = self.get("R").is_some_and(|r| r < 0.0);
        let outside = self.get("Z").is_some() && !protected;
        // The touches are where the stylus stands, or at Z.
        let top = self.get("Z").unwrap_or(z) + depth;
        let mut fields = vec![("depth", depth)];
        if self.get("Z").is_some() {
            fields.push(("sideClearance", self.get("R").map_or(5.0 * radius / 3.0, f64::abs) + radius));
            if z > top {
                fields.push(("topClearance", z - top));
            }
        }
        let kind = |inside: &'static str, over: &'static str, out: &'static str| match (outside, protected) {
            (true, _) => out,
            (false, true) => over,
            (false, false) => inside,
        };
        let (cycle, origin) = match number {
            "9814" => {
                fields.push(("diameter", self.get("D")?));
                (kind("hole", "hole-protected", "boss"), [x, y, top])
            }
            "9812" => {
                let along_x = self.get("X");
                fields.push(("width", along_x.xor(self.get("Y"))?));
                fields.push(("rotation", if along_x.is_some() { 0.0 } else { 90.0 }));
                (kind("groove", "groove-protected", "web"), [x, y, top])
            }
            "9811" => {
                let axes = [self.get("X"), self.get("Y"), self.get("Z")];
                let axis = axes.iter().position(Option::is_some).filter(|_| axes.iter().flatten().count() == 1)?;
                let surface = axes[axis]?;
                let away = self.place[axis] - surface;
                let turn = [0.0, 90.0][usize::from(axis == 1)] + if away < 0.0 { 180.0 } else { 0.0 };
                fields = vec![("clearance", away.abs()), ("elevation", if axis == 2 { 90.0 } else { 0.0 })];
                if axis < 2 {
                    fields.push(("rotation", if turn > 180.0 { turn - 360.0 } else { turn }));
                }
                let mut origin = self.place;
                origin[axis] = surface;
                ("surface", origin)
            }
            _ => return None,
        };
        let offset = self.get("S").filter(|s| s.fract() == 0.0 && (1.0..=6.0).contains(s));
        Some(Said { cycle, fields, origin, overtravel: self.get("Q").map(|q| q + radius), post: Some("fanuc"), offset })
    }

    fn heidenhain(&self, number: &str, radius: f64, depth: f64) -> Option<Said> {
        let centre = || Some([self.get("Q321").or(self.get("Q273"))?, self.get("Q322").or(self.get("Q274"))?]);
        let top = || Some(self.get("Q261")? + depth);
        let protected = self.get("Q301").is_some_and(|q| q == 1.0);
        let clearance = self.get("Q320").map_or(5.0 * radius / 3.0, |q| q + radius);
        let mut fields = vec![("depth", depth)];
        if let (Some(height), Some(top)) = (self.get("Q260"), top())
            && height > top
        {
            fields.push(("topClearance", height - top));
        }
        let (cycle, origin) = match number {
            "412" | "421" | "413" | "422" => {
                fields.push(("diameter", self.get("Q262")?));
                let (start, step) = (self.get("Q325").unwrap_or(0.0), self.get("Q247").unwrap_or(90.0));
                if start != 0.0 || step != 90.0 {
                    let count = self.get("Q423").unwrap_or(4.0);
                    fields.extend([("variant", 1.0), ("startAngle", start), ("angularStep", step), ("stepCount", count)]);
                }
                let inside = matches!(number, "412" | "421");
                if !inside || protected {
                    fields.push(("sideClearance", clearance));
                }
                let cycle = match (inside, protected) {
                    (true, false) => "hole",
                    (true, true) => "hole-protected",
                    (false, _) => "boss",
                };
                let [x, y] = centre()?;
                (cycle, [x, y, top()?])
            }
            "410" | "423" | "411" | "424" => {
                fields.push(("width1", self.get("Q323").or(self.get("Q282"))?));
                fields.push(("width2", self.get("Q324").or(self.get("Q283"))?));
                let inside = matches!(number, "410" | "423");
                if !inside || protected {
                    fields.extend([("sideClearance1", clearance), ("sideClearance2", clearance)]);
                }
                let cycle = match (inside, protected) {
                    (true, false) => "internal-rectangle",
                    (true, true) => "internal-rectangle-protected",
                    (false, _) => "external-rectangle",
                };
                let [x, y] = centre()?;
                (cycle, [x, y, top()?])
            }
            "417" => {
                fields = vec![("elevation", 90.0), ("clearance", clearance)];
                ("surface", [self.get("Q263")?, self.get("Q264")?, self.get("Q294")?])
            }
            _ => return None,
        };
        Some(Said { cycle, fields, origin, overtravel: None, post: None, offset: None })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn job(name: &str, arguments: &[(&str, f64)], place: [f64; 3]) -> Option<Value> {
        let arguments: Vec<(String, f64)> = arguments.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        Called { name, arguments: &arguments, place, metric: true }.job()
    }

    fn touches(job: &Value) -> Vec<[f64; 3]> {
        let plan = crate::job::plan(job).unwrap();
        let round = |x: f64| (x * 1e6).round() / 1e6 + 0.0;
        plan.touches.iter().map(|touch| touch.point.map(round)).collect()
    }

    /// By hand: a hole of 25 about (1, 2), touched where the stylus stands; a web of 30 along Y; a wall from the right.
    #[test]
    fn a_call_touches_where_its_job_does() {
        let hole = job("G65 P9814", &[("D", 25.0), ("Q", 4.0), ("S", 2.0)], [1.0, 2.0, -5.0]).unwrap();
        assert_eq!(touches(&hole), [[13.5, 2.0, -5.0], [-11.5, 2.0, -5.0], [1.0, 14.5, -5.0], [1.0, -10.5, -5.0]]);
        assert_eq!(hole.get("overtravel"), Some(&Value::Number(7.0)));
        assert_eq!(hole.get("control").and_then(|c| c.get("workOffset")), Some(&Value::Number(2.0)));
        let web = job("G65 P9812", &[("Y", 30.0), ("Z", -8.0), ("R", 4.0)], [0.0, 5.0, 12.0]).unwrap();
        assert_eq!(touches(&web), [[0.0, 20.0, -8.0], [0.0, -10.0, -8.0]]);
        let wall = job("G65 P9811", &[("X", 10.0)], [22.0, 3.0, -4.0]).unwrap();
        assert_eq!(touches(&wall), [[10.0, 3.0, -4.0]]);
        let top =
            job("TCH PROBE 417", &[("Q263", 7.0), ("Q264", -12.0), ("Q294", 0.0), ("Q320", 12.0)], [f64::NAN; 3]).unwrap();
        assert_eq!(touches(&top), [[7.0, -12.0, 0.0]]);
        let circle =
            [("Q321", 5.0), ("Q322", 6.0), ("Q262", 40.0), ("Q261", -5.0), ("Q320", 4.0), ("Q260", 20.0), ("Q301", 0.0)];
        let hole = job("TCH PROBE 412", &circle, [f64::NAN; 3]).unwrap();
        assert_eq!(touches(&hole)[0], [25.0, 6.0, -5.0]);
        // What is not known makes no job; nor does what is no documented cycle, or is wrong.
        assert!(job("G65 P9814", &[("D", 25.0)], [f64::NAN, 2.0, 5.0]).is_none());
        assert!(job("G65 P9812", &[("X", 5.0), ("Y", 5.0)], [0.0; 3]).is_none());
        assert!(job("G65 P9834", &[], [0.0; 3]).is_none() && job("G65 P9814", &[("D", 1.0)], [0.0; 3]).is_none());
    }
}
