//! Variables of a running program: set by the program, the control or the user; and the values that are asked for.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use crate::import::toolpath::key::Key;
use crate::import::toolpath::known::UnsetVariable;
use crate::import::toolpath::script::grammar::{Grammar, Language};
use crate::import::toolpath::system::System;

/// Value of a variable or an expression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    Number(f64),
    /// Unknown here.
    Unknown,
    /// `#0`, or an argument that a call does not give, on a Fanuc: a word with it is omitted.
    Empty,
}

impl Value {
    /// A number; not finite is unknown.
    pub fn of(x: f64) -> Value {
        if x.is_finite() {
            Value::Number(x)
        } else {
            Value::Unknown
        }
    }

    pub fn number(self) -> Option<f64> {
        if let Value::Number(x) = self {
            Some(x)
        } else {
            None
        }
    }

    /// The number; NaN if it is unknown or empty.
    pub fn or_nan(self) -> f64 {
        self.number().unwrap_or(f64::NAN)
    }

    /// Whether a condition holds, if that is known.
    pub fn holds(self) -> Option<bool> {
        self.number().map(|truth| truth != 0.0)
    }
}

/// Variables of one call, or the shared ones.
#[derive(Debug, Default)]
struct Level {
    set: BTreeMap<Key, Value>,
    /// Whether something else may have set any of them since.
    lost: bool,
    /// Whether a value was set since then.
    is_set: bool,
}

impl Level {
    fn insert(&mut self, key: Key, value: Value) {
        self.is_set |= value != Value::Unknown;
        self.set.insert(key, value);
    }

    fn forget(&mut self) {
        self.lost = true;
        if !std::mem::take(&mut self.is_set) {
            return;
        }
        self.set
            .values_mut()
            .for_each(|value| *value = Value::Unknown);
    }
}

/// Variables that a program sets.
#[derive(Debug)]
pub struct Variables {
    pub grammar: &'static Grammar,
    /// Values that the control sets.
    pub system: System,
    /// The current line.
    pub line: usize,
    globals: Level,
    levels: Vec<Level>,
    /// The user's values of variables.
    given: BTreeMap<Key, f64>,
    /// Whether the user gives an argument: then missing ones are empty.
    is_given: bool,
    /// Variables that the text has set so far.
    assigned: BTreeSet<Key>,
    /// Unknown variables that were read, with the lines.
    asked: RefCell<BTreeMap<Key, Vec<u32>>>,
    /// Lines with a division by zero.
    divided: RefCell<Vec<u32>>,
}

