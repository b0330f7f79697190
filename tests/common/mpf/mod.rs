//! Reads SINUMERIK programs back, without code of the crate's reader: a second reading of the generated subset of the language and its structure.
//!
//! [`read`] returns blocks, or every line outside the subset. [`Program::troubles`] checks what a control does not check: every watched move has its check,
//! every jump its label, and no move is unwatched. [`Program::moves`] returns the path.

mod term;

pub use term::term;

use std::collections::HashMap;

const AXIS_NAMES: [&str; 3] = ["X", "Y", "Z"];

/// Deepest nesting of brackets.
const DEEPEST: usize = 40;

/// Maximum number of operators in an expression: each makes the tree one level deeper.
const LONGEST: usize = 400;

/// A line that is not understood, or not safe.
#[derive(Clone, Debug, PartialEq)]
pub struct Trouble {
    /// 1-based.
    pub line: usize,
    /// The error.
    pub message: String,
}

/// A program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// Its blocks, in order.
    pub blocks: Vec<Block>,
    /// Its comments, without the semicolon.
    pub comments: Vec<String>,
    /// The stated position of the ball before the start, if any.
    pub start: Option<[f64; 3]>,
    /// Whether the program states that positioning is not watched.
    pub unwatched: bool,
}

/// One block.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// 1-based line.
    pub line: usize,
    /// Its statement.
    pub statement: Statement,
}

/// Statement of a block.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// `DEF INT NAME`.
    Declare(String),
    /// `NAME:`.
    Label(String),
    /// `GOTOF NAME`.
    Jump(String),
    /// `IF … GOTOF NAME`.
    If(Term, String),
    /// `R1=…`, `TP_MOVE=…`, `$P_UIFR[…]=…`.
    Assign(Term, Term),
    /// A block with axis words.
    Motion(Motion),
    /// Words without a motion: `G17 G90`, `M30`, `STOPRE`.
    Words(Vec<String>),
    /// `MSG(…)`, `SETAL(…)`, `CYCLE977(…)`; an argument may be omitted.
    Call(String, Vec<Option<Term>>),
}

/// A block with axis words.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// `MEAS=1`: probe input of a measuring move.
    pub measuring: Option<u8>,
    /// `G0`: the control's rapid.
    pub rapid: bool,
    /// X, Y, Z; for a sum its number.
    pub axes: [Option<f64>; 3],
    /// `X=10+R5`.
    pub sums: [Option<Term>; 3],
    /// F.
    pub feed: Option<f64>,
}

impl Motion {
    /// Position after it: axes that it omits stay.
    fn after(&self, at: [Option<f64>; 3]) -> [Option<f64>; 3] {
        [0, 1, 2].map(|axis| self.axes[axis].or(at[axis]))
    }
}

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Term {
    /// A number.
    Number(f64),
    /// `"text"`.
    Text(String),
    /// `R12`.
    Register(usize),
    /// A name: a variable, an axis.
    Name(String),
    /// `$P_UIFR[1,X,TR]`.
    System(String, Vec<Term>),
    /// `SIN(…)`.
    Call(String, Vec<Term>),
    /// `−…`.
    Minus(Box<Term>),
    /// Two operands and their operator.
    Binary(&'static str, Box<Term>, Box<Term>),
}

/// Purpose of a move, by its spelling.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Must not touch anything.
    Position,
    /// Must touch; searches to the end of its path.
    Touch,
    /// Retract from a touch.
    Back,
}

/// A move of the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// 1-based line.
    pub line: usize,
    /// Its number as the program counts, if stated.
    pub number: Option<usize>,
    /// Its purpose.
    pub purpose: Purpose,
    /// Its end; for a touch the end of its search.
    pub to: [f64; 3],
    /// Feed.
    pub feed: f64,
}

/// Reads a program; returns every line outside the subset as an error.
pub fn read(text: &str) -> Result<Program, Vec<Trouble>> {
    let mut program = Program::default();
    let mut troubles = Vec::new();
    for (index, full) in text.lines().enumerate() {
        let (code, comment) = split_comment(full);
        if let Some(comment) = comment {
            let comment = comment.trim();
            program.start = program.start.or_else(|| stated_start(comment));
            program.unwatched |= comment.ends_with("Positioning is NOT watched");
            program.comments.push(comment.to_owned());
        }
        let code = without_number(code.trim());
        // Lines before a program in an archive.
        if code.is_empty() || code.starts_with('%') {
            continue;
        }
        match statement(code) {
            Ok(statement) => program.blocks.push(Block {
                line: index + 1,
                statement,
            }),
            Err(message) => troubles.push(Trouble {
                line: index + 1,
                message,
            }),
        }
    }
    if troubles.is_empty() {
        Ok(program)
    } else {
        Err(troubles)
    }
}

