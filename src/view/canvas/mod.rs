//! Draws a scene on a browser's canvas: the only module that names `web_sys`.

mod long_program;
mod strokes;
mod surroundings;
mod theme;

use std::cell::Cell;
use std::f64::consts::{FRAC_PI_2, PI};

use strokes::Name;
pub use theme::Theme;
use web_sys::{CanvasRenderingContext2d, HtmlCanvasElement};

use crate::geom::Vec2;
use crate::view::camera::{AXES_CORNER, Camera, DOWNWARDS};
use crate::view::display::{Item, Walls};
use crate::view::layout::Layout;
use crate::view::lengths::Arrow;
use crate::view::material;
use crate::view::numbers::Number;
use crate::view::plate::BAND;
use crate::view::scene::blocks::{Block, Face};
use crate::view::scene::{Line, Scene, Stroke};
use crate::view::style::screen::ARROWS;
use crate::view::style::{self, CENTRE_LINES, Colour, EDGES};

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

/// The fonts of a picture: of what dimensions are called, and of everything else.
const LABEL: &str = "13px system-ui, sans-serif";
const BOLD: &str = "600 13px system-ui, sans-serif";

/// Pixels between the strokes of a hatching.
const HATCH: f64 = 9.0;

/// How deep material is seen behind an edge of a small picture, pixels.
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
    let found = scene
        .axes
        .iter()
        .zip(["side", "front", "top"])
        .find(|((_, direction), _)| near(*direction));
    Some(found.map_or("isometric", |(_, view)| view))
}

/// Distance of the handle that turns the part from the one that shifts it, pixels.
pub fn turning(shifting: Vec2, direction: Vec2) -> Vec2 {
    shifting + direction * DOWNWARDS * 64.0
}

/// Positions of the handles of the first touch's angle and of the spread's end: outside the circle and the numbers of its touches, one further out
/// than the other, so that a whole turn shows both.
pub fn spread_handles(scene: &Scene, camera: &Camera) -> Option<[Vec2; 2]> {
    let (center, radius, start, sweep) = scene.spread?;
    let center = camera.pixel(center);
    let at = |angle: f64, out: f64| {
        center + Vec2::from_angle(angle) * DOWNWARDS * (radius * camera.scale + out)
    };
    let first = NUMBER + HANDLE + 3.0;
    Some([
        at(start, first),
        at(start + sweep, first + 2.0 * HANDLE + 3.0),
    ])
}

/// Whether a scene has so many lines that it is drawn in few strokes, and feeds without dashes.
pub fn is_long(scene: &Scene) -> bool {
    scene.lines.len() > long_program::LONG
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
    pub theme: Theme,
    /// Whether it is a small picture: no axes, no numbers, no handles.
    pub small: bool,
    /// Whether nothing is there to be gripped.
    pub still: bool,
    /// Device pixels in a CSS pixel.
    pub ratio: f64,
    /// The font that is set: each time one is set, the browser works out the page's styles first.
    font: Cell<&'static str>,
    /// The dashes that are set: each time some are set, they are copied into a list of the browser's.
    dashes: Cell<&'static [f64]>,
}

impl Painter {
    /// A painter on a canvas; `None` if the canvas has no 2D context.
    pub fn new(canvas: HtmlCanvasElement) -> Option<Self> {
        use wasm_bindgen::JsCast;
        let context = canvas
            .get_context("2d")
            .ok()??
            .dyn_into::<CanvasRenderingContext2d>()
            .ok()?;
        let (theme, font, dashes) = (Theme::of(|_| None), Cell::new(""), Cell::new(&[][..]));
        Some(Painter {
            canvas,
            context,
            theme,
            small: false,
            still: false,
            ratio: 1.0,
            font,
            dashes,
        })
    }

