//! Programs of HEIDENHAIN's 4xx cycles, judged by a simulated TNC that implements each cycle from its description and shares no code with the crate: it reads
//! the blocks of the program and computes the ball centre at each contact.

use std::collections::BTreeMap;

use super::own_cycles::{BALL, Face, PLACES, own, stopped};
use crate::common::{number, point as list, refused};
use crate::tests::controls::{calling_macros, calling_macros_as_a_fanuc, without};
use touchpath::form::{Level, Value};
use touchpath::job::{Plan, plan};

/// Blocks of a program: number, and Q parameters in order.
pub(super) fn blocks(text: &str) -> Vec<(u32, Vec<(u32, f64)>)> {
    let mut found: Vec<(u32, Vec<(u32, f64)>)> = Vec::new();
    for line in text.lines() {
        if let Some((_, head)) = line
            .split_once("TCH PROBE ")
            .or_else(|| line.split_once("CYCL DEF "))
        {
            found.push((head.split(' ').next().unwrap().parse().unwrap(), Vec::new()));
        } else if let Some(given) = line.trim_start().strip_prefix('Q') {
            let (q, value) = given.split(' ').next().unwrap().split_once('=').unwrap();
            found
                .last_mut()
                .unwrap()
                .1
                .push((q.parse().unwrap(), value.parse().unwrap()));
        }
    }
    found
}

/// Contact of a touch from a position along a direction, within a search distance.
pub(super) fn contact(faces: &[Face], from: [f64; 3], along: [f64; 3], far: f64) -> [f64; 3] {
    // The faces are those of a stylus tip along Z; this control's heights are those of the ball centre.
    let tip = |p: [f64; 3]| [p[0], p[1], p[2] - BALL];
    let to = [0, 1, 2].map(|i| from[i] + along[i] * far);
    let parts = faces
        .iter()
        .filter_map(|face| stopped(*face, tip(from), tip(to)));
    let part = parts.fold(f64::INFINITY, f64::min);
    assert!(part <= 1.0, "nothing is met from {from:?} to {to:?}");
    [0, 1, 2].map(|i| from[i] + part * (to[i] - from[i]))
}

/// The contacts of a program, with this much of SET_UP in the probe table.
pub(super) fn judged(text: &str, faces: &[Face], set_up: f64) -> Vec<[f64; 3]> {
    let mut made = Vec::new();
    for (number, given) in blocks(text) {
        let q: BTreeMap<u32, f64> = given.into_iter().collect();
        let aside = BALL + set_up + q.get(&320).copied().unwrap_or(0.0);
        let axis = |sign: f64| {
            let mut along = [0.0; 3];
            along[q[&272] as usize - 1] = sign;
            along
        };
        let from = |place: [f64; 3], along: [f64; 3], off: f64| {
            [0, 1, 2].map(|i| place[i] + along[i] * off)
        };
        let back = |along: [f64; 3]| along.map(|x| -x);
        match number {
            247 => {}
            412 | 413 | 421 | 422 => {
                let inside = number == 412 || number == 421;
                let [x, y] = if number < 420 {
                    [q[&321], q[&322]]
                } else {
                    [q[&273], q[&274]]
                };
                for k in 0..q.get(&423).map_or(4, |n| *n as usize) {
                    let (s, c) = (q[&325] + q[&247] * k as f64).to_radians().sin_cos();
                    let out = [c, s, 0.0];
                    let off = if inside {
                        (q[&262] / 2.0 - aside).max(0.0)
                    } else {
                        q[&262] / 2.0 + aside
                    };
                    let start = from([x, y, q[&261]], out, off);
                    made.push(contact(
                        faces,
                        start,
                        if inside { out } else { back(out) },
                        30.0,
                    ));
                }
            }
            410 | 411 | 423 | 424 => {
                let inside = number % 2 == 0 && number < 420 || number == 423;
                let [x, y, a, b] = if number < 420 {
                    [321, 322, 323, 324]
                } else {
                    [273, 274, 282, 283]
                }
                .map(|n| q[&n]);
                for (out, side) in [([1.0, 0.0, 0.0], a), ([0.0, 1.0, 0.0], b)] {
                    for out in [out, back(out)] {
                        let off = if inside {
                            side / 2.0 - aside
                        } else {
                            side / 2.0 + aside
                        };
                        let start = from([x, y, q[&261]], out, off);
                        made.push(contact(
                            faces,
                            start,
                            if inside { out } else { back(out) },
                            30.0,
                        ));
                    }
                }
            }
            425 => {
                for sign in [1.0, -1.0] {
                    made.push(contact(
                        faces,
                        [q[&328], q[&329], q[&261]],
                        axis(sign),
                        30.0,
                    ));
                }
            }
            408 | 409 | 426 => {
                let center = match number {
                    426 => [
                        (q[&263] + q[&265]) / 2.0,
                        (q[&264] + q[&266]) / 2.0,
                        q[&261],
                    ],
                    _ => [q[&321], q[&322], q[&261]],
                };
                for sign in [1.0, -1.0] {
                    let (out, half) = (axis(sign), q[&311] / 2.0);
                    let start = from(
                        center,
                        out,
                        if number == 408 {
                            half - aside
                        } else {
                            half + aside
                        },
                    );
                    made.push(contact(
                        faces,
                        start,
                        if number == 408 { out } else { back(out) },
                        30.0,
                    ));
                }
            }
            417 => made.push(contact(
                faces,
                [q[&263], q[&264], q[&294] + aside],
                [0.0, 0.0, -1.0],
                30.0,
            )),
            419 | 427 => {
                let along = axis(q[&267]);
                made.push(contact(
                    faces,
                    from([q[&263], q[&264], q[&261]], along, -aside),
                    along,
                    30.0,
                ));
            }
            other => panic!("cycle {other} is not known to the judge"),
        }
    }
    made
}

