//! The stock: one body, into which the features are cut.

use crate::geom::{Plane, Vec2, Vec3};
use crate::part::{Opening, Sides, Stock};
use crate::view::material::{Material, circle, within};
use crate::view::scene::blocks::{Block, Face};
use crate::view::scene::{Projection, Scene};

impl Scene {
    /// Draws the stock with the openings of the features.
    pub fn put_stock(
        &mut self,
        stock: &Stock,
        openings: &[Opening],
        plane: Plane,
        view: Projection,
    ) {
        let spot = |p: Vec3| view.place(plane, p);
        let mut face = |corners: Vec<Vec2>| {
            self.blocks.push(Block {
                face: Face::Away,
                corners,
            });
        };
        if view == Projection::Isometric {
            for axis in 0..3 {
                let towards = Vec3::AXES[axis].dot(view.towards(plane)) > 0.0;
                face(side(stock, axis, towards).into_iter().map(spot).collect());
            }
            return;
        }
        let [low, high] = [stock.low, stock.high].map(spot);
        let (low, high) = (low.min(high), low.max(high));
        let body = rectangle(low, high);
        face(body.clone());
        let up = plane.basis()[2];
        let open = openings.iter().map(|opening| {
            let outline = in_plan(opening, stock, plane);
            if view == Projection::Top {
                return outline;
            }
            // From a side: its full width, from its floor to the top of the stock.
            let [a, o, _] = plane.basis();
            let right = outline
                .iter()
                .map(|at| spot(a * at.x + o * at.y).x)
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| {
                    [least.min(x), most.max(x)]
                });
            let floor = spot(up * opening.floor).y;
            rectangle(
                Vec2::new(right[0].max(low.x), floor.max(low.y)),
                Vec2::new(right[1].min(high.x), high.y),
            )
        });
        let body = Material::Body {
            open: open.filter(|outline| outline.len() > 2).collect(),
            outline: body,
        };
        self.material.insert(0, body);
    }
}

/// Outline of an opening against the tool axis, within the stock.
fn in_plan(opening: &Opening, stock: &Stock, plane: Plane) -> Vec<Vec2> {
    let spot = |p: Vec3| Projection::Top.place(plane, p);
    match &opening.sides {
        Sides::Round { center, radius } => circle(spot(*center), *radius),
        Sides::Flat(walls) => {
            let [low, high] = [stock.low, stock.high].map(spot);
            walls
                .iter()
                .fold(rectangle(low, high), |outline, (point, normal)| {
                    within(&outline, spot(*point), spot(*normal))
                })
        }
    }
}

/// Counter-clockwise.
fn rectangle(low: Vec2, high: Vec2) -> Vec<Vec2> {
    vec![
        low,
        Vec2::new(high.x, low.y),
        high,
        Vec2::new(low.x, high.y),
    ]
}

/// Corners of the side of a stock that faces along an axis, or against it.
fn side(stock: &Stock, axis: usize, along: bool) -> [Vec3; 4] {
    let at = if along { stock.high } else { stock.low }[axis];
    let [b, c] = [(axis + 1) % 3, (axis + 2) % 3];
    [[0, 0], [1, 0], [1, 1], [0, 1]].map(|ends| {
        let end = |k: usize, axis: usize| [stock.low, stock.high][ends[k]][axis];
        let mut corner = Vec3::ZERO;
        corner[axis] = at;
        corner[b] = end(0, b);
        corner[c] = end(1, c);
        corner
    })
}
