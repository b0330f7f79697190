//! Effects of G and M codes: one table for every reader. A reader decides which effects it follows and which codes it accepts.

use crate::control::iso::script::Motion;
use crate::geom::Plane;

/// Families of word-address controls that agree on the meaning of codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// LinuxCNC, grbl, Fanuc, Haas and compatible controls. Where two of them disagree, the axis words are not a position.
    Iso,
    Sinumerik,
    /// DIN/ISO programs of a HEIDENHAIN.
    Heidenhain,
}

/// Frames of a SINUMERIK program: without arguments they end all of them.
pub const FRAMES: [&str; 10] = [
    "ATRANS", "AROTS", "AROT", "ASCALE", "AMIRROR", "TRANS", "ROTS", "ROT", "SCALE", "MIRROR",
];

/// Shift of every work offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shift {
    /// The current position gets the given numbers: G92.
    Position,
    /// By the given values: G52.
    Value,
    /// Ends for good: G92.1.
    End,
    /// Ends until it is restored: G92.2.
    Off,
    /// Restores the shift: G92.3.
    Back,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Effect {
    /// A modal motion.
    Motion(Motion),
    /// A motion of this block only.
    Once(Motion),
    /// Meaning of a contact in the probing move of the block.
    Contact(Motion),
    /// A spline, or an arc without centre and radius; modal or not.
    Curve { stays: bool },
    /// Axis words are control points from here on (true), or positions again (false).
    ControlPoints(bool),
    /// The working plane: G17 to G19.
    Plane(Plane),
    /// Millimetres (true) or inches.
    Metric(bool),
    /// Positions (true) or distances.
    Absolute(bool),
    /// Centres of arcs as positions (true) or counted from the start of the arc.
    CentersAbsolute(bool),
    /// Feeds per minute; otherwise per turn, or as the time of the block.
    PerMinute(bool),
    /// X is a diameter.
    Diameter(bool),
    /// Whether the spindle turns.
    Spindle(bool),
    /// Every position is reached exactly, or only approximately.
    Exact(bool),
    /// Activates or deactivates the tool length.
    Length(bool),
    /// Activates the tool length given in this block (G43.1, G43.2). It may be added to the active one.
    LengthGiven { added: bool },
    /// Saves the modes until they are restored; those of a subprogram (true) at its end.
    Keep { of_subprogram: bool },
    /// Discards the saved modes.
    Forget,
    /// Restores the saved modes.
    GiveBack,
    /// Selects a work offset, 1 = G54.
    Offset(i32),
    /// Selects a work offset by its number P, counted from this one.
    OffsetOf(i32),
    /// Writes settings (G10); L gives the kind.
    Setting,
    /// Dwell; axis words give its time.
    Dwell,
    /// A cycle that runs here and at every later position until it is cancelled.
    Cycle,
    /// Cancels such a cycle.
    CycleEnds,
    /// Transforms later positions: a mirror, a scale, a tilted plane, with its own axis words; or tool radius compensation, which leaves them positions.
    Transform { own_axes: bool },
    /// The axis words are not a position: end of a scale, limits, poles.
    Elsewhere,
    /// A shift of every work offset.
    Shift(Shift),
    /// A rotation about a centre begins (true) or ends.
    Turn(bool),
    /// Positions are polar: distance from a pole and angle (true), or along the axes again.
    Polar(bool),
    /// Positions of the machine coordinate system.
    Machine,
    /// Moves to a position stored in the machine, whether or not axes are named.
    Home,
    /// Moves and returns: rigid tapping.
    ThereAndBack,
    /// Calls a macro whose arguments are all letters but G (true), or a native cycle; the end position is unknown.
    Macro { takes_feed: bool },
    /// Calls a subprogram: 97, 98 or 198.
    Call(u8),
    /// Returns from a subprogram, or to the block with the number P.
    Return,
    /// Ends the program: M2, M30, on a SINUMERIK M17 too.
    End,
    /// Waits for the operator: M0.
    Pause,
    /// Changes the tool.
    Tool,
    /// Stops look-ahead until the motion has ended, or limits it.
    Halt,
    /// Stops look-ahead; the axis words are its own.
    Ahead,
    /// Sets or stores something without a move; the axis words are its own.
    Sets,
    /// Contains the feed of probing moves.
    ProbeFeed,
    /// Nothing that changes the end of a motion.
    Nothing,
}