fn job(cycle: &str, changes: &[(&str, Value)]) -> Value {
    own(cycle, "heidenhain", changes)
}

/// Contacts of the plan's own run, in order.
pub(super) fn of_plan(plan: &Plan) -> Vec<[f64; 3]> {
    let made = plan
        .moves
        .iter()
        .filter(|step| step.kind == "touch")
        .map(|step| step.touch.unwrap());
    made.map(|k| plan.triggers[k].unwrap()).collect()
}

type Case = (
    &'static str,
    Vec<(&'static str, Value)>,
    Vec<Face>,
    [u32; 2],
);

/// Jobs with the faces of their part, by hand, shifted; with the measuring cycle and the writing one.
fn cases() -> Vec<Case> {
    let (dx, dy, dz) = (0.4, -0.3, 0.2);
    let hole = vec![Face::Circle([dx, dy], 20.0)];
    let walls = |along: [f64; 2], half: f64, inside: bool| {
        let sign = if inside { -1.0 } else { 1.0 };
        [along, [-along[0], -along[1]]].map(|n| {
            Face::Wall(
                [n[0] * sign, n[1] * sign],
                sign * (n[0] * dx + n[1] * dy + half),
            )
        })
    };
    let [x, y] = [[1.0, 0.0], [0.0, 1.0]];
    let turn = |degrees: f64| vec![("cycle.rotation", number(degrees))];
    let angular = vec![
        ("cycle.variant", number(1.0)),
        ("cycle.startAngle", number(20.0)),
        ("cycle.angularStep", number(-85.0)),
        ("cycle.stepCount", number(4.0)),
    ];
    let mut top = walls(x, 15.0, false).to_vec();
    top.push(Face::Top(dz));
    let rectangle = |one: [f64; 2], two: [f64; 2], inside: bool| {
        [walls(one, 40.0, inside), walls(two, 25.0, inside)].concat()
    };
    vec![
        ("surface", vec![], vec![Face::Top(dz)], [427, 417]),
        (
            "surface",
            vec![
                ("cycle.elevation", number(0.0)),
                ("cycle.rotation", number(180.0)),
            ],
            vec![Face::Wall([-1.0, 0.0], -dx)],
            [427, 419],
        ),
        (
            "surface",
            vec![
                ("cycle.elevation", number(0.0)),
                ("cycle.rotation", number(90.0)),
            ],
            vec![Face::Wall([0.0, 1.0], dy)],
            [427, 419],
        ),
        ("hole", vec![], hole.clone(), [421, 412]),
        ("hole", angular.clone(), hole.clone(), [421, 412]),
        ("hole-protected", turn(30.0), hole.clone(), [421, 412]),
        ("boss", vec![], hole.clone(), [422, 413]),
        ("boss", angular, hole, [422, 413]),
        (
            "internal-rectangle",
            vec![],
            rectangle(x, y, true),
            [423, 410],
        ),
        (
            "internal-rectangle",
            turn(90.0),
            rectangle(y, x, true),
            [423, 410],
        ),
        (
            "internal-rectangle-protected",
            vec![],
            rectangle(x, y, true),
            [423, 410],
        ),
        (
            "external-rectangle",
            turn(90.0),
            rectangle(y, x, false),
            [424, 411],
        ),
        ("web", vec![], walls(x, 15.0, false).to_vec(), [426, 409]),
        (
            "web",
            turn(90.0),
            walls(y, 15.0, false).to_vec(),
            [426, 409],
        ),
        ("web-three-points", vec![], top, [426, 409]),
        ("groove", vec![], walls(x, 15.0, true).to_vec(), [425, 408]),
        (
            "groove",
            turn(90.0),
            walls(y, 15.0, true).to_vec(),
            [425, 408],
        ),
        (
            "groove-protected",
            vec![],
            walls(x, 15.0, true).to_vec(),
            [0, 408],
        ),
    ]
}

#[test]
fn the_judge_touches_where_the_plan_does() {
    let mut touches = 0;
    let cases = cases();
    let placed = cases
        .iter()
        .flat_map(|case| PLACES.map(|place| (place, case)));
    for (place, (cycle, changes, faces, cycles)) in placed {
        let faces: Vec<Face> = faces.iter().map(|face| face.moved(place)).collect();
        for (row, set_up) in [(None, 0.0), (Some(3.0), 0.0), (None, 2.0), (Some(3.0), 2.0)] {
            let mut changes = changes.clone();
            changes.push(("part.offset", list([0.4, -0.3, 0.2])));
            if place != PLACES[0] {
                changes.push(("cycle.origin", list(place)));
            }
            changes.push(("control.workOffset", row.map_or(Value::Null, Value::Number)));
            changes.push(("control.setUp", number(set_up)));
            let wanted = cycles[usize::from(row.is_some())];
            let planned = plan(&job(cycle, &changes));
            if wanted == 0 {
                assert!(
                    planned
                        .unwrap_err()
                        .findings
                        .iter()
                        .any(|f| f.code == "cycle-no-lift")
                );
                continue;
            }
            let planned =
                planned.unwrap_or_else(|error| panic!("{cycle} {changes:?}: {:?}", error.findings));
            let text = &planned.program.text;
            let called = blocks(text);
            assert_eq!(called[0].0, wanted, "{cycle}");
            assert_eq!(
                called.last().unwrap().0 == 247,
                row.is_some(),
                "a row that is written is activated"
            );
            let sorted = |mut places: Vec<[f64; 3]>| {
                places.sort_by(|a, b| (a[0] + 7.0 * a[1]).total_cmp(&(b[0] + 7.0 * b[1])));
                places
            };
            // The first side of a rectangle is our choice.
            let (judged, found) = (
                sorted(judged(text, &faces, set_up)),
                sorted(of_plan(&planned)),
            );
            assert_eq!(judged.len(), found.len(), "{cycle} {changes:?}\n{text}");
            for (a, b) in judged.iter().zip(&found) {
                assert!(
                    (0..3).all(|i| (a[i] - b[i]).abs() < 1e-3),
                    "{cycle} {changes:?}: {a:?} and {b:?}\n{text}"
                );
                touches += 1;
            }
            for row in planned
                .results
                .iter()
                .filter(|row| row.truth.is_some() && row.value.is_some())
            {
                let off = (row.value.unwrap() - row.truth.unwrap()).abs();
                // A displaced circle is touched beside the direction of the touch.
                let second_order = row.code == "diameter" || row.code.starts_with("center");
                assert!(
                    off < if second_order { 2e-2 } else { 1e-6 },
                    "{cycle} {}: {off}",
                    row.code
                );
            }
        }
    }
    assert!(touches > 180, "{touches}");
}

/// Several cycles in one program of a TNC. By hand: the highest cycle begins at 8 + 20, so each moves to the next one at 28, its own clearance height; results
/// that the next cycle overwrites are saved before it; on a shifted part each touches as it would alone.
#[test]
fn several_cycles_keep_their_results_and_cross_at_one_height() {
    let text = |clear: &str| {
        format!(
            r#"{{ "format": 2, "units": "mm", "control": {{ "post": "heidenhain", "form": "cycle" }}, "clear": {clear}, "part": {{ "offset": [0.4, -0.3, 0.2] }},
            "cycles": [{{ "name": "TOP", "type": "surface", "origin": [-150, 0, 0], "clearance": 5, "feedDistance": 10 }},
                {{ "name": "BORE", "type": "hole", "diameter": 40, "topClearance": 8, "feedDistance": 20 }},
                {{ "name": "RIB", "type": "web", "width": 30, "origin": [150, 0, 0] }}] }}"#
        )
    };
    let of = |clear: &str| plan(&touchpath::job::from_json(&text(clear)).unwrap());
    let whole = of("null").unwrap();
    let found = blocks(&whole.program.text);
    assert_eq!(
        found
            .iter()
            .map(|(number, _)| *number)
            .collect::<Vec<u32>>(),
        [427, 421, 426]
    );
    for (number, given) in &found {
        assert_eq!(
            given.iter().find(|(q, _)| *q == 260).unwrap().1,
            28.0,
            "{number}"
        );
    }
    let kept: Vec<&str> = whole
        .program
        .text
        .lines()
        .filter_map(|line| line.split_once(" FN 0: ").map(|(_, kept)| kept))
        .collect();
    assert_eq!(
        kept,
        [
            "Q1600 = +Q160",
            "Q1601 = +Q151",
            "Q1602 = +Q152",
            "Q1603 = +Q153"
        ]
    );
    let stored = whole
        .results
        .iter()
        .filter_map(|row| Some((row.cycle, row.code.as_str(), row.stored.as_deref()?)));
    let expected = [
        (0, "point.z", "Q1600"),
        (1, "center.x", "Q1601"),
        (1, "center.y", "Q1602"),
        (1, "diameter", "Q1603"),
        (2, "center.x", "Q157"),
        (2, "width", "Q156"),
    ];
    assert_eq!(stored.collect::<Vec<_>>(), expected);
    let faces = |first: usize| match first {
        0 => vec![Face::Top(0.2)],
        1 => vec![Face::Circle([0.4, -0.3], 20.0)],
        _ => vec![
            Face::Wall([1.0, 0.0], 165.4),
            Face::Wall([-1.0, 0.0], -135.4),
        ],
    };
    let blocks_of = |number: u32| {
        let at = whole
            .program
            .text
            .find(&format!("TCH PROBE {number}"))
            .unwrap();
        let rest = &whole.program.text[at..];
        rest[..rest[3..]
            .find("TCH PROBE")
            .map_or(rest.len(), |end| end + 3)]
            .to_owned()
    };
    let made: Vec<[f64; 3]> = (0..3)
        .flat_map(|cycle| judged(&blocks_of([427, 421, 426][cycle]), &faces(cycle), 0.0))
        .collect();
    let touched = of_plan(&whole);
    assert_eq!(made.len(), touched.len());
    for (a, b) in made.iter().zip(&touched) {
        assert!(
            (0..3).all(|i| (a[i] - b[i]).abs() < 1e-3),
            "{a:?} and {b:?}"
        );
    }
    // Between the cycles, and at their ends, the ball is at that height; a greater one is the clearance height of all.
    for clear in ["null", "35"] {
        let whole = of(clear).unwrap();
        let high = if clear == "null" { 28.0 } else { 35.0 };
        for cycle in 0..3 {
            let own: Vec<_> = whole
                .moves
                .iter()
                .filter(|step| step.cycle == cycle)
                .collect();
            assert_eq!(
                [own[0].to[2], own[own.len() - 1].to[2]],
                [high; 2],
                "{clear} {cycle}"
            );
        }
    }
    let refused = of("20").unwrap_err();
    assert_eq!(
        refused
            .findings
            .iter()
            .filter(|f| f.level == Level::Error)
            .count(),
        1
    );
    assert!(
        refused
            .findings
            .iter()
            .any(|f| f.code == "clear-too-low" && f.path == "clear"),
        "{:?}",
        refused.findings
    );
}

