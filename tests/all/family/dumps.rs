//! Dumps of the parameters become the job again, in every spelling.

use super::{dumped_job, numbered, value};
use crate::common::import;
use crate::common::{job, law, number, planned, with};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use touchpath::describe::export_table;
use touchpath::form::{Level, Value};
use touchpath::job::{check, default_job, job_name, plan};

/// Equality without order.
fn sorted(value: &Value) -> Value {
    match value {
        Value::Map(entries) => {
            let mut entries: Vec<(String, Value)> = entries
                .iter()
                .map(|(k, v)| (k.clone(), sorted(v)))
                .collect();
            entries.sort_by(|a, b| a.0.cmp(&b.0));
            Value::Map(entries)
        }
        other => other.clone(),
    }
}

/// The job with defaults in fields that its variant does not use: a dump of the rectangular variant omits them.
fn without_idle(job: &Value) -> Value {
    let rectangular = job.get("cycle").and_then(|c| c.get("variant")) == Some(&number(0.0));
    [
        ("startAngle", 0.0),
        ("angularStep", 90.0),
        ("stepCount", 4.0),
    ]
    .into_iter()
    .filter(|_| rectangular)
    .fold(job.clone(), |job, (key, value)| {
        with(&job, &format!("cycle.{key}"), number(value))
    })
}

/// Job, dump, job: equal in each of the three forms.
#[test]
fn a_dump_becomes_the_job_again() {
    law(150, 40, (dumped_job(),), |(job,)| {
        let Ok(planned) = plan(&job) else {
            return Ok(false);
        };
        for format in ["text", "csv", "json"] {
            let dump = export_table(&planned, format).unwrap();
            let imported = import(&dump).map_err(|e| TestCaseError::fail(format!("{e} {dump}")))?;
            // A dump has no name: the job gets the default one.
            let named = with(&without_idle(&job), "name", Value::Text(job_name(&job)));
            prop_assert_eq!(
                sorted(&imported.job),
                sorted(&named),
                "{} {:?}\n{}",
                format,
                imported.findings,
                dump
            );
            prop_assert!(
                imported
                    .findings
                    .iter()
                    .any(|f| f.code == "not-in-dump" && f.path == "feeds")
            );
            // Mutilated dumps are read or refused without a panic.
            let middle = dump.floor_char_boundary(dump.len() / 2);
            let _ = import(&dump[..middle]).map(|i| check(&i.job));
            let _ = import(&dump[middle..]).map(|i| check(&i.job));
            let _ = import(&dump.replace('-', "")).map(|i| check(&i.job));
            let _ = import(&dump.replace("0", "9")).map(|i| check(&i.job));
        }
        Ok(true)
    });
}

/// No pasted text causes a panic.
#[test]
fn nothing_pasted_panics() {
    law(
        400,
        400,
        (
            "(CmdPrm\\. ?(Int|Flt|Bol) ?\\[-?[0-9]{1,4}\\] ?[=,:;] ?[-0-9.,eE]{0,8}\n?){0,40}",
            ".{0,60}",
        ),
        |(text, tail)| {
            let _ = import(&format!("CmdPrm.Int[-1] = 7\n{text}{tail}")).map(|i| check(&i.job));
            let _ = import(&format!("MEAS=1 {text}\n{tail}"));
            let _ = import(&text);
            Ok(true)
        },
    );
}

