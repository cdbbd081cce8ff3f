//! The keyboard, in one table: what the program does on a key is what its help says.
//!
//! In: this frame's key events. Out: commands. Keys in [`FLIGHT`] are read by their place on the
//! keyboard, so that W A S D lie under the same fingers on every layout; all others by what
//! is printed on them.

use std::collections::BTreeSet;

use egui::{Context, Event, Key, Modifiers};

/// What a key can ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Command {
    /// One step back.
    Undo,
    /// One step forward again.
    Redo,
    /// Save the picture as a PNG.
    SavePicture,
    /// Save the scene document.
    SaveScene,
    /// Open a scene document.
    LoadScene,
    /// Copy the address that shares this view.
    CopyLink,
    /// The scene of this index among the opening scenes and the dives.
    Preset(usize),
    /// The camera of a new scene.
    Home,
    /// The whole fractal in view.
    FrameAll,
    /// Fly mode on or off.
    ToggleFlight,
    /// Leave fly mode, or close what is open.
    Leave,
    /// Panel shown or hidden.
    TogglePanel,
    /// Help shown or hidden.
    ToggleHelp,
    /// The whole screen for the picture, or no longer.
    ToggleFullscreen,
    /// Timeline shown or hidden.
    ToggleTimeline,
    /// The path plays or stops.
    PlayPause,
    /// The view becomes a key of the path.
    AddKey,
    /// The view takes the place of the key at the playhead.
    UpdateKey,
    /// The selected key goes.
    DeleteKey,
    /// To the key before the playhead.
    PreviousKey,
    /// To the key after the playhead.
    NextKey,
    /// Turn about the pivot: right and up, in steps.
    Orbit(i8, i8),
    /// Move the view: right and up, in steps.
    Pan(i8, i8),
    /// Closer (positive) or farther, in steps.
    Dolly(i8),
}

/// One line of the table.
#[derive(Clone, Copy, Debug)]
pub struct Shortcut {
    /// The modifiers that must be held; `COMMAND` is Ctrl, on a Mac the command key.
    pub modifiers: Modifiers,
    /// The key.
    pub key: Key,
    /// What it does.
    pub command: Command,
    /// The same for people; none where the line before speaks for both.
    pub help: Option<(&'static str, &'static str)>,
}

