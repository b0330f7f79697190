//! Programs that are run with what is known beside their text.

use super::*;
use touchpath::import::toolpath::{Known, Trip, run_program};

fn met(at: f64) -> Known<'static> {
    Known { touch: Trip::At(at), positioning: Trip::Never, ..Known::default() }
}

/// Every program that is made here runs to its end where touches are made and nothing else is met: each move of the plan once, in its line, where the plan has it.
#[test]
fn every_program_that_is_made_here_runs_as_its_plan() {
    let mut seen = 0;
    for (name, job) in jobs() {
        let plan = planned(&job);
        if plan.program.post == "heidenhain" || plan.program.proof.is_none() {
            continue;
        }
        let run = run_program(&plan.program.text, &met(0.9));
        // The way to the first place is a subroutine's, in its own lines.
        let called = |line: i32| plan.program.text.lines().nth(line as usize).is_some_and(|text| text.contains("call"));
        let mut next = 0;
        for (step, line) in plan.moves.iter().zip(&plan.program.move_lines).filter(|(_, line)| !called(**line)) {
            let what = || format!("{name} for {}, line {}: {step:?}\n{:?}", plan.program.post, line + 1, run.findings);
            let own = (next..run.len()).find(|i| run.line[*i] as i32 == *line).unwrap_or_else(|| panic!("{}", what()));
            let end = places(&run)[own];
            let touch = step.kind == "touch";
            assert!(!touch || kinds(&run)[own] == "probe", "{}", what());
            // A touch runs on behind its contact.
            let off = (0..3).map(|axis| (end[axis] - step.to[axis]).powi(2)).sum::<f64>().sqrt();
            assert!(if touch { off > 0.0 && off < 100.0 } else { off < 1e-4 || step.arc.is_some() }, "{end:?} {}", what());
            next = own + 1;
            seen += 1;
        }
    }
    assert!(seen > 1000, "{seen}");
}
