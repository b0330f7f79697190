//! Reads `tolerances` of a job: the tolerance of each result, with the action beyond it.

use crate::control::ProgramForm;
use crate::control::corrections::correction;
use crate::form::{Checker, Section, Value, printable};
use crate::formula::{self, Formula, ResultDef, Role, Tolerance, ToleranceAction, Wear};
use crate::job::Job;
use crate::job::corrections;
use crate::job::planned::PlannedJob;
use crate::job::sections::TOLERANCES;
use crate::job::wear::WEAR;
use crate::num::tidy;
use crate::path::Path;
use crate::text::{Text, text, words};
use crate::tolerance;

/// Tolerance of a result: an entry of `tolerances`, a size that contains its tolerance, or both. With both, the size gives the tolerance and the entry gives
/// action and wear correction.
struct Given<'v> {
    /// Index of the result in the joined path.
    index: usize,
    /// Code of the result, as the job writes it.
    key: &'v str,
    /// Path of the entry; without an entry, path of the size.
    at: String,
    entry: Option<&'v Value>,
    /// Text of the size, and its path.
    size: Option<(String, String)>,
}

/// Reads the tolerances of a planned job and adds each to its result. Reports all faults.
pub fn read(checker: &mut Checker, value: &Value, planned: &mut PlannedJob) {
    let Some(entries) = checker.object(value.given(TOLERANCES), TOLERANCES) else {
        return;
    };
    let mut all = of_entries(checker, entries, planned);
    add_sizes(checker, planned, &mut all);
    for given in &all {
        let members = &planned.path.cycles;
        let of = members
            .iter()
            .position(|member| member.results.contains(&given.index));
        let own = of.map_or(&planned.job, |cycle| &planned.members[cycle].job);
        let related = of.is_none() && !members.is_empty();
        let jobs = (&planned.job, own, &planned.path);
        if let Some(tolerance) = one(checker, jobs, given, related) {
            give(planned, given.index, tolerance);
        }
    }
    if planned.path.formula.corrects_tools() {
        check_stores(checker, planned.job.form, &planned.path.formula, &all);
        check_registers(checker, &planned.job, &planned.path.formula, &all);
    }
}

/// Entries of `tolerances` for results of the job. Reports the others.
fn of_entries<'v>(
    checker: &mut Checker,
    entries: &'v [(String, Value)],
    planned: &PlannedJob,
) -> Vec<Given<'v>> {
    let formula = &planned.path.formula;
    let mut all: Vec<Given<'v>> = Vec::new();
    for (key, entry) in entries {
        let at = format!("{TOLERANCES}.{}", printable(key));
        let named = |result: &ResultDef| formula.is_named(result, key);
        let Some(index) = formula.results.iter().position(named) else {
            let known: Vec<_> = formula
                .results
                .iter()
                .map(|result| formula.code(result))
                .collect();
            let message = text!(
                "This job has no result \"{name}\". Its results are {codes}",
                printable(key),
                known.join(", ")
            );
            checker.error("tolerance-unknown", at, message);
            continue;
        };
        if all.iter().any(|other| other.index == index) {
            checker.error("tolerance-unknown", at, twice(key));
            continue;
        }
        let entry = Some(entry);
        let size = None;
        all.push(Given {
            index,
            key,
            at,
            entry,
            size,
        });
    }
    all
}

fn twice(key: &str) -> Text {
    text!("{name} has two tolerances: give it one", printable(key))
}

/// Adds the sizes with a tolerance, each to the entry of its result if there is one.
fn add_sizes(checker: &mut Checker, planned: &PlannedJob, all: &mut Vec<Given<'_>>) {
    let several = &planned.path.cycles;
    let mut add = |cycle: &PlannedJob, first: usize, place: &str| {
        for sized in &cycle.job.sized {
            let (code, path) = (sized.field.key, format!("{place}.{}", sized.field.key));
            let results = &cycle.path.formula.results;
            let Some(index) = results.iter().position(|result| result.code == code) else {
                let message = text!(
                    "{result} is not measured here, so it has no tolerance",
                    Text::words(sized.field.label)
                );
                checker.error("tolerance-unsupported", path, message);
                continue;
            };
            let index = first + index;
            let size = Some((sized.text.clone(), path.clone()));
            match all.iter_mut().find(|other| other.index == index) {
                Some(other) => other.size = size,
                None => all.push(Given {
                    index,
                    key: code,
                    at: path,
                    entry: None,
                    size,
                }),
            }
        }
    };
    if several.is_empty() {
        return add(planned, 0, "cycle");
    }
    for (i, (member, cycle)) in several.iter().zip(&planned.members).enumerate() {
        add(cycle, member.results.start, &format!("cycles[{i}]"));
    }
}

