//! SINUMERIK's LENTOAX: which tool length acts on which axis.
//!
//! Source: the function manual W1, section 2.11 (its two printed examples are tests here). The formula is derived and reproduces them: MATRIX = P · Fᵀ · T, see
//! `docs/lentoax.md`. Angles are in degrees; ROT Z with a positive angle is counter-clockwise seen from +Z; successive frames multiply on the right.

use glam::DMat3;

pub use crate::geom::{Plane, Vec3};
use crate::text::{Text, text, words};

/// Tolerance for a matrix element of 0 or ±1 in a parallel matrix.
const PARALLEL: f64 = 1e-9;
/// Rounding error of a 0 or ±1 in a matrix that is not parallel as a whole.
const ROUNDING: f64 = 1e-12;

/// A 3 × 3 matrix, row by row.
pub type Rows = [[f64; 3]; 3];

/// An axis of the machine; as a number its index in a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Index 0.
    X,
    /// Index 1.
    Y,
    /// Index 2.
    Z,
}

impl Axis {
    /// All three, in their order.
    pub const ALL: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];
}

/// One step of the active frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A rotation about an axis.
    Rotation {
        /// Axis of the rotation, in the frame of the previous steps.
        axis: Axis,
        /// Degrees, right-handed: about Z positive is counter-clockwise seen from +Z.
        angle: f64,
    },
    /// A mirror: the axis is reversed.
    Mirror {
        /// Mirrored axis, in the frame of the previous steps.
        axis: Axis,
    },
}

/// Input of LENTOAX: its argument, and the state of the control.
#[derive(Clone, Debug, PartialEq)]
pub struct Query {
    /// The active working plane.
    pub plane: Plane,
    /// Number of the tool type; 400 to 599 are turning and grinding tools.
    pub tool_type: i32,
    /// Steps of the active frame in order; each acts in the frame of the previous ones.
    pub frame: Vec<Step>,
    /// The _COORD string (`WCS`, `B`, …) in any case: the system of the axes.
    pub coord: String,
    /// Whether a tool is active; otherwise the status is −2.
    pub tool_active: bool,
    /// SD42900 $SC_MIRROR_TOOL_LENGTH: whether a mirror in the frame also reverses the tool lengths.
    pub sd42900: bool,
    /// SD42940 $SC_TOOL_LENGTH_CONST: 0 uses the active plane, ±17 to ±19 always that plane.
    pub sd42940: i32,
    /// SD42950 $SC_TOOL_LENGTH_TYPE: 0 by tool type, 1 as milling, 2 as turning.
    pub sd42950: i32,
}

/// Result of LENTOAX.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// 0: _AXIND is complete. 1: read _MATRIX. −1: the coordinate system is unknown. −2: no tool is active.
    pub status: i32,
    /// Number of the length that acts on abscissa, ordinate and applicate, negative if it points in the opposite direction.
    pub axind: [i32; 3],
    /// Rows abscissa, ordinate, applicate; columns L1, L2, L3.
    pub matrix: Rows,
}

/// Answers a query. Every query has an answer.
pub fn lentoax(query: &Query) -> Answer {
    let nothing = |status| Answer {
        status,
        axind: [0; 3],
        matrix: [[0.0; 3]; 3],
    };
    let in_workpiece = match query.coord.to_ascii_uppercase().as_str() {
        "WCS" | "W" => true,
        // Without a kinematic transformation these ignore the frame.
        "BCS" | "B" | "MCS" | "M" | "KCS" | "K" | "TCS" | "T" => false,
        _ => return nothing(-1),
    };
    if !query.tool_active {
        return nothing(-2);
    }
    let (frame, mirror) = frame(&query.frame);
    let mut lengths = assignment(query);
    if query.sd42900 {
        lengths = DMat3::from_diagonal(mirror) * lengths;
    }
    let seen = if in_workpiece {
        frame.transpose() * lengths
    } else {
        lengths
    };
    read(query.plane.axes().map(|axis| seen.row(axis).to_array()))
}

/// _AXIND and the status from the matrix. A parallel matrix is rounded to 0 and ±1; any other one only loses rounding errors, since one of its cosines can be
/// almost 1 while the sine beside it is not 0 yet.
fn read(mut matrix: Rows) -> Answer {
    let parallel = matrix
        .iter()
        .flatten()
        .all(|x| (x - x.round()).abs() <= PARALLEL);
    let off = if parallel { PARALLEL } else { ROUNDING };
    for element in matrix.iter_mut().flatten() {
        let whole = element.round();
        if (*element - whole).abs() <= off {
            // Adding 0 turns −0 into 0.
            *element = whole + 0.0;
        }
    }
    let axind = matrix.map(|row| {
        let most = row.iter().fold(0f64, |most, x| most.max(x.abs()));
        // Of equal ones the lower length.
        let j = row
            .iter()
            .position(|x| x.abs() >= most - PARALLEL)
            .unwrap_or(0);
        let number = j as i32 + 1;
        if row[j] < 0.0 { -number } else { number }
    });
    Answer {
        status: i32::from(!parallel),
        axind,
        matrix,
    }
}

/// Rotation and mirror part of the active frame, BCS = F · WCS, and the sign of each axis by its mirrors only.
pub fn frame(steps: &[Step]) -> (DMat3, Vec3) {
    let (mut all, mut mirror) = (DMat3::IDENTITY, Vec3::ONE);
    for step in steps {
        all *= match *step {
            Step::Rotation { axis, angle } => rotation(axis, angle),
            Step::Mirror { axis } => {
                mirror[axis as usize] *= -1.0;
                let mut own = Vec3::ONE;
                own[axis as usize] = -1.0;
                DMat3::from_diagonal(own)
            }
        };
    }
    (all, mirror)
}

