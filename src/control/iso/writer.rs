//! Word-address writer of the posts: blocks of G words, axis words and feeds.

use crate::control::iso::lines::PROBE_TOOL;
use crate::control::{CHORD_SAG, Program, Request, comment_text, header};
use crate::geom::{AXIS_NAMES, Plane, Vec3};
use crate::num::{Digits, format_count};
use crate::path::{Arc, Feature, Move, MovePurpose, ONE_LEVEL, Surface, Touch};

/// Notation of a control's blocks, beyond the common word-address format.
#[derive(Clone, Copy, Debug)]
pub struct Dialect {
    /// Decimals of lengths and feeds in mm.
    pub decimals_mm: usize,
    /// Decimals of lengths and feeds in inch.
    pub decimals_inch: usize,
    /// Start and end of a comment.
    pub comment: (&'static str, &'static str),
    /// Longest comment line, characters. A longer text continues on the next one.
    pub comment_width: usize,
    /// Longest block, characters.
    pub longest_block: usize,
    /// Whether numbers always have a decimal point: without one they count in the smallest step of the control.
    pub points: bool,
    /// Whether comments are in capitals.
    pub capitals: bool,
    /// Whether blocks are numbered, from 0.
    pub numbered: bool,
    /// Words for mm and inch; empty if a program cannot state them.
    pub units: (&'static str, &'static str),
    /// Exact stop, and all modes that must not be inherited, except plane and units.
    pub modes: &'static str,
    /// Whether a program that is read back must state exact stop with G61.
    pub exact_stop: bool,
    /// Text before and after a coordinate that is a sum: `X[10+#<top_z>]`, `X=10+R5`.
    pub shifted: (&'static str, &'static str),
    /// Word for arc centres counted from the start of the arc, in programs with arcs.
    pub arcs: &'static str,
}

/// Notation of most controls; each states its differences.
pub const PLAIN: Dialect = Dialect {
    decimals_mm: 4,
    decimals_inch: 5,
    comment: ("(", ")"),
    // Our choice: longer lines are hard to read on the screen of a control.
    comment_width: 80,
    // Limit of LinuxCNC's interpreter: a longer block ends the program.
    longest_block: 252,
    points: false,
    capitals: false,
    numbered: false,
    units: ("G21", "G20"),
    modes: "G40 G80 G90",
    exact_stop: false,
    shifted: ("[", "]"),
    arcs: "",
};

/// Writes a program block by block and records the block of each move.
#[derive(Debug)]
pub struct Writer<'a> {
    request: &'a Request<'a>,
    dialect: &'static Dialect,
    text: String,
    lines: usize,
    blocks: usize,
    move_lines: Vec<Option<usize>>,
    /// Coordinates of the ball along each axis, from the last block that names them, or from the job.
    last: [Digits; 3],
    /// The same coordinates, mm, so that a number is not formatted twice.
    last_mm: Vec3,
    /// Last feed, mm/min, and its number.
    last_rate: (f64, Digits),
    /// Axes that a block has named.
    stated: [bool; 3],
    /// Terms added to the positions of the next block along each axis: a sum that begins with a sign; empty without a shift.
    shifts: [String; 3],
    /// Terms added to the start of the move.
    begin_shifts: [String; 3],
    /// Whether a block is longer than the control reads.
    too_long: bool,
    /// Terms of the last block.
    last_shifts: [String; 3],
}

impl<'a> Writer<'a> {
    pub fn new(request: &'a Request<'a>) -> Self {
        let move_lines = Vec::with_capacity(request.path.moves.len());
        let mut writer = Writer {
            request,
            dialect: request.post.dialect,
            text: String::with_capacity(
                2048 + 40 * request.path.formula.assignments.len() + 160 * request.path.moves.len(),
            ),
            lines: 0,
            blocks: 0,
            move_lines,
            last: [const { Digits::NONE }; 3],
            last_mm: Vec3::NAN,
            last_rate: (f64::NAN, Digits::NONE),
            stated: [false; 3],
            shifts: Default::default(),
            too_long: false,
            begin_shifts: Default::default(),
            last_shifts: Default::default(),
        };
        if let Some(start) = request.path.start {
            writer.last = writer.numbers(start);
            writer.last_mm = start;
        }
        writer
    }

    pub fn line(&mut self, text: &str) {
        self.parts(&[text]);
    }

