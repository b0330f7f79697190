//! The calls by which a control's own cycles do what a cycle is for.

use crate::geom::Vec3;

/// A value of a call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quantity {
    /// mm.
    Length(f64),
    /// mm/min.
    Feed(f64),
    /// Degrees.
    Angle(f64),
    /// A number as it stands.
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
    /// A result of the call before, by its place in that call's output, kept in the variable of this number: the next call empties it.
    Keep(usize, usize),
}

/// Where a result of a call is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stored {
    /// By its place in the output of the last call.
    Output(usize),
    /// In a variable that it was kept in.
    Kept(usize),
}

/// A program of calls, and how many moves of the path each of them makes.
#[derive(Clone, Debug, PartialEq)]
pub struct Own {
    /// Where the first moves come to, in the plane and then down: the first move of the path.
    pub first: Vec3,
    pub blocks: Vec<(OwnBlock, usize)>,
    /// Which of the moves that the calls ask for each move behind the first is: on another part some have no length.
    pub counts: Vec<usize>,
    /// Where each result is found, by its code.
    pub stored: Vec<(&'static str, Stored)>,
}
