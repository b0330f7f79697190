//! Results of 1411, as the control computes them.

use crate::cycle::heidenhain::two_circles::{Object, PositionSource, TwoCircles};
use crate::formula::{CirclePart, Coordinate, Draft, Formula, Name, OffsetCorrection, Role, Value};
use crate::path::ProbeSettings;
use crate::text::words;

/// Codes and meanings of the rows of each object.
const CENTRES: [[(&str, &str); 3]; 2] = [
    [
        ("Q950", words!("Measured centre 1, main axis")),
        ("Q951", words!("Measured centre 1, minor axis")),
        ("Q952", words!("Measured centre 1, tool axis")),
    ],
    [
        ("Q953", words!("Measured centre 2, main axis")),
        ("Q954", words!("Measured centre 2, minor axis")),
        ("Q955", words!("Measured centre 2, tool axis")),
    ],
];
const OFFSETS: [[(&str, &str); 3]; 2] = [
    [
        ("Q980", words!("Deviation of centre 1, main axis")),
        ("Q981", words!("Deviation of centre 1, minor axis")),
        ("Q982", words!("Deviation of centre 1, tool axis")),
    ],
    [
        ("Q983", words!("Deviation of centre 2, main axis")),
        ("Q984", words!("Deviation of centre 2, minor axis")),
        ("Q985", words!("Deviation of centre 2, tool axis")),
    ],
];
const DIAMETERS: [(&str, &str); 2] = [
    ("Q966", words!("Measured diameter 1")),
    ("Q967", words!("Measured diameter 2")),
];
const DIAMETER_OFFSETS: [(&str, &str); 2] = [
    ("Q996", words!("Deviation of diameter 1")),
    ("Q997", words!("Deviation of diameter 2")),
];

const RESIDUALS: [(&str, &str); 2] = [
    (
        "residual1",
        words!("Residual of circle 1, root mean square"),
    ),
    (
        "residual2",
        words!("Residual of circle 2, root mean square"),
    ),
];

/// Known values of an object: centre and diameter, each measured or given.
struct Measured<'f> {
    centre: [Option<Value<'f>>; 3],
    diameter: Option<Value<'f>>,
    residual: Option<Value<'f>>,
}

/// Name of a value: `q950` for the code `Q950`.
fn q(code: &str) -> Name {
    Name::new("q", code[1..].parse().unwrap_or_default())
}

impl TwoCircles {
    /// The formula: both circles, the rotation of the line through their centres, deviations, and the written values.
    pub(super) fn computed(&self, setup: &ProbeSettings) -> Formula {
        let f = Draft::with_room_for(2 * self.form.probe_points as usize);
        let mut first = 0;
        let objects = self.objects();
        let measured = [&objects[0], &objects[1]].map(|object| {
            let measured = self.measured(&f, object, first, setup);
            if object.state == PositionSource::Probed {
                first += self.form.probe_points as usize;
            }
            measured
        });
        let rotation = self.rotation(&f, &objects, &measured);
        for ((object, known), codes) in objects.iter().zip(&measured).zip(CENTRES) {
            for (axis, (code, meaning)) in codes.into_iter().enumerate() {
                let role = [Role::Abscissa, Role::Ordinate, Role::Height][axis];
                let nominal = object.point[axis].nominal.unwrap_or(f64::NAN);
                f.result(code, role, meaning, nominal, known.centre[axis]);
                f.referred_to(object.reference(axis).unwrap_or(f64::NAN));
            }
        }
        let turned = rotation.map(|r| f.set("q965", f.number(0.0) - r));
        f.result(
            "Q964",
            Role::Direction,
            words!("Measured basic rotation"),
            0.0,
            rotation,
        );
        f.result(
            "Q965",
            Role::Turn,
            words!("Measured table rotation"),
            0.0,
            turned,
        );
        for ((object, known), (code, meaning)) in objects.iter().zip(&measured).zip(DIAMETERS) {
            f.result(
                code,
                Role::Size,
                meaning,
                object.nominal_diameter(),
                known.diameter,
            );
            f.referred_to(object.diameter.reference().unwrap_or(f64::NAN));
        }
        for ((object, known), codes) in objects.iter().zip(&measured).zip(OFFSETS) {
            for (axis, (code, meaning)) in codes.into_iter().enumerate() {
                let reference = object.reference(axis);
                let off = known.centre[axis].zip(reference);
                let off = off.map(|(value, reference)| f.set(q(code), value - f.length(reference)));
                f.result(code, Role::Shift, meaning, 0.0, off);
            }
        }
        f.result(
            "Q994",
            Role::Turn,
            words!("Angle deviation of the basic rotation"),
            0.0,
            rotation,
        );
        f.result(
            "Q995",
            Role::Turn,
            words!("Angle deviation of the table rotation"),
            0.0,
            turned,
        );
        for ((object, known), (code, meaning)) in
            objects.iter().zip(&measured).zip(DIAMETER_OFFSETS)
        {
            let off = known.diameter.zip(object.diameter.reference());
            let off = off.map(|(value, reference)| f.set(q(code), value - f.length(reference)));
            f.result(code, Role::Shift, meaning, 0.0, off);
        }
        for (known, (code, meaning)) in measured.iter().zip(RESIDUALS) {
            if known.residual.is_some() {
                f.result(code, Role::Residual, meaning, 0.0, known.residual);
            }
        }
        let datum = self.presets(&f, &objects, &measured, rotation);
        f.finish(Some(datum))
    }

