//! The results that a control computes from the touches, stated once.
//!
//! A cycle states its arithmetic as a list of named assignments ([`Draft`]). A post prints the list in its control's language, and the virtual part evaluates
//! the same list, with the derivative by each touch ([`Dual`]). So the page shows the results that the program computes, and the uncertainty comes from the
//! same fit. Circles are fitted geometrically, as native cycles fit them; where a program needs plain arithmetic, both use [`Formula::plain`].
//!
//! Angles are in degrees, as controls take them.

mod circle;
mod draft;
mod dual;
mod join;
mod lower;
mod name;
mod node;
mod relate;
mod repeat;
mod turned;

pub use circle::{CircleFit, fit_circle};
pub use draft::{Draft, Expr, Value};
pub use dual::Dual;
pub use lower::SingleTouch;
pub use name::Name;
pub use node::{CirclePart, Function, Node, NodeId, Op, Variable};
pub use relate::{Operand, RELATIONS, Relation, RelationDef, RelationDrawing, RelationTerm};
pub use turned::CycleRotation;

use crate::formula::repeat::Repeats;
use crate::geom::Vec3;
use crate::num::{decimal, tidy};
use crate::text::Text;

/// Largest number of samples in the formula of one cycle, each touched once: a derivative is kept for each.
pub const MOST_SAMPLES: usize = 16;

/// Limits of the deviation from nominal. Beyond them a program stops without writing; `None` is no limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Position along each axis, mm.
    pub position: Option<f64>,
    /// Width, diameter or length, mm.
    pub size: Option<f64>,
    /// Angle or direction, degrees.
    pub angle: Option<f64>,
    /// Root mean square distance of the touches from the fitted shape, mm.
    pub residual: Option<f64>,
}

/// Action of a program when a result is out of tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToleranceAction {
    /// Continues; the result is judged afterwards.
    #[default]
    Go,
    /// Shows the result as out of tolerance and continues.
    Mark,
    /// Stops with an alarm and writes nothing.
    Stop,
}

impl ToleranceAction {
    /// All actions, each with its word in a job.
    pub const ALL: [(&'static str, ToleranceAction); 3] = [
        ("go", ToleranceAction::Go),
        ("mark", ToleranceAction::Mark),
        ("stop", ToleranceAction::Stop),
    ];
}

/// The tolerance of a result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Smallest and largest good value, mm or degrees.
    pub limits: [f64; 2],
    pub action: ToleranceAction,
    /// Correction of a tool by this result.
    pub wear: Option<Wear>,
}

/// Correction of a tool by a measured size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wear {
    /// Number of the tool offset.
    pub tool: i32,
    /// Feedback: share of the error that is corrected, more than 0 and at most 1.
    pub share: f64,
    /// Whether its length is corrected, by a height; otherwise its radius, by a size.
    pub length: bool,
    /// Change of the tool's radius or length for an error of 1 in the result: 0.5 for what is too large inside, -0.5 outside, -1 for a height.
    pub sense: f64,
    /// Dead band: errors up to this are not corrected, mm.
    pub dead_band: f64,
    /// Number of parts in the mean, and the number of the offset or variable that keeps it; `None` corrects after every part.
    pub mean: Option<(i32, i32)>,
}

/// Reason of a check in a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CheckKind {
    /// Plausibility: beyond the limit the program writes nothing.
    Plausibility,
    /// Tolerance: beyond the limit the program shows the result and continues.
    MarkTolerance,
    /// Tolerance: beyond the limit the program stops.
    StopTolerance,
    /// A later cycle follows the result: beyond the limit its path was not checked, so the program stops before that cycle.
    FollowLimit,
}

/// Values that exceed a limit by less count as equal to it, mm or degrees.
pub const ON_LIMIT: f64 = 1e-6;

/// A check of one result against its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResultCheck {
    /// Reason of the check.
    pub asked: CheckKind,
    /// Index of the result.
    pub result: usize,
    /// Assignment with the result.
    pub variable: Variable,
    /// Expected value: nominal, or the middle of the tolerance; mm or degrees.
    pub expected: f64,
    /// Largest allowed deviation from the expected value.
    pub limit: f64,
    /// Whether the result is an angle; otherwise a length.
    pub angle: bool,
}

impl ResultCheck {
    /// Whether a program stops if the check fails. `writes`: whether it writes a work offset.
    pub fn stops(&self, writes: bool) -> bool {
        match self.asked {
            CheckKind::Plausibility => writes,
            CheckKind::MarkTolerance => false,
            CheckKind::StopTolerance | CheckKind::FollowLimit => true,
        }
    }

