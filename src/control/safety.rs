//! Safety rules, each with a reason, checked against the trace of a program and not against its text.

use crate::control::Request;
use crate::control::iso::machine::{self, Run, TailOutcome, TailRunner};
use crate::control::iso::script::{Modes, Script, Slot};
use crate::control::prove::Followed;
use crate::control::rules::{
    ASKED, CONTACT_LIFTS, LOW_START, MISS_LIFTS, NO_LOW_RAPID, ONE_WRITE, PLACE, PLAUSIBLE,
    RESTART, TOLERANCE, WATCHED, WRITE_LAST,
};
use crate::control::trace::{Kind, ProbeConsequence, Step, WrittenValue};
use crate::formula::{CheckKind, ResultCheck};
use crate::geom::Vec3;
use crate::text::{Text, text, words};

#[derive(Debug)]
pub struct Rule {
    pub name: &'static str,
    /// The requirement, in a sentence.
    pub requirement: &'static str,
    pub why: &'static str,
    /// Whether a program that breaks it is refused. The others depend on the job.
    pub mandatory: bool,
    /// Whether a native cycle is responsible for it, so that nothing is known here.
    pub own_cycle: bool,
    /// Lines that the rule concerns, 0-based, whether they keep or break it.
    pub about: Scope,
    /// Finds the lines that break it, each with its fault.
    pub violations: fn(&RuleContext<'_>) -> Vec<Violation>,
}

/// Lines that a rule concerns.
#[derive(Clone, Copy, Debug)]
pub enum Scope {
    /// Line of the first motion.
    First,
    /// Line of the first touch.
    FirstTouch,
    /// Line of the last motion.
    Last,
    /// Lines of certain motions.
    Motions(fn(&Step) -> bool),
    /// Lines of the motions that are not retracts.
    Positioning,
    /// Lines that write a work offset or a tool.
    Writes,
}

/// A violation: the 0-based line, `None` for the whole program, and its description.
pub type Violation = (Option<usize>, Text);

/// Blocks at which the program is restarted, to see what it writes then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RestartPoints {
    /// Every block from the first motion on.
    Every,
    /// The blocks with most and fewest touches done, and those of the write: in a program of the writer the others give nothing else.
    Critical,
}

/// Input of a rule.
#[derive(Debug)]
pub struct RuleContext<'a> {
    /// The request of the program.
    pub request: &'a Request<'a>,
    pub followed: &'a Followed<'a>,
    pub restarts: RestartPoints,
}

/// Verdict of a rule on a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Name of the rule.
    pub rule: &'static str,
    /// Whether the rule holds; `None` if this control cannot guarantee it, or its native cycle is responsible for it.
    pub holds: Option<bool>,
    /// The requirement, the fault, or the reason why the control cannot guarantee it.
    pub message: Text,
    /// Lines that break the rule, 0-based.
    pub lines: Vec<usize>,
    /// Lines that the rule concerns, in order; those of native cycles if they are responsible for it.
    pub about: Vec<usize>,
    /// Whether a program that breaks it is refused.
    pub must: bool,
}

impl Verdict {
    /// Whether the program is refused for this rule.
    pub fn refuses(&self) -> bool {
        self.must && self.holds == Some(false)
    }
}

