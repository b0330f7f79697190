//! Shifts of positions by values that a program computes.

use crate::formula::Variable;
use crate::geom::Vec3;

/// A variable that shifts a position along an axis, with its factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShiftTerm {
    pub by: Variable,
    /// Factor of the variable: mm if the variable has no unit, else a plain number.
    pub factor: f64,
    /// Whether the factor is a length.
    pub length: bool,
    /// Largest absolute value of the variable.
    pub(super) most: f64,
}

/// Terms that shift a position along X, Y and Z.
pub type Shifts = [Vec<ShiftTerm>; 3];

/// A position without any shift.
pub const NO_SHIFT: &Shifts = &[const { Vec::new() }; 3];

/// Largest shift of a position along X, Y and Z, mm.
pub fn most(shifts: &Shifts) -> Vec3 {
    let along = |axis: usize| {
        shifts[axis]
            .iter()
            .map(|term| (term.factor * term.most).abs())
            .sum()
    };
    Vec3::new(along(0), along(1), along(2))
}

/// Largest change of the distance between the two ends of a move, mm, for these shifts of the ends.
pub fn far_apart(from: &Shifts, to: &Shifts) -> f64 {
    let factor = |of: &[ShiftTerm], by: Variable| {
        of.iter()
            .find(|term| term.by == by)
            .map_or(0.0, |term| term.factor)
    };
    let along = |axis: usize| {
        let (a, b) = (&from[axis], &to[axis]);
        let left = a
            .iter()
            .filter(|term| b.iter().all(|other| other.by != term.by));
        left.chain(b)
            .map(|term| (factor(b, term.by) - factor(a, term.by)).abs() * term.most)
            .sum()
    };
    Vec3::new(along(0), along(1), along(2)).length()
}
