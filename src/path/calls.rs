//! Sequence of native-cycle calls that carries out one probing cycle.

use crate::geom::Vec3;
use crate::path::{Feed, ShiftTerm};

/// A value in a call, with its kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quantity {
    /// mm.
    Length(f64),
    /// mm/min.
    Feed(f64),
    /// Degrees.
    Angle(f64),
    /// A number without a unit.
    Plain(f64),
}

impl Quantity {
    /// The number, in mm, mm/min or degrees.
    pub fn value(self) -> f64 {
        match self {
            Quantity::Length(x) | Quantity::Feed(x) | Quantity::Angle(x) | Quantity::Plain(x) => x,
        }
    }
}

/// A block of a program of native calls.
#[derive(Clone, Debug, PartialEq)]
pub enum CallBlock {
    /// A macro call: number and letters.
    Call(u32, Vec<(char, Quantity)>),
    /// A cycle call: number and parameters. HEIDENHAIN counts Q parameters, SINUMERIK positions in the list.
    Cycle(u16, Vec<(u16, Quantity)>),
    /// A watched move to a position.
    MoveTo(Vec3, Feed),
    /// Saves a result of the previous call, given by its position in that call's output, in a variable: the next call overwrites the output.
    SaveResult(usize, usize),
    /// Computes what the results so far give, and checks what the next cycle of a set-up follows: that cycle's index, or the number of cycles at the end.
    Compute(usize),
}

impl CallBlock {
    /// Whether the block measures. Protected moves, probe on and off, link moves between features and presets do not.
    pub fn measures(&self) -> bool {
        match self {
            CallBlock::Call(number, _) => ![9810, 9832, 9833, 9834, 9835].contains(number),
            CallBlock::Cycle(number, _) => *number != 247,
            CallBlock::MoveTo(..) | CallBlock::SaveResult(..) | CallBlock::Compute(_) => false,
        }
    }

    /// Values of its words, in their order.
    pub fn values(&self) -> Vec<Quantity> {
        match self {
            CallBlock::Call(_, letters) => letters.iter().map(|(_, value)| *value).collect(),
            CallBlock::Cycle(_, parameters) => parameters.iter().map(|(_, value)| *value).collect(),
            CallBlock::MoveTo(to, _) => to.to_array().map(Quantity::Length).to_vec(),
            CallBlock::SaveResult(..) | CallBlock::Compute(_) => Vec::new(),
        }
    }

    /// Whether a word is the value that a coordinate shall get where the cycle writes: it stays that of the drawing.
    pub fn is_wanted(&self, word: usize) -> bool {
        match self {
            CallBlock::Cycle(_, parameters) => {
                let q = parameters.get(word).map(|(q, _)| *q);
                matches!(q, Some(331..=333 | 405))
            }
            _ => false,
        }
    }

    /// Axis of the coordinate that a word of a link move gives.
    pub fn axis_of(&self, word: usize) -> Option<usize> {
        match self {
            CallBlock::Call(_, letters) => {
                let (letter, _) = letters.get(word)?;
                ['X', 'Y', 'Z'].iter().position(|axis| axis == letter)
            }
            CallBlock::MoveTo(..) => Some(word),
            CallBlock::Cycle(..) | CallBlock::SaveResult(..) | CallBlock::Compute(_) => None,
        }
    }

    /// Whether another block differs in nothing but the values of its words.
    pub fn is_like(&self, other: &CallBlock) -> bool {
        match (self, other) {
            (CallBlock::Call(own, a), CallBlock::Call(number, b)) => {
                own == number
                    && a.iter()
                        .map(|(name, _)| name)
                        .eq(b.iter().map(|(name, _)| name))
            }
            (CallBlock::Cycle(own, a), CallBlock::Cycle(number, b)) => {
                own == number
                    && a.iter()
                        .map(|(name, _)| name)
                        .eq(b.iter().map(|(name, _)| name))
            }
            (CallBlock::MoveTo(_, own), CallBlock::MoveTo(_, feed)) => own == feed,
            _ => self == other,
        }
    }

    /// Whether it writes a work offset.
    pub fn writes(&self) -> bool {
        match self {
            CallBlock::Call(_, letters) => letters.iter().any(|(letter, _)| *letter == 'S'),
            // Row of a preset, or a frame.
            CallBlock::Cycle(977 | 978, arguments) => {
                arguments.iter().any(|(place, _)| *place == 2)
            }
            CallBlock::Cycle(_, parameters) => parameters.iter().any(|(q, _)| *q == 305),
            CallBlock::MoveTo(..) | CallBlock::SaveResult(..) | CallBlock::Compute(_) => false,
        }
    }
}

/// Storage of a result after a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stored {
    /// Position in the output of the last call.
    Output(usize),
    /// Variable in which the result was saved.
    Kept(usize),
}

/// A check that a call makes before it writes: it stops if results deviate by this limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Guard {
    /// Codes of the checked results.
    pub codes: Vec<&'static str>,
    pub off: Off,
    /// In mm or degrees.
    pub limit: f64,
}

