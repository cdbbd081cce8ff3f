//! Policy after a GPU loss: how often to restart, and in which safe mode.
//!
//! In: the times of earlier losses, stored with the tab. Out: whether to restart, and the safe mode.
//! Browsers block a site's GPU after two losses within two minutes, and the load that lost the
//! GPU must not come back unchanged.

use serde::{Deserialize, Serialize};

use super::{page, storage};

/// Seconds after which a loss no longer counts.
const RECENT_SECS: f64 = 120.0;
/// Most losses within [`RECENT_SECS`] after which the page still restarts.
const MAX_RETRIES: usize = 2;
/// The linear scale of a reduced picture: a quarter of the pixels.
const REDUCED_SCALE: f64 = 0.5;

/// How much load the page puts on the GPU after a loss.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SafeMode {
    /// Full load.
    #[default]
    Off,
    /// A smaller picture, until one is complete.
    Reduced,
    /// No picture until the visitor changes the scene, which lost the GPU.
    Paused,
}

impl SafeMode {
    /// The factor of each side of the picture.
    pub fn scale(self) -> f64 {
        if self == Self::Off { 1.0 } else { REDUCED_SCALE }
    }

    /// The notice to the visitor, if any.
    pub fn explain(self) -> Option<&'static str> {
        match self {
            Self::Off => None,
            Self::Reduced => Some(
                "The graphics card stopped and was started again. The picture is less sharp until it is complete.",
            ),
            Self::Paused => Some(
                "The graphics card stopped while it drew this scene, so drawing is paused. Move the view or change a setting to continue.",
            ),
        }
    }
}

/// The GPU losses of this tab, stored across reloads.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Losses {
    /// The time of each, in seconds since 1970.
    at_secs: Vec<f64>,
    /// The scene in view at the last loss, as a fragment.
    scene: Option<String>,
}

impl Losses {
    fn read() -> Self {
        storage::LOSSES.read().and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
    }

    fn count_recent(&self, now_secs: f64) -> usize {
        self.at_secs.iter().filter(|at| (now_secs - **at).abs() < RECENT_SECS).count()
    }

    fn write(&self) {
        match serde_json::to_string(self) {
            Ok(text) => {
                storage::LOSSES.write(&text);
            }
            Err(error) => log::warn!("cannot store the GPU loss: {error}"),
        }
    }
}

/// The safe mode in which a loaded page opens `scene`, a fragment.
pub fn safe_mode_at_start(scene: Option<&str>) -> SafeMode {
    let losses = Losses::read();
    if losses.count_recent(page::epoch_secs()) == 0 {
        SafeMode::Off
    } else if losses.scene.is_some() && losses.scene.as_deref() == scene {
        SafeMode::Paused
    } else {
        SafeMode::Reduced
    }
}

/// Stores a GPU loss with the scene in view, a fragment. Returns the safe mode of the restart;
/// `None` after too many losses to restart.
pub fn note_loss(scene: Option<String>) -> Option<SafeMode> {
    let now_secs = page::epoch_secs();
    let mut losses = Losses::read();
    losses.at_secs.retain(|at| (now_secs - at).abs() < RECENT_SECS);
    losses.at_secs.push(now_secs);
    losses.scene = scene;
    losses.write();
    match losses.count_recent(now_secs) {
        1 => Some(SafeMode::Reduced),
        count if count <= MAX_RETRIES => Some(SafeMode::Paused),
        _ => None,
    }
}

/// Clears the stored scene: a complete picture shows that it does not lose the GPU.
pub fn note_complete_picture() {
    let mut losses = Losses::read();
    if losses.scene.take().is_some() {
        losses.write();
    }
}
