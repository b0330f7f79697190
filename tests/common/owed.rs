//! Properties of every plan, for any job. Property tests and fuzzer both use them.

use touchpath::form::Value;
use touchpath::job::{Move, Plan};

/// A law by its name: the property, then the message if it is broken.
macro_rules! owe {
    ($law:literal, $holds:expr $(,)?) => {{ let holds: bool = $holds; if !holds { return Err($law.to_owned()); } }};
    ($law:literal, $holds:expr, $($what:tt)+) => {{ let holds: bool = $holds; if !holds { return Err(format!("{}: {}", $law, format!($($what)+))); } }};
}

macro_rules! owe_eq {
    ($law:literal, $a:expr, $b:expr $(,)?) => {{
        let (a, b) = (&$a, &$b);
        if *a != *b {
            return Err(format!("{}: {a:?} is not {b:?}", $law));
        }
    }};
}

pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// Properties of every plan.
pub fn sane(job: &Value, plan: &Plan, tool_axis: usize) -> Result<(), String> {
    // Only picked touches may differ in height: by a hundredth of a millimetre, in the job's units.
    let picked = matches!(
        job.get("cycle").and_then(|c| c.get("touches")),
        Some(Value::List(_))
    );
    let inch = job.get("units") == Some(&Value::Text("inch".to_owned()));
    let level = if picked {
        if inch { 0.01 / 25.4 } else { 0.01 }
    } else {
        0.0
    };
    owe!(
        "every move ends at a place",
        plan.moves
            .iter()
            .all(|m| m.to.iter().all(|x| x.is_finite()))
    );
    owe!(
        "length and time are finite",
        plan.length.is_finite() && plan.time.is_finite() && plan.time >= 0.0
    );
    owe!(
        "a program ends its last line, and a plan has no error",
        plan.program.text.ends_with('\n')
            && plan
                .findings
                .iter()
                .all(|f| f.level != touchpath::form::Level::Error)
    );
    if plan.program.own {
        return match plan.program.post {
            "heidenhain" => klartext_is_sane(plan),
            "sinumerik" => sinumerik_is_sane(plan),
            _ => calls_are_sane(plan),
        };
    }
    if plan.program.does.starts_with("makes a dry run") {
        return dry_is_sane(plan);
    }
    let mut touched = Vec::new();
    for (i, step) in plan.moves.iter().enumerate() {
        if step.kind == "touch" {
            // A touch starts in front of its wall, ends at the contact, and returns to its start.
            let k = step.touch.unwrap();
            touched.push(k);
            let (before, back) = (&plan.moves[i - 1], &plan.moves[i + 1]);
            owe_eq!("behind a touch is its way back", back.kind, "back");
            owe_eq!("the way back is that of its touch", back.touch, Some(k));
            owe!(
                "a touch goes back to where it began",
                distance(before.to, back.to) < 1e-9
            );
            let vector = plan.touches[k].vector;
            let towards: f64 = (0..3)
                .map(|a| (before.to[a] - step.to[a]) * vector[a])
                .sum();
            // Picked touches may be askew by a degree, and short ones by the hundredth that picks of one level may differ.
            let way = distance(before.to, step.to);
            let off = |a: usize| before.to[a] - step.to[a] - towards * vector[a];
            let aside = distance([off(0), off(1), off(2)], [0.0; 3]);
            let askew = if picked {
                (way * 1f64.to_radians().sin()).max(level)
            } else {
                0.0
            };
            owe!(
                "a touch runs along its inverted vector",
                towards > 0.0 && aside <= askew + 1e-6,
                "touch {k}"
            );
            owe_eq!("a touch runs at the work feed", step.feed, "work");
        } else if !circles(plan) {
            owe!(
                "no other move runs at the work feed",
                step.feed != "work",
                "{step:?}"
            );
        }
    }
    owe_eq!(
        "each touch is made once, in order",
        touched,
        (0..plan.touches.len()).collect::<Vec<_>>()
    );
    for touch in &plan.touches {
        owe!(
            "a target vector has the length 1",
            (distance(touch.vector, [0.0; 3]) - 1.0).abs() < 1e-9
        );
    }
    if circles(plan) {
        return program_is_sane(plan);
    }
    if plan.moves.is_empty() {
        owe!(
            "who does not move measures nothing",
            plan.touches.is_empty() && plan.results.is_empty()
        );
        return program_is_sane(plan);
    }
    // It ends at its start, above the touches.
    for cycle in 0..plan.cycles.len().max(1) {
        // Step 0 is the link move from one cycle of a set-up to the next.
        let moves: Vec<_> = plan
            .moves
            .iter()
            .filter(|m| m.cycle == cycle && m.step > 0)
            .collect();
        let (Some(first), Some(last)) = (moves.first(), moves.last()) else {
            continue;
        };
        owe!(
            "a path ends where it began",
            distance(first.to, last.to) < 1e-8
        );
        // A move of a nanometre is omitted: the end may be that much lower.
        owe!(
            "no move goes higher than the path ends",
            moves
                .iter()
                .all(|m| m.to[tool_axis] <= last.to[tool_axis] + level + 1e-6)
        );
    }
    // Picks may be beside their wall: contacts are at the wall.
    if picked && ["fanuc", "haas"].contains(&plan.program.post) {
        let nominal = super::with(job, "part", Value::Map(Vec::new()));
        let nominal =
            touchpath::job::plan(&nominal).map_err(|e| format!("on the nominal part: {e}"))?;
        // A pick beside the part has no contact there.
        if let Some(contacts) = nominal.triggers.iter().copied().collect::<Option<Vec<_>>>() {
            return skip_is_sane_on(plan, contacts);
        }
    }
    program_is_sane(plan)
}