/// Comparison of results with the limit of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Off {
    /// Each result separately.
    Each,
    /// Distance of the position in the plane.
    Place,
    /// Directions of both walls of a corner; the call stops only if both exceed the limit.
    BothWalls,
}

/// Touch settings from the control's probe table, mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProbeTable {
    /// Added to the clearance in front of each contact.
    pub set_up: f64,
    /// Search distance past the nominal contact.
    pub overtravel: f64,
}

impl CallSequence {
    /// Tool offsets that the calls correct, each once.
    pub fn tools(&self) -> Vec<i32> {
        let corrected = self.blocks.iter().filter_map(|(block, _)| match block {
            CallBlock::Call(_, letters) => letters
                .iter()
                .find(|(letter, _)| *letter == 'T')
                .map(|(_, tool)| tool.value() as i32),
            CallBlock::Cycle(421..=427, parameters) => parameters
                .iter()
                .find(|(q, _)| *q == 330)
                .map(|(_, tool)| tool.value() as i32),
            _ => None,
        });
        // A cycle of a HEIDENHAIN names tool 0 if it corrects none.
        let mut tools: Vec<i32> = corrected.filter(|tool| *tool != 0).collect();
        tools.sort_unstable();
        tools.dedup();
        tools
    }

    /// Saves the results that the next cycle would overwrite. Variables are counted on from `kept`, the number that other cycles use. Returns the new number.
    pub fn save_results(&mut self, last: bool, (first, kept): (usize, usize)) -> usize {
        let shift = |variable: usize| variable + kept;
        let mut count = 0;
        for (block, _) in &mut self.blocks {
            if let CallBlock::SaveResult(variable, _) = block {
                *variable = shift(*variable);
                count += 1;
            }
        }
        for (_, stored) in &mut self.measured {
            if let Stored::Kept(variable) = stored {
                *variable = shift(*variable);
            }
        }
        for (_, stored) in &mut self.stored {
            *stored = match *stored {
                Stored::Kept(variable) => Stored::Kept(shift(variable)),
                Stored::Output(output) if !last => {
                    let variable = first + kept + count;
                    count += 1;
                    self.blocks
                        .push((CallBlock::SaveResult(variable, output), 0));
                    Stored::Kept(variable)
                }
                output => output,
            };
        }
        kept + count
    }
}

/// A sequence of native calls, with the number of moves that each makes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CallSequence {
    /// First position, reached in the plane and then downwards: the end of the path's first move.
    pub first: Vec3,
    pub blocks: Vec<(CallBlock, usize)>,
    /// Calls before them that only measure and show their results, on a control whose writing calls are other ones.
    pub measuring: Vec<(CallBlock, usize)>,
    /// For each move after the first, its ordinal among the moves that the calls make. On another part some of these moves have no length.
    pub counts: Vec<usize>,
    /// Storage of each result, by its code. [`Path::stored`](crate::path::Path::stored) answers for a set-up.
    pub stored: Vec<(&'static str, Stored)>,
    /// Values of the formula that the calls store, by assignment: the program computes the results from them.
    pub measured: Vec<(usize, Stored)>,
    /// Checks that the calls make before they write, in order.
    pub guards: Vec<Guard>,
    /// Touch settings, if the calls do not state them.
    pub reach: ProbeTable,
    /// Words that follow results, by block and word, with the terms that shift them.
    pub shifted: Vec<(usize, usize, Vec<ShiftTerm>)>,
    /// Values that the program computes between the cycles, by the index of the assignment.
    pub computed: Vec<Option<Computed>>,
}

/// Place of a value in a program that computes between native cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Computed {
    /// A result that a call measures.
    Measured(Stored),
    /// A variable that the program computes before this cycle, by its index; or after the last one.
    Register { variable: usize, before: usize },
}

impl CallSequence {
    /// Terms that shift a word of a block.
    pub fn shifts(&self, block: usize, word: usize) -> &[ShiftTerm] {
        let of =
            |(own, other, _): &&(usize, usize, Vec<ShiftTerm>)| (*own, *other) == (block, word);
        self.shifted
            .iter()
            .find(of)
            .map_or(&[], |(.., terms)| terms)
    }

    /// Whether the program computes anything.
    pub fn computes(&self) -> bool {
        let computed = |place: &Option<Computed>| matches!(place, Some(Computed::Register { .. }));
        self.computed.iter().any(computed)
    }

    /// Whether it is a program of several cycles that may stop between them.
    pub fn checks(&self) -> bool {
        let computes = |(block, _): &(CallBlock, usize)| matches!(block, CallBlock::Compute(_));
        self.blocks.iter().any(computes)
    }

    /// Cycle before which the program computes a value, by its index.
    pub fn computed_before(&self, assignment: usize) -> Option<usize> {
        match self.computed.get(assignment).copied().flatten()? {
            Computed::Register { before, .. } => Some(before),
            Computed::Measured(_) => None,
        }
    }

    /// Variable of a value that the program measures or computes.
    pub fn stored_value(&self, assignment: usize) -> Option<Stored> {
        match self.computed.get(assignment).copied().flatten()? {
            Computed::Measured(stored) => Some(stored),
            Computed::Register { variable, .. } => Some(Stored::Kept(variable)),
        }
    }
}
