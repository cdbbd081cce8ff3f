//! The lights of a path: single lights, the sun, the sky; what each sends, and how often it is chosen.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec2, DVec3};
use mandelight::{
    render::sky::SampledSky,
    scene::{LightFrame, RigKind, Scene, color::luminance},
};

use super::material::turned_about;

/// Distance of what is far away.
const FAR: f64 = 1e30;

/// One light.
#[derive(Clone, Copy, Debug)]
pub struct Light {
    place: Place,
    /// Irradiance of a surface that faces the light, over pi; of a point light at a distance of 1.
    pub strength: DVec3,
    /// Greatest distance of a blocker; none if nothing blocks the light.
    reach: Option<f64>,
}

#[derive(Clone, Copy, Debug)]
enum Place {
    /// A direction, and the sine of the half angle about it.
    Far(DVec3, f64),
    /// A place and a radius.
    Near(DVec3, f64),
}

/// A light as a point sees it.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Unit vector toward the centre.
    pub axis: DVec3,
    /// 1 minus the cosine of the half angle; 0 for lights without a size.
    pub height: f64,
    distance: f64,
    radius: f64,
    /// Irradiance of a surface that faces the light, over pi.
    pub irradiance: DVec3,
}

impl Light {
    /// The light as a point outside it sees it.
    pub fn seen_from(&self, point: DVec3) -> Cone {
        let (axis, distance, sine, radius, falls) = match self.place {
            Place::Far(axis, sine) => (axis, FAR, sine, 0.0, 1.0),
            Place::Near(place, radius) => {
                let way = place - point;
                let distance = way.length();
                assert!(distance > radius, "points in a light have no oracle");
                (way / distance, distance, radius / distance, radius, distance * distance)
            }
        };
        // Without cancellation for small angles.
        let height = sine * sine / (1.0 + (1.0 - sine * sine).sqrt());
        Cone { axis, height, distance, radius, irradiance: self.strength / falls }
    }

    /// Greatest distance of a blocker, for a light whose face is at `distance`.
    pub fn blocked_within(&self, distance: f64) -> f64 {
        self.reach.map_or(0.0, |reach| reach.min(distance))
    }
}

impl Cone {
    fn sine(&self) -> f64 {
        (self.height * (2.0 - self.height)).sqrt()
    }

    /// Share in the choice of a light.
    pub fn importance(&self, n: DVec3) -> f64 {
        luminance(self.irradiance) * (n.dot(self.axis) + self.sine()).clamp(0.0, 1.0)
    }

    /// Whether the face of a light with a size lies in a direction.
    pub fn holds(&self, direction: DVec3) -> bool {
        0.5 * direction.distance_squared(self.axis) < self.height
    }

    /// Density over solid angle of sampled directions, of lights with a size.
    pub fn density(&self) -> f64 {
        1.0 / (TAU * self.height)
    }

    /// Radiance of the face, even over the cone.
    pub fn radiance(&self) -> DVec3 {
        // The irradiance of a facing surface is π sin² times the radiance.
        self.irradiance / self.sine().powi(2)
    }

    /// A direction, evenly by solid angle.
    pub fn sample(&self, at: DVec2) -> DVec3 {
        turned_about(self.axis, 1.0 - at.x * self.height, at.y)
    }

    /// Distance of the face in a direction.
    pub fn distance(&self, direction: DVec3) -> f64 {
        if self.radius == 0.0 {
            return self.distance;
        }
        let along = self.distance * direction.dot(self.axis);
        let beside_squared = self.distance * self.distance - along * along;
        along - (self.radius * self.radius - beside_squared).max(0.0).sqrt()
    }
}

/// The sky, without its sun.
#[derive(Clone, Debug)]
pub struct Sky {
    /// Texels as they are stored: rows from the top.
    texels: Vec<DVec3>,
    size: [usize; 2],
    table: SampledSkyTable,
    world_from_sky: DQuat,
    gain: f64,
    /// Share in the choice of a light: half the irradiance from all sides, over pi.
    pub importance: f64,
    /// Greatest distance of a blocker.
    pub reach: f64,
}

#[derive(Clone, Debug)]
struct SampledSkyTable {
    cells: Vec<[u32; 4]>,
    size: [usize; 2],
}

impl SampledSkyTable {
    fn density(&self, cell: usize) -> f64 {
        f64::from(f32::from_bits(self.cells[cell][2]))
    }
}