/// Every rule, in the order of a program.
pub static RULES: &[Rule] = &[
    Rule {
        name: "modes-stated",
        requirement: "Units, plane, absolute mode and feed per minute are stated before the first motion",
        why: "A mode left over from another program moves the probe elsewhere.",
        mandatory: true,
        own_cycle: false,
        about: Scope::First,
        violations: modes_stated,
    },
    Rule {
        name: "spindle-off",
        requirement: "The spindle is off before the first motion",
        why: "A rotating probe breaks its cable or its stylus.",
        mandatory: true,
        own_cycle: false,
        about: Scope::First,
        violations: spindle_off,
    },
    Rule {
        name: "probe-asked",
        requirement: "If the probe is deflected at the start, the program ends before the first touch",
        why: "A deflected probe reports nothing: the first move would run into the part.",
        mandatory: true,
        own_cycle: true,
        about: Scope::FirstTouch,
        violations: probe_asked,
    },
    Rule {
        name: "probe-free-again",
        requirement: "If the probe is still deflected after an unwatched move, the program ends before the next probing move",
        why: "A probe that stays deflected reports nothing: the next touch would run into the part.",
        mandatory: true,
        own_cycle: true,
        about: Scope::Motions(|step| step.still_deflected.is_some()),
        violations: probe_free_again,
    },
    Rule {
        name: LOW_START,
        requirement: "A stylus below the first position goes straight up first, or nothing moves",
        why: "A low move in the plane can hit a fixture or the part.",
        mandatory: true,
        own_cycle: false,
        about: Scope::First,
        violations: low_start,
    },
    Rule {
        name: WATCHED,
        requirement: "Every positioning move is watched, and a contact in it ends the program",
        why: "A contact that goes unnoticed breaks the probe.",
        mandatory: false,
        own_cycle: false,
        about: Scope::Positioning,
        violations: positioning_watched,
    },
    Rule {
        name: CONTACT_LIFTS,
        requirement: "A contact in positioning leads to an error exit that only retracts along the tool axis, and only if that path is free",
        why: "A probe left in contact is driven on by whatever runs next.",
        mandatory: true,
        own_cycle: false,
        about: Scope::Motions(|step| step.kind == Kind::Watched),
        violations: contact_lifts,
    },
    Rule {
        name: "missed-touch-stops",
        requirement: "A missed touch ends the program with an alarm",
        why: "A result without its touch is wrong, and would be written.",
        mandatory: true,
        own_cycle: true,
        about: Scope::Motions(|step| matches!(step.kind, Kind::Touch | Kind::Unchecked)),
        violations: missed_touch_stops,
    },
    Rule {
        name: MISS_LIFTS,
        requirement: "Every missed touch leads to the same exit, which only lifts",
        why: "After a missed touch the ball is at an unchecked position.",
        mandatory: true,
        own_cycle: true,
        about: Scope::Motions(|step| step.kind == Kind::Touch),
        violations: missed_touch_lifts,
    },
    Rule {
        name: "feeds-stated",
        requirement: "Every probing block has its own feed",
        why: "A feed left over from a rapid move is a hundred times too fast for a touch.",
        mandatory: true,
        own_cycle: false,
        about: Scope::Motions(Step::probes),
        violations: feeds_stated,
    },
    Rule {
        name: NO_LOW_RAPID,
        requirement: "No rapid moves down or across below the clearance plane, except as a retract from a touch",
        why: "The part is below it, and a rapid move does not stop in time.",
        mandatory: false,
        own_cycle: false,
        about: Scope::Motions(|step| step.kind == Kind::Rapid),
        violations: no_low_rapid,
    },
    Rule {
        name: WRITE_LAST,
        requirement: "No work offset and no tool is written before every touch has succeeded, and none on the way to an exit",
        why: "A half-measured offset looks like a good one.",
        mandatory: true,
        own_cycle: true,
        about: Scope::Writes,
        violations: offset_after_touches,
    },
    Rule {
        name: ONE_WRITE,
        requirement: "No more than one work offset is written, each of its values once",
        why: "A second write would apply the correction again.",
        mandatory: true,
        own_cycle: true,
        about: Scope::Writes,
        violations: one_write,
    },
    Rule {
        name: PLAUSIBLE,
        requirement: "A result that is off its nominal value by more than its limit ends the program with an alarm before anything is written",
        why: "A chip on the first wall would be written as the position of the part.",
        mandatory: true,
        own_cycle: true,
        about: Scope::Writes,
        violations: plausible_before_write,
    },
    Rule {
        name: ASKED,
        requirement: "If the job asks for it, the program waits for the operator before it writes a work offset or a tool",
        why: "The program would write a value that the operator has not seen.",
        mandatory: true,
        own_cycle: true,
        about: Scope::Writes,
        violations: asked_before_write,
    },
    Rule {
        name: TOLERANCE,
        requirement: "A result out of its tolerance stops the program where the job says so, and nowhere else",
        why: "Machining would continue on a bad part, or stop on a good one.",
        mandatory: true,
        own_cycle: true,
        about: Scope::Last,
        violations: tolerance_obeyed,
    },
    Rule {
        name: PLACE,
        requirement: "A result that a later cycle follows and that is off by more than its limit ends the program before it moves to that cycle",
        why: "A chip under the first touch would send the probe into the part.",
        mandatory: true,
        own_cycle: false,
        about: Scope::Last,
        violations: place_within_limit,
    },
    Rule {
        name: RESTART,
        requirement: "Started again in its middle, with variables empty or as the last run left them, the program writes nothing",
        why: "After an alarm operators start the last block again: touches that were not made would be written.",
        mandatory: true,
        own_cycle: true,
        about: Scope::Writes,
        violations: restart_writes_nothing,
    },
    Rule {
        name: "ends-above",
        requirement: "The program reaches its end, with the ball no lower than the path's end",
        why: "The next program starts where this one ends.",
        mandatory: true,
        own_cycle: false,
        about: Scope::Last,
        violations: ends_above,
    },
];

/// Verdicts on a program of a native cycle that is not traced.
pub fn not_followed() -> Vec<Verdict> {
    let message = text!("The native cycle makes every move itself");
    RULES
        .iter()
        .filter(|rule| ![TOLERANCE, PLACE, ASKED].contains(&rule.name))
        .map(|rule| Verdict {
            rule: rule.name,
            holds: None,
            message: message.to_owned(),
            lines: Vec::new(),
            about: Vec::new(),
            must: rule.mandatory,
        })
        .collect()
}

