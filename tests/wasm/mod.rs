//! The JavaScript façade, called as JavaScript calls it: plain objects in, plain objects out.

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

fn js(body: &str) -> JsValue {
    Function::new_no_args(body).call0(&JsValue::NULL).expect("the snippet runs")
}

fn codes(findings: &JsValue) -> Vec<String> {
    Array::from(findings)
        .iter()
        .map(|f| format!("{} {}", get(&f, "code").as_string().unwrap(), get(&f, "path").as_string().unwrap()))
        .collect()
}

pub fn pocket() -> JsValue {
    wasm::default_job(&"internal-rectangle-protected".into()).expect("a default job")
}

#[wasm_bindgen_test]
fn a_default_job_makes_a_plain_plan() {
    let plan = wasm::plan(&pocket()).expect("a plan");
    assert!(!plan.has_type::<js_sys::Map>());
    assert_eq!(Array::from(&get(&plan, "touches")).length(), 4);
    assert_eq!(Array::from(&get(&plan, "moves")).length(), 27);
    let first = text(&Array::from(&get(&plan, "moves")).get(0));
    assert_eq!(first, r#"{"to":[0,0,30],"feed":"approach","kind":"position","step":1,"touch":null,"arc":null}"#);
    let touch = text(&Array::from(&get(&plan, "touches")).get(0));
    assert_eq!(touch, r#"{"point":[40,0,-10],"vector":[-1,0,0],"group":0}"#);
    let row = text(&Array::from(&get(&plan, "table")).get(4));
    assert_eq!(
        row,
        r#"{"code":"CmdPrm.Flt[-53]","type":"Double","value":80,"meaning":"Width 1, from touch point 1 to touch point 2, along the first direction of the rectangle","field":"cycle.width1","touch":null}"#
    );
    assert_eq!(text(&get(&plan, "findings")), "[]");
    assert!(get(&get(&plan, "program"), "text").as_string().unwrap().starts_with("(Job: PROBE)\n"));
}

#[wasm_bindgen_test]
fn check_lists_and_plan_throws_the_same() {
    let job = parse(r#"{ "format": 1, "speed": 1, "cycle": { "type": "internal-rectangle-protected", "depth": -1 } }"#);
    let listed = wasm::check(&job).expect("check never throws");
    assert_eq!(codes(&listed), ["unknown-key speed", "out-of-range cycle.depth"]);
    let error = wasm::plan(&job).expect_err("a refused job");
    assert_eq!(get(&error, "name").as_string().unwrap(), "JobError");
    assert_eq!(text(&get(&error, "findings")), text(&listed));
    assert!(wasm::default_job(&JsValue::from_f64(7.0)).is_err());
}

#[wasm_bindgen_test]
fn what_json_cannot_say_is_found() {
    let broken = |body: &str| {
        let job = pocket();
        let change = Function::new_with_args("job", body);
        change.call1(&JsValue::NULL, &job).expect("the snippet runs");
        codes(&wasm::check(&job).expect("check never throws"))
    };
    assert_eq!(broken("job.cycle.width1 = NaN"), ["not-finite cycle.width1"]);
    assert_eq!(broken("job.overtravel = -Infinity"), ["not-finite overtravel"]);
    assert_eq!(broken("job.overtravel = 1n"), ["wrong-type overtravel"]);
    assert_eq!(broken("job.name = () => 1"), ["wrong-type name"]);
    assert_eq!(
        broken("job.feeds = job"),
        [
            "unknown-key feeds.format",
            "unknown-key feeds.name",
            "unknown-key feeds.units",
            "unknown-key feeds.plane",
            "unknown-key feeds.overtravel",
            "unknown-key feeds.stylus",
            "unknown-key feeds.feeds",
            "unknown-key feeds.control",
            "unknown-key feeds.tool",
            "unknown-key feeds.part",
            "unknown-key feeds.cycle"
        ]
    );
    assert_eq!(broken("Object.defineProperty(job, 'name', { enumerable: true, get() { throw 1 } })"), ["wrong-type name"]);
    assert_eq!(broken("job.cycle.origin = new Array(4e9 - 5e8)"), ["wrong-type cycle.origin"]);
    // undefined is a key that is not there, never null: a feed does not become rapid.
    assert!(broken("job.feeds.approach = undefined").is_empty());
}

#[wasm_bindgen_test]
fn nothing_that_can_be_handed_over_panics() {
    for body in [
        "return undefined",
        "return null",
        "return 7",
        "return 'job'",
        "return Symbol('x')",
        "return []",
        "const a = {}; a.a = a; a.cycle = a; return a",
        "return new Proxy({}, { get() { throw 1 }, ownKeys() { throw 2 } })",
        "return Object.create(null)",
        "let a = {}; for (let i = 0; i < 5000; i++) a = { cycle: a }; return a",
        "const a = {}; for (let i = 0; i < 60000; i++) a['k' + i] = i; return a",
        "return { format: 1, cycle: new Map([['type', 'internal-rectangle-protected']]) }",
        "return { format: 1, cycle: { type: 'double-wall-internal-corner', origin: new Float64Array(3) } }",
    ] {
        let value = js(body);
        let found = wasm::check(&value).expect("check never throws");
        assert!(Array::from(&found).length() > 0, "{body}");
        assert!(wasm::plan(&value).is_err(), "{body}");
        assert!(wasm::evaluate(&pocket(), &value).is_err(), "{body}");
    }
}

#[wasm_bindgen_test]
fn moves_as_columns_are_the_moves() {
    let plan = wasm::plan(&pocket()).unwrap();
    let columns = wasm::move_columns(&pocket()).unwrap();
    let moves = Array::from(&get(&plan, "moves"));
    let to: js_sys::Float64Array = get(&columns, "to").dyn_into().unwrap();
    let kind: js_sys::Uint8Array = get(&columns, "kind").dyn_into().unwrap();
    let touch: js_sys::Int32Array = get(&columns, "touch").dyn_into().unwrap();
    let kinds = Array::from(&get(&columns, "kinds"));
    assert_eq!(to.length(), 3 * moves.length());
    for (i, step) in moves.iter().enumerate() {
        let i = i as u32;
        let place = Array::from(&get(&step, "to"));
        for axis in 0..3 {
            assert_eq!(place.get(axis).as_f64().unwrap(), to.get_index(3 * i + axis));
        }
        assert_eq!(get(&step, "kind"), kinds.get(u32::from(kind.get_index(i))));
        assert_eq!(get(&step, "touch").as_f64().unwrap_or(-1.0), f64::from(touch.get_index(i)));
    }
}

#[wasm_bindgen_test]
fn measured_points_are_evaluated() {
    let points = parse("[[37.1,0,-10],{\"x\":-36.9,\"y\":0,\"z\":-10},[0,22.2,-10],[0,-21.8,-10]]");
    let rows = wasm::evaluate(&pocket(), &points).expect("results");
    let first = Array::from(&rows).get(0);
    assert_eq!(get(&first, "code").as_string().unwrap(), "center.x");
    assert!((get(&first, "value").as_f64().unwrap() - 0.1).abs() < 1e-9);
    let error = wasm::evaluate(&pocket(), &"37,0,-10".into()).expect_err("one point of four");
    assert_eq!(codes(&get(&error, "findings")), ["wrong-count measured"]);
}

#[wasm_bindgen_test]
fn the_catalog_says_what_a_form_needs() {
    let catalog = wasm::catalog().unwrap();
    let cycle = Array::from(&get(&catalog, "cycles")).get(0);
    assert_eq!(get(&cycle, "type").as_string().unwrap(), "internal-rectangle-protected");
    let width = Array::from(&get(&cycle, "fields")).iter().find(|f| get(f, "key") == "width1").expect("width 1");
    assert_eq!(text(&get(&width, "range")), "[0.001,10000]");
    assert_eq!(get(&width, "code").as_string().unwrap(), "CmdPrm.Flt[-53]");
    let grbl = Array::from(&get(&catalog, "posts")).iter().find(|p| get(p, "id") == "grbl").expect("grbl");
    let refused = Array::from(&get(&grbl, "cycles")).iter().find(|c| get(c, "form") == "cycle").unwrap();
    assert_eq!(get(&refused, "supported"), JsValue::FALSE);
    assert!(get(&refused, "reason").is_string());
    assert_eq!(wasm::version(), env!("CARGO_PKG_VERSION"));
    let _: &Object = catalog.unchecked_ref();
}

/// An exception that passes through the module leaves it unusable: `Array.isArray` throws on a revoked proxy.
#[wasm_bindgen_test]
fn a_revoked_proxy_is_a_value_like_any_other() {
    let revoked = js("const { proxy, revoke } = Proxy.revocable([], {}); revoke(); return proxy;");
    for _ in 0..3000 {
        let findings = wasm::check(&revoked).expect("check never throws");
        assert_eq!(codes(&findings), ["wrong-type "]);
    }
    assert_eq!(text(&wasm::check(&pocket()).expect("check never throws")), "[]");
}

#[wasm_bindgen_test]
fn texts_count_in_what_a_job_can_hold() {
    let long = js("return { format: 1, name: 'x'.repeat(50e6), cycle: { type: 'hole' } };");
    assert_eq!(codes(&wasm::check(&long).expect("check never throws")), ["wrong-type name"]);
    let error = wasm::import_job(&js("return ' '.repeat(50e6);")).expect_err("too long");
    assert_eq!(codes(&get(&error, "findings")), ["text-too-long "]);
    let keys = js("const o = {}; for (let i = 0; i < 3000; i++) o['k'.repeat(1000) + i] = 1; return o;");
    assert!(!codes(&wasm::check(&keys).expect("check never throws")).is_empty());
}

#[wasm_bindgen_test]
fn units_are_converted_with_tolerances() {
    let job = parse(
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles", "diameter1": "10H7", "diameter2": 25.4 }, "note": "x" }"#,
    );
    let inch = wasm::convert_units(&job, &"inch".into()).expect("units");
    assert_eq!(
        text(&inch),
        r#"{"format":1,"cycle":{"type":"probing-two-circles","diameter1":"0.393701H7","diameter2":1},"note":"x","units":"inch"}"#
    );
    assert!(wasm::convert_units(&job, &"cm".into()).is_err());
}

/// A header changes nothing of the object but what a job has a place for.
#[wasm_bindgen_test]
fn a_header_cannot_reach_the_prototype() {
    let program = "; job cycle.type=hole __proto__.x=1 constructor.prototype.y=1\nG71\nG90\nM30\n";
    let imported = wasm::import_job(&program.into()).expect("a job");
    let job = get(&imported, "job");
    assert_eq!(text(&job), r#"{"format":1,"cycle":{"type":"hole"}}"#);
    assert!(get(&job, "x").is_undefined() && get(&Object::new().into(), "x").is_undefined());
}
