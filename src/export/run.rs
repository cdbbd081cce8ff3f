//! Runs of a still to its end, for callers that may wait; native only.
//!
//! A run goes on with another device if its own is lost.

use std::{io::Write, ops::ControlFlow, sync::Arc};

use web_time::Instant;

use super::{ExportError, StillJob, StillStatus};
use crate::render::Pipelines;

/// A device that can be replaced once it is lost.
pub trait RunDevice {
    /// Whether the device is lost.
    fn is_lost(&self) -> bool;

    /// Opens another device; none if that fails.
    fn replace(&mut self) -> Option<Arc<Pipelines>>;
}

/// A device that nothing replaces.
struct OnlyDevice;

impl RunDevice for OnlyDevice {
    fn is_lost(&self) -> bool {
        false
    }

    fn replace(&mut self) -> Option<Arc<Pipelines>> {
        None
    }
}

impl<W: Write> StillJob<W> {
    /// Runs the job to its end on one device.
    ///
    /// `on_status` gets every status, and cancels the job by returning `Break`.
    ///
    /// # Errors
    /// As [`Self::step`] and [`Self::finish`]; [`ExportError::Cancelled`] after `Break`.
    pub fn run(
        self,
        on_status: impl FnMut(StillStatus) -> ControlFlow<()>,
    ) -> Result<W, ExportError> {
        self.run_on(&mut OnlyDevice, on_status)
    }

    /// Runs the job to its end, on replacements of `device` if needed.
    ///
    /// After a loss the job goes on from the last finished tile. `on_status` is that of [`Self::run`].
    ///
    /// # Errors
    /// As [`Self::run`]; [`ExportError::Gpu`] if nothing replaces a lost device, or if no tile was finished since the
    /// last loss: then the job may be what loses devices.
    pub fn run_on(
        mut self,
        device: &mut impl RunDevice,
        mut on_status: impl FnMut(StillStatus) -> ControlFlow<()>,
    ) -> Result<W, ExportError> {
        let clock = Instant::now();
        let mut tiles_at_loss = None;
        loop {
            let result = self.step(clock.elapsed().as_secs_f64());
            // A lost device causes many different errors. A complete picture needs no device, and a sink's error stays.
            let needs_device =
                matches!(result, Ok(StillStatus::Working { .. }) | Err(ExportError::Gpu(_)));
            if needs_device && device.is_lost() {
                let tiles = Some(self.finished_tiles());
                let replacement = if tiles == tiles_at_loss { None } else { device.replace() };
                let Some(pipelines) = replacement else {
                    return Err(ExportError::Gpu("the device was lost".to_owned()));
                };
                tiles_at_loss = tiles;
                self.resume_on(&pipelines);
                continue;
            }
            let status = result?;
            if on_status(status).is_break() {
                return Err(ExportError::Cancelled);
            }
            if matches!(status, StillStatus::Done { .. }) {
                return self.finish();
            }
            self.wait();
        }
    }
}
