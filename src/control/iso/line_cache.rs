//! Cache of lines that were read before. The meaning of a line depends only on its text and its control, until its names are resolved. Nine of ten lines of a
//! program were in an earlier one, so their meaning is stored and copied into the next program with the variables that the names have there.
//!
//! A line is found by its whole text. The cache changes no result: a program is read the same with any cache and with none. The fuzzer checks this.

use std::borrow::Cow;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::hash::Hasher;

use rustc_hash::FxHasher;

use crate::control::iso::script::{Block, BlockKind, Node, NodeId, Script, Slot};
use crate::control::iso::targets::{BackReference, Targets};

/// Reader that a line belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReaderId {
    LinuxCnc,
    Grbl,
    Fanuc,
    Haas,
    Sinumerik,
}

/// Number of stored lines. They form pairs by hash; a pair holds the last two lines that came twice.
const LINES: usize = 16384;

/// Longer lines, and lines with more contents, are never stored. With these limits the cache takes at most twenty megabytes, for real programs a fifth of that.
const LONGEST: usize = 200;
const MOST_NODES: usize = 40;
const MOST_NAMES: usize = 12;

/// Number of known names. Beyond it the cache is cleared.
const MOST_KNOWN: usize = 8000;

/// Placeholder of a variable that this program has not named yet.
const NOT_YET: Slot = Slot::MAX;

thread_local! {
    static CACHE: Cell<Option<Box<LineCache>>> = const { Cell::new(None) };
    static OFF: Cell<bool> = const { Cell::new(false) };
}

/// Runs `work` without the cache: the slow counterpart for comparison.
pub fn without_cache<T>(work: impl FnOnce() -> T) -> T {
    let before = OFF.replace(true);
    let done = work();
    OFF.set(before);
    done
}

/// A part of a line: start and length.
type Part = (u8, u8);

/// Meaning of a line. Values and blocks are counted from its own first ones, and variables are in the order of its names.
#[derive(Clone, Debug)]
struct Line {
    text: Box<str>,
    /// Reader, and the position that the meaning depends on.
    place: (ReaderId, u8),
    begins: bool,
    /// Names with their numbers in the cache.
    names: Box<[(Part, u32)]>,
    nodes: Box<[Node]>,
    blocks: Box<[BlockKind]>,
    /// A label and a jump, each with its block.
    known: Option<(Part, usize)>,
    wanted: Option<(Part, usize)>,
    later: Option<(u8, Part)>,
}

#[derive(Debug)]
pub struct LineCache {
    lines: Vec<Option<Box<Line>>>,
    /// Hashes of lines that came once, in the same pairs. A line is stored when it comes again; most new lines never do.
    once: Vec<u32>,
    names: BTreeMap<Cow<'static, [u8]>, u32>,
    /// Variables of the program that is being read, by the numbers of their names.
    slots: Vec<Slot>,
}

/// Sizes of a script before a line.
#[derive(Clone, Copy, Debug)]
pub struct Checkpoint {
    nodes: usize,
    blocks: usize,
    known: usize,
    wanted: usize,
}

impl Checkpoint {
    pub fn of(script: &mut Script<'_>, targets: &Targets<'_>) -> Self {
        script.asked.clear();
        Checkpoint {
            nodes: script.nodes.len(),
            blocks: script.blocks.len(),
            known: targets.definitions.len(),
            wanted: targets.references.len(),
        }
    }
}

impl LineCache {
    /// The cache of this thread, taken until it is put back. `None` if every line is to be read anew.
    pub fn take() -> Option<Box<Self>> {
        if OFF.get() {
            return None;
        }
        let mut own = CACHE.take().unwrap_or_else(|| Box::new(LineCache::empty()));
        own.slots.fill(NOT_YET);
        Some(own)
    }

    pub fn give_back(own: Option<Box<Self>>) {
        if own.is_some() {
            CACHE.set(own);
        }
    }

    fn empty() -> Self {
        LineCache {
            lines: vec![None; LINES],
            once: vec![0; LINES],
            names: BTreeMap::new(),
            slots: Vec::new(),
        }
    }