/// Whether it is the native two-circle cycle, which moves down at the probing feed and does not end at its start.
pub fn circles(plan: &Plan) -> bool {
    plan.results.iter().any(|r| r.code == "Q950")
}

/// Judges the text of a program.
type Judge = fn(&Plan) -> Result<(), String>;

/// Judge of a control's programs.
pub fn judge(post: &str) -> Option<Judge> {
    match post {
        "linuxcnc" | "grbl" | "grblhal" | "fluidnc" => Some(rs274_is_sane),
        "sinumerik" => Some(sinumerik_is_sane),
        "heidenhain" => Some(klartext_is_sane),
        "fanuc" | "haas" => Some(skip_is_sane),
        "mazak" | "brother" | "hurco" | "okuma" => Some(calls_are_sane),
        _ => None,
    }
}

fn program_is_sane(plan: &Plan) -> Result<(), String> {
    match judge(plan.program.post) {
        Some(judge) => judge(plan),
        None => Err(format!(
            "nobody judges programs for {}: tests/common/owed.rs",
            plan.program.post
        )),
    }
}

fn klartext_is_sane(plan: &Plan) -> Result<(), String> {
    owe!(
        "the control moves by itself",
        plan.program.move_lines.iter().all(|l| *l == -1)
    );
    owe!(
        "no line of Klartext is odd",
        plan.program
            .text
            .lines()
            .all(|l| l.is_ascii() && !l.contains("-0 "))
    );
    if plan.program.own {
        let mut touched: Vec<usize> = plan
            .moves
            .iter()
            .filter_map(|m| m.touch.filter(|_| m.kind == "touch"))
            .collect();
        touched.sort_unstable();
        owe_eq!(
            "each touch is made once",
            touched,
            (0..plan.touches.len()).collect::<Vec<_>>()
        );
        owe!(
            "what touches is called",
            plan.program.text.contains("TCH PROBE 4")
        );
    }
    Ok(())
}

/// A dry run touches, computes and writes nothing.
fn dry_is_sane(plan: &Plan) -> Result<(), String> {
    let text = &plan.program.text;
    owe!(
        "a dry run says so in its first comment",
        text.lines()
            .take(3)
            .any(|line| line.to_uppercase().contains("DRY RUN"))
    );
    owe!(
        "a dry run touches nothing",
        !text.contains("G38.2") && !text.contains("M79") && !text.contains("GOTOF TP_MISSED")
    );
    owe!(
        "a dry run writes nothing",
        plan.program.writes.is_empty() && !text.contains("G10 L") && !text.contains("#52")
    );
    owe!(
        "a dry run has no results",
        plan.results.iter().all(|row| row.value.is_none())
    );
    owe!(
        "a dry run is proven without a touch",
        plan.program
            .proof
            .as_ref()
            .is_none_or(|proof| proof.touches == 0)
    );
    Ok(())
}

