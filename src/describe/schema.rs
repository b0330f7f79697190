//! The JSON Schema of a job, read from the one list of fields.
//!
//! It gives the structure of a job and every range, in both units. Rules on several fields or on a text are known only to the check:
//! `tests/package/schema.test.mjs` lists the codes of those findings.

use crate::cycle::{CYCLES, CycleDef, HIGHEST_CODE, LONGEST_VECTOR, MOST_CODES, POINT};
use crate::form::{Field, Kind, LONGEST_LINE, MOST_LINES, Range, Value};
use crate::formula::{self, ToleranceAction};
use crate::job::{
    CLEAR, DATUM, FORMAT, LONGEST_NAME, LONGEST_PLACE, MOST_CYCLES, MOST_STEPS, RELATIONS,
    SECTIONS, SET_UP_FORMAT, STEP_ANGLE, TOLERANCES, WEAR, size_reach,
};
use crate::num::decimal;
use crate::path::MAX_TOUCHES;

/// JSON Schema (2020-12) of a job.
pub fn job_schema() -> Value {
    let formats = [FORMAT, SET_UP_FORMAT].map(Value::Number).to_vec();
    let mut properties = vec![("format".to_owned(), map([("enum", Value::List(formats))]))];
    for form in SECTIONS {
        let own = form.fields.iter().map(|f| (f.key.to_owned(), field(f)));
        match form.key {
            "" => properties.extend(own),
            "part" => {
                let sizes = map([
                    ("type", text("object")),
                    ("additionalProperties", map([("type", text("number"))])),
                ]);
                properties.push((
                    "part".to_owned(),
                    object(own.chain([("sizes".to_owned(), sizes)]), &[]),
                ));
            }
            "tool" => properties.push((
                "tool".to_owned(),
                object(own.chain([("frame".to_owned(), frame())]), &[]),
            )),
            path => {
                let section = object(own, &[]);
                let value = if form.optional {
                    nullable(section)
                } else {
                    section
                };
                properties.push((path.to_owned(), value));
            }
        }
    }
    let cycles = CYCLES.iter().map(|def| cycle(def, Vec::new())).collect();
    properties.push(("cycle".to_owned(), map([("oneOf", Value::List(cycles))])));
    properties.push((TOLERANCES.to_owned(), tolerances()));
    properties.extend(set_up());
    let Value::Map(job) = object(properties, &["format"]) else {
        unreachable!("an object is a map")
    };
    let head = [
        (
            "$schema".to_owned(),
            text("https://json-schema.org/draft/2020-12/schema"),
        ),
        (
            "$id".to_owned(),
            text(&format!("urn:touchpath:job:{}", decimal(FORMAT, 0))),
        ),
        ("title".to_owned(), text("A probing job")),
    ];
    let inch = object_of([("units", map([("const", text("inch"))]))], &["units"]);
    let ends = [
        ("if".to_owned(), inch),
        ("then".to_owned(), ranges(25.4)),
        ("else".to_owned(), ranges(1.0)),
    ];
    let either = [
        object_of(
            [
                ("format", map([("const", Value::Number(FORMAT))])),
                ("cycles", Value::Flag(false)),
            ],
            &["cycle"],
        ),
        object_of(
            [
                ("format", map([("const", Value::Number(SET_UP_FORMAT))])),
                ("cycle", Value::Flag(false)),
            ],
            &["cycles"],
        ),
    ];
    let either = [("oneOf".to_owned(), Value::List(either.to_vec()))];
    Value::Map(
        head.into_iter()
            .chain(job)
            .chain(either)
            .chain(ends)
            .collect(),
    )
}

/// Tolerances of results. The available results depend on the cycle.
fn tolerances() -> Value {
    let actions = ToleranceAction::ALL.map(|(word, _)| text(word)).to_vec();
    let own = object(
        [
            (
                "tolerance".to_owned(),
                map([
                    ("type", text("string")),
                    ("maxLength", Value::Number(crate::tolerance::LONGEST as f64)),
                    (
                        "description",
                        text(
                            "About the nominal value (H7, ±0.02, +0.021/0) or with it (25H7, 24.98..25.02). Omit it if the size contains the tolerance.",
                        ),
                    ),
                ]),
            ),
            (
                "action".to_owned(),
                map([
                    ("enum", Value::List(actions)),
                    (
                        "description",
                        text(
                            "What the program does with a result out of it: nothing, show it, or stop. Left out: go.",
                        ),
                    ),
                ]),
            ),
            (WEAR.key.to_owned(), wear()),
        ],
        &[],
    );
    nullable(map([
        ("type", text("object")),
        ("additionalProperties", own),
        (
            "description",
            text(
                "The tolerance of each result by its code, as `diameter`; in a set-up `BORE.diameter`.",
            ),
        ),
    ]))
}

