//! Cycles that follow a relation of earlier ones: it is computed before them.

use super::follows::{near, shown, stops_by, the_machines_measure_what_is_shown};
use crate::common::{import, interpret, job, on_virtual_part, planned, values, with};
use crate::tests::controls::{calling, computing};
use touchpath::form::{Level, Value};
use touchpath::job::{check, convert_units, evaluate};

/// Two holes, and a slot 40 mm from the midpoint between them, square to the line through both. The surface is between the operands of the relations and the
/// cycle that follows them; the last relation uses one that is computed early and the last cycle.
pub const PLATE: &str = r#"{ "format": 2, "name": "PLATE", "control": { "post": "linuxcnc", "workOffset": 1, "report": "screen" },
  "limits": { "position": 3, "angle": 1.5 },
  "cycles": [
    { "name": "LEFT", "type": "hole", "diameter": 20, "origin": [-60, 10, 0] },
    { "name": "RIGHT", "type": "hole", "diameter": 20, "origin": [60, 10, 0] },
    { "name": "TOP", "type": "surface", "origin": [-20, 0, 0] },
    { "name": "SLOT", "type": "groove", "width": 30, "origin": ["=MID.x", "=MID.y+40", "=TOP.z"], "rotation": "=ROW.rotation+90" },
    { "name": "POST", "type": "boss", "diameter": 24, "origin": [0, -60, "=TOP.z"] }
  ],
  "relations": [
    { "name": "ROW", "type": "line", "of": ["LEFT", "RIGHT"] },
    { "name": "MID", "type": "center", "of": ["LEFT", "RIGHT"] },
    { "name": "OFF", "type": "line", "of": ["MID", "POST"] }
  ],
  "datum": { "x": "MID.center.x", "y": "MID.center.y", "z": "TOP.point.z", "rotation": "ROW.rotation" },
  "part": { "offset": [0.2, 0.1, 0.3], "rotation": 0.7 } }"#;

/// Four holes on a circle, and a stud at their centre that is smaller than the circle by 60 mm; its height is the mean of two positions of the top.
const RING: &str = r#"{ "format": 2, "name": "RING", "control": { "post": "linuxcnc", "workOffset": null, "report": "screen" },
  "limits": { "position": 2, "size": 2 },
  "cycles": [
    { "name": "A", "type": "surface", "origin": [-80, 0, 0] },
    { "name": "B", "type": "surface", "origin": [80, 0, 0] },
    { "name": "H1", "type": "hole", "diameter": 12, "origin": [45, 0, 0] },
    { "name": "H2", "type": "hole", "diameter": 12, "origin": [0, 45, 0] },
    { "name": "H3", "type": "hole", "diameter": 12, "origin": [-45, 0, 0] },
    { "name": "H4", "type": "hole", "diameter": 12, "origin": [0, -45, 0] },
    { "name": "STUD", "type": "boss", "diameter": "=CIRCLE.diameter-60", "origin": ["=CIRCLE.x", "=CIRCLE.y", "=FACE.z"] }
  ],
  "relations": [
    { "name": "FACE", "type": "mean", "of": ["A.point.z", "B.point.z"] },
    { "name": "CIRCLE", "type": "pitch-circle", "of": ["H1", "H2", "H3", "H4"] }
  ],
  "part": { "offset": [0.4, -0.3, 0.6] } }"#;

fn on(text: &str, post: &str) -> Value {
    with(&job(text), "control.post", Value::Text(post.to_owned()))
}

/// The interpreter prints the results of the plan; returns one of them.
fn printed(text: &str) -> impl Fn(&str) -> f64 + use<> {
    let plan = planned(&job(text));
    let rule = plan
        .safety
        .iter()
        .find(|row| row.rule == "place-within-limit")
        .unwrap();
    assert_eq!(rule.holds, Some(true));
    let ran = interpret(&on_virtual_part(&plan)).unwrap();
    let printed = move |code: &str| {
        ran.prints
            .iter()
            .find(|(known, _)| known == code)
            .unwrap_or_else(|| panic!("{code}"))
            .1
    };
    for (name, value) in shown(&plan) {
        near(printed(&name), value, 5e-6, &name);
    }
    printed
}

