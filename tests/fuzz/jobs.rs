//! Whole jobs, and the laws that each must satisfy.

use crate::common::{import, values, with};
use touchpath::describe::{
    Catalog, CycleEntry, DefaultEntry, FieldEntry, PostEntry, RelationEntry, export_table,
};
use touchpath::form::{Level, Value};
use touchpath::job::{Plan, check, convert_units, plan};

use crate::Tally;
use crate::common::owed;
use crate::draw::Draw;
use crate::readers;

fn text(text: &str) -> Value {
    Value::Text(text.to_owned())
}

/// Mostly usual values; sometimes an end of a range, a value near it, or any allowed value.
fn number(draw: &mut Draw, field: &FieldEntry, scale: f64) -> f64 {
    let [min, max] = field.range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
    let [low, high] = field.usual.unwrap_or([min.max(-300.0), max.min(300.0)]);
    let x = match draw.index(80) {
        0 => min,
        1 => max,
        2 => low,
        3 => high,
        4 => draw.between(min, max),
        5 => min + *draw.of(&[1e-12, 1e-9, 1e-6, 1e-4]),
        // Round numbers are what people type.
        6..40 => (draw.between(low, high) * 2.0).round() / 2.0,
        _ => match field.default {
            DefaultEntry::Number(x) if draw.once_in(3) => x,
            _ => draw.between(low, high),
        },
    };
    x / scale
}

fn nominal(draw: &mut Draw, x: f64, scale: f64) -> Value {
    let x = x / scale;
    match draw.index(24) {
        0 => text(&format!("{x:.4}H7")),
        1 => text(&format!("{x:.3}+{:.4}-{:.4}", 0.02 / scale, 0.01 / scale)),
        2 => text(&format!("{x:.2}m")),
        3 => text(&format!("?{x:.2}")),
        4 => text(&format!("{x:.3}@{:.3}", x + 0.01 / scale)),
        _ => Value::Number(x),
    }
}

fn choice(entry: &DefaultEntry) -> Value {
    match *entry {
        DefaultEntry::Number(x) => Value::Number(x),
        DefaultEntry::Text(word) => text(word),
        _ => Value::Null,
    }
}

fn value(draw: &mut Draw, field: &FieldEntry, scale: f64) -> Value {
    if field.null.is_some() && draw.once_in(6) {
        return Value::Null;
    }
    match field.kind {
        "number" => Value::Number(number(
            draw,
            field,
            if is_metric(field) { scale } else { 1.0 },
        )),
        "count" => {
            let [min, max] = field.range.expect("a count has a range");
            Value::Number(draw.between(min, max.min(9.0) + 1.0).floor())
        }
        "flag" => Value::Flag(draw.once_in(2)),
        "choice" | "code" => choice(&draw.of(&field.choices).value),
        "text" => text(draw.word(&["PROBE", "a b", "x)\nG0 Z-9", "é%;(", "", "~", "N10 M30"])),
        "nominal" => {
            let x = draw.between(6.0, 40.0);
            nominal(draw, x, scale)
        }
        "nominalPoint" => {
            let side = if field.key == "point2" { 1.0 } else { -1.0 };
            let place = [
                side * draw.between(25.0, 120.0),
                draw.between(-50.0, 50.0),
                draw.between(-40.0, 10.0),
            ];
            Value::List(place.iter().map(|x| nominal(draw, *x, scale)).collect())
        }
        "point" => Value::List(
            (0..3)
                .map(|_| Value::Number(draw.between(-200.0, 200.0).round() / scale))
                .collect(),
        ),
        "lines" if !draw.once_in(4) => Value::Null,
        "lines" => lines(draw, field),
        kind => panic!(
            "{} is of a kind that the fuzzer does not know: {kind}",
            field.key
        ),
    }
}

/// Lines of a shop: most are possible on every control, a few on none.
fn lines(draw: &mut Draw, field: &FieldEntry) -> Value {
    const USUAL: [&str; 8] = ["M0", "M5", "M59 P3", "M1", "", "M9", " M5 ", "m0"];
    const HOSTILE: [&str; 10] = [
        "M30",
        "G10 L2 P1 X0",
        "x)\nG0 Z-9",
        "é",
        "{tol}",
        "N10",
        "#100=1",
        "R1=0",
        "%",
        "(a) (b",
    ];
    let mut places = Vec::new();
    for place in &field.choices {
        let count = draw.index(4);
        let mut own = Vec::new();
        for _ in 0..count {
            let hostile = draw.once_in(60);
            own.push(text(draw.word(if hostile { &HOSTILE } else { &USUAL })));
        }
        if let DefaultEntry::Text(key) = place.value {
            places.push((key.to_owned(), Value::List(own)));
        }
    }
    Value::Map(places)
}

/// Whether a number changes with the units.
fn is_metric(field: &FieldEntry) -> bool {
    matches!(field.unit, "length" | "feed" | "acceleration")
}

fn form(draw: &mut Draw, fields: &[FieldEntry], scale: f64, least: usize) -> Vec<(String, Value)> {
    // A job may omit any field.
    let said: Vec<&FieldEntry> = fields.iter().filter(|_| !draw.once_in(least)).collect();
    said.into_iter()
        .map(|f| (f.key.to_owned(), value(draw, f, scale)))
        .collect()
}

fn put(entries: &mut Vec<(String, Value)>, key: &str, value: Value) {
    entries.retain(|(k, _)| k != key);
    entries.push((key.to_owned(), value));
}

