//! Policy after losses of the GPU: how often to restart, in which safe mode, and what to open.
//!
//! In: the times of losses and the scenes in view, which the shell stores. Out: the safe mode of a restart or of the
//! next visit. Browsers block a site's GPU after two losses within two minutes, and a scene that lost the GPU must
//! not start by itself.

use serde::{Deserialize, Serialize};

/// Seconds after which a loss no longer counts against restarts.
const RECENT_SECS: f64 = 120.0;
/// Seconds within which losses of several tabs are one.
const SAME_LOSS_SECS: f64 = 1.0;
/// Most losses within [`RECENT_SECS`] after which the page still restarts.
const MAX_RESTARTS: usize = 2;
/// Losses of a scene without a complete picture after which a visit does not open the scene by itself.
const OFFERED_LOSSES: u32 = 2;
/// Linear scale of a reduced picture: a quarter of the pixels.
const REDUCED_SCALE: f64 = 0.5;

/// How much load the page puts on the GPU after a loss.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SafeMode {
    /// Full load.
    #[default]
    Off,
    /// A smaller picture, until one is complete.
    Reduced,
    /// No picture until the scene, which lost the GPU, changes.
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

/// How a visit begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// With the scene of the address or of the last visit, in a safe mode.
    Open(SafeMode),
    /// With another scene: that one lost the GPU several times, and is offered by a notice.
    Offer,
}

/// The losses of the GPU, stored across visits.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GpuLosses {
    /// Times of the recent losses, in seconds since 1970.
    at_secs: Vec<f64>,
    /// The scene in view at the last loss, as text; none once a picture of it was complete.
    scene: Option<String>,
    /// Losses since the last complete picture.
    since_picture: u32,
}

impl GpuLosses {
    /// The losses that a stored text describes; none of an unreadable text.
    pub fn from_json(text: &str) -> Self {
        serde_json::from_str(text).unwrap_or_default()
    }

