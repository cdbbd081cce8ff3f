//! Distance estimates, safe steps, gradients and colour data at given points, by the program's own
//! formula files.

use std::{
    collections::HashMap,
    sync::{Arc, LazyLock, Mutex, OnceLock},
};

use glam::{DVec3, Vec3};
use mandelight::{
    gpu::{
        Gpu,
        readback::{Readback, ReadbackError},
        shader::{File, Module},
    },
    render::{
        Eyes, Region,
        pass::MODULES,
        pipelines::{Depth, PipelineKey},
        space::RenderSpace,
        uniforms::{ANCHOR_ORBIT_BYTES, Inputs},
    },
    scene::Scene,
};

use crate::device::gpu;

/// What the formula consists of, below `shaders/`.
const FORMULA: [&str; 6] = [
    "types/frame_uniforms.wgsl",
    "lib/numeric.wgsl",
    "lib/complex.wgsl",
    "formula/deep.wgsl",
    "formula/rotating_frame.wgsl",
    "formula/mandelbulb.wgsl",
];

/// The probe's shader; `POWER`, `DEEP` and `ROTATING_FRAME` specialise it.
pub static MODULE: LazyLock<Module> = LazyLock::new(|| {
    with_formula("probe", File { path: "pass/probe.wgsl", text: include_str!("probe.wgsl") })
});

/// A module of the program's formula and an entry point. Its list of files is leaked.
pub fn with_formula(label: &'static str, entry: File) -> Module {
    let of = |path: &&str| {
        let mut files = MODULES.iter().flat_map(|module| module.files);
        *files.find(|file| file.path == *path).unwrap_or_else(|| panic!("no module has {path}"))
    };
    let files: Vec<_> = FORMULA.iter().map(of).chain([entry]).collect();
    Module { label, files: files.leak() }
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
    /// Least distance of the orbit from the origin, after its start; at most 2.
    pub origin_trap: f32,
    /// The same from the z axis.
    pub axis_trap: f32,
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
    let inputs = Inputs::about(scene, REGION, &RenderSpace::plain());
    let power = if specialised { PipelineKey::of(&inputs.frame).power } else { 0 };
    ask_form(&inputs, points, PipelineKey { power, depth: Depth::Plain })
}

/// The same about points that are given by their offsets from the anchor of `space`, in its units,
/// as the answers are.
pub fn ask_about(
    scene: &Scene,
    space: &RenderSpace,
    offsets: &[DVec3],
) -> Result<Vec<Answer>, ReadbackError> {
    let inputs = Inputs::about(scene, REGION, space);
    ask_form(&inputs, offsets, PipelineKey::of(&inputs.frame))
}

/// Of the kernel's answer to one point.
const ANSWER_BYTES: usize = 48;

/// Any will do.
const REGION: Region =
    Region { picture_px: [64; 2], origin_px: [0; 2], size_px: [64; 2], eyes: Eyes::Camera };

fn ask_form(
    inputs: &Inputs,
    points: &[DVec3],
    key: PipelineKey,
) -> Result<Vec<Answer>, ReadbackError> {
    let (gpu, pipeline) = (gpu(), pipeline(key));
    let questions: Vec<[f32; 4]> =
        points.iter().map(|p| p.as_vec3().extend(0.0).to_array()).collect();
    let [picture, anchor_orbit] = bindings(gpu, inputs);
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
        pass.set_bind_group(0, &group(0, &[&picture, &anchor_orbit]), &[]);
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
            let [x, y, z, distance, smooth_iterations, origin_trap, axis_trap, step, quick, ..] =
                numbers;
            let gradient = Vec3::new(x, y, z);
            let quick_distance = (quick >= 0.0).then_some(quick);
            Answer {
                gradient,
                distance,
                smooth_iterations,
                origin_trap,
                axis_trap,
                step,
                quick_distance,
            }
        })
        .collect())
}

/// The probe's pipeline for `key` on the shared device, compiled once.
fn pipeline(key: PipelineKey) -> wgpu::ComputePipeline {
    type Made = HashMap<PipelineKey, Arc<OnceLock<wgpu::ComputePipeline>>>;
    static MADE: LazyLock<Mutex<Made>> = LazyLock::new(Mutex::default);
    // Others that compile another key need not wait.
    let one = MADE.lock().expect("the list").entry(key).or_default().clone();
    let make = || {
        let device = &gpu().device;
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(MODULE.label),
            layout: None,
            module: &MODULE.create(device),
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &key.constants(),
                ..Default::default()
            },
            cache: None,
        })
    };
    one.get_or_init(make).clone()
}

/// What kernels know of a picture: the first two bindings of group 0.
pub fn bindings(gpu: &Gpu, inputs: &Inputs) -> [wgpu::Buffer; 2] {
    let mut anchor_orbit = inputs.anchor_orbit();
    anchor_orbit.resize(ANCHOR_ORBIT_BYTES as usize, 0);
    [
        filled(gpu, wgpu::BufferUsages::STORAGE, bytemuck::bytes_of(&inputs.frame)),
        filled(gpu, wgpu::BufferUsages::UNIFORM, &anchor_orbit),
    ]
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
