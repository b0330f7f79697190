//! The JavaScript façade, called like from JavaScript: plain objects in, plain objects out.

use js_sys::{Array, Function, JSON, Object, Reflect};
use touchpath::wasm;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_test::wasm_bindgen_test;

pub fn parse(text: &str) -> JsValue {
    JSON::parse(text).expect("JSON")
}

pub fn text(value: &JsValue) -> String {
    JSON::stringify(value).expect("plain data").into()
}

pub fn get(value: &JsValue, key: &str) -> JsValue {
    Reflect::get(value, &key.into()).expect("a property")
}

/// A value coded for the module: `codes` and `text`. tests/package tests the package's own coding.
pub fn coded(value: &JsValue) -> (Vec<f64>, String) {
    let mut out = (Vec::new(), String::new());
    code(value, &mut out);
    out
}

fn code(value: &JsValue, out: &mut (Vec<f64>, String)) {
    let length = |text: &str| text.encode_utf16().count() as f64;
    if let Some(text) = value.as_string() {
        out.0.extend([4.0, length(&text)]);
        out.1.push_str(&format!("{text}\n"));
    } else if let Some(x) = value.as_f64() {
        out.0.extend([3.0, x]);
    } else if let Some(on) = value.as_bool() {
        out.0.push(if on { 2.0 } else { 1.0 });
    } else if value.is_null() {
        out.0.push(0.0);
    } else if value.is_undefined() {
        out.0.extend([7.0, 0.0]);
    } else if Array::is_array(value) {
        let items = Array::from(value);
        out.0.extend([5.0, f64::from(items.length())]);
        items.iter().for_each(|item| code(&item, out));
    } else {
        let keys = Object::keys(value.unchecked_ref::<Object>());
        out.0.extend([6.0, f64::from(keys.length())]);
        for key in keys
            .iter()
            .map(|key| key.as_string().expect("keys are texts"))
        {
            out.0.push(length(&key));
            out.1.push_str(&format!("{key}\n"));
            code(&get(value, &key), out);
        }
    }
}

fn check(job: &JsValue) -> JsValue {
    let (codes, text) = coded(job);
    wasm::check(&codes, &text).expect("check never throws")
}

/// Output of the module for a plan: its text, and the number of values.
fn plan(job: &JsValue) -> Result<(String, usize), JsValue> {
    let (codes, text) = coded(job);
    let taken = Function::new_no_args(
        "return { take(numbers, text) { this.numbers = numbers.slice(); this.text = text; } }",
    );
    let sink = taken.call0(&JsValue::NULL).expect("the snippet runs");
    wasm::plan(&codes, &text, sink.unchecked_ref())?;
    let numbers: js_sys::Float64Array = get(&sink, "numbers").dyn_into().expect("numbers");
    Ok((
        get(&sink, "text").as_string().expect("a text"),
        numbers.length() as usize,
    ))
}

fn codes_of(findings: &JsValue) -> Vec<String> {
    Array::from(findings)
        .iter()
        .map(|f| {
            format!(
                "{} {}",
                get(&f, "code").as_string().unwrap(),
                get(&f, "path").as_string().unwrap()
            )
        })
        .collect()
}

pub fn pocket() -> JsValue {
    wasm::default_job(&"internal-rectangle-protected".into(), &JsValue::UNDEFINED)
        .expect("a default job")
}

#[wasm_bindgen_test]
fn a_plan_comes_as_numbers_and_a_text() {
    let (text, numbers) = plan(&pocket()).expect("a plan");
    assert!(
        text.starts_with("linuxcncngc(Job: POCKET-80X50)\n"),
        "{}",
        &text[..40]
    );
    assert!(text.contains("\nM2\n") && text.contains("center.x"));
    // 27 moves of three numbers and four words, and more.
    assert!(numbers > 7 * 27);
}

/// Codes come only from the package. No codes cause a panic or a read beyond their end.
#[wasm_bindgen_test]
fn codes_that_nobody_writes_are_something_unreadable() {
    let (codes, text) = coded(&pocket());
    let found = |codes: &[f64], text: &str| {
        codes_of(&wasm::check(codes, text).expect("check never throws"))
    };
    for end in 0..codes.len() {
        assert!(!found(&codes[..end], &text).is_empty(), "{end}");
    }
    for end in 0..text.len() {
        assert!(!found(&codes, &text[..end]).is_empty(), "{end}");
    }
    for strange in [f64::NAN, -1.0, 8.0, 1e300, f64::INFINITY, 0.5] {
        for at in 0..codes.len() {
            let mut codes = codes.clone();
            codes[at] = strange;
            found(&codes, &text);
        }
    }
    let deep: Vec<f64> = [5.0, 1.0].repeat(100_000);
    assert_eq!(found(&deep, ""), ["wrong-type "]);
    assert_eq!(found(&[4.0, 1.0], "\u{1F600}\n"), ["wrong-type "]);
}

