//! Tool changes of a program, and which of them is the probe's.

use serde::Serialize;

use super::words::{has_code, number_of, parted};
use crate::control::iso::lex::trimmed;

/// A place in a program: after a tool change and the activation of the tool's length.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ToolPlace {
    /// The 0-based line after which a program can be put.
    pub line: usize,
    /// The tool as the program names it: `24`, `PROBE`; null if it does not.
    pub tool: Option<String>,
    /// Whether a name or a comment says that the tool is a probe.
    pub probe: bool,
}

/// Words for a probe in names and comments, and words that say that a comment is about something else.
const PROBES: [&str; 8] = [
    "PROBE",
    "TOUCHPROBE",
    "TASTER",
    "MESSTASTER",
    "TASTKOPF",
    "RENISHAW",
    "ЩУП",
    "щуп",
];
const OTHERS: [&str; 6] = ["NO", "NOT", "FROM", "WITHOUT", "KEIN", "OHNE"];

/// Whether a text is about a probe, and about no other tool than this one.
fn says_probe(text: &str, tool: Option<&str>) -> bool {
    let text = text.to_ascii_uppercase();
    let words = || text.split(|c: char| !c.is_alphanumeric());
    let is_model = |word: &str| {
        ["OMP", "RMP"].iter().any(|maker| {
            word.strip_prefix(maker)
                .is_some_and(|number| number.starts_with(|c: char| c.is_ascii_digit()))
        })
    };
    let about = number_of(&text, 'T').map(|number| number.trim_start_matches('0'));
    let says = words().any(|word| PROBES.contains(&word) || is_model(word));
    let chinese = ["测头", "測頭"].iter().any(|word| text.contains(word));
    (says || chinese)
        && !words().any(|word| OTHERS.contains(&word))
        && about.is_none_or(|about| Some(about) == tool)
}

/// The name of a tool: `T="PROBE"`.
fn name_of(code: &str) -> Option<&str> {
    let (_, name) = code.split_once("T=\"")?;
    Some(name.split_once('"')?.0)
}

/// Whether a block activates the length of a tool.
fn activates_length(code: &str) -> bool {
    [43, 44, 56].iter().any(|of| has_code(code, 'G', *of))
        || number_of(code, 'D').is_some() && !code.contains('=')
}

/// The tool changes of a program: M6, or a T with a name. The place is after the block that activates the tool's length (G43, G44, G56, D), if it comes before
/// the next tool change. A block that the operator may skip is no place.
pub fn places(lines: &[&str]) -> Vec<ToolPlace> {
    let mut places: Vec<ToolPlace> = Vec::new();
    let mut tool: Option<String> = None;
    // The comments above a block.
    let mut said: Vec<&str> = Vec::new();
    // Whether the length of the last tool is active, and whether the last block is its change.
    let (mut length, mut open) = (true, false);
    for (index, line) in lines.iter().enumerate() {
        let (code, comment) = parted(line);
        let name = name_of(&code);
        let number = number_of(&code, 'T').map(|number| number.trim_start_matches('0'));
        tool = name.or(number).map(str::to_owned).or(tool);
        if trimmed(&code).is_empty() {
            said.push(comment);
            // A comment below a tool change is about its tool.
            if let Some(place) = places.last_mut().filter(|_| open) {
                place.probe |= says_probe(comment, place.tool.as_deref());
            }
            continue;
        }
        let skipped = code.starts_with('/');
        if has_code(&code, 'M', 6) || name.is_some() {
            let own = tool.as_deref();
            let again =
                name.is_none() && open && places.last().is_some_and(|last| last.tool == tool);
            let probe = own.is_some_and(|name| says_probe(name, None))
                || said
                    .iter()
                    .chain([&comment])
                    .any(|text| says_probe(text, own));
            match places.last_mut() {
                // `T="PROBE"` and its M6.
                Some(last) if again => last.line = index,
                _ if skipped => {}
                _ => places.push(ToolPlace {
                    line: index,
                    tool: tool.clone(),
                    probe,
                }),
            }
            (length, open) = (skipped, !skipped);
        } else {
            open = false;
        }
        if !length && activates_length(&code) {
            length = true;
            if skipped {
                places.pop();
            } else if let Some(place) = places.last_mut() {
                place.line = index;
            }
        }
        // A block with nothing but the T belongs to the change below it.
        if open || number_of(&code, 'T').is_none() {
            said.clear();
        }
    }
    places
}

/// The place after the tool of the job, or else after the only tool that is called a probe.
pub fn proposed(places: &[ToolPlace], tool: Option<String>) -> Option<usize> {
    let own = |place: &&ToolPlace| match &tool {
        Some(tool) => place.tool.as_ref() == Some(tool),
        None => place.probe,
    };
    let mut found = places.iter().filter(own);
    let first = found.next()?;
    let is_only = found.all(|other| other.tool == first.tool);
    is_only.then_some(first.line)
}
