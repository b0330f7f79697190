//! The virtual part against closed forms worked out by hand, and the uncertainties against 20,000 draws.

use crate::common::{job, number, planned, point, with};
use touchpath::form::{Level, Value};
use touchpath::job::{Plan, ResultRow, evaluate};

fn row<'a>(plan: &'a Plan, code: &str) -> &'a ResultRow {
    plan.results
        .iter()
        .find(|r| r.code == code)
        .unwrap_or_else(|| panic!("{code}"))
}

fn value(plan: &Plan, code: &str) -> f64 {
    row(plan, code)
        .value
        .unwrap_or_else(|| panic!("{code} has a value"))
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9, "{a} is not {b}");
}

fn pocket() -> Value {
    // 80 × 50 about the origin, ball 6, touches at the middle of each wall.
    job(
        r#"{ "format": 1, "control": { "workOffset": 1 }, "cycle": { "type": "internal-rectangle-protected",
        "width1": 80, "width2": 50, "depth": 10, "topClearance": 10, "sideClearance1": 8, "sideClearance2": 8 } }"#,
    )
}

fn corner() -> Value {
    job(
        r#"{ "format": 1, "cycle": { "type": "double-wall-internal-corner", "clearance1": 15, "clearance2": 15,
        "count1": 2, "count2": 2, "step1": 20, "step2": 30 } }"#,
    )
}

/// A pocket shifted by (0.5, −0.2): the ball centres stop at ±37 and ±22 shifted with it, the sizes are true.
#[test]
fn a_shifted_pocket() {
    let plan = planned(&with(&pocket(), "part.offset", point([0.5, -0.2, 0.0])));
    let x: Vec<f64> = [0, 1].map(|k| plan.triggers[k].unwrap()[0]).to_vec();
    let y: Vec<f64> = [2, 3].map(|k| plan.triggers[k].unwrap()[1]).to_vec();
    near(x[0], 37.5);
    near(x[1], -36.5);
    near(y[0], 21.8);
    near(y[1], -22.2);
    near(value(&plan, "center.x"), 0.5);
    near(value(&plan, "center.y"), -0.2);
    near(value(&plan, "width1"), 80.0);
    near(value(&plan, "offset.x"), 0.5);
    near(row(&plan, "center.x").truth.unwrap(), 0.5);
    assert_eq!(row(&plan, "rotation").value, None);
}

/// A pocket 0.3 wider: each wall moves out by 0.15, the centre stays.
#[test]
fn a_wider_pocket() {
    let plan = planned(&with(&pocket(), "part.sizes.width1", number(0.3)));
    near(plan.triggers[0].unwrap()[0], 37.15);
    near(value(&plan, "width1"), 80.3);
    near(row(&plan, "width1").deviation.unwrap(), 0.3);
    near(value(&plan, "center.x"), 0.0);
    near(value(&plan, "width2"), 50.0);
}

/// A pocket rotated by 3° about its centre. The ball touches a wall W/2 from the centre when its distance from it is r, so along the nominal direction it ends
/// at (W/2 − r)/cos 3°. With the radius added along that direction the width reads (W − d)/cos 3° + d: too wide by (W − d)(1/cos 3° − 1).
#[test]
fn a_turned_pocket_reads_too_wide_by_the_cosine_error() {
    let plan = planned(&with(&pocket(), "part.rotation", number(3.0)));
    // 1/cos 3° = 1.001372345…, by a table of secants.
    let secant = 1.001_372_345_9;
    assert!((plan.triggers[0].unwrap()[0] - 37.0 * secant).abs() < 1e-8);
    assert!((value(&plan, "width1") - (74.0 * secant + 6.0)).abs() < 1e-8);
    assert!((value(&plan, "width2") - (44.0 * secant + 6.0)).abs() < 1e-8);
    near(value(&plan, "center.x"), 0.0);
    near(row(&plan, "width1").truth.unwrap(), 80.0);
    near(row(&plan, "rotation").truth.unwrap(), 3.0);
    let note = row(&plan, "width1")
        .note
        .as_deref()
        .expect("the cosine error is named");
    assert!(
        note.starts_with("+0.10155 mm") && note.contains("cosine error"),
        "{note}"
    );
    // 74 · 0.0013723459 = 0.10155…
}

