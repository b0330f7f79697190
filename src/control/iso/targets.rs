//! References of lines to other lines: jumps and calls by name, and meanings that depend on earlier lines.

use std::collections::BTreeMap;

use crate::control::iso::script::{BlockKind, ReadError, Script};
use crate::text::text;

/// A reference to earlier lines, resolved when they are known: its kind, by a number of its reader, and a label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BackReference<'t> {
    pub what: u8,
    pub label: &'t [u8],
}

/// Jumps and calls by name, resolved after reading.
#[derive(Debug, Default)]
pub struct Targets<'t> {
    /// Labels and subroutines, each with the index of its block.
    pub definitions: Vec<(&'t [u8], usize)>,
    /// Blocks that jump or call, each with its target name.
    pub references: Vec<(usize, &'t [u8])>,
    /// Reference of the current line to earlier lines.
    pub later: Option<BackReference<'t>>,
    /// Whether the current line depends on more than its text, so that it is not cached.
    pub depends: bool,
    /// Position of the lines, if it changes their meaning: 0 or 1.
    pub place: u8,
}

/// Placeholder for a name that is defined more than once.
const AMBIGUOUS: u32 = u32::MAX;

impl Targets<'_> {
    /// Resolves the targets. Each must exist once. `below`: whether it must come after the jump.
    pub fn resolve(&self, script: &mut Script<'_>, below: bool) -> Result<(), Vec<ReadError>> {
        let mut troubles = Vec::new();
        let names: Vec<Vec<u8>> = self
            .definitions
            .iter()
            .map(|(name, _)| name.to_ascii_lowercase())
            .collect();
        let mut places: BTreeMap<&[u8], u32> = BTreeMap::new();
        for (name, (_, place)) in names.iter().zip(&self.definitions) {
            places
                .entry(name)
                .and_modify(|known| *known = AMBIGUOUS)
                .or_insert(*place as u32);
        }
        // Most jumps have the same target as the previous one.
        let mut last: Option<(&[u8], Option<&u32>)> = None;
        for (from, name) in &self.references {
            let place = match last {
                Some((same, place)) if same == *name => place,
                _ => places.get(name.to_ascii_lowercase().as_slice()),
            };
            last = Some((name, place));
            let message = match place {
                None => text!("the target of this jump does not exist"),
                Some(&AMBIGUOUS) => text!("the target of this jump exists more than once"),
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
            troubles.push(ReadError {
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
