//! The finder: a search over commands, scenes, looks, sections and controls, by Ctrl+K.
//!
//! In: what is typed. Out: a command to run, a look to apply, or the section and the control to show.

use egui::{Align2, Button, Key, RichText, ScrollArea, TextEdit, Ui, vec2};

use super::{
    control_index::Control,
    panel::{self, PanelPart, SectionRef},
    rects::Rects,
    shortcuts::{Command, FINDER_ONLY, SHORTCUTS},
    theme,
    widgets::window_heading,
};
use crate::scene::{
    looks,
    param::{self, Param},
    presets,
};

/// Number of results that are listed.
const MAX_RESULTS: usize = 9;
/// Width of the window, in points.
const WIDTH: f32 = 380.0;

/// What a result leads to.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A command.
    Command(Command),
    /// A section of the panel.
    Section(SectionRef),
    /// A parameter's control in a section of the panel.
    Parameter(SectionRef, &'static Param),
    /// Another control: its part, and its name there.
    Control(PanelPart, String),
    /// A look, or a part of one: the number of its list, and its number there.
    Look([usize; 2]),
}

/// Something that can be found.
#[derive(Clone, Debug, PartialEq)]
struct Entry {
    name: String,
    /// Where it is, or its key.
    about: String,
    /// More words by which it is found.
    words: String,
    target: Target,
}

/// The finder's window.
#[derive(Debug, Default)]
pub struct Finder {
    is_open: bool,
    typed: String,
    /// Everything that can be found; empty until the window is shown.
    entries: Vec<Entry>,
    /// What is found by the typed words.
    found: Vec<Entry>,
    selected: usize,
}

impl Finder {
    /// Opens the window with an empty field, or closes it.
    pub fn toggle(&mut self) {
        *self = Self { is_open: !self.is_open, ..Self::default() };
    }

    /// True while the window is open.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// Shows the open window, and returns what was chosen. `controls` lists the controls, once per opening.
    pub fn show(
        &mut self,
        ui: &Ui,
        rects: &mut Rects,
        controls: impl FnOnce() -> Vec<Control>,
    ) -> Option<Target> {
        if !self.is_open {
            return None;
        }
        if self.entries.is_empty() {
            self.entries = entries(controls());
        }
        let screen = ui.ctx().content_rect();
        let (down, up, enter) = ui.input(|input| {
            let pressed = |key| input.key_pressed(key);
            (pressed(Key::ArrowDown), pressed(Key::ArrowUp), pressed(Key::Enter))
        });
        let mut open = true;
        let mut chosen = None;
        let shown = egui::Window::new("Find")
            .fixed_pos(screen.center_top() + vec2(0.0, 24.0))
            .pivot(Align2::CENTER_TOP)
            .constrain_to(screen)
            .title_bar(false)
            .resizable(false)
            .fixed_size(vec2(WIDTH.min(screen.width() - 40.0), screen.height() - 120.0))
            .show(ui.ctx(), |window| {
                window.spacing_mut().interact_size.y = ui.spacing().interact_size.y.max(30.0);
                open = !window_heading(window, "Find");
                let field = TextEdit::singleline(&mut self.typed)
                    .align(Align2::LEFT_CENTER)
                    .hint_text("A control, a scene, a look, a command…")
                    .desired_width(f32::INFINITY);
                let field = window.add(field);
                field.request_focus();
                if field.changed() {
                    self.selected = 0;
                    self.found = found(&self.entries, &self.typed);
                }
                field.accessible_name("What to find");
                let found = &self.found;
                let last = found.len().saturating_sub(1);
                self.selected = (self.selected + usize::from(down)).min(last);
                self.selected = self.selected.saturating_sub(usize::from(up));
                if found.is_empty() && !self.typed.trim().is_empty() {
                    window.label(RichText::new("Nothing is called that.").color(theme::TEXT_DIM));
                }
                ScrollArea::vertical().auto_shrink([false, true]).show(window, |ui| {
                    for (index, entry) in found.iter().enumerate() {
                        if row(ui, entry, index == self.selected)
                            || (enter && index == self.selected)
                        {
                            chosen = Some(entry.target.clone());
                        }
                    }
                });
            });
        if let Some(shown) = shown {
            rects.record("find window", &shown.response);
        }
        if !open || chosen.is_some() {
            *self = Self::default();
        }
        chosen
    }
}

/// A result; true if it was clicked.
fn row(ui: &mut Ui, entry: &Entry, is_selected: bool) -> bool {
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    // Secondary text is too weak on the colour of what is selected.
    let color = if is_selected { theme::TEXT } else { theme::TEXT_DIM };
    let about = RichText::new(&entry.about).color(color);
    let button = Button::selectable(is_selected, entry.name.as_str()).right_text(about);
    let response = ui.add_sized(size, button.truncate());
    if is_selected {
        response.scroll_to_me(None);
    }
    let is_clicked = response.clicked();
    response.accessible_name(entry.name.as_str());
    is_clicked
}

