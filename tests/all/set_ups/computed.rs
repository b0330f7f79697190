//! Native cycles whose program computes between them: relations, and positions and sizes that follow results. Judged by a simulated Fanuc with Renishaw's macros
//! a simulated TNC with the functions FN 0 to FN 13, and a simulated SINUMERIK with its measuring cycles. None shares code with the crate. A third run is that of `run_program`.

use std::collections::BTreeMap;

use super::follows::{near, shown};
use crate::common::fanuc::Control;
use crate::common::sinumerik::Machine;
use crate::common::{Draws, job, mpf, planned, with};
use crate::tests::klartext_cycles::judged;
use crate::tests::measuring_cycles::measured;
use crate::tests::own_cycles::{Face, Judge};
use touchpath::control::{POSTS, PostDef};
use touchpath::form::Value;
use touchpath::import::toolpath::{RunInputs, run_program};
use touchpath::job::{Plan, check_program, convert_units, plan};

/// A top, two bores and a groove: the bores follow the height, the second one also the first, and the groove its size.
const FOLLOWING: &str = r#"{ "format": 2, "control": { "form": "cycle" }, "limits": { "position": 1, "size": 0.5 },
  "cycles": [
    { "name": "TOP", "type": "surface", "origin": [-35, 0, 0] },
    { "name": "BORE", "type": "hole", "diameter": 25, "origin": [0, 0, "=TOP.z"] },
    { "name": "NEXT", "type": "hole", "diameter": 25, "origin": ["=BORE.center.x+60", "=BORE.center.y", "=TOP.z-2"] },
    { "name": "SLOT", "type": "groove", "width": "=BORE.diameter+5", "origin": ["=BORE.center.x+130", 0, 0] } ],
  "relations": [ { "name": "MID", "type": "mean", "of": ["BORE.diameter", "NEXT.diameter"] } ] }"#;

/// Three bores with every kind of relation between them.
const RELATED: &str = r#"{ "format": 2, "control": { "form": "cycle" },
  "cycles": [
    { "name": "A", "type": "hole", "diameter": 25, "origin": [0, 0, 0] },
    { "name": "B", "type": "hole", "diameter": 25, "origin": [60, 0, 0] },
    { "name": "C", "type": "hole", "diameter": 25, "origin": [30, -50, 0] } ],
  "relations": [ RELATIONS ] }"#;

const LINES: &str = r#"{ "name": "ROW", "type": "line", "of": ["B", "A"] }, { "name": "DOWN", "type": "line", "of": ["A", "C"] }"#;
const CENTERS: &str = r#"{ "name": "MID", "type": "center", "of": ["A", "B", "C"] }, { "name": "STEP", "type": "difference", "of": ["A.diameter", "B.diameter"] }"#;
const CIRCLE: &str = r#"{ "name": "PCD", "type": "pitch-circle", "of": ["A", "B", "C"] }"#;

/// Controls whose program computes between native cycles.
fn computing() -> impl Iterator<Item = &'static PostDef> {
    POSTS
        .iter()
        .copied()
        .filter(|post| post.own.is_some_and(|own| own.several.computes))
}

/// The job for a control, in units of its own, on a part with this offset and a first bore that is 0.2 mm larger.
pub fn on_part(text: &str, post: &str, inch: bool, offset: [f64; 3]) -> Value {
    let text = match post {
        // No source shows where CYCLE978 stores a height: nothing follows it.
        "sinumerik" => text
            .replace(
                "{ \"name\": \"TOP\", \"type\": \"surface\", \"origin\": [-35, 0, 0] },",
                "",
            )
            .replace("\"=TOP.z-2\"", "-2")
            .replace("\"=TOP.z\"", "0"),
        _ => text.to_owned(),
    };
    let job = with(&job(&text), "control.post", Value::Text(post.to_owned()));
    let list = offset.map(Value::Number).to_vec();
    let job = with(&job, "part", Value::Map(Vec::new()));
    let job = with(&job, "part.offset", Value::List(list));
    if inch {
        convert_units(&job, "inch").unwrap()
    } else {
        job
    }
}

/// The faces of that part, by hand: a stylus tip meets the top, the ball (radius 3) the others.
pub fn faces(following: bool, [x, y, z]: [f64; 3]) -> Vec<Face> {
    let bore = |at: [f64; 2]| Face::Circle([at[0] + x, at[1] + y], 12.5);
    match following {
        true => vec![
            Face::Top(z),
            bore([0.0, 0.0]),
            bore([60.0, 0.0]),
            Face::Wall([-1.0, 0.0], -(145.0 + x)),
            Face::Wall([1.0, 0.0], 115.0 + x),
        ],
        false => vec![bore([0.0, 0.0]), bore([60.0, 0.0]), bore([30.0, -50.0])],
    }
}

/// Where a run ended, its contacts in mm, and its variables by name.
pub struct Ran {
    pub contacts: Vec<[f64; 3]>,
    variables: BTreeMap<String, f64>,
    pub stopped: Option<String>,
    /// Cycles of a TNC that write a row of the preset table or activate it, with the row.
    pub rows: Vec<(u32, String)>,
    /// What they write along X, Y and Z: measured less the value that the coordinate shall get.
    written: [f64; 3],
}