    /// One line from these parts.
    pub fn parts(&mut self, parts: &[&str]) {
        self.build(|text| parts.iter().for_each(|part| text.push_str(part)));
    }

    /// One line that `write` appends to the program.
    pub fn build(&mut self, write: impl FnOnce(&mut String)) {
        if self.dialect.numbered {
            self.text.push_str(&format_count(self.blocks));
            self.text.push(' ');
        }
        self.blocks += 1;
        self.push_line(write);
    }

    /// A line that continues the last block.
    pub fn continued(&mut self, text: &str) {
        self.push_line(|line| line.push_str(text));
    }

    fn push_line(&mut self, write: impl FnOnce(&mut String)) {
        let begin = self.text.len();
        write(&mut self.text);
        debug_assert!(
            !self.text[begin..].contains(['\n', '\r']),
            "a line is one line"
        );
        self.too_long |= !self.text[begin..].starts_with(['(', ';'])
            && self.text.len() - begin > self.dialect.longest_block;
        self.text.push('\n');
        self.lines += 1;
    }

    /// A comment on as many lines as it needs. Nothing in `text` can end it.
    pub fn comment(&mut self, text: &str) {
        debug_assert!(
            !text.contains(['(', ')', '\n', '\r']),
            "comments are made of safe text"
        );
        let (open, close) = self.dialect.comment;
        let capitals = self.dialect.capitals;
        each_line(
            text,
            self.dialect.comment_width - open.len() - close.len(),
            |line| {
                self.build(|text| {
                    text.push_str(open);
                    if capitals {
                        // Such a control shows a semicolon for the end of a block.
                        text.extend(line.chars().map(|c| {
                            if c == ';' {
                                ','
                            } else {
                                c.to_ascii_uppercase()
                            }
                        }));
                    } else {
                        text.push_str(line);
                    }
                    text.push_str(close);
                });
            },
        );
    }

    /// Sets the terms added to the positions of the following blocks along X, Y and Z: sums that begin with a sign.
    pub fn shifts_by(&mut self, shifts: [String; 3]) {
        self.begin_shifts = std::mem::replace(&mut self.shifts, shifts);
    }

    /// Term added to a position along an axis, with its sign; empty without a shift.
    pub fn shift(&self, axis: usize) -> &str {
        &self.shifts[axis]
    }

    /// Term added to the start of the move along an axis.
    pub fn begin_shift(&self, axis: usize) -> &str {
        &self.begin_shifts[axis]
    }

    pub fn request(&self) -> &'a Request<'a> {
        self.request
    }

    /// A length or feed in the program's units, with the decimals of the control.
    pub fn number(&self, mm: f64) -> Digits {
        number(self.request, mm)
    }

    /// Axis words of a position: `X0 Y0 Z30`.
    pub fn place_words(&self, place: Vec3) -> String {
        axis_words(&self.numbers(place), [true; 3], &NO_SHIFTS).split_off(1)
    }

    /// The axis word of the tool axis: `Z30`.
    pub fn height_word(&self, place: Vec3) -> String {
        axis_words(&self.numbers(place), self.tool(), &NO_SHIFTS).split_off(1)
    }

    /// Only the tool axis.
    fn tool(&self) -> [bool; 3] {
        let [_, _, tool] = self.request.plane.axes();
        [0, 1, 2].map(|axis| axis == tool)
    }

