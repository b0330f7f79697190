//! Reads SINUMERIK programs: the blocks of the writer and similar ones.

use crate::control::iso::codes::Family;
use crate::control::iso::lex::{self, Comment, trimmed};
use crate::control::iso::line_cache::ReaderId;
use crate::control::iso::lines::{self, Blocks};
use crate::control::iso::parse::{Cursor, Grammar, Names, Parsed, SIGN_OPERATORS, fault};
use crate::control::iso::script::{
    Block, BlockKind, Locals, LookAhead, Motion, Part, ReadError, Script, System, ToolRegister,
};
use crate::control::iso::targets::{BackReference, Targets};
use crate::control::iso::words;
use crate::geom::AXIS_NAMES;
use crate::text::text;

static GRAMMAR: Grammar = Grammar {
    brackets: (b'(', b')'),
    points: false,
    names: Names::Words,
    operators: SIGN_OPERATORS,
    system,
    family: Family::Sinumerik,
    takes,
};

fn axis_of(name: &str) -> Option<usize> {
    AXIS_NAMES.iter().position(|axis| *axis == trimmed(name))
}

fn system(name: &[u8]) -> Option<System> {
    if !name.starts_with(b"$") {
        return None;
    }
    let name = std::str::from_utf8(name).ok()?;
    let (head, inner) = match name.split_once('[') {
        Some((head, inner)) => (head, inner.strip_suffix(']')?),
        None => (name, ""),
    };
    Some(match (head, inner) {
        ("$AA_IW", axis) => System::Place(axis_of(axis)?),
        ("$AA_MW", axis) => System::Trigger(axis_of(axis)?),
        ("$AC_MEA", "1" | "2") => System::Contact,
        ("$A_PROBE", "1" | "2") => System::Deflected,
        // A tool offset is active.
        ("$P_TOOL", "") => System::Fixed(1.0),
        ("$P_TOOLNO", "") => System::Tool,
        ("$MN_SCALING_SYSTEM_IS_METRIC", "") => System::Metric,
        // Wear of length 1 and of the radius.
        ("$TC_DP12" | "$TC_DP15", inner) => {
            let (tool, edge) = inner.split_once(',')?;
            let table = if head == "$TC_DP12" { 12 } else { 15 };
            let tool = trimmed(tool).parse().ok()?;
            (trimmed(edge) == "1").then_some(())?;
            System::Offset(Part::Tool(ToolRegister { table, tool }))
        }
        ("$P_UIFR", inner) => {
            let mut parts = inner.split(',');
            let number = trimmed(parts.next()?).parse().ok()?;
            let axis = axis_of(parts.next()?)?;
            match trimmed(parts.next()?) {
                "TR" => System::Offset(Part::Origin(number, axis)),
                "RT" => System::Offset(Part::Turn(number, axis)),
                "FI" => System::Fixed(0.0),
                part => none_of(part)?,
            }
        }
        ("$P_PFRAME" | "$P_TOOLFRAME" | "$P_WPFRAME", inner) => {
            none_of(trimmed(inner.split(',').nth(1)?))?
        }
        _ => return None,
    })
}

/// A part of a frame without effect.
fn none_of(part: &str) -> Option<System> {
    match part {
        "TR" | "RT" | "MI" => Some(System::Fixed(0.0)),
        "SC" => Some(System::Fixed(1.0)),
        _ => None,
    }
}

fn takes(letter: u8, tenths: i32) -> Option<&'static str> {
    match (letter, tenths) {
        (b'G', 540 | 550 | 560 | 570 | 600 | 700 | 710) => Some(""),
        (b'G', 5050..=5990) if tenths % 10 == 0 => Some(""),
        _ => words::common(letter, tenths),
    }
}

/// State of reading a program: whether the program declares each variable.
#[derive(Default)]
struct Program {
    declared: Vec<bool>,
    /// First line about the second probe input.
    second_input: Option<usize>,
}

/// Text about a probe input, without the number.
const INPUTS: [&str; 3] = ["MEAS=", "$AC_MEA[", "$A_PROBE["];

/// Whether a text names a probe input.
fn names_input(text: &str, number: char) -> bool {
    INPUTS.iter().any(|word| {
        text.match_indices(word)
            .any(|(at, _)| text[at + word.len()..].starts_with(number))
    })
}

