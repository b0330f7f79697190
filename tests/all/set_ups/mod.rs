//! Jobs with several cycles: one program, safe link moves, one write at the end.

pub mod computed;
mod examples;
pub mod follows;
pub mod led;
mod refused;
mod relations;
pub mod turns;

use crate::common::fanuc::Control;
use crate::common::{Draws, import, interpret, job, number_at, planned, with};
use crate::tests::controls::{calling, of_moves, skipping, with_offsets};
use touchpath::control::find;
use touchpath::cycle::CYCLES;
use touchpath::form::Value;
use touchpath::job::{Move, Plan, default_job, evaluate};

/// A vise: its top, a bore, and a corner whose direction rotates the work offset.
pub const VISE: &str = r#"{ "format": 2, "name": "VISE", "control": { "post": "linuxcnc", "workOffset": 1 },
  "cycles": [
    { "name": "TOP", "type": "surface", "origin": [-30, 0, 0] },
    { "name": "BORE", "type": "hole", "diameter": 25 },
    { "name": "WALL", "type": "double-wall-internal-corner", "origin": [80, 10, -5], "count1": 2, "count2": 2 }
  ],
  "datum": { "rotation": "WALL.rotation" },
  "part": { "offset": [0.3, -0.2, 0.15], "rotation": 0.4 } }"#;

/// The keys of the cycles that touch.
fn measuring() -> Vec<&'static str> {
    CYCLES
        .iter()
        .filter(|def| def.most_touches > 0)
        .map(|def| def.key)
        .collect()
}

/// The cycle of a default job, moved along X.
fn cycle(key: &str, along: f64) -> Value {
    let job = default_job(key).unwrap();
    let cycle = job.get("cycle").unwrap().clone();
    let moved = |cycle: Value, point: &str| {
        let Some(Value::List(at)) = cycle.get(point) else {
            return cycle;
        };
        let Value::Number(x) = at[0] else {
            return cycle;
        };
        let at = vec![Value::Number(x + along), at[1].clone(), at[2].clone()];
        with(&cycle, point, Value::List(at))
    };
    ["origin", "point1", "point2", "start"]
        .into_iter()
        .fold(cycle, moved)
}

/// A set-up of these cycles, 300 mm apart.
fn set_up(post: &str, keys: &[&str]) -> Value {
    let cycles = keys
        .iter()
        .enumerate()
        .map(|(i, key)| cycle(key, 300.0 * i as f64))
        .collect();
    let offset = if with_offsets().contains(&post) {
        Value::Number(2.0)
    } else {
        Value::Null
    };
    let job = job(&format!(
        r#"{{ "format": 2, "control": {{ "post": "{post}" }}, "cycles": [] }}"#
    ));
    with(
        &with(&job, "cycles", Value::List(cycles)),
        "control.workOffset",
        offset,
    )
}

/// One of its cycles as a job with one cycle.
fn alone(post: &str, key: &str, along: f64) -> Value {
    let job = job(&format!(
        r#"{{ "format": 1, "control": {{ "post": "{post}" }} }}"#
    ));
    let rapid = with(&job, "cycle", cycle(key, along));
    if key == "probing-two-circles" {
        with(&rapid, "control.form", Value::Text("moves".to_owned()))
    } else {
        rapid
    }
}