/// The slot is 40 mm from the midpoint of the holes *on the rotated part*: the part is rotated about the origin, then shifted.
#[test]
fn the_interpreter_turns_a_slot_with_the_line_through_two_holes() {
    let printed = printed(PLATE);
    let (sin, cos) = 0.7f64.to_radians().sin_cos();
    let by_hand = |x: f64, y: f64| [0.2 + x * cos - y * sin, 0.1 + y * cos + x * sin];
    near(
        printed("ROW.rotation"),
        0.7,
        2e-6,
        "the line turns with the part",
    );
    let [_, y] = by_hand(0.0, 50.0);
    near(
        printed("SLOT.center.y"),
        y,
        3e-6,
        "where the slot lies on the part",
    );
    near(printed("SLOT.width"), 30.0, 2e-6, "touched square");
    near(
        printed("OFF.distance"),
        70.0,
        3e-6,
        "from the middle to the post",
    );
    let plan = planned(&job(PLATE));
    let ran = interpret(&on_virtual_part(&plan)).unwrap();
    // The slot's moves are rotated about the midpoint of the holes, by the rotation of the line.
    let [mx, my] = by_hand(0.0, 10.0);
    let own = plan
        .moves
        .iter()
        .filter(|step| step.cycle == 3 && step.step > 0 && step.kind != "touch");
    let mut compared = 0;
    for step in own {
        let [x, y, z] = step.to;
        let wanted = [
            mx + x * cos - (y - 10.0) * sin,
            my + (y - 10.0) * cos + x * sin,
            z + 0.3,
        ];
        let found = ran
            .moves
            .iter()
            .any(|made| (0..3).all(|axis| (made.to[axis] - wanted[axis]).abs() < 6e-5));
        assert!(found, "{wanted:?}");
        compared += 1;
    }
    assert!(compared > 4, "{compared}");
}

#[test]
fn the_interpreter_touches_a_stud_in_the_middle_of_a_ring_of_holes() {
    let printed = printed(RING);
    near(printed("FACE.mean"), 0.6, 2e-6, "the mean of both places");
    near(
        printed("CIRCLE.center.x"),
        0.4,
        2e-6,
        "the middle of the holes",
    );
    near(
        printed("STUD.center.y"),
        -0.3,
        2e-6,
        "the stud is there too",
    );
    near(printed("STUD.diameter"), 30.0, 2e-6, "90 mm less 60 mm");
    let text = RING.replace(
        "\"offset\": [0.4, -0.3, 0.6]",
        "\"offset\": [0.4, -0.3, 0.6], \"sizes\": { \"STUD.diameter\": 0.8 }",
    );
    near(
        self::printed(&text)("STUD.diameter"),
        30.8,
        2e-6,
        "not by the holes but by its own touches",
    );
}

/// The mean of two heights is written as Z: afterwards the position between them reads its nominal height.
#[test]
fn a_mean_of_heights_is_written_as_z() {
    let text = RING.replace("\"workOffset\": null", "\"workOffset\": 1");
    let text = text.replace(
        "\"part\"",
        "\"datum\": { \"x\": \"CIRCLE.center.x\", \"y\": \"CIRCLE.center.y\", \"z\": \"FACE.mean\" },\n  \"part\"",
    );
    let plan = planned(&job(&text));
    let ran = interpret(&on_virtual_part(&plan)).unwrap();
    for (written, wanted) in ran.written.unwrap().1.into_iter().zip([0.4, -0.3, 0.6]) {
        near(written, wanted, 2e-6, "the origin moves with the part");
    }
    // A mean of other lengths is no height.
    let errors = check(&job(&text
        .replace(
            "\"A.point.z\", \"B.point.z\"",
            "\"H1.center.x\", \"H3.center.x\"",
        )
        .replace("=FACE.z", "=A.z")));
    assert!(
        errors
            .iter()
            .any(|f| f.code == "datum-unknown" && f.path == "datum.z"),
        "{errors:?}"
    );
}