/// Checks offsets or variables that keep the values of a mean: one pair each, which belongs to no tool and no other mean.
#[inline(never)]
fn check_stores(checker: &mut Checker, form: ProgramForm, formula: &Formula, given: &[Given<'_>]) {
    let wear_of = |given: &Given<'_>| {
        let wear = formula.results[given.index].tolerance?.wear?;
        Some((given.index, wear, given.key.to_owned()))
    };
    let all: Vec<(usize, Wear, String)> = given.iter().filter_map(wear_of).collect();
    for (i, wear, key) in &all {
        let Some((_, store)) = wear.mean else {
            continue;
        };
        let kept = |number: i32| (store..=store + 1).contains(&number);
        let other_mean = |(j, other, _): &(usize, Wear, String)| {
            j != i
                && other
                    .mean
                    .is_some_and(|(_, other)| (other - store).abs() < 2)
        };
        let of_a_tool =
            form == ProgramForm::Cycle && all.iter().any(|(_, other, _)| kept(other.tool));
        if of_a_tool || all.iter().any(other_mean) {
            let message = match form {
                ProgramForm::Cycle => text!(
                    "The macro stores its values in the offsets {store} and {next}: no tool and no other mean may use them",
                    store,
                    store + 1
                ),
                ProgramForm::Moves => text!(
                    "The program keeps the mean in the variables {store} and {next}: no other mean may use them",
                    store,
                    store + 1
                ),
            };
            checker.error(
                "wear-unsupported",
                format!("{TOLERANCES}.{}.wear.store", printable(key)),
                message,
            );
        }
    }
}

/// Reports results that a program would correct one register by: each would change it by its own error.
#[inline(never)]
fn check_registers(checker: &mut Checker, job: &Job, formula: &Formula, given: &[Given<'_>]) {
    // Table and number of the tool. Native cycles choose the table by themselves.
    let register = |given: &Given<'_>| -> Option<(i32, i32)> {
        let result = &formula.results[given.index];
        if job.form == ProgramForm::Cycle {
            return Some((0, result.tolerance?.wear?.tool));
        }
        let settings = (job.post.tools?, job.tool_offsets, &job.limits);
        let own = correction(settings, (given.index, result))?.register;
        Some((own.table, own.tool))
    };
    let all: Vec<Option<(i32, i32)>> = given.iter().map(register).collect();
    for (given, own) in given.iter().zip(&all) {
        let same = all.iter().filter(|other| *other == own).count();
        if let Some((_, tool)) = own.filter(|_| same > 1) {
            let message = text!(
                "Several results correct one register of tool {tool}: the changes would add up. Correct it by one of them",
                tool
            );
            let at = format!("{TOLERANCES}.{}.wear.tool", printable(given.key));
            checker.error("wear-unsupported", at, message);
        }
    }
}

/// Adds a tolerance to a result of the joined path, and to that of its cycle.
fn give(planned: &mut PlannedJob, index: usize, tolerance: Tolerance) {
    planned.path.formula.results[index].tolerance = Some(tolerance);
    for (member, own) in planned.path.cycles.iter_mut().zip(&mut planned.members) {
        if member.results.contains(&index) {
            own.path.formula.results[index - member.results.start].tolerance = Some(tolerance);
        }
    }
}