impl<'t> Blocks<'t> for Program {
    fn block(
        &mut self,
        script: &mut Script<'t>,
        targets: &mut Targets<'t>,
        line: usize,
        code: &'t str,
        comment: Option<Comment<'t>>,
    ) -> Parsed<()> {
        if let Some(list) = comment.and_then(|comment| comment.text.strip_prefix("Results: ")) {
            targets.depends = true;
            results(script, list);
        }
        let code = lex::without_number(code);
        if (code.starts_with("MEAS") || code.contains("$A")) && names_input(code, '2') {
            // A cached line is not seen again.
            targets.depends = true;
            self.second_input.get_or_insert(line);
        }
        // Lines before a program in an archive.
        if code.is_empty() || code.starts_with('%') {
            return Ok(());
        }
        block(script, line, code, targets, &mut self.declared)
    }

    /// A variable that the program has declared belongs to it.
    fn later(
        &mut self,
        script: &mut Script<'t>,
        _: &mut Targets<'t>,
        _: BackReference<'t>,
    ) -> Parsed<()> {
        if let Some(Block { kind, .. }) = script.blocks.last_mut()
            && let BlockKind::SetOther(slot, value) = *kind
            && self.declared.get(slot as usize).is_some_and(|own| *own)
        {
            *kind = BlockKind::Set(slot, value);
        }
        Ok(())
    }
}

pub fn read(text: &str) -> Result<Script<'_>, Vec<ReadError>> {
    let mut script = Script::with_room_for(text);
    script.sees_edges = true;
    script.unset_value = Some(0.0);
    script.locals = Locals::Declared;
    script.ahead = LookAhead::Reads;
    let mut targets = Targets::default();
    let mut program = Program::default();
    lines::lines(
        text,
        (ReaderId::Sinumerik, b';'),
        &mut script,
        &mut targets,
        &mut program,
    )?;
    if let (Some(line), true) = (program.second_input, names_input(text, '1')) {
        return Err(vec![ReadError {
            line,
            message: text!("the program reads both probe inputs"),
            understood: true,
        }]);
    }
    targets.resolve(&mut script, true)?;
    script.give_results();
    // Results of the measuring cycles, whose meaning the cycles define.
    let results = script.slots_like(b"_OVR[").map(|slot| (slot, 0.0));
    script.kept = results.collect();
    Ok(script)
}

/// `R1 = center.x, R2 = center.y`.
fn results<'t>(script: &mut Script<'t>, list: &'t str) {
    for (register, code) in list.split(", ").filter_map(|entry| entry.split_once(" = ")) {
        let slot = script.slot(register.as_bytes());
        script.results.push((code, slot));
    }
}

/// Whether a name is an R parameter, such as `R1`.
fn is_register(name: &[u8]) -> bool {
    name.strip_prefix(b"R")
        .is_some_and(|number| !number.is_empty() && number.iter().all(u8::is_ascii_digit))
}

/// `declared` tells for each variable whether it belongs to the program.
fn block<'t>(
    script: &mut Script<'t>,
    line: usize,
    code: &'t str,
    targets: &mut Targets<'t>,
    declared: &mut Vec<bool>,
) -> Parsed<()> {
    let here = script.blocks.len();
    if let Some(label) = code.strip_suffix(':') {
        if Cursor::new(label).name() != Some(label.as_bytes()) {
            return fault(text!("this is not a label"));
        }
        targets.definitions.push((label.as_bytes(), here));
        script.push(line, BlockKind::Nothing);
        return Ok(());
    }
    let mut cursor = Cursor::new(code);
    let what = if cursor.eat_name("STOPRE") {
        BlockKind::Halt
    } else if cursor.eat_name("TRANS") || cursor.eat_name("DIAMOF") {
        BlockKind::Nothing
    } else if cursor.eat("DEF INT ") {
        let name = cursor
            .name()
            .ok_or_else(|| text!("a declaration without a name"))?;
        let slot = script.slot(name) as usize;
        targets.depends = true;
        declared.resize(declared.len().max(slot + 1), false);
        declared[slot] = true;
        BlockKind::Nothing
    } else if cursor.eat("SPOS=") {
        cursor.number()?;
        BlockKind::Nothing
    } else if cursor.eat("GOTOF ") {
        targets.references.push((
            here,
            cursor
                .name()
                .ok_or_else(|| text!("a jump without a label"))?,
        ));
        BlockKind::Jump(0)
    } else if cursor.eat("IF ") {
        let condition = cursor.value(&GRAMMAR, script)?;
        cursor.expect("GOTOF ")?;
        targets.references.push((
            here,
            cursor
                .name()
                .ok_or_else(|| text!("a jump without a label"))?,
        ));
        BlockKind::JumpIf(condition, 0)
    } else if cursor.eat("MEAS=1 ") || cursor.eat("MEAS=2 ") {
        measured(script, &mut cursor)?
    } else if let Some((name, arguments)) = code
        .split_once('(')
        .filter(|(name, _)| Cursor::new(name).name() == Some(name.as_bytes()))
    {
        return call(script, line, name, arguments);
    } else if !begins_with_code(code) && (code.starts_with(['R', '$', 'T']) || code.contains('=')) {
        assignment(script, code, &mut cursor)?
    } else {
        match words::words(&mut cursor, &GRAMMAR, script)? {
            BlockKind::Words(words)
                if matches!(words.motion, Some(Motion::Clockwise | Motion::Counter)) =>
            {
                return fault(text!("arcs are not understood"));
            }
            what => what,
        }
    };
    cursor.end()?;
    if matches!(what, BlockKind::SetOther(..)) {
        targets.later = Some(BackReference {
            what: 0,
            label: b"",
        });
    }
    script.push(line, what);
    Ok(())
}

