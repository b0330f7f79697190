//! A job with several cycles in one program: read, joined to one path, planned. Format 2 of a job.
//!
//! A set-up is read cycle by cycle, each as a job of its own, and the paths are joined: the code that checks a single cycle checks each of them.

use std::cell::OnceCell;

use crate::control::native_run::CycleLinking;
use crate::control::native_run::compute::{self, Lack};
use crate::cycle::CycleDef;
use crate::form::{Checker, Finding, Value};
use crate::geom::Vec3;
use crate::job::cycles::{
    CLEAR, LONGEST_NAME, MOST_CYCLES, RELATIONS, SET_UP_FORMAT, is_name, names, single_cycle_job,
    with_size_limit,
};
use crate::job::dependencies::{self, EarlierCycles};
use crate::job::planned::{PlannedJob, several};
use crate::job::relations::{self, Relations};
use crate::job::rows::ResultRow;
use crate::job::sections::TOLERANCES;
use crate::job::{Job, datum, wear};
use crate::part::{self, PartRun};
use crate::path::{
    DependencyLimits, Feature, Feed, Feeds, LINK_STEP, LinkBlock, MovePurpose, Path, STATED_RAPID,
};
use crate::text::text;

/// Smallest distance between the clearance plane and the start of a cycle that follows a height, mm: longer than the shortest move that can be watched. Our
/// choice.
const SHORTEST_WAY: f64 = 1.0;

/// Definition of a set-up in a program.
static WHOLE: CycleDef = CycleDef {
    title: "Set-up",
    source: "Touchpath",
    ..crate::cycle::SET_UP_PLACEHOLDER
};

/// A set-up while its cycles are read, each joined to the earlier ones.
struct Reading<'v> {
    value: &'v Value,
    cycles: &'v [Value],
    names: &'v [String],
    relations: Relations<'v>,
    merged: MergedFindings<'v>,
    /// Findings about followed results.
    settled: Checker,
    path: Path,
    members: Vec<PlannedJob>,
    /// Job of the first cycle: control, stylus and limits apply to all cycles.
    first: Option<Job>,
    /// Whether no cycle so far has an error.
    sound: bool,
}

/// Plans the cycles of a set-up and joins them. Reports refusals of each cycle at its index; `None` if anything is an error.
pub fn read(checker: &mut Checker, value: &Value) -> Option<PlannedJob> {
    let cycles = read_list(checker, value)?;
    let names = names(cycles);
    check_names(checker, cycles, &names);
    let limited = with_size_limit(value);
    let mut reading = Reading {
        value: limited.as_ref().unwrap_or(value),
        cycles,
        names: &names,
        relations: Relations::of(checker, value, &names, &dependencies::followed(cycles)),
        merged: MergedFindings::new(&names),
        settled: Checker::default(),
        path: Path::of_set_up(),
        members: Vec::new(),
        first: None,
        sound: true,
    };
    for index in 0..names.len() {
        reading.read_cycle(checker, index);
    }
    reading.finish(checker)
}

