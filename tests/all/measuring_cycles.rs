//! Programs of SINUMERIK's measuring cycles, judged by a simulated control that implements each cycle from its description and shares no code with the crate,
//! and by calls that generators for the control's editor write.

use super::klartext_cycles::{contact, of_plan};
use super::own_cycles::{BALL, Face, PLACES, own};
use crate::common::{number, point as list, refused};
use touchpath::form::Value;
use touchpath::job::plan;

/// Arguments of a call; omitted ones are NaN.
fn arguments(line: &str) -> Option<(u32, Vec<f64>)> {
    let (number, inner) = line.strip_prefix("CYCLE")?.split_once('(')?;
    let places = inner.strip_suffix(')')?.split(',');
    Some((
        number.parse().unwrap(),
        places
            .map(|text| text.parse().unwrap_or(f64::NAN))
            .collect(),
    ))
}

/// Contacts of a program, in the order in which the control makes them.
fn judged(text: &str, faces: &[Face]) -> Vec<[f64; 3]> {
    let (mut at, mut made) = ([f64::NAN; 3], Vec::new());
    for line in text.lines() {
        if line == "M30" {
            break;
        }
        if let Some(words) = line.strip_prefix("MEAS=1 G1 ") {
            for word in words.split(' ') {
                if let Some(axis) = ["X", "Y", "Z"]
                    .iter()
                    .position(|axis| word.starts_with(axis))
                {
                    at[axis] = word[1..].parse().unwrap();
                }
            }
        }
        if let Some((number, given)) = arguments(line) {
            made.extend(measured((number, &given), at, faces).0);
        }
    }
    made
}

/// Contacts of a call with its arguments from this position of the ball, and its results: entries 4 (size), 5 and 6 (centre).
pub(super) fn measured(
    (number, given): (u32, &[f64]),
    at: [f64; 3],
    faces: &[Face],
) -> (Vec<[f64; 3]>, Vec<(usize, f64)>) {
    let a = |place: usize| given[place - 1];
    if number == 978 {
        let mut along = [0.0; 3];
        along[a(8) as usize - 1] = if a(9) == 1.0 { 1.0 } else { -1.0 };
        let axis = a(8) as usize - 1;
        let mut from = at;
        from[axis] = a(5) - along[axis] * (BALL + a(6));
        return (vec![contact(faces, from, along, 2.0 * a(6))], Vec::new());
    }
    let (kind, zone) = (a(1) % 10.0, a(1) >= 1000.0);
    let inside = kind % 2.0 == 1.0;
    let height = if zone || !inside {
        at[2] - a(11)
    } else {
        at[2]
    };
    let sides: Vec<(f64, f64)> = match kind as u32 {
        1 | 2 => vec![(0.0, a(5)), (90.0, a(5))],
        3 | 4 => vec![((a(14) - 1.0) * 90.0, a(5))],
        _ => vec![(0.0, a(6)), (90.0, a(7))],
    };
    let (mut center, mut made, mut results) = (at, Vec::new(), Vec::new());
    for (angle, size) in sides {
        let (s, c) = (angle + a(10)).to_radians().sin_cos();
        let pair = [1.0, -1.0].map(|side| {
            let out = [c * side, s * side, 0.0];
            let off = if inside {
                size / 2.0 - BALL - a(8)
            } else {
                size / 2.0 + BALL + a(8)
            };
            let from = [center[0] + out[0] * off, center[1] + out[1] * off, height];
            contact(
                faces,
                from,
                if inside { out } else { out.map(|x| -x) },
                2.0 * a(8),
            )
        });
        made.extend(pair);
        let found = [0, 1].map(|i| (pair[0][i] + pair[1][i]) / 2.0 - center[i]);
        let along = found[0] * c + found[1] * s;
        center = [center[0] + along * c, center[1] + along * s, center[2]];
        let apart = (pair[0][0] - pair[1][0]).hypot(pair[0][1] - pair[1][1]);
        let ball = if inside { BALL } else { -BALL };
        results.push((4, apart + 2.0 * ball));
    }
    results.extend([(5, center[0]), (6, center[1])]);
    (made, results)
}