#[wasm_bindgen_test]
fn check_lists_and_plan_throws_the_same() {
    let job = parse(
        r#"{ "format": 1, "speed": 1, "cycle": { "type": "internal-rectangle-protected", "depth": -1 } }"#,
    );
    let listed = check(&job);
    assert_eq!(
        codes_of(&listed),
        ["unknown-key speed", "out-of-range cycle.depth"]
    );
    let error = plan(&job).expect_err("a refused job");
    assert_eq!(get(&error, "name").as_string().unwrap(), "JobError");
    assert_eq!(text(&get(&error, "findings")), text(&listed));
    assert!(wasm::default_job(&JsValue::from_f64(7.0), &JsValue::UNDEFINED).is_err());
    for units in [JsValue::from("cm"), JsValue::NULL, JsValue::from_f64(25.4)] {
        let error = wasm::default_job(&"hole".into(), &units).expect_err("no such units");
        assert_eq!(codes_of(&get(&error, "findings")), ["unknown-value units"]);
    }
}

#[wasm_bindgen_test]
fn measured_points_are_evaluated() {
    let points = parse("[[37.1,0,-10],{\"x\":-36.9,\"y\":0,\"z\":-10},[0,22.2,-10],[0,-21.8,-10]]");
    let ((codes, text), (measured, measured_text)) = (coded(&pocket()), coded(&points));
    let found = wasm::measure(&codes, &text, &measured, &measured_text).expect("results");
    let first = Array::from(&get(&found, "results")).get(0);
    assert_eq!(get(&first, "code").as_string().unwrap(), "center.x");
    assert!((get(&first, "value").as_f64().unwrap() - 0.1).abs() < 1e-9);
    assert_eq!(
        (
            Array::from(&get(&found, "points")).length(),
            get(&found, "block").is_null()
        ),
        (4, true)
    );
    let error =
        wasm::measure(&codes, &text, &[4.0, 8.0], "37,0,-10\n").expect_err("one point of four");
    assert_eq!(codes_of(&get(&error, "findings")), ["wrong-count measured"]);
}

#[wasm_bindgen_test]
fn the_catalog_says_what_a_form_needs() {
    let catalog = wasm::catalog().unwrap();
    let cycle = Array::from(&get(&catalog, "cycles")).get(0);
    assert_eq!(
        get(&cycle, "type").as_string().unwrap(),
        "internal-rectangle-protected"
    );
    let width = Array::from(&get(&cycle, "fields"))
        .iter()
        .find(|f| get(f, "key") == "width1")
        .expect("width 1");
    assert_eq!(text(&get(&width, "range")), "[0.001,10000]");
    assert_eq!(get(&width, "code").as_string().unwrap(), "CmdPrm.Flt[-53]");
    let grbl = Array::from(&get(&catalog, "posts"))
        .iter()
        .find(|p| get(p, "id") == "grbl")
        .expect("grbl");
    let refused = Array::from(&get(&grbl, "cycles"))
        .iter()
        .find(|c| get(c, "form") == "cycle")
        .unwrap();
    assert_eq!(get(&refused, "supported"), JsValue::FALSE);
    assert!(get(&refused, "reason").is_string());
    assert_eq!(wasm::version(), env!("CARGO_PKG_VERSION"));
    let _: &Object = catalog.unchecked_ref();
}

#[wasm_bindgen_test]
fn units_are_converted_with_tolerances() {
    let job = parse(
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles", "diameter1": "10H7", "diameter2": 25.4 }, "note": "x" }"#,
    );
    let (codes, texts) = coded(&job);
    let inch = wasm::convert_units(&codes, &texts, &"inch".into()).expect("units");
    assert_eq!(
        text(&inch),
        r#"{"format":1,"cycle":{"type":"probing-two-circles","diameter1":"0.393701H7","diameter2":1},"note":"x","units":"inch"}"#
    );
    assert!(wasm::convert_units(&codes, &texts, &"cm".into()).is_err());
}

/// A header changes only known keys of the object.
#[wasm_bindgen_test]
fn a_header_cannot_reach_the_prototype() {
    let program = "; job cycle.type=hole __proto__.x=1 constructor.prototype.y=1\nG71\nG90\nM30\n";
    let imported = wasm::import_job(&program.into(), &[], "").expect("a job");
    let job = get(&imported, "job");
    assert_eq!(text(&job), r#"{"format":1,"cycle":{"type":"hole"}}"#);
    assert!(get(&job, "x").is_undefined() && get(&Object::new().into(), "x").is_undefined());
}
