//! Oracle: Blinn-Phong, the gradient, exposure, sRGB.

use glam::DVec3;
use mandelight::{
    formula::mandelbulb::{Mandelbulb, estimator::Estimator},
    scene::{
        Axis, ColorSource, Coloring, EnvironmentLight, GradientStop, LightFrame, PointLight, Scene,
    },
};

use super::{
    estimate::{orbit, smooth_iterations},
    rays::ShadowRay,
    tone::curve,
};

/// One light as a point sees it.
pub struct Incoming {
    /// Where the shadow ray comes from.
    pub ray: ShadowRay,
    /// Radiance that arrives if nothing blocks it.
    pub radiance: DVec3,
    /// Whether something may block it.
    pub casts_shadows: bool,
}

/// All lights of the scene at `point`, environment lights first: black where another is solo.
pub fn incoming(scene: &Scene, point: DVec3) -> Vec<Incoming> {
    let lights = &scene.lights;
    let any_solo = lights.environment.iter().any(|l| l.solo) || lights.point.iter().any(|l| l.solo);
    let shines = |muted: bool, solo: bool| !muted && (solo || !any_solo);
    let shadows = scene.quality.shadows;
    let environment = |light: &EnvironmentLight| {
        let direction = DVec3::from_array(light.direction).normalize();
        let toward = match light.frame {
            LightFrame::Scene => direction,
            LightFrame::View => scene.camera.rotation() * direction,
        };
        let reach =
            light.shadow_reach.map_or(f64::INFINITY, |views| views * scene.camera.view_unit());
        let strength = if shines(light.muted, light.solo) { light.intensity } else { 0.0 };
        Incoming {
            ray: ShadowRay { toward, reach },
            radiance: rgb(light.color) * strength,
            casts_shadows: light.casts_shadows && shadows,
        }
    };
    let from_point = |light: &PointLight| {
        let way = light.position.to_dvec3() - point;
        let strength = if shines(light.muted, light.solo) { light.intensity } else { 0.0 };
        Incoming {
            ray: ShadowRay { toward: way.normalize(), reach: way.length() },
            radiance: rgb(light.color) * strength / way.length_squared(),
            casts_shadows: light.casts_shadows && shadows,
        }
    };
    lights.environment.iter().map(environment).chain(lights.point.iter().map(from_point)).collect()
}

/// Blinn-Phong: ambient + Σ radiance · (diffuse · colour · n·l + specular · (n·h)^shininess) over
/// the lights that `reaches` lets through and that the surface faces.
pub fn shade(
    scene: &Scene,
    point: DVec3,
    normal: DVec3,
    toward_eye: DVec3,
    reaches: impl Fn(usize) -> bool,
) -> DVec3 {
    let surface = &scene.surface;
    let color = surface_color(scene, point, normal);
    let mut sum = color * surface.ambient;
    for (index, light) in incoming(scene, point).iter().enumerate() {
        let cosine = normal.dot(light.ray.toward);
        if cosine > 0.0 && reaches(index) {
            let halfway = (light.ray.toward + toward_eye).normalize();
            let highlight = normal.dot(halfway).max(0.0).powf(surface.shininess);
            sum +=
                light.radiance * (color * surface.diffuse * cosine + surface.specular * highlight);
        }
    }
    sum
}

/// The surface's colour at `point`, for gradients that do not follow the view.
pub fn surface_color(scene: &Scene, point: DVec3, normal: DVec3) -> DVec3 {
    let fractal = Mandelbulb::of(&scene.fractal);
    let surface = &scene.surface;
    let color = color_at(scene, color_value(&fractal, &surface.coloring, point, normal));
    let second = &surface.second_layer;
    if second.amount == 0.0 {
        return color;
    }
    let value = color_value(&fractal, &second.coloring, point, normal);
    let over = layer_color(&second.coloring, &second.gradient, value);
    color * (1.0 - second.amount) + over * second.amount
}

/// The value that selects the colour at `point`.
pub fn color_value(fractal: &Mandelbulb, coloring: &Coloring, point: DVec3, normal: DVec3) -> f64 {
    let along = match coloring.axis {
        Axis::X => 0,
        Axis::Y => 1,
        Axis::Z => 2,
    };
    match coloring.source {
        ColorSource::Iterations => smooth_iterations(fractal, point),
        ColorSource::Position => {
            0.5 + 0.5 * point[along] / Estimator::new(fractal).bounding_radius()
        }
        ColorSource::Normal => 0.5 + 0.5 * normal[along],
        // The Mandelbulb has no channel.
        ColorSource::Channel => 0.0,
        _ => {
            let points = orbit(fractal, point).points.into_iter();
            points.map(|z| trap_distance(coloring, z)).fold(2.0, f64::min)
        }
    }
}

