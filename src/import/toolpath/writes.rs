//! Lasting changes by a program: work offsets, shifts, the tool table. One kind of event for every way of writing.

use serde::Serialize;

/// Names of the kinds of writes.
pub const WRITE_KINDS: [&str; 6] = ["offset", "shift", "length", "radius", "wear", "table"];
pub(super) const OFFSET: &str = WRITE_KINDS[0];
pub(super) const SHIFT: &str = WRITE_KINDS[1];
pub(super) const LENGTH: &str = WRITE_KINDS[2];
pub(super) const RADIUS: &str = WRITE_KINDS[3];
pub(super) const WEAR: &str = WRITE_KINDS[4];
pub(super) const TABLE: &str = WRITE_KINDS[5];

/// A lasting change that a program makes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Write {
    /// The 0-based line in its file.
    pub line: u32,
    /// Its file: 0 is the program, higher numbers are files of subprograms, counted from 1.
    pub file: u32,
    /// One of [`WRITE_KINDS`].
    pub kind: &'static str,
    /// The register in the control's notation: `G54`, `G92`, `tool 5`, `#2605`.
    pub register: String,
    /// `X`, `Y`, `Z`, or `R` for a rotation; `None` if the measured feature decides it.
    pub axis: Option<&'static str>,
    /// In the program's first units, a rotation in degrees; `None` if it is unknown. With `G10 L20` and G92 the current position gets the value.
    pub value: Option<f64>,
    /// Whether the write depends on a condition after the last touch. `Some(false)`: there is no condition. `None`: what the condition compares is unknown.
    pub guarded: Option<bool>,
    /// Number of moves before the write.
    #[serde(skip)]
    pub(super) moves: usize,
}

/// A variable that writes a register of the control.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Variable {
    /// An axis of a work offset by its number, or its rotation (3).
    Offset(i32, usize),
    /// Any part of any work offset.
    AnyOffset(String),
    /// A frame of the program, which does not last.
    ProgramFrame,
    Shift(usize),
    External(usize),
    /// The tool table: kind and name.
    Tool(&'static str, String),
}

/// Number of axes of a work offset.
pub(super) const OFFSET_AXES: usize = 3;

/// The names of axes, and of a rotation.
pub(super) const AXES: [&str; 4] = ["X", "Y", "Z", "R"];

/// Register of a variable of LinuxCNC (#5211 …) or of a Fanuc; `None` if it is not a register.
pub(super) fn of_number(number: i32, linuxcnc: bool) -> Option<Variable> {
    let own = |first: i32| {
        let (set, axis) = ((number - first) / 20, ((number - first) % 20) as usize);
        (axis < 3).then_some((set, axis))
    };
    match number {
        5211..=5213 if linuxcnc => Some(Variable::Shift((number - 5211) as usize)),
        5221..=5390 if linuxcnc && (number - 5221) % 20 == 9 => {
            Some(Variable::Offset((number - 5221) / 20 + 1, 3))
        }
        5221..=5390 if linuxcnc => own(5221).map(|(set, axis)| Variable::Offset(set + 1, axis)),
        5401..=5410 if linuxcnc => Some(Variable::Tool(TABLE, format!("#{number}"))),
        _ if linuxcnc => None,
        5201..=5203 => Some(Variable::External((number - 5201) as usize)),
        5221..=5340 => own(5221).map(|(set, axis)| Variable::Offset(set + 1, axis)),
        7001..=7960 => own(7001).map(|(set, axis)| Variable::Offset(6 + 1000 * (set + 1), axis)),
        70_001..=75_999 => {
            own(70_001).map(|(set, axis)| Variable::Offset(6 + 1000 * (set + 1), axis))
        }
        14_001..=19_999 => {
            own(14_001).map(|(set, axis)| Variable::Offset(6 + 1000 * (set + 1), axis))
        }
        2001..=2200 => Some(Variable::Tool(LENGTH, format!("#{number}"))),
        2401..=2600 => Some(Variable::Tool(RADIUS, format!("#{number}"))),
        2201..=2400 | 2601..=2800 => Some(Variable::Tool(WEAR, format!("#{number}"))),
        10_001..=13_999 => Some(Variable::Tool(TABLE, format!("#{number}"))),
        _ => None,
    }
}

/// Register of a SINUMERIK variable: `$P_UIFR[1,X,TR]`.
pub(super) fn of_name(name: &str) -> Option<Variable> {
    if name.starts_with("$P_PFRAME") || name.starts_with("$P_IFRAME") {
        return Some(Variable::ProgramFrame);
    }
    if let Some(index) = name.strip_prefix("$P_UIFR[") {
        let parts: Vec<&str> = index.trim_end_matches(']').split(',').collect();
        let part = |number: &str, axis: &str| {
            let axis = AXES[..3].iter().position(|known| *known == axis)?;
            Some(Variable::Offset(number.parse().ok()?, axis))
        };
        let own = match parts.as_slice() {
            [number, axis, "TR"] => part(number, axis),
            _ => None,
        };
        return Some(own.unwrap_or(Variable::AnyOffset(name.to_owned())));
    }
    let frames = ["$P_UIFR", "$P_BFRAME", "$P_CHBFR", "$P_NCBFR", "$P_SETFR"];
    if frames.iter().any(|frame| name.starts_with(frame)) {
        return Some(Variable::AnyOffset(name.to_owned()));
    }
    let parameter = name.strip_prefix("$TC_DP")?;
    let digits = &parameter[..parameter.bytes().take_while(u8::is_ascii_digit).count()];
    let kind = match digits.parse::<u32>().ok()? {
        3..=5 => LENGTH,
        6 => RADIUS,
        12..=15 => WEAR,
        _ => TABLE,
    };
    Some(Variable::Tool(kind, name.to_owned()))
}
