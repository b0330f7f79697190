//! Cycles whose rotation or size follows a result of an earlier one, against LinuxCNC's interpreter, the simulated controls and hand calculations.

use super::cycle;
use super::follows::{near, shown, stops_by, the_machines_measure_what_is_shown};
use crate::common::{Draws, import, interpret, job, law, on_virtual_part, planned, values, with};
use crate::tests::controls::computing;
use proptest::prelude::*;
use touchpath::form::{Level, Value};
use touchpath::job::{Plan, check, convert_units, plan};

/// A hole, a side, and a pocket 100 mm and 20 mm from the hole, rotated like the side.
pub const TURNED: &str = r#"{ "format": 2, "name": "TURNED", "control": { "post": "linuxcnc", "workOffset": 1, "report": "screen" },
  "limits": { "position": 3, "angle": 1.5 },
  "cycles": [
    { "name": "LEFT", "type": "hole", "diameter": 25 },
    { "name": "SIDE", "type": "wall-angle", "origin": [0, -45, -8], "rotation": -90 },
    { "name": "POCKET", "type": "internal-rectangle", "width1": 40, "width2": 30, "origin": ["=LEFT.center.x+100", "=LEFT.center.y+20", 0], "rotation": "=SIDE.rotation+90" }
  ],
  "part": { "offset": [0.2, 0.1, 0], "rotation": 0.7 } }"#;

/// A groove of any width, and a web beside it with the same width.
pub const GROWN: &str = r#"{ "format": 2, "name": "GROWN", "control": { "post": "linuxcnc", "workOffset": 1, "report": "screen" },
  "limits": { "size": 2 }, "overtravel": 3,
  "cycles": [
    { "name": "SLOT", "type": "groove", "width": 30, "origin": [0, 0, 0] },
    { "name": "WEB", "type": "web", "width": "=SLOT.width-4", "origin": [90, 0, 0] }
  ],
  "part": { "sizes": { "SLOT.width": 1.2, "WEB.width": 1.2 } } }"#;

fn on(text: &str, post: &str) -> Value {
    with(&job(text), "control.post", Value::Text(post.to_owned()))
}

fn turned_by(job: &Value, angle: f64) -> Value {
    with(job, "part.rotation", Value::Number(angle))
}

fn holds(plan: &Plan) {
    assert!(
        plan.safety
            .iter()
            .any(|row| row.rule == "place-within-limit" && row.holds == Some(true))
    );
}

/// Every position of the interpreter (it prints four decimals) is that of the drawing, rotated by 0.7° about the hole and shifted with it.
#[test]
fn the_interpreter_turns_a_cycle_with_the_part() {
    let plan = planned(&job(TURNED));
    holds(&plan);
    let ran = interpret(&on_virtual_part(&plan)).unwrap();
    assert_eq!(ran.prints.len(), shown(&plan).len());
    for ((code, printed), (name, value)) in ran.prints.iter().zip(shown(&plan)) {
        assert_eq!(*code, name);
        near(*printed, value, 3e-6, code);
    }
    let (sin, cos) = 0.7f64.to_radians().sin_cos();
    let by_hand = |[x, y, z]: [f64; 3]| [0.2 + x * cos - y * sin, 0.1 + y * cos + x * sin, z];
    let printed = |code: &str| {
        ran.prints
            .iter()
            .find(|(known, _)| known == code)
            .unwrap()
            .1
    };
    let [x, y, _] = by_hand([100.0, 20.0, 0.0]);
    near(
        printed("POCKET.center.x"),
        x,
        2e-6,
        "100 mm and 20 mm beside the hole, turned",
    );
    near(
        printed("POCKET.center.y"),
        y,
        2e-6,
        "100 mm and 20 mm beside the hole, turned",
    );
    near(
        printed("POCKET.width1"),
        40.0,
        2e-6,
        "no wider than it is, since it is touched square",
    );
    let mut compared = 0;
    for step in plan
        .moves
        .iter()
        .filter(|step| step.cycle == 2 && step.step > 0 && step.kind != "touch")
    {
        let wanted = by_hand(step.to);
        let found = ran
            .moves
            .iter()
            .any(|made| (0..3).all(|axis| (made.to[axis] - wanted[axis]).abs() < 6e-5));
        assert!(found, "{wanted:?}");
        compared += 1;
    }
    assert!(compared > 5, "{compared}");
    // A pocket that is touched askew reads wider by the cosine, and by the effect of the ball.
    let still = planned(&job(&TURNED.replace("\"=SIDE.rotation+90\"", "0")));
    let wide = still
        .results
        .iter()
        .find(|row| row.code == "width1")
        .unwrap()
        .value
        .unwrap();
    assert!(wide > 40.002, "{wide}");
}

