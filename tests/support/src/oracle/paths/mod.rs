//! Oracle: light paths in f64 (J. Kajiya, The Rendering Equation, SIGGRAPH 1986).
//!
//! [`Paths::traced`] follows the same paths as the kernels: the same random numbers select the same directions.
//! [`Paths::plain`] has other directions, evenly spread, and chooses neither lights nor ends: it knows only what light
//! is there.
//!
//! | module | contents |
//! |---|---|
//! | `numbers` | the random numbers of a path |
//! | `field` | rays that meet the surface, normals, shadow rays |
//! | `material` | reflection by a material |
//! | `lights` | single lights, the sun, the sky |

pub mod field;
pub mod lights;
pub mod material;
pub mod numbers;

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use mandelight::{
    formula::mandelbulb::Mandelbulb,
    render::{Region, lattice, uniforms::Inputs},
    scene::{ColorSource, Coloring, GradientStop, Scene, SurfaceModel, color::luminance},
};

use self::{
    field::{Distance, Field, GAP, Hit, PATH_CONE, Ray},
    lights::{Light, Sky, lights_of},
    material::{Bsdf, Material, turned_about},
    numbers::{Numbers, Purpose},
};
use super::{
    light,
    rays::{self, Size},
};
use crate::random::Random;

/// Bounces before a path may end at random.
const SURE_BOUNCES: u32 = 2;

/// The light paths of a picture.
pub struct Paths {
    scene: Scene,
    size: Size,
    field: Field,
    lights: Vec<Light>,
    sky: Option<Sky>,
    /// Longest ray between two surfaces.
    reach: f64,
}

/// A surface point, as a path sees it.
struct Vertex {
    /// Off the surface by two hit distances.
    point: DVec3,
    hit: f64,
    /// On the viewer's side.
    n: DVec3,
    bsdf: Bsdf,
    emission: DVec3,
}

/// Light from a direction, if nothing within a distance blocks it.
struct Ahead {
    radiance: DVec3,
    direction: DVec3,
    blocked_within: f64,
}

/// The scene with as many iterations as its picture has.
pub fn drawn(scene: &Scene, size: Size) -> Scene {
    let mut scene = scene.clone();
    scene.fractal.iterations = Inputs::new(&scene, Region::whole(size)).frame.march.iterations;
    scene
}

impl Paths {
    /// The paths of a [`drawn`] scene, with its distance estimate.
    pub fn new(scene: Scene, size: Size, distance: Distance) -> Self {
        let field = Field::new(&scene, distance);
        let (lights, sky) = lights_of(&scene);
        let unit = scene.camera.view_unit();
        let reach = scene.integrator.reach.map_or(f64::INFINITY, |views| views * unit);
        Self { scene, size, field, lights, sky, reach }
    }

    /// The ray through a place of a pixel, 0 to 1.
    fn camera_ray(&self, [x, y]: [u32; 2], [across, down]: [f64; 2]) -> Ray {
        let camera = &self.scene.camera;
        let place = [f64::from(x) + across, f64::from(y) + down];
        Ray {
            origin: camera.position.to_dvec3(),
            direction: rays::direction_at(camera, self.size, place),
            radius: 0.0,
            spread: rays::hit_distance(&self.scene, self.size, 1.0),
            clear: 0.0,
        }
    }

    /// The ray from a vertex on.
    fn next_ray(&self, vertex: &Vertex, direction: DVec3) -> Ray {
        let policy = &self.field.policy;
        Ray {
            origin: vertex.point,
            direction,
            radius: f64::from(policy.shadow_margin) * vertex.hit,
            spread: f64::from(PATH_CONE * policy.shadow_cone),
            // Its own surface does not shade a point.
            clear: vertex.hit,
        }
    }

    /// The vertex where `ray` ends. In a gap that is finer than the ray, the hit distance doubles.
    fn vertex(&self, hit: &Hit, ray: &Ray) -> Vertex {
        let wo = -ray.direction;
        let is_in_gap = ray.clear > 0.0 && hit.depth < GAP * ray.clear;
        let radius = if is_in_gap { 2.0 * ray.clear } else { hit.radius };
        let outward = self.field.normal(hit, wo);
        // At silhouettes the normal leans away.
        let short = 1e-3 - outward.dot(wo);
        let n = if short > 0.0 { (outward + short * wo).normalize() } else { outward };
        let (material, emission) = self.material(hit.point, outward);
        let point = hit.point + 2.0 * radius * outward;
        Vertex { point, hit: radius, n, bsdf: material.seen(n, wo), emission }
    }

