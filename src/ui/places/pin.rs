//! One pin: a place, the view of it, and how near the camera still is.

use egui::Vec2;

use crate::{
    formula::Recurrence,
    fractal::places::Place,
    scene::{Camera, PrecisePoint, Scene, StereoLayout},
    ui::{
        small_picture::{SmallPicture, SmallPictureId},
        status::{zoom, zoom_text},
    },
};

/// Samples of a small picture.
const SAMPLES: u32 = 2;
/// Change of the distance to a place after which its pin is gone, as a factor.
const MAX_ZOOM: f64 = 2.0;
/// Turn of the camera, or of the direction to a place, after which its pin is gone, in radians.
const MAX_TURN_RAD: f64 = std::f64::consts::FRAC_PI_6;

/// A place with the view that a click flies to.
#[derive(Debug)]
pub struct Pin {
    /// The place.
    pub place: Place,
    /// The view of the place.
    pub to: Camera,
    /// The picture of that view.
    pub picture: SmallPicture,
    /// From the place to the middle of its picture, in points; none until it is arranged.
    pub offset: Option<Vec2>,
}

impl Pin {
    /// A pin whose picture has the look of `scene`, and `number`.
    pub fn new(place: Place, to: Camera, scene: &Scene, number: u64) -> Self {
        let picture = picture(&to, scene, number);
        Self { place, to, picture, offset: None }
    }

    /// Replaces the picture by one with the look of `scene`, and `number`.
    pub fn redraw(&mut self, scene: &Scene, number: u64) {
        self.picture = picture(&self.to, scene, number);
    }

    /// The pin's name for screen readers; `index` counts from 0.
    pub fn name(&self, index: usize) -> String {
        let kind = match self.place.recurrence {
            Recurrence::Cycle { .. } => "repeating shapes",
            Recurrence::Center { .. } => "small copy",
        };
        format!("Place {}: {kind}, zoom {}", index + 1, zoom_text(zoom(&self.to)))
    }

    /// What a click leads to.
    pub fn help(&self) -> String {
        let what = match self.place.recurrence {
            Recurrence::Cycle { .. } => "Here the same shapes return at every depth.",
            Recurrence::Center { .. } => "Here is a small copy of the whole fractal.",
        };
        format!("{what} Click to fly there: zoom {}.", zoom_text(zoom(&self.to)))
    }
}

fn picture(to: &Camera, scene: &Scene, number: u64) -> SmallPicture {
    let mut scene = Scene { camera: to.clone(), ..scene.clone() };
    scene.camera.stereo.layout = StereoLayout::Off;
    // Two samples are too few for blur and soft shadows.
    scene.camera.lens.depth_of_field = false;
    scene.lights.environment.iter_mut().for_each(|light| light.size_deg = 0.0);
    scene.lights.point.iter_mut().for_each(|light| light.radius = 0.0);
    scene.quality.samples = SAMPLES;
    SmallPicture { id: SmallPictureId { owner: "place", number }, scene }
}

/// True while `camera` sees `point` much as `searched` did.
pub fn is_near(searched: &Camera, camera: &Camera, point: &PrecisePoint) -> bool {
    let (before, now) = (point - &searched.position, point - &camera.position);
    let zoomed = before.length().max(f64::MIN_POSITIVE) / now.length().max(f64::MIN_POSITIVE);
    let turned = searched.rotation().angle_between(camera.rotation());
    let is_small = |turned_rad: f64| turned_rad.is_nan() || turned_rad < MAX_TURN_RAD;
    (MAX_ZOOM.recip()..=MAX_ZOOM).contains(&zoomed)
        && is_small(turned)
        && is_small(before.angle_between(now))
}
