//! The names of all controls of the panel and the timeline, for the finder.
//!
//! In: the project and the settings. Out: each control's name, help and part. The names are read from the accessibility
//! tree of frames that are never painted, with every section open: a new control is in the index by itself.

use std::{cell::OnceCell, sync::Arc};

use egui::{Pos2, RawInput, Rect, vec2};

use super::{
    accessibility::{Element, Elements, Kind},
    display_inputs::DisplayInputs,
    export_size::StillFormat,
    favourites::Favourites,
    look_preview::LookPreview,
    panel::{self, Context, PanelPart},
    rects::Rects,
    selection::{LightRef, Selection},
    settings::Settings,
    theme,
    timeline::Timeline,
};
use crate::{
    formula::{self, Fractal, section::SectionPlane},
    scene::{
        ColorSource, PointLight, Project, RigKind, Scene, StereoLayout,
        path::{Easing, Key},
        presets,
    },
};

/// Size of the frames, in points: nothing is scrolled out of them.
const SIZE: egui::Vec2 = vec2(theme::PANEL_WIDTH, 8000.0);
/// Width of the timeline's frames, in points.
const TIMELINE_WIDTH: f32 = 1600.0;
/// The end of a number field's name, after the name of its slider.
const NUMBER_SUFFIX: &str = " value";

/// A control of the panel or the timeline.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// The name, without [`NUMBER_SUFFIX`].
    pub name: String,
    /// The name in the accessibility tree.
    pub label: String,
    /// What it does.
    pub help: String,
    /// Where it is.
    pub part: PanelPart,
}

/// The names of controls, for each opening of the finder.
#[derive(Debug, Default)]
pub struct ControlIndex {
    /// The context of the frames; its fonts are laid out once.
    ctx: OnceCell<egui::Context>,
    /// The controls of [`fixed_states`].
    of_fixed_states: OnceCell<Vec<Control>>,
}

impl ControlIndex {
    /// The controls that the project has, then those that other projects have.
    pub fn controls(
        &self,
        project: &Project,
        settings: &Settings,
        inputs: &DisplayInputs<'_>,
    ) -> Vec<Control> {
        let inputs = DisplayInputs { export: None, ..*inputs };
        let ctx = self.ctx.get_or_init(|| {
            let ctx = egui::Context::default();
            theme::install(&ctx);
            ctx.enable_accesskit();
            ctx
        });
        let of_fixed_states = self.of_fixed_states.get_or_init(|| {
            let controls = fixed_states().into_iter().flat_map(|state| {
                let controls = controls_of(ctx, &state, &inputs);
                controls.filter(|control| !is_of_one_scene(control)).collect::<Vec<_>>()
            });
            controls.collect()
        });
        let present = IndexedState {
            project: project.clone(),
            settings: settings.clone(),
            selection: Selection::of(LightRef::Environment(0)),
        };
        let mut controls: Vec<Control> = Vec::new();
        for control in controls_of(ctx, &present, &inputs).chain(of_fixed_states.iter().cloned()) {
            let is_same = |known: &Control| {
                known.name == control.name && known.part.title() == control.part.title()
            };
            if !controls.iter().any(is_same) {
                controls.push(control);
            }
        }
        controls
    }
}

/// The controls that a state has.
fn controls_of<'a>(
    ctx: &'a egui::Context,
    state: &'a IndexedState,
    inputs: &'a DisplayInputs<'_>,
) -> impl Iterator<Item = Control> + 'a {
    panel::parts().flat_map(move |part| {
        let elements = elements(ctx, state.clone(), part, inputs).elements;
        elements.into_iter().filter_map(move |element| control(element, part))
    })
}

/// What scenes have in different numbers; a control's name has its number after the word.
const NUMBERED: [&str; 6] = ["key", "light", "plane", "point", "step", "stop"];

/// True for a control of a numbered thing, such as a light, which not every scene has.
fn is_of_one_scene(control: &Control) -> bool {
    let name = control.name.to_lowercase();
    let words: Vec<&str> = name.split_whitespace().collect();
    let is_number = |word: &str| word.chars().all(|c| c.is_ascii_digit());
    // The steps of a hybrid are called `1 Rotation`.
    let is_step = words.len() > 1 && is_number(words[0]);
    is_step || words.windows(2).any(|pair| NUMBERED.contains(&pair[0]) && is_number(pair[1]))
}

