//! Circles through points: fitted geometrically, and by arithmetic that any control can do.

use crate::formula::{Expr, Formula, Function, Value};

/// A circle fitted to points of a plane.
#[derive(Clone, Debug)]
pub struct CircleFit {
    /// Its centre.
    pub center: (f64, f64),
    /// Its radius.
    pub radius: f64,
    /// The change of (centre, centre, radius) for a shift of each point along the first and along the second axis.
    pub by_point: Vec<([f64; 3], [f64; 3])>,
}

/// The circle with the least sum of squared distances (geometric, by Gauss and Newton); through three points the exact one.
/// None where the points lie on a line or on one spot.
pub fn fit_circle(points: &[(f64, f64)]) -> Option<CircleFit> {
    let n = points.len() as f64;
    let mean = points.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let near: Vec<(f64, f64)> = points.iter().map(|p| (p.0 - mean.0, p.1 - mean.1)).collect();
    // The algebraic circle to start from.
    let sum = |f: &dyn Fn(f64, f64) -> f64| near.iter().map(|p| f(p.0, p.1)).sum::<f64>();
    let (uu, vv, uv) = (sum(&|u, _| u * u), sum(&|_, v| v * v), sum(&|u, v| u * v));
    let (uz, vz) = (sum(&|u, v| u * (u * u + v * v)), sum(&|u, v| v * (u * u + v * v)));
    let det = 2.0 * (uu * vv - uv * uv);
    if points.len() < 3 || det.abs() <= 1e-14 * (uu + vv).powi(2) {
        return None;
    }
    let mut c = ((vv * uz - uv * vz) / det, (uu * vz - uv * uz) / det);
    let mut r = (c.0 * c.0 + c.1 * c.1 + (uu + vv) / n).sqrt();
    let mut inverse = [[0.0; 3]; 3];
    for _ in 0..50 {
        let mut normal = [[0.0; 3]; 3];
        let mut right = [0.0; 3];
        for p in &near {
            let far = (p.0 - c.0).hypot(p.1 - c.1);
            let row = [(p.0 - c.0) / far, (p.1 - c.1) / far, 1.0];
            for i in 0..3 {
                right[i] += row[i] * (far - r);
                for j in 0..3 {
                    normal[i][j] += row[i] * row[j];
                }
            }
        }
        inverse = invert(normal)?;
        let step: Vec<f64> = inverse.iter().map(|row| (0..3).map(|j| row[j] * right[j]).sum()).collect();
        c = (c.0 + step[0], c.1 + step[1]);
        r += step[2];
        if step.iter().all(|s: &f64| s.abs() < 1e-13 * r.abs()) {
            break;
        }
    }
    if !(c.0.is_finite() && c.1.is_finite() && r.is_finite()) {
        return None;
    }
    let by_point = near
        .iter()
        .map(|p| {
            let far = (p.0 - c.0).hypot(p.1 - c.1);
            let row = [(p.0 - c.0) / far, (p.1 - c.1) / far, 1.0];
            let along: Vec<f64> = inverse.iter().map(|line| (0..3).map(|j| line[j] * row[j]).sum()).collect();
            let scaled = |by: f64| [along[0] * by, along[1] * by, along[2] * by];
            (scaled(row[0]), scaled(row[1]))
        })
        .collect();
    Some(CircleFit { center: (c.0 + mean.0, c.1 + mean.1), radius: r, by_point })
}

/// The inverse of a 3 × 3 matrix; none where there is none.
fn invert(m: [[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let minor = |i: usize, j: usize| {
        let (a, b, c, d) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let det: f64 = (0..3).map(|j| m[0][j] * minor(0, j)).sum();
    (det.abs() > 1e-300).then(|| std::array::from_fn(|i| std::array::from_fn(|j| minor(j, i) / det)))
}

impl Formula {
    /// Kåsa's circle: minimises the sum of (x² + y² − 2ax − 2by − c)² about the mean of the points.
    pub(super) fn circle(&mut self, number: usize, first: usize, count: usize, (a, o): (usize, usize)) -> [Value; 3] {
        let n = || Expr::Number(count as f64);
        let samples = first..first + count;
        let mean = |axis: usize| Expr::sum(samples.clone().map(|k| Expr::trigger(k, axis))) / n();
        let (mean_a, mean_o) = (mean(a), mean(o));
        let mean_a = self.set(format!("c{number}_mean_a"), mean_a);
        let mean_o = self.set(format!("c{number}_mean_o"), mean_o);
        let mut sums: [Option<Value>; 5] = Default::default();
        for k in samples {
            let u = self.set(format!("u{}", k + 1), Expr::trigger(k, a) - mean_a);
            let v = self.set(format!("v{}", k + 1), Expr::trigger(k, o) - mean_o);
            let z = self.set(format!("w{}", k + 1), u * u + v * v);
            let terms = [u * u, v * v, u * v, u * z, v * z];
            for (i, (sum, term)) in sums.iter_mut().zip(terms).enumerate() {
                let name = format!("c{number}_{}_{}", ["uu", "vv", "uv", "uz", "vz"][i], k - first + 1);
                *sum = Some(self.set(
                    name,
                    match *sum {
                        Some(sum) => sum + term,
                        None => term,
                    },
                ));
            }
        }
        let [uu, vv, uv, uz, vz] = sums.map(|s| s.expect("three points or more"));
        let det = (uu * vv - uv * uv) * Expr::Number(2.0);
        let det = self.set(format!("c{number}_det"), det);
        let u = (vv * uz - uv * vz) / det;
        let u = self.set(format!("c{number}_u"), u);
        let v = self.set(format!("c{number}_v"), (uu * vz - uv * uz) / det);
        let square = u * u + v * v + (uu + vv) / n();
        let x = self.set(format!("c{number}_a"), mean_a + u);
        let y = self.set(format!("c{number}_o"), mean_o + v);
        let r = self.set(format!("c{number}_r"), Expr::Call(Function::Sqrt, Box::new(square)));
        [x, y, r]
    }
}