#[test]
fn the_other_controls_compute_a_relation_before_what_follows_it() {
    the_machines_measure_what_is_shown(PLATE);
    // A Fanuc has few variables: one hole and one surface less.
    let fewer = RING
        .replace(r#", "H3", "H4"]"#, r#", "H3"]"#)
        .replace("=FACE.z", "=A.z");
    let without = |text: &str, from: &str| {
        text.lines()
            .filter(|line| !line.contains(from))
            .map(|line| format!("{line}\n"))
            .collect::<String>()
    };
    let fewer = ["\"B\", \"type\"", "\"H4\", \"type\"", "\"FACE\""]
        .iter()
        .fold(fewer, |text, from| without(&text, from));
    the_machines_measure_what_is_shown(&fewer);
}

/// A relation that deviates by more than its limit: each control stops before the cycle that follows it, and writes nothing.
#[test]
fn beyond_the_limit_every_control_stops_before_the_cycle() {
    for (post, how) in computing()
        .into_iter()
        .flat_map(|post| [(post, 1.6), (post, -1.6)])
    {
        let plan = planned(&with(&on(PLATE, post), "part.rotation", Value::Number(how)));
        let said = plan
            .findings
            .iter()
            .find(|f| f.code == "place-too-far")
            .unwrap_or_else(|| panic!("{post}"));
        assert_eq!(
            values(said)[..2],
            ["SLOT", "ROW.rotation"],
            "{post}: before the cycle, by the result"
        );
        stops_by(&plan, post, "ROW.rotation");
    }
}

/// Headers and units keep the followed results; the points of a part give its rows, in any order in which the program computes.
#[test]
fn what_follows_a_relation_comes_back() {
    for post in computing() {
        let plan = planned(&on(PLATE, post));
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
    let inch = convert_units(&job(PLATE), "inch").unwrap();
    let Some(Value::List(cycles)) = inch.get("cycles") else {
        unreachable!()
    };
    let Some(Value::List(origin)) = cycles[3].get("origin") else {
        unreachable!()
    };
    assert_eq!(origin[1], Value::Text("=MID.y+1.574803".to_owned()));
    let real = planned(&job(PLATE));
    let names: Vec<&String> = real.cycles.iter().chain(&real.relations).collect();
    assert_eq!(
        names[real
            .results
            .iter()
            .find(|row| row.code == "distance")
            .unwrap()
            .cycle],
        "ROW"
    );
    let points = real
        .triggers
        .iter()
        .map(|t| Value::List(t.unwrap().map(Value::Number).to_vec()))
        .collect();
    let logged: String = interpret(&on_virtual_part(&real))
        .unwrap()
        .prints
        .iter()
        .map(|(code, x)| format!("{code}={x}\n"))
        .collect();
    for given in [Value::List(points), Value::Text(logged)] {
        let rows = evaluate(&job(PLATE), &given).unwrap();
        assert_eq!(rows.len(), real.results.len());
        for (row, own) in rows.iter().zip(&real.results) {
            assert_eq!((row.cycle, &row.code), (own.cycle, &own.code));
            if let (Some(a), Some(b)) = (row.value, own.value) {
                near(a, b, 1e-5, &row.code);
            }
        }
    }
    // The true value of a relation and its uncertainty do not depend on when it is computed.
    let late = PLATE
        .replace("=MID.x", "0")
        .replace("\"=MID.y+40\"", "50")
        .replace("\"=ROW.rotation+90\"", "90");
    let late = planned(&job(&late.replace("\"0\"", "0")));
    for own in real.results.iter().filter(|row| row.cycle > 4) {
        let other = late
            .results
            .iter()
            .find(|row| (row.cycle, &row.code) == (own.cycle, &own.code))
            .unwrap();
        assert_eq!(own.truth, other.truth, "{}", own.code);
        near(
            own.uncertainty.unwrap(),
            other.uncertainty.unwrap(),
            1e-6,
            &own.code,
        );
        assert_eq!((own.value, &own.verdict), (other.value, &other.verdict));
    }
}

#[test]
fn a_relation_that_is_not_known_in_time_is_refused_at_its_place() {
    let errors = |text: &str| {
        let errors = check(&job(text))
            .into_iter()
            .filter(|f| f.level == Level::Error);
        errors
            .map(|f| (format!("{} {}", f.code, f.path), values(&f)))
            .collect::<Vec<_>>()
    };
    let one = |text: &str, path: &str, names: &[&str]| {
        let found = errors(text);
        assert_eq!(
            found.iter().map(|(of, _)| of.as_str()).collect::<Vec<_>>(),
            [format!("place-of-result {path}")],
            "{found:?}"
        );
        let said = |name: &&str| {
            found[0]
                .1
                .iter()
                .any(|list| list.split(", ").any(|known| known == *name))
        };
        assert!(names.iter().all(said), "{names:?}: {found:?}");
    };
    let rotation = "cycles[3].rotation";
    let turned = |given: &str| PLATE.replace("=ROW.rotation+90", given);
    one(
        &turned("=ROW.distance"),
        rotation,
        &["ROW.distance", "ROW.rotation"],
    );
    // POST is measured later; LEFT, RIGHT and MID would be valid.
    one(
        &turned("=OFF.rotation"),
        rotation,
        &["OFF", "POST", "LEFT", "RIGHT", "MID"],
    );
    one(
        &turned("=NONE.rotation"),
        rotation,
        &["NONE.rotation", "ROW.rotation"],
    );
    one(
        &PLATE.replace("\"=MID.x\"", "\"=MID.y\""),
        "cycles[3].origin[0]",
        &["MID.y"],
    );
    one(
        &PLATE.replace("\"=MID.x\"", "\"=ROW.x\""),
        "cycles[3].origin[0]",
        &["ROW.x", "MID.center.x"],
    );
    // A relation with an error is reported where it is followed, and at its own path.
    let both = |text: &str, path: &str, own: &str| {
        let found: Vec<String> = errors(text).into_iter().map(|(of, _)| of).collect();
        assert_eq!(found, [format!("place-of-result {path}"), own.to_owned()]);
    };
    both(
        &PLATE.replace(
            "\"type\": \"line\", \"of\": [\"LEFT\", \"RIGHT\"]",
            "\"type\": \"lime\", \"of\": [\"LEFT\", \"RIGHT\"]",
        ),
        rotation,
        "unknown-value relations[0].type",
    );
    one(
        &RING.replace(
            "\"A.point.z\", \"B.point.z\"",
            "\"A.point.z\", \"H1.diameter\"",
        ),
        "cycles[6].origin[2]",
        &["FACE.z"],
    );
    assert!(errors(PLATE).is_empty());
    let grbl = PLATE
        .replace("linuxcnc", "grbl")
        .replace("\"workOffset\": 1, ", "");
    assert!(
        errors(&grbl)
            .iter()
            .any(|(of, _)| of == "set-up-unsupported cycles[3].rotation"),
        "{:?}",
        errors(&grbl)
    );
}

/// Whether the program of a control computes between native cycles.
fn computes_between(post: &str) -> bool {
    let own = touchpath::control::find(post).unwrap().own.unwrap();
    own.several.computes
}

/// Two bores of native cycles and the line through them.
fn of_own_cycles(post: &str, more: &str) -> Value {
    let text = format!(
        r#"{{ "format": 2, "control": {{ "post": "{post}", "form": "cycle" }},
        "cycles": [
          {{ "name": "LEFT", "type": "hole", "diameter": 20, "origin": [-60, 0, 0] }},
          {{ "name": "RIGHT", "type": "hole", "diameter": 20, "origin": [60, 0, 0] }} ],
        "relations": [
          {{ "name": "ROW", "type": "line", "of": ["LEFT", "RIGHT"] }},
          {{ "name": "STEP", "type": "difference", "of": ["LEFT.diameter", "RIGHT.diameter"] }} ],
        "part": {{ "offset": [0.5, -0.4, 0], "rotation": 0.7 }} {more} }}"#
    );
    job(&text)
}

