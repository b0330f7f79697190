//! A text held against a job: what the rules say of it, and whether it is proven to be the job's program.

use crate::control::Request;
use crate::control::prove::{self, Fault, Followed, Part};
use crate::control::safety::{self, Restarts};
use crate::form::{Checker, Value};
use crate::job::SafetyRow;
use crate::job::defaults::resolved;
use crate::job::plan::{plan_with_path, read, request};
#[cfg(test)]
use crate::job::planned::Planned;

/// Asks something about the program that a job is to have; `None` if the job has errors.
fn about<T>(value: &Value, header: bool, ask: impl FnOnce(&Request<'_>) -> T) -> Option<T> {
    let planned = read(&mut Checker::default(), value)?;
    let feeds = planned.path.feeds.unwrap_or(planned.job.feeds);
    let whole = if header { resolved(value) } else { None };
    Some(ask(&request(&planned, &feeds, whole.as_ref())))
}

/// What the safety rules say of a text that is to be the program of this job; `None` if the job has errors, or its control's programs are
/// not read. Faults are lines that are not understood, or do not work at their place.
pub fn examine(value: &Value, text: &str) -> Option<Result<Vec<SafetyRow>, Vec<Fault>>> {
    about(value, false, |request| {
        // Others are compared block by block.
        if !request.is_followed() {
            return None;
        }
        let rules = |followed: Followed<'_>| {
            safety::check(request, &followed, Restarts::Every)
                .into_iter()
                .map(SafetyRow::of)
                .collect()
        };
        Some(prove::follow(request, text, Part::Unknown).map(rules))
    })?
}

/// The program of a planned job, read back and judged.
#[cfg(test)]
pub fn released(planned: &Planned) -> Result<String, crate::control::release::Refusal> {
    let feeds = planned.path.feeds.unwrap_or(planned.job.feeds);
    let request = request(planned, &feeds, None);
    let released = crate::control::release::release(&request, (request.post.emit)(&request))?;
    Ok(released.into_parts().0.text)
}

/// Whether a text is proven to be the program of a job, its moves in these 0-based lines. None of a job with errors is.
#[cfg(test)]
pub fn proves(value: &Value, text: &str, lines: &[i32]) -> bool {
    let lines: Vec<Option<usize>> = lines
        .iter()
        .map(|line| usize::try_from(*line).ok())
        .collect();
    let proven = about(value, false, |request| {
        prove::follow(request, text, Part::Path)
            .and_then(|followed| prove::prove(request, &followed, &lines))
    });
    proven.is_some_and(|proof| proof.is_ok())
}

/// Whether the reader of a control makes the same of a text with the lines that it remembers from earlier ones and without, for the fuzzer: the same
/// program or the same troubles. `None` if it reads no program.
#[doc(hidden)]
pub fn reads_alike(post: &str, text: &str) -> Option<bool> {
    let read = crate::control::POSTS
        .iter()
        .find(|known| known.key == post)?
        .read?;
    let anew = crate::control::iso::memory::without(|| read(text));
    Some(read(text) == anew)
}

/// How long printing, reading back, proof, rules and a plan without its table take, for the bench: each with what it needs done before, `rounds` times.
/// The proof reads, too.
#[doc(hidden)]
pub fn stages(value: &Value, rounds: u32, mut timed: impl FnMut(&'static str, &mut dyn FnMut())) {
    use std::hint::black_box;
    about(value, true, |request| {
        let Some(read) = request.post.read else {
            return;
        };
        let program = (request.post.emit)(request);
        let prove = || {
            let followed = prove::follow(request, &program.text, Part::Path)?;
            prove::prove(request, &followed, &program.move_lines).map(|_| followed)
        };
        // In this order: nothing was read before that is not to be counted.
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
                    Restarts::Telling,
                )))
            })
        });
        timed("plan", &mut || {
            (0..rounds).for_each(|_| drop(black_box(plan_with_path(black_box(value)))))
        });
    });
}
