//! A field of a form, declared once.

use crate::form::Section;

/// One field: everything that a form, a check, a table and a manual need.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Key in the job.
    pub key: &'static str,
    /// Label on a form.
    pub label: &'static str,
    /// One or two sentences about its effect.
    pub help: &'static str,
    pub kind: Kind,
    /// Value if the job leaves it out. Lengths in mm, feeds in mm/min, accelerations in mm/s², times in ms, angles in degrees.
    pub default: Default,
    /// Start value for a new job in inch, in inch, if it is not `default` rounded to a usual number.
    pub inch: Option<f64>,
    /// Allowed range, in the units of `default`.
    pub hard: Range,
    /// Usual range; a warning outside.
    pub usual: Option<(f64, f64)>,
    /// Reason for the allowed range, if it is not obvious.
    pub reason: &'static str,
    /// Whether `null` is allowed, and its meaning.
    pub null: Option<&'static str>,
    /// Parameter code of the source, `CmdPrm.Flt[-50]`, or empty.
    pub code: &'static str,
    /// Heading above the field in a form.
    pub group: &'static str,
    /// Whether it is a size of the part that the virtual part may change.
    pub size: bool,
    /// Another field of the form, and the number that it must have for this field to count.
    pub when: Option<(&'static str, i32)>,
    /// View that shows the value, if no dimension shows it.
    #[cfg_attr(
        not(target_arch = "wasm32"),
        allow(dead_code, reason = "the page looks for the view")
    )]
    pub seen: Option<BestView>,
}

/// View of a part in which a value is visible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BestView {
    /// A rotation about the tool axis, or a distance in any direction of the plane: visible from the top.
    Rotation,
    /// A height: visible where the tool axis has its true length.
    Height,
    /// A position: each coordinate is visible where its axis has its true length.
    Position,
}

/// Kind of value of a field, which gives the unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A length in the job's units.
    Length,
    /// A feed in the job's units per minute.
    Feed,
    /// An acceleration in the job's units per second squared.
    Acceleration,
    /// A time in milliseconds.
    Time,
    /// An angle in degrees.
    Angle,
    Count,
    Flag,
    /// One of a fixed set of words.
    Choice(&'static [Choice]),
    /// Text of at most this many characters.
    Text(usize),
    /// Three lengths X, Y, Z.
    Point,
    /// One of a fixed set of whole numbers.
    Code(&'static [Code]),
    /// A length, or text with a tolerance, an unknown or a given position: see `tolerance`.
    Nominal,
    /// Three nominal values: X, Y, Z.
    NominalPoint,
    /// Lines of a program by these places, each a list of texts.
    Lines(&'static [Choice]),
}

impl Kind {
    /// Whether values are converted with the units of the job.
    pub const fn is_metric(self) -> bool {
        match self {
            Kind::Length
            | Kind::Feed
            | Kind::Acceleration
            | Kind::Point
            | Kind::Nominal
            | Kind::NominalPoint => true,
            Kind::Time
            | Kind::Angle
            | Kind::Count
            | Kind::Flag
            | Kind::Choice(_)
            | Kind::Text(_)
            | Kind::Code(_)
            | Kind::Lines(_) => false,
        }
    }
}

/// One number of a [`Kind::Code`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Code {
    /// The number in the job.
    pub value: i32,
    pub label: &'static str,
}

/// Largest number of lines at one place, and the longest line, characters.
pub const MOST_LINES: usize = 20;
pub const LONGEST_LINE: usize = 80;

/// Lines of a program by the words of their places, in the order of the places. A place without lines is left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlacedLines(pub Vec<(&'static str, Vec<String>)>);

impl PlacedLines {
    /// The lines of a place.
    pub fn at(&self, place: &str) -> &[String] {
        let own = self.0.iter().find(|(known, _)| *known == place);
        own.map_or(&[], |(_, lines)| lines)
    }
}

/// A form inside a form.
#[derive(Clone, Copy, Debug)]
pub struct SubForm {
    pub key: &'static str,
    pub fields: &'static [Field],
    /// Whether it may be `null`; this is then its default.
    pub optional: bool,
}

impl SubForm {
    /// A form whose fields have their defaults if the job leaves it out.
    pub const fn required(key: &'static str, fields: &'static [Field]) -> Self {
        SubForm {
            key,
            fields,
            optional: false,
        }
    }

    /// A form that may be `null`; the job leaves it out by default.
    pub const fn optional(key: &'static str, fields: &'static [Field]) -> Self {
        SubForm {
            key,
            fields,
            optional: true,
        }
    }
}

/// One word of a [`Kind::Choice`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The word in the job.
    pub value: &'static str,
    /// Label on a form.
    pub label: &'static str,
}

