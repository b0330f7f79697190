//! The parameter table, built from the codes of the form.

use crate::cycle::CycleDef;
use crate::cycle::ency::Properties;
use crate::form::{Field, Kind, PlainValue, Values};
use crate::path::{Accessor, FeatureKind, Parameter, ParameterValue, ProbeSettings, Touch};
use crate::text::{Text, text};

/// Code of the variant, and the codes that matter only in the angular variant.
const VARIANT: i32 = -59;
const ANGULAR: [i32; 3] = [-60, -61, -62];

/// Groups of codes in a parameter table: title, lowest code and highest code. The first matching group counts.
pub const CODE_GROUPS: [(&str, i32, i32); 6] = [
    ("System", -9, 0),
    ("Dimensions", -99, -50),
    ("Touches", -199, -100),
    ("Original touches", i32::MIN, -200),
    ("Properties and custom codes", -49, -10),
    ("Properties and custom codes", 1, i32::MAX),
];

/// Whether a code may be missing in this variant.
pub fn only_angular(code: i32, variant: f64) -> bool {
    variant == 0.0 && ANGULAR.contains(&code)
}

/// The rows in the order of the source's pages: type and SubCode, dimensions by falling code, touches, original touches, *Compensate dimensions*, then the
/// custom properties that are set. The clearance of a surface comes after its touches.
pub(super) fn table(
    (def, kind_name): (&CycleDef, &'static str),
    values: &[(&'static Field, PlainValue)],
    properties: Option<&Properties>,
    touches: &[Touch],
    setup: &ProbeSettings,
    name: impl Fn(usize) -> Text,
) -> Vec<Parameter> {
    let whole = |code: i32, n: i32, meaning: Text, field: Option<String>| Parameter {
        code,
        accessor: Accessor::Int,
        type_name: "Integer",
        value: ParameterValue::Whole(n),
        meaning,
        field,
        touch: None,
    };
    let kind = def.number.map(|number| {
        let meaning = text!(
            "Probing cycle type: {number} = {name}",
            number,
            kind_name.to_owned()
        );
        whole(-1, number, meaning, Some("cycle.type".to_owned()))
    });
    let mut own: Vec<Parameter> = values
        .iter()
        .filter_map(|(field, value)| row(field, *value, "cycle"))
        .collect();
    // In the rectangular variant the touches follow from the variant alone.
    let rectangular = own
        .iter()
        .any(|p| p.code == VARIANT && p.value == ParameterValue::Whole(0));
    own.retain(|p| !(rectangular && ANGULAR.contains(&p.code)));
    falling(&mut own);
    let late =
        |p: &Parameter| p.code == -66 || (def.probes == FeatureKind::Surface && p.code == -56);
    let (last, first): (Vec<Parameter>, Vec<Parameter>) = own.into_iter().partition(late);
    let compensated = last
        .iter()
        .any(|p| p.code == -66 && p.value == ParameterValue::Whole(1));
    let mut rows: Vec<Parameter> = kind.into_iter().collect();
    if def.probes == FeatureKind::Switch {
        rows.push(whole(-2, -500, text!("SubCode of probe on/off"), None));
    }
    rows.extend(first);
    push_touches(
        &mut rows,
        touches,
        if compensated { setup.radius } else { 0.0 },
        name,
    );
    rows.extend(last);
    if let Some(properties) = properties {
        rows.extend(
            properties
                .values()
                .into_iter()
                .filter_map(|(field, value)| row(field, value, "cycle.properties")),
        );
    }
    rows
}

/// Sorts by falling code; most forms are nearly in this order.
fn falling(rows: &mut [Parameter]) {
    for end in 1..rows.len() {
        let mut at = end;
        while at > 0 && rows[at - 1].code < rows[at].code {
            rows.swap(at - 1, at);
            at -= 1;
        }
    }
}

/// The accessor and the number of a code such as `CmdPrm.Flt[-50]`.
pub fn code_of(field: &Field) -> Option<(Accessor, i32)> {
    let (accessor, rest) = field.code.strip_prefix("CmdPrm.")?.split_once('[')?;
    let accessor = Accessor::CMD_PRM
        .into_iter()
        .find(|a| a.word() == accessor)?;
    Some((accessor, rest.strip_suffix(']')?.parse().ok()?))
}

/// A field as a row; `None` if it has no code or is not set.
fn row(field: &'static Field, value: PlainValue, section: &str) -> Option<Parameter> {
    let (accessor, code) = code_of(field)?;
    let (value, type_name) = match value {
        PlainValue::Number(x) if field.kind == Kind::Angle => (ParameterValue::Number(x), "Double"),
        PlainValue::Number(x) => (ParameterValue::Length(x), "Double"),
        PlainValue::Whole(n) => (ParameterValue::Whole(n), "Integer"),
        PlainValue::Flag(on) if accessor == Accessor::Bol => (ParameterValue::Flag(on), "Boolean"),
        // Flt accessor and type Integer, as in the source's tables.
        PlainValue::Flag(on) => (ParameterValue::Whole(i32::from(on)), "Integer"),
        PlainValue::Nothing => return None,
    };
    let first = field
        .help
        .split_once(". ")
        .map_or(field.help, |(first, _)| first)
        .trim_end_matches('.');
    let meaning = if code == -66 {
        text!("Compensate dimensions: 0 off, 1 on")
    } else {
        text!("{label}, {help}", field.label, crate::num::lowered(first))
    };
    Some(Parameter {
        code,
        accessor,
        type_name,
        value,
        meaning,
        field: Some(format!("{section}.{}", field.key)),
        touch: None,
    })
}

/// The blocks from −100 (used by the cycle) and from −200 (as given in the Job Assignment), six codes for each touch. `shift` moves the used points along their
/// vectors, by the ball radius if dimensions are compensated [I]: the source only says "toolpath shift with tool compensation".
fn push_touches(
    rows: &mut Vec<Parameter>,
    touches: &[Touch],
    shift: f64,
    name: impl Fn(usize) -> Text,
) {
    for (base, used, shift) in [(-100, true, shift), (-200, false, 0.0)] {
        for (k, touch) in touches.iter().enumerate() {
            let point = touch.point + touch.vector * shift;
            let first = base - 6 * k as i32;
            let name = name(k);
            let mut push = |code: i32, value: ParameterValue, meaning: Text| {
                rows.push(Parameter {
                    code,
                    accessor: Accessor::Flt,
                    type_name: "Double",
                    value,
                    meaning,
                    field: None,
                    touch: Some(k),
                });
            };
            for (axis, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
                let meaning = if used {
                    text!("{name}: touch point, {axis}", name.clone(), letter)
                } else {
                    text!("{name}: original touch point, {axis}", name.clone(), letter)
                };
                push(
                    first - axis as i32,
                    ParameterValue::Length(point[axis]),
                    meaning,
                );
            }
            for (axis, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
                let meaning = if used {
                    text!("{name}: target vector, {axis}", name.clone(), letter)
                } else {
                    text!(
                        "{name}: original target vector, {axis}",
                        name.clone(),
                        letter
                    )
                };
                push(
                    first - 3 - axis as i32,
                    ParameterValue::Number(touch.vector[axis]),
                    meaning,
                );
            }
        }
    }
}
