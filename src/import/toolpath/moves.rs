//! Moves of blocks: their ends, and arcs.

use crate::control::iso::script::Motion;
use crate::geom::{Plane, Vec3};
use crate::import::toolpath::block::Block;
use crate::import::toolpath::control_kind::ControlKind;
use crate::import::toolpath::count::count;
use crate::import::toolpath::known::TriggerAt;
use crate::import::toolpath::reader::Reader;
use crate::import::toolpath::rules::Touch;
use crate::import::toolpath::{FEED, PROBE, RAPID};
use crate::path::Arc;

/// Largest number of full turns in a program, by P: further ones are straight, so that drawing ends.
const MOST_TURNS: f64 = 10_000.0;

impl Reader {
    /// Makes the move of a block with positions.
    pub fn moves(&mut self, block: &Block) {
        let motion = block.once.unwrap_or(self.modes.motion);
        let from = self.place;
        if std::mem::take(&mut self.resumes) {
            let [x, y, z] = from;
            self.path
                .resumes
                .push([self.path.kind.len() as f64, x, y, z]);
        }
        self.goes(block, from);
        let tool = self.tool_axis();
        if block.given & 1 << tool != 0 {
            let is_zero = block.computed & 1 << tool == 0 && block.places[tool] == 0.0;
            self.is_up = block.home || block.machine && is_zero;
        }
        if matches!(motion, Motion::Clockwise | Motion::Counter) {
            match self.arc(block, from, motion == Motion::Counter) {
                Some([a, b, c, sweep]) => {
                    let plane = match self.modes.plane.unwrap_or_default() {
                        Plane::G17 => 17.0,
                        Plane::G18 => 18.0,
                        Plane::G19 => 19.0,
                    };
                    self.path
                        .arcs
                        .push([self.path.kind.len() as f64, a, b, c, sweep, plane]);
                }
                None => count(&mut self.arcs_unsolved, self.line),
            }
        }
        if block.curve || block.once.is_none() && self.modes.curve {
            count(&mut self.arcs_unsolved, self.line);
        }
        let kind = self.arrives(motion);
        if self.run.is_none() {
            return;
        }
        if let Some(log) = self.log.as_mut().filter(|_| self.is_up) {
            log.up.push(self.path.kind.len() - 1);
        }
        if kind == PROBE {
            self.touched(from, motion, block);
        } else {
            self.collides(from, kind == RAPID);
        }
    }

    /// Adds a move that ends at the current position; returns its kind.
    #[inline]
    pub fn arrives(&mut self, motion: Motion) -> u8 {
        let kind = match motion {
            Motion::Rapid => RAPID,
            motion if motion.probes() => PROBE,
            _ => FEED,
        };
        self.notes_system();
        self.path.to.extend_from_slice(&self.place);
        self.path.kind.push(kind);
        self.path
            .feed
            .push(if kind == RAPID || self.modes.by_other {
                f64::NAN
            } else {
                self.feed
            });
        self.path.line.push(self.line as u32);
        kind
    }

    /// Target of a block.
    fn goes(&mut self, block: &Block, from: [f64; 3]) {
        // Axes given as positions instead of distances.
        let is_unsure = self.modes.unsure.distance
            || self.modes.unsure.motion && block.once.is_none() && !block.motion;
        let places = if self.modes.absolute {
            !block.moved
        } else {
            block.placed
        };
        for (axis, place) in self
            .place
            .iter_mut()
            .enumerate()
            .filter(|(axis, _)| block.given & (1 << axis) != 0)
        {
            let x = block.places[axis] * self.modes.scale;
            *place = if is_unsure || block.computed & (1 << axis) != 0 {
                count(&mut self.computed, self.line);
                f64::NAN
            } else if block.machine {
                f64::NAN
            } else if places & (1 << axis) != 0 {
                x
            } else if from[axis].is_nan() {
                // The start is unknown: it counts from 0, except in a run, where it stays unknown.
                count(&mut self.from_unknown, self.line);
                if self.run.is_some() { f64::NAN } else { x }
            } else {
                from[axis] + x
            };
        }
        if block.machine && !block.home {
            let values = [0, 1, 2].map(|axis: usize| {
                if block.computed & (1 << axis) != 0 {
                    f64::NAN
                } else {
                    block.places[axis] * self.modes.scale
                }
            });
            self.place = self.frames.after_machine_move(block.given, values, from);
        }
        self.relative = self.relative & !block.given | block.given & !places;
        let unknown = |axis: usize| block.given & (1 << axis) != 0 && self.place[axis].is_nan();
        if block.machine && (0..3).any(unknown) {
            count(&mut self.machine, self.line);
        }
        if self.lost != 0 {
            if self.lost & !block.given != 0 {
                count(&mut self.computed, self.line);
            }
            self.lost = 0;
        }
    }

