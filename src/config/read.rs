//! Reads a config and reports all its problems at once, as for a job.

use crate::config::allow::{Allow, check_hide};
use crate::config::list::{MOST, entries};
use crate::config::space::{Space, Zone};
use crate::config::{Config, Rule, fill};
use crate::cycle::CYCLES;
use crate::form::{Checker, Choice, Field, Finding, Kind, Level, Section, Value, form, printable};
use crate::geom::Vec3;
use crate::job::{FORMAT, Job, JobError, SECTIONS, STOCK, UNITS, Units};
use crate::text::{text, words};

const LEVELS: &[Choice] = &[
    Choice {
        value: "error",
        label: "error",
    },
    Choice {
        value: "warning",
        label: "warning",
    },
    Choice {
        value: "info",
        label: "info",
    },
];

form! {
    struct Head {
        title: String = Field::text("title", "Title", "", 60),
        units: String = Field::choice("units", "Units", UNITS),
    }
}

form! {
    struct RuleForm {
        locked: bool = Field::flag("locked", "Locked", false),
        _hidden: bool = Field::flag("hidden", "Hidden", false),
        min: Option<f64> = Field::angle("min", "min", 0.0).range(-1e9, 1e9).null_by_default(),
        max: Option<f64> = Field::angle("max", "max", 0.0).range(-1e9, 1e9).null_by_default(),
        reason: String = Field::text("reason", "Reason", "", 200),
    }
}

form! {
    struct ZoneForm {
        name: String = Field::text("name", "Name", "", 60),
        min: Vec3 = Field::point("min", "Lower corner"),
        max: Vec3 = Field::point("max", "Upper corner"),
    }
}

form! {
    struct OriginForm {
        zero: Vec3 = Field::point("zero", "Work zero"),
    }
}

form! {
    struct FindingForm {
        level: String = Field::choice("level", "Level", LEVELS),
        path: String = Field::text("path", "Path", "", 200),
        message: String = Field::text("message", "Message", "", 1000),
    }
}

/// See [`Config::read`].
pub fn read(value: &Value) -> Result<Config, JobError> {
    let mut checker = Checker::default();
    checker.whole = words!("the config");
    if let Value::Map(_) = value {
        let known = matches!(value.get("format"), Some(Value::Number(n)) if *n == FORMAT);
        if !known {
            checker.error(
                "unknown-value",
                "format",
                text!("A config must specify its format: 1"),
            );
        }
    }
    let units = Units::of(value);
    (checker.scale, checker.unit) = (units.scale(), units.word());
    let mut section = Section::new(&mut checker, Some(value), "");
    section.only(
        Head::FIELDS,
        &[
            "format", "allow", "hide", "fields", "machines", "styli", "space", "findings",
        ],
    );
    let head = Head::read(&mut section);
    let allow = Allow::read(&mut checker, value.get("allow"));
    check_hide(&mut checker, value.get("hide"));
    let rules = read_rules(&mut checker, value.get("fields"));
    read_machines(&mut checker, value.get("machines"), units);
    read_styli(&mut checker, value.get("styli"), units);
    allow.check_choices(&mut checker, value);
    let space = read_space(&mut checker, value.get("space"));
    let own = read_findings(&mut checker, value.get("findings"));
    let title = (!head.title.is_empty()).then(|| printable_title(&head.title));
    let config = Config {
        title,
        units,
        allow,
        rules,
        space,
        own,
    };
    check_values(&mut checker, &config);
    if !checker.failed() {
        return Ok(config);
    }
    let under = |finding: Finding| {
        let path = if finding.path.is_empty() {
            "config".to_owned()
        } else {
            format!("config.{}", finding.path)
        };
        Finding { path, ..finding }
    };
    Err(JobError {
        findings: checker.findings().into_iter().map(under).collect(),
    })
}

fn printable_title(title: &str) -> String {
    title
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}

/// Whether a text has no visible character.
fn is_blank(text: &str) -> bool {
    text.chars().all(|c| c.is_whitespace() || c == '\u{feff}')
}

