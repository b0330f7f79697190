//! What a control computes from the touches, written once.
//!
//! A cycle states its arithmetic as a list of named assignments ([`Draft`]). A post prints it in its control's language, and the
//! virtual part evaluates the very same list, with the derivative by each touch beside it ([`Dual`]). So what the page shows as the
//! control's result is what the program computes, and the uncertainty comes from the same fit. Circles are fitted
//! geometrically, as a native cycle does it; where a program has to do it in plain arithmetic, both use
//! [`Formula::plain`].
//!
//! Angles are in degrees here, as controls take them.

mod circle;
mod draft;
mod dual;
mod join;
mod name;
mod node;
mod plain;
mod relate;
mod repeat;
mod turned;

pub use circle::{CircleFit, fit_circle};
pub use draft::{Draft, Expr, Value};
pub use dual::Dual;
pub use name::Name;
pub use node::{CirclePart, Function, Node, NodeId, Op, Variable};
pub use relate::{Operand, RELATIONS, Relating, Relation, RelationDef, RelationDrawing};
pub use turned::Turn;

use crate::formula::repeat::Repeats;
use crate::geom::Vec3;
use crate::num::{decimal, tidy};
use crate::text::Text;

/// The most samples that the formula of one cycle computes with, each touched once: a derivative is kept for each.
pub const MOST_SAMPLES: usize = 16;

/// How far a result may be off its nominal value before a program stops without writing; none is no limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Of a position, along each axis, mm.
    pub position: Option<f64>,
    /// Of a width, diameter or length, mm.
    pub size: Option<f64>,
    /// Of an angle or direction, degrees.
    pub angle: Option<f64>,
    /// Root mean square distance of the touches from what is fitted through them, mm.
    pub residual: Option<f64>,
}

/// What a program does with a result that is out of its tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Consequence {
    /// It continues: the result is judged afterwards.
    #[default]
    Go,
    /// It shows the result as out of tolerance and continues.
    Mark,
    /// It stops with an alarm and writes nothing.
    Stop,
}

impl Consequence {
    /// Every one, with its word in a job.
    pub const ALL: [(&'static str, Consequence); 3] = [
        ("go", Consequence::Go),
        ("mark", Consequence::Mark),
        ("stop", Consequence::Stop),
    ];
}

/// The tolerance of a result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// The smallest and the largest value that is good, mm or degrees.
    pub limits: [f64; 2],
    pub action: Consequence,
    /// The tool that is corrected by it.
    pub wear: Option<Wear>,
}

/// How a tool is corrected by what was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wear {
    /// The number of its offset.
    pub tool: i32,
    /// The share of the error, more than 0 and at most 1.
    pub share: f64,
    /// The error up to which nothing is corrected, mm.
    pub dead_band: f64,
    /// Of how many parts the mean counts, and the number of the offset that keeps them; none corrects by every part.
    pub mean: Option<(i32, i32)>,
}

/// Why a program asks something of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// Whether it is plausible: beyond that the program writes nothing.
    Plausible,
    /// Whether it is within its tolerance: out of it the program says so and continues.
    Marks,
    /// The same: out of it the program stops.
    Stops,
    /// Whether a cycle whose place it gives stays where its path was checked: beyond that the program stops before that cycle.
    Leads,
}

/// A value this little beyond a limit is on it, mm or degrees.
pub const ON_LIMIT: f64 = 1e-6;

/// What a program asks of a result: whether it is plausible, or within its tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Question {
    /// Why it is asked.
    pub asked: Asked,
    /// Of the result, by its place in the formula's list.
    pub result: usize,
    /// The assignment that holds it.
    pub variable: Variable,
    /// What it is on a good part, or the middle of its tolerance: mm or degrees.
    pub wanted: f64,
    /// How far it may be off that.
    pub limit: f64,
    /// Whether it is an angle; else a length.
    pub angle: bool,
}

