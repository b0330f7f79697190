//! Contents of a job: fields declared once, and the check that turns a loose form into checked values.
//!
//! A `Field` has key, label, help, kind, default, ranges and parameter code. The checks, the form on the page, the JSON Schema and the property-test strategies
//! are all read from the same list.

mod checker;
mod codes;
mod field;
mod finding;
mod value;

pub(crate) use checker::printable;
pub use codes::{CODES, STANDING};
pub use finding::{Finding, Level};
pub use value::Value;

pub(crate) use checker::{Checker, Section};
pub(crate) use field::form;
pub(crate) use field::{
    BestView, Choice, Code, Default, Field, Kind, LONGEST_LINE, MOST_LINES, PlacedLines,
    PlainValue, Range, SubForm, Values,
};

/// Takes the checked value of `field` out of a section.
pub(crate) fn take<T: field::FieldType>(section: &mut Section<'_, '_>, field: &'static Field) -> T {
    T::take(section, field)
}

/// A checked value in plain form.
pub(crate) fn shown<T: field::FieldType>(value: &T) -> PlainValue {
    value.shown()
}

/// A doc comment without its leading space.
pub(crate) const fn trimmed(text: &'static str) -> &'static str {
    match text.as_bytes() {
        [b' ', ..] => text.split_at(1).1,
        _ => text,
    }
}
