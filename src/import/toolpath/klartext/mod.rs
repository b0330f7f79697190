//! HEIDENHAIN Klartext: moves, Q parameters, labels and jumps. Native cycles are reported by name, and their ends are unknown unless their moves are known.
//!
//! Blocks of path functions, parameters and labels follow the control's manual. Not followed, but reported: rounded corners and chamfers, approach and
//! departure, tangential arcs, cycles, tilted planes, other programs.

mod datum;
mod path;
mod probe;

use crate::control::heidenhain::read::numbered_blocks;
use crate::import::toolpath::calls::Place;
use crate::import::toolpath::flow::LineAction;
use crate::import::toolpath::key::Key;
use crate::import::toolpath::known::UnsetVariable;
use crate::import::toolpath::native::q_parameters;
use crate::import::toolpath::reader::Reader;
use crate::import::toolpath::script::expression::Cursor;
use crate::import::toolpath::script::grammar::HEIDENHAIN;
use crate::import::toolpath::script::variables::Value as Computed;
use crate::import::toolpath::script::{Index, Machine, Turn};
use crate::import::toolpath::skipped::Skip;

/// A block, with the line it begins in.
struct Line {
    number: usize,
    /// Without its number and comments, in capitals.
    text: String,
}

/// Continuation after a block.
enum Next {
    Below,
    At(usize),
    End,
}