/// Verdicts on a traced program.
pub fn check(
    request: &Request<'_>,
    followed: &Followed<'_>,
    restarts: RestartPoints,
) -> Vec<Verdict> {
    let case = RuleContext {
        request,
        followed,
        restarts,
    };
    // If no tolerance has an action, the rule for tolerances is not reported.
    let tolerates = request
        .questions()
        .iter()
        .any(|question| question.asked != CheckKind::Plausibility);
    let follows = !request.path.shifts.is_empty();
    let asks = request.asks();
    // Rules that no job asks for are not reported.
    let asked = |rule: &&Rule| match rule.name {
        TOLERANCE => tolerates,
        PLACE => follows,
        ASKED => asks,
        _ => true,
    };
    RULES
        .iter()
        .filter(asked)
        .map(|rule| verdict(rule, &case))
        .collect()
}

fn verdict(rule: &Rule, case: &RuleContext<'_>) -> Verdict {
    let unable = case.request.post.why_not(rule.name);
    let own_cycle = rule.own_cycle && !case.followed.trace.natives.is_empty();
    let (holds, message, lines) = if let Some(why) = unable {
        (None, case.request.post.control_text(why), Vec::new())
    } else if own_cycle {
        (
            None,
            text!("The native cycle touches and writes automatically"),
            Vec::new(),
        )
    } else {
        let breaks = (rule.violations)(case);
        let lines = breaks.iter().filter_map(|(line, _)| *line).collect();
        match breaks.into_iter().next() {
            None if rule.name == WATCHED && case.first_way().is_some() => (
                Some(true),
                text!(
                    "Every positioning move except the approach to the first position is watched, and a contact in it ends the program"
                ),
                Vec::new(),
            ),
            None => (Some(true), Text::words(rule.requirement), Vec::new()),
            Some((_, what)) => (Some(false), what, lines),
        }
    };
    let about = match unable {
        Some(_) => Vec::new(),
        None if own_cycle => case.followed.trace.natives.clone(),
        None => case.lines(rule.about),
    };
    Verdict {
        rule: rule.name,
        holds,
        message,
        lines,
        about,
        must: rule.mandatory,
    }
}

impl RuleContext<'_> {
    fn steps(&self) -> &[Step] {
        &self.followed.trace.steps
    }

    /// A height of the path along the tool axis, in units of the program.
    fn level(&self, place: Vec3) -> f64 {
        place[self.tool()] / self.request.scale
    }

    fn tool(&self) -> usize {
        self.request.plane.axes()[2]
    }

    /// Half of the last digit of a position.
    fn digit(&self) -> f64 {
        self.request.post.half_digit(self.request.scale)
    }

    /// Lines that a rule concerns, in the order in which the program reaches them.
    fn lines(&self, about: Scope) -> Vec<usize> {
        if let Scope::Writes = about {
            return self
                .followed
                .trace
                .writes
                .iter()
                .map(|write| write.line)
                .collect();
        }
        let mut lines = Vec::new();
        for (i, step) in self.steps().iter().enumerate() {
            let asked = match about {
                Scope::First => i == 0,
                Scope::FirstTouch => step.kind == Kind::Touch && lines.is_empty(),
                Scope::Last => i + 1 == self.steps().len(),
                Scope::Motions(which) => which(step),
                Scope::Positioning => self.positions(i),
                Scope::Writes => false,
            };
            if asked && lines.last() != Some(&step.line) {
                lines.push(step.line);
            }
        }
        lines
    }

    /// Number of motions to the first position, on a control that cannot watch them because it does not know their start.
    fn first_way(&self) -> Option<usize> {
        let Request { path, post, .. } = self.request;
        if post.watches_first || path.start.is_some() {
            return None;
        }
        let first = path
            .moves
            .first()?
            .to
            .to_array()
            .map(|mm| mm / self.request.scale);
        self.steps()
            .iter()
            .position(|step| machine::near(step.to, first, self.digit()))
            .map(|last| last + 1)
    }

    /// Motions that are not retracts: index and motion.
    fn positioning(&self) -> impl Iterator<Item = (usize, &Step)> {
        self.steps()
            .iter()
            .enumerate()
            .filter(|(i, _)| self.positions(*i))
    }

    /// Whether a motion is neither a touch nor a retract.
    fn positions(&self, i: usize) -> bool {
        let (steps, step) = (self.steps(), &self.steps()[i]);
        let after_touch = i
            .checked_sub(1)
            .map(|before| &steps[before])
            .filter(|before| before.kind == Kind::Touch);
        let leads_back = after_touch.is_some_and(|touch| {
            machine::near(touch.from, step.to, self.digit()) && step.arc.is_none()
        });
        step.kind != Kind::Touch && !leads_back
    }
}

