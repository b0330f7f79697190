//! The ISO of a HEIDENHAIN while it runs: Q parameters by D codes and formulas, labels G98, calls and repeats L. What is known is put into the blocks as
//! numbers, and the reader reads these.
//!
//! D00 to D14 are FN 0 to FN 14 of Klartext, with P01, P02 and P03 in front of what they work on.

use std::collections::BTreeMap;

use crate::control::iso::lex::{head, line_end, lines_of, trimmed};
use crate::import::toolpath::calls::Place;
use crate::import::toolpath::flow::{Flow, Step};
use crate::import::toolpath::known::Ask;
use crate::import::toolpath::script::expression::Cursor;
use crate::import::toolpath::script::grammar::HEIDENHAIN;
use crate::import::toolpath::script::variables::{Value, Variables};
use crate::import::toolpath::system::System;
use crate::num::decimal;

/// So many blocks are run: whoever repeats more has an end.
const MOST_BLOCKS: usize = 500_000;

/// So deep a subprogram may call the next one.
const DEEPEST: usize = 20;

/// Runs the arithmetic and the jumps of a text.
pub(super) struct HeidenhainIso {
    q: Variables,
    /// Where each label is: the block below it. One that is there twice leads nowhere.
    labels: BTreeMap<u32, Option<Place>>,
    frames: Vec<Place>,
    /// How often the call in a line repeats its section again.
    repeats: BTreeMap<usize, usize>,
    blocks: usize,
}

/// A block without its number and the `*` that ends it, in capitals.
fn code_of(line: &[u8]) -> String {
    let code = String::from_utf8_lossy(&line[head(line).end..]).to_ascii_uppercase();
    let code = code.split(';').next().unwrap_or_default().trim_end();
    code.strip_suffix('*').unwrap_or(code).trim().to_owned()
}

/// The number of `G98 L5`.
fn label(code: &str) -> Option<u32> {
    code.strip_prefix("G98")?
        .trim_start()
        .strip_prefix('L')?
        .trim()
        .parse()
        .ok()
}

impl HeidenhainIso {
    /// None where a text is another one.
    pub fn of(text: &str, set: &[(&str, f64)]) -> Option<Self> {
        let first = trimmed(lines_of(text).find(|line| !trimmed(line).is_empty())?);
        (first.starts_with('%') && first.ends_with('*')).then_some(())?;
        let bytes = text.as_bytes();
        let (mut labels, mut at, mut line) = (BTreeMap::new(), 0, 0);
        while at < bytes.len() {
            let (end, below) = line_end(bytes, at);
            line += 1;
            if let Some(number) =
                label(&code_of(text[at..end].trim().as_bytes())).filter(|number| *number != 0)
            {
                labels
                    .entry(number)
                    .and_modify(|place| *place = None)
                    .or_insert(Some(Place { at: below, line }));
            }
            at = below;
        }
        Some(HeidenhainIso {
            q: Variables::new(&HEIDENHAIN, set),
            labels,
            frames: Vec::new(),
            repeats: BTreeMap::new(),
            blocks: 0,
        })
    }

    fn block(&mut self, code: &str, here: Place, next: Place) -> Step {
        if let Some(number) = label(code) {
            return if number == 0 {
                self.frames.pop().map_or(Step::Done, Step::Go)
            } else {
                Step::Done
            };
        }
        let mut letters = code.chars();
        match (letters.next(), letters.next()) {
            (Some('D'), Some('0'..='9')) => self.function(code, next),
            (Some('L'), Some('0'..='9')) => self.call(code, here, next),
            (Some('Q'), _) => self.formula(code),
            _ => self.words(code),
        }
    }

    /// `D01 Q1 P01 +Q2 P02 +5`, `D09 P01 +Q1 P02 +Q3 P03 5`.
    fn function(&mut self, code: &str, next: Place) -> Step {
        let Some(number) = code.get(1..3).and_then(|digits| digits.parse::<u32>().ok()) else {
            return Step::AsWritten;
        };
        let part = |name: &str| {
            code.split_once(name)
                .map(|(_, rest)| rest.split(" P").next().unwrap_or_default().trim())
        };
        let value = |name: &str| {
            let mut cursor = Cursor::new(part(name)?.as_bytes(), 0, &self.q);
            let value = cursor.value()?.or_nan();
            cursor.is_done().then_some(value)
        };
        let (a, b) = (value("P01"), value("P02"));
        let known = a.zip(b).filter(|(a, b)| !a.is_nan() && !b.is_nan());
        let result = match (number, a, b) {
            (9..=12, ..) => {
                let holds = known.map(|(a, b)| match number {
                    9 => a == b,
                    10 => a != b,
                    11 => a > b,
                    _ => a < b,
                });
                let to = part("P03").and_then(|label| label.parse().ok());
                let to = to.and_then(|label: u32| self.labels.get(&label).copied().flatten());
                return self.jump(holds, to, next);
            }
            (14, ..) => return Step::Ends,
            (0, Some(a), _) => a,
            (1, Some(a), Some(b)) => a + b,
            (2, Some(a), Some(b)) => a - b,
            (3, Some(a), Some(b)) => a * b,
            (4, Some(a), Some(b)) => a / b,
            (5, Some(a), _) => a.sqrt(),
            (6, Some(a), _) => a.to_radians().sin(),
            (7, Some(a), _) => a.to_radians().cos(),
            (8, Some(a), Some(b)) => a.hypot(b),
            (13, Some(a), Some(b)) => a.atan2(b).to_degrees().rem_euclid(360.0),
            _ => f64::NAN,
        };
        let Some(key) = Cursor::new(code.as_bytes(), 3, &self.q).key() else {
            return Step::AsWritten;
        };
        if number == 18 {
            self.q.set_by_control(key);
        } else {
            self.q.set(key, Value::of(result));
        }
        if result.is_nan() {
            Step::AsWritten
        } else {
            Step::Done
        }
    }

