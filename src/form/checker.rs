//! Reads a loose form: every problem is reported with its path, and reading never stops at the first.

use crate::form::field::{FieldType, LONGEST_LINE, MOST_LINES, PlacedLines};
use crate::form::{
    Choice, Default, Field, Finding, Kind, Level, PlainValue, Range, SubForm, Value,
};
use crate::geom::{AXIS_NAMES, Vec3};
use crate::num::decimal;
use crate::text::{Part, Text, text, words};
use crate::tolerance::{self, Nominal};

/// Collects findings. Remembers the paths with errors, so that rules skip values that could not be read.
#[derive(Debug)]
pub struct Checker {
    /// Millimetres in one unit of length of the job.
    pub scale: f64,
    /// The unit's name, `mm` or `inch`.
    pub unit: &'static str,
    /// Name of the read object in messages.
    pub whole: &'static str,
    found: Vec<Finding>,
}

/// Largest number of listed findings; further ones are counted. Errors come before warnings, warnings before notes.
const MOST_FINDINGS: usize = 200;

/// A checker for a job in mm; set `scale` and `unit` after the job's units are known.
impl std::default::Default for Checker {
    fn default() -> Self {
        Checker {
            scale: 1.0,
            unit: "mm",
            whole: words!("the job"),
            found: Vec::new(),
        }
    }
}

impl Checker {
    /// A checker in the units of a known job: mm in a unit, and its name.
    pub fn in_units(scale: f64, unit: &'static str) -> Self {
        Checker {
            scale,
            unit,
            ..Checker::default()
        }
    }

    /// Name of a section in a message.
    fn place(&self, path: &str) -> Part {
        if path.is_empty() {
            Text::words(self.whole).into()
        } else {
            path.to_owned().into()
        }
    }

