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
    /// Canvas of its own for the highlighted move, if there is one.
    over: Option<Painter>,
    projection: Projection,
    camera: Camera,
    shown: Option<ShownScene>,
    highlight: Option<usize>,
    /// Fraction of the highlighted move that is done, 0 to 1.
    part: f64,
    /// Path of the focused field.
    field: Option<String>,
    /// Magnification of deviations.
    magnified: f64,
    /// Values measured on a machine, as text.
    measured_text: String,
    /// Measured ball centres of this job, each with its touch, in the job's units.
    measured: Vec<(usize, Vec3)>,
    /// Labels of dimensions in another language, by the paths of their fields.
    labels: Vec<(String, String)>,
    comma: bool,
    /// Whether the user has zoomed or panned, so that a new job must not fit the picture again.
    moved: bool,
    /// Whether the picture must stay in place, since something in it is dragged.
    held: bool,
    /// The dragged end of a dimension line.
    end: Option<dimensions::End>,
    /// Index of the active cycle of a set-up.
    active_cycle: usize,
    /// Pending changes for `render`; `None` if every change is drawn immediately.
    due: Option<Cell<Redraw>>,
}

/// Changes since the picture was drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Redraw {
    #[default]
    Nothing,
    /// The highlighted move, which is drawn on its own canvas.
    Lit,
    All,
}

#[derive(Debug)]
struct ShownScene {
    scene: Scene,
    content: Content,
}

impl ShownScene {
    /// Whether the part is displaced, or has other sizes.
    fn deviates(&self) -> bool {
        match &self.content {
            Content::Job(held) => held.deviates,
            Content::Program(_, part) => part.as_ref().is_some_and(Feature::deviates),
        }
    }
}

/// Moves of a program for its picture.
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
    Job(Box<JobContent>),
    Program(Rc<Toolpath>, Option<Feature>),
}

