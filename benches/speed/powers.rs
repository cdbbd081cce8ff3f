//! What an orbit step costs for each whole power, specialised and by the general kernel.
//!
//! Every thread of a kernel made of the program's own formula follows orbits that never escape, so
//! that none waits for another. A counting copy says how many steps those are.

use std::time::Instant;

use mandelight::{
    formula::{
        self, FormulaRef,
        mandelbulb::{
            MANDELBULB, Mandelbulb,
            variant::{Steps, Variant},
        },
    },
    gpu::{Gpu, readback::ReadbackError},
    render::{Region, shaders, uniforms::Inputs},
    scene::Scene,
};
use mandelight_test_support::probe;
use serde::Serialize;

use super::{
    counts::{self, Counts},
    failure::Failure,
    statistics::median,
};

/// What `--views` calls the table.
pub const NAME: &str = "powers";
/// The powers that have kernels of their own.
const POWERS: std::ops::RangeInclusive<u32> = 2..=16;
/// Steps of an orbit.
const ITERATIONS: u32 = 100;
/// Threads: each follows 32 orbits.
const WORKGROUPS: u32 = 128;
/// How far a cost may be from the fit, as a factor.
const WITHIN: f64 = 1.3;

/// Near the origin every power's orbits stay.
const TEXT: &str = "// uses: formula, types/frame_uniforms

@group(1) @binding(0) var<storage, read_write> sums: array<f32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let fractal = frame_uniforms.formula.fractal;
    var sum = 0.0;
    for (var k = 0u; k < 32u; k++) {
        let part = f32(id.x * 32u + k) * 1e-7;
        let point = vec3f(0.2 + part, 0.15 - part, 0.1);
        sum += distance_estimate(fractal, point);
    }
    sums[id.x] = sum;
}
";

/// One power.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The power.
    pub power: u32,
    /// Products of a complex power by squaring.
    pub products: u32,
    /// A step of the power's own kernel, over all threads, nanoseconds.
    pub special_ns: f64,
    /// A step of the general kernel.
    pub general_ns: f64,
    /// What the fit says of the first.
    pub fitted_ns: f64,
}

/// All of them.
#[derive(Clone, Debug, Serialize)]
pub struct Table {
    /// One a power.
    pub rows: Vec<Row>,
    /// The fit's fixed part, nanoseconds.
    pub fixed_ns: f64,
    /// What it adds for each product.
    pub product_ns: f64,
    /// The worst cost over its fit, or under it, as a factor of at least 1.
    pub worst: f64,
}

/// Measures them in turn, so many rounds.
///
/// # Errors
/// Where the device is lost, or the formula can't be counted.
pub fn measure(gpu: &Gpu, rounds: u32) -> Result<Table, Failure> {
    let module = shaders::joined("orbits", Some(kernel(0)), TEXT);
    let shader = module.create(&gpu.device);
    let general = pipeline(gpu, &shader, 0);
    let pipelines: Vec<_> = POWERS
        .flat_map(|power| [(power, pipeline(gpu, &shader, power)), (power, general.clone())])
        .map(|(power, pipeline)| Kernel::new(gpu, pipeline, power))
        .collect();
    let counting =
        counts::counting(gpu, &module, &counts::marks("mandelbulb/", &["estimate"], [2, 0]))?;
    let mut steps = Vec::new();
    for power in POWERS {
        let found = Kernel::new(gpu, pipeline(gpu, &counting, power), power).count()?.steps;
        steps.extend([found, found]);
    }
    let mut times = vec![Vec::new(); pipelines.len()];
    for round in 0..=rounds {
        for (kernel, times) in pipelines.iter().zip(&mut times) {
            let secs = kernel.run_secs();
            // The first round warms up.
            if round > 0 {
                times.push(secs);
            }
        }
    }
    let ns: Vec<_> = times.iter().zip(steps).map(|(t, steps)| median(t) * 1e9 / steps).collect();
    Ok(table(POWERS.zip(ns.as_chunks::<2>().0.iter().copied())))
}

