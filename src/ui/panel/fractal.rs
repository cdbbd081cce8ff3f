//! The set itself: its power, its form, how far its orbits are followed.

use egui::{Button, Ui, vec2};

use super::Context;
use crate::{
    scene::{
        Fractal, Variant,
        param::{self, Param},
    },
    ui::{
        theme,
        widgets::{choice, param_slider, param_slider_count},
    },
};

/// Powers that have a button: whole numbers take the fast path.
const QUICK_POWERS: [u32; 8] = [2, 3, 4, 5, 6, 7, 8, 9];

/// The power, with buttons for small whole numbers.
pub(super) fn power(ui: &mut Ui, cx: &mut Context<'_>) {
    let fractal = &mut cx.scene.fractal;
    let slider = param_slider(ui, &param::POWER, &mut fractal.power);
    cx.rects.record("power", &slider);
    let gap = 4.0;
    let count = QUICK_POWERS.len() as f32;
    let size =
        vec2((ui.available_width() - gap * (count - 1.0)) / count, ui.spacing().interact_size.y);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = gap;
        ui.spacing_mut().button_padding.x = 2.0;
        for power in QUICK_POWERS {
            let chosen = fractal.power == f64::from(power);
            let fill = if chosen { ui.visuals().selection.bg_fill } else { theme::RAISED };
            let button = Button::selectable(chosen, power.to_string()).fill(fill);
            let response = ui
                .add_sized(size, button)
                .on_hover_text(format!("Power {power}: a whole number is drawn fastest"));
            if response.clicked() {
                fractal.power = f64::from(power);
            }
            response.accessible_name(format!("Power {power}"));
        }
    });
    keep_bailout_in_reach(fractal);
}

/// Form, iterations, bailout, variant.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let fractal = &mut cx.scene.fractal;
    choice(
        ui,
        "Form",
        &mut fractal.julia,
        &[
            (false, "Mandelbulb", "Each point adds itself at every step"),
            (true, "Julia", "All points add the same constant at every step"),
        ],
    );
    if fractal.julia {
        for (axis, (value, label)) in fractal
            .julia_constant
            .iter_mut()
            .zip(["Constant x", "Constant y", "Constant z"])
            .enumerate()
        {
            let param = Param { label, ..param::JULIA_CONSTANT };
            ui.push_id(axis, |ui| param_slider(ui, &param, value));
        }
    }
    param_slider_count(ui, &param::ITERATIONS, &mut fractal.iterations);
    let bailout = Param { max: fractal.max_bailout(), ..param::BAILOUT };
    param_slider(ui, &bailout, &mut fractal.bailout);
    choice(
        ui,
        "Sine of the latitude",
        &mut fractal.variant,
        &[
            (
                Variant::PositiveSine,
                "Positive",
                "The bulb that everyone knows: + sin in the height",
            ),
            (
                Variant::NegativeSine,
                "Negative",
                "The sign as one printed formula has it: − sin, another set",
            ),
        ],
    );
}

/// A higher power allows only a smaller bailout.
fn keep_bailout_in_reach(fractal: &mut Fractal) {
    fractal.bailout = fractal.bailout.min(fractal.max_bailout());
}