/// Rotated and shifted: the probing line Y = 0 misses the true centre by dy, and the middle between walls that are rotated by φ is where that line crosses the
/// rotated centre line: dy·tan φ further along X.
#[test]
fn a_turned_and_shifted_pocket_has_its_middle_on_the_probing_line() {
    let turned = with(&pocket(), "part.rotation", number(3.0));
    let plan = planned(&with(&turned, "part.offset", point([0.0, 1.0, 0.0])));
    let tangent = 0.052_407_779_283; // tan 3°
    assert!((value(&plan, "center.x") - tangent).abs() < 1e-9);
    near(row(&plan, "center.x").truth.unwrap(), 0.0);
    assert!(row(&plan, "center.x").note.is_some());
}

/// The top side is 10 above the touches. Lowered by 10 mm minus part of a radius, the wall ends below the ball centre: 1.8 above the edge a ball of radius 3
/// touches it 2.4 in front of the wall (3-4-5), so it moves 0.6 further.
#[test]
fn a_lowered_part_is_met_at_its_edge() {
    let plan = planned(&with(&pocket(), "part.offset", point([0.0, 0.0, -11.8])));
    near(plan.triggers[0].unwrap()[0], 37.6);
    let findings = &planned(&with(&pocket(), "part.offset", point([0.0, 0.0, -14.0]))).findings;
    assert_eq!(
        findings.iter().filter(|f| f.code == "no-contact").count(),
        4,
        "the ball passes over the walls"
    );
}

/// The ball starts 8 before the wall; a part that is 5.5 nearer is hit by the move down, not by the touch.
#[test]
fn a_part_in_the_way_names_the_move() {
    let near_part = with(&pocket(), "part.offset", point([-5.5, 0.0, 0.0]));
    let findings = touchpath::job::check(&with(&near_part, "overtravel", number(10.0)));
    let collisions: Vec<_> = findings.iter().filter(|f| f.code == "collision").collect();
    // At X 32 the wall is 40 − 5.5 − 32 = 2.5 away: its edge is touched √(3² − 2.5²) = 1.6583 above the top.
    assert_eq!(collisions.len(), 1, "{collisions:?}");
    assert_eq!(
        (collisions[0].level, collisions[0].path.as_str()),
        (Level::Warning, "part"),
        "the program is that of the nominal part"
    );
    assert_eq!(
        crate::common::values(collisions[0]),
        ["4", "3", "X 32, Y 0, Z 1.6583"],
        "in positioning, at no touch"
    );
    assert!(findings.iter().all(|f| f.level != Level::Error));
}

/// A square corner on a part that is shifted by (0.4, 0.7) and rotated by 1° about the work origin, which is the corner: two touches per wall measure the
/// rotation, and the corner is exact.
#[test]
fn a_turned_corner_is_measured_without_error() {
    let turned = with(&corner(), "part.rotation", number(1.0));
    let plan = planned(&with(&turned, "part.offset", point([0.4, 0.7, 0.0])));
    near(value(&plan, "corner.x"), 0.4);
    near(value(&plan, "corner.y"), 0.7);
    near(value(&plan, "angle"), 90.0);
    near(value(&plan, "rotation"), 1.0);
    // Wall 1 is X = 0 rotated by 1°: at height y the ball centre is 3/cos 1° − y·tan 1° from it, counted from the shifted corner. The first touch is at y = 15,
    // 14.3 above the shifted corner.
    let (secant, tangent) = (1.000_152_328_04, 0.017_455_064_93);
    assert!((plan.triggers[0].unwrap()[0] - (0.4 + 3.0 * secant - 14.3 * tangent)).abs() < 1e-9);
}

/// One touch per wall: the walls keep their nominal directions, so a rotated part shifts the corner. Ball centres are as above at height 15: corner.x reads
/// 3/cos 1° − 15·tan 1° − 3.
#[test]
fn a_corner_with_single_touches_keeps_its_nominal_directions() {
    let single = with(
        &with(&corner(), "cycle.count1", number(1.0)),
        "cycle.count2",
        number(1.0),
    );
    let plan = planned(&with(&single, "part.rotation", number(1.0)));
    let (secant, tangent) = (1.000_152_328_04, 0.017_455_064_93);
    assert!((value(&plan, "corner.x") - (3.0 * secant - 15.0 * tangent - 3.0)).abs() < 1e-9);
    assert_eq!(
        (row(&plan, "angle").value, row(&plan, "rotation").value),
        (None, None)
    );
    assert!(
        row(&plan, "corner.x")
            .note
            .as_deref()
            .unwrap()
            .contains("one touch")
    );
}

/// A corner of 90.5°: wall 2 rotates by −0.5° about the corner, wall 1 stays.
#[test]
fn a_wider_corner() {
    let plan = planned(&with(&corner(), "part.sizes.angle", number(0.5)));
    near(value(&plan, "angle"), 90.5);
    near(value(&plan, "rotation"), 0.0);
    near(value(&plan, "corner.x"), 0.0);
    near(value(&plan, "corner.y"), 0.0);
}

