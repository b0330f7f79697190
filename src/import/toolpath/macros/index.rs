//! Where the lines of a macro are that something jumps to.

use crate::control::iso::lex::{head, line_end, program_number};
use crate::import::toolpath::calls::Place;

/// What an O word does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keyword {
    Sub,
    EndSub,
    Return,
    Call,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    EndWhile,
    Do,
    Repeat,
    EndRepeat,
    Break,
    Continue,
}

const KEYWORDS: [(&str, Keyword); 15] = [
    ("sub", Keyword::Sub),
    ("endsub", Keyword::EndSub),
    ("return", Keyword::Return),
    ("call", Keyword::Call),
    ("if", Keyword::If),
    ("elseif", Keyword::ElseIf),
    ("else", Keyword::Else),
    ("endif", Keyword::EndIf),
    ("while", Keyword::While),
    ("endwhile", Keyword::EndWhile),
    ("do", Keyword::Do),
    ("repeat", Keyword::Repeat),
    ("endrepeat", Keyword::EndRepeat),
    ("break", Keyword::Break),
    ("continue", Keyword::Continue),
];

/// An O word: its label, what it does, and where in the code the rest begins. None with a computed label.
pub fn o_word(code: &[u8]) -> Option<(String, Keyword, usize)> {
    let rest = code.get(1..)?;
    let length = match rest.first()? {
        b'<' => rest.iter().position(|b| *b == b'>')? + 1,
        _ => rest
            .iter()
            .take_while(|b| b.is_ascii_digit() || **b == b' ')
            .count(),
    };
    let plain = rest[..length]
        .iter()
        .filter(|b| !b.is_ascii_whitespace())
        .map(|b| char::from(b.to_ascii_lowercase()));
    let label: String = plain.collect();
    let blanks = rest[length..]
        .iter()
        .take_while(|b| b.is_ascii_whitespace())
        .count();
    let begin = 1 + length + blanks;
    let letters = code[begin..]
        .iter()
        .take_while(|b| b.is_ascii_alphabetic())
        .count();
    let word = &code[begin..begin + letters];
    let (_, keyword) = KEYWORDS
        .iter()
        .find(|(name, _)| word.eq_ignore_ascii_case(name.as_bytes()))?;
    (!label.is_empty()).then_some((label, *keyword, begin + letters))
}

/// What a block does to the way of the program.
fn turn(code: &[u8]) -> Option<Turn> {
    // Most blocks begin with a G code, or with an axis.
    let may = match code {
        [b'G' | b'g', next, ..] => next.eq_ignore_ascii_case(&b'O'),
        [first, ..] => matches!(first.to_ascii_uppercase(), b'M' | b'#' | b'(' | b'O' | b'I'),
        [] => false,
    };
    may.then_some(())?;
    let plain: Vec<u8> = code
        .iter()
        .filter(|b| !b.is_ascii_whitespace())
        .map(u8::to_ascii_uppercase)
        .collect();
    let is = |word: &[u8]| {
        plain.starts_with(word) && !plain.get(word.len()).is_some_and(u8::is_ascii_digit)
    };
    let alarm = plain.starts_with(b"#3000=") || plain.starts_with(b"(ABORT,");
    if alarm || is(b"M2") || is(b"M02") || is(b"M30") {
        return Some(Turn::Ends(alarm));
    }
    if is(b"M99") {
        return Some(Turn::Back);
    }
    if plain.first() == Some(&b'O') {
        let (_, keyword, _) = o_word(code)?;
        return matches!(keyword, Keyword::EndSub | Keyword::Return).then_some(Turn::Back);
    }
    let at = plain.windows(4).position(|word| word == b"GOTO")?;
    let digits = &plain[at + 4..];
    let digits = &digits[..digits.iter().take_while(|b| b.is_ascii_digit()).count()];
    let number = std::str::from_utf8(digits)
        .ok()
        .and_then(|digits| digits.parse().ok());
    match (number, at == 0 || plain.starts_with(b"IF")) {
        (Some(number), true) => Some(Turn::Jumps(number, at == 0)),
        _ => Some(Turn::Somewhere),
    }
}

/// The label of `DO 1` and `END 1`.
pub fn do_label(number: f64) -> String {
    "do".to_owned() + &crate::num::decimal(number.trunc(), 0)
}

impl Keyword {
    /// Whether the program may continue elsewhere for it, and not only in a structure.
    pub fn jumps(self) -> bool {
        matches!(
            self,
            Keyword::Call | Keyword::Return | Keyword::Break | Keyword::Continue
        )
    }
}

