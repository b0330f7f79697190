//! Draws a scene on a browser's canvas: the only module that names `web_sys`.

mod around;
mod long;
mod strokes;
mod theme;

use std::cell::Cell;
use std::f64::consts::{FRAC_PI_2, PI};

use strokes::Name;
pub use theme::Theme;
use web_sys::{CanvasRenderingContext2d, HtmlCanvasElement};

use crate::geom::Vec2;
use crate::view::camera::{AXES_CORNER, Camera, DOWNWARDS};
use crate::view::layout::Layout;
use crate::view::lengths::Arrow;
use crate::view::material;
use crate::view::material::WallShape;
use crate::view::numbers::Number;
use crate::view::plate::Plate;
use crate::view::scene::tops::{Face, Top, together};
use crate::view::scene::{Line, Scene, Stroke};

/// What is pointed at and said beside the scene itself.
#[derive(Clone, Copy, Debug)]
pub struct Marks<'a> {
    /// The move that is lit.
    pub highlight: Option<usize>,
    /// How much of that move is done, 0 to 1.
    pub part: f64,
    /// Whether the virtual part lies other than the nominal one.
    pub deviates: bool,
    /// The path of the field that has the focus.
    pub field: Option<&'a str>,
    /// What a dimension is called, by its field's path.
    pub names: &'a [(&'static str, String)],
    /// The name of the work offset.
    pub origin: &'a str,
    /// Where a machine measured the ball's centre.
    pub measured: &'a [Vec2],
    /// Whether the scale has a decimal comma.
    pub comma: bool,
}

/// The fonts of a picture: of what dimensions are called, of numbers in a small picture, and of everything else.
const LABEL: &str = "12px system-ui, sans-serif";
const SMALL: &str = "600 10px system-ui, sans-serif";
const BOLD: &str = "600 12px system-ui, sans-serif";

/// Pixels between the strokes of a hatching.
const HATCH: f64 = 9.0;

/// How deep material is seen behind an edge, pixels; the same in a small picture.
const BAND: f64 = 36.0;
const SMALL_BAND: f64 = 8.0;

/// How far behind a contact the disc of its number reaches, pixels.
const NUMBER: f64 = 25.0;

/// Half the size in pixels of the dot of a touch that is looked at along its way.
const DOT: f64 = 3.5;

/// Half the size of a handle in pixels.
const HANDLE: f64 = 6.0;

/// Pixels from the corner of the axes to their names, and how far around it a click is theirs.
const AXIS_NAME: f64 = 28.0;
const AXES: f64 = 36.0;

/// Where the work axes are drawn.
fn axes_corner(camera: &Camera) -> Vec2 {
    Vec2::new(AXES_CORNER, camera.size.y - AXES_CORNER)
}

/// The view that a click on the axes asks for: along the axis whose name is there, or isometric beside them.
pub fn axis_at(scene: &Scene, camera: &Camera, at: Vec2) -> Option<&'static str> {
    let corner = axes_corner(camera);
    if corner.distance(at) > AXES {
        return None;
    }
    let near = |direction: Vec2| {
        let tip = corner + direction * DOWNWARDS * AXIS_NAME;
        direction.length() > 0.1 && tip.distance(at) <= 14.0
    };
    // Along the abscissa one sees the side, along the ordinate the front, along the tool axis the top.
    let found = scene.axes.iter().zip(["side", "front", "top"]).find(|((_, direction), _)| near(*direction));
    Some(found.map_or("isometric", |(_, view)| view))
}

/// Where the handle that turns the part stands: so many pixels from the one that shifts it.
pub fn turning(shifting: Vec2, direction: Vec2) -> Vec2 {
    shifting + direction * DOWNWARDS * 64.0
}

/// Where the handles of the first touch's angle and of the spread's end stand: outside the circle and the numbers of its touches, one further out
/// than the other, so that a whole turn shows both.
pub fn spread_handles(scene: &Scene, camera: &Camera) -> Option<[Vec2; 2]> {
    let (center, radius, start, sweep) = scene.spread?;
    let center = camera.pixel(center);
    let at = |angle: f64, out: f64| center + Vec2::from_angle(angle) * DOWNWARDS * (radius * camera.scale + out);
    let first = NUMBER + HANDLE + 3.0;
    Some([at(start, first), at(start + sweep, first + 2.0 * HANDLE + 3.0)])
}

