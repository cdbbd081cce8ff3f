//! The adapter and the device.
//!
//! The device always has WebGPU's default limits, so that code that runs on one adapter runs on
//! all.

use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering},
};

use super::AsyncCompile;

/// Why no usable GPU was found.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// No adapter exists, or none has the requested name.
    #[error(
        "no GPU adapter was found{wanted}: install a Vulkan driver (Mesa's lavapipe will do), or use a browser with WebGPU; found: {found}"
    )]
    NoAdapter {
        /// ` named "…"` if a name was requested, else empty.
        wanted: String,
        /// Names of the existing adapters, or "none".
        found: String,
    },
    /// The adapter refused a device with default limits.
    #[error("the adapter {adapter} has no device with WebGPU's default limits: {reason}")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// wgpu's error message.
        reason: String,
    },
}

/// What a CPU adapter computes at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cpu {
    /// Cores of the processor.
    pub cores: u32,
    /// Threads of a workgroup that a core computes at once, as lanes of its vectors; 0 if it is not known.
    pub lanes: u32,
}

/// A device with its queue, adapter and instance. Clones share the device.
#[derive(Clone)]
pub struct Gpu {
    /// The instance of the adapter; a window's surface must have the same instance.
    pub instance: wgpu::Instance,
    /// The adapter of the device.
    pub adapter: wgpu::Adapter,
    /// The device, with default limits.
    pub device: wgpu::Device,
    /// The device's queue.
    pub queue: wgpu::Queue,
    /// Asynchronous pipeline compilation, if the platform has it.
    pub async_compile: Option<AsyncCompile>,
    /// What a CPU adapter, such as llvmpipe, computes at once; none for a GPU.
    pub cpu: Option<Cpu>,
    faults: Arc<AtomicU64>,
}

impl Gpu {
    /// Opens the platform's preferred adapter, or the first one whose name contains `wanted`.
    ///
    /// The comparison ignores case. Selection by name works natively only.
    ///
    /// # Errors
    ///
    /// See [`GpuError`].
    pub async fn open(wanted: Option<&str>) -> Result<Self, GpuError> {
        let mut wanted_instance = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        // wgpu validates each indirect dispatch with another dispatch. The shaders already keep
        // dispatch sizes in range: a work queue is never longer than the largest dispatch.
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
        let info = adapter.get_info();
        let cpu = (info.device_type == wgpu::DeviceType::Cpu)
            .then(|| Cpu { cores: processor_cores() as u32, lanes: info.subgroup_max_size });
        Ok(Self { instance, adapter, device, queue, async_compile: None, cpu, faults })
    }

    /// The adapter's name and backend for display: `llvmpipe (LLVM 15.0.6) · Vulkan`.
    pub fn name(&self) -> String {
        adapter_name(&self.adapter)
    }

    /// Number of uncaptured device errors: 0 in a correct program.
    pub fn faults(&self) -> u64 {
        self.faults.load(Ordering::Relaxed)
    }

    /// Runs the callbacks of finished work. On the web the browser runs these callbacks.
    #[expect(clippy::disallowed_methods, reason = "the one place that polls without waiting")]
    pub fn poll(&self) {
        if let Err(error) = self.device.poll(wgpu::PollType::Poll) {
            log::warn!("polling the GPU: {error}");
        }
    }

    /// Waits until all submitted work is done. On the web this returns at once.
    pub fn wait(&self) {
        self.poll_for(wgpu::PollType::wait_indefinitely());
    }

    /// Waits until `submit` and all earlier work are done. On the web this returns at once.
    pub fn wait_for(&self, submit: &wgpu::SubmissionIndex) {
        self.poll_for(wgpu::PollType::Wait {
            submission_index: Some(submit.clone()),
            timeout: None,
        });
    }

    #[expect(clippy::disallowed_methods, reason = "the one place that waits")]
    fn poll_for(&self, what: wgpu::PollType) {
        if let Err(error) = self.device.poll(what) {
            log::warn!("waiting for the GPU: {error}");
        }
    }
}

/// Names of all adapters in [`Gpu::name`]'s format. Empty in browsers, which list no adapters.
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
    // Browsers may hide the name.
    format!("{} · {}", if info.name.is_empty() { "GPU" } else { &info.name }, info.backend)
}

/// Number of the processor's cores; 1 on the web, where `web::start` replaces it.
fn processor_cores() -> usize {
    std::thread::available_parallelism().map_or(1, |count| count.get())
}

/// Applies `f` to every item on all processor cores; the results are in the items' order.
///
/// wasm has one thread.
pub fn in_parallel<T: Sync, R: Send + Sync>(items: &[T], f: impl Fn(&T) -> R + Sync) -> Vec<R> {
    #[cfg(target_arch = "wasm32")]
    return items.iter().map(f).collect();
    #[cfg(not(target_arch = "wasm32"))]
    {
        let next = std::sync::atomic::AtomicUsize::new(0);
        let results: Vec<_> = items.iter().map(|_| std::sync::OnceLock::new()).collect();
        let work = || {
            while let Some((item, result)) = {
                let index = next.fetch_add(1, Ordering::Relaxed);
                items.get(index).zip(results.get(index))
            } {
                // Each index occurs once, so `set` cannot fail.
                let _ = result.set(f(item));
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..processor_cores().min(items.len()) {
                scope.spawn(work);
            }
            work();
        });
        results.into_iter().filter_map(std::sync::OnceLock::into_inner).collect()
    }
}
