//! Reads results that a control printed: `center.x=1.2345`, `CENTER X= 1.2345`, or `CENTER X 1.2345` as DPRNT prints it.

use std::borrow::Cow;

use crate::form::Checker;
use crate::formula::{ResultDef, Unit};
use crate::part::evaluate::UncertaintySources;
use crate::part::measured::line;
use crate::part::measured::{Measured, MeasurementContext, Numbered, is_numbers, reach, unclear};
use crate::text::text;

/// Name of a result in programs.
type Code = Cow<'static, str>;

/// Names of a formula's results in order, followed by the variables in which native cycles save some.
fn codes(expected: &MeasurementContext<'_>) -> Vec<Code> {
    let formula = &expected.path.formula;
    let variables = expected
        .kept
        .iter()
        .map(|(variable, _)| Cow::Owned(variable.clone()));
    formula
        .results
        .iter()
        .map(|result| formula.code(result))
        .chain(variables)
        .collect()
}

/// The result with this name.
fn result_of(name: usize, expected: &MeasurementContext<'_>) -> Option<usize> {
    match name.checked_sub(expected.path.formula.results.len()) {
        None => Some(name),
        Some(variable) => expected.kept.get(variable).map(|(_, result)| *result),
    }
}

/// A name and the text after its equals sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair<'a> {
    name: &'a str,
    /// `None` if the text is not a number.
    value: Option<f64>,
}

/// Every `name=number` of a line, without texts in parentheses. A computed value (`#1`, `[`) belongs to a block of a program.
pub fn pairs(line: &str) -> Vec<Pair<'_>> {
    let mut found = Vec::new();
    let mut rest = line;
    while let Some((name, after)) = rest.split_once('=') {
        let value = after.trim_start();
        rest = after;
        // `$13=1` is a setting.
        let named = name
            .trim_end()
            .ends_with(|c: char| c.is_alphanumeric() || c == ']')
            && !name.contains('$');
        if !named || value.is_empty() || value.starts_with(['#', '[', '=', '<', '"']) {
            continue;
        }
        let read = number(value).and_then(|(number, after)| {
            let end = after.trim_start();
            let apart = end.is_empty() || (end.len() < after.len() && end.contains('='));
            apart.then(|| {
                rest = end;
                number
            })
        });
        found.push(Pair {
            name: name.trim(),
            value: read,
        });
    }
    found
}

/// The number at the start of a text, and the rest. A control may show it with a decimal comma, `-59,98`: with digits on both sides, and nothing directly after
/// them.
fn number(text: &str) -> Option<(f64, &str)> {
    let (whole, rest) = line::number(text)?;
    let read = &text[..text.len() - rest.len()];
    let Some(decimals) = rest
        .strip_prefix(',')
        .filter(|_| !read.contains(['.', 'e', 'E']))
    else {
        return Some((whole, rest));
    };
    let length = decimals.bytes().take_while(u8::is_ascii_digit).count();
    let after = &decimals[length..];
    if length == 0 || !(after.is_empty() || after.starts_with(char::is_whitespace)) {
        return Some((whole, rest));
    }
    let (value, _) = line::number(&format!("{read}.{}", &decimals[..length]))?;
    Some((value, after))
}

/// `CENTER X 1.2345`: the code of a result and its number, without other text.
fn spaced<'a>(line: &'a str, codes: &[Code]) -> Option<Pair<'a>> {
    let line = line.trim();
    let begins = |code: &str| {
        let same = |(a, b): (u8, u8)| a.eq_ignore_ascii_case(&b) || (a == b' ' && b == b'.');
        line.len() > code.len()
            && line.bytes().zip(code.bytes()).all(same)
            && line.as_bytes()[code.len()].is_ascii_whitespace()
    };
    let code = codes
        .iter()
        .filter(|code| begins(code))
        .max_by_key(|code| code.len())?;
    let (name, rest) = line.split_at(code.len());
    let (value, after) = number(rest.trim_start())?;
    after.trim().is_empty().then_some(Pair {
        name,
        value: Some(value),
    })
}

/// Results in a line.
fn stated<'a>(line: &'a str, codes: &[Code]) -> Vec<Pair<'a>> {
    let pairs = pairs(line);
    if pairs.is_empty() {
        spaced(line, codes).into_iter().collect()
    } else {
        pairs
    }
}

/// Whether a line contains a result of this job.
pub fn known(line: &str, expected: &MeasurementContext<'_>) -> bool {
    let codes = codes(expected);
    stated(line, &codes)
        .iter()
        .any(|pair| codes.iter().any(|code| ends_with(pair.name, code)))
}