/// Native cycles store their results; not every program computes with them. The relations follow from the values of the variables, typed as the control
/// displays them: by hand 120.05 mm and -0.2 mm apart, atan2(0.6, 120.05) = 0.28636°.
#[test]
fn relations_follow_from_what_own_cycles_keep() {
    for post in calling() {
        let plan = planned(&of_own_cycles(
            post,
            r#", "tolerances": { "ROW.distance": { "tolerance": "±0.1" } }"#,
        ));
        let computes = computes_between(post);
        let reported = plan
            .findings
            .iter()
            .any(|f| f.code == "relation-not-computed" && f.path == "relations");
        assert_eq!(reported, !computes, "{post}");
        let row = |code: &str| {
            plan.results
                .iter()
                .find(|row| row.cycle == 2 && row.code == code)
                .unwrap()
        };
        near(
            row("rotation").value.unwrap(),
            0.7,
            1e-9,
            "the part is turned by that",
        );
        near(
            row("distance").value.unwrap(),
            120.0,
            1e-6,
            "and is as large as drawn",
        );
        assert_eq!(
            (
                row("distance").verdict.as_deref(),
                row("distance").stored.is_some()
            ),
            (Some("good"), computes),
            "{post}"
        );
        let typed = [-60.02, 0.1, 20.0, 60.03, 0.7, 20.2];
        let own = plan
            .results
            .iter()
            .filter(|row| row.cycle < 2)
            .filter_map(|row| row.stored.as_deref());
        let said: Vec<String> = own
            .zip(typed)
            .map(|(variable, value)| format!("{variable} = {value}\n"))
            .collect();
        assert_eq!(said.len(), 6, "{post}");
        let of = |said: &[String]| {
            let job = of_own_cycles(
                post,
                r#", "tolerances": { "ROW.distance": { "tolerance": "±0.02" } }"#,
            );
            touchpath::job::measure(&job, &Value::Text(said.concat())).unwrap()
        };
        let measured = of(&said);
        let row = |code: &str| {
            measured
                .results
                .iter()
                .find(|row| row.cycle >= 2 && row.code == code)
                .unwrap()
        };
        near(
            row("distance").value.unwrap(),
            120.05f64.hypot(0.6),
            1e-9,
            post,
        );
        near(row("rotation").value.unwrap(), 0.286_357, 1e-5, post);
        near(row("difference").value.unwrap(), -0.2, 1e-9, post);
        near(
            row("distance").deviation.unwrap(),
            120.05f64.hypot(0.6) - 120.0,
            1e-9,
            post,
        );
        assert_eq!(row("distance").verdict.as_deref(), Some("out"), "{post}");
        assert!(
            row("distance").uncertainty.is_some_and(|own| own > 1e-4),
            "{post}"
        );
        assert!(
            measured.findings.iter().all(|f| f.code != "result-missing"),
            "{post}: {:?}",
            measured.findings
        );
        // A value that was not typed is unknown, and so are its consequences; nothing is guessed.
        let fewer = of(&said[1..]);
        let row = |code: &str| {
            fewer
                .results
                .iter()
                .find(|row| row.cycle >= 2 && row.code == code)
                .unwrap()
        };
        assert_eq!(
            (row("distance").value, row("distance").verdict.as_deref()),
            (None, None),
            "{post}"
        );
        near(row("difference").value.unwrap(), -0.2, 1e-9, post);
        let lacks = fewer
            .findings
            .iter()
            .find(|f| f.code == "result-missing")
            .unwrap();
        assert_eq!(
            values(lacks),
            ["LEFT.center.x, ROW.distance, ROW.rotation"],
            "{post}"
        );
    }
}

