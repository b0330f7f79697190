//! Circles through points, fitted geometrically.

use glam::DMat3;

use crate::geom::{Vec2, Vec3};

/// A circle fitted to points of a plane.
#[derive(Clone, Debug)]
pub struct CircleFit {
    pub center: Vec2,
    pub radius: f64,
    /// Derivative of (centre abscissa, centre ordinate, radius) by a shift of each point along the first and along the second axis.
    pub by_point: Vec<[Vec3; 2]>,
    /// Root mean square distance of the points from the circle.
    pub residual: f64,
}

/// Fits the circle with the smallest sum of squared distances (geometric, Gauss-Newton); through three points it is exact. `None` if the points are collinear
/// or coincide.
pub fn fit_circle(points: &[Vec2]) -> Option<CircleFit> {
    let mean = points.iter().sum::<Vec2>() / points.len() as f64;
    let near: Vec<Vec2> = points.iter().map(|p| *p - mean).collect();
    let (mut center, mut radius) = algebraic(&near)?;
    // Derivative of a point's distance by centre and radius, and its distance from the centre.
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
    let square = near
        .iter()
        .map(|p| (p.distance(center) - radius).powi(2))
        .sum::<f64>();
    let residual = (square / near.len() as f64).sqrt();
    Some(CircleFit {
        by_point: by_point.collect(),
        center: center + mean,
        radius,
        residual,
    })
}

/// The circle that minimises Σ(x² + y² − 2ax − 2by − c)², as a starting value. The points are centred on the origin.
fn algebraic(near: &[Vec2]) -> Option<(Vec2, f64)> {
    let sum = |f: &dyn Fn(Vec2) -> f64| near.iter().map(|p| f(*p)).sum::<f64>();
    let (uu, vv, uv) = (
        sum(&|p| p.x * p.x),
        sum(&|p| p.y * p.y),
        sum(&|p| p.x * p.y),
    );
    let (uz, vz) = (
        sum(&|p| p.x * p.length_squared()),
        sum(&|p| p.y * p.length_squared()),
    );
    let det = 2.0 * (uu * vv - uv * uv);
    if near.len() < 3 || det.abs() <= 1e-14 * (uu + vv).powi(2) {
        return None;
    }
    let center = Vec2::new(vv * uz - uv * vz, uu * vz - uv * uz) / det;
    Some((
        center,
        (center.length_squared() + (uu + vv) / near.len() as f64).sqrt(),
    ))
}
