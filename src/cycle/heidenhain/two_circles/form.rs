//! Forms of 1411, of the touch probe table's row and of 1493, with the meanings of their codes.

use crate::form::{BestView, Code, Field, SubForm, form};
use crate::geom::Vec3;
use crate::tolerance::Nominal;

const GEOMETRY: &[Code] = &[
    Code {
        value: 0,
        label: "hole and hole",
    },
    Code {
        value: 1,
        label: "stud and stud",
    },
    Code {
        value: 2,
        label: "hole and stud",
    },
    Code {
        value: 3,
        label: "stud and hole",
    },
];
const HEIGHT_MODE: &[Code] = &[
    Code {
        value: -1,
        label: "never to the clearance height",
    },
    Code {
        value: 0,
        label: "before and after the cycle",
    },
    Code {
        value: 1,
        label: "before and after each object",
    },
    Code {
        value: 2,
        label: "before and after each touch",
    },
];
const REACTION: &[Code] = &[
    Code {
        value: 0,
        label: "never stop",
    },
    Code {
        value: 1,
        label: "stop and show when out of tolerance",
    },
    Code {
        value: 2,
        label: "stop and show only for scrap",
    },
];
const ALIGN: &[Code] = &[
    Code {
        value: 0,
        label: "no",
    },
    Code {
        value: 1,
        label: "yes, the tip follows (MOVE)",
    },
    Code {
        value: 2,
        label: "yes, the tip stays (TURN)",
    },
];
const TRANSFER: &[Code] = &[
    Code {
        value: 0,
        label: "no correction",
    },
    Code {
        value: 1,
        label: "by circle 1",
    },
    Code {
        value: 2,
        label: "by circle 2",
    },
    Code {
        value: 3,
        label: "by the mean of both",
    },
];
const CONFIRM: &[Code] = &[
    Code {
        value: 0,
        label: "no basic rotation",
    },
    Code {
        value: 1,
        label: "set as basic rotation",
    },
    Code {
        value: 2,
        label: "set as offset of the rotary table",
    },
];
const DIRECTION: &[Code] = &[
    Code {
        value: 1,
        label: "main axis",
    },
    Code {
        value: 2,
        label: "minor axis",
    },
    Code {
        value: 3,
        label: "tool axis",
    },
];
const MODAL: &[Code] = &[
    Code {
        value: 0,
        label: "for the next cycle",
    },
    Code {
        value: 1,
        label: "to the end of the program",
    },
];

pub(super) const PROBE: SubForm = SubForm {
    key: "probe",
    fields: Probe::FIELDS,
    optional: false,
};
pub(super) const EXTRUSION: SubForm = SubForm {
    key: "extrusion",
    fields: Extrusion::FIELDS,
    optional: true,
};