    /// End of a probing move on its way to the target of its block.
    #[cold]
    fn touched(&mut self, from: [f64; 3], motion: Motion, block: &Block) {
        let Some(run) = &mut self.run else { return };
        let to = self.place;
        // A Haas states the kind of the move itself.
        match block.contact {
            Some(Motion::MustBeFree) => {
                (run.behind.watched, run.behind.checks_contact) = (true, true);
            }
            Some(_) => (run.behind.watched, run.behind.checks_contact) = (false, true),
            None => {}
        }
        self.path.by_g38 |= motion == Motion::MustTouch || self.modes.motion.probes();
        if let Some(log) = &mut self.log {
            log.touches.push(Touch {
                index: self.path.kind.len() - 1,
                line: self.line,
                axes: block.given,
                stops: motion == Motion::MustTouch,
                asked: run.behind.checks_contact,
                watched: run.behind.watched,
                positions: run.behind.watched
                    || motion != Motion::MustTouch
                        && !run.behind.checks_contact
                        && !run.behind.reads,
                may_ask: run.behind.may_ask,
                feed: self.feed,
                states_feed: self.states_feed || block.feed.is_some(),
            });
        }
        let stated = if std::mem::take(&mut run.behind.watched) {
            run.positioning
        } else {
            run.touch
        };
        let inch = if self.path.metric == Some(false) {
            25.4
        } else {
            1.0
        };
        // The part stays, whatever a program calls its positions.
        let seen = |p: [f64; 3]| Vec3::from_array(self.frames.drawn(p)) * inch;
        let (begin, end) = (seen(from), seen(to));
        let trip = match &run.feature {
            None => stated,
            Some(_) if begin.is_nan() || end.is_nan() => TriggerAt::Unknown,
            Some(feature) => feature
                .contact(begin, end)
                .map_or(TriggerAt::Never, TriggerAt::At),
        };
        // An axis that does not move keeps its position.
        let stays = |axis: usize| to[axis] == from[axis];
        let end = |axis: usize| match trip {
            _ if stays(axis) => to[axis],
            TriggerAt::At(part) => from[axis] + part * (to[axis] - from[axis]),
            TriggerAt::Never => to[axis],
            TriggerAt::Unknown => f64::NAN,
        };
        self.place = [0, 1, 2].map(end);
        run.contact = self.frames.contact_variables(self.place);
        run.contact_in_machine = self.frames.in_machine(self.place);
        run.met = match trip {
            TriggerAt::At(_) => Some(true),
            TriggerAt::Never => Some(false),
            TriggerAt::Unknown => None,
        };
        if let TriggerAt::At(_) = trip {
            let [x, y, z] = self.place;
            self.path
                .contacts
                .push([(self.path.kind.len() - 1) as f64, x, y, z]);
        }
        // LinuxCNC's G38.2 and G38.4 stop the program without a contact.
        let missed = trip == TriggerAt::Never && matches!(motion, Motion::MustTouch);
        let chained = run.behind.chained && run.met == Some(true);
        if missed {
            count(&mut self.missed, self.line);
        }
        if missed || chained {
            self.stopped_by_touch = true;
            self.stops();
        }
        // LinuxCNC and others give P another meaning, or refuse it.
        let probes = self.modes.motion.probes() && block.once.is_none();
        if let Some(p) = block.p.filter(|_| probes) {
            if self.frames.kind == ControlKind::FluidNc {
                self.writes_by_probing(block, p);
            } else {
                count(&mut self.probe_words, self.line);
            }
        }
    }

    /// Whether the ball collides with the given part in a move that does not probe.
    #[cold]
    fn collides(&mut self, from: [f64; 3], rapid: bool) {
        let Some(feature) = self.run.as_ref().and_then(|run| run.feature.clone()) else {
            return;
        };
        let inch = if self.path.metric == Some(false) {
            25.4
        } else {
            1.0
        };
        let index = self.path.kind.len() - 1;
        let arc = self.path.arcs.last().filter(|arc| arc[0] == index as f64);
        let seen = |p: Vec3| Vec3::from_array(self.frames.drawn(p.to_array())) * inch;
        let mut begin = Vec3::from_array(from);
        let meets = pieces(begin, self.place.into(), arc)
            .into_iter()
            .any(|end| {
                let (from, to) = (seen(begin), seen(end));
                begin = end;
                !from.is_nan() && !to.is_nan() && feature.contact(from, to).is_some()
            });
        if meets {
            let counted = if rapid {
                &mut self.collisions[0]
            } else {
                &mut self.collisions[1]
            };
            count(counted, self.line);
        }
    }

