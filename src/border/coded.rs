//! Values passed from JavaScript. `www/core/coded.ts` is the counterpart, which encodes any value of a caller.
//!
//! Each value is a tag and its contents: see [`Tag`]. All texts are in one string, each followed by a line feed, so that halves of a character do not join. A
//! text is given by its length in UTF-16 units, as JavaScript counts.

use crate::form::Value;
use crate::text::words;

/// Tags, by their numbers.
#[derive(Clone, Copy, Debug)]
pub enum Tag {
    Null,
    False,
    True,
    /// Followed by the number.
    Number,
    /// Followed by its length in UTF-16 units.
    Text,
    /// Followed by the number of values and the values.
    List,
    /// Followed by the number of entries and, for each, the length of its key and its value.
    Map,
    /// Followed by an index into [`OTHERS`].
    Other,
}

/// All tags in order.
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

/// Values that cannot be in a job: name in the JavaScript part, and description.
pub const OTHERS: [(&str, &str); 8] = [
    ("UNDEFINED", words!("undefined")),
    ("NO_DATA", words!("something that is not data")),
    ("UNREADABLE", words!("something unreadable")),
    ("TOO_DEEP", words!("something nested too deeply")),
    ("TOO_MANY", words!("more values than in any job")),
    ("TOO_MUCH_TEXT", words!("more text than in any job")),
    ("TOO_LONG", words!("a list that is longer than in any job")),
    (
        "TOO_MANY_KEYS",
        words!("an object with more keys than any job"),
    ),
];

/// Largest number of values in a job, which usually has about a hundred.
#[cfg(test)]
pub const MOST_VALUES: usize = 20_000;

/// Deepest nesting of lists and objects.
pub const DEEPEST: usize = 16;

/// Reads an encoded value. Anything that `coded.ts` does not produce becomes an unreadable value.
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
    /// The depth bounds the recursion whatever the codes are.
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

/// End of this number of UTF-16 units, in bytes.
fn end_of(text: &str, mut units: usize) -> usize {
    for (at, c) in text.char_indices() {
        if units == 0 {
            return at;
        }
        units = units.saturating_sub(c.len_utf16());
    }
    text.len()
}