/// Whether a rapid that moves down runs at a feed because nothing watches it.
fn like_grbl(plan: &Plan) -> bool {
    ["grbl", "grblhal", "fluidnc"].contains(&plan.program.post)
}

fn rs274_is_sane(plan: &Plan) -> Result<(), String> {
    let lines: Vec<&str> = plan.program.text.lines().collect();
    owe_eq!(
        "every move has its line",
        plan.program.move_lines.len(),
        plan.moves.len()
    );
    owe!(
        "lines and moves have one order",
        plan.program.move_lines.windows(2).all(|w| w[0] < w[1])
    );
    let watched = lines.iter().any(|l| l.starts_with("G38.3"));
    let scale = if lines.contains(&"G20") { 25.4 } else { 1.0 };
    for (i, (&line, step)) in plan.program.move_lines.iter().zip(&plan.moves).enumerate() {
        let word = lines[line as usize].split(' ').next().unwrap();
        let short = i > 0 && distance(plan.moves[i - 1].to, step.to) * scale < 0.3 + 1e-6;
        let wanted: &[&str] = match (step.kind, step.feed, &step.arc) {
            ("touch", ..) => &["G38.2"],
            // The first of the pieces may be a short one.
            (.., Some(_)) if watched => &["G38.3", "G1"],
            (.., Some(arc)) => {
                if arc.sweep > 0.0 {
                    &["G3"]
                } else {
                    &["G2"]
                }
            }
            ("position", ..) if i == 0 && !circles(plan) => &["o<tp_first>", "G0", "G1"],
            ("position", ..) if watched && (short || i == 0) => &["G1", "G38.3"],
            ("position", ..) if watched => &["G38.3"],
            // A rapid with a stated rate is a feed move; grbl moves down at a feed.
            (_, "rapid", None) if circles(plan) || like_grbl(plan) => &["G0", "G1"],
            (_, "rapid", None) => &["G0"],
            (.., None) => &["G1"],
        };
        owe!(
            "a block has the motion word of its move",
            wanted.contains(&word),
            "{} for {:?}",
            word,
            step
        );
        block_ends_at_its_place(lines[line as usize], step, plan, scale)?;
        if word == "G38.3" && like_grbl(plan) {
            let next = lines[line as usize + 1..]
                .iter()
                .find(|line| !line.starts_with('('))
                .unwrap();
            owe!(
                "after a contact nothing moves on grbl",
                next.starts_with("G38.") || *next == "M2",
                "{}",
                next
            );
        } else if word == "G38.3" {
            let check = lines[line as usize + 1];
            owe!(
                "a watched move is checked in the next line",
                check.starts_with('o') && check.ends_with(" if [#5070 NE 0]"),
                "{}",
                check
            );
        }
        if word == "G0" && like_grbl(plan) && i > 0 {
            let axis = lines
                .iter()
                .find_map(|l| {
                    ["G17 ", "G18 ", "G19 "]
                        .iter()
                        .position(|g| l.starts_with(g))
                })
                .unwrap();
            let axis = [2, 1, 0][axis];
            owe!(
                "no rapid goes down on grbl",
                step.to[axis] >= plan.moves[i - 1].to[axis] - 2e-6,
                "{:?}",
                step
            );
        }
    }
    // Every block that moves belongs to a move of the path, except in subroutines, in the approach, and for pieces of arcs.
    let body = lines
        .iter()
        .rposition(|l| l.ends_with("endsub"))
        .map_or(0, |i| i + 1);
    let first = plan
        .program
        .move_lines
        .first()
        .map_or(lines.len(), |l| *l as usize);
    let known: Vec<usize> = plan
        .program
        .move_lines
        .iter()
        .map(|l| *l as usize)
        .collect();
    for (i, line) in lines.iter().enumerate().skip(body.max(first)) {
        let moves = ["G0 ", "G1 ", "G2 ", "G3 ", "G38"]
            .iter()
            .any(|g| line.starts_with(g));
        let piece = watched
            && known
                .iter()
                .rposition(|l| *l <= i)
                .is_some_and(|m| plan.moves[m].arc.is_some());
        owe!(
            "every block that moves is a move of the path",
            !moves || known.contains(&i) || piece,
            "{}",
            line
        );
    }
    for line in &lines {
        owe!(
            "a line is ASCII and not too long",
            line.is_ascii() && (line.len() <= 252 || line.starts_with('(')),
            "{}",
            line
        );
        owe!(
            "no number of a line is odd",
            !line.contains("-0 ")
                && !line.ends_with("-0")
                && !line.contains("NaN")
                && !line.contains("inf"),
            "{}",
            line
        );
        if *line == "M66 E0 L0" {
            continue;
        }
        if line.starts_with('(') {
            owe!(
                "a comment is one comment",
                line.ends_with(')') && line.matches(['(', ')']).count() == 2,
                "{}",
                line
            );
        } else {
            owe!(
                "no sign of a comment is in a block",
                !line.contains(['(', ')', ';', '%', 'e', 'E'])
                    || line.starts_with(['#', 'o'])
                    || line.starts_with("G10"),
                "{}",
                line
            );
        }
    }
    Ok(())
}

