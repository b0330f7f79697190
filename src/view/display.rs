//! Display list of a part: walls and top sides for canvas and SVG, in pixels and in drawing order. They differ in their fills (veils of the theme's colours on
//! a canvas, plain colours on paper), so each draws the list itself; [`crate::view::layout`] has the texts.

use crate::geom::Vec2;
use crate::view::camera::Camera;
use crate::view::scene::Scene;
use crate::view::scene::top_faces::{Face, together};
use crate::view::walls::WallShape;

/// An item that is drawn at once.
#[derive(Debug)]
pub enum Item<'a> {
    /// Position of the lines and touches behind this top side, which hides them.
    Behind(usize),
    /// A wall, or strips of a round one.
    Walls(Walls<'a>),
    /// The corners of a top side.
    Top(Vec<Vec2>),
}

/// A wall, or the strips of a round one, drawn without seams.
#[derive(Debug)]
pub struct Walls<'a> {
    /// The first of them: the others look the same.
    pub wall: &'a WallShape,
    /// Walls seen edge-on: lines that continue from strip to strip, with their dashes.
    pub lines: Vec<Vec<Vec2>>,
    /// Corners of all others. The first two and the last two are the ends of a strip's edges.
    pub outlines: Vec<[Vec2; 4]>,
}

impl Scene {
    /// Display list of walls and top sides; with those of the virtual part if it `deviates`.
    pub fn display(&self, camera: &Camera, deviates: bool) -> Vec<Item<'_>> {
        let faces = self.faces(deviates);
        faces
            .chunk_by(together)
            .map(|faces| item(faces, camera))
            .collect()
    }
}

fn item<'a>(faces: &[Face<'a>], camera: &Camera) -> Item<'a> {
    let wall = match faces[0] {
        Face::Behind(of) => return Item::Behind(of),
        Face::Top(top) => {
            return Item::Top(
                top.corners
                    .iter()
                    .map(|corner| camera.pixel(*corner))
                    .collect(),
            );
        }
        Face::Wall(wall) => wall,
    };
    let mut walls = Walls {
        wall,
        lines: Vec::new(),
        outlines: Vec::new(),
    };
    for face in faces {
        let Face::Wall(WallShape { edge, corners, .. }) = face else {
            continue;
        };
        let Some([from, to]) = edge.map(|ends| ends.map(|end| camera.pixel(end))) else {
            walls
                .outlines
                .push(corners.map(|corner| camera.pixel(corner)));
            continue;
        };
        match walls.lines.last_mut() {
            Some(line) if line.last().is_some_and(|end| end.distance(from) < 0.1) => line.push(to),
            _ => walls.lines.push(vec![from, to]),
        }
    }
    Item::Walls(walls)
}
