//! The picture of a planned job: its scene and the texts in it.

use crate::form::{BestView, Value};
use crate::geom::Vec3;
use crate::job::{JobError, PlannedJob, plan_with_path};
use crate::num::decimal;
use crate::part::{self, Stock};
use crate::path::ONE_LEVEL;
use crate::view::scene::{self, Actual, Projection, Scene};
use crate::view::{self, Legend};

/// A scene of a job with its texts.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Walls, path, touches, dimensions.
    pub scene: Scene,
    /// Name of each dimension and angle, by the path of its field: the form's label, and the value in the job's units.
    pub names: Vec<(&'static str, String)>,
    /// Name of the work offset; empty if none is written.
    #[cfg_attr(
        not(target_arch = "wasm32"),
        allow(dead_code, reason = "the canvas shows it")
    )]
    pub offset: String,
    /// Whether the virtual part deviates; otherwise its walls are the nominal ones.
    pub deviates: bool,
}

impl PlannedJob {
    /// The active cycle, by its index in the list; the job itself if it has one cycle.
    pub fn in_hand(&self, hand: usize) -> &PlannedJob {
        self.members.get(hand).unwrap_or(self)
    }

    /// The job, its path and its run on the virtual part, from one viewing direction. Deviations are drawn `magnify` times as large. In a set-up all cycles are
    /// drawn, the active one (`hand`) with its dimensions, the others pale; without `hand` all are active.
    pub fn picture(&self, view: Projection, magnify: f64, hand: Option<usize>) -> Picture {
        let PlannedJob {
            job,
            path,
            run,
            members,
            ..
        } = self;
        let mut scene = if members.is_empty() {
            self.scene(view, magnify)
        } else {
            let feeds = path.feeds.unwrap_or(job.feeds);
            let mut scene = scene::between(path, &job.setup, &feeds, run.collision, view);
            for (i, (own, member)) in members.iter().zip(&path.cycles).enumerate() {
                let pale = hand.is_some_and(|hand| hand != i);
                scene.take(
                    own.scene(view, magnify),
                    &member.name,
                    member.moves.start,
                    pale,
                );
            }
            scene
        };
        if let Some(stock) = &job.stock {
            let openings = part::openings(path, &path.surfaces, job.setup.radius);
            scene.put_stock(stock, &openings, job.setup.plane, view);
        }
        scene.unit = Some(job.scale);
        scene.stylus = scene::stylus::outlines(&job.shape, job.setup.radius, job.setup.plane, view);
        let names = self
            .in_hand(hand.unwrap_or(usize::MAX))
            .names(&scene, |_| None);
        scene.name(&names);
        Picture {
            names,
            offset: job
                .work_offset
                .map_or_else(String::new, |n| (job.post.work_offset_word)(n)),
            deviates: job.placement.stated || members.iter().any(|own| own.job.placement.stated),
            scene,
        }
    }

    /// Scene of one cycle.
    fn scene(&self, view: Projection, magnify: f64) -> Scene {
        let PlannedJob {
            job,
            path,
            surfaces,
            run,
            ..
        } = self;
        let rigid = &job.placement.rigid;
        let actual = Actual {
            surfaces,
            run,
            origin: rigid.point(path.frame.origin),
            direction: rigid.direction(path.frame.u),
            line: path
                .feature
                .two_circles()
                .and_then(|c| c.line)
                .map(|line| line.map(|p| rigid.point(p))),
            magnify,
        };
        scene::build(
            path,
            &job.setup,
            &path.feeds.unwrap_or(job.feeds),
            &actual,
            (view, self.own_stock()),
        )
    }

    /// The stock that contains the feature. `None` for a feature above the top of the stock: its material is drawn separately.
    fn own_stock(&self) -> Option<&Stock> {
        let up = self.path.frame.w;
        let below = |top: f64, stock: &Stock| top <= stock.top(up) + ONE_LEVEL;
        let stock = self.job.stock.as_ref()?;
        self.path
            .top
            .is_none_or(|top| below(top, stock))
            .then_some(stock)
    }

    /// Whether a view shows a field's dimension or angle in true size, or the position, height or rotation that it gives.
    #[cfg_attr(
        not(target_arch = "wasm32"),
        allow(dead_code, reason = "the page looks for the view")
    )]
    pub fn shows(&self, field: &str, view: Projection) -> bool {
        let (path, plane) = (&self.path, self.job.setup.plane);
        // For a point `cycle.origin[0]` and so on.
        let (whole, axis) = field
            .strip_suffix(']')
            .and_then(|field| field.split_once('['))
            .unwrap_or((field, ""));
        let whole = whole
            .strip_prefix("cycle.")
            .and_then(|key| self.job.def.fields.iter().find(|field| field.key == key));
        let flat = |along: Vec3| view.place(plane, along).length() > 0.999;
        let seen = match whole.and_then(|field| field.seen) {
            Some(BestView::Rotation) => view == Projection::Top,
            Some(BestView::Height) => flat(path.frame.w),
            Some(BestView::Position) => Vec3::AXES
                .into_iter()
                .zip(["0", "1", "2"])
                .any(|(along, name)| name == axis && flat(along)),
            None => false,
        };
        seen || scene::drawn(path, plane, view)
            .iter()
            .any(|dimension| dimension.field == field)
            || scene::drawn_angles(path, plane, view)
                .iter()
                .any(|angle| angle.field == field)
    }

    /// Name of each dimension and angle, by the path of its field: the label from `label` or the form's, and the value in the job's units.
    pub fn names<'l>(
        &self,
        scene: &Scene,
        label: impl Fn(&str) -> Option<&'l str>,
    ) -> Vec<(&'static str, String)> {
        let named = |field: &'static str, value: String| {
            let key = field.strip_prefix("cycle.").unwrap_or(field);
            // The picture prints the part after the last blank in bold.
            let sized = self.job.sized.iter().find(|one| one.field.key == key);
            let value = sized.map_or(value, |one| one.text.trim().replace(' ', "\u{a0}"));
            let own = || {
                self.job
                    .def
                    .fields
                    .iter()
                    .find(|field| field.key == key)
                    .map_or("", |field| field.label)
            };
            (
                field,
                format!("{} {value}", label(field).unwrap_or_else(own)),
            )
        };
        let dimensions = scene
            .dimensions
            .iter()
            .map(|d| named(d.field, decimal(d.length / self.job.scale, 4)));
        let angles = scene.angles.iter().map(|a| {
            named(
                a.field,
                format!("{}°", decimal(a.turns[1].abs().to_degrees(), 4)),
            )
        });
        dimensions.chain(angles).collect()
    }
}

/// The picture of a job as an SVG. A job without a plan has no picture.
pub fn svg(value: &Value, view: Projection) -> Result<String, JobError> {
    let (planned, _) = plan_with_path(value)?;
    let picture = planned.picture(view, 1.0, None);
    let (name, cycle) = (&planned.job.name, planned.job.def.title);
    let legend = Legend {
        title: &format!("{name}: {cycle}"),
        names: &picture.names,
        deviates: picture.deviates,
    };
    Ok(view::svg(&picture.scene, &legend))
}
