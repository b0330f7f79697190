//! The stock: what is in it is found by hand, and by points of the ball on the way.

use crate::common::{Draws, job, planned, point, values, with};
use touchpath::form::{Finding, Level, Value};
use touchpath::geom::Vec3;
use touchpath::job::{check, convert_units, default_job, proposed_stock};
use touchpath::path::MovePurpose;
use touchpath::view::material::Material;
use touchpath::view::scene::Projection;

/// The findings about a stock.
fn found(job: &Value) -> Vec<Finding> {
    check(job)
        .into_iter()
        .filter(|finding| finding.path.starts_with("stock"))
        .collect()
}

/// The one finding: its code, and the numbers and names in it.
fn the(job: &Value) -> (String, Vec<String>) {
    let [finding] = &found(job)[..] else {
        panic!("{:?}", check(job))
    };
    assert_eq!(
        (finding.level, finding.path.as_str()),
        (Level::Error, "stock")
    );
    (finding.code.clone(), values(finding))
}

fn stock(origin: [f64; 3], size: [f64; 3]) -> Value {
    Value::Map(vec![
        ("origin".to_owned(), point(origin)),
        ("size".to_owned(), point(size)),
    ])
}

/// A pocket of 80 × 50 in a block of 120 × 90 × 30 with its top at Z0; ball 6.
fn pocket(stylus: &str) -> Value {
    job(&format!(
        r#"{{ "format": 1, "control": {{ "post": "linuxcnc" }}, "stylus": {{ "diameter": 6, {stylus} "repeatability": 0.001 }},
            "stock": {{ "origin": [-60, -45, -30], "size": [120, 90, 30] }},
            "cycle": {{ "type": "internal-rectangle-protected", "width1": 80, "width2": 50, "depth": 10, "topClearance": 10,
            "sideClearance1": 8, "sideClearance2": 8 }} }}"#
    ))
}

#[test]
fn a_pocket_is_open_in_its_block_and_nowhere_else() {
    assert_eq!(found(&pocket("")), []);
    // In a block that is 20 higher the pocket is open up to its top.
    let high = with(&pocket(""), "stock.size", point([120.0, 90.0, 50.0]));
    assert_eq!(found(&high), []);
    // A pocket of 80 whose walls are 8 from where the ball goes down; a body of 40 in a block that is higher reaches over them: its lower end is 50
    // above the ball, which is at Z-10.
    let body = r#""length": 50, "shank": 4, "body": 40,"#;
    let top = |z: f64| with(&pocket(body), "stock.size", point([120.0, 90.0, 30.0 + z]));
    assert_eq!(found(&top(39.9)), []);
    let (code, values) = the(&top(45.0));
    assert_eq!(code, "shank-collision");
    // From 10 above the top side down: at Z-5 the lower end is at Z45.
    assert_eq!(values.last().unwrap(), "X 32, Y 0, Z -5");
}

/// The corner and the surface that hazards were shown with: the surface is touched 6 below the top of the block that the corner bounds.
#[test]
fn a_surface_below_the_top_of_the_stock_is_refused() {
    let set_up = |z: f64| {
        job(&format!(
            r#"{{ "format": 2, "control": {{ "post": "linuxcnc" }}, "stylus": {{ "diameter": 6 }},
                "stock": {{ "origin": [0, 0, -30], "size": [100, 80, 36] }},
                "cycles": [
                    {{ "name": "CORNER", "type": "double-wall-external-corner", "origin": [0, 0, -5], "count1": 2, "count2": 2 }},
                    {{ "name": "SURFACE", "type": "surface", "origin": [20, 20, {z}] }} ] }}"#
        ))
    };
    assert_eq!(found(&set_up(6.0)), []);
    let (code, values) = the(&set_up(0.0));
    assert_eq!(code, "collision");
    // The ball stops with its centre 3 above the top, at Z6, within the tolerance of the check.
    assert!(
        values.last().unwrap().starts_with("X 20, Y 20, Z 8.99"),
        "{values:?}"
    );
}

