//! How pins and the words of their search are drawn.

use egui::{
    Color32, CornerRadius, FontId, Painter, Pos2, Rect, Response, Sense, Stroke, StrokeKind, Ui,
    WidgetInfo, accesskit::Role, pos2, vec2,
};

use super::{
    arrange,
    pin::Pin,
    state::{Places, Progress},
};
use crate::{
    scene::Camera,
    ui::{
        display_inputs::SmallTextures,
        floating::GAP,
        frame::Frame,
        icon::{self, Icon},
        rects::Rects,
        theme,
        widgets::Help as _,
    },
};

/// Enlargement of the picture under the pointer.
const ENLARGED: f32 = 1.35;
/// Radius of the point on the surface, in points.
const POINT: f32 = 4.0;
/// Widest text about the search, in points.
const MAX_TEXT_WIDTH: f32 = 340.0;

/// Names of the captions that may be where the text is, the lowest first.
const CAPTIONS: [&str; 5] = ["dive status", "comparing", "look preview", "light click", "fly keys"];

/// What pins are drawn over.
#[derive(Clone, Copy)]
pub struct PinInputs<'a> {
    /// The picture's frame.
    pub frame: Frame,
    /// The camera of the picture.
    pub camera: &'a Camera,
    /// The small pictures that have been drawn.
    pub textures: &'a SmallTextures,
    /// The area of buttons in the lower left corner, and of others.
    pub buttons: [Rect; 2],
}

/// Draws the pins and the progress of their search; returns the index of a clicked pin.
pub fn show(
    ui: &Ui,
    places: &mut Places,
    inputs: &PinInputs<'_>,
    rects: &mut Rects,
) -> Option<usize> {
    let progress = places.progress()?;
    let words = words(ui, inputs, progress, rects);
    let [buttons, others] = inputs.buttons;
    let placed = places.arrange(inputs.camera, inputs.frame, &[buttons, others, words]);
    let responses: Vec<Option<Response>> = places
        .pins()
        .iter()
        .zip(&placed)
        .enumerate()
        .map(|(index, (pin, place))| place.map(|(_, rect)| respond(ui, pin, index, rect)))
        .collect();
    let painter = ui.painter().with_clip_rect(inputs.frame.rect);
    // The best are on top, and the one under the pointer above all.
    let is_lit =
        |index: usize| responses[index].as_ref().is_some_and(|it| it.hovered() || it.has_focus());
    let (lit, others): (Vec<_>, Vec<_>) = (0..placed.len()).rev().partition(|&it| is_lit(it));
    for index in others.into_iter().chain(lit) {
        if let Some((at, rect)) = placed[index] {
            paint(&painter, inputs, &places.pins()[index], at, rect, is_lit(index));
        }
    }
    if let Some(first) = responses.first().and_then(Option::as_ref) {
        rects.record("first place", first);
    }
    responses.iter().position(|it| it.as_ref().is_some_and(Response::clicked))
}

fn respond(ui: &Ui, pin: &Pin, index: usize, rect: Rect) -> Response {
    let id = ui.scope_id().with(("place", pin.place.position.clone().0.map(|it| it.to_string())));
    let response = ui.interact(rect, id, Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, pin.name(index)));
    response.help(pin.help())
}

fn paint(painter: &Painter, inputs: &PinInputs<'_>, pin: &Pin, at: Pos2, rect: Rect, is_lit: bool) {
    let factor = if is_lit { ENLARGED } else { 1.0 };
    let grown = arrange::enlarged(rect, at, factor, inputs.frame.rect);
    let from = grown.clamp(at);
    let color = if is_lit { theme::ACCENT } else { Color32::WHITE };
    let dark = Color32::from_black_alpha(170);
    // A dark line below a light one is legible on any picture.
    painter.line_segment([from, at], Stroke::new(4.0, dark));
    painter.circle_filled(at, POINT + 1.5, dark);
    painter.line_segment([from, at], Stroke::new(1.5, color));
    painter.circle_filled(at, POINT, color);
    let corners = CornerRadius::same(theme::RADIUS);
    painter.rect_stroke(grown, corners, Stroke::new(3.5, dark), StrokeKind::Outside);
    match inputs.textures.by_id.get(&pin.picture.id) {
        Some(picture) => picture.paint(painter, grown, corners),
        None => {
            painter.rect_filled(grown, corners, theme::PANEL);
            icon::paint(painter, Icon::Pin, grown.center(), 18.0, theme::TEXT_DIM);
        }
    }
    painter.rect_stroke(grown, corners, Stroke::new(1.5, color), StrokeKind::Outside);
}

/// Draws the words of the search above the buttons and returns their area.
fn words(ui: &Ui, inputs: &PinInputs<'_>, progress: Progress, rects: &mut Rects) -> Rect {
    let text = match progress {
        Progress::Searching(part) => format!("Looking for places: {:.0} %", 100.0 * part),
        Progress::Waiting => "Looking for places once the view stands still".to_owned(),
        Progress::Found(0) => "No places in this view. Zoom out, turn the surface to the \
                               middle, or choose a Mandelbulb: these have places."
            .to_owned(),
        Progress::Found(1) => "1 place. Choose it to fly there.".to_owned(),
        Progress::Found(count) => format!("{count} places. Choose one to fly there."),
    };
    let picture = inputs.frame.rect;
    let width = (picture.width() - 2.0 * GAP - 20.0).clamp(80.0, MAX_TEXT_WIDTH);
    let galley = ui.painter().layout(text.clone(), FontId::proportional(12.5), theme::TEXT, width);
    let size = galley.size() + vec2(20.0, 12.0);
    let [buttons, _] = inputs.buttons;
    let at = pos2(picture.left() + GAP, buttons.top() - size.y);
    let mut rect = Rect::from_min_size(at, size);
    // In a narrow picture captions are above the buttons, too.
    for caption in CAPTIONS.iter().filter_map(|name| rects.get(name)) {
        if caption.intersects(rect) {
            rect = rect.translate(vec2(0.0, caption.top() - 0.5 * GAP - rect.bottom()));
        }
    }
    let painter = ui.painter().with_clip_rect(picture);
    painter.rect_filled(rect, theme::RADIUS, theme::PANEL.gamma_multiply(0.85));
    painter.galley(rect.min + vec2(10.0, 6.0), galley, theme::TEXT);
    let response = ui.interact(rect, ui.scope_id().with("places words"), Sense::hover());
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_role(Role::Status);
        node.set_label(text);
    });
    rects.record("places words", &response);
    rect
}
