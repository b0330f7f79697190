//! Index of the jump targets of a text: structures, subroutines, labels, numbers.

use std::collections::BTreeMap;

use crate::control::iso::lex::{head, line_end, program_number};
use crate::import::toolpath::calls::Place;
use crate::import::toolpath::script::grammar::{Grammar, Keyword, Language};
use crate::import::toolpath::script::statement::{
    Structure, Turn, capitals, heidenhain_code, heidenhain_label, heidenhain_turn, label,
    structure, turn, without_comment, without_label,
};

/// Largest number of structures examined for the end of one, and of known programs in a text: it bounds the search.
const MOST_LOOKED: usize = 4000;

/// Largest number of open structures without an end.
const MOST_OPEN: usize = 500;

/// A further branch of a condition.
#[derive(Debug)]
pub struct Branch {
    /// `None` for an `else`.
    pub condition: Option<Vec<u8>>,
    pub here: Place,
    pub below: Place,
}

/// A condition or a loop of a text.
#[derive(Debug)]
pub struct Span {
    pub keyword: Keyword,
    pub label: String,
    pub begin: Place,
    /// The line below its first one.
    pub below: Place,
    pub branches: Vec<Branch>,
    /// Its last line and the line below. A structure that ends by indentation has no last line: both are the first line after it. `None` without an end.
    pub end: Option<(Place, Place)>,
}

/// A call, or an exit from a structure.
#[derive(Debug)]
struct Mark {
    keyword: Keyword,
    label: String,
    line: usize,
}

/// A subprogram: start of its lines, line of its end, and names of its parameters.
#[derive(Clone, Debug)]
pub struct Subprogram {
    pub name: String,
    pub begin: Place,
    pub end: usize,
    pub parameters: Vec<String>,
}

/// Jump targets of a text.
#[derive(Debug, Default)]
pub struct Index {
    spans: Vec<Span>,
    /// Index of the span that a line begins, continues or ends.
    at: BTreeMap<usize, usize>,
    marks: Vec<Mark>,
    /// Lines that change the course of the program.
    turns: Vec<(usize, Turn)>,
    /// Subprograms by name.
    subprograms: Vec<Subprogram>,
    /// For each defined subroutine, the line below its end.
    definitions: BTreeMap<usize, Place>,
    labels: BTreeMap<String, Vec<Place>>,
    /// Files after the program, which it calls by name.
    files: Vec<Subprogram>,
    /// Blocks by number.
    blocks: Vec<(u32, Place)>,
    /// Programs by number, with the lines below their numbers.
    programs: Vec<(u32, Place)>,
    lines: usize,
}

/// Name of a file in small letters, without folder and extension: `0:/macros/Probe.g` is probe, and `G6512.1.g` is g6512.1.
fn base_name(name: &str) -> String {
    let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let ending = name.rsplit_once('.').filter(|(_, ending)| {
        !ending.is_empty() && ending.bytes().all(|b| b.is_ascii_alphabetic())
    });
    ending.map_or(name, |(base, _)| base).to_ascii_lowercase()
}

/// Open structures while a text is read.
#[derive(Default)]
struct Open {
    /// Spans without an end so far.
    spans: Vec<usize>,
    /// Subroutines without an end so far, with their own lines.
    subs: Vec<(String, usize, Place)>,
    /// Indentation of the lines of the spans.
    indents: Vec<usize>,
}

