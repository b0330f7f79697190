//! Relations between features of a set-up, against hand calculations, the virtual part and LinuxCNC's interpreter.

use super::super::draws::drawn_spreads;
use crate::common::fanuc::Control;
use crate::common::mpf::read;
use crate::common::sinumerik::Machine;
use crate::common::{import, interpret, interpret_until_stop, job, on_virtual_part, planned, with};
use crate::tests::controls::{computing, of_moves, skipping, without};
use touchpath::describe::catalog;
use touchpath::form::{Level, Value};
use touchpath::job::{JobError, Plan, RESULT_CODES, ResultRow, evaluate, plan};

/// Four holes on a pitch circle of 100 mm about (10, 5), a step of 3 mm, and two walls, on a part that is rotated by 30° and shifted.
const PLATE: &str = r#"{ "format": 2, "name": "PLATE", "control": { "post": "linuxcnc" }, "clear": 40,
  "cycles": [
    { "name": "A", "type": "hole", "diameter": 20, "origin": [60, 5, -5] },
    { "name": "B", "type": "hole", "diameter": 20, "origin": [10, 55, -5] },
    { "name": "C", "type": "hole", "diameter": 20, "origin": [-40, 5, -5] },
    { "name": "D", "type": "hole", "diameter": 20, "origin": [10, -45, -5] },
    { "name": "TOP", "type": "surface", "origin": [10, 5, 0] },
    { "name": "STEP", "type": "surface", "origin": [30, 25, -3] }
  ],
  "relations": [
    { "name": "AC", "type": "line", "of": ["A", "C"] },
    { "name": "BCD", "type": "pitch-circle", "of": ["A", "B", "C", "D"] },
    { "name": "MID", "type": "center", "of": ["A", "C"] },
    { "name": "DEEP", "type": "difference", "of": ["TOP.point.z", "STEP.point.z"] },
    { "name": "BORES", "type": "mean", "of": ["A.diameter", "B.diameter", "C.diameter", "D.diameter"] },
    { "name": "TWIST", "type": "line", "of": ["MID", "B"] }
  ] }"#;

fn row<'p>(plan: &'p Plan, name: &str, code: &str) -> &'p ResultRow {
    let names: Vec<&String> = plan.cycles.iter().chain(&plan.relations).collect();
    plan.results
        .iter()
        .find(|row| names[row.cycle].as_str() == name && row.code == code)
        .unwrap_or_else(|| panic!("{name}.{code}"))
}

fn value(plan: &Plan, name: &str, code: &str) -> f64 {
    row(plan, name, code).value.unwrap()
}

fn near(a: f64, b: f64, within: f64, what: &str) {
    assert!((a - b).abs() <= within, "{what}: {a} and {b}");
}

/// By hand: A and C are 100 mm apart along −X, all four are on the circle, the midpoint of A and C is (10, 5), the step is 3 mm, B is 50 mm above the centre.
#[test]
fn relations_of_the_nominal_part_are_those_of_the_drawing() {
    let plan = planned(&job(PLATE));
    assert_eq!(
        plan.relations,
        ["AC", "BCD", "MID", "DEEP", "BORES", "TWIST"]
    );
    for (name, code, wanted) in [
        ("AC", "distance", 100.0),
        ("AC", "rotation", 180.0),
        ("BCD", "center.x", 10.0),
        ("BCD", "center.y", 5.0),
        ("BCD", "diameter", 100.0),
        ("MID", "center.x", 10.0),
        ("MID", "center.y", 5.0),
        ("DEEP", "difference", 3.0),
        ("BORES", "mean", 20.0),
        ("TWIST", "distance", 50.0),
        ("TWIST", "rotation", 90.0),
    ] {
        let row = row(&plan, name, code);
        near(
            row.nominal.unwrap(),
            wanted,
            1e-9,
            &format!("{name}.{code}"),
        );
        near(row.value.unwrap(), wanted, 1e-6, &format!("{name}.{code}"));
        // The true value of a one-directional reading on another part is undefined.
        assert_eq!(row.truth.is_some(), name != "DEEP", "{name}");
        near(
            row.truth.unwrap_or(wanted),
            wanted,
            1e-6,
            &format!("{name}.{code}"),
        );
    }
    near(
        value(&plan, "BCD", "residual"),
        0.0,
        1e-4,
        "four points of one circle",
    );
}

