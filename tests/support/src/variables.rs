//! Numbers from environment variables, and seeds of tests with new inputs in each run.

use std::{
    env,
    time::{SystemTime, UNIX_EPOCH},
};

/// A variable's number; none if there is no such variable, or if it is no number.
pub fn number(name: &str) -> Option<u64> {
    env::var(name).ok()?.parse().ok()
}

/// The seed in `MANDELIGHT_SEED`, or one from the clock. Odd, so that it is not 0, at which [`Random`](crate::random::Random) stays.
pub fn seed() -> u64 {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    number("MANDELIGHT_SEED").unwrap_or(now.map_or(1, |time| time.as_micros() as u64)) | 1
}