impl Index {
    /// `files` are those after the program: first line and name of each.
    pub fn of(text: &str, grammar: &Grammar, files: &[(u32, String)]) -> Self {
        let language = grammar.language;
        let bytes = text.as_bytes();
        let (mut index, mut open) = (Index::default(), Open::default());
        let (mut at, mut line) = (0, 0);
        while at < bytes.len() {
            let (end, next) = line_end(bytes, at);
            let here = Place { at, line };
            let below = Place {
                at: next,
                line: line + 1,
            };
            if let Some((_, name)) = files.iter().find(|(first, _)| *first as usize == line) {
                index.dedents(0, false, here, &mut open);
                index.file(name, here);
            }
            let code = bytes[at..end].trim_ascii();
            match language {
                Language::Sinumerik => {
                    index.number(code, here);
                    index.sinumerik(&capitals(code), here, below, &mut open, grammar);
                }
                Language::Heidenhain => {
                    let code = heidenhain_code(code);
                    if let Some(number) = heidenhain_label(&code) {
                        let places = index.labels.entry(number.to_string()).or_default();
                        places.push(here);
                    }
                    let turn = heidenhain_turn(&code);
                    index.turns.extend(turn.map(|turn| (here.line, turn)));
                }
                _ if grammar.is_indented => {
                    let raw = &bytes[at..end];
                    let indent = raw.iter().take_while(|b| b.is_ascii_whitespace()).count();
                    let code = without_comment(code, None);
                    index.indented(code, indent, here, below, &mut open, grammar);
                }
                _ => {
                    let begin = index.number(code, here);
                    let code = if grammar.words.is_empty() {
                        &code[begin..]
                    } else {
                        without_comment(&code[begin..], grammar.comment)
                    };
                    index.block(code, here, below, &mut open, grammar);
                }
            }
            (at, line) = (next, line + 1);
        }
        index.lines = line;
        index.close_file(line);
        if grammar.is_indented {
            index.dedents(0, false, Place { at, line }, &mut open);
        }
        // By number, and for each number by line.
        index
            .blocks
            .sort_by_key(|(number, place)| (*number, place.line));
        index.programs.truncate(MOST_LOOKED);
        if language == Language::Sinumerik {
            let after: Vec<usize> = index
                .subprograms
                .iter()
                .skip(1)
                .map(|next| next.begin.line.saturating_sub(2))
                .chain([line])
                .collect();
            for (own, end) in index.subprograms.iter_mut().zip(after) {
                own.end = end;
            }
        }
        index.subprograms.sort_by(|a, b| a.name.cmp(&b.name));
        if language == Language::Sinumerik {
            // The last one with a name counts.
            index.subprograms.reverse();
            index.subprograms.dedup_by(|a, b| a.name == b.name);
            index.subprograms.reverse();
        }
        index
    }

    /// A file of subprograms begins.
    fn file(&mut self, name: &str, begin: Place) {
        self.close_file(begin.line);
        self.files.push(Subprogram {
            name: base_name(name),
            begin,
            end: usize::MAX,
            parameters: Vec::new(),
        });
    }

    fn close_file(&mut self, line: usize) {
        if let Some(file) = self.files.last_mut().filter(|file| file.end == usize::MAX) {
            file.end = line;
        }
    }

    /// The file with a name, ignoring case and extension.
    pub fn file_named(&self, name: &str) -> Option<&Subprogram> {
        let name = base_name(name);
        self.files.iter().find(|file| file.name == name)
    }

    /// Adds a label of a program that does not consist of text lines.
    pub fn adds_label(&mut self, name: String, here: Place) {
        self.labels.entry(name).or_default().push(here);
    }

    /// Adds a turn of such a program, in the order of its blocks.
    pub fn adds_turn(&mut self, here: Place, turn: Turn) {
        self.turns.push((here.line, turn));
    }

    fn indented(
        &mut self,
        code: &[u8],
        indent: usize,
        here: Place,
        below: Place,
        open: &mut Open,
        grammar: &Grammar,
    ) {
        if code.is_empty() {
            return;
        }
        let goes_on = structure(code, grammar)
            .is_some_and(|own| matches!(own.keyword, Keyword::ElseIf | Keyword::Else));
        self.dedents(indent, goes_on, here, open);
        let before = open.spans.len();
        self.block(code, here, below, open, grammar);
        if open.spans.len() > before {
            open.indents.push(indent);
        }
    }

