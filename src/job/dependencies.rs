//! Values that follow a result of an earlier cycle in a set-up: a position, `"=TOP.z-5"`, a rotation, `"=SIDE.rotation+90"`, a size, `"=BORE.diameter-2"`.

use std::cell::OnceCell;

use crate::control::ProgramForm;
use crate::form::{Checker, Field, Level, Value, printable};
use crate::formula::{Formula, Role, Variable};
use crate::geom::{Plane, Vec3};
use crate::job::Job;
use crate::job::planned::{FollowingJob, PlannedJob, several};
use crate::job::relations::Relations;
use crate::num::{decimal, tidy, wrap_degrees};
use crate::part::PartRun;
use crate::path::{
    Dependencies, FollowedValue, MovePurpose, Path, ResultSource, Sensitivity, Shifts, ZERO_LENGTH,
    far_apart,
};
use crate::text::{Text, text};
use crate::{formula, part};

/// Longest text of this kind, characters.
pub const LONGEST_PLACE: usize = 64;

/// A parsed text: name of the result, and the added number in the job's units.
struct ResultExpression<'t> {
    name: &'t str,
    added: f64,
}

impl<'t> ResultExpression<'t> {
    fn of(text: &'t str) -> Option<ResultExpression<'t>> {
        // Other white space is lost in a header.
        let inner = text
            .trim_matches(' ')
            .strip_prefix('=')
            .filter(|_| text.len() <= LONGEST_PLACE)?;
        let (name, added) = inner.split_at(inner.find(['+', '-']).unwrap_or(inner.len()));
        let added: String = added
            .chars()
            .filter(|c| *c != ' ')
            .map(|c| if c == ',' { '.' } else { c })
            .collect();
        let digits = added.strip_prefix(['+', '-']).unwrap_or(&added);
        let added = match added.as_str() {
            "" => Some(0.0),
            text if digits.bytes().all(|b| b.is_ascii_digit() || b == b'.') => {
                crate::num::read(text.strip_prefix('+').unwrap_or(text)).filter(|x| x.is_finite())
            }
            _ => None,
        };
        Some(ResultExpression {
            name: name.trim_matches(' '),
            added: added?,
        })
        .filter(|sum| !sum.name.is_empty())
    }
}

/// The text with another number, such as in other units. `None` for any text but a sum of a result and a number.
pub fn convert(text: &str, change: impl Fn(f64) -> f64) -> Option<String> {
    let ResultExpression { name, added } = ResultExpression::of(text)?;
    let added = change(added);
    let sign = if added < 0.0 { "-" } else { "+" };
    Some(if added == 0.0 {
        format!("={name}")
    } else {
        format!("={name}{sign}{}", decimal(added.abs(), 6))
    })
}

/// Results that a cycle can follow.
pub struct EarlierCycles<'a> {
    /// Joined path of the earlier cycles, with the relations that cycles follow.
    pub path: &'a Path,
    pub relations: &'a Relations<'a>,
    /// Job of the first cycle: control and limits apply to all cycles.
    pub first: Option<&'a Job>,
    /// Whether an earlier cycle has errors, which are reported there.
    pub broken: bool,
    /// The path with every computable relation, made for messages that list the results.
    pub all: OnceCell<Path>,
}

/// Names of the cycles and relations that these cycles follow.
pub fn followed(cycles: &[Value]) -> Vec<&str> {
    let values = cycles.iter().flat_map(|cycle| match cycle {
        Value::Map(entries) => entries.as_slice(),
        _ => &[],
    });
    let texts = values.flat_map(|(_, value)| match value {
        Value::List(list) => list.as_slice(),
        other => std::slice::from_ref(other),
    });
    texts
        .filter_map(|text| ResultExpression::of(result_text(text)?))
        .filter_map(|sum| sum.name.split('.').next())
        .collect()
}

/// Dependencies of a cycle whose sizes are not tried yet.
#[derive(Debug, Default)]
pub struct PendingDependencies {
    pub follows: Dependencies,
    /// Keys of the sizes that follow a result, with the indices of the results.
    sizes: Vec<(String, usize)>,
}

