//! Native calls as rows that are read both ways. A row lists the words of a call and the meaning of each for the feature. The planner turns a feature into
//! words, the reader of programs turns words into a feature, and the virtual part runs the call.

use crate::formula::Limits;
use crate::geom::Vec3;
use crate::path::Quantity;

/// Kind of the probed feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A point of a surface across an axis.
    Surface,
    /// A circle.
    Bore,
    /// Two opposite walls across an axis.
    Width,
    /// Four walls across X and Y.
    Rectangle,
}

/// The probed feature in numbers: lengths in one unit, angles in degrees. Unknown values are NaN or `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probed {
    pub shape: Shape,
    /// Whether the material is outside.
    pub inside: bool,
    /// Centre at the height of the touches; of a surface its contact.
    pub center: Vec3,
    /// Diameter, width, or sides along X and Y.
    pub sizes: [f64; 2],
    /// Two opposite points, if a call names them instead of a centre.
    pub edges: [Vec3; 2],
    /// Measured axis: 0 is X.
    pub axis: usize,
    /// Direction of the touch along it: 1 or −1.
    pub towards: f64,
    /// From the surface of the ball to the contact at the start of a touch, less the value that a table of the control adds.
    pub set_up: Option<f64>,
    /// Height at which the ball crosses between touches, and ends.
    pub high: Option<f64>,
    /// Whether it goes up there between two touches.
    pub lifts: bool,
    /// Angle of the first touch of a circle, angle from one to the next, and number of touches.
    pub start: f64,
    pub step: f64,
    pub count: f64,
    /// Whether the moves between the touches of a circle are arcs.
    pub arcs: bool,
    /// Sideways distance of the second touch of a width from the first.
    pub beside: f64,
    /// Rotation of the feature, degrees.
    pub turn: f64,
    /// Distance from the position of the call down to the touches.
    pub down: Option<f64>,
    /// Whether the call writes its result, if one of its words decides that.
    pub corrects: bool,
    /// Row of the table, or number of the offset, that is written. `None` if the call only measures, or writes something that no job can ask for.
    pub row: Option<f64>,
}

impl Probed {
    /// A feature of which only the kind is known.
    pub const fn unknown(shape: Shape, inside: bool) -> Probed {
        Probed {
            shape,
            inside,
            center: Vec3::NAN,
            sizes: [f64::NAN; 2],
            edges: [Vec3::NAN; 2],
            axis: 2,
            towards: -1.0,
            set_up: None,
            high: None,
            lifts: false,
            start: 0.0,
            step: 90.0,
            count: 4.0,
            arcs: true,
            beside: 0.0,
            turn: 0.0,
            down: None,
            corrects: true,
            row: None,
        }
    }

    /// Direction along the measured axis.
    pub fn along(&self) -> Vec3 {
        Vec3::AXES[self.axis]
    }

    /// Part of a size that is left between the positions where the ball goes down.
    pub fn zone(&self, n: usize, radius: f64) -> f64 {
        self.sizes[n] - 2.0 * (self.set_up.unwrap_or(0.0) + 2.0 * radius)
    }

    /// The two touched points of a width.
    pub fn walls(&self) -> [Vec3; 2] {
        let half = self.along() * self.sizes[0] / 2.0;
        if self.edges[0].x.is_finite() {
            self.edges.map(|edge| edge.with_z(self.center.z))
        } else {
            [self.center + half, self.center - half]
        }
    }
}

/// Requirements of a job beside the feature.
#[derive(Clone, Copy, Debug, Default)]
pub struct Asked {
    pub limits: Limits,
    /// Number of the log.
    pub log: f64,
    /// Number of the tool to correct; 0 for none.
    pub tool: f64,
    /// Search distance past the contact.
    pub overtravel: f64,
    /// Radius of the ball.
    pub radius: f64,
}

