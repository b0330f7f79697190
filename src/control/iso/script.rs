//! A program as it is read: blocks with resolved jumps, over one arena of expressions.

use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};
use std::num::NonZeroU32;

use rustc_hash::FxBuildHasher;

use crate::geom::Plane;
use crate::text::Text;

/// What controls take as a blank.
pub const BLANKS: [char; 2] = [' ', '\t'];

/// A line that is not understood, or does not work at its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Trouble {
    /// 0-based.
    pub line: usize,
    pub message: Text,
    /// Whether the line itself is understood but does not work at its place.
    pub understood: bool,
}

/// A value, by its place in the list of its script, counted from one: so one that may be missing takes no more room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodeId(NonZeroU32);

impl NodeId {
    /// The value this many places later in the list; past the end it wraps around.
    pub fn shifted(self, by: u32) -> Self {
        NodeId(NonZeroU32::new(self.0.get().wrapping_add(by)).unwrap_or(NonZeroU32::MAX))
    }
}

/// A variable, by its number: the first is 0.
pub type Slot = u32;

/// A number, or how one is computed.
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

/// A binary operator. Truth is 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    /// The angle of the vector (second, first), degrees.
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

/// What the control knows, in the units of the program and the work coordinate system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum System {
    /// Where the ball is, along an axis.
    Place(usize),
    /// Where the ball was at the last trigger, along an axis.
    Trigger(usize),
    /// The same two with the length of the tool along the tool axis.
    PlaceWithLength(usize),
    TriggerWithLength(usize),
    /// The length of the active tool.
    Length,
    /// Whether the last probing move met something: 1 or 0.
    Contact,
    /// Whether the probe is deflected now: 1 or 0.
    Deflected,
    /// Whether the basic system of the control is metric, as the program's units: 1 or 0.
    Metric,
    /// The active code of the units: 21 or 20, as the program's.
    UnitsCode,
    /// A value that is this, for a program that is rightly started.
    Fixed(f64),
    /// A part of a work offset, which a program may write.
    Offset(Part),
}

/// A part of a work offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The number of the offset, 1 = G54, and the axis of its origin.
    Origin(i32, usize),
    /// Its rotation about an axis, degrees: only that about the tool axis can be any.
    Turn(i32, usize),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// 0-based line.
    pub line: usize,
    pub kind: BlockKind,
}

/// What a block says. Targets are places in [`Script::blocks`].
#[derive(Clone, Debug, PartialEq)]
pub enum BlockKind {
    /// Nothing that matters here: a label, a declaration, a wait.
    Nothing,
    /// Modes, and a motion where it has axis words.
    Words(Words),
    Set(Slot, NodeId),
    /// What is the control's own, or not known, gets a value.
    SetOther(Slot, NodeId),
    /// Goes to a place of the machine's own system along these axes.
    Elsewhere([bool; 3]),
    /// A part of a work offset gets a value.
    SetOffset(Part, NodeId),
    /// Continues at this block.
    Jump(usize),
    /// Continues at this block if a value is true.
    JumpIf(NodeId, usize),
    /// Continues at this block if a value is not true.
    JumpUnless(NodeId, usize),
    Call(usize, Vec<NodeId>),
    Return,
    /// Keeps the control from reading on before the motion is done.
    Halt,
    /// A result goes out: its code and its value.
    Output(String, NodeId),
    /// The current place of the ball reads so in a work offset from here on (G10 L20).
    Reading(i32, [Option<NodeId>; 3]),
    /// The origin or the turn of a work offset is set (G10 L2).
    Origin(i32, [Option<NodeId>; 3], Option<NodeId>),
    /// Stops with an alarm; nothing after it runs.
    Alarm,
    /// An alarm that shows, and lets the next blocks run until the end.
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
    /// I, J, K: from where the arc begins to its centre.
    pub center: [Option<NodeId>; 3],
    /// F, in units of the program.
    pub feed: Option<NodeId>,
    pub modes: Modes,
}

