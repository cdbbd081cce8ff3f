//! Lighting of a place by a click on it.
//!
//! In: a click in the view. Out: the selected light, where nothing is between it and the place.

use egui::{Key, Pos2, Response, Ui};

use super::{pilot::LitPlace, selection::LightRef};
use crate::scene::{Camera, EnvironmentLight, Lights, Scene, follow, param};

/// What the picture says while it waits for the click.
pub const HINT: &str = "Click a place to light it · Esc to stop";

/// Caption while the focused view waits.
pub const KEYBOARD_HINT: &str = "Enter lights the middle · Esc to stop";

/// Distances of a point light from the place, in view units.
const DISTANCES: [f64; 2] = [0.1, 1.5];

/// Whether the next click in the view lights a place.
#[derive(Clone, Copy, Debug, Default)]
pub struct LightClick {
    waits: bool,
}

impl LightClick {
    /// True while the next click lights a place.
    pub fn waits(self) -> bool {
        self.waits
    }

    /// Begins or ends the wait.
    pub fn toggle(&mut self) {
        self.waits = !self.waits;
    }

    /// Where in the window a click of this frame asks for light: while the view waits, Enter asks in `middle`.
    pub fn asked(&mut self, ui: &Ui, view: &Response, middle: Pos2) -> Option<Pos2> {
        let (has_modifiers, is_space) =
            ui.input(|i| (i.modifiers.alt && i.modifiers.shift, i.key_pressed(Key::Space)));
        let at = match view.interact_pointer_pos() {
            Some(at) if self.waits || has_modifiers => at,
            // Space plays the path.
            None if self.waits && !is_space => middle,
            _ => return None,
        };
        if !view.clicked() {
            return None;
        }
        self.waits = false;
        Some(at)
    }
}

/// Lets the selected light, or the first, shine on `place`. A scene without lights gets one.
pub fn light(scene: &mut Scene, selected: Option<LightRef>, place: &LitPlace) -> LightRef {
    let Scene { camera, lights, .. } = scene;
    follow::edit(lights, camera, |lights| aim(lights, camera, selected, place))
}

fn aim(
    lights: &mut Lights,
    camera: &Camera,
    selected: Option<LightRef>,
    place: &LitPlace,
) -> LightRef {
    if lights.environment.is_empty() && lights.point.is_empty() {
        lights.environment.push(EnvironmentLight::default());
    }
    let first =
        if lights.environment.is_empty() { LightRef::Point(0) } else { LightRef::Environment(0) };
    let target = selected.filter(|light| light.exists(lights)).unwrap_or(first);
    match target {
        LightRef::Environment(index) => {
            let light = &mut lights.environment[index];
            light.direction = light.frame.from_world(place.toward_light, camera).to_array();
            light.muted = false;
        }
        LightRef::Point(index) => {
            let light = &mut lights.point[index];
            let unit = camera.view_unit();
            let before = (&light.position - &camera.position - place.offset).length();
            // Behind the eye, something might be in the way.
            let farthest = (DISTANCES[1] * unit).min(0.9 * place.offset.length());
            let distance = before.clamp((DISTANCES[0] * unit).min(farthest), farthest);
            let moved = place.offset + place.toward_light * distance;
            light.position = camera.position.moved_by(moved, 1e-6 * unit);
            // As bright there as from where it was.
            let factor = (distance / before.max(1e-3 * unit)).powi(2);
            light.intensity = param::POINT_INTENSITY.clamp(light.intensity * factor);
            light.muted = false;
        }
    }
    target
}