impl Reading<'_> {
    /// Reads a cycle, plans it, and joins its results to the earlier ones.
    fn read_cycle(&mut self, checker: &mut Checker, index: usize) {
        let name = &self.names[index];
        let Some(mut single) = single_cycle_job(self.value, index) else {
            checker.object(Some(&self.cycles[index]), &format!("cycles[{index}]"));
            self.sound = false;
            return;
        };
        if let Value::Map(entries) = &mut single {
            let given = self.value.get(TOLERANCES);
            let wear = wear::of_cycle(given, name, self.names.len() == 1);
            entries.push((TOLERANCES.to_owned(), wear));
        }
        let earlier = EarlierCycles {
            path: &self.path,
            relations: &self.relations,
            first: self.members.first().map(|planned| &planned.job),
            broken: !self.sound,
            all: OnceCell::new(),
        };
        let wanted = dependencies::read_dependencies(checker, &mut single, index, &earlier);
        let mut own = Checker::default();
        let job = Job::read(&mut own, &single);
        if index == 0 {
            (checker.scale, checker.unit) = (own.scale, own.unit);
            self.settled = Checker::in_units(own.scale, own.unit);
            self.first = Job::read(&mut Checker::default(), &single);
        }
        if job.as_ref().is_some_and(|job| job.def.most_touches == 0) {
            let message = text!(
                "{cycle} measures nothing: a set-up can only contain cycles that touch the part",
                name.clone()
            );
            own.error("set-up-unsupported", "cycle.type", message);
        }
        self.sound &= job.is_some() && !own.failed();
        self.merged.take(index, own.findings());
        if let Some(job) = job.filter(|_| self.sound) {
            let title = format!("{}: {}", job.def.source, job.def.title);
            let reaches = (job.setup.plane.axes(), reaches(&job));
            let mut planned = self.plan(job, index);
            if several(&planned.job).is_some() {
                planned.following = dependencies::following_job(&wanted, &single);
            }
            let settled = &mut self.settled;
            let follows = dependencies::resolve_dependencies(
                settled,
                wanted,
                (index, &single),
                &planned,
                &self.path,
            );
            let named = (name.clone(), title);
            self.path
                .add_cycle(named, planned.path.clone(), follows, reaches);
            self.relations.add_early(&mut self.path);
            self.members.push(planned);
        }
    }

    /// Plans a cycle. Native cycles write immediately after measuring, so only the last of them may write.
    fn plan(&self, job: Job, index: usize) -> PlannedJob {
        let writes = several(&job).is_some() && index + 1 == self.names.len();
        let work_offset = job.work_offset.filter(|_| writes);
        PlannedJob::of(Job { work_offset, ..job })
    }

    /// The joined set-up after reading all cycles.
    fn finish(mut self, checker: &mut Checker) -> Option<PlannedJob> {
        self.merged.give(checker);
        check_sizes(checker, self.value, self.names);
        let clear = read_clear(checker, self.value);
        let settled = self.settled.findings();
        settled
            .into_iter()
            .for_each(|finding| checker.adopt(finding));
        let failed = checker.failed();
        // Faults of relations are reported together with the rest.
        if self.sound {
            self.relations.add_all(checker, &mut self.path);
        }
        let job = Job {
            def: &WHOLE,
            repeat: None,
            ..self.first.filter(|_| !failed)?
        };
        let several = several(&job);
        let linking = several.and_then(Result::ok);
        let only_last = several.is_some() && linking.is_none_or(|own| own.activates.is_none());
        let source = datum::read(checker, self.value, &self.path, only_last);
        if let Some(several) = several {
            check_native(checker, &job, &self.members, several, self.names)?;
            let path = &mut self.path;
            if linking.is_some_and(|linking| linking.links_itself) {
                let writes = source.as_ref().map_or([None; 3], |source| source.place);
                let members = self.members;
                self.members = link_themselves(checker, (&job, path), members, (clear, writes))?;
            }
            dependencies::sense(checker, path, &self.members)?;
            if let Some(source) = source.as_ref().filter(|_| job.work_offset.is_some()) {
                datum::check_own(checker, (path, &self.members), source, only_last)?;
            }
        }
        let computes = several.map_or(job.post.computes, |_| {
            linking.is_some_and(|linking| linking.computes)
        });
        if !computes {
            self.relations.report_not_computed(checker);
        }
        let mut whole = connect(job, self.path, self.members, clear);
        relations::check_circles(checker, &whole);
        whole.path.write_from(&source?);
        if !whole.job.post.offset_has_rotation {
            whole.path.formula.without_rotation();
        }
        if let Some(linking) = linking {
            allocate(checker, &mut whole.path, linking)?;
            store_results(&mut whole);
        }
        dependencies::run(&mut whole);
        whole.run = run(&whole, PartState::Actual);
        Some(whole)
    }
}

