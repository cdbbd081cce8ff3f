//! The distance field of a formula's text, in f64.

use std::{collections::HashMap, sync::Arc};

use glam::DVec3;

use super::{check::Growth, evaluate::Program, graph::Input, kernel::Compiled, sequence::Sequence};
use crate::formula::{DistanceField, Estimate};

/// Longest step of a ray, in bounding radii: an orbit that passes the origin may make dr vanish.
pub const MAX_STEP: f64 = 0.1;
/// Largest derivative before a step, as in `orbit.wgsl`.
const MAX_DERIVATIVE: f64 = 1e30;
/// Largest component of a state after a step, so that an f32 holds the state's square.
const MAX_STATE: f64 = 1e18;
/// Derivatives in the directions of the three axes.
type Jacobian = [[f64; 4]; 3];

/// Programs in f64 of one formula, made once.
#[derive(Clone, Debug)]
pub struct Programs {
    slots: Program,
    init: Program,
    init_tangent: Program,
    /// The state, then dr or the state's derivative along an axis.
    step: Program,
    /// The state alone.
    next: Program,
    extent: Program,
    distance: Program,
    bound: Option<Program>,
    size: usize,
    gives_derivative: bool,
    /// The running derivative at the start.
    pub initial_derivative: f64,
    /// Step of a ray over the estimate.
    pub march: f64,
    /// Whether the estimate has false minima thinner than a pixel.
    pub checks_hits: bool,
    /// Whether the kernels' test of an orbit's size compares with the bailout's square.
    pub tests_square: bool,
    /// Whether orbits grow as a power.
    pub is_power: bool,
    /// Whether the size of a state is its length.
    pub has_usual_size: bool,
    /// Whether the step adds c.
    pub has_addend: bool,
    /// Whether the text gives the distance itself, whose sign then says what is inside.
    pub has_own_distance: bool,
}

impl Programs {
    /// The programs of a compiled formula.
    pub fn new(compiled: &Compiled) -> Self {
        let checked = &compiled.checked;
        let graph = &checked.graph;
        let program = |outputs: &[_]| Program::new(graph, outputs, &compiled.slots);
        let mut slots: Vec<_> = compiled.slots.iter().map(|(id, slot)| (*slot, *id)).collect();
        slots.sort_unstable();
        let slots: Vec<_> = slots.into_iter().map(|(_, id)| id).collect();
        let after: Vec<_> = match checked.derivative {
            Some(derivative) => vec![derivative],
            None => compiled.step_tangents.clone(),
        };
        Self {
            slots: Program::new(graph, &slots, &HashMap::new()),
            init: program(&checked.init),
            init_tangent: program(&compiled.init_tangents),
            step: program(&[&checked.step[..], &after].concat()),
            next: program(&checked.step),
            extent: program(&[checked.extent]),
            distance: program(&[checked.distance]),
            bound: checked.bound_program(),
            size: checked.size,
            gives_derivative: checked.derivative.is_some(),
            initial_derivative: compiled.initial_derivative(),
            march: checked.march,
            checks_hits: checked.checks_hits,
            tests_square: compiled.tests_square,
            is_power: checked.growth == Growth::Power,
            has_usual_size: checked.has_usual_size,
            has_addend: checked.has_addend,
            has_own_distance: checked.has_own_distance,
        }
    }

    /// The slots' values for parameters.
    pub fn slots(&self, params: &[f64]) -> Vec<f64> {
        let mut scratch = Vec::new();
        self.slots.run(|input| param(params, input), &[], &mut scratch).collect()
    }

