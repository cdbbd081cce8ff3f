//! A rig: many lights from directions that are made together, from a sky or from a picture of
//! the surroundings.
//!
//! In: a scene's rig. Out: its lights, as directions and strengths. A picture's lights stand in
//! the document themselves, so that a scene or a link is lit the same where the picture is not
//! at hand.
//!
//! Strengths are those of [`super::EnvironmentLight`]: 1 lights a white surface that faces the
//! light to 1, so a light that stands for a part of the surroundings has 1/π of the radiance
//! integrated over that part's solid angle.

mod sky;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{BackgroundKind, EnvironmentMap, LightFrame, Scene, param};
pub use sky::Sky;

/// What a rig's lights are made from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RigKind {
    /// Nothing: there are no such lights.
    #[default]
    None,
    /// A sky with a sun.
    Sky,
    /// An equirectangular environment map.
    Picture,
}

/// Lights from directions that are made together. They come after those of the lists.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Rig {
    /// What they are made from.
    pub kind: RigKind,
    /// How many a sky has, and how many a picture is cut into; in [`param::RIG_COUNT`].
    pub count: u32,
    /// Factor on all of them and on the picture as background, in [`param::RIG_INTENSITY`].
    pub intensity: f64,
    /// Whether surfaces block them.
    pub casts_shadows: bool,
    /// How far a blocker may be, in [`param::RIG_SHADOW_REACH`], view units; none for the whole
    /// scene.
    pub shadow_reach: Option<f64>,
    /// What the directions are fixed to; seen from the camera, z points backward.
    pub frame: LightFrame,
    /// Off for now.
    pub muted: bool,
    /// While any light is solo, only solo lights shine.
    pub solo: bool,
    /// The sky.
    pub sky: Sky,
    /// The picture.
    pub picture: PictureRig,
}

impl Default for Rig {
    fn default() -> Self {
        Self {
            kind: RigKind::None,
            count: param::RIG_COUNT.default as u32,
            intensity: param::RIG_INTENSITY.default,
            casts_shadows: true,
            shadow_reach: Some(param::RIG_SHADOW_REACH.default),
            frame: LightFrame::Scene,
            muted: false,
            solo: false,
            sky: Sky::default(),
            picture: PictureRig::default(),
        }
    }
}

/// An environment map, and the lights that it was cut into.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PictureRig {
    /// The name of its file, at most [`MAX_NAME_CHARS`] characters; empty for no picture.
    pub name: String,
    /// Turns it about z, counterclockwise as seen from above, in [`param::RIG_ROTATION`].
    pub rotation_deg: f64,
    /// Its lights before that turn.
    pub lights: Vec<RigLight>,
}

impl Default for PictureRig {
    fn default() -> Self {
        Self { name: String::new(), rotation_deg: param::RIG_ROTATION.default, lights: Vec::new() }
    }
}

/// The longest name of a picture, in characters.
pub const MAX_NAME_CHARS: usize = 200;
/// The strongest light of a rig, a channel.
pub const MAX_RIG_RADIANCE: f32 = 1e6;
/// How far from 1 the length of a rig light's direction may be: four digits are finer
/// than any picture.
pub const RIG_DIRECTION_TOLERANCE: f64 = 1e-3;

/// One light of a rig.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RigLight {
    /// Vector toward the light in the rig's frame, of length 1 within
    /// [`RIG_DIRECTION_TOLERANCE`].
    pub direction: [f32; 3],
    /// Strength, linear Rec. 709, each channel 0 to [`MAX_RIG_RADIANCE`].
    pub strength: [f32; 3],
}

impl RigLight {
    /// A light in the few digits that a document and a link have room for: the direction to
    /// 1e-5, the strength to 5e-6 of itself.
    fn rounded(direction: DVec3, strength: DVec3) -> Self {
        let digits = |value: f64| {
            // Written with six digits and read again; a number's own text is a number.
            let text = format!("{:.5e}", value.clamp(0.0, f64::from(MAX_RIG_RADIANCE)));
            text.parse().unwrap_or(0.0)
        };
        Self {
            direction: direction.to_array().map(|v| ((v * 1e5).round() / 1e5) as f32),
            strength: strength.to_array().map(digits),
        }
    }
}

impl Rig {
    /// How many lights it has.
    pub fn len(&self) -> usize {
        match self.kind {
            RigKind::None => 0,
            RigKind::Sky => self.count as usize,
            RigKind::Picture => self.picture.lights.len(),
        }
    }

    /// True where it has no light.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Its lights in its frame: unit vectors toward them, and their strengths with the rig's
    /// intensity.
    pub fn lights(&self) -> Vec<(DVec3, DVec3)> {
        let lights = match self.kind {
            RigKind::None => Vec::new(),
            RigKind::Sky => self.sky.lights(self.count),
            RigKind::Picture => self.picture.turned_lights(),
        };
        lights
            .into_iter()
            .map(|(direction, strength)| (direction, strength * self.intensity))
            .collect()
    }

    /// Makes the picture's lights from `environment_map`: as many as [`Self::count`] says, but at most
    /// `room`; fewer where the picture cannot be divided so often.
    pub fn light_by(&mut self, environment_map: &EnvironmentMap, room: usize) {
        let count = (self.count as usize).min(room);
        self.kind = RigKind::Picture;
        self.picture.name = environment_map.name().to_owned();
        self.picture.lights = environment_map
            .cut(count)
            .into_iter()
            .map(|light| RigLight::rounded(light.direction, light.energy / std::f64::consts::PI))
            .filter(|light| light.strength != [0.0; 3])
            .collect();
    }
}

impl Scene {
    /// Lights the scene by `environment_map` and, where it does not name that picture yet, shows it
    /// behind the fractal. A scene that names it without being lit by it stays as it is.
    pub fn surround_by(&mut self, environment_map: &EnvironmentMap) {
        let is_new = self.lights.rig.picture.name != environment_map.name();
        if is_new {
            self.background.kind = BackgroundKind::Picture;
        }
        if is_new || self.lights.rig.kind == RigKind::Picture {
            let room = self.lights.room_for_rig();
            self.lights.rig.light_by(environment_map, room);
        }
    }
}

impl PictureRig {
    fn turned_lights(&self) -> Vec<(DVec3, DVec3)> {
        let turn = glam::DQuat::from_rotation_z(self.rotation_deg.to_radians());
        let turned = |light: &RigLight| {
            let [x, y, z] = light.direction.map(f64::from);
            let strength = DVec3::from_array(light.strength.map(f64::from));
            (turn * DVec3::new(x, y, z).normalize_or(DVec3::Z), strength)
        };
        self.lights.iter().map(turned).collect()
    }
}

#[cfg(test)]
mod tests;