/// A job; the index enumerates every cycle, control, plane and unit. One in 40 has a stock, drawn separately, so that the rest is the same as without.
pub fn whole(catalog: &Catalog, draw: &mut Draw, index: u64) -> Value {
    let mut own = Draw::new(index.wrapping_add(0x5107));
    match without_stock(catalog, draw, index) {
        Value::Map(mut entries) if own.once_in(40) => {
            put(&mut entries, "stock", stock(&mut own));
            Value::Map(entries)
        }
        job => job,
    }
}

/// A block of any size: half of them far below the path, so that the job keeps its program.
fn stock(draw: &mut Draw) -> Value {
    let far = if draw.once_in(2) { -2000.0 } else { 0.0 };
    let mut point = |low: f64, high: f64| {
        let axis = |_| Value::Number(draw.between(low, high));
        Value::List((0..3).map(axis).collect())
    };
    Value::Map(vec![
        ("origin".to_owned(), point(far - 100.0, far)),
        ("size".to_owned(), point(0.01, 200.0)),
    ])
}

fn without_stock(catalog: &Catalog, draw: &mut Draw, index: u64) -> Value {
    if draw.once_in(60) {
        let job = led(catalog, draw);
        return if draw.once_in(4) {
            tolerated(draw, job, &catalog.relations)
        } else {
            job
        };
    }
    let job = without_tolerances(catalog, draw, index);
    // Few jobs of native cycles have a plan.
    let own = word(&job, &["control", "form"]) == "cycle";
    let often = if own {
        1
    } else {
        4 - 2 * usize::from(job.get("cycles").is_some())
    };
    if draw.once_in(often) {
        tolerated(draw, job, &catalog.relations)
    } else {
        job
    }
}

/// A slightly displaced part, and cycles that follow the first two: as random as leaves most of them possible.
fn led(catalog: &Catalog, draw: &mut Draw) -> Value {
    // LinuxCNC twice as often: its own interpreter can run failing programs.
    let computing = catalog
        .posts
        .iter()
        .filter(|post| post.computes)
        .map(|post| post.id);
    let posts: Vec<&str> = std::iter::once("linuxcnc").chain(computing).collect();
    let post = draw.word(&posts);
    let (plane, axes) = *draw.of(&[("G17", [0, 1, 2]), ("G18", [2, 0, 1]), ("G19", [1, 2, 0])]);
    let scale = if draw.once_in(3) { 25.4 } else { 1.0 };
    let angle = *draw.of(&[0.05, 0.4, 2.0, 6.0]);
    let mut places: Vec<[f64; 3]> = (0..2)
        .map(|i| {
            [
                draw.between(-40.0, 40.0),
                200.0 * f64::from(i),
                draw.between(-20.0, 20.0),
            ]
        })
        .collect();
    places.push([
        draw.between(-60.0, 60.0),
        draw.between(-90.0, -70.0) - 130.0,
        0.0,
    ]);
    let in_work = |place: [f64; 3]| {
        let mut work = [0.0; 3];
        (0..3).for_each(|i| work[axes[i]] = place[i]);
        work
    };
    let round = |x: f64| (x / scale * 1e4).round() / 1e4;
    let origin = |place: [f64; 3]| in_work(place).map(|x| Value::Number(round(x)));
    let length = |mm: f64| Value::Number(round(mm));
    let heading = draw.between(-180.0, 180.0).round() + 0.0;
    let cycle = |entries: Vec<(&str, Value)>| {
        Value::Map(
            entries
                .into_iter()
                .map(|(key, value)| (key.to_owned(), value))
                .collect(),
        )
    };
    let diameter = draw.between(22.0, 60.0);
    let first = cycle(vec![
        ("name", text("C1")),
        ("type", text("hole")),
        ("diameter", length(diameter)),
        ("origin", Value::List(origin(places[0]).to_vec())),
    ]);
    let side = cycle(vec![
        ("name", text("C2")),
        ("type", text("wall-angle")),
        ("rotation", Value::Number(heading)),
        ("origin", Value::List(origin(places[1]).to_vec())),
    ]);
    let key = draw.word(&[
        "hole",
        "boss",
        "internal-rectangle",
        "external-rectangle",
        "web",
        "groove",
        "surface",
        "wall-angle",
        "double-wall-internal-corner",
    ]);
    let mut at = origin(places[2]);
    let mut led = vec![("name", text("C3")), ("type", text(key))];
    // At the midpoint between two holes, or at one; along the line through both, or along a side.
    let other = [
        places[0][0] - draw.between(80.0, 160.0),
        places[0][1] + draw.between(-60.0, 60.0),
        places[0][2],
    ];
    let both = draw.once_in(2);
    let own = [0, 1].map(|i| round(places[0][i]));
    let middle = [0, 1].map(|i| (own[i] + round(other[i])) / 2.0);
    let (name, from) = match both {
        // A relation of a relation.
        true if draw.once_in(3) => ("NEAR", [0, 1].map(|i| (middle[i] + own[i]) / 2.0)),
        true => ("MID", middle),
        false => ("C1", own),
    };
    if both || draw.once_in(2) {
        for (i, letter) in ["x", "y"].into_iter().enumerate() {
            at[axes[i]] = text(&format!(
                "={name}.center.{letter}{:+}",
                round(places[2][i]) - from[i]
            ));
        }
    }
    led.push(("origin", Value::List(at.to_vec())));
    let sizes: &[&str] = match key {
        "hole" | "boss" => &["diameter"],
        "web" | "groove" => &["width"],
        "internal-rectangle" | "external-rectangle" => &["width1", "width2"],
        _ => &[],
    };
    if sizes.is_empty() || draw.once_in(2) {
        let of = if both && draw.once_in(2) { "ROW" } else { "C2" };
        led.push((
            "rotation",
            text(&format!(
                "={of}.rotation{:+}",
                draw.between(-180.0, 180.0).round() + 0.0
            )),
        ));
    } else {
        for size in sizes {
            led.push((
                size,
                text(&format!(
                    "=C1.diameter{:+}",
                    round(draw.between(22.0, 70.0)) - round(diameter)
                )),
            ));
        }
    }
    let mut cycles = vec![first, side, cycle(led)];
    let mut relations = Vec::new();
    if both {
        let hole = [
            ("name", text("C0")),
            ("type", text("hole")),
            ("diameter", length(30.0)),
        ];
        let at = ("origin", Value::List(origin(other).to_vec()));
        cycles.insert(draw.index(3), cycle(hole.into_iter().chain([at]).collect()));
        for (name, kind, one) in [
            ("ROW", "line", "C0"),
            ("MID", "center", "C0"),
            ("NEAR", "center", "MID"),
        ] {
            let of = Value::List(vec![text(one), text("C1")]);
            relations.push(cycle(vec![
                ("name", text(name)),
                ("type", text(kind)),
                ("of", of),
            ]));
        }
    }
    if draw.once_in(2)
        && !matches!(
            key,
            "web" | "groove" | "surface" | "wall-angle" | "double-wall-internal-corner"
        )
    {
        let mut at = origin([places[2][0], places[2][1] - 180.0, places[2][2]]);
        at[axes[0]] = text(&format!(
            "=C3.center.x{:+}",
            round(draw.between(-20.0, 20.0))
        ));
        at[axes[1]] = text(&format!(
            "=C3.center.y{:+}",
            round(draw.between(-200.0, -160.0))
        ));
        cycles.push(cycle(vec![
            ("name", text("C4")),
            ("type", text("hole")),
            ("diameter", length(30.0)),
            ("origin", Value::List(at.to_vec())),
        ]));
    }
    let small = |draw: &mut Draw| Value::Number(draw.between(-0.4, 0.4) / scale);
    let offset = vec![small(draw), small(draw), small(draw)];
    let part = cycle(vec![
        ("offset", Value::List(offset)),
        (
            "rotation",
            Value::Number(draw.between(-angle, angle) * 1.02),
        ),
    ]);
    let limits = vec![
        ("position", length(9.0)),
        ("angle", Value::Number(angle)),
        ("size", length(*draw.of(&[0.01, 0.4, 3.0]))),
    ];
    let offset = if draw.once_in(3) {
        Value::Null
    } else {
        Value::Number(1.0)
    };
    cycle(vec![
        ("format", Value::Number(2.0)),
        ("units", text(if scale == 1.0 { "mm" } else { "inch" })),
        ("plane", text(plane)),
        ("overtravel", length(8.0)),
        (
            "control",
            cycle(vec![("post", text(post)), ("workOffset", offset)]),
        ),
        ("limits", cycle(limits)),
        ("cycles", Value::List(cycles)),
        ("relations", Value::List(relations)),
        ("part", part),
    ])
}

