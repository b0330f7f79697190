//! Faults that no test found when they were inserted. Each has a test now.

use crate::common::import;
use crate::common::{interpret, interpret_from, job, number, planned, point, with};
use touchpath::describe::export_table;
use touchpath::form::{Level, Value};
use touchpath::job::{check, default_job, evaluate, plan};

fn text(t: &str) -> Value {
    Value::Text(t.to_owned())
}

fn codes(job: &Value) -> Vec<String> {
    check(job)
        .into_iter()
        .filter(|f| f.level != Level::Info)
        .map(|f| f.code)
        .collect()
}

/// The numbers of a block by their letters.
fn words(line: &str) -> Vec<(char, f64)> {
    line.split(' ')
        .skip(1)
        .filter_map(|w| Some((w.chars().next()?, w[1..].parse().ok()?)))
        .collect()
}

/// With different rotations in G54 and in the written offset, the rotation of the written one is corrected.
#[test]
fn the_rotation_of_the_offset_that_is_written_counts() {
    let job = job(
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles", "confirmRotation": 1, "transferPosition": 1 },
        "control": { "post": "linuxcnc", "form": "moves", "workOffset": 3, "protection": "none" }, "part": { "rotation": 0.5 } }"#,
    );
    let plan = planned(&job);
    let before = format!(
        "G21\nG10 L2 P1 R40\nG10 L2 P3 R25\nG56\n{}",
        plan.program.text
    );
    let mut lines: Vec<String> = before.lines().map(str::to_owned).collect();
    for (index, step) in plan
        .moves
        .iter()
        .enumerate()
        .filter(|(_, m)| m.kind == "touch")
    {
        let [x, y, z] = plan.triggers[step.touch.unwrap()].unwrap();
        lines[plan.program.move_lines[index] as usize + 4] =
            format!("G38.2 X{x:.9} Y{y:.9} Z{z:.9} F300");
    }
    let ran = interpret(&(lines.join("\n") + "\n")).unwrap();
    assert!(
        (ran.rotation.unwrap() - 25.5).abs() < 2e-4,
        "{:?}",
        ran.rotation
    );
}

#[test]
fn measured_text_is_in_the_jobs_units() {
    let inch =
        job(r#"{ "format": 1, "units": "inch", "cycle": { "type": "internal-rectangle" } }"#);
    let plan = planned(&inch);
    let list: Vec<[f64; 3]> = plan.triggers.iter().map(|t| t.unwrap()).collect();
    let lines: Vec<String> = list
        .iter()
        .map(|p| format!("{}, {}, {}", p[0], p[1], p[2]))
        .collect();
    let from_text = evaluate(&inch, &Value::Text(lines.join("\n"))).unwrap();
    let from_list = evaluate(
        &inch,
        &Value::List(list.iter().map(|p| point(*p)).collect()),
    )
    .unwrap();
    assert_eq!(from_text, from_list);
    let width = from_text
        .iter()
        .find(|r| r.code == "width1")
        .unwrap()
        .value
        .unwrap();
    assert!((width * 25.4 - 80.0).abs() < 1e-9, "{width}");
    // In the notation of objects, small letters and capitals.
    for keys in [["x", "y", "z"], ["X", "Y", "Z"]] {
        let objects = list
            .iter()
            .map(|p| {
                Value::Map(
                    keys.iter()
                        .zip(p)
                        .map(|(k, x)| ((*k).to_owned(), number(*x)))
                        .collect(),
                )
            })
            .collect();
        assert_eq!(
            evaluate(&inch, &Value::List(objects)).unwrap(),
            from_list,
            "{keys:?}"
        );
    }
}

#[test]
fn the_tool_axis_of_klartext_is_the_planes() {
    for (plane, axis) in [("G17", "Z"), ("G18", "Y"), ("G19", "X")] {
        let job = with(
            &default_job("probing-two-circles").unwrap(),
            "plane",
            text(plane),
        );
        let job = with(&job, "cycle.start", point([100.0; 3]));
        let call = format!("TOOL CALL 12 {axis} S50");
        assert!(
            planned(&with(&job, "control.tool", number(12.0)))
                .program
                .text
                .contains(&call),
            "{plane}"
        );
        assert!(
            planned(&job)
                .program
                .text
                .replace("\n", " ")
                .contains(&format!("tool axis {axis}.")),
            "{plane}"
        );
    }
}

/// Half of the last decimal: 4 in mm, 5 in inch.
#[test]
fn a_program_keeps_every_decimal() {
    for (units, decimals) in [("mm", 4), ("inch", 5)] {
        for post in crate::tests::controls::of_moves() {
            let job = job(&format!(
                r#"{{ "format": 1, "units": "{units}", "cycle": {{ "type": "boss", "origin": [1.2345678, -2.3456789, 0.1234567], "rotation": 17 }},
                "control": {{ "post": "{post}" }} }}"#
            ));
            let plan = planned(&job);
            let mut worst: f64 = 0.0;
            for (i, step) in plan
                .moves
                .iter()
                .enumerate()
                .filter(|(_, m)| m.kind == "position")
                .skip(1)
            {
                let line = plan
                    .program
                    .text
                    .lines()
                    .nth(plan.program.move_lines[i] as usize)
                    .unwrap();
                for (letter, written) in words(line.trim_start_matches("MEAS=1 ")) {
                    if let Some(axis) = ['X', 'Y', 'Z'].iter().position(|l| *l == letter) {
                        worst = worst.max((written - step.to[axis]).abs());
                    }
                }
            }
            let last = 10f64.powi(-decimals);
            assert!(
                worst <= last / 2.0 + 1e-12 && worst > last / 20.0,
                "{units} {post}: {worst}"
            );
        }
    }
}

