//! Origin of the work coordinate system, from what a program states.
//!
//! Positions are those of the active system. The system in which the first move is made is the one that is drawn: position p of the active system lies at
//! `origin + R·T(p)` in it. R is the rotation of the work offset (`G10 L2 R`), taken to be 0 until the program sets one [I]; T is a rotation about a centre
//! that the program sets (G68, ROT, cycle 10). `origin` includes the shifts (G92, G52, TRANS), which turn with the work offset, as on LinuxCNC. A tool length
//! changes positions and no origin.
//!
//! What is not known is NaN, axis by axis. Before the first move an unknown change leaves the start where it is: the start is a position of the system in
//! which the first move is made.

use crate::import::toolpath::control_kind::{ControlKind, Renames};

/// X, Y, Z.
pub(super) type Position = [f64; 3];

/// A set of X, Y, Z, or of I, J, K: one bit each.
pub(super) type Axes = u8;

const UNKNOWN: Position = [f64::NAN; 3];
const NOTHING: Position = [0.0; 3];

/// X and Y, which a rotation mixes.
const LEVEL: Axes = 3;

/// Largest number of stored work offsets.
const MOST_OFFSETS: usize = 200;

/// A work offset.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Offset {
    /// Its zero in machine coordinates.
    machine: Position,
    /// Its zero, with the shifts, in the drawn system.
    origin: Position,
    /// Its rotation about Z, degrees.
    angle: f64,
}

/// A register added to every work offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Register {
    /// G92.
    Shift,
    /// G52, TRANS, cycle 7. It is 0 when a program begins \[I\].
    Local,
    /// The offset that a Fanuc adds to all others.
    External,
}

#[derive(Clone, Debug)]
pub(super) struct Frames {
    pub kind: ControlKind,
    /// Stored work offsets by number: 1 is G54.
    offsets: Vec<(i32, Offset)>,
    /// Number that the program has selected; before that 1 is assumed.
    active: Option<i32>,
    /// The active offset as it was loaded.
    now: Offset,
    /// Registers, in the order of [`Register`].
    shifts: [Position; 3],
    /// Shift that G92.3 restores.
    kept: Position,
    length: Position,
    /// Length of the tool in the spindle, from the tool table.
    table: Position,
    /// Rotation that the program has set: centre, and angle in degrees.
    turned: Option<(Position, f64)>,
    /// Whether an offset that was never set is 0.
    zero: bool,
    /// Whether the first move was made.
    pub begun: bool,
    /// Whether the system has moved since the last move.
    changed: bool,
    /// Whether an unknown change left a position as it was.
    guessed: bool,
}

impl Default for Frames {
    fn default() -> Self {
        Frames::new(ControlKind::Unknown, false)
    }
}

/// A position rotated about 0. Without a known angle each axis is known or unknown independently.
pub(super) fn turn(angle: f64, p: Position) -> Position {
    if angle == 0.0 {
        return p;
    }
    // Quarter turns are exact.
    let (sin, cos) = match angle.rem_euclid(360.0) {
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        angle => angle.to_radians().sin_cos(),
    };
    [p[0] * cos - p[1] * sin, p[0] * sin + p[1] * cos, p[2]]
}