/// The same for a control with fewer variables: three holes, three relations.
fn small(job: &Value) -> Value {
    let kept = |key: &str, names: &[&str]| {
        let Some(Value::List(list)) = job.get(key) else {
            unreachable!()
        };
        let named = |one: &Value| {
            names
                .iter()
                .any(|name| one.get("name") == Some(&Value::Text((*name).to_owned())))
        };
        with(
            job,
            key,
            Value::List(list.iter().filter(|one| named(one)).cloned().collect()),
        )
    };
    let fewer = kept("cycles", &["A", "B", "C"]);
    let cycles = fewer.get("cycles").unwrap().clone();
    with(
        &kept("relations", &["AC", "MID", "TWIST"]),
        "cycles",
        cycles,
    )
}

/// A part shifted and rotated by 1.5°, with one larger hole: distances stay, directions rotate with it, the mean grows by a quarter.
fn displaced(post: &str) -> Value {
    let part =
        r#"{ "offset": [0.4, -0.3, 0.2], "rotation": 1.5, "sizes": { "B.diameter": 0.08 } }"#;
    with(
        &with(&job(PLATE), "control.post", Value::Text(post.to_owned())),
        "part",
        job(part),
    )
}

#[test]
fn relations_move_with_the_part_and_agree_with_its_truth() {
    // A program of the simulated Fanuc and Haas has fewer variables, as in the next test.
    for post in without(&of_moves(), &skipping()) {
        let plan = planned(&displaced(post));
        near(value(&plan, "AC", "distance"), 100.0, 2e-3, post);
        near(value(&plan, "AC", "rotation"), 181.5, 2e-3, post);
        near(value(&plan, "TWIST", "rotation"), 91.5, 2e-3, post);
        near(value(&plan, "BORES", "mean"), 20.02, 1e-3, post);
        near(value(&plan, "DEEP", "difference"), 3.0, 1e-6, post);
        // A probed surface has no true point, so the step has none.
        for row in plan.results.iter().filter(|row| {
            row.cycle >= plan.cycles.len()
                && !["residual", "difference"].contains(&row.code.as_str())
        }) {
            near(
                row.value.unwrap(),
                row.truth.unwrap(),
                3e-3,
                &format!("{post}: {}", row.code),
            );
        }
    }
}

