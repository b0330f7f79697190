//! Touches with random scatter, drawn many times: the reference for uncertainties.

use crate::common::planned;
use touchpath::form::Value;
use touchpath::geom::Vec3;
use touchpath::part::{UncertaintySources, evaluate};

/// Spread of each result of a job with touches that scatter along their directions by 1 µm; the same in every run.
pub fn drawn_spreads(job: &Value, count: u32) -> Vec<Option<f64>> {
    let (plan, path) = (planned(job), touchpath::job::planned(job).unwrap().path);
    let mut normal = normals();
    let mut sums = vec![(0.0, 0.0); path.formula.results.len()];
    for _ in 0..count {
        let scattered: Vec<_> = plan
            .triggers
            .iter()
            .zip(&path.touches)
            .map(|(t, touch)| {
                Some(Vec3::from_array(t.unwrap()) + touch.vector * (0.001 * normal()))
            })
            .collect();
        let scatter = UncertaintySources {
            repeatability: 0.001,
            runout: None,
        };
        let rows = evaluate(&path, &scattered, scatter);
        for (sum, (row, own)) in sums.iter_mut().zip(rows.iter().zip(&plan.results)) {
            assert_eq!(row.code, own.code);
            let off = row.value.unwrap_or(f64::NAN) - own.value.unwrap_or(f64::NAN);
            *sum = (sum.0 + off, sum.1 + off * off);
        }
    }
    let n = f64::from(count);
    let spread = |(sum, squares): (f64, f64)| ((squares - sum * sum / n) / (n - 1.0)).sqrt();
    sums.into_iter()
        .map(|sum| Some(spread(sum)).filter(|spread| spread.is_finite()))
        .collect()
}

/// Random numbers with mean 0 and standard deviation 1, the same in every run.
fn normals() -> impl FnMut() -> f64 {
    let mut state = 0x9e37_79b9_7f4a_7c15u64;
    let mut uniform = move || {
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        (state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1u64 << 53) as f64
    };
    move || (-2.0 * (1.0 - uniform()).ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos()
}