fn arcs(extra: &str) -> Value {
    job(&format!(
        r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles", "geometryType": 1, "clearanceHeightMode": 1 {extra} }},
        "control": {{ "post": "linuxcnc", "form": "moves", "protection": "none" }} }}"#
    ))
}

/// Without FMAX an arc runs at F, the feed of the touches; its time counts at that feed, over its length.
#[test]
fn arcs_run_at_the_feed_of_the_touches() {
    for post in ["linuxcnc", "grbl"] {
        let plan = planned(&with(&arcs(""), "control.post", text(post)));
        let mut count = 0;
        for (i, step) in plan
            .moves
            .iter()
            .enumerate()
            .filter(|(_, m)| m.arc.is_some())
        {
            let line = plan
                .program
                .text
                .lines()
                .nth(plan.program.move_lines[i] as usize)
                .unwrap();
            assert!(line.starts_with("G3 ") && line.ends_with(" F300"), "{line}");
            // A quarter of the circle of the stand-off: 10 + 2 + 3.
            assert_eq!(step.arc.as_ref().unwrap().sweep, 90.0);
            count += 1;
        }
        assert_eq!(count, 6);
        // By hand: every move at its feed, rapids at 5000, quarter circles at 300.
        let (mut length, mut time, mut at) = (0.0, 0.0, [0.0, 0.0, 100.0]);
        for step in &plan.moves {
            let straight = (0..3)
                .map(|i| (step.to[i] - at[i]).powi(2))
                .sum::<f64>()
                .sqrt();
            let way = if step.arc.is_some() {
                15.0 * std::f64::consts::FRAC_PI_2
            } else {
                straight
            };
            let down = post == "grbl" && step.to[2] < at[2] - 1e-6;
            length += way;
            time += way
                / if step.arc.is_some() || step.feed == "work" || down {
                    300.0
                } else {
                    5000.0
                };
            at = step.to;
        }
        assert!(
            (plan.length - length).abs() < 1e-6,
            "{post}: {} {length}",
            plan.length
        );
        assert!(
            (plan.time - time).abs() < 1e-9,
            "{post}: {} {time}",
            plan.time
        );
    }
    let stated = planned(&arcs(r#", "probe": { "rapid": 1234 }"#));
    assert!(
        stated
            .program
            .text
            .lines()
            .filter(|l| l.starts_with("G3 "))
            .all(|l| l.ends_with(" F1234"))
    );
}

/// Three touches per point, each at another position: the program computes with their mean.
#[test]
fn the_mean_of_three_touches_is_a_third_of_their_sum() {
    for points in [2, 3, 4] {
        let job = job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles", "extrusion": {{ "points": {points}, "length": -6 }} }},
            "limits": {{ "size": null, "angle": null, "residual": null }}, "control": {{ "post": "linuxcnc", "form": "moves" }} }}"#
        ));
        let plan = planned(&job);
        let mut lines: Vec<String> = plan.program.text.lines().map(str::to_owned).collect();
        let mut measured = Vec::new();
        for (index, step) in plan
            .moves
            .iter()
            .enumerate()
            .filter(|(_, m)| m.kind == "touch")
        {
            let k = step.touch.unwrap();
            let off = 0.01 * (k % points) as f64 + 0.003 * (k / points) as f64;
            let p = [0, 1, 2].map(|i| step.to[i] - off * plan.touches[k].vector[i]);
            lines[plan.program.move_lines[index] as usize] =
                format!("G38.2 X{:.9} Y{:.9} Z{:.9} F300", p[0], p[1], p[2]);
            measured.push(p);
        }
        let ran = interpret_from(&(lines.join("\n") + "\n"), &job).unwrap();
        // By hand: each point is the mean of its touches; for four points of a circle the diameter is the distance of opposite ones.
        let mean = |k: usize| {
            let own = &measured[k * points..(k + 1) * points];
            [0, 1].map(|i| own.iter().map(|p| p[i]).sum::<f64>() / points as f64)
        };
        let printed = |code: &str| ran.prints.iter().find(|(c, _)| c == code).unwrap().1;
        let (x, y) = (
            (mean(0)[0] + mean(2)[0]) / 2.0,
            (mean(1)[1] + mean(3)[1]) / 2.0,
        );
        assert!(
            (printed("Q950") - x).abs() < 1e-4 && (printed("Q951") - y).abs() < 1e-4,
            "{points}: {x} {y} {:?}",
            ran.prints
        );
        let shown = evaluate(
            &job,
            &Value::List(measured.iter().map(|p| point(*p)).collect()),
        )
        .unwrap();
        for (code, printed) in &ran.prints {
            let wanted = shown
                .iter()
                .find(|r| r.code == *code)
                .unwrap()
                .value
                .unwrap();
            assert!(
                (wanted - printed).abs() < 2e-6,
                "{points} {code}: {printed} {wanted}"
            );
        }
    }
}

