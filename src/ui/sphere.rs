//! A small sphere as a scene's surface, lights and tone would show it: what a look does, without a render.

use egui::{Color32, Mesh, Painter, Pos2, Rect, Shape, lerp, pos2, vec2};
use glam::DVec3;

use super::theme;
use crate::scene::{
    Background, ColorSource, Coloring, GradientStop, LightFrame, Scene, Surface, SurfaceModel,
    Tone,
    color::{gradient_at, luminance},
};

/// Circles of vertices around the middle.
const RINGS: usize = 14;
/// Vertices of a circle.
const SECTORS: usize = 32;
/// Radius of the sphere, as a part of the painting's height.
const RADIUS: f32 = 0.41;
/// The direction in the view along which the first gradient runs.
const FIRST_AXIS: DVec3 = DVec3::new(0.5, 0.8, 0.33);
/// The point of the sphere around which the second gradient runs, unless it follows directions.
const SECOND_CENTER: DVec3 = DVec3::new(-0.35, 0.25, 0.9);

/// A painting of the sphere in front of the background.
#[derive(Clone, Debug)]
pub struct Sphere {
    background: [Color32; 2],
    /// The middle, then the circles from the inner to the outer.
    colors: Vec<Color32>,
    /// Colour and width of the bloom, the width as a part of the painting's height.
    glow: (Color32, f32),
}

/// A light of the view: unit vector toward the light, and strength.
type Light = (DVec3, DVec3);

impl Sphere {
    /// The sphere in the look of `scene`.
    pub fn of(scene: &Scene) -> Self {
        let lights = lights(scene);
        let exposure = scene.tone.exposure.exp2();
        let radiance: Vec<DVec3> =
            vertices().map(|n| radiance(scene, n, &lights) * exposure).collect();
        let bloom = &scene.bloom;
        let bright = |light: &DVec3| luminance(*light) > bloom.threshold;
        let blooming: DVec3 = radiance.iter().filter(|light| bright(light)).sum();
        let glow = scene.tone.displayed(blooming / radiance.len() as f64 * (4.0 * bloom.strength));
        Self {
            background: background_colors(&scene.background, &scene.tone),
            colors: radiance.iter().map(|light| display(&scene.tone, *light)).collect(),
            glow: (display_color(glow), 4.0 * bloom.radius as f32),
        }
    }

    /// Paints the sphere into `rect`.
    pub fn paint(&self, painter: &Painter, rect: Rect) {
        paint_background(painter, rect, self.background);
        let (center, radius) = (rect.center(), RADIUS * rect.height());
        let mut mesh = Mesh::default();
        let [top, bottom] = self.background;
        let behind = top.lerp_to_gamma(bottom, 0.5);
        let lit = Color32::from_rgb(
            behind.r().max(self.glow.0.r()),
            behind.g().max(self.glow.0.g()),
            behind.b().max(self.glow.0.b()),
        );
        let outer = (radius * (1.0 + self.glow.1)).min(rect.height() / 2.0);
        ring(&mut mesh, center, [radius, outer], |_| [lit, Color32::TRANSPARENT]);
        mesh.colored_vertex(center, self.colors[0]);
        let middle = mesh.vertices.len() as u32 - 1;
        for (i, color) in self.colors.iter().enumerate().skip(1) {
            let (ring, sector) = ((i - 1) / SECTORS + 1, (i - 1) % SECTORS);
            let at = angle_of(ring).sin() as f32 * radius;
            mesh.colored_vertex(center + at * toward(sector), *color);
        }
        let index = |ring: usize, sector: usize| {
            middle + 1 + ((ring - 1) * SECTORS + sector % SECTORS) as u32
        };
        for sector in 0..SECTORS {
            mesh.add_triangle(middle, index(1, sector), index(1, sector + 1));
            for ring in 1..RINGS {
                let [a, b] = [index(ring, sector), index(ring, sector + 1)];
                let [c, d] = [index(ring + 1, sector), index(ring + 1, sector + 1)];
                mesh.add_triangle(a, c, d);
                mesh.add_triangle(a, d, b);
            }
        }
        // Meshes have no smooth edges of their own.
        let edge = self.colors.len() - SECTORS;
        ring(&mut mesh, center, [radius, radius + 1.0], |sector| {
            [self.colors[edge + sector % SECTORS], Color32::TRANSPARENT]
        });
        painter.with_clip_rect(rect.intersect(painter.clip_rect())).add(Shape::mesh(mesh));
    }
}