/// The job with relations between its cycles and tolerances of its results, some of them for results that do not exist.
fn tolerated(draw: &mut Draw, job: Value, kinds: &[RelationEntry]) -> Value {
    let related = match plan(&job) {
        Ok(plan) if !plan.cycles.is_empty() => related(draw, job, &plan, kinds),
        Ok(_) => job,
        Err(_) => return job,
    };
    let Ok(plan) = plan(&related) else {
        return related;
    };
    let names: Vec<&String> = plan.cycles.iter().chain(&plan.relations).collect();
    let mut tolerances = Vec::new();
    for row in plan
        .results
        .iter()
        .filter(|row| row.nominal.is_some() && !row.code.starts_with("offset."))
    {
        // A program of calls without a write may correct a tool from any size.
        let by_moves = !plan.program.own
            && ["haas", "fanuc", "sinumerik"].contains(&plan.program.post)
            && row.unit != "deg";
        let corrects = by_moves || plan.program.own && plan.program.writes.is_empty();
        let size = ["diameter", "width", "distance"]
            .iter()
            .any(|code| row.code.starts_with(code));
        // Of many tolerances one is often refused.
        let rare = match (by_moves, size, corrects) {
            (true, true, _) => 1,
            (true, false, _) => 6,
            (false, _, true) => 2,
            (false, _, false) => 3,
        };
        if !draw.once_in(rare) {
            continue;
        }
        let named = match names.get(row.cycle) {
            Some(name) => format!("{name}.{}", row.code),
            None => row.code.clone(),
        };
        let unit = if row.unit == "inch" { 25.4 } else { 1.0 };
        let off = *draw.of(&[0.001, 0.02, 0.2]) / unit;
        // Exactly at the end of a zone rounding decides: the nominal value is inside or outside.
        let tolerance = match draw.index(6) {
            0 if size || draw.once_in(10) => "js9".to_owned(),
            1 => format!("+{off}/-{}", off / 2.0),
            2 => format!(
                "{}..{}",
                row.nominal.unwrap_or(0.0) - off,
                row.nominal.unwrap_or(0.0) + 2.0 * off
            ),
            _ => format!("±{off}"),
        };
        let mut entries = vec![
            ("tolerance".to_owned(), text(&tolerance)),
            (
                "action".to_owned(),
                text(draw.word(&["go", "mark", "stop"])),
            ),
        ];
        if corrects && draw.once_in(if size { 1 } else { 40 }) {
            if plan.program.own {
                entries[1].1 = text("go");
            }
            let by_moves = by_moves.then_some(plan.program.post);
            entries.push(("wear".to_owned(), wear(draw, by_moves)));
        }
        tolerances.push((named, Value::Map(entries)));
    }
    let offsets = ["radius", "diameter", "memory-a-radius", "memory-a-diameter"];
    let known = if draw.once_in(6) { 4 } else { 2 };
    let offsets = text(draw.word(&offsets[..known]));
    let related = crate::common::with(&related, "control.toolOffsets", offsets);
    crate::common::with(&related, "tolerances", Value::Map(tolerances))
}

