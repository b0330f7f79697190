//! The parameter table as text.

use crate::form::{Finding, Level};
use crate::job::{JobError, ParameterRow, ParameterValue, Plan};
use crate::num::in_full;
use crate::text::text;

/// The table of a plan as `csv` (with a heading), `json` (a list of rows) or `text` (a line `CmdPrm.Flt[-50] = 50` a row), in
/// the documented order. Any other format is refused.
pub fn export_table(plan: &Plan, format: &str) -> Result<String, JobError> {
    export_table_with_calls(plan, None, format)
}

/// The same with, in `csv` and `json`, the words of native calls that correspond to each row, as in [`calls`](crate::job::calls).
pub fn export_table_with_calls(
    plan: &Plan,
    calls: Option<&[Vec<String>]>,
    format: &str,
) -> Result<String, JobError> {
    let call = |index: usize| {
        calls.map(|calls| {
            calls
                .get(index)
                .map_or_else(String::new, |words| words.join(", "))
        })
    };
    match format {
        "csv" => {
            // In a set-up each row has its cycle.
            let several = !plan.cycles.is_empty();
            let (call_heading, cycle_heading) = (
                if calls.is_some() { ",call" } else { "" },
                if several { ",cycle" } else { "" },
            );
            let mut text = format!("code,type,value,meaning{call_heading}{cycle_heading}\n");
            for (index, row) in plan.table.iter().enumerate() {
                let cells = [
                    row.code.as_str(),
                    row.type_name,
                    &value(row),
                    &row.meaning.english(),
                ]
                .map(cell);
                text.push_str(&cells.join(","));
                if let Some(call) = call(index) {
                    text.push(',');
                    text.push_str(&cell(&call));
                }
                if several {
                    text.push(',');
                    text.push_str(&plan.cycles[row.cycle]);
                }
                text.push('\n');
            }
            Ok(text)
        }
        "text" => Ok(plan
            .table
            .iter()
            .map(|row| format!("{} = {}\n", row.code, value(row)))
            .collect()),
        "json" => {
            let rows: Vec<String> = plan
                .table
                .iter()
                .enumerate()
                .map(|(index, row)| json_row(row, call(index)))
                .collect();
            Ok(format!("[\n  {}\n]\n", rows.join(",\n  ")))
        }
        _ => {
            let message = text!("A table is exported as \"csv\", \"json\" or \"text\"");
            Err(JobError {
                findings: vec![Finding::new(
                    Level::Error,
                    "unknown-value",
                    "format",
                    message,
                )],
            })
        }
    }
}

/// A value as in a dump: numbers plainly and in full, text unchanged.
fn value(row: &ParameterRow) -> String {
    match &row.value {
        ParameterValue::Whole(n) => n.to_string(),
        ParameterValue::Flag(on) => on.to_string(),
        ParameterValue::Number(x) => in_full(*x),
        ParameterValue::Text(text) => text.clone(),
    }
}

/// A CSV cell, quoted if necessary (RFC 4180).
fn cell(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

fn json_row(row: &ParameterRow, call: Option<String>) -> String {
    let number = match &row.value {
        ParameterValue::Text(text) => quoted(text),
        ParameterValue::Whole(_) | ParameterValue::Flag(_) | ParameterValue::Number(_) => {
            value(row)
        }
    };
    let field = row.field.as_deref().map_or("null".to_owned(), quoted);
    let touch = row.touch.map_or("null".to_owned(), |k| k.to_string());
    let call = call.map_or_else(String::new, |call| format!(", \"call\": {}", quoted(&call)));
    format!(
        "{{ \"code\": {}, \"type\": {}, \"value\": {number}, \"meaning\": {}, \"field\": {field}, \"cycle\": {}, \"touch\": {touch}{call} }}",
        quoted(&row.code),
        quoted(row.type_name),
        quoted(&row.meaning.english()),
        row.cycle
    )
}

/// A JSON string. Codes, meanings and checked values are printable; characters that JSON requires to be escaped are escaped nevertheless.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() => out.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
