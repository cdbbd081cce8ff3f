//! The uniforms of the surface: its material, and the planes that cut it.

use super::{Sections, Surface};
use crate::{
    formula::section::MAX_SECTION_PLANES,
    render::space::RenderSpace,
    scene::{MediumKind, Scene, SurfaceModel, follow},
};

/// The material of a scene's surface, and the number of its lights.
pub fn surface(scene: &Scene) -> Surface {
    let surface = &scene.surface;
    if scene.medium.kind != MediumKind::None {
        return translucent(scene);
    }
    let driven = surface.driven_by_layer;
    let drives = [driven.roughness, driven.metalness, driven.coat, driven.emission];
    Surface {
        ambient: surface.ambient as f32,
        diffuse: surface.diffuse as f32,
        specular: surface.specular as f32,
        shininess: surface.shininess as f32,
        light_count: light_count(scene),
        model: match surface.model {
            SurfaceModel::BlinnPhong => 0,
            SurfaceModel::Physical => 1,
        },
        roughness: surface.roughness as f32,
        metalness: surface.metalness as f32,
        specular_color: surface.specular_color,
        coat: surface.coat as f32,
        coat_roughness: surface.coat_roughness as f32,
        emission: surface.emission as f32,
        driven: (0..).zip(drives).fold(0, |bits, (bit, drives)| bits | u32::from(drives) << bit),
    }
}

/// A matte surface, which direct light draws in place of a medium.
fn translucent(scene: &Scene) -> Surface {
    Surface {
        ambient: scene.surface.ambient as f32,
        diffuse: 1.0,
        shininess: 1.0,
        light_count: light_count(scene),
        ..Surface::default()
    }
}

fn light_count(scene: &Scene) -> u32 {
    follow::effective(&scene.lights, &scene.camera).len() as u32
}

/// Greatest distance of a plane from the origin, in render space, so that sums keep within f32.
const FARTHEST_PLANE: f64 = 1e30;

/// The planes that cut the set open.
pub fn sections(scene: &Scene, space: &RenderSpace) -> Sections {
    let planes = &scene.fractal.section_planes;
    let mut sections = Sections {
        inside: scene.surface.sections.inside,
        count: planes.len() as u32,
        repeats: scene.surface.sections.repeats as f32,
        ..Sections::default()
    };
    for (k, plane) in planes.iter().take(MAX_SECTION_PLANES).enumerate() {
        let normal = plane.normal();
        let offset = normal.dot(space.point(&plane.point));
        let offset = offset.clamp(-FARTHEST_PLANE, FARTHEST_PLANE);
        sections.planes[k] = normal.extend(offset).as_vec4().to_array();
        sections.band_reach[k] = (plane.band_reach / space.scale()).min(FARTHEST_PLANE) as f32;
    }
    sections
}