/// A tool that is corrected, sometimes in a refused way. `by_moves`: the control, for a program of moves.
fn wear(draw: &mut Draw, by_moves: Option<&str>) -> Value {
    let most = if draw.once_in(10) { 1001 } else { 201 };
    let mut entries = vec![("tool".to_owned(), Value::Number(draw.index(most) as f64))];
    let mut maybe = |key: &str, value: f64, draw: &mut Draw| {
        if draw.once_in(2) {
            entries.push((key.to_owned(), Value::Number(value)));
        }
    };
    let (percent, band) = (draw.index(101) as f64, draw.between(0.0, 0.02));
    maybe("percent", percent, draw);
    maybe("deadBand", band, draw);
    if draw.once_in(3) || by_moves.is_some() {
        // Where moves keep the mean, mostly.
        let store = match by_moves.filter(|_| !draw.once_in(20)) {
            Some("sinumerik") => 70 + draw.index(29),
            Some(_) => 500 + draw.index(499),
            None => 1 + draw.index(999),
        };
        let parts = 2.0 + draw.index(98) as f64;
        entries.push(("parts".to_owned(), Value::Number(parts)));
        entries.push(("store".to_owned(), Value::Number(store as f64)));
    }
    Value::Map(entries)
}

/// Relations of positions and results that the cycles measure.
fn related(draw: &mut Draw, job: Value, plan: &Plan, kinds: &[RelationEntry]) -> Value {
    let axis = |key: &str| {
        plan.datum
            .iter()
            .find(|row| row.axis == key)
            .map_or(Vec::new(), |row| row.choices.clone())
    };
    let place = |choice: &String| choice.split_once('.').map(|(name, _)| name.to_owned());
    let y: Vec<String> = axis("y").iter().filter_map(place).collect();
    let places: Vec<String> = axis("x")
        .iter()
        .filter_map(place)
        .filter(|name| y.contains(name))
        .collect();
    let measured = plan
        .results
        .iter()
        .filter(|row| row.value.is_some() && !row.code.starts_with("offset."));
    let unit = plan
        .results
        .get(draw.index(plan.results.len().max(1)))
        .map_or("", |row| row.unit);
    let measured = measured.filter(|row| row.unit == unit);
    let names: Vec<&String> = plan.cycles.iter().chain(&plan.relations).collect();
    let results: Vec<String> = measured
        .map(|row| format!("{}.{}", names[row.cycle], row.code))
        .collect();
    let mut relations = match job.get("relations") {
        Some(Value::List(known)) => known.clone(),
        _ => Vec::new(),
    };
    for i in 0..1 + draw.index(3) {
        let from = |def: &RelationEntry| if def.places { &places } else { &results };
        let possible: Vec<&RelationEntry> = kinds
            .iter()
            .filter(|def| from(def).len() >= def.least)
            .collect();
        if possible.is_empty() {
            continue;
        }
        let def = possible[draw.index(possible.len())];
        let from = from(def);
        let first = draw.index(from.len());
        let of = (0..def.least)
            .map(|k| text(&from[(first + k) % from.len()]))
            .collect();
        let entries = [
            ("name", text(&format!("R{i}"))),
            ("type", text(def.key)),
            ("of", Value::List(of)),
        ];
        relations.push(Value::Map(
            entries.map(|(key, value)| (key.to_owned(), value)).to_vec(),
        ));
    }
    crate::common::with(&job, "relations", Value::List(relations))
}

