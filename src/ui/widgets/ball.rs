//! A lit ball that edits a light's direction by dragging.
//!
//! The direction is in the camera's frame: +X right, +Y up, +Z toward the viewer. A filled dot is a
//! light in front of the fractal, a hollow dot a light behind it. A drag past the rim moves the
//! light to the other side.

use super::hover::Help as _;
use egui::{
    Color32, EventFilter, Key, Mesh, Pos2, Response, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo,
    accesskit::Role, vec2,
};
use glam::{DQuat, DVec2, DVec3};

use crate::ui::theme;

/// Number of rings of the ball's mesh.
const RINGS: usize = 14;
/// Number of vertices per ring.
const CORNERS: usize = 48;
/// Rotation per arrow key press, radians; with Shift a tenth.
const KEY_TURN_RAD: f64 = 0.087_266_462_599_716_48;

/// A ball, `diameter` points wide, that shows and edits the unit vector `toward_light`.
///
/// `linear` is the light's colour. A drag or the arrow keys change the direction.
pub fn ball(
    ui: &mut Ui,
    name: &str,
    diameter: f32,
    linear: [f32; 3],
    toward_light: &mut DVec3,
) -> Response {
    let (rect, mut response) =
        ui.allocate_exact_size(Vec2::splat(diameter), Sense::click_and_drag());
    let radius = diameter / 2.0 - 6.0;
    if turn(ui, &response, rect.center(), radius, toward_light) {
        response.mark_changed();
    }
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, ui.is_enabled(), name));
    if ui.is_rect_visible(rect) {
        paint(ui, &response, rect.center(), radius, linear, *toward_light);
    }
    response.help(HELP)
}

/// What a direction's dot does.
pub const HELP: &str = "Drag to change where the light comes from. Past the rim, it comes from behind (hollow dot). Arrow keys turn it by 5 degrees, with Shift by half a degree.";

/// Turns a direction by a drag of its dot or by the arrow keys. Returns whether it changed.
///
/// `response` is that of the dot or of the whole ball around `center`, with `radius` in points.
pub fn turn(
    ui: &Ui,
    response: &Response,
    center: Pos2,
    radius: f32,
    toward_light: &mut DVec3,
) -> bool {
    let before = *toward_light;
    drag(ui, response, center, radius, toward_light);
    if let Some(steps) = arrow_steps(ui, response) {
        turn_by_steps(toward_light, steps);
    }
    before != *toward_light
}

/// Presses of the arrow keys in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArrowSteps {
    /// Presses of the right arrow less those of the left one.
    pub right: f64,
    /// Presses of the up arrow less those of the down one.
    pub up: f64,
    /// True with Shift.
    pub is_shifted: bool,
}