/// `The stylus is taken to be at X0 Y0 Z100 before the start, …`
fn stated_start(comment: &str) -> Option<[f64; 3]> {
    let words = comment.strip_prefix("The stylus is taken to be at ")?;
    let mut place = [None; 3];
    for word in words.split(' ').take(3) {
        let axis = AXIS_NAMES.iter().position(|name| word.starts_with(name))?;
        place[axis] = word[1..].parse::<f64>().ok().filter(|x| x.is_finite());
    }
    Some([place[0]?, place[1]?, place[2]?])
}

/// The code of a line and its comment. A semicolon inside a text starts no comment.
fn split_comment(line: &str) -> (&str, Option<&str>) {
    let mut quoted = false;
    for (at, c) in line.char_indices() {
        match c {
            '"' => quoted = !quoted,
            ';' if !quoted => return (&line[..at], Some(&line[at + 1..])),
            _ => {}
        }
    }
    (line, None)
}

fn without_number(code: &str) -> &str {
    let Some(rest) = code.strip_prefix(['N', 'n']) else {
        return code;
    };
    let text = rest.trim_start_matches(|c: char| c.is_ascii_digit());
    if text.len() < rest.len() && (text.is_empty() || text.starts_with(char::is_whitespace)) {
        text.trim_start()
    } else {
        code
    }
}

fn statement(code: &str) -> Result<Statement, String> {
    let (first, rest) = code.split_once(char::is_whitespace).unwrap_or((code, ""));
    let rest = rest.trim();
    match first.to_ascii_uppercase().as_str() {
        "DEF" => {
            let name = rest
                .strip_prefix("INT ")
                .or_else(|| rest.strip_prefix("REAL "))
                .map(str::trim);
            return name
                .filter(|n| is_name(n))
                .map(|n| Statement::Declare(n.to_owned()))
                .ok_or("a DEF without type and name".into());
        }
        "GOTOF" => {
            return is_name(rest)
                .then(|| Statement::Jump(rest.to_owned()))
                .ok_or("a jump without a label".into());
        }
        "IF" => {
            let (condition, label) = rest
                .rsplit_once(" GOTOF ")
                .ok_or("an IF without its jump")?;
            let label = label.trim();
            if !is_name(label) {
                return Err("a jump without a label".into());
            }
            return Ok(Statement::If(term(condition)?, label.to_owned()));
        }
        _ => {}
    }
    if let Some(label) = code.strip_suffix(':').filter(|l| is_name(l)) {
        return Ok(Statement::Label(label.to_owned()));
    }
    if let Some((name, arguments)) = code.split_once('(')
        && is_name(name)
    {
        let arguments = arguments
            .strip_suffix(')')
            .ok_or("a bracket is not closed")?;
        return call(name, arguments);
    }
    if input_of(first).is_none()
        && let Some(at) = assignment(code)
    {
        let place = term(&code[..at])?;
        if !matches!(place, Term::Register(_) | Term::Name(_) | Term::System(..)) {
            return Err("nothing can be assigned to this".into());
        }
        return Ok(Statement::Assign(place, term(&code[at + 1..])?));
    }
    words(code)
}

/// Position of the `=` of an assignment.
fn assignment(code: &str) -> Option<usize> {
    let at = code.find('=')?;
    let place = code[..at].trim();
    let register = place
        .strip_prefix('R')
        .is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()));
    (register || place.starts_with('$') || (is_name(place) && place.len() > 1)).then_some(at)
}

