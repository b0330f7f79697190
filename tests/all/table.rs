//! The parameter table against the source's pages: every code, in the page's order, with values worked out by hand.

use crate::common::{job, number, planned, with};
use touchpath::form::Value;
use touchpath::job::{ParameterValue, Plan};

fn codes(plan: &Plan) -> Vec<String> {
    plan.table.iter().map(|r| r.code.clone()).collect()
}

fn at(plan: &Plan, code: &str) -> f64 {
    match plan
        .table
        .iter()
        .find(|r| r.code == code)
        .unwrap_or_else(|| panic!("{code}"))
        .value
        .clone()
    {
        ParameterValue::Number(x) => x,
        ParameterValue::Whole(n) => f64::from(n),
        ParameterValue::Flag(on) => f64::from(u8::from(on)),
        ParameterValue::Text(text) => panic!("{text} is no number"),
    }
}

fn floats(codes: impl IntoIterator<Item = i32>) -> Vec<String> {
    codes
        .into_iter()
        .map(|code| format!("CmdPrm.Flt[{code}]"))
        .collect()
}

/// The page of type 7: -1, -2, -50, -51, -53 … -57, four touches from -100, four originals from -200, and -66 last.
#[test]
fn type_7_has_the_rows_of_its_page() {
    let pocket = job(
        r#"{ "format": 1, "stylus": { "diameter": 4 }, "cycle": { "type": "internal-rectangle-protected",
        "origin": [100, 200, 5], "width1": 60, "width2": 40, "depth": 12, "topClearance": 7, "sideClearance1": 9,
        "sideClearance2": 11, "feedDistance": 25, "subCode": 77 } }"#,
    );
    let plan = planned(&pocket);
    let mut expected = vec!["CmdPrm.Int[-1]".to_owned(), "CmdPrm.Int[-2]".to_owned()];
    expected.extend(floats([-50, -51, -53, -54, -55, -56, -57]));
    expected.extend(floats((100..=123).map(|c: i32| -c)));
    expected.extend(floats((200..=223).map(|c: i32| -c)));
    expected.extend(floats([-66]));
    assert_eq!(codes(&plan), expected);
    let values = [
        (-50, 25.0),
        (-51, 12.0),
        (-53, 60.0),
        (-54, 40.0),
        (-55, 7.0),
        (-56, 9.0),
        (-57, 11.0),
        (-66, 0.0),
    ];
    for (code, value) in values {
        assert_eq!(at(&plan, &format!("CmdPrm.Flt[{code}]")), value, "{code}");
    }
    assert_eq!(
        (at(&plan, "CmdPrm.Int[-1]"), at(&plan, "CmdPrm.Int[-2]")),
        (7.0, 77.0)
    );
    // Touch 1 is the wall at 100 + 30, level 5 − 12, its outward normal points back to the centre; touch 4 is at 200 − 20.
    let block = |plan: &Plan, first: i32| -> Vec<f64> {
        (0..6)
            .map(|i| at(plan, &format!("CmdPrm.Flt[{}]", first - i)))
            .collect()
    };
    assert_eq!(block(&plan, -100), [130.0, 200.0, -7.0, -1.0, 0.0, 0.0]);
    assert_eq!(block(&plan, -118), [100.0, 180.0, -7.0, 0.0, 1.0, 0.0]);
    assert_eq!(block(&plan, -200), block(&plan, -100));
    let last = plan.table.last().unwrap();
    assert_eq!(
        (last.code.as_str(), last.type_name, last.field.clone()),
        (
            "CmdPrm.Flt[-66]",
            "Integer",
            Some("cycle.compensateDimensions".to_owned())
        )
    );
    let row = plan
        .table
        .iter()
        .find(|r| r.code == "CmdPrm.Flt[-112]")
        .unwrap();
    assert_eq!((row.type_name, row.touch), ("Double", Some(2)));
    // Compensated: the used points are ball centres, a radius of 2 inside; the originals do not move, nor does the path.
    let compensated = planned(&with(
        &pocket,
        "cycle.compensateDimensions",
        Value::Flag(true),
    ));
    assert_eq!(
        block(&compensated, -100),
        [128.0, 200.0, -7.0, -1.0, 0.0, 0.0]
    );
    assert_eq!(
        block(&compensated, -200),
        [130.0, 200.0, -7.0, -1.0, 0.0, 0.0]
    );
    assert_eq!(at(&compensated, "CmdPrm.Flt[-66]"), 1.0);
    let blocks = |plan: &Plan| {
        plan.program
            .text
            .lines()
            .filter(|l| !l.starts_with("(job "))
            .collect::<Vec<_>>()
            .join("\n")
    };
    assert_eq!(blocks(&compensated), blocks(&plan));
}

