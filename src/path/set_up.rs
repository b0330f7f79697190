//! Joins the paths of several cycles into the path of a set-up.

use std::ops::Range;

use crate::formula::{
    self, Coordinate, Formula, Limits, OffsetCorrection, Operand, ResultCheck, ResultDef, Role,
};
use crate::geom::{Frame, Plane, Vec3};
use crate::path::follow::{CycleTransform, DependencyLimits, Sensitivity};
use crate::path::shift::{NO_SHIFT, Shifts, most};
use crate::path::{
    CallBlock, Dependencies, Feature, Feed, Feeds, Move, MovePurpose, Path, Stored, Surface, Touch,
    ZERO_LENGTH,
};

/// Step number of a link move between two cycles, which belongs to no cycle's list.
pub const LINK_STEP: u8 = 0;

/// A cycle of a set-up, as a part of the joined path.
#[derive(Clone, Debug)]
pub struct CycleSegment {
    /// Name: letters and digits.
    pub name: String,
    /// Title for the header of a program: `ENCY/SprutCAM type 4: Hole`.
    pub title: String,
    /// The path of the cycle before joining.
    pub path: Path,
    /// Its moves in the joined path, after the link move to it.
    pub moves: Range<usize>,
    /// Its touches in the joined path.
    pub touches: Range<usize>,
    /// Its surfaces in the joined path.
    pub surfaces: Range<usize>,
    /// Its results in the joined path.
    pub results: Range<usize>,
    /// Shift, rotation and growth by results of earlier cycles.
    pub placing: CycleTransform,
    /// Correction of the work offset that the cycle measures.
    datum: Option<OffsetCorrection>,
    /// Shift of its variable indices in the joined formula.
    variable_offset: u32,
}

/// A relation between results of cycles, as a part of the joined path.
#[derive(Clone, Debug)]
pub struct RelationSegment {
    /// Index in the job's list of relations.
    pub index: usize,
    /// Name: letters and digits.
    pub name: String,
    pub own: formula::RelationTerm,
    /// Its results in the joined path.
    pub results: Range<usize>,
    /// Members whose touches the relation depends on, in order.
    pub sources: Vec<usize>,
    /// Correction of the work offset that the relation gives.
    datum: Option<OffsetCorrection>,
}

/// A cycle or relation, as a source of results.
#[derive(Clone, Debug)]
pub struct ResultSource<'p> {
    pub name: &'p str,
    /// Its results in the joined path.
    pub results: Range<usize>,
    /// Correction of the work offset that it gives.
    pub datum: Option<OffsetCorrection>,
}

/// Sources of the work offset that a set-up writes: a cycle or relation for abscissa, ordinate and tool axis, and a result for the rotation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DatumSource {
    /// Indices into the list of cycles, followed by the relations.
    pub place: [Option<usize>; 3],
    /// Index of a result.
    pub rotation: Option<usize>,
}

/// Makes the block of a link move to a position, along these axes.
pub type LinkBlock<'a> = &'a dyn Fn(Vec3, [bool; 3]) -> CallBlock;

impl Path {
    /// The path of a set-up without cycles.
    pub fn of_set_up() -> Path {
        Path {
            touches: Vec::new(),
            moves: Vec::new(),
            start: None,
            top: None,
            surfaces: Vec::new(),
            feeds: None,
            frame: Frame::new(Plane::G17, Vec3::ZERO, 0.0),
            formula: Formula::default(),
            feature: Feature::Several,
            picked: false,
            lift_field: None,
            calls: None,
            cycles: Vec::new(),
            relations: Vec::new(),
            datum_source: DatumSource::default(),
            shifts: Vec::new(),
        }
    }

