//! What the finder leads to.

use egui::Ui;

use super::Interface;
use crate::ui::{
    finder::Target,
    panel::{self, PanelPart},
    shortcuts::Command,
    widgets::{self, Sought},
};

impl Interface {
    /// Runs the chosen command, or shows the chosen section or control.
    pub(super) fn show_target(
        &mut self,
        ui: &Ui,
        target: Target,
        wide: bool,
        commands: &mut Vec<Command>,
    ) {
        match target {
            Target::Command(command) => {
                // These commands do nothing while the timeline is hidden.
                if matches!(
                    command,
                    Command::PlayPause
                        | Command::UpdateKey
                        | Command::DeleteKey
                        | Command::PreviousKey
                        | Command::NextKey
                ) {
                    self.show_timeline(wide);
                }
                commands.push(command);
            }
            Target::Section(section) => panel::show_section(ui, &mut self.settings, section),
            Target::Look(at) => self.apply_look(at),
            Target::Parameter(section, param) => {
                panel::show_section(ui, &mut self.settings, section);
                widgets::reveal(ui, param.path);
                let (label, part) = (param.label.to_owned(), section.title());
                let sought = Sought { label, part, param: Some(param.path) };
                widgets::reveal_named(ui.ctx(), sought);
            }
            Target::Control(part, label) => {
                match part {
                    PanelPart::Panel => panel::show_panel(&mut self.settings),
                    PanelPart::Section(section) => {
                        panel::show_section(ui, &mut self.settings, section)
                    }
                    PanelPart::Timeline => self.show_timeline(wide),
                }
                let sought = Sought { label, part: part.title(), param: None };
                widgets::reveal_named(ui.ctx(), sought);
            }
        }
    }
}