/// Effect of a code in this family, by ten times its number; `None` if it is unknown.
pub fn effect(family: Family, letter: u8, tenths: i32) -> Option<Effect> {
    match (letter, family) {
        (b'M', _) => auxiliary(family, tenths),
        (_, Family::Heidenhain) => heidenhain(tenths),
        (_, Family::Sinumerik) => sinumerik(tenths).or_else(|| common(tenths)),
        (_, Family::Iso) => iso(tenths).or_else(|| common(tenths)),
    }
}

/// G codes on which ISO and SINUMERIK agree.
fn common(tenths: i32) -> Option<Effect> {
    Some(match tenths {
        0 => Effect::Motion(Motion::Rapid),
        10 => Effect::Motion(Motion::Straight),
        20 => Effect::Motion(Motion::Clockwise),
        30 => Effect::Motion(Motion::Counter),
        40 => Effect::Dwell,
        100 => Effect::Setting,
        170 => Effect::Plane(Plane::G17),
        180 => Effect::Plane(Plane::G18),
        190 => Effect::Plane(Plane::G19),
        382 | 384 => Effect::Motion(Motion::MustTouch),
        383..=389 => Effect::Motion(Motion::MayTouch),
        410 | 420 => Effect::Transform { own_axes: false },
        530 => Effect::Machine,
        540 | 550 | 560 | 570 | 580 | 590 => Effect::Offset(tenths / 10 - 53),
        610 => Effect::Exact(true),
        640 => Effect::Exact(false),
        800 => Effect::CycleEnds,
        900 => Effect::Absolute(true),
        910 => Effect::Absolute(false),
        901 => Effect::CentersAbsolute(true),
        911 => Effect::CentersAbsolute(false),
        930 | 950 => Effect::PerMinute(false),
        940 => Effect::PerMinute(true),
        90 | 400 | 620 | 960 | 970 => Effect::Nothing,
        _ => return None,
    })
}

/// Further G codes of LinuxCNC, grbl, Fanuc and Haas.
fn iso(tenths: i32) -> Option<Effect> {
    Some(match tenths {
        // Also with the number of a signal: G31.1.
        310..=319 => Effect::Once(Motion::MayTouch),
        // A thread is cut along a straight line.
        320 | 330 => Effect::Motion(Motion::Straight),
        331 => Effect::ThereAndBack,
        50 | 51 => Effect::Curve { stays: false },
        52 | 62 => Effect::ControlPoints(true),
        53 | 63 => Effect::ControlPoints(false),
        70 | 80 => Effect::Diameter(tenths == 70),
        200 | 210 => Effect::Metric(tenths == 210),
        430 | 434 | 435 | 440 => Effect::Length(true),
        431 | 432 => Effect::LengthGiven {
            added: tenths == 432,
        },
        490 => Effect::Length(false),
        // On a lathe G50 sets the current position.
        500 | 920 => Effect::Shift(Shift::Position),
        520 => Effect::Shift(Shift::Value),
        921 => Effect::Shift(Shift::End),
        922 => Effect::Shift(Shift::Off),
        923 => Effect::Shift(Shift::Back),
        680 | 690 => Effect::Turn(tenths == 680),
        150 | 160 => Effect::Polar(tenths == 160),
        501 => Effect::Elsewhere,
        // 12.1: polar coordinates of a turned part.
        121 | 510 | 511 | 682..=684 => Effect::Transform { own_axes: true },
        // Fanuc: each axis travels farther or less far by the radius. 112: polar coordinates again, or a work offset of a Haas.
        411 | 421 | 450 | 460 | 470 | 480 | 1120 => Effect::Transform { own_axes: false },
        // A Haas has twenty more, which G154 also counts.
        1100..=1290 if tenths % 10 == 0 => Effect::Offset(tenths / 10 - 103),
        591..=593 => Effect::Offset(tenths - 584),
        541 | 1540 => Effect::OffsetOf(6),
        730 | 740 | 760 | 810..=890 => Effect::Cycle,
        120 | 130 | 750 | 1500 => Effect::Macro { takes_feed: false },
        650 | 660 | 661 => Effect::Macro { takes_feed: true },
        280 | 300 => Effect::Home,
        1030 => Effect::Ahead,
        // Zones, monitoring, and storing of the machine position.
        110 | 220 | 230 | 250 | 260 | 281 | 301 | 1870 => Effect::Sets,
        131 | 401 | 611 | 630 | 670 | 980 | 990 => Effect::Nothing,
        _ => return None,
    })
}

