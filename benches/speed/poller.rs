//! A thread that runs completion callbacks promptly.

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

use mandelight::gpu::Gpu;

/// A thread that runs completion callbacks promptly, as browsers do.
pub struct Poller {
    stop: Arc<AtomicBool>,
    thread: Option<std::thread::JoinHandle<()>>,
}

impl Poller {
    /// Polls `gpu` from now on, until the drop.
    pub fn new(gpu: &Gpu) -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        let (gpu, should_stop) = (gpu.clone(), stop.clone());
        let thread = std::thread::spawn(move || {
            while !should_stop.load(Ordering::Relaxed) {
                gpu.poll();
                std::thread::sleep(Duration::from_micros(200));
            }
        });
        Self { stop, thread: Some(thread) }
    }
}

impl Drop for Poller {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // A poller that panicked has printed its message.
            let _ = thread.join();
        }
    }
}
