//! The picture for JavaScript.

mod dimensions;
mod drag;
mod whole;

use std::cell::Cell;
use std::rc::Rc;

use wasm_bindgen::prelude::*;

use crate::geom::{Plane, Vec2, Vec3};
use crate::import::Toolpath;
use crate::import::toolpath::Feature;
use crate::job;
use crate::view::Legend;
use crate::view::camera::{Camera, SMALL_MARGIN};
use crate::view::canvas::{Marks, Painter, Theme, axis_at, is_long};
use crate::view::scene::program::{self, Moves};
use crate::view::scene::{Projection, Scene};
use crate::wasm::Last;

/// A picture of a job on a canvas. Pixels are CSS pixels from the canvas' upper left corner.
#[wasm_bindgen]
#[derive(Debug)]
pub struct View {
    painter: Painter,
    /// Where the move that is pointed at is drawn, where it has a canvas of its own.
    over: Option<Painter>,
    projection: Projection,
    camera: Camera,
    shown: Option<Shown>,
    highlight: Option<usize>,
    /// How much of the highlit move is done, 0 to 1.
    part: f64,
    /// The path of the field that has the focus.
    field: Option<String>,
    /// How many times as large deviations are drawn.
    magnified: f64,
    /// What a machine measured, as text.
    measured_text: String,
    /// The ball centres of it that this job has, each with its touch, in the job's units.
    measured: Vec<(usize, Vec3)>,
    /// Labels of dimensions in another language, by the paths of their fields.
    labels: Vec<(String, String)>,
    comma: bool,
    /// Whether the user has zoomed or panned, so that a new job must not fit the picture again.
    moved: bool,
    /// Whether the picture must stay where it is, since something in it is being dragged.
    held: bool,
    /// The end of a dimension's line that is dragged.
    end: Option<dimensions::End>,
    /// Which cycle of a set-up is in hand, by its place in the list.
    hand: usize,
    /// What `render` draws; `None` if every change is drawn at once.
    due: Option<Cell<Due>>,
}

/// What has changed since the picture was drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Due {
    #[default]
    Nothing,
    /// The move that is pointed at, which is drawn on a canvas of its own.
    Lit,
    All,
}

#[derive(Debug)]
struct Shown {
    scene: Scene,
    content: Content,
}

impl Shown {
    /// Whether the part lies off, or has other sizes.
    fn deviates(&self) -> bool {
        match &self.content {
            Content::Job(held) => held.deviates,
            Content::Program(_, part) => part.as_ref().is_some_and(Feature::deviates),
        }
    }
}

/// The moves of a program, as its picture needs them.
fn moves_of(path: &Toolpath) -> Moves<'_> {
    Moves {
        start: path.start,
        to: &path.to,
        kind: &path.kind,
        feed: &path.feed,
        arcs: &path.arcs,
        contacts: &path.contacts,
        resumes: &path.resumes,
        plane: path.plane,
        scale: path.metric.map(|metric| if metric { 1.0 } else { 25.4 }),
    }
}

/// Content of a scene.
#[derive(Debug)]
enum Content {
    Job(Box<Held>),
    Program(Rc<Toolpath>, Option<Feature>),
}

/// The job that is shown.
#[derive(Debug)]
struct Held {
    last: Rc<Last>,
    deviates: bool,
    plane: Plane,
    /// What each dimension is called, by its field's path.
    names: Vec<(&'static str, String)>,
    /// The work origin's name.
    offset_name: String,
}

#[wasm_bindgen]
impl View {
    /// A view on a canvas.
    #[wasm_bindgen(constructor)]
    pub fn new(canvas: web_sys::HtmlCanvasElement) -> Result<View, JsValue> {
        let painter = Painter::new(canvas)
            .ok_or_else(|| JsValue::from_str("this canvas has no 2D context"))?;
        let camera = Camera {
            scale: 1.0,
            middle: Vec2::ZERO,
            size: Vec2::new(300.0, 150.0),
        };
        Ok(View {
            painter,
            over: None,
            projection: Projection::Top,
            camera,
            shown: None,
            highlight: None,
            part: 1.0,
            field: None,
            magnified: 1.0,
            measured_text: String::new(),
            measured: Vec::new(),
            labels: Vec::new(),
            comma: false,
            moved: false,
            held: false,
            end: None,
            hand: 0,
            due: None,
        })
    }

    /// A transparent canvas that lies over the other and is as large: the move that is pointed at is drawn there, and the picture beneath is not drawn
    /// again.
    #[wasm_bindgen(js_name = setOverlay)]
    pub fn set_overlay(&mut self, canvas: web_sys::HtmlCanvasElement) {
        self.over = Painter::new(canvas);
        if let Some(over) = &mut self.over {
            over.theme = self.painter.theme.clone();
            over.resize(self.camera.size, self.painter.ratio);
        }
        self.draw();
    }

