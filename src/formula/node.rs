//! Nodes of a formula in one flat list: each node refers to its operands by their indices before it.

/// Index of a node in the list of its formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodeId(pub(super) u32);

/// An expression over the triggers of the touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Node {
    /// A plain number, the same in all units.
    Number(f64),
    /// A length in mm.
    Length(f64),
    /// The value of an earlier assignment.
    Variable(Variable),
    /// Coordinate `axis` (0 = X) of the ball centre at the trigger of a sample: a touch, or the mean of repeated touches.
    Trigger {
        sample: u16,
        /// 0, 1, 2 for X, Y, Z.
        axis: u8,
    },
    Binary(Op, NodeId, NodeId),
    Call(Function, NodeId),
    /// A part of a fitted circle.
    Circle(Samples, CirclePart),
    /// Angle of the vector (second operand, first operand), degrees, in the right quadrant.
    Atan2(NodeId, NodeId),
}

/// The index of an assignment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variable(pub(super) u32);

impl Variable {
    /// Index in the list of assignments.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Op {
    Add,
    Subtract,
    Multiply,
    Divide,
}

/// A function of one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// Sine of degrees.
    Sin,
    /// Cosine of degrees.
    Cos,
    Sqrt,
    Abs,
}

/// Samples to which a circle is fitted in a plane: geometric least squares, exact for three.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Samples {
    /// Index of the first sample.
    pub(super) first: u16,
    pub(super) count: u8,
    /// Axes of abscissa and ordinate.
    pub(super) axes: (u8, u8),
}

impl Samples {
    pub(super) fn range(self) -> std::ops::Range<usize> {
        usize::from(self.first)..usize::from(self.first) + usize::from(self.count)
    }
}

/// A part of a fitted circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CirclePart {
    /// Abscissa of its centre.
    Abscissa,
    /// Ordinate of its centre.
    Ordinate,
    Radius,
    /// Root mean square distance of the samples from the circle.
    Residual,
}
