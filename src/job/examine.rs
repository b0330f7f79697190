//! Checks a text against a job: safety rules, and proof that it is the job's program.

use crate::control::prove::{self, Fault, Followed, Part};
use crate::control::safety::{self, RestartPoints};
use crate::control::{Request, shop};
use crate::form::{Checker, Value};
use crate::job::SafetyRow;
use crate::job::defaults::resolved;
use crate::job::plan::{plan_with_path, read, request};
#[cfg(test)]
use crate::job::planned::PlannedJob;

/// Calls `ask` with the request for a job's program; `None` if the job has errors.
fn with_request<T>(value: &Value, header: bool, ask: impl FnOnce(&Request<'_>) -> T) -> Option<T> {
    let planned = read(&mut Checker::default(), value)?;
    let feeds = planned.path.feeds.unwrap_or(planned.job.feeds);
    let whole = if header { resolved(value) } else { None };
    Some(ask(&request(&planned, &feeds, whole.as_ref())))
}

/// Safety rules for a text that is meant to be the program of this job; `None` if the job has errors, or its control's programs are not read. Faults are lines
/// that are not understood, or are invalid at their position.
pub fn check_program(value: &Value, text: &str) -> Option<Result<Vec<SafetyRow>, Vec<Fault>>> {
    with_request(value, false, |request| {
        // Other programs are compared block by block.
        if !request.is_followed() {
            return None;
        }
        let rules = |followed: Followed<'_>| {
            safety::check(request, &followed, RestartPoints::Every)
                .into_iter()
                .map(SafetyRow::of)
                .collect()
        };
        let text = shop::without_lines(request, text);
        Some(prove::read_and_trace(request, &text, Part::Unknown).map(rules))
    })?
}

/// The program of a planned job, read back and checked.
#[cfg(test)]
pub fn released(planned: &PlannedJob) -> Result<String, crate::control::release::Refusal> {
    let feeds = planned.path.feeds.unwrap_or(planned.job.feeds);
    let request = request(planned, &feeds, None);
    let released = crate::control::release::release(&request, (request.post.emit)(&request))?;
    Ok(released.into_parts().0.text)
}

/// Whether a text is proven to be the program of a job, with its moves in these 0-based lines. False for a job with errors.
#[cfg(test)]
pub fn proves(value: &Value, text: &str, lines: &[i32]) -> bool {
    let lines: Vec<Option<usize>> = lines
        .iter()
        .map(|line| usize::try_from(*line).ok())
        .collect();
    let proven = with_request(value, false, |request| {
        let text = shop::without_lines(request, text);
        prove::read_and_trace(request, &text, Part::Path)
            .and_then(|followed| prove::prove(request, &followed, &lines))
    });
    proven.is_some_and(|proof| proof.is_ok())
}

/// Whether a control's reader reads a text the same with and without cached lines, for the fuzzer: the same program or the same faults. `None` if it reads no
/// program.
#[doc(hidden)]
pub fn reads_same_with_cache(post: &str, text: &str) -> Option<bool> {
    let read = crate::control::POSTS
        .iter()
        .find(|known| known.key == post)?
        .read?;
    let anew = crate::control::iso::line_cache::without_cache(|| read(text));
    Some(read(text) == anew)
}

/// Times of printing, reading back, proof, rules and a plan without its table, for the benchmark: each with its prerequisites, `rounds` times. The proof
/// includes reading.
#[doc(hidden)]
pub fn stages(value: &Value, rounds: u32, mut timed: impl FnMut(&'static str, &mut dyn FnMut())) {
    use std::hint::black_box;
    with_request(value, true, |request| {
        let Some(read) = request.post.read else {
            return;
        };
        let program = (request.post.emit)(request);
        let prove = || {
            let followed = prove::read_and_trace(request, &program.text, Part::Path)?;
            prove::prove(request, &followed, &program.move_lines).map(|_| followed)
        };
        // In this order nothing is cached too early.
        timed("print", &mut || {
            (0..rounds).for_each(|_| drop(black_box((request.post.emit)(request))))
        });
        timed("read", &mut || {
            (0..rounds).for_each(|_| drop(black_box(read(black_box(&program.text)))))
        });
        timed("prove", &mut || {
            (0..rounds).for_each(|_| drop(black_box(prove())))
        });
        let Ok(followed) = prove() else { return };
        timed("rules", &mut || {
            (0..rounds).for_each(|_| {
                drop(black_box(safety::check(
                    request,
                    &followed,
                    RestartPoints::Critical,
                )))
            })
        });
        timed("plan", &mut || {
            (0..rounds).for_each(|_| drop(black_box(plan_with_path(black_box(value)))))
        });
    });
}
