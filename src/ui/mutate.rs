//! Variations of the scene, side by side over the picture, of which one becomes the scene.
//!
//! In: the scene, how far to go, what must stay. Out: small pictures to draw, and the chosen variation.

use egui::{
    Checkbox, Color32, CornerRadius, Margin, Rect, Response, Sense, Stroke, StrokeKind, Ui,
    UiBuilder, WidgetInfo, accesskit::Role, vec2,
};

use super::{
    display_inputs::SmallTextures,
    icon::{Icon, icon_button},
    rects::Rects,
    small_picture::{SMALL_PICTURE_PX, SmallPicture, SmallPictureId},
    theme,
    widgets::Help as _,
};
use crate::{
    fractal::surprise::is_worth_seeing,
    scene::{
        IntegratorKind, IntegratorSettings, Quality, Scene,
        variation::{Locks, vary},
    },
};

/// Variations in a row, and rows.
const COLUMNS: usize = 3;
/// The place of the scene itself: the middle.
const MIDDLE: usize = COLUMNS * COLUMNS / 2;
/// Gap between the pictures, in points.
const GAP: f32 = 8.0;
/// Height of the controls below the pictures, in points.
const CONTROLS: f32 = 92.0;
/// Minimum width of the controls where the view has room for it, in points.
const CONTROLS_WIDTH: f32 = 340.0;
/// What stands in the place of a picture that is not drawn yet.
const DRAWING: &str = "Drawing…";
/// Samples of a pixel of the small pictures.
const SAMPLES: u32 = 2;
/// Variations that are looked at for one that shows something, until any will do.
const MAX_TRIES: u64 = 5;

/// The variations, while they are shown.
#[derive(Debug)]
pub struct Mutate {
    is_open: bool,
    /// How far variations go, 0 to 1.
    amount: f64,
    locks: Locks,
    /// The scene, the amount and the locks that the variations are of.
    made_of: Option<(Scene, f64, Locks)>,
    /// True if variations must show something, because the scene itself does.
    is_judged: bool,
    variations: Vec<SmallPicture>,
    /// The number of the next variation, which no other has had.
    next: u64,
}

impl Default for Mutate {
    fn default() -> Self {
        Self {
            is_open: false,
            amount: 0.4,
            locks: Locks { view: true, ..Locks::default() },
            made_of: None,
            is_judged: false,
            variations: Vec::new(),
            next: 0,
        }
    }
}

impl Mutate {
    /// Shows the variations, or puts them away.
    pub fn toggle(&mut self) {
        self.is_open = !self.is_open;
        self.forget();
    }

    /// True while variations are shown.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// The pictures to draw: the scene itself, with which all others are compared, then its variations.
    ///
    /// None before the scene's own is made: variations would be drawn first.
    pub fn small_pictures(&self) -> impl Iterator<Item = &SmallPicture> + Clone {
        let made = if self.variations.len() > MIDDLE { &self.variations[..] } else { &[] };
        let variations = made.iter().enumerate();
        let others = variations.filter(|&(place, _)| place != MIDDLE).map(|(_, it)| it);
        self.variations.get(MIDDLE).into_iter().chain(others)
    }

    fn forget(&mut self) {
        self.made_of = None;
        self.variations.clear();
    }

    /// Makes one variation a frame, until all are there. Returns whether more are to come.
    fn make(&mut self, scene: &Scene) -> bool {
        let is_current = self.made_of.as_ref().is_some_and(|(made_of, amount, locks)| {
            made_of == scene && (*amount, *locks) == (self.amount, self.locks)
        });
        if !is_current {
            self.variations.clear();
            self.made_of = Some((scene.clone(), self.amount, self.locks));
            // Close views cannot be judged from the whole set's distance.
            self.is_judged = is_worth_seeing(scene);
        }
        let made = self.variations.len();
        if made < COLUMNS * COLUMNS {
            let varied = if made == MIDDLE { scene.clone() } else { self.variation(scene) };
            let quality = Quality { samples: SAMPLES, ..scene.quality.clone() };
            // A few light paths would be noise.
            let integrator =
                IntegratorSettings { kind: IntegratorKind::Direct, ..scene.integrator.clone() };
            let id = SmallPictureId { owner: "mutations", number: self.next };
            self.next += 1;
            self.variations
                .push(SmallPicture { id, scene: Scene { quality, integrator, ..varied } });
        }
        self.variations.len() < COLUMNS * COLUMNS
    }

    /// A variation that shows something, if the scene itself does.
    fn variation(&mut self, scene: &Scene) -> Scene {
        let mut varied = scene.clone();
        for _ in 0..MAX_TRIES {
            varied = vary(scene, self.amount, self.locks, self.next);
            if !self.is_judged || is_worth_seeing(&varied) {
                break;
            }
            self.next += 1;
        }
        varied
    }