/// Checks the cycles as native cycles. Reports why the control does not support them.
fn check_native(
    checker: &mut Checker,
    job: &Job,
    members: &[PlannedJob],
    several: Result<CycleLinking, &'static str>,
    names: &[String],
) -> Option<()> {
    if let Err(why) = several {
        let message = text!(
            "A set-up of native cycles: {why}",
            job.post.control_text(why)
        );
        checker.error("set-up-unsupported", "cycles", message);
        return None;
    }
    let has_own_program =
        |planned: &PlannedJob| planned.path.calls.is_none() && planned.native_rejections.is_empty();
    if let Some(i) = members.iter().position(has_own_program) {
        let message = text!(
            "{cycle}: this cycle has a separate program: it cannot be one of several",
            names[i].clone()
        );
        checker.error("set-up-unsupported", format!("cycles[{i}].type"), message);
        return None;
    }
    Some(())
}

/// Plans native cycles that make the link moves themselves, at this height. `writes` has the cycle that each axis is written from.
fn link_themselves(
    checker: &mut Checker,
    (job, path): (&Job, &Path),
    members: Vec<PlannedJob>,
    (clear, writes): (Option<f64>, [Option<usize>; 3]),
) -> Option<Vec<PlannedJob>> {
    // A cycle that follows a height may end higher by its limit.
    let higher = |m: usize| {
        let follows = path.cycles[m].placing.follows_axis(2);
        follows
            .then_some(job.limits.position)
            .flatten()
            .unwrap_or(0.0)
    };
    let all = members.iter().enumerate();
    let all = all.flat_map(|(m, planned)| ends(&planned.path).map(move |end| end + higher(m)));
    let highest = all.fold(f64::NEG_INFINITY, f64::max);
    let clear = clear.unwrap_or(highest);
    let high_enough = check_clear(checker, clear, highest);
    let at = |(m, planned): (usize, PlannedJob)| {
        let work_offset = job.work_offset.filter(|_| writes.contains(&Some(m)));
        let own = Job {
            work_offset,
            ..planned.job
        };
        PlannedJob {
            following: planned.following,
            ..PlannedJob::at(own, Some(clear))
        }
    };
    high_enough.then(|| members.into_iter().enumerate().map(at).collect())
}

/// Checks that the control has variables for all results that the next cycle would overwrite, and gives one to every value that the program computes.
fn allocate(checker: &mut Checker, path: &mut Path, several: CycleLinking) -> Option<()> {
    let (first, last) = several.saved_variables;
    match compute::allocate(path, several) {
        Ok(lacking) if !lacking.is_empty() => {
            let names: Vec<&str> = lacking
                .into_iter()
                .map(|index| path.relations[index].name.as_str())
                .collect();
            let message = text!(
                "The native cycles do not store every result that {relations} needs: the program does not compute it",
                names.join(", ")
            );
            checker.info("relation-not-computed", RELATIONS, message);
        }
        Ok(_) => {}
        Err(Lack::Variables(count)) => {
            let message = text!(
                "The results of these cycles need {count} variables, and the control has {room} for them: use fewer cycles",
                count,
                last + 1 - first
            );
            checker.error("too-many-registers", "cycles", message);
            return None;
        }
        Err(Lack::Followed(m)) => {
            let message = text!(
                "{cycle} follows a result that no native cycle stores. A cycle that writes the work offset may store none: then write that from another cycle",
                path.cycles[m].name.clone()
            );
            checker.error("place-of-result", format!("cycles[{m}]"), message);
            return None;
        }
    }
    Some(())
}

/// Tells each cycle where the program computes its results.
fn store_results(whole: &mut PlannedJob) {
    for m in 0..whole.members.len() {
        let first = whole.path.cycles[m].results.start;
        compute::store_results(&mut whole.members[m].path, &whole.path, first);
        let calls = whole.members[m].path.calls.clone();
        whole.path.cycles[m].path.calls = calls;
    }
}

