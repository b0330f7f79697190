//! The word-address writer that posts share: blocks of G words, axis words and feeds.

use crate::geom::{AXIS_NAMES, Vec3};
use crate::num::decimal;
use crate::path::{Move, Purpose};
use crate::post::{Program, Request, comment_text};

/// How a control's blocks are written, beyond what every word-address control shares.
#[derive(Debug)]
pub struct Dialect {
    /// Decimals of lengths and feeds in mm.
    pub decimals_mm: usize,
    /// Decimals of lengths and feeds in inch.
    pub decimals_inch: usize,
    /// The word that probes towards the part and stops with an alarm where nothing is met.
    pub probe: &'static str,
    /// What a comment begins and ends with.
    pub comment: (&'static str, &'static str),
    /// The words for mm and inch.
    pub units: (&'static str, &'static str),
    /// Exact stop, and everything modal that must not leak in, but for plane and units.
    pub modes: &'static str,
    /// What says that centres of arcs are counted from where the arc begins, where a program has arcs.
    pub arcs: &'static str,
}

/// Writes a program block by block and remembers which block makes which move.
#[derive(Debug)]
pub struct Writer<'a> {
    request: &'a Request<'a>,
    dialect: &'static Dialect,
    text: String,
    lines: usize,
    move_lines: Vec<Option<usize>>,
    last: [String; 3],
    /// Where the ball stands at the end of the last move.
    at: Option<Vec3>,
}

impl<'a> Writer<'a> {
    /// An empty program.
    pub fn new(request: &'a Request<'a>, dialect: &'static Dialect) -> Self {
        let move_lines = Vec::with_capacity(request.path.moves.len());
        Writer { request, dialect, text: String::with_capacity(4096), lines: 0, move_lines, last: Default::default(), at: None }
    }

    /// One line.
    pub fn line(&mut self, text: &str) {
        debug_assert!(!text.contains(['\n', '\r']), "a line is one line");
        self.text.push_str(text);
        self.text.push('\n');
        self.lines += 1;
    }

    /// A comment line. Whatever is in `text`, it stays inside.
    pub fn comment(&mut self, text: &str) {
        debug_assert!(!text.contains(['(', ')', '\n', '\r']), "comments are made of safe text");
        let (open, close) = self.dialect.comment;
        self.line(&format!("{open}{text}{close}"));
    }

    /// A length or feed in the program's units, with the decimals the control takes.
    pub fn number(&self, mm: f64) -> String {
        decimal(mm / self.request.scale, self.decimals())
    }

    /// The first lines: what will happen, in which units, with which stylus.
    pub fn header(&mut self, offset: &str) {
        let request = self.request;
        let unit = if request.scale == 1.0 { "mm" } else { "inch" };
        self.comment(&format!("Job: {}", comment_text(request.name)));
        self.comment(&format!("{}: {}", request.source, request.title));
        self.comment(&format!(
            "Units {unit}, plane {}, stylus ball diameter {}, overtravel {}",
            request.plane.word(),
            self.number(2.0 * request.setup.radius),
            self.number(request.setup.overtravel)
        ));
        self.comment(offset);
        self.comment("Before the start: stylus in the spindle, its length active");
        if let Some(first) = request.path.moves.first() {
            let place: Vec<String> = (0..3).map(|i| format!("{}{}", AXIS_NAMES[i], self.number(first.to[i]))).collect();
            self.comment(&format!("and a free straight way to {}", place.join(" ")));
        }
    }

    /// Units and modes: stated, never inherited. The spindle and the coolant are off.
    pub fn modes(&mut self) {
        let request = self.request;
        self.line(if request.scale == 1.0 { self.dialect.units.0 } else { self.dialect.units.1 });
        let arcs = if request.path.moves.iter().any(|m| m.arc.is_some()) { self.dialect.arcs } else { "" };
        self.line(&format!("{} {}{arcs} G94", request.plane.word(), self.dialect.modes));
        self.line("M5 M9");
    }

    /// One move as one block. A touch runs on past its contact by the overtravel; the search past it is along the inverted
    /// target vector.
    pub fn motion(&mut self, step: &Move) {
        let request = self.request;
        let (word, target) = match step.purpose {
            Purpose::Touch(k) => {
                (self.dialect.probe, step.to - request.path.touches[k].vector * request.path.touches[k].search)
            }
            Purpose::Position | Purpose::Back(_) => match request.feeds.rate(step.feed) {
                Some(_) => ("G1", step.to),
                None => ("G0", step.to),
            },
        };
        let from = self.at.replace(step.to);
        let (mut word, mut centre) = (word, String::new());
        if let (Some(arc), Some(from)) = (step.arc, from) {
            word = if arc.sweep > 0.0 { "G3" } else { "G2" };
            let to_center = arc.center - from;
            let [a, o, _] = request.plane.axes();
            for axis in [a.min(o), a.max(o)] {
                centre.push_str(&format!(" {}{}", ["I", "J", "K"][axis], self.number(to_center[axis])));
            }
        }
        let mut block = word.to_owned();
        block.push_str(&self.axis_words(target));
        block.push_str(&centre);
        // An arc is cut at a stated feed only: where the rapid has no number, at that of the touches.
        let rate = request.feeds.rate(step.feed).or(step.arc.map(|_| request.feeds.work));
        if let Some(rate) = rate {
            block.push_str(&format!(" F{}", self.number(rate)));
        }
        self.makes_move();
        self.line(&block);
    }

    /// The next line makes the next move.
    pub fn makes_move(&mut self) {
        self.move_lines.push(Some(self.lines));
    }

    /// The control makes the next move by itself.
    pub fn leaves_move(&mut self) {
        self.move_lines.push(None);
    }

    /// The axis words of a block to `target`: all three, or those that differ from the last block.
    pub fn place(&mut self, target: Vec3, all: bool) -> String {
        if all {
            self.last = Default::default();
        }
        self.axis_words(target)
    }

    /// The finished program.
    pub fn finish(self) -> Program {
        Program { text: self.text, move_lines: self.move_lines }
    }

    /// The axis words that differ from the last block; all of them where none does, so that a block never is empty.
    fn axis_words(&mut self, target: Vec3) -> String {
        let words = [0, 1, 2].map(|i| format!(" {}{}", AXIS_NAMES[i], self.number(target[i])));
        let changed: String = (0..3).filter(|&i| words[i] != self.last[i]).map(|i| words[i].as_str()).collect();
        let block = if changed.is_empty() { words.concat() } else { changed };
        self.last = words;
        block
    }

    fn decimals(&self) -> usize {
        if self.request.scale == 1.0 { self.dialect.decimals_mm } else { self.dialect.decimals_inch }
    }
}