/// A pocket of 80 by 50, rotated by 45°: along X the ball touches a wall of the other pair, 22·√2 from the centre.
#[test]
fn a_touch_that_meets_another_wall_is_reported() {
    let pocket = |turn: f64| {
        job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "internal-rectangle" }}, "part": {{ "rotation": {turn} }} }}"#
        ))
    };
    let plan = planned(&pocket(45.0));
    let strays: Vec<&str> = plan
        .findings
        .iter()
        .filter(|f| f.code == "wrong-wall")
        .map(|f| f.message.as_str())
        .collect();
    assert_eq!(strays.len(), 2, "{:?}", plan.findings);
    assert!(
        strays[0].contains("Touch 1 is meant for wall 1 and contacts wall 4 first"),
        "{}",
        strays[0]
    );
    assert!(
        (plan.triggers[0].unwrap()[0] - 22.0 * 2f64.sqrt()).abs() < 1e-9,
        "{:?}",
        plan.triggers[0]
    );
    assert!(!codes(&pocket(5.0)).contains(&"wrong-wall".to_owned()));
}

/// The first touch projects onto its wall, yet the ball reaches the other wall before it: 14.2 + 12·cos 160° = 2.92 is less than the radius of 3.
#[test]
fn the_ball_meets_the_corners_other_wall_first() {
    let corner = |kind: &str, clearance: f64| {
        job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "{kind}", "angle": 160, "clearance1": 15, "clearance2": {clearance} }} }}"#
        ))
    };
    for kind in ["double-wall-internal-corner", "triple-wall-internal-corner"] {
        let finding = check(&corner(kind, 14.2))
            .into_iter()
            .find(|f| f.level == Level::Error)
            .unwrap();
        assert_eq!(
            (finding.code.as_str(), finding.path.as_str()),
            ("touch-beyond-corner", "cycle.clearance2"),
            "{kind}"
        );
        assert!(
            finding.message.contains("contact wall 2 first"),
            "{}",
            finding.message
        );
        assert!(plan(&corner(kind, 15.5)).is_ok(), "{kind}");
    }
}

