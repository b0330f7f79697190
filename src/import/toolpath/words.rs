//! What each word does: G codes by their number, places, and the names of a SINUMERIK.

use crate::geom::Plane;
use crate::import::toolpath::block::{Block, Motion, Word, end_of_value, number};
use crate::import::toolpath::reader::{Reader, count};
use crate::num::read_digits;

impl Reader {
    /// Takes the word at `at` and gives where the next one begins; none where it is none.
    pub(super) fn word(&mut self, line: &[u8], at: usize, block: &mut Block) -> Option<usize> {
        let letter = line[at].to_ascii_uppercase();
        let mut next = at + 1;
        while matches!(line.get(next), Some(b' ' | b'\t')) {
            next += 1;
        }
        let first = *line.get(next)?;
        let signed = usize::from(matches!(first, b'-' | b'+'));
        let (word, end) = match first {
            b'-' | b'+' if matches!(line.get(next + 1), Some(b'#' | b'[')) => (Word::Computed, end_of_value(line, next + 1)),
            b'0'..=b'9' | b'.' | b'-' | b'+' => {
                let (size, length) = read_digits(line.get(next + signed..)?)?;
                let (number, end) = (if first == b'-' { -size } else { size }, next + signed + length);
                match line.get(end) {
                    // `R1=5` gives a variable a value.
                    Some(b'=') => return None,
                    // A label: `L1: G1 X5`.
                    Some(b':') if self.sinumerik => return Some(end + 1),
                    _ => {}
                }
                (Word::Number(number), end)
            }
            b'#' | b'[' => (Word::Computed, end_of_value(line, next)),
            b'=' if self.sinumerik => {
                // A number ends where the next word begins: X=5Y3. Otherwise it is a part of a sum: X=5+R1.
                let end = end_of_value(line, next + 1);
                let whole = |stop: usize| stop == end || line[stop].is_ascii_alphabetic();
                match number(line, next + 1).filter(|(_, stop)| whole(*stop)) {
                    Some((number, stop)) => (Word::Number(number), stop),
                    None => (Word::Computed, end),
                }
            }
            // What a function gives: XSIN[30].
            _ if !self.sinumerik && matches!(letter, b'X'..=b'Z' | b'F') => {
                let name = line[next..].iter().take(7).take_while(|b| b.is_ascii_alphabetic()).count();
                if line.get(next + name) != Some(&b'[') {
                    return None;
                }
                (Word::Computed, end_of_value(line, next))
            }
            _ => return self.name(line, at, block),
        };
        match (letter, word) {
            (b'X'..=b'Z', word) => {
                let axis = letter - b'X';
                block.twice |= block.given & (1 << axis) != 0;
                block.given |= 1 << axis;
                match word {
                    Word::Number(x) => block.places[usize::from(axis)] = x,
                    Word::Computed => block.computed |= 1 << axis,
                }
            }
            (b'I'..=b'K', word) => {
                let axis = letter - b'I';
                block.centered |= 1 << axis;
                // A centre that is computed makes no arc.
                block.center[usize::from(axis)] = word.number();
            }
            (b'F', word) => block.feed = Some(word.number()),
            (b'R', word) => block.radius = Some(word.number()),
            (b'G', Word::Number(x)) => self.code((x * 10.0 + 0.5) as i32, block),
            (b'G', Word::Computed) => return None,
            // Another program is called: where the ball is afterwards is not known.
            (b'M', Word::Number(97.0 | 98.0 | 198.0)) => {
                self.place = [f64::NAN; 3];
                count(&mut self.skipped, self.line);
            }
            (b'M', Word::Number(2.0 | 30.0)) => block.ends = true,
            (b'M', Word::Number(17.0)) if self.sinumerik => block.ends = true,
            (b'M', Word::Number(99.0)) if !self.sinumerik => block.returns = true,
            (b'M', Word::Number(x @ (70.0 | 71.0 | 72.0 | 73.0))) if !self.sinumerik => block.keeps = Some(x as u8),
            // A tool and its edge have their length from here on.
            (b'D', _) | (b'M', Word::Number(6.0)) if self.sinumerik => block.lengthens = true,
            // A subprogram: L100 P2.
            (b'L', _) if self.sinumerik => {
                self.place = [f64::NAN; 3];
                count(&mut self.skipped, self.line);
            }
            (b'L', word) => block.l = Some(word.number()),
            (b'P', word) => block.p = Some(word.number()),
            (b'A'..=b'C' | b'U'..=b'W', _) => block.others = true,
            _ => {}
        }
        Some(end)
    }

    /// A word of more letters: `MEAS=1`, `CR = 5`, `SPOS=0`, a label, and none else.
    fn name(&mut self, line: &[u8], at: usize, block: &mut Block) -> Option<usize> {
        if !self.sinumerik {
            return None;
        }
        let past_blanks = |at: usize| at + line[at..].iter().take_while(|b| matches!(b, b' ' | b'\t')).count();
        // No name is longer.
        let end = at + line[at..].iter().take(32).take_while(|b| b.is_ascii_alphanumeric() || **b == b'_').count();
        let name = &line[at..end];
        match line.get(past_blanks(end)) {
            Some(b':') if line.get(end) == Some(&b':') => return Some(end + 1),
            Some(b'=') => {}
            _ => return None,
        }
        let value = past_blanks(past_blanks(end) + 1);
        // A number ends where the next word begins: MEAS=1G1X5.
        let stated = number(line, value);
        let stop = stated.map_or_else(|| end_of_value(line, value), |(_, end)| end);
        let is = |word: &[u8]| name.eq_ignore_ascii_case(word);
        if is(b"MEAS") || is(b"MEAW") {
            block.once = Some(Motion::Probe);
        } else if is(b"CR") {
            block.radius = Some(stated.map_or(f64::NAN, |(radius, _)| radius));
        } else if !(is(b"SPOS") || is(b"SPOSA")) {
            return None;
        }
        (stop > value).then_some(stop)
    }