    /// The canvas covers so many CSS pixels, each `ratio` device pixels wide.
    pub fn resize(&mut self, size: Vec2, ratio: f64) {
        self.ratio = ratio;
        self.canvas.set_width((size.x * ratio).round() as u32);
        self.canvas.set_height((size.y * ratio).round() as u32);
        // Another size resets all that was set.
        self.font.set("");
        self.dashes.set(&[]);
    }

    fn font(&self, font: &'static str) {
        if self.font.replace(font) != font {
            self.context.set_font(font);
        }
    }

    /// Begins a picture: fills the canvas with the background, and sets the font; texts are centred.
    fn begin(&self, camera: &Camera, font: &'static str) {
        let c = &self.context;
        let _ = c.set_transform(self.ratio, 0.0, 0.0, self.ratio, 0.0, 0.0);
        self.plate(
            camera.size / 2.0,
            camera.size / 2.0,
            Colour::Background,
            None,
        );
        // Nothing that is restored to what was set before has dashes.
        self.dash(&[]);
        self.font(font);
        c.set_text_align("center");
        c.set_text_baseline("middle");
    }

    /// Empties a canvas that lies over that of a picture.
    pub fn clear(&self, camera: &Camera) {
        let _ = self
            .context
            .set_transform(self.ratio, 0.0, 0.0, self.ratio, 0.0, 0.0);
        self.context
            .clear_rect(0.0, 0.0, camera.size.x, camera.size.y);
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
            && let Some(touch) = scene
                .touches
                .iter()
                .position(|touch| touch.index == Some(index))
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
        let Some(place) = scene.ball(index, part) else {
            return;
        };
        for outline in &scene.stylus {
            self.outlines(&[outline.map(|corner| camera.pixel(place + corner))]);
            self.alpha(0.12).fill(Colour::Highlight);
            self.alpha(0.7).stroke(Colour::Highlight, 1.0);
        }
        let (ball, radius) = (camera.pixel(place), (scene.radius * camera.scale).max(3.0));
        self.alpha(0.25).disc(ball, radius, Colour::Highlight);
        self.alpha(1.0).circle(ball, radius, Colour::Highlight, 2.0);
    }

    pub fn draw(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>) {
        let c = &self.context;
        self.begin(camera, BOLD);
        c.set_line_cap("round");
        c.set_line_join("round");
        self.part(scene, camera, marks);
        // Beneath the moves, the touches and the dimensions.
        let layout = if self.small {
            None
        } else {
            Some(camera.layout(scene, marks.field))
        };
        for arc in layout.iter().flat_map(|layout| &layout.arcs) {
            self.angle(arc, marks.field == Some(arc.angle.field));
        }
        self.moves(scene, camera, marks);
        self.happens(scene, camera, marks);
        let Some(layout) = layout else { return };
        if !self.still {
            self.handles(scene, camera);
        }
        if marks.field == Some("cycle.rotation") {
            self.turn(scene, camera);
        }
        self.axes(scene, camera, marks.origin, &layout);
        if let Some(unit) = scene.unit {
            self.distances(scene, camera, (unit, marks.comma), &layout);
        }
        // Over everything that may lie at their contacts.
        layout.numbers.iter().for_each(|number| self.number(number));
        self.font(BOLD);
        // The touches of a job have their balls.
        if scene.touches.is_empty() {
            self.dots(scene, camera);
        }
        if let Some(unit) = scene.unit {
            self.scale_bar(camera, unit, marks.comma, &layout);
        }
        self.sizes(&layout, marks);
    }

    /// The material, the walls and top sides, and what lies behind these.
    fn part(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>) {
        self.material(scene, camera);
        self.blocks(scene, camera);
        let solid = scene.material.is_empty();
        for item in scene.display(camera, marks.deviates) {
            match item {
                Item::Walls(walls) => self.walls(&walls, solid),
                Item::Top(corners) => self.top(corners),
                Item::Behind(of) => {
                    // The lines of a long path are drawn together, in one place.
                    if !is_long(scene) {
                        self.path(scene, camera, marks, Some(of));
                    }
                    self.touches(scene, camera, marks, Some(of));
                }
            }
        }
    }

