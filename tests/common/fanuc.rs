//! Simulated Fanuc or Haas: runs the text of a program line by line, with its own arithmetic, jumps and a probe whose contacts a test sets. It shares no code
//! with the crate.

use std::collections::HashMap;

/// A control with a part. Positions are in the active work offset, in the units of the program.
#[derive(Clone, Debug)]
pub struct Control {
    pub haas: bool,
    /// Variables that the program has set, and variables of the control.
    pub variables: HashMap<i64, f64>,
    /// Length of the tool, and whether #5043 and #5063 include it: parameter 6014 bit 4 of a Fanuc excludes it.
    pub length: f64,
    pub length_included: bool,
    /// Position of the ball.
    pub at: [f64; 3],
    /// Next contacts of the ball, in this order.
    pub contacts: Vec<[f64; 3]>,
    /// Number of the move (#149) that an obstacle stops half-way.
    pub blocked: Option<f64>,
    /// Number of the move at whose start the probe signals falsely.
    pub early: Option<f64>,
    /// Whether ATAN returns 0 to 360 instead of -180 to 180 degrees: parameter 6004 bit 0.
    pub full_circle: bool,
    /// Modal codes: 4006 units, 4008 length, 4011 scale, 4016 rotation, 4017 polar, 4022 mirror; 4111 is the number of the length.
    pub modal: [(i64, f64); 7],
    /// Number of times that M0 stopped it and it was restarted.
    pub stops: usize,
    /// Ends of all motions, and whether each was a G31.
    pub path: Vec<([f64; 3], bool)>,
    /// Cause of the stop: number and text, or the control's own alarm.
    pub alarm: Option<String>,
    /// Messages at which it waited.
    pub messages: Vec<String>,
    /// Writes to origins of work offsets, in order.
    pub writes: Vec<i64>,
    /// Writes to registers of tools, in order.
    pub tools: Vec<i64>,
    pub offset: String,
    /// Whether the previous block moved: a control evaluates the next block during the motion.
    moving: bool,
}

/// Runs a macro by its number and letters. Returns the variables that it sets.
pub type Macros<'m> = &'m mut dyn FnMut(u32, &[(char, f64)]) -> Vec<(i64, f64)>;

impl Control {
    pub fn new(haas: bool, inch: bool) -> Self {
        Control {
            haas,
            variables: HashMap::new(),
            length: 121.5,
            length_included: true,
            at: [417.0, -233.0, 301.0],
            contacts: Vec::new(),
            blocked: None,
            early: None,
            full_circle: true,
            modal: [
                (4006, if inch { 20.0 } else { 21.0 }),
                (4008, 43.0),
                (4011, 50.0),
                (4016, 69.0),
                (4017, 15.0),
                (4022, 50.1),
                (4111, 7.0),
            ],
            stops: 0,
            path: Vec::new(),
            alarm: None,
            messages: Vec::new(),
            writes: Vec::new(),
            tools: Vec::new(),
            offset: String::new(),
            moving: false,
        }
    }

    pub fn run(&mut self, text: &str) -> Result<(), String> {
        self.run_with(text, &mut |number, _| panic!("P{number} is not installed"))
    }

