//! The views that pictures are compared on.

use glam::DVec3;
use mandelight::{
    formula::mandelbulb::{Mandelbulb, Sine},
    scene::{
        Axis, Camera, ColorSource, Coloring, EnvironmentLight, LightFrame, PointLight,
        PrecisePoint, Scene, ToneCurve,
    },
};

use super::rays::Size;

/// Width and height of every picture.
pub const SIZE: Size = [96, 64];

/// A view by name.
pub struct View {
    pub name: &'static str,
    pub scene: Scene,
}

fn bulb(power: f64) -> Mandelbulb {
    Mandelbulb { power, ..Mandelbulb::default() }
}

fn julia(power: f64) -> Mandelbulb {
    Mandelbulb { julia: true, ..bulb(power) }
}

fn view(
    name: &'static str,
    fractal: Mandelbulb,
    eye: [f64; 3],
    at: [f64; 3],
    up: [f64; 3],
) -> View {
    let [eye, at, up] = [eye, at, up].map(DVec3::from_array);
    View {
        name,
        scene: Scene {
            fractal: fractal.into(),
            camera: Camera::looking_at(eye, at, up),
            ..Scene::default()
        },
    }
}

/// From afar and from close by; each shows the set on 30 to 90 % of its pixels. The close ones
/// stand off the surface by the length in their name and look along it.
pub fn all() -> Vec<View> {
    const CENTRE: [f64; 3] = [0.0; 3];
    const Z: [f64; 3] = [0.0, 0.0, 1.0];
    let minus = Mandelbulb { sine: Sine::Negative, ..bulb(8.0) };
    vec![
        view("power 8", bulb(8.0), [1.2, -2.2, 0.8], CENTRE, Z),
        view("power 8, minus sine", minus, [2.2, 0.5, -0.6], CENTRE, Z),
        view("power 16", bulb(16.0), [-1.5, 1.9, 0.4], CENTRE, Z),
        view("power 3", bulb(3.0), [1.4, -1.9, 1.6], CENTRE, Z),
        view("power 2", bulb(2.0), [0.9, -1.75, 1.3], CENTRE, Z),
        view("power 5.5", bulb(5.5), [1.0, -2.2, 1.0], CENTRE, Z),
        view("Julia 8", julia(8.0), [1.2, -2.0, 0.8], CENTRE, Z),
        view(
            "power 8 at 0.15",
            bulb(8.0),
            [0.549, -0.029, 0.723],
            [0.439, 0.075, 0.741],
            [0.45, 0.036, 0.892],
        ),
        view(
            "power 8 at 0.01",
            bulb(8.0),
            [-0.236487, 0.942002, 0.512647],
            [-0.242399, 0.941518, 0.504353],
            [-0.010563, 0.981455, 0.191402],
        ),
        view(
            "power 8 at 0.001",
            bulb(8.0),
            [0.2951265, 0.7475315, 0.6005763],
            [0.2961047, 0.7475403, 0.6002880],
            [0.0891837, -0.0370537, 0.9953257],
        ),
        view(
            "power 6.5 at 0.01",
            bulb(6.5),
            [0.845738, -0.210198, -0.013047],
            [0.846779, -0.203792, -0.005180],
            [0.871690, 0.127241, -0.473252],
        ),
        view(
            "Julia 8 at 0.01",
            julia(8.0),
            [-0.111070, -1.012101, -0.316733],
            [-0.120026, -1.014494, -0.312483],
            [0.267727, -0.876610, -0.399846],
        ),
    ]
}

/// Along the seam of a power that is not whole, where the turns do not close: no distance estimate
/// there holds what it promises.
pub fn seam() -> View {
    view(
        "power 6.5 at 0.15",
        bulb(6.5),
        [0.213527, 0.137701, 0.792632],
        [0.117989, 0.018285, 0.796155],
        [-0.437063, 0.620106, 0.651494],
    )
}

/// Scenes that between them use every kind of light, colour source and tone curve.
pub fn lit() -> Vec<View> {
    let sources = [
        ColorSource::Iterations,
        ColorSource::PointTrap,
        ColorSource::AxisTrap,
        ColorSource::PlaneTrap,
    ];
    let second_sources = [
        ColorSource::SphereTrap,
        ColorSource::Position,
        ColorSource::CubeTrap,
        ColorSource::Normal,
    ];
    let pick = ["power 8", "power 5.5", "power 3", "Julia 8 at 0.01"];
    let mut views: Vec<_> = all().into_iter().filter(|view| pick.contains(&view.name)).collect();
    for (view, (source, second)) in views.iter_mut().zip(sources.into_iter().zip(second_sources)) {
        view.scene.surface.coloring.source = source;
        view.scene.surface.coloring.offset = 0.3;
        let layer = &mut view.scene.surface.second_layer;
        layer.amount = 0.4;
        layer.coloring = Coloring {
            source: second,
            axis: Axis::X,
            center: [0.3, -0.2, 0.1],
            size: 0.7,
            ..Coloring::default()
        };
        let unit = view.scene.camera.view_unit();
        let eye = view.scene.camera.position.to_dvec3();
        let beside = view.scene.camera.rotation() * DVec3::new(0.4, 0.3, 0.1) * unit;
        view.scene.lights.point.push(PointLight {
            position: PrecisePoint::from(eye + beside),
            color: [0.3, 1.0, 0.5],
            intensity: unit * unit,
            ..PointLight::default()
        });
    }
    let headlight = EnvironmentLight {
        direction: DVec3::new(0.3, 0.2, 1.0).normalize().to_array(),
        color: [1.0, 0.4, 0.2],
        shadow_reach: Some(0.2),
        frame: LightFrame::View,
        ..EnvironmentLight::default()
    };
    views[1].scene.lights.environment.push(headlight.clone());
    views[1].scene.lights.environment[0].muted = true;
    views[2].scene.tone.curve = ToneCurve::Linear;
    views[2].scene.tone.exposure = -0.5;
    views[3].scene.lights.environment.push(EnvironmentLight { solo: true, ..headlight });
    views[3].scene.lights.point[0].solo = true;
    views[3].scene.surface.specular = 0.9;
    views
}
