//! Dependencies between the cycles of a set-up: the results that place a cycle, and the resulting shift of each of its moves.

use crate::formula::{CycleRotation, Formula, Variable};
use crate::geom::Vec3;
use crate::num::tidy;
use crate::path::{CallBlock, CallSequence, Path, Quantity, ShiftTerm, Shifts};

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
    pub sizes: Vec<(usize, Sensitivity)>,
    /// Whether the cycle is native: its sensitivities follow when its calls are final ([`CycleTransform::sense`]), also those to positions.
    pub native: bool,
}

/// Largest deviation from linearity that counts as rounding, mm.
const EVEN: f64 = 1e-7;

/// Derivative of a path by one followed value, mm per mm.
#[derive(Clone, Debug, Default)]
pub struct Sensitivity {
    /// Derivative of the start.
    pub start: Vec3,
    pub moves: Vec<Vec3>,
    /// Derivatives of the words in each block of its native calls.
    pub words: Vec<Vec<f64>>,
}

/// Followed value of a native cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FollowedValue {
    /// Coordinate of the origin.
    Place(usize),
    /// A size, by its index among the followed sizes.
    Size(usize),
}

impl Sensitivity {
    /// Compares the paths for the smallest, the nominal and the largest value, each `by` mm apart. `None` if the paths differ otherwise, or if moves or words are
    /// not linear in the value. For a size the formula must stay the same, too: a position is in none.
    pub fn of(
        [less, path, more]: [&Path; 3],
        by: f64,
        value: FollowedValue,
    ) -> Option<Sensitivity> {
        let is_size = matches!(value, FollowedValue::Size(_));
        let same = |other: &Path| {
            let moves = path.moves.iter().zip(&other.moves);
            let touches = path.touches.iter().zip(&other.touches);
            path.moves.len() == other.moves.len()
                && path.touches.len() == other.touches.len()
                && path.start.is_some() == other.start.is_some()
                && (!is_size || path.formula.computes_as(&other.formula))
                && moves.into_iter().all(|(a, b)| {
                    let arcs = match (a.arc, b.arc) {
                        (None, None) => true,
                        // An arc moves with its ends.
                        (Some(a), Some(b)) => !is_size && (a.sweep - b.sweep).abs() < EVEN,
                        _ => false,
                    };
                    (a.feed, a.purpose, a.step) == (b.feed, b.purpose, b.step) && arcs
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
        Some(Sensitivity {
            start,
            moves: moves.collect::<Option<_>>()?,
            words: word_rates([less, path, more].map(|path| path.calls.as_deref()), by)?,
        })
    }
}

/// Derivatives of the words of native calls. `None` if the calls differ otherwise, or if a word is not linear.
fn word_rates(calls: [Option<&CallSequence>; 3], by: f64) -> Option<Vec<Vec<f64>>> {
    let [Some(less), Some(own), Some(more)] = calls else {
        return calls.iter().all(Option::is_none).then(Vec::new);
    };
    if less.blocks.len() != own.blocks.len() || more.blocks.len() != own.blocks.len() {
        return None;
    }
    let blocks = (0..own.blocks.len()).map(|i| {
        let [less, own, more] = [less, own, more].map(|calls| &calls.blocks[i].0);
        let block = own;
        if !own.is_like(less) || !own.is_like(more) {
            return None;
        }
        let [less, own, more] = [less, own, more].map(CallBlock::values);
        let words = less.into_iter().zip(own).zip(more).enumerate();
        let rate = |(word, ((less, own), more)): (usize, ((Quantity, Quantity), Quantity))| {
            if block.is_wanted(word) {
                return Some(0.0);
            }
            let values = [less, own, more].map(Quantity::value);
            let rate = tidy((values[2] - values[1]) / by);
            let even = ((values[2] - values[1]) - (values[1] - values[0])).abs() <= EVEN;
            (even && (rate == 0.0 || matches!(own, Quantity::Length(_)))).then_some(rate)
        };
        words.map(rate).collect::<Option<Vec<f64>>>()
    });
    blocks.collect()
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
    /// Followed sizes; of a native cycle also positions.
    sensed: Vec<(FollowedValue, ShiftTerm, Sensitivity)>,
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
            let term = ShiftTerm {
                by: off,
                factor: 1.0,
                length: false,
                most: reaches.position,
            };
            if follows.native {
                let value = FollowedValue::Place(axis);
                own.sensed.push((value, term, Sensitivity::default()));
            } else {
                own.shift[axis] = Some(term);
            }
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
        for (n, ((result, along), name)) in follows.sizes.into_iter().zip(GROWTHS).enumerate() {
            let Some(off) = known(result).or_else(|| formula.shift(result, name)) else {
                continue;
            };
            own.follows.push(Dependency {
                result,
                off,
                axis: None,
            });
            own.sensed.push((
                FollowedValue::Size(n),
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
            .chain(self.sensed.iter().map(|(_, term, _)| term))
            .map(|term| term.by)
            .chain(turn)
    }

    /// Whether the position follows a result along an axis.
    pub fn follows_axis(&self, axis: usize) -> bool {
        self.follows.iter().any(|follow| follow.axis == Some(axis))
    }

    /// Followed values of a native cycle, each with the variable that holds its deviation.
    pub fn followed(&self) -> impl Iterator<Item = (FollowedValue, Variable)> {
        self.sensed.iter().map(|(value, term, _)| (*value, term.by))
    }

    /// Takes the sensitivities of a native cycle, in the order of [`CycleTransform::followed`].
    pub fn sense(&mut self, sensitivities: Vec<Sensitivity>) {
        for ((.., own), known) in self.sensed.iter_mut().zip(sensitivities) {
            *own = known;
        }
    }

    /// Terms that shift a word of a block of its native calls.
    pub fn word_shifts(&self, block: usize, word: usize) -> Vec<ShiftTerm> {
        let term = |(_, term, own): &(FollowedValue, ShiftTerm, Sensitivity)| {
            let rate = *own.words.get(block)?.get(word)?;
            (rate != 0.0).then_some(ShiftTerm {
                factor: rate,
                ..*term
            })
        };
        self.sensed.iter().filter_map(term).collect()
    }

    /// Rotation of the cycle, if it follows a direction.
    pub fn turn(&self) -> Option<&CycleRotation<Variable>> {
        self.turn.as_ref().map(|(turn, _)| turn)
    }

    /// Shift of a position of the cycle. `along` picks the derivative of that position by a followed value.
    pub fn shifts(&self, place: Vec3, along: impl Fn(&Sensitivity) -> Vec3) -> Shifts {
        let mut shifts = self
            .shift
            .map(|term| term.into_iter().collect::<Vec<ShiftTerm>>());
        for (_, term, own) in &self.sensed {
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