/// The control of an element; none for texts and for headings of sections.
fn control(element: Element, part: PanelPart) -> Option<Control> {
    let is_control = match element.kind {
        Kind::Text | Kind::Image | Kind::Alert | Kind::Progress => false,
        Kind::Button { expanded, .. } => expanded.is_none(),
        _ => true,
    };
    let label = element.name;
    let name = label.strip_suffix(NUMBER_SUFFIX).unwrap_or(&label).to_owned();
    let help = element.help.unwrap_or_default();
    (is_control && !name.is_empty()).then_some(Control { name, label, help, part })
}

/// What the panel and the timeline show in a frame.
#[derive(Clone)]
struct IndexedState {
    project: Project,
    settings: Settings,
    selection: Selection,
}

/// States that together have all controls which depend on the formula and on choices.
fn fixed_states() -> [IndexedState; 2] {
    let mandelbox = formula::find("mandelbox").map(Fractal::new);
    let hybrid = presets::mixes().first().map(|preset| (preset.scene)().fractal);
    let [mut formula_state, mut hybrid_state] = [mandelbox, hybrid].map(|fractal| {
        let mut scene = Scene { fractal: fractal.unwrap_or_default(), ..Scene::default() };
        scene.lights.point.push(PointLight::default());
        scene.fractal.section_planes.push(SectionPlane::default());
        scene.camera.stereo.layout = StereoLayout::SideBySide;
        scene.lights.rig.kind = RigKind::Sky;
        scene.surface.second_layer.amount = 0.5;
        let mut settings = Settings::default();
        settings.export.times = 0;
        let selection = Selection::of(LightRef::Environment(0));
        IndexedState { project: scene.into(), settings, selection }
    });
    formula_state.settings.export.file.format = StillFormat::Jpeg;
    hybrid_state.settings.export.file.format = StillFormat::Png;
    hybrid_state.project.scene.surface.coloring.source = ColorSource::AxisTrap;
    hybrid_state.selection = Selection::of(LightRef::Point(0));
    for state in [&mut formula_state, &mut hybrid_state] {
        let Project { scene, path } = &mut state.project;
        let scene: Arc<Scene> = scene.clone().into();
        let key = |time_secs| Key { time_secs, easing: Easing::default(), scene: scene.clone() };
        path.keys = vec![key(0.0), key(1.0)];
    }
    [formula_state, hybrid_state]
}

/// The elements of a part of the panel.
fn elements(
    ctx: &egui::Context,
    state: IndexedState,
    part: PanelPart,
    inputs: &DisplayInputs<'_>,
) -> Elements {
    let IndexedState { project: Project { mut scene, mut path }, mut settings, mut selection } =
        state;
    let (mut favourites, mut rects) = (Favourites::default(), Rects::default());
    let (mut look_preview, mut histogram_shown) = (LookPreview::default(), false);
    let (mut commands, mut actions) = (Vec::new(), Vec::new());
    let mut timeline = Timeline::default();
    timeline.select(&path, 0);
    let size = if part == PanelPart::Timeline { vec2(TIMELINE_WIDTH, SIZE.y) } else { SIZE };
    let screen = Rect::from_min_size(Pos2::ZERO, size);
    let input = RawInput { screen_rect: Some(screen), ..RawInput::default() };
    let mut output = ctx.run_ui(input, |ui| {
        let mut cx = Context {
            scene: &mut scene,
            settings: &mut settings,
            selection: &mut selection,
            favourites: &mut favourites,
            rects: &mut rects,
            look_preview: &mut look_preview,
            histogram_shown: &mut histogram_shown,
            commands: &mut commands,
            actions: &mut actions,
            inputs,
            environment_map: None,
            gradients: &[],
            camera_status: None,
            view_px: [1280, 720],
            is_sheet: false,
            flying: false,
            can_undo: true,
            can_redo: true,
        };
        panel::show_part(ui, &mut cx, part, &mut path, &mut timeline);
    });
    output.textures_delta.clear();
    output.platform_output.accesskit_update.map(|tree| Elements::of_tree(&tree)).unwrap_or_default()
}
