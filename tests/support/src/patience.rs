//! How long tests wait for what has no time of its own.

use std::time::Duration;

/// Time after which a wait of a test is a hang: long enough for any busy machine.
pub const HANG: Duration = Duration::from_secs(1800);