impl Question {
    /// Whether a program stops where the answer is no; `writes`: whether it writes a work offset.
    pub fn stops(&self, writes: bool) -> bool {
        match self.asked {
            Asked::Plausible => writes,
            Asked::Marks => false,
            Asked::Stops | Asked::Leads => true,
        }
    }

    /// What a program says where the answer is no, behind the name of the result and its value: `, more than 0.5 from 25`, `, not 24.98 to 25.02`. `unit`
    /// is that of the program, mm or degrees.
    pub fn complaint(&self, unit: f64) -> String {
        let number = |x: f64| decimal(x / unit, 12);
        let (limit, wanted) = (self.limit, self.wanted);
        match self.asked {
            Asked::Plausible | Asked::Leads => {
                format!(", more than {} from {}", number(limit), number(wanted))
            }
            Asked::Marks | Asked::Stops => {
                let end = |x: f64| decimal(tidy(x / unit), 9);
                format!(", not {} to {}", end(wanted - limit), end(wanted + limit))
            }
        }
    }

    /// Whether a value, mm or degrees, is within the limit. What is not known is not. On the very end the last decimals of touches decide nothing.
    pub fn holds(&self, value: f64) -> bool {
        (value - self.wanted).abs() <= self.limit + ON_LIMIT
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Assignment {
    pub name: Name,
    /// Index of its cycle in a set-up.
    pub cycle: u16,
    pub node: NodeId,
}

/// How a result behaves when the part is shifted, turned or resized, and with it its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Abscissa of a point, a length. The ordinate follows as the next result.
    Abscissa,
    /// Ordinate of a point, a length.
    Ordinate,
    /// A length of the part itself.
    Size,
    /// An angle of the part itself, degrees.
    Angle,
    /// A direction, degrees: turns with the part.
    Direction,
    /// A coordinate along the tool axis, a length; not probed.
    Height,
    /// A coordinate along the tool axis that is probed: it moves with the part.
    Level,
    /// A coordinate that is read along a single direction: what a shifted or turned part does to it depends on the surface.
    Reading,
    /// A length that says how far something is off, or what is written.
    Shift,
    /// The same as an angle, degrees.
    Turn,
    /// How far touches are from what is fitted through them, a length: their root mean square distance.
    Residual,
    /// How far repeated touches of one point are apart, a length.
    Spread,
}

impl Role {
    /// Whether the result is an angle; else a length.
    pub fn is_angle(self) -> bool {
        match self {
            Role::Angle | Role::Direction | Role::Turn => true,
            Role::Abscissa
            | Role::Ordinate
            | Role::Size
            | Role::Height
            | Role::Level
            | Role::Reading
            | Role::Shift => false,
            Role::Residual | Role::Spread => false,
        }
    }
}

/// One result that the control stores.
#[derive(Clone, Debug)]
pub struct ResultDef {
    /// Its code, `center.x`.
    pub code: &'static str,
    /// Index of its cycle in a set-up.
    pub cycle: u16,
    pub meaning: &'static str,
    /// How it behaves, and its unit.
    pub role: Role,
    /// What it is on the nominal part; mm or degrees.
    pub nominal: f64,
    /// What its deviation is measured from, where that is not the nominal value: the middle of a tolerance zone.
    pub reference: f64,
    /// The assignment that holds it; `None` if these touches cannot give it.
    pub variable: Option<Variable>,
    /// Its tolerance, where the job gives one.
    pub tolerance: Option<Tolerance>,
    /// How far it may be off, where that is its own limit, mm.
    pub limit: Option<f64>,
}

/// What the control computes from the triggers of the touches.
#[derive(Clone, Debug, Default)]
pub struct Formula {
    /// What the expressions are made of, each node after those it is made of.
    nodes: Vec<Node>,
    /// In order; each refers to earlier ones only.
    pub assignments: Vec<Assignment>,
    /// What the control stores, in order.
    pub results: Vec<ResultDef>,
    /// What a work offset is corrected by.
    pub datum: Option<Datum>,
    /// By how many degrees the system is to be turned, and about which place in the plane (mm), where a work offset has no rotation: a block for the user.
    pub turn: Option<(Variable, [f64; 2])>,
    /// The cycles of a set-up; empty where there is one.
    pub cycles: Vec<CycleSamples>,
}

/// A cycle of a set-up, in the formula of all.
#[derive(Clone, Debug)]
pub struct CycleSamples {
    /// Its name, in front of the codes of its results: letters and digits.
    pub name: String,
    /// Index of its first sample.
    pub first_sample: usize,
}

/// What a program corrects a work offset by.
#[derive(Clone, Copy, Debug)]
pub struct Datum {
    /// Abscissa, ordinate and tool axis; none leaves the origin alone. Abscissa and ordinate come together.
    pub place: [Option<Coordinate>; 3],
    /// By how many degrees the system is turned; none leaves its rotation alone.
    pub rotation: Option<Variable>,
    /// Whether results of the cycle say what is written, so that no further rows are needed.
    pub in_results: bool,
}

/// One coordinate of the point that a work offset is corrected by.
#[derive(Clone, Copy, Debug)]
pub struct Coordinate {
    /// The assignment with what was measured; `None` if nothing was, and the coordinate is taken to be its nominal one.
    pub measured: Option<Variable>,
    /// What it is to read, mm.
    pub nominal: f64,
}

impl Coordinate {
    /// A coordinate that was measured, and what it is to read.
    pub fn measured(value: Value<'_>, nominal: f64) -> Self {
        Coordinate {
            measured: Some(value.variable),
            nominal,
        }
    }
}

impl Datum {
    /// No rotation, and no results that say what is written.
    pub fn of(place: [Option<Coordinate>; 3]) -> Self {
        Datum {
            place,
            rotation: None,
            in_results: false,
        }
    }

