//! Buttons and captions over the picture.

use egui::{
    Align2, Button, FontId, InnerResponse, Label, Margin, Pos2, Rect, Response, Sense, Stroke,
    StrokeKind, Ui, vec2,
};

use super::{
    icon::{Icon, icon_button},
    theme,
    widgets::Help as _,
};

/// Distance between buttons, and to the picture's edges, in points.
pub const GAP: f32 = 10.0;

/// Width and height of a button over the picture, in points.
pub fn button_side(ui: &Ui) -> f32 {
    ui.spacing().interact_size.y.max(34.0)
}

/// An icon button over the picture; its name is for screen readers.
pub fn button(ui: &mut Ui, at: Pos2, icon: Icon, (name, hover): (&str, &str)) -> Response {
    let at = Rect::from_min_size(at, vec2(1.0, 1.0) * button_side(ui));
    ui.painter().rect_filled(at, theme::RADIUS, theme::PANEL.gamma_multiply(0.8));
    ui.put(at, |ui: &mut Ui| icon_button(ui, icon, name, hover))
}

/// Width of a picture, in points, from which on its buttons have words, and captions are beside the row of buttons.
/// In a narrower picture captions are above the row.
const WIDE_FROM: f32 = 800.0;

/// Where captions can be: the picture, and the part of it on the right of the row of buttons.
#[derive(Clone, Copy)]
pub struct CaptionArea {
    view: Rect,
    beside: Rect,
    /// Height at the lower edge that another caption takes, in points.
    taken: f32,
}

impl CaptionArea {
    /// The area for captions of the picture in `view`, whose row of buttons is in `buttons`.
    pub fn new(view: Rect, buttons: Rect) -> Self {
        let left = if view.width() < WIDE_FROM { view.left() } else { buttons.right() };
        let beside = Rect::from_min_max(Pos2::new(left, view.top()), view.max);
        Self { view, beside, taken: 0.0 }
    }

    /// The area above a caption that is shown at the lower edge.
    pub fn above(self, shown: &Response) -> Self {
        Self { taken: self.view.bottom() - shown.rect.top(), ..self }
    }

    /// Width of the part beside the buttons, in points.
    pub fn width(self) -> f32 {
        self.beside.width()
    }

    /// The area of a caption at the lower edge of the picture, where neither a button nor another caption is.
    pub fn lowest(self, ui: &Ui, id: &str) -> egui::Area {
        // In a narrow picture the buttons of the lower left corner would lie under the text.
        let is_narrow = self.view.width() < WIDE_FROM;
        let edge = if is_narrow {
            row_height(has_words(ui, self.view), ui) + 2.0 * GAP
        } else {
            CAPTION_GAP
        };
        let at = self.view.center_bottom() - vec2(0.0, edge.max(self.taken + 0.5 * GAP));
        let area = egui::Area::new(egui::Id::unique(id)).fixed_pos(at);
        area.pivot(Align2::CENTER_BOTTOM).constrain_to(self.beside)
    }

    /// The area of captions that leave the middle free: in a low picture it is at the upper edge.
    fn clear_caption(self, ui: &Ui) -> egui::Area {
        if self.view.height() >= LOW_PICTURE {
            return self.lowest(ui, CAPTION);
        }
        let at = self.view.center_top() + vec2(0.0, 0.5 * GAP);
        let area = egui::Area::new(egui::Id::unique(CAPTION)).fixed_pos(at);
        area.pivot(Align2::CENTER_TOP).constrain_to(self.view)
    }
}

/// Height of a picture, in points, below which a caption above the row of buttons would cover the set.
pub const LOW_PICTURE: f32 = 420.0;
/// Distance of captions from the lower edge of a wide picture, in points.
const CAPTION_GAP: f32 = 14.0;

/// A line of text at the lower edge of the picture, which does not take the pointer.
pub fn caption(ui: &Ui, area: CaptionArea, text: &str) -> Response {
    let shown = area.lowest(ui, CAPTION).interactable(false);
    framed(ui, shown, area.width(), |ui| line(ui, text)).response
}

/// As [`caption`], at the upper edge of a low picture, where nothing of the set is.
pub fn clear_caption(ui: &Ui, area: CaptionArea, text: &str) -> Response {
    let shown = area.clear_caption(ui).interactable(false);
    framed(ui, shown, area.width(), |ui| line(ui, text)).response
}

/// As [`clear_caption`], with a button before the text. Returns the response of both, and that of the button.
pub fn caption_with_button(
    ui: &Ui,
    area: CaptionArea,
    text: &str,
    (name, hover): (&str, &str),
) -> (Response, Response) {
    let shown = framed(ui, area.clear_caption(ui), area.width(), |ui| {
        let row = ui.horizontal(|ui| {
            let button = Button::new(name).min_size(ui.spacing().interact_size);
            let button = ui.add(button).help(hover);
            line(ui, text);
            button
        });
        row.inner
    });
    (shown.response, shown.inner)
}

const CAPTION: &str = "caption";

fn line(ui: &mut Ui, text: &str) {
    ui.add(Label::new(text).selectable(false).wrap());
}

