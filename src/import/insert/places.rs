//! Tool changes of a program, and which of them is the probe's.

use serde::Serialize;

use crate::control::iso::block::Block;
use crate::control::iso::codes::{Effect, Family};

/// A place in a program: after a tool change and the activation of the tool's length.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ToolPlace {
    /// The 0-based line after which a program can be inserted.
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
    let about = Block::of(&text, Family::Sinumerik).tool();
    let says = words().any(|word| PROBES.contains(&word) || is_model(word));
    let chinese = ["测头", "測頭"].iter().any(|word| text.contains(word));
    (says || chinese)
        && !words().any(|word| OTHERS.contains(&word))
        && about.is_none_or(|about| Some(about.as_str()) == tool)
}

/// Whether a block activates the length of a tool: G43, G44, a SINUMERIK's D, or Okuma's G56 with H.
fn activates_length(block: &Block, family: Family) -> bool {
    let by_code = block.does(|effect| match effect {
        Effect::Length(active) => active,
        Effect::LengthGiven { .. } => true,
        Effect::Offset(3) => block.has(b'H'),
        _ => false,
    });
    by_code || family == Family::Sinumerik && block.has(b'D')
}

/// The tool changes of a program: M6, or a T with a name. The place is after the block that activates the tool's length, if it comes before the next tool change.
/// A block that the operator may skip is no place.
pub fn places(lines: &[&str], family: Family) -> Vec<ToolPlace> {
    let mut places: Vec<ToolPlace> = Vec::new();
    let mut tool: Option<String> = None;
    // The comments above a block.
    let mut said: Vec<String> = Vec::new();
    // Whether the length of the last tool is active, and whether the last block is its change.
    let (mut length, mut open) = (true, false);
    for (index, line) in lines.iter().enumerate() {
        let block = Block::of(line, family);
        let number = block.tool();
        let only_calls = number.is_some();
        tool = block.tool_name.clone().or(number).or(tool);
        if block.is_blank() {
            // A comment below a tool change is about its tool.
            if let Some(place) = places.last_mut().filter(|_| open) {
                place.probe |= says_probe(&block.comment, place.tool.as_deref());
            }
            said.push(block.comment);
            continue;
        }
        let named = block.tool_name.is_some();
        if block.does(|effect| effect == Effect::Tool) || named {
            let again = !named && open && places.last().is_some_and(|last| last.tool == tool);
            let about = |text: &String| says_probe(text, tool.as_deref());
            let probe = tool.as_deref().is_some_and(|name| says_probe(name, None))
                || said.iter().chain([&block.comment]).any(about);
            match places.last_mut() {
                // `T="PROBE"` and its M6.
                Some(last) if again => last.line = index,
                _ if block.skips => {}
                _ => places.push(ToolPlace {
                    line: index,
                    tool: tool.clone(),
                    probe,
                }),
            }
            (length, open) = (block.skips, !block.skips);
        } else {
            open = false;
        }
        if !length && activates_length(&block, family) {
            length = true;
            if block.skips {
                places.pop();
            } else if let Some(place) = places.last_mut() {
                place.line = index;
            }
        }
        // A block with nothing but the T belongs to the change below it.
        if open || !only_calls {
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