/// A comment stays one for any content; in a set-up with one cycle the variables count as well, and a residual is computed with the rest.
#[test]
fn what_a_text_of_variables_says_and_what_it_does_not() {
    let moves = job(
        r#"{ "format": 1, "control": { "post": "linuxcnc" }, "cycle": { "type": "hole", "diameter": 25 } }"#,
    );
    let of = |job: &Value, text: &str| {
        touchpath::job::measure(job, &Value::Text(text.to_owned())).unwrap()
    };
    for comment in [
        "# diameter=24.9",
        "# nominal diameter = 25",
        "# diameter = about 25",
        "#138 = 3",
    ] {
        let found = of(&moves, &format!("{comment}\ncenter.x=0\ncenter.y=0\n"));
        assert_eq!(
            found
                .results
                .iter()
                .find(|row| row.code == "diameter")
                .unwrap()
                .value,
            None,
            "{comment}"
        );
    }
    for (post, text) in [
        ("heidenhain", "Q151=0.5\nQ152=-0.4\nQ153=20"),
        ("fanuc", "# of today\n#135 = 0.5\n#136 = -0.4\n#138 = 20"),
    ] {
        let one = job(&format!(
            r#"{{ "format": 2, "control": {{ "post": "{post}", "form": "cycle" }},
            "cycles": [{{ "name": "P", "type": "hole", "diameter": 20 }}],
            "relations": [{{ "name": "D", "type": "difference", "of": ["P.center.x", "P.center.y"] }}, {{ "name": "E", "type": "mean", "of": ["center.x", "center.y"] }}] }}"#
        ));
        let found = of(&one, text);
        let value = |code: &str| {
            found
                .results
                .iter()
                .find(|row| row.code == code)
                .unwrap()
                .value
                .unwrap()
        };
        near(value("difference"), 0.9, 1e-12, post);
        near(value("mean"), 0.05, 1e-12, post);
    }
    // Three holes are on their circle; the fourth of four, 0.4 mm farther out along X, deviates from the least-squares circle by 0.1 mm, and so do the others.
    let ring = RING
        .replace(
            "\"post\": \"linuxcnc\"",
            "\"post\": \"heidenhain\", \"form\": \"cycle\"",
        )
        .replace("\"report\": \"screen\"", "\"report\": \"none\"");
    let ring = ring
        .replace("\"=CIRCLE.diameter-60\"", "30")
        .replace("[\"=CIRCLE.x\", \"=CIRCLE.y\", \"=FACE.z\"]", "[0, 0, 0]");
    let plan = planned(&job(&ring));
    let holes = [[45.4, 0.0], [0.0, 45.0], [-45.0, 0.0], [0.0, -45.0]];
    // The relations are not entered: they follow.
    let of_cycles = plan
        .results
        .iter()
        .filter(|row| row.cycle < plan.cycles.len());
    let said =
        of_cycles.filter_map(|row| Some((row.cycle, row.code.as_str(), row.stored.as_deref()?)));
    let said = said.map(|(cycle, code, variable)| match (cycle, code) {
        (2..=5, "center.x") => format!("{variable}={}\n", holes[cycle - 2][0]),
        (2..=5, "center.y") => format!("{variable}={}\n", holes[cycle - 2][1]),
        _ => format!(
            "{variable}={}\n",
            plan.results
                .iter()
                .find(|row| row.stored.as_deref() == Some(variable))
                .unwrap()
                .nominal
                .unwrap()
        ),
    });
    let found = of(&job(&ring), &said.collect::<String>());
    let residual = found
        .results
        .iter()
        .find(|row| row.code == "residual" && row.cycle > 6)
        .unwrap();
    near(residual.value.unwrap(), 0.1, 1e-3, "each is 0.1 off");
    // A value that such a control does not store, like the abscissa of a surface, is not required.
    assert!(
        found.findings.iter().all(|f| f.code != "result-missing"),
        "{:?}",
        found.findings
    );
}