/// Replaces each followed result of cycle `index` by its nominal value, and reports faults. On a fault the cycle is read on with 0, or with the default size.
pub fn read_dependencies(
    checker: &mut Checker,
    single: &mut Value,
    index: usize,
    earlier: &EarlierCycles<'_>,
) -> PendingDependencies {
    let mut wanted = PendingDependencies::default();
    let Some(entries) = cycle_of(single) else {
        return wanted;
    };
    let def = entries
        .iter()
        .rev()
        .find(|(key, _)| key == "type")
        .and_then(|(_, value)| match value {
            Value::Text(key) => crate::cycle::find(key),
            _ => None,
        });
    let fields = def.map_or(&[][..], |def| def.fields);
    let (mut places, mut rotates, mut unknown) = ([const { None }; 3], None, Vec::new());
    for (key, value) in entries.iter_mut() {
        let field = fields.iter().find(|field| field.key == key);
        match value {
            Value::List(origin) if key == "origin" => {
                for (axis, item) in origin.iter_mut().enumerate().take(3) {
                    let Some(text) = result_text(item) else {
                        continue;
                    };
                    let path = format!("cycles[{index}].origin[{axis}]");
                    let found = read_expression(checker, text, (Kind::Place(axis), &path), earlier);
                    *item = Value::Number(found.as_ref().map_or(0.0, |found| found.nominal));
                    places[axis] = found;
                }
            }
            _ if key == "rotation" && field.is_some() => {
                let Some(text) = result_text(value) else {
                    continue;
                };
                let path = format!("cycles[{index}].rotation");
                let found = read_expression(checker, text, (Kind::Rotation, &path), earlier);
                *value = Value::Number(
                    found
                        .as_ref()
                        .map_or(0.0, |found| wrap_degrees(found.nominal)),
                );
                rotates = found;
            }
            _ if field.is_some_and(may_follow) => {
                let Some(text) = result_text(value) else {
                    continue;
                };
                let path = format!("cycles[{index}].{key}");
                let found = read_expression(checker, text, (Kind::Size, &path), earlier);
                // If it is unknown the cycle is read on with the default.
                *value = Value::Number(found.as_ref().map_or(0.0, |found| found.nominal));
                if found.is_none() {
                    unknown.push(key.clone());
                }
                wanted
                    .sizes
                    .extend(found.map(|found| (key.clone(), found.of)));
            }
            _ => {}
        }
    }
    entries.retain(|(key, _)| !unknown.contains(key));
    wanted.follows.rotation = rotates.map(|found| found.of);
    wanted.follows.place = places
        .each_ref()
        .map(|found| found.as_ref().map(|found| found.of));
    wanted.follows.about =
        Vec3::from_array(places.map(|found| found.map_or(f64::NAN, |found| found.place)));
    wanted
}

/// Whether a field is a size that may follow a result: not a text with a tolerance, as in 1411.
fn may_follow(field: &Field) -> bool {
    field.size && field.kind == crate::form::Kind::Length
}

/// Text after the equals sign of a value that follows a result.
fn result_text(value: &Value) -> Option<&str> {
    match value {
        Value::Text(text) => {
            Some(text.as_str()).filter(|text| text.trim_start_matches(' ').starts_with('='))
        }
        _ => None,
    }
}

fn cycle_of(single: &mut Value) -> Option<&mut Vec<(String, Value)>> {
    let Value::Map(entries) = single else {
        return None;
    };
    let (_, cycle) = entries.iter_mut().rev().find(|(key, _)| key == "cycle")?;
    match cycle {
        Value::Map(entries) => Some(entries),
        _ => None,
    }
}

/// Kind of the value that follows a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Coordinate along an axis.
    Place(usize),
    Rotation,
    Size,
}

/// A followed result.
struct FollowedResult {
    /// Its index in the joined path.
    of: usize,
    /// Value for the cycle on the nominal part, in the job's units or degrees.
    nominal: f64,
    /// Value of the result on the nominal part, mm or degrees.
    place: f64,
}