/// Each cycle next to another, on every control: its moves, touches and results are the same as in a job with one cycle.
#[test]
fn a_cycle_in_a_set_up_is_the_cycle_alone() {
    let keys = measuring();
    let mut seen = 0;
    for post in of_moves() {
        for (i, first) in keys.iter().enumerate() {
            let pair = [*first, keys[(i + 1) % keys.len()]];
            let plan = planned(&set_up(post, &pair));
            assert_eq!(plan.cycles.len(), 2);
            for (cycle, key) in pair.into_iter().enumerate() {
                let own = planned(&alone(post, key, 300.0 * cycle as f64));
                let moves: Vec<_> = plan
                    .moves
                    .iter()
                    .filter(|m| m.cycle == cycle && m.step > 0)
                    .collect();
                // The second cycle of a pair is approached from above: its first move is the move down.
                assert_eq!(moves.len(), own.moves.len(), "{post} {pair:?} {cycle}");
                for (a, b) in moves.iter().zip(&own.moves) {
                    assert_eq!(
                        (a.to, a.kind, a.step, &a.arc),
                        (b.to, b.kind, b.step, &b.arc),
                        "{post} {pair:?}"
                    );
                }
                let touches: Vec<_> = plan
                    .touches
                    .iter()
                    .filter(|t| t.cycle == cycle)
                    .map(|t| (t.point, t.vector))
                    .collect();
                assert_eq!(
                    touches,
                    own.touches
                        .iter()
                        .map(|t| (t.point, t.vector))
                        .collect::<Vec<_>>()
                );
                let said = |plan: &Plan, cycle: usize| -> Vec<_> {
                    let rows = plan
                        .results
                        .iter()
                        .filter(|row| row.cycle == cycle && !row.code.starts_with("offset."));
                    rows.map(|row| {
                        (
                            row.code.clone(),
                            row.value,
                            row.truth,
                            row.uncertainty,
                            row.verdict.clone(),
                        )
                    })
                    .collect()
                };
                assert_eq!(said(&plan, cycle), said(&own, 0), "{post} {pair:?}");
                let table = |plan: &Plan, cycle: usize| -> Vec<_> {
                    plan.table
                        .iter()
                        .filter(|row| row.cycle == cycle)
                        .map(|row| (row.code.clone(), row.value.clone()))
                        .collect()
                };
                assert_eq!(table(&plan, cycle), table(&own, 0));
                // Rules that its program cannot guarantee, and required inputs, are the same.
                for (a, b) in plan.safety.iter().zip(&own.safety) {
                    assert_eq!(
                        (a.rule, a.holds),
                        (b.rule, b.holds),
                        "{post} {pair:?}: {}",
                        a.message
                    );
                }
                seen += 1;
            }
            assert!(
                plan.program
                    .proof
                    .as_ref()
                    .is_some_and(|proof| proof.touches == plan.touches.len())
            );
            the_ways_between_are_clear(&plan, &format!("{post} {pair:?}"));
        }
    }
    assert_eq!(seen, 2 * of_moves().len() * keys.len());
}

/// Between two cycles the ball moves up, across and down, and across no lower than any cycle begins or ends.
fn the_ways_between_are_clear(plan: &Plan, said: &str) {
    let ends = |cycle: usize| {
        let own: Vec<_> = plan
            .moves
            .iter()
            .filter(|m| m.cycle == cycle && m.step > 0)
            .collect();
        [own[0].to[2], own[own.len() - 1].to[2]]
    };
    let highest = (0..plan.cycles.len())
        .flat_map(ends)
        .fold(f64::NEG_INFINITY, f64::max);
    let mut from = plan.moves[0].to;
    for step in &plan.moves[1..] {
        let across = (0..2).any(|axis| (step.to[axis] - from[axis]).abs() > 1e-9);
        let way = step.step == 0;
        assert!(!way || step.kind == "position", "{said}");
        assert!(
            !way || !across || (step.to[2] - from[2]).abs() < 1e-9,
            "{said}: neither up nor across: {step:?}"
        );
        assert!(
            !way || !across || step.to[2] >= highest - 1e-9,
            "{said}: across at {}",
            step.to[2]
        );
        from = step.to;
    }
}

/// The program with touches that end at the triggers of the virtual part, as LinuxCNC's interpreter needs it.
fn on_the_part(plan: &Plan) -> String {
    let mut lines: Vec<String> = plan.program.text.lines().map(str::to_owned).collect();
    for (index, step) in plan
        .moves
        .iter()
        .enumerate()
        .filter(|(_, m)| m.kind == "touch")
    {
        let trigger = plan.triggers[step.touch.unwrap()].expect("this part is met");
        let [x, y, z] = trigger.map(|v| format!("{v:.9}"));
        let line = &mut lines[plan.program.move_lines[index] as usize];
        assert!(line.starts_with("G38.2"), "{line}");
        let feed = line.split(' ').next_back().unwrap().to_owned();
        *line = format!("G38.2 X{x} Y{y} Z{z} {feed}");
    }
    lines.join("\n") + "\n"
}

