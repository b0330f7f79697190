//! A checked job with its path and its run on the actual part.

use std::borrow::Cow;

use crate::control::native_run::compute;
use crate::control::native_run::machine::{Alarm, BallContact};
use crate::control::native_run::{CycleLinking, NativeCycles, NativeRequest, Rejections};
use crate::control::{Ask, ProgramForm};
use crate::cycle::Repeat;
use crate::form::Value;
use crate::formula::{OffsetCorrection, ResultRow};
use crate::geom::Vec3;
use crate::job::Job;
use crate::job::rows::{ParameterRow, parameter_row};
use crate::part;
use crate::path::{CallBlock, CallSequence, MovePurpose, Path, Surface};
use crate::text::words;

/// The surfaces of a cycle in the sizes of the actual part, at their nominal position.
fn sized_surfaces<'a>(job: &Job, path: &'a Path) -> Cow<'a, [Surface]> {
    match job.actual.as_deref() {
        Some(cycle) => Cow::Owned(cycle.surfaces(&job.setup)),
        None => Cow::Borrowed(&path.surfaces),
    }
}

/// Surfaces of the actual part at their displaced positions.
pub fn actual_surfaces(job: &Job, path: &Path) -> Vec<Surface> {
    part::displace_surfaces(&sized_surfaces(job, path), &job.placement)
}

/// The path, with the formula that the control computes.
fn path_of(job: &Job) -> Path {
    let mut path = job.cycle.plan(&job.setup);
    if job.post.computes {
        path.formula = std::mem::take(&mut path.formula).plain();
    }
    // 1411 has a separate field for its rotation, and is refused.
    if !job.post.offset_has_rotation && path.feature.two_circles().is_none() {
        path.formula.without_rotation();
    }
    path
}

/// First contact of a ball with these surfaces, for native cycles.
fn meets<'s>(
    surfaces: &'s [Surface],
    up: Vec3,
    radius: f64,
) -> impl Fn(Vec3, Vec3) -> Option<BallContact> + 's {
    let obstacles = part::Obstacles::of(surfaces, up);
    move |from, to| {
        let contact = obstacles.first_contact(radius, from, to)?;
        Some(BallContact {
            center: contact.center,
            surface: contact.surface,
            edge: contact.edge,
        })
    }
}

/// Path of native cycles for a documented path, if the job asks for them; otherwise the documented path and the reasons.
fn own_path(job: &Job, path: Path, clear: Option<f64>) -> (Path, Rejections) {
    let Some(cycles) = job.post.own.filter(|_| job.form == ProgramForm::Cycle) else {
        return (path, Vec::new());
    };
    let request = NativeRequest {
        path: &path,
        setup: &job.setup,
        feeds: &job.feeds,
        scale: job.scale,
        work_offset: job.work_offset,
        offset: cycles.offset,
        limits: job.limits,
        switches_on: job
            .cycle
            .parameters(&job.setup, &[])
            .iter()
            .any(|row| row.value == crate::path::ParameterValue::Flag(true)),
        report: job.report,
        set_up: job.set_up,
        clear,
        wear: &job.wear,
        edition: job.edition,
        measures_first: job.ask != Ask::Never
            && (job.work_offset.is_some() || !job.wear.is_empty()),
        takes_moves: (job.post.supports)(job.def.probes, ProgramForm::Moves).is_ok(),
    };
    let own = (cycles.plan)(
        &request,
        &meets(&path.surfaces, path.frame.w, job.setup.radius),
    );
    match own {
        Ok(own) => (own, Vec::new()),
        Err(refused) => (path, refused),
    }
}

/// Adds verdicts of the cycle beyond the formula. Repeated touches of a point count by their mean.
pub fn judge_touches(job: &Job, path: &Path, triggers: &[Option<Vec3>], rows: &mut Vec<ResultRow>) {
    let times = job.times();
    if times == 1 {
        return job.cycle.add_verdicts(&job.setup, path, triggers, rows);
    }
    let mean = |same: &[Option<Vec3>]| {
        let sum = same
            .iter()
            .copied()
            .try_fold(Vec3::ZERO, |sum, trigger| Some(sum + trigger?));
        sum.map(|sum| sum / times as f64)
    };
    let means: Vec<Option<Vec3>> = triggers.chunks(times).map(mean).collect();
    job.cycle
        .add_verdicts(&job.setup, &path_of(job), &means, rows);
}

/// Runs the calls of a path on the actual part.
fn own_run(
    path: &Path,
    own: &CallSequence,
    cycles: &NativeCycles,
    surfaces: &[Surface],
    radius: f64,
) -> part::PartRun {
    let (made, alarm) = (cycles.rerun)(own, radius, &meets(surfaces, path.frame.w, radius));
    let mut run = part::PartRun {
        triggers: vec![None; path.touches.len()],
        ..part::PartRun::default()
    };
    // A move that does not occur on the nominal part does not belong to the path.
    let index = |count: usize| own.counts.partition_point(|known| *known < count) + 1;
    for made in &made {
        let step = path
            .moves
            .get(index(made.ordinal))
            .filter(|_| own.counts.binary_search(&made.ordinal).is_ok());
        if let (Some(MovePurpose::Touch(k)), Some(met)) = (step.map(|step| step.purpose), made.met)
        {
            run.triggers[k] = Some(met.center);
            if met.surface != path.touches[k].group {
                run.wrong_walls.push((k, met.surface));
            }
            if met.edge {
                run.edges.push(k);
            }
        }
    }
    // A missed touch also ends the macro; another finding reports it.
    if let (Some(alarm), Some(last)) = (alarm, made.last())
        && alarm != Alarm::NotFound
    {
        run.collision = last
            .met
            .map(|met| (index(last.ordinal).min(path.moves.len() - 1), met.center));
    }
    run
}

