//! Light that spreads around what is bright.

use egui::Ui;

use super::Context;
use crate::{
    scene::{BloomOrder, param},
    ui::widgets::{choice, param_slider, param_slider_count},
};

/// Strength, radius, threshold, passes, and where in the order of things it is added.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
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
            (BloomOrder::Before, "Before curve", "Added to the light, as a lens does"),
            (
                BloomOrder::After,
                "After curve",
                "Added to what the tone curve gave: some of the colour that it took comes back",
            ),
        ],
    );
}