    /// The entries of a list; an absent list is empty. Reports any other value.
    pub fn list<'v>(&mut self, value: Option<&'v Value>, path: &str) -> Option<&'v [Value]> {
        match value {
            None => Some(&[]),
            Some(Value::List(list)) => Some(list),
            Some(other) => {
                let message = text!(
                    "{path} must be a list, not {given}",
                    self.place(path),
                    other.noun()
                );
                self.error("wrong-type", path, message);
                None
            }
        }
    }

    /// The entries of an object; an absent object is empty. Reports any other value.
    pub fn object<'v>(
        &mut self,
        value: Option<&'v Value>,
        path: &str,
    ) -> Option<&'v [(String, Value)]> {
        match value {
            None => Some(&[]),
            Some(Value::Map(entries)) => Some(entries),
            Some(other) => {
                let message = text!(
                    "{path} must be an object, not {given}",
                    self.place(path),
                    other.noun()
                );
                self.error("wrong-type", path, message);
                None
            }
        }
    }

    /// A text. Reports any other value.
    pub fn text<'v>(&mut self, value: &'v Value, path: &str) -> Option<&'v str> {
        if let Value::Text(text) = value {
            return Some(text);
        }
        let message = text!(
            "{path} must be text, not {given}",
            path.to_owned(),
            value.noun()
        );
        self.error("wrong-type", path, message);
        None
    }

    pub fn error(&mut self, code: &str, path: impl Into<String>, message: Text) {
        self.push(Level::Error, code, path, message);
    }

    pub fn warning(&mut self, code: &str, path: impl Into<String>, message: Text) {
        self.push(Level::Warning, code, path, message);
    }

    pub fn info(&mut self, code: &str, path: impl Into<String>, message: Text) {
        self.push(Level::Info, code, path, message);
    }

    fn push(&mut self, level: Level, code: &str, path: impl Into<String>, message: Text) {
        self.found.push(Finding::new(level, code, path, message));
    }

    /// Adds a finding from elsewhere.
    pub fn adopt(&mut self, finding: Finding) {
        self.found.push(finding);
    }

    pub fn count(&self) -> usize {
        self.found.len()
    }

    /// Whether there is a finding with this code.
    pub fn has(&self, code: &str) -> bool {
        self.found.iter().any(|f| f.code == code)
    }

    /// Whether there is a finding with this code at this path.
    pub fn has_at(&self, code: &str, path: &str) -> bool {
        self.found.iter().any(|f| f.code == code && f.path == path)
    }

    /// Whether there is a finding at this path.
    pub fn has_path(&self, path: &str) -> bool {
        self.found.iter().any(|f| f.path == path)
    }

    /// All findings in order. If there are too many to list, the last one gives the number of the others.
    pub fn findings(mut self) -> Vec<Finding> {
        const LEVELS: [Level; 3] = [Level::Error, Level::Warning, Level::Info];
        // Remaining room for each level, and the number of findings beyond the list.
        let mut room = [0; 3];
        let mut more = [0; 3];
        let mut left = MOST_FINDINGS;
        for (i, level) in LEVELS.into_iter().enumerate() {
            let count = self.found.iter().filter(|f| f.level == level).count();
            room[i] = count.min(left);
            more[i] = count - room[i];
            left -= room[i];
        }
        let Some(gravest) = more.iter().position(|n| *n > 0) else {
            return self.found;
        };
        self.found.retain(|f| {
            let room = &mut room[LEVELS
                .iter()
                .position(|l| *l == f.level)
                .expect("there are three levels")];
            let listed = *room > 0;
            *room -= usize::from(listed);
            listed
        });
        let [errors, warnings, notes] = more;
        let message = text!(
            "More was found than is listed: {errors} errors, {warnings} warnings and {notes} notes",
            errors,
            warnings,
            notes
        );
        self.found
            .push(Finding::new(LEVELS[gravest], "more-findings", "", message));
        self.found
    }

    /// Whether any finding so far is an error.
    pub fn failed(&self) -> bool {
        self.found.iter().any(|f| f.level == Level::Error)
    }

    /// Whether none of these paths, nor anything inside or around them, has an error.
    pub fn is_clean(&self, paths: &[&str]) -> bool {
        let inside = |long: &str, short: &str| {
            long.strip_prefix(short)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        let touched = |path: &str| {
            self.found.iter().any(|f| {
                f.level == Level::Error && (inside(&f.path, path) || inside(path, &f.path))
            })
        };
        !paths.iter().any(|path| touched(path))
    }

    /// A length in mm in the units of the job: `3.5 mm`, `0.1378 inch`.
    pub fn length(&self, mm: f64) -> String {
        format!("{} {}", self.number(mm), self.unit)
    }

    /// The unit of a kind of value, with a space before a word; empty if it has none.
    pub fn unit_of(&self, kind: Kind) -> String {
        match kind {
            Kind::Length | Kind::Point | Kind::Nominal | Kind::NominalPoint => {
                format!(" {}", self.unit)
            }
            Kind::Feed => format!(" {}/min", self.unit),
            Kind::Acceleration => format!(" {}/s²", self.unit),
            Kind::Time => " ms".to_owned(),
            Kind::Angle => "°".to_owned(),
            Kind::Count
            | Kind::Flag
            | Kind::Choice(_)
            | Kind::Code(_)
            | Kind::Text(_)
            | Kind::Lines(_) => String::new(),
        }
    }

    /// A length in mm, rounded up to the last shown decimal: it must not become smaller.
    pub fn rounded_up(&self, mm: f64) -> String {
        let step = if self.scale == 1.0 { 1e4 } else { 1e5 };
        self.length((mm / self.scale * step - 1e-3).ceil() / step * self.scale)
    }

    /// A length in mm as a bare number in the units of the job.
    pub fn number(&self, mm: f64) -> String {
        decimal(mm / self.scale, if self.scale == 1.0 { 4 } else { 5 })
    }

    /// A position in the units of the job, for a message: `X 1, Y 2, Z 3`.
    pub fn position(&self, mm: Vec3) -> String {
        let axis = |i: usize| format!("{} {}", AXIS_NAMES[i], self.number(mm[i]));
        [0, 1, 2].map(axis).join(", ")
    }
}

