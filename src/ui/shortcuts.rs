//! Keyboard shortcuts: one table for dispatch and for the help window.
//!
//! In: this frame's key events. Out: commands. The keys of [`FLIGHT`] are physical keys, so that
//! W A S D have the same positions on every keyboard layout. All other keys are logical keys.

use std::collections::BTreeSet;

use egui::{Context, Event, Key, Modifiers};

/// A command of a key or a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Command {
    /// Undo one step.
    Undo,
    /// Redo one step.
    Redo,
    /// Save the picture.
    SavePicture,
    /// Save the scene document.
    SaveScene,
    /// Open a scene document.
    LoadScene,
    /// Copy a link to this view.
    CopyLink,
    /// Open or close the share window.
    Share,
    /// Copy the picture on the screen to the clipboard.
    CopyPicture,
    /// Hand the picture on the screen to the system's share sheet.
    SharePicture,
    /// Open the kept view of this index.
    Favourite(usize),
    /// Open or close the finder.
    Find,
    /// Set this state aside, or change to the other one.
    Compare,
    /// Open a random scene.
    Surprise,
    /// Show variations of the scene, or put them away.
    Mutate,
    /// Open the preset of this index: the opening scenes, then the dives.
    Preset(usize),
    /// Fly to the scene's opening view, or out of a deep one.
    Home,
    /// Show the whole fractal.
    FrameAll,
    /// Focus the lens on the surface under the pointer, or in the middle of the picture.
    Focus,
    /// Begin a dive, or stop it.
    Dive,
    /// Keep the last dive as the camera path.
    KeepDive,
    /// Make a path around the scene.
    Turntable,
    /// Light the place of the next click, or stop waiting for it.
    LightPlace,
    /// Switch fly mode on or off.
    ToggleFlight,
    /// Show the view before the last change for a moment.
    ShowBefore,
    /// Search the view for places and show pins on them, or put the pins away.
    FindPlaces,
    /// Close the help window, put the pins away, or leave fly mode.
    Leave,
    /// Show or hide the panel.
    TogglePanel,
    /// Show or hide the help window.
    ToggleHelp,
    /// Enter or leave fullscreen.
    ToggleFullscreen,
    /// Show or hide the timeline.
    ToggleTimeline,
    /// Play or pause the path.
    PlayPause,
    /// Add the view to the path as a key.
    AddKey,
    /// Replace the key at the playhead by the view.
    UpdateKey,
    /// Delete the selected key.
    DeleteKey,
    /// Move to the key before the playhead.
    PreviousKey,
    /// Move to the key after the playhead.
    NextKey,
    /// Orbit around the pivot: right and up, in steps.
    Orbit(i8, i8),
    /// Pan the view: right and up, in steps.
    Pan(i8, i8),
    /// Move closer (positive) or farther, in steps.
    Dolly(i8),
}

impl Command {
    /// Whether the command moves the camera, which ends the guide's descent.
    pub fn moves_camera(self) -> bool {
        matches!(self, Self::Home | Self::FrameAll | Self::Orbit(..) | Self::Pan(..))
    }
}

/// One row of the shortcut table.
#[derive(Clone, Copy, Debug)]
pub struct Shortcut {
    /// The modifiers of the shortcut; `COMMAND` is Ctrl, on macOS the command key.
    pub modifiers: Modifiers,
    /// The key.
    pub key: Key,
    /// The command.
    pub command: Command,
    /// Keys and description for the help window; none if an earlier row's help covers this row.
    pub help: Option<(&'static str, &'static str)>,
}

const fn row(
    modifiers: Modifiers,
    key: Key,
    command: Command,
    keys: &'static str,
    help: &'static str,
) -> Shortcut {
    Shortcut { modifiers, key, command, help: Some((keys, help)) }
}

const fn also(modifiers: Modifiers, key: Key, command: Command) -> Shortcut {
    Shortcut { modifiers, key, command, help: None }
}

const NONE: Modifiers = Modifiers::NONE;
const SHIFT: Modifiers = Modifiers::SHIFT;
const COMMAND: Modifiers = Modifiers::COMMAND;
const COMMAND_SHIFT: Modifiers =
    Modifiers { alt: false, ctrl: false, shift: true, mac_cmd: false, command: true };

