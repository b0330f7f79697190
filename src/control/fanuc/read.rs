//! Reads Fanuc and Haas programs with G31: the blocks of the writer and similar ones.

use crate::control::iso::codes::Family;
use crate::control::iso::lex::{Comment, program_number};
use crate::control::iso::line_cache::ReaderId;
use crate::control::iso::lines::{self, Blocks};
use crate::control::iso::parse::{
    self, Cursor, Grammar, Names, Parsed, TIGHT_WORD_OPERATORS, fault,
};
use crate::control::iso::script::{
    BlockKind, Locals, LookAhead, Part, ReadError, Script, System, ToolRegister,
};
use crate::control::iso::targets::Targets;
use crate::control::iso::words;
use crate::text::text;

static FANUC: Grammar = Grammar {
    system: of_fanuc,
    ..LIKE_FANUC
};
static HAAS: Grammar = Grammar {
    takes: haas_takes,
    system: of_haas,
    ..LIKE_FANUC
};
const LIKE_FANUC: Grammar = Grammar {
    brackets: (b'[', b']'),
    points: true,
    names: Names::Hash,
    operators: TIGHT_WORD_OPERATORS,
    system,
    family: Family::Iso,
    takes,
};

/// Register of a tool by the number of its variable: the number of a table plus that of the tool. A table has a number of tools.
fn register(number: i32, tables: &[(i32, i32)]) -> Option<System> {
    let of = |(first, count): &(i32, i32)| {
        let tool = number - first;
        let table = *first;
        (1..=*count)
            .contains(&tool)
            .then_some(System::Offset(Part::Tool(ToolRegister { table, tool })))
    };
    tables.iter().find_map(of)
}

/// Tools of a Fanuc: compensation of memory A, wear of lengths and of radii or diameters of memory C.
fn of_fanuc(name: &[u8]) -> Option<System> {
    let tables = [(2000, 200), (10_000, 999), (12_000, 999)];
    system(name).or_else(|| register(parse::whole(name.get(1..)?)?, &tables))
}

/// Tools of a Haas: wear of lengths and of radii or diameters.
fn of_haas(name: &[u8]) -> Option<System> {
    let tables = [(2200, 200), (2600, 200)];
    system(name).or_else(|| register(parse::whole(name.get(1..)?)?, &tables))
}

/// System variables. The length of the active tool is the table entry with its number, #4111.
fn system(name: &[u8]) -> Option<System> {
    match name {
        b"#[2000+#4111]" => return Some(System::Length),
        b"#[2200+#4111]" => return Some(System::Fixed(0.0)),
        _ => {}
    }
    let number = parse::whole(name.get(1..)?)?;
    let origin = |first: i32, offset: i32| {
        let (place, axis) = ((number - first) / 20, (number - first) % 20);
        (axis < 3).then(|| System::Offset(Part::Origin(place + offset, axis as usize)))
    };
    match number {
        5041..=5042 => Some(System::Place(number as usize - 5041)),
        5043 => Some(System::PlaceWithLength(2)),
        5061..=5062 => Some(System::Trigger(number as usize - 5061)),
        5063 => Some(System::TriggerWithLength(2)),
        5083 => Some(System::Length),
        // Length compensation is active; no rotation, no scaling.
        4006 => Some(System::UnitsCode),
        4008 => Some(System::Fixed(43.0)),
        4022 => Some(System::Fixed(50.1)),
        4016 => Some(System::Fixed(69.0)),
        4011 => Some(System::Fixed(50.0)),
        3026 | 4120 => Some(System::Tool),
        4017 => Some(System::Fixed(15.0)),
        // Number of a length that the tables have.
        4111 => Some(System::Fixed(7.0)),
        5221..=5339 => origin(5221, 1),
        // G54.1 P1 to P48 of a Fanuc.
        7001..=7959 => origin(7001, 7),
        14_001..=15_979 => origin(14_001, 7),
        _ => None,
    }
}

fn takes(letter: u8, tenths: i32) -> Option<&'static str> {
    match (letter, tenths) {
        (b'G', 200 | 210 | 310 | 530 | 540 | 550 | 560 | 570 | 580 | 590 | 800) | (b'M', 190) => {
            Some("")
        }
        (b'G', 541) => Some("P"),
        _ => words::common(letter, tenths),
    }
}

/// M78 and M79 in the block of G31; G103 limits the look-ahead.
fn haas_takes(letter: u8, tenths: i32) -> Option<&'static str> {
    match (letter, tenths) {
        (b'M', 780 | 790) => Some(""),
        (b'G', 1030 | 1540) => Some("P"),
        (b'G', 541) => None,
        (b'M', 190) => Some("R"),
        _ => takes(letter, tenths),
    }
}

pub fn fanuc(text: &str) -> Result<Script<'_>, Vec<ReadError>> {
    read(text, ReaderId::Fanuc, &FANUC)
}

pub fn haas(text: &str) -> Result<Script<'_>, Vec<ReadError>> {
    read(text, ReaderId::Haas, &HAAS)
}

struct Program<'g> {
    grammar: &'g Grammar,
    numbered: bool,
}

