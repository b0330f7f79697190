//! Notation of values and codes in a dialect, as data, and the parser of values that the readers share.

use crate::control::iso::codes::Family;
use crate::control::iso::script::{BLANKS, Binary, Node, NodeId, Script, System, Unary};
use crate::form::printable;
use crate::text::{Text, text};

/// Deepest nesting of brackets and signs.
const DEEPEST: usize = 40;

/// Largest number of operators in a value: each makes the tree deeper by one.
const LONGEST: usize = 400;

/// Notation of values and codes in a dialect, as data.
#[derive(Debug)]
pub struct Grammar {
    /// Grouping brackets.
    pub brackets: (u8, u8),
    /// Whether positions and feeds must have a decimal point: without one they count in the smallest step of the control.
    pub points: bool,
    pub names: Names,
    /// Binary operators other than + - * /: word, binding strength (0 is weakest) and function.
    pub operators: &'static [(&'static str, u8, Binary)],
    /// System variable with a name, if it is not a variable of the program.
    pub system: fn(&[u8]) -> Option<System>,
    pub family: Family,
    /// Codes that this reader accepts, by letter and ten times the number, and the letters allowed beside each.
    pub takes: fn(u8, i32) -> Option<&'static str>,
}

/// Notation of variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Names {
    /// `#5061`, `#<center_x>`.
    Hash,
    /// `R12`, `TP_MOVE`, `$AA_MW[X]`.
    Words,
}

/// Binding strength of * and /, the strongest.
const TIGHTEST: u8 = 3;

/// Binding strength of comparisons.
const COMPARES: u8 = 1;

/// Operators as words, with brackets `[ ]`; AND and OR bind weakest.
pub const WORD_OPERATORS: &[(&str, u8, Binary)] = &[
    ("OR", 0, Binary::Or),
    ("AND", 0, Binary::And),
    ("EQ", COMPARES, Binary::Equal),
    ("NE", COMPARES, Binary::Unequal),
    ("LT", COMPARES, Binary::Less),
    ("LE", COMPARES, Binary::AtMost),
    ("GT", COMPARES, Binary::Greater),
    ("GE", COMPARES, Binary::AtLeast),
];

/// Operators as words; AND binds like a product and OR like a sum: beside a comparison without brackets they combine the bits of its numbers.
pub const TIGHT_WORD_OPERATORS: &[(&str, u8, Binary)] = &[
    ("OR", TIGHTEST - 1, Binary::Or),
    ("AND", TIGHTEST, Binary::And),
    ("EQ", COMPARES, Binary::Equal),
    ("NE", COMPARES, Binary::Unequal),
    ("LT", COMPARES, Binary::Less),
    ("LE", COMPARES, Binary::AtMost),
    ("GT", COMPARES, Binary::Greater),
    ("GE", COMPARES, Binary::AtLeast),
];

/// Operators as signs, with brackets `( )`. Comparisons bind weakest.
pub const SIGN_OPERATORS: &[(&str, u8, Binary)] = &[
    ("OR", TIGHTEST - 1, Binary::Or),
    ("AND", TIGHTEST, Binary::And),
    ("==", COMPARES, Binary::Equal),
    ("<>", COMPARES, Binary::Unequal),
    (">=", COMPARES, Binary::AtLeast),
    ("<=", COMPARES, Binary::AtMost),
    (">", COMPARES, Binary::Greater),
];

/// A position in a line.
#[derive(Debug)]
pub struct Cursor<'t> {
    /// The line in UTF-8. The rest always begins at a character boundary.
    text: &'t [u8],
    rest: &'t [u8],
    depth: usize,
    operators: usize,
}

/// A fault without its line. Boxed: there is almost never one, and a small result is returned in a register.
pub type Parsed<T> = Result<T, Box<Text>>;

/// Returns a fault.
#[cold]
pub fn fault<T>(text: Text) -> Parsed<T> {
    Err(Box::new(text))
}

impl<'t> Cursor<'t> {
    /// Leading blanks are skipped.
    pub fn new(text: &'t str) -> Self {
        let text = text.trim_start_matches(BLANKS).as_bytes();
        Cursor {
            text,
            rest: text,
            depth: 0,
            operators: 0,
        }
    }

    pub fn is_done(&self) -> bool {
        self.rest.is_empty()
    }