fn without_tolerances(catalog: &Catalog, draw: &mut Draw, index: u64) -> Value {
    // Each digit of the index in its own base: every cycle with every control, plane and unit.
    let mut left = index as usize;
    let mut at = |count: usize| {
        let digit = left % count;
        left /= count;
        digit
    };
    let def: &CycleEntry = &catalog.cycles[at(catalog.cycles.len())];
    let post: &PostEntry = &catalog.posts[at(catalog.posts.len())];
    let own_cycle = post
        .cycles
        .iter()
        .any(|entry| entry.key == def.key && entry.form == "cycle" && entry.supported);
    let moves = post
        .cycles
        .iter()
        .any(|entry| entry.key == def.key && entry.form == "moves" && entry.supported);
    let plane = ["G17", "G18", "G19"][at(3)];
    let (units, scale) = [("mm", 1.0), ("inch", 25.4)][at(2)];
    let mut job = vec![("format".to_owned(), Value::Number(1.0))];
    for section in catalog.sections.iter().filter(|section| !section.optional) {
        let mut values = form(draw, &section.fields, scale, 3);
        match section.path {
            "" => {
                put(&mut values, "units", text(units));
                put(&mut values, "plane", text(plane));
                job.extend(values);
                continue;
            }
            "control" => {
                let kind = if own_cycle && (!moves || draw.once_in(3)) || draw.once_in(12) {
                    "cycle"
                } else {
                    "moves"
                };
                put(&mut values, "post", text(post.id));
                put(&mut values, "form", text(kind));
                put(
                    &mut values,
                    "run",
                    text(if kind == "moves" && draw.once_in(12) {
                        "dry"
                    } else {
                        "normal"
                    }),
                );
                if post.work_offsets == 0 {
                    put(&mut values, "workOffset", Value::Null);
                }
            }
            // A stylus of any size would collide in most jobs, so it is mostly unknown.
            "stylus" if !draw.once_in(4) => {
                values.retain(|(key, _)| !matches!(key.as_str(), "length" | "shank" | "body"))
            }
            // A tool with another effective axis is refused, so it is rare.
            "tool" if !draw.once_in(20) => continue,
            "part" => {
                let far = if draw.once_in(4) {
                    0.0
                } else {
                    *draw.of(&[0.01, 0.5, 3.0, 20.0])
                };
                let offset = (0..3)
                    .map(|_| Value::Number(draw.between(-far, far) / scale))
                    .collect();
                values = vec![
                    ("offset".to_owned(), Value::List(offset)),
                    (
                        "rotation".to_owned(),
                        Value::Number(draw.between(-far, far)),
                    ),
                ];
                let sizes = def.fields.iter().filter(|f| f.size).map(|f| {
                    let by = if f.unit == "angle" { 1.0 } else { scale };
                    (
                        f.key.to_owned(),
                        Value::Number(draw.between(-far, far) / 10.0 / by),
                    )
                });
                values.push(("sizes".to_owned(), Value::Map(sizes.collect())));
            }
            _ => {}
        }
        job.push((section.path.to_owned(), Value::Map(values)));
    }
    let cycle = cycle(draw, def, scale);
    if def.touches && draw.once_in(4) {
        return set_up(draw, catalog, job, cycle, scale);
    }
    job.push(("cycle".to_owned(), cycle));
    let job = Value::Map(job);
    if def.touches && draw.once_in(5) {
        picked(draw, job)
    } else {
        job
    }
}

fn cycle(draw: &mut Draw, def: &CycleEntry, scale: f64) -> Value {
    let mut cycle = form(draw, &def.fields, scale, 2);
    cycle.push(("type".to_owned(), text(def.key)));
    for section in &def.sections {
        // Native cycles are refused with repeats.
        let seldom = if section.key == "repeat" { 8 } else { 4 };
        if draw.once_in(if section.optional { seldom } else { 2 }) {
            cycle.push((
                section.key.to_owned(),
                Value::Map(form(draw, &section.fields, scale, 3)),
            ));
        }
    }
    Value::Map(cycle)
}

/// The job with further cycles after its own, mostly far enough from each other.
fn set_up(
    draw: &mut Draw,
    catalog: &Catalog,
    mut job: Vec<(String, Value)>,
    first: Value,
    scale: f64,
) -> Value {
    let touching: Vec<&CycleEntry> = catalog.cycles.iter().filter(|def| def.touches).collect();
    let mut cycles = vec![first];
    for _ in 0..1 + draw.index(4) {
        let def = touching[draw.index(touching.len())];
        cycles.push(cycle(draw, def, scale));
    }
    let apart = *draw.of(&[600.0, 600.0, 600.0, 60.0]) / scale;
    for (i, cycle) in cycles.iter_mut().enumerate() {
        let Value::Map(entries) = cycle else { continue };
        for (key, value) in entries
            .iter_mut()
            .filter(|(key, _)| matches!(key.as_str(), "origin" | "point1" | "point2" | "start"))
        {
            if let Value::List(place) = value
                && let Some(Value::Number(x)) = place.first_mut()
            {
                *x += apart * i as f64;
            } else if key == "start" {
                *value = Value::Null;
            }
        }
        entries.push(("name".to_owned(), text(&format!("C{}", i + 1))));
    }
    if let Some((_, Value::Map(part))) = job.iter_mut().find(|(key, _)| key == "part")
        && let Some((_, Value::Map(sizes))) = part.iter_mut().find(|(key, _)| key == "sizes")
    {
        sizes
            .iter_mut()
            .for_each(|(key, _)| *key = format!("C1.{key}"));
    }
    put(&mut job, "format", Value::Number(2.0));
    if draw.once_in(4) {
        job.push((
            "clear".to_owned(),
            Value::Number(draw.between(-20.0, 400.0) / scale),
        ));
    }
    let mut datum = Vec::new();
    for (key, codes) in [
        ("x", &["center.x", "corner.x"] as &[&str]),
        ("y", &["center.y", "corner.y"]),
        ("z", &["point.z"]),
        ("rotation", &["rotation", "Q964"]),
    ] {
        let from = format!("C{}.{}", 1 + draw.index(cycles.len()), draw.word(codes));
        match draw.index(6) {
            0 => datum.push((key.to_owned(), Value::Null)),
            1 => datum.push((key.to_owned(), text(&from))),
            _ => {}
        }
    }
    job.push(("datum".to_owned(), Value::Map(datum)));
    if !draw.once_in(4) {
        job.retain(|(key, _)| key != "clear");
        follow(draw, &mut job, &mut cycles, scale);
        if draw.once_in(2) {
            follow_more(draw, &mut job, &mut cycles, scale);
        }
    }
    job.push(("cycles".to_owned(), Value::List(cycles)));
    Value::Map(job)
}