    /// Shows the variations over the picture in `view`, and returns the chosen one.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        view: Rect,
        scene: &Scene,
        textures: &SmallTextures,
        rects: &mut Rects,
    ) -> Option<Scene> {
        if !self.is_open {
            return None;
        }
        if self.make(scene) {
            ui.ctx().request_repaint();
        }
        let backdrop = ui.interact(view, ui.scope_id().with("variations"), Sense::click_and_drag());
        rects.record("variations", &backdrop);
        ui.painter().rect_filled(view, 0.0, theme::BACKGROUND.gamma_multiply(0.82));
        let (pictures, controls) =
            view.split_top_bottom_at_y((view.bottom() - CONTROLS).max(view.center().y));
        let grid = grid(pictures.shrink(GAP));
        let mut chosen = None;
        for (index, variation) in self.variations.iter().enumerate() {
            let rect = cell(grid, index);
            let response = respond(ui, rect, index);
            paint(ui, &response, rect, textures, variation, index);
            if response.clicked() && index != MIDDLE {
                let Scene { quality, integrator, .. } = scene.clone();
                chosen = Some(Scene { quality, integrator, ..variation.scene.clone() });
            }
        }
        let width = grid.width().max(CONTROLS_WIDTH.min(view.width() - 2.0 * GAP));
        let controls = Rect::from_center_size(controls.center(), vec2(width, controls.height()));
        ui.scope_builder(UiBuilder::new().max_rect(controls), |ui| self.controls(ui, rects));
        chosen
    }

    fn controls(&mut self, ui: &mut Ui, rects: &mut Rects) {
        egui::Frame::new().inner_margin(Margin::symmetric(0, 4)).show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.label("How different");
                let amount = egui::Slider::new(&mut self.amount, 0.05..=1.0).show_value(false);
                let amount = ui
                    .add(amount)
                    .help("Farther right, the eight differ more from the middle")
                    .accessible_name("How different");
                rects.record("how different", &amount);
                let more = ui.button("Eight more").help("Other variations of the middle");
                if more.clicked() {
                    self.forget();
                }
                let close = icon_button(ui, Icon::Cross, "Close the variations", "Close (M)");
                rects.record("close variations", &close);
                if close.clicked() {
                    self.toggle();
                }
            });
            ui.horizontal_wrapped(|ui| {
                ui.label("Keep");
                let Locks { shape, colors, light, view } = &mut self.locks;
                for (name, lock, hover) in [
                    ("Shape", shape, "All keep the form of the middle"),
                    ("Colours", colors, "All keep the colours of the middle"),
                    ("Light", light, "All keep the lights and the background of the middle"),
                    ("View", view, "All are seen from where the middle is"),
                ] {
                    let response = ui.add(Checkbox::new(lock, name)).help(hover);
                    response.accessible_name(format!("Keep: {name}"));
                }
            });
        });
    }
}

/// Where the pictures are in `area`.
fn grid(area: Rect) -> Rect {
    let [width, height] = SMALL_PICTURE_PX.map(|side| side as f32);
    let count = COLUMNS as f32;
    let gaps = vec2(GAP, GAP) * (count - 1.0);
    let room = (area.size() - gaps) / count;
    // Enlarged, the pictures would show their pixels.
    let scale = (room.x / width).min(room.y / height).clamp(0.1, 1.6);
    Rect::from_center_size(area.center(), vec2(width, height) * scale * count + gaps)
}

/// Where the picture of number `index` is in `grid`.
fn cell(grid: Rect, index: usize) -> Rect {
    let step = (grid.size() + vec2(GAP, GAP)) / COLUMNS as f32;
    let [column, row] = [index % COLUMNS, index / COLUMNS].map(|at| at as f32);
    Rect::from_min_size(grid.min + vec2(column, row) * step, step - vec2(GAP, GAP))
}

fn respond(ui: &Ui, rect: Rect, index: usize) -> Response {
    let response = ui.interact(rect, ui.scope_id().with(("variation", index)), Sense::click());
    let (name, hover) = match index {
        MIDDLE => ("The scene itself".to_owned(), "The scene as it is"),
        _ => {
            let number = index + usize::from(index < MIDDLE);
            (format!("Variation {number}"), "Take this one; others around it follow")
        }
    };
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    response.help(hover)
}

fn paint(
    ui: &Ui,
    response: &Response,
    rect: Rect,
    textures: &SmallTextures,
    variation: &SmallPicture,
    index: usize,
) {
    let painter = ui.painter();
    let corners = CornerRadius::same(theme::RADIUS);
    match textures.by_id.get(&variation.id) {
        Some(picture) => picture.paint(painter, rect, corners),
        None => {
            painter.rect_filled(rect, corners, theme::PANEL);
            let font = egui::FontId::proportional(12.0);
            let center = egui::Align2::CENTER_CENTER;
            painter.text(rect.center(), center, DRAWING, font, theme::TEXT_DIM);
        }
    }
    let is_lit = response.hovered() || response.has_focus();
    let edge = match (index == MIDDLE, is_lit) {
        (true, _) => Stroke::new(2.0, theme::ACCENT),
        (_, true) => Stroke::new(2.0, Color32::WHITE),
        _ => Stroke::new(1.0, Color32::from_white_alpha(40)),
    };
    painter.rect_stroke(rect, corners, edge, StrokeKind::Inside);
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    #[test]
    fn nine_cells_fit_every_view_and_do_not_overlap() {
        for [width, height] in [[976.0, 600.0], [390.0, 500.0], [540.0, 270.0], [200.0, 200.0]] {
            let area = Rect::from_min_size(pos2(5.0, 7.0), vec2(width, height));
            let grid = grid(area);
            let cells: Vec<Rect> = (0..9).map(|index| cell(grid, index)).collect();
            assert!((cells[8].max - grid.max).length() < 0.1);
            for (i, one) in cells.iter().enumerate() {
                assert!(area.expand(0.1).contains_rect(*one), "{one:?} in {area:?}");
                assert!(cells[..i].iter().all(|other| !other.shrink(0.1).intersects(*one)));
            }
            assert!((cells[MIDDLE].center() - area.center()).length() < 0.1);
        }
    }
}