/// The known word that is most similar to a mistyped one. At most a quarter of the letters may differ; upper and lower case are the same, and two exchanged letters
/// count as one.
fn similar<'k>(word: &str, known: &[&'k str]) -> Option<&'k str> {
    // A longer text is not a mistyped key.
    if word.len() > 40 {
        return None;
    }
    let word = word.to_ascii_lowercase();
    let off = |known: &str| strsim::osa_distance(&word, &known.to_ascii_lowercase());
    let (off, near) = known.iter().map(|known| (off(known), *known)).min()?;
    (off <= (word.len() / 4).max(1) && off < near.len()).then_some(near)
}

/// An object of the job during reading.
#[derive(Debug)]
pub struct Section<'a, 'c> {
    pub checker: &'c mut Checker,
    value: Option<&'a Value>,
    path: &'a str,
}

impl<'a, 'c> Section<'a, 'c> {
    /// The object `value` at `path` (empty for the job itself). It may be absent; anything but an object is reported.
    pub fn new(checker: &'c mut Checker, value: Option<&'a Value>, path: &'a str) -> Self {
        let value = checker.object(value, path).and(value);
        Section {
            checker,
            value,
            path,
        }
    }

    /// The object itself, if it is one.
    pub fn value(&self) -> Option<&'a Value> {
        self.value
    }

    /// The loose value under a key.
    pub fn get(&self, key: &str) -> Option<&'a Value> {
        self.value.and_then(|v| v.get(key))
    }

    /// Reads an inner form; `None` if it may be null or absent and is.
    pub fn sub<T>(&mut self, form: &SubForm, read: fn(&mut Section<'_, '_>) -> T) -> Option<T> {
        let value = self.get(form.key);
        if form.optional && matches!(value, None | Some(Value::Null)) {
            return None;
        }
        let path = self.at(form.key);
        let mut section = Section::new(self.checker, value, &path);
        section.only(form.fields, &[]);
        Some(read(&mut section))
    }

    /// The full path of a key of this object.
    pub fn at(&self, key: &str) -> String {
        if self.path.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.path)
        }
    }

    /// Reports every key that is neither a field nor one of `others`.
    pub fn only(&mut self, fields: &[Field], others: &[&str]) {
        let Some(Value::Map(entries)) = self.value else {
            return;
        };
        for (key, _) in entries {
            let known = fields.iter().any(|f| f.key == key) || others.contains(&key.as_str());
            if !known {
                let names: Vec<&str> = fields
                    .iter()
                    .map(|f| f.key)
                    .chain(others.iter().copied())
                    .collect();
                let shown = printable(key);
                let place = self.checker.place(self.path);
                let message = match similar(key, &names) {
                    Some(near) => text!(
                        "{place} has no \"{key}\". Did you mean \"{near}\"?",
                        place,
                        shown.clone(),
                        near.to_owned()
                    ),
                    None => text!(
                        "{place} has no \"{key}\"; its keys are {keys}",
                        place,
                        shown.clone(),
                        names.join(", ")
                    ),
                };
                self.checker.error("unknown-key", self.at(&shown), message);
            }
        }
    }

    /// The number at `path`, finite and inside the ranges of the field, in mm, mm/min, degrees or whole.
    pub fn number(&mut self, value: &Value, field: &Field, path: &str) -> Option<f64> {
        let given = match (value, nominal_of(value, field, self.checker.scale)) {
            (Value::Number(given), _) => *given,
            (_, Some(Ok(given))) => given,
            (_, Some(Err(why))) => {
                let message = text!("{label}: {why}", field.label, why);
                self.checker.error("not-a-tolerance", path, message);
                return None;
            }
            _ => {
                let message = not_a_number(value, field);
                self.checker.error("wrong-type", path, message);
                return None;
            }
        };
        if !given.is_finite() {
            self.checker.error(
                "not-finite",
                path,
                text!("{label} must be a finite number", field.label),
            );
            return None;
        }
        let scale = match field.kind {
            Kind::Length
            | Kind::Feed
            | Kind::Acceleration
            | Kind::Point
            | Kind::Nominal
            | Kind::NominalPoint => self.checker.scale,
            Kind::Time
            | Kind::Angle
            | Kind::Count
            | Kind::Flag
            | Kind::Choice(_)
            | Kind::Code(_)
            | Kind::Text(_)
            | Kind::Lines(_) => 1.0,
        };
        if matches!(field.kind, Kind::Count | Kind::Code(_)) && given.fract() != 0.0 {
            self.checker.error(
                "not-whole",
                path,
                text!("{label} must be a whole number", field.label),
            );
            return None;
        }
        // The end of a range, converted to inch, is not exact.
        let inner = if scale == 1.0 {
            given
        } else {
            field.hard.snapped(given * scale)
        };
        let unit = self.checker.unit_of(field.kind);
        let number = |x: f64| decimal(x / scale, if scale == 1.0 { 4 } else { 5 });
        if !field.hard.holds(inner) {
            // Rounded inwards: a value that the message allows is allowed.
            let inwards = |x: f64, way: f64| {
                let shown = number(x);
                let off = crate::num::read(&shown).map_or(0.0, |shown| (shown * scale - x) * way);
                if off < 0.0 {
                    number(x + way * 1e-5 * scale)
                } else {
                    shown
                }
            };
            let (min, max) = (inwards(field.hard.min, 1.0), inwards(field.hard.max, -1.0));
            let allowed = if field.hard.above {
                text!("above {min} and at most {max}{unit}", min, max, unit)
            } else {
                text!("from {min} to {max}{unit}", min, max, unit)
            };
            let message = if field.reason.is_empty() {
                text!("{label} must be {allowed}", field.label, allowed)
            } else {
                text!(
                    "{label} must be {allowed}: {reason}",
                    field.label,
                    allowed,
                    field.reason
                )
            };
            self.checker.error("out-of-range", path, message);
            return None;
        }
        if let Some((min, max)) = field.usual
            && !(Range {
                min,
                max,
                above: false,
            })
            .nearly_holds(inner)
        {
            self.checker.warning(
                "unusual",
                path,
                text!(
                    "{label} is usually from {min} to {max}{unit}",
                    field.label,
                    number(min),
                    number(max),
                    unit
                ),
            );
        }
        Some(inner)
    }

    /// The nominal value at `path`: a number, or text in one of the forms of `tolerance`. In mm.
    pub fn nominal(&mut self, value: &Value, field: &Field, path: &str) -> Option<Nominal> {
        let Value::Text(text) = value else {
            return self.number(value, field, path).map(Nominal::number);
        };
        let scale = self.checker.scale;
        let parsed = match tolerance::parse(text, scale) {
            Ok(parsed) => parsed,
            Err(why) => {
                // If the value has no valid form, the message lists the forms already.
                let said = why.english().contains(tolerance::FORMS);
                let message = if said {
                    text!("{label}: {why}", field.label, why)
                } else {
                    text!(
                        "{label}: {why}. The forms are {forms}",
                        field.label,
                        why,
                        tolerance::FORMS.to_owned()
                    )
                };
                self.checker.error("not-a-value", path, message);
                return None;
            }
        };
        for number in [parsed.nominal, parsed.actual].into_iter().flatten() {
            self.number(&Value::Number(number), field, path)?;
        }
        Some(parsed.scaled(scale))
    }

    /// The number under the field's key; `None` for null; the default if it is missing.
    fn number_or_null(&mut self, field: &'static Field) -> Option<f64> {
        let stand_in = match field.default {
            Default::Number(x) => Some(x),
            Default::Null | Default::Flag(_) | Default::Text(_) | Default::Point(_) => None,
        };
        match self.get(field.key) {
            None => stand_in,
            Some(Value::Null) if field.null.is_some() => None,
            Some(value) => {
                let path = self.at(field.key);
                self.number(value, field, &path).or(stand_in)
            }
        }
    }
}