/// A value along one direction refers to the same point of the part: the middle of a rib, a point of a wall.
#[test]
fn a_rib_and_a_wall_are_read_at_their_place_on_the_turned_part() {
    let (sin, cos) = 0.7f64.to_radians().sin_cos();
    let (x, y) = (
        0.2 + 100.0 * cos - 20.0 * sin,
        0.1 + 20.0 * cos + 100.0 * sin,
    );
    for (cycle, turn, codes) in [
        (r#""type": "web", "width": 30"#, 90.0, &["center.x"][..]),
        (r#""type": "web", "width": 30"#, 180.0, &["center.y"]),
        (
            r#""type": "web", "width": 30"#,
            125.0,
            &["center.x", "center.y"],
        ),
        (r#""type": "surface", "elevation": 0"#, 90.0, &["point.x"]),
        (
            r#""type": "surface", "elevation": 0"#,
            30.0,
            &["point.x", "point.y"],
        ),
    ] {
        let text = TURNED.replace(
            r#""type": "internal-rectangle", "width1": 40, "width2": 30"#,
            cycle,
        );
        let text = text.replace("=SIDE.rotation+90", &format!("=SIDE.rotation+{turn}"));
        let plan = planned(&job(&text));
        holds(&plan);
        let ran = interpret(&on_virtual_part(&plan)).unwrap();
        for code in codes {
            let (_, printed) = ran
                .prints
                .iter()
                .find(|(known, _)| *known == format!("POCKET.{code}"))
                .unwrap();
            near(
                *printed,
                if code.ends_with('x') { x } else { y },
                5e-6,
                &format!("{cycle} {turn} {code}"),
            );
        }
    }
}

/// The touches of a web begin at the found ends of the groove, and results are those of the web.
#[test]
fn the_interpreter_touches_a_web_that_is_as_wide_as_the_groove_was() {
    let plan = planned(&job(GROWN));
    holds(&plan);
    let ran = interpret(&on_virtual_part(&plan)).unwrap();
    for ((code, printed), (name, value)) in ran.prints.iter().zip(shown(&plan)) {
        assert_eq!(*code, name);
        near(*printed, value, 3e-6, code);
    }
    // The web's walls are 0.6 mm farther out, and so are the moves beside them.
    let beside: Vec<f64> = plan
        .moves
        .iter()
        .filter(|step| step.cycle == 1 && step.step > 0)
        .map(|step| step.to[0] - 90.0)
        .collect();
    let outmost = beside.iter().copied().fold(0.0, f64::max);
    let gone = ran
        .moves
        .iter()
        .map(|made| made.to[0] - 90.0)
        .fold(0.0, f64::max);
    near(gone, outmost + 0.6, 2e-6, "half of 1.2 mm farther out");
}

/// Written values equal those in the plan, in `datum` and in the rows `offset`, also if the numbers of a job are not short decimals.
#[test]
fn what_a_turned_cycle_writes_is_listed_by_the_same_name() {
    let cycles = [
        r#""type": "hole", "diameter": 30"#,
        r#""type": "web", "width": 30"#,
        r#""type": "internal-rectangle", "width1": 40, "width2": 30"#,
        r#""type": "surface", "elevation": 0"#,
    ];
    let places = (-200.0..200.0f64, -200.0..200.0f64);
    law(
        60,
        55,
        (places, 0..cycles.len(), 0..4, proptest::bool::ANY),
        |((x, y), cycle, quarter, inch)| {
            let text = format!(
                r#"{{ "format": 2, "control": {{ "post": "linuxcnc", "workOffset": 1 }}, "cycles": [
                {{ "name": "SIDE", "type": "wall-angle", "origin": [{x}, {}, -8], "rotation": -90 }},
                {{ "name": "BORE", {}, "origin": [{x}, {y}, 0], "rotation": "=SIDE.rotation+{}" }} ] }}"#,
                y - 60.0,
                cycles[cycle],
                90 * quarter,
            );
            let given = job(&text);
            let given = if inch {
                convert_units(&given, "inch").unwrap()
            } else {
                given
            };
            let Ok(plan) = plan(&given) else {
                return Ok(false);
            };
            let block = plan
                .program
                .text
                .lines()
                .find(|line| line.starts_with("G10 L20"))
                .unwrap_or("");
            // `X[#<_x>]` keeps the value of X: if the control rotates its axes, both are written.
            let written = ["x", "y", "z"]
                .map(|axis| block.contains(&format!(" {}[#<_{axis}>-", axis.to_ascii_uppercase())));
            prop_assert!(written.contains(&true), "{}", plan.program.text);
            for (axis, written) in ["x", "y", "z"].into_iter().zip(written) {
                let row = plan.datum.iter().find(|row| row.axis == axis).unwrap();
                prop_assert_eq!(row.from.is_some(), written, "{} of {}", axis, text);
                let shown = plan
                    .results
                    .iter()
                    .any(|row| row.code == format!("offset.{axis}"));
                prop_assert_eq!(shown, written, "the row of {} of {}", axis, text);
                if let Some(from) = &row.from {
                    let said = with(&given, &format!("datum.{axis}"), Value::Text(from.clone()));
                    let program = touchpath::job::plan(&said)
                        .map(|plan| plan.program.text)
                        .unwrap_or_default();
                    prop_assert!(program.contains(block), "{} said", from);
                }
            }
            Ok(true)
        },
    );
}

