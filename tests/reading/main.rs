//! What reading costs: bytes allocated, counted by the program's allocator, never time.
//!
//! The files under attack are generated here: each is as long as its limits allow, or longer.

mod documents;
mod growth;
mod pictures;
mod scene_pictures;

use std::{
    alloc::System,
    sync::{Mutex, MutexGuard, PoisonError},
};

use cap::Cap;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Most memory that reading takes beside what is read, in bytes.
const MAX_BYTES: usize = 64 << 20;

/// Keeps other tests from allocating until it is dropped.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The result of `read`, and the bytes of all its allocations: a measure of work.
///
/// A call that holds more than [`MAX_BYTES`] at a time gets no more, which ends the process with "memory allocation
/// failed".
fn measured<T>(_alone: &MutexGuard<'_, ()>, read: impl FnOnce() -> T) -> (T, usize) {
    // The program's own formulas, which the first reading compiles.
    mandelight::scene::document::from_json(r#"{"mandelight":"scene","version":2,"scene":{}}"#)
        .expect("a scene");
    let set_limit = |bytes| ALLOCATOR.set_limit(bytes).expect("a limit above what is held");
    let before = ALLOCATOR.total_allocated();
    set_limit(ALLOCATOR.allocated() + MAX_BYTES);
    let result = read();
    set_limit(usize::MAX);
    // On 32 bits the sum starts again after 4 GiB.
    (result, ALLOCATOR.total_allocated().wrapping_sub(before))
}
