//! Hover texts that leave the controls around them in sight.

use egui::{
    Align2, Context, Frame, Id, Label, PopupAnchor, Pos2, Rect, RectAlign, Response, TextStyle,
    Tooltip, Ui, Vec2, pos2,
};

use crate::ui::theme;

/// Distance between a hover text and its control, and to the screen's edges, in points.
const GAP: f32 = 4.0;
/// Step of the search for a free place, in points.
const STEP: f32 = 8.0;
/// Part of the screen from which on a control is a ground that others lie on, such as the picture.
const GROUND_PART: f32 = 0.2;

/// Tells hover texts where the panel is in this frame.
pub fn set_panel_area(ui: &Ui, area: Rect) {
    ui.ctx().data_mut(|data| data.insert_temp(Id::unique("panel area"), area));
}

/// A hover text that covers no other control.
pub trait Help {
    /// Shows `text` while the control is hovered: on the left of the panel, beside a window, or else at the nearest
    /// place without a control.
    ///
    /// egui's own place, below the control, hides the next row of a panel.
    fn help(self, text: impl Into<String>) -> Self;

    /// As [`Self::help`], while the control is disabled.
    fn disabled_help(self, text: impl Into<String>) -> Self;

    /// As [`Self::help`], with a text that changes each frame and is not given to screen readers.
    fn live_help(self, text: impl FnOnce() -> String) -> Self;
}

impl Help for Response {
    fn help(self, text: impl Into<String>) -> Self {
        let text = text.into();
        self.ctx.accesskit_node_builder(self.id, |node| node.set_description(text.as_str()));
        show(&self, Tooltip::for_enabled(&self), || text);
        self
    }

    fn disabled_help(self, text: impl Into<String>) -> Self {
        show(&self, Tooltip::for_disabled(&self), || text.into());
        self
    }

    fn live_help(self, text: impl FnOnce() -> String) -> Self {
        show(&self, Tooltip::for_enabled(&self), text);
        self
    }
}

fn show(control: &Response, mut tooltip: Tooltip<'_>, text: impl FnOnce() -> String) {
    if !tooltip.popup.is_open() {
        return;
    }
    let (ctx, text) = (&control.ctx, text());
    let style = ctx.global_style();
    let screen = ctx.content_rect().shrink(GAP);
    let around = Frame::popup(&style).total_margin().sum();
    let width = style.spacing.tooltip_width.min(screen.width() - around.x);
    let font = TextStyle::Body.resolve(&style);
    let galley = ctx.fonts_mut(|fonts| fonts.layout(text.clone(), font, theme::TEXT, width));
    let size = galley.size() + around;
    let at = Rect::from_min_size(place(control, size, screen), size);
    let corner = RectAlign { parent: Align2::LEFT_TOP, child: Align2::LEFT_TOP };
    tooltip.popup = tooltip.popup.anchor(PopupAnchor::ParentRect(at)).align(corner);
    tooltip.popup = tooltip.popup.align_alternatives(&[]).gap(0.0).width(width + around.x);
    tooltip.show(|ui| ui.add(Label::new(text).wrap()));
}

/// The upper left corner of the hover text of a size.
fn place(control: &Response, size: Vec2, screen: Rect) -> Pos2 {
    let ctx = &control.ctx;
    let others = controls(ctx, control, screen);
    // At the size where a text that is one point wider than expected still covers nothing.
    let covered = |at: Pos2| {
        let rect = Rect::from_min_size(at, size).expand(GAP / 2.0);
        others.iter().map(|other| rect.intersect(*other)).filter(Rect::is_positive).count()
    };
    let moved_into = |at: Pos2| at.max(screen.min).min(screen.max - size);
    let candidates = candidates(control, size, screen).map(moved_into);
    let mut least = (usize::MAX, screen.min);
    for at in candidates {
        let count = covered(at);
        if count == 0 {
            return at;
        }
        if count < least.0 {
            least = (count, at);
        }
    }
    least.1
}

/// The places to try, the best first.
fn candidates(control: &Response, size: Vec2, screen: Rect) -> impl Iterator<Item = Pos2> {
    let (ctx, rect) = (&control.ctx, control.rect);
    let panel: Option<Rect> = ctx.data(|data| data.get_temp(Id::unique("panel area")));
    let panel = panel.filter(|panel| panel.contains(rect.center()));
    let window = ctx.memory(|memory| memory.area_rect(control.layer_id.id));
    let middle = rect.center().y - 0.5 * size.y;
    let steps = (screen.height().max(screen.width()) / STEP) as usize;
    let beside = panel.or(window).into_iter().flat_map(move |area| {
        let sides = [area.left() - GAP - size.x, area.right() + GAP].into_iter();
        let sides = sides.filter(move |x| *x >= screen.left() && x + size.x <= screen.right());
        sides.flat_map(move |x| {
            (0..steps).flat_map(move |step| {
                let away = STEP * step as f32;
                [pos2(x, middle - away), pos2(x, middle + away)]
            })
        })
    });
    // Of a wide control, the text is near the pointer.
    let pointer = ctx.pointer_hover_pos().filter(|_| rect.width() > size.x);
    let left = pointer.map_or(rect.left(), |at| at.x - 0.5 * size.x);
    let around = (0..=steps).flat_map(move |step| {
        let away = GAP + STEP * step as f32;
        [
            pos2(left, rect.bottom() + away),
            pos2(left, rect.top() - away - size.y),
            pos2(rect.right() + away, middle),
            pos2(rect.left() - away - size.x, middle),
        ]
    });
    // Over the control itself, whose clicks it lets through, where all around is full.
    let over = pos2(rect.center().x - 0.5 * size.x, rect.bottom() - size.y - GAP);
    let fits = rect.width() > size.x && rect.height() > 2.0 * size.y;
    let anywhere = std::iter::once_with(move || anywhere(rect.center(), size, screen)).flatten();
    beside.chain(around).chain(fits.then_some(over)).chain(anywhere)
}

/// Places all over the screen, the nearest to `center` first.
fn anywhere(center: Pos2, size: Vec2, screen: Rect) -> Vec<Pos2> {
    let [columns, rows] = [screen.width(), screen.height()].map(|side| (side / STEP) as usize / 2);
    let step = 2.0 * STEP;
    let all = (0..=rows).flat_map(|row| (0..=columns).map(move |column| (row, column)));
    let place = |(row, column)| screen.min + step * egui::vec2(column as f32, row as f32);
    let mut all: Vec<Pos2> = all.map(place).collect();
    all.sort_by(|a, b| {
        let away = |at: &Pos2| (*at + 0.5 * size).distance_sq(center);
        away(a).total_cmp(&away(b))
    });
    all
}

/// The rectangles of all controls but those that `control` lies on.
fn controls(ctx: &Context, control: &Response, screen: Rect) -> Vec<Rect> {
    let ground = GROUND_PART * screen.area();
    ctx.viewport(|viewport| {
        let widgets = viewport.prev_pass.widgets.layers().flat_map(|(_, widgets)| widgets);
        let controls = widgets.filter(|widget| widget.sense.interactive() && widget.visible);
        let seen = controls.map(|widget| widget.interact_rect).filter(|rect| rect.is_positive());
        let others = seen.filter(|rect| rect.area() < ground && !rect.contains_rect(control.rect));
        others.chain([control.rect]).collect()
    })
}
