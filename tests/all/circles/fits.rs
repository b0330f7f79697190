//! The circle fitted to a measured object, from three touches and more: closed forms, spread, limits.

use super::super::draws::drawn_spreads;
use super::{errors, holes, near, on_linuxcnc, row, warnings};
use crate::common::{interpret, number, planned, point, with};
use touchpath::form::Value;
use touchpath::formula::fit_circle;
use touchpath::geom::Vec2;
use touchpath::job::{Plan, evaluate};

/// The circle through three points against closed forms; three points within 10° still define it.
#[test]
fn circle_fits_against_closed_forms() {
    let at = |degrees: f64| {
        Vec2::new(
            12.0 + 7.0 * degrees.to_radians().cos(),
            -5.0 + 7.0 * degrees.to_radians().sin(),
        )
    };
    for angles in [
        vec![0.0, 90.0, 180.0],
        vec![10.0, 15.0, 20.0],
        vec![0.0, 120.0, 240.0, 300.0],
        (0..8).map(|k| 20.0 * f64::from(k)).collect(),
    ] {
        let points: Vec<Vec2> = angles.iter().map(|a| at(*a)).collect();
        let fit = fit_circle(&points).unwrap();
        assert!(
            (fit.center.x - 12.0).abs() < 1e-9
                && (fit.center.y + 5.0).abs() < 1e-9
                && (fit.radius - 7.0).abs() < 1e-9,
            "{fit:?}"
        );
    }
    // A triangle with sides 3, 4, 5 has its circle about the midpoint of the longest side, radius 2.5.
    let fit =
        fit_circle(&[(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)].map(|(x, y)| Vec2::new(x, y))).unwrap();
    assert!(
        (fit.center.x - 2.0).abs() < 1e-12
            && (fit.center.y - 1.5).abs() < 1e-12
            && (fit.radius - 2.5).abs() < 1e-12
    );
    // Four points of a cross, one arm 0.4 longer: by symmetry the centre shifts along it. Geometric least squares is the
    // minimum of Σ(|p − c| − R)²: compared with a search over c, R being the mean distance.
    let cross =
        [(10.4, 0.0), (0.0, 10.0), (-10.0, 0.0), (0.0, -10.0)].map(|(x, y)| Vec2::new(x, y));
    let cost = |x: f64| {
        let far: Vec<f64> = cross.iter().map(|p: &Vec2| (p.x - x).hypot(p.y)).collect();
        let mean = far.iter().sum::<f64>() / 4.0;
        far.iter().map(|f| (f - mean).powi(2)).sum::<f64>()
    };
    let (mut low, mut high) = (-1.0f64, 1.0f64);
    for _ in 0..200 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if cost(a) < cost(b) { high = b } else { low = a }
    }
    let fit = fit_circle(&cross).unwrap();
    assert!(
        (fit.center.x - low).abs() < 1e-7 && fit.center.y.abs() < 1e-12,
        "{} {low}",
        fit.center.x
    );
    assert!(
        fit_circle(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)].map(|(x, y)| Vec2::new(x, y))).is_none(),
        "a line is no circle"
    );
    assert!(
        fit_circle(&[(1.0, 1.0), (1.0, 1.0), (1.0, 1.0)].map(|(x, y)| Vec2::new(x, y))).is_none()
    );
}

/// A short angular length increases the uncertainty: the same touches over 40° instead of 360°.
#[test]
fn a_short_arc_costs_certainty() {
    let wide = planned(&holes());
    let short = planned(&with(&holes(), "cycle.angularLength", number(40.0)));
    let of = |plan: &Plan| row(&plan.results, "Q950").uncertainty.unwrap();
    // Four touches at 0°, 90° …: two of them see the main axis, σ/√2.
    near(of(&wide), 0.001 / 2f64.sqrt());
    assert!(
        of(&short) > 10.0 * of(&wide),
        "{} {}",
        of(&short),
        of(&wide)
    );
}

/// Touches scattered along their probing directions, 100,000 times: the spread of each result is its stated uncertainty.
#[test]
fn uncertainties_agree_with_draws() {
    let mut job = with(&holes(), "cycle.probePoints", number(5.0));
    job = with(&job, "cycle.angularLength", number(200.0));
    job = with(&job, "cycle.startingAngle", number(25.0));
    job = with(&job, "part.rotation", number(0.3));
    let (plan, spreads) = (planned(&job), drawn_spreads(&job, 20_000));
    for code in ["Q950", "Q951", "Q953", "Q964", "Q966", "Q997"] {
        let index = plan.results.iter().position(|r| r.code == code).unwrap();
        let (spread, stated) = (
            spreads[index].unwrap(),
            plan.results[index].uncertainty.unwrap(),
        );
        assert!(
            (spread / stated - 1.0).abs() < 0.02,
            "{code}: drawn {spread}, stated {stated}"
        );
    }
}

#[test]
fn measured_points_of_circles() {
    // Hole 1 about (−29.9, 0.1), radius of the ball centres 7.02; hole 2 nominal.
    let mut points = Vec::new();
    for (x, y, r) in [(-29.9, 0.1, 7.02), (30.0, 0.0, 7.0)] {
        for k in 0..4 {
            let a = f64::from(k) * std::f64::consts::FRAC_PI_2;
            points.push(point([x + r * a.cos(), y + r * a.sin(), -10.0]));
        }
    }
    let rows = evaluate(&holes(), &Value::List(points)).unwrap();
    near(row(&rows, "Q950").value.unwrap(), -29.9);
    near(row(&rows, "Q951").value.unwrap(), 0.1);
    near(row(&rows, "Q966").value.unwrap(), 20.04);
    near(
        row(&rows, "Q964").value.unwrap(),
        (-0.1f64 / 59.9).atan().to_degrees(),
    );
}

