//! Texts for people, as templates with values: composed in English here, and in other languages from lists of words.

use std::fmt;

use serde::ser::{Serialize, SerializeSeq, Serializer};

/// A sentence or a few words. The English template is also its key in the lists of words (`www/words/*.json`).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text {
    template: &'static str,
    values: Vec<Part>,
}

/// Value of a name in braces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// Unchanged in every language: a number with its unit, a code, a user's text.
    Verbatim(String),
    /// Translated: the label of a field, a phrase.
    Text(Text),
}

/// Makes a [`Text`]: `text!("{label} must be a whole number", field.label)`. The values fill the names in braces in the order of their first appearance. A
/// `&'static str` is looked up among the words, a `String` and a number are not.
macro_rules! text {
    ($template:literal $(, $value:expr)* $(,)?) => {{
        #[allow(unused_mut)]
        let mut text = $crate::text::Text::words($template);
        $(text.fill($value);)*
        text
    }};
}
pub(crate) use text;

/// A `&'static str` that is shown unchanged, like a template without names. Marks it for the lists of words.
macro_rules! words {
    ($words:literal) => {
        $words
    };
}
pub(crate) use words;

impl Text {
    /// Words in data: the label of a field, the requirement of a rule.
    pub fn words(words: &'static str) -> Self {
        Text {
            template: words,
            values: Vec::new(),
        }
    }

    /// Fills the next name without a value. One call each, so that a text costs few bytes where it is made.
    #[inline(never)]
    pub fn fill(&mut self, value: impl Into<Part>) {
        self.values.push(value.into());
        debug_assert!(
            self.values.len() <= names(self.template).len(),
            "each value of \"{}\" has its name",
            self.template
        );
    }

    fn write(&self, out: &mut String) {
        if self.values.is_empty() {
            debug_assert!(
                names(self.template).is_empty(),
                "each name of \"{}\" has its value",
                self.template
            );
            return out.push_str(self.template);
        }
        let names = names(self.template);
        debug_assert!(
            names.len() == self.values.len(),
            "each name of \"{}\" has its value",
            self.template
        );
        for (before, name) in pieces(self.template) {
            out.push_str(before);
            let place = names.iter().position(|known| Some(*known) == name);
            match place.and_then(|place| self.values.get(place)) {
                Some(Part::Verbatim(text)) => out.push_str(text),
                Some(Part::Text(text)) => text.write(out),
                None => {}
            }
        }
    }

    /// The text in English, its values filled in.
    pub fn english(&self) -> String {
        let mut out = String::with_capacity(self.template.len() + 24 * self.values.len());
        self.write(&mut out);
        out
    }

    /// The English template: the names of its values are in braces.
    pub fn template(&self) -> &'static str {
        self.template
    }

    /// Values of the names, in the order of their first appearance.
    pub fn values(&self) -> &[Part] {
        &self.values
    }
}

/// A template as text before each name, and the name; the last piece has no name. Braces around anything else are text.
fn pieces(template: &str) -> impl Iterator<Item = (&str, Option<&str>)> {
    let mut rest = Some(template);
    std::iter::from_fn(move || {
        let text = rest?;
        for open in memchr::memchr_iter(b'{', text.as_bytes()) {
            let name = &text[open + 1..];
            let end = name
                .bytes()
                .position(|b| !b.is_ascii_alphanumeric() && b != b'_')
                .unwrap_or(name.len());
            if end > 0 && name[end..].starts_with('}') {
                rest = Some(&name[end + 1..]);
                return Some((&text[..open], Some(&name[..end])));
            }
        }
        rest = None;
        Some((text, None))
    })
}

/// Names of a template, each once, in the order of their first appearance.
fn names(template: &str) -> Vec<&str> {
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

/// Serialized as a list: the template, then the values of its names, each a string or such a list.
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
        Part::from(usize::from(n))
    }
}

impl From<char> for Part {
    fn from(sign: char) -> Self {
        Part::Verbatim(String::from(sign))
    }
}

impl From<i32> for Part {
    fn from(n: i32) -> Self {
        Part::Verbatim(n.to_string())
    }
}

#[cfg(test)]
mod tests {
    use crate::text::{Text, names};

    #[test]
    fn values_stand_in_place_of_names() {
        let inner = text!("a list of {count}", 3_usize);
        let said = text!(
            "{label} must be { x, y } of {n}, {label}, not {given}{n}",
            "Point",
            2,
            inner
        );
        assert_eq!(
            said.english(),
            "Point must be { x, y } of 2, Point, not a list of 32"
        );
        assert_eq!(names("{a}{b}{a} {} {c d} {e_1}"), ["a", "b", "e_1"]);
        assert_eq!(Text::words("}{ {").english(), "}{ {");
    }
}