    /// Where the condition is not known the blocks are read in their order, and nothing is known of any parameter.
    fn jump(&mut self, holds: Option<bool>, to: Option<Place>, next: Place) -> Step {
        match (holds, to) {
            (Some(true), Some(to)) => Step::Go(to),
            (Some(false), _) => Step::Done,
            _ => {
                self.q.forget();
                // The label's own line: a jump meets its other way there.
                let below = to.filter(|to| to.line > next.line).map(|to| to.line - 1);
                below.map_or(Step::AsWritten, Step::MayJump)
            }
        }
    }

    /// `Q5 = +Q1 * 2`.
    fn formula(&mut self, code: &str) -> Step {
        let mut cursor = Cursor::new(code.as_bytes(), 0, &self.q);
        let Some(key) = cursor.key() else {
            return Step::AsWritten;
        };
        let value = cursor.eat("=").then(|| cursor.value()).flatten();
        let value = value.filter(|_| cursor.is_done()).unwrap_or(Value::Unknown);
        self.q.set(key, value);
        if value == Value::Unknown {
            Step::AsWritten
        } else {
            Step::Done
        }
    }

    /// `L5,0` calls; `L5,3` runs the section from the label on three times more.
    fn call(&mut self, code: &str, here: Place, next: Place) -> Step {
        let (number, times) = code[1..]
            .split_once([',', '.'])
            .unwrap_or((&code[1..], "0"));
        let place = number
            .trim()
            .parse()
            .ok()
            .and_then(|label: u32| self.labels.get(&label).copied().flatten());
        let (Some(place), Ok(times)) = (place, times.trim().parse::<usize>()) else {
            return Step::AsWritten;
        };
        if times == 0 {
            if self.frames.len() == DEEPEST {
                return Step::Stop;
            }
            self.frames.push(next);
            return Step::Go(place);
        }
        let left = self.repeats.entry(here.line).or_insert(times);
        if *left == 0 {
            self.repeats.remove(&here.line);
            return Step::Done;
        }
        *left -= 1;
        Step::Go(place)
    }

    /// A block of words, with numbers in place of the parameters that are known.
    fn words(&mut self, code: &str) -> Step {
        if !code.contains('Q') {
            return Step::AsWritten;
        }
        let mut out = String::with_capacity(code.len());
        let mut rest = code;
        while let Some(at) = rest.find('Q') {
            let (before, from) = rest.split_at(at);
            let mut cursor = Cursor::new(from.as_bytes(), 0, &self.q);
            let Some(key) = cursor.key() else {
                out.push_str(before);
                out.push('Q');
                rest = &from[1..];
                continue;
            };
            let after = cursor.at;
            let value = self.q.get(&key).or_nan();
            let (before, sign) = match before.strip_suffix('-') {
                Some(before) => (before, -1.0),
                None => (before.strip_suffix('+').unwrap_or(before), 1.0),
            };
            out.push_str(before);
            // What is not known stands there as a value of another dialect, which the reader knows for one.
            out.push_str(&if value.is_nan() {
                "[#0]".to_owned()
            } else {
                decimal(sign * value, 9)
            });
            rest = &from[after..];
        }
        out.push_str(rest);
        Step::Read(out.into_bytes())
    }
}

impl Flow for HeidenhainIso {
    fn step(&mut self, line: &[u8], here: Place, next: Place, _inside: usize) -> Step {
        self.blocks += 1;
        if self.blocks > MOST_BLOCKS {
            return Step::Stop;
        }
        if line.first() == Some(&b'%') {
            return Step::AsWritten;
        }
        self.q.line = here.line;
        let code = code_of(line);
        self.block(&code, here, next)
    }

    fn forget(&mut self) {
        self.q.forget();
    }

    fn fall_out(&mut self, _at_end: bool) -> Option<Place> {
        None
    }

    fn has_run(&self, _line: usize) -> bool {
        true
    }

    fn is_inside(&self) -> bool {
        !self.frames.is_empty()
    }

    fn sees(&mut self, _system: System) {}

    fn asks(&self) -> Vec<Ask> {
        self.q.asks()
    }

    fn uncalled(&mut self, _end: Place) -> Option<(String, Place)> {
        None
    }
}
