//! Places that follow a result of an earlier cycle: `"=TOP.z-5"` in the origin of a cycle of a set-up.

use crate::control::Form;
use crate::form::{Checker, Value, printable};
use crate::formula::{Formula, Role, Variable};
use crate::geom::Vec3;
use crate::job::Job;
use crate::job::planned::{Planned, several};
use crate::num::{decimal, tidy};
use crate::part::Run;
use crate::path::{Path, Purpose, Shifts, ZERO_LENGTH, far_apart};
use crate::text::text;
use crate::{formula, part};

/// The most characters of such a text.
pub const LONGEST_PLACE: usize = 64;

/// Along X, Y and Z, the cycle and the code of the result that a cycle follows.
pub type Follows = [Option<(usize, &'static str)>; 3];

/// A text that begins with a result: its name, and what is added to it in the job's units.
struct Sum<'t> {
    name: &'t str,
    added: f64,
}

impl<'t> Sum<'t> {
    fn of(text: &'t str) -> Option<Sum<'t>> {
        // Other white space does not come back from a header.
        let inner = text.trim_matches(' ').strip_prefix('=').filter(|_| text.len() <= LONGEST_PLACE)?;
        let (name, added) = inner.split_at(inner.find(['+', '-']).unwrap_or(inner.len()));
        let added: String = added.chars().filter(|c| *c != ' ').map(|c| if c == ',' { '.' } else { c }).collect();
        let digits = added.strip_prefix(['+', '-']).unwrap_or(&added);
        let added = match added.as_str() {
            "" => Some(0.0),
            text if digits.bytes().all(|b| b.is_ascii_digit() || b == b'.') => {
                crate::num::read(text.strip_prefix('+').unwrap_or(text)).filter(|x| x.is_finite())
            }
            _ => None,
        };
        Some(Sum { name: name.trim_matches(' '), added: added? }).filter(|sum| !sum.name.is_empty())
    }
}

/// The text with another number added, as in other units. `None` for a text that is not a sum of a result and a number.
pub fn convert(text: &str, change: impl Fn(f64) -> f64) -> Option<String> {
    let Sum { name, added } = Sum::of(text)?;
    let added = change(added);
    let sign = if added < 0.0 { "-" } else { "+" };
    Some(if added == 0.0 { format!("={name}") } else { format!("={name}{sign}{}", decimal(added.abs(), 6)) })
}

/// The cycles that were read before the one that follows: their names, and of each that has no error its job.
pub struct Earlier<'a> {
    pub names: &'a [String],
    pub jobs: &'a [Option<Job>],
}

/// Puts the nominal value of each result that the origin of cycle `index` follows in its place. Reports what is wrong with it; the cycle is read on with a
/// zero there.
pub fn take(checker: &mut Checker, single: &mut Value, index: usize, earlier: &Earlier<'_>) -> Follows {
    let mut follows = [None; 3];
    let Some(Value::List(origin)) = origin_of(single) else { return follows };
    for (axis, item) in origin.iter_mut().enumerate().take(3) {
        let Value::Text(text) = item else { continue };
        if !text.trim_start_matches(' ').starts_with('=') {
            continue;
        }
        let path = format!("cycles[{index}].origin[{axis}]");
        let followed = one(checker, text, (axis, &path), earlier);
        let nominal = followed.as_ref().map_or(0.0, |(_, nominal)| *nominal);
        follows[axis] = followed.map(|(follow, _)| follow);
        *item = Value::Number(nominal);
    }
    follows
}

fn origin_of(single: &mut Value) -> Option<&mut Value> {
    let Value::Map(entries) = single else { return None };
    let (_, cycle) = entries.iter_mut().rev().find(|(key, _)| key == "cycle")?;
    let Value::Map(entries) = cycle else { return None };
    entries.iter_mut().rev().find(|(key, _)| key == "origin").map(|(_, origin)| origin)
}

/// What one place follows, and where it is on the nominal part, in the job's units.
fn one(
    checker: &mut Checker,
    text: &str,
    (axis, path): (usize, &str),
    earlier: &Earlier<'_>,
) -> Option<((usize, &'static str), f64)> {
    let refuse = |checker: &mut Checker, message| {
        checker.error("place-of-result", path, message);
        None
    };
    let Some(Sum { name, added }) = Sum::of(text) else {
        let message = text!(
            "\"{given}\" is no place: a result of an earlier cycle and a number, as in =TOP.z-5",
            printable(text).chars().take(LONGEST_PLACE).collect::<String>()
        );
        return refuse(checker, message);
    };
    // An error in an earlier cycle is reported there.
    if earlier.jobs.iter().any(Option::is_none) {
        return None;
    }
    let jobs: Vec<&Job> = earlier.jobs.iter().flatten().collect();
    let (of, code) = name.split_once('.').unwrap_or((name, ""));
    let short = ["x", "y", "z"].iter().position(|letter| code.eq_ignore_ascii_case(letter));
    let own = earlier.names.iter().take(jobs.len()).position(|name| name.eq_ignore_ascii_case(of));
    let own = own.into_iter().flat_map(|cycle| places(jobs[cycle]).into_iter().map(move |place| (cycle, place)));
    let is = |place: &Place| place.code.eq_ignore_ascii_case(code) || short.is_some_and(|letter| letter == place.letter);
    let mut found = own.filter(|(_, place)| is(place));
    let (cycle, place) = match (found.next(), found.next()) {
        (Some(one), None) => one,
        (None, _) => {
            let of = |(job, name): (&&Job, &String)| {
                places(job).into_iter().map(|place| format!("{name}.{}", place.code)).collect::<Vec<_>>()
            };
            let names: Vec<String> = jobs.iter().zip(earlier.names).flat_map(of).collect();
            let name = printable(name);
            let message = if names.is_empty() {
                text!("No cycle before this one measures a place \"{name}\"", name)
            } else {
                text!("No cycle before this one measures a place \"{name}\". There are {known}", name, names.join(", "))
            };
            return refuse(checker, message);
        }
        (Some(_), Some(_)) => {
            let message = text!("\"{name}\" is more than one result: write its whole code", printable(name));
            return refuse(checker, message);
        }
    };
    let job = jobs[cycle];
    if place.axis != axis {
        let names = crate::geom::AXIS_NAMES;
        let message = text!(
            "{name} is a place along {axis}, and this one is along {other}",
            printable(name),
            names[place.axis],
            names[axis]
        );
        return refuse(checker, message);
    }
    if several(job).is_some() || job.form == Form::Cycle {
        let message = text!(
            "The control's own cycles keep their results in variables, and this program does not compute with those: use the form \"moves\""
        );
        checker.error("set-up-unsupported", path, message);
        return None;
    }
    if !job.post.computes {
        let message =
            text!("{control} cannot compute: the place of a cycle cannot follow a result there", job.post.title.to_owned());
        checker.error("set-up-unsupported", path, message);
        return None;
    }
    if job.limits.position.is_none() {
        let message = text!(
            "A place that follows a result needs limits.position: how far from the nominal place the path may be shifted"
        );
        checker.error("place-of-result", path, message);
        return None;
    }
    Some(((cycle, place.code), tidy(place.nominal / job.scale + added)))
}

/// A place that a cycle measures along an axis.
struct Place {
    code: &'static str,
    /// 0, 1, 2: abscissa, ordinate, tool axis.
    letter: usize,
    /// The axis of the machine.
    axis: usize,
    /// What it is on the nominal part, mm.
    nominal: f64,
}

/// The places that a cycle measures.
fn places(job: &Job) -> Vec<Place> {
    let formula: Formula = job.cycle.formula(&job.setup);
    let axes = job.setup.plane.axes();
    let datum = formula.datum.map(|datum| datum.place.map(|place| place.and_then(|place| place.measured)));
    let in_datum =
        |variable: Option<Variable>| (0..3).find(|i| variable.is_some() && datum.is_some_and(|datum| datum[*i] == variable));
    let of = |result: &formula::ResultDef| {
        let letter = match result.role {
            Role::Abscissa => 0,
            Role::Ordinate => 1,
            Role::Level => 2,
            // Along a surface nothing is measured.
            Role::Reading => in_datum(result.variable)?,
            _ => return None,
        };
        result.variable?;
        Some(Place { code: result.code, letter, axis: axes[letter], nominal: result.nominal })
    };
    formula.results.iter().filter_map(of).collect()
}

/// Runs the cycles that follow results again, on the virtual part: shifted by what the control measures there. Before a cycle that would be shifted beyond
/// the limit the program stops: it and all behind it are not reached.
pub fn run(whole: &mut Planned) {
    if whole.path.shifts.is_empty() {
        return;
    }
    for m in 0..whole.members.len() {
        // What a cycle is asked about, and shifted by, comes from those before it.
        let asked = whole.path.asked_before(m, &whole.job.limits);
        if whole.path.members[m].follows == [None; 3] {
            continue;
        }
        let values = part::numbers(&whole.path, &triggers(whole));
        if let Some(question) = asked.iter().find(|question| !question.holds(values[question.variable.index()])) {
            for planned in &mut whole.members[m..] {
                let triggers = vec![None; planned.path.touches.len()];
                planned.run = Run { triggers, halt: Some((m, question.result)), ..Run::default() };
            }
            return;
        }
        let by = shift(&whole.path, &values, whole.path.members[m].moves.start);
        if by != Vec3::ZERO {
            let planned = &mut whole.members[m];
            let run = part::run(&moved(&planned.path, |_| by), &planned.surfaces, &planned.job.setup);
            planned.run = Run { shift: by, ..run };
        }
    }
}

/// The triggers of all cycles as they were run.
fn triggers(whole: &Planned) -> Vec<Option<Vec3>> {
    whole.members.iter().flat_map(|planned| planned.run.triggers.iter().copied()).collect()
}

/// How far a move is shifted, mm; not at all where that is not known.
fn shift(path: &Path, values: &[f64], index: usize) -> Vec3 {
    let by = |shift: Option<Variable>| shift.map(|shift| values[shift.index()]).filter(|by| by.is_finite()).unwrap_or(0.0);
    Vec3::from_array(path.shifts(index).map(by))
}

/// The whole path as it runs on the virtual part. `None` if that is the path of the drawing.
pub fn actual(whole: &Planned) -> Option<Path> {
    if whole.path.shifts.is_empty() || whole.job.placement.nominal {
        return None;
    }
    let values = part::numbers(&whole.path, &triggers(whole));
    Some(moved(&whole.path, |index| shift(&whole.path, &values, index)))
}

/// Says before which cycle the program stops on the virtual part, and why.
pub fn report(whole: &Planned, checker: &mut Checker) {
    let Some((m, result)) = whole.run.halt else { return };
    let Some(question) = whole.path.formula.leads(result, &whole.job.limits) else { return };
    // Where a touch meets nothing, that is said.
    let value = part::numbers(&whole.path, &whole.run.triggers)[question.variable.index()];
    if !value.is_finite() {
        return;
    }
    let message = text!(
        "On this part the program stops before {cycle}: {result} is {value}, more than {limit} from {wanted}",
        whole.path.members[m].name.clone(),
        whole.path.formula.full_code(&whole.path.formula.results[result]).into_owned(),
        checker.length(value),
        checker.length(question.limit),
        checker.length(question.wanted)
    );
    checker.warning("place-too-far", if whole.job.placement.nominal { "limits" } else { "part" }, message);
}

/// Checks the ways of which one end follows a result and the other does not: the shift must neither turn a way down upwards, nor make one too short to be
/// watched. Where one cycle lies over the other, the way across is nothing but the shift: it is not watched.
pub fn check_ways(whole: &Planned, checker: &mut Checker) {
    let Planned { job, path, .. } = whole;
    let w = path.frame.w;
    let only = |shifts: Shifts, tool: bool| [0, 1, 2].map(|axis| shifts[axis].filter(|_| (w[axis].abs() > 0.5) == tool));
    for (index, pair) in path.moves.windows(2).enumerate() {
        let (before, now) = (path.shifts(index), path.shifts(index + 1));
        let way = pair[1].to - pair[0].to;
        let far = |tool: bool| far_apart(only(before, tool), only(now, tool), path.most_shift);
        let along = way.dot(w);
        let ways = [(far(true), along.abs(), true), (far(false), (way - w * along).length(), job.protected)];
        let short = ways.into_iter().enumerate().find(|(k, (far, length, asked))| {
            let over = *k == 1 && *length <= ZERO_LENGTH;
            *asked && *far > 0.0 && !over && *length < far + job.post.shortest_probe - 1e-9
        });
        let Some((k, (far, length, _))) = short else { continue };
        let member = path.member_of_move(index + 1).unwrap_or(0);
        let (name, least) = (path.members[member].name.clone(), checker.length(far + job.post.shortest_probe));
        let (number, length, far) = (index + 2, checker.length(length), checker.length(far));
        if k == 0 {
            let message = text!(
                "Move {move}, the way down to {cycle}, is {way} long, and a result may shift its end by {far}: raise the height between cycles until it is at least {least}",
                number,
                name,
                length,
                far,
                least
            );
            return checker.error("clear-too-low", "clear", message);
        }
        let message = text!(
            "Move {move}, the way across to {cycle}, is {way} long, and a result may shift its end by {far}: it must be at least {least}, or limits.position smaller",
            number,
            name,
            length,
            far,
            least
        );
        return checker.error("place-of-result", format!("cycles[{member}].origin"), message);
    }
}

/// The same path, each move elsewhere; of a set-up where it begins stays, since its first cycle follows nothing.
pub fn moved(path: &Path, by: impl Fn(usize) -> Vec3) -> Path {
    let mut path = path.clone();
    for index in 0..path.moves.len() {
        let by = by(index);
        let step = &mut path.moves[index];
        step.to += by;
        if let Some(arc) = &mut step.arc {
            arc.center += by;
        }
        if let Purpose::Touch(k) = step.purpose {
            path.touches[k].point += by;
        }
    }
    path.start = path.start.map(|start| start + if path.members.is_empty() { by(0) } else { Vec3::ZERO });
    path
}
