//! Circles through points: fitted geometrically, and by arithmetic that any control can do.

use glam::DMat3;

use crate::formula::{Expr, Formula, Function, Name, Value};
use crate::geom::{Vec2, Vec3};

/// A circle fitted to points of a plane.
#[derive(Clone, Debug)]
pub struct CircleFit {
    /// Its centre.
    pub center: Vec2,
    /// Its radius.
    pub radius: f64,
    /// The change of (centre, centre, radius) for a shift of each point along the first and along the second axis.
    pub by_point: Vec<[Vec3; 2]>,
}

/// The circle with the least sum of squared distances (geometric, by Gauss and Newton); through three points the exact one.
/// None where the points lie on a line or on one spot.
pub fn fit_circle(points: &[Vec2]) -> Option<CircleFit> {
    let mean = points.iter().sum::<Vec2>() / points.len() as f64;
    let near: Vec<Vec2> = points.iter().map(|p| *p - mean).collect();
    let (mut center, mut radius) = algebraic(&near)?;
    // How a point pulls at centre and radius, and how far from the centre it is.
    let pull = |p: Vec2, center: Vec2| {
        let far = p.distance(center);
        (((p - center) / far).extend(1.0), far)
    };
    let mut inverse = DMat3::ZERO;
    for _ in 0..50 {
        let (mut normal, mut right) = (DMat3::ZERO, Vec3::ZERO);
        for p in &near {
            let (row, far) = pull(*p, center);
            normal += DMat3::from_cols(row * row.x, row * row.y, row * row.z);
            right += row * (far - radius);
        }
        if normal.determinant().abs() <= 1e-300 {
            return None;
        }
        inverse = normal.inverse();
        let step = inverse * right;
        center += step.truncate();
        radius += step.z;
        if step.abs().max_element() < 1e-13 * radius.abs() {
            break;
        }
    }
    if !(center.is_finite() && radius.is_finite()) {
        return None;
    }
    let by_point = near.iter().map(|p| {
        let row = pull(*p, center).0;
        [inverse * row * row.x, inverse * row * row.y]
    });
    Some(CircleFit { by_point: by_point.collect(), center: center + mean, radius })
}

/// The circle that minimises Σ(x² + y² − 2ax − 2by − c)², to start from. The points lie about the origin.
fn algebraic(near: &[Vec2]) -> Option<(Vec2, f64)> {
    let sum = |f: &dyn Fn(Vec2) -> f64| near.iter().map(|p| f(*p)).sum::<f64>();
    let (uu, vv, uv) = (sum(&|p| p.x * p.x), sum(&|p| p.y * p.y), sum(&|p| p.x * p.y));
    let (uz, vz) = (sum(&|p| p.x * p.length_squared()), sum(&|p| p.y * p.length_squared()));
    let det = 2.0 * (uu * vv - uv * uv);
    if near.len() < 3 || det.abs() <= 1e-14 * (uu + vv).powi(2) {
        return None;
    }
    let center = Vec2::new(vv * uz - uv * vz, uu * vz - uv * uz) / det;
    Some((center, (center.length_squared() + (uu + vv) / near.len() as f64).sqrt()))
}

impl Formula {
    /// Kåsa's circle: minimises the sum of (x² + y² − 2ax − 2by − c)² about the mean of the points.
    pub(super) fn circle(&mut self, number: usize, first: usize, count: usize, (a, o): (usize, usize)) -> [Value; 3] {
        let own = |rest: &'static str| Name::new("c", number).and(rest);
        let n = || Expr::Number(count as f64);
        let samples = first..first + count;
        let mean = |axis: usize| Expr::sum(samples.clone().map(|k| Expr::trigger(k, axis))) / n();
        let (mean_a, mean_o) = (mean(a), mean(o));
        let mean_a = self.set(own("_mean_a"), mean_a);
        let mean_o = self.set(own("_mean_o"), mean_o);
        let mut sums: [Option<Value>; 5] = Default::default();
        for k in samples {
            let u = self.set(Name::new("u", k + 1), Expr::trigger(k, a) - mean_a);
            let v = self.set(Name::new("v", k + 1), Expr::trigger(k, o) - mean_o);
            let z = self.set(Name::new("w", k + 1), u * u + v * v);
            let terms = [u * u, v * v, u * v, u * z, v * z];
            for (i, (sum, term)) in sums.iter_mut().zip(terms).enumerate() {
                let name = own(["_uu_", "_vv_", "_uv_", "_uz_", "_vz_"][i]).at(k - first + 1);
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
        let det = self.set(own("_det"), det);
        let u = (vv * uz - uv * vz) / det;
        let u = self.set(own("_u"), u);
        let v = self.set(own("_v"), (uu * vz - uv * uz) / det);
        let square = u * u + v * v + (uu + vv) / n();
        let x = self.set(own("_a"), mean_a + u);
        let y = self.set(own("_o"), mean_o + v);
        let r = self.set(own("_r"), Expr::Call(Function::Sqrt, Box::new(square)));
        [x, y, r]
    }
}