    /// Copies the meaning of a line that was read before. Returns whether it was found.
    pub fn put<'t>(
        &mut self,
        (line, text): (usize, &'t str),
        place: (ReaderId, u8),
        script: &mut Script<'t>,
        targets: &mut Targets<'t>,
    ) -> Option<bool> {
        let pair = pair(hashed(text, place)?);
        let is_it = |own: &&Line| *own.text == *text && own.place == place;
        let own = self.lines[pair..pair + 2]
            .iter()
            .filter_map(Option::as_deref)
            .find(is_it)?;
        let part = |(at, length): Part| &text.as_bytes()[usize::from(at)..][..usize::from(length)];
        let mut slots = [0; MOST_NAMES];
        for (slot, (name, number)) in slots.iter_mut().zip(&own.names) {
            let known = &mut self.slots[*number as usize];
            if *known == NOT_YET {
                *known = script.slot(part(*name));
            }
            *slot = *known;
        }
        let slot = |slot: Slot| slots[slot as usize];
        let (first, here) = (script.nodes.len() as u32, script.blocks.len());
        script
            .nodes
            .extend(own.nodes.iter().map(|node| shifted(node, first, &slot)));
        for kind in &own.blocks {
            script.blocks.push(Block {
                line,
                kind: moved(kind, first, here, &slot),
            });
        }
        if let Some((label, block)) = own.known {
            targets.definitions.push((part(label), here + block));
        }
        if let Some((label, block)) = own.wanted {
            targets.references.push((here + block, part(label)));
        }
        targets.later = own.later.map(|(what, label)| BackReference {
            what,
            label: part(label),
        });
        Some(own.begins)
    }

    /// Stores the meaning of a line that came before and is short enough.
    pub fn keep(
        &mut self,
        text: &str,
        (place, begins): ((ReaderId, u8), bool),
        before: Checkpoint,
        script: &Script<'_>,
        targets: &Targets<'_>,
    ) {
        let Some(hash) = hashed(text, place) else {
            return;
        };
        let pair = pair(hash);
        let [first, second] = [self.once[pair], self.once[pair + 1]];
        if first != hash && second != hash {
            (self.once[pair], self.once[pair + 1]) = (hash, first);
        } else if let Some(own) = self.line(text, (place, begins), before, script, targets) {
            self.lines[pair + 1] = self.lines[pair].replace(Box::new(own));
        }
    }

    fn line(
        &mut self,
        text: &str,
        (place, begins): ((ReaderId, u8), bool),
        before: Checkpoint,
        script: &Script<'_>,
        targets: &Targets<'_>,
    ) -> Option<Line> {
        let nodes = &script.nodes[before.nodes..];
        let blocks = &script.blocks[before.blocks..];
        let (known, wanted) = (
            &targets.definitions[before.known..],
            &targets.references[before.wanted..],
        );
        if nodes.len() > MOST_NODES
            || script.asked.len() > MOST_NODES
            || known.len() > 1
            || wanted.len() > 1
        {
            return None;
        }
        // In order of first use; a repeated name is the same variable.
        let mut named: Vec<(Slot, &[u8])> = Vec::new();
        for (slot, name) in &script.asked {
            if !named.iter().any(|(own, _)| own == slot) {
                named.push((*slot, name));
            }
        }
        if named.len() > MOST_NAMES {
            return None;
        }
        if self.names.len() + MOST_NAMES > MOST_KNOWN {
            *self = LineCache::empty();
        }
        let labelled =
            |label: &[u8], block: usize| Some((part_of(text, label)?, block - before.blocks));
        let order = |slot: Slot| {
            named
                .iter()
                .position(|(own, _)| *own == slot)
                .map_or(NOT_YET, |at| at as Slot)
        };
        let (first, here) = (
            (before.nodes as u32).wrapping_neg(),
            before.blocks.wrapping_neg(),
        );
        let own = Line {
            text: text.into(),
            place,
            begins,
            names: named
                .iter()
                .map(|(_, name)| Some((part_of(text, name)?, self.number(name))))
                .collect::<Option<_>>()?,
            nodes: nodes
                .iter()
                .map(|node| shifted(node, first, &order))
                .collect(),
            blocks: blocks
                .iter()
                .map(|block| moved(&block.kind, first, here, &order))
                .collect(),
            known: known.first().map_or(Some(None), |(label, block)| {
                labelled(label, *block).map(Some)
            })?,
            wanted: wanted.first().map_or(Some(None), |(block, label)| {
                labelled(label, *block).map(Some)
            })?,
            later: targets.later.map_or(Some(None), |later| {
                Some(Some((later.what, part_of(text, later.label)?)))
            })?,
        };
        // The stored line must give back the original.
        let slot = |slot: Slot| named.get(slot as usize).map_or(NOT_YET, |(own, _)| *own);
        let (first, here) = (before.nodes as u32, before.blocks);
        let same = own
            .nodes
            .iter()
            .zip(nodes)
            .all(|(kept, node)| shifted(kept, first, &slot) == *node)
            && own
                .blocks
                .iter()
                .zip(blocks)
                .all(|(kept, block)| moved(kept, first, here, &slot) == block.kind);
        same.then_some(own)
    }