    /// The first lines: purpose, units, stylus and start.
    pub fn header(&mut self, offset: &str) {
        let request = self.request;
        let unit = if request.scale == 1.0 { "mm" } else { "inch" };
        if let Some(lift) = request.dry {
            let lifted = if lift > 0.0 {
                format!(", {} above the path of the job", self.number(lift))
            } else {
                String::new()
            };
            self.comment(&format!(
                "DRY RUN{lifted}: the moves alone. A contact anywhere stops it. Nothing is measured or written"
            ));
        }
        self.comment(&format!("Job: {}", comment_text(request.name)));
        match request.path.cycles.len() {
            0 => self.comment(&format!("{}: {}", request.source, request.title)),
            count => self.comment(&format!("A set-up of {count} cycles")),
        }
        self.comment(&format!(
            "Units {unit}, plane {}, stylus ball diameter {}, overtravel {}",
            request.plane.word(),
            self.number(2.0 * request.setup.radius),
            self.number(request.setup.overtravel)
        ));
        let named = request
            .path
            .formula
            .results
            .iter()
            .any(|result| result.code.ends_with(".x"));
        if request.plane != Plane::G17 && request.post.computes && named {
            let [abscissa, ordinate, tool] = request.plane.axes().map(|axis| AXIS_NAMES[axis]);
            self.comment(&format!(
                "In names of results x is the abscissa {abscissa}, y the ordinate {ordinate}, z the tool axis {tool}"
            ));
        }
        self.comment(offset);
        if let Some(tool) = request.checked_tool() {
            self.comment(&format!("{PROBE_TOOL}{tool}"));
        }
        // Native cycles tell it themselves.
        if request.path.calls.is_some() {
            return;
        }
        if matches!(request.path.feature, Feature::Unmoving) {
            return self.comment("Switches nothing, moves nothing: states its modes and ends");
        }
        self.comment("Before the start: probe in the spindle and switched on, its length to the ball CENTRE active");
        if let Some(start) = request.path.start {
            let text = stated_start(request, &self.place_words(start));
            self.comment(&format!("{text} Bring it there first"));
        }
        for member in request
            .path
            .cycles
            .iter()
            .filter(|member| member.path.top.is_none())
        {
            let Some(first) = member.path.moves.first() else {
                continue;
            };
            let height = self.height_word(first.to);
            self.comment(&format!(
                "{} knows no top side: it begins and ends at {height}, which must be above the part",
                member.name
            ));
        }
        if let (Some(first), None, None, true) = (
            request.path.moves.first(),
            request.path.start,
            request.path.top,
            request.path.cycles.is_empty(),
        ) {
            let height = self.height_word(first.to);
            self.comment(&format!(
                "This cycle knows no top side: it begins and ends at {height}, which must be above the part"
            ));
        }
    }

    /// Comment about the free space that a program needs on its approach to the first position: up, across and down.
    pub fn comment_approach(&mut self) {
        let path = self.request.path;
        let (Some(first), None) = (path.moves.first(), path.start) else {
            return;
        };
        let (height, place) = (self.height_word(first.to), self.place_words(first.to));
        self.comment(&format!(
            "The way to {place} must be free: a stylus below {height} goes straight up to it first, then in the plane, then down"
        ));
    }

    /// The job, the version and the hash over the following lines, as comments.
    pub fn says_job(&mut self) {
        let (open, close) = self.dialect.comment;
        for line in header::lines(
            self.request,
            self.dialect.comment_width - open.len() - close.len(),
            self.dialect.capitals,
        ) {
            self.comment(&line);
        }
    }

    /// Names the cycle of a set-up that begins with this move.
    pub fn names_cycle(&mut self, index: usize) {
        let path = self.request.path;
        if let Some(begins) = path.begins_member(index) {
            let member = &path.cycles[begins];
            self.comment(&format!("{}: {}", member.name, member.title));
        }
    }

    /// Units and modes are stated, never inherited.
    pub fn modes(&mut self) {
        let request = self.request;
        let units = if request.scale == 1.0 {
            self.dialect.units.0
        } else {
            self.dialect.units.1
        };
        if !units.is_empty() {
            self.line(units);
        }
        let arcs = if request.path.moves.iter().any(|m| m.arc.is_some()) {
            self.dialect.arcs
        } else {
            ""
        };
        self.parts(&[request.plane.word(), " ", self.dialect.modes, arcs, " G94"]);
    }

    /// A straight move as one block: `word`, axis words and the feed, if there is one. With `all` every axis with a stated position is named, else only those
    /// that change.
    pub fn straight(&mut self, word: &str, to: Vec3, all: bool, rate: Option<f64>) {
        let words = self.changed(to, all);
        self.block(word, to, words, rate);
    }

    /// A straight move with all three axis words, whatever the last block contains.
    pub fn straight_in_full(&mut self, word: &str, to: Vec3, rate: f64) {
        let words = (self.numbers(to), [true; 3]);
        self.block(word, to, words, Some(rate));
    }

    /// A touch as one block: it continues past its contact by the search distance, along the inverted target vector.
    pub fn touch(&mut self, word: &str, step: &Move, touch: &Touch, all: bool, rate: f64) {
        self.straight(word, step.to - touch.vector * touch.search, all, Some(rate));
    }

