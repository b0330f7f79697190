//! Cycles whose position follows a result of an earlier one, against LinuxCNC's interpreter, the simulated controls and hand calculations.

use super::cycle;
use crate::common::fanuc::Control;
use crate::common::mpf::read;
use crate::common::sinumerik::Machine;
use crate::common::{
    Draws, ending_at, import, interpret, interpret_until_stop, job, on_virtual_part, planned,
    values, with,
};
use crate::tests::controls::{computing, skipping};
use touchpath::control::find;
use touchpath::form::{Level, Value};
use touchpath::job::{Plan, check, convert_units, plan};

/// A top, a bore whose depth follows it, and a stud 60 mm from the bore, 2 mm below the top.
pub const STEPS: &str = r#"{ "format": 2, "name": "STEPS", "control": { "post": "linuxcnc", "workOffset": 1, "report": "screen" }, "limits": { "position": 1 },
  "cycles": [
    { "name": "TOP", "type": "surface", "origin": [-35, 0, 0] },
    { "name": "BORE", "type": "hole", "diameter": 25, "origin": [0, 0, "=TOP.z"] },
    { "name": "STUD", "type": "boss", "diameter": 20, "origin": ["=BORE.center.x+60", 0, "=TOP.point.z - 2"] }
  ],
  "part": { "offset": [0.2, 0.1, 0.3] } }"#;

fn on(post: &str) -> Value {
    with(&job(STEPS), "control.post", Value::Text(post.to_owned()))
}

/// The part, displaced by this.
fn at(job: &Value, offset: [f64; 3]) -> Value {
    with(
        job,
        "part.offset",
        Value::List(offset.map(Value::Number).to_vec()),
    )
}

pub fn near(a: f64, b: f64, within: f64, what: &str) {
    assert!((a - b).abs() <= within, "{what}: {a} and {b}");
}

/// Results of a plan, by the names that programs print.
pub fn shown(plan: &Plan) -> Vec<(String, f64)> {
    let rows = plan
        .results
        .iter()
        .filter(|row| !row.code.starts_with("offset."));
    let names: Vec<&String> = plan.cycles.iter().chain(&plan.relations).collect();
    rows.filter_map(|row| Some((format!("{}.{}", names[row.cycle], row.code), row.value?)))
        .collect()
}

/// Shift of each cycle on the part of [`STEPS`], by hand.
const BY_HAND: [[f64; 3]; 3] = [[0.0; 3], [0.0, 0.0, 0.3], [0.2, 0.0, 0.3]];

/// LinuxCNC's interpreter shifts each cycle by the earlier results, and prints the results of the plan.
#[test]
fn the_interpreter_goes_where_the_results_say() {
    let plan = planned(&job(STEPS));
    let ran = interpret(&on_virtual_part(&plan)).unwrap();
    assert_eq!(ran.prints.len(), shown(&plan).len());
    for ((code, printed), (name, value)) in ran.prints.iter().zip(shown(&plan)) {
        assert_eq!(*code, name);
        near(*printed, value, 3e-6, code);
    }
    // Every position in a move of a cycle is the nominal one, shifted.
    let mut compared = [0; 3];
    for step in plan
        .moves
        .iter()
        .filter(|step| step.step > 0 && step.kind != "touch")
    {
        let wanted = [0, 1, 2].map(|axis| step.to[axis] + BY_HAND[step.cycle][axis]);
        let found = ran
            .moves
            .iter()
            .any(|made| (0..3).all(|axis| (made.to[axis] - wanted[axis]).abs() < 2e-6));
        assert!(
            found,
            "{} goes to {wanted:?}: {:?}",
            plan.cycles[step.cycle], ran.moves
        );
        compared[step.cycle] += 1;
    }
    assert!(compared.iter().all(|count| *count > 1), "{compared:?}");
    // The clearance plane between them follows nothing.
    let across: Vec<f64> = plan
        .moves
        .iter()
        .filter(|step| step.step == 0)
        .map(|step| step.to[2])
        .collect();
    near(
        across.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        33.0,
        1e-9,
        "30 above the part, twice the limit and a millimetre",
    );
}