/// Every kind of the list, with the fewest operands and with more: it has the results of its row, LinuxCNC's interpreter computes them, the value from true
/// operands agrees on a displaced part, and its program is read back as the job. This applies to every kind that is added.
#[test]
fn each_kind_of_relation_is_computed_listed_and_read_back() {
    let kinds = catalog().relations;
    let lengths = ["A.diameter", "B.diameter", "C.diameter", "D.diameter"];
    let angles = ["SIDE.rotation", "FRONT.rotation", "AC.rotation"];
    let mut asked = 0;
    for def in &kinds {
        let operands: &[&[&str]] = if def.places {
            &[&["A", "B", "C", "D"]]
        } else {
            &[&lengths, &angles]
        };
        for all in operands {
            for count in [def.least, def.most.unwrap_or(all.len()).min(all.len())] {
                let of: Vec<String> = all[..count]
                    .iter()
                    .map(|name| format!("{name:?}"))
                    .collect();
                let one = format!(
                    r#"{{ "name": "ONE", "type": "{}", "of": [{}] }}"#,
                    def.key,
                    of.join(",")
                );
                let line = r#"{ "name": "AC", "type": "line", "of": ["A", "C"] }"#;
                let said = format!("{} of {}", def.key, of.join(" "));
                let walls = ["SIDE", "FRONT"].map(|name| {
                    let (x, turn) = if name == "SIDE" { (150, 20) } else { (-150, 35) };
                    format!(r#"{{ "name": "{name}", "type": "wall-angle", "origin": [{x}, 0, 0], "rotation": {turn} }}"#)
                });
                let mut whole = displaced("linuxcnc");
                if let Some(Value::List(cycles)) = whole.get_mut("cycles") {
                    cycles.extend(walls.iter().map(|wall| job(wall)));
                }
                let whole = with(&whole, "relations", job(&format!("[{line}, {one}]")));
                let whole = with(
                    &with(&whole, "control.report", Value::Text("screen".to_owned())),
                    "clear",
                    Value::Number(60.0),
                );
                let plan = planned(&whole);
                let rows: Vec<&ResultRow> = plan
                    .results
                    .iter()
                    .filter(|row| row.cycle == plan.cycles.len() + 1)
                    .collect();
                let angle = if all[0] == angles[0] { ".angle" } else { "" };
                let codes: Vec<&str> = rows.iter().map(|row| row.code.as_str()).collect();
                assert_eq!(
                    codes,
                    def.results
                        .iter()
                        .map(|code| format!("{code}{angle}"))
                        .collect::<Vec<_>>(),
                    "{said}"
                );
                let ran = interpret(&on_virtual_part(&plan)).unwrap();
                for row in rows {
                    assert!(
                        RESULT_CODES.contains(&row.code.as_str()),
                        "{said}: {}",
                        row.code
                    );
                    let code = format!("ONE.{}", row.code);
                    let (_, shown) = ran
                        .prints
                        .iter()
                        .find(|(shown, _)| *shown == code)
                        .unwrap_or_else(|| panic!("{said}: {code}"));
                    near(*shown, row.value.unwrap(), 2e-4, &said);
                    // The distance of touches from a circle is not that of positions.
                    if row.code != "residual" {
                        near(row.value.unwrap(), row.truth.unwrap(), 3e-3, &said);
                    }
                    asked += 1;
                }
                assert_eq!(
                    import(&plan.program.text).unwrap().job.get("relations"),
                    whole.get("relations"),
                    "{said}"
                );
            }
        }
    }
    assert!(asked >= 2 * kinds.len(), "{asked}");
}

/// Every control computes them: LinuxCNC's own interpreter, and the simulated controls.
#[test]
fn programs_compute_what_the_plan_says() {
    let on_screen = |post: &str| {
        with(
            &displaced(post),
            "control.report",
            Value::Text("screen".to_owned()),
        )
    };
    let plan = planned(&on_screen("linuxcnc"));
    let ran = interpret(&on_virtual_part(&plan)).unwrap();
    let mut compared = 0;
    for (i, name) in plan.relations.iter().enumerate() {
        for row in plan
            .results
            .iter()
            .filter(|row| row.cycle == plan.cycles.len() + i)
        {
            let code = format!("{name}.{}", row.code);
            let (_, shown) = ran
                .prints
                .iter()
                .find(|(shown, _)| *shown == code)
                .unwrap_or_else(|| panic!("{code}"));
            near(*shown, row.value.unwrap(), 2e-4, &code);
            compared += 1;
        }
    }
    assert_eq!(compared, 12);

    let plan = planned(&on_screen("sinumerik"));
    let mut machine = Machine::new(plan.triggers.clone());
    machine.run(&read(&plan.program.text).unwrap()).unwrap();
    assert_eq!(machine.alarm, None, "{}", machine.message);
    let said = |name: &str, code: &str| {
        let word = format!("{name}.{code}=");
        let line = machine
            .messages
            .iter()
            .find_map(|line| line.split(&word).nth(1))
            .unwrap_or_else(|| panic!("{word}"));
        let end = line
            .find(|c: char| !(c.is_ascii_digit() || ".-".contains(c)))
            .unwrap_or(line.len());
        line[..end].parse::<f64>().unwrap()
    };
    near(
        said("AC", "rotation"),
        value(&plan, "AC", "rotation"),
        2e-3,
        "sinumerik",
    );
    near(
        said("BCD", "diameter"),
        value(&plan, "BCD", "diameter"),
        2e-3,
        "sinumerik",
    );

    for post in skipping() {
        let plan = planned(&small(&displaced(post)));
        let mut control = Control::new(post == "haas", false);
        control.contacts = plan.triggers.iter().flatten().copied().collect();
        control.run(&plan.program.text).unwrap();
        assert_eq!(control.alarm, None);
        let held = |code: &str| {
            let lists = plan
                .program
                .text
                .lines()
                .filter_map(|line| line.strip_prefix('('))
                .map(|line| line.trim_end_matches(')'));
            let entry = lists
                .flat_map(|line| line.trim_start_matches("RESULTS: ").split(", "))
                .find(|entry| entry.ends_with(&format!("= {code}")));
            control.variables[&entry
                .unwrap_or_else(|| panic!("{code}"))
                .split(' ')
                .next()
                .unwrap()[1..]
                .parse()
                .unwrap()]
        };
        near(
            held("AC.ROTATION"),
            value(&plan, "AC", "rotation"),
            2e-3,
            post,
        );
        near(
            held("TWIST.DISTANCE"),
            value(&plan, "TWIST", "distance"),
            2e-3,
            post,
        );
    }
}

/// Linear propagation by hand: touches of 1 µm give a centre of four touches 1/√2 µm along each axis, so a distance of two of them is 1 µm, and a mean
/// of four diameters (1 µm each) is 1/2 µm.
#[test]
fn uncertainties_go_through_relations() {
    let job = with(&job(PLATE), "stylus.repeatability", Value::Number(0.001));
    let plan = planned(&job);
    near(
        row(&plan, "AC", "distance").uncertainty.unwrap(),
        0.001,
        1e-6,
        "distance",
    );
    near(
        row(&plan, "AC", "rotation").uncertainty.unwrap(),
        (0.001f64 / 100.0).to_degrees(),
        1e-8,
        "direction",
    );
    near(
        row(&plan, "BORES", "mean").uncertainty.unwrap(),
        0.0005,
        1e-6,
        "mean",
    );
    near(
        row(&plan, "MID", "center.x").uncertainty.unwrap(),
        0.0005,
        1e-6,
        "middle",
    );
}

/// Touches with scatter along their directions, on a rotated part: the spread of a relation is its stated uncertainty.
#[test]
fn uncertainties_of_relations_agree_with_draws() {
    let mut job = with(&job(PLATE), "part.rotation", Value::Number(0.3));
    job = with(&job, "stylus.repeatability", Value::Number(0.001));
    let (plan, spreads) = (planned(&job), drawn_spreads(&job, 5_000));
    // Those of the relations: the residual of a circle is no linear function.
    let between: Vec<usize> = (0..plan.results.len())
        .filter(|i| {
            plan.results[*i].cycle >= plan.cycles.len() && plan.results[*i].code != "residual"
        })
        .collect();
    for i in &between {
        let (row, spread) = (&plan.results[*i], spreads[*i].unwrap());
        let stated = row.uncertainty.unwrap();
        // With 5,000 draws a spread is known to one percent.
        assert!(
            (spread / stated - 1.0).abs() < 0.04,
            "{} {}: drawn {spread}, stated {stated}",
            row.cycle,
            row.code
        );
    }
    assert_eq!(between.len(), 11);
}

/// A fixture of two holes: the origin at the midpoint, the rotation from the line through both. Probed again after the write, everything is nominal.
#[test]
fn a_work_offset_is_written_from_relations() {
    let text = r#"{ "format": 2, "control": { "post": "linuxcnc", "workOffset": 1 }, "clear": 40,
      "cycles": [ { "name": "LEFT", "type": "hole", "diameter": 20, "origin": [-70, 12, -5] },
                  { "name": "RIGHT", "type": "hole", "diameter": 20, "origin": [70, 12, -5] } ],
      "relations": [ { "name": "MID", "type": "center", "of": ["LEFT", "RIGHT"] }, { "name": "ROW", "type": "line", "of": ["LEFT", "RIGHT"] } ],
      "datum": { "x": "MID.center.x", "y": "MID.center.y", "rotation": "ROW.rotation" },
      "part": { "offset": [0.7, -0.45, 0], "rotation": 0.8 } }"#;
    let plan = planned(&job(text));
    assert_eq!(plan.program.writes, ["X", "Y", "rotation"]);
    let ran = interpret(&on_virtual_part(&plan)).unwrap();
    let ([ox, oy, _], turn) = (
        *ran.offsets_after_moves.last().unwrap(),
        *ran.rotations_after_moves.last().unwrap(),
    );
    near(turn, 0.8, 1e-4, "rotation");
    // Positions of the holes on the part, by hand, and their coordinates in the written system.
    let (s, c) = 0.8f64.to_radians().sin_cos();
    for (x, y) in [(-70.0, 12.0), (70.0, 12.0)] {
        let (mx, my) = (x * c - y * s + 0.7, x * s + y * c - 0.45);
        let (s, c) = (-turn).to_radians().sin_cos();
        let (dx, dy) = (mx - ox, my - oy);
        near(dx * c - dy * s, x, 2e-4, "X of a hole");
        near(dx * s + dy * c, y, 2e-4, "Y of a hole");
    }
    let choices = |axis: &str| {
        plan.datum
            .iter()
            .find(|row| row.axis == axis)
            .unwrap()
            .choices
            .clone()
    };
    assert_eq!(
        choices("x"),
        ["LEFT.center.x", "RIGHT.center.x", "MID.center.x"]
    );
    assert_eq!(choices("rotation"), ["ROW.rotation"]);
}