    /// Whether there are handles: nothing can be gripped on paper, and the virtual part's come with its group of the form.
    pub fn grips(&mut self, on: bool) {
        if self.painter.still == on {
            self.painter.still = !on;
            self.draw();
        }
    }

    /// From here on changes are drawn by `render`, all at once, and not one by one.
    pub fn defer(&mut self) {
        self.due.get_or_insert_default();
    }

    /// Draws what has changed since the last time.
    pub fn render(&self) {
        match self
            .due
            .as_ref()
            .map_or(Due::Nothing, |due| due.replace(Due::Nothing))
        {
            Due::Nothing => {}
            Due::Lit => self.paint_lit(),
            Due::All => self.paint_all(),
        }
    }

    /// The canvas covers so many CSS pixels; `ratio` is the device's pixels in one.
    pub fn resize(&mut self, width: f64, height: f64, ratio: f64) {
        self.camera.size = Vec2::new(width, height);
        let size = self.camera.size;
        self.painters()
            .for_each(|painter| painter.resize(size, ratio));
        self.refit();
        self.draw();
    }

    /// Colours: `background`, `text`, `wall`, `actual`, `position`, `link`, `touch`, `ball`, `highlight`.
    #[wasm_bindgen(js_name = setTheme)]
    pub fn set_theme(&mut self, theme: &JsValue) {
        let colour = |name: &str| {
            js_sys::Reflect::get(theme, &JsValue::from_str(name))
                .ok()?
                .as_string()
        };
        let theme = Theme::of(colour);
        self.painters()
            .for_each(|painter| painter.theme = theme.clone());
        self.draw();
    }

    /// What the dimensions of the next job are called, by the paths of their fields; what is not named has the form's English label. `comma` is whether
    /// numbers have a decimal comma: those of the next job, and the scale's.
    #[wasm_bindgen(js_name = setLabels)]
    pub fn set_labels(&mut self, fields: Vec<String>, labels: Vec<String>, comma: bool) {
        self.labels = fields.into_iter().zip(labels).collect();
        if std::mem::replace(&mut self.comma, comma) != comma {
            self.draw();
        }
    }

    /// Which cycle of the next set-up is in hand, by its place in the list: its dimensions are drawn, and the others are pale.
    #[wasm_bindgen(js_name = setHand)]
    pub fn set_hand(&mut self, index: usize) {
        self.hand = index;
    }

    /// Shows a coded job. One that has errors leaves the picture as it is and gives `false`.
    #[wasm_bindgen(js_name = showCoded)]
    pub fn show(&mut self, codes: &[f64], text: &str) -> bool {
        let Some(last) = crate::wasm::planned(codes, text) else {
            return false;
        };
        let cycle = |view: &Self| view.held().map(|held| held.last.planned.job.def.key);
        let before = cycle(self);
        self.shown = Some(self.build(last));
        self.read_measured();
        if before != cycle(self) && !self.held {
            self.place();
        } else if !self.suits() {
            self.refit();
        }
        self.draw();
        true
    }

    /// Shows a job as a small picture: isometric, without axes, numbers and handles.
    #[wasm_bindgen(js_name = showSmallCoded)]
    pub fn show_small(&mut self, codes: &[f64], text: &str) -> bool {
        self.painter.small = true;
        self.projection = Projection::Isometric;
        self.show(codes, text)
    }

    /// Looks from `top`, `front`, `side` or `isometric`.
    pub fn look(&mut self, from: &str) {
        let Some(projection) = Projection::named(from) else {
            return;
        };
        self.projection = projection;
        self.rebuild();
        self.fit();
    }

    /// Draws the virtual part's deviations, and measured points, so many times as large. The picture stays where it is.
    pub fn magnify(&mut self, times: f64) {
        let times = if times.is_finite() {
            crate::num::within(times, 1.0, 1000.0)
        } else {
            1.0
        };
        if self.magnified != times {
            self.magnified = times;
            self.rebuild();
            self.draw();
        }
    }

    /// Fits the whole scene into the canvas.
    pub fn fit(&mut self) {
        self.place();
        self.draw();
    }

    fn place(&mut self) {
        if let Some(shown) = &self.shown {
            let (size, scene) = (self.camera.size, &shown.scene);
            self.camera = if self.painter.small {
                Camera::fit(size, scene.bounds(), SMALL_MARGIN)
            } else {
                Camera::whole(size, scene)
            };
        }
        self.moved = false;
    }