/// How a block moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// As fast as the control can.
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
    /// Absolute (true) or incremental places.
    pub absolute: Option<bool>,
    /// Feeds per minute (true), or otherwise: per turn, or as the time of the block.
    pub per_minute: Option<bool>,
    /// Centres of arcs from where the arc begins.
    pub arcs_incremental: Option<bool>,
    /// Whether the spindle turns.
    pub spindle: Option<bool>,
    /// The work offset that is selected, 1 = G54.
    pub offset: Option<i32>,
    /// Whether the length of the tool counts.
    pub length: Option<bool>,
    /// Whether every place is come to, not only near.
    pub exact: Option<bool>,
    /// Whether modes from before the program were given back.
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

    /// These modes after those of a later block.
    pub fn then(self, later: Modes) -> Modes {
        // What was stated before is no longer so.
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
    /// How many variables it names.
    pub slots: usize,
    /// The variables, by their spelled names.
    names: HashMap<Cow<'t, [u8]>, Slot, FxBuildHasher>,
    /// The variables beyond [`USUAL_NAMES`].
    more_names: BTreeMap<Cow<'t, [u8]>, Slot>,
    /// Variables of the line that is being read, by their names.
    pub asked: Vec<(Slot, &'t [u8])>,
    /// Where it takes the ball to be before the start, where it says so, in its units.
    pub start: Option<[f64; 3]>,
    /// Whether the work offsets of its control have no rotation.
    pub straight: bool,
    /// Whether a probing move sees only the edge of the probe's signal: nothing of a probe that is deflected when it begins.
    pub sees_edges: bool,
    /// Whether a probing move that begins in contact is an alarm, also one that needs no contact.
    pub begins_free: bool,
    /// What a variable without a value counts as, where the control keeps its variables from one run to the next; `None` if using one is an error.
    pub vacant: Option<f64>,
    /// Whether ATAN of its control gives 0 to 360 rather than -180 to 180 degrees.
    pub full_circle: bool,
    /// What its control does before the motion is done, if no block halts it.
    pub ahead: Ahead,
    /// The variables that hold results: code and name, from the header.
    pub results: Vec<(&'t str, Slot)>,
}

/// How far a control reads ahead of its motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ahead {
    /// Not past a probing move, and nothing that it reads sooner matters.
    #[default]
    Harmless,
    /// Not past a probing move. An alarm throws away the moves that are not made yet.
    Alarms,
    /// It evaluates places and the probe, where they are read, before the ball is there.
    Reads,
    /// The same, and it writes work offsets and raises alarms before the ball is there.
    ReadsAndActs,
}

/// A control has a few hundred variables, a set-up of fifty cycles three thousand. Names beyond these are looked up in a tree: in a table of hashes,
/// names that were chosen to collide would make it slow.
const USUAL_NAMES: usize = 4000;

impl<'t> Script<'t> {
    /// An empty script with room for a program as long as this text.
    pub fn with_room_for(text: &str) -> Self {
        // A line has about thirty characters, and a value about ten; every other line has a variable of its own. Room for more costs less than growing.
        let lines = text.len() / 24;
        let names = (lines / 2).min(USUAL_NAMES);
        Script {
            blocks: Vec::with_capacity(lines + 16),
            nodes: Vec::with_capacity(text.len() / 8 + 16),
            names: HashMap::with_capacity_and_hasher(names, FxBuildHasher),
            ..Script::default()
        }
    }

    /// The variable of this name, made if it is new.
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

    /// The variable of this name, spelled as below, where there is one.
    pub fn find(&self, name: &[u8]) -> Option<Slot> {
        let known = self.names.get(name).copied();
        // The tree is empty in nearly every program.
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

    /// The number that a value is, where it is one.
    pub fn number(&self, id: NodeId) -> Option<f64> {
        match self.node(id) {
            Node::Number(x) => Some(x),
            _ => None,
        }
    }

    /// Whether a value is true or not true, and no other number.
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

    /// Puts blocks in before the one at `at`; whatever jumps there comes to them first.
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

    /// The results are read at the end, from their variables.
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

    /// The variables whose values go out as results, each with its code.
    pub fn outputs(&self) -> impl Iterator<Item = (&str, Slot)> {
        self.blocks.iter().filter_map(|block| match &block.kind {
            BlockKind::Output(code, value) => match self.node(*value) {
                Node::Slot(slot) => Some((code.as_str(), slot)),
                _ => None,
            },
            _ => None,
        })
    }

    pub fn push(&mut self, line: usize, kind: BlockKind) {
        self.blocks.push(Block { line, kind });
    }
}

/// A name as a control takes it: capitals, blanks and zeros in front of a number make no other variable.
fn spelled(name: &[u8]) -> Cow<'_, [u8]> {
    let hash = name.starts_with(b"#");
    // In one pass: nearly every name is spelled so already.
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

    /// Beyond the usual number names are kept elsewhere, and found all the same.
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