#[test]
fn relations_take_tolerances_come_back_from_headers_and_from_measured_results() {
    let tolerances = r#"{ "AC.distance": { "tolerance": "±0.05", "action": "stop" }, "twist.distance": { "tolerance": "49.9..50.1" } }"#;
    for post in computing() {
        let job = with(&small(&displaced(post)), "tolerances", job(tolerances));
        let plan = planned(&job);
        assert_eq!(
            row(&plan, "AC", "distance").verdict.as_deref(),
            Some("good"),
            "{post}"
        );
        assert_eq!(
            row(&plan, "TWIST", "distance").verdict.as_deref(),
            Some("good"),
            "{post}"
        );
        let back = import(&plan.program.text).unwrap();
        assert!(
            back.findings
                .iter()
                .all(|finding| finding.level != Level::Warning),
            "{post}: {:?}",
            back.findings
        );
        assert_eq!(planned(&back.job).program.text, plan.program.text, "{post}");
        let names: Vec<&String> = plan.cycles.iter().chain(&plan.relations).collect();
        let said = plan
            .results
            .iter()
            .filter_map(|row| Some(format!("{}.{}={}", names[row.cycle], row.code, row.value?)));
        let said = said
            .map(|line| line.replace("AC.distance=100", "AC.distance=100.2"))
            .collect::<Vec<_>>()
            .join("\n");
        let rows = evaluate(&job, &Value::Text(said)).unwrap();
        let of = |name: &str, code: &str| {
            rows.iter()
                .find(|row| names[row.cycle].as_str() == name && row.code == code)
                .unwrap()
                .clone()
        };
        assert!(
            of("AC", "distance")
                .verdict
                .as_deref()
                .is_some_and(|verdict| verdict.starts_with("out")),
            "{post}"
        );
        near(of("TWIST", "distance").value.unwrap(), 50.0, 2e-3, post);
    }
}

