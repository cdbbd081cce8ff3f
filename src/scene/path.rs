//! A camera path: whole scenes at points in time, and the scene at any time between them.
//!
//! In: key frames. Out: the scene at a time, a function of that time alone: no frame needs the
//! one before. `docs/paths.md` has the equations.
//!
//! | file | contents |
//! |---|---|
//! | `curve` | smooth curves through keys, in any space that has shortest lines |
//! | `place` | positions that go with the zoom: hyperbolic space |
//! | `rotation` | orientations and directions |
//! | `turntable` | paths around a scene |
//! | `blend` | every number of a scene, found by itself |

mod blend;
mod curve;
mod place;
mod rotation;
mod turntable;

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{
    description::Scene,
    param::{Param, Scale, Unit},
    validate::Invalid,
};
use curve::{Joint, Span};

/// The most keys that a path has.
pub const MAX_KEYS: usize = 256;

/// When a key is reached.
pub const KEY_TIME: Param = Param {
    path: "path.keys[].time_secs",
    label: "Time",
    unit: Unit::Seconds,
    min: 0.0,
    max: 3600.0,
    default: 0.0,
    scale: Scale::Linear,
    step: 0.1,
    help: "When the key is reached, from the path's beginning. Each key is later than the one before.",
};

/// How many frames make a second.
pub const FRAME_RATE: Param = Param {
    path: "path.frames_per_second",
    label: "Frame rate",
    unit: Unit::Count,
    min: 1.0,
    max: 240.0,
    default: 30.0,
    scale: Scale::Integer,
    step: 1.0,
    help: "Frames per second of the rendered sequence. More is smoother and takes longer.",
};

/// For how much of a frame's time the shutter is open.
pub const SHUTTER: Param = Param {
    path: "path.shutter",
    label: "Motion blur",
    unit: Unit::None,
    min: 0.0,
    max: 1.0,
    default: 0.0,
    scale: Scale::Linear,
    step: 0.05,
    help: "For which part of a frame's time the shutter is open, the shutter angle over 360°. 0.5 is a film camera's; at 0 every frame is sharp.",
};

/// Times closer together than this are one, seconds: far less than any frame takes.
const SAME_SECS: f64 = 1e-6;

/// How the scene goes from one key to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Easing {
    /// Through the keys without stopping; from rest at the path's beginning, to rest at its end
    /// and next to a hold.
    #[default]
    Smooth,
    /// At one speed from key to key.
    Linear,
    /// Not at all, until the next key is reached at once.
    Hold,
}

/// A scene at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// When, in [`KEY_TIME`], seconds.
    pub time_secs: f64,
    /// How the scene goes on from here.
    pub easing: Easing,
    /// The scene; shared, since histories hold many copies of a path.
    pub scene: Arc<Scene>,
}

/// Keys in the order of their times.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Frames per second, in [`FRAME_RATE`].
    pub frames_per_second: u32,
    /// Motion blur, in [`SHUTTER`].
    pub shutter: f64,
    /// At most [`MAX_KEYS`], times increasing.
    pub keys: Vec<Key>,
}

impl Default for Path {
    fn default() -> Self {
        Self {
            frames_per_second: FRAME_RATE.default as u32,
            shutter: SHUTTER.default,
            keys: Vec::new(),
        }
    }
}