/// Parameters in the order of the posts, as the reference sheets list them; values by hand.
#[test]
fn each_block_has_its_parameters_in_their_order() {
    let tail = [303, 381, 382, 383, 384, 333];
    let end = [281, 309, 330];
    let orders: [(u32, Vec<u32>); 15] = [
        (
            408,
            [
                vec![321, 322, 311, 272, 261, 320, 260, 301, 305, 405],
                tail.to_vec(),
            ]
            .concat(),
        ),
        (
            409,
            [
                vec![321, 322, 311, 272, 261, 320, 260, 305, 405],
                tail.to_vec(),
            ]
            .concat(),
        ),
        (
            410,
            [
                vec![321, 322, 323, 324, 261, 320, 260, 301, 305, 331, 332],
                tail.to_vec(),
            ]
            .concat(),
        ),
        (
            411,
            [
                vec![321, 322, 323, 324, 261, 320, 260, 301, 305, 331, 332],
                tail.to_vec(),
            ]
            .concat(),
        ),
        (
            412,
            [
                vec![321, 322, 262, 325, 247, 261, 320, 260, 301, 305, 331, 332],
                tail.to_vec(),
                vec![423, 365],
            ]
            .concat(),
        ),
        (
            413,
            [
                vec![321, 322, 262, 325, 247, 261, 320, 260, 301, 305, 331, 332],
                tail.to_vec(),
                vec![423, 365],
            ]
            .concat(),
        ),
        (417, vec![263, 264, 294, 320, 260, 305, 333, 303]),
        (419, vec![263, 264, 261, 320, 260, 272, 267, 305, 333, 303]),
        (
            421,
            [
                vec![
                    273, 274, 262, 325, 247, 261, 320, 260, 301, 275, 276, 279, 280,
                ],
                end.to_vec(),
            ]
            .concat(),
        ),
        (
            422,
            [
                vec![
                    273, 274, 262, 325, 247, 261, 320, 260, 301, 277, 278, 279, 280,
                ],
                end.to_vec(),
            ]
            .concat(),
        ),
        (
            423,
            [
                vec![
                    273, 274, 282, 283, 261, 320, 260, 301, 284, 285, 286, 287, 279, 280,
                ],
                end.to_vec(),
            ]
            .concat(),
        ),
        (
            424,
            [
                vec![
                    273, 274, 282, 283, 261, 320, 260, 301, 284, 285, 286, 287, 279, 280,
                ],
                end.to_vec(),
            ]
            .concat(),
        ),
        (
            425,
            [
                vec![328, 329, 310, 272, 261, 260, 311, 288, 289],
                end.to_vec(),
            ]
            .concat(),
        ),
        (
            426,
            [
                vec![263, 264, 265, 266, 272, 261, 320, 260, 311, 288, 289],
                end.to_vec(),
            ]
            .concat(),
        ),
        (
            427,
            vec![263, 264, 261, 320, 272, 267, 260, 281, 288, 289, 309, 330],
        ),
    ];
    let mut seen = BTreeMap::new();
    for (cycle, changes, _, _) in cases() {
        for row in [Value::Null, number(3.0)] {
            let changes = [changes.clone(), vec![("control.workOffset", row)]].concat();
            let Ok(planned) = plan(&job(cycle, &changes)) else {
                continue;
            };
            for (number, given) in blocks(&planned.program.text) {
                seen.insert(number, given.iter().map(|(q, _)| *q).collect::<Vec<u32>>());
            }
        }
    }
    for (number, order) in &orders {
        assert_eq!(seen.get(number), Some(order), "{number}");
    }
    assert_eq!(seen.len(), orders.len() + 1, "and 247");
    // A hole of 40 at X50 Y−20, touched 10 below the top by a ball of 6: overtravel 5, size limit 0.5; SET_UP 2 leaves 3 of the 5 in front of each contact.
    let hole = [
        ("cycle.origin", list([50.0, -20.0, 1.0])),
        ("control.setUp", number(2.0)),
        ("limits.position", number(0.2)),
    ];
    let text = plan(&job("hole", &hole)).unwrap().program.text;
    let (_, given) = &blocks(&text)[0];
    let height = given.iter().find(|(q, _)| *q == 260).unwrap().1;
    let expected = [
        50.0, -20.0, 40.0, 0.0, 90.0, -9.0, 3.0, height, 0.0, 40.5, 39.5, 0.2, 0.2, 2.0, 1.0, 0.0,
    ];
    assert_eq!(
        given.iter().map(|(_, x)| *x).collect::<Vec<f64>>(),
        expected
    );
    assert!(
        text.contains("TCH PROBE 421 MEASURE HOLE ~\n    Q273=+50 ;CENTER IN 1ST AXIS ~\n"),
        "{text}"
    );
    // A posted program's stud of 100, 12 in front, row 1, at the clearance height: that program's block except for blanks.
    let stud = [
        ("cycle.diameter", number(100.0)),
        ("cycle.depth", number(3.0)),
        ("cycle.topClearance", number(5.0)),
        ("cycle.sideClearance", number(15.0)),
        ("control.workOffset", number(1.0)),
    ];
    let posted = "TCH PROBE 413 DATUM OUTSIDE CIRCLE ~\nQ321=+0 ;CENTER IN 1ST AXIS ~\nQ322=+0 ;CENTER IN 2ND AXIS ~\nQ262=+100 ;NOMINAL DIAMETER ~\n\
        Q325=+0 ;STARTING ANGLE ~\nQ247=+90 ;STEPPING ANGLE ~\nQ261=-3 ;MEASURING HEIGHT ~\nQ320=+12 ;SET-UP CLEARANCE ~\nQ260=+5 ;CLEARANCE HEIGHT ~\n\
        Q301=+1 ;MOVE TO CLEARANCE ~\nQ305=+1 ;NUMBER IN TABLE ~\nQ331=+0 ;DATUM ~\nQ332=+0 ;DATUM ~\nQ303=+1 ;MEAS. VALUE TRANSFER ~\n\
        Q381=+0 ;PROBE IN TS AXIS ~\nQ382=+0 ;1ST CO. FOR TS AXIS ~\nQ383=+0 ;2ND CO. FOR TS AXIS ~\nQ384=+0 ;3RD CO. FOR TS AXIS ~\n\
        Q333=+0 ;DATUM ~\nQ423=+4 ;NO. OF MEAS. POINTS ~\nQ365=+1 ;TYPE OF TRAVERSE\n";
    let text = plan(&job("boss", &stud)).unwrap().program.text;
    assert!(text.replace("\n    Q", "\nQ").contains(posted), "{text}");
    assert!(text.contains("CYCL DEF 247 DATUM SETTING ~\n    Q339=+1 ;DATUM NUMBER\n"));
}