    /// Number of a name.
    fn number(&mut self, name: &[u8]) -> u32 {
        if let Some(number) = self.names.get(name) {
            return *number;
        }
        let new = self.names.len() as u32;
        self.names.insert(Cow::Owned(name.to_vec()), new);
        self.slots.push(NOT_YET);
        new
    }
}

/// Hash by which a line is found before it is compared; `None` for a line that is never stored.
fn hashed(text: &str, (reader, more): (ReaderId, u8)) -> Option<u32> {
    if !(1..=LONGEST).contains(&text.len()) {
        return None;
    }
    let mut hasher = FxHasher::default();
    hasher.write(text.as_bytes());
    hasher.write_u8(reader as u8 * 2 + more);
    Some(hasher.finish() as u32)
}

/// Start of the pair of a line.
fn pair(hash: u32) -> usize {
    hash as usize % (LINES / 2) * 2
}

/// Position of a part in its line.
fn part_of(text: &str, part: &[u8]) -> Option<Part> {
    if part.is_empty() {
        return Some((0, 0));
    }
    let at = (part.as_ptr() as usize)
        .checked_sub(text.as_ptr() as usize)
        .filter(|at| *at <= LONGEST)?;
    (text.as_bytes().get(at..at + part.len())? == part).then_some((at as u8, part.len() as u8))
}

/// A value with shifted operands and other variables.
#[inline]
fn shifted(node: &Node, by: u32, slot: &impl Fn(Slot) -> Slot) -> Node {
    match *node {
        Node::Number(_) | Node::System(_) => *node,
        Node::Slot(own) => Node::Slot(slot(own)),
        Node::Unary(unary, inner) => Node::Unary(unary, inner.shifted(by)),
        Node::Binary(binary, left, right) => {
            Node::Binary(binary, left.shifted(by), right.shifted(by))
        }
    }
}