#[test]
fn a_sinumerik_program_that_was_cut_is_reported() {
    let job = job(
        r#"{ "format": 1, "cycle": { "type": "hole" }, "control": { "post": "sinumerik", "workOffset": 2 } }"#,
    );
    let program = planned(&job).program.text;
    let lines: Vec<&str> = program.lines().collect();
    let header = lines.iter().position(|l| l.starts_with("DEF")).unwrap();
    for end in (header..lines.len()).step_by(3) {
        let cut = import(&(lines[..end].join("\n") + "\n")).unwrap();
        let differs = cut
            .findings
            .iter()
            .find(|f| f.code == "program-differs")
            .unwrap_or_else(|| panic!("cut at {end}"));
        assert!(
            differs.message.contains("end of the program is missing"),
            "{}",
            differs.message
        );
    }
    let longer = import(&format!("{program}G1 X5 F100\n")).unwrap();
    assert!(longer.findings.iter().any(|f| f.code == "program-differs"));
}

#[test]
fn the_safe_range_of_cycle977_is_no_longer_than_its_path() {
    for (overtravel, safe) in [(12.0, "5,5,0,"), (5.0, "5,5,0,"), (2.5, "5,2.5,0,")] {
        let job = job(&format!(
            r#"{{ "format": 1, "overtravel": {overtravel}, "cycle": {{ "type": "internal-rectangle-protected" }},
            "control": {{ "post": "sinumerik", "form": "cycle" }} }}"#
        ));
        assert!(
            planned(&job)
                .program
                .text
                .contains(&format!("80,50,{safe}")),
            "{overtravel}"
        );
    }
}

/// The part is so low that the ball touches the rim of its hole, 1 below the ball centre, instead of the wall.
#[test]
fn the_rim_of_a_hole_is_not_its_wall() {
    let hole = |z: f64| {
        job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "hole" }}, "part": {{ "offset": [0, 0, {z}] }} }}"#
        ))
    };
    assert_eq!(codes(&hole(-9.9)), [""; 0]);
    assert_eq!(
        codes(&hole(-11.0))
            .iter()
            .filter(|c| *c == "edge-contact")
            .count(),
        4,
        "{:?}",
        check(&hole(-11.0))
    );
    // 20 - √(3² − 1²) from the axis.
    let trigger = planned(&hole(-11.0)).triggers[0].unwrap();
    assert!(
        (trigger[0] - (20.0 - 8f64.sqrt())).abs() < 1e-9,
        "{trigger:?}"
    );
}

#[test]
fn a_dump_that_fits_two_planes_says_so() {
    let planes = |kind: &str, vector: [f64; 3]| {
        let mut job = default_job(kind).unwrap();
        if kind == "surface" {
            let touch = Value::Map(vec![
                ("point".to_owned(), point([1.0, 2.0, 3.0])),
                ("vector".to_owned(), point(vector)),
            ]);
            job = with(&job, "cycle.touches", Value::List(vec![touch]));
        }
        let imported = import(&export_table(&planned(&job), "csv").unwrap()).unwrap();
        imported
            .findings
            .into_iter()
            .find(|f| f.code == "plane-unknown")
            .map(|f| f.message)
    };
    // A side surface exists in each plane whose tool axis it does not face.
    let message = planes("surface", [1.0, 0.0, 0.0]).expect("X lies in G17, G18 and G19");
    assert!(
        message.contains("G17") && message.contains("G18"),
        "{message}"
    );
    assert_eq!(planes("boss", [0.0; 3]), None);
}

