//! The bloom panel.

use egui::Ui;

use super::context::{Context, Section};
use crate::{
    scene::{Bloom, BloomOrder, Scene, param},
    ui::widgets::{choice, param_slider, param_slider_count},
};

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "bloom",
    title: "Bloom",
    hover: "A soft glow around bright spots",
    show,
    reset: |cx| reset(cx.scene),
};

/// Restores the settings of a new scene.
fn reset(scene: &mut Scene) {
    scene.bloom = Bloom::default();
}

/// Strength, radius, threshold, passes, and the order relative to the tone curve.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let bloom = &mut cx.scene.bloom;
    param_slider(ui, &param::BLOOM_STRENGTH, &mut bloom.strength);
    param_slider(ui, &param::BLOOM_RADIUS, &mut bloom.radius);
    param_slider(ui, &param::BLOOM_THRESHOLD, &mut bloom.threshold);
    param_slider_count(ui, &param::BLOOM_PASSES, &mut bloom.passes);
    choice(
        ui,
        "Added",
        &mut bloom.order,
        &[
            (
                BloomOrder::Before,
                "Before curve",
                "Adds the glow to the light, as in a camera's lens",
            ),
            (
                BloomOrder::After,
                "After curve",
                "Adds the glow to the finished picture: colours become stronger",
            ),
        ],
    );
}