/// LinuxCNC's interpreter on a displaced and rotated part: it prints the results of the plan, and in the work offset that it writes every feature of the part
/// is at its nominal position.
fn probing_again_reads_nominal(job: &Value, said: &str) {
    let plan = planned(job);
    let ran = interpret(&on_the_part(&plan)).unwrap_or_else(|e| panic!("{said}: {e}"));
    // 1411's verdict and form are no output of its program.
    let computed =
        |code: &str| !code.starts_with("offset.") && !["Q183", "form1", "form2"].contains(&code);
    let shown: Vec<_> = plan
        .results
        .iter()
        .filter(|r| r.value.is_some() && computed(&r.code))
        .collect();
    assert_eq!(ran.prints.len(), shown.len(), "{said}");
    for ((code, printed), row) in ran.prints.iter().zip(shown) {
        assert_eq!(
            *code,
            format!("{}.{}", plan.cycles[row.cycle], row.code),
            "{said}"
        );
        assert!(
            (row.value.unwrap() - printed).abs() < 3e-6,
            "{said}: {code} printed {printed}, shown {:?}",
            row.value
        );
    }
    let written = |code: &str| plan.results.iter().any(|row| row.code == code);
    // A rotation is written first, with the unchanged offset.
    let (number, _) = ran.written.expect("it writes");
    let origin = ran.offsets_after_moves[usize::from(written("offset.rotation"))];
    assert_eq!(
        number as f64,
        number_at(job, "control.workOffset", 0.0),
        "{said}"
    );
    let turn = if written("offset.rotation") {
        ran.rotations_after_moves[0]
    } else {
        0.0
    };
    let (sin, cos) = turn.to_radians().sin_cos();
    assert_eq!(turn != 0.0, written("offset.rotation"), "{said}");
    // Shift of the origin: it was 0 before.
    for (axis, code) in ["offset.x", "offset.y", "offset.z"].into_iter().enumerate() {
        let Some(row) = plan.results.iter().find(|row| row.code == code) else {
            continue;
        };
        assert!(
            (row.value.unwrap() - origin[axis]).abs() < 1e-5,
            "{said}: {code} {:?}, written {}",
            row.value,
            origin[axis]
        );
        assert!(
            row.truth
                .is_none_or(|truth| (truth - origin[axis]).abs() < 1e-4),
            "{said}: {code} is truly {:?}",
            row.truth
        );
    }
    // A machine position in the new system: G54 was 0 before.
    let reads = |p: [f64; 2]| {
        let [x, y] = [p[0] - origin[0], p[1] - origin[1]];
        [x * cos + y * sin, y * cos - x * sin]
    };
    for cycle in 0..plan.cycles.len() {
        let row = |code: &str| {
            plan.results
                .iter()
                .find(|r| r.cycle == cycle && r.code == code)
        };
        for (x, y) in [("center.x", "center.y"), ("corner.x", "corner.y")] {
            let (Some(x), Some(y)) = (row(x), row(y)) else {
                continue;
            };
            let (Some(tx), Some(ty), Some(nx), Some(ny)) = (x.truth, y.truth, x.nominal, y.nominal)
            else {
                continue;
            };
            let [ax, ay] = reads([tx, ty]);
            // The interpreter prints the rotation with four decimals.
            let near = 2e-4 + 1e-6 * nx.hypot(ny);
            assert!(
                (ax - nx).abs() < near && (ay - ny).abs() < near,
                "{said}: {} reads {ax} {ay}, not {nx} {ny}",
                plan.cycles[cycle]
            );
        }
    }
    if written("offset.z") {
        let top = plan
            .results
            .iter()
            .find(|row| row.code == "point.z")
            .and_then(|row| row.value)
            .unwrap();
        let nominal = plan
            .results
            .iter()
            .find(|row| row.code == "point.z")
            .and_then(|row| row.nominal)
            .unwrap();
        assert!((top - origin[2] - nominal).abs() < 1e-6, "{said}");
    }
}

#[test]
fn after_the_write_the_vise_is_where_the_drawing_says() {
    let vise = job(VISE);
    let plan = planned(&vise);
    assert_eq!(plan.program.writes, ["X", "Y", "Z", "rotation"]);
    probing_again_reads_nominal(&vise, "vise");
    // By hand: the bore of the drawing is at the origin, so it is found at the part's shift.
    let offset = |code: &str| {
        plan.results
            .iter()
            .find(|row| row.code == code)
            .and_then(|row| row.value)
            .unwrap()
    };
    for (code, wanted) in [
        ("offset.x", 0.3),
        ("offset.y", -0.2),
        ("offset.z", 0.15),
        ("offset.rotation", 0.4),
    ] {
        assert!(
            (offset(code) - wanted).abs() < 1e-5,
            "{code}: {}",
            offset(code)
        );
    }
}