/// Further G codes of a SINUMERIK.
fn sinumerik(tenths: i32) -> Option<Effect> {
    Some(match tenths {
        330 | 340 | 350 | 3310 | 3320 => Effect::Motion(Motion::Straight),
        // A thread with a compensating chuck.
        630 => Effect::Once(Motion::Straight),
        700 | 7000 => Effect::Metric(false),
        710 | 7100 => Effect::Metric(true),
        250 | 260 | 1100 | 1110 | 1120 => Effect::Elsewhere,
        580 | 590 => Effect::Transform { own_axes: true },
        5000 | 5050..=5990 if tenths % 10 == 0 => Effect::Offset(tenths / 10 - 500),
        1530 => Effect::Machine,
        740 | 750 => Effect::Home,
        600 => Effect::Exact(true),
        4500 | 4510 | 6010 | 6020 | 6030 | 6410 | 6420 | 6430 | 6440 | 6450 => Effect::Nothing,
        9610 | 9620 | 9710 | 9720 | 9730 => Effect::Nothing,
        _ => return None,
    })
}

/// G codes of HEIDENHAIN's DIN/ISO, where many have another meaning.
#[cold]
fn heidenhain(tenths: i32) -> Option<Effect> {
    Some(match tenths {
        0 | 10 | 20 | 30 | 40 | 170 | 180 | 190 | 900 | 910 => return common(tenths),
        70 => Effect::Motion(Motion::Straight),
        // Circles without a direction, or tangent to the previous path.
        50 | 60 => Effect::Curve { stays: true },
        400 => Effect::Nothing,
        410 | 420 | 430 | 440 => Effect::Transform { own_axes: false },
        700 | 710 => Effect::Metric(tenths == 710),
        // Corners, the pole, the blank, the next tool, labels, tools.
        240 | 250 | 260 | 270 | 290 | 300 | 310 | 500 | 510 | 980 | 990 => Effect::Elsewhere,
        // The datum shift, as in cycle 7 of Klartext.
        540 => Effect::Shift(Shift::Value),
        // Mirror, datum tables, scale, rotation, tilted plane.
        280 | 530 | 720 | 730 | 800 => Effect::Transform { own_axes: true },
        _ => return None,
    })
}

/// M codes.
fn auxiliary(family: Family, tenths: i32) -> Option<Effect> {
    let sinumerik = family == Family::Sinumerik;
    if tenths % 10 != 0 {
        return None;
    }
    Some(match tenths / 10 {
        2 | 30 => Effect::End,
        17 if sinumerik => Effect::End,
        3 | 4 => Effect::Spindle(true),
        5 => Effect::Spindle(false),
        6 => Effect::Tool,
        66 => Effect::Halt,
        0 => Effect::Pause,
        1..=14 | 19 | 50..=53 | 60..=68 => Effect::Nothing,
        40..=45 if sinumerik => Effect::Nothing,
        70..=73 if sinumerik => Effect::Nothing,
        70 | 73 => Effect::Keep {
            of_subprogram: tenths == 730,
        },
        71 => Effect::Forget,
        72 => Effect::GiveBack,
        78 => Effect::Contact(Motion::MustBeFree),
        79 => Effect::Contact(Motion::MustTouch),
        code @ (97 | 98 | 198) => Effect::Call(code as u8),
        99 if !sinumerik => Effect::Return,
        // Steps, speeds and limits of a printer's axes.
        17 | 18 | 84 | 92 | 201..=208 | 350 | 566 | 851 | 906 => Effect::Sets,
        // The probe feed of RepRapFirmware.
        558 => Effect::ProbeFeed,
        _ => return None,
    })
}
