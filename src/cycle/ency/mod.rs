//! What the cycles of the ENCY / SprutCAM family share.
//!
//! A cycle of the family is a form ([`Filled`]) and a [`Shape`]: what its dimensions make of it. The shape gives the touches,
//! walks the documented steps, states the arithmetic of the results, and gives the surfaces. The touches may also be picked one
//! by one, as in the Job Assignment: then everything follows from them, and the dimensions only fill the parameter table.

mod custom;
pub mod field;
mod forms;
mod picks;
mod shape;
mod table;
pub mod types;
pub mod words;

pub use custom::{HIGHEST as HIGHEST_CODE, MOST as MOST_CODES};
pub use field::Properties;
pub use forms::{PairProtected, RectangleProtected, RoundProtected};
pub use picks::{LONGEST_VECTOR, POINT, Pick, Placement};
pub use shape::{Circle, Corner, Outside, Pairs, Point, Seated, Shape, Side, Still, Triple, Variant};
use table::table;
pub use table::{CODE_GROUPS, code_of, only_angular};

use custom::Custom;

use crate::cycle::{Cycle, CycleDef};
use crate::form::{Checker, Field, Kind, Section, Shown, SubForm, Values};
use crate::formula::Formula;
use crate::geom::{Frame, Plane, Vec3};
use crate::path::{ONE_LEVEL, Parameter, Path, Setup, Surface, Touch, Tracer};
use crate::text::text;

/// The form that every cycle of the family may have besides its own.
pub const PROPERTIES: SubForm = SubForm { key: "properties", fields: Properties::FIELDS, optional: true };

/// A cycle of the family with its form filled in, whichever it is.
trait Filled {
    /// Its form.
    fn form(&self) -> &dyn Values;

    /// Its form, to be changed.
    fn form_mut(&mut self) -> &mut dyn Values;

    /// A copy of it.
    fn copy(&self) -> Box<dyn Filled>;

    /// What its dimensions make of it.
    fn shape(&self) -> Box<dyn Shape>;
}

/// A cycle of the family with checked values.
struct Ency {
    def: &'static CycleDef,
    /// What the source calls it in the parameter table.
    name: &'static str,
    form: Box<dyn Filled>,
    properties: Option<Properties>,
    picks: Option<Vec<Pick>>,
    custom: Vec<Custom>,
    /// What the actual part's sizes differ by.
    deltas: Vec<(String, f64)>,
}

impl Clone for Ency {
    fn clone(&self) -> Self {
        Ency {
            def: self.def,
            name: self.name,
            form: self.form.copy(),
            properties: self.properties.clone(),
            picks: self.picks.clone(),
            custom: self.custom.clone(),
            deltas: self.deltas.clone(),
        }
    }
}

/// A form, and the shape it makes.
#[derive(Clone)]
struct Made<F> {
    form: F,
    shape: fn(&F) -> Box<dyn Shape>,
}

impl<F: Values + Clone + 'static> Filled for Made<F> {
    fn form(&self) -> &dyn Values {
        &self.form
    }

    fn form_mut(&mut self) -> &mut dyn Values {
        &mut self.form
    }

    fn copy(&self) -> Box<dyn Filled> {
        Box::new(self.clone())
    }

    fn shape(&self) -> Box<dyn Shape> {
        (self.shape)(&self.form)
    }
}

/// Makes a cycle of a form: what is known of it, what the source calls it in the parameter table, and the shape of its dimensions.
pub fn read<F: Values + Clone + 'static>(
    section: &mut Section<'_, '_>,
    def: &'static CycleDef,
    name: &'static str,
    form: F,
    shape: fn(&F) -> Box<dyn Shape>,
) -> Box<dyn Cycle> {
    read_rest(section, def, name, Box::new(Made { form, shape }))
}

/// Reads what every cycle of the family may have besides its form.
fn read_rest(
    section: &mut Section<'_, '_>,
    def: &'static CycleDef,
    name: &'static str,
    form: Box<dyn Filled>,
) -> Box<dyn Cycle> {
    let properties = section.sub(&PROPERTIES, Properties::read);
    let picks = if def.place.is_some() { picks::read(section) } else { None };
    let custom = custom::read(section);
    Box::new(Ency { def, name, form, properties, picks, custom, deltas: Vec::new() })
}

/// Where picked touches put a cycle, and the touches that its dimensions give there; none where they do not make one.
pub fn place<F: Values + Clone + 'static>(
    form: F,
    shape: fn(&F) -> Box<dyn Shape>,
    picks: &[Pick],
    plane: Plane,
) -> Option<(Placement, Vec<Pick>)> {
    place_by(Box::new(Made { form, shape }), picks, plane)
}

