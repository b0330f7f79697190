//! Values of a macro: what an expression comes to, where all in it is known. What the control would know, and the program does not set, is not.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use crate::import::toolpath::key::{Key, plain};
use crate::import::toolpath::known::Ask;
use crate::import::toolpath::system::System;
use crate::num::read_digits;

/// What a variable or an expression is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    Number(f64),
    /// It cannot be known here.
    Unknown,
    /// `#0`, or an argument that a call does not give, on a Fanuc: a word with it is left out.
    Empty,
}

impl Value {
    pub fn number(self) -> Option<f64> {
        if let Value::Number(x) = self {
            Some(x)
        } else {
            None
        }
    }
}

/// The variables of one call, or those of all.
#[derive(Debug, Default)]
struct Level {
    set: BTreeMap<Key, Value>,
    /// Something else may have set any of them since.
    lost: bool,
}

/// The variables of a program, as far as it sets them.
#[derive(Debug)]
pub struct Variables {
    /// LinuxCNC's variables and functions, or those of a Fanuc.
    pub linuxcnc: bool,
    /// What the control itself puts into variables.
    pub system: System,
    /// The line that is run.
    pub line: usize,
    globals: Level,
    levels: Vec<Level>,
    /// What the user knows of variables.
    given: BTreeMap<Key, f64>,
    /// Whether the user gives an argument: then those that are not given are none.
    is_given: bool,
    /// What the text has set so far.
    assigned: BTreeSet<Key>,
    /// What was read and is not known, with the lines.
    asked: RefCell<BTreeMap<Key, Vec<u32>>>,
    /// Lines in which a division by zero was asked for.
    divided: RefCell<Vec<u32>>,
}

impl Variables {
    pub fn new(linuxcnc: bool, given: BTreeMap<Key, f64>) -> Self {
        let is_given = given.keys().any(|key| matches!(key, Key::Number(1..=33)));
        Variables {
            is_given,
            linuxcnc,
            system: System::default(),
            line: 0,
            globals: Level::default(),
            levels: vec![Level::default()],
            given,
            assigned: BTreeSet::new(),
            asked: RefCell::default(),
            divided: RefCell::default(),
        }
    }

    /// Lines in which a division by zero was asked for.
    pub fn divisions(&self) -> Vec<u32> {
        self.divided.borrow().clone()
    }

    /// Whether the line that is run divides by zero.
    pub fn has_divided(&self) -> bool {
        self.divided.borrow().last() == Some(&(self.line as u32))
    }

    /// What was read before anything set it.
    pub fn asks(&self) -> Vec<Ask> {
        let asked = self.asked.borrow();
        asked
            .iter()
            .filter_map(|(key, lines)| {
                Some(Ask {
                    name: key.name()?,
                    lines: lines.clone(),
                })
            })
            .collect()
    }

    /// What the user says of a variable.
    pub fn given(&self, key: &Key) -> Option<f64> {
        self.given.get(key).copied()
    }

    /// The arguments that the user gives of a subroutine that nothing calls.
    fn given_arguments(&self) -> Vec<(i32, Value)> {
        let local = |(key, value): (&Key, &f64)| match key {
            Key::Number(n) if self.is_local(key) => Some((*n, Value::Number(*value))),
            _ => None,
        };
        self.given.iter().filter_map(local).collect()
    }

    /// Something is asked of the user: it is read here, and not known.
    fn ask(&self, key: &Key) -> Value {
        const MOST_ASKED: usize = 200;
        const MOST_LINES: usize = 1000;
        let mut asked = self.asked.borrow_mut();
        if asked.len() < MOST_ASKED || asked.contains_key(key) {
            let lines = asked.entry(key.clone()).or_default();
            let line = self.line as u32;
            if lines.len() < MOST_LINES && !lines.contains(&line) {
                lines.push(line);
            }
        }
        Value::Unknown
    }

