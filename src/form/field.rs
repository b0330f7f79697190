//! A field of a form, declared once.

use crate::form::Section;

/// One field: everything a form, a check, a table and a manual need to know about it.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Key in the job.
    pub key: &'static str,
    /// Short name for people.
    pub label: &'static str,
    /// One or two sentences on what it does.
    pub help: &'static str,
    pub kind: Kind,
    /// The value where the job says nothing; lengths in mm, feeds in mm/min, accelerations in mm/s², times in ms, angles in degrees.
    pub default: Default,
    /// What a new job in inch begins with, in inch, where that is not `default` brought to a number that people type.
    pub inch: Option<f64>,
    /// What is allowed; same units as `default`.
    pub hard: Range,
    /// What is usual; a warning outside.
    pub usual: Option<(f64, f64)>,
    /// Why the hard range is what it is, where that is not plain.
    pub reason: &'static str,
    /// Whether `null` is a value of its own, and what it means.
    pub null: Option<&'static str>,
    /// The parameter code of the source, `CmdPrm.Flt[-50]`, or empty.
    pub code: &'static str,
    /// The heading that a form shows it under.
    pub group: &'static str,
    /// Whether it is a size of the part that the virtual part may change.
    pub size: bool,
    /// The other field of its form, and the number that this must have for the field to count at all.
    pub when: Option<(&'static str, i32)>,
    /// Which view shows what it gives, where no dimension of its own does.
    #[cfg_attr(
        not(target_arch = "wasm32"),
        allow(dead_code, reason = "the page looks for the view")
    )]
    pub seen: Option<Seen>,
}

/// In which view of a part a value is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seen {
    /// A turn about the tool axis, or a way in any direction of the plane: from the top.
    Turning,
    /// A height: where the tool axis is seen in its true length.
    Upright,
    /// A place: each coordinate where its axis is seen in its true length.
    Placed,
}

/// What kind of value a field takes, and with it the unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A length in the job's units.
    Length,
    /// A feed in the job's units per minute.
    Feed,
    /// The job's units per second squared.
    Acceleration,
    /// Milliseconds.
    Time,
    /// Degrees.
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
    /// A length, or text with a tolerance, an unknown or a given place: see `tolerance`.
    Nominal,
    /// Three nominal values: X, Y, Z.
    NominalPoint,
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
            | Kind::Code(_) => false,
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

/// A form inside a form.
#[derive(Clone, Copy, Debug)]
pub struct SubForm {
    pub key: &'static str,
    pub fields: &'static [Field],
    /// Whether it may be `null`, and is where the job says nothing.
    pub optional: bool,
}

impl SubForm {
    /// A form whose fields have their defaults where the job leaves it out.
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
    /// What a person reads.
    pub label: &'static str,
}

/// A field's value where the job says nothing.
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

/// The numbers a field allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub min: f64,
    /// The largest, always included.
    pub max: f64,
    /// Whether `min` itself is excluded.
    pub above: bool,
}

impl Range {
    /// What a converted number may lie beyond an end, mm.
    pub const NOISE: f64 = 1.5e-5;

    /// Whether a number that was computed lies inside, give or take the noise of the computation.
    pub fn nearly_holds(&self, x: f64) -> bool {
        self.holds(self.snapped(x))
    }

    /// A computed number, brought to an end of the range where it lies beyond it by no more than noise: half of the last of six decimals in
    /// inch.
    pub fn snapped(&self, x: f64) -> f64 {
        let inside = crate::num::within(x, self.min, self.max);
        if (x - inside).abs() <= Self::NOISE {
            inside
        } else {
            x
        }
    }

    /// Whether a number lies inside. NaN does not.
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

    /// A length, by default anywhere from −100 m to 100 m.
    pub const fn length(key: &'static str, label: &'static str, default: f64) -> Self {
        let hard = Range {
            min: -100_000.0,
            max: 100_000.0,
            above: false,
        };
        Field::new(key, label, Kind::Length, Default::Number(default), hard)
    }

    /// A feed of at least 0.1 mm/min: less could be printed as 0.
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

    /// With a help text, unless it is empty.
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

    /// What a new job in inch begins with.
    pub const fn in_inch(mut self, default: f64) -> Self {
        self.inch = Some(default);
        self
    }

    /// Why the range ends where it does.
    pub const fn because(mut self, reason: &'static str) -> Self {
        self.reason = reason;
        self
    }

    /// `null` is allowed and means this.
    pub const fn null_means(mut self, meaning: &'static str) -> Self {
        self.null = Some(meaning);
        self
    }

    /// Another point where the job says nothing.
    pub const fn at(mut self, default: [f64; 3]) -> Self {
        self.default = Default::Point(default);
        self
    }

    /// `null` where the job says nothing.
    pub const fn null_by_default(mut self) -> Self {
        self.default = Default::Null;
        self
    }

    /// The parameter code of the source.
    pub const fn code(mut self, code: &'static str) -> Self {
        self.code = code;
        self
    }

    /// The heading that a form shows it under.
    pub const fn group(mut self, group: &'static str) -> Self {
        self.group = group;
        self
    }

    /// It counts only while another field of its form has this number.
    pub const fn only_with(mut self, key: &'static str, number: i32) -> Self {
        self.when = Some((key, number));
        self
    }

    /// Seen so where no dimension of its own is drawn.
    pub const fn seen(mut self, seen: Seen) -> Self {
        self.seen = Some(seen);
        self
    }

    /// A size that the virtual part may change.
    pub const fn size(mut self) -> Self {
        self.size = true;
        self
    }
}

/// A type that a field's checked value has.
pub trait Checked: Sized {
    /// Takes the value of `field` out of `section`, reporting what is wrong with it. Where nothing usable is there, the
    /// default applies, so that reading can continue; the report already says that no plan will be made.
    fn take(section: &mut Section<'_, '_>, field: &'static Field) -> Self;

    /// The value as a plain one.
    fn shown(&self) -> Shown {
        Shown::Nothing
    }
}

/// A checked value of any field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shown {
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
    fn values(&self) -> Vec<(&'static Field, Shown)>;
}

/// Declares a form: a struct of checked values, its list of fields, and how it is read. Doc comments are the help texts.
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

            /// Reads the checked values out of a section, reporting every problem.
            pub fn read(section: &mut $crate::form::Section<'_, '_>) -> Self {
                let mut fields = Self::FIELDS.iter();
                $(let $key = $crate::form::take(section, fields.next().expect("one field for each member"));)*
                $name { $($key,)* }
            }
        }

        impl $crate::form::Values for $name {
            fn values(&self) -> Vec<(&'static $crate::form::Field, $crate::form::Shown)> {
                let mut fields = Self::FIELDS.iter();
                vec![$((fields.next().expect("one field for each member"), $crate::form::shown(&self.$key)),)*]
            }
        }
    };
}
pub(crate) use form;