fn modes_stated(case: &RuleContext<'_>) -> Vec<Violation> {
    let Some(first) = case.steps().first() else {
        return Vec::new();
    };
    let modes = case.followed.trace.modes;
    let arcs = case.steps().iter().any(|step| step.arc.is_some());
    let exact = case.request.post.dialect.exact_stop;
    let right = [
        (
            words!("units"),
            modes.metric == Some(case.request.scale == 1.0),
        ),
        (words!("plane"), modes.plane == Some(case.request.plane)),
        (words!("absolute mode"), modes.absolute == Some(true)),
        (words!("feed per minute"), modes.per_minute == Some(true)),
        (
            words!("exact stop"),
            modes.exact != Some(false) && (!exact || modes.exact == Some(true)),
        ),
        (
            words!("centres of arcs"),
            !arcs || modes.arcs_incremental == Some(true),
        ),
        (
            words!("work offset"),
            modes.offset == case.request.work_offset,
        ),
    ];
    let mut breaks: Vec<Violation> = right
        .iter()
        .filter(|(_, right)| !right)
        .map(|(what, _)| {
            (
                Some(first.line),
                text!(
                    "This moves with {modes} not stated, or not as the job has them",
                    *what
                ),
            )
        })
        .collect();
    if modes.length == Some(false) {
        breaks.push((
            Some(first.line),
            text!("This moves with the length of the tool cancelled"),
        ));
    }
    // The spindle has its own rule.
    let changed = |now: Modes| {
        Modes {
            spindle: None,
            ..now
        } != Modes {
            spindle: None,
            ..modes
        }
    };
    let moved = case
        .followed
        .trace
        .changed
        .iter()
        .filter(|(_, now)| changed(*now));
    breaks.extend(moved.map(|(line, _)| {
        (
            Some(*line),
            text!("This moves after a mode was changed: units, plane, work offset or another"),
        )
    }));
    breaks
}

fn spindle_off(case: &RuleContext<'_>) -> Vec<Violation> {
    let Some(first) = case.steps().first() else {
        return Vec::new();
    };
    let trace = &case.followed.trace;
    if trace.modes.spindle != Some(false) {
        return vec![(
            Some(first.line),
            text!("This moves before the spindle is switched off"),
        )];
    }
    trace
        .spindle_line
        .into_iter()
        .map(|line| (Some(line), text!("This switches the spindle on")))
        .collect()
}

fn probe_asked(case: &RuleContext<'_>) -> Vec<Violation> {
    let Some(touch) = case.steps().iter().find(|step| step.kind == Kind::Touch) else {
        return Vec::new();
    };
    let run = Run {
        deflected: true,
        ..case.followed.run_start
    };
    match machine::deflected(&case.followed.script, run) {
        Ok(ProbeConsequence::ControlStops) => Vec::new(),
        Ok(ProbeConsequence::Exit {
            moves_sideways: false,
            writes: false,
            ..
        }) => Vec::new(),
        _ => {
            vec![(
                Some(touch.line),
                text!(
                    "If the probe is deflected at the start, the program still comes to this touch"
                ),
            )]
        }
    }
}

fn probe_free_again(case: &RuleContext<'_>) -> Vec<Violation> {
    let ends = |ending: ProbeConsequence| {
        matches!(
            ending,
            ProbeConsequence::ControlStops
                | ProbeConsequence::Exit {
                    moves_sideways: false,
                    writes: false,
                    ..
                }
        )
    };
    case.steps()
        .iter()
        .filter(|step| step.still_deflected.is_some_and(|ending| !ends(ending)))
        .map(|step| {
            (
                Some(step.line),
                text!("With a probe that is still deflected the program makes this probing move"),
            )
        })
        .collect()
}

fn low_start(case: &RuleContext<'_>) -> Vec<Violation> {
    let Some(first) = case.request.path.moves.first() else {
        return Vec::new();
    };
    let says = || text!("This moves in the plane below the first position");
    let (tool, height) = (case.tool(), case.level(first.to));
    let low = |step: &&Step| {
        let across =
            (0..3).any(|axis| axis != tool && step.known[axis] && step.from[axis] != step.to[axis]);
        across && step.to[tool] < height - case.digit()
    };
    case.followed
        .from_below
        .iter()
        .filter(low)
        .map(|step| (Some(step.line), says()))
        .collect()
}