    /// Message of a failed check, after the name of the result and its value: `, more than 0.5 from 25`, `, not 24.98 to 25.02`. `unit` is the unit of the
    /// program, mm or degrees.
    pub fn complaint(&self, unit: f64) -> String {
        let number = |x: f64| decimal(x / unit, 12);
        let (limit, wanted) = (self.limit, self.expected);
        match self.asked {
            CheckKind::Plausibility | CheckKind::FollowLimit => {
                format!(", more than {} from {}", number(limit), number(wanted))
            }
            CheckKind::MarkTolerance | CheckKind::StopTolerance => {
                let end = |x: f64| decimal(tidy(x / unit), 9);
                format!(", not {} to {}", end(wanted - limit), end(wanted + limit))
            }
        }
    }

    /// Text of the alarm of a failed check, of at most `longest` characters: `BORE.DIAMETER OFF, SEE #103`. `variable` holds the result; it tells the cycle if
    /// there is no room for both.
    pub fn alarm(&self, formula: &Formula, variable: &str, longest: usize) -> String {
        let off_or_out = match self.asked {
            CheckKind::Plausibility | CheckKind::FollowLimit => "OFF",
            CheckKind::MarkTolerance | CheckKind::StopTolerance => "OUT",
        };
        let says =
            |code: &str| format!("{} {off_or_out}, SEE {variable}", code.to_ascii_uppercase());
        let result = &formula.results[self.result];
        let fits = [says(&formula.code(result)), says(result.code)]
            .into_iter()
            .find(|says| says.len() <= longest);
        fits.unwrap_or_else(|| says("result"))
    }

    /// Whether a value, mm or degrees, is within the limit. Unknown values are not. At the limit itself rounding of the touches decides nothing.
    pub fn is_within(&self, value: f64) -> bool {
        (value - self.expected).abs() <= self.limit + ON_LIMIT
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Assignment {
    pub name: Name,
    /// Index of its cycle in a set-up.
    pub cycle: u16,
    pub node: NodeId,
}

/// Behaviour of a result when the part is shifted, rotated or resized. Its unit follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Abscissa of a point, a length. The next result is its ordinate.
    Abscissa,
    /// Ordinate of a point, a length.
    Ordinate,
    /// A length of the part itself.
    Size,
    /// An angle of the part itself, degrees.
    Angle,
    /// A direction, degrees: rotates with the part.
    Direction,
    /// Coordinate along the tool axis that is not probed, a length.
    Height,
    /// Coordinate along the tool axis that is probed: moves with the part.
    Level,
    /// Coordinate along a single probing direction: a shift or rotation of the part changes it as the surface requires.
    Reading,
    /// Deviation or written value, a length.
    Shift,
    /// Deviation or written value, an angle.
    Turn,
    /// Root mean square distance of the touches from the fitted shape, a length.
    Residual,
    /// Largest distance between repeated touches of one point, a length.
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
    /// Behaviour of the result; gives its unit.
    pub role: Role,
    /// Value on the nominal part, mm or degrees.
    pub nominal: f64,
    /// Value from which the deviation is counted, if that is not nominal: the middle of a tolerance.
    pub reference: f64,
    /// Assignment with the result; `None` if these touches cannot give it.
    pub variable: Option<Variable>,
    /// Tolerance, if the job gives one.
    pub tolerance: Option<Tolerance>,
    /// Limit of this result alone, mm.
    pub limit: Option<f64>,
}

/// The results that a control computes from the triggers of the touches.
#[derive(Clone, Debug, Default)]
pub struct Formula {
    /// Nodes of all expressions; each node comes after its operands.
    nodes: Vec<Node>,
    /// Assignments in order; each refers to earlier ones only.
    pub assignments: Vec<Assignment>,
    /// Results that the control stores, in order.
    pub results: Vec<ResultDef>,
    /// Correction of a work offset.
    pub datum: Option<OffsetCorrection>,
    /// Rotation of the coordinate system in degrees and its centre in the plane (mm), for controls whose work offsets have no rotation: printed as a block for
    /// the user.
    pub turn: Option<(Variable, [f64; 2])>,
    /// Cycles of a set-up; empty for a single cycle.
    pub cycles: Vec<CycleSamples>,
}

/// A cycle of a set-up in the joined formula.
#[derive(Clone, Debug)]
pub struct CycleSamples {
    /// Name that prefixes the codes of its results: letters and digits.
    pub name: String,
    /// Index of its first sample.
    pub first_sample: usize,
}

/// Correction of a work offset.
#[derive(Clone, Copy, Debug)]
pub struct OffsetCorrection {
    /// Abscissa, ordinate and tool axis; `None` leaves the origin unchanged. Abscissa and ordinate come together.
    pub place: [Option<Coordinate>; 3],
    /// Rotation of the coordinate system, degrees; `None` leaves the rotation unchanged.
    pub rotation: Option<Variable>,
    /// Whether results of the cycle show the written values, so that no further rows are needed.
    pub in_results: bool,
}

/// One coordinate of the point that corrects a work offset.
#[derive(Clone, Copy, Debug)]
pub struct Coordinate {
    /// Assignment with the measured coordinate; `None` if it is not measured and counts as nominal.
    pub measured: Option<Variable>,
    /// Coordinate that the point gets in the corrected system, mm.
    pub nominal: f64,
}

impl Coordinate {
    /// A measured coordinate with its value in the corrected system.
    pub fn measured(value: Value<'_>, nominal: f64) -> Self {
        Coordinate {
            measured: Some(value.variable),
            nominal,
        }
    }
}

impl OffsetCorrection {
    /// A correction without rotation whose values no result shows.
    pub fn of(place: [Option<Coordinate>; 3]) -> Self {
        OffsetCorrection {
            place,
            rotation: None,
            in_results: false,
        }
    }

