//! A recorded session: the pointer's position at each tick of the display, and what it drags.
//!
//! In: a table. Out: the scene of every tick, the same on every machine.

use glam::{DQuat, DVec2, DVec3};
use mandelight::{
    formula::mandelbulb::{Mandelbulb, estimator::Estimator},
    scene::Scene,
    ui::navigation::{Navigator, Viewport, World},
};

/// Width and height of the picture, pixels.
pub const SIZE_PX: [u32; 2] = [1280, 720];

/// The control that the pointer drags.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// The view, which turns about the point under the pointer.
    Orbit,
    /// The wheel, which moves the camera closer.
    ///
    /// The third number of a stroke is the wheel's travel, in natural logarithms of the distance.
    Dive,
    /// The ball that turns the first light.
    Light,
    /// The power's slider.
    Power,
    /// The exposure's slider.
    Exposure,
}

/// A part of the session: a drag, and the rest after it.
pub struct Part {
    /// The part's name in the results.
    pub name: &'static str,
    /// The dragged control.
    pub hold: Hold,
    /// Tick, pointer x and y in normalised device coordinates, and the wheel's travel so far.
    ///
    /// Values between two entries are interpolated linearly.
    strokes: &'static [(u32, f64, f64, f64)],
}

/// The session: each drag starts slowly, speeds up, hesitates, turns back and ends.
pub const PARTS: [Part; 5] = [
    Part {
        name: "orbit",
        hold: Hold::Orbit,
        strokes: &[
            (0, 0.21, -0.08, 0.0),
            (4, 0.20, -0.08, 0.0),
            (9, 0.12, -0.05, 0.0),
            (15, -0.06, 0.02, 0.0),
            (22, -0.27, 0.06, 0.0),
            (27, -0.35, 0.05, 0.0),
            (31, -0.36, 0.04, 0.0),
            (37, -0.30, -0.06, 0.0),
            (44, -0.16, -0.17, 0.0),
            (52, -0.11, -0.20, 0.0),
            (58, -0.10, -0.21, 0.0),
        ],
    },
    Part {
        name: "dive",
        hold: Hold::Dive,
        strokes: &[
            (0, 0.05, 0.12, 0.0),
            (6, 0.05, 0.12, 0.25),
            (18, 0.06, 0.13, 1.1),
            (30, 0.06, 0.13, 1.8),
            (40, 0.03, 0.10, 2.3),
            (52, 0.02, 0.09, 2.9),
            (60, 0.02, 0.09, 3.1),
        ],
    },
    Part {
        name: "light",
        hold: Hold::Light,
        strokes: &[
            (0, 0.0, 0.0, 0.0),
            (5, 0.03, 0.01, 0.0),
            (14, 0.22, 0.05, 0.0),
            (24, 0.48, -0.04, 0.0),
            (33, 0.55, -0.16, 0.0),
            (42, 0.38, -0.22, 0.0),
            (50, 0.33, -0.20, 0.0),
        ],
    },
    Part {
        name: "power",
        hold: Hold::Power,
        strokes: &[
            (0, 0.0, 0.0, 0.0),
            (6, 0.04, 0.0, 0.0),
            (16, 0.31, 0.0, 0.0),
            (28, 0.68, 0.0, 0.0),
            (38, 0.93, 0.0, 0.0),
            (46, 0.86, 0.0, 0.0),
            (52, 0.84, 0.0, 0.0),
        ],
    },
    Part {
        name: "exposure",
        hold: Hold::Exposure,
        strokes: &[
            (0, 0.0, 0.0, 0.0),
            (8, 0.10, 0.0, 0.0),
            (18, 0.55, 0.0, 0.0),
            (28, 0.70, 0.0, 0.0),
            (38, 0.42, 0.0, 0.0),
            (44, 0.40, 0.0, 0.0),
        ],
    },
];

