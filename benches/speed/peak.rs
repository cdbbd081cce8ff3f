//! The adapter's measured multiply-add throughput, and the operations of an orbit step.
//!
//! In: an adapter. Out: GFLOP/s.

use std::time::Instant;

use mandelight::gpu::Gpu;

/// Iterations of the loop, and workgroups of 64 threads.
const ITERATIONS: u32 = 4096;
const WORKGROUPS: u32 = 512;
/// Eight chains of `vec4f`, each one multiplication and one addition.
const FLOP_PER_ITERATION: f64 = 8.0 * 4.0 * 2.0;

const TEXT: &str = "
@group(0) @binding(0) var<storage, read_write> data: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    // Eight independent chains hide the latency of an addition.
    let m = data[0];
    let c = data[1];
    let x = vec4f(f32(id.x));
    var a = x; var b = x + 1.0; var d = x + 2.0; var e = x + 3.0;
    var f = x + 4.0; var g = x + 5.0; var h = x + 6.0; var k = x + 7.0;
    for (var i = 0u; i < ITERATIONS; i++) {
        a = fma(a, m, c); b = fma(b, m, c); d = fma(d, m, c); e = fma(e, m, c);
        f = fma(f, m, c); g = fma(g, m, c); h = fma(h, m, c); k = fma(k, m, c);
    }
    let sum = a + b + d + e + f + g + h + k;
    // Never true, but the compiler can't know, so it keeps the loop.
    if (sum.x == 12345.678) { data[2] = sum; }
}
";

/// A kernel of multiply-adds.
pub struct Peak {
    gpu: Gpu,
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
}

impl Peak {
    /// Compiles the kernel and runs it once.
    pub fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("peak"),
            source: wgpu::ShaderSource::Wgsl(
                TEXT.replace("ITERATIONS", &format!("{ITERATIONS}u")).into(),
            ),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("peak"),
            layout: None,
            module: &module,
            entry_point: Some("main"),
            compilation_options: Default::default(),
            cache: None,
        });
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("peak"),
            size: 48,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let values = [[0.999_f32; 4], [0.001; 4], [0.0; 4]];
        gpu.queue.write_buffer(&buffer, 0, bytemuck::cast_slice(&values));
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("peak"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
        });
        let peak = Self { gpu: gpu.clone(), pipeline, group };
        peak.gflops();
        peak
    }

    /// Measured throughput, GFLOP/s: a multiply-add counts as two operations.
    pub fn gflops(&self) -> f64 {
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.dispatch_workgroups(WORKGROUPS, 1, 1);
        drop(pass);
        let start = Instant::now();
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.wait();
        let flop = FLOP_PER_ITERATION * f64::from(ITERATIONS) * f64::from(WORKGROUPS * 64);
        flop / start.elapsed().as_secs_f64() / 1e9
    }
}

/// Floating-point operations that one orbit step of a whole power n needs.
///
/// Two complex powers at 6 operations a product, ρ and r (8), the rotor (2), three products and
/// three sums of z, and dr = n rⁿ⁻¹ dr + 1 (3, and one for each product of rⁿ⁻¹). A root counts
/// as one operation.
pub fn flop_per_step(power: u32) -> f64 {
    let products = f64::from(power.ilog2() + power.count_ones() - 1);
    let of_r = f64::from((power - 1).max(1).ilog2() + (power - 1).count_ones() - 1);
    12.0 * products + of_r + 19.0
}
