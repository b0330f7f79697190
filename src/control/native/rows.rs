//! Calls that are read both ways. A row lists the words of a call and what each of them means for the feature. The planner turns a feature into words,
//! the reader of programs turns words into a feature, and the virtual part runs the call.

use crate::formula::Limits;
use crate::geom::Vec3;
use crate::path::Quantity;

/// What kind of feature a call probes.
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

/// What a call probes, in numbers: lengths in one unit, angles in degrees. What is not known is NaN or none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probed {
    pub shape: Shape,
    /// Whether the material lies around it.
    pub inside: bool,
    /// The centre, at the height of the touches; of a surface its contact.
    pub center: Vec3,
    /// The diameter, the width, or the sides along X and Y.
    pub sizes: [f64; 2],
    /// Two opposite points, where a call names those and no centre.
    pub edges: [Vec3; 2],
    /// The axis that is measured along: 0 is X.
    pub axis: usize,
    /// The direction of the touch along it: 1 or −1.
    pub towards: f64,
    /// From the surface of the ball to the contact where a touch begins, less what a table of the control adds.
    pub set_up: Option<f64>,
    /// The height at which the ball crosses between touches, and ends.
    pub high: Option<f64>,
    /// Whether it goes up there between two touches.
    pub lifts: bool,
    /// The angle of the first touch of a circle, from one to the next, and how many there are.
    pub start: f64,
    pub step: f64,
    pub count: f64,
    /// Whether the ways between the touches of a circle are arcs.
    pub arcs: bool,
    /// How far the second touch of a width lies beside the first.
    pub beside: f64,
    /// By how much a feature is turned, degrees.
    pub turn: f64,
    /// From where the call is made down to the touches.
    pub down: Option<f64>,
    /// Whether the call writes what it measures, if one of its words decides that.
    pub corrects: bool,
    /// The row of the table, or the number of the offset, that is written. None if the call only measures, or writes what no job can ask for.
    pub row: Option<f64>,
}

impl Probed {
    /// A feature of which nothing but its kind is known.
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

    /// A direction along the axis that is measured.
    pub fn along(&self) -> Vec3 {
        Vec3::AXES[self.axis]
    }

    /// What is left of a size between the places where the ball goes down.
    pub fn zone(&self, n: usize, radius: f64) -> f64 {
        self.sizes[n] - 2.0 * (self.set_up.unwrap_or(0.0) + 2.0 * radius)
    }

    /// The two points that a width is touched at.
    pub fn walls(&self) -> [Vec3; 2] {
        let half = self.along() * self.sizes[0] / 2.0;
        if self.edges[0].x.is_finite() {
            self.edges.map(|edge| edge.with_z(self.center.z))
        } else {
            [self.center + half, self.center - half]
        }
    }
}

/// What a job asks of the results, beside the feature.
#[derive(Clone, Copy, Debug, Default)]
pub struct Asked {
    pub limits: Limits,
    /// The number of the log.
    pub log: f64,
    /// How far a touch searches behind its contact.
    pub overtravel: f64,
    /// Of the ball.
    pub radius: f64,
}

/// What the value of a word is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Is {
    /// A coordinate of the centre, or of the contact of a surface.
    Center(usize),
    /// The same along the axis that is measured.
    Along,
    /// A coordinate of the centre. A call may leave it out: the centre is then where the ball is.
    Stated(usize),
    /// The same along the axis that is measured.
    StatedAlong,
    /// A coordinate of one of two opposite points, the first on the plus side.
    Edge(usize, usize),
    /// The diameter, the width, or a side.
    Size(usize),
    /// The axis that is measured, from 1.
    Axis,
    Towards,
    /// The same as 1 and 2.
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
    /// From where the call is made down to the touches; 1 where nothing goes down.
    Down,
    /// What the ball leaves free of a size where it goes down between the walls; 1 elsewhere.
    Zone(usize),
    /// How far a wall may be off.
    Safe,
    /// The kind of the feature; 100 more corrects, 1000 more goes down between the walls.
    Variant(u16),
    /// The row that is written.
    Row,
    /// Where it is written: 1 is the table of presets, the only one that a job has a word for.
    Preset,
    /// What a coordinate of the centre becomes: its nominal value.
    Gets(usize),
    /// The same along the axis that is measured.
    GetsAlong,
    /// What a limit of a size allows at most, and at least; 0 asks nothing.
    Largest(usize),
    Smallest(usize),
    /// The same of the coordinate along the axis that is measured.
    Highest,
    Lowest,
    /// How far the centre may be off; 0 asks nothing.
    Off,
    /// Whether it stops beyond the limits of sizes, of places.
    Stops {
        sizes: bool,
        places: bool,
    },
    Log,
    /// A choice that no job makes: 0. Another one writes what a job has no word for.
    No,
    /// A number that every call has.
    Always(Quantity),
    /// A number that every call has that writes.
    Writing(Quantity),
}

impl Is {
    /// The value of a word, with its unit; `None` if the call does not have it.
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

    /// Takes the value of a word into what is probed; `None` if that is no value of it.
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
            Is::Zone(_) | Is::Stops { .. } | Is::Log => {}
        }
        Some(())
    }

    /// Whether nothing can be said of the feature without it.
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

    /// Whether a row is written for what a job has no word for, unless the word has the value that a job gives it.
    fn decides_write(self) -> bool {
        matches!(self, Is::Preset | Is::Gets(_) | Is::GetsAlong | Is::No)
    }
}

/// Whether the variant of a SINUMERIK's measuring cycle corrects: by its hundreds.
pub fn corrects(variant: f64) -> bool {
    (variant / 100.0).trunc() % 10.0 == 1.0
}

/// Words in the order of a call: the number of each, and what it is.
pub type Words = &'static [(u16, Is)];

/// A call that is read both ways.
#[derive(Debug)]
pub struct Row {
    pub number: u16,
    /// Text after the number in its block.
    pub head: &'static str,
    pub shape: Shape,
    pub inside: bool,
    /// Whether it writes what it measures; `None` if one of its words decides that.
    pub writes: Option<bool>,
    /// Its words; calls share groups of them.
    pub words: &'static [Words],
    /// Words that other programs may give it: they are read, and not written.
    pub also: Words,
    /// Where its results are found.
    pub results: Words,
}

/// The first of these rows that probes the feature, and writes where that is wanted. A row without a word for the axis measures along the tool axis only.
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
    /// Its code in the job.
    pub code: &'static str,
    pub number: usize,
    pub is: Is,
}

impl Row {
    /// Its words, in their order.
    pub fn words(&self) -> impl Iterator<Item = (u16, Is)> {
        self.words.iter().flat_map(|group| group.iter().copied())
    }

    /// Whether it stops for sizes and for places that are off by more than their limits.
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

    /// Its results by their codes, and where each is found. `places` are the codes of coordinates, `sizes` those of sizes; a result without one is not used.
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

    /// The words of the call for what is to be probed.
    pub fn call(&self, of: &Probed, asked: &Asked) -> Vec<(u16, Quantity)> {
        self.words()
            .filter_map(|(number, is)| Some((number, is.value(of, asked)?)))
            .collect()
    }

    /// What a call with these values probes; none if a value that it needs is missing. `from` is the position of the ball at the call.
    pub fn probed(&self, from: Vec3, get: impl Fn(u16) -> Option<f64>) -> Option<Probed> {
        let mut of = Probed {
            center: from,
            ..Probed::unknown(self.shape, self.inside)
        };
        // A place along an axis needs the axis.
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
