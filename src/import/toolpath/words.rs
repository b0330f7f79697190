//! What each word does: G codes by their number, places, and the names of a SINUMERIK.

use crate::geom::Plane;
use crate::import::toolpath::block::{Block, Foreign, Motion, Word, end_of_value, leads, number};
use crate::import::toolpath::count::count;
use crate::import::toolpath::reader::{Given, Reader};
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
            b'=' if self.sinumerik => by_its_own(line, next + 1).unwrap_or_else(|| assigned(line, next + 1)),
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
                    Word::Placed(x, place) => {
                        block.places[usize::from(axis)] = x;
                        *if place { &mut block.placed } else { &mut block.moved } |= 1 << axis;
                        block.special = true;
                    }
                    Word::Computed => block.computed |= 1 << axis,
                }
            }
            (b'I'..=b'K', word) => {
                let axis = letter - b'I';
                // A HEIDENHAIN's is the pole of circles, which stays: none is followed.
                block.centered |= u8::from(!self.heidenhain) << axis;
                // A centre that is computed makes no arc.
                block.center[usize::from(axis)] = word.number();
            }
            (b'F', word) => block.feed = Some(word.number()),
            (b'R', word) => block.radius = Some(word.number()),
            (b'G', Word::Number(x)) => {
                let foreign = self.code(tenths(x), block);
                if foreign > block.foreign {
                    (block.foreign, block.name, block.special) = (foreign, [at, end], true);
                }
            }
            (b'G', _) => return None,
            (b'M', Word::Number(x)) => {
                let led = self.auxiliary(x, block);
                if led != Foreign::No && leads(line, block.begin, at) {
                    (block.led, block.name, block.special) = (led, [at, end], true);
                }
            }
            // A tool's edge has its length from here on.
            (b'D', _) if self.sinumerik => block.lengthens = true,
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

    /// What an M code does, and whether axis words behind it may be its own.
    fn auxiliary(&mut self, code: f64, block: &mut Block) -> Foreign {
        if code.fract() != 0.0 {
            return Foreign::Unknown;
        }
        match code as u32 {
            2 | 30 => block.ends = true,
            17 if self.sinumerik => block.ends = true,
            6 => block.lengthens |= self.sinumerik,
            0..=14 | 19 | 50..=53 | 60..=68 => {}
            99 if !self.sinumerik => {
                block.returns = true;
                return Foreign::Unknown;
            }
            code @ 70..=73 => block.keeps = (!self.sinumerik).then_some(code as u8),
            40..=45 if self.sinumerik => {}
            code @ (97 | 98 | 198) => {
                (block.calls, block.special) = (Some(code as u8), true);
                return Foreign::Unknown;
            }
            // Steps, speeds and limits of a printer's axes.
            17 | 18 | 84 | 92 | 201..=208 | 350 | 566 | 851 | 906 => return Foreign::Sets,
            _ => return Foreign::Unknown,
        }
        Foreign::No
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

    /// What a G code does, by ten times its number. Axis words are a place under those codes alone that are known here to leave them one.
    fn code(&mut self, tenths: i32, block: &mut Block) -> Foreign {
        if self.heidenhain {
            return self.heidenhain_code(tenths, block);
        }
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
            50 | 51 if !self.sinumerik => block.once = Some(Motion::Curve),
            // What follows are control points, until a motion or the end of the spline.
            52 | 62 if !self.sinumerik => self.modes.given = Given::Control,
            53 | 63 if !self.sinumerik => self.modes.given = Given::Place,
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
            // A tool's lengths and the end of a scale are no places to go to.
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
            // Fanuc's: each axis goes farther by that radius, or less far.
            450 | 460 | 470 | 480 if !self.sinumerik => count(&mut self.transformed, self.line),
            411 | 421 if !self.sinumerik => count(&mut self.transformed, self.line),
            70 | 80 if !self.sinumerik => self.modes.diameter = tenths == 70,
            // Polar coordinates of a turned part. A Haas has a work offset of that number.
            121 if !self.sinumerik => {
                block.elsewhere = true;
                count(&mut self.transformed, self.line);
            }
            1120 if !self.sinumerik => count(&mut self.transformed, self.line),
            580 | 590 if self.sinumerik => {
                block.elsewhere = true;
                count(&mut self.transformed, self.line);
            }
            // A cycle runs here and at every later place; where it leaves the tool is not known.
            730 | 740 | 760 | 810..=890 if !self.sinumerik => self.modes.given = Given::Cycle,
            800 => self.modes.given = Given::Place,
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
            540 | 550 | 560 | 570 | 580 | 590 => block.offset = Some(tenths),
            541 | 591..=593 | 1540 if !self.sinumerik => block.offset = Some(tenths),
            // A Haas has twenty more.
            1100..=1290 if !self.sinumerik && tenths % 10 == 0 => block.offset = Some(tenths),
            5000 | 5050..=5990 if self.sinumerik && tenths % 10 == 0 => block.offset = Some(tenths),
            530 => block.machine = true,
            1530 if self.sinumerik => block.machine = true,
            280 | 300 if !self.sinumerik => (block.machine, block.home) = (true, true),
            740 | 750 if self.sinumerik => (block.machine, block.home) = (true, true),
            // A thread with a compensating chuck.
            630 if self.sinumerik => block.once = Some(Motion::Straight),
            // How exactly, how fast and in which lanes: places stay what they are.
            90 | 400 | 610 | 620 | 640 | 960 | 970 => {}
            131 | 150 | 401 | 611 | 630 | 670 | 690 | 980 | 990 if !self.sinumerik => {}
            600 | 4500 | 4510 | 6010 | 6020 | 6030 | 6410 | 6420 | 6430 | 6440 | 6450 if self.sinumerik => {}
            9610 | 9620 | 9710 | 9720 | 9730 if self.sinumerik => {}
            // Zones, what is watched, how far is read ahead; and where the machine stands is stored, as a place to come back to.
            110 | 220 | 230 | 250 | 260 | 281 | 301 | 1030 | 1870 if !self.sinumerik => return Foreign::Sets,
            _ => return Foreign::Unknown,
        }
        Foreign::No
    }

    pub(super) fn go(&mut self, motion: Motion, block: &mut Block) {
        block.twice |= block.motion;
        (self.modes.motion, self.modes.given, block.motion) = (motion, Given::Place, true);
    }

    pub(super) fn turn(&mut self, plane: Plane) {
        self.plane.get_or_insert(plane);
        self.modes.plane = Some(plane);
    }

    pub(super) fn units(&mut self, metric: bool) {
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

/// Ten times the number of a code; of one with more decimals, or too large for any control, a number that is no code's.
fn tenths(code: f64) -> i32 {
    let tenths = (code * 10.0 + 0.5) as i32;
    if (f64::from(tenths) - code * 10.0).abs() < 1e-6 { tenths } else { -1 }
}

/// What is assigned, `X=5`, and where that ends.
fn assigned(line: &[u8], at: usize) -> (Word, usize) {
    // A number ends where the next word begins: X=5Y3. Otherwise it is a part of a sum: X=5+R1.
    let end = end_of_value(line, at);
    let whole = |stop: usize| stop == end || line[stop].is_ascii_alphabetic();
    match number(line, at).filter(|(_, stop)| whole(*stop)) {
        Some((number, stop)) => (Word::Number(number), stop),
        None => (Word::Computed, end),
    }
}

/// The number in `AC(5)` or `IC(5)`, a place (true) or a distance, and where that ends.
fn by_its_own(line: &[u8], at: usize) -> Option<(Word, usize)> {
    let past_blanks = |at: usize| at + line[at..].iter().take_while(|b| matches!(b, b' ' | b'\t')).count();
    let begin = past_blanks(at);
    let word = line.get(begin..begin + 2)?;
    let place = word.eq_ignore_ascii_case(b"AC");
    let open = past_blanks(begin + 2);
    if !(place || word.eq_ignore_ascii_case(b"IC")) || line.get(open) != Some(&b'(') {
        return None;
    }
    let (x, end) = number(line, past_blanks(open + 1))?;
    let close = past_blanks(end);
    (line.get(close) == Some(&b')')).then_some((Word::Placed(x, place), close + 1))
}

#[cfg(test)]
mod tests {
    use crate::control::iso::codes;
    use crate::import::read_program;

    /// The codes that the readers of control understand are known here, too.
    #[test]
    fn no_code_is_unknown_that_a_strict_reader_takes() {
        let mut seen = 0;
        for letter in [b'G', b'M'] {
            for tenths in (0..100_000).filter(|tenths| codes::rs274(letter, *tenths).is_some()) {
                let code = format!("{}{}", char::from(letter), f64::from(tenths) / 10.0);
                let path = read_program(&format!("G21 G0 X1 Y2 Z3\n{code}\nG0 Z4\n"), Some("iso"));
                let said = |named: &str| path.findings.iter().any(|finding| finding.message.contains(named));
                assert!(!said(&format!("{code} ")), "{code}: {:?}", path.findings);
                seen += 1;
            }
        }
        assert!(seen > 35, "{seen}");
    }
}
