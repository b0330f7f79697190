//! Subprograms in the same text: `M98 P100` runs the lines below `O100` up to `M99`, `M97 P100` of a Haas those from `N100` on.

use crate::control::iso::lex::{head, line_end, program_number};
use crate::import::toolpath::block::{Block, Call};
use crate::import::toolpath::reader::Reader;
use crate::import::toolpath::skipped::Skip;

/// Deepest nesting of subprograms.
const DEEPEST: usize = 10;

/// Largest total number of lines read in subprograms.
const MOST_LINES: usize = 500_000;

/// Largest number of numbers that are searched for: each costs a pass through the text.
const MOST_NUMBERS: usize = 100;

/// Start of a line, and its number from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub at: usize,
    pub line: usize,
}

/// An active call: where it continues, where its lines begin, and the number of further repetitions.
struct Frame {
    back: Place,
    begin: Place,
    left: u32,
}

/// Follows calls through a text.
pub(super) struct Calls<'t> {
    text: &'t str,
    /// Called numbers: whether it is a block, the number, and the start of its lines.
    places: Vec<(bool, u32, Option<Place>)>,
    stack: Vec<Frame>,
    lines: usize,
    /// Lines of subprograms that ran: from, up to.
    ran: Vec<(usize, usize)>,
}

impl<'t> Calls<'t> {
    pub fn new(text: &'t str) -> Self {
        Calls {
            text,
            places: Vec::new(),
            stack: Vec::new(),
            lines: 0,
            ran: Vec::new(),
        }
    }

    /// Number of active subprograms.
    pub fn depth(&self) -> usize {
        self.stack.len()
    }

    /// Return position of the active subprogram, after its lines have run as often as they were called.
    pub fn back(&self) -> Option<Place> {
        let frame = self.stack.last().filter(|frame| frame.left == 0)?;
        Some(frame.back)
    }

    /// Whether a subprogram is active.
    pub fn is_inside(&self) -> bool {
        !self.stack.is_empty()
    }

    /// Whether a line ran where it was called.
    pub fn has_run(&self, line: usize) -> bool {
        self.ran
            .iter()
            .any(|(from, to)| (*from..*to).contains(&line))
    }

    /// Chooses the next line after reading one.
    #[cold]
    #[inline(never)]
    pub fn step(&mut self, reader: &mut Reader, line: &[u8], next: Place) -> Place {
        let next = self.turn(reader, line, next);
        reader.may_leave_sequence = self.is_inside();
        next
    }

    fn turn(&mut self, reader: &mut Reader, line: &[u8], next: Place) -> Place {
        let returned = std::mem::take(&mut reader.returned);
        if let Some(call) = reader.call.take() {
            return self.enter(reader, call, next);
        }
        if !self.is_inside() {
            return next;
        }
        self.lines += 1;
        if returned {
            reader.ended = false;
            if self.stack.last().is_some_and(|frame| frame.left == 0) {
                reader.leaves_call();
            }
            return self.leave(next);
        }
        // End of the program, or another program: the caller does not continue, or it is unknown how.
        if reader.ended || self.lines > MOST_LINES {
            let back = self.stack[0].back;
            while self.stack.pop().is_some() {
                reader.leaves_call();
            }
            if !reader.ended {
                reader.lose(Skip::Endless, next.line - 1);
            }
            return back;
        }
        if program_number(line).is_some() {
            self.fall_out(reader, next)
        } else {
            next
        }
    }

    /// The lines of a subprogram end without M99.
    #[cold]
    #[inline(never)]
    pub fn fall_out(&mut self, reader: &mut Reader, next: Place) -> Place {
        reader.lose(Skip::Call, next.line.saturating_sub(1));
        reader.leaves_call();
        self.stack.pop().map_or(next, |frame| frame.back)
    }

    fn enter(&mut self, reader: &mut Reader, call: Call, next: Place) -> Place {
        match self
            .find(call)
            .filter(|_| self.stack.len() < DEEPEST && self.lines < MOST_LINES)
        {
            Some(begin) => {
                reader.enters_call();
                self.stack.push(Frame {
                    back: next,
                    begin,
                    left: call.times - 1,
                });
                begin
            }
            None => {
                reader.called_external = true;
                reader.lose(Skip::Call, next.line - 1);
                next
            }
        }
    }

    fn leave(&mut self, next: Place) -> Place {
        let Some(frame) = self.stack.last_mut() else {
            return next;
        };
        if frame.left > 0 {
            frame.left -= 1;
            return frame.begin;
        }
        // With the line of its number.
        let lines = (frame.begin.line.saturating_sub(1), next.line);
        let back = frame.back;
        self.stack.pop();
        if !self.ran.contains(&lines) {
            self.ran.push(lines);
        }
        back
    }

    /// Start of the lines; `None` if the number does not occur exactly once. Each number is searched for once, and not very many are.
    fn find(&mut self, call: Call) -> Option<Place> {
        let known = self
            .places
            .iter()
            .find(|(local, number, _)| (*local, *number) == (call.local, call.number));
        if let Some((.., place)) = known {
            return *place;
        }
        if self.places.len() == MOST_NUMBERS {
            return None;
        }
        let place = place_of(self.text.as_bytes(), call);
        self.places.push((call.local, call.number, place));
        place
    }
}

impl Reader {
    /// Calls a subprogram by M97, M98 or M198.
    #[cold]
    #[inline(never)]
    pub(super) fn call(&mut self, code: u8, block: &Block) {
        let whole =
            |x: f64, most: f64| (x.fract() == 0.0 && (1.0..=most).contains(&x)).then_some(x as u32);
        let number = block
            .p
            .and_then(|p| whole(p, 99_999_999.0))
            .filter(|_| code != 198 && !self.sinumerik);
        let times = block.l.map_or(Some(1), |l| whole(l, 9999.0));
        match (number, times) {
            // P30100 is O100 three times.
            (Some(number), Some(1)) if number > 9999 && block.l.is_none() => {
                self.take_up(Call {
                    local: code == 97,
                    number: number % 10_000,
                    times: number / 10_000,
                });
            }
            (Some(number), Some(times)) => self.take_up(Call {
                local: code == 97,
                number,
                times,
            }),
            _ => {
                self.called_external = true;
                self.lose(Skip::Call, self.line);
            }
        }
    }

    fn take_up(&mut self, call: Call) {
        (self.call, self.may_leave_sequence) = (Some(call), true);
    }

    /// The positions of the axes are unknown after a line that is not modelled.
    #[cold]
    #[inline(never)]
    pub(super) fn lose(&mut self, why: Skip, line: usize) {
        self.place = [f64::NAN; 3];
        self.modes.maybe_changed |= why == Skip::Call;
        self.skipped.count(why, line);
    }
}

/// Start of a subprogram's lines; `None` if its number does not occur exactly once.
fn place_of(text: &[u8], call: Call) -> Option<Place> {
    let mut found = None;
    let (mut at, mut line) = (0, 0);
    while at < text.len() {
        let (end, next) = line_end(text, at);
        let code = text[at..end].trim_ascii();
        let number = if call.local {
            head(code).number
        } else {
            program_number(code)
        };
        if number == Some(call.number) {
            // A block runs from its own number on, a program below the line of its number.
            let place = if call.local {
                Place { at, line }
            } else {
                Place {
                    at: next,
                    line: line + 1,
                }
            };
            if found.replace(place).is_some() {
                return None;
            }
        }
        (at, line) = (next, line + 1);
    }
    found
}
