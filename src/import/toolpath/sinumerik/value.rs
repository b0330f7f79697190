//! Variables and expressions of a SINUMERIK. What is not known is NaN, and stays so through arithmetic.

use std::collections::BTreeMap;

use crate::import::toolpath::known::Ask;
use crate::num::read_digits;

/// The variables of a program, as far as it sets them: R parameters, its own names, and those of the control as far as the run knows them. A name is in
/// capitals, with its index: `R5`, `LENGTH[2]`, `$AA_IW[X]`.
#[derive(Debug, Default)]
pub struct Variables {
    /// Global to all programs: R parameters and what has no definition.
    globals: BTreeMap<String, f64>,
    /// Of each call its own, by DEF and PROC.
    locals: Vec<BTreeMap<String, f64>>,
    /// What the control itself knows now.
    pub system: Vec<(&'static str, f64)>,
    given: BTreeMap<String, f64>,
    /// Something else may have set any global one since.
    lost: bool,
    asked: BTreeMap<String, Vec<u32>>,
    /// The line that is run.
    pub line: usize,
}

impl Variables {
    pub fn new(set: &[(&str, f64)]) -> Self {
        let given = set
            .iter()
            .map(|(name, value)| (plain(name), *value))
            .collect();
        Variables {
            given,
            locals: vec![BTreeMap::new()],
            ..Variables::default()
        }
    }

    pub fn get(&mut self, name: &str) -> f64 {
        if let Some(value) = self
            .locals
            .last()
            .and_then(|own| own.get(name))
            .or_else(|| self.globals.get(name))
        {
            return *value;
        }
        if let Some((_, value)) = self.system.iter().find(|(known, _)| *known == name) {
            return *value;
        }
        if let Some(value) = self.given.get(name) {
            return *value;
        }
        const MOST_ASKED: usize = 200;
        if (!self.lost || name.starts_with('$'))
            && (self.asked.len() < MOST_ASKED || self.asked.contains_key(name))
        {
            let lines = self.asked.entry(name.to_owned()).or_default();
            let line = self.line as u32;
            if !lines.contains(&line) {
                lines.push(line);
            }
        }
        f64::NAN
    }

    pub fn set(&mut self, name: &str, value: f64) {
        let own = self.locals.last_mut().filter(|own| own.contains_key(name));
        own.unwrap_or(&mut self.globals)
            .insert(name.to_owned(), value);
    }

    /// A variable of this program alone.
    pub fn define(&mut self, name: &str, value: f64) {
        if let Some(own) = self.locals.last_mut() {
            own.insert(name.to_owned(), value);
        }
    }

    pub fn enter(&mut self) {
        self.locals.push(BTreeMap::new());
    }

    pub fn leave(&mut self) {
        if self.locals.len() > 1 {
            self.locals.pop();
        }
    }

    /// Nothing is known of any of them.
    pub fn forget(&mut self) {
        self.lost = true;
        let all = self.locals.iter_mut().chain([&mut self.globals]);
        all.flat_map(BTreeMap::values_mut)
            .for_each(|value| *value = f64::NAN);
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

/// A name in capitals, without blanks.
fn plain(name: &str) -> String {
    name.chars()
        .filter(|c| !c.is_whitespace())
        .map(|c| c.to_ascii_uppercase())
        .collect()
}

/// Reads values in a block, which is in capitals.
pub struct Cursor<'b> {
    pub rest: &'b str,
    depth: usize,
}

/// Deepest nesting of brackets and signs.
const DEEPEST: usize = 40;

/// Operators between two values, tightest last; longer ones first.
const OPERATORS: [&[&str]; 5] = [
    &["OR", "XOR"],
    &["AND"],
    &["==", "<>", ">=", "<=", ">", "<"],
    &["+", "-"],
    &["*", "/", "DIV", "MOD"],
];

impl<'b> Cursor<'b> {
    pub fn new(rest: &'b str) -> Self {
        Cursor { rest, depth: 0 }
    }

    /// Goes past a sign or a word where it is next. A word ends where a name would not go on.
    pub fn eat(&mut self, word: &str) -> bool {
        self.rest = self.rest.trim_start();
        let Some(rest) = self.rest.strip_prefix(word) else {
            return false;
        };
        let is_word = word.as_bytes()[0].is_ascii_alphabetic();
        if is_word && rest.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_') {
            return false;
        }
        self.rest = rest;
        true
    }