#[test]
fn what_is_no_relation_is_said_at_its_place() {
    let found = |relations: &str| match plan(&with(&job(PLATE), "relations", job(relations))) {
        Ok(_) => Vec::new(),
        Err(JobError { findings, .. }) => findings
            .into_iter()
            .filter(|finding| finding.level == Level::Error)
            .map(|finding| (finding.code, finding.path))
            .collect(),
    };
    for (relations, code, path) in [
        (
            r#"[{ "name": "A", "type": "line", "of": ["A", "B"] }]"#,
            "cycle-name",
            "relations[0].name",
        ),
        (
            r#"[{ "name": "1X", "type": "line", "of": ["A", "B"] }]"#,
            "cycle-name",
            "relations[0].name",
        ),
        (
            r#"[{ "type": "line", "of": ["A", "B"] }]"#,
            "missing",
            "relations[0].name",
        ),
        (
            r#"[{ "name": "X", "of": ["A", "B"] }]"#,
            "missing",
            "relations[0].type",
        ),
        (
            r#"[{ "name": "X", "type": "ring", "of": ["A", "B"] }]"#,
            "unknown-value",
            "relations[0].type",
        ),
        (
            r#"[{ "name": "X", "type": "line", "of": ["A"] }]"#,
            "wrong-count",
            "relations[0].of",
        ),
        (
            r#"[{ "name": "X", "type": "line" }]"#,
            "wrong-count",
            "relations[0].of",
        ),
        (
            r#"[{ "name": "X", "type": "line", "of": ["A", "A"] }]"#,
            "relation-of",
            "relations[0].of[1]",
        ),
        (
            r#"[{ "name": "X", "type": "line", "of": ["A", "TOP"] }]"#,
            "relation-of",
            "relations[0].of[1]",
        ),
        (
            r#"[{ "name": "X", "type": "line", "of": ["A", "LATER"] }]"#,
            "relation-of",
            "relations[0].of[1]",
        ),
        (
            r#"[{ "name": "X", "type": "mean", "of": ["A", "B"] }]"#,
            "relation-of",
            "relations[0].of[0]",
        ),
        (
            r#"[{ "name": "L", "type": "line", "of": ["A", "B"] }, { "name": "X", "type": "mean", "of": ["A.diameter", "L.rotation"] }]"#,
            "relation-of",
            "relations[1].of",
        ),
        (
            r#"[{ "name": "M", "type": "center", "of": ["B", "D"] }, { "name": "N", "type": "center", "of": ["A", "C"] }, { "name": "X", "type": "line", "of": ["M", "N"] }]"#,
            "relation-of",
            "relations[2].of",
        ),
        (
            r#"[{ "name": "M", "type": "center", "of": ["A", "C"] }, { "name": "X", "type": "pitch-circle", "of": ["A", "M", "C"] }]"#,
            "relation-of",
            "relations[1].of",
        ),
        (
            r#"[{ "name": "X", "type": "line", "of": ["A", 2] }]"#,
            "wrong-type",
            "relations[0].of[1]",
        ),
        (
            r#"[{ "name": "X", "type": "line", "of": ["A", "B"], "as": 1 }]"#,
            "unknown-key",
            "relations[0].as",
        ),
        (r#"[7]"#, "wrong-type", "relations[0]"),
        (r#"{}"#, "wrong-type", "relations"),
    ] {
        let all: Vec<(String, String)> = found(relations);
        assert!(
            all.contains(&(code.to_owned(), path.to_owned())),
            "{relations}: {all:?}"
        );
    }
}

/// Two opposite walls of a vise that are not parallel, and directions near half a turn: by hand 180.3° minus −0.2°, and their mean near the nominal one.
#[test]
fn directions_near_half_a_turn_are_compared_within_half_a_turn() {
    let text = |post: &str| {
        format!(
            r#"{{ "format": 2, "control": {{ "post": "{post}" }}, "clear": 40,
          "cycles": [ {{ "name": "ONE", "type": "wall-angle", "origin": [60, 0, -8], "rotation": 180 }},
                      {{ "name": "TWO", "type": "wall-angle", "origin": [-60, 0, -8], "rotation": 180 }},
                      {{ "name": "SIDE", "type": "wall-angle", "origin": [0, 90, -8], "rotation": 0 }} ],
          "relations": [ {{ "name": "APART", "type": "difference", "of": ["ONE.rotation", "SIDE.rotation"] }},
                         {{ "name": "BOTH", "type": "mean", "of": ["ONE.rotation", "TWO.rotation"] }} ],
          "part": {{ "rotation": 0.3 }} }}"#
        )
    };
    for post in of_moves() {
        let plan = planned(&job(&text(post)));
        near(value(&plan, "APART", "difference.angle"), 180.0, 1e-3, post);
        near(value(&plan, "BOTH", "mean.angle"), 180.3, 1e-3, post);
        near(
            row(&plan, "BOTH", "mean.angle").truth.unwrap(),
            180.3,
            1e-6,
            post,
        );
        assert!(
            plan.datum
                .iter()
                .any(|row| row.axis == "rotation"
                    && row.choices.contains(&"BOTH.mean.angle".to_owned())),
            "{post}"
        );
    }
}

