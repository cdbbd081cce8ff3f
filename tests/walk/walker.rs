//! One walk: an interface, the dice, and what was done so far.

use std::{cell::Cell, collections::VecDeque};

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Vec2, ViewportId, pos2};
use egui_kittest::{Harness, kittest::Queryable as _};
use mandelight::{
    scene::{dice::Dice, presets},
    ui::{Settings, SmallTextures},
};

use crate::{
    checks::LastChecked,
    shell,
    stage::{Stage, stage_with, unfolded},
    textures::Textures,
};

/// Actions that a failing walk prints.
const SHOWN: usize = 20;
/// Ordinary windows, in points, and those that no one has.
const ORDINARY: [[f32; 2]; 6] = [
    [1280.0, 720.0],
    [390.0, 844.0],
    [844.0, 390.0],
    [640.0, 420.0],
    [900.0, 1600.0],
    [3840.0, 2160.0],
];
const ODD: [[f32; 2]; 8] = [
    [0.0, 0.0],
    [1.0, 1.0],
    [0.0, 720.0],
    [1280.0, 1.0],
    [33.0, 20.0],
    [200.0, 2000.0],
    [2000.0, 120.0],
    [16384.0, 16384.0],
];
const RATIOS: [f32; 7] = [0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0];

/// Whether the walk writes into the formula editor: each formula that was ever typed stays in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Formulas {
    Typed,
    AsTheyAre,
}

thread_local! {
    /// The clock of this thread's walk, in milliseconds.
    static NOW_MS: Cell<f64> = const { Cell::new(0.0) };
}

/// A clock by which a slice of a frame has two steps, whatever else the machine does.
fn clock_ms() -> f64 {
    NOW_MS.replace(NOW_MS.get() + 1.0)
}

/// A walk over one interface.
pub struct Walker {
    pub harness: Harness<'static, Stage>,
    pub dice: Dice,
    pub formulas: Formulas,
    /// The window, in points.
    pub size: [f32; 2],
    pub is_hidden: bool,
    pub last_checked: LastChecked,
    textures: Textures,
    seed: u64,
    actions: u64,
    frames: u64,
    done: VecDeque<String>,
}

impl Walker {
    /// The walk of a seed, at its start.
    pub fn new(seed: u64, formulas: Formulas) -> Self {
        let mut dice = Dice::new(seed);
        let textures = Textures::default();
        let builder = Harness::builder().renderer(textures.clone()).allow_missing_glyphs();
        let size = ORDINARY[below(&mut dice, ORDINARY.len())];
        let start = presets::all().nth(below(&mut dice, 12)).expect("presets").scene;
        let settings = if dice.chance(0.5) { unfolded() } else { Settings::default() };
        let mut harness = stage_with(builder, start(), settings, size);
        egui_extras::install_image_loaders(&harness.ctx);
        harness.state_mut().interface.set_clock(clock_ms);
        harness.state_mut().reduced_motion = dice.chance(0.3);
        Self {
            harness,
            dice,
            formulas,
            size,
            is_hidden: false,
            last_checked: LastChecked::default(),
            textures,
            seed,
            actions: 0,
            frames: 0,
            done: VecDeque::new(),
        }
    }

    /// Does `count` more actions, and checks what they left after each.
    pub fn walk(&mut self, count: u64) {
        for _ in 0..count {
            self.actions += 1;
            self.act();
            self.answer();
            self.check();
        }
    }

    /// Actions so far.
    pub fn actions(&self) -> u64 {
        self.actions
    }

    /// Frames so far.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Number and bytes of the textures that egui holds.
    pub fn textures(&self) -> (usize, usize) {
        self.textures.total()
    }

    fn act(&mut self) {
        match self.below(100) {
            0..38 => self.use_widget(),
            38..48 => self.type_something(),
            48..60 => self.press_shortcut(),
            60..78 => self.gesture(),
            78..81 => self.resize(),
            81..83 => self.scale(),
            83..86 => self.hide_or_show(),
            86..89 => self.open_file(),
            89..92 => self.storm(),
            92..95 => self.change_shell(),
            _ => {
                let count = 1 + self.below(12);
                self.log(format!("wait {count} frames"));
                self.run_frames(count);
            }
        }
    }

    fn resize(&mut self) {
        self.size = if self.dice.chance(0.6) { self.pick(&ORDINARY) } else { self.pick(&ODD) };
        self.log(format!("resize to {:?}", self.size));
        self.harness.set_size(Vec2::from(self.size));
        self.run_frames(2);
    }

    fn scale(&mut self) {
        let ratio = self.pick(&RATIOS);
        self.log(format!("{ratio} pixels per point"));
        self.set_ratio(ratio);
        self.run_frames(2);
    }

    fn set_ratio(&mut self, ratio: f32) {
        let viewports = &mut self.harness.input_mut().viewports;
        viewports.entry(ViewportId::ROOT).or_default().native_pixels_per_point = Some(ratio);
    }

    /// Hides the page, or shows it again after a long time.
    fn hide_or_show(&mut self) {
        self.is_hidden = !self.is_hidden;
        let secs = self.pick(&[0.0, 1.0, 3600.0, 1e6]);
        self.log(format!("hidden: {}, after {secs} s", self.is_hidden));
        self.event(Event::WindowFocused(!self.is_hidden));
        let now_secs = self.harness.ctx.input(|input| input.time);
        let input = self.harness.input_mut();
        input.focused = !self.is_hidden;
        input.time = Some(now_secs + secs);
        self.frame();
        self.harness.input_mut().time = None;
        self.frame();
    }

