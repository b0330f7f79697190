//! Recognises the dialect of a text.

use crate::control::edition::Edition;
use crate::control::iso::lex::{
    comment_at, head, lines_of, strip_prefix_nocase, trimmed, without_count, without_number,
};
use crate::import::dialect_markers;
use crate::import::toolpath::DIALECTS;

/// Syntax of a SINUMERIK program.
const ALONE: [&str; 12] = [
    "MEAS=", "MEAW=", "GOTOF", "STOPRE", "$A_", "$AA_", "$AC_", "$P_", "$TC_", "=IC(", "=AC(",
    "=DC(",
];

/// Syntax that other controls have, too: an Okuma assigns, a macro has texts.
const LIKELY: [&str; 4] = ["DEF ", "CR=", "T=\"", "SPOS="];

/// Words of its structures; elsewhere they are O words.
const ENDS: [&[u8]; 4] = [b"ENDIF", b"ENDWHILE", b"ENDFOR", b"ENDLOOP"];

/// Assigned axes, and the unit codes beside them on a SINUMERIK: G70, G710 …
const AXES: [&str; 3] = ["X=", "Y=", "Z="];
const UNITS: [&str; 2] = ["G70", "G71"];

/// Number of lines that are examined.
const MOST_LINES: usize = 2000;

/// A SINUMERIK assigns with `=`, calls with `( )` and comments with `;` only. Syntax that other controls share counts only if the text has no syntax unique to
/// them.
pub(in crate::import) fn guessed(text: &str) -> &'static str {
    // Its first block.
    if lines_of(text).take(50).any(|line| {
        strip_prefix_nocase(without_count(without_number(trimmed(line))), "BEGIN PGM").is_some()
    }) {
        return DIALECTS[2];
    }
    let [mut likely, mut assigns, mut units] = [false; 3];
    for line in lines_of(text).take(MOST_LINES) {
        let line = trimmed(line).as_bytes();
        // Start of an archive.
        if line.starts_with(b"%_N_") || line.starts_with(b";$PATH=") {
            return DIALECTS[1];
        }
        let line = &line[head(line).end..];
        if matches!(line.first(), Some(b'E' | b'e'))
            && ENDS
                .iter()
                .any(|word| line.trim_ascii().eq_ignore_ascii_case(word))
        {
            return DIALECTS[usize::from(!is_eding(text) && !is_lnc(text))];
        }
        units |= matches!(line, [b'G' | b'g', b'7', b'0' | b'1', ..]);
        // Most lines begin with a G or an axis, and assign nothing.
        let begins = line.first().is_some_and(|b| {
            matches!(
                b.to_ascii_uppercase(),
                b'C' | b'D' | b'I' | b'M' | b'S' | b'T' | b'R'
            )
        });
        if matches!(line.first(), Some(b'(' | b'%' | b';' | b'O' | b'o' | b'#'))
            || !(begins || memchr::memchr2(b'=', b'$', line).is_some())
        {
            continue;
        }
        // A variable with a number does not belong to a SINUMERIK, whatever the text around it: DPRNT[MEAS=#101[43]].
        if line.contains(&b'#') {
            continue;
        }
        // Comments and texts may contain anything.
        let code = &line[..comment_at(line, true).unwrap_or(line.len())];
        let plain = String::from_utf8_lossy(before_text(code)).to_ascii_uppercase();
        // AC(5) and the like are not comments.
        let whole = String::from_utf8_lossy(before_text(line)).to_ascii_uppercase();
        let called = line.get(code.len()) == Some(&b'(');
        if called && (plain == "MSG" || plain.starts_with("CYCLE"))
            || ALONE.iter().any(|word| {
                if word.ends_with('(') {
                    whole.contains(word)
                } else {
                    plain.contains(word)
                }
            })
        {
            return DIALECTS[1];
        }
        likely |= LIKELY.iter().any(|word| plain.contains(word)) || parameter(&plain);
        assigns |= AXES.iter().any(|word| plain.contains(word));
        units |= UNITS.iter().any(|code| plain.contains(code));
    }
    let sinumerik = (likely || assigns && units) && dialect_markers::of(text).is_none();
    DIALECTS[usize::from(sinumerik)]
}