/// Relations of relations, each of the two before it: as fast as one.
#[test]
fn deep_relations_are_added_once() {
    let relation = |n: usize| match n {
        0 => r#"{ "name": "R0", "type": "center", "of": ["A", "B"] }"#.to_owned(),
        1 => r#"{ "name": "R1", "type": "center", "of": ["R0", "A"] }"#.to_owned(),
        n => format!(
            r#"{{ "name": "R{n}", "type": "center", "of": ["R{}", "R{}"] }}"#,
            n - 1,
            n - 2
        ),
    };
    let relations: Vec<String> = (0..99).map(relation).collect();
    let text = format!(
        r#"{{ "format": 2, "control": {{ "post": "linuxcnc" }}, "limits": {{ "position": 2 }},
        "cycles": [{{ "name": "A", "type": "hole", "origin": [-60, 0, 0] }}, {{ "name": "B", "type": "hole", "origin": [60, 0, 0] }},
            {{ "name": "C", "type": "hole", "origin": ["=R98.x", 200, 0] }}],
        "relations": [{}] }}"#,
        relations.join(", ")
    );
    let plan = planned(&job(&text));
    // A = -60, B = 60: R0 = 0, R1 = -30, and the mean of two before it converges to (R0 + 2 R1) / 3.
    let last = plan
        .results
        .iter()
        .find(|row| row.cycle == 3 + 98 && row.code == "center.x")
        .unwrap();
    near(last.value.unwrap(), -20.0, 1e-9, "where such a row ends");
    // The cycle follows it, within its limit.
    assert!(
        plan.program.text.contains("X[-20+#<c_shift_x>]"),
        "{}",
        plan.program.text
    );
    assert!(
        plan.safety
            .iter()
            .any(|row| row.rule == "place-within-limit" && row.holds == Some(true))
    );
    let printed = printed(&text.replace(
        "\"cycles\"",
        "\"part\": { \"offset\": [0.4, -0.3, 0] }, \"cycles\"",
    ));
    near(printed("R98.center.x"), -19.6, 2e-6, "moved with the part");
    near(printed("C.center.x"), -19.6, 2e-6, "so is the hole");
}

