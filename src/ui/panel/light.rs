//! One light's properties, and its direction as the camera sees it.

use egui::{Response, RichText, Ui};
use glam::DVec3;

use crate::{
    scene::{
        Camera, EnvironmentLight, LightFrame, PointLight,
        param::{self, Param},
    },
    ui::{
        theme,
        widgets::{ball, choice, param_slider},
    },
};

/// Direction, shadows, strength, frame of a light from a direction. Returns the ball's response.
pub(super) fn environment(ui: &mut Ui, light: &mut EnvironmentLight, camera: &Camera) -> Response {
    let ball = ui
        .horizontal(|ui| {
            let ball = direction_ball(ui, 112.0, light, camera);
            ui.vertical(|ui| {
                ui.add_space(6.0);
                let mut behind = toward_light_in_view(light, camera).z < 0.0;
                if ui.checkbox(&mut behind, "From behind").on_hover_text("Whether the light comes from behind the fractal, as you see it").changed() {
                    let mut direction = toward_light_in_view(light, camera);
                    direction.z = -direction.z;
                    set_direction(light, camera, direction);
                }
                ui.checkbox(&mut light.casts_shadows, "Shadows").on_hover_text("Whether surfaces block this light");
                let mut limited = light.shadow_reach.is_some();
                let reach = ui.add_enabled(light.casts_shadows, egui::Checkbox::new(&mut limited, "Limit reach"));
                if reach.on_hover_text("Let only near surfaces cast shadows, up to the shadow reach below; otherwise the whole scene does").changed() {
                    light.shadow_reach = limited.then_some(param::SHADOW_REACH.default);
                }
                if light.casts_shadows && light.shadow_reach.is_none() && camera.view_unit() < SMALL_VIEW_UNIT {
                    ui.label(RichText::new("Deep in the set the whole scene shades nearly all.").small().color(theme::TEXT_DIM));
                }
            });
            ball
        })
        .inner;
    param_slider(ui, &param::ENVIRONMENT_INTENSITY, &mut light.intensity);
    if let Some(reach) = &mut light.shadow_reach {
        ui.add_enabled_ui(light.casts_shadows, |ui| param_slider(ui, &param::SHADOW_REACH, reach));
    }
    let mut frame = light.frame;
    choice(
        ui,
        "Fixed to",
        &mut frame,
        &[
            (LightFrame::Scene, "Scene", "The light stays where it is as the camera moves"),
            (LightFrame::View, "View", "The light moves with the camera"),
        ],
    );
    if frame != light.frame {
        // Fixed to something else, it still comes from where it came from.
        let direction = toward_light_in_view(light, camera);
        light.frame = frame;
        set_direction(light, camera, direction);
    }
    ball
}

/// View units below this, in scene units, are small enough that lights near by are told in them.
const SMALL_VIEW_UNIT: f64 = 1e-3;
/// How near by those are, in view units.
const NEAR_BY: f64 = 1e3;
/// The intensity of such a light. In the document it would be a number like 1e-40.
const POINT_INTENSITY_NEAR_BY: Param = Param {
    help: "How strong the light is at one view unit, the distance from you to the pivot; it falls with the square of the distance.",
    ..param::POINT_INTENSITY
};

/// The length, in scene units, at which the panel tells a point light's strength: the view unit
/// where it is small and the light is near by, otherwise the scene unit.
fn length_of_intensity(light: &PointLight, camera: &Camera) -> f64 {
    let unit = camera.view_unit();
    let distance = (&light.position - &camera.position).length();
    if unit < SMALL_VIEW_UNIT && distance < NEAR_BY * unit { unit } else { 1.0 }
}

/// Strength, shadows, place of a light from a point.
pub(super) fn point(ui: &mut Ui, light: &mut PointLight, camera: &Camera) {
    let length = length_of_intensity(light, camera);
    let param = if length == 1.0 { &param::POINT_INTENSITY } else { &POINT_INTENSITY_NEAR_BY };
    let mut intensity = light.intensity / (length * length);
    if param_slider(ui, param, &mut intensity).changed() {
        light.intensity = param::POINT_INTENSITY.clamp(intensity * length * length);
    }
    ui.checkbox(&mut light.casts_shadows, "Shadows")
        .on_hover_text("Whether surfaces block this light");
    let (place, hover) = if length == 1.0 {
        let at = light.position.to_dvec3();
        (
            format!("At {:.4}, {:.4}, {:.4}", at.x, at.y, at.z),
            "The light's position in scene units. Drag its handle in the view; with Shift it moves toward or away from you.",
        )
    } else {
        let distance = (&light.position - &camera.position).length() / length;
        (
            format!("{distance:.3} view units from you. Its intensity is told at one."),
            "How far the light is, in multiples of the distance from you to the pivot. Drag its handle in the view; with Shift it moves toward or away from you.",
        )
    };
    ui.label(RichText::new(place).small().color(theme::TEXT_DIM)).on_hover_text(hover);
}

/// The ball on which the light's direction is dragged.
pub(super) fn direction_ball(
    ui: &mut Ui,
    diameter: f32,
    light: &mut EnvironmentLight,
    camera: &Camera,
) -> Response {
    let mut direction = toward_light_in_view(light, camera);
    let response = ball(ui, "Light direction", diameter, light.color, &mut direction);
    if response.changed() {
        set_direction(light, camera, direction);
    }
    response
}

/// The unit vector toward the light in the camera's frame, whatever it is fixed to.
fn toward_light_in_view(light: &EnvironmentLight, camera: &Camera) -> DVec3 {
    in_view(light.direction, light.frame, camera)
}

/// Turns the light to a direction in the camera's frame.
pub(super) fn set_direction(light: &mut EnvironmentLight, camera: &Camera, in_view: DVec3) {
    light.direction = from_view(in_view, light.frame, camera);
}

/// A direction that is fixed to `frame`, in the camera's frame.
pub(super) fn in_view(direction: [f64; 3], frame: LightFrame, camera: &Camera) -> DVec3 {
    let direction = DVec3::from_array(direction).normalize_or(DVec3::Z);
    match frame {
        LightFrame::View => direction,
        LightFrame::Scene => camera.rotation().inverse() * direction,
    }
}

/// A direction in the camera's frame, fixed to `frame`.
pub(super) fn from_view(in_view: DVec3, frame: LightFrame, camera: &Camera) -> [f64; 3] {
    let direction = match frame {
        LightFrame::View => in_view,
        LightFrame::Scene => camera.rotation() * in_view,
    };
    direction.normalize_or(DVec3::Z).to_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_deep_in_the_set_is_told_in_view_units() {
        let mut camera = Camera::default();
        let near_by = PointLight { position: camera.position.clone(), ..Default::default() };
        assert_eq!(length_of_intensity(&near_by, &camera), 1.0);
        camera.pivot = camera.position.moved_by(DVec3::Y * 1e-20, 0.0);
        assert_eq!(length_of_intensity(&near_by, &camera), 1e-20);
        assert_eq!(length_of_intensity(&PointLight::default(), &camera), 1.0);
    }

    #[test]
    fn a_direction_survives_both_frames() {
        let camera = Camera::default();
        let wanted = DVec3::new(0.2, -0.7, 0.4).normalize();
        for frame in [LightFrame::Scene, LightFrame::View] {
            let mut light = EnvironmentLight { frame, ..Default::default() };
            set_direction(&mut light, &camera, wanted);
            assert!((toward_light_in_view(&light, &camera) - wanted).length() < 1e-12);
        }
    }
}