/// A top that is found 1.1 mm too high: the bore is not touched, and nothing is written.
#[test]
fn beyond_the_limit_every_control_stops_before_the_cycle_that_follows() {
    let high = at(&job(STEPS), [0.0, 0.0, 1.1]);
    for (post, how) in computing()
        .into_iter()
        .flat_map(|post| [(post, 1.1), (post, -1.1)])
    {
        let job = at(
            &with(&high, "control.post", Value::Text(post.to_owned())),
            [0.0, 0.0, how],
        );
        let plan = planned(&job);
        let said = plan
            .findings
            .iter()
            .find(|f| f.code == "place-too-far")
            .unwrap_or_else(|| panic!("{post}"));
        assert_eq!(
            values(said)[..2],
            ["BORE", "TOP.point.z"],
            "{post}: before the cycle, by the result"
        );
        // Earlier results are shown: they are the reason for the stop.
        assert!(
            plan.results
                .iter()
                .all(|row| row.value.is_none() || row.cycle == 0),
            "{post}"
        );
        let top = plan
            .results
            .iter()
            .find(|row| row.cycle == 0 && row.code == "point.z")
            .unwrap();
        near(top.value.unwrap() - top.nominal.unwrap(), how, 1e-9, post);
        assert_eq!(
            plan.triggers
                .iter()
                .filter(|trigger| trigger.is_some())
                .count(),
            1
        );
        assert!(
            plan.findings
                .iter()
                .all(|f| !["no-contact", "collision"].contains(&f.code.as_str())),
            "{:?}",
            plan.findings
        );
        let gone = stops_by(&plan, post, "TOP.point.z");
        assert!(
            gone.iter()
                .skip_while(|to| to[0] > -35.0)
                .all(|to| to[0] == -35.0),
            "nothing goes to the bore: {gone:?}"
        );
    }
    // Slightly within the limit everything is measured.
    let within = planned(&at(&job(STEPS), [0.0, 0.0, 0.99]));
    assert!(within.triggers.iter().all(Option::is_some));
}

/// The simulated SINUMERIK, Fanuc and Haas run a set-up: their results equal those of the plan.
pub fn the_machines_measure_what_is_shown(text: &str) {
    let on = |post: &str| {
        planned(&with(
            &job(text),
            "control.post",
            Value::Text(post.to_owned()),
        ))
    };
    let plan = on("sinumerik");
    let mut machine = Machine::new(plan.triggers.clone());
    machine.run(&read(&plan.program.text).unwrap()).unwrap();
    assert_eq!(machine.alarm, None, "{}", machine.message);
    let said: String = machine.messages.join(" ");
    for (name, value) in shown(&plan)
        .into_iter()
        .filter(|(name, _)| !name.ends_with("residual"))
    {
        let word = format!("{name}=");
        let behind = said
            .split(&word)
            .nth(1)
            .unwrap_or_else(|| panic!("{word} in {said}"));
        let end = behind
            .find(|c: char| !(c.is_ascii_digit() || ".-".contains(c)))
            .unwrap_or(behind.len());
        near(behind[..end].parse().unwrap(), value, 2e-5, &name);
    }
    for post in skipping() {
        let plan = on(post);
        let mut control = Control::new(post == "haas", false);
        control.contacts = plan.triggers.iter().flatten().copied().collect();
        control
            .variables
            .extend((5221..=5223).map(|origin| (origin, 0.0)));
        control.run(&plan.program.text).unwrap();
        assert_eq!(control.alarm, None, "{post}");
        for (name, value) in shown(&plan) {
            // The header states the variable of each.
            let said = format!(" = {}", name.to_uppercase());
            let ends =
                |rest: &str| !rest.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '.');
            let mut parts = plan
                .program
                .text
                .match_indices(&said)
                .filter(|(at, _)| ends(&plan.program.text[at + said.len()..]));
            let (at, _) = parts.next().unwrap_or_else(|| panic!("{post} {name}"));
            let number = plan.program.text[..at]
                .rsplit('#')
                .next()
                .unwrap()
                .parse::<i64>()
                .unwrap();
            near(
                control.variables[&number],
                value,
                2e-4,
                &format!("{post} {name}"),
            );
        }
    }
}