/// A Fanuc with Renishaw's macros.
fn run_macros(text: &str, post: &str, unit: f64, faces: &[Face]) -> Ran {
    let base = if matches!(post, "haas" | "hurco") {
        185
    } else {
        135
    };
    let lower = if post == "brother" { 1000 } else { 0 };
    let mut control = Control::new(post == "haas", unit != 1.0);
    let mut judge = Judge::of(faces);
    let ended = control.run_with(text, &mut |number, letters| {
        let in_mm = |(letter, value): &(char, f64)| (*letter, value * unit);
        let outputs = judge.measure(number + lower, &letters.iter().map(in_mm).collect());
        let variable = |(output, mm): (i64, f64)| (base + output, mm / unit);
        outputs.into_iter().map(variable).collect()
    });
    ended.unwrap_or_else(|error| panic!("{post}: {error}\n{text}"));
    let contacts = judge.contacts.iter();
    Ran {
        contacts: contacts.map(|[x, y, tip]| [*x, *y, tip + 3.0]).collect(),
        variables: control
            .variables
            .iter()
            .map(|(number, value)| (format!("#{number}"), *value))
            .collect(),
        stopped: control.alarm,
        rows: Vec::new(),
        written: [f64::NAN; 3],
    }
}

/// A SINUMERIK: its measuring cycles count in the units of the program.
fn run_measuring(text: &str, unit: f64, faces: &[Face]) -> Ran {
    let program = mpf::read(text).unwrap_or_else(|troubles| panic!("{troubles:?}\n{text}"));
    let mut machine = Machine::new(Vec::new());
    machine.metric = unit == 1.0;
    let mut contacts = Vec::new();
    // Arguments that are no length: variants, the probe, the axis, counts.
    let plain = |number: u32, place: usize| match number {
        977 => !matches!(place, 5..=9 | 11 | 12 | 28 | 29),
        _ => !matches!(place, 5..=7),
    };
    let ended = machine.run_with(&program, &mut |number, given, at| {
        let in_mm = given
            .iter()
            .enumerate()
            .map(|(i, x)| match plain(number, i + 1) {
                true => *x,
                false => x * unit,
            });
        let given: Vec<f64> = in_mm.collect();
        let at = at.map(|x| x * unit);
        let (made, results) = measured((number, &given), at, faces);
        contacts.extend(made);
        results
            .into_iter()
            .map(|(entry, mm)| (entry, mm / unit))
            .collect()
    });
    ended.unwrap_or_else(|error| panic!("{error}\n{text}"));
    let registers = machine.r.iter().map(|(n, x)| (format!("R{n}"), *x));
    let outputs = machine
        .results
        .iter()
        .map(|(n, x)| (format!("_OVR[{n}]"), *x));
    Ran {
        contacts,
        variables: registers.chain(outputs).collect(),
        stopped: machine.alarm.map(|_| machine.message),
        rows: Vec::new(),
        written: [f64::NAN; 3],
    }
}

/// Q parameters that are lengths.
const LENGTHS: [std::ops::RangeInclusive<u32>; 6] = [
    260..=266,
    273..=274,
    282..=283,
    310..=311,
    320..=324,
    328..=329,
];