/// Adds a flat ring between two radii, with a colour at each.
fn ring(mesh: &mut Mesh, center: Pos2, radii: [f32; 2], colors: impl Fn(usize) -> [Color32; 2]) {
    let first = mesh.vertices.len() as u32;
    for sector in 0..=SECTORS {
        for (radius, color) in radii.into_iter().zip(colors(sector)) {
            mesh.colored_vertex(center + radius * toward(sector), color);
        }
    }
    for k in (first..first + 2 * SECTORS as u32).step_by(2) {
        mesh.add_triangle(k, k + 1, k + 2);
        mesh.add_triangle(k + 1, k + 3, k + 2);
    }
}

/// The direction of a sector on the screen, whose y points down.
fn toward(sector: usize) -> egui::Vec2 {
    let angle = sector as f32 / SECTORS as f32 * std::f32::consts::TAU;
    vec2(angle.cos(), -angle.sin())
}

/// Angle between a circle's normals and the direction to the viewer, in radians.
fn angle_of(ring: usize) -> f64 {
    ring as f64 / RINGS as f64 * std::f64::consts::FRAC_PI_2
}

/// The normals of all vertices, in the view.
fn vertices() -> impl Iterator<Item = DVec3> {
    let circles = (1..=RINGS).flat_map(|ring| {
        let (sin, cos) = angle_of(ring).sin_cos();
        (0..SECTORS).map(move |sector| {
            let at = toward(sector);
            DVec3::new(sin * f64::from(at.x), -sin * f64::from(at.y), cos)
        })
    });
    std::iter::once(DVec3::Z).chain(circles)
}

/// The scene's lights at the pivot, in the view.
fn lights(scene: &Scene) -> Vec<Light> {
    let Scene { camera, lights, .. } = scene;
    let in_view = |frame: LightFrame, direction: DVec3| {
        LightFrame::View.from_world(frame.to_world(direction, camera), camera)
    };
    let rgb = |color: [f32; 3]| DVec3::from_array(color.map(f64::from));
    let any_solo = lights.any_solo();
    let environment =
        lights.environment.iter().filter(|light| light.shines(any_solo)).map(|light| {
            let toward = in_view(light.frame, DVec3::from_array(light.direction));
            (toward, rgb(light.color) * light.intensity)
        });
    let point = lights.point.iter().filter(|light| light.shines(any_solo)).map(|light| {
        let offset = &light.position - &camera.pivot;
        let strength = light.intensity / offset.length_squared().max(1e-300);
        let toward = in_view(LightFrame::Scene, offset.normalize_or(DVec3::Z));
        (toward, rgb(light.color) * strength)
    });
    let rig = lights.rig.shines(any_solo).then(|| lights.rig.lights());
    let rig = rig
        .into_iter()
        .flatten()
        .map(|(direction, strength)| (in_view(lights.rig.frame, direction), strength));
    environment.chain(point).chain(rig).collect()
}

/// Light from the sphere's place with the normal `n` in the view.
fn radiance(scene: &Scene, n: DVec3, lights: &[Light]) -> DVec3 {
    let surface = &scene.surface;
    let across = 0.5 + 0.5 * n.dot(FIRST_AXIS.normalize());
    let first = color(&surface.gradient, 0.02 + 0.96 * across);
    let world = scene.camera.rotation() * n;
    let second = layer(surface, n, world);
    let base = first.lerp(second, surface.second_layer.amount);
    let driven =
        |value: f64, is_driven: bool| value * if is_driven { luminance(second) } else { 1.0 };
    let drives = surface.driven_by_layer;
    let glow = if drives.emission { second } else { base };
    let mut sum = surface.emission * glow + surface.ambient * base;
    let metalness = driven(surface.metalness, drives.metalness);
    let roughness = driven(surface.roughness, drives.roughness);
    let coat = driven(surface.coat, drives.coat);
    let reflectance =
        DVec3::from_array(surface.specular_color.map(f64::from)).lerp(base, metalness);
    for (toward, strength) in lights {
        let facing = n.dot(*toward).max(0.0);
        let half = (*toward + DVec3::Z).normalize_or(DVec3::Z);
        let along = n.dot(half).max(0.0);
        sum += *strength
            * match surface.model {
                SurfaceModel::BlinnPhong => {
                    let highlight = surface.specular * along.powf(surface.shininess);
                    surface.diffuse * facing * base + DVec3::splat(highlight)
                }
                SurfaceModel::Physical => {
                    let lobes = reflectance * lobe(roughness, along)
                        + DVec3::splat(0.04 * coat * lobe(surface.coat_roughness, along));
                    facing * ((1.0 - metalness) * base + lobes)
                }
            };
    }
    sum
}

