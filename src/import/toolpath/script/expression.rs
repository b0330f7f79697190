//! Expressions: the value in a line, if everything in it is known.

use crate::import::toolpath::key::{Key, plain};
use crate::import::toolpath::script::grammar::{Function, Language, Operator};
use crate::import::toolpath::script::variables::{Value, Variables};
use crate::num::read_digits;

/// Deepest nesting of brackets and signs.
const DEEPEST: usize = 40;

/// Reads values in a line.
pub struct Cursor<'a> {
    pub line: &'a [u8],
    pub at: usize,
    variables: &'a Variables,
    depth: usize,
    /// Number of operators and of comparisons read outside of brackets.
    operators: usize,
    comparisons: usize,
    /// Whether it is the value of a word, and not part of a macro's own statement.
    word: bool,
}

impl<'a> Cursor<'a> {
    pub fn new(line: &'a [u8], at: usize, variables: &'a Variables) -> Self {
        Cursor {
            line,
            at,
            variables,
            depth: 0,
            operators: 0,
            comparisons: 0,
            word: false,
        }
    }

    pub fn peek(&mut self) -> Option<u8> {
        while matches!(self.line.get(self.at), Some(b' ' | b'\t')) {
            self.at += 1;
        }
        self.line.get(self.at).map(u8::to_ascii_uppercase)
    }

