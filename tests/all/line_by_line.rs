//! Random programs of the codes that LinuxCNC's interpreter and the reader of moves both know, compared line by line: the moves of each line,
//! their ends, and the plane and sense of arcs.

use crate::common::canonical;
use touchpath::import::read_program;
use touchpath::import::toolpath::KINDS;

/// A move of either reader: its line number, kind and end.
#[derive(Debug, PartialEq)]
struct Found {
    line: usize,
    kind: &'static str,
    to: [f64; 3],
}

/// Random numbers with a fixed seed: the same programs every time.
struct Chance(u64);

impl Chance {
    fn below(&mut self, count: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % count
    }

    fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len() as u64) as usize]
    }
}

/// Modes that the words of the next line depend on.
#[derive(Clone, Copy)]
struct Modes {
    inch: bool,
    absolute: bool,
    plane: usize,
}

/// Writes a program. Positions are in eighths of a millimetre.
struct Writer {
    chance: Chance,
    text: String,
    modes: Modes,
    kept: Option<Modes>,
    place: [i64; 3],
    /// Whether each line is in inch.
    inch: Vec<bool>,
    motion: &'static str,
}

const AXES: [&str; 3] = ["X", "Y", "Z"];

impl Writer {
    /// A line with its number, in one of several equivalent spellings.
    fn line(&mut self, words: &str) {
        let number = self.inch.len() + 1;
        self.inch.push(self.modes.inch);
        let words = match self.chance.below(6) {
            0 => words.to_lowercase(),
            1 => words.replace(' ', ""),
            2 => words.replace(' ', "\t "),
            3 => format!("{words} (G0 X99)"),
            4 => format!("{words};G0 X99"),
            _ => words.to_owned(),
        };
        let skip = if self.chance.below(12) == 0 { "/" } else { "" };
        let end = self.chance.one(&["\n", "\r\n"]);
        self.text.push_str(&format!("{skip}N{number} {words}{end}"));
    }

    fn value(&self, eighths: i64) -> String {
        let mm = eighths as f64 / 8.0;
        if self.modes.inch {
            format!("{:.8}", mm / 25.4)
        } else {
            format!("{mm}")
        }
    }

    /// Words of a position, for the axes in `named`.
    fn place(&self, target: [i64; 3], named: [bool; 3]) -> String {
        let value = |axis: usize| {
            if self.modes.absolute {
                target[axis]
            } else {
                target[axis] - self.place[axis]
            }
        };
        (0..3)
            .filter(|axis| named[*axis])
            .map(|axis| format!(" {}{}", AXES[axis], self.value(value(axis))))
            .collect()
    }

    fn target(&mut self) -> ([i64; 3], [bool; 3]) {
        let mut named = [0; 3].map(|_| self.chance.below(2) == 0);
        named[self.chance.below(3) as usize] = true;
        let mut target = self.place;
        for axis in (0..3).filter(|axis| named[*axis]) {
            target[axis] +=
                8 + self.chance.below(160) as i64 - if self.chance.below(2) == 0 { 176 } else { 0 };
        }
        (target, named)
    }

    fn straight(&mut self) {
        let (target, named) = self.target();
        let words = self.place(target, named);
        // The active motion needs no word.
        let word = if self.chance.below(2) == 0 {
            self.chance.one(&["G0", "G1", "G01", "G00"])
        } else {
            ""
        };
        let motion = if word.is_empty() { self.motion } else { word };
        let word = if word.is_empty() && !matches!(self.motion, "G0" | "G1" | "G00" | "G01") {
            "G1"
        } else {
            word
        };
        self.motion = if word.is_empty() { motion } else { word };
        let feed = if self.chance.below(3) == 0 {
            format!(" F{}", 50 + self.chance.below(500))
        } else {
            String::new()
        };
        self.line(format!("{word}{words}{feed}").trim());
        self.place = target;
    }

    /// The interpreter has its own position after a probing move, so the next moves state all axes absolutely.
    fn touches(&mut self) {
        if !self.modes.absolute {
            self.modes.absolute = true;
            self.line("G90");
        }
        let code = self.chance.one(&["G38.2", "G38.3", "G38.4", "G38.5"]);
        for i in 0..=self.chance.below(3) {
            let (target, _) = self.target();
            let words = self.place(target, [true; 3]);
            // The second touch needs no word either.
            let feed = 40 + self.chance.below(90);
            self.line(&if i == 0 {
                format!("{code}{words} F{feed}")
            } else {
                words.trim().to_owned()
            });
            self.place = target;
        }
        let (target, _) = self.target();
        let words = self.place(target, [true; 3]);
        self.line(&format!("G0{words}"));
        (self.place, self.motion) = (target, "G0");
    }

