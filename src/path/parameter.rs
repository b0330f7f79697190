//! The rows of the source's parameter table.

use crate::text::Text;
/// Address of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accessor {
    /// `CmdPrm.Int[ ]`.
    Int,
    /// `CmdPrm.Flt[ ]`.
    Flt,
    /// `CmdPrm.Bol[ ]`.
    Bol,
    /// A Q parameter of a HEIDENHAIN cycle.
    Q,
}

impl Accessor {
    /// Accessors of a CAM parameter table.
    pub const CMD_PRM: [Accessor; 3] = [Accessor::Int, Accessor::Flt, Accessor::Bol];

    /// The word of the accessor: `Int`, `Flt`, `Bol`, `Q`.
    pub const fn word(self) -> &'static str {
        match self {
            Accessor::Int => "Int",
            Accessor::Flt => "Flt",
            Accessor::Bol => "Bol",
            Accessor::Q => "Q",
        }
    }
}

/// One row of the source's parameter table, before units.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The code inside the brackets of `CmdPrm.…[ ]`.
    pub code: i32,
    pub accessor: Accessor,
    /// Entry in the type column of the source's page.
    pub type_name: &'static str,
    pub value: ParameterValue,
    pub meaning: Text,
    /// Path of the job field that gives the value.
    pub field: Option<String>,
    /// Index of the touch that gives the value.
    pub touch: Option<usize>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum ParameterValue {
    /// A length, mm.
    Length(f64),
    /// A plain number, or an angle in degrees.
    Number(f64),
    Whole(i32),
    Flag(bool),
    /// A text, printed as it is.
    Text(String),
    /// A word of the control in place of a number.
    Word(&'static str),
}
