//! What an orbit step of a formula's text costs, against hand-written WGSL and against its orbit without a derivative.
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

/// Workgroups of 64 threads; each thread follows 16 orbits.
const WORKGROUPS: u32 = 96;
/// Iterations of the scenes.
const ITERATIONS: u32 = 100;
/// The hand-written formulas.
const WRITTEN: &str = include_str!("written.wgsl");

/// A formula that `written.wgsl` has too.
struct Written {
    formula: &'static str,
    /// Its function there.
    function: &'static str,
    /// What that function reads: the formula's default values, and the square of its bailout.
    params: [[f32; 4]; 5],
    /// Half the side of the cube that the orbits start in.
    half_side: f32,
}

const HAND_WRITTEN: [Written; 3] = [
    Written {
        formula: "mandelbox",
        function: "mandelbox",
        params: [[2.0, 1.0, 0.5, 1.0], [1e4; 4], [0.0; 4], [0.0; 4], [0.0; 4]],
        half_side: 2.0,
    },
    Written {
        formula: "menger_sponge",
        function: "menger",
        params: [
            [3.0; 4],
            [1e4; 4],
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ],
        half_side: 0.9,
    },
    Written {
        formula: "quaternion_julia",
        function: "quaternion_julia",
        params: [[0.0; 4], [16.0; 4], [-0.125, -0.256, 0.847, 0.0895], [0.0; 4], [0.0; 4]],
        half_side: 0.5,
    },
];

/// One formula.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The formula's id.
    pub formula: &'static str,
    /// What its times are compared with.
    pub baseline: &'static str,
    /// Time of the estimate over the baseline's.
    pub estimate: f64,
    /// Time of the gradient over the baseline's; none for hand-written baselines, which have none.
    pub gradient: Option<f64>,
}

/// A compute shader that adds up `call` at points of a cube about the origin.
fn shader_text(call: &str, half_side: f32) -> String {
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
        let point = {half_side:?} * (2.0 * place - 1.0);
        sum += {call};
    }}
    sums[id.x] = sum;
}}
"
    )
}

/// Follows an orbit without derivatives.
const ORBIT_ALONE: &str = "
fn orbit_alone(fractal: Fractal, point: vec3f) -> f32 {
    load_slots();
    let c = addend(fractal, point);
    var z = initial(point);
    for (var n = 0u; n < fractal.iterations && !is_escaped(fractal, z); n++) {
        z = next_with_channel(n, z, c, point, 1.0, fractal.addend_derivative).z;
    }
    return z.x;
}
";

/// The kernel of a shader text in the frame of `fractal`; `params`: what a hand-written one reads.
fn timed(gpu: &Gpu, fractal: &Fractal, text: &str, params: Option<&[[f32; 4]; 5]>) -> TimedKernel {
    let scene = Scene { fractal: fractal.with_iterations(ITERATIONS), ..Scene::default() };
    let inputs = Inputs::new(&scene, Region::whole([64, 64]));
    // The texts of benchmarks last as long as the program.
    let text = Box::leak(text.to_owned().into_boxed_str());
    let kernel = inputs.formula.kernel;
    let module = shaders::joined("steps", Some(kernel), text).create(&gpu.device);
    let params: Vec<_> = params
        .map(|params| {
            let bytes: Vec<u8> = params.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
            probe::filled(gpu, wgpu::BufferUsages::STORAGE, &bytes)
        })
        .into_iter()
        .collect();
    // A binding that a kernel does not read is in no layout: hand-written ones read no table.
    let files = kernel.files().files;
    let reads_table =
        params.is_empty() && files.iter().any(|file| file.text.contains("table.slots"));
    let frame = &probe::bindings(gpu, &inputs)[..if reads_table { 2 } else { 1 }];
    TimedKernel::new(gpu, pipeline(gpu, &module, &kernel), WORKGROUPS, [frame, &params])
}

/// Measures the hand-written formulas, then all whose derivative the program derives.
///
/// # Errors
/// If a formula is missing.
pub fn measure(gpu: &Gpu, rounds: u32) -> Result<Vec<Row>, Failure> {
    let mut rows = Vec::new();
    for Written { formula, function, params, half_side } in HAND_WRITTEN {
        let fractal = Fractal::new(formula::find(formula).ok_or("a formula is missing")?);
        let own = shader_text("distance_estimate(fractal, point)", half_side);
        let written = shader_text(&format!("{function}(point)"), half_side) + WRITTEN;
        let kernels =
            [timed(gpu, &fractal, &own, None), timed(gpu, &fractal, &written, Some(&params))];
        let [own, other] = median_secs(&kernels, rounds)[..] else {
            return Err("two kernels".into());
        };
        rows.push(Row {
            formula,
            baseline: "hand-written WGSL",
            estimate: own / other,
            gradient: None,
        });
    }
    for (id, _) in formula::texts() {
        let formula = formula::find(id).ok_or("a formula is missing")?;
        let fractal = Fractal::new(formula);
        let derived = formula.files(0).files.iter().any(|file| file.path.ends_with("by_jacobian"));
        if !derived {
            continue;
        }
        let half_side = 0.4 * fractal.distance_field().bounding_radius() as f32;
        let calls = [
            "orbit_alone(fractal, point)",
            "distance_estimate(fractal, point)",
            "dot(distance_gradient(fractal, point), vec3f(1.0))",
        ];
        let kernels = calls
            .map(|call| timed(gpu, &fractal, &(shader_text(call, half_side) + ORBIT_ALONE), None));
        let [value, estimate, gradient] = median_secs(&kernels, rounds)[..] else {
            return Err("three kernels".into());
        };
        rows.push(Row {
            formula: id,
            baseline: "its orbit alone",
            estimate: estimate / value,
            gradient: Some(gradient / value),
        });
    }
    Ok(rows)
}

/// Prints the rows.
pub fn print(rows: &[Row]) {
    println!("\nsteps: what an estimate and a gradient cost, over another kernel");
    for Row { formula, baseline, estimate, gradient } in rows {
        let gradient = gradient.map_or("–".to_owned(), |gradient| format!("{gradient:.2}"));
        println!("  {formula:<26}{baseline:<20}{estimate:>8.2}{gradient:>8}");
    }
}