    /// A measured point in the plane: abscissa and ordinate, each as measured and as nominal.
    pub fn point(abscissa: (Value<'_>, f64), ordinate: (Value<'_>, f64)) -> Self {
        let [a, o] =
            [abscissa, ordinate].map(|(value, nominal)| Some(Coordinate::measured(value, nominal)));
        Datum::of([a, o, None])
    }

    /// Which of abscissa, ordinate and tool axis were measured.
    pub fn measured(&self) -> [bool; 3] {
        self.place
            .map(|place| place.is_some_and(|place| place.measured.is_some()))
    }

    /// Whether there is anything to write.
    pub fn writes(&self) -> bool {
        self.measured() != [false; 3] || self.rotation.is_some()
    }
}

/// One result with its values. Lengths in mm, angles in degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultRow {
    /// Its code, `center.x`.
    pub code: String,
    pub meaning: Text,
    pub unit: Unit,
    /// What it is on the nominal part.
    pub nominal: Option<f64>,
    /// What the control computes; `None` if these triggers cannot give it.
    pub value: Option<f64>,
    /// Value less nominal, or less the middle of the tolerance zone.
    pub deviation: Option<f64>,
    /// One sigma of the value.
    pub uncertainty: Option<f64>,
    /// How much of it comes from the ball's eccentricity: one sigma of that alone.
    pub uncertainty_runout: Option<f64>,
    /// Lower and upper limit, where a tolerance is given.
    pub limits: Option<(f64, f64)>,
    /// Good, rework, scrap, where a tolerance is given; implausible beyond the limit.
    pub verdict: Option<Text>,
    /// What it is on the actual part, where that is known.
    pub truth: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Millimetres.
    Length,
    /// Degrees.
    Angle,
    None,
}

impl Formula {
    pub fn node(&self, id: NodeId) -> Node {
        self.nodes[id.0 as usize]
    }

