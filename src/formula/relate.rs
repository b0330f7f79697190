//! Relations between features: results computed from results, in the joint formula.

use crate::formula::draft::{Draft, Expr, Value};
use crate::formula::lower;
use crate::formula::node::Variable;
use crate::formula::{
    CircleFit, Coordinate, CycleSamples, Formula, Name, OffsetCorrection, ResultDef, Role,
    fit_circle,
};
use crate::geom::Vec2;
use crate::num::wrap_degrees;
use crate::text::{Text, text, words};

/// A kind of relation with its computation. Check, types, schema, the manual's table and the page's menu follow from its row in [`RELATIONS`].
#[derive(Debug)]
pub struct RelationDef {
    /// Word in a job.
    pub key: &'static str,
    /// Label on the page.
    pub label: &'static str,
    /// Description of its results for the manual.
    pub says: &'static str,
    /// Whether its operands are positions; otherwise single results, all lengths or all angles.
    pub places: bool,
    /// Smallest number of operands.
    pub least: usize,
    /// Largest number of operands; `None` is any number.
    pub most: Option<usize>,
    /// Codes of its results, in order. `.angle` is added to the first if the operands are angles.
    pub results: &'static [&'static str],
    /// Drawing in a picture.
    pub drawing: RelationDrawing,
    write: Write,
    values: Values,
    problem: fn(&[[f64; 2]]) -> Option<Text>,
}

/// Drawing of a relation in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RelationDrawing {
    /// The line from the first place to the second.
    Line,
    /// Lines from the mean position (results 1 and 2) to each position.
    Middle,
    /// The fitted circle: center (results 1 and 2) and diameter (result 3).
    Circle,
    /// Nothing: single values have no position.
    Nothing,
}

/// Adds the computation with these operands to a formula; of a single result only the first of the two entries counts. `heights`: whether all operands are
/// measured heights. Returns the correction of a work offset that the relation gives.
type Write = for<'f> fn(
    f: &'f Draft,
    of: &[[MeasuredValue<'f>; 2]],
    heights: bool,
) -> Option<OffsetCorrection>;

/// Results for operands with these values. `directions`: whether single results are directions.
type Values = fn(of: &[[f64; 2]], directions: bool) -> Vec<Option<f64>>;

/// Every kind of relation.
pub static RELATIONS: [RelationDef; 5] = [
    RelationDef {
        key: "line",
        label: words!("Distance and direction"),
        says: "the distance, and the direction from the first to the second",
        places: true,
        least: 2,
        most: Some(2),
        results: &["distance", "rotation"],
        drawing: RelationDrawing::Line,
        write: line,
        values: line_of,
        problem: |of| {
            (apart(of[0], of[1]) < APART)
                .then(|| text!("Both positions are the same on the nominal part, so there is no direction between them"))
        },
    },
    RelationDef {
        key: "center",
        label: words!("Midpoint of positions"),
        says: "their mean, as the middle of a rectangle from its corners",
        places: true,
        least: 2,
        most: None,
        results: &["center.x", "center.y"],
        drawing: RelationDrawing::Middle,
        write: middle,
        values: |of, _| {
            [0, 1]
                .map(|axis| Some(of.iter().map(|place| place[axis]).sum::<f64>() / of.len() as f64))
                .to_vec()
        },
        problem: |_| None,
    },
    RelationDef {
        key: "pitch-circle",
        label: words!("Pitch circle"),
        says: "the circle of least squares through them (Kåsa)",
        places: true,
        least: 3,
        most: None,
        results: &["center.x", "center.y", "diameter", "residual"],
        drawing: RelationDrawing::Circle,
        write: pitch_circle,
        values: |of, _| pitch_circle_of(of),
        problem: |of| {
            let flat = |radius: f64| radius.is_nan() || radius > 10_000.0;
            fit(of)
                .is_none_or(|fit| flat(fit.radius))
                .then(|| text!("These positions are on one line: they define no circle"))
        },
    },
    RelationDef {
        key: "difference",
        label: words!("Difference"),
        says: "the first less the second, as the step between two faces, or how far two walls are from parallel",
        places: false,
        least: 2,
        most: Some(2),
        results: &["difference"],
        drawing: RelationDrawing::Nothing,
        write: difference,
        values: |of, _| vec![Some(of[0][0] - of[1][0])],
        problem: |_| None,
    },
    RelationDef {
        key: "mean",
        label: words!("Mean"),
        says: "their mean. The mean of probed heights, such as `TOP.point.z`, is itself a height: Z can be written from it, and a cycle can follow it, `\"=FACE.z\"`",
        places: false,
        least: 2,
        most: None,
        results: &["mean"],
        drawing: RelationDrawing::Nothing,
        write: mean,
        values: |of, directions| {
            vec![Some(mean_of(
                &of.iter().map(|value| value[0]).collect::<Vec<_>>(),
                directions,
            ))]
        },
        problem: |_| None,
    },
];

/// Nominal positions closer than this have no direction, mm.
const APART: f64 = 0.1;

/// A kind of relation, by its row.
pub type Relation = &'static RelationDef;

impl RelationDef {
    /// The kind with this word.
    pub fn find(key: &str) -> Option<Relation> {
        RELATIONS.iter().find(|def| def.key == key)
    }

    /// Reason why operands with these nominal values cannot give the relation: abscissas and ordinates of positions, or single results.
    pub fn problem(&self, of: &[[f64; 2]]) -> Option<Text> {
        (self.problem)(of)
    }

    /// Results for operands with these values, in order; `None` if positions give no circle. `directions`: whether single results are directions. Independent
    /// of the expressions that are printed into programs.
    pub fn values(&self, of: &[[f64; 2]], directions: bool) -> Vec<Option<f64>> {
        (self.values)(of, directions)
    }
}

/// Operand of a relation: abscissa and ordinate of a position, or a single result. Indices of measured results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    Place([usize; 2]),
    Result(usize),
}

