//! The looks panel: swatches that change the appearance alone, and show what they do under the pointer.

use std::sync::Arc;

use egui::{Event, Id, Painter, Rect, RichText, ScrollArea, Sense, Ui, vec2};

use super::context::Context;
use crate::{
    scene::{
        Background, Bloom, Camera, Coloring, MediumKind, Scene, Surface, Tone,
        light_setups::SETUPS,
        looks::{self, Look, LookList},
    },
    ui::{
        light_handles::is_used_by_keyboard,
        sphere::{Sphere, background_colors, paint_background},
        widgets::{Help as _, NAME_HEIGHT, caption, choice_button, paint_bar, swatch},
    },
};

/// Gap between swatches, in points.
const GAP: f32 = 6.0;
/// Smallest width of a swatch, in points.
const MIN_WIDTH: f32 = 60.0;
/// Width of a swatch in a sheet's row, in points.
const STRIP_WIDTH: f32 = 84.0;
/// Height of a painting over its width.
const ASPECT: f32 = 0.64;
/// Height of a gradient's painting beside a pointer, and beside fingers, in points.
const BAR_HEIGHTS: [f32; 2] = [20.0, 28.0];

/// The headings of all lists, and a swatch for each look of the chosen list.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    caption(ui, "Appearance");
    let id = Id::unique("list of looks");
    let mut chosen: usize = ui.data(|data| data.get_temp(id)).unwrap_or(0);
    ui.horizontal_wrapped(|ui| {
        // All lists fit in one row of the panel.
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.spacing_mut().button_padding.x = 4.0;
        for (index, list) in looks::lists().iter().enumerate() {
            let text = RichText::new(list.name).small();
            let response = choice_button(ui, index == chosen, text).help(list.about);
            if response.clicked() {
                chosen = index;
                ui.data_mut(|data| data.insert_temp(id, chosen));
            }
            // A section of the panel has the same name.
            response.accessible_name(format!("Looks: {}", list.name));
        }
    });
    let Some(list) = looks::lists().get(chosen) else { return };
    let has_gradients = list.looks.iter().any(is_gradient);
    if has_gradients && cx.scene.medium.kind != MediumKind::None {
        ui.label("Translucent sets and clouds have no gradient. Choose their Inner colour under Surface.");
        return;
    }
    let paintings = paintings(ui, list, cx.scene);
    let painting_height = has_gradients.then(|| {
        let has_fingers = ui.spacing().interact_size.y >= 44.0;
        BAR_HEIGHTS[usize::from(has_fingers)]
    });
    arrange(ui, cx.is_sheet, list, painting_height, |ui, index, rect| {
        let Some((look, painting)) = list.looks.get(index).zip(paintings.get(index)) else {
            return;
        };
        look_swatch(ui, cx, list, look, painting, rect);
    });
}

/// One look's swatch.
fn look_swatch(
    ui: &Ui,
    cx: &mut Context<'_>,
    list: &LookList,
    look: &'static Look,
    painting: &Painting,
    rect: Rect,
) {
    let looked = looks::applied(look, cx.scene);
    let is_chosen = looked == *cx.scene;
    let title = format!("{}: {}", list.kind, look.name);
    let paint = |painter: &Painter, rect| painting.paint(painter, rect, look);
    let response = swatch(ui, rect, [&look.name, &title], is_chosen, paint).help(look.about);
    let (has_fingers, has_moved, is_pressed) = ui.input(|input| {
        let has_moved = input.events.iter().any(|event| matches!(event, Event::PointerMoved(_)));
        (input.any_touches(), has_moved, input.pointer.any_down())
    });
    // Fingers hover nowhere. A drag that began elsewhere leaves the focus without a preview.
    if response.hovered() && !has_fingers {
        cx.look_preview.hover(look, has_moved);
    } else if response.has_focus() && !is_pressed {
        cx.look_preview.focus(look);
    }
    // Shows light handles while a light setup is pointed at.
    let is_of_lights = look.lights.is_some() && look.material.is_none();
    cx.selection.uses_lights |=
        is_of_lights && (response.hovered() || is_used_by_keyboard(&response));
    if response.clicked() && !is_chosen {
        if look.lights.is_some() {
            cx.selection.light = None;
        }
        *cx.scene = looked;
    }
}

fn is_gradient(look: &Look) -> bool {
    look.gradient.is_some() && look.material.is_none()
}

