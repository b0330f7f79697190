//! Lines of the shop in a program (`machine.frame`): tool change, probe on, safe position. Every reader that judges the program sees it without them;
//! [`judge`](mod@judge) judges the lines themselves.

pub mod coded;
mod judge;
mod klartext;
pub mod place;
mod state;

use std::borrow::Cow;

use self::judge::{Judgement, judge};
use self::place::{BEFORE_WRITE, HEAD, ON_ALARM, PATH, PLACES, PROBE_ON, Place};
use self::state::height;
use crate::control::iso::block::Block;
use crate::control::iso::codes::Family;
use crate::control::iso::lex::{lines_of, without_count};
use crate::control::iso::writer::{Writer, number};
use crate::control::{ProgramForm, Request, comment_text};
use crate::form::Checker;
use crate::geom::AXIS_NAMES;
use crate::text::{Text, text};

impl Writer<'_> {
    /// The shop's lines of a place, below a comment.
    pub fn shop(&mut self, place: &Place) {
        let request = self.request();
        let lines = lines(request, place);
        if lines.is_empty() {
            return;
        }
        self.comment(&heading(request, place, &lines));
        for line in &lines {
            self.line(line);
        }
    }
}

/// The comment above the lines of a place.
fn heading(request: &Request<'_>, place: &Place, lines: &[String]) -> String {
    let unknown = judge(request, place, lines).contains(&Judgement::Unknown);
    let not = if unknown { ", not checked" } else { "" };
    format!("Shop's lines, {}{not}", place.name)
}

/// The lines of a place with the values of the job; empty if the program does not have this place.
fn lines(request: &Request<'_>, place: &Place) -> Vec<String> {
    let used = unused(request, place).is_none();
    let given = request.shop.at(place.key).iter().filter(|_| used);
    // A wrong placeholder is an error of the job.
    given
        .filter_map(|line| filled(request, line).ok())
        .filter(|line| !line.is_empty())
        .collect()
}

/// Why a program does not have this place.
fn unused(request: &Request<'_>, place: &Place) -> Option<Text> {
    let moves = request.form == ProgramForm::Moves;
    if place.key == BEFORE_WRITE.key && !(moves && request.writes_tables()) {
        return Some(text!(
            "The program has no separate block that writes a work offset or a tool"
        ));
    }
    if place.key == ON_ALARM.key && (!moves || request.post.why_not(ON_ALARM.key).is_some()) {
        return Some(text!(
            "The control raises the alarms itself: nothing after them runs"
        ));
    }
    None
}

/// A line with the values of its placeholders.
fn filled(request: &Request<'_>, line: &str) -> Result<String, Text> {
    let mut out = String::with_capacity(line.len());
    let mut rest = line;
    while let Some((before, after)) = rest.split_once('{') {
        out.push_str(before);
        let (key, after) = after.split_once('}').unwrap_or((after, ""));
        out.push_str(&value(request, key)?);
        rest = after;
    }
    out.push_str(rest);
    let out = out.trim();
    Ok(if request.post.dialect.capitals {
        out.to_ascii_uppercase()
    } else {
        out.to_owned()
    })
}

/// The value of a placeholder.
fn value(request: &Request<'_>, key: &str) -> Result<String, Text> {
    let missing = || {
        text!(
            "{placeholder} has no value in this job",
            format!("{{{key}}}")
        )
    };
    match key {
        "name" => Ok(comment_text(request.name)),
        "tool" => request.tool.map(|n| n.to_string()).ok_or_else(missing),
        "offset" => request
            .work_offset
            .filter(|_| request.post.family != Family::Heidenhain)
            .map(request.post.work_offset_word)
            .ok_or_else(missing),
        "axis" => Ok(AXIS_NAMES[request.plane.axes()[2]].to_owned()),
        "feed" => Ok(number(request, request.feeds.work).to_string()),
        "clearance" if !request.path.moves.is_empty() => Ok(height(request)),
        "clearance" => Err(missing()),
        _ => Err(text!(
            "The placeholders are {placeholders}",
            "{name}, {tool}, {offset}, {axis}, {feed}, {clearance}".to_owned()
        )),
    }
}

/// Reports the shop's lines that cannot be in a program, those that are not understood, and places that the program does not have.
pub fn check(request: &Request<'_>, checker: &mut Checker) {
    let calls_tool = || {
        let own = request.tool.map(f64::from);
        let lines = [HEAD, PROBE_ON]
            .map(|place| lines(request, &place))
            .concat();
        lines
            .iter()
            .any(|line| Block::of(line, request.post.family).number(b'T') == own)
    };
    if request.tool.is_some() && !(request.post.uses_tool)(request.form) && !calls_tool() {
        checker.info(
            "tool-unused",
            "control.tool",
            text!("This program neither calls nor checks the tool of the probe"),
        );
    }
    for place in PLACES {
        check_place(request, place, checker);
    }
}