/// A relation with its operands.
#[derive(Clone, Debug)]
pub struct RelationTerm {
    pub relation: Relation,
    pub of: Vec<Operand>,
    /// Whether all operands are measured heights, so that a height can be written.
    pub heights: bool,
}

/// A measured value and its nominal one.
#[derive(Clone, Copy)]
struct MeasuredValue<'f> {
    value: Value<'f>,
    nominal: f64,
    role: Role,
}

impl Formula {
    /// Adds a relation with its name. Its results come last. Returns the correction of a work offset that it gives.
    pub fn relate(&mut self, name: &str, related: &RelationTerm) -> Option<OffsetCorrection> {
        // A relation has no samples.
        let first_sample = self.cycles.last().map_or(0, |last| last.first_sample);
        self.continued(name, first_sample, |draft| write(draft, related))
    }

    /// Continues the formula with the assignments and results of a named cycle or relation.
    pub(super) fn continued<T>(
        &mut self,
        name: &str,
        first_sample: usize,
        write: impl FnOnce(&Draft) -> T,
    ) -> T {
        let (assignments, results) = (self.assignments.len(), self.results.len());
        let cycle = self.cycles.len() as u16;
        let rest = (std::mem::take(&mut self.cycles), self.datum, self.turn);
        let draft = Draft::continuing(std::mem::take(self));
        let written = write(&draft);
        *self = draft.finish(rest.1);
        (self.cycles, self.turn) = (rest.0, rest.2);
        self.assignments[assignments..]
            .iter_mut()
            .for_each(|assignment| assignment.cycle = cycle);
        self.results[results..]
            .iter_mut()
            .for_each(|result| result.cycle = cycle);
        self.cycles.push(CycleSamples {
            name: name.to_owned(),
            first_sample,
        });
        written
    }
}