/// Lets some cycles follow the rotation or size of earlier ones.
fn follow_more(draw: &mut Draw, job: &mut Vec<(String, Value)>, cycles: &mut [Value], scale: f64) {
    let number = |cycle: &Value, key: &str| match cycle.get(key) {
        Some(Value::Number(x)) => Some(*x),
        _ => None,
    };
    let sizes = ["diameter", "width", "width1", "width2"];
    for i in 1..cycles.len() {
        let turns = |other: &Value| matches!(other.get("type"), Some(Value::Text(key)) if key == "wall-angle" || key.ends_with("corner"));
        let turning: Vec<usize> = (0..i).filter(|of| turns(&cycles[*of])).collect();
        let sized: Vec<(usize, &str, f64)> = (0..i)
            .flat_map(|of| sizes.map(|key| (of, key)))
            .filter_map(|(of, key)| Some((of, key, number(&cycles[of], key)?)))
            .collect();
        let own = sizes
            .iter()
            .find_map(|key| Some((*key, number(&cycles[i], key)?)));
        let (key, value) = match (draw.index(3), own) {
            (0, Some((key, own))) if !sized.is_empty() => {
                let (of, code, other) = *draw.of(&sized);
                (
                    key,
                    format!(
                        "=C{}.{code}{:+}",
                        of + 1,
                        ((own - other) * 1e4).round() / 1e4
                    ),
                )
            }
            (1 | 2, _) if !turning.is_empty() => (
                "rotation",
                format!(
                    "=C{}.rotation{:+}",
                    *draw.of(&turning) + 1,
                    draw.between(-180.0, 180.0).round() + 0.0
                ),
            ),
            _ => continue,
        };
        if let Value::Map(entries) = &mut cycles[i] {
            put(entries, key, text(&value));
        }
    }
    let limits = [
        ("angle", *draw.of(&[0.1, 0.5, 1.0, 5.0, 20.0])),
        ("size", *draw.of(&[0.02, 0.3, 2.0]) / scale),
    ];
    for (key, limit) in limits {
        if let Some((_, limits)) = job.iter_mut().find(|(key, _)| key == "limits") {
            *limits = crate::common::with(limits, key, Value::Number(limit));
        } else {
            job.push((
                "limits".to_owned(),
                Value::Map(vec![(key.to_owned(), Value::Number(limit))]),
            ));
        }
    }
}

/// Lets some cycles follow the position of earlier ones: mostly along the same axis, at their former distance.
fn follow(draw: &mut Draw, job: &mut Vec<(String, Value)>, cycles: &mut [Value], scale: f64) {
    let plane = job
        .iter()
        .find(|(key, _)| key == "plane")
        .map_or(Value::Null, |(_, plane)| plane.clone());
    let axes = if plane == text("G18") {
        [2, 0, 1]
    } else if plane == text("G19") {
        [1, 2, 0]
    } else {
        [0, 1, 2]
    };
    let at = |cycle: &Value, axis: usize| match cycle.get("origin") {
        Some(Value::List(place)) => match place.get(axis) {
            Some(Value::Number(x)) => Some(*x),
            _ => None,
        },
        _ => None,
    };
    for i in 1..cycles.len() {
        let (letter, of) = (draw.index(3), draw.index(i));
        let axis = axes[if draw.once_in(30) {
            draw.index(3)
        } else {
            letter
        }];
        let (Some(own), Some(other)) = (at(&cycles[i], axis), at(&cycles[of], axis)) else {
            continue;
        };
        let beside = ((own - other) * 1e4).round() / 1e4;
        let place = format!("=C{}.{}{beside:+}", of + 1, ["x", "y", "z"][letter]);
        if let Value::Map(entries) = &mut cycles[i]
            && let Some((_, Value::List(origin))) =
                entries.iter_mut().find(|(key, _)| key == "origin")
        {
            origin[axis] = text(&place);
        }
    }
    let limit = *draw.of(&[0.05, 0.5, 0.5, 2.0, 10.0]) / scale;
    if let Some((_, limits)) = job.iter_mut().find(|(key, _)| key == "limits") {
        *limits = crate::common::with(limits, "position", Value::Number(limit));
    } else if !draw.once_in(10) {
        job.push((
            "limits".to_owned(),
            Value::Map(vec![("position".to_owned(), Value::Number(limit))]),
        ));
    }
}

/// The job with its touches picked one by one, unchanged or slightly off.
fn picked(draw: &mut Draw, job: Value) -> Value {
    let Ok(plan) = plan(&job) else { return job };
    let off = if draw.once_in(2) {
        0.0
    } else {
        *draw.of(&[1e-9, 1e-4, 0.005, 1.0, 50.0])
    };
    let wrong = draw.index(plan.touches.len().max(1));
    let triple = |p: [f64; 3]| Value::List(p.map(Value::Number).to_vec());
    let touches = plan
        .touches
        .iter()
        .enumerate()
        .map(|(k, touch)| {
            let mut point = touch.point;
            if k == wrong {
                point[draw.index(3)] += off;
            }
            Value::Map(vec![
                ("point".to_owned(), triple(point)),
                ("vector".to_owned(), triple(touch.vector)),
            ])
        })
        .collect();
    crate::common::with(&job, "cycle.touches", Value::List(touches))
}

