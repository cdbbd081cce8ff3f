//! Random walks over the interface: whatever a person does, in any order, breaks nothing and leaves nothing behind.
//!
//! A walk that fails prints its seed and its last actions. `MANDELIGHT_SEED=… MANDELIGHT_ACTIONS=… cargo test --test walk
//! one_walk -- --ignored --nocapture` does the same actions again; both variables unset, it does others each run.

mod checks;
mod gestures;
mod shell;
#[path = "../ui/stage.rs"]
#[expect(dead_code, reason = "the tests of tests/ui use the rest")]
mod stage;
mod textures;
mod walker;
mod widgets;

use std::{
    alloc::System,
    sync::{Mutex, MutexGuard, PoisonError},
};

use cap::Cap;
use mandelight::gpu::device::in_parallel;
use mandelight_test_support::variables;

use walker::{Formulas, Walker};

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Keeps other walks from allocating until it is dropped.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Walks of the ordinary tests, and the actions of each.
const WALKS: u64 = 10;
const ACTIONS: u64 = 1000;

#[test]
fn ten_thousand_actions_break_nothing() {
    let _alone = alone();
    let seeds: Vec<u64> = (1..=WALKS).collect();
    let frames = in_parallel(&seeds, |&seed| {
        let mut walker = Walker::new(seed, Formulas::Typed);
        walker.walk(ACTIONS);
        walker.frames()
    });
    println!("{} frames", frames.iter().sum::<u64>());
}

#[test]
#[ignore = "other actions each run: see the file's first lines"]
fn one_walk() {
    let _alone = alone();
    let seed = variables::seed();
    let actions = variables::number("MANDELIGHT_ACTIONS").unwrap_or(100_000);
    println!("MANDELIGHT_SEED={seed} MANDELIGHT_ACTIONS={actions}");
    Walker::new(seed, Formulas::Typed).walk(actions);
}

/// Actions of a round, after which all is closed.
const ROUND: u64 = 350;
/// Rounds after which everything that is made once has been made, and rounds that are compared.
const ROUNDS: [u64; 2] = [11, 4];
/// Bytes by which rounds may differ. With debug assertions egui keeps the path of each widget id that ever was, as text.
const MAX_GROWTH_BYTES: usize = if cfg!(debug_assertions) { 4 << 20 } else { 3 << 19 };

#[test]
fn memory_comes_back_once_all_is_closed() {
    let _alone = alone();
    let mut walker = Walker::new(77, Formulas::AsTheyAre);
    let mut round = || {
        walker.walk(ROUND);
        walker.close_all();
        (ALLOCATOR.allocated(), walker.textures())
    };
    let held: Vec<_> = (0..ROUNDS[0] + ROUNDS[1]).map(|_| round()).collect();
    println!("bytes, and textures with their bytes: {held:?}");
    let (before, after) = held.split_at(ROUNDS[0] as usize);
    let most = |rounds: &[(usize, (usize, usize))]| {
        // The texture of the fonts doubles when a text first has a size: its bytes are no leak.
        let bytes = rounds.iter().map(|(bytes, textures)| bytes.saturating_sub(textures.1));
        let bytes = bytes.max().unwrap_or_default();
        (bytes, rounds.iter().map(|round| round.1.0).max().unwrap_or_default())
    };
    let ((bytes, textures), (bytes_after, textures_after)) = (most(before), most(after));
    assert!(bytes_after <= bytes + MAX_GROWTH_BYTES, "{bytes} bytes became {bytes_after}");
    assert!(textures_after <= textures, "{textures} textures became {textures_after}");
}