/// Writes, reads, and compares the path; nothing moves unwatched; every line has a length that the control accepts.
fn sinumerik_is_sane(plan: &Plan) -> Result<(), String> {
    let text = &plan.program.text;
    if text.contains("CYCLE977(") || text.contains("CYCLE978(") {
        // The control makes the moves of its native cycle.
        let own = plan
            .moves
            .iter()
            .zip(&plan.program.move_lines)
            .filter(|(m, _)| m.kind == "touch")
            .all(|(_, line)| *line == -1);
        owe!(
            "the touches of the control's own cycle have no line",
            own,
            "{text}"
        );
        return Ok(());
    }
    let program = crate::common::mpf::read(text).map_err(|t| format!("{t:?}\n{text}"))?;
    owe_eq!(
        "nothing of the program is in trouble",
        program.troubles(),
        []
    );
    // The search of each touch is not in the plan: its end must be on its line, past the contact.
    let ends = program.moves().map_err(|t| format!("{t:?}"))?;
    let ends: Vec<_> = ends
        .iter()
        .filter(|s| s.purpose == crate::common::mpf::Purpose::Touch)
        .collect();
    let contacts: Vec<_> = plan.moves.iter().filter(|m| m.kind == "touch").collect();
    owe_eq!("every touch is in the program", ends.len(), contacts.len());
    let searches: Vec<f64> = ends
        .iter()
        .zip(&contacts)
        .map(|(end, contact)| distance(end.to, contact.to))
        .collect();
    super::compare_mpf(plan, |k| searches[k], &program)?;
    for line in text.lines() {
        owe!(
            "a line is ASCII and not too long",
            line.is_ascii() && line.len() <= 512 && !line.contains("NaN") && !line.contains("inf"),
            "{}",
            line
        );
        owe!(
            "a line has one comment",
            line.matches(';').count() <= 1 || line.starts_with(';'),
            "{}",
            line
        );
    }
    let registers = text
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter_map(|w| w.strip_prefix('R')?.parse::<usize>().ok());
    owe!(
        "R parameters are within the control's",
        registers.max().unwrap_or(0) <= 99
    );
    Ok(())
}