#[test]
fn what_no_cycle_does_is_refused() {
    let refused = |cycle: &str, changes: &[(&str, Value)]| refused(&job(cycle, changes));
    let text = |word: &str| Value::Text(word.to_owned());
    assert_eq!(
        refused("web", &[("cycle.rotation", number(30.0))]),
        ["cycle-not-parallel cycle.rotation"]
    );
    assert_eq!(
        refused("surface", &[("cycle.elevation", number(40.0))]),
        ["cycle-not-parallel cycle.elevation"]
    );
    assert_eq!(
        refused("hole", &[("plane", text("G18"))]),
        ["cycle-plane plane"]
    );
    assert_eq!(
        refused("web", &[("control.setUp", number(9.0))]),
        ["set-up-too-long cycle.sideClearance"]
    );
    assert_eq!(
        refused(
            "internal-rectangle-protected",
            &[("cycle.sideClearance2", number(9.0))]
        ),
        ["cycle-one-path cycle.sideClearance2"]
    );
    let low = [
        ("cycle.middleClearance", number(4.0)),
        ("control.setUp", number(2.0)),
    ];
    assert_eq!(
        refused("web-three-points", &low),
        ["set-up-too-long cycle.middleClearance"]
    );
    assert_eq!(
        refused("double-wall-external-corner", &[]),
        ["form-unsupported control.form"]
    );
    // Single touches write nothing, and touch along the axes.
    let row = [("control.workOffset", number(1.0))];
    assert_eq!(
        refused("double-wall-internal-corner", &row),
        ["work-offset-unsupported control.workOffset"]
    );
    assert_eq!(
        refused("wall-angle", &[("cycle.rotation", number(10.0))]),
        ["cycle-not-parallel cycle.rotation"]
    );
    let three = [
        ("cycle.variant", number(1.0)),
        ("cycle.angularStep", number(120.0)),
        ("cycle.stepCount", number(3.0)),
    ];
    assert_eq!(
        refused("hole", &three),
        ["cycle-chooses-points cycle.stepCount"],
        "421 touches four times"
    );
    let three = [three.as_slice(), &[("control.workOffset", number(2.0))]].concat();
    assert!(
        plan(&job("hole", &three))
            .unwrap()
            .program
            .text
            .contains("Q423=+3 "),
        "412 may touch three times"
    );
    assert_eq!(
        refused(
            "probing-two-circles",
            &[("control.workOffset", number(1.0))]
        ),
        ["work-offset-unsupported control.workOffset"]
    );
}