/// Two to six cycles in any order, on a slightly displaced part.
#[test]
fn random_set_ups_are_written_where_their_part_is() {
    let found = [
        "hole",
        "hole-protected",
        "boss",
        "double-wall-internal-corner",
        "double-wall-external-corner",
        "surface",
    ];
    let mut draws = Draws(2026);
    let (mut turned, mut together) = (0, 0);
    for round in 0..24 {
        let count = 2 + draws.below(5);
        let cycles: Vec<Value> = (0..count)
            .map(|i| {
                // A point in the plane for the write, and a direction for the rotation.
                let key = match i {
                    0 => found[draws.below(3)],
                    1 => found[3 + draws.below(2)],
                    _ => found[draws.below(found.len())],
                };
                let one = cycle(key, 0.0);
                let at = [
                    250.0 * i as f64 + draws.of(-10.0, 10.0),
                    draws.of(-40.0, 40.0),
                    draws.of(-3.0, 3.0),
                ];
                let at = at
                    .map(|x| Value::Number((x * 1000.0).round() / 1000.0))
                    .to_vec();
                let one = with(&one, "origin", Value::List(at));
                let counted = with(
                    &with(&one, "count1", Value::Number(2.0)),
                    "count2",
                    Value::Number(2.0),
                );
                if key.starts_with("double") {
                    counted
                } else {
                    one
                }
            })
            .collect();
        let turns = draws.next() < 0.5;
        let rotation = if turns {
            r#"{ "rotation": "CORNER.rotation" }"#
        } else {
            "{}"
        };
        let part = if turns { draws.of(-0.15, 0.15) } else { 0.0 };
        let names: Vec<&str> = (0..count)
            .map(|i| ["FIRST", "CORNER", "C", "D", "E", "F"][i])
            .collect();
        let cycles = cycles
            .into_iter()
            .zip(&names)
            .map(|(one, name)| with(&one, "name", Value::Text((*name).to_owned())));
        let text = format!(
            r#"{{ "format": 2, "control": {{ "post": "linuxcnc", "workOffset": {} }}, "datum": {rotation}, "limits": {{ "size": null, "residual": null }},
            "part": {{ "offset": [{:.4}, {:.4}, {:.4}], "rotation": {part:.5} }}, "cycles": [] }}"#,
            1 + draws.below(9),
            draws.of(-0.4, 0.4),
            draws.of(-0.4, 0.4),
            draws.of(-0.3, 0.3)
        );
        let whole = with(&job(&text), "cycles", Value::List(cycles.collect()));
        probing_again_reads_nominal(&whole, &format!("round {round}"));
        turned += usize::from(turns);
        together += count;
    }
    assert!(turned > 5 && together > 60, "{turned} {together}");
}

/// A Fanuc's work offset has no rotation: its program states the block that rotates the system, about the written position.
#[test]
fn a_control_without_a_rotation_says_the_block_for_it() {
    let text = VISE.replace("linuxcnc", "fanuc").replace(
        "\"diameter\": 25",
        "\"origin\": [12, -7, 0], \"diameter\": 25",
    );
    let plan = planned(&job(&text));
    assert_eq!(plan.program.writes, ["X", "Y", "Z"]);
    let block = plan
        .program
        .text
        .lines()
        .find(|line| line.contains("G68 X"))
        .expect("a block");
    let register = block.rsplit('R').next().unwrap().trim_end_matches(')');
    assert!(block.contains("G68 X12. Y-7. R#1"), "{block}");
    // The last value computed for it is the rotation.
    let last = plan
        .program
        .text
        .lines()
        .rfind(|line| line.starts_with(&format!("{register}=")))
        .unwrap();
    assert!(last.contains('#'), "{last}");
    assert!(
        plan.findings
            .iter()
            .any(|f| f.code == "rotation-not-written")
    );
}