/// Reports about the lines of a place.
fn check_place(request: &Request<'_>, place: &Place, checker: &mut Checker) {
    let given = request.shop.at(place.key);
    if given.is_empty() {
        return;
    }
    let path = format!("{PATH}{}", place.key);
    if let Some(why) = unused(request, place) {
        checker.info(
            "shop-lines-unused",
            &path,
            text!("These lines are not in the program. {why}", why),
        );
        return;
    }
    // Each line with its index in the job.
    let mut own: (Vec<usize>, Vec<String>) = (Vec::new(), Vec::new());
    for (i, line) in given.iter().enumerate() {
        match filled(request, line) {
            Ok(line) if line.is_empty() => {}
            Ok(line) => {
                own.0.push(i);
                own.1.push(line);
            }
            Err(why) => checker.error("shop-line", format!("{path}[{i}]"), why),
        }
    }
    let (indices, lines) = own;
    let mut unknown = Vec::new();
    let judged = judge(request, place, &lines).into_iter().zip(&lines);
    for (i, (judgement, line)) in indices.into_iter().zip(judged) {
        match judgement {
            Judgement::Understood => {}
            Judgement::Unknown => unknown.push(line.clone()),
            Judgement::Refused(why) => {
                let message = text!("\"{line}\": {why}", line.clone(), why);
                checker.error("shop-line", format!("{path}[{i}]"), message);
            }
        }
    }
    if !unknown.is_empty() {
        let message = text!(
            "Touchpath does not know what these lines do, and does not check them: {lines}",
            unknown.join(" | ")
        );
        checker.info("shop-lines-unknown", &path, message);
    }
}

/// Words of a block that probes, on the controls whose programs are read back.
const PROBING: [&str; 3] = ["G38.", "G31", "MEAS="];

/// Beginnings of the block after the lines of an alarm.
const ALARMS: [&str; 3] = ["M66", "SETAL", "#3000="];

/// Each used place with the comment above its lines, and its lines.
fn headed(request: &Request<'_>) -> Vec<(&'static Place, String, Vec<String>)> {
    let capitals = request.post.dialect.capitals;
    let (open, close) = request.post.dialect.comment;
    let own = |place: &&'static Place| {
        let lines = lines(request, place);
        let mut heading = heading(request, place, &lines);
        if capitals {
            heading.make_ascii_uppercase();
        }
        (!lines.is_empty()).then(|| (*place, format!("{open}{heading}{close}"), lines))
    };
    PLACES.iter().filter_map(own).collect()
}

/// A program with blank lines in place of the shop's lines. Only the lines of this request are removed, below their comments and on their side of the touches:
/// others are read like any line.
pub fn without_lines<'t>(request: &Request<'_>, text: &'t str) -> Cow<'t, str> {
    if request.shop.0.is_empty() {
        return Cow::Borrowed(text);
    }
    let all: Vec<&str> = lines_of(text).collect();
    let numbered = request.post.dialect.numbered;
    let code = |at: usize| {
        let line = all.get(at).map_or("", |line| line.trim());
        if numbered { without_count(line) } else { line }
    };
    // LinuxCNC's subprograms probe above the first move.
    let body = (0..all.len())
        .rfind(|at| code(*at).ends_with("endsub"))
        .unwrap_or(0);
    let probes = |at: &usize| {
        let code = code(*at);
        !code.starts_with(['(', ';']) && PROBING.iter().any(|word| code.contains(word))
    };
    let first = (body..all.len()).find(probes).unwrap_or(all.len());
    let last = (body..all.len()).rfind(probes).unwrap_or(0);
    let mut blank = vec![false; all.len()];
    for (place, heading, lines) in &headed(request) {
        let is_alarm = place.key == ON_ALARM.key;
        for at in 0..all.len() {
            let below = at + 1..at + 1 + lines.len();
            let is_own =
                code(at) == heading && below.clone().zip(lines).all(|(at, line)| code(at) == line);
            let fits = match place.before {
                _ if is_alarm => ALARMS.iter().any(|word| code(below.end).starts_with(word)),
                true => below.end <= first,
                false => at > last,
            };
            if is_own && fits {
                blank[below].fill(true);
            }
            // Every exit has those of an alarm.
            if is_own && !is_alarm {
                break;
            }
        }
    }
    let lines = all.iter().zip(blank);
    let kept = lines.flat_map(|(line, blank)| [if blank { "" } else { line }, "\n"]);
    Cow::Owned(kept.collect())
}
