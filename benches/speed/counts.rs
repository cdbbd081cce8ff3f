//! What both sides do for a picture: distance estimates and orbit steps.

use std::ops::AddAssign;

use mandelight::gpu::{
    Gpu,
    readback::{Readback, ReadbackError},
    shader::Module,
};
use serde::Serialize;

use super::instrument::{self, Marks};

/// How much of the formula a picture takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    /// Distance estimates, those of normals among them.
    pub estimates: f64,
    /// Orbit steps of those, and of normals and colours.
    pub steps: f64,
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.estimates += other.estimates;
        self.steps += other.steps;
    }
}

impl Counts {
    /// For each of so many pixels.
    pub fn per(self, pixels: f64) -> Self {
        Self { estimates: self.estimates / pixels, steps: self.steps / pixels }
    }

    /// From the buffer that counting shaders add to.
    ///
    /// # Errors
    /// Where the device is lost.
    pub fn read(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<Self, ReadbackError> {
        let bytes = Readback::buffer(gpu, buffer).wait(gpu)?;
        let word = |index: usize| {
            let word = bytes.as_chunks::<4>().0.get(index).ok_or(ReadbackError)?;
            Ok(f64::from(u32::from_le_bytes(*word)))
        };
        Ok(Self { estimates: word(0)?, steps: word(1)? })
    }
}

/// The program's modules, whose formula files hold the orbits.
pub fn marks<'a>(estimates: &'a [&'a str], buffer: [u32; 2]) -> Marks<'a> {
    Marks {
        orbits_in: "formula/",
        other_loops: &[],
        steps: &["near_step"],
        estimates,
        entries: &["main"],
        buffer,
    }
}

/// A counting copy of one of the program's modules.
///
/// # Errors
/// Where its text was written anew in a way that can't be counted.
pub fn counting(
    gpu: &Gpu,
    module: &Module,
    marks: &Marks<'_>,
) -> Result<wgpu::ShaderModule, String> {
    let files: Vec<_> = module.files.iter().map(|file| (file.path, file.text)).collect();
    let text = instrument::counting(&files, marks)?;
    Ok(gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(module.label),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    }))
}