    /// Into a call with these arguments.
    pub fn enter(&mut self, arguments: Vec<(i32, Value)>) {
        let mut level = Level::default();
        for (number, value) in arguments {
            level.set.insert(Key::Number(number), value);
        }
        self.levels.push(level);
    }

    pub fn leave(&mut self) {
        if self.levels.len() > 1 {
            self.levels.pop();
        }
    }

    /// Local to a call: LinuxCNC's arguments are #1 to #30, those of a Fanuc #1 to #33.
    fn is_local(&self, key: &Key) -> bool {
        match key {
            Key::Number(n) => (1..=if self.linuxcnc { 30 } else { 33 }).contains(n),
            Key::Name(name) => !name.starts_with('_'),
            Key::Unknown => false,
        }
    }

    /// Whether the control changes it by itself.
    fn is_system(&self, key: &Key) -> bool {
        match key {
            Key::Number(n) if self.linuxcnc => *n > 5000,
            Key::Number(n) => (1000..10_000).contains(n) || *n > 10_999,
            Key::Name(_) => false,
            Key::Unknown => true,
        }
    }

    pub fn get(&self, key: &Key) -> Value {
        let known = if *key == Key::Unknown {
            return Value::Unknown;
        } else {
            self.system.get(key, self.linuxcnc)
        };
        if let Some(value) = known {
            let given = || match self.given(key) {
                Some(value) => Value::Number(value),
                // Which tool is in the spindle a user knows; where a touch ended is what `part` says.
                None if System::is_set_up(key) => self.ask(key),
                None => Value::Unknown,
            };
            return value.map_or_else(given, Value::Number);
        }
        let given = || self.given(key).map_or_else(|| self.ask(key), Value::Number);
        if self.is_system(key) {
            return given();
        }
        let level = self
            .levels
            .last()
            .filter(|_| self.is_local(key))
            .unwrap_or(&self.globals);
        if *key == Key::Number(0) && !self.linuxcnc {
            return Value::Empty;
        }
        // In a call, what is not given is 0 on LinuxCNC and nothing on a Fanuc.
        let missing = match key {
            Key::Number(_)
                if !level.lost
                    && self.is_local(key)
                    && (self.levels.len() > 1 || self.is_given) =>
            {
                if self.linuxcnc {
                    Value::Number(0.0)
                } else {
                    Value::Empty
                }
            }
            // What something else may have set, where the text itself does: that is not the user's to say.
            _ if level.lost && self.assigned.contains(key) => Value::Unknown,
            _ => return level.set.get(key).copied().unwrap_or_else(given),
        };
        level
            .set
            .get(key)
            .copied()
            .or_else(|| self.given(key).map(Value::Number))
            .unwrap_or(missing)
    }

    /// Whether a variable was set: 1 or 0, where that is known.
    fn exists(&self, key: &Key) -> Value {
        let local = self.is_local(key);
        let level = self
            .levels
            .last()
            .filter(|_| local)
            .unwrap_or(&self.globals);
        match (key, level.set.get(key)) {
            (Key::Number(_), _) => Value::Number(1.0),
            // Of one without a known value it is not known whether it was set at all.
            (Key::Name(_), Some(Value::Number(_))) => Value::Number(1.0),
            (Key::Name(_), None) if local && !level.lost => Value::Number(0.0),
            _ => Value::Unknown,
        }
    }

    pub fn set(&mut self, key: Key, value: Value) {
        let local = self.is_local(&key);
        let level = self
            .levels
            .last_mut()
            .filter(|_| local)
            .unwrap_or(&mut self.globals);
        if key == Key::Unknown {
            // It may be any of them.
            return self.forget();
        }
        self.assigned.insert(key.clone());
        level.set.insert(key, value);
    }

    /// Into a subroutine that nothing calls, with the arguments that the user gives: where there is one, others are not given.
    pub fn enter_uncalled(&mut self) {
        let arguments = self.given_arguments();
        self.forget();
        if let Some(level) = self.levels.last_mut() {
            level.lost = arguments.is_empty();
            level.set.extend(
                arguments
                    .into_iter()
                    .map(|(number, value)| (Key::Number(number), value)),
            );
        }
    }

