//! A program after reading: blocks with resolved jumps, over one arena of expressions.

use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};
use std::num::NonZeroU32;

use rustc_hash::FxBuildHasher;

use crate::geom::Plane;
use crate::text::Text;

/// Blanks of a control.
pub const BLANKS: [char; 2] = [' ', '\t'];

/// A line that is not understood, or is invalid at its position.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// 0-based.
    pub line: usize,
    pub message: Text,
    /// Whether the line itself is understood but invalid at its position.
    pub understood: bool,
}

/// A value, by its index in the script's list, counted from one: so an optional one takes no more memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodeId(NonZeroU32);

impl NodeId {
    /// The value this many indices later; past the end it wraps around.
    pub fn shifted(self, by: u32) -> Self {
        NodeId(NonZeroU32::new(self.0.get().wrapping_add(by)).unwrap_or(NonZeroU32::MAX))
    }
}

/// A variable, by its number from 0.
pub type Slot = u32;

/// A number or an operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Node {
    Number(f64),
    Slot(Slot),
    System(System),
    Unary(Unary, NodeId),
    Binary(Binary, NodeId, NodeId),
}

/// A function of one value. Angles are in degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unary {
    Minus,
    Abs,
    Sin,
    Cos,
    Sqrt,
}

/// A binary operator. True is 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    /// Angle of the vector (second, first), degrees.
    Atan,
    Equal,
    Unequal,
    Less,
    AtMost,
    Greater,
    AtLeast,
    And,
    Or,
}

/// A system variable, in the units of the program and the work coordinate system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum System {
    /// Ball centre along an axis.
    Place(usize),
    /// Ball centre at the last trigger, along an axis.
    Trigger(usize),
    /// These two including the tool length along the tool axis.
    PlaceWithLength(usize),
    TriggerWithLength(usize),
    /// Length of the active tool.
    Length,
    /// Whether the last probing move had a contact: 1 or 0.
    Contact,
    /// Whether the probe is deflected: 1 or 0.
    Deflected,
    /// Whether the basic system of the control is metric, like the program's units: 1 or 0.
    Metric,
    /// Active code of the units: 21 or 20, as in the program.
    UnitsCode,
    /// Number of the tool in the spindle: the one that the program states, for a program that is started correctly.
    Tool,
    /// A fixed value, for a program that is started correctly.
    Fixed(f64),
    /// A part of a work offset or of a tool that a program may write.
    Offset(Part),
}

/// A part of a work offset, or of a tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Number of the offset, 1 = G54, and axis of its origin.
    Origin(i32, usize),
    /// Rotation about an axis, degrees; only that about the tool axis may have any value.
    Turn(i32, usize),
    /// Wear of a tool.
    Tool(ToolRegister),
}

/// Register of a tool: the control's number of the table, and that of the tool in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ToolRegister {
    pub table: i32,
    pub tool: i32,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// 0-based line.
    pub line: usize,
    pub kind: BlockKind,
}

/// Contents of a block. Targets are indices into [`Script::blocks`].
#[derive(Clone, Debug, PartialEq)]
pub enum BlockKind {
    /// Nothing relevant: a label, a declaration, a dwell.
    Nothing,
    /// Waits for the operator.
    Pause,
    /// Modes, and a motion if there are axis words.
    Words(Words),
    Set(Slot, NodeId),
    /// Sets a system variable or an unknown one.
    SetOther(Slot, NodeId),
    /// Moves to machine coordinates along these axes.
    Elsewhere([bool; 3]),
    /// Sets a part of a work offset or of a tool.
    SetOffset(Part, NodeId),
    /// Continues at this block.
    Jump(usize),
    /// Continues at this block if a value is true.
    JumpIf(NodeId, usize),
    /// Continues at this block if a value is not true.
    JumpUnless(NodeId, usize),
    Call(usize, Vec<NodeId>),
    Return,
    /// Stops look-ahead until the motion has ended.
    Halt,
    /// Reports a result: code and value.
    Output(String, NodeId),
    /// The current ball centre gets this reading in a work offset (G10 L20).
    Reading(i32, [Option<NodeId>; 3]),
    /// Sets origin or rotation of a work offset (G10 L2).
    Origin(i32, [Option<NodeId>; 3], Option<NodeId>),
    /// Stops with an alarm; nothing after it runs.
    Alarm,
    /// Shows an alarm and continues until the end.
    Warned,
    /// A native cycle.
    Native,
    End,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Words {
    pub motion: Option<Motion>,
    /// X, Y, Z.
    pub to: [Option<NodeId>; 3],
    /// I, J, K: from the start of the arc to its centre.
    pub center: [Option<NodeId>; 3],
    /// F, in units of the program.
    pub feed: Option<NodeId>,
    pub modes: Modes,
}

/// Motion of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// At the rapid rate.
    Rapid,
    /// Straight at the feed.
    Straight,
    Clockwise,
    /// Counter-clockwise, seen against the axis of the plane.
    Counter,
    /// Straight until a contact; a miss is an alarm of the control.
    MustTouch,
    /// Straight until a contact, or to the end.
    MayTouch,
    /// Straight; a contact is an alarm of the control.
    MustBeFree,
}

