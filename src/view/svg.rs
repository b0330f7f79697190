//! A scene as an SVG: for the manual, for what prints, and to keep.

use std::fmt::Write;

use crate::geom::Vec2;
use crate::num::decimal;
use crate::view::camera::{Camera, DIMENSION_MARGIN};
use crate::view::layout::{Arc, Layout, Placed};
use crate::view::material;
use crate::view::material::WallShape;
use crate::view::numbers::Number;
use crate::view::plate::Plate;
use crate::view::scene::tops::{Face, Top, together};
use crate::view::scene::{Line, Scene, Stroke, TouchShape};

/// Width of the picture, and how much of it stays free at its edges, in its own units.
const WIDTH: f64 = 480.0;
const MARGIN: f64 = 28.0;
/// It is no higher than this, and the margins.
const HIGHEST: f64 = 360.0;
/// Around lines and dimensions that reach further than the scene.
const ROOM: f64 = 14.0;
/// How deep material is seen behind an edge.
const BAND: f64 = 22.0;

/// What is said in the picture of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Legend<'a> {
    /// What the picture is, for screen readers; it may hold anything.
    pub title: &'a str,
    /// What a dimension is called, by its field's path; one without a name is not drawn.
    pub names: &'a [(&'static str, String)],
    /// Whether the virtual part is drawn beside the nominal one.
    pub deviates: bool,
}

/// Draws a scene. Once in the module, however many callers it has.
#[inline(never)]
pub fn svg(scene: &Scene, legend: &Legend<'_>) -> String {
    let drawing = Drawing::of(scene, legend);
    // A number that the library writes by itself would bring all of its printing into the module.
    let layout = drawing.layout(scene, legend);
    let [low, high] = drawing.extent(scene, &layout);
    let [x, y] = low.to_array().map(|pixels| decimal(pixels, 0));
    let [width, height] = (high - low).to_array().map(|pixels| decimal(pixels, 0));
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{x} {y} {width} {height}\" width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" \
         font-size=\"13\" font-weight=\"600\">\n<title>{}</title>\n<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" rx=\"8\" fill=\"#fff\"/>\n",
        escaped(legend.title)
    );
    drawing.material(scene, &mut text);
    let solid = scene.material.is_empty();
    for faces in scene.faces(legend.deviates).chunk_by(together) {
        match faces[0] {
            Face::Wall(wall) => drawing.wall(wall, faces, solid, &mut text),
            Face::Top(top) => drawing.top(top, &mut text),
            Face::Behind(of) => drawing.path(scene, legend.deviates, Some(of), &mut text),
        }
    }
    let name = |own: &str| legend.names.iter().find(|(field, _)| *field == own).map_or("", |(_, name)| name.as_str());
    layout.arcs.iter().for_each(|arc| Drawing::angle(arc, &mut text));
    drawing.path(scene, legend.deviates, None, &mut text);
    layout.numbers.iter().for_each(|number| Drawing::number(number, &mut text));
    layout.dimensions.iter().for_each(|placed| Drawing::dimension(placed, &mut text));
    // What they say is above them all.
    let arcs = layout.arcs.iter().filter_map(|arc| Some((arc.angle.field, arc.name?)));
    let dimensions = layout.dimensions.iter().map(|placed| (placed.drawn.field, placed.name));
    arcs.chain(dimensions).for_each(|(field, plate)| said(&plate, name(field), &mut text));
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
            // What XML 1.0 has no place for.
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Where the scene lies in the picture.
struct Drawing {
    camera: Camera,
}

impl Drawing {
    fn of(scene: &Scene, legend: &Legend<'_>) -> Self {
        let [low, high] = scene.bounds();
        let margin = if legend.names.is_empty() { MARGIN } else { DIMENSION_MARGIN };
        let room = WIDTH - 2.0 * margin;
        let scale = (Vec2::new(room, HIGHEST) / (high - low)).min_element();
        let size = Vec2::new(WIDTH, (high - low).y * scale + 2.0 * margin);
        Drawing { camera: Camera { scale, middle: (low + high) / 2.0, size } }
    }

    /// What is named, and where it stands.
    fn layout<'a>(&self, scene: &'a Scene, legend: &Legend<'_>) -> Layout<'a> {
        let mut layout = self.camera.layout(scene, None);
        let named = |own: &str| legend.names.iter().any(|(field, _)| *field == own);
        layout.arcs.retain(|arc| named(arc.angle.field));
        layout.dimensions.retain(|placed| named(placed.drawn.field));
        layout
    }

    /// From where to where the picture reaches: whatever is drawn lies within, with some room around.
    fn extent(&self, scene: &Scene, layout: &Layout<'_>) -> [Vec2; 2] {
        let lines = scene.lines.iter().flat_map(|line| [line.from, line.to]).map(|spot| self.camera.pixel(spot));
        let dimensions =
            layout.dimensions.iter().flat_map(|placed| placed.line.map(Vec2::from).into_iter().chain(placed.name.bounds()));
        let mut extent = [Vec2::ZERO, self.camera.size];
        let angles = layout.arcs.iter().flat_map(|arc| arc.sides.into_iter().chain(arc.name.iter().flat_map(Plate::bounds)));
        for at in lines.chain(dimensions).chain(angles) {
            extent = [extent[0].min((at - ROOM).floor()), extent[1].max((at + ROOM).ceil())];
        }
        extent
    }

