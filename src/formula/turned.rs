//! The formula of a cycle that follows a measured direction: it computes in the frame of the drawing.
//!
//! The cycle is rotated by δ, the deviation of the direction from nominal, about a point p that may be shifted by s. Each trigger t is first rotated back to
//! the unrotated part: p + R(−δ)(t − p − s). The cycle's own formula continues from there. Its positions are rotated forward, p + s + R(δ)(q − p), and δ is
//! added to its directions.

use std::cell::RefCell;

use crate::formula::draft::{Draft, Expr, Value};
use crate::formula::lower::{self, TriggerSource};
use crate::formula::node::Variable;
use crate::formula::{Coordinate, Formula, Name, OffsetCorrection, ResultDef, Role, UsedTriggers};

/// Rotation of a cycle and its centre.
#[derive(Clone, Copy, Debug)]
pub struct CycleRotation<T> {
    /// Axes of abscissa and ordinate.
    pub axes: [usize; 2],
    /// Centre of the rotation on the nominal part: abscissa and ordinate, mm.
    pub about: [f64; 2],
    /// Angle of the rotation, degrees.
    pub angle: T,
    /// Sine of the angle, and its cosine less 1.
    pub sine: T,
    pub cosine: T,
    /// Shift of the centre along abscissa and ordinate, mm.
    pub shift: [Option<T>; 2],
}

impl CycleRotation<f64> {
    /// Whether all its values are known.
    pub fn is_known(&self) -> bool {
        let all = [self.angle, self.sine, self.cosine];
        all.into_iter()
            .chain(self.shift.into_iter().flatten())
            .all(f64::is_finite)
    }
}

impl<T: Copy> CycleRotation<T> {
    pub fn map<U>(&self, change: impl Fn(T) -> U) -> CycleRotation<U> {
        CycleRotation {
            axes: self.axes,
            about: self.about,
            angle: change(self.angle),
            sine: change(self.sine),
            cosine: change(self.cosine),
            shift: self.shift.map(|shift| shift.map(&change)),
        }
    }
}

/// A coordinate of a position.
#[derive(Clone, Copy, PartialEq)]
enum Known {
    /// Measured: the variable that holds it.
    Measured(Variable),
    /// Not measured: nominal, mm.
    Nominal(f64),
}

impl Known {
    fn new(measured: Option<Variable>, nominal: f64) -> Known {
        measured.map_or(Known::Nominal(nominal), Known::Measured)
    }
}

/// Abscissa and ordinate of a position. Positions are compared by their variables: nominal values of one position may be rounded differently.
type Pair = [Known; 2];

/// Result of rotating the formula of a cycle.
struct TurnedFormula {
    results: Vec<ResultDef>,
    datum: Option<OffsetCorrection>,
}

impl Formula {
    /// Whether a cycle with this formula can be rotated: its positions have abscissa and ordinate, and it writes no angle.
    pub fn can_turn(&self) -> bool {
        self.results.iter().all(|result| match result.role {
            Role::Abscissa | Role::Ordinate | Role::Reading => coordinate_of(result.code).is_some(),
            Role::Turn => false,
            _ => true,
        })
    }

    /// Adds the formula of the next cycle, which is rotated by values of this one. Returns the shift of its variable indices, and the correction of a work
    /// offset.
    pub fn join_turned(
        &mut self,
        name: &str,
        own: &Formula,
        first_sample: usize,
        turn: &CycleRotation<Variable>,
    ) -> (u32, Option<OffsetCorrection>) {
        let (later, cycle) = (self.assignments.len() as u32, self.cycles.len() as u16);
        let TurnedFormula { results, datum } = self.continued(name, first_sample, |draft| {
            write(
                own,
                draft,
                first_sample,
                turn.map(|known| draft.known(known).into()),
            )
        });
        self.results.extend(
            results
                .into_iter()
                .map(|result| ResultDef { cycle, ..result }),
        );
        (later, datum)
    }

    /// The formula of a cycle with a known rotation.
    pub fn turned(&self, turn: &CycleRotation<f64>) -> Formula {
        let draft = Draft::with_room_for(crate::formula::MOST_SAMPLES);
        let numbers = CycleRotation {
            shift: [None; 2],
            ..turn.map(|number| draft.number(number))
        };
        let lengths = turn.shift.map(|shift| shift.map(|mm| draft.length(mm)));
        let TurnedFormula { results, datum } = write(
            self,
            &draft,
            0,
            CycleRotation {
                shift: lengths,
                ..numbers
            },
        );
        Formula {
            results,
            turn: self.turn,
            ..draft.finish(datum)
        }
    }
}

/// The position that a code is a coordinate of, and the axis: `center.y` is axis 1 of `center`.
fn coordinate_of(code: &'static str) -> Option<(&'static str, usize)> {
    let (place, letter) = code.rsplit_once('.')?;
    Some((
        place,
        ["x", "y", "z"].iter().position(|known| *known == letter)?,
    ))
}

/// Triggers of a rotated cycle, rotated back to the unrotated part.
struct UnturnedTriggers<'f> {
    turn: CycleRotation<Expr<'f>>,
    first_sample: usize,
    used: UsedTriggers,
    written: RefCell<Vec<((usize, usize), Value<'f>)>>,
}

const AXES: [&str; 3] = ["_x", "_y", "_z"];

