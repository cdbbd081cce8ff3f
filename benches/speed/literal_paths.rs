//! A path tracer in one kernel on the GPU: `literal_paths.wgsl` and its driver.
//!
//! In: the program's inputs of a scene with a sky, and a [`Tuning`]. Out: times, radiance, variance and counts. It uses
//! the estimator of `literal.wgsl`, and shares no shader with the program.

use std::time::Instant;

use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use mandelight::{
    gpu::{Gpu, readback::Readback},
    render::uniforms::{GRADIENT_ENTRIES, Inputs},
    scene::{Scene, color::luminance},
};

use super::{
    counts::Counts,
    failure::Failure,
    instrument,
    literal::{self, MAX_LOOP_ITERATIONS, Settings, Tuning},
};

const FILES: [(&str, &str); 2] =
    [("literal.wgsl", literal::TEXT), ("literal_paths.wgsl", include_str!("literal_paths.wgsl"))];

/// Host twin of `PathSettings` in `literal_paths.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct PathSettings {
    zenith: [f32; 3],
    reach: f32,
    horizon: [f32; 3],
    sky_reach: f32,
    ground: [f32; 3],
    bounces: u32,
    sample: u32,
    unused: [u32; 3],
}

/// The kernel's pipeline.
pub struct LiteralPaths {
    gpu: Gpu,
    pipeline: wgpu::ComputePipeline,
}

impl LiteralPaths {
    /// Compiles the pipeline.
    pub fn new(gpu: &Gpu) -> Self {
        Self::from_text(gpu, FILES.map(|(_, text)| text).join("\n"))
    }

    /// Compiles a pipeline that counts.
    ///
    /// # Errors
    /// If a marked function or an orbit loop isn't in the text.
    pub fn counting(gpu: &Gpu) -> Result<Self, String> {
        let marks = instrument::Marks {
            orbits_in: "literal",
            other_loops: &[
                "march",
                "six_sample_normal",
                "is_lit",
                "shadow",
                "shade",
                "march_outward",
                "trace_paths",
            ],
            steps: &[],
            estimates: &["distance_to_set"],
            entries: &["trace_paths"],
            // The lights' binding, which this entry point doesn't use.
            counters: instrument::Counters::Buffer([0, 1]),
        };
        Ok(Self::from_text(gpu, instrument::counting(&FILES, &marks)?))
    }

    fn from_text(gpu: &Gpu, text: String) -> Self {
        let device = &gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("literal paths"),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("literal paths"),
            layout: None,
            module: &module,
            entry_point: Some("trace_paths"),
            compilation_options: Default::default(),
            cache: None,
        });
        Self { gpu: gpu.clone(), pipeline }
    }
}

/// What the kernel's samples of a picture say.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    /// Mean luminance of the picture.
    pub radiance: f64,
    /// Variance of a sample's luminance about its pixel's mean, as the mean over all pixels.
    pub variance: f64,
}

/// One view, ready to be drawn by the kernel.
pub struct Picture<'a> {
    paths: &'a LiteralPaths,
    settings: PathSettings,
    pixels: usize,
    blocks: [u32; 2],
    path_settings: wgpu::Buffer,
    film: wgpu::Buffer,
    squares: wgpu::Buffer,
    counts: Option<wgpu::Buffer>,
    group: wgpu::BindGroup,
}