    fn code(&mut self, tenths: i32, block: &mut Block) {
        match tenths {
            0 => self.go(Motion::Rapid, block),
            10 => self.go(Motion::Straight, block),
            20 => self.go(Motion::Clockwise, block),
            30 => self.go(Motion::Counter, block),
            // With its number of a signal, too: G31.1.
            310..=319 if !self.sinumerik => block.once = Some(Motion::Probe),
            382..=389 => self.go(Motion::Probe, block),
            // A thread is cut straight.
            320 | 330 if !self.sinumerik => self.go(Motion::Straight, block),
            330 | 340 | 350 | 3310 | 3320 if self.sinumerik => self.go(Motion::Straight, block),
            50..=52 | 62 if !self.sinumerik => block.once = Some(Motion::Curve),
            170 => self.turn(Plane::G17),
            180 => self.turn(Plane::G18),
            190 => self.turn(Plane::G19),
            200 | 210 if !self.sinumerik => self.units(tenths == 210),
            700 | 710 | 7000 | 7100 if self.sinumerik => self.units(matches!(tenths, 710 | 7100)),
            900 => self.modes.absolute = true,
            910 => self.modes.absolute = false,
            901 => self.modes.centers_absolute = true,
            911 => self.modes.centers_absolute = false,
            40 => (block.dwells, block.feedless) = (true, block.feedless || self.sinumerik),
            // A feed stays in the mode that it was stated in.
            930 | 950 => (self.modes.by_other, self.feed) = (true, f64::NAN),
            940 if self.modes.by_other => (self.modes.by_other, self.feed) = (false, f64::NAN),
            940 => {}
            100 => (block.elsewhere, block.writes) = (true, true),
            // Tables, zones and what the control measures by itself are no places to go to, nor are a tool's lengths and the end of a scale.
            220 | 230 | 370 => block.elsewhere = true,
            430 | 434 | 435 | 440 | 490 if !self.sinumerik => block.lengthens = true,
            431 | 432 if !self.sinumerik => (block.elsewhere, block.lengthens) = (true, true),
            500 | 501 if !self.sinumerik => (block.elsewhere, block.renames) = (true, tenths == 500),
            250 | 260 | 1100 | 1110 | 1120 if self.sinumerik => block.elsewhere = true,
            // Nor are shifts, turns, mirrors, scales and polar places; but what comes after them is another place than it says.
            160 | 510 | 511 | 520 | 680 | 682..=684 | 920..=923 if !self.sinumerik => {
                block.elsewhere = true;
                count(&mut self.transformed, self.line);
            }
            // The radius of the tool.
            410 | 420 => count(&mut self.transformed, self.line),
            411 | 421 if !self.sinumerik => count(&mut self.transformed, self.line),
            70 | 80 if !self.sinumerik => self.modes.diameter = tenths == 70,
            121 | 1120 if !self.sinumerik => count(&mut self.transformed, self.line),
            580 | 590 if self.sinumerik => {
                block.elsewhere = true;
                count(&mut self.transformed, self.line);
            }
            // A cycle runs here and at every later place; where it leaves the tool is not known.
            730 | 740 | 760 | 810..=890 if !self.sinumerik => self.modes.cycle = true,
            800 => self.modes.cycle = false,
            // A rigid tap comes back to where it began.
            331 if !self.sinumerik => {
                block.elsewhere = true;
                count(&mut self.skipped, self.line);
            }
            // A macro that is called, or a cycle of the control's own, moves by itself: where to is not known.
            120 | 130 | 650 | 660 | 661 | 750 | 1500 if !self.sinumerik => {
                (block.elsewhere, block.feedless) = (true, matches!(tenths, 650..=661));
                self.place = [f64::NAN; 3];
                count(&mut self.skipped, self.line);
            }
            // One work offset is what all is seen in; another one lies elsewhere.
            540..=599 | 1540 | 5050..=5990 => block.offset = Some(tenths),
            530 | 1530 => block.machine = true,
            280 | 300 => (block.machine, block.home) = (true, true),
            740 | 750 if self.sinumerik => (block.machine, block.home) = (true, true),
            _ => {}
        }
    }

    fn go(&mut self, motion: Motion, block: &mut Block) {
        block.twice |= block.motion;
        (self.modes.motion, self.modes.cycle, block.motion) = (motion, false, true);
    }

    fn turn(&mut self, plane: Plane) {
        self.plane.get_or_insert(plane);
        self.modes.plane = Some(plane);
    }

    fn units(&mut self, metric: bool) {
        if self.path.metric.is_none() && !self.path.is_empty() {
            self.late_units = Some(self.line);
        }
        let first = *self.path.metric.get_or_insert(metric);
        self.modes.scale = match (first, metric) {
            (true, false) => 25.4,
            (false, true) => 1.0 / 25.4,
            _ => 1.0,
        };
    }
}