/// All shortcuts, in the order of the help window.
pub const SHORTCUTS: &[Shortcut] = &[
    row(NONE, Key::Num1, Command::Preset(0), "1 … 8", "Opening scenes"),
    also(NONE, Key::Num2, Command::Preset(1)),
    also(NONE, Key::Num3, Command::Preset(2)),
    also(NONE, Key::Num4, Command::Preset(3)),
    also(NONE, Key::Num5, Command::Preset(4)),
    also(NONE, Key::Num6, Command::Preset(5)),
    also(NONE, Key::Num7, Command::Preset(6)),
    also(NONE, Key::Num8, Command::Preset(7)),
    row(NONE, Key::ArrowLeft, Command::Orbit(-1, 0), "Arrows", "Orbit"),
    also(NONE, Key::ArrowRight, Command::Orbit(1, 0)),
    also(NONE, Key::ArrowUp, Command::Orbit(0, 1)),
    also(NONE, Key::ArrowDown, Command::Orbit(0, -1)),
    row(SHIFT, Key::ArrowLeft, Command::Pan(-1, 0), "Shift + arrows", "Pan"),
    also(SHIFT, Key::ArrowRight, Command::Pan(1, 0)),
    also(SHIFT, Key::ArrowUp, Command::Pan(0, 1)),
    also(SHIFT, Key::ArrowDown, Command::Pan(0, -1)),
    row(NONE, Key::Plus, Command::Dolly(1), "+  −", "Closer, farther"),
    also(SHIFT, Key::Plus, Command::Dolly(1)),
    also(NONE, Key::Equals, Command::Dolly(1)),
    also(NONE, Key::Minus, Command::Dolly(-1)),
    row(NONE, Key::H, Command::Home, "H", "Home: back to the first view, or out of a deep one"),
    row(NONE, Key::A, Command::FrameAll, "A", "Show the whole fractal"),
    row(NONE, Key::D, Command::Dive, "D", "Dive: go down by itself, or stop"),
    row(NONE, Key::N, Command::FindPlaces, "N", "Find places to dive to, or put the pins away"),
    row(
        SHIFT,
        Key::C,
        Command::Compare,
        "Shift C",
        "Compare: keep this state as A and edit a copy, B; then switch between them",
    ),
    row(NONE, Key::R, Command::Surprise, "R", "Surprise me: a random scene"),
    row(NONE, Key::M, Command::Mutate, "M", "Mutate: variations of the scene, side by side"),
    row(NONE, Key::F, Command::ToggleFlight, "F", "Fly mode on or off"),
    row(
        NONE,
        Key::Escape,
        Command::Leave,
        "Esc",
        "Close a window, put pins away, end a comparison, leave fly mode",
    ),
    row(COMMAND, Key::K, Command::Find, "Ctrl K", "Find a control, a scene or a command"),
    row(COMMAND, Key::Z, Command::Undo, "Ctrl Z", "Undo"),
    row(COMMAND_SHIFT, Key::Z, Command::Redo, "Ctrl Shift Z, Ctrl Y", "Redo"),
    also(COMMAND, Key::Y, Command::Redo),
    row(COMMAND, Key::S, Command::SavePicture, "Ctrl S", "Save the picture"),
    row(COMMAND_SHIFT, Key::S, Command::SaveScene, "Ctrl Shift S", "Save the scene (JSON)"),
    row(COMMAND, Key::O, Command::LoadScene, "Ctrl O", "Open a scene or a picture's scene"),
    row(NONE, Key::L, Command::CopyLink, "L", "Copy a link to this view"),
    row(NONE, Key::J, Command::Share, "J", "Share: link, QR code, picture"),
    row(NONE, Key::T, Command::ToggleTimeline, "T", "Show or hide the timeline"),
    row(NONE, Key::K, Command::AddKey, "K", "Add the view to the path as a key"),
    row(NONE, Key::U, Command::UpdateKey, "U", "Replace the key at the playhead by the view"),
    row(NONE, Key::Delete, Command::DeleteKey, "Del", "Delete the selected key"),
    row(NONE, Key::Comma, Command::PreviousKey, ",  .", "Go to the previous, to the next key"),
    also(NONE, Key::Period, Command::NextKey),
    row(
        NONE,
        Key::O,
        Command::Focus,
        "O",
        "Focus on the point under the pointer, with a depth of field",
    ),
    row(NONE, Key::Space, Command::PlayPause, "Space", "Play or pause the path"),
    row(NONE, Key::P, Command::TogglePanel, "P", "Show or hide the panel"),
    row(SHIFT, Key::F, Command::ToggleFullscreen, "Shift F", "Fill the screen"),
    row(NONE, Key::Questionmark, Command::ToggleHelp, "?", "Show or hide this help"),
    also(SHIFT, Key::Questionmark, Command::ToggleHelp),
    also(NONE, Key::F1, Command::ToggleHelp),
];

/// A key of fly mode.
#[derive(Clone, Copy, Debug)]
pub struct FlightKey {
    /// The physical key, by its name on a US keyboard.
    pub key: Key,
    /// The direction of movement: right, up, forward.
    pub direction: [f64; 3],
    /// Keys and description for the help window; none if an earlier row's help covers this row.
    pub help: Option<(&'static str, &'static str)>,
}

