//! The WGSL that generated formulas become, against their operations in f64.

use std::{collections::HashMap, fmt::Write};

use mandelight::{
    formula::language::{
        check::{self, Checked},
        derive,
        graph::{Binary, Graph, Input, Node, NodeId, Unary},
        syntax,
        wgsl::Emitter,
    },
    gpu::{device::in_parallel, readback::Readback},
};
use mandelight_test_support::{
    device::gpu,
    expressions::Expressions,
    probe::{bind_group, filled},
    random::Random,
};

/// Generated formulas.
const FORMULAS: usize = 10_000;
/// Formulas in one shader.
const BATCH: usize = 50;
/// Inputs of each formula.
const INPUTS: usize = 64;
/// Relative noise of one operation in single precision, with some for coarse functions.
const NOISE: f64 = 3e-7;

/// A formula with the derivatives of its step.
struct Generated {
    text: String,
    checked: Checked,
    tangents: Vec<NodeId>,
}

fn generated(seed: u64) -> Generated {
    let text = Expressions::new(seed).formula();
    let tree = syntax::parse(&text).unwrap_or_else(|error| panic!("{text}\n{error}"));
    let mut checked = check::check(&text, &tree).unwrap_or_else(|error| panic!("{text}\n{error}"));
    let tangents = derive::tangents(&mut checked.graph, &checked.step);
    Generated { text, checked, tangents }
}

/// A shader that writes the step and its derivative of each formula for each input.
fn shader(batch: &[Generated]) -> String {
    let mut text = include_str!("../../shaders/lib/numeric.wgsl").to_owned();
    let orbit = include_str!("../../src/formula/language/orbit.wgsl");
    let (_, operations) = orbit.split_once("struct Rows").expect("the operations");
    let (operations, _) = operations.split_once("// What each step adds.").expect("their end");
    let _ = write!(text, "struct Rows{operations}");
    text += "@group(0) @binding(0) var<storage, read> inputs: array<vec4f>;\n\
             @group(0) @binding(1) var<storage, read_write> outputs: array<vec4f>;\n";
    let mut calls = String::new();
    for (i, one) in batch.iter().enumerate() {
        let graph = &one.checked.graph;
        let emitter = Emitter {
            graph,
            slots: &HashMap::new(),
            non_negative: &graph.non_negative(),
            base: "",
        };
        let (body, v) = emitter.body(&[&one.checked.step[..], &one.tangents].concat());
        // The same direction in all three places: the middle one is compared.
        let derivatives: Vec<_> = one
            .tangents
            .iter()
            .zip(&v[3..])
            .map(|(&id, text)| format!("({}).y", emitter.as_derivative(id, text)))
            .collect();
        let _ = writeln!(
            text,
            "fn step_{i}(z: vec3f, c: vec3f, p: vec3f, tz: Rows) -> array<vec3f, 2> {{\n    \
             let tc = Rows();\n    let tp = Rows();\n{body}    \
             return array<vec3f, 2>(vec3f({}), vec3f({}));\n}}",
            v[..3].join(", "),
            derivatives.join(", ")
        );
        let _ = writeln!(
            calls,
            "    let r{i} = step_{i}(z, c, p, tz);\n    outputs[2u * ({i}u * {INPUTS}u + t)] = vec4f(r{i}[0], 0.0);\n    \
             outputs[2u * ({i}u * {INPUTS}u + t) + 1u] = vec4f(r{i}[1], 0.0);"
        );
    }
    let _ = write!(
        text,
        "@compute @workgroup_size({INPUTS})\nfn main(@builtin(local_invocation_index) t: u32) {{\n    \
         let z = inputs[4u * t].xyz;\n    let c = inputs[4u * t + 1u].xyz;\n    \
         let p = inputs[4u * t + 2u].xyz;\n    let d = inputs[4u * t + 3u];\n    \
         let tz = Rows(vec3f(d.x), vec3f(d.y), vec3f(d.z), vec3f(0.0));\n{calls}}}\n"
    );
    text
}

/// The outputs of a batch, six numbers per formula and input.
fn on_gpu(batch: &[Generated], inputs: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let gpu = gpu();
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("generated"),
        source: wgpu::ShaderSource::Wgsl(shader(batch).into()),
    });
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("generated"),
        layout: None,
        module: &module,
        entry_point: Some("main"),
        compilation_options: Default::default(),
        cache: None,
    });
    let storage = wgpu::BufferUsages::STORAGE;
    let questions = filled(gpu, storage, bytemuck::cast_slice(inputs));
    let size = 2 * 16 * INPUTS * batch.len();
    let answers = filled(gpu, storage | wgpu::BufferUsages::COPY_SRC, &vec![0; size]);
    let group = bind_group(gpu, &pipeline, 0, &[&questions, &answers]);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(1, 1, 1);
    }
    gpu.queue.submit([encoder.finish()]);
    let bytes = Readback::buffer(gpu, &answers).wait(gpu).expect("the answers");
    bytemuck::cast_slice(&bytes).to_vec()
}

/// The value, or not-a-number where single precision's range ends: kernels saturate there.
fn in_range(value: f64) -> f64 {
    let magnitude = value.abs();
    let is_held = (1e-37..=1e37).contains(&magnitude) || magnitude == 0.0;
    if is_held { value } else { f64::NAN }
}

