//! The timeline's track: a ruler to scrub, and keys as diamonds to drag.

use egui::{
    Color32, FontId, Key, Painter, Pos2, Rangef, Rect, Response, Sense, Shape, Stroke, Ui,
    WidgetInfo, accesskit::Role, pos2, vec2,
};

use crate::{
    scene::{Path, path::Easing},
    ui::{theme, timeline::Timeline, widgets::Help as _},
};

/// Height of the ruler, in points.
const RULER_HEIGHT: f32 = 20.0;
/// Height of the keys' lane below the ruler, in points.
const LANE_HEIGHT: f32 = 28.0;
/// Width of a diamond's sensitive area, in points.
const KEY_WIDTH: f32 = 20.0;
/// Minimum width of a key's sensitive area between others at its time, in points.
const MIN_KEY_WIDTH: f32 = 6.0;
/// Margin at both ends, so that the outer keys can be grabbed, in points.
const MARGIN: f32 = 14.0;
/// Half the width of a diamond, in points.
const DIAMOND: f32 = 6.5;
/// Distance within which the playhead snaps to a key, in points.
const SNAP: f32 = 4.0;
/// Half the width of the playhead's grip, in points.
const GRIP: f32 = 5.0;
/// Gap between the playhead at a number's time and that number, in points.
const LABEL_GAP: f32 = 3.0;
/// Minimum distance between the ruler's numbers, in points.
const TICK_GAP: f32 = 64.0;
/// Possible distances between the ruler's numbers, seconds.
const TICKS: [f64; 13] =
    [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1200.0];
/// Minimum time span of the track, seconds.
const MIN_SPAN_SECS: f64 = 5.0;

/// The mapping from times to x coordinates.
#[derive(Clone, Copy)]
struct TimeScale {
    left: f32,
    width: f32,
    secs: f64,
}

impl TimeScale {
    fn x(self, secs: f64) -> f32 {
        self.left + self.width * (secs / self.secs) as f32
    }

    fn secs_at(self, x: f32) -> f64 {
        f64::from((x - self.left) / self.width.max(1.0)) * self.secs
    }
}

/// Height of the lane, which is higher for fingers.
fn lane_height(ui: &Ui) -> f32 {
    theme::target_size(ui, LANE_HEIGHT)
}

/// Draws the track and returns its response.
///
/// Scrubbing moves the playhead; dragging a diamond moves its key.
pub fn show(ui: &mut Ui, path: &mut Path, timeline: &mut Timeline, on_path: bool) -> Response {
    let size = vec2(ui.available_width(), RULER_HEIGHT + lane_height(ui));
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let id = ui.scope_id().with("timeline track");
    let response = ui.interact(rect, id, Sense::click_and_drag());
    let scale = scale_of(ui, &response, rect, path);

    // At low frame rates, a drag's last movement and its end arrive in one frame.
    if (response.dragged() || response.drag_stopped() || response.clicked())
        && let Some(pointer) = response.interact_pointer_pos()
    {
        let is_near = |secs: f64| (scale.x(secs) - pointer.x).abs() < SNAP;
        let key = path.keys.iter().map(|key| key.time_secs).find(|&secs| is_near(secs));
        timeline.seek(path, key.unwrap_or(scale.secs_at(pointer.x)));
        timeline.held = response.dragged();
    }
    step_by_keys(ui, &response, path, timeline);
    describe(ui, &response, path, timeline);

    let painter = ui.painter().with_clip_rect(rect);
    painter.rect_filled(rect, theme::RADIUS, theme::WELL);
    ruler(&painter, rect, scale);
    let lane_y = rect.top() + RULER_HEIGHT + lane_height(ui) / 2.0;
    lines(&painter, lane_y, scale, path);
    for index in 0..path.keys.len() {
        diamond(ui, &response, pos2(0.0, lane_y), scale, path, timeline, index);
    }
    playhead(&painter, rect, scale.x(timeline.secs()), on_path, !path.is_empty());
    response.help("Drag to move in time. Click a key to show it, drag it to change its time.")
}

/// The time scale: the path plus 12 %. The scale is constant during a drag.
fn scale_of(ui: &Ui, response: &Response, rect: Rect, path: &Path) -> TimeScale {
    let id = response.id.with("span");
    let wanted = (path.duration_secs() * 1.12).max(MIN_SPAN_SECS);
    let held = ui.input(|i| i.pointer.any_down());
    let secs = ui.data(|data| data.get_temp(id)).filter(|_| held).unwrap_or(wanted);
    ui.data_mut(|data| data.insert_temp(id, secs));
    TimeScale { left: rect.left() + MARGIN, width: (rect.width() - 2.0 * MARGIN).max(1.0), secs }
}

/// Moves the playhead by frames with the arrow keys while the track is focused.
fn step_by_keys(ui: &Ui, response: &Response, path: &Path, timeline: &mut Timeline) {
    if !response.has_focus() {
        return;
    }
    let arrows = egui::EventFilter { horizontal_arrows: true, ..Default::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    let steps = ui.input(|i| {
        let presses = |key| i.num_presses(key) as f64;
        presses(Key::ArrowRight) - presses(Key::ArrowLeft)
            + 10.0 * (presses(Key::PageUp) - presses(Key::PageDown))
    });
    if steps != 0.0 {
        let frame = f64::from(path.nearest_frame(timeline.secs())) + steps;
        timeline.seek(path, frame * path.frame_secs(1));
    }
}

fn describe(ui: &Ui, response: &Response, path: &Path, timeline: &Timeline) {
    response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), timeline.secs(), "Timeline"));
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_min_numeric_value(0.0);
        node.set_max_numeric_value(path.duration_secs());
    });
}