    /// The moves and touches that nothing hides.
    fn moves(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>) {
        if is_long(scene) {
            self.long(scene, camera);
            for line in scene
                .lines
                .iter()
                .filter(|line| marks.highlight == Some(line.index))
            {
                self.line(line, camera, true, true);
            }
        } else {
            self.path(scene, camera, marks, None);
        }
        self.touches(scene, camera, marks, None);
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
        for [from, to] in &scene.related {
            self.dashes(camera.pixel(*from), camera.pixel(*to), &CENTRE_LINES[0]);
        }
        let lines = scene.centre_lines.into_iter().flatten().zip(&CENTRE_LINES);
        for ([from, to], pen) in lines.take(if marks.deviates { 2 } else { 1 }) {
            self.dashes(camera.pixel(from), camera.pixel(to), pen);
        }
    }

    /// The dimensions, and above them what they and the angles say.
    fn sizes(&self, layout: &Layout<'_>, marks: &Marks<'_>) {
        let lit = |field: &str| marks.field == Some(field);
        layout
            .dimensions
            .iter()
            .for_each(|placed| self.dimension(placed, lit(placed.drawn.field)));
        let names: Vec<_> = layout
            .names(marks.names)
            .into_iter()
            .map(|(field, said, plate)| Name {
                said,
                plate,
                lit: lit(field),
            })
            .collect();
        if !names.is_empty() {
            self.names(&names);
        }
    }

    /// Draws arrows from one origin.
    pub fn draw_arrows(&self, arrows: &[(Arrow, String, Vec2)], camera: &Camera) {
        self.begin(camera, "600 13px system-ui, sans-serif");
        let origin = camera.pixel(Vec2::ZERO);
        let mut named: Vec<Vec2> = Vec::new();
        for (kind, name, tip) in arrows {
            let pen = &ARROWS[*kind as usize];
            let end = camera.pixel(*tip);
            let way = (end - origin) / origin.distance(end).max(1e-9);
            self.dashes(origin, end, pen);
            for side in [-0.5, 0.5] {
                self.segment(
                    end,
                    end - (way - way.perp() * side) * 10.0,
                    pen.colour,
                    pen.widths[0].min(2.5),
                );
            }
            // Names are placed beyond the tip; those of lengths beside it, so that an axis under it keeps its own.
            let aside = if *kind == Arrow::Length { 14.0 } else { 0.0 };
            let beyond = if *kind == Arrow::Length { -4.0 } else { 14.0 };
            let mut at = end + way * beyond + way.perp() * aside;
            // Axes that lie on each other: one name below the other.
            while named
                .iter()
                .any(|other| (*other - at).abs().cmplt(Vec2::new(26.0, 14.0)).all())
            {
                at.y += 15.0;
            }
            named.push(at);
            self.label(name, at);
        }
    }

    /// The material behind edges, filled and hatched as in a section.
    fn material(&self, scene: &Scene, camera: &Camera) {
        if scene.material.is_empty() {
            return;
        }
        let most = if self.small { SMALL_BAND } else { BAND };
        let [filled, air] = material::outlines(&scene.material, camera, most);
        self.hatched(&filled, camera, 0.12);
        self.outlines(&air);
        self.fill(Colour::Background);
    }

    /// Isometric, the material around what lies inside the part, cut open.
    fn blocks(&self, scene: &Scene, camera: &Camera) {
        for Block { face, corners } in &scene.blocks {
            let outline: Vec<Vec2> = corners.iter().map(|corner| camera.pixel(*corner)).collect();
            match face {
                Face::Top => self.top(outline),
                Face::Cut => {
                    let outline = [outline];
                    self.outlines(&outline);
                    self.fill(Colour::Background);
                    self.hatched(&outline, camera, 0.3);
                    self.outlines(&outline);
                    self.alpha(0.8).stroke(Colour::Wall, 1.0);
                }
                Face::Away => {
                    self.outlines(&[outline]);
                    self.alpha(0.04).fill(Colour::Wall);
                    self.alpha(0.3).stroke(Colour::Wall, 1.0);
                }
            }
            self.alpha(1.0);
        }
    }