    /// Whether a step from a state of this length goes beyond the numbers whose squares an f32 holds.
    ///
    /// Only for powers: orbits whose size is not the state's length have no such bailout.
    pub fn overflows(&self, slots: &[f64], size: f64) -> bool {
        if !(self.is_power && self.has_usual_size) {
            return false;
        }
        let mut values = Vec::new();
        (1..3_u32.pow(4)).any(|i| {
            let sign = |place: u32| f64::from(i / 3_u32.pow(place) % 3) - 1.0;
            let z: [f64; 4] = std::array::from_fn(|place| sign(place as u32));
            let length = z.iter().map(|x| x * x).sum::<f64>().sqrt();
            if z[..3] == [0.0; 3] {
                return false;
            }
            let z = z.map(|x| size * x / length);
            let at = StepInputs {
                p: [z[0], z[1], z[2]],
                z,
                c: z,
                dr: 1.0,
                dc: 1.0,
                ..StepInputs::default()
            };
            self.next.run(|input| at.get(input), slots, &mut values).any(|x| x.abs() > MAX_STATE)
        })
    }

    /// The text's own bound on the set; none if the text gives none, or no positive number.
    fn bound(&self, params: &[f64]) -> Option<f64> {
        let mut scratch = Vec::new();
        let found =
            self.bound.as_ref()?.run(|input| param(params, input), &[], &mut scratch).next()?;
        (found > 0.0).then(|| found.clamp(MIN_BOUND, MAX_BOUND))
    }
}

/// Smallest bounding radius: an eye that sees less of the set has no room before it.
const MIN_BOUND: f64 = 1e-2;
/// Sphere that must be free of the set, over the bound that a text gives.
const BOUND_MARGIN: f64 = 1.01;
/// Most operations of a search for the bounding radius: some ten milliseconds.
const MAX_BOUND_OPERATIONS: usize = 8_000_000;
/// Largest bounding radius.
const MAX_BOUND: f64 = 1000.0;

fn param(params: &[f64], input: Input) -> f64 {
    match input {
        Input::Param(i) => params[usize::from(i)],
        _ => 0.0,
    }
}

/// The field of formulas' texts with certain parameters.
#[derive(Clone, Debug)]
pub struct TextField {
    formulas: Arc<[Programs]>,
    sequence: Sequence,
    /// The slots of each step of the sequence.
    slots: Vec<Vec<f64>>,
    iterations: u32,
    bailout: f64,
    /// The addend of the Julia form; none for the form that adds the point.
    julia_constant: Option<[f64; 4]>,
    bounding_radius: f64,
}

/// The end of an orbit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrbitEnd {
    /// The state; the fourth component is 0 for states of three.
    pub z: [f64; 4],
    /// The running derivative.
    pub dr: f64,
    /// Steps taken.
    pub steps: u32,
    /// Whether the orbit passed the bailout.
    pub has_escaped: bool,
}

/// The inputs of a step.
#[derive(Clone, Copy, Default)]
struct StepInputs {
    p: [f64; 3],
    z: [f64; 4],
    c: [f64; 4],
    dr: f64,
    dc: f64,
    /// Derivatives of `z`.
    rows: Jacobian,
    /// Derivatives of `c`.
    addend_rows: Jacobian,
}

impl StepInputs {
    /// The value of an input; derivatives are along `axis`.
    fn along(&self, axis: usize, input: Input) -> f64 {
        match input {
            Input::Point(i) => self.p[usize::from(i)],
            Input::State(i) => self.z[usize::from(i)],
            Input::Addend(i) => self.c[usize::from(i)],
            Input::Derivative => self.dr,
            Input::AddendDerivative => self.dc,
            Input::StateTangent(i) => self.rows[axis][usize::from(i)],
            Input::PointTangent(i) => f64::from(u8::from(usize::from(i) == axis)),
            Input::AddendTangent(i) => self.addend_rows[axis][usize::from(i)],
            Input::DerivativeTangent | Input::Param(_) => 0.0,
        }
    }

    /// The value of an input that is no derivative.
    fn get(&self, input: Input) -> f64 {
        self.along(0, input)
    }
}

/// The Frobenius norm: at least the factor by which any direction is stretched.
fn norm(rows: &Jacobian) -> f64 {
    rows.iter().flatten().map(|x| x * x).sum::<f64>().sqrt()
}

