//! Summary of what a program writes to the control's tables, in one sentence. Header, list of controls, panel and setup sheet all show it.

use crate::control::{Family, ProgramForm, Request};
use crate::geom::AXIS_NAMES;
use crate::path::{Feature, ParameterValue, TwoCircles};
use crate::text::{Text, text};

/// Suffix after [`Request::does`] in a header, for a program that writes a work offset at its end.
pub(super) const ONCE: &str = ": selected first, written once, at the very end";

/// Settings of cycle 1411 for its action after probing.
struct Preset {
    /// Axes of the active preset that Q1120 corrects, in the order X, Y, Z.
    axes: Vec<&'static str>,
    /// Q1121: 0 nothing, 1 basic rotation, 2 offset of the rotary table.
    rotation: i32,
    /// Q1126: whether the rotary table turns.
    turns: bool,
}

impl Request<'_> {
    /// Values that the program writes: axes of its work offset in the order X, Y, Z, then the rotation; the same for the active preset if a native cycle writes
    /// it. Empty if it only measures.
    pub fn writes(&self) -> Vec<&'static str> {
        if let Some(preset) = self.preset() {
            let axes = preset.axes.into_iter().map(|axis| match axis {
                "X" => "preset X",
                "Y" => "preset Y",
                _ => "preset Z",
            });
            let rotation = match preset.rotation {
                1 => Some("basic rotation"),
                2 => Some("table offset"),
                _ => None,
            };
            return axes.chain(rotation).collect();
        }
        let Some(datum) = self
            .path
            .formula
            .datum
            .as_ref()
            .filter(|_| self.work_offset.is_some())
        else {
            return Vec::new();
        };
        let (axes, measured) = (self.plane.axes(), datum.measured());
        let of_axis = |axis: &usize| (0..3).any(|i| axes[i] == *axis && measured[i]);
        let rotation = datum.rotation.map(|_| "rotation");
        (0..3)
            .filter(of_axis)
            .map(|axis| AXIS_NAMES[axis])
            .chain(rotation)
            .collect()
    }

    /// The sentence: `writes G54 X Y`, `measures only`, `sets the basic rotation and preset X Y`.
    pub fn does(&self) -> Text {
        if matches!(self.path.feature, Feature::Unmoving) {
            return text!("moves nothing, writes nothing");
        }
        if self.dry.is_some() {
            return match self.work_offset {
                Some(number) => {
                    text!(
                        "makes a dry run: selects {offset}, measures nothing, writes nothing",
                        (self.post.work_offset_word)(number)
                    )
                }
                None => text!("makes a dry run: measures nothing, writes nothing"),
            };
        }
        if let Some(preset) = self.preset() {
            return preset.does();
        }
        let corrects = match self.tools().as_slice() {
            [] => None,
            [tool] => Some(text!("corrects tool offset {tool}", *tool)),
            tools => {
                let tools = tools
                    .iter()
                    .map(i32::to_string)
                    .collect::<Vec<_>>()
                    .join(", ");
                Some(text!("corrects tool offsets {tools}", tools))
            }
        };
        match (self.does_to_offset(), corrects) {
            (does, None) => does.unwrap_or_else(|| text!("measures only")),
            (None, Some(corrects)) => corrects,
            (Some(does), Some(corrects)) => text!("{does}, {corrects}", does, corrects),
        }
    }

    /// Tool offsets that its macros correct, or the program itself.
    fn tools(&self) -> Vec<i32> {
        let own = || {
            let tools = self.corrections().into_iter();
            let mut tools: Vec<i32> = tools.map(|own| own.wear.tool).collect();
            tools.sort_unstable();
            tools.dedup();
            tools
        };
        self.path
            .calls
            .as_ref()
            .map_or_else(own, |calls| calls.tools())
    }

    /// Summary for the work offset of the job; `None` if the job names no offset.
    fn does_to_offset(&self) -> Option<Text> {
        let number = self.work_offset?;
        let offset = (self.post.work_offset_word)(number);
        let writes = self.writes();
        Some(match writes.as_slice() {
            [] => text!("selects {offset}, writes nothing", offset),
            ["rotation"] => text!("writes the rotation of {offset}", offset),
            [axes @ .., "rotation"] => text!(
                "writes {offset} {axes} and rotation",
                offset,
                axes.join(" ")
            ),
            axes => text!("writes {offset} {axes}", offset, axes.join(" ")),
        })
    }

    /// Whether the native cycle changes the active preset.
    pub fn corrects_preset(&self) -> bool {
        self.preset()
            .is_some_and(|own| own.turns || own.rotation != 0 || !own.axes.is_empty())
    }

    /// Change of the active preset by the native cycle; `None` if the program itself writes.
    fn preset(&self) -> Option<Preset> {
        let circles = self
            .path
            .feature
            .two_circles()
            .filter(|_| self.form == ProgramForm::Cycle && self.path.calls.is_none())?;
        let [abscissa, ordinate, _] = self.plane.axes();
        let corrects = code(circles, 1120) != 0;
        let axes = (0..3)
            .filter(|axis| corrects && [abscissa, ordinate].contains(axis))
            .map(|axis| AXIS_NAMES[axis]);
        Some(Preset {
            axes: axes.collect(),
            rotation: code(circles, 1121),
            turns: code(circles, 1126) != 0,
        })
    }
}