/// Default value of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Default {
    Number(f64),
    Flag(bool),
    /// Text or a choice.
    Text(&'static str),
    /// X, Y, Z.
    Point([f64; 3]),
    Null,
}

/// Allowed numbers of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub min: f64,
    /// The largest allowed number.
    pub max: f64,
    /// Whether `min` itself is excluded.
    pub above: bool,
}

impl Range {
    /// Largest excess of a converted number over an end, mm.
    pub const NOISE: f64 = 1.5e-5;

    /// Whether a computed number is inside, within the rounding of the computation.
    pub fn nearly_holds(&self, x: f64) -> bool {
        self.holds(self.snapped(x))
    }

    /// Moves a computed number onto an end of the range that it exceeds by rounding only: half of the last of six decimals in inch.
    pub fn snapped(&self, x: f64) -> f64 {
        let inside = crate::num::within(x, self.min, self.max);
        if (x - inside).abs() <= Self::NOISE {
            inside
        } else {
            x
        }
    }

    /// Whether a number is inside. NaN is not.
    pub fn holds(&self, x: f64) -> bool {
        x <= self.max
            && if self.above {
                x > self.min
            } else {
                x >= self.min
            }
    }
}

impl Field {
    const fn new(
        key: &'static str,
        label: &'static str,
        kind: Kind,
        default: Default,
        hard: Range,
    ) -> Self {
        Field {
            key,
            label,
            help: "",
            kind,
            default,
            inch: None,
            hard,
            usual: None,
            reason: "",
            null: None,
            code: "",
            group: "",
            size: false,
            when: None,
            seen: None,
        }
    }

    /// A length, by default from −100 m to 100 m.
    pub const fn length(key: &'static str, label: &'static str, default: f64) -> Self {
        let hard = Range {
            min: -100_000.0,
            max: 100_000.0,
            above: false,
        };
        Field::new(key, label, Kind::Length, Default::Number(default), hard)
    }

    /// A feed of at least 0.1 mm/min: a smaller one could be printed as 0.
    pub const fn feed(key: &'static str, label: &'static str, default: f64) -> Self {
        let hard = Range {
            min: 0.1,
            max: 100_000.0,
            above: false,
        };
        Field::new(key, label, Kind::Feed, Default::Number(default), hard)
    }

    /// An acceleration, mm/s².
    pub const fn acceleration(key: &'static str, label: &'static str, default: f64) -> Self {
        let hard = Range {
            min: 1.0,
            max: 1_000_000.0,
            above: false,
        };
        Field::new(
            key,
            label,
            Kind::Acceleration,
            Default::Number(default),
            hard,
        )
    }

    /// A time in milliseconds, 0 to a minute.
    pub const fn time(key: &'static str, label: &'static str, default: f64) -> Self {
        let hard = Range {
            min: 0.0,
            max: 60_000.0,
            above: false,
        };
        Field::new(key, label, Kind::Time, Default::Number(default), hard)
    }

    /// An angle in degrees, −360 to 360.
    pub const fn angle(key: &'static str, label: &'static str, default: f64) -> Self {
        let hard = Range {
            min: -360.0,
            max: 360.0,
            above: false,
        };
        Field::new(key, label, Kind::Angle, Default::Number(default), hard)
    }