    /// Adds the measurements of the next cycle, so that a later cycle can follow them. `path` is the path of that cycle before joining; [`Path::connect`] adds
    /// the moves. `axes` are abscissa, ordinate and tool axis.
    pub fn add_cycle(
        &mut self,
        (name, title): (String, String),
        path: Path,
        follows: Dependencies,
        (axes, reaches): ([usize; 3], DependencyLimits),
    ) {
        let before: Vec<&CycleTransform> =
            self.cycles.iter().map(|member| &member.placing).collect();
        let placing = CycleTransform::of(follows, &mut self.formula, (axes, reaches), &before);
        let (touches, surfaces, results) = (
            self.touches.len(),
            self.surfaces.len(),
            self.formula.results.len(),
        );
        // Samples are numbered on from those of the previous cycle.
        let before = self
            .cycles
            .last()
            .map_or(0..0, |member| member.touches.clone());
        let samples = self.touches[before].iter().map(|touch| touch.sample + 1);
        let sample = samples.max().unwrap_or(0);
        self.take_touches(&path, sample);
        self.take_surfaces(&path);
        let (later, datum) = match placing.turn() {
            Some(turn) => self.formula.join_turned(&name, &path.formula, sample, turn),
            None => {
                let later = self.formula.join(&name, &path.formula, sample);
                (later, path.formula.datum.map(|datum| datum.later_by(later)))
            }
        };
        let touches = touches..self.touches.len();
        let surfaces = surfaces..self.surfaces.len();
        let results = results..self.formula.results.len();
        self.cycles.push(CycleSegment {
            name,
            title,
            path,
            moves: 0..0,
            touches,
            surfaces,
            results,
            placing,
            datum,
            variable_offset: later,
        });
    }

