//! A target of `mandelight_fuzzing` as a coverage-guided fuzzer, with the same limits as in the ordinary tests.

use std::{alloc::System, sync::OnceLock};

use cap::Cap;
use mandelight_fuzzing::{
    FuzzTarget,
    meter::{MAX_HELD_BYTES, measured},
    mutated, target,
};

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Checks an input of the target `name`.
pub fn check(name: &str, bytes: &[u8]) {
    let target = prepared(name);
    let (_, allocated) = measured(&ALLOCATOR, || (target.check)(bytes));
    assert!(allocated.peak <= MAX_HELD_BYTES, "{} bytes are held at a time", allocated.peak);
    assert!(allocated.total <= target.most_work, "{} bytes are allocated in all", allocated.total);
}

/// Changes the first `size` bytes of `data` and returns the new size: half the time the changes keep the format.
pub fn mutate(name: &str, data: &mut [u8], size: usize, max_size: usize, seed: u32) -> usize {
    let mut rng = fastrand::Rng::with_seed(seed.into());
    if rng.bool() {
        return libfuzzer_sys::fuzzer_mutate(data, size, max_size);
    }
    let seeds = seeds(name);
    let other = &seeds[rng.usize(..seeds.len())];
    // An empty corpus begins with the seeds.
    let input = if size < 2 || rng.u8(..32) == 0 { &other[..] } else { &data[..size] };
    let changed = mutated(prepared(name).format, &mut rng, input, other);
    let count = changed.len().min(max_size);
    data[..count].copy_from_slice(&changed[..count]);
    count
}

fn seeds(name: &str) -> &'static [Vec<u8>] {
    static SEEDS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    SEEDS.get_or_init(|| (target(name).seeds)())
}

/// The target, after its first reading, which keeps what the program keeps.
fn prepared(name: &str) -> &'static FuzzTarget {
    static TARGET: OnceLock<&'static FuzzTarget> = OnceLock::new();
    TARGET.get_or_init(|| {
        let target = target(name);
        for seed in seeds(name) {
            (target.check)(seed);
        }
        target
    })
}

/// The fuzzer of a target.
macro_rules! fuzz {
    ($name:literal) => {
        libfuzzer_sys::fuzz_target!(|bytes: &[u8]| crate::fuzzer::check($name, bytes));
        libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
            crate::fuzzer::mutate($name, data, size, max_size, seed)
        });
    };
}
pub(crate) use fuzz;