impl Variables {
    /// `set` has the user's values, by the names in a text.
    pub fn new(grammar: &'static Grammar, set: &[(&str, f64)]) -> Self {
        let given: BTreeMap<Key, f64> = set
            .iter()
            .filter_map(|(name, value)| Some((Key::of(name, grammar.language)?, *value)))
            .collect();
        Variables {
            is_given: given.keys().any(|key| matches!(key, Key::Number(1..=33))),
            grammar,
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

    pub fn is_linuxcnc(&self) -> bool {
        self.grammar.language == Language::LinuxCnc
    }

    /// Lines with a division by zero.
    pub fn divisions(&self) -> Vec<u32> {
        self.divided.borrow().clone()
    }

    /// Whether the current line divides by zero.
    pub fn has_divided(&self) -> bool {
        self.divided.borrow().last() == Some(&(self.line as u32))
    }

    /// Records that the current line divides by zero.
    pub fn divides_by_zero(&self) {
        const MOST: usize = 1000;
        let mut divided = self.divided.borrow_mut();
        let line = self.line as u32;
        if divided.len() < MOST && divided.last() != Some(&line) {
            divided.push(line);
        }
    }

    /// Variables that were read before anything set them.
    pub fn asks(&self) -> Vec<UnsetVariable> {
        let asked = self.asked.borrow();
        asked
            .iter()
            .filter_map(|(key, lines)| {
                Some(UnsetVariable {
                    name: key.name(self.grammar.language)?,
                    lines: lines.clone(),
                })
            })
            .collect()
    }

    /// The user's arguments for a subroutine that nothing calls.
    fn given_arguments(&self) -> Vec<(Key, Value)> {
        let local = |(key, value): (&Key, &f64)| match key {
            Key::Number(_) if self.is_local(key) => Some((key.clone(), Value::Number(*value))),
            _ => None,
        };
        self.given.iter().filter_map(local).collect()
    }

    /// The user's value of a variable; without one the user is asked for it.
    fn given_or_asked(&self, key: &Key) -> Value {
        const MOST_ASKED: usize = 200;
        const MOST_LINES: usize = 1000;
        if let Some(value) = self.given.get(key) {
            return Value::Number(*value);
        }
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

    /// Enters a call with these arguments.
    pub fn enter(&mut self, arguments: Vec<(Key, Value)>) {
        self.levels.push(Level {
            set: arguments.into_iter().collect(),
            lost: false,
            is_set: true,
        });
    }

    pub fn leave(&mut self) {
        if self.levels.len() > 1 {
            self.levels.pop();
        }
    }

    /// Whether a variable is local to a call: #1 to #30 on LinuxCNC, #1 to #33 on a Fanuc, those that it defines on a SINUMERIK.
    fn is_local(&self, key: &Key) -> bool {
        match (self.grammar.language, key) {
            (_, Key::Unknown) | (Language::Heidenhain, _) => false,
            (Language::Sinumerik, _) => self
                .levels
                .last()
                .is_some_and(|level| level.set.contains_key(key)),
            (Language::LinuxCnc, Key::Number(n)) => (1..=30).contains(n),
            (Language::MacroB | Language::Lnc, Key::Number(n)) => (1..=33).contains(n),
            (Language::Eding, Key::Number(_)) | (Language::RepRap, Key::Number(_)) => false,
            (Language::RepRap, Key::Name(name)) => {
                name.starts_with("var.") || name.starts_with("param.")
            }
            (Language::Lnc | Language::Eding, Key::Name(_)) => false,
            (_, Key::Name(name)) => !name.starts_with('_'),
        }
    }

    /// Whether the control changes it without a block.
    fn is_system(&self, key: &Key) -> bool {
        match (self.grammar.language, key) {
            (_, Key::Unknown) => true,
            (Language::LinuxCnc | Language::Eding, Key::Number(n)) => *n > 5000,
            (Language::Lnc, Key::Number(_)) => false,
            (_, Key::Number(n)) => (1000..10_000).contains(n) || *n > 10_999,
            (_, Key::Name(_)) => false,
        }
    }

    fn level_of(&self, key: &Key) -> &Level {
        self.levels
            .last()
            .filter(|_| self.is_local(key))
            .unwrap_or(&self.globals)
    }

    pub fn get(&self, key: &Key) -> Value {
        if *key == Key::Unknown {
            return Value::Unknown;
        }
        let contact = self.grammar.contact;
        let own = match key {
            Key::Number(number) if (contact..contact + 3).contains(number) => {
                &Key::Number(number - contact + 5061)
            }
            key => key,
        };
        if let Some(value) = self.system.get(own, self.grammar.language) {
            return match value {
                Some(value) => Value::Number(value),
                // The user knows which tool is in the spindle; `part` gives the end of a touch.
                None if System::is_set_up(key) => self.given_or_asked(key),
                None => self
                    .given
                    .get(key)
                    .map_or(Value::Unknown, |value| Value::Number(*value)),
            };
        }
        if self.is_system(key) {
            return self.given_or_asked(key);
        }
        if *key == Key::Number(0)
            && matches!(self.grammar.language, Language::MacroB | Language::Lnc)
        {
            return Value::Empty;
        }
        let level = self.level_of(key);
        if let Some(value) = level.set.get(key) {
            return *value;
        }
        // An argument that a call of RepRapFirmware does not give does not exist.
        if is_param(key) && self.levels.len() > 1 {
            return Value::Unknown;
        }
        let is_argument = matches!(key, Key::Number(_)) && self.is_local(key);
        match self.given.get(key) {
            Some(value) => Value::Number(*value),
            // In a call a missing argument is 0 on LinuxCNC and empty on a Fanuc.
            None if is_argument && !level.lost && (self.levels.len() > 1 || self.is_given) => {
                if self.is_linuxcnc() {
                    Value::Number(0.0)
                } else {
                    Value::Empty
                }
            }
            // Something else may have set a variable that the text sets itself: the user is not asked for it.
            None if level.lost && self.assigned.contains(key) => Value::Unknown,
            None => self.given_or_asked(key),
        }
    }

    /// Whether a variable was set: 1 or 0, if that is known.
    pub fn exists(&self, key: &Key) -> Value {
        let level = self.level_of(key);
        if self.grammar.is_indented {
            return self.is_given(key);
        }
        match (key, level.set.get(key)) {
            (Key::Number(_), _) => Value::Number(1.0),
            // For a variable without a known value it is unknown whether it was set.
            (Key::Name(_), Some(Value::Number(_))) => Value::Number(1.0),
            (Key::Name(_), None) if self.is_local(key) && !level.lost => Value::Number(0.0),
            _ => Value::Unknown,
        }
    }

    /// Whether RepRapFirmware knows a name: one that the text sets, or an argument. If one argument is given, the missing ones do not exist.
    fn is_given(&self, key: &Key) -> Value {
        if self.level_of(key).set.contains_key(key) {
            return Value::Number(1.0);
        }
        let is_called = self.levels.len() > 1;
        if is_param(key) && (is_called || self.given.keys().any(is_param)) {
            let is_given = !is_called && self.given.contains_key(key);
            return Value::Number(f64::from(u8::from(is_given)));
        }
        match self.given.get(key) {
            Some(_) => Value::Number(1.0),
            None => self.given_or_asked(key),
        }
    }

    /// Sets a variable; if it is unknown which one, any of them may have changed.
    pub fn set(&mut self, key: Key, value: Value) {
        if key == Key::Unknown {
            return self.forget();
        }
        let is_local = self.is_local(&key);
        self.assigned.insert(key.clone());
        let level = self
            .levels
            .last_mut()
            .filter(|_| is_local)
            .unwrap_or(&mut self.globals);
        level.insert(key, value);
    }

    /// Defines a variable of this call.
    pub fn define(&mut self, key: Key, value: Value) {
        self.assigned.insert(key.clone());
        if let Some(level) = self.levels.last_mut() {
            level.insert(key, value);
        }
    }

    /// The elements of a list are unknown.
    pub fn forget_elements(&mut self, name: &str) {
        let is_element = |key: &Key| {
            matches!(key, Key::Name(own) if own
                .strip_prefix(name)
                .is_some_and(|rest| rest.starts_with('[')))
        };
        let levels = self.levels.last_mut().into_iter();
        levels
            .chain([&mut self.globals])
            .flat_map(|level| level.set.iter_mut())
            .filter(|(key, _)| is_element(key))
            .for_each(|(_, value)| *value = Value::Unknown);
    }

    /// The control has set it; the user may know the value.
    pub fn set_by_control(&mut self, key: Key) {
        let value = self.given_or_asked(&key);
        self.set(key, value);
    }

    /// Enters a subroutine that nothing calls, with the user's arguments: if there is one, missing ones are not given.
    pub fn enter_uncalled(&mut self) {
        let arguments = self.given_arguments();
        self.forget();
        if let Some(level) = self.levels.last_mut() {
            level.lost = arguments.is_empty();
            level.is_set = true;
            level.set.extend(arguments);
        }
    }

    /// Forgets the variables that calls share: something else was called, and its locals are separate.
    pub fn forget_shared(&mut self) {
        self.globals.forget();
    }

    /// Forgets the shared variables from a number on: a macro was called that uses none below it.
    pub fn forget_from(&mut self, first: i32) {
        let below = |key: &Key| matches!(key, Key::Number(n) if *n < first);
        let kept: Vec<(Key, Value)> = self
            .globals
            .set
            .iter()
            .filter(|(key, _)| below(key))
            .map(|(key, value)| (key.clone(), *value))
            .collect();
        self.globals.forget();
        kept.into_iter()
            .for_each(|(key, value)| self.globals.insert(key, value));
    }

    /// Forgets all variables.
    pub fn forget(&mut self) {
        self.levels.iter_mut().for_each(Level::forget);
        self.globals.forget();
    }
}

/// Whether a variable is an argument of RepRapFirmware.
fn is_param(key: &Key) -> bool {
    matches!(key, Key::Name(name) if name.starts_with("param."))
}