/// Shows `contents` in a frame, in a room of this width.
pub fn framed<R>(
    ui: &Ui,
    area: egui::Area,
    room: f32,
    contents: impl FnOnce(&mut Ui) -> R,
) -> InnerResponse<R> {
    area.show(ui.ctx(), |ui| {
        let frame = egui::Frame::new().fill(theme::PANEL.gamma_multiply(0.9)).corner_radius(8);
        let frame = frame.inner_margin(Margin::symmetric(12, 6));
        let show = |ui: &mut Ui| {
            ui.set_max_width((room - 48.0).max(80.0));
            contents(ui)
        };
        frame.show(ui, show).inner
    })
}

/// Marks a button whose function is on.
pub fn mark(ui: &Ui, button: &Response) {
    let edge = Stroke::new(1.0, theme::ACCENT);
    ui.painter().rect_stroke(button.rect, theme::RADIUS, edge, StrokeKind::Inside);
}

/// A button of the row in the picture's lower left corner.
#[derive(Clone, Copy)]
pub struct RowButton {
    /// Its icon.
    pub icon: Icon,
    /// Its name for screen readers, and its explanation.
    pub name_and_hover: (&'static str, &'static str),
    /// The word below the icon: on touch screens, where nothing explains it, and where there is room.
    pub word: &'static str,
}

/// Width of a button with a word, with the gap to the next, in points.
const WORD_STEP: f32 = 54.0;
/// Minimum number of buttons beside the middle of a low picture.
const MIN_BESIDE: usize = 4;
/// Height of a word, in points.
const WORD_HEIGHT: f32 = 16.0;

/// Height of a row of buttons over the picture, with words or without, in points.
fn row_height(has_words: bool, ui: &Ui) -> f32 {
    button_side(ui) + if has_words { WORD_HEIGHT } else { 0.0 }
}

/// Whether the buttons over the picture in `rect` have words: on touch screens, and in wide pictures.
pub fn has_words(ui: &Ui, rect: Rect) -> bool {
    theme::has_touch_rows(ui) || rect.width() >= WIDE_FROM
}

/// A row of buttons in the picture's lower left corner; with words as [`has_words`] says.
pub struct ButtonRow {
    next: Pos2,
    has_words: bool,
}

impl ButtonRow {
    /// An empty row over the picture in `rect`.
    pub fn new(ui: &Ui, rect: Rect) -> Self {
        let has_words = has_words(ui, rect);
        let corner = if has_words { vec2(2.0, -2.0) } else { vec2(GAP, -GAP) };
        let height = vec2(0.0, row_height(has_words, ui));
        Self { next: rect.left_bottom() + corner - height, has_words }
    }

    /// Number of buttons that fit the picture in `rect`. In a low picture those with words leave the middle free, if
    /// enough of them fit beside it.
    pub fn capacity(ui: &Ui, rect: Rect) -> usize {
        let fitting = |width: f32, step: f32| (width / step).floor().max(1.0) as usize;
        if !has_words(ui, rect) {
            return fitting(rect.width() - GAP, button_side(ui) + GAP);
        }
        let beside_middle = fitting(0.5 * rect.width() - 4.0, WORD_STEP);
        if rect.height() < LOW_PICTURE && beside_middle >= MIN_BESIDE {
            beside_middle
        } else {
            fitting(rect.width() - 4.0, WORD_STEP)
        }
    }

    /// Adds a button on the right of the others.
    pub fn add(&mut self, ui: &mut Ui, row_button: RowButton) -> Response {
        let RowButton { icon, name_and_hover, word } = row_button;
        if !self.has_words {
            let added = button(ui, self.next, icon, name_and_hover);
            self.next.x += button_side(ui) + GAP;
            return added;
        }
        let side = button_side(ui);
        let area = Rect::from_min_size(self.next, vec2(WORD_STEP - 2.0, side + WORD_HEIGHT));
        // Not faded where the button is disabled: its word stays legible over any picture.
        let painter = ui.ctx().layer_painter(ui.layer_id()).with_clip_rect(ui.clip_rect());
        painter.rect_filled(area, theme::RADIUS, theme::PANEL.gamma_multiply(0.8));
        let at = Rect::from_min_size(area.min, vec2(area.width(), side));
        let (name, hover) = name_and_hover;
        let added = ui.put(at, |ui: &mut Ui| icon_button(ui, icon, name, hover));
        // The word is part of the button, but no place for the Tab key.
        let word_rect = Rect::from_min_max(at.left_bottom(), area.max);
        let sense = Sense::CLICK | Sense::DRAG;
        let added = added.union(ui.interact(word_rect, added.id.with("word"), sense));
        let (font, below) = (FontId::proportional(12.0), area.center_bottom() - vec2(0.0, 4.0));
        painter.text(below, Align2::CENTER_BOTTOM, word, font, theme::TEXT);
        self.next.x += WORD_STEP;
        added
    }

    /// The area of the row's buttons, with the gap around them.
    pub fn area(&self, picture: Rect) -> Rect {
        Rect::from_min_max(
            Pos2::new(picture.left(), self.next.y - GAP),
            Pos2::new(self.next.x, picture.bottom()),
        )
    }
}
