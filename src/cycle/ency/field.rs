//! Fields that several cycles of the family share.

use crate::form::{BestView, Code, Field, form};
use crate::text::words;

/// Smallest size, step or clearance, mm: a smaller one would disappear in the last decimals of a program.
const SMALLEST: f64 = 0.001;

/// Position of a feature.
pub const fn origin(label: &'static str) -> Field {
    Field::point("origin", label)
        .group("Position")
        .seen(BestView::Position)
}

/// Position of a feature with a top side.
pub const fn top_centre() -> Field {
    origin("Centre on the top side").help("Centre of the feature, on its top side.")
}

/// Rotation of a feature.
pub const fn rotation() -> Field {
    Field::angle("rotation", "Rotation", 0.0)
        .help("How the feature is turned about the tool axis; counter-clockwise positive.")
        .group("Position")
        .seen(BestView::Rotation)
}

/// A width between two touch points.
pub const fn width(
    key: &'static str,
    label: &'static str,
    default: f64,
    code: &'static str,
) -> Field {
    Field::length(key, label, default)
        .range(SMALLEST, 10_000.0)
        .usual(5.0, 2000.0)
        .code(code)
        .group("Size")
        .size()
}

pub const fn diameter() -> Field {
    Field::length("diameter", "Diameter", 40.0)
        .help("Diameter of the feature.")
        .range(SMALLEST, 10_000.0)
        .usual(5.0, 1000.0)
        .code("CmdPrm.Flt[-52]")
        .group("Size")
        .size()
}

/// Distance from the top side down to the touches.
pub const fn depth() -> Field {
    Field::length("depth", "Depth", 10.0)
        .help("From the top side down to the ball centre at the touches.")
        .range(SMALLEST, 1000.0)
        .usual(0.5, 200.0)
        .code("CmdPrm.Flt[-51]")
        .group("Size")
        .seen(BestView::Height)
}

/// Height above the top side at which the ball crosses.
pub const fn top_clearance() -> Field {
    Field::length("topClearance", "Top clearance", 10.0)
        .help("How far above the top side the ball centre crosses from touch to touch.")
        .range(SMALLEST, 1000.0)
        .usual(1.0, 200.0)
        .code("CmdPrm.Flt[-55]")
        .group("Clearances")
        .seen(BestView::Height)
}

/// Height above the top side from which the ball enters, if it enters from above.
pub const fn entry_clearance() -> Field {
    Field::length("topClearance", "Top clearance", 10.0)
        .help("Height of the ball centre above the top side before it descends. Unchecked: it moves straight to the depth.")
        .range(SMALLEST, 1000.0)
        .usual(1.0, 200.0)
        .null_means("not checked")
        .code("CmdPrm.Flt[-55]")
        .group("Clearances")
        .seen(BestView::Height)
}

/// A clearance from a wall to the ball centre where a touch begins.
pub const fn clearance(
    key: &'static str,
    label: &'static str,
    default: f64,
    code: &'static str,
) -> Field {
    Field::length(key, label, default)
        .range(SMALLEST, 1000.0)
        .usual(1.0, 200.0)
        .code(code)
        .group("Clearances")
}

/// Height above the start at which a cycle begins and ends.
pub const fn feed_distance() -> Field {
    Field::length("feedDistance", "Feed distance", 20.0)
        .help("How far above the start the cycle begins, and how far it is lifted at its end.")
        .range(0.0, 1000.0)
        .usual(1.0, 500.0)
        .code("CmdPrm.Flt[-50]")
        .group("Clearances")
        .seen(BestView::Height)
}

/// Whether the points of the table are ball centres.
pub const fn compensate() -> Field {
    Field::flag("compensateDimensions", "Compensate dimensions", false)
        .help("On: the points of the parameter table are ball-centre positions. Off: points on the surface. The moves are the same.")
        .code("CmdPrm.Flt[-66]")
        .group("Postprocessor")
}

/// A free number for the postprocessor.
pub const fn sub_code() -> Field {
    Field::count("subCode", "SubCode", 0, -1_000_000, 1_000_000)
        .help("A free number for the postprocessor. -500 is that of Probe On/Off.")
        .code("CmdPrm.Int[-2]")
        .group("Postprocessor")
}

/// Number of touches on a wall. Both walls share the 16 touches of the table.
pub const fn count(
    key: &'static str,
    label: &'static str,
    default: i32,
    code: &'static str,
) -> Field {
    Field::count(key, label, default, 1, 15)
        .because(words!(
            "the parameter table holds 16 touch points (the 17th would run into the -200 block), and the other wall needs one"
        ))
        .code(code)
        .group("Touches")
}

/// A distance between touches, or from a corner to one.
pub const fn distance(key: &'static str, label: &'static str, default: f64) -> Field {
    Field::length(key, label, default)
        .range(SMALLEST, 1000.0)
        .usual(2.0, 500.0)
        .group("Touches")
}