/// Reads one text: the followed result and its nominal value.
fn read_expression(
    checker: &mut Checker,
    text: &str,
    (kind, path): (Kind, &str),
    earlier: &EarlierCycles<'_>,
) -> Option<FollowedResult> {
    let Some(ResultExpression { name, added }) = ResultExpression::of(text) else {
        checker.error("place-of-result", path, not_a_sum(text, kind));
        return None;
    };
    if earlier.broken {
        return None;
    }
    let result = match find(name, kind, earlier) {
        Ok(result) => result,
        Err(why) => {
            checker.error("place-of-result", path, why);
            return None;
        }
    };
    let job = earlier.first?;
    if let Some(why) = cannot_follow(job, kind) {
        checker.error("set-up-unsupported", path, why);
        return None;
    }
    if let Some(missing) = missing_limit(job, kind) {
        checker.error("place-of-result", path, missing);
        return None;
    }
    let unit = match kind {
        Kind::Rotation => 1.0,
        Kind::Place(_) | Kind::Size => job.scale,
    };
    Some(FollowedResult {
        of: result.index,
        nominal: tidy(result.nominal / unit + added),
        place: result.nominal,
    })
}

/// Message for a text that is not a sum of a result and a number.
fn not_a_sum(text: &str, kind: Kind) -> Text {
    let given: String = printable(text).chars().take(LONGEST_PLACE).collect();
    match kind {
        Kind::Place(_) => text!(
            "\"{given}\" is no position: enter a result of an earlier cycle and a number, as in =TOP.z-5",
            given
        ),
        Kind::Rotation => text!(
            "\"{given}\" is no angle: a direction that an earlier cycle measures and a number, as in =SIDE.rotation+90",
            given
        ),
        Kind::Size => text!(
            "\"{given}\" is no size: a size that an earlier cycle measures and a number, as in =BORE.diameter-2",
            given
        ),
    }
}

/// The result with this name and kind, or the reason why no such result exists.
fn find(name: &str, kind: Kind, earlier: &EarlierCycles<'_>) -> Result<Known, Text> {
    let (of, code) = name.split_once('.').unwrap_or((name, ""));
    let is_code = |known: &str| code.eq_ignore_ascii_case(known);
    let letter = ["x", "y", "z"].iter().position(|known| is_code(known));
    let is = |known: &Known| is_code(known.code) || letter.is_some() && letter == known.letter;
    let path = earlier.path;
    let plane = earlier.first.map_or(Plane::G17, |job| job.setup.plane);
    let results_of =
        |path: &Path, own: &ResultSource<'_>| known(&path.formula, own, plane.axes(), kind);
    let source = path
        .measuring()
        .find(|own| own.name.eq_ignore_ascii_case(of));
    let own = source.as_ref().map(|own| results_of(path, own));
    let mut found = own.into_iter().flatten().filter(is);
    let result = match (found.next(), found.next()) {
        (Some(one), None) => one,
        (Some(_), Some(_)) => {
            return Err(text!(
                "\"{name}\" is more than one result: write its whole code",
                printable(name)
            ));
        }
        (None, _) => {
            let lacks = earlier
                .relations
                .lacks(path, of)
                .filter(|_| source.is_none());
            if let Some(error) = lacks {
                return Err(text!(
                    "{name} cannot be computed before this cycle: {error}",
                    printable(of),
                    error
                ));
            }
            let all = earlier
                .all
                .get_or_init(|| earlier.relations.with_all_ready(path));
            let mut names = Vec::new();
            for own in all.measuring() {
                let known = results_of(all, &own).into_iter();
                names.extend(known.map(|known| format!("{}.{}", own.name, known.code)));
            }
            return Err(nothing_measured(printable(name), kind, &names));
        }
    };
    let names = crate::geom::AXIS_NAMES;
    match (kind, result.axis) {
        (Kind::Place(axis), Some(own)) if own != axis => Err(text!(
            "{name} is a position along {axis}, and this one is along {other}",
            printable(name),
            names[own],
            names[axis]
        )),
        _ => Ok(result),
    }
}

/// Message that nothing of this name is measured before the cycle, with the names of the results that are.
fn nothing_measured(name: String, kind: Kind, known: &[String]) -> Text {
    let nothing = match kind {
        Kind::Place(_) => text!(
            "No cycle before this one measures a position \"{name}\"",
            name
        ),
        Kind::Rotation => text!(
            "No cycle before this one measures a direction \"{name}\"",
            name
        ),
        Kind::Size => text!("No cycle before this one measures a size \"{name}\"", name),
    };
    match known {
        [] => nothing,
        known => text!("{nothing}. Available: {known}", nothing, known.join(", ")),
    }
}

