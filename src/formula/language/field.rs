//! The distance field of a formula's text, in f64.

use std::{collections::HashMap, sync::Arc};

use glam::DVec3;

use super::{check::Growth, evaluate::Program, graph::Input, kernel::Compiled, sequence::Sequence};
use crate::formula::{DistanceField, Estimate};

/// Longest step of a ray, in bounding radii: an orbit that passes the origin may make dr vanish.
pub const MAX_STEP: f64 = 0.1;
/// Direction of the derivative that is carried where the text gives none, as in `orbit.wgsl`.
const ANY_DIRECTION: [f64; 3] = [0.48, 0.6, 0.64];
/// Largest derivative before a step, as in `orbit.wgsl`.
const MAX_DERIVATIVE: f64 = 1e30;

/// Programs in f64 of one formula, made once.
#[derive(Clone, Debug)]
pub struct Programs {
    slots: Program,
    init: Program,
    init_tangent: Program,
    /// The state, then dr or the state's tangent.
    step: Program,
    extent: Program,
    distance: Program,
    bound: Option<Program>,
    size: usize,
    gives_derivative: bool,
    /// The running derivative at the start.
    pub initial_derivative: f64,
    /// Step of a ray over the estimate.
    pub march: f64,
    /// Whether the kernels' test of an orbit's size compares with the bailout's square.
    pub tests_square: bool,
    /// Whether orbits grow as a power.
    pub is_power: bool,
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
            extent: program(&[checked.extent]),
            distance: program(&[checked.distance]),
            bound: checked.bound_program(),
            size: checked.size,
            gives_derivative: checked.derivative.is_some(),
            initial_derivative: compiled.initial_derivative(),
            march: checked.march,
            tests_square: compiled.tests_square,
            is_power: checked.growth == Growth::Power,
            has_own_distance: checked.has_own_distance,
        }
    }

    /// The slots' values for parameters.
    pub fn slots(&self, params: &[f64]) -> Vec<f64> {
        let mut scratch = Vec::new();
        self.slots.run(|input| param(params, input), &[], &mut scratch).collect()
    }

    /// The text's own bound on the set; none if the text gives none, or no positive number.
    fn bound(&self, params: &[f64]) -> Option<f64> {
        let mut scratch = Vec::new();
        let found =
            self.bound.as_ref()?.run(|input| param(params, input), &[], &mut scratch).next()?;
        (found > 0.0).then(|| found.min(MAX_BOUND))
    }
}

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
struct Known {
    p: [f64; 3],
    z: [f64; 4],
    c: [f64; 4],
    dr: f64,
    dc: f64,
    tz: [f64; 4],
    tc: [f64; 4],
    tp: [f64; 3],
}

impl Known {
    fn get(&self, input: Input) -> f64 {
        match input {
            Input::Point(i) => self.p[usize::from(i)],
            Input::State(i) => self.z[usize::from(i)],
            Input::Addend(i) => self.c[usize::from(i)],
            Input::Derivative => self.dr,
            Input::AddendDerivative => self.dc,
            Input::StateTangent(i) => self.tz[usize::from(i)],
            Input::PointTangent(i) => self.tp[usize::from(i)],
            Input::AddendTangent(i) => self.tc[usize::from(i)],
            Input::DerivativeTangent | Input::Param(_) => 0.0,
        }
    }
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
        field.bounding_radius = alone.unwrap_or_else(|| field.find_bound());
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

    /// The orbit of `point`, with the derivative in `direction` where the text gives none.
    pub fn orbit(&self, point: DVec3, direction: DVec3) -> OrbitEnd {
        let (first, first_slots) = self.step(0);
        let (leading, leading_slots) = self.step(self.sequence.leading);
        let mut values = Vec::new();
        let mut known = Known {
            p: point.to_array(),
            tp: direction.to_array(),
            dr: first.initial_derivative,
            ..Known::default()
        };
        let start = known;
        let init = first.init.run(|input| start.get(input), first_slots, &mut values);
        fill(&mut known.z, init);
        let moved = first.init_tangent.run(|input| start.get(input), first_slots, &mut values);
        fill(&mut known.tz, moved);
        match self.julia_constant {
            Some(constant) => known.c = constant,
            None => (known.c, known.tc, known.dc) = (known.z, known.tz, 1.0),
        }
        let mut steps = 0;
        loop {
            let at = known;
            let extent =
                leading.extent.run(|input| at.get(input), leading_slots, &mut values).next();
            let has_escaped = !extent.is_some_and(|extent| extent <= self.bailout);
            if steps >= self.iterations || has_escaped {
                if !leading.gives_derivative {
                    known.dr = known.tz.iter().map(|x| x * x).sum::<f64>().sqrt();
                }
                return OrbitEnd { z: known.z, dr: known.dr, steps, has_escaped };
            }
            let (programs, slots) = self.step(self.sequence.place(steps));
            let mut after = programs.step.run(|input| at.get(input), slots, &mut values);
            fill(&mut known.z, after.by_ref().take(programs.size));
            if programs.gives_derivative {
                known.dr = after.next().unwrap_or_default().min(MAX_DERIVATIVE);
            } else {
                fill(&mut known.tz, after);
            }
            steps += 1;
        }
    }

    /// The estimated distance with the derivative in `direction`.
    pub fn distance_along(&self, point: DVec3, direction: DVec3) -> f64 {
        let end = self.orbit(point, direction);
        let known = Known { p: point.to_array(), z: end.z, dr: end.dr, ..Known::default() };
        let mut values = Vec::new();
        let (leading, slots) = self.step(self.sequence.leading);
        let distance = leading.distance.run(|input| known.get(input), slots, &mut values).next();
        distance.filter(|distance| *distance > 0.0).unwrap_or(0.0)
    }

    /// Radius beyond which no sampled point stays, with a margin.
    fn find_bound(&self) -> f64 {
        const DIRECTIONS: u32 = 96;
        const LARGEST: f64 = 24.0;
        const SHRINK: f64 = 0.95;
        let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let spread = (0..DIRECTIONS).map(|i| {
            let height = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(DIRECTIONS);
            let (sine, cosine) = (golden * f64::from(i)).sin_cos();
            let flat = (1.0 - height * height).sqrt();
            DVec3::new(flat * cosine, flat * sine, height)
        });
        // Thin limbs grow along axes and diagonals.
        let grid = (0..27).filter(|i| *i != 13).map(|i| {
            let at = |place: i32| f64::from(i / place % 3 - 1);
            DVec3::new(at(1), at(3), at(9)).normalize()
        });
        let directions: Vec<_> = grid.chain(spread).collect();
        let stays = |radius: f64| {
            directions
                .iter()
                .any(|direction| !self.orbit(radius * direction, *direction).has_escaped)
        };
        let mut radius = LARGEST;
        while radius > 0.1 && !stays(radius) {
            radius *= SHRINK;
        }
        (radius / SHRINK / SHRINK).min(LARGEST)
    }
}

fn fill(target: &mut [f64; 4], values: impl Iterator<Item = f64>) {
    for (target, value) in target.iter_mut().zip(values) {
        *target = value;
    }
}

impl DistanceField for TextField {
    fn distance(&self, point: DVec3) -> f64 {
        self.distance_along(point, DVec3::from_array(ANY_DIRECTION))
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
        !self.orbit(point, DVec3::from_array(ANY_DIRECTION)).has_escaped
    }

    fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }
}
