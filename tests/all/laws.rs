//! Properties of every form, not only of the golden ones.

use crate::common::law;
use crate::common::owed::{circles, distance, sane};
use crate::common::{number, point, with};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use touchpath::cycle::{CYCLES, CycleDef};
use touchpath::form::{Default, Field, Kind, Level, Value};
use touchpath::job::{Plan, check, default_job, plan};

/// Any value that a field allows or, sometimes, a value that it does not allow.
fn field_value(field: &Field) -> BoxedStrategy<Value> {
    let (low, high) = field
        .usual
        .unwrap_or((field.hard.min.max(-300.0), field.hard.max.min(300.0)));
    let null = field.null.is_some();
    match field.kind {
        Kind::Length | Kind::Feed | Kind::Acceleration | Kind::Time | Kind::Angle => prop_oneof![
            60 => (low..=high).prop_map(Value::Number),
            1 => (field.hard.min..=field.hard.max).prop_map(Value::Number),
            1 => Just(if null { Value::Null } else { Value::Number(high) }),
        ]
        .boxed(),
        Kind::Count => (field.hard.min as i32..=field.hard.max.min(9.0) as i32)
            .prop_map(move |n| {
                if null && n % 2 == 0 {
                    Value::Null
                } else {
                    Value::Number(f64::from(n))
                }
            })
            .boxed(),
        Kind::Flag => any::<bool>().prop_map(Value::Flag).boxed(),
        Kind::Choice(choices) => (0..choices.len())
            .prop_map(move |i| Value::Text(choices[i].value.to_owned()))
            .boxed(),
        Kind::Text(_) => "\\PC{0,30}".prop_map(Value::Text).boxed(),
        Kind::Lines(_) => Just(Value::Null).boxed(),
        Kind::Code(codes) => (0..codes.len())
            .prop_map(move |i| Value::Number(f64::from(codes[i].value)))
            .boxed(),
        Kind::Nominal => prop_oneof![
            (8.0..60.0f64).prop_map(Value::Number),
            Just(Value::Text("12H7".to_owned()))
        ]
        .boxed(),
        Kind::NominalPoint => {
            let sign = if field.key == "point2" { 1.0 } else { -1.0 };
            let place = (30.0..120.0f64, -50.0..50.0f64, -30.0..0.0f64);
            place
                .prop_map(move |(a, o, w)| {
                    Value::List([a * sign, o, w].map(Value::Number).to_vec())
                })
                .boxed()
        }
        Kind::Point => proptest::array::uniform3(-200.0..200.0)
            .prop_map(point)
            .boxed(),
    }
}

fn form(fields: &'static [Field]) -> BoxedStrategy<Vec<(String, Value)>> {
    let values: Vec<_> = fields.iter().map(field_value).collect();
    values
        .prop_map(|values| {
            fields
                .iter()
                .map(|f| f.key.to_owned())
                .zip(values)
                .collect()
        })
        .boxed()
}

