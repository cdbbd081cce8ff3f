//! A compute kernel around a formula's own, that is run and timed.

use std::time::Instant;

use mandelight::{formula, gpu::Gpu};
use mandelight_test_support::probe;

use super::statistics::median;

/// The pipeline of the entry point `main`, with the overrides of `kernel`.
pub fn pipeline(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    kernel: &formula::Kernel,
) -> wgpu::ComputePipeline {
    gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("timed"),
        layout: None,
        module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions {
            constants: &kernel.overrides(),
            ..Default::default()
        },
        cache: None,
    })
}

/// A kernel with what it reads and writes.
pub struct TimedKernel {
    gpu: Gpu,
    pipeline: wgpu::ComputePipeline,
    groups: Vec<wgpu::BindGroup>,
    workgroups: u32,
}

impl TimedKernel {
    /// Runs `pipeline` with so many workgroups of 64 threads; `buffers`: those of each group, by binding.
    ///
    /// A further buffer takes a number of each thread, at binding 0 of group 1; those given for group 1 follow it.
    pub fn new(
        gpu: &Gpu,
        pipeline: wgpu::ComputePipeline,
        workgroups: u32,
        buffers: [&[wgpu::Buffer]; 2],
    ) -> Self {
        let sums = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("sums"),
            size: u64::from(4 * 64 * workgroups),
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        });
        let frame: Vec<_> = buffers[0].iter().collect();
        let given: Vec<_> = [&sums].into_iter().chain(buffers[1]).collect();
        let groups = vec![
            probe::bind_group(gpu, &pipeline, 0, &frame),
            probe::bind_group(gpu, &pipeline, 1, &given),
        ];
        Self { gpu: gpu.clone(), pipeline, groups, workgroups }
    }

    /// Adds a group of one buffer.
    pub fn push_group(&mut self, buffer: &wgpu::Buffer) {
        let index = self.groups.len() as u32;
        self.groups.push(probe::bind_group(&self.gpu, &self.pipeline, index, &[buffer]));
    }

    /// Runs the kernel once and returns the time that it takes, in seconds.
    pub fn run_secs(&self) -> f64 {
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipeline);
        for (index, group) in (0..).zip(&self.groups) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.dispatch_workgroups(self.workgroups, 1, 1);
        drop(pass);
        let start = Instant::now();
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.wait();
        start.elapsed().as_secs_f64()
    }
}

/// Median times, in seconds, of kernels that run in turn, after a round that warms up.
pub fn median_secs(kernels: &[TimedKernel], rounds: u32) -> Vec<f64> {
    let mut all = vec![Vec::new(); kernels.len()];
    for round in 0..=rounds {
        for (kernel, times) in kernels.iter().zip(&mut all) {
            let secs = kernel.run_secs();
            if round > 0 {
                times.push(secs);
            }
        }
    }
    all.iter().map(|times| median(times)).collect()
}
