//! Checks whether the axes stop in time after a contact, and whether a touch reaches its feed before it.

use crate::control::{ProgramForm, Request};
use crate::form::Checker;
use crate::geom::Vec3;
use crate::job::Job;
use crate::path::{Feed, Move, MovePurpose, Path};
use crate::text::text;

/// Checks every touch and every watched move against the stopping and run-up distances of the machine.
pub fn report_inertia(job: &Job, request: &Request<'_>, checker: &mut Checker) {
    report_touches(job, request, checker);
    report_starts(job, request, checker);
    report_positioning(job, request, checker);
}

/// Whether the touches run at the feed of the job: a native cycle has its own measuring feed, but 1411 takes F.
fn feed_is_known(job: &Job, path: &Path) -> bool {
    job.form == ProgramForm::Moves || path.feeds.is_some()
}

/// Reports a feed of touches at which the axes stop too late for the stylus.
fn report_touches(job: &Job, request: &Request<'_>, checker: &mut Checker) {
    let (machine, path, feed) = (job.machine, request.path, request.feeds.work);
    let way = machine.stopping_way(feed);
    if path.touches.is_empty() || !feed_is_known(job, path) || way <= machine.deflection {
        return;
    }
    let message = text!(
        "Touches at {feed}/min: the axes need {way} to stop after a contact, but the stylus takes only {deflection}. Use {most}/min or less",
        checker.length(feed),
        checker.length(way),
        checker.length(machine.deflection),
        rounded_down(checker, machine.fastest_stop())
    );
    checker.error("stops-too-late", field_of(path, Feed::Work), message);
}

/// Reports a touch that is still accelerating at its nominal contact: the probe is calibrated at the full feed.
fn report_starts(job: &Job, request: &Request<'_>, checker: &mut Checker) {
    let (machine, path, feed) = (job.machine, request.path, request.feeds.work);
    if !feed_is_known(job, path) {
        return;
    }
    let ways = path
        .searches()
        .filter_map(|(k, from, step)| Some((k, from?.distance(step.to))));
    let Some((k, way)) = ways
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .filter(|(_, way)| *way < machine.run_up(feed))
    else {
        return;
    };
    let message = text!(
        "Touch {touch} begins {way} before its nominal contact, but the axes need {run_up} to reach {feed}/min: it triggers while they still accelerate. Use {most}/min or less, or begin farther away",
        k + 1,
        checker.length(way),
        checker.length(machine.run_up(feed)),
        checker.length(feed),
        rounded_down(checker, machine.fastest_reached(way))
    );
    checker.warning("not-at-feed", field_of(path, Feed::Work), message);
}

/// Reports watched positioning at a feed at which a contact breaks the stylus: one finding for each feed.
fn report_positioning(job: &Job, request: &Request<'_>, checker: &mut Checker) {
    if !job.post.watches_positioning || !job.protected {
        return;
    }
    let (machine, path) = (job.machine, request.path);
    let mut from = path.start;
    for step in &path.moves {
        let Some(rate) = watched_rate(job, request, from.replace(step.to), step) else {
            continue;
        };
        let (way, field) = (machine.stopping_way(rate), field_of(path, step.feed));
        // A finding about the touches covers every move at their feed.
        if way <= machine.deflection || checker.has_at("stops-too-late", field) {
            continue;
        }
        let message = text!(
            "Positioning at {feed}/min: the axes need {way} to stop after a contact, but the stylus takes only {deflection}. Use {most}/min or less",
            checker.length(rate),
            checker.length(way),
            checker.length(machine.deflection),
            rounded_down(checker, machine.fastest_stop())
        );
        checker.warning("stops-too-late", field, message);
    }
}

/// Feed of a positioning move that the program itself makes, mm/min. With native cycles it makes the approach and the return.
fn watched_rate(job: &Job, request: &Request<'_>, from: Option<Vec3>, step: &Move) -> Option<f64> {
    let made = job.form == ProgramForm::Moves || matches!(step.feed, Feed::Approach | Feed::Return);
    (made && step.purpose == MovePurpose::Position)
        .then(|| (job.post.rate)(request, from, step))
        .flatten()
}

/// Path of the job field with a feed.
fn field_of(path: &Path, feed: Feed) -> &'static str {
    match (path.feeds.is_some() && path.calls.is_none(), feed) {
        (true, Feed::Work) => "cycle.probe.feed",
        (true, _) => "cycle.probe.rapid",
        (false, Feed::Approach) => "feeds.approach",
        (false, Feed::LongLink) => "feeds.longLink",
        (false, Feed::Work | Feed::Search) => "feeds.work",
        (false, Feed::Retract) => "feeds.retract",
        (false, Feed::Return) => "feeds.return",
        (false, Feed::Rapid) => "feeds",
    }
}

/// A feed to be typed: two significant digits, rounded down.
fn rounded_down(checker: &Checker, feed: f64) -> String {
    let own = feed / checker.scale;
    let step = 10f64.powi(own.log10().floor() as i32 - 1);
    checker.length((own / step).floor() * step * checker.scale)
}