/// Whether a scene has so many lines that it is drawn in few strokes, and feeds without dashes.
pub fn is_long(scene: &Scene) -> bool {
    scene.lines.len() > long::LONG
}

/// Whether a run comes to a line: not behind a collision.
fn reached(scene: &Scene, line: &Line) -> bool {
    scene.collision.is_none_or(|(index, _)| line.index <= index)
}

/// Whether a line is lit with its move: the search past a contact is no way that the ball goes.
fn lit(line: &Line) -> bool {
    line.stroke != Stroke::Overtravel
}

/// A canvas and what is drawn on it.
#[derive(Debug)]
pub struct Painter {
    canvas: HtmlCanvasElement,
    context: CanvasRenderingContext2d,
    /// The colours.
    pub theme: Theme,
    /// Whether it is a small picture: no axes, no numbers, no handles.
    pub small: bool,
    /// Whether there is nothing to be gripped.
    pub still: bool,
    /// Device pixels in a CSS pixel.
    pub ratio: f64,
    /// The font that is set: each time one is set, the browser works out the page's styles first.
    font: Cell<&'static str>,
}

impl Painter {
    /// A painter on a canvas; none where the canvas has no 2D context.
    pub fn new(canvas: HtmlCanvasElement) -> Option<Self> {
        use wasm_bindgen::JsCast;
        let context = canvas.get_context("2d").ok()??.dyn_into::<CanvasRenderingContext2d>().ok()?;
        Some(Painter { canvas, context, theme: Theme::default(), small: false, still: false, ratio: 1.0, font: Cell::new("") })
    }

    /// The canvas covers so many CSS pixels, each `ratio` device pixels wide.
    pub fn resize(&mut self, size: Vec2, ratio: f64) {
        self.ratio = ratio;
        self.canvas.set_width((size.x * ratio).round() as u32);
        self.canvas.set_height((size.y * ratio).round() as u32);
        // Another size resets all that was set.
        self.font.set("");
    }

    fn font(&self, font: &'static str) {
        if self.font.replace(font) != font {
            self.context.set_font(font);
        }
    }

    /// Begins a picture: fills the canvas with the background, and sets the font; texts stand about their middle.
    fn begin(&self, camera: &Camera, font: &'static str) {
        let c = &self.context;
        let _ = c.set_transform(self.ratio, 0.0, 0.0, self.ratio, 0.0, 0.0);
        c.set_fill_style_str(&self.theme.background);
        c.fill_rect(0.0, 0.0, camera.size.x, camera.size.y);
        self.font(font);
        c.set_text_align("center");
        c.set_text_baseline("middle");
    }

    /// Empties a canvas that lies over that of a picture.
    pub fn clear(&self, camera: &Camera) {
        let _ = self.context.set_transform(self.ratio, 0.0, 0.0, self.ratio, 0.0, 0.0);
        self.context.clear_rect(0.0, 0.0, camera.size.x, camera.size.y);
    }

    /// Draws a move of a picture, lit, on the canvas over it.
    pub fn draw_lit(&self, scene: &Scene, camera: &Camera, index: usize, part: f64) {
        let c = &self.context;
        c.set_line_cap("round");
        c.set_text_align("center");
        c.set_text_baseline("middle");
        for line in scene.lines.iter().filter(|line| line.index == index) {
            self.line(line, camera, lit(line), reached(scene, line));
        }
        self.ball(scene, camera, index, part);
        // The number of a touch that is lit is not beneath it.
        if !self.small
            && let Some(touch) = scene.touches.iter().position(|touch| touch.index == Some(index))
        {
            camera
                .numbers(scene)
                .iter()
                .filter(|number| number.touches.contains(&touch))
                .for_each(|number| self.number(number));
        }
    }