/// Reads a tolerance; `own` is the single cycle that measures the result. `related`: whether it is the result of a relation.
fn one(
    checker: &mut Checker,
    (job, own, path_of_job): (&Job, &Job, &Path),
    given: &Given<'_>,
    related: bool,
) -> Option<Tolerance> {
    let at = &given.at;
    let none = Value::Map(Vec::new());
    let entry = given.entry.unwrap_or(&none);
    let mut section = Section::new(checker, Some(entry), at);
    section.only(&[], &["tolerance", "action", WEAR.key]);
    section.value()?;
    let formula = &path_of_job.formula;
    let def = &formula.results[given.index];
    let of = (path_of_job, given.index);
    let action = consequence(checker, (job, of), entry, &format!("{at}.action"));
    let (text, path) = words_of(checker, given)?;
    if def.variable.is_none() || path_of_job.feature.two_circles().is_some() {
        let message = match def.variable {
            None => text!(
                "{result} is not measured here, so it has no tolerance",
                Text::words(def.meaning)
            ),
            Some(_) => {
                text!("Cycle 1411 has tolerances in its diameters and points: enter them there")
            }
        };
        checker.error("tolerance-unsupported", path, message);
        return None;
    }
    let limits = limits(checker, job, text, def, &path)?;
    let of = (own, path_of_job, given.index);
    let wear = corrections::read(checker, of, entry, related, at);
    if wear.is_some() {
        check_middle(checker, limits, def, at);
        if own.form == ProgramForm::Cycle && own.limits.size.is_none() {
            let message = text!(
                "Without \"Size limit\" the macro corrects the tool from any contact, also with a chip or a wrong part: enter a limit"
            );
            checker.warning("wear-unlimited", format!("{at}.wear"), message);
        }
    }
    let tolerance = Tolerance {
        limits,
        action: action?,
        wear,
    };
    check_limit(checker, job, formula, (given.index, &tolerance), &path);
    Some(tolerance)
}

/// Text of a tolerance, and its path.
fn words_of<'g>(checker: &mut Checker, given: &'g Given<'_>) -> Option<(&'g str, String)> {
    let path = format!("{}.tolerance", given.at);
    match (
        given.entry.and_then(|entry| entry.get("tolerance")),
        &given.size,
    ) {
        (None, Some((text, at))) => Some((text, at.clone())),
        (Some(_), Some(_)) => {
            checker.error("tolerance-unknown", path, twice(given.key));
            None
        }
        (Some(Value::Text(text)), None) if text.chars().count() > tolerance::LONGEST => {
            let message = text!(
                "A tolerance has at most {most} characters",
                tolerance::LONGEST
            );
            checker.error("text-too-long", path, message);
            None
        }
        (Some(given), None) => Some((checker.text(given, &path)?, path)),
        (None, None) => {
            let message = text!(
                "A tolerance needs its text: one of {forms}",
                tolerance::RESULT_FORMS.to_owned()
            );
            checker.error("missing", path, message);
            None
        }
    }
}

/// Why a program of native cycles cannot act on a result of this path. It compares stored results between the cycles of a set-up, and stops.
fn not_natively(
    job: &Job,
    (path, result): (&Path, usize),
    action: ToleranceAction,
) -> Option<&'static str> {
    let computes = job.post.own.is_some_and(|own| own.several.computes);
    if !computes || path.cycles.is_empty() {
        return Some(words!("native cycles do not compare their results with it"));
    }
    let variable = path.formula.results[result].variable;
    let stored = variable.and_then(|variable| {
        let own = path.calls.as_ref()?;
        own.stored_value(variable.index())
    });
    let count = path.cycles.len();
    let computed = variable.and_then(|variable| {
        let own = path.calls.as_ref()?;
        own.computed_before(variable.index())
    });
    let late = match computed {
        Some(before) => before == count,
        None => path.is_known_by(result, count - 1) == Some(true),
    };
    let writes = job.work_offset.is_some() && late;
    let at_once = job
        .post
        .own
        .is_some_and(|own| own.several.activates.is_none());
    match action {
        ToleranceAction::Mark => Some(words!("a program of native cycles can only stop")),
        _ if stored.is_none() => Some(words!("its native cycle does not store this result")),
        _ if writes && at_once => Some(words!(
            "the last native cycle writes before the program can compare"
        )),
        _ => None,
    }
}

