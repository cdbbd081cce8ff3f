//! Distance estimates, safe steps, gradients and colour data at given points, by the program's own
//! formula files.

use std::{
    collections::HashMap,
    sync::{Arc, LazyLock, Mutex, OnceLock},
};

use glam::{DVec3, Vec3};
use mandelight::{
    formula::{Kernel, contract::MAX_TABLE_BYTES},
    fractal::FractalModel,
    gpu::{
        Gpu,
        readback::{Readback, ReadbackError},
        shader::Module,
    },
    render::{Eyes, Region, shaders, space::RenderSpace, uniforms::Inputs},
    scene::{ColorSource, Coloring, Scene},
};

use crate::device::gpu;

/// The probe's shader for `kernel`.
pub fn module(kernel: Kernel) -> Module {
    shaders::joined("probe", Some(kernel), include_str!("probe.wgsl"))
}

/// What the kernels say of one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// The estimate's gradient, of any length; 0 inside.
    pub gradient: Vec3,
    /// Distance estimate, in the unit of the points.
    pub distance: f32,
    /// Smooth iteration count.
    pub smooth_iterations: f32,
    /// Least distances of the orbit, after its start, from the traps of the scene's layers; at most 2.
    pub traps: [f32; 2],
    /// The formula's colour channel.
    pub channel: f32,
    /// How far a ray may go, in the same.
    pub step: f32,
    /// Distance estimate as rays ask for it first; none where that way cannot tell.
    pub quick_distance: Option<f32>,
}

/// Asks the formula's kernel about `points` of the scene's set and waits, on the tests' shared device.
/// `specialised` chooses the pipeline of the set's whole power instead of the general one.
pub fn ask(
    scene: &Scene,
    points: &[DVec3],
    specialised: bool,
) -> Result<Vec<Answer>, ReadbackError> {
    let space = RenderSpace::plain(&FractalModel::new(&scene.fractal));
    let inputs = Inputs::about(scene, REGION, &space);
    let kernel = inputs.formula.kernel;
    let general = kernel.general().filter(|_| !specialised);
    ask_kernel(&inputs, points, general.unwrap_or(kernel))
}

/// The same about points that are given by their offsets from the anchor of `space`, in its units,
/// as the answers are.
pub fn ask_about(
    scene: &Scene,
    space: &RenderSpace,
    offsets: &[DVec3],
) -> Result<Vec<Answer>, ReadbackError> {
    let inputs = Inputs::about(scene, REGION, space);
    ask_kernel(&inputs, offsets, inputs.formula.kernel)
}

/// `scene` with layers of colours by traps at the origin and along the z axis.
pub fn with_traps(mut scene: Scene) -> Scene {
    let by = |source| Coloring { source, ..Coloring::default() };
    scene.surface.coloring = by(ColorSource::PointTrap);
    scene.surface.second_layer.coloring = by(ColorSource::AxisTrap);
    scene.surface.second_layer.amount = 1.0;
    scene
}

/// Of the kernel's answer to one point.
const ANSWER_BYTES: usize = 48;

/// Any will do.
const REGION: Region =
    Region { picture_px: [64; 2], origin_px: [0; 2], size_px: [64; 2], eyes: Eyes::Camera };

fn ask_kernel(
    inputs: &Inputs,
    points: &[DVec3],
    kernel: Kernel,
) -> Result<Vec<Answer>, ReadbackError> {
    let (gpu, pipeline) = (gpu(), pipeline(kernel));
    let questions: Vec<[f32; 4]> =
        points.iter().map(|p| p.as_vec3().extend(0.0).to_array()).collect();
    let bindings = bindings(gpu, inputs);
    let questions = filled(gpu, wgpu::BufferUsages::STORAGE, bytemuck::cast_slice(&questions));
    let answers = filled(
        gpu,
        wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        &vec![0; ANSWER_BYTES * points.len()],
    );
    let group = |index, buffers: &[&wgpu::Buffer]| bind_group(gpu, &pipeline, index, buffers);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group(0, &bindings.iter().collect::<Vec<_>>()), &[]);
        pass.set_bind_group(1, &group(1, &[&questions, &answers]), &[]);
        pass.dispatch_workgroups((points.len() as u32).div_ceil(64), 1, 1);
    }
    gpu.queue.submit([encoder.finish()]);
    let bytes = Readback::buffer(gpu, &answers).wait(gpu)?;
    Ok(bytes
        .as_chunks::<ANSWER_BYTES>()
        .0
        .iter()
        .map(|chunk| {
            let numbers: [f32; ANSWER_BYTES / 4] = bytemuck::cast(*chunk);
            let [x, y, z, distance, smooth_iterations, first, second, step, quick, channel, ..] =
                numbers;
            let gradient = Vec3::new(x, y, z);
            let quick_distance = (quick >= 0.0).then_some(quick);
            Answer {
                gradient,
                distance,
                smooth_iterations,
                traps: [first, second],
                channel,
                step,
                quick_distance,
            }
        })
        .collect())
}

/// The probe's pipeline for `kernel` on the shared device, compiled once.
fn pipeline(kernel: Kernel) -> wgpu::ComputePipeline {
    type Made = HashMap<Kernel, Arc<OnceLock<wgpu::ComputePipeline>>>;
    static MADE: LazyLock<Mutex<Made>> = LazyLock::new(Mutex::default);
    // Others that compile another kernel need not wait.
    let one = MADE.lock().expect("the list").entry(kernel).or_default().clone();
    let make = || {
        let device = &gpu().device;
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("probe"),
            layout: None,
            module: &module(kernel).create(device),
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &kernel.overrides(),
                ..Default::default()
            },
            cache: None,
        })
    };
    one.get_or_init(make).clone()
}

/// The first bindings of group 0 that a kernel uses: frame uniforms, and the formula's table where the
/// formula has one.
pub fn bindings(gpu: &Gpu, inputs: &Inputs) -> Vec<wgpu::Buffer> {
    let mut buffers = vec![filled(gpu, wgpu::BufferUsages::STORAGE, &inputs.frame_bytes())];
    if !inputs.formula.table.is_empty() {
        let mut table = inputs.formula.table.to_vec();
        table.resize(MAX_TABLE_BYTES, 0);
        buffers.push(filled(gpu, wgpu::BufferUsages::UNIFORM, &table));
    }
    buffers
}

/// Group `index` of `pipeline`, whose bindings are whole buffers in their order.
pub fn bind_group(
    gpu: &Gpu,
    pipeline: &wgpu::ComputePipeline,
    index: u32,
    buffers: &[&wgpu::Buffer],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(buffers)
        .map(|(binding, buffer)| wgpu::BindGroupEntry {
            binding,
            resource: buffer.as_entire_binding(),
        })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(index),
        entries: &entries,
    })
}

/// A buffer of `usage` with `bytes` in it.
pub fn filled(gpu: &Gpu, usage: wgpu::BufferUsages, bytes: &[u8]) -> wgpu::Buffer {
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: bytes.len() as u64,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    gpu.queue.write_buffer(&buffer, 0, bytes);
    buffer
}