/// A whole job of a cycle with every field at random. The control's form stays `moves`.
pub fn whole_job() -> impl Strategy<Value = Value> {
    (0..CYCLES.len()).prop_flat_map(|i| {
        let def: &'static CycleDef = CYCLES[i];
        let inner: Vec<_> = def.sections.iter().map(|s| (Just(s), form(s.fields), any::<bool>())).collect();
        let cycle = (form(def.fields), inner).prop_map(move |(mut fields, inner)| {
            fields.push(("type".to_owned(), Value::Text(def.key.to_owned())));
            for (section, values, there) in inner {
                let value = if there || !section.optional { Value::Map(values) } else { Value::Null };
                fields.push((section.key.to_owned(), value));
            }
            Value::Map(fields)
        });
        let sections: Vec<_> = touchpath::job::SECTIONS.iter().filter(|section| !section.optional).map(|section| (Just(section.key), form(section.fields))).collect();
        // A displaced part as a setter might have it; half the jobs have the nominal one.
        let lie = (proptest::array::uniform3(-1.0..1.0), -1.0..1.0f64, any::<bool>());
        // A stylus of any size would collide in most jobs, so it is mostly unknown.
        let shaped = proptest::bool::weighted(0.2);
        (cycle, sections, lie, shaped).prop_map(|(cycle, sections, (offset, rotation, nominal), shaped)| {
            let mut job = vec![("format".to_owned(), number(1.0)), ("cycle".to_owned(), cycle)];
            for (path, fields) in sections {
                match path {
                    "" => job.extend(fields),
                    "part" => {
                        let offset = if nominal { [0.0; 3] } else { offset };
                        job.push(("part".to_owned(), Value::Map(vec![("offset".to_owned(), point(offset))])));
                        job = match with(&Value::Map(job), "part.rotation", number(if nominal { 0.0 } else { rotation })) {
                            Value::Map(entries) => entries,
                            _ => unreachable!("a job is a map"),
                        };
                    }
                    "stylus" if !shaped => {
                        let known = fields.into_iter().filter(|(key, _)| !matches!(key.as_str(), "length" | "shank" | "body"));
                        job.push((path.to_owned(), Value::Map(known.collect())));
                    }
                    _ => job.push((path.to_owned(), Value::Map(fields))),
                }
            }
            let mut job = Value::Map(job);
            // The laws are about plain moves, and 1411 on its own control.
            let takes = |key: &str| key == "heidenhain" || crate::tests::controls::of_moves().contains(&key);
            if !matches!(job.get("control").and_then(|c| c.get("post")), Some(Value::Text(key)) if takes(key)) {
                job = with(&job, "control.post", Value::Text("linuxcnc".to_owned()));
            }
            let heidenhain = Value::Text("heidenhain".to_owned());
            let klartext = job.get("control").and_then(|c| c.get("post")) == Some(&heidenhain);
            if klartext && def.default_control.0 != "heidenhain" {
                job = with(&job, "control.post", Value::Text("linuxcnc".to_owned()));
            }
            let form = if klartext && def.default_control.0 == "heidenhain" { "cycle" } else { "moves" };
            job = with(&job, "control.form", Value::Text(form.to_owned()));
            // A dry run has its own law.
            job = with(&job, "control.run", Value::Text("normal".to_owned()));
            // A program with a question must write, and show its results: most jobs would be refused.
            if !shaped {
                job = with(&job, "control.ask", Value::Text("never".to_owned()));
            }
            if form == "cycle" { with(&job, "control.workOffset", Value::Null) } else { job }
        })
    })
}

/// Any value that could be passed as a job.
fn anything() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::Flag),
        any::<f64>().prop_map(Value::Number),
        prop_oneof![
            Just(f64::NAN),
            Just(f64::INFINITY),
            Just(1e300),
            Just(-1e300),
            Just(5e-324)
        ]
        .prop_map(Value::Number),
        ".{0,12}".prop_map(Value::Text),
        Just(Value::Other("a function")),
    ];
    leaf.prop_recursive(3, 24, 6, |inner| {
        prop_oneof![
            proptest::collection::vec(inner.clone(), 0..5).prop_map(Value::List),
            proptest::collection::vec((".{0,8}", inner), 0..5).prop_map(Value::Map),
        ]
    })
}

fn errors(job: &Value) -> usize {
    check(job)
        .iter()
        .filter(|f| f.level == Level::Error)
        .count()
}

/// The laws are only meaningful if enough forms have a plan.
#[test]
fn many_forms_have_a_plan_and_many_have_not() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let jobs: Vec<Value> = (0..400)
        .map(|_| whole_job().new_tree(&mut runner).unwrap().current())
        .collect();
    let good = jobs.iter().filter(|job| plan(job).is_ok()).count();
    assert!((60..360).contains(&good), "{good} of 400");
}