    /// Adds the moves of all cycles. Between two cycles the probe goes up to `clear` along the tool axis, across, and down. `feeds` apply to all cycles. `link`
    /// makes the block of a link move, if all cycles are native, and tells whether their program computes.
    pub fn connect(&mut self, clear: f64, feeds: Feeds, link: Option<(LinkBlock<'_>, bool)>) {
        let mut members = std::mem::take(&mut self.cycles);
        let first = &members.first().expect("a set-up has a cycle").path;
        (self.start, self.frame, self.feeds) = (first.start, first.frame, Some(feeds));
        let tops: Option<Vec<f64>> = members.iter().map(|member| member.path.top).collect();
        self.top = tops.and_then(|tops| tops.into_iter().reduce(f64::max));
        for (
            m,
            CycleSegment {
                path,
                moves,
                touches,
                placing,
                ..
            },
        ) in members.iter_mut().enumerate()
        {
            let before = self.moves.len();
            let start = path
                .start
                .or(path.moves.first().map(|step| step.to))
                .unwrap_or_default();
            let first = |along: &Sensitivity| {
                if path.start.is_some() {
                    along.start
                } else {
                    along.moves[0]
                }
            };
            self.leads_to(path, clear, placing.shifts(start, first));
            if let Some((way, computes)) = link {
                let compute = computes.then_some(CallBlock::Compute(m));
                self.take_calls((path, placing), before, (way, compute));
            }
            let begin = self.moves.len();
            self.take_moves(path, touches.start);
            *moves = begin..self.moves.len();
            self.shifts
                .extend(path.moves.iter().enumerate().map(|(i, step)| {
                    let end = match step.purpose {
                        MovePurpose::Touch(k) | MovePurpose::Search(k) => {
                            step.to - path.touches[k].vector * path.touches[k].search
                        }
                        MovePurpose::Position | MovePurpose::Retract(_) => step.to,
                    };
                    placing.shifts(end, |along| along.moves[i])
                }));
        }
        if let (Some((_, true)), Some(whole)) = (link, &mut self.calls) {
            whole.blocks.push((CallBlock::Compute(members.len()), 0));
        }
        self.cycles = members;
        if self
            .cycles
            .iter()
            .all(|member| member.placing.follows.is_empty())
        {
            self.shifts.clear();
        }
    }

    /// Checks of followed results before a cycle. Each result is checked once in the program.
    pub fn asked_before(&self, member: usize, limits: &Limits) -> Vec<ResultCheck> {
        let followed = |member: &CycleSegment| {
            member
                .placing
                .follows
                .iter()
                .map(|follow| follow.result)
                .collect::<Vec<_>>()
        };
        let known: Vec<usize> = self.cycles[..member].iter().flat_map(followed).collect();
        let mut results: Vec<usize> = followed(&self.cycles[member]);
        results.retain(|result| !known.contains(result));
        results.dedup();
        results
            .into_iter()
            .filter_map(|result| self.formula.leads(result, limits))
            .collect()
    }

    /// Assignments that can be computed after the touches of a member: its own, and the shifts of the next member.
    pub fn computed_by(&self, member: usize) -> Range<usize> {
        let begin = |m: usize| {
            self.cycles
                .get(m)
                .map(|member| member.variable_offset as usize)
        };
        begin(member).unwrap_or(0)..begin(member + 1).unwrap_or(self.formula.assignments.len())
    }

    /// Shift of the end of a move.
    pub fn shifts(&self, index: usize) -> &Shifts {
        self.shifts.get(index).unwrap_or(NO_SHIFT)
    }

    /// Shift of a position that belongs to a move, such as the contact of a touch.
    pub fn shifts_at(&self, index: usize, place: Vec3) -> Shifts {
        let own = self
            .cycles
            .iter()
            .find(|member| member.moves.contains(&index));
        own.map_or_else(
            || self.shifts(index).clone(),
            |own| {
                own.placing
                    .shifts(place, |along| along.moves[index - own.moves.start])
            },
        )
    }

    /// Adds a relation between results. `index` is its index in the job's list.
    pub fn relate(&mut self, index: usize, name: String, own: formula::RelationTerm) {
        let begin = self.formula.results.len();
        let datum = self.formula.relate(&name, &own);
        let results = begin..self.formula.results.len();
        let operands = own.of.iter().flat_map(|operand| match *operand {
            Operand::Place([x, y]) => [x, y],
            Operand::Result(result) => [result; 2],
        });
        let mut sources: Vec<usize> = operands.flat_map(|result| self.sources(result)).collect();
        sources.sort_unstable();
        sources.dedup();
        let at = self.relations.partition_point(|other| other.index < index);
        self.relations.insert(
            at,
            RelationSegment {
                index,
                name,
                own,
                results,
                sources,
                datum,
            },
        );
    }

    /// Results of a relation for these values of its operands, mm or degrees, in order.
    pub fn related(
        &self,
        relation: &RelationSegment,
        known: impl Fn(usize) -> Option<f64>,
    ) -> Vec<Option<f64>> {
        let results = &self.formula.results;
        // A control may give a direction a whole turn away.
        let turn = |index: usize, value: f64| {
            value + ((results[index].nominal - value) / 360.0).round() * 360.0
        };
        let value = |index: usize| {
            let value = known(index)?;
            Some(if results[index].role == Role::Direction {
                turn(index, value)
            } else {
                value
            })
        };
        let place = |operand: &Operand| match *operand {
            Operand::Place([x, y]) => Some([value(x)?, value(y)?]),
            Operand::Result(index) => Some([value(index)?, 0.0]),
        };
        let Some(of) = relation
            .own
            .of
            .iter()
            .map(place)
            .collect::<Option<Vec<_>>>()
        else {
            return vec![None; relation.results.len()];
        };
        let is = |operand: &Operand| matches!(*operand, Operand::Result(index) if results[index].role == Role::Direction);
        let values = relation
            .own
            .relation
            .values(&of, relation.own.of.iter().any(is));
        let near = |(index, value): (usize, Option<f64>)| {
            value.map(|value| {
                if results[index].role.is_angle() {
                    turn(index, value)
                } else {
                    value
                }
            })
        };
        relation.results.clone().zip(values).map(near).collect()
    }

    /// Completes results that were read from a text with those of relations that follow from them: not every program computes relations. Returns the indices of
    /// the added results.
    pub fn complete(&self, results: &mut [Option<f64>]) -> Vec<usize> {
        let mut added = Vec::new();
        for relation in &self.relations {
            let values = self.related(relation, |index| results[index]);
            for (index, value) in relation.results.clone().zip(values) {
                if results[index].is_none() && value.is_some() {
                    results[index] = value;
                    added.push(index);
                }
            }
        }
        added
    }

    /// Members whose touches a result depends on, in order.
    pub fn sources(&self, result: usize) -> Vec<usize> {
        let relation = self
            .relations
            .iter()
            .find(|relation| relation.results.contains(&result));
        let own = || {
            self.cycles
                .iter()
                .position(|member| member.results.contains(&result))
        };
        relation.map_or_else(
            || own().into_iter().collect(),
            |relation| relation.sources.clone(),
        )
    }

    /// Whether a result is known after a member is measured; `None` if it does not depend on that member's touches.
    pub fn is_known_by(&self, result: usize, member: usize) -> Option<bool> {
        if self.cycles[member].results.contains(&result) {
            return Some(true);
        }
        let sources = &self
            .relations
            .iter()
            .find(|relation| relation.results.contains(&result))?
            .sources;
        sources
            .contains(&member)
            .then(|| sources.last() == Some(&member))
    }

    /// Sets the sources of the work offset.
    pub fn write_from(&mut self, source: &DatumSource) {
        self.datum_source = *source;
        self.formula.datum = self.datum_of(source);
    }

    /// The cycles of a set-up, followed by its relations.
    pub fn measuring(&self) -> impl Iterator<Item = ResultSource<'_>> {
        let members = self.cycles.iter();
        let cycles = members.map(|own| ResultSource {
            name: &own.name,
            results: own.results.clone(),
            datum: own.datum,
        });
        let relations = self.relations.iter();
        cycles.chain(relations.map(|own| ResultSource {
            name: &own.name,
            results: own.results.clone(),
            datum: own.datum,
        }))
    }

