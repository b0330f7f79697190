//! Simulated SINUMERIK, just large enough for the generated programs: its own arithmetic, its own jumps, a probe whose triggers a test sets. It shares only the
//! reader's syntax tree.

use std::collections::HashMap;

use crate::common::mpf::{Program, Statement, Term};

/// A control with a part in it.
#[derive(Clone, Debug)]
pub struct Machine {
    pub r: HashMap<usize, f64>,
    pub names: HashMap<String, f64>,
    /// Shift, rotation, mirror, scale and fine shift of the only work offset, by axis.
    pub frame: [[f64; 3]; 5],
    /// Trigger position of each touch; without one it runs to its end.
    pub triggers: Vec<Option<[f64; 3]>>,
    /// Number of the positioning move with a contact.
    pub contact_in: Option<f64>,
    /// The same for the frames after it: programmed, tool, workpiece.
    pub behind: [[[f64; 3]; 5]; 3],
    pub metric: bool,
    /// Probe input of the probe; the other one has no signal.
    pub input: u8,
    /// The active tool offset, D.
    pub tool_offset: u8,
    /// Number of the active tool; by default the one that the program states.
    pub tool: Option<f64>,
    pub deflected: bool,
    /// The touch, counted from 1, from which on the probe stays deflected.
    pub stuck_from: Option<usize>,
    pub message: String,
    /// Every message, in order.
    pub messages: Vec<String>,
    pub alarm: Option<f64>,
    /// Lines that it wrote into a file.
    pub written: Vec<String>,
    /// Ends of all moves.
    pub path: Vec<[f64; 3]>,
    pub writes: usize,
    /// `_OVR`, the results of the last measuring cycle.
    pub results: HashMap<usize, f64>,
    /// Wear of tools, by name of the register, tool and edge.
    pub tools: HashMap<(String, usize, usize), f64>,
    /// Number of times that M0 stopped it.
    pub waits: usize,
    /// Position of the ball before the program.
    pub start: [f64; 3],
    touched: usize,
    state: f64,
}

/// Runs a measuring cycle by its number, its arguments (omitted ones are NaN) and the position of the ball. Returns entries of `_OVR`.
pub type Cycles<'c> = &'c mut dyn FnMut(u32, &[f64], [f64; 3]) -> Vec<(usize, f64)>;

/// Registers of tools that a program may write.
const TOOLS: [&str; 2] = ["$TC_DP12", "$TC_DP15"];

fn register(name: &str, parts: &[Term]) -> Result<(String, usize, usize), String> {
    match parts {
        [Term::Number(tool), Term::Number(edge)] => {
            Ok((name.to_owned(), *tool as usize, *edge as usize))
        }
        _ => Err(format!("{name} needs a tool and its edge")),
    }
}

impl Machine {
    pub fn new(triggers: Vec<Option<[f64; 3]>>) -> Self {
        Machine {
            r: HashMap::new(),
            names: HashMap::new(),
            frame: [[0.0; 3], [0.0; 3], [0.0; 3], [1.0; 3], [0.0; 3]],
            behind: [[[0.0; 3], [0.0; 3], [0.0; 3], [1.0; 3], [0.0; 3]]; 3],
            triggers,
            contact_in: None,
            metric: true,
            input: 1,
            tool_offset: 1,
            tool: None,
            deflected: false,
            stuck_from: None,
            message: String::new(),
            messages: Vec::new(),
            alarm: None,
            written: Vec::new(),
            path: Vec::new(),
            writes: 0,
            results: HashMap::new(),
            tools: HashMap::new(),
            waits: 0,
            start: [f64::NAN; 3],
            touched: 0,
            state: 0.0,
        }
    }

    fn is_deflected(&self) -> bool {
        self.deflected || self.stuck_from.is_some_and(|touch| self.touched >= touch)
    }

    pub fn run(&mut self, program: &Program) -> Result<(), String> {
        self.run_with(program, &mut |_, _, _| Vec::new())
    }