    /// The ball on its way, and the stylus above it.
    fn ball(&self, scene: &Scene, camera: &Camera, index: usize, part: f64) {
        let Some(place) = scene.ball(index, part) else { return };
        for outline in &scene.stylus {
            let c = &self.context;
            c.begin_path();
            self.outline(&outline.map(|corner| camera.pixel(place + corner)));
            c.set_fill_style_str(&self.theme.highlight);
            c.set_stroke_style_str(&self.theme.highlight);
            c.set_global_alpha(0.12);
            c.fill();
            c.set_global_alpha(0.7);
            c.set_line_width(1.0);
            self.dash(&[]);
            c.stroke();
        }
        let (ball, radius) = (camera.pixel(place), (scene.radius * camera.scale).max(3.0));
        self.context.set_global_alpha(0.25);
        self.disc(ball, radius, &self.theme.highlight);
        self.context.set_global_alpha(1.0);
        self.circle(ball, radius, &self.theme.highlight, 2.0);
    }

    /// Draws everything.
    pub fn draw(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>) {
        let c = &self.context;
        self.begin(camera, BOLD);
        c.set_line_cap("round");
        c.set_line_join("round");
        self.part(scene, camera, marks);
        // Beneath the moves, the touches and the dimensions.
        let layout = if self.small { None } else { Some(camera.layout(scene, marks.field)) };
        for arc in layout.iter().flat_map(|layout| &layout.arcs) {
            self.angle(arc, marks.field == Some(arc.angle.field));
        }
        self.moves(scene, camera, marks);
        self.happens(scene, camera, marks);
        let Some(layout) = layout else { return };
        if !self.still {
            let held = marks.deviates || marks.field.is_some_and(|field| field.starts_with("part."));
            self.handles(scene, camera, held);
        }
        self.axes(scene, camera, marks.origin, &layout);
        // Over everything that may lie at their contacts.
        layout.numbers.iter().for_each(|number| self.number(number));
        self.font(BOLD);
        // The touches of a job have their balls.
        if scene.touches.is_empty() {
            self.dots(scene, camera);
        }
        if let Some(unit) = scene.unit {
            self.scale_bar(camera, unit, marks.comma);
        }
        self.sizes(&layout, marks);
    }

    /// The material, the walls and top sides, and what lies behind these.
    fn part(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>) {
        self.material(scene, camera);
        let solid = scene.material.is_empty();
        for faces in scene.faces(marks.deviates).chunk_by(together) {
            match faces[0] {
                Face::Wall(wall) => self.wall(wall, faces, camera, solid),
                Face::Top(top) => self.top(top, camera),
                Face::Behind(of) => {
                    // The lines of a long path are drawn together, in one place.
                    if !is_long(scene) {
                        self.path(scene, camera, marks, Some(of));
                    }
                    self.touches(scene, camera, marks.deviates, Some(of));
                }
            }
        }
    }

    /// The moves and the touches that nothing stands before.
    fn moves(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>) {
        if is_long(scene) {
            self.long(scene, camera);
            for line in scene.lines.iter().filter(|line| marks.highlight == Some(line.index)) {
                self.line(line, camera, true, true);
            }
        } else {
            self.path(scene, camera, marks, None);
        }
        self.touches(scene, camera, marks.deviates, None);
    }

    /// What was measured, what the ball meets, where it is, and the line that the cycle is about.
    fn happens(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>) {
        for spot in marks.measured {
            self.square(camera.pixel(*spot));
        }
        if let Some((_, place)) = scene.collision {
            self.collision(camera.pixel(place), scene.radius * camera.scale);
        }
        if let Some(index) = marks.highlight {
            self.ball(scene, camera, index, marks.part);
        }
        let Some([nominal, real]) = scene.centre_lines else { return };
        let line = |[from, to]: [Vec2; 2], colour| {
            self.segment(camera.pixel(from), camera.pixel(to), colour, 1.0, &[10.0, 4.0, 2.0, 4.0]);
        };
        line(nominal, &self.theme.wall);
        if marks.deviates {
            line(real, &self.theme.actual);
        }
    }

