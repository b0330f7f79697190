//! Variables by their numbers and names.

use crate::import::toolpath::script::grammar::Language;

/// A variable.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Key {
    Number(i32),
    /// Small letters for macros, capitals for the others; without blanks.
    Name(String),
    /// `#[…]` with an unknown value.
    Unknown,
}

impl Key {
    /// A variable by its name in a text: `#5`, `#<name>`, `R1`, `Q5`.
    pub fn of(name: &str, language: Language) -> Option<Key> {
        match language {
            Language::RepRap => Some(Key::Name(name.trim().to_owned())),
            // R_TOOL_DATA[0,99,3]
            Language::Lnc if name.contains('[') => Some(Key::Name(plain(name.as_bytes()))),
            language if language.is_macro() => Key::named(name),
            _ => Some(Key::capitals(name.as_bytes())),
        }
    }

    /// A variable of a macro: `#5`, `#<name>`.
    pub fn named(name: &str) -> Option<Key> {
        let name = name.trim();
        if name.starts_with('@') {
            return Some(Key::Name(plain(name.as_bytes())));
        }
        let name = name.strip_prefix('#')?;
        match name
            .strip_prefix('<')
            .and_then(|name| name.strip_suffix('>'))
        {
            Some(name) => Some(Key::Name(plain(name.as_bytes()))),
            None => name
                .parse()
                .ok()
                .filter(|number| *number >= 0)
                .map(Key::Number),
        }
    }

    /// A name that is written in capitals.
    pub fn capitals(name: &[u8]) -> Key {
        let solid = name.iter().filter(|b| !b.is_ascii_whitespace());
        Key::Name(solid.map(|b| char::from(b.to_ascii_uppercase())).collect())
    }

    /// Name in a text.
    pub fn name(&self, language: Language) -> Option<String> {
        match (self, language) {
            (Key::Number(number), _) => Some(format!("#{number}")),
            (Key::Name(name), Language::Lnc) => Some(name.to_ascii_uppercase()),
            (Key::Name(name), language) if language.is_macro() => Some(format!("#<{name}>")),
            (Key::Name(name), _) => Some(name.clone()),
            (Key::Unknown, _) => None,
        }
    }
}

/// A name in small letters, without blanks.
pub fn plain(name: &[u8]) -> String {
    name.iter()
        .filter(|b| !b.is_ascii_whitespace())
        .map(|b| char::from(b.to_ascii_lowercase()))
        .collect()
}
