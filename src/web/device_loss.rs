//! What to do when the GPU is lost: how often to try again, and how carefully.
//!
//! In: the moments of earlier losses, kept for the tab. Out: whether another start is allowed, and
//! the caution to start with. Browsers take the GPU away from a site that loses it twice within two
//! minutes, and the load that lost it must not be what comes back.

use serde::{Deserialize, Serialize};

use super::{page, storage};

/// Losses older than this are forgiven, seconds.
const FORGIVEN_AFTER_SECS: f64 = 120.0;
/// Starts allowed after as many losses within [`FORGIVEN_AFTER_SECS`].
const MAX_RETRIES: usize = 2;
/// The linear scale of a careful picture: a quarter of the pixels.
const CAREFUL_SCALE: f64 = 0.5;

/// How much is risked with the scene in view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Caution {
    /// Nothing has gone wrong.
    #[default]
    None,
    /// The GPU was lost: a smaller picture, until one is finished.
    Smaller,
    /// The GPU was lost with this very scene: nothing is drawn until someone changes it.
    Paused,
}

impl Caution {
    /// By how much each side of the picture is scaled.
    pub fn scale(self) -> f64 {
        if self == Self::None { 1.0 } else { CAREFUL_SCALE }
    }

    /// What the person at the page is told, if anything.
    pub fn explain(self) -> Option<&'static str> {
        match self {
            Self::None => None,
            Self::Smaller => Some(
                "The graphics card was lost and started again, with a smaller picture for now.",
            ),
            Self::Paused => Some(
                "The graphics card was lost while drawing this scene, so it is paused. Move the view or change the scene to go on.",
            ),
        }
    }
}

/// The losses of this tab, kept across reloads.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Losses {
    /// When, in seconds since 1970.
    at_secs: Vec<f64>,
    /// The scene that was being drawn at the last one, as a fragment.
    scene: Option<String>,
}

impl Losses {
    fn recall() -> Self {
        storage::LOSSES.read().and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
    }

    fn recent(&self, now_secs: f64) -> usize {
        self.at_secs.iter().filter(|at| (now_secs - **at).abs() < FORGIVEN_AFTER_SECS).count()
    }

    fn keep(&self) {
        match serde_json::to_string(self) {
            Ok(text) => storage::LOSSES.write(&text),
            Err(error) => log::warn!("the loss is not kept: {error}"),
        }
    }
}

/// The caution with which to open `scene`, a fragment, when the page is loaded.
pub fn caution_at_start(scene: Option<&str>) -> Caution {
    let losses = Losses::recall();
    if losses.recent(page::epoch_secs()) == 0 {
        Caution::None
    } else if losses.scene.is_some() && losses.scene.as_deref() == scene {
        Caution::Paused
    } else {
        Caution::Smaller
    }
}

/// Notes that the GPU was lost while `scene` was drawn. The caution for the next start, or nothing
/// if there were too many losses to try again.
pub fn note_loss(scene: Option<String>) -> Option<Caution> {
    let now_secs = page::epoch_secs();
    let mut losses = Losses::recall();
    losses.at_secs.retain(|at| (now_secs - at).abs() < FORGIVEN_AFTER_SECS);
    losses.at_secs.push(now_secs);
    losses.scene = scene;
    losses.keep();
    match losses.recent(now_secs) {
        1 => Some(Caution::Smaller),
        count if count <= MAX_RETRIES => Some(Caution::Paused),
        _ => None,
    }
}

/// Notes that a whole picture of the scene in view was finished: it is not to blame.
pub fn note_finished() {
    let mut losses = Losses::recall();
    if losses.scene.take().is_some() {
        losses.keep();
    }
}