    /// While pinned, neither another job nor another size of the canvas moves the picture: a dragged handle stays under the
    /// pointer. Let go, it is not fitted again until the next job or size.
    pub fn pin(&mut self, on: bool) {
        self.held = on;
    }

    /// Closer by `factor` about a pixel.
    pub fn zoom(&mut self, factor: f64, x: f64, y: f64) {
        if factor.is_finite() && factor > 0.0 {
            self.camera.zoom(factor, Vec2::new(x, y));
            self.moved = true;
            self.draw();
        }
    }

    /// Drags the picture.
    pub fn pan(&mut self, dx: f64, dy: f64) {
        self.camera.pan(Vec2::new(dx, dy));
        self.moved = true;
        self.draw();
    }

    /// The move at a pixel.
    pub fn pick(&self, x: f64, y: f64) -> Option<usize> {
        let shown = self.shown.as_ref()?;
        shown
            .scene
            .pick(self.camera.spot(Vec2::new(x, y)), 8.0 / self.camera.scale)
    }

    /// Lights up a move, or none.
    pub fn highlight(&mut self, index: Option<usize>) {
        if self.highlight != index || self.part != 1.0 {
            self.highlight = index;
            self.part = 1.0;
            self.light();
        }
    }

    /// Lights up a move that is done to this fraction, 0 to 1: the ball is on its way.
    pub fn play(&mut self, index: usize, part: f64) {
        self.highlight = Some(index);
        self.part = if part.is_finite() {
            crate::num::within(part, 0.0, 1.0)
        } else {
            1.0
        };
        self.light();
    }

    /// Whether the picture has so many lines that feeds are drawn without dashes.
    #[wasm_bindgen(js_name = isLong)]
    pub fn is_long(&self) -> bool {
        self.shown
            .as_ref()
            .is_some_and(|shown| is_long(&shown.scene))
    }

    /// How long each move takes, seconds; rapids at the catalog's `rapidRate`. Of a job their sum is the plan's time; of a program NaN if not known.
    pub fn times(&self) -> Vec<f64> {
        match self.shown.as_ref().map(|shown| &shown.content) {
            Some(Content::Job(held)) => job::minutes(&held.last.planned)
                .into_iter()
                .map(|m| m * 60.0)
                .collect(),
            Some(Content::Program(path, _)) => moves_of(path).seconds(),
            None => Vec::new(),
        }
    }

    /// Lights up the dimension of a field, by its path in the job, or none. `*` draws every height, and lights none.
    pub fn focus(&mut self, field: Option<String>) {
        if self.field != field {
            self.field = field;
            self.draw();
        }
    }

    /// Draws the ball centres that a machine measured of the job that is shown: a text in any form that `evaluate` reads. What cannot be read, results
    /// without points, and an empty text, draw none.
    pub fn measure(&mut self, text: &str) {
        if self.measured_text != text {
            text.clone_into(&mut self.measured_text);
            self.read_measured();
            self.draw();
        }
    }

    /// The view that a click on the drawn axes asks for: along the axis at the pixel, `isometric` beside them; nothing elsewhere.
    #[wasm_bindgen(js_name = axisAt)]
    pub fn axis_at(&self, x: f64, y: f64) -> Option<String> {
        let scene = &self.shown.as_ref()?.scene;
        axis_at(scene, &self.camera, Vec2::new(x, y))
            .filter(|_| !self.painter.small)
            .map(str::to_owned)
    }

    /// The job that is shown as an SVG, looked at from the same side, with the names of its dimensions as they are shown; deviations as large as they
    /// are. `undefined` if no job is shown.
    pub fn svg(&self, title: &str) -> Option<String> {
        let held = self.held()?;
        let picture = held
            .last
            .planned
            .picture(self.projection, 1.0, Some(self.hand));
        Some(crate::view::svg(
            &picture.scene,
            &Legend {
                title,
                names: &held.names,
                deviates: picture.deviates,
            },
        ))
    }
}

impl View {
    /// Shows the moves of a program, and the part that it is run on.
    fn show_moves(&mut self, path: Toolpath, part: Option<Feature>) {
        // A picture has one system.
        self.shown = Some(self.of_program(Rc::new(path.in_one_system()), part));
        self.measured.clear();
        self.fit();
    }

    /// Fits the picture, unless the user has moved it or holds something in it.
    fn refit(&mut self) {
        if !self.moved && !self.held {
            self.place();
        }
    }