/// A TNC: its functions, labels and cycles.
fn run_klartext(text: &str, unit: f64, faces: &[Face]) -> Ran {
    let mut blocks: Vec<String> = Vec::new();
    for line in text.lines() {
        match line.split_once(' ') {
            Some((number, block)) if number.parse::<u32>().is_ok() => blocks.push(block.to_owned()),
            _ => {
                let last = blocks.last_mut().unwrap();
                last.push('\n');
                last.push_str(line);
            }
        }
    }
    let mut q: BTreeMap<u32, f64> = BTreeMap::new();
    let mut contacts: Vec<[f64; 3]> = Vec::new();
    let (mut at, mut stopped, mut rows) = (0, None, Vec::new());
    let mut written = [f64::NAN; 3];
    for _ in 0..10_000 {
        let block = blocks[at].clone();
        at += 1;
        let operand = |q: &BTreeMap<u32, f64>, text: &str| -> f64 {
            let sign = if text.starts_with('-') { -1.0 } else { 1.0 };
            let text = text.trim_start_matches(['+', '-']);
            match text.strip_prefix('Q') {
                Some(number) => sign * q[&number.parse::<u32>().unwrap()],
                None => sign * text.parse::<f64>().unwrap(),
            }
        };
        if let Some(rest) = block.strip_prefix("FN ") {
            let (number, rest) = rest.split_once(": ").unwrap();
            let words: Vec<&str> = rest.split(' ').collect();
            let number: u32 = number.parse().unwrap();
            if let ["IF", a, _, b, "GOTO", "LBL", name] = words[..] {
                let [a, b] = [a, b].map(|text| operand(&q, text));
                let holds = match number {
                    9 => a == b,
                    11 => a > b,
                    12 => a < b,
                    other => panic!("FN {other}"),
                };
                if holds {
                    let label = format!("LBL {name}");
                    at = blocks.iter().position(|block| *block == label).unwrap();
                }
                continue;
            }
            let value = |text: &str| operand(&q, text);
            let value = match (number, &words[2..]) {
                (0, [a]) => value(a),
                (1, [a, "+", b]) => value(a) + value(b),
                (2, [a, "-", b]) => value(a) - value(b),
                (3, [a, "*", b]) => value(a) * value(b),
                (4, [a, "DIV", b]) => value(a) / value(b),
                (5, ["SQRT", a]) => value(a).sqrt(),
                (6, ["SIN", a]) => value(a).to_radians().sin(),
                (7, ["COS", a]) => value(a).to_radians().cos(),
                (8, [a, "LEN", b]) => value(a).hypot(value(b)),
                (13, [a, "ANG", b]) => value(a).atan2(value(b)).to_degrees().rem_euclid(360.0),
                other => panic!("FN {other:?}"),
            };
            assert_eq!(words[1], "=");
            q.insert(words[0][1..].parse().unwrap(), value);
        } else if let Some((cycle, given)) = block.split_once('\n') {
            let mut lines = String::from(cycle);
            for line in given.lines() {
                let (name, rest) = line.trim().split_once('=').unwrap();
                let number: u32 = name[1..].parse().unwrap();
                let value = operand(&q, rest.split(' ').next().unwrap());
                q.insert(number, value);
                let is_length = LENGTHS.iter().any(|range| range.contains(&number));
                let value = value * if is_length { unit } else { 1.0 };
                lines.push_str(&format!("\nQ{number}={value} "));
            }
            let made = judged(&lines, faces, 0.0);
            let number: u32 = cycle.split(' ').nth(2).unwrap().parse().unwrap();
            if let Some(row) = lines
                .lines()
                .find_map(|line| line.strip_prefix("Q305=").or(line.strip_prefix("Q339=")))
            {
                rows.push((number, row.trim().to_owned()));
            }
            let put: Vec<(u32, f64)> = match (number, &made[..]) {
                (417, [one]) => {
                    written[2] = one[2] - 3.0 - q[&333] * unit;
                    Vec::new()
                }
                (247, _) => Vec::new(),
                (412 | 413 | 421 | 422, [a, _, c, _]) => {
                    let on = [made[1], made[3]];
                    let center = [(a[0] + c[0]) / 2.0, (on[0][1] + on[1][1]) / 2.0];
                    let far = (a[0] - center[0]).hypot(a[1] - center[1]);
                    if let (412 | 413, Some(x), Some(y)) = (number, q.get(&331), q.get(&332)) {
                        written[0] = center[0] - x * unit;
                        written[1] = center[1] - y * unit;
                    }
                    let outside = number == 413 || number == 422;
                    let ball = if outside { -3.0 } else { 3.0 };
                    vec![
                        (151, center[0]),
                        (152, center[1]),
                        (153, 2.0 * (far + ball)),
                    ]
                }
                (426, [plus, minus]) => vec![
                    (157, (plus[0] + minus[0]) / 2.0),
                    (156, plus[0] - minus[0] - 6.0),
                ],
                (425, [plus, minus]) => vec![
                    (157, (plus[0] + minus[0]) / 2.0),
                    (156, plus[0] - minus[0] + 6.0),
                ],
                (427, [one]) => {
                    let (axis, towards) = (q[&272] as usize - 1, q[&267]);
                    vec![(160, one[axis] + towards * 3.0)]
                }
                other => panic!("{other:?}"),
            };
            q.extend(put.into_iter().map(|(number, mm)| (number, mm / unit)));
            contacts.extend(made);
        } else if block.starts_with("LBL \"STOP") {
            // Below it the comment names the result; elsewhere the operator reads the results.
            let notes = blocks[at..]
                .iter()
                .take_while(|block| block.starts_with("; "));
            stopped = Some(notes.cloned().collect::<String>());
        } else if block == "STOP" {
        } else if block.starts_with("END PGM") {
            let variables = q.into_iter().map(|(q, value)| (format!("Q{q}"), value));
            return Ran {
                contacts,
                variables: variables.collect(),
                stopped,
                rows,
                written,
            };
        } else {
            let known = ["BEGIN PGM", "; ", "LBL "];
            assert!(known.iter().any(|head| block.starts_with(head)), "{block}");
        }
    }
    panic!("does not end");
}

pub fn run(plan: &Plan, post: &PostDef, unit: f64, faces: &[Face]) -> Ran {
    let text = &plan.program.text;
    match post.key {
        "heidenhain" => run_klartext(text, unit, faces),
        "sinumerik" => run_measuring(text, unit, faces),
        key => run_macros(text, key, unit, faces),
    }
}

/// Contacts of the plan's run as far as the program comes, each once: a macro touches twice. In mm.
fn of_run(plan: &Plan, unit: f64) -> Vec<[f64; 3]> {
    let touches = plan.moves.iter().filter(|step| step.kind == "touch");
    let mut touches: Vec<usize> = touches.filter_map(|step| step.touch).collect();
    touches.dedup();
    let contacts = touches.into_iter().filter_map(|k| plan.triggers[k]);
    contacts.map(|contact| contact.map(|x| x * unit)).collect()
}

fn same(a: &[[f64; 3]], b: &[[f64; 3]], what: &str) {
    assert_eq!(a.len(), b.len(), "{what}: {a:?} {b:?}");
    for (a, b) in a.iter().zip(b) {
        let far = (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
        assert!(far < 2e-4, "{what}: {a:?} and {b:?}");
    }
}

/// The program makes the plan's contacts, and its variables hold the plan's results.
fn agree(plan: &Plan, post: &PostDef, unit: f64, faces: &[Face], what: &str) {
    let ran = run(plan, post, unit, faces);
    assert_eq!(ran.stopped, None, "{what}\n{}", plan.program.text);
    same(&ran.contacts, &of_run(plan, unit), what);
    let mut compared = 0;
    for row in &plan.results {
        let Some(variable) = &row.stored else {
            continue;
        };
        // A TNC keeps one coordinate of a contact.
        let Some(held) = ran.variables.get(variable) else {
            continue;
        };
        // Positions of a program have five decimals in inch: 0.0003 mm.
        let within = if row.code == "rotation" {
            1e-3
        } else {
            4e-4 / unit
        };
        let what = format!("{what} {}", row.code);
        near(*held, row.value.unwrap(), within, &what);
        compared += 1;
    }
    // CYCLE978 stores no result that a source shows.
    let least = match post.key {
        "sinumerik" => 1,
        _ => shown(plan).len() / 2,
    };
    assert!(compared >= least, "{what}: {compared}");
}

fn check(text: &str, following: bool, offset: [f64; 3]) {
    for (post, inch) in computing().flat_map(|post| [(post, false), (post, true)]) {
        let what = format!("{} inch {inch} {offset:?}", post.key);
        let unit = if inch { 25.4 } else { 1.0 };
        let job = on_part(text, post.key, inch, offset);
        let plan = plan(&job).unwrap_or_else(|error| panic!("{what}: {:?}", error.findings));
        agree(&plan, post, unit, &faces(following, offset), &what);
        // A Brother's programs do not state their units.
        // The interpreter does not know how a SINUMERIK's cycles move: its strict reader knows their results.
        let unknown = post.key == "brother" && inch || post.key == "sinumerik";
        if offset != [0.0; 3] || unknown {
            continue;
        }
        // The interpreter for any program, on the nominal part.
        let start = plan.moves[0].to;
        let known = RunInputs {
            post: Some(post.key),
            start: Some([start[0], start[1], start[2] + 20.0 / unit]),
            ..RunInputs::default()
        };
        let made = run_program(&plan.program.text, &known);
        let to_tip = if post.key == "heidenhain" { 0.0 } else { 3.0 };
        let in_mm = |c: &[f64; 4]| [c[1] * unit, c[2] * unit, c[3] * unit + to_tip];
        let mut contacts: Vec<[f64; 3]> = made.contacts.iter().map(in_mm).collect();
        contacts.dedup_by(|a, b| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-9));
        let what = format!("{what}, run_program {:?}", made.findings);
        same(&contacts, &of_run(&plan, unit), &what);
    }
}

