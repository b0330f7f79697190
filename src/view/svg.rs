//! Draws a scene as an SVG: for the manual, for printing, and to keep.

use std::fmt::Write;

use crate::geom::Vec2;
use crate::num::decimal;
use crate::view::camera::{Camera, DIMENSION_MARGIN};
use crate::view::display::{Item, Walls};
use crate::view::label_box::LabelBox;
use crate::view::layout::{AngleArc, Layout, PlacedDimension};
use crate::view::material;
use crate::view::numbers::Number;
use crate::view::scene::blocks::{Block, Face};
use crate::view::scene::{Line, Scene, TouchShape};
use crate::view::style::{self, CENTRE_LINES, Colour, EDGES, Pen};

/// Width of the picture, and margin, in its own units.
const WIDTH: f64 = 480.0;
const MARGIN: f64 = 28.0;
/// Largest height without the margins.
const HIGHEST: f64 = 360.0;
/// Margin around lines and dimensions that extend beyond the scene.
const ROOM: f64 = 14.0;
/// Solid colours on paper: walls that face the viewer, walls from behind, top sides, cut material, and names of dimensions.
const FACE: &str = "#d9dde2";
const VEIL: &str = "#334\" fill-opacity=\".05";
const TOP: &str = "#eef0f3";
const CUT: &str = "#eef0f2";
/// Depth of the material shown behind an edge.
const BAND: f64 = 22.0;

/// Texts in the picture of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Legend<'a> {
    /// Title for screen readers; it may contain anything.
    pub title: &'a str,
    /// Names of the dimensions, by the paths of their fields; one without a name is not drawn.
    pub names: &'a [(&'static str, String)],
    /// Whether the virtual part is drawn beside the nominal one.
    pub deviates: bool,
}

/// Draws a scene. Only once in the module, however many callers it has.
#[inline(never)]
pub fn svg(scene: &Scene, legend: &Legend<'_>) -> String {
    let mut drawing = Drawing::of(scene, legend);
    let layout = drawing.layout(scene, legend);
    drawing.begin(scene, legend, &layout);
    drawing.material(scene);
    drawing.blocks(scene);
    let solid = scene.material.is_empty();
    for item in scene.display(&drawing.camera, legend.deviates) {
        match item {
            Item::Walls(walls) => drawing.walls(&walls, solid),
            Item::Top(corners) => drawing.top(&corners),
            Item::Behind(of) => drawing.path(scene, legend.deviates, Some(of)),
        }
    }
    layout.arcs.iter().for_each(|arc| drawing.angle(arc));
    drawing.path(scene, legend.deviates, None);
    drawing.relations(scene);
    layout
        .numbers
        .iter()
        .for_each(|number| drawing.number(number));
    layout
        .dimensions
        .iter()
        .for_each(|placed| drawing.dimension(placed));
    // Texts are above everything.
    layout
        .names(legend.names)
        .iter()
        .for_each(|(_, name, plate)| drawing.label(plate, name));
    drawing.text.push_str("</svg>\n");
    drawing.text
}

fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            // Characters that XML 1.0 does not allow.
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Position of the scene in the picture, and the text written so far.
struct Drawing {
    camera: Camera,
    text: String,
}

impl Drawing {
    fn of(scene: &Scene, legend: &Legend<'_>) -> Self {
        let [low, high] = scene.bounds();
        let margin = if legend.names.is_empty() {
            MARGIN
        } else {
            DIMENSION_MARGIN
        };
        let room = WIDTH - 2.0 * margin;
        let scale = (Vec2::new(room, HIGHEST) / (high - low)).min_element();
        let size = Vec2::new(WIDTH, (high - low).y * scale + 2.0 * margin);
        Drawing {
            camera: Camera {
                scale,
                middle: (low + high) / 2.0,
                size,
            },
            text: String::new(),
        }
    }

    /// Layout of the dimensions and angles that have a name.
    fn layout<'a>(&self, scene: &'a Scene, legend: &Legend<'_>) -> Layout<'a> {
        let mut layout = self.camera.layout(scene, None);
        let named = |own: &str| legend.names.iter().any(|(field, _)| *field == own);
        layout.arcs.retain(|arc| named(arc.angle.field));
        layout.dimensions.retain(|placed| named(placed.drawn.field));
        layout
    }