impl FieldType for Option<f64> {
    #[inline(never)]
    fn take(section: &mut Section<'_, '_>, field: &'static Field) -> Self {
        section.number_or_null(field)
    }

    fn shown(&self) -> PlainValue {
        self.map_or(PlainValue::Nothing, PlainValue::Number)
    }
}

impl FieldType for f64 {
    #[inline(never)]
    fn take(section: &mut Section<'_, '_>, field: &'static Field) -> Self {
        section
            .number_or_null(field)
            .expect("a field that is a number has a number as default")
    }

    fn shown(&self) -> PlainValue {
        PlainValue::Number(*self)
    }
}

impl FieldType for Nominal {
    #[inline(never)]
    fn take(section: &mut Section<'_, '_>, field: &'static Field) -> Self {
        let stand_in = match field.default {
            Default::Number(x) => Nominal::number(x),
            Default::Null | Default::Flag(_) | Default::Text(_) | Default::Point(_) => {
                Nominal::default()
            }
        };
        match section.get(field.key) {
            None => stand_in,
            Some(value) => {
                let path = section.at(field.key);
                section.nominal(value, field, &path).unwrap_or(stand_in)
            }
        }
    }
}

impl FieldType for [Nominal; 3] {
    #[inline(never)]
    fn take(section: &mut Section<'_, '_>, field: &'static Field) -> Self {
        let stand_in = default_point(field).map(Nominal::number);
        let path = section.at(field.key);
        match section.get(field.key) {
            None => stand_in,
            Some(Value::List(items)) if items.len() == 3 => {
                let mut point = stand_in;
                for (i, item) in items.iter().enumerate() {
                    if let Some(value) = section.nominal(item, field, &format!("{path}[{i}]")) {
                        point[i] = value;
                    }
                }
                point
            }
            Some(other) => {
                let message = text!(
                    "{label} must be a list of three values, not {given}",
                    field.label,
                    other.noun()
                );
                section.checker.error("wrong-type", path, message);
                stand_in
            }
        }
    }
}

