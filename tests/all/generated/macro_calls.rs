//! From the parameter table to the calls of each control: a page of the manual for authors of postprocessors, made from the output of the writers.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::common::with;
use touchpath::cycle::{CYCLES, CycleDef};
use touchpath::form::Value;
use touchpath::job::{ParameterRow, calls, default_job, plan};

/// Heading, control, work offset.
const COLUMNS: [(&str, &str, Option<f64>); 4] = [
    ("Renishaw's macros", "fanuc", None),
    ("HEIDENHAIN, measures", "heidenhain", None),
    ("HEIDENHAIN, writes a preset", "heidenhain", Some(1.0)),
    ("SINUMERIK", "sinumerik", None),
];

fn job(def: &CycleDef, post: &str, offset: Option<f64>) -> Value {
    let job = with(
        &default_job(def.key).unwrap(),
        "control.post",
        Value::Text(post.to_owned()),
    );
    let job = with(&job, "control.form", Value::Text("cycle".to_owned()));
    with(
        &job,
        "control.workOffset",
        offset.map_or(Value::Null, Value::Number),
    )
}

/// Meaning of a row: for a touch with its axis, otherwise its first words.
fn meaning(row: &ParameterRow) -> String {
    let whole = row.meaning.english();
    if row.touch.is_some() {
        whole
    } else {
        whole.split(", ").next().unwrap_or_default().to_owned()
    }
}

/// Calls of a program in order, without the letters.
fn order(text: &str) -> String {
    let words = text.lines().filter_map(|line| {
        let call = line
            .split_once("TCH PROBE ")
            .or_else(|| line.split_once("G65 "))
            .map(|(_, rest)| rest);
        let name = call.map(|rest| rest.split(' ').next().unwrap().to_owned());
        name.or_else(|| {
            line.strip_prefix("CYCLE")
                .map(|rest| format!("CYCLE{}", rest.split('(').next().unwrap()))
        })
    });
    let measuring: Vec<String> = words
        .filter(|word| !["P9810", "P9832", "P9833"].contains(&word.as_str()))
        .collect();
    measuring
        .iter()
        .map(|word| format!("`{word}`"))
        .collect::<Vec<_>>()
        .join(" · ")
}

/// `docs/table-to-calls.md`.
pub fn page() -> String {
    let mut text = "# From the parameter table to macro calls\n\n<!-- generated: UPDATE=1 cargo test --lib generated -->\n\nFor authors of postprocessors: which word of \
        which call takes which code of the CAM table, as Touchpath's own programs have it. The same for one job: `exportTable(job, \"csv\")` or `\"json\"` of a job in the form \
        `cycle` has the column `call`, and `touchpath table job.json --format csv` prints it.\n\n\
        - `CmdPrm.Int[-1]` is the type of the cycle. `CmdPrm.Int[-2]` is the *SubCode*, a free number that the user types in the CAM system: switch on the type, and leave the \
          SubCode to its user. The post that ENCY publishes as an example switches on the SubCode (10 hole, 11 boss, 12 hole protected, 13 surface, 14 web, 15 groove, 16 groove protected, 17 and 18 corners) [S].\n\
        - The macros' names are those of a Fanuc, a Haas, a Mazak and a Hurco; on a Brother P98xx is `P88xx`, on an Okuma `G65 P9814 D40.` is `CALL O9814 PD=40.`.\n\
        - A word may need more than its code: heights are the ball's centre, and the macros' `Z` is the stylus tip, one radius lower; `Q` is the overtravel and `R` the side clearance, each less the ball's radius; a \
          width is not the place of a touch. [The programs](programs.md) says each.\n\
        - Four slips of that example post, not to be copied [S]: `P9812` gets the place of a touch where the macro wants the width; `Z` gets the depth as a positive number; the negative `R` is \
          printed as `-R5.`; `I` and `J` of the corners get the clearances (-56, -57) and not the steps (-65, -67).\n\
        - Feeds of the job go to the ways between (`P9810 F`, `G1`); the cycles have feeds of their own.\n"
        .to_owned();
    for def in CYCLES {
        let mut rows: BTreeMap<usize, (String, String, [String; 4])> = BTreeMap::new();
        let mut orders: [String; 4] = Default::default();
        for (column, (_, post, offset)) in COLUMNS.into_iter().enumerate() {
            let job = job(def, post, offset);
            let Ok(planned) = plan(&job) else { continue };
            let Some(calls) = calls(&job) else { continue };
            orders[column] = order(&planned.program.text);
            for (index, (row, words)) in planned
                .table
                .iter()
                .zip(calls)
                .enumerate()
                .filter(|(_, (_, words))| !words.is_empty())
            {
                let entry = rows
                    .entry(index)
                    .or_insert_with(|| (row.code.clone(), meaning(row), Default::default()));
                entry.2[column] = words
                    .iter()
                    .map(|word| format!("`{word}`"))
                    .collect::<Vec<_>>()
                    .join(", ");
            }
        }
        if rows.is_empty() {
            continue;
        }
        let kept: Vec<usize> = (0..4)
            .filter(|column| !orders[*column].is_empty())
            .collect();
        let heads: Vec<&str> = kept.iter().map(|column| COLUMNS[*column].0).collect();
        write!(
            text,
            "\n## {} ({})\n\n| code | meaning | {} |\n|---|---|{}\n",
            def.title,
            def.source,
            heads.join(" | "),
            "---|".repeat(kept.len())
        )
        .unwrap();
        let of: Vec<&str> = kept.iter().map(|column| orders[*column].as_str()).collect();
        writeln!(text, "| | *calls* | {} |", of.join(" | ")).unwrap();
        for (code, meaning, cells) in rows.values() {
            let cells: Vec<&str> = kept.iter().map(|column| cells[*column].as_str()).collect();
            writeln!(text, "| `{code}` | {meaning} | {} |", cells.join(" | ")).unwrap();
        }
    }
    text
}
