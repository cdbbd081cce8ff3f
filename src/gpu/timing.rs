//! GPU time of submitted work, measured without waiting.

use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use web_time::Instant;

use super::Gpu;

/// Finished work and its GPU time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finished<T> {
    /// The caller's mark of the work.
    pub mark: T,
    /// GPU time, milliseconds: from the last submit of the work, or from the end of the work before if
    /// later, to the work's end.
    pub busy_ms: f64,
}

/// Measures the GPU time of work, each piece with a mark of the caller.
///
/// A submit that is not registered here counts as part of the next registered one. Browsers
/// report the end of work through a promise: Chrome at once, Firefox every 100 ms. The measured
/// time is then an upper bound.
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
    // A panic cannot leave a queue of instants invalid, so poisoning is ignored.
    ends.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<T> Stopwatch<T> {
    /// Number of pieces of work whose end has not been read yet.
    pub fn in_flight(&self) -> usize {
        self.in_flight.len()
    }

    /// Submits command buffers one by one, and measures all under `mark`.
    pub fn submit(
        &mut self,
        gpu: &Gpu,
        commands: impl IntoIterator<Item = wgpu::CommandBuffer>,
        mark: T,
    ) {
        let indices = commands.into_iter().map(|commands| gpu.queue.submit([commands]));
        let last = indices.last();
        self.watch(gpu, mark, last);
    }

    /// Measures work that other code has just submitted, under `mark`.
    pub fn note(&mut self, gpu: &Gpu, mark: T) {
        self.watch(gpu, mark, None);
    }

    fn watch(&mut self, gpu: &Gpu, mark: T, index: Option<wgpu::SubmissionIndex>) {
        self.in_flight.push_back((mark, Instant::now(), index));
        let ends = self.ends.clone();
        gpu.queue.on_submitted_work_done(move || locked(&ends).push_back(Instant::now()));
    }

    /// Waits for the oldest submit in flight; without one, for all work.
    ///
    /// Later submits keep the GPU busy while the caller prepares the next. On the web this
    /// returns at once.
    pub fn wait(&self, gpu: &Gpu) {
        match self.in_flight.front() {
            Some((.., Some(index))) => gpu.wait_for(index),
            _ => gpu.wait(),
        }
    }

    /// The oldest finished submit that was not returned yet, if any.
    pub fn next_finished(&mut self) -> Option<Finished<T>> {
        let end = locked(&self.ends).pop_front()?;
        let (mark, submitted, _) = self.in_flight.pop_front()?;
        let start = self.last_end.map_or(submitted, |last| last.max(submitted));
        self.last_end = Some(end);
        Some(Finished { mark, busy_ms: end.saturating_duration_since(start).as_secs_f64() * 1e3 })
    }
}