    /// Number of bytes that were read.
    pub fn at(&self) -> usize {
        self.text.len() - self.rest.len()
    }

    /// The bytes that were read since a position.
    pub(super) fn since(&self, at: usize) -> &'t [u8] {
        &self.text[at..self.at()]
    }

    /// The text that was read since a position, without trailing blanks, for a message.
    pub(super) fn word_since(&self, at: usize) -> String {
        let word = String::from_utf8_lossy(self.since(at));
        printable(
            &word
                .trim_end_matches(BLANKS)
                .chars()
                .take(40)
                .collect::<String>(),
        )
    }

    /// The start of the rest, for a message.
    pub fn left(&self) -> String {
        self.from(self.at())
    }

    /// The start of the text at a position, for a message.
    pub(super) fn from(&self, at: usize) -> String {
        printable(
            &String::from_utf8_lossy(&self.text[at..])
                .chars()
                .take(40)
                .collect::<String>(),
        )
    }

    /// The next byte, without reading it.
    pub fn next(&self) -> Option<u8> {
        self.rest.first().copied()
    }

    /// Number of leading bytes of the rest that fulfil a condition.
    fn count(&self, such: impl Fn(u8) -> bool) -> usize {
        self.rest
            .iter()
            .position(|b| !such(*b))
            .unwrap_or(self.rest.len())
    }

    /// Reads these bytes, the last of which is ASCII, so that the rest begins at a character boundary, and the blanks after them. Usually there are no blanks.
    #[inline]
    pub(super) fn advance(&mut self, bytes: usize) {
        self.rest = &self.rest[bytes..];
        if self.rest.first().is_some_and(|b| !b.is_ascii_graphic()) {
            self.trim();
        }
    }

    /// Reads these bytes and returns them.
    #[inline]
    fn take(&mut self, bytes: usize) -> &'t [u8] {
        let taken = &self.rest[..bytes];
        self.advance(bytes);
        taken
    }

    #[inline(never)]
    fn trim(&mut self) {
        self.rest = &self.rest[self.count(|b| matches!(b, b' ' | b'\t'))..];
    }

    /// Reads a word or sign if it is next.
    pub fn eat(&mut self, word: &str) -> bool {
        let next = self
            .rest
            .get(..word.len())
            .is_some_and(|next| next.eq_ignore_ascii_case(word.as_bytes()));
        if next {
            self.advance(word.len());
        }
        next
    }

    /// Reads a name if it is next as a whole.
    pub fn eat_name(&mut self, word: &str) -> bool {
        let more = self
            .rest
            .get(word.len())
            .is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_');
        !more && self.eat(word)
    }

    /// Reads a sign that must be next.
    pub fn expect(&mut self, sign: &str) -> Parsed<()> {
        if self.eat(sign) {
            Ok(())
        } else {
            fault(text!(
                "{sign} is missing before \"{left}\"",
                sign.to_owned(),
                self.left()
            ))
        }
    }

    /// Fault if text is left over.
    pub fn end(&self) -> Parsed<()> {
        if self.is_done() {
            Ok(())
        } else {
            fault(text!("\"{left}\" is left over", self.left()))
        }
    }

    /// A name: letters, digits and underscores.
    pub fn name(&mut self) -> Option<&'t [u8]> {
        let named = self
            .next()
            .is_some_and(|b| b.is_ascii_alphabetic() || b == b'_');
        named.then(|| self.take(self.count(|b| b.is_ascii_alphanumeric() || b == b'_')))
    }

    /// Reads a text in quotes if one is next.
    pub fn text(&mut self) -> bool {
        let end = self
            .rest
            .strip_prefix(b"\"")
            .and_then(|inside| memchr::memchr(b'"', inside));
        if let Some(end) = end {
            self.advance(end + 2);
        }
        end.is_some()
    }

    /// Name of an O word: `<tp_exit>`, `12`.
    pub fn label(&mut self) -> Option<&'t [u8]> {
        let end = match self.next()? {
            b'<' => self.rest.iter().position(|b| *b == b'>')? + 1,
            _ => self.count(|b| b.is_ascii_digit()),
        };
        (end > 0).then(|| self.take(end))
    }

    /// A number without a sign.
    pub fn number(&mut self) -> Parsed<f64> {
        match crate::num::read_digits(self.rest) {
            Some((number, end)) if self.rest.get(end) != Some(&b'.') => {
                self.advance(end);
                Ok(number)
            }
            _ => fault(text!("a number is missing before \"{left}\"", self.left())),
        }
    }

    /// A variable with its sign and brackets: `#5061`, `#<center_x>`, `R12`, `$AA_MW[X]`.
    pub fn variable(&mut self, names: Names) -> Option<&'t [u8]> {
        let bytes = self.rest;
        let to = |close: u8| bytes.iter().position(|b| *b == close).map(|at| at + 1);
        let end = match (names, bytes) {
            (Names::Hash, [b'#', b'<', ..]) => to(b'>')?,
            (Names::Hash, [b'#', b'[', ..]) => to(b']')?,
            (Names::Hash, [b'#', rest @ ..]) => {
                rest.iter()
                    .position(|b| !b.is_ascii_digit())
                    .unwrap_or(rest.len())
                    + 1
            }
            (Names::Words, [b'$', rest @ ..]) => {
                let end = rest
                    .iter()
                    .position(|b| !(b.is_ascii_alphanumeric() || *b == b'_'))
                    .unwrap_or(rest.len())
                    + 1;
                if bytes.get(end) == Some(&b'[') {
                    to(b']')?
                } else {
                    end
                }
            }
            // Results of a measuring cycle.
            (Names::Words, _) if bytes.starts_with(b"_OVR[") => to(b']')?,
            (Names::Words, _) => return self.name(),
            _ => return None,
        };
        (end > 1).then(|| self.take(end))
    }

    pub fn value(&mut self, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<NodeId> {
        self.bound(0, grammar, script)
    }

    /// A value whose operators bind at least as strongly as this.
    fn bound(&mut self, least: u8, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<NodeId> {
        let mut left = self.operand(grammar, script)?;
        while let Some((length, binds, binary)) = self
            .operator(grammar)
            .filter(|(_, binds, _)| *binds >= least)
        {
            self.advance(length);
            self.operators += 1;
            if self.operators > LONGEST {
                return fault(text!("this value is too long"));
            }
            let right = if binds == TIGHTEST {
                self.operand(grammar, script)?
            } else {
                self.bound(binds + 1, grammar, script)?
            };
            // Operands of AND and OR must be in brackets if they bind more weakly; with plain numbers AND and OR compute numbers.
            let joins = binds > COMPARES && matches!(binary, Binary::And | Binary::Or);
            if joins && !(script.is_condition(left) && script.is_condition(right)) {
                return fault(text!("AND and OR join conditions in brackets"));
            }
            left = script.keep(Node::Binary(binary, left, right));
        }
        Ok(left)
    }

    /// The next operator, without reading it: length, binding strength, function.
    #[inline]
    fn operator(&self, grammar: &Grammar) -> Option<(usize, u8, Binary)> {
        match self.next()? {
            b'+' => Some((1, TIGHTEST - 1, Binary::Add)),
            b'-' => Some((1, TIGHTEST - 1, Binary::Subtract)),
            b'*' => Some((1, TIGHTEST, Binary::Multiply)),
            b'/' => Some((1, TIGHTEST, Binary::Divide)),
            // Most values end at a bracket or at the end of the line.
            b']' | b')' | b',' => None,
            _ => self.word(grammar),
        }
    }

    /// The next operator among words and signs of several characters.
    fn word(&self, grammar: &Grammar) -> Option<(usize, u8, Binary)> {
        let here = |word: &str| {
            self.rest
                .get(..word.len())
                .is_some_and(|next| next.eq_ignore_ascii_case(word.as_bytes()))
        };
        grammar
            .operators
            .iter()
            .find(|(word, ..)| here(word))
            .map(|(word, binds, binary)| (word.len(), *binds, *binary))
    }

    /// One value without an operator.
    pub fn operand(&mut self, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<NodeId> {
        match self.next() {
            Some(b'#') => self.named(grammar, script),
            Some(b'0'..=b'9' | b'.') => {
                let number = self.number()?;
                Ok(script.keep(Node::Number(number)))
            }
            _ => {
                self.depth += 1;
                if self.depth > DEEPEST {
                    return fault(text!("brackets are nested too deeply"));
                }
                let node = self.inner(grammar, script)?;
                self.depth -= 1;
                Ok(node)
            }
        }
    }

    fn inner(&mut self, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<NodeId> {
        let (open, close) = grammar.brackets;
        match self.next() {
            None => fault(text!("a value is missing")),
            Some(b'-') => {
                self.advance(1);
                let inner = self.operand(grammar, script)?;
                Ok(match script.number(inner) {
                    Some(x) => script.keep(Node::Number(-x)),
                    None => script.keep(Node::Unary(Unary::Minus, inner)),
                })
            }
            Some(b) if b == open => self.bracketed(grammar, script),
            Some(_) => match self.function(open) {
                Some(name) => self.call(name, close, grammar, script),
                None => self.named(grammar, script),
            },
        }
    }

    /// A variable, or the system variable with its name.
    fn named(&mut self, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<NodeId> {
        let before = self.at();
        let Some(name) = self.variable(grammar.names) else {
            return fault(text!("\"{left}\" is not understood", self.from(before)));
        };
        Ok(match (grammar.system)(name) {
            Some(System::Fixed(x)) => script.keep(Node::Number(x)),
            Some(system) => script.keep(Node::System(system)),
            None => {
                let slot = script.slot(name);
                script.keep(Node::Slot(slot))
            }
        })
    }

    /// Name of a function: letters followed by a bracket.
    fn function(&mut self, open: u8) -> Option<&'t [u8]> {
        let end = self.count(|b| b.is_ascii_alphanumeric());
        (end > 1 && self.rest.get(end) == Some(&open)).then(|| self.take(end))
    }

    fn call(
        &mut self,
        name: &[u8],
        close: u8,
        grammar: &Grammar,
        script: &mut Script<'t>,
    ) -> Parsed<NodeId> {
        const FUNCTIONS: [(&str, Unary); 4] = [
            ("SIN", Unary::Sin),
            ("COS", Unary::Cos),
            ("SQRT", Unary::Sqrt),
            ("ABS", Unary::Abs),
        ];
        let Some((_, unary)) = FUNCTIONS
            .into_iter()
            .find(|(word, _)| name.eq_ignore_ascii_case(word.as_bytes()))
        else {
            return self.angle(name, close, grammar, script);
        };
        let inner = self.bracketed(grammar, script)?;
        Ok(script.keep(Node::Unary(unary, inner)))
    }

    /// `ATAN[y]/[x]`, `ATAN2(y,x)`.
    fn angle(
        &mut self,
        name: &[u8],
        close: u8,
        grammar: &Grammar,
        script: &mut Script<'t>,
    ) -> Parsed<NodeId> {
        let (y, x) = if name.eq_ignore_ascii_case(b"ATAN") {
            let y = self.bracketed(grammar, script)?;
            self.expect("/")?;
            (y, self.bracketed(grammar, script)?)
        } else if name.eq_ignore_ascii_case(b"ATAN2") {
            self.advance(1);
            let y = self.value(grammar, script)?;
            self.expect(",")?;
            let x = self.value(grammar, script)?;
            self.expect(sign(close))?;
            (y, x)
        } else {
            return fault(text!(
                "the function {name} is not understood",
                printable(&String::from_utf8_lossy(name))
            ));
        };
        Ok(script.keep(Node::Binary(Binary::Atan, y, x)))
    }

    pub fn bracketed(&mut self, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<NodeId> {
        let (open, close) = grammar.brackets;
        self.bracket(open)?;
        let node = self.value(grammar, script)?;
        self.bracket(close)?;
        Ok(node)
    }

    /// Reads a bracket that must be next.
    fn bracket(&mut self, bracket: u8) -> Parsed<()> {
        if self.next() != Some(bracket) {
            return self.expect(sign(bracket));
        }
        self.advance(1);
        Ok(())
    }
}

/// A whole number that consists of digits only.
pub fn whole(digits: &[u8]) -> Option<i32> {
    let more = |sum: i32, digit: &u8| match digit {
        b'0'..=b'9' => sum.checked_mul(10)?.checked_add(i32::from(digit - b'0')),
        _ => None,
    };
    if digits.is_empty() {
        None
    } else {
        digits.iter().try_fold(0, more)
    }
}

fn sign(byte: u8) -> &'static str {
    match byte {
        b'[' => "[",
        b']' => "]",
        b'(' => "(",
        _ => ")",
    }
}