/// An O word of the text, or an END.
#[derive(Debug)]
pub struct Mark {
    label: String,
    pub keyword: Keyword,
    /// The condition of an `elseif`.
    pub condition: Vec<u8>,
    pub here: Place,
    pub below: Place,
}

/// So many O words are looked at for the end of one, and so many programs of a text are known: a search has an end.
const MOST_LOOKED: usize = 4000;

/// What a line does to the way of a program, where it does.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Turn {
    /// It ends the program: by an alarm (true), or as planned.
    Ends(bool),
    /// It goes back to a caller.
    Back,
    /// It jumps to a block; under a condition, or always.
    Jumps(u32, bool),
    /// It jumps to a block that is not known.
    Somewhere,
}

/// The lines of a text that something jumps to.
#[derive(Debug, Default)]
pub struct Index {
    marks: Vec<Mark>,
    /// The lines that turn the way of the program.
    turns: Vec<(usize, Turn)>,
    /// Subroutines by label: where their lines begin, and the line of their end.
    subs: Vec<(String, Place, usize)>,
    /// Numbers of blocks, by number.
    blocks: Vec<(u32, Place)>,
    /// Numbers of programs, and the places below their lines.
    programs: Vec<(u32, Place)>,
    lines: usize,
}

impl Index {
    pub fn of(text: &str) -> Self {
        let bytes = text.as_bytes();
        let mut index = Index::default();
        let (mut at, mut line) = (0, 0);
        while at < bytes.len() {
            let (end, next) = line_end(bytes, at);
            index.line(
                bytes[at..end].trim_ascii(),
                Place { at, line },
                Place {
                    at: next,
                    line: line + 1,
                },
            );
            (at, line) = (next, line + 1);
        }
        index.lines = line;
        // By number, and of each by line.
        index
            .blocks
            .sort_by_key(|(number, place)| (*number, place.line));
        index.programs.truncate(MOST_LOOKED);
        let subs = index
            .marks
            .iter()
            .filter(|mark| mark.keyword == Keyword::Sub);
        let ends = |sub: &&Mark| {
            let end = index
                .below(sub.here.line)
                .find(|mark| mark.label == sub.label && mark.keyword == Keyword::EndSub)?;
            Some((sub.label.clone(), sub.below, end.here.line))
        };
        let mut subs: Vec<_> = subs.filter_map(|sub| ends(&sub)).collect();
        subs.sort_by(|(a, ..), (b, ..)| a.cmp(b));
        index.subs = subs;
        index
    }

    fn line(&mut self, text: &[u8], here: Place, below: Place) {
        let head = head(text);
        if let Some(number) = head.number {
            self.blocks.push((number, here));
        }
        let code = &text[head.end..];
        self.turns.extend(turn(code).map(|turn| (here.line, turn)));
        match code.first().map(u8::to_ascii_uppercase) {
            Some(b'O') => match o_word(code) {
                Some((label, keyword, rest)) => {
                    let condition = if keyword == Keyword::ElseIf {
                        code[rest..].to_vec()
                    } else {
                        Vec::new()
                    };
                    self.marks.push(Mark {
                        label,
                        keyword,
                        condition,
                        here,
                        below,
                    });
                }
                None => self
                    .programs
                    .extend(program_number(code).map(|number| (number, below))),
            },
            Some(b'E') if code.len() > 3 && code[..3].eq_ignore_ascii_case(b"END") => {
                let digits = code[3..].trim_ascii();
                let digits = &digits[..digits.iter().take_while(|b| b.is_ascii_digit()).count()];
                let number = std::str::from_utf8(digits)
                    .ok()
                    .and_then(|digits| digits.parse::<u32>().ok());
                let mark = |number: u32| Mark {
                    label: do_label(f64::from(number)),
                    keyword: Keyword::EndWhile,
                    condition: Vec::new(),
                    here,
                    below,
                };
                self.marks.extend(number.map(mark));
            }
            _ => {}
        }
    }

    /// Whether the way from a place leads to an alarm, wherever else it may branch. A planned end may be that of the whole program, which a jump only
    /// comes to sooner.
    pub fn leads_out(&self, from: Place) -> bool {
        self.leads_out_within(from, &mut 200, 0)
    }