    /// Correction by a measured point in the plane: abscissa and ordinate, each measured and nominal.
    pub fn point(abscissa: (Value<'_>, f64), ordinate: (Value<'_>, f64)) -> Self {
        let [a, o] =
            [abscissa, ordinate].map(|(value, nominal)| Some(Coordinate::measured(value, nominal)));
        OffsetCorrection::of([a, o, None])
    }

    /// Whether abscissa, ordinate and tool axis were measured.
    pub fn measured(&self) -> [bool; 3] {
        self.place
            .map(|place| place.is_some_and(|place| place.measured.is_some()))
    }

    /// Whether there is something to write.
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
    /// Value on the nominal part.
    pub nominal: Option<f64>,
    /// Value that the control computes; `None` if these triggers cannot give it.
    pub value: Option<f64>,
    /// Value minus nominal, or minus the middle of the tolerance.
    pub deviation: Option<f64>,
    /// Standard uncertainty of the value (one sigma).
    pub uncertainty: Option<f64>,
    /// Part of the uncertainty that comes from the eccentricity of the ball (one sigma).
    pub uncertainty_runout: Option<f64>,
    /// Lower and upper limit, if there is a tolerance.
    pub limits: Option<(f64, f64)>,
    /// Good, rework or scrap, if there is a tolerance; implausible beyond the limit.
    pub verdict: Option<Text>,
    /// Value on the actual part, if it is known.
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

    /// Change of a value in a full turn, degrees, if it is an angle or half of one.
    pub fn full_turn(&self, id: NodeId) -> Option<i32> {
        let is_angle = |id: NodeId| matches!(self.node(id), Node::Atan2(..));
        match self.node(id) {
            Node::Atan2(..) => Some(360),
            Node::Binary(Op::Divide, angle, two)
                if is_angle(angle) && self.node(two) == Node::Number(2.0) =>
            {
                Some(180)
            }
            _ => None,
        }
    }

    /// Visits a node and all its operands.
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

    /// Removes the rotation for a control whose work offsets have none. The measured rotation is left to the user.
    pub fn without_rotation(&mut self) {
        let Some(datum) = &mut self.datum else { return };
        let about = [0, 1].map(|i| datum.place[i].map_or(0.0, |place| place.nominal));
        self.turn = datum.rotation.take().map(|rotation| (rotation, about));
        if !datum.writes() {
            self.datum = None;
        }
    }

    /// The formula in plain arithmetic: circles are fitted by normal equations in closed form. The circle is the same if the points are on one; otherwise it
    /// differs from the geometric fit by the square of their scatter.
    pub fn plain(self) -> Formula {
        if !self
            .nodes
            .iter()
            .any(|node| matches!(node, Node::Circle(..)))
        {
            return self;
        }
        let draft = Draft::with_room_for(MOST_SAMPLES);
        let variables = lower::write(&self, &draft, &lower::RawTriggers);
        self.written(draft, &variables)
    }

    /// The formula for repeated touches: it computes with the mean of each sample, and adds the largest distance between touches of one point as a result.
    /// `along` are the probing directions of the samples. Sample s becomes the samples from `times` · s on.
    pub fn repeated(self, times: usize, along: &[Vec3], limit: Option<f64>) -> Formula {
        let draft = Draft::with_room_for(times * along.len());
        let repeats = Repeats::of(times, along, self.used());
        let variables = lower::write(&self, &draft, &repeats);
        repeats.state(&draft, limit);
        self.written(draft, &variables)
    }

