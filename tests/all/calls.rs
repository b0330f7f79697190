//! Words of native cycles for the rows of the parameter table.

use crate::common::{number, with};
use touchpath::describe::{export_table, export_table_with_calls};
use touchpath::form::Value;
use touchpath::job::{calls, default_job, plan};

fn job(cycle: &str, post: &str, offset: Value) -> Value {
    let job = with(
        &default_job(cycle).unwrap(),
        "control.post",
        Value::Text(post.to_owned()),
    );
    with(
        &with(&job, "control.form", Value::Text("cycle".to_owned())),
        "control.workOffset",
        offset,
    )
}

/// Words by the code of their row, from the descriptions of the macros and cycles.
#[test]
fn each_code_goes_to_the_word_that_means_the_same() {
    let words = |cycle: &str, post: &str, offset: Value| -> Vec<(String, String)> {
        let job = job(cycle, post, offset);
        let (rows, calls) = (plan(&job).unwrap().table, calls(&job).unwrap());
        assert_eq!(rows.len(), calls.len());
        let rows = rows
            .iter()
            .zip(calls)
            .filter(|(_, words)| !words.is_empty());
        rows.map(|(row, words)| (row.code.replace("CmdPrm.", ""), words.join(" ")))
            .collect()
    };
    let pairs = |list: &[(&str, &str)]| {
        list.iter()
            .map(|(a, b)| ((*a).to_owned(), (*b).to_owned()))
            .collect::<Vec<_>>()
    };
    // -50 feed distance, -51 depth, -52 diameter, -55 top clearance, -56 side clearance.
    assert_eq!(
        words("hole-protected", "fanuc", Value::Null),
        pairs(&[
            ("Flt[-50]", "P9810 Z"),
            ("Flt[-51]", "P9814 Z"),
            ("Flt[-52]", "P9814 D"),
            ("Flt[-55]", "P9810 Z"),
            ("Flt[-56]", "P9814 R")
        ])
    );
    // -53 and -54 the widths; one set-up clearance for both sides.
    assert_eq!(
        words("internal-rectangle-protected", "heidenhain", number(1.0)),
        pairs(&[
            ("Flt[-51]", "410 Q261"),
            ("Flt[-53]", "410 Q323"),
            ("Flt[-54]", "410 Q324"),
            ("Flt[-55]", "410 Q260"),
            ("Flt[-56]", "410 Q320"),
            ("Flt[-57]", "410 Q320")
        ])
    );
    // The steps of a corner are I and J, and the walls are the positions of its touches: side 1 across X.
    let corner = words("double-wall-external-corner", "okuma", Value::Null);
    for pair in pairs(&[
        ("Flt[-65]", "O9816 PJ"),
        ("Flt[-67]", "O9816 PI"),
        ("Flt[-100]", "O9816 PX"),
        ("Flt[-113]", "O9816 PY"),
    ]) {
        assert!(corner.contains(&pair), "{pair:?} in {corner:?}");
    }
    assert!(
        words("surface", "brother", Value::Null)
            .contains(&("Flt[-102]".to_owned(), "P8811 Z".to_owned()))
    );
    let web = words("web", "sinumerik", Value::Null);
    for pair in pairs(&[("Flt[-51]", "CYCLE977 11"), ("Flt[-53]", "CYCLE977 5")]) {
        assert!(web.contains(&pair), "{pair:?} in {web:?}");
    }
    let circles = words("probing-two-circles", "haas", Value::Null);
    assert!(
        circles.contains(&("Q1116".to_owned(), "P9814 D".to_owned()))
            && circles
                .iter()
                .any(|(q, word)| q == "Q1103" && word.contains("P9834 X")),
        "{circles:?}"
    );
}

/// The column exists only where cycles are called; a dump with it can still be read.
#[test]
fn an_exported_table_has_the_column() {
    let own = job("hole-protected", "fanuc", Value::Null);
    let planned = plan(&own).unwrap();
    let export =
        |format: &str| export_table_with_calls(&planned, calls(&own).as_deref(), format).unwrap();
    let csv = export("csv");
    assert!(csv.starts_with("code,type,value,meaning,call\n"), "{csv}");
    assert!(
        csv.contains("CmdPrm.Flt[-52],Double,40,\"Diameter, diameter of the feature\",P9814 D\n"),
        "{csv}"
    );
    assert!(export("json").contains("\"touch\": null, \"call\": \"P9814 D\" }"));
    assert_eq!(export("text"), export_table(&planned, "text").unwrap());
    for format in ["csv", "json"] {
        let back = crate::common::import(&export(format)).unwrap();
        assert_eq!(
            crate::common::number_at(&back.job, "cycle.diameter", 0.0),
            40.0,
            "{format}"
        );
    }
    assert!(
        calls(&default_job("hole").unwrap()).is_none(),
        "a program of moves calls nothing"
    );
    assert!(
        calls(&with(&own, "overtravel", number(1.0))).is_none(),
        "nor does one that is refused"
    );
}
