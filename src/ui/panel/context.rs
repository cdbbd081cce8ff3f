//! What a panel is, the data that panels show and edit, and the lists of their requests.

use egui::Ui;

use crate::{
    scene::{EnvironmentMap, Scene},
    ui::{
        action::Action, display_inputs::DisplayInputs, editor::Editor, navigation::CameraStatus,
        rects::Rects, selection::Selection, settings::Settings, shortcuts::Command,
    },
};

/// A panel as a section of "More".
pub struct Section {
    /// A name, unique among sections: settings keep whether the section is open by it.
    pub name: &'static str,
    /// The heading.
    pub title: &'static str,
    /// The heading's tooltip.
    pub hover: &'static str,
    /// Draws the panel.
    pub show: fn(&mut Ui, &mut Context<'_>),
}

/// The data that the panels show and edit.
pub struct Context<'a> {
    pub scene: &'a mut Scene,
    pub settings: &'a mut Settings,
    pub selection: &'a mut Selection,
    pub rects: &'a mut Rects,
    pub commands: &'a mut Vec<Command>,
    pub actions: &'a mut Vec<Action>,
    pub inputs: &'a DisplayInputs<'a>,
    /// Output: true if the histogram is visible.
    pub histogram_shown: &'a mut bool,
    /// The loaded environment map, if any.
    pub environment_map: Option<&'a EnvironmentMap>,
    /// The camera's distance and precision in the last frame.
    pub camera_status: Option<CameraStatus>,
    /// Size of the view in the last frame, in pixels.
    pub view_px: [u32; 2],
    pub flying: bool,
    pub can_undo: bool,
    pub can_redo: bool,
}

impl Context<'_> {
    /// Whether an undo and a redo are possible.
    pub fn history_of(editor: &Editor) -> (bool, bool) {
        (editor.can_undo(), editor.can_redo())
    }
}