/// Reason why no cycle can follow a result of this kind in the program of a job.
fn cannot_follow(job: &Job, kind: Kind) -> Option<Text> {
    if let Some(several) = several(job) {
        if several.is_ok_and(|several| several.computes) {
            return (kind == Kind::Rotation).then(|| {
                text!(
                    "Native cycles probe along the axes: they follow positions and sizes, no direction"
                )
            });
        }
        return Some(match job.post.moves() {
            true => text!(
                "Native cycles store their results in variables, and this program does not compute with those: use the form \"moves\""
            ),
            false => text!(
                "Native cycles store their results in variables, and this program does not compute with those: no cycle can follow a result on this control"
            ),
        });
    }
    (!job.post.computes).then(|| {
        text!(
            "{control} cannot compute: no cycle can follow a result there",
            job.post.title.to_owned()
        )
    })
}

/// A missing limit that must bound the followed result.
fn missing_limit(job: &Job, kind: Kind) -> Option<Text> {
    let (limit, message) = match kind {
        Kind::Place(_) => (
            job.limits.position,
            text!(
                "A position that follows a result requires \"Position limit\": the largest shift of the path from its nominal position"
            ),
        ),
        Kind::Rotation => (
            job.limits.angle,
            text!(
                "A rotation that follows a result needs \"Angle limit\": how far from the nominal one the path may be turned"
            ),
        ),
        Kind::Size => (
            job.limits.size,
            text!(
                "A size that follows a result needs \"Size limit\": how far from the nominal one the path may grow or shrink"
            ),
        ),
    };
    limit.is_none().then_some(message)
}

/// A result that a cycle measures, or a relation gives.
struct Known {
    /// Its index in the joined path.
    index: usize,
    code: &'static str,
    /// 0, 1, 2 for abscissa, ordinate and tool axis of a position.
    letter: Option<usize>,
    /// Axis of the machine, for a position.
    axis: Option<usize>,
    /// Value on the nominal part, mm or degrees.
    nominal: f64,
}

/// Measured results of a cycle or relation of this kind. `axes` are abscissa, ordinate and tool axis.
fn known(formula: &Formula, own: &ResultSource<'_>, axes: [usize; 3], kind: Kind) -> Vec<Known> {
    let datum = own.datum.map(|datum| {
        datum
            .place
            .map(|place| place.and_then(|place| place.measured))
    });
    let in_datum = |variable: Option<Variable>| {
        (0..3).find(|i| variable.is_some() && datum.is_some_and(|datum| datum[*i] == variable))
    };
    let of = |index: usize| {
        let result = &formula.results[index];
        result.variable?;
        let own = |letter: Option<usize>| {
            let axis = letter.map(|letter| axes[letter]);
            Some(Known {
                index,
                code: result.code,
                letter,
                axis,
                nominal: result.nominal,
            })
        };
        match (kind, result.role) {
            (Kind::Place(_), Role::Abscissa) => own(Some(0)),
            (Kind::Place(_), Role::Ordinate) => own(Some(1)),
            (Kind::Place(_), Role::Level) => own(Some(2)),
            // Nothing is measured along a surface.
            (Kind::Place(_), Role::Reading) => own(Some(in_datum(result.variable)?)),
            (Kind::Rotation, Role::Direction) | (Kind::Size, Role::Size) => own(None),
            _ => None,
        }
    };
    own.results.clone().filter_map(of).collect()
}