fn rotation(axis: Axis, degrees: f64) -> DMat3 {
    let axis = axis as usize;
    let angle = degrees.rem_euclid(360.0);
    // Quarter turns are exact.
    let (sin, cos) = match angle {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => angle.to_radians().sin_cos(),
    };
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut own = DMat3::ZERO;
    own.col_mut(axis)[axis] = 1.0;
    (own.col_mut(a)[a], own.col_mut(a)[b]) = (cos, sin);
    (own.col_mut(b)[a], own.col_mut(b)[b]) = (-sin, cos);
    own
}

/// T: rows X, Y, Z, columns L1, L2, L3; 1 if a length acts.
fn assignment(query: &Query) -> DMat3 {
    let turning = match query.sd42950 {
        1 => false,
        2 => true,
        _ => (400..=599).contains(&query.tool_type),
    };
    let plane = match query.plane {
        Plane::G17 => 17,
        Plane::G18 => 18,
        Plane::G19 => 19,
    };
    let row = match (query.sd42940, turning) {
        (0, _) => plane,
        (row @ (17..=19 | -19..=-17), _) => row,
        // Any other number acts as 17 for milling tools and as 18 for turning tools.
        (_, false) => 17,
        (_, true) => 18,
    };
    const X: usize = 0;
    const Y: usize = 1;
    const Z: usize = 2;
    let axes = match (row, turning) {
        (17, false) => [Z, Y, X],
        (18, false) => [Y, X, Z],
        (19, false) => [X, Z, Y],
        (-17, false) => [Z, X, Y],
        (-18, false) => [Y, Z, X],
        (_, false) => [X, Y, Z],
        (17, true) => [Y, X, Z],
        (18, true) => [X, Z, Y],
        (19, true) => [Z, Y, X],
        (-17, true) => [X, Y, Z],
        (-18, true) => [Z, X, Y],
        (_, true) => [Y, Z, X],
    };
    DMat3::from_cols_array_2d(&axes.map(|axis| Vec3::AXES[axis].to_array()))
}

/// A status in plain words.
pub fn meaning(status: i32) -> &'static str {
    match status {
        0 => words!("every length is parallel to an axis: _AXIND is the full answer"),
        1 => words!(
            "not every length is parallel to an axis: _MATRIX must be read, _AXIND names the dominant lengths"
        ),
        -1 => words!("the coordinate system is unknown"),
        _ => words!("no tool is active"),
    }
}

/// The answer in a sentence, with the axis names of the plane: "L1 acts along +Z, …".
pub fn sentence(plane: Plane, answer: &Answer) -> Text {
    if answer.status < 0 {
        return Text::words(meaning(answer.status));
    }
    let names = plane.axes().map(|axis| crate::geom::AXIS_NAMES[axis]);
    let [first, second, third] = [0, 1, 2].map(|length| {
        let parts: Vec<String> = (0..3)
            .filter(|&row| answer.matrix[row][length].abs() > PARALLEL)
            .map(|row| {
                let part = answer.matrix[row][length];
                let sign = if part < 0.0 { '-' } else { '+' };
                if answer.status == 0 {
                    format!("{sign}{}", names[row])
                } else {
                    format!(
                        "{sign}{}·{}",
                        crate::num::decimal(part.abs(), 4),
                        names[row]
                    )
                }
            })
            .collect();
        text!("L{length} acts along {axes}", length + 1, parts.join(" "))
    });
    text!("{first}, {second}, {third}", first, second, third)
}

/// NC lines that ask the control itself and stop if its answer differs from that of [`lentoax`]. DEF, the call and MSG follow the manual's notation; the
/// comparison is ours and not verified on a control \[I\].
pub fn nc_block(query: &Query) -> String {
    let known = ["MCS", "M", "BCS", "B", "WCS", "W", "KCS", "K", "TCS", "T"];
    let upper = query.coord.to_ascii_uppercase();
    // Nothing of a user's text reaches the lines.
    let coord = known.iter().find(|k| **k == upper).copied().unwrap_or("?");
    let mut text = format!(
        "DEF INT _STAT\nDEF INT _AXIND[3]\nDEF REAL _MATRIX[3,3]\n_STAT=LENTOAX(_AXIND,_MATRIX,\"{coord}\")\n"
    );
    for differs in differences(&lentoax(query)) {
        text.push_str(&format!(
            "IF {differs}\n  MSG(\"LENTOAX differs from what was expected\")\n  SETAL(65000)\n  M0\nENDIF\n"
        ));
    }
    text
}

/// Conditions, one of which holds if a control gives another answer: the status, then the values to read.
fn differences(answer: &Answer) -> Vec<String> {
    let status = format!("_STAT<>{}", answer.status);
    match answer.status {
        0 => {
            let axes = answer
                .axind
                .iter()
                .enumerate()
                .map(|(i, number)| format!("(_AXIND[{i}]<>{number})"));
            let all: Vec<String> = std::iter::once(format!("({status})")).chain(axes).collect();
            vec![all.join(" OR ")]
        }
        1 => {
            // To less than a thousandth of a length; a control shows seven decimals.
            let off = |i: usize, j: usize| {
                format!(
                    "(ABS(_MATRIX[{i},{j}]-({}))>0.0001)",
                    crate::num::decimal(answer.matrix[i][j], 7)
                )
            };
            let row = |i: usize| {
                (0..3)
                    .map(|j| off(i, j))
                    .collect::<Vec<String>>()
                    .join(" OR ")
            };
            std::iter::once(status).chain((0..3).map(row)).collect()
        }
        _ => vec![status],
    }
}
