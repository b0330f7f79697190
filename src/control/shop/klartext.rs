//! The shop's lines in a HEIDENHAIN program.

use super::state::{Coordinates, Judged, Mode, State, assigns, decides, transforms};

/// Judges a line of Klartext.
pub fn judge(state: &mut State<'_>, index: usize, line: &str) -> Judged {
    let capitals = line.to_ascii_uppercase();
    let code = capitals.split(';').next().unwrap_or_default();
    let words: Vec<&str> = code.split_whitespace().collect();
    match words[..] {
        [] => Ok(true),
        ["TOOL", "CALL", ..] => state.tool(),
        ["TOOL", "DEF", ..] | ["STOP", ..] | ["*", ..] => Ok(true),
        ["L", ref rest @ ..] => straight(state, index, rest),
        ["FN", number, ..] => match number.trim_end_matches(':') {
            "14" | "16" | "19" | "20" => Ok(false),
            "9" | "10" | "11" | "12" => Err(decides()),
            "17" => Err(transforms()),
            _ => Err(assigns()),
        },
        ["CALL", "LBL", ..] | ["LBL" | "IF" | "BEGIN" | "END", ..] => Err(decides()),
        [
            "CYCL" | "PLANE" | "TRANS" | "PRESET" | "FUNCTION" | "TCH" | "BLK",
            ..,
        ] => Err(transforms()),
        [first, ..] if first.starts_with('Q') || code.contains('=') => Err(assigns()),
        [first, ..] if first.starts_with(|c: char| c.is_ascii_digit()) => Err(decides()),
        _ if words.iter().all(|word| word.starts_with('M')) => codes(state, index, &words),
        _ => Ok(false),
    }
}

/// `L Z-1 R0 FMAX M91`
fn straight(state: &mut State<'_>, index: usize, words: &[&str]) -> Judged {
    let mut axes = [None; 3];
    let (mut incremental, mut known) = (false, true);
    let mut coordinates = Coordinates::Work;
    let mut other: Vec<&str> = Vec::new();
    let mut words = words.iter().copied().peekable();
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
        } else if word == "M140" {
            // `M140 MB MAX` retracts along the tool axis.
            known &= words.next() == Some("MB") && words.next() == Some("MAX");
        } else if word.starts_with('M') {
            other.push(word);
        } else {
            known &= word == "R0" || word.starts_with('F');
        }
    }
    known &= codes(state, index, &other)?;
    if axes != [None; 3] {
        state.moves(axes, incremental, coordinates)?;
    }
    Ok(known)
}

/// M codes.
fn codes(state: &mut State<'_>, index: usize, words: &[&str]) -> Judged {
    let mut known = true;
    for word in words {
        match *word {
            "M2" | "M02" | "M30" | "M89" | "M99" => return Err(decides()),
            "M3" | "M03" | "M4" | "M04" | "M13" | "M14" => {
                state.mode(Mode::Spindle, index, false, word);
            }
            "M5" | "M05" => state.mode(Mode::Spindle, index, true, word),
            "M0" | "M00" | "M1" | "M01" | "M8" | "M08" | "M9" | "M09" | "M19" => {}
            "M6" | "M06" => {
                state.tool()?;
            }
            _ => known = false,
        }
    }
    Ok(known)
}