    /// Runs a program that calls measuring cycles.
    pub fn run_with(&mut self, program: &Program, cycles: Cycles<'_>) -> Result<(), String> {
        let stated = |comment: &String| comment.strip_prefix("The probe is tool ")?.parse().ok();
        self.tool = self
            .tool
            .or_else(|| program.comments.iter().find_map(stated));
        let mut at = self.start;
        let mut next = 0;
        for _ in 0..20_000 {
            let block = program
                .blocks
                .get(next)
                .ok_or("ran off the end: M30 is missing")?;
            let line = block.line;
            let jump = |label: &str| {
                let found = program.blocks[next..]
                    .iter()
                    .position(|b| b.statement == Statement::Label(label.to_owned()));
                found
                    .map(|i| next + i)
                    .ok_or(format!("line {line}: no label {label}"))
            };
            let mut then = next + 1;
            match &block.statement {
                Statement::Declare(name) => {
                    self.names.insert(name.clone(), 0.0);
                }
                Statement::Label(_) => {}
                Statement::Jump(label) => then = jump(label)?,
                Statement::If(condition, label) => {
                    if self.value(condition, at)? != 0.0 {
                        then = jump(label)?;
                    }
                }
                Statement::Assign(place, value) => {
                    let value = self.value(value, at)?;
                    match place {
                        Term::Register(n) => drop(self.r.insert(*n, value)),
                        Term::Name(name) if self.names.contains_key(name) => {
                            self.names.insert(name.clone(), value);
                        }
                        Term::System(name, parts) if name == "$P_UIFR" => {
                            let (part, axis) = component(parts)?;
                            self.frame[part][axis] = value;
                            self.writes += 1;
                        }
                        Term::System(name, parts) if TOOLS.contains(&name.as_str()) => {
                            self.tools.insert(register(name, parts)?, value);
                        }
                        other => return Err(format!("line {line}: {other:?} cannot be written")),
                    }
                }
                Statement::Motion(motion) => {
                    let mut to = [0, 1, 2].map(|axis| motion.axes[axis].unwrap_or(at[axis]));
                    for (axis, sum) in motion.sums.iter().enumerate() {
                        if let Some(sum) = sum {
                            to[axis] = self.value(sum, at)?;
                        }
                    }
                    let deflected = self.is_deflected();
                    let connected = motion.measuring == Some(self.input);
                    if motion.measuring.is_some() {
                        // MEAS waits for the edge of the signal: a probe that is already deflected gives none.
                        self.state = 0.0;
                        // The check two blocks later shows whether this move is a touch.
                        let touch = matches!(
                            &program.blocks[next + 2].statement,
                            Statement::If(Term::Binary("==", ..), _)
                        );
                        if touch {
                            if motion.axes.contains(&None) {
                                return Err(format!(
                                    "line {line}: MEAS latches the axes that its block names"
                                ));
                            }
                            if let Some(Some(trigger)) = self
                                .triggers
                                .get(self.touched)
                                .filter(|_| connected && !deflected)
                            {
                                (to, self.state) = (*trigger, 1.0);
                            }
                            self.touched += 1;
                        } else if connected
                            && !deflected
                            && self.contact_in == self.names.get("TP_MOVE").copied()
                        {
                            self.state = 1.0;
                            to = [0, 1, 2].map(|i| {
                                if at[i].is_nan() {
                                    to[i]
                                } else {
                                    (at[i] + to[i]) / 2.0
                                }
                            });
                        }
                    }
                    at = to;
                    self.path.push(at);
                }
                Statement::Words(words) => {
                    self.waits += usize::from(*words == ["M0"]);
                    // The operator restarts it.
                    if words.iter().any(|w| w == "M30") {
                        return Ok(());
                    }
                }
                Statement::Call(name, arguments) => match (name.as_str(), arguments.as_slice()) {
                    ("MSG", [Some(text)]) => {
                        self.message = self.text(text, at)?;
                        self.messages.push(self.message.clone());
                    }
                    // A line of a file in the control.
                    ("WRITE", [Some(_), Some(_), Some(text)]) => {
                        self.written.push(self.text(text, at)?)
                    }
                    ("SETAL", [Some(number)]) => self.alarm = Some(self.value(number, at)?),
                    // The hundreds of its variant: it corrects the work offset itself.
                    ("CYCLE977" | "CYCLE978", [Some(Term::Number(variant)), ..]) => {
                        self.writes += usize::from(*variant % 1000.0 >= 100.0);
                        let given = arguments.iter().map(|given| match given {
                            None | Some(Term::Text(_)) => Ok(f64::NAN),
                            Some(term) => self.value(term, at),
                        });
                        let given = given.collect::<Result<Vec<f64>, _>>()?;
                        let number = name["CYCLE".len()..].parse().unwrap();
                        self.results.extend(cycles(number, &given, at));
                    }
                    _ => return Err(format!("line {line}: {name} is not known")),
                },
            }
            next = then;
        }
        Err("it never ends".to_owned())
    }

