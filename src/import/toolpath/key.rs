//! Variables by their numbers and names.

/// A variable.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Key {
    Number(i32),
    /// In small letters, without blanks.
    Name(String),
    /// `#[…]` of what is not known.
    Unknown,
}

impl Key {
    /// A variable by its name in a text: `#5`, `#<name>`.
    pub fn named(name: &str) -> Option<Key> {
        let name = name.trim().strip_prefix('#')?;
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

    /// Its name in a text.
    pub fn name(&self) -> Option<String> {
        match self {
            Key::Number(number) => Some(format!("#{number}")),
            Key::Name(name) => Some(format!("#<{name}>")),
            Key::Unknown => None,
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
