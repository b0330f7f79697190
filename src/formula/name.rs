//! Names of values, stored inline: a formula has hundreds.

use crate::num::push_count;

/// Name of a value: lower-case letters, digits and underscores, which every control accepts. `center_x`, `q1`, `ss2_3`, `c1_uu_4`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Name {
    stem: &'static str,
    number: Option<u32>,
    rest: &'static str,
    index: Option<u32>,
}

impl From<&'static str> for Name {
    fn from(stem: &'static str) -> Self {
        Name {
            stem,
            number: None,
            rest: "",
            index: None,
        }
    }
}

impl Name {
    /// A stem and its number: `q1`.
    pub fn new(stem: &'static str, number: usize) -> Self {
        Name {
            number: Some(number as u32),
            ..Name::from(stem)
        }
    }

    /// Appends a suffix: `c1_det`.
    pub fn and(self, rest: &'static str) -> Self {
        Name { rest, ..self }
    }

    /// Appends a number: `c1_uu_4`.
    pub fn at(self, index: usize) -> Self {
        Name {
            index: Some(index as u32),
            ..self
        }
    }

    /// Appends the name to a text.
    pub fn push_to(self, text: &mut String) {
        text.push_str(self.stem);
        for (number, rest) in [(self.number, self.rest), (self.index, "")] {
            if let Some(number) = number {
                push_count(text, number as usize);
            }
            text.push_str(rest);
        }
    }
}

impl std::fmt::Display for Name {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut text = String::new();
        self.push_to(&mut text);
        f.write_str(&text)
    }
}

#[cfg(test)]
mod tests {
    use super::Name;

    #[test]
    fn names_as_programs_have_them() {
        let names = [
            Name::from("center_x"),
            Name::new("q", 1),
            Name::new("ss", 2).and("_").at(3),
            Name::new("c", 1).and("_uu_").at(4),
        ];
        assert_eq!(
            names.map(|name| name.to_string()),
            ["center_x", "q1", "ss2_3", "c1_uu_4"]
        );
        assert_eq!(Name::new("c", 1).and("_det").to_string(), "c1_det");
    }
}