/// A dump as in real logs: spaces, decimal commas, another order, codes of the user, an older version without -66 and -200.
#[test]
fn a_real_life_dump_is_read() {
    let dump = "EXTCYCLE 500 CALL(52)\n  CmdPrm. Flt [-55] : 10,5\n CmdPrm.Flt[-50]=20\nCmdPrm.Int[-1]   =  7 ; type\n\
        CmdPrm.Int[-2] = 4711\nCmdPrm.Flt[-51] = 12,0\n  Flt[-53] = 80\n Flt[-54] = 50 mm\n Flt[-56] = 8\n Flt[-57] = 9\n\
        CmdPrm. Flt [-100] = 50\n Flt[-101] = 20\n Flt[-102] = -12\n Flt[-103] = -1\n Flt[-104] = 0\n Flt[-105] = 0\n\
        Flt[-106] = -30\n Flt[-107] = 20\n Flt[-108] = -12\n Flt[-109] = 1\n Flt[-110] = 0\n Flt[-111] = 0\n\
        Flt[-112] = 10\n Flt[-113] = 45\n Flt[-114] = -12\n Flt[-115] = 0\n Flt[-116] = -1\n Flt[-117] = 0\n\
        Flt[-118] = 10\n Flt[-119] = -5\n Flt[-120] = -12\n Flt[-121] = 0\n Flt[-122] = 1\n Flt[-123] = 0\nInt[105] = 3\nInt[-77] = 1\n";
    let imported = import(dump).unwrap();
    let plan = planned(&imported.job);
    let cycle = imported.job.get("cycle").unwrap();
    let wanted = job(
        r#"{ "origin": [10, 20, 0], "rotation": 0, "width1": 80, "width2": 50, "depth": 12, "topClearance": 10.5,
        "sideClearance1": 8, "sideClearance2": 9, "feedDistance": 20, "subCode": 4711, "compensateDimensions": false }"#,
    );
    let Value::Map(wanted) = wanted else {
        unreachable!()
    };
    for (key, value) in wanted {
        assert_eq!(cycle.get(&key), Some(&value), "{key}");
    }
    assert_eq!(cycle.get("touches"), None);
    assert!(
        export_table(&plan, "text")
            .unwrap()
            .ends_with("CmdPrm.Int[105] = 3\n")
    );
    let said: Vec<&str> = imported.findings.iter().map(|f| f.code.as_str()).collect();
    assert_eq!(said, ["unknown-code", "not-in-dump", "not-in-dump"]);
    assert_eq!(crate::common::values(&imported.findings[0]), ["-77"]);
    // Missing codes are reported one by one, and defaults apply.
    let short = import(&dump.replace("CmdPrm.Flt[-51] = 12,0\n", "")).unwrap();
    assert!(
        short
            .findings
            .iter()
            .any(|f| f.code == "missing-code" && f.path == "cycle.depth")
    );
    let flag = import(&format!("{dump}CmdPrm.Flt[-66] = 2\n")).unwrap();
    assert!(
        flag.findings
            .iter()
            .any(|f| f.code == "not-a-flag" && f.path == "cycle.compensateDimensions")
    );
    // The Int accessor for -66 works, too; then the used points are centres of a ball whose radius is not stated.
    let balls = import(&format!("{dump}CmdPrm.Int[-66] = 1\n")).unwrap();
    assert!(balls.findings.iter().any(|f| f.code == "ball-unknown"));
    assert_eq!(
        balls.job.get("cycle").unwrap().get("compensateDimensions"),
        Some(&Value::Flag(true))
    );
    // Types of the frame output, and several cycles.
    let several = import(&format!(
        "Int[-1]=0\nInt[-2]=-500\nBol[-3]=true\nInt[-1]=9999\n{}",
        &dump[dump.find("CmdPrm.Int[-1]").unwrap()..]
    ))
    .unwrap();
    let said: Vec<&str> = several.findings.iter().map(|f| f.code.as_str()).collect();
    assert!(
        said.contains(&"unknown-type") && said.contains(&"several-cycles"),
        "{said:?}"
    );
    assert_eq!(
        several.job.get("cycle").unwrap().get("subCode"),
        Some(&number(4711.0))
    );
    assert!(
        import("Int[-1] = 2147483647\n")
            .unwrap_err()
            .findings
            .iter()
            .any(|f| f.code == "unknown-type")
    );
    let on = import("CmdPrm.Int[-1] = 0\nCmdPrm.Int[-2] = -500\nCmdPrm.Bol[-3] = false\n").unwrap();
    assert_eq!(
        on.job.get("cycle").unwrap().get("on"),
        Some(&Value::Flag(false))
    );
    // A vector in the wrong direction becomes a job with a finding.
    let wrong = import(&dump.replace("Flt[-103] = -1", "Flt[-103] = 1")).unwrap();
    assert!(wrong.findings.iter().any(|f| f.code == "touches-unsound"));
    assert!(
        check(&wrong.job)
            .iter()
            .any(|f| f.level == Level::Error && f.path.starts_with("cycle.touches"))
    );
}