/// A pocket's depth is measured on its floor, below the touches of its walls.
#[test]
fn the_floor_of_a_pocket_is_where_a_surface_is_touched() {
    let set_up = |x: f64| {
        job(&format!(
            r#"{{ "format": 2, "control": {{ "post": "linuxcnc" }}, "stylus": {{ "diameter": 6 }},
                "stock": {{ "origin": [-60, -45, -40], "size": [120, 90, 40] }},
                "cycles": [
                    {{ "name": "POCKET", "type": "internal-rectangle", "width1": 80, "width2": 50, "depth": 10, "topClearance": 10 }},
                    {{ "name": "FLOOR", "type": "surface", "origin": [{x}, 0, -20] }} ] }}"#
        ))
    };
    assert_eq!(found(&set_up(0.0)), []);
    // Beside the pocket the same surface lies in the material.
    assert_eq!(the(&set_up(50.0)).0, "collision");
    // An inside corner has two walls and no others: how far its floor reaches is not known, and a deep surface far away does not open all of it.
    let corner = job(
        r#"{ "format": 2, "control": { "post": "linuxcnc" }, "stylus": { "diameter": 6 },
            "stock": { "origin": [-60, -60, -80], "size": [400, 400, 90] },
            "cycles": [
                { "name": "CORNER", "type": "double-wall-internal-corner" },
                { "name": "DEEP", "type": "surface", "origin": [200, 200, -50] } ] }"#,
    );
    assert_eq!(the(&corner).0, "collision");
}

/// The ball below a thin block has its stylus in it, and a block that is wrongly above the path holds everything.
#[test]
fn a_block_goes_on_below_its_lower_side() {
    let of = |cycle: &str, stock: &str| {
        job(&format!(
            r#"{{ "format": 1, "control": {{ "post": "linuxcnc" }}, "stylus": {{ "diameter": 6 }}, "stock": {{ {stock} }}, "cycle": {{ {cycle} }} }}"#
        ))
    };
    let block = r#""type": "external-rectangle", "width1": 80, "width2": 50, "depth": 10, "sideClearance1": 8, "sideClearance2": 8"#;
    let wide = |bottom: f64| {
        of(
            block,
            &format!(
                r#""origin": [-43, -28, {bottom}], "size": [86, 56, {}]"#,
                -bottom
            ),
        )
    };
    for bottom in [-30.0, -5.0] {
        assert_eq!(the(&wide(bottom)).0, "collision");
    }
    let above = of(
        r#""type": "surface""#,
        r#""origin": [-50, -50, 40], "size": [100, 100, 30]"#,
    );
    assert_eq!(the(&above).0, "collision");
}

#[test]
fn the_way_between_features_is_above_the_stock() {
    let holes = |clear: f64| {
        job(&format!(
            r#"{{ "format": 2, "control": {{ "post": "linuxcnc" }}, "stylus": {{ "diameter": 6 }}, "clear": {clear},
                "stock": {{ "origin": [-30, -30, -30], "size": [140, 60, 40] }},
                "cycles": [
                    {{ "name": "A", "type": "hole", "diameter": 25 }},
                    {{ "name": "B", "type": "hole", "diameter": 25, "origin": [80, 0, 0] }} ] }}"#
        ))
    };
    // The block ends at Z10: at 13 the ball clears it.
    assert_eq!(found(&holes(13.0)), []);
    let (code, values) = the(&holes(12.0));
    assert_eq!(code, "collision");
    // At Z12 the ball is √5 wide 2 above the top: it leaves the hole at 12.5 − 2.236 = 10.264.
    assert!(values.last().unwrap().starts_with("X 10.27"), "{values:?}");
}

