//! Recognises the control of a text by syntax that is unique to it.

use crate::control::iso::lex::{
    lines_of, strip_prefix_nocase, trimmed, without_count, without_number,
};

/// Syntax that is unique to a control or a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DialectMarker {
    /// Names in `#< >`, O words: LinuxCNC.
    LinuxCnc,
    /// `G38.2` and related codes: LinuxCNC, grbl and compatible controls.
    Rs274,
    /// `G31`: Fanuc and compatible controls.
    LikeFanuc,
    /// `BEGIN PGM`: HEIDENHAIN Klartext.
    Klartext,
    /// `{ }`, `param.x`: RepRapFirmware.
    RepRap,
}

/// Keywords of O words, except those that a label of a SINUMERIK may begin with.
const O_WORDS: [&str; 14] = [
    "sub",
    "endsub",
    "call",
    "return",
    "if",
    "elseif",
    "else",
    "endif",
    "while",
    "endwhile",
    "do",
    "repeat",
    "endrepeat",
    "continue",
];

/// Parts of RepRapFirmware's expressions that also occur outside of braces.
const REP_RAP: [&str; 3] = ["param.", "global.", "var."];

/// First sign in a text. A code of a probing move is weaker evidence than the others.
pub fn of(text: &str) -> Option<DialectMarker> {
    let mut probing = None;
    for line in lines_of(text).map(trimmed) {
        if strip_prefix_nocase(without_count(without_number(line)), "BEGIN PGM").is_some() {
            return Some(DialectMarker::Klartext);
        }
        let code = code_of(line);
        if is_linuxcnc(code) {
            return Some(DialectMarker::LinuxCnc);
        }
        // A leading brace is incomplete JSON.
        let braced = code.contains('{') && code.starts_with(|c: char| c.is_ascii_alphabetic());
        if braced || REP_RAP.iter().any(|word| code.contains(word)) {
            return Some(DialectMarker::RepRap);
        }
        probing = probing.or_else(|| probes(code));
    }
    probing
}

/// The first line with a sign of LinuxCNC and the first one with a sign of a Fanuc, if a text has both and no sign of a control that has both itself.
pub fn contradiction(text: &str) -> Option<[usize; 2]> {
    const MOST_LINES: usize = 2000;
    let mut found = [None; 2];
    for (index, line) in lines_of(text).map(trimmed).take(MOST_LINES).enumerate() {
        let code = code_of(line);
        let sign = if is_linuxcnc(code) {
            Some(DialectMarker::LinuxCnc)
        } else {
            probes(code)
        };
        let family = match sign {
            Some(DialectMarker::LinuxCnc | DialectMarker::Rs274) => 0,
            Some(DialectMarker::LikeFanuc) => 1,
            _ => continue,
        };
        found[family].get_or_insert(index);
    }
    let [linuxcnc, fanuc] = found;
    let is_other = || {
        matches!(
            of(text),
            Some(DialectMarker::RepRap | DialectMarker::Klartext)
        )
    };
    linuxcnc
        .zip(fanuc)
        .filter(|_| !is_other())
        .map(|(linuxcnc, fanuc)| [linuxcnc, fanuc])
}

fn is_linuxcnc(code: &str) -> bool {
    if code.contains("#<") {
        return true;
    }
    let Some(label) = trimmed(without_number(code)).strip_prefix(['o', 'O']) else {
        return false;
    };
    let number = label.trim_start_matches(|c: char| c.is_ascii_digit());
    label.starts_with('<')
        || number.len() < label.len() && {
            let word = trimmed(number);
            let word = &word[..word.bytes().take_while(u8::is_ascii_alphabetic).count()];
            O_WORDS.iter().any(|known| word.eq_ignore_ascii_case(known))
        }
}

/// Whether the text contains a code of a probing move: `G38.2`, `G31`.
fn probes(code: &str) -> Option<DialectMarker> {
    let bytes = code.as_bytes();
    memchr::memchr2_iter(b'G', b'g', bytes).find_map(|at| match bytes[at + 1..] {
        [b'3', b'8', b'.', b'2'..=b'9', ..] => Some(DialectMarker::Rs274),
        [b'3', b'1'] => Some(DialectMarker::LikeFanuc),
        [b'3', b'1', next, ..] if !next.is_ascii_digit() => Some(DialectMarker::LikeFanuc),
        _ => None,
    })
}

/// Code of a line before the first comment or text in it; a comment at its start is skipped.
fn code_of(line: &str) -> &str {
    let mut code = line;
    while let Some((_, rest)) = code
        .strip_prefix('(')
        .and_then(|inner| inner.split_once(')'))
    {
        code = trimmed(rest);
    }
    &code[..memchr::memchr3(b'(', b';', b'"', code.as_bytes()).unwrap_or(code.len())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sign_counts_outside_of_comments_and_texts() {
        for (text, sign) in [
            ("(right)\no<a> sub\n", Some(DialectMarker::LinuxCnc)),
            ("{ \"format\": 1, \"cycle\"", None),
            ("{{{{", None),
            ("G1 X{var.x}\n", Some(DialectMarker::RepRap)),
            ("N5 O100 if [#1 EQ 2]\n", Some(DialectMarker::LinuxCnc)),
            ("#<x>=1\n", Some(DialectMarker::LinuxCnc)),
            ("G38.2 Z-5\n#<x>=1\n", Some(DialectMarker::LinuxCnc)),
            ("G21\ng38.3z-5\n", Some(DialectMarker::Rs274)),
            ("O100 (SUB)\nG31Z-5.\n", Some(DialectMarker::LikeFanuc)),
            ("N1G31.1 Z-5.\n", Some(DialectMarker::LikeFanuc)),
            ("(A) (B) G31 Z-5. (G38.2)\n", Some(DialectMarker::LikeFanuc)),
            ("0  BEGIN PGM A MM\n", Some(DialectMarker::Klartext)),
            ("if {param.X} > 3\n", Some(DialectMarker::RepRap)),
            ("var x = param.X\n", Some(DialectMarker::RepRap)),
            (
                "G38 X1\nG310 X1\n(G38.2 #<x> {)\n; G31\n\"G31\"\nO100\nG1 X5\n",
                None,
            ),
        ] {
            assert_eq!(of(text), sign, "{text}");
        }
    }

    #[test]
    fn signs_of_two_controls_contradict_each_other() {
        for (text, lines) in [
            ("G21\nG38.2 Z-5\n(G31)\nG31 Z-5\nG31 X1\n", Some([1, 3])),
            ("G31 Z-5.\n#<x>=1\n", Some([1, 0])),
            ("G38.2 Z-5\n#<x>=1\n", None),
            ("G31 Z-5.\n; G38.2\n", None),
            ("G31\nG38.2 X{var.x}\n", None),
        ] {
            assert_eq!(contradiction(text), lines, "{text}");
        }
    }
}