    fn measured<'f>(
        &self,
        f: &'f Draft,
        object: &Object,
        first: usize,
        setup: &ProbeSettings,
    ) -> Measured<'f> {
        let number = object.number;
        match object.state {
            PositionSource::SemiAutomatic => Measured {
                centre: [None, None, None],
                diameter: None,
                residual: None,
            },
            PositionSource::Entered => {
                let at = |axis: usize| {
                    let actual = object.point[axis].actual?;
                    Some(f.set(
                        Name::new("given", number).and("_").at(axis),
                        f.length(actual),
                    ))
                };
                Measured {
                    centre: [at(0), at(1), at(2)],
                    diameter: None,
                    residual: None,
                }
            }
            PositionSource::Probed => {
                let [a, o, _] = setup.plane.axes();
                let count = self.form.probe_points as usize;
                let part = |part| f.circle((first, count), (a, o), part);
                let x = f.set(q(CENTRES[number - 1][0].0), part(CirclePart::Abscissa));
                let y = f.set(q(CENTRES[number - 1][1].0), part(CirclePart::Ordinate));
                let height = object.point[2].nominal.unwrap_or(0.0);
                let z = f.set(q(CENTRES[number - 1][2].0), f.length(height));
                // The ball centres are one radius inside the wall of a hole, outside the wall of a stud.
                let wall = part(CirclePart::Radius) + f.length(object.outward() * setup.radius);
                let diameter = f.set(q(DIAMETERS[number - 1].0), f.number(2.0) * wall);
                // Three touches always lie exactly on a circle.
                let residual = (count > 3)
                    .then(|| f.set(Name::new("residual", number), part(CirclePart::Residual)));
                Measured {
                    centre: [Some(x), Some(y), Some(z)],
                    diameter: Some(diameter),
                    residual,
                }
            }
        }
    }

    /// Rotation of the measured line from nominal, wrapped to (−180, 180], counter-clockwise positive: the angle of the measured vector in axes along and
    /// across the nominal line.
    fn rotation<'f>(
        &self,
        f: &'f Draft,
        objects: &[Object; 2],
        measured: &[Measured<'f>; 2],
    ) -> Option<Value<'f>> {
        let (p, q) = (objects[0].place()?, objects[1].place()?);
        let length = (q[0] - p[0]).hypot(q[1] - p[1]);
        let (cos, sin) = ((q[0] - p[0]) / length, (q[1] - p[1]) / length);
        let [x1, y1, _] = measured[0].centre;
        let [x2, y2, _] = measured[1].centre;
        let dx = f.set("line_a", x2? - x1?);
        let dy = f.set("line_o", y2? - y1?);
        let along = f.set("line_along", f.project(dx, dy, (cos, sin)));
        let across = f.set("line_across", f.project(dx, dy, (-sin, cos)));
        Some(f.set("q964", across.atan2(along)))
    }

    /// Values that Q1120, Q1121 and Q1126 write.
    fn presets<'f>(
        &self,
        f: &'f Draft,
        objects: &[Object; 2],
        measured: &[Measured<'f>; 2],
        rotation: Option<Value<'f>>,
    ) -> OffsetCorrection {
        let form = &self.form;
        let mut place = [None, None, None];
        if form.transfer_position != 0 {
            let axis = |i: usize, [mean, preset]: [&'static str; 2]| {
                let one = measured[0].centre[i].zip(objects[0].point[i].nominal);
                let two = measured[1].centre[i].zip(objects[1].point[i].nominal);
                let (value, nominal) = match form.transfer_position {
                    1 => one?,
                    2 => two?,
                    _ => {
                        let ((v1, n1), (v2, n2)) = (one?, two?);
                        (f.set(mean, (v1 + v2) / f.number(2.0)), (n1 + n2) / 2.0)
                    }
                };
                let shift = f.set(preset, value - f.length(nominal));
                Some((value, nominal, shift))
            };
            let (x, y) = (
                axis(0, ["mean_a", "preset_a"]),
                axis(1, ["mean_o", "preset_o"]),
            );
            let shift = |axis: Option<(Value<'f>, f64, Value<'f>)>| axis.map(|a| a.2);
            f.result(
                "preset.x",
                Role::Shift,
                words!("Shift of the preset in the main axis (Q1120)"),
                0.0,
                shift(x),
            );
            f.result(
                "preset.y",
                Role::Shift,
                words!("Shift of the preset in the minor axis (Q1120)"),
                0.0,
                shift(y),
            );
            if let Some((x, y)) = x.zip(y) {
                place = [
                    Some(Coordinate::measured(x.0, x.1)),
                    Some(Coordinate::measured(y.0, y.1)),
                    None,
                ];
            }
        }
        let turned = |r: Value<'f>| f.number(0.0) - r;
        match form.confirm_rotation {
            1 => f.result(
                "preset.rotation",
                Role::Turn,
                words!("Basic rotation written to the preset (Q1121)"),
                0.0,
                rotation,
            ),
            2 => {
                let offset = rotation.map(|r| f.set("table_offset", turned(r)));
                f.result(
                    "preset.table",
                    Role::Turn,
                    words!("Offset of the rotary table written to the preset (Q1121)"),
                    0.0,
                    offset,
                );
            }
            _ => {}
        }
        if form.align_rotary_axis != 0 {
            let turn = rotation.map(|r| f.set("table_turn", turned(r)));
            f.result(
                "table.turn",
                Role::Turn,
                words!("Turn of the rotary table (Q1126)"),
                0.0,
                turn,
            );
        }
        let rotation = rotation
            .filter(|_| form.confirm_rotation == 1)
            .map(|value| value.variable);
        OffsetCorrection {
            place,
            in_results: true,
            rotation,
        }
    }
}