    /// Visits a node and everything in it.
    pub fn each(&self, id: NodeId, visit: &mut impl FnMut(Node)) {
        let node = self.node(id);
        visit(node);
        match node {
            Node::Number(_)
            | Node::Length(_)
            | Node::Variable(_)
            | Node::Trigger { .. }
            | Node::Circle(..) => {}
            Node::Call(_, a) => self.each(a, visit),
            Node::Binary(_, a, b) | Node::Atan2(a, b) => {
                self.each(a, visit);
                self.each(b, visit);
            }
        }
    }

    /// Of a control whose work offsets have no rotation: what is measured of one is left to the user.
    pub fn without_rotation(&mut self) {
        let Some(datum) = &mut self.datum else { return };
        let about = [0, 1].map(|i| datum.place[i].map_or(0.0, |place| place.nominal));
        self.turn = datum.rotation.take().map(|rotation| (rotation, about));
        if !datum.writes() {
            self.datum = None;
        }
    }

    /// The same computation in plain arithmetic: every circle is fitted by its normal equations, which are closed. They give
    /// the same circle where the points lie on one, and differ from the geometric fit by the square of their scatter.
    pub fn plain(self) -> Formula {
        if !self
            .nodes
            .iter()
            .any(|node| matches!(node, Node::Circle(..)))
        {
            return self;
        }
        let draft = Draft::with_room_for(MOST_SAMPLES);
        let variables = plain::write(&self, &draft, &plain::Touches);
        self.written(draft, &variables)
    }

    /// The same of touches that are repeated: it computes with the mean of those of each sample, and has one more result, how far they are apart at
    /// most. `along` has the probing direction of each sample; sample s becomes the samples from `times` · s on.
    pub fn repeated(self, times: usize, along: &[Vec3], limit: Option<f64>) -> Formula {
        let draft = Draft::with_room_for(times * along.len());
        let repeats = Repeats::of(times, along, self.used());
        let variables = plain::write(&self, &draft, &repeats);
        repeats.state(&draft, limit);
        self.written(draft, &variables)
    }

    /// Result of the draft, with the new positions of its assignments.
    fn written(self, draft: Draft, variables: &[Variable]) -> Formula {
        debug_assert!(
            self.cycles.is_empty(),
            "the cycles of a set-up are written before they are joined"
        );
        let moved = |variable: Variable| variables[variable.index()];
        let datum = self.datum.map(|datum| Datum {
            place: datum.place.map(|place| {
                place.map(|place| Coordinate {
                    measured: place.measured.map(moved),
                    ..place
                })
            }),
            rotation: datum.rotation.map(moved),
            ..datum
        });
        let results = self.results.iter().map(|result| ResultDef {
            variable: result.variable.map(moved),
            ..result.clone()
        });
        let turn = self.turn.map(|(turn, about)| (moved(turn), about));
        let drawn = draft.finish(datum);
        Formula {
            results: results.chain(drawn.results.iter().cloned()).collect(),
            turn,
            ..drawn
        }
    }

