//! A plan encoded for JavaScript, in sections that are read one by one. `www/core/plan.ts` is the counterpart.

use crate::form::{Finding, Level};
use crate::job::{
    DatumRow, Move, ParameterRow, ParameterValue, Plan, ProgramText, ProofRow, ResultRow,
    SafetyRow, TouchPoint,
};
use crate::text::{Part, Text};

/// Words that are passed as indices into these lists.
pub const FEEDS: [&str; 6] = ["approach", "longLink", "work", "retract", "return", "rapid"];
/// Kinds of moves, passed as indices.
pub const KINDS: [&str; 3] = ["position", "touch", "back"];
/// Units of results, passed as indices; empty for a number without unit.
pub const UNITS: [&str; 4] = ["mm", "inch", "deg", ""];
/// Levels of findings, passed as indices.
#[cfg(test)]
pub const LEVELS: [Level; 3] = [Level::Error, Level::Warning, Level::Info];

/// Sections of a plan, in order.
#[derive(Clone, Copy, Debug)]
pub enum Section {
    Touches,
    Moves,
    Program,
    Results,
    Triggers,
    Findings,
    Safety,
}

impl Section {
    pub const ALL: [Section; 7] = {
        use Section::*;
        [Touches, Moves, Program, Results, Triggers, Findings, Safety]
    };
}

/// Output buffer: numbers and one string. A text is passed as its length in UTF-16 units; a missing number is NaN, a missing index −1.
#[derive(Default)]
pub struct Packed {
    pub numbers: Vec<f64>,
    /// All texts, concatenated.
    pub text: String,
    /// Length of the string in UTF-16 units.
    units: usize,
}

impl Packed {
    fn number(&mut self, x: f64) {
        self.numbers.push(x);
    }

    fn count(&mut self, n: &usize) {
        self.numbers.push(*n as f64);
    }

    fn optional(&mut self, x: &Option<f64>) {
        self.numbers.push(x.unwrap_or(f64::NAN));
    }

    fn pair(&mut self, pair: &Option<[f64; 2]>) {
        self.numbers.extend(pair.unwrap_or([f64::NAN; 2]));
    }

    fn triple(&mut self, triple: &[f64; 3]) {
        self.numbers.extend(triple);
    }

    fn index(&mut self, n: &Option<usize>) {
        self.numbers.push(n.map_or(-1.0, |n| n as f64));
    }

    fn yes(&mut self, on: &bool) {
        self.number(f64::from(u8::from(*on)));
    }

    fn flag(&mut self, on: &Option<bool>) {
        self.numbers
            .push(on.map_or(f64::NAN, |on| f64::from(u8::from(on))));
    }

    fn text(&mut self, text: &str) {
        let units = if text.is_ascii() {
            text.len()
        } else {
            text.encode_utf16().count()
        };
        self.text.push_str(text);
        self.units += units;
        self.count(&units);
    }

    fn text_or_none(&mut self, text: &Option<String>) {
        match text {
            Some(text) => self.text(text),
            None => self.number(-1.0),
        }
    }

    /// A text: number of values, template, then each value. A text value is encoded likewise, a verbatim value follows a −1.
    fn said(&mut self, text: &Text) {
        self.count(&text.values().len());
        self.text(text.template());
        for value in text.values() {
            match value {
                Part::Text(text) => self.said(text),
                Part::Verbatim(text) => {
                    self.number(-1.0);
                    self.text(text);
                }
            }
        }
    }

    fn said_or_none(&mut self, text: &Option<Text>) {
        match text {
            Some(text) => self.said(text),
            None => self.number(-1.0),
        }
    }

    /// A word as an index into a list.
    fn word(&mut self, word: &str, words: &[&str]) {
        self.index(&words.iter().position(|known| *known == word));
    }

    fn level(&mut self, level: &Level) {
        self.number(f64::from(*level as u8));
    }

    fn counts(&mut self, counts: &[usize]) {
        self.list(counts, Packed::count);
    }

    fn numbers(&mut self, numbers: &[i32]) {
        self.list(numbers, |out, n| out.number(f64::from(*n)));
    }

    fn texts<T: AsRef<str>>(&mut self, texts: &[T]) {
        self.list(texts, |out, text| out.text(text.as_ref()));
    }

    fn list<T>(&mut self, items: &[T], each: impl Fn(&mut Self, &T)) {
        self.count(&items.len());
        items.iter().for_each(|item| each(self, item));
    }

    /// Begins a section: its positions in numbers and string go to the front.
    fn begin(&mut self, section: Section) {
        let section = section as usize;
        self.numbers[2 * section] = self.numbers.len() as f64;
        self.numbers[2 * section + 1] = self.units as f64;
    }
}