    /// How a point reflects, and the radiance that it emits.
    fn material(&self, point: DVec3, normal: DVec3) -> (Material, DVec3) {
        let surface = &self.scene.surface;
        let second = &surface.second_layer;
        let layer = |coloring: &Coloring, stops: &[GradientStop]| {
            light::layer_color(coloring, stops, self.color_value(coloring, point, normal))
        };
        let over = layer(&second.coloring, &second.gradient);
        let color = layer(&surface.coloring, &surface.gradient).lerp(over, second.amount);
        let driven = &surface.driven_by_layer;
        let of =
            |value: f64, is_driven: bool| if is_driven { value * luminance(over) } else { value };
        let emission = surface.emission * if driven.emission { over } else { color };
        let material = match surface.model {
            SurfaceModel::BlinnPhong => Material::BlinnPhong {
                diffuse: surface.diffuse * color,
                specular: surface.specular,
                exponent: surface.shininess,
            },
            SurfaceModel::Physical => Material::Physical {
                color,
                metalness: of(surface.metalness, driven.metalness),
                specular_color: DVec3::from(surface.specular_color.map(f64::from)),
                roughness: of(surface.roughness, driven.roughness),
                coat: of(surface.coat, driven.coat),
                coat_roughness: surface.coat_roughness,
            },
        };
        (material, emission)
    }

    fn color_value(&self, coloring: &Coloring, point: DVec3, normal: DVec3) -> f64 {
        let axis = coloring.axis.direction();
        match coloring.source {
            ColorSource::Position => 0.5 + 0.5 * point.dot(axis) / self.field.bounding_radius,
            ColorSource::Normal => 0.5 + 0.5 * normal.dot(axis),
            // Of orbits, those of the Mandelbulb.
            _ => light::color_value(&Mandelbulb::of(&self.scene.fractal), coloring, point, normal),
        }
    }

    /// The radiance of one path, from the camera on.
    pub fn traced(&self, pixel: [u32; 2], index: u32) -> DVec3 {
        // The first sample of a pixel is that of its centre, and no path.
        let place = lattice::jitter(index + 1).map(f64::from);
        let mut ray = self.camera_ray(pixel, place);
        let Some(mut hit) = self.field.meet(&ray, f64::INFINITY) else {
            let height = (f64::from(pixel[1]) + place[1]) / f64::from(self.size[1]);
            return light::background(&self.scene, height);
        };
        let numbers = Numbers { pixel, index };
        let (mut sum, mut throughput) = (DVec3::ZERO, DVec3::ONE);
        for bounce in 0.. {
            let vertex = self.vertex(&hit, &ray);
            sum += throughput * vertex.emission;
            let pair = |purpose| numbers.pair(bounce, purpose);
            if let Some(light) = self.light_by_choice(&vertex, &pair)
                && self.is_open(&vertex, &light)
            {
                sum += throughput * light.radiance;
            }
            let lobe = pair(Purpose::Lobe);
            let direction = vertex.bsdf.sample(lobe.x, pair(Purpose::Direction));
            let density = vertex.bsdf.density(direction);
            if density <= 0.0 {
                break;
            }
            throughput *= vertex.bsdf.value(direction) / density;
            let ahead = self.light_ahead(&vertex, direction, density, pair(Purpose::Light).y);
            let is_last = bounce == self.scene.integrator.bounces;
            if !is_last && bounce >= SURE_BOUNCES {
                let survival = throughput.max_element().min(1.0);
                if lobe.y >= survival {
                    break;
                }
                throughput /= survival;
            }
            ray = self.next_ray(&vertex, direction);
            let next = self.field.meet(&ray, f64::INFINITY);
            if next.is_none_or(|next| next.depth >= ahead.blocked_within) {
                sum += throughput * ahead.radiance;
            }
            match next.filter(|next| next.depth < self.reach && !is_last) {
                Some(next) => hit = next,
                None => break,
            }
        }
        sum
    }

    /// The radiance of one path whose directions are spread evenly, by cosine, whatever shines or reflects there.
    pub fn plain(&self, pixel: [u32; 2], index: u32, random: &mut Random) -> DVec3 {
        let place = lattice::jitter(index + 1).map(f64::from);
        let mut ray = self.camera_ray(pixel, place);
        let Some(mut hit) = self.field.meet(&ray, f64::INFINITY) else {
            let height = (f64::from(pixel[1]) + place[1]) / f64::from(self.size[1]);
            return light::background(&self.scene, height);
        };
        let (mut sum, mut throughput) = (DVec3::ZERO, DVec3::ONE);
        for _ in 0..=self.scene.integrator.bounces {
            let vertex = self.vertex(&hit, &ray);
            sum += throughput * vertex.emission;
            let cones: Vec<_> =
                self.lights.iter().map(|light| (light, light.seen_from(vertex.point))).collect();
            // Lights without a size come from one direction each.
            for (light, cone) in cones.iter().filter(|(_, cone)| cone.height == 0.0) {
                let radiance = PI * cone.irradiance * vertex.bsdf.value(cone.axis);
                let blocked_within = light.blocked_within(cone.distance(cone.axis));
                let ahead = Ahead { radiance, direction: cone.axis, blocked_within };
                if radiance != DVec3::ZERO && self.is_open(&vertex, &ahead) {
                    sum += throughput * radiance;
                }
            }
            let direction = turned_about(vertex.n, random.unit().sqrt(), random.unit());
            if direction.dot(vertex.n) <= 0.0 {
                break;
            }
            throughput *= vertex.bsdf.value(direction) * (PI / vertex.n.dot(direction));
            ray = self.next_ray(&vertex, direction);
            let next = self.field.meet(&ray, f64::INFINITY);
            let is_seen = |within: f64| next.is_none_or(|next| next.depth >= within);
            if let Some(sky) = self.sky.as_ref().filter(|sky| is_seen(sky.reach)) {
                sum += throughput * sky.radiance(direction);
            }
            for (light, cone) in cones.iter().filter(|(_, cone)| cone.height > 0.0) {
                if cone.holds(direction) && is_seen(light.blocked_within(cone.distance(direction)))
                {
                    sum += throughput * cone.radiance();
                }
            }
            match next.filter(|next| next.depth < self.reach) {
                Some(next) => hit = next,
                None => break,
            }
        }
        sum
    }

