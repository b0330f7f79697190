//! Mutated texts for every reader: none may cause a panic, a hang, or a job that breaks a law.

use std::path::Path;
use std::sync::LazyLock;

use crate::common::owed::macro_call;
use crate::common::{import, with_comments};
use touchpath::describe::{PostEntry, catalog, export_table};
use touchpath::form::Value;
use touchpath::import::read_program;
use touchpath::job::{Plan, evaluate, plan, reads_same_with_cache};

use crate::draw::Draw;

/// The programs of `tests/programs`, in alphabetical order.
static PROGRAMS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/programs");
    let entries = std::fs::read_dir(folder).expect("tests/programs");
    let mut paths: Vec<_> = entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_file())
        .collect();
    paths.sort();
    paths
        .iter()
        .map(|path| std::fs::read_to_string(path).expect("a program"))
        .collect()
});

/// A text with parts changed, removed, repeated, or moved.
fn mutate(draw: &mut Draw, text: &str) -> String {
    const INSERTS: [&str; 14] = [
        "-",
        "9",
        ",",
        ".",
        "=",
        "\n",
        "\"",
        "[",
        "]",
        "e9",
        "inf",
        "; job cycle.touches[3].point=[1,2,3]\n",
        "\u{2212}",
        "PREDEF",
    ];
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..1 + draw.index(4) {
        if bytes.is_empty() {
            break;
        }
        let at = draw.index(bytes.len());
        let end = (at + 1 + draw.index(12)).min(bytes.len());
        match draw.index(6) {
            0 => drop(bytes.drain(at..end)),
            1 => bytes[at] = b"0123456789-.XYZ;=[]"[draw.index(19)],
            2 => drop(bytes.splice(at..at, draw.of(&INSERTS).bytes())),
            3 => {
                let again = bytes[at..end].to_vec();
                drop(bytes.splice(at..at, again));
            }
            4 => bytes.truncate(at),
            _ => {
                let other = draw.index(bytes.len());
                bytes.swap(at, other);
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The cached lines of a strict reader change no result: neither for a generated program nor for a mutated one. One reader in four is that of another control.
pub fn remembered(made: &Plan, draw: &mut Draw) -> Result<(), String> {
    static READERS: LazyLock<Vec<&str>> = LazyLock::new(|| {
        let takes_moves = |post: &&PostEntry| {
            post.cycles
                .iter()
                .any(|cycle| cycle.form == "moves" && cycle.supported)
        };
        catalog()
            .posts
            .iter()
            .filter(takes_moves)
            .map(|post| post.id)
            .collect()
    });
    let text = &made.program.text;
    for text in [text, &mutate(draw, text), &mutate(draw, text)] {
        let post = if draw.once_in(4) {
            *draw.of(&READERS)
        } else {
            made.program.post
        };
        if reads_same_with_cache(post, text) == Some(false) {
            return Err(format!(
                "the reader of {post} remembers another program than\n{text}"
            ));
        }
    }
    Ok(())
}

/// A mutated program, generated or foreign, or a mutated dump makes a job that is refused, or one whose touches are all in its path.
pub fn mutated(made: &Plan, draw: &mut Draw) -> Result<(), String> {
    let source = match draw.index(3) {
        0 => export_table(made, draw.word(&["text", "csv", "json"])).map_err(|e| e.to_string())?,
        _ if draw.once_in(4) => draw.of(&PROGRAMS).clone(),
        _ => made.program.text.clone(),
    };
    for _ in 0..3 {
        let text = mutate(draw, &source);
        let path = read_program(&text, None);
        if path.to.len() != 3 * path.len()
            || path.to.iter().any(|x| x.is_infinite())
            || path.line.iter().any(|line| *line as usize > text.len())
        {
            return Err(format!(
                "the columns of this program do not fit together:\n{text}"
            ));
        }
        if format!("{path:?}")
            != format!(
                "{:?}",
                read_program(&with_comments(&text), Some(path.dialect))
            )
        {
            return Err(format!(
                "with comments behind its blocks this program is another one:\n{text}"
            ));
        }
        let Ok(imported) = import(&text) else {
            continue;
        };
        let Ok(plan) = plan(&imported.job) else {
            continue;
        };
        let touched = plan.moves.iter().filter(|m| m.kind == "touch").count();
        // Renishaw's macros touch twice.
        let macros = plan.program.own
            && plan
                .program
                .text
                .lines()
                .any(|line| macro_call(line).is_some());
        let times = if macros { 2 } else { 1 };
        if touched != times * plan.touches.len() {
            return Err(format!(
                "{touched} of {} touches are in the path of\n{text}",
                plan.touches.len()
            ));
        }
    }
    Ok(())
}

/// The shortest distance between two points.
fn nearest(points: &[[f64; 3]]) -> f64 {
    let pairs = points.iter().enumerate().flat_map(|(i, a)| {
        points[..i]
            .iter()
            .map(move |b| crate::common::owed::distance(*a, *b))
    });
    pairs.fold(f64::INFINITY, f64::min)
}

/// Predicted triggers, as text in every format, evaluate to the predicted results; mutated, they are refused or evaluated.
pub fn measured(job: &Value, plan: &Plan, draw: &mut Draw) -> Result<(), String> {
    // A touch that contacts another wall or an edge may make two walls parallel: their corner is then noise.
    if plan
        .findings
        .iter()
        .any(|f| matches!(f.code.as_str(), "wrong-wall" | "edge-contact"))
    {
        return Ok(());
    }
    let Some(triggers) = plan.triggers.iter().copied().collect::<Option<Vec<_>>>() else {
        return Ok(());
    };
    // A cycle that touches the last wall at the start of a touch stops with an alarm: triggers, but no results.
    if plan
        .findings
        .iter()
        .any(|f| f.code == "collision" && f.path.starts_with("part"))
    {
        return match plan.results.iter().find(|row| row.value.is_some()) {
            None => Ok(()),
            Some(row) => Err(format!(
                "{} is {:?} of a run that ended in the part",
                row.code, row.value
            )),
        };
    }
    let separator = *draw.of(&[", ", ";", "\t", " "]);
    let lines: Vec<String> = triggers
        .iter()
        .map(|p| p.map(|x| format!("{x}")).join(separator))
        .collect();
    let text = lines.join("\n");
    // A part far off can trigger during the approach: such points are refused.
    if let Ok(rows) = evaluate(job, &Value::Text(text.clone())) {
        // The direction of a wall through touches a thousandth apart depends on the last decimals of the triggers.
        let noise = 1e-9 / nearest(&triggers).max(1e-9);
        let far = triggers
            .iter()
            .flatten()
            .fold(0.0, |far: f64, x| far.max(x.abs()));
        // A verdict may change if the last decimals of the triggers move a value over its limit.
        let judged = plan
            .results
            .iter()
            .zip(&rows)
            .filter(|(shown, _)| shown.verdict.is_some() && !shown.unit.is_empty());
        let moved = judged
            .filter_map(|(a, b)| Some((a.value? - b.value?).abs()))
            .fold(0.0, f64::max);
        for (shown, read) in plan.results.iter().zip(&rows) {
            let same = match (shown.value, read.value) {
                _ if shown.unit.is_empty() && moved > 2e-8 => {
                    shown.value.is_some() == read.value.is_some()
                }
                // The root of a cancelled difference of sums of squares. A difference or a mean may depend on such a value.
                (Some(a), Some(b))
                    if ["residual", "difference", "mean"]
                        .iter()
                        .any(|code| shown.code.starts_with(code)) =>
                {
                    (a - b).abs() <= 1e-6 + noise + 1e-6 * far
                }
                (Some(a), Some(b)) => (a - b).abs() <= 1e-6 * (1.0 + a.abs()) + noise,
                (a, b) => a.is_some() == b.is_some(),
            };
            if shown.code != read.code || !same {
                return Err(format!(
                    "{} is {:?}, from its triggers {:?}",
                    shown.code, shown.value, read.value
                ));
            }
        }
    }
    let reports: Vec<String> = triggers
        .iter()
        .map(|p| {
            format!(
                ">>> G38.2 X0 F9\n[PRB:{}:1]\nok",
                p.map(|x| format!("{x:.3}")).join(",")
            )
        })
        .collect();
    let log = format!(
        "G54\n$13=0\n<Idle|MPos:0.000,0.000,0.000|WCO:0.000,0.000,0.000>\n{}\n>>> M2\n",
        reports.join("\n")
    );
    let printed: String = plan
        .results
        .iter()
        .map(|row| format!("{}={:.4}\n", row.code, row.value.unwrap_or_default()))
        .collect();
    for text in [text, log, printed] {
        for _ in 0..3 {
            let _ = evaluate(job, &Value::Text(mutate(draw, &text)));
        }
    }
    Ok(())
}