/// Default of a point.
fn default_point(field: &Field) -> [f64; 3] {
    match field.default {
        Default::Point(point) => point,
        Default::Number(_) | Default::Flag(_) | Default::Text(_) | Default::Null => [0.0; 3],
    }
}

impl FieldType for i32 {
    #[inline(never)]
    fn take(section: &mut Section<'_, '_>, field: &'static Field) -> Self {
        f64::take(section, field) as i32
    }

    fn shown(&self) -> PlainValue {
        PlainValue::Whole(*self)
    }
}

impl FieldType for Option<i32> {
    #[inline(never)]
    fn take(section: &mut Section<'_, '_>, field: &'static Field) -> Self {
        section.number_or_null(field).map(|x| x as i32)
    }

    fn shown(&self) -> PlainValue {
        self.map_or(PlainValue::Nothing, PlainValue::Whole)
    }
}

impl FieldType for bool {
    #[inline(never)]
    fn take(section: &mut Section<'_, '_>, field: &'static Field) -> Self {
        let stand_in = matches!(field.default, Default::Flag(true));
        match section.get(field.key) {
            None => stand_in,
            Some(Value::Flag(b)) => *b,
            Some(other) => {
                let path = section.at(field.key);
                let message = text!(
                    "{label} must be true or false, not {given}",
                    field.label,
                    other.noun()
                );
                section.checker.error("wrong-type", path, message);
                stand_in
            }
        }
    }

    fn shown(&self) -> PlainValue {
        PlainValue::Flag(*self)
    }
}

impl FieldType for Vec3 {
    #[inline(never)]
    fn take(section: &mut Section<'_, '_>, field: &'static Field) -> Self {
        let stand_in = Vec3::from_array(default_point(field));
        let Some(value) = section.get(field.key) else {
            return stand_in;
        };
        let path = section.at(field.key);
        match value {
            Value::List(items) if items.len() == 3 => {
                let mut point = [0.0; 3];
                for (i, item) in items.iter().enumerate() {
                    point[i] = section
                        .number(item, field, &format!("{path}[{i}]"))
                        .unwrap_or(0.0);
                }
                Vec3::from_array(point)
            }
            other => {
                let what = match other {
                    Value::List(items) => text!("a list of {count}", items.len()),
                    _ => other.noun(),
                };
                let message = text!(
                    "{label} must be a list of three numbers [X, Y, Z], not {what}",
                    field.label,
                    what
                );
                section.checker.error("wrong-type", path, message);
                stand_in
            }
        }
    }
}