/// A form gives either errors or a whole, sane plan, and `check` agrees.
#[test]
fn every_form_gives_errors_or_a_whole_plan() {
    law(600, 150, (whole_job(),), |(job,)| {
        match plan(&job) {
            Ok(plan) => {
                prop_assert_eq!(errors(&job), 0);
                let tool_axis = match job.get("plane") {
                    Some(Value::Text(p)) if p == "G18" => 1,
                    Some(Value::Text(p)) if p == "G19" => 0,
                    _ => 2,
                };
                sane(&job, &plan, tool_axis).map_err(TestCaseError::fail)?;
            }
            Err(error) => {
                prop_assert!(error.findings.iter().any(|f| f.level == Level::Error));
                prop_assert_eq!(&error.findings, &check(&job));
            }
        }
        Ok(true)
    });
}

/// No input causes a panic, whole or as a part of a good job.
#[test]
fn nothing_panics() {
    law(600, 600, (anything(), 0usize..160), |(value, which)| {
        let _ = check(&value);
        let job = default_job(CYCLES[which % CYCLES.len()].key).unwrap();
        let paths = [
            "format",
            "name",
            "units",
            "plane",
            "stylus",
            "stylus.diameter",
            "feeds",
            "feeds.work",
            "overtravel",
            "cycle",
            "cycle.type",
            "cycle.origin",
            "cycle.rotation",
            "cycle.angle",
            "cycle.width1",
            "cycle.count1",
            "control",
            "control.post",
            "control.workOffset",
            "part",
            "part.offset",
            "part.sizes",
            "part.sizes.width1",
            "bogus",
            "cycle.touches",
            "cycle.properties",
            "cycle.custom",
            "cycle.topClearance",
            "cycle.stepCount",
            "tool",
            "tool.frame",
            "tool.type",
        ];
        let broken = with(&job, paths[which % paths.len()], value.clone());
        let _ = plan(&broken);
        let _ = touchpath::job::evaluate(&job, &value);
        Ok(true)
    });
}

/// The same part in inch and in mm gives the same geometry and program lines.
#[test]
fn inch_and_mm_are_the_same_part() {
    law(600, 150, (whole_job(),), |(job,)| {
        let metric = with(&job, "units", Value::Text("mm".to_owned()));
        let imperial = in_inch(&metric);
        let (Ok(a), Ok(b)) = (plan(&metric), plan(&imperial)) else {
            prop_assert_eq!(errors(&metric) > 0, errors(&imperial) > 0);
            return Ok(false);
        };
        prop_assert_eq!(a.moves.len(), b.moves.len());
        for (m, i) in a.moves.iter().zip(&b.moves) {
            prop_assert!(distance(m.to, i.to.map(|x| x * 25.4)) < 1e-7);
            prop_assert_eq!((m.kind, m.feed, m.step), (i.kind, i.feed, i.step));
        }
        prop_assert!((a.time - b.time).abs() < 1e-9);
        for (row, i) in a.results.iter().zip(&b.results) {
            let scale = if row.unit == "mm" { 25.4 } else { 1.0 };
            match (row.value, i.value) {
                // The residual is the root of a difference of large sums.
                (Some(m), Some(i)) if row.code.starts_with("residual") => {
                    prop_assert!((m - i * scale).abs() < 1e-3)
                }
                (Some(m), Some(i)) => prop_assert!((m - i * scale).abs() < 1e-6),
                (m, i) => prop_assert_eq!(m.is_some(), i.is_some()),
            }
        }
        Ok(true)
    });
}