impl Preset {
    fn does(&self) -> Text {
        let axes = self.axes.join(" ");
        let does = match (self.rotation, self.axes.is_empty()) {
            (1, true) => text!("sets the basic rotation"),
            (1, false) => text!("sets the basic rotation and preset {axes}", axes),
            (2, true) => text!("sets the rotary table offset of the preset"),
            (2, false) => text!("sets the rotary table offset and preset {axes}", axes),
            (_, false) => text!("sets preset {axes}", axes),
            (_, true) => text!("measures only"),
        };
        if self.turns {
            text!("{does}, turns the rotary table", does)
        } else {
            does
        }
    }
}

/// A whole-number setting of the cycle.
pub(super) fn code(circles: &TwoCircles, number: i32) -> i32 {
    match circles
        .settings
        .iter()
        .find(|setting| setting.number == number)
        .map(|setting| &setting.value)
    {
        Some(ParameterValue::Whole(n)) => *n,
        _ => 0,
    }
}

/// Header line with the summary. `how` tells how a work offset is written.
pub(super) fn line(request: &Request<'_>, how: &str) -> String {
    const CYCLE: &str = ": the cycle corrects the active preset by itself";
    let how = match (request.work_offset, request.preset()) {
        _ if matches!(request.path.feature, Feature::Unmoving) => "",
        (None, None) if request.corrects_tools() => {
            ": by the mean error of several parts, at the very end. No work offset is written"
        }
        (Some(_), None) if request.corrects_tools() => {
            ": at the very end, the tool by the mean error of several parts"
        }
        (offset, None) if !request.tools().is_empty() => {
            return sentence(request) + &by_calls(request, offset.is_some());
        }
        (None, None) if request.dry.is_some() => ", in the work offset that is active",
        (None, None) => ", in the work offset that is active: nothing is written",
        _ if request.writes().is_empty() => "",
        (_, Some(_)) => CYCLE,
        (Some(_), None) => how,
    };
    sentence(request) + how
}

/// How native cycles correct tools, and write a work offset besides.
fn by_calls(request: &Request<'_>, writes: bool) -> String {
    let heidenhain = request.post.family == Family::Heidenhain;
    let by = match (heidenhain, writes) {
        (true, false) => "the cycle",
        (true, true) => "the cycles",
        (false, _) => "the macros",
    };
    let when = match (request.measures_first(), writes) {
        (true, _) => "after the results were shown",
        (false, true) => "as soon as each has measured",
        (false, false) => "as soon as the size is measured",
    };
    let rest = match writes {
        true if heidenhain => ". Cycle 247 activates the row at the end",
        true => "",
        false => ". No work offset is written",
    };
    format!(": by {by}, {when}{rest}")
}

/// The summary with a capital.
pub(super) fn sentence(request: &Request<'_>) -> String {
    let mut does = request.does().english();
    does[..1].make_ascii_uppercase();
    does
}
