//! Picked touches: they replace the dimensions; touches that define no feature are refused.

use super::{cycle, dumped_job, near, picked, value};
use crate::common::import;
use crate::common::{job, law, number, planned, with};
use proptest::prelude::*;
use touchpath::cycle::CYCLES;
use touchpath::describe::export_table;
use touchpath::form::{Level, Value};
use touchpath::job::{check, plan};

const POCKET: [([f64; 3], [f64; 3]); 4] = [
    ([40.0, 5.0, -10.0], [-1.0, 0.0, 0.0]),
    ([-40.0, -6.0, -10.0], [1.0, 0.0, 0.0]),
    ([7.0, 25.0, -10.0], [0.0, -1.0, 0.0]),
    ([-9.0, -25.0, -10.0], [0.0, 1.0, 0.0]),
];

#[test]
fn picked_touches_replace_the_dimensions() {
    let plan = planned(&picked("internal-rectangle-protected", "", &POCKET));
    for (touch, (point, vector)) in plan.touches.iter().zip(POCKET) {
        assert_eq!((touch.point, touch.vector), (point, vector));
    }
    // The middle is between the walls, the top side the depth above the touches, the start the top clearance above that.
    assert_eq!(plan.moves[1].to, [0.0, 0.0, 10.0]);
    assert_eq!(plan.moves[2].to, [32.0, 5.0, 10.0]);
    assert!(near(value(&plan, "width1"), 80.0) && near(value(&plan, "center.y"), 0.0));
    // The picks decide, the form only fills the table, and the difference is reported.
    let other = picked(
        "internal-rectangle-protected",
        r#""width1": 90, "rotation": 45, "origin": [500, 0, 0],"#,
        &POCKET,
    );
    let plan = planned(&other);
    assert!(near(value(&plan, "width1"), 80.0));
    assert!(
        plan.findings
            .iter()
            .any(|f| f.code == "picks-differ" && f.path == "cycle.width1"),
        "{:?}",
        plan.findings
    );
    assert!(
        export_table(&plan, "text")
            .unwrap()
            .contains("Flt[-53] = 90\n")
    );
    // Replaced dimensions are not checked; those of the picks are.
    planned(&picked(
        "internal-rectangle-protected",
        r#""width1": 4,"#,
        &POCKET,
    ));
    let narrow = picked(
        "internal-rectangle-protected",
        r#""sideClearance1": 78,"#,
        &POCKET,
    );
    assert!(
        check(&narrow)
            .iter()
            .any(|f| f.code == "approach-beyond-wall" && f.path == "cycle.sideClearance1")
    );
    // A vector within a thousandth of unit length is normalised.
    let mut long = POCKET;
    long[0].1 = [-1.0009, 0.0, 0.0];
    assert_eq!(
        planned(&picked("internal-rectangle-protected", "", &long)).touches[0].vector,
        [-1.0, 0.0, 0.0]
    );
    // An inner corner: one start.
    let corner = [
        ([0.0, 20.0, 0.0], [1.0, 0.0, 0.0]),
        ([15.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    ];
    let rest = r#""count1": 1, "count2": 1, "clearance1": 15, "clearance2": 20,"#;
    assert_eq!(
        planned(&picked("double-wall-internal-corner", rest, &corner)).moves[1].to,
        [15.0, 20.0, 0.0]
    );
}

/// Walls in the reverse order: the same corner with its sides exchanged has the same results.
#[test]
fn a_corner_may_be_picked_with_its_walls_in_either_order() {
    let part = r#"{ "offset": [0.3, -0.2, 0], "rotation": 0.4, "sizes": { "angle": 0.2 } }"#;
    for kind in ["double-wall-internal-corner", "double-wall-external-corner"] {
        let text = format!(
            r#"{{ "format": 1, "cycle": {{ "type": "{kind}", "origin": [10, 20, -4], "rotation": 25, "angle": 75, "count1": 2, "count2": 2 }},
            "part": {part} }}"#
        );
        let first = planned(&job(&text));
        let order = [2, 3, 0, 1];
        let picks: Vec<_> = order
            .iter()
            .map(|&k| (first.touches[k].point, first.touches[k].vector))
            .collect();
        let picked = picked(kind, r#""count1": 2, "count2": 2,"#, &picks);
        let second = planned(&with(&picked, "part", job(part)));
        for code in ["corner.x", "corner.y", "angle", "rotation"] {
            assert!(
                (value(&first, code) - value(&second, code)).abs() < 1e-7,
                "{kind} {code}"
            );
        }
        assert_eq!(
            second.moves[1].to.map(|x| (x * 1e6).round()),
            first.moves[1].to.map(|x| (x * 1e6).round()),
            "{kind}: one start"
        );
    }
    let inner = [
        ([15.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        ([0.0, 15.0, 0.0], [1.0, 0.0, 0.0]),
    ];
    let plan = planned(&picked(
        "double-wall-internal-corner",
        r#""count1": 1, "count2": 1,"#,
        &inner,
    ));
    assert_eq!(plan.moves[1].to, [15.0, 15.0, 0.0]);
    for kind in ["triple-wall-internal-corner", "triple-wall-external-corner"] {
        let first = planned(&cycle(&format!(
            r#"{{ "type": "{kind}", "rotation": 40, "angle": 100 }}"#
        )));
        let picks: Vec<_> = [1, 0, 2]
            .iter()
            .map(|&k| (first.touches[k].point, first.touches[k].vector))
            .collect();
        let second = planned(&with(
            &picked(kind, "", &picks),
            "part.offset",
            crate::common::point([0.2, 0.1, -0.3]),
        ));
        for (code, off) in [("corner.x", 0.2), ("corner.y", 0.1), ("corner.z", -0.3)] {
            assert!(near(value(&second, code), off), "{kind} {code}");
        }
        assert_eq!(
            second.moves[1].to.map(|x| (x * 1e6).round()),
            first.moves[1].to.map(|x| (x * 1e6).round()),
            "{kind}: one start"
        );
    }
}

#[test]
fn picks_that_make_no_feature_are_refused() {
    let found = |job: &Value| -> Vec<String> {
        check(job)
            .iter()
            .filter(|f| f.level == Level::Error)
            .map(|f| format!("{} {}", f.code, f.path))
            .collect()
    };
    let with_pick = |k: usize, point: [f64; 3], vector: [f64; 3]| {
        let mut picks = POCKET;
        picks[k] = (point, vector);
        found(&picked("internal-rectangle-protected", "", &picks))
    };
    assert_eq!(
        with_pick(0, POCKET[0].0, [-1.002, 0.0, 0.0]),
        ["vector-not-unit cycle.touches[0].vector"]
    );
    assert_eq!(
        with_pick(0, POCKET[0].0, [0.0, 0.0, 0.0]),
        ["vector-not-unit cycle.touches[0].vector"]
    );
    let askew = [
        "vectors-not-opposite cycle.touches[1].vector",
        "pairs-not-square cycle.touches[2].vector",
    ];
    assert_eq!(with_pick(0, POCKET[0].0, [-0.8, 0.6, 0.0]), askew);
    assert_eq!(
        with_pick(0, POCKET[0].0, [-0.8, 0.0, 0.6])[0],
        "vector-not-in-plane cycle.touches[0].vector"
    );
    // Both vectors of a pair reversed: the sign check of an internal feature.
    let mut outside = POCKET;
    for pick in &mut outside[..2] {
        pick.1 = pick.1.map(|x| -x);
    }
    let wrong = [
        "vector-wrong-way cycle.touches[0].vector",
        "vector-wrong-way cycle.touches[1].vector",
    ];
    assert_eq!(
        found(&picked("internal-rectangle-protected", "", &outside)),
        wrong
    );
    let all_round = POCKET.map(|(p, v)| (p, v.map(|x| -x)));
    assert_eq!(
        found(&picked("internal-rectangle-protected", "", &all_round)).len(),
        4
    );
    assert_eq!(found(&picked("external-rectangle", "", &POCKET)).len(), 4);
    assert_eq!(
        found(&picked("external-rectangle", "", &all_round)),
        [""; 0]
    );
    let circle = |inwards: f64| -> Vec<([f64; 3], [f64; 3])> {
        [0f64, 180.0, 90.0, 270.0]
            .map(|a| {
                let (sin, cos) = a.to_radians().sin_cos();
                (
                    [20.0 * cos, 20.0 * sin, -10.0],
                    [cos * inwards, sin * inwards, 0.0],
                )
            })
            .to_vec()
    };
    assert_eq!(found(&picked("hole", "", &circle(-1.0))), [""; 0]);
    assert_eq!(found(&picked("hole", "", &circle(1.0))).len(), 4);
    assert_eq!(found(&picked("boss", "", &circle(1.0))), [""; 0]);
    let mut dented = circle(-1.0);
    dented[2].0[1] = 19.0;
    assert_eq!(
        found(&picked("hole", "", &dented)),
        ["not-on-one-circle cycle.touches[2]"]
    );
    // Cycles that touch from the centre need touches straight in front of it.
    assert_eq!(
        found(&picked("internal-rectangle", "", &POCKET))[0],
        "touch-aside cycle.touches[0].point"
    );
    let mut low = circle(-1.0);
    low[1].0[2] = -15.0;
    assert_eq!(
        found(&picked("hole", "", &low)),
        ["touches-not-level cycle.touches[1].point"]
    );
    let mut clockwise = circle(-1.0);
    clockwise.swap(2, 3);
    assert_eq!(
        found(&picked("hole", "", &clockwise)),
        ["not-rectangular cycle.touches[2].vector"]
    );
    assert_eq!(
        found(&picked("hole", r#""variant": 1,"#, &clockwise)),
        [""; 0]
    );
    // Two touches at one position define no direction of a wall.
    let spot = [
        ([0.0, 15.0, 0.0], [-1.0, 0.0, 0.0]),
        ([0.0, 15.0, 0.0], [-1.0, 0.0, 0.0]),
        ([15.0, 0.0, 0.0], [0.0, -1.0, 0.0]),
        ([35.0, 0.0, 0.0], [0.0, -1.0, 0.0]),
    ];
    assert_eq!(
        found(&picked("double-wall-external-corner", "", &spot)),
        ["touches-coincide cycle.touches[1]"]
    );
    // For an ambiguous start both interpretations are reported.
    let corner = [
        ([0.0, 21.0, 0.0], [1.0, 0.0, 0.0]),
        ([15.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    ];
    let rest = r#""count1": 1, "count2": 1, "clearance1": 15, "clearance2": 20,"#;
    let two = picked("double-wall-internal-corner", rest, &corner);
    assert_eq!(found(&two), ["starts-disagree cycle.touches"]);
    let said = crate::common::values(&check(&two)[0]);
    assert!(
        ["[15, 21, 0]", "[15, 20, 0]"]
            .iter()
            .all(|place| said.iter().any(|known| known == place)),
        "{said:?}"
    );
    let outer = [
        ([0.0, 20.0, 0.0], [1.0, 0.0, 0.0]),
        ([15.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    ];
    assert_eq!(
        found(&picked(
            "double-wall-external-corner",
            r#""count1": 1, "count2": 1,"#,
            &outer
        ))
        .len(),
        2
    );
    // Counts, shapes, types.
    assert_eq!(
        found(&picked("internal-rectangle-protected", "", &POCKET[..3])),
        ["wrong-count cycle.touches"]
    );
    assert_eq!(
        found(&picked("web", "", &[])),
        ["wrong-count cycle.touches"]
    );
    assert_eq!(
        found(&cycle(
            r#"{ "type": "web", "touches": [7, { "point": [1, 2], "vector": [1, 0, 0], "x": 1 }] }"#
        ))
        .len(),
        4
    );
    assert_eq!(
        found(&cycle(r#"{ "type": "web", "touches": "all" }"#)),
        ["wrong-type cycle.touches"]
    );
    assert_eq!(
        found(&cycle(r#"{ "type": "nc-action", "touches": [] }"#)),
        ["unknown-key cycle.touches"]
    );
    let custom = r#"{ "type": "web", "custom": [{ "code": -5, "type": "Int", "value": 1 }, { "code": 5, "type": "Int", "value": 1.5 },
        { "code": 6, "type": "Flt", "value": 1 }, { "code": 6, "type": "Flt", "value": 1, "y\nG0 Z-9": 1 }] }"#;
    let wrong = [
        "wrong-code cycle.custom[0].code",
        "wrong-type cycle.custom[1]",
        "unknown-key cycle.custom[3].y\u{fffd}G0 Z-9",
        "code-twice cycle.custom[3].code",
    ];
    assert_eq!(found(&cycle(custom)), wrong);
}

/// Picking the same touches as the dimensions give changes nothing, at any position of the feature; a displaced part, or one with other sizes, has the same
/// results.
#[test]
fn picking_what_the_dimensions_give_changes_nothing() {
    law(
        300,
        80,
        (dumped_job(), -0.3..0.3f64, -0.3..0.3f64, -0.2..0.2f64),
        |(job, dx, dy, grown)| {
            let Ok(first) = plan(&job) else {
                return Ok(false);
            };
            if first.touches.is_empty() {
                return Ok(false);
            }
            let triple = |p: [f64; 3]| Value::List(p.map(Value::Number).to_vec());
            let picks = first
                .touches
                .iter()
                .map(|t| {
                    Value::Map(vec![
                        ("point".to_owned(), triple(t.point)),
                        ("vector".to_owned(), triple(t.vector)),
                    ])
                })
                .collect();
            let picked = with(&job, "cycle.touches", Value::List(picks));
            let picked = with(
                &with(&picked, "cycle.origin", triple([17.0, -3.0, 8.0])),
                "cycle.rotation",
                number(11.0),
            );
            let def = CYCLES
                .iter()
                .find(|c| {
                    Some(&Value::Text(c.key.to_owned())) == job.get("cycle").unwrap().get("type")
                })
                .unwrap();
            let size = def.fields.iter().find(|f| f.size);
            let off = |job: &Value| {
                let job = with(job, "part.offset", triple([dx, dy, 0.0]));
                match size {
                    Some(field) => plan(&with(
                        &job,
                        &format!("part.sizes.{}", field.key),
                        number(grown),
                    )),
                    None => plan(&job),
                }
            };
            let second = plan(&picked).map_err(|e| TestCaseError::fail(format!("{e}")))?;
            for (a, b) in [(Ok(first), Ok(second)), (off(&job), off(&picked))] {
                let (Ok(a), Ok(b)) = (&a, &b) else {
                    prop_assert_eq!(a.is_ok(), b.is_ok(), "{:?} {:?}", a.err(), b.err());
                    continue;
                };
                prop_assert_eq!(a.moves.len(), b.moves.len());
                for (m, n) in a.moves.iter().zip(&b.moves) {
                    prop_assert!(
                        (0..3).all(|i| (m.to[i] - n.to[i]).abs() < 1e-5),
                        "{:?} {:?}",
                        m,
                        n
                    );
                    prop_assert_eq!(
                        (m.kind, m.feed, m.step, m.touch),
                        (n.kind, n.feed, n.step, n.touch)
                    );
                }
                for (r, s) in a.results.iter().zip(&b.results) {
                    prop_assert_eq!(&r.code, &s.code);
                    let same = match (r.value, s.value) {
                        (Some(r), Some(s)) => (r - s).abs() < 1e-5,
                        (r, s) => r.is_some() == s.is_some(),
                    };
                    prop_assert!(same, "{:?} {:?}", r, s);
                }
            }
            Ok(true)
        },
    );
}

/// Picked touches survive a dump as picked touches.
#[test]
fn picked_touches_come_back_as_picked() {
    let pocket = picked(
        "internal-rectangle-protected",
        r#""width1": 80, "width2": 50, "#,
        &POCKET,
    );
    let first = planned(&pocket);
    let imported = import(&export_table(&first, "text").unwrap()).unwrap();
    assert!(
        imported.findings.iter().any(|f| f.code == "touches-kept"),
        "{:?}",
        imported.findings
    );
    let second = planned(&imported.job);
    assert_eq!(second.touches, first.touches);
    assert_eq!(second.moves, first.moves);
    assert_eq!(second.table, first.table);
}

/// The depth of the form was in the table without a note, although the touches on the walls are deeper below the one on top.
#[test]
fn a_depth_that_the_picks_do_not_have_is_said() {
    let corner = [
        ([0.0, 15.0, -25.0], [-1.0, 0.0, 0.0]),
        ([15.0, 0.0, -25.0], [0.0, -1.0, 0.0]),
        ([15.0, 15.0, 0.0], [0.0, 0.0, 1.0]),
    ];
    let web = [
        ([-15.0, 0.0, -25.0], [-1.0, 0.0, 0.0]),
        ([15.0, 0.0, -25.0], [1.0, 0.0, 0.0]),
        ([0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ];
    for (kind, picks) in [
        ("triple-wall-external-corner", corner),
        ("web-three-points", web),
    ] {
        for (depth, said) in [(10, true), (25, false)] {
            let plan = planned(&picked(kind, &format!(r#""depth": {depth},"#), &picks));
            let found = plan
                .findings
                .iter()
                .find(|f| f.code == "picks-differ" && f.path == "cycle.depth");
            assert_eq!(found.is_some(), said, "{kind} {depth} {:?}", plan.findings);
            assert!(
                found.is_none_or(|f| crate::common::values(f) == ["10 mm", "25 mm"]),
                "{found:?}"
            );
            // The start is the top clearance above the highest touch, for any value in the form.
            let highest = plan
                .moves
                .iter()
                .map(|step| step.to[2])
                .fold(f64::MIN, f64::max);
            assert!(
                highest > 5.0 && plan.touches[0].point[2] == -25.0,
                "{kind} {highest}"
            );
        }
    }
}