const fn line(
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

/// Every shortcut, in the order in which help lists them.
pub const SHORTCUTS: &[Shortcut] = &[
    line(NONE, Key::Num1, Command::Preset(0), "1 … 8", "Opening scenes"),
    also(NONE, Key::Num2, Command::Preset(1)),
    also(NONE, Key::Num3, Command::Preset(2)),
    also(NONE, Key::Num4, Command::Preset(3)),
    also(NONE, Key::Num5, Command::Preset(4)),
    also(NONE, Key::Num6, Command::Preset(5)),
    also(NONE, Key::Num7, Command::Preset(6)),
    also(NONE, Key::Num8, Command::Preset(7)),
    line(NONE, Key::ArrowLeft, Command::Orbit(-1, 0), "Arrows", "Orbit"),
    also(NONE, Key::ArrowRight, Command::Orbit(1, 0)),
    also(NONE, Key::ArrowUp, Command::Orbit(0, 1)),
    also(NONE, Key::ArrowDown, Command::Orbit(0, -1)),
    line(SHIFT, Key::ArrowLeft, Command::Pan(-1, 0), "Shift + arrows", "Pan"),
    also(SHIFT, Key::ArrowRight, Command::Pan(1, 0)),
    also(SHIFT, Key::ArrowUp, Command::Pan(0, 1)),
    also(SHIFT, Key::ArrowDown, Command::Pan(0, -1)),
    line(NONE, Key::Plus, Command::Dolly(1), "+  −", "Closer, farther"),
    also(SHIFT, Key::Plus, Command::Dolly(1)),
    also(NONE, Key::Equals, Command::Dolly(1)),
    also(NONE, Key::Minus, Command::Dolly(-1)),
    line(NONE, Key::H, Command::Home, "H", "Home: the opening view, or out of a deep one"),
    line(NONE, Key::A, Command::FrameAll, "A", "Frame all of the fractal"),
    line(NONE, Key::F, Command::ToggleFlight, "F", "Fly mode on or off"),
    line(NONE, Key::Escape, Command::Leave, "Esc", "Leave fly mode, close help"),
    line(COMMAND, Key::Z, Command::Undo, "Ctrl Z", "Undo"),
    line(COMMAND_SHIFT, Key::Z, Command::Redo, "Ctrl Shift Z, Ctrl Y", "Redo"),
    also(COMMAND, Key::Y, Command::Redo),
    line(COMMAND, Key::S, Command::SavePicture, "Ctrl S", "Save the picture (PNG)"),
    line(COMMAND_SHIFT, Key::S, Command::SaveScene, "Ctrl Shift S", "Save the scene (JSON)"),
    line(COMMAND, Key::O, Command::LoadScene, "Ctrl O", "Open a scene or a picture's scene"),
    line(NONE, Key::L, Command::CopyLink, "L", "Copy a link to this view"),
    line(NONE, Key::T, Command::ToggleTimeline, "T", "Show or hide the timeline"),
    line(NONE, Key::K, Command::AddKey, "K", "Add the view to the path as a key"),
    line(NONE, Key::U, Command::UpdateKey, "U", "Update the key at the playhead"),
    line(NONE, Key::Delete, Command::DeleteKey, "Del", "Delete the selected key"),
    line(NONE, Key::Comma, Command::PreviousKey, ",  .", "To the key before, to the next key"),
    also(NONE, Key::Period, Command::NextKey),
    line(NONE, Key::Space, Command::PlayPause, "Space", "Play the path, or stop"),
    line(NONE, Key::P, Command::TogglePanel, "P", "Show or hide the panel"),
    line(SHIFT, Key::F, Command::ToggleFullscreen, "Shift F", "Fill the screen"),
    line(NONE, Key::Questionmark, Command::ToggleHelp, "?", "This help"),
    also(SHIFT, Key::Questionmark, Command::ToggleHelp),
    also(NONE, Key::F1, Command::ToggleHelp),
];

/// A key of fly mode.
#[derive(Clone, Copy, Debug)]
pub struct FlightKey {
    /// The key that a US keyboard has in its place.
    pub key: Key,
    /// Where it leads: right, up, forward.
    pub direction: [f64; 3],
    /// The keys and what they do, for people; none where the line before speaks for both.
    pub help: Option<(&'static str, &'static str)>,
}

const fn flies(
    key: Key,
    direction: [f64; 3],
    help: Option<(&'static str, &'static str)>,
) -> FlightKey {
    FlightKey { key, direction, help }
}

/// The keys of fly mode.
pub const FLIGHT: &[FlightKey] = &[
    flies(Key::W, [0.0, 0.0, 1.0], Some(("W  S", "Fly forward, back"))),
    flies(Key::S, [0.0, 0.0, -1.0], None),
    flies(Key::A, [-1.0, 0.0, 0.0], Some(("A  D", "Fly left, right"))),
    flies(Key::D, [1.0, 0.0, 0.0], None),
    flies(Key::E, [0.0, 1.0, 0.0], Some(("E  Q", "Fly up, down"))),
    flies(Key::Q, [0.0, -1.0, 0.0], None),
];

/// What the pointer does in the view: the gesture, and what it does.
pub const GESTURES: &[(&str, &str)] = &[
    ("Drag", "Orbit about the point under the pointer"),
    ("Right drag, Shift + drag", "Pan"),
    ("Wheel, pinch", "Closer and farther, toward the pointer"),
    ("Two fingers", "Pan and zoom"),
    ("Drag a light's handle", "Move a point light; with Shift toward or away"),
    ("Drag in fly mode", "Look around"),
    ("Double click a slider", "Back to its default"),
];

/// Commands of this frame's key presses. Silent while text is typed; keys that a focused widget
/// uses (arrows, digits) are left to it, and keys that fly are left to the flight.
pub fn commands(ctx: &Context, flying: bool) -> Vec<Command> {
    let typing = ctx.text_edit_focused();
    let focused = ctx.egui_wants_keyboard_input();
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

/// The command of a key with exactly these modifiers.
fn find(key: Key, modifiers: Modifiers) -> Option<Command> {
    SHORTCUTS
        .iter()
        .find(|shortcut| shortcut.key == key && modifiers.matches_exact(shortcut.modifiers))
        .map(|shortcut| shortcut.command)
}

/// Whether holding the key down asks again and again.
fn repeats(command: Command) -> bool {
    matches!(
        command,
        Command::Orbit(..) | Command::Pan(..) | Command::Dolly(_) | Command::Undo | Command::Redo
    )
}

/// Keys that sliders, buttons and the light ball answer while they have the focus.
fn is_widget_key(key: Key) -> bool {
    use Key::{ArrowDown, ArrowLeft, ArrowRight, ArrowUp, Delete, Escape, Space};
    matches!(key, ArrowLeft | ArrowRight | ArrowUp | ArrowDown | Escape | Space | Delete)
}

fn is_flight_key(key: Key) -> bool {
    FLIGHT.iter().any(|flight| flight.key == key)
}

/// The flight keys that are held down, by their place on the keyboard.
#[derive(Clone, Debug, Default)]
pub struct HeldKeys(BTreeSet<Key>);

impl HeldKeys {
    /// Follows this frame's key events. Typing, a modifier and a lost window let go of all.
    pub fn follow(&mut self, ctx: &Context) {
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

    /// Where the held keys lead: right, up, forward, each −1 to 1.
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
    fn no_two_lines_share_a_key() {
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
    fn every_line_is_found_by_its_key() {
        for shortcut in SHORTCUTS {
            let mut pressed = shortcut.modifiers;
            // What a browser reports for Ctrl on other systems than a Mac.
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
