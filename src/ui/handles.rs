//! Handles of lights and section planes in the view.
//!
//! A drag moves a point light parallel to the screen. A drag with Shift moves the light along its ray;
//! upward is away from the eye. The handle of a directional light or of a sky's sun is on a ball around the picture's
//! middle, as a dot is on the panel's ball. Arrow keys do the same while the handle or the light's row, which the
//! sun lacks, has the focus.
//! A section plane moves along its normal, by a drag or by arrow keys. What is behind the eye has no handle.

use egui::{Color32, Id, Pos2, Rect, Sense, Stroke, Ui, Vec2, WidgetInfo, accesskit::Role};
use glam::DVec3;

use super::{
    frame::Frame,
    light_handles::is_used_by_keyboard,
    selection::{LightRef, Selection},
    theme,
    widgets::{ArrowSteps, Help as _, arrow_steps, ball},
};
use crate::scene::{Camera, MIN_VIEW_UNIT, RigKind, Scene, follow};

/// Side of a handle's sensitive square, in points.
const GRIP: f32 = 30.0;
/// Change of the distance per point of a drag with Shift, as a natural logarithm.
const DEPTH_PER_POINT: f64 = 0.01;
/// Drag that a press of an arrow key stands for, in points.
const KEY_POINTS: f32 = 10.0;
/// Part of a key's step that a press with Shift moves a section plane.
const FINE_PART: f64 = 0.1;
/// Range of a dragged light's distance from the eye, in scene units.
const DEPTHS: std::ops::RangeInclusive<f64> = MIN_VIEW_UNIT..=90.0;
/// Rounding of positions, in pixels at the light's depth.
const GRAIN_PX: f64 = 1e-2;

/// The sensitive square of a handle at `at`.
fn grip(ui: &Ui, at: Pos2) -> Rect {
    Rect::from_center_size(at, Vec2::splat(theme::target_size(ui, GRIP)))
}

/// Draws the handles of all point lights and moves a dragged light.
///
/// Returns the clicked or dragged light.
pub fn point_lights(
    ui: &Ui,
    frame: Frame,
    scene: &mut Scene,
    selected: &Selection,
) -> Option<LightRef> {
    let mut touched = None;
    let any_solo = scene.lights.any_solo();
    for (index, light) in scene.lights.point.iter_mut().enumerate() {
        let this = LightRef::Point(index);
        let offset = &light.position - &scene.camera.position;
        let grain = offset.length() * scene.camera.half_height(frame.aspect()) * 2.0
            / f64::from(frame.height_px.max(1))
            * GRAIN_PX;
        let mut move_by = |delta: Vec2, in_depth: bool| {
            let moved = displacement(&scene.camera, frame, offset, delta, in_depth);
            light.position = light.position.moved_by(moved, grain);
        };
        let steps_of_row = selected.moved_light.filter(|(light, _)| *light == this);
        if let Some((_, steps)) = steps_of_row {
            move_by(key_delta(steps), steps.is_shifted);
        }
        let Some(at) = project(&scene.camera, frame, offset) else {
            continue;
        };
        let area = grip(ui, at);
        let response =
            ui.interact(area, ui.scope_id().with(("point light", index)), Sense::click_and_drag());
        response.widget_info(|| {
            WidgetInfo::labeled(
                Role::Slider,
                true,
                format!("Point light {} in the view", index + 1),
            )
        });
        if response.clicked() || response.drag_started() || response.gained_focus() {
            touched = Some(this);
        }
        if response.dragged() {
            move_by(response.drag_delta(), ui.input(|i| i.modifiers.shift));
        }
        if let Some(steps) = arrow_steps(ui, &response) {
            move_by(key_delta(steps), steps.is_shifted);
        }
        let shines = light.shines(any_solo);
        let is_held = response.hovered() || response.dragged() || response.has_focus();
        let lit = is_held || selected.light == Some(this);
        paint(ui, at, theme::display_color(light.color), shines, false, lit);
        response.help("Drag to move this light, or use the arrow keys. With Shift, up and down move it away from you and toward you.");
    }
    touched
}

/// The drag that arrow keys stand for, in points.
fn key_delta(steps: ArrowSteps) -> Vec2 {
    Vec2::new(steps.right as f32, -steps.up as f32) * KEY_POINTS
}

