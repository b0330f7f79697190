//! LinuxCNC's interpreter runs 1411 as a program of moves.

use super::{holes, on_linuxcnc, row, text, value};
use crate::common::{
    compare_moves, interpret, interpret_from, number, number_at, on_virtual_part, planned, point,
    with,
};
use touchpath::form::Value;
use touchpath::job::{Plan, evaluate};

fn circle_jobs() -> Vec<(String, Value, Plan)> {
    let jobs = crate::common::unlimited_jobs()
        .into_iter()
        .filter(|(name, _)| name.starts_with("circles-linuxcnc"));
    jobs.map(|(name, job)| (name, planned(&job), job))
        .map(|(name, plan, job)| (name, job, plan))
        .collect()
}

/// Search past the contact of a touch: DIST minus the set-up clearance.
fn search(job: &Value) -> f64 {
    let unit = if job.get("units") == Some(&text("inch")) {
        25.4
    } else {
        1.0
    };
    number_at(job, "cycle.probe.dist", 10.0 / unit)
        - number_at(job, "cycle.probe.setUp", 2.0 / unit)
        - number_at(job, "cycle.setUpClearance", 0.0)
}

/// LinuxCNC's interpreter runs the cycle. Its moves and arcs are the path, and the printed Q results equal those of the points where the probe ended, by the
/// crate's evaluation (geometric) and by an independent circle.
#[test]
fn linuxcnc_runs_the_cycle() {
    let jobs = circle_jobs();
    assert!(jobs.len() >= 4);
    let mut arcs = 0;
    for (name, job, plan) in jobs {
        // When watched, every positioning move is a probe move too: the touches are found in the unwatched program.
        let ran =
            interpret_from(&plan.program.text, &job).unwrap_or_else(|e| panic!("{name}: {e}"));
        compare_moves(&plan, |_| search(&job), &ran)
            .unwrap_or_else(|e| panic!("{name}, watched: {e}"));
        let job = with(&job, "control.protection", text("none"));
        let plan = planned(&job);
        let ran =
            interpret_from(&plan.program.text, &job).unwrap_or_else(|e| panic!("{name}: {e}"));
        compare_moves(&plan, |_| search(&job), &ran).unwrap_or_else(|e| panic!("{name}: {e}"));
        arcs += ran.moves.iter().filter(|m| m.kind == "arc").count();
        let ends: Vec<[f64; 3]> = ran
            .moves
            .iter()
            .filter(|m| m.kind == "probe")
            .map(|m| m.to)
            .collect();
        let repeats = ends.len() / (2 * number_at(&job, "cycle.probePoints", 4.0) as usize);
        // Evaluated by the crate: the points where the probe ended, from the interpreter.
        let touchpath::job::PlannedJob {
            job: checked, path, ..
        } = touchpath::job::planned(&job).unwrap();
        let scale = checked.scale;
        let triggers: Vec<_> = ends
            .iter()
            .map(|p| Some(touchpath::geom::Vec3::from_array(*p) * scale))
            .collect();
        let rows = touchpath::part::evaluate(
            &path,
            &triggers,
            touchpath::part::UncertaintySources {
                repeatability: 0.001,
                runout: None,
            },
        );
        for (code, printed) in &ran.prints {
            let row = rows
                .iter()
                .find(|r| r.code == *code)
                .unwrap_or_else(|| panic!("{name}: {code}"));
            let unit = if row.unit == touchpath::formula::Unit::Length {
                scale
            } else {
                1.0
            };
            let wanted = row.value.unwrap() / unit;
            // The interpreter prints positions with four decimals.
            let tolerance = if unit == scale && row.unit == touchpath::formula::Unit::Length {
                2e-4
            } else {
                1e-3
            };
            assert!(
                (wanted - printed).abs() < tolerance,
                "{name}: {code} printed {printed}, evaluated {wanted}"
            );
        }
        // By hand: the circle through the first, third … point is the same circle, from perpendicular bisectors.
        let [a, o] = if job.get("plane") == Some(&text("G18")) {
            [2, 0]
        } else {
            [0, 1]
        };
        let mean = |k: usize| {
            let own = &ends[k * repeats..(k + 1) * repeats];
            let n = repeats as f64;
            (
                own.iter().map(|p| p[a]).sum::<f64>() / n,
                own.iter().map(|p| p[o]).sum::<f64>() / n,
            )
        };
        let (p, q, s) = (mean(0), mean(1), mean(2));
        let (d1, d2) = ((q.0 - p.0, q.1 - p.1), (s.0 - p.0, s.1 - p.1));
        let det = 2.0 * (d1.0 * d2.1 - d1.1 * d2.0);
        let (l1, l2) = (d1.0 * d1.0 + d1.1 * d1.1, d2.0 * d2.0 + d2.1 * d2.1);
        let center = (
            p.0 + (d2.1 * l1 - d1.1 * l2) / det,
            p.1 + (d1.0 * l2 - d2.0 * l1) / det,
        );
        let printed = |code: &str| ran.prints.iter().find(|(c, _)| c == code).unwrap().1;
        assert!(
            (printed("Q950") - center.0).abs() < 1e-3 && (printed("Q951") - center.1).abs() < 1e-3,
            "{name}: {center:?}"
        );
    }
    assert!(arcs > 4, "arcs are run as arcs");
}

