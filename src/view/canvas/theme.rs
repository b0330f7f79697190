//! The colours of a picture.

/// The colours of a picture, as CSS colours.
#[derive(Clone, Debug)]
pub struct Theme {
    pub background: String,
    pub text: String,
    pub wall: String,
    pub actual: String,
    pub position: String,
    pub link: String,
    pub touch: String,
    pub ball: String,
    pub highlight: String,
}

impl Default for Theme {
    fn default() -> Self {
        let colour = |text: &str| text.to_owned();
        Theme {
            background: colour("#ffffff"),
            text: colour("#1c2430"),
            wall: colour("#4a5565"),
            actual: colour("#b45309"),
            position: colour("#15803d"),
            link: colour("#7b8794"),
            touch: colour("#dc2626"),
            ball: colour("#2563eb"),
            highlight: colour("#2563eb"),
        }
    }
}

impl Theme {
    /// The colours by their names; what `given` has none for is the default.
    pub fn of(given: impl Fn(&str) -> Option<String>) -> Self {
        let mut theme = Theme::default();
        for (name, colour) in [
            ("background", &mut theme.background),
            ("text", &mut theme.text),
            ("wall", &mut theme.wall),
            ("actual", &mut theme.actual),
            ("position", &mut theme.position),
            ("link", &mut theme.link),
            ("touch", &mut theme.touch),
            ("ball", &mut theme.ball),
            ("highlight", &mut theme.highlight),
        ] {
            if let Some(own) = given(name) {
                *colour = own;
            }
        }
        theme
    }
}
