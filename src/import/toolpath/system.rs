//! System variables of a control with values that a run knows.
//!
//! LinuxCNC: #5061 to #5063 and #5070 of the last probing move, #5420 to #5422 and `#<_x>` the current position, all in work coordinates and in the program's
//! units, and the modes as `#<_metric>` and related names (its documentation, *Parameters*). Fanuc and compatible controls: #5061 to #5063 the skip position,
//! #5001 to #5003 and #5041 to #5043 the current one, #4003 and #4006 the modes; that their positions are those of the work system without a tool length is
//! recalled and not verified on a control \[R\].

use crate::geom::Plane;
use crate::import::toolpath::key::Key;
use crate::import::toolpath::script::grammar::Language;

/// Values of the control before a block. Positions are in the current units of the program; NaN is unknown.
#[derive(Clone, Copy, Debug)]
pub struct System {
    pub place: [f64; 3],
    /// The position in machine coordinates.
    pub machine: [f64; 3],
    /// Zeros of the first work offsets in machine coordinates, the shift of G92, and the tool length from the tool table.
    pub offsets: [[f64; 3]; 9],
    pub shift: [f64; 3],
    pub table: [f64; 3],
    /// End of the last probing move, and whether it had a contact.
    pub contact: [f64; 3],
    /// That end in machine coordinates.
    pub contact_in_machine: [f64; 3],
    pub met: Option<bool>,
    /// Whether triggers of touches are known and there was none yet: the probe is not deflected.
    pub rests: bool,
    /// Each is `None` if the program has not stated it.
    pub metric: Option<bool>,
    pub absolute: Option<bool>,
    pub plane: Option<Plane>,
    pub offset: Option<i32>,
    pub tool: Option<f64>,
    pub feed: f64,
}

impl Default for System {
    fn default() -> Self {
        const NOWHERE: [f64; 3] = [f64::NAN; 3];
        System {
            place: NOWHERE,
            machine: NOWHERE,
            offsets: [NOWHERE; 9],
            shift: NOWHERE,
            table: NOWHERE,
            contact: NOWHERE,
            contact_in_machine: NOWHERE,
            met: None,
            rests: false,
            metric: None,
            absolute: None,
            plane: None,
            offset: None,
            tool: None,
            feed: f64::NAN,
        }
    }
}

impl System {
    /// Value of a SINUMERIK variable: `$AA_IW` the current position in the work system, `$AA_MW` that of the last contact, `$AC_MEA[1]` whether there was one,
    /// `$A_PROBE[1]` whether the probe is deflected: it stays at the last contact until it moves away.
    fn of_sinumerik(&self, name: &str) -> Option<Option<f64>> {
        let truth = |is: Option<bool>| is.map(|is| f64::from(u8::from(is)));
        let axis = |position: [f64; 3]| {
            let axis = name.split_once('[')?.1;
            let axis = ["X]", "Y]", "Z]"].iter().position(|known| *known == axis)?;
            Some((!position[axis].is_nan()).then_some(position[axis]))
        };
        let leaves = (0..3).any(|axis| self.place[axis] != self.contact[axis]);
        let deflected = self.met.map(|met| met && !leaves);
        match name {
            "$AC_MEA[1]" => Some(truth(self.met)),
            "$A_PROBE[1]" => Some(truth(deflected.or(self.rests.then_some(false)))),
            _ if name.starts_with("$AA_IW[") => axis(self.place),
            _ if name.starts_with("$AA_IM[") => axis(self.machine),
            _ if name.starts_with("$AA_MW[") => axis(self.contact),
            _ => None,
        }
    }

    /// Value of an LNC register: `R_SKIP[0,1]` whether there was a contact, `R_SKIP[0,201]` and following its position in machine coordinates,
    /// `R_MACH_COOR[0,1]` the current machine position; in mm. Sources contradict each other about work coordinates of a contact, so they are unknown.
    fn of_lnc(&self, name: &str) -> Option<Option<f64>> {
        let known = |x: f64| (!x.is_nan() && self.metric != Some(false)).then_some(x);
        let axis = |first: i32| {
            let number: i32 = name.split_once("[0,")?.1.strip_suffix(']')?.parse().ok()?;
            (first..first + 3)
                .contains(&number)
                .then_some((number - first) as usize)
        };
        if name == "r_skip[0,1]" {
            return Some(self.met.map(|met| f64::from(u8::from(met))));
        }
        if name.starts_with("r_skip[") {
            return Some(axis(201).and_then(|axis| known(self.contact_in_machine[axis])));
        }
        if name.starts_with("r_mach_coor[") {
            return Some(axis(1).and_then(|axis| known(self.machine[axis])));
        }
        None
    }

