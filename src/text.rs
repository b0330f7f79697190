//! What a person reads, as a template and its values: composed in English here, and in any language by whoever has the words.

use std::fmt;

use serde::ser::{Serialize, SerializeSeq, Serializer};

/// A sentence or a few words. The English template is also its key in the lists of words (`www/words/*.json`).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text {
    template: &'static str,
    values: Vec<Part>,
}

/// What stands in place of a name in braces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// What is the same in every language: a number with its unit, a code, what a user typed.
    Verbatim(String),
    /// What has words of its own: the label of a field, a phrase.
    Text(Text),
}

/// A [`Text`]: `text!("{label} must be a whole number", field.label)`. The values fill the names in braces in the order in which these first
/// appear. A `&'static str` is looked up among the words, a `String` and a number are not.
macro_rules! text {
    ($template:literal $(, $value:expr)* $(,)?) => {
        $crate::text::Text::new($template, vec![$($crate::text::Part::from($value)),*])
    };
}
pub(crate) use text;

/// A `&'static str` that is shown as it stands: words, like a template without names. It marks them for the lists of words.
macro_rules! words {
    ($words:literal) => {
        $words
    };
}
pub(crate) use words;

impl Text {
    /// A text from its template and the values of its names, in the order in which these first appear.
    pub fn new(template: &'static str, values: Vec<Part>) -> Self {
        debug_assert!(names(template).len() == values.len(), "each name of \"{template}\" has its value");
        Text { template, values }
    }

    /// Words that stand somewhere as data: the label of a field, what a rule asks.
    pub fn words(words: &'static str) -> Self {
        Text { template: words, values: Vec::new() }
    }

    /// Writes it in English.
    fn write(&self, out: &mut String) {
        let mut known: [&str; MOST_VALUES] = [""; MOST_VALUES];
        let mut count = 0;
        for (before, name) in pieces(self.template) {
            out.push_str(before);
            let Some(name) = name else { continue };
            let place = known[..count].iter().position(|known| *known == name).unwrap_or_else(|| {
                known[count.min(MOST_VALUES - 1)] = name;
                count += 1;
                count - 1
            });
            match self.values.get(place) {
                Some(Part::Verbatim(text)) => out.push_str(text),
                Some(Part::Text(text)) => text.write(out),
                None => {}
            }
        }
    }

    /// In English.
    pub fn english(&self) -> String {
        let mut out = String::with_capacity(self.template.len() + 24 * self.values.len());
        self.write(&mut out);
        out
    }

    /// Its template, in English.
    pub fn template(&self) -> &'static str {
        self.template
    }

    /// What stands in place of the names of its template.
    pub fn values(&self) -> &[Part] {
        &self.values
    }
}

/// The most values that a text has.
const MOST_VALUES: usize = 8;

/// A template as text before each name, and the name; the last piece has none. Braces around anything but a name are text.
fn pieces(template: &str) -> impl Iterator<Item = (&str, Option<&str>)> {
    let mut rest = Some(template);
    std::iter::from_fn(move || {
        let text = rest?;
        let name = |open: usize| {
            let length = text[open + 1..].find(|c: char| !c.is_ascii_alphanumeric() && c != '_')?;
            (length > 0 && text[open + 1 + length..].starts_with('}')).then_some((open, open + 1 + length))
        };
        let Some((open, close)) = text.match_indices('{').find_map(|(open, _)| name(open)) else {
            rest = None;
            return Some((text, None));
        };
        rest = Some(&text[close + 1..]);
        Some((&text[..open], Some(&text[open + 1..close])))
    })
}

/// The names of a template, each once, in the order in which they first appear.
pub fn names(template: &str) -> Vec<&str> {
    let mut names = Vec::new();
    for name in pieces(template).filter_map(|(_, name)| name) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.english())
    }
}

/// As a list: the template, then what stands in place of its names, each a string or such a list itself.
impl Serialize for Text {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(Some(1 + self.values.len()))?;
        list.serialize_element(self.template)?;
        for value in &self.values {
            match value {
                Part::Verbatim(text) => list.serialize_element(text)?,
                Part::Text(text) => list.serialize_element(text)?,
            }
        }
        list.end()
    }
}

impl From<String> for Part {
    fn from(text: String) -> Self {
        Part::Verbatim(text)
    }
}

impl From<Text> for Part {
    fn from(text: Text) -> Self {
        Part::Text(text)
    }
}

impl From<&'static str> for Part {
    fn from(words: &'static str) -> Self {
        Part::Text(Text::words(words))
    }
}

impl From<usize> for Part {
    fn from(n: usize) -> Self {
        Part::Verbatim(n.to_string())
    }
}

impl From<u8> for Part {
    fn from(n: u8) -> Self {
        Part::Verbatim(n.to_string())
    }
}

impl From<char> for Part {
    fn from(sign: char) -> Self {
        Part::Verbatim(sign.to_string())
    }
}

impl From<i32> for Part {
    fn from(n: i32) -> Self {
        Part::Verbatim(n.to_string())
    }
}
