//! The indirect light panel.

use egui::{RichText, Ui};

use super::context::{Context, Section};
use crate::{
    scene::{Indirect, IndirectKind, IntegratorKind, IntegratorSettings, Scene, param},
    ui::{
        theme,
        widgets::{Help as _, choice, param_slider, param_slider_count},
    },
};

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "indirect",
    title: "Indirect light",
    hover: "Light that bounces from one surface to another",
    show,
    reset: |cx| reset(cx.scene),
};

/// Restores the settings of a new scene.
fn reset(scene: &mut Scene) {
    (scene.indirect, scene.integrator) = (Indirect::default(), IntegratorSettings::default());
}

/// Path tracing: its bounces and their reach.
fn paths(ui: &mut Ui, cx: &mut Context<'_>) {
    let mut is_on = cx.scene.traces_paths();
    let hover = "Realistic light: when the picture stops moving, light bounces between surfaces and brightens shadows. Slow.";
    if ui.checkbox(&mut is_on, "Path tracing").help(hover).changed() {
        if is_on {
            cx.scene.trace_paths();
        } else {
            cx.scene.integrator.kind = IntegratorKind::Direct;
        }
    }
    if !is_on {
        return;
    }
    let integrator = &mut cx.scene.integrator;
    param_slider_count(ui, &param::BOUNCES, &mut integrator.bounces);
    let mut is_limited = integrator.reach.is_some();
    let limit = ui.checkbox(&mut is_limited, "Limit bounce distance").help(
        "Surfaces beyond the bounce distance neither light nor shade each other. Switch this on in close views, which are otherwise dark.",
    );
    if limit.changed() {
        integrator.reach = is_limited.then_some(param::BOUNCE_REACH.default);
    }
    if let Some(reach) = &mut integrator.reach {
        param_slider(ui, &param::BOUNCE_REACH, reach);
    }
    param_slider(ui, &param::NOISE, &mut integrator.noise);
    let mut is_limited = integrator.firefly_limit.is_some();
    let hover = "Removes bright dots. The status line says how much light goes with them.";
    if ui.checkbox(&mut is_limited, "Limit fireflies").help(hover).changed() {
        integrator.firefly_limit = is_limited.then_some(param::FIREFLY_LIMIT.default);
    }
    if let Some(limit) = &mut integrator.firefly_limit {
        param_slider(ui, &param::FIREFLY_LIMIT, limit);
    }
    ui.checkbox(&mut integrator.denoise, "Denoise")
        .help("Smooths the grain of path tracing; edges and patterns stay sharp");
    let text = "Quick approximation, shown while the picture moves:";
    ui.label(RichText::new(text).small().color(theme::TEXT_DIM));
}

/// Path tracing; the operator on the screen, its radius, strength and sampling.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    paths(ui, cx);
    let indirect = &mut cx.scene.indirect;
    choice(
        ui,
        "Indirect light",
        &mut indirect.kind,
        &[
            (IndirectKind::Off, "Off", "Only light directly from the lights"),
            (
                IndirectKind::Uniform,
                "Uniform",
                "Adds light from nearby surfaces, mostly those that face the same way",
            ),
            (
                IndirectKind::Horizon,
                "Horizon",
                "Darkens crevices and adds the colours of the surfaces around them",
            ),
        ],
    );
    if indirect.kind == IndirectKind::Off {
        return;
    }
    param_slider(ui, &param::INDIRECT_RADIUS, &mut indirect.radius);
    param_slider(ui, &param::INDIRECT_STRENGTH, &mut indirect.strength);
    if indirect.kind == IndirectKind::Horizon {
        param_slider(ui, &param::INDIRECT_AMBIENT, &mut indirect.ambient);
        param_slider_count(ui, &param::INDIRECT_DIRECTIONS, &mut indirect.directions);
    }
    param_slider_count(ui, &param::INDIRECT_SAMPLES, &mut indirect.samples);
}