/// Resolves the dependencies of a planned cycle: centre of its rotation, and sensitivity of its moves to its sizes. Reports what it cannot follow. `single` is
/// the job of this cycle with nominal values, `earlier` the path of the earlier cycles.
pub fn resolve_dependencies(
    checker: &mut Checker,
    wanted: PendingDependencies,
    (index, single): (usize, &Value),
    planned: &PlannedJob,
    earlier: &Path,
) -> Dependencies {
    let PendingDependencies { mut follows, sizes } = wanted;
    let origin = planned.path.frame.origin;
    let [a, o, _] = planned.job.setup.plane.axes();
    // About the position that it follows, where that is on the part; else about its own.
    let one_place = match (follows.place[a], follows.place[o]) {
        (Some(x), Some(y)) => {
            let place = |result: usize| {
                let result = &earlier.formula.results[result];
                (result.cycle, result.code.rsplit_once('.').map(|(of, _)| of))
            };
            place(x) == place(y)
        }
        _ => false,
    };
    if !one_place {
        (follows.about[a], follows.about[o]) = (origin[a], origin[o]);
    }
    if follows.rotation.is_some() {
        check_turn(checker, planned, follows.about, index);
    }
    if let (Some(_), Some((key, _))) = (follows.rotation, sizes.first()) {
        let message = text!("A cycle follows either a rotation or sizes, not both");
        checker.error("place-of-result", format!("cycles[{index}].{key}"), message);
        return follows;
    }
    follows.native = planned.job.form == ProgramForm::Cycle;
    if follows.native {
        let later = |(_, of)| (of, Sensitivity::default());
        follows.sizes = sizes.into_iter().map(later).collect();
        return follows;
    }
    for (key, of) in sizes {
        match along(checker, planned, single, &key) {
            Ok(along) => follows.sizes.push((of, along)),
            Err(why) => checker.error("place-of-result", format!("cycles[{index}].{key}"), why),
        }
    }
    follows
}

/// Checks whether a cycle can be rotated about a position, and how far that moves it.
fn check_turn(checker: &mut Checker, planned: &PlannedJob, about: Vec3, index: usize) {
    let PlannedJob { path, job, .. } = planned;
    let field = || format!("cycles[{index}].rotation");
    let arcs = path.moves.iter().any(|step| step.arc.is_some());
    if arcs || !path.formula.can_turn() {
        let message =
            text!("This cycle cannot follow an angle: it writes an angle itself, or has arcs");
        checker.error("place-of-result", field(), message);
    }
    let [a, o, _] = job.setup.plane.axes();
    let arm = path.frame.origin - about;
    let angle = job.limits.angle.unwrap_or(0.0).min(90.0).to_radians();
    let far = arm[a].hypot(arm[o]) * angle.sin();
    let most = job.limits.position.unwrap_or(f64::INFINITY);
    if far > most {
        let message = text!(
            "Rotated by \"Angle limit\", this cycle is {far} off its nominal position, and \"Position limit\" allows {limit}: on such a part the program stops before it writes",
            checker.length(far),
            checker.length(most)
        );
        checker.info("turn-beyond-limit", field(), message);
    }
}

/// Sensitivity of a cycle's moves to a size, tried at both ends of its limit, or the reason why it is unknown.
fn along(
    checker: &Checker,
    planned: &PlannedJob,
    single: &Value,
    key: &str,
) -> Result<Sensitivity, Text> {
    let limit = planned.job.limits.size.unwrap_or(0.0);
    let following = FollowingJob {
        single: single.clone(),
        sizes: vec![key.to_owned()],
    };
    following.sensitivity(checker, planned, (FollowedValue::Size(0), limit))
}

/// Job of a cycle that follows results; `None` if it follows nothing.
pub fn following_job(wanted: &PendingDependencies, single: &Value) -> Option<FollowingJob> {
    let places = wanted.follows.place.iter().any(Option::is_some);
    (places || !wanted.sizes.is_empty()).then(|| FollowingJob {
        single: single.clone(),
        sizes: wanted.sizes.iter().map(|(key, _)| key.clone()).collect(),
    })
}

impl FollowingJob {
    /// The cycle with other followed values, each changed by so many mm, planned like `planned`. Otherwise its first error; `None` if its path is not free.
    fn varied(
        &self,
        planned: &PlannedJob,
        by: &[(FollowedValue, f64)],
    ) -> Result<PlannedJob, Option<Text>> {
        let mut single = self.single.clone();
        for (value, by) in by {
            self.change(&mut single, *value, by / planned.job.scale);
        }
        let mut own = Checker::default();
        let job = Job::read(&mut own, &single).filter(|_| !own.failed());
        let Some(job) = job else {
            let mut errors = own
                .findings()
                .into_iter()
                .filter(|finding| finding.level == Level::Error);
            return Err(errors.next().map(|finding| finding.said));
        };
        let job = Job {
            work_offset: planned.job.work_offset,
            ..job
        };
        let varied = PlannedJob::at(job, planned.clear);
        match varied.native_rejections.first() {
            Some((.., why)) => Err(Some(why.clone())),
            None => Ok(varied),
        }
    }