/// GGX's distribution times π/4, which leaves out masking: near enough for a small picture.
fn lobe(roughness: f64, along: f64) -> f64 {
    let square = (roughness * roughness).max(0.02).powi(2);
    let under = along * along * (square - 1.0) + 1.0;
    0.25 * square / (under * under)
}

/// The second layer's colour.
fn layer(surface: &Surface, n: DVec3, world: DVec3) -> DVec3 {
    let layer = &surface.second_layer;
    let Coloring { source, axis, repeats, offset, .. } = &layer.coloring;
    let value = match source {
        ColorSource::Normal => 0.5 + 0.5 * world.dot(axis.direction()),
        _ => 0.9 * (n - SECOND_CENTER.normalize()).length() / std::f64::consts::SQRT_2,
    };
    color(&layer.gradient, repeats * value + offset)
}

fn color(stops: &[GradientStop], position: f64) -> DVec3 {
    DVec3::from_array(gradient_at(stops, position).map(f64::from))
}

fn display(tone: &Tone, exposed: DVec3) -> Color32 {
    display_color(tone.displayed(exposed))
}

fn display_color(linear: DVec3) -> Color32 {
    theme::display_color(linear.to_array().map(|channel| channel as f32))
}

/// The display colours of a background's upper and lower edge.
pub fn background_colors(background: &Background, tone: &Tone) -> [Color32; 2] {
    [background.top, background.bottom]
        .map(|edge| display(tone, DVec3::from_array(edge.map(f64::from)) * tone.exposure.exp2()))
}

/// Paints a vertical gradient.
pub fn paint_background(painter: &Painter, rect: Rect, [top, bottom]: [Color32; 2]) {
    /// Straight lines of encoded colours differ from those of linear ones: a few pieces are close.
    const PIECES: u32 = 8;
    let mut mesh = Mesh::default();
    let [from, to] = [top, bottom].map(egui::Rgba::from);
    for i in 0..=PIECES {
        let t = i as f32 / PIECES as f32;
        let color = Color32::from(from * (1.0 - t) + to * t);
        let y = lerp(rect.y_range(), t);
        mesh.colored_vertex(pos2(rect.left(), y), color);
        mesh.colored_vertex(pos2(rect.right(), y), color);
    }
    for k in (0..2 * PIECES).step_by(2) {
        mesh.add_triangle(k, k + 1, k + 2);
        mesh.add_triangle(k + 1, k + 3, k + 2);
    }
    painter.add(Shape::mesh(mesh));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{EnvironmentLight, PointLight, RigKind};

    #[test]
    fn the_lights_of_the_sphere_are_those_that_shine() {
        let mut scene = Scene::default();
        scene.lights.environment = vec![EnvironmentLight::default(); 2];
        scene.lights.point = vec![PointLight::default()];
        scene.lights.rig.kind = RigKind::Sky;
        let of_sky = scene.lights.rig.lights().len();
        assert!(of_sky > 0);
        assert_eq!(lights(&scene).len(), 3 + of_sky);
        scene.lights.rig.muted = true;
        assert_eq!(lights(&scene).len(), 3);
        scene.lights.rig.muted = false;
        scene.lights.environment[1].solo = true;
        assert_eq!(lights(&scene).len(), 1);
        scene.lights.environment[1].muted = true;
        assert!(lights(&scene).is_empty());
    }
}