    /// The formula over the surfaces that single touches measure, one for each sample. Their coordinates are the first assignments, in order.
    pub fn over_single_touches(self, touches: &[SingleTouch]) -> Formula {
        let draft = Draft::with_room_for(touches.len());
        let surface = |(k, touch): (usize, &SingleTouch)| {
            let trigger = draft.trigger(k, touch.axis);
            draft.set(
                Name::new("surface", k + 1),
                trigger - draft.length(touch.ball),
            )
        };
        let surfaces = touches.iter().enumerate().map(surface).collect();
        let variables = lower::write(&self, &draft, &lower::SingleTouches { touches, surfaces });
        self.written(draft, &variables)
    }

    /// Builds the formula from the draft, given the new indices of its assignments.
    fn written(self, draft: Draft, variables: &[Variable]) -> Formula {
        debug_assert!(
            self.cycles.is_empty(),
            "the cycles of a set-up are written before they are joined"
        );
        let moved = |variable: Variable| variables[variable.index()];
        let datum = self.datum.map(|datum| OffsetCorrection {
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

    /// Checks of a program before it writes. Plausibility comes first, for each value that the touches give and that has a limit; then tolerances whose action
    /// marks or stops.
    pub fn result_checks(&self, limits: &Limits) -> Vec<ResultCheck> {
        let mut questions: Vec<ResultCheck> = Vec::new();
        let measured = self.measured();
        for (index, result) in self.results.iter().enumerate() {
            let limit = match result.role {
                Role::Abscissa | Role::Ordinate | Role::Level | Role::Reading => limits.position,
                Role::Size => limits.size,
                Role::Angle | Role::Direction => limits.angle,
                Role::Residual => limits.residual,
                Role::Spread => result.limit,
                // Not probed, or shown by another result.
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
                // The middle of a tolerance may differ from nominal by more than the limit.
                let limit = limit + (result.reference - result.nominal).abs();
                questions.push(ResultCheck {
                    asked: CheckKind::Plausibility,
                    result: index,
                    variable,
                    expected: wanted,
                    limit,
                    angle,
                });
            }
        }
        questions.extend(self.tolerance_checks().filter_map(|check| {
            let asked = match self.results[check.result].tolerance?.action {
                ToleranceAction::Go => return None,
                ToleranceAction::Mark => CheckKind::MarkTolerance,
                ToleranceAction::Stop => CheckKind::StopTolerance,
            };
            Some(ResultCheck { asked, ..check })
        }));
        questions
    }

    /// Whether a result corrects a tool.
    pub fn corrects_tools(&self) -> bool {
        let wear = |result: &ResultDef| result.tolerance.is_some_and(|own| own.wear.is_some());
        self.results.iter().any(wear)
    }

    /// Checks of all results with a tolerance, whatever its action.
    pub fn tolerance_checks(&self) -> impl Iterator<Item = ResultCheck> {
        self.results.iter().enumerate().filter_map(|(result, def)| {
            let [low, high] = def.tolerance?.limits;
            Some(ResultCheck {
                asked: CheckKind::MarkTolerance,
                result,
                variable: def.variable?,
                expected: (low + high) / 2.0,
                limit: (high - low) / 2.0,
                angle: def.role.is_angle(),
            })
        })
    }

    /// Check of a result before a cycle that follows it.
    pub fn leads(&self, result: usize, limits: &Limits) -> Option<ResultCheck> {
        let def = &self.results[result];
        let limit = match def.role {
            Role::Size => limits.size,
            Role::Angle | Role::Direction => limits.angle,
            _ => limits.position,
        };
        let (variable, limit, angle) = (def.variable?, limit?, def.role.is_angle());
        Some(ResultCheck {
            asked: CheckKind::FollowLimit,
            result,
            variable,
            expected: def.nominal,
            limit,
            angle,
        })
    }

    /// Whether each assignment depends on a touch.
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

    /// Whether another formula computes the same results by the same arithmetic. Nominal values may differ.
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

    /// Coordinates of the triggers that the formula reads.
    pub fn used(&self) -> UsedTriggers {
        let mut used = UsedTriggers::default();
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

/// Coordinates of the triggers that a formula reads: one bit for each axis.
#[derive(Clone, Debug, Default)]
pub struct UsedTriggers(Vec<u8>);

impl UsedTriggers {
    /// Whether the formula reads coordinate `axis` of a sample.
    pub fn has(&self, sample: usize, axis: usize) -> bool {
        self.0
            .get(sample)
            .is_some_and(|axes| axes & (1 << axis) != 0)
    }
}
