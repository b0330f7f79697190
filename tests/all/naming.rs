//! Names and numbers of programs. Each test is named after a failure.

use crate::common::import;
use crate::common::{job, number, planned, point, with};
use crate::tests::controls::{numbered, of_moves, unnumbered};
use touchpath::control::POSTS;
use touchpath::cycle::CYCLES;
use touchpath::form::{Level, Value};
use touchpath::job::{check, convert_units, default_job, job_name, plan};

fn text(t: &str) -> Value {
    Value::Text(t.to_owned())
}

fn on(post: &str, name: &str, given: Value) -> Value {
    let job = with(
        &default_job("internal-rectangle-protected").unwrap(),
        "control.post",
        text(post),
    );
    let job = with(
        &job,
        "control.form",
        text(if of_moves().contains(&post) {
            "moves"
        } else {
            "cycle"
        }),
    );
    with(&with(&job, "name", text(name)), "control.number", given)
}

/// The O line of a program.
fn o_line(job: &Value) -> String {
    planned(job)
        .program
        .text
        .lines()
        .find(|line| line.starts_with('O'))
        .unwrap()
        .to_owned()
}

#[test]
fn every_job_was_called_probe() {
    for (kind, name) in [
        ("hole", "BORE-D40"),
        ("hole-protected", "BORE-D40"),
        ("boss", "BOSS-D40"),
        ("internal-rectangle-protected", "POCKET-80X50"),
        ("external-rectangle", "BLOCK-80X50"),
        ("groove", "GROOVE-30"),
        ("web", "WEB-30"),
        ("double-wall-internal-corner", "CORNER-90"),
        ("triple-wall-external-corner", "CORNER-90"),
        ("surface", "SURFACE"),
        ("probe-on-off", "PROBE-ON-OFF"),
        ("probing-two-circles", "CIRCLES-D20"),
    ] {
        assert_eq!(
            default_job(kind).unwrap().get("name"),
            Some(&text(name)),
            "{kind}"
        );
    }
    let hole = |diameter: Value| {
        job_name(&with(
            &default_job("hole").unwrap(),
            "cycle.diameter",
            diameter,
        ))
    };
    assert_eq!(hole(number(12.5)), "BORE-D12_5");
    assert_eq!(hole(number(12.000_04)), "BORE-D12");
    assert_eq!(hole(text("25+")), "BORE", "what is being typed is no size");
    assert_eq!(hole(number(f64::NAN)), "BORE");
    let circles = |two: Value| {
        job_name(&with(
            &default_job("probing-two-circles").unwrap(),
            "cycle.diameter2",
            two,
        ))
    };
    assert_eq!(circles(text("12H7")), "CIRCLES-D20XD12");
    assert_eq!(job_name(&Value::Null), "PROBE");
}

/// A default name that a control would change, or whose size would become its number, would surprise.
#[test]
fn the_name_of_every_job_goes_into_every_program_as_it_is() {
    for def in CYCLES {
        let fresh = default_job(def.key).unwrap();
        for units in ["mm", "inch"] {
            let mut job = convert_units(&fresh, units).unwrap();
            for size in [1.234_567, 1200.0, 9843.0, 0.9843] {
                for field in def.fields.iter().filter(|field| field.size) {
                    job = with(&job, &format!("cycle.{}", field.key), number(size));
                }
                let name = job_name(&job);
                let named = with(
                    &with(&fresh, "name", text(&name)),
                    "control.form",
                    text("moves"),
                );
                for post in POSTS {
                    let found = check(&with(&named, "control.post", text(post.key)));
                    assert!(
                        found.iter().all(|f| f.code != "name-changed"),
                        "{} {name}: {found:?}",
                        post.key
                    );
                }
                let fanuc = with(&named, "control.post", text("fanuc"));
                assert!(
                    o_line(&fanuc).starts_with("O1000("),
                    "{name}: {}",
                    o_line(&fanuc)
                );
            }
        }
    }
}

