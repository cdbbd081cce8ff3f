//! What an orbit step costs for each whole power, specialised and by the general kernel.
//!
//! Every thread of a kernel made of the program's own formula follows orbits that never escape, so
//! that none waits for another. A counting copy says how many steps those are.

use mandelight::{
    formula::{
        self, FormulaRef,
        mandelbulb::{
            MANDELBULB, Mandelbulb,
            variant::{Steps, Variant},
        },
    },
    gpu::Gpu,
    render::{Region, shaders, uniforms::Inputs},
    scene::Scene,
};
use mandelight_test_support::probe;
use serde::Serialize;

use super::{
    counts::{self, Counts},
    failure::Failure,
    instrument::Counters,
    timed_kernel::{TimedKernel, median_secs, pipeline},
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
    let timed = |shader: &wgpu::ShaderModule, power, kernel_of| {
        let pipeline = pipeline(gpu, shader, &kernel(kernel_of));
        TimedKernel::new(gpu, pipeline, WORKGROUPS, [&frame_buffers(gpu, power), &[]])
    };
    let kernels: Vec<_> =
        POWERS.flat_map(|power| [timed(&shader, power, power), timed(&shader, power, 0)]).collect();
    let counting = counts::counting(
        gpu,
        &module,
        &counts::marks("mandelbulb/", &["estimate"], Counters::Buffer([2, 0])),
    )?;
    let mut steps = Vec::new();
    for power in POWERS {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let counts = probe::filled(gpu, usage, &[0; 8]);
        let mut kernel = timed(&counting, power, power);
        kernel.push_group(&counts);
        kernel.run_secs();
        let found = Counts::read(gpu, &counts)?.steps;
        steps.extend([found, found]);
    }
    let secs = median_secs(&kernels, rounds);
    let ns: Vec<_> = secs.iter().zip(steps).map(|(secs, steps)| secs * 1e9 / steps).collect();
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

/// The formula's plain kernel of a whole power, or the general one for 0.
fn kernel(power: u32) -> formula::Kernel {
    let variant = Variant { power, steps: Steps::Plain }.number();
    formula::Kernel { formula: FormulaRef(&MANDELBULB), variant }
}

/// The frame of orbits of `power`.
fn frame_buffers(gpu: &Gpu, power: u32) -> Vec<wgpu::Buffer> {
    let fractal =
        Mandelbulb { power: power.into(), iterations: ITERATIONS, ..Default::default() }.into();
    let scene = Scene { fractal, ..Scene::default() };
    probe::bindings(gpu, &Inputs::new(&scene, Region::whole([64, 64])))
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