    /// Outlines filled so dark, and hatched as in a section.
    fn hatched(&self, filled: &[Vec<Vec2>], camera: &Camera, dark: f64) {
        let c = &self.context;
        c.save();
        self.outlines(filled);
        self.alpha(dark).fill(Colour::Wall);
        c.clip();
        // The strokes lie still against the part while the picture is moved.
        let Vec2 {
            x: width,
            y: height,
        } = camera.size;
        let first = camera.pixel(Vec2::ZERO).element_sum().rem_euclid(HATCH);
        c.begin_path();
        for k in 0..=((width + height) / HATCH) as usize {
            let at = first + HATCH * k as f64;
            self.points(&[Vec2::new(at, 0.0), Vec2::new(at - height, height)]);
        }
        self.alpha(0.4).stroke(Colour::Wall, 0.75);
        c.restore();
    }

    /// Walls in one, their faces `solid`: else they let a section's hatching through, and are no darker than it.
    fn walls(
        &self,
        Walls {
            wall,
            lines,
            outlines,
        }: &Walls<'_>,
        solid: bool,
    ) {
        let c = &self.context;
        let colour = if wall.actual {
            Colour::Actual
        } else {
            Colour::Wall
        };
        if !lines.is_empty() {
            c.begin_path();
            lines.iter().for_each(|line| self.points(line));
            self.dashed(&EDGES[usize::from(wall.actual)]);
        }
        if outlines.is_empty() {
            return;
        }
        self.outlines(outlines);
        // A surface that is seen is solid; one that is looked at from behind is only a veil: so a hole is not a boss.
        if wall.faces && !wall.actual && solid {
            self.alpha(0.8).fill(Colour::Background);
        }
        self.alpha(if wall.faces && solid { 0.2 } else { 0.05 })
            .fill(colour);
        if wall.strip {
            c.begin_path();
            outlines
                .as_flattened()
                .chunks(2)
                .for_each(|side| self.points(side));
        }
        self.alpha(if wall.faces { 0.8 } else { 0.35 })
            .stroke(colour, 1.0);
        self.alpha(1.0);
    }

    /// A top side: lighter than the walls below it.
    fn top(&self, corners: Vec<Vec2>) {
        self.outlines(&[corners]);
        self.fill(Colour::Background);
        self.alpha(0.09).fill(Colour::Wall);
        self.alpha(0.8).stroke(Colour::Wall, 1.0);
        self.alpha(1.0);
    }

    fn line(&self, line: &Line, camera: &Camera, highlit: bool, reached: bool) {
        let pen = style::of(line.stroke, line.rapid);
        let (from, to) = (camera.pixel(line.from), camera.pixel(line.to));
        self.alpha(match line.stroke {
            _ if !reached => 0.2,
            _ if line.pale && !highlit => 0.4,
            Stroke::Overtravel => 0.9,
            Stroke::Position | Stroke::Link | Stroke::Touch => 1.0,
        });
        if highlit {
            self.segment(from, to, Colour::Highlight, pen.widths[0] + 3.0);
        }
        self.dashes(from, to, pen);
        self.alpha(1.0);
    }

