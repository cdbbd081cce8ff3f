//! `--adapter`: the choice of a GPU, and detection of its loss.

use std::sync::{Arc, Mutex, PoisonError};

use mandelight::{export::RunDevice, gpu::Gpu, reading::visible, render::Pipelines};

use super::{Failure, message};

/// The arguments that choose a GPU.
#[derive(clap::Args)]
pub struct AdapterArguments {
    /// Use the first GPU whose name contains this text, ignoring case [env: WGPU_ADAPTER_NAME]
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

impl AdapterArguments {
    /// Opens the GPU named by the argument, else by `WGPU_ADAPTER_NAME`, else the default GPU.
    pub fn open(&self) -> Result<Gpu, Failure> {
        let wanted = self
            .adapter
            .clone()
            .or_else(|| std::env::var("WGPU_ADAPTER_NAME").ok())
            .filter(|name| !name.is_empty());
        // The error quotes the name. No GPU's name has control characters.
        let wanted = wanted.as_deref().map(visible);
        pollster::block_on(Gpu::open(wanted.as_deref())).map_err(Failure::failed)
    }
}

/// The GPU that renders stills; another device replaces it if it is lost.
pub struct StillDevice {
    adapter: AdapterArguments,
    /// The pipelines on the device in use.
    pub pipelines: Arc<Pipelines>,
    health: Health,
}

impl StillDevice {
    /// Opens the GPU that `adapter` names.
    pub fn open(adapter: AdapterArguments) -> Result<Self, Failure> {
        let gpu = adapter.open()?;
        let health = Health::of(&gpu);
        Ok(Self { adapter, pipelines: Pipelines::for_stills(&gpu), health })
    }

    /// The driver's message about the device's loss, if the device is lost.
    pub fn loss(&self) -> Option<String> {
        self.health.loss()
    }
}

impl RunDevice for StillDevice {
    fn is_lost(&self) -> bool {
        self.loss().is_some()
    }

    fn replace(&mut self) -> Option<Arc<Pipelines>> {
        let reason = self.loss()?;
        let gpu = match self.adapter.open() {
            Ok(gpu) => gpu,
            Err(Failure::Usage(why) | Failure::Failed(why)) => {
                message(&format!("the GPU could not be started again: {why}"));
                return None;
            }
        };
        self.health = Health::of(&gpu);
        self.pipelines = Pipelines::for_stills(&gpu);
        message(&format!(
            "the GPU was lost ({reason}) and was started again; rendering goes on from the last finished tile"
        ));
        Some(self.pipelines.clone())
    }
}

/// Detects the loss of the GPU's device.
struct Health(Arc<Mutex<Option<String>>>);

impl Health {
    /// Starts to observe the device of `gpu`.
    fn of(gpu: &Gpu) -> Self {
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
    fn loss(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}