/// Limits of followed results, from the limits of a job.
fn reaches(job: &Job) -> DependencyLimits {
    let [position, size, angle] =
        [job.limits.position, job.limits.size, job.limits.angle].map(|limit| limit.unwrap_or(0.0));
    DependencyLimits {
        position,
        size,
        angle,
        unit: job.scale,
    }
}

fn read_list<'v>(checker: &mut Checker, value: &'v Value) -> Option<&'v [Value]> {
    match value.get("format") {
        Some(Value::Number(n)) if *n == SET_UP_FORMAT => {}
        Some(Value::Number(n)) if *n > SET_UP_FORMAT => {
            checker.error(
                "newer-format",
                "format",
                text!("This job has a newer format than 2: it needs a newer Touchpath"),
            );
        }
        _ => checker.error(
            "unknown-value",
            "format",
            text!("A job with a list of cycles must have format 2"),
        ),
    }
    if value.get("cycle").is_some() {
        let message = text!("A job has either a cycle or a list of cycles, not both");
        checker.error("unknown-key", "cycle", message);
    }
    let Some(cycles) = value.get("cycles") else {
        let message = text!("A job of format 2 must have a list of cycles");
        checker.error("missing", "cycles", message);
        return None;
    };
    let cycles = checker.list(Some(cycles), "cycles")?;
    if !(1..=MOST_CYCLES).contains(&cycles.len()) {
        let message = text!(
            "A set-up has 1 to {most} cycles, not {count}",
            MOST_CYCLES,
            cycles.len()
        );
        checker.error("wrong-count", "cycles", message);
        return None;
    }
    Some(cycles)
}

fn check_names(checker: &mut Checker, cycles: &[Value], names: &[String]) {
    for (i, name) in names.iter().enumerate() {
        let path = || format!("cycles[{i}].name");
        if let Some(given) = cycles[i].given("name") {
            checker.text(given, &path());
        }
        if !is_name(name) {
            let shown: String = name.chars().take(40).collect();
            let message = text!(
                "A cycle cannot be called \"{name}\": a letter first, then letters and digits, {most} characters at most, since programs print it",
                shown,
                LONGEST_NAME
            );
            checker.error("cycle-name", path(), message);
        } else if let Some(first) = names[..i]
            .iter()
            .position(|other| other.eq_ignore_ascii_case(name))
        {
            let message = text!(
                "Cycles {one} and {other} have the same name, {name}",
                first + 1,
                i + 1,
                name.clone()
            );
            checker.error("cycle-name", path(), message);
        }
    }
}

/// Reports sizes of the virtual part for cycles that do not exist.
fn check_sizes(checker: &mut Checker, value: &Value, names: &[String]) {
    let Some(Value::Map(sizes)) = value.get("part").and_then(|part| part.get("sizes")) else {
        return;
    };
    for (key, _) in sizes {
        let of = key.split_once('.').map_or("", |(of, _)| of);
        if !names.iter().any(|name| name.eq_ignore_ascii_case(of)) {
            let shown = crate::form::printable(key);
            let message = text!(
                "No cycle here has the size \"{key}\": write the cycle in front of the size, as in {example}",
                shown.clone(),
                format!("{}.depth", names[0])
            );
            checker.error("unknown-key", format!("part.sizes.{shown}"), message);
        }
    }
}

fn read_clear(checker: &mut Checker, value: &Value) -> Option<f64> {
    let mut section = crate::form::Section::new(checker, Some(value), "");
    match value.get("clear") {
        None | Some(Value::Null) => None,
        Some(given) => section.number(given, &CLEAR, "clear"),
    }
}

/// Heights of the start and the end of a cycle, along the tool axis.
fn ends(path: &Path) -> impl Iterator<Item = f64> {
    let w = path.frame.w;
    let ends = path
        .start
        .into_iter()
        .chain(path.moves.first().map(|step| step.to))
        .chain(path.moves.last().map(|step| step.to));
    ends.map(move |place| place.dot(w))
}