/// Arrow-key presses of this frame while `response` has the focus; the keys don't move the focus. None without presses.
pub fn arrow_steps(ui: &Ui, response: &Response) -> Option<ArrowSteps> {
    if !response.has_focus() {
        return None;
    }
    let arrows =
        EventFilter { horizontal_arrows: true, vertical_arrows: true, ..Default::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    let steps = ui.input(|i| {
        let presses = |key| i.num_presses(key) as f64;
        ArrowSteps {
            right: presses(Key::ArrowRight) - presses(Key::ArrowLeft),
            up: presses(Key::ArrowUp) - presses(Key::ArrowDown),
            is_shifted: i.modifiers.shift,
        }
    });
    (steps.right != 0.0 || steps.up != 0.0).then_some(steps)
}

/// Turns a direction by 5 degrees a press, with Shift by half a degree.
pub fn turn_by_steps(toward_light: &mut DVec3, steps: ArrowSteps) {
    let step = if steps.is_shifted { KEY_TURN_RAD * 0.1 } else { KEY_TURN_RAD };
    let turn =
        DQuat::from_rotation_y(steps.right * step) * DQuat::from_rotation_x(-steps.up * step);
    *toward_light = (turn * *toward_light).normalize();
}

/// The place of a direction's dot on the ball.
pub fn dot_place(center: Pos2, radius: f32, toward_light: DVec3) -> Pos2 {
    center + vec2(toward_light.x as f32, -toward_light.y as f32) * radius
}

/// The light's direction for a point of the ball.
///
/// `point` is in radii from the centre, with y up. `side` is 1 if the drag began in front, −1 if
/// behind. Beyond the rim, the side is reversed.
pub fn direction_from_point(point: DVec2, side: f64) -> DVec3 {
    let r = point.length();
    let (r_on_ball, side) = if r <= 1.0 { (r, side) } else { ((2.0 - r).max(0.0), -side) };
    let flat = point.normalize_or_zero() * r_on_ball;
    flat.extend(side * (1.0 - r_on_ball * r_on_ball).max(0.0).sqrt()).normalize()
}

/// The state of a drag.
#[derive(Clone, Copy)]
struct Grab {
    /// The dot's position relative to the pointer, in radii.
    offset: DVec2,
    /// 1 if the drag began in front, −1 if behind.
    side: f64,
}

fn drag(ui: &Ui, response: &Response, center: Pos2, radius: f32, toward_light: &mut DVec3) {
    let Some(pointer) =
        response.interact_pointer_pos().filter(|_| response.is_pointer_button_down_on())
    else {
        return;
    };
    let id = response.id.with("grab");
    let at = (pointer - center) / radius;
    let at = DVec2::new(f64::from(at.x), -f64::from(at.y));
    if ui.input(|i| i.pointer.any_pressed()) {
        response.request_focus();
        let offset = toward_light.truncate() - at;
        let on_dot = offset.length() < 0.3;
        let grab = Grab {
            offset: if on_dot { offset } else { DVec2::ZERO },
            side: if on_dot && toward_light.z < 0.0 { -1.0 } else { 1.0 },
        };
        ui.data_mut(|data| data.insert_temp(id, grab));
        // A press on the dot without a movement must not change the direction.
        if on_dot {
            return;
        }
    }
    let moved = ui.input(|i| i.pointer.delta() != Vec2::ZERO || i.pointer.any_pressed());
    if let Some(grab) = ui.data(|data| data.get_temp::<Grab>(id))
        && moved
    {
        *toward_light = direction_from_point(at + grab.offset, grab.side);
    }
}

fn paint(
    ui: &Ui,
    response: &Response,
    center: Pos2,
    radius: f32,
    linear: [f32; 3],
    toward_light: DVec3,
) {
    let painter = ui.painter();
    let mut mesh = Mesh::default();
    let vertex = |mesh: &mut Mesh, ring: usize, corner: usize| {
        // Rings are closer together near the rim, where the shading changes fastest.
        let r = (std::f64::consts::FRAC_PI_2 * ring as f64 / RINGS as f64).sin();
        let angle = std::f64::consts::TAU * corner as f64 / CORNERS as f64;
        let (x, y) = (r * angle.cos(), r * angle.sin());
        let normal = DVec3::new(x, y, (1.0 - r * r).max(0.0).sqrt());
        let at = center + vec2(x as f32, -y as f32) * radius;
        mesh.colored_vertex(at, shade(normal, toward_light, linear));
    };
    for ring in 0..=RINGS {
        for corner in 0..CORNERS {
            vertex(&mut mesh, ring, corner);
        }
    }
    let index = |ring: usize, corner: usize| (ring * CORNERS + corner % CORNERS) as u32;
    for ring in 0..RINGS {
        for corner in 0..CORNERS {
            let [a, b, c, d] = [
                index(ring, corner),
                index(ring, corner + 1),
                index(ring + 1, corner),
                index(ring + 1, corner + 1),
            ];
            mesh.add_triangle(a, c, d);
            mesh.add_triangle(a, d, b);
        }
    }
    painter.add(Shape::mesh(mesh));
    let busy = response.hovered() || response.has_focus() || response.dragged();
    let rim = if response.has_focus() {
        theme::ACCENT
    } else if busy {
        theme::TEXT_DIM
    } else {
        theme::LINE
    };
    painter.circle_stroke(center, radius + 0.5, Stroke::new(1.5, rim));

    let dot = dot_place(center, radius, toward_light);
    let color = theme::display_color(linear);
    let dark = Stroke::new(2.0, Color32::from_black_alpha(190));
    if toward_light.z >= 0.0 {
        painter.circle(dot, 6.0, color, dark);
        painter.circle_stroke(dot, 7.0, Stroke::new(1.5, Color32::WHITE));
    } else {
        painter.circle_stroke(dot, 6.0, Stroke::new(4.0, Color32::from_black_alpha(190)));
        painter.circle_stroke(dot, 6.0, Stroke::new(2.0, color));
    }
}

/// The ball's colour at `normal`: a simple preview, not the renderer's shading.
fn shade(normal: DVec3, toward_light: DVec3, linear: [f32; 3]) -> Color32 {
    let diffuse = normal.dot(toward_light).max(0.0);
    let half = (toward_light + DVec3::Z).normalize_or_zero();
    let highlight = if diffuse > 0.0 { normal.dot(half).max(0.0).powf(40.0) * 0.35 } else { 0.0 };
    let level = |channel: f32| {
        let base = 0.012 + 0.008 * normal.y as f32;
        base + channel * (0.42 * diffuse + highlight) as f32
    };
    theme::display_color(linear.map(level))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_direction_is_continuous_across_the_rim() {
        for angle in [0.0, 1.0, 2.5, 4.0] {
            let out = DVec2::from_angle(angle);
            let inside = direction_from_point(out * (1.0 - 1e-9), 1.0);
            let outside = direction_from_point(out * (1.0 + 1e-9), 1.0);
            assert!((inside - outside).length() < 1e-3, "a jump at the rim: {inside} {outside}");
            assert!(inside.z > 0.0 && outside.z < 0.0);
        }
    }

    #[test]
    fn every_point_gives_the_unit_vector_above_the_point() {
        for i in 0..200 {
            let point = DVec2::from_angle(f64::from(i)) * (f64::from(i) * 0.02);
            for side in [1.0, -1.0] {
                let direction = direction_from_point(point, side);
                assert!((direction.length() - 1.0).abs() < 1e-12);
                if point.length() <= 1.0 {
                    assert!(
                        (direction.truncate() - point).length() < 1e-9,
                        "the dot follows the pointer"
                    );
                    assert!(direction.z * side >= 0.0);
                }
            }
        }
    }
}