/// Radius of the ball around the picture's middle on which directional lights and the sun are, as a part of the
/// picture's shorter side.
const BALL_PART: f32 = 0.42;

/// What was done to handles in a frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct HandleInteraction {
    /// The clicked or dragged light; none for the sun, which can't be selected.
    pub touched: Option<LightRef>,
    /// True if the pointer is at a handle, or the keyboard is used at one.
    pub is_held: bool,
}

/// Draws the handles of all directional lights and of a sky's sun, and turns a dragged one.
pub fn environment_lights(
    ui: &Ui,
    frame: Frame,
    scene: &mut Scene,
    selected: &Selection,
) -> HandleInteraction {
    let Scene { camera, lights, .. } = scene;
    follow::edit(lights, camera, |lights| {
        let any_solo = lights.any_solo();
        let mut interaction = HandleInteraction::default();
        for (index, light) in lights.environment.iter_mut().enumerate() {
            let this = LightRef::Environment(index);
            let mut toward_light = light.toward_light_in_view(camera);
            let steps_of_row = selected.moved_light.filter(|(light, _)| *light == this);
            if let Some((_, steps)) = steps_of_row {
                ball::turn_by_steps(&mut toward_light, steps);
            }
            let handle = DirectionHandle {
                name: format!("{} in the view", this.name()),
                id: ui.scope_id().with(("light", index)),
                color: theme::display_color(light.color),
                shines: light.shines(any_solo),
                is_selected: selected.light == Some(this),
            };
            let used = handle.show(ui, frame, &mut toward_light);
            if used.is_turned || steps_of_row.is_some() {
                light.set_toward_light_in_view(toward_light, camera);
            }
            interaction.is_held |= used.is_held;
            interaction.touched = used.is_touched.then_some(this).or(interaction.touched);
        }
        let rig = &mut lights.rig;
        if rig.kind == RigKind::Sky {
            let handle = DirectionHandle {
                name: "Sun in the view".to_owned(),
                id: ui.scope_id().with("sun"),
                color: theme::display_color(rig.sky.sun_color),
                shines: rig.shines(any_solo) && rig.sky.sun_strength > 0.0,
                is_selected: false,
            };
            let mut toward_sun = rig.toward_sun_in_view(camera);
            let used = handle.show(ui, frame, &mut toward_sun);
            if used.is_turned {
                rig.set_toward_sun_in_view(toward_sun, camera);
            }
            interaction.is_held |= used.is_held;
        }
        interaction
    })
}

/// A handle on the ball around the picture's middle, for a direction that light comes from.
struct DirectionHandle {
    /// Its name for screen readers.
    name: String,
    id: Id,
    color: Color32,
    /// False if the light is off.
    shines: bool,
    is_selected: bool,
}

/// What was done to a [`DirectionHandle`] in a frame.
struct DirectionUse {
    is_turned: bool,
    /// True if the handle was clicked, or a drag of it began.
    is_touched: bool,
    /// True if the pointer is at the handle, or the keyboard is used there.
    is_held: bool,
}

impl DirectionHandle {
    /// Draws the handle at `toward_light`, a unit vector in the camera's axes, and turns it by drags and arrow keys.
    fn show(self, ui: &Ui, frame: Frame, toward_light: &mut DVec3) -> DirectionUse {
        let center = frame.rect.center();
        let radius = BALL_PART * frame.rect.size().min_elem();
        let at = ball::dot_place(center, radius, *toward_light);
        let response = ui.interact(grip(ui, at), self.id, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, self.name.clone()));
        let is_turned = ball::turn(ui, &response, center, radius, toward_light);
        let is_touched = response.clicked() || response.drag_started() || response.gained_focus();
        let is_pointed_at = response.hovered() || response.dragged();
        let is_held = is_pointed_at || is_used_by_keyboard(&response);
        let is_lit = is_pointed_at || response.has_focus();
        if is_lit {
            let spoke = Stroke::new(1.0, Color32::from_white_alpha(70));
            ui.painter().circle_stroke(center, radius, spoke);
            ui.painter().line_segment([center, at], spoke);
        }
        let is_lit = is_lit || self.is_selected;
        paint(ui, at, self.color, self.shines, toward_light.z < 0.0, is_lit);
        response.help(ball::HELP);
        DirectionUse { is_turned, is_touched, is_held }
    }
}

