//! A person who only turns the wheel: the camera of every notch, by the program's navigation.

use std::sync::Arc;

use glam::DVec2;
use mandelight::{
    formula::{
        DistanceField,
        march::COARSEST_FOOTPRINT,
        march::{DEEP_FOOTPRINT, PLAIN_FOOTPRINT},
    },
    fractal::{FractalModel, Search, pixel_cone},
    scene::{Camera, Scene, presets},
    ui::navigation::{Navigator, Viewport, World, guide::Guide},
};

/// The window in which the wheel is turned.
pub const VIEWPORT: Viewport = Viewport { aspect: 1.5, height_px: 600.0, detail: 1.0 };
/// Zoom of one notch, as a natural logarithm.
pub const NOTCH: f64 = 0.2;
/// Steps of searches and plans between two notches: ten frames at 60 a second, or a slow frame.
const STEPS_PER_NOTCH: u32 = 300;
/// Zoom after which the plain zoom's anchor is sought again.
const ANCHOR_AGAIN: f64 = 0.2;
/// Most notches, against an endless loop: 1e-27 takes about 320.
const MAX_NOTCHES: u32 = 600;

/// The opening scene's look, applied to the whole bulbs of powers from 3 to 16 and to two Julia forms, with names.
pub fn opening_views() -> Vec<(String, Scene)> {
    let whole = |power: f64, julia: bool| {
        let mut scene = Scene { camera: Camera::default(), ..presets::opening() };
        scene.fractal.set("power", power);
        scene.fractal.set("julia", julia);
        scene
    };
    let powers = [3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 12.0, 16.0];
    let bulbs = powers.map(|power| (format!("power {power}"), whole(power, false)));
    let forms =
        [8.0, 5.0].map(|power| (format!("Julia form of power {power}"), whole(power, true)));
    bulbs.into_iter().chain(forms).collect()
}

/// Sixteen pixels of the picture that see the surface, spread over it.
pub fn sixteen_pixels(scene: &Scene) -> Vec<DVec2> {
    let model = FractalModel::new(&scene.fractal);
    let world = World { field: model.whole().as_ref(), viewport: VIEWPORT };
    let spiral = (0..400).map(|i| {
        let (sin, cos) = (2.399_963 * f64::from(i)).sin_cos();
        DVec2::new(cos / VIEWPORT.aspect, sin) * 0.9 * (f64::from(i) / 400.0).sqrt()
    });
    let seen: Vec<_> = spiral.filter(|ndc| world.pick(&scene.camera, *ndc).is_some()).collect();
    (0..16).map(|i| seen[(i * (seen.len() - 1)) / 15]).collect()
}

/// The cameras of a wheel that is turned at `pointer` until the view unit is below `until`, in scene units.
///
/// With `pull` off the zoom goes where the pointer is. Ends early where the zoom stops.
pub fn wheel_in(scene: &Scene, pointer: DVec2, until: f64, pull: bool) -> Vec<Camera> {
    let model = FractalModel::new(&scene.fractal);
    let (mut guide, mut navigator) = (Guide::default(), Navigator::default());
    let mut cameras = vec![scene.camera.clone()];
    let mut deep: Option<(f64, Arc<dyn DistanceField>)> = None;
    for _ in 0..MAX_NOTCHES {
        let mut camera = cameras[cameras.len() - 1].clone();
        let cone = pixel_cone(&camera, VIEWPORT.aspect, VIEWPORT.height_px);
        let footprint = model.clear_distance(&camera.position).min(camera.view_unit()) * cone;
        // As in the page, an anchor near the eye gives the field of views that are too deep for the plain one.
        if pull || footprint > COARSEST_FOOTPRINT {
            deep = None;
        } else if deep.as_ref().is_none_or(|(unit, _)| camera.view_unit() < ANCHOR_AGAIN * unit) {
            let search = Search::new(&scene.fractal, &camera, VIEWPORT.aspect, None);
            deep = search.map(|search| {
                let reference = search.finish();
                let field =
                    reference.distance_field(&scene.fractal, DEEP_FOOTPRINT, DEEP_FOOTPRINT);
                (camera.view_unit(), field)
            });
        }
        let plain = || model.finer(footprint.max(PLAIN_FOOTPRINT));
        let field = deep.as_ref().map_or_else(plain, |(_, field)| field.clone());
        let world = World { field: field.as_ref(), viewport: VIEWPORT };
        let is_guided = pull && guide.zoom(&model, &mut camera, world, pointer, NOTCH);
        if !is_guided {
            navigator.dolly(&mut camera, world, pointer, NOTCH);
        }
        for _ in 0..STEPS_PER_NOTCH {
            guide.work(&camera, world);
        }
        let unit = camera.view_unit();
        if camera == cameras[cameras.len() - 1] && !is_guided {
            break;
        }
        cameras.push(camera);
        if unit < until {
            break;
        }
    }
    cameras
}