#[test]
fn native_cycles_follow_results_as_the_plan_says() {
    for offset in [
        [0.0; 3],
        [0.4, -0.3, 0.2],
        [-0.7, 0.6, -0.8],
        [0.9, -0.9, 0.95],
    ] {
        check(FOLLOWING, true, offset);
    }
}

#[test]
fn native_programs_compute_relations() {
    for relations in [LINES, CENTERS, CIRCLE] {
        let text = RELATED.replace("RELATIONS", relations);
        let few = |post: &&'static PostDef| post.key == "heidenhain";
        // Fifteen variables are too few for a circle.
        if relations == CIRCLE {
            assert_eq!(computing().filter(few).count(), 1);
            let job = on_part(&text, "fanuc", false, [0.0; 3]);
            let error = plan(&job).unwrap_err();
            assert!(
                error
                    .findings
                    .iter()
                    .any(|f| f.code == "too-many-registers")
            );
            continue;
        }
        for offset in [[0.0; 3], [0.4, -0.3, 0.0], [-1.7, 2.6, 0.0]] {
            check(&text, false, offset);
        }
    }
}

/// A result beyond its limit stops the program before the cycle that follows it, with the name of the result.
#[test]
fn beyond_its_limit_a_followed_result_stops_the_program() {
    let mut stopped = 0;
    for post in computing() {
        for (offset, code) in [
            ([0.0, 0.0, 1.5], "TOP.POINT.Z"),
            ([0.0, 0.0, -1.5], "TOP.POINT.Z"),
            ([1.2, 0.0, 0.3], "CENTER.X"),
            ([0.0, -1.2, 0.3], "CENTER.Y"),
        ] {
            if post.key == "sinumerik" && code == "TOP.POINT.Z" {
                continue;
            }
            let plan = planned(&on_part(FOLLOWING, post.key, false, offset));
            let ran = run(&plan, post, 1.0, &faces(true, offset));
            let says = ran
                .stopped
                .unwrap_or_else(|| panic!("{} {offset:?}", post.key));
            assert!(says.to_ascii_uppercase().contains(code), "{says}");
            assert!(
                plan.findings.iter().any(|f| f.code == "place-too-far"),
                "{:?}",
                plan.findings
            );
            same(&ran.contacts, &of_run(&plan, 1.0), post.key);
            stopped += 1;
        }
    }
    assert!(stopped >= 24);
}

/// A SINUMERIK's program is read back: it must stop before a cycle that follows a result beyond its limit.
#[test]
fn a_program_of_measuring_cycles_without_its_stop_breaks_the_rule() {
    let job = on_part(FOLLOWING, "sinumerik", false, [0.0; 3]);
    let text = planned(&job).program.text;
    let broken = |program: &str| -> Vec<&'static str> {
        let rows = check_program(&job, program).unwrap();
        let rows = rows.unwrap_or_else(|faults| panic!("{faults:?}\n{program}"));
        let broken = rows.iter().filter(|row| row.holds == Some(false));
        broken.map(|row| row.rule).collect()
    };
    assert_eq!(broken(&text), [""; 0]);
    let stop = "IF ABS(R1)<=1 GOTOF TP_GOOD_1\n";
    assert!(text.contains(stop), "{text}");
    for other in [
        "GOTOF TP_GOOD_1\n",
        "IF ABS(R1)<=1.2 GOTOF TP_GOOD_1\n",
        "IF ABS(R2)<=1 GOTOF TP_GOOD_1\n",
        "IF ABS(R1-0.5)<=1 GOTOF TP_GOOD_1\n",
    ] {
        let rules = broken(&text.replacen(stop, other, 1));
        assert_eq!(rules, ["place-within-limit"], "{other}");
    }
    // The stop behind the move to the next cycle comes too late.
    let from = text.find(stop).unwrap();
    let to = text.find("TP_GOOD_1:\n").unwrap() + "TP_GOOD_1:\n".len();
    let (check, rest) = (&text[from..to], &text[to..]);
    let next = rest.find("CYCLE977").unwrap();
    let late = format!("{}{}{check}{}", &text[..from], &rest[..next], &rest[next..]);
    assert_eq!(broken(&late), ["place-within-limit"]);
}