    fn change(&self, single: &mut Value, value: FollowedValue, by: f64) {
        for (key, own) in cycle_of(single).into_iter().flatten() {
            let number = match (value, own) {
                (FollowedValue::Place(axis), Value::List(origin)) if key == "origin" => {
                    origin.get_mut(axis)
                }
                (FollowedValue::Size(n), own) => Some(own).filter(|_| *key == self.sizes[n]),
                _ => None,
            };
            if let Some(Value::Number(x)) = number {
                *x += by;
            }
        }
    }

    /// Sensitivity of a cycle to a followed value, tried at both ends of its limit, mm, or the reason why it is unknown.
    fn sensitivity(
        &self,
        checker: &Checker,
        planned: &PlannedJob,
        (value, limit): (FollowedValue, f64),
    ) -> Result<Sensitivity, Text> {
        let at = |by: f64| {
            let varied = self.varied(planned, &[(value, by)]);
            let varied = varied.and_then(|varied| {
                if is_free(&varied) {
                    Ok(varied)
                } else {
                    Err(None)
                }
            });
            varied.map_err(|why| {
                let off = checker.length(by);
                match why {
                    Some(why) => text!(
                        "This value follows a result, and {off} off the nominal one the cycle has an error: {error}",
                        off,
                        why
                    ),
                    None => text!(
                        "This value follows a result, and {off} off the nominal one the path of the cycle is not free",
                        off
                    ),
                }
            })
        };
        let (less, more) = (at(-limit)?, at(limit)?);
        Sensitivity::of([&less.path, &planned.path, &more.path], limit, value).ok_or_else(|| {
            text!("This value cannot follow a result: the moves of the cycle are not linear in it")
        })
    }
}

/// Whether the path of a cycle is free on the nominal part. Native cycles are planned on it.
fn is_free(PlannedJob { path, job, .. }: &PlannedJob) -> bool {
    if path.calls.is_some() {
        return true;
    }
    let run = part::run(path, &path.surfaces, &job.setup);
    let free = run.collision.is_none()
        && run.wrong_walls.is_empty()
        && run.triggers.iter().all(Option::is_some);
    free && path.touch_faults(job.setup.radius).is_empty()
}

/// Derives how moves and words of native cycles follow results: each cycle is planned with every followed value at both ends of its limit. Reports values that
/// cannot follow.
pub fn sense(checker: &mut Checker, path: &mut Path, members: &[PlannedJob]) -> Option<()> {
    for (m, planned) in members.iter().enumerate() {
        let Some(following) = &planned.following else {
            continue;
        };
        let limits = &planned.job.limits;
        let mut sensitivities = Vec::new();
        for (value, _) in path.cycles[m].placing.followed() {
            let (limit, field) = match value {
                FollowedValue::Place(axis) => (limits.position, format!("origin[{axis}]")),
                FollowedValue::Size(n) => (limits.size, following.sizes[n].clone()),
            };
            let limit = limit.unwrap_or(0.0);
            let single = planned
                .path
                .calls
                .as_ref()
                .is_some_and(|own| !own.measured.is_empty());
            if single && matches!(value, FollowedValue::Place(0 | 1)) {
                let message = text!(
                    "This feature is measured by single touches: it follows a height, no position in the plane"
                );
                checker.error("place-of-result", format!("cycles[{m}].{field}"), message);
                return None;
            }
            match following.sensitivity(checker, planned, (value, limit)) {
                Ok(known) => sensitivities.push(known),
                Err(why) => {
                    checker.error("place-of-result", format!("cycles[{m}].{field}"), why);
                    return None;
                }
            }
        }
        path.cycles[m].placing.sense(sensitivities);
    }
    Some(())
}