/// Uncertainties by hand, for σ = 0.002 per touch. A centre is half the sum of two touches: σ/√2. A width is their difference: σ·√2. The angle of a wall with
/// two touches 20 apart is (Δ2 − Δ1)/20: σ·√2/20 rad; the corner angle adds that of the other wall, 30 apart.
#[test]
fn uncertainties_by_hand() {
    let plan = planned(&with(&pocket(), "stylus.repeatability", number(0.002)));
    near(
        row(&plan, "center.x").uncertainty.unwrap(),
        0.002 / 2f64.sqrt(),
    );
    near(
        row(&plan, "width1").uncertainty.unwrap(),
        0.002 * 2f64.sqrt(),
    );
    near(
        row(&plan, "offset.y").uncertainty.unwrap(),
        0.002 / 2f64.sqrt(),
    );
    let plan = planned(&with(&corner(), "stylus.repeatability", number(0.002)));
    let wall = |apart: f64| 0.002 * 2f64.sqrt() / apart;
    near(
        row(&plan, "rotation").uncertainty.unwrap(),
        wall(20.0).to_degrees(),
    );
    near(
        row(&plan, "angle").uncertainty.unwrap(),
        wall(20.0).hypot(wall(30.0)).to_degrees(),
    );
    // Two touches at 15 and 35 from the corner: extrapolated to the corner, x = (35·x1 − 15·x2)/20.
    near(
        row(&plan, "corner.x").uncertainty.unwrap(),
        0.002 * 35f64.hypot(15.0) / 20.0,
    );
}

/// Random numbers with a normal distribution, the same in every run.
struct Draws(u64);

impl Draws {
    fn uniform(&mut self) -> f64 {
        // xorshift64*
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (-2.0 * (1.0 - self.uniform()).ln()).sqrt() * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// Every touch scatters along its probing direction, 100,000 times; the spread of each result is its stated uncertainty.
#[test]
fn uncertainties_agree_with_draws() {
    let acute = r#"{ "format": 1, "stylus": { "repeatability": 0.004 }, "cycle": { "type": "double-wall-internal-corner",
        "angle": 55, "rotation": 25, "clearance1": 12, "clearance2": 18, "count1": 4, "count2": 3, "step1": 6, "step2": 9 },
        "part": { "offset": [0.3, -0.4, 0], "rotation": 0.8, "sizes": { "angle": -0.3 } } }"#;
    let turned = r#"{ "format": 1, "stylus": { "repeatability": 0.004 }, "cycle": { "type": "internal-rectangle-protected",
        "rotation": 33 }, "part": { "rotation": 1 } }"#;
    // The same for native cycles, which have their own touches and formulas.
    let own = |cycle: &str, post: &str| {
        format!(
            r#"{{ "format": 1, "stylus": {{ "repeatability": 0.004 }}, "cycle": {{ "type": "{cycle}" }}, "part": {{ "offset": [0.3, -0.4, 0] }},
            "control": {{ "post": "{post}", "form": "cycle" }} }}"#
        )
    };
    let cases = [
        (acute.to_owned(), 0x1234_5678_9abc_def1),
        (turned.to_owned(), 0x0fed_cba9_8765_4321),
        (own("hole", "fanuc"), 0x1111_2222_3333_4445),
        (
            own("double-wall-external-corner", "okuma"),
            0x5555_6666_7777_8889,
        ),
        (own("boss", "heidenhain"), 0x2468_ace0_1357_9bdf),
        (
            own("internal-rectangle", "sinumerik"),
            0x3141_5926_5358_9793,
        ),
    ];
    for (text, seed) in &cases {
        let job = job(text);
        let plan = planned(&job);
        let touchpath::job::PlannedJob {
            job: checked, path, ..
        } = touchpath::job::planned(&job).unwrap();
        let mut draws = Draws(*seed);
        // The spread of so many draws is known to half a percent.
        let count = 20_000;
        let mut sums = vec![(0.0, 0.0); plan.results.len()];
        for _ in 0..count {
            let scattered: Vec<_> = plan
                .triggers
                .iter()
                .zip(&path.touches)
                .map(|(t, touch)| {
                    Some(
                        touchpath::geom::Vec3::from_array(t.unwrap())
                            + touch.vector * (0.004 * draws.normal()),
                    )
                })
                .collect();
            let rows = touchpath::part::evaluate(&path, &scattered, checked.scatter());
            for (sum, (row, centre)) in sums.iter_mut().zip(rows.iter().zip(&plan.results)) {
                if let (Some(value), Some(centre)) = (row.value, centre.value) {
                    sum.0 += value - centre;
                    sum.1 += (value - centre).powi(2);
                }
            }
        }
        let mut compared = 0;
        for (row, (sum, squares)) in plan.results.iter().zip(&sums) {
            let Some(stated) = row.uncertainty else {
                continue;
            };
            let n = f64::from(count);
            let spread = ((squares - sum * sum / n) / (n - 1.0)).sqrt();
            assert!(
                (spread / stated - 1.0).abs() < 0.02,
                "{}: drawn {spread}, stated {stated}",
                row.code
            );
            compared += 1;
        }
        assert!(compared >= 3, "{text}");
    }
}

