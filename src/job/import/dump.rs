//! Reads a dump of CmdPrm codes, as it was exported here or as somebody copied it out of a log.
//!
//! Whatever stands around them, `Int[-1]`, `Flt [-101]` or `Bol[-3]` name a code, and the first number or truth value behind
//! it is its value: `CmdPrm.Flt[-50] = 50`, a CSV line, an object of a JSON list, decimal commas, any order.

use crate::cycle::{CYCLES, CycleDef, Pick, code_of};
use crate::geom::{Plane, Vec3};
use crate::job::JobError;
use crate::job::catalog::default_job;
use crate::job::form::Job;
use crate::job::import::{Imported, set};
use crate::path::MAX_TOUCHES;
use crate::spec::{Checker, Field, Kind, Section, Value};

/// How near the touches of the dimensions must be to those of the dump to be the same, mm.
const SAME: f64 = 1e-6;

/// A code with its value.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Entry {
    accessor: &'static str,
    code: i32,
    value: f64,
}

/// Whether a text names a cycle type by its code.
pub fn recognises(text: &str) -> bool {
    entries(text).iter().any(|e| e.code == -1)
}

/// Every code with its value, in order.
fn entries(text: &str) -> Vec<Entry> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some((accessor, code, after)) = next_code(rest) {
        // The value stands before the next code, and before the line ends.
        let end = after.find('\n').unwrap_or(after.len());
        let end = next_code(&after[..end]).map_or(end, |(_, _, next)| end - next.len());
        if let Some(value) = value(&after[..end]) {
            found.push(Entry { accessor, code, value });
        }
        rest = after;
    }
    found
}

/// The next code and what stands behind its bracket.
fn next_code(text: &str) -> Option<(&'static str, i32, &str)> {
    let mut rest = text;
    while let Some(at) = rest.find('[') {
        let before = rest[..at].trim_end();
        let after = &rest[at + 1..];
        let accessor =
            ["Int", "Flt", "Bol"].into_iter().find(|a| before.to_ascii_lowercase().ends_with(&a.to_ascii_lowercase()));
        if let (Some(accessor), Some((code, behind))) = (accessor, after.split_once(']'))
            && let Ok(code) = code.trim().parse::<i32>()
        {
            return Some((accessor, code, behind));
        }
        rest = after;
    }
    None
}

/// The first number or truth value of a text.
fn value(text: &str) -> Option<f64> {
    let lower = text.to_ascii_lowercase();
    let truth = |word: &str| {
        lower.match_indices(word).map(|(at, _)| at).find(|&at| {
            let edge = |c: Option<char>| c.is_none_or(|c| !c.is_ascii_alphanumeric());
            edge(lower[..at].chars().next_back()) && edge(lower[at + word.len()..].chars().next())
        })
    };
    let number = number(text);
    let truths = [(truth("true"), 1.0), (truth("false"), 0.0)];
    let first = truths.into_iter().filter_map(|(at, value)| Some((at?, value))).chain(number);
    first.min_by_key(|(at, _)| *at).map(|(_, value)| value)
}

/// The first number of a text and where it stands. A comma between two digits is a decimal comma.
fn number(text: &str) -> Option<(usize, f64)> {
    let bytes = text.as_bytes();
    let digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
    let word = |i: usize| i > 0 && (bytes[i - 1].is_ascii_alphanumeric() || bytes[i - 1] == b'_');
    let mut at = (0..bytes.len()).find(|&i| digit(i) && !word(i))?;
    if at > 0 && bytes[at - 1] == b'.' {
        at -= 1;
    }
    let start = if at > 0 && matches!(bytes[at - 1], b'-' | b'+') { at - 1 } else { at };
    let mut end = at;
    while digit(end) || (matches!(bytes.get(end), Some(b'.' | b',')) && digit(end + 1)) {
        end += 1;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'-' | b'+')));
        if digit(end + 1 + sign) {
            end += 1 + sign;
            while digit(end) {
                end += 1;
            }
        }
    }
    let parsed = text[start..end].replace(',', ".").parse::<f64>().ok().filter(|x| x.is_finite())?;
    Some((start, parsed))
}

