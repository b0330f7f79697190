//! A plan as JavaScript takes it: numbers and one text, in sections that are read one by one. `www/core/plan.ts` is the other half.

use wasm_bindgen::prelude::*;

use crate::form::{Finding, Level};
use crate::job::{Move, ParameterRow, ParameterValue, Plan, ResultRow};
use crate::text::{Part, Text};

#[wasm_bindgen]
extern "C" {
    /// Takes what goes out, and copies it before it returns.
    pub type Sink;

    #[wasm_bindgen(method)]
    fn take(this: &Sink, numbers: &[f64], text: &str);
}

/// Words that go out as their places in these lists.
const FEEDS: [&str; 6] = ["approach", "longLink", "work", "retract", "return", "rapid"];
const KINDS: [&str; 3] = ["position", "touch", "back"];
const UNITS: [&str; 4] = ["mm", "inch", "deg", ""];
const LEVELS: [Level; 3] = [Level::Error, Level::Warning, Level::Info];

/// How many sections a plan has: touches, moves, program, results, triggers, findings, safety.
const SECTIONS: usize = 7;

/// Numbers and a text while they are written. A text is its length in UTF-16 units; what is not there is NaN, or −1 for an index.
#[derive(Default)]
struct Packed {
    numbers: Vec<f64>,
    text: String,
    /// How long the text is in UTF-16 units.
    units: usize,
}

impl Packed {
    fn number(&mut self, x: f64) {
        self.numbers.push(x);
    }

    fn count(&mut self, n: usize) {
        self.numbers.push(n as f64);
    }

    fn optional(&mut self, x: Option<f64>) {
        self.numbers.push(x.unwrap_or(f64::NAN));
    }

    fn index(&mut self, n: Option<usize>) {
        self.numbers.push(n.map_or(-1.0, |n| n as f64));
    }

    fn flag(&mut self, on: Option<bool>) {
        self.numbers.push(on.map_or(f64::NAN, |on| f64::from(u8::from(on))));
    }

    fn text(&mut self, text: &str) {
        let units = if text.is_ascii() { text.len() } else { text.encode_utf16().count() };
        self.text.push_str(text);
        self.units += units;
        self.count(units);
    }

    fn text_or_none(&mut self, text: Option<&str>) {
        match text {
            Some(text) => self.text(text),
            None => self.number(-1.0),
        }
    }

    /// How many values it has, its template, then each of them: a text as this one, what is the same in every language after a −1.
    fn said(&mut self, text: &Text) {
        self.count(text.values().len());
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

    fn said_or_none(&mut self, text: Option<&Text>) {
        match text {
            Some(text) => self.said(text),
            None => self.number(-1.0),
        }
    }

    /// A word as its place in a list.
    fn word(&mut self, word: &str, words: &[&str]) {
        self.index(words.iter().position(|known| *known == word));
    }

    fn list<T>(&mut self, items: &[T], each: impl Fn(&mut Self, &T)) {
        self.count(items.len());
        items.iter().for_each(|item| each(self, item));
    }

    /// A section begins: its places in numbers and text go to the front.
    fn begin(&mut self, section: usize) {
        self.numbers[2 * section] = self.numbers.len() as f64;
        self.numbers[2 * section + 1] = self.units as f64;
    }
}

/// Hands a plan out, but for its table.
pub fn give(plan: &Plan, sink: &Sink) {
    let mut out = Packed { numbers: vec![0.0; 2 * SECTIONS], ..Packed::default() };
    out.numbers.reserve(40 + 12 * plan.moves.len() + 10 * plan.results.len() + 8 * plan.touches.len());
    out.text.reserve(plan.program.text.len() + 2048);
    out.number(plan.length);
    out.number(plan.time);
    out.begin(0);
    out.list(&plan.touches, |out, touch| {
        out.numbers.extend(touch.point.iter().chain(&touch.vector));
        out.count(touch.group);
    });
    out.begin(1);
    moves(&mut out, &plan.moves);
    out.begin(2);
    let program = &plan.program;
    out.text(program.post);
    out.text(program.extension);
    out.text(&program.text);
    out.list(&program.move_lines, |out, line| out.number(f64::from(*line)));
    out.list(&program.writes, |out, part| out.text(part));
    out.said(&program.said);
    match &program.proof {
        Some(proof) => {
            out.count(proof.moves);
            out.count(proof.touches);
            out.flag(Some(proof.arithmetic));
        }
        None => out.number(-1.0),
    }
    out.begin(3);
    out.list(&plan.results, result);
    out.begin(4);
    out.list(&plan.triggers, |out, trigger| out.numbers.extend(trigger.unwrap_or([f64::NAN; 3])));
    out.begin(5);
    out.list(&plan.findings, finding);
    out.begin(6);
    out.list(&plan.safety, |out, row| {
        out.text(row.rule);
        out.flag(row.holds);
        out.said(&row.said);
        out.list(&row.lines, |out, line| out.count(*line));
        out.list(&row.about, |out, line| out.count(*line));
    });
    sink.take(&out.numbers, &out.text);
}

/// Column by column: where the moves end, then feed, kind, step and touch of each, then the arcs, with the move of each.
fn moves(out: &mut Packed, moves: &[Move]) {
    out.count(moves.len());
    moves.iter().for_each(|step| out.numbers.extend(step.to));
    moves.iter().for_each(|step| out.word(step.feed, &FEEDS));
    moves.iter().for_each(|step| out.word(step.kind, &KINDS));
    moves.iter().for_each(|step| out.number(f64::from(step.step)));
    moves.iter().for_each(|step| out.index(step.touch));
    for (i, arc) in moves.iter().enumerate().filter_map(|(i, step)| Some((i, step.arc.as_ref()?))) {
        out.count(i);
        out.numbers.extend(arc.center);
        out.number(arc.sweep);
    }
    out.number(-1.0);
}

fn result(out: &mut Packed, row: &ResultRow) {
    out.text(&row.code);
    out.said(&row.said.meaning);
    out.word(row.unit, &UNITS);
    for x in [row.nominal, row.value, row.deviation, row.uncertainty, row.uncertainty_runout] {
        out.optional(x);
    }
    for i in 0..2 {
        out.optional(row.limits.map(|limits| limits[i]));
    }
    out.said_or_none(row.said.verdict.as_ref());
    out.optional(row.truth);
    out.said_or_none(row.said.note.as_ref());
}

fn finding(out: &mut Packed, finding: &Finding) {
    out.index(LEVELS.iter().position(|level| *level == finding.level));
    out.text(&finding.code);
    out.text(&finding.path);
    out.said(&finding.said);
}

/// Hands out what the rows of a parameter table mean.
pub fn give_meanings(rows: &[ParameterRow], sink: &Sink) {
    let mut out = Packed::default();
    out.list(rows, |out, row| out.said(&row.meaning));
    sink.take(&out.numbers, &out.text);
}

/// Hands a parameter table out, in English.
pub fn give_table(rows: &[ParameterRow], sink: &Sink) {
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
                out.flag(Some(*on));
            }
            ParameterValue::Text(text) => {
                out.number(2.0);
                out.text(text);
            }
        }
        out.text(&row.meaning.english());
        out.text_or_none(row.field.as_deref());
        out.index(row.touch);
    });
    sink.take(&out.numbers, &out.text);
}