impl Motion {
    /// Whether it watches for a contact.
    pub fn probes(self) -> bool {
        matches!(
            self,
            Motion::MustTouch | Motion::MayTouch | Motion::MustBeFree
        )
    }
}

/// Modes that a block states.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Modes {
    /// Millimetres (true) or inches.
    pub metric: Option<bool>,
    pub plane: Option<Plane>,
    /// Absolute (true) or incremental positions.
    pub absolute: Option<bool>,
    /// Feeds per minute (true); otherwise per turn, or as the time of the block.
    pub per_minute: Option<bool>,
    /// Centres of arcs counted from the start of the arc.
    pub arcs_incremental: Option<bool>,
    /// Whether the spindle turns.
    pub spindle: Option<bool>,
    /// Selected work offset, 1 = G54.
    pub offset: Option<i32>,
    /// Whether the tool length is active.
    pub length: Option<bool>,
    /// Whether every position is reached exactly.
    pub exact: Option<bool>,
    /// Whether modes from before the program were restored.
    pub restored: Option<bool>,
}

impl Modes {
    pub const NONE: Modes = Modes {
        metric: None,
        plane: None,
        absolute: None,
        per_minute: None,
        arcs_incremental: None,
        spindle: None,
        offset: None,
        length: None,
        exact: None,
        restored: None,
    };

    /// The modes after those of a later block.
    pub fn then(self, later: Modes) -> Modes {
        // Earlier modes are no longer valid.
        let before = if later.restored == Some(true) {
            Modes::NONE
        } else {
            self
        };
        before.with(later)
    }

    fn with(self, later: Modes) -> Modes {
        Modes {
            metric: later.metric.or(self.metric),
            plane: later.plane.or(self.plane),
            absolute: later.absolute.or(self.absolute),
            per_minute: later.per_minute.or(self.per_minute),
            arcs_incremental: later.arcs_incremental.or(self.arcs_incremental),
            spindle: later.spindle.or(self.spindle),
            offset: later.offset.or(self.offset),
            length: later.length.or(self.length),
            exact: later.exact.or(self.exact),
            restored: later.restored.or(self.restored),
        }
    }
}

/// A program that was read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Script<'t> {
    pub blocks: Vec<Block>,
    pub nodes: Vec<Node>,
    /// Number of variables.
    pub slots: usize,
    /// Variables by their normalised names.
    names: HashMap<Cow<'t, [u8]>, Slot, FxBuildHasher>,
    /// Variables beyond [`USUAL_NAMES`].
    more_names: BTreeMap<Cow<'t, [u8]>, Slot>,
    /// Variables of the current line, by their names.
    pub asked: Vec<(Slot, &'t [u8])>,
    /// Start of the ball that the program assumes, in its units, if it states one.
    pub start: Option<[f64; 3]>,
    /// Number of the tool in the spindle that the program assumes, if it states one.
    pub tool: Option<f64>,
    /// Whether the work offsets of its control have no rotation.
    pub offsets_lack_rotation: bool,
    /// Whether a probing move sees only the edge of the signal, not a probe that is deflected at its start.
    pub sees_edges: bool,
    /// Whether a probing move that begins in contact is an alarm, even if it needs no contact.
    pub begins_free: bool,
    /// Variables that a reset clears.
    pub locals: Locals,
    /// Value of an unset variable, if the control keeps variables from one run to the next; `None` if its use is an error.
    pub unset_value: Option<f64>,
    /// Whether ATAN of its control gives 0 to 360 instead of −180 to 180 degrees.
    pub full_circle: bool,
    /// Effects of its control before a motion has ended, without a halting block.
    pub ahead: LookAhead,
    /// Variables with results: code and name, from the header.
    pub results: Vec<(&'t str, Slot)>,
    /// Variables with values from earlier runs.
    pub kept: Vec<(Slot, f64)>,
    /// Values that each native cycle gives to its variables, in the order of the calls.
    pub measured: Vec<Vec<(Slot, f64)>>,
}

/// Variables that a reset clears, recalled [R] for all of these.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Locals {
    /// None that a program of this control uses.
    #[default]
    None,
    /// #1 to #33 of a Fanuc or Haas, if its parameter does not keep them.
    Numbers,
    /// Declared variables of a SINUMERIK: those that are no R parameters.
    Declared,
}

