//! Gestures of pointer and fingers on the view, and the keys of commands.

use egui::{
    Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, TouchDeviceId, TouchId, TouchPhase,
    vec2,
};
use mandelight::ui::shortcuts::{FLIGHT, SHORTCUTS};

use crate::walker::Walker;

/// Frames of a drag.
const DRAG_FRAMES: usize = 3;

impl Walker {
    /// A click: press and release, in one frame or in two.
    pub fn click(&mut self, at: Pos2, button: PointerButton, modifiers: Modifiers) {
        self.event(Event::ModifiersChanged(modifiers));
        self.event(Event::PointerMoved(at));
        self.button(at, button, true, modifiers);
        if self.dice.chance(0.7) {
            self.frame();
        }
        self.button(at, button, false, modifiers);
        self.event(Event::ModifiersChanged(Modifiers::NONE));
        self.frame();
    }

    /// A drag, which is now and then left without a release.
    pub fn drag(&mut self, from: Pos2, to: Pos2, button: PointerButton, modifiers: Modifiers) {
        self.event(Event::ModifiersChanged(modifiers));
        self.event(Event::PointerMoved(from));
        self.button(from, button, true, modifiers);
        self.frame();
        for step in 1..=DRAG_FRAMES {
            let part = step as f32 / DRAG_FRAMES as f32;
            self.event(Event::PointerMoved(from + (to - from) * part));
            self.frame();
        }
        if self.dice.chance(0.95) {
            self.button(to, button, false, modifiers);
        } else {
            self.log("the pointer is gone".to_owned());
            self.event(Event::PointerGone);
        }
        self.event(Event::ModifiersChanged(Modifiers::NONE));
        self.frame();
    }

    /// A gesture in the view, mostly.
    pub fn gesture(&mut self) {
        let view = self.harness.state().interface.rects().get("view");
        let area = match view {
            Some(view) if self.dice.chance(0.9) => view,
            _ => self.window(),
        };
        let from = self.point_of(area);
        let to = self.point_of(area.expand(40.0));
        match self.below(9) {
            0..3 => {
                let button = self.pick(&[
                    PointerButton::Primary,
                    PointerButton::Primary,
                    PointerButton::Secondary,
                ]);
                let modifiers = self.pick(&[Modifiers::NONE, Modifiers::NONE, Modifiers::SHIFT]);
                self.log(format!("drag {button:?} {modifiers:?} from {from:?} to {to:?}"));
                self.drag(from, to, button, modifiers);
            }
            3 | 4 => {
                let points =
                    self.pick(&[100.0, -100.0, 1.0, 3000.0, -3000.0, 1e9, f32::MIN_POSITIVE]);
                let modifiers = self.pick(&[Modifiers::NONE, Modifiers::NONE, Modifiers::COMMAND]);
                self.log(format!("wheel {points} {modifiers:?} at {from:?}"));
                self.wheel(from, points, modifiers);
            }
            5 => {
                self.log(format!("double click at {from:?}"));
                self.click(from, PointerButton::Primary, Modifiers::NONE);
                self.click(from, PointerButton::Primary, Modifiers::NONE);
            }
            6 => {
                let modifiers = self.pick(&[Modifiers::ALT, Modifiers::ALT | Modifiers::SHIFT]);
                self.log(format!("click with {modifiers:?} at {from:?}"));
                self.click(from, PointerButton::Primary, modifiers);
            }
            7 => {
                self.log(format!("a finger from {from:?} to {to:?}"));
                self.touch(1, TouchPhase::Start, from);
                self.button(from, PointerButton::Primary, true, Modifiers::NONE);
                self.frame();
                self.touch(1, TouchPhase::Move, to);
                self.event(Event::PointerMoved(to));
                self.frame();
                let end = self.pick(&[TouchPhase::End, TouchPhase::Cancel]);
                self.touch(1, end, to);
                self.button(to, PointerButton::Primary, false, Modifiers::NONE);
                self.event(Event::PointerGone);
                self.frame();
            }
            _ => self.pinch(from, to),
        }
    }

    fn wheel(&mut self, at: Pos2, points: f32, modifiers: Modifiers) {
        self.event(Event::PointerMoved(at));
        for _ in 0..2 {
            self.event(Event::MouseWheel {
                unit: MouseWheelUnit::Point,
                delta: vec2(0.0, points),
                phase: TouchPhase::Move,
                source: egui::MouseWheelSource::Unknown,
                modifiers,
            });
            self.frame();
        }
    }

    fn touch(&mut self, id: u64, phase: TouchPhase, pos: Pos2) {
        let (device_id, id) = (TouchDeviceId(1), TouchId(id));
        self.event(Event::Touch { device_id, id, phase, pos, force: None });
    }

    /// Two fingers, of which the second may be left on the screen.
    fn pinch(&mut self, from: Pos2, to: Pos2) {
        self.log(format!("two fingers, {from:?} and {to:?}"));
        self.touch(1, TouchPhase::Start, from);
        self.button(from, PointerButton::Primary, true, Modifiers::NONE);
        self.touch(2, TouchPhase::Start, to);
        self.frame();
        for step in 0..3 {
            let [x, y] = [(); 2].map(|()| 60.0 * self.dice.signed() as f32);
            self.touch(1, TouchPhase::Move, from + vec2(x, y) * step as f32);
            self.touch(2, TouchPhase::Move, to - vec2(x, y) * step as f32);
            self.frame();
        }
        self.touch(1, TouchPhase::End, from);
        self.button(from, PointerButton::Primary, false, Modifiers::NONE);
        if self.dice.chance(0.9) {
            self.touch(2, TouchPhase::End, to);
        } else {
            self.touch(2, TouchPhase::Cancel, to);
        }
        self.event(Event::PointerGone);
        self.frame();
    }

    /// The key of a command, a key of fly mode, or C, which may stay down for some frames.
    pub fn press_shortcut(&mut self) {
        let index = self.below(SHORTCUTS.len() + FLIGHT.len() + 3);
        if let Some(shortcut) = SHORTCUTS.get(index) {
            self.log(format!("{:?} for {:?}", shortcut.key, shortcut.command));
            self.key(shortcut.key, shortcut.modifiers);
            self.frame();
            return self.frame();
        }
        let flight = FLIGHT.get(index - SHORTCUTS.len());
        let key = flight.map_or(Key::C, |flight| flight.key);
        let count = 1 + self.below(6);
        self.log(format!("hold {key:?} for {count} frames"));
        let event = |pressed, repeat| Event::Key {
            key,
            physical_key: Some(key),
            pressed,
            repeat,
            modifiers: Modifiers::NONE,
        };
        for frame in 0..count {
            self.event(event(true, frame > 0));
            self.frame();
        }
        // A key that is released in another window stays down here.
        if self.dice.chance(0.9) {
            self.event(event(false, false));
        }
        self.frame();
    }
}
