//! What lies between the features of a set-up: results of results, in the formula of all.

use crate::formula::draft::{Draft, Expr, Value};
use crate::formula::node::Variable;
use crate::formula::plain;
use crate::formula::{Coordinate, CycleSamples, Datum, Formula, Name, ResultDef, Role};
use crate::num::wrap_degrees;
use crate::text::words;

/// What a relation computes of results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// Distance and direction from one place to another.
    Line,
    /// The first of two results less the second.
    Difference,
    /// The mean of results of one kind.
    Mean,
    /// The middle of places.
    Center,
    /// The circle through places, as of a pitch circle.
    PitchCircle,
}

impl Relation {
    /// Every one, with its word in a job.
    pub const ALL: [(&'static str, Relation); 5] = [
        ("line", Relation::Line),
        ("difference", Relation::Difference),
        ("mean", Relation::Mean),
        ("center", Relation::Center),
        ("pitch-circle", Relation::PitchCircle),
    ];

    /// Whether it takes places; else single results.
    pub fn takes_places(self) -> bool {
        matches!(self, Relation::Line | Relation::Center | Relation::PitchCircle)
    }

    /// How many of them it takes.
    pub fn takes(self, most: usize) -> std::ops::RangeInclusive<usize> {
        match self {
            Relation::Line | Relation::Difference => 2..=2,
            Relation::Mean | Relation::Center => 2..=most,
            Relation::PitchCircle => 3..=most,
        }
    }
}

/// What a relation is of: a place by abscissa and ordinate, or a single result. Indexes into the list of results, each of a measured one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    Place([usize; 2]),
    Result(usize),
}

/// A relation, and what it is of.
#[derive(Clone, Debug)]
pub struct Relating {
    pub relation: Relation,
    pub of: Vec<Operand>,
    /// Whether all of that are measured heights, from which a height can be written.
    pub heights: bool,
}

/// A measured value and its nominal one.
#[derive(Clone, Copy)]
struct Known<'f> {
    value: Value<'f>,
    nominal: f64,
    role: Role,
}

impl Formula {
    /// Adds a relation with its name. Its results come last; what a work offset can be written from is given.
    pub fn relate(&mut self, name: &str, related: &Relating) -> Option<Datum> {
        // It has no samples of its own.
        let first_sample = self.cycles.last().map_or(0, |last| last.first_sample);
        self.continued(name, first_sample, |draft| write(draft, related))
    }

    /// Adds what is written behind it, as the next cycle with this name: its assignments, and its results that are stated.
    pub(super) fn continued<T>(&mut self, name: &str, first_sample: usize, write: impl FnOnce(&Draft) -> T) -> T {
        let (assignments, results) = (self.assignments.len(), self.results.len());
        let cycle = self.cycles.len() as u16;
        let rest = (std::mem::take(&mut self.cycles), self.datum, self.turn);
        let draft = Draft::continuing(std::mem::take(self));
        let written = write(&draft);
        *self = draft.finish(rest.1);
        (self.cycles, self.turn) = (rest.0, rest.2);
        self.assignments[assignments..].iter_mut().for_each(|assignment| assignment.cycle = cycle);
        self.results[results..].iter_mut().for_each(|result| result.cycle = cycle);
        self.cycles.push(CycleSamples { name: name.to_owned(), first_sample });
        written
    }
}