    fn arc(&mut self) {
        let [a, o, w] = [[0, 1, 2], [2, 0, 1], [1, 2, 0]][self.modes.plane];
        let center = ["I", "J", "K"];
        let turn = self.chance.one(&["G2", "G3", "G02", "G03"]);
        let mut target = self.place;
        let middle = [
            8 * (1 + self.chance.below(9) as i64),
            8 * self.chance.below(9) as i64,
        ];
        let words = match self.chance.below(3) {
            // Half a circle, or a whole one, up along the third axis.
            0 => {
                let whole = self.chance.below(3) == 0;
                (target[a], target[o]) = if whole {
                    (target[a], target[o])
                } else {
                    (target[a] + 2 * middle[0], target[o] + 2 * middle[1])
                };
                target[w] += 8 * self.chance.below(3) as i64;
                let place = self.place(target, [true; 3]);
                format!(
                    "{turn}{place} {}{} {}{}",
                    center[a],
                    self.value(middle[0]),
                    center[o],
                    self.value(middle[1])
                )
            }
            // With an absolute centre.
            1 => {
                (target[a], target[o]) = (target[a] + 2 * middle[0], target[o] + 2 * middle[1]);
                let place = self.place(target, [true; 3]);
                let [x, y] = [self.place[a] + middle[0], self.place[o] + middle[1]];
                self.line("G90.1");
                let words = format!(
                    "{turn}{place} {}{} {}{}",
                    center[a],
                    self.value(x),
                    center[o],
                    self.value(y)
                );
                self.line(&words);
                (self.place, self.motion) = (target, "arc");
                return self.line("G91.1");
            }
            _ => {
                (target[a], target[o]) =
                    (target[a] + 24, target[o] + 8 * self.chance.below(5) as i64);
                let place = self.place(target, [true; 3]);
                let sign = self.chance.one(&["", "-"]);
                let radius = 8 * (4 + self.chance.below(20) as i64);
                format!("{turn}{place} R{sign}{}", self.value(radius))
            }
        };
        self.line(&words);
        (self.place, self.motion) = (target, "arc");
    }

    fn mode(&mut self) {
        match self.chance.below(7) {
            0 => self.modes.plane = self.chance.below(3) as usize,
            1 => self.modes.inch = !self.modes.inch,
            2 => self.modes.absolute = !self.modes.absolute,
            3 => {
                let word = self.chance.one(&["M70", "M73"]);
                self.line(word);
                self.kept = Some(self.modes);
                return;
            }
            4 => {
                let Some(kept) = self.kept else { return };
                self.line("M72");
                self.modes = kept;
                // It may restore a missing feed.
                return self.line("F120");
            }
            5 => {
                let word = self.chance.one(&["G54", "G55", "G59", "G59.3", "G54"]);
                return self.line(word);
            }
            _ => {
                let words = [
                    "G4 P0.01",
                    "M3 S500",
                    "M5",
                    "T1",
                    "(G0 X5)",
                    "G61",
                    "G61.1",
                    "G64 P0.01",
                    "G40",
                    "G94 F130",
                    "G80 G40",
                    "M8",
                    "M9",
                    "G98",
                    "G99",
                    "G28.1",
                    "G30.1",
                    "M1",
                    "G97",
                    "G17.0",
                    "M48",
                    "G8",
                    "#5=[1+2]",
                    "S100",
                ];
                let mut word = self.chance.one(&words);
                if word == "G17.0" {
                    (word, self.modes.plane) = ("G17", 0);
                }
                if word.contains("G80") {
                    self.motion = "none";
                }
                return self.line(word);
            }
        }
        let modes = self.modes;
        let word = [
            ["G17", "G18", "G19"][modes.plane],
            if modes.inch { "G20" } else { "G21" },
            if modes.absolute { "G90" } else { "G91" },
        ];
        let words = if self.chance.below(2) == 0 {
            word.join(" ")
        } else {
            format!("{} F{}", word.join(" "), 100 + self.chance.below(400))
        };
        self.line(&words);
    }
}