/// A missing limit checks nothing: both bounds are 0, and the program does not stop.
#[test]
fn a_missing_limit_asks_nothing() {
    let given = |cycle: &str, changes: &[(&str, Value)]| -> BTreeMap<u32, f64> {
        blocks(&plan(&job(cycle, changes)).unwrap().program.text)[0]
            .1
            .iter()
            .copied()
            .collect()
    };
    let of = |all: &BTreeMap<u32, f64>, numbers: &[u32]| {
        numbers.iter().map(|q| all[q]).collect::<Vec<f64>>()
    };
    // Of the default limits the size has one and the position has none.
    assert_eq!(
        of(
            &given("surface", &[("cycle.origin", list([0.0, 0.0, 12.0]))]),
            &[261, 288, 289, 309]
        ),
        [12.0, 0.0, 0.0, 0.0]
    );
    let place = [
        ("limits.position", number(0.2)),
        ("limits.size", Value::Null),
    ];
    assert_eq!(
        of(&given("surface", &place), &[288, 289, 309]),
        [0.2, -0.2, 1.0]
    );
    assert_eq!(
        of(&given("hole", &place), &[275, 276, 279, 280, 309]),
        [0.0, 0.0, 0.2, 0.2, 1.0]
    );
    assert_eq!(of(&given("web", &place), &[288, 289, 309]), [0.0, 0.0, 0.0]);
    assert!(
        plan(&job("web", &place))
            .unwrap()
            .findings
            .iter()
            .any(|f| f.code == "limits-not-asked")
    );
}

