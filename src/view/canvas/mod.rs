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
use crate::view::label_box::BAND;
use crate::view::layout::Layout;
use crate::view::lengths::Arrow;
use crate::view::material;
use crate::view::numbers::Number;
use crate::view::scene::blocks::{Block, Face};
use crate::view::scene::{Line, Scene, Stroke};
use crate::view::style::screen::ARROWS;
use crate::view::style::{self, CENTRE_LINES, Colour, EDGES};

/// Highlights and texts beside the scene itself.
#[derive(Clone, Copy, Debug)]
pub struct Marks<'a> {
    /// The highlighted move.
    pub highlight: Option<usize>,
    /// Fraction of that move that is done, 0 to 1.
    pub part: f64,
    /// Whether the virtual part deviates from the nominal one.
    pub deviates: bool,
    /// The path of the field that has the focus.
    pub field: Option<&'a str>,
    /// Names of the dimensions, by the paths of their fields.
    pub names: &'a [(&'static str, String)],
    /// Name of the work offset.
    pub origin: &'a str,
    /// Ball centres measured by a machine.
    pub measured: &'a [Vec2],
    /// Whether the scale has a decimal comma.
    pub comma: bool,
}

/// Fonts of a picture: names of dimensions, and everything else.
const LABEL: &str = "13px system-ui, sans-serif";
const BOLD: &str = "600 13px system-ui, sans-serif";

/// Pixels between hatching lines.
const HATCH: f64 = 9.0;

/// Depth of the material shown behind an edge of a small picture, pixels.
const SMALL_BAND: f64 = 8.0;

/// Distance that the disc of a number extends from its contact, pixels.
const NUMBER: f64 = 25.0;

/// Half the size of the dot for a touch seen along its direction, pixels.
const DOT: f64 = 3.5;

/// Half the size of a handle in pixels.
const HANDLE: f64 = 6.0;

/// Distance of the axis names from their corner, and radius in which a click belongs to them, pixels.
const AXIS_NAME: f64 = 28.0;
const AXES: f64 = 36.0;

/// Position of the work axes.
fn axes_corner(camera: &Camera) -> Vec2 {
    Vec2::new(AXES_CORNER, camera.size.y - AXES_CORNER)
}

/// View for a click on the axes: along the axis whose name is there, or isometric beside them.
pub fn axis_at(scene: &Scene, camera: &Camera, at: Vec2) -> Option<&'static str> {
    let corner = axes_corner(camera);
    if corner.distance(at) > AXES {
        return None;
    }
    let near = |direction: Vec2| {
        let tip = corner + direction * DOWNWARDS * AXIS_NAME;
        direction.length() > 0.1 && tip.distance(at) <= 14.0
    };
    // A click on the abscissa shows the side, on the ordinate the front, on the tool axis the top.
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

/// Positions of the handles for the first touch's angle and the end of the spread: outside the circle and the numbers of its touches, one farther out than the
/// other, so that a full turn shows both.
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

/// Whether a scene has so many lines that it is drawn in few strokes, with solid feeds.
pub fn is_long(scene: &Scene) -> bool {
    scene.lines.len() > long_program::LONG
}

/// Whether a run reaches a line: not after a collision.
fn reached(scene: &Scene, line: &Line) -> bool {
    scene.collision.is_none_or(|(index, _)| line.index <= index)
}

/// Whether a line is highlighted with its move: the ball does not make the search past a contact.
fn lit(line: &Line) -> bool {
    line.stroke != Stroke::Overtravel
}

/// A canvas and its drawing state.
#[derive(Debug)]
pub struct Painter {
    canvas: HtmlCanvasElement,
    context: CanvasRenderingContext2d,
    pub theme: Theme,
    /// Whether it is a small picture without axes, numbers and handles.
    pub small: bool,
    /// Whether nothing can be gripped.
    pub still: bool,
    /// Device pixels per CSS pixel.
    pub ratio: f64,
    /// Current font: every change makes the browser compute the page's styles first.
    font: Cell<&'static str>,
    /// Current dashes: every change copies them into a list of the browser.
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