/// The stated block is run after its program: in the written and rotated system each feature of the drawing is at its position on the part. By hand: the part
/// is shifted by 0.3 and -0.2 and rotated by 0.4° about the old origin.
#[test]
fn the_block_of_the_rotation_puts_the_drawing_on_the_part() {
    for post in skipping() {
        let text = VISE.replace("linuxcnc", post).replace(
            "\"diameter\": 25",
            "\"origin\": [12, -7, 0], \"diameter\": 25",
        );
        let plan = planned(&job(&text));
        let mut control = Control::new(post == "haas", false);
        control.contacts = plan.triggers.iter().flatten().copied().collect();
        // G54 was 0.
        for axis in 0..3 {
            control.variables.insert(5221 + axis, 0.0);
        }
        control.run(&plan.program.text).unwrap();
        assert_eq!(control.alarm, None);
        let block = plan
            .program
            .text
            .lines()
            .find_map(|line| line.split_once("G68 X"))
            .expect("a block")
            .1;
        let mut words = block
            .trim_end_matches(')')
            .split([' ', 'Y', 'R'])
            .filter(|word| !word.is_empty());
        let [cx, cy] = [(); 2].map(|()| words.next().unwrap().parse::<f64>().unwrap());
        let register = words
            .next()
            .unwrap()
            .trim_start_matches('#')
            .parse::<i64>()
            .unwrap();
        let turn = control.variables[&register].to_radians();
        let origin = [5221, 5222, 5223].map(|variable| control.variables[&variable]);
        let turned = |[x, y]: [f64; 2], angle: f64, [cx, cy]: [f64; 2]| {
            let ((sin, cos), dx, dy) = (angle.sin_cos(), x - cx, y - cy);
            [cx + dx * cos - dy * sin, cy + dx * sin + dy * cos]
        };
        for place in [[12.0, -7.0], [80.0, 10.0], [-30.0, 0.0]] {
            let [x, y] = turned(place, turn, [cx, cy]);
            let [ax, ay] = turned(place, 0.4f64.to_radians(), [0.0; 2]);
            let off = [x + origin[0] - (ax + 0.3), y + origin[1] - (ay - 0.2)];
            assert!(
                off.iter().all(|off| off.abs() < 3e-3),
                "{post} {place:?}: {off:?}"
            );
        }
        assert!((origin[2] - 0.15).abs() < 2e-3, "{post}: {origin:?}");
    }
}

/// By hand: two touches 60 apart on a part that is rotated by half a degree; a scatter of 1 µm per touch is √2 µm over 60 mm.
#[test]
fn the_angle_of_a_wall_turns_the_work_offset() {
    let text = r#"{ "format": 1, "control": { "post": "linuxcnc", "workOffset": 3 }, "cycle": { "type": "wall-angle", "origin": [5, 9, -4], "rotation": 90, "distance": 60 },
        "part": { "rotation": 0.5 } }"#;
    let plan = planned(&job(text));
    assert_eq!(
        plan.touches.iter().map(|t| t.point).collect::<Vec<_>>(),
        [[35.0, 9.0, -4.0], [-25.0, 9.0, -4.0]]
    );
    let row = &plan.results[0];
    assert_eq!(
        (row.code.as_str(), row.nominal, row.truth),
        ("rotation", Some(90.0), Some(90.5))
    );
    assert!((row.value.unwrap() - 90.5).abs() < 1e-9, "{row:?}");
    let sigma = (0.001 * std::f64::consts::SQRT_2 / 60.0).to_degrees();
    assert!(
        (row.uncertainty.unwrap() - sigma).abs() < 1e-3 * sigma,
        "{row:?}"
    );
    assert_eq!(plan.program.writes, ["rotation"]);
    let ran = interpret(&on_the_part(&plan)).unwrap();
    assert!(
        (ran.rotations_after_moves[0] - 0.5).abs() < 1e-4,
        "{:?}",
        ran.rotations_after_moves
    );
}

/// The header contains the whole set-up: a program is read back as its job, on every control.
#[test]
fn a_program_is_its_set_up_again() {
    let keys = [
        "surface",
        "hole-protected",
        "web",
        "double-wall-external-corner",
    ];
    for post in of_moves() {
        let whole = set_up(post, &keys);
        let whole = with(
            &with(&whole, "clear", Value::Number(60.5)),
            "name",
            Value::Text("FOUR".to_owned()),
        );
        let plan = planned(&whole);
        let read =
            import(&plan.program.text).unwrap_or_else(|e| panic!("{post}: {:#?}", e.findings));
        let differs = read
            .findings
            .iter()
            .find(|f| f.code != "part-not-in-program");
        assert!(differs.is_none(), "{post}: {differs:?}");
        let again = planned(&read.job);
        assert_eq!(again.program.text, plan.program.text, "{post}");
        assert_eq!(
            read.job
                .get("cycles")
                .map(|c| matches!(c, Value::List(l) if l.len() == 4)),
            Some(true)
        );
        // A changed digit is found in any cycle.
        let changed = plan.program.text.replacen("60.5", "59.5", 2);
        assert_ne!(changed, plan.program.text, "{post}");
        let read = import(&changed).unwrap_or_else(|e| panic!("{post}: {:#?}", e.findings));
        assert!(
            read.findings
                .iter()
                .any(|f| f.code == "program-differs" || f.code == "unsafe-program"),
            "{post}"
        );
    }
}

