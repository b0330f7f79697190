//! Shank and probe body against the part: by hand, and with points on the cylinders.

use crate::common::{job, number, planned, point, values, with};
use touchpath::form::{Finding, Level, Value};
use touchpath::geom::Vec3;
use touchpath::job::check;
use touchpath::part::{self, StylusPart, StylusShape};
use touchpath::path::Surface;

fn found(job: &Value, code: &str) -> Vec<Finding> {
    check(job).into_iter().filter(|f| f.code == code).collect()
}

/// Whether a finding has a position with this coordinate.
fn says(finding: &Finding, coordinate: &str) -> bool {
    values(finding)
        .iter()
        .any(|place| place.split(", ").any(|known| known.ends_with(coordinate)))
}

/// A pocket of 80 × 50, its touches 10 deep, ball 6.
fn pocket(stylus: &str, cycle: &str) -> Value {
    job(&format!(
        r#"{{ "format": 1, "control": {{ "post": "linuxcnc" }}, "stylus": {{ "diameter": 6, {stylus} }},
            "cycle": {{ "type": "internal-rectangle-protected", "width1": 80, "width2": 50, "depth": 10, "topClearance": 10,
            "sideClearance1": 8, "sideClearance2": 8 {cycle} }} }}"#
    ))
}

/// The body is 40 wide. In front of the wall the ball is 8 from it: at a depth beyond the length the body is below the top side, and its radius of 20 extends
/// over the wall. At the length itself it is level with the top side and clears it.
#[test]
fn the_body_meets_the_top_of_a_deep_pocket() {
    let deep = |depth: f64| {
        with(
            &pocket(r#""length": 50, "shank": 4, "body": 40"#, ""),
            "cycle.depth",
            number(depth),
        )
    };
    assert_eq!(found(&deep(50.0), "shank-collision"), []);
    let [finding] = &found(&deep(50.01), "shank-collision")[..] else {
        panic!()
    };
    assert_eq!(
        (finding.level, finding.path.as_str()),
        (Level::Error, "stylus.length")
    );
    // Down from 10 above: the ball centre is 50 below the top side when the body reaches it.
    assert_eq!(
        values(finding),
        ["4", "3", "X 32, Y 0, Z -50", "50 mm", "50.01 mm"]
    );
    assert_eq!(found(&deep(50.01), "stylus-not-known"), []);
    // A body that fits between the walls enters: at most 32 + 8 wide.
    let narrow = |body: f64| with(&deep(60.0), "stylus.body", number(body));
    assert_eq!(found(&narrow(5.9), "shank-collision"), []);
    // The touch moves the ball to 3 from the wall: a body of 6.1 collides then, at the depth of the touch.
    let [finding] = &found(&narrow(6.1), "shank-collision")[..] else {
        panic!()
    };
    assert_eq!(finding.path, "stylus.length");
    assert_eq!(values(finding)[..4], ["5", "4", "1", "X 36.95, Y 0, Z -60"]);
}

/// A shank thicker than the ball touches the wall before the ball: 6.2 wide, at 3.1 from it, 0.1 before the contact. A shank as thick as the ball does not.
#[test]
fn a_thick_shank_meets_the_wall_first() {
    assert_eq!(found(&pocket(r#""shank": 6"#, ""), "shank-collision"), []);
    let [finding] = &found(&pocket(r#""shank": 6.2"#, ""), "shank-collision")[..] else {
        panic!()
    };
    assert_eq!(
        (finding.level, finding.path.as_str()),
        (Level::Error, "stylus.shank")
    );
    assert_eq!(
        values(finding),
        ["5", "4", "1", "X 36.9, Y 0, Z -10", "6.2 mm", "6 mm"]
    );
    // A corner has no top side: its walls are at least as high as their touches, and the shank begins there.
    let corner = r#"{ "format": 1, "stylus": { "diameter": 6, "shank": 6.2 }, "cycle": { "type": "double-wall-internal-corner" } }"#;
    assert_eq!(found(&job(corner), "shank-collision").len(), 1);
}

/// The ball moves 49.8 below the drawing's top side. On a part that is 0.5 lower that is 49.3, on one that is 0.5 higher 50.3: the body hits it.
#[test]
fn the_displaced_part_counts() {
    let near = with(
        &pocket(r#""length": 50, "shank": 4, "body": 40"#, ""),
        "cycle.depth",
        number(49.8),
    );
    assert_eq!(
        found(
            &with(&near, "part.offset", point([0.0, 0.0, -0.5])),
            "shank-collision"
        ),
        []
    );
    let [finding] = &found(
        &with(&near, "part.offset", point([0.0, 0.0, 0.5])),
        "shank-collision",
    )[..] else {
        panic!()
    };
    assert_eq!(
        (finding.level, finding.path.as_str()),
        (Level::Error, "part")
    );
    // The top side is at 0.5: the ball centre 50 below it is at −49.5.
    assert!(says(finding, "Z -49.5"), "{finding:?}");
}

/// Missing values are noted once, where the ball moves deeper than its diameter, and never replaced by a guess.
#[test]
fn what_is_not_known_is_noted_once() {
    let [note] = &found(&pocket(r#""length": null"#, ""), "stylus-not-known")[..] else {
        panic!()
    };
    assert_eq!(
        (note.level, note.path.as_str()),
        (Level::Info, "stylus.length")
    );
    assert_eq!(values(note), ["10 mm"]);
    let shallow = with(&pocket(r#""length": 50"#, ""), "cycle.depth", number(6.0));
    assert_eq!(found(&shallow, "stylus-not-known"), []);
    // Heights that the cycle does not specify: a corner, and the objects of 1411.
    for cycle in [
        "double-wall-external-corner",
        "triple-wall-internal-corner",
        "probing-two-circles",
    ] {
        let own = job(&format!(
            r#"{{ "format": 1, "stylus": {{ "length": 30, "shank": 4, "body": 40 }}, "cycle": {{ "type": "{cycle}" }},
                "control": {{ "post": "linuxcnc" }} }}"#
        ));
        assert_eq!(found(&own, "shank-collision"), [], "{cycle}");
        let [note] = &found(&own, "stylus-not-known")[..] else {
            panic!("{cycle}")
        };
        assert_eq!(values(note), ["30 mm"], "{cycle}");
    }
    let top = job(r#"{ "format": 1, "cycle": { "type": "surface" } }"#);
    assert_eq!(
        found(&top, "stylus-not-known"),
        [],
        "below a top side nothing stands beside the stylus"
    );
}

/// Holes and bosses by hand: a hole of 40, touched 30 deep with a stylus of 20. The body of 30 fits in the middle, and not at the wall (17 + 15 > 20); beside a
/// boss it extends over it.
#[test]
fn holes_and_bosses() {
    let round = |cycle: &str, body: f64| {
        let own = job(&format!(
            r#"{{ "format": 1, "stylus": {{ "length": 20, "shank": 4, "body": {body} }}, "control": {{ "post": "linuxcnc" }},
                "cycle": {{ "type": "{cycle}", "diameter": 40, "depth": 30 }} }}"#
        ));
        found(&own, "shank-collision")
            .into_iter()
            .map(|f| (values(&f), f.path))
            .collect::<Vec<_>>()
    };
    // The hole is entered in the middle: 15 < 20; on the approach to the wall 5 + 15 = 20.
    let [(said, path)] = &round("hole", 30.0)[..] else {
        panic!()
    };
    assert_eq!(path, "stylus.length");
    assert_eq!(said[2..4], ["1", "X 5, Y 0, Z -30"]);
    // Too wide for the hole: it hits the plate.
    let [(said, path)] = &round("hole", 41.0)[..] else {
        panic!()
    };
    assert_eq!(path, "stylus.length");
    assert_eq!(
        said[2], "X 0, Y 0, Z -20",
        "in positioning, which has no number of a touch"
    );
    assert_eq!(round("hole", 5.9), []);
    let [(said, _)] = &round("boss", 60.0)[..] else {
        panic!()
    };
    assert!(
        said.iter().any(|place| place.ends_with("Z -20")),
        "{said:?}"
    );
    assert_eq!(round("boss", 5.9), []);
}

/// Rotated, in every plane, in inch: the same stylus collides at the same positions.
#[test]
fn planes_turns_and_inches() {
    let deep = with(
        &pocket(r#""length": 50, "shank": 4, "body": 40"#, ""),
        "cycle.depth",
        number(55.0),
    );
    for plane in ["G17", "G18", "G19"] {
        for rotation in [0.0, 30.0] {
            let own = with(
                &with(&deep, "plane", Value::Text(plane.to_owned())),
                "cycle.rotation",
                number(rotation),
            );
            let [finding] = &found(&own, "shank-collision")[..] else {
                panic!("{plane} {rotation}")
            };
            let height = format!(
                "{} -50",
                ["Z", "Y", "X"][["G17", "G18", "G19"]
                    .iter()
                    .position(|p| *p == plane)
                    .unwrap()]
            );
            assert!(says(finding, &height), "{finding:?}");
            let inch = touchpath::job::convert_units(&own, "inch").unwrap();
            let [finding] = &found(&inch, "shank-collision")[..] else {
                panic!("{plane} {rotation}")
            };
            assert!(says(finding, "-1.9685"), "{finding:?}");
        }
    }
}

/// Whether a point is in the material of a surface's body.
fn is_inside(surfaces: &[Surface], p: Vec3, up: Vec3) -> bool {
    let flat = |body: usize| {
        let mut walls = surfaces
            .iter()
            .filter_map(|s| {
                if let Surface::Flat(wall) = s {
                    Some(wall)
                } else {
                    None
                }
            })
            .filter(|w| w.body == body);
        let any = walls.clone().next().is_some();
        any && walls.all(|w| {
            (p - w.point).dot(w.normal) < 0.0 && (!w.has_top || (p - w.point).dot(up) < 0.0)
        })
    };
    let round = |s: &Surface| {
        let Surface::Round(round) = s else {
            return false;
        };
        let away = p - round.center;
        let (height, far) = (away.dot(up), (away - up * away.dot(up)).length());
        height < 0.0
            && if round.hole {
                far > round.radius && far < round.plate.unwrap_or(0.0)
            } else {
                far < round.radius
            }
    };
    (0..surfaces.len()).any(flat) || surfaces.iter().any(round)
}

/// Points on the skin of both cylinders, at positions along every move: if one is in the material, a collision is found no later than there; if a collision is
/// found, its position is at the skin of the material.
#[test]
fn points_on_the_cylinders_agree() {
    let mut met = 0;
    let mut clear = 0;
    let cycles = [
        "internal-rectangle-protected",
        "external-rectangle",
        "hole",
        "hole-protected",
        "boss",
        "groove-protected",
        "web",
        "double-wall-internal-corner",
        "triple-wall-external-corner",
    ];
    for (k, cycle) in cycles.into_iter().cycle().take(9 * 12).enumerate() {
        // Random values, the same in every run.
        let draw = |n: usize, low: f64, high: f64| {
            low + (high - low) * (((k * 7919 + n * 104_729) % 1009) as f64 / 1009.0)
        };
        let own = job(&format!(
            r#"{{ "format": 1, "plane": "{}", "cycle": {{ "type": "{cycle}", "rotation": {} }},
                "part": {{ "offset": [{}, {}, {}], "rotation": {} }} }}"#,
            ["G17", "G18", "G19"][k % 3],
            draw(1, -180.0, 180.0),
            draw(2, -0.5, 0.5),
            draw(3, -0.5, 0.5),
            draw(4, -0.5, 0.5),
            draw(5, -0.3, 0.3)
        ));
        let touchpath::job::PlannedJob {
            job: checked,
            path,
            surfaces,
            run,
            ..
        } = touchpath::job::planned(&own).unwrap();
        assert!(run.collision.is_none());
        let up = path.frame.w;
        let shape = StylusShape {
            length: Some(draw(6, 2.0, 14.0)),
            shank: Some(draw(7, 1.0, 9.0)),
            body: Some(draw(8, 8.0, 60.0)),
        };
        let found = part::stylus_collision(&path, &surfaces, &shape, checked.setup.radius, &run);
        let topped = path.top.is_some();
        // Deepest point of a cylinder in the material, at this position of the ball.
        let in_part = |center: Vec3, shrink: f64| {
            [
                (shape.shank.unwrap(), 0.0, true),
                (shape.body.unwrap(), shape.length.unwrap(), topped),
            ]
            .into_iter()
            .any(|(diameter, rise, counts)| {
                let radius = diameter / 2.0 - shrink;
                counts
                    && (0..90).any(|i| {
                        let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 90.0).sin_cos();
                        [1.0, 0.5, 0.0].into_iter().any(|part| {
                            let p = center
                                + up * (rise + shrink)
                                + (path.frame.u * cos + path.frame.v * sin) * (radius * part);
                            is_inside(&surfaces, p, up)
                        })
                    })
            })
        };
        let mut at = path.start;
        'moves: for (index, step) in path.moves.iter().enumerate() {
            let from = at.unwrap_or(step.to);
            let to = match step.purpose {
                touchpath::path::MovePurpose::Touch(t) => run.triggers[t].unwrap(),
                _ => step.to,
            };
            for i in 0..=10 {
                let center = from + (to - from) * (f64::from(i) / 10.0);
                if let Some(found) = found
                    && (found.index < index
                        || (found.index == index
                            && (center - from).length() >= (found.center - from).length()))
                {
                    break 'moves;
                }
                assert!(
                    !in_part(center, 0.01),
                    "{cycle} {k}: move {index} at {center} is in the part, found {found:?}, {shape:?}"
                );
            }
            at = Some(to);
        }
        match found {
            None => clear += 1,
            Some(found) => {
                met += 1;
                assert!(
                    in_part(found.center, -0.02),
                    "{cycle} {k}: {found:?} meets nothing, {shape:?}"
                );
                assert!(
                    found.part == StylusPart::Body
                        || shape.shank.unwrap() > 2.0 * checked.setup.radius
                );
            }
        }
    }
    assert!(met > 30 && clear > 10, "{met} {clear}");
}

/// The picture shows the given parts, from the side and not from the top, in true size: from the front a shank of 4 × 50 with a body of 40 above.
#[test]
fn the_stylus_is_seen_from_the_side() {
    use touchpath::job::Projection;
    let own = pocket(r#""length": 50, "shank": 4, "body": 40"#, "");
    let planned_job = touchpath::job::planned(&own).unwrap();
    let seen = |view| planned_job.picture(view, 1.0, None).scene.stylus;
    assert!(seen(Projection::Top).is_empty());
    let [shank, body] = seen(Projection::Front)[..] else {
        panic!()
    };
    // It leaves the ball at √(3² − 2²).
    assert_eq!(
        shank.map(|corner| corner.to_array()),
        [
            [-2.0, 5f64.sqrt()],
            [2.0, 5f64.sqrt()],
            [2.0, 50.0],
            [-2.0, 50.0]
        ]
    );
    assert_eq!(
        [body[0], body[1]].map(|corner| corner.to_array()),
        [[-20.0, 50.0], [20.0, 50.0]]
    );
    assert_eq!(seen(Projection::Side)[0], shank);
    assert!((seen(Projection::Isometric)[0][2][1] - 50.0 * (2f64 / 3.0).sqrt()).abs() < 1e-9);
    assert!(
        touchpath::job::planned(&pocket(r#""length": null"#, ""))
            .unwrap()
            .picture(Projection::Front, 1.0, None)
            .scene
            .stylus
            .is_empty()
    );
    planned(&own);
}
