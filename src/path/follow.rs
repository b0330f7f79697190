//! Dependencies between the cycles of a set-up: the results that place a cycle, and the resulting shift of each of its moves.

use crate::formula::{CycleRotation, Formula, Variable};
use crate::geom::Vec3;
use crate::num::tidy;
use crate::path::Path;

/// Results that a cycle follows: those of earlier cycles and relations, each by its index in the joined path.
#[derive(Clone, Debug, Default)]
pub struct Dependencies {
    /// Results that the position follows, along X, Y and Z.
    pub place: [Option<usize>; 3],
    /// Direction that the rotation follows.
    pub rotation: Option<usize>,
    /// Centre of that rotation in the work coordinate system of the nominal part, mm.
    pub about: Vec3,
    /// Sizes that the cycle follows, each with the sensitivity of its moves.
    pub sizes: Vec<(usize, SizeSensitivity)>,
}

/// Derivative of the path's positions by one size, mm per mm.
#[derive(Clone, Debug, Default)]
pub struct SizeSensitivity {
    /// Derivative of the start.
    pub start: Vec3,
    pub moves: Vec<Vec3>,
}

impl SizeSensitivity {
    /// Compares the paths for the smallest, the nominal and the largest size, each `by` mm apart. `None` if the paths differ otherwise, or if the moves are not
    /// linear in the size.
    pub fn of(less: &Path, path: &Path, more: &Path, by: f64) -> Option<SizeSensitivity> {
        /// Largest deviation from linearity that counts as rounding, mm.
        const EVEN: f64 = 1e-7;
        let same = |other: &Path| {
            let moves = path.moves.iter().zip(&other.moves);
            let touches = path.touches.iter().zip(&other.touches);
            path.moves.len() == other.moves.len()
                && path.touches.len() == other.touches.len()
                && path.start.is_some() == other.start.is_some()
                && path.formula.computes_as(&other.formula)
                && moves.into_iter().all(|(a, b)| {
                    (a.feed, a.purpose, a.step) == (b.feed, b.purpose, b.step)
                        && a.arc.is_none()
                        && b.arc.is_none()
                })
                && touches.into_iter().all(|(a, b)| {
                    a.vector.distance(b.vector) < EVEN
                        && (a.search - b.search).abs() < EVEN
                        && a.sample == b.sample
                })
        };
        if !same(less) || !same(more) {
            return None;
        }
        let rate = |less: Vec3, own: Vec3, more: Vec3| {
            let even = ((more - own) - (own - less)).abs().max_element() <= EVEN;
            even.then(|| Vec3::from_array(((more - own) / by).to_array().map(tidy)))
        };
        let moves = (0..path.moves.len())
            .map(|i| rate(less.moves[i].to, path.moves[i].to, more.moves[i].to));
        let start = match (less.start, path.start, more.start) {
            (Some(less), Some(own), Some(more)) => rate(less, own, more)?,
            _ => Vec3::ZERO,
        };
        Some(SizeSensitivity {
            start,
            moves: moves.collect::<Option<_>>()?,
        })
    }
}

/// A variable that shifts a position along an axis, with its factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShiftTerm {
    pub by: Variable,
    /// Factor of the variable: mm if the variable has no unit, else a plain number.
    pub factor: f64,
    /// Whether the factor is a length.
    pub length: bool,
    /// Largest absolute value of the variable.
    most: f64,
}

/// Terms that shift a position along X, Y and Z.
pub type Shifts = [Vec<ShiftTerm>; 3];

/// A position without any shift.
pub const NO_SHIFT: &Shifts = &[const { Vec::new() }; 3];

/// Largest shift of a position along X, Y and Z, mm.
pub fn most(shifts: &Shifts) -> Vec3 {
    let along = |axis: usize| {
        shifts[axis]
            .iter()
            .map(|term| (term.factor * term.most).abs())
            .sum()
    };
    Vec3::new(along(0), along(1), along(2))
}

/// Largest change of the distance between the two ends of a move, mm, for these shifts of the ends.
pub fn far_apart(from: &Shifts, to: &Shifts) -> f64 {
    let factor = |of: &[ShiftTerm], by: Variable| {
        of.iter()
            .find(|term| term.by == by)
            .map_or(0.0, |term| term.factor)
    };
    let along = |axis: usize| {
        let (a, b) = (&from[axis], &to[axis]);
        let left = a
            .iter()
            .filter(|term| b.iter().all(|other| other.by != term.by));
        left.chain(b)
            .map(|term| (factor(b, term.by) - factor(a, term.by)).abs() * term.most)
            .sum()
    };
    Vec3::new(along(0), along(1), along(2)).length()
}

/// A result that a cycle follows, with the variable that holds its deviation from nominal, mm or degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dependency {
    /// Index of the result in the joined path.
    pub result: usize,
    pub off: Variable,
    /// Axis of a followed position; `None` for sizes and directions.
    pub axis: Option<usize>,
}

/// Limits of followed results: a program stops beyond them. Lengths in mm, angles in degrees.
#[derive(Clone, Copy, Debug, Default)]
pub struct DependencyLimits {
    pub position: f64,
    pub size: f64,
    pub angle: f64,
    /// Millimetres in a unit of the program.
    pub unit: f64,
}