/// Makes a job of a dump. Several cycles in one text: the first that probes is taken.
pub fn import(text: &str) -> Result<Imported, JobError> {
    let mut checker = Checker::default();
    let all = entries(text);
    // Every -1 begins a cycle; what stands before the first one is of it, since a dump may be in any order.
    let starts: Vec<usize> = all.iter().enumerate().filter(|(_, e)| e.code == -1).map(|(i, _)| i).collect();
    let blocks: Vec<Vec<Entry>> = starts
        .iter()
        .enumerate()
        .map(|(i, _)| {
            let from = if i == 0 { 0 } else { starts[i] };
            all[from..starts.get(i + 1).copied().unwrap_or(all.len())].to_vec()
        })
        .collect();
    let kind = |block: &[Entry]| block.iter().find(|e| e.code == -1).map_or(-1.0, |e| e.value);
    let def_of = |block: &[Entry]| CYCLES.iter().copied().find(|c| c.number.is_some_and(|n| f64::from(n) == kind(block)));
    for block in blocks.iter().filter(|b| def_of(b).is_none()) {
        let message = format!("Type {} is not a cycle that is known here: it is passed over", kind(block));
        checker.warning("unknown-type", "cycle.type", message);
    }
    let known: Vec<(&Vec<Entry>, &'static CycleDef)> = blocks.iter().filter_map(|b| Some((b, def_of(b)?))).collect();
    let probing = known.iter().find(|(_, def)| def.number.is_some_and(|n| n > 1)).or(known.first());
    let Some((block, def)) = probing else {
        checker.error(
            "nothing-to-import",
            "cycle.type",
            "No job can be made of this dump: it holds no cycle type from 0 to 16",
        );
        return Err(JobError { findings: checker.findings });
    };
    if known.len() > 1 {
        let message = format!("The dump holds {} cycles: the first that probes, {}, is taken", known.len(), def.title);
        checker.warning("several-cycles", "", message);
    }
    Ok(build(block, def, checker))
}

/// What a block has under a code; the last where it is told twice.
fn find(block: &[Entry], code: i32) -> Option<f64> {
    block.iter().rev().find(|e| e.code == code).map(|e| e.value)
}

fn build(block: &[Entry], def: &'static CycleDef, mut checker: Checker) -> Imported {
    let mut job = default_job(def.key).expect("a registered cycle has a default job");
    let mut used: Vec<i32> = vec![-1];
    if def.number == Some(0) {
        used.push(-2);
    }
    for field in def.fields {
        let Some((_, code)) = code_of(field) else { continue };
        used.push(code);
        let value = read_field(block, field, code, &mut checker);
        if let Some(value) = value {
            set(&mut job, &format!("cycle.{}", field.key), value);
        }
    }
    for section in def.sections {
        let mut any = false;
        for field in section.fields {
            let Some((_, code)) = code_of(field) else { continue };
            used.push(code);
            if let Some(value) = find(block, code) {
                if !any {
                    let all = section.fields.iter().map(|f| (f.key.to_owned(), Value::Null)).collect();
                    set(&mut job, &format!("cycle.{}", section.key), Value::Map(all));
                }
                any = true;
                set(&mut job, &format!("cycle.{}.{}", section.key, field.key), Value::Number(value));
            }
        }
    }
    keep_own_codes(block, &mut job);
    report_unknown(block, &used, &mut checker);
    if let Some(place) = def.place {
        place_touches(block, def, place, &mut job, &mut checker);
    }
    let silent =
        "A dump does not say feeds, overtravel, units, the control and the program's name: the defaults are taken (mm)";
    checker.info("not-in-dump", "feeds", silent);
    if !checker.findings.iter().any(|f| f.code == "stylus-from-dump") {
        let silent = "A dump does not say the stylus: the default ball is taken";
        checker.info("not-in-dump", "stylus", silent);
    }
    Imported { job, findings: checker.findings }
}

fn read_field(block: &[Entry], field: &Field, code: i32, checker: &mut Checker) -> Option<Value> {
    let path = format!("cycle.{}", field.key);
    let Some(value) = find(block, code) else {
        if field.null.is_some() {
            return Some(Value::Null);
        }
        if field.kind != Kind::Flag && code != -2 {
            let message = format!("The dump has no code {code} ({}): the default is taken", field.label);
            checker.warning("missing-code", path, message);
        }
        return None;
    };
    match field.kind {
        Kind::Flag if value == 0.0 || value == 1.0 => Some(Value::Flag(value == 1.0)),
        Kind::Flag => {
            let message = format!("Code {code} ({}) must be 0 or 1, not {value}: the default is taken", field.label);
            checker.warning("not-a-flag", path, message);
            None
        }
        _ => Some(Value::Number(value)),
    }
}

/// Codes of the user's own are positive: they are kept as they are.
fn keep_own_codes(block: &[Entry], job: &mut Value) {
    let own: Vec<Value> = block
        .iter()
        .filter(|e| e.code > 0)
        .map(|e| {
            Value::Map(vec![
                ("code".to_owned(), Value::Number(f64::from(e.code))),
                ("type".to_owned(), Value::Text(e.accessor.to_owned())),
                ("value".to_owned(), if e.accessor == "Bol" { Value::Flag(e.value != 0.0) } else { Value::Number(e.value) }),
            ])
        })
        .collect();
    if !own.is_empty() {
        set(job, "cycle.custom", Value::List(own));
    }
}

fn report_unknown(block: &[Entry], used: &[i32], checker: &mut Checker) {
    let touch = |code: i32| (-296..=-100).contains(&code);
    let mut unknown: Vec<i32> = block.iter().map(|e| e.code).filter(|c| *c <= 0 && !touch(*c) && !used.contains(c)).collect();
    unknown.sort_unstable_by(|a, b| b.cmp(a));
    unknown.dedup();
    if !unknown.is_empty() {
        let codes: Vec<String> = unknown.iter().map(ToString::to_string).collect();
        let message = format!("This cycle has no code {}: passed over", codes.join(", "));
        checker.warning("unknown-code", "cycle", message);
    }
}

/// The touch with index `k` in the block that begins at `base`.
fn touch(block: &[Entry], base: i32, k: usize) -> Option<Pick> {
    let first = base - 6 * k as i32;
    let at = |i: i32| find(block, first - i);
    Some(Pick { point: Vec3::new(at(0)?, at(1)?, at(2)?), vector: Vec3::new(at(3)?, at(4)?, at(5)?) })
}

fn touches(block: &[Entry], base: i32) -> Vec<Pick> {
    (0..MAX_TOUCHES).map_while(|k| touch(block, base, k)).collect()
}

/// Seven decimals: what a form is written with, whatever arithmetic brought it back.
fn tidy(x: f64) -> f64 {
    let rounded = (x * 1e7).round() / 1e7;
    if rounded == 0.0 { 0.0 } else { rounded }
}

fn triple(v: Vec3) -> Value {
    Value::List(v.to_array().map(Value::Number).to_vec())
}

/// Puts the feature where its touches are. Where its dimensions give these very touches, they alone are the job; else the touches
/// are kept as picked.
fn place_touches(block: &[Entry], def: &CycleDef, place: crate::cycle::PlaceBy, job: &mut Value, checker: &mut Checker) {
    let (used, original) = (touches(block, -100), touches(block, -200));
    if used.is_empty() && original.is_empty() {
        let message =
            "The dump has no touch points (-100 or -200 and following): place and rotation of the feature are the defaults";
        checker.warning("no-touches", "cycle.origin", message);
        return;
    }
    let compensated = find(block, -66) == Some(1.0);
    let mut picks = used.clone();
    if compensated && original.len() == used.len() {
        // Both blocks: between them lies the ball.
        picks = original;
        let radii: Vec<f64> = used.iter().zip(&picks).map(|(u, o)| (u.point - o.point).dot(o.vector)).collect();
        let radius = tidy(radii.iter().sum::<f64>() / radii.len() as f64);
        if radius >= 0.0 && radii.iter().all(|r| (r - radius).abs() < 1e-3) {
            set(job, "stylus.diameter", Value::Number(tidy(2.0 * radius)));
            checker.info(
                "stylus-from-dump",
                "stylus.diameter",
                "The ball is what lies between the used and the original points",
            );
        }
    } else if compensated && !used.is_empty() {
        let radius = 3.0;
        for pick in &mut picks {
            pick.point -= pick.vector * radius;
        }
        let message = "The points are ball centres, and without the original points (-200 and following) the dump does not say the \
                       ball: the default one of 6 mm is taken off";
        checker.warning("ball-unknown", "stylus.diameter", message);
    } else if used.is_empty() {
        picks = original;
    } else if !original.is_empty() && original.iter().zip(&used).any(|(o, u)| o.point.distance(u.point) > SAME) {
        let message = "The used points (-100 and following) differ from the original ones (-200): the used ones are taken";
        checker.info("points-differ", "cycle.touches", message);
    }
    let explicit: Vec<Value> = picks
        .iter()
        .map(|p| Value::Map(vec![("point".to_owned(), triple(p.point)), ("vector".to_owned(), triple(p.vector))]))
        .collect();
    for pick in &mut picks {
        if (pick.vector.length() - 1.0).abs() <= 1e-3 {
            pick.vector = pick.vector.normalize();
        }
    }
    let mut fallback: Option<Value> = None;
    for plane in [Plane::G17, Plane::G18, Plane::G19] {
        let mut trial = job.clone();
        set(&mut trial, "plane", Value::Text(plane.word().to_owned()));
        let mut scratch = Checker::default();
        let mut section = Section::new(&mut scratch, trial.get("cycle"), "cycle");
        let Some(placement) = place(&mut section, &picks, plane) else { continue };
        set(&mut trial, "cycle.origin", triple(Vec3::from_array(placement.origin.to_array().map(tidy))));
        set(&mut trial, "cycle.rotation", Value::Number(tidy(placement.rotation)));
        for (key, size) in &placement.sizes {
            // A size with a code of its own is in the dump.
            if def.fields.iter().any(|f| f.key == *key && f.code.is_empty()) {
                set(&mut trial, &format!("cycle.{key}"), Value::Number(tidy(*size)));
            }
        }
        if let Some(read) = Job::read(&mut Checker::default(), &trial) {
            let planned = read.cycle.plan(&read.setup).touches;
            let same = planned.len() == picks.len()
                && planned
                    .iter()
                    .zip(&picks)
                    .all(|(t, p)| t.point.distance(p.point) < SAME && t.vector.distance(p.vector) < SAME);
            if same {
                if plane != Plane::G17 {
                    let message = format!("The target vectors are those of a feature in {}: that plane is taken", plane.word());
                    checker.info("plane-from-dump", "plane", message);
                }
                *job = trial;
                return;
            }
        }
        set(&mut trial, "cycle.touches", Value::List(explicit.clone()));
        let sound = Job::read(&mut Checker::default(), &trial).is_some();
        if sound && fallback.is_none() {
            fallback = Some(trial);
        }
    }
    if let Some(sound) = fallback {
        *job = sound;
        let message = "The touch points are not those that the dimensions alone would give: they are kept as they were picked";
        checker.info("touches-kept", "cycle.touches", message);
        return;
    }
    set(job, "cycle.touches", Value::List(explicit));
    let message = "The touch points do not make this feature: see the job's own findings";
    checker.warning("touches-unsound", "cycle.touches", message);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_the_forms_people_have() {
        for (text, value) in [
            ("CmdPrm.Flt[-50] = 12.5", 12.5),
            ("CmdPrm. Flt [-50] = 12,5", 12.5),
            ("cmdprm.flt[ -50 ]: 12.5 ; comment 7", 12.5),
            ("Flt[-50] 12.5", 12.5),
            ("CmdPrm.Flt[-50],Double,12.5,\"Feed distance 2\"", 12.5),
            ("CmdPrm.Flt[-50];Double;12,5;Feed distance", 12.5),
            ("{ \"code\": \"CmdPrm.Flt[-50]\", \"type\": \"Double\", \"value\": 12.5, \"meaning\": \"x 3\" }", 12.5),
            ("| CmdPrm.Flt[-50] | Double | 1.25e1 |", 12.5),
            ("Flt[-50]=.125E+2", 12.5),
        ] {
            assert_eq!(entries(text), [Entry { accessor: "Flt", code: -50, value }], "{text}");
        }
        assert_eq!(value(" = True"), Some(1.0));
        assert_eq!(value(",Boolean,false,On"), Some(0.0));
        assert_eq!(value("= -12"), Some(-12.0));
        assert_eq!(value(" | Double | Feed distance |"), None);
        assert_eq!(entries("Int[-1]=7 Flt[-50]=3 Flt[x]=1 [-3] Flt[99999999999]=1").len(), 2);
    }
}
