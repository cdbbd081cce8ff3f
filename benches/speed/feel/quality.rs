//! Errors of moving pictures against full frames of the same scenes.
//!
//! In: the session and a replay's frames. Out: the differences of the shown picture, and those
//! of nearest-neighbour filling of the same lattice.

use std::{
    path::Path,
    sync::Arc,
    time::{Duration, Instant},
};

use mandelight::{
    gpu::readback::Readback,
    render::{Pace, Pipelines, Region, View},
    scene::Scene,
};

use super::{
    super::{failure::Failure, image_file},
    difference::Difference,
    replay::{Frame, displays},
    session::{SIZE_PX, Session, with_motion_budget},
};

/// Compared pictures per part of the session.
const PICTURES_PER_PART: usize = 4;

/// Differences of one moving picture from the full frame.
#[derive(Clone, Copy, Debug)]
pub struct Quality {
    /// Index of the session's part.
    pub part: usize,
    /// Pixels per computed pixel.
    pub pixels_per_sample: u32,
    /// Difference of the shown picture.
    pub shown: Difference,
    /// Difference of nearest-neighbour filling.
    pub nearest: Difference,
}

/// Draws a replay's frames again, without the clock, and compares them with full frames.
pub fn qualities(
    pipelines: &Arc<Pipelines>,
    session: &Session,
    frames: &[Frame],
    budget_ms: f64,
    folder: Option<&Path>,
) -> Result<Vec<Quality>, Failure> {
    let mut moving = View::new(pipelines, Region::whole(SIZE_PX), Pace::Interactive);
    let start = Instant::now();
    let mut qualities = Vec::new();
    if let Some(folder) = folder {
        std::fs::create_dir_all(folder)?;
    }
    for part in 0..session.parts.len() {
        let frames: Vec<_> = frames.iter().filter(|frame| frame.part == part).collect();
        let first = with_motion_budget(&session.parts[part][0], budget_ms);
        settle(&mut moving, &first, start);
        let every = (frames.len() / PICTURES_PER_PART).max(1);
        for (index, frame) in frames.iter().enumerate() {
            let scene = &session.parts[part][frame.tick as usize];
            draw_moving(pipelines, &mut moving, &with_motion_budget(scene, budget_ms), start);
            let pixels_per_sample = moving.report().pixels_per_sample;
            if index % every != every / 2 || pixels_per_sample == 1 {
                continue;
            }
            let shown = pixels(pipelines, &moving)?;
            let full = full_frame(pipelines, scene)?;
            let nearest = nearest(&full, pixels_per_sample);
            if let Some(folder) = folder {
                let name = |kind| folder.join(format!("feel-{part}-{index:02}-{kind}.png"));
                for (kind, bytes) in [("shown", &shown), ("full", &full), ("nearest", &nearest)] {
                    image_file::write(&name(kind), SIZE_PX, bytes)?;
                }
            }
            qualities.push(Quality {
                part,
                pixels_per_sample,
                shown: Difference::between(&shown, &full),
                nearest: Difference::between(&nearest, &full),
            });
        }
    }
    Ok(qualities)
}

/// Draws a scene at rest until each pixel has a sample.
fn settle(view: &mut View, scene: &Scene, start: Instant) {
    view.set_scene(scene, false);
    while view.pump(start.elapsed().as_secs_f64()) && view.report().samples_done == 0 {
        std::thread::sleep(Duration::from_millis(1));
    }
    view.pump(start.elapsed().as_secs_f64());
}

/// Draws one moving picture.
fn draw_moving(pipelines: &Pipelines, view: &mut View, scene: &Scene, start: Instant) {
    pipelines.gpu.wait();
    view.pump(start.elapsed().as_secs_f64());
    pipelines.gpu.wait();
    view.set_scene(scene, true);
    let before = displays(view);
    while displays(view) == before {
        if !view.pump(start.elapsed().as_secs_f64()) {
            // The scene equals the one before.
            return;
        }
        pipelines.gpu.wait();
    }
}

fn full_frame(pipelines: &Arc<Pipelines>, scene: &Scene) -> Result<Vec<u8>, Failure> {
    let mut scene = scene.clone();
    scene.quality.samples = 1;
    let mut view = View::new(pipelines, Region::whole(SIZE_PX), Pace::Still);
    view.set_scene(&scene, false);
    let start = Instant::now();
    while view.pump(start.elapsed().as_secs_f64()) {
        pipelines.gpu.wait();
    }
    pixels(pipelines, &view)
}

fn pixels(pipelines: &Pipelines, view: &View) -> Result<Vec<u8>, Failure> {
    let texture = view.texture().ok_or("the view shows nothing")?;
    Ok(Readback::texture(&pipelines.gpu, texture, SIZE_PX).wait(&pipelines.gpu)?)
}

/// Nearest-neighbour filling of a lattice of one pixel in `pixels_per_sample`.
fn nearest(full: &[u8], pixels_per_sample: u32) -> Vec<u8> {
    let spacing = 1 << (pixels_per_sample.ilog2() / 2);
    let is_staggered = pixels_per_sample.ilog2() % 2 == 1;
    let [width, height] = SIZE_PX;
    let is_on = |x: u32, y: u32| !is_staggered || (x / spacing + y / spacing).is_multiple_of(2);
    let mut picture = Vec::with_capacity(full.len());
    for y in 0..height {
        for x in 0..width {
            let mut best = (u32::MAX, 0);
            for cell_y in (y / spacing).saturating_sub(1)..=y / spacing + 1 {
                for cell_x in (x / spacing).saturating_sub(1)..=x / spacing + 1 {
                    let at = [cell_x * spacing, cell_y * spacing];
                    if at[0] >= width || at[1] >= height || !is_on(at[0], at[1]) {
                        continue;
                    }
                    let far = at[0].abs_diff(x).pow(2) + at[1].abs_diff(y).pow(2);
                    best = best.min((far, at[1] * width + at[0]));
                }
            }
            let from = 4 * best.1 as usize;
            picture.extend_from_slice(&full[from..from + 4]);
        }
    }
    picture
}