/// A foreign call as a job: only if the job would write the same call.
#[test]
fn a_call_becomes_no_other_write() {
    use touchpath::import::toolpath::{RunInputs, run_program};
    let made = |call: &str, start: [f64; 3]| -> Value {
        let run = run_program(
            call,
            &RunInputs {
                start: Some(start),
                ..RunInputs::default()
            },
        );
        run.calls
            .iter()
            .find_map(|call| call.job.clone())
            .unwrap_or_else(|| panic!("{call}: {:?}", run.calls))
    };
    let at = |job: &Value, path: &str| {
        path.split('.').fold(job.clone(), |value, key| {
            value.get(key).cloned().unwrap_or(Value::Null)
        })
    };
    let klartext = |cycle: &str| format!("BEGIN PGM A MM\nTCH PROBE {cycle}\nEND PGM A MM\n");
    // The measured position must read 100: a job would give it the nominal 10.
    let wall = "419 Q263=+10 Q264=+20 Q261=-5 Q320=+7 Q260=+150 Q272=+1 Q267=+1 Q305=+5 Q303=+1";
    let other = made(&klartext(&format!("{wall} Q333=+100")), [0.0, 0.0, 200.0]);
    assert_eq!(at(&other, "control.workOffset"), Value::Null);
    let same = made(&klartext(&format!("{wall} Q333=+10")), [0.0, 0.0, 200.0]);
    assert_eq!(at(&same, "control.workOffset"), number(5.0));
    let (number_of_block, given) = &blocks(&plan(&same).unwrap().program.text)[0];
    let q: BTreeMap<u32, f64> = given.iter().copied().collect();
    assert_eq!(
        (*number_of_block, q[&260], q[&320], q[&333], q[&305]),
        (419, 150.0, 7.0, 10.0, 5.0)
    );
    // A web along Y: 28 is its Y.
    let web = "G71 G90\nG0 X10 Y50 Z15\nCYCLE977(4,,,1,30,,,5,5,0,20,1,,2,1,\"\",,0,1.01,1.01,-1.01,,,,,1,11,50)\n";
    assert_eq!(
        at(&made(web, [0.0, 0.0, 50.0]), "cycle.origin"),
        list([10.0, 50.0, 5.0])
    );
    // Without a centre the control assumes 0, 0.
    let hole = "G71 G90\nG0 X100 Y50 Z-5\nCYCLE977(101,10001,,1,32,,,7,5,0,1,1,,,1,\"\",,0,1.01,1.01,-1.01,0.34,1,0,,1,1)\n";
    assert_eq!(
        at(&made(hole, [0.0, 0.0, 50.0]), "control.workOffset"),
        Value::Null
    );
    // Heights of calls are those of the stylus tip: written again they are the same. G65 P98xx does not identify the control: such a call becomes moves of a
    // Fanuc.
    for post in without(&calling_macros(), &calling_macros_as_a_fanuc()) {
        let web = own(
            "web",
            post,
            &[
                ("cycle.origin", list([10.0, 50.0, 5.0])),
                ("cycle.rotation", number(90.0)),
            ],
        );
        let text = plan(&web).unwrap().program.text;
        let again = plan(&made(&text, [0.0, 0.0, 50.0])).unwrap().program.text;
        let call = |text: &str| {
            text.lines()
                .find(|line| line.contains("812"))
                .map(str::to_owned)
        };
        assert_eq!(call(&again), call(&text), "{post}");
    }
}

