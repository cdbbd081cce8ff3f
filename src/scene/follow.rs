//! Lights that follow close views: a scene's lights turn into a set tied to the view.
//!
//! In: the lights of a scene and its camera. Out: the lights as they shine, a pure function of
//! both, so tiles, eyes and frames of a sequence agree.
//!
//! Down to a view unit of [`FAR_UNIT`] the lights shine as the document has them. From
//! [`NEAR_UNIT`] on they are tied to the view: one rotation brings the key to the upper left front
//! of the view and turns the other lights along, so all angles between them stay. Between both, the
//! rotation grows with the logarithm of the view unit.
//!
//! Turning the camera changes the rotation's axis and angle. At half a turn the axis changes sign,
//! and no blend is continuous there for every camera: rotations are not contractible. So the blend
//! is steeper the closer the angle is to half a turn, where it becomes a step in the middle, and
//! the lights fade out at that single point.
//!
//! Point lights and the rig stay in place. A point light has a position, and a rig shines from all
//! sides, so some of it lights every view; it is also the background, and a document has no form
//! for a sky that is turned over.

use std::{borrow::Cow, f64::consts::PI};

use glam::{DMat3, DQuat, DVec3};

use super::{
    camera::Camera,
    color::luminance,
    light::{EnvironmentLight, LightFrame, MAX_LIGHTS},
    lighting::Lights,
};

/// View unit, in scene units, down to which lights shine as the document has them.
pub const FAR_UNIT: f64 = 1e-2;
/// View unit, in scene units, from which on lights are tied to the view.
pub const NEAR_UNIT: f64 = 1e-3;
/// Toward the key in a close view: upper left, in front of the surface. Not normalised.
pub const KEY_IN_VIEW: DVec3 = DVec3::new(-0.6, 0.64, 0.45);
/// Reach of shadows in a close view of lights without a limit, in view units.
pub const NEAR_REACH: f64 = 1.25;
/// Factor on the strength of environment lights in a close view.
///
/// The surface fills such a view and faces the key. A view of the whole set has a dark background and needs more light.
const NEAR_STRENGTH: f64 = 0.65;
/// Reach that a limit starts from, in scene units: larger than any set.
const FAR_REACH: f64 = 8.0;
/// Toward the fill, in the view; opposite the key.
const FILL_IN_VIEW: DVec3 = DVec3::new(0.5, 0.35, 0.8);
/// Strength of the fill, as a fraction of the key's.
const FILL_PART: f64 = 0.1;
/// The fill's colour: cool, as of a sky.
const FILL_COLOR: [f32; 3] = [0.7, 0.83, 1.0];
/// Exponent that makes the blend steep near half a turn.
const STEEP: i32 = 8;
/// Angle from half a turn, in radians, within which lights fade in the middle of the blend.
const FADE_RAD: f64 = 0.25;
/// Distance from the middle of the blend within which lights fade at half a turn.
const FADE_PART: f64 = 0.08;

/// The lights as they shine for `camera`.
///
/// Equal to `lights` unless these [follow the view](Lights::follow_view) and the view is close. The
/// result does not follow: a document with these lights looks the same from `camera`.
pub fn effective<'a>(lights: &'a Lights, camera: &Camera) -> Cow<'a, Lights> {
    let Some(follow) = Follow::of(lights, camera) else { return Cow::Borrowed(lights) };
    let mut shining = follow.turned(lights);
    let followed = lights.environment.iter().map(is_tied_to_scene);
    for (light, followed) in shining.environment.iter_mut().zip(followed) {
        light.intensity *= if followed { follow.fade } else { 1.0 };
    }
    add_fill(&mut shining, lights, follow.part);
    dim(&mut shining, follow.part);
    Cow::Owned(shining)
}

/// The lights that panels show and edit; none where they are those of the document.
///
/// As [`effective`], with the lights of the document only, and their strengths.
pub fn shown(lights: &Lights, camera: &Camera) -> Option<Lights> {
    Follow::of(lights, camera).map(|follow| follow.turned(lights))
}