/// A TNC shows its parameters with a decimal comma by default.
#[test]
fn values_are_read_with_a_decimal_comma() {
    let job = of_own_cycles("heidenhain", "");
    let of = |text: &str| touchpath::job::measure(&job, &Value::Text(text.to_owned()));
    let shown = "Q1600 = -60,02\nQ1601 +0,1\nQ1602=20\nQ151 = 60,03 Q152 = + 0,7\nQ153=20,2\n";
    let rows = of(shown).unwrap().results;
    let value = |cycle: usize, code: &str| {
        rows.iter()
            .find(|row| row.cycle == cycle && row.code == code)
            .unwrap()
            .value
            .unwrap()
    };
    near(value(0, "center.x"), -60.02, 1e-12, "-60,02");
    near(value(1, "center.y"), 0.7, 1e-12, "+ 0,7");
    near(value(2, "distance"), 120.05f64.hypot(0.6), 1e-9, "of them");
    for wrong in [
        "Q1602 = 20,0,1",
        "Q1602 = 20.0,1",
        "Q1602 = 20,",
        "Q1602 = ,5",
        "Q1602 = 2e1,5",
        "Q1602 = 20,1.5",
    ] {
        let refused = of(wrong).unwrap_err();
        assert!(
            refused.findings.iter().any(|f| f.code == "not-a-number"),
            "{wrong}: {refused:?}"
        );
    }
}

