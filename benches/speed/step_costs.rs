//! What an orbit step of a formula's text costs, beside hand-written WGSL and beside the step without its derivative.
//!
//! All kernels of a row follow the same orbits in turn, so that their times compare.

use mandelight::{
    formula::{self, Fractal},
    gpu::Gpu,
    render::{Region, shaders, uniforms::Inputs},
    scene::Scene,
};
use mandelight_test_support::probe;
use serde::Serialize;

use super::{
    failure::Failure,
    timed_kernel::{TimedKernel, median_secs, pipeline},
};

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

/// The kernel of a text in the frame of `fractal`; `given`: the parameters of a hand-written one.
fn timed(gpu: &Gpu, fractal: &Fractal, text: &str, given: Option<&[[f32; 4]; 5]>) -> TimedKernel {
    let scene = Scene { fractal: fractal.with_iterations(ITERATIONS), ..Scene::default() };
    let inputs = Inputs::new(&scene, Region::whole([64, 64]));
    // The texts of benchmarks last as long as the program.
    let text = Box::leak(text.to_owned().into_boxed_str());
    let kernel = inputs.formula.kernel;
    let module = shaders::joined("steps", Some(kernel), text).create(&gpu.device);
    let given: Vec<_> = given
        .map(|given| {
            let bytes: Vec<u8> = given.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
            probe::filled(gpu, wgpu::BufferUsages::STORAGE, &bytes)
        })
        .into_iter()
        .collect();
    // A binding that a kernel does not read is in no layout: hand-written ones read no table.
    let files = kernel.files().files;
    let reads_table =
        given.is_empty() && files.iter().any(|file| file.text.contains("table.slots"));
    let frame = &probe::bindings(gpu, &inputs)[..if reads_table { 2 } else { 1 }];
    TimedKernel::new(gpu, pipeline(gpu, &module, &kernel), WORKGROUPS, [frame, &given])
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
        let kernels =
            [timed(gpu, &fractal, &own, None), timed(gpu, &fractal, &written, Some(&given))];
        let [own, other] = median_secs(&kernels, rounds)[..] else {
            return Err("two kernels".into());
        };
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
        let kernels = calls.map(|call| timed(gpu, &fractal, &(text(call, spread) + VALUES), None));
        let [value, estimate, gradient] = median_secs(&kernels, rounds)[..] else {
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