/// Arcs too small to be printed are straight: a rounded end could mean a whole turn.
#[test]
fn tiny_arcs_are_straight() {
    let mut job = with(
        &with(&holes(), "cycle.diameter1", number(10.0004)),
        "cycle.clearanceHeightMode",
        number(1.0),
    );
    job = on_linuxcnc(&job);
    let plan = planned(&job);
    assert!(plan.moves.iter().take(20).all(|m| m.arc.is_none()));
    interpret(&plan.program.text).expect("LinuxCNC takes it");
}

#[test]
fn touches_that_cannot_tell_a_circle_are_refused_or_warned_of() {
    let spread = |length: f64, points: f64| {
        with(
            &with(&holes(), "cycle.angularLength", number(length)),
            "cycle.probePoints",
            number(points),
        )
    };
    for (length, points) in [
        (0.001, 3.0),
        (0.5, 3.0),
        (359.999, 3.0),
        (-359.999, 8.0),
        (6.0, 8.0),
    ] {
        assert_eq!(
            errors(&spread(length, points)),
            ["no-arc cycle.angularLength"],
            "{length} {points}"
        );
    }
    // Three points within 10° are allowed, with a warning about their uncertainty.
    let narrow = spread(10.0, 3.0);
    assert_eq!(
        (errors(&narrow), warnings(&narrow)),
        (vec![], vec!["short-arc".to_owned()])
    );
    assert_eq!(warnings(&spread(360.0, 3.0)), [""; 0]);
}

/// H7 begins at the nominal size itself. Over an arc of 10° the twelfth decimal of an inch in the touches is 4e-9 mm in the position: a result that the plan
/// called good must stay good when its own touches are evaluated.
#[test]
fn a_value_on_its_very_limit_is_good_also_from_its_own_touches() {
    let text = r#"{"format":1,"units":"inch","plane":"G19","stylus":{"diameter":0.3346456692913386},
        "control":{"post":"heidenhain","form":"cycle"},"cycle":{"type":"probing-two-circles",
        "point1":[-2.53774969931008,-0.2510242757996466,-0.7591726449156779],"point2":["1.1820H7",-0.26437482884117103,0.30886974815155666],
        "diameter2":0.5742965159134038,"angularLength":-10.294153901443906,"setUpClearance":1.88976,"clearanceHeight":6.06,
        "errorReaction":2,"start":[-6.22,-6.26,7.64],"probe":{"dist":3.917,"feed":4.6,"rapid":9.35}}}"#;
    let job = crate::common::job(text);
    let plan = crate::common::planned(&job);
    let lines: Vec<String> = plan
        .triggers
        .iter()
        .map(|t| t.expect("a contact").map(|x| format!("{x}")).join(" "))
        .collect();
    let rows =
        touchpath::job::evaluate(&job, &Value::Text(lines.join("\n"))).expect("its own touches");
    let verdict = |rows: &[touchpath::job::ResultRow]| {
        rows.iter()
            .find(|r| r.code == "Q953")
            .and_then(|r| r.verdict.clone())
    };
    assert_eq!(verdict(&plan.results).as_deref(), Some("good"));
    assert_eq!(verdict(&rows).as_deref(), Some("good"));
}

/// By hand: the ball moves down 2 mm before the wall (SET_UP 2), and DIST is 10. A stud of 24 or a hole of 16 instead of 20 reaches that position, and so does
/// an object 2 mm aside; a hole of 36.1 is 10.05 away.
#[test]
fn a_tolerance_that_the_path_does_not_leave_room_for_is_said() {
    let says = |key: &str, value: Value, stud: bool| -> Vec<String> {
        let job = with(
            &with(&holes(), &format!("cycle.{key}"), value),
            "cycle.geometryType",
            number(f64::from(u8::from(stud))),
        );
        let found = touchpath::job::check(&job)
            .into_iter()
            .filter(|f| f.path == format!("cycle.{key}"));
        found.map(|f| format!("{:?} {}", f.level, f.code)).collect()
    };
    let text = |text: &str| Value::Text(text.to_owned());
    let place = |x: &str| Value::List(vec![text(x), number(0.0), number(-10.0)]);
    let (refused, close, missed) = (
        "Error zone-beyond-clearance",
        "Warning zone-beyond-clearance",
        "Warning zone-beyond-dist",
    );
    for (value, stud, expected) in [
        ("20+30+28", true, Some(refused)),
        ("20+4+0", true, Some(close)),
        ("20+3.9-3.9", true, None),
        ("20-16.1+0", true, Some(missed)),
        ("20-10-8", false, Some(refused)),
        ("20+0-4", false, Some(close)),
        ("20+0.1-3.9", false, None),
        ("20+16.1-0", false, Some(missed)),
        ("20-30-28", false, Some("Error out-of-range")),
        ("20H7", false, None),
    ] {
        let found = says("diameter1", text(value), stud);
        assert_eq!(
            found.first().map(String::as_str),
            expected,
            "{value} {stud}: {found:?}"
        );
    }
    for (x, expected) in [
        ("-30+20+18", Some(refused)),
        ("-30+2-2", Some(close)),
        ("-30+1.9-1.9", None),
    ] {
        let found = says("point1", place(x), false);
        assert_eq!(
            found.first().map(String::as_str),
            expected,
            "{x}: {found:?}"
        );
    }
}
