//! A scene as an SVG: for the manual, and for whatever prints.

use std::fmt::Write;

use crate::num::decimal;
use crate::view::scene::{Line, Scene, Spot, Stroke, TouchShape, WallShape};

/// Width of the picture, and how much of it stays free at its edges, in its own units.
const WIDTH: f64 = 480.0;
const MARGIN: f64 = 28.0;
/// It is no higher than this, and the margins.
const HIGHEST: f64 = 360.0;

/// Draws a scene. The title is for whom hears it; it may hold anything.
pub fn svg(scene: &Scene, title: &str) -> String {
    let canvas = Canvas::of(scene);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {0}\" width=\"{WIDTH}\" height=\"{0}\" font-family=\"sans-serif\" \
         font-size=\"13\" font-weight=\"600\">\n<title>{1}</title>\n<rect width=\"100%\" height=\"100%\" rx=\"8\" fill=\"#fff\"/>\n",
        decimal(canvas.height, 0),
        escaped(title)
    );
    scene.walls.iter().for_each(|wall| canvas.wall(wall, &mut text));
    scene.lines.iter().for_each(|line| canvas.line(line, &mut text));
    scene.touches.iter().enumerate().for_each(|(k, touch)| canvas.touch(k, touch, scene.radius, &mut text));
    text.push_str("</svg>\n");
    text
}

fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Where the scene lies in the picture.
struct Canvas {
    low: Spot,
    scale: f64,
    left: f64,
    height: f64,
}

impl Canvas {
    fn of(scene: &Scene) -> Self {
        let [low, high] = scene.bounds();
        let scale = ((WIDTH - 2.0 * MARGIN) / (high[0] - low[0])).min(HIGHEST / (high[1] - low[1]));
        let height = (high[1] - low[1]) * scale + 2.0 * MARGIN;
        Canvas { low, scale, left: (WIDTH - (high[0] - low[0]) * scale) / 2.0, height }
    }

    /// `x,y` in the picture, whose second axis points down.
    fn at(&self, spot: Spot) -> String {
        let x = self.left + (spot[0] - self.low[0]) * self.scale;
        let y = self.height - MARGIN - (spot[1] - self.low[1]) * self.scale;
        format!("{},{}", decimal(x, 1), decimal(y, 1))
    }

    fn wall(&self, wall: &WallShape, text: &mut String) {
        let corners: Vec<String> = wall.corners.map(|corner| self.at(corner)).to_vec();
        let stroke = if wall.strip { "none" } else { "#8a94a3" };
        let points = corners.join(" ");
        // A surface that is seen is solid; one that is looked at from behind is a veil: so a hole is not a boss.
        let fill = if wall.faces { "#d9dde2" } else { "#334\" fill-opacity=\".05" };
        let _ = writeln!(text, "<polygon points=\"{points}\" fill=\"{fill}\" stroke=\"{stroke}\"/>");
        for edge in corners.chunks(2).filter(|_| wall.strip) {
            let _ = writeln!(text, "<polyline points=\"{}\" stroke=\"#8a94a3\"/>", edge.join(" "));
        }
    }

    fn line(&self, line: &Line, text: &mut String) {
        let (colour, width) = match line.stroke {
            Stroke::Position => ("#15803d", 2.5),
            Stroke::Link => ("#6b7280", 1.8),
            Stroke::Touch => ("#cf2a20", 2.0),
            Stroke::Overtravel => ("#cf2a20", 0.7),
        };
        let (from, to) = (self.at(line.from), self.at(line.to));
        if from != to {
            let _ = writeln!(
                text,
                "<polyline points=\"{from} {to}\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"round\"/>"
            );
        }
    }

    /// The ball at its contact, the contact, and the number of the touch beside it.
    fn touch(&self, k: usize, touch: &TouchShape, radius: f64, text: &mut String) {
        let ball = self.at(touch.ball).replacen(',', "\" cy=\"", 1);
        let contact = self.at(touch.contact).replacen(',', "\" cy=\"", 1);
        let off = 14.0 / self.scale;
        let name = self.at([touch.contact[0] - touch.inward[0] * off, touch.contact[1] - touch.inward[1] * off]);
        let name = name.replacen(',', "\" y=\"", 1);
        let radius = decimal(radius * self.scale, 1);
        let _ = writeln!(text, "<circle cx=\"{ball}\" r=\"{radius}\" fill=\"none\" stroke=\"#2563eb\"/>");
        let _ = writeln!(text, "<circle cx=\"{contact}\" r=\"3\" fill=\"#cf2a20\"/>");
        let _ = writeln!(text, "<text x=\"{name}\" dy=\"4\" text-anchor=\"middle\">{}</text>", k + 1);
    }
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn a_title_stays_a_title() {
        assert_eq!(escaped("a</title><script>&\n"), "a&lt;/title&gt;&lt;script&gt;&amp; ");
    }
}