    /// The frame: everything drawn is inside, with a margin.
    fn begin(&mut self, scene: &Scene, legend: &Legend<'_>, layout: &Layout<'_>) {
        let lines = scene
            .lines
            .iter()
            .flat_map(|line| [line.from, line.to])
            .map(|spot| self.camera.pixel(spot));
        let dimensions = layout
            .dimensions
            .iter()
            .flat_map(|placed| placed.line.into_iter().chain(placed.name.bounds()));
        let angles = layout.arcs.iter().flat_map(|arc| {
            arc.sides
                .into_iter()
                .chain(arc.name.iter().flat_map(LabelBox::bounds))
        });
        let (mut low, mut high) = (Vec2::ZERO, self.camera.size);
        for at in lines.chain(dimensions).chain(angles) {
            (low, high) = (low.min((at - ROOM).floor()), high.max((at + ROOM).ceil()));
        }
        // Formatting a number with the library would add its printing code to the module.
        let [x, y] = low.to_array().map(|pixels| decimal(pixels, 0));
        let [width, height] = (high - low).to_array().map(|pixels| decimal(pixels, 0));
        let _ = write!(
            self.text,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{x} {y} {width} {height}\" width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" \
             font-size=\"13\" font-weight=\"600\">\n<title>{}</title>\n<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" rx=\"8\" fill=\"#fff\"/>\n",
            escaped(legend.title)
        );
    }

    /// A path with its attributes.
    fn draw(&mut self, path: &str, attributes: &str) {
        let _ = writeln!(self.text, "<path d=\"{path}\" {attributes}/>");
    }

    /// Material behind edges, filled and hatched as in a section, and the air of holes.
    fn material(&mut self, scene: &Scene) {
        let [filled, air] = material::outlines(&scene.material, &self.camera, BAND)
            .map(|outlines| path(&outlines, "Z"));
        if filled.is_empty() {
            return;
        }
        self.hatch();
        self.draw(&filled, &format!("fill=\"{CUT}\""));
        self.draw(&filled, "fill=\"url(#touchpath-hatch)\"");
        if !air.is_empty() {
            self.draw(&air, "fill=\"#fff\"");
        }
    }

    /// In the isometric view the material around inner features, cut open.
    fn blocks(&mut self, scene: &Scene) {
        if scene.blocks.is_empty() {
            return;
        }
        self.hatch();
        let colour = Colour::Wall.on_paper();
        for Block { face, corners } in &scene.blocks {
            let outline: Vec<Vec2> = corners
                .iter()
                .map(|corner| self.camera.pixel(*corner))
                .collect();
            let outline = path(&[outline], "Z");
            let stroke = format!("stroke=\"{colour}\"");
            match face {
                Face::Top => self.draw(&outline, &format!("fill=\"{TOP}\" {stroke}")),
                Face::Cut => {
                    self.draw(&outline, &format!("fill=\"{FACE}\" {stroke}"));
                    self.draw(&outline, "fill=\"url(#touchpath-hatch)\"");
                }
                Face::Away => self.draw(
                    &outline,
                    &format!("fill=\"{VEIL}\" {stroke} stroke-opacity=\".35\""),
                ),
            }
        }
    }

    /// Fill of cut material.
    fn hatch(&mut self) {
        let colour = Colour::Wall.on_paper();
        let _ = writeln!(
            self.text,
            "<pattern id=\"touchpath-hatch\" width=\"9\" height=\"9\" patternUnits=\"userSpaceOnUse\"><path d=\"M0,9L9,0\" stroke=\"{colour}\" stroke-width=\".75\"/></pattern>"
        );
    }

    /// Moves and touches behind an item, or those in front of all items.
    fn path(&mut self, scene: &Scene, deviates: bool, behind: Option<usize>) {
        scene
            .lines
            .iter()
            .filter(|line| line.occluder == behind)
            .for_each(|line| self.line(line));
        for touch in &scene.touches {
            // Hidden parts are faintly visible.
            let hidden = behind.is_none() && touch.behind.is_some();
            self.text
                .push_str(if hidden { "<g opacity=\".35\">\n" } else { "" });
            if hidden || touch.behind == behind {
                self.touch(touch, scene.radius, deviates);
            }
            self.text.push_str(if hidden { "</g>\n" } else { "" });
        }
    }