/// Form of the tool that is corrected by a size.
fn wear() -> Value {
    let own = WEAR.fields.iter().map(|f| (f.key.to_owned(), field(f)));
    let Value::Map(mut own) = object(own, &["tool"]) else {
        unreachable!("an object is a map")
    };
    own.push((
        "description".to_owned(),
        text("The tool that the macro of a Fanuc and its kin corrects by this size."),
    ));
    nullable(Value::Map(own))
}

/// The cycle in a set-up: each coordinate of its origin, its rotation and its sizes may follow a result.
fn following(mut cycle: Value, def: &CycleDef) -> Value {
    let inner = |value: &mut Value, key: &str, change: &dyn Fn(&mut Value)| {
        if let Value::Map(entries) = value {
            entries
                .iter_mut()
                .filter(|(known, _)| known == key)
                .for_each(|(_, value)| change(value));
        }
    };
    let place = map([
        ("type", Value::List(["number", "string"].map(text).to_vec())),
        ("pattern", text("^ *=")),
        ("maxLength", Value::Number(LONGEST_PLACE as f64)),
        (
            "description",
            text(
                "A number, or a place that an earlier cycle measures with a number added: `=TOP.z-5`.",
            ),
        ),
    ]);
    let or_text = |value: &mut Value, example: &str| {
        let Value::Map(entries) = value else { return };
        entries.retain(|(key, _)| !matches!(key.as_str(), "maxLength" | "pattern"));
        for (key, value) in entries.iter_mut() {
            match (key.as_str(), value) {
                ("type", value) => *value = Value::List(["number", "string"].map(text).to_vec()),
                ("description", Value::Text(help)) => help.push_str(&format!(
                    " It may follow a result of an earlier cycle: `{example}`."
                )),
                _ => {}
            }
        }
        entries.push(("maxLength".to_owned(), Value::Number(LONGEST_PLACE as f64)));
    };
    inner(&mut cycle, "properties", &|properties| {
        inner(properties, "origin", &|origin| {
            inner(origin, "items", &|items| items.clone_from(&place))
        });
        inner(properties, "rotation", &|rotation| {
            or_text(rotation, "=SIDE.rotation+90");
            if let Value::Map(entries) = rotation {
                entries.push(("pattern".to_owned(), text("^ *=")));
            }
        });
        for size in def
            .fields
            .iter()
            .filter(|field| field.size && field.kind == Kind::Length)
        {
            inner(properties, size.key, &|value| {
                or_text(value, "=BORE.diameter-2");
                if let Value::Map(entries) = value {
                    let either = text(&format!("^ *=|^{TOLERANCED}$"));
                    entries.push(("pattern".to_owned(), either));
                }
            });
        }
    });
    cycle
}

/// Additional entries of a job with several cycles.
fn set_up() -> [(String, Value); 4] {
    let pattern = format!("^[A-Za-z][A-Za-z0-9]{{0,{}}}$", LONGEST_NAME - 1);
    let name = map([
        ("type", Value::List(vec![text("string"), text("null")])),
        ("pattern", text(&pattern)),
        (
            "description",
            text(
                "Its name, which programs print in front of its results. Left out: what it measures.",
            ),
        ),
    ]);
    let measures = CYCLES.iter().filter(|def| def.most_touches > 0);
    let cycles = measures
        .map(|def| following(cycle(def, vec![("name".to_owned(), name.clone())]), def))
        .collect();
    let list = map([
        ("type", text("array")),
        ("items", map([("oneOf", Value::List(cycles))])),
        ("minItems", Value::Number(1.0)),
        ("maxItems", Value::Number(MOST_CYCLES as f64)),
        (
            "description",
            text(
                "The cycles of one program, in their order. Format 2 has them in place of `cycle`.",
            ),
        ),
    ]);
    let result = || nullable(map([("type", text("string"))]));
    let datum = object(DATUM.map(|key| (key.to_owned(), result())), &[]);
    let Value::Map(mut datum) = datum else {
        unreachable!("an object is a map")
    };
    datum.push((
        "description".to_owned(),
        text(
            "Which result is written into which axis of the work offset, as `BORE.center.x`; x is the abscissa, y the ordinate, z the tool axis. Left out: the first cycle that measures it. Null: not written. A rotation is written where one is named.",
        ),
    ));
    let types = formula::RELATIONS.iter().map(|def| text(def.key)).collect();
    let relation = object(
        [
            (
                "name".to_owned(),
                map([("type", text("string")), ("pattern", text(&pattern))]),
            ),
            ("type".to_owned(), map([("enum", Value::List(types))])),
            (
                "of".to_owned(),
                map([
                    ("type", text("array")),
                    ("items", map([("type", text("string"))])),
                    ("minItems", Value::Number(2.0)),
                    ("maxItems", Value::Number(MOST_CYCLES as f64)),
                    (
                        "description",
                        text(
                            "Names of cycles that measure a place; of a difference or mean, results as `BORE.diameter`.",
                        ),
                    ),
                ]),
            ),
        ],
        &["name", "type", "of"],
    );
    let relations = nullable(map([
        ("type", text("array")),
        ("items", relation),
        ("maxItems", Value::Number(MOST_CYCLES as f64)),
        (
            "description",
            text(
                "What is computed of the results of the cycles: distance and direction of a line, difference, mean, centre, pitch circle.",
            ),
        ),
    ]));
    [
        ("cycles".to_owned(), list),
        (RELATIONS.to_owned(), relations),
        ("clear".to_owned(), field(&CLEAR)),
        ("datum".to_owned(), nullable(Value::Map(datum))),
    ]
}

