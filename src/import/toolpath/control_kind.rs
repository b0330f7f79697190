//! Controls whose programs differ in the effect of words on the coordinate system, and in the effect of a probing move beside moving.
//!
//! LinuxCNC, grbl, grblHAL, FluidNC, RepRapFirmware and Centroid by their sources and help texts; Fanuc and compatible controls, SINUMERIK and HEIDENHAIN by
//! manuals. Only recalled: that a write to a Fanuc's offset variables acts immediately \[R\].

use crate::import::dialect_markers::{self, DialectMarker};
use crate::import::toolpath::script::grammar::{self, Grammar};
use crate::import::toolpath::{DIALECTS, guess};

/// Control of a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum ControlKind {
    /// Any control with G codes.
    #[default]
    Unknown,
    LinuxCnc,
    Grbl,
    GrblHal,
    FluidNc,
    /// Fanuc, Haas, Mazak, Brother, Hurco.
    Fanuc,
    Centroid,
    RepRap,
    /// LNC, on SYIL and others.
    Lnc,
    Eding,
    PlanetCnc,
    /// Mach3: parameters, but no conditions and no jumps.
    Mach3,
    Sinumerik,
    Heidenhain,
}

/// Meaning of the number in `G92 X5`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Renames {
    /// The position in every work offset.
    Everywhere,
    /// The position in the active work offset only.
    Active,
    /// The position of the machine, without the work offset.
    Machine,
}

/// Controls that a program can be read for: key, name, dialect and kind.
const TOLD: [(&str, &str, usize, ControlKind); 18] = [
    ("linuxcnc", "LinuxCNC", 0, ControlKind::LinuxCnc),
    ("grbl", "grbl", 0, ControlKind::Grbl),
    ("grblhal", "grblHAL", 0, ControlKind::GrblHal),
    ("fluidnc", "FluidNC", 0, ControlKind::FluidNc),
    ("sinumerik", "SINUMERIK", 1, ControlKind::Sinumerik),
    ("heidenhain", "HEIDENHAIN", 2, ControlKind::Heidenhain),
    ("fanuc", "Fanuc", 0, ControlKind::Fanuc),
    ("haas", "Haas", 0, ControlKind::Fanuc),
    ("mazak", "Mazak", 0, ControlKind::Fanuc),
    ("brother", "Brother", 0, ControlKind::Fanuc),
    ("hurco", "Hurco", 0, ControlKind::Fanuc),
    ("okuma", "Okuma", 0, ControlKind::Unknown),
    ("centroid", "Centroid", 0, ControlKind::Centroid),
    ("reprapfirmware", "RepRapFirmware", 0, ControlKind::RepRap),
    ("lnc", "LNC (SYIL)", 0, ControlKind::Lnc),
    ("eding", "Eding CNC", 0, ControlKind::Eding),
    ("planetcnc", "PlanetCNC", 0, ControlKind::PlanetCnc),
    ("mach3", "Mach3", 0, ControlKind::Mach3),
];

/// Keys of the controls that a program can be read for, in the order of the documentation.
pub const PROGRAM_POSTS: [&str; TOLD.len()] = {
    let mut keys = [""; TOLD.len()];
    let mut i = 0;
    while i < TOLD.len() {
        keys[i] = TOLD[i].0;
        i += 1;
    }
    keys
};

/// Name of a control, by its key.
pub fn program_post_title(post: &str) -> Option<&'static str> {
    told(post).map(|(_, title, ..)| *title)
}

/// Dialect of a control's programs, by its key.
pub(in crate::import) fn dialect_of(post: &str) -> Option<&'static str> {
    told(post).map(|(.., dialect, _)| DIALECTS[*dialect])
}

fn told(post: &str) -> Option<&'static (&'static str, &'static str, usize, ControlKind)> {
    TOLD.iter().find(|(key, ..)| *key == post)
}