/// An edited program is the header's job, and the difference is reported.
#[test]
fn an_edited_program_says_what_differs() {
    let text = plan(&job("boss", &[])).unwrap().program.text;
    let back = crate::common::import(&text.replacen("Q262=+40", "Q262=+42", 1)).unwrap();
    assert!(
        back.findings
            .iter()
            .any(|finding| finding.code == "program-differs"),
        "{:?}",
        back.findings
    );
    assert_eq!(plan(&back.job).unwrap().program.text, text);
}

/// Variables in which the control stores its results.
#[test]
fn results_have_the_controls_own_names() {
    let names = |cycle: &str, offset: Value| -> Vec<(String, Option<String>)> {
        let planned = plan(&job(cycle, &[("control.workOffset", offset)])).unwrap();
        let measured = planned
            .results
            .into_iter()
            .filter(|row| !row.code.starts_with("offset"));
        measured.map(|row| (row.code, row.stored)).collect()
    };
    let row = |code: &str, name: &str| (code.to_owned(), Some(name.to_owned()));
    assert_eq!(
        names("hole", Value::Null),
        [
            row("center.x", "Q151"),
            row("center.y", "Q152"),
            row("diameter", "Q153")
        ]
    );
    assert_eq!(
        names("groove", Value::Null),
        [row("center.x", "Q157"), row("width", "Q156")]
    );
    // No source documents the variable of 408.
    assert_eq!(
        names("groove", number(1.0)),
        [("center.x".to_owned(), None), ("width".to_owned(), None)]
    );
}