    /// Ends the structures that are indented at least as far as a line, before it, except for the `if` that it continues.
    fn dedents(&mut self, indent: usize, goes_on: bool, here: Place, open: &mut Open) {
        while let Some(own) = open.indents.last() {
            let at = open.spans[open.indents.len() - 1];
            let is_its_if = goes_on && *own == indent && self.spans[at].keyword == Keyword::If;
            if *own < indent || is_its_if {
                return;
            }
            open.indents.pop();
            open.spans.truncate(open.indents.len());
            self.spans[at].end = Some((here, here));
        }
    }

    /// Records the number of a block. Returns the start of its code.
    fn number(&mut self, line: &[u8], here: Place) -> usize {
        let head = head(line);
        if let Some(number) = head.number {
            self.blocks.push((number, here));
        }
        head.end
    }

    fn sinumerik(
        &mut self,
        code: &[u8],
        here: Place,
        below: Place,
        open: &mut Open,
        grammar: &Grammar,
    ) {
        if let Some(own) = label(code) {
            let name = String::from_utf8_lossy(own).into_owned();
            self.labels.entry(name).or_default().push(here);
        }
        let block = without_label(code);
        let text = String::from_utf8_lossy(block);
        let name = text
            .strip_prefix("%_N_")
            .and_then(|name| name.split('_').next());
        if let Some(name) = name {
            self.subprogram(name, below, Vec::new());
        }
        if let Some(rest) = text.strip_prefix("PROC ") {
            self.procedure(rest, below);
        }
        self.block(block, here, below, open, grammar);
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
        self.subprogram(name, below, inner.split(',').filter_map(of).collect());
    }

    fn subprogram(&mut self, name: &str, begin: Place, parameters: Vec<String>) {
        self.subprograms.push(Subprogram {
            name: name.to_owned(),
            begin,
            end: usize::MAX,
            parameters,
        });
    }

    fn block(
        &mut self,
        code: &[u8],
        here: Place,
        below: Place,
        open: &mut Open,
        grammar: &Grammar,
    ) {
        self.turns
            .extend(turn(code, grammar).map(|turn| (here.line, turn)));
        match structure(code, grammar) {
            Some(own) => self.structure(own, code, here, below, open),
            None if grammar.language != Language::Sinumerik
                && matches!(code.first(), Some(b'O' | b'o')) =>
            {
                self.programs
                    .extend(program_number(code).map(|number| (number, below)));
            }
            None => {}
        }
    }

    fn structure(
        &mut self,
        own: Structure,
        code: &[u8],
        here: Place,
        below: Place,
        open: &mut Open,
    ) {
        let is_nested = own.label.is_empty();
        // The structure of the word: by its label, or the innermost one.
        let innermost = |spans: &[Span], open: &[usize], ends: &dyn Fn(&Span) -> bool| {
            let is_own = |at: &usize| spans[*at].label == own.label;
            let last = open.len().saturating_sub(MOST_OPEN);
            let found = last + open[last..].iter().rposition(is_own)?;
            (ends(&spans[open[found]]) && (!is_nested || found + 1 == open.len())).then_some(found)
        };
        match own.keyword {
            Keyword::Sub => {
                open.subs.truncate(MOST_OPEN);
                open.subs.push((own.label, here.line, below));
            }
            Keyword::EndSub => {
                let found = open
                    .subs
                    .iter()
                    .rposition(|(label, ..)| is_nested || *label == own.label);
                if let Some((name, line, begin)) = found.map(|at| open.subs.remove(at)) {
                    self.definitions.insert(line, below);
                    self.subprograms.push(Subprogram {
                        name,
                        begin,
                        end: here.line,
                        parameters: Vec::new(),
                    });
                }
            }
            Keyword::Call | Keyword::Return | Keyword::Break | Keyword::Continue => {
                self.marks.push(Mark {
                    keyword: own.keyword,
                    label: own.label,
                    line: here.line,
                });
            }
            Keyword::ElseIf | Keyword::Else => {
                let is_if = |span: &Span| span.keyword == Keyword::If;
                if let Some(found) = innermost(&self.spans, &open.spans, &is_if) {
                    let at = open.spans[found];
                    let condition =
                        (own.keyword == Keyword::ElseIf).then(|| code[own.rest..].to_vec());
                    self.spans[at].branches.push(Branch {
                        condition,
                        here,
                        below,
                    });
                    self.at.insert(here.line, at);
                }
            }
            // The `while` of a `do` ends it.
            keyword => {
                let is_end = |span: &Span| {
                    span.keyword.end() == Some(keyword)
                        || keyword == Keyword::While && span.keyword == Keyword::Do
                        || keyword == Keyword::EndWhile && span.keyword == Keyword::Loop
                };
                match innermost(&self.spans, &open.spans, &is_end) {
                    Some(found) => {
                        let at = open.spans.remove(found);
                        self.spans[at].end = Some((here, below));
                        self.at.insert(here.line, at);
                    }
                    None if keyword.end().is_some() => {
                        open.spans.push(self.spans.len());
                        self.at.insert(here.line, self.spans.len());
                        self.spans.push(Span {
                            keyword,
                            label: own.label,
                            begin: here,
                            below,
                            branches: Vec::new(),
                            end: None,
                        });
                    }
                    None => {}
                }
            }
        }
    }