    /// The dimensions, and above them what they and the angles say.
    fn sizes(&self, layout: &Layout<'_>, marks: &Marks<'_>) {
        let mut names = Vec::new();
        let mut name = |own: &str, plate: Plate| {
            let said = marks.names.iter().find(|(field, _)| *field == own).map_or("", |(_, name)| name);
            names.push(Name { said, plate, lit: marks.field == Some(own) });
        };
        for arc in &layout.arcs {
            arc.name.into_iter().for_each(|plate| name(arc.angle.field, plate));
        }
        for placed in &layout.dimensions {
            self.dimension(placed, marks.field == Some(placed.drawn.field));
            name(placed.drawn.field, placed.name);
        }
        if !names.is_empty() {
            self.names(&names);
        }
    }

    /// Draws arrows from one origin.
    pub fn draw_arrows(&self, arrows: &[(Arrow, String, Vec2)], camera: &Camera) {
        self.begin(camera, "600 13px system-ui, sans-serif");
        let origin = camera.pixel(Vec2::ZERO);
        for (kind, name, tip) in arrows {
            let (colour, width, dash): (&str, f64, &[f64]) = match kind {
                Arrow::Axis => (&self.theme.text, 1.5, &[]),
                Arrow::Base => (&self.theme.link, 1.0, &[5.0, 4.0]),
                Arrow::Length => (&self.theme.touch, 4.0, &[]),
            };
            let end = camera.pixel(*tip);
            let way = (end - origin) / origin.distance(end).max(1e-9);
            self.segment(origin, end, colour, width, dash);
            for side in [-0.5, 0.5] {
                self.segment(end, end - (way - way.perp() * side) * 10.0, colour, width.min(2.5), &[]);
            }
            // Names stand beyond the tip; those of lengths beside it, so that an axis under it keeps its own.
            let aside = if *kind == Arrow::Length { 14.0 } else { 0.0 };
            let beyond = if *kind == Arrow::Length { -4.0 } else { 14.0 };
            self.label(name, end + way * beyond + way.perp() * aside);
        }
    }

    /// The material behind edges, filled and hatched as in a section.
    fn material(&self, scene: &Scene, camera: &Camera) {
        if scene.material.is_empty() {
            return;
        }
        let c = &self.context;
        let most = if self.small { SMALL_BAND } else { BAND };
        c.save();
        c.begin_path();
        let [filled, air] = material::outlines(&scene.material, camera, most);
        filled.iter().for_each(|outline| self.outline(outline));
        c.set_fill_style_str(&self.theme.wall);
        c.set_global_alpha(0.12);
        c.fill();
        c.clip();
        // The strokes lie still against the part while the picture is moved.
        let Vec2 { x: width, y: height } = camera.size;
        let first = camera.pixel(Vec2::ZERO).element_sum().rem_euclid(HATCH);
        c.begin_path();
        for k in 0..=((width + height) / HATCH) as usize {
            let at = first + HATCH * k as f64;
            c.move_to(at, 0.0);
            c.line_to(at - height, height);
        }
        c.set_global_alpha(0.4);
        c.set_stroke_style_str(&self.theme.wall);
        c.set_line_width(0.75);
        self.dash(&[]);
        c.stroke();
        c.restore();
        c.begin_path();
        air.iter().for_each(|outline| self.outline(outline));
        c.set_fill_style_str(&self.theme.background);
        c.fill();
    }

    /// A closed outline, pixels, as a part of the current path.
    fn outline(&self, outline: &[Vec2]) {
        let c = &self.context;
        for (k, at) in outline.iter().enumerate() {
            if k == 0 { c.move_to(at.x, at.y) } else { c.line_to(at.x, at.y) }
        }
        c.close_path();
    }