fn place_by(mut form: Box<dyn Filled>, picks: &[Pick], plane: Plane) -> Option<(Placement, Vec<Pick>)> {
    let mut checker = Checker::default();
    let shape = form.shape();
    shape.check(picks, plane, &mut checker);
    if checker.failed() {
        return None;
    }
    let placement = shape.place(picks, plane);
    put_in_place(&mut *form, &placement, false);
    let frame = Ency::frame(&*form, plane);
    let touches = form.shape().touches(&frame).into_iter().map(|(point, vector, _)| Pick { point, vector }).collect();
    Some((placement, touches))
}

/// Gives a form the place of its picks, and their sizes: all, or those that have no code of the source.
fn put_in_place(form: &mut dyn Filled, placement: &Placement, coded: bool) {
    form.form_mut().put("origin", Shown::Point(placement.origin));
    form.form_mut().put("rotation", Shown::Number(placement.rotation));
    let fields: Vec<&'static Field> = form.form().values().into_iter().map(|(field, _)| field).collect();
    for (key, size) in &placement.sizes {
        if coded || fields.iter().any(|f| f.key == *key && f.code.is_empty()) {
            form.form_mut().put(key, Shown::Number(*size));
        }
    }
}

impl Ency {
    /// The form as the picks have it.
    fn placed(&self, plane: Plane) -> Box<dyn Filled> {
        let mut form = self.form.copy();
        if let Some(picks) = &self.picks {
            put_in_place(&mut *form, &self.form.shape().place(picks, plane), true);
        }
        form
    }

    fn frame(form: &dyn Filled, plane: Plane) -> Frame {
        let origin = form.form().point("origin");
        let rotation = form.form().number("rotation").unwrap_or(0.0);
        Frame::new(plane, origin.unwrap_or(Vec3::ZERO), rotation.to_radians())
    }

    /// The shape and its touches: nominal, or with the actual part's sizes.
    fn seat(&self, setup: &Setup) -> (Box<dyn Shape>, Frame, Vec<Touch>) {
        let nominal = self.placed(setup.plane);
        let mut form = nominal.copy();
        for (key, delta) in &self.deltas {
            if let Some(size) = form.form().number(key) {
                // The angle of a corner whose walls are named the other way round is negative.
                form.form_mut().put(key, Shown::Number(size + delta * if size < 0.0 { -1.0 } else { 1.0 }));
            }
        }
        let frame = Self::frame(&*form, setup.plane);
        let shape = form.shape();
        let mut touches = shape.touches(&frame);
        if let Some(picks) = &self.picks {
            // A picked touch goes with its wall: as far as the touch of the dimensions does.
            let before = nominal.shape().touches(&frame);
            touches = picks
                .iter()
                .zip(touches.iter().zip(&before))
                .map(|(pick, (now, then))| {
                    (pick.point + now.0 - then.0, (pick.vector + now.1 - then.1).normalize_or(pick.vector), now.2)
                })
                .collect();
        }
        let search = setup.overtravel;
        let touches = touches
            .into_iter()
            .enumerate()
            .map(|(sample, (point, vector, group))| Touch { point, vector, group, search, sample })
            .collect();
        (shape, frame, touches)
    }
}

impl Cycle for Ency {
    fn rules(&self, setup: &Setup, checker: &mut Checker) {
        let shape = self.form.shape();
        let Some(picks) = &self.picks else { return shape.rules(setup, checker) };
        if !checker.sound(&["cycle"]) {
            return;
        }
        shape.check(picks, setup.plane, checker);
        if !checker.sound(&["cycle"]) {
            return;
        }
        // The sizes the picks give must be ones that a form may have.
        let placement = shape.place(picks, setup.plane);
        for (key, size) in &placement.sizes {
            let Some((field, Shown::Number(given))) = self.form.form().values().into_iter().find(|(f, _)| f.key == *key) else {
                continue;
            };
            if !field.hard.nearly_holds(if *key == "angle" { size.abs() } else { *size }) {
                let message = text!("The picked touches give {label} a value that it must not have", field.label);
                checker.error("picks-out-of-range", "cycle.touches", message);
            } else if (size - given).abs() > 1e-3 && !field.code.is_empty() {
                let shown = |x: f64| match field.kind {
                    Kind::Angle => format!("{}°", crate::num::decimal(x, 4)),
                    _ => checker.length(x),
                };
                let message = text!(
                    "{label} is {given} in the form, but {size} between the picked touches: the path follows the touches, the table the form",
                    field.label,
                    shown(given),
                    shown(*size)
                );
                checker.warning("picks-differ", format!("cycle.{key}"), message);
            }
        }
        // The dimensions that the picks replace do not matter.
        if checker.sound(&["cycle"]) {
            self.placed(setup.plane).shape().rules(setup, checker);
        }
    }