/// Runs the cycles that follow results on the virtual part, at the positions that the measured results give. Before a cycle that would be shifted beyond the
/// limit the program stops: this cycle and all later ones are not reached.
pub fn run(whole: &mut PlannedJob) {
    if whole.path.shifts.is_empty() {
        return;
    }
    for m in 0..whole.members.len() {
        // Checks and shifts of a cycle depend on earlier cycles.
        let asked = whole.path.asked_before(m, &whole.job.limits);
        if whole.path.cycles[m].placing.follows.is_empty() {
            continue;
        }
        let values = part::numbers(&whole.path, &triggers(whole));
        if let Some(question) = asked
            .iter()
            .find(|question| !question.is_within(values[question.variable.index()]))
        {
            for planned in &mut whole.members[m..] {
                let triggers = vec![None; planned.path.touches.len()];
                planned.run = PartRun {
                    triggers,
                    stopped_before: Some((m, question.result)),
                    ..PartRun::default()
                };
            }
            return;
        }
        if whole.members[m].following.is_some() {
            run_calls(whole, m, &values);
            continue;
        }
        let begin = whole.path.cycles[m].moves.start;
        let by = |index: Option<usize>, place: Vec3| match index {
            Some(index) => shift(&whole.path.shifts_at(begin + index, place), &values),
            None => begin
                .checked_sub(1)
                .map_or(Vec3::ZERO, |way| shift(whole.path.shifts(way), &values)),
        };
        let moved = moved(&whole.members[m].path, by);
        let turn = turn(&whole.path, m, &values);
        let planned = &mut whole.members[m];
        if let Some(turn) = turn {
            planned.path.formula = planned.path.formula.turned(&turn);
        }
        let run = part::run(&moved, &planned.surfaces, &planned.job.setup);
        planned.run = PartRun {
            shifted_path: Some(Box::new(moved)),
            ..run
        };
    }
}

/// Runs a native cycle on the virtual part with the followed values that its program has there. An unknown value counts as nominal.
fn run_calls(whole: &mut PlannedJob, m: usize, values: &[f64]) {
    let known = |(value, by): (FollowedValue, Variable)| {
        Some((value, values[by.index()])).filter(|(_, by)| by.is_finite())
    };
    let by: Vec<(FollowedValue, f64)> = whole.path.cycles[m]
        .placing
        .followed()
        .filter_map(known)
        .collect();
    let planned = &mut whole.members[m];
    let Some(varied) = planned
        .following
        .as_ref()
        .and_then(|following| following.varied(planned, &by).ok())
    else {
        return;
    };
    let shifted_path = Some(Box::new(varied.path.clone()));
    planned.run = PartRun {
        shifted_path,
        ..varied.run_on_surfaces(&planned.surfaces)
    };
}

/// Triggers of all cycles as they were run.
fn triggers(whole: &PlannedJob) -> Vec<Option<Vec3>> {
    whole
        .members
        .iter()
        .flat_map(|planned| planned.run.triggers.iter().copied())
        .collect()
}

/// Rotation of a cycle, by the values of the joined formula.
fn turn(path: &Path, member: usize, values: &[f64]) -> Option<formula::CycleRotation<f64>> {
    Some(
        path.cycles[member]
            .placing
            .turn()?
            .map(|known| values[known.index()]),
    )
}

/// The path of a cycle that follows a direction, with its formula rotated as these touches give.
pub fn turned(whole: &PlannedJob, member: usize, points: &[Option<Vec3>]) -> Option<Path> {
    let nominal = &whole.path.cycles[member].path.formula;
    whole.path.cycles[member].placing.turn()?;
    let turn = turn(&whole.path, member, &part::numbers(&whole.path, points))?;
    // If a control states its results there are no points: their uncertainty is that of the nominal part.
    let nothing = formula::CycleRotation {
        shift: turn.shift.map(|shift| shift.map(|_| 0.0)),
        ..turn.map(|_| 0.0)
    };
    let turn = if turn.is_known() { turn } else { nothing };
    let mut path = whole.members[member].path.clone();
    let mut formula = nominal.turned(&turn);
    for (result, known) in formula.results.iter_mut().zip(&path.formula.results) {
        result.tolerance = known.tolerance;
    }
    path.formula = formula;
    Some(path)
}

/// Shift of a position, mm; 0 if it is unknown.
fn shift(shifts: &Shifts, values: &[f64]) -> Vec3 {
    let by = |term: &crate::path::ShiftTerm| term.factor * values[term.by.index()];
    let sum = shifts
        .each_ref()
        .map(|terms| terms.iter().map(by).sum::<f64>());
    Vec3::from_array(sum.map(|by| if by.is_finite() { by } else { 0.0 }))
}

/// The whole path as it runs on the virtual part. `None` if it equals the nominal path.
pub fn actual(whole: &PlannedJob) -> Option<Path> {
    if whole.path.shifts.is_empty() || whole.job.placement.nominal {
        return None;
    }
    let values = part::numbers(&whole.path, &triggers(whole));
    Some(moved(&whole.path, |index, place| {
        index.map_or(Vec3::ZERO, |index| {
            shift(&whole.path.shifts_at(index, place), &values)
        })
    }))
}

