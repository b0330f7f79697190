//! Calls that are read both ways: each word says what it is of what is probed. The planner of programs makes words of a feature, the reader of programs a
//! feature of words, and the virtual part runs what the words say.

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
    /// The row of the table that is written; none measures only, or writes what a job has no word for.
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
            row: None,
        }
    }

    /// A direction along the axis that is measured.
    pub fn along(&self) -> Vec3 {
        Vec3::AXES[self.axis]
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
}

/// What the value of a word is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Is {
    /// A coordinate of the centre, or of the contact of a surface.
    Center(usize),
    /// The same along the axis that is measured.
    Along,
    /// A coordinate of one of two opposite points, the first on the plus side.
    Edge(usize, usize),
    /// The diameter, the width, or a side.
    Size(usize),
    /// The axis that is measured, from 1.
    Axis,
    Towards,
    SetUp,
    High,
    Lifts,
    Start,
    Step,
    Count,
    Arcs,
    Beside,
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
    /// A number that means nothing beside such a choice.
    Idle,
}

impl Is {
    /// The value of a word, with its unit.
    pub fn value(self, of: &Probed, asked: &Asked) -> Quantity {
        let Limits { size, position, .. } = asked.limits;
        let flag = |on: bool| Quantity::Plain(f64::from(u8::from(on)));
        let length = Quantity::Length;
        match self {
            Is::Center(axis) | Is::Gets(axis) => length(of.center[axis]),
            Is::Along | Is::GetsAlong => length(of.center[of.axis]),
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
            Is::Row => Quantity::Plain(of.row.unwrap_or(0.0)),
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
            Is::Idle => length(0.0),
        }
    }

    /// Takes the value of a word into what is probed; none where that is no value of it.
    fn take(self, value: f64, of: &mut Probed) -> Option<()> {
        match self {
            Is::Center(axis) => of.center[axis] = value,
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
            Is::Row => of.row = Some(value),
            Is::Along
            | Is::Preset
            | Is::Gets(_)
            | Is::GetsAlong
            | Is::No
            | Is::Idle
            | Is::Log
            | Is::Off
            | Is::Stops { .. } => {}
            Is::Largest(_) | Is::Smallest(_) | Is::Highest | Is::Lowest => {}
        }
        Some(())
    }

    /// Whether nothing can be said of the feature without it.
    fn is_needed(self) -> bool {
        matches!(
            self,
            Is::Center(_) | Is::Edge(..) | Is::Size(_) | Is::Axis | Is::Towards
        )
    }

    /// Whether a row is written for what a job has no word for, unless the word has the value that a job gives it.
    fn decides_write(self) -> bool {
        matches!(self, Is::Preset | Is::Gets(_) | Is::GetsAlong | Is::No)
    }
}

/// Words in the order of a call: the number of each, and what it is.
pub type Words = &'static [(u16, Is)];

/// A call that is read both ways.
#[derive(Debug)]
pub struct Row {
    pub number: u16,
    /// What stands behind the number in its block.
    pub head: &'static str,
    pub shape: Shape,
    pub inside: bool,
    /// Whether it writes what it measures.
    pub writes: bool,
    /// Its words; calls share groups of them.
    pub words: &'static [Words],
    /// Where its results are found.
    pub results: Words,
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

    /// The words of the call for what is to be probed.
    pub fn call(&self, of: &Probed, asked: &Asked) -> Vec<(u16, Quantity)> {
        self.words()
            .map(|(number, is)| (number, is.value(of, asked)))
            .collect()
    }

    /// What a call with these values probes; none where they do not say enough.
    pub fn probed(&self, get: impl Fn(u16) -> Option<f64>) -> Option<Probed> {
        let mut of = Probed::unknown(self.shape, self.inside);
        for (number, is) in self.words() {
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
            Some(given) => given == is.value(&of, &asked).value(),
            None => is != Is::Preset,
        };
        let kept = self.words().filter(|(_, is)| is.decides_write()).all(same);
        of.row = of.row.filter(|_| kept);
        Some(of)
    }
}