/// Fits a fixed part and one for each product, by least squares of the relative deviation.
pub fn table(costs: impl Iterator<Item = (u32, [f64; 2])>) -> Table {
    let mut rows: Vec<_> = costs
        .map(|(power, [special_ns, general_ns])| Row {
            power,
            products: power.ilog2() + power.count_ones() - 1,
            special_ns,
            general_ns,
            fitted_ns: 0.0,
        })
        .collect();
    // Weighted by 1/cost²: sums of 1, k, k², y, ky.
    let sum = |f: fn(f64, f64) -> f64| -> f64 {
        let parts =
            rows.iter().map(|row| f(row.products.into(), row.special_ns) / row.special_ns.powi(2));
        parts.sum()
    };
    let (n, k, kk) = (sum(|_, _| 1.0), sum(|k, _| k), sum(|k, _| k * k));
    let (y, ky) = (sum(|_, y| y), sum(|k, y| k * y));
    let product_ns = (n * ky - k * y) / (n * kk - k * k);
    let fixed_ns = (y - product_ns * k) / n;
    let mut worst = 1.0_f64;
    for row in &mut rows {
        row.fitted_ns = fixed_ns + product_ns * f64::from(row.products);
        let off = row.special_ns / row.fitted_ns;
        worst = worst.max(off).max(1.0 / off);
    }
    Table { rows, fixed_ns, product_ns, worst }
}

/// The pipeline of a whole power, or the general one for 0.
fn pipeline(gpu: &Gpu, module: &wgpu::ShaderModule, power: u32) -> wgpu::ComputePipeline {
    gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("orbits"),
        layout: None,
        module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions {
            constants: &kernel(power).overrides(),
            ..Default::default()
        },
        cache: None,
    })
}

/// The formula's plain kernel of a whole power, or the general one for 0.
fn kernel(power: u32) -> formula::Kernel {
    let variant = Variant { power, steps: Steps::Plain }.number();
    formula::Kernel { formula: FormulaRef(&MANDELBULB), variant }
}

struct Kernel {
    gpu: Gpu,
    pipeline: wgpu::ComputePipeline,
    groups: Vec<wgpu::BindGroup>,
    counts: wgpu::Buffer,
}

impl Kernel {
    /// The kernel that follows orbits of `power`.
    fn new(gpu: &Gpu, pipeline: wgpu::ComputePipeline, power: u32) -> Self {
        let fractal =
            Mandelbulb { power: power.into(), iterations: ITERATIONS, ..Default::default() }.into();
        let scene = Scene { fractal, ..Scene::default() };
        let inputs = Inputs::new(&scene, Region::whole([64, 64]));
        let buffer = |size: usize| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("orbits"),
                size: size as u64,
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::COPY_DST
                    | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        };
        let [sums, counts] = [4 * 64 * WORKGROUPS as usize, 8].map(buffer);
        let bindings = probe::bindings(gpu, &inputs);
        let group =
            |index, buffers: &[&wgpu::Buffer]| probe::bind_group(gpu, &pipeline, index, buffers);
        let groups = vec![group(0, &bindings.iter().collect::<Vec<_>>()), group(1, &[&sums])];
        Self { gpu: gpu.clone(), pipeline, groups, counts }
    }

    fn run_secs(&self) -> f64 {
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipeline);
        for (index, group) in (0..).zip(&self.groups) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.dispatch_workgroups(WORKGROUPS, 1, 1);
        drop(pass);
        let start = Instant::now();
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.wait();
        start.elapsed().as_secs_f64()
    }

    /// What a counting kernel counts.
    fn count(mut self) -> Result<Counts, ReadbackError> {
        self.groups.push(probe::bind_group(&self.gpu, &self.pipeline, 2, &[&self.counts]));
        self.run_secs();
        Counts::read(&self.gpu, &self.counts)
    }
}

impl Table {
    /// True where every power's cost is a fixed part and one for each product.
    pub fn is_good(&self) -> bool {
        self.worst <= WITHIN
    }

    /// Prints the results.
    pub fn print(&self) {
        println!("\npowers: an orbit step of each power, over all threads");
        println!("  power  products  own kernel ns  fit ns  general kernel ns");
        for Row { power, products, special_ns, general_ns, fitted_ns } in &self.rows {
            println!(
                "  {power:>5}  {products:>8}  {special_ns:>13.3}  {fitted_ns:>6.3}  {general_ns:>17.3}"
            );
        }
        println!(
            "  {:.3} ns and {:.3} ns a product; worst {:.2} times off{}",
            self.fixed_ns,
            self.product_ns,
            self.worst,
            if self.is_good() { "" } else { ": FAIL" }
        );
    }
}