    /// Runs a program that calls macros.
    pub fn run_with(&mut self, text: &str, macros: Macros<'_>) -> Result<(), String> {
        let lines: Vec<&str> = text.lines().collect();
        // The operator loads the tool that the program states.
        let stated = |line: &&str| {
            let number = line
                .strip_prefix("(THE PROBE IS TOOL ")?
                .strip_suffix(')')?;
            number.parse().ok()
        };
        if let Some(tool) = lines.iter().find_map(stated) {
            self.variables
                .entry(if self.haas { 3026 } else { 4120 })
                .or_insert(tool);
        }
        let mut next = 0;
        for _ in 0..200_000 {
            let full = *lines.get(next).ok_or("ran off the end: M30 is missing")?;
            let line = next + 1;
            let fail = |what: &str| format!("line {line}: {what}: {full}");
            if full
                .bytes()
                .any(|b| b.is_ascii_lowercase() || !b.is_ascii())
            {
                return Err(fail("a sign that the control has not"));
            }
            let code = full.split('(').next().unwrap().trim();
            next += 1;
            // Labels and comments take no time.
            let empty = code.is_empty() || code == "%" || code.starts_with('N');
            if self.moving
                && !empty
                && (code.contains("#50")
                    || code.starts_with("#3000")
                    || code.starts_with("#52")
                    || code.starts_with("#140"))
            {
                return Err(fail(
                    "this is evaluated while the motion before it still runs",
                ));
            }
            self.moving &= empty;
            let label = |word: &str| {
                let wanted = format!("N{}", word.trim());
                let place = lines
                    .iter()
                    .position(|l| *l == wanted)
                    .ok_or(format!("no label {wanted}"));
                if lines.iter().filter(|l| **l == wanted).count() > 1 {
                    Err(format!("{wanted} twice"))
                } else {
                    place
                }
            };
            if code.is_empty() || code == "%" || code.starts_with('O') || code.starts_with('N') {
                continue;
            }
            if let Some(rest) = code.strip_prefix("IF [") {
                let jump = rest.rsplit_once("] GOTO ");
                let (condition, target) = jump
                    .or(rest.rsplit_once("] THEN "))
                    .ok_or_else(|| fail("an IF without what it does"))?;
                let operator = [" EQ ", " NE ", " LT ", " LE ", " GT ", " GE "]
                    .into_iter()
                    .find(|op| condition.contains(op));
                let operator = operator.ok_or_else(|| fail("no comparison"))?;
                let (left, right) = condition.split_once(operator).unwrap();
                let (left, right) = (
                    self.value(left).map_err(|e| fail(&e))?,
                    self.value(right).map_err(|e| fail(&e))?,
                );
                let holds = match operator.trim() {
                    "EQ" => left == right,
                    "NE" => left != right,
                    "LT" => left < right,
                    "LE" => left <= right,
                    "GT" => left > right,
                    _ => left >= right,
                };
                if holds && jump.is_some() {
                    next = label(target)?;
                } else if holds {
                    let (number, value) = target
                        .split_once('=')
                        .ok_or_else(|| fail("no assignment"))?;
                    let number: i64 = number[1..].parse().map_err(|_| fail("no variable"))?;
                    let value = self.value(value).map_err(|e| fail(&e))?;
                    assert!((100..=147).contains(&number), "{full}");
                    self.variables.insert(number, value);
                }
            } else if let Some(call) = code.strip_prefix("G65 P") {
                let mut words = call.split(' ');
                let number = words.next().and_then(|number| number.parse().ok());
                let number = number.ok_or_else(|| fail("no number of a macro"))?;
                let letter = |word: &str| {
                    let point = word.contains('.');
                    let value = self.value(&word[1..]).map_err(|e| fail(&e))?;
                    let letter = word.chars().next().unwrap();
                    if point {
                        Ok((letter, value))
                    } else {
                        Err(fail("no point"))
                    }
                };
                let letters = words.map(letter).collect::<Result<Vec<_>, _>>()?;
                self.variables.extend(macros(number, &letters));
            } else if let Some(target) = code.strip_prefix("GOTO ") {
                next = label(target)?;
            } else if let Some(rest) = code.strip_prefix('#') {
                let (number, value) = rest.split_once('=').ok_or_else(|| fail("no assignment"))?;
                let number: i64 = number.parse().map_err(|_| fail("no variable"))?;
                let value = self.value(value).map_err(|e| fail(&e))?;
                if number == 3000 {
                    let text = full
                        .split_once('(')
                        .map_or("", |(_, text)| text.trim_end_matches(')'));
                    if text.len() > 26 {
                        return Err(fail("a message is longer than the control shows"));
                    }
                    self.alarm = Some(format!("{value} {text}"));
                    return Ok(());
                }
                if number == 3006 {
                    self.messages.push(full.to_owned());
                    self.stops += 1;
                    continue;
                }
                if matches!(number, 5221..=5340 | 7001..=7960 | 14_001..=15_980) {
                    self.writes.push(number);
                } else if self
                    .tool_tables()
                    .iter()
                    .any(|table| table.contains(&number))
                {
                    self.tools.push(number);
                } else if !matches!(number, 1..=33 | 100..=149 | 500..=999) {
                    return Err(fail("this variable is not for a program"));
                }
                self.variables.insert(number, value);
            } else if self.words(code).map_err(|e| fail(&e))? {
                return Ok(());
            }
        }
        Err("does not end".to_owned())
    }

    /// Variables with the wear of tools: of a Fanuc also the compensation of memory A.
    fn tool_tables(&self) -> Vec<std::ops::RangeInclusive<i64>> {
        match self.haas {
            true => vec![2201..=2400, 2601..=2800],
            false => vec![2001..=2200, 10_001..=10_999, 12_001..=12_999],
        }
    }

