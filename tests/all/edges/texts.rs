//! Headers, dumps and programs as texts, and their numbers.

use super::{cycle, errors, text, warnings};
use crate::common::import;
use crate::common::{job, number, planned, point, with};
use touchpath::describe::{catalog, export_table};
use touchpath::form::{Level, Value};
use touchpath::job::{check, default_job, plan};

#[test]
fn comment_lines_are_longer_than_the_control_takes() {
    let longest = [
        ("linuxcnc", 160),
        ("grbl", 80),
        ("grblhal", 120),
        ("fluidnc", 120),
        ("sinumerik", 120),
        ("heidenhain", 80),
        ("fanuc", 80),
        ("haas", 80),
        ("mazak", 80),
        ("brother", 80),
        ("hurco", 80),
        ("okuma", 80),
    ];
    for post in touchpath::control::POSTS {
        assert!(
            longest.iter().any(|(key, _)| *key == post.key),
            "the longest comment of {} is not stated here",
            post.key
        );
    }
    for (post, longest) in longest {
        for def in touchpath::cycle::CYCLES {
            let form = if crate::tests::controls::of_moves().contains(&post) {
                "moves"
            } else {
                "cycle"
            };
            let job = with(
                &with(&default_job(def.key).unwrap(), "control.post", text(post)),
                "control.form",
                text(form),
            );
            let job = with(&job, "name", text(&"long name ".repeat(20)));
            let Ok(plan) = plan(&job) else { continue };
            for line in plan.program.text.lines() {
                let comment = line.starts_with(['(', ';']) || line.contains(" ; ");
                assert!(
                    !comment || line.len() <= longest,
                    "{post} {}: {line}",
                    line.len()
                );
                assert!(line.len() <= 512);
            }
        }
    }
}

/// In G18 a control shows `center.x=30`, and 30 is on Z.
#[test]
fn the_x_of_a_result_looked_like_the_axis_x() {
    let says = |job: &Value| {
        let text = planned(job).program.text;
        text.lines()
            .find(|line| line.contains("names of results"))
            .map(|line| line.trim_matches(['(', ')', ';', ' ']).to_owned())
    };
    for post in ["linuxcnc", "sinumerik"] {
        let hole = with(&default_job("hole").unwrap(), "control.post", text(post));
        for (plane, wanted) in [
            ("G17", None),
            (
                "G18",
                Some(
                    "In names of results x is the abscissa Z, y the ordinate X, z the tool axis Y",
                ),
            ),
            (
                "G19",
                Some(
                    "In names of results x is the abscissa Y, y the ordinate Z, z the tool axis X",
                ),
            ),
        ] {
            assert_eq!(
                says(&with(&hole, "plane", text(plane))).as_deref(),
                wanted,
                "{post} {plane}"
            );
        }
        let plane = with(
            &default_job("internal-rectangle-protected").unwrap(),
            "plane",
            text("G18"),
        );
        assert!(
            says(&with(&plane, "control.post", text("grbl"))).is_none(),
            "it computes no results"
        );
    }
}

#[test]
fn the_note_quotes_another_name_than_the_program_bears() {
    let name = "Größe Ø 12";
    for (post, form, wanted) in [
        ("linuxcnc", "moves", "Gr__e _ 12"),
        ("heidenhain", "cycle", "Gr__e___12"),
    ] {
        let job = with(
            &with(
                &default_job("probing-two-circles").unwrap(),
                "control.post",
                text(post),
            ),
            "control.form",
            text(form),
        );
        let job = with(&job, "name", text(name));
        let finding = check(&job)
            .into_iter()
            .find(|f| f.code == "name-changed")
            .unwrap();
        assert!(
            finding.message.contains(&format!("\"{wanted}\"")),
            "{}",
            finding.message
        );
        assert!(planned(&job).program.text.contains(wanted));
    }
}