    /// A whole number in a range.
    pub const fn count(
        key: &'static str,
        label: &'static str,
        default: i32,
        min: i32,
        max: i32,
    ) -> Self {
        let hard = Range {
            min: min as f64,
            max: max as f64,
            above: false,
        };
        Field::new(
            key,
            label,
            Kind::Count,
            Default::Number(default as f64),
            hard,
        )
    }

    pub const fn flag(key: &'static str, label: &'static str, default: bool) -> Self {
        Field::new(
            key,
            label,
            Kind::Flag,
            Default::Flag(default),
            Range {
                min: 0.0,
                max: 1.0,
                above: false,
            },
        )
    }

    pub const fn choice(
        key: &'static str,
        label: &'static str,
        choices: &'static [Choice],
    ) -> Self {
        let hard = Range {
            min: 0.0,
            max: 0.0,
            above: false,
        };
        Field::new(
            key,
            label,
            Kind::Choice(choices),
            Default::Text(choices[0].value),
            hard,
        )
    }

    /// Text of at most `most` characters.
    pub const fn text(
        key: &'static str,
        label: &'static str,
        default: &'static str,
        most: usize,
    ) -> Self {
        let hard = Range {
            min: 0.0,
            max: most as f64,
            above: false,
        };
        Field::new(key, label, Kind::Text(most), Default::Text(default), hard)
    }

    /// Lines of a program by these places. Without lines the value is `null`.
    pub const fn lines(key: &'static str, label: &'static str, places: &'static [Choice]) -> Self {
        let hard = Range {
            min: 0.0,
            max: LONGEST_LINE as f64,
            above: false,
        };
        Field::new(key, label, Kind::Lines(places), Default::Null, hard).null_means("none")
    }

    /// One of some whole numbers.
    pub const fn code_of(
        key: &'static str,
        label: &'static str,
        default: i32,
        codes: &'static [Code],
    ) -> Self {
        let hard = Range {
            min: codes[0].value as f64,
            max: codes[codes.len() - 1].value as f64,
            above: false,
        };
        Field::new(
            key,
            label,
            Kind::Code(codes),
            Default::Number(default as f64),
            hard,
        )
    }

    /// A length or text with a tolerance.
    pub const fn nominal(key: &'static str, label: &'static str, default: f64) -> Self {
        let hard = Range {
            min: -99_999.999_9,
            max: 99_999.999_9,
            above: false,
        };
        Field::new(key, label, Kind::Nominal, Default::Number(default), hard)
    }

    /// Three nominal values: X, Y, Z.
    pub const fn nominal_point(key: &'static str, label: &'static str, default: [f64; 3]) -> Self {
        let hard = Range {
            min: -99_999.999_9,
            max: 99_999.999_9,
            above: false,
        };
        Field::new(
            key,
            label,
            Kind::NominalPoint,
            Default::Point(default),
            hard,
        )
    }

    /// Three lengths: X, Y, Z.
    pub const fn point(key: &'static str, label: &'static str) -> Self {
        let hard = Range {
            min: -100_000.0,
            max: 100_000.0,
            above: false,
        };
        Field::new(key, label, Kind::Point, Default::Point([0.0; 3]), hard)
    }

    /// Adds a help text, unless it is empty.
    pub const fn documented(self, help: &'static str) -> Self {
        if help.is_empty() {
            self
        } else {
            self.help(help)
        }
    }

    pub const fn help(mut self, help: &'static str) -> Self {
        self.help = help;
        self
    }

    /// Allowed from `min` to `max`, both included.
    pub const fn range(mut self, min: f64, max: f64) -> Self {
        self.hard = Range {
            min,
            max,
            above: false,
        };
        self
    }

    /// Allowed above `min`, up to and including `max`.
    pub const fn above(mut self, min: f64, max: f64) -> Self {
        self.hard = Range {
            min,
            max,
            above: true,
        };
        self
    }