/// Reports the cycle before which the program stops on the virtual part, with the reason.
pub fn report(whole: &PlannedJob, checker: &mut Checker) {
    let Some((m, result)) = whole.run.stopped_before else {
        return;
    };
    let Some(question) = whole.path.formula.leads(result, &whole.job.limits) else {
        return;
    };
    // A touch without contact is reported elsewhere.
    let value = part::numbers(&whole.path, &whole.run.triggers)[question.variable.index()];
    if !value.is_finite() {
        return;
    }
    let shown = |value: f64| {
        if question.angle {
            format!("{}°", decimal(value, 4))
        } else {
            checker.length(value)
        }
    };
    let message = text!(
        "On this part the program stops before {cycle}: {result} is {value}, more than {limit} from {wanted}",
        whole.path.cycles[m].name.clone(),
        whole
            .path
            .formula
            .full_code(&whole.path.formula.results[result])
            .into_owned(),
        shown(value),
        shown(question.limit),
        shown(question.expected)
    );
    checker.warning(
        "place-too-far",
        if whole.job.placement.nominal {
            "limits"
        } else {
            "part"
        },
        message,
    );
}

/// Checks link moves with one end that follows a result: the shift must neither turn a descent upwards, nor make a move too short to be watched. If one cycle
/// is above the other, the move across is only the shift, and is not watched.
pub fn check_ways(whole: &PlannedJob, checker: &mut Checker) {
    let PlannedJob { job, path, .. } = whole;
    let w = path.frame.w;
    let only = |shifts: &Shifts, tool: bool| {
        [0, 1, 2].map(|axis| {
            if (w[axis].abs() > 0.5) == tool {
                shifts[axis].clone()
            } else {
                Vec::new()
            }
        })
    };
    for (index, pair) in path.moves.windows(2).enumerate() {
        let (before, now) = (path.shifts(index), path.shifts(index + 1));
        let way = pair[1].to - pair[0].to;
        let far = |tool: bool| far_apart(&only(before, tool), &only(now, tool));
        let along = way.dot(w);
        // A move that is rotated as a whole keeps its length.
        let member = path.member_of_move(index + 1).unwrap_or(0);
        if path.cycles[member].placing.turn().is_some()
            && path.cycles[member].moves.contains(&index)
        {
            continue;
        }
        let ways = [
            (far(true), along.abs(), true),
            (far(false), (way - w * along).length(), job.protected),
        ];
        let short = ways
            .into_iter()
            .enumerate()
            .find(|(k, (far, length, asked))| {
                let over = *k == 1 && *length <= ZERO_LENGTH;
                *asked && *far > 0.0 && !over && *length < far + job.post.shortest_probe - 1e-9
            });
        let Some((k, (far, length, _))) = short else {
            continue;
        };
        let (name, least) = (
            path.cycles[member].name.clone(),
            checker.length(far + job.post.shortest_probe),
        );
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
            "Move {move}, the way across to {cycle}, is {way} long, and a result may shift its end by {far}: it must be at least {least}, or \"Position limit\" smaller",
            number,
            name,
            length,
            far,
            least
        );
        return checker.error(
            "place-of-result",
            format!("cycles[{member}].origin"),
            message,
        );
    }
}

/// The path with every position shifted. `by` is called for a position of a move, and for the start of the path. A touch may be rotated with it.
fn moved(path: &Path, by: impl Fn(Option<usize>, Vec3) -> Vec3) -> Path {
    let mut path = path.clone();
    path.start = path.start.map(|start| start + by(None, start));
    for index in 0..path.moves.len() {
        let step = &mut path.moves[index];
        if let MovePurpose::Touch(k) = step.purpose {
            let touch = &mut path.touches[k];
            let at = by(Some(index), touch.point);
            touch.vector =
                (touch.vector + by(Some(index), touch.point + touch.vector) - at).normalize();
            touch.point += at;
        }
        let to = step.to;
        step.to += by(Some(index), to);
        if let Some(arc) = &mut step.arc {
            arc.center += by(Some(index), to);
        }
    }
    path
}
