//! What an orbit step of a formula's text costs, beside hand-written WGSL and beside the step without its derivative.
//!
//! All kernels of a row follow the same orbits in turn, so that their times compare.

use std::time::Instant;

use mandelight::{
    formula::{self, Fractal},
    gpu::Gpu,
    render::{Region, shaders, uniforms::Inputs},
    scene::Scene,
};
use mandelight_test_support::probe;
use serde::Serialize;

use super::{failure::Failure, statistics::median};

/// Threads: each follows 16 orbits.
const WORKGROUPS: u32 = 96;
/// Steps of the longest orbits.
const ITERATIONS: u32 = 100;
/// The hand-written formulas.
const WRITTEN: &str = include_str!("written.wgsl");
/// Those formulas, each with the parameters that `written.wgsl` reads, and the part of a unit that its points
/// are spread over.
const BESIDE: [(&str, &str, [[f32; 4]; 5], f32); 3] = [
    ("mandelbox", "mandelbox", [[2.0, 1.0, 0.5, 1.0], [1e4; 4], [0.0; 4], [0.0; 4], [0.0; 4]], 2.0),
    (
        "menger_sponge",
        "menger",
        [[3.0; 4], [1e4; 4], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]],
        0.9,
    ),
    (
        "quaternion_julia",
        "quaternion_julia",
        [[0.0; 4], [16.0; 4], [-0.125, -0.256, 0.847, 0.0895], [0.0; 4], [0.0; 4]],
        0.5,
    ),
];

/// One formula.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The formula's id.
    pub formula: &'static str,
    /// What the first time is compared with.
    pub beside: &'static str,
    /// Time of the estimate over that of the other kernel.
    pub estimate: f64,
    /// Time of the gradient over it; none beside hand-written kernels, which have none.
    pub gradient: Option<f64>,
}

/// A compute shader that adds up `call` at points of a small region.
fn text(call: &str, spread: f32) -> String {
    format!(
        "// uses: formula, types/frame_uniforms

@group(1) @binding(0) var<storage, read_write> sums: array<f32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {{
    // Every kernel reads the frame, so that all have the same bindings.
    if (frame_uniforms.size_px.x == 0u) {{ return; }}
    let fractal = frame_uniforms.formula.fractal;
    var sum = 0.0;
    for (var k = 0u; k < 16u; k++) {{
        let place = vec3f(vec3u(id.x * 16u + k) * vec3u(7919u, 104729u, 1299709u) % 65536u) / 65536.0;
        let point = {spread:?} * (2.0 * place - 1.0);
        sum += {call};
    }}
    sums[id.x] = sum;
}}
"
    )
}

/// The orbit alone, without derivatives.
const VALUES: &str = "
fn value_only(fractal: Fractal, point: vec3f) -> f32 {
    load_slots();
    let c = addend(fractal, point);
    var z = initial(point);
    for (var n = 0u; n < fractal.iterations && !is_escaped(fractal, z); n++) {
        z = next_with_channel(n, z, c, point, 1.0, fractal.addend_derivative).z;
    }
    return z.x;
}
";

struct Run {
    gpu: Gpu,
    pipeline: wgpu::ComputePipeline,
    groups: Vec<wgpu::BindGroup>,
}

impl Run {
    fn new(gpu: &Gpu, fractal: &Fractal, text: &str, given: Option<&[[f32; 4]; 5]>) -> Self {
        let scene = Scene { fractal: fractal.with_iterations(ITERATIONS), ..Scene::default() };
        let inputs = Inputs::new(&scene, Region::whole([64, 64]));
        // The texts of benchmarks last as long as the program.
        let text = Box::leak(text.to_owned().into_boxed_str());
        let module = shaders::joined("steps", Some(inputs.formula.kernel), text);
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("steps"),
            layout: None,
            module: &module.create(&gpu.device),
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &inputs.formula.kernel.overrides(),
                ..Default::default()
            },
            cache: None,
        });
        let sums = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("sums"),
            size: u64::from(4 * 64 * WORKGROUPS),
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        });
        let frame = probe::bindings(gpu, &inputs);
        let given = given.map(|given| {
            let bytes: Vec<u8> = given.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
            probe::filled(gpu, wgpu::BufferUsages::STORAGE, &bytes)
        });
        // A binding that a kernel does not read is in no layout: hand-written ones read no table.
        let files = inputs.formula.kernel.files().files;
        let reads_table = given.is_none() && files.iter().any(|f| f.text.contains("table.slots"));
        let frame: Vec<_> = frame.iter().take(if reads_table { 2 } else { 1 }).collect();
        let sums: Vec<_> = [&sums].into_iter().chain(&given).collect();
        let groups = vec![
            probe::bind_group(gpu, &pipeline, 0, &frame),
            probe::bind_group(gpu, &pipeline, 1, &sums),
        ];
        Self { gpu: gpu.clone(), pipeline, groups }
    }

    fn secs(&self) -> f64 {
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
}

/// Median times of kernels that run in turn.
fn times(runs: &[Run], rounds: u32) -> Vec<f64> {
    let mut all = vec![Vec::new(); runs.len()];
    for round in 0..=rounds {
        for (run, times) in runs.iter().zip(&mut all) {
            let secs = run.secs();
            // The first round warms up.
            if round > 0 {
                times.push(secs);
            }
        }
    }
    all.iter().map(|times| median(times)).collect()
}

/// Measures the hand-written formulas, then all whose derivatives are derived.
///
/// # Errors
/// If a formula is missing.
pub fn measure(gpu: &Gpu, rounds: u32) -> Result<Vec<Row>, Failure> {
    let mut rows = Vec::new();
    for (id, function, given, spread) in BESIDE {
        let fractal = Fractal::new(formula::find(id).ok_or("a formula is missing")?);
        let own = text("distance_estimate(fractal, point)", spread);
        let written = text(&format!("{function}(point)"), spread) + WRITTEN;
        let runs =
            [Run::new(gpu, &fractal, &own, None), Run::new(gpu, &fractal, &written, Some(&given))];
        let [own, other] = times(&runs, rounds)[..] else { return Err("two kernels".into()) };
        rows.push(Row {
            formula: id,
            beside: "hand-written WGSL",
            estimate: own / other,
            gradient: None,
        });
    }
    for (id, _) in formula::texts() {
        let formula = formula::find(id).ok_or("a formula is missing")?;
        let fractal = Fractal::new(formula);
        let derived = formula.files(0).files.iter().any(|file| file.path.ends_with("by_tangent"));
        if !derived {
            continue;
        }
        let spread = 0.4 * fractal.distance_field().bounding_radius() as f32;
        let calls = [
            "value_only(fractal, point)",
            "distance_estimate(fractal, point)",
            "dot(distance_gradient(fractal, point), vec3f(1.0))",
        ];
        let runs = calls.map(|call| Run::new(gpu, &fractal, &(text(call, spread) + VALUES), None));
        let [value, estimate, gradient] = times(&runs, rounds)[..] else {
            return Err("three kernels".into());
        };
        rows.push(Row {
            formula: id,
            beside: "its value alone",
            estimate: estimate / value,
            gradient: Some(gradient / value),
        });
    }
    Ok(rows)
}

/// Prints the rows.
pub fn print(rows: &[Row]) {
    println!("\nsteps: what an estimate and a gradient cost, over another kernel");
    for Row { formula, beside, estimate, gradient } in rows {
        let gradient = gradient.map_or("–".to_owned(), |gradient| format!("{gradient:.2}"));
        println!("  {formula:<26}{beside:<20}{estimate:>8.2}{gradient:>8}");
    }
}