fn word(job: &Value, path: &[&str]) -> String {
    let at = path.iter().try_fold(job, |value, key| value.get(key));
    match at {
        Some(Value::Text(text)) => text.clone(),
        _ => String::new(),
    }
}

/// The job and its plan without lines of a shop, if it has some: they change no move, and come back from the header. The judges know no code of a shop.
fn without_lines(job: &Value, plan: &Plan) -> Result<Option<(Value, Plan)>, String> {
    let frame = |job: &Value| job.get("machine")?.get("frame").cloned();
    let Some(lines) = frame(job).filter(|lines| *lines != Value::Null) else {
        return Ok(None);
    };
    let bare = with(job, "machine.frame", Value::Null);
    let without = touchpath::job::plan(&bare).map_err(|error| error.to_string())?;
    if without.moves != plan.moves {
        return Err("lines of the shop change the moves".to_owned());
    }
    if word(job, &["control", "header"]) != "short"
        && !matches!(&lines, Value::Map(places) if places.is_empty())
        && import(&plan.program.text)
            .ok()
            .and_then(|read| frame(&read.job))
            != Some(lines)
    {
        return Err("lines of the shop do not come back from the header".to_owned());
    }
    Ok(Some((bare, without)))
}

/// All laws of a job.
pub fn laws(job: &Value, draw: &mut Draw, tally: &mut Tally) -> Result<(), String> {
    let mut asked = |name: &str| *tally.entry(name.to_owned()).or_insert(0) += 1;
    let plan = match plan(job) {
        Ok(plan) => plan,
        Err(error) => {
            asked("refused");
            let errors = error
                .findings
                .iter()
                .filter(|f| f.level == Level::Error)
                .count();
            if let Some(fault) = error.findings.iter().find(|f| {
                let breaks = f.code == "rule-broken"
                    && values(f).iter().any(|rule| rule == "place-within-limit");
                f.code == "not-proven" || breaks
            }) && !has_tiny(job)
            {
                return Err(fault.message.clone());
            }
            return if errors > 0 {
                Ok(())
            } else {
                Err("refused without an error".to_owned())
            };
        }
    };
    let bare = without_lines(job, &plan)?;
    let (job, plan) = match &bare {
        Some((job, bare)) => {
            asked("lines of a shop");
            (job, bare.clone())
        }
        None => (job, plan),
    };
    let tool_axis = match word(job, &["plane"]).as_str() {
        "G18" => 1,
        "G19" => 0,
        _ => 2,
    };
    owed::sane(job, &plan, tool_axis)?;
    if plan.program.does.starts_with("makes a dry run") {
        asked("planned as a dry run");
        return Ok(());
    }
    match plan.cycles.is_empty() {
        true => asked(&format!("planned {}", word(job, &["cycle", "type"]))),
        false => asked("planned as a set-up"),
    }
    if !plan.relations.is_empty() {
        asked("planned with relations");
    }
    if plan.safety.iter().any(|row| row.rule == "tolerance-obeyed") {
        asked("planned with consequences");
    }
    if plan
        .safety
        .iter()
        .any(|row| row.rule == "place-within-limit")
    {
        asked("planned with places that follow");
        let follows = |cycle: &Value, key: &str| matches!(cycle.get(key), Some(Value::Text(_)));
        if let Some(Value::List(cycles)) = job.get("cycles") {
            if cycles.iter().any(|cycle| follows(cycle, "rotation")) {
                asked("planned with rotations that follow");
            }
            if cycles.iter().any(|cycle| {
                ["diameter", "width", "width1", "width2"]
                    .iter()
                    .any(|key| follows(cycle, key))
            }) {
                asked("planned with sizes that follow");
            }
        }
        if plan.relations.iter().any(|name| name == "MID") {
            asked("planned with relations that are followed");
        }
    }
    if plan.program.does.starts_with("corrects") {
        asked(match plan.program.own {
            true => "planned with tools that are corrected",
            false => "planned with tools that moves correct",
        });
    }
    if plan.results.iter().any(|row| row.code == "spread") {
        asked("planned with repeated touches");
    }
    asked(&format!("planned for {}", plan.program.post));
    if word(job, &["control", "form"]) == "cycle" {
        asked(&format!("planned with the cycles of {}", plan.program.post));
    }
    let protection = word(job, &["control", "protection"]);
    for setting in [
        word(job, &["plane"]),
        word(job, &["units"]),
        if protection == "none" {
            protection
        } else {
            "checked".to_owned()
        },
    ] {
        asked(&format!("planned in {setting}"));
    }
    if draw.once_in(4) {
        asked("inch and mm");
        other_units(job, &plan)?;
    }
    if plan.table.iter().any(|r| r.code == "CmdPrm.Int[-1]") && draw.once_in(4) {
        asked("dump and job");
        dumped(&plan, draw)?;
    }
    // Touches without a result, before limits of another cycle: such a program does not show whether they must have a contact.
    let idle_touches =
        !plan.cycles.is_empty() && plan.findings.iter().any(|f| f.code == "no-circle");
    if plan.program.post == "sinumerik" && !idle_touches && draw.once_in(4) {
        asked("program and job");
        read_back(&plan)?;
    }
    asked("remembered lines");
    readers::remembered(&plan, draw)?;
    if draw.once_in(6) {
        asked("mutated text");
        readers::mutated(&plan, draw)?;
    }
    if !plan.touches.is_empty() && draw.once_in(6) {
        asked("measured points");
        readers::measured(job, &plan, draw)?;
    }
    Ok(())
}