/// The page of type 13: -1, -2, -50, -56, -57, -63, -64, -65, -67, then C touches of side 1 and the rest of side 2.
#[test]
fn type_13_has_the_rows_of_its_page() {
    let corner = job(
        r#"{ "format": 1, "cycle": { "type": "double-wall-internal-corner", "origin": [1, 2, 3], "clearance1": 14,
        "clearance2": 16, "count1": 3, "count2": 2, "step1": 21, "step2": 22, "feedDistance": 23, "subCode": -5 } }"#,
    );
    let plan = planned(&corner);
    let mut expected: Vec<String> = [
        "Int[-1]", "Int[-2]", "Flt[-50]", "Flt[-56]", "Flt[-57]", "Int[-63]", "Int[-64]",
        "Flt[-65]", "Flt[-67]",
    ]
    .map(|c| format!("CmdPrm.{c}"))
    .to_vec();
    expected.extend(floats((100..130).map(|c: i32| -c)));
    expected.extend(floats((200..230).map(|c: i32| -c)));
    assert_eq!(codes(&plan), expected);
    // Side 2 starts at −100 − 6C = −118: its foot is clearance 1 = 14 from the corner, its normal is +Y.
    let values = [
        (-118, 15.0),
        (-119, 2.0),
        (-120, 3.0),
        (-121, 0.0),
        (-122, 1.0),
        (-123, 0.0),
        (-112, 1.0),
        (-113, 60.0),
    ];
    for (code, value) in values {
        assert!(
            (at(&plan, &format!("CmdPrm.Flt[{code}]")) - value).abs() < 1e-12,
            "{code}"
        );
    }
    let full = planned(&with(
        &with(&corner, "cycle.count1", number(8.0)),
        "cycle.count2",
        number(8.0),
    ));
    assert_eq!(
        codes(&full)
            .iter()
            .filter(|c| c.starts_with("CmdPrm.Flt[-1"))
            .count(),
        96
    );
    assert!(
        codes(&full).contains(&"CmdPrm.Flt[-195]".to_owned()),
        "touch 16 ends at -195, before the -200 block"
    );
}

/// The start of type 13 at an odd angle, by hand: at 60° with clearances 10 and 12, wall 1 on the Y axis; the start is 10
/// from it, and 12 = −10·cos 60° + y·sin 60°, so y = 17/sin 60° = 19.6299…; the foot on wall 2 is (10 + 6)/sin 60°.
#[test]
fn type_13_starts_where_both_clearances_meet() {
    let corner = job(
        r#"{ "format": 1, "cycle": { "type": "double-wall-internal-corner", "angle": 60, "clearance1": 10, "clearance2": 12 } }"#,
    );
    let plan = planned(&corner);
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-6, "{a} {b}");
    near(plan.moves[1].to[0], 10.0);
    near(plan.moves[1].to[1], 19.629_909_15);
    near(plan.touches[0].point[1], 19.629_909_15);
    // Wall 2 is along (sin 60°, cos 60°): its first touch is 18.475209 along it.
    let foot = 18.475_208_61;
    near(plan.touches[2].point[0], foot * 0.866_025_403_8);
    near(plan.touches[2].point[1], foot * 0.5);
    near(plan.touches[2].vector[0], -0.5);
}

#[test]
fn the_table_as_text_csv_and_json() {
    let pocket = job(
        r#"{ "format": 1, "cycle": { "type": "internal-rectangle-protected", "feedDistance": 50, "depth": 2.5 } }"#,
    );
    let plan = planned(&pocket);
    let text = touchpath::describe::export_table(&plan, "text").unwrap();
    assert!(
        text.starts_with(
            "CmdPrm.Int[-1] = 7\nCmdPrm.Int[-2] = 0\nCmdPrm.Flt[-50] = 50\nCmdPrm.Flt[-51] = 2.5\n"
        ),
        "{text}"
    );
    assert_eq!(text.lines().count(), plan.table.len());
    let csv = touchpath::describe::export_table(&plan, "csv").unwrap();
    assert!(
        csv.starts_with("code,type,value,meaning\nCmdPrm.Int[-1],Integer,7,Probing cycle type")
    );
    assert!(csv.contains("\nCmdPrm.Flt[-53],Double,80,\"Width 1, from touch point 1 to touch point 2, along the first direction of the rectangle\"\n"), "{csv}");
    // Another JSON reader returns the same rows.
    let json: serde_json::Value =
        serde_json::from_str(&touchpath::describe::export_table(&plan, "json").unwrap()).unwrap();
    for (row, read) in plan.table.iter().zip(json.as_array().unwrap()) {
        assert_eq!(read["code"], row.code.as_str());
        assert_eq!(read["value"].as_f64().unwrap(), at(&plan, &row.code));
        assert_eq!(read["touch"].as_u64(), row.touch.map(|k| k as u64));
    }
    assert!(touchpath::describe::export_table(&plan, "xml").is_err());
    let circles = job(
        r#"{ "format": 1, "control": { "post": "heidenhain", "form": "cycle" }, "cycle": { "type": "probing-two-circles", "diameter1": "20H7" } }"#,
    );
    assert!(
        touchpath::describe::export_table(&planned(&circles), "text")
            .unwrap()
            .contains("\nQ1116 = 20H7\n")
    );
}

/// The code is that of the parameter; a text is written as QS with that number, with a decimal point, as in the row.
#[test]
fn a_tolerance_is_one_text_in_table_and_program() {
    let plan = planned(&job(
        r#"{ "format": 1, "control": { "post": "heidenhain", "form": "cycle" }, "cycle": { "type": "probing-two-circles", "diameter1": "20+0,05-0,02" } }"#,
    ));
    let row = plan.table.iter().find(|row| row.code == "Q1116").unwrap();
    assert_eq!(
        row.value,
        touchpath::job::ParameterValue::Text("20+0.05-0.02".to_owned())
    );
    assert_eq!(row.meaning.english(), "DIAMETER 1 (in Klartext QS1116)");
    assert!(
        plan.program
            .text
            .contains("QS1116=\"20+0.05-0.02\" ;DIAMETER 1 ~"),
        "{}",
        plan.program.text
    );
    let number = plan.table.iter().find(|row| row.code == "Q1117").unwrap();
    assert_eq!(number.meaning.english(), "DIAMETER 2");
}
