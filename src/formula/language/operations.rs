//! The WGSL functions of one or several formulas, which `orbit.wgsl` and its neighbours list and call.
//!
//! Functions of several formulas have a number behind their names. A function without a number selects among them, by
//! the sequence of steps that the formula's table begins with: see [`super::sequence`].

use std::fmt::Write;

use super::{
    graph::NodeId,
    kernel::Compiled,
    sequence::{FORMULA_BITS, LEADING, MAX_VECTORS},
    wgsl::Emitter,
};

/// Which step's formula a function without a number selects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Selected {
    /// The step with the number `n`, which is the first argument.
    Nth,
    /// The first step.
    First,
    /// The step whose formula computes sizes and distances.
    Leading,
}

/// A function of every formula.
struct Signature {
    name: &'static str,
    /// The parameters with their types, without `n`.
    params: &'static str,
    result: &'static str,
    selected: Selected,
}

macro_rules! signatures {
    ($($constant:ident = $name:literal ($params:literal) -> $result:literal by $selected:ident;)*) => {
        $(
            const $constant: Signature = Signature {
                name: $name, params: $params, result: $result, selected: Selected::$selected,
            };
        )*
        const SIGNATURES: &[Signature] = &[$($constant),*];
    };
}

signatures! {
    INITIAL = "initial"("p: vec3f") -> "State" by First;
    INITIAL_ROWS = "initial_rows"("p: vec3f, tp: Rows") -> "Rows" by First;
    EXTENT_TEST = "extent_test"("z: State") -> "f32" by Leading;
    EXTENT = "extent"("z: State") -> "f32" by Leading;
    DISTANCE_AT = "distance_at"("z: State, p: vec3f, dr: f32") -> "f32" by Leading;
    DISTANCE_SLOPE = "distance_slope"("z: State, p: vec3f, dr: f32, tz: Rows, tp: Rows, tdr: vec3f") -> "vec3f" by Leading;
    NEXT_WITH_DERIVATIVE = "next_with_derivative"("z: State, c: State, p: vec3f, dr: f32, dc: f32") -> "NextDerivative" by Nth;
    NEXT_WITH_CHANNEL = "next_with_channel"("z: State, c: State, p: vec3f, dr: f32, dc: f32") -> "NextChannel" by Nth;
    NEXT_WITH_ROWS = "next_with_rows"("z: State, c: State, p: vec3f, dr: f32, dc: f32, tz: Rows, tc: Rows, tp: Rows, tdr: vec3f") -> "NextRows" by Nth;
}

/// The functions of a formula that draws alone.
pub fn of_one(compiled: &Compiled) -> String {
    header(compiled, 0) + &copied_slots(compiled) + &Writer { compiled, number: None }.all()
}

/// The functions of formulas that take turns; all have states of one size, and all or none a given derivative.
pub fn of_several(formulas: &[Compiled]) -> String {
    let mut text = header(&formulas[0], MAX_VECTORS);
    // Which slots a step reads is known only when it is taken.
    text += "fn load_slots() {}\n\n";
    text += &format!(
        "struct StepPlace {{\n    which: u32,\n    base: u32,\n}}\n\n\
         fn step_place(n: u32) -> StepPlace {{\n    \
         let entry = min(n, {LEADING}u);\n    \
         let packed = u32(table.slots[entry / 4u][entry % 4u]);\n    \
         return StepPlace(packed & {}u, packed >> {FORMULA_BITS}u);\n}}\n\n",
        (1 << FORMULA_BITS) - 1,
    );
    for (number, compiled) in formulas.iter().enumerate() {
        text += &Writer { compiled, number: Some(number) }.all();
    }
    SIGNATURES.iter().for_each(|signature| text += &selection(signature, formulas.len()));
    text
}

/// A function that selects among `count` formulas' functions.
fn selection(signature: &Signature, count: usize) -> String {
    let Signature { name, params, result, selected } = signature;
    let (first, step) = match selected {
        Selected::Nth => ("n: u32, ", "n".to_owned()),
        Selected::First => ("", "0u".to_owned()),
        Selected::Leading => ("", format!("{LEADING}u")),
    };
    let names = params.split(", ").filter_map(|param| param.split_once(':'));
    let arguments: Vec<_> = names.map(|(name, _)| name).collect();
    let arguments = arguments.join(", ");
    let mut text = format!(
        "fn {name}({first}{params}) -> {result} {{\n    let at = step_place({step});\n    switch at.which {{\n"
    );
    for number in 1..count {
        // Writing to a String does not fail.
        let _ = writeln!(
            text,
            "        case {number}u: {{ return {name}_{number}(at.base, {arguments}); }}"
        );
    }
    text + &format!("        default: {{ return {name}_0(at.base, {arguments}); }}\n    }}\n}}\n\n")
}