/// The same for powers, of which none is zero.
fn power_in_range(value: f64) -> f64 {
    if value == 0.0 { f64::NAN } else { in_range(value) }
}

/// The values of `outputs`, each operation with relative noise.
fn with_noise(
    graph: &Graph,
    outputs: &[NodeId],
    input: impl Fn(Input) -> f64,
    mut noise: impl FnMut() -> f64,
) -> Vec<f64> {
    let mut values = vec![f64::NAN; graph.nodes().len()];
    for id in graph.needed(outputs, |_| false) {
        let of = |id: NodeId| values[id.index()];
        // A minimum or a comparison would hide that an operand is out of range.
        if graph.node(id).operands().any(|operand| of(operand).is_nan()) {
            continue;
        }
        values[id.index()] = match graph.node(id) {
            Node::Constant(bits) => f64::from(f64::from_bits(bits) as f32),
            Node::Input(one) => input(one),
            Node::Unary(Unary::Exp, a) => power_in_range(of(a).exp() * (1.0 + noise())),
            Node::Binary(Binary::Power, a, b) => {
                power_in_range(Binary::Power.apply(of(a), of(b)) * (1.0 + noise()))
            }
            // A divisor that may be rounding decides nothing.
            Node::Binary(Binary::Divide, _, b) if of(b).abs() < 1e-5 => f64::NAN,
            // Their errors are absolute.
            Node::Unary(operation @ (Unary::Sin | Unary::Cos), a) => {
                in_range(operation.apply(of(a)) + noise())
            }
            Node::Unary(operation, a) => in_range(operation.apply(of(a)) * (1.0 + noise())),
            Node::Binary(operation, a, b) => {
                in_range(operation.apply(of(a), of(b)) * (1.0 + noise()))
            }
            Node::Select(a, b, c) => {
                if of(a) == 0.0 {
                    of(c)
                } else {
                    of(b)
                }
            }
        };
    }
    outputs.iter().map(|id| values[id.index()]).collect()
}

#[test]
fn generated_formulas_agree_with_their_operations() {
    let mut random = Random(0x5EED_CAFE_F00D_0001);
    let inputs: Vec<[f32; 4]> =
        (0..4 * INPUTS).map(|_| [(); 4].map(|()| (1.5 * random.signed()) as f32)).collect();
    let batches: Vec<u64> = (0..(FORMULAS / BATCH) as u64).collect();
    let results = in_parallel(&batches, |&batch| {
        let all: Vec<_> = (0..BATCH as u64).map(|i| generated(batch * BATCH as u64 + i)).collect();
        let outputs = on_gpu(&all, &inputs);
        all.iter()
            .enumerate()
            .map(|(i, one)| compared(one, &inputs, &outputs[2 * INPUTS * i..2 * INPUTS * (i + 1)]))
            .fold((0, Vec::new()), |(count, mut wrong), (more, other)| {
                wrong.extend(other);
                (count + more, wrong)
            })
    });
    let compared: usize = results.iter().map(|(count, _)| count).sum();
    let wrong: Vec<_> = results.iter().flat_map(|(_, wrong)| wrong).collect();
    assert!(compared > 200 * FORMULAS, "{compared} numbers");
    assert!(
        wrong.len() * 100_000 < compared,
        "{} of {compared} numbers differ, such as\n{}",
        wrong.len(),
        wrong[..wrong.len().min(5)].iter().map(|line| format!("{line}\n")).collect::<String>()
    );
}

/// How many numbers of one formula were compared, and which differ by more than rounding.
fn compared(one: &Generated, inputs: &[[f32; 4]], outputs: &[[f32; 4]]) -> (usize, Vec<String>) {
    let Generated { text, checked, tangents } = one;
    let wanted = [&checked.step[..], tangents].concat();
    let (mut count, mut wrong) = (0, Vec::new());
    for t in 0..INPUTS {
        let at = |row: usize, axis: u8| f64::from(inputs[4 * t + row][usize::from(axis)]);
        let input = |input: Input| match input {
            Input::State(i) => at(0, i),
            Input::Addend(i) => at(1, i),
            Input::Point(i) => at(2, i),
            Input::StateTangent(i) => at(3, i),
            // Steps that use these derivatives get none here.
            _ => 0.0,
        };
        let exact = with_noise(&checked.graph, &wanted, input, || 0.0);
        let mut random = Random(t as u64 + 1);
        let runs: Vec<_> = (0..4)
            .map(|_| with_noise(&checked.graph, &wanted, input, || NOISE * random.signed()))
            .collect();
        for (k, &exact) in exact.iter().enumerate() {
            let spread = runs.iter().map(|run| (run[k] - exact).abs()).fold(0.0, f64::max);
            // What rounding decides, and what single precision does not hold, is not compared.
            let is_certain =
                runs.iter().all(|run| run[k].is_finite()) && spread <= 1e-3 * exact.abs().max(1e-3);
            if !is_certain || !exact.is_finite() || exact.abs() > 1e15 {
                continue;
            }
            count += 1;
            let found = f64::from(outputs[2 * t + k / 3][k % 3]);
            let off = (found - exact).abs();
            if off.is_nan() || off > 20.0 * spread + 3e-6 * exact.abs() + 3e-6 {
                wrong.push(format!(
                    "{text}\ninput {t}, output {k}: {found} instead of {exact} ± {spread:.1e}"
                ));
            }
        }
    }
    (count, wrong)
}