#[test]
fn of_a_q_given_twice_the_last_counts() {
    let program = "0 BEGIN PGM A MM\n1 TCH PROBE 1411 ~\nQ1116=+5 ~\nQ1100=-30 Q1101=+0 Q1102=-10 Q1103=+30 Q1104=+0 Q1105=-10 Q1117=+20 ~\nQ1116=+12.5\n2 END PGM A MM\n";
    assert_eq!(
        crate::common::number_at(&import(program).unwrap().job, "cycle.diameter1", 0.0),
        12.5
    );
}

#[test]
fn typographic_minus_signs_are_minus_signs() {
    for minus in ['-', '\u{2212}', '\u{2013}'] {
        let dump = format!(
            "Int[-1] = 2\nFlt[-50] = 20\nFlt[-56] = 10\nFlt[-100] = {minus}7,5\nFlt[-101] = 0\nFlt[-102] = 0\nFlt[-103] = 0\nFlt[-104] = 0\nFlt[-105] = 1\n"
        );
        let job = import(&dump).unwrap().job;
        assert_eq!(
            planned(&job).touches[0].point,
            [-7.5, 0.0, 0.0],
            "{minus:?}"
        );
    }
}

/// The second pair of walls has its own clearance.
#[test]
fn each_pair_has_its_clearance() {
    for (kind, inside) in [
        ("internal-rectangle-protected", -1.0),
        ("external-rectangle", 1.0),
    ] {
        let job = job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "{kind}", "sideClearance1": 7, "sideClearance2": 11 }} }}"#
        ));
        let plan = planned(&job);
        let starts: Vec<[f64; 3]> = plan
            .moves
            .windows(2)
            .filter(|w| w[1].kind == "touch")
            .map(|w| w[0].to)
            .collect();
        let (u, v) = (40.0 + inside * 7.0, 25.0 + inside * 11.0);
        assert_eq!(
            starts,
            [
                [u, 0.0, -10.0],
                [-u, 0.0, -10.0],
                [0.0, v, -10.0],
                [0.0, -v, -10.0]
            ],
            "{kind}"
        );
    }
}

#[test]
fn every_work_offset_has_its_word() {
    let program = |post: &str, n: f64| {
        let job = with(&default_job("hole").unwrap(), "control.post", text(post));
        planned(&with(&job, "control.workOffset", number(n)))
            .program
            .text
    };
    for (n, word) in [
        (1.0, "G54"),
        (5.0, "G58"),
        (6.0, "G59"),
        (7.0, "G59.1"),
        (9.0, "G59.3"),
    ] {
        let text = program("linuxcnc", n);
        assert!(
            text.lines().any(|l| l == word) && text.contains(&format!("G10 L20 P{n} ")),
            "{n}"
        );
    }
    for (n, word) in [(1.0, "G54"), (4.0, "G57"), (5.0, "G505"), (99.0, "G599")] {
        let text = program("sinumerik", n);
        assert!(
            text.lines().any(|l| l == word) && text.contains(&format!("$P_UIFR[{n},X,TR]=")),
            "{n}"
        );
    }
}