    /// Runs a block of words; returns whether the program has ended.
    fn words(&mut self, code: &str) -> Result<bool, String> {
        let words: Vec<&str> = code.split(' ').collect();
        let (mut to, mut feed, mut motion, mut axes) = (self.at, None, "", 0);
        let (mut free, mut must) = (false, false);
        for word in &words {
            let number = |word: &str| -> Result<f64, String> {
                // Without a decimal point a number counts in the smallest increment.
                if word.contains('.') {
                    word[1..]
                        .parse()
                        .map_err(|_| format!("{word} is no number"))
                } else {
                    Err(format!("{word} has no point"))
                }
            };
            match word.as_bytes()[0] {
                b'X' | b'Y' | b'Z' => {
                    let sum = word[1..].starts_with('[') && word.contains('.');
                    to[usize::from(word.as_bytes()[0] - b'X')] = if sum {
                        self.value(&word[1..])?
                    } else {
                        number(word)?
                    };
                    axes += 1;
                }
                b'F' => feed = Some(number(word)?),
                _ => match *word {
                    "G0" | "G1" | "G31" => motion = word,
                    "G20" | "G21"
                        if words.len() == 1
                            && self.modal[0].1 == word[1..].parse::<f64>().unwrap() => {}
                    "G17" | "G18" | "G19" | "G40" | "G80" | "G90" | "G94" | "G53" | "M5" | "M9" => {
                    }
                    "G54" | "G55" | "G56" | "G57" | "G58" | "G59" => {
                        self.offset = (*word).to_owned()
                    }
                    "G154" if self.haas => self.offset = code.to_owned(),
                    "G54.1" if !self.haas => self.offset = code.to_owned(),
                    "G103" if self.haas => {}
                    "M78" if self.haas => free = true,
                    "M79" if self.haas => must = true,
                    "M0" => self.stops += 1,
                    // A Haas uses the angle, a Fanuc turns to its set angle.
                    "M19" => {}
                    _ if word.starts_with('R') && self.haas && words[0] == "M19" => {}
                    "POPEN" | "PCLOS" => {}
                    _ if word.starts_with("DPRNT[") => {}
                    "M30" => return Ok(true),
                    _ if word.starts_with('P') && matches!(words[0], "G154" | "G103" | "G54.1") => {
                    }
                    _ => return Err(format!("{word} is not known")),
                },
            }
        }
        if axes == 0 {
            return if motion.is_empty() {
                Ok(false)
            } else {
                Err("a motion to nowhere".to_owned())
            };
        }
        if motion.is_empty() || (motion != "G0" && feed.is_none_or(|f| f <= 0.0)) {
            return Err("a motion without its word or feed".to_owned());
        }
        let mut met = None;
        if motion == "G31" {
            let number = self.variables.get(&149).copied();
            met = self
                .contacts
                .first()
                .copied()
                .filter(|contact| on_the_way(self.at, to, *contact));
            if met.is_some() && self.early != number {
                self.contacts.remove(0);
            } else if self.early.is_some() && self.early == number {
                met = Some(self.at);
                self.early = None;
            } else if self.blocked.is_some() && self.blocked == number && self.at != to {
                met = Some([0, 1, 2].map(|i| (self.at[i] + to[i]) / 2.0));
                self.blocked = None;
            }
            let stop = met.unwrap_or(to);
            for (axis, place) in stop.into_iter().enumerate() {
                self.variables
                    .insert(5061 + axis as i64, place + self.bias(axis));
            }
        }
        self.at = met.unwrap_or(to);
        self.moving = true;
        self.path.push((to, motion == "G31"));
        if (free && met.is_some()) || (must && met.is_none()) {
            self.alarm = Some(if must { "M79" } else { "M78" }.to_owned());
            return Ok(true);
        }
        Ok(false)
    }

    fn bias(&self, axis: usize) -> f64 {
        if axis == 2 && self.length_included {
            self.length
        } else {
            0.0
        }
    }

