//! Common part of the ENCY / SprutCAM cycles.
//!
//! A cycle of the family consists of its [`Dimensions`], mainly of a [`Shape`]. The shape gives the touches, plans the documented steps, states the arithmetic
//! of the results and gives the surfaces. The touches may also be picked one by one, as in the Job Assignment. Then everything follows from the picks, and the
//! dimensions only fill the parameter table.

mod custom;
pub mod field;
mod forms;
mod picked_touches;
mod shape;
mod table;
pub mod types;
pub mod words;

pub use custom::{HIGHEST as HIGHEST_CODE, MOST as MOST_CODES};
pub use field::Properties;
pub use picked_touches::{LONGEST_VECTOR, POINT, Pick, Placement};
pub use shape::{
    Circle, Corner, CornerAngle, Outside, Pairs, PlacedShape, Point, Shape, Side, Triple,
    TwoTouches, Variant,
};
use table::table;
pub use table::{CODE_GROUPS, code_of, only_angular};

use custom::Custom;
use shape::TouchLayout;

use crate::cycle::{Cycle, CycleDef, REPEAT};
use crate::form::{Checker, Field, Kind, PlainValue, Section, SubForm, Values};
use crate::formula::Formula;
use crate::geom::{Plane, Vec3};
use crate::path::{
    DatumSource, FeatureKind, ONE_LEVEL, Parameter, Path, ProbeSettings, Surface, Touch, Tracer,
};
use crate::text::text;

/// Additional form of every cycle of the family.
pub const PROPERTIES: SubForm = SubForm {
    key: "properties",
    fields: Properties::FIELDS,
    optional: true,
};

/// Field with the height above the start at which a path begins and ends.
const FEED_DISTANCE: &str = "cycle.feedDistance";

/// Base of the family's cycles: rows of the table without motion.
pub const BASE: CycleDef = CycleDef {
    key: "",
    title: "",
    summary: "",
    search_words: "",
    name: "",
    source: "",
    probes: FeatureKind::Action,
    own_feeds: false,
    number: None,
    most_touches: 0,
    fields: &[],
    sections: &[PROPERTIES, REPEAT],
    default_control: ("linuxcnc", "moves"),
    steps: &[],
    interpretations: &[],
    place: None,
    read: |def, section| read(def, section, "", |_| Dimensions::default()),
};

/// A form with checked values and the dimensions that it gives.
#[derive(Clone, Default)]
pub struct Dimensions {
    /// Each field with its value, for the parameter table.
    values: Vec<(&'static Field, PlainValue)>,
    placed: PlacedShape,
    /// Height above the start at which the path begins and ends, mm.
    feed_distance: f64,
}

impl Dimensions {
    /// Dimensions of a form with motion: origin (mm), rotation (degrees), feed distance (mm) and the shape.
    pub fn of(
        form: &dyn Values,
        (origin, rotation): (Vec3, f64),
        feed_distance: f64,
        shape: Shape,
    ) -> Self {
        Dimensions {
            values: form.values(),
            placed: PlacedShape {
                origin,
                rotation,
                shape,
            },
            feed_distance,
        }
    }

    /// Dimensions of a form without a position.
    pub fn unmoving(form: &dyn Values) -> Self {
        Dimensions {
            values: form.values(),
            ..Dimensions::default()
        }
    }

    fn field(&self, path: &str) -> Option<&'static Field> {
        let key = key_of(path);
        self.values
            .iter()
            .map(|(field, _)| *field)
            .find(|field| field.key == key)
    }
}

/// Key of a field at the end of its path in a job.
fn key_of(path: &str) -> &str {
    path.strip_prefix("cycle.").unwrap_or(path)
}

/// A cycle of the family with checked values.
#[derive(Clone)]
struct Ency {
    def: &'static CycleDef,
    /// Name of the cycle in the source's parameter table.
    name: &'static str,
    form: Dimensions,
    properties: Option<Properties>,
    picks: Option<Vec<Pick>>,
    custom: Vec<Custom>,
    /// The shape with the sizes of the actual part; `None` if these are nominal.
    actual: Option<Shape>,
}

/// Reads a cycle: its definition, its name in the parameter table, and the function that reads its dimensions.
pub fn read(
    def: &'static CycleDef,
    section: &mut Section<'_, '_>,
    name: &'static str,
    dimensions: fn(&mut Section<'_, '_>) -> Dimensions,
) -> Box<dyn Cycle> {
    let form = dimensions(section);
    let properties = section.sub(&PROPERTIES, Properties::read);
    let picks = if def.place.is_some() {
        picked_touches::read(section)
    } else {
        None
    };
    let custom = custom::read(section);
    Box::new(Ency {
        def,
        name,
        form,
        properties,
        picks,
        custom,
        actual: None,
    })
}