    fn leads_out_within(&self, from: Place, budget: &mut usize, depth: usize) -> bool {
        let mut at = from.line;
        loop {
            let next = self.turns.partition_point(|(line, _)| *line < at);
            let Some((line, turn)) = self.turns.get(next).filter(|_| *budget > 0 && depth < 10)
            else {
                return false;
            };
            *budget -= 1;
            // Another program begins before it.
            if self.end_of_program(at).is_some_and(|end| end <= *line) {
                return false;
            }
            let below = Place {
                at: 0,
                line: line + 1,
            };
            match turn {
                Turn::Ends(alarm) => return *alarm,
                Turn::Back | Turn::Somewhere => return false,
                Turn::Jumps(number, sure) => {
                    let Some(to) = self.block(*number, below) else {
                        return false;
                    };
                    if *sure {
                        // Round and round it does not end.
                        at = to.line;
                    } else if self.leads_out_within(to, budget, depth + 1) {
                        at = line + 1;
                    } else {
                        return false;
                    }
                }
            }
        }
    }

    /// Whether the first branch of the `if` of a label ends the program: then the place below its `endif`, where it has no other branch.
    pub fn ending_branch(&self, label: &str, line: usize) -> Option<Place> {
        let end = self
            .branch_below(label, line)
            .filter(|mark| mark.keyword == Keyword::EndIf)?;
        let mut depth = 0;
        let marks = self
            .below(line)
            .take_while(|mark| mark.here.line < end.here.line);
        for mark in marks {
            match mark.keyword {
                Keyword::If => depth += 1,
                Keyword::EndIf => depth -= 1,
                Keyword::Return | Keyword::Break | Keyword::Continue if depth == 0 => return None,
                Keyword::Call
                    if depth == 0
                        && self
                            .subroutine(&mark.label)
                            .is_some_and(|(begin, _)| self.ends_within(begin.line, mark)) =>
                {
                    return Some(end.below);
                }
                _ => {}
            }
        }
        let first = self.turns[self.turns.partition_point(|(turn, _)| *turn <= line)..].iter();
        let mut own = first
            .take_while(|(turn, _)| *turn < end.here.line)
            .filter(|(turn, _)| !self.is_nested(line, *turn));
        own.next()
            .filter(|(_, turn)| matches!(turn, Turn::Ends(_)))
            .map(|_| end.below)
    }

    /// Whether the lines of a subroutine end the program before it goes back, outside of its conditions.
    fn ends_within(&self, begin: usize, call: &Mark) -> bool {
        let end = self
            .below(begin.saturating_sub(1))
            .find(|mark| mark.label == call.label && mark.keyword == Keyword::EndSub);
        let Some(end) = end else { return false };
        let inside = self.turns[self.turns.partition_point(|(line, _)| *line < begin)..].iter();
        let mut own = inside
            .take_while(|(line, _)| *line < end.here.line)
            .filter(|(line, _)| !self.is_nested(begin.saturating_sub(1), *line));
        own.next()
            .is_some_and(|(_, turn)| matches!(turn, Turn::Ends(_)))
    }

    /// Whether a line below another one is inside of an `if` or a loop that begins between them.
    fn is_nested(&self, from: usize, line: usize) -> bool {
        let between = self.below(from).take_while(|mark| mark.here.line < line);
        let depth = between.fold(0, |depth, mark| match mark.keyword {
            Keyword::If | Keyword::Do | Keyword::Repeat => depth + 1,
            Keyword::EndIf | Keyword::EndRepeat | Keyword::EndWhile => depth - 1,
            _ => depth,
        });
        depth > 0
    }

    /// Whether a block is one of a Fanuc's that jump or loop.
    pub fn is_flow(&self, code: &[u8]) -> bool {
        let follows = |word: &str, next: fn(u8) -> bool| {
            code.get(..word.len())
                .is_some_and(|begin| begin.eq_ignore_ascii_case(word.as_bytes()))
                && code[word.len()..]
                    .iter()
                    .find(|b| **b != b' ')
                    .is_some_and(|b| next(*b))
        };
        let open = |b: u8| b == b'[';
        let digit = |b: u8| b.is_ascii_digit() || b == b'#' || b == b'[';
        follows("IF", open)
            || follows("WHILE", open)
            || follows("GOTO", digit)
            || follows("END", digit)
            || follows("DO", digit)
    }

    /// The O words below a line, and the END, as far as is looked.
    fn below(&self, line: usize) -> impl Iterator<Item = &Mark> {
        self.marks[self.marks.partition_point(|mark| mark.here.line <= line)..]
            .iter()
            .take(MOST_LOOKED)
    }

    /// Those above it, the nearest first.
    fn above(&self, line: usize) -> impl Iterator<Item = &Mark> {
        self.marks[..self.marks.partition_point(|mark| mark.here.line < line)]
            .iter()
            .rev()
            .take(MOST_LOOKED)
    }

