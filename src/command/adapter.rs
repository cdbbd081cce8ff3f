//! `--adapter`: the choice of a GPU, and detection of its loss.

use std::sync::{Arc, Mutex, PoisonError};

use mandelight::{gpu::Gpu, reading::visible};

use super::Failure;

/// The arguments that choose a GPU.
#[derive(clap::Args)]
pub struct AdapterArguments {
    /// Use the first GPU whose name contains this text, ignoring case [env: WGPU_ADAPTER_NAME]
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

impl AdapterArguments {
    /// Opens the GPU named by the argument, else by `WGPU_ADAPTER_NAME`, else the default GPU.
    pub fn open(self) -> Result<Gpu, Failure> {
        let wanted = self
            .adapter
            .or_else(|| std::env::var("WGPU_ADAPTER_NAME").ok())
            .filter(|name| !name.is_empty());
        // The error quotes the name. No GPU's name has control characters.
        let wanted = wanted.as_deref().map(visible);
        pollster::block_on(Gpu::open(wanted.as_deref())).map_err(Failure::failed)
    }
}

/// Detects the loss of the GPU's device.
pub struct Health(Arc<Mutex<Option<String>>>);

impl Health {
    /// Starts to observe the device of `gpu`.
    pub fn of(gpu: &Gpu) -> Self {
        let loss = Arc::<Mutex<Option<String>>>::default();
        let written = loss.clone();
        gpu.device.set_device_lost_callback(move |reason, message| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                *written.lock().unwrap_or_else(PoisonError::into_inner) = Some(message);
            }
        });
        Self(loss)
    }

    /// The driver's message about the device's loss, if the device is lost.
    pub fn loss(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}