fn read_rules(checker: &mut Checker, value: Option<&Value>) -> Vec<Rule> {
    let Some(Value::Map(all)) = Section::new(checker, value, "fields").value() else {
        return Vec::new();
    };
    if all.len() > MOST {
        checker.error(
            "too-long",
            "fields",
            text!(
                "{path} may have {most} entries, not {count}",
                "fields".to_owned(),
                MOST,
                all.len()
            ),
        );
        return Vec::new();
    }
    let mut rules = Vec::new();
    for (path, given) in all {
        let shown = printable(path);
        let at = format!("fields.{shown}");
        let fields: Vec<&Field> = CYCLES
            .iter()
            .filter_map(|def| super::field_at(path, def))
            .collect();
        let chosen = [
            "units",
            "control.post",
            "control.form",
            "control.workOffset",
        ]
        .contains(&path.as_str());
        let Some(field) = fields.first() else {
            let message = text!(
                "\"{path}\" is no field of a job: a path is like feeds.work, control.tool or cycle.depth",
                shown
            );
            checker.error("unknown-key", at, message);
            continue;
        };
        let mut section = Section::new(checker, Some(given), &at);
        section.only(RuleForm::FIELDS, &["value"]);
        let form = RuleForm::read(&mut section);
        let value = given.get("value").cloned();
        let number = !matches!(
            field.kind,
            Kind::Flag
                | Kind::Choice(_)
                | Kind::Text(_)
                | Kind::Point
                | Kind::NominalPoint
                | Kind::Lines(_)
        );
        if chosen
            && (form.locked
                || form.min.is_some()
                || form.max.is_some()
                || (path == "units" && value.is_some()))
        {
            let message = text!(
                "Limit this choice in allow: here only value and hidden can be given, for units only hidden"
            );
            checker.error("unknown-key", at, message);
        } else if !number && (form.min.is_some() || form.max.is_some()) {
            checker.error(
                "wrong-type",
                at,
                text!(
                    "{label} is no number: it has neither min nor max",
                    field.label
                ),
            );
        } else if form.min.zip(form.max).is_some_and(|(min, max)| min > max) {
            checker.error("out-of-range", at, text!("min is above max"));
        } else if let Some(Value::Number(x)) = value
            && (form.min.is_some_and(|min| x < min) || form.max.is_some_and(|max| x > max))
        {
            checker.error(
                "out-of-range",
                format!("{at}.value"),
                text!("The value must be within min and max"),
            );
        }
        rules.push(Rule {
            path: path.clone(),
            value,
            locked: form.locked,
            least: form.min,
            most: form.max,
            reason: printable_title(&form.reason),
        });
    }
    rules
}

/// Reports values that no job may have at their paths.
fn check_values(checker: &mut Checker, config: &Config) {
    for def in CYCLES {
        let job = fill::values(config, def, config.units);
        for rule in &config.rules {
            let at = format!("fields.{}.value", rule.path);
            let wrong = |finding: &Finding| {
                let inner = finding.path.strip_prefix(&rule.path);
                inner.is_some_and(|inner| inner.is_empty() || inner.starts_with(['[', '.']))
            };
            if rule.value.is_some()
                && super::field_at(&rule.path, def).is_some()
                && !checker.has_path(&at)
            {
                misread(&job, config.units)
                    .into_iter()
                    .filter(wrong)
                    .for_each(|finding| {
                        checker.adopt(Finding {
                            path: at.clone(),
                            ..finding
                        });
                    });
            }
        }
    }
}

/// Errors of single values in a part of a job.
fn misread(job: &Value, units: Units) -> Vec<Finding> {
    const OF_VALUES: [&str; 9] = [
        "line-characters",
        "not-a-value",
        "not-finite",
        "not-whole",
        "out-of-range",
        "too-long",
        "unknown-key",
        "unknown-value",
        "wrong-type",
    ];
    let Value::Map(mut entries) = job.clone() else {
        return Vec::new();
    };
    entries.push(("format".to_owned(), Value::Number(FORMAT)));
    entries.push(("units".to_owned(), Value::Text(units.word().to_owned())));
    let mut checker = Checker::default();
    let _ = Job::read(&mut checker, &Value::Map(entries));
    let mut found = checker.findings();
    found.retain(|finding| {
        finding.level == Level::Error && OF_VALUES.contains(&finding.code.as_str())
    });
    found
}

/// Checks a part of a job against the forms of a job.
fn read_part(checker: &mut Checker, at: &str, part: Vec<(String, Value)>, units: Units) {
    let cycle = Value::Map(vec![("type".to_owned(), Value::Text("hole".to_owned()))]);
    let job = Value::Map(
        part.into_iter()
            .chain([("cycle".to_owned(), cycle)])
            .collect(),
    );
    for finding in misread(&job, units) {
        checker.adopt(Finding {
            path: format!("{at}.{}", finding.path),
            ..finding
        });
    }
}