/// The control stops at this result without a write; returns the path in LinuxCNC's interpreter.
pub fn stops_by(plan: &Plan, post: &str, result: &str) -> Vec<[f64; 3]> {
    match post {
        "linuxcnc" => {
            let (ran, why) =
                interpret_until_stop(&ending_at(plan, |k| plan.triggers[k].unwrap_or_default()));
            let why = why.expect("it stops");
            assert!(why.contains(&format!("{result} is")), "{why}");
            assert_eq!(ran.written, None);
            return ran.moves.iter().map(|made| made.to).collect();
        }
        "sinumerik" => {
            let mut machine = Machine::new(plan.triggers.clone());
            machine.run(&read(&plan.program.text).unwrap()).unwrap();
            assert!(
                machine.alarm.is_some() && machine.message.contains(result),
                "{}",
                machine.message
            );
        }
        _ => {
            let mut control = Control::new(post == "haas", false);
            control.contacts = plan.triggers.iter().flatten().copied().collect();
            control.run(&plan.program.text).unwrap();
            // An alarm has little room: a long name may be reduced to its end.
            let (_, code) = result.split_once('.').unwrap();
            let alarm = control
                .alarm
                .as_ref()
                .map(|alarm| format!("{alarm:?}"))
                .unwrap_or_default();
            assert!(alarm.contains(&code.to_uppercase()), "{post} {alarm}");
        }
    }
    Vec::new()
}

/// Each touch has its contact where the virtual part predicts, from the shifted positions.
#[test]
fn the_other_controls_measure_what_the_plan_shows() {
    the_machines_measure_what_is_shown(STEPS);
}

/// The text of a position is read back from every header, and converted to other units.
#[test]
fn places_that_follow_come_back_from_headers_and_units() {
    for post in computing() {
        let plan = planned(&on(post));
        let back = import(&plan.program.text).unwrap();
        assert!(
            back.findings
                .iter()
                .all(|finding| finding.level != Level::Warning),
            "{post}: {:?}",
            back.findings
        );
        assert_eq!(planned(&back.job).program.text, plan.program.text, "{post}");
    }
    let inch = convert_units(&job(STEPS), "inch").unwrap();
    let Some(Value::List(cycles)) = inch.get("cycles") else {
        unreachable!()
    };
    let Some(Value::List(origin)) = cycles[2].get("origin") else {
        unreachable!()
    };
    assert_eq!(origin[0], Value::Text("=BORE.center.x+2.362205".to_owned()));
    assert_eq!(origin[2], Value::Text("=TOP.point.z-0.07874".to_owned()));
    let (mm, inch) = (planned(&job(STEPS)), planned(&inch));
    for (a, b) in mm.triggers.iter().zip(&inch.triggers) {
        let (a, b) = (a.unwrap(), b.unwrap());
        (0..3).for_each(|axis| near(a[axis], b[axis] * 25.4, 1e-4, "the same contacts"));
    }
}