#[test]
fn the_other_controls_turn_and_grow_a_cycle_likewise() {
    for text in [TURNED, GROWN] {
        the_machines_measure_what_is_shown(text);
        for post in computing() {
            holds(&planned(&on(text, post)));
        }
    }
}

/// A part that is rotated too far, or a groove that is too wide: the program stops before the next cycle and writes nothing.
#[test]
fn beyond_the_limit_every_control_stops_before_the_cycle() {
    let wide = |post: &str| with(&on(GROWN, post), "limits.size", Value::Number(1.0));
    for (post, how) in computing()
        .into_iter()
        .flat_map(|post| [(post, 1.6), (post, -1.6)])
    {
        for (job, result) in [
            (turned_by(&on(TURNED, post), how), "SIDE.rotation"),
            (wide(post), "SLOT.width"),
        ] {
            let plan = planned(&job);
            let said = plan
                .findings
                .iter()
                .find(|f| f.code == "place-too-far")
                .unwrap_or_else(|| panic!("{post} {result}"));
            assert_eq!(values(said)[1], result, "{post}");
            stops_by(&plan, post, result);
        }
    }
    // Slightly within the limit everything is measured.
    assert!(
        planned(&turned_by(&job(TURNED), 1.49))
            .triggers
            .iter()
            .all(Option::is_some)
    );
}

/// From a review: words of an angle, cycles after a rotated one, link moves between cycles that move together, long blocks.
#[test]
fn angles_are_said_as_angles() {
    for units in ["mm", "inch"] {
        let job = convert_units(&turned_by(&job(TURNED), 2.0), units).unwrap();
        let plan = planned(&job);
        let said = plan
            .findings
            .iter()
            .find(|f| f.code == "place-too-far")
            .unwrap();
        assert_eq!(
            values(said)[1..],
            ["SIDE.rotation", "-88°", "1.5°", "-90°"],
            "{units}"
        );
    }
}

