//! The façade in a browser, and the picture on a real canvas.
#![cfg(target_arch = "wasm32")]

mod wasm;

use touchpath::wasm::View;
use wasm_bindgen::JsCast;
use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};
use web_sys::HtmlCanvasElement;

wasm_bindgen_test_configure!(run_in_browser);

fn canvas() -> HtmlCanvasElement {
    let make = js_sys::Function::new_no_args("return document.createElement('canvas')");
    make.call0(&wasm_bindgen::JsValue::NULL)
        .unwrap()
        .unchecked_into()
}

/// Number of pixels that differ from the first one.
fn painted(canvas: &HtmlCanvasElement) -> u32 {
    let count = js_sys::Function::new_with_args(
        "canvas",
        "const d = new Uint32Array(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer);
         return d.reduce((n, p) => n + (p !== d[0]), 0)",
    );
    count
        .call1(&wasm_bindgen::JsValue::NULL, canvas)
        .unwrap()
        .as_f64()
        .unwrap() as u32
}

#[wasm_bindgen_test]
fn a_picture_is_drawn_picked_and_dragged() {
    let canvas = canvas();
    let mut view = View::new(canvas.clone()).expect("a canvas has a context");
    view.resize(400.0, 300.0, 2.0);
    assert_eq!(
        (canvas.width(), canvas.height()),
        (800, 600),
        "sharp on a dense screen"
    );
    assert_eq!(painted(&canvas), 0);
    let (codes, text) = wasm::coded(&wasm::pocket());
    assert!(view.show(&codes, &text));
    assert!(painted(&canvas) > 2000);
    for name in ["front", "side", "isometric", "top"] {
        view.look(name);
        assert!(painted(&canvas) > 1000, "{name}");
    }
    // The middle of the picture is the centre of the pocket: links start there, and the shift handle is there.
    assert!(view.pick(200.0, 150.0).is_some());
    assert_eq!(view.pick(2.0, 2.0), None);
    assert_eq!(view.handle_at(200.0, 150.0, None).as_deref(), Some("shift"));
    let lie = view.drag_part("shift", 200.0, 150.0).unwrap();
    assert_eq!(wasm::text(&lie), r#"{"offset":[0,0,0],"rotation":0}"#);
    let turned = view.drag_part("turn", 200.0, 50.0).unwrap();
    assert_eq!(wasm::get(&turned, "rotation").as_f64(), Some(90.0));
    let (codes, text) = wasm::coded(&wasm::parse("{}"));
    assert!(
        !view.show(&codes, &text),
        "a refused job leaves the picture"
    );
    assert!(painted(&canvas) > 2000);
}