/// A block with shifted values and blocks. A jump without a target has 0 in its place.
fn moved(kind: &BlockKind, by: u32, blocks: usize, slot: &dyn Fn(Slot) -> Slot) -> BlockKind {
    let later = |id: NodeId| id.shifted(by);
    let place = |ids: [Option<NodeId>; 3]| ids.map(|id| id.map(later));
    let target = |target: usize| {
        if target == 0 {
            0
        } else {
            target.wrapping_add(blocks)
        }
    };
    match kind {
        BlockKind::Words(words) => {
            let mut words = words.clone();
            words.to = place(words.to);
            words.center = place(words.center);
            words.feed = words.feed.map(later);
            BlockKind::Words(words)
        }
        BlockKind::Set(own, value) => BlockKind::Set(slot(*own), later(*value)),
        BlockKind::SetOther(own, value) => BlockKind::SetOther(slot(*own), later(*value)),
        BlockKind::SetOffset(part, value) => BlockKind::SetOffset(*part, later(*value)),
        BlockKind::Jump(to) => BlockKind::Jump(target(*to)),
        BlockKind::JumpIf(value, to) => BlockKind::JumpIf(later(*value), target(*to)),
        BlockKind::JumpUnless(value, to) => BlockKind::JumpUnless(later(*value), target(*to)),
        BlockKind::Call(to, values) => {
            BlockKind::Call(target(*to), values.iter().map(|id| later(*id)).collect())
        }
        BlockKind::Output(code, value) => BlockKind::Output(code.clone(), later(*value)),
        BlockKind::Reading(number, to) => BlockKind::Reading(*number, place(*to)),
        BlockKind::Origin(number, to, turn) => {
            BlockKind::Origin(*number, place(*to), turn.map(later))
        }
        BlockKind::Nothing
        | BlockKind::Pause
        | BlockKind::Elsewhere(_)
        | BlockKind::Return
        | BlockKind::Halt
        | BlockKind::Alarm
        | BlockKind::Warned
        | BlockKind::Native
        | BlockKind::End => kind.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::{LINES, LineCache, MOST_KNOWN, without_cache};
    use crate::control::{POSTS, Reader};

    fn reader(post: &str) -> Reader {
        POSTS
            .iter()
            .find(|known| known.key == post)
            .and_then(|known| known.read)
            .unwrap()
    }

    /// Numbers of stored lines and known names. Both are bounded.
    fn kept() -> (usize, usize) {
        let own = LineCache::take();
        let kept = own.as_ref().map_or((0, 0), |own| {
            (own.lines.iter().flatten().count(), own.names.len())
        });
        LineCache::give_back(own);
        assert!(kept.0 <= LINES && kept.1 <= MOST_KNOWN, "{kept:?}");
        kept
    }

    fn forget() {
        LineCache::give_back(Some(Box::new(LineCache::empty())));
    }

    /// Without cache, with lines that came once, and with stored lines: always the same result.
    fn same(post: &str, text: &str) {
        let read = reader(post);
        let anew = without_cache(|| read(text));
        for round in 0..4 {
            assert_eq!(read(text), anew, "{post}, round {round}:\n{text}");
        }
    }

    const LINUXCNC: &str = "(A)\nG21\no<a> sub\nG1 X#1 Y[#2+1] F100\no<a> endsub\n#<x>=[1+#5061]\n#<X>=#<x>\n#3=-[#<y>*2]\n\
        o1 if [#<x> GT 1]\no<a> call [#<x>] [2]\no1 else\nG0 X1 Y2\no1 endif\n(DEBUG,x=#<x>)\n(LOG,a #<x> b=#<z> c)\nG10 L20 P1 X#<x>\nM2\n";
    const SINUMERIK: &str = "; Results: R1 = a\nDEF INT TP_MOVE\nTP_MOVE=1\nTP_OTHER=1\nR1=R2*SIN(R3)\nIF (R1<>0) AND ($AC_MEA[1]==1) GOTOF END\n\
        MEAS=1 G1 X=R1+2 F100\nSTOPRE\nMSG(\"a\"<<R1)\nEND:\nM30\n";
    const FANUC: &str = "%\nO100(A)\n(RESULTS: #101 = a)\n#101=#5061\nIF[#101GT1.]THEN #102=#101\nIF[#102EQ#0]GOTO5\nG31X1.Y#102F100.\n\
        N5#3000=1(A)\nG10L2P1X#101\nM30\n%\n";

    #[test]
    fn a_program_is_read_the_same_from_the_cache() {
        for (post, text) in [
            ("linuxcnc", LINUXCNC),
            ("sinumerik", SINUMERIK),
            ("fanuc", FANUC),
            ("haas", FANUC),
            ("grbl", "G21\nG38.2 Z-1 F100\nG0 X1\n"),
        ] {
            forget();
            same(post, text);
            assert!(kept().0 > 0, "{post}");
            // Lines that depend on earlier ones must do so from the cache as well: without them, reversed, between others, twice.
            let lines: Vec<&str> = text.lines().collect();
            for at in 0..lines.len() {
                same(post, &[&lines[..at], &lines[at + 1..]].concat().join("\n"));
                same(post, &lines[at..].join("\r\n"));
                same(post, &[&lines[at..], &lines[..at]].concat().join("\r"));
                same(post, &[&lines[..=at], &lines[at..]].concat().join("\n"));
            }
            for other in ["linuxcnc", "sinumerik", "fanuc", "haas", "grbl"] {
                same(other, text);
            }
        }
    }

    /// Endless new lines and names: the cache stays bounded and correct.
    #[test]
    fn the_cache_is_bounded() {
        let name = |n: usize| format!("#<n{n}>=[#<m{n}>+{n}]\n");
        for from in 0..4 {
            same(
                "linuxcnc",
                &(0..MOST_KNOWN)
                    .map(|n| name(from * MOST_KNOWN / 2 + n))
                    .collect::<String>(),
            );
            assert!(kept().1 > 0);
        }
        same(
            "linuxcnc",
            &(0..LINES / 4)
                .map(|n| format!("G1 X{n} Y1\n"))
                .collect::<String>(),
        );
        assert!(kept().0 > LINES / 8);
        same(
            "linuxcnc",
            &(0..2 * LINES)
                .map(|n| format!("G1 X{n} Y2\n"))
                .collect::<String>(),
        );
        same("linuxcnc", LINUXCNC);
        let long = format!("#1=[{}1]\n", "1+".repeat(60));
        same("linuxcnc", &long.repeat(3));
    }
}