    /// Whether the current camera still frames the scene well: complete, with margin, centred and not too small. What is edited then
    /// keeps its scale.
    fn suits(&self) -> bool {
        let Some(shown) = &self.shown else {
            return false;
        };
        let margin = if self.painter.small {
            SMALL_MARGIN
        } else {
            self.camera.margin(&shown.scene)
        };
        let [low, high] = shown.scene.bounds();
        let fitted = Camera::fit(self.camera.size, [low, high], margin);
        let (low, high, size) = (
            self.camera.pixel(low),
            self.camera.pixel(high),
            self.camera.size,
        );
        let room = low.x.min(high.y).min(size.x - high.x).min(size.y - low.y);
        let off = fitted.middle.distance(self.camera.middle) * self.camera.scale;
        room > margin * 0.6
            && fitted.scale < self.camera.scale * 1.3
            && off < size.min_element() * 0.2
    }

    /// The scene again, of what is shown.
    fn rebuild(&mut self) {
        self.shown = self.shown.take().map(|shown| match shown.content {
            Content::Job(held) => self.build(held.last),
            Content::Program(path, part) => self.of_program(path, part),
        });
    }

    fn build(&self, last: Rc<Last>) -> Shown {
        let job::Picture {
            mut scene,
            mut names,
            offset,
            deviates,
        } = last
            .planned
            .picture(self.projection, self.magnified, Some(self.hand));
        if !self.labels.is_empty() {
            let label = |field: &str| {
                self.labels
                    .iter()
                    .find(|(known, _)| known == field)
                    .map(|(_, label)| label.as_str())
            };
            names = last.planned.in_hand(self.hand).names(&scene, label);
        }
        if self.comma {
            names
                .iter_mut()
                .for_each(|(_, name)| *name = name.replace('.', ","));
        }
        scene.name(&names);
        let plane = last.planned.job.setup.plane;
        Shown {
            scene,
            content: Content::Job(Box::new(Held {
                deviates,
                plane,
                names,
                offset_name: offset,
                last,
            })),
        }
    }

    fn of_program(&self, path: Rc<Toolpath>, part: Option<Feature>) -> Shown {
        let mut scene = program::scene(&moves_of(&path), self.projection);
        if let Some(part) = &part {
            let seen = part.picture(self.projection).scene;
            (scene.walls, scene.tops, scene.blocks, scene.material) =
                (seen.walls, seen.tops, seen.blocks, seen.material);
        }
        Shown {
            scene,
            content: Content::Program(path, part),
        }
    }

    /// The job that is shown, where it is one.
    fn held(&self) -> Option<&Held> {
        match &self.shown.as_ref()?.content {
            Content::Job(held) => Some(held),
            Content::Program(..) => None,
        }
    }

    /// Reads what was measured for the job that is shown.
    fn read_measured(&mut self) {
        let held = self
            .held()
            .filter(|_| !self.measured_text.trim().is_empty());
        self.measured = held.map_or_else(Vec::new, |held| {
            crate::job::points(&held.last.planned, &self.measured_text)
        });
    }

    fn draw(&self) {
        match &self.due {
            Some(due) => due.set(Due::All),
            None => self.paint_all(),
        }
    }

    /// Draws the move that is pointed at: on its own canvas, or with everything else.
    fn light(&self) {
        match &self.due {
            _ if self.over.is_none() => self.draw(),
            Some(due) if due.get() == Due::All => {}
            Some(due) => due.set(Due::Lit),
            None => self.paint_lit(),
        }
    }

    fn paint_all(&self) {
        if let Some(shown) = &self.shown {
            let held = self.held();
            // Each from where its touch should have met the part.
            let seen = |held: &Held, (k, p): &(usize, Vec3)| {
                let real = self
                    .projection
                    .place(held.plane, *p * held.last.planned.job.scale);
                let nominal = shown.scene.touches.get(*k).map_or(real, |touch| touch.ball);
                nominal.lerp_monotonic(real, self.magnified)
            };
            let points = self.measured.iter();
            let measured: Vec<Vec2> =
                held.map_or_else(Vec::new, |held| points.map(|p| seen(held, p)).collect());
            let marks = Marks {
                measured: &measured,
                highlight: self.highlight.filter(|_| self.over.is_none()),
                part: self.part,
                deviates: shown.deviates(),
                field: self.field.as_deref(),
                names: held.map_or(&[], |held| &held.names),
                origin: held.map_or("", |held| &held.offset_name),
                comma: self.comma,
            };
            self.painter.draw(&shown.scene, &self.camera, &marks);
            self.paint_lit();
        }
    }

    fn paint_lit(&self) {
        let Some(over) = &self.over else { return };
        over.clear(&self.camera);
        if let (Some(shown), Some(index)) = (&self.shown, self.highlight) {
            over.draw_lit(&shown.scene, &self.camera, index, self.part);
        }
    }

    fn painters(&mut self) -> impl Iterator<Item = &mut Painter> {
        std::iter::once(&mut self.painter).chain(&mut self.over)
    }
}