    /// What a program asks of its results before it writes. First whether they are plausible, in their order: each value that the touches give, and that
    /// has a limit. Then whether they are within their tolerances, where the job says that something follows from it.
    pub fn questions(&self, limits: &Limits) -> Vec<Question> {
        let mut questions: Vec<Question> = Vec::new();
        let measured = self.measured();
        for (index, result) in self.results.iter().enumerate() {
            let limit = match result.role {
                Role::Abscissa | Role::Ordinate | Role::Level | Role::Reading => limits.position,
                Role::Size => limits.size,
                Role::Angle | Role::Direction => limits.angle,
                Role::Residual => limits.residual,
                Role::Spread => result.limit,
                // Not probed, or said by another result.
                Role::Height | Role::Shift | Role::Turn => None,
            };
            let (Some(limit), Some(variable)) = (limit, result.variable) else {
                continue;
            };
            let known = questions
                .iter()
                .any(|question| question.variable == variable);
            if !known && result.reference.is_finite() && measured[variable.index()] {
                let (wanted, angle) = (result.reference, result.role.is_angle());
                // The middle of a tolerance zone may be off the nominal value by more than the limit.
                let limit = limit + (result.reference - result.nominal).abs();
                questions.push(Question {
                    asked: Asked::Plausible,
                    result: index,
                    variable,
                    wanted,
                    limit,
                    angle,
                });
            }
        }
        questions.extend(self.results.iter().enumerate().filter_map(|(result, def)| {
            let (
                Tolerance {
                    limits: [low, high],
                    action,
                    ..
                },
                variable,
            ) = (def.tolerance?, def.variable?);
            let asked = match action {
                Consequence::Go => return None,
                Consequence::Mark => Asked::Marks,
                Consequence::Stop => Asked::Stops,
            };
            let (wanted, limit) = ((low + high) / 2.0, (high - low) / 2.0);
            Some(Question {
                asked,
                result,
                variable,
                wanted,
                limit,
                angle: def.role.is_angle(),
            })
        }));
        questions
    }

    /// What is asked of a result before a cycle that it gives the place of.
    pub fn leads(&self, result: usize, limits: &Limits) -> Option<Question> {
        let def = &self.results[result];
        let limit = match def.role {
            Role::Size => limits.size,
            Role::Angle | Role::Direction => limits.angle,
            _ => limits.position,
        };
        let (variable, limit, angle) = (def.variable?, limit?, def.role.is_angle());
        Some(Question {
            asked: Asked::Leads,
            result,
            variable,
            wanted: def.nominal,
            limit,
            angle,
        })
    }

    /// Of each assignment, whether it depends on a touch.
    fn measured(&self) -> Vec<bool> {
        let mut measured = Vec::with_capacity(self.assignments.len());
        for assignment in &self.assignments {
            let mut own = false;
            self.each(assignment.node, &mut |node| {
                own |= match node {
                    Node::Trigger { .. } | Node::Circle(..) => true,
                    Node::Variable(earlier) => measured[earlier.index()],
                    _ => false,
                }
            });
            measured.push(own);
        }
        measured
    }

    /// Whether another one computes the same results by the same arithmetic; what they nominally are may differ.
    pub fn computes_as(&self, other: &Formula) -> bool {
        let results = |own: &Formula| {
            own.results
                .iter()
                .map(|result| result.variable)
                .collect::<Vec<_>>()
        };
        let assignments = |own: &Formula| {
            own.assignments
                .iter()
                .map(|assignment| assignment.node)
                .collect::<Vec<_>>()
        };
        self.nodes == other.nodes
            && results(self) == results(other)
            && assignments(self) == assignments(other)
    }

    /// Which coordinates of the triggers are used at all.
    pub fn used(&self) -> Used {
        let mut used = Used::default();
        let mut mark = |samples: std::ops::Range<usize>, axes: u8| {
            if used.0.len() < samples.end {
                used.0.resize(samples.end, 0);
            }
            used.0[samples].iter_mut().for_each(|own| *own |= axes);
        };
        for assignment in &self.assignments {
            self.each(assignment.node, &mut |node| match node {
                Node::Trigger { sample, axis } => {
                    mark(usize::from(sample)..usize::from(sample) + 1, 1 << axis)
                }
                Node::Circle(samples, _) => {
                    mark(samples.range(), 1 << samples.axes.0 | 1 << samples.axes.1)
                }
                _ => {}
            });
        }
        used
    }
}

/// The coordinates of the triggers that a formula reads: a bit an axis.
#[derive(Clone, Debug, Default)]
pub struct Used(Vec<u8>);

impl Used {
    /// Whether coordinate `axis` of a sample is read.
    pub fn has(&self, sample: usize, axis: usize) -> bool {
        self.0
            .get(sample)
            .is_some_and(|axes| axes & (1 << axis) != 0)
    }
}