    fn is_open(&self, vertex: &Vertex, light: &Ahead) -> bool {
        self.field.is_open(vertex.point, vertex.hit, light.direction, light.blocked_within)
    }

    /// The sky's share in the choice of a light, and those of the single lights.
    fn shares(&self, vertex: &Vertex) -> (f64, Vec<f64>) {
        let sky = self.sky.as_ref().map_or(0.0, |sky| sky.importance);
        let of = |light: &Light| light.seen_from(vertex.point).importance(vertex.n);
        let lights: Vec<_> = self.lights.iter().map(of).collect();
        let whole = sky + lights.iter().sum::<f64>();
        let part = |importance: f64| if whole > 0.0 { importance / whole } else { 0.0 };
        (part(sky), lights.into_iter().map(part).collect())
    }

    /// The light of one light, chosen by its share, reflected to the viewer.
    ///
    /// Samples of lights and of surfaces are weighted by the balance heuristic (E. Veach, 1997, section 9.2.2).
    fn light_by_choice(&self, vertex: &Vertex, pair: &dyn Fn(Purpose) -> DVec2) -> Option<Ahead> {
        let (sky_share, shares) = self.shares(vertex);
        let mut left = pair(Purpose::Light).x - sky_share;
        if left < 0.0 {
            let sky = self.sky.as_ref()?;
            let (direction, density) = sky.sample(pair(Purpose::Cell), pair(Purpose::Place));
            let density = sky_share * density;
            let weight = density / (density + vertex.bsdf.density(direction));
            let radiance =
                sky.radiance(direction) * vertex.bsdf.value(direction) * (weight / density);
            return Some(Ahead { radiance, direction, blocked_within: sky.reach });
        }
        let is_chosen = |share: f64| {
            left -= share;
            share > 0.0 && left < 0.0
        };
        let chosen = shares.iter().copied().position(is_chosen);
        let chosen = chosen.or_else(|| shares.iter().rposition(|share| *share > 0.0))?;
        let (light, share) = (&self.lights[chosen], shares[chosen]);
        let cone = light.seen_from(vertex.point);
        if cone.height == 0.0 {
            let radiance = PI / share * cone.irradiance;
            let radiance = radiance * vertex.bsdf.value(cone.axis);
            let blocked_within = light.blocked_within(cone.distance(cone.axis));
            return Some(Ahead { radiance, direction: cone.axis, blocked_within });
        }
        let direction = cone.sample(pair(Purpose::Place));
        let density = share * cone.density();
        let weight = density / (density + vertex.bsdf.density(direction));
        let radiance = cone.radiance() * vertex.bsdf.value(direction) * (weight / density);
        let blocked_within = light.blocked_within(cone.distance(direction));
        Some(Ahead { radiance, direction, blocked_within })
    }

    /// The weighted light of the lights in a direction: of several one, chosen by luminance.
    fn light_ahead(&self, vertex: &Vertex, direction: DVec3, density: f64, u: f64) -> Ahead {
        let (sky_share, shares) = self.shares(vertex);
        let mut all = Vec::new();
        if let Some(sky) = &self.sky {
            let weight = density / (density + sky_share * sky.density(direction));
            all.push((weight * sky.radiance(direction), sky.reach));
        }
        for (light, share) in self.lights.iter().zip(shares) {
            let cone = light.seen_from(vertex.point);
            if share > 0.0 && cone.holds(direction) {
                let weight = density / (density + share * cone.density());
                let blocked_within = light.blocked_within(cone.distance(direction));
                all.push((weight * cone.radiance(), blocked_within));
            }
        }
        // Each light in turn takes the place of those before it with its part of the light so far.
        let (mut chosen, mut whole, mut left) = (0, 0.0, u);
        for (index, (radiance, _)) in all.iter().enumerate() {
            whole += luminance(*radiance);
            if index == 0 {
                continue;
            }
            let part = if whole > 0.0 { luminance(*radiance) / whole } else { 0.0 };
            if left < part {
                (chosen, left) = (index, left / part);
            } else {
                left = (left - part) / (1.0 - part);
            }
        }
        let Some((radiance, blocked_within)) = all.get(chosen).copied() else {
            return Ahead { radiance: DVec3::ZERO, direction, blocked_within: 0.0 };
        };
        let scaled = if whole > 0.0 { whole / luminance(radiance) } else { 0.0 };
        Ahead { radiance: radiance * scaled, direction, blocked_within }
    }
}