/// On the virtual part: the probe's targets are replaced by the triggers, and the program prints the results of the page.
#[test]
fn linuxcnc_computes_what_is_shown() {
    for (name, _, plan) in circle_jobs() {
        let mut lines: Vec<String> = plan.program.text.lines().map(str::to_owned).collect();
        for (index, step) in plan
            .moves
            .iter()
            .enumerate()
            .filter(|(_, m)| m.kind == "touch")
        {
            let [x, y, z] = plan.triggers[step.touch.unwrap()]
                .unwrap()
                .map(|v| format!("{v:.9}"));
            let line = &mut lines[plan.program.move_lines[index] as usize];
            let feed = line.split(' ').next_back().unwrap().to_owned();
            *line = format!("G38.2 X{x} Y{y} Z{z} {feed}");
        }
        let ran = interpret(&(lines.join("\n") + "\n")).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(ran.prints.len() > 18, "{name}");
        for (code, printed) in &ran.prints {
            let shown = value(&plan, code);
            assert!(
                (shown - printed).abs() < 2e-6,
                "{name}: {code} printed {printed}, shown {shown}"
            );
        }
    }
}

/// The write under a rotation that was active before: the measured point in the old system is at its nominal position in the new one, and the measured line has
/// its nominal direction there.
#[test]
fn linuxcnc_writes_offset_and_rotation() {
    for before in [0.0, 25.0] {
        let (_, job, plan) = circle_jobs()
            .into_iter()
            .find(|(name, ..)| name == "circles-linuxcnc")
            .unwrap();
        let program = format!("G21\nG10 L2 P1 X7 Y-3 Z2 R{before}\n{}", plan.program.text);
        // A tilted part: the touches of the second circle end 0.6 higher.
        let mut lines: Vec<String> = program.lines().map(str::to_owned).collect();
        let moved: Vec<usize> = lines
            .iter()
            .enumerate()
            .filter(|(_, l)| l.starts_with("G38.2"))
            .map(|(i, _)| i)
            .skip(4)
            .collect();
        for i in moved {
            let step = plan.moves[plan
                .program
                .move_lines
                .iter()
                .position(|l| *l == i as i32 - 2)
                .unwrap()]
            .clone();
            let vector = plan.touches[step.touch.unwrap()].vector;
            let target: Vec<f64> = (0..3)
                .map(|axis| {
                    step.to[axis] - search(&job) * vector[axis] + if axis == 1 { 0.6 } else { 0.0 }
                })
                .collect();
            lines[i] = format!(
                "G38.2 X{:.6} Y{:.6} Z{:.6} F300",
                target[0], target[1], target[2]
            );
        }
        let ran = interpret(&(lines.join("\n") + "\n")).unwrap();
        let printed = |code: &str| ran.prints.iter().find(|(c, _)| c == code).unwrap().1;
        assert!(
            (printed("Q964") - 0.01f64.atan().to_degrees()).abs() < 1e-4,
            "60 along, 0.6 across"
        );
        let turned = before + printed("Q964");
        let writes: Vec<&String> = lines.iter().filter(|l| l.starts_with("G10")).collect();
        assert_eq!(
            writes.len(),
            3,
            "the test's own, the rotation, the offset: {writes:?}"
        );
        // After the write of the rotation comes that of the offset: the last SET_G5X_OFFSET before the modes are restored.
        let output = ran.offsets_after_moves.last().copied().expect("a write");
        let machine = |offset: [f64; 3], degrees: f64, p: [f64; 2]| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            [
                offset[0] + p[0] * cos - p[1] * sin,
                offset[1] + p[0] * sin + p[1] * cos,
            ]
        };
        // Q1120 = 3: the mean of both centres, nominally (0, 0), measured (0, 0.3).
        let old = machine(
            [7.0, -3.0, 2.0],
            before,
            [
                (printed("Q950") + printed("Q953")) / 2.0,
                (printed("Q951") + printed("Q954")) / 2.0,
            ],
        );
        let new = machine(output, turned, [0.0, 0.0]);
        assert!(
            (old[0] - new[0]).abs() < 2e-4 && (old[1] - new[1]).abs() < 2e-4,
            "{before}: {old:?} {new:?}"
        );
        assert!((ran.rotations_after_moves.last().unwrap() - turned).abs() < 1e-4);
    }
}