    /// The line below the subroutine that a line defines.
    pub fn below_definition(&self, line: usize) -> Option<Place> {
        self.definitions.get(&line).copied()
    }

    /// The structure that a line begins, continues or ends.
    pub fn span_at(&self, line: usize) -> Option<usize> {
        self.at.get(&line).copied()
    }

    pub fn span(&self, at: usize) -> &Span {
        &self.spans[at]
    }

    /// Whether every branch from a line leads to an alarm. A planned end may be that of the whole program, which a jump only reaches sooner.
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
            // Another program begins before it.
            if self.end_of_program(at).is_some_and(|end| end <= *line) {
                return false;
            }
            match turn {
                Turn::Ends(alarm) => return *alarm,
                Turn::Back | Turn::Somewhere => return false,
                Turn::Jumps(target, sure) => {
                    let Some(to) = self.target(target, line + 1) else {
                        return false;
                    };
                    if *sure {
                        // An endless loop does not end.
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

    /// Whether the only branch of a condition ends the program.
    pub fn is_ending(&self, at: usize) -> bool {
        let span = &self.spans[at];
        let Some((end, _)) = span.end.filter(|_| span.branches.is_empty()) else {
            return false;
        };
        let (from, to) = (span.begin.line, end.line);
        let first = self.marks.partition_point(|mark| mark.line <= from);
        let own = self.marks[first..]
            .iter()
            .take(MOST_LOOKED)
            .take_while(|mark| mark.line < to)
            .filter(|mark| !self.is_nested(from, mark.line));
        for mark in own {
            match mark.keyword {
                Keyword::Call => {
                    let called = self.subroutine(&mark.label);
                    if called.is_some_and(|sub| self.ends_between(sub.begin.line, sub.end)) {
                        return true;
                    }
                }
                _ => return false,
            }
        }
        self.ends_between(from + 1, to)
    }

    /// Whether the lines from one to another end the program, outside of inner structures.
    fn ends_between(&self, from: usize, to: usize) -> bool {
        let first = self.turns.partition_point(|(line, _)| *line < from);
        let mut own = self.turns[first..]
            .iter()
            .take(MOST_LOOKED)
            .take_while(|(line, _)| *line < to)
            .filter(|(line, _)| !self.is_nested(from.saturating_sub(1), *line));
        own.next().is_some_and(|(line, turn)| match turn {
            Turn::Ends(_) => true,
            Turn::Jumps(target, true) => self
                .target(target, line + 1)
                .is_some_and(|to| self.leads_out(to)),
            _ => false,
        })
    }

    /// Whether a line is inside a structure that begins after another line.
    fn is_nested(&self, from: usize, line: usize) -> bool {
        let first = self.spans.partition_point(|span| span.begin.line <= from);
        self.spans[first..]
            .iter()
            .take(MOST_LOOKED)
            .take_while(|span| span.begin.line < line)
            .any(|span| span.end.is_none_or(|(end, _)| end.line >= line))
    }

    /// The subroutine with this name; `None` if the text has no such subroutine, or several.
    pub fn subroutine(&self, name: &str) -> Option<&Subprogram> {
        let from = self
            .subprograms
            .partition_point(|own| own.name.as_str() < name);
        let found = self.subprograms.get(from).filter(|own| own.name == name)?;
        let next = self.subprograms.get(from + 1);
        next.is_none_or(|next| next.name != name).then_some(found)
    }

    /// The first subroutines in the first bytes that nothing in the text calls, the last first.
    pub fn uncalled(&self, before: usize) -> Vec<Subprogram> {
        const MOST_SHOWN: usize = 100;
        let mut called: Vec<&str> = self
            .marks
            .iter()
            .filter(|mark| mark.keyword == Keyword::Call)
            .map(|mark| mark.label.as_str())
            .collect();
        called.sort_unstable();
        let is_own = |own: &&Subprogram| {
            own.begin.at <= before
                && called.binary_search(&own.name.as_str()).is_err()
                && self.subroutine(&own.name).is_some()
        };
        let mut all: Vec<Subprogram> = self.subprograms.iter().filter(is_own).cloned().collect();
        all.sort_by_key(|own| own.begin.line);
        all.truncate(MOST_SHOWN);
        all.reverse();
        all
    }

    /// First and last line of a program; `None` if the text has no such program, or several.
    pub fn program(&self, number: u32) -> Option<(Place, usize)> {
        let mut all = self.programs.iter().filter(|(known, _)| *known == number);
        let ((_, begin), more) = (all.next()?, all.next());
        let end = || {
            self.end_of_program(begin.line)
                .map_or(self.lines, |line| line.saturating_sub(2))
        };
        more.is_none().then(|| (*begin, end()))
    }

    /// Start of the next program.
    fn end_of_program(&self, line: usize) -> Option<usize> {
        let next = self
            .programs
            .partition_point(|(_, place)| place.line <= line);
        self.programs.get(next).map(|(_, place)| place.line)
    }

    /// Target of a jump from above a line: a label, or the number of a block.
    pub fn target(&self, name: &str, line: usize) -> Option<Place> {
        if let Some(places) = self.labels.get(name) {
            let below = places.partition_point(|place| place.line < line);
            return places.get(below).or_else(|| places.last()).copied();
        }
        let number = name.strip_prefix('N').unwrap_or(name);
        self.numbered(number.parse().ok()?, line)
    }

    /// Position of a label; `None` if the text has it twice.
    pub fn only_label(&self, name: &str) -> Option<Place> {
        match self.labels.get(name)?.as_slice() {
            [place] => Some(*place),
            _ => None,
        }
    }

    /// Target block with this number for a jump from above a line: the next one below, or the first of its program.
    fn numbered(&self, number: u32, line: usize) -> Option<Place> {
        let own = self
            .programs
            .partition_point(|(_, place)| place.line <= line);
        let begin = self.programs[..own].last();
        let begin = begin.map_or(0, |(_, place)| place.line);
        let end = self.end_of_program(line).unwrap_or(usize::MAX);
        let from = |line: usize| {
            let at = self
                .blocks
                .partition_point(|(own, place)| (*own, place.line) < (number, line));
            self.blocks
                .get(at)
                .filter(|(own, place)| *own == number && place.line < end)
                .map(|(_, place)| *place)
        };
        from(line).or_else(|| from(begin))
    }
}