/// The same block 1.5 mm higher on the machine: its top is at Z11.5, and the program moves across at Z13 as on the drawing.
#[test]
fn the_way_between_features_is_checked_on_the_displaced_part_too() {
    let holes = |part: &str| {
        job(&format!(
            r#"{{ "format": 2, "control": {{ "post": "linuxcnc" }}, "stylus": {{ "diameter": 6 }}, "clear": 13, "part": {{ {part} }},
                "stock": {{ "origin": [-30, -30, -30], "size": [140, 60, 40] }},
                "cycles": [
                    {{ "name": "A", "type": "hole", "diameter": 25 }},
                    {{ "name": "B", "type": "hole", "diameter": 25, "origin": [80, 0, 0] }} ] }}"#
        ))
    };
    let warned = |part: &str| {
        let findings = check(&holes(part));
        let mut hits = findings
            .into_iter()
            .filter(|finding| finding.code == "collision");
        let hit = hits.next();
        assert!(hits.next().is_none());
        hit.map(|hit| (hit.level, hit.path.clone(), values(&hit)))
    };
    assert_eq!(warned(r#""offset": [0, 0, -2]"#), None);
    assert_eq!(warned(r#""rotation": 1"#), None);
    let (level, path, values) = warned(r#""offset": [0, 0, 1.5]"#).unwrap();
    assert_eq!((level, path.as_str()), (Level::Warning, "part"));
    // 1.5 above the top the ball is 2.598 wide: it leaves the hole at 12.5 − 2.598 = 9.902, and 0.01 later with the tolerances.
    assert!(
        values.iter().any(|value| value.starts_with("X 9.91")),
        "{values:?}"
    );
}

/// A job with a stock is the same program below its header, and the header gives the stock back.
#[test]
fn a_stock_changes_no_block_and_returns_with_the_program() {
    let with_stock = pocket("");
    let without = with(&with_stock, "stock", Value::Null);
    let blocks = |job: &Value| {
        let text = planned(job).program.text;
        let hash = text.lines().find(|line| line.contains("Blocks below"));
        hash.expect("a hash over the blocks").to_owned()
    };
    assert_eq!(blocks(&with_stock), blocks(&without));
    let lines = |job: &Value| planned(job).program.text.matches("stock").count();
    assert!(lines(&with_stock) > 0);
    assert_eq!(lines(&without), 0);
    let read = crate::common::import(&planned(&with_stock).program.text).unwrap();
    assert_eq!(read.job.get("stock"), with_stock.get("stock"));
    let inch = convert_units(&with_stock, "inch").unwrap();
    assert_eq!(found(&inch), []);
    assert_eq!(
        inch.get("stock").and_then(|stock| stock.get("size")),
        Some(&point([4.724_409, 3.543_307, 1.181_102]))
    );
}

#[test]
fn a_stock_without_a_size_or_with_a_wrong_one_is_named() {
    let of = |value: Value| {
        let findings = check(&with(&pocket(""), "stock", value));
        let mut codes: Vec<(String, String)> = findings
            .into_iter()
            .filter(|finding| finding.level == Level::Error)
            .map(|finding| (finding.code, finding.path))
            .collect();
        codes.sort();
        codes
    };
    let both = |code: &str, path: &str| (code.to_owned(), path.to_owned());
    assert_eq!(
        of(stock([0.0; 3], [10.0, 0.0, -1.0])),
        [
            both("out-of-range", "stock.size[1]"),
            both("out-of-range", "stock.size[2]"),
        ]
    );
    assert_eq!(
        of(Value::Map(vec![("place".to_owned(), Value::Number(1.0))])),
        [both("unknown-key", "stock.place")]
    );
    assert_eq!(of(Value::Number(5.0)), [both("wrong-type", "stock")]);
}

/// What each job is open at, from its own fields: a place of the plane, and the height of the lowest point of the ball.
type Open = Box<dyn Fn(Vec3) -> bool>;

fn drawn(draws: &mut Draws) -> (Value, Open) {
    let [x, y] = [draws.of(-10.0, 10.0), draws.of(-10.0, 10.0)];
    let depth = draws.of(5.0, 20.0);
    let place = format!(r#""origin": [{x}, {y}, 0], "depth": {depth}, "topClearance": 10"#);
    let of = |cycle: &str| {
        job(&format!(
            r#"{{ "format": 1, "control": {{ "post": "linuxcnc" }}, "stylus": {{ "diameter": 6 }}, "cycle": {{ {cycle}, {place} }} }}"#
        ))
    };
    let floor = -depth - 3.0;
    match draws.below(3) {
        0 => {
            let d = draws.of(20.0, 60.0);
            (
                of(&format!(r#""type": "hole", "diameter": {d}"#)),
                Box::new(move |p| (p.x - x).hypot(p.y - y) < d / 2.0 && p.z > floor),
            )
        }
        1 => {
            let [a, b] = [draws.of(30.0, 80.0), draws.of(30.0, 80.0)];
            (
                of(&format!(
                    r#""type": "internal-rectangle", "width1": {a}, "width2": {b}"#
                )),
                Box::new(move |p| {
                    (p.x - x).abs() < a / 2.0 && (p.y - y).abs() < b / 2.0 && p.z > floor
                }),
            )
        }
        _ => {
            let d = draws.of(20.0, 60.0);
            (
                of(&format!(
                    r#""type": "boss", "diameter": {d}, "sideClearance": 8"#
                )),
                Box::new(|_| false),
            )
        }
    }
}

/// Points of a ball, and its centre.
fn ball(radius: f64) -> Vec<Vec3> {
    const COUNT: usize = 200;
    let at = |k: usize| {
        let z = 1.0 - 2.0 * (k as f64 + 0.5) / COUNT as f64;
        let turn = k as f64 * 2.399_963;
        let flat = (1.0 - z * z).sqrt();
        Vec3::new(flat * turn.cos(), flat * turn.sin(), z) * radius
    };
    (0..COUNT).map(at).chain([Vec3::ZERO]).collect()
}

/// A ball that is a little smaller must not be in the material where nothing is found, and one that is a little larger must be where something is.
#[test]
fn the_check_agrees_with_points_of_the_ball_on_its_way() {
    let mut draws = Draws(7);
    let mut hits = 0;
    for _ in 0..120 {
        let (alone, open) = drawn(&mut draws);
        let low = [draws.of(-90.0, 0.0), draws.of(-90.0, 0.0), -40.0];
        let size = [
            draws.of(40.0, 120.0),
            draws.of(40.0, 120.0),
            draws.of(20.0, 60.0),
        ];
        let whole = with(&alone, "stock", stock(low, size));
        let errors = check(&alone)
            .iter()
            .any(|finding| finding.level == Level::Error);
        if errors {
            continue;
        }
        let hit = found(&whole)
            .iter()
            .any(|finding| finding.code == "collision");
        hits += usize::from(hit);
        let path = touchpath::job::planned(&alone).unwrap().path;
        let [low, size] = [low, size].map(Vec3::from_array);
        let solid = |p: Vec3| {
            let off = p - low;
            off.cmpgt(Vec3::ZERO).all() && off.cmplt(size).all() && !open(p)
        };
        let reaches = |radius: f64| {
            let points = ball(radius);
            let mut at = path.start;
            path.moves.iter().any(|step| {
                let from = at.replace(step.to).unwrap_or(step.to);
                // A touch ends at the wall: a larger ball would be in it.
                if radius > 3.0 && !matches!(step.purpose, MovePurpose::Position) {
                    return false;
                }
                let count = (from.distance(step.to) / 0.1).ceil().max(1.0) as usize;
                (0..=count).any(|k| {
                    let center = from.lerp(step.to, k as f64 / count as f64);
                    points.iter().any(|point| solid(center + *point))
                })
            })
        };
        if hit {
            assert!(reaches(3.0 + 0.15) || reaches(3.0), "{whole:?}");
        } else {
            assert!(!reaches(3.0 - 0.1), "{whole:?}");
        }
    }
    assert!((20..100).contains(&hits), "{hits}");
}

/// The same for the way between two holes on displaced parts: the ball, with each touch up to its trigger, is turned back to the drawing by hand.
#[test]
fn the_check_on_a_displaced_part_agrees_with_points_of_the_ball() {
    let mut draws = Draws(11);
    let (mut hits, mut runs) = (0, 0);
    for _ in 0..150 {
        let [d1, d2] = [draws.of(15.0, 40.0), draws.of(15.0, 40.0)];
        let [x, y] = [draws.of(50.0, 90.0), draws.of(-30.0, 30.0)];
        let clear = draws.of(28.0, 32.0);
        let alone = job(&format!(
            r#"{{ "format": 2, "control": {{ "post": "linuxcnc" }}, "stylus": {{ "diameter": 6 }}, "clear": {clear},
                "cycles": [
                    {{ "name": "A", "type": "hole", "diameter": {d1}, "topClearance": 8 }},
                    {{ "name": "B", "type": "hole", "diameter": {d2}, "topClearance": 8, "origin": [{x}, {y}, 0] }} ] }}"#
        ));
        let open = |p: Vec3| p.x.hypot(p.y) < d1 / 2.0 || (p.x - x).hypot(p.y - y) < d2 / 2.0;
        let (low, size) = ([-60.0, -70.0, -40.0], [220.0, 140.0, draws.of(62.0, 72.0)]);
        let offset = [
            draws.of(-2.0, 2.0),
            draws.of(-2.0, 2.0),
            draws.of(-4.0, 4.0),
        ];
        let rotation = draws.of(-1.0, 1.0);
        let part = Value::Map(vec![
            ("offset".to_owned(), point(offset)),
            ("rotation".to_owned(), Value::Number(rotation)),
        ]);
        let displaced = with(&alone, "part", part);
        let whole = with(&displaced, "stock", stock(low, size));
        let planned = touchpath::job::planned(&displaced);
        let Some(planned) = planned.filter(|planned| {
            let run = &planned.run;
            run.collision.is_none() && run.triggers.iter().all(Option::is_some)
        }) else {
            continue;
        };
        let findings = check(&whole);
        if findings.iter().any(|finding| finding.level == Level::Error) {
            continue;
        }
        runs += 1;
        let hit = findings
            .iter()
            .any(|finding| finding.code == "collision" && finding.path == "part");
        hits += usize::from(hit);
        let [low, size] = [low, size].map(Vec3::from_array);
        let (sin, cos) = rotation.to_radians().sin_cos();
        let solid = |p: Vec3| {
            let [x, y, z] = (p - Vec3::from_array(offset)).to_array();
            let drawn = Vec3::new(cos * x + sin * y, cos * y - sin * x, z);
            let off = drawn - low;
            off.cmpgt(Vec3::ZERO).all()
                && off.cmplt(size).all()
                && !open(Vec3::new(drawn.x, drawn.y, 0.0))
        };
        let reaches = |radius: f64| {
            let points = ball(radius);
            let mut at = planned.path.start;
            planned.path.moves.iter().any(|step| {
                let from = at.unwrap_or(step.to);
                let to = match step.purpose {
                    MovePurpose::Touch(k) => planned.run.triggers[k].unwrap(),
                    _ => step.to,
                };
                at = Some(to);
                if radius > 3.0 && !matches!(step.purpose, MovePurpose::Position) {
                    return false;
                }
                let count = (from.distance(to) / 0.1).ceil().max(1.0) as usize;
                (0..=count).any(|k| {
                    let center = from.lerp(to, k as f64 / count as f64);
                    points.iter().any(|point| solid(center + *point))
                })
            })
        };
        if hit {
            assert!(reaches(3.0 + 0.15) || reaches(3.0), "{whole:?}");
        } else {
            assert!(!reaches(3.0 - 0.1), "{whole:?}");
        }
    }
    assert!(hits >= 10 && runs >= 2 * hits, "{hits} of {runs}");
}

/// A proposed stock is one that the check takes, whatever the cycle; what it is, by hand.
#[test]
fn a_proposed_stock_fits_the_features() {
    let of = |job: &Value| proposed_stock(&touchpath::job::planned(job)?);
    let mut none = Vec::new();
    for def in touchpath::cycle::CYCLES {
        let alone = default_job(def.key).unwrap();
        match of(&alone) {
            Some(stock) => assert_eq!(found(&with(&alone, "stock", stock)), [], "{}", def.key),
            None => none.push(def.key),
        }
    }
    assert_eq!(none, ["probe-on-off", "nc-action"]);

    // The vise corner: flush with both walls, a margin beyond the last touch, the top where it is measured.
    let vise = job(
        r#"{ "format": 2, "control": { "post": "linuxcnc" }, "stylus": { "diameter": 6 },
            "cycles": [
                { "name": "TOP", "type": "surface", "origin": [20, 20, 0] },
                { "name": "CORNER", "type": "double-wall-external-corner", "origin": [0, 0, -5], "count1": 2, "count2": 2 } ] }"#,
    );
    let block = of(&vise).unwrap();
    let numbers = |key: &str| match block.get(key) {
        Some(Value::List(list)) => list.clone(),
        _ => panic!(),
    };
    let (low, size) = (numbers("origin"), numbers("size"));
    assert_eq!(low[..2], [Value::Number(0.0), Value::Number(0.0)]);
    let [Value::Number(bottom), Value::Number(height)] = [&low[2], &size[2]] else {
        panic!()
    };
    assert_eq!(bottom + height, 0.0);
    assert_eq!(found(&with(&vise, "stock", block)), []);

    // The floor of an inside corner is not the top of its block.
    let corner = of(&default_job("triple-wall-internal-corner").unwrap()).unwrap();
    let touches = planned(&default_job("triple-wall-internal-corner").unwrap()).touches;
    let highest = touches
        .iter()
        .map(|touch| touch.point[2])
        .fold(f64::MIN, f64::max);
    let end = |key: &str| match corner.get(key) {
        Some(Value::List(list)) => match list[2] {
            Value::Number(z) => z,
            _ => panic!(),
        },
        _ => panic!(),
    };
    assert_eq!(end("origin") + end("size"), highest + 10.0);

    // In inch its ends are tenths of an inch.
    let inch = convert_units(&pocket(""), "inch").unwrap();
    let block = of(&with(&inch, "stock", Value::Null)).unwrap();
    assert_eq!(block.get("origin"), Some(&point([-2.0, -1.4, -1.0])));
}

/// The stock takes the place of the material around a hole; a boss above it keeps its own.
#[test]
fn the_picture_has_one_body_and_what_is_above_it() {
    let material = |cycle: &str, view: Projection| {
        let job = job(&format!(
            r#"{{ "format": 1, "control": {{ "post": "linuxcnc" }}, "stylus": {{ "diameter": 6 }},
                "stock": {{ "origin": [-60, -60, -60], "size": [120, 120, 40] }}, "cycle": {{ {cycle} }} }}"#
        ));
        let scene = touchpath::job::planned(&job)
            .unwrap()
            .picture(view, 1.0, None)
            .scene;
        let body = |one: &Material| matches!(one, Material::Body { .. });
        assert_eq!(scene.material.iter().filter(|one| body(one)).count(), 1);
        scene.material.len() - 1
    };
    let boss = r#""type": "boss", "diameter": 30"#;
    assert_eq!(material(boss, Projection::Top), 1);
    assert!(material(boss, Projection::Front) > 0);
    let hole = r#""type": "hole", "diameter": 30, "origin": [0, 0, -20]"#;
    for view in [Projection::Top, Projection::Front, Projection::Side] {
        assert_eq!(material(hole, view), 0);
    }
}