/// Reading a dump does not depend on the default ball: clearances that only a smaller one allows, another plane, three decimals, a ball between the blocks.
#[test]
fn a_dump_is_placed_whatever_the_ball() {
    let dump = |text: &str| export_table(&planned(&job(text)), "text").unwrap();
    let small = dump(
        r#"{ "format": 1, "plane": "G18", "stylus": { "diameter": 2 }, "cycle": { "type": "internal-rectangle-protected",
        "origin": [10, 20, 5], "sideClearance1": 2, "sideClearance2": 2 } }"#,
    );
    let imported = import(&small).unwrap();
    assert_eq!(
        imported.job.get("plane"),
        Some(&Value::Text("G18".to_owned()))
    );
    assert_eq!(
        imported.job.get("cycle").unwrap().get("origin"),
        Some(&crate::common::point([10.0, 20.0, 5.0]))
    );
    assert!(
        imported
            .findings
            .iter()
            .all(|f| f.code != "touches-unsound")
    );
    planned(&with(&imported.job, "stylus.diameter", number(2.0)));
    // Three decimals, as many postprocessors print.
    let corner = dump(
        r#"{ "format": 1, "cycle": { "type": "double-wall-internal-corner", "origin": [10, 20, 0], "rotation": 30, "angle": 80,
        "count1": 3, "step1": 60 } }"#,
    );
    let rounded: String = corner
        .lines()
        .map(|line| {
            let (code, value) = line.split_once(" = ").unwrap();
            format!(
                "{code} = {}\n",
                (value.parse::<f64>().unwrap() * 1000.0).round() / 1000.0
            )
        })
        .collect();
    let plan = planned(&import(&rounded).unwrap().job);
    assert!(
        (value(&plan, "corner.x") - 10.0).abs() < 0.02
            && (value(&plan, "corner.y") - 20.0).abs() < 0.02
    );
    // A web fits several planes, which is reported.
    let web = import(&dump(r#"{ "format": 1, "cycle": { "type": "web" } }"#)).unwrap();
    assert!(
        web.findings
            .iter()
            .any(|f| f.code == "plane-unknown" && f.path == "plane")
    );
    assert_eq!(web.job.get("plane"), Some(&Value::Text("G17".to_owned())));
    // More than a ball between used and original points: the used ones count.
    let moved: String =
        dump(r#"{ "format": 1, "cycle": { "type": "internal-rectangle-protected", "compensateDimensions": true } }"#)
            .lines()
            .map(|line| {
                let (code, value) = line.split_once(" = ").unwrap();
                let shift = ["[-100]", "[-106]", "[-112]", "[-118]"].iter().any(|c| code.ends_with(c));
                format!("{code} = {}\n", value.parse::<f64>().unwrap() + if shift { 5.0 } else { 0.0 })
            })
            .collect();
    let imported = import(&moved).unwrap();
    assert!(imported.findings.iter().any(|f| f.code == "ball-unknown"));
    assert_eq!(
        imported.job.get("cycle").unwrap().get("origin"),
        Some(&crate::common::point([5.0, 0.0, 0.0]))
    );
}

/// Codes of the user in any form cause no error.
#[test]
fn own_codes_are_kept_as_well_as_can_be() {
    let dump = export_table(&planned(&default_job("web").unwrap()), "text").unwrap();
    let many: String = (0..400)
        .map(|i| format!("Int[{}] = {i}\n", i + 100))
        .collect();
    for own in [
        "Int[5] = 1\nFlt[5] = 2\n",
        "Int[6] = 2.5\n",
        many.as_str(),
        "TouchPoint[1] = 2.5\n",
        "Flt[0] = 3\n",
    ] {
        let imported = import(&format!("{dump}{own}")).unwrap();
        planned(&imported.job);
    }
    // A large hostile text is read quickly: linear, not quadratic.
    for hostile in [
        "Flt[1]1 ",
        "int[",
        "Int[-1]=7 ",
        "[",
        "Flt[-50]",
        "{\"code\":\"Int[-1]\" ",
    ] {
        let _ = import(&format!("Int[-1]=7 {}", hostile.repeat(300_000)));
    }
}

/// The property is only meaningful if enough jobs of every type have a plan.
#[test]
fn every_type_takes_part_in_the_round_trip() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let mut seen = std::collections::BTreeMap::new();
    for _ in 0..600 {
        let job = dumped_job().new_tree(&mut runner).unwrap().current();
        if plan(&job).is_ok() {
            *seen
                .entry(format!("{:?}", job.get("cycle").unwrap().get("type")))
                .or_insert(0) += 1;
        }
    }
    assert_eq!(seen.len(), numbered(), "{seen:?}");
    assert!(seen.values().all(|n| *n >= 2), "{seen:?}");
}
