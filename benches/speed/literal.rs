//! The thesis's own algorithm on the GPU: `literal.wgsl` and its driver.
//!
//! In: the program's inputs of a scene, and a [`Tuning`]. Out: times, samples and counts. The
//! literal kernel shares no shader with the program. Its time excludes tone mapping.

use bytemuck::{Pod, Zeroable};
use mandelight::{
    formula::mandelbulb,
    gpu::{
        Gpu,
        host_shared::HostShared,
        readback::{Readback, ReadbackError},
    },
    render::{
        lattice,
        uniforms::{GRADIENT_ENTRIES, Inputs},
    },
};
use std::time::Instant;

use super::{counts::Counts, failure::Failure, instrument};

/// The kernel.
pub const TEXT: &str = include_str!("literal.wgsl");

/// llvmpipe ends an invocation after 65,535 iterations of all its loops together.
pub const MAX_LOOP_ITERATIONS: u32 = 60_000;

/// The settings of the literal kernel for one view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuning {
    /// Hit distance, scene units.
    pub epsilon: f64,
    /// Iteration limit of an orbit.
    pub iterations: u32,
    /// Step limit of a ray.
    pub steps: u32,
}

/// Host twin of `Settings` in `literal.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Settings {
    eye: [f32; 3],
    half_height: f32,
    right: [f32; 3],
    aspect: f32,
    up: [f32; 3],
    epsilon: f32,
    forward: [f32; 3],
    power: f32,
    constant: [f32; 3],
    bailout: f32,
    /// Width and height of the picture.
    pub size_px: [u32; 2],
    stride: u32,
    julia: u32,
    max_iterations: u32,
    max_steps: u32,
    bounding_radius: f32,
    first_light: u32,
    jitter: [f32; 2],
    end_light: u32,
    light_count: u32,
    color_source: u32,
    color_repeats: f32,
    color_offset: f32,
    ambient: f32,
    diffuse: f32,
    specular: f32,
    shininess: f32,
    log_bailout: f32,
    background_top: [f32; 4],
    background_bottom: [f32; 4],
}

impl Settings {
    /// The settings of a view.
    pub fn new(inputs: &Inputs, tuning: Tuning, stride: u32) -> Self {
        let picture = &inputs.frame;
        let (camera, march) = (&picture.camera, &picture.march);
        let fractal = mandelbulb::uniforms::Fractal::read(&inputs.formula.uniforms);
        let (surface, layer) = (&picture.surface, &picture.first_layer);
        let background = &picture.background;
        Self {
            eye: camera.origin,
            half_height: camera.half_height,
            right: camera.right,
            aspect: camera.aspect,
            up: camera.up,
            epsilon: tuning.epsilon as f32,
            forward: camera.forward,
            power: fractal.power,
            constant: fractal.julia_constant,
            bailout: fractal.bailout,
            size_px: picture.picture_px,
            stride,
            julia: fractal.julia,
            max_iterations: tuning.iterations,
            max_steps: tuning.steps,
            bounding_radius: march.bounding_radius,
            first_light: 0,
            jitter: [0.5; 2],
            end_light: 0,
            light_count: surface.light_count,
            // The kernel has the traps at the origin, the z axis and z = 0, after the iterations.
            color_source: layer.source.saturating_sub(4),
            color_repeats: layer.repeats,
            color_offset: layer.offset,
            ambient: surface.ambient,
            diffuse: surface.diffuse,
            specular: surface.specular,
            shininess: surface.shininess,
            log_bailout: fractal.bailout.ln(),
            background_top: background.top,
            background_bottom: background.bottom,
        }
    }
}

/// Host twin of `Light` in `literal.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Light {
    direction: [f32; 3],
    casts_shadows: u32,
    color: [f32; 3],
    unused: u32,
}

/// Host twin of `Point` in `literal.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Point {
    normal: [f32; 3],
    depth: f32,
    colors: [f32; 4],
}

/// The literal kernel's result for one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiteralPixel {
    /// Pixel coordinates from the upper left.
    pub pixel: [u32; 2],
    /// Depth of the newest sample along its ray; 0 for a miss.
    pub depth: f32,
    /// Unit normal of the newest sample.
    pub normal: glam::Vec3,
    /// Bit k is set if light k reaches the point.
    pub visibility: u64,
    /// Mean radiance of all samples, linear Rec. 709.
    pub radiance: [f32; 3],
}

