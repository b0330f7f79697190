//! HEIDENHAIN's ISO: Q parameters by D codes and formulas, labels G98, calls and repeats L.
//!
//! D00 to D14 are FN 0 to FN 14 of Klartext, with P01, P02 and P03 before their operands.

use crate::import::toolpath::calls::Place;
use crate::import::toolpath::flow::LineAction;
use crate::import::toolpath::script::expression::Cursor;
use crate::import::toolpath::script::machine::Machine;
use crate::import::toolpath::script::statement::{d_part, heidenhain_code, heidenhain_label};
use crate::import::toolpath::script::variables::Value;
use crate::num::decimal;

impl Machine {
    pub(super) fn heidenhain(&mut self, line: &[u8], here: Place, next: Place) -> LineAction {
        if line.first() == Some(&b'%') {
            return LineAction::AsWritten;
        }
        let code = heidenhain_code(line);
        if let Some(number) = heidenhain_label(&code) {
            let back = if number == 0 { self.leave() } else { None };
            return back.map_or(LineAction::Skip, LineAction::Leave);
        }
        let mut letters = code.bytes();
        match (letters.next(), letters.next()) {
            (Some(b'D'), Some(b'0'..=b'9')) => self.d_code(&code, next),
            (Some(b'L'), Some(b'0'..=b'9')) => self.calls_label(&code, here, next),
            (Some(b'Q'), _) => self.formula(&code),
            _ => self.with_parameters(&code),
        }
    }

    /// `D01 Q1 P01 +Q2 P02 +5`, `D09 P01 +Q1 P02 +Q3 P03 5`.
    fn d_code(&mut self, code: &str, next: Place) -> LineAction {
        let Some(number) = code.get(1..3).and_then(|digits| digits.parse::<u32>().ok()) else {
            return LineAction::AsWritten;
        };
        let value = |name: &str| {
            let mut cursor = Cursor::new(d_part(code, name)?.as_bytes(), 0, &self.variables);
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
                let to = d_part(code, "P03").and_then(|label| self.index.only_label(label));
                return self.jump(to, holds, next);
            }
            (14, ..) if self.is_sure() => return LineAction::Ends,
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
        let Some(key) = Cursor::new(code.as_bytes(), 3, &self.variables).key() else {
            return LineAction::AsWritten;
        };
        if number == 18 {
            self.variables.set_by_control(key);
            return LineAction::AsWritten;
        }
        self.sets(key, Value::of(result))
    }

    /// `Q5 = +Q1 * 2`.
    fn formula(&mut self, code: &str) -> LineAction {
        let mut cursor = Cursor::new(code.as_bytes(), 0, &self.variables);
        let Some(key) = cursor.key() else {
            return LineAction::AsWritten;
        };
        let value = cursor.eat("=").then(|| cursor.value()).flatten();
        let is_whole = cursor.is_done();
        self.sets(key, value.filter(|_| is_whole).unwrap_or(Value::Unknown))
    }

    /// `L5,0` calls; `L5,3` repeats the section from the label on three more times.
    fn calls_label(&mut self, code: &str, here: Place, next: Place) -> LineAction {
        let (number, times) = code[1..]
            .split_once([',', '.'])
            .unwrap_or((&code[1..], "0"));
        let place = self.index.only_label(number.trim());
        let (Some(place), Ok(times)) = (place, times.trim().parse::<usize>()) else {
            return LineAction::AsWritten;
        };
        if times > 0 {
            return if self.repeats(here, times) {
                LineAction::JumpTo(place)
            } else {
                LineAction::Skip
            };
        }
        if self.frames.len() == self.variables.grammar.deepest {
            return LineAction::Stop;
        }
        self.enter(next, false, 0, Vec::new());
        LineAction::Enter(place)
    }

    /// A block of words, with numbers in place of known parameters.
    fn with_parameters(&mut self, code: &str) -> LineAction {
        if !code.contains('Q') {
            return LineAction::AsWritten;
        }
        let mut out = String::with_capacity(code.len());
        let mut rest = code;
        while let Some(at) = rest.find('Q') {
            let (before, from) = rest.split_at(at);
            let mut cursor = Cursor::new(from.as_bytes(), 0, &self.variables);
            let Some(key) = cursor.key() else {
                out.push_str(before);
                out.push('Q');
                rest = &from[1..];
                continue;
            };
            let after = cursor.at;
            let (before, sign) = match before.strip_suffix('-') {
                Some(before) => (before, -1.0),
                None => (before.strip_suffix('+').unwrap_or(before), 1.0),
            };
            out.push_str(before);
            if let Some(axis @ b'X'..=b'Z') = before.bytes().last() {
                self.valued |= 1 << (axis - b'X');
            }
            // An unknown value is written as a variable of another dialect: the reader treats it as computed.
            out.push_str(&match self.variables.get(&key) {
                Value::Number(value) => decimal(sign * value, 9),
                _ => "[#0]".to_owned(),
            });
            rest = &from[after..];
        }
        out.push_str(rest);
        LineAction::Read(out.into_bytes())
    }
}
