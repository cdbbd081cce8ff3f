//! Interactive response: a recorded session, replayed at 1280x720 in real time.
//!
//! In: an adapter's pipelines. Out: times of moving frames in motion budgets, costs of edits in
//! camera moves, times from release to full resolution, and errors of moving pictures. The
//! motion budget is a twentieth of a full frame's time, so that figures of different adapters
//! compare.

mod difference;
mod edits;
mod quality;
mod replay;
mod results;
mod session;

use std::{path::Path, sync::Arc};

use mandelight::render::Pipelines;

use super::failure::Failure;
pub use replay::PUMP_SECS;
pub use results::Results;
use session::{Hold, PARTS, Session};

/// The table's name for `--views`.
pub const NAME: &str = "feel";

/// Motion budgets per full frame.
const BUDGETS_PER_FULL_FRAME: f64 = 20.0;

/// The part that ends in a picture filled with surface, where the full frame is measured.
const FILLED_AFTER_PART: usize = 1;

/// Replays the session; writes compared pictures to the folder `pictures`.
///
/// # Errors
///
/// If a picture can't be read back or written.
pub fn run(pipelines: &Arc<Pipelines>, pictures: Option<&Path>) -> Result<Results, Failure> {
    let session = Session::record();
    let costs = edits::costs(pipelines, session.end_of(FILLED_AFTER_PART));
    let budget_ms = costs.camera_ms / BUDGETS_PER_FULL_FRAME;
    let replay = replay::play(pipelines, &session, budget_ms);
    let releases = PARTS.iter().enumerate().map(|(part, of)| {
        let edit = match of.hold {
            Hold::Orbit | Hold::Dive => edits::move_camera,
            Hold::Light => edits::move_light,
            Hold::Power => edits::raise_power,
            // Exposure traces no rays, so there is nothing to refine.
            Hold::Exposure => return None,
        };
        Some(edits::release(pipelines, session.end_of(part), edit, budget_ms))
    });
    let releases: Vec<_> = releases.collect();
    let qualities = quality::qualities(pipelines, &session, &replay.frames, budget_ms, pictures)?;
    Ok(Results::new(budget_ms, costs, &replay, &releases, &qualities))
}
