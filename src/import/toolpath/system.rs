//! System variables of a control: those whose values a run knows.
//!
//! LinuxCNC: #5061 to #5063 and #5070 of the last probing move, #5420 to #5422 and `#<_x>` the present position, all in work coordinates and in the
//! program's units, and the modes as `#<_metric>` and its kin (its documentation, *Parameters*). Fanuc and its kin: #5061 to #5063 the skip position,
//! #5001 to #5003 and #5041 to #5043 the present one, #4003 and #4006 the modes; that their positions are those of the work system without a tool length
//! is recalled and not verified on a control.

use crate::geom::Plane;
use crate::import::toolpath::key::Key;
use crate::import::toolpath::script::grammar::Language;

/// What the control knows before a block. Places are in the units that the program has now; NaN is not known.
#[derive(Clone, Copy, Debug)]
pub struct System {
    pub place: [f64; 3],
    /// The same in machine coordinates.
    pub machine: [f64; 3],
    /// The zeros of the first work offsets in machine coordinates, the shift of G92, the tool's length by the tool table.
    pub offsets: [[f64; 3]; 9],
    pub shift: [f64; 3],
    pub table: [f64; 3],
    /// Where the last probing move ended, and whether it met something.
    pub contact: [f64; 3],
    /// Where it ended in machine coordinates.
    pub contact_in_machine: [f64; 3],
    pub met: Option<bool>,
    /// Whether it is known what touches meet, and none was made yet: the probe is not deflected.
    pub rests: bool,
    /// Each `None` if the program has not stated it.
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
    /// What a SINUMERIK's variable holds: `$AA_IW` the present position in the work system, `$AA_MW` that of the last contact, `$AC_MEA[1]` whether there was
    /// one, `$A_PROBE[1]` whether the probe is deflected: it is where the last contact was, until it leaves.
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

    /// What an LNC's register holds: `R_SKIP[0,1]` whether there was a contact, `R_SKIP[0,201]` and following where in machine coordinates,
    /// `R_MACH_COOR[0,1]` the present position there; in mm. Work coordinates of a contact are told in two ways, and not known here.
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

    /// What an Eding CNC sets: #5061 the contact and #5001 the present position in work coordinates, #5051 and #5071 the same in machine coordinates, #5067
    /// whether there was a contact. #5380 and #5397 are 0: the program is not simulated.
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

    /// What RepRapFirmware's object model holds: positions in mm, and `result`, 0 where the last probing move made contact.
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

    /// Whether a variable holds what is set up before the program: the tool in the spindle, the work offset.
    pub fn is_set_up(key: &Key) -> bool {
        match key {
            Key::Number(number) => matches!(number, 5211..=5213 | 5220..=5403),
            Key::Name(name) => name == "_coord_system" || name == "_current_tool",
            Key::Unknown => false,
        }
    }

    /// What a variable of the control holds: none for one that is not followed here, and none within where the run does not know it.
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
                // A run is one on the machine.
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