/// The document's lights after the edit of [`shown`] lights from `before` to `edited`.
///
/// An edit of colour, strength or position changes just that. Any other edit, such as of a
/// direction, stores the whole set as it is seen, tied to the view, and ends the following. The set that is stored
/// does not fade where the shorter way changes sides.
pub fn with_edit(document: Lights, before: &Lights, edited: Lights, camera: &Camera) -> Lights {
    if edited == *before {
        return document;
    }
    if let Some(lights) = followed_edit(&document, before, &edited) {
        return lights;
    }
    let part = blend_part(camera.view_unit());
    let mut lights = edited;
    add_fill(&mut lights, &document, part);
    dim(&mut lights, part);
    lights
}

/// Edits a document's lights as they are [`shown`] in the view of `camera`.
pub fn edit<R>(lights: &mut Lights, camera: &Camera, edit: impl FnOnce(&mut Lights) -> R) -> R {
    let Some(seen) = shown(lights, camera) else { return edit(lights) };
    let mut edited = seen.clone();
    let result = edit(&mut edited);
    *lights = with_edit(std::mem::take(lights), &seen, edited, camera);
    result
}

/// The document's lights with an edit that leaves all of them where they are; none for other edits.
fn followed_edit(document: &Lights, before: &Lights, edited: &Lights) -> Option<Lights> {
    if edited.environment.len() != before.environment.len() {
        return None;
    }
    let mut lights = Lights { follow_view: true, ..edited.clone() };
    if edited.rig.shadow_reach == before.rig.shadow_reach {
        lights.rig.shadow_reach = document.rig.shadow_reach;
    }
    let pairs = document.environment.iter().zip(&before.environment);
    for (light, (kept, before)) in lights.environment.iter_mut().zip(pairs) {
        let stays = light.direction == before.direction
            && light.frame == before.frame
            && light.casts_shadows == before.casts_shadows
            && light.shadow_reach == before.shadow_reach;
        if !stays {
            return None;
        }
        let EnvironmentLight { color, intensity, size_deg, muted, solo, .. } = *light;
        *light = EnvironmentLight { color, intensity, size_deg, muted, solo, ..kept.clone() };
    }
    (key(&lights) == key(document)).then_some(lights)
}

/// How far, and how, the lights have turned toward the view.
struct Follow {
    /// 0 at [`FAR_UNIT`] to 1 at [`NEAR_UNIT`].
    part: f64,
    /// The rotation from the scene's frame to the view's; none without lights to turn.
    view_from_scene: Option<DQuat>,
    /// Factor on the strength of turned lights.
    fade: f64,
    /// Reach of shadows without a limit, in view units.
    reach: f64,
}

impl Follow {
    /// None if the lights do not follow, or the view is not close.
    fn of(lights: &Lights, camera: &Camera) -> Option<Self> {
        let unit = camera.view_unit();
        let part = blend_part(unit);
        if !lights.follow_view || part == 0.0 {
            return None;
        }
        let reach = NEAR_REACH * (FAR_REACH / unit / NEAR_REACH).powf(1.0 - part);
        let key = key(lights).and_then(|index| lights.environment.get(index));
        let Some(key) = key else {
            return Some(Self { part, view_from_scene: None, fade: 1.0, reach });
        };
        let near = near_rotation(DVec3::from_array(key.direction).normalize_or(DVec3::Z));
        let (rotation, fade) = if part == 1.0 {
            (near, 1.0)
        } else {
            let (turn, fade) = blend(camera.rotation() * near, part);
            (camera.rotation().inverse() * turn, fade)
        };
        Some(Self { part, view_from_scene: Some(rotation.normalize()), fade, reach })
    }

    /// `lights` tied to the view, with limited shadows, at the document's strengths.
    fn turned(&self, lights: &Lights) -> Lights {
        let mut turned = Lights { follow_view: false, ..lights.clone() };
        for light in turned.environment.iter_mut().filter(|light| is_tied_to_scene(light)) {
            if let Some(view_from_scene) = self.view_from_scene {
                let direction = DVec3::from_array(light.direction).normalize_or(DVec3::Z);
                light.direction = (view_from_scene * direction).normalize().to_array();
                light.frame = LightFrame::View;
            }
            light.shadow_reach.get_or_insert(self.reach);
        }
        if turned.rig.frame == LightFrame::Scene {
            turned.rig.shadow_reach.get_or_insert(self.reach);
        }
        turned
    }
}

fn is_tied_to_scene(light: &EnvironmentLight) -> bool {
    light.frame == LightFrame::Scene
}