    /// Sets the size of the canvas in CSS pixels, each `ratio` device pixels wide.
    pub fn resize(&mut self, size: Vec2, ratio: f64) {
        self.ratio = ratio;
        self.canvas.set_width((size.x * ratio).round() as u32);
        self.canvas.set_height((size.y * ratio).round() as u32);
        // A new size resets the drawing state.
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
        // State restored to the earlier one has no dashes.
        self.dash(&[]);
        self.font(font);
        c.set_text_align("center");
        c.set_text_baseline("middle");
    }

    /// Clears the canvas above that of a picture.
    pub fn clear(&self, camera: &Camera) {
        let _ = self
            .context
            .set_transform(self.ratio, 0.0, 0.0, self.ratio, 0.0, 0.0);
        self.context
            .clear_rect(0.0, 0.0, camera.size.x, camera.size.y);
    }

    /// Draws a highlighted move of a picture on the canvas above it.
    pub fn draw_lit(&self, scene: &Scene, camera: &Camera, index: usize, part: f64) {
        let c = &self.context;
        c.set_line_cap("round");
        c.set_text_align("center");
        c.set_text_baseline("middle");
        for line in scene.lines.iter().filter(|line| line.index == index) {
            self.line(line, camera, lit(line), reached(scene, line));
        }
        self.ball(scene, camera, index, part);
        // The number of a highlighted touch is not beneath it.
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

    /// The moving ball, and the stylus above it.
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
        // Above everything at their contacts.
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

    /// Material, walls and top sides, and everything behind them.
    fn part(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>) {
        self.material(scene, camera);
        self.blocks(scene, camera);
        let solid = scene.material.is_empty();
        for item in scene.display(camera, marks.deviates) {
            match item {
                Item::Walls(walls) => self.walls(&walls, solid),
                Item::Top(corners) => self.top(corners),
                Item::Behind(of) => {
                    // The lines of a long path are drawn together.
                    if !is_long(scene) {
                        self.path(scene, camera, marks, Some(of));
                    }
                    self.touches(scene, camera, marks, Some(of));
                }
            }
        }
    }

    /// Moves and touches that nothing hides.
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

    /// Measured points, collision, moving ball, and centre line of the cycle.
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

    /// The dimensions, and above them the names of dimensions and angles.
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
            // Names are beyond the tip; those of lengths beside it, so that an axis beneath keeps its name.
            let aside = if *kind == Arrow::Length { 14.0 } else { 0.0 };
            let beyond = if *kind == Arrow::Length { -4.0 } else { 14.0 };
            let mut at = end + way * beyond + way.perp() * aside;
            // Coinciding axes: one name below the other.
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

    /// Material behind edges, filled and hatched as in a section.
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

    /// In the isometric view the material around inner features, cut open.
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

    /// Outlines filled with this darkness, and hatched as in a section.
    fn hatched(&self, filled: &[Vec<Vec2>], camera: &Camera, dark: f64) {
        let c = &self.context;
        c.save();
        self.outlines(filled);
        self.alpha(dark).fill(Colour::Wall);
        c.clip();
        // The hatching stays fixed to the part while the picture moves.
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

    /// Walls in one; with `solid` faces, else they let a section's hatching show through and are no darker.
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
        // A visible surface is solid; one seen from behind is only a veil: so a hole does not look like a boss.
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

    /// Moves hidden by something, or those that nothing hides.
    fn path(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>, behind: Option<usize>) {
        let lines = || {
            scene
                .lines
                .iter()
                .filter(move |line| line.occluder == behind)
        };
        // Touches coincide with their retracts: drawn last, they are visible.
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

    /// Touches hidden by something, or those that nothing hides: ball, contact, and the contact on the virtual part.
    fn touches(&self, scene: &Scene, camera: &Camera, marks: &Marks<'_>, behind: Option<usize>) {
        let asked = marks.field == Some("stylus.diameter");
        // The ball stays visible beside a part of several metres.
        let radius = (scene.radius * camera.scale).max(2.5);
        // Hidden parts are faintly visible.
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
        if number.has_leader {
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
        let _ = c.fill_text(&number.label, x, y);
    }

    /// A measured ball centre: a square on its tip, a shape that nothing else has.
    fn square(&self, at: Vec2) {
        self.outlines(&[[Vec2::NEG_Y, Vec2::X, Vec2::Y, Vec2::NEG_X].map(|way| at + way * 7.0)]);
        self.stroke(Colour::Highlight, 2.0);
    }

    /// The ball at a collision, in the colour of touches, crossed out.
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