    /// Records the system of the next move, if it differs from that of the previous one.
    #[inline]
    pub(super) fn notes_system(&mut self) {
        if let Some(system) = self.frames.take_change() {
            self.path.enters_system(system);
        }
    }

    /// Centre and sweep of an arc, in degrees; `None` if the block does not give one.
    fn arc(&mut self, block: &Block, from: [f64; 3], counter: bool) -> Option<[f64; 4]> {
        let [a, o, _] = self.modes.plane.unwrap_or_default().axes();
        let (begin, end) = ([from[a], from[o]], [self.place[a], self.place[o]]);
        if begin.iter().chain(&end).any(|x| x.is_nan()) {
            return None;
        }
        let middle = match block.radius {
            Some(radius) => by_radius(begin, end, radius * self.modes.scale, counter)?,
            None => {
                let given = |axis: usize| block.centered & (1 << axis) != 0;
                let offset = |axis: usize| {
                    if given(axis) {
                        block.center[axis] * self.modes.scale
                    } else {
                        0.0
                    }
                };
                if self.modes.centers_absolute {
                    [offset(a), offset(o)]
                } else {
                    [begin[0] + offset(a), begin[1] + offset(o)]
                }
            }
        };
        let angle = |at: [f64; 2]| (at[1] - middle[1]).atan2(at[0] - middle[0]).to_degrees();
        let mut sweep = (angle(end) - angle(begin)).rem_euclid(360.0);
        if !counter {
            sweep -= 360.0;
        }
        // A full circle ends at its start.
        let same = (end[0] - begin[0]).hypot(end[1] - begin[1]) < 1e-9;
        if same || sweep == 0.0 {
            sweep = if counter { 360.0 } else { -360.0 };
        }
        // P is the number of turns, the last of which ends there.
        if let Some(turns) = block
            .p
            .filter(|_| !self.sinumerik && block.offset.is_none())
        {
            let more = (turns - 1.0).trunc();
            if more >= 1.0 {
                self.turns += more;
                sweep += 360.0 * more.copysign(sweep);
            }
            if turns.is_nan() || self.turns > MOST_TURNS {
                return None;
            }
        }
        let out = (begin[0] - middle[0]).hypot(begin[1] - middle[1]);
        // An end that is not on the circle is an alarm on any control, except for rounding.
        if ((end[0] - middle[0]).hypot(end[1] - middle[1]) - out).abs() > 0.02 + 0.01 * out {
            return None;
        }
        let mut center = [self.place[0], self.place[1], self.place[2]];
        (center[a], center[o]) = (middle[0], middle[1]);
        (out > 0.0 && out.is_finite()).then_some([center[0], center[1], center[2], sweep])
    }
}

/// Centre of an arc with this radius; a negative radius takes the long way round.
fn by_radius(begin: [f64; 2], end: [f64; 2], radius: f64, counter: bool) -> Option<[f64; 2]> {
    let (dx, dy) = (end[0] - begin[0], end[1] - begin[1]);
    let chord = dx.hypot(dy);
    // Slightly too short is rounding.
    let square = radius * radius - chord * chord / 4.0;
    if radius.is_nan() || chord < 1e-9 || square < -1e-3 * radius * radius {
        return None;
    }
    let side = if counter == (radius > 0.0) { 1.0 } else { -1.0 };
    let off = side * square.max(0.0).sqrt() / chord;
    Some([
        (begin[0] + end[0]) / 2.0 - dy * off,
        (begin[1] + end[1]) / 2.0 + dx * off,
    ])
}

/// Ends of the straight pieces of a move; 24 to a turn for an arc.
fn pieces(from: Vec3, to: Vec3, arc: Option<&[f64; 6]>) -> Vec<Vec3> {
    let Some([_, x, y, z, sweep, plane]) = arc else {
        return vec![to];
    };
    let planes = [Plane::G17, Plane::G18, Plane::G19];
    let up = planes[(*plane as usize).saturating_sub(17).min(2)].basis()[2];
    let arc = Arc {
        center: Vec3::new(*x, *y, *z),
        sweep: sweep.to_radians(),
    };
    arc.pieces(from, to, up, (sweep.abs() / 15.0).clamp(1.0, 2400.0))
}