fn call(name: &str, arguments: &str) -> Result<Statement, String> {
    let mut parts = Vec::new();
    let (mut depth, mut quoted, mut start) = (0usize, false, 0);
    for (at, c) in arguments.char_indices() {
        match c {
            '"' => quoted = !quoted,
            '(' | '[' if !quoted => depth += 1,
            ')' | ']' if !quoted => depth = depth.saturating_sub(1),
            ',' if !quoted && depth == 0 => {
                parts.push(&arguments[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&arguments[start..]);
    let arguments: Result<Vec<Option<Term>>, String> = parts
        .into_iter()
        .map(|p| {
            if p.trim().is_empty() {
                Ok(None)
            } else {
                term(p).map(Some)
            }
        })
        .collect();
    Ok(Statement::Call(name.to_owned(), arguments?))
}

/// The probe input of `MEAS=1` and `MEAS=2`.
fn input_of(word: &str) -> Option<u8> {
    let (name, input) = word.split_once('=')?;
    input
        .parse()
        .ok()
        .filter(|input| name.eq_ignore_ascii_case("MEAS") && [1, 2].contains(input))
}

fn words(code: &str) -> Result<Statement, String> {
    let mut motion = Motion::default();
    let mut others = Vec::new();
    let mut moves = false;
    for word in code.split_whitespace() {
        if let Some(input) = input_of(word) {
            motion.measuring = Some(input);
            continue;
        }
        let letter = &word[..word.chars().next().map_or(0, char::len_utf8)];
        let number = || {
            word[letter.len()..]
                .trim_start_matches('=')
                .parse::<f64>()
                .ok()
                .filter(|x| x.is_finite())
        };
        match letter {
            "X" | "Y" | "Z" => {
                let axis = AXIS_NAMES
                    .iter()
                    .position(|name| *name == letter)
                    .unwrap_or(0);
                let sum = word[1..].strip_prefix('=').map(term).transpose()?;
                if let Some(Term::Binary("+" | "-", ..)) = &sum {
                    motion.axes[axis] = sum.as_ref().and_then(first_number);
                    motion.sums[axis] = sum;
                }
                let plain = motion.axes[axis]
                    .filter(|_| motion.sums[axis].is_some())
                    .or_else(number);
                motion.axes[axis] = Some(plain.ok_or_else(|| format!("{word} is no axis word"))?);
                moves = true;
            }
            "F" => motion.feed = Some(number().ok_or_else(|| format!("{word} is no feed"))?),
            "G" | "M" if number().is_some() => others.push(word.to_owned()),
            _ if matches!(word, "STOPRE" | "TRANS" | "DIAMOF") => others.push(word.to_owned()),
            _ => {
                return Err(format!(
                    "{} is not understood",
                    word.chars().take(40).collect::<String>()
                ));
            }
        }
    }
    match (moves, others.as_slice()) {
        (true, [one])
            if one == "G1"
                || (one == "G0" && motion.measuring.is_none() && motion.feed.is_none()) =>
        {
            motion.rapid = one == "G0";
            Ok(Statement::Motion(motion))
        }
        (true, _) => Err("a block with axis words must be a G1, or a G0 without a feed".into()),
        (false, []) => Err("nothing is in this block".into()),
        (false, _) if motion.measuring.is_some() || motion.feed.is_some() => {
            Err("a feed or MEAS without a motion".into())
        }
        (false, _) => Ok(Statement::Words(others)),
    }
}

/// First number of a sum: the nominal position.
fn first_number(sum: &Term) -> Option<f64> {
    match sum {
        Term::Number(x) => Some(*x),
        Term::Minus(x) => match x.as_ref() {
            Term::Number(x) => Some(-x),
            _ => None,
        },
        Term::Binary("+" | "-", first, _) => first_number(first),
        _ => None,
    }
}

fn is_name(text: &str) -> bool {
    let mut letters = text.chars();
    letters
        .next()
        .is_some_and(|c| c.is_ascii_alphabetic() || c == '_')
        && letters.all(|c| c.is_ascii_alphanumeric() || c == '_')
}

impl Program {
    /// Errors that a control would not find, or only during probing: jumps without labels, watched moves without their check, unwatched moves, units and
    /// absolute mode that are not stated.
    pub fn troubles(&self) -> Vec<Trouble> {
        let mut troubles = Vec::new();
        let mut say = |line: usize, message: &str| {
            troubles.push(Trouble {
                line,
                message: message.to_owned(),
            })
        };
        let mut at = self.start.map_or([None; 3], |start| start.map(Some));
        let mut before_touch: Option<[Option<f64>; 3]> = None;
        let (mut units, mut absolute, mut exits) = (false, false, false);
        let mut labels: HashMap<&str, Vec<usize>> = HashMap::new();
        for (i, block) in self.blocks.iter().enumerate() {
            if let Statement::Label(label) = &block.statement {
                labels.entry(label).or_default().push(i);
            }
        }
        for (i, block) in self.blocks.iter().enumerate() {
            let line = block.line;
            match &block.statement {
                Statement::Jump(label) | Statement::If(_, label) => {
                    match labels.get(label.as_str()).map_or(&[][..], Vec::as_slice) {
                        [one] if *one > i => {}
                        [_] => say(line, "GOTOF looks for its label below"),
                        [] => say(line, "the label of this jump is nowhere"),
                        _ => say(line, "the label of this jump is there more than once"),
                    }
                }
                Statement::Words(words) => {
                    units |= words.iter().any(|w| w == "G70" || w == "G71");
                    absolute |= words.iter().any(|w| w == "G90");
                    exits |= words.iter().any(|w| w == "M30");
                }
                Statement::Motion(motion) => {
                    if !units || !absolute {
                        say(line, "this moves before units and G90 are stated");
                    }
                    if !exits && !motion.rapid && motion.feed.is_none_or(|f| f <= 0.0) {
                        say(line, "this moves without a feed of its own");
                    }
                    let to = motion.after(at);
                    if motion.measuring.is_some() {
                        match self.check_after(i) {
                            Some(touches) => before_touch = touches.then_some(at),
                            None => say(
                                line,
                                "this MEAS move is not checked: a contact in it would go unnoticed",
                            ),
                        }
                    } else if before_touch.take().is_none_or(|start| start != to)
                        && !exits
                        && !self.unwatched
                    {
                        say(
                            line,
                            "a move without MEAS that does not lead back from a touch",
                        );
                    }
                    at = to;
                }
                Statement::Call(name, arguments) => match (name.as_str(), arguments.len()) {
                    ("CYCLE977", 28 | 29)
                    | ("CYCLE978", 22)
                    | ("MSG" | "SETAL", 1)
                    | ("WRITE", 3) => {}
                    _ => say(line, "this call is unknown, or has too many arguments"),
                },
                Statement::Declare(_) | Statement::Label(_) | Statement::Assign(..) => {}
            }
        }
        troubles
    }

    /// Whether the MEAS move of this block must touch, by the check that follows it; `None` if there is no check.
    fn check_after(&self, block: usize) -> Option<bool> {
        let stop = Statement::Words(vec!["STOPRE".to_owned()]);
        let [stopped, check] = self.blocks.get(block + 1..block + 3)? else {
            return None;
        };
        let Statement::If(Term::Binary(operator, left, right), _) = &check.statement else {
            return None;
        };
        let Statement::Motion(Motion {
            measuring: Some(input),
            ..
        }) = &self.blocks.get(block)?.statement
        else {
            return None;
        };
        let state = Term::System("$AC_MEA".to_owned(), vec![Term::Number(f64::from(*input))]);
        (stopped.statement == stop && **left == state && **right == Term::Number(0.0))
            .then_some(*operator == "==")
    }

    /// The path up to the end of the program. An approach in steps, axis by axis, is one step with the line of the last.
    pub fn moves(&self) -> Result<Vec<Step>, Trouble> {
        let mut at: [Option<f64>; 3] = self.start.map_or([None; 3], |start| start.map(Some));
        let (mut number, mut feed, mut steps) = (None, 0.0, Vec::<Step>::new());
        for (i, block) in self.blocks.iter().enumerate() {
            match &block.statement {
                Statement::Words(words) if words.iter().any(|w| w == "M30") => break,
                Statement::Assign(Term::Name(name), Term::Number(n)) if name == "TP_MOVE" => {
                    number = Some(*n as usize)
                }
                Statement::Motion(motion) => {
                    let stood = at;
                    at = motion.after(at);
                    feed = motion.feed.unwrap_or(feed);
                    // From the start position in the job, the move up to that height has zero length.
                    if steps.is_empty() && at == stood && self.start.is_some() {
                        continue;
                    }
                    let purpose = match (motion.measuring.is_some(), self.check_after(i)) {
                        (true, Some(true)) => Purpose::Touch,
                        (true, _) => Purpose::Position,
                        // After a touch it is a retract; otherwise it is an unwatched positioning move.
                        (false, _)
                            if self.unwatched
                                && steps.last().is_none_or(|s| s.purpose != Purpose::Touch) =>
                        {
                            Purpose::Position
                        }
                        (false, _) => Purpose::Back,
                    };
                    let [Some(x), Some(y), Some(z)] = at else {
                        if steps.is_empty() && purpose != Purpose::Touch {
                            continue;
                        }
                        let message = "the first moves must name X, Y and Z".to_owned();
                        return Err(Trouble {
                            line: block.line,
                            message,
                        });
                    };
                    let number = number.filter(|_| purpose != Purpose::Back);
                    let step = Step {
                        line: block.line,
                        number,
                        purpose,
                        to: [x, y, z],
                        feed,
                    };
                    match steps.last_mut() {
                        Some(first)
                            if i > 0
                                && first.number == number
                                && first.to == step.to
                                && purpose != Purpose::Touch =>
                        {
                            *first = step;
                        }
                        _ => steps.push(step),
                    }
                }
                _ => {}
            }
        }
        Ok(steps)
    }
}
