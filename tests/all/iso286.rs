//! ISO 286 limit deviations, every cell: each class of each letter and grade, in each band of sizes, against the tables in `data/iso286.json` and
//! the standard's rules, restated here.

use serde_json::Value;
use touchpath::tolerance::parse;

fn table() -> Value {
    serde_json::from_str(include_str!("../data/iso286.json")).expect("the tables are JSON")
}

fn numbers(value: &Value) -> Vec<Option<f64>> {
    value
        .as_array()
        .expect("a list")
        .iter()
        .map(Value::as_f64)
        .collect()
}

/// Lower and upper deviation in micrometres of a class in a sub-band; `None` if the standard gives none.
fn expected(
    tables: &Value,
    letter: &str,
    hole: bool,
    grade: &str,
    sub: usize,
) -> Option<(f64, f64)> {
    let subs = numbers(&tables["sub_band_upper_mm"]);
    let mains = numbers(&tables["main_band_upper_mm"]);
    let size = subs[sub]?;
    let main = mains
        .iter()
        .position(|upper| upper.is_some_and(|u| size <= u))?;
    let it = |grade: &str| tables["IT"][grade][main].as_f64();
    let width = it(grade)?;
    let n: i32 = if grade == "01" {
        -1
    } else {
        grade.parse().ok()?
    };
    // IT01 and IT0 are for H, h, JS and js.
    if n < 1 && !matches!(letter, "h" | "js") {
        return None;
    }
    let small = size <= 3.0;
    let shaft = |letter: &str| tables["shaft_fundamental"][letter][sub].as_f64();
    let j = |name: &str, key: String| tables[name].get(&key).and_then(|row| row[sub].as_f64());
    let delta = || it(&(n - 1).to_string()).map(|finer| width - finer);
    match (letter, hole) {
        ("js", _) => Some((-width / 2.0, width / 2.0)),
        ("h", true) => Some((0.0, width)),
        ("h", false) => Some((-width, 0.0)),
        ("j", true) => j("hole_J_ES", format!("J{grade}")).map(|es| (es - width, es)),
        ("j", false) => j("shaft_j_ei", format!("j{grade}")).map(|ei| (ei, ei + width)),
        ("a" | "b" | "c" | "cd" | "d" | "e" | "ef" | "f" | "fg" | "g", true) => {
            shaft(letter).map(|es| (-es, -es + width))
        }
        ("a" | "b" | "c" | "cd" | "d" | "e" | "ef" | "f" | "fg" | "g", false) => {
            shaft(letter).map(|es| (es - width, es))
        }
        ("k", false) => {
            let ei = if (4..=7).contains(&n) {
                tables["shaft_k_ei_IT4_to_7"][sub].as_f64()?
            } else {
                0.0
            };
            Some((ei, ei + width))
        }
        ("k", true) => {
            let ei = tables["shaft_k_ei_IT4_to_7"][sub].as_f64()?;
            let es = match (small, n <= 8) {
                (true, _) => -ei,
                (false, true) => -ei + delta()?,
                (false, false) => return None,
            };
            Some((es - width, es))
        }
        (_, false) => shaft(letter).map(|ei| (ei, ei + width)),
        (_, true) => {
            let ei = shaft(letter)?;
            let finest = if matches!(letter, "m" | "n") { 8 } else { 7 };
            let es = if letter == "m" && n == 6 && size > 250.0 && size <= 315.0 {
                -9.0
            } else if letter == "n" && n > 8 && !small {
                0.0
            } else if !small && n <= finest {
                -ei + delta()?
            } else {
                -ei
            };
            Some((es - width, es))
        }
    }
}

#[test]
fn every_class_in_every_band_is_the_tables() {
    let tables = table();
    let subs = numbers(&tables["sub_band_upper_mm"]);
    let mut letters: Vec<String> = tables["shaft_fundamental"]
        .as_object()
        .unwrap()
        .keys()
        .cloned()
        .collect();
    letters.extend(["h", "j", "js", "k"].map(str::to_owned));
    let grades: Vec<String> = tables["IT"].as_object().unwrap().keys().cloned().collect();
    assert_eq!((subs.len(), letters.len(), grades.len()), (25, 28, 20));
    let (mut given, mut refused) = (0, 0);
    for (sub, upper) in subs.iter().enumerate() {
        let upper = upper.unwrap();
        let lower = if sub == 0 {
            0.0
        } else {
            subs[sub - 1].unwrap()
        };
        for size in [upper, lower + 0.001, (lower + upper) / 2.0] {
            for letter in &letters {
                for hole in [false, true] {
                    let class = if hole {
                        letter.to_uppercase()
                    } else {
                        letter.clone()
                    };
                    for grade in &grades {
                        let text = format!("{size}{class}{grade}");
                        let wanted = expected(&tables, letter, hole, grade, sub);
                        let read = parse(&text, 1.0)
                            .ok()
                            .and_then(|v| Some((v.limits?, v.nominal?)));
                        let read = read.map(|((low, high), nominal)| {
                            ((low - nominal) * 1e3, (high - nominal) * 1e3)
                        });
                        match (wanted, read) {
                            (None, None) => refused += 1,
                            (Some(w), Some(r)) => {
                                assert!(
                                    (w.0 - r.0).abs() < 1e-6 && (w.1 - r.1).abs() < 1e-6,
                                    "{text}: {r:?}, the tables give {w:?}"
                                );
                                given += 1;
                            }
                            _ => panic!("{text}: {read:?}, the tables give {wanted:?}"),
                        }
                    }
                }
            }
        }
    }
    assert!(given > 60_000 && refused > 8_000, "{given} {refused}");
}

/// Values that were wrong.
#[test]
fn holes_k_use_the_shafts_rule() {
    let limits = |text: &str| {
        let value = parse(text, 1.0).unwrap();
        let (low, high) = value.limits.unwrap();
        let nominal = value.nominal.unwrap();
        [low, high].map(|x| ((x - nominal) * 1e4).round() / 10.0)
    };
    assert_eq!(limits("25K8"), [-23.0, 10.0]);
    assert_eq!(limits("25K3"), [-4.5, -0.5]);
    assert_eq!(limits("3K9"), [-25.0, 0.0]);
    for undefined in ["25K9", "25Y0", "25T0", "25P01"] {
        assert!(parse(undefined, 1.0).is_err(), "{undefined}");
    }
}
