//! How the page feels in the hand: a recorded session, replayed at 1280x720 against the clock.
//!
//! The motion budget is a twentieth of what a full frame takes on this adapter, so that the
//! figures mean the same on every one. In: an adapter's pipelines. Out: moving frames' times in
//! budgets, what edits cost next to a camera move, how soon the whole picture follows a release,
//! and how good moving pictures are.

mod difference;
mod edits;
mod quality;
mod replay;
mod results;
mod session;

use std::{path::Path, sync::Arc};

use mandelight::render::Pipelines;

use super::failure::Failure;
pub use results::Results;
use session::{Hold, PARTS, Session};

/// What the command line calls it.
pub const NAME: &str = "feel";

/// Budgets in a full frame.
const BUDGETS: f64 = 20.0;

/// The part after which the picture is filled with surface: there a full frame is measured.
const FILLED_AFTER: usize = 1;

/// Replays the session. Pictures that were compared go to the folder `pictures`.
pub fn run(pipelines: &Arc<Pipelines>, pictures: Option<&Path>) -> Result<Results, Failure> {
    let session = Session::record();
    let costs = edits::costs(pipelines, session.end_of(FILLED_AFTER));
    let budget_ms = costs.camera_ms / BUDGETS;
    let replay = replay::play(pipelines, &session, budget_ms);
    let releases = PARTS.iter().enumerate().map(|(part, of)| {
        let edit = match of.hold {
            Hold::Orbit | Hold::Dive => edits::move_camera,
            Hold::Light => edits::move_light,
            Hold::Power => edits::raise_power,
            // Nothing is traced: there is nothing to wait for.
            Hold::Exposure => return None,
        };
        Some(edits::release(pipelines, session.end_of(part), edit, budget_ms))
    });
    let releases: Vec<_> = releases.collect();
    let qualities = quality::qualities(pipelines, &session, &replay.frames, budget_ms, pictures)?;
    Ok(Results::new(budget_ms, costs, &replay, &releases, &qualities))
}