    /// Nothing is known of the variables that calls share: something else was called, which has its own locals.
    pub fn forget_shared(&mut self) {
        self.globals = Level {
            set: BTreeMap::new(),
            lost: true,
        };
    }

    /// Nothing is known of any variable.
    pub fn forget(&mut self) {
        for level in self.levels.iter_mut().chain([&mut self.globals]) {
            *level = Level {
                set: BTreeMap::new(),
                lost: true,
            };
        }
    }
}

/// Deepest nesting of brackets.
const DEEPEST: usize = 40;

/// Reads values in a line.
pub struct Cursor<'a> {
    pub line: &'a [u8],
    pub at: usize,
    variables: &'a Variables,
    depth: usize,
    /// How many operators were read outside of brackets.
    operators: usize,
    /// Whether it is the value of a word, and no part of a macro's own statement.
    word: bool,
}

/// Operators between two values, tightest last.
const OPERATORS: [&[&str]; 5] = [
    &["AND", "XOR", "OR"],
    &["EQ", "NE", "GE", "GT", "LE", "LT"],
    &["+", "-"],
    &["*", "/", "MOD"],
    &["**"],
];

impl<'a> Cursor<'a> {
    pub fn new(line: &'a [u8], at: usize, variables: &'a Variables) -> Self {
        Cursor {
            line,
            at,
            variables,
            depth: 0,
            operators: 0,
            word: false,
        }
    }

    pub fn peek(&mut self) -> Option<u8> {
        while matches!(self.line.get(self.at), Some(b' ' | b'\t')) {
            self.at += 1;
        }
        self.line.get(self.at).map(u8::to_ascii_uppercase)
    }

    /// Goes past a sign or a word where it is next.
    pub fn eat(&mut self, word: &str) -> bool {
        self.peek();
        let next = self.line.get(self.at..self.at + word.len());
        let eaten = next.is_some_and(|next| next.eq_ignore_ascii_case(word.as_bytes()));
        self.at += if eaten { word.len() } else { 0 };
        eaten
    }