    /// `x,y` in the picture.
    fn at(&self, spot: Vec2) -> String {
        pair(self.camera.pixel(spot))
    }

    /// The material behind edges, filled and hatched as in a section, and the air of holes.
    fn material(&self, scene: &Scene, text: &mut String) {
        let [filled, air] = material::outlines(&scene.material, &self.camera, BAND).map(|outlines| {
            let mut path = String::new();
            for outline in outlines {
                for (k, at) in outline.iter().enumerate() {
                    path.push(if k == 0 { 'M' } else { 'L' });
                    path.push_str(&pair(*at));
                }
                path.push('Z');
            }
            path
        });
        if filled.is_empty() {
            return;
        }
        text.push_str(
            "<pattern id=\"touchpath-hatch\" width=\"9\" height=\"9\" patternUnits=\"userSpaceOnUse\"><path d=\"M0,9L9,0\" stroke=\"#8a94a3\" stroke-width=\".75\"/></pattern>\n",
        );
        for paint in ["#eef0f2", "url(#touchpath-hatch)"] {
            let _ = writeln!(text, "<path d=\"{filled}\" fill=\"{paint}\"/>");
        }
        if !air.is_empty() {
            let _ = writeln!(text, "<path d=\"{air}\" fill=\"#fff\"/>");
        }
    }

    /// The moves and the touches behind something, or those behind nothing.
    fn path(&self, scene: &Scene, deviates: bool, behind: Option<usize>, text: &mut String) {
        scene.lines.iter().filter(|line| line.behind == behind).for_each(|line| self.line(line, text));
        for touch in &scene.touches {
            // What is hidden is seen faintly through what hides it.
            let hidden = behind.is_none() && touch.behind.is_some();
            text.push_str(if hidden { "<g opacity=\".35\">\n" } else { "" });
            if hidden || touch.behind == behind {
                self.touch(touch, scene.radius, deviates, text);
            }
            text.push_str(if hidden { "</g>\n" } else { "" });
        }
    }