/// Position of a cycle with picked touches, and the touches that its dimensions give there. Touches with a code of the source are unchanged, the others are as
/// picked. `None` if the picks do not give a cycle.
pub fn place(
    section: &mut Section<'_, '_>,
    dimensions: fn(&mut Section<'_, '_>) -> Dimensions,
    picks: &[Pick],
    plane: Plane,
) -> Option<(Placement, Vec<Pick>)> {
    let form = dimensions(section);
    let mut own = form.placed.shape.clone();
    let mut checker = Checker::default();
    own.check(picks, plane, &mut checker);
    if checker.failed() {
        return None;
    }
    let mut placed = own.place(picks, plane);
    let mut sizes = Vec::new();
    for ((path, size), (_, own)) in placed.shape.sizes().into_iter().zip(own.sizes()) {
        sizes.push((key_of(path), *size));
        if form.field(path).is_some_and(|field| field.code.is_empty()) {
            *own = *size;
        }
    }
    placed.shape = own;
    let touches = placed.shape.touches(&placed.frame(plane));
    let touches = touches
        .into_iter()
        .map(|(point, vector, _)| Pick { point, vector })
        .collect();
    Some((
        Placement {
            origin: placed.origin,
            rotation: placed.rotation,
            sizes,
        },
        touches,
    ))
}

impl Ency {
    /// The shape at the position that the picks give.
    fn placed(&self, plane: Plane) -> PlacedShape {
        let placed = &self.form.placed;
        self.picks
            .as_ref()
            .map_or_else(|| placed.clone(), |picks| placed.shape.place(picks, plane))
    }

    /// The shape with its touches: nominal, or with the sizes of the actual part.
    fn seat<'s>(&self, setup: &'s ProbeSettings) -> (Shape, TouchLayout<'s>) {
        let nominal = self.placed(setup.plane);
        let frame = nominal.frame(setup.plane);
        let before = self
            .picks
            .as_ref()
            .map(|picks| (picks, nominal.shape.touches(&frame)));
        let shape = self.actual.clone().unwrap_or(nominal.shape);
        let mut touches = shape.touches(&frame);
        if let Some((picks, before)) = before {
            // A picked touch moves with its wall, by as much as the touch that follows from the dimensions.
            for ((now, then), pick) in touches.iter_mut().zip(before).zip(picks) {
                let vector = (pick.vector + now.1 - then.1).normalize_or(pick.vector);
                *now = (pick.point + now.0 - then.0, vector, now.2);
            }
        }
        let search = setup.overtravel;
        let touches = touches
            .into_iter()
            .enumerate()
            .map(|(sample, (point, vector, group))| Touch {
                point,
                vector,
                group,
                search,
                sample,
            })
            .collect();
        (
            shape,
            TouchLayout {
                frame,
                touches,
                setup,
                feed_distance: self.form.feed_distance,
            },
        )
    }

    /// Reports sizes from the picks that the form does not allow, or that differ from the form.
    fn compare(&self, placed: &mut Shape, checker: &mut Checker) {
        let mut given = self.form.placed.shape.clone();
        for ((path, size), (_, given)) in placed.sizes().into_iter().zip(given.sizes()) {
            let Some(field) = self.form.field(path) else {
                continue;
            };
            if !field.hard.nearly_holds(*size) {
                let message = text!(
                    "The picked touches give {label} a value that it must not have",
                    field.label
                );
                checker.error("picks-out-of-range", "cycle.touches", message);
            } else if (*size - *given).abs() > 1e-3 && !field.code.is_empty() {
                let shown = |x: f64| match field.kind {
                    Kind::Angle => format!("{}°", crate::num::decimal(x, 4)),
                    _ => checker.length(x),
                };
                let message = text!(
                    "{label} is {given} in the form, but {size} between the picked touches: the path follows the touches, the table the form",
                    field.label,
                    shown(*given),
                    shown(*size)
                );
                checker.warning("picks-differ", path, message);
            }
        }
    }
}

impl Cycle for Ency {
    fn rules(&self, setup: &ProbeSettings, checker: &mut Checker) {
        let shape = &self.form.placed.shape;
        let Some(picks) = &self.picks else {
            return shape.rules(setup, checker);
        };
        if !checker.is_clean(&["cycle"]) {
            return;
        }
        shape.check(picks, setup.plane, checker);
        if !checker.is_clean(&["cycle"]) {
            return;
        }
        let mut placed = shape.place(picks, setup.plane).shape;
        self.compare(&mut placed, checker);
        // The dimensions that the picks replace are not checked.
        if checker.is_clean(&["cycle"]) {
            placed.rules(setup, checker);
        }
    }