impl Locals {
    fn has(self, name: &[u8]) -> bool {
        let digits = |from: usize| name[from..].iter().all(u8::is_ascii_digit);
        match self {
            Locals::None => false,
            Locals::Numbers => name.starts_with(b"#") && name.len() <= 3 && digits(1),
            Locals::Declared => !(name.starts_with(b"R") && digits(1)),
        }
    }
}

/// Look-ahead of a control.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LookAhead {
    /// Not past a probing move, and nothing that it reads early matters.
    #[default]
    Harmless,
    /// Not past a probing move. An alarm discards the moves that are not made yet.
    Alarms,
    /// Evaluates positions and the probe, where they are read, before the ball has arrived.
    Reads,
    /// Evaluates positions and the probe, writes work offsets and raises alarms before the ball has arrived.
    ReadsAndActs,
}

/// Number of names in the hash table. A control has a few hundred variables, a set-up of fifty cycles three thousand. Further names are in a tree: names chosen
/// to collide would make a hash table slow.
const USUAL_NAMES: usize = 4000;

impl<'t> Script<'t> {
    /// An empty script with capacity for a program as long as this text.
    pub fn with_room_for(text: &str) -> Self {
        // A line has about thirty characters, and a value about ten; every other line has its own variable. Too much capacity costs less than growing.
        let lines = text.len() / 24;
        let names = (lines / 2).min(USUAL_NAMES);
        Script {
            blocks: Vec::with_capacity(lines + 16),
            nodes: Vec::with_capacity(text.len() / 8 + 16),
            names: HashMap::with_capacity_and_hasher(names, FxBuildHasher),
            ..Script::default()
        }
    }

    /// The variable with this name; created if it is new.
    pub fn slot(&mut self, name: &'t [u8]) -> Slot {
        let slot = self.spelled(spelled(name));
        self.asked.push((slot, name));
        slot
    }

    fn spelled(&mut self, name: Cow<'t, [u8]>) -> Slot {
        let new = self.slots as Slot;
        let slot = if self.names.len() < USUAL_NAMES {
            *self.names.entry(name).or_insert(new)
        } else if let Some(slot) = self.names.get(&name) {
            *slot
        } else {
            *self.more_names.entry(name).or_insert(new)
        };
        self.slots += usize::from(slot == new);
        slot
    }

    /// The variable with this name in normalised spelling, if there is one.
    pub fn find(&self, name: &[u8]) -> Option<Slot> {
        let known = self.names.get(name).copied();
        // The tree is empty in almost every program.
        if known.is_some() || self.more_names.is_empty() {
            known
        } else {
            self.more_names.get(name).copied()
        }
    }

    pub fn keep(&mut self, node: Node) -> NodeId {
        self.nodes.push(node);
        NodeId(NonZeroU32::new(self.nodes.len() as u32).unwrap_or(NonZeroU32::MAX))
    }

    pub fn node(&self, id: NodeId) -> Node {
        self.nodes[id.0.get() as usize - 1]
    }

    /// The number of a value, if it is one.
    pub fn number(&self, id: NodeId) -> Option<f64> {
        match self.node(id) {
            Node::Number(x) => Some(x),
            _ => None,
        }
    }

    /// Whether a value is a condition: 1 or 0, and no other number.
    pub fn is_condition(&self, id: NodeId) -> bool {
        match self.node(id) {
            Node::Binary(binary, ..) => match binary {
                Binary::Add
                | Binary::Subtract
                | Binary::Multiply
                | Binary::Divide
                | Binary::Atan => false,
                Binary::Equal
                | Binary::Unequal
                | Binary::Less
                | Binary::AtMost
                | Binary::Greater
                | Binary::AtLeast => true,
                Binary::And | Binary::Or => true,
            },
            Node::Number(_) | Node::Slot(_) | Node::System(_) | Node::Unary(..) => false,
        }
    }

    /// Inserts blocks before the one at `at`; jumps to that block come to them first.
    pub fn insert(&mut self, at: usize, line: usize, blocks: Vec<BlockKind>) {
        let more = blocks.len();
        for block in &mut self.blocks {
            match &mut block.kind {
                BlockKind::Jump(target)
                | BlockKind::JumpIf(_, target)
                | BlockKind::JumpUnless(_, target)
                | BlockKind::Call(target, _)
                    if *target > at =>
                {
                    *target += more;
                }
                _ => {}
            }
        }
        self.blocks
            .splice(at..at, blocks.into_iter().map(|kind| Block { line, kind }));
    }