#[test]
fn every_program_was_o1000() {
    for post in numbered() {
        for (name, given, line) in [
            ("BORE-D25", Value::Null, "O1000(BORE-D25)"),
            ("BORE2201", Value::Null, "O2201(BORE2201)"),
            ("o42", number(42.0), "O0042(O42)"),
            ("BORE2201", number(7.0), "O0007(BORE2201)"),
            ("", number(9999.0), "O9999"),
            // No part of a name leaves its comment or has an effect in it.
            ("A)G0 Z-9(", Value::Null, "O1000(A_G0 Z-9_)"),
            ("MSG,STOP: \u{fc}+'", Value::Null, "O1000(MSG_STOP_ ___)"),
            ("RESULTS: A = B", Value::Null, "O1000(RESULTS_ A = B)"),
        ] {
            let job = on(post, name, given.clone());
            assert_eq!(o_line(&job), line, "{post} {name}");
            let read = import(&planned(&job).program.text)
                .unwrap_or_else(|e| panic!("{post} {name}: {e}"));
            assert_eq!(
                read.job.get("control").and_then(|c| c.get("number")),
                Some(&given),
                "{post} {name}"
            );
            assert_eq!(o_line(&read.job), line, "{post} {name}");
        }
    }
    let long = o_line(&on("fanuc", &"x".repeat(200), Value::Null));
    assert_eq!(long, format!("O1000({})", "X".repeat(31)));
}

/// A comment of a program states the start position of the stylus: a name must not.
#[test]
fn a_name_cannot_say_where_the_stylus_stands() {
    for name in [
        "The stylus is taken to be at X1 Y2 Z3",
        "x The stylus is taken to be at X1 Y2 Z3 before the start",
    ] {
        for post in of_moves() {
            let named = on(post, name, Value::Null);
            let plain = on(post, "A", Value::Null);
            let moves = |job: &Value| {
                import(&planned(job).program.text)
                    .unwrap()
                    .job
                    .get("cycle")
                    .cloned()
            };
            assert_eq!(moves(&named), moves(&plain), "{post} {name}");
            assert!(plan(&named).is_ok());
        }
    }
}

/// The number is changed at the control because another program has it: the job accepts it, and nothing else has changed.
#[test]
fn a_number_that_was_changed_by_hand_comes_back() {
    let program = planned(&on("fanuc", "BORE-D25", Value::Null)).program.text;
    let edited = program.replacen("O1000(BORE-D25)", "O2201 (BORE-D25)", 1);
    assert_ne!(program, edited);
    let read = import(&edited).unwrap();
    assert_eq!(
        read.job.get("control").and_then(|c| c.get("number")),
        Some(&number(2201.0))
    );
    assert!(
        read.findings
            .iter()
            .all(|f| f.level == Level::Info && f.code != "lines-differ"),
        "{:?}",
        read.findings
    );
    assert!(
        planned(&read.job)
            .program
            .text
            .contains("\nO2201(BORE-D25)\n")
    );
    for line in ["O12345", "O0", "O99999999999"] {
        let read = import(&program.replacen("O1000(BORE-D25)", line, 1)).unwrap();
        assert_eq!(
            read.job.get("control").and_then(|c| c.get("number")),
            Some(&Value::Null),
            "{line}"
        );
    }
}

#[test]
fn a_number_that_the_control_may_refuse_or_does_not_have_is_reported() {
    let found = |job: &Value| -> Vec<(String, String, Level)> {
        let of = |f: &touchpath::form::Finding| f.code.starts_with("number-");
        check(job)
            .into_iter()
            .filter(of)
            .map(|f| (f.code, f.path, f.level))
            .collect()
    };
    let one = |code: &str, path: &str, level| vec![(code.to_owned(), path.to_owned(), level)];
    for post in numbered() {
        assert_eq!(found(&on(post, "A", number(7999.0))), []);
        assert_eq!(
            found(&on(post, "A", number(8000.0))),
            one("number-protected", "control.number", Level::Warning)
        );
        assert_eq!(
            found(&on(post, "O9001", Value::Null)),
            one("number-protected", "name", Level::Warning)
        );
    }
    for post in unnumbered() {
        assert_eq!(found(&on(post, "O9001", Value::Null)), [], "{post}");
        assert_eq!(
            found(&on(post, "A", number(2201.0))),
            one("number-unused", "control.number", Level::Info),
            "{post}"
        );
    }
    let circles = with(
        &default_job("probing-two-circles").unwrap(),
        "control.number",
        number(2201.0),
    );
    assert_eq!(
        found(&circles),
        one("number-unused", "control.number", Level::Info)
    );
    for wrong in [0.0, 10_000.0, 12.5] {
        assert!(plan(&on("fanuc", "A", number(wrong))).is_err(), "{wrong}");
    }
}