    /// A positioning move along an arc from the current position, with an incremental centre.
    pub fn arc(&mut self, from: Vec3, step: &Move, arc: &Arc, rate: Option<f64>) {
        let word = if arc.sweep > 0.0 { "G3" } else { "G2" };
        let words = self.goes_to(step.to, false);
        let to_center = arc.center - from;
        let [a, o, _] = self.request.plane.axes();
        let (first, second) = (a.min(o), a.max(o));
        let [one, two] = [first, second].map(|axis| self.number(to_center[axis]));
        let (sign, feed) = self.feed(rate);
        self.parts(&[
            word,
            &words,
            CENTER[first],
            &one,
            CENTER[second],
            &two,
            sign,
            &feed,
        ]);
    }

    /// Moves to a position: all three axis words, whatever the last block contains.
    pub fn goes_to_all(&mut self, to: Vec3) -> String {
        self.named(to, self.numbers(to), [true; 3])
    }

    /// Moves in the plane: the words of its two axes, whatever the last block contains.
    pub fn goes_in_plane(&mut self, to: Vec3) -> String {
        let [a, o, _] = self.request.plane.axes();
        self.named(
            to,
            self.numbers(to),
            [0, 1, 2].map(|axis| axis == a || axis == o),
        )
    }

    /// Moves to a height: the word of the tool axis, whatever the last block contains.
    pub fn goes_along_tool(&mut self, to: Vec3) -> String {
        self.named(to, self.numbers(to), self.tool())
    }

    /// The next line makes the next move.
    pub fn makes_move(&mut self) {
        self.move_lines.push(Some(self.lines));
    }

    /// The control makes the next move without a block.
    pub fn leaves_move(&mut self) {
        self.move_lines.push(None);
    }

    /// Sets the ball centre after a block that gave it by other means than axis words.
    pub fn stands_at(&mut self, place: Vec3) {
        self.keep(place, self.numbers(place), [true; 3]);
    }

    /// Moves to `target` and returns its axis words: those that differ from the last block, and with `all` every other one that was stated before. The axes of
    /// the plane are first named together. A block is never empty.
    pub fn goes_to(&mut self, target: Vec3, all: bool) -> String {
        let (numbers, wanted) = self.changed(target, all);
        self.named(target, numbers, wanted)
    }

    /// Numbers of a block to `target`, and the axes that it names.
    fn changed(&self, target: Vec3, all: bool) -> ([Digits; 3], [bool; 3]) {
        let [a, o, _] = self.request.plane.axes();
        let numbers = self.numbers(target);
        let moves = |i: usize| numbers[i] != self.last[i] || self.shifts[i] != self.last_shifts[i];
        let mut wanted = [0, 1, 2].map(|i| moves(i) || (all && self.stated[i]));
        let in_plane = wanted[a] || wanted[o];
        if in_plane && !(self.stated[a] && self.stated[o]) {
            (wanted[a], wanted[o]) = (true, true);
        }
        if wanted == [false; 3] {
            wanted = [true; 3];
        }
        (numbers, wanted)
    }

    pub fn finish(mut self) -> Program {
        header::seal(&mut self.text);
        Program {
            text: self.text,
            move_lines: self.move_lines,
            too_long: self.too_long.then_some(self.dialect.longest_block),
        }
    }

    fn named(&mut self, place: Vec3, numbers: [Digits; 3], wanted: [bool; 3]) -> String {
        let block = axis_words(&numbers, wanted, &self.shift_words());
        self.keep(place, numbers, wanted);
        block
    }

    /// The ball centre is known only to the control: the next block names every axis.
    pub fn forgets_place(&mut self) {
        (self.last, self.last_mm) = ([const { Digits::NONE }; 3], Vec3::NAN);
    }

    /// Records the stated values, which are valid until the next block.
    fn keep(&mut self, place: Vec3, numbers: [Digits; 3], wanted: [bool; 3]) {
        for (i, number) in numbers.into_iter().enumerate().filter(|(i, _)| wanted[*i]) {
            self.last[i] = number;
            self.last_mm[i] = place[i];
            self.stated[i] = true;
            if self.shifts[i] != self.last_shifts[i] {
                self.last_shifts[i].clone_from(&self.shifts[i]);
            }
        }
    }