    /// Reports the results at the end, from their variables.
    pub fn give_results(&mut self) {
        let end = self
            .blocks
            .iter()
            .position(|block| matches!(block.kind, BlockKind::End))
            .unwrap_or(self.blocks.len());
        let line = self.blocks.get(end).map_or(0, |block| block.line);
        let results = std::mem::take(&mut self.results);
        let outputs = results
            .into_iter()
            .map(|(code, slot)| BlockKind::Output(code.to_owned(), self.keep(Node::Slot(slot))))
            .collect();
        self.insert(end, line, outputs);
    }

    /// Variables that are reported as results, each with its code.
    pub fn outputs(&self) -> impl Iterator<Item = (&str, Slot)> {
        self.blocks.iter().filter_map(|block| match &block.kind {
            BlockKind::Output(code, value) => match self.node(*value) {
                Node::Slot(slot) => Some((code.as_str(), slot)),
                _ => None,
            },
            _ => None,
        })
    }

    /// Variables that a reset clears.
    pub fn local_slots(&self) -> impl Iterator<Item = Slot> {
        let names = self.names.iter().chain(&self.more_names);
        names
            .filter(|(name, _)| self.locals.has(name))
            .map(|(_, slot)| *slot)
    }

    /// Variables whose names begin like this.
    pub fn slots_like<'s>(&'s self, start: &'s [u8]) -> impl Iterator<Item = Slot> + 's {
        let names = self.names.iter().chain(&self.more_names);
        names
            .filter(move |(name, _)| name.starts_with(start))
            .map(|(_, slot)| *slot)
    }

    pub fn push(&mut self, line: usize, kind: BlockKind) {
        self.blocks.push(Block { line, kind });
    }
}

/// Normalised name: capitals, blanks and leading zeros make no difference on a control.
fn spelled(name: &[u8]) -> Cow<'_, [u8]> {
    let hash = name.starts_with(b"#");
    // In one pass: almost every name is already normalised.
    let none = |name: &[u8], letters: std::ops::RangeInclusive<u8>| {
        name.iter()
            .all(|b| !(letters.contains(b) || b.is_ascii_whitespace()))
    };
    let plain = match name {
        [b'#', b'[', ..] => true,
        [b'#', b'<', rest @ ..] => none(rest, b'A'..=b'Z'),
        [b'#', ..] => !name[1..].starts_with(b"0"),
        [b'R' | b'r', b'0', _, ..] => false,
        _ => none(name, b'a'..=b'z'),
    };
    if plain {
        return Cow::Borrowed(name);
    }
    let same = |b: &u8| {
        if hash {
            b.to_ascii_lowercase()
        } else {
            b.to_ascii_uppercase()
        }
    };
    let mut spelled: Vec<u8> = name
        .iter()
        .filter(|b| !b.is_ascii_whitespace())
        .map(same)
        .collect();
    if let [b'#' | b'R', number @ .., last] = spelled.as_slice()
        && number.iter().chain([last]).all(u8::is_ascii_digit)
    {
        let zeros = number.iter().take_while(|b| **b == b'0').count();
        spelled.drain(1..=zeros);
    }
    Cow::Owned(spelled)
}

#[cfg(test)]
mod tests {
    use super::{Script, USUAL_NAMES, spelled};

    #[test]
    fn a_name_is_spelled_as_a_control_takes_it() {
        for (name, wanted) in [
            ("#<Center _X>", "#<center_x>"),
            ("#<a>", "#<a>"),
            ("#05", "#5"),
            ("#00", "#0"),
            ("#0", "#0"),
            ("#100", "#100"),
            ("R010", "R10"),
            ("r0", "R0"),
            ("R0X", "R0X"),
            ("tp_move", "TP_MOVE"),
            ("#[A+1]", "#[A+1]"),
            ("A01", "A01"),
            ("", ""),
            (" ", ""),
        ] {
            assert_eq!(spelled(name.as_bytes()), wanted.as_bytes(), "{name}");
        }
    }

    /// Names beyond the usual number are stored elsewhere and still found.
    #[test]
    fn every_name_is_one_variable() {
        let names: Vec<String> = (0..3 * USUAL_NAMES).map(|n| format!("#<v{n}>")).collect();
        let mut script = Script::with_room_for("");
        let slots: Vec<_> = names
            .iter()
            .map(|name| script.slot(name.as_bytes()))
            .collect();
        assert!(
            slots
                .iter()
                .enumerate()
                .all(|(n, slot)| *slot as usize == n),
            "each is a new one"
        );
        for (name, slot) in names.iter().zip(slots).rev() {
            assert_eq!(script.slot(name.as_bytes()), slot, "{name}");
            assert_eq!(script.find(name.as_bytes()), Some(slot), "{name}");
        }
        assert_eq!(script.slots, names.len());
        assert_eq!(script.find(b"#<w>"), None);
    }
}