form! {
    /// Form of 1411, in the order of its block.
    pub struct Form {
        /// 1st noml. position of ref. axis? … of minor axis? … in tool axis? A number, or text with a tolerance, ? or @.
        point1: [Nominal; 3] = Field::nominal_point("point1", "1st point", [-30.0, 0.0, -10.0]).code("Q1100").group("Circle 1"),
        /// Diameter of 1st position? A number, or text with a tolerance.
        diameter1: Nominal = Field::nominal("diameter1", "Diameter 1", 20.0).range(0.0, 9999.9999).code("Q1116").group("Circle 1").size(),
        /// 2nd noml. position of ref. axis? … of minor axis? … in tool axis? As for the first point.
        point2: [Nominal; 3] = Field::nominal_point("point2", "2nd point", [30.0, 0.0, -10.0]).code("Q1103").group("Circle 2"),
        /// Diameter of 2nd position? A number, or text with a tolerance.
        diameter2: Nominal = Field::nominal("diameter2", "Diameter 2", 20.0).range(0.0, 9999.9999).code("Q1117").group("Circle 2").size(),
        /// Geometry type (0-3)? What is at each position.
        geometry_type: i32 = Field::code_of("geometryType", "Geometry type", 0, GEOMETRY).code("Q1115").group("Both circles"),
        /// Number of probe points? On each circle.
        probe_points: i32 = Field::count("probePoints", "No. of probe points", 4, 3, 8).code("Q423").group("Probing"),
        /// Starting angle? From the main axis to the first touch.
        starting_angle: f64 = Field::angle("startingAngle", "Starting angle", 0.0).seen(BestView::Rotation).code("Q325").group("Probing"),
        /// Arc angular length? Over which the touches are spread; negative is clockwise.
        angular_length: f64 = Field::angle("angularLength", "Angular length", 360.0).seen(BestView::Rotation).range(-359.999, 360.0).code("Q1119").group("Probing"),
        /// Set-up clearance? Added to SET_UP and the ball radius.
        set_up_clearance: f64 = Field::length("setUpClearance", "Set-up clearance", 0.0).seen(BestView::Rotation).range(0.0, 99_999.999_9).usual(0.0, 50.0).code("Q320").group("Heights"),
        /// Clearance height? A height free of obstacles.
        clearance_height: f64 = Field::length("clearanceHeight", "Clearance height", 100.0).seen(BestView::Height).range(-99_999.999_9, 99_999.999_9).code("Q260").group("Heights"),
        /// Q320=PREDEF: the control reads the set-up clearance from GLOBAL DEF. The number above then only affects the moves shown.
        set_up_clearance_predef: bool = Field::flag("setUpClearancePredef", "Set-up clearance: PREDEF", false).group("Heights"),
        /// Q260=PREDEF: the control reads the clearance height from GLOBAL DEF. The number above then only affects the moves shown.
        clearance_height_predef: bool = Field::flag("clearanceHeightPredef", "Clearance height: PREDEF", false).group("Heights"),
        /// Traverse to clearance height? When the ball moves there.
        clearance_height_mode: i32 = Field::code_of("clearanceHeightMode", "Clear. height mode", 2, HEIGHT_MODE).code("Q1125").group("Heights"),
        /// Reaction to tolerance error?
        error_reaction: i32 = Field::code_of("errorReaction", "Error reaction", 0, REACTION).code("Q309").group("Both circles"),
        /// Align rotary axis? Only together with confirm rotation.
        align_rotary_axis: i32 = Field::code_of("alignRotaryAxis", "Align rotary axis", 0, ALIGN).code("Q1126").group("After probing"),
        /// Transfer position? Which point corrects the active preset.
        transfer_position: i32 = Field::code_of("transferPosition", "Transfer position", 0, TRANSFER).code("Q1120").group("After probing"),
        /// Confirm rotation? Use of the measured misalignment.
        confirm_rotation: i32 = Field::code_of("confirmRotation", "Confirm rotation", 0, CONFIRM).code("Q1121").group("After probing"),
        /// Stylus position before the cycle.
        start: Vec3 = Field::point("start", "Stylus before the cycle").at([0.0, 0.0, 100.0]).group("Heights"),
    }
}

form! {
    /// Row of the control's touch probe table.
    pub struct Probe {
        /// SET_UP of the touch probe table: added to the set-up clearance.
        set_up: f64 = Field::length("setUp", "SET_UP", 2.0).range(0.0, 1000.0).usual(0.0, 50.0).group("Touch probe table"),
        /// DIST of the touch probe table: the maximum travel of a touch.
        dist: f64 = Field::length("dist", "DIST", 10.0).above(0.0, 1000.0).usual(0.5, 100.0).group("Touch probe table"),
        /// F of the touch probe table: the probing feed.
        feed: f64 = Field::feed("feed", "F", 300.0).usual(5.0, 1000.0).group("Touch probe table"),
        /// FMAX of the touch probe table: the rapid for positioning.
        rapid: Option<f64> = Field::feed("rapid", "FMAX", 2000.0).usual(50.0, 10_000.0).null_by_default().null_means("native").group("Touch probe table"),
    }
}

form! {
    /// Cycle 1493.
    pub struct Extrusion {
        /// Extrusion direction? Along which the touches are repeated.
        direction: i32 = Field::code_of("direction", "Extrusion direction", 3, DIRECTION).code("Q1140").group("Extrusion probing (1493)"),
        /// Number of extrusion points? Touches for each touch of 1411.
        points: i32 = Field::count("points", "Extrusion points", 1, 1, 99).code("Q1145").group("Extrusion probing (1493)"),
        /// Length of extrusion? From the first to the last of them.
        length: f64 = Field::length("length", "Extrusion length", 0.0).range(-99.0, 99.0).code("Q1146").group("Extrusion probing (1493)"),
        /// Extrusion probing: modal?
        modal: i32 = Field::code_of("modal", "Extrusion modal", 0, MODAL).code("Q1149").group("Extrusion probing (1493)"),
    }
}