fn add(a: Position, b: Position) -> Position {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn less(a: Position, b: Position) -> Position {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The axes of a mask.
fn each(axes: Axes) -> impl Iterator<Item = usize> {
    (0..3).filter(move |axis| axes & (1 << axis) != 0)
}

impl Frames {
    /// Nothing is known about the offsets, or each of them is 0.
    pub fn new(kind: ControlKind, zero: bool) -> Self {
        let start = if zero { NOTHING } else { UNKNOWN };
        let now = Offset {
            machine: start,
            origin: NOTHING,
            angle: 0.0,
        };
        Frames {
            kind,
            offsets: Vec::new(),
            active: None,
            now,
            shifts: [
                start,
                NOTHING,
                if kind.has_external_offset() {
                    start
                } else {
                    NOTHING
                },
            ],
            kept: start,
            length: start,
            table: start,
            turned: None,
            zero,
            begun: false,
            changed: false,
            guessed: false,
        }
    }

    /// Whether an unknown change has left a position as it was since the last call.
    pub fn take_guess(&mut self) -> bool {
        std::mem::take(&mut self.guessed)
    }

    /// Number of the active work offset, if the program selects one.
    pub fn active(&self) -> Option<i32> {
        self.active
    }

    /// Number of the active work offset; if every offset is 0 before the program, the first one is assumed.
    pub fn assumed_active(&self) -> Option<i32> {
        self.active.or_else(|| self.zero.then(|| self.number()))
    }

    /// Number of the active work offset; before one is selected that of G54.
    pub fn number(&self) -> i32 {
        let first = if self.kind == ControlKind::Heidenhain {
            i32::MIN
        } else {
            1
        };
        self.active.unwrap_or(first)
    }

    /// The coordinates of a position in the drawn system.
    pub fn drawn(&self, p: Position) -> Position {
        self.drawn_in(&self.now, p)
    }

    fn drawn_in(&self, offset: &Offset, p: Position) -> Position {
        add(offset.origin, turn(offset.angle, self.turned(p)))
    }

    /// Position in an offset of a point in the drawn system.
    fn position_in(&self, offset: &Offset, drawn: Position) -> Position {
        let p = turn(-offset.angle, less(drawn, offset.origin));
        match self.turned {
            None => p,
            Some((center, angle)) => add(center, turn(-angle, less(p, center))),
        }
    }

    fn turned(&self, p: Position) -> Position {
        match self.turned {
            None => p,
            Some((center, angle)) => add(center, turn(angle, less(p, center))),
        }
    }

    fn is_turned(&self) -> bool {
        self.now.angle != 0.0 || self.turned.is_some()
    }

    /// Whether the origin and the rotation in the drawn system are known.
    pub fn is_known(&self) -> bool {
        !self
            .drawn(NOTHING)
            .iter()
            .chain([&self.now.angle])
            .any(|x| x.is_nan())
    }

    /// Origin and rotation of the system in the drawn one, if they have changed since the last call.
    pub fn take_change(&mut self) -> Option<[f64; 4]> {
        if !std::mem::take(&mut self.changed) {
            return None;
        }
        let [x, y, z] = self.drawn(NOTHING);
        let angle = self.now.angle + self.turned.map_or(0.0, |(_, angle)| angle);
        Some([x, y, z, angle])
    }

    /// A stored work offset.
    fn offset(&self, number: i32) -> Offset {
        if let Some((_, offset)) = self.offsets.iter().find(|(known, _)| *known == number) {
            return *offset;
        }
        if number == self.number() {
            return self.now;
        }
        let machine = if self.zero { NOTHING } else { UNKNOWN };
        Offset {
            machine,
            origin: self.related(machine),
            angle: 0.0,
        }
    }

    /// Origin of a work offset from its zero in machine coordinates, by another offset that is known in both.
    fn related(&self, machine: Position) -> Position {
        let all = self.offsets.iter().map(|(_, offset)| offset);
        let known: Vec<&Offset> = all
            .chain([&self.now])
            .filter(|offset| offset.angle == 0.0)
            .collect();
        [0, 1, 2].map(|axis: usize| {
            let origins = known
                .iter()
                .map(|offset| offset.origin[axis] + machine[axis] - offset.machine[axis]);
            origins.fold(f64::NAN, f64::max)
        })
    }

    fn store(&mut self, number: i32, offset: Offset) {
        let has_room = self.offsets.len() < MOST_OFFSETS;
        match self.offsets.iter_mut().find(|(known, _)| *known == number) {
            Some((_, known)) => *known = offset,
            None if has_room => self.offsets.push((number, offset)),
            None => {}
        }
    }

    /// Changes the system. The machine does not move, and its position gets other numbers.
    fn change(&mut self, position: &mut Position, change: impl FnOnce(&mut Self)) {
        let drawn = self.drawn(*position);
        change(self);
        self.begins_here();
        let after = self.position_in(&self.now, drawn);
        // Without rounding noise.
        let after = if self.is_turned() {
            after.map(|x| (x * 1e9).round() / 1e9)
        } else {
            after
        };
        for axis in 0..3 {
            if self.begun || !after[axis].is_nan() {
                position[axis] = after[axis];
            }
        }
        self.changed = true;
    }

    /// Before the first move the drawn system is the active one along the axes of which nothing else is known.
    fn begins_here(&mut self) {
        if self.begun {
            return;
        }
        for axis in 0..3 {
            if self.now.origin[axis].is_nan() {
                self.guessed = true;
                for (_, offset) in &mut self.offsets {
                    offset.origin[axis] = f64::NAN;
                }
                self.now.origin[axis] = 0.0;
                let number = self.number();
                if let Some((_, own)) = self.offsets.iter_mut().find(|(known, _)| *known == number)
                {
                    own.origin[axis] = 0.0;
                }
            }
        }
    }

    /// Selects a work offset: G54 and the others.
    pub fn select(&mut self, number: i32, position: &mut Position) {
        let loads = number != self.number() || self.kind.loads_active_again();
        self.change(position, |frames| {
            // The previous offset is stored.
            frames.store(frames.number(), frames.offset(frames.number()));
            if loads {
                frames.now = frames.offset(number);
                frames.store(number, frames.now);
            }
            frames.active = Some(number);
        });
    }

    /// The current position gets these numbers in a work offset: `G10 L20`.
    pub fn write_position(
        &mut self,
        number: Option<i32>,
        axes: Axes,
        values: Position,
        position: &mut Position,
    ) {
        let number = number.unwrap_or(self.number());
        let is_active = number == self.number();
        if is_active {
            // A write loads the offset.
            self.change(position, |frames| frames.now = frames.offset(number));
        }
        let drawn = self.drawn(*position);
        let mut own = if is_active {
            self.now
        } else {
            self.offset(number)
        };
        let mut named = if is_active {
            *position
        } else {
            self.position_in(&own, drawn)
        };
        each(axes).for_each(|axis| named[axis] = values[axis]);
        let is_turned = own.angle != 0.0 || self.turned.is_some();
        let mixed = is_turned && axes & LEVEL != 0;
        let off = less(drawn, self.drawn_in(&own, named));
        for axis in each(if mixed { axes | LEVEL } else { axes }) {
            if mixed || !own.origin[axis].is_nan() {
                own.origin[axis] += off[axis];
                own.machine[axis] += off[axis];
            } else {
                // Unknown values become known by this.
                own.origin[axis] = drawn[axis] - named[axis];
                own.machine[axis] =
                    self.now.machine[axis] + own.origin[axis] - self.now.origin[axis];
            }
        }
        if is_turned && axes & LEVEL != LEVEL {
            // The effect on a rotated offset along an axis that is not named is not modelled.
            each(LEVEL).for_each(|axis| own.origin[axis] = f64::NAN);
            if is_active {
                each(LEVEL & !axes).for_each(|axis| named[axis] = f64::NAN);
            }
        }
        if is_active {
            self.now = own;
            *position = named;
        }
        self.store(number, own);
        self.begins_here();
        self.changed = true;
    }

    /// A work offset gets these values and a rotation: `G10 L2`. `added`: to its present values.
    pub fn write_value(
        &mut self,
        number: Option<i32>,
        (axes, values): (Axes, Position),
        angle: Option<f64>,
        added: bool,
        position: &mut Position,
    ) {
        let number = number.unwrap_or(self.number());
        let written = self.written(number, (axes, values), angle, added);
        let is_active = number == self.number();
        self.change(position, |frames| {
            frames.store(number, written);
            if is_active {
                frames.now = written;
            }
        });
    }

    fn written(
        &self,
        number: i32,
        (axes, values): (Axes, Position),
        angle: Option<f64>,
        added: bool,
    ) -> Offset {
        let mut own = self.offset(number);
        for axis in each(axes) {
            let before = own.machine[axis];
            let (machine, off) = if added {
                (before + values[axis], values[axis])
            } else {
                (values[axis], values[axis] - before)
            };
            own.machine[axis] = machine;
            own.origin[axis] = if off.is_nan() {
                self.related(own.machine)[axis]
            } else {
                own.origin[axis] + off
            };
        }
        if let Some(angle) = angle {
            // The effect on a shift that is active then is not modelled.
            let is_shifted = self
                .shifts
                .iter()
                .any(|shift| shift[..2].iter().any(|x| *x != 0.0));
            if is_shifted && angle != own.angle {
                each(LEVEL).for_each(|axis| own.origin[axis] = f64::NAN);
            }
            own.angle = angle;
        }
        own
    }

    /// Writes a work offset as a variable: one axis, or its rotation (axis 3).
    pub fn write_variable(
        &mut self,
        number: i32,
        axis: usize,
        value: f64,
        position: &mut Position,
    ) {
        let (axes, angle) = if axis < 3 {
            (1 << axis, None)
        } else {
            (0, Some(value))
        };
        let given = (axes, [value; 3]);
        if !self.kind.keeps_written_offsets() {
            return self.write_value(Some(number), given, angle, false, position);
        }
        let written = self.written(number, given, angle, false);
        self.store(number, written);
    }

    /// Any work offset may have been written along these axes.
    pub fn forget(&mut self, axes: Axes, position: &mut Position) {
        self.change(position, |frames| {
            let all = frames.offsets.iter_mut().map(|(_, offset)| offset);
            for offset in all.chain([&mut frames.now]) {
                each(axes).for_each(|axis| {
                    (offset.origin[axis], offset.machine[axis]) = (f64::NAN, f64::NAN);
                });
            }
        });
    }

    /// A work offset gets the measurement of a cycle along these axes. Without a number, or with an unknown one, any offset may be written. A nominal part
    /// changes nothing.
    pub fn measured(
        &mut self,
        number: Option<i32>,
        axes: Axes,
        nominal: bool,
        position: &mut Position,
    ) {
        let active = self.number();
        self.change(position, |frames| {
            let others = frames.offsets.iter_mut().filter_map(|(known, offset)| {
                number
                    .is_none_or(|number| number == *known)
                    .then_some(offset)
            });
            let now = number
                .is_none_or(|number| number == active)
                .then_some(&mut frames.now);
            for offset in others.chain(now) {
                each(axes).for_each(|axis| {
                    offset.machine[axis] = f64::NAN;
                    if !nominal {
                        offset.origin[axis] = f64::NAN;
                    }
                });
            }
        });
    }

    /// The current position gets these numbers by a shift: G92.
    pub fn shift_to(&mut self, axes: Axes, mut values: Position, position: &mut Position) {
        match self.kind.presets_position() {
            Renames::Active => return self.write_position(None, axes, values, position),
            Renames::Machine => {
                each(axes).for_each(|axis| values[axis] -= self.now.machine[axis]);
            }
            Renames::Everywhere => {}
        }
        let mut named = *position;
        each(axes).for_each(|axis| named[axis] = values[axis]);
        let mixed = self.turned.is_some() && axes & LEVEL != 0;
        let all = less(self.turned(*position), self.turned(named));
        let mut off = NOTHING;
        each(if mixed { axes | LEVEL } else { axes }).for_each(|axis| off[axis] = all[axis]);
        self.move_all(off);
        let [shift, local, _] = &mut self.shifts;
        for axis in each(axes) {
            shift[axis] += off[axis] + local[axis];
            local[axis] = 0.0;
        }
        self.kept = self.shifts[0];
        *position = named;
        self.begins_here();
        self.changed = true;
    }

    /// All origins move, each along its own axes.
    fn move_all(&mut self, off: Position) {
        let all = self.offsets.iter_mut().map(|(_, offset)| offset);
        for offset in all.chain([&mut self.now]) {
            offset.origin = add(offset.origin, turn(offset.angle, off));
        }
    }

    /// A register added to every work offset gets these values.
    pub fn set_shift(
        &mut self,
        register: Register,
        (axes, values): (Axes, Position),
        added: bool,
        position: &mut Position,
    ) {
        let register = match register {
            Register::Local if self.kind.shares_shift() => Register::Shift,
            register => register,
        };
        self.change(position, |frames| {
            let own = register as usize;
            let mut off = NOTHING;
            for axis in each(axes) {
                let before = frames.shifts[own][axis];
                let after = if added {
                    before + values[axis]
                } else {
                    values[axis]
                };
                // The effect of a shift under a rotation differs between controls.
                let mixed = frames.turned.is_some() && axis < 2;
                off[axis] = if mixed {
                    f64::NAN
                } else if added {
                    values[axis]
                } else {
                    after - before
                };
                frames.shifts[own][axis] = after;
            }
            frames.move_all(off);
            if register == Register::Shift {
                frames.kept = frames.shifts[own];
            }
        });
    }

    /// G92.1 and G92.2 end a shift, the first for good.
    pub fn end_shift(&mut self, for_good: bool, position: &mut Position) {
        let kept = if for_good { NOTHING } else { self.kept };
        self.set_shift(Register::Shift, (7, NOTHING), false, position);
        self.kept = kept;
    }

    /// G92.3 restores it.
    pub fn bring_shift_back(&mut self, position: &mut Position) {
        self.set_shift(Register::Shift, (7, self.kept), false, position);
    }

    /// Ends the shift and the rotation that a program of a SINUMERIK or a HEIDENHAIN has set, and sets another shift.
    pub fn replace_program_shift(&mut self, axes: Axes, values: Position, position: &mut Position) {
        self.change(position, |frames| frames.turned = None);
        let mut all = NOTHING;
        each(axes).for_each(|axis| all[axis] = values[axis]);
        self.set_shift(Register::Local, (7, all), false, position);
    }

    /// A rotation about a centre, degrees counter-clockwise; without a centre about the current position.
    pub fn begin_turn(
        &mut self,
        center: Option<Position>,
        angle: f64,
        added: bool,
        position: &mut Position,
    ) {
        let center = center.unwrap_or(*position);
        self.change(position, |frames| {
            let before = frames
                .turned
                .filter(|_| added)
                .map_or(0.0, |(_, angle)| angle);
            frames.turned = Some((center, before + angle));
        });
    }

    pub fn end_turn(&mut self, position: &mut Position) {
        self.change(position, |frames| frames.turned = None);
    }

    /// The system is mirrored, scaled, tilted, or moved in another way that is not modelled.
    pub fn lose(&mut self, position: &mut Position) {
        self.change(position, |frames| {
            frames.turned = None;
            frames.now.origin = UNKNOWN;
        });
    }

    /// Sets the tool length along the axes: NaN is unknown. Returns the axes whose position becomes unknown.
    pub fn set_length(
        &mut self,
        axes: Axes,
        values: Position,
        added: bool,
        position: &mut Position,
    ) -> Axes {
        let mut lost = 0;
        for axis in each(axes) {
            let before = self.length[axis];
            let (after, off) = if added {
                (before + values[axis], values[axis])
            } else {
                (values[axis], values[axis] - before)
            };
            self.length[axis] = after;
            let mixed = axis < 2 && self.is_turned();
            let off = if mixed && off != 0.0 { f64::NAN } else { off };
            if off.is_nan() && self.begun && !position[axis].is_nan() {
                lost |= 1 << axis;
            }
            if self.begun || !off.is_nan() {
                position[axis] -= off;
            }
        }
        lost
    }

    pub fn length(&self) -> Position {
        self.length
    }

    /// Length of the tool in the spindle, from the tool table.
    pub fn table(&self) -> Position {
        self.table
    }

    /// Another tool is in the spindle.
    pub fn change_tool(&mut self) {
        if !self.zero {
            self.table = UNKNOWN;
        }
    }

    /// Offset between machine coordinates and those of the drawn system.
    fn machine_offset(&self) -> Position {
        let shifts = self.shifts.iter().fold(NOTHING, |sum, one| add(sum, *one));
        let zero = less(self.now.machine, self.now.origin);
        add(add(zero, turn(self.now.angle, shifts)), self.length)
    }

    /// The coordinates of the machine at a position.
    pub fn in_machine(&self, position: Position) -> Position {
        add(self.drawn(position), self.machine_offset())
    }

    /// Position after a move to machine coordinates along these axes, from another position. The machine does not move along the others.
    pub fn after_machine_move(&self, axes: Axes, values: Position, from: Position) -> Position {
        let mut machine = self.in_machine(from);
        each(axes).for_each(|axis| machine[axis] = values[axis]);
        let after = self.position_in(&self.now, less(machine, self.machine_offset()));
        let mixed = self.is_turned() && axes & LEVEL != 0;
        [0, 1, 2].map(|axis: usize| {
            let moves = axes & (1 << axis) != 0 || mixed && axis < 2;
            if moves { after[axis] } else { from[axis] }
        })
    }

    /// Values of #5061 and related variables after a contact at a position: machine coordinates on FluidNC, without the shift and the tool length on grblHAL.
    pub fn contact_variables(&self, position: Position) -> Position {
        match self.kind {
            ControlKind::FluidNc => self.in_machine(position),
            ControlKind::GrblHal => add(add(position, self.shifts[0]), self.length),
            _ => position,
        }
    }

    /// Stored values of the first work offsets.
    pub fn values(&self) -> [Position; 9] {
        let start = if self.zero { NOTHING } else { UNKNOWN };
        std::array::from_fn(|i| {
            let number = i as i32 + 1;
            match self.offsets.iter().find(|(known, _)| *known == number) {
                Some((_, offset)) => offset.machine,
                None if number == self.number() => self.now.machine,
                None => start,
            }
        })
    }

    /// The shift of G92.
    pub fn shift(&self) -> Position {
        self.shifts[0]
    }

    /// Sets a value known before the program: an axis of a work offset, or its rotation (axis 3).
    pub fn tell_offset(&mut self, number: i32, axis: usize, value: f64) {
        let mut own = self.offset(number);
        if axis == 3 {
            own.angle = value;
        } else {
            own.machine[axis] = value;
        }
        self.store(number, own);
        self.tell_active(self.active);
    }

    /// Sets the active work offset known before the program: the others are relative to it.
    pub fn tell_active(&mut self, number: Option<i32>) {
        self.active = number;
        let number = self.number();
        let mut own = self.offset(number);
        own.origin = NOTHING;
        (self.now, self.kept) = (own, self.shifts[0]);
        self.store(number, own);
        for (known, offset) in &mut self.offsets {
            if *known != number {
                offset.origin = less(offset.machine, own.machine);
            }
        }
    }

    /// Sets an axis of the shift known before the program.
    pub fn tell_shift(&mut self, axis: usize, value: f64) {
        self.shifts[0][axis] = value;
        self.kept = self.shifts[0];
    }

    /// Sets the tool length known before the program.
    pub fn tell_length(&mut self, axis: usize, value: f64) {
        self.table[axis] = value;
    }

    /// Joins two branches: only values that both know and agree on stay known.
    pub fn agree(&mut self, other: &Frames) {
        fn agreed(own: &mut f64, other: f64) {
            if *own != other {
                *own = f64::NAN;
            }
        }
        let both = |own: &mut Position, other: Position| {
            for axis in 0..3 {
                agreed(&mut own[axis], other[axis]);
            }
        };
        let offset = |own: &mut Offset, other: Offset| {
            both(&mut own.machine, other.machine);
            both(&mut own.origin, other.origin);
            agreed(&mut own.angle, other.angle);
        };
        self.changed |= self.now != other.now || self.turned != other.turned;
        offset(&mut self.now, other.now);
        for (number, own) in &mut self.offsets {
            offset(own, other.offset(*number));
        }
        for (number, theirs) in &other.offsets {
            let mut own = self.offset(*number);
            offset(&mut own, *theirs);
            self.store(*number, own);
        }
        for (own, theirs) in self.shifts.iter_mut().zip(other.shifts) {
            both(own, theirs);
        }
        both(&mut self.kept, other.kept);
        both(&mut self.length, other.length);
        if self.active != other.active {
            self.active = Some(i32::MIN);
        }
        if self.turned != other.turned {
            (self.turned, self.now.origin) = (None, UNKNOWN);
        }
    }
}