fn program(seed: u64) -> (String, Vec<bool>) {
    let modes = Modes {
        inch: false,
        absolute: true,
        plane: 0,
    };
    let mut writer = Writer {
        chance: Chance(seed),
        text: String::new(),
        modes,
        kept: None,
        place: [0, 0, 80],
        inch: Vec::new(),
        motion: "G0",
    };
    writer.modes.inch = seed.is_multiple_of(3);
    let begin = if writer.modes.inch {
        "G20 G90 G17 F100"
    } else {
        "G21 G90 G17 F100"
    };
    writer.line(begin);
    let first = format!("G0{}", writer.place([0, 0, 80], [true; 3]));
    writer.line(&first);
    for _ in 0..60 {
        match writer.chance.below(10) {
            0..=3 => writer.straight(),
            4 | 5 => writer.arc(),
            6 => writer.touches(),
            _ => writer.mode(),
        }
    }
    writer.line("M2");
    (writer.text, writer.inch)
}

/// Moves of the interpreter, in mm.
fn interpreted(calls: &[String], inch: &[bool]) -> Vec<Found> {
    let mut plane = [0, 1, 2];
    let mut found = Vec::new();
    for call in calls {
        let Some((number, rest)) = call
            .split_once(" N")
            .map(|(_, rest)| rest.split_once(' ').unwrap_or((rest, "")))
        else {
            continue;
        };
        let Some((word, arguments)) = rest.trim_start().split_once('(') else {
            continue;
        };
        let arguments = arguments.trim_end_matches(')');
        if word == "SELECT_PLANE" {
            plane = match arguments {
                "CANON_PLANE_XZ" => [2, 0, 1],
                "CANON_PLANE_YZ" => [1, 2, 0],
                _ => [0, 1, 2],
            };
        }
        let numbers: Vec<f64> = arguments
            .split(',')
            .filter_map(|n| n.trim().parse().ok())
            .collect();
        let (kind, to) = match word {
            "STRAIGHT_TRAVERSE" => ("rapid", [numbers[0], numbers[1], numbers[2]]),
            "STRAIGHT_FEED" => ("feed", [numbers[0], numbers[1], numbers[2]]),
            "STRAIGHT_PROBE" => ("probe", [numbers[0], numbers[1], numbers[2]]),
            "ARC_FEED" => {
                let mut to = [0.0; 3];
                (to[plane[0]], to[plane[1]], to[plane[2]]) = (numbers[0], numbers[1], numbers[5]);
                ("feed", to)
            }
            _ => continue,
        };
        let line: usize = number.parse().expect("every line has a number");
        let unit = if inch[line - 1] { 25.4 } else { 1.0 };
        found.push(Found {
            line,
            kind,
            to: to.map(|x| x * unit),
        });
    }
    found
}

#[test]
fn every_line_moves_as_the_interpreter_moves_it() {
    let (mut moves, mut programs) = (0, 0);
    for seed in 1..=120 {
        let (text, inch) = program(seed * 7919);
        let calls = canonical(&text);
        assert!(
            calls.iter().any(|call| call.contains("PROGRAM_END")),
            "it did not come to its end: {:?}\n{text}",
            calls.last()
        );
        let wanted = interpreted(&calls, &inch);
        let path = read_program(&text, None);
        let unit = if path.metric == Some(false) {
            25.4
        } else {
            1.0
        };
        let found: Vec<Found> = (0..path.len())
            .map(|i| Found {
                line: path.line[i] as usize + 1,
                kind: KINDS[usize::from(path.kind[i])],
                to: path.end(i).to_array().map(|x| x * unit),
            })
            .collect();
        for (found, wanted) in found.iter().zip(&wanted) {
            let near = (0..3).all(|axis| (found.to[axis] - wanted.to[axis]).abs() < 4e-3);
            assert!(
                found.line == wanted.line && found.kind == wanted.kind && near,
                "{found:?}, truly {wanted:?}\n{text}"
            );
        }
        assert_eq!(found.len(), wanted.len(), "{text}");
        // No position is unknown here.
        let odd = path
            .findings
            .iter()
            .find(|f| f.code == "lines-skipped" && !f.message.contains("These variables"));
        assert!(odd.is_none(), "{odd:?}\n{text}");
        moves += found.len();
        programs += 1;
    }
    assert!(
        programs == 120 && moves > 5000,
        "{programs} programs, {moves} moves"
    );
}
