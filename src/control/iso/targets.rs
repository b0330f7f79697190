//! What lines say of other lines: jumps and calls by name, and what only the lines before one decide.

use std::collections::BTreeMap;

use crate::control::iso::script::{BlockKind, Script, Trouble};
use crate::text::text;

/// What a line says of lines before it, which it does only where they are known: its kind, by a number of its reader, and a label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Later<'t> {
    pub what: u8,
    pub label: &'t [u8],
}

/// Jumps and calls by name, resolved when everything is read.
#[derive(Debug, Default)]
pub struct Targets<'t> {
    /// Labels and subroutines, each with its index in the blocks.
    pub known: Vec<(&'t [u8], usize)>,
    /// Blocks that jump or call, each with the name it goes to.
    pub wanted: Vec<(usize, &'t [u8])>,
    /// What the line that is being read says of lines before it.
    pub later: Option<Later<'t>>,
    /// Whether that line does something that depends on more than its text: it is not kept.
    pub depends: bool,
    /// Position of the lines, if it changes their meaning: 0 or 1.
    pub place: u8,
}

/// In place of a place: the name is there more than once.
const TWICE: u32 = u32::MAX;

impl Targets<'_> {
    /// Puts the targets in. Each must exist once. `below`: whether it must come after the jump.
    pub fn resolve(&self, script: &mut Script<'_>, below: bool) -> Result<(), Vec<Trouble>> {
        let mut troubles = Vec::new();
        let names: Vec<Vec<u8>> = self
            .known
            .iter()
            .map(|(name, _)| name.to_ascii_lowercase())
            .collect();
        let mut places: BTreeMap<&[u8], u32> = BTreeMap::new();
        for (name, (_, place)) in names.iter().zip(&self.known) {
            places
                .entry(name)
                .and_modify(|known| *known = TWICE)
                .or_insert(*place as u32);
        }
        // Most jumps go where the one before them goes.
        let mut last: Option<(&[u8], Option<&u32>)> = None;
        for (from, name) in &self.wanted {
            let place = match last {
                Some((same, place)) if same == *name => place,
                _ => places.get(name.to_ascii_lowercase().as_slice()),
            };
            last = Some((name, place));
            let message = match place {
                None => text!("the target of this jump does not exist"),
                Some(&TWICE) => text!("the target of this jump exists more than once"),
                Some(&to) if below && to as usize <= *from => {
                    text!("a forward jump whose label is only above it")
                }
                Some(&to) => {
                    match &mut script.blocks[*from].kind {
                        BlockKind::Jump(target)
                        | BlockKind::JumpIf(_, target)
                        | BlockKind::JumpUnless(_, target)
                        | BlockKind::Call(target, _) => {
                            *target = to as usize;
                        }
                        _ => {}
                    }
                    continue;
                }
            };
            troubles.push(Trouble {
                line: script.blocks[*from].line,
                message,
                understood: true,
            });
        }
        if troubles.is_empty() {
            Ok(())
        } else {
            Err(troubles)
        }
    }
}
