//! Rows of the table without any motion.

use crate::cycle::ency::Pick;
use crate::cycle::ency::shape::{PlacedShape, Probed, TouchLayout};
use crate::form::Checker;
use crate::formula::Formula;
use crate::geom::{Frame, Plane, Vec3};
use crate::path::{Feature, ProbeSettings, Surface, Tracer};
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

    fn rules(&self, _setup: &ProbeSettings, _checker: &mut Checker) {}

    fn check(&self, _picks: &[Pick], _plane: Plane, _checker: &mut Checker) {}

    fn place(&self, _picks: &[Pick], _plane: Plane) -> PlacedShape {
        PlacedShape::default()
    }

    fn plan_steps(&self, _on: &TouchLayout<'_>, _tracer: &mut Tracer) {}

    fn formula(&self, _on: &TouchLayout<'_>) -> Formula {
        Formula::default()
    }

    fn surfaces(&self, _on: &TouchLayout<'_>) -> Vec<Surface> {
        Vec::new()
    }

    fn feature(&self) -> Feature {
        Feature::Unmoving
    }
}