/// Ranges of lengths and feeds of a whole job. `scale` is mm in a unit.
fn ranges(scale: f64) -> Value {
    let mut properties = Vec::new();
    for form in SECTIONS {
        match form.key {
            "" => properties.extend(ends(form.fields, scale)),
            path => properties.extend(inside(path.to_owned(), ends(form.fields, scale))),
        }
    }
    let cycle = |def: &&CycleDef| {
        let mut own = ends(def.fields, scale);
        for section in def.sections {
            own.extend(inside(section.key.to_owned(), ends(section.fields, scale)));
        }
        if def.place.is_some() {
            let points = ends(&[POINT], scale);
            own.push((
                "touches".to_owned(),
                map([("items", map([("properties", Value::Map(points))]))]),
            ));
        }
        let kind = object_of([("type", map([("const", text(def.key))]))], &["type"]);
        (!own.is_empty()).then(|| {
            map([
                ("if", kind),
                ("then", map([("properties", Value::Map(own))])),
            ])
        })
    };
    let cycles: Vec<Value> = CYCLES.iter().filter_map(cycle).collect();
    properties.push((
        "cycle".to_owned(),
        map([("allOf", Value::List(cycles.clone()))]),
    ));
    properties.push((
        "cycles".to_owned(),
        map([("items", map([("allOf", Value::List(cycles))]))]),
    ));
    properties.extend(ends(&[CLEAR], scale));
    let own = map([(
        "properties",
        Value::Map(
            inside(WEAR.key.to_owned(), ends(WEAR.fields, scale))
                .into_iter()
                .collect(),
        ),
    )]);
    properties.push((TOLERANCES.to_owned(), map([("additionalProperties", own)])));
    let sizes = CYCLES.iter().map(|def| sizes(def, scale)).collect();
    map([
        ("properties", Value::Map(properties)),
        ("allOf", Value::List(sizes)),
    ])
}

/// Sizes of the virtual part: those of its cycle.
fn sizes(def: &CycleDef, scale: f64) -> Value {
    let reach: Vec<Field> = def
        .fields
        .iter()
        .filter(|field| field.size)
        .map(size_reach)
        .collect();
    let angles = reach
        .iter()
        .filter(|field| field.kind == Kind::Angle)
        .map(|f| (f.key.to_owned(), self::field(f)));
    let own = Value::Map(ends(&reach, scale).into_iter().chain(angles).collect());
    let sizes = map([
        ("properties", own),
        ("additionalProperties", Value::Flag(false)),
    ]);
    let part = map([("properties", map([("sizes", sizes)]))]);
    let kind = object_of([("type", map([("const", text(def.key))]))], &["type"]);
    map([
        ("if", object_of([("cycle", kind)], &["cycle"])),
        ("then", map([("properties", map([("part", part)]))])),
    ])
}

/// Fields of an inner object; `None` if it has none.
fn inside(key: String, own: Vec<(String, Value)>) -> Option<(String, Value)> {
    (!own.is_empty()).then(|| (key, map([("properties", Value::Map(own))])))
}