/// How close a view is: 0 from [`FAR_UNIT`] up, 1 from [`NEAR_UNIT`] down.
fn blend_part(view_unit: f64) -> f64 {
    let part = ((FAR_UNIT / view_unit).ln() / (FAR_UNIT / NEAR_UNIT).ln()).clamp(0.0, 1.0);
    part * part * (3.0 - 2.0 * part)
}

/// Index of the key: the brightest light tied to the scene, of those with shadows if any has.
///
/// Of equally bright lights, the first. Mute and solo do not count, so they turn no other light.
fn key(lights: &Lights) -> Option<usize> {
    let brightest = |with_shadows: bool| {
        let mut best: Option<(usize, f64)> = None;
        for (index, light) in lights.environment.iter().enumerate() {
            let counts = is_tied_to_scene(light) && (light.casts_shadows || !with_shadows);
            let strength = strength(light);
            if counts && best.is_none_or(|(_, most)| strength > most) {
                best = Some((index, strength));
            }
        }
        best.map(|(index, _)| index)
    };
    brightest(true).or_else(|| brightest(false))
}

fn strength(light: &EnvironmentLight) -> f64 {
    light.intensity * luminance(DVec3::from_array(light.color.map(f64::from)))
}

/// The rotation from the scene's frame to that of a close view.
///
/// Brings `key` to [`KEY_IN_VIEW`], and the scene's upward axis as near to the picture's as then
/// possible.
fn near_rotation(key: DVec3) -> DQuat {
    let frame = |front: DVec3, up: DVec3| {
        // The fallback is for a key straight above or below.
        let side =
            up.cross(front).try_normalize().unwrap_or_else(|| front.any_orthonormal_vector());
        DMat3::from_cols(side, front.cross(side), front)
    };
    let (scene, view) = (frame(key, DVec3::Z), frame(KEY_IN_VIEW.normalize(), DVec3::Y));
    DQuat::from_mat3(&(view * scene.transpose())).normalize()
}

/// The part of `rotation` by the shorter way, and the factor on the strength of what it turns.
fn blend(rotation: DQuat, part: f64) -> (DQuat, f64) {
    let rotation = if rotation.w < 0.0 { -rotation } else { rotation };
    let axis = rotation.xyz();
    let angle_rad = 2.0 * axis.length().atan2(rotation.w);
    let Some(axis) = axis.try_normalize() else { return (DQuat::IDENTITY, 1.0) };
    let flatness = 1.0 - (angle_rad / PI).powi(STEEP);
    // part^k / (part^k + (1 − part)^k) with k = 1 / flatness.
    let odds = (((1.0 - part) / part).ln() / flatness.max(f64::MIN_POSITIVE)).exp();
    let turned_rad = angle_rad / (1.0 + odds);
    let from_seam = ((PI - angle_rad) / FADE_RAD).hypot((part - 0.5) / FADE_PART).min(1.0);
    let fade = from_seam * from_seam * (3.0 - 2.0 * from_seam);
    (DQuat::from_axis_angle(axis, turned_rad), fade)
}

/// Dims the environment lights of a close view.
fn dim(lights: &mut Lights, part: f64) {
    let strength = NEAR_STRENGTH.powf(part);
    for light in &mut lights.environment {
        light.intensity *= strength;
    }
}

/// Adds a weak light without shadows to close views, as far as `document` has none.
fn add_fill(lights: &mut Lights, document: &Lights, part: f64) {
    let unshadowed = document.environment.iter().filter(|light| !light.casts_shadows);
    let rig = Some(&document.rig).filter(|rig| !rig.is_empty() && !rig.casts_shadows);
    let present = unshadowed.map(strength).sum::<f64>() + rig.map_or(0.0, |rig| rig.intensity);
    let key = key(document).and_then(|index| document.environment.get(index));
    let missing = key.map_or(0.0, |key| FILL_PART * strength(key)) - present;
    if missing > 0.0 && lights.len() < MAX_LIGHTS {
        lights.environment.push(EnvironmentLight {
            direction: FILL_IN_VIEW.normalize().to_array(),
            color: FILL_COLOR,
            intensity: part * missing,
            casts_shadows: false,
            frame: LightFrame::View,
            ..EnvironmentLight::default()
        });
    }
}