    /// Below the first of these words of a label that comes after a line.
    pub fn find(&self, label: &str, keywords: &[Keyword], line: usize) -> Option<Place> {
        let mark = self
            .below(line)
            .find(|mark| mark.label == label && keywords.contains(&mark.keyword))?;
        Some(mark.below)
    }

    /// The line that closes the loop of a label around a line: its `endwhile` or `endrepeat`, or the `while` of its `do`.
    pub fn closing_word(&self, label: &str, line: usize) -> Option<Place> {
        let ends = [Keyword::EndWhile, Keyword::EndRepeat, Keyword::While];
        self.below(line)
            .find(|mark| mark.label == label && ends.contains(&mark.keyword))
            .map(|mark| mark.here)
    }

    /// Below that line.
    pub fn end_of_loop(&self, label: &str, line: usize) -> Option<Place> {
        self.find(
            label,
            &[Keyword::EndWhile, Keyword::EndRepeat, Keyword::While],
            line,
        )
    }

    /// The next `elseif`, `else` or `endif` of a label.
    pub fn branch_below(&self, label: &str, line: usize) -> Option<&Mark> {
        let wanted = [Keyword::ElseIf, Keyword::Else, Keyword::EndIf];
        self.below(line)
            .find(|mark| mark.label == label && wanted.contains(&mark.keyword))
    }

    /// Whether a `while` closes a `do` of its label above it.
    pub fn closes_do(&self, label: &str, line: usize) -> bool {
        let begins = |mark: &&Mark| !matches!(mark.keyword, Keyword::Break | Keyword::Continue);
        let before = self
            .above(line)
            .filter(|mark| mark.label == label)
            .find(begins);
        before.is_some_and(|mark| mark.keyword == Keyword::Do)
    }

    /// Where the lines of a subroutine begin, and the line of its end; none where it is not there once.
    pub fn subroutine(&self, label: &str) -> Option<(Place, usize)> {
        let from = self.subs.partition_point(|(own, ..)| own.as_str() < label);
        let (_, begin, end) = self.subs.get(from).filter(|(own, ..)| own == label)?;
        let more = self
            .subs
            .get(from + 1)
            .is_some_and(|(own, ..)| own == label);
        (!more).then_some((*begin, *end))
    }

    /// The first subroutines of the first bytes that nothing in the text calls, the last first: label, where the lines begin, and the line of the end.
    pub fn uncalled(&self, before: usize) -> Vec<(String, Place, usize)> {
        const MOST_SHOWN: usize = 100;
        let mut called: Vec<&str> = self
            .marks
            .iter()
            .filter(|mark| mark.keyword == Keyword::Call)
            .map(|mark| mark.label.as_str())
            .collect();
        called.sort_unstable();
        let own =
            |label: &str| called.binary_search(&label).is_err() && self.subroutine(label).is_some();
        let mut all: Vec<_> = self
            .subs
            .iter()
            .filter(|(label, begin, _)| begin.at <= before && own(label))
            .cloned()
            .collect();
        all.sort_by_key(|(_, begin, _)| begin.line);
        all.truncate(MOST_SHOWN);
        all.reverse();
        all
    }

    /// Where the lines of a program begin, and its last line; none where it is not there once.
    pub fn program(&self, number: u32) -> Option<(Place, usize)> {
        let mut all = self.programs.iter().filter(|(known, _)| *known == number);
        let ((_, begin), more) = (all.next()?, all.next());
        more.is_none().then(|| {
            (
                *begin,
                self.end_of_program(begin.line)
                    .map_or(self.lines, |line| line.saturating_sub(2)),
            )
        })
    }

    /// Where the lines of the next program begin.
    fn end_of_program(&self, line: usize) -> Option<usize> {
        self.programs
            .get(
                self.programs
                    .partition_point(|(_, place)| place.line <= line),
            )
            .map(|(_, place)| place.line)
    }

    /// The block of this number that a jump from above `next` goes to: the next one below, or the first of its program.
    pub fn block(&self, number: u32, next: Place) -> Option<Place> {
        let begin = self.programs[..self
            .programs
            .partition_point(|(_, place)| place.line <= next.line)]
            .last();
        let begin = begin.map_or(0, |(_, place)| place.line);
        let end = self.end_of_program(next.line).unwrap_or(usize::MAX);
        let from = |line: usize| {
            let at = self
                .blocks
                .partition_point(|(own, place)| (*own, place.line) < (number, line));
            self.blocks
                .get(at)
                .filter(|(own, place)| *own == number && place.line < end)
                .map(|(_, place)| *place)
        };
        from(next.line).or_else(|| from(begin))
    }
}