fn write(f: &Draft, Relating { relation, of, heights }: &Relating) -> Option<Datum> {
    let known = |result: usize| {
        let ResultDef { nominal, role, variable, .. } = f.result_at(result);
        Known { value: f.known(variable.unwrap_or(Variable(0))), nominal, role }
    };
    let place = |operand: &Operand| match *operand {
        Operand::Place(axes) => axes.map(known),
        Operand::Result(result) => [known(result); 2],
    };
    let single = |operand: &Operand| place(operand)[0];
    match *relation {
        Relation::Line => {
            line(f, place(&of[0]), place(&of[1]));
            None
        }
        Relation::Difference => {
            difference(f, single(&of[0]), single(&of[1]));
            None
        }
        Relation::Mean => {
            let (value, nominal) = mean(f, &of.iter().map(single).collect::<Vec<_>>());
            heights.then(|| Datum::of([None, None, Some(Coordinate::measured(value, nominal))]))
        }
        Relation::Center => {
            let places: Vec<[Known<'_>; 2]> = of.iter().map(place).collect();
            let count = places.len() as f64;
            let axis = |axis: usize, name: &'static str| {
                let sum = f.sum(places.iter().map(|place| place[axis].value));
                (f.set(name, sum / f.number(count)), places.iter().map(|place| place[axis].nominal).sum::<f64>() / count)
            };
            let (x, y) = (axis(0, "center_x"), axis(1, "center_y"));
            Some(center(f, x, y))
        }
        Relation::PitchCircle => {
            let places: Vec<[Known<'_>; 2]> = of.iter().map(place).collect();
            let nominal: Vec<_> =
                places.iter().map(|place| crate::geom::Vec2::new(place[0].nominal, place[1].nominal)).collect();
            let fit = crate::formula::fit_circle(&nominal);
            let (middle, radius) = fit.map_or((crate::geom::Vec2::NAN, f64::NAN), |fit| (fit.center, fit.radius));
            let at = |k: usize, axis: usize| Expr::from(places[k][axis].value);
            let [x, y, r, residual] = plain::circle(f, 1, 0..places.len(), &at);
            let (x, y) = (f.set("center_x", x), f.set("center_y", y));
            let diameter = f.set("diameter", f.number(2.0) * r);
            let datum = center(f, (x, middle.x), (y, middle.y));
            f.result("diameter", Role::Size, words!("Diameter of the pitch circle"), 2.0 * radius, Some(diameter));
            let meaning = words!("Root mean square distance of the places from the pitch circle");
            f.result("residual", Role::Residual, meaning, 0.0, Some(residual));
            Some(datum)
        }
    }
}

/// A place as results, and as what a work offset can be written from.
fn center<'f>(f: &'f Draft, x: (Value<'f>, f64), y: (Value<'f>, f64)) -> Datum {
    f.result("center.x", Role::Abscissa, words!("Centre, abscissa"), x.1, Some(x.0));
    f.result("center.y", Role::Ordinate, words!("Centre, ordinate"), y.1, Some(y.0));
    Datum::point(x, y)
}

/// Distance, and the direction as nominal plus how far it is turned from that: near half a turn an angle may be said a whole turn away.
fn line<'f>(f: &'f Draft, from: [Known<'f>; 2], to: [Known<'f>; 2]) {
    let [dx, dy] = [("dx", 0), ("dy", 1)].map(|(name, axis)| f.set(name, to[axis].value - from[axis].value));
    let [nx, ny] = [0, 1].map(|axis| to[axis].nominal - from[axis].nominal);
    let length = nx.hypot(ny);
    let distance = f.set("distance", (dx * dx + dy * dy).sqrt());
    let (cos, sin) = (nx / length, ny / length);
    // An angle has an assignment of its own: a control may have to bring it into half a turn.
    let turned = f.set("turned", f.project(dy, dx, (cos, -sin)).atan2(f.project(dx, dy, (cos, sin))));
    let nominal = ny.atan2(nx).to_degrees();
    let rotation = f.set("rotation", turned + f.number(nominal));
    f.result("distance", Role::Size, words!("Distance from the first place to the second"), length, Some(distance));
    f.result("rotation", Role::Direction, words!("Direction from the first place to the second"), nominal, Some(rotation));
}

/// How far a value is from its nominal one: of a direction within half a turn. `number` tells the names apart.
fn off<'f>(f: &'f Draft, number: usize, known: Known<'f>) -> Expr<'f> {
    let constant = if known.role.is_angle() { f.number(known.nominal) } else { f.length(known.nominal) };
    let off = known.value - constant;
    if known.role != Role::Direction || known.nominal.abs() <= 90.0 {
        return off;
    }
    let away = f.set(Name::new("away", number), off);
    f.set(Name::new("turned", number), away.sin().atan2(away.cos())).into()
}