/// Ranges of the fields that have units.
fn ends(fields: &[Field], scale: f64) -> Vec<(String, Value)> {
    let range = |field: &Field| {
        let Range { min, max, above } = field.hard;
        // As in the check: a converted value may exceed an end by the rounding of its last decimal.
        let noise = if scale == 1.0 { 0.0 } else { Range::NOISE };
        let low = if above {
            ("exclusiveMinimum", min)
        } else {
            ("minimum", min - noise)
        };
        map([low, ("maximum", max + noise)].map(|(word, end)| (word, Value::Number(end / scale))))
    };
    let of = |field: &Field| match field.kind {
        Kind::Length | Kind::Feed | Kind::Acceleration | Kind::Nominal => Some(range(field)),
        Kind::Point | Kind::NominalPoint => Some(map([("items", range(field))])),
        Kind::Time
        | Kind::Angle
        | Kind::Count
        | Kind::Flag
        | Kind::Choice(_)
        | Kind::Code(_)
        | Kind::Text(_)
        | Kind::Lines(_) => None,
    };
    fields
        .iter()
        .filter_map(|field| Some((field.key.to_owned(), of(field)?)))
        .collect()
}

/// Schema of an object with these properties.
fn object_of<const N: usize>(properties: [(&str, Value); N], required: &[&str]) -> Value {
    map([
        ("properties", map(properties)),
        (
            "required",
            Value::List(required.iter().map(|key| text(key)).collect()),
        ),
    ])
}

/// Form of a cycle, with its additional entries.
fn cycle(def: &CycleDef, more: Vec<(String, Value)>) -> Value {
    let mut properties = vec![("type".to_owned(), map([("const", text(def.key))]))];
    properties.extend(more);
    properties.extend(def.fields.iter().map(|f| (f.key.to_owned(), field(f))));
    for section in def.sections {
        let inner = object(
            section.fields.iter().map(|f| (f.key.to_owned(), field(f))),
            &[],
        );
        properties.push((
            section.key.to_owned(),
            if section.optional {
                nullable(inner)
            } else {
                inner
            },
        ));
    }
    if def.place.is_some() {
        let end = f64::from(LONGEST_VECTOR);
        let component = map([
            ("type", text("number")),
            ("minimum", Value::Number(-end)),
            ("maximum", Value::Number(end)),
        ]);
        let touch = object(
            [
                ("point".to_owned(), triple("number")),
                ("vector".to_owned(), three(component)),
            ],
            &["point", "vector"],
        );
        let list = map([
            ("type", text("array")),
            ("items", touch),
            ("minItems", Value::Number(1.0)),
            ("maxItems", Value::Number(MAX_TOUCHES as f64)),
        ]);
        properties.push(("touches".to_owned(), nullable(list)));
    }
    if def.number.is_some() {
        let own = |kind: &str, value: Value| {
            let code = whole(1.0, HIGHEST_CODE);
            let own = [
                ("code", code),
                ("type", map([("const", text(kind))])),
                ("value", value),
            ];
            object(
                own.map(|(key, value)| (key.to_owned(), value)),
                &["code", "type", "value"],
            )
        };
        let end = f64::from(i32::MAX);
        let of = |kind| map([("type", text(kind))]);
        let kinds = vec![
            own("Int", whole(-end, end)),
            own("Flt", of("number")),
            own("Bol", of("boolean")),
        ];
        let list = map([
            ("type", text("array")),
            ("items", map([("oneOf", Value::List(kinds))])),
            ("maxItems", Value::Number(MOST_CODES as f64)),
        ]);
        properties.push(("custom".to_owned(), nullable(list)));
    }
    object(properties, &["type"])
}