/// The print-out of a set-up gives its results, and so do its points.
#[test]
fn a_set_up_is_evaluated_from_points_and_from_what_it_prints() {
    let vise = job(VISE);
    let plan = planned(&vise);
    let points = plan
        .triggers
        .iter()
        .map(|t| Value::List(t.unwrap().map(Value::Number).to_vec()))
        .collect();
    let rows = evaluate(&vise, &Value::List(points)).unwrap();
    assert_eq!(rows.len(), plan.results.len());
    for (a, b) in rows.iter().zip(&plan.results) {
        assert_eq!(
            (a.cycle, &a.code, a.uncertainty),
            (b.cycle, &b.code, b.uncertainty)
        );
        assert!(a.value.unwrap_or(0.0) - b.value.unwrap_or(0.0) < 1e-9);
    }
    let printed: String = plan
        .results
        .iter()
        .filter(|row| !row.code.starts_with("offset."))
        .map(|row| {
            format!(
                "{}.{}={:.6}\n",
                plan.cycles[row.cycle],
                row.code,
                row.value.unwrap()
            )
        })
        .collect();
    let rows = evaluate(&vise, &Value::Text(printed)).unwrap();
    let turn = rows
        .iter()
        .find(|row| row.code == "offset.rotation")
        .and_then(|row| row.value)
        .unwrap();
    assert!((turn - 0.4).abs() < 1e-5, "{turn}");
}