/// A program of calls: each protected move ends like the plan's, and the macros make the rest, each touch of them twice.
fn calls_are_sane(plan: &Plan) -> Result<(), String> {
    let lines: Vec<&str> = plan.program.text.lines().collect();
    let odd = |line: &&&str| {
        !line.is_ascii() || line.contains("NaN") || line.contains("inf") || line.len() > 255
    };
    owe_eq!(
        "a line is ASCII and not too long",
        lines.iter().find(odd),
        None
    );
    owe_eq!(
        "every move has its line, or none",
        plan.program.move_lines.len(),
        plan.moves.len()
    );
    let inch = lines.iter().any(|line| line.contains("UNITS INCH"));
    let near = if inch { 6e-6 } else { 6e-4 };
    let mut place = [f64::NAN; 3];
    let mut made = plan.program.move_lines.iter().zip(&plan.moves).peekable();
    for (i, line) in lines.iter().enumerate() {
        let Some((number, letters)) = macro_call(line) else {
            continue;
        };
        if number != 9810 {
            continue;
        }
        for (axis, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
            place[axis] = letters
                .iter()
                .find(|(known, _)| *known == letter)
                .map_or(place[axis], |(_, x)| *x);
        }
        while let Some((at, step)) = made.next_if(|(at, _)| **at <= i as i32) {
            if *at < 0 {
                continue;
            }
            // Heights are those of the stylus tip.
            let there = (0..2).all(|axis| (place[axis] - step.to[axis]).abs() < near)
                && place[2] <= step.to[2] + near;
            owe!(
                "a protected move goes where the plan does",
                there || place[2].is_nan(),
                "{line}: {:?}",
                step.to
            );
        }
    }
    owe!("each protected move is called", made.all(|(at, _)| *at < 0));
    let measuring = lines
        .iter()
        .filter_map(|line| macro_call(line))
        .filter(|(n, _)| !matches!(n, 9810 | 9832..=9834));
    owe!(
        "what touches is called",
        plan.touches.is_empty() || measuring.count() > 0
    );
    let touched: Vec<usize> = plan
        .moves
        .iter()
        .filter(|step| step.kind == "touch")
        .filter_map(|step| step.touch)
        .collect();
    let mut each: Vec<usize> = touched.chunks(2).map(|pair| pair[0]).collect();
    owe!(
        "each touch is made twice",
        touched
            .chunks(2)
            .all(|pair| pair.len() == 2 && pair[0] == pair[1]),
        "{touched:?}"
    );
    each.sort_unstable();
    owe_eq!(
        "each touch is made",
        each,
        (0..plan.touches.len()).collect::<Vec<_>>()
    );
    Ok(())
}

/// Macro call in a line, by the number that most controls use, and its letters: an Okuma writes `CALL O9814 PD=25.`, a Brother has P8814.
pub fn macro_call(line: &str) -> Option<(u32, Vec<(char, f64)>)> {
    let okuma = line.starts_with("CALL O");
    let mut words = line
        .strip_prefix("G65 P")
        .or_else(|| line.strip_prefix("CALL O"))?
        .split(' ');
    let number: u32 = words.next()?.parse().ok()?;
    let letter = |word: &str| {
        let (letter, value) = if okuma {
            word.strip_prefix('P')?.split_once('=')?
        } else {
            word.split_at_checked(1)?
        };
        Some((letter.parse().ok()?, nominal(value)?))
    };
    let letters: Vec<(char, f64)> = words.map(letter).collect::<Option<_>>()?;
    Some((if number < 9000 { number + 1000 } else { number }, letters))
}

/// Value of a word on the nominal part: `[110.+#106]` adds deviations, which are 0 there.
fn nominal(value: &str) -> Option<f64> {
    let Some(sum) = value.strip_prefix('[').and_then(|v| v.strip_suffix(']')) else {
        return value.parse().ok();
    };
    let end = sum.find('#').unwrap_or(sum.len());
    let constant = sum[..end].trim_end_matches(['+', '-']);
    match constant {
        "" => Some(0.0),
        number => number.parse().ok(),
    }
}

/// On the nominal part the simulated control makes the moves of the path, and no others except the approach and the pieces of arcs.
fn skip_is_sane(plan: &Plan) -> Result<(), String> {
    let ends = plan
        .moves
        .iter()
        .filter(|m| m.kind == "touch")
        .map(|m| m.to)
        .collect();
    skip_is_sane_on(plan, ends)
}

