//! Rows of the table without any motion.

use crate::cycle::ency::Pick;
use crate::cycle::ency::shape::{Placed, Probed, Seated};
use crate::form::Checker;
use crate::formula::Formula;
use crate::geom::{Frame, Plane, Vec3};
use crate::path::{Feature, Setup, Surface, Tracer};
use crate::text::Text;

/// No touch and no move.
pub struct Unmoving;

impl Probed for Unmoving {
    fn touches(&self, _frame: &Frame) -> Vec<(Vec3, Vec3, usize)> {
        Vec::new()
    }

    fn name(&self, _k: usize) -> Text {
        Text::words("")
    }

    fn rules(&self, _setup: &Setup, _checker: &mut Checker) {}

    fn check(&self, _picks: &[Pick], _plane: Plane, _checker: &mut Checker) {}

    fn place(&self, _picks: &[Pick], _plane: Plane) -> Placed {
        Placed::default()
    }

    fn walk(&self, _on: &Seated<'_>, _tracer: &mut Tracer) {}

    fn formula(&self, _on: &Seated<'_>) -> Formula {
        Formula::default()
    }

    fn surfaces(&self, _on: &Seated<'_>) -> Vec<Surface> {
        Vec::new()
    }

    fn feature(&self) -> Feature {
        Feature::Unmoving
    }
}
