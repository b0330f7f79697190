//! HEIDENHAIN Klartext: its moves, its Q parameters, labels and jumps. Cycles are the control's own: they are named, and where they end is not known.
//!
//! Blocks of path functions, parameters and labels are as the control's manual has them. Not followed, and reported: rounded corners and chamfers,
//! approach and departure, tangential arcs, cycles, datum shifts and tilted planes, other programs.

mod datum;
mod path;
mod probe;

use std::collections::BTreeMap;

use crate::control::heidenhain::read::{Given, assignments, numbered_blocks};
use crate::form::Value;
use crate::import::toolpath::key::Key;
use crate::import::toolpath::known::Ask;
use crate::import::toolpath::native::q_parameters;
use crate::import::toolpath::reader::Reader;
use crate::import::toolpath::script::expression::Cursor;
use crate::import::toolpath::script::grammar::HEIDENHAIN;
use crate::import::toolpath::script::variables::{Value as Computed, Variables};
use crate::import::toolpath::skipped::Skip;

/// So many blocks are run: whoever repeats more has an end.
const MOST_BLOCKS: usize = 500_000;

/// So deep a subprogram may call the next one.
const DEEPEST: usize = 20;

/// A block, with the line it begins in.
struct Line {
    number: usize,
    /// Without its number and comments, in capitals.
    text: String,
}

/// What follows a block.
enum Next {
    Below,
    At(usize),
    End,
}

/// Runs a Klartext program.
pub(super) struct Klartext {
    lines: Vec<Line>,
    labels: BTreeMap<String, Option<usize>>,
    q: Variables,
    /// Of each call under way, the block after it.
    frames: Vec<usize>,
    /// How often the call at a block repeats its section again.
    repeats: BTreeMap<usize, usize>,
    /// The pole: where circles and polar coordinates have their centre.
    pole: [f64; 3],
}

impl Klartext {
    pub fn new(text: &str, set: &[(&str, f64)]) -> Self {
        let lines: Vec<Line> = numbered_blocks(text)
            .into_iter()
            .map(|(number, text)| Line {
                number,
                text: text.to_ascii_uppercase(),
            })
            .collect();
        let mut labels = BTreeMap::new();
        for (at, line) in lines.iter().enumerate() {
            if let Some(label) = line
                .text
                .strip_prefix("LBL ")
                .map(label)
                .filter(|label| label != "0")
            {
                // A label that is there twice leads nowhere.
                labels
                    .entry(label)
                    .and_modify(|place| *place = None)
                    .or_insert(Some(at));
            }
        }
        Klartext {
            lines,
            labels,
            q: Variables::new(&HEIDENHAIN, set),
            frames: Vec::new(),
            repeats: BTreeMap::new(),
            pole: [f64::NAN; 3],
        }
    }

    /// What was read before anything set it.
    pub fn asks(&self) -> Vec<Ask> {
        self.q.asks()
    }

    pub fn run(&mut self, reader: &mut Reader) {
        let (mut at, mut ran) = (0, 0);
        while at < self.lines.len() {
            reader.line = self.lines[at].number;
            self.q.line = reader.line;
            reader.meet(Some(reader.line));
            ran += 1;
            if ran > MOST_BLOCKS {
                return reader.lose(Skip::Endless, reader.line);
            }
            let text = std::mem::take(&mut self.lines[at].text);
            let next = self.block(&text, at, reader);
            self.lines[at].text = text;
            at = match next {
                Next::Below => at + 1,
                Next::At(place) => place,
                Next::End => return,
            };
        }
    }

