//! The memory and work of a call, counted by the program's allocator.

use std::alloc::System;

use cap::Cap;

/// Most memory that reading takes beside what is read, in bytes.
pub const MAX_HELD_BYTES: usize = 64 << 20;

/// What a call allocated.
#[derive(Clone, Copy, Debug)]
pub struct Allocations {
    /// Bytes of all allocations: a measure of work, which other programs do not disturb.
    pub total: usize,
    /// Most bytes that were held at a time beyond those before the call. An upper bound: the allocator knows the highest
    /// number since the program's start.
    pub peak: usize,
}

/// The result of `call`, and what the call allocated. No other thread may allocate meanwhile.
pub fn measured<T>(allocator: &Cap<System>, call: impl FnOnce() -> T) -> (T, Allocations) {
    let (held, total) = (allocator.allocated(), allocator.total_allocated());
    let before = allocator.max_allocated();
    let result = call();
    let highest = allocator.max_allocated();
    // After a call that broke the limit, lower peaks are unknown.
    let is_known = highest > before || before.saturating_sub(held) <= MAX_HELD_BYTES;
    let peak = if is_known { highest.saturating_sub(held) } else { 0 };
    // On 32 bits the sum starts again after 4 GiB.
    (result, Allocations { total: allocator.total_allocated().wrapping_sub(total), peak })
}
