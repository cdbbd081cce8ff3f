//! The uniforms of the camera, its lens and its eyes.

use glam::DVec3;

use super::shared::{Camera, Eyes};
use crate::{
    fractal::pixel_cone,
    render::{Region, region::Eyes as RegionEyes, space::RenderSpace},
    scene::{self, Scene},
};

/// Distance from the surface at which colours are taken, over the height that the picture shows there.
///
/// The hit distance of a picture 150 pixels high. Pictures of any greater height take colours at the same
/// points; a smaller distance would show finer bands of colour, but only in higher pictures.
const COLOR_DISTANCE: f64 = 1.0 / 300.0;

/// The camera in the render space `space`.
pub fn camera(scene: &Scene, region: Region, space: &RenderSpace) -> Camera {
    let (camera, aspect) = (&scene.camera, region.aspect());
    let half_height = camera.half_height(aspect);
    let height = f64::from(region.picture_px[1]);
    let rotation = camera.rotation();
    let view_unit = camera.view_unit() / space.scale();
    // Without a lens the uniforms must not change with the focus or the pivot.
    let focus = if camera.lens.depth_of_field { camera.lens.focus * view_unit } else { 0.0 };
    let blades = if camera.lens.depth_of_field { camera.lens.blades } else { 0 };
    Camera {
        origin: space.point(&camera.position).as_vec3().to_array(),
        half_height: half_height as f32,
        right: (rotation * DVec3::X).as_vec3().to_array(),
        aspect: aspect as f32,
        up: (rotation * DVec3::Y).as_vec3().to_array(),
        hit_cone: (scene.quality.detail * pixel_cone(camera, aspect, height)) as f32,
        forward: camera.forward().as_vec3().to_array(),
        color_cone: (COLOR_DISTANCE * 2.0 * half_height) as f32,
        lens_radius: (camera.lens.radius(half_height) * view_unit) as f32,
        focus: focus as f32,
        blades,
    }
}

/// The eyes that a region shows.
pub fn eyes(camera: &scene::Camera, region: Region, space: &RenderSpace) -> Eyes {
    let stereo = &camera.stereo;
    // With swapped eyes, the left picture shows the right eye.
    let left = if stereo.swap_eyes { 1.0 } else { -1.0 };
    // Without stereo the separation has no effect: the uniforms must not change with it or the pivot.
    let half_shift = match region.eyes {
        RegionEyes::Camera => 0.0,
        _ => stereo.half_separation(),
    };
    Eyes {
        second_at: region.second_eye_at(),
        count: region.eyes.count(),
        first_side: match region.eyes {
            RegionEyes::Camera => 0.0,
            RegionEyes::Right => -left,
            RegionEyes::Left
            | RegionEyes::Beside
            | RegionEyes::Below
            | RegionEyes::Anaglyph
            | RegionEyes::WideAnaglyph => left,
        },
        half_separation: (half_shift * camera.view_unit() / space.scale()) as f32,
        half_shift: half_shift as f32,
        share: region.eyes.on_sheet().map(|eyes| 1.0 / eyes as f32),
        first_place: if region.eyes == RegionEyes::Right { 1.0 } else { 0.0 },
        anaglyph: u32::from(region.eyes.is_anaglyph()),
    }
}