    /// Usually from `min` to `max`; a warning outside.
    pub const fn usual(mut self, min: f64, max: f64) -> Self {
        self.usual = Some((min, max));
        self
    }

    /// Sets the start value for a new job in inch.
    pub const fn in_inch(mut self, default: f64) -> Self {
        self.inch = Some(default);
        self
    }

    /// Sets the reason for the range.
    pub const fn because(mut self, reason: &'static str) -> Self {
        self.reason = reason;
        self
    }

    /// Allows `null`, with this meaning.
    pub const fn null_means(mut self, meaning: &'static str) -> Self {
        self.null = Some(meaning);
        self
    }

    /// Sets the default of a point.
    pub const fn at(mut self, default: [f64; 3]) -> Self {
        self.default = Default::Point(default);
        self
    }

    /// Makes `null` the default.
    pub const fn null_by_default(mut self) -> Self {
        self.default = Default::Null;
        self
    }

    /// Sets the parameter code of the source.
    pub const fn code(mut self, code: &'static str) -> Self {
        self.code = code;
        self
    }

    /// Sets the heading above the field in a form.
    pub const fn group(mut self, group: &'static str) -> Self {
        self.group = group;
        self
    }

    /// Makes the field count only while another field of the form has this number.
    pub const fn only_with(mut self, key: &'static str, number: i32) -> Self {
        self.when = Some((key, number));
        self
    }

    /// Sets the view for a field without its own dimension.
    pub const fn seen(mut self, seen: BestView) -> Self {
        self.seen = Some(seen);
        self
    }

    /// Marks a size that the virtual part may change.
    pub const fn size(mut self) -> Self {
        self.size = true;
        self
    }
}

/// Type of a field's checked value.
pub trait FieldType: Sized {
    /// Takes the value of `field` from `section` and reports faults. If there is no usable value, the default applies, so that reading can continue; the
    /// reported error prevents a plan.
    fn take(section: &mut Section<'_, '_>, field: &'static Field) -> Self;

    /// The value in plain form.
    fn shown(&self) -> PlainValue {
        PlainValue::Nothing
    }
}

/// A checked value of any field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlainValue {
    /// A length in mm, an angle in degrees, a feed.
    Number(f64),
    Whole(i32),
    Flag(bool),
    /// Null, a point or text.
    Nothing,
}

/// A form as a list of its values.
pub trait Values {
    /// Each field with its value, in the order of the form.
    fn values(&self) -> Vec<(&'static Field, PlainValue)>;
}

/// Declares a form: a struct of checked values, its list of fields, and the function that reads it. Doc comments are the help texts.
macro_rules! form {
    ($(#[doc = $doc:literal])* $vis:vis struct $name:ident {
        $($(#[doc = $help:literal])* $key:ident : $type:ty = $field:expr,)*
    }) => {
        $(#[doc = $doc])*
        #[derive(Clone, Debug)]
        $vis struct $name { $($(#[doc = $help])* pub $key: $type,)* }

        impl $name {
            /// The fields, in the order of the form.
            pub const FIELDS: &'static [$crate::form::Field] =
                &[$($field.documented($crate::form::trimmed(concat!($($help),*))),)*];

            /// Reads the checked values from a section and reports every problem.
            pub fn read(section: &mut $crate::form::Section<'_, '_>) -> Self {
                let mut fields = Self::FIELDS.iter();
                $(let $key = $crate::form::take(section, fields.next().expect("one field for each member"));)*
                $name { $($key,)* }
            }
        }

        impl $crate::form::Values for $name {
            fn values(&self) -> Vec<(&'static $crate::form::Field, $crate::form::PlainValue)> {
                let mut fields = Self::FIELDS.iter();
                vec![$((fields.next().expect("one field for each member"), $crate::form::shown(&self.$key)),)*]
            }
        }
    };
}
pub(crate) use form;
