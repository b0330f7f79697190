//! The formula of a cycle that follows a measured angle: it computes in the frame of the drawing.
//!
//! Such a cycle is turned by δ, how far the angle is off its nominal value, about a place p that may be shifted by s. Each trigger t is first brought
//! back to where it would be on an unturned part: p + R(−δ)(t − p − s). The cycle's own formula takes it from there. Its places go the other way,
//! p + s + R(δ)(q − p), and its directions get δ.

use std::cell::RefCell;

use crate::formula::draft::{Draft, Expr, Value};
use crate::formula::node::Variable;
use crate::formula::plain::{self, Source};
use crate::formula::{Coordinate, Datum, Formula, Name, ResultDef, Role, Used};

/// By what a cycle is turned, and about which place.
#[derive(Clone, Copy, Debug)]
pub struct Turn<T> {
    /// Axes of abscissa and ordinate.
    pub axes: [usize; 2],
    /// The place that it is turned about on the nominal part: abscissa and ordinate, mm.
    pub about: [f64; 2],
    /// How far it is turned, degrees.
    pub angle: T,
    /// The sine of that, and its cosine less 1.
    pub sine: T,
    pub cosine: T,
    /// How far the place is shifted along abscissa and ordinate, mm.
    pub shift: [Option<T>; 2],
}

impl Turn<f64> {
    /// Whether all of it is known.
    pub fn is_known(&self) -> bool {
        let all = [self.angle, self.sine, self.cosine];
        all.into_iter()
            .chain(self.shift.into_iter().flatten())
            .all(f64::is_finite)
    }
}

impl<T: Copy> Turn<T> {
    pub fn map<U>(&self, change: impl Fn(T) -> U) -> Turn<U> {
        Turn {
            axes: self.axes,
            about: self.about,
            angle: change(self.angle),
            sine: change(self.sine),
            cosine: change(self.cosine),
            shift: self.shift.map(|shift| shift.map(&change)),
        }
    }
}

/// A coordinate of a place.
#[derive(Clone, Copy, PartialEq)]
enum Known {
    /// This value holds it.
    Measured(Variable),
    /// Nothing measures it: it is nominal, mm.
    Nominal(f64),
}

impl Known {
    fn new(measured: Option<Variable>, nominal: f64) -> Known {
        measured.map_or(Known::Nominal(nominal), Known::Measured)
    }
}

/// Abscissa and ordinate of a place. What is measured is the same place by its variables: nominal values of one place may be rounded differently.
type Pair = [Known; 2];

/// What a cycle that is turned has become.
struct Written {
    results: Vec<ResultDef>,
    datum: Option<Datum>,
}

impl Formula {
    /// Whether a turned cycle can have it: its places are given by abscissa and ordinate, and it writes no angle itself.
    pub fn can_turn(&self) -> bool {
        self.results.iter().all(|result| match result.role {
            Role::Abscissa | Role::Ordinate | Role::Reading => coordinate_of(result.code).is_some(),
            Role::Turn => false,
            _ => true,
        })
    }

    /// Adds the formula of the next cycle, which is turned by values of this one: how much later its variables are found, and what a work offset can be
    /// written from.
    pub fn join_turned(
        &mut self,
        name: &str,
        own: &Formula,
        first_sample: usize,
        turn: &Turn<Variable>,
    ) -> (u32, Option<Datum>) {
        let (later, cycle) = (self.assignments.len() as u32, self.cycles.len() as u16);
        let Written { results, datum } = self.continued(name, first_sample, |draft| {
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

    /// The same for a cycle that is known to be turned so far.
    pub fn turned(&self, turn: &Turn<f64>) -> Formula {
        let draft = Draft::with_room_for(crate::formula::MOST_SAMPLES);
        let numbers = Turn {
            shift: [None; 2],
            ..turn.map(|number| draft.number(number))
        };
        let lengths = turn.shift.map(|shift| shift.map(|mm| draft.length(mm)));
        let Written { results, datum } = write(
            self,
            &draft,
            0,
            Turn {
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

/// The place that a code is a coordinate of, and which: `center.y` is 1 of `center`.
fn coordinate_of(code: &'static str) -> Option<(&'static str, usize)> {
    let (place, letter) = code.rsplit_once('.')?;
    Some((
        place,
        ["x", "y", "z"].iter().position(|known| *known == letter)?,
    ))
}

/// Where the triggers of a turned cycle would be on an unturned part.
struct Back<'f> {
    turn: Turn<Expr<'f>>,
    first_sample: usize,
    used: Used,
    written: RefCell<Vec<((usize, usize), Value<'f>)>>,
}

const AXES: [&str; 3] = ["_x", "_y", "_z"];

impl<'f> Source<'f> for Back<'f> {
    fn trigger(&self, f: &'f Draft, sample: usize, axis: usize) -> Expr<'f> {
        let Turn {
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
        // What is computed of a touch is written where it is needed first: a control keeps it no longer than that.
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

fn write<'f>(own: &Formula, f: &'f Draft, first_sample: usize, turn: Turn<Expr<'f>>) -> Written {
    let back = Back {
        turn,
        first_sample,
        used: own.used(),
        written: RefCell::default(),
    };
    let variables = plain::write(own, f, &back);
    let known = |variable: Variable| f.known(variables[variable.index()]);
    // Where abscissa and ordinate lie on the turned part, by the values that they have in the frame of the drawing. What is not measured is nominal there.
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
    // Both coordinates of a place, of which a value holds one. The other is another result, or what the datum has of it.
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
            // How far off something is along a direction of the drawing says nothing of a part that is turned.
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
        // The place of a result, where one holds this coordinate.
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
        Datum {
            place,
            rotation: None,
            ..datum
        }
    });
    Written { results, datum }
}