/// Meaning of a word's value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Is {
    /// A coordinate of the centre, or of the contact of a surface.
    Center(usize),
    /// The coordinate of the centre along the measured axis.
    Along,
    /// A coordinate of the centre. A call may omit it: then it is that of the ball.
    Stated(usize),
    /// The coordinate of the centre along the measured axis, which a call may omit.
    StatedAlong,
    /// A coordinate of one of two opposite points, the first on the plus side.
    Edge(usize, usize),
    /// Diameter, width, or a side.
    Size(usize),
    /// The measured axis, from 1.
    Axis,
    Towards,
    /// Direction of the touch as 1 and 2.
    Facing,
    SetUp,
    High,
    Lifts,
    Start,
    Step,
    Count,
    Arcs,
    Beside,
    Turn,
    /// Distance from the position of the call down to the touches; 1 if nothing goes down.
    Down,
    /// Part of a size that the ball leaves free where it goes down between the walls; 1 elsewhere.
    Zone(usize),
    /// Largest allowed deviation of a wall.
    Safe,
    /// Kind of the feature; 100 more corrects, 1000 more goes down between the walls.
    Variant(u16),
    /// Written row.
    Row,
    /// Written table: 1 is the preset table, the only one that a job can ask for.
    Preset,
    /// New value of a coordinate of the centre: its nominal value.
    Gets(usize),
    /// New value of the coordinate along the measured axis.
    GetsAlong,
    /// Upper and lower limit of a size; 0 is no limit.
    Largest(usize),
    Smallest(usize),
    /// Upper and lower limit of the coordinate along the measured axis.
    Highest,
    Lowest,
    /// Largest deviation of the centre; 0 is no limit.
    Off,
    /// Whether it stops beyond the limits of sizes, of positions.
    Stops {
        sizes: bool,
        places: bool,
    },
    Log,
    /// Number of the tool to correct, 0 for none.
    Tool,
    /// A choice that no job makes: 0. Any other value writes something that a job cannot ask for.
    No,
    /// A number of every call.
    Always(Quantity),
    /// A number of every call that writes.
    Writing(Quantity),
}

impl Is {
    /// Value of a word, with its unit; `None` if the call does not have the word.
    pub fn value(self, of: &Probed, asked: &Asked) -> Option<Quantity> {
        let Limits { size, position, .. } = asked.limits;
        let one = Quantity::Plain(1.0);
        let flag = |on: bool| Quantity::Plain(f64::from(u8::from(on)));
        let length = Quantity::Length;
        Some(match self {
            Is::Center(axis) | Is::Stated(axis) | Is::Gets(axis) => length(of.center[axis]),
            Is::Along | Is::StatedAlong | Is::GetsAlong => length(of.center[of.axis]),
            Is::Edge(edge, axis) => length(of.walls()[edge][axis]),
            Is::Size(n) => length(of.sizes[n]),
            Is::Axis => Quantity::Plain((of.axis + 1) as f64),
            Is::Towards => Quantity::Plain(of.towards),
            Is::SetUp => length(of.set_up.unwrap_or(0.0)),
            Is::High => length(of.high.unwrap_or(0.0)),
            Is::Lifts => flag(of.lifts),
            Is::Start => Quantity::Angle(of.start),
            Is::Step => Quantity::Angle(of.step),
            Is::Count => Quantity::Plain(of.count),
            Is::Arcs => flag(of.arcs),
            Is::Beside => length(of.beside),
            Is::Row => Quantity::Plain(of.row?),
            Is::Preset => flag(true),
            Is::Largest(n) => length(size.map_or(0.0, |off| of.sizes[n] + off)),
            Is::Smallest(n) => length(size.map_or(0.0, |off| (of.sizes[n] - off).max(0.0))),
            Is::Highest => length(position.map_or(0.0, |off| of.center[of.axis] + off)),
            Is::Lowest => length(position.map_or(0.0, |off| of.center[of.axis] - off)),
            Is::Off => length(position.unwrap_or(0.0)),
            Is::Stops { sizes, places } => {
                flag(sizes && size.is_some() || places && position.is_some())
            }
            Is::Log => Quantity::Plain(asked.log),
            Is::Tool => Quantity::Plain(asked.tool),
            Is::No => flag(false),
            Is::Facing => Quantity::Plain(if of.towards > 0.0 { 1.0 } else { 2.0 }),
            Is::Turn => Quantity::Angle(of.turn),
            Is::Down => of.down.map_or(one, length),
            Is::Zone(n) => match of.inside && of.lifts {
                true => length(of.zone(n, asked.radius)),
                false => one,
            },
            Is::Safe => {
                let reach = asked.overtravel.min(of.set_up.unwrap_or(f64::INFINITY));
                length(reach.min(position.unwrap_or(f64::INFINITY)))
            }
            Is::Variant(kind) => {
                let zone = if of.inside && of.lifts { 1000.0 } else { 0.0 };
                let corrects = if of.row.is_some() { 100.0 } else { 0.0 };
                Quantity::Plain(f64::from(kind) + zone + corrects)
            }
            Is::Always(number) => number,
            Is::Writing(number) => of.row.map(|_| number)?,
        })
    }

