//! The Q parameters of the call, with the control's dialog texts.

use crate::cycle::heidenhain::two_circles::TwoCircles;
use crate::path::{Accessor, Parameter, ParameterValue, Setting};
use crate::text::text;
use crate::tolerance::Nominal;

impl TwoCircles {
    /// Settings with their fields: of 1493, if it is used, and of 1411, in the order of their blocks.
    pub(super) fn settings(&self) -> [Vec<(Setting, &'static str)>; 2] {
        let form = &self.form;
        let setting = |number: i32, dialog: &str, value: ParameterValue, field: &'static str| {
            (
                Setting {
                    number,
                    dialog: dialog.to_owned(),
                    value,
                },
                field,
            )
        };
        let nominal = |v: &Nominal| match &v.text {
            Some(text) => ParameterValue::Text(text.clone()),
            None => ParameterValue::Length(v.nominal.unwrap_or(0.0)),
        };
        let code = |n: i32| ParameterValue::Whole(n);
        let extrusion = self.extrusion.iter().flat_map(|extrusion| {
            [
                setting(
                    1140,
                    "EXTRUSION DIRECTION",
                    code(extrusion.direction),
                    "cycle.extrusion.direction",
                ),
                setting(
                    1145,
                    "EXTRUSION POINTS",
                    code(extrusion.points),
                    "cycle.extrusion.points",
                ),
                setting(
                    1146,
                    "EXTRUSION LENGTH",
                    ParameterValue::Length(extrusion.length),
                    "cycle.extrusion.length",
                ),
                setting(
                    1149,
                    "EXTRUSION MODAL",
                    code(extrusion.modal),
                    "cycle.extrusion.modal",
                ),
            ]
        });
        let global = |predefined: bool, mm: f64| match predefined {
            true => ParameterValue::Word("PREDEF"),
            false => ParameterValue::Length(mm),
        };
        let set_up = global(form.set_up_clearance_predef, form.set_up_clearance);
        let height = global(form.clearance_height_predef, form.clearance_height);
        let angle = ParameterValue::Number;
        let [a1, o1, w1] = form.point1.each_ref().map(nominal);
        let [a2, o2, w2] = form.point2.each_ref().map(nominal);
        let cycle = vec![
            setting(1100, "1ST POINT REF AXIS", a1, "cycle.point1[0]"),
            setting(1101, "1ST POINT MINOR AXIS", o1, "cycle.point1[1]"),
            setting(1102, "1ST POINT TOOL AXIS", w1, "cycle.point1[2]"),
            setting(
                1116,
                "DIAMETER 1",
                nominal(&form.diameter1),
                "cycle.diameter1",
            ),
            setting(1103, "2ND POINT REF AXIS", a2, "cycle.point2[0]"),
            setting(1104, "2ND POINT MINOR AXIS", o2, "cycle.point2[1]"),
            setting(1105, "2ND POINT TOOL AXIS", w2, "cycle.point2[2]"),
            setting(
                1117,
                "DIAMETER 2",
                nominal(&form.diameter2),
                "cycle.diameter2",
            ),
            setting(
                1115,
                "GEOMETRY TYPE",
                code(form.geometry_type),
                "cycle.geometryType",
            ),
            setting(
                423,
                "NO. OF PROBE POINTS",
                code(form.probe_points),
                "cycle.probePoints",
            ),
            setting(
                325,
                "STARTING ANGLE",
                angle(form.starting_angle),
                "cycle.startingAngle",
            ),
            setting(
                1119,
                "ANGULAR LENGTH",
                angle(form.angular_length),
                "cycle.angularLength",
            ),
            setting(320, "SET-UP CLEARANCE", set_up, "cycle.setUpClearance"),
            setting(260, "CLEARANCE HEIGHT", height, "cycle.clearanceHeight"),
            setting(
                1125,
                "CLEAR. HEIGHT MODE",
                code(form.clearance_height_mode),
                "cycle.clearanceHeightMode",
            ),
            setting(
                309,
                "ERROR REACTION",
                code(form.error_reaction),
                "cycle.errorReaction",
            ),
            setting(
                1126,
                "ALIGN ROTARY AXIS",
                code(form.align_rotary_axis),
                "cycle.alignRotaryAxis",
            ),
            // Spelled as on the control.
            setting(
                1120,
                "TRANSER POSITION",
                code(form.transfer_position),
                "cycle.transferPosition",
            ),
            setting(
                1121,
                "CONFIRM ROTATION",
                code(form.confirm_rotation),
                "cycle.confirmRotation",
            ),
        ];
        [extrusion.collect(), cycle]
    }
}

/// Settings as rows of the table. The code is the number of the parameter; a program writes it as QS if the value is a text.
pub(super) fn rows(settings: [Vec<(Setting, &'static str)>; 2]) -> Vec<Parameter> {
    let row = |(setting, field): (Setting, &'static str)| Parameter {
        code: setting.number,
        accessor: Accessor::Q,
        type_name: "",
        meaning: match setting.value {
            ParameterValue::Text(_) => text!(
                "{dialog} (in Klartext QS{number})",
                setting.dialog,
                setting.number
            ),
            _ => text!("{dialog}", setting.dialog),
        },
        value: setting.value,
        field: Some(field.to_owned()),
        touch: None,
    };
    settings.into_iter().flatten().map(row).collect()
}
