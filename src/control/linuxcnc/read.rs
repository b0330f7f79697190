//! Reads LinuxCNC programs: the codes and O words of the writer and similar ones.

use crate::control::iso::codes::Family;
use crate::control::iso::lex::{self, Comment, strip_prefix_nocase, trimmed};
use crate::control::iso::line_cache::ReaderId;
use crate::control::iso::lines::{self, Blocks};
use crate::control::iso::parse::{self, Cursor, Grammar, Names, Parsed, WORD_OPERATORS, fault};
use crate::control::iso::script::{
    BlockKind, LookAhead, Node, NodeId, Part, ReadError, Script, System,
};
use crate::control::iso::targets::{BackReference, Targets};
use crate::control::iso::words;
use crate::text::text;

static GRAMMAR: Grammar = Grammar {
    brackets: (b'[', b']'),
    points: false,
    names: Names::Hash,
    operators: WORD_OPERATORS,
    system,
    family: Family::Iso,
    takes,
};

/// M19 orients the spindle to the angle R within the time Q.
fn takes(letter: u8, tenths: i32) -> Option<&'static str> {
    if (letter, tenths) == (b'M', 190) {
        Some("RQ")
    } else {
        words::rs274(letter, tenths)
    }
}

/// `#5061` and related variables. `#<_task>` is 1 if a program runs on the machine, and 0 if it is only drawn. Origin and rotation of the work offsets start at
/// #5220, twenty apart.
fn system(name: &[u8]) -> Option<System> {
    if let [b'#', b'<', name @ ..] = name {
        return match name {
            b"_task>" => Some(System::Fixed(1.0)),
            b"_x>" | b"_X>" => Some(System::Place(0)),
            b"_y>" | b"_Y>" => Some(System::Place(1)),
            b"_z>" | b"_Z>" => Some(System::Place(2)),
            _ => None,
        };
    }
    let number = parse::whole(&name[1..])?;
    match number {
        5061..=5063 => Some(System::Trigger(number as usize - 5061)),
        5070 => Some(System::Contact),
        5400 => Some(System::Tool),
        5220..=5390 => {
            let (offset, place) = ((number - 5201) / 20, (number - 5201) % 20);
            match place {
                0..=2 => Some(System::Offset(Part::Origin(offset, place as usize))),
                9 => Some(System::Offset(Part::Turn(offset, 2))),
                _ => None,
            }
        }
        _ => None,
    }
}

/// Number of arguments of a call that are followed.
const MOST_ARGUMENTS: i32 = 9;

/// Open O words.
enum Open<'t> {
    /// Jump past the subroutine.
    Sub(&'t [u8], usize),
    /// Jump of the `if`, and that of its `else`.
    If(&'t [u8], usize, Option<usize>),
}

/// State of reading a program: the open O words.
#[derive(Default)]
struct Program<'t> {
    open: Vec<Open<'t>>,
}