impl FieldType for String {
    #[inline(never)]
    fn take(section: &mut Section<'_, '_>, field: &'static Field) -> Self {
        let stand_in = || match field.default {
            Default::Text(text) => text.to_owned(),
            Default::Number(_) | Default::Flag(_) | Default::Point(_) | Default::Null => {
                String::new()
            }
        };
        let path = section.at(field.key);
        match (section.get(field.key), field.kind) {
            (None, _) => stand_in(),
            (Some(Value::Text(text)), Kind::Choice(choices)) => {
                if choices.iter().any(|c| c.value == text) {
                    return text.clone();
                }
                let words: Vec<String> =
                    choices.iter().map(|c| format!("\"{}\"", c.value)).collect();
                let message = text!(
                    "{label} must be one of {words}, not \"{text}\"",
                    field.label,
                    words.join(", "),
                    printable(text)
                );
                section.checker.error("unknown-value", path, message);
                stand_in()
            }
            (Some(Value::Text(text)), _) => {
                if text.chars().count() as f64 > field.hard.max {
                    let message = text!(
                        "{label} may have {max} characters at most",
                        field.label,
                        decimal(field.hard.max, 0)
                    );
                    section.checker.error("too-long", path, message);
                    return stand_in();
                }
                text.clone()
            }
            (Some(other), _) => {
                let message = text!(
                    "{label} must be text, not {given}",
                    field.label,
                    other.noun()
                );
                section.checker.error("wrong-type", path, message);
                stand_in()
            }
        }
    }
}

impl FieldType for PlacedLines {
    #[inline(never)]
    fn take(section: &mut Section<'_, '_>, field: &'static Field) -> Self {
        let (Kind::Lines(places), Some(given @ Value::Map(_))) =
            (field.kind, section.get(field.key))
        else {
            let given = section
                .get(field.key)
                .filter(|given| **given != Value::Null);
            let path = section.at(field.key);
            section.checker.object(given, &path);
            return PlacedLines::default();
        };
        let path = section.at(field.key);
        let keys: Vec<&str> = places.iter().map(|place| place.value).collect();
        Section::new(section.checker, Some(given), &path).only(&[], &keys);
        let lines = |place: &Choice| {
            let path = format!("{path}.{}", place.value);
            let given = given.given(place.value);
            let lines = section.checker.list(given, &path)?;
            if lines.len() > MOST_LINES {
                let message = text!(
                    "{path} may have {max} lines at most",
                    path.clone(),
                    MOST_LINES
                );
                section.checker.error("too-long", path, message);
                return None;
            }
            let lines: Option<Vec<String>> = lines
                .iter()
                .enumerate()
                .map(|(i, line)| program_line(section.checker, line, &format!("{path}[{i}]")))
                .collect();
            lines
                .filter(|lines| !lines.is_empty())
                .map(|lines| (place.value, lines))
        };
        PlacedLines(places.iter().filter_map(lines).collect())
    }
}

/// One line of a program; `None` if it is wrong.
fn program_line(checker: &mut Checker, value: &Value, path: &str) -> Option<String> {
    let line = checker.text(value, path)?;
    if line.chars().count() > LONGEST_LINE {
        let message = text!(
            "{label} may have {max} characters at most",
            path.to_owned(),
            LONGEST_LINE
        );
        checker.error("too-long", path, message);
        return None;
    }
    if let Some(wrong) = line.chars().find(|c| !(' '..='~').contains(c)) {
        let message = text!(
            "A line of a program has printable ASCII characters only, not \"{wrong}\"",
            printable(&wrong.to_string())
        );
        checker.error("line-characters", path, message);
        return None;
    }
    Some(line.to_owned())
}

/// Nominal value of a size with a tolerance; `None` for any other value.
fn nominal_of(value: &Value, field: &Field, scale: f64) -> Option<Result<f64, Text>> {
    let Value::Text(text) = value else {
        return None;
    };
    let classes = match field.kind {
        Kind::Length if field.size => Some(scale),
        Kind::Angle if field.size => None,
        _ => return None,
    };
    if text.chars().count() > tolerance::LONGEST {
        return None;
    }
    Some(tolerance::size(text, classes)?.map(|(nominal, _)| nominal))
}

