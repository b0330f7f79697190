//! The lexer and the parser that the readers share: words, expressions, comments.

use std::collections::HashMap;

use crate::control::iso::script::{Binary, Expr, Modes, Motion, Node, Script, System, Trouble, Unary, What, Words};
use crate::geom::AXIS_NAMES;

/// Deepest nesting of brackets and signs.
const DEEPEST: usize = 40;

/// The most operators of one value: each makes the tree deeper by one.
const LONGEST: usize = 400;

/// How a dialect writes values and codes: data, and nothing of how it is written.
#[derive(Debug)]
pub struct Grammar {
    /// The brackets that group.
    pub brackets: (u8, u8),
    /// Whether places and feeds must have a decimal point: without one they count in the smallest step of the control.
    pub points: bool,
    /// How variables are named.
    pub names: Names,
    /// What stands between two values: the word, how tightly it binds (0 least), and what it does.
    pub operators: &'static [(&'static str, u8, Binary)],
    /// What the control knows under a name, where it is no variable of the program.
    pub system: fn(&str) -> Option<System>,
    /// What a code does: its letter, and ten times its number.
    pub code: fn(u8, i32) -> Option<Code>,
}

/// How variables are named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Names {
    /// `#5061`, `#<center_x>`.
    Hash,
    /// `R12`, `TP_MOVE`, `$AA_MW[X]`.
    Words,
}

/// What a code does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Code {
    /// A motion.
    Motion(Motion),
    /// A mode.
    Mode(Modes),
    /// G10: writes a work offset.
    Setting,
    /// Ends the program.
    End,
    /// Selects a work offset by its number P, counted on from here.
    Extended(i32),
    /// Nothing that matters here; it may have these letters.
    Nothing(&'static str),
}

/// Operators as words, in brackets `[ ]`.
pub const WORD_OPERATORS: &[(&str, u8, Binary)] = &[
    ("OR", 0, Binary::Or),
    ("AND", 0, Binary::And),
    ("EQ", 1, Binary::Equal),
    ("NE", 1, Binary::Unequal),
    ("LT", 1, Binary::Less),
    ("LE", 1, Binary::AtMost),
    ("GT", 1, Binary::Greater),
    ("GE", 1, Binary::AtLeast),
    ("+", 2, Binary::Add),
    ("-", 2, Binary::Subtract),
    ("*", 3, Binary::Multiply),
    ("/", 3, Binary::Divide),
];

/// Operators as signs, in brackets `( )`.
pub const SIGN_OPERATORS: &[(&str, u8, Binary)] = &[
    ("OR", 0, Binary::Or),
    ("AND", 0, Binary::And),
    ("==", 1, Binary::Equal),
    ("<>", 1, Binary::Unequal),
    (">=", 1, Binary::AtLeast),
    ("<=", 1, Binary::AtMost),
    ("+", 2, Binary::Add),
    ("-", 2, Binary::Subtract),
    ("*", 3, Binary::Multiply),
    ("/", 3, Binary::Divide),
];

/// How tightly the tightest operator binds.
const TIGHTEST: u8 = 3;

/// A place in a line.
#[derive(Debug)]
pub struct Cursor<'t> {
    rest: &'t str,
    depth: usize,
    operators: usize,
}

/// What went wrong, without its line.
pub type Parsed<T> = Result<T, String>;

impl<'t> Cursor<'t> {
    /// The beginning of a text.
    pub fn new(text: &'t str) -> Self {
        Cursor { rest: text.trim_start(), depth: 0, operators: 0 }
    }

    /// Whether nothing is left.
    pub fn is_done(&self) -> bool {
        self.rest.is_empty()
    }

    /// What is left, in part, for a message.
    pub fn left(&self) -> String {
        crate::form::printable(&self.rest.chars().take(40).collect::<String>())
    }