const fn flight_key(
    key: Key,
    direction: [f64; 3],
    help: Option<(&'static str, &'static str)>,
) -> FlightKey {
    FlightKey { key, direction, help }
}

/// The keys of fly mode.
pub const FLIGHT: &[FlightKey] = &[
    flight_key(Key::W, [0.0, 0.0, 1.0], Some(("W  S", "Fly forward, back"))),
    flight_key(Key::S, [0.0, 0.0, -1.0], None),
    flight_key(Key::A, [-1.0, 0.0, 0.0], Some(("A  D", "Fly left, right"))),
    flight_key(Key::D, [1.0, 0.0, 0.0], None),
    flight_key(Key::E, [0.0, 1.0, 0.0], Some(("E  Q", "Fly up, down"))),
    flight_key(Key::Q, [0.0, -1.0, 0.0], None),
];

/// How to fly, in one line: by fingers or by keys.
pub fn flight_help(has_touch: bool) -> String {
    if has_touch {
        return FLIGHT_GESTURES.to_owned();
    }
    let keys: Vec<_> = FLIGHT.iter().filter_map(|flight| Some(flight.help?.0)).collect();
    format!("{} to fly, Shift for faster, drag to look around, Esc to stop", keys.join(" · "))
}

/// What fingers do in fly mode, in one line.
const FLIGHT_GESTURES: &str =
    "Drag to look around, spread or pinch two fingers to fly, drag both to move sideways";

/// Commands that only the finder lists, by these words: they have no row of their own in the help window.
pub const FINDER_ONLY: &[(Command, &str)] = &[
    (Command::Turntable, "Make a path around the scene"),
    (Command::LightPlace, "Light a place by a click"),
    (Command::ShowBefore, "Before: show the view before the last change for two seconds (hold C)"),
    (Command::CopyPicture, "Copy the picture to the clipboard"),
    (Command::NextKey, "Go to the next key"),
];

/// What fingers do in the view, each with its effect.
pub const TOUCH_GESTURES: &[(&str, &str)] = &[
    ("Drag with a finger", "Orbit; in close views around the point under the finger"),
    ("Pinch", "Move closer or farther; moving closer steers to detailed places"),
    ("Drag with two fingers", "Pan"),
    ("Double tap", "Fly to that point"),
    ("Drag in fly mode", "Look around; two fingers fly forward, back and sideways"),
    ("Drag a handle", "Turn a light, or move a point light"),
    ("Double tap a slider", "Reset to its default"),
    ("Hold Before", "See the view before the last change"),
];

/// What a mouse does in the view, each with its effect.
pub const GESTURES: &[(&str, &str)] = &[
    ("Drag", "Orbit; in close views around the point under the pointer"),
    ("Right drag, Shift + drag", "Pan"),
    ("Wheel", "Move closer or farther; moving closer steers to detailed places near the pointer"),
    ("Double click", "Fly to that point"),
    (
        "Drag a light's handle",
        "Turn a light, or move a point light; with Shift toward or away from you. On its handle or its row, arrow keys do the same",
    ),
    ("Alt + click", "Focus there, with a depth of field"),
    ("Alt + Shift + click", "Light that place"),
    ("Drag in fly mode", "Look around"),
    ("Double click a slider", "Reset to its default"),
    ("Hold C", "See the view before the last change"),
];

/// Whether this frame's keys step a value: repeated presses are one undo step.
pub fn step_a_value(input: &egui::InputState) -> bool {
    let keys =
        [Key::ArrowLeft, Key::ArrowRight, Key::ArrowUp, Key::ArrowDown, Key::PageUp, Key::PageDown];
    keys.into_iter().any(|key| input.key_pressed(key))
}

/// Whether someone waits for the answer to this frame's input: clicks, keys, the wheel, a screen reader's actions.
/// A pointer that only moves is none.
pub fn wants_answer(input: &egui::InputState) -> bool {
    input.events.iter().any(|event| match event {
        Event::PointerButton { .. }
        | Event::MouseWheel { .. }
        | Event::Text(_)
        | Event::AccessKitActionRequest(_) => true,
        Event::Key { repeat, .. } => !repeat,
        _ => false,
    })
}

