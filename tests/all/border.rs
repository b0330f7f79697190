//! Data passed to JavaScript: its layout by hand, and arbitrary codes, which must not break it.

use proptest::prelude::*;

use crate::common::planned;
use touchpath::border::coded::{DEEPEST, decoded};
use touchpath::border::packed::{self, Section};
use touchpath::form::Value;
use touchpath::job::default_job;

/// `{ "a": [1, true, null, "é"] }`, coded by hand: a map of one entry whose key has one unit, a list of four.
#[test]
fn a_value_is_read_as_it_was_coded() {
    let codes = [6.0, 1.0, 1.0, 5.0, 4.0, 3.0, 1.0, 2.0, 0.0, 4.0, 1.0];
    let items = vec![
        Value::Number(1.0),
        Value::Flag(true),
        Value::Null,
        Value::Text("é".to_owned()),
    ];
    assert_eq!(
        decoded(&codes, "a\né\n"),
        Value::Map(vec![("a".to_owned(), Value::List(items))])
    );
    // A character outside the basic plane has two units.
    assert_eq!(
        decoded(&[4.0, 2.0], "\u{1f600}\n"),
        Value::Text("\u{1f600}".to_owned())
    );
}

#[test]
fn lists_in_lists_end_at_the_depth_that_javascript_stops_at() {
    let nested = |depth: usize| {
        let mut codes: Vec<f64> = [5.0, 1.0].repeat(depth);
        codes.push(0.0);
        decoded(&codes, "")
    };
    assert!(matches!(nested(DEEPEST), Value::List(_)));
    assert!(matches!(nested(DEEPEST + 1), Value::Other(_)));
}

proptest! {
    #[test]
    fn no_codes_break_the_reader(codes in prop::collection::vec(prop_oneof![(0u8..9).prop_map(f64::from), any::<f64>()], 0..60), text in ".{0,20}") {
        let _ = decoded(&codes, &text);
    }
}

/// Each section starts where the head states, with the number of its rows; the last one ends with the numbers.
#[test]
fn the_sections_of_a_plan_are_where_its_head_says() {
    let plan = planned(&default_job("internal-rectangle-protected").unwrap());
    let packed = packed::plan(&plan);
    let at = |section: Section| packed.numbers[2 * section as usize] as usize;
    let head = 2 * Section::ALL.len();
    assert_eq!(&packed.numbers[head..head + 2], [plan.length, plan.time]);
    for (section, rows) in [
        (Section::Touches, plan.touches.len()),
        (Section::Moves, plan.moves.len()),
        (Section::Results, plan.results.len()),
        (Section::Triggers, plan.triggers.len()),
        (Section::Findings, plan.findings.len()),
        (Section::Safety, plan.safety.len()),
    ] {
        assert_eq!(packed.numbers[at(section)], rows as f64, "{section:?}");
    }
    // Four touches of eight numbers; then the moves.
    assert_eq!(at(Section::Moves), at(Section::Touches) + 1 + 8 * 4);
    assert_eq!(
        packed.numbers[at(Section::Touches) + 1..][..3],
        plan.touches[0].point
    );
    // Four triggers of three numbers; then the findings.
    assert_eq!(at(Section::Findings), at(Section::Triggers) + 1 + 3 * 4);
    let texts = packed.numbers[2 * Section::Program as usize + 1] as usize;
    assert!(
        packed.text[texts..].starts_with("linuxcncngc"),
        "{}",
        &packed.text[texts..][..20]
    );
    let rows = packed::table(&plan.table);
    assert_eq!(
        (rows.numbers[0], packed::meanings(&plan.table).numbers[0]),
        (plan.table.len() as f64, plan.table.len() as f64)
    );
    assert!(
        rows.text.starts_with("CmdPrm.Int[-1]"),
        "{}",
        &rows.text[..20]
    );
}