/// Rotating the job about the tool axis rotates the path and changes nothing else.
#[test]
fn a_turned_job_is_a_turned_path() {
    law(1000, 100, (whole_job(), -180.0..180.0f64), |(job, turn)| {
        let Ok(straight) = plan(&with(&job, "part", Value::Map(vec![]))) else {
            return Ok(false);
        };
        let axes: [usize; 3] = match job.get("plane") {
            Some(Value::Text(p)) if p == "G18" => [2, 0, 1],
            Some(Value::Text(p)) if p == "G19" => [1, 2, 0],
            _ => [0, 1, 2],
        };
        let (sin, cos) = turn.to_radians().sin_cos();
        let turned_point = |p: [f64; 3]| {
            let mut q = p;
            q[axes[0]] = p[axes[0]] * cos - p[axes[1]] * sin;
            q[axes[1]] = p[axes[0]] * sin + p[axes[1]] * cos;
            q
        };
        let cycle = job.get("cycle").unwrap();
        if circles(&straight) {
            // It has neither origin nor rotation; `circles.rs` turns its points.
            return Ok(false);
        }
        let Some(Value::List(origin)) = cycle.get("origin") else {
            prop_assert!(straight.moves.is_empty());
            return Ok(false);
        };
        let origin: Vec<f64> = origin
            .iter()
            .map(|v| if let Value::Number(x) = v { *x } else { 0.0 })
            .collect();
        let Some(Value::Number(rotation)) = cycle.get("rotation") else {
            panic!("a rotation")
        };
        let rotation = touchpath::num::wrap_degrees(rotation + turn);
        let turned = with(
            &with(&job, "part", Value::Map(vec![])),
            "cycle.rotation",
            number(rotation),
        );
        let turned = with(
            &turned,
            "cycle.origin",
            point(turned_point([origin[0], origin[1], origin[2]])),
        );
        let turned = plan(&turned).map_err(|e| TestCaseError::fail(e.to_string()))?;
        for (a, b) in straight.moves.iter().zip(&turned.moves) {
            prop_assert!(distance(turned_point(a.to), b.to) < 1e-8);
        }
        Ok(true)
    });
}

/// On the nominal part every touch triggers at its contact and every result is nominal. A shifted part shifts the results of the corner, which measures its own
/// angles, exactly, and a rotated one rotates them.
#[test]
fn results_follow_the_part() {
    law(
        600,
        100,
        (whole_job(), -0.4..0.4f64, -0.4..0.4f64, -0.2..0.2f64),
        |(job, dx, dy, turn)| {
            let job = with(
                &with(&job, "overtravel", number(20.0)),
                "units",
                Value::Text("mm".to_owned()),
            );
            let Ok(nominal) = plan(&with(&job, "part", Value::Map(vec![]))) else {
                return Ok(false);
            };
            if circles(&nominal) {
                // Its deviations count from the middle of tolerances; `circles.rs` checks its part.
                return Ok(false);
            }
            for row in &nominal.results {
                if let Some(deviation) = row.deviation.filter(|_| !row.code.starts_with("residual"))
                {
                    prop_assert!(deviation.abs() < 1e-7, "{}: {}", row.code, deviation);
                }
            }
            let axes = match job.get("plane") {
                Some(Value::Text(p)) if p == "G18" => [2, 0],
                Some(Value::Text(p)) if p == "G19" => [1, 2],
                _ => [0, 1],
            };
            let mut offset = [0.0; 3];
            (offset[axes[0]], offset[axes[1]]) = (dx, dy);
            let shifted = with(
                &with(&job, "part", Value::Map(vec![])),
                "part.offset",
                point(offset),
            );
            // A single pair of walls, or a surface, measures only along its target vector.
            let read_along = nominal
                .results
                .iter()
                .any(|r| matches!(r.code.as_str(), "width" | "deviation"));
            let n = nominal.touches.first().map_or([0.0; 3], |t| t.vector);
            let off: f64 = (0..3).map(|i| offset[i] * n[i]).sum();
            let along = |axis: usize| {
                if read_along {
                    off * n[axis]
                } else {
                    offset[axis]
                }
            };
            // A touch that contacts another wall or an edge is reported, and measures something else.
            let meant = |plan: &Plan| {
                !plan
                    .findings
                    .iter()
                    .any(|f| matches!(f.code.as_str(), "wrong-wall" | "edge-contact"))
            };
            if let Some(shifted) = plan(&shifted).ok().filter(meant) {
                for row in &shifted.results {
                    let wanted = match row.code.as_str() {
                        "center.x" | "corner.x" | "offset.x" | "point.x" => along(axes[0]),
                        "center.y" | "corner.y" | "offset.y" | "point.y" => along(axes[1]),
                        "point.z" | "offset.z" if read_along && row.code != "height" => {
                            if nominal.results.iter().any(|r| r.code == "height") {
                                0.0
                            } else {
                                along(3 - axes[0] - axes[1])
                            }
                        }
                        "deviation" => off,
                        _ => 0.0,
                    };
                    if let Some(deviation) =
                        row.deviation.filter(|_| !row.code.starts_with("residual"))
                    {
                        prop_assert!(
                            (deviation - wanted).abs() < 1e-6,
                            "{}: {} for {}",
                            row.code,
                            deviation,
                            wanted
                        );
                    }
                }
            }
            let turned = with(&shifted, "part.rotation", number(turn));
            if let Some(turned) = plan(&turned).ok().filter(meant) {
                // A corner with its own angles has no error; a result with an error has the true value beside it.
                let exact = turned
                    .results
                    .iter()
                    .any(|r| r.code == "angle" && r.value.is_some());
                for row in turned.results.iter().filter(|_| exact) {
                    if let (Some(value), Some(truth)) = (row.value, row.truth) {
                        prop_assert!(
                            (value - truth).abs() < 1e-6,
                            "{}: {} {}",
                            row.code,
                            value,
                            truth
                        );
                    }
                }
            }
            Ok(true)
        },
    );
}