/// Two walls of a dovetail across half a turn: 179° and −179° are 2° apart, and their middle is 180°; by hand.
#[test]
fn directions_on_both_sides_of_half_a_turn_have_the_smaller_difference_and_the_middle_between_them()
{
    let text = |post: &str, a: f64, b: f64| {
        format!(
            r#"{{ "format": 2, "control": {{ "post": "{post}" }}, "clear": 40, "limits": {{ "angle": 5 }},
          "cycles": [ {{ "name": "ONE", "type": "wall-angle", "origin": [60, 0, -8], "rotation": {a} }},
                      {{ "name": "TWO", "type": "wall-angle", "origin": [-60, 0, -8], "rotation": {b} }} ],
          "relations": [ {{ "name": "APART", "type": "difference", "of": ["ONE.rotation", "TWO.rotation"] }},
                         {{ "name": "BOTH", "type": "mean", "of": ["ONE.rotation", "TWO.rotation"] }} ],
          "tolerances": {{ "APART.difference.angle": {{ "tolerance": "±0.1" }} }},
          "part": {{ "rotation": 0.3 }} }}"#
        )
    };
    for post in of_moves() {
        for (a, b, apart, middle) in [
            (179.0, -179.0, -2.0, 180.0),
            (-179.0, 179.0, 2.0, 180.0),
            (170.0, -170.0, -20.0, 180.0),
            (10.0, 350.0, 20.0, 0.0),
        ] {
            let plan = planned(&job(&text(post, a, b)));
            let what = format!("{post} {a} {b}");
            let near_turned =
                |x: f64, y: f64| near(((x - y + 540.0) % 360.0) - 180.0, 0.0, 2e-3, &what);
            near(
                row(&plan, "APART", "difference.angle").nominal.unwrap(),
                apart,
                1e-9,
                &what,
            );
            near(
                value(&plan, "APART", "difference.angle"),
                apart,
                2e-3,
                &what,
            );
            near(
                row(&plan, "APART", "difference.angle").truth.unwrap(),
                apart,
                1e-6,
                &what,
            );
            near_turned(value(&plan, "BOTH", "mean.angle"), middle + 0.3);
            near_turned(
                row(&plan, "BOTH", "mean.angle").truth.unwrap(),
                middle + 0.3,
            );
            let back = import(&plan.program.text).unwrap().job;
            if computing().contains(&post) {
                assert!(
                    back.get("tolerances")
                        .and_then(|all| all.get("APART.difference.angle"))
                        .is_some(),
                    "{what}"
                );
            }
        }
    }
}