impl<'t> Blocks<'t> for Program<'t> {
    fn block(
        &mut self,
        script: &mut Script<'t>,
        targets: &mut Targets<'t>,
        line: usize,
        code: &'t str,
        comment: Option<Comment<'t>>,
    ) -> Parsed<()> {
        if let Some(comment) = comment {
            active(script, line, comment)?;
        }
        let in_sub = targets.place == IN_SUB;
        if in_sub
            && (has_own(code)
                || comment.is_some_and(|comment| says_values(comment) && has_own(comment.text)))
        {
            return fault(text!(
                "a subroutine has its own variables: they are not followed"
            ));
        }
        if code.is_empty() || code == "%" {
            return Ok(());
        }
        let code = lex::without_number(code);
        let mut cursor = Cursor::new(code);
        if code.starts_with(['o', 'O']) {
            return o_word(script, line, &mut cursor, targets);
        }
        if let Some(name) = cursor.variable(Names::Hash) {
            cursor.expect("=")?;
            if system(name).is_some() {
                return fault(text!("the control's own parameters must not be written"));
            }
            let value = cursor.value(&GRAMMAR, script)?;
            cursor.end()?;
            let slot = script.slot(name);
            // Variables above 5000 belong to the control; #5599 only tells whether messages are shown. The number in #[…] is known only at run time.
            let own = match parse::whole(&name[1..]) {
                Some(1..=30) if in_sub => {
                    return fault(text!(
                        "a subroutine has its own variables: they are not followed"
                    ));
                }
                Some(number) => number <= 5000 || number == 5599,
                None => name.starts_with(b"#<"),
            };
            script.push(
                line,
                if own {
                    BlockKind::Set(slot, value)
                } else {
                    BlockKind::SetOther(slot, value)
                },
            );
            return Ok(());
        }
        let what = words::words(&mut cursor, &GRAMMAR, script)?;
        script.push(line, what);
        Ok(())
    }

    /// Names of openings and closings for labels.
    fn later(
        &mut self,
        script: &mut Script<'t>,
        targets: &mut Targets<'t>,
        BackReference { what, label }: BackReference<'t>,
    ) -> Parsed<()> {
        let here = script.blocks.len() - 1;
        match what {
            SUB => self.open.push(Open::Sub(label, here)),
            IF => self.open.push(Open::If(label, here, None)),
            ELSE => match self.open.last_mut() {
                Some(Open::If(own, begin, middle @ None)) if *own == label => {
                    jump_to(script, *begin, here + 1);
                    *middle = Some(here);
                }
                _ => return fault(text!("an else without its if")),
            },
            END_SUB => match self.open.pop() {
                Some(Open::Sub(own, begin)) if own == label => jump_to(script, begin, here + 1),
                _ => {
                    targets.place = self.place();
                    return fault(text!("an endsub without its sub"));
                }
            },
            _ => match self.open.pop() {
                Some(Open::If(own, begin, middle)) if own == label => {
                    jump_to(script, middle.unwrap_or(begin), here)
                }
                _ => {
                    targets.place = self.place();
                    return fault(text!("an endif without its if"));
                }
            },
        }
        targets.place = self.place();
        Ok(())
    }
}

impl Program<'_> {
    fn place(&self) -> u8 {
        if self.open.iter().any(|open| matches!(open, Open::Sub(..))) {
            IN_SUB
        } else {
            0
        }
    }
}

/// Position of a line in a subroutine.
const IN_SUB: u8 = 1;

/// Openings and closings.
const SUB: u8 = 0;
const END_SUB: u8 = 1;
const IF: u8 = 2;
const ELSE: u8 = 3;
const END_IF: u8 = 4;

pub fn read(text: &str) -> Result<Script<'_>, Vec<ReadError>> {
    let mut script = Script::with_room_for(text);
    script.ahead = LookAhead::Alarms;
    let mut targets = Targets::default();
    let mut program = Program::default();
    lines::lines(
        text,
        (ReaderId::LinuxCnc, b'('),
        &mut script,
        &mut targets,
        &mut program,
    )?;
    if let Some(Open::Sub(_, begin) | Open::If(_, begin, _)) = program.open.last() {
        let line = script.blocks[*begin].line;
        let message = text!("a subroutine or an if is not closed");
        return Err(vec![ReadError {
            line,
            message,
            understood: true,
        }]);
    }
    targets.resolve(&mut script, false)?;
    Ok(script)
}

/// Whether a text names a variable that belongs to the subroutine: one without _, or a number up to 30 that is not an argument.
fn has_own(text: &str) -> bool {
    text.match_indices('#')
        .any(|(at, _)| match text[at + 1..].strip_prefix('<') {
            Some(name) => !name.starts_with('_'),
            None => {
                let mut cursor = Cursor::new(&text[at + 1..]);
                let number = cursor.label().and_then(parse::whole);
                number.is_some_and(|number| (MOST_ARGUMENTS + 1..=30).contains(&number))
            }
        })
}

/// Whether a comment prints the values of variables.
fn says_values(comment: Comment<'_>) -> bool {
    ["PRINT,", "DEBUG,", "LOG,"]
        .iter()
        .any(|word| strip_prefix_nocase(trimmed(comment.text), word).is_some())
}