/// Position, rotation and growth that earlier results give a cycle.
#[derive(Clone, Debug, Default)]
pub struct CycleTransform {
    /// All results that the cycle follows.
    pub follows: Vec<Dependency>,
    shift: [Option<ShiftTerm>; 3],
    turn: Option<(CycleRotation<Variable>, DependencyLimits)>,
    sizes: Vec<(ShiftTerm, SizeSensitivity)>,
}

/// Names of the variables that shift an axis.
const SHIFTS: [&str; 3] = ["shift_x", "shift_y", "shift_z"];

/// Names of the variables for sizes. No cycle has more sizes that are lengths.
const GROWTHS: [&str; 2] = ["growth_1", "growth_2"];

impl CycleTransform {
    /// Adds the deviations of the followed results to the joined formula, unless an earlier cycle has added them.
    pub fn of(
        follows: Dependencies,
        formula: &mut Formula,
        (axes, reaches): ([usize; 3], DependencyLimits),
        before: &[&CycleTransform],
    ) -> Self {
        let mut own = CycleTransform::default();
        let known = |result: usize| {
            let mut all = before.iter().flat_map(|other| &other.follows);
            all.find(|follow| follow.result == result)
                .map(|follow| follow.off)
        };
        let turned = |angle: Variable| {
            before
                .iter()
                .filter_map(|other| other.turn())
                .find(|turn| turn.angle == angle)
        };
        for (axis, (of, name)) in follows.place.into_iter().zip(SHIFTS).enumerate() {
            let Some(result) = of else { continue };
            let Some(off) = known(result).or_else(|| formula.shift(result, name)) else {
                continue;
            };
            own.follows.push(Dependency {
                result,
                off,
                axis: Some(axis),
            });
            own.shift[axis] = Some(ShiftTerm {
                by: off,
                factor: 1.0,
                length: false,
                most: reaches.position,
            });
        }
        if let Some((result, direction)) = follows
            .rotation
            .and_then(|of| Some((of, formula.results[of].variable?)))
        {
            let [angle, sine, cosine] = match known(result).and_then(turned) {
                Some(turn) => [turn.angle, turn.sine, turn.cosine],
                None => formula.turns_next(direction, formula.results[result].nominal),
            };
            own.follows.push(Dependency {
                result,
                off: angle,
                axis: None,
            });
            let [a, o, _] = axes;
            let shift = [a, o].map(|axis| own.shift[axis].map(|term| term.by));
            let about = [a, o].map(|axis| follows.about[axis]);
            own.turn = Some((
                CycleRotation {
                    axes: [a, o],
                    about,
                    angle,
                    sine,
                    cosine,
                    shift,
                },
                reaches,
            ));
        }
        for ((result, along), name) in follows.sizes.into_iter().zip(GROWTHS) {
            let Some(off) = known(result).or_else(|| formula.shift(result, name)) else {
                continue;
            };
            own.follows.push(Dependency {
                result,
                off,
                axis: None,
            });
            own.sizes.push((
                ShiftTerm {
                    by: off,
                    factor: 1.0,
                    length: false,
                    most: reaches.size,
                },
                along,
            ));
        }
        own
    }

    /// Variables that shift the moves of the cycle.
    pub fn shift_variables(&self) -> impl Iterator<Item = Variable> {
        let turn = self
            .turn()
            .into_iter()
            .flat_map(|turn| [turn.sine, turn.cosine]);
        self.shift
            .iter()
            .flatten()
            .chain(self.sizes.iter().map(|(term, _)| term))
            .map(|term| term.by)
            .chain(turn)
    }

    /// Rotation of the cycle, if it follows a direction.
    pub fn turn(&self) -> Option<&CycleRotation<Variable>> {
        self.turn.as_ref().map(|(turn, _)| turn)
    }

    /// Shift of a position of the cycle. `along` picks the derivative of that position by a size.
    pub fn shifts(&self, place: Vec3, along: impl Fn(&SizeSensitivity) -> Vec3) -> Shifts {
        let mut shifts = self
            .shift
            .map(|term| term.into_iter().collect::<Vec<ShiftTerm>>());
        for (term, own) in &self.sizes {
            let rate = along(own);
            for axis in (0..3).filter(|axis| rate[*axis] != 0.0) {
                shifts[axis].push(ShiftTerm {
                    factor: rate[axis],
                    ..*term
                });
            }
        }
        let Some((
            CycleRotation {
                axes: [a, o],
                about,
                sine,
                cosine,
                ..
            },
            reaches,
        )) = self.turn.as_ref()
        else {
            return shifts;
        };
        // Programs print positions with this precision. More digits would make blocks longer than controls read.
        let digits = if reaches.unit == 1.0 { 1e4 } else { 1e5 };
        let arm = [place[*a] - about[0], place[*o] - about[1]]
            .map(|x| (x / reaches.unit * digits).round() / digits * reaches.unit);
        let angle = reaches.angle.min(180.0).to_radians();
        let most = |by: Variable| {
            if by == *cosine {
                1.0 - angle.cos()
            } else {
                angle.min(std::f64::consts::FRAC_PI_2).sin()
            }
        };
        let terms = [
            (*a, *cosine, arm[0]),
            (*a, *sine, -arm[1]),
            (*o, *cosine, arm[1]),
            (*o, *sine, arm[0]),
        ];
        for (axis, by, factor) in terms.into_iter().filter(|(_, _, factor)| *factor != 0.0) {
            shifts[axis].push(ShiftTerm {
                by,
                factor,
                length: true,
                most: most(by),
            });
        }
        shifts
    }
}
