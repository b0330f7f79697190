//! The set-ups of the package's examples: planned, run by LinuxCNC's interpreter, their results by hand.

use super::probing_again_reads_nominal;
use crate::common::{job, planned, with};
use touchpath::form::Value;

const VISE: &str = include_str!("../../../examples/set-ups/vise.json");
const TWO_HOLES: &str = include_str!("../../../examples/set-ups/two-holes.json");
const FIRST_ARTICLE: &str = include_str!("../../../examples/set-ups/first-article.json");

#[test]
fn what_the_vise_and_the_two_holes_write_puts_the_part_where_the_drawing_says() {
    for (text, cycles) in [
        (VISE, ["TOP", "BORE", "SIDE"]),
        (TWO_HOLES, ["PLATE", "LEFT", "BOTH"]),
    ] {
        let plan = planned(&job(text));
        assert_eq!(plan.cycles, cycles);
        assert_eq!(plan.program.writes, ["X", "Y", "Z", "rotation"]);
        let on_linuxcnc = with(
            &job(text),
            "control.post",
            Value::Text("linuxcnc".to_owned()),
        );
        probing_again_reads_nominal(&on_linuxcnc, cycles[0]);
    }
}

/// By hand: each size is its nominal one and what `part.sizes` adds.
#[test]
fn the_first_article_has_five_sizes() {
    let plan = planned(&job(FIRST_ARTICLE));
    let sizes: Vec<_> = plan
        .results
        .iter()
        .filter(|row| row.code == "diameter" || row.code.starts_with("width"))
        .map(|row| {
            (
                plan.cycles[row.cycle].as_str(),
                row.code.as_str(),
                row.value.map(|v| (v * 1000.0).round() / 1000.0),
            )
        })
        .collect();
    let wanted = [
        ("BORE", "diameter", Some(25.02)),
        ("STUD", "diameter", Some(19.99)),
        ("POCKET", "width1", Some(60.03)),
        ("POCKET", "width2", Some(40.0)),
        ("RIB", "width", Some(16.01)),
    ];
    assert_eq!(sizes, wanted);
    // ISO 286-2: 25H7 ends at 25.021, so that 25.02 is within one micrometre of it, and the uncertainty is two; 20h6 begins at 19.987.
    let names: Vec<&String> = plan.cycles.iter().chain(&plan.relations).collect();
    let judged = plan
        .results
        .iter()
        .filter_map(|row| Some(format!("{} {}", names[row.cycle], row.verdict.clone()?)));
    assert_eq!(
        judged.collect::<Vec<_>>(),
        [
            "BORE good within ±",
            "STUD good",
            "POCKET good",
            "POCKET good",
            "RIB good",
            "PITCH good"
        ]
    );
    assert!(plan.program.writes.is_empty());
    assert!(
        plan.moves
            .iter()
            .any(|step| step.step == 0 && step.to[2] == 40.0),
        "across at the height of the job"
    );
}