impl TextField {
    /// The field of a sequence of steps of `formulas`.
    pub fn new(
        formulas: &Arc<[Programs]>,
        sequence: Sequence,
        iterations: u32,
        bailout: f64,
        julia_constant: Option<[f64; 4]>,
    ) -> Self {
        let slots =
            sequence.steps.iter().map(|step| formulas[step.formula].slots(&step.params)).collect();
        let mut field = Self {
            formulas: formulas.clone(),
            sequence,
            slots,
            iterations,
            bailout,
            julia_constant,
            bounding_radius: 0.0,
        };
        // A formula's own bound says nothing of its steps among others.
        let alone = match &field.sequence.steps[..] {
            [step] => formulas[step.formula].bound(&step.params),
            _ => None,
        };
        field.bounding_radius = match alone {
            Some(bound) if field.is_within(bound) => bound,
            found => field.find_bound().max(found.unwrap_or_default()),
        };
        field
    }

    /// The values of the slots of the step at `place`.
    pub fn slots(&self, place: usize) -> &[f64] {
        &self.slots[place]
    }

    /// The programs and slots of the step at `place`.
    fn step(&self, place: usize) -> (&Programs, &[f64]) {
        (&self.formulas[self.sequence.steps[place].formula], &self.slots[place])
    }

    /// Step of a ray over the estimate: the shortest that a formula asks for.
    fn march_part(&self) -> f64 {
        self.formulas.iter().map(|programs| programs.march).fold(1.0, f64::min)
    }

    /// The orbit of `point` with its derivative.
    pub fn orbit(&self, point: DVec3) -> OrbitEnd {
        let (leading, leading_slots) = self.step(self.sequence.leading);
        let mut values = Vec::new();
        let mut at = self.start(point, &mut values);
        let mut steps = 0;
        loop {
            let extent =
                leading.extent.run(|input| at.get(input), leading_slots, &mut values).next();
            let has_escaped = !extent.is_some_and(|extent| extent <= self.bailout);
            if steps >= self.iterations || has_escaped {
                let dr = if leading.gives_derivative { at.dr } else { norm(&at.rows) };
                return OrbitEnd { z: at.z, dr, steps, has_escaped };
            }
            let (programs, slots) = self.step(self.sequence.place(steps));
            let mut next = at;
            if programs.gives_derivative {
                let mut after = programs.step.run(|input| at.get(input), slots, &mut values);
                fill(&mut next.z, after.by_ref().take(programs.size));
                next.dr = after.next().unwrap_or_default().min(MAX_DERIVATIVE);
            } else {
                for axis in 0..3 {
                    let input = |input| at.along(axis, input);
                    let mut after = programs.step.run(input, slots, &mut values);
                    fill(&mut next.z, after.by_ref().take(programs.size));
                    fill(&mut next.rows[axis], after);
                }
            }
            at = next;
            steps += 1;
        }
    }

    /// The inputs of the first step.
    fn start(&self, point: DVec3, values: &mut Vec<f64>) -> StepInputs {
        let (first, slots) = self.step(0);
        let empty = StepInputs { p: point.to_array(), ..StepInputs::default() };
        let mut start = StepInputs { dr: first.initial_derivative, ..empty };
        fill(&mut start.z, first.init.run(|input| empty.get(input), slots, values));
        if !first.gives_derivative {
            for axis in 0..3 {
                let moved = first.init_tangent.run(|input| empty.along(axis, input), slots, values);
                fill(&mut start.rows[axis], moved);
            }
        }
        match self.julia_constant {
            Some(constant) => start.c = constant,
            None => (start.c, start.addend_rows, start.dc) = (start.z, start.rows, 1.0),
        }
        start
    }

    /// The estimated distance; 0 inside.
    fn estimated_distance(&self, point: DVec3) -> f64 {
        let end = self.orbit(point);
        let at = StepInputs { p: point.to_array(), z: end.z, dr: end.dr, ..StepInputs::default() };
        let mut values = Vec::new();
        let (leading, slots) = self.step(self.sequence.leading);
        let distance = leading.distance.run(|input| at.get(input), slots, &mut values).next();
        distance.filter(|distance| *distance > 0.0).unwrap_or(0.0)
    }