/// The shown job.
#[derive(Debug)]
struct JobContent {
    last: Rc<Last>,
    deviates: bool,
    plane: Plane,
    /// Names of the dimensions, by the paths of their fields.
    names: Vec<(&'static str, String)>,
    /// Name of the work origin.
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
            active_cycle: 0,
            due: None,
        })
    }

    /// Adds a transparent canvas of the same size above the other one: the highlighted move is drawn there, and the picture beneath is not redrawn.
    #[wasm_bindgen(js_name = setOverlay)]
    pub fn set_overlay(&mut self, canvas: web_sys::HtmlCanvasElement) {
        self.over = Painter::new(canvas);
        if let Some(over) = &mut self.over {
            over.theme = self.painter.theme.clone();
            over.resize(self.camera.size, self.painter.ratio);
        }
        self.draw();
    }

    /// Shows or hides the handles: nothing can be gripped on paper, and the virtual part's handles come with its group in the form.
    pub fn grips(&mut self, on: bool) {
        if self.painter.still == on {
            self.painter.still = !on;
            self.draw();
        }
    }

    /// Collects changes until `render` instead of drawing each immediately.
    pub fn defer(&mut self) {
        self.due.get_or_insert_default();
    }

    /// Draws the changes since the last call.
    pub fn render(&self) {
        match self
            .due
            .as_ref()
            .map_or(Redraw::Nothing, |due| due.replace(Redraw::Nothing))
        {
            Redraw::Nothing => {}
            Redraw::Lit => self.paint_lit(),
            Redraw::All => self.paint_all(),
        }
    }

    /// Sets the size of the canvas in CSS pixels; `ratio` is the number of device pixels in one.
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

    /// Sets the names of the next job's dimensions, by the paths of their fields; others have the form's English label. `comma`: whether numbers have a decimal
    /// comma, those of the next job and of the scale.
    #[wasm_bindgen(js_name = setLabels)]
    pub fn set_labels(&mut self, fields: Vec<String>, labels: Vec<String>, comma: bool) {
        self.labels = fields.into_iter().zip(labels).collect();
        if std::mem::replace(&mut self.comma, comma) != comma {
            self.draw();
        }
    }

    /// Sets the active cycle of the next set-up by its index: its dimensions are drawn, and the other cycles are pale.
    #[wasm_bindgen(js_name = setHand)]
    pub fn set_hand(&mut self, index: usize) {
        self.active_cycle = index;
    }

    /// Shows an encoded job. One with errors leaves the picture unchanged and returns `false`.
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

    /// Sets the view: `top`, `front`, `side` or `isometric`.
    pub fn look(&mut self, from: &str) {
        let Some(projection) = Projection::named(from) else {
            return;
        };
        self.projection = projection;
        self.rebuild();
        self.fit();
    }

    /// Magnifies the virtual part's deviations and the measured points. The picture stays in place.
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

    /// While pinned, neither another job nor another size of the canvas moves the picture: a dragged handle stays under the pointer. Afterwards it is not
    /// fitted again until the next job or size.
    pub fn pin(&mut self, on: bool) {
        self.held = on;
    }

    /// Zooms in by `factor` about a pixel.
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

    /// Highlights a move, or removes the highlight.
    pub fn highlight(&mut self, index: Option<usize>) {
        if self.highlight != index || self.part != 1.0 {
            self.highlight = index;
            self.part = 1.0;
            self.light();
        }
    }

    /// Highlights a move with the ball at this fraction of it, 0 to 1.
    pub fn play(&mut self, index: usize, part: f64) {
        self.highlight = Some(index);
        self.part = if part.is_finite() {
            crate::num::within(part, 0.0, 1.0)
        } else {
            1.0
        };
        self.light();
    }

    /// Whether the picture has so many lines that feeds are drawn solid.
    #[wasm_bindgen(js_name = isLong)]
    pub fn is_long(&self) -> bool {
        self.shown
            .as_ref()
            .is_some_and(|shown| is_long(&shown.scene))
    }

    /// Time of each move, seconds; rapids at the catalog's `rapidRate`. Their sum is the plan's time for a job; for a program NaN if unknown.
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

    /// Highlights the dimension of a field, by its path in the job, or removes the highlight. `*` draws every height without a highlight.
    pub fn focus(&mut self, field: Option<String>) {
        if self.field != field {
            self.field = field;
            self.draw();
        }
    }

    /// Draws ball centres that a machine measured for the shown job: a text in any form that `evaluate` reads. An unreadable text, results without points, and
    /// an empty text draw none.
    pub fn measure(&mut self, text: &str) {
        if self.measured_text != text {
            text.clone_into(&mut self.measured_text);
            self.read_measured();
            self.draw();
        }
    }

    /// View for a click on the drawn axes: along the axis at the pixel, `isometric` beside them; `undefined` elsewhere.
    #[wasm_bindgen(js_name = axisAt)]
    pub fn axis_at(&self, x: f64, y: f64) -> Option<String> {
        let scene = &self.shown.as_ref()?.scene;
        axis_at(scene, &self.camera, Vec2::new(x, y))
            .filter(|_| !self.painter.small)
            .map(str::to_owned)
    }

    /// The shown job as an SVG from the current view, with the shown names of its dimensions; deviations are not magnified. `undefined` if no job is shown.
    pub fn svg(&self, title: &str) -> Option<String> {
        let held = self.held()?;
        let picture = held
            .last
            .planned
            .picture(self.projection, 1.0, Some(self.active_cycle));
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
    /// Shows the moves of a program, and the part of its run.
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

    /// Whether the current camera still frames the scene well: complete, with margin, centred and not too small. During edits it then keeps its scale.
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

    /// Rebuilds the scene of the shown content.
    fn rebuild(&mut self) {
        self.shown = self.shown.take().map(|shown| match shown.content {
            Content::Job(held) => self.build(held.last),
            Content::Program(path, part) => self.of_program(path, part),
        });
    }

    fn build(&self, last: Rc<Last>) -> ShownScene {
        let job::Picture {
            mut scene,
            mut names,
            offset,
            deviates,
        } = last
            .planned
            .picture(self.projection, self.magnified, Some(self.active_cycle));
        if !self.labels.is_empty() {
            let label = |field: &str| {
                self.labels
                    .iter()
                    .find(|(known, _)| known == field)
                    .map(|(_, label)| label.as_str())
            };
            names = last.planned.in_hand(self.active_cycle).names(&scene, label);
        }
        if self.comma {
            names
                .iter_mut()
                .for_each(|(_, name)| *name = name.replace('.', ","));
        }
        scene.name(&names);
        let plane = last.planned.job.setup.plane;
        ShownScene {
            scene,
            content: Content::Job(Box::new(JobContent {
                deviates,
                plane,
                names,
                offset_name: offset,
                last,
            })),
        }
    }

    fn of_program(&self, path: Rc<Toolpath>, part: Option<Feature>) -> ShownScene {
        let mut scene = program::scene(&moves_of(&path), self.projection);
        if let Some(part) = &part {
            let seen = part.picture(self.projection).scene;
            (scene.walls, scene.tops, scene.blocks, scene.material) =
                (seen.walls, seen.tops, seen.blocks, seen.material);
        }
        ShownScene {
            scene,
            content: Content::Program(path, part),
        }
    }

    /// The shown job, if there is one.
    fn held(&self) -> Option<&JobContent> {
        match &self.shown.as_ref()?.content {
            Content::Job(held) => Some(held),
            Content::Program(..) => None,
        }
    }

    /// Reads the measured values for the shown job.
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
            Some(due) => due.set(Redraw::All),
            None => self.paint_all(),
        }
    }

    /// Draws the highlighted move: on its own canvas, or with everything else.
    fn light(&self) {
        match &self.due {
            _ if self.over.is_none() => self.draw(),
            Some(due) if due.get() == Redraw::All => {}
            Some(due) => due.set(Redraw::Lit),
            None => self.paint_lit(),
        }
    }

    fn paint_all(&self) {
        if let Some(shown) = &self.shown {
            let held = self.held();
            // Each from the position at which its touch should have triggered.
            let seen = |held: &JobContent, (k, p): &(usize, Vec3)| {
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