#[test]
fn a_place_that_cannot_follow_is_refused_at_its_place() {
    let errors = |job: &Value| {
        let errors = check(job).into_iter().filter(|f| f.level == Level::Error);
        errors
            .map(|f| format!("{} {}", f.code, f.path))
            .collect::<Vec<_>>()
    };
    let text = |given: &str| STEPS.replace("=TOP.point.z - 2", given);
    for given in [
        "=",
        "= ",
        "TOP.z",
        "=TOP",
        "=TOP.",
        "=TOP.y",
        "=TOP.point.x",
        "=TOP.deviation",
        "=BORE.diameter",
        "=STUD.center.x",
        "=NONE.z",
        "=BORE.x",
        "=TOP.z*2",
        "=TOP.z-",
        "=TOP.z--2",
        "=TOP.z-2)\\nG0 Z-99",
        "=TOP.z+1e3",
        "=TOP.z-2-3",
        "=TOP.z - two",
    ] {
        let wanted = if given == "TOP.z" {
            "wrong-type cycles[2].origin[2]"
        } else {
            "place-of-result cycles[2].origin[2]"
        };
        assert_eq!(errors(&job(&text(given))), [wanted], "{given}");
    }
    for given in ["=top.Z-2", "=TOP.z", "= TOP.point.z +0", "=TOP.z-0,5"] {
        assert!(
            errors(&job(&text(given))).is_empty(),
            "{given}: {:?}",
            errors(&job(&text(given)))
        );
    }
    // The first cycle follows none; neither does a job with one cycle.
    let first = STEPS.replace("[-35, 0, 0]", "[-35, 0, \"=BORE.z\"]");
    assert!(errors(&job(&first)).contains(&"place-of-result cycles[0].origin[2]".to_owned()));
    let alone = job(r#"{ "format": 1, "cycle": { "type": "hole", "origin": [0, 0, "=TOP.z"] } }"#);
    assert_eq!(errors(&alone), ["wrong-type cycle.origin[2]"]);
    // Without a limit the shift is unbounded.
    let limitless = with(&job(STEPS), "limits.position", Value::Null);
    assert!(
        errors(&limitless)
            .iter()
            .all(|error| error.starts_with("place-of-result"))
            && errors(&limitless).len() == 3
    );
    let grbl = with(
        &with(&job(STEPS), "control.post", Value::Text("grbl".to_owned())),
        "control.workOffset",
        Value::Null,
    );
    assert!(
        errors(&grbl).contains(&"set-up-unsupported cycles[1].origin[2]".to_owned()),
        "{:?}",
        errors(&grbl)
    );
    // Its programs of native cycles do not compute.
    let own = with(
        &on("okuma"),
        "control.form",
        Value::Text("cycle".to_owned()),
    );
    assert!(
        errors(&own).contains(&"set-up-unsupported cycles[1].origin[2]".to_owned()),
        "{:?}",
        errors(&own)
    );
    // A link move that a shift could make shorter than zero.
    let low = with(&job(STEPS), "clear", Value::Number(30.5));
    assert_eq!(errors(&low), ["clear-too-low clear"]);
    // A move across that is longer than zero, but shorter than the limits and the shortest probe move: with a limit as large as the move is short.
    let beside = |limit: f64, protection: &str| {
        format!(
            r#"{{ "format": 2, "control": {{ "post": "linuxcnc", "protection": "{protection}" }}, "limits": {{ "position": {limit} }},
            "cycles": [{{ "name": "A", "type": "hole", "diameter": 12 }}, {{ "name": "B", "type": "hole", "diameter": 12, "origin": ["=A.center.x+15", 0, 0] }}] }}"#
        )
    };
    assert_eq!(
        errors(&job(&beside(15.0, "checked"))),
        ["place-of-result cycles[1].origin"]
    );
    assert!(
        errors(&job(&beside(15.0, "none"))).is_empty(),
        "nothing is to be watched"
    );
    assert!(errors(&job(&beside(14.0, "checked"))).is_empty());
    // At the height at which the cycle begins there is no move across that follows no height.
    let level = r#"{ "format": 2, "overtravel": 10, "control": { "post": "linuxcnc", "protection": "none" }, "clear": 30, "limits": { "position": 9 },
        "cycles": [{ "name": "TOP", "type": "surface", "origin": [-60, 0, 0], "clearance": 13, "feedDistance": 17 },
                   { "name": "BORE", "type": "hole", "diameter": 25, "origin": [20, 0, "=TOP.z"] }] }"#;
    assert_eq!(errors(&job(level)), ["clear-too-low clear"]);
    for given in ["\\t=TOP.z", "=TOP.z\\n", "=\u{a0}TOP.z-2"] {
        assert_eq!(
            errors(&job(&text(given))).len(),
            1,
            "white space that a header does not keep"
        );
    }
}