/// The commands of this frame's key presses.
///
/// No commands while text is typed. A focused widget keeps the keys that it uses (arrows, Space,
/// Escape, Delete), unless that is the view, and fly mode keeps its keys.
pub fn commands(ctx: &Context, flying: bool, is_view_focused: bool) -> Vec<Command> {
    let typing = ctx.text_edit_focused();
    let focused = ctx.egui_wants_keyboard_input() && !is_view_focused;
    let popup = ctx.any_popup_open();
    ctx.input(|input| {
        input
            .events
            .iter()
            .filter_map(|event| match *event {
                Event::Key { key, physical_key, pressed: true, repeat, modifiers } => {
                    let flies =
                        flying && modifiers.is_none() && is_flight_key(physical_key.unwrap_or(key));
                    let taken = typing || popup || flies || (focused && is_widget_key(key));
                    let found = find(key, modifiers).filter(|_| !taken)?;
                    (!repeat || repeats(found)).then_some(found)
                }
                _ => None,
            })
            .collect()
    })
}

/// True while the key is held that shows the view before the last change.
pub fn is_comparing(ctx: &Context) -> bool {
    let typing = ctx.text_edit_focused();
    ctx.input(|input| !typing && input.modifiers.is_none() && input.key_down(Key::C))
}

/// The command of a key with exactly these modifiers.
fn find(key: Key, modifiers: Modifiers) -> Option<Command> {
    SHORTCUTS
        .iter()
        .find(|shortcut| shortcut.key == key && modifiers.matches_exact(shortcut.modifiers))
        .map(|shortcut| shortcut.command)
}

/// True if the command repeats while the key is held down.
fn repeats(command: Command) -> bool {
    matches!(
        command,
        Command::Orbit(..) | Command::Pan(..) | Command::Dolly(_) | Command::Undo | Command::Redo
    )
}

/// True for keys that sliders, buttons and the direction ball use while focused.
fn is_widget_key(key: Key) -> bool {
    use Key::{ArrowDown, ArrowLeft, ArrowRight, ArrowUp, Delete, Escape, Space};
    matches!(key, ArrowLeft | ArrowRight | ArrowUp | ArrowDown | Escape | Space | Delete)
}

fn is_flight_key(key: Key) -> bool {
    FLIGHT.iter().any(|flight| flight.key == key)
}

/// The physical keys of fly mode that are held down.
#[derive(Clone, Debug, Default)]
pub struct HeldKeys(BTreeSet<Key>);

impl HeldKeys {
    /// Updates the set by this frame's key events.
    ///
    /// Text input and a loss of the window's focus release all keys; keys with Ctrl or Alt do not
    /// count.
    pub fn update(&mut self, ctx: &Context) {
        let typing = ctx.text_edit_focused();
        ctx.input(|input| {
            for event in &input.events {
                match *event {
                    Event::Key { key, physical_key, pressed, modifiers, .. } => {
                        let key = physical_key.unwrap_or(key);
                        let commanding = modifiers.command || modifiers.ctrl || modifiers.alt;
                        if pressed && !typing && !commanding && is_flight_key(key) {
                            self.0.insert(key);
                        } else {
                            self.0.remove(&key);
                        }
                    }
                    Event::WindowFocused(false) => self.0.clear(),
                    _ => {}
                }
            }
        });
        if typing {
            self.0.clear();
        }
    }

    /// The direction of the held keys: right, up, forward, each −1 to 1.
    pub fn direction(&self) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for flight in FLIGHT {
            if self.0.contains(&flight.key) {
                for (axis, part) in sum.iter_mut().zip(flight.direction) {
                    *axis += part;
                }
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_rows_share_a_key() {
        for (i, a) in SHORTCUTS.iter().enumerate() {
            for b in &SHORTCUTS[i + 1..] {
                assert!(
                    a.key != b.key || a.modifiers != b.modifiers,
                    "{:?} is both {:?} and {:?}",
                    a.key,
                    a.command,
                    b.command
                );
            }
        }
    }

    #[test]
    fn the_first_nine_opening_scenes_have_a_key() {
        // There are nine digits.
        let presets = crate::scene::presets::opening_scenes().len().min(9);
        for index in 0..presets {
            assert!(SHORTCUTS.iter().any(|s| s.command == Command::Preset(index)), "scene {index}");
        }
        let row = SHORTCUTS.iter().find(|s| s.command == Command::Preset(0)).unwrap();
        assert_eq!(row.help.unwrap().0, format!("1 … {presets}"));
    }

    #[test]
    fn every_row_is_found_by_its_key() {
        for shortcut in SHORTCUTS {
            let mut pressed = shortcut.modifiers;
            // Except on macOS, a browser reports Ctrl as both `ctrl` and `command`.
            pressed.ctrl = pressed.command;
            assert_eq!(find(shortcut.key, pressed), Some(shortcut.command), "{:?}", shortcut.key);
        }
    }

    #[test]
    fn opposite_flight_keys_cancel() {
        let mut held = HeldKeys::default();
        held.0.extend([Key::W, Key::S, Key::D]);
        assert_eq!(held.direction(), [1.0, 0.0, 0.0]);
    }
}
