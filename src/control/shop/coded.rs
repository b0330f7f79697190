//! Lines of the shop in a header.

use std::fmt::Write;

/// A line in a header: without blanks, brackets or anything else with a meaning there. `capitals`: a small letter is a plus and a capital.
pub fn encoded(line: &str, capitals: bool) -> String {
    let mut out = String::with_capacity(2 * line.len());
    for c in line.chars() {
        match c {
            ' ' => out.push('_'),
            'a'..='z' if capitals => {
                out.push('+');
                out.push(c.to_ascii_uppercase());
            }
            'A'..='Z' | 'a'..='z' | '0'..='9' | '.' | '-' => out.push(c),
            c => {
                let _ = write!(out, "@{:02X}", u32::from(c));
            }
        }
    }
    out
}

/// A line of a header as it was; `None` for a text that [`encoded`] cannot write.
pub fn decoded(word: &str) -> Option<String> {
    let mut out = String::with_capacity(word.len());
    let mut rest = word.chars();
    while let Some(c) = rest.next() {
        out.push(match c {
            '_' => ' ',
            '+' => rest.next()?.to_ascii_lowercase(),
            '@' => {
                let digit = |c: Option<char>| c.and_then(|c| c.to_digit(16));
                let code = 16 * digit(rest.next())? + digit(rest.next())?;
                char::from_u32(code)?
            }
            c => c,
        });
    }
    Some(out)
}