/// With scatter the two fits differ; the page uses for LinuxCNC the equations of its program.
#[test]
fn linuxcnc_and_the_page_agree_on_scattered_points() {
    let mut job = on_linuxcnc(&with(
        &with(&holes(), "cycle.probePoints", number(5.0)),
        "cycle.angularLength",
        number(60.0),
    ));
    job = with(&job, "cycle.clearanceHeight", number(20.0));
    let plan = planned(&job);
    let mut lines: Vec<String> = plan.program.text.lines().map(str::to_owned).collect();
    let mut points = Vec::new();
    for (index, step) in plan
        .moves
        .iter()
        .enumerate()
        .filter(|(_, m)| m.kind == "touch")
    {
        let k = step.touch.unwrap();
        let off = 0.01 * f64::from([3, -4, 5, -2, 1][k % 5]) / 5.0;
        let p = [0, 1, 2].map(|i| step.to[i] + off * plan.touches[k].vector[i]);
        lines[plan.program.move_lines[index] as usize] =
            format!("G38.2 X{:.9} Y{:.9} Z{:.9} F300", p[0], p[1], p[2]);
        points.push(point(p));
    }
    let ran = interpret(&(lines.join("\n") + "\n")).unwrap();
    let shown = evaluate(&job, &Value::List(points.clone())).unwrap();
    for (code, printed) in &ran.prints {
        let wanted = row(&shown, code).value.unwrap();
        assert!(
            (wanted - printed).abs() < 2e-6,
            "{code}: {printed} {wanted}"
        );
    }
    let control = with(
        &with(&job, "control.post", text("heidenhain")),
        "control.form",
        text("cycle"),
    );
    let geometric = evaluate(&control, &Value::List(points)).unwrap();
    assert!(
        (row(&geometric, "Q950").value.unwrap() - row(&shown, "Q950").value.unwrap()).abs() > 1e-5
    );
}

/// AXIS shows ten messages and then removes the first: the 25 and more results of 1411 share messages. The interpreter prints each.
#[test]
fn the_results_of_two_circles_fit_on_the_screen() {
    let jobs = crate::common::unlimited_jobs();
    let of = |wanted: &str| {
        let (_, job) = jobs.iter().find(|(name, _)| name == wanted).unwrap();
        planned(&with(
            &with(job, "control.report", text("screen")),
            "control.post",
            text("linuxcnc"),
        ))
    };
    let plan = of("circles-linuxcnc");
    let messages = |plan: &Plan| {
        plan.program
            .text
            .lines()
            .filter(|line| line.starts_with("(DEBUG,"))
            .count()
    };
    assert!((4..=8).contains(&messages(&plan)), "{}", plan.program.text);
    let ran = interpret(&on_virtual_part(&plan)).unwrap();
    assert!(ran.prints.len() > 18);
    for (code, printed) in &ran.prints {
        assert!(
            (value(&plan, code) - printed).abs() < 2e-6,
            "{code}: {printed}"
        );
    }
    // A few results have a line each.
    assert_eq!(messages(&of("pocket")), 4);
}