impl<'f> TriggerSource<'f> for UnturnedTriggers<'f> {
    fn trigger(&self, f: &'f Draft, sample: usize, axis: usize) -> Expr<'f> {
        let CycleRotation {
            axes,
            about,
            sine,
            cosine,
            shift,
            ..
        } = self.turn;
        if !axes.contains(&axis) {
            return f.trigger(self.first_sample + sample, axis);
        }
        let known = |written: &[((usize, usize), Value<'f>)]| {
            written
                .iter()
                .find(|(key, _)| *key == (sample, axis))
                .map(|(_, value)| *value)
        };
        if let Some(value) = known(&self.written.borrow()) {
            return value.into();
        }
        // Written before its first use: a control does not keep the touch longer.
        let mut written = self.written.borrow_mut();
        let off = |i: usize| {
            let from = f.trigger(self.first_sample + sample, axes[i]) - f.length(about[i]);
            shift[i].map_or(from, |shift| from - shift)
        };
        let own = |name: &'static str, i: usize| {
            f.set(Name::new(name, sample + 1).and(AXES[axes[i]]), off(i))
        };
        let (a, o) = (own("off", 0), own("off", 1));
        for i in (0..2).filter(|i| self.used.has(sample, axes[*i])) {
            let turned = if i == 0 {
                a + a * cosine + o * sine
            } else {
                o + o * cosine - a * sine
            };
            let value = f.set(
                Name::new("back", sample + 1).and(AXES[axes[i]]),
                turned + f.length(about[i]),
            );
            written.push(((sample, axes[i]), value));
        }
        known(&written)
            .expect("a formula reads what is used of it")
            .into()
    }
}

fn write<'f>(
    own: &Formula,
    f: &'f Draft,
    first_sample: usize,
    turn: CycleRotation<Expr<'f>>,
) -> TurnedFormula {
    let back = UnturnedTriggers {
        turn,
        first_sample,
        used: own.used(),
        written: RefCell::default(),
    };
    let variables = lower::write(own, f, &back);
    let known = |variable: Variable| f.known(variables[variable.index()]);
    // Abscissa and ordinate on the rotated part, by their values in the frame of the drawing. Unmeasured coordinates are nominal there.
    let places: RefCell<Vec<(Pair, [Variable; 2])>> = RefCell::default();
    let placed = |pair: Pair| {
        if let Some((_, placed)) = places.borrow().iter().find(|(known, _)| *known == pair) {
            return *placed;
        }
        let number = places.borrow().len() + 1;
        let from = |i: usize, name: &'static str| match pair[i] {
            Known::Measured(variable) => f.set(
                Name::new(name, number),
                known(variable) - f.length(turn.about[i]),
            ),
            Known::Nominal(nominal) => {
                f.set(Name::new(name, number), f.length(nominal - turn.about[i]))
            }
        };
        let (a, o) = (from(0, "from_x"), from(1, "from_y"));
        let turned = [
            a + a * turn.cosine - o * turn.sine,
            o + o * turn.cosine + a * turn.sine,
        ];
        let at = |i: usize| {
            let place = turned[i] + f.length(turn.about[i]);
            turn.shift[i].map_or(place, |shift| place + shift)
        };
        let new = [
            f.set(Name::new("at_x", number), at(0)).variable,
            f.set(Name::new("at_y", number), at(1)).variable,
        ];
        places.borrow_mut().push((pair, new));
        new
    };
    let in_datum = |axis: usize| {
        let place = own.datum.and_then(|datum| datum.place[axis]);
        place.map_or(Known::Nominal(turn.about[axis]), |place| {
            Known::new(place.measured, place.nominal)
        })
    };
    // Both coordinates of a position, one of which is in this variable. The other one is another result, or comes from the datum.
    let pair = |of: &str, axis: usize, variable: Variable| -> Pair {
        [0, 1].map(|i| {
            let result = own
                .results
                .iter()
                .find(|other| coordinate_of(other.code) == Some((of, i)));
            match result {
                _ if i == axis => Known::Measured(variable),
                Some(result) => Known::new(result.variable, result.nominal),
                None => in_datum(i),
            }
        })
    };
    let moved = |(i, result): (usize, &ResultDef)| {
        let variable = match (result.role, coordinate_of(result.code), result.variable?) {
            (
                Role::Abscissa | Role::Ordinate | Role::Reading,
                Some((of, axis @ 0..=1)),
                variable,
            ) => placed(pair(of, axis, variable))[axis],
            (Role::Direction, _, variable) => {
                f.set(Name::new("turned", i + 1), known(variable) + turn.angle)
                    .variable
            }
            // A deviation along a direction of the drawing has no meaning on a rotated part.
            (Role::Shift, ..) => return None,
            (_, _, variable) => variables[variable.index()],
        };
        Some(variable)
    };
    let results = own.results.iter().enumerate();
    let results = results
        .map(|of| ResultDef {
            variable: moved(of),
            ..of.1.clone()
        })
        .collect();
    let datum = own.datum.map(|datum| {
        // The rotated coordinate of a result.
        let in_plane = |axis: usize, variable: Variable| {
            let shown = own
                .results
                .iter()
                .filter(|result| result.variable == Some(variable));
            let of = shown
                .filter_map(|result| coordinate_of(result.code))
                .find(|(_, of)| *of == axis);
            placed(of.map_or_else(|| [0, 1].map(in_datum), |(of, _)| pair(of, axis, variable)))
                [axis]
        };
        let moved = |i: usize, place: Coordinate| {
            let measured = place.measured.map(|old| {
                if i < 2 {
                    in_plane(i, old)
                } else {
                    variables[old.index()]
                }
            });
            Coordinate { measured, ..place }
        };
        let place = [0, 1, 2].map(|i| datum.place[i].map(|place| moved(i, place)));
        OffsetCorrection {
            place,
            rotation: None,
            ..datum
        }
    });
    TurnedFormula { results, datum }
}