/// Types that the functions share. `vectors` is the size of the table, or 0 for that of one formula.
fn header(compiled: &Compiled, vectors: usize) -> String {
    let size = compiled.checked.size;
    let constant = if size == 3 { "v.xyz" } else { "v" };
    let vectors = if vectors == 0 { super::uniforms::MAX_SLOTS / 4 } else { vectors };
    format!(
        "// The operations of formulas' texts, from `operations.rs`.\n\nalias State = vec{size}f;\n\
         const TABLE_VECTORS = {vectors}u;\n\n\
         struct NextDerivative {{\n    z: State,\n    dr: f32,\n}}\n\n\
         struct NextChannel {{\n    z: State,\n    dr: f32,\n    channel: f32,\n}}\n\n\
         struct NextRows {{\n    z: State,\n    dr: f32,\n    rows: Rows,\n    slope: vec3f,\n}}\n\n\
         fn as_state(v: vec4f) -> State {{\n    return {constant};\n}}\n\n"
    )
}

/// A copy of the slots of a formula that draws alone, and the function that makes it.
///
/// lavapipe reads a uniform in a loop again at each turn and for each thread.
fn copied_slots(compiled: &Compiled) -> String {
    let count = compiled.slots.values().max().map_or(0, |last| last / 4 + 1);
    if count == 0 {
        return "fn load_slots() {}\n\n".to_owned();
    }
    let copies: String =
        (0..count).map(|i| format!("    slots[{i}] = table.slots[{i}];\n")).collect();
    format!("var<private> slots: array<vec4f, {count}>;\n\nfn load_slots() {{\n{copies}}}\n\n")
}

/// Writes the functions of one formula.
struct Writer<'a> {
    compiled: &'a Compiled,
    /// The formula's number among several.
    number: Option<usize>,
}

impl Writer<'_> {
    fn all(&self) -> String {
        let compiled = self.compiled;
        let checked = &compiled.checked;
        let size = checked.size;
        let vector = |v: &[String]| format!("State({})", v.join(", "));
        let rows = |v: &[String]| {
            let mut v = v.to_vec();
            v.resize(4, "vec3f(0.0)".to_owned());
            format!("Rows({})", v.join(", "))
        };
        let first = |v: &[String]| v[0].clone();
        let init_tangents = (0, &compiled.init_tangents[..]);
        let given = checked.derivative.as_slice();
        let mut text = [
            self.function(&INITIAL, (size, &checked.init), &vector),
            self.function(&INITIAL_ROWS, init_tangents, &rows),
            self.function(&EXTENT_TEST, (1, &[compiled.extent_test]), &first),
            self.function(&EXTENT, (1, &[checked.extent]), &first),
            self.function(&DISTANCE_AT, (1, &[checked.distance]), &first),
            self.function(&DISTANCE_SLOPE, (0, &[compiled.distance_tangent]), &first),
        ]
        .concat();
        let outputs = [&checked.step[..], given].concat();
        text += &self.function(&NEXT_WITH_DERIVATIVE, (outputs.len(), &outputs), &|v| {
            let dr = v.get(size).map_or("dr", String::as_str);
            format!("NextDerivative({}, {dr})", vector(&v[..size]))
        });
        let channel = compiled.channel();
        let outputs = [&checked.step[..], given, channel.as_slice()].concat();
        text += &self.function(&NEXT_WITH_CHANNEL, (outputs.len(), &outputs), &|v| {
            let (z, mut rest) = (vector(&v[..size]), v[size..].iter());
            let dr = if given.is_empty() { "dr" } else { rest.next().map_or("dr", String::as_str) };
            let channel = rest.next().map_or("0.0", String::as_str);
            format!("NextChannel({z}, {dr}, {channel})")
        });
        let numbers = size + given.len();
        let outputs =
            [&checked.step[..], given, &compiled.step_tangents, &[compiled.derivative_tangent]]
                .concat();
        text + &self.function(&NEXT_WITH_ROWS, (numbers, &outputs), &|v| {
            let dr = if given.is_empty() { "1.0" } else { &v[size] };
            let (z, tangents) = (vector(&v[..size]), &v[numbers..]);
            format!("NextRows({z}, {dr}, {}, {})", rows(&tangents[..size]), tangents[size])
        })
    }

    /// A function of which the first `numbers` outputs are numbers, and the others derivatives.
    fn function(
        &self,
        signature: &Signature,
        (numbers, outputs): (usize, &[NodeId]),
        join: &dyn Fn(&[String]) -> String,
    ) -> String {
        let graph = &self.compiled.checked.graph;
        let non_negative = graph.non_negative();
        let emitter = Emitter {
            graph,
            slots: &self.compiled.slots,
            non_negative: &non_negative,
            base: if self.number.is_some() { "base + " } else { "" },
        };
        let (body, values) = emitter.body(outputs);
        let values: Vec<_> = outputs
            .iter()
            .zip(values)
            .enumerate()
            .map(
                |(i, (&id, value))| {
                    if i >= numbers { emitter.as_derivative(id, &value) } else { value }
                },
            )
            .collect();
        let Signature { name, params, result, selected } = signature;
        let (suffix, extra) = match self.number {
            Some(number) => (format!("_{number}"), "base: u32, "),
            None if *selected == Selected::Nth => (String::new(), "n: u32, "),
            None => (String::new(), ""),
        };
        format!(
            "fn {name}{suffix}({extra}{params}) -> {result} {{\n{body}    return {};\n}}\n\n",
            join(&values)
        )
    }
}