    fn take(&mut self, bytes: usize) -> &'t str {
        let (taken, rest) = self.rest.split_at(bytes);
        self.rest = rest.trim_start();
        taken
    }

    /// Goes past a word or sign where it is next.
    pub fn eat(&mut self, word: &str) -> bool {
        let next = self.rest.as_bytes().get(..word.len()).is_some_and(|next| next.eq_ignore_ascii_case(word.as_bytes()));
        if next {
            self.take(word.len());
        }
        next
    }

    /// Goes past a sign that must be next.
    pub fn expect(&mut self, sign: &str) -> Parsed<()> {
        if self.eat(sign) { Ok(()) } else { Err(format!("{sign} is missing before \"{}\"", self.left())) }
    }

    /// Nothing must be left.
    pub fn end(&self) -> Parsed<()> {
        if self.is_done() { Ok(()) } else { Err(format!("\"{}\" is left over", self.left())) }
    }

    /// A name: letters, digits and underscores.
    pub fn name(&mut self) -> Option<&'t str> {
        let end = self.rest.bytes().position(|b| !(b.is_ascii_alphanumeric() || b == b'_')).unwrap_or(self.rest.len());
        let named = self.rest.bytes().next().is_some_and(|b| b.is_ascii_alphabetic() || b == b'_');
        named.then(|| self.take(end))
    }

    /// The name of an O word: `<tp_exit>`, `12`.
    pub fn label(&mut self) -> Option<&'t str> {
        let end = match self.rest.bytes().next()? {
            b'<' => self.rest.find('>')? + 1,
            _ => self.rest.bytes().position(|b| !b.is_ascii_digit()).unwrap_or(self.rest.len()),
        };
        (end > 0).then(|| self.take(end))
    }

    /// A number without a sign.
    pub fn number(&mut self) -> Parsed<f64> {
        let end = self.rest.bytes().position(|b| !(b.is_ascii_digit() || b == b'.')).unwrap_or(self.rest.len());
        match self.rest[..end].parse::<f64>() {
            Ok(number) if number.is_finite() => {
                self.take(end);
                Ok(number)
            }
            _ => Err(format!("a number is missing before \"{}\"", self.left())),
        }
    }

    /// A variable with its sign and brackets: `#5061`, `#<center_x>`, `R12`, `$AA_MW[X]`.
    pub fn variable(&mut self, names: Names) -> Option<&'t str> {
        let bytes = self.rest.as_bytes();
        let end = match (names, bytes.first()?) {
            (Names::Hash, b'#') if bytes.get(1) == Some(&b'<') => self.rest.find('>')? + 1,
            (Names::Hash, b'#') if bytes.get(1) == Some(&b'[') => self.rest.find(']')? + 1,
            (Names::Hash, b'#') => bytes[1..].iter().position(|b| !b.is_ascii_digit()).unwrap_or(bytes.len() - 1) + 1,
            (Names::Words, b'$') => {
                let end = bytes[1..]
                    .iter()
                    .position(|b| !(b.is_ascii_alphanumeric() || *b == b'_'))
                    .map_or(bytes.len(), |end| end + 1);
                if bytes.get(end) == Some(&b'[') { end + self.rest[end..].find(']')? + 1 } else { end }
            }
            (Names::Words, _) => return self.name(),
            _ => return None,
        };
        (end > 1).then(|| self.take(end))
    }

    /// A value.
    pub fn value(&mut self, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<Node> {
        self.level(0, grammar, script)
    }

    fn level(&mut self, level: u8, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<Node> {
        if level > TIGHTEST {
            return self.operand(grammar, script);
        }
        let mut left = self.level(level + 1, grammar, script)?;
        'next: loop {
            for (word, own, binary) in grammar.operators {
                if *own == level && self.eat(word) {
                    self.operators += 1;
                    if self.operators > LONGEST {
                        return Err("this value is too long".to_owned());
                    }
                    let right = self.level(level + 1, grammar, script)?;
                    left = script.node(Expr::Binary(*binary, left, right));
                    continue 'next;
                }
            }
            return Ok(left);
        }
    }

    /// One value without an operator around it.
    pub fn operand(&mut self, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<Node> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err("brackets are nested too deeply".to_owned());
        }
        let node = self.inner(grammar, script)?;
        self.depth -= 1;
        Ok(node)
    }

    fn inner(&mut self, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<Node> {
        let (open, close) = grammar.brackets;
        match self.rest.bytes().next() {
            None => Err("a value is missing".to_owned()),
            Some(b'-') => {
                self.take(1);
                let inner = self.operand(grammar, script)?;
                Ok(match script.number(inner) {
                    Some(x) => script.node(Expr::Number(-x)),
                    None => script.node(Expr::Unary(Unary::Minus, inner)),
                })
            }
            Some(b'0'..=b'9' | b'.') => {
                let number = self.number()?;
                Ok(script.node(Expr::Number(number)))
            }
            Some(b) if b == open => self.bracketed(grammar, script),
            Some(_) => {
                let before = self.rest;
                if let Some(name) = self.function(open) {
                    return self.call(name, close, grammar, script);
                }
                let Some(name) = self.variable(grammar.names) else {
                    return Err(format!("\"{}\" is not understood", Cursor::new(before).left()));
                };
                Ok(match (grammar.system)(name) {
                    Some(System::Fixed(x)) => script.node(Expr::Number(x)),
                    Some(system) => script.node(Expr::System(system)),
                    None => {
                        let slot = script.slot(name);
                        script.node(Expr::Slot(slot))
                    }
                })
            }
        }
    }

    /// The name of a function: letters with a bracket behind them.
    fn function(&mut self, open: u8) -> Option<&'t str> {
        let end = self.rest.bytes().position(|b| !b.is_ascii_alphanumeric())?;
        (end > 1 && self.rest.as_bytes()[end] == open).then(|| self.take(end))
    }

    fn call(&mut self, name: &str, close: u8, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<Node> {
        let unary = match name.to_ascii_uppercase().as_str() {
            "SIN" => Unary::Sin,
            "COS" => Unary::Cos,
            "SQRT" => Unary::Sqrt,
            "ABS" => Unary::Abs,
            // ATAN[y]/[x], ATAN2(y,x).
            "ATAN" => {
                let y = self.bracketed(grammar, script)?;
                self.expect("/")?;
                let x = self.bracketed(grammar, script)?;
                return Ok(script.node(Expr::Binary(Binary::Atan, y, x)));
            }
            "ATAN2" => {
                self.take(1);
                let y = self.value(grammar, script)?;
                self.expect(",")?;
                let x = self.value(grammar, script)?;
                self.expect(sign(close))?;
                return Ok(script.node(Expr::Binary(Binary::Atan, y, x)));
            }
            _ => return Err(format!("the function {} is not understood", crate::form::printable(name))),
        };
        let inner = self.bracketed(grammar, script)?;
        Ok(script.node(Expr::Unary(unary, inner)))
    }

    /// A value in brackets.
    pub fn bracketed(&mut self, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<Node> {
        let (open, close) = grammar.brackets;
        self.expect(sign(open))?;
        let node = self.value(grammar, script)?;
        self.expect(sign(close))?;
        Ok(node)
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

/// The words of a block, put together.
#[derive(Debug, Default)]
struct Block {
    words: Words,
    moves: bool,
    setting: bool,
    ends: bool,
    allowed: &'static str,
    extended: Option<i32>,
    /// L, P, R and whatever else stands there.
    others: [Option<Node>; 26],
}

/// A block of words.
pub fn words<'t>(cursor: &mut Cursor<'t>, grammar: &Grammar, script: &mut Script<'t>) -> Parsed<What> {
    let mut block = Block::default();
    if cursor.is_done() {
        return Ok(What::Nothing);
    }
    while !cursor.is_done() {
        let letter = cursor.rest.as_bytes()[0].to_ascii_uppercase();
        if !letter.is_ascii_uppercase() {
            return Err(format!("\"{}\" is not understood", cursor.left()));
        }
        let word = cursor.rest;
        cursor.take(1);
        let value = cursor.operand(grammar, script)?;
        let written = &word[1..word.len() - cursor.rest.len()];
        let counted = grammar.points && matches!(letter, b'F' | b'I'..=b'K' | b'X'..=b'Z') && script.number(value).is_some();
        if counted && !written.contains('.') {
            return Err(format!("a number has no point: \"{}\"", Cursor::new(word).left()));
        }
        block.add(letter, value, grammar, script).map_err(|reason| format!("{reason}: \"{}\"", Cursor::new(word).left()))?;
    }
    block.finish(script)
}

impl Block {
    fn add(&mut self, letter: u8, value: Node, grammar: &Grammar, script: &Script<'_>) -> Parsed<()> {
        let twice = |place: &mut Option<Node>| {
            if place.replace(value).is_some() { Err("a word stands twice".to_owned()) } else { Ok(()) }
        };
        match letter {
            b'X' | b'Y' | b'Z' => {
                self.moves = true;
                twice(&mut self.words.to[usize::from(letter - b'X')])
            }
            b'I' | b'J' | b'K' => twice(&mut self.words.center[usize::from(letter - b'I')]),
            b'F' => twice(&mut self.words.feed),
            b'G' | b'M' => {
                let tenths = script.number(value).map(|x| (x * 10.0).round()).filter(|x| (0.0..100_000.0).contains(x));
                match tenths.and_then(|tenths| (grammar.code)(letter, tenths as i32)) {
                    Some(code) => self.code(code),
                    None => Err("this code is not understood".to_owned()),
                }
            }
            _ => twice(&mut self.others[usize::from(letter - b'A')]),
        }
    }

    fn code(&mut self, code: Code) -> Parsed<()> {
        match code {
            Code::Motion(motion) => {
                // A code that only says what a contact in the motion beside it means goes first or last.
                self.words.motion = Some(match (self.words.motion, motion) {
                    (None, motion) => motion,
                    (Some(Motion::MayTouch), Motion::MustTouch | Motion::MustBeFree) => motion,
                    (Some(Motion::MustTouch | Motion::MustBeFree), Motion::MayTouch) => self.words.motion.unwrap_or(motion),
                    _ => return Err("two motions are in one block".to_owned()),
                });
            }
            Code::Mode(modes) => self.words.modes = self.words.modes.then(modes),
            Code::Setting => self.setting = true,
            Code::End => self.ends = true,
            Code::Extended(from) => {
                self.extended = Some(from);
                self.allowed = "P";
            }
            Code::Nothing(letters) => self.allowed = letters,
        }
        Ok(())
    }

    fn finish(mut self, script: &mut Script<'_>) -> Parsed<What> {
        if let Some(from) = self.extended {
            let number = self.others[usize::from(b'P' - b'A')].and_then(|node| script.number(node));
            let number = number.filter(|n| (1.0..=99.0).contains(n)).ok_or("a work offset without its number")?;
            self.words.modes.offset = Some(from + number as i32);
        }
        let other = |letter: u8| self.others[usize::from(letter - b'A')];
        let allowed = if self.setting { "LPR" } else { self.allowed };
        for (i, _) in self.others.iter().enumerate().filter(|(_, value)| value.is_some()) {
            let letter = (b'A' + i as u8) as char;
            if !allowed.contains(letter) {
                return Err(format!("the word {letter} is not understood here"));
            }
        }
        if self.setting {
            let whole = |letter: u8| other(letter).and_then(|node| script.number(node)).map(|x| x as i32);
            let number = whole(b'P').filter(|n| (1..=999).contains(n)).ok_or("G10 without the number of a work offset")?;
            return match whole(b'L') {
                Some(20) if other(b'R').is_none() => Ok(What::Reading(number, self.words.to)),
                Some(2) => Ok(What::Origin(number, self.words.to, other(b'R'))),
                _ => Err("G10 is understood with L2 and L20".to_owned()),
            };
        }
        match (self.moves, self.words.motion) {
            (true, None) => Err("a block with axis words must name its motion".to_owned()),
            (false, Some(_)) => Err("a motion without axis words".to_owned()),
            (false, None) if self.words.feed.is_some() => Err("a feed without a motion".to_owned()),
            (false, None) if self.ends => Ok(What::End),
            (true, _) if self.ends => Err("a motion in the last block".to_owned()),
            _ => Ok(What::Words(self.words)),
        }
    }
}

/// The code of a line and its comment, without its brackets or sign. A sign inside a text begins none.
pub fn split_comment(line: &str, sign: u8) -> Parsed<(&str, Option<&str>)> {
    let mut quoted = false;
    for (at, b) in line.bytes().enumerate() {
        match b {
            b'"' => quoted = !quoted,
            b';' if sign == b'(' && !quoted => return Ok((&line[..at], Some(line[at + 1..].trim()))),
            _ if b != sign || quoted => {}
            b'(' => {
                let inner = line[at + 1..].trim_end();
                let inner = inner.strip_suffix(')').ok_or("a comment is not closed, or code stands behind it")?;
                if inner.contains([')', '(']) {
                    return Err("two comments are in one line, or one in another".to_owned());
                }
                return Ok((&line[..at], Some(inner)));
            }
            _ => return Ok((&line[..at], Some(line[at + 1..].trim()))),
        }
    }
    Ok((line, None))
}

/// Where the header says that the ball is before the start: `The stylus is taken to be at X0 Y0 Z100 before the start`.
pub fn stated_start(comment: &str) -> Option<[f64; 3]> {
    const HEAD: &str = "The stylus is taken to be at ";
    let words = comment.get(HEAD.len()..).filter(|_| comment[..HEAD.len()].eq_ignore_ascii_case(HEAD))?;
    let mut place = [None; 3];
    for word in words.split(' ').take(3) {
        let axis = AXIS_NAMES.iter().position(|name| word.starts_with(name))?;
        place[axis] = word[1..].parse::<f64>().ok().filter(|x| x.is_finite());
    }
    Some([place[0]?, place[1]?, place[2]?])
}

/// Reads line by line: `block` gets the code and the comment of each line. Every line that is not understood is listed.
pub fn lines<'t>(
    text: &'t str,
    sign: u8,
    script: &mut Script<'t>,
    mut block: impl FnMut(&mut Script<'t>, usize, &'t str, Option<&'t str>) -> Parsed<()>,
) -> Result<(), Vec<Trouble>> {
    let mut troubles = Vec::new();
    let code = |line: &str| !line.is_empty() && !line.starts_with(['(', ';']);
    let last = text.lines().enumerate().filter(|(_, line)| code(line.trim())).last().map_or(0, |(line, _)| line);
    let mut begun = false;
    for (line, full) in text.lines().enumerate() {
        // A tape sign stands before a program and behind it: what stands behind another is not loaded.
        if full.trim_start().starts_with('%') {
            if begun && line < last {
                troubles.push(Trouble { line, message: "% ends the program here".to_owned(), understood: false });
            }
            continue;
        }
        begun |= !full.trim().is_empty() && !full.trim_start().starts_with(';');
        let read = split_comment(full, sign).and_then(|(code, comment)| {
            if let Some(comment) = comment {
                script.start = script.start.or_else(|| stated_start(comment));
            }
            block(script, line, code.trim(), comment)
        });
        if let Err(message) = read {
            troubles.push(Trouble { line, message, understood: false });
        }
    }
    if troubles.is_empty() { Ok(()) } else { Err(troubles) }
}

/// Jumps and calls by name, resolved when everything is read.
#[derive(Debug, Default)]
pub struct Targets<'t> {
    /// Labels and subroutines, and where they stand.
    pub known: Vec<(&'t str, usize)>,
    /// Blocks that go somewhere, and where to.
    pub wanted: Vec<(usize, &'t str)>,
}

impl Targets<'_> {
    /// Puts the targets in. Each must be there once; `below` is whether it has to stand below the jump.
    pub fn resolve(&self, script: &mut Script<'_>, below: bool) -> Result<(), Vec<Trouble>> {
        let mut troubles = Vec::new();
        let mut places: HashMap<String, (usize, bool)> = HashMap::new();
        for (name, place) in &self.known {
            places.entry(name.to_ascii_lowercase()).and_modify(|known| known.1 = true).or_insert((*place, false));
        }
        for (from, name) in &self.wanted {
            let message = match places.get(&name.to_ascii_lowercase()) {
                Some((to, false)) if !below || to > from => {
                    match &mut script.blocks[*from].what {
                        What::Jump(target) | What::JumpIf(_, target) | What::JumpUnless(_, target) | What::Call(target, _) => {
                            *target = *to
                        }
                        _ => {}
                    }
                    continue;
                }
                Some((_, false)) => "a jump down finds its label above only",
                None => "the target of this jump is nowhere",
                Some((_, true)) => "the target of this jump is there more than once",
            };
            troubles.push(Trouble { line: script.blocks[*from].line, message: message.to_owned(), understood: true });
        }
        if troubles.is_empty() { Ok(()) } else { Err(troubles) }
    }
}

/// A block without its number, `N10`.
pub fn without_number(code: &str) -> &str {
    let rest = code.strip_prefix('N').map(|rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()));
    match rest {
        Some(rest) if rest.len() + 1 < code.len() && rest.starts_with(' ') => rest.trim_start(),
        _ => code,
    }
}
