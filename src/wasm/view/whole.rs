//! Pictures of programs and of LENTOAX: the module that a first visit loads is built without them.

use wasm_bindgen::prelude::*;

use super::View;
use crate::border::coded::decoded;
use crate::geom::Vec2;
use crate::import::toolpath::{Known, LONGEST_PROGRAM, run_program};
use crate::import::{fits, read_program};
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

    /// The same of a program that is run with what is known, coded; a text that is too long, or what is known wrongly, leaves the picture as it is.
    #[wasm_bindgen(js_name = showRunCoded)]
    pub fn show_run(&mut self, text: &str, codes: &[f64], known: &str) {
        let value = decoded(codes, known);
        let short = fits(text, LONGEST_PROGRAM);
        if let Some(known) = Known::of(&value).ok().filter(|_| short) {
            self.show_moves(run_program(text, &known), known.feature);
        }
    }

    /// Shows the answer of a LENTOAX query: the axes of the coordinate system, the lengths as arrows, and, where the workpiece
    /// system is turned, the base axes. A wrong query leaves the picture as it is and gives `false`.
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
