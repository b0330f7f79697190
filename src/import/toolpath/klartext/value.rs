//! Q parameters and what is computed of them. What is not known is NaN, and stays so through arithmetic.

use std::collections::BTreeMap;

use crate::import::toolpath::known::Ask;
use crate::num::read_digits;

/// The Q parameters of a program, as far as it sets them. A name is `Q5`, `QL1` or `QR2`.
#[derive(Debug, Default)]
pub struct Parameters {
    values: BTreeMap<String, f64>,
    /// What the user knows of them.
    given: BTreeMap<String, f64>,
    /// Something else may have set any of them since.
    lost: bool,
    /// What was read before anything set it, with the lines.
    asked: BTreeMap<String, Vec<u32>>,
    /// The line that is run.
    pub line: usize,
}

impl Parameters {
    pub fn new(set: &[(&str, f64)]) -> Self {
        let given = set
            .iter()
            .map(|(name, value)| (name.to_ascii_uppercase(), *value))
            .collect();
        Parameters {
            given,
            ..Parameters::default()
        }
    }

    pub fn set(&mut self, name: &str, value: f64) {
        self.values.insert(name.to_owned(), value);
    }

    /// Its value comes from the control, which the user may know.
    pub fn set_by_control(&mut self, name: &str) {
        let value = self.get_given(name);
        self.set(name, value);
    }

    fn get_given(&mut self, name: &str) -> f64 {
        if let Some(value) = self.given.get(name) {
            return *value;
        }
        const MOST_ASKED: usize = 200;
        if self.asked.len() < MOST_ASKED || self.asked.contains_key(name) {
            let lines = self.asked.entry(name.to_owned()).or_default();
            let line = self.line as u32;
            if !lines.contains(&line) {
                lines.push(line);
            }
        }
        f64::NAN
    }

    pub fn get(&mut self, name: &str) -> f64 {
        match self.values.get(name) {
            Some(value) => *value,
            None if self.lost => self.given.get(name).copied().unwrap_or(f64::NAN),
            None => self.get_given(name),
        }
    }

    /// What a cycle leaves of its results is not known: Q115 to Q119, Q150 to Q199, Q950 to Q999.
    pub fn forget_results(&mut self) {
        for number in (115..=119).chain(150..=199).chain(950..=999) {
            self.values.insert(format!("Q{number}"), f64::NAN);
        }
    }

    /// Nothing is known of any of them.
    pub fn forget(&mut self) {
        self.values.values_mut().for_each(|value| *value = f64::NAN);
        self.lost = true;
    }

    pub fn asks(&self) -> Vec<Ask> {
        self.asked
            .iter()
            .map(|(name, lines)| Ask {
                name: name.clone(),
                lines: lines.clone(),
            })
            .collect()
    }
}

/// Reads values in a block, which is in capitals.
pub struct Cursor<'b> {
    pub rest: &'b str,
    depth: usize,
}

/// Deepest nesting of brackets and signs.
const DEEPEST: usize = 40;

impl<'b> Cursor<'b> {
    pub fn new(rest: &'b str) -> Self {
        Cursor { rest, depth: 0 }
    }

    /// Goes past a sign or a word where it is next.
    pub fn eat(&mut self, word: &str) -> bool {
        self.rest = self.rest.trim_start();
        match self.rest.strip_prefix(word) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    /// The name of a parameter: `Q5`, `QL1`, `QR2`.
    pub fn parameter(&mut self) -> Option<String> {
        self.rest = self.rest.trim_start();
        let inner = self.rest.strip_prefix('Q')?;
        let kind = inner.strip_prefix(['L', 'R']).unwrap_or(inner);
        let digits = kind.len() - kind.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let length = self.rest.len() - kind.len() + digits;
        let (name, rest) = self.rest.split_at(length);
        (digits > 0).then(|| self.rest = rest)?;
        Some(name.to_owned())
    }

    /// A number or a parameter, with signs.
    pub fn operand(&mut self, q: &mut Parameters) -> Option<f64> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        let value = if self.eat("-") {
            -self.operand(q)?
        } else if self.eat("+") {
            self.operand(q)?
        } else if self.eat("(") {
            let inner = self.sum(q)?;
            self.eat(")").then_some(inner)?
        } else if self.rest.starts_with('Q') {
            let name = self.parameter()?;
            q.get(&name)
        } else if self
            .rest
            .starts_with(|c: char| c.is_ascii_digit() || c == '.' || c == ',')
        {
            let plain: String = self
                .rest
                .chars()
                .take(40)
                .map(|c| if c == ',' { '.' } else { c })
                .collect();
            let (number, length) = read_digits(plain.as_bytes())?;
            self.rest = &self.rest[length..];
            number
        } else {
            self.function(q)?
        };
        self.depth -= 1;
        Some(value)
    }

    fn function(&mut self, q: &mut Parameters) -> Option<f64> {
        const NAMES: [&str; 17] = [
            "SQRT", "SQ", "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "LN", "LOG", "EXP", "NEG",
            "INT", "FRAC", "ABS", "SGN", "PI",
        ];
        let name = NAMES.into_iter().find(|name| self.eat(name))?;
        if name == "PI" {
            return Some(std::f64::consts::PI);
        }
        let x = self.operand(q)?;
        Some(match name {
            "SQRT" => x.sqrt(),
            "SQ" => x * x,
            "SIN" => x.to_radians().sin(),
            "COS" => x.to_radians().cos(),
            "TAN" => x.to_radians().tan(),
            "ASIN" => x.asin().to_degrees(),
            "ACOS" => x.acos().to_degrees(),
            "ATAN" => x.atan().to_degrees(),
            "NEG" => -x,
            "INT" => x.trunc(),
            "FRAC" => x.fract(),
            "ABS" => x.abs(),
            "SGN" if x == 0.0 => 0.0,
            "SGN" => x.signum(),
            // What no probing program was seen to need costs nothing here.
            _ => f64::NAN,
        })
    }

    fn product(&mut self, q: &mut Parameters) -> Option<f64> {
        let mut left = self.power(q)?;
        loop {
            if self.eat("*") {
                left *= self.power(q)?;
            } else if self.eat("/") || self.eat("DIV") {
                left /= self.power(q)?;
            } else if self.eat("LEN") {
                left = left.hypot(self.power(q)?);
            } else if self.eat("ANG") {
                // Of the opposite side and the adjacent one, from 0 to 360.
                left = left.atan2(self.power(q)?).to_degrees().rem_euclid(360.0);
            } else {
                return Some(left);
            }
        }
    }

    fn power(&mut self, q: &mut Parameters) -> Option<f64> {
        let base = self.operand(q)?;
        if self.eat("^") {
            Some(base.powf(self.operand(q)?))
        } else {
            Some(base)
        }
    }

    /// A formula: sums of products.
    pub fn sum(&mut self, q: &mut Parameters) -> Option<f64> {
        let mut left = self.product(q)?;
        loop {
            if self.eat("+") {
                left += self.product(q)?;
            } else if self.eat("-") {
                left -= self.product(q)?;
            } else {
                return Some(left);
            }
        }
    }
}
