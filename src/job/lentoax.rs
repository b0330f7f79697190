//! Reads a LENTOAX query with the checks of a job: every problem is reported together.

use crate::form::{Checker, Choice, Code, Field, Section, Value, form, printable};
use crate::geom::{AXIS_NAMES, Plane};
use crate::job::JobError;
use crate::text::{text, words};
use crate::tool_length::{Axis, Query, Step};

/// Largest number of frame steps in a query.
pub const MOST_STEPS: usize = 50;
/// Angle of a step, as a field.
pub const STEP_ANGLE: Field = Field::angle("angle", "Angle", 0.0).range(-360_000.0, 360_000.0);

const PLANES: &[Choice] = &[
    Choice {
        value: "G17",
        label: "G17",
    },
    Choice {
        value: "G18",
        label: "G18",
    },
    Choice {
        value: "G19",
        label: "G19",
    },
];
pub const LENGTH_TYPE: &[Code] = &[
    Code {
        value: 0,
        label: "by tool type",
    },
    Code {
        value: 1,
        label: "as for milling",
    },
    Code {
        value: 2,
        label: "as for turning",
    },
];

form! {
    /// A query without its frame.
    pub struct QueryForm {
        /// The active plane.
        plane: String = Field::choice("plane", "Plane", PLANES),
        /// The tool type's number: 400 to 599 are turning and grinding tools, 710 is a probe.
        tool_type: i32 = Field::count("toolType", "Tool type", 710, 0, 9999),
        /// The _COORD string: WCS, BCS, MCS, KCS, TCS or their first letter.
        coord: String = Field::text("coord", "Coordinate system", "WCS", 100),
        /// Whether a tool is active.
        tool_active: bool = Field::flag("toolActive", "Tool active", true),
        /// SD42900 $SC_MIRROR_TOOL_LENGTH: mirroring changes the sign of the length.
        sd42900: bool = Field::flag("sd42900", "SD42900 MIRROR_TOOL_LENGTH", false),
        /// SD42940 $SC_TOOL_LENGTH_CONST: assignment as for this plane in every plane; 0 is the active plane.
        sd42940: i32 = Field::count("sd42940", "SD42940 TOOL_LENGTH_CONST", 0, -32_768, 32_767),
        /// SD42950 $SC_TOOL_LENGTH_TYPE: which table is used.
        sd42950: i32 = Field::code_of("sd42950", "SD42950 TOOL_LENGTH_TYPE", 0, LENGTH_TYPE),
    }
}

/// The query in a loose value; an absent value is the standard case.
pub fn lentoax_query(value: &Value) -> Result<Query, JobError> {
    let mut checker = Checker::default();
    checker.whole = words!("the query");
    let given = if matches!(value, Value::Null | Value::Other("undefined")) {
        None
    } else {
        Some(value)
    };
    let mut section = Section::new(&mut checker, given, "");
    section.only(QueryForm::FIELDS, &["frame"]);
    let form = QueryForm::read(&mut section);
    let frame = read_frame(&mut section);
    if checker.failed() {
        return Err(JobError {
            findings: checker.findings(),
        });
    }
    Ok(Query {
        plane: Plane::named(&form.plane),
        tool_type: form.tool_type,
        frame,
        coord: form.coord,
        tool_active: form.tool_active,
        sd42900: form.sd42900,
        sd42940: form.sd42940,
        sd42950: form.sd42950,
    })
}

/// The frame under the key `frame`: a list of `{ rot, angle }` and `{ mirror }`.
pub fn read_frame(section: &mut Section<'_, '_>) -> Vec<Step> {
    let place = section.at("frame");
    let steps = match section.get("frame") {
        None => return Vec::new(),
        Some(Value::List(steps)) if steps.len() <= MOST_STEPS => steps,
        Some(_) => {
            let message = text!(
                "The frame must be a list of at most {most} steps { rot, angle } or { mirror }",
                MOST_STEPS
            );
            section.checker.error("wrong-type", place, message);
            return Vec::new();
        }
    };
    steps
        .iter()
        .enumerate()
        .filter_map(|(i, step)| read_step(section, step, &format!("{place}[{i}]")))
        .collect()
}

fn read_step(section: &mut Section<'_, '_>, step: &Value, path: &str) -> Option<Step> {
    let axis = |key: &str| match step.get(key) {
        Some(Value::Text(name)) => Axis::ALL
            .into_iter()
            .find(|axis| AXIS_NAMES[*axis as usize] == name),
        _ => None,
    };
    let Value::Map(entries) = step else {
        section.checker.error(
            "wrong-type",
            path,
            text!("A frame step is { rot, angle } or { mirror }"),
        );
        return None;
    };
    let mut known = true;
    for (key, _) in entries
        .iter()
        .filter(|(key, _)| !matches!(key.as_str(), "rot" | "angle" | "mirror"))
    {
        let key = printable(key);
        let message = text!(
            "A frame step has rot and angle, or mirror, and no \"{key}\"",
            key.clone()
        );
        section
            .checker
            .error("unknown-key", format!("{path}.{key}"), message);
        known = false;
    }
    if !known {
        return None;
    }
    match (axis("rot"), axis("mirror"), entries.len()) {
        (Some(axis), None, 2) => {
            let angle = step.get("angle").unwrap_or(&Value::Null);
            let angle = section.number(angle, &STEP_ANGLE, &format!("{path}.angle"))?;
            Some(Step::Rotation { axis, angle })
        }
        (None, Some(axis), 1) => Some(Step::Mirror { axis }),
        _ => {
            section.checker.error(
                "wrong-type",
                path,
                text!("A frame step is { rot, angle } or { mirror }; axes are X, Y, Z"),
            );
            None
        }
    }
}