fn job(cycle: &str, changes: &[(&str, Value)]) -> Value {
    own(cycle, "sinumerik", changes)
}

#[test]
fn the_judge_touches_where_the_plan_does() {
    let (dx, dy, dz) = (0.4, -0.3, 0.2);
    let hole = vec![Face::Circle([dx, dy], 20.0)];
    let walls = |degrees: f64, half: f64, inside: bool| {
        let (s, c) = degrees.to_radians().sin_cos();
        let sign = if inside { -1.0 } else { 1.0 };
        [[c, s], [-c, -s]].map(|n| {
            Face::Wall(
                [n[0] * sign, n[1] * sign],
                sign * (n[0] * dx + n[1] * dy + half),
            )
        })
    };
    let rectangle = |turn: f64, inside: bool| {
        [walls(turn, 40.0, inside), walls(turn + 90.0, 25.0, inside)].concat()
    };
    let turn = |degrees: f64| vec![("cycle.rotation", number(degrees))];
    let side = |degrees: f64| {
        vec![
            ("cycle.elevation", number(0.0)),
            ("cycle.rotation", number(degrees)),
        ]
    };
    let mut top = walls(90.0, 15.0, false).to_vec();
    top.push(Face::Top(dz));
    type Case = (&'static str, Vec<(&'static str, Value)>, Vec<Face>, u32);
    let cases: Vec<Case> = vec![
        ("surface", vec![], vec![Face::Top(dz)], 0),
        ("surface", side(0.0), vec![Face::Wall([1.0, 0.0], dx)], 0),
        (
            "surface",
            side(180.0),
            vec![Face::Wall([-1.0, 0.0], -dx)],
            0,
        ),
        ("surface", side(90.0), vec![Face::Wall([0.0, 1.0], dy)], 0),
        (
            "surface",
            side(-90.0),
            vec![Face::Wall([0.0, -1.0], -dy)],
            0,
        ),
        ("hole", vec![], hole.clone(), 1),
        ("hole", turn(25.0), hole.clone(), 1),
        ("hole-protected", vec![], hole.clone(), 1001),
        ("boss", turn(-70.0), hole, 2),
        ("internal-rectangle", vec![], rectangle(0.0, true), 5),
        ("internal-rectangle", turn(30.0), rectangle(30.0, true), 5),
        (
            "internal-rectangle-protected",
            turn(90.0),
            rectangle(90.0, true),
            1005,
        ),
        (
            "external-rectangle",
            turn(-20.0),
            rectangle(-20.0, false),
            6,
        ),
        ("web", vec![], walls(0.0, 15.0, false).to_vec(), 4),
        ("web-three-points", turn(90.0), top, 4),
        ("groove", turn(90.0), walls(90.0, 15.0, true).to_vec(), 3),
        ("groove", turn(40.0), walls(40.0, 15.0, true).to_vec(), 3),
        (
            "groove-protected",
            vec![],
            walls(0.0, 15.0, true).to_vec(),
            1003,
        ),
    ];
    let mut touches = 0;
    let placed = cases
        .iter()
        .flat_map(|case| PLACES.map(|place| (place, case)));
    for (place, (cycle, changes, faces, variant)) in placed {
        let faces: Vec<Face> = faces.iter().map(|face| face.moved(place)).collect();
        let turned = changes.iter().any(|(path, _)| *path == "cycle.rotation");
        for offset in [Value::Null, number(2.0)] {
            if turned && *cycle == "groove" && offset != Value::Null {
                continue;
            }
            let mut changes = changes.clone();
            changes.extend([
                ("part.offset", list([dx, dy, dz])),
                ("control.workOffset", offset.clone()),
            ]);
            if place != PLACES[0] {
                changes.push(("cycle.origin", list(place)));
            }
            let planned = plan(&job(cycle, &changes))
                .unwrap_or_else(|error| panic!("{cycle} {changes:?}: {:?}", error.findings));
            let text = &planned.program.text;
            let (number, given) = text.lines().find_map(arguments).unwrap();
            let corrects = if offset == Value::Null { 0 } else { 100 };
            assert_eq!(
                (number, given[0] as u32),
                (if *variant == 0 { 978 } else { 977 }, variant + corrects),
                "{cycle}"
            );
            let (judged, found) = (judged(text, &faces), of_plan(&planned));
            assert_eq!(judged.len(), found.len(), "{cycle} {changes:?}\n{text}");
            for (a, b) in judged.iter().zip(&found) {
                assert!(
                    (0..3).all(|i| (a[i] - b[i]).abs() < 2e-3),
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

/// The two calls in the documentation of a generator: equal except for the zone, which ours computes from the clearance.
#[test]
fn the_calls_are_those_of_a_generator() {
    let call = |cycle: &str, changes: &[(&str, Value)]| {
        let text = plan(&job(cycle, changes)).unwrap().program.text;
        text.lines()
            .find(|line| line.starts_with("CYCLE"))
            .unwrap()
            .to_owned()
    };
    let hole = [
        ("cycle.diameter", number(32.0)),
        ("cycle.origin", list([-3.0, 15.0, 0.0])),
        ("cycle.rotation", number(11.0)),
        ("cycle.depth", number(6.0)),
        ("cycle.topClearance", number(10.0)),
        ("cycle.sideClearance", number(10.0)),
        ("control.workOffset", number(1.0)),
    ];
    let theirs =
        "CYCLE977(1101,10001,,1,32,,,7,5,11,16,5,,,1,\"\",,0,1.01,1.01,-1.01,0.34,1,0,,1,11,-3,15)";
    assert_eq!(
        call("hole-protected", &hole),
        theirs.replace(",16,5,,,1,", ",16,6,,,1,"),
        "zone 32 - 2(10 + 3)"
    );
    let surface = [
        ("cycle.elevation", number(0.0)),
        ("cycle.origin", list([-55.0, 0.0, 0.0])),
        ("cycle.clearance", number(18.0)),
    ];
    assert_eq!(
        call("surface", &surface),
        "CYCLE978(0,,,1,-55,15,5,1,2,1,\"\",,0,1.01,1.01,-1.01,,,,,1,1)"
    );
    // A web of another generator: equal except for the offset and the centre.
    let web = call(
        "web",
        &[
            ("cycle.rotation", number(90.0)),
            ("control.workOffset", number(1.0)),
        ],
    );
    assert_eq!(
        web,
        "CYCLE977(104,10001,,1,30,,,5,5,0,20,1,,2,1,\"\",,0,1.01,1.01,-1.01,0.34,1,0,,1,11,0)"
    );
}

#[test]
fn what_no_cycle_does_is_refused() {
    let refused = |cycle: &str, changes: &[(&str, Value)]| refused(&job(cycle, changes));
    assert_eq!(
        refused("surface", &[("cycle.elevation", number(40.0))]),
        ["cycle-not-parallel cycle.elevation"]
    );
    assert_eq!(
        refused(
            "surface",
            &[
                ("cycle.elevation", number(0.0)),
                ("cycle.rotation", number(5.0))
            ]
        ),
        ["cycle-not-parallel cycle.elevation"]
    );
    let low = [("cycle.middleClearance", number(3.05))];
    assert_eq!(
        refused("web-three-points", &low),
        ["cycle-path-short cycle.middleClearance"]
    );
    let turned = [
        ("cycle.rotation", number(30.0)),
        ("control.workOffset", number(1.0)),
    ];
    assert_eq!(
        refused("web", &turned),
        ["cycle-not-parallel control.workOffset"]
    );
    let three = [
        ("cycle.variant", number(1.0)),
        ("cycle.angularStep", number(120.0)),
        ("cycle.stepCount", number(3.0)),
    ];
    assert_eq!(
        refused("hole", &three),
        ["cycle-chooses-points cycle.stepCount"]
    );
    for cycle in [
        "double-wall-internal-corner",
        "triple-wall-external-corner",
        "probing-two-circles",
        "probe-on-off",
    ] {
        assert_eq!(
            refused(cycle, &[]),
            ["form-unsupported control.form"],
            "{cycle}"
        );
    }
}

/// By hand: a ball of 6 has 2 to move from the centre of a hole of 10. A quarter turn counts as one within the last digit.
#[test]
fn a_measuring_path_is_no_longer_than_the_room() {
    let call = |changes: &[(&str, Value)]| {
        let planned = plan(&job("hole", changes))
            .unwrap_or_else(|error| panic!("{changes:?}: {:?}", error.findings));
        planned
            .program
            .text
            .lines()
            .find(|line| line.starts_with("CYCLE"))
            .unwrap()
            .to_owned()
    };
    let small = call(&[
        ("cycle.diameter", number(10.0)),
        ("overtravel", number(20.0)),
    ]);
    assert!(
        small.starts_with("CYCLE977(1,,,1,10,,,2,2,0,1,1,"),
        "{small}"
    );
    for turn in [-320.8, 17.3, 123.456, -89.9] {
        call(&[("cycle.rotation", number(turn))]);
    }
}

/// A web's results are saved before the touch of its top; the previous frame is no part of them.
#[test]
fn results_are_kept_before_the_next_cycle() {
    let planned = plan(&job(
        "web-three-points",
        &[("control.workOffset", number(1.0))],
    ))
    .unwrap();
    let stored: Vec<(&str, &str)> = planned
        .results
        .iter()
        .filter_map(|row| Some((row.code.as_str(), row.stored.as_deref()?)))
        .collect();
    assert_eq!(stored, [("center.x", "R1"), ("width", "R2")]);
    let text = &planned.program.text;
    let at = |line: &str| {
        text.find(line)
            .unwrap_or_else(|| panic!("{line} in\n{text}"))
    };
    assert!(at("\nCYCLE977(") < at("\nR1=_OVR[5]\n") && at("\nR2=_OVR[4]\n") < at("\nCYCLE978("));
    assert!(
        text.contains("IF ($P_UIFR[1,X,FI]<>0) OR ($P_UIFR[1,Z,FI]<>0) GOTOF TP_FRAME"),
        "{text}"
    );
    // Every move that the program makes itself is watched; a program is read back as its job.
    assert!(
        planned
            .safety
            .iter()
            .any(|row| row.rule == "positioning-watched" && row.holds == Some(true)),
        "{:?}",
        planned.safety
    );
    let back = crate::common::import(text).unwrap();
    assert_eq!(plan(&back.job).unwrap().program.text, *text);
}

/// CYCLE977's safe range is the largest deviation of a wall to each side: the limit of the position, and never more than the overtravel.
#[test]
fn the_safe_range_is_the_limit_of_the_position() {
    for (limit, overtravel, safe) in [(0.2, 5.0, "0.2"), (4.0, 5.0, "4"), (7.0, 5.0, "5")] {
        let changes = [
            ("limits.position", number(limit)),
            ("overtravel", number(overtravel)),
        ];
        let text = plan(&job("internal-rectangle-protected", &changes))
            .unwrap()
            .program
            .text;
        assert!(
            text.contains(&format!("80,50,5,{safe},0,")),
            "{limit}\n{text}"
        );
    }
}

/// The top of a web is a separate result: if it is too low, the call that touches it stops [R].
#[test]
fn the_top_of_a_web_is_asked_for_its_limit() {
    for post in ["sinumerik", "heidenhain"] {
        let changes = [
            ("limits.position", number(0.3)),
            ("part.offset", list([0.0, 0.0, 0.5])),
        ];
        let planned = plan(&own("web-three-points", post, &changes)).unwrap();
        let stops = |finding: &touchpath::form::Finding| {
            finding.code == "implausible" && finding.message.contains("stops with a message")
        };
        assert!(
            planned.findings.iter().any(stops),
            "{post}: {:?}",
            planned.findings
        );
    }
}