/// A single cycle in the list has its name, too: in tolerances, and in relations of its own results.
#[test]
fn a_set_up_of_one_cycle_names_its_results() {
    let text = r#"{ "format": 2, "cycles": [{ "name": "BORE", "type": "internal-rectangle", "width1": 60, "width2": 40 }],
      "relations": [{ "name": "D", "type": "difference", "of": ["BORE.width1", "BORE.width2"] }],
      "tolerances": { "BORE.width1": { "tolerance": "±0.1" }, "D.difference": { "tolerance": "19.9..20.1" } } }"#;
    let plan = planned(&job(text));
    near(value(&plan, "D", "difference"), 20.0, 1e-6, "difference");
    assert_eq!(
        plan.results
            .iter()
            .filter(|row| row.verdict.as_deref() == Some("good"))
            .count(),
        2
    );
    let one = r#"{ "format": 2, "cycles": [{ "name": "BORE", "type": "hole", "diameter": 25 }], "tolerances": { "bore.diameter": { "tolerance": "H7" } } }"#;
    assert!(
        planned(&job(one))
            .results
            .iter()
            .any(|row| row.limits.is_some())
    );
    let twice = with(
        &job(one),
        "tolerances",
        job(r#"{ "BORE.diameter": { "tolerance": "H7" }, "diameter": { "tolerance": "±0.3" } }"#),
    );
    let Err(JobError { findings, .. }) = touchpath::job::plan(&twice) else {
        panic!("refused")
    };
    assert!(
        findings
            .iter()
            .any(|finding| finding.code == "tolerance-unknown"),
        "{findings:?}"
    );
}

/// One of four holes 1 mm off the circle of the others: a circle fits all four within a quarter of that, more than 0.1. A tenth of it is accepted.
#[test]
fn a_pitch_circle_of_places_that_lie_on_none_is_refused() {
    let moved = |y: &str| {
        job(&PLATE.replace(
            "\"origin\": [10, -45, -5]",
            &format!("\"origin\": [10, {y}, -5]"),
        ))
    };
    let refused = plan(&moved("-46")).unwrap_err().findings;
    let found: Vec<_> = refused
        .iter()
        .filter(|f| f.level == Level::Error)
        .map(|f| (f.code.as_str(), f.path.as_str()))
        .collect();
    assert_eq!(found, [("relation-of", "relations[1].of")]);
    assert!(plan(&moved("-45.1")).is_ok());
    assert!(plan(&with(&moved("-46"), "limits.residual", Value::Null)).is_ok());
}