/// Message for a value that should be a number.
fn not_a_number(value: &Value, field: &Field) -> Text {
    if let Value::Text(text) = value
        && let Some(nominal) = tolerance::toleranced(text)
    {
        if field.size {
            return text!(
                "{label} may have {max} characters at most",
                field.label,
                tolerance::LONGEST.to_string()
            );
        }
        return text!(
            "{label} has no tolerance, but \"{text}\" reads as one: enter only {nominal}, or a sum as one number",
            field.label,
            printable(text),
            decimal(nominal, 6)
        );
    }
    if let Value::Text(text) = value {
        return not_read(text.trim(), field);
    }
    if field.null.is_some() {
        text!(
            "{label} must be a number or null, not {given}",
            field.label,
            value.noun()
        )
    } else {
        text!(
            "{label} must be a number, not {given}",
            field.label,
            value.noun()
        )
    }
}

/// Reason why a text in the place of a number cannot be read, and what to enter.
fn not_read(text: &str, field: &Field) -> Text {
    let label = field.label;
    if text.is_empty() {
        return text!("{label} must be a number, not empty", label);
    }
    let shown = printable(text);
    let plain = text.trim_start_matches(['+', '-', '\u{2212}']);
    let digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    // `1,000` or `1.000`, if the sign is not the decimal sign.
    if let Some((whole, zeros)) = plain
        .split_once([',', '.'])
        .filter(|(whole, rest)| digits(whole) && *rest == "000")
    {
        return text!(
            "{label} must be a number, not \"{text}\": it may be a thousand or a decimal, enter {thousands} or {whole}",
            label,
            shown,
            format!("{whole}{zeros}"),
            whole.to_owned()
        );
    }
    // `1-1/2`: inches as on a drawing, or a difference.
    if let Some((whole, fraction)) = plain.split_once('-').filter(|(whole, _)| digits(whole))
        && let Some((over, under)) = fraction
            .split_once('/')
            .filter(|(over, under)| digits(over) && digits(under))
    {
        return text!(
            "{label} must be a number, not \"{text}\": it may be a mixed fraction or a difference, enter {mixed} or {difference}",
            label,
            shown,
            format!("{whole} {over}/{under}"),
            format!("{whole} - {over}/{under}")
        );
    }
    if plain.ends_with("/0") {
        return text!(
            "{label} must be a number, not \"{text}\": it divides by zero",
            label,
            shown
        );
    }
    if plain
        .split_once(['x', 'X'])
        .is_some_and(|(one, other)| digits(one.trim()) && digits(other.trim()))
    {
        return text!(
            "{label} must be a number, not \"{text}\": enter * to multiply",
            label,
            shown
        );
    }
    if field.size {
        return text!(
            "{label} must be a number, not \"{text}\", or a number with a tolerance: 25 H7, 25 +0.021 0 or 25 ±0.05",
            label,
            shown
        );
    }
    text!("{label} must be a number, not \"{text}\"", label, shown)
}

/// A user's text, shortened and without control characters, for a message.
pub(crate) fn printable(text: &str) -> String {
    let mut shown: String = text
        .chars()
        .take(40)
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect();
    if text.chars().nth(40).is_some() {
        shown.push('…');
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::similar;

    #[test]
    fn a_mistyped_key_has_a_similar_one_and_another_word_has_none() {
        let known = ["diameter", "depth", "length", "type", "post"];
        for (typed, meant) in [
            ("diamter", Some("diameter")),
            ("lenght", Some("length")),
            ("Depth", Some("depth")),
            ("pots", Some("post")),
            ("speed", None),
            ("x", None),
            ("", None),
        ] {
            assert_eq!(similar(typed, &known), meant, "{typed}");
        }
        assert_eq!(similar(&"diameter".repeat(10_000), &known), None);
        assert_eq!(similar("y", &["x"]), None, "no letter is left");
    }
}
