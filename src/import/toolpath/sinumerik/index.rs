//! Where the lines of a SINUMERIK program are that something jumps to.

use crate::control::iso::lex::{code, head, line_end};
use crate::import::toolpath::calls::Place;

/// A word of a condition or a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    If,
    Else,
    EndIf,
    While,
    EndWhile,
    For,
    EndFor,
    Loop,
    EndLoop,
    Repeat,
    Until,
}

const STRUCTURES: [(&str, Structure); 11] = [
    ("IF", Structure::If),
    ("ELSE", Structure::Else),
    ("ENDIF", Structure::EndIf),
    ("WHILE", Structure::While),
    ("ENDWHILE", Structure::EndWhile),
    ("FOR", Structure::For),
    ("ENDFOR", Structure::EndFor),
    ("LOOP", Structure::Loop),
    ("ENDLOOP", Structure::EndLoop),
    ("REPEAT", Structure::Repeat),
    ("UNTIL", Structure::Until),
];

impl Structure {
    /// That a block in capitals begins with. `IF` with a jump, and `REPEAT` with a label, are none.
    pub fn of(code: &str) -> Option<Self> {
        let length = code
            .bytes()
            .take_while(|b| b.is_ascii_alphanumeric() || *b == b'_')
            .count();
        let (_, structure) = STRUCTURES
            .iter()
            .find(|(word, _)| *word == &code[..length])?;
        let jumps = *structure == Structure::If && code.contains("GOTO");
        let labelled = *structure == Structure::Repeat && !code[length..].trim().is_empty();
        (!jumps && !labelled).then_some(*structure)
    }

    fn closes(self, begin: Structure) -> bool {
        matches!(
            (begin, self),
            (Structure::If, Structure::EndIf)
                | (Structure::While, Structure::EndWhile)
                | (Structure::For, Structure::EndFor)
                | (Structure::Loop, Structure::EndLoop)
                | (Structure::Repeat, Structure::Until)
        )
    }
}

/// A condition or a loop: its first line, its ELSE, and its last line.
#[derive(Debug)]
struct Span {
    begin: Place,
    other: Option<(usize, Place)>,
    end: usize,
    below: Place,
}

/// One that is open yet.
struct Open {
    structure: Structure,
    begin: Place,
    other: Option<(usize, Place)>,
}

/// What a line does to the way of a program, where it does.
#[derive(Clone, Debug, PartialEq)]
enum Turn {
    /// It ends the program: by an alarm (true), or as planned.
    Ends(bool),
    Back,
    Jumps(String, bool),
}

/// The lines of a text that something jumps to.
#[derive(Debug, Default)]
pub struct Index {
    spans: Vec<Span>,
    labels: Vec<(String, Place)>,
    turns: Vec<(usize, Turn)>,
    /// Names of subprograms: where the lines begin, the parameters, and the last line.
    subprograms: Vec<(String, Place, Vec<String>, usize)>,
}

/// A block in capitals without the label in front of it.
pub fn without_label(code: &str) -> &str {
    label_of(code).map_or(code, |label| code[label.len() + 1..].trim_start())
}

fn label_of(code: &str) -> Option<&str> {
    let length = code
        .bytes()
        .take_while(|b| b.is_ascii_alphanumeric() || *b == b'_')
        .count();
    let begins = code.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    (begins && code[length..].starts_with(':')).then(|| &code[..length])
}

impl Index {
    pub fn of(text: &str) -> Self {
        let bytes = text.as_bytes();
        let mut index = Index::default();
        let mut open: Vec<Open> = Vec::new();
        let (mut at, mut line) = (0, 0);
        while at < bytes.len() {
            let (end, next) = line_end(bytes, at);
            let (here, below) = (
                Place { at, line },
                Place {
                    at: next,
                    line: line + 1,
                },
            );
            let plain = code(text[at..end].trim(), false).to_ascii_uppercase();
            let block = plain[head(plain.as_bytes()).end..].trim();
            if let Some(name) = block
                .strip_prefix("%_N_")
                .and_then(|name| name.split('_').next())
            {
                index.program(name, below, Vec::new());
            }
            if let Some(label) = label_of(block) {
                index.labels.push((label.to_owned(), here));
            }
            let block = without_label(block);
            match Structure::of(block) {
                Some(
                    begin @ (Structure::If
                    | Structure::While
                    | Structure::For
                    | Structure::Loop
                    | Structure::Repeat),
                ) => {
                    open.push(Open {
                        structure: begin,
                        begin: here,
                        other: None,
                    });
                }
                Some(Structure::Else) => {
                    if let Some(own) = open.last_mut().filter(|own| own.structure == Structure::If)
                    {
                        own.other = Some((line, below));
                    }
                }
                Some(close) => {
                    if open.last().is_some_and(|own| close.closes(own.structure))
                        && let Some(Open { begin, other, .. }) = open.pop()
                    {
                        index.spans.push(Span {
                            begin,
                            other,
                            end: line,
                            below,
                        });
                    }
                }
                None => {}
            }
            if let Some(rest) = block.strip_prefix("PROC ") {
                index.procedure(rest, below);
            }
            index.turns.extend(turn(block).map(|turn| (line, turn)));
            (at, line) = (next, line + 1);
        }
        if let Some((.., last)) = index.subprograms.last_mut() {
            *last = line;
        }
        index.spans.sort_by_key(|span| span.begin.line);
        index
    }

