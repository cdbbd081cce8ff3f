//! The commands of keys and buttons, each run at the end of a frame.

use egui::Ui;

use super::Interface;
use crate::ui::{action::Action, panel, shortcuts::Command};

impl Interface {
    /// Runs a command of a key or a button that changes the interface or asks the shell for something.
    pub(super) fn dispatch(
        &mut self,
        ui: &Ui,
        command: Command,
        wide: bool,
        actions: &mut Vec<Action>,
    ) {
        let ctx = ui.ctx();
        match command {
            Command::Undo => {
                self.pilot.cancel();
                self.timeline.stop();
                self.editor.undo();
            }
            Command::Redo => {
                self.pilot.cancel();
                self.timeline.stop();
                self.editor.redo();
            }
            Command::SavePicture => {
                let (export, layout) =
                    (self.settings.export, self.editor.scene().camera.stereo.layout);
                actions.push(Action::SavePicture {
                    size_px: export.resolve(self.view_px, layout),
                    file: export.file,
                    pair: export.is_pair(layout),
                });
            }
            Command::SaveScene => actions.push(Action::SaveScene),
            Command::LoadScene => actions.push(Action::LoadScene),
            Command::CopyLink => actions.push(Action::CopyLink),
            Command::CopyPicture => actions.push(Action::CopyPicture),
            Command::SharePicture => actions.push(Action::SharePicture),
            Command::ToggleFullscreen => actions.push(Action::ToggleFullscreen),
            Command::Preset(index) => self.choose_preset(index),
            Command::Favourite(index) => self.open_favourite(index, actions),
            Command::ToggleFlight => self.pilot.set_flying(!self.pilot.is_flying()),
            Command::KeepDive => self.keep_dive(wide),
            Command::Turntable => self.make_turntable(wide),
            Command::Leave if self.help_open => self.help_open = false,
            Command::Find => self.finder.toggle(),
            Command::Leave if self.finder.is_open() => self.finder.toggle(),
            Command::Leave if self.share.is_open() => self.share.toggle(),
            Command::Leave if panel::is_formula_window_open(ctx) => {
                // The text field takes the key that ends the typing.
                if !self.was_typing {
                    panel::close_formula_window(ctx);
                }
            }
            Command::Share => self.share.toggle(),
            Command::Leave if self.mutate.is_open() => self.mutate.toggle(),
            Command::Mutate => self.mutate.toggle(),
            Command::Surprise => self.surprises.begin(),
            Command::Compare => {
                let other = self.compare.toggle(self.editor.project());
                self.show_state(other);
            }
            Command::Leave if self.places.are_shown() => self.places.put_away(),
            Command::FindPlaces => self.places.toggle(),
            Command::Leave if self.light_click.waits() => self.light_click.toggle(),
            Command::LightPlace => self.light_click.toggle(),
            Command::Leave if self.compare.is_on() && !self.pilot.is_flying() => self.compare.end(),
            Command::Leave => self.pilot.set_flying(false),
            Command::TogglePanel => self.settings.panel_open = !self.settings.panel_open,
            Command::ToggleTimeline => self.toggle_timeline(wide),
            Command::AddKey if !self.settings.timeline_open => self.toggle_timeline(wide),
            Command::ToggleHelp => self.help_open = !self.help_open,
            // The pilot, the timeline and `show` execute these commands.
            Command::ShowBefore
            | Command::PlayPause
            | Command::AddKey
            | Command::UpdateKey
            | Command::DeleteKey
            | Command::PreviousKey
            | Command::NextKey
            | Command::Home
            | Command::FrameAll
            | Command::Focus
            | Command::Dive
            | Command::Orbit(..)
            | Command::Pan(..)
            | Command::Dolly(_) => {}
        }
    }
}
