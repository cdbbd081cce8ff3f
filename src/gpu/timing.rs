//! How long submitted work takes, measured without waiting for it.

use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use web_time::Instant;

use super::Gpu;

/// One submit that has finished.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finished<T> {
    /// What the submit was marked with.
    pub mark: T,
    /// Milliseconds it kept the GPU busy: from its own start, or from the end of the submit
    /// before it where that came later, to its end.
    pub busy_ms: f64,
}

/// Watches submits: at most a few are in flight, each with a mark of the caller's. Those of others
/// that go unnoticed count as part of the next one.
///
/// Browsers report the end of work through a promise, Chrome at once, Firefox on a 100 ms
/// poll; the time is then an upper bound.
pub struct Stopwatch<T> {
    in_flight: VecDeque<(T, Instant, Option<wgpu::SubmissionIndex>)>,
    ends: Arc<Mutex<VecDeque<Instant>>>,
    last_end: Option<Instant>,
}

impl<T> Default for Stopwatch<T> {
    fn default() -> Self {
        Self { in_flight: VecDeque::new(), ends: Arc::default(), last_end: None }
    }
}

fn locked(ends: &Mutex<VecDeque<Instant>>) -> MutexGuard<'_, VecDeque<Instant>> {
    // A queue of instants is valid whatever interrupted its holder.
    ends.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<T> Stopwatch<T> {
    /// Submits that have not been seen to finish.
    pub fn in_flight(&self) -> usize {
        self.in_flight.len()
    }

    /// Submits one command buffer, remembered by `mark`.
    pub fn submit(&mut self, gpu: &Gpu, commands: wgpu::CommandBuffer, mark: T) {
        let index = gpu.queue.submit([commands]);
        self.watch(gpu, mark, Some(index));
    }

    /// Notes that somebody else has just submitted something, remembered by `mark`.
    pub fn note(&mut self, gpu: &Gpu, mark: T) {
        self.watch(gpu, mark, None);
    }

    fn watch(&mut self, gpu: &Gpu, mark: T, index: Option<wgpu::SubmissionIndex>) {
        self.in_flight.push_back((mark, Instant::now(), index));
        let ends = self.ends.clone();
        gpu.queue.on_submitted_work_done(move || locked(&ends).push_back(Instant::now()));
    }

    /// Waits until the oldest submit in flight has finished, so that those behind it keep the GPU
    /// busy while the next is made; where there is none, until all work is done. On the web this
    /// returns at once.
    pub fn wait(&self, gpu: &Gpu) {
        match self.in_flight.front() {
            Some((.., Some(index))) => gpu.wait_for(index),
            _ => gpu.wait(),
        }
    }

    /// The oldest submit that has finished since the last call; none where there is none.
    pub fn next_finished(&mut self) -> Option<Finished<T>> {
        let end = locked(&self.ends).pop_front()?;
        let (mark, submitted, _) = self.in_flight.pop_front()?;
        let start = self.last_end.map_or(submitted, |last| last.max(submitted));
        self.last_end = Some(end);
        Some(Finished { mark, busy_ms: end.saturating_duration_since(start).as_secs_f64() * 1e3 })
    }
}