impl ControlKind {
    /// Key of the first control of this kind.
    pub fn post(self) -> Option<&'static str> {
        let own = TOLD.iter().find(|(.., kind)| *kind == self);
        own.filter(|_| self != ControlKind::Unknown)
            .map(|(key, ..)| *key)
    }

    /// The control of a text in a dialect: the given one, else by syntax that no other control has.
    pub fn of(text: &str, dialect: &str, post: Option<&str>) -> Self {
        if let Some((.., kind)) = post.and_then(told) {
            return *kind;
        }
        if dialect == DIALECTS[1] {
            return ControlKind::Sinumerik;
        }
        if dialect == DIALECTS[2] {
            return ControlKind::Heidenhain;
        }
        match dialect_markers::of(text) {
            _ if guess::is_centroid(text) => ControlKind::Centroid,
            _ if guess::is_lnc(text) => ControlKind::Lnc,
            _ if guess::is_eding(text) => ControlKind::Eding,
            _ if guess::is_planetcnc(text) => ControlKind::PlanetCnc,
            Some(DialectMarker::LinuxCnc | DialectMarker::Rs274) => ControlKind::LinuxCnc,
            Some(DialectMarker::LikeFanuc) => ControlKind::Fanuc,
            Some(DialectMarker::RepRap) => ControlKind::RepRap,
            // Programs that probe with macros only.
            None if calls_macros(text) => ControlKind::Fanuc,
            Some(DialectMarker::Klartext) | None => ControlKind::Unknown,
        }
    }

    /// Grammar of arithmetic and jumps; for an unknown control the text decides.
    pub fn grammar(self, text: &str, dialect: &str) -> &'static Grammar {
        match self {
            ControlKind::LinuxCnc
            | ControlKind::Grbl
            | ControlKind::GrblHal
            | ControlKind::FluidNc => &grammar::LINUXCNC,
            ControlKind::Fanuc => &grammar::MACRO_B,
            ControlKind::Centroid => &grammar::CENTROID,
            ControlKind::Lnc => &grammar::LNC,
            ControlKind::Eding => &grammar::EDING,
            ControlKind::PlanetCnc => &grammar::PLANETCNC,
            ControlKind::Mach3 => &grammar::MACH3,
            ControlKind::RepRap => &grammar::REPRAP,
            ControlKind::Sinumerik => &grammar::SINUMERIK,
            ControlKind::Heidenhain => &grammar::HEIDENHAIN,
            ControlKind::Unknown => match ControlKind::of(text, dialect, None) {
                ControlKind::Unknown => &grammar::MACRO_B,
                kind => kind.grammar(text, dialect),
            },
        }
    }

    /// Whether its programs compute: grbl reads plain numbers.
    pub fn computes(self) -> bool {
        self != ControlKind::Grbl
    }

    /// Whether `G10 L2` adds its values under G91.
    pub fn adds_settings(self) -> bool {
        self == ControlKind::Fanuc
    }

    /// Whether `G10 L2 P0` writes the offset that is added to all others, instead of the active one.
    pub fn has_external_offset(self) -> bool {
        self == ControlKind::Fanuc
    }

    /// Whether `G10 L20 Pn` writes values into `G54.1 Pn`. Elsewhere it makes the current position the given one.
    pub fn counts_by_l20(self) -> bool {
        self == ControlKind::Fanuc
    }

    /// Whether an offset written as a variable acts only after it is selected.
    pub fn keeps_written_offsets(self) -> bool {
        matches!(
            self,
            ControlKind::LinuxCnc
                | ControlKind::FluidNc
                | ControlKind::Sinumerik
                | ControlKind::Eding
        )
    }

    /// Whether selecting the active work offset reloads it.
    pub fn loads_active_again(self) -> bool {
        self != ControlKind::LinuxCnc
    }

    pub fn presets_position(self) -> Renames {
        match self {
            ControlKind::Centroid => Renames::Active,
            ControlKind::RepRap => Renames::Machine,
            _ => Renames::Everywhere,
        }
    }

    /// Whether G52 writes the register of G92.
    pub fn shares_shift(self) -> bool {
        self == ControlKind::LinuxCnc
    }

    /// Name of a work offset.
    pub fn offset_name(self, number: i32) -> String {
        match (self, number) {
            (_, ..=-1 | i32::MAX) => "?".to_owned(),
            (ControlKind::Heidenhain, row) => format!("row {row}"),
            (ControlKind::Sinumerik, 0) => "G500".to_owned(),
            (ControlKind::Sinumerik, number @ 5..) => format!("G{}", 500 + number),
            (_, number @ 1..=6) => format!("G{}", 53 + number),
            (ControlKind::Fanuc | ControlKind::Unknown, number @ 7..=26) => {
                format!("G{}", 103 + number)
            }
            (_, number @ 7..=9) => format!("G59.{}", number - 6),
            (_, number @ 1000..) => format!("G54.1 P{}", number / 1000),
            _ => "?".to_owned(),
        }
    }
}

/// Whether a text calls macros by G65, as a Fanuc does.
fn calls_macros(text: &str) -> bool {
    let bytes = text.as_bytes();
    memchr::memchr2_iter(b'G', b'g', bytes).any(|at| bytes[at + 1..].starts_with(b"65"))
}

/// Number of a work offset from its P in `G54.1 P2`, `G154 P2`.
pub(super) fn counted(first: i32, p: f64) -> i32 {
    if p.is_nan() {
        i32::MAX
    } else {
        first.saturating_add((1000.0 * p) as i32)
    }
}