    /// Many steps back and forward.
    fn storm(&mut self) {
        let count = 1 + self.below(12);
        self.log(format!("undo and redo {count} times"));
        for _ in 0..count {
            let (key, modifiers) = match self.below(5) {
                0..3 => (Key::Z, Modifiers::COMMAND),
                3 => (Key::Y, Modifiers::COMMAND),
                _ => (Key::Z, Modifiers::COMMAND | Modifiers::SHIFT),
            };
            self.key(key, modifiers);
            if self.dice.chance(0.4) {
                self.frame();
            }
        }
        self.frame();
    }

    /// Ends gestures, closes windows and puts the first scene back, without steps.
    pub fn close_all(&mut self) {
        self.log("close all".to_owned());
        self.is_hidden = false;
        self.size = ORDINARY[0];
        self.harness.set_size(Vec2::from(self.size));
        self.set_ratio(1.0);
        self.harness.input_mut().focused = true;
        self.event(Event::WindowFocused(true));
        self.event(Event::ModifiersChanged(Modifiers::NONE));
        for button in [PointerButton::Primary, PointerButton::Secondary] {
            self.button(Pos2::ZERO, button, false, Modifiers::NONE);
        }
        self.event(Event::PointerGone);
        self.frame();
        for _ in 0..10 {
            self.key(Key::Escape, Modifiers::NONE);
            self.run_frames(2);
        }
        let closed = self.harness.query_all_by_label("Close window").map(|node| node.click());
        let windows = closed.count();
        self.harness.run_steps(1 + windows);
        let stage = self.harness.state_mut();
        (stage.export, stage.notice, stage.gallery) = (None, None, None);
        stage.small_pictures = SmallTextures::default();
        (stage.picture, stage.kept_picture) = (None, None);
        let interface = &mut stage.interface;
        interface.use_environment_map(shell::small_map("first.hdr"));
        interface.use_gradients(Vec::new());
        interface.replace_project(presets::opening());
        interface.editor_mut().restore_steps([]);
        let favourites = interface.favourites_mut();
        while !favourites.list().is_empty() {
            favourites.remove(0);
        }
        if interface.settings().timeline_open {
            self.key(Key::T, Modifiers::NONE);
        }
        self.run_frames(40);
        self.last_checked = LastChecked::default();
    }

    /// Notes an action before it is done.
    pub fn log(&mut self, what: String) {
        if self.done.len() == SHOWN {
            self.done.pop_front();
        }
        self.done.push_back(format!("{}: {what}", self.actions));
    }

    /// Adds an event to the next frame.
    pub fn event(&mut self, event: Event) {
        self.harness.input_mut().events.push(event);
    }

    /// Presses and releases a key within a frame.
    pub fn key(&mut self, key: Key, modifiers: Modifiers) {
        // Except on macOS, a browser reports Ctrl as both.
        let modifiers = Modifiers { ctrl: modifiers.command, ..modifiers };
        self.event(Event::ModifiersChanged(modifiers));
        for pressed in [true, false] {
            let (physical_key, repeat) = (None, false);
            self.event(Event::Key { key, physical_key, pressed, repeat, modifiers });
        }
        self.event(Event::ModifiersChanged(Modifiers::NONE));
    }

    /// Presses or releases a button of the pointer.
    pub fn button(
        &mut self,
        pos: Pos2,
        button: PointerButton,
        pressed: bool,
        modifiers: Modifiers,
    ) {
        self.event(Event::PointerButton { pos, button, pressed, modifiers });
    }

    /// Draws a frame with the events so far.
    pub fn frame(&mut self) {
        self.frames += 1;
        self.harness.step();
    }

    /// Draws some frames.
    pub fn run_frames(&mut self, count: usize) {
        for _ in 0..count {
            self.frame();
        }
    }

    /// The window.
    pub fn window(&self) -> Rect {
        Rect::from_min_size(Pos2::ZERO, self.size.into())
    }

    /// True in a window that people have.
    pub fn is_ordinary(&self) -> bool {
        ORDINARY.contains(&self.size)
    }

    /// A number below `limit`.
    pub fn below(&mut self, limit: usize) -> usize {
        below(&mut self.dice, limit)
    }

    /// One of the items.
    pub fn pick<T: Clone>(&mut self, items: &[T]) -> T {
        let index = self.below(items.len());
        items[index].clone()
    }

    /// A point of `rect`.
    pub fn point_of(&mut self, rect: Rect) -> Pos2 {
        let [x, y] = [(); 2].map(|()| self.dice.unit() as f32);
        pos2(rect.left() + x * rect.width(), rect.top() + y * rect.height())
    }
}

impl Drop for Walker {
    fn drop(&mut self) {
        if std::thread::panicking() {
            let Self { seed, actions, done, .. } = self;
            eprintln!("MANDELIGHT_SEED={seed} MANDELIGHT_ACTIONS={actions}; the last actions:");
            for action in done {
                eprintln!("{action}");
            }
        }
    }
}

fn below(dice: &mut Dice, limit: usize) -> usize {
    ((dice.unit() * limit as f64) as usize).min(limit.saturating_sub(1))
}