    fn block(&mut self, text: &str, at: usize, reader: &mut Reader) -> Next {
        let words: Vec<&str> = text.split_whitespace().collect();
        match words.as_slice() {
            [] => {}
            ["BEGIN", "PGM", .., units] => match *units {
                "INCH" => reader.units(false),
                _ => reader.units(true),
            },
            ["END", "PGM", ..] => return Next::End,
            ["LBL", ..] if label(text.get(4..).unwrap_or_default()) == "0" => {
                if let Some(back) = self.frames.pop() {
                    return Next::At(back);
                }
            }
            ["LBL" | "BLK" | "STOP" | "*" | "TOOL", ..]
                if words[..2.min(words.len())] != ["TOOL", "CALL"] => {}
            ["TOOL", "CALL", tool, ..] => {
                reader.tool = Some(self.value(tool));
                reader.frames.change_tool();
                reader.lengthen(7, reader.frames.table(), false);
            }
            ["CALL", "LBL", ..] => return self.call(text.get(8..).unwrap_or_default(), at, reader),
            ["TCH", "PROBE", number, ..] => {
                self.cycle(&["TCH PROBE ", number].concat(), text, reader);
                // A touch that meets nothing stops the program.
                if reader.ended {
                    return Next::End;
                }
            }
            ["CYCL", "CALL", ..] => self.cycle("CYCL CALL", text, reader),
            _ if self.datum(&words, reader) => {}
            ["CYCL", "DEF", ..] => self.assign_all(text),
            ["FN", number, ..] => return self.function(number.trim_end_matches(':'), text, reader),
            ["IF", ..] => return self.jump(&text[2..], reader),
            [first, ..] if first.starts_with('Q') && text.contains('=') => {
                self.assign(text, reader)
            }
            [first, ..] if path::is_path(first) => {
                if self.path(text, reader) {
                    return Next::End;
                }
            }
            [first, ..] if is_m(first) => {
                if words
                    .iter()
                    .any(|word| matches!(*word, "M2" | "M02" | "M30"))
                {
                    return Next::End;
                }
            }
            // Shifts of nothing, selections and texts move nothing.
            [
                "TRANS" | "SEL" | "PLANE" | "FUNCTION" | "GLOBAL" | "PATTERN",
                ..,
            ] => reader.skipped.count(Skip::Words, reader.line),
            _ => self.strange(reader),
        }
        Next::Below
    }

    /// What is not understood may move, call and compute.
    fn strange(&mut self, reader: &mut Reader) {
        self.q.forget();
        reader.lose(Skip::Words, reader.line);
    }

    /// A cycle of the control's own: its parameters are set, and where it ends is not known.
    fn cycle(&mut self, name: &str, text: &str, reader: &mut Reader) {
        self.assign_all(text);
        // What a cycle leaves of its results.
        for number in (115..=119).chain(150..=199).chain(950..=999) {
            self.q.set(parameter(number), Computed::Unknown);
        }
        let here = reader.here();
        let given = q_parameters(text);
        let made = name
            .strip_prefix("TCH PROBE ")
            .is_some_and(|number| probe::makes(number, &given, reader));
        if made {
            reader.listed(name, given, here);
            return;
        }
        reader.forget(7);
        reader.native(name, given, here);
    }

    /// The parameters of a cycle.
    fn assign_all(&mut self, text: &str) {
        for (number, given) in assignments(text) {
            let value = match given {
                Given::Value(Value::Number(x)) => x,
                _ => f64::NAN,
            };
            self.q.set(parameter(number), Computed::of(value));
        }
    }

    /// `Q5 = +Q1 * ( 5 + SIN +30 )`.
    fn assign(&mut self, text: &str, reader: &mut Reader) {
        let mut cursor = Cursor::new(text.as_bytes(), 0, &self.q);
        let Some(key) = cursor.key() else {
            // A text: QS1 = "…".
            return reader.skipped.count(Skip::Value, reader.line);
        };
        let value = cursor.eat("=").then(|| cursor.value()).flatten();
        let value = value
            .filter(|_| cursor.is_done())
            .unwrap_or(Computed::Unknown);
        if value == Computed::Unknown {
            reader.skipped.count(Skip::Value, reader.line);
        }
        self.q.set(key, value);
    }

