//! Cones of shadow rays: queues the blocks that face a light, and the distance to which they are clear.
//!
//! [`super::shadow`] dispatches the pass.

use crate::render::pipeline_set;
use crate::render::recorder::{ONE_MODE, Pass, Record};

/// The pass.
pub const PASS: Pass = Pass {
    name: "shadow_cone",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.enqueue],
    set: &pipeline_set::RAYS,
    modes: ONE_MODE,
    record: Record::Within,
};