fn with_cycles(text: &str, more: &str) -> Value {
    job(&text.replacen("}\n  ],", &format!("}}, {more}\n  ],"), 1))
}

#[test]
fn a_cycle_may_follow_one_that_is_turned() {
    let next = r#"{ "name": "H2", "type": "hole", "diameter": 20, "origin": ["=POCKET.center.x+90", "=POCKET.center.y", 0] }"#;
    for limits in [
        r#""position": 2, "angle": 1.5"#,
        r#""position": 1, "angle": 0.7"#,
        r#""position": 3, "angle": 1.5"#,
    ] {
        let text = TURNED
            .replace(r#""position": 3, "angle": 1.5"#, limits)
            .replace("\"rotation\": 0.7", "\"rotation\": 0.1");
        let plan = plan(&with_cycles(&text, next)).unwrap_or_else(|e| panic!("{limits}: {e:?}"));
        holds(&plan);
        let ran = interpret(&on_virtual_part(&plan)).unwrap();
        for ((code, printed), (name, value)) in ran.prints.iter().zip(shown(&plan)) {
            assert_eq!(*code, name);
            near(*printed, value, 3e-6, code);
        }
    }
}

/// Holes 25 mm apart that follow one part: they keep their distance, and share the variables.
#[test]
fn cycles_that_follow_the_same_results_share_their_values() {
    for (post, count) in [
        ("linuxcnc", 12),
        ("sinumerik", 12),
        ("fanuc", 5),
        ("haas", 5),
    ] {
        let holes: Vec<String> = (0..count)
            .map(|i| {
                let x = 100 + 25 * i;
                format!(
                    r#"{{ "name": "H{i}", "type": "surface", "origin": ["=LEFT.center.x+{x}", "=LEFT.center.y", 0], "rotation": "=SIDE.rotation+90" }}"#
                )
            })
            .collect();
        let text = TURNED.replace(r#""position": 3"#, r#""position": 12"#);
        let job = with(
            &with_cycles(&text, &holes.join(", ")),
            "control.post",
            Value::Text(post.to_owned()),
        );
        let plan = plan(&job).unwrap_or_else(|e| {
            panic!(
                "{post}: {:?}",
                e.findings
                    .iter()
                    .filter(|f| f.level == Level::Error)
                    .collect::<Vec<_>>()
            )
        });
        holds(&plan);
        assert!(plan.triggers.iter().all(Option::is_some), "{post}");
    }
}

/// With the longest names LinuxCNC reads every block, in both units; longer blocks are refused, not cut.
#[test]
fn blocks_are_no_longer_than_the_interpreter_reads() {
    let text = TURNED
        .replace("\"POCKET\"", "\"POCKETPOCKET\"")
        .replace("=LEFT.center.x+100", "=LEFT.center.x-100.1234")
        .replace("=LEFT.center.y+20", "=LEFT.center.y-120.5678")
        .replace("=SIDE.rotation+90", "=SIDE.rotation+127.3333")
        .replace(
            "\"name\": \"LEFT\",",
            "\"name\": \"LEFT\", \"origin\": [-223.4567, -198.7654, 0],",
        );
    for units in ["mm", "inch"] {
        let plan = planned(&convert_units(&job(&text), units).unwrap());
        let longest = plan
            .program
            .text
            .lines()
            .filter(|line| !line.starts_with('('))
            .map(str::len)
            .max()
            .unwrap();
        assert!((150..=252).contains(&longest), "{longest}");
    }
    let plan = planned(&turned_by(&job(&text), 0.1));
    let ran = interpret(&on_virtual_part(&plan)).unwrap();
    assert_eq!(ran.prints.len(), shown(&plan).len());
}

/// A wall's deviation counts along the drawing's direction: for a rotated wall it is undefined, and a tolerance of it is refused.
#[test]
fn a_turned_wall_has_no_deviation() {
    let wall = TURNED.replace(
        r#""type": "internal-rectangle", "width1": 40, "width2": 30"#,
        r#""type": "surface", "elevation": 0"#,
    );
    let plan = planned(&job(&wall));
    let row = plan
        .results
        .iter()
        .find(|row| row.code == "deviation")
        .unwrap();
    assert_eq!(row.value, None);
    let judged = wall.replace(
        "\"part\":",
        "\"tolerances\": { \"POCKET.deviation\": { \"tolerance\": \"±0.1\" } }, \"part\":",
    );
    let found = check(&job(&judged));
    assert!(
        found
            .iter()
            .any(|f| f.code == "tolerance-unsupported" && f.level == Level::Error),
        "{found:?}"
    );
}

/// A result that a control states has the uncertainty of the nominal part, and its guard band.
#[test]
fn stated_results_of_a_turned_cycle_have_their_uncertainty() {
    let text = TURNED.replace(
        "\"part\":",
        "\"tolerances\": { \"POCKET.width1\": { \"tolerance\": \"±0.01\" } }, \"part\":",
    );
    let stated = "POCKET.width1=40.0095";
    let rows = touchpath::job::measure(&job(&text), &Value::Text(stated.to_owned()))
        .unwrap()
        .results;
    let row = rows.iter().find(|row| row.code == "width1").unwrap();
    assert_eq!(row.verdict.as_deref(), Some("good within ±"));
    near(
        row.uncertainty.unwrap(),
        0.001 * 2f64.sqrt(),
        1e-6,
        "two touches of 1 µm",
    );
}

#[test]
fn a_limit_that_a_turned_cycle_exceeds_is_said() {
    // 100 mm and 20 mm away: sin 1.5° · 101.98 mm = 2.67 mm.
    let found = |limit: f64| check(&with(&job(TURNED), "limits.position", Value::Number(limit)));
    let said = found(2.6)
        .into_iter()
        .find(|f| f.code == "turn-beyond-limit")
        .unwrap();
    assert_eq!(
        (said.path.as_str(), values(&said)[0].as_str()),
        ("cycles[2].rotation", "2.6695 mm")
    );
    assert!(found(2.7).iter().all(|f| f.code != "turn-beyond-limit"));
}

/// The texts are read back from every header; an angle is the same in other units, a size is not.
#[test]
fn rotations_and_sizes_that_follow_come_back_from_headers_and_units() {
    for post in computing() {
        for text in [TURNED, GROWN] {
            let plan = planned(&on(text, post));
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
    }
    let key = |job: &Value, cycle: usize, key: &str| match job.get("cycles") {
        Some(Value::List(cycles)) => cycles[cycle].get(key).cloned(),
        _ => None,
    };
    let inch = convert_units(&job(TURNED), "inch").unwrap();
    assert_eq!(
        key(&inch, 2, "rotation"),
        Some(Value::Text("=SIDE.rotation+90".to_owned()))
    );
    let (mm, inch) = (planned(&job(TURNED)), planned(&inch));
    for (a, b) in mm.triggers.iter().zip(&inch.triggers) {
        let (a, b) = (a.unwrap(), b.unwrap());
        (0..3).for_each(|axis| near(a[axis], b[axis] * 25.4, 1e-4, "the same contacts"));
    }
    let inch = convert_units(&job(GROWN), "inch").unwrap();
    assert_eq!(
        key(&inch, 1, "width"),
        Some(Value::Text("=SLOT.width-0.15748".to_owned()))
    );
    holds(&planned(&inch));
}

/// Measurements are evaluated with the measured angle, for any virtual part.
#[test]
fn measured_points_are_turned_as_they_say() {
    let real = planned(&turned_by(&job(TURNED), -1.2));
    let points: Vec<Value> = real
        .triggers
        .iter()
        .map(|t| Value::List(t.unwrap().map(Value::Number).to_vec()))
        .collect();
    let rows = touchpath::job::evaluate(&job(TURNED), &Value::List(points)).unwrap();
    for (row, own) in rows.iter().zip(&real.results) {
        assert_eq!(row.code, own.code);
        if let (Some(a), Some(b)) = (row.value, own.value) {
            near(a, b, 1e-5, &row.code);
        }
    }
    assert_eq!(rows.len(), real.results.len());
}

#[test]
fn what_cannot_follow_is_refused_at_its_place() {
    let errors = |text: &str| {
        let errors = check(&job(text))
            .into_iter()
            .filter(|f| f.level == Level::Error);
        errors
            .map(|f| format!("{} {}", f.code, f.path))
            .collect::<Vec<_>>()
    };
    let angle = |given: &str| TURNED.replace("=SIDE.rotation+90", given);
    for given in [
        "=",
        "=SIDE",
        "=LEFT.center.x",
        "=LEFT.diameter",
        "=POCKET.rotation",
        "=SIDE.rotation*2",
        "=SIDE.rotation+9O",
        "=NONE.rotation",
    ] {
        assert_eq!(
            errors(&angle(given)),
            ["place-of-result cycles[2].rotation"],
            "{given}"
        );
    }
    assert_eq!(
        errors(&angle("SIDE.rotation")),
        ["wrong-type cycles[2].rotation"]
    );
    let size = |given: &str| GROWN.replace("=SLOT.width-4", given);
    for given in [
        "=",
        "=SLOT.center.x",
        "=WEB.width",
        "=SLOT.width/2",
        "=NONE.width",
        "=SLOT.width-4)\\nG0 Z-99",
    ] {
        assert_eq!(
            errors(&size(given)),
            ["place-of-result cycles[1].width"],
            "{given}"
        );
    }
    assert!(errors(&size("=slot.Width - 4,5")).is_empty());
    assert_eq!(
        errors(&TURNED.replace("\"angle\": 1.5", "\"angle\": null")),
        ["place-of-result cycles[2].rotation"]
    );
    assert_eq!(
        errors(&GROWN.replace("\"size\": 2", "\"size\": null")),
        ["place-of-result cycles[1].width"]
    );
    // A web that the smallest groove would make zero wide.
    assert_eq!(
        errors(&size("=SLOT.width-28")),
        ["place-of-result cycles[1].width"]
    );
    // 1411 has its own parameters for rotation.
    let own = TURNED.replace(
        r#""type": "internal-rectangle", "width1": 40, "width2": 30"#,
        r#""type": "probing-two-circles""#,
    );
    assert!(!errors(&own).is_empty());
    let both = TURNED.replace("\"width1\": 40", "\"width1\": \"=LEFT.diameter+15\"");
    assert_eq!(errors(&both), ["place-of-result cycles[2].width1"]);
    for (text, path) in [(TURNED, "cycles[2].rotation"), (GROWN, "cycles[1].width")] {
        let grbl = text
            .replace("linuxcnc", "grbl")
            .replace("\"workOffset\": 1, ", "");
        assert!(
            errors(&grbl).contains(&format!("set-up-unsupported {path}")),
            "{:?}",
            errors(&grbl)
        );
    }
    // Native cycles probe along the axes.
    let turned = r#"{ "format": 2, "control": { "post": "haas", "form": "cycle" }, "limits": { "angle": 1 },
      "cycles": [
        { "name": "A", "type": "hole" }, { "name": "B", "type": "hole", "origin": [80, 0, 0] },
        { "name": "POCKET", "type": "internal-rectangle", "origin": [0, 150, 0], "rotation": "=ROW.rotation" } ],
      "relations": [{ "name": "ROW", "type": "line", "of": ["A", "B"] }] }"#;
    assert_eq!(errors(turned), ["set-up-unsupported cycles[2].rotation"]);
    let own = GROWN.replace("\"linuxcnc\"", "\"okuma\", \"form\": \"cycle\"");
    assert!(
        errors(&own).contains(&"set-up-unsupported cycles[1].width".to_owned()),
        "{:?}",
        errors(&own)
    );
    // A job with one cycle has no earlier one.
    let alone = r#"{ "format": 1, "cycle": { "type": "web", "width": "=SLOT.width" } }"#;
    assert_eq!(errors(alone), ["wrong-type cycle.width"]);
}

/// In every plane, at any limit, with any cycle that measures positions and sizes: on rotated parts the interpreter's results are correct.
#[test]
fn random_cycles_follow_an_angle_on_parts_that_are_turned() {
    let mut draws = Draws(78);
    let mut tried = 0;
    for round in 0..24 {
        let key = [
            "hole",
            "boss",
            "internal-rectangle",
            "external-rectangle",
            "web",
            "groove",
            "surface",
            "double-wall-internal-corner",
        ][round % 8];
        let plane = ["G17", "G18", "G19"][draws.below(3)];
        let limit = draws.of(0.3, 4.0);
        let cycle = with(&cycle(key, 0.0), "name", Value::Text("LAST".to_owned()));
        let text = format!(
            r#"{{ "format": 2, "plane": "{plane}", "control": {{ "post": "linuxcnc" }}, "overtravel": 8, "limits": {{ "position": 9, "angle": {limit:.3} }},
            "part": {{ "offset": [{:.4}, {:.4}, {:.4}], "rotation": {:.4} }}, "cycles": [] }}"#,
            draws.of(-0.4, 0.4),
            draws.of(-0.4, 0.4),
            draws.of(-0.4, 0.4),
            0.97 * draws.of(-limit, limit).clamp(-2.5, 2.5)
        );
        let axes = match plane {
            "G17" => ["=BASE.center.x+90", "=BASE.center.y+40", "5"],
            "G18" => ["=BASE.center.y+40", "5", "=BASE.center.x+90"],
            _ => ["5", "=BASE.center.x+90", "=BASE.center.y+40"],
        };
        let at = axes.map(|text| {
            text.parse()
                .map_or_else(|_| Value::Text(text.to_owned()), Value::Number)
        });
        let still =
            axes.map(|text| Value::Number(text.rsplit('+').next().unwrap().parse().unwrap()));
        let at = if draws.next() < 0.6 { at } else { still };
        let nominal = draws.of(-170.0, 170.0).round();
        let cycle = with(&cycle, "origin", Value::List(at.to_vec()));
        let cycle = with(
            &cycle,
            "rotation",
            Value::Text(format!("=SIDE.rotation{:+}", nominal)),
        );
        let base = with(
            &super::cycle("hole", 0.0),
            "name",
            Value::Text("BASE".to_owned()),
        );
        let side =
            job(r#"{ "name": "SIDE", "type": "wall-angle", "rotation": 25, "distance": 40 }"#);
        let w = axes.iter().position(|text| *text == "5").unwrap();
        let mut low = [
            Value::Number(-60.0),
            Value::Number(-60.0),
            Value::Number(-60.0),
        ];
        low[w] = Value::Number(0.0);
        let side = with(&side, "origin", Value::List(low.to_vec()));
        let whole = with(&job(&text), "cycles", Value::List(vec![base, side, cycle]));
        let plan = match plan(&whole) {
            Ok(plan) => plan,
            Err(e) => panic!("round {round} {key} {plane}: {e:?}"),
        };
        if plan
            .findings
            .iter()
            .any(|f| ["no-contact", "collision", "place-too-far"].contains(&f.code.as_str()))
        {
            continue;
        }
        holds(&plan);
        tried += 1;
        let ran =
            interpret(&on_virtual_part(&plan)).unwrap_or_else(|e| panic!("round {round}: {e}"));
        for ((code, printed), (name, value)) in ran.prints.iter().zip(shown(&plan)) {
            assert_eq!(*code, name);
            near(*printed, value, 3e-6, code);
        }
        for row in plan
            .results
            .iter()
            .filter(|row| row.cycle == 2 && row.truth.is_some() && row.value.is_some())
        {
            near(
                row.value.unwrap(),
                row.truth.unwrap(),
                2e-5,
                &format!("round {round} {key} {plane} {}", row.code),
            );
        }
    }
    assert!(tried > 15, "{tried}");
}