    fn plan(&self, setup: &ProbeSettings) -> Path {
        let (shape, on) = self.seat(setup);
        let mut tracer = Tracer::new(setup);
        shape.plan_steps(&on, &mut tracer);
        Path {
            moves: tracer.moves(),
            start: None,
            top: shape.top(&on),
            surfaces: shape.surfaces(&on),
            feeds: None,
            frame: on.frame,
            formula: shape.formula(&on),
            feature: shape.feature(),
            picked: self.picks.is_some(),
            calls: None,
            cycles: Vec::new(),
            relations: Vec::new(),
            datum_source: DatumSource::default(),
            shifts: Vec::new(),
            lift_field: Some(FEED_DISTANCE),
            touches: on.touches,
        }
    }

    fn formula(&self, setup: &ProbeSettings) -> Formula {
        let (shape, on) = self.seat(setup);
        shape.formula(&on)
    }

    fn parameters(&self, setup: &ProbeSettings, touches: &[Touch]) -> Vec<Parameter> {
        // Our own cycles have no row in the source's table.
        if self.def.number.is_none() {
            return Vec::new();
        }
        let (shape, _) = self.seat(setup);
        let kind = (self.def, self.name);
        let mut rows = table(
            kind,
            &self.form.values,
            self.properties.as_ref(),
            touches,
            setup,
            |k| shape.name(k),
        );
        rows.extend(self.custom.iter().map(Custom::row));
        rows
    }

    fn review_path(&self, setup: &ProbeSettings, path: &Path, checker: &mut Checker) {
        review(self.form.feed_distance, setup, path, checker);
    }

    fn surfaces(&self, setup: &ProbeSettings) -> Vec<Surface> {
        let (shape, on) = self.seat(setup);
        shape.surfaces(&on)
    }

    fn resized(&self, setup: &ProbeSettings, key: &str, delta: f64) -> Option<Box<dyn Cycle>> {
        let field = self
            .def
            .fields
            .iter()
            .find(|field| field.size && field.key == key)?;
        let mut actual = self
            .actual
            .clone()
            .unwrap_or_else(|| self.placed(setup.plane).shape);
        let (_, size) = actual
            .sizes()
            .into_iter()
            .find(|(path, _)| key_of(path) == key)?;
        *size += delta;
        // Two walls at 0° or 180° make no corner.
        let most = if field.kind == Kind::Angle {
            180.0
        } else {
            f64::INFINITY
        };
        let left = *size > 0.0 && *size < most;
        left.then(|| {
            Box::new(Ency {
                actual: Some(actual),
                ..self.clone()
            }) as Box<dyn Cycle>
        })
    }

    fn turned_error(&self, code: &str) -> Option<&'static str> {
        self.form.placed.shape.turned_error(code)
    }
}

/// Checks the ends of a path: it begins and ends above the feature and never goes higher than its end. If the source gives no top side, a small feed distance
/// is a warning.
fn review(feed_distance: f64, setup: &ProbeSettings, path: &Path, checker: &mut Checker) {
    const ROUNDING: f64 = 1e-6;
    let heights: Vec<f64> = path.moves.iter().map(|m| m.to.dot(path.frame.w)).collect();
    let [begin, .., end] = heights.as_slice() else {
        return;
    };
    let highest = heights.iter().copied().fold(*end, f64::max);
    // Picks whose heights differ only by the rounding of a dump are level.
    if highest > end + ONE_LEVEL + ROUNDING {
        let message = text!(
            "The path rises {height} above its end: one touch is too high compared with the others",
            checker.rounded_up(highest - end)
        );
        checker.error(
            "path-not-above",
            if path.picked {
                "cycle.touches"
            } else {
                "cycle"
            },
            message,
        );
    }
    match path.top {
        Some(top) => {
            let missing = top + setup.radius - begin.min(*end);
            if missing > ROUNDING {
                let message = text!(
                    "The path would begin and end inside the feature: with these clearances the feed distance must be at least {least}, so that the ball is clear of the top side",
                    checker.rounded_up(feed_distance + missing)
                );
                checker.error("start-in-feature", FEED_DISTANCE, message);
            }
        }
        // Our choice of a small distance: the source gives no height of the wall above the touches.
        None if feed_distance < (2.0 * setup.radius).max(5.0) - ROUNDING => {
            let message = text!(
                "This cycle has no top side: the path begins and ends {height} above the touches, perhaps inside the feature",
                checker.length(feed_distance)
            );
            checker.warning("low-start", FEED_DISTANCE, message);
        }
        None => {}
    }
}
