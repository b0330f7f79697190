//! What the cycles of the ENCY / SprutCAM family share: how a parameter table is written, and the ball's first rules.

use crate::geom::AXIS_NAMES;
use crate::path::{MAX_TOUCHES, Parameter, ParameterValue, Setup, Touch};
use crate::spec::Checker;

/// Builds the parameter table in the order of the source's page.
#[derive(Default)]
pub struct Table {
    rows: Vec<Parameter>,
}

impl Table {
    /// A whole number, `Int[code]`.
    pub fn int(&mut self, code: i32, value: i32, meaning: &str, field: Option<&'static str>) {
        self.push(code, "Int", "Integer", ParameterValue::Whole(value), meaning.to_owned(), field, None);
    }

    /// A length, `Flt[code]`.
    pub fn length(&mut self, code: i32, value: f64, meaning: &str, field: &'static str) {
        self.push(code, "Flt", "Double", ParameterValue::Length(value), meaning.to_owned(), Some(field), None);
    }

    /// Code −66: written with the Flt accessor and the type Integer, as the source's tables do.
    pub fn compensate(&mut self, on: bool) {
        let value = ParameterValue::Whole(i32::from(on));
        let meaning = "Compensate dimensions: 0 off, 1 on".to_owned();
        self.push(-66, "Flt", "Integer", value, meaning, Some("cycle.compensateDimensions"), None);
    }

    /// The blocks from −100 (used by the cycle) and from −200 (as given in the Job Assignment), six codes a touch.
    /// `shift` moves the used points along their vectors: the ball radius where dimensions are compensated. Our reading:
    /// the source only says "toolpath shift with tool compensation".
    pub fn touches(&mut self, touches: &[Touch], shift: f64, name: impl Fn(usize) -> String) {
        for (base, word, shift) in [(-100, "touch", shift), (-200, "original touch", 0.0)] {
            for (k, touch) in touches.iter().enumerate() {
                let point = touch.point + touch.vector * shift;
                let first = base - 6 * k as i32;
                let name = name(k);
                for (axis, axis_name) in AXIS_NAMES.iter().enumerate() {
                    let meaning = format!("{name}: {word} point, {axis_name}");
                    let value = ParameterValue::Length(point[axis]);
                    self.push(first - axis as i32, "Flt", "Double", value, meaning, None, Some(k));
                }
                for (axis, axis_name) in AXIS_NAMES.iter().enumerate() {
                    let meaning = format!("{name}: {} vector, {axis_name}", word.replace("touch", "target"));
                    let value = ParameterValue::Number(touch.vector[axis]);
                    self.push(first - 3 - axis as i32, "Flt", "Double", value, meaning, None, Some(k));
                }
            }
        }
    }

    /// The rows.
    pub fn rows(self) -> Vec<Parameter> {
        self.rows
    }

    #[expect(clippy::too_many_arguments, reason = "one row, written once; the public ways in are short")]
    fn push(
        &mut self,
        code: i32,
        accessor: &'static str,
        type_name: &'static str,
        value: ParameterValue,
        meaning: String,
        field: Option<&'static str>,
        touch: Option<usize>,
    ) {
        self.rows.push(Parameter { code, accessor, type_name, value, meaning, field, touch });
    }
}

/// A clearance must be larger than the ball radius, or the ball touches before it sets out. Lengths are from the surface
/// to the ball centre.
pub fn clearance_rule(checker: &mut Checker, setup: &Setup, label: &str, clearance: f64, path: &str) {
    if checker.sound(&[path, "stylus.diameter"]) && clearance <= setup.radius {
        let message = format!(
            "{label} ({}) must be larger than the ball radius ({}): it is measured from the wall to the ball centre, and the \
             ball would touch before the touch begins",
            checker.length(clearance),
            checker.length(setup.radius)
        );
        checker.error("clearance-too-small", path, message);
    }
}

/// No more touches than the parameter table can hold.
pub fn touch_count_rule(checker: &mut Checker, count: usize, path: &str) {
    if count > MAX_TOUCHES {
        let message = format!(
            "{count} touches are more than the {MAX_TOUCHES} that the parameter table holds: touch {} would start at code {} \
             and run into the -200 block of original points",
            MAX_TOUCHES + 1,
            -100 - 6 * MAX_TOUCHES as i32
        );
        checker.error("too-many-touches", path, message);
    }
}