/// Runs a Klartext program.
pub(super) struct Klartext {
    lines: Vec<Line>,
    /// Its positions are blocks: a number from 0, and the line in which the block begins.
    machine: Machine,
    /// The pole: centre of circles and polar coordinates.
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
        let mut index = Index::default();
        for (at, line) in lines.iter().enumerate() {
            let here = Place {
                at,
                line: line.number,
            };
            let name = line.text.strip_prefix("LBL ").map(label);
            if let Some(name) = name.filter(|name| name != "0") {
                index.adds_label(name, here);
            }
            if let Some(turn) = turn(&line.text) {
                index.adds_turn(here, turn);
            }
        }
        Klartext {
            lines,
            machine: Machine::over(index, &HEIDENHAIN, set),
            pole: [f64::NAN; 3],
        }
    }

    /// Variables that were read before anything set them.
    pub fn asks(&self) -> Vec<UnsetVariable> {
        self.machine.variables.asks()
    }

    pub fn run(&mut self, reader: &mut Reader) {
        let mut at = 0;
        self.machine.runs = reader.run.is_some();
        while at < self.lines.len() {
            reader.line = self.lines[at].number;
            reader.join_branches(Some(reader.line));
            if !self.machine.begins_block(reader.line) {
                return reader.lose(Skip::Endless, reader.line);
            }
            let text = std::mem::take(&mut self.lines[at].text);
            let next = self.block(&text, at, reader);
            self.lines[at].text = text;
            at = match next {
                Next::Below => at + 1,
                Next::At(place) => place,
                Next::End => {
                    if let Some(log) = reader.log.as_mut().filter(|_| !reader.ended) {
                        log.ends = true;
                    }
                    return;
                }
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
            ["END", "PGM", ..] if self.machine.is_sure() => return Next::End,
            ["END", "PGM", ..] => {}
            ["LBL", ..] if label(text.get(4..).unwrap_or_default()) == "0" => {
                if let Some(back) = self.machine.leave() {
                    return Next::At(back.at);
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
                // A touch without contact stops the program.
                if reader.ended {
                    return Next::End;
                }
            }
            ["CYCL", "CALL", ..] => self.cycle("CYCL CALL", text, reader),
            _ if self.datum(&words, reader) => {}
            ["CYCL", "DEF", ..] => drop(self.assign_all(text)),
            ["FN", number, ..] => {
                return self.function(number.trim_end_matches(':'), text, at, reader);
            }
            ["IF", ..] => return self.jump(&text[2..], at, reader),
            [first, ..] if first.starts_with('Q') && text.contains('=') => {
                self.assign(text, reader)
            }
            [first, ..] if path::is_path(first) => {
                Self::notes_spindle(&words, reader);
                if self.path(text, reader) {
                    return Next::End;
                }
            }
            [first, ..] if is_m(first) => {
                Self::notes_spindle(&words, reader);
                if words
                    .iter()
                    .any(|word| matches!(*word, "M2" | "M02" | "M30"))
                {
                    return Next::End;
                }
            }
            // Shifts of 0, selections and texts move nothing.
            [
                "TRANS" | "SEL" | "PLANE" | "FUNCTION" | "GLOBAL" | "PATTERN",
                ..,
            ] => reader.skipped.count(Skip::Words, reader.line),
            _ => self.strange(reader),
        }
        Next::Below
    }

    /// A block that is not understood may move, call and compute.
    fn strange(&mut self, reader: &mut Reader) {
        self.machine.variables.forget();
        reader.lose(Skip::Words, reader.line);
    }

    /// A native cycle: its parameters are set, and its end is unknown.
    fn cycle(&mut self, name: &str, text: &str, reader: &mut Reader) {
        let given = self.assign_all(text);
        notes_clearance(&given, reader);
        // Results that a cycle leaves.
        for number in (115..=119).chain(150..=199).chain(950..=999) {
            self.machine
                .variables
                .set(parameter(number), Computed::Unknown);
        }
        let here = reader.here();
        let made = name
            .strip_prefix("TCH PROBE ")
            .is_some_and(|number| probe::makes(number, &given, reader));
        let named = given.into_iter().map(|(q, value)| (format!("Q{q}"), value));
        let given = named.collect();
        if made {
            reader.listed(name, given, here);
            let scale = reader.modes.scale * reader.inch();
            for (q, value) in std::mem::take(&mut reader.outputs) {
                let value = Computed::of(value / scale);
                self.machine.variables.set(parameter(q), value);
            }
            return;
        }
        reader.forget(7);
        reader.native(name, given, here);
    }

    /// Notes that the spindle is started or stopped.
    fn notes_spindle(words: &[&str], reader: &mut Reader) {
        let entry = (reader.path.len(), reader.line);
        let Some(log) = &mut reader.log else { return };
        for word in words {
            match *word {
                "M3" | "M03" | "M4" | "M04" | "M13" | "M14" => {
                    log.spindle.push((entry.0, entry.1, true));
                }
                "M5" | "M05" => log.spindle.push((entry.0, entry.1, false)),
                _ => {}
            }
        }
    }

    /// Sets the parameters of a cycle, and returns them.
    fn assign_all(&mut self, text: &str) -> Vec<(u32, f64)> {
        let known = |number| self.machine.variables.get(&parameter(number)).or_nan();
        let given = q_parameters(text, known);
        for (number, value) in &given {
            let value = Computed::of(*value);
            self.machine.variables.set(parameter(number), value);
        }
        given
    }

    /// `Q5 = +Q1 * ( 5 + SIN +30 )`.
    fn assign(&mut self, text: &str, reader: &mut Reader) {
        let mut cursor = Cursor::new(text.as_bytes(), 0, &self.machine.variables);
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
        let value = if self.machine.is_sure() {
            value
        } else {
            Computed::Unknown
        };
        self.machine.variables.set(key, value);
    }

    /// `FN 1: Q1 = +Q2 + +5`, `FN 9: IF +Q1 EQU +Q3 GOTO LBL 5`, `FN 14: ERROR = 1000`.
    fn function(&mut self, number: &str, text: &str, at: usize, reader: &mut Reader) -> Next {
        let Some((_, rest)) = text.split_once(':') else {
            self.strange(reader);
            return Next::Below;
        };
        let rest = rest.trim_start();
        match number {
            "0" | "1" | "2" | "3" | "4" | "5" | "6" | "7" | "8" | "13" => self.assign(rest, reader),
            "9" | "10" | "11" | "12" => {
                return self.jump(rest.strip_prefix("IF").unwrap_or(rest), at, reader);
            }
            // One that an unknown condition may jump over does not belong to this branch.
            "14" if !self.machine.is_sure() => reader.branch_ends(),
            "14" => {
                reader.aborts();
                return Next::End;
            }
            // Values of the control, and tables: the user may know them.
            "18" | "28" | "23" | "24" => {
                reader.skipped.count(Skip::Value, reader.line);
                let key = rest
                    .find('Q')
                    .and_then(|at| Cursor::new(rest.as_bytes(), at, &self.machine.variables).key());
                if let Some(key) = key {
                    self.machine.variables.set_by_control(key);
                }
            }
            // Writes values of the control, or a table.
            "17" => reader.wrote_by_function("SYSWRITE", rest),
            "26" | "27" => reader.wrote_by_function("TABWRITE", rest),
            // Outputs set nothing.
            _ => reader.skipped.count(Skip::Value, reader.line),
        }
        Next::Below
    }

    /// `+Q1 EQU +Q3 GOTO LBL 5`. If the condition is unknown the blocks are read in order.
    fn jump(&mut self, rest: &str, at: usize, reader: &mut Reader) -> Next {
        reader.asks();
        let mut cursor = Cursor::new(rest.as_bytes(), 0, &self.machine.variables);
        let holds = cursor.value().and_then(Computed::holds);
        let target = rest.split_once("LBL").map(|(_, name)| label(name));
        let to = target.and_then(|name| self.machine.index.only_label(&name));
        let next = Place {
            at: at + 1,
            line: reader.line + 1,
        };
        match self.machine.jump(to, holds, next) {
            LineAction::JumpTo(to) => return Next::At(to.at),
            LineAction::Skip => {}
            LineAction::BranchEnds(_) => reader.branch_ends(),
            LineAction::Way(way) => reader.goes_unknown_way(way),
            step => {
                reader.skipped.count(Skip::Condition, reader.line);
                if let LineAction::MayJump(line) = step {
                    reader.begin_branch(Some(line));
                }
            }
        }
        Next::Below
    }

    /// A number or a parameter; NaN if its value is unknown.
    fn value(&self, text: &str) -> f64 {
        let mut cursor = Cursor::new(text.as_bytes(), 0, &self.machine.variables);
        let value = cursor.operand().map_or(f64::NAN, Computed::or_nan);
        if cursor.is_done() { value } else { f64::NAN }
    }

    /// `5`, `"NAME"`, `5 REP 3`: a subprogram, or a repeated section from the label on.
    fn call(&mut self, rest: &str, at: usize, reader: &mut Reader) -> Next {
        let (name, times) = match rest.split_once("REP") {
            Some((name, times)) => (
                label(name),
                Some(self.value(times.trim_start_matches([' ', '/']))),
            ),
            None => (label(rest), None),
        };
        let repeats = rest.contains("REP");
        let place = self.machine.index.only_label(&name);
        let Some(place) = place.filter(|_| self.machine.may_call()) else {
            self.strange(reader);
            return Next::Below;
        };
        let here = Place {
            at,
            line: reader.line,
        };
        if !repeats {
            let back = Place {
                at: at + 1,
                line: reader.line + 1,
            };
            self.machine.enter(back, false, 0, Vec::new());
            return Next::At(place.at + 1);
        }
        match times.filter(|times| *times >= 0.0) {
            Some(times) if self.machine.repeats(here, times as usize) => {
                return Next::At(place.at);
            }
            Some(_) => {}
            None => self.strange(reader),
        }
        Next::Below
    }
}

/// At the clearance height of a cycle, Q260, nothing is in the way, by its manual.
fn notes_clearance(given: &[(u32, f64)], reader: &mut Reader) {
    let (scale, moves) = (reader.modes.scale, reader.path.len());
    let height = given
        .iter()
        .find(|(number, height)| *number == 260 && height.is_finite());
    if let (Some((_, height)), Some(log)) = (height, &mut reader.log) {
        log.clearances.push((moves, height * scale));
    }
}

/// Name of a label: a number, or a text in quotes.
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

/// Effect of a block on the course of the program.
fn turn(text: &str) -> Option<Turn> {
    let rest = text.strip_prefix("FN ").unwrap_or(text);
    if rest.len() < text.len() && rest.starts_with("14") {
        return Some(Turn::Ends(true));
    }
    if text.strip_prefix("LBL ").map(label).as_deref() == Some("0") {
        return Some(Turn::Back);
    }
    let ends = |word: &str| matches!(word, "M2" | "M02" | "M30");
    if text.starts_with("END PGM") || text.split_whitespace().any(ends) {
        return Some(Turn::Ends(false));
    }
    let (_, name) = text.split_once("GOTO LBL")?;
    Some(Turn::Jumps(label(name), false))
}

fn is_m(word: &str) -> bool {
    word.strip_prefix('M')
        .is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()))
}

/// Q and a number.
fn parameter(number: impl std::fmt::Display) -> Key {
    Key::Name(format!("Q{number}"))
}