    /// Lines of the relations.
    fn relations(&mut self, scene: &Scene) {
        if scene.related.is_empty() {
            return;
        }
        let lines: Vec<Vec<Vec2>> = scene
            .related
            .iter()
            .map(|line| line.map(|spot| self.camera.pixel(spot)).to_vec())
            .collect();
        let [stroke, dash] = attributes(&CENTRE_LINES[0]);
        self.draw(&path(&lines, ""), &format!("fill=\"none\" {stroke}{dash}"));
    }

    /// Walls in one path. Solid faces hide what is behind them; otherwise a section's hatching shows through.
    fn walls(
        &mut self,
        Walls {
            wall,
            lines,
            outlines,
        }: &Walls<'_>,
        solid: bool,
    ) {
        if !lines.is_empty() {
            let [stroke, dash] = attributes(&EDGES[usize::from(wall.actual)]);
            self.draw(&path(lines, ""), &format!("fill=\"none\" {stroke}{dash}"));
        }
        if outlines.is_empty() {
            return;
        }
        let colour = if wall.actual {
            Colour::Actual
        } else {
            Colour::Wall
        }
        .on_paper();
        let stroke = if wall.strip { "none" } else { colour };
        // A visible surface is solid; one seen from behind is a veil: so a hole does not look like a boss.
        let fill = match (wall.faces && solid, wall.actual) {
            (true, false) => FACE,
            (true, true) => &format!("{colour}\" fill-opacity=\".2"),
            (false, _) => VEIL,
        };
        self.draw(
            &path(outlines, "Z"),
            &format!("fill=\"{fill}\" stroke=\"{stroke}\""),
        );
        if wall.strip {
            let edges: Vec<&[Vec2]> = outlines.as_flattened().chunks(2).collect();
            self.draw(&path(&edges, ""), &format!("stroke=\"{colour}\""));
        }
    }

    fn top(&mut self, corners: &[Vec2]) {
        let (points, colour) = (
            corners
                .iter()
                .map(|corner| pair(*corner))
                .collect::<Vec<_>>()
                .join(" "),
            Colour::Wall.on_paper(),
        );
        let _ = writeln!(
            self.text,
            "<polygon points=\"{points}\" fill=\"{TOP}\" stroke=\"{colour}\"/>"
        );
    }

    fn line(&mut self, line: &Line) {
        let (from, to) = super::forwards(line.from, line.to);
        let [from, to] = [from, to].map(|spot| pair(self.camera.pixel(spot)));
        if from != to {
            let [stroke, dash] = attributes(style::of(line.stroke, line.rapid));
            let _ = writeln!(
                self.text,
                "<polyline points=\"{from} {to}\" {stroke} stroke-linecap=\"round\"{dash}/>"
            );
        }
    }

    /// The ball at its contact, and the contact.
    fn touch(&mut self, touch: &TouchShape, radius: f64, deviates: bool) {
        let mut circle = |at: Vec2, radius: f64, kind: &str, colour: Colour| {
            let [x, y] = numbers(self.camera.pixel(at));
            let (radius, colour) = (decimal(radius, 1), colour.on_paper());
            let _ = writeln!(
                self.text,
                "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" {kind}=\"{colour}\"/>"
            );
        };
        let radius = radius * self.camera.scale;
        circle(touch.ball, radius, "fill=\"none\" stroke", Colour::Ball);
        if let Some(trigger) = touch.trigger.filter(|_| deviates) {
            circle(trigger, radius, "fill=\"none\" stroke", Colour::Actual);
        }
        circle(touch.contact, 3.0, "fill", Colour::Touch);
    }