/// Action of the program, if it can carry it out.
fn consequence(
    checker: &mut Checker,
    (job, of): (&Job, (&Path, usize)),
    given: &Value,
    path: &str,
) -> Option<ToleranceAction> {
    let action = match given.get("action") {
        None => ToleranceAction::Go,
        Some(word) => {
            let word = checker.text(word, path)?;
            let Some((_, action)) = ToleranceAction::ALL
                .into_iter()
                .find(|(known, _)| *known == word)
            else {
                let message = text!("The action of a tolerance is go, mark or stop");
                checker.error("unknown-value", path, message);
                return None;
            };
            action
        }
    };
    let why = match job.form {
        ProgramForm::Cycle => not_natively(job, of, action),
        ProgramForm::Moves if !job.post.computes => Some(words!(
            "{control} computes no results: the operator must judge them"
        )),
        ProgramForm::Moves => None,
    };
    if let Some(why) = why.filter(|_| action != ToleranceAction::Go) {
        let message = text!(
            "The program cannot act on a tolerance: {why}",
            job.post.control_text(why)
        );
        checker.error("tolerance-unsupported", path, message);
        return None;
    }
    Some(action)
}

/// Limits of a tolerance, mm or degrees.
fn limits(
    checker: &mut Checker,
    job: &Job,
    text: &str,
    def: &ResultDef,
    path: &str,
) -> Option<[f64; 2]> {
    let angle = def.role.is_angle();
    let unit = if angle { 1.0 } else { job.scale };
    let classes = (def.role == Role::Size).then_some(job.scale);
    let nominal = tidy(def.nominal / unit);
    let (limits, says_nominal) = match tolerance::of_result(text, nominal, classes) {
        Ok(read) => read,
        Err(why) => {
            checker.error("not-a-tolerance", path, why);
            return None;
        }
    };
    let limits = limits.map(|x| x * unit);
    let [low, high] = limits;
    let away = (low - def.nominal).max(def.nominal - high);
    // A class needs no nominal value; a size in the text that differs from nominal belongs to another feature.
    if says_nominal && away > (high - low).max(job.scale * 1e-9) {
        let shown = |x: f64| {
            if angle {
                format!("{}°", crate::num::decimal(x, 4))
            } else {
                checker.length(x)
            }
        };
        let message = text!(
            "This tolerance is {low} to {high}, and the nominal value is {nominal}: every good part would be out of it",
            shown(low),
            shown(high),
            shown(def.nominal)
        );
        checker.warning("tolerance-elsewhere", path, message);
    }
    Some(limits)
}

/// Reports an unsymmetrical tolerance for wear: a tool is corrected towards the nominal size, not towards the middle of the tolerance.
fn check_middle(checker: &mut Checker, [low, high]: [f64; 2], def: &ResultDef, at: &str) {
    let middle = f64::midpoint(low, high);
    if (middle - def.nominal).abs() > 1e-6 {
        let message = text!(
            "The tool is corrected towards the nominal value {nominal}, and the middle of this tolerance is {middle}: enter the middle as the nominal value, and the tolerance by its ends, {low} and {high}",
            checker.length(def.nominal),
            checker.length(middle),
            checker.length(low),
            checker.length(high)
        );
        checker.warning("wear-off-middle", format!("{at}.wear"), message);
    }
}

/// Reports a tolerance beyond the plausibility limit: the program would reject a good part as a wrong measurement.
fn check_limit(
    checker: &mut Checker,
    job: &Job,
    formula: &Formula,
    (index, tolerance): (usize, &Tolerance),
    path: &str,
) {
    let def = &formula.results[index];
    let plausible = formula
        .result_checks(&job.limits)
        .into_iter()
        .find(|question| {
            question.asked == formula::CheckKind::Plausibility
                && Some(question.variable) == def.variable
        });
    let Some(plausible) = plausible else { return };
    let [low, high] = tolerance.limits;
    let least = plausible.expected - plausible.limit - 1e-9;
    let most = plausible.expected + plausible.limit + 1e-9;
    if low < least || high > most {
        let limit = match def.role {
            Role::Size => "Size limit",
            Role::Angle | Role::Direction => "Angle limit",
            Role::Residual => "Residual limit",
            Role::Spread => "Largest spread",
            _ => "Position limit",
        };
        let message = text!(
            "This tolerance reaches beyond \"{limit}\": a part within it would be refused as an implausible measurement. Enter a larger limit",
            Text::words(limit)
        );
        checker.error("tolerance-beyond-limit", path, message);
    }
}