/// What a swatch shows.
#[derive(Clone, Debug)]
enum Painting {
    /// The look's gradient.
    Gradient,
    /// The display colours of the background's edges.
    Background([egui::Color32; 2]),
    /// A sphere in the look.
    Sphere(Sphere),
}

impl Painting {
    fn of(look: &Look, sample: &Scene) -> Self {
        if is_gradient(look) {
            return Self::Gradient;
        }
        let looked = looks::applied(look, sample);
        if look.background.is_some() && look.material.is_none() {
            return Self::Background(background_colors(&looked.background, &looked.tone));
        }
        Self::Sphere(Sphere::of(&looked))
    }

    fn paint(&self, painter: &Painter, rect: Rect, look: &Look) {
        match self {
            Self::Gradient => {
                paint_bar(painter, rect, look.gradient.as_deref().unwrap_or_default());
            }
            Self::Background(edges) => paint_background(painter, rect, *edges),
            Self::Sphere(sphere) => sphere.paint(painter, rect),
        }
    }
}

/// The parts of a scene that show in paintings beside the look's own.
type Shown = (Surface, Background, Tone, Bloom);

/// The paintings of a list, made anew when what they show changes.
fn paintings(ui: &Ui, list: &LookList, scene: &Scene) -> Arc<Vec<Painting>> {
    let Scene { surface, background, tone, bloom, .. } = scene;
    // A close view's repeats would be stripes on the sphere.
    let surface = Surface { coloring: Coloring::default(), ..surface.clone() };
    let shown: Shown = (surface, background.clone(), tone.clone(), bloom.clone());
    let id = Id::unique(("paintings of looks", list.name));
    let known: Option<Arc<(Shown, Arc<Vec<Painting>>)>> = ui.data(|data| data.get_temp(id));
    if let Some(known) = known.filter(|known| known.0 == shown) {
        return known.1.clone();
    }
    let (surface, background, tone, bloom) = shown.clone();
    let camera = Camera::default();
    let lights = (SETUPS[0].lights)(&camera);
    let sample = Scene { surface, background, tone, bloom, camera, lights, ..Scene::default() };
    let all = list.looks.iter().map(|look| Painting::of(look, &sample)).collect();
    let made: Arc<(Shown, Arc<Vec<Painting>>)> = Arc::new((shown, Arc::new(all)));
    ui.data_mut(|data| data.insert_temp(id, made.clone()));
    made.1.clone()
}

/// Places a list's swatches: in a panel as many per row as fit, in a sheet in a row that scrolls sideways.
fn arrange(
    ui: &mut Ui,
    is_sheet: bool,
    list: &LookList,
    painting_height: Option<f32>,
    mut show: impl FnMut(&mut Ui, usize, Rect),
) {
    let count = list.looks.len();
    let size =
        |width: f32| vec2(width, painting_height.unwrap_or((width * ASPECT).round()) + NAME_HEIGHT);
    if is_sheet {
        let size = size(STRIP_WIDTH);
        ScrollArea::horizontal().id_salt(list.name).show(ui, |ui| {
            // Room for the outlines.
            let width = (size.x + GAP) * count as f32 + GAP;
            let (area, _) = ui.allocate_exact_size(vec2(width, size.y + 4.0), Sense::hover());
            for index in 0..count {
                let at = area.min + vec2(2.0 + (size.x + GAP) * index as f32, 2.0);
                show(ui, index, Rect::from_min_size(at, size));
            }
        });
        return;
    }
    let width = ui.available_width();
    let columns = (((width + GAP) / (MIN_WIDTH + GAP)).floor() as usize).clamp(2, 4);
    let size = size(((width - GAP * (columns - 1) as f32) / columns as f32).floor());
    let rows = count.div_ceil(columns) as f32;
    let (area, _) = ui.allocate_exact_size(vec2(width, (size.y + GAP) * rows), Sense::hover());
    for index in 0..count {
        let place = vec2((index % columns) as f32, (index / columns) as f32);
        let at = area.min + place * (size + vec2(GAP, GAP));
        show(ui, index, Rect::from_min_size(at, size));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_swatch_of_a_list_is_painted_in_its_own_way() {
        let sample = Scene::default();
        for list in looks::lists().iter().filter(|list| !list.looks.iter().any(is_gradient)) {
            let all: Vec<_> = list
                .looks
                .iter()
                .map(|look| format!("{:?}", Painting::of(look, &sample)))
                .collect();
            for (i, one) in all.iter().enumerate() {
                assert!(!all[..i].contains(one), "{} {}", list.name, list.looks[i].name);
            }
        }
    }
}
