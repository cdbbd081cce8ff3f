//! Counts of distance estimates and orbit steps, and the shaders that count them.
//!
//! In: a shader module. Out: a copy that counts, and the [`Counts`] that it wrote.

use std::ops::AddAssign;

use mandelight::gpu::{
    Gpu,
    readback::{Readback, ReadbackError},
    shader::Module,
};
use serde::Serialize;

use super::instrument::{self, Counters, Marks};

/// Distance estimates and orbit steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    /// Distance estimates, including those of normals.
    pub estimates: f64,
    /// Orbit steps of estimates, normals and colours.
    pub steps: f64,
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.estimates += other.estimates;
        self.steps += other.steps;
    }
}

impl Counts {
    /// The counts divided by a number of pixels.
    pub fn per(self, pixels: f64) -> Self {
        Self { estimates: self.estimates / pixels, steps: self.steps / pixels }
    }

    /// Reads the buffer that counting shaders add to.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn read(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<Self, ReadbackError> {
        let bytes = Readback::buffer(gpu, buffer).wait(gpu)?;
        let word = |index: usize| {
            let word = bytes.as_chunks::<4>().0.get(index).ok_or(ReadbackError)?;
            Ok(f64::from(u32::from_le_bytes(*word)))
        };
        Ok(Self { estimates: word(0)?, steps: word(1)? })
    }
}

/// How to count in the program's modules, whose orbits are in files that begin with `orbits_in`.
pub fn marks<'a>(
    orbits_in: &'a str,
    estimates: &'a [&'a str],
    counters: Counters<'a>,
) -> Marks<'a> {
    Marks {
        orbits_in,
        other_loops: &[],
        steps: &["near_step"],
        estimates,
        entries: &["main"],
        counters,
    }
}

/// Compiles a copy of a module that counts.
///
/// # Errors
/// If a marked function or an orbit loop isn't in the text.
pub fn counting(
    gpu: &Gpu,
    module: &Module,
    marks: &Marks<'_>,
) -> Result<wgpu::ShaderModule, String> {
    let files: Vec<_> = module.parts().collect();
    let text = instrument::counting(&files, marks)?;
    Ok(gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(module.label),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    }))
}