fn write(
    f: &Draft,
    RelationTerm {
        relation,
        of,
        heights,
    }: &RelationTerm,
) -> Option<OffsetCorrection> {
    let known = |result: usize| {
        let ResultDef {
            nominal,
            role,
            variable,
            ..
        } = f.result_at(result);
        MeasuredValue {
            value: f.known(variable.unwrap_or(Variable(0))),
            nominal,
            role,
        }
    };
    let place = |operand: &Operand| match *operand {
        Operand::Place(axes) => axes.map(known),
        Operand::Result(result) => [known(result); 2],
    };
    let of: Vec<[MeasuredValue<'_>; 2]> = of.iter().map(place).collect();
    (relation.write)(f, &of, *heights)
}

fn middle<'f>(
    f: &'f Draft,
    of: &[[MeasuredValue<'f>; 2]],
    _heights: bool,
) -> Option<OffsetCorrection> {
    let count = of.len() as f64;
    let axis = |axis: usize, name: &'static str| {
        let sum = f.sum(of.iter().map(|place| place[axis].value));
        (
            f.set(name, sum / f.number(count)),
            of.iter().map(|place| place[axis].nominal).sum::<f64>() / count,
        )
    };
    let (x, y) = (axis(0, "center_x"), axis(1, "center_y"));
    Some(center(f, x, y))
}

fn pitch_circle<'f>(
    f: &'f Draft,
    of: &[[MeasuredValue<'f>; 2]],
    _heights: bool,
) -> Option<OffsetCorrection> {
    let nominal: Vec<[f64; 2]> = of
        .iter()
        .map(|place| place.map(|known| known.nominal))
        .collect();
    let (middle, radius) =
        fit(&nominal).map_or((Vec2::NAN, f64::NAN), |fit| (fit.center, fit.radius));
    let at = |k: usize, axis: usize| Expr::from(of[k][axis].value);
    let [x, y, r, residual] = lower::circle(f, 1, 0..of.len(), &at);
    let (x, y) = (f.set("center_x", x), f.set("center_y", y));
    let diameter = f.set("diameter", f.number(2.0) * r);
    let datum = center(f, (x, middle.x), (y, middle.y));
    f.result(
        "diameter",
        Role::Size,
        words!("Diameter of the pitch circle"),
        2.0 * radius,
        Some(diameter),
    );
    let meaning = words!("Root mean square distance of the positions from the pitch circle");
    f.result("residual", Role::Residual, meaning, 0.0, Some(residual));
    Some(datum)
}

/// Circle through positions.
fn fit(of: &[[f64; 2]]) -> Option<CircleFit> {
    fit_circle(
        &of.iter()
            .map(|[x, y]| Vec2::new(*x, *y))
            .collect::<Vec<_>>(),
    )
}

fn pitch_circle_of(of: &[[f64; 2]]) -> Vec<Option<f64>> {
    let Some(fit) = fit(of) else {
        return vec![None; 4];
    };
    let off = of
        .iter()
        .map(|[x, y]| (Vec2::new(*x, *y).distance(fit.center) - fit.radius).powi(2));
    let residual = (off.sum::<f64>() / of.len() as f64).sqrt();
    [fit.center.x, fit.center.y, 2.0 * fit.radius, residual]
        .map(Some)
        .to_vec()
}

/// States a position as results, and returns the correction of a work offset that it gives.
fn center<'f>(f: &'f Draft, x: (Value<'f>, f64), y: (Value<'f>, f64)) -> OffsetCorrection {
    f.result(
        "center.x",
        Role::Abscissa,
        words!("Centre, abscissa"),
        x.1,
        Some(x.0),
    );
    f.result(
        "center.y",
        Role::Ordinate,
        words!("Centre, ordinate"),
        y.1,
        Some(y.0),
    );
    OffsetCorrection::point(x, y)
}

/// Distance, and the direction as nominal plus deviation: near half a turn a control may return an angle a whole turn away.
fn line<'f>(
    f: &'f Draft,
    of: &[[MeasuredValue<'f>; 2]],
    _heights: bool,
) -> Option<OffsetCorrection> {
    let [from, to] = [of[0], of[1]];
    let [dx, dy] =
        [("dx", 0), ("dy", 1)].map(|(name, axis)| f.set(name, to[axis].value - from[axis].value));
    let [nx, ny] = [0, 1].map(|axis| to[axis].nominal - from[axis].nominal);
    let length = nx.hypot(ny);
    let distance = f.set("distance", (dx * dx + dy * dy).sqrt());
    let (cos, sin) = (nx / length, ny / length);
    // The angle needs its own assignment: a control may have to bring it into ±180°.
    let turned = f.set(
        "turned",
        f.project(dy, dx, (cos, -sin))
            .atan2(f.project(dx, dy, (cos, sin))),
    );
    let nominal = ny.atan2(nx).to_degrees();
    let rotation = f.set("rotation", turned + f.number(nominal));
    f.result(
        "distance",
        Role::Size,
        words!("Distance from the first position to the second"),
        length,
        Some(distance),
    );
    f.result(
        "rotation",
        Role::Direction,
        words!("Direction from the first position to the second"),
        nominal,
        Some(rotation),
    );
    None
}

fn apart(from: [f64; 2], to: [f64; 2]) -> f64 {
    (to[0] - from[0]).hypot(to[1] - from[1])
}

fn line_of(of: &[[f64; 2]], _directions: bool) -> Vec<Option<f64>> {
    let [from, to] = [of[0], of[1]];
    vec![
        Some(apart(from, to)),
        Some((to[1] - from[1]).atan2(to[0] - from[0]).to_degrees()),
    ]
}

/// Deviation of a value from nominal; of a direction within ±180°. `number` tells the names apart.
fn off<'f>(f: &'f Draft, number: usize, known: MeasuredValue<'f>) -> Expr<'f> {
    let constant = if known.role.is_angle() {
        f.number(known.nominal)
    } else {
        f.length(known.nominal)
    };
    let off = known.value - constant;
    if known.role != Role::Direction || known.nominal.abs() <= 90.0 {
        return off;
    }
    let away = f.set(Name::new("away", number), off);
    f.set(Name::new("turned", number), away.sin().atan2(away.cos()))
        .into()
}

/// Role of a result computed from single results: sizes give a size, other lengths a coordinate.
fn role_of(known: &[MeasuredValue<'_>]) -> Role {
    match known[0].role {
        Role::Size => Role::Size,
        Role::Residual => Role::Residual,
        Role::Angle | Role::Direction | Role::Turn => Role::Angle,
        _ => Role::Reading,
    }
}

fn difference<'f>(
    f: &'f Draft,
    of: &[[MeasuredValue<'f>; 2]],
    _heights: bool,
) -> Option<OffsetCorrection> {
    let [first, second] = [of[0][0], of[1][0]];
    let nominal = first.nominal - second.nominal;
    if first.role.is_angle() {
        // Between directions the smaller angle counts.
        let directions = first.role == Role::Direction || second.role == Role::Direction;
        let nominal = if directions {
            wrap_degrees(nominal)
        } else {
            nominal
        };
        let value = off(f, 1, first) - off(f, 2, second) + f.number(nominal);
        let value = f.set("difference", value);
        f.result(
            "difference.angle",
            Role::Angle,
            words!("First angle less the second"),
            nominal,
            Some(value),
        );
    } else {
        let value = f.set("difference", first.value - second.value);
        f.result(
            "difference",
            Role::Size,
            words!("First result less the second"),
            nominal,
            Some(value),
        );
    }
    None
}

fn mean<'f>(
    f: &'f Draft,
    of: &[[MeasuredValue<'f>; 2]],
    heights: bool,
) -> Option<OffsetCorrection> {
    let known: Vec<MeasuredValue<'f>> = of.iter().map(|operand| operand[0]).collect();
    let count = known.len() as f64;
    let nominal = mean_of(
        &known.iter().map(|known| known.nominal).collect::<Vec<_>>(),
        known[0].role == Role::Direction,
    );
    let value = if known[0].role.is_angle() {
        let sum = f.sum(
            known
                .iter()
                .enumerate()
                .map(|(i, known)| off(f, i + 1, *known)),
        );
        let value = f.set("mean", sum / f.number(count) + f.number(nominal));
        let directions = known.iter().all(|known| known.role == Role::Direction);
        let role = if directions {
            Role::Direction
        } else {
            Role::Angle
        };
        f.result(
            "mean.angle",
            role,
            words!("Mean of the angles"),
            nominal,
            Some(value),
        );
        value
    } else {
        let sum = f.sum(known.iter().map(|known| known.value));
        let value = f.set("mean", sum / f.number(count));
        f.result(
            "mean",
            role_of(&known),
            words!("Mean of the results"),
            nominal,
            Some(value),
        );
        value
    };
    heights.then(|| OffsetCorrection::of([None, None, Some(Coordinate::measured(value, nominal))]))
}

/// Mean of the values. Directions are averaged about the first one, from which none differs by more than half a turn.
fn mean_of(values: &[f64], directions: bool) -> f64 {
    let first = values[0];
    let near = |value: f64| {
        if directions {
            first + wrap_degrees(value - first)
        } else {
            value
        }
    };
    let mean = values.iter().map(|value| near(*value)).sum::<f64>() / values.len() as f64;
    if directions { wrap_degrees(mean) } else { mean }
}