    /// As text, for the storage.
    pub fn to_json(&self) -> String {
        // Numbers and texts always have a JSON form.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Adds a loss while `scene` was in view; none if an export was being drawn, which says nothing of the scene.
    ///
    /// `own_secs` is the time of this visit's last loss. Returns the safe mode of the restart; none after too many
    /// losses.
    pub fn note(
        &mut self,
        scene: Option<String>,
        now_secs: f64,
        own_secs: Option<f64>,
    ) -> Option<SafeMode> {
        // A clock that was set back leaves times in the future, which count as long.
        self.at_secs.retain(|at| (now_secs - at).abs() < RECENT_SECS);
        // A GPU that stops is lost to all tabs at once, and the first to note it counts it.
        let is_noted = self.at_secs.last().is_some_and(|at| {
            (now_secs - at).abs() < SAME_LOSS_SECS && own_secs.is_none_or(|own| own < *at)
        });
        if !is_noted {
            self.at_secs.push(now_secs);
            // Older times than those that decide are of no use.
            let excess = self.at_secs.len().saturating_sub(MAX_RESTARTS + 1);
            self.at_secs.drain(..excess);
            if scene.is_some() {
                self.scene = scene;
                self.since_picture = self.since_picture.saturating_add(1);
            }
        }
        match self.at_secs.len() {
            1 => Some(SafeMode::Reduced),
            count if count <= MAX_RESTARTS => Some(SafeMode::Paused),
            _ => None,
        }
    }

    /// How a visit begins whose address or storage names `scene`.
    pub fn start(&self, scene: &str, now_secs: f64) -> Start {
        let is_recent = self.at_secs.iter().any(|at| (now_secs - at).abs() < RECENT_SECS);
        if self.scene.as_deref() == Some(scene) {
            match self.since_picture >= OFFERED_LOSSES {
                true => Start::Offer,
                false => Start::Open(SafeMode::Paused),
            }
        } else if is_recent {
            Start::Open(SafeMode::Reduced)
        } else {
            Start::Open(SafeMode::Off)
        }
    }

    /// Notes a complete picture of a scene that does not lose the GPU. True where that changes what is stored.
    pub fn note_complete_picture(&mut self) -> bool {
        self.since_picture = 0;
        self.scene.take().is_some()
    }

    /// Notes a complete picture of a scene that was not in view at a loss: losses before it are no series. True where
    /// that changes what is stored.
    pub fn note_other_picture(&mut self) -> bool {
        std::mem::take(&mut self.since_picture) > 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(losses: &[(&str, f64)]) -> (GpuLosses, Vec<Option<SafeMode>>) {
        let mut kept = GpuLosses::default();
        let modes =
            losses.iter().map(|&(scene, at)| kept.note(Some(scene.to_owned()), at, None)).collect();
        (kept, modes)
    }

    #[test]
    fn restarts_put_less_and_less_on_the_gpu_and_end() {
        let (_, modes) = after(&[("a", 0.0), ("a", 10.0), ("a", 20.0), ("a", 30.0)]);
        assert_eq!(modes, [Some(SafeMode::Reduced), Some(SafeMode::Paused), None, None]);
    }

    #[test]
    fn a_loss_of_several_tabs_counts_once_and_one_of_an_export_blames_no_scene() {
        let mut kept = GpuLosses::default();
        assert_eq!(kept.note(Some("a".to_owned()), 100.0, None), Some(SafeMode::Reduced));
        assert_eq!(kept.note(Some("b".to_owned()), 100.2, None), Some(SafeMode::Reduced));
        assert_eq!(kept.scene.as_deref(), Some("a"));
        // The tab that noted it may lose the GPU again at once.
        let again = kept.note(Some("a".to_owned()), 100.4, Some(100.0));
        assert_eq!((again, kept.since_picture), (Some(SafeMode::Paused), 2));
        assert!(kept.note_other_picture() && !kept.note_other_picture());
        assert_eq!(kept.note(None, 900.0, None), Some(SafeMode::Reduced));
        assert_eq!((kept.scene.as_deref(), kept.since_picture), (Some("a"), 0));
    }

    #[test]
    fn losses_minutes_apart_restart_each_time() {
        let losses: Vec<_> = (0..10).map(|i| ("a", 121.0 * f64::from(i))).collect();
        let (kept, modes) = after(&losses);
        assert_eq!(modes, [Some(SafeMode::Reduced); 10]);
        assert_eq!(kept.at_secs.len(), 1, "what is stored does not grow");
    }

    #[test]
    fn a_scene_that_lost_the_gpu_does_not_start_by_itself() {
        let (once, _) = after(&[("a", 0.0)]);
        // However much later.
        for now_secs in [1.0, 1e9] {
            assert_eq!(once.start("a", now_secs), Start::Open(SafeMode::Paused));
            let (twice, _) = after(&[("a", 0.0), ("a", 500.0)]);
            assert_eq!(twice.start("a", 500.0 + now_secs), Start::Offer);
        }
    }

    #[test]
    fn other_scenes_start_smaller_at_first_and_soon_as_ever() {
        let (kept, _) = after(&[("a", 0.0), ("a", 10.0)]);
        assert_eq!(kept.start("b", 20.0), Start::Open(SafeMode::Reduced));
        assert_eq!(kept.start("b", 200.0), Start::Open(SafeMode::Off));
    }

    /// While the view moves, each loss is of another scene; the last one is stored.
    #[test]
    fn losses_of_a_moving_view_count_together() {
        let (kept, _) = after(&[("a", 0.0), ("b", 500.0)]);
        assert_eq!(kept.start("b", 1000.0), Start::Offer);
    }

    #[test]
    fn a_complete_picture_clears_the_scene() {
        let (mut kept, _) = after(&[("a", 0.0), ("a", 500.0)]);
        assert!(kept.note_complete_picture());
        assert!(!kept.note_complete_picture());
        assert_eq!(kept.start("a", 1000.0), Start::Open(SafeMode::Off));
        // A later loss is a first one again.
        assert_eq!(kept.note(Some("a".to_owned()), 2000.0, None), Some(SafeMode::Reduced));
        assert_eq!(kept.start("a", 3000.0), Start::Open(SafeMode::Paused));
    }

    #[test]
    fn losses_are_stored_as_they_are_and_damage_counts_as_none() {
        let (kept, _) = after(&[("a", 0.5), ("b", 1.5)]);
        assert_eq!(GpuLosses::from_json(&kept.to_json()), kept);
        for text in ["", "{", "[]", "{\"at_secs\":[1e999]}", "{\"more\":1}", "null"] {
            assert_eq!(GpuLosses::from_json(text), GpuLosses::default(), "{text}");
        }
    }
}
