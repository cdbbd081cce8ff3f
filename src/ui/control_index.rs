//! The names of all controls of the panel and the timeline, for the finder.
//!
//! In: the project and the settings. Out: each control's name, help and part. The names are read from the accessibility
//! tree of frames that are never painted, with every section open: a new control is in the index by itself.

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
const NUMBER: &str = " value";

/// A control of the panel or the timeline.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// The name, without [`NUMBER`].
    pub name: String,
    /// The name in the accessibility tree.
    pub label: String,
    /// What it does.
    pub help: String,
    /// Where it is.
    pub part: PanelPart,
}

/// The controls that the project has, then those that other projects have.
pub fn controls(
    project: &Project,
    settings: &Settings,
    inputs: &DisplayInputs<'_>,
) -> Vec<Control> {
    let inputs = DisplayInputs { export: None, ..*inputs };
    let ctx = egui::Context::default();
    theme::install(&ctx);
    ctx.enable_accesskit();
    let mut controls: Vec<Control> = Vec::new();
    for sample in samples(project, settings) {
        for part in panel::parts() {
            for element in elements(&ctx, sample.clone(), part, &inputs).elements {
                let Some(control) = control(element, part) else { continue };
                let is_same = |known: &Control| {
                    known.name == control.name && known.part.title() == control.part.title()
                };
                if !controls.iter().any(is_same) {
                    controls.push(control);
                }
            }
        }
    }
    controls
}

/// The control of an element; none for texts and for headings of sections.
fn control(element: Element, part: PanelPart) -> Option<Control> {
    let is_control = match element.kind {
        Kind::Text | Kind::Image | Kind::Alert | Kind::Progress => false,
        Kind::Button { expanded, .. } => expanded.is_none(),
        _ => true,
    };
    let label = element.name;
    let name = label.strip_suffix(NUMBER).unwrap_or(&label).to_owned();
    let help = element.help.unwrap_or_default();
    (is_control && !name.is_empty()).then_some(Control { name, label, help, part })
}

/// What the panel shows in a frame.
#[derive(Clone)]
struct Sample {
    project: Project,
    settings: Settings,
    selection: Selection,
}

/// The project itself, and projects with controls that it lacks.
fn samples(project: &Project, settings: &Settings) -> [Sample; 3] {
    let with_path = |mut project: Project| {
        let key = |time_secs| Key {
            time_secs,
            easing: Easing::default(),
            scene: project.scene.clone().into(),
        };
        if project.path.is_empty() {
            project.path.keys = vec![key(0.0), key(1.0)];
        }
        project
    };
    let mandelbox = formula::find("mandelbox").map(Fractal::new);
    let mix = presets::mixes().first().map(|preset| (preset.scene)().fractal);
    let [mut one, mut other] = [mandelbox, mix].map(|fractal| {
        let scene = Scene { fractal: fractal.unwrap_or_default(), ..Scene::default() };
        (scene, settings.clone())
    });
    for (scene, settings) in [&mut one, &mut other] {
        scene.lights.point.push(PointLight::default());
        scene.fractal.section_planes.push(SectionPlane::default());
        scene.camera.stereo.layout = StereoLayout::SideBySide;
        scene.lights.rig.kind = RigKind::Sky;
        scene.surface.second_layer.amount = 0.5;
        settings.export.times = 0;
    }
    one.1.export.file.format = StillFormat::Jpeg;
    other.1.export.file.format = StillFormat::Png;
    other.0.surface.coloring.source = ColorSource::AxisTrap;
    let sample = |project: Project, settings: Settings, light| Sample {
        project: with_path(project),
        settings,
        selection: Selection::of(light),
    };
    [
        sample(project.clone(), settings.clone(), LightRef::Environment(0)),
        sample(one.0.into(), one.1, LightRef::Environment(0)),
        sample(other.0.into(), other.1, LightRef::Point(0)),
    ]
}

/// The elements of a part of the panel.
fn elements(
    ctx: &egui::Context,
    sample: Sample,
    part: PanelPart,
    inputs: &DisplayInputs<'_>,
) -> Elements {
    let Sample { project: Project { mut scene, mut path }, mut settings, mut selection } = sample;
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