    /// `FN 1: Q1 = +Q2 + +5`, `FN 9: IF +Q1 EQU +Q3 GOTO LBL 5`, `FN 14: ERROR = 1000`.
    fn function(&mut self, number: &str, text: &str, reader: &mut Reader) -> Next {
        let Some((_, rest)) = text.split_once(':') else {
            self.strange(reader);
            return Next::Below;
        };
        let rest = rest.trim_start();
        match number {
            "0" | "1" | "2" | "3" | "4" | "5" | "6" | "7" | "8" | "13" => self.assign(rest, reader),
            "9" | "10" | "11" | "12" => {
                return self.jump(rest.strip_prefix("IF").unwrap_or(rest), reader);
            }
            "14" => {
                reader.aborts();
                return Next::End;
            }
            // The control's own values, and tables: whom they belong to may know them.
            "18" | "28" | "23" | "24" => {
                reader.skipped.count(Skip::Value, reader.line);
                let key = rest
                    .find('Q')
                    .and_then(|at| Cursor::new(rest.as_bytes(), at, &self.q).key());
                if let Some(key) = key {
                    self.q.set_by_control(key);
                }
            }
            // The control's own values, and a table, are written.
            "17" => reader.wrote_by_function("SYSWRITE", rest),
            "26" | "27" => reader.wrote_by_function("TABWRITE", rest),
            // Outputs: they set nothing.
            _ => reader.skipped.count(Skip::Value, reader.line),
        }
        Next::Below
    }

    /// `+Q1 EQU +Q3 GOTO LBL 5`. Where the condition is not known the blocks are read in their order, and nothing is known of any parameter.
    fn jump(&mut self, rest: &str, reader: &mut Reader) -> Next {
        reader.asks();
        let mut cursor = Cursor::new(rest.as_bytes(), 0, &self.q);
        let holds = cursor.value().and_then(Computed::holds);
        let target = rest.split_once("LBL").map(|(_, name)| label(name));
        let place = target.and_then(|label| self.labels.get(&label).copied().flatten());
        match (holds, place) {
            (Some(true), Some(place)) => Next::At(place),
            (Some(false), _) => Next::Below,
            _ => {
                reader.skipped.count(Skip::Condition, reader.line);
                self.q.forget();
                if let Some(below) = place
                    .and_then(|place| self.lines.get(place))
                    .filter(|line| line.number > reader.line)
                {
                    reader.parts(Some(below.number));
                }
                Next::Below
            }
        }
    }

    /// A number or a parameter; NaN where it is none that is known.
    fn value(&self, text: &str) -> f64 {
        let mut cursor = Cursor::new(text.as_bytes(), 0, &self.q);
        let value = cursor.operand().map_or(f64::NAN, Computed::or_nan);
        if cursor.is_done() { value } else { f64::NAN }
    }

    /// `5`, `"NAME"`, `5 REP 3`: a subprogram, or the section from the label on again.
    fn call(&mut self, rest: &str, at: usize, reader: &mut Reader) -> Next {
        let (name, times) = match rest.split_once("REP") {
            Some((name, times)) => (
                label(name),
                Some(self.value(times.trim_start_matches([' ', '/']))),
            ),
            None => (label(rest), None),
        };
        let repeats = rest.contains("REP");
        let Some(place) = self
            .labels
            .get(&name)
            .copied()
            .flatten()
            .filter(|_| self.frames.len() < DEEPEST)
        else {
            self.strange(reader);
            return Next::Below;
        };
        if !repeats {
            self.frames.push(at + 1);
            return Next::At(place + 1);
        }
        match times.filter(|times| *times >= 0.0) {
            Some(times) => {
                let left = self.repeats.entry(at).or_insert(times as usize);
                if *left > 0 {
                    *left -= 1;
                    return Next::At(place);
                }
                self.repeats.remove(&at);
            }
            None => self.strange(reader),
        }
        Next::Below
    }
}

/// The name of a label: a number, or a text in quotes.
fn label(text: &str) -> String {
    let text = text.trim_start();
    match text.strip_prefix('"') {
        Some(inner) => inner.split('"').next().unwrap_or_default().to_owned(),
        None => text
            .split(|c: char| c.is_whitespace() || c == ';')
            .next()
            .unwrap_or_default()
            .to_owned(),
    }
}

fn is_m(word: &str) -> bool {
    word.strip_prefix('M')
        .is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()))
}

/// Q and a number.
fn parameter(number: impl std::fmt::Display) -> Key {
    Key::Name(format!("Q{number}"))
}
