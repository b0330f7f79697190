//! Whether a result can correct a tool, by a macro or by a program of moves, and what the program needs for that.

use crate::control::ProgramForm;
use crate::control::corrections::ToolTable;
use crate::control::native_run::CorrectsTools;
use crate::form::{Checker, Value};
use crate::formula::{Role, Wear};
use crate::job::{Job, wear};
use crate::path::{Path, Touch};
use crate::text::{Text, text};

/// A result by its index, the path that measures it, and the job of its cycle.
pub type Measured<'a> = (&'a Job, &'a Path, usize);

/// Tool that a tolerance corrects, checked; `None` without one, or with an error. `related`: whether the result is that of a relation.
pub fn read(
    checker: &mut Checker,
    of: Measured<'_>,
    given: &Value,
    related: bool,
    at: &str,
) -> Option<Wear> {
    let (own, path, index) = of;
    let (found, findings) = wear::read(given, at, (own.scale, own.unit));
    findings
        .into_iter()
        .for_each(|finding| checker.adopt(finding));
    let (found, at) = (found?, format!("{at}.wear"));
    let why = match own.form {
        ProgramForm::Moves => not_by_moves(of, related),
        ProgramForm::Cycle => not_by_macros(of, related).or_else(|| not_by_whole_error(of, &found)),
    };
    if let Some(why) = why {
        let message = text!("No tool can be corrected by this result: {why}", why);
        checker.error("wear-unsupported", at, message);
        return None;
    }
    let Some(table) = own.post.tools.filter(|_| own.form == ProgramForm::Moves) else {
        return Some(found);
    };
    let length = is_height(own, path, index);
    let lacking = lacking((own, table), length, &found, &at);
    let complete = lacking.is_empty();
    for (path, message) in lacking {
        checker.error("missing", path, message);
    }
    let sense = match length {
        true => -1.0,
        false => own.def.probes.tool_sense().unwrap_or(0.0),
    };
    complete.then_some(Wear {
        sense,
        length,
        ..found
    })
}

/// Why no macro corrects a tool by a result.
fn not_by_macros((own, path, index): Measured<'_>, related: bool) -> Option<Text> {
    let sized = path.formula.results[index].role == Role::Size;
    if corrects(own) == CorrectsTools::Never {
        Some(text!(
            "no source shows that the native cycles of {control} do that as the job says",
            own.post.title.to_owned()
        ))
    } else if related {
        Some(text!(
            "the macros correct a tool only from their own measurement"
        ))
    } else if !sized || path.feature.two_circles().is_some() {
        Some(text!("the macros correct a tool by a width or a diameter"))
    } else if own.work_offset.is_some() {
        Some(text!(
            "its macro writes the work offset: no source shows that it does both in one call"
        ))
    } else {
        None
    }
}

/// How the native cycles of a job's control correct a tool.
fn corrects(own: &Job) -> CorrectsTools {
    own.post
        .own
        .map_or(CorrectsTools::Never, |cycles| cycles.corrects_tools)
}

/// Why a cycle that corrects a tool by the whole error does not correct it as the job says.
fn not_by_whole_error((own, path, index): Measured<'_>, wear: &Wear) -> Option<Text> {
    if corrects(own) != CorrectsTools::WholeError {
        None
    } else if wear.share < 1.0 || wear.dead_band > 0.0 || wear.mean.is_some() {
        Some(text!(
            "the cycle corrects it by the whole error of each part: leave percent, dead band, mean and store empty"
        ))
    } else if path.formula.results[index].code.ends_with(['1', '2']) {
        Some(text!(
            "no source shows which side of a rectangle the cycle takes"
        ))
    } else {
        None
    }
}

/// Why no program of moves corrects a tool by a result.
fn not_by_moves((own, path, index): Measured<'_>, related: bool) -> Option<Text> {
    let def = &path.formula.results[index];
    let sized = def.role == Role::Size && own.def.probes.tool_sense().is_some();
    let level = path.formula.datum.as_ref().and_then(|datum| datum.place[2]);
    let written = level.is_some_and(|level| {
        own.work_offset.is_some() && level.measured.is_some() && level.measured == def.variable
    });
    if own.post.tools.is_none() {
        Some(text!(
            "no source shows how a program of {control} changes the offset of another tool than the probe",
            own.post.title.to_owned()
        ))
    } else if related {
        Some(text!(
            "a relation does not tell on which side the tool has cut"
        ))
    } else if written {
        Some(text!("the program writes this height into the work offset"))
    } else if !sized && !is_height(own, path, index) {
        Some(text!(
            "a program of moves corrects a tool by a width, a diameter or a height"
        ))
    } else {
        None
    }
}

/// Whether a result is a height of the part, touched along the tool axis.
fn is_height(own: &Job, path: &Path, index: usize) -> bool {
    let def = &path.formula.results[index];
    let tool = own.setup.plane.axes()[2];
    let member = path.sources(index).first().map(|m| &path.cycles[*m]);
    let touches = member.map_or(&path.touches[..], |own| &path.touches[own.touches.clone()]);
    let along = |touch: &Touch| touch.vector[tool].abs() > 1.0 - 1e-9;
    match def.role {
        Role::Level => true,
        // z in a code is the tool axis.
        Role::Reading => def.code.rsplit('.').next() == Some("z") && touches.iter().all(along),
        _ => false,
    }
}

/// What a program of moves needs besides for this correction, each with its path: the kind of the offsets, the mean with its variables, and a limit.
fn lacking(
    (own, table): (&Job, &ToolTable),
    height: bool,
    found: &Wear,
    at: &str,
) -> Vec<(String, Text)> {
    let (first, last) = table.keeps;
    let [from, to] = [first, last].map(table.kept);
    let offsets = match (table.tables)(own.tool_offsets) {
        None => Some((
            "control.toolOffsets".to_owned(),
            text!(
                "State what the tool offsets of the control hold: the program changes them by radius or by diameter"
            ),
        )),
        Some([.., last]) if found.tool > last => {
            let message = text!("This control has tool offsets up to {last}", last);
            Some((format!("{at}.tool"), message))
        }
        Some(_) => None,
    };
    let mean = match found.mean {
        None => Some((
            format!("{at}.parts"),
            text!(
                "A program of moves corrects a tool by the mean of several parts, never by the first one: enter their number, and in store the first of two variables that keep the values, {first} to {last}",
                from,
                to
            ),
        )),
        Some((_, store)) if !(first..=last).contains(&store) => Some((
            format!("{at}.store"),
            text!(
                "The variables that keep the values are {first} to {last} on this control",
                from,
                to
            ),
        )),
        Some(_) => None,
    };
    let (limit, key, label) = match height {
        true => (own.limits.position, "limits.position", "Position limit"),
        false => (own.limits.size, "limits.size", "Size limit"),
    };
    let limit = limit.is_none().then(|| {
        let message = text!(
            "A program of moves corrects a tool only within a limit, so that a chip or a wrong part does not count: enter \"{limit}\"",
            Text::words(label)
        );
        (key.to_owned(), message)
    });
    offsets.into_iter().chain(mean).chain(limit).collect()
}