/// Closer touches make the angle less certain: a fifth of the distance, five times the uncertainty.
#[test]
fn close_touches_show_their_price() {
    let wide = planned(&corner());
    let close = planned(&with(&corner(), "cycle.step1", number(4.0)));
    let ratio =
        row(&close, "rotation").uncertainty.unwrap() / row(&wide, "rotation").uncertainty.unwrap();
    near(ratio, 5.0);
}

#[test]
fn measured_points_in_every_form_give_the_same_results() {
    // Walls at 40.1, −39.9, 25.2, −24.8 by hand; the ball stops 3 before each.
    let list = Value::List(vec![
        point([37.1, 0.0, -10.0]),
        point([-36.9, 0.0, -10.0]),
        point([0.0, 22.2, -10.0]),
        point([0.0, -21.8, -10.0]),
    ]);
    let csv = Value::Text("X;Y;Z\n37,1;0;-10\n-36,9;0;-10\n0;22,2;-10\n0;-21,8;-10\n".into());
    let log = ["37.1 0", "-36.9 0", "0 22.2", "0 -21.8"]
        .map(|xy| format!("{xy} -10.000000 0 0 0 0 0 0"))
        .join("\n");
    for measured in [list, csv, Value::Text(log)] {
        let rows = evaluate(&pocket(), &measured).unwrap();
        let get = |code: &str| rows.iter().find(|r| r.code == code).unwrap().value.unwrap();
        near(get("center.x"), 0.1);
        near(get("center.y"), 0.2);
        near(get("width1"), 80.0);
        near(get("width2"), 50.0);
        near(get("offset.x"), 0.1);
        assert!(
            rows.iter().all(|r| r.truth.is_none()),
            "what is true of a real part is not known"
        );
    }
}

#[test]
fn measured_points_that_cannot_be_of_the_job_are_refused() {
    let codes = |measured: Value| -> Vec<String> {
        let error = evaluate(&pocket(), &measured).unwrap_err();
        error
            .findings
            .iter()
            .filter(|f| f.level == Level::Error)
            .map(|f| format!("{} {}", f.code, f.path))
            .collect()
    };
    assert_eq!(
        codes(Value::Text("37,0,-10\n-37,0,-10\n".into())),
        ["wrong-count measured"]
    );
    assert_eq!(codes(Value::Text(String::new())), ["wrong-count measured"]);
    assert_eq!(codes(number(1.0))[0], "wrong-type measured");
    // Points 1 and 2 are in the wrong order, point 3 is 6 too far with an overtravel of 5.
    let swapped = Value::Text("-37,0,-10\n37,0,-10\n0,28,-10\n0,-22,-10".into());
    assert_eq!(
        codes(swapped),
        [
            "too-far measured[0]",
            "too-far measured[1]",
            "too-far measured[2]"
        ]
    );
    // A nearer part triggers during positioning: 4 before the contact still belongs to this touch, 5.1 before it does not.
    let nearer = |x: f64| Value::Text(format!("{x},0,-10\n-37,0,-10\n0,22,-10\n0,-22,-10"));
    assert!(evaluate(&pocket(), &nearer(33.0)).is_ok());
    assert_eq!(codes(nearer(31.9)), ["too-far measured[0]"]);
    let nan = Value::List(vec![
        point([f64::NAN, 0.0, 0.0]),
        Value::Null,
        point([0.0; 3]),
        point([1e9, 0.0, 0.0]),
    ]);
    assert_eq!(
        codes(nan)[..2],
        ["not-a-number measured[0]", "wrong-type measured[1]"]
    );
    let broken = with(&pocket(), "cycle.width1", number(-1.0));
    assert!(
        evaluate(&broken, &Value::Text("1,2,3".into())).is_err(),
        "a broken job is refused first"
    );
}