    /// A wall, or the strips of a round one, its faces `solid`: else they let a section's hatching through, and are no darker than it. What is drawn in
    /// one has no seams.
    fn wall(&self, wall: &WallShape, strips: &[Face<'_>], camera: &Camera, solid: bool) {
        let c = &self.context;
        let colour = if wall.actual { &self.theme.actual } else { &self.theme.wall };
        let all = || strips.iter().filter_map(|face| if let Face::Wall(wall) = face { Some(*wall) } else { None });
        c.begin_path();
        let mut before = Vec2::NAN;
        for ends in all().filter_map(|wall| wall.edge) {
            let [from, to] = ends.map(|spot| camera.pixel(spot));
            // From strip to strip it continues, and so do its dashes.
            let continues = from.distance(before) < 0.1;
            if !continues {
                c.move_to(from.x, from.y);
            }
            c.line_to(to.x, to.y);
            before = to;
        }
        let (width, dash): (_, &[f64]) = if wall.actual { (1.5, &[7.0, 4.0]) } else { (2.0, &[]) };
        c.set_stroke_style_str(colour);
        c.set_line_width(width);
        self.dash(dash);
        c.stroke();
        let all = || all().filter(|wall| wall.edge.is_none());
        if all().next().is_none() {
            return;
        }
        c.begin_path();
        all().for_each(|wall| self.outline(&wall.corners.map(|corner| camera.pixel(corner))));
        // A surface that is seen is solid; one that is looked at from behind is only a veil: so a hole is not a boss.
        if wall.faces && !wall.actual && solid {
            c.set_fill_style_str(&self.theme.background);
            c.set_global_alpha(0.8);
            c.fill();
        }
        c.set_fill_style_str(colour);
        c.set_global_alpha(if wall.faces && solid { 0.2 } else { 0.05 });
        c.fill();
        c.set_global_alpha(if wall.faces { 0.8 } else { 0.35 });
        c.set_stroke_style_str(colour);
        c.set_line_width(1.0);
        self.dash(&[]);
        if wall.strip {
            c.begin_path();
            for pair in all().flat_map(|wall| wall.corners.chunks(2)) {
                let [from, to] = [0, 1].map(|i| camera.pixel(pair[i]));
                c.move_to(from.x, from.y);
                c.line_to(to.x, to.y);
            }
        }
        c.stroke();
        c.set_global_alpha(1.0);
    }

    /// A top side: lighter than the walls below it.
    fn top(&self, top: &Top, camera: &Camera) {
        let c = &self.context;
        c.begin_path();
        self.outline(&top.corners.iter().map(|corner| camera.pixel(*corner)).collect::<Vec<_>>());
        c.set_fill_style_str(&self.theme.background);
        c.fill();
        c.set_fill_style_str(&self.theme.wall);
        c.set_global_alpha(0.09);
        c.fill();
        c.set_global_alpha(0.8);
        c.set_stroke_style_str(&self.theme.wall);
        c.set_line_width(1.0);
        self.dash(&[]);
        c.stroke();
        c.set_global_alpha(1.0);
    }

    fn line(&self, line: &Line, camera: &Camera, highlit: bool, reached: bool) {
        // Line style distinguishes the kinds of moves; colour only repeats it.
        let (colour, width, alpha, dash): (_, _, _, &[f64]) = match line.stroke {
            _ if line.rapid => (&self.theme.position, 1.0, 1.0, &[12.0, 5.0]),
            Stroke::Position => (&self.theme.position, 1.5, 1.0, &[9.0, 4.0, 2.0, 4.0]),
            Stroke::Link => (&self.theme.link, 1.5, 1.0, &[6.0, 4.0]),
            Stroke::Touch => (&self.theme.touch, 2.5, 1.0, &[]),
            Stroke::Overtravel => (&self.theme.touch, 1.5, 0.9, &[1.5, 3.5]),
        };
        let (from, to) = (camera.pixel(line.from), camera.pixel(line.to));
        self.context.set_global_alpha(if reached { alpha } else { 0.2 });
        if highlit {
            self.segment(from, to, &self.theme.highlight, width + 3.0, &[]);
        }
        self.segment(from, to, colour, width, dash);
        self.context.set_global_alpha(1.0);
    }

    /// The moves behind something, or those behind nothing.
    fn path(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>, behind: Option<usize>) {
        let lines = || scene.lines.iter().filter(move |line| line.behind == behind);
        // Touches lie on their ways back: drawn last, they are seen.
        for touches in [false, true] {
            for line in lines().filter(|line| (line.stroke == Stroke::Touch) == touches) {
                self.line(line, camera, marks.highlight == Some(line.index) && lit(line), reached(scene, line));
            }
        }
        if !self.small {
            lines().filter(|line| reached(scene, line)).for_each(|line| self.arrow(line, camera));
        }
    }

    /// The touches behind something, or those behind nothing: ball, contact, and the contact on the virtual part.
    fn touches(&self, scene: &Scene, camera: &Camera, deviates: bool, behind: Option<usize>) {
        let radius = scene.radius * camera.scale;
        // What is hidden is seen faintly through what hides it.
        for touch in scene.touches.iter().filter(|touch| behind.is_none() && touch.behind.is_some()) {
            self.context.set_global_alpha(0.35);
            self.circle(camera.pixel(touch.ball), radius, &self.theme.ball, 1.0);
            self.disc(camera.pixel(touch.contact), 3.5, &self.theme.touch);
            self.context.set_global_alpha(1.0);
        }
        for touch in scene.touches.iter().filter(|touch| touch.behind == behind) {
            let ball = camera.pixel(touch.ball);
            self.context.set_global_alpha(0.1);
            self.disc(ball, radius, &self.theme.ball);
            self.context.set_global_alpha(1.0);
            self.circle(ball, radius, &self.theme.ball, 1.0);
            if let Some(trigger) = touch.trigger.filter(|_| deviates) {
                let p = camera.pixel(trigger);
                self.circle(p, radius, &self.theme.actual, 1.0);
                for arm in [Vec2::X * 4.0, Vec2::Y * 4.0] {
                    self.segment(p - arm, p + arm, &self.theme.actual, 1.5, &[]);
                }
            }
            self.disc(camera.pixel(touch.contact), 3.5, &self.theme.touch);
        }
    }

    /// The number of a touch, or of several.
    fn number(&self, number: &Number) {
        let Vec2 { x, y } = number.plate.middle;
        if number.led {
            self.segment(number.contact, number.plate.middle, &self.theme.touch, 1.0, &[]);
        }
        self.font(if number.radius() < 8.0 { SMALL } else { BOLD });
        let Vec2 { x: wide, y: high } = number.plate.half;
        let c = &self.context;
        c.begin_path();
        for (side, start) in [(wide - high, -FRAC_PI_2), (high - wide, FRAC_PI_2)] {
            let _ = c.arc(x + side, y, high, start, start + PI);
        }
        c.set_fill_style_str(&self.theme.touch);
        c.fill();
        c.set_fill_style_str(&self.theme.background);
        let _ = c.fill_text(&number.said, x, y);
    }

    /// A measured ball centre: a square on its tip, which nothing else is.
    fn square(&self, at: Vec2) {
        let c = &self.context;
        c.begin_path();
        self.outline(&[Vec2::NEG_Y, Vec2::X, Vec2::Y, Vec2::NEG_X].map(|way| at + way * 7.0));
        c.set_stroke_style_str(&self.theme.highlight);
        c.set_line_width(2.0);
        self.dash(&[]);
        c.stroke();
    }

    /// The ball where it meets the part, in the colour of touches, crossed out.
    fn collision(&self, at: Vec2, radius: f64) {
        let (c, radius) = (&self.context, radius.max(6.0));
        c.set_global_alpha(0.35);
        self.disc(at, radius, &self.theme.touch);
        c.set_global_alpha(1.0);
        self.circle(at, radius, &self.theme.touch, 3.0);
        for arm in [Vec2::new(1.0, -1.0), Vec2::ONE].map(|way| way * radius * 1.6) {
            self.segment(at - arm, at + arm, &self.theme.touch, 3.0, &[]);
        }
    }

    /// The arrow head of a move.
    fn arrow(&self, line: &Line, camera: &Camera) {
        let colour = match line.stroke {
            Stroke::Position => &self.theme.position,
            Stroke::Link => &self.theme.link,
            Stroke::Touch | Stroke::Overtravel => &self.theme.touch,
        };
        if let Some((tip, way, size)) = camera.head(line) {
            self.head(tip, way, size, colour);
        }
    }
}