/// Declares the encoding of rows: each field with a method of [`Packed`], optionally with a list of words. The functions here and the list for the JavaScript
/// part come from the same lines.
macro_rules! rows {
    ($($name:ident($row:ty) { $($($field:ident).+: $how:ident $(($words:ident))?),* $(,)? })*) => {
        $(fn $name(out: &mut Packed, row: &$row) {
            $(out.$how(&row.$($field).+ $(, &$words)?);)*
        })*

        /// The rows: name of the function and, for each field, name, encoding and list of words.
        #[cfg(test)]
        pub const ROWS: &[(&str, &[(&str, &str, &str)])] = &[
            $((stringify!($name), &[$((stringify!($($field).+), stringify!($how), concat!($(stringify!($words))?)),)*]),)*
        ];
    };
}

rows! {
    touch(TouchPoint) { point: triple, vector: triple, group: count, cycle: count }
    program(ProgramText) {
        post: text,
        extension: text,
        text: text,
        move_lines: numbers,
        writes: texts,
        said: said,
        own: yes,
    }
    proof(ProofRow) { moves: count, touches: count, arithmetic: yes }
    datum(DatumRow) { axis: text, from: text_or_none, choices: texts }
    result(ResultRow) {
        code: text,
        said.meaning: said,
        unit: word(UNITS),
        nominal: optional,
        value: optional,
        deviation: optional,
        uncertainty: optional,
        uncertainty_runout: optional,
        limits: pair,
        said.verdict: said_or_none,
        truth: optional,
        said.note: said_or_none,
        stored: text_or_none,
        cycle: count,
    }
    finding(Finding) { level: level, code: text, path: text, said: said }
    safety(SafetyRow) { rule: text, holds: flag, said: said, lines: counts, about: counts }
}

/// A plan without its table.
pub fn plan(plan: &Plan) -> Packed {
    let mut out = Packed {
        numbers: vec![0.0; 2 * Section::ALL.len()],
        ..Packed::default()
    };
    out.numbers
        .reserve(40 + 12 * plan.moves.len() + 10 * plan.results.len() + 8 * plan.touches.len());
    out.text.reserve(plan.program.text.len() + 2048);
    out.number(plan.length);
    out.number(plan.time);
    out.texts(&plan.cycles);
    out.texts(&plan.relations);
    out.list(&plan.datum, datum);
    out.begin(Section::Touches);
    out.list(&plan.touches, touch);
    out.begin(Section::Moves);
    moves(&mut out, &plan.moves);
    out.begin(Section::Program);
    program(&mut out, &plan.program);
    match &plan.program.proof {
        Some(row) => proof(&mut out, row),
        None => out.number(-1.0),
    }
    out.begin(Section::Results);
    out.list(&plan.results, result);
    out.begin(Section::Triggers);
    out.list(&plan.triggers, |out, trigger| {
        out.triple(&trigger.unwrap_or([f64::NAN; 3]))
    });
    out.begin(Section::Findings);
    out.list(&plan.findings, finding);
    out.begin(Section::Safety);
    out.list(&plan.safety, safety);
    out
}

/// Moves in columns: ends, feeds, kinds, steps, touches and cycles, then the arcs with the index of their move.
fn moves(out: &mut Packed, moves: &[Move]) {
    out.count(&moves.len());
    moves.iter().for_each(|step| out.triple(&step.to));
    moves.iter().for_each(|step| out.word(step.feed, &FEEDS));
    moves.iter().for_each(|step| out.word(step.kind, &KINDS));
    moves
        .iter()
        .for_each(|step| out.number(f64::from(step.step)));
    moves.iter().for_each(|step| out.index(&step.touch));
    moves.iter().for_each(|step| out.count(&step.cycle));
    for (i, arc) in moves
        .iter()
        .enumerate()
        .filter_map(|(i, step)| Some((i, step.arc.as_ref()?)))
    {
        out.count(&i);
        out.triple(&arc.center);
        out.number(arc.sweep);
    }
    out.number(-1.0);
}

/// Meanings of the rows of a parameter table.
pub fn meanings(rows: &[ParameterRow]) -> Packed {
    let mut out = Packed::default();
    out.list(rows, |out, row| out.said(&row.meaning));
    out
}

/// A parameter table, in English.
pub fn table(rows: &[ParameterRow]) -> Packed {
    let mut out = Packed::default();
    out.list(rows, |out, row| {
        out.text(&row.code);
        out.text(row.type_name);
        match &row.value {
            ParameterValue::Whole(n) => {
                out.number(0.0);
                out.number(f64::from(*n));
            }
            ParameterValue::Number(x) => {
                out.number(0.0);
                out.number(*x);
            }
            ParameterValue::Flag(on) => {
                out.number(1.0);
                out.yes(on);
            }
            ParameterValue::Text(text) => {
                out.number(2.0);
                out.text(text);
            }
        }
        out.text(&row.meaning.english());
        out.text_or_none(&row.field);
        out.index(&row.touch);
        out.count(&row.cycle);
    });
    out
}