/// A relation and the written offset have errors: both are reported together.
#[test]
fn a_wrong_relation_hides_nothing_else() {
    let relations = r#"[{ "name": "ROW", "type": "line", "of": ["A", "NONE"] }]"#;
    let whole = with(&displaced("linuxcnc"), "relations", job(relations));
    let whole = with(&whole, "datum", job(r#"{ "x": "NONE.center.x" }"#));
    let findings = plan(&whole).unwrap_err().findings;
    for code in ["relation-of", "datum-unknown"] {
        assert!(
            findings.iter().any(|finding| finding.code == code),
            "{code}: {findings:?}"
        );
    }
}

/// At 0 a residual has no derivative, nor has a difference of two: its program was refused because its last digits seemed wrong.
#[test]
fn a_difference_of_residuals_is_proven_on_a_straight_part() {
    let asked = job(r#"{ "format": 2, "units": "inch", "name": "STRAIGHT",
      "limits": { "size": 0.118, "angle": 1, "residual": 0.0082 },
      "control": { "post": "linuxcnc", "workOffset": 1 },
      "part": { "offset": [2.01e-5, -6.9e-7, -1.09e-4], "rotation": -0.000714 },
      "datum": { "rotation": null },
      "cycles": [
        { "name": "C1", "type": "web", "origin": [-7.244, 7.165, -4.606], "depth": 2.944, "feedDistance": 3.8378 },
        { "name": "C2", "type": "double-wall-external-corner", "origin": [23.58267716535433, -6.850393700787402, -2.283464566929134],
          "rotation": -179, "clearance1": 0.5905511811023623, "distance2": 3.090244688973365, "count1": 5, "count2": 3,
          "step1": 12.736220472440946, "step2": 7.099992736656125 }
      ],
      "relations": [{ "name": "R2", "type": "difference", "of": ["C2.residual1", "C2.residual2"] }] }"#);
    let plan = planned(&asked);
    assert!(plan.program.proof.is_some(), "{:?}", plan.findings);
    near(
        value(&plan, "R2", "difference"),
        0.0,
        1e-5,
        "two straight walls",
    );
}

/// A bore before and after a stud. The part that moves by 0.05 in between stops the program before it writes the stud's place; a move of 0.01 does not.
/// Judges: LinuxCNC's interpreter, the tests' own Haas and SINUMERIK.
#[test]
fn a_part_that_moves_in_between_stops_the_program() {
    const DRIFT: &str = include_str!("../../../examples/set-ups/drift.json");
    for post in ["linuxcnc", "haas", "fanuc", "sinumerik"] {
        for (moved, stops) in [
            ([0.01, -0.01], false),
            ([0.05, 0.0], true),
            ([0.0, -0.05], true),
        ] {
            let job = with(&job(DRIFT), "control.post", Value::Text(post.to_owned()));
            let mut plan = planned(&job);
            let last = plan.triggers.len() - 4;
            // Each contact moves along the direction of its touch.
            for (trigger, touch) in plan.triggers[last..].iter_mut().zip(&plan.touches[last..]) {
                let trigger = trigger.as_mut().expect("a contact");
                for axis in [0, 1] {
                    trigger[axis] += moved[axis] * touch.vector[axis].abs();
                }
            }
            let (stopped, wrote) = match post {
                "linuxcnc" => {
                    let (ran, why) = interpret_until_stop(&on_virtual_part(&plan));
                    (why, ran.written.is_some())
                }
                "sinumerik" => {
                    let mut machine = Machine::new(plan.triggers.clone());
                    let program = read(&plan.program.text).expect("a program");
                    machine.run(&program).expect("it runs");
                    (machine.alarm.map(|_| machine.message), machine.writes > 0)
                }
                _ => {
                    let mut control = Control::new(post == "haas", false);
                    control.at = [0.0, 0.0, 200.0];
                    control.contacts = plan.triggers.iter().flatten().copied().collect();
                    control
                        .variables
                        .extend((5221..5224).map(|origin| (origin, 0.0)));
                    control.run(&plan.program.text).expect("it runs");
                    (control.alarm, !control.writes.is_empty())
                }
            };
            assert_eq!(wrote, !stops, "{post} {moved:?} {stopped:?}");
            assert_eq!(stopped.is_some(), stops, "{post} {moved:?} {stopped:?}");
        }
    }
}