/// The distance of a point of an orbit from the trap of `coloring`, by plain geometry.
pub fn trap_distance(coloring: &Coloring, z: DVec3) -> f64 {
    let [x, y, z] = (z - DVec3::from_array(coloring.center)).to_array();
    let [along, one, other] = match coloring.axis {
        Axis::X => [x, y, z],
        Axis::Y => [y, z, x],
        Axis::Z => [z, x, y],
    };
    let size = coloring.size;
    match coloring.source {
        ColorSource::PointTrap => (x * x + y * y + z * z).sqrt(),
        ColorSource::AxisTrap => one.hypot(other),
        ColorSource::PlaneTrap => along.abs(),
        ColorSource::SphereTrap => ((x * x + y * y + z * z).sqrt() - size).abs(),
        ColorSource::CubeTrap => {
            // The nearest point of the solid cube, or from within the nearest face.
            let nearest = [x, y, z].map(|v| v.clamp(-size, size));
            let outside = DVec3::from_array([x, y, z]).distance(DVec3::from_array(nearest));
            let faces = [x, y, z].map(|v| size - v.abs());
            if outside > 0.0 { outside } else { faces.into_iter().fold(f64::INFINITY, f64::min) }
        }
        other => panic!("{other:?} is no trap"),
    }
}

/// The colour of a value, or of a position on its way through the values in view, in the first layer.
pub fn color_at(scene: &Scene, value: f64) -> DVec3 {
    layer_color(&scene.surface.coloring, &scene.surface.gradient, value)
}

/// The colour of a value in a layer.
pub fn layer_color(coloring: &Coloring, stops: &[GradientStop], value: f64) -> DVec3 {
    gradient(stops, value * coloring.repeats + coloring.offset)
}

/// Positions of `values` among all of them: half the rank, half the way from the least to the greatest,
/// both without the fiftieth part at either end.
pub fn positions_in_view(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len() as f64;
    let low = sorted[(0.02 * count) as usize];
    let high = sorted[(0.98 * count) as usize];
    let position = |&value: &f64| {
        let within = value.clamp(low, high);
        let rank = sorted.partition_point(|&other| other < within) as f64 / count;
        let rank = ((rank - 0.02) / 0.96).clamp(0.0, 1.0);
        0.7 * rank + 0.3 * (within - low) / (high - low)
    };
    values.iter().map(position).collect()
}

/// The gradient at `u`, around a circle of length one: linear between neighbouring stops.
fn gradient(stops: &[GradientStop], u: f64) -> DVec3 {
    let u = u - u.floor();
    // Each stop and its image one turn on: the pair around u or around u + 1 decides.
    let mut circle: Vec<(f64, DVec3)> = Vec::new();
    for turn in [-1.0, 0.0, 1.0] {
        circle.extend(stops.iter().map(|stop| (stop.position + turn, rgb(stop.color))));
    }
    let right = circle.iter().position(|(at, _)| *at > u).expect("a stop one turn on");
    let ((a, left_color), (b, right_color)) = (circle[right - 1], circle[right]);
    if b > a { left_color.lerp(right_color, (u - a) / (b - a)) } else { left_color }
}

/// What lies behind, at `height` from 0 (upper edge) to 1.
pub fn background(scene: &Scene, height: f64) -> DVec3 {
    rgb(scene.background.top).lerp(rgb(scene.background.bottom), height)
}

/// Display channels, 0 to 255, of a radiance: exposure in stops, the tone curve, then sRGB.
pub fn display(scene: &Scene, radiance: DVec3) -> DVec3 {
    let curved = curve(&scene.tone, radiance * 2.0_f64.powf(scene.tone.exposure));
    DVec3::from_array(curved.to_array().map(|v| 255.0 * srgb(v)))
}

/// IEC 61966-2-1.
pub fn srgb(v: f64) -> f64 {
    if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 }
}

fn rgb(color: [f32; 3]) -> DVec3 {
    DVec3::from_array(color.map(f64::from))
}