fn positioning_watched(case: &RuleContext<'_>) -> Vec<Violation> {
    let shortest = case.request.shortest_watched() / case.request.scale;
    let first_way = case.first_way().unwrap_or(0);
    // Length of consecutive unwatched pieces.
    let (mut gone, mut last) = (0.0, None);
    case.positioning()
        .filter(|(i, step)| {
            if step.kind == Kind::Watched || *i < first_way {
                return false;
            }
            let way = (0..3)
                .map(|axis| (step.to[axis] - step.from[axis]).powi(2))
                .sum::<f64>()
                .sqrt();
            gone = if last.replace(*i) == i.checked_sub(1) {
                gone + way
            } else {
                way
            };
            gone.is_nan() || gone >= shortest
        })
        .map(|(_, step)| {
            (
                Some(step.line),
                text!("This move is not watched: a contact in it is not noticed"),
            )
        })
        .collect()
}

fn contact_lifts(case: &RuleContext<'_>) -> Vec<Violation> {
    let top = case.level(case.request.highest());
    let tool = case.tool();
    let bad = |step: &&Step| {
        // The contact is assumed half-way.
        let met = (step.from[tool] + step.to[tool]) / 2.0;
        let rises = step.to[tool] > step.from[tool] + crate::path::ONE_LEVEL / case.request.scale;
        let free = !rises && met < top - case.digit();
        match step.contact {
            // At the highest level of the path, within the last digit, a lift is neither needed nor harmful.
            ProbeConsequence::Exit {
                lifts,
                moves_sideways: strays,
                writes,
                ..
            } => {
                let known =
                    !step.from[tool].is_nan() && (rises || (met - top).abs() > 2.0 * case.digit());
                strays || writes || (lifts != free && known)
            }
            ProbeConsequence::ControlStops | ProbeConsequence::Continues => true,
        }
    };
    case.steps()
        .iter()
        .filter(|step| step.kind == Kind::Watched)
        .filter(bad)
        .map(|step| {
            (
                Some(step.line),
                text!(
                    "A contact in this move does not lead to an exit that lifts where up is free"
                ),
            )
        })
        .collect()
}

fn missed_touch_stops(case: &RuleContext<'_>) -> Vec<Violation> {
    let loose = case
        .steps()
        .iter()
        .filter(|step| step.kind == Kind::Unchecked);
    let mut breaks: Vec<Violation> = loose
        .map(|step| {
            (Some(step.line), text!("This probing move has no check: the program continues with and without a contact"))
        })
        .collect();
    let touches = case
        .steps()
        .iter()
        .filter(|step| step.kind == Kind::Touch)
        .count();
    if breaks.is_empty() && touches < case.request.path.touches.len() {
        breaks.push((
            None,
            text!("Not every touch of the path is a touch of the program"),
        ));
    }
    breaks
}

fn missed_touch_lifts(case: &RuleContext<'_>) -> Vec<Violation> {
    let mut exit = None;
    let top = case.level(case.request.highest());
    let tool = case.tool();
    let mut bad = |step: &&Step| match step.miss {
        ProbeConsequence::Exit {
            line,
            lifts,
            moves_sideways: strays,
            writes,
        } => {
            let same = *exit.get_or_insert(line) == line;
            let free = step.to[tool] < top - case.digit();
            !same || strays || writes || lifts != free
        }
        ProbeConsequence::ControlStops | ProbeConsequence::Continues => true,
    };
    case.steps()
        .iter()
        .filter(|step| step.kind == Kind::Touch)
        .filter(|step| bad(step))
        .map(|step| {
            (
                Some(step.line),
                text!("A miss of this touch does not lead to the one exit that lifts"),
            )
        })
        .collect()
}

fn feeds_stated(case: &RuleContext<'_>) -> Vec<Violation> {
    case.steps()
        .iter()
        .filter(|step| step.probes() && !step.states_feed)
        .map(|step| (Some(step.line), text!("This probing block has no feed")))
        .collect()
}

fn no_low_rapid(case: &RuleContext<'_>) -> Vec<Violation> {
    let (tool, top) = (case.tool(), case.level(case.request.highest()));
    let low = |step: &Step| {
        let across = (0..3).any(|axis| axis != tool && step.from[axis] != step.to[axis]);
        let (from, to) = (step.from[tool], step.to[tool]);
        let down = to < from && to < top - case.digit();
        step.known[tool] && (down || (across && from < top - case.digit()))
    };
    case.positioning()
        .filter(|(_, step)| step.kind == Kind::Rapid && low(step))
        .map(|(_, step)| {
            (
                Some(step.line),
                text!("This rapid moves down or across below the clearance plane"),
            )
        })
        .collect()
}