    /// A block with a word, axis words and the feed, if there is one.
    fn block(
        &mut self,
        word: &str,
        to: Vec3,
        (numbers, wanted): ([Digits; 3], [bool; 3]),
        rate: Option<f64>,
    ) {
        let (sign, feed) = self.feed(rate);
        let shifts = std::mem::take(&mut self.shifts);
        let (before, behind) = self.dialect.shifted;
        self.build(|text| {
            text.push_str(word);
            push_axis_words(
                text,
                &numbers,
                wanted,
                &ShiftWords {
                    of: &shifts,
                    before,
                    behind,
                },
            );
            text.push_str(sign);
            text.push_str(&feed);
        });
        self.shifts = shifts;
        self.keep(to, numbers, wanted);
    }

    fn shift_words(&self) -> ShiftWords<'_> {
        let (before, behind) = self.dialect.shifted;
        ShiftWords {
            of: &self.shifts,
            before,
            behind,
        }
    }

    /// The word of a feed in two parts; empty without a feed.
    fn feed(&mut self, rate: Option<f64>) -> (&'static str, Digits) {
        let Some(rate) = rate else {
            return ("", Digits::NONE);
        };
        if self.last_rate.0 != rate {
            self.last_rate = (rate, self.number(rate));
        }
        (" F", self.last_rate.1.clone())
    }

    /// Numbers of a position. Most coordinates are those of the last block.
    fn numbers(&self, place: Vec3) -> [Digits; 3] {
        [0, 1, 2].map(|i| {
            if place[i] == self.last_mm[i] {
                self.last[i].clone()
            } else {
                self.number(place[i])
            }
        })
    }
}

/// A length or feed in the units of a program, with the decimals of its control.
pub fn number(request: &Request<'_>, mm: f64) -> Digits {
    let digits = Digits::of(mm / request.scale, request.post.decimals(request.scale));
    if request.post.dialect.points {
        digits.pointed()
    } else {
        digits
    }
}

/// Words of the incremental centre of an arc.
const CENTER: [&str; 3] = [" I", " J", " K"];

/// Terms added to the coordinates of a block, by axis, with the texts before and after such a sum.
struct ShiftWords<'a> {
    of: &'a [String; 3],
    before: &'static str,
    behind: &'static str,
}

const NO_SHIFTS: ShiftWords<'_> = ShiftWords {
    of: &[const { String::new() }; 3],
    before: "",
    behind: "",
};

/// The wanted axis words, each after a space.
fn axis_words(numbers: &[Digits; 3], wanted: [bool; 3], shifts: &ShiftWords<'_>) -> String {
    let mut words = String::with_capacity(40);
    push_axis_words(&mut words, numbers, wanted, shifts);
    words
}

fn push_axis_words(
    text: &mut String,
    numbers: &[Digits; 3],
    wanted: [bool; 3],
    shifts: &ShiftWords<'_>,
) {
    for (i, number) in numbers.iter().enumerate().filter(|(i, _)| wanted[*i]) {
        text.push(' ');
        text.push_str(AXIS_NAMES[i]);
        let shift = shifts.of[i].as_str();
        if shift.is_empty() {
            text.push_str(number);
        } else {
            [shifts.before, number, shift, shifts.behind]
                .into_iter()
                .for_each(|part| text.push_str(part));
        }
    }
}

/// Comment about the start of the stylus in the job and the first move from there. `place` is in the notation of the control.
pub fn stated_start(request: &Request<'_>, place: &str) -> String {
    let first = request
        .path
        .moves
        .first()
        .map_or(0, |m| upwards(request, request.path.start, m.to));
    let first = match first {
        1 => "below the clearance height: first straight up",
        -1 => "over the first place: first straight down",
        _ => "high enough: first in the plane at that height",
    };
    format!("The stylus is taken to be at {place} before the start, {first}.")
}

/// Passes on the lines of a text one by one, each with at most `width` characters, split at spaces if possible.
fn each_line(text: &str, width: usize, mut line: impl FnMut(&str)) {
    let mut rest = text;
    while rest.len() > width {
        // The last space within the width; else the first one after it.
        let space = rest.as_bytes()[..=width]
            .iter()
            .rposition(|b| *b == b' ')
            .or_else(|| rest.find(' '));
        let (head, tail) = space.map_or((rest, ""), |at| (&rest[..at], &rest[at + 1..]));
        // A word longer than a line is cut: comments are ASCII.
        for piece in head.as_bytes().chunks(width) {
            line(&String::from_utf8_lossy(piece));
        }
        if space.is_none() {
            return;
        }
        rest = tail;
    }
    line(rest);
}