/// Everything that can be found: commands first, then controls, sections, scenes and looks.
fn entries(controls: Vec<Control>) -> Vec<Entry> {
    let printable = |text: &str| theme::printable(text);
    let commands = SHORTCUTS.iter().filter_map(|shortcut| {
        let (keys, what) = shortcut.help?;
        // The row of all number keys stands for several scenes, which are found by their names.
        let is_one = !matches!(shortcut.command, Command::Preset(_));
        let target = Target::Command(shortcut.command);
        let (name, about) = (what.to_owned(), printable(keys));
        is_one.then_some(Entry { name, about, words: String::new(), target })
    });
    let finder_only = FINDER_ONLY.iter().map(|&(command, what)| Entry {
        name: what.to_owned(),
        about: String::new(),
        words: String::new(),
        target: Target::Command(command),
    });
    let sections = panel::sections().map(|section| Entry {
        name: section.title().to_owned(),
        about: "Section".to_owned(),
        words: section.hover().to_owned(),
        target: Target::Section(section),
    });
    let scenes = presets::lists()
        .into_iter()
        .flat_map(|list| list.presets.iter().map(move |preset| (list.name, preset)));
    let scenes = scenes.enumerate().map(|(index, (list, preset))| Entry {
        name: preset.name.to_owned(),
        about: list.to_owned(),
        words: printable(preset.blurb),
        target: Target::Command(Command::Preset(index)),
    });
    let looks = looks::lists().iter().enumerate().flat_map(|(at, list)| {
        list.looks.iter().enumerate().map(move |(index, look)| Entry {
            name: look.name.clone(),
            about: list.kind.to_owned(),
            words: theme::printable(look.about),
            target: Target::Look([at, index]),
        })
    });
    let commands: Vec<Entry> = commands.chain(finder_only).collect();
    let others: Vec<Entry> = sections.chain(scenes).chain(looks).collect();
    let is_there = |name: &str| commands.iter().chain(&others).any(|entry| entry.name == name);
    // The panel has commands, cards of scenes and swatches of looks as well.
    let is_new = |control: &Control| {
        let of_look = control.name.strip_prefix(LOOK).unwrap_or(&control.name);
        control.part != PanelPart::Panel || !(is_there(&control.name) || is_there(of_look))
    };
    let mut all_controls: Vec<Entry> = Vec::new();
    let controls = controls.into_iter().filter(is_new).map(|control| {
        let Control { name, label, help, part } = control;
        let target = Target::Control(part, label);
        Entry { name, about: part.title().to_owned(), words: printable(&help), target }
    });
    // A parameter is found by its path, also where another control of the section has its name.
    for entry in parameters().chain(controls) {
        let is_same = |other: &Entry| other.name == entry.name && other.about == entry.about;
        if !all_controls.iter().any(is_same) {
            all_controls.push(entry);
        }
    }
    commands.into_iter().chain(all_controls).chain(others).collect()
}

/// The parameters of all scenes, also of those that have no control for them now.
fn parameters() -> impl Iterator<Item = Entry> {
    param::all().filter_map(|param| {
        let section = panel::section_of(param)?;
        Some(Entry {
            name: param.label.to_owned(),
            about: section.title().to_owned(),
            words: theme::printable(param.help),
            target: Target::Parameter(section, param),
        })
    })
}

/// The beginning of the name of a look's swatch.
const LOOK: &str = "Look: ";

/// What is found by all typed words, the best first: those in names before those in descriptions.
fn found(entries: &[Entry], typed: &str) -> Vec<Entry> {
    let typed = typed.trim().to_lowercase();
    if typed.is_empty() {
        return Vec::new();
    }
    let rank = |entry: &Entry| {
        let name = entry.name.to_lowercase();
        let all = format!("{name} {} {}", entry.about, entry.words).to_lowercase();
        let is_found = typed.split_whitespace().all(|word| all.contains(word));
        let starts_word = name.split_whitespace().any(|word| word.starts_with(&typed));
        is_found.then(|| match () {
            () if name == typed => 0,
            () if name.starts_with(&typed) => 1,
            () if starts_word => 2,
            () if typed.split_whitespace().all(|word| name.contains(word)) => 3,
            () => 4,
        })
    };
    let mut ranked: Vec<(u8, &Entry)> =
        entries.iter().filter_map(|entry| Some((rank(entry)?, entry))).collect();
    // A stable sort keeps the order of `entries` among equals.
    ranked.sort_by_key(|(rank, _)| *rank);
    ranked.truncate(MAX_RESULTS);
    ranked.into_iter().map(|(_, entry)| entry.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<Entry> {
        let control = |name: &str, help: &str| Control {
            name: name.to_owned(),
            label: name.to_owned(),
            help: help.to_owned(),
            part: PanelPart::Timeline,
        };
        entries(vec![control("Save video", "Renders the frames"), control("Frame rate", "")])
    }

    fn first(typed: &str) -> Option<Target> {
        found(&all(), typed).first().map(|entry| entry.target.clone())
    }

    #[test]
    fn controls_scenes_and_commands_are_found_by_their_words() {
        assert!(
            matches!(first("exposure"), Some(Target::Parameter(_, param)) if *param == param::EXPOSURE)
        );
        assert_eq!(first("undo"), Some(Target::Command(Command::Undo)));
        assert!(matches!(first("sea urch"), Some(Target::Command(Command::Preset(3)))));
        assert!(matches!(first("FIELD of"), Some(Target::Parameter(..))));
        // By the description too, with words in any order.
        let found = |typed: &str| found(&all(), typed);
        assert!(found("arches glowing").iter().any(|entry| entry.name == "Kiln"));
        assert!(found("no such thing").is_empty() && found("  ").is_empty());
        assert_eq!(
            first("video save"),
            Some(Target::Control(PanelPart::Timeline, "Save video".into()))
        );
    }

    #[test]
    fn every_entry_is_found_by_its_name() {
        let all = all();
        for entry in &all {
            let found = found(&all, &entry.name);
            let is_listed = found.iter().any(|other| other.name == entry.name);
            assert!(is_listed, "{:?}: {found:?}", entry.name);
        }
    }
}