/// What is computed of single results keeps their kind: sizes give a size, other lengths a coordinate.
fn role_of(known: &[Known<'_>]) -> Role {
    match known[0].role {
        Role::Size => Role::Size,
        Role::Residual => Role::Residual,
        Role::Angle | Role::Direction | Role::Turn => Role::Angle,
        _ => Role::Reading,
    }
}

fn difference<'f>(f: &'f Draft, first: Known<'f>, second: Known<'f>) {
    let nominal = first.nominal - second.nominal;
    if first.role.is_angle() {
        // Between directions the smaller turn counts.
        let directions = first.role == Role::Direction || second.role == Role::Direction;
        let nominal = if directions { wrap_degrees(nominal) } else { nominal };
        let value = off(f, 1, first) - off(f, 2, second) + f.number(nominal);
        let value = f.set("difference", value);
        f.result("difference.angle", Role::Angle, words!("First angle less the second"), nominal, Some(value));
    } else {
        let value = f.set("difference", first.value - second.value);
        f.result("difference", Role::Size, words!("First result less the second"), nominal, Some(value));
    }
}

fn mean<'f>(f: &'f Draft, known: &[Known<'f>]) -> (Value<'f>, f64) {
    let count = known.len() as f64;
    let nominal = mean_of(&known.iter().map(|known| known.nominal).collect::<Vec<_>>(), known[0].role == Role::Direction);
    let all = |role: Role| known.iter().all(|known| known.role == role);
    if known[0].role.is_angle() {
        let sum = f.sum(known.iter().enumerate().map(|(i, known)| off(f, i + 1, *known)));
        let value = f.set("mean", sum / f.number(count) + f.number(nominal));
        let role = if all(Role::Direction) { Role::Direction } else { Role::Angle };
        f.result("mean.angle", role, words!("Mean of the angles"), nominal, Some(value));
        (value, nominal)
    } else {
        let sum = f.sum(known.iter().map(|known| known.value));
        let value = f.set("mean", sum / f.number(count));
        f.result("mean", role_of(known), words!("Mean of the results"), nominal, Some(value));
        (value, nominal)
    }
}

/// The mean of values; of directions about the first, from which none is farther than half a turn.
fn mean_of(values: &[f64], directions: bool) -> f64 {
    let first = values[0];
    let near = |value: f64| if directions { first + wrap_degrees(value - first) } else { value };
    let mean = values.iter().map(|value| near(*value)).sum::<f64>() / values.len() as f64;
    if directions { wrap_degrees(mean) } else { mean }
}

/// What a relation comes to where its operands have these values: abscissas and ordinates of places, or single results. In the order of its results; none
/// where places give no circle. `directions`: whether single results are directions. It shares no expression with programs.
pub fn related_values(relation: Relation, of: &[[f64; 2]], directions: bool) -> Vec<Option<f64>> {
    let mean = |axis: usize| of.iter().map(|place| place[axis]).sum::<f64>() / of.len() as f64;
    match (relation, of) {
        (Relation::Line, [from, to]) => {
            let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
            vec![Some(dx.hypot(dy)), Some(dy.atan2(dx).to_degrees())]
        }
        (Relation::Difference, [first, second]) => vec![Some(first[0] - second[0])],
        (Relation::Mean, _) => vec![Some(mean_of(&of.iter().map(|value| value[0]).collect::<Vec<_>>(), directions))],
        (Relation::Center, _) => vec![Some(mean(0)), Some(mean(1))],
        (Relation::PitchCircle, _) => {
            let places: Vec<_> = of.iter().map(|[x, y]| crate::geom::Vec2::new(*x, *y)).collect();
            match crate::formula::fit_circle(&places) {
                Some(fit) => {
                    let off = places.iter().map(|place| (place.distance(fit.center) - fit.radius).powi(2));
                    let residual = (off.sum::<f64>() / places.len() as f64).sqrt();
                    vec![Some(fit.center.x), Some(fit.center.y), Some(2.0 * fit.radius), Some(residual)]
                }
                None => vec![None; 4],
            }
        }
        (Relation::Line | Relation::Difference, _) => vec![None; 2],
    }
}