impl<'a> Picture<'a> {
    /// Allocates the view's buffers.
    ///
    /// `counts`: whether the pipeline is that of [`LiteralPaths::counting`]. Fewer steps than the tuning's suffice where
    /// the driver's cap on loops does not allow them.
    pub fn new(
        paths: &'a LiteralPaths,
        inputs: &Inputs,
        scene: &Scene,
        tuning: Tuning,
        counts: bool,
    ) -> Self {
        let device = &paths.gpu.device;
        let traced = &inputs.frame.paths;
        // The camera's ray, then a ray toward the sky and one to the next surface for each vertex.
        let rays = 2 * (traced.bounces + 1);
        let normals = 6 * (traced.bounces + 1);
        let estimates = MAX_LOOP_ITERATIONS / (tuning.iterations + 1);
        let steps = tuning.steps.min((estimates - normals) / rays);
        let settings = Settings::new(inputs, Tuning { steps, ..tuning }, 1);
        let blocks = settings.size_px.map(|side| side.div_ceil(8));
        let pixels = 64 * blocks[0] as usize * blocks[1] as usize;
        let buffer = |label, size: usize| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: size as u64,
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::COPY_DST
                    | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        };
        let path_settings = buffer("literal path settings", size_of::<PathSettings>());
        let film = buffer("literal film", 16 * pixels);
        let squares = buffer("literal squares", 4 * pixels);
        let counts = counts.then(|| buffer("counts", 8));
        let shared = buffer("literal settings", size_of::<Settings>());
        let gradient = buffer("literal gradient", 16 * GRADIENT_ENTRIES);
        let queue = &paths.gpu.queue;
        queue.write_buffer(&shared, 0, bytemuck::bytes_of(&settings));
        queue.write_buffer(&gradient, 0, bytemuck::cast_slice(&inputs.gradients[0]));
        let bound = [(0, &shared), (2, &gradient), (5, &film), (6, &path_settings), (7, &squares)];
        let counted = counts.as_ref().map(|counts| (1, counts));
        let entries: Vec<_> = bound
            .into_iter()
            .chain(counted)
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("literal paths"),
            layout: &paths.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let rig = &scene.lights.rig;
        let shining = |color: [f32; 3]| color.map(|channel| channel * rig.intensity as f32);
        let settings = PathSettings {
            zenith: shining(rig.sky.zenith),
            reach: traced.reach,
            horizon: shining(rig.sky.horizon),
            // Surfaces at any distance hide the sky.
            sky_reach: 1e30,
            ground: shining(rig.sky.ground),
            bounces: traced.bounces,
            sample: 0,
            unused: [0; 3],
        };
        Self { paths, settings, pixels, blocks, path_settings, film, squares, counts, group }
    }

    /// Draws so many samples of each pixel from scratch; milliseconds from the first submit to the end of the last.
    pub fn draw_ms(&self, samples: u32) -> f64 {
        let gpu = &self.paths.gpu;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for buffer in [&self.film, &self.squares].into_iter().chain(&self.counts) {
            encoder.clear_buffer(buffer, 0, None);
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.wait();
        let start = Instant::now();
        for sample in 0..samples {
            let settings = PathSettings { sample, ..self.settings };
            gpu.queue.write_buffer(&self.path_settings, 0, bytemuck::bytes_of(&settings));
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&self.paths.pipeline);
            pass.set_bind_group(0, &self.group, &[]);
            pass.dispatch_workgroups(self.blocks[0], self.blocks[1], 1);
            drop(pass);
            gpu.queue.submit([encoder.finish()]);
        }
        gpu.wait();
        start.elapsed().as_secs_f64() * 1e3
    }

    /// The radiance and the variance of the last samples, at least two of each pixel.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn outcome(&self) -> Result<Outcome, Failure> {
        let gpu = &self.paths.gpu;
        let film: Vec<[f32; 4]> =
            bytemuck::pod_collect_to_vec(&Readback::buffer(gpu, &self.film).wait(gpu)?);
        let squares: Vec<f32> =
            bytemuck::pod_collect_to_vec(&Readback::buffer(gpu, &self.squares).wait(gpu)?);
        debug_assert_eq!(film.len(), self.pixels, "a film entry per thread");
        let (mut radiance, mut variance, mut pixels) = (0.0, 0.0, 0.0);
        for ([r, g, b, samples], squares) in film.into_iter().zip(squares) {
            let count = f64::from(samples);
            if count < 2.0 {
                continue;
            }
            let mean = luminance(DVec3::new(r.into(), g.into(), b.into())) / count;
            radiance += mean;
            variance += (f64::from(squares) - count * mean * mean).max(0.0) / (count - 1.0);
            pixels += 1.0;
        }
        Ok(Outcome { radiance: radiance / pixels, variance: variance / pixels })
    }

    /// Counts of the last samples.
    ///
    /// # Errors
    /// If the device is lost, or the pipeline does not count.
    pub fn counts(&self) -> Result<Counts, Failure> {
        let counts = self.counts.as_ref().ok_or("the pipeline does not count")?;
        Ok(Counts::read(&self.paths.gpu, counts)?)
    }
}
