//! The shop's lines in a HEIDENHAIN program.

use super::state::{
    Coordinates, Judged, State, assigns, decides, moves_otherwise, spindle, transforms, writes,
};
use crate::control::heidenhain::read::{moves, transforms as changes};
use crate::geom::AXIS_NAMES;

/// Judges a line of Klartext.
pub fn judge(state: &mut State<'_>, line: &str) -> Judged {
    let capitals = line.to_ascii_uppercase();
    let code = capitals.split(';').next().unwrap_or_default();
    let words: Vec<&str> = code.split_whitespace().collect();
    match words[..] {
        [] => Ok(true),
        ["TOOL", "CALL", ref rest @ ..] => tool_call(state, rest),
        ["STOP", ref rest @ ..] => codes(state, rest),
        ["*", ..] => Ok(true),
        ["L", ref rest @ ..] => straight(state, rest),
        ["CALL", "LBL", ..] | ["LBL" | "IF" | "BEGIN" | "END" | "/", ..] => Err(decides()),
        ["CYCL", "DEF", "247", ..] | ["PRESET", "SELECT", ..] => {
            state.offset()?;
            Ok(false)
        }
        ["TCH", ..] => Err(moves_otherwise()),
        [first, ..] if first.starts_with("FN") => assignment(code),
        [first, ..] if first.starts_with('Q') || code.contains('=') => Err(assigns()),
        [first, ..] if first.starts_with(|c: char| c.is_ascii_digit() || c == '/') => {
            Err(decides())
        }
        _ if words.iter().all(|word| word.starts_with('M')) => codes(state, &words),
        ["CALL", ..] => Ok(false),
        _ if changes(&words).is_some_and(|(_, begins)| begins) => Err(transforms()),
        _ if moves(&words) => Err(moves_otherwise()),
        _ => Ok(false),
    }
}

/// `FN 9: IF …`, with or without a blank.
fn assignment(code: &str) -> Judged {
    let number = code.trim_start()["FN".len()..].trim_start();
    let length = number.bytes().take_while(u8::is_ascii_digit).count();
    match &number[..length] {
        "14" | "16" | "19" | "20" => Ok(false),
        "9" | "10" | "11" | "12" => Err(decides()),
        "17" => Err(writes()),
        _ => Err(assigns()),
    }
}

/// `7 Z S50`: a known tool without corrections of its length or radius.
fn tool_call(state: &mut State<'_>, words: &[&str]) -> Judged {
    let tool = words.first().and_then(|word| crate::num::read(word));
    state.tool(tool)?;
    let axis = AXIS_NAMES[state.request.plane.axes()[2]];
    if words
        .iter()
        .any(|word| AXIS_NAMES.contains(word) && *word != axis)
    {
        return Err(transforms());
    }
    if words
        .iter()
        .any(|word| word.starts_with("DL") || word.starts_with("DR"))
    {
        return Err(writes());
    }
    let is_known = |word: &&str| **word == *axis || word.starts_with(['S', 'F']);
    Ok(tool.is_some() && words.iter().skip(1).all(is_known))
}

/// `L Z-1 R0 FMAX M91`
fn straight(state: &mut State<'_>, words: &[&str]) -> Judged {
    let mut axes = [None; 3];
    let (mut incremental, mut known) = (false, true);
    let mut coordinates = Coordinates::Work;
    let mut other: Vec<&str> = Vec::new();
    let mut words = words.iter().copied();
    while let Some(word) = words.next() {
        let (own, is_incremental) = match word.strip_prefix('I') {
            Some(own) => (own, true),
            None => (word, false),
        };
        let axis = own
            .bytes()
            .next()
            .filter(|axis| (b'X'..=b'Z').contains(axis));
        if let Some(axis) = axis {
            let number = crate::num::read(&own[1..].replace(',', "."));
            axes[usize::from(axis - b'X')] = Some(number.unwrap_or(f64::NAN));
            incremental |= is_incremental;
        } else if word == "M91" || word == "M92" {
            coordinates = Coordinates::Machine;
            // The machine builder's datum need not be the top.
            known &= word == "M91";
        } else if word == "M140" {
            // `M140 MB MAX` retracts along the tool axis.
            known &=
                words.next() == Some("MB") && words.next() == Some("MAX") && state.retracts()?;
        } else if word.starts_with('M') {
            other.push(word);
        } else {
            known &= word == "R0" || word.starts_with('F');
            state.may_move()?;
        }
    }
    known &= codes(state, &other)?;
    if axes != [None; 3] {
        known &= state.moves(axes, incremental, coordinates)?;
    }
    Ok(known)
}

/// M codes.
fn codes(state: &mut State<'_>, words: &[&str]) -> Judged {
    let mut known = true;
    for word in words {
        match *word {
            "M2" | "M02" | "M30" | "M89" | "M99" => return Err(decides()),
            "M3" | "M03" | "M4" | "M04" | "M13" | "M14" => return Err(spindle()),
            "M5" | "M05" | "M0" | "M00" | "M1" | "M01" | "M9" | "M09" => {}
            "M6" | "M06" => state.tool(None)?,
            _ => known = false,
        }
    }
    Ok(known)
}