#[test]
fn angles_of_1411_have_three_decimals() {
    let job = cycle(
        r#"{ "type": "probing-two-circles", "startingAngle": 12.3456, "angularLength": 300.5 }"#,
    );
    let job = with(
        &job,
        "control",
        crate::common::job(r#"{ "post": "heidenhain", "form": "cycle" }"#),
    );
    let plan = planned(&job);
    assert!(
        plan.program.text.contains("Q325=+12.346 ;")
            && plan.program.text.contains("Q1119=+300.5 ;")
    );
    assert_eq!(
        plan.findings
            .iter()
            .filter(|f| f.code == "angle-rounded")
            .count(),
        1
    );
}

#[test]
fn printing_in_inch_hides_small_values() {
    let inch = job(r#"{ "format": 1, "units": "inch", "cycle": { "type": "hole" } }"#);
    assert!(
        planned(&inch)
            .program
            .text
            .contains("PRINT shows a value below .0001 inch as 0")
    );
    assert!(
        !planned(&default_job("hole").unwrap())
            .program
            .text
            .contains("below .0001")
    );
}

/// Another version's defaults would make another program from a header that omits them.
#[test]
fn the_header_says_only_what_the_loose_job_said() {
    let loose = job(
        r#"{ "format": 1, "cycle": { "type": "hole", "rotation": -0.0 }, "control": { "post": "sinumerik" } }"#,
    );
    let text = planned(&loose).program.text;
    for said in [
        "format=1",
        "units=mm",
        "cycle.diameter=40",
        "cycle.topClearance=10",
        "cycle.rotation=0",
        "stylus.diameter=6",
        "overtravel=5",
    ] {
        assert!(
            text.lines()
                .any(|l| l.starts_with("; job ") && l.split(' ').any(|w| w == said)),
            "{said}\n{text}"
        );
    }
    assert!(!text.contains("-0 ") && !text.contains("=-0"));
    assert!(text.contains(&format!(
        "; Made by Touchpath {} ",
        env!("CARGO_PKG_VERSION")
    )));
    let imported = import(&text).unwrap();
    assert!(
        imported.findings.iter().all(|f| f.level == Level::Info),
        "{:?}",
        imported.findings
    );
    assert_eq!(planned(&imported.job).program.text, text);
}

#[test]
fn a_decimal_comma_in_a_json_dump_ends_the_value() {
    let dump = r#"{ "rows": [ { "code": "CmdPrm.Int[-1]", "value": 7 }, { "code": "CmdPrm.Flt[-53]", "value": "64,5", "meaning": "a } in it" } ] }"#;
    assert_eq!(
        crate::common::number_at(&import(dump).unwrap().job, "cycle.width1", 0.0),
        64.5
    );
}

#[test]
fn a_jobs_own_json_is_refused_by_import() {
    let imported =
        import(r#"{ "format": 1, "cycle": { "type": "hole", "diameter": -3 } }"#).unwrap();
    assert_eq!(
        crate::common::number_at(&imported.job, "cycle.diameter", 0.0),
        -3.0
    );
    assert_eq!(imported.findings, check(&imported.job));
}

#[test]
fn predef_has_no_place_in_a_job() {
    let klartext = "0 BEGIN PGM A MM\n1 TCH PROBE 1411 ~\nQ1100=-30 ~\nQ1101=+0 ~\nQ1102=-10 ~\nQ1116=+20 ~\nQ1103=+30 ~\nQ1104=+0 ~\n\
                    Q1105=-10 ~\nQ1117=+20 ~\nQ320=PREDEF ~\nQ260=PREDEF\n2 END PGM A MM\n";
    let imported = import(klartext).unwrap();
    let at = |key: &str| imported.job.get("cycle").unwrap().get(key).cloned();
    assert_eq!(
        (at("setUpClearancePredef"), at("clearanceHeightPredef")),
        (Some(Value::Flag(true)), Some(Value::Flag(true)))
    );
    assert_eq!(
        imported
            .findings
            .iter()
            .filter(|f| f.code == "predefined")
            .count(),
        2
    );
    let plan = planned(&imported.job);
    assert!(
        plan.program.text.contains("Q320=PREDEF ;SET-UP CLEARANCE")
            && plan.program.text.contains("Q260=PREDEF ;CLEARANCE HEIGHT")
    );
    let row = plan.table.iter().find(|r| r.code == "Q260").unwrap();
    assert_eq!(
        row.value,
        touchpath::job::ParameterValue::Text("PREDEF".to_owned())
    );
    // It is no tolerance that plain moves would have to judge.
    let moves = with(
        &imported.job,
        "control",
        job(r#"{ "post": "linuxcnc", "form": "moves" }"#),
    );
    assert_eq!(
        warnings(&with(&moves, "cycle.errorReaction", number(1.0))),
        [""; 0]
    );
}

#[test]
fn the_star_of_an_iso_block_takes_the_last_parameter_with_it() {
    let iso = "%A G71 *\nN10 G1411 Q1100=-30 Q1116=+20 Q1101=+0 Q1102=-10 Q1103=+30 Q1104=+0 Q1105=-10 Q1117=+20 Q1126=+1 Q1121=+1*\n";
    assert_eq!(
        crate::common::number_at(&import(iso).unwrap().job, "cycle.confirmRotation", 0.0),
        1.0
    );
}

#[test]
fn rows_of_the_angular_variant_contradict_the_rectangular_one() {
    for kind in ["hole", "hole-protected", "boss"] {
        let rectangular = cycle(&format!(
            r#"{{ "type": "{kind}", "variant": 0, "stepCount": 2 }}"#
        ));
        let codes: Vec<String> = planned(&rectangular)
            .table
            .iter()
            .map(|r| r.code.clone())
            .collect();
        assert!(
            codes.iter().all(|c| !["[-60]", "[-61]", "[-62]"]
                .iter()
                .any(|end| c.ends_with(end))),
            "{codes:?}"
        );
        // Missing in a dump they mean none.
        let dump = export_table(&planned(&rectangular), "text").unwrap();
        assert!(
            import(&dump)
                .unwrap()
                .findings
                .iter()
                .all(|f| f.code != "missing-code")
        );
        let angular = planned(&cycle(&format!(r#"{{ "type": "{kind}", "variant": 1 }}"#)));
        assert!(angular.table.iter().any(|r| r.code == "CmdPrm.Int[-62]"));
    }
}

/// The angle of a corner returns as 19.999999… or its position is outside the range of a form: the job is not refused for it.
#[test]
fn dumps_at_the_ends_of_ranges_come_back_refused() {
    for (kind, fields) in [
        (
            "double-wall-internal-corner",
            r#""rotation": 1, "angle": 20, "clearance1": 60, "clearance2": 60"#,
        ),
        (
            "double-wall-external-corner",
            r#""rotation": 1, "angle": 20"#,
        ),
        (
            "double-wall-external-corner",
            r#""rotation": -77.7, "angle": 160, "distance1": 0.001, "distance2": 1000"#,
        ),
        (
            "triple-wall-external-corner",
            r#""rotation": 33.3, "angle": 160, "distance1": 1000, "topDistance1": 0.001"#,
        ),
        ("surface", r#""rotation": 12, "elevation": 0"#),
        ("web", r#""width": 10000, "rotation": 0.1"#),
    ] {
        let job = cycle(&format!(r#"{{ "type": "{kind}", {fields} }}"#));
        let Ok(first) = plan(&job) else {
            panic!("{kind} {fields}: {:?}", errors(&job))
        };
        let imported = import(&export_table(&first, "text").unwrap()).unwrap();
        assert_eq!(
            errors(&imported.job),
            [""; 0],
            "{kind} {fields}: {}",
            imported
                .job
                .get("cycle")
                .map_or(String::new(), |c| format!("{c:?}"))
        );
        let again = planned(&imported.job);
        for (a, b) in first.moves.iter().zip(&again.moves) {
            assert!(
                (0..3).all(|i| (a.to[i] - b.to[i]).abs() < 1e-5),
                "{kind}: {a:?} {b:?}"
            );
        }
    }
}

/// Walls that are nearly parallel meet far away: such picks stay picks.
#[test]
fn picks_that_meet_beyond_every_range_stay_picks() {
    let picks = [
        ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        (
            [0.0, 99_000.0, 0.0],
            [-0.342_020_143_325_669, -0.939_692_620_785_908, 0.0],
        ),
    ];
    let base = job(
        r#"{ "format": 1, "cycle": { "type": "double-wall-external-corner", "count1": 1, "count2": 1 } }"#,
    );
    let touches = picks
        .iter()
        .map(|(p, v)| {
            Value::Map(vec![
                ("point".to_owned(), point(*p)),
                ("vector".to_owned(), point(*v)),
            ])
        })
        .collect();
    let job = with(&base, "cycle.touches", Value::List(touches));
    let refused = plan(&job).is_err();
    if let Ok(first) = plan(&job) {
        let imported = import(&export_table(&first, "text").unwrap()).unwrap();
        assert_eq!(errors(&imported.job), [""; 0]);
    }
    // Distances beyond the form's range are refused in picks already.
    assert!(
        refused,
        "the distance to the first touch is beyond its range"
    );
}

#[test]
fn a_text_of_any_length_is_read() {
    let long = "CmdPrm.Int[-1] = 7\n".repeat(200_000);
    let error = import(&long).unwrap_err();
    assert_eq!(error.findings[0].code, "text-too-long");
    assert_eq!(catalog().longest_text, 2_000_000);
    assert!(import(&long[..1_000_000]).is_ok());
    // Characters are counted, not bytes: 3.8 million of them here.
    let cyrillic = format!("CmdPrm.Int[-1] = 7\n;{}", "Ж".repeat(1_900_000));
    assert!(import(&cyrillic).is_ok());
    let error = import(&format!("{cyrillic}{}", "Ж".repeat(200_000))).unwrap_err();
    assert!(
        error.findings[0]
            .message
            .starts_with("This text has 2.1 million characters"),
        "{error}"
    );
}

/// A job read natively and in a browser is the same to the last bit.
#[test]
fn numbers_are_read_an_ulp_apart() {
    for text in [
        "0.1",
        "5e-324",
        "2.2250738585072011e-308",
        "123456789.12345679",
        "8.988465674311579e307",
        "17.976931348623157",
        "3.3306690738754696e-16",
    ] {
        let Value::Number(x) = job(text) else {
            panic!()
        };
        assert_eq!(x, text.parse::<f64>().unwrap(), "{text}");
    }
    let mut state = 88_172_645_463_325_252u64;
    for _ in 0..20_000 {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        let text = format!("{}.{:017}", state % 1000, state % 100_000_000_000_000_000);
        let Value::Number(x) = job(&text) else {
            panic!()
        };
        assert_eq!(
            x.to_bits(),
            text.parse::<f64>().unwrap().to_bits(),
            "{text}"
        );
    }
}

#[test]
fn a_sinumerik_header_says_the_job_that_made_the_program() {
    // Without a form the reader reads moves, although the cycle's own control is another.
    let job = job(
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles" }, "control": { "post": "sinumerik" } }"#,
    );
    let text = planned(&job).program.text;
    assert!(text.contains("control.form=moves") && !text.contains("control.form=cycle"));
    let read = import(&text).unwrap();
    assert_eq!(
        read.findings
            .iter()
            .map(|f| f.code.as_str())
            .collect::<Vec<_>>(),
        ["part-not-in-program"]
    );
    assert_eq!(planned(&read.job).program.text, text);
    // A header without the control: the blocks cannot be compared, which is reported.
    let other = import(&text.replace(" control.post=sinumerik", "")).unwrap();
    assert!(
        other
            .findings
            .iter()
            .any(|f| f.code == "program-differs" && f.path == "control.post"),
        "{:?}",
        other.findings
    );
}

#[test]
fn a_dump_that_is_a_hundredth_of_a_micrometre_off_level_is_level() {
    let corner = |feed: &str| {
        job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "double-wall-internal-corner"{feed}, "touches": [
            {{ "point": [15, 0, 0], "vector": [0, 1, 0] }}, {{ "point": [35, 0, 0.00001], "vector": [0, 1, 0] }},
            {{ "point": [0, 15, 0], "vector": [1, 0, 0] }}, {{ "point": [0, 35, 0], "vector": [1, 0, 0] }}] }} }}"#
        ))
    };
    // A contact in a crossing retracts; only the last, upward move does not.
    let exits: Vec<String> = planned(&corner(""))
        .program
        .text
        .lines()
        .filter(|l| l.contains("tp_exit> call"))
        .map(str::to_owned)
        .collect();
    let blocked: Vec<bool> = exits.iter().map(|l| l.ends_with("[0]")).collect();
    assert_eq!(blocked.iter().filter(|b| **b).count(), 1, "{exits:?}");
    assert_eq!(blocked.last(), Some(&true));
    assert_eq!(errors(&corner(r#", "feedDistance": 0"#)), [""; 0]);
}

#[test]
fn an_iso_block_may_end_and_begin_without_a_space() {
    let iso = "%X G70*\nN10 T5 G18*\nN20G1411 Q1100=+0 Q1101=+0 Q1102=-1 Q1116=+1 Q1103=+2 Q1104=+0 Q1105=-1 Q1117=+1*\n";
    let read = import(iso).unwrap();
    let at = |path: &str| {
        path.split('.')
            .try_fold(&read.job, |v, key| v.get(key))
            .cloned()
    };
    assert_eq!(at("units"), Some(text("inch")));
    assert_eq!(at("plane"), Some(text("G18")));
    assert_eq!(at("control.tool"), Some(Value::Number(5.0)));
    assert_eq!(at("cycle.diameter2"), Some(Value::Number(1.0)));
}

#[test]
fn a_program_high_above_the_table_is_read_with_the_stylus_above_it() {
    let high = with(
        &default_job("probing-two-circles").unwrap(),
        "cycle.point1",
        point([-30.0, 0.0, 140.0]),
    );
    let high = with(
        &with(&high, "cycle.point2", point([30.0, 0.0, 140.0])),
        "cycle.clearanceHeight",
        number(200.0),
    );
    let high = with(&high, "cycle.start", point([0.0, 0.0, 300.0]));
    let text = planned(&high).program.text;
    let read = import(&text).unwrap().job;
    assert_eq!(errors(&read), [""; 0]);
    assert_eq!(
        planned(&read)
            .program
            .text
            .lines()
            .filter(|l| !l.contains("taken to be at"))
            .count()
            + 1,
        text.lines().count()
    );
    // With PREDEF the clearance height is unknown: the stylus is still assumed above the touches.
    let predef = import(&text.replace("Q260=+200", "Q260=PREDEF"))
        .unwrap()
        .job;
    assert_eq!(errors(&predef), [""; 0]);
}