/// Measured points are evaluated like predicted ones.
#[test]
fn measured_triggers_give_the_predicted_results() {
    law(600, 100, (whole_job(),), |(job,)| {
        let Ok(predicted) = plan(&job) else {
            return Ok(false);
        };
        if predicted.triggers.iter().any(Option::is_none) {
            return Ok(false);
        }
        let points = Value::List(
            predicted
                .triggers
                .iter()
                .map(|t| point(t.unwrap()))
                .collect(),
        );
        // A part far off can trigger during the approach; such points are refused, not evaluated.
        let Ok(rows) = touchpath::job::evaluate(&job, &points) else {
            return Ok(false);
        };
        for (a, b) in predicted.results.iter().zip(&rows) {
            prop_assert_eq!(&a.code, &b.code);
            if let (Some(x), Some(y)) = (a.value, b.value) {
                let off = if a.code.starts_with("residual") {
                    1e-3
                } else {
                    1e-7
                };
                prop_assert!((x - y).abs() < off);
            }
        }
        Ok(true)
    });
}

/// The job with every length and feed in inch.
fn in_inch(job: &Value) -> Value {
    let mut inch = with(job, "units", Value::Text("inch".to_owned()));
    let mut convert = |prefix: &str, fields: &[Field]| {
        for field in fields {
            let path = if prefix.is_empty() {
                field.key.to_owned()
            } else {
                format!("{prefix}.{}", field.key)
            };
            let mut at = Some(job);
            for key in path.split('.') {
                at = at.and_then(|v| v.get(key));
            }
            let value = match (at, field.kind, field.default) {
                (
                    Some(Value::Number(x)),
                    Kind::Length | Kind::Feed | Kind::Acceleration | Kind::Nominal,
                    _,
                ) => number(x / 25.4),
                (Some(Value::Text(_)), Kind::Nominal, _) => {
                    Value::Text(format!("{:.15}H7", 12.0 / 25.4))
                }
                (Some(Value::List(items)), Kind::Point | Kind::NominalPoint, _) => Value::List(
                    items
                        .iter()
                        .map(|v| {
                            if let Value::Number(x) = v {
                                number(x / 25.4)
                            } else {
                                v.clone()
                            }
                        })
                        .collect(),
                ),
                (
                    _,
                    _,
                    Default::Number(_)
                    | Default::Flag(_)
                    | Default::Text(_)
                    | Default::Point(_)
                    | Default::Null,
                ) => {
                    continue;
                }
            };
            inch = with(&inch, &path, value);
        }
    };
    for section in touchpath::job::SECTIONS {
        convert(section.key, section.fields);
    }
    let Some(Value::Text(key)) = job.get("cycle").and_then(|c| c.get("type")) else {
        panic!("a type")
    };
    let def = touchpath::cycle::find(key).unwrap();
    convert("cycle", def.fields);
    for section in def.sections {
        if matches!(
            job.get("cycle").and_then(|c| c.get(section.key)),
            Some(Value::Map(_))
        ) {
            convert(&format!("cycle.{}", section.key), section.fields);
        }
    }
    inch
}