    fn known(&self, number: i64) -> Result<f64, String> {
        Ok(match number {
            5041..=5043 => self.at[(number - 5041) as usize] + self.bias((number - 5041) as usize),
            5083 if self.haas => self.length,
            // Wear and length of tool 7, in two kinds of memory.
            2007 if !self.haas => 0.25,
            2207 if !self.haas => self.length - 0.25,
            4006..=4022 | 4111 => self
                .modal
                .iter()
                .find(|(code, _)| *code == number)
                .map(|(_, value)| *value)
                .ok_or("modal")?,
            // Variables that the control keeps, and registers of tools, have a value.
            _ => {
                let tools = self.tool_tables();
                let kept = (500..=999).contains(&number)
                    || tools.iter().any(|table| table.contains(&number));
                let value = self.variables.get(&number).copied();
                value
                    .or(kept.then_some(0.0))
                    .ok_or(format!("#{number} is empty"))?
            }
        })
    }

    fn value(&self, text: &str) -> Result<f64, String> {
        let mut rest = text.trim().as_bytes();
        let value = self.sum(&mut rest)?;
        if rest.is_empty() {
            Ok(value)
        } else {
            Err(format!("{} is left", String::from_utf8_lossy(rest)))
        }
    }

    fn sum(&self, rest: &mut &[u8]) -> Result<f64, String> {
        let mut value = self.product(rest)?;
        while let [sign @ (b'+' | b'-'), tail @ ..] = *rest {
            *rest = tail;
            let next = self.product(rest)?;
            value += if *sign == b'+' { next } else { -next };
        }
        Ok(value)
    }

    fn product(&self, rest: &mut &[u8]) -> Result<f64, String> {
        let mut value = self.factor(rest)?;
        while let [sign @ (b'*' | b'/'), tail @ ..] = *rest {
            *rest = tail;
            let next = self.factor(rest)?;
            value = if *sign == b'*' {
                value * next
            } else {
                value / next
            };
        }
        Ok(value)
    }

    fn factor(&self, rest: &mut &[u8]) -> Result<f64, String> {
        for name in ["SIN", "COS", "SQRT", "ABS", "ATAN"] {
            let Some(tail) = rest.strip_prefix(name.as_bytes()) else {
                continue;
            };
            *rest = tail;
            let x = self.factor(rest)?;
            return Ok(match name {
                "SIN" => x.to_radians().sin(),
                "COS" => x.to_radians().cos(),
                "SQRT" => x.sqrt(),
                "ABS" => x.abs(),
                _ => {
                    let Some(tail) = rest.strip_prefix(b"/") else {
                        return Err("ATAN without its second value".to_owned());
                    };
                    *rest = tail;
                    let angle = x.atan2(self.factor(rest)?).to_degrees();
                    if self.full_circle {
                        angle.rem_euclid(360.0)
                    } else {
                        angle
                    }
                }
            });
        }
        match *rest {
            [b'[', tail @ ..] => {
                *rest = tail;
                let value = self.sum(rest)?;
                *rest = rest.strip_prefix(b"]").ok_or("a bracket is not closed")?;
                Ok(value)
            }
            [b'-', tail @ ..] => {
                *rest = tail;
                Ok(-self.factor(rest)?)
            }
            [b'#', b'[', ..] => {
                *rest = &rest[1..];
                let number = self.factor(rest)?;
                self.known(number as i64)
            }
            [b'#', tail @ ..] => {
                *rest = tail;
                let number = digits(rest).parse::<i64>().map_err(|_| "no variable")?;
                self.known(number)
            }
            _ => digits(rest)
                .parse::<f64>()
                .map_err(|_| "no number".to_owned()),
        }
    }
}

fn digits(rest: &mut &[u8]) -> String {
    let end = rest
        .iter()
        .position(|b| !(b.is_ascii_digit() || *b == b'.'))
        .unwrap_or(rest.len());
    let (taken, tail) = rest.split_at(end);
    *rest = tail;
    String::from_utf8_lossy(taken).into_owned()
}

/// Whether a position is on the line between two others, within the last digits.
pub fn on_the_way(from: [f64; 3], to: [f64; 3], place: [f64; 3]) -> bool {
    let way = [0, 1, 2].map(|i| to[i] - from[i]);
    let off = [0, 1, 2].map(|i| place[i] - from[i]);
    let square: f64 = way.iter().map(|x| x * x).sum();
    let along = way.iter().zip(&off).map(|(a, b)| a * b).sum::<f64>() / square;
    let aside: f64 = (0..3)
        .map(|i| (off[i] - along * way[i]).powi(2))
        .sum::<f64>()
        .sqrt();
    square > 0.0 && (0.0..=1.0).contains(&along) && aside < 2e-3
}