fn read_name(checker: &mut Checker, entry: &Value, at: &str) {
    if !matches!(entry.get("name"), Some(Value::Text(name)) if !is_blank(name) && name.chars().count() <= 60)
    {
        let message = text!(
            "{path} must have a name of 60 characters at most",
            at.to_owned()
        );
        checker.error("missing", format!("{at}.name"), message);
    }
}

/// Reads machines: the parts of a job that belong to one.
fn read_machines(checker: &mut Checker, value: Option<&Value>, units: Units) {
    for (at, machine) in entries(checker, value, "machines") {
        let sections = SECTIONS
            .iter()
            .map(|section| section.key)
            .filter(|name| !["", "part", STOCK.key].contains(name));
        let known: Vec<&str> = sections.chain(["name", "overtravel"]).collect();
        Section::new(checker, Some(machine), &at).only(&[], &known);
        read_name(checker, machine, &at);
        let Value::Map(entries) = machine else {
            continue;
        };
        let part = entries
            .iter()
            .filter(|(key, _)| key != "name" && known.contains(&key.as_str()))
            .cloned();
        read_part(checker, &at, part.collect(), units);
    }
}

/// Reads styli: the parts of a job that belong to one.
fn read_styli(checker: &mut Checker, value: Option<&Value>, units: Units) {
    for (at, stylus) in entries(checker, value, "styli") {
        Section::new(checker, Some(stylus), &at);
        read_name(checker, stylus, &at);
        let Value::Map(entries) = stylus else {
            continue;
        };
        let part: Vec<(String, Value)> = entries
            .iter()
            .filter(|(key, _)| key != "name")
            .cloned()
            .collect();
        let mut inner = Checker::default();
        read_part(
            &mut inner,
            &at,
            vec![("stylus".to_owned(), Value::Map(part))],
            units,
        );
        for finding in inner.findings() {
            checker.adopt(Finding {
                path: finding.path.replacen(".stylus", "", 1),
                ..finding
            });
        }
    }
}

fn read_space(checker: &mut Checker, value: Option<&Value>) -> Space {
    let mut section = Section::new(checker, value, "space");
    section.only(OriginForm::FIELDS, &["travel", "keepOut"]);
    let zero = OriginForm::read(&mut section).zero;
    let get = |key: &str| value.and_then(|value| value.get(key));
    let travel = get("travel").map(|travel| read_zone(checker, travel, "space.travel", false));
    let zones = entries(checker, get("keepOut"), "space.keepOut");
    let mut keep_out: Vec<Zone> = zones
        .into_iter()
        .map(|(at, zone)| read_zone(checker, zone, &at, true))
        .collect();
    let mut travel = travel;
    for zone in keep_out.iter_mut().chain(&mut travel) {
        (zone.min, zone.max) = (zone.min - zero, zone.max - zero);
    }
    Space { travel, keep_out }
}

fn read_zone(checker: &mut Checker, value: &Value, at: &str, named: bool) -> Zone {
    let fields = if named {
        ZoneForm::FIELDS
    } else {
        &ZoneForm::FIELDS[1..]
    };
    let mut section = Section::new(checker, Some(value), at);
    section.only(fields, &[]);
    let form = ZoneForm::read(&mut section);
    for corner in ["min", "max"] {
        if value.get(corner).is_none() {
            let message = text!(
                "{path} must have min and max, each [X, Y, Z]",
                at.to_owned()
            );
            checker.error("missing", format!("{at}.{corner}"), message);
        }
    }
    if named {
        read_name(checker, value, at);
    }
    if form.min.cmpgt(form.max).any() {
        checker.error("out-of-range", at, text!("min is above max"));
    }
    Zone {
        name: printable_title(&form.name),
        min: form.min,
        max: form.max,
    }
}

fn read_findings(checker: &mut Checker, value: Option<&Value>) -> Vec<Finding> {
    let mut found = Vec::new();
    for (at, given) in entries(checker, value, "findings") {
        let mut section = Section::new(checker, Some(given), &at);
        section.only(FindingForm::FIELDS, &[]);
        let form = FindingForm::read(&mut section);
        if is_blank(&form.message) {
            checker.error(
                "missing",
                format!("{at}.message"),
                text!("{path} must have a message", at.clone()),
            );
        }
        let level = match form.level.as_str() {
            "warning" => Level::Warning,
            "info" => Level::Info,
            _ => Level::Error,
        };
        found.push(Finding::new(
            level,
            "portal",
            form.path,
            text!("{message}", printable_title(&form.message)),
        ));
    }
    found
}