impl Path {
    /// True where there are no keys, hence no frames.
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }

    /// The last key's time, seconds; 0 without keys.
    pub fn duration_secs(&self) -> f64 {
        self.keys.last().map_or(0.0, |key| key.time_secs)
    }

    /// How many frames there are from time 0 to the last key, both shown.
    pub fn frame_count(&self) -> u32 {
        if self.is_empty() {
            return 0;
        }
        // At most an hour at 240 frames a second. The sliver is for a last key that lies on a
        // frame but for rounding.
        (self.duration_secs() * f64::from(self.frames_per_second) + SAME_SECS).floor() as u32 + 1
    }

    /// The time of frame `frame`, seconds.
    pub fn frame_secs(&self, frame: u32) -> f64 {
        f64::from(frame) / f64::from(self.frames_per_second.max(1))
    }

    /// The frame nearest to `secs`.
    pub fn nearest_frame(&self, secs: f64) -> u32 {
        (secs.max(0.0) * f64::from(self.frames_per_second)).round() as u32
    }

    /// The key nearest to `secs`, where it is less than half a frame away.
    pub fn key_at(&self, secs: f64) -> Option<usize> {
        let half_frame_secs = 0.5 / f64::from(self.frames_per_second.max(1));
        let distance = |key: &Key| (key.time_secs - secs).abs();
        let (index, key) = self
            .keys
            .iter()
            .enumerate()
            .min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)))?;
        (distance(key) < half_frame_secs).then_some(index)
    }

    /// Puts `key` in its place and returns its index. It replaces a key at the same time; a full
    /// path takes no further one.
    pub fn insert(&mut self, key: Key) -> Option<usize> {
        let index = self.keys.partition_point(|other| other.time_secs < key.time_secs - SAME_SECS);
        let is_there = |other: &Key| (other.time_secs - key.time_secs).abs() <= SAME_SECS;
        if self.keys.get(index).is_some_and(is_there) {
            self.keys[index] = key;
        } else if self.keys.len() < MAX_KEYS {
            self.keys.insert(index, key);
        } else {
            return None;
        }
        Some(index)
    }

    /// The scene at `secs`: a key's own at its time, the first one's before it, the last one's
    /// after it, and in between a valid scene whose every number has its part of the way behind
    /// it. None without keys.
    pub fn at(&self, secs: f64) -> Option<Scene> {
        let next = self.keys.partition_point(|key| key.time_secs <= secs);
        let Some(from) = next.checked_sub(1) else {
            return self.keys.first().map(|key| (*key.scene).clone());
        };
        let key = &self.keys[from];
        let Some(to) = self.keys.get(next) else {
            return Some((*key.scene).clone());
        };
        if secs == key.time_secs || key.easing == Easing::Hold {
            return Some((*key.scene).clone());
        }
        let neighbour = |index: Option<usize>| index.and_then(|index| self.keys.get(index));
        let before = neighbour(from.checked_sub(1));
        let after = neighbour(Some(next + 1));
        let secs_between = |a: &Key, b: &Key| b.time_secs - a.time_secs;
        let span_secs = secs_between(key, to);
        let span = Span {
            part: ((secs - key.time_secs) / span_secs).clamp(0.0, 1.0),
            is_linear: key.easing == Easing::Linear,
            secs: span_secs,
            before: joint(before.map(|before| (before.easing, secs_between(before, key)))),
            after: joint(after.map(|after| (to.easing, secs_between(to, after)))),
        };
        let scene = |key: &Key| key.scene.clone();
        Some(blend::scenes(
            [before.map(scene), Some(scene(key)), Some(scene(to)), after.map(scene)],
            &span,
        ))
    }

    /// The scene of frame `frame`.
    pub fn frame(&self, frame: u32) -> Option<Scene> {
        self.at(self.frame_secs(frame))
    }

    /// When the shutter opens and closes for frame `frame`, seconds; both the frame's time without motion blur.
    ///
    /// The frame's time is in the middle, except at the path's ends and near a cut, a key that a hold jumps to: a frame
    /// shows the light of one side only.
    pub fn shutter_secs(&self, frame: u32) -> [f64; 2] {
        let secs = self.frame_secs(frame);
        let half = 0.5 * self.shutter / f64::from(self.frames_per_second.max(1));
        let pairs = self.keys.iter().zip(self.keys.iter().skip(1));
        let cuts =
            pairs.filter(|(key, _)| key.easing == Easing::Hold).map(|(_, next)| next.time_secs);
        let [mut from, mut to] = [0.0, self.duration_secs().max(secs)];
        for cut in cuts {
            if cut <= secs {
                from = cut;
            } else {
                to = to.min(cut);
            }
        }
        [(secs - half).max(from).min(secs), (secs + half).min(to)]
    }

    /// The scenes of frame `frame` in the middle of `count` equal parts of the time in which the shutter is open.
    ///
    /// None without motion blur, and where nothing moves.
    pub fn shutter_scenes(&self, frame: u32, count: u32) -> Vec<Scene> {
        let [open, close] = self.shutter_secs(frame);
        if close <= open {
            return Vec::new();
        }
        let part = (close - open) / f64::from(count);
        let scenes = (0..count).filter_map(|i| self.at(open + (f64::from(i) + 0.5) * part));
        let scenes: Vec<_> = scenes.collect();
        if scenes.iter().all(|scene| *scene == scenes[0]) { Vec::new() } else { scenes }
    }

    /// Checks the keys' times and scenes.
    ///
    /// # Errors
    /// The first field at fault, by its path in the document.
    pub fn validate(&self) -> Result<(), Invalid> {
        let invalid = |path: String, message: String| Err(Invalid { path, message });
        let outside =
            |param: &Param, value: f64| format!("{value} is outside {}", param.range_text());
        let rate = f64::from(self.frames_per_second);
        if !FRAME_RATE.accepts(rate) {
            return invalid(FRAME_RATE.path.to_owned(), outside(&FRAME_RATE, rate));
        }
        if !SHUTTER.accepts(self.shutter) {
            return invalid(SHUTTER.path.to_owned(), outside(&SHUTTER, self.shutter));
        }
        if self.keys.len() > MAX_KEYS {
            let message = format!("has {} keys; a path has at most {MAX_KEYS}", self.keys.len());
            return invalid("path.keys".to_owned(), message);
        }
        let mut last_secs = f64::NEG_INFINITY;
        for (i, key) in self.keys.iter().enumerate() {
            let secs = key.time_secs;
            if !KEY_TIME.accepts(secs) {
                return invalid(KEY_TIME.path_at(i), outside(&KEY_TIME, secs));
            }
            if secs - last_secs <= SAME_SECS {
                let message = format!("{secs} is not later than the key before, at {last_secs}");
                return invalid(KEY_TIME.path_at(i), message);
            }
            last_secs = secs;
            key.scene.validate().map_err(|fault| Invalid {
                path: format!("path.keys[{i}].scene.{}", fault.path),
                ..fault
            })?;
        }
        Ok(())
    }
}

/// How a curve meets the stretch beyond a key.
///
/// In: the easing of that stretch, and the seconds that the stretch takes.
fn joint(beyond: Option<(Easing, f64)>) -> Joint {
    match beyond {
        None | Some((Easing::Hold, _)) => Joint::Rest,
        Some((Easing::Smooth, secs)) => Joint::Through { secs },
        Some((Easing::Linear, secs)) => Joint::Along { secs },
    }
}

#[cfg(test)]
mod tests;