/// The retract from a touch can collide: here it leads through the opposite wall.
#[test]
fn a_way_back_that_meets_the_part_is_a_collision() {
    let job = job(r#"{ "format": 1, "cycle": { "type": "internal-rectangle-protected" } }"#);
    let planned = touchpath::job::planned(&job).unwrap();
    let (mut path, setup) = (planned.path.clone(), planned.job.setup);
    let run = |path: &touchpath::path::Path| {
        touchpath::part::run(path, &planned.surfaces, &setup).collision
    };
    assert_eq!(run(&path), None);
    let back = path
        .moves
        .iter()
        .position(|step| matches!(step.purpose, touchpath::path::MovePurpose::Retract(0)))
        .unwrap();
    // The walls are 40 mm from the centre: a ball of 6 mm touches the far one with its centre at −37.
    path.moves[back].to.x = -60.0;
    let (index, center) = run(&path).expect("the ball meets the far wall");
    assert_eq!(index, back);
    assert!((center.x + 37.0).abs() < 1e-6, "{center}");
}

/// Size deviations of the virtual part are converted like any length.
#[test]
fn sizes_of_the_virtual_part_are_converted_with_the_units() {
    let job = with(
        &default_job("hole").unwrap(),
        "part.sizes.diameter",
        number(0.254),
    );
    let inch = touchpath::job::convert_units(&job, "inch").unwrap();
    let size = |job: &Value| {
        job.get("part")
            .and_then(|part| part.get("sizes"))
            .and_then(|sizes| sizes.get("diameter"))
            .cloned()
    };
    assert_eq!(size(&inch), Some(number(0.01)));
    assert_eq!(
        size(&touchpath::job::convert_units(&inch, "mm").unwrap()),
        Some(number(0.254))
    );
}

/// The object of 1411 is assumed to reach half-way to the height at which the ball is free: touched at −10, with a ball of 6 mm free above 100 − 3 = 97, to
/// 43.5.
#[test]
fn an_object_of_1411_is_higher_than_its_touches() {
    let planned = touchpath::job::planned(&default_job("probing-two-circles").unwrap()).unwrap();
    for surface in &planned.path.surfaces {
        let touchpath::path::Surface::Round(round) = surface else {
            panic!("{surface:?}")
        };
        assert!((round.center.z - 43.5).abs() < 1e-9, "{round:?}");
    }
    assert_eq!(planned.path.surfaces.len(), 2);
}

/// A nominal position left of the origin is subtracted with its sign: −50 is compared as `#…-[-50.]`.
#[test]
fn a_negative_nominal_place_is_asked_with_its_sign() {
    for post in ["fanuc", "haas"] {
        let job = job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "hole", "diameter": 40, "origin": [-50, 0, 0] }}, "limits": {{ "position": 1 }},
            "control": {{ "post": "{post}", "workOffset": 1 }} }}"#
        ));
        for (off, alarms) in [(0.0, false), (0.9, false), (-1.2, true)] {
            let plan = planned(&job);
            let mut control = crate::common::fanuc::Control::new(post == "haas", false);
            let places = plan.triggers.iter().flatten();
            // The first two touches are along X.
            control.contacts = places
                .enumerate()
                .map(|(i, [x, y, z])| [x + if i < 2 { off } else { 0.0 }, *y, *z])
                .collect();
            for origin in [5221, 5222, 5223] {
                control.variables.insert(origin, 100.0);
            }
            control.run(&plan.program.text).unwrap();
            assert_eq!(
                control.alarm.is_some(),
                alarms,
                "{post}, {off} mm off: {:?}",
                control.alarm
            );
            assert_eq!(control.writes.is_empty(), alarms, "{post}, {off} mm off");
        }
    }
}

/// Five digits before the point and three after it, or four and four: as the controls display.
#[test]
fn a_log_has_the_decimals_of_its_unit() {
    for (units, digits) in [("mm", "[53]]"), ("inch", "[44]]")] {
        for post in ["fanuc", "haas"] {
            let job = job(&format!(
                r#"{{ "format": 1, "units": "{units}", "cycle": {{ "type": "hole" }}, "control": {{ "post": "{post}", "report": "log" }} }}"#
            ));
            let text = planned(&job).program.text;
            let lines: Vec<&str> = text
                .lines()
                .filter(|line| line.contains("DPRNT["))
                .collect();
            assert!(
                lines.len() >= 3 && lines.iter().all(|line| line.ends_with(digits)),
                "{units}: {lines:?}"
            );
        }
    }
}

