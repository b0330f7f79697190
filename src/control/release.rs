//! Releases programs: a program of moves must be proven equal to its path, and every mandatory safety rule must hold.

use crate::control::prove::{self, Fault, Part, Proof};
use crate::control::safety::{self, RestartPoints, Verdict};
use crate::control::{Program, ProgramForm, Request, shop};

/// A program that may be handed out. Only [`release`] creates one.
#[derive(Clone, Debug)]
pub struct Released {
    program: Program,
    proof: Option<Proof>,
    verdicts: Vec<Verdict>,
}

/// Reason why a program is not handed out. The first two are faults of the writer.
#[derive(Clone, Debug)]
pub enum Refusal {
    /// Read back, it is not the path.
    NotProven(Vec<Fault>),
    /// It breaks mandatory rules.
    Broken(Vec<Verdict>),
    /// A block is longer than the control reads; the longest allowed length.
    TooLong(usize),
}

impl Released {
    /// The program, its proof (`None` for native cycles that are not traced), and the verdict of every rule.
    pub fn into_parts(self) -> (Program, Option<Proof>, Vec<Verdict>) {
        (self.program, self.proof, self.verdicts)
    }
}

/// Reads a written program back, proves it, and checks every rule.
pub fn release(request: &Request<'_>, program: Program) -> Result<Released, Refusal> {
    if let Some(most) = program.too_long {
        return Err(Refusal::TooLong(most));
    }
    // Native cycles are simulated, not read from the program.
    if !request.is_followed() {
        return Ok(Released {
            program,
            proof: None,
            verdicts: safety::not_followed(),
        });
    }
    let text = shop::without_lines(request, &program.text);
    let followed = prove::read_and_trace(request, &text, Part::Path).map_err(Refusal::NotProven)?;
    let proof = match request.form {
        ProgramForm::Moves => Some(
            prove::prove(request, &followed, &program.move_lines).map_err(Refusal::NotProven)?,
        ),
        ProgramForm::Cycle => None,
    };
    let verdicts = safety::check(request, &followed, RestartPoints::Critical);
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