/// First word of each examined line of code, in capitals.
fn words(text: &str) -> impl Iterator<Item = String> {
    lines_of(text).take(MOST_LINES).map(|line| {
        let line = trimmed(line).as_bytes();
        let code = &line[head(line).end..];
        let is_name = |b: &&u8| b.is_ascii_alphanumeric() || **b == b'_';
        let word: Vec<u8> = code.iter().take_while(is_name).copied().collect();
        String::from_utf8_lossy(&word).to_ascii_uppercase()
    })
}

/// Whether a program is for an LNC: by words that no other control has.
pub(super) fn is_lnc(text: &str) -> bool {
    let is_own =
        |word: String| word == "END_IF" || word.starts_with("W_G5") || word == "FIX_CUT_OR_ON";
    let in_code = |line: &str| {
        let code = &line[..comment_at(line.as_bytes(), true).unwrap_or(line.len())];
        let code = code.split("//").next().unwrap_or_default();
        code.contains("R_SKIP") || code.contains("G65 \"")
    };
    lines_of(text).take(MOST_LINES).any(in_code) || words(text).any(is_own)
}

/// Whether a program is for an Eding CNC: subroutines with names, variables with numbers.
pub(super) fn is_eding(text: &str) -> bool {
    const WORDS: [&str; 4] = ["GOSUB", "ENDSUB", "DLGMSG", "ERRMSG"];
    text.contains('#') && words(text).any(|word| WORDS.contains(&word.as_str()))
}

/// Whether a program is for PlanetCNC: by the results of its measuring macros, and by its own commands.
pub(super) fn is_planetcnc(text: &str) -> bool {
    ["#<_measure", "$<cmd_", "#<_coordsys_", "(dlg,"]
        .iter()
        .any(|word| text.contains(word))
}

/// Whether a program is for a Centroid: by its own codes, or by macros with a letter for the axis.
pub(super) fn is_centroid(text: &str) -> bool {
    lines_of(text).take(MOST_LINES).any(|line| {
        let code = &line[..comment_at(line.as_bytes(), true).unwrap_or(line.len())];
        if !code.contains(['M', 'm', '#', 'P', 'p']) {
            return false;
        }
        let code: String = code
            .chars()
            .filter(|c| !c.is_whitespace())
            .map(|c| c.to_ascii_uppercase())
            .collect();
        ["M115/", "M116/", "M125/", "M126/", "#9011", "P9813A"]
            .iter()
            .any(|word| code.contains(word))
            || ["P9810A1X", "P9811A", "P9812A"]
                .iter()
                .any(|word| code.contains(word))
            || code.contains("P9817D") && !code.contains('E')
    })
}

/// Edition of Renishaw's macros that a program is for: Mazak's by a comment that begins with its name, or by a call with letters that only its macros have.
pub(super) fn edition(text: &str) -> Edition {
    if lines_of(text).take(MOST_LINES).any(is_for_mazak) {
        Edition::Mazak
    } else {
        Edition::Unknown
    }
}

fn is_for_mazak(line: &str) -> bool {
    const NAMES: [&str; 2] = ["(RENISHAW", "(EDITION OF THE MACROS"];
    if line.contains("A-4013-0113") {
        let line = line.trim_start().to_ascii_uppercase();
        return NAMES.iter().any(|name| line.starts_with(name));
    }
    // Only few lines have one of these numbers.
    if !["9801", "9817", "9818"]
        .iter()
        .any(|number| line.contains(number))
    {
        return false;
    }
    let code = &line[..comment_at(line.as_bytes(), true).unwrap_or(line.len())];
    let code: String = code
        .chars()
        .filter(|c| !c.is_whitespace())
        .map(|c| c.to_ascii_uppercase())
        .collect();
    let given = |number: &str| {
        let (_, letters) = code.split_once("G65P")?.1.split_once(number)?;
        letters
            .starts_with(|c: char| !c.is_ascii_digit())
            .then_some(letters)
    };
    given("9817").is_some_and(|letters| letters.contains('D') && letters.contains('E'))
        || ["9801", "9818"]
            .iter()
            .any(|number| given(number).is_some_and(|letters| letters.contains('K')))
}

/// A line up to the text in it, including the opening quote.
fn before_text(line: &[u8]) -> &[u8] {
    &line[..memchr::memchr(b'"', line).map_or(line.len(), |at| at + 1)]
}

/// Whether a line sets an R parameter: `R1=5`.
fn parameter(code: &str) -> bool {
    let value = code
        .strip_prefix('R')
        .map(|rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()));
    value.is_some_and(|value| value.len() + 1 < code.len() && value.starts_with('='))
}