    fn plan(&self, setup: &Setup) -> Path {
        let (shape, frame, touches) = self.seat(setup);
        let on = Seated { frame, touches: &touches, setup };
        let mut tracer = Tracer::new(setup);
        shape.walk(&on, self.form.form().number("feedDistance").unwrap_or(0.0), &mut tracer);
        let (formula, surfaces, top) = (shape.formula(&on), shape.surfaces(&on), shape.top(&on));
        Path {
            moves: tracer.moves(),
            start: None,
            top,
            surfaces,
            feeds: None,
            frame,
            formula,
            feature: shape.feature(self.picks.is_some()),
            touches,
        }
    }

    fn formula(&self, setup: &Setup) -> Formula {
        let (shape, frame, touches) = self.seat(setup);
        shape.formula(&Seated { frame, touches: &touches, setup })
    }

    fn parameters(&self, setup: &Setup, touches: &[Touch]) -> Vec<Parameter> {
        let (shape, ..) = self.seat(setup);
        let mut rows = table((self.def, self.name), &*self.form, self.properties.as_ref(), touches, setup, |k| shape.name(k));
        rows.extend(self.custom.iter().map(Custom::row));
        rows
    }

    fn review(&self, setup: &Setup, path: &Path, checker: &mut Checker) {
        review(self.form.form().number("feedDistance").unwrap_or(0.0), setup, path, checker);
    }

    fn surfaces(&self, setup: &Setup) -> Vec<Surface> {
        let (shape, frame, touches) = self.seat(setup);
        shape.surfaces(&Seated { frame, touches: &touches, setup })
    }

    fn resized(&self, setup: &Setup, key: &str, delta: f64) -> Option<Box<dyn Cycle>> {
        let (field, _) = self.form.form().values().into_iter().find(|(field, _)| field.size && field.key == key)?;
        let size = self.placed(setup.plane).form().number(key)?.abs() + delta;
        // Walls that meet at no angle, or at a straight one, make no corner.
        let most = if field.key == "angle" { 180.0 } else { f64::INFINITY };
        if size <= 0.0 || size >= most {
            return None;
        }
        let mut cycle = self.clone();
        cycle.deltas.push((key.to_owned(), delta));
        Some(Box::new(cycle))
    }

    fn turned_error(&self, code: &str) -> Option<&'static str> {
        self.form.shape().turned_error(code)
    }
}

/// A path begins and ends above the feature, and never goes higher than where it ends. Where the source knows no top side, a small feed
/// distance is a warning.
fn review(feed_distance: f64, setup: &Setup, path: &Path, checker: &mut Checker) {
    const ROUNDING: f64 = 1e-6;
    let heights: Vec<f64> = path.moves.iter().map(|m| m.to.dot(path.frame.w)).collect();
    let [begin, .., end] = heights.as_slice() else { return };
    let highest = heights.iter().copied().fold(*end, f64::max);
    // Picks that are level within the rounding of a dump are level.
    if highest > end + ONE_LEVEL + ROUNDING {
        let message = text!(
            "The path rises {height} above its end: one touch is too high compared with the others",
            checker.rounded_up(highest - end)
        );
        checker.error("path-not-above", if path.feature.picked() { "cycle.touches" } else { "cycle" }, message);
    }
    let field = "cycle.feedDistance";
    match path.top {
        Some(top) => {
            let missing = top + setup.radius - begin.min(*end);
            if missing > ROUNDING {
                let message = text!(
                    "The path would begin and end inside the feature: with these clearances the feed distance must be at least {least}, so that the ball is clear of the top side",
                    checker.rounded_up(feed_distance + missing)
                );
                checker.error("start-in-feature", field, message);
            }
        }
        // Our choice of what is small: the source says nothing of the wall above the touches.
        None if feed_distance < (2.0 * setup.radius).max(5.0) - ROUNDING => {
            let message = text!(
                "This cycle has no top side: the path begins and ends {height} above the touches, perhaps inside the feature",
                checker.length(feed_distance)
            );
            checker.warning("low-start", field, message);
        }
        None => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form::{Value, form};

    form! {
        /// A form with another point in front of the place.
        struct Form {
            /// Any.
            target: Vec3 = Field::point("target", "Target"),
            origin: Vec3 = field::top_centre(),
        }
    }

    #[test]
    fn a_cycle_stands_at_its_origin_whatever_points_its_form_has() {
        let point = |p: [f64; 3]| Value::List(p.map(Value::Number).to_vec());
        let given = [("target", [7.0, 8.0, 9.0]), ("origin", [1.0, 2.0, 3.0])];
        let given = Value::Map(given.map(|(key, p)| (key.to_owned(), point(p))).to_vec());
        let mut checker = Checker::default();
        let form = Form::read(&mut Section::new(&mut checker, Some(&given), "cycle"));
        assert_eq!(form.values()[0].1, Shown::Point(Vec3::new(7.0, 8.0, 9.0)));
        let made = Made { form, shape: |_| Box::new(Still) };
        assert_eq!(Ency::frame(&made, Plane::G17).origin, Vec3::new(1.0, 2.0, 3.0));
    }
}
