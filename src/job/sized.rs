//! Sizes that contain their tolerance, as on a drawing: `"diameter": "25 H7"`.

use crate::cycle::CycleDef;
use crate::form::{Field, Kind, Value};
use crate::tolerance;

/// A size with its tolerance.
#[derive(Clone, Debug)]
pub struct Sized {
    /// Field of the cycle; its key is also the code of the result.
    pub field: &'static Field,
    /// Text in the job.
    pub text: String,
    /// Nominal size, mm or degrees.
    pub nominal: f64,
    /// Smallest and largest size within the tolerance, mm or degrees.
    pub limits: [f64; 2],
}

impl Sized {
    /// Middle of the tolerance minus nominal, mm or degrees.
    pub fn middle(&self) -> f64 {
        f64::midpoint(self.limits[0], self.limits[1]) - self.nominal
    }
}

/// Sizes of a cycle with a tolerance. `scale` is mm in a unit of the job.
pub fn of(def: &CycleDef, cycle: &Value, scale: f64) -> Vec<Sized> {
    let one = |field: &'static Field| {
        let unit = match field.kind {
            Kind::Length if field.size => scale,
            Kind::Angle if field.size => 1.0,
            _ => return None,
        };
        let Some(Value::Text(text)) = cycle.get(field.key) else {
            return None;
        };
        let classes = (field.kind == Kind::Length).then_some(scale);
        let (nominal, limits) = tolerance::size(text, classes)?.ok()?;
        Some(Sized {
            field,
            text: text.clone(),
            nominal: nominal * unit,
            limits: limits.map(|x| x * unit),
        })
    };
    def.fields.iter().filter_map(one).collect()
}

/// Size limit, mm, for a job without one: `usual` plus the largest deviation that a tolerance allows. `None` if no size has a tolerance.
pub fn size_limit(sized: &[Sized], usual: f64) -> Option<f64> {
    let lengths = sized.iter().filter(|one| one.field.kind == Kind::Length);
    let reach = lengths.flat_map(|one| one.limits.map(|limit| (limit - one.nominal).abs()));
    reach.reduce(f64::max).map(|reach| usual + reach)
}
