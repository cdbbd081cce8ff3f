//! Controls of a formula's own parameters.

use egui::{Button, Ui};

use crate::{
    formula::table::{Field, Kind, Value},
    scene::param::Param,
    ui::{
        theme,
        widgets::{Help as _, button_row, choice, param_slider},
    },
};

/// A control for each field.
pub(super) fn edit_fields<'a>(
    ui: &mut Ui,
    fields: impl Iterator<Item = (&'static Field, &'a mut Value)>,
) {
    for (field, value) in fields {
        ui.push_id(field.name, |ui| edit(ui, field.kind, value));
    }
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

/// Buttons for the values that many choose.
pub(super) fn quick_values(ui: &mut Ui, param: &Param, quick: &[f64], value: &mut f64) {
    if quick.is_empty() {
        return;
    }
    button_row(ui, quick.len(), |ui, index, size| {
        let quick = quick[index];
        let chosen = *value == quick;
        let fill = if chosen { ui.visuals().selection.bg_fill } else { theme::RAISED };
        let button = Button::selectable(chosen, quick.to_string()).fill(fill);
        let name = format!("{} {quick}", param.label);
        let response = ui.add_sized(size, button).help(&name);
        if response.clicked() {
            *value = quick;
        }
        response.accessible_name(name);
    });
}