    fn text(&self, term: &Term, at: [f64; 3]) -> Result<String, String> {
        match term {
            Term::Text(text) => Ok(text.clone()),
            Term::Binary("<<", a, b) => Ok(self.text(a, at)? + &self.text(b, at)?),
            other => Ok(self.value(other, at)?.to_string()),
        }
    }

    fn value(&self, term: &Term, at: [f64; 3]) -> Result<f64, String> {
        let truth = |b: bool| f64::from(u8::from(b));
        Ok(match term {
            Term::Number(x) => *x,
            Term::Register(n) => *self
                .r
                .get(n)
                .ok_or(format!("R{n} is read before it is set"))?,
            Term::Name(name) => *self
                .names
                .get(name)
                .ok_or(format!("{name} is not declared"))?,
            Term::Minus(a) => -self.value(a, at)?,
            Term::Binary(op, a, b) => {
                let (a, b) = (self.value(a, at)?, self.value(b, at)?);
                match *op {
                    "+" => a + b,
                    "-" => a - b,
                    "*" => a * b,
                    "/" => a / b,
                    "==" => truth(a == b),
                    "<>" => truth(a != b),
                    ">=" => truth(a >= b),
                    "<=" => truth(a <= b),
                    ">" => truth(a > b),
                    "OR" => truth(a != 0.0 || b != 0.0),
                    op => return Err(format!("{op}?")),
                }
            }
            Term::Call(name, a) => {
                let values: Result<Vec<f64>, String> =
                    a.iter().map(|a| self.value(a, at)).collect();
                match (name.as_str(), values?.as_slice()) {
                    ("SIN", [x]) => x.to_radians().sin(),
                    ("COS", [x]) => x.to_radians().cos(),
                    ("SQRT", [x]) => x.sqrt(),
                    ("ABS", [x]) => x.abs(),
                    ("ATAN2", [y, x]) => y.atan2(*x).to_degrees(),
                    (name, _) => return Err(format!("{name}?")),
                }
            }
            Term::System(name, parts) => match (name.as_str(), parts.as_slice()) {
                ("$AC_MEA" | "$A_PROBE", [Term::Number(input)])
                    if *input != f64::from(self.input) =>
                {
                    0.0
                }
                ("$AC_MEA", _) => self.state,
                ("$P_TOOLNO", []) => self.tool.ok_or("no tool is stated")?,
                (name, parts) if TOOLS.contains(&name) => {
                    let register = register(name, parts)?;
                    self.tools.get(&register).copied().unwrap_or(0.0)
                }
                ("$P_TOOL", []) => f64::from(self.tool_offset),
                // Results of the measuring cycles.
                ("_OVR", [Term::Number(entry)]) => {
                    let held = self.results.get(&(*entry as usize));
                    held.copied().unwrap_or(0.0)
                }
                ("$A_PROBE", _) => truth(self.is_deflected()),
                ("$MN_SCALING_SYSTEM_IS_METRIC", []) => truth(self.metric),
                ("$AA_MW" | "$AA_IW", [axis]) => at[axis_of(axis)?],
                ("$P_UIFR", parts) => {
                    let (part, axis) = component(parts)?;
                    self.frame[part][axis]
                }
                (name, [axis, Term::Name(part)]) => {
                    let frames = ["$P_PFRAME", "$P_TOOLFRAME", "$P_WPFRAME"];
                    let frame = frames
                        .iter()
                        .position(|f| *f == name)
                        .ok_or(format!("{name}?"))?;
                    self.behind[frame][part_of(part)?][axis_of(axis)?]
                }
                (name, _) => return Err(format!("{name}?")),
            },
            Term::Text(_) => return Err("a text is no number".to_owned()),
        })
    }
}

fn axis_of(term: &Term) -> Result<usize, String> {
    match term {
        Term::Name(name) => ["X", "Y", "Z"]
            .iter()
            .position(|n| n == name)
            .ok_or(format!("axis {name}?")),
        other => Err(format!("{other:?} is no axis")),
    }
}

fn part_of(part: &str) -> Result<usize, String> {
    ["TR", "RT", "MI", "SC", "FI"]
        .iter()
        .position(|p| *p == part)
        .ok_or(format!("{part}?"))
}

fn component(parts: &[Term]) -> Result<(usize, usize), String> {
    match parts {
        [Term::Number(_), axis, Term::Name(part)] => Ok((part_of(part)?, axis_of(axis)?)),
        other => Err(format!("{other:?} is no part of a frame")),
    }
}
