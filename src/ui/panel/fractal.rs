//! The set itself: its formula, the formula's parameters, how far orbits are followed.

use egui::Ui;

use super::{
    context::{Context, Section},
    fields::{edit_fields, quick_values},
};
use crate::{
    formula::table::{Kind, Value},
    scene::{
        Fractal, Scene,
        param::{self, Param},
    },
    ui::widgets::{param_slider, param_slider_count, param_slider_wide},
};

/// The formula's first number, with buttons for the values that many choose.
pub(super) fn headline(ui: &mut Ui, cx: &mut Context<'_>) {
    let fractal = &mut cx.scene.fractal;
    let first = fractal.fields_mut().next();
    if let Some((field, Value::Number(value))) = first
        && let Kind::Number { param, quick } = field.kind
    {
        let slider = param_slider_wide(ui, param, value);
        cx.rects.record(field.name, &slider);
        quick_values(ui, param, quick, value);
    }
    keep_bailout_in_reach(fractal);
}

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "fractal",
    title: "Fractal",
    hover: "The formula, its form and its detail",
    show,
    reset: |cx| reset(cx.scene),
};

/// Restores the formula's own values; steps of a hybrid and section planes stay.
fn reset(scene: &mut Scene) {
    let fractal = &mut scene.fractal;
    for (field, value) in fractal.fields_mut() {
        *value = field.default();
    }
    let new = Fractal::new(fractal.formula());
    (fractal.iterations, fractal.bailout) = (new.iterations, new.bailout);
    keep_bailout_in_reach(fractal);
}

/// The formula, its other parameters, iterations and bailout.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    super::formula::choose(ui, cx);
    super::hybrid::show(ui, cx);
    let fractal = &mut cx.scene.fractal;
    let is_on: Vec<bool> = fractal
        .fields()
        .map(|(field, _)| field.only_with.is_none_or(|switch| fractal.is_on(switch)))
        .collect();
    // The headline shows a first number.
    let first = fractal.fields().next();
    let shown_above = first.is_some_and(|(field, _)| matches!(field.kind, Kind::Number { .. }));
    let others = fractal.fields_mut().zip(is_on).skip(usize::from(shown_above));
    edit_fields(ui, others.filter(|(_, is_shown)| *is_shown).map(|(field, _)| field));
    param_slider_count(ui, &param::ITERATIONS, &mut fractal.iterations);
    let bailout = Param { max: fractal.max_bailout(), ..param::BAILOUT };
    param_slider(ui, &bailout, &mut fractal.bailout);
}

/// A higher power allows only a smaller bailout.
fn keep_bailout_in_reach(fractal: &mut Fractal) {
    fractal.bailout = fractal.bailout.min(fractal.max_bailout());
}