    /// Whether the orbit of `point` stays within the bailout. Adds to the count of operations.
    fn stays(&self, point: DVec3, operations: &mut usize) -> bool {
        let (leading, leading_slots) = self.step(self.sequence.leading);
        let mut values = Vec::new();
        let mut at = self.start(point, &mut values);
        for steps in 0..=self.iterations {
            let extent =
                leading.extent.run(|input| at.get(input), leading_slots, &mut values).next();
            if !extent.is_some_and(|extent| extent <= self.bailout) {
                return false;
            }
            let (programs, slots) = self.step(self.sequence.place(steps));
            let mut z = at.z;
            fill(&mut z, programs.next.run(|input| at.get(input), slots, &mut values));
            at.z = z;
            *operations += leading.extent.operations() + programs.next.operations();
        }
        true
    }

    /// Whether the set lies within the bound that its text gives.
    ///
    /// Bounds are those of the limit set in the form that adds the point: a Julia set may be larger, and so is what
    /// stays for a few steps.
    fn is_within(&self, bound: f64) -> bool {
        let leading = self.step(self.sequence.leading).0;
        let radius = bound * BOUND_MARGIN;
        let stays = |direction: DVec3| self.stays(radius * direction, &mut 0);
        self.julia_constant.is_none() && !(leading.has_addend && directions().any(stays))
    }

    /// Radius beyond which no sampled point stays, with a margin.
    ///
    /// A search that takes too long ends early, with a radius that is too large.
    fn find_bound(&self) -> f64 {
        const LARGEST: f64 = 24.0;
        const SHRINK: f64 = 0.95;
        let directions: Vec<_> = directions().collect();
        let mut operations = 0;
        let mut is_empty = |radius: f64| {
            directions.iter().all(|direction| {
                operations < MAX_BOUND_OPERATIONS
                    && !self.stays(radius * direction, &mut operations)
            })
        };
        // Usual sizes let orbits beyond the bailout escape at once: these shells cost little.
        let mut radius = self.bailout.clamp(LARGEST, MAX_BOUND);
        if !is_empty(radius) {
            // The set has no end.
            return LARGEST;
        }
        while radius > 0.1 && is_empty(radius) {
            radius *= SHRINK;
        }
        radius / SHRINK / SHRINK
    }
}

/// Unit vectors in which the set's bound is sampled: along axes and diagonals, where thin limbs grow, and spread evenly.
fn directions() -> impl Iterator<Item = DVec3> {
    const SPREAD: u32 = 96;
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let spread = (0..SPREAD).map(move |i| {
        let height = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(SPREAD);
        let (sine, cosine) = (golden * f64::from(i)).sin_cos();
        let flat = (1.0 - height * height).sqrt();
        DVec3::new(flat * cosine, flat * sine, height)
    });
    let grid = (0..27).filter(|i| *i != 13).map(|i| {
        let at = |place: i32| f64::from(i / place % 3 - 1);
        DVec3::new(at(1), at(3), at(9)).normalize()
    });
    grid.chain(spread)
}

fn fill(target: &mut [f64; 4], values: impl Iterator<Item = f64>) {
    for (target, value) in target.iter_mut().zip(values) {
        *target = value;
    }
}

impl DistanceField for TextField {
    fn distance(&self, point: DVec3) -> f64 {
        self.estimated_distance(point)
    }

    fn estimate(&self, point: DVec3) -> Estimate {
        let distance = self.distance(point);
        let step = (self.march_part() * distance).min(MAX_STEP * self.bounding_radius);
        Estimate { distance, step: step.min(distance) }
    }

    fn is_inside(&self, point: DVec3) -> bool {
        if self.step(self.sequence.leading).0.has_own_distance {
            return self.distance(point) <= 0.0;
        }
        // Estimates may be positive where orbits stay within the bailout.
        self.stays(point, &mut 0)
    }

    fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }

    fn needs_hit_check(&self) -> bool {
        self.formulas.iter().any(|programs| programs.checks_hits)
    }
}