/// The same with contacts of a part.
fn skip_is_sane_on(plan: &Plan, contacts: Vec<[f64; 3]>) -> Result<(), String> {
    // Two cycles of a set-up at one position: one touches where the other passes. The simulated control cannot distinguish them.
    let goes_through = |at: &[Move]| {
        let [from, step] = at else { return false };
        step.kind == "position"
            && contacts
                .iter()
                .any(|contact| super::fanuc::on_the_way(from.to, step.to, *contact))
    };
    if !plan.cycles.is_empty() && plan.moves.windows(2).any(goes_through) {
        return Ok(());
    }
    let text = &plan.program.text;
    let mut control =
        super::fanuc::Control::new(plan.program.post == "haas", text.contains("\nG20\n"));
    for offset in (5221..=5321)
        .step_by(20)
        .chain((7001..=7941).step_by(20))
        .chain((14_001..=15_973).step_by(20))
    {
        control
            .variables
            .extend((0..3).map(|axis| (offset + axis, 0.0)));
    }
    control.contacts = contacts;
    let header = text.replace(")\n(", " ");
    if let Some((_, rest)) = header.split_once("THE STYLUS IS TAKEN TO BE AT ") {
        for (axis, word) in rest.split(' ').take(3).enumerate() {
            control.at[axis] = word[1..]
                .parse()
                .map_err(|_| format!("{word} is no place"))?;
        }
    } else if let Some(first) = plan.moves.first() {
        // Above all of them.
        control.at = [first.to[0] + 40.0, first.to[1] - 30.0, first.to[2] + 70.0];
    }
    control.run(text).map_err(|e| format!("{e}\n{text}"))?;
    owe_eq!(
        "no alarm is raised on the nominal part",
        control.alarm,
        None
    );
    let last = if text.contains("\nG20\n") { 1e-5 } else { 1e-4 };
    let mut made = control.path.iter();
    for (i, step) in plan.moves.iter().enumerate() {
        loop {
            let Some((end, probing)) = made.next() else {
                return Err(format!("move {i} is not made\n{text}"));
            };
            let there = match step.kind {
                "touch" => *probing,
                _ => distance(*end, step.to) < last,
            };
            // Approach in steps, arcs in pieces.
            owe!(
                "each move ends at its place",
                there || i == 0 || step.arc.is_some(),
                "move {} ends at {:?}, not {:?}\n{}",
                i,
                end,
                step.to,
                text
            );
            owe!(
                "no way back probes",
                step.kind != "back" || !probing,
                "{}",
                text
            );
            if there {
                break;
            }
        }
    }
    owe!(
        "nothing moves behind the last move",
        made.next().is_none(),
        "{}",
        text
    );
    for line in text.lines() {
        owe!(
            "a line is ASCII and not too long",
            line.is_ascii() && line.len() <= 255 && !line.contains("NAN"),
            "{}",
            line
        );
        owe!(
            "no number of a line is odd",
            !line.contains("[-0.]")
                && !line
                    .split(' ')
                    .any(|word| word.ends_with("-0.") && word.len() == 4),
            "{}",
            line
        );
    }
    Ok(())
}

/// Every axis word of a block is the position of its move, within the last decimal; a touch is on its line, past the contact.
fn block_ends_at_its_place(
    line: &str,
    step: &touchpath::job::Move,
    plan: &Plan,
    scale: f64,
) -> Result<(), String> {
    if !line.starts_with('G') {
        return Ok(());
    }
    let last = if scale == 1.0 { 0.6e-4 } else { 0.6e-5 };
    let mut search: Option<f64> = None;
    for word in line.split(' ').skip(1) {
        let Some(axis) = ["X", "Y", "Z"]
            .iter()
            .position(|name| word.starts_with(name))
        else {
            continue;
        };
        // `X[10+#<bore_shift_x>]`, `X=-10+R5-0.5*R6`: the nominal position and its shift.
        let sum = word[1..].strip_prefix(['[', '=']);
        let nominal = sum.and_then(|sum| Some(&sum[..1 + sum.get(1..)?.find(['+', '-'])?]));
        let written: f64 = nominal
            .unwrap_or(&word[1..])
            .parse()
            .map_err(|_| format!("{line}: {word} is no number"))?;
        match step.touch.filter(|_| step.kind == "touch") {
            None => owe!(
                "an axis word is the place of its move",
                step.arc.is_some() && !line.contains(['I', 'J', 'K'])
                    || (written - step.to[axis]).abs() < last,
                "{line} {step:?}"
            ),
            Some(k) => {
                let vector = plan.touches[k].vector[axis];
                if vector.abs() > 0.5 {
                    let reach = (step.to[axis] - written) / vector;
                    owe!(
                        "a touch searches along its line, behind the contact",
                        reach > -last && search.is_none_or(|s| (s - reach).abs() < 4.0 * last),
                        "{line} {step:?}"
                    );
                    search = Some(reach);
                }
            }
        }
    }
    owe!(
        "a touch reaches for its wall",
        step.kind != "touch" || search.is_some(),
        "{line}"
    );
    Ok(())
}