    /// A name, without its index.
    pub fn word(&mut self) -> Option<&'b str> {
        self.rest = self.rest.trim_start();
        let length = self
            .rest
            .bytes()
            .take_while(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'$'))
            .count();
        let (word, rest) = self.rest.split_at(length);
        let begins = word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_' || c == '$');
        begins.then(|| self.rest = rest)?;
        Some(word)
    }

    /// The index behind a name, as it belongs to the name: `[2]` of `[R1+1]`, `[X]`. Empty where there is none; none where it is not known.
    pub fn index(&mut self, variables: &mut Variables) -> Option<String> {
        if !self.rest.starts_with('[') {
            return Some(String::new());
        }
        let end = closing(self.rest)?;
        let inner = &self.rest[1..end];
        self.rest = &self.rest[end + 1..];
        let mut parts = Vec::new();
        for part in inner.split(',') {
            let part = part.trim();
            // An axis, or a part of a frame.
            let is_axis = !part.is_empty()
                && part.len() <= 2
                && part.bytes().all(|b| b.is_ascii_alphabetic());
            parts.push(if is_axis {
                part.to_owned()
            } else {
                let value = Cursor {
                    rest: part,
                    depth: self.depth + 1,
                }
                .value(variables)?;
                if value.is_nan() || value.fract() != 0.0 {
                    return None;
                }
                crate::num::decimal(value, 0)
            });
        }
        Some(format!("[{}]", parts.join(",")))
    }

    /// The name of a variable, with its index: `R5`, `R[5]` is R5.
    pub fn variable(&mut self, variables: &mut Variables) -> Option<String> {
        let word = self.word()?;
        let index = self.index(variables)?;
        Some(match (word, index.as_str()) {
            ("R", index) if index.len() > 2 => format!("R{}", &index[1..index.len() - 1]),
            _ => format!("{word}{index}"),
        })
    }

    /// An expression.
    pub fn value(&mut self, variables: &mut Variables) -> Option<f64> {
        self.level(0, variables)
    }

    fn level(&mut self, level: usize, variables: &mut Variables) -> Option<f64> {
        let Some(operators) = OPERATORS.get(level) else {
            return self.operand(variables);
        };
        let mut left = self.level(level + 1, variables)?;
        while let Some(operator) = operators.iter().find(|operator| self.eat(operator)) {
            let right = self.level(level + 1, variables)?;
            left = combined(operator, left, right);
        }
        Some(left)
    }

    fn operand(&mut self, variables: &mut Variables) -> Option<f64> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        self.rest = self.rest.trim_start();
        let value = match self.rest.bytes().next()? {
            b'-' => {
                self.rest = &self.rest[1..];
                -self.operand(variables)?
            }
            b'+' => {
                self.rest = &self.rest[1..];
                self.operand(variables)?
            }
            b'(' => {
                self.rest = &self.rest[1..];
                let inner = self.value(variables)?;
                self.eat(")").then_some(inner)?
            }
            b'0'..=b'9' | b'.' => {
                let (number, length) = read_digits(self.rest.as_bytes())?;
                self.rest = &self.rest[length..];
                number
            }
            _ => self.named(variables)?,
        };
        self.depth -= 1;
        Some(value)
    }

    fn named(&mut self, variables: &mut Variables) -> Option<f64> {
        match () {
            () if self.eat("NOT") => {
                return self.operand(variables).map(|x| truth(x.is_nan(), x == 0.0));
            }
            () if self.eat("TRUE") => return Some(1.0),
            () if self.eat("FALSE") => return Some(0.0),
            () => {}
        }
        let before = self.rest;
        let word = self.word()?;
        if self.rest.trim_start().starts_with('(') {
            let mut arguments = Vec::new();
            self.eat("(");
            while !self.eat(")") {
                arguments.push(self.value(variables)?);
                self.eat(",");
            }
            return Some(function(word, &arguments));
        }
        self.rest = before;
        let name = self.variable(variables)?;
        Some(variables.get(&name))
    }
}

/// Where the bracket closes that a text begins with.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 0;
    for (at, sign) in text.bytes().enumerate() {
        match sign {
            b'[' => depth += 1,
            b']' => {
                depth -= 1;
                if depth == 0 {
                    return Some(at);
                }
            }
            _ => {}
        }
    }
    None
}

fn truth(unknown: bool, holds: bool) -> f64 {
    if unknown {
        f64::NAN
    } else {
        f64::from(u8::from(holds))
    }
}

fn combined(operator: &str, a: f64, b: f64) -> f64 {
    let unknown = a.is_nan() || b.is_nan();
    match operator {
        "+" => a + b,
        "-" => a - b,
        "*" => a * b,
        "/" => a / b,
        "DIV" => (a / b).trunc(),
        "MOD" => a % b,
        "==" => truth(unknown, a == b),
        "<>" => truth(unknown, a != b),
        ">" => truth(unknown, a > b),
        ">=" => truth(unknown, a >= b),
        "<" => truth(unknown, a < b),
        "<=" => truth(unknown, a <= b),
        // One that is known may decide alone.
        "AND" if a == 0.0 || b == 0.0 => 0.0,
        "AND" => truth(unknown, true),
        "OR" if !a.is_nan() && a != 0.0 || !b.is_nan() && b != 0.0 => 1.0,
        "OR" => truth(unknown, false),
        _ => truth(unknown, (a != 0.0) != (b != 0.0)),
    }
}

/// Functions; of any other nothing is known.
fn function(name: &str, arguments: &[f64]) -> f64 {
    let x = arguments.first().copied().unwrap_or(f64::NAN);
    match (name, arguments) {
        ("SIN", [_]) => x.to_radians().sin(),
        ("COS", [_]) => x.to_radians().cos(),
        ("TAN", [_]) => x.to_radians().tan(),
        ("ASIN", [_]) => x.asin().to_degrees(),
        ("ACOS", [_]) => x.acos().to_degrees(),
        ("ATAN2", [y, x]) => y.atan2(*x).to_degrees(),
        ("SQRT", [_]) => x.sqrt(),
        ("ABS", [_]) => x.abs(),
        ("POT", [_]) => x * x,
        ("TRUNC", [_]) => x.trunc(),
        ("ROUND", [_]) => x.round(),
        ("MINVAL", [a, b]) if !a.is_nan() && !b.is_nan() => a.min(*b),
        ("MAXVAL", [a, b]) if !a.is_nan() && !b.is_nan() => a.max(*b),
        _ => f64::NAN,
    }
}
