//! No program leaves without its proof: one of moves is read back and proven equal to its path, and every rule that must hold holds.

use crate::control::prove::{self, Fault, Part, Proof};
use crate::control::safety::{self, Restarts, Verdict};
use crate::control::{Form, Program, Request};

/// A program that may be handed out. There is no way to make one but [`release`].
#[derive(Clone, Debug)]
pub struct Released {
    program: Program,
    proof: Option<Proof>,
    verdicts: Vec<Verdict>,
}

/// Why a program is not handed out. The first two are faults of the writer.
#[derive(Clone, Debug)]
pub enum Refusal {
    /// Read back it is not the path.
    NotProven(Vec<Fault>),
    /// Rules that it must hold, and does not.
    Broken(Vec<Verdict>),
    /// A block is longer than the control reads: so many characters.
    TooLong(usize),
}

impl Released {
    /// The program, what was proven of it (nothing of a native cycle), and what every rule says of it.
    pub fn into_parts(self) -> (Program, Option<Proof>, Vec<Verdict>) {
        (self.program, self.proof, self.verdicts)
    }
}

/// Reads a written program back, proves it, and asks every rule.
pub fn release(request: &Request<'_>, program: Program) -> Result<Released, Refusal> {
    if let Some(most) = program.too_long {
        return Err(Refusal::TooLong(most));
    }
    // What native cycles do is modelled, and not read out of the program.
    if !request.is_followed() {
        return Ok(Released {
            program,
            proof: None,
            verdicts: safety::not_followed(),
        });
    }
    let followed = prove::follow(request, &program.text, Part::Path).map_err(Refusal::NotProven)?;
    let proof = match request.form {
        Form::Moves => Some(
            prove::prove(request, &followed, &program.move_lines).map_err(Refusal::NotProven)?,
        ),
        Form::Cycle => None,
    };
    let verdicts = safety::check(request, &followed, Restarts::Telling);
    let broken: Vec<Verdict> = verdicts
        .iter()
        .filter(|verdict| verdict.refuses())
        .cloned()
        .collect();
    if broken.is_empty() {
        Ok(Released {
            program,
            proof,
            verdicts,
        })
    } else {
        Err(Refusal::Broken(broken))
    }
}
