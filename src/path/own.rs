//! The calls by which native cycles do what a cycle is for.

use crate::geom::Vec3;
use crate::path::Feed;

/// A value of a call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quantity {
    /// mm.
    Length(f64),
    /// mm/min.
    Feed(f64),
    /// Degrees.
    Angle(f64),
    /// A plain number.
    Plain(f64),
}

impl Quantity {
    /// mm, mm/min, degrees.
    pub fn value(self) -> f64 {
        match self {
            Quantity::Length(x) | Quantity::Feed(x) | Quantity::Angle(x) | Quantity::Plain(x) => x,
        }
    }
}

/// A block of such a program.
#[derive(Clone, Debug, PartialEq)]
pub enum OwnBlock {
    /// A macro by its number, with its letters.
    Call(u32, Vec<(char, Quantity)>),
    /// A cycle by its number, with its parameters by theirs: Q of a HEIDENHAIN, places of a SINUMERIK.
    Cycle(u16, Vec<(u16, Quantity)>),
    /// A watched move of the program to a place.
    Goes(Vec3, Feed),
    /// A result of the call before, by its place in that call's output, kept in the variable of this number: the next call empties it.
    Keep(usize, usize),
}

impl OwnBlock {
    /// Whether it measures something: a protected move, the probe on and off, what lies between two features and a preset do not.
    pub fn measures(&self) -> bool {
        match self {
            OwnBlock::Call(number, _) => ![9810, 9832, 9833, 9834, 9835].contains(number),
            OwnBlock::Cycle(number, _) => *number != 247,
            OwnBlock::Goes(..) | OwnBlock::Keep(..) => false,
        }
    }

    /// Whether it writes a work offset.
    pub fn writes(&self) -> bool {
        match self {
            OwnBlock::Call(_, letters) => letters.iter().any(|(letter, _)| *letter == 'S'),
            // The row of a preset, or a frame.
            OwnBlock::Cycle(977 | 978, arguments) => arguments.iter().any(|(place, _)| *place == 2),
            OwnBlock::Cycle(_, parameters) => parameters.iter().any(|(q, _)| *q == 305),
            OwnBlock::Goes(..) | OwnBlock::Keep(..) => false,
        }
    }
}

/// Where a result of a call is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stored {
    /// By its place in the output of the last call.
    Output(usize),
    /// In a variable that it was kept in.
    Kept(usize),
}

/// What a call stops for before it writes: results that are off by as much.
#[derive(Clone, Debug, PartialEq)]
pub struct Guard {
    /// The results that it looks at, by their codes.
    pub codes: Vec<&'static str>,
    pub off: Off,
    /// mm or degrees.
    pub limit: f64,
}

/// What of the results a call compares with its limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Off {
    /// Each on its own.
    Each,
    /// How far the place is off in the plane.
    Place,
    /// The directions of both walls of a corner: it stops only where both are off.
    BothWalls,
}

/// What a table of the control says of touches, mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach {
    /// Added to the clearance in front of each contact.
    pub set_up: f64,
    /// How far behind its contact a touch searches.
    pub behind: f64,
}

impl Own {
    /// The tool offsets that its calls correct, each once.
    pub fn tools(&self) -> Vec<i32> {
        let corrected = self.blocks.iter().filter_map(|(block, _)| match block {
            OwnBlock::Call(_, letters) => letters
                .iter()
                .find(|(letter, _)| *letter == 'T')
                .map(|(_, tool)| tool.value() as i32),
            _ => None,
        });
        let mut tools: Vec<i32> = corrected.collect();
        tools.sort_unstable();
        tools.dedup();
        tools
    }

    /// Keeps what the next cycle would empty, and counts what is kept from `kept` on, where other cycles have kept so much. How much is kept then.
    pub fn keep(&mut self, last: bool, (first, kept): (usize, usize)) -> usize {
        let shift = |variable: usize| variable + kept;
        let mut count = 0;
        for (block, _) in &mut self.blocks {
            if let OwnBlock::Keep(variable, _) = block {
                *variable = shift(*variable);
                count += 1;
            }
        }
        for (_, stored) in &mut self.stored {
            *stored = match *stored {
                Stored::Kept(variable) => Stored::Kept(shift(variable)),
                Stored::Output(output) if !last => {
                    let variable = first + kept + count;
                    count += 1;
                    self.blocks.push((OwnBlock::Keep(variable, output), 0));
                    Stored::Kept(variable)
                }
                output => output,
            };
        }
        kept + count
    }
}

/// A program of calls, and how many moves of the path each of them makes.
#[derive(Clone, Debug, PartialEq)]
pub struct Own {
    /// Where the first moves come to, in the plane and then down: the first move of the path.
    pub first: Vec3,
    pub blocks: Vec<(OwnBlock, usize)>,
    /// Which of the moves that the calls ask for each move behind the first is: on another part some have no length.
    pub counts: Vec<usize>,
    /// Where each result is found, by its code; of a set-up [`Path::stored`](crate::path::Path::stored) says it.
    pub stored: Vec<(&'static str, Stored)>,
    /// What its calls stop for, in their order.
    pub guards: Vec<Guard>,
    /// How far its touches reach, where the calls do not say it.
    pub reach: Reach,
}