    /// Value of an Eding CNC variable: #5061 the contact and #5001 the current position in work coordinates, #5051 and #5071 the same in machine coordinates,
    /// #5067 whether there was a contact. #5380 and #5397 are 0: the program is not simulated.
    fn of_eding(&self, number: i32) -> Option<Option<f64>> {
        let known = |x: f64| (!x.is_nan()).then_some(x);
        let axis = (number % 10 - 1) as usize;
        Some(match number {
            5061..=5063 => known(self.contact[axis]),
            5051..=5053 => known(self.contact_in_machine[axis]),
            5001..=5003 => known(self.place[axis]),
            5071..=5073 => known(self.machine[axis]),
            5067 => self.met.map(|met| f64::from(u8::from(met))),
            5220 => self.offset.map(f64::from),
            5380 | 5397 => Some(0.0),
            _ => return None,
        })
    }

    /// Value in RepRapFirmware's object model: positions in mm, and `result`, 0 after a contact in the last probing move.
    fn of_reprap(&self, name: &str) -> Option<Option<f64>> {
        let known = |x: f64| (!x.is_nan() && self.metric != Some(false)).then_some(x);
        if name == "result" {
            return Some(self.met.filter(|met| *met).map(|_| 0.0));
        }
        let (axis, part) = name.strip_prefix("move.axes[")?.split_once("].")?;
        let axis: usize = axis.parse().ok().filter(|axis| *axis < 3)?;
        match part {
            "userPosition" => Some(known(self.place[axis])),
            "machinePosition" => Some(known(self.machine[axis])),
            _ => None,
        }
    }

    /// Whether a variable holds a setting from before the program: the tool in the spindle, the work offset.
    pub fn is_set_up(key: &Key) -> bool {
        match key {
            Key::Number(number) => matches!(number, 5211..=5213 | 5220..=5403),
            Key::Name(name) => name == "_coord_system" || name == "_current_tool",
            Key::Unknown => false,
        }
    }

    /// Value of a system variable: `None` for one that is not modelled, and an inner `None` if the run does not know it.
    pub fn get(&self, key: &Key, language: Language) -> Option<Option<f64>> {
        let linuxcnc = match (language, key) {
            (Language::Sinumerik, Key::Name(name)) => return self.of_sinumerik(name),
            (Language::RepRap, Key::Name(name)) => return self.of_reprap(name),
            (Language::Lnc, Key::Name(name)) => return self.of_lnc(name),
            (Language::Eding, Key::Number(number)) => return self.of_eding(*number),
            (Language::Sinumerik | Language::Heidenhain | Language::RepRap | Language::Lnc, _) => {
                return None;
            }
            (language, _) => language == Language::LinuxCnc,
        };
        let known = |x: f64| (!x.is_nan()).then_some(x);
        let axis = |number: i32, first: i32| (number - first) as usize;
        let truth = |is: Option<bool>| is.map(|is| f64::from(u8::from(is)));
        Some(match key {
            Key::Number(n @ 5061..=5063) => known(self.contact[axis(*n, 5061)]),
            Key::Number(5070) if linuxcnc => truth(self.met),
            Key::Number(n @ 5420..=5422) if linuxcnc => known(self.place[axis(*n, 5420)]),
            Key::Number(5220) if linuxcnc => self.offset.map(f64::from),
            Key::Number(n @ 5211..=5213) if linuxcnc => known(self.shift[axis(*n, 5211)]),
            Key::Number(n @ 5221..=5383) if (n - 5221) % 20 < 3 => {
                known(self.offsets[axis(*n, 5221) / 20][axis(*n, 5221) % 20])
            }
            Key::Number(n @ 5401..=5403) if linuxcnc => known(self.table[axis(*n, 5401)]),
            Key::Number(n @ 5021..=5023) if !linuxcnc => known(self.machine[axis(*n, 5021)]),
            Key::Number(5400) if linuxcnc => self.tool,
            Key::Number(n @ 5001..=5003) if !linuxcnc => known(self.place[axis(*n, 5001)]),
            Key::Number(n @ 5041..=5043) if !linuxcnc => known(self.place[axis(*n, 5041)]),
            Key::Number(4002) if !linuxcnc => self.plane.map(|plane| match plane {
                Plane::G17 => 17.0,
                Plane::G18 => 18.0,
                Plane::G19 => 19.0,
            }),
            Key::Number(4003) if !linuxcnc => self
                .absolute
                .map(|absolute| if absolute { 90.0 } else { 91.0 }),
            Key::Number(4006) if !linuxcnc => {
                self.metric.map(|metric| if metric { 21.0 } else { 20.0 })
            }
            Key::Name(name) if linuxcnc => match name.as_str() {
                "_x" => known(self.place[0]),
                "_y" => known(self.place[1]),
                "_z" => known(self.place[2]),
                // A run simulates the machine.
                "_task" => Some(1.0),
                "_metric" => truth(self.metric),
                "_imperial" => truth(self.metric.map(|metric| !metric)),
                "_absolute" => truth(self.absolute),
                "_incremental" => truth(self.absolute.map(|absolute| !absolute)),
                "_feed" => known(self.feed),
                "_coord_system" => self.offset.map(|number| f64::from(530 + 10 * number)),
                "_current_tool" => self.tool,
                _ => return None,
            },
            _ => return None,
        })
    }
}