/// Joins these cycles with link moves, without running them. `path` has their measurements.
fn connect(
    job: Job,
    mut path: Path,
    mut members: Vec<PlannedJob>,
    clear: Option<f64>,
) -> PlannedJob {
    let several = several(&job)
        .and_then(Result::ok)
        .filter(|_| members.iter().all(|planned| planned.path.calls.is_some()));
    if let Some(CycleLinking {
        saved_variables: (first, _),
        ..
    }) = several
    {
        let (mut kept, count) = (0, members.len());
        for (i, planned) in members.iter_mut().enumerate() {
            if let Some(own) = &mut planned.path.calls {
                kept = own.save_results(i + 1 == count, (first, kept));
            }
        }
    }
    // If both cycles of a link move follow a height, the limit counts twice.
    let margin = 2.0 * job.limits.position.unwrap_or(0.0) + SHORTEST_WAY;
    let tool = job.setup.plane.axes()[2];
    let mut highest = f64::NEG_INFINITY;
    for (member, planned) in path.cycles.iter_mut().zip(&members) {
        if planned.path.calls.is_some() {
            member.path.clone_from(&planned.path);
        }
        let higher = match member.placing.follows_axis(tool) {
            true => margin,
            false => 0.0,
        };
        highest = ends(&planned.path)
            .map(|end| end + higher)
            .fold(highest, f64::max);
    }
    let own = members.iter().find_map(|planned| planned.path.feeds);
    let feeds = match (several, own) {
        (Some(_), Some(own)) => own,
        // In a set-up a cycle with its own feeds uses those of the job, except for its rapid.
        (_, own) => Feeds {
            rapid: own.and_then(|feeds| feeds.rapid),
            ..job.feeds
        },
    };
    let rate = feeds.rate(Feed::Approach).unwrap_or(STATED_RAPID);
    let radius = job.setup.radius;
    let way = several
        .map(|several| move |to, axes| (several.way)(to, axes, radius, (Feed::Approach, rate)));
    let link = way
        .as_ref()
        .map(|way| way as LinkBlock<'_>)
        .zip(several.map(|several| several.computes));
    path.connect(clear.unwrap_or(highest), feeds, link);
    let activates = several.and_then(|several| several.activates);
    if let (Some(activates), Some(row)) = (activates, job.work_offset)
        && let Some(own) = &mut path.calls
        && own.blocks.iter().any(|(block, _)| block.writes())
    {
        own.blocks.push((activates(row), 0));
    }
    let surfaces = members
        .iter()
        .flat_map(|planned| planned.surfaces.iter().copied())
        .collect();
    let dry = job.dry.map(|lift| path.dry(lift));
    PlannedJob {
        job,
        path,
        surfaces,
        run: PartRun::default(),
        native_rejections: Vec::new(),
        members,
        dry,
        clear,
        following: None,
    }
}

/// Part on which a path is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartState {
    /// The nominal part.
    Nominal,
    /// The virtual part.
    Actual,
}

impl PlannedJob {
    /// Run of a set-up's cycle on a part.
    fn run_on(&self, on: PartState) -> PartRun {
        match on {
            PartState::Nominal if !self.job.placement.nominal => {
                part::run(&self.path, &self.path.surfaces, &self.job.setup)
            }
            PartState::Nominal | PartState::Actual => self.run.clone(),
        }
    }
}

/// Run of the whole path: each cycle separately, and every move against the studs and closed bodies of the other features.
fn run(whole: &PlannedJob, on: PartState) -> PartRun {
    let path = &whole.path;
    let mut all = PartRun::default();
    for (member, planned) in path.cycles.iter().zip(&whole.members) {
        let own = planned.run_on(on);
        all.triggers.extend(own.triggers);
        let (touch, surface) = (member.touches.start, member.surfaces.start);
        all.wrong_walls.extend(
            own.wrong_walls
                .iter()
                .map(|(k, other)| (k + touch, other + surface)),
        );
        all.edges.extend(own.edges.iter().map(|k| k + touch));
        all.collision = all.collision.or(own
            .collision
            .map(|(index, center)| (index + member.moves.start, center)));
    }
    let crossing = crossing(whole, on);
    all.collision = match (all.collision, crossing) {
        (Some(own), Some(other)) => Some(if other.0 < own.0 { other } else { own }),
        (own, other) => own.or(other),
    };
    all.stopped_before = whole
        .members
        .iter()
        .find_map(|planned| planned.run.stopped_before)
        .filter(|_| on == PartState::Actual);
    if let Some((index, _)) = all.collision {
        // Later moves are not run.
        for step in &path.moves[index..] {
            if let MovePurpose::Touch(k) = step.purpose {
                all.triggers[k] = None;
            }
        }
    }
    all
}

