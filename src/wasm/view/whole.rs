//! Pictures of programs and of LENTOAX, which a first visit does not need.

use js_sys::{Float64Array, Reflect, Uint8Array};
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;

use super::View;
use crate::border::coded::decoded;
use crate::geom::{Plane, Vec2};
use crate::import::toolpath::{LONGEST_PROGRAM, RunInputs};
use crate::import::{Toolpath, fits, read_program};
use crate::job;
use crate::view::camera::Camera;
use crate::view::lengths;

#[wasm_bindgen]
impl View {
    /// Shows the moves of any program, as `readProgram` reads it.
    #[wasm_bindgen(js_name = showProgram)]
    pub fn show_program(&mut self, text: &str) {
        if !fits(text, LONGEST_PROGRAM) {
            return;
        }
        self.show_moves(read_program(text, None), None);
    }

    /// Shows the moves of a run, an object as returned by `runProgram`, on the part of its encoded inputs. An invalid run, or invalid inputs, leave the picture
    /// unchanged.
    #[wasm_bindgen(js_name = showRunCoded)]
    pub fn show_run(&mut self, run: &JsValue, codes: &[f64], known: &str) {
        let value = decoded(codes, known);
        if let (Some(mut path), Ok(known)) = (path_of(run), RunInputs::of(&value)) {
            path.start = known.start.unwrap_or([f64::NAN; 3]);
            self.show_moves(path, known.feature);
        }
    }

    /// Shows the answer of a LENTOAX query: the axes of the coordinate system, the lengths as arrows, and the base axes if the workpiece system is rotated. An
    /// invalid query leaves the picture unchanged and returns `false`.
    #[wasm_bindgen(js_name = showLentoaxCoded)]
    pub fn show_lentoax(&mut self, codes: &[f64], text: &str) -> bool {
        let Ok(query) = job::lentoax_query(&decoded(codes, text)) else {
            return false;
        };
        let arrows = lengths::arrows(&query);
        self.shown = None;
        // The longest arrows end at 1.15; their names need a little room beyond.
        let camera = Camera::fit(
            self.camera.size,
            [Vec2::splat(-1.25), Vec2::splat(1.25)],
            22.0,
        );
        self.painter.draw_arrows(&arrows, &camera);
        self.paint_lit();
        true
    }
}

/// The path of a run from its columns; `None` if they do not match.
fn path_of(run: &JsValue) -> Option<Toolpath> {
    let get = |name: &str| Reflect::get(run, &JsValue::from_str(name)).ok();
    let word = |name: &str| get(name).and_then(|word| word.as_string());
    let numbers = |name: &str| Some(get(name)?.dyn_into::<Float64Array>().ok()?.to_vec());
    let kind = get("kind")?.dyn_into::<Uint8Array>().ok()?.to_vec();
    let path = Toolpath {
        metric: word("units").map(|units| units == "mm"),
        to: numbers("to")?,
        arcs: rows(&numbers("arcs")?),
        contacts: rows(&numbers("contacts")?),
        resumes: rows(&numbers("resumes")?),
        systems: rows(&numbers("systems")?),
        plane: Plane::named(&word("plane")?),
        feed: numbers("feed")?,
        kind,
        ..Toolpath::default()
    };
    let count = path.kind.len();
    (path.to.len() == 3 * count && path.feed.len() == count).then_some(path)
}

/// Splits numbers into rows of this length.
fn rows<const N: usize>(numbers: &[f64]) -> Vec<[f64; N]> {
    let (rows, _) = numbers.as_chunks::<N>();
    rows.to_vec()
}