fn field(field: &Field) -> Value {
    let number = |kind: &str| {
        let mut entries = vec![("type", text(kind))];
        match field.kind {
            Kind::Time | Kind::Angle | Kind::Count => {
                let least = if field.hard.above {
                    "exclusiveMinimum"
                } else {
                    "minimum"
                };
                entries.push((least, Value::Number(field.hard.min)));
                entries.push(("maximum", Value::Number(field.hard.max)));
            }
            // Ranges of fields with units come at the end, for both units.
            _ => {}
        }
        map(entries)
    };
    let nominal = ["number", "string"].map(text).to_vec();
    let schema = match field.kind {
        Kind::Length | Kind::Angle if field.size => {
            let Value::Map(mut entries) = number("number") else {
                unreachable!("a schema is a map")
            };
            entries[0].1 = Value::List(nominal);
            let most = crate::tolerance::LONGEST as f64;
            entries.push(("maxLength".to_owned(), Value::Number(most)));
            entries.push(("pattern".to_owned(), text(&format!("^{TOLERANCED}$"))));
            Value::Map(entries)
        }
        Kind::Length | Kind::Feed | Kind::Acceleration | Kind::Time | Kind::Angle => {
            number("number")
        }
        Kind::Count => number("integer"),
        Kind::Flag => map([("type", text("boolean"))]),
        Kind::Choice(choices) => map([(
            "enum",
            Value::List(choices.iter().map(|c| text(c.value)).collect()),
        )]),
        Kind::Code(codes) => map([(
            "enum",
            Value::List(
                codes
                    .iter()
                    .map(|c| Value::Number(f64::from(c.value)))
                    .collect(),
            ),
        )]),
        Kind::Text(longest) => map([
            ("type", text("string")),
            ("maxLength", Value::Number(longest as f64)),
        ]),
        Kind::Point => triple("number"),
        Kind::Nominal => map([("type", Value::List(nominal))]),
        Kind::NominalPoint => three(map([("type", Value::List(nominal))])),
        Kind::Lines(places) => object(
            places
                .iter()
                .map(|place| (place.value.to_owned(), program_lines(place.label))),
            &[],
        ),
    };
    let Value::Map(mut entries) = (if field.null.is_some() {
        nullable(schema)
    } else {
        schema
    }) else {
        unreachable!("a schema is a map")
    };
    entries.push(("title".to_owned(), text(field.label)));
    let help = match field.kind {
        Kind::Length if field.size => &format!("{} {WITH_TOLERANCE}", field.help),
        _ => field.help,
    };
    entries.push(("description".to_owned(), text(help)));
    Value::Map(entries)
}

/// Lines of a program at one place.
fn program_lines(label: &str) -> Value {
    let line = map([
        ("type", text("string")),
        ("maxLength", Value::Number(LONGEST_LINE as f64)),
        ("pattern", text("^[ -~]*$")),
    ]);
    map([
        ("type", text("array")),
        ("items", line),
        ("maxItems", Value::Number(MOST_LINES as f64)),
        ("title", text(label)),
    ])
}

/// Pattern of a size with a tolerance class, or with one or two deviations.
const TOLERANCED: &str = r"\s*[Øø⌀]?\s*\d+([.,]\d+)?\s*([A-Za-z]{1,2}\d{1,2}|(0\s*[ /]\s*)?(±|\+/-|[+−-])\s*[\d.,]+[\d.,\s+−/-]*)\s*";

/// Added to the description of every size.
const WITH_TOLERANCE: &str = "As text it has a tolerance: `25 H7`, `25 +0.021 0`, `25 ±0.05`.";

fn whole(min: f64, max: f64) -> Value {
    map([
        ("type", text("integer")),
        ("minimum", Value::Number(min)),
        ("maximum", Value::Number(max)),
    ])
}

fn frame() -> Value {
    let axis = || map([("enum", Value::List(["X", "Y", "Z"].map(text).to_vec()))]);
    let turn = object(
        [
            ("rot".to_owned(), axis()),
            ("angle".to_owned(), field(&STEP_ANGLE)),
        ],
        &["rot", "angle"],
    );
    let mirror = object([("mirror".to_owned(), axis())], &["mirror"]);
    map([
        ("type", text("array")),
        ("items", map([("oneOf", Value::List(vec![turn, mirror]))])),
        ("maxItems", Value::Number(MOST_STEPS as f64)),
    ])
}

fn text(text: &str) -> Value {
    Value::Text(text.to_owned())
}

fn map<'a>(entries: impl IntoIterator<Item = (&'a str, Value)>) -> Value {
    Value::Map(
        entries
            .into_iter()
            .map(|(key, value)| (key.to_owned(), value))
            .collect(),
    )
}

fn nullable(schema: Value) -> Value {
    map([(
        "anyOf",
        Value::List(vec![schema, map([("type", text("null"))])]),
    )])
}

fn triple(of: &str) -> Value {
    three(map([("type", text(of))]))
}

fn three(items: Value) -> Value {
    map([
        ("type", text("array")),
        ("items", items),
        ("minItems", Value::Number(3.0)),
        ("maxItems", Value::Number(3.0)),
    ])
}

fn object(properties: impl IntoIterator<Item = (String, Value)>, required: &[&str]) -> Value {
    map([
        ("type", text("object")),
        ("properties", Value::Map(properties.into_iter().collect())),
        (
            "required",
            Value::List(required.iter().map(|key| text(key)).collect()),
        ),
        ("additionalProperties", Value::Flag(false)),
    ])
}