impl Part {
    /// The number of ticks of the drag.
    pub fn ticks(&self) -> u32 {
        self.strokes.last().map_or(0, |stroke| stroke.0)
    }

    /// Position of the pointer and travel of the wheel at a tick.
    fn pointer(&self, tick: u32) -> (DVec2, f64) {
        let after = self.strokes.iter().position(|stroke| stroke.0 > tick);
        let place = |&(_, x, y, wheel): &(u32, f64, f64, f64)| (DVec2::new(x, y), wheel);
        let Some(after) = after else { return place(&self.strokes[self.strokes.len() - 1]) };
        let (from, to) = (&self.strokes[after - 1], &self.strokes[after]);
        let part = f64::from(tick - from.0) / f64::from(to.0 - from.0);
        let ((from, wheel_from), (to, wheel_to)) = (place(from), place(to));
        (from.lerp(to, part), wheel_from + (wheel_to - wheel_from) * part)
    }
}

/// The scenes of a session at every tick.
pub struct Session {
    /// The scenes of each part; the first is the scene before the drag.
    pub parts: Vec<Vec<Scene>>,
}

impl Session {
    /// Plays the table through the page's own navigation.
    pub fn record() -> Self {
        let mut scene = first_scene();
        let parts = PARTS
            .iter()
            .map(|part| {
                let scenes = play_part(part, &scene);
                scene = scenes.last().unwrap_or(&scene).clone();
                scenes
            })
            .collect();
        Self { parts }
    }

    /// The last scene of a part.
    pub fn end_of(&self, part: usize) -> &Scene {
        let scenes = &self.parts[part];
        &scenes[scenes.len() - 1]
    }
}

/// The default scene of documents, with shadows from each of its three lights.
fn first_scene() -> Scene {
    let mut scene = Scene::default();
    for light in &mut scene.lights.environment {
        light.casts_shadows = true;
    }
    scene
}

fn play_part(part: &Part, start: &Scene) -> Vec<Scene> {
    let [width, height] = SIZE_PX.map(f64::from);
    let viewport =
        Viewport { aspect: width / height, height_px: height, detail: start.quality.detail };
    let field = Estimator::new(&Mandelbulb::of(&start.fractal));
    let world = World { field: &field, viewport };
    let mut scene = start.clone();
    let mut navigator = Navigator::default();
    let (first, _) = part.pointer(0);
    if part.hold == Hold::Orbit {
        navigator.begin_orbit(&scene.camera, world, first);
    }
    let mut scenes = vec![scene.clone()];
    let mut last_wheel = 0.0;
    for tick in 1..=part.ticks() {
        let (at, wheel) = part.pointer(tick);
        let offset = at - first;
        match part.hold {
            Hold::Orbit => {
                navigator.drag(&mut scene.camera, world, at);
            }
            Hold::Dive => {
                navigator.dolly(&mut scene.camera, world, at, wheel - last_wheel);
            }
            Hold::Light => {
                let turn =
                    DQuat::from_rotation_z(2.5 * offset.x) * DQuat::from_rotation_x(offset.y);
                let from = DVec3::from_array(start.lights.environment[0].direction);
                scene.lights.environment[0].direction = (turn * from).normalize().to_array();
            }
            // Sliders round to the digits that they show.
            Hold::Power => {
                let power = Mandelbulb::of(&start.fractal).power + 2.0 * offset.x;
                scene.fractal.set("power", (100.0 * power).round() * 0.01);
            }
            Hold::Exposure => {
                scene.tone.exposure =
                    (100.0 * (start.tone.exposure + 2.0 * offset.x)).round() * 0.01;
            }
        }
        last_wheel = wheel;
        scenes.push(scene.clone());
    }
    scenes
}

/// A copy of the scene with another motion budget, milliseconds.
pub fn with_motion_budget(scene: &Scene, budget_ms: f64) -> Scene {
    let mut scene = scene.clone();
    scene.quality.motion_budget_ms = budget_ms;
    scene
}
