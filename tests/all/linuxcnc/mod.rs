//! LinuxCNC's own interpreter runs every golden program: it accepts it, its moves are the planned path, and its printed results equal those of an independent
//! calculation from the same points.

mod preview;
mod ways;

use crate::common::{
    Interpreted, compare_moves, interpret, interpret_until_stop, number_at, planned, with,
};
use touchpath::cycle::CYCLES;
use touchpath::form::Value;
use touchpath::job::{Plan, default_job};

/// Every job except those of 1411, which `circles.rs` judges; those for another control are converted to LinuxCNC.
fn linuxcnc_jobs() -> Vec<(String, Value, Plan)> {
    crate::common::unlimited_jobs()
        .into_iter()
        .map(|(name, job)| {
            let own = planned(&job).program.post == "linuxcnc";
            if own {
                return (name, job);
            }
            let control =
                crate::common::job(r#"{ "post": "linuxcnc", "form": "moves", "workOffset": 2 }"#);
            (name, with(&job, "control", control))
        })
        .filter(|(_, job)| {
            job.get("cycle").and_then(|c| c.get("type"))
                != Some(&Value::Text("probing-two-circles".to_owned()))
        })
        .map(|(name, job)| (name, planned(&job), job))
        .filter(|(_, plan, _)| {
            plan.program.post == "linuxcnc" && plan.results.iter().all(|r| r.code != "Q950")
        })
        .map(|(name, plan, job)| (name, job, plan))
        .collect()
}

fn overtravel(job: &Value) -> f64 {
    let inch = job.get("units") == Some(&Value::Text("inch".into()));
    number_at(job, "overtravel", if inch { 5.0 / 25.4 } else { 5.0 })
}

fn radius(job: &Value) -> f64 {
    let inch = job.get("units") == Some(&Value::Text("inch".into()));
    number_at(job, "stylus.diameter", if inch { 6.0 / 25.4 } else { 6.0 }) / 2.0
}

fn plane_axes(job: &Value) -> [usize; 2] {
    match job.get("plane") {
        Some(Value::Text(p)) if p == "G18" => [2, 0],
        Some(Value::Text(p)) if p == "G19" => [1, 2],
        _ => [0, 1],
    }
}

/// Results of the points, by methods that share no code with the crate: the rectangle by projection on measured pairs, the corner by a search for the
/// least-squares line and a linear solution of two point-direction lines.
fn expected(job: &Value, plan: &Plan, points: &[[f64; 3]]) -> Vec<(&'static str, f64)> {
    if points.is_empty() {
        return Vec::new();
    }
    let [a, o] = plane_axes(job);
    let r = radius(job);
    let flat: Vec<(f64, f64)> = points.iter().map(|p| (p[a], p[o])).collect();
    let normals: Vec<(f64, f64)> = plan
        .touches
        .iter()
        .map(|t| (t.vector[a], t.vector[o]))
        .collect();
    if plan.touches.len() == 4 && plan.results.iter().any(|r| r.code == "width1") {
        // Surface points: one radius from the ball centre against the target vector.
        let surface: Vec<(f64, f64)> = flat
            .iter()
            .zip(&normals)
            .map(|(p, n)| (p.0 - r * n.0, p.1 - r * n.1))
            .collect();
        // The middle of a pair along its direction; across it, the other pair determines it.
        let along = |i: usize, p: (f64, f64)| -(p.0 * normals[i].0 + p.1 * normals[i].1);
        let (s1, s2) = (along(0, surface[0]), along(0, surface[1]));
        let (s3, s4) = (along(2, surface[2]), along(2, surface[3]));
        let (u, v) = ((s1 + s2) / 2.0, (s3 + s4) / 2.0);
        let x = -(u * normals[0].0 + v * normals[2].0);
        let y = -(u * normals[0].1 + v * normals[2].1);
        return vec![
            ("center.x", x),
            ("center.y", y),
            ("width1", (s1 - s2).abs()),
            ("width2", (s3 - s4).abs()),
        ];
    }
    let has = |code: &str| plan.results.iter().any(|r| r.code == code);
    let w = 3 - a - o;
    let dot = |p: [f64; 3], q: [f64; 3]| (0..3).map(|i| p[i] * q[i]).sum::<f64>();
    if has("diameter") {
        return circle(&flat, normals[0], r);
    }
    if has("width") {
        // The middle of the two surface points; along the walls the picked or nominal middle.
        let (n, touches) = (normals[0], &plan.touches);
        let surface = |i: usize| (flat[i].0 - r * normals[i].0, flat[i].1 - r * normals[i].1);
        let (s, t) = (surface(0), surface(1));
        let nominal = [a, o].map(|axis| (touches[0].point[axis] + touches[1].point[axis]) / 2.0);
        let off = ((s.0 + t.0) / 2.0 - nominal[0]) * n.0 + ((s.1 + t.1) / 2.0 - nominal[1]) * n.1;
        let mut results = Vec::new();
        for (code, i, part) in [("center.x", 0, n.0), ("center.y", 1, n.1)] {
            if part.abs() > 1e-9 {
                results.push((code, nominal[i] + off * part));
            }
        }
        results.push(("width", ((s.0 - t.0) * n.0 + (s.1 - t.1) * n.1).abs()));
        if has("height") {
            results.push(("height", points[2][w] - r));
        }
        return results;
    }
    if has("deviation") {
        let (n, p) = (plan.touches[0].vector, plan.touches[0].point);
        let off = dot(n, points[0]) - dot(n, p) - r;
        let at = |axis: usize| p[axis] + off * n[axis];
        return vec![
            ("point.x", at(a)),
            ("point.y", at(o)),
            ("point.z", at(w)),
            ("deviation", off),
        ];
    }
    if has("corner.z") {
        let rows: Vec<[f64; 4]> = (0..3)
            .map(|i| {
                let n = plan.touches[i].vector;
                [n[0], n[1], n[2], dot(n, points[i]) - r]
            })
            .collect();
        let corner = solved(rows);
        return vec![
            ("corner.x", corner[a]),
            ("corner.y", corner[o]),
            ("corner.z", corner[w]),
        ];
    }
    let lines: Vec<_> = [0, 1]
        .map(|group| {
            let wall: Vec<usize> = (0..points.len())
                .filter(|&i| plan.touches[i].group == group)
                .collect();
            let places: Vec<(f64, f64)> = wall.iter().map(|&i| flat[i]).collect();
            fitted_line(&places, normals[wall[0]], r)
        })
        .into();
    let [(p1, d1, tilt1), (p2, d2, tilt2)] = [lines[0], lines[1]];
    // p1 + s·d1 = p2 + t·d2
    let det = d1.0 * -d2.1 - d1.1 * -d2.0;
    let s = ((p2.0 - p1.0) * -d2.1 - (p2.1 - p1.1) * -d2.0) / det;
    let mut results = vec![("corner.x", p1.0 + s * d1.0), ("corner.y", p1.1 + s * d1.1)];
    if let (Some(t1), Some(t2)) = (tilt1, tilt2) {
        let nominal = plan
            .results
            .iter()
            .find(|r| r.code == "angle")
            .and_then(|r| r.nominal)
            .unwrap();
        // Wall 2 runs clockwise from wall 1, inside a corner as in the material of an outer one.
        results.push(("angle", nominal + t1 - t2));
    }
    if let Some(t1) = tilt1 {
        results.push(("rotation", t1));
    }
    results
}

type Spot = (f64, f64);

/// The circle through three of the ball centres, from the intersection of two perpendicular bisectors.
fn circle(places: &[Spot], normal: Spot, r: f64) -> Vec<(&'static str, f64)> {
    let n = places.len();
    let [p, q, s] = [places[0], places[n / 3], places[2 * n / 3]];
    let bisector = |a: Spot, b: Spot| {
        [
            b.0 - a.0,
            b.1 - a.1,
            (b.0 * b.0 + b.1 * b.1 - a.0 * a.0 - a.1 * a.1) / 2.0,
        ]
    };
    let ([a1, b1, c1], [a2, b2, c2]) = (bisector(p, q), bisector(q, s));
    let det = a1 * b2 - a2 * b1;
    let center = ((c1 * b2 - c2 * b1) / det, (a1 * c2 - a2 * c1) / det);
    let out = (p.0 - center.0, p.1 - center.1);
    // The target vector of a hole points to the centre.
    let hole = out.0 * normal.0 + out.1 * normal.1 < 0.0;
    let radius = out.0.hypot(out.1) + if hole { r } else { -r };
    vec![
        ("center.x", center.0),
        ("center.y", center.1),
        ("diameter", 2.0 * radius),
    ]
}

/// Gaussian elimination with pivots.
fn solved(mut rows: Vec<[f64; 4]>) -> [f64; 3] {
    for i in 0..3 {
        let pivot = (i..3)
            .max_by(|&j, &k| rows[j][i].abs().total_cmp(&rows[k][i].abs()))
            .unwrap();
        rows.swap(i, pivot);
        for j in 0..3 {
            if j != i {
                let factor = rows[j][i] / rows[i][i];
                let pivot_row = rows[i];
                for (x, p) in rows[j].iter_mut().zip(pivot_row) {
                    *x -= factor * p;
                }
            }
        }
    }
    [0, 1, 2].map(|i| rows[i][3] / rows[i][i])
}

/// A point on the surface line, its direction, and its rotation from the nominal one in degrees, counter-clockwise positive.
fn fitted_line(places: &[Spot], normal: Spot, r: f64) -> (Spot, Spot, Option<f64>) {
    let n = places.len() as f64;
    let mean = places
        .iter()
        .fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let nominal = normal.1.atan2(normal.0);
    let mut turn = 0.0;
    if places.len() > 1 {
        // The sum of squared distances, minimised by golden-section search over the normal's angle, ± 30°.
        let cost = |t: f64| -> f64 {
            let (sin, cos) = (nominal + t).sin_cos();
            places
                .iter()
                .map(|p| ((p.0 - mean.0) * cos + (p.1 - mean.1) * sin).powi(2))
                .sum()
        };
        let (mut low, mut high) = (-0.6f64, 0.6f64);
        for _ in 0..200 {
            let (m1, m2) = (low + 0.381966 * (high - low), low + 0.618034 * (high - low));
            if cost(m1) < cost(m2) {
                high = m2
            } else {
                low = m1
            }
        }
        turn = (low + high) / 2.0;
    }
    let (sin, cos) = (nominal + turn).sin_cos();
    let surface = (mean.0 - r * cos, mean.1 - r * sin);
    (
        surface,
        (-sin, cos),
        (places.len() > 1).then(|| turn.to_degrees()),
    )
}

fn compare_prints(
    job: &Value,
    plan: &Plan,
    points: &[[f64; 3]],
    ran: &Interpreted,
) -> Result<(), String> {
    let expected = expected(job, plan, points);
    // All touches ended equally far past their contacts: they are on a circle, or on a line.
    let (residuals, prints): (Vec<_>, Vec<_>) = ran
        .prints
        .iter()
        .partition(|(code, _)| code.starts_with("residual"));
    if residuals
        .iter()
        .any(|(_, residual)| residual.is_nan() || residual.abs() > 3e-4)
    {
        return Err(format!("printed {residuals:?}"));
    }
    if prints.len() != expected.len() {
        return Err(format!("printed {:?}, expected {expected:?}", ran.prints));
    }
    for ((code, printed), (wanted, value)) in prints.into_iter().zip(&expected) {
        // The program's targets are rounded to the control's decimals; for angles that counts over the length of a wall.
        let tolerance = if matches!(*wanted, "angle" | "rotation") {
            2e-3
        } else {
            3e-4
        };
        if code != wanted || (printed - value).abs() > tolerance {
            return Err(format!(
                "printed {code}={printed}, expected {wanted}={value}"
            ));
        }
    }
    Ok(())
}

/// End of the interpreter's probe: its target, contact plus overtravel.
fn targets(job: &Value, plan: &Plan) -> Vec<[f64; 3]> {
    let over = overtravel(job) + 0.0;
    let r = radius(job);
    plan.touches
        .iter()
        .map(|t| [0, 1, 2].map(|i| t.point[i] + (r - over) * t.vector[i]))
        .collect()
}

#[test]
fn every_program_runs_as_planned_and_prints_what_its_points_give() {
    let jobs = linuxcnc_jobs();
    // Every type of the family, by its number in the table.
    let types: std::collections::BTreeSet<String> = jobs
        .iter()
        .map(|(.., p)| format!("{:?}", p.table[0].value))
        .collect();
    assert_eq!(
        types.len(),
        CYCLES.iter().filter(|def| def.number.is_some()).count(),
        "{types:?}"
    );
    for (name, job, plan) in jobs {
        let ran = interpret(&plan.program.text).unwrap_or_else(|e| panic!("{name}: {e}"));
        compare_moves(&plan, |_| overtravel(&job), &ran).unwrap_or_else(|e| panic!("{name}: {e}"));
        compare_prints(&job, &plan, &targets(&job, &plan), &ran)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}

#[test]
fn feeds_are_the_forms_and_units_are_stated() {
    for (name, job, plan) in linuxcnc_jobs() {
        let ran = interpret(&plan.program.text).unwrap();
        let inch = job.get("units") == Some(&Value::Text("inch".into()));
        assert_eq!(ran.inch, inch, "{name}");
        // The approach takes several moves, so the moves are counted from the end.
        for (canon, step) in ran.moves.iter().rev().zip(plan.moves.iter().rev()) {
            let (path, default) = match step.feed {
                "approach" => ("feeds.approach", 2000.0),
                "longLink" => ("feeds.longLink", 1000.0),
                "work" => ("feeds.work", 150.0),
                "return" => ("feeds.return", 2000.0),
                "retract" => ("feeds.retract", 1000.0),
                "rapid" => continue,
                other => panic!("{other}"),
            };
            let wanted = number_at(&job, path, if inch { default / 25.4 } else { default });
            assert!(
                (canon.feed - wanted).abs() < 1e-3,
                "{name}: {} for {}",
                canon.feed,
                step.feed
            );
        }
    }
}

#[test]
fn the_work_offset_is_written_once_and_puts_the_feature_on_its_nominal_place() {
    for (name, job, plan) in linuxcnc_jobs() {
        let n = number_at(&job, "control.workOffset", 0.0) as usize;
        let writes: Vec<&str> = plan
            .program
            .text
            .lines()
            .filter(|l| l.starts_with("G10"))
            .collect();
        if n == 0 {
            assert!(writes.is_empty(), "{name}");
            continue;
        }
        assert_eq!(writes.len(), 1, "{name}");
        assert!(
            plan.program
                .text
                .ends_with(&format!("{}\nM72\nM2\n", writes[0])),
            "{name}: the write is the last thing"
        );
        let ran = interpret(&plan.program.text).unwrap();
        let results = expected(&job, &plan, &targets(&job, &plan));
        let (number, written) = ran.written.expect("an offset");
        assert_eq!(number, n, "{name}");
        // The machine is in the old work system: the shift is measured minus nominal, and zero on axes that are not measured.
        for (axis, place) in places(&job, &plan, &results).into_iter().enumerate() {
            let wanted = place.map_or(0.0, |(measured, nominal)| measured - nominal);
            assert!(
                (written[axis] - wanted).abs() < 4e-4,
                "{name}: {written:?} for {results:?}"
            );
        }
    }
}

/// Measured and nominal position of a cycle along X, Y and Z.
fn places(job: &Value, plan: &Plan, results: &[(&'static str, f64)]) -> [Option<(f64, f64)>; 3] {
    let [a, o] = plane_axes(job);
    let mut places = [None; 3];
    let bases: [(usize, &[&str]); 3] = [
        (a, &["center.x", "corner.x", "point.x"]),
        (o, &["center.y", "corner.y", "point.y"]),
        (3 - a - o, &["height", "corner.z", "point.z"]),
    ];
    for (axis, codes) in bases {
        let found = results.iter().find(|(code, _)| codes.contains(code));
        places[axis] = found.map(|(code, value)| {
            let row = plan.results.iter().find(|r| r.code == *code).unwrap();
            (*value, row.nominal.unwrap())
        });
    }
    places
}

/// With an offset and a rotation already active, the feature must still come to its nominal position: the measured point in the old system is the nominal point
/// in the new one.
#[test]
fn the_write_is_right_under_a_rotation_that_was_active_before() {
    for (name, job, plan) in linuxcnc_jobs()
        .into_iter()
        .filter(|(_, job, _)| plane_axes(job) == [0, 1])
    {
        let n = number_at(&job, "control.workOffset", 0.0) as usize;
        if n == 0 {
            continue;
        }
        if plan.results.iter().any(|r| r.code == "deviation") && plan.touches[0].vector[2] == 1.0 {
            continue;
        }
        let inch = job.get("units") == Some(&Value::Text("inch".into()));
        let unit = if inch { "G20" } else { "G21" };
        let before = format!("{unit}\nG10 L2 P{n} X7 Y-3 Z2 R25\n{}", plan.program.text);
        let ran = interpret(&before).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(ran.rotation, Some(25.0), "{name}");
        let results = expected(&job, &plan, &targets(&job, &plan));
        // A coordinate that is not measured keeps its value: its nominal position, which is arbitrary here.
        let [x, y, _] = places(&job, &plan, &results).map(|p| p.unwrap_or((1.5, 1.5)));
        let (measured, nominal) = ([x.0, y.0], [x.1, y.1]);
        let (_, new) = ran.written.unwrap();
        let (sin, cos) = 25f64.to_radians().sin_cos();
        let machine = |offset: [f64; 2], p: &[f64]| {
            [
                offset[0] + p[0] * cos - p[1] * sin,
                offset[1] + p[0] * sin + p[1] * cos,
            ]
        };
        let old_place = machine([7.0, -3.0], &measured);
        let new_place = machine([new[0], new[1]], &nominal);
        for axis in 0..2 {
            assert!(
                (old_place[axis] - new_place[axis]).abs() < 3e-4,
                "{name}: {old_place:?} {new_place:?}"
            );
        }
    }
}

/// The program's own arithmetic on the virtual part: its probe targets are replaced by the triggers, and it must print the plan's results.
#[test]
fn on_the_virtual_part_the_program_computes_the_results_that_are_shown() {
    let mut deviating = 0;
    for (name, _, plan) in linuxcnc_jobs() {
        let mut lines: Vec<String> = plan.program.text.lines().map(str::to_owned).collect();
        for (index, step) in plan
            .moves
            .iter()
            .enumerate()
            .filter(|(_, m)| m.kind == "touch")
        {
            let trigger = plan.triggers[step.touch.unwrap()].expect("these parts are met");
            let [x, y, z] = trigger.map(|v| format!("{v:.9}"));
            let line = &mut lines[plan.program.move_lines[index] as usize];
            assert!(line.starts_with("G38.2"), "{line}");
            let feed = line.split(' ').next_back().unwrap().to_owned();
            *line = format!("G38.2 X{x} Y{y} Z{z} {feed}");
        }
        let ran = interpret(&(lines.join("\n") + "\n")).unwrap_or_else(|e| panic!("{name}: {e}"));
        for (code, printed) in &ran.prints {
            let row = plan
                .results
                .iter()
                .find(|r| r.code == *code)
                .unwrap_or_else(|| panic!("{name}: {code}"));
            assert!(
                (row.value.unwrap() - printed).abs() < 2e-6,
                "{name}: {code} printed {printed}, shown {:?}",
                row.value
            );
            deviating += usize::from(row.deviation.unwrap().abs() > 0.01);
        }
        let shown = plan
            .results
            .iter()
            .filter(|r| r.value.is_some() && !r.code.starts_with("offset."))
            .count();
        assert_eq!(ran.prints.len(), shown, "{name}");
    }
    assert!(
        deviating >= 6,
        "the parts must lie off, or this test shows nothing"
    );
}

/// The comparison itself must be able to fail.
#[test]
fn a_broken_program_is_caught() {
    let (_, job, plan) = linuxcnc_jobs()
        .into_iter()
        .find(|(name, ..)| name == "pocket")
        .expect("the pocket");
    let text = &plan.program.text;
    let judge = |broken: &str| -> Result<(), String> {
        assert_ne!(broken, text);
        let ran = interpret(broken)?;
        compare_moves(&plan, |_| overtravel(&job), &ran)?;
        compare_prints(&job, &plan, &targets(&job, &plan), &ran)
    };
    // A wrong sign, a lost line, a lost bracket, a touch without its feed, a radius subtracted instead of added.
    let broken = [
        text.replacen("G38.2 X42", "G38.2 X-42", 1),
        text.replacen("G1 X32 Y0 Z-10 F1000\n", "", 1),
        text.replacen("G38.3 X32 Y0 Z10 F1000\n", "", 1),
        text.replacen("G38.3 X32 Y0 Z10", "G1 X32 Y0 Z10", 1),
        text.replacen("#<x1>+3]", "#<x1>+3", 1),
        text.replacen("G38.2 X42 Y0 Z-10 F150", "G38.2 X42 Y0 Z-10 F0", 1),
        text.replacen("#<x1>+3]", "#<x1>-3]", 1),
        text.replacen("G38.3 X32 Y0 Z-10 F1000", "G38.3 X32 Y0 Z-10.001 F1000", 1),
        text.replacen("G21", "G20", 1),
        text.strip_suffix("M2\n").unwrap().to_owned(),
    ];
    for (i, program) in broken.iter().enumerate() {
        assert!(judge(program).is_err(), "{i} is not caught:\n{program}");
    }
}