/// Across at the clearance plane, which follows nothing; then down, to a position that does.
#[test]
fn no_way_goes_across_and_down_at_once() {
    for post in computing() {
        let plan = planned(&on(post));
        let mut from = plan.moves[0].to;
        for step in &plan.moves[1..] {
            let across = (0..2).any(|axis| (step.to[axis] - from[axis]).abs() > 1e-9);
            assert!(
                step.step != 0 || !across || (step.to[2] - from[2]).abs() < 1e-9,
                "{post}: {step:?}"
            );
            from = step.to;
        }
    }
    // A bore in a bore: the move across is only the shift of the first result. It stays level, and is not watched, because it may be shorter than a probe move.
    let counterbore = r#"{ "format": 2, "control": { "post": "linuxcnc" }, "limits": { "position": 0.5 }, "part": { "offset": [0.4, -0.3, 0] },
        "cycles": [{ "name": "A", "type": "hole", "diameter": 40 }, { "name": "B", "type": "hole", "diameter": 20, "origin": ["=A.center.x", "=A.center.y", -10] }] }"#;
    for post in computing() {
        let plan = planned(&with(
            &job(counterbore),
            "control.post",
            Value::Text(post.to_owned()),
        ));
        let watched = plan
            .findings
            .iter()
            .all(|f| f.code != "positioning-not-watched");
        assert_eq!(watched, find(post).unwrap().shortest_probe == 0.0, "{post}");
    }
    let plan = planned(&job(counterbore));
    let way = plan.moves.iter().position(|step| step.step == 0).unwrap();
    let line = plan
        .program
        .text
        .lines()
        .nth(plan.program.move_lines[way] as usize)
        .unwrap();
    assert_eq!(line, "G1 X[0+#<b_shift_x>] Y[0+#<b_shift_y>] Z30 F2000");
    let ran = interpret(&on_virtual_part(&plan)).unwrap();
    let printed = |code: &str| {
        ran.prints
            .iter()
            .find(|(known, _)| known == code)
            .unwrap()
            .1
    };
    near(printed("B.center.x"), 0.4, 1e-5, "B");
    near(printed("B.center.y"), -0.3, 1e-5, "B");
    near(printed("B.diameter"), 20.0, 1e-5, "B");
}

/// Chains of holes, each beside the one before it, with limits from far below the scatter of touches to millimetres: every one is proven.
#[test]
fn chains_are_proven_at_any_limit() {
    for (post, count, limits) in [
        ("linuxcnc", 40, [0.001, 0.02, 0.1, 2.0]),
        ("haas", 3, [0.001, 2.95, 3.0, 3.35]),
        ("fanuc", 2, [0.01, 0.5, 3.35, 3.0]),
    ] {
        for limit in limits {
            let cycles: Vec<String> = (0..count)
                .map(|i| match i {
                    0 => r#"{ "name": "C0", "type": "hole" }"#.to_owned(),
                    _ => format!(
                        r#"{{ "name": "C{i}", "type": "hole", "origin": ["=C{0}.center.x+60", "=C{0}.center.y", 0] }}"#,
                        i - 1
                    ),
                })
                .collect();
            let text = format!(
                r#"{{ "format": 2, "control": {{ "post": "{post}", "workOffset": 1 }}, "limits": {{ "position": {limit} }}, "cycles": [{}] }}"#,
                cycles.join(", ")
            );
            let plan =
                plan(&job(&text)).unwrap_or_else(|e| panic!("{post} {count} {limit}: {e:?}"));
            assert!(
                plan.safety
                    .iter()
                    .any(|row| row.rule == "place-within-limit" && row.holds == Some(true))
            );
        }
    }
}

