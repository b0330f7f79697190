//! Jobs that Fanuc and Haas do not support, or support with a warning.

use super::skip::written_variables;
use super::{FIRST, LAST};
use crate::control::{
    Request, check_plain_moves, check_rotary, check_write, number, offsets, rotation_field,
};
use crate::form::Checker;
use crate::geom::Plane;
use crate::path::MovePurpose;
use crate::text::text;

/// Smallest search distance, and smallest distance from the start of a touch to its contact, mm. With less, a contact cannot be distinguished from the end or
/// the start of the move.
const SHORTEST_SEARCH: f64 = 0.2;

/// Upper limit of the feed of a Haas G31, mm/min, for programs in mm and in inch: the manual says that more may damage the probe.
const HAAS_LIMITS: [f64; 2] = [2500.0, 2540.0];

/// Checks the feeds of G31 on a Haas.
pub(super) fn check_haas_feeds(request: &Request<'_>, checker: &mut Checker) {
    let feeds = request
        .path
        .moves
        .iter()
        .filter_map(|step| match step.purpose {
            MovePurpose::Touch(_) => Some(request.feeds.work),
            MovePurpose::Position => request.feeds.rate(step.feed),
            MovePurpose::Search(_) | MovePurpose::Retract(_) => None,
        });
    let fastest = feeds.fold(0.0, f64::max);
    let limit = HAAS_LIMITS[usize::from(request.scale != 1.0)];
    if fastest >= limit {
        let message = text!(
            "G31 runs at up to {feed}/min here: the manual of the Classic control requires less than {limit}/min, since more may damage the probe",
            checker.length(fastest),
            checker.length(limit)
        );
        checker.warning("probing-too-fast", "feeds", message);
    }
}

/// Reports what the control cannot do for this request.
pub(super) fn check(request: &Request<'_>, checker: &mut Checker) {
    let unverified = text!(
        "G31, skip positions and work offset origins follow posts and macros in use; none of it was run on a control: make a dry run first, with a hand on feed hold. G31 may ignore the feed override"
    );
    checker.info("not-verified", "control.post", unverified);
    let rapid = request
        .path
        .moves
        .iter()
        .find(|m| request.feeds.rate(m.feed).is_none());
    if let Some(rate) = rapid
        .filter(|_| request.protected)
        .and_then(|m| (request.post.rate)(request, None, m))
    {
        let message = text!(
            "G31 moves at a stated feed: rapids run as watched moves at {rate}/min",
            checker.length(rate)
        );
        checker.info("rapid-at-feed", "feeds", message);
    }
    if !request.protected && !request.path.moves.is_empty() {
        let message = text!(
            "Without watched positioning, a probe deflected at the start would count as a touch: this control supports only watched programs"
        );
        checker.error("protection-unsupported", "control.protection", message);
    }
    check_plain_moves(request, checker);
    check_rotary(
        request,
        checker,
        text!("The program does not know the rotary axis of the machine"),
    );
    check_write(request, checker);
    offsets::check_optional(request, checker);
    number::check(request, checker);
    if request.plane != Plane::G17 && !request.path.moves.is_empty() {
        let message = text!(
            "The tool length is assumed to act along Z: there are no programs for planes other than G17"
        );
        checker.error("plane-unsupported", "plane", message);
    }
    let datum = request
        .path
        .formula
        .datum
        .as_ref()
        .filter(|_| request.work_offset.is_some());
    if datum.is_some_and(|d| d.rotation.is_some()) {
        let message =
            text!("Work offsets of this control have no rotation, so it cannot be written");
        checker.error("rotation-unsupported", rotation_field(request), message);
    }
    if let Some(k) = request
        .path
        .touches
        .iter()
        .position(|touch| touch.search < SHORTEST_SEARCH)
    {
        let message = text!(
            "Touch {touch} searches {search} past its nominal contact: at least {least} is needed to tell its contact from its end",
            k + 1,
            checker.length(request.path.touches[k].search),
            checker.length(SHORTEST_SEARCH)
        );
        checker.error("search-too-short", "overtravel", message);
    }
    check_starts(request, checker);
    number::check_digits(request, checker);
    let last = FIRST + request.registers().last + written_variables(request);
    if last > LAST {
        let message = text!(
            "The program would need #{first} to #{last}; a control has common variables up to #149 unless it was set up for more: take fewer \
             touches",
            FIRST,
            last
        );
        checker.error("too-many-registers", "control.post", message);
    }
}

/// Checks that every touch begins far enough before its contact.
fn check_starts(request: &Request<'_>, checker: &mut Checker) {
    let radius = request.setup.radius;
    let mut ways = request.path.searches().filter_map(|(k, from, _)| {
        Some((k, from?.distance(request.path.touches[k].contact(radius))))
    });
    if let Some((k, way)) = ways.find(|(_, way)| *way < SHORTEST_SEARCH) {
        let message = text!(
            "Touch {touch} begins {way} before its nominal contact: at least {least} is needed to distinguish its contact from its start",
            k + 1,
            checker.length(way),
            checker.length(SHORTEST_SEARCH)
        );
        checker.error("touch-too-short", "cycle", message);
    }
}