/// First move that hits the feature of another cycle.
fn crossing(whole: &PlannedJob, on: PartState) -> Option<(usize, Vec3)> {
    let radius = whole.job.setup.radius;
    match on {
        PartState::Nominal => {
            let standing = part::crossing(&whole.path, &whole.path.surfaces, radius);
            standing.or_else(|| part::through_contacts(&whole.path, radius))
        }
        PartState::Actual => {
            let shifted = dependencies::actual(whole);
            let (path, halt) = (
                shifted.as_ref().unwrap_or(&whole.path),
                whole.members.iter().find_map(|own| own.run.stopped_before),
            );
            // A cycle that the program does not reach cannot collide.
            let reached = |found: &(usize, Vec3)| {
                halt.is_none_or(|(m, _)| path.member_of_move(found.0) < Some(m))
            };
            part::crossing(path, &whole.surfaces, radius).filter(reached)
        }
    }
}

/// Checks of the whole set-up beside its cycles.
pub fn check(whole: &PlannedJob, checker: &mut Checker) {
    let PlannedJob {
        job, path, members, ..
    } = whole;
    let (w, radius) = (path.frame.w, job.setup.radius);
    let least = members
        .iter()
        .flat_map(|planned| ends(&planned.path).chain(planned.path.top.map(|top| top + radius)));
    let least = least.fold(f64::NEG_INFINITY, f64::max);
    let ways = path
        .moves
        .iter()
        .filter(|step| step.step == LINK_STEP)
        .map(|step| step.to.dot(w));
    let clear = ways.fold(f64::NEG_INFINITY, f64::max);
    check_clear(checker, clear, least);
    dependencies::check_ways(whole, checker);
    if path.cycles.len() > 1
        && members.iter().any(|planned| planned.path.feeds.is_some())
        && job.form == crate::control::ProgramForm::Moves
    {
        let message =
            text!("In a set-up, cycle 1411 uses the feeds of the job instead of its probing feed");
        checker.info("feeds-of-set-up", "feeds", message);
    }
    report_order(whole, checker);
}

/// Checks that the clearance plane is at least as high as the highest cycle.
fn check_clear(checker: &mut Checker, clear: f64, least: f64) -> bool {
    let low = clear.is_finite() && clear < least - 1e-6;
    if low {
        let message = text!(
            "Between the cycles the ball centre moves across at {clear}: it must be at least {least}, the highest start or end of a cycle",
            checker.length(clear),
            checker.length(least)
        );
        checker.error("clear-too-low", "clear", message);
    }
    !low
}

/// Reports a feature whose height depends on a top side that is measured later.
fn report_order(whole: &PlannedJob, checker: &mut Checker) {
    let path = &whole.path;
    let w = path.frame.w;
    let top = path.cycles.iter().position(|member| {
        let touch = member.path.touches.first();
        matches!(member.path.feature, Feature::Surface(_))
            && touch.is_some_and(|touch| touch.vector.dot(w) > 0.999)
    });
    let Some(top) = top.filter(|top| *top > 0) else {
        return;
    };
    let earlier: Vec<&str> = path.cycles[..top]
        .iter()
        .map(|member| member.name.as_str())
        .collect();
    let message = text!(
        "{top} measures the height of the part after {others}: on a higher or lower part they touch at another depth. Probe the top first",
        path.cycles[top].name.clone(),
        earlier.join(", ")
    );
    checker.info("order-of-cycles", format!("cycles[{top}]"), message);
}