    /// `PROC NAME(REAL A, INT B=5) SAVE`.
    fn procedure(&mut self, rest: &str, below: Place) {
        let (name, rest) = rest.split_once('(').unwrap_or((rest, ""));
        let inner = rest.split(')').next().unwrap_or_default();
        let name = name.split_whitespace().next().unwrap_or_default();
        let of = |part: &str| {
            part.split('=')
                .next()
                .and_then(|part| part.split_whitespace().last())
                .map(str::to_owned)
        };
        self.program(name, below, inner.split(',').filter_map(of).collect());
    }

    fn program(&mut self, name: &str, below: Place, parameters: Vec<String>) {
        let before = below.line.saturating_sub(2);
        if let Some((.., last)) = self.subprograms.last_mut() {
            *last = before;
        }
        self.subprograms.retain(|(known, ..)| known != name);
        self.subprograms
            .push((name.to_owned(), below, parameters, usize::MAX));
    }

    /// A label: below a line, or else above it.
    pub fn label(&self, name: &str, line: usize) -> Option<Place> {
        let mut all = self
            .labels
            .iter()
            .filter(|(label, _)| label == name)
            .map(|(_, place)| *place);
        let above = all.clone().rfind(|place| place.line < line);
        all.find(|place| place.line >= line).or(above)
    }

    pub fn subprogram(&self, name: &str) -> Option<(Place, &[String], usize)> {
        let (_, begin, parameters, last) =
            self.subprograms.iter().find(|(known, ..)| known == name)?;
        Some((*begin, parameters, *last))
    }

    /// The place below the ELSE of an IF, and the line of its ENDIF.
    pub fn branches(&self, line: usize) -> Option<(Option<Place>, Place)> {
        let span = self.span(line)?;
        Some((span.other.map(|(_, below)| below), span.below))
    }

    fn span(&self, line: usize) -> Option<&Span> {
        self.spans.iter().find(|span| span.begin.line == line)
    }

    /// Below the end of what begins or has its ELSE in a line.
    pub fn end(&self, line: usize) -> Option<Place> {
        let own = |span: &&Span| {
            span.begin.line == line || span.other.is_some_and(|(other, _)| other == line)
        };
        self.spans.iter().find(own).map(|span| span.below)
    }

    /// Where the condition or the loop begins that a line closes, or whose ELSE it is.
    pub fn begin(&self, line: usize) -> Option<Place> {
        let own =
            |span: &&Span| span.end == line || span.other.is_some_and(|(other, _)| other == line);
        self.spans.iter().find(own).map(|span| span.begin)
    }

    /// Whether the lines between two end the program, outside of conditions of their own.
    pub fn ends_before(&self, from: usize, to: usize) -> bool {
        let inside = self
            .spans
            .iter()
            .filter(|span| span.begin.line > from && span.end < to);
        let nested: Vec<(usize, usize)> = inside.map(|span| (span.begin.line, span.end)).collect();
        let own = self
            .turns
            .iter()
            .filter(|(line, _)| (from + 1..to).contains(line));
        let mut own = own.filter(|(line, _)| {
            nested
                .iter()
                .all(|(begin, end)| !(*begin..=*end).contains(line))
        });
        own.next().is_some_and(|(_, turn)| match turn {
            Turn::Ends(_) => true,
            Turn::Jumps(label, true) => {
                self.label(label, from).is_some_and(|to| self.leads_out(to))
            }
            _ => false,
        })
    }

    /// Whether the way from a place leads to an alarm, wherever else it may branch. A planned end may be that of the whole program.
    pub fn leads_out(&self, from: Place) -> bool {
        self.leads_out_within(from.line, &mut 200, 0)
    }

    fn leads_out_within(&self, mut at: usize, budget: &mut usize, depth: usize) -> bool {
        loop {
            let next = self.turns.partition_point(|(line, _)| *line < at);
            let Some((line, turn)) = self.turns.get(next).filter(|_| *budget > 0 && depth < 10)
            else {
                return false;
            };
            *budget -= 1;
            match turn {
                Turn::Ends(alarm) => return *alarm,
                Turn::Back => return false,
                Turn::Jumps(label, sure) => {
                    let Some(to) = self.label(label, line + 1) else {
                        return false;
                    };
                    if *sure {
                        at = to.line;
                    } else if self.leads_out_within(to.line, budget, depth + 1) {
                        at = line + 1;
                    } else {
                        return false;
                    }
                }
            }
        }
    }
}

/// What a block in capitals does to the way of the program.
fn turn(code: &str) -> Option<Turn> {
    let first = code.split_whitespace().next()?;
    let alarm = code.starts_with("SETAL(");
    if alarm || matches!(first, "M2" | "M02" | "M30") {
        return Some(Turn::Ends(alarm));
    }
    if matches!(first, "M17" | "RET") || first.starts_with("PROC") || first.starts_with("%_N_") {
        return Some(Turn::Back);
    }
    let at = code.find("GOTO")?;
    let target = code[at + 4..]
        .trim_start_matches(['F', 'B', 'C'])
        .split_whitespace()
        .next()?;
    Some(Turn::Jumps(target.to_owned(), at == 0))
}