    /// A value as a word has it: a number, a variable, brackets, a function, each with a sign.
    pub fn operand(&mut self) -> Option<Value> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        let value = match self.peek()? {
            b'-' => {
                self.at += 1;
                match self.operand()? {
                    Value::Number(x) => Value::Number(-x),
                    // Whether a word with it is left out is not known.
                    _ => Value::Unknown,
                }
            }
            b'+' => {
                self.at += 1;
                self.operand()?
            }
            b'#' => {
                let key = self.key()?;
                self.variables.get(&key)
            }
            b'[' => self.bracketed()?,
            b'0'..=b'9' | b'.' => {
                let (number, length) = read_digits(&self.line[self.at..])?;
                self.at += length;
                Value::Number(number)
            }
            _ => self.function()?,
        };
        self.depth -= 1;
        Some(value)
    }

    /// Whether what comes next is computed, and no plain number.
    pub fn computes(&mut self) -> bool {
        let begin = self.at;
        let mut next = self.peek();
        while matches!(next, Some(b'-' | b'+')) {
            self.at += 1;
            next = self.peek();
        }
        let letters = self.line[self.at..]
            .iter()
            .take(7)
            .take_while(|b| b.is_ascii_alphabetic())
            .count();
        let function = letters > 1 && self.line.get(self.at + letters) == Some(&b'[');
        self.at = begin;
        matches!(next, Some(b'#' | b'[')) || function
    }

    /// The value of a word.
    pub fn in_word(&mut self) -> Option<Value> {
        self.word = true;
        let value = self.operand();
        self.word = false;
        value
    }

    /// `#5=…`: the variable and its value.
    pub fn assignment(&mut self) -> Option<(Key, Value)> {
        let key = self.key()?;
        self.eat("=").then_some(())?;
        Some((key, self.level(0)?))
    }

    pub fn bracketed(&mut self) -> Option<Value> {
        self.eat("[").then_some(())?;
        let before = self.operators;
        let value = self.level(0)?;
        self.operators = before;
        self.eat("]").then_some(value)
    }

    fn level(&mut self, level: usize) -> Option<Value> {
        let Some(operators) = OPERATORS.get(level) else {
            return self.operand();
        };
        let before = self.operators;
        let mut left = self.level(level + 1)?;
        loop {
            // `**` is no product.
            let product = level == 3
                && self.peek() == Some(b'*')
                && self.line.get(self.at + 1) == Some(&b'*');
            let Some(operator) = operators
                .iter()
                .find(|operator| !product && self.eat(operator))
            else {
                return Some(left);
            };
            let right = self.level(level + 1)?;
            left = self.combined(operator, left, right);
            // On a Fanuc AND binds as a product: without brackets around what it joins it does something else.
            if level == 0 && !self.variables.linuxcnc && self.operators > before {
                left = Value::Unknown;
            }
            self.operators += 1;
        }
    }

    fn combined(&self, operator: &str, left: Value, right: Value) -> Value {
        let truth = |holds: bool| Value::Number(f64::from(u8::from(holds)));
        // Nothing is not 0 where it is asked whether they are the same.
        if (left == Value::Empty || right == Value::Empty) && matches!(operator, "EQ" | "NE") {
            let unknown = left == Value::Unknown || right == Value::Unknown;
            return if unknown {
                Value::Unknown
            } else {
                truth((left == right) == (operator == "EQ"))
            };
        }
        let plain = |value: Value| {
            if value == Value::Empty {
                Some(0.0)
            } else {
                value.number()
            }
        };
        let (Some(a), Some(b)) = (plain(left), plain(right)) else {
            return Value::Unknown;
        };
        let both = |known: bool, holds: bool| if known { truth(holds) } else { Value::Unknown };
        let logical = [a, b].iter().all(|x| *x == 0.0 || *x == 1.0);
        // LinuxCNC takes numbers for equal that differ by less than a ten-thousandth, and compares others as they are. How near numbers may be on a
        // Fanuc is not known here.
        const SAME: f64 = 1e-4;
        let off = (a - b).abs();
        let (same, decided) = match self.variables.linuxcnc {
            true => (
                off < SAME,
                (off - SAME).abs() > 1e-9 || matches!(operator, "GT" | "GE" | "LT" | "LE"),
            ),
            false => (off == 0.0, off == 0.0 || off > 2.0 * SAME),
        };
        match operator {
            "+" => finite(a + b),
            "-" => finite(a - b),
            "*" => finite(a * b),
            "/" if b == 0.0 => {
                const MOST: usize = 1000;
                let mut divided = self.variables.divided.borrow_mut();
                let line = self.variables.line as u32;
                if divided.len() < MOST && divided.last() != Some(&line) {
                    divided.push(line);
                }
                Value::Unknown
            }
            "/" => finite(a / b),
            "MOD" if b > 0.0 && a >= 0.0 => finite(a % b),
            "**" if b.fract() == 0.0 && (0.0..=16.0).contains(&b) => finite(a.powi(b as i32)),
            "EQ" => both(decided, same),
            "NE" => both(decided, !same),
            "GT" => both(decided, a > b),
            "GE" => both(decided, a >= b),
            "LT" => both(decided, a < b),
            "LE" => both(decided, a <= b),
            "AND" => both(logical, a * b == 1.0),
            "OR" => both(logical, a + b > 0.0),
            "XOR" => both(logical, a != b),
            _ => Value::Unknown,
        }
    }

    /// `ABS[…]`, `ATAN[y]/[x]`, `EXISTS[#<name>]`.
    fn function(&mut self) -> Option<Value> {
        let letters = self.line[self.at..]
            .iter()
            .take(7)
            .take_while(|b| b.is_ascii_alphabetic())
            .count();
        let name = self.line[self.at..self.at + letters].to_ascii_uppercase();
        self.at += letters;
        if name == b"EXISTS" {
            self.eat("[").then_some(())?;
            let key = self.key()?;
            let exists = self.variables.exists(&key);
            return self.eat("]").then_some(exists);
        }
        let inner = self.bracketed()?;
        let linuxcnc = self.variables.linuxcnc;
        let value = match name.as_slice() {
            b"ABS" => map(inner, f64::abs),
            b"SIN" => map(inner, |x| x.to_radians().sin()),
            b"COS" => map(inner, |x| x.to_radians().cos()),
            b"TAN" => map(inner, |x| x.to_radians().tan()),
            b"ASIN" => map(inner, |x| x.asin().to_degrees()),
            b"ACOS" => map(inner, |x| x.acos().to_degrees()),
            b"SQRT" | b"SQR" => map(inner, f64::sqrt),
            // What no probing macro was seen to need costs nothing here.
            b"EXP" | b"LN" => Value::Unknown,
            // In a word a Fanuc rounds to the smallest step of its axis.
            b"ROUND" | b"RND" if self.word && !linuxcnc => Value::Unknown,
            b"ROUND" | b"RND" => map(inner, f64::round),
            // LinuxCNC goes to the next lower and higher whole number, a Fanuc towards 0 and away from it.
            b"FIX" => map(inner, |x| if linuxcnc { x.floor() } else { x.trunc() }),
            b"FUP" => map(inner, |x| {
                if linuxcnc {
                    x.ceil()
                } else {
                    x.abs().ceil().copysign(x)
                }
            }),
            b"ATAN" if self.eat("/") => {
                let x = self.bracketed()?;
                match (inner, x) {
                    // On a Fanuc a parameter says whether the other half turn is below 0 or above 180.
                    (Value::Number(y), Value::Number(x)) if linuxcnc || y >= 0.0 => {
                        Value::Number(y.atan2(x).to_degrees())
                    }
                    _ => Value::Unknown,
                }
            }
            // Of one value, the slope: below 0 it differs from control to control likewise.
            b"ATAN" if !linuxcnc => match inner {
                Value::Number(slope) if slope >= 0.0 => Value::Number(slope.atan().to_degrees()),
                _ => Value::Unknown,
            },
            _ => return None,
        };
        Some(value)
    }

    /// A variable: `#5`, `#<name>`, `#[#1+4]`, `##2`.
    pub fn key(&mut self) -> Option<Key> {
        self.eat("#").then_some(())?;
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        let whole = |value: Value| match value {
            Value::Number(x) if x.fract() == 0.0 && (0.0..1e6).contains(&x) => {
                Key::Number(x as i32)
            }
            _ => Key::Unknown,
        };
        let key = match self.peek()? {
            b'<' => {
                let length = self.line[self.at..].iter().position(|b| *b == b'>')?;
                let name = &self.line[self.at + 1..self.at + length];
                self.at += length + 1;
                Key::Name(plain(name))
            }
            b'[' => whole(self.bracketed()?),
            b'#' => {
                let inner = self.key()?;
                whole(self.variables.get(&inner))
            }
            _ => {
                let (number, length) = read_digits(&self.line[self.at..])?;
                self.at += length;
                whole(Value::Number(number))
            }
        };
        self.depth -= 1;
        Some(key)
    }
}

fn finite(x: f64) -> Value {
    if x.is_finite() {
        Value::Number(x)
    } else {
        Value::Unknown
    }
}

/// A function of what is known; nothing counts as 0.
fn map(value: Value, of: impl Fn(f64) -> f64) -> Value {
    match value {
        Value::Number(x) => finite(of(x)),
        Value::Empty => finite(of(0.0)),
        Value::Unknown => Value::Unknown,
    }
}