/// Such a program writes nothing from a relation and corrects no tool; it stops for one only if it computes.
#[test]
fn own_cycles_do_nothing_by_a_relation() {
    let errors = |post: &str, more: &str| {
        let errors = check(&of_own_cycles(post, more))
            .into_iter()
            .filter(|f| f.level == Level::Error);
        errors
            .map(|f| format!("{} {}", f.code, f.path))
            .collect::<Vec<_>>()
    };
    for post in calling() {
        let stop =
            r#", "tolerances": { "ROW.distance": { "tolerance": "±0.1", "action": "stop" } }"#;
        // A program that computes between the cycles stops.
        let computes = computes_between(post);
        let refused: &[&str] = match computes {
            true => &[],
            false => &["tolerance-unsupported tolerances.ROW.distance.action"],
        };
        assert_eq!(errors(post, stop), refused, "{post}");
        let wear =
            r#", "tolerances": { "ROW.distance": { "tolerance": "±0.1", "wear": { "tool": 3 } } }"#;
        assert_eq!(
            errors(post, wear),
            ["wear-unsupported tolerances.ROW.distance.wear"],
            "{post}"
        );
        let offset = with(
            &of_own_cycles(post, ""),
            "control.workOffset",
            Value::Number(1.0),
        );
        let middle = r#"[{ "name": "MID", "type": "center", "of": ["LEFT", "RIGHT"] }]"#;
        let written = with(
            &with(&offset, "relations", job(middle)),
            "datum",
            job(r#"{ "x": "MID.center.x", "y": "MID.center.y" }"#),
        );
        let errors: Vec<_> = check(&written)
            .into_iter()
            .filter(|f| f.level == Level::Error)
            .collect();
        assert!(
            errors
                .iter()
                .any(|f| f.code == "datum-unknown" && f.path == "datum.x"),
            "{post}: {errors:?}"
        );
        // Nor is it proposed.
        let measured = with(&written, "datum", Value::Null);
        let proposed = planned(&with(&measured, "control.workOffset", Value::Null)).datum;
        assert_eq!(
            proposed[0].choices,
            ["LEFT.center.x", "RIGHT.center.x"],
            "{post}"
        );
    }
}

/// A line of 330 mm from a hole to an acute corner, with a limit of 2 degrees for its follower: the corner moves by 11 mm then, and its walls rotate. The proof
/// finds the positions of the touches, and the program stops.
#[test]
fn a_long_line_from_an_acute_corner_is_followed() {
    for (post, corner) in [
        ("linuxcnc", "internal"),
        ("fanuc", "external"),
        ("haas", "internal"),
        ("sinumerik", "external"),
    ] {
        for rotation in [-179, -178, -90, 0] {
            let job = job(&format!(
                r#"{{ "format": 2, "control": {{ "post": "{post}" }}, "limits": {{ "position": 2, "angle": 2 }}, "cycles": [
                     {{ "name": "A", "type": "hole", "diameter": 20, "origin": [-164, -83, 0] }},
                     {{ "name": "B", "type": "double-wall-{corner}-corner", "angle": 64, "origin": [164, -78, 0], "rotation": {rotation} }},
                     {{ "name": "W", "type": "web", "width": 30, "rotation": "=ROW.rotation+90" }} ],
                   "relations": [ {{ "name": "ROW", "type": "line", "of": ["A", "B"] }} ] }}"#
            ));
            let plan = planned(&job);
            assert!(
                plan.safety
                    .iter()
                    .any(|row| row.rule == "place-within-limit" && row.holds == Some(true)),
                "{post} {rotation}"
            );
        }
    }
}