/// Whether a job has a dimension at its lower bound: the directions of walls through touches a micrometre apart are rounding noise, and such a program may be
/// refused.
fn has_tiny(job: &Value) -> bool {
    fn tiny(value: &Value) -> bool {
        match value {
            Value::Number(x) => *x != 0.0 && x.abs() < 0.01,
            Value::List(items) => items.iter().any(tiny),
            Value::Map(entries) => entries.iter().any(|(_, value)| tiny(value)),
            _ => false,
        }
    }
    ["cycle", "cycles"]
        .into_iter()
        .filter_map(|key| job.get(key))
        .any(tiny)
}

/// The same part in the other units: with the same moves, if rounding permits a plan at all.
fn other_units(job: &Value, here: &Plan) -> Result<(), String> {
    let (to, factor) = if word(job, &["units"]) == "inch" {
        ("mm", 25.4)
    } else {
        ("inch", 1.0 / 25.4)
    };
    let converted = convert_units(job, to).map_err(|e| e.to_string())?;
    // Six decimals of an inch may exceed a limit.
    let Ok(there) = plan(&converted) else {
        return Ok(());
    };
    if here.moves.len() != there.moves.len() {
        return Ok(());
    }
    let spread = magnified(here);
    for (a, b) in here.moves.iter().zip(&there.moves) {
        // A position is a sum of some rounded values, rotated by an angle over its distance.
        let far = a.to.iter().fold(1.0f64, |most, x| most.max(x.abs()));
        let near = if to == "inch" { 1e-3 / 25.4 } else { 5e-3 } * (1.0 + far / 1000.0) * spread;
        if (0..3).any(|i| (a.to[i] * factor - b.to[i]).abs() > near) || a.kind != b.kind {
            return Err(format!("in {to} {a:?} is {b:?}"));
        }
    }
    Ok(())
}

/// Factor by which a circle through the touches magnifies their rounding: 1 / (1 − cos) of half the angle that they span.
fn magnified(plan: &Plan) -> f64 {
    let vectors = || plan.touches.iter().map(|t| t.vector);
    let cosine =
        |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>().clamp(-1.0, 1.0);
    let widest = vectors()
        .flat_map(|a| vectors().map(move |b| cosine(a, b)))
        .fold(1.0, f64::min)
        .acos();
    if widest < 1e-6 {
        1.0
    } else {
        1.0 / (1.0 - (widest / 2.0).cos())
    }
}

/// A table is a dump, and the dump makes a job that is not refused and has the same touches.
fn dumped(plan: &Plan, draw: &mut Draw) -> Result<(), String> {
    let dump =
        export_table(plan, draw.word(&["text", "csv", "json"])).map_err(|e| e.to_string())?;
    let imported = import(&dump).map_err(|e| format!("dump refused: {e}\n{dump}"))?;
    // The dump has no units: its numbers are read as mm, and the ball, the feeds and the overtravel are the defaults.
    if plan.results.iter().any(|r| r.unit == "inch")
        || plan.findings.iter().any(|f| f.code == "result-untrue")
    {
        return Ok(());
    }
    let refused: Vec<String> = check(&imported.job)
        .into_iter()
        .filter(|f| f.level == Level::Error && !depends_on_the_ball(&f.code))
        .map(|f| format!("{} {}: {}", f.code, f.path, f.message))
        .collect();
    if refused.is_empty() {
        Ok(())
    } else {
        Err(format!("the job of a dump is refused: {refused:?}\n{dump}"))
    }
}

/// Findings that may differ with another ball or overtravel.
fn depends_on_the_ball(code: &str) -> bool {
    matches!(
        code,
        "clearance-too-small"
            | "ball-too-wide"
            | "approach-beyond-wall"
            | "touch-beyond-corner"
            | "crossing-too-low"
            | "collision"
            | "start-in-feature"
            | "touch-too-short"
            | "touch-askew"
    )
}

/// A program for SINUMERIK contains its job: read back it is the same program.
fn read_back(plan: &Plan) -> Result<(), String> {
    let imported = import(&plan.program.text).map_err(|e| format!("{e}\n{}", plan.program.text))?;
    // The header does not contain the virtual part: a path that is free on a displaced part may not be free on the nominal one.
    if check(&imported.job).iter().any(|f| f.code == "collision") {
        return Ok(());
    }
    if let Some(f) = imported.findings.iter().find(|f| {
        matches!(
            f.code.as_str(),
            "program-differs" | "unsafe-program" | "header-unsound" | "header-unknown"
        )
    }) {
        return Err(format!("{}: {}\n{}", f.code, f.message, plan.program.text));
    }
    Ok(())
}

/// A job as JSON text.
pub fn json(value: &Value) -> String {
    match value {
        Value::Null | Value::Other(_) => "null".to_owned(),
        Value::Flag(on) => on.to_string(),
        Value::Number(x) if x.is_finite() => format!("{x:?}"),
        Value::Number(_) => "null".to_owned(),
        Value::Text(text) => format!(
            "{:?}",
            text.chars().filter(|c| !c.is_control()).collect::<String>()
        ),
        Value::List(items) => format!(
            "[{}]",
            items.iter().map(json).collect::<Vec<_>>().join(", ")
        ),
        Value::Map(entries) => {
            let entries: Vec<String> = entries
                .iter()
                .map(|(key, value)| format!("{key:?}: {}", json(value)))
                .collect();
            format!("{{ {} }}", entries.join(", "))
        }
    }
}
