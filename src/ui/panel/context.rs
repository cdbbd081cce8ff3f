//! What a panel is, the data that panels show and edit, and the lists of their requests.

use egui::Ui;

use crate::{
    scene::{EnvironmentMap, Scene, gradient::NamedGradient},
    ui::{
        action::Action, display_inputs::DisplayInputs, favourites::Favourites,
        look_preview::LookPreview, navigation::CameraStatus, rects::Rects, selection::Selection,
        settings::Settings, shortcuts::Command,
    },
};

/// A panel as a section of "More".
pub struct Section {
    /// The key under which settings store whether the section is open, unique among sections.
    pub name: &'static str,
    /// The heading.
    pub title: &'static str,
    /// The heading's tooltip.
    pub hover: &'static str,
    /// Draws the panel.
    pub show: fn(&mut Ui, &mut Context<'_>),
    /// Restores the section's default values: those of a new scene, or of a first visit for settings outside the scene.
    pub reset: fn(&mut Context<'_>),
}

/// The data that the panels show and edit.
pub struct Context<'a> {
    /// The scene, edited in place.
    pub scene: &'a mut Scene,
    /// Settings that are no part of a scene.
    pub settings: &'a mut Settings,
    /// The selected light.
    pub selection: &'a mut Selection,
    /// The views that the person keeps.
    pub favourites: &'a mut Favourites,
    /// Output: rectangles of named widgets.
    pub rects: &'a mut Rects,
    /// Output: the look whose swatch is under the pointer or has the keyboard.
    pub look_preview: &'a mut LookPreview,
    /// Output: commands, as from a key.
    pub commands: &'a mut Vec<Command>,
    /// Output: requests to the program around the interface.
    pub actions: &'a mut Vec<Action>,
    /// What the program shows through the interface.
    pub inputs: &'a DisplayInputs<'a>,
    /// Output: true if the histogram is visible.
    pub histogram_shown: &'a mut bool,
    /// The loaded environment map, if any.
    pub environment_map: Option<&'a EnvironmentMap>,
    /// The gradients of the last gradient file.
    pub gradients: &'a [NamedGradient],
    /// The camera's distance and precision in the last frame.
    pub camera_status: Option<CameraStatus>,
    /// Size of the view in the last frame, in pixels.
    pub view_px: [u32; 2],
    /// True if the panel is a sheet at the window's lower edge.
    pub is_sheet: bool,
    /// True in fly mode.
    pub flying: bool,
    /// True if there is something to undo.
    pub can_undo: bool,
    /// True if there is something to redo.
    pub can_redo: bool,
}