    /// The rest.
    pub fn rest(&self) -> &'a [u8] {
        &self.line[self.at..]
    }

    /// Whether nothing is left.
    pub fn is_done(&mut self) -> bool {
        self.peek().is_none()
    }

    /// Reads a sign or a word if it is next.
    pub fn eat(&mut self, word: &str) -> bool {
        self.peek();
        let end = self.at + word.len();
        let next = self.line.get(self.at..end);
        let is_next = next.is_some_and(|next| next.eq_ignore_ascii_case(word.as_bytes()));
        let goes_on = self.variables.grammar.is_spaced
            && word.as_bytes()[0].is_ascii_alphabetic()
            && self.line.get(end).is_some_and(|b| is_name(*b));
        let is_eaten = is_next && !goes_on;
        self.at += if is_eaten { word.len() } else { 0 };
        is_eaten
    }

    /// An expression.
    pub fn value(&mut self) -> Option<Value> {
        let value = self.level(0)?;
        if !self.variables.grammar.is_indented || !self.eat("?") {
            return Some(value);
        }
        // `a ? b : c`
        self.depth += 1;
        (self.depth <= DEEPEST).then_some(())?;
        let one = self.value()?;
        self.eat(":").then_some(())?;
        let other = self.value()?;
        self.depth -= 1;
        Some(match value.holds() {
            Some(true) => one,
            Some(false) => other,
            None if one == other => one,
            None => Value::Unknown,
        })
    }

    /// A value in a word: a number, a variable, brackets, a function, each with a sign.
    pub fn operand(&mut self) -> Option<Value> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        let heidenhain = self.variables.grammar.language == Language::Heidenhain;
        let value = match self.peek()? {
            b'-' => {
                self.at += 1;
                match self.operand()? {
                    Value::Number(x) => Value::Number(-x),
                    // It is unknown whether a word with it is omitted.
                    _ => Value::Unknown,
                }
            }
            b'+' => {
                self.at += 1;
                self.operand()?
            }
            first if first == self.variables.grammar.brackets.0 => self.bracketed()?,
            b'0'..=b'9' | b'.' => self.digits()?,
            b',' if heidenhain => self.digits()?,
            b'#' | b'@' if self.variables.grammar.language.is_macro() => {
                let key = self.key()?;
                self.variables.get(&key)
            }
            b'{' if self.variables.grammar.is_indented => {
                self.at += 1;
                let value = self.value()?;
                self.eat("}").then_some(value)?
            }
            b'!' if self.variables.grammar.is_indented => {
                self.at += 1;
                not(self.operand()?)
            }
            _ => self.named()?,
        };
        self.depth -= 1;
        Some(value)
    }

    /// A number without a sign; a HEIDENHAIN also writes 0,5.
    fn digits(&mut self) -> Option<Value> {
        const MOST: usize = 40;
        let rest = self.rest();
        let (number, length) = match self.variables.grammar.language {
            Language::Heidenhain => {
                let plain = |b: &u8| if *b == b',' { b'.' } else { *b };
                let digits: Vec<u8> = rest.iter().take(MOST).map(plain).collect();
                read_digits(&digits)?
            }
            _ => read_digits(rest)?,
        };
        self.at += length;
        Some(Value::Number(number))
    }

    /// Whether the next value is computed instead of a plain number.
    pub fn computes(&mut self) -> bool {
        let begin = self.at;
        let mut next = self.peek();
        while matches!(next, Some(b'-' | b'+')) {
            self.at += 1;
            next = self.peek();
        }
        let letters = self.letters();
        let function = letters > 1 && self.line.get(self.at + letters) == Some(&b'[');
        self.at = begin;
        let is_variable = match self.variables.grammar.language {
            Language::Lnc => matches!(next, Some(b'#' | b'[' | b'@')),
            Language::RepRap => next == Some(b'{'),
            _ => matches!(next, Some(b'#' | b'[')),
        };
        is_variable || function
    }

    /// Number of letters that follow; no function name has more than nine.
    fn letters(&self) -> usize {
        let letters = self.rest().iter().take(9);
        letters.take_while(|b| b.is_ascii_alphabetic()).count()
    }

    /// Value of a word.
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
        Some((key, self.value()?))
    }

    /// An expression in brackets.
    pub fn bracketed(&mut self) -> Option<Value> {
        let (open, close) = self.variables.grammar.brackets;
        (self.peek()? == open).then(|| self.at += 1)?;
        let before = (self.operators, self.comparisons);
        let value = self.value()?;
        (self.operators, self.comparisons) = before;
        (self.peek()? == close).then(|| self.at += 1)?;
        Some(value)
    }

    fn level(&mut self, level: usize) -> Option<Value> {
        let grammar = self.variables.grammar;
        let Some(operators) = grammar.operators.get(level) else {
            return self.operand();
        };
        let before = (self.operators, self.comparisons);
        let mut left = self.level(level + 1)?;
        loop {
            // `**` is not a product.
            let power = self.peek() == Some(b'*') && self.line.get(self.at + 1) == Some(&b'*');
            let next = operators.iter().find(|(word, operator)| {
                (!power || *operator == Operator::Power) && self.eat(word)
            });
            let Some((_, operator)) = next else {
                return Some(left);
            };
            let right = self.level(level + 1)?;
            left = self.combined(*operator, left, right);
            // On a Fanuc AND binds like a product: without brackets around its operands it has another effect.
            if level == 0 && grammar.language == Language::MacroB && self.operators > before.0 {
                left = Value::Unknown;
            }
            // A SINUMERIK compares last: without brackets around a comparison AND and OR join other operands.
            let is_logical = matches!(operator, Operator::And | Operator::Or | Operator::Xor);
            if grammar.language == Language::Sinumerik && is_logical && self.comparisons > before.1
            {
                left = Value::Unknown;
            }
            self.operators += 1;
            self.comparisons += usize::from(is_comparison(*operator));
        }
    }

    fn combined(&self, operator: Operator, left: Value, right: Value) -> Value {
        use Operator as Op;
        // An empty value is not 0 when values are compared for equality.
        if (left == Value::Empty || right == Value::Empty)
            && matches!(operator, Op::Equal | Op::Unequal)
        {
            let unknown = left == Value::Unknown || right == Value::Unknown;
            return if unknown {
                Value::Unknown
            } else {
                truth((left == right) == (operator == Op::Equal))
            };
        }
        let [a, b] = [left, right].map(|value| match value {
            Value::Empty => Some(0.0),
            value => value.number(),
        });
        // One known operand may decide the result.
        match operator {
            Op::And if a == Some(0.0) || b == Some(0.0) => return Value::Number(0.0),
            Op::Or if [a, b].iter().flatten().any(|x| self.is_truth(*x)) => {
                return Value::Number(1.0);
            }
            _ => {}
        }
        let (Some(a), Some(b)) = (a, b) else {
            return Value::Unknown;
        };
        match operator {
            Op::Add => Value::of(a + b),
            Op::Subtract => Value::of(a - b),
            Op::Multiply => Value::of(a * b),
            Op::Divide | Op::DivideWhole if b == 0.0 => {
                self.variables.divides_by_zero();
                Value::Unknown
            }
            Op::Divide => Value::of(a / b),
            Op::DivideWhole => Value::of((a / b).trunc()),
            // The sign of the remainder differs between controls.
            Op::Modulo if b > 0.0 && a >= 0.0 => Value::of(a % b),
            Op::Power if b.fract() == 0.0 && (0.0..=16.0).contains(&b) => {
                Value::of(a.powi(b as i32))
            }
            Op::Power if self.variables.grammar.language == Language::Heidenhain => {
                Value::of(a.powf(b))
            }
            Op::Modulo | Op::Power => Value::Unknown,
            Op::Length => Value::of(a.hypot(b)),
            Op::Angle => Value::of(a.atan2(b).to_degrees().rem_euclid(360.0)),
            Op::And | Op::Or | Op::Xor => self.logical(operator, a, b),
            _ => self.compared(operator, a, b),
        }
    }

    /// Whether this operand makes an OR true by itself.
    fn is_truth(&self, x: f64) -> bool {
        x == 1.0 || x != 0.0 && self.variables.grammar.language == Language::Sinumerik
    }

    /// For numbers that are not truth values a macro combines the bits.
    fn logical(&self, operator: Operator, a: f64, b: f64) -> Value {
        let are_truths = [a, b].iter().all(|x| *x == 0.0 || *x == 1.0);
        if !are_truths && self.variables.grammar.language != Language::Sinumerik {
            return Value::Unknown;
        }
        let [a, b] = [a, b].map(|x| x != 0.0);
        truth(match operator {
            Operator::And => a && b,
            Operator::Or => a || b,
            _ => a != b,
        })
    }

    fn compared(&self, operator: Operator, a: f64, b: f64) -> Value {
        use Operator as Op;
        // LinuxCNC treats numbers that differ by less than a ten-thousandth as equal. The tolerance of a Fanuc is unknown here.
        const SAME: f64 = 1e-4;
        let off = (a - b).abs();
        let (is_same, is_decided) = match self.variables.grammar.language {
            Language::LinuxCnc => (
                off < SAME,
                (off - SAME).abs() > 1e-9 || !matches!(operator, Op::Equal | Op::Unequal),
            ),
            Language::MacroB => (off == 0.0, off == 0.0 || off > 2.0 * SAME),
            _ => (off == 0.0, true),
        };
        if !is_decided {
            return Value::Unknown;
        }
        truth(match operator {
            Op::Equal => is_same,
            Op::Unequal => !is_same,
            Op::Greater => a > b,
            Op::GreaterOrEqual => a >= b,
            Op::Less => a < b,
            _ => a <= b,
        })
    }

    /// A function, a constant or a variable by its name.
    fn named(&mut self) -> Option<Value> {
        let grammar = self.variables.grammar;
        if grammar.language == Language::Sinumerik && self.eat("NOT") {
            return Some(not(self.operand()?));
        }
        if grammar.is_indented && self.eat("null") {
            return Some(Value::Empty);
        }
        if let Some((_, value)) = grammar.constants.iter().find(|(name, _)| self.eat(name)) {
            return Some(Value::Number(*value));
        }
        if grammar.is_prefix {
            if self.peek() == Some(b'Q') {
                let key = self.key()?;
                return Some(self.variables.get(&key));
            }
            let (_, function) = grammar.functions.iter().find(|(name, _)| self.eat(name))?;
            let x = self.operand()?;
            return Some(self.computed(*function, &[x]));
        }
        let letters = if grammar.is_spaced {
            self.rest().iter().take_while(|b| is_name(**b)).count()
        } else {
            self.letters()
        };
        let name = &self.rest()[..letters];
        let function = grammar
            .functions
            .iter()
            .find(|(known, _)| name.eq_ignore_ascii_case(known.as_bytes()))
            .map(|(_, function)| *function);
        let before = self.at;
        self.at += letters;
        let is_register = grammar.language == Language::Lnc && function.is_none();
        if is_register || self.peek() != Some(grammar.brackets.0) {
            self.at = before;
            let is_named = !matches!(grammar.language, Language::LinuxCnc | Language::MacroB);
            let key = is_named.then(|| self.named_key())??;
            return Some(self.variables.get(&key));
        }
        match function {
            Some(asks @ (Function::Exists | Function::NotExists)) => {
                self.at += 1;
                let key = self.key()?;
                let exists = self.variables.exists(&key);
                let exists = if asks == Function::Exists {
                    exists
                } else {
                    not(exists)
                };
                (self.peek()? == grammar.brackets.1).then(|| self.at += 1)?;
                Some(exists)
            }
            Some(Function::ArcTangent) => {
                let y = self.bracketed()?;
                if self.eat("/") {
                    let x = self.bracketed()?;
                    return Some(self.computed(Function::ArcTangent2, &[y, x]));
                }
                Some(self.computed(Function::ArcTangent, &[y]))
            }
            _ if grammar.is_spaced => {
                let arguments = self.arguments()?;
                Some(function.map_or(Value::Unknown, |function| {
                    self.computed(function, &arguments)
                }))
            }
            function => {
                let x = self.bracketed()?;
                Some(self.computed(function?, &[x]))
            }
        }
    }

    /// `(1, R2)`: values in brackets, separated by commas.
    pub fn arguments(&mut self) -> Option<Vec<Value>> {
        const MOST: usize = 1000;
        let mut values = Vec::new();
        self.eat("(").then_some(())?;
        while !self.eat(")") {
            (values.len() < MOST).then_some(())?;
            // An omitted argument is 0 on a SINUMERIK.
            if self.eat(",") {
                values.push(Value::Number(0.0));
                continue;
            }
            values.push(self.value()?);
            self.eat(",");
        }
        Some(values)
    }

    /// `[0,54,1,#106]`: values in the brackets of an index.
    pub fn list(&mut self) -> Option<Vec<Value>> {
        const MOST: usize = 20;
        let mut values = Vec::new();
        let close = if self.eat("[") {
            "]"
        } else {
            self.eat("(").then_some(")")?
        };
        loop {
            (values.len() < MOST).then_some(())?;
            values.push(self.value()?);
            if self.eat(close) {
                return Some(values);
            }
            self.eat(",").then_some(())?;
        }
    }

    fn computed(&self, function: Function, arguments: &[Value]) -> Value {
        let language = self.variables.grammar.language;
        let (is_macro_b, is_linuxcnc) =
            (language == Language::MacroB, language == Language::LinuxCnc);
        // An empty value counts as 0.
        let number = |value: &Value| match value {
            Value::Empty => Some(0.0),
            value => value.number(),
        };
        let numbers: Option<Vec<f64>> = arguments.iter().map(number).collect();
        let Some(numbers) = numbers else {
            return Value::Unknown;
        };
        Value::of(match (function, numbers.as_slice()) {
            (Function::Absolute, [x]) => x.abs(),
            (Function::Sine, [x]) => x.to_radians().sin(),
            (Function::Cosine, [x]) => x.to_radians().cos(),
            (Function::Tangent, [x]) => x.to_radians().tan(),
            (Function::ArcSine, [x]) => x.asin().to_degrees(),
            (Function::ArcCosine, [x]) => x.acos().to_degrees(),
            // On a Fanuc a parameter decides whether the other half turn is below 0 or above 180.
            (Function::ArcTangent, [x]) if is_macro_b && *x < 0.0 => f64::NAN,
            (Function::ArcTangent2, [y, _]) if is_macro_b && *y < 0.0 => f64::NAN,
            // LinuxCNC has ATAN only with two values.
            (Function::ArcTangent, _) if is_linuxcnc => f64::NAN,
            (Function::ArcTangent, [x]) => x.atan().to_degrees(),
            (Function::ArcTangent2, [y, x]) => y.atan2(*x).to_degrees(),
            (Function::SquareRoot, [x]) => x.sqrt(),
            (Function::Square, [x]) => x * x,
            (Function::Negative, [x]) => -x,
            (Function::Not, [x]) => f64::from(u8::from(*x == 0.0)),
            (Function::Sign, [0.0]) => 0.0,
            (Function::Sign, [x]) => x.signum(),
            (Function::Truncate, [x]) => x.trunc(),
            (Function::Fraction, [x]) => x.fract(),
            // In a word a Fanuc rounds to the smallest step of its axis.
            (Function::Round, _) if is_macro_b && self.word => f64::NAN,
            (Function::Round, [x]) => x.round(),
            (Function::Fix, [x]) if is_linuxcnc => x.floor(),
            (Function::Fix, [x]) => x.trunc(),
            (Function::Up, [x]) if is_linuxcnc => x.ceil(),
            (Function::Up, [x]) => x.abs().ceil().copysign(*x),
            (Function::Least, [a, b]) => a.min(*b),
            (Function::Greatest, [a, b]) => a.max(*b),
            (Function::Floor, [x]) => x.floor(),
            (Function::Ceiling, [x]) => x.ceil(),
            (Function::Power, [a, b]) => a.powf(*b),
            (Function::Modulo, [a, b]) if *b > 0.0 && *a >= 0.0 => a % b,
            _ => f64::NAN,
        })
    }

    /// A variable: `#5`, `#<name>`, `#[#1+4]`, `##2`; `R5`, `LENGTH[2]`, `$AA_IW[X]`; `Q5`, `QL1`.
    pub fn key(&mut self) -> Option<Key> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        let key = match self.variables.grammar.language {
            Language::Heidenhain => self.parameter(),
            Language::Sinumerik => self.indexed(),
            Language::RepRap => self.named_key(),
            _ => self.numbered(),
        };
        self.depth -= 1;
        key
    }

    /// A variable with a name: `R_SKIP[0,1]` of an LNC, `var.x`, `move.axes[0].userPosition`.
    fn named_key(&mut self) -> Option<Key> {
        if self.variables.grammar.language == Language::Sinumerik {
            return self.key();
        }
        let mut name = String::from_utf8_lossy(self.name()?).into_owned();
        loop {
            match self.line.get(self.at) {
                Some(b'[') => name += &self.index()?,
                // `R_SKIP(0,1)`, as in the manual of an LNC.
                Some(b'(') if self.variables.grammar.language == Language::Lnc => {
                    let whole = |value: &Value| Some(crate::num::decimal(value.number()?, 0));
                    let index: Option<Vec<String>> = self.list()?.iter().map(whole).collect();
                    name += &format!("[{}]", index?.join(","));
                }
                Some(b'.') => {
                    self.at += 1;
                    name.push('.');
                    name += &String::from_utf8_lossy(self.name()?);
                }
                // RepRapFirmware's names are case-sensitive.
                _ if self.variables.grammar.is_indented => return Some(Key::Name(name)),
                _ => return Some(Key::Name(name.to_ascii_lowercase())),
            }
        }
    }

    fn numbered(&mut self) -> Option<Key> {
        let is_global = self.variables.grammar.language == Language::Lnc && self.eat("@");
        (is_global || self.eat("#")).then_some(())?;
        let whole = |value: Value| match value {
            Value::Number(x) if x.fract() == 0.0 && (0.0..1e6).contains(&x) => {
                Key::Number(x as i32)
            }
            _ => Key::Unknown,
        };
        let key = match self.peek()? {
            b'<' => {
                let length = self.rest().iter().position(|b| *b == b'>')?;
                let name = &self.rest()[1..length];
                self.at += length + 1;
                Key::Name(plain(name))
            }
            b'[' => whole(self.bracketed()?),
            b'#' => {
                let inner = self.key()?;
                whole(self.variables.get(&inner))
            }
            _ => {
                let (number, length) = read_digits(self.rest())?;
                self.at += length;
                whole(Value::Number(number))
            }
        };
        Some(match key {
            Key::Number(number) if is_global => Key::Name(format!("@{number}")),
            key => key,
        })
    }

    /// Name of a HEIDENHAIN parameter.
    fn parameter(&mut self) -> Option<Key> {
        (self.peek()? == b'Q').then_some(())?;
        let kind = usize::from(matches!(
            self.line.get(self.at + 1).map(u8::to_ascii_uppercase),
            Some(b'L' | b'R')
        ));
        let digits = self.line[self.at + 1 + kind..].iter();
        let digits = digits.take_while(|b| b.is_ascii_digit()).count();
        (digits > 0).then_some(())?;
        let name = &self.rest()[..1 + kind + digits];
        self.at += name.len();
        Some(Key::capitals(name))
    }

    /// A name without its index.
    pub fn name(&mut self) -> Option<&'a [u8]> {
        let first = self.peek()?;
        let begins = first.is_ascii_alphabetic() || matches!(first, b'_' | b'$');
        begins.then_some(())?;
        let name = &self.rest()[..self.rest().iter().take_while(|b| is_name(**b)).count()];
        self.at += name.len();
        Some(name)
    }

    fn indexed(&mut self) -> Option<Key> {
        let name = self.name()?;
        Some(self.index_of(name))
    }

    /// A SINUMERIK variable by its name, with the index that follows: `R[5]` is R5. The index may be unknown.
    pub fn index_of(&mut self, name: &[u8]) -> Key {
        match self.index() {
            None => Key::Unknown,
            Some(index) if index.is_empty() => Key::capitals(name),
            Some(index) if name.eq_ignore_ascii_case(b"R") && index.len() > 2 => {
                Key::capitals(&[name, &index.as_bytes()[1..index.len() - 1]].concat())
            }
            Some(index) => Key::capitals(&[name, index.as_bytes()].concat()),
        }
    }

    /// The index after a name: `[2]` for `[R1+1]`, `[X]`. Empty if there is no index, `None` if its value is unknown.
    pub fn index(&mut self) -> Option<String> {
        if self.line.get(self.at) != Some(&b'[') {
            return Some(String::new());
        }
        let end = closing(self.rest())?;
        let (line, from) = (self.line, self.at + 1);
        let inner = &line[from..self.at + end];
        self.at += end + 1;
        let mut parts = Vec::new();
        for part in inner.split(|b| *b == b',') {
            let part = part.trim_ascii();
            // An axis, or a part of a frame.
            let is_axis =
                !part.is_empty() && part.len() <= 2 && part.iter().all(u8::is_ascii_alphabetic);
            parts.push(if is_axis {
                String::from_utf8_lossy(part).into_owned()
            } else {
                let mut inner = Cursor::new(part, 0, self.variables);
                inner.depth = self.depth + 1;
                let value = inner.value()?.number()?;
                (value.fract() == 0.0).then_some(())?;
                crate::num::decimal(value, 0)
            });
        }
        Some(format!("[{}]", parts.join(",")))
    }
}

fn is_name(b: u8) -> bool {
    b.is_ascii_alphanumeric() || matches!(b, b'_' | b'$')
}

/// Position of the closing bracket for the one at the start of a text.
fn closing(text: &[u8]) -> Option<usize> {
    const LONGEST: usize = 1000;
    let mut depth = 0;
    text.iter().take(LONGEST).position(|sign| {
        depth += match sign {
            b'[' => 1,
            b']' => -1,
            _ => 0,
        };
        depth == 0
    })
}

fn is_comparison(operator: Operator) -> bool {
    matches!(
        operator,
        Operator::Equal
            | Operator::Unequal
            | Operator::Greater
            | Operator::GreaterOrEqual
            | Operator::Less
            | Operator::LessOrEqual
    )
}

fn not(value: Value) -> Value {
    value.holds().map_or(Value::Unknown, |holds| truth(!holds))
}

fn truth(holds: bool) -> Value {
    Value::Number(f64::from(u8::from(holds)))
}