/// In a chain, too, a check of only one side is found.
#[test]
fn a_chain_whose_first_question_is_one_sided_breaks_the_rule() {
    let text = r#"{ "format": 2, "control": { "post": "linuxcnc" }, "limits": { "position": 1 },
        "cycles": [{ "name": "C0", "type": "hole" }, { "name": "C1", "type": "hole", "origin": ["=C0.center.x+60", 0, 0] },
                   { "name": "C2", "type": "hole", "origin": ["=C1.center.x+60", 0, 0] }] }"#;
    let program = planned(&job(text)).program.text;
    for (sure, bare) in [
        ("[ABS[#<c0_center_x>] GT 1]", "[#<c0_center_x> GT 1]"),
        ("[ABS[#<c1_center_x>-60] GT 1]", "[#<c1_center_x> LT 59]"),
    ] {
        assert!(program.contains(sure), "{sure}");
        let rows = touchpath::job::check_program(&job(text), &program.replacen(sure, bare, 1))
            .unwrap()
            .unwrap();
        let row = rows
            .iter()
            .find(|row| row.rule == "place-within-limit")
            .unwrap();
        assert_eq!(row.holds, Some(false), "{bare}");
    }
}

/// Checks of a shifted cycle are at its shifted position: shank, starts of touches, measured points.
#[test]
fn a_shifted_cycle_is_judged_where_it_is() {
    let deep = r#"{ "format": 2, "control": { "post": "linuxcnc" }, "limits": { "position": 1 }, "stylus": { "diameter": 6, "length": 10.5, "shank": 4, "body": 40 },
        "cycles": [{ "name": "TOP", "type": "surface", "origin": [-35, 0, 0] }, { "name": "BORE", "type": "hole", "diameter": 25, "origin": [0, 0, "=TOP.z"] }],
        "part": { "offset": [0, 0, 0.9] } }"#;
    for high in [0.9, 3.0] {
        let found = check(&at(&job(deep), [0.0, 0.0, high]));
        assert!(
            found.iter().all(|f| f.code != "shank-collision"),
            "{high}: {found:?}"
        );
    }
    let still = job(&deep.replace("\"=TOP.z\"", "0"));
    assert!(
        check(&still).iter().any(|f| f.code == "shank-collision"),
        "that does not follow goes 10.9 mm deep"
    );

    let near_start = with(
        &with(&job(STEPS), "control.post", Value::Text("fanuc".to_owned())),
        "limits.position",
        Value::Number(1.2),
    );
    let near_start = at(&near_start, [0.99, 0.0, 0.0]);
    let Some(Value::List(cycles)) = near_start.get("cycles") else {
        unreachable!()
    };
    let mut cycles = cycles.clone();
    cycles[2] = with(&cycles[2], "sideClearance", Value::Number(3.99));
    let near_start = with(&near_start, "cycles", Value::List(cycles));
    assert!(
        check(&near_start)
            .iter()
            .all(|f| f.code != "contact-at-start"),
        "{:?}",
        check(&near_start)
    );

    let far = r#"{ "format": 2, "overtravel": 3, "control": { "post": "linuxcnc" }, "limits": { "position": 8 },
        "cycles": [{ "name": "A", "type": "surface", "elevation": 0, "origin": [0, 0, -5], "clearance": 15 },
                   { "name": "B", "type": "hole", "diameter": 20, "origin": ["=A.x-60", 0, 0] }], "part": { "offset": [7, 0, 0] } }"#;
    let plan = planned(&job(far));
    let points: Vec<Value> = plan
        .triggers
        .iter()
        .map(|t| Value::List(t.unwrap().map(Value::Number).to_vec()))
        .collect();
    let rows = touchpath::job::evaluate(&job(far), &Value::List(points)).unwrap();
    near(
        rows.iter()
            .find(|row| row.code == "center.x")
            .unwrap()
            .value
            .unwrap(),
        -53.0,
        1e-5,
        "measured again",
    );

    // One stop, one finding.
    let stopped = check(&at(&job(STEPS), [1.2, 0.0, 0.0]));
    assert_eq!(
        stopped
            .iter()
            .filter(|f| ["implausible", "place-too-far"].contains(&f.code.as_str()))
            .count(),
        1,
        "{stopped:?}"
    );
}

