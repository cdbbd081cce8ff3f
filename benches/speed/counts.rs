//! What both sides do for a picture: distance estimates and orbit steps.

use std::ops::AddAssign;

use mandelight::{
    gpu::{
        Gpu,
        readback::{Readback, ReadbackError},
        shader::Module,
    },
    render::{
        Pipelines, pass,
        pipelines::{Passes, PipelineKey},
        uniforms::Inputs,
    },
    scene::Scene,
};
use serde::Serialize;

use super::{
    Failure,
    instrument::{self, Marks},
    literal::{Kindness, Literal, Picture},
    ours,
};

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

/// The literal kernel's counts for one sample of each pixel of a whole picture.
///
/// # Errors
/// Where the device is lost, or the kernel can't be counted.
pub fn literal(gpu: &Gpu, inputs: &Inputs, kindness: Kindness) -> Result<Counts, Failure> {
    let counting = Literal::counting(gpu)?;
    Ok(Picture::new(&counting, inputs, 1, kindness, 1).count()?)
}

/// What later samples' counts are called.
pub const LATER: &str = "a later sample";

/// The program's counts for the first sample of each pixel of a whole picture, pass by pass, and
/// for a later one where there is one.
///
/// # Errors
/// Where the device is lost, or a kernel can't be counted.
pub fn ours(
    pipelines: &Pipelines,
    scene: &Scene,
    size_px: [u32; 2],
) -> Result<Vec<(&'static str, Counts)>, Failure> {
    let split = ours::Split::new(pipelines, scene, size_px);
    let passes = counting_passes(pipelines, &split)?;
    let mut counts = split.count(&passes)?;
    if scene.quality.samples > 1 {
        counts.push((LATER, split.count_later(&passes)?));
    }
    Ok(counts)
}

/// Copies of the passes that march, for pictures of one form, that count.
///
/// # Errors
/// Where a kernel can't be counted.
pub fn counting_passes(pipelines: &Pipelines, split: &ours::Split<'_>) -> Result<Passes, Failure> {
    let constants = PipelineKey::of(split.frame()).constants();
    let gpu = &pipelines.gpu;
    let [enqueue, queued] = [&pipelines.layouts.enqueue, &pipelines.layouts.dequeue]
        .map(|layout| split.counting_layout(layout));
    let made =
        |layout: &wgpu::PipelineLayout, module: &Module, estimate: &str| -> Result<_, Failure> {
            let shader = counting(gpu, module, &marks(&[estimate], ours::Split::COUNTS))?;
            Ok(gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(module.label),
                layout: Some(layout),
                module: &shader,
                entry_point: Some("main"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &constants,
                    ..Default::default()
                },
                cache: None,
            }))
        };
    Ok(Passes {
        camera_cone: made(&enqueue, &pass::camera_cone::MODULE, "estimate_at")?,
        march: made(&queued, &pass::march::MODULE, "estimate_at")?,
        normal: made(&queued, &pass::normal::MODULE, "distance_gradient")?,
        shadow_cone: made(&enqueue, &pass::shadow_cone::MODULE, "estimate_at")?,
        shadow: made(&queued, &pass::shadow::MODULE, "estimate_at")?,
        ..pipelines.passes(split.frame())
    })
}