    /// The cycles and relations before this relation of the job's list.
    pub fn measuring_before(&self, relation: usize) -> impl Iterator<Item = ResultSource<'_>> {
        let before = self.relations.partition_point(|own| own.index < relation);
        self.measuring().take(self.cycles.len() + before)
    }

    /// Index of the cycle or relation that gives a result.
    pub fn measured_by(&self, result: &ResultDef) -> Option<usize> {
        let name = &self.formula.cycles.get(usize::from(result.cycle))?.name;
        self.measuring().position(|own| own.name == name)
    }

    /// Adds the link moves to the next cycle, shifted by `shifts`. The stylus may come to the first cycle from anywhere.
    fn leads_to(&mut self, next: &Path, clear: f64, shifts: Shifts) {
        let (Some(last), Some(to)) = (
            self.moves.last().map(|step| step.to),
            next.start.or(next.moves.first().map(|step| step.to)),
        ) else {
            return;
        };
        let w = self.frame.w;
        let at = |place: Vec3| place + w * (clear - place.dot(w));
        // A cycle without a start moves to its first position, down or across at the same height. The clearance plane follows no result, so the move across
        // there does not depend on the heights that the cycles follow.
        let level = |shifts: &Shifts| {
            [0, 1, 2].map(|axis| {
                if w[axis].abs() < 0.5 {
                    shifts[axis].clone()
                } else {
                    Vec::new()
                }
            })
        };
        let before = self.shifts.last().unwrap_or(NO_SHIFT).clone();
        let follows_height = level(&shifts) != shifts;
        let apart =
            |over: &Vec3| next.start.is_some() || follows_height || over.distance(to) > ZERO_LENGTH;
        let across = Some(at(to)).filter(apart);
        let ways = [
            (Some(at(last)), level(&before)),
            (across, level(&shifts)),
            (next.start, shifts),
        ];
        for (to, shifts) in ways
            .into_iter()
            .filter_map(|(to, shifts)| Some((to?, shifts)))
        {
            let from = self.moves.last().map_or(to, |step| step.to);
            if from.distance(to) > ZERO_LENGTH || *self.shifts.last().unwrap_or(NO_SHIFT) != shifts
            {
                self.moves.push(Move {
                    to,
                    feed: Feed::Approach,
                    purpose: MovePurpose::Position,
                    step: LINK_STEP,
                    arc: None,
                });
                self.shifts.push(shifts);
            }
        }
    }

    /// Largest shift of a move, mm.
    pub fn farthest_shift(&self, index: usize) -> f64 {
        most(self.shifts(index)).length()
    }

    /// Adds the calls of the next cycle after those of the link moves. Its moves begin at this index and replace its own first move.
    fn take_calls(
        &mut self,
        (path, placing): (&Path, &CycleTransform),
        before: usize,
        (way, compute): (LinkBlock<'_>, Option<CallBlock>),
    ) {
        let Some(own) = &path.calls else { return };
        let Some(whole) = &mut self.calls else {
            self.calls = Some(own.clone());
            return;
        };
        // Cycles of other numbers measure first on some controls: only for one cycle.
        whole.measuring.clear();
        whole.blocks.extend(compute.map(|compute| (compute, 0)));
        let (mut from, mut was) = (self.moves[before - 1].to, &self.shifts[before - 1]);
        let first = path.moves.first().map(|step| step.to);
        let shifts = first.map(|first| placing.shifts(first, |along| along.moves[0]));
        let links = self.moves[before..].iter().map(|step| step.to);
        let links = links.zip(&self.shifts[before..]);
        for (to, shifts) in links.chain(first.zip(shifts.as_ref())) {
            let axes = [0, 1, 2].map(|axis| {
                (to[axis] - from[axis]).abs() > ZERO_LENGTH || shifts[axis] != was[axis]
            });
            let block = way(to, axes);
            for word in 0..block.values().len() {
                let terms = block.axis_of(word).map(|axis| &shifts[axis]);
                if let Some(terms) = terms.filter(|terms| !terms.is_empty()) {
                    whole
                        .shifted
                        .push((whole.blocks.len(), word, terms.clone()));
                }
            }
            whole.blocks.push((block, 1));
            (from, was) = (to, shifts);
        }
        for (i, (block, moves)) in own.blocks.iter().enumerate() {
            for word in 0..block.values().len() {
                let terms = placing.word_shifts(i, word);
                if !terms.is_empty() {
                    whole.shifted.push((whole.blocks.len(), word, terms));
                }
            }
            whole.blocks.push((block.clone(), *moves));
        }
        whole.guards.extend(own.guards.iter().cloned());
    }

    fn take_moves(&mut self, path: &Path, touches: usize) {
        self.moves.extend(path.moves.iter().map(|step| {
            let purpose = match step.purpose {
                MovePurpose::Position => MovePurpose::Position,
                MovePurpose::Touch(k) => MovePurpose::Touch(k + touches),
                MovePurpose::Search(k) => MovePurpose::Search(k + touches),
                MovePurpose::Retract(k) => MovePurpose::Retract(k + touches),
            };
            Move { purpose, ..*step }
        }));
    }

    fn take_touches(&mut self, path: &Path, sample: usize) {
        let surfaces = self.surfaces.len();
        let later = |touch: &Touch| Touch {
            group: touch.group + surfaces,
            sample: touch.sample + sample,
            ..*touch
        };
        self.touches.extend(path.touches.iter().map(later));
    }

    fn take_surfaces(&mut self, path: &Path) {
        let body = |surface: &Surface| match surface {
            Surface::Flat(wall) => wall.body + 1,
            Surface::Round(_) | Surface::Unknown => 0,
        };
        let bodies = self.surfaces.iter().map(body).max().unwrap_or(0);
        self.surfaces
            .extend(path.surfaces.iter().map(|surface| match surface {
                Surface::Flat(wall) => Surface::Flat(crate::path::Wall {
                    body: wall.body + bodies,
                    ..*wall
                }),
                other => *other,
            }));
    }

    fn datum_of(&mut self, source: &DatumSource) -> Option<OffsetCorrection> {
        let all: Vec<Option<OffsetCorrection>> = self.measuring().map(|own| own.datum).collect();
        let datum = |axis: usize| all.get(source.place[axis]?).copied().flatten();
        let mut place = [0, 1, 2].map(|axis| datum(axis)?.place[axis]);
        // Abscissa and ordinate are written together: an unmeasured one counts as nominal.
        for (one, other) in [(0, 1), (1, 0)] {
            if let (Some(measures), None) = (datum(one), place[other]) {
                let nominal = measures.place[other];
                place[other] = place[one].and(nominal).map(|nominal| Coordinate {
                    measured: None,
                    ..nominal
                });
            }
        }
        let rotation = source.rotation.and_then(|result| {
            let result = &self.formula.results[result];
            Some((result.variable?, result.nominal))
        });
        let rotation = rotation.map(|(variable, nominal)| self.formula.turn(variable, nominal));
        (place.iter().any(Option::is_some) || rotation.is_some()).then(|| OffsetCorrection {
            rotation,
            ..OffsetCorrection::of(place)
        })
    }

    /// The member whose link moves begin with this move.
    pub fn begins_member(&self, index: usize) -> Option<usize> {
        let begin = |m: usize| {
            m.checked_sub(1)
                .map_or(0, |before| self.cycles[before].moves.end)
        };
        (0..self.cycles.len()).find(|m| begin(*m) == index)
    }

    /// The cycle of a move, or the cycle that a link move leads to. `None` in the path of a single cycle.
    pub fn member_of_move(&self, index: usize) -> Option<usize> {
        (!self.cycles.is_empty()).then(|| {
            self.cycles
                .partition_point(|member| member.moves.end <= index)
        })
    }

    /// Storage of each result after native cycles, by the index of the result.
    pub fn kept(&self) -> Vec<(usize, Stored)> {
        let of = |path: &Path, results: Range<usize>| -> Vec<(usize, Stored)> {
            let index = |code: &str| {
                results
                    .clone()
                    .find(|index| self.formula.results[*index].code == code)
            };
            let own = path.calls.iter().flat_map(|own| &own.stored);
            own.filter_map(|(code, stored)| Some((index(code)?, *stored)))
                .collect()
        };
        match self.cycles.as_slice() {
            [] => of(self, 0..self.formula.results.len()),
            members => members
                .iter()
                .flat_map(|member| of(&member.path, member.results.clone()))
                .chain(self.computed_results())
                .collect(),
        }
    }

    /// Values of the formula that native calls store besides results, by assignment.
    pub fn measured_values(&self) -> Vec<(usize, Stored)> {
        let of = |path: &Path, offset: usize| -> Vec<(usize, Stored)> {
            let own = path.calls.iter().flat_map(|own| &own.measured);
            own.map(|(index, stored)| (index + offset, *stored))
                .collect()
        };
        match self.cycles.as_slice() {
            [] => of(self, 0),
            members => members
                .iter()
                .flat_map(|member| of(&member.path, member.variable_offset as usize))
                .collect(),
        }
    }

    /// Variables of the results that the program of native cycles computes: those of relations.
    fn computed_results(&self) -> impl Iterator<Item = (usize, Stored)> {
        let all = self.relations.iter().flat_map(|own| own.results.clone());
        all.filter_map(|index| {
            let variable = self.formula.results[index].variable?;
            Some((index, self.calls.as_ref()?.stored_value(variable.index())?))
        })
    }

    /// Storage of each result by its name, in a set-up with the name of its cycle.
    pub fn stored(&self) -> Vec<(String, Stored)> {
        let name = |index: usize| self.formula.code(&self.formula.results[index]).into_owned();
        self.kept()
            .into_iter()
            .map(|(index, stored)| (name(index), stored))
            .collect()
    }

    /// The cycle of a touch. `None` in the path of a single cycle.
    pub fn member_of_touch(&self, k: usize) -> Option<usize> {
        (!self.cycles.is_empty()).then(|| {
            self.cycles
                .partition_point(|member| member.touches.end <= k)
        })
    }
}