/// Every program is read back as its job; without its header its blocks give the job as far as they specify it, and a run makes the plan's contacts.
#[test]
fn a_program_comes_back_as_its_job() {
    use touchpath::import::toolpath::{Feature, RunInputs, run_program};
    for (cycle, changes, _, _) in cases() {
        for row in [Value::Null, number(3.0)] {
            let changes = [
                changes.clone(),
                vec![
                    ("control.workOffset", row),
                    ("part.offset", list([0.4, -0.3, 0.2])),
                ],
            ]
            .concat();
            let job = job(cycle, &changes);
            let Ok(planned) = plan(&job) else { continue };
            let back = crate::common::import(&planned.program.text)
                .unwrap_or_else(|error| panic!("{cycle}: {error:?}"));
            assert_eq!(
                plan(&back.job).unwrap().program.text,
                planned.program.text,
                "{cycle}"
            );
            assert!(
                back.findings
                    .iter()
                    .all(|finding| finding.code != "program-differs"),
                "{:?}",
                back.findings
            );
            let bare: String = planned
                .program
                .text
                .lines()
                .filter(|line| !line.contains(" ; "))
                .map(|line| format!("{line}\n"))
                .collect();
            let start = planned.moves[0].to;
            let known = RunInputs {
                feature: Feature::of(&job),
                start: Some([start[0], start[1], start[2] + 20.0]),
                ..RunInputs::default()
            };
            let run = run_program(&bare, &known);
            let contacts: Vec<[f64; 3]> = run.contacts.iter().map(|c| [c[1], c[2], c[3]]).collect();
            let wanted = of_plan(&planned);
            assert_eq!(
                contacts.len(),
                wanted.len(),
                "{cycle}: {:?}\n{bare}",
                run.findings
            );
            for (a, b) in contacts.iter().zip(&wanted) {
                assert!(
                    (0..3).all(|i| (a[i] - b[i]).abs() < 1e-3),
                    "{cycle}: {a:?} and {b:?}"
                );
            }
            let of_call = run.calls.iter().find_map(|call| call.job.as_ref());
            let again = of_call.map(|job| plan(job).unwrap().program.text);
            assert_eq!(
                again.map(|text| blocks(&text)[0].0),
                Some(blocks(&planned.program.text)[0].0),
                "{cycle}: {:?}",
                run.calls
            );
        }
    }
}

/// A rectangle whose first side is along Y: its results, and the variables that store them, are in the order of the job.
#[test]
fn results_of_a_turned_rectangle_keep_their_order() {
    let turned = [("cycle.rotation", number(90.0))];
    let text = plan(&job("internal-rectangle", &turned))
        .unwrap()
        .program
        .text;
    let listed = "Results: Q151 center.x, Q152 center.y, Q155 width1, Q154 width2";
    assert!(text.contains(listed), "{text}");
}

/// HEIDENHAIN, touch probe cycles: Q281 = 0 makes no log, 1 a log as a file, 2 stops the program and shows it.
#[test]
fn the_log_of_a_measuring_cycle_is_the_one_that_was_chosen() {
    for (report, wanted) in [("none", 0.0), ("log", 1.0), ("screen", 2.0)] {
        let text = plan(&job(
            "hole",
            &[("control.report", Value::Text(report.to_owned()))],
        ))
        .unwrap()
        .program
        .text;
        let (_, given) = &blocks(&text)[0];
        assert_eq!(
            given
                .iter()
                .find(|(q, _)| *q == 281)
                .map(|(_, value)| *value),
            Some(wanted),
            "{report}\n{text}"
        );
    }
}

/// A call in inch is a job in inch. By hand: the ball of 6 mm has a radius of 3 / 25.4 = 0.11811 inch, Q counts from the contact of its centre, and the hole is
/// 10 mm = 0.393701 inch deep below the ball centre.
#[test]
fn a_call_in_inch_becomes_a_job_in_inch() {
    use touchpath::import::toolpath::{RunInputs, run_program};
    let text = "O1\nG20 G17 G90\nG0 X0 Y0 Z-.2\nG65 P9814 D1. Q.2\nM30\n";
    let run = run_program(
        text,
        &RunInputs {
            start: Some([0.0, 0.0, 2.0]),
            ..RunInputs::default()
        },
    );
    let job = run
        .calls
        .iter()
        .find_map(|call| call.job.clone())
        .expect("a hole");
    let near = |path: &str, wanted: f64| {
        let own = crate::common::number_at(&job, path, f64::NAN);
        assert!((own - wanted).abs() < 1e-6, "{path}: {own}, not {wanted}");
    };
    assert_eq!(job.get("units"), Some(&Value::Text("inch".to_owned())));
    near("cycle.diameter", 1.0);
    near("cycle.depth", 10.0 / 25.4);
    near("overtravel", 0.2 + 3.0 / 25.4);
}

/// A cosine of 1 within a millionth is a rotation of 0.08°: over 100 mm such a call would touch the wall 0.09 mm beside its position.
#[test]
fn a_turn_of_a_twentieth_of_a_degree_is_a_turn() {
    for (cycle, post) in [
        ("web", "heidenhain"),
        ("double-wall-external-corner", "fanuc"),
        ("double-wall-external-corner", "haas"),
    ] {
        let turned = |degrees: f64| plan(&own(cycle, post, &[("cycle.rotation", number(degrees))]));
        assert!(
            turned(0.0).is_ok() && turned(90.0).is_ok(),
            "{cycle} {post}"
        );
        let findings = turned(0.05).expect_err("it is turned").findings;
        assert!(
            findings
                .iter()
                .any(|finding| finding.code == "cycle-not-parallel"),
            "{cycle} {post}: {findings:?}"
        );
    }
}