/// 20 +0.9 −0.1: the middle is 20.4, and the nominal diameter deviates by 0.4. With 0.3 for sizes, 19.7 to 21.1 are plausible.
#[test]
fn the_nominal_part_is_plausible_whatever_the_middle_of_its_zone() {
    for (diameter, implausible) in [
        (0.0, false),
        (1.05, false),
        (-0.25, false),
        (1.15, true),
        (-0.35, true),
    ] {
        let job = job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles", "diameter1": "20+0.9-0.1" }}, "limits": {{ "size": 0.3 }},
            "control": {{ "post": "linuxcnc", "form": "moves" }}, "part": {{ "sizes": {{ "diameter1": {diameter} }} }} }}"#
        ));
        assert_eq!(
            codes(&job).contains(&"implausible".to_owned()),
            implausible,
            "{diameter}: {:?}",
            codes(&job)
        );
    }
}

/// A part that is rotated by more than the limit of angles stops the program, although its own angle is correct.
#[test]
fn a_direction_has_the_limit_of_angles() {
    for (rotation, implausible) in [(0.9, false), (1.1, true), (-1.1, true)] {
        let job = job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "double-wall-internal-corner" }}, "control": {{ "post": "linuxcnc", "workOffset": 1 }},
            "part": {{ "rotation": {rotation} }} }}"#
        ));
        assert_eq!(
            codes(&job).contains(&"implausible".to_owned()),
            implausible,
            "{rotation}: {:?}",
            codes(&job)
        );
    }
}

/// Reports of grbl for walls of the virtual part, with the first one `chip` mm nearer to −X; G54 is X−200 Y−150 Z−60.
fn grbl_log(job: &Value, chip: f64) -> String {
    let touches = planned(job).triggers.into_iter().flatten().enumerate();
    let line = |(i, [x, y, z]): (usize, [f64; 3])| {
        format!(
            "[PRB:{:.3},{:.3},{:.3}:1]\n",
            x - 200.0 - if i == 0 { chip } else { 0.0 },
            y - 150.0,
            z - 60.0
        )
    };
    format!(
        "G54\nWCO:-200.000,-150.000,-60.000\n{}",
        touches.map(line).collect::<String>()
    )
}

/// Codes of the findings about a log, and whether there is a block to type.
fn said_of(job: &Value, log: &str) -> (Vec<String>, bool) {
    let found = touchpath::job::measure(job, &text(log)).unwrap();
    (
        found.findings.into_iter().map(|f| f.code).collect(),
        found.block.is_some(),
    )
}

/// A 4 mm chip on a wall makes a width of 76 for 80: such a position is not typed into a work offset.
#[test]
fn an_implausible_measurement_has_no_block() {
    let pocket = job(
        r#"{ "format": 1, "control": { "post": "grbl" }, "cycle": { "type": "internal-rectangle" } }"#,
    );
    assert_eq!(
        said_of(&pocket, &grbl_log(&pocket, 0.0)),
        (
            vec!["converted".to_owned(), "block-to-type".to_owned()],
            true
        )
    );
    assert_eq!(
        said_of(&pocket, &grbl_log(&pocket, 4.0)),
        (vec!["converted".to_owned(), "no-block".to_owned()], false)
    );
}

/// grbl has no rotation: the offset of a rotated corner is correct at one position only, which is reported.
#[test]
fn a_rotation_that_is_not_typed_is_mentioned() {
    let corner = job(
        r#"{ "format": 1, "control": { "post": "grbl" }, "cycle": { "type": "double-wall-internal-corner" },
        "part": { "rotation": 0.5 } }"#,
    );
    let wanted = ["converted", "block-to-type", "rotation-not-written"]
        .map(str::to_owned)
        .to_vec();
    assert_eq!(said_of(&corner, &grbl_log(&corner, 0.0)), (wanted, true));
}