/// The angle between two walls.
pub const fn angle() -> Field {
    Field::angle("angle", "Corner angle", 90.0)
        .range(20.0, 160.0)
        .group("Size")
        .size()
}

/// Code of the angular variant in the source's table.
const ANGULAR: i32 = 1;
const VARIANTS: &[Code] = &[
    Code {
        value: 0,
        label: "rectangular",
    },
    Code {
        value: ANGULAR,
        label: "angular",
    },
];

/// Rectangular or angular.
pub const fn variant() -> Field {
    Field::code_of("variant", "Variant", 0, VARIANTS)
        .help("Rectangular: four touches, each pair opposite. Angular: from the start angle on, step by step.")
        .code("CmdPrm.Int[-59]")
        .group("Touches")
}

/// First angle of the angular variant.
pub const fn start_angle() -> Field {
    Field::angle("startAngle", "Start angle", 0.0)
        .help("Angular variant: where the first touch is, counter-clockwise from the first direction.")
        .code("CmdPrm.Flt[-60]")
        .only_with("variant", ANGULAR)
        .group("Touches")
        .seen(BestView::Rotation)
}

/// Angle from touch to touch in the angular variant.
pub const fn angular_step() -> Field {
    Field::angle("angularStep", "Angular step", 90.0)
        .help("Angular variant: from one touch to the next, counter-clockwise positive.")
        .code("CmdPrm.Flt[-61]")
        .only_with("variant", ANGULAR)
        .group("Touches")
        .seen(BestView::Rotation)
}

/// Number of touches in the angular variant.
pub const fn step_count() -> Field {
    Field::count("stepCount", "Step count", 4, 1, 16)
        .help("Angular variant: how many touches.")
        .because(words!("the parameter table holds 16 touch points"))
        .code("CmdPrm.Int[-62]")
        .only_with("variant", ANGULAR)
        .group("Touches")
}

const fn property(key: &'static str, label: &'static str, code: &'static str) -> Field {
    Field::count(key, label, 1, -1_000_000, 1_000_000)
        .null_by_default()
        .null_means("not set")
        .code(code)
        .group("Postprocessor properties")
}

form! {
    /// Custom properties of a cycle for the postprocessor. Properties that are not set are not in the table.
    pub struct Properties {
        /// 0 global, 1 one work offset, 2 parametrical (G10), 3 local (G52).
        wcs_mode: Option<i32> = property("wcsMode", "Set WCS: mode", "CmdPrm.Int[-10]").usual(0.0, 3.0),
        /// Number of the coordinate system, in modes 1 and 2.
        wcs_number: Option<i32> = property("wcsNumber", "Set WCS: number", "CmdPrm.Int[-11]"),
        /// Whose offset is set.
        offset_tool: Option<i32> = property("offsetTool", "Set tool offset: tool", "CmdPrm.Int[-12]"),
        /// Its first corrector.
        offset_corrector1: Option<i32> = property("offsetCorrector1", "Set tool offset: corrector 1", "CmdPrm.Int[-13]"),
        /// Its second corrector.
        offset_corrector2: Option<i32> = property("offsetCorrector2", "Set tool offset: corrector 2", "CmdPrm.Int[-14]"),
        /// Which tool is checked.
        broken_tool: Option<i32> = property("brokenTool", "Broken tool: tool", "CmdPrm.Int[-15]"),
        /// Its first corrector.
        broken_corrector1: Option<i32> = property("brokenCorrector1", "Broken tool: corrector 1", "CmdPrm.Int[-16]"),
        /// Its second corrector.
        broken_corrector2: Option<i32> = property("brokenCorrector2", "Broken tool: corrector 2", "CmdPrm.Int[-17]"),
        /// Number of the tool probe.
        tool_probe: Option<i32> = property("toolProbe", "Calibrate tool probe: number", "CmdPrm.Int[-18]"),
        /// Its first corrector.
        tool_probe_corrector1: Option<i32> = property("toolProbeCorrector1", "Calibrate tool probe: corrector 1", "CmdPrm.Int[-19]"),
        /// Its second corrector.
        tool_probe_corrector2: Option<i32> = property("toolProbeCorrector2", "Calibrate tool probe: corrector 2", "CmdPrm.Int[-20]"),
        /// Number of the part probe.
        part_probe: Option<i32> = property("partProbe", "Calibrate part probe: number", "CmdPrm.Int[-21]"),
        /// Its first corrector.
        part_probe_corrector1: Option<i32> = property("partProbeCorrector1", "Calibrate part probe: corrector 1", "CmdPrm.Int[-22]"),
        /// Its second corrector.
        part_probe_corrector2: Option<i32> = property("partProbeCorrector2", "Calibrate part probe: corrector 2", "CmdPrm.Int[-23]"),
        /// The component it is reported under.
        report_component: Option<i32> = property("reportComponent", "Report: component", "CmdPrm.Int[-24]"),
        /// The feature it is reported under.
        report_feature: Option<i32> = property("reportFeature", "Report: feature", "CmdPrm.Int[-25]"),
    }
}