fn ruler(painter: &Painter, rect: Rect, scale: TimeScale) {
    let min_step = scale.secs_at(scale.left + TICK_GAP);
    let step = TICKS.into_iter().find(|&step| step >= min_step).unwrap_or(TICKS[12]);
    let small = Stroke::new(1.0, theme::LINE);
    // The loop is bounded, because the track's time span is finite.
    for i in 0..=(scale.secs / step).ceil() as u32 * 5 {
        let secs = f64::from(i) * step / 5.0;
        let x = scale.x(secs);
        if x > rect.right() {
            break;
        }
        let is_numbered = i % 5 == 0;
        let top = rect.top() + if is_numbered { 15.0 } else { 17.0 };
        painter.vline(x, top..=rect.top() + RULER_HEIGHT, small);
        if is_numbered {
            let text = if step < 1.0 { format!("{secs:.1}") } else { clock(secs) };
            let font = FontId::proportional(12.0);
            let text = painter.layout_no_wrap(text, font, theme::TEXT_DIM);
            let at = pos2(x + GRIP + LABEL_GAP, rect.top() + 1.0);
            // The text at the end would be cut.
            if at.x + text.size().x <= rect.right() {
                painter.galley(at, text, theme::TEXT_DIM);
            }
        }
    }
}

/// A time as text: `45 s` or `2:05`.
fn clock(secs: f64) -> String {
    let whole = secs.round() as u64;
    if whole < 60 { format!("{whole} s") } else { format!("{}:{:02}", whole / 60, whole % 60) }
}

/// Lines between keys: thick for smooth easing, thin for linear, none for hold.
fn lines(painter: &Painter, y: f32, scale: TimeScale, path: &Path) {
    for pair in path.keys.windows(2) {
        let xs = scale.x(pair[0].time_secs)..=scale.x(pair[1].time_secs);
        let (width, color) = match pair[0].easing {
            Easing::Smooth => (3.0, theme::ACCENT.gamma_multiply(0.55)),
            Easing::Linear => (1.0, theme::ACCENT.gamma_multiply(0.8)),
            Easing::Hold => continue,
        };
        painter.hline(xs, y, Stroke::new(width, color));
    }
}

fn diamond(
    ui: &Ui,
    track: &Response,
    lane: Pos2,
    scale: TimeScale,
    path: &mut Path,
    timeline: &mut Timeline,
    index: usize,
) {
    let key = &path.keys[index];
    let height = Rangef::point(lane.y).expand(lane_height(ui) / 2.0);
    let area = Rect::from_x_y_ranges(key_range(ui, scale, path, index), height);
    let response = ui.interact(area, track.id.with(("key", index)), Sense::click_and_drag());
    let name = format!("Key {} at {:.2} s", index + 1, key.time_secs);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), &name));
    if response.clicked() {
        timeline.show_key(path, index);
    } else if response.drag_started() || response.gained_focus() {
        timeline.select(path, index);
    }
    if response.dragged()
        && let Some(pointer) = response.interact_pointer_pos()
    {
        timeline.held = true;
        timeline.retime(path, index, scale.secs_at(pointer.x));
    }
    let selected = timeline.selected(path) == Some(index);
    let fill = if selected { theme::ACCENT } else { theme::TEXT };
    let outline =
        if response.hovered() || response.has_focus() { Color32::WHITE } else { theme::WELL };
    let center = pos2(scale.x(path.keys[index].time_secs), lane.y);
    let corners = [(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)];
    let corners = corners.map(|(x, y)| center + vec2(x, y) * DIAMOND).to_vec();
    let painter = ui.painter().with_clip_rect(track.rect);
    painter.add(Shape::convex_polygon(corners, fill, Stroke::new(1.5, outline)));
    response.help(format!("{name}. Click to show it, drag to change its time."));
}

/// The x coordinates of a key's sensitive area, which ends at the middle between neighbours, but is at least
/// [`MIN_KEY_WIDTH`] wide.
fn key_range(ui: &Ui, scale: TimeScale, path: &Path, index: usize) -> Rangef {
    let x_of = |index: usize| path.keys.get(index).map(|key| scale.x(key.time_secs));
    let x = x_of(index).unwrap_or_default();
    let half = theme::target_size(ui, KEY_WIDTH) / 2.0;
    let middle_to = |neighbour: Option<f32>| neighbour.map(|other| (x + other) / 2.0);
    let left = middle_to(index.checked_sub(1).and_then(x_of)).unwrap_or(x - half);
    let right = middle_to(x_of(index + 1)).unwrap_or(x + half);
    let least = 0.5 * MIN_KEY_WIDTH;
    Rangef::new(left.max(x - half).min(x - least), right.min(x + half).max(x + least))
}

/// Draws the playhead: a line with a grip, hollow if the view differs from the path.
fn playhead(painter: &Painter, rect: Rect, x: f32, on_path: bool, has_path: bool) {
    let color = if has_path { Color32::WHITE } else { theme::TEXT_DIM };
    painter.vline(x, rect.y_range(), Stroke::new(1.0, color.gamma_multiply(0.8)));
    let corners = [(-GRIP, 0.0), (GRIP, 0.0), (GRIP, 6.0), (0.0, 11.0), (-GRIP, 6.0)];
    let corners = corners.map(|(dx, dy)| pos2(x + dx, rect.top() + dy)).to_vec();
    let fill = if on_path { color } else { theme::WELL };
    painter.add(Shape::convex_polygon(corners, fill, Stroke::new(1.5, color)));
}