fn offset_after_touches(case: &RuleContext<'_>) -> Vec<Violation> {
    let trace = &case.followed.trace;
    let last = trace
        .steps
        .iter()
        .rposition(|step| step.kind == Kind::Touch)
        .map_or(0, |at| at + 1);
    let early = trace.writes.iter().filter(|write| write.after < last);
    let mut breaks: Vec<Violation> = early
        .map(|write| {
            (
                Some(write.line),
                text!("This writes a work offset or a tool before the last touch"),
            )
        })
        .collect();
    let writes =
        |ending: ProbeConsequence| matches!(ending, ProbeConsequence::Exit { writes: true, .. });
    let exits = trace
        .steps
        .iter()
        .filter(|step| writes(step.contact) || writes(step.miss));
    breaks.extend(exits.map(|step| {
        (
            Some(step.line),
            text!("On the way to the exit a work offset or a tool is written"),
        )
    }));
    breaks
}

fn one_write(case: &RuleContext<'_>) -> Vec<Violation> {
    let writes = &case.followed.trace.writes;
    writes
        .iter()
        .enumerate()
        .filter(|(i, write)| {
            let other = match write.what {
                WrittenValue::Offset(number, _) => Some(number) != case.request.work_offset,
                WrittenValue::Tool(_) => false,
            };
            other || writes[..*i].iter().any(|before| before.what == write.what)
        })
        .map(|(_, write)| {
            (
                Some(write.line),
                text!("This writes a value again, or another work offset"),
            )
        })
        .collect()
}

/// A check of a result in a program: its name, variable, expected value and limit, in the units of the program.
struct CheckedResult {
    question: ResultCheck,
    named: String,
    slot: Slot,
    wanted: f64,
    limit: f64,
}

/// The checks that a program makes. A check that belongs to no result of the program breaks the rule; `line` is then reported.
fn answers(
    case: &RuleContext<'_>,
    checks: Vec<ResultCheck>,
    line: Option<usize>,
) -> Result<Vec<CheckedResult>, Violation> {
    let of = |question: ResultCheck| {
        let formula = &case.request.path.formula;
        let named = formula.code(&formula.results[question.result]).into_owned();
        let found = case
            .followed
            .script
            .outputs()
            .find(|(code, _)| code.eq_ignore_ascii_case(&named));
        let Some((_, slot)) = found else {
            return Err((line, text!("{code} is no result of the program", named)));
        };
        let unit = if question.angle {
            1.0
        } else {
            case.request.scale
        };
        Ok(CheckedResult {
            question,
            named,
            slot,
            wanted: question.expected / unit,
            limit: question.limit / unit,
        })
    };
    checks.into_iter().map(of).collect()
}

/// Runs the end of the program again.
fn endings<'s>(case: &RuleContext<'s>) -> Option<TailRunner<'s, 's>> {
    let Followed {
        script,
        tail,
        run_start: begin,
        ..
    } = case.followed;
    tail.ending(script, *begin)
}

/// Outcome of the end of the program if one result, or each, deviates by this share of its limit; the others have their expected values.
fn outcome(
    endings: &mut Option<TailRunner<'_, '_>>,
    answers: &[CheckedResult],
    off: Option<usize>,
    share: f64,
) -> TailOutcome {
    let value = |i: usize| {
        let CheckedResult {
            slot,
            wanted,
            limit,
            ..
        } = answers[i];
        (
            slot,
            wanted
                + if off.is_none_or(|off| off == i) {
                    limit * share
                } else {
                    0.0
                },
        )
    };
    // Two checks may concern one result: the tried value counts.
    let values = (0..answers.len()).chain(off).map(value);
    endings
        .as_mut()
        .map_or_else(TailOutcome::default, |endings| endings.outcome(values))
}