    /// The moves behind something, or those behind nothing.
    fn path(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>, behind: Option<usize>) {
        let lines = || scene.lines.iter().filter(move |line| line.behind == behind);
        // Touches lie on their ways back: drawn last, they are seen.
        for touches in [false, true] {
            for line in lines().filter(|line| (line.stroke == Stroke::Touch) == touches) {
                let moves = marks.highlight == Some(line.index) && lit(line);
                let asked = marks.field == Some("overtravel") && line.stroke == Stroke::Overtravel;
                self.line(line, camera, moves || asked, reached(scene, line));
            }
        }
        if !self.small {
            lines()
                .filter(|line| reached(scene, line))
                .for_each(|line| self.arrow(line, camera));
        }
    }

    /// The touches behind something, or those behind nothing: ball, contact, and the contact on the virtual part.
    fn touches(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>, behind: Option<usize>) {
        let asked = marks.field == Some("stylus.diameter");
        // A ball beside a part of metres is still there.
        let radius = (scene.radius * camera.scale).max(2.5);
        // What is hidden is seen faintly through what hides it.
        for touch in scene
            .touches
            .iter()
            .filter(|touch| behind.is_none() && touch.behind.is_some())
        {
            self.alpha(0.35)
                .circle(camera.pixel(touch.ball), radius, Colour::Ball, 1.0);
            self.disc(camera.pixel(touch.contact), DOT, Colour::Touch);
        }
        for touch in scene.touches.iter().filter(|touch| touch.behind == behind) {
            let ball = camera.pixel(touch.ball);
            let (dark, width) = if asked { (0.3, 3.0) } else { (0.1, 1.0) };
            let seen = if touch.pale { 0.4 } else { 1.0 };
            self.alpha(dark * seen).disc(ball, radius, Colour::Ball);
            self.alpha(seen).circle(ball, radius, Colour::Ball, width);
            if let Some(trigger) = touch.trigger.filter(|_| marks.deviates) {
                let at = camera.pixel(trigger);
                self.circle(at, radius, Colour::Actual, 1.0);
                for arm in [Vec2::X * 4.0, Vec2::Y * 4.0] {
                    self.segment(at - arm, at + arm, Colour::Actual, 1.5);
                }
            }
            self.disc(camera.pixel(touch.contact), DOT, Colour::Touch);
        }
        self.alpha(1.0);
    }

    /// The number of a touch, or of several.
    fn number(&self, number: &Number) {
        let Vec2 { x, y } = number.plate.middle;
        if number.led {
            self.segment(number.contact, number.plate.middle, Colour::Touch, 1.0);
        }
        self.font(BOLD);
        let Vec2 { x: wide, y: high } = number.plate.half;
        let c = &self.context;
        c.begin_path();
        for (side, start) in [(wide - high, -FRAC_PI_2), (high - wide, FRAC_PI_2)] {
            let _ = c.arc(x + side, y, high, start, start + PI);
        }
        self.fill(Colour::Touch);
        c.set_fill_style_str(self.theme.colour(Colour::Background));
        let _ = c.fill_text(&number.said, x, y);
    }

    /// A measured ball centre: a square on its tip, which nothing else is.
    fn square(&self, at: Vec2) {
        self.outlines(&[[Vec2::NEG_Y, Vec2::X, Vec2::Y, Vec2::NEG_X].map(|way| at + way * 7.0)]);
        self.stroke(Colour::Highlight, 2.0);
    }

    /// The ball where it meets the part, in the colour of touches, crossed out.
    fn collision(&self, at: Vec2, radius: f64) {
        let radius = radius.max(6.0);
        self.alpha(0.35).disc(at, radius, Colour::Touch);
        self.alpha(1.0).circle(at, radius, Colour::Touch, 3.0);
        for arm in [Vec2::new(1.0, -1.0), Vec2::ONE].map(|way| way * radius * 1.6) {
            self.segment(at - arm, at + arm, Colour::Touch, 3.0);
        }
    }

    /// The arrow head of a move.
    fn arrow(&self, line: &Line, camera: &Camera) {
        if let Some((tip, way, size)) = camera.head(line) {
            self.head(tip, way, size, style::of(line.stroke, false).colour);
        }
    }
}