/// Two to five cycles, each following any earlier one, on parts anywhere within the limit.
#[test]
fn random_chains_measure_their_part_wherever_it_lies() {
    let mut draws = Draws(77);
    let mut followed = 0;
    for round in 0..16 {
        let count = 2 + draws.below(4);
        let cycles: Vec<Value> = (0..count)
            .map(|i| {
                let key = if i == 0 {
                    "hole"
                } else {
                    ["surface", "hole", "boss"][draws.below(3)]
                };
                let mut at: Vec<Value> = [150.0 * i as f64, 10.0, -1.0].map(Value::Number).to_vec();
                for axis in 0..2 {
                    if i > 0 && draws.next() < 0.6 {
                        let (name, nominal) = ("C0.center", [0.0, 10.0][axis]);
                        let Value::Number(own) = at[axis] else {
                            unreachable!()
                        };
                        at[axis] =
                            Value::Text(format!("={name}.{}{:+}", ["x", "y"][axis], own - nominal));
                        followed += 1;
                    }
                }
                with(
                    &with(&cycle(key, 0.0), "origin", Value::List(at)),
                    "name",
                    Value::Text(format!("C{i}")),
                )
            })
            .collect();
        let text = format!(
            r#"{{ "format": 2, "control": {{ "post": "linuxcnc" }}, "limits": {{ "position": 1.5 }}, "part": {{ "offset": [{:.4}, {:.4}, {:.4}] }}, "cycles": [] }}"#,
            draws.of(-1.4, 1.4),
            draws.of(-1.4, 1.4),
            draws.of(-0.4, 0.4)
        );
        let whole = with(&job(&text), "cycles", Value::List(cycles));
        let plan = plan(&whole).unwrap_or_else(|e| panic!("round {round}: {e:?}"));
        assert!(
            plan.triggers.iter().all(Option::is_some),
            "round {round}: {:?}",
            plan.findings
        );
        let ran =
            interpret(&on_virtual_part(&plan)).unwrap_or_else(|e| panic!("round {round}: {e}"));
        for ((code, printed), (name, value)) in ran.prints.iter().zip(shown(&plan)) {
            assert_eq!(*code, name);
            near(*printed, value, 3e-6, code);
        }
        for row in plan
            .results
            .iter()
            .filter(|row| row.code.starts_with("center"))
        {
            near(
                row.value.unwrap(),
                row.truth.unwrap(),
                1e-5,
                &format!("round {round}"),
            );
        }
    }
    assert!(followed > 20, "{followed}");
}

/// A web that is rotated by a millionth of a degree has no position along its walls, and a value that follows it never deviates.
#[test]
fn a_coordinate_that_nothing_changes_stops_nothing() {
    let text = r#"{ "format": 2, "control": { "post": "linuxcnc", "workOffset": 1 }, "limits": { "position": 0.05 },
        "cycles": [{ "name": "WEB", "type": "web-three-points", "origin": [0, 20, 0], "rotation": -359.999999 },
                   { "name": "TOP", "type": "surface", "origin": [200, "=WEB.y-10", 0] }] }"#;
    let plan = planned(&job(text));
    assert!(
        plan.safety
            .iter()
            .any(|row| row.rule == "place-within-limit" && row.holds == Some(true))
    );
}

/// Touches a micrometre apart are written at one position: read back as a foreign program, each still has its contact, and what follows has a value.
#[test]
fn touches_in_one_place_are_told_apart_by_their_order() {
    let text = r#"{ "format": 2, "plane": "G18", "control": { "post": "sinumerik", "protection": "none", "workOffset": 1 }, "limits": { "position": 0.05 },
        "cycles": [{ "name": "C1", "type": "double-wall-internal-corner", "origin": [-86, -68, 15], "rotation": -191.83171055084767,
                     "clearance1": 42.74643950160657, "clearance2": 180.90110915230505, "count1": 8, "step2": 0.001000001 },
                   { "name": "C3", "type": "triple-wall-internal-corner", "origin": ["=C1.y+1336", 91, 49], "angle": 52.5, "clearance2": 25.5 }] }"#;
    let plan = planned(&job(text));
    let back = import(&plan.program.text).unwrap();
    assert!(
        back.findings.iter().all(|f| f.code != "unsafe-program"),
        "{:?}",
        back.findings
    );
}