    /// The number of a touch, or of several.
    fn number(&mut self, number: &Number) {
        let middle = number.plate.middle;
        if number.has_leader {
            // Up to the text.
            let end = number.contact.lerp_monotonic(
                middle,
                1.0 - number.radius() / number.contact.distance(middle),
            );
            self.draw(
                &path(&[[number.contact, end]], ""),
                &format!("stroke=\"{}\"", Colour::Touch.on_paper()),
            );
        }
        let [x, y] = numbers(middle);
        let _ = writeln!(
            self.text,
            "<text x=\"{x}\" y=\"{y}\" dy=\"4\" text-anchor=\"middle\">{}</text>",
            number.label
        );
    }

    /// Lines of a dimension or an angle, and its arrow heads.
    fn measure(&mut self, lines: &str, heads: Option<[(Vec2, Vec2); 2]>) {
        let colour = Colour::Ball.on_paper();
        self.draw(lines, &format!("stroke=\"{colour}\" fill=\"none\""));
        for (tip, way) in heads.into_iter().flatten() {
            let sides = [-3.4, 3.4].map(|half| tip - way * 8.0 + way.perp() * half);
            self.draw(
                &path(&[[tip, sides[0], sides[1]]], "Z"),
                &format!("fill=\"{colour}\""),
            );
        }
    }

    /// A dimension: extension lines, and its line with arrow heads.
    fn dimension(&mut self, placed: &PlacedDimension<'_>) {
        let ([from, to], [start, end]) = (placed.ends, placed.line);
        self.measure(
            &path(&[[from, start], [to, end], placed.reach], ""),
            Some(placed.heads()),
        );
    }

    /// An angle: its sides, and its arc with arrow heads.
    fn angle(&mut self, arc: &AngleArc<'_>) {
        let [from, to] = arc.ends.map(pair);
        let (radius, sweep) = (decimal(arc.radius, 1), u8::from(arc.angle.turns[1] <= 0.0));
        let sides = path(&arc.sides.map(|side| [arc.at, side]), "");
        self.measure(
            &format!("{sides}M{from}A{radius} {radius} 0 0 {sweep} {to}"),
            arc.heads,
        );
    }

    /// Text of a dimension or an angle.
    fn label(&mut self, plate: &LabelBox, name: &str) {
        let [x, y] = numbers(plate.middle);
        let [label, value] = <[&str; 2]>::from(super::halves(name)).map(escaped);
        let turn = decimal(plate.along.to_angle().to_degrees(), 2);
        let turned = if turn == "0" {
            String::new()
        } else {
            format!(" transform=\"rotate({turn} {x} {y})\"")
        };
        let colour = Colour::Text.on_paper();
        let _ = writeln!(
            self.text,
            "<text x=\"{x}\" y=\"{y}\" dy=\"4\" text-anchor=\"middle\" font-size=\"12\" stroke=\"#fff\" stroke-width=\"5\" paint-order=\"stroke\"{turned}><tspan font-weight=\"400\" fill=\"{colour}\">{label} </tspan><tspan dx=\"3\">{value}</tspan></text>"
        );
    }
}

/// A pen as attributes: colour, width, and dashes if there are any.
fn attributes(pen: &Pen) -> [String; 2] {
    let width = decimal(pen.widths[1], 1);
    let stroke = format!(
        "stroke=\"{}\" stroke-width=\"{}\"",
        pen.colour.on_paper(),
        width.trim_start_matches('0')
    );
    let dash: Vec<String> = pen.dash.iter().map(|length| decimal(*length, 1)).collect();
    let dash = if dash.is_empty() {
        String::new()
    } else {
        format!(" stroke-dasharray=\"{}\"", dash.join(" "))
    };
    [stroke, dash]
}

/// Lines as one path, each with this ending.
fn path(lines: &[impl AsRef<[Vec2]>], end: &str) -> String {
    let mut path = String::new();
    lines
        .iter()
        .for_each(|line| points(line.as_ref(), end, &mut path));
    path
}

fn points(line: &[Vec2], end: &str, path: &mut String) {
    for (k, at) in line.iter().enumerate() {
        path.push(if k == 0 { 'M' } else { 'L' });
        path.push_str(&pair(*at));
    }
    path.push_str(end);
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
        assert_eq!(
            escaped("a</title><script>&\n"),
            "a&lt;/title&gt;&lt;script&gt;&amp; "
        );
    }
}
