//! The adapter and the device, always with WebGPU's default limits, so that what works on one
//! adapter fits them all.

use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering},
};

use super::AsyncCompile;

/// Why there is no usable GPU.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// No adapter was offered, or none of the wanted name.
    #[error(
        "no GPU adapter was found{wanted}: install a Vulkan driver (Mesa's lavapipe will do), or use a browser with WebGPU; found: {found}"
    )]
    NoAdapter {
        /// ` named "…"` where a name was asked for.
        wanted: String,
        /// What there is, or "none".
        found: String,
    },
    /// The adapter refused a device with default limits.
    #[error("the adapter {adapter} gave no device with WebGPU's default limits: {reason}")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// What wgpu said.
        reason: String,
    },
}

/// A device, its queue and what they came from. Clones share the same device.
#[derive(Clone)]
pub struct Gpu {
    /// What the adapter came from; a window's surface needs the same one.
    pub instance: wgpu::Instance,
    /// Where the device came from.
    pub adapter: wgpu::Adapter,
    /// The device, with default limits.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Asynchronous pipeline compilation, where the platform has it.
    pub async_compile: Option<AsyncCompile>,
    faults: Arc<AtomicU64>,
}

impl Gpu {
    /// Opens the adapter that the platform prefers, natively the first whose name contains
    /// `wanted` (any case) where that is given.
    pub async fn open(wanted: Option<&str>) -> Result<Self, GpuError> {
        let mut wanted_instance = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        // The sizes of indirect dispatches are counted by the program's own shaders, from lists that
        // are never longer than a dispatch may be; to check each would take a dispatch more.
        wanted_instance.flags.remove(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL);
        let instance = wgpu::Instance::new(wanted_instance);
        let adapter = match wanted {
            Some(name) => named_adapter(&instance, name).await?,
            None => instance
                .request_adapter(&wgpu::RequestAdapterOptions {
                    power_preference: wgpu::PowerPreference::HighPerformance,
                    ..Default::default()
                })
                .await
                .map_err(|error| GpuError::NoAdapter {
                    wanted: String::new(),
                    found: format!("none ({error})"),
                })?,
        };
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                label: Some("mandelight"),
                required_limits: wgpu::Limits::default(),
                ..Default::default()
            })
            .await
            .map_err(|error| GpuError::NoDevice {
                adapter: adapter.get_info().name,
                reason: error.to_string(),
            })?;
        let faults = Arc::new(AtomicU64::new(0));
        let counted = faults.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            counted.fetch_add(1, Ordering::Relaxed);
            log::error!("GPU error: {error}");
        }));
        Ok(Self { instance, adapter, device, queue, async_compile: None, faults })
    }

    /// The adapter's name and backend, for people: `llvmpipe (LLVM 15.0.6) · Vulkan`.
    pub fn name(&self) -> String {
        adapter_name(&self.adapter)
    }

    /// Errors that the device has reported and nothing handled: 0 in a correct program.
    pub fn faults(&self) -> u64 {
        self.faults.load(Ordering::Relaxed)
    }

    /// Lets callbacks of finished work run. On the web they run by themselves.
    pub fn poll(&self) {
        if let Err(error) = self.device.poll(wgpu::PollType::Poll) {
            log::warn!("polling the GPU: {error}");
        }
    }

    /// Waits until all submitted work is done. On the web this returns at once.
    pub fn wait(&self) {
        self.poll_for(wgpu::PollType::wait_indefinitely());
    }

    /// Waits until one submit, and what came before it, is done. On the web this returns at once.
    pub fn wait_for(&self, submit: &wgpu::SubmissionIndex) {
        self.poll_for(wgpu::PollType::Wait {
            submission_index: Some(submit.clone()),
            timeout: None,
        });
    }

    fn poll_for(&self, what: wgpu::PollType) {
        if let Err(error) = self.device.poll(what) {
            log::warn!("waiting for the GPU: {error}");
        }
    }
}

/// Names of all adapters, as [`Gpu::name`] has them. Empty in browsers, which tell only one.
pub async fn adapter_names() -> Vec<String> {
    let instance =
        wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    instance.enumerate_adapters(wgpu::Backends::all()).await.iter().map(adapter_name).collect()
}

async fn named_adapter(instance: &wgpu::Instance, name: &str) -> Result<wgpu::Adapter, GpuError> {
    let adapters = instance.enumerate_adapters(wgpu::Backends::all()).await;
    let names: Vec<String> = adapters.iter().map(adapter_name).collect();
    let wanted = name.to_lowercase();
    adapters
        .into_iter()
        .find(|adapter| adapter_name(adapter).to_lowercase().contains(&wanted))
        .ok_or_else(|| GpuError::NoAdapter {
            wanted: format!(" named \"{name}\""),
            found: if names.is_empty() { "none".into() } else { names.join(", ") },
        })
}

fn adapter_name(adapter: &wgpu::Adapter) -> String {
    let info = adapter.get_info();
    // Browsers may keep the name to themselves.
    format!("{} · {}", if info.name.is_empty() { "GPU" } else { &info.name }, info.backend)
}

/// `f` of every item, in order: on as many threads as there are processors, where the platform has any.
pub fn in_parallel<T: Sync, R: Send + Sync>(items: &[T], f: impl Fn(&T) -> R + Sync) -> Vec<R> {
    #[cfg(target_arch = "wasm32")]
    return items.iter().map(f).collect();
    #[cfg(not(target_arch = "wasm32"))]
    {
        let next = std::sync::atomic::AtomicUsize::new(0);
        let found: Vec<_> = items.iter().map(|_| std::sync::OnceLock::new()).collect();
        let work = || {
            while let Some((item, found)) = {
                let index = next.fetch_add(1, Ordering::Relaxed);
                items.get(index).zip(found.get(index))
            } {
                // Each index is handed out once.
                let _ = found.set(f(item));
            }
        };
        let threads = std::thread::available_parallelism().map_or(1, |count| count.get());
        std::thread::scope(|scope| {
            for _ in 1..threads.min(items.len()) {
                scope.spawn(work);
            }
            work();
        });
        found.into_iter().filter_map(std::sync::OnceLock::into_inner).collect()
    }
}