/// A TNC's cycles write one row, each the axes that come from it. The row is activated once, at the end, and not at all if the program stops.
#[test]
fn cycles_of_a_tnc_write_one_row_that_is_activated_at_the_end() {
    let text = r#"{ "format": 2, "control": { "form": "cycle", "workOffset": 3 }, "limits": { "position": 1 }, "datum": DATUM,
      "cycles": [
        { "name": "TOP", "type": "surface", "origin": [-35, 0, 0] },
        { "name": "BORE", "type": "hole", "diameter": 25 },
        { "name": "NEXT", "type": "hole", "diameter": 25, "origin": ["=BORE.center.x+60", 0, 0] } ] }"#;
    let of = |datum: &str, offset: [f64; 3]| {
        let job = on_part(&text.replace("DATUM", datum), "heidenhain", false, offset);
        let plan = planned(&job);
        let ran = run_klartext(&plan.program.text, 1.0, &faces(true, offset));
        same(&ran.contacts, &of_run(&plan, 1.0), datum);
        let back = crate::common::import(&plan.program.text).unwrap();
        assert_eq!(planned(&back.job).program.text, plan.program.text);
        let rows = ran.rows.into_iter().map(|(cycle, row)| {
            assert_eq!(row, "3");
            cycle
        });
        let shifts = plan
            .results
            .iter()
            .filter(|row| row.code.starts_with("offset."));
        let shifts: Vec<f64> = shifts.map(|row| row.value.unwrap_or(f64::NAN)).collect();
        let written = ran.written.into_iter().filter(|x| x.is_finite());
        for (written, shift) in written.zip(&shifts).filter(|_| ran.stopped.is_none()) {
            near(written, *shift, 1e-3, "what the row gets");
        }
        (rows.collect::<Vec<u32>>(), shifts, ran.stopped.is_some())
    };
    let offset = [0.4, -0.3, 0.2];
    let (rows, shifts, _) = of("null", offset);
    assert_eq!(rows, [417, 412, 247]);
    for (shift, wanted) in shifts.iter().zip(offset) {
        near(*shift, wanted, 1e-6, "the shift of the origin");
    }
    // The last bore follows the first one, and its new coordinates are those of the drawing.
    let next = r#"{ "x": "NEXT.center.x", "y": "NEXT.center.y" }"#;
    assert_eq!(of(next, offset).0, [417, 412, 247]);
    assert_eq!(of(r#"{ "z": null }"#, offset).0, [412, 247]);
    assert_eq!(of(r#"{ "x": null, "y": null }"#, offset).0, [417, 247]);
    let (rows, _, stopped) = of("null", [1.2, 0.0, 0.0]);
    assert_eq!((&rows[..], stopped), (&[417, 412][..], true));
    let codes = |datum: &str| {
        let job = on_part(&text.replace("DATUM", datum), "heidenhain", false, offset);
        let error = plan(&job).unwrap_err();
        error
            .findings
            .iter()
            .filter(|f| f.level == touchpath::form::Level::Error)
            .map(|f| format!("{} {}", f.code, f.path))
            .collect::<Vec<_>>()
    };
    // A cycle writes everything that it measures.
    assert_eq!(codes(r#"{ "y": null }"#), ["set-up-unsupported datum"]);
    assert_eq!(
        codes(r#"{ "x": "BORE.center.x", "y": "NEXT.center.y" }"#),
        ["set-up-unsupported datum"; 2]
    );
    // Cycle 417 stores no result, so nothing can follow it.
    let follows = text.replace(
        r#""diameter": 25 }"#,
        r#""diameter": 25, "origin": [0, 0, "=TOP.z"] }"#,
    );
    let job = on_part(
        &follows.replace("DATUM", "null"),
        "heidenhain",
        false,
        offset,
    );
    assert_eq!(
        plan(&job).unwrap_err().findings.last().unwrap().code,
        "place-of-result"
    );
}

/// A tolerance that stops is compared as soon as its result is known: that of a cycle before the next one, that of a relation after its last operand.
#[test]
fn a_tolerance_stops_a_program_of_native_cycles() {
    let tolerances = r#""tolerances": { "BORE.diameter": { "tolerance": "±0.15", "action": "stop" }, "MID.mean": { "tolerance": "±0.03", "action": "stop" } },
      "cycles": ["#;
    let text = FOLLOWING.replacen("\"cycles\": [", tolerances, 1);
    for post in computing() {
        for (larger, says, made) in [
            (0.2, Some("DIAMETER"), 5),
            (0.1, Some("MEAN"), 9),
            (0.04, None, 11),
        ] {
            let job = on_part(&text, post.key, false, [0.0; 3]);
            let sizes = [("BORE.diameter".to_owned(), Value::Number(larger))];
            let job = with(&job, "part.sizes", Value::Map(sizes.to_vec()));
            let plan = planned(&job);
            let mut faces = faces(true, [0.0; 3]);
            faces[1] = Face::Circle([0.0; 2], 12.5 + larger / 2.0);
            let ran = run(&plan, post, 1.0, &faces);
            let what = format!("{} {larger}", post.key);
            let made = made - usize::from(post.key == "sinumerik");
            assert_eq!(ran.contacts.len(), made, "{what}");
            match (says, ran.stopped) {
                (Some(says), Some(said)) => {
                    assert!(said.to_ascii_uppercase().contains(says), "{what}: {said}");
                }
                (says, said) => assert_eq!((says, said), (None, None), "{what}"),
            }
            let reported = plan.findings.iter().any(|f| f.code == "out-of-tolerance");
            assert_eq!(reported, says.is_some(), "{what}");
        }
        let marks = text.replacen("\"stop\"", "\"mark\"", 1);
        let error = plan(&on_part(&marks, post.key, false, [0.0; 3])).unwrap_err();
        assert_eq!(error.findings[0].code, "tolerance-unsupported");
    }
}

/// Random features one after the other, each coordinate and size of which may follow an earlier one, with relations, on random parts.
#[test]
fn random_native_set_ups_agree_with_their_programs() {
    let mut draws = Draws(77_003);
    let posts: Vec<&PostDef> = computing().collect();
    let (mut seen, mut followed) = (0, 0);
    for _ in 0..400 {
        let post = posts[draws.below(posts.len())];
        let inch = draws.below(3) == 0;
        let offset = [0; 3].map(|_| (draws.of(-0.9, 0.9) * 1e3).round() / 1e3);
        let round = |x: f64| (x * 100.0).round() / 100.0;
        let top = round(draws.of(-20.0, 20.0));
        let mut cycles = vec![format!(
            r#"{{ "name": "F0", "type": "surface", "origin": [-80, 0, {top}] }}"#
        )];
        let mut faces = vec![Face::Top(top + offset[2])];
        // Centre and size of each feature, by its name.
        let mut known: Vec<([f64; 2], f64)> = vec![([f64::NAN; 2], f64::NAN)];
        let mut follows = 0;
        for n in 1..2 + draws.below(3) {
            let kind = ["hole", "boss", "groove", "web"][draws.below(4)];
            let round_one = matches!(kind, "hole" | "boss");
            let center = [120.0 * n as f64, draws.of(-40.0, 40.0)].map(round);
            let size = round(draws.of(24.0, 40.0));
            let mut of = |axis: usize, own: f64| {
                let fits = |(_, (center, _)): &(usize, &([f64; 2], f64))| center[axis].is_finite();
                let from: Vec<(usize, &([f64; 2], f64))> =
                    known.iter().enumerate().filter(fits).collect();
                if from.is_empty() || draws.below(2) == 0 {
                    return own.to_string();
                }
                follows += 1;
                let (k, (center, _)) = from[draws.below(from.len())];
                let letter = ["x", "y"][axis];
                format!("\"=F{k}.center.{letter}{:+}\"", round(own - center[axis]))
            };
            let [x, y] = [0, 1].map(|axis| of(axis, center[axis]));
            let height = round(draws.of(top - 10.0, top));
            let z = match draws.below(2) {
                0 => height.to_string(),
                _ if post.key == "sinumerik" => height.to_string(),
                _ => format!("\"=F0.z{:+}\"", round(height - top)),
            };
            let field = if round_one { "diameter" } else { "width" };
            let size_of = match known.iter().rposition(|(_, size)| size.is_finite()) {
                Some(k) if draws.below(3) == 0 => {
                    let code = if cycles[k].contains("diameter") {
                        "diameter"
                    } else {
                        "width"
                    };
                    format!("\"=F{k}.{code}{:+}\"", round(size - known[k].1))
                }
                _ => size.to_string(),
            };
            cycles.push(format!(
                r#"{{ "name": "F{n}", "type": "{kind}", "origin": [{x}, {y}, {z}], "{field}": {size_of} }}"#
            ));
            let at = [center[0] + offset[0], center[1] + offset[1]];
            faces.extend(match kind {
                "hole" | "boss" => vec![Face::Circle(at, size / 2.0)],
                _ => {
                    let sign = if kind == "groove" { -1.0 } else { 1.0 };
                    let wall = |side: f64| {
                        let normal = side * sign;
                        Face::Wall([normal, 0.0], normal * (at[0] + side * size / 2.0))
                    };
                    vec![wall(1.0), wall(-1.0)]
                }
            });
            known.push((
                if round_one {
                    center
                } else {
                    [center[0], f64::NAN]
                },
                size,
            ));
        }
        let text = format!(
            r#"{{ "format": 2, "control": {{ "form": "cycle" }}, "limits": {{ "position": 1, "size": 0.5 }}, "overtravel": 5, "cycles": [{}] }}"#,
            cycles.join(", ")
        );
        let job = on_part(&text, post.key, inch, offset);
        let what = format!("{} inch {inch} {offset:?} {text}", post.key);
        let plan = match plan(&job) {
            Ok(plan) => plan,
            Err(error) => {
                let first = error
                    .findings
                    .iter()
                    .find(|f| f.level == touchpath::form::Level::Error)
                    .unwrap();
                // A TNC goes along arcs in a bore, and fifteen variables may be too few.
                let known = ["place-of-result", "too-many-registers"];
                assert!(known.contains(&first.code.as_str()), "{what}: {first:?}");
                continue;
            }
        };
        agree(&plan, post, if inch { 25.4 } else { 1.0 }, &faces, &what);
        seen += 1;
        followed += follows;
    }
    assert!(seen >= 200 && followed >= 200, "{seen} {followed}");
}

/// Corners and the angle of a wall on a TNC, which has no cycle for them in our sources: single touches by cycle 427, and the results by functions. The walls by
/// hand, rotated about the origin and shifted: contacts and parameters are those of the plan, and the results those of the part.
#[test]
fn a_tnc_measures_corners_by_single_touches() {
    let mut seen = 0;
    for (cycle, inside, top) in [
        (
            r#""type": "double-wall-internal-corner", "origin": [10, 20, -5], "count1": 2, "count2": 2"#,
            true,
            false,
        ),
        (
            r#""type": "double-wall-internal-corner", "origin": [10, 20, -5], "count1": 1, "count2": 1"#,
            true,
            false,
        ),
        (
            r#""type": "triple-wall-internal-corner", "origin": [10, 20, -5]"#,
            true,
            true,
        ),
        (
            r#""type": "triple-wall-external-corner", "origin": [10, 20, -5]"#,
            false,
            true,
        ),
        (
            r#""type": "wall-angle", "origin": [10, 20, -5], "rotation": -90"#,
            false,
            false,
        ),
    ] {
        let angle = cycle.contains("wall-angle");
        for (degrees, [dx, dy, dz]) in [
            (0.0, [0.0; 3]),
            (0.0, [0.4, -0.3, 0.2]),
            (0.6, [0.4, -0.3, 0.2]),
            (-0.8, [-0.5, 0.2, -0.3]),
        ] {
            // One touch on each wall gives no angle.
            if degrees != 0.0 && !angle && !cycle.contains("\"count1\": 2") {
                continue;
            }
            for inch in [false, true] {
                let text = format!(
                    r#"{{ "format": 1, "control": {{ "post": "heidenhain", "form": "cycle" }}, "cycle": {{ {cycle} }} }}"#
                );
                let job = on_part(&text, "heidenhain", false, [dx, dy, dz]);
                let job = with(&job, "part.rotation", Value::Number(degrees));
                let job = if inch {
                    convert_units(&job, "inch").unwrap()
                } else {
                    job
                };
                let unit = if inch { 25.4 } else { 1.0 };
                let plan = planned(&job);
                let (s, c) = f64::to_radians(degrees).sin_cos();
                let turned = |[x, y]: [f64; 2]| [c * x - s * y, s * x + c * y];
                let corner = turned([10.0, 20.0]);
                let corner = [corner[0] + dx, corner[1] + dy];
                let sign = if inside { 1.0 } else { -1.0 };
                let wall = |normal: [f64; 2]| {
                    let n = turned(normal);
                    Face::Wall(n, n[0] * corner[0] + n[1] * corner[1])
                };
                let mut faces = match angle {
                    true => vec![wall([0.0, -1.0])],
                    false => vec![wall([sign, 0.0]), wall([0.0, sign])],
                };
                faces.extend(top.then_some(Face::Top(dz - 5.0)));
                let ran = run_klartext(&plan.program.text, unit, &faces);
                let what = format!("{cycle} {degrees} inch {inch}");
                same(&ran.contacts, &of_run(&plan, unit), &what);
                for row in plan.results.iter().filter(|row| row.stored.is_some()) {
                    let (held, value) = (
                        ran.variables[row.stored.as_ref().unwrap()],
                        row.value.unwrap(),
                    );
                    let within = if row.unit == "deg" { 1e-3 } else { 1e-3 / unit };
                    near(held, value, within, &format!("{what} {}", row.code));
                    let truth = row.truth.unwrap();
                    near(
                        value,
                        truth,
                        4.0 * within,
                        &format!("{what} {} is true", row.code),
                    );
                    seen += 1;
                }
                let back = crate::common::import(&plan.program.text).unwrap();
                assert_eq!(planned(&back.job).program.text, plan.program.text);
            }
        }
    }
    assert!(seen >= 60, "{seen}");
}

/// The angle of a wall with Renishaw's macros: two calls of P9811, and ATAN in macro B. The wall by hand, as above, on each side of a part that is turned and shifted.
#[test]
fn macros_measure_the_angle_of_a_wall_by_single_touches() {
    let mut seen = 0;
    for post in computing().filter(|post| !["heidenhain", "sinumerik"].contains(&post.key)) {
        for (rotation, normal) in [
            (0, [1.0, 0.0]),
            (90, [0.0, 1.0]),
            (180, [-1.0, 0.0]),
            (-90, [0.0, -1.0]),
        ] {
            for (degrees, [dx, dy]) in [(0.0, [0.0; 2]), (0.6, [0.4, -0.3]), (-0.8, [-0.5, 0.2])] {
                let inch = seen % 2 == 1;
                let unit = if inch { 25.4 } else { 1.0 };
                let text = format!(
                    r#"{{ "format": 1, "control": {{ "form": "cycle" }}, "cycle": {{ "type": "wall-angle", "origin": [10, 20, -5], "rotation": {rotation} }} }}"#
                );
                let job = on_part(&text, post.key, inch, [dx, dy, 0.0]);
                let plan = planned(&with(&job, "part.rotation", Value::Number(degrees)));
                let (s, c) = f64::to_radians(degrees).sin_cos();
                let turned = |[x, y]: [f64; 2]| [c * x - s * y, s * x + c * y];
                let ([nx, ny], [x, y]) = (turned(normal), turned([10.0, 20.0]));
                let face = Face::Wall([nx, ny], nx * (x + dx) + ny * (y + dy));
                let ran = run_macros(&plan.program.text, post.key, unit, &[face]);
                let what = format!("{} {rotation} {degrees} inch {inch}", post.key);
                same(&ran.contacts, &of_run(&plan, unit), &what);
                let row = plan.results.iter().find(|row| row.unit == "deg").unwrap();
                let held = ran.variables[row.stored.as_ref().unwrap()];
                near(held, row.value.unwrap(), 1e-3, &what);
                near(held, row.truth.unwrap(), 4e-3, &what);
                let back = crate::common::import(&plan.program.text).unwrap();
                assert_eq!(planned(&back.job).program.text, plan.program.text);
                seen += 1;
            }
        }
        let text = r#"{ "format": 1, "control": { "form": "cycle" CONTROL }, "cycle": { "type": "wall-angle" TURN } }"#;
        for (control, turn, wanted) in [
            (
                r#", "workOffset": 1"#,
                "",
                "work-offset-unsupported control.workOffset",
            ),
            (
                "",
                r#", "rotation": 20"#,
                "cycle-not-parallel cycle.rotation",
            ),
        ] {
            let text = text.replace("CONTROL", control).replace("TURN", turn);
            let error = plan(&on_part(&text, post.key, false, [0.0; 3])).unwrap_err();
            let error = error
                .findings
                .iter()
                .find(|f| f.level == touchpath::form::Level::Error);
            let error = error.unwrap();
            assert_eq!(format!("{} {}", error.code, error.path), wanted);
        }
    }
    assert!(seen >= 60, "{seen}");
}

/// A bore that follows a corner of single touches, and the line between both.
#[test]
fn a_bore_of_a_tnc_follows_a_corner() {
    let text = r#"{ "format": 2, "control": { "form": "cycle" }, "limits": { "position": 1 },
      "cycles": [
        { "name": "EDGE", "type": "double-wall-internal-corner", "origin": [10, 20, -5], "count1": 2, "count2": 2 },
        { "name": "BORE", "type": "hole", "diameter": 25, "origin": ["=EDGE.corner.x+60", "=EDGE.corner.y+60", 0] } ],
      "relations": [{ "name": "WAY", "type": "line", "of": ["EDGE", "BORE"] }] }"#;
    for [x, y] in [[0.0, 0.0], [0.4, -0.3], [-0.9, 0.8]] {
        let plan = planned(&on_part(text, "heidenhain", false, [x, y, 0.0]));
        let faces = [
            Face::Wall([1.0, 0.0], 10.0 + x),
            Face::Wall([0.0, 1.0], 20.0 + y),
            Face::Circle([70.0 + x, 80.0 + y], 12.5),
        ];
        let heidenhain = touchpath::control::find("heidenhain").unwrap();
        agree(&plan, heidenhain, 1.0, &faces, "a corner and a bore");
        let way = plan
            .results
            .iter()
            .find(|row| row.code == "distance")
            .unwrap();
        near(way.value.unwrap(), 60f64.hypot(60.0), 1e-6, "as drawn");
    }
}

/// What would write or compute a wrong value is refused.
#[test]
fn what_native_cycles_cannot_follow_or_stop_is_refused() {
    let errors = |cycles: &str, more: &str, post: &str| {
        let text = format!(
            r#"{{ "format": 2, "control": {{ "form": "cycle" {more} }}, "limits": {{ "position": 1 }}, "cycles": [
              {{ "name": "A", "type": "hole", "diameter": 25 }}, {{ "name": "B", "type": "hole", "diameter": 25, "origin": [60, 0, 0] }}, {cycles} }}"#
        );
        match plan(&on_part(&text, post, false, [0.0; 3])) {
            Ok(_) => Vec::new(),
            Err(error) => error
                .findings
                .into_iter()
                .filter(|f| f.level == touchpath::form::Level::Error)
                .map(|f| format!("{} {}", f.code, f.path))
                .collect(),
        }
    };
    let follows =
        r#"{ "name": "C", "type": "hole", "diameter": 25, "origin": ["=A.center.x+120", 0, 0] } ]"#;
    let stays = r#"{ "name": "C", "type": "hole", "diameter": 25, "origin": [120, 0, 0] } ],
      "relations": [{ "name": "D", "type": "line", "of": OF }], "tolerances": { "D.distance": { "tolerance": "±0.1", "action": "stop" } }"#;
    let (early, late) = (
        stays.replace("OF", r#"["A", "B"]"#),
        stays.replace("OF", r#"["A", "C"]"#),
    );
    for post in computing().filter(|post| post.own.unwrap().several.activates.is_none()) {
        let offset = r#", "workOffset": 1"#;
        // A macro writes the deviation from the position at its call.
        assert_eq!(
            errors(follows, offset, post.key),
            ["place-of-result datum"],
            "{}",
            post.key
        );
        assert!(errors(follows, "", post.key).is_empty(), "{}", post.key);
        // The relation of the first two is compared before the last macro writes.
        assert!(errors(&early, offset, post.key).is_empty(), "{}", post.key);
        let refused = errors(&late, offset, post.key);
        assert_eq!(
            refused,
            ["tolerance-unsupported tolerances.D.distance.action"],
            "{}",
            post.key
        );
    }
    // The formula of single touches has the other coordinates of the drawing.
    let corner = r#"{ "name": "C", "type": "double-wall-internal-corner", "origin": ["=A.center.x+120", 0, 0], "count1": 2, "count2": 2 } ]"#;
    assert_eq!(
        errors(corner, "", "heidenhain"),
        ["place-of-result cycles[2].origin[0]"]
    );
}

/// On a rotated part the second bore is 1.3 mm from its place on the drawing, and 0.8 mm from the one that it follows: with a limit of 1 mm no call stops. By
/// hand: 0.5 + 60 sin 0.8° and 60 sin 0.8°.
#[test]
fn limits_of_a_native_cycle_count_from_the_followed_position() {
    let text = r#"{ "format": 2, "control": { "form": "cycle" }, "limits": { "position": 1 },
      "cycles": [
        { "name": "BORE", "type": "hole", "diameter": 25 },
        { "name": "NEXT", "type": "hole", "diameter": 25, "origin": [60, Y, 0] } ] }"#;
    for post in computing() {
        let stops = |y: &str| {
            let job = on_part(&text.replace('Y', y), post.key, false, [0.0, 0.5, 0.0]);
            let plan = planned(&with(&job, "part.rotation", Value::Number(0.8)));
            plan.findings.iter().any(|finding| {
                finding
                    .message
                    .contains("the native cycle stops with a message")
            })
        };
        assert!(stops("0"), "{}", post.key);
        assert!(!stops("\"=BORE.center.y\""), "{}", post.key);
    }
}