/// Comments with an effect: `(PRINT,center.x=#<center_x>)`, `(ABORT,…)`, in small letters as well. After a semicolon the interpreter ignores them, except for
/// Python, which may do anything.
fn active<'t>(script: &mut Script<'t>, line: usize, comment: Comment<'t>) -> Parsed<()> {
    let text = trimmed(comment.text);
    if ["PY,", "PYRUN,", "PYRELOAD"]
        .iter()
        .any(|word| strip_prefix_nocase(text, word).is_some())
    {
        return fault(text!("Python in a comment is not followed"));
    }
    if comment.sign != b'(' {
        return Ok(());
    }
    if let Some(rest) = strip_prefix_nocase(text, "PRINT,") {
        // A text without values is shown without further effect.
        let Some((code, value)) = rest.split_once('=') else {
            return if rest.contains('#') {
                fault(text!("a PRINT without its value"))
            } else {
                Ok(())
            };
        };
        let mut cursor = Cursor::new(value);
        let value = cursor.operand(&GRAMMAR, script)?;
        cursor.end()?;
        script.push(line, BlockKind::Output(code.to_owned(), value));
    } else if let Some(mut rest) = ["DEBUG,", "LOG,"]
        .iter()
        .find_map(|word| strip_prefix_nocase(text, word))
    {
        // A text with another value in it is not a result.
        let mut shown = Vec::new();
        while let Some((code, value)) = rest.split_once('=') {
            let mut cursor = Cursor::new(value);
            let Ok(operand) = cursor.operand(&GRAMMAR, script) else {
                return Ok(());
            };
            shown.push((code.trim_start().to_owned(), operand));
            rest = &value[cursor.at()..];
        }
        if rest.is_empty()
            && (shown.len() == 1 || shown.iter().all(|(code, _)| !code.contains(' ')))
        {
            for (code, operand) in shown {
                script.push(line, BlockKind::Output(code, operand));
            }
        }
    } else if strip_prefix_nocase(text, "ABORT,").is_some() {
        script.push(line, BlockKind::Alarm);
    }
    Ok(())
}

/// `o<name> sub`, `endsub`, `call`; `o1 if`, `else`, `endif`.
fn o_word<'t>(
    script: &mut Script<'t>,
    line: usize,
    cursor: &mut Cursor<'t>,
    targets: &mut Targets<'t>,
) -> Parsed<()> {
    cursor.expect("o")?;
    let label = cursor
        .label()
        .ok_or_else(|| text!("an O word without a name"))?;
    let here = script.blocks.len();
    let word = cursor.name().unwrap_or_default();
    let known = ["sub", "endsub", "call", "if", "else", "endif"]
        .into_iter()
        .find(|known| word.eq_ignore_ascii_case(known.as_bytes()));
    let (block, later) = match known.unwrap_or_default() {
        "sub" => {
            targets.definitions.push((label, here + 1));
            // The main program passes the subroutine.
            (BlockKind::Jump(0), Some(SUB))
        }
        "endsub" => (BlockKind::Return, Some(END_SUB)),
        "call" => {
            let arguments = arguments(script, cursor)?;
            targets.references.push((here, label));
            (BlockKind::Call(0, arguments), None)
        }
        "if" => (
            BlockKind::JumpUnless(cursor.bracketed(&GRAMMAR, script)?, 0),
            Some(IF),
        ),
        "else" => (BlockKind::Jump(0), Some(ELSE)),
        "endif" => (BlockKind::Nothing, Some(END_IF)),
        _ => return fault(text!("this O word is not understood")),
    };
    script.push(line, block);
    targets.later = later.map(|what| BackReference { what, label });
    cursor.end()
}

/// Arguments of a call. Missing ones are 0 in the subroutine.
fn arguments<'t>(script: &mut Script<'t>, cursor: &mut Cursor<'t>) -> Parsed<Vec<NodeId>> {
    let mut arguments = Vec::new();
    while !cursor.is_done() {
        arguments.push(cursor.bracketed(&GRAMMAR, script)?);
    }
    while arguments.len() < MOST_ARGUMENTS as usize {
        arguments.push(script.keep(Node::Number(0.0)));
    }
    Ok(arguments)
}

fn jump_to(script: &mut Script<'_>, from: usize, to: usize) {
    if let BlockKind::Jump(target) | BlockKind::JumpUnless(_, target) =
        &mut script.blocks[from].kind
    {
        *target = to;
    }
}