impl<'t> Blocks<'t> for Program<'_> {
    fn block(
        &mut self,
        script: &mut Script<'t>,
        targets: &mut Targets<'t>,
        line: usize,
        code: &'t str,
        comment: Option<Comment<'t>>,
    ) -> Parsed<()> {
        let results = comment.and_then(|comment| comment.text.strip_prefix("RESULTS: "));
        targets.depends |= results.is_some();
        for (name, code) in results
            .into_iter()
            .flat_map(|list| list.split(", "))
            .filter_map(|entry| entry.split_once(" = "))
        {
            let slot = script.slot(name.as_bytes());
            script.results.push((code, slot));
        }
        if code.is_empty() || code == "%" {
            return Ok(());
        }
        if program_number(code.as_bytes()).is_some() {
            targets.depends = true;
            // The program number comes before its blocks.
            if self.numbered || !script.blocks.is_empty() {
                return fault(text!("another program begins here"));
            }
            self.numbered = true;
            return Ok(());
        }
        block(script, line, code, self.grammar, targets)
    }
}

fn read<'t>(
    text: &'t str,
    hand: ReaderId,
    grammar: &Grammar,
) -> Result<Script<'t>, Vec<ReadError>> {
    let mut script = Script::with_room_for(text);
    script.offsets_lack_rotation = true;
    script.unset_value = Some(0.0);
    script.locals = Locals::Numbers;
    script.ahead = LookAhead::ReadsAndActs;
    // Default of parameter 6004. In the other range no angle exceeds 180, from which a program would subtract a turn.
    script.full_circle = true;
    let mut targets = Targets::default();
    let semicolons = lines::with_semicolons(text);
    let mut program = Program {
        grammar,
        numbered: false,
    };
    let read = lines::lines(text, (hand, b'('), &mut script, &mut targets, &mut program);
    if !semicolons.is_empty() {
        // A line with a semicolon is reported once.
        let mut troubles = semicolons;
        let lines: Vec<usize> = troubles.iter().map(|trouble| trouble.line).collect();
        troubles.extend(
            read.err()
                .into_iter()
                .flatten()
                .filter(|trouble| lines.binary_search(&trouble.line).is_err()),
        );
        return Err(troubles);
    }
    read?;
    targets.resolve(&mut script, false)?;
    script.give_results();
    Ok(script)
}

fn block<'t>(
    script: &mut Script<'t>,
    line: usize,
    code: &'t str,
    grammar: &Grammar,
    targets: &mut Targets<'t>,
) -> Parsed<()> {
    let mut cursor = Cursor::new(code);
    let here = script.blocks.len();
    if cursor.eat("N") {
        targets.definitions.push((
            cursor
                .label()
                .ok_or_else(|| text!("a label without its number"))?,
            here,
        ));
        if cursor.is_done() {
            script.push(line, BlockKind::Nothing);
            return Ok(());
        }
    }
    let what = if cursor.eat("POPEN") || cursor.eat("PCLOS") {
        BlockKind::Nothing
    } else if let Some(printed) = code.strip_prefix("DPRNT[") {
        return printing(script, line, printed);
    } else if cursor.eat("IF") {
        let condition = cursor.bracketed(grammar, script)?;
        if cursor.eat("THEN") {
            script.push(line, BlockKind::JumpUnless(condition, here + 2));
            let name = cursor
                .variable(Names::Hash)
                .ok_or_else(|| text!("a condition without an action"))?;
            assignment(name, &mut cursor, grammar, script)?
        } else {
            cursor.expect("GOTO")?;
            targets.references.push((
                here,
                cursor
                    .label()
                    .ok_or_else(|| text!("a jump without a label"))?,
            ));
            BlockKind::JumpIf(condition, 0)
        }
    } else if cursor.eat("GOTO") {
        targets.references.push((
            here,
            cursor
                .label()
                .ok_or_else(|| text!("a jump without a label"))?,
        ));
        BlockKind::Jump(0)
    } else if let Some(name) = cursor.variable(Names::Hash) {
        assignment(name, &mut cursor, grammar, script)?
    } else {
        let what = words::words(&mut cursor, grammar, script)?;
        script.push(line, what);
        return Ok(());
    };
    cursor.end()?;
    script.push(line, what);
    Ok(())
}

/// Whether a variable belongs to the program: arguments and common variables, those from 10000 on of a Haas. All others act on the control.
fn own(name: &[u8]) -> bool {
    let number = name.get(1..).and_then(parse::whole);
    number.is_some_and(|number| matches!(number, 1..=33 | 100..=199 | 500..=999 | 10_000..=10_999))
}

/// `CENTER*X*#101[53]]`: the printed variable and its number of digits.
fn printing(script: &mut Script<'_>, line: usize, printed: &str) -> Parsed<()> {
    let plain = |c: char| {
        c.is_ascii_uppercase() || c.is_ascii_digit() || matches!(c, '*' | '#' | '[' | ']')
    };
    if !printed.ends_with("]]") || !printed.chars().all(plain) {
        return fault(text!(
            "\"{left}\" is not understood",
            crate::form::printable(printed)
        ));
    }
    script.push(line, BlockKind::Nothing);
    Ok(())
}

/// The part after the name of a variable: its value, or an alarm.
fn assignment<'t>(
    name: &'t [u8],
    cursor: &mut Cursor<'t>,
    grammar: &Grammar,
    script: &mut Script<'t>,
) -> Parsed<BlockKind> {
    cursor.expect("=")?;
    let value = cursor.value(grammar, script)?;
    match (grammar.system)(name) {
        _ if name == b"#3000" && script.number(value).is_some() => Ok(BlockKind::Alarm),
        // A message: the program continues after cycle start.
        _ if name == b"#3006" && script.number(value).is_some() => Ok(BlockKind::Pause),
        None if !own(name) => Ok(BlockKind::SetOther(script.slot(name), value)),
        None => Ok(BlockKind::Set(script.slot(name), value)),
        Some(System::Offset(part)) => Ok(BlockKind::SetOffset(part, value)),
        Some(_) => fault(text!("the control's own values must not be written")),
    }
}