/// The job of a cycle that follows results, with nominal values, to plan it with others.
#[derive(Clone, Debug)]
pub struct FollowingJob {
    pub single: Value,
    /// Keys of the followed sizes.
    pub sizes: Vec<String>,
}

/// A job with its path and its run on the actual part. Lengths in mm.
#[derive(Debug)]
pub struct PlannedJob {
    pub job: Job,
    pub path: Path,
    /// Surfaces of the actual part.
    pub surfaces: Vec<Surface>,
    /// Run of the path on those surfaces.
    pub run: part::PartRun,
    /// Reasons against native cycles; empty if they are possible, or not asked for.
    pub native_rejections: Rejections,
    /// The cycles of a set-up, each planned separately; empty for a single cycle.
    pub members: Vec<PlannedJob>,
    /// Path of a dry run, which the program makes instead.
    pub dry: Option<Path>,
    /// Height of the link moves that its native cycles make in a set-up.
    pub clear: Option<f64>,
    /// The job of a native cycle that follows results.
    pub following: Option<FollowingJob>,
}

impl PlannedJob {
    /// Plans the path of a checked job and runs it.
    pub fn of(job: Job) -> Self {
        Self::at(job, None)
    }

    /// Plans a job with one cycle. If its native calls measure by single touches, the program computes the results after them.
    pub fn alone(job: Job) -> Self {
        let mut planned = Self::of(job);
        let linking = planned.job.post.own.map(|own| own.several);
        let path = &mut planned.path;
        if let (Some(linking), Some(own)) = (linking, &mut path.calls)
            && !own.measured.is_empty()
        {
            own.blocks.push((CallBlock::Compute(0), 0));
            // A cycle has fewer values than the control has variables.
            let _ = compute::allocate(path, linking);
            let whole = path.clone();
            compute::store_results(path, &whole, 0);
        }
        planned
    }

    /// Plans a cycle of a set-up whose native cycles make the link moves, at this height.
    pub fn at(job: Job, clear: Option<f64>) -> Self {
        let (path, refused) = own_path(&job, path_of(&job), clear);
        let path = match &job.repeat {
            Some(Repeat { spread, .. }) if job.times() > 1 => path.repeated(job.times(), *spread),
            _ => path,
        };
        let surfaces = actual_surfaces(&job, &path);
        let dry = job.dry.map(|lift| path.dry(lift));
        let mut planned = PlannedJob {
            job,
            path,
            surfaces,
            run: part::PartRun::default(),
            native_rejections: refused,
            members: Vec::new(),
            dry,
            clear,
            following: None,
        };
        planned.run = planned.run_on_surfaces(&planned.surfaces);
        planned
    }

    /// Runs the path, or the native calls, on these surfaces.
    pub fn run_on_surfaces(&self, surfaces: &[Surface]) -> part::PartRun {
        match (&self.path.calls, self.job.post.own) {
            (Some(own), Some(cycles)) => {
                own_run(&self.path, own, cycles, surfaces, self.job.setup.radius)
            }
            _ => part::run(&self.path, surfaces, &self.job.setup),
        }
    }

    /// The surfaces of all cycles in the sizes of the actual part, at their nominal position.
    pub fn sized_surfaces(&self) -> Vec<Surface> {
        match &self.members[..] {
            [] => sized_surfaces(&self.job, &self.path).into_owned(),
            members => members.iter().flat_map(Self::sized_surfaces).collect(),
        }
    }

    /// Whether the program writes a work offset, or as a program of moves a tool.
    pub fn writes(&self) -> bool {
        let formula = &self.path.formula;
        let datum = formula.datum.as_ref();
        let offset = self.job.work_offset.is_some() && datum.is_some_and(OffsetCorrection::writes);
        let tool = self.job.form == ProgramForm::Moves && formula.corrects_tools();
        self.dry.is_none() && (offset || tool)
    }

    /// The parameter table, in the job's units.
    pub fn table(&self) -> Vec<ParameterRow> {
        let of = |(cycle, planned): (usize, &PlannedJob)| {
            let member = &self.path.cycles[cycle];
            let field = |field: String| match field.strip_prefix("cycle.") {
                Some(rest) => format!("cycles[{cycle}].{rest}"),
                None => field,
            };
            let in_whole = move |row: ParameterRow| ParameterRow {
                cycle,
                touch: row.touch.map(|k| k + member.touches.start),
                field: row.field.map(field),
                ..row
            };
            planned
                .table()
                .into_iter()
                .map(in_whole)
                .collect::<Vec<_>>()
        };
        if !self.members.is_empty() {
            return self.members.iter().enumerate().flat_map(of).collect();
        }
        // The table of the documented cycle, for moves and native cycles, once for repeated touches. A row names the first touch of its point.
        let times = self.job.times();
        let documented = (self.path.calls.is_some() || times > 1).then(|| path_of(&self.job));
        let touches = documented
            .as_ref()
            .map_or(&self.path.touches, |path| &path.touches);
        let parameters = self.job.cycle.parameters(&self.job.setup, touches);
        let row = |parameter| parameter_row(&self.job, parameter);
        parameters
            .into_iter()
            .map(row)
            .map(|row| ParameterRow {
                touch: row.touch.map(|k| k * times),
                ..row
            })
            .collect()
    }
}

/// Linking of several native cycles in a program, or the reason why the control cannot link them. `None` for programs of moves.
pub fn several(job: &Job) -> Option<Result<CycleLinking, &'static str>> {
    let none = Err(words!("{control} has no native cycles"));
    (job.form == ProgramForm::Cycle).then(|| job.post.own.map_or(none, |own| Ok(own.several)))
}
