//! The set itself: its formula, the formula's parameters, how far orbits are followed.

use egui::{Button, Ui, vec2};

use super::context::{Context, Section};
use crate::{
    formula::table::{Kind, Value},
    scene::{
        Fractal,
        param::{self, Param},
    },
    ui::{
        theme,
        widgets::{choice, param_slider, param_slider_count},
    },
};

/// The formula's first number, with buttons for the values that many choose.
pub(super) fn headline(ui: &mut Ui, cx: &mut Context<'_>) {
    let fractal = &mut cx.scene.fractal;
    let first = fractal.fields_mut().next();
    if let Some((field, Value::Number(value))) = first
        && let Kind::Number { param, quick } = field.kind
    {
        let slider = param_slider(ui, param, value);
        cx.rects.record(field.name, &slider);
        quick_values(ui, param, quick, value);
    }
    keep_bailout_in_reach(fractal);
}

fn quick_values(ui: &mut Ui, param: &Param, quick: &[f64], value: &mut f64) {
    if quick.is_empty() {
        return;
    }
    let gap = 4.0;
    let count = quick.len() as f32;
    let size =
        vec2((ui.available_width() - gap * (count - 1.0)) / count, ui.spacing().interact_size.y);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = gap;
        ui.spacing_mut().button_padding.x = 2.0;
        for &quick in quick {
            let chosen = *value == quick;
            let fill = if chosen { ui.visuals().selection.bg_fill } else { theme::RAISED };
            let button = Button::selectable(chosen, quick.to_string()).fill(fill);
            let name = format!("{} {quick}", param.label);
            let response = ui.add_sized(size, button).on_hover_text(&name);
            if response.clicked() {
                *value = quick;
            }
            response.accessible_name(name);
        }
    });
}

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "fractal",
    title: "Fractal",
    hover: "The formula, its form and its detail",
    show,
};

/// The formula, its other parameters, iterations and bailout.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    super::formula::choose(ui, cx);
    let fractal = &mut cx.scene.fractal;
    let is_on: Vec<bool> = fractal
        .fields()
        .map(|(field, _)| field.only_with.is_none_or(|switch| fractal.is_on(switch)))
        .collect();
    // The headline shows a first number.
    let first = fractal.fields().next();
    let shown_above = first.is_some_and(|(field, _)| matches!(field.kind, Kind::Number { .. }));
    let others = fractal.fields_mut().zip(is_on).skip(usize::from(shown_above));
    for ((field, value), is_shown) in others {
        if is_shown {
            ui.push_id(field.name, |ui| edit(ui, field.kind, value));
        }
    }
    param_slider_count(ui, &param::ITERATIONS, &mut fractal.iterations);
    let bailout = Param { max: fractal.max_bailout(), ..param::BAILOUT };
    param_slider(ui, &bailout, &mut fractal.bailout);
}

fn edit(ui: &mut Ui, kind: Kind, value: &mut Value) {
    match (kind, value) {
        (Kind::Number { param, quick }, Value::Number(number)) => {
            param_slider(ui, param, number);
            quick_values(ui, param, quick, number);
        }
        (Kind::Vector { param, labels, default }, Value::Vector(numbers)) => {
            let components = numbers.iter_mut().zip(labels).zip(default);
            for (axis, ((number, label), &default)) in components.enumerate() {
                let param = Param { label, default, ..*param };
                ui.push_id(axis, |ui| param_slider(ui, &param, number));
            }
        }
        (Kind::Switch { label, options: [off, on], .. }, Value::Switch(is_on)) => {
            let options = [(false, off.label, off.help), (true, on.label, on.help)];
            choice(ui, label, is_on, &options);
        }
        (Kind::Choice { label, options }, Value::Choice(word)) => {
            let options: Vec<_> = options.iter().map(|o| (o.word, o.label, o.help)).collect();
            choice(ui, label, word, &options);
        }
        // A value is of its field's kind.
        _ => {}
    }
}

/// A higher power allows only a smaller bailout.
fn keep_bailout_in_reach(fractal: &mut Fractal) {
    fractal.bailout = fractal.bailout.min(fractal.max_bailout());
}