/// A dump has no name: the job gets the default name of the measured feature, not of the default job.
#[test]
fn what_is_imported_is_named_after_what_it_measures() {
    let hole = with(
        &default_job("hole").unwrap(),
        "cycle.diameter",
        number(64.0),
    );
    let dump = touchpath::describe::export_table(&planned(&hole), "text").unwrap();
    assert_eq!(
        import(&dump).unwrap().job.get("name"),
        Some(&text("BORE-D64"))
    );
    let klartext = planned(&job(
        r#"{ "format": 1, "name": "PART_7", "cycle": { "type": "probing-two-circles", "diameter1": 12, "diameter2": "12H7" }, "control": { "post": "heidenhain", "form": "cycle" } }"#,
    ));
    let block: String = klartext
        .program
        .text
        .lines()
        .skip_while(|line| !line.contains("TCH PROBE"))
        .map(|line| format!("{line}\n"))
        .collect();
    let block = block.replace("END PGM PART_7 MM", "");
    assert_eq!(
        import(&block).unwrap().job.get("name"),
        Some(&text("CIRCLES-D12"))
    );
    assert_eq!(
        import(&format!("0 BEGIN PGM PART_7 MM\n{block}"))
            .unwrap()
            .job
            .get("name"),
        Some(&text("PART_7"))
    );
}

// Notations.

/// 25+0.021 became 25.021 in one cycle and a tolerance in another.
#[test]
fn a_size_that_is_no_number_says_what_to_enter() {
    // A fit with two classes is that of two parts.
    for (typed, why) in [
        ("25H7/g6", "is no tolerance"),
        ("25Q9", "ISO 286 has no Q9"),
        ("0.4 ±0.5", "allows a size of 0"),
    ] {
        let found = check(&with(
            &default_job("hole").unwrap(),
            "cycle.diameter",
            text(typed),
        ));
        let [only] = found.as_slice() else {
            panic!("{typed}: {found:?}")
        };
        assert_eq!(
            (only.code.as_str(), only.path.as_str()),
            ("not-a-tolerance", "cycle.diameter"),
            "{typed}"
        );
        assert!(only.message.starts_with("Diameter: "), "{}", only.message);
        assert!(only.message.contains(why), "{}", only.message);
    }
    for typed in [
        "25", "80/2+0.5", "1-1/2", "25+1", "1 1/2", "25 mm", "x", "", "=40*2", "25+", "H7", "1,000",
    ] {
        let found = check(&with(
            &default_job("hole").unwrap(),
            "cycle.diameter",
            text(typed),
        ));
        assert!(
            found[0]
                .message
                .starts_with("Diameter must be a number, not "),
            "{typed}: {}",
            found[0].message
        );
    }
    let said = |typed: &str| {
        let found = check(&with(
            &default_job("hole").unwrap(),
            "cycle.diameter",
            text(typed),
        ));
        found[0].message.clone()
    };
    // Refused readings, and what to enter instead.
    for (typed, hint) in [
        ("1,000", "enter 1000 or 1"),
        ("1-1/2", "enter 1 1/2 or 1 - 1/2"),
        ("40x2", "enter * to multiply"),
        ("1/0", "it divides by zero"),
    ] {
        assert!(
            said(typed).ends_with(hint) || said(typed).contains(hint),
            "{typed}: {}",
            said(typed)
        );
    }
    // Tolerances with a meaning keep it.
    let circles = with(
        &default_job("probing-two-circles").unwrap(),
        "cycle.diameter1",
        text("20+0.021"),
    );
    assert!(plan(&circles).is_ok());
    let moved = with(
        &default_job("hole").unwrap(),
        "cycle.origin",
        point([0.0; 3]),
    );
    assert!(
        check(&with(&moved, "feeds.approach", text("2000+0.5")))[0]
            .message
            .contains("has no tolerance")
    );
}