/// Shares of its limit at which a result is tried beyond it. An edited program is tried far beyond, too.
fn beyond(case: &RuleContext<'_>) -> &'static [f64] {
    match case.restarts {
        RestartPoints::Critical => &[-1.01, 1.01],
        RestartPoints::Every => &[-1.01, 1.01, -3.0, 3.0, -1000.0, 1000.0],
    }
}

fn plausible_before_write(case: &RuleContext<'_>) -> Vec<Violation> {
    let Some(write) = case.followed.trace.writes.first() else {
        return Vec::new();
    };
    let mut asked = match answers(case, case.request.questions(), Some(write.line)) {
        Ok(asked) => asked,
        Err(unknown) => return vec![unknown],
    };
    asked.retain(|answer| answer.question.stops(true));
    let mut endings = endings(case);
    // Each single result is beyond its limit while the others have their expected values; then all are beyond, and all a little within.
    let mut writes = |off: Option<usize>, share: f64| {
        let outcome = outcome(&mut endings, &asked, off, share);
        !outcome.stops || outcome.writes
    };
    let mut breaks: Vec<Violation> = Vec::new();
    for (i, answer) in asked.iter().enumerate() {
        if beyond(case).iter().any(|share| writes(Some(i), *share)) {
            let message = text!(
                "This writes though {code} is off by more than its limit",
                answer.named.clone()
            );
            breaks.push((Some(write.line), message));
        }
    }
    if !asked.is_empty() && beyond(case).iter().any(|share| writes(None, *share)) {
        breaks.push((
            Some(write.line),
            text!("This writes though every result is off by more than its limit"),
        ));
    }
    if breaks.is_empty()
        && [-0.99, 0.99]
            .iter()
            .any(|share| !outcome(&mut endings, &asked, None, *share).ends)
    {
        breaks.push((
            Some(write.line),
            text!(
                "The program does not reach this write although every result is within its limit"
            ),
        ));
    }
    breaks
}

fn asked_before_write(case: &RuleContext<'_>) -> Vec<Violation> {
    let Some(write) = case.followed.trace.writes.first() else {
        return Vec::new();
    };
    let broken = |message: Text| vec![(Some(write.line), message)];
    // The other results have their expected values.
    let others = case.request.questions();
    let own = others.len();
    let wanted = case.request.ask_checks();
    let always = wanted.is_empty();
    let checks = others.into_iter().chain(wanted).collect();
    let asked = match answers(case, checks, Some(write.line)) {
        Ok(asked) => asked,
        Err(unknown) => return vec![unknown],
    };
    let mut endings = endings(case);
    let good = outcome(&mut endings, &asked, None, 0.0);
    if good.asks != always {
        return broken(match always {
            true => text!("This writes and does not wait for the operator"),
            false => text!("The program waits although every result is within its tolerance"),
        });
    }
    let tolerated = asked.iter().enumerate().filter(|(i, _)| *i >= own);
    for (i, answer) in tolerated {
        for (share, out) in [(-1.01, true), (1.01, true), (-0.99, false), (0.99, false)] {
            let outcome = outcome(&mut endings, &asked, Some(i), share);
            if outcome.writes && outcome.asks != out {
                let code = answer.named.clone();
                return broken(match out {
                    true => text!(
                        "This writes {code} out of its tolerance and does not wait",
                        code
                    ),
                    false => text!(
                        "The program waits although {code} is within its tolerance",
                        code
                    ),
                });
            }
        }
    }
    Vec::new()
}

fn tolerance_obeyed(case: &RuleContext<'_>) -> Vec<Violation> {
    let asked = match answers(case, case.request.questions(), None) {
        Ok(asked) => asked,
        Err(unknown) => return vec![unknown],
    };
    let writes = case.request.writes_tables();
    let mut endings = endings(case);
    let mut breaks: Vec<Violation> = Vec::new();
    for (i, answer) in asked.iter().enumerate() {
        let stops = match answer.question.asked {
            CheckKind::Plausibility | CheckKind::FollowLimit => continue,
            CheckKind::MarkTolerance => false,
            CheckKind::StopTolerance => true,
        };
        // Just out of tolerance may be implausible as well; then the program stops.
        let implausible = |value: f64| {
            let of_same = |other: &&CheckedResult| {
                other.slot == answer.slot && other.question.asked == CheckKind::Plausibility
            };
            writes
                && asked
                    .iter()
                    .filter(of_same)
                    .any(|other| (value - other.wanted).abs() > other.limit)
        };
        let other = [-1.01, 1.01].iter().any(|share| {
            let outcome = outcome(&mut endings, &asked, Some(i), *share);
            let stops = stops || implausible(answer.wanted + answer.limit * share);
            if stops { !outcome.stops } else { !outcome.ends }
        });
        let good = [-0.99, 0.99]
            .iter()
            .all(|share| outcome(&mut endings, &asked, Some(i), *share).ends);
        if !good {
            let message = text!(
                "The program stops though {code} is within its tolerance",
                answer.named.clone()
            );
            breaks.push((None, message));
        } else if other {
            let code = answer.named.clone();
            let message = match stops {
                true => text!(
                    "The program does not stop though {code} is out of its tolerance",
                    code
                ),
                false => text!("The program stops though {code} is only to be marked", code),
            };
            breaks.push((None, message));
        }
    }
    breaks
}

fn place_within_limit(case: &RuleContext<'_>) -> Vec<Violation> {
    let path = case.request.path;
    let mut breaks = Vec::new();
    for (m, member) in path.cycles.iter().enumerate() {
        for question in path.asked_before(m, &case.request.limits) {
            let stops = |share: &f64| {
                case.followed.stops_before(
                    case.request,
                    m,
                    (question.result, question.limit * share, question.limit),
                )
            };
            if !beyond(case).iter().all(stops) {
                let code = path
                    .formula
                    .code(&path.formula.results[question.result])
                    .into_owned();
                let message = text!(
                    "This moves to {cycle} although {code} deviates by more than its limit",
                    member.name.clone(),
                    code
                );
                breaks.push((None, message));
            }
        }
    }
    breaks
}

/// The block of a line.
fn block_of(script: &Script<'_>, line: usize) -> usize {
    let at = script.blocks.iter().position(|block| block.line == line);
    at.unwrap_or(0)
}

/// Blocks at which the program is started again. `touches` are the lines of its touches, in order of the lines.
fn restart_blocks(case: &RuleContext<'_>, touches: &[usize]) -> Vec<usize> {
    let Followed { script, trace, .. } = case.followed;
    let line_of = |step: Option<&Step>| step.map_or(0, |step| step.line);
    let from = block_of(script, line_of(trace.steps.first()));
    if case.restarts == RestartPoints::Every {
        return (from..script.blocks.len()).collect();
    }
    /// Number of blocks before a write at which the program is restarted.
    const BEFORE: usize = 6;
    let [first, last] = [trace.writes.first(), trace.writes.last()]
        .map(|write| write.map_or(0, |write| block_of(script, write.line)));
    let writing = first.saturating_sub(BEFORE).max(from)..=last;
    let ends = touches.first().into_iter().chain(touches.last());
    let after = ends.map(|line| block_of(script, *line) + 1);
    after.chain(writing).collect()
}

/// Values of the variables when the program is started again: those that the last run left, if the control keeps them, no values, and those after a reset
/// while the program waits for the operator.
fn restart_values(followed: &Followed<'_>) -> (Option<Vec<f64>>, Vec<f64>, Vec<Vec<f64>>) {
    let Followed { script, tail, .. } = followed;
    let mut empty = vec![script.unset_value.unwrap_or(f64::NAN); script.slots];
    for (slot, value) in &script.kept {
        empty[*slot as usize] = *value;
    }
    let Some(unset) = script.unset_value else {
        return (None, empty, Vec::new());
    };
    // Results of a displaced part: none has its expected value.
    let mut left = tail.last_values().to_vec();
    for (i, (_, slot)) in script.outputs().enumerate() {
        if let Some(value) = left.get_mut(slot as usize) {
            *value += 0.37 + 0.11 * i as f64;
        }
    }
    // A program that does not end leaves no values.
    if left.len() != script.slots {
        left.clone_from(&empty);
    }
    let mut paused = tail.paused_values().to_vec();
    for slot in script.local_slots() {
        for values in &mut paused {
            values[slot as usize] = unset;
        }
    }
    (Some(left), empty, paused)
}

fn restart_writes_nothing(case: &RuleContext<'_>) -> Vec<Violation> {
    let Followed {
        script,
        trace,
        run_start: begin,
        ..
    } = case.followed;
    let (Some(write), true) = (trace.writes.first(), !trace.steps.is_empty()) else {
        return Vec::new();
    };
    let mut touches: Vec<usize> = trace.touch_lines().collect();
    touches.sort_unstable();
    let starts = restart_blocks(case, &touches);
    let (left, empty, paused) = restart_values(case.followed);
    let mut budget = 4 * machine::BUDGET;
    let mut writes = |(i, block): &(usize, &usize)| {
        // The longest run is made with one of the two.
        let once = *i == 0 && case.restarts == RestartPoints::Critical && left.is_some();
        let mut values = left.iter().chain((!once).then_some(&empty)).chain(&paused);
        values.any(|values| {
            machine::restarted(
                script,
                *begin,
                (trace, &touches),
                (**block, values),
                &mut budget,
            )
        })
    };
    let bad: Vec<&usize> = starts
        .iter()
        .enumerate()
        .filter(|start| writes(start))
        .map(|(_, block)| block)
        .collect();
    if budget == 0 {
        return vec![(
            Some(write.line),
            text!("The program is too long to be started again at each of its blocks"),
        )];
    }
    let bad = bad.into_iter().map(|block| script.blocks[*block].line);
    bad.map(|line| {
        (
            Some(line),
            text!("Started again at this line, the program writes though not every touch was made"),
        )
    })
    .collect()
}

fn ends_above(case: &RuleContext<'_>) -> Vec<Violation> {
    let trace = &case.followed.trace;
    if !trace.ends {
        return vec![(None, text!("The program has no end"))];
    }
    let Some(last) = trace.steps.last() else {
        return Vec::new();
    };
    // 1411 may end at the start of its last touch: as high as the path itself.
    let moves = &case.request.path.moves;
    let shift = moves
        .len()
        .checked_sub(1)
        .map_or(Vec3::ZERO, |index| case.followed.shift(index));
    let end = moves
        .last()
        .map_or(f64::NEG_INFINITY, |step| case.level(step.to + shift));
    if last.to[case.tool()] < end - case.digit() {
        return vec![(
            Some(last.line),
            text!("The program ends lower than its path"),
        )];
    }
    Vec::new()
}
