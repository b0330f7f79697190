//! The display list of a part: what canvas and SVG draw of its walls and top sides, in pixels and in order. They differ in what a fill is (veils of the
//! theme's colours on a canvas, plain colours on paper), and so each plays it by itself; what is said of it is in [`crate::view::layout`].

use crate::geom::Vec2;
use crate::view::camera::Camera;
use crate::view::scene::Scene;
use crate::view::scene::top_faces::{Face, together};
use crate::view::walls::WallShape;

/// What is drawn in one.
#[derive(Debug)]
pub enum Item<'a> {
    /// Here belong the lines and the touches behind what has this top side: it hides of them what it hides.
    Behind(usize),
    /// A wall, or strips of a round one.
    Walls(Walls<'a>),
    /// The corners of a top side.
    Top(Vec<Vec2>),
}

/// A wall, or the strips of a round one, which have no seams.
#[derive(Debug)]
pub struct Walls<'a> {
    /// The first of them: the others look as it does.
    pub wall: &'a WallShape,
    /// What is seen edge-on: lines that continue from strip to strip, and so do their dashes.
    pub lines: Vec<Vec<Vec2>>,
    /// The corners of all others. The first two and the last two are the ends of a strip's edges.
    pub outlines: Vec<[Vec2; 4]>,
}

impl Scene {
    /// What is drawn of walls and top sides, the virtual part's where that `deviates`.
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