/// The literal kernel's pipelines.
pub struct Literal {
    gpu: Gpu,
    layout: wgpu::BindGroupLayout,
    primary: wgpu::ComputePipeline,
    shadow: wgpu::ComputePipeline,
    shade: wgpu::ComputePipeline,
}

impl Literal {
    /// Compiles the pipelines.
    pub fn new(gpu: &Gpu) -> Self {
        Self::from_text(gpu, TEXT.into())
    }

    /// Compiles pipelines that count.
    ///
    /// # Errors
    /// If a marked function or an orbit loop isn't in the text.
    pub fn counting(gpu: &Gpu) -> Result<Self, String> {
        let marks = instrument::Marks {
            orbits_in: "literal",
            other_loops: &["march", "six_sample_normal", "is_lit", "shadow", "shade"],
            steps: &[],
            estimates: &["distance_to_set"],
            entries: &["primary", "shadow"],
            // The film's binding, which these entry points don't use.
            counters: instrument::Counters::Buffer([0, 5]),
        };
        instrument::counting(&[("literal.wgsl", TEXT)], &marks)
            .map(|text| Self::from_text(gpu, text))
    }

    fn from_text(gpu: &Gpu, text: String) -> Self {
        let device = &gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("literal"),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        });
        let entries: Vec<_> = (0..6)
            .map(|binding| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage { read_only: binding < 3 },
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            })
            .collect();
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("literal"),
            entries: &entries,
        });
        let pipelines = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("literal"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let made = |entry| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry),
                layout: Some(&pipelines),
                module: &module,
                entry_point: Some(entry),
                compilation_options: Default::default(),
                cache: None,
            })
        };
        let [primary, shadow, shade] = ["primary", "shadow", "shade"].map(made);
        Self { gpu: gpu.clone(), layout, primary, shadow, shade }
    }
}

/// One view, ready to be drawn repeatedly by the literal kernel.
pub struct Picture<'a> {
    literal: &'a Literal,
    settings: Settings,
    samples: u32,
    blocks: [u32; 2],
    buffers: [wgpu::Buffer; 6],
    group: wgpu::BindGroup,
}