/// Converted to inch and back, a set-up is the same, with its sizes and its height.
#[test]
fn a_set_up_in_inch_is_the_same() {
    let vise = with(&job(VISE), "clear", Value::Number(50.8));
    let vise = with(&vise, "part.sizes", job(r#"{ "BORE.diameter": 0.254 }"#));
    let inch = touchpath::job::convert_units(&vise, "inch").unwrap();
    assert_eq!(inch.get("clear"), Some(&Value::Number(2.0)));
    assert_eq!(
        inch.get("part").and_then(|p| p.get("sizes")),
        Some(&job(r#"{ "BORE.diameter": 0.01 }"#))
    );
    let [mm, other] = [&vise, &inch].map(planned);
    for (a, b) in mm.results.iter().zip(&other.results) {
        let scale = if a.unit == "deg" { 1.0 } else { 25.4 };
        let (a, b) = (a.value.unwrap(), b.value.unwrap() * scale);
        assert!((a - b).abs() < 2e-4, "{a} {b}");
    }
    let diameter = mm
        .results
        .iter()
        .find(|row| row.code == "diameter")
        .unwrap();
    assert!((diameter.value.unwrap() - 25.254).abs() < 1e-5);
}

/// The same for native cycles: the path of each equals that of a job with one cycle, and results that the next one clears are saved.
#[test]
fn cycles_of_the_controls_own_stand_in_one_program() {
    let own = |job: &Value| {
        with(
            &with(job, "control.form", Value::Text("cycle".to_owned())),
            "control.workOffset",
            Value::Null,
        )
    };
    let mut seen = 0;
    for post in calling() {
        let taken = |key: &&str| touchpath::job::plan(&own(&alone(post, key, 0.0))).is_ok();
        let keys: Vec<&str> = measuring()
            .into_iter()
            .filter(|key| *key != "probing-two-circles")
            .filter(taken)
            .collect();
        for (i, first) in keys.iter().enumerate() {
            let pair = [*first, keys[(i + 1) % keys.len()]];
            let job = own(&set_up(post, &pair));
            let plan = planned(&job);
            assert!(plan.program.own, "{post} {pair:?}");
            // Higher link moves change nothing but themselves: a SINUMERIK's exit must lift to their height.
            let higher = planned(&with(&job, "clear", Value::Number(120.0)));
            assert_eq!(higher.touches.len(), plan.touches.len(), "{post} {pair:?}");
            // The judges of the others are for programs of moves.
            if !of_moves().contains(&post) {
                crate::common::owed::judge(post).unwrap()(&plan)
                    .unwrap_or_else(|why| panic!("{post} {pair:?}: {why}"));
            }
            let mut places: Vec<&str> = Vec::new();
            for (cycle, key) in pair.into_iter().enumerate() {
                let single = planned(&own(&alone(post, key, 300.0 * cycle as f64)));
                let moves = plan.moves.iter().filter(|m| m.cycle == cycle && m.step > 0);
                // A TNC's cycle retracts to the height of the next link move: its touches are the same.
                let lifts = find(post)
                    .unwrap()
                    .own
                    .is_some_and(|own| own.several.links_itself);
                let compared = |m: &&Move| !lifts || m.kind == "touch";
                let (moves, alone) = (moves.filter(compared), single.moves.iter().filter(compared));
                let same = moves
                    .zip(alone)
                    .filter(|(a, b)| (a.to, a.kind, &a.arc) == (b.to, b.kind, &b.arc))
                    .count();
                assert_eq!(
                    same,
                    single.moves.iter().filter(compared).count(),
                    "{post} {pair:?} {cycle}"
                );
                let rows = |plan: &Plan, cycle: usize| -> Vec<_> {
                    let rows = plan.results.iter().filter(|row| row.cycle == cycle);
                    rows.map(|row| {
                        (
                            row.code.clone(),
                            row.value,
                            row.truth,
                            row.uncertainty,
                            row.stored.is_some(),
                        )
                    })
                    .collect()
                };
                assert_eq!(rows(&plan, cycle), rows(&single, 0), "{post} {pair:?}");
                places.extend(
                    plan.results
                        .iter()
                        .filter(|row| row.cycle == cycle)
                        .filter_map(|row| row.stored.as_deref()),
                );
                seen += 1;
            }
            // No two results are at one position.
            let mut apart = places.clone();
            apart.sort_unstable();
            apart.dedup();
            assert_eq!(apart.len(), places.len(), "{post} {pair:?}: {places:?}");
            the_ways_between_are_clear(&plan, &format!("{post} {pair:?}"));
        }
    }
    assert!(seen > 120, "{seen}");
}

/// They write right after measuring: the last one may, an earlier one is refused with the reason.
#[test]
fn of_the_controls_own_cycles_the_last_one_writes() {
    let text = |datum: &str| {
        format!(
            r#"{{ "format": 2, "control": {{ "post": "haas", "form": "cycle", "workOffset": 1 }}, "datum": {datum}, "part": {{ "offset": [0.1, 0.2, 0.3] }},
            "cycles": [{{ "name": "TOP", "type": "surface", "origin": [-60, 0, 0] }}, {{ "name": "BORE", "type": "hole" }}] }}"#
        )
    };
    let plan = planned(&job(&text("{}")));
    assert_eq!(plan.program.writes, ["X", "Y"]);
    let calls: Vec<&str> = plan
        .program
        .text
        .lines()
        .filter(|line| line.starts_with("G65") && line.contains(" S"))
        .collect();
    assert_eq!(calls, ["G65 P9814 D40. Q2. H0.5 S1."]);
    let kept: Vec<&str> = plan
        .program
        .text
        .lines()
        .filter(|line| line.starts_with("#10"))
        .collect();
    assert_eq!(kept, ["#101=#185", "#102=#186", "#103=#187"]);
    let refused = touchpath::job::plan(&job(&text(r#"{ "z": "TOP.point.z" }"#))).unwrap_err();
    assert_eq!(
        (
            refused.findings[0].code.as_str(),
            refused.findings[0].path.as_str()
        ),
        ("set-up-unsupported", "datum")
    );
    // A TNC's cycle writes a row of the table, which another block activates.
    let datum = r#"{ "z": null }"#;
    let klartext = planned(&job(&text(datum).replace("haas", "heidenhain")));
    assert_eq!(klartext.program.writes, ["X", "Y"]);
    let blocks = klartext
        .program
        .text
        .lines()
        .filter_map(|line| line.split_once(' ').map(|(_, block)| block));
    let blocks: Vec<&str> = blocks
        .filter(|block| {
            ["TCH", "FN", "CYCL"]
                .iter()
                .any(|word| block.starts_with(word))
        })
        .collect();
    let expected = [
        "TCH PROBE 427 MEASURE COORDINATE ~",
        "FN 0: Q1600 = +Q160",
        "TCH PROBE 412 DATUM INSIDE CIRCLE ~",
        "CYCL DEF 247 DATUM SETTING ~",
    ];
    assert_eq!(blocks, expected);
    let two_circles = text("{}")
        .replace("haas", "heidenhain")
        .replace("\"hole\"", "\"probing-two-circles\"");
    let refused = touchpath::job::plan(&job(
        &two_circles.replace("\"workOffset\": 1", "\"workOffset\": null")
    ))
    .unwrap_err();
    assert_eq!(
        (
            refused.findings[0].code.as_str(),
            refused.findings[0].path.as_str()
        ),
        ("set-up-unsupported", "cycles[1].type")
    );
}

/// By hand: a part that is shifted by 0.3 and -0.2 and rotated by 0.4° about its origin moves the origin by exactly that, for any position of the bore; scatter
/// of the direction moves an origin that is 112 mm away.
#[test]
fn a_shift_beside_a_rotation_is_that_of_the_origin() {
    let text = r#"{ "format": 2, "control": { "post": "linuxcnc", "workOffset": 1 }, "datum": { "rotation": "SIDE.rotation" },
        "cycles": [{ "name": "BORE", "type": "hole", "diameter": 25, "origin": [100, 50, 0] }, { "name": "SIDE", "type": "wall-angle", "origin": [0, -45, -8], "rotation": -90 }],
        "part": { "offset": [0.3, -0.2, 0], "rotation": 0.4 } }"#;
    let plan = planned(&job(text));
    let row = |code: &str| plan.results.iter().find(|row| row.code == code).unwrap();
    for (code, value) in [
        ("offset.x", 0.3),
        ("offset.y", -0.2),
        ("offset.rotation", 0.4),
    ] {
        assert!(
            (row(code).value.unwrap() - value).abs() < 1e-5
                && (row(code).truth.unwrap() - value).abs() < 1e-9,
            "{:?}",
            row(code)
        );
    }
    let (center, turn) = (
        row("center.x").uncertainty.unwrap(),
        row("offset.rotation").uncertainty.unwrap(),
    );
    assert!(
        (row("offset.x").uncertainty.unwrap() - center.hypot(50.0 * turn.to_radians())).abs()
            < 1e-12
    );
    assert!(
        (row("offset.y").uncertainty.unwrap()
            - row("center.y")
                .uncertainty
                .unwrap()
                .hypot(100.0 * turn.to_radians()))
        .abs()
            < 1e-12
    );
    probing_again_reads_nominal(&job(text), "a bore far off");
}

/// Cycles without a name are named after their feature, each uniquely.
#[test]
fn names_that_nobody_gave_are_free() {
    let cycle = |name: &str, x: f64| {
        format!(r#"{{ "type": "hole", "diameter": 20, "origin": [{x}, 0, 0]{name} }}"#)
    };
    let named = |names: [&str; 4]| {
        let cycles: Vec<String> = names
            .iter()
            .enumerate()
            .map(|(i, name)| cycle(name, 60.0 * i as f64))
            .collect();
        planned(&job(&format!(
            r#"{{ "format": 2, "cycles": [{}] }}"#,
            cycles.join(", ")
        )))
        .cycles
    };
    assert_eq!(
        named(["", "", "", r#", "name": "BORE2""#]),
        ["BORE", "BORE3", "BORE4", "BORE2"]
    );
    assert_eq!(
        named(["", r#", "name": "bore""#, "", ""]),
        ["BORE2", "bore", "BORE3", "BORE4"]
    );
    assert_eq!(named(["", "", "", ""]), ["BORE", "BORE2", "BORE3", "BORE4"]);
}

/// A wall that faces half a turn away: no result is a full turn off.
#[test]
fn the_angle_of_a_wall_at_half_a_turn_is_true() {
    for (rotation, turn) in [
        (180.0, 0.4),
        (180.0, -0.4),
        (-180.0, 0.4),
        (-180.0, -0.4),
        (540.0 - 360.0, 0.1),
    ] {
        let text = format!(
            r#"{{ "format": 1, "cycle": {{ "type": "wall-angle", "rotation": {rotation} }}, "part": {{ "rotation": {turn} }} }}"#
        );
        let plan = planned(&job(&text));
        let row = &plan.results[0];
        assert!(
            (row.value.unwrap() - row.truth.unwrap()).abs() < 1e-6,
            "{row:?}"
        );
        assert!((row.deviation.unwrap() - turn).abs() < 1e-6, "{row:?}");
        assert!(
            plan.findings.iter().all(|f| f.code != "result-untrue"),
            "{rotation} {turn}"
        );
    }
}