/// Start of the job, and the first move if it goes across at that height.
pub fn across_from_stated<'p>(request: &Request<'p>) -> Option<(Vec3, &'p Move)> {
    let (start, first) = (request.path.start?, request.path.moves.first()?);
    (upwards(request, Some(start), first.to) == 0).then_some((start, first))
}

/// Threshold along the tool axis below which a stylus is lower than a position: a position printed with fewer digits is still the same one.
pub fn lower_than(request: &Request<'_>, place: Vec3) -> Vec3 {
    const ROUNDED: f64 = 0.01;
    place - request.path.frame.w * ROUNDED
}

/// Direction of a move along the tool axis: −1 down, 1 up, 0 neither.
pub fn upwards(request: &Request<'_>, from: Option<Vec3>, to: Vec3) -> i32 {
    let Some(from) = from else { return 0 };
    let rise = (to - from).dot(request.path.frame.w);
    // Between touches that are level within the rounding of a dump nothing goes up; any descent counts.
    if rise > ONE_LEVEL {
        1
    } else if rise < -1e-6 {
        -1
    } else {
        0
    }
}

/// Ends of the straight moves that make a positioning move.
pub fn pieces(request: &Request<'_>, step: &Move, at: Option<Vec3>) -> Vec<Vec3> {
    let (Some(arc), Some(from)) = (step.arc, at) else {
        return vec![step.to];
    };
    // A chord over the angle x deviates from a circle of radius r by r(1 − cos x/2).
    let radius = from.distance(arc.center);
    let sag = CHORD_SAG.min(request.path.shortest_approach() / 2.0);
    let degrees = (2.0 * crate::num::within(1.0 - sag / radius, -1.0, 1.0).acos()).to_degrees();
    let degrees = crate::num::within(degrees, 0.1, 30.0);
    step.pieces(
        from,
        request.path.frame.w,
        degrees.max(long_enough(request, &arc, radius).unwrap_or(0.0)),
    )
}

/// Angle of the shortest chords of an arc that can be watched, degrees; `None` if such chords would deviate from the circle by too much.
fn long_enough(request: &Request<'_>, arc: &Arc, radius: f64) -> Option<f64> {
    let shortest = request.shortest_watched();
    let least = 2.0 * crate::num::within(shortest / (2.0 * radius), 0.0, 1.0).asin();
    // Divided evenly, no chord is shorter.
    let count = (arc.sweep.abs() / least).floor();
    let each = arc.sweep.abs() / count;
    let leaves = radius * (1.0 - (each / 2.0).cos());
    // In a hole a chord leads away from the wall, around a stud towards it.
    let w = request.path.frame.w;
    let in_hole = request.path.surfaces.iter().any(|surface| match surface {
        Surface::Round(round) => round.hole && (round.center - arc.center).cross(w).length() < 1e-6,
        Surface::Flat(_) | Surface::Unknown => false,
    });
    let free = if in_hole {
        f64::INFINITY
    } else {
        request.path.shortest_approach() / 2.0
    };
    (count.is_finite() && count >= 1.0 && leaves <= CHORD_SAG.min(free))
        .then(|| each.to_degrees() * (1.0 + 1e-9))
}

/// Whether the first move comes from an unknown position: then it is made in steps.
pub fn start_unknown(request: &Request<'_>, index: usize, step: &Move) -> bool {
    index == 0 && request.path.start.is_none() && step.purpose == MovePurpose::Position
}

#[cfg(test)]
mod tests {
    use super::each_line;

    fn wrapped(text: &str, width: usize) -> Vec<String> {
        let mut lines = Vec::new();
        each_line(text, width, |line| lines.push(line.to_owned()));
        lines
    }

    #[test]
    fn long_comments_are_parted_at_spaces_and_nothing_is_lost() {
        assert_eq!(wrapped("aa bb cc", 5), ["aa bb", "cc"]);
        assert_eq!(wrapped("aaaaaaa b", 3), ["aaa", "aaa", "a", "b"]);
        assert_eq!(wrapped("", 5), [""]);
    }
}