/// Reads the results of the formula. Derived rows, such as the shift of an offset, may be in the text and are not read.
pub fn read(
    checker: &mut Checker,
    lines: &[Numbered<'_>],
    expected: &MeasurementContext<'_>,
) -> Measured {
    let (defs, codes) = (&expected.path.formula.results, codes(expected));
    let mut values: Vec<Option<(f64, usize)>> = vec![None; defs.len()];
    for (i, &(number, line)) in lines.iter().enumerate() {
        if i == 0
            && expected
                .names
                .iter()
                .any(|name| line.eq_ignore_ascii_case(name))
        {
            continue;
        }
        let bare = line::without_comments(line);
        let pairs = stated(&bare, &codes);
        // A single number in the first line is the name of a program.
        let name = i == 0 && !bare.contains(char::is_whitespace);
        if pairs.is_empty() && is_numbers(&bare) && !name {
            unclear(checker, number, line);
        }
        for pair in pairs {
            take(checker, (number, pair), (&codes, expected), &mut values);
        }
    }
    let scaled = defs.iter().zip(&values).map(|(def, value)| {
        let (value, _) = (*value)?;
        Some(if def.role.is_angle() {
            value
        } else {
            value * checker.scale
        })
    });
    let mut results: Vec<Option<f64>> = scaled.collect();
    let added = expected.path.complete(&mut results);
    // A result that no native cycle stores is not missing.
    let kept = |i: usize| {
        let of_relation = expected
            .path
            .relations
            .iter()
            .any(|relation| relation.results.contains(&i));
        expected.kept.is_empty()
            || of_relation
            || expected.kept.iter().any(|(_, result)| *result == i)
    };
    let lacks = |(i, def): &(usize, &ResultDef)| {
        def.variable.is_some() && values[*i].is_none() && !added.contains(i) && kept(*i)
    };
    let missing: Vec<&str> = defs
        .iter()
        .enumerate()
        .filter(lacks)
        .map(|(i, _)| &*codes[i])
        .collect();
    if !missing.is_empty() {
        let message = text!(
            "The text does not have {codes}: these results are unknown",
            missing.join(", ")
        );
        checker.warning("result-missing", "measured", message);
    }
    check_reach(checker, expected, &results, &values);
    Measured {
        results: Some(results),
        ..Measured::default()
    }
}

/// Adds one pair.
fn take(
    checker: &mut Checker,
    (number, pair): (usize, Pair<'_>),
    (codes, expected): (&[Code], &MeasurementContext<'_>),
    values: &mut [Option<(f64, usize)>],
) {
    let fitting = codes
        .iter()
        .enumerate()
        .filter(|(_, code)| ends_with(pair.name, code));
    let found = fitting.max_by_key(|(_, code)| code.len());
    let found = found.and_then(|(name, code)| Some((result_of(name, expected)?, code)));
    let Some((at, code)) = found else {
        if !DERIVED.iter().any(|code| ends_with(pair.name, code)) {
            let message = text!(
                "Line {line}: \"{name}\" is no result of this job. Its results are {codes}",
                number,
                pair.name.chars().take(40).collect::<String>(),
                codes.join(", ")
            );
            checker.error("unknown-result", "measured", message);
        }
        return;
    };
    let Some(value) = pair.value else {
        checker.error(
            "not-a-number",
            "measured",
            text!(
                "Line {line}: {code} is not followed by a finite number",
                number,
                code.clone().into_owned()
            ),
        );
        return;
    };
    match values[at] {
        Some((known, before)) if known != value => {
            let message = text!(
                "Lines {one} and {other} have different values of {code}: paste the results of one run only",
                before,
                number,
                code.clone().into_owned()
            );
            checker.error("result-twice", "measured", message);
        }
        _ => values[at] = Some((value, number)),
    }
}

/// Rows derived from others or from single touches.
const DERIVED: &[&str] = &[
    "offset.x",
    "offset.y",
    "offset.z",
    "offset.rotation",
    "Q183",
    "Q970",
    "Q971",
    "Q973",
    "Q974",
    "form1",
    "form2",
];

/// Whether a name ends with a code: in any case, with a blank or nothing in place of a point, and not inside a longer word.
fn ends_with(name: &str, code: &str) -> bool {
    let (mut name, mut code) = (name.chars().rev().peekable(), code.chars().rev());
    loop {
        let Some(wanted) = code.next() else {
            return !name
                .peek()
                .is_some_and(|c| c.is_alphanumeric() || matches!(c, '.' | '_'));
        };
        if wanted == '.' {
            name.next_if(|c| matches!(c, '.' | ' ' | '_'));
        } else if !name.next().is_some_and(|c| c.eq_ignore_ascii_case(&wanted)) {
            return false;
        }
    }
}

/// Reports a length so far from nominal that no touch can have caused it: from another job, or in other units. Twice the effect of the touches is allowed,
/// since it is computed only at the nominal position.
fn check_reach(
    checker: &mut Checker,
    expected: &MeasurementContext<'_>,
    results: &[Option<f64>],
    lines: &[Option<(f64, usize)>],
) {
    let path = expected.path;
    let room = reach::farthest(path) * (path.touches.len() as f64).sqrt() * 2.0;
    let rows = crate::part::evaluate::stated(
        path,
        expected.radius,
        UncertaintySources {
            repeatability: 1.0,
            runout: None,
        },
        results,
    );
    for ((row, def), line) in rows.iter().zip(&path.formula.results).zip(lines) {
        let (Some(value), Some(spread), Some((_, line))) = (row.value, row.uncertainty, line)
        else {
            continue;
        };
        let away = (value - def.nominal).abs();
        if row.unit == Unit::Length && away > 0.01 + room * spread {
            let message = text!(
                "Line {line}: {code} is {away} from its nominal value, out of reach of the touches: is it from this job, in {unit}?",
                *line,
                path.formula.code(def).into_owned(),
                checker.length(away),
                checker.unit.to_owned()
            );
            checker.error("too-far", "measured", message);
        }
    }
}