/// Reports the first move that hits the feature of another cycle: an error on the nominal part, a warning on the virtual one.
pub fn report_crossing(whole: &PlannedJob, checker: &mut Checker) {
    let (on, found) = match crossing(whole, PartState::Nominal) {
        None if !whole.job.placement.nominal => {
            (PartState::Actual, crossing(whole, PartState::Actual))
        }
        found => (PartState::Nominal, found),
    };
    let Some((index, center)) = found else { return };
    let path = &whole.path;
    let place = checker.position(center);
    let name = path.cycles[path.member_of_move(index).unwrap_or(0)]
        .name
        .clone();
    let message = if path.moves[index].step == LINK_STEP {
        text!(
            "Move {move}, on the way to {cycle}, hits the feature of another cycle with the ball centre at {place}",
            index + 1,
            name,
            place
        )
    } else {
        text!(
            "Move {move}, of {cycle}, hits the feature of another cycle with the ball centre at {place}",
            index + 1,
            name,
            place
        )
    };
    match on {
        PartState::Nominal => checker.error("collision", "cycles", message),
        PartState::Actual => checker.warning("collision", "part", message),
    }
}

/// Findings of single cycles while they are merged for the set-up.
#[derive(Debug)]
pub struct MergedFindings<'n> {
    names: &'n [String],
    /// Each finding with the cycles that have it.
    found: Vec<(Finding, Vec<usize>)>,
}

impl<'n> MergedFindings<'n> {
    pub fn new(names: &'n [String]) -> Self {
        MergedFindings {
            names,
            found: Vec::new(),
        }
    }

    /// Adds the findings of a cycle.
    pub fn take(&mut self, cycle: usize, findings: Vec<Finding>) {
        for finding in findings {
            match self.found.iter_mut().find(|(known, _)| *known == finding) {
                Some((_, of)) => of.push(cycle),
                None => self.found.push((finding, vec![cycle])),
            }
        }
    }

    /// Whether a cycle has a finding with this code.
    pub fn has(&self, code: &str) -> bool {
        self.found.iter().any(|(finding, _)| finding.code == code)
    }

    /// Emits the merged findings: one that all cycles share and that concerns no field of a cycle once, any other per cycle with its name.
    pub fn give(self, checker: &mut Checker) {
        for (finding, of) in self.found {
            let own = finding.path == "cycle" || finding.path.starts_with("cycle.");
            if !own && of.len() == self.names.len() {
                checker.adopt(finding);
                continue;
            }
            for cycle in of {
                let said = text!(
                    "{cycle}: {finding}",
                    self.names[cycle].clone(),
                    finding.said.clone()
                );
                let path = match finding.path.strip_prefix("cycle") {
                    Some(rest) if own => format!("cycles[{cycle}]{rest}"),
                    _ => match finding.path.strip_prefix("part.sizes.") {
                        Some(size) => format!("part.sizes.{}.{size}", self.names[cycle]),
                        None => finding.path.clone(),
                    },
                };
                checker.adopt(Finding::new(finding.level, &finding.code, path, said));
            }
        }
    }
}

/// A finding about the whole program, at its path in a job with several cycles.
pub fn program_finding(finding: Finding) -> Finding {
    let path = match finding.path.as_str() {
        "control.workOffset" if finding.code == "rotation-unsupported" => {
            "datum.rotation".to_owned()
        }
        path => path
            .strip_prefix("cycle")
            .map_or_else(|| path.to_owned(), |_| "cycles".to_owned()),
    };
    Finding { path, ..finding }
}

/// Result rows of a cycle within the set-up. The set-up describes the write.
pub fn cycle_rows(cycle: usize, rows: Vec<ResultRow>) -> impl Iterator<Item = ResultRow> {
    rows.into_iter()
        .filter(|row| !row.code.starts_with("offset."))
        .map(move |row| ResultRow { cycle, ..row })
}