/// Length of the arrow that shows a section plane's normal, in points, where it is across the line of sight.
const ARROW: f64 = 44.0;

/// Draws the handles of all section planes and moves a dragged plane along its normal.
pub fn section_planes(ui: &Ui, frame: Frame, scene: &mut Scene) {
    let camera = &scene.camera;
    for (index, plane) in scene.fractal.section_planes.iter_mut().enumerate() {
        let offset = &plane.point - &camera.position;
        let Some(at) = project(camera, frame, offset) else {
            continue;
        };
        let area = grip(ui, at);
        let id = ui.scope_id().with(("section plane", index));
        let response = ui.interact(area, id, Sense::drag());
        let name = format!("Section plane {} in the view", index + 1);
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, name.clone()));
        let per_point = scene_per_point(camera, frame, offset);
        let normal = plane.normal();
        let on_screen = camera.rotation().inverse() * normal;
        let arrow = Vec2::new(on_screen.x as f32, -on_screen.y as f32);
        if response.dragged() {
            let moved = along(arrow, response.drag_delta()) * per_point;
            plane.point = plane.point.moved_by(normal * moved, per_point * GRAIN_PX);
        }
        if let Some(steps) = arrow_steps(ui, &response) {
            let part = if steps.is_shifted { FINE_PART } else { 1.0 };
            let points = f64::from(KEY_POINTS) * part * (steps.right + steps.up);
            plane.point = plane.point.moved_by(normal * (points * per_point), per_point * GRAIN_PX);
        }
        let is_lit = response.hovered() || response.dragged() || response.has_focus();
        paint_plane(ui, at, arrow * ARROW as f32, is_lit);
        response.help("Drag to move this section plane along its arrow, or use the arrow keys: right and up move it along the arrow, with Shift finely.");
    }
}

/// How far a drag by `delta` moves along a unit vector that looks like `arrow` on the screen.
///
/// A vector along the line of sight moves with upward drags.
fn along(arrow: Vec2, delta: Vec2) -> f64 {
    let shown = f64::from(arrow.length());
    if shown < LEAST_ARROW {
        return -f64::from(delta.y);
    }
    f64::from(arrow.dot(delta)) / (shown * shown)
}

/// Below this part of its length an arrow lies along the line of sight.
const LEAST_ARROW: f64 = 0.2;

fn paint_plane(ui: &Ui, at: Pos2, arrow: Vec2, is_lit: bool) {
    let painter = ui.painter();
    let color = if is_lit { theme::ACCENT } else { Color32::from_white_alpha(200) };
    for (width, color) in [(5.0, Color32::from_black_alpha(110)), (2.0, color)] {
        painter.arrow(at, arrow, Stroke::new(width, color));
    }
    painter.circle_filled(at, 8.0, Color32::from_black_alpha(110));
    painter.rect_filled(Rect::from_center_size(at, Vec2::splat(9.0)), 2.0, color);
}

/// The window position of the point at `offset` from the eye; none outside the picture.
pub fn project(camera: &Camera, frame: Frame, offset: DVec3) -> Option<Pos2> {
    let seen = camera.rotation().inverse() * offset;
    if seen.z >= -f64::MIN_POSITIVE {
        return None;
    }
    let half = f64::from(frame.rect.height()) / 2.0;
    let scale = half / (camera.half_height(frame.aspect()) * -seen.z);
    let at = frame.rect.center() + Vec2::new((seen.x * scale) as f32, (-seen.y * scale) as f32);
    frame.rect.contains(at).then_some(at)
}

/// The displacement, in scene units, of a dragged point.
///
/// `offset` is the vector from the eye to the point, `delta` the drag in points. `in_depth` moves
/// the point along its ray.
fn displacement(
    camera: &Camera,
    frame: Frame,
    offset: DVec3,
    delta: Vec2,
    in_depth: bool,
) -> DVec3 {
    if in_depth {
        let distance = offset.length().max(f64::MIN_POSITIVE);
        let wanted = distance * (-f64::from(delta.y) * DEPTH_PER_POINT).exp();
        return offset * (wanted.clamp(*DEPTHS.start(), *DEPTHS.end()) / distance - 1.0);
    }
    let rotation = camera.rotation();
    let per_point = scene_per_point(camera, frame, offset);
    (rotation * DVec3::X * f64::from(delta.x) - rotation * DVec3::Y * f64::from(delta.y))
        * per_point
}