    /// Stores the value of a word in the feature; `None` for an invalid value.
    fn take(self, value: f64, of: &mut Probed) -> Option<()> {
        match self {
            Is::Center(axis) | Is::Stated(axis) => of.center[axis] = value,
            Is::Edge(edge, axis) => of.edges[edge][axis] = value,
            Is::Size(n) => of.sizes[n] = value,
            Is::Axis => of.axis = [1.0, 2.0, 3.0].iter().position(|axis| *axis == value)?,
            Is::Towards => of.towards = Some(value).filter(|sign| sign.abs() == 1.0)?,
            Is::SetUp => of.set_up = Some(value),
            Is::High => of.high = Some(value),
            Is::Lifts => of.lifts = value == 1.0,
            Is::Start => of.start = value,
            Is::Step => of.step = value,
            Is::Count => of.count = value,
            Is::Arcs => of.arcs = value == 1.0,
            Is::Beside => of.beside = value,
            Is::Row => of.row = Some(value).filter(|_| of.corrects),
            Is::Along | Is::StatedAlong => of.center[of.axis] = value,
            Is::Facing => of.towards = if value == 1.0 { 1.0 } else { -1.0 },
            Is::Turn => of.turn = value,
            Is::Down => of.down = Some(value),
            Is::Variant(kind) => {
                (value % 10.0 == f64::from(kind)).then_some(())?;
                of.lifts = value >= 1000.0;
                of.corrects = corrects(value);
            }
            Is::Preset | Is::Gets(_) | Is::GetsAlong | Is::No | Is::Always(_) | Is::Writing(_) => {}
            Is::Largest(_) | Is::Smallest(_) | Is::Highest | Is::Lowest | Is::Off | Is::Safe => {}
            Is::Zone(_) | Is::Stops { .. } | Is::Log | Is::Tool => {}
        }
        Some(())
    }

    /// Whether nothing is known of the feature without it.
    fn is_needed(self) -> bool {
        matches!(
            self,
            Is::Center(_)
                | Is::Along
                | Is::Edge(..)
                | Is::Size(_)
                | Is::Axis
                | Is::Towards
                | Is::Facing
                | Is::Variant(1..)
        )
    }

    /// Whether the word decides that something is written that a job cannot ask for, unless it has the job's value.
    fn decides_write(self) -> bool {
        matches!(self, Is::Preset | Is::Gets(_) | Is::GetsAlong | Is::No)
    }
}

/// Whether the variant of a SINUMERIK's measuring cycle corrects, by its hundreds.
pub fn corrects(variant: f64) -> bool {
    (variant / 100.0).trunc() % 10.0 == 1.0
}

/// Words in the order of a call: number and meaning of each.
pub type Words = &'static [(u16, Is)];

/// A native call as a row.
#[derive(Debug)]
pub struct Row {
    pub number: u16,
    /// Text after the number in its block.
    pub head: &'static str,
    pub shape: Shape,
    pub inside: bool,
    /// Whether it writes its result; `None` if one of its words decides that.
    pub writes: Option<bool>,
    /// Its words; calls share groups of them.
    pub words: &'static [Words],
    /// Words that other programs may give it: they are read, not written.
    pub also: Words,
    /// Positions of its results.
    pub results: Words,
}