impl<'a> Picture<'a> {
    /// Allocates the view's buffers; draws one of `stride` blocks of 8x8 pixels along each axis.
    pub fn new(
        literal: &'a Literal,
        inputs: &Inputs,
        samples: u32,
        tuning: Tuning,
        stride: u32,
    ) -> Self {
        let device = &literal.gpu.device;
        let settings = Settings::new(inputs, tuning, stride);
        let blocks = settings.size_px.map(|side| side.div_ceil(8).div_ceil(stride));
        let pixels = 64 * u64::from(blocks[0]) * u64::from(blocks[1]);
        let buffer = |label, size| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::COPY_DST
                    | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        };
        let count = settings.light_count as usize;
        let lights: Vec<_> = inputs.lights[..count.max(1)]
            .iter()
            .map(|light| Light {
                direction: light.vector,
                casts_shadows: light.casts_shadows,
                color: light.color,
                unused: 0,
            })
            .collect();
        let buffers = [
            buffer("literal settings", size_of::<Settings>() as u64),
            buffer("literal lights", size_of_val(lights.as_slice()) as u64),
            buffer("literal gradient", 16 * GRADIENT_ENTRIES as u64),
            buffer("literal points", size_of::<Point>() as u64 * pixels),
            buffer("literal visibility", 4 * pixels),
            buffer("literal film", 16 * pixels),
        ];
        literal.gpu.queue.write_buffer(&buffers[1], 0, bytemuck::cast_slice(&lights));
        literal.gpu.queue.write_buffer(&buffers[2], 0, bytemuck::cast_slice(&inputs.gradients[0]));
        let entries: Vec<_> = (0..)
            .zip(&buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("literal"),
            layout: &literal.layout,
            entries: &entries,
        });
        Self { literal, settings, samples, blocks, buffers, group }
    }

    /// Draws every sample from scratch; milliseconds from the first submit to the end of the last.
    ///
    /// Where blocks are left out, the time is scaled up to all pixels.
    pub fn draw_ms(&self) -> f64 {
        let gpu = &self.literal.gpu;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.clear_buffer(&self.buffers[5], 0, None);
        gpu.queue.submit([encoder.finish()]);
        gpu.wait();
        let start = Instant::now();
        for sample in 0..self.samples {
            let mut settings = self.settings;
            settings.jitter = lattice::jitter(sample);
            self.trace(settings);
            self.dispatch(&self.literal.shade, settings);
        }
        gpu.wait();
        start.elapsed().as_secs_f64() * 1e3 / self.share()
    }

    /// Records camera rays, normals and shadow rays.
    fn trace(&self, mut settings: Settings) {
        self.dispatch(&self.literal.primary, settings);
        // As many lights per dispatch as the driver's cap on loops allows.
        let iterations_per_light = settings.max_steps * (settings.max_iterations + 1);
        let lights_per_dispatch = (MAX_LOOP_ITERATIONS / iterations_per_light).max(1);
        while settings.end_light < settings.light_count {
            settings.first_light = settings.end_light;
            settings.end_light =
                settings.light_count.min(settings.first_light + lights_per_dispatch);
            self.dispatch(&self.literal.shadow, settings);
        }
    }

    /// Counts one sample of each drawn pixel; needs the pipelines of [`Literal::counting`].
    ///
    /// # Errors
    /// If the device is lost.
    pub fn count(&self) -> Result<Counts, ReadbackError> {
        let gpu = &self.literal.gpu;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.clear_buffer(&self.buffers[5], 0, None);
        gpu.queue.submit([encoder.finish()]);
        self.trace(self.settings);
        gpu.wait();
        Counts::read(gpu, &self.buffers[5])
    }

    /// Fraction of the picture's pixels that are drawn.
    pub fn share(&self) -> f64 {
        let [width, height] = self.settings.size_px;
        self.pixels().count() as f64 / (f64::from(width) * f64::from(height))
    }

    fn dispatch(&self, pipeline: &wgpu::ComputePipeline, settings: Settings) {
        let gpu = &self.literal.gpu;
        gpu.queue.write_buffer(&self.buffers[0], 0, bytemuck::bytes_of(&settings));
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.dispatch_workgroups(self.blocks[0], self.blocks[1], 1);
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
    }

    /// The drawn pixels and their indices in the buffers, as `pixel_slot` computes them.
    fn pixels(&self) -> impl Iterator<Item = ([u32; 2], usize)> + '_ {
        let ([columns, rows], stride) = (self.blocks, self.settings.stride);
        let blocks = (0..rows).flat_map(move |row| (0..columns).map(move |column| [column, row]));
        let pixels = blocks.zip(0..).flat_map(move |([column, row], block)| {
            let corner = [column * stride + row * stride / 2 % stride, row * stride];
            (0..64_u32).map(move |local| {
                let pixel = [corner[0] * 8 + local % 8, corner[1] * 8 + local / 8];
                (pixel, block * 64 + local as usize)
            })
        });
        let [width, height] = self.settings.size_px;
        pixels.filter(move |([x, y], _)| *x < width && *y < height)
    }

    /// Reads back the last picture.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn seen(&self) -> Result<Vec<LiteralPixel>, ReadbackError> {
        let gpu = &self.literal.gpu;
        let read = |index: usize| Readback::buffer(gpu, &self.buffers[index]).wait(gpu);
        let (points, visibility, film) = (read(3)?, read(4)?, read(5)?);
        let points: Vec<Point> = bytemuck::pod_collect_to_vec(&points);
        let visibility: Vec<u32> = bytemuck::pod_collect_to_vec(&visibility);
        let film: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&film);
        Ok(self
            .pixels()
            .map(|(pixel, index)| {
                let ([r, g, b, samples], point) = (film[index], points[index]);
                LiteralPixel {
                    pixel,
                    depth: point.depth,
                    normal: point.normal.into(),
                    visibility: visibility[index].into(),
                    radiance: [r, g, b].map(|sum| sum / samples.max(1.0)),
                }
            })
            .collect())
    }
}

/// The literal kernel's counts of one sample of each pixel of a whole picture.
///
/// # Errors
/// If the device is lost, or the kernel can't be counted.
pub fn counts(gpu: &Gpu, inputs: &Inputs, tuning: Tuning) -> Result<Counts, Failure> {
    let counting = Literal::counting(gpu)?;
    Ok(Picture::new(&counting, inputs, 1, tuning, 1).count()?)
}