    /// A wall, or the strips of a round one in one, its faces `solid`: else they let a section's hatching through.
    fn wall(&self, wall: &WallShape, strips: &[Face<'_>], solid: bool, text: &mut String) {
        let colour = if wall.actual { "#b45309" } else { "#8a94a3" };
        let all = || strips.iter().filter_map(|face| if let Face::Wall(wall) = face { Some(*wall) } else { None });
        let mut line = String::new();
        for ends in all().filter_map(|wall| wall.edge) {
            let [a, b] = ends.map(|spot| self.at(spot));
            // From strip to strip it continues.
            if !line.ends_with(&format!("L{a}")) {
                let _ = write!(line, "M{a}");
            }
            let _ = write!(line, "L{b}");
        }
        if !line.is_empty() {
            let width = if wall.actual { "1.5\" stroke-dasharray=\"7 4" } else { "2" };
            let _ = writeln!(text, "<path d=\"{line}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"/>");
        }
        let (mut outlines, mut edges) = (String::new(), String::new());
        for wall in all().filter(|wall| wall.edge.is_none()) {
            let [a, b, c, d] = wall.corners.map(|corner| self.at(corner));
            let _ = write!(outlines, "M{a}L{b}L{c}L{d}Z");
            let _ = write!(edges, "M{a}L{b}M{c}L{d}");
        }
        if outlines.is_empty() {
            return;
        }
        let stroke = if wall.strip { "none" } else { colour };
        // A surface that is seen is solid; one that is looked at from behind is a veil: so a hole is not a boss.
        let fill = match (wall.faces && solid, wall.actual) {
            (true, false) => "#d9dde2",
            (true, true) => "#b45309\" fill-opacity=\".2",
            (false, _) => "#334\" fill-opacity=\".05",
        };
        let _ = writeln!(text, "<path d=\"{outlines}\" fill=\"{fill}\" stroke=\"{stroke}\"/>");
        if wall.strip {
            let _ = writeln!(text, "<path d=\"{edges}\" stroke=\"{colour}\"/>");
        }
    }

    fn top(&self, top: &Top, text: &mut String) {
        let points: Vec<String> = top.corners.iter().map(|corner| self.at(*corner)).collect();
        let _ = writeln!(text, "<polygon points=\"{}\" fill=\"#eef0f3\" stroke=\"#8a94a3\"/>", points.join(" "));
    }

    fn line(&self, line: &Line, text: &mut String) {
        let (colour, width, dash) = match line.stroke {
            _ if line.rapid => ("#15803d", "1.5", "12 5"),
            Stroke::Position => ("#15803d", "2", "9 4 2 4"),
            Stroke::Link => ("#6b7280", "1.6", "6 4"),
            Stroke::Touch => ("#cf2a20", "2", ""),
            Stroke::Overtravel => ("#cf2a20", ".9", "1.5 3.5"),
        };
        let (from, to) = super::forwards(line.from, line.to);
        let (from, to) = (self.at(from), self.at(to));
        if from == to {
            return;
        }
        let dash = if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") };
        let _ = writeln!(
            text,
            "<polyline points=\"{from} {to}\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"round\"{dash}/>"
        );
    }

    /// The ball at its contact, and the contact.
    fn touch(&self, touch: &TouchShape, radius: f64, deviates: bool, text: &mut String) {
        let circle = |at: Vec2, radius: f64, paint: &str, text: &mut String| {
            let [x, y] = numbers(self.camera.pixel(at));
            let _ = writeln!(text, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{}\" {paint}/>", decimal(radius, 1));
        };
        let radius = radius * self.camera.scale;
        circle(touch.ball, radius, "fill=\"none\" stroke=\"#2563eb\"", text);
        if let Some(trigger) = touch.trigger.filter(|_| deviates) {
            circle(trigger, radius, "fill=\"none\" stroke=\"#b45309\"", text);
        }
        circle(touch.contact, 3.0, "fill=\"#cf2a20\"", text);
    }

    /// The number of a touch, or of several.
    fn number(number: &Number, text: &mut String) {
        let middle = number.plate.middle;
        if number.led {
            // Up to the text.
            let end = number.contact.lerp_monotonic(middle, 1.0 - number.radius() / number.contact.distance(middle));
            let _ = writeln!(text, "<path d=\"M{}L{}\" stroke=\"#cf2a20\"/>", pair(number.contact), pair(end));
        }
        let [x, y] = numbers(middle);
        let _ = writeln!(text, "<text x=\"{x}\" y=\"{y}\" dy=\"4\" text-anchor=\"middle\">{}</text>", number.said);
    }

    /// A dimension: extension lines, and its line with arrow heads.
    fn dimension(placed: &Placed<'_>, text: &mut String) {
        let ([from, to], [start, end]) = (placed.ends, placed.line.map(Vec2::from));
        let mut lines = String::new();
        for [a, b] in [[from, start], [to, end], placed.reach] {
            let _ = write!(lines, "M{}L{}", pair(a), pair(b));
        }
        let _ = writeln!(text, "<path d=\"{lines}\" stroke=\"#2563eb\" fill=\"none\"/>");
        placed.heads().into_iter().for_each(|(tip, way)| head(tip, way, text));
    }

    /// An angle: its sides, and its arc with arrow heads.
    fn angle(arc: &Arc<'_>, text: &mut String) {
        let mut lines = String::new();
        for side in arc.sides {
            let _ = write!(lines, "M{}L{}", pair(arc.at), pair(side));
        }
        let [from, to] = arc.ends.map(pair);
        let (radius, sweep) = (decimal(arc.radius, 1), u8::from(arc.angle.turns[1] <= 0.0));
        let _ = write!(lines, "M{from}A{radius} {radius} 0 0 {sweep} {to}");
        let _ = writeln!(text, "<path d=\"{lines}\" stroke=\"#2563eb\" fill=\"none\"/>");
        arc.heads.into_iter().flatten().for_each(|(tip, direction)| head(tip, direction, text));
    }
}

/// An arrow head with its tip at a place.
fn head(tip: Vec2, way: Vec2, text: &mut String) {
    let sides = [-3.4, 3.4].map(|half| pair(tip - way * 8.0 + way.perp() * half));
    let _ = writeln!(text, "<path d=\"M{}L{}L{}Z\" fill=\"#2563eb\"/>", pair(tip), sides[0], sides[1]);
}

/// What a dimension or an angle says.
fn said(plate: &Plate, name: &str, text: &mut String) {
    let [x, y] = numbers(plate.middle);
    let (label, value) = super::halves(name);
    let turn = decimal(plate.along.to_angle().to_degrees(), 2);
    let turned = if turn == "0" { String::new() } else { format!(" transform=\"rotate({turn} {x} {y})\"") };
    let _ = writeln!(
        text,
        "<text x=\"{x}\" y=\"{y}\" dy=\"4\" text-anchor=\"middle\" font-size=\"12\" stroke=\"#fff\" stroke-width=\"5\" paint-order=\"stroke\"{turned}><tspan font-weight=\"400\" fill=\"#46535f\">{} </tspan><tspan dx=\"3\">{}</tspan></text>",
        escaped(label),
        escaped(value)
    );
}

fn pair(at: Vec2) -> String {
    numbers(at).join(",")
}

fn numbers(at: Vec2) -> [String; 2] {
    at.to_array().map(|pixels| decimal(pixels, 1))
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn a_title_stays_a_title() {
        assert_eq!(escaped("a</title><script>&\n"), "a&lt;/title&gt;&lt;script&gt;&amp; ");
    }
}