/// The length that a point of the window spans at the depth of `offset`, in scene units.
fn scene_per_point(camera: &Camera, frame: Frame, offset: DVec3) -> f64 {
    // Keys move a light beside or behind the eye too.
    let depth = offset.dot(camera.forward()).max(0.1 * offset.length());
    2.0 * camera.half_height(frame.aspect()) * depth / f64::from(frame.rect.height().max(1.0))
}

/// A light's sign: a sun, hollow for a light from behind; a ring where the light is off.
fn paint(ui: &Ui, at: Pos2, color: Color32, shines: bool, is_behind: bool, lit: bool) {
    let painter = ui.painter();
    let opacity = if lit { 1.0 } else { 0.7 };
    painter.circle_filled(at, 8.0, Color32::from_black_alpha(110));
    if shines {
        for ray in 0..8 {
            let out = Vec2::angled(ray as f32 * std::f32::consts::TAU / 8.0);
            painter.line_segment(
                [at + out * 8.0, at + out * 11.0],
                Stroke::new(1.5, color.gamma_multiply(opacity)),
            );
        }
        if is_behind {
            painter.circle_stroke(at, 4.0, Stroke::new(1.5, color.gamma_multiply(opacity)));
        } else {
            painter.circle_filled(at, 4.5, color.gamma_multiply(opacity));
        }
    } else {
        painter.circle_stroke(at, 4.5, Stroke::new(1.5, color.gamma_multiply(0.5)));
    }
    if lit {
        painter.circle_stroke(at, 13.5, Stroke::new(1.5, theme::ACCENT));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dragged_light_stays_under_the_pointer() {
        for unit in [1.0, 1e-13, 1e-27] {
            dragged_at(unit);
        }
    }

    fn dragged_at(unit: f64) {
        let camera = Camera::default();
        let frame = Frame {
            rect: Rect::from_min_size(Pos2::new(10.0, 20.0), Vec2::new(800.0, 600.0)),
            height_px: 600,
        };
        let offset = camera.rotation() * DVec3::new(0.3, -0.2, -2.0) * unit;
        let before = project(&camera, frame, offset).expect("in the picture");
        let delta = Vec2::new(35.0, -12.0);
        let moved = offset + displacement(&camera, frame, offset, delta, false);
        let after = project(&camera, frame, moved).expect("in the picture");
        assert!((after - before - delta).length() < 1e-3, "{unit:e}: {before} went to {after}");
    }

    #[test]
    fn a_drag_with_shift_moves_a_light_along_its_ray() {
        let camera = Camera::default();
        let frame = Frame {
            rect: Rect::from_min_size(Pos2::ZERO, Vec2::new(800.0, 600.0)),
            height_px: 600,
        };
        for unit in [1.0, 1e-13, 1e-27] {
            let offset = camera.rotation() * DVec3::new(0.3, -0.2, -2.0) * unit;
            let moved = offset + displacement(&camera, frame, offset, Vec2::new(0.0, -50.0), true);
            assert!(moved.length() > offset.length(), "upward is away");
            let (a, b) = (project(&camera, frame, offset), project(&camera, frame, moved));
            assert!((a.expect("seen") - b.expect("seen")).length() < 1e-3, "{unit:e}");
        }
    }

    #[test]
    fn a_dragged_section_plane_stays_under_the_pointer() {
        let across = Vec2::new(0.6, -0.8);
        assert!((along(across, across * 50.0) - 50.0).abs() < 1e-4);
        // A normal that is half turned away is shown half as long: the plane moves twice as far.
        assert!((along(across * 0.5, across * 50.0) - 100.0).abs() < 1e-4);
        assert_eq!(along(Vec2::ZERO, Vec2::new(3.0, -20.0)), 20.0);
    }

    #[test]
    fn a_light_behind_the_eye_has_no_handle() {
        let camera = Camera::default();
        let frame = Frame {
            rect: Rect::from_min_size(Pos2::ZERO, Vec2::new(800.0, 600.0)),
            height_px: 600,
        };
        assert_eq!(project(&camera, frame, camera.rotation() * DVec3::Z), None);
    }
}
