//! Paths around a scene.

use std::{f64::consts::TAU, sync::Arc};

use glam::{DQuat, DVec3};

use super::{Easing, Key, Path};
use crate::scene::{Camera, Scene};

/// Parts of the circle. Between keys, a camera takes the shorter way, so there are more than two.
const PARTS: u32 = 4;
/// Rounding of the eye's position, in view units: far below what is seen.
const GRAIN: f64 = 1e-12;

impl Path {
    /// A path once around the camera's pivot in `secs` seconds, about the vertical axis of an upright
    /// camera, else about the camera's own.
    ///
    /// Repeated, it turns on without a seam: the frame after the last one is the first.
    pub fn turntable(scene: &Scene, secs: f64, frames_per_second: u32) -> Self {
        let rate = f64::from(frames_per_second);
        // A whole number of frames, of which each part has at least one.
        let frames = (secs * rate).round().max(f64::from(PARTS + 1));
        let axis =
            if scene.camera.is_upright() { DVec3::Z } else { scene.camera.rotation() * DVec3::Y };
        let key = |part: u32| {
            let of_path = f64::from(part) / f64::from(PARTS) * (frames - 1.0);
            let turn = DQuat::from_axis_angle(axis, TAU * of_path / frames);
            let camera = turned(&scene.camera, turn);
            let scene = Arc::new(Scene { camera, ..scene.clone() });
            Key { time_secs: of_path / rate, easing: Easing::Linear, scene }
        };
        Self { frames_per_second, keys: (0..=PARTS).map(key).collect(), ..Self::default() }
    }
}

/// A camera turned about its pivot.
fn turned(camera: &Camera, turn: DQuat) -> Camera {
    let to_eye = turn * (&camera.position - &camera.pivot);
    Camera {
        position: camera.pivot.moved_by(to_eye, GRAIN * camera.view_unit()),
        orientation: (turn * camera.rotation()).normalize().into(),
        ..camera.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::{
        super::tests::{deep_point, looking},
        *,
    };

    /// All steps are equal, the one from the last frame to the first too; the eye stays on its circle.
    #[test]
    fn a_turntable_turns_evenly_and_closes() {
        let mut rolled = looking(&deep_point(), 1e-20, 0.3);
        let roll = DQuat::from_axis_angle(rolled.camera.forward(), 0.4);
        rolled.camera.orientation = (roll * rolled.camera.rotation()).normalize().into();
        for (scene, rate, secs) in [
            (Scene::default(), 30, 12.0),
            (looking(&deep_point(), 1e-20, 0.3), 24, 5.0),
            (rolled, 25, 3.3),
            (Scene::default(), 1, 0.0),
        ] {
            let path = Path::turntable(&scene, secs, rate);
            assert_eq!(path.validate(), Ok(()));
            let frames = path.frame_count();
            assert_eq!(f64::from(frames), (secs * f64::from(rate)).round().max(5.0));
            let cameras: Vec<Camera> =
                (0..frames).map(|frame| path.frame(frame).expect("a frame").camera).collect();
            assert_eq!(cameras[0].pivot, scene.camera.pivot);
            let step = std::f64::consts::TAU / f64::from(frames);
            let unit = scene.camera.view_unit();
            for (index, camera) in cameras.iter().enumerate() {
                let next = &cameras[(index + 1) % cameras.len()];
                let turn = next.rotation() * camera.rotation().inverse();
                let angle = 2.0 * turn.xyz().length().atan2(turn.w.abs());
                assert!((angle / step - 1.0).abs() < 1e-6, "frame {index}: {angle} of {step}");
                assert!((camera.view_unit() / unit - 1.0).abs() < 1e-6, "frame {index}");
                let aside = (&camera.pivot - &camera.position).normalize().dot(camera.forward());
                let before = (&scene.camera.pivot - &scene.camera.position).normalize();
                let before = before.dot(scene.camera.forward());
                assert!((aside - before).abs() < 1e-6, "frame {index} looks elsewhere");
            }
        }
    }
}