/// The first of these rows that probes the feature, and writes if that is wanted. A row without a word for the axis measures along the tool axis only.
pub fn fitting(rows: &'static [Row], of: &Probed) -> Option<&'static Row> {
    let writes = of.row.is_some();
    rows.iter().find(|row| {
        let along = of.axis == 2 || row.words().any(|(_, is)| is == Is::Axis);
        let same = (row.shape, row.inside) == (of.shape, of.inside);
        same && along && row.writes.is_none_or(|own| own == writes)
    })
}

/// A result of a call.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// Code in the job.
    pub code: &'static str,
    pub number: usize,
    pub is: Is,
}

impl Row {
    /// Its words in order.
    pub fn words(&self) -> impl Iterator<Item = (u16, Is)> {
        self.words.iter().flat_map(|group| group.iter().copied())
    }

    /// Whether it stops for sizes and for positions beyond their limits.
    pub fn stops(&self) -> [bool; 2] {
        let stops = self.words().find_map(|(_, is)| {
            if let Is::Stops { sizes, places } = is {
                Some([sizes, places])
            } else {
                None
            }
        });
        stops.unwrap_or_default()
    }

    /// Its results by their codes, with their storage. `places` are the codes of coordinates, `sizes` those of sizes; a result without a code is not used.
    pub fn found(
        &self,
        of: &Probed,
        places: &[&'static str],
        sizes: &[&'static str],
    ) -> Vec<Found> {
        let code = |is: Is| match is {
            Is::Center(axis) => places.get(axis).copied(),
            Is::Along => places.get(of.axis).copied(),
            Is::Size(n) => sizes.get(n).copied(),
            _ => None,
        };
        let found = |(number, is): &(u16, Is)| {
            let code = code(*is)?;
            Some(Found {
                code,
                number: usize::from(*number),
                is: *is,
            })
        };
        let mut found: Vec<Found> = self.results.iter().filter_map(found).collect();
        // Sizes in the order of the job: its first side may lie along Y.
        let size = |found: &Found| matches!(found.is, Is::Size(_)).then_some(found.code);
        found.sort_by_key(size);
        found
    }

    /// Words of the call for a feature.
    pub fn call(&self, of: &Probed, asked: &Asked) -> Vec<(u16, Quantity)> {
        self.words()
            .filter_map(|(number, is)| Some((number, is.value(of, asked)?)))
            .collect()
    }

    /// The feature of a call with these values; `None` if a necessary value is missing. `from` is the ball centre at the call.
    pub fn probed(&self, from: Vec3, get: impl Fn(u16) -> Option<f64>) -> Option<Probed> {
        let mut of = Probed {
            center: from,
            ..Probed::unknown(self.shape, self.inside)
        };
        // A position along an axis needs the axis.
        let axis = |(_, is): &(u16, Is)| matches!(is, Is::Axis);
        let others = self.words().filter(|word| !axis(word));
        let others = others.chain(self.also.iter().copied());
        for (number, is) in self.words().filter(axis).chain(others) {
            match get(number) {
                Some(value) => is.take(value, &mut of)?,
                None if is.is_needed() => return None,
                None => {}
            }
        }
        if self.words().any(|(_, is)| matches!(is, Is::Edge(..))) {
            let [one, other] = of.edges;
            let middle = (one + other) / 2.0;
            (of.center.x, of.center.y) = (middle.x, middle.y);
        }
        if self.shape == Shape::Width && of.axis > 1 {
            return None;
        }
        let asked = Asked::default();
        let same = |(number, is): (u16, Is)| match get(number) {
            Some(given) => is
                .value(&of, &asked)
                .is_some_and(|own| own.value() == given),
            None => is != Is::Preset,
        };
        let kept = self.words().filter(|(_, is)| is.decides_write()).all(same);
        of.row = of.row.filter(|_| kept);
        Some(of)
    }
}