/// Whether a block begins with a G code: a word with an equals sign is the position of an axis.
fn begins_with_code(code: &str) -> bool {
    code.strip_prefix('G')
        .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
}

/// The words after `MEAS=1`.
fn measured<'t>(script: &mut Script<'t>, cursor: &mut Cursor<'t>) -> Parsed<BlockKind> {
    match words::words(cursor, &GRAMMAR, script)? {
        BlockKind::Words(mut words) if words.motion == Some(Motion::Straight) => {
            words.motion = Some(Motion::MayTouch);
            Ok(BlockKind::Words(words))
        }
        _ => fault(text!("MEAS=1 belongs in a block with G1")),
    }
}

/// `R1=5`, `TP_MOVE=3`, `$P_UIFR[1,X,TR]=…`.
fn assignment<'t>(
    script: &mut Script<'t>,
    code: &'t str,
    cursor: &mut Cursor<'t>,
) -> Parsed<BlockKind> {
    let name = cursor
        .variable(Names::Words)
        .ok_or_else(|| text!("nothing can be assigned to this"))?;
    if !cursor.eat("=") {
        return fault(text!(
            "\"{left}\" is not understood",
            Cursor::new(code).left()
        ));
    }
    let value = cursor.value(&GRAMMAR, script)?;
    match system(name) {
        // One letter is an axis, or a word with its value; any other name is a system variable.
        None if name.len() == 1 => fault(text!("this is not understood")),
        None => {
            let slot = script.slot(name);
            Ok(if is_register(name) {
                BlockKind::Set(slot, value)
            } else {
                BlockKind::SetOther(slot, value)
            })
        }
        Some(System::Offset(part)) => Ok(BlockKind::SetOffset(part, value)),
        Some(_) => fault(text!("the control's own values must not be written")),
    }
}

/// `MSG(…)`, `SETAL(65000)`, `CYCLE977(…)` and `CYCLE978(…)` with all their arguments. Nothing follows the bracket.
fn call<'t>(script: &mut Script<'t>, line: usize, name: &str, arguments: &'t str) -> Parsed<()> {
    let mut cursor = Cursor::new(arguments);
    let what = match name {
        "MSG" => {
            message(&mut cursor, script)?;
            BlockKind::Nothing
        }
        // Into a file of the control: error variable, file, text.
        "WRITE" => {
            cursor
                .name()
                .ok_or_else(|| text!("nothing can be assigned to this"))?;
            cursor.expect(",")?;
            if !cursor.text() {
                return fault(text!("this call is unknown, or has too many arguments"));
            }
            cursor.expect(",")?;
            message(&mut cursor, script)?;
            BlockKind::Nothing
        }
        // Alarms with other numbers may stop nothing.
        "SETAL" => {
            cursor.expect("65000")?;
            BlockKind::Warned
        }
        "CYCLE977" | "CYCLE978" => {
            let inner = arguments
                .strip_suffix(')')
                .ok_or_else(|| text!("a bracket is not closed"))?;
            let counts = if name == "CYCLE977" { 28..=29 } else { 22..=22 };
            if !counts.contains(&inner.split(',').count()) || inner.contains(['(', ')']) {
                return fault(text!("this call is unknown, or has too many arguments"));
            }
            script.push(line, BlockKind::Native);
            return Ok(());
        }
        _ => {
            return fault(text!("this call is unknown, or has too many arguments"));
        }
    };
    cursor.expect(")")?;
    cursor.end()?;
    script.push(line, what);
    Ok(())
}

/// `"Contact in move "<<TP_MOVE<<", which must be free"`, or nothing.
fn message<'t>(cursor: &mut Cursor<'t>, script: &mut Script<'t>) -> Parsed<()> {
    if cursor.next() == Some(b')') {
        return Ok(());
    }
    loop {
        if !cursor.text() {
            cursor.operand(&GRAMMAR, script)?;
        }
        if !cursor.eat("<<") {
            return Ok(());
        }
    }
}
