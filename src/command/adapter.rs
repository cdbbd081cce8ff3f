//! Which GPU, and what became of it.

use std::sync::{Arc, Mutex, PoisonError};

use mandelight::gpu::Gpu;

use super::Failure;

/// The choice of a GPU.
#[derive(clap::Args)]
pub struct AdapterArguments {
    /// Use the first GPU whose name contains this, in any case [env: WGPU_ADAPTER_NAME]
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

impl AdapterArguments {
    /// The GPU of that name, else the one that the environment names, else the platform's choice.
    pub fn open(self) -> Result<Gpu, Failure> {
        let wanted = self
            .adapter
            .or_else(|| std::env::var("WGPU_ADAPTER_NAME").ok())
            .filter(|name| !name.is_empty());
        pollster::block_on(Gpu::open(wanted.as_deref())).map_err(Failure::failed)
    }
}

/// Whether the device is still there.
pub struct Health(Arc<Mutex<Option<String>>>);

impl Health {
    /// Watches the device of `gpu` from here on.
    pub fn of(gpu: &Gpu) -> Self {
        let lost = Arc::<Mutex<Option<String>>>::default();
        let told = lost.clone();
        gpu.device.set_device_lost_callback(move |reason, message| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                *told.lock().unwrap_or_else(PoisonError::into_inner) = Some(message);
            }
        });
        Self(lost)
    }

    /// What the driver said when the device was lost; none while it is there.
    pub fn loss(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}
