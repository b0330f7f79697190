//! A value as JavaScript hands it over. `www/core/coded.ts` is the other half, which walks whatever a caller has.
//!
//! Each value is a tag and what belongs to it: see [`Tag`]. The texts follow each other, each ended by a line feed, so that
//! halves of a character do not join; what belongs to a text is its length in UTF-16 units, since that is how JavaScript counts.

use crate::form::Value;
use crate::text::words;

/// The tags, by their numbers.
#[derive(Clone, Copy, Debug)]
pub enum Tag {
    Null,
    False,
    True,
    /// Followed by the number.
    Number,
    /// Followed by its length in UTF-16 units.
    Text,
    /// How many values, then those.
    List,
    /// How many entries, then of each the length of its key, and its value.
    Map,
    /// What it is, as a place in [`OTHERS`].
    Other,
}

/// All of them, in their order.
pub const TAGS: [Tag; 8] = [
    Tag::Null,
    Tag::False,
    Tag::True,
    Tag::Number,
    Tag::Text,
    Tag::List,
    Tag::Map,
    Tag::Other,
];

/// What has no place in a job: its name in JavaScript's half, and its words.
pub const OTHERS: [(&str, &str); 8] = [
    ("UNDEFINED", words!("undefined")),
    ("NO_DATA", words!("something that is not data")),
    ("UNREADABLE", words!("something unreadable")),
    ("TOO_DEEP", words!("something nested too deeply")),
    ("TOO_MANY", words!("more than a job can hold")),
    ("TOO_MUCH_TEXT", words!("more text than a job can hold")),
    ("TOO_LONG", words!("a list longer than a job can hold")),
    (
        "TOO_MANY_KEYS",
        words!("an object with more keys than a job can hold"),
    ),
];

/// The most values a job may hold: it has about a hundred.
#[cfg(test)]
pub const MOST_VALUES: usize = 20_000;

/// How deep lists and objects may be in each other.
pub const DEEPEST: usize = 16;

/// Reads a coded value. What is not coded as `coded.ts` does it is something unreadable.
pub fn decoded(codes: &[f64], text: &str) -> Value {
    Coded {
        codes: codes.iter(),
        text,
        ascii: text.is_ascii(),
    }
    .value(0)
    .unwrap_or(Value::Other(OTHERS[2].1))
}

struct Coded<'a> {
    codes: std::slice::Iter<'a, f64>,
    text: &'a str,
    ascii: bool,
}

impl Coded<'_> {
    /// The depth ends the recursion whatever the codes say.
    fn value(&mut self, depth: usize) -> Option<Value> {
        let tag = self.count()?;
        Some(match TAGS.get(tag).filter(|_| depth <= DEEPEST)? {
            Tag::Null => Value::Null,
            Tag::False => Value::Flag(false),
            Tag::True => Value::Flag(true),
            Tag::Number => Value::Number(*self.codes.next()?),
            Tag::Text => Value::Text(self.text()?),
            Tag::List => {
                let count = self.count().filter(|count| *count <= self.codes.len())?;
                Value::List(
                    (0..count)
                        .map(|_| self.value(depth + 1))
                        .collect::<Option<_>>()?,
                )
            }
            Tag::Map => {
                let count = self.count().filter(|count| *count <= self.codes.len())?;
                let entry = |_| Some((self.text()?, self.value(depth + 1)?));
                Value::Map((0..count).map(entry).collect::<Option<_>>()?)
            }
            Tag::Other => Value::Other(OTHERS.get(self.count()?)?.1),
        })
    }

    fn count(&mut self) -> Option<usize> {
        self.codes.next().map(|code| *code as usize)
    }

    fn text(&mut self) -> Option<String> {
        let units = self.count()?;
        let end = if self.ascii {
            units
        } else {
            end_of(self.text, units)
        };
        let (text, rest) = self.text.split_at_checked(end)?;
        self.text = rest.strip_prefix('\n')?;
        Some(text.to_owned())
    }
}

/// Where so many UTF-16 units end, in bytes.
fn end_of(text: &str, mut units: usize) -> usize {
    for (at, c) in text.char_indices() {
        if units == 0 {
            return at;
        }
        units = units.saturating_sub(c.len_utf16());
    }
    text.len()
}