impl Sky {
    /// Radiance from a direction: the texels about it, bilinearly; azimuths repeat.
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        let d = self.world_from_sky.inverse() * direction;
        let [width, height] = self.size.map(|side| side as f64);
        let x = (d.x.atan2(d.y) / TAU + 0.5) * width - 0.5;
        let y = DVec2::new(d.x, d.y).length().atan2(d.z) / PI * height - 0.5;
        let texel = |x: f64, y: f64| {
            let (x, y) = (x.rem_euclid(width), y.clamp(0.0, height - 1.0));
            self.texels[y as usize * self.size[0] + x as usize]
        };
        let row = |y: f64| texel(x.floor(), y).lerp(texel(x.floor() + 1.0, y), x - x.floor());
        self.gain * row(y.floor()).lerp(row(y.floor() + 1.0), y - y.floor())
    }

    /// Density over solid angle of sampled directions.
    pub fn density(&self, direction: DVec3) -> f64 {
        let d = self.world_from_sky.inverse() * direction;
        let [columns, rows] = self.table.size;
        let place = |part: f64, count: usize| ((part * count as f64) as usize).min(count - 1);
        let column = place((d.x.atan2(d.y) / TAU + 0.5).rem_euclid(1.0), columns);
        self.table.density(place(0.5 - 0.5 * d.z, rows) * columns + column)
    }

    /// A direction and its density: a cell by the alias method, and a place in it.
    pub fn sample(&self, cell: DVec2, place: DVec2) -> (DVec3, f64) {
        let SampledSkyTable { cells, size: [columns, rows] } = &self.table;
        let mut index = ((cell.x * cells.len() as f64) as usize).min(cells.len() - 1);
        if cell.y >= f64::from(f32::from_bits(cells[index][1])) {
            index = cells[index][0] as usize;
        }
        let x = ((index % columns) as f64 + place.x) / *columns as f64;
        let z = 1.0 - 2.0 * ((index / columns) as f64 + place.y) / *rows as f64;
        let (sine, cosine) = (TAU * (x - 0.5)).sin_cos();
        let aside = (1.0 - z * z).sqrt();
        let d = DVec3::new(aside * sine, aside * cosine, z);
        (self.world_from_sky * d, self.table.density(index))
    }
}

/// A colour as nine bits a channel with a shared exponent of five bits keep it.
fn shared_exponent(color: DVec3) -> DVec3 {
    let largest = color.max_element();
    if largest <= 0.0 {
        return DVec3::ZERO;
    }
    let step = |exponent: f64| (exponent - 9.0).exp2();
    let exponent = (largest.log2().floor() + 1.0).max(-15.0);
    let is_full = (largest / step(exponent)).round() >= 512.0;
    let step = step(if is_full { exponent + 1.0 } else { exponent });
    (color / step).round() * step
}

/// The single lights of a scene, with the sun, and its sky.
///
/// Environment maps, switched off lights and lights that follow the view have no oracle.
pub fn lights_of(scene: &Scene) -> (Vec<Light>, Option<Sky>) {
    let lights = &scene.lights;
    assert!(!lights.any_solo() && !lights.follow_view, "no oracle of such lights");
    let unit = scene.camera.view_unit();
    let rgb = |color: [f32; 3]| DVec3::from(color.map(f64::from));
    let turn = |frame: LightFrame| match frame {
        LightFrame::Scene => DQuat::IDENTITY,
        LightFrame::View => scene.camera.rotation(),
    };
    let reach = |casts: bool, reach: Option<f64>| {
        (casts && scene.quality.shadows).then(|| reach.map_or(FAR, |views| views * unit))
    };
    let half_sine = |degrees: f64| (0.5 * degrees).to_radians().sin();
    let environment = lights.environment.iter().map(|light| Light {
        place: Place::Far(
            turn(light.frame) * DVec3::from(light.direction).normalize(),
            half_sine(light.size_deg),
        ),
        strength: rgb(light.color) * light.intensity,
        reach: reach(light.casts_shadows, light.shadow_reach),
    });
    let near = lights.point.iter().map(|light| Light {
        place: Place::Near(light.position.to_dvec3(), light.radius),
        strength: rgb(light.color) * light.intensity,
        reach: reach(light.casts_shadows, None),
    });
    let mut all: Vec<_> = environment.chain(near).collect();
    let rig = &lights.rig;
    if rig.kind == RigKind::None {
        return (all, None);
    }
    assert!(rig.kind == RigKind::Sky, "no oracle of environment maps");
    let world_from_sky = turn(rig.frame);
    // Surfaces beyond the paths' reach hide no sky.
    let rig_reach = reach(rig.casts_shadows, rig.shadow_reach)
        .map(|rig| scene.integrator.reach.map_or(rig, |paths| rig.min(paths * unit)));
    all.push(Light {
        place: Place::Far(
            world_from_sky * DVec3::from(rig.sky.sun_direction),
            half_sine(rig.sky.sun_size_deg),
        ),
        strength: rgb(rig.sky.sun_color) * (rig.sky.sun_strength * rig.intensity),
        reach: rig_reach,
    });
    let sampled = SampledSky::of_gradient(&rig.sky);
    let map = sampled.map();
    let sky = Sky {
        texels: map.pixels().iter().map(|texel| shared_exponent(texel.as_dvec3())).collect(),
        size: map.size_px().map(|side| side as usize),
        table: SampledSkyTable {
            cells: sampled.cells().to_vec(),
            size: sampled.size().map(|side| side as usize),
        },
        world_from_sky,
        gain: rig.intensity,
        importance: 0.5 * rig.intensity * sampled.energy() / PI,
        reach: rig_reach.unwrap_or(0.0),
    };
    (all, Some(sky))
}
