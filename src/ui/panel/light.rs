//! Properties of one light, and conversion of its direction to and from the camera's frame.

use egui::{Response, RichText, Ui};

use crate::{
    scene::{
        Camera, EnvironmentLight, LightFrame, PointLight,
        param::{self, Param, Unit},
    },
    ui::{
        theme,
        widgets::{Help as _, ball, choice, param_slider},
    },
};

/// Direction, shadows, strength and frame of an environment light. Returns the ball's response.
pub(super) fn environment(ui: &mut Ui, light: &mut EnvironmentLight, camera: &Camera) -> Response {
    let ball = ui
        .horizontal(|ui| {
            let ball = direction_ball(ui, "Light direction", 112.0, light, camera);
            ui.vertical(|ui| {
                ui.add_space(6.0);
                let mut behind = light.toward_light_in_view(camera).z < 0.0;
                if ui.checkbox(&mut behind, "From behind").help("Lights the fractal from behind, as you see it").changed() {
                    let mut direction = light.toward_light_in_view(camera);
                    direction.z = -direction.z;
                    light.set_toward_light_in_view(direction, camera);
                }
                ui.checkbox(&mut light.casts_shadows, "Shadows").help("This light casts shadows");
                let mut limited = light.shadow_reach.is_some();
                let reach = ui.add_enabled(light.casts_shadows, egui::Checkbox::new(&mut limited, "Near shadows only"));
                if reach.help("Only near surfaces cast shadows, up to the shadow reach below. Brightens the picture.").changed() {
                    light.shadow_reach = limited.then_some(param::SHADOW_REACH.default);
                }
                if light.casts_shadows && light.shadow_reach.is_none() && camera.is_close() {
                    ui.label(RichText::new("At deep zooms, most of the view is in shadow.").small().color(theme::TEXT_DIM));
                }
            });
            ball
        })
        .inner;
    param_slider(ui, &param::ENVIRONMENT_INTENSITY, &mut light.intensity);
    param_slider(ui, &param::ENVIRONMENT_SIZE, &mut light.size_deg);
    if let Some(reach) = &mut light.shadow_reach {
        ui.add_enabled_ui(light.casts_shadows, |ui| param_slider(ui, &param::SHADOW_REACH, reach));
    }
    let mut frame = light.frame;
    choice(
        ui,
        "Stays with",
        &mut frame,
        &[
            (LightFrame::Scene, "Scene", "The light stays in place while the camera moves"),
            (LightFrame::View, "Camera", "The light moves with the camera"),
        ],
    );
    if frame != light.frame {
        // The light keeps its current direction in the new frame.
        let direction = light.toward_light_in_view(camera);
        light.frame = frame;
        light.set_toward_light_in_view(direction, camera);
    }
    ball
}

/// Maximum distance of a light that is shown in view units.
const NEAR: f64 = 1e3;
/// Intensity of a near point light in view units; in scene units it could be as small as 1e-40.
const NEAR_POINT_INTENSITY: Param = Param {
    help: "The light's brightness at one view unit (the distance from you to the pivot). Twice the distance gives a quarter of the light.",
    ..param::POINT_INTENSITY
};

/// Radius of a near point light in view units.
const NEAR_POINT_RADIUS: Param = Param {
    unit: Unit::ViewUnits,
    help: "Radius of the glowing ball, in view units (the distance from you to the pivot). Larger softens the shadows while the picture refines.",
    ..param::POINT_RADIUS
};

/// The distance, in scene units, for which the panel shows a point light's strength.
///
/// One view unit if the view is close and the light is near, otherwise one scene unit.
fn reference_distance(light: &PointLight, camera: &Camera) -> f64 {
    let unit = camera.view_unit();
    let distance = (&light.position - &camera.position).length();
    if camera.is_close() && distance < NEAR * unit { unit } else { 1.0 }
}

/// Strength, shadows and position of a point light.
pub(super) fn point(ui: &mut Ui, light: &mut PointLight, camera: &Camera) {
    let length = reference_distance(light, camera);
    let param = if length == 1.0 { &param::POINT_INTENSITY } else { &NEAR_POINT_INTENSITY };
    let mut intensity = light.intensity / (length * length);
    if param_slider(ui, param, &mut intensity).changed() {
        light.intensity = param::POINT_INTENSITY.clamp(intensity * length * length);
    }
    let radius_param = if length == 1.0 { &param::POINT_RADIUS } else { &NEAR_POINT_RADIUS };
    let mut radius = light.radius / length;
    if param_slider(ui, radius_param, &mut radius).changed() {
        light.radius = param::POINT_RADIUS.clamp(radius * length);
    }
    ui.checkbox(&mut light.casts_shadows, "Shadows").help("This light casts shadows");
    let (position, hover) = if length == 1.0 {
        let at = light.position.to_dvec3();
        (
            format!("At {:.4}, {:.4}, {:.4}", at.x, at.y, at.z),
            "The light's position in scene units. Drag its handle in the view to move it; with Shift, toward or away from you.",
        )
    } else {
        let distance = (&light.position - &camera.position).length() / length;
        (
            format!("{distance:.3} view units from you. Intensity at 1 view unit."),
            "The light's distance, in multiples of the distance from you to the pivot. Drag its handle in the view to move it; with Shift, toward or away from you.",
        )
    };
    ui.label(RichText::new(position).small().color(theme::TEXT_DIM)).help(hover);
}

/// The ball that edits a light's direction; `name` is for screen readers.
pub(super) fn direction_ball(
    ui: &mut Ui,
    name: &str,
    diameter: f32,
    light: &mut EnvironmentLight,
    camera: &Camera,
) -> Response {
    let mut direction = light.toward_light_in_view(camera);
    let response = ball(ui, name, diameter, light.color, &mut direction);
    if response.changed() {
        light.set_toward_light_in_view(direction, camera);
    }
    response
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn a_near_light_at_a_deep_zoom_is_shown_in_view_units() {
        let mut camera = Camera::default();
        let near = PointLight { position: camera.position.clone(), ..Default::default() };
        assert_eq!(reference_distance(&near, &camera), 1.0);
        camera.pivot = camera.position.moved_by(DVec3::Y * 1e-20, 0.0);
        assert_eq!(reference_distance(&near, &camera), 1e-20);
        assert_eq!(reference_distance(&PointLight::default(), &camera), 1.0);
    }

    #[test]
    fn a_direction_round_trips_through_both_frames() {
        let camera = Camera::default();
        let wanted = DVec3::new(0.2, -0.7, 0.4).normalize();
        for frame in [LightFrame::Scene, LightFrame::View] {
            let mut light = EnvironmentLight { frame, ..Default::default() };
            light.set_toward_light_in_view(wanted, &camera);
            assert!((light.toward_light_in_view(&camera) - wanted).length() < 1e-12);
        }
    }
}
